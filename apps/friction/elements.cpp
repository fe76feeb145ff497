// Creep curves by elements, in one direction and in both.
#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "rolling.hpp"
#include "steady.hpp"
#include "support/timing.hpp"

namespace friction {

namespace {

constexpr double V = 1;  // rolling velocity

using Contact = rollbem::FrictionModel;
using Direction = Line::Direction;

/// A point of the scene's elements without a solution.
Solution unsolved(const study::Scene& scene, const Line& line) {
    return {.mesh_name = scene.mesh_name,
            .alpha_L = scene.alpha_L,
            .alpha_T = scene.alpha_T,
            .x = scene.mesh->centres(),
            .bound = line.pressure(*scene.mesh),
            .full = mu_N * scene.contact.width()};
}

/// The contact of a curve; nothing where G' is not finite.
std::optional<Contact> contact_of(const Curve& curve, const study::Scene& scene) {
    std::optional<System> along, across;
    try {
        along = curve.line.system(scene, Direction::longitudinal, false);
        across = curve.line.lateral_system(scene, false);
    } catch (const std::invalid_argument&) {  // all else has been checked with the options
        return std::nullopt;
    }
    return curve.line.contact(scene, *along, across, curve.line.pressure(*scene.mesh), rollbem::StabilityVerdict{});
}

/// The states that the points of a curve start from: rest, or in a sweep the solutions of their neighbours. Each pair
/// of lateral ratio and spin has a sweep of its own, unless it has one point only.
std::vector<Contact::State> starts_of(const Curve& curve, const study::Scene& scene, const Contact& contact) {
    const std::vector<CreepPoint>& points = curve.points;
    const auto rest = contact.at_rest();
    std::vector<Contact::State> starts(points.size(), rest);
    if (curve.sweep.empty()) return starts;
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        const bool up = curve.sweep == "up";
        const CreepPoint &x = points[up ? i : j], &y = points[up ? j : i];
        return std::tie(x.lateral, x.spin, x.longitudinal) < std::tie(y.lateral, y.spin, y.longitudinal);
    });
    const bool along = std::any_of(points.begin(), points.end(), [&](const CreepPoint& point) {
        return point.longitudinal != points.front().longitudinal;
    });
    auto state = rest, next = rest;
    auto workspace = contact.workspace();
    const CreepPoint* before = nullptr;
    for (const std::size_t i : order) {
        const CreepPoint& point = points[i];
        const bool begins = before == nullptr || point.lateral != before->lateral || point.spin != before->spin;
        if (along && begins) state = rest;
        before = &point;
        starts[i] = state;
        const auto step =
            contact.steady(state, {rollbem::Travel::at_speed(V), point.times(creepage_unit(scene))}, next, workspace);
        const bool solved = step.status == rollbem::Status::ok;
        if (solved || step.status == rollbem::Status::assists_creepage) std::swap(state, next);
    }
    return starts;
}

/// The distributions; elements beyond the solution's, at the leading edge, carry nothing and slip.
void fill(const Contact::State& state, const rollbem::ElementVectors& slip, Solution& solution) {
    const Eigen::Index n = solution.x.size(), known = slip.rows();
    solution.traction.setZero(n, 2);
    solution.traction.topRows(known) = state.traction;
    solution.slip.setZero(n, 2);
    solution.slip.topRows(known) = slip;
    solution.sticks.assign(std::size_t(n), false);
    for (std::size_t i = 0; i < state.zones.size(); ++i) solution.sticks[i] = state.zones[i] == rollbem::Zone::stick;
    if (state.friction_coefficient.size() == 0) return;
    solution.friction.setOnes(n);
    solution.friction.head(known) = state.friction_coefficient;
}

}  // namespace

void leave_out(const study::Scene& scene, study::RowRange range, const Line& line, const See& see) {
    Solution solution = unsolved(scene, line);
    solution.status = name(rollbem::Status::not_finite);
    for (std::size_t i = range.first; i < range.last; ++i) see(i, solution);
}

void solve_by_elements(const Curve& curve, const study::Scene& scene, study::RowRange range, const See& see) {
    const std::optional<Contact> contact = contact_of(curve, scene);
    if (!contact) return leave_out(scene, range, curve.line, see);
    Solution solution = unsolved(scene, curve.line);
    if (curve.timed) {
        solution.assembly_us = study::median_time_us([&] {
            const auto across = curve.line.lateral_system(scene, false);
            return curve.line.system(scene, Direction::longitudinal, false).G_prime()(0, 0) +
                   (across ? across->G_prime()(0, 0) : 0);
        });
    }
    const auto starts = starts_of(curve, scene, *contact);
    auto state = contact->at_rest();
    const auto fresh = contact->workspace();
    auto workspace = fresh;
    for (std::size_t i = range.first; i < range.last; ++i) {
        CreepPoint point = curve.points[i];
        const auto at = [&](double longitudinal) {
            point.longitudinal = longitudinal;
            return contact->steady(starts[i], {rollbem::Travel::at_speed(V), point.times(creepage_unit(scene))}, state,
                                   workspace);
        };
        const auto solve = [&] {
            workspace = fresh;  // without factors
            solution.step =
                curve.force ? find_for_force(*curve.force, solution.full, 0, at) : at(curve.points[i].longitudinal);
            return solution.step.slip_work;
        };
        solution.time_us = study::time_us_if(curve.timed, solve);
        solution.status = name(solution.step.status);
        if (curve.force) {
            solution.creepage_ratio = solution.step.status == rollbem::Status::ok ? point.longitudinal : std::nan("");
        }
        solution.path_points = solution.step.path_points;
        fill(state, workspace.slip(), solution);
        see(i, solution);
    }
}

}  // namespace friction
