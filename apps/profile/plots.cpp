#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "profile.hpp"

namespace profile {

study::Plot draw_patches(const std::vector<Drawn>& patches, std::size_t without) {
    std::vector<study::Plot> panels;
    for (const auto& [left, patch] : patches) {
        const double sign = left ? -1 : 1;
        const auto text = [](double value, int digits) { return study::Cell(value).text(digits); };
        study::Plot plot{.title = std::string(left ? "Left" : "Right") + " wheel, N = " + text(1e-3 * patch.load, 4) +
                                  " kN, p_{max} = " + text(1e-6 * patch.peak_pressure, 4) +
                                  " MPa, δ = " + text(sign * patch.angle, 3) + " rad",
                         .x_label = "x [mm], rolling to the right",
                         .y_label = "s [mm]",
                         .z_label = "p / p_{max}"};
        study::Series pressure{.shape = study::Shape::rectangles};
        const rollbem::CellGrid& grid = patch.grid;
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
        plot.series.push_back(std::move(pressure));
        study::Series edge{.label = "outline", .markers = false, .reference = true};
        const rollbem::Outline<double>& outline = *patch.outline;
        const Eigen::ArrayXd& y = outline.y();
        for (Eigen::Index i = 0; i < y.size(); ++i) {
            edge.points.emplace_back(1e3 * outline.trailing(y[i]), sign * 1e3 * y[i]);
        }
        for (Eigen::Index i = y.size(); i-- > 0;) {
            edge.points.emplace_back(1e3 * outline.leading(y[i]), sign * 1e3 * y[i]);
        }
        edge.points.push_back(edge.points.front());
        plot.series.push_back(std::move(edge));
        study::fit_to_scale(plot);
        panels.push_back(std::move(plot));
    }
    if (without > 0 && !panels.empty()) {
        panels.back().title +=
            "; " + std::to_string(without) + (without == 1 ? " row has" : " rows have") + " no patch";
    }
    return study::in_one_column(std::move(panels));
}

study::Plot draw_contact_points(const rollbem::WheelsetOnTrack& wheelset, const std::vector<std::string>& columns,
                                const std::vector<study::Row>& rows) {
    constexpr double apart = 25;  // of the profiles [mm]
    const auto number = [&](const study::Row& row, const char* name) {
        return row[study::index_of(columns, name)].number();
    };
    std::vector<study::Plot> panels;
    for (const std::string side : {"left", "right"}) {
        const rollbem::WheelOnRail& wheel = wheelset.wheel(side == "left" ? Side::left : Side::right);
        const double offset = 1e3 * (wheel.wheel_origin() - wheel.rail_origin()),
                     rail_z = 1e3 * wheel.geometry().rail_origin().z;
        study::Plot plot{.title = "Where the " + side + " wheel touches the rail, over the lateral shift",
                         .x_label = "y from the rail's origin, field side to the right [mm]",
                         .y_label = "z [mm]"};
        study::Series joined{.label = "contact points", .style = 1};
        std::size_t all = 0, without = 0;
        for (const study::Row& row : rows) {
            if (row[study::index_of(columns, "side")].text() != side) continue;
            ++all;
            if (!number(row, "load")) {
                ++without;
                continue;
            }
            joined.points.emplace_back(1e3 * *number(row, "rail_y"), 1e3 * *number(row, "z") - rail_z);
            joined.points.emplace_back(offset + 1e3 * *number(row, "wheel_y"),
                                       1e3 * (*number(row, "rolling_radius") - wheel.dimensions().radius) - apart);
            joined.points.emplace_back(std::nan(""), 0);
        }
        if (all == 0) continue;
        if (without > 0)
            plot.title += "; " + std::to_string(without) + " of " + std::to_string(all) + " rows have none";
        const auto curve = [&](const rollbem::Profile& profile, double dy, double dz, const char* label,
                               std::size_t style) {
            study::Series series{.label = label, .markers = false, .style = style, .reference = true};
            for (Eigen::Index i = 0; i < profile.size(); ++i) {
                series.points.emplace_back(1e3 * profile.y()[i] + dy, 1e3 * profile.z()[i] + dz);
            }
            plot.series.push_back(std::move(series));
        };
        curve(wheel.rail(), 0, 0, "rail", 4);
        curve(wheel.wheel(), offset, -apart, "wheel", 1);
        plot.series.push_back(std::move(joined));
        study::fit_to_scale(plot);
        panels.push_back(std::move(plot));
    }
    return study::in_one_column(std::move(panels));
}

}  // namespace profile
