// Creep curves by elements, in one direction and in both.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/friction/combined.hpp>

#include "creep_curve.hpp"
#include "support/timing.hpp"
#include "surface.hpp"

namespace friction {

namespace {

/// Slip hides what is wrong with a scheme that does not converge; in full adhesion it shows.
bool is_consistent(const Eigen::MatrixXd& G_prime, const Eigen::ArrayXd& widths) {
    return rollbem::solve_steady<double>(G_prime, widths).status != rollbem::Status::inconsistent;
}

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

struct OneDirection {
    using Model = rollbem::SteadyFrictionModel<double>;

    static double creepage(const study::Scene& scene, const CreepPoint& point) {
        return friction::creepage(scene, point.longitudinal);
    }
    static void read(const Model::Step& step, double unit, CreepResult& result) {
        result.force_ratio = 0 - step.force_per_width / mu_N;
        result.tangent_ratio = -step.tangent_per_width * unit / mu_N;
    }
    static void read_counts(const Model::Step& step, CreepResult& result) { result.pivots = step.pivots; }
    static void fill(const Model::State& state, const Eigen::VectorXd& slip, Profile& profile) {
        profile.traction.head(slip.size()) = state.traction;
        profile.slip.head(slip.size()) = slip;
        for (std::size_t i = 0; i < state.zones.size(); ++i) {
            profile.sticks[i] = state.zones[i] == rollbem::Zone::stick;
        }
    }
};

/// In either: the coefficients.
template <class Directions, class Model_>
struct WithFalling : Directions {
    using Model = Model_;

    template <class Slip>
    static void fill(const typename Model::State& state, const Slip& slip, Profile& profile) {
        Directions::fill(state, slip, profile);
        profile.friction = Eigen::VectorXd::Ones(profile.traction.size());
        profile.friction.head(slip.rows()) = state.friction_coefficient.matrix();
    }
};

struct BothDirections {
    using Model = rollbem::SteadyCombinedModel<double>;

    static rollbem::Creepage<double> creepage(const study::Scene& scene, const CreepPoint& point) {
        return {friction::creepage(scene, point.longitudinal), friction::creepage(scene, point.lateral.value_or(0))};
    }
    static void read(const Model::Step& step, double unit, CreepResult& result) {
        result.force_ratio = 0 - step.force_per_width.longitudinal / mu_N;
        result.lateral_force_ratio = 0 - step.force_per_width.lateral / mu_N;
        result.tangent_ratio = -step.tangent_per_width.by_longitudinal.longitudinal * unit / mu_N;
        result.lateral_tangent_ratio = -step.tangent_per_width.by_lateral.lateral * unit / mu_N;
    }
    static void read_counts(const Model::Step&, CreepResult&) {}
    static void fill(const Model::State& state, const rollbem::ElementVectors<double>& slip, Profile& profile) {
        profile.lateral_traction = Eigen::VectorXd::Zero(profile.traction.size());
        profile.lateral_slip = profile.lateral_traction;
        profile.traction.head(slip.rows()) = state.traction.col(0);
        profile.lateral_traction.head(slip.rows()) = state.traction.col(1);
        profile.slip.head(slip.rows()) = slip.col(0);
        profile.lateral_slip.head(slip.rows()) = slip.col(1);
        for (std::size_t i = 0; i < state.zones.size(); ++i) {
            profile.sticks[i] = state.zones[i] == rollbem::CombinedZone::stick;
        }
    }
};

using Falling = WithFalling<OneDirection, SteadyFalling>;
using CombinedFalling = WithFalling<BothDirections, SteadyCombinedFalling>;

/// The points of a curve in the order of a sweep: a lateral ratio after the other.
std::vector<std::size_t> sweep_order(const CreepCurve& curve, bool up) {
    std::vector<std::size_t> order(curve.points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        const CreepPoint &x = curve.points[up ? i : j], &y = curve.points[up ? j : i];
        return x.lateral != y.lateral ? x.lateral < y.lateral : x.longitudinal < y.longitudinal;
    });
    return order;
}

/// The states that the points of a curve start from in a sweep, the solutions of their neighbours; `see` is told of
/// the steps in its order. Each lateral ratio has a sweep of its own, unless it has one point only.
template <class Directions, class See>
std::vector<typename Directions::Model::State> sweep(const CreepCurve& curve, const study::Scene& scene,
                                                     const typename Directions::Model& model, bool up, const See& see) {
    const auto rest = model.at_rest();
    std::vector<typename Directions::Model::State> starts(curve.points.size(), rest);
    const bool along = std::any_of(curve.points.begin(), curve.points.end(), [&](const CreepPoint& point) {
        return point.longitudinal != curve.points.front().longitudinal;
    });
    auto state = rest, next = rest;
    auto workspace = model.workspace();
    std::optional<double> lateral;
    for (const std::size_t i : sweep_order(curve, up)) {
        if (along && curve.points[i].lateral != lateral) state = rest;
        lateral = curve.points[i].lateral;
        starts[i] = state;
        const auto step = model.solve(state, Directions::creepage(scene, curve.points[i]), next, workspace);
        if (step.status != rollbem::StepStatus::ok) continue;
        std::swap(state, next);
        see(curve.points[i], step);
    }
    return starts;
}

/// The states that the points of a curve start from: at rest, or in a sweep.
template <class Directions>
std::vector<typename Directions::Model::State> starts_of(const CreepCurve& curve, const study::Scene& scene,
                                                         const typename Directions::Model& model) {
    if (curve.sweep.empty()) {
        return std::vector<typename Directions::Model::State>(curve.points.size(), model.at_rest());
    }
    return sweep<Directions>(curve, scene, model, curve.sweep == "up", [](const CreepPoint&, const auto&) {});
}

/// The rows of a model; `assemble` is timed and does what its making costs.
template <class Directions, class Assemble>
void rows_of(const CreepCurve& curve, const study::Scene& scene, std::size_t task, study::RowRange range,
             const study::Emit& emit, const typename Directions::Model& model, const Eigen::ArrayXd& means,
             bool consistent, const Assemble& assemble) {
    CreepResult frame{.mesh_name = scene.mesh_name, .alpha_L = scene.alpha_L, .alpha_T = scene.alpha_T};
    if (curve.timed()) frame.assembly_us = study::median_time_us(assemble);
    const auto starts = starts_of<Directions>(curve, scene, model);
    auto state = model.at_rest();
    const auto fresh = model.workspace();
    auto workspace = fresh;
    for (std::size_t i = range.first; i < range.last; ++i) {
        const CreepPoint& point = curve.points[i];
        const auto creepage = Directions::creepage(scene, point);
        const auto solve = [&] {
            workspace = fresh;  // without factors
            return model.solve(starts[i], creepage, state, workspace);
        };
        const auto step = solve();
        CreepResult result = frame;
        if (curve.timed()) result.time_us = study::median_time_us([&] { return solve().slip_work_per_width; });
        result.status = status_of(step.status, consistent);
        result.stick_count = step.stick_count;
        result.rounds = step.rounds;
        result.complementarity_residual = step.complementarity_residual;
        Directions::read_counts(step, result);
        if (consistent && step.status == rollbem::StepStatus::ok) {
            Directions::read(step, friction::creepage(scene, 1), result);
            result.slip_work = step.slip_work_per_width / mu_N;
        }
        emit(creep_row(curve, scene, point, result));
        if (curve.profiles != nullptr) {
            Profile profile = empty_profile(scene, point, result.status, means);
            Directions::fill(state, workspace.slip(), profile);
            curve.profiles->keep(task, i, std::move(profile));
        }
    }
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
    const auto [G_prime, widths] = surface.gradient(Direction::longitudinal);
    if (!G_prime.allFinite()) return rows_without(curve, scene, task, range, emit);
    const Eigen::ArrayXd means = curve.pressure(*scene.mesh);
    rows_of<OneDirection>(curve, scene, task, range, emit, surface.steady_model({1, means}), means,
                          is_consistent(G_prime, widths),
                          [&] { return surface.gradient(Direction::longitudinal).first(0, 0); });
}

void falling_rows(const CreepCurve& curve, const study::Scene& scene, std::size_t task, study::RowRange range,
                  const study::Emit& emit) {
    const Surface surface{scene, curve.layer};
    const auto [G_prime, widths] = surface.gradient(Direction::longitudinal);
    if (!G_prime.allFinite()) return rows_without(curve, scene, task, range, emit);
    const Eigen::ArrayXd means = curve.pressure(*scene.mesh);
    const SteadyFalling model = surface.falling_model(*curve.falling, means);
    if (curve.other != nullptr) {
        std::vector<std::pair<double, double>> points;
        sweep<Falling>(curve, scene, model, curve.sweep != "up", [&](const CreepPoint& point, const auto& step) {
            points.emplace_back(point.longitudinal, -step.force_per_width / mu_N);
        });
        curve.other->keep(task, std::move(points));
    }
    rows_of<Falling>(curve, scene, task, range, emit, model, means, is_consistent(G_prime, widths),
                     [&] { return surface.gradient(Direction::longitudinal).first(0, 0); });
}

void combined_rows(const CreepCurve& curve, const study::Scene& scene, std::size_t task, study::RowRange range,
                   const study::Emit& emit) {
    const Surface surface{scene, curve.layer};
    const auto [along, widths] = surface.gradient(Direction::longitudinal);
    const Eigen::MatrixXd across = surface.gradient(Direction::lateral).first;
    if (!along.allFinite() || !across.allFinite()) return rows_without(curve, scene, task, range, emit);
    const Eigen::ArrayXd means = curve.pressure(*scene.mesh);
    const bool consistent = is_consistent(along, widths) && is_consistent(across, widths);
    const auto assemble = [&] {
        return surface.gradient(Direction::longitudinal).first(0, 0) + surface.gradient(Direction::lateral).first(0, 0);
    };
    if (curve.falling) {
        rows_of<CombinedFalling>(curve, scene, task, range, emit, surface.combined_falling_model(*curve.falling, means),
                                 means, consistent, assemble);
    } else {
        rows_of<BothDirections>(curve, scene, task, range, emit, surface.combined_model({1, means}), means, consistent,
                                assemble);
    }
}

}  // namespace friction
