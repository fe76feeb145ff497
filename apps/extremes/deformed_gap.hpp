// The gap between a wheel and a rail that pressures have displaced, by brute force: no contact may be lost.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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
            const double size = std::hypot(p.slope[0], p.slope[1]);
            points_.push_back({p.y + wheel.geometry().rail_origin().y, p.z + wheel.geometry().rail_origin().z,
                               p.slope[0] / size, p.slope[1] / size});
        }
        std::sort(points_.begin(), points_.end());
    }
    /// The height of a point of the wheel above the rail, along the rail's normal, where normals are less than 60
    /// degrees apart, infinite where nothing is within 2 mm; and the rail's angle there.
    std::pair<double, double> above(double y, double z, double slope_y, double slope_z) const {
        const double half = 0.5 * std::hypot(slope_y, slope_z);
        double least = reach * reach;
        const Point* nearest = nullptr;
        auto point = std::lower_bound(points_.begin(), points_.end(), Point{y - reach});
        for (; point != points_.end() && (*point)[0] <= y + reach; ++point) {
            const auto [rail_y, rail_z, dy, dz] = *point;
            const double square = (y - rail_y) * (y - rail_y) + (z - rail_z) * (z - rail_z);
            if (square > least || dy * slope_y + dz * slope_z < half) continue;
            least = square;
            nearest = &*point;
        }
        if (!nearest) return {std::numeric_limits<double>::infinity(), 0};
        const auto [rail_y, rail_z, dy, dz] = *nearest;
        return {(y - rail_y) * dz - (z - rail_z) * dy, std::atan2(dz, dy)};
    }

private:
    using Point = std::array<double, 4>;  // y, z, and the direction of the curve

    static constexpr double reach = 2e-3;

    std::vector<Point> points_;
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
    for (double s = 0; s <= length; s += 7e-4) {
        for (int k = -12; k <= 12; ++k) {
            const double x = 4e-3 * k;
            const rollbem::RailSurface::Point p = placed.section(s, x);
            if (!p.defined) continue;
            const double z = p.z + at.height;
            const auto [gap, angle] = rail.above(p.y, z, p.slope[0], p.slope[1]);
            // what is 2 mm away or more is as good as 2 mm away; along x the surface moves by less than 0.7 mm a step
            if (gap > 0) k += static_cast<int>((std::min)(gap, 2e-3) / 7e-4);
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
