// Creep curves with the exact border between slip and stick.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/stick_border.hpp>

#include "creep_curve.hpp"
#include "support/timing.hpp"
#include "surface.hpp"

namespace friction {

namespace {

/// At the centres of the cosine mesh, which is also the one used where the border has no exact solution.
Profile profile_of(const study::Scene& scene, const CreepPoint& point,
                   const rollbem::StickBorderSolution<double>& solution, const Pressure& pressure) {
    const rollbem::Mesh<double> mesh = rollbem::cosine_mesh<double>(scene.n());
    const std::optional<double> alpha = solution.exact ? std::nullopt : std::optional(0.5);
    Profile profile{.scene = &scene,
                    .mesh_name = solution.exact ? "fitted" : "cosine",
                    .alpha_L = alpha,
                    .alpha_T = alpha,
                    .point = point,
                    .status = name(solution.status),
                    .mesh = mesh,
                    .traction = Eigen::VectorXd(scene.n()),
                    .bound = pressure(mesh).matrix(),
                    .slip = Eigen::VectorXd(scene.n())};
    for (Eigen::Index k = 0; k < scene.n(); ++k) {
        const double x = mesh.centres()[k];
        if (solution.exact) profile.bound[k] = pressure(x);
        profile.traction[k] = solution.traction(x);
        profile.slip[k] = solution.slip(x);
        profile.sticks.push_back(solution.exact ? x > solution.border : profile.slip[k] == 0);
    }
    return profile;
}

}  // namespace

void border_rows(const CreepCurve& curve, const study::Scene& scene, std::size_t task, study::RowRange range,
                 const study::Emit& emit) {
    const bool finite = Surface{scene}.gradient(Direction::longitudinal).allFinite();
    if (!finite) return rows_without(curve, scene, task, range, emit);
    for (std::size_t i = range.first; i < range.last; ++i) {
        const CreepPoint& point = curve.points[i];
        const auto solve = [&] {
            return rollbem::solve_stick_border(scene.contact, scene.kernel, 1.0, curve.pressure,
                                               creepage(scene, point.longitudinal), scene.n());
        };
        const rollbem::StickBorderSolution<double> solution = solve();
        Profile profile = profile_of(scene, point, solution, curve.pressure);
        CreepResult result{.mesh_name = profile.mesh_name, .alpha_L = profile.alpha_L, .alpha_T = profile.alpha_T};
        if (curve.timed()) result.time_us = study::median_time_us([&] { return solve().force_per_width; });
        if (solution.status == rollbem::StepStatus::ok) result.force_ratio = -solution.force_per_width / mu_N;
        result.stick_count = std::count(profile.sticks.begin(), profile.sticks.end(), true);
        result.rounds = solution.evaluations;
        result.pivots = 0;
        result.complementarity_residual = solution.complementarity_residual;
        result.tangent_ratio = -solution.tangent_per_width * creepage(scene, 1) / mu_N;
        result.slip_work = solution.slip_work_per_width / mu_N;
        result.status = profile.status;
        emit(creep_row(curve, scene, point, result));
        if (curve.profiles != nullptr) curve.profiles->keep(task, i, std::move(profile));
    }
}

}  // namespace friction
