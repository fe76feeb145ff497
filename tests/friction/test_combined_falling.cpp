// rollbem/friction/steady.hpp, combined_falling_transient.hpp: against one direction, against constant
// friction, by symmetries, and by the definition of the law.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <rollbem/compiled/friction.hpp>

#include "any_law.hpp"
#include "falling_scene.hpp"
#include "support/catch.hpp"

namespace {

using falling_tests::a;
using falling_tests::AnyLaw;
using falling_tests::full_force;
using falling_tests::law;
using falling_tests::Law;
using falling_tests::least_velocity;
using falling_tests::Memory;
using falling_tests::peak_pressure;
using falling_tests::shear_modulus;
using namespace rollbem;
using Catch::Matchers::ContainsSubstring;

using Motion = RigidMotion<Creepage<double>>;
using State = FrictionState<2>;
using Step = FrictionStep<2>;
using Workspace = FrictionWorkspace<2>;
using Model = FrictionModel<Law, 2>;

constexpr double infinite = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
constexpr double rolling_speed = falling_tests::speed;

/// The wheel of falling_scene.hpp in both directions, with any Poisson's ratio.
struct Scene {
    explicit Scene(Mesh<double> mesh_, double distance_ = 0, double nu = falling_tests::poisson_ratio)
        : mesh(std::move(mesh_)),
          contact({.half_length = a, .half_width = 1000 * a, .shear_modulus = shear_modulus, .poisson_ratio = nu}),
          friction{law, peak_pressure * mean_hertz_pressure(mesh), {distance_, least_velocity}} {}

    PlaneKernel<double> longitudinal() const { return PlaneKernel<double>::longitudinal(contact); }
    PlaneKernel<double> lateral() const { return PlaneKernel<double>::lateral(contact); }
    ElementSystem<double> along() const { return rolling_system(mesh, scheme, longitudinal()); }
    ElementSystem<double> across() const { return rolling_system(mesh, scheme, lateral()); }
    SteadyFrictionModel<Law, 2> steady() const { return {contact, mesh, scheme, longitudinal(), lateral(), friction}; }
    Model transient(Integrator integrator = Integrator::sdirk2) const {
        return {contact, {along(), across()}, unchecked, friction, integrator};
    }

    Mesh<double> mesh;
    Contact<double> contact;
    Friction<Law> friction;
    Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
};

/// Draws that are the same on every machine.
struct Draws {
    explicit Draws(unsigned seed) : generator(seed) {}

    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
    }
    double decades(double low, double high) { return std::pow(10, uniform(low, high)); }

    std::mt19937 generator;
};

Creepage<double> turned(const Creepage<double>& v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.longitudinal - s * v.lateral, s * v.longitudinal + c * v.lateral};
}

TEST_CASE("In two directions the steady forces of a wheel at 45 m/s, along and across", "[friction]") {
    // -F/(mu_0 N) along, as in one direction; another program differs by less than 1.2e-4
    constexpr double creepages[5] = {5e-4, 1e-3, 2e-3, 5e-3, 1e-2};
    constexpr double distances[3] = {0, 2e-6, 10e-6};
    constexpr double forces[3][5] = {{0.34140, 0.59053, 0.80649, 0.68687, 0.61827},
                                     {0.34564, 0.60431, 0.84052, 0.70243, 0.62303},
                                     {0.34694, 0.61612, 0.90047, 0.78016, 0.65994}};
    for (int k = 0; k < 3; ++k) {
        const Scene scene(uniform_mesh<double>(160), distances[k]);
        const StripKernel<double> along = StripKernel<double>::longitudinal(scene.contact);
        const SteadyFrictionModel model(scene.contact, scene.mesh, scene.scheme, along,
                                        StripKernel<double>::lateral(scene.contact), scene.friction);
        Workspace workspace = model.workspace();
        const State rest = model.at_rest();
        State state = rest;
        for (int j = 0; j < 5; ++j) {
            const Step step = model.steady(rest, {creepages[j], 0}, rolling_speed, state, workspace);
            CAPTURE(distances[k], creepages[j]);
            CHECK(step.status == StepStatus::ok);
            CHECK(std::abs(-step.force_per_width.longitudinal / full_force - forces[k][j]) < 6e-6);
            CHECK(step.force_per_width.lateral == 0);
        }
    }
}

TEST_CASE("In two directions a law that is constant is Coulomb's", "[friction]") {
    const AnyLaw constant = [](double) { return 0.25; };
    const Scene scene(cosine_mesh<double>(24));
    const ArrayX<double>& pressure = scene.friction.normal_pressure;
    for (const double distance : {0.0, 3e-6}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            const FrictionModel<ConstantFriction<>, 2> expected(scene.contact, {scene.along(), scene.across()},
                                                                unchecked, {0.25, pressure}, integrator);
            const FrictionModel<AnyLaw, 2> model(scene.contact, {scene.along(), scene.across()}, unchecked,
                                                 {constant, pressure, {distance, 1e-3}}, integrator);
            Workspace workspace = model.workspace();
            FrictionWorkspace<2> expected_workspace = expected.workspace();
            State now = model.at_rest(), next = now;
            FrictionState<2> expected_now = expected.at_rest(), expected_next = expected_now;
            NormalLoad<double> load{pressure, a, pressure / 7};
            for (int k = 1; k <= 40; ++k) {
                const bool shifts = k % 5 == 0;
                const double dq = shifts ? 0 : 0.1 * a, duration = 0.1 * a / rolling_speed;
                const Motion motion =
                    shifts ? Motion::shift({1e-6, -2e-7}) : Motion::linear({1e-3, 5e-4}, {1e-3, 5e-5 * k});
                Step step, reference;
                if (k == 17) {
                    step = model.steady(now, {1e-3, 2e-3}, rolling_speed, next, workspace);
                    reference = expected.steady(expected_now, {1e-3, 2e-3}, expected_next, expected_workspace);
                } else if (k % 3 == 0) {
                    load.normal_pressure = pressure * (1 + 0.01 * k);
                    load.half_length = shifts ? now.half_length : a * (1 + 0.002 * k);
                    step = model.advance(now, {dq, duration}, motion, load, next, workspace);
                    reference = expected.advance(expected_now, dq, motion, load, expected_next, expected_workspace);
                    CHECK(step.tangent_by_load.longitudinal ==
                          Approx(reference.tangent_by_load.longitudinal).epsilon(1e-9));
                    CHECK(step.tangent_by_load.lateral == Approx(reference.tangent_by_load.lateral).epsilon(1e-9));
                } else {
                    step = model.advance(now, {dq, duration}, motion, next, workspace);
                    reference = expected.advance(expected_now, dq, motion, expected_next, expected_workspace);
                }
                std::swap(now, next);
                std::swap(expected_now, expected_next);
                CAPTURE(distance, name(integrator), k);
                REQUIRE(step.status == StepStatus::ok);
                CHECK(now.zones == expected_now.zones);
                CHECK((now.friction_coefficient - 0.25).abs().maxCoeff() < 1e-15);
                CHECK(step.force.longitudinal == Approx(reference.force.longitudinal).epsilon(1e-10));
                CHECK(step.force.lateral == Approx(reference.force.lateral).epsilon(1e-10));
                const auto& tangent = step.tangent;
                const auto& wanted = reference.tangent;
                const double margin = 1e-9 * std::abs(wanted.by_longitudinal.longitudinal);
                CHECK(std::abs(tangent.by_longitudinal.longitudinal - wanted.by_longitudinal.longitudinal) < margin);
                CHECK(std::abs(tangent.by_longitudinal.lateral - wanted.by_longitudinal.lateral) < margin);
                CHECK(std::abs(tangent.by_lateral.longitudinal - wanted.by_lateral.longitudinal) < margin);
                CHECK(std::abs(tangent.by_lateral.lateral - wanted.by_lateral.lateral) < margin);
                CHECK(step.slip_work_per_width == Approx(reference.slip_work_per_width).epsilon(1e-9));
                CHECK((workspace.slip() - expected_workspace.slip()).cwiseAbs().maxCoeff() < 1e-10 * dq + 1e-16);
            }
        }
    }
}

TEST_CASE("Without lateral creepage two directions are one", "[friction]") {
    for (const double distance : {0.0, 8e-6}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            Scene scene(cosine_mesh<double>(30), distance);
            scene.friction.turned = false;
            const ArrayX<double>& pressure = scene.friction.normal_pressure;
            for (const bool across : {false, true}) {
                // lateral creepage alone is one direction, too, with the lateral kernel
                const FrictionModel<Law> line(scene.contact, across ? scene.across() : scene.along(), unchecked,
                                              scene.friction, integrator);
                const Model model = scene.transient(integrator);
                const auto vector = [&](double size) {
                    return across ? Creepage<double>{0, size} : Creepage<double>{size, 0};
                };
                FrictionWorkspace<> line_workspace = line.workspace();
                Workspace workspace = model.workspace();
                FrictionState<> line_now = line.at_rest(), line_next = line_now;
                State now = model.at_rest(), next = now;
                NormalLoad<double> load{pressure, a, {}};
                int slipping = 0;
                for (int k = 1; k <= 60; ++k) {
                    const double size = 1.5e-3 + 2e-3 * std::sin(0.3 * k), duration = 0.1 * a / rolling_speed;
                    Step step;
                    FrictionStep<> expected;
                    if (k % 15 == 0) {
                        step = model.steady(now, vector(size), rolling_speed, next, workspace);
                        expected = line.steady(line_now, size, rolling_speed, line_next, line_workspace);
                    } else if (k % 4 == 0) {
                        step = model.shift(now, vector(1e-3 * size * a), duration, next, workspace);
                        expected = line.shift(line_now, 1e-3 * size * a, duration, line_next, line_workspace);
                    } else if (k % 2 == 0) {
                        load.normal_pressure = pressure * (1 + 0.005 * k);
                        load.half_length = a * (1 + 0.03 * std::sin(0.5 * k));
                        step = model.advance(now, {0.1 * a, duration}, vector(size), load, next, workspace);
                        expected = line.advance(line_now, {0.1 * a, duration}, size, load, line_next, line_workspace);
                    } else {
                        step = model.advance(now, {0.1 * a, duration}, vector(size), next, workspace);
                        expected = line.advance(line_now, {0.1 * a, duration}, size, line_next, line_workspace);
                    }
                    std::swap(now, next);
                    std::swap(line_now, line_next);
                    CAPTURE(distance, name(integrator), across, k);
                    REQUIRE(step.status == StepStatus::ok);
                    REQUIRE(expected.status == StepStatus::ok);
                    slipping += step.stick_count < 25 ? 1 : 0;
                    const auto part = [&](const TangentialForce<double>& force) {
                        return across ? force.lateral : force.longitudinal;
                    };
                    const auto tangent = part(across ? step.tangent.by_lateral : step.tangent.by_longitudinal);
                    CHECK(part(step.force) == Approx(expected.force).epsilon(1e-9));
                    CHECK(tangent == Approx(expected.tangent).epsilon(1e-7));
                    CHECK(step.slip_work_per_width == Approx(expected.slip_work_per_width).epsilon(1e-8).margin(1e-12));
                    const double off = (now.friction_coefficient - line_now.friction_coefficient).abs().maxCoeff();
                    CHECK(off < 1e-10);
                    CHECK(now.traction.col(across ? 0 : 1).cwiseAbs().maxCoeff() == 0);
                    const double slip_off =
                        (workspace.slip().col(across ? 1 : 0) - line_workspace.slip()).cwiseAbs().maxCoeff();
                    CHECK(slip_off < 1e-9 * (k % 15 == 0 ? 1 : a));
                }
                CHECK(slipping > 20);
            }
        }
    }
}

TEST_CASE("Where both directions are alike, the solution is invariant under rotation", "[friction]") {
    // nu = 0. The path turns by an angle as a whole: so do forces and tractions, at the same coefficients.
    for (const double distance : {0.0, 5e-6}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            const Scene scene(cosine_mesh<double>(24), distance, 0);
            const Model model = scene.transient(integrator);
            const double angle = 37 * std::numbers::pi / 180;
            Workspace workspace = model.workspace();
            State now = model.at_rest(), next = now, other = now, other_next = now;
            for (int k = 1; k <= 60; ++k) {
                const Creepage<double> creepage{2e-3 * std::sin(0.2 * k), 2.5e-3 * std::cos(0.13 * k)};
                const double duration = 0.1 * a / rolling_speed;
                const Step step = model.advance(now, {0.1 * a, duration}, creepage, next, workspace);
                const Step rotated =
                    model.advance(other, {0.1 * a, duration}, turned(creepage, angle), other_next, workspace);
                std::swap(now, next);
                std::swap(other, other_next);
                CAPTURE(distance, name(integrator), k);
                REQUIRE(step.status == StepStatus::ok);
                REQUIRE(rotated.status == StepStatus::ok);
                const auto force = turned({step.force.longitudinal, step.force.lateral}, angle);
                const double size = std::hypot(force.longitudinal, force.lateral);
                CHECK(std::abs(rotated.force.longitudinal - force.longitudinal) < 1e-8 * size);
                CHECK(std::abs(rotated.force.lateral - force.lateral) < 1e-8 * size);
                CHECK((now.friction_coefficient - other.friction_coefficient).abs().maxCoeff() < 1e-9);
            }
            // steady: along the creepage, as much as in one direction
            const FrictionModel<Law> line(scene.contact, scene.along(), unchecked, scene.friction, integrator);
            FrictionWorkspace<> line_workspace = line.workspace();
            FrictionState<> line_state = line.at_rest();
            const State rest = model.at_rest();
            for (const double size : {3e-4, 1e-3, 2e-3, 6e-3}) {
                const FrictionStep<> expected =
                    line.steady(line.at_rest(), size, rolling_speed, line_state, line_workspace);
                const Creepage<double> creepage = turned({size, 0}, angle);
                const Step step = model.steady(rest, creepage, rolling_speed, next, workspace);
                CAPTURE(distance, size);
                REQUIRE(step.status == StepStatus::ok);
                CHECK(step.force.longitudinal == Approx(expected.force * std::cos(angle)).epsilon(1e-9));
                CHECK(step.force.lateral == Approx(expected.force * std::sin(angle)).epsilon(1e-9));
                CHECK((next.friction_coefficient - line_state.friction_coefficient).abs().maxCoeff() < 1e-9);
            }
        }
    }
}

TEST_CASE("Left and right, and forth and back, are alike", "[friction]") {
    const Scene scene(uniform_mesh<double>(20), 4e-6);
    const Model model = scene.transient();
    for (const double x : {1.0, -1.0}) {
        for (const double y : {1.0, -1.0}) {
            Workspace workspace = model.workspace();
            State now = model.at_rest(), next = now, mirrored = now, mirrored_next = now;
            for (int k = 1; k <= 40; ++k) {
                const Creepage<double> creepage{2e-3 * std::sin(0.2 * k), 3e-3 * std::sin(0.13 * k)};
                const double duration = 0.1 * a / rolling_speed;
                const Step step = model.advance(now, {0.1 * a, duration}, creepage, next, workspace);
                const Step other = model.advance(mirrored, {0.1 * a, duration},
                                                 Creepage<double>{x * creepage.longitudinal, y * creepage.lateral},
                                                 mirrored_next, workspace);
                std::swap(now, next);
                std::swap(mirrored, mirrored_next);
                CAPTURE(x, y, k);
                REQUIRE(step.status == StepStatus::ok);
                const double size = std::hypot(step.force.longitudinal, step.force.lateral);
                CHECK(std::abs(other.force.longitudinal - x * step.force.longitudinal) < 1e-9 * size);
                CHECK(std::abs(other.force.lateral - y * step.force.lateral) < 1e-9 * size);
                CHECK((now.friction_coefficient - mirrored.friction_coefficient).abs().maxCoeff() < 1e-10);
            }
        }
    }
}

// mu of the particle that comes to x, which has rolled: looked up anew, from the other end
double remembered(const ArrayX<double>& points, const ArrayX<double>& mu, double x, double ahead) {
    if (x >= 1) return ahead;
    for (Eigen::Index i = points.size() - 1; i >= 0; --i) {
        if (points[i] > x) continue;
        const bool last = i == points.size() - 1;
        const double right = last ? 1 : points[i + 1], value = last ? ahead : mu[i + 1];
        return mu[i] + (x - points[i]) / (right - points[i]) * (value - mu[i]);
    }
    return mu[0];
}

TEST_CASE("Random motions in two directions: each implicit step obeys kinematics, law and memory", "[friction]") {
    Draws draws(7);
    int slipping = 0, steps = 0, remembering = 0;
    for (int scene_number = 0; scene_number < 60; ++scene_number) {
        const int n = static_cast<int>(draws.uniform(3, 32));
        Scene scene(scene_number % 2 == 0 ? cosine_mesh<double>(n) : uniform_mesh<double>(n),
                    scene_number % 3 == 0 ? 0 : draws.decades(-6.5, -4.5),
                    scene_number % 5 == 0 ? 0 : draws.uniform(0, 0.5));
        if (scene_number % 4 == 0) scene.scheme = {.alpha_L = 0.3, .alpha_T = 0.5};
        scene.friction.turned = false;  // p opposes s itself
        scene.friction.law = {0.3, draws.uniform(0.05, 0.3), draws.uniform(0.05, 1)};
        scene.friction.memory.least_velocity = draws.uniform(0, 2e-3);
        const Memory& memory = scene.friction.memory;
        const ElementSystem<double> systems[2] = {scene.along(), scene.across()};
        const Model model = scene.transient(Integrator::implicit_euler);
        Workspace workspace = model.workspace();
        State now = model.at_rest(), next = now;
        const ArrayX<double>& points = *systems[0].points();
        Creepage<double> creepage{0, 0};
        for (int k = 0; k < 30; ++k) {
            const double dq = k % 7 == 6 ? 0 : draws.uniform(0.02, 0.5), V = draws.decades(0, 1.7);
            const double duration = std::max(dq, 0.1) * a / V;
            if (draws.uniform(0, 1) < 0.3) creepage = {draws.uniform(-6e-3, 6e-3), draws.uniform(-6e-3, 6e-3)};
            const Creepage<double> moved{(dq == 0 ? 0.1 : dq) * a * creepage.longitudinal,
                                         (dq == 0 ? 0.1 : dq) * a * creepage.lateral};
            const Motion motion = dq == 0 ? Motion::shift(moved) : Motion(creepage);
            const Step step = model.advance(now, {dq * a, duration}, motion, next, workspace);
            CAPTURE(scene_number, n, k, step.complementarity_residual);
            REQUIRE(step.status == StepStatus::ok);
            ++steps;
            const double size = std::hypot(moved.longitudinal, moved.lateral);
            for (int d = 0; d < 2; ++d) {
                // slip = creepage dq - (dq G' - G) p - G p_old, in units of a
                const VectorX<double> p = next.traction.col(d) / shear_modulus,
                                      before = now.traction.col(d) / shear_modulus;
                const VectorX<double> slip = a * (systems[d].G() * (p - before) - dq * (systems[d].G_prime() * p));
                const double imposed = d == 0 ? moved.longitudinal : moved.lateral;
                const double off = (workspace.slip().col(d).array() - slip.array() - imposed).abs().maxCoeff();
                CHECK(off < 1e-9 * (size + a * 1e-3));
            }
            for (Eigen::Index i = 0; i < n; ++i) {
                const double mu = next.friction_coefficient[i], bound = mu * next.normal_pressure[i];
                const double u = workspace.slip()(i, 0), v = workspace.slip()(i, 1), slip = std::hypot(u, v);
                const double x = next.traction(i, 0), y = next.traction(i, 1), p = std::hypot(x, y);
                CHECK(p <= bound * (1 + 1e-9) + 1e-9 * peak_pressure);
                if (next.zones[static_cast<std::size_t>(i)] == Zone::stick) {
                    CHECK(slip <= 1e-9 * size + 1e-16);
                } else {
                    ++slipping;
                    CHECK(x * u + y * v <= -(1 - 1e-9) * p * slip);  // p against s
                    CHECK(p == Approx(bound).epsilon(1e-9));
                }
                double expected = scene.friction.law(slip / duration);
                if (memory.distance > 0) {
                    const double before = dq == 0 ? now.friction_coefficient[i]
                                                  : remembered(points, now.friction_coefficient, points[i] + dq, 0.3);
                    const double forgets = std::max(slip, duration * memory.least_velocity) / memory.distance;
                    expected = (before + forgets * expected) / (1 + forgets);
                    remembering += forgets > 0.05 && forgets < 5 ? 1 : 0;
                }
                CHECK(std::abs(mu - expected) < 1e-9);
            }
            std::swap(now, next);
        }
    }
    CHECK(slipping > steps);
    CHECK(remembering > steps);
}

TEST_CASE("Tangents by both creepages, the load and the half-length against central differences", "[friction]") {
    for (const double distance : {0.0, 10e-6}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            Scene scene(cosine_mesh<double>(30), distance);
            scene.friction.turned = false;
            const Model model = scene.transient(integrator);
            Workspace workspace = model.workspace();
            State now = model.at_rest(), next = now, probe = now;
            const ArrayX<double>& pressure = scene.friction.normal_pressure;
            NormalLoad<double> load{pressure, a, pressure};
            double worst = 0, worst_by_load = 0, worst_by_length = 0;
            int compared = 0;
            for (int k = 1; k <= 80; ++k) {
                const Creepage<double> at{1.2e-3 + 8e-4 * std::sin(0.3 * k), 1.5e-3 * std::cos(0.17 * k)};
                const bool shift = k % 4 == 0, steady = k % 20 == 10;
                const double half_length = a * (1 + 0.05 * std::sin(0.4 * k));
                const auto advance = [&](double x, double y, double more, double longer, State& to) {
                    const Creepage<double> end{at.longitudinal + x, at.lateral + y};
                    load.normal_pressure = pressure * (1 + 0.1 * std::sin(0.2 * k) + more);
                    load.half_length = (shift ? now.half_length : half_length) + longer;
                    if (steady) return model.steady(now, end, rolling_speed, load, to, workspace);
                    const Motion motion = shift ? Motion::shift({1e-3 * a * end.longitudinal, 1e-3 * a * end.lateral})
                                          : k % 3 == 0 ? Motion::linear({1e-3, -5e-4}, end)
                                                       : Motion(end);
                    return model.advance(now, {shift ? 0 : 0.1 * a, 0.1 * a / rolling_speed}, motion, load, to,
                                         workspace);
                };
                const Step step = advance(0, 0, 0, 0, next);
                REQUIRE(step.status == StepStatus::ok);
                constexpr double h = 1e-8, unit = 1e-6;
                bool same = true;
                const auto force = [&](double x, double y, double more, double longer) {
                    const TangentialForce<double> at_probe = advance(x, y, more, longer, probe).force_per_width;
                    same = same && probe.zones == next.zones;
                    return at_probe;
                };
                const auto slope = [&](double x, double y, double more, double longer, double size) {
                    const auto high = force(x, y, more, longer), low = force(-x, -y, -more, -longer);
                    return TangentialForce<double>{(high.longitudinal - low.longitudinal) / (2 * size),
                                                   (high.lateral - low.lateral) / (2 * size)};
                };
                const double scale = shift ? 1e-3 * a : 1;
                const auto by_x = slope(h, 0, 0, 0, h * scale), by_y = slope(0, h, 0, 0, h * scale);
                const auto by_load = slope(0, 0, unit, 0, unit);
                const bool breathes = !shift && !steady;
                const auto by_length = breathes ? slope(0, 0, 0, unit * a, unit * a) : TangentialForce<double>{};
                if (same && step.stick_count > 3 && step.stick_count < 29) {
                    const auto& tangent = step.tangent_per_width;
                    const double size = std::abs(by_x.longitudinal) + std::abs(by_y.lateral);
                    for (const double off : {tangent.by_longitudinal.longitudinal - by_x.longitudinal,
                                             tangent.by_longitudinal.lateral - by_x.lateral,
                                             tangent.by_lateral.longitudinal - by_y.longitudinal,
                                             tangent.by_lateral.lateral - by_y.lateral}) {
                        worst = std::max(worst, std::abs(off) / size);
                    }
                    if (!steady) {
                        const auto& load_tangent = step.tangent_by_load_per_width;
                        const double off = std::hypot(load_tangent.longitudinal - by_load.longitudinal,
                                                      load_tangent.lateral - by_load.lateral);
                        worst_by_load = std::max(worst_by_load, off / full_force);
                    }
                    const auto& length_tangent = step.tangent_by_half_length_per_width;
                    if (breathes) {
                        const double off = std::hypot(length_tangent.longitudinal - by_length.longitudinal,
                                                      length_tangent.lateral - by_length.lateral);
                        worst_by_length = std::max(worst_by_length, off * a / full_force);
                    } else {
                        CHECK(std::isnan(length_tangent.longitudinal));
                    }
                    ++compared;
                }
                std::swap(now, next);
            }
            CAPTURE(distance, name(integrator));
            CHECK(worst < 1e-6);
            CHECK(worst_by_load < 1e-7);
            CHECK(worst_by_length < 1e-6);
            CHECK(compared > 40);
        }
    }
}

TEST_CASE("In two directions and with memory, rolling in time tends to steady rolling", "[friction]") {
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        std::vector<double> differences;
        for (const Eigen::Index n : {20, 40, 80}) {
            const Scene scene(uniform_mesh<double>(n), 20e-6);
            const Model model = scene.transient(integrator);
            Workspace workspace = model.workspace();
            State now = model.at_rest(), next = now;
            const Creepage<double> creepage{1.5e-3, 1.2e-3};
            const auto steady = model.steady(now, creepage, rolling_speed, next, workspace).force_per_width;
            const double dq = 4.0 / static_cast<double>(n);
            Step step;
            for (double q = 0; q < 16; q += dq) {
                std::swap(now, next);
                step = model.advance(now, {dq * a, dq * a / rolling_speed}, creepage, next, workspace);
                REQUIRE(step.status == StepStatus::ok);
            }
            differences.push_back(std::hypot(step.force_per_width.longitudinal - steady.longitudinal,
                                             step.force_per_width.lateral - steady.lateral) /
                                  full_force);
        }
        CAPTURE(name(integrator), differences);
        CHECK(std::abs(differences[0] / differences[1] - 2) < 0.2);  // of first order, both
        CHECK(std::abs(differences[1] / differences[2] - 2) < 0.2);
        CHECK(differences[2] < 1e-3);
    }
}

TEST_CASE("In two directions steady forces tend to a limit that meshes share", "[friction]") {
    for (const double distance : {0.0, 10e-6}) {
        const auto solve = [&](Mesh<double> mesh) {
            const Scene scene(std::move(mesh), distance);
            const SteadyFrictionModel<Law, 2> model = scene.steady();
            Workspace workspace = model.workspace();
            const State rest = model.at_rest();
            State state = rest;
            const Step step = model.steady(rest, {4e-4, 5e-4}, rolling_speed, state, workspace);
            REQUIRE(step.status == StepStatus::ok);
            return Creepage<double>{-step.force_per_width.longitudinal / full_force,
                                    -step.force_per_width.lateral / full_force};
        };
        const Creepage<double> limit = solve(cosine_mesh<double>(160));
        std::vector<double> differences;
        for (const Eigen::Index n : {20, 40, 80}) {
            const Creepage<double> force = solve(uniform_mesh<double>(n));
            differences.push_back(std::hypot(force.longitudinal - limit.longitudinal, force.lateral - limit.lateral));
        }
        CAPTURE(distance, differences);
        CHECK(std::abs(differences[0] / differences[1] - 2) < 0.4);  // of first order
        CHECK(std::abs(differences[1] / differences[2] - 2) < 0.4);
        CHECK(differences[2] < 3e-3);
    }
}

TEST_CASE("In two directions sdirk2 is of second order with a memory", "[friction]") {
    const Scene scene(uniform_mesh<double>(16), 20e-6);
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        const Model model = scene.transient(integrator);
        Workspace workspace = model.workspace();
        const auto run = [&](int steps) {
            State now = model.at_rest(), next = now;
            const double dq = 4.0 / steps;
            const auto creepage = [](double q) {
                return Creepage<double>{4e-3 * std::pow(std::sin(0.7 * q), 2), 2e-3 * std::sin(0.9 * q)};
            };
            VectorX<double> forces(16);
            for (int k = 0; k < steps; ++k) {
                const Motion motion = Motion::linear(creepage(k * dq), creepage((k + 1) * dq));
                const Step step = model.advance(now, {dq * a, dq * a / rolling_speed}, motion, next, workspace);
                REQUIRE(step.status == StepStatus::ok);
                if ((k + 1) % (steps / 8) == 0) {
                    const int at = 2 * ((k + 1) / (steps / 8) - 1);
                    forces[at] = step.force_per_width.longitudinal / full_force;
                    forces[at + 1] = step.force_per_width.lateral / full_force;
                }
                std::swap(now, next);
            }
            return forces;
        };
        const VectorX<double> limit = run(2560);
        const double coarse = (run(40) - limit).norm(), fine = (run(320) - limit).norm();
        const double order = std::log2(coarse / fine) / 3;
        CAPTURE(name(integrator), coarse, fine, order);
        if (integrator == Integrator::sdirk2) {
            CHECK(std::abs(order - 1.75) < 0.25);  // 2, less where elements begin to slip
            CHECK(fine < 2e-4);
        } else {
            CHECK(std::abs(order - 1) < 0.3);
        }
    }
}

TEST_CASE("In two directions results depend on state and arguments, to the last bit", "[friction]") {
    const auto same = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; };
    Draws draws(11);
    for (const double distance : {0.0, 5e-6}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            const Scene scene(cosine_mesh<double>(20), distance);
            const Model model = scene.transient(integrator);
            Friction<Law> bare = scene.friction;
            bare.with_tangents = false;
            const Model without(scene.contact, {scene.along(), scene.across()}, unchecked, bare, integrator);
            Workspace used = model.workspace();
            State now = model.at_rest(), next = now, other = now;
            for (int k = 0; k < 150; ++k) {
                const double dq = std::vector<double>{0.05, 0.1, 0}[draws.generator() % 3] * a;
                const Creepage<double> creepage{draws.uniform(-4e-3, 4e-3), draws.uniform(-4e-3, 4e-3)};
                const bool steady = k % 10 == 9;
                const Motion motion = dq == 0
                                          ? Motion::shift({creepage.longitudinal * a / 10, creepage.lateral * a / 10})
                                          : Motion(creepage);
                const auto solve = [&](const Model& which, State& to, Workspace& workspace) {
                    return steady ? which.steady(now, creepage, rolling_speed, to, workspace)
                                  : which.advance(now, {dq, 0.05 * a / rolling_speed}, motion, to, workspace);
                };
                Workspace fresh = model.workspace();
                const Step step = solve(model, next, used), again = solve(model, other, fresh);
                CAPTURE(distance, name(integrator), k);
                REQUIRE(step.status == again.status);
                CHECK(same(step.force.longitudinal, again.force.longitudinal));
                CHECK(same(step.force.lateral, again.force.lateral));
                CHECK(same(step.tangent.by_longitudinal.lateral, again.tangent.by_longitudinal.lateral));
                CHECK(same(step.tangent.by_lateral.lateral, again.tangent.by_lateral.lateral));
                CHECK(same(step.slip_work_per_width, again.slip_work_per_width));
                CHECK((step.rounds == again.rounds && next.zones == other.zones));
                CHECK((next.traction.array() == other.traction.array()).all());
                CHECK((next.friction_coefficient == other.friction_coefficient).all());
                const Step tangentless = solve(without, other, fresh);
                CHECK(same(step.force.lateral, tangentless.force.lateral));
                CHECK((next.friction_coefficient == other.friction_coefficient).all());
                CHECK(std::isfinite(step.tangent.by_lateral.lateral));
                CHECK(std::isnan(tangentless.tangent.by_lateral.lateral));
                if (draws.generator() % 4 != 0) std::swap(now, next);
            }
        }
    }
}

TEST_CASE("In two directions a falling law out of range is refused", "[friction]") {
    Scene scene(cosine_mesh<double>(10), 1e-6);
    const auto refused = [&](const Law& bad, const Memory& memory, const char* words) {
        scene.friction.law = bad;
        scene.friction.memory = memory;
        CHECK_THROWS_WITH(scene.steady(), ContainsSubstring(words));
        CHECK_THROWS_AS(scene.transient(), std::invalid_argument);
    };
    refused({-0.1, 0.2, 1}, {}, "friction coefficient at rest = -0.1 must be finite and not negative");
    refused({nan, 0.2, 1}, {}, "friction coefficient at rest = nan");
    refused(law, {-1e-6, 0}, "distance of the memory = -1e-06 must be");
    refused(law, {1e-6, nan}, "least_velocity of the memory = nan must be");
    scene.friction = {law, scene.friction.normal_pressure, {1e-6, 1e-3}};
    const ElementSystem<double> along = scene.along(), across = scene.across();
    const ElementSystem<double> pointless(along.G(), along.G_prime(), along.weights());
    CHECK_THROWS_WITH(Model(scene.contact, {pointless, across}, unchecked, scene.friction),
                      ContainsSubstring("distance of the memory = 1e-06 must be 0"));
    scene.friction.memory.distance = 0;
    CHECK_NOTHROW(Model(scene.contact, {pointless, across}, unchecked, scene.friction));
    CHECK_THROWS_AS(Model(scene.contact, {along, across}, StabilityVerdict{}, scene.friction), std::invalid_argument);

    const Model model = scene.transient();
    Workspace workspace = model.workspace();
    const State rest = model.at_rest();
    State to = rest, wrong = rest;
    const double dq = 0.1 * a, duration = dq / rolling_speed;
    const Creepage<double> creepage{1e-3, 1e-3};
    for (const double bad : {0.0, -1.0, nan, infinite}) {
        CHECK(model.advance(rest, {dq, bad}, creepage, to, workspace).status == StepStatus::invalid_step);
        CHECK(model.steady(rest, creepage, bad, to, workspace).status == StepStatus::invalid_step);
        CHECK(scene.steady().steady(scene.steady().at_rest(), creepage, bad, to, workspace).status ==
              StepStatus::invalid_step);
    }
    for (const double bad : {-0.1, nan, infinite}) {
        wrong.friction_coefficient[3] = bad;
        CHECK(model.advance(wrong, {dq, duration}, creepage, to, workspace).status == StepStatus::wrong_state);
        CHECK(model.steady(wrong, creepage, rolling_speed, to, workspace).status == StepStatus::wrong_state);
        CHECK(scene.steady().steady(wrong, creepage, rolling_speed, to, workspace).status == StepStatus::wrong_state);
    }
    wrong = rest;
    for (const double bad : {-0.1, nan, infinite}) {
        wrong.solver.stage_coefficient[3] = bad;
        CHECK(model.advance(wrong, {dq, duration}, creepage, to, workspace).status == StepStatus::wrong_state);
    }
    wrong = rest;
    wrong.solver.stage_coefficient.resize(9);
    CHECK(model.advance(wrong, {dq, duration}, creepage, to, workspace).status == StepStatus::wrong_state);
    wrong = rest;
    wrong.friction_coefficient.resize(9);
    CHECK(model.advance(wrong, {dq, duration}, creepage, to, workspace).status == StepStatus::wrong_state);
    CHECK(model.advance(rest, {dq, duration}, creepage, wrong, workspace).status == StepStatus::wrong_state);
    CHECK(model.advance(rest, {dq, duration}, Creepage<double>{nan, 0}, to, workspace).status ==
          StepStatus::not_finite);
    CHECK(model.steady(rest, {0, infinite}, rolling_speed, to, workspace).status == StepStatus::not_finite);
    CHECK(scene.steady().steady(scene.steady().at_rest(), {nan, 0}, rolling_speed, to, workspace).status ==
          StepStatus::not_finite);
    NormalLoad<double> load{rest.normal_pressure, a, {}};
    load.normal_pressure[2] = -1;
    CHECK(model.advance(rest, {dq, duration}, creepage, load, to, workspace).status == StepStatus::invalid_load);
    CHECK(model.steady(rest, creepage, rolling_speed, load, to, workspace).status == StepStatus::invalid_load);
    CHECK((to.traction.array() == 0).all());
}

TEST_CASE("In two directions a law that is no number, or has no solution, ends in a status", "[friction]") {
    const AnyLaw broken = [](double v) { return v > 0.05 ? nan : 0.3; };
    const Scene scene(cosine_mesh<double>(20));
    const ArrayX<double>& pressure = scene.friction.normal_pressure;
    const FrictionModel<AnyLaw, 2> model(scene.contact, {scene.along(), scene.across()}, unchecked, {broken, pressure});
    Workspace workspace = model.workspace();
    State now = model.at_rest(), next = now;
    now.friction_coefficient.setConstant(0.2);
    const double dq = 0.1 * a, duration = dq / rolling_speed;
    const auto advance = [&](double creepage) {
        return model.advance(now, {dq, duration}, Creepage<double>{creepage, creepage}, next, workspace).status;
    };
    CHECK(advance(0) == StepStatus::ok);
    CHECK(advance(2e-2) == StepStatus::not_finite);
    CHECK((next.traction.array() == now.traction.array()).all());
    CHECK((next.friction_coefficient == 0.2).all());

    // it sticks at the coefficient of slip, and slips at that of rest
    const AnyLaw torn = [](double v) { return v > 0 ? 0.3 : 0.1; };
    const Scene one(uniform_mesh<double>(1));
    const FrictionModel<AnyLaw, 2> without_solution(one.contact, {one.along(), one.across()}, unchecked,
                                                    {torn, one.friction.normal_pressure}, Integrator::implicit_euler);
    Workspace small = without_solution.workspace();
    const State rest = without_solution.at_rest();
    State to = rest;
    int failed = 0;
    for (int k = 1; k <= 60; ++k) {
        const Step step =
            without_solution.advance(rest, {dq, duration}, Creepage<double>{8e-4 * k, 6e-4 * k}, to, small);
        if (step.status == StepStatus::ok) continue;
        REQUIRE(step.status == StepStatus::no_solution);
        CHECK(step.complementarity_residual > 0.05);
        CHECK(step.complementarity_residual < 0.21);
        CHECK(std::isfinite(step.force.lateral));
        CHECK(std::isnan(step.tangent.by_lateral.lateral));
        ++failed;
    }
    CHECK(failed >= 5);
    CHECK(failed <= 55);
}

template <class Scalar>
Scalar lateral_force() {
    const Contact<Scalar> contact(
        {.half_length = Scalar(4e-3), .half_width = 4, .shear_modulus = Scalar(82e9), .poisson_ratio = Scalar(0.28)});
    const Mesh<Scalar> mesh = cosine_mesh<Scalar>(20);
    const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    const PlaneKernel<Scalar> along = PlaneKernel<Scalar>::longitudinal(contact),
                              across = PlaneKernel<Scalar>::lateral(contact);
    const Friction<ExponentialFall<Scalar>, Scalar> friction{{Scalar(0.3), Scalar(0.18), Scalar(0.1)},
                                                             Scalar(495e6) * mean_hertz_pressure(mesh),
                                                             {Scalar(10e-6), Scalar(1e-3)}};
    const FrictionModel<ExponentialFall<Scalar>, 2, Scalar> model(
        contact, {rolling_system(mesh, scheme, along), rolling_system(mesh, scheme, across)}, unchecked, friction);
    auto workspace = model.workspace();
    auto now = model.at_rest(), next = now;
    FrictionStep<2, Scalar> step;
    for (int k = 0; k < 20; ++k) {
        step = model.advance(now, {Scalar(4e-4), Scalar(1e-5)}, Creepage<Scalar>{Scalar(1e-3), Scalar(2e-3)}, next,
                             workspace);
        CHECK(step.status == StepStatus::ok);
        std::swap(now, next);
    }
    const SteadyFrictionModel steady(contact, mesh, scheme, along, across, friction);
    const auto point = steady.steady(steady.at_rest(), {Scalar(1e-3), Scalar(2e-3)}, Scalar(40), next, workspace);
    CHECK(point.status == StepStatus::ok);
    return step.force_per_width.lateral + point.force_per_width.lateral;
}

TEST_CASE("Falling friction in two directions in float", "[friction]") {
    CHECK(static_cast<double>(lateral_force<float>()) == Approx(lateral_force<double>()).epsilon(1e-4));
}

}  // namespace
