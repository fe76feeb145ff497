#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/normal/profile_wear.hpp>

#include "profile.hpp"

namespace profile {

study::Picture draw_patches(const std::vector<Drawn>& patches, std::size_t without) {
    study::Picture panels;
    for (const auto& [left, patch] : patches) {
        const double sign = left ? -1 : 1;
        const auto text = [](double value, int digits) { return study::Cell(value).text(digits); };
        study::Series pressure{"", study::Look::cells}, edge{"outline", study::Look::exact};
        const rollbem::NormalContact::Cells& grid = patch.grid;
        for (Eigen::Index i = 0; i < grid.nx; ++i) {
            for (Eigen::Index j = 0; j < grid.ny; ++j) {
                const double p = patch.pressure(i, j);
                if (!(p > 0)) continue;
                const double x = 1e3 * grid.x(i), s = sign * 1e3 * grid.y(j);
                pressure.points.emplace_back(x - 500 * grid.dx, s - 500 * grid.dy);
                pressure.points.emplace_back(x + 500 * grid.dx, s + 500 * grid.dy);
                pressure.values.push_back(p / patch.pressure.maxCoeff());
            }
        }
        for (const auto& [x, y] : study::edge_of(*patch.outline)) edge.points.emplace_back(1e3 * x, sign * 1e3 * y);
        panels.push_back({.title = std::string(left ? "Left" : "Right") + " wheel, N = " + text(1e-3 * patch.load, 4) +
                                   " kN, p_{max} = " + text(1e-6 * patch.peak_pressure, 4) +
                                   " MPa, δ = " + text(sign * patch.angle, 3) + " rad",
                          .x = {"x [mm], rolling to the right"},
                          .y = {"s [mm]"},
                          .colours = "p / p_{max}",
                          .to_scale = true,
                          .y_down = true,
                          .series = {std::move(pressure), std::move(edge)}});
    }
    if (without > 0 && !panels.empty()) {
        panels.back().title +=
            "; " + std::to_string(without) + (without == 1 ? " row has" : " rows have") + " no patch";
    }
    return panels;
}

study::Picture draw_wear(const std::vector<Worn>& bodies) {
    study::Picture panels;
    for (const auto& [name, before, after, body] : bodies) {
        const Eigen::ArrayXd depth = depth_between(before, after, body);
        const double sign = body == rollbem::Profile::Use::wheel ? -1 : 1;
        study::Series new_one{"before", study::Look::exact}, worn{"after", study::Look::outline},
            drawn{"depth times 10"};
        for (Eigen::Index i = 0; i < before.size(); ++i) {
            new_one.points.emplace_back(1e3 * before.y()[i], 1e3 * before.z()[i]);
        }
        for (Eigen::Index i = 0; i < after.size(); ++i) {
            const rollbem::Profile::Point at = after.at(after.s()[i]);
            const double more = 9 * sign * depth[i] / std::hypot(at.slope[0], at.slope[1]);
            worn.points.emplace_back(1e3 * at.y, 1e3 * at.z);
            drawn.points.emplace_back(1e3 * (at.y - more * at.slope[1]), 1e3 * (at.z + more * at.slope[0]));
        }
        panels.push_back({.title = name + ", worn by at most " + study::Cell(1e3 * depth.maxCoeff()).text(3) + " mm, " +
                                   study::Cell(1e6 * area_between(before, after, body)).text(3) + " mm^2",
                          .x = {"y [mm]"},
                          .y = {"z [mm]"},
                          .to_scale = true,
                          .series = {std::move(new_one), std::move(worn), std::move(drawn)}});
    }
    return panels;
}

study::Picture draw_contact_points(const rollbem::WheelsetOnTrack& wheelset, const study::Records& all) {
    constexpr double apart = 25, room = 26;  // of the profiles, and of three lines of numbers above them [mm]
    study::Picture panels;
    for (const std::string side : {"left", "right"}) {
        const rollbem::WheelOnRail& wheel = wheelset.wheel(side == "left" ? Side::left : Side::right);
        const double offset = 1e3 * (wheel.wheel_origin() - wheel.rail_origin()),
                     rail_z = 1e3 * wheel.geometry().rail_origin().z;
        study::Series joined{"contact points"};
        std::vector<study::PlotNote> shifts;
        const study::Records rows = all.with("side", side);
        std::size_t without = 0;
        for (const study::Row& row : rows.rows) {
            const auto in_mm = [&](const char* name) { return 1e3 * rows.number(row, name); };
            if (std::isnan(in_mm("load"))) {
                ++without;
                continue;
            }
            joined.points.emplace_back(in_mm("rail_y"), in_mm("z") - rail_z);
            joined.points.emplace_back(offset + in_mm("wheel_y"),
                                       in_mm("rolling_radius") - 1e3 * wheel.dimensions().radius - apart);
            const auto [y, z] = joined.points.back();
            joined.points.emplace_back(std::nan(""), 0);
            shifts.push_back({y, z, study::Cell(in_mm("shift")).text(3)});
        }
        if (rows.rows.empty()) continue;
        const auto curve = [](const rollbem::Profile& profile, double dy, double dz, study::Series series) {
            for (Eigen::Index i = 0; i < profile.size(); ++i) {
                series.points.emplace_back(1e3 * profile.y()[i] + dy, 1e3 * profile.z()[i] + dz);
            }
            return series;
        };
        std::vector<study::Series> series{curve(wheel.rail(), 0, 0, {"rail", study::Look::outline}),
                                          curve(wheel.wheel(), offset, -apart, {"wheel, lifted", study::Look::exact})};
        study::PlotRange range{0, 0};
        for (const study::Series& one : series) {
            for (const auto& [y, z] : one.points) range = {std::min(range.low, z - room), std::max(range.high, z + 1)};
        }
        series.push_back(std::move(joined));
        panels.push_back({.title = "Where the " + side +
                                   " wheel, lifted by 25 mm, touches the rail; numbers: lateral shift [mm]" +
                                   (without == 0 ? ""
                                                 : "; " + std::to_string(without) + " of " +
                                                       std::to_string(rows.rows.size()) + " rows have none"),
                          .x = {"y from the rail's origin, field side to the right [mm]"},
                          .y = {.label = "z [mm]", .range = range},
                          .to_scale = true,
                          .y_down = true,
                          .series = std::move(series),
                          .notes = std::move(shifts)});
    }
    return panels;
}

}  // namespace profile
