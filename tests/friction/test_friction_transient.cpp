// rollbem/friction/model.hpp, state.hpp: against closed forms and full adhesion, and what a state may hold.
#include <array>
#include <cmath>
#include <limits>
#include <vector>

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
            const FrictionModel model = grippy.transient(integrator);
            Run run(model);
            Run linear_run(full_adhesion);
            for (int step = 1; step <= 20; ++step) {
                const double xi = 0.1 * std::sin(0.3 * step), dq = step % 4 == 0 ? 0.5 : 0.2;
                const auto motion = [&](auto start, auto end) {
                    using Either = RigidMotion<decltype(start)>;
                    return step % 3 == 0   ? Either(end)
                           : step % 3 == 1 ? Either::linear(start, end)
                                           : Either::shift(end);
                };
                const AdhesionModel<>::Step expected = linear_run.advance({dq, motion(0.02, xi)});
                const FrictionStep rolled = run.advance({dq, motion(Creepage{0.02}, Creepage{xi})});
                const VectorX<double>& traction = linear_run.now().traction;
                const double scale = traction.cwiseAbs().maxCoeff();
                CAPTURE(scheme.alpha_L, name(integrator), step);
                CHECK((run.now().traction.col(0) - traction).cwiseAbs().maxCoeff() < 1e-11 * scale);
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
            Run run(model);
            const double shift = peak * cattaneo_shift(force, nu, 100.0), delta = 1e-7 * shift;
            const FrictionStep more = run.try_advance({0, Motion::shift({shift + delta})}),
                               step = run.try_advance({0, Motion::shift({shift})});
            const FrictionState& shifted = run.next();
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
            CHECK(slope(step) == Approx((more.force.longitudinal - step.force.longitudinal) / delta).epsilon(1e-5));
        }
        CHECK(std::abs(errors[1]) < 5e-4);
        CHECK(std::abs(support::observed_order(sizes, errors) - 2) < 0.3);
    }
}

TEST_CASE("Matrices that do not belong to elements are rejected by name", "[friction]") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const Scene scene(cosine_mesh<double>(8));
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

    // no friction, no force
    const FrictionModel smooth = Scene(cosine_mesh<double>(8), half, 0).transient();
    CHECK(Run(smooth).advance({0.1, Creepage{1e-3}}).force.longitudinal == 0);
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
        const NormalLoad load{now[which].normal_pressure, (k + 1) / 2 % 2 == 0 ? 5e-3 : 6e-3, {}};
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
