// rollbem/adhesion/transient.hpp: longitudinal and lateral creepage and spin, on a line and on a patch.
#include <array>
#include <cmath>
#include <cstddef>

#include <rollbem/line.hpp>
#include <rollbem/scene/patch_contact.hpp>

#include "support/catch.hpp"
#include "support/dense.hpp"

namespace transient_directions_tests {
namespace {

using namespace rollbem;
using Eigen::MatrixXd, Eigen::VectorXd;
using Model = AdhesionModel<2>;
using Motion = Model::Motion;
using Forces = Eigen::Vector3d;

constexpr std::array all_integrators{Integrator::implicit_euler, Integrator::sdirk2, Integrator::matrix_exponential};
constexpr double a = 5e-3, b = 20e-3, G = 8e10;

const Contact contact({.half_length = a, .half_width = b, .shear_modulus = G, .poisson_ratio = 0.28});

ElementSystem<double> line(const PlaneKernel<double>& kernel) {
    return rolling_system(cosine_mesh(12), Collocation{}, kernel);
}
const ElementSystem<double> along = line(PlaneKernel<double>::longitudinal(contact)),
                            across = line(PlaneKernel<double>::lateral(contact));

const PatchContact patch({.half_length = a, .half_width = b, .shear_modulus = G, .poisson_ratio = 0.28});

Forces vector(const TangentialForce& force) { return {force.longitudinal, force.lateral, force.moment}; }

/// Two strips of two elements; all directions and elements couple.
ElementSystem<double, 2> patch_system() {
    Elements<double> elements;
    elements.x.resize(4);
    elements.x << -0.4, 0.6, -0.3, 0.5;
    elements.y.resize(4);
    elements.y << -0.5, -0.5, 0.7, 0.7;
    elements.centre_x = elements.x - 0.1;
    elements.centre_y = elements.y;
    elements.areas.resize(4);
    elements.areas << 0.9, 0.8, 0.6, 0.7;
    elements.behind = {-1, 0, -1, 2};
    ElementSystem<double, 2>::Blocks blocks, slopes;
    for (std::size_t d = 0; d < 2; ++d) {
        for (std::size_t e = 0; e < 2; ++e) {
            blocks[d][e] = MatrixXd::Constant(4, 4, d == e ? 0.2 : 0.05);
            slopes[d][e] = MatrixXd::Constant(4, 4, d == e ? -0.1 : 0.03);
            for (Eigen::Index i = 0; i < 4; ++i) {
                blocks[d][e](i, (i + 1) % 4) += 0.1 * static_cast<double>(d + 2 * e);
                slopes[d][e](i, (i + 3) % 4) += 0.2;
                if (d != e) continue;
                blocks[d][e](i, i) += 1;
                slopes[d][e](i, i) -= 1.5;
            }
        }
    }
    return {blocks, slopes, elements};
}

TEST_CASE("Without coupling, each direction is stepped as on its own, and lateral tractions make the moment",
          "[transient]") {
    for (const Integrator integrator : all_integrators) {
        const Model both(contact, ElementSystem(along, across), unchecked, integrator);
        const AdhesionModel<> first(contact, along, unchecked, integrator),
            second(contact, across, unchecked, integrator);
        Run of_both(both);
        Run of_first(first), of_second(second);
        for (int k = 0; k < 12; ++k) {
            const double dq = (k < 6 ? 0.3 : 0.1) * a;
            const auto value = [&](int at) { return Creepage{1e-3 * at, 5e-4 * std::sin(at), 0}; };
            const auto motion = [&](auto pick) {
                using One = RigidMotion<decltype(pick(value(0)))>;
                return k % 2 == 0 ? One::linear(pick(value(k)), pick(value(k + 1))) : One(pick(value(k)));
            };
            const auto step = of_both.advance({dq, motion([](const auto& all) { return all; })});
            const auto x = of_first.advance({dq, motion([](const auto& all) { return all.longitudinal; })});
            const auto y = of_second.advance({dq, motion([](const auto& all) { return all.lateral; })});
            REQUIRE(step.status == Status::ok);
            CAPTURE(name(integrator), k);
            CHECK(step.force.longitudinal == Approx(x.force).epsilon(1e-12));
            CHECK(step.force.lateral == Approx(y.force).epsilon(1e-12));
            CHECK(step.force_per_width.lateral == Approx(y.force_per_width).epsilon(1e-12));
            CHECK(step.tangent.by_longitudinal.longitudinal == Approx(x.tangent).epsilon(1e-12));
            CHECK(step.tangent.by_lateral.lateral == Approx(y.tangent).epsilon(1e-12));
            CHECK(std::abs(step.tangent.by_lateral.longitudinal) < 1e-12 * std::abs(x.tangent));
            const double moment =
                2 * b * a * a *
                (across.weights() * across.elements().centre_x * of_second.now().traction.array()).sum();
            CHECK(step.force.moment == Approx(moment).epsilon(1e-11));
            CHECK((vector(both.force(of_both.now())) - vector(step.force)).norm() < 1e-14 * vector(step.force).norm());
        }
    }
}

TEST_CASE("A step on a patch solves the equations of all inputs together, in SI units", "[transient]") {
    // implicit Euler: (G - dq G') p = G p_old - inputs v dq; lengths in a, tractions in G
    const ElementSystem<double, 2> system = patch_system();
    const RollingSystem<double> whole = system.joined();
    const Model model(patch, system, unchecked, Integrator::implicit_euler);
    Model::Workspace workspace = model.workspace();
    Model::State from = model.at_rest(), to = from;
    from.traction = 1e6 * VectorXd::LinSpaced(8, -1, 2);
    const double dq = 0.35;
    const Creepage end{2e-3, -1e-3, 0.8};  // spin in 1/m
    const Forces inputs(end.longitudinal, end.lateral, a * end.spin);
    const VectorXd right = whole.G() * (from.traction / G) - dq * whole.inputs() * inputs;
    const VectorXd expected = dense::solve(whole.G() - dq * whole.G_prime(), right);
    const Forces force = G * a * a * Forces(1, 1, a).cwiseProduct(whole.outputs().transpose() * expected);
    for (const double before : {0.0, dq * a}) {
        from.distance = before;
        for (const Motion& motion :
             {Motion(end), Motion::linear({1, 2, 3}, end),
              Motion::shift({dq * a * end.longitudinal, dq * a * end.lateral, dq * a * end.spin})}) {
            const AdhesionModel<2>::Step step = model.advance(from, {dq * a, motion}, to, workspace);
            REQUIRE(step.status == Status::ok);
            CAPTURE(before, vector(step.force), force);
            CHECK((to.traction / G - expected).norm() < 1e-12 * expected.norm());
            for (Eigen::Index i = 0; i < 3; ++i) CHECK(vector(step.force)[i] == Approx(force[i]).epsilon(1e-11));
            CHECK(std::isnan(step.force_per_width.longitudinal));
        }
    }
}

TEST_CASE("A model of three inputs refuses what has one, and says so", "[transient]") {
    using Catch::Matchers::ContainsSubstring;
    const ElementSystem<double, 2> system(along, across);
    CHECK_THROWS_WITH(AdhesionModel(contact, system.joined(), unchecked),
                      ContainsSubstring("number of inputs = 3 must be 1"));
    CHECK_THROWS_WITH(AdhesionModel(contact, system, StabilityVerdict{.n = 12, .status = Status::ok}),
                      ContainsSubstring("n of the verdict = 12 must equal"));
    CHECK_NOTHROW(AdhesionModel(contact, system, StabilityVerdict{.n = 24, .status = Status::ok}));
    const ElementSystem<double> placeless(along.G(), along.G_prime(), along.weights());
    CHECK_THROWS_WITH(AdhesionModel(contact, ElementSystem<double, 2>(placeless, placeless), unchecked),
                      ContainsSubstring("spin needs them"));
    const Contact wide({.half_length = a, .half_width = 2 * b, .shear_modulus = G, .poisson_ratio = 0.28});
    CHECK_THROWS_WITH(AdhesionModel(wide, system, unchecked), ContainsSubstring("b/a of the kernel"));
}

}  // namespace
}  // namespace transient_directions_tests
