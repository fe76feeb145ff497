// Creep curves by elements, in one direction and in both.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <rollbem/compiled/friction.hpp>

#include "creep_curve.hpp"
#include "support/timing.hpp"
#include "surface.hpp"

namespace friction {

namespace {

constexpr double V = 1;  // rolling velocity

/// Elements beyond the solution's, at the leading edge, carry nothing and slip.
Profile empty_profile(const study::Scene& scene, const CreepPoint& point, std::string status,
                      const Eigen::ArrayXd& means) {
    Profile profile{.scene = &scene,
                    .mesh_name = scene.mesh_name,
                    .alpha_L = scene.alpha_L,
                    .alpha_T = scene.alpha_T,
                    .point = point,
                    .status = std::move(status),
                    .mesh = *scene.mesh,
                    .traction = Eigen::VectorXd::Zero(scene.n()),
                    .bound = means.matrix(),
                    .slip = Eigen::VectorXd::Zero(scene.n())};
    profile.sticks.resize(std::size_t(scene.n()), false);
    return profile;
}

template <int directions>
rollbem::detail::ByDirections<directions, double, rollbem::Creepage<double>> creepage_of(const study::Scene& scene,
                                                                                         const CreepPoint& point) {
    if constexpr (directions == 1) {
        return creepage(scene, point.longitudinal);
    } else {
        return {creepage(scene, point.longitudinal), creepage(scene, point.lateral.value_or(0)),
                creepage(scene, point.spin)};
    }
}

/// The numbers of a solution; `unit` is the creepage of ratio 1, `full` the force of full sliding.
void read(const rollbem::FrictionStep<>& step, double unit, double full, CreepResult& result) {
    result.force_ratio = 0 - step.force / full;
    result.tangent_ratio = -step.tangent * unit / full;
}
void read(const rollbem::FrictionStep<2>& step, double unit, double full, CreepResult& result) {
    result.force_ratio = 0 - step.force.longitudinal / full;
    result.lateral_force_ratio = 0 - step.force.lateral / full;
    result.moment_ratio = 0 - step.force.moment / full;
    result.tangent_ratio = -step.tangent.by_longitudinal.longitudinal * unit / full;
    result.lateral_tangent_ratio = -step.tangent.by_lateral.lateral * unit / full;
}

template <int directions>
void fill(const rollbem::FrictionState<directions>& state, const rollbem::ElementVectors<double, directions>& slip,
          Profile& profile) {
    profile.traction.head(slip.rows()) = state.traction.col(0);
    profile.slip.head(slip.rows()) = slip.col(0);
    if constexpr (directions == 2) {
        profile.lateral_traction = Eigen::VectorXd::Zero(profile.traction.size());
        profile.lateral_slip = profile.lateral_traction;
        profile.lateral_traction.head(slip.rows()) = state.traction.col(1);
        profile.lateral_slip.head(slip.rows()) = slip.col(1);
    }
    for (std::size_t i = 0; i < state.zones.size(); ++i) profile.sticks[i] = state.zones[i] == rollbem::Zone::stick;
    if (state.friction_coefficient.size() == 0) return;
    profile.friction = Eigen::VectorXd::Ones(profile.traction.size());
    profile.friction.head(slip.rows()) = state.friction_coefficient.matrix();
}

/// The points of a curve in the order of a sweep: one pair of lateral ratio and spin after the other.
std::vector<std::size_t> sweep_order(const CreepCurve& curve, bool up) {
    std::vector<std::size_t> order(curve.points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        const CreepPoint &x = curve.points[up ? i : j], &y = curve.points[up ? j : i];
        return std::tie(x.lateral, x.spin, x.longitudinal) < std::tie(y.lateral, y.spin, y.longitudinal);
    });
    return order;
}

/// The states that the points of a curve start from in a sweep, the solutions of their neighbours; `see` is told of
/// the steps in its order. Each pair of lateral ratio and spin has a sweep of its own, unless it has one point only.
template <class Model, class See>
std::vector<typename Model::State> sweep(const CreepCurve& curve, const study::Scene& scene, const Model& model,
                                         bool up, const See& see) {
    const auto rest = model.at_rest();
    std::vector<typename Model::State> starts(curve.points.size(), rest);
    const bool along = std::any_of(curve.points.begin(), curve.points.end(), [&](const CreepPoint& point) {
        return point.longitudinal != curve.points.front().longitudinal;
    });
    auto state = rest, next = rest;
    auto workspace = model.workspace();
    std::optional<double> lateral;
    double spin = 0;
    for (const std::size_t i : sweep_order(curve, up)) {
        if (along && (curve.points[i].lateral != lateral || curve.points[i].spin != spin)) state = rest;
        lateral = curve.points[i].lateral;
        spin = curve.points[i].spin;
        starts[i] = state;
        const auto creepage = creepage_of<Model::directions>(scene, curve.points[i]);
        const auto step = model.steady(state, creepage, V, next, workspace);
        const bool solved = step.status == rollbem::StepStatus::ok;
        if (solved || step.status == rollbem::StepStatus::assists_creepage) std::swap(state, next);
        if (solved) see(curve.points[i], step);
    }
    return starts;
}

/// The states that the points of a curve start from: at rest, or in a sweep.
template <class Model>
std::vector<typename Model::State> starts_of(const CreepCurve& curve, const study::Scene& scene, const Model& model) {
    if (curve.sweep.empty()) return std::vector<typename Model::State>(curve.points.size(), model.at_rest());
    return sweep(curve, scene, model, curve.sweep == "up", [](const CreepPoint&, const auto&) {});
}

/// The rows of a model of the surface.
template <class Model>
void rows_of(const CreepCurve& curve, const study::Scene& scene, std::size_t task, study::RowRange range,
             const study::Emit& emit, const Surface& surface, const Model& model, const Eigen::ArrayXd& means) {
    CreepResult frame{.mesh_name = scene.mesh_name, .alpha_L = scene.alpha_L, .alpha_T = scene.alpha_T};
    if (curve.timed()) {
        frame.assembly_us = study::median_time_us([&] {
            const double along = surface.gradient(Direction::longitudinal)(0, 0);
            return Model::directions == 1 ? along : along + surface.gradient(Direction::lateral)(0, 0);
        });
    }
    const auto starts = starts_of(curve, scene, model);
    auto state = model.at_rest();
    const auto fresh = model.workspace();
    auto workspace = fresh;
    for (std::size_t i = range.first; i < range.last; ++i) {
        const CreepPoint& point = curve.points[i];
        const auto creepage = creepage_of<Model::directions>(scene, point);
        const auto solve = [&] {
            workspace = fresh;  // without factors
            return model.steady(starts[i], creepage, V, state, workspace);
        };
        const auto step = solve();
        CreepResult result = frame;
        if (curve.timed()) result.time_us = study::median_time_us([&] { return solve().slip_work; });
        result.status = name(step.status);
        result.stick_count = step.stick_count;
        result.rounds = step.rounds;
        result.complementarity_residual = step.complementarity_residual;
        if (Model::directions == 1) result.pivots = step.pivots;
        if (step.status == rollbem::StepStatus::ok) {
            const double full = mu_N * scene.contact.width();
            read(step, friction::creepage(scene, 1), full, result);
            result.slip_work = step.slip_work / full;
        }
        emit(creep_row(curve, scene, point, result));
        if (curve.profiles != nullptr) {
            Profile profile = empty_profile(scene, point, result.status, means);
            fill<Model::directions>(state, workspace.slip(), profile);
            curve.profiles->keep(task, i, std::move(profile));
        }
    }
}

/// Whether G' is, in one direction or in both.
bool is_finite(const Surface& surface, bool both) {
    return surface.gradient(Direction::longitudinal).allFinite() &&
           (!both || surface.gradient(Direction::lateral).allFinite());
}

}  // namespace

void rows_without(const CreepCurve& curve, const study::Scene& scene, std::size_t task, study::RowRange range,
                  const study::Emit& emit) {
    CreepResult result{.mesh_name = scene.mesh_name, .alpha_L = scene.alpha_L, .alpha_T = scene.alpha_T};
    result.status = name(rollbem::Status::not_finite);
    const Eigen::ArrayXd means = curve.pressure(*scene.mesh);
    for (std::size_t i = range.first; i < range.last; ++i) {
        emit(creep_row(curve, scene, curve.points[i], result));
        if (curve.profiles == nullptr) continue;
        curve.profiles->keep(task, i, empty_profile(scene, curve.points[i], result.status, means));
    }
}

void element_rows(const CreepCurve& curve, const study::Scene& scene, std::size_t task, study::RowRange range,
                  const study::Emit& emit) {
    const Surface surface{scene, curve.layer};
    const bool both = curve.points.front().lateral.has_value();
    if (!is_finite(surface, both)) return rows_without(curve, scene, task, range, emit);
    const Eigen::ArrayXd means = curve.pressure(*scene.mesh);
    const rollbem::Friction<> coulomb{1, means};
    const auto rows = [&](const auto& model) { rows_of(curve, scene, task, range, emit, surface, model, means); };
    if (!curve.falling) return both ? rows(surface.steady_model<2>(coulomb)) : rows(surface.steady_model<1>(coulomb));
    const rollbem::Friction<rollbem::ExponentialFall<>> falling = curve.falling->under(means);
    if (both) return rows(surface.steady_model<2>(falling));
    const auto model = surface.steady_model<1>(falling);
    if (curve.other != nullptr) {
        std::vector<std::pair<double, double>> points;
        sweep(curve, scene, model, curve.sweep != "up", [&](const CreepPoint& point, const auto& step) {
            points.emplace_back(point.longitudinal, -step.force / (mu_N * scene.contact.width()));
        });
        curve.other->keep(task, std::move(points));
    }
    rows(model);
}

}  // namespace friction
