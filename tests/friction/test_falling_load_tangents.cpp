// rollbem/friction/transient.hpp: tangents of a step under a given load.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <rollbem/compiled/friction.hpp>
#include <rollbem/normal/hertz_load.hpp>

#include "falling_scene.hpp"
#include "support/catch.hpp"

namespace {

using namespace falling_tests;

constexpr double mean_load = std::numbers::pi / 2 * peak_pressure * a;  // [N/m]

// The wheel of Scene, whose contact has the half-length a under the mean load.
HertzLine<double> line() {
    const double young = 2 * shear_modulus * (1 + poisson_ratio);
    return HertzLine<double>({.load_per_width = mean_load,
                              .combined_radius = a * shear_modulus / (2 * peak_pressure * (1 - poisson_ratio)),
                              .body_1 = {young, poisson_ratio},
                              .body_2 = {young, poisson_ratio}});
}

// Its friction on a mesh that breathes with the contact, or on a fixed one of 1.3 times its length.
struct LoadedScene {
    LoadedScene(bool breathing, double distance, Integrator integrator)
        : scene(breathing ? cosine_mesh<double>(24) : uniform_mesh<double>(24), distance),
          half_length(breathing ? a : 1.3 * a),
          contact({.half_length = half_length,
                   .half_width = 1000 * a,
                   .shear_modulus = shear_modulus,
                   .poisson_ratio = poisson_ratio}),
          hertz(breathing ? HertzLoad<double>::breathing(line(), scene.mesh)
                          : HertzLoad<double>::fixed(line(), scene.mesh, half_length)),
          model(contact, rolling_system(scene.mesh, scene.scheme, PlaneKernel<double>::longitudinal(contact)),
                unchecked, {law, hertz.at(mean_load).normal_pressure, {distance, least_velocity}}, integrator) {}

    Scene scene;
    double half_length;
    Contact<double> contact;
    HertzLoad<double> hertz;
    FrictionModel<Law> model;
};

// What tangents are taken by, and by how much it changes in all: the last is the load, and with it the half-length.
enum class By { creepage, load, half_length, load_and_half_length };

double size_of(By what) { return what == By::creepage ? 1e-3 : what == By::half_length ? a : mean_load; }

// One step from `now` with `part` of that more at its end.
struct Trial {
    const LoadedScene& loaded;
    const State& now;
    double dq, start, end, P;
    std::optional<By> by;
    double part = 0;

    Step run(State& to, FrictionWorkspace<>& workspace) const {
        const double change = by ? part * size_of(*by) : 0;
        NormalLoad<double> load = loaded.hertz.at(P + (by == By::load_and_half_length ? change : 0));
        if (by == By::load) load.normal_pressure += change * load.pressure_rate;
        if (by == By::half_length) load.half_length += change;
        const double creepage = end + (by == By::creepage ? change : 0);
        return loaded.model.advance(now, {dq, dq / speed}, Motion::linear(start, creepage), load, to, workspace);
    }
};

TEST_CASE("Tangents under a varying load agree with central differences", "[friction][load]") {
    constexpr By all[] = {By::creepage, By::load, By::half_length, By::load_and_half_length};
    for (const bool breathing : {true, false}) {
        for (const double distance : {0.0, 10e-6}) {
            for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
                const LoadedScene loaded(breathing, distance, integrator);
                auto workspace = loaded.model.workspace();
                State now = loaded.model.at_rest(), next = now, probe = now;
                double worst[4] = {0, 0, 0, 0}, largest[4] = {0, 0, 0, 0};
                int compared[4] = {0, 0, 0, 0};
                for (int k = 1; k <= 40; ++k) {
                    Trial trial{.loaded = loaded,
                                .now = now,
                                .dq = 0.137 * a,
                                .start = 1.1e-3,
                                .end = 1.2e-3 + 7e-4 * std::sin(0.3 * k),
                                .P = mean_load * (1 + 0.3 * std::sin(0.17 * k)),
                                .by = std::nullopt};
                    const Step step = trial.run(next, workspace);
                    REQUIRE(step.status == StepStatus::ok);
                    const double rate = breathing ? loaded.hertz.half_length_rate(trial.P) : 0;
                    const double tangents[4] = {step.tangent_per_width, step.tangent_by_load_per_width,
                                                step.tangent_by_half_length_per_width,
                                                step.tangent_by_load_per_width +
                                                    (breathing ? rate * step.tangent_by_half_length_per_width : 0)};
                    CHECK(step.tangent_by_load == Approx(2000 * a * step.tangent_by_load_per_width).epsilon(1e-14));
                    for (const By by : all) {
                        const auto i = static_cast<std::size_t>(by);
                        if (by == By::half_length && !breathing) continue;  // the mesh is fixed
                        bool unchanged = true;
                        const auto force = [&](double part) {
                            trial.by = by;
                            trial.part = part;
                            const Step moved = trial.run(probe, workspace);
                            unchanged = unchanged && probe.zones == next.zones && moved.status == StepStatus::ok;
                            return moved.force_per_width / full_force;
                        };
                        constexpr double h = 1e-5;
                        const double fine = (force(h) - force(-h)) / (2 * h);
                        const double coarse = (force(2 * h) - force(-2 * h)) / (4 * h);
                        const double difference = fine + (fine - coarse) / 3;  // of fourth order
                        const auto loads = (next.normal_pressure > 0).count();
                        if (!unchanged || step.stick_count == 0 || step.stick_count == loads) continue;
                        const double tangent = tangents[i] * size_of(by) / full_force;
                        worst[i] = std::max(worst[i], std::abs(tangent - difference));
                        largest[i] = std::max(largest[i], std::abs(tangent));
                        ++compared[i];
                    }
                    std::swap(now, next);
                }
                for (const By by : all) {
                    if (by == By::half_length && !breathing) continue;
                    const auto i = static_cast<std::size_t>(by);
                    CAPTURE(breathing, distance, name(integrator), i, worst[i], largest[i], compared[i]);
                    CHECK(compared[i] >= 20);
                    CHECK(worst[i] < 2e-9);
                    CHECK(largest[i] > 1e-3);
                    CHECK(largest[i] < 20);
                }
            }
        }
    }
}

TEST_CASE("Tangents that do not exist are NaN", "[friction][load]") {
    const LoadedScene loaded(true, 10e-6, Integrator::sdirk2);
    auto workspace = loaded.model.workspace();
    const State rest = loaded.model.at_rest();
    State to = rest;
    NormalLoad<double> load = loaded.hertz.at(mean_load);
    const double dq = 0.1 * a, duration = dq / speed;
    Step step = loaded.model.advance(rest, {dq, duration}, 1e-3, load, to, workspace);
    CHECK(std::isfinite(step.tangent_by_load));
    CHECK(std::isfinite(step.tangent_by_half_length));
    // a rigid shift knows no other half-length
    step = loaded.model.advance(rest, {0, duration}, Motion::shift(1e-6), load, to, workspace);
    CHECK(step.status == StepStatus::ok);
    CHECK(std::isfinite(step.tangent_by_load));
    CHECK(std::isnan(step.tangent_by_half_length));
    // nothing asks for it
    load.pressure_rate.resize(0);
    step = loaded.model.advance(rest, {dq, duration}, 1e-3, load, to, workspace);
    CHECK(std::isfinite(step.tangent));
    CHECK(std::isnan(step.tangent_by_load));
    CHECK(std::isfinite(step.tangent_by_half_length));
    // refused
    CHECK(std::isnan(loaded.model.advance(rest, {dq, -1}, 1e-3, load, to, workspace).tangent_by_half_length));
    const FrictionModel<Law> without(
        loaded.contact,
        rolling_system(loaded.scene.mesh, loaded.scene.scheme, PlaneKernel<double>::longitudinal(loaded.contact)),
        unchecked, {law, load.normal_pressure, {10e-6, least_velocity}, false});
    load = loaded.hertz.at(mean_load);
    step = without.advance(without.at_rest(), {dq, duration}, 1e-3, load, to, workspace);
    CHECK(step.status == StepStatus::ok);
    CHECK(std::isnan(step.tangent));
    CHECK(std::isnan(step.tangent_by_load));
    CHECK(std::isnan(step.tangent_by_half_length));
}

}  // namespace
