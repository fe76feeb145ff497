// The gap between a wheel and a rail that pressures have displaced, by brute force: no contact may be lost.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/normal/detail/region_solver.hpp>

namespace extremes {

/// Points of the curve of a straight rail, close together, to measure distances from without the library's search.
class RailPoints {
public:
    explicit RailPoints(const rollbem::WheelOnRail& wheel) {
        for (double s = 0; s < wheel.rail().length(); s += 1e-4) {
            const rollbem::Profile::Point p = wheel.rail().at(s);
            const double y = p.y + wheel.geometry().rail_origin().y, z = p.z + wheel.geometry().rail_origin().z;
            points_[column(y)].push_back({y, z, p.slope[0], p.slope[1]});
        }
    }
    /// The height of a point of the wheel above the rail, along the rail's normal, where normals are less than 60
    /// degrees apart, infinite where nothing is near; and the rail's angle there.
    std::pair<double, double> above(double y, double z, double slope_y, double slope_z) const {
        double least = 4e-6, found = std::numeric_limits<double>::infinity(), angle = 0;
        for (int k = column(y) - 1; k <= column(y) + 1; ++k) {
            const auto points = points_.find(k);
            if (points == points_.end()) continue;
            for (const auto& [rail_y, rail_z, dy, dz] : points->second) {
                const double square = (y - rail_y) * (y - rail_y) + (z - rail_z) * (z - rail_z);
                if (square > least ||
                    dy * slope_y + dz * slope_z < 0.5 * std::hypot(dy, dz) * std::hypot(slope_y, slope_z))
                    continue;
                least = square;
                found = ((y - rail_y) * dz - (z - rail_z) * dy) / std::hypot(dy, dz);
                angle = std::atan2(dz, dy);
            }
        }
        return {found, angle};
    }

private:
    static int column(double y) { return static_cast<int>(std::floor(y / 2e-3)); }

    std::map<int, std::vector<std::array<double, 4>>> points_;
};

/// The displacement of both surfaces by the pressures of a patch at (x, y, z), along its normal [m].
inline double displacement(const rollbem::RailPatch& patch, double compliance, double x, double y, double z) {
    const double s = (y - patch.y) * std::cos(patch.angle) + (z - patch.z) * std::sin(patch.angle), here = x - patch.x;
    const rollbem::NormalContact::Cells& grid = patch.grid;
    const double beyond = (std::max)(std::abs(here - grid.x(grid.nx / 2)) / (double(grid.nx) * grid.dx),
                                     std::abs(s - grid.y(grid.ny / 2)) / (double(grid.ny) * grid.dy));
    if (beyond > 1.5)
        return compliance * patch.load / (std::numbers::pi * std::hypot(x - patch.x, y - patch.y, z - patch.z));
    const auto corner = [](double a, double b) {
        return (a == 0 ? 0 : a * std::asinh(b / std::abs(a))) + (b == 0 ? 0 : b * std::asinh(a / std::abs(b)));
    };
    double sum = 0;
    for (Eigen::Index j = 0; j < grid.ny; ++j) {
        for (Eigen::Index i = 0; i < grid.nx; ++i) {
            if (!(patch.pressure(i, j) > 0)) continue;
            const double dx = here - grid.x(i), dy = s - grid.y(j);
            const double near = 3 * (std::max)(grid.dx, grid.dy);
            sum += patch.pressure(i, j) *
                   (dx * dx + dy * dy > near * near
                        ? grid.dx * grid.dy / std::hypot(dx, dy)
                        : corner(dx + grid.dx / 2, dy + grid.dy / 2) - corner(dx - grid.dx / 2, dy + grid.dy / 2) -
                              corner(dx + grid.dx / 2, dy - grid.dy / 2) + corner(dx - grid.dx / 2, dy - grid.dy / 2));
        }
    }
    return sum * compliance / std::numbers::pi;
}

/// The least gap between a round wheel and a straight rail after the displacements of all patches [m], each seen by
/// another surface as detail::interaction says; 0 if none is negative.
inline double least_gap(const rollbem::WheelOnRail& wheel, const RailPoints& rail, rollbem::WheelsetPosition at,
                        const rollbem::WheelOnRail::Contact& contact) {
    at.height = contact.height;
    const rollbem::WheelSurface::Placed placed = wheel.geometry().placed(at);
    const double length = wheel.wheel().length();
    double least = 0;
    for (double x = -0.048; x <= 0.0481; x += 4e-3) {
        for (double s = 0; s <= length; s += 7e-4) {
            const rollbem::RailSurface::Point p = placed.section(s, x);
            if (!p.defined) continue;
            const double z = p.z + at.height;
            const auto [gap, angle] = rail.above(p.y, z, p.slope[0], p.slope[1]);
            if (!(gap < least)) continue;
            double displaced = 0;
            for (const rollbem::RailPatch& patch : contact.patches) {
                const bool own = std::hypot(p.y - patch.y, z - patch.z) < 1.5 * patch.half_width;
                displaced += (own ? 1 : rollbem::detail::interaction(angle - patch.angle)) *
                             displacement(patch, wheel.compliance(), x, p.y, z);
            }
            least = (std::min)(least, gap + displaced);
        }
    }
    return least;
}

}  // namespace extremes
