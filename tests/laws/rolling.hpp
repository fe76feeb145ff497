// Force elements of tests/laws: wheelsets that roll on patches.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include <rollbem/vehicle.hpp>

#include "laws/force_element.hpp"

namespace laws {

namespace rolling_detail {

constexpr double V = 20, Q = 1e5;

inline WheelsetForces forces_of(const Numbers& x, bool curved) {
    static const WheelsetOnTrack wheelset(WheelOnRail(s1002(), rail_uic60()));
    WheelsetOnTrack::Workspace workspace;
    return rolling_forces(wheelset,
                          {.position = {.lateral = x[0], .yaw = x[1]},
                           .loads = {x[7] - x[8], x[7] + x[8]},
                           .speeds = {x[2], 0, x[3], x[4], x[5], x[6]}},
                          {.coefficient = x[9], .elements = 4, .strips = 5, .curved_slip = curved}, workspace,
                          {.cells_x = 10, .cells_s = 8, .halves_cells = false});
}

/// What acts on the rail below a wheel: tractions of elements, and pressures of rows of cells along the normals of the
/// rail's surface; about the middle of the axle.
inline void add_wheel(const WheelsetForces& rolling, WheelsetSide side, std::vector<Wrench>& parts) {
    const auto k = static_cast<std::size_t>(side);
    const WheelsetPosition at = rolling.contacts.seen(side);
    const Eigen::DiagonalMatrix<double, 3> mirror(1, side == WheelsetSide::left ? -1 : 1, 1);
    for (std::size_t i = 0; i < rolling.patches[k].size(); ++i) {
        const RailPatch& patch = rolling.contacts.wheels[k].patches[i];
        const PatchForce& friction = rolling.patches[k][i];
        const Eigen::AngleAxisd turn(patch.angle, Eigen::Vector3d::UnitX());
        const Eigen::Vector3d middle(patch.x, patch.y - at.lateral, patch.z - at.height + 0.46);
        const auto add = [&](const Eigen::Vector3d& place, const Eigen::Vector3d& force) {
            parts.push_back({mirror * (middle + turn * place), mirror * (turn * force)});
        };
        for (Eigen::Index e = 0; e < friction.slip.size(); ++e) {
            const Yield::LoadedRectangle& of = friction.surface[friction.first_element + std::size_t(e)];
            const double area = (of.x_2 - of.x_1) * (of.y_2 - of.y_1);
            add({(of.x_1 + of.x_2) / 2, (of.y_1 + of.y_2) / 2, patch.approach},
                {area * of.traction_x, area * of.traction_y, 0});
        }
        for (Eigen::Index j = 0; j < patch.grid.ny; ++j) {
            for (Eigen::Index c = 0; c < patch.grid.nx; ++c) {
                const double load = patch.pressure(c, j) * patch.grid.dx * patch.grid.dy;
                add({patch.grid.x(c), patch.grid.y(j), patch.rail_n[j]}, {0, -load * patch.rail_slope[j], load});
            }
        }
    }
}

}  // namespace rolling_detail

/// Lateral shift and yaw, speeds but the pitch rate, mean and half of the difference of both loads, and mu. Values are
/// force, moment, the free pitch rate and the heat.
inline ForceElement rolling_wheelset(bool curved = false) {
    using namespace rolling_detail;
    ForceElement result{
        .name = "a rolling wheelset",
        .inputs = {{1e-4}, {1e-3}, {V}, {0.02}, {0.02}, {0.02}, {0.02}, {Q}, {Q}, {0.3}},
        .values = {{Q}, {Q}, {Q}, {Q}, {Q}, {Q}, {1e-2}, {1e-3 * Q}},
        .draw =
            [](Draw& draw) {
                Numbers x(10);
                x << draw.uniform(-4e-3, 4e-3), draw.uniform(-4e-3, 4e-3), V * draw.sign(), draw.uniform(-0.02, 0.02),
                    draw.uniform(-0.02, 0.02), draw.uniform(-0.02, 0.02), draw.uniform(-0.02, 0.02),
                    Q * draw.uniform(0.5, 1.2), Q * draw.uniform(-0.2, 0.2), draw.uniform(0.1, 0.4);
                return x;
            },
        .answer =
            [curved](const Numbers& x) {
                const WheelsetForces at = forces_of(x, curved);
                Answer answer{Numbers::Constant(8, nan), Tangent(8, 0), at.status()};
                if (!has_numbers(at.status())) return answer;
                for (std::size_t i = 0; i < 3; ++i) {
                    answer.values[Eigen::Index(i)] = at.on_wheelset.force[i];
                    answer.values[Eigen::Index(i) + 3] = at.on_wheelset.moment[i];
                }
                answer.values.tail(2) << at.pitch_rate, at.slip_work();
                return answer;
            },
        .symmetries = {{"across the track", "--+-+--+-+", "+-+-+-++"}, {"backwards", "+--+++-+++", "-+++---+"}}};
    result.on_rail = [curved](const Numbers& x) {
        const WheelsetForces at = forces_of(x, curved);
        std::vector<Wrench> parts;
        for (const WheelsetSide side : WheelsetOnTrack::sides) add_wheel(at, side, parts);
        return parts;
    };
    for (std::size_t j = 0; j < 7; ++j) result.refusals.push_back({j, {nan, infinite, -infinite}, Status::not_finite});
    return result;
}

}  // namespace laws
