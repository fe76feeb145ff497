// rollbem/friction/transient.hpp: steps under a varying load
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <rollbem/normal/load.hpp>

#include "friction/combined_scene.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace {

using namespace combined_tests;

// Hertz's pressure at the half-length a, in units of the scene's, on a breathing mesh. The rates are derivatives by the
// factor of the pressures.
NormalLoad<double> breathing(const Scene& scene, double a) {
    return {a * scene.friction.normal_pressure, a, scene.friction.normal_pressure};
}

double half_length(double q) { return std::sqrt(1 + 0.5 * std::sin(2 * std::numbers::pi * q / 8)); }

TEST_CASE("A slowly varying load leads to steady rolling under each load", "[friction]") {
    const Scene scene(cosine_mesh<double>(16), 0.28, half, 10);
    const Model model = scene.transient();
    Workspace workspace = model.workspace();
    const Creepage<double> creepage = scene.creepage(0.5, 40);
    std::vector<double> lengths, differences;
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
        lengths.push_back(length);
        differences.push_back(off);
    }
    CAPTURE(differences, support::observed_order(lengths, differences));
    CHECK(std::abs(support::observed_order(lengths, differences) - 0.8) < 0.3);
    CHECK(differences.back() < 0.01);
}

TEST_CASE("The heat by slip and by the elastic energy agree under a varying load", "[friction]") {
    std::vector<double> counts, errors;
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
        counts.push_back(static_cast<double>(n));
        errors.push_back(work / heat - 1);
    }
    CAPTURE(errors, support::observed_order(counts, errors));
    CHECK(std::abs(support::observed_order(counts, errors) - 1.8) < 0.3);
    CHECK(std::abs(errors.back()) < 1e-3);
}

}  // namespace
