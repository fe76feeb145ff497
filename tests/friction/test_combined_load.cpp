// rollbem/friction/transient.hpp: steps under a varying load
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <rollbem/normal/load.hpp>

#include "friction/combined_scene.hpp"
#include "support/catch.hpp"

namespace {

using namespace combined_tests;

// Hertz's pressure at the half-length a, in units of the scene's, on a breathing mesh. The rates are derivatives by the
// factor of the pressures.
NormalLoad<double> breathing(const Scene& scene, double a) {
    return {a * scene.friction.normal_pressure, a, scene.friction.normal_pressure};
}

// Hertz's pressure of half-length a on a uniform mesh of half-length 1, approximated at the elements' centres.
NormalLoad<double> fixed(const Scene& scene, double a) {
    NormalLoad<double> load{ArrayX<double>::Zero(scene.mesh.size()), 1, ArrayX<double>::Zero(scene.mesh.size())};
    for (Eigen::Index i = 0; i < scene.mesh.size(); ++i) {
        const double x = scene.mesh.centres()[i];
        if (std::abs(x) >= a) continue;
        load.normal_pressure[i] = peak * std::sqrt(a * a - x * x);
        load.pressure_rate[i] = load.normal_pressure[i];
    }
    return load;
}

double half_length(double q) { return std::sqrt(1 + 0.5 * std::sin(2 * std::numbers::pi * q / 8)); }

TEST_CASE("Motion in one direction under a varying load agrees with the model of that direction", "[friction]") {
    for (const bool breathes : {true, false}) {
        const Scene scene = Scene(breathes ? cosine_mesh<double>(30) : uniform_mesh<double>(30)).plain();
        for (const Integrator integrator : integrators) {
            const Model model = scene.transient(integrator);
            for (const bool lateral : {false, true}) {
                const FrictionModel<> one(scene.contact, lateral ? scene.across() : scene.along(), unchecked,
                                          scene.friction, integrator);
                State now = model.at_rest(), next = now;
                Workspace workspace = model.workspace();
                FrictionState<> own = one.at_rest(), own_next = own;
                FrictionWorkspace<> own_workspace = one.workspace();
                for (int k = 0; k < 60; ++k) {
                    const double a = half_length(0.3 * k), size = 1e-3 * std::sin(0.2 * k);
                    const NormalLoad<double> load = breathes ? breathing(scene, a) : fixed(scene, 0.7 * a);
                    const Creepage<double> creepage = lateral ? Creepage<double>{0, size} : Creepage<double>{size, 0};
                    const auto step = model.advance(now, 0.3, creepage, load, next, workspace);
                    const auto expected = one.advance(own, 0.3, size, load, own_next, own_workspace);
                    const auto part = [&](const TangentialForce<double>& force) {
                        return lateral ? force.lateral : force.longitudinal;
                    };
                    CAPTURE(breathes, lateral, k);
                    REQUIRE(step.status == StepStatus::ok);
                    REQUIRE(std::abs(part(step.force_per_width) - expected.force_per_width) < 1e-11 * full_force);
                    REQUIRE(std::abs(step.slip_work_per_width - expected.slip_work_per_width) < 1e-11 * peak * peak);
                    REQUIRE(std::abs(part(step.tangent_by_load_per_width) - expected.tangent_by_load_per_width) < 1e-9);
                    if (breathes) {
                        REQUIRE(std::abs(part(step.tangent_by_half_length_per_width) -
                                         expected.tangent_by_half_length_per_width) < 1e-9 * peak);
                    }
                    REQUIRE(step.stick_count == expected.stick_count);
                    std::swap(now, next);
                    std::swap(own, own_next);
                }
            }
        }
    }
}

TEST_CASE("With Poisson's ratio zero, rotating the creepage under a varying load rotates the force", "[friction]") {
    const Scene scene(cosine_mesh<double>(20), 0);
    for (const Integrator integrator : integrators) {
        const Model model = scene.transient(integrator);
        const FrictionModel<> one(scene.contact, scene.along(), unchecked, scene.friction, integrator);
        State now = model.at_rest(), next = now;
        Workspace workspace = model.workspace();
        FrictionState<> own = one.at_rest(), own_next = own;
        FrictionWorkspace<> own_workspace = one.workspace();
        for (int k = 0; k < 50; ++k) {
            const NormalLoad<double> load = breathing(scene, half_length(0.3 * k));
            const Creepage<double> creepage = scene.creepage(0.6, 25);
            const double size = 2 * peak * 0.6, angle = 25 * std::numbers::pi / 180;
            const auto step = model.advance(now, 0.3, creepage, load, next, workspace);
            const auto expected = one.advance(own, 0.3, size, load, own_next, own_workspace);
            CAPTURE(k);
            REQUIRE(std::abs(step.force_per_width.longitudinal - expected.force_per_width * std::cos(angle)) <
                    1e-10 * full_force);
            REQUIRE(std::abs(step.force_per_width.lateral - expected.force_per_width * std::sin(angle)) <
                    1e-10 * full_force);
            std::swap(now, next);
            std::swap(own, own_next);
        }
    }
}

TEST_CASE("The tangents by load, half-length and creepages are derivatives of both forces", "[friction]") {
    for (const bool breathes : {true, false}) {
        const Scene scene = Scene(breathes ? cosine_mesh<double>(20) : uniform_mesh<double>(24)).plain();
        for (const Integrator integrator : integrators) {
            const Model model = scene.transient(integrator);
            State now = model.at_rest(), next = now, unused = now;
            Workspace workspace = model.workspace();
            for (int k = 0; k < 40; ++k) {
                const double a = half_length(0.3 * k);
                const NormalLoad<double> load = breathes ? breathing(scene, a) : fixed(scene, 0.7 * a);
                const Creepage<double> creepage = scene.creepage(0.7, 8.0 * k);
                const auto step = model.advance(now, 0.3, creepage, load, next, workspace);
                REQUIRE(step.status == StepStatus::ok);
                // the shorter the difference, the fewer elements change zones within it
                const auto difference = [&](const NormalLoad<double>& by, double e, const Creepage<double>& turn) {
                    TangentialForce<double> sides[2];
                    for (const int side : {0, 1}) {
                        const double sign = side == 0 ? 1 : -1;
                        NormalLoad<double> changed = load;
                        changed.normal_pressure += sign * e * by.normal_pressure;
                        changed.half_length += sign * e * by.half_length;
                        const Creepage<double> other{creepage.longitudinal + sign * e * turn.longitudinal,
                                                     creepage.lateral + sign * e * turn.lateral};
                        sides[side] = model.advance(now, 0.3, other, changed, unused, workspace).force_per_width;
                    }
                    return TangentialForce<double>{(sides[0].longitudinal - sides[1].longitudinal) / (2 * e),
                                                   (sides[0].lateral - sides[1].lateral) / (2 * e)};
                };
                const ArrayX<double> none = ArrayX<double>::Zero(scene.mesh.size());
                const auto by_load = difference({load.pressure_rate, 0, {}}, 1e-6, {});
                const auto by_lateral = difference({none, 0, {}}, 1e-6 * peak, {0, 1});
                CAPTURE(breathes, name(integrator), k);
                const double size = 1e-5 * full_force;
                CHECK(std::abs(by_load.longitudinal - step.tangent_by_load_per_width.longitudinal) < size);
                CHECK(std::abs(by_load.lateral - step.tangent_by_load_per_width.lateral) < size);
                CHECK(std::abs(by_lateral.longitudinal - step.tangent_per_width.by_lateral.longitudinal) < 1e-6);
                CHECK(std::abs(by_lateral.lateral - step.tangent_per_width.by_lateral.lateral) < 1e-6);
                if (breathes) {
                    const auto by_length = difference({none, 1, {}}, 1e-6, {});
                    const TangentialForce<double>& own = step.tangent_by_half_length_per_width;
                    CHECK(std::abs(by_length.longitudinal - own.longitudinal) < size);
                    CHECK(std::abs(by_length.lateral - own.lateral) < size);
                }
                std::swap(now, next);
            }
        }
    }
}

TEST_CASE("A constant load gives the same steps in two directions as no load", "[friction]") {
    const Scene scene(cosine_mesh<double>(16));
    for (const Integrator integrator : integrators) {
        const Model model = scene.transient(integrator);
        State now = model.at_rest(), next = now, loaded = now, loaded_next = now;
        Workspace workspace = model.workspace(), other = workspace;
        const NormalLoad<double> load{scene.friction.normal_pressure, 1, {}};
        for (int k = 0; k < 20; ++k) {
            const Creepage<double> creepage = scene.creepage(0.9, 20.0 * k);
            const Step step = model.advance(now, 0.2, creepage, next, workspace);
            const auto same = model.advance(loaded, 0.2, creepage, load, loaded_next, other);
            REQUIRE(next.traction == loaded_next.traction);
            REQUIRE(step.force.lateral == same.force.lateral);
            REQUIRE(step.tangent.by_lateral.longitudinal == same.tangent.by_lateral.longitudinal);
            CHECK(std::isnan(same.tangent_by_load.longitudinal));
            std::swap(now, next);
            std::swap(loaded, loaded_next);
        }
    }
}

TEST_CASE("A checkpoint and a new workspace continue bit for bit under a varying load", "[friction]") {
    for (const bool breathes : {true, false}) {
        const Scene scene(breathes ? cosine_mesh<double>(18) : uniform_mesh<double>(18));
        for (const Integrator integrator : integrators) {
            const Model model = scene.transient(integrator);
            State now = model.at_rest(), next = now, copy = now;
            Workspace used = model.workspace();
            for (int k = 0; k < 50; ++k) {
                const double a = half_length(0.3 * k), dq = k % 4 == 0 ? 0.3 : 0.4;
                const NormalLoad<double> load = breathes ? breathing(scene, a) : fixed(scene, 0.7 * a);
                const Creepage<double> creepage = scene.creepage(0.7, 8.0 * k);
                // a state is plain data, completely described by its fields
                State checkpoint;
                checkpoint.traction = now.traction;
                checkpoint.zones = now.zones;
                checkpoint.normal_pressure = now.normal_pressure;
                checkpoint.half_length = now.half_length;
                checkpoint.system = now.system;
                Workspace fresh = model.workspace();
                const auto step = model.advance(now, dq, creepage, load, next, used);
                const auto again = model.advance(checkpoint, dq, creepage, load, copy, fresh);
                CAPTURE(breathes, name(integrator), k);
                REQUIRE(step.status == StepStatus::ok);
                REQUIRE(copy.traction == next.traction);
                REQUIRE(copy.zones == next.zones);
                REQUIRE((copy.normal_pressure == next.normal_pressure).all());
                REQUIRE(copy.half_length == next.half_length);
                REQUIRE(used.slip() == fresh.slip());
                REQUIRE(used.slip_work() == fresh.slip_work());
                REQUIRE(step.tangent_by_load.lateral == again.tangent_by_load.lateral);
                REQUIRE(step.tangent.by_longitudinal.lateral == again.tangent.by_longitudinal.lateral);
                if (breathes) {
                    REQUIRE(step.tangent_by_half_length.longitudinal == again.tangent_by_half_length.longitudinal);
                }
                // a trial step that is rejected
                model.advance(now, 2 * dq, scene.creepage(2, -50.0 * k), copy, used);
                std::swap(now, next);
            }
        }
    }
}

TEST_CASE("Newton's method for creepage and load together converges quadratically", "[friction]") {
    // The load per width P is an unknown: a ~ sqrt(P), pressures ~ a. Both forces at the end of a step are prescribed.
    const Scene scene = Scene(cosine_mesh<double>(24)).plain();
    const Model model = scene.transient();
    Workspace workspace = model.workspace();
    State now = model.at_rest(), next = now;
    model.steady(model.at_rest(), scene.creepage(0.6, 30), now, workspace);
    const auto run = [&](double P, double lateral) {
        // the rates are derivatives by a
        const double a = std::sqrt(P);
        const Creepage<double> creepage{scene.creepage(0.6, 30).longitudinal, lateral};
        return model.advance(now, 0.3, creepage, breathing(scene, a), next, workspace);
    };
    const double goal_P = 1.15, goal_lateral = 1.2 * scene.creepage(0.6, 30).lateral;
    const TangentialForce<double> goal = run(goal_P, goal_lateral).force_per_width;
    double P = 1.13, lateral = 1.17 * scene.creepage(0.6, 30).lateral;
    double errors[4] = {};
    for (double& error : errors) {
        const auto step = run(P, lateral);
        REQUIRE(step.status == StepStatus::ok);
        const double x = step.force_per_width.longitudinal - goal.longitudinal;
        const double y = step.force_per_width.lateral - goal.lateral;
        error = std::hypot(x, y) / full_force;
        const double da = 1 / (2 * std::sqrt(P));
        const double x_P =
            da * (step.tangent_by_load_per_width.longitudinal + step.tangent_by_half_length_per_width.longitudinal);
        const double y_P =
            da * (step.tangent_by_load_per_width.lateral + step.tangent_by_half_length_per_width.lateral);
        const double x_l = step.tangent_per_width.by_lateral.longitudinal;
        const double y_l = step.tangent_per_width.by_lateral.lateral;
        const double determinant = x_P * y_l - x_l * y_P;
        P -= (x * y_l - x_l * y) / determinant;
        lateral -= (x_P * y - x * y_P) / determinant;
    }
    CAPTURE(errors[0], errors[1], errors[2], errors[3]);
    CHECK(errors[0] > 1e-3);
    CHECK(errors[1] < 10 * errors[0] * errors[0]);
    CHECK(errors[2] < 10 * errors[1] * errors[1] + 1e-13);
    CHECK(errors[3] < 1e-13);
    CHECK(P == Approx(goal_P).epsilon(1e-10));
}

TEST_CASE("A slowly varying load leads to steady rolling under each load", "[friction]") {
    const Scene scene(cosine_mesh<double>(16), 0.28, half, 10);
    const Model model = scene.transient();
    Workspace workspace = model.workspace();
    const Creepage<double> creepage = scene.creepage(0.5, 40);
    double before = 1;
    for (const double length : {20.0, 80.0, 320.0, 1280.0}) {
        State now = model.at_rest(), next = now, steady = now;
        model.steady(model.at_rest(), creepage, now, workspace);
        double off = 0;
        for (int k = 1; k <= 60; ++k) {
            const double a = std::sqrt(1 + 0.5 * std::sin(2 * std::numbers::pi * k / 60));
            const NormalLoad<double> load = breathing(scene, a);
            const auto step = model.advance(now, length / 60, creepage, load, next, workspace);
            REQUIRE(step.status == StepStatus::ok);
            const Step settled = model.steady(next, creepage, load, steady, workspace);
            REQUIRE(settled.status == StepStatus::ok);
            off = std::max({off, std::abs(step.force.longitudinal - settled.force.longitudinal),
                            std::abs(step.force.lateral - settled.force.lateral)});
            std::swap(now, next);
        }
        off /= 2 * scene.contact.half_width() * full_force;
        CAPTURE(length, off);
        CHECK(off < 0.6 * before);
        before = off;
    }
    CHECK(before < 0.01);
}

TEST_CASE("The heat by slip and by the elastic energy agree under a varying load", "[friction]") {
    double before = 1;
    for (const Eigen::Index n : {20, 40, 80}) {
        const Scene scene(cosine_mesh<double>(n));
        const Model model = scene.transient();
        Workspace workspace = model.workspace();
        const Creepage<double> creepage = scene.creepage(0.5, 40);
        State now = model.at_rest(), next = now;
        model.steady(model.at_rest(), creepage, now, workspace);
        const double start = model.elastic_energy_per_width(now), dq = 0.02;
        double work = 0, lost = 0;
        TangentialForce<double> force = model.force(now);
        const double width = 2 * scene.contact.half_width();
        for (int k = 1; k <= 400; ++k) {
            const NormalLoad<double> load = breathing(scene, half_length(k * dq));
            const auto step = model.advance(now, dq, creepage, load, next, workspace);
            REQUIRE(step.status == StepStatus::ok);
            work += step.slip_work_per_width;
            // trapezoidal rule
            lost -= dq / 2 / width *
                    ((force.longitudinal + step.force.longitudinal) * creepage.longitudinal +
                     (force.lateral + step.force.lateral) * creepage.lateral);
            force = step.force;
            std::swap(now, next);
        }
        const double heat = lost - (model.elastic_energy_per_width(now) - start);
        const double error = std::abs(work / heat - 1);
        CAPTURE(n, work, heat, error);
        CHECK(error < before / 2.5);
        before = error;
    }
    CHECK(before < 1e-3);
}

TEST_CASE("Lift-off and touch-down in two directions are ordinary steps", "[friction]") {
    const Scene scene(uniform_mesh<double>(30));
    for (const Integrator integrator : integrators) {
        const Model model = scene.transient(integrator);
        Workspace workspace = model.workspace();
        State now = model.at_rest(), next = now;
        for (int k = 0; k < 120; ++k) {
            const double a = std::max(0.0, 0.5 + 0.49 * std::sin(0.15 * k) - (k / 40 == 1 ? 0.6 : 0.0));
            const NormalLoad<double> load = fixed(scene, a);
            const double dq = k % 7 == 6 ? 0.0 : 0.2;
            const Motion motion =
                dq == 0 ? Motion::shift(scene.creepage(0.05, 9.0 * k)) : Motion(scene.creepage(0.6, 9.0 * k));
            const auto step = model.advance(now, dq, motion, load, next, workspace);
            CAPTURE(name(integrator), k, a, step.rounds);
            REQUIRE(step.status == StepStatus::ok);
            REQUIRE(step.complementarity_residual < 1e-10);
            for (Eigen::Index i = 0; i < 30; ++i) {
                const double p = std::hypot(next.traction(i, 0), next.traction(i, 1));
                REQUIRE(p <= load.normal_pressure[i] * (1 + 1e-12));
            }
            if (a == 0) {
                REQUIRE(step.force.longitudinal == 0);
                REQUIRE(step.force.lateral == 0);
                REQUIRE(step.slip_work_per_width >= 0);
                REQUIRE(step.tangent.by_lateral.lateral == 0);
            }
            std::swap(now, next);
        }
    }
}

TEST_CASE("Invalid loads are reported by the status in two directions", "[friction]") {
    const Scene scene(cosine_mesh<double>(8));
    const Model model = scene.transient();
    const auto strip = [&](bool lateral) {
        return rolling_system(
            scene.mesh, scene.scheme,
            lateral ? StripKernel<double>::lateral(scene.contact) : StripKernel<double>::longitudinal(scene.contact));
    };
    const Model stiff(scene.contact, {strip(false), strip(true)}, unchecked, scene.friction);
    Workspace workspace = model.workspace();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto status = [&](const Model& which, const NormalLoad<double>& load, double dq) {
        const State rest = which.at_rest();
        State next = rest;
        const Motion motion = dq == 0 ? Motion::shift({1e-4, 0}) : Motion(scene.creepage(0.5, 30));
        const auto step = which.advance(rest, dq, motion, load, next, workspace);
        if (step.status != StepStatus::ok) CHECK(next.half_length == rest.half_length);
        return step.status;
    };
    const NormalLoad<double> good = breathing(scene, 1.1);
    CHECK(status(model, good, 0.2) == StepStatus::ok);
    CHECK(status(model, good, 0.1) == StepStatus::needs_fixed_mesh);
    CHECK(status(model, good, 0) == StepStatus::needs_fixed_mesh);
    CHECK(status(stiff, good, 0.2) == StepStatus::needs_fixed_mesh);
    CHECK(status(stiff, breathing(scene, 1), 0.2) == StepStatus::ok);
    NormalLoad<double> load = good;
    load.normal_pressure[2] = -1e-9;
    CHECK(status(model, load, 0.2) == StepStatus::invalid_load);
    load.normal_pressure[2] = nan;
    CHECK(status(model, load, 0.2) == StepStatus::invalid_load);
    load = good;
    load.half_length = 0;
    CHECK(status(model, load, 0.2) == StepStatus::invalid_load);
    load = good;
    load.normal_pressure.conservativeResize(7);
    CHECK(status(model, load, 0.2) == StepStatus::invalid_load);
    load = good;
    load.pressure_rate.resize(3);
    CHECK(status(model, load, 0.2) == StepStatus::invalid_load);

    // a state of another half-length, given to systems with a single one
    State now = stiff.at_rest(), next = now;
    now.half_length = 1.1;
    CHECK(stiff.advance(now, 0.2, scene.creepage(0.5, 30), next, workspace).status == StepStatus::needs_fixed_mesh);
    CHECK(stiff.steady(now, scene.creepage(0.5, 30), next, workspace).status == StepStatus::needs_fixed_mesh);
    CHECK(std::isnan(stiff.elastic_energy(now)));
}

}  // namespace
