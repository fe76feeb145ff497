// rollbem/adhesion/transient.hpp: longitudinal and lateral creepage and spin, on a line and on a patch.
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/adhesion/response.hpp>
#include <rollbem/adhesion/transient.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/scene/patch_contact.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>

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

Eigen::Matrix3d matrix(const TangentialForce::ByCreepage& tangent) {
    Eigen::Matrix3d result;
    result << vector(tangent.by_longitudinal), vector(tangent.by_lateral), vector(tangent.by_spin);
    return result;
}

/// Two strips of two elements; all directions and elements couple.
ElementSystem<double, 2> patch_system(double slope = 1.5) {
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
                slopes[d][e](i, i) -= slope;
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
        Model::State now = both.at_rest(), next = now;
        AdhesionModel<>::State first_now = first.at_rest(), first_next = first_now;
        AdhesionModel<>::State second_now = second.at_rest(), second_next = second_now;
        Model::Workspace workspace = both.workspace();
        AdhesionModel<>::Workspace first_workspace = first.workspace(), second_workspace = second.workspace();
        for (int k = 0; k < 12; ++k) {
            const double dq = (k < 6 ? 0.3 : 0.1) * a;
            const auto value = [&](int at) { return Creepage{1e-3 * at, 5e-4 * std::sin(at), 0}; };
            const auto motion = [&](auto pick) {
                using One = RigidMotion<decltype(pick(value(0)))>;
                return k % 2 == 0 ? One::linear(pick(value(k)), pick(value(k + 1))) : One(pick(value(k)));
            };
            const AdhesionModel<2>::Step step =
                both.advance(now, {dq, motion([](const auto& all) { return all; })}, next, workspace);
            const AdhesionModel<>::Step x = first.advance(
                first_now, {dq, motion([](const auto& all) { return all.longitudinal; })}, first_next, first_workspace);
            const AdhesionModel<>::Step y = second.advance(
                second_now, {dq, motion([](const auto& all) { return all.lateral; })}, second_next, second_workspace);
            REQUIRE(step.status == Status::ok);
            CAPTURE(name(integrator), k);
            CHECK(step.force.longitudinal == Approx(x.force).epsilon(1e-12));
            CHECK(step.force.lateral == Approx(y.force).epsilon(1e-12));
            CHECK(step.force_per_width.lateral == Approx(y.force_per_width).epsilon(1e-12));
            CHECK(step.tangent.by_longitudinal.longitudinal == Approx(x.tangent).epsilon(1e-12));
            CHECK(step.tangent.by_lateral.lateral == Approx(y.tangent).epsilon(1e-12));
            CHECK(std::abs(step.tangent.by_lateral.longitudinal) < 1e-12 * std::abs(x.tangent));
            const double moment =
                2 * b * a * a * (across.weights() * across.elements().centre_x * second_next.traction.array()).sum();
            CHECK(step.force.moment == Approx(moment).epsilon(1e-11));
            CHECK((vector(both.force(next)) - vector(step.force)).norm() < 1e-14 * vector(step.force).norm());
            std::swap(now, next);
            std::swap(first_now, first_next);
            std::swap(second_now, second_next);
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

TEST_CASE("The tangent of three forces by three motions is the difference quotient", "[transient]") {
    for (const Integrator integrator : all_integrators) {
        const Model model(patch, patch_system(), unchecked, integrator);
        Model::Workspace workspace = model.workspace();
        Model::State from = model.steady(Creepage{1e-3, 2e-3, 0.4}), to = from;
        const double dq = 0.6 * a;
        const auto value = [](Eigen::Index input, double size) {
            Creepage result{1e-3, -2e-3, 0.3};
            (input == 0 ? result.longitudinal : input == 1 ? result.lateral : result.spin) += size;
            return result;
        };
        for (const double before : {0.0, dq}) {
            from.distance = before;
            for (Eigen::Index j = 0; j < 3; ++j) {
                const double size = j == 2 ? 0.2 : 1e-3;
                for (const auto& motion : {+[](const Creepage& end) { return Motion(end); },
                                           +[](const Creepage& end) { return Motion::linear({}, end); },
                                           +[](const Creepage& end) { return Motion::shift(end); }}) {
                    const AdhesionModel<2>::Step low = model.advance(from, {dq, motion(value(j, 0))}, to, workspace);
                    const AdhesionModel<2>::Step high =
                        model.advance(from, {dq, motion(value(j, size))}, to, workspace);
                    const Forces slope = (vector(high.force) - vector(low.force)) / size;
                    const Forces tangent = matrix(high.tangent).col(j);
                    CAPTURE(name(integrator), before, j);
                    CHECK((slope - tangent).norm() < 1e-10 * tangent.norm());
                }
            }
        }
    }
}

TEST_CASE("The result of a step depends on state and arguments alone, to the last bit", "[transient]") {
    // whatever the workspace has been used for
    const Model model(patch, patch_system(), unchecked);
    const Model others[] = {Model(patch, patch_system(), unchecked, Integrator::implicit_euler),
                            Model(patch, patch_system(), unchecked, Integrator::matrix_exponential),
                            Model(patch, patch_system(1.4), unchecked)};
    Model::Workspace used = model.workspace();
    Model::State now = model.at_rest(), next = now, other = now;
    for (int k = 0; k < 40; ++k) {
        const double dq = a * std::array{0.1, 0.1, 0.3, 0.3, 0.3, 0.1, 0.2}[static_cast<std::size_t>(k) % 7];
        const Creepage value{1e-3, 1e-4 * k, 0.1};
        for (const Model& another : others) {
            Model::State its_own = another.steady(value);
            its_own.distance = k % 4 == 0 ? dq : 0;
            if (k % 5 == 0) another.advance(its_own, {k % 2 == 0 ? dq : 0.15 * a, value}, next, used);
        }
        if (k % 4 == 0) model.advance(now, {0.25 * a, value}, next, used);
        Model::Workspace fresh = model.workspace();
        const AdhesionModel<2>::Step expected = model.advance(now, {dq, value}, other, fresh);
        const AdhesionModel<2>::Step found = model.advance(now, {dq, value}, next, used);
        REQUIRE(found.status == Status::ok);
        CHECK(vector(found.force) == vector(expected.force));
        CHECK(matrix(found.tangent) == matrix(expected.tangent));
        CHECK(next.traction == other.traction);
        std::swap(now, next);
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
