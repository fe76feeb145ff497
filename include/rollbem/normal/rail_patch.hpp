// RailPatch: one patch of a wheel on a rail, made from the pressures in a plane.
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "../scene/mirror.hpp"
#include "../scene/outline.hpp"
#include "../status.hpp"
#include "normal_contact.hpp"

namespace rollbem {

/// The plane of contact has its origin at the reference point, s along y turned by the angle, and n into the rail;
/// patch and pressures are in the axes (x, s) from there. Patches of one plane share its reference point.
struct RailPatch {
    double x = 0, y = 0, z = 0;              ///< reference point, on the rail, in track axes [m]
    double rail_y = 0, wheel_y = 0;          ///< reference point in both profiles [m]
    double rail_s = 0, wheel_s = 0;          ///< arc lengths of both profiles up to it [m]
    double angle = 0;                        ///< delta of the plane [rad]: s = (0, cos delta, sin delta)
    double rolling_radius = 0;               ///< r0 + z of the wheel at the reference point [m]
    double load = 0;                         ///< integral of the pressures over the plane [N]
    double approach = 0;                     ///< the largest of wheel_n - rail_n over the cells, undeformed [m]
    double peak_pressure = 0;                ///< [Pa]
    double area = 0;                         ///< [m^2]
    double half_length = 0, half_width = 0;  ///< half the extents [m]
    int steps = 0;                           ///< number of steps of the last normal problem
    double residual = 0;                     ///< largest gap under pressure, over the approach
    Status status = Status::not_finite;
    CellGrid grid{};           ///< grid of the pressures
    Eigen::ArrayXXd pressure;  ///< [Pa], nx x ny
    /// n of the rail's surface in each row of cells (ny), and of the wheel's where it lies deepest, undeformed [m].
    Eigen::ArrayXd rail_n, wheel_n;
    /// dn/ds of the rail's surface in each row of cells (ny) [-]. Pressures act along its normals (0, -dn/ds, 1).
    Eigen::ArrayXd rail_slope;
    std::optional<Outline> outline;
    bool has_numbers() const { return rollbem::has_numbers(status); }

    /// A vector given in the plane's axes, in track axes, and the place (x, s, n).
    std::array<double, 3> in_track(double along, double across, double normal) const {
        const double sine = std::sin(angle), cosine = std::cos(angle);
        return {along, across * cosine - normal * sine, across * sine + normal * cosine};
    }
    std::array<double, 3> place(double along, double across, double normal) const {
        const std::array<double, 3> arm = in_track(along, across, normal);
        return {x + arm[0], y + arm[1], z + arm[2]};
    }
    /// delta of the rail's surface [rad] and y of its profile [m] at s.
    double surface_angle(double s) const { return angle + std::atan(in_rows(rail_slope, s)); }
    double surface_y(double s) const { return rail_y + s * std::cos(angle) - in_rows(rail_n, s) * std::sin(angle); }
    /// The vertical load of the pressures [N].
    double vertical_load() const;

private:
    /// Numbers of rows of cells at s, linear between their middles.
    double in_rows(const Eigen::ArrayXd& rows, double s) const;
};

/// The mirror image of a patch. Lengths along the profiles stay as they are.
RailPatch mirrored(RailPatch patch, const Mirror& mirror);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/rail_patch.ipp"
#endif
