// rollbem/adhesion/transient.hpp
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/line.hpp>
#include <rollbem/reference/bessel.hpp>

#include "support/catch.hpp"
#include "support/dense.hpp"
#include "support/observed_order.hpp"

namespace transient_tests {
namespace {

using namespace rollbem;
using Model = AdhesionModel<>;
using Motion = RigidMotion<double>;

constexpr std::array all_integrators{Integrator::implicit_euler, Integrator::sdirk2, Integrator::matrix_exponential};

Contact plane_contact() { return Contact::dimensionless(100, 0.25); }

Model plane_model(Eigen::Index n, Integrator integrator) {
    const Contact contact = plane_contact();
    return {contact, rolling_system(cosine_mesh<double>(n), Collocation{}, PlaneKernel<double>::longitudinal(contact)),
            unchecked, integrator};
}

/// -F_bar / (a G) in the units of plane_contact.
double response(const AdhesionModel<>::Step& step) {
    REQUIRE(step.status == Status::ok);
    return -step.force_per_width;
}

/// The same after steps of one size from rest through a history: motion(k) is the motion in step k = 0, 1, ...
template <class MotionOf>
double response(const Model& model, double dq, int steps, const MotionOf& motion) {
    Run run(model);
    double force = 0;
    for (int k = 0; k < steps; ++k) force = response(run.advance({dq, motion(k)}));
    return force;
}

TEST_CASE("Steps converge in dq at the order of their integrator", "[transient]") {
    const double way = 4;
    const Model exact = plane_model(30, Integrator::matrix_exponential);
    const auto sine = [](double dq) {
        return [dq](int k) { return Motion::linear(std::sin(k * dq), std::sin((k + 1) * dq)); };
    };
    const auto ramp = [](double dq) { return [dq](int k) { return Motion::linear(k * dq, (k + 1) * dq); }; };
    const auto rectangles = [](double dq) { return [dq](int k) { return Motion(std::sin((k + 1) * dq)); }; };
    const double ramp_end = response(exact, way, 1, ramp(way));
    // replacing the history by chords has a second-order error: computed with two step sizes and extrapolated
    const double fine = way / 4096;
    const double sine_end =
        (4 * response(exact, fine, 4096, sine(fine)) - response(exact, 2 * fine, 2048, sine(2 * fine))) / 3;

    for (const Integrator integrator : all_integrators) {
        const Model model = plane_model(30, integrator);
        std::vector<double> sizes, sine_errors, ramp_errors, rectangle_errors;
        for (int steps = 40; steps <= 640; steps *= 2) {
            const double dq = way / steps;
            sizes.push_back(steps);
            sine_errors.push_back(std::abs(response(model, dq, steps, sine(dq)) - sine_end));
            ramp_errors.push_back(std::abs(response(model, dq, steps, ramp(dq)) - ramp_end));
            rectangle_errors.push_back(std::abs(response(model, dq, steps, rectangles(dq)) - sine_end));
        }
        const double expected = integrator == Integrator::implicit_euler ? 1 : 2;
        CAPTURE(name(integrator), sine_errors, ramp_errors, rectangle_errors);
        CHECK(std::abs(support::observed_order(sizes, sine_errors) - expected) < 0.1);
        CHECK(std::abs(support::observed_order(sizes, rectangle_errors) - 1) < 0.1);
        if (integrator == Integrator::matrix_exponential) {
            CHECK(*std::max_element(ramp_errors.begin(), ramp_errors.end()) < 1e-11);
        } else {
            CHECK(std::abs(support::observed_order(sizes, ramp_errors) - expected) < 0.1);
        }
    }
}

TEST_CASE("A step applies the stability function of its integrator", "[transient]") {
    // one element: a scalar equation with the eigenvalue w of dq G^-1 G'
    const Contact contact = plane_contact();
    const MatrixX<double> G = MatrixX<double>::Constant(1, 1, 1.0), G_prime = -2 * G;
    const ArrayX<double> widths = ArrayX<double>::Constant(1, 2.0);
    const double gamma = 1 - 1 / std::sqrt(2.0);
    for (const double w : {-1e-7, -0.1, -1.0, -7.0, -1e3, -1e9}) {
        for (const Integrator integrator : all_integrators) {
            const Model model(contact, ElementSystem<double>(G, G_prime, widths), unchecked, integrator);
            const double expected = integrator == Integrator::implicit_euler ? 1 / (1 - w)
                                    : integrator == Integrator::sdirk2
                                        ? (1 + (1 - 2 * gamma) * w) / ((1 - gamma * w) * (1 - gamma * w))
                                        : std::exp(w);
            Model::State from = model.at_rest(), to = from;
            Model::Workspace workspace = model.workspace();
            from.traction[0] = 1;
            for (const double before : {0.0, -w / 2}) {
                from.distance = before;
                REQUIRE(model.advance(from, {-w / 2, 0.0}, to, workspace).status == Status::ok);
                CAPTURE(name(integrator), w, before);
                CHECK(std::abs(to.traction[0] - expected) < 1e-14);
            }
        }
    }
}

TEST_CASE("Free motion grows or decays at the rate of the largest eigenvalue", "[transient]") {
    const Contact contact = plane_contact();
    const auto check = [&](const Collocation& scheme, Integrator integrator, double dq, double tolerance) {
        const auto system =
            rolling_system(uniform_mesh<double>(20), scheme, StripKernel<double>::longitudinal(contact));
        const double abscissa = judge_stability(system).spectral_abscissa;
        const Model model(contact, system, unchecked, integrator);
        const auto still = [](int k) { return k == 0 ? Motion::shift(1.0) : Motion(0.0); };
        const double before = response(model, dq, 400, still), after = response(model, dq, 401, still);
        const double expected =
            integrator == Integrator::implicit_euler ? 1 / (1 - dq * abscissa) : std::exp(dq * abscissa);
        CAPTURE(scheme.alpha_T, name(integrator), abscissa, after / before, expected);
        CHECK((abscissa > 0) == (scheme.alpha_T > 1));
        CHECK(std::abs(std::log(after / before) / std::log(expected) - 1) < tolerance);
    };
    check(Collocation{}, Integrator::matrix_exponential, 0.1, 1e-10);
    check(Collocation{}, Integrator::sdirk2, 0.1, 1e-4);
    check(Collocation{}, Integrator::implicit_euler, 0.1, 1e-10);
    check(Collocation{.alpha_L = 0, .alpha_T = 1.2}, Integrator::matrix_exponential, 1e-3, 1e-6);
}

TEST_CASE("Steps of dq = 1e-9 to 1e6 stay bounded and have the right limits", "[transient]") {
    const Mesh<double> mesh = cosine_mesh<double>(40);
    const auto kernel = PlaneKernel<double>::longitudinal(plane_contact());
    const double steady = solve_steady(mesh, Collocation{}, kernel).c11();
    const VectorX<double> shifted = dense::solve(assemble_G(mesh, Collocation{}, kernel), VectorX<double>::Ones(40));
    const double shift_force = shifted.dot(mesh.widths().matrix());
    CHECK(std::abs(steady / steady_c11(0.25) - 1) < 2e-4);

    for (const Integrator integrator : all_integrators) {
        const Model model = plane_model(40, integrator);
        for (int exponent = -9; exponent <= 6; ++exponent) {
            const double dq = std::pow(10.0, exponent);
            Run run(model);
            double largest = 0;
            for (int k = 0; k < 300; ++k) {
                const double force = response(run.advance({dq, 1.0}));
                if (k == 0 && exponent <= -7) CHECK(std::abs(force / (dq * shift_force) - 1) < 20 * dq);
                largest = std::max(largest, std::abs(force));
            }
            CAPTURE(name(integrator), dq, largest);
            CHECK(largest < 1.3 * steady);  // L-stable steps may overshoot once
            if (dq > 0.5) CHECK(std::abs(-model.force(run.now()) / 200 / steady - 1) < 1e-12);
            // steady rolling is a fixed point
            run.now() = model.steady(1.0);
            const VectorX<double> tractions = run.now().traction;
            for (const double before : {0.0, dq}) {
                run.now().distance = before;
                CHECK(std::abs(response(run.try_advance({dq, 1.0})) / steady - 1) < 1e-12);
                CHECK((run.next().traction - tractions).norm() < 1e-10 * tractions.norm());
            }
        }
    }
}

TEST_CASE("Steps by the map and by stages follow the exact response", "[transient]") {
    const reference::StepResponse exact(0.25, 100);
    for (const Integrator integrator : all_integrators) {
        const Model model = plane_model(20, integrator);
        Run run(model);
        double force = 0;
        for (int k = 0; k < 32; ++k) {
            Run by_stages(model, run.now());
            by_stages.now().distance = 0;
            force = response(run.advance({0.0625, 1.0}));
            const double rounding = std::abs(response(by_stages.advance({0.0625, 1.0})) / force - 1);
            CHECK(rounding < 1000 * std::numeric_limits<double>::epsilon());
        }
        CHECK(std::abs(force / exact.step(2) - 1) < (integrator == Integrator::implicit_euler ? 6e-3 : 4e-4));
    }
}

TEST_CASE("A result that overflows leaves a copy of the initial state; steady rolling is no shift",
          "[transient][not_finite]") {
    const Model model = plane_model(10, Integrator::sdirk2);
    Model::Workspace workspace = model.workspace();
    Model::State huge{VectorX<double>::Constant(10, 1.7e308), model.fingerprint(), 1}, to = model.at_rest();
    for (const double distance : {0.0, 0.1}) {
        huge.distance = distance;
        CHECK(model.advance(huge, {0.1, 1.0}, to, workspace).status == Status::not_finite);
        CHECK(to.traction == huge.traction);
        CHECK(to.distance == distance);
    }
    CHECK(model.steady(to, {.motion = std::numeric_limits<double>::infinity()}, huge, workspace).status ==
          Status::not_finite);
    CHECK(model.steady(to, {.motion = Motion::shift(1e-6)}, huge, workspace).status == Status::invalid_step);
    CHECK(model.steady(to, {.motion = 1.0}, to, workspace).status == Status::wrong_state);
    CHECK(model.advance(to, {0.0, 1.0}, huge, workspace).status == Status::invalid_step);
}

TEST_CASE("The constructor rejects invalid input and names the quantity", "[transient][not_finite]") {
    const Contact contact = plane_contact();
    const Mesh<double> mesh = uniform_mesh<double>(8);
    const StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);
    const auto build = [&](const StabilityVerdict& verdict) {
        Model(contact, rolling_system(mesh, Collocation{}, kernel), verdict);
    };
    const StabilityVerdict good{.n = 8, .status = Status::ok};
    CHECK_NOTHROW(build(good));
    using Catch::Matchers::ContainsSubstring;
    CHECK_THROWS_WITH(build({.n = 8, .unstable_count = 2, .status = Status::ok}),
                      ContainsSubstring("AdhesionModel: unstable_count = 2 must be 0"));
    CHECK_THROWS_WITH(build({.n = 8, .uncertain_count = 1, .status = Status::ok}),
                      ContainsSubstring("AdhesionModel: uncertain_count = 1 must be 0"));
    CHECK_THROWS_WITH(build({.n = 9, .status = Status::ok}), ContainsSubstring("n of the verdict = 9 must equal"));
    CHECK_THROWS_AS(build(StabilityVerdict{.n = 8}), std::invalid_argument);  // eigenvalues not found
    // all modes decay at alpha = 1.5, to three times the force
    CHECK_THROWS_WITH(Model(contact, rolling_system(mesh, Collocation{1.5, 1.5}, kernel), good),
                      ContainsSubstring("does not converge to full adhesion"));
    CHECK_NOTHROW(Model(contact, rolling_system(mesh, Collocation{1.5, 1.5}, kernel), unchecked));

    const ElementSystem<double> singular(MatrixX<double>::Identity(8, 8), MatrixX<double>::Zero(8, 8), mesh.widths());
    CHECK_THROWS_WITH(Model(contact, singular, good), ContainsSubstring("G_prime is singular"));

    const Contact infinite = Contact::dimensionless(std::numeric_limits<double>::infinity(), 0.25);
    CHECK_THROWS_WITH(Model(infinite, rolling_system(mesh, Collocation{}, kernel), unchecked),
                      ContainsSubstring("half_width = inf must be finite"));

    MatrixX<double> G = assemble_G(mesh, Collocation{}, kernel);
    const MatrixX<double> G_prime = assemble_G_prime(mesh, Collocation{}, kernel);
    CHECK_NOTHROW(Model(contact, ElementSystem<double>(G, G_prime, mesh.widths()), good));
    CHECK_THROWS_AS(Model(contact, ElementSystem<double>(G, G_prime, uniform_mesh<double>(9).widths()), unchecked),
                    std::invalid_argument);
    G(3, 4) = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(Model(contact, ElementSystem<double>(G, G_prime, mesh.widths()), unchecked), std::invalid_argument);
}

}  // namespace
}  // namespace transient_tests
