// rollbem/friction/model.hpp, state.hpp: against closed forms and full adhesion, and what a state may hold.
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <rollbem/line.hpp>

#include "extremes/drawn.hpp"
#include "friction/same_bits.hpp"
#include "scene.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace friction_tests {
namespace {

using Catch::Matchers::ContainsSubstring;

TEST_CASE("Small creepage or high friction gives the linear solutions", "[friction]") {
    for (const Collocation& scheme : {half, Collocation{0, 0.63}}) {
        const Scene scene(cosine_mesh<double>(30), scheme), grippy(cosine_mesh<double>(30), scheme, 1e9);
        const double linear = -scene.contact.width() * solve_steady(scene.mesh, scheme, scene.kernel).c11();
        const double small = from_scratch(scene.steady(), 1e-9).force.longitudinal / 1e-9;
        const FrictionStep gripped = from_scratch(grippy.steady(), 0.3);
        CHECK(std::abs(small / linear - 1) < 1e-12);
        CHECK(std::abs(gripped.force.longitudinal / 0.3 / linear - 1) < 1e-12);
        CHECK(std::abs(slope(gripped) / linear - 1) < 1e-12);
        CHECK(gripped.stick_count == 30);
        CHECK(gripped.slip_work == 0);

        // the same steps as in full adhesion, whatever the integrator and the motion
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            const AdhesionModel<> full_adhesion(scene.contact, scene.system(), unchecked, integrator);
            const FrictionModel model = grippy.transient(integrator), slippery = scene.transient(integrator);
            FrictionState now = model.at_rest(), next = now, small_now = slippery.at_rest(), small_next = small_now;
            FrictionModel::Workspace workspace = model.workspace(), small_workspace = slippery.workspace();
            AdhesionModel<>::State linear_now = full_adhesion.at_rest(), linear_next = linear_now;
            AdhesionModel<>::Workspace linear_workspace = full_adhesion.workspace();
            using LinearMotion = RigidMotion<double>;
            for (int step = 1; step <= 20; ++step) {
                const double xi = 0.1 * std::sin(0.3 * step), dq = step % 4 == 0 ? 0.5 : 0.2;
                const auto motion = [&](double scale) {
                    const Creepage start{scale * 0.02}, end{scale * xi};
                    return step % 3 == 0   ? Motion(end)
                           : step % 3 == 1 ? Motion::linear(start, end)
                                           : Motion::shift(end);
                };
                const LinearMotion linear_motion = step % 3 == 0   ? LinearMotion(xi)
                                                   : step % 3 == 1 ? LinearMotion::linear(0.02, xi)
                                                                   : LinearMotion::shift(xi);
                const AdhesionModel<>::Step expected =
                    full_adhesion.advance(linear_now, {dq, linear_motion}, linear_next, linear_workspace);
                const FrictionStep rolled = model.advance(now, {dq, motion(1)}, next, workspace);
                slippery.advance(small_now, {dq, motion(1e-8)}, small_next, small_workspace);
                std::swap(now, next);
                std::swap(small_now, small_next);
                std::swap(linear_now, linear_next);
                const VectorX<double>& traction = linear_now.traction;
                const double scale = traction.cwiseAbs().maxCoeff();
                CAPTURE(scheme.alpha_L, name(integrator), step);
                CHECK((now.traction.col(0) - traction).cwiseAbs().maxCoeff() < 1e-11 * scale);
                CHECK((1e8 * small_now.traction.col(0) - traction).cwiseAbs().maxCoeff() < 1e-11 * scale);
                CHECK(std::abs(rolled.force.longitudinal / expected.force - 1) < 1e-11);
                CHECK(std::abs(slope(rolled) / expected.tangent - 1) < 1e-11);
            }
        }
    }
}

TEST_CASE("A rigid shift without rolling gives Cattaneo's solution", "[friction]") {
    for (const double force : {-0.4, 0.75}) {
        std::vector<double> sizes, errors;
        for (const Eigen::Index n : {20, 40, 80}) {
            const Scene scene(cosine_mesh<double>(n), {.alpha_L = 0, .alpha_T = 0}, 1, 100);
            const FrictionModel model = scene.transient();
            const FrictionState rest = model.at_rest();
            FrictionState shifted = rest;
            FrictionModel::Workspace workspace = model.workspace();
            const double shift = peak * cattaneo_shift(force, nu, 100.0);
            const FrictionStep step = model.advance(rest, {0, Motion::shift({shift})}, shifted, workspace);
            sizes.push_back(static_cast<double>(n));
            errors.push_back(force_ratio(step, scene.contact) / force - 1);
            CAPTURE(force, n, errors.back());
            CHECK(step.status == Status::ok);
            // without rolling the solution is symmetric
            CHECK((shifted.traction - shifted.traction.colwise().reverse()).cwiseAbs().maxCoeff() < 1e-12 * peak);
            const double c = cattaneo_stick_half_length(force);
            for (Eigen::Index i = 0; i < n; ++i) {
                const double x = scene.mesh.centres()[i];
                if (std::abs(std::abs(x) - c) < scene.mesh.widths()[i]) continue;
                CHECK((shifted.zones[static_cast<std::size_t>(i)] == Zone::stick) == (std::abs(x) < c));
                CHECK(std::abs(shifted.traction(i, 0) / peak - cattaneo_traction(x, force)) <
                      1.5 / static_cast<double>(n));
            }
            const double delta = 1e-7 * shift;
            const FrictionStep more = model.advance(rest, {0, Motion::shift({shift + delta})}, shifted, workspace);
            CHECK(slope(step) == Approx((more.force.longitudinal - step.force.longitudinal) / delta).epsilon(1e-5));
        }
        CHECK(std::abs(errors[1]) < 5e-4);
        CHECK(std::abs(support::observed_order(sizes, errors) - 2) < 0.3);
    }
}

TEST_CASE("Matrices that do not belong to elements are rejected by name", "[friction]") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    Scene scene(cosine_mesh<double>(8));
    const Friction& good = scene.friction;
    const MatrixX<double> one = MatrixX<double>::Identity(8, 8);
    CHECK_THROWS_WITH(FrictionModel(scene.contact, {{}, MatrixX<double>::Zero(7, 8), scene.mesh.widths()}, good),
                      "RollingSystem: number of rows of G_prime = 7 must equal the number of weights");
    CHECK_THROWS_WITH(FrictionModel(scene.contact, {{}, MatrixX<double>::Zero(8, 7), scene.mesh.widths()}, good),
                      "RollingSystem: number of columns of G_prime = 7 must equal the number of weights");
    MatrixX<double> G = one, G_prime = -one;
    G_prime(6, 1) = inf;
    CHECK_THROWS_WITH(ElementSystem<double>(G, G_prime, scene.mesh.widths()), ContainsSubstring("G_prime(6, 1) = "));
    CHECK_THROWS_WITH(FrictionModel(scene.contact, {{}, G_prime, scene.mesh.widths()}, good),
                      "RollingSystem: G_prime(6, 1) = inf must be finite (row and column counted from 0)");
    G(2, 5) = nan;
    CHECK_THROWS_WITH(ElementSystem<double>(G, G_prime, scene.mesh.widths()),
                      ContainsSubstring(": G(2, 5) = nan must be finite"));
    CHECK_THROWS_WITH(FrictionModel(scene.contact, {{}, MatrixX<double>(), ArrayX<double>()}, {1, {}}),
                      "RollingSystem: number of weights = 0 must be at least 1");
    ArrayX<double> width = scene.mesh.widths();
    width[4] = 0;
    CHECK_THROWS_WITH(FrictionModel(scene.contact, {{}, -one, width}, good),
                      "ElementSystem: width = 0 must be positive and finite");
    CHECK(FrictionStep{}.status == Status::not_finite);

    CHECK_THROWS_WITH(Scene(cosine_mesh<double>(8), half, 1, 0.1).transient(),
                      ContainsSubstring("PlaneKernel: Lambda"));
    // no friction, no force; no pressure at an element, no traction there
    const FrictionModel smooth = Scene(cosine_mesh<double>(8), half, 0).transient();
    FrictionState next = smooth.at_rest();
    FrictionModel::Workspace workspace = smooth.workspace();
    CHECK(smooth.advance(smooth.at_rest(), {0.1, Creepage{1e-3}}, next, workspace).force.longitudinal == 0);
    scene.friction.normal_pressure[5] = 0;
    const FrictionModel gap = scene.transient();
    CHECK(gap.advance(gap.at_rest(), {0.1, Creepage{1e-3}}, next, workspace).status == Status::ok);
    CHECK(next.traction(5, 0) == 0);
}

TEST_CASE("Fingerprints distinguish systems but not friction laws", "[friction]") {
    const Scene scene(cosine_mesh<double>(8), half, 1, 10);
    const ElementSystem<double> system = scene.system();
    CHECK(system.fingerprint() == scene.system().fingerprint());
    const auto changed = [&](int what) {
        MatrixX<double> G = system.G(), G_prime = system.G_prime();
        ArrayX<double> widths = system.weights();
        double& entry = what == 0 ? G(3, 5) : what == 1 ? G_prime(7, 0) : widths[7];
        entry = std::nextafter(entry, 1e9);
        return ElementSystem<double>(G, G_prime, widths).fingerprint();
    };
    for (const int what : {0, 1, 2}) CHECK(changed(what) != system.fingerprint());
    CHECK(scene.transient().fingerprint() == scene.transient(Integrator::implicit_euler).fingerprint());
    CHECK(scene.transient().fingerprint() == Scene(scene.mesh, half, 0.1, 10).transient().fingerprint());
    CHECK(scene.transient().fingerprint() != Scene(scene.mesh, half, 1, 11).transient().fingerprint());
}

TEST_CASE("What a workspace has solved before changes no bit of a step", "[friction]") {
    drawn::Draw draw(5);
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        // the bounds of both models differ under the same pressures
        const Scene scene(cosine_mesh<double>(12)), slippery(cosine_mesh<double>(12), half, 0.6);
        const std::array<FrictionModel, 2> models{scene.transient(integrator), slippery.transient(integrator)};
        std::array<FrictionState, 2> now{models[0].at_rest(), models[1].at_rest()};
        FrictionModel::Workspace used = models[0].workspace();
        int refused = 0;
        for (int k = 0; k < 150; ++k) {
            const auto which = static_cast<std::size_t>(draw.integer(2));
            const FrictionModel& model = models[which];
            FrictionState& state = now[which];
            FrictionModel::RollingStep step{k % 30 < 20 ? 0.05 : 0.08, Creepage{creepage(0.2 + 0.3 * (k % 50 / 10))}};
            const int kind = draw.integer(8);
            const ArrayX<double> pressure = scene.friction.normal_pressure;
            const double share = kind == 0 ? 0.7 + 0.1 * draw.integer(4) : 1;
            const NormalLoad load{share * (kind == 0 ? pressure : state.normal_pressure), 1, pressure};
            if (kind < 2) step.load = load;
            FrictionState from = state;
            if (kind == 2) from.normal_pressure[draw.integer(12)] = -1;
            FrictionModel::Workspace fresh = model.workspace();
            FrictionState one = from, other = from;
            const FrictionStep a = model.advance(from, step, one, used), b = model.advance(from, step, other, fresh);
            CAPTURE(k, kind, which, a.status, b.status);
            REQUIRE(a.status == (kind == 2 ? Status::invalid_load : Status::ok));
            REQUIRE(a.status == b.status);
            refused += kind == 2 ? 1 : 0;
            if (kind == 2) continue;
            REQUIRE(same_bits::same(one, other));
            REQUIRE(same_bits::same(a.force, b.force));
            REQUIRE(same_bits::same(a.tangent, b.tangent));
            REQUIRE(same_bits::same(a.tangent_by_load, b.tangent_by_load));
            REQUIRE(same_bits::same(used.slip(), fresh.slip()));
            REQUIRE(same_bits::same(used.slip_work(), fresh.slip_work()));
            state = one;
        }
        CHECK(refused > 5);
    }
}

TEST_CASE("Contacts of one system may share a workspace", "[friction]") {
    const Contact stiff({5e-3, 0.05, 8.2e10, nu}), soft({5e-3, 0.05, 4.1e10, nu});
    const Mesh<double> mesh = cosine_mesh<double>(20);
    const auto system = rolling_system(mesh, Collocation{}, PlaneKernel<double>::longitudinal(stiff));
    const ArrayX<double> pressure = 1e9 * mean_hertz_pressure(mesh);
    const std::array<FrictionModel, 3> models{
        FrictionModel(stiff, system, unchecked, {0.3, pressure}),
        FrictionModel(soft, system, unchecked, {0.3, ArrayX<double>(pressure / 2)}),
        FrictionModel(stiff, system, unchecked, {0.3, pressure}, Integrator::sdirk2, 1)};
    std::array<FrictionState, 3> now{models[0].at_rest(), models[1].at_rest(), models[2].at_rest()};
    FrictionModel::Workspace shared = models[0].workspace();
    for (int k = 0; k < 24; ++k) {
        const auto which = static_cast<std::size_t>(k / 2 % 3);
        const FrictionModel& model = models[which];
        FrictionModel::Workspace own = model.workspace();
        FrictionState one = now[which], other = now[which];
        const NormalLoad load{now[which].normal_pressure, k % 2 == 0 ? 5e-3 : 6e-3, {}};
        const FrictionModel::RollingStep step{.motion = Creepage{1e-3, 1e-3}, .load = load};
        const FrictionStep a = model.steady(now[which], step, one, shared),
                           b = model.steady(now[which], step, other, own);
        CAPTURE(k);
        REQUIRE(a.status == Status::ok);
        REQUIRE(same_bits::same(a.force, b.force));
        REQUIRE(same_bits::same(a.tangent, b.tangent));
        REQUIRE(same_bits::same(shared.slip(), own.slip()));
        now[which] = one;
    }
}

}  // namespace
}  // namespace friction_tests
