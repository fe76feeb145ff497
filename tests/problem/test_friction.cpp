// rollbem/problem/friction.hpp: stick and slip against closed forms, limits, conservation and each other.

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/steady.hpp>

#include "support/catch.hpp"
#include "support/dense.hpp"
#include "support/friction_of_scalars.hpp"
#include "support/scalars.hpp"

namespace {

using namespace rollbem;

constexpr double nu = 0.25;
constexpr double peak = 1e-3;  // mu p0, with a = G = 1
constexpr double full_force = peak * std::numbers::pi / 2;
constexpr Collocation half{.alpha_L = 0.5, .alpha_T = 0.5};

double creepage(double ratio) { return 2 * (1 - nu) * peak * ratio; }
double force_ratio(const FrictionStep<double>& step) { return -step.force_per_width / full_force; }

struct Scene {
    Scene(Mesh<double> mesh_, Collocation scheme_ = half, double mu = 1, double aspect = 1e4)
        : contact(Contact<double>::dimensionless(aspect, nu)),
          kernel(PlaneKernel<double>::longitudinal(contact)),
          mesh(std::move(mesh_)),
          scheme(scheme_),
          friction{mu, peak * mean_hertz_pressure(mesh)} {}

    SteadyFrictionModel<double> steady() const { return {contact, mesh, scheme, kernel, friction}; }
    FrictionModel<double> transient(Integrator integrator = Integrator::sdirk2) const {
        return {contact, mesh, scheme, kernel, friction, integrator};
    }

    Contact<double> contact;
    PlaneKernel<double> kernel;
    Mesh<double> mesh;
    Collocation scheme;
    CoulombFriction<double> friction;
};

FrictionStep<double> from_scratch(const SteadyFrictionModel<double>& model, double xi) {
    const FrictionState<double> rest = model.at_rest();
    FrictionState<double> state = rest;
    return model.solve(rest, xi, state);
}

using Pressure = std::function<ArrayX<double>(const Mesh<double>&)>;

FittedFrictionSolution<double> fitted_solution(const Scene& scene, Eigen::Index n, const Pressure& pressure,
                                               double xi) {
    return solve_fitted_friction(scene.contact, n, scene.kernel, 1.0, pressure, xi);
}

// slope of log|error| against log n
double observed_order(const std::vector<double>& n, const std::vector<double>& error) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    const double count = static_cast<double>(n.size());
    for (std::size_t i = 0; i < n.size(); ++i) {
        const double x = std::log(n[i]), y = std::log(std::abs(error[i]));
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    return -(count * sxy - sx * sy) / (count * sxx - sx * sx);
}

TEST_CASE("any matrix has a solution, and it is found", "[friction]") {
    std::mt19937 generator(7);
    std::normal_distribution<double> normal;
    int fallbacks = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Eigen::Index n = 1 + trial % 12;
        detail::ActiveSet<double> solver(n);
        // every third matrix is of rank one, every third is definite, the others are anything
        const VectorX<double> left = VectorX<double>::NullaryExpr(n, [&] { return normal(generator); });
        const VectorX<double> right = VectorX<double>::NullaryExpr(n, [&] { return normal(generator); });
        const MatrixX<double> any = MatrixX<double>::NullaryExpr(n, n, [&] { return normal(generator); });
        if (trial % 3 == 0) solver.matrix() = left * right.transpose();
        if (trial % 3 == 1) solver.matrix() = any * any.transpose() + MatrixX<double>::Identity(n, n);
        if (trial % 3 == 2) solver.matrix() = any;
        const MatrixX<double> matrix = solver.matrix();
        const VectorX<double> constant = VectorX<double>::NullaryExpr(n, [&] { return normal(generator); });
        VectorX<double> bound = VectorX<double>::NullaryExpr(n, [&] { return std::abs(normal(generator)); });
        if (trial % 5 == 0) bound[0] = 0;
        solver.constant() = constant;
        const auto outcome = solver.solve(bound, std::vector<Zone>(static_cast<std::size_t>(n), Zone::stick));
        CAPTURE(trial, n, outcome.rounds, outcome.pivots, outcome.residual);
        REQUIRE(outcome.status == FrictionStatus::ok);
        REQUIRE(outcome.residual < 1e-11);
        if (outcome.pivots > 0) ++fallbacks;
        if (trial % 3 == 1 && n < 4) CHECK(outcome.pivots == 0);
        // the conditions, from the definition
        const VectorX<double> slip = matrix * solver.traction() + constant;
        for (Eigen::Index i = 0; i < n; ++i) {
            const double p = solver.traction()[i];
            REQUIRE(std::abs(p) <= bound[i] * (1 + 1e-12));
            if (bound[i] - std::abs(p) > 1e-9 * bound[i]) REQUIRE(std::abs(slip[i]) < 1e-9);
            if (bound[i] > 0) REQUIRE(slip[i] * p < 1e-9);
        }
    }
    CHECK(fallbacks > 100);
}

TEST_CASE("steady force against Carter", "[friction]") {
    // errors that a mesh not fitted to the border is known to reach, at a creepage ratio of 0.5
    struct Case {
        bool cosine;
        Collocation scheme;
        double errors[4];
        double low, high;  // band of the observed order
    };
    const Case cases[] = {{false, half, {1.8e-2, 8.9e-3, 4.5e-3, 2.25e-3}, 0.9, 1.1},
                          {true, half, {3.0e-3, 9.1e-4, 2.7e-4, 7.75e-5}, 1.6, 2.0},
                          {true, {.alpha_L = 0, .alpha_T = 0.5}, {6.5e-4, 2.45e-4, 7.3e-5, 2.15e-5}, 1.4, 2.0}};
    for (const Case& expected : cases) {
        std::vector<double> sizes, errors;
        for (int k = 0; k < 4; ++k) {
            const Eigen::Index n = 20 << k;
            const Scene scene(expected.cosine ? cosine_mesh<double>(n) : uniform_mesh<double>(n), expected.scheme);
            const FrictionStep<double> point = from_scratch(scene.steady(), creepage(0.5));
            sizes.push_back(static_cast<double>(n));
            errors.push_back(force_ratio(point) / carter_force_ratio(0.5) - 1);
            CAPTURE(expected.cosine, expected.scheme.alpha_L, n, errors.back(), point.rounds);
            CHECK(point.status == FrictionStatus::ok);
            CHECK(point.complementarity_residual < 1e-12);
            CHECK(point.pivots == 0);
            CHECK(point.rounds <= 10);
            CHECK(std::abs(errors.back()) < 1.02 * expected.errors[k]);
        }
        const double order = observed_order(sizes, errors);
        CAPTURE(expected.cosine, expected.scheme.alpha_L, order);
        CHECK(order > expected.low);
        CHECK(order < expected.high);
    }
}

TEST_CASE("tractions, border and work of steady rolling against Carter", "[friction]") {
    std::vector<double> sizes, errors;
    for (const Eigen::Index n : {40, 80, 160}) {
        const Scene scene(cosine_mesh<double>(n));
        const SteadyFrictionModel<double> model = scene.steady();
        const FrictionState<double> rest = model.at_rest();
        FrictionState<double> state = rest;
        const FrictionStep<double> point = model.solve(rest, creepage(0.4), state);
        const double widest = scene.mesh.widths().maxCoeff();
        double largest = 0;
        for (Eigen::Index i = 0; i < n; ++i) {
            const double x = scene.mesh.centres()[i];
            largest = std::max(largest, std::abs(state.traction()[i] / peak - carter_friction_traction(x, 0.4)));
            const Zone zone = state.zones()[static_cast<std::size_t>(i)];
            if (x < carter_stick_border(0.4) - widest) CHECK(zone == Zone::slip_positive);
            if (x > carter_stick_border(0.4) + widest) CHECK(zone == Zone::stick);
            CHECK((zone == Zone::stick) == (state.slip()[i] == 0));
        }
        CAPTURE(n, largest);
        CHECK(largest < 3.0 / static_cast<double>(n));
        // in steady rolling all the work goes into slip: another road to the force
        sizes.push_back(static_cast<double>(n));
        errors.push_back(point.slip_work_per_width / (-point.force_per_width * creepage(0.4)) - 1);
        CHECK(point.slip_work_per_width > 0);
    }
    CAPTURE(errors);
    CHECK(std::abs(errors.back()) < 0.03);
    CHECK(observed_order(sizes, errors) > 0.8);
}

TEST_CASE("the fallback takes over where the zones cycle", "[friction]") {
    int fallbacks = 0;
    for (const double alpha_T : {0.5, 0.63}) {
        for (const Eigen::Index n : {20, 40, 80}) {
            const Scene scene(cosine_mesh<double>(n), {.alpha_L = 0, .alpha_T = alpha_T});
            const FrictionStep<double> point = from_scratch(scene.steady(), creepage(0.95));
            CAPTURE(alpha_T, n, point.rounds, point.pivots, point.complementarity_residual, force_ratio(point));
            CHECK(point.status == FrictionStatus::ok);
            CHECK(point.complementarity_residual < 1e-12);
            CHECK(std::abs(force_ratio(point) / carter_force_ratio(0.95) - 1) < 1e-3);
            if (alpha_T == 0.5 && n != 40) CHECK(point.pivots > 0);
            fallbacks += point.pivots > 0 ? 1 : 0;
        }
    }
    CHECK(fallbacks >= 4);
}

TEST_CASE("small creepage and much friction give the linear solutions", "[friction]") {
    for (const Collocation& scheme : {half, Collocation{}}) {
        const Scene scene(cosine_mesh<double>(30), scheme), grippy(cosine_mesh<double>(30), scheme, 1e9);
        const double linear = -solve_steady(scene.mesh, scheme, scene.kernel).c11;
        const double small = from_scratch(scene.steady(), 1e-9).force_per_width / 1e-9;
        const FrictionStep<double> gripped = from_scratch(grippy.steady(), 0.3);
        CHECK(std::abs(small / linear - 1) < 1e-12);
        CHECK(std::abs(gripped.force_per_width / 0.3 / linear - 1) < 1e-12);
        CHECK(std::abs(gripped.tangent_per_width / linear - 1) < 1e-12);
        CHECK(gripped.stick_count == 30);
        CHECK(gripped.slip_work_per_width == 0);

        // the linear stepper, step by step, whatever the integrator and the motion
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            const TransientModel<double> full_adhesion(scene.contact, scene.mesh, scheme, scene.kernel, unchecked,
                                                       integrator);
            const FrictionModel<double> model = grippy.transient(integrator), slippery = scene.transient(integrator);
            FrictionState<double> now = model.at_rest(), next = now, small_now = slippery.at_rest(),
                                  small_next = small_now;
            TransientState<double> linear_now = full_adhesion.at_rest(), linear_next = linear_now;
            using Motion = RigidMotion<double>;
            for (int step = 1; step <= 20; ++step) {
                const double xi = 0.1 * std::sin(0.3 * step), dq = step % 4 == 0 ? 0.5 : 0.2;
                const auto motion = [&](double scale) {
                    return step % 3 == 0   ? Motion(scale * xi)
                           : step % 3 == 1 ? Motion::linear(scale * 0.02, scale * xi)
                                           : Motion::shift(scale * xi);
                };
                const TransientStep<double> expected = full_adhesion.advance(linear_now, dq, motion(1), linear_next);
                const FrictionStep<double> rolled = model.advance(now, dq, motion(1), next);
                slippery.advance(small_now, dq, motion(1e-8), small_next);
                std::swap(now, next);
                std::swap(small_now, small_next);
                std::swap(linear_now, linear_next);
                const VectorX<double>& traction = linear_now.traction;
                const double scale = traction.cwiseAbs().maxCoeff();
                CAPTURE(scheme.alpha_L, static_cast<int>(integrator), step);
                CHECK((now.traction() - traction).cwiseAbs().maxCoeff() < 1e-11 * scale);
                CHECK((1e8 * small_now.traction() - traction).cwiseAbs().maxCoeff() < 1e-11 * scale);
                CHECK(std::abs(rolled.force / expected.force - 1) < 1e-11);
                CHECK(std::abs(rolled.tangent / expected.tangent - 1) < 1e-11);
            }
        }
    }
}

TEST_CASE("mirrored creepage mirrors the solution", "[friction]") {
    const Scene scene(cosine_mesh<double>(40));
    const SteadyFrictionModel<double> model = scene.steady();
    for (const double ratio : {0.1, 0.5, 0.9, 1.2}) {
        const FrictionStep<double> plus = from_scratch(model, creepage(ratio));
        const FrictionStep<double> minus = from_scratch(model, creepage(-ratio));
        CHECK(plus.force_per_width == Approx(-minus.force_per_width).epsilon(1e-14));
        CHECK(plus.tangent_per_width == Approx(minus.tangent_per_width).epsilon(1e-12).margin(1e-12));
        CHECK(plus.slip_work_per_width == Approx(minus.slip_work_per_width).epsilon(1e-13));
    }
}

TEST_CASE("a creep curve: warm starts, tangent and concavity", "[friction]") {
    const Scene scene(cosine_mesh<double>(40));
    const SteadyFrictionModel<double> model = scene.steady();
    FrictionState<double> now = model.at_rest(), next = now;
    double force_before = 0, slope_before = std::numeric_limits<double>::infinity();
    for (int k = 1; k <= 120; ++k) {
        const double xi = creepage(0.01 * k);
        const FrictionStep<double> point = model.solve(now, xi, next);
        std::swap(now, next);
        CAPTURE(k);
        CHECK(point.force_per_width == Approx(from_scratch(model, xi).force_per_width).epsilon(1e-12));
        const double slope = (point.force_per_width - force_before) / creepage(0.01);
        CHECK(slope <= 1e-9);  // the force grows against the creepage, and ever less
        CHECK(-slope <= slope_before + 1e-9);
        force_before = point.force_per_width;
        slope_before = -slope;
        // the curve of a mesh is piecewise straight: a difference quotient that crosses no kink is exact
        const double delta = 1e-7 * peak;
        const FrictionStep<double> above = from_scratch(model, xi + delta), below = from_scratch(model, xi - delta);
        if (above.stick_count == below.stick_count) {
            const double quotient = (above.force_per_width - below.force_per_width) / (2 * delta);
            CHECK(point.tangent_per_width == Approx(quotient).epsilon(1e-6).margin(1e-7));
        }
    }
}

TEST_CASE("the tangent of a step lies between the difference quotients on both sides", "[friction]") {
    // equal to them wherever the step is smooth in the creepage; where an element is just at its border, they differ
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> uniform(-1.5, 1.5);
    using Motion = RigidMotion<double>;
    const Scene scene(cosine_mesh<double>(20), half, 1, 10);
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        const FrictionModel<double> model = scene.transient(integrator);
        FrictionState<double> now = model.at_rest(), next = now, probe = now;
        int slid = 0, stuck = 0, mixed = 0;
        for (int k = 0; k < 300; ++k) {
            const bool faint = k % 15 < 2;
            if (k % 15 == 0) now = model.at_rest();
            const double dq = k % 40 < 20 ? 0.1 : 1.0, start = creepage(faint ? 0.001 : uniform(generator));
            const double end = creepage(faint ? 0.001 : k % 10 == 5 ? 20.0 : uniform(generator));
            const auto force = [&](double change) {
                const Motion motion = k % 3 == 0   ? Motion(end + change)
                                      : k % 3 == 1 ? Motion::linear(start, end + change)
                                                   : Motion::shift(dq * end + change);
                return model.advance(now, dq, motion, change == 0 ? next : probe);
            };
            const FrictionStep<double> step = force(0);
            const double change = 1e-7 * peak;
            const double above = (force(change).force_per_width - step.force_per_width) / change;
            const double below = (step.force_per_width - force(-change).force_per_width) / change;
            CAPTURE(static_cast<int>(integrator), k, dq, step.stick_count, step.tangent_per_width, above, below);
            CHECK(step.tangent_per_width > std::min(above, below) - 1e-6);
            CHECK(step.tangent_per_width < std::max(above, below) + 1e-6);
            CHECK(step.tangent == Approx(2 * 10 * step.tangent_per_width).epsilon(1e-14));
            ++(step.stick_count == 0 ? slid : step.stick_count == 20 ? stuck : mixed);
            std::swap(now, next);
        }
        CAPTURE(slid, stuck, mixed);
        CHECK(std::min({slid, stuck, mixed}) > 5);
    }
}

TEST_CASE("Cattaneo's shift", "[friction]") {
    for (const double force : {-0.4, 0.75}) {
        std::vector<double> sizes, errors;
        for (const Eigen::Index n : {20, 40, 80}) {
            const Scene scene(cosine_mesh<double>(n), {.alpha_L = 0, .alpha_T = 0}, 1, 100);
            const FrictionModel<double> model = scene.transient();
            const FrictionState<double> rest = model.at_rest();
            FrictionState<double> shifted = rest;
            const double shift = peak * cattaneo_shift(force, nu, 100.0);
            const FrictionStep<double> step = model.shift(rest, shift, shifted);
            sizes.push_back(static_cast<double>(n));
            errors.push_back(force_ratio(step) / force - 1);
            CAPTURE(force, n, errors.back());
            CHECK(step.status == FrictionStatus::ok);
            // without rolling the mesh knows no direction
            CHECK((shifted.traction() - shifted.traction().reverse()).cwiseAbs().maxCoeff() < 1e-12 * peak);
            const double c = cattaneo_stick_half_length(force);
            for (Eigen::Index i = 0; i < n; ++i) {
                const double x = scene.mesh.centres()[i];
                if (std::abs(std::abs(x) - c) < scene.mesh.widths()[i]) continue;
                CHECK((shifted.zones()[static_cast<std::size_t>(i)] == Zone::stick) == (std::abs(x) < c));
                CHECK(std::abs(shifted.traction()[i] / peak - cattaneo_traction(x, force)) <
                      1.5 / static_cast<double>(n));
            }
            const double delta = 1e-7 * shift;
            const FrictionStep<double> more = model.shift(rest, shift + delta, shifted);
            CHECK(step.tangent_per_width ==
                  Approx((more.force_per_width - step.force_per_width) / delta).epsilon(1e-5));
        }
        CHECK(std::abs(errors[1]) < 5e-4);
        CHECK(observed_order(sizes, errors) > 1.5);
    }
}

TEST_CASE("rolling at constant creepage settles at the steady solution", "[friction]") {
    const Scene scene(cosine_mesh<double>(40), half, 1, 10);
    const FrictionModel<double> model = scene.transient();
    const FrictionStep<double> steady = from_scratch(scene.steady(), creepage(0.6));
    FrictionState<double> now = model.at_rest(), next = now;
    // from rest, and from a shift beyond what rolling leads to
    for (const double shift : {0.0, 4.0}) {
        now = model.at_rest();
        FrictionStep<double> step = model.shift(now, shift * peak, next);
        std::swap(now, next);
        for (int k = 0; k < 2000; ++k) {
            step = model.advance(now, 0.1, creepage(0.6), next);
            std::swap(now, next);
        }
        CAPTURE(shift);
        CHECK(step.force_per_width == Approx(steady.force_per_width).epsilon(1e-10));
        CHECK(step.stick_count == steady.stick_count);
        CHECK(step.slip_work_per_width / 0.1 == Approx(steady.slip_work_per_width).epsilon(1e-9));
    }
    FrictionState<double> ready = model.at_rest();
    const FrictionStep<double> found = model.steady(next, creepage(0.6), ready);
    CHECK(found.status == FrictionStatus::ok);
    CHECK(found.force_per_width == Approx(steady.force_per_width).epsilon(1e-12));
    CHECK(model.force(ready) == Approx(found.force).epsilon(1e-14));
    CHECK((ready.traction() - now.traction()).cwiseAbs().maxCoeff() < 1e-9 * peak);
    const FrictionStep<double> stays = model.advance(ready, 0.3, creepage(0.6), next);
    CHECK(stays.force_per_width == Approx(steady.force_per_width).epsilon(1e-12));
    // a state that steady() has filled is no worse for a rigid shift, nor one of a shift for steady()
    FrictionState<double> fresh = model.at_rest();
    const double shifted = model.shift(now, 0.3 * peak, fresh).force_per_width;
    CHECK(model.shift(now, 0.3 * peak, ready).force_per_width == Approx(shifted).epsilon(1e-12));
    CHECK(model.steady(now, creepage(0.6), fresh).force_per_width == Approx(steady.force_per_width).epsilon(1e-12));
}

// Results at q = 2 in steps of equal length. The creepage rises, and makes elements slip one after another.
struct History {
    double force_ratio, work;
};
History roll_to_two(const Scene& scene, Integrator integrator, int steps) {
    const FrictionModel<double> model = scene.transient(integrator);
    FrictionState<double> now = model.at_rest(), next = now;
    FrictionStep<double> step;
    const double dq = 2.0 / steps;
    const auto xi = [&](int k) { return creepage(0.9 * std::sin(dq * k)); };
    double work = 0;
    for (int k = 0; k < steps; ++k) {
        step = model.advance(now, dq, RigidMotion<double>::linear(xi(k), xi(k + 1)), next);
        REQUIRE(step.status == FrictionStatus::ok);
        work += step.slip_work_per_width;
        std::swap(now, next);
    }
    return {force_ratio(step), work};
}

TEST_CASE("orders in dq of the force and of the slip work", "[friction]") {
    const Scene scene(cosine_mesh<double>(20), half, 1, 10);
    const History reference = roll_to_two(scene, Integrator::sdirk2, 3200);
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        std::vector<double> sizes, forces, works;
        for (const int steps : {20, 40, 80, 160}) {
            const History history = roll_to_two(scene, integrator, steps);
            sizes.push_back(steps);
            forces.push_back(history.force_ratio - reference.force_ratio);
            works.push_back(history.work / reference.work - 1);
        }
        const double order = integrator == Integrator::sdirk2 ? 2 : 1;
        CAPTURE(static_cast<int>(integrator), forces, works);
        CHECK(std::abs(observed_order(sizes, forces) - order) < 0.1 * order);
        CHECK(std::abs(observed_order(sizes, works) - order) < 0.15 * order);
        // the tenth part of a contact is a step good for a part in a thousand, or one in a hundred
        CHECK(std::abs(forces[0]) < (integrator == Integrator::sdirk2 ? 1e-3 : 2e-2));
    }
}

// Coulomb's law of tractions and slip, from the definition, but for rounding; the work that the slip turns into heat.
double lawful_work(const Scene& scene, const VectorX<double>& traction, const VectorX<double>& slip, double rounding) {
    double work = 0;
    for (Eigen::Index i = 0; i < traction.size(); ++i) {
        const double p = traction[i], bound = scene.friction.normal_pressure[i];
        REQUIRE(std::abs(p) <= bound + rounding * peak);
        if (std::abs(p) < bound - 10 * rounding * peak) REQUIRE(std::abs(slip[i]) < rounding * peak);
        REQUIRE(p * slip[i] <= rounding * peak * peak);
        work -= scene.mesh.widths()[i] * p * slip[i];
    }
    return work;
}

TEST_CASE("every step keeps the law, whatever the history", "[friction]") {
    std::mt19937 generator(11);
    std::uniform_real_distribution<double> uniform(-1.5, 1.5);
    for (const Collocation& scheme : {half, Collocation{.alpha_L = 0, .alpha_T = 0.5}}) {
        const Scene scene(cosine_mesh<double>(24), scheme, 1, 10);
        const auto [G, G_prime] = assemble(scene.mesh, scheme, scene.kernel);
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            const FrictionModel<double> model = scene.transient(integrator);
            FrictionState<double> now = model.at_rest(), next = now;
            for (int k = 0; k < 300; ++k) {
                const double xi = creepage(uniform(generator)), dq = k % 7 == 0 ? 0.4 : k % 11 == 0 ? 0.01 : 0.1;
                const FrictionStep<double> step = model.advance(now, dq, xi, next);
                CAPTURE(static_cast<int>(integrator), k, step.rounds, step.pivots, step.complementarity_residual);
                REQUIRE(step.status == FrictionStatus::ok);
                REQUIRE(step.slip_work_per_width >= 0);
                const VectorX<double> imposed = VectorX<double>::Constant(24, xi * dq);
                const VectorX<double>& slip = next.slip();
                VectorX<double> last =
                    G * (next.traction() - now.traction()) - dq * G_prime * next.traction() + imposed;
                double work = 0, rounding = 1e-11;
                if (integrator == Integrator::sdirk2) {
                    rounding = 1e-8;
                    // what the first stage did follows from what the whole step did
                    const double gamma = 1 - std::sqrt(0.5);
                    const VectorX<double> slope = imposed + G * (next.traction() - now.traction()) -
                                                  gamma * dq * G_prime * next.traction() - slip;
                    const VectorX<double> traction = dense::solve(G_prime, slope) / ((1 - gamma) * dq);
                    const VectorX<double> first =
                        gamma * imposed - gamma * dq * G_prime * traction + G * (traction - now.traction());
                    work = (1 - gamma) / gamma * lawful_work(scene, traction, first, rounding);
                    last = slip - (1 - gamma) / gamma * first;
                } else {
                    REQUIRE((slip - last).cwiseAbs().maxCoeff() < 1e-12 * peak);
                }
                work += lawful_work(scene, next.traction(), last, rounding);
                CHECK(step.slip_work_per_width == Approx(work).epsilon(1e-6).margin(1e-14));
                std::swap(now, next);
            }
        }
    }
}

TEST_CASE("a step is as good as the worse of its two stages", "[friction]") {
    // The rows of G are alike but for rounding: which right-hand sides then have a solution to rounding is chance. The
    // first stage from rest is a step of implicit Euler.
    std::mt19937 generator(5);
    std::normal_distribution<double> normal;
    const auto random = [&](Eigen::Index columns) {
        return MatrixX<double>(MatrixX<double>::NullaryExpr(3, columns, [&] { return normal(generator); }));
    };
    const Contact<double> contact = Contact<double>::dimensionless(10, nu);
    const double gamma = 1 - std::numbers::sqrt2 / 2;
    int failed_first = 0, worse_last = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const MatrixX<double> G = 1e6 * (MatrixX<double>::Ones(3, 1) * random(1).transpose() + 1e-14 * random(3));
        const auto step = [&](Integrator integrator, double dq, double xi) {
            const FrictionModel<double> model(contact, {G, MatrixX<double>::Zero(3, 3)},
                                              ArrayX<double>::Constant(3, 2.0 / 3),
                                              {1.0, ArrayX<double>::Constant(3, peak)}, integrator);
            const FrictionState<double> rest = model.at_rest();
            FrictionState<double> to = rest;
            return model.advance(rest, dq, xi, to);
        };
        const double xi = normal(generator);
        const FrictionStep<double> first = step(Integrator::implicit_euler, gamma * 0.1, xi);
        const FrictionStep<double> whole = step(Integrator::sdirk2, 0.1, xi);
        CAPTURE(trial, first.complementarity_residual, whole.complementarity_residual);
        CHECK(whole.complementarity_residual >= first.complementarity_residual);
        if (first.status == FrictionStatus::no_solution) {
            ++failed_first;
            CHECK(whole.status == FrictionStatus::no_solution);
        }
        if (whole.complementarity_residual > first.complementarity_residual) ++worse_last;
    }
    CAPTURE(failed_first, worse_last);
    CHECK(failed_first > 10);
    CHECK(worse_last > 0);
}

TEST_CASE("units: the same problem in SI", "[friction]") {
    const double a = 6e-3, G = 8e10, b = 0.06, mu = 0.3;
    const Contact<double> contact({.half_length = a, .half_width = b, .shear_modulus = G, .poisson_ratio = nu});
    const StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);
    const Mesh<double> mesh = cosine_mesh<double>(20);
    const ArrayX<double> shape = mean_hertz_pressure(mesh);
    const FrictionModel<double> model(contact, mesh, half, kernel, {mu, peak * G / mu * shape});
    const FrictionModel<double> plain(Contact<double>::dimensionless(b / a, nu), mesh, half, kernel,
                                      {1.0, peak * shape});
    FrictionState<double> now = model.at_rest(), next = now, plain_now = plain.at_rest(), plain_next = plain_now;
    for (int k = 0; k < 10; ++k) {
        const FrictionStep<double> step =
            k == 3 ? model.shift(now, a * peak, next) : model.advance(now, 0.2 * a, creepage(0.7), next);
        const FrictionStep<double> same = k == 3 ? plain.shift(plain_now, peak, plain_next)
                                                 : plain.advance(plain_now, 0.2, creepage(0.7), plain_next);
        CHECK(step.force_per_width == Approx(a * G * same.force_per_width).epsilon(1e-12));
        CHECK(step.force == Approx(2 * b * step.force_per_width).epsilon(1e-14));
        CHECK(model.force(next) == Approx(step.force).epsilon(1e-14));
        CHECK(step.tangent_per_width == Approx((k == 3 ? G : a * G) * same.tangent_per_width).epsilon(1e-11));
        CHECK(step.slip_work_per_width == Approx(a * a * G * same.slip_work_per_width).epsilon(1e-11));
        CHECK((next.slip() - a * plain_next.slip()).cwiseAbs().maxCoeff() < 1e-13 * a * peak);
        std::swap(now, next);
        std::swap(plain_now, plain_next);
    }
}

TEST_CASE("a mesh fitted to the border", "[friction]") {
    const Scene scene(cosine_mesh<double>(40));
    const Pressure pressure = [](const Mesh<double>& mesh) { return ArrayX<double>(peak * mean_hertz_pressure(mesh)); };
    for (const double ratio : {-0.5, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9}) {
        const auto fitted = fitted_solution(scene, 40, pressure, creepage(ratio));
        CAPTURE(ratio, fitted.force_per_width, fitted.complementarity_residual, fitted.evaluations);
        CHECK(fitted.fitted);
        CHECK(fitted.status == FrictionStatus::ok);
        CHECK(std::abs(-fitted.force_per_width / full_force / carter_force_ratio(ratio) - 1) < 8e-5);
        CHECK(std::abs(fitted.border - carter_stick_border(ratio)) < 5e-3);
        CHECK(fitted.slip_work_per_width > 0);
        CHECK(fitted.evaluations <= 14);
        // by the creepage: d F / d delta = -mu N 2 (1 - delta)
        CHECK(fitted.tangent_per_width * creepage(1) / -full_force == Approx(2 * (1 - std::abs(ratio))).margin(0.01));
        const double sign = ratio < 0 ? -1 : 1;
        for (Eigen::Index i = 0; i < 40; ++i) {
            const double x = fitted.mesh.centres()[i];
            CHECK(std::abs(fitted.traction[i] / peak - carter_friction_traction(x, ratio)) < 0.15);
            CHECK((x < fitted.border ? sign * fitted.slip[i] > -1e-4 * peak : fitted.slip[i] == 0));
        }
        CHECK(sign * fitted.slip.sum() > 0);
    }
    std::vector<double> sizes, errors;
    for (const Eigen::Index n : {20, 40, 80, 160}) {
        const auto fitted = fitted_solution(scene, n, pressure, creepage(0.5));
        sizes.push_back(static_cast<double>(n));
        errors.push_back(-fitted.force_per_width / full_force / carter_force_ratio(0.5) - 1);
    }
    CAPTURE(errors);
    CHECK(observed_order(sizes, errors) > 3.2);
    // beyond full sliding, and just below, where it hands over to the plain solver
    const auto sliding = fitted_solution(scene, 40, pressure, creepage(1.1));
    CHECK(-sliding.force_per_width == Approx(full_force).epsilon(1e-13));
    CHECK(sliding.border == 1);
    // without creepage, where there is no border to seek
    const auto still = fitted_solution(scene, 40, pressure, 0);
    CHECK(still.status == FrictionStatus::ok);
    CHECK_FALSE(still.fitted);
    CHECK(still.force_per_width == 0);
    CHECK(still.evaluations == 2);
    CHECK(still.tangent_per_width * creepage(1) / -full_force == Approx(2).margin(1e-3));
    const auto unknown = fitted_solution(scene, 40, pressure, std::numeric_limits<double>::quiet_NaN());
    CHECK(unknown.status == FrictionStatus::not_finite);
    CHECK(std::isnan(unknown.force_per_width));
    const auto nearly = fitted_solution(scene, 40, pressure, creepage(0.9999));
    CHECK(nearly.status == FrictionStatus::ok);
    CHECK(std::abs(-nearly.force_per_width / full_force - 1) < 1e-4);
}

TEST_CASE("a mesh fitted to the border under another pressure", "[friction]") {
    // leaning to the leading edge; the reference is the plain solver on a mesh that is an order finer
    const Pressure pressure = [](const Mesh<double>& mesh) {
        return ArrayX<double>(peak * (1 + 0.4 * mesh.centres()) * mean_hertz_pressure(mesh));
    };
    for (const double ratio : {0.3, 0.7}) {
        Scene scene(cosine_mesh<double>(640));
        scene.friction.normal_pressure = pressure(scene.mesh);
        const double reference = from_scratch(scene.steady(), creepage(ratio)).force_per_width;
        const auto fitted = fitted_solution(scene, 40, pressure, creepage(ratio));
        CAPTURE(ratio, fitted.fitted, fitted.force_per_width / reference - 1);
        CHECK(fitted.fitted);
        CHECK(std::abs(fitted.force_per_width / reference - 1) < 1.5e-4);
    }
    // two humps slip apart from each other: no single border
    const Pressure humps = [](const Mesh<double>& mesh) {
        return ArrayX<double>(peak * (0.02 + mesh.centres().square()) * mean_hertz_pressure(mesh));
    };
    Scene scene(cosine_mesh<double>(40));
    scene.friction.normal_pressure = humps(scene.mesh);
    const auto fitted = fitted_solution(scene, 40, humps, creepage(0.1));
    CAPTURE(fitted.fitted);
    CHECK(fitted.status == FrictionStatus::ok);
    CHECK_FALSE(fitted.fitted);
    CHECK(fitted.force_per_width == Approx(from_scratch(scene.steady(), creepage(0.1)).force_per_width).epsilon(1e-12));
}

TEST_CASE("Hertz's line contact", "[friction]") {
    const HertzLine<double> hertz({.load_per_width = 1e6,
                                   .combined_radius = 0.46,
                                   .body_1 = {.young_modulus = 2.1e11, .poisson_ratio = 0.28},
                                   .body_2 = {.young_modulus = 2.1e11, .poisson_ratio = 0.28}});
    // equal bodies: E* = G/(1-nu), and p0 = E* a/(2R) by the curvature of the pressed surfaces
    const Contact<double> contact = hertz.contact(0.01);
    CHECK(contact.shear_modulus() == Approx(2.1e11 / 2.56).epsilon(1e-14));
    CHECK(contact.poisson_ratio() == Approx(0.28).epsilon(1e-14));
    CHECK(contact.half_length() == hertz.half_length());
    // a soft body on a hard one: half the compliance, and Poisson's ratio of the soft one
    const HertzLine<double> soft({.load_per_width = 1e3,
                                  .combined_radius = 0.1,
                                  .body_1 = {.young_modulus = 1e6, .poisson_ratio = 0.4},
                                  .body_2 = {.young_modulus = 1e18, .poisson_ratio = 0.1}});
    CHECK(soft.contact(1).shear_modulus() == Approx(2 * 1e6 / 2.8).epsilon(1e-10));
    CHECK(soft.contact(1).poisson_ratio() == Approx(0.4).epsilon(1e-10));
    CHECK(hertz.peak_pressure() ==
          Approx(contact.shear_modulus() / 0.72 * hertz.half_length() / 2 / 0.46).epsilon(1e-13));
    for (const Mesh<double>& mesh :
         {uniform_mesh<double>(1), cosine_mesh<double>(2000), geometric_mesh<double>(30, 1e6)}) {
        const ArrayX<double> mean = hertz.mean_pressure(mesh);
        CHECK(hertz.half_length() * (mesh.widths() * mean).sum() == Approx(1e6).epsilon(1e-13));
        CHECK(mean.maxCoeff() <= hertz.peak_pressure());
    }
    // the first element of a fine mesh: mean of sqrt(2 t) (1 - t/4 ...) over its width w
    const Mesh<double> fine = cosine_mesh<double>(100000);
    const double w = fine.widths()[0];
    CHECK(mean_hertz_pressure(fine)[0] == Approx(2.0 / 3 * std::sqrt(2 * w) * (1 - 0.15 * w)).epsilon(1e-14));
}

TEST_CASE("a pressure given at points", "[friction]") {
    // means are exact for any mesh, however its edges and the points lie
    const auto array = [](std::initializer_list<double> values) {
        return ArrayX<double>(Eigen::Map<const ArrayX<double>>(values.begin(), Eigen::Index(values.size())));
    };
    const PressureTable<double> table(array({-0.9, -0.25, -0.25, 0.6}), array({1, 3, 0.5, 0.5}));
    CHECK(table.integral() == Approx(0.65 * 2 + 0.85 * 0.5).epsilon(1e-14));
    const auto antiderivative = [](double x) {
        const double slope = 2 / 0.65, first = std::clamp(x + 0.9, 0.0, 0.65);
        return first + slope * first * first / 2 + 0.5 * std::clamp(x + 0.25, 0.0, 0.85);
    };
    for (const Mesh<double>& mesh : {uniform_mesh<double>(1), uniform_mesh<double>(8), cosine_mesh<double>(37)}) {
        const ArrayX<double> mean = table(mesh);
        for (Eigen::Index i = 0; i < mesh.size(); ++i) {
            const double low = mesh.edges_from_trailing()[i] - 1, high = mesh.edges_from_trailing()[i + 1] - 1;
            CHECK(mean[i] ==
                  Approx((antiderivative(high) - antiderivative(low)) / (high - low)).epsilon(1e-11).margin(1e-14));
        }
    }
    // a constant stays what it is to the last digit but one on the smallest elements
    const Mesh<double> fine = cosine_mesh<double>(100000);
    const ArrayX<double> constant = PressureTable<double>(array({-1, 1}), array({0.7, 0.7}))(fine);
    CHECK((constant / 0.7 - 1).abs().maxCoeff() < 1e-15);
    CHECK_THROWS_WITH((PressureTable<double>(array({-1, 1}), array({0.7}))),
                      "PressureTable: number of pressures = 1 must equal that of places");
    CHECK_THROWS_WITH((PressureTable<double>(array({-1, 1.5}), array({1, 1}))),
                      "PressureTable: x/a = 1.5 must lie in [-1, 1]");
    CHECK_THROWS_WITH((PressureTable<double>(array({-1.5, 1}), array({1, 1}))),
                      "PressureTable: x/a = -1.5 must lie in [-1, 1]");
    CHECK_THROWS_WITH((PressureTable<double>(array({0, -0.5}), array({1, 1}))),
                      "PressureTable: x/a = -0.5 must not lie behind the place before");
    CHECK_THROWS_WITH((PressureTable<double>(array({-1, 1}), array({1, -2}))),
                      "PressureTable: pressure = -2 must be finite and not negative");
    CHECK_THROWS_WITH((PressureTable<double>(array({0, 0}), array({1, 1}))),
                      "PressureTable: load = 0 must be positive and finite");
}

TEST_CASE("friction in every scalar type", "[friction]") {
    const Scene scene(cosine_mesh<double>(20), {.alpha_L = 0, .alpha_T = 0.5}, 1, 10);
    const InfluenceMatrices<double> matrices = assemble(scene.mesh, scene.scheme, scene.kernel);
    const auto ratios = [&]<class Scalar>(Scalar) {
        const auto [rolled, steady] = rolled_and_steady<Scalar>(scene.contact, matrices, scene.mesh.widths(),
                                                                scene.friction.normal_pressure, creepage(1));
        return std::pair(double(rolled) / full_force, double(steady) / full_force);
    };
    const auto [rolled, steady] = ratios(1.0);
    const auto [rolled_float, steady_float] = ratios(1.0f);
    const auto [rolled_long, steady_long] = ratios(1.0L);
    CHECK(std::abs(rolled_float - rolled) < 1e-4);
    CHECK(std::abs(steady_float - steady) < 1e-4);
    CHECK(std::abs(rolled_long - rolled) < 1e-12);
    CHECK(std::abs(steady_long - steady) < 1e-12);
}

TEST_CASE("bad input to friction is refused by name, or answered by a status", "[friction]") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    Scene scene(cosine_mesh<double>(8));
    const CoulombFriction<double> good = scene.friction;
    const auto refused = [&](const CoulombFriction<double>& friction, const std::string& text) {
        scene.friction = friction;
        CHECK_THROWS_WITH(scene.steady(), "SteadyFrictionModel: " + text);
        CHECK_THROWS_WITH(scene.transient(), "FrictionModel: " + text);
    };
    refused({-0.1, good.normal_pressure}, "friction_coefficient = -0.1 must be finite and not negative");
    refused({nan, good.normal_pressure}, "friction_coefficient = nan must be finite and not negative");
    refused({1, good.normal_pressure.head(7)}, "length of normal_pressure = 7 must equal the number of elements");
    refused({1, ArrayX<double>::Zero(8)}, "largest normal_pressure = 0 must be positive");
    ArrayX<double> pressure = good.normal_pressure;
    pressure[3] = -2;
    refused({1, pressure}, "normal_pressure = -2 must be finite and not negative");
    pressure[3] = inf;
    refused({1, pressure}, "normal_pressure = inf must be finite and not negative");
    CHECK_THROWS_WITH(
        SteadyFrictionModel<double>(scene.contact, MatrixX<double>::Zero(7, 8), scene.mesh.widths(), good),
        "SteadyFrictionModel: size of an influence matrix = 7 must equal the number of unknown elements");
    InfluenceMatrices<double> broken{.G = MatrixX<double>::Identity(8, 8), .G_prime = -MatrixX<double>::Identity(8, 8)};
    broken.G_prime(6, 1) = inf;
    CHECK_THROWS_WITH(FrictionModel<double>(scene.contact, broken, scene.mesh.widths(), good),
                      "FrictionModel: G_prime(6, 1) = inf must be finite (row and column counted from 0)");
    broken.G(2, 5) = nan;
    CHECK_THROWS_WITH(FrictionModel<double>(scene.contact, broken, scene.mesh.widths(), good),
                      "FrictionModel: G(2, 5) = nan must be finite (row and column counted from 0)");
    CHECK(FrictionStep<double>{}.status == FrictionStatus::not_finite);
    CHECK_THROWS_AS(HertzLine<double>({.load_per_width = 0, .combined_radius = 1, .body_1 = {1, 0}, .body_2 = {1, 0}}),
                    std::invalid_argument);
    CHECK_THROWS_WITH(
        HertzLine<double>({.load_per_width = 1, .combined_radius = 1, .body_1 = {1, 0}, .body_2 = {1, 0.7}}),
        "HertzLine: poisson_ratio = 0.7 must lie in [0, 0.5]");
    CHECK_THROWS_AS(border_mesh<double>(3, 3, 2.0), std::invalid_argument);

    scene.friction = good;
    CHECK_THROWS_WITH(Scene(cosine_mesh<double>(8), half, 1, 0.1).transient(),
                      Catch::Matchers::ContainsSubstring("PlaneKernel: Lambda"));
    const FrictionModel<double> model = scene.transient();
    const SteadyFrictionModel<double> steady = scene.steady();
    FrictionState<double> now = model.at_rest(), next = now,
                          other = Scene(cosine_mesh<double>(9)).transient().at_rest();
    CHECK(model.advance(now, 0.0, 1e-3, next).status == FrictionStatus::invalid_step);
    CHECK(model.advance(now, nan, 1e-3, next).status == FrictionStatus::invalid_step);
    CHECK(model.advance(now, 0.1, nan, next).status == FrictionStatus::not_finite);
    CHECK(model.shift(now, inf, next).status == FrictionStatus::not_finite);
    CHECK(model.advance(now, -0.1, 1e-3, next).status == FrictionStatus::invalid_step);
    CHECK(model.advance(now, inf, 1e-3, next).status == FrictionStatus::invalid_step);
    CHECK(model.advance(now, -0.1, RigidMotion<double>::shift(1e-3), next).status == FrictionStatus::invalid_step);
    CHECK(model.advance(now, 0.1, RigidMotion<double>::linear(nan, 1e-3), next).status == FrictionStatus::not_finite);
    CHECK_THROWS_WITH(scene.transient(Integrator::matrix_exponential),
                      "FrictionModel: integrator = 2 must be implicit_euler (0) or sdirk2 (1)");
    // what is refused leaves both states alone
    REQUIRE(model.advance(now, 0.1, 1e-3, next).status == FrictionStatus::ok);
    const VectorX<double> kept_traction = next.traction(), kept_slip = next.slip();
    const std::vector<Zone> kept_zones = next.zones();
    for (const double dq : {0.0, -1.0, nan, 0.1}) {
        CHECK(model.advance(now, dq, dq == 0.1 ? nan : 2e-3, next).status != FrictionStatus::ok);
        CHECK(next.traction() == kept_traction);
        CHECK(next.slip() == kept_slip);
        CHECK(next.zones() == kept_zones);
        CHECK(now.traction().isZero(0));
    }
    CHECK(model.advance(now, 0.1, 1e-3, now).status == FrictionStatus::wrong_state);
    CHECK(model.advance(now, 0.1, 1e-3, other).status == FrictionStatus::wrong_state);
    CHECK(steady.solve(now, nan, next).status == FrictionStatus::not_finite);
    CHECK(std::isnan(model.advance(now, 0.1, nan, next).force));
    CHECK(model.steady(now, nan, next).status == FrictionStatus::not_finite);
    CHECK(model.steady(now, 1e-3, now).status == FrictionStatus::wrong_state);
    CHECK(model.steady(now, 1e-3, other).status == FrictionStatus::wrong_state);
    // a state that another model has used is not taken for one's own
    const FrictionModel<double> slippery = Scene(cosine_mesh<double>(8), half, 0.1, 3).transient();
    FrictionState<double> fresh = slippery.at_rest(), fresher = model.at_rest();
    const double borrowed = slippery.advance(now, 0.1, 1e-3, next).force_per_width;
    CHECK(borrowed == Approx(slippery.advance(now, 0.1, 1e-3, fresh).force_per_width).epsilon(1e-13));
    const double returned = model.advance(now, 0.1, 1e-3, next).force_per_width;
    CHECK(returned == Approx(model.advance(now, 0.1, 1e-3, fresher).force_per_width).epsilon(1e-13));
    CHECK(std::abs(returned / borrowed - 1) > 0.01);
    // no friction, no force; no pressure at an element, no traction there
    CHECK(Scene(cosine_mesh<double>(8), half, 0).transient().advance(now, 0.1, 1e-3, fresh).force_per_width == 0);
    scene.friction.normal_pressure[5] = 0;
    const FrictionModel<double> gap = scene.transient();
    CHECK(gap.advance(now, 0.1, 1e-3, next).status == FrictionStatus::ok);
    CHECK(next.traction()[5] == 0);
}

}  // namespace
