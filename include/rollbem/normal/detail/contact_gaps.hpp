// The gap between wheel and rail along the normal of a plane of contact, in the cells of a grid.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "../../status.hpp"
#include "../normal_contact.hpp"
#include "contact_region.hpp"

namespace rollbem::detail {

/// Gaps before deformation [m], positive where the surfaces are apart.
struct Gaps {
    NormalContact::Grid h;  ///< gaps, nx x ny; a large number where there is none
    /// n of the rail's surface in each row and its derivative by s; in the middle column if the rail changes along x.
    Eigen::ArrayXd rail_n, rail_slope;
    /// ok, or the reason why a cell has no gap: end_of_profile, undefined_section, or doubtful_plane where the rail
    /// belongs to another region.
    Eigen::Array<Status, Eigen::Dynamic, Eigen::Dynamic> known;
    bool all_known = true;
};

/// Finds gaps by Newton's method, each cell from its neighbour; keeps memory from one grid to the next.
class GapFinder {
public:
    /// `track_x`: the place along the track of the rail's curve at x = 0; the wheel stands at `height`.
    void find(const WheelOnRail::Geometry& geometry, const WheelSurface::Placed& wheel, double height, double track_x,
              const ContactPlane& plane, const NormalContact::Cells& grid, Gaps& gaps) {
        geometry_ = &geometry;
        wheel_ = &wheel;
        plane_ = &plane;
        height_ = height;
        track_x_ = track_x;
        gaps.h.resize(grid.nx, grid.ny);
        gaps.rail_n.setZero(grid.ny);
        gaps.rail_slope.setZero(grid.ny);
        gaps.known.setConstant(grid.nx, grid.ny, Status::ok);
        gaps.all_known = true;
        const Eigen::Index row =
            std::clamp(Eigen::Index(std::lround(-grid.y_0 / grid.dy)), Eigen::Index(0), grid.ny - 1);
        wheel_s_.setConstant(grid.nx, plane.wheel_s);
        rail_s_.setConstant(grid.nx, plane.rail_s);
        find_row(grid, row, gaps, true);
        const Eigen::ArrayXd wheel_s = wheel_s_, rail_s = rail_s_;
        for (Eigen::Index j = row + 1; j < grid.ny; ++j) find_row(grid, j, gaps, false);
        wheel_s_ = wheel_s;
        rail_s_ = rail_s;
        for (Eigen::Index j = row; j-- > 0;) find_row(grid, j, gaps, false);
    }

    /// s of the wheel's point above the plane's origin.
    static double wheel_place(const WheelSurface::Placed& wheel, double height, const ContactPlane& plane) {
        double s = plane.wheel_s;
        for (int k = 0; k < most; ++k) {
            const RailSurface::Point p = wheel.section(s, plane.x);
            const double off = plane.s(p.y, p.z + height);
            if (std::abs(off) < tiny || !p.defined) break;
            s = std::clamp(s - step(plane, p, off), 0.0, wheel.surface().length());
        }
        return s;
    }

private:
    static constexpr int most = 12;                     // steps of Newton's method
    static constexpr double tiny = 1e-8, apart = 1e-2;  // [m]

    // ds in the plane along the curve. In intermediate steps surfaces may be steeper than 84 degrees in the plane, at
    // the final point they may not.
    static double rate(const ContactPlane& plane, const RailSurface::Point& p) {
        return (std::max)(p.slope[0] * plane.cosine + p.slope[1] * plane.sine, 0.1);
    }
    static double step(const ContactPlane& plane, const RailSurface::Point& p, double off) {
        constexpr double largest = 2e-3;
        return std::clamp(off / rate(plane, p), -largest, largest);
    }

    // One step to s from the point p of a curve: n at s follows from the curve's tangent, so that its error is of
    // second order in the distance of p from s, which is returned.
    double approach(const RailSurface::Point& p, double z, double s, double& place, double& n) const {
        const double off = plane_->s(p.y, z) - s, by = step(*plane_, p, off);
        n = plane_->n(p.y, z) - by * (p.slope[1] * plane_->cosine - p.slope[0] * plane_->sine);
        place -= by;
        return off;
    }

    void find_row(const NormalContact::Cells& grid, Eigen::Index j, Gaps& gaps, bool first) {
        const Eigen::Index centre = grid.nx / 2;
        const bool straight = geometry_->rail().is_straight();
        double n_rail = 0;
        Status rail_known = Status::ok;
        // from the middle outwards
        for (Eigen::Index c = 0; c < grid.nx; ++c) {
            const Eigen::Index i = c < grid.nx - centre ? centre + c : grid.nx - 1 - c;
            const Eigen::Index beside = i > centre ? i - 1 : i < centre ? i + 1 : i;
            if (first && i != centre) {
                wheel_s_[i] = wheel_s_[beside];
                rail_s_[i] = rail_s_[beside];
            }
            const double x = plane_->x + grid.x(i), s = grid.y(j);
            if (c == 0 || !straight) {
                rail_known = rail_at(x, s, rail_s_[i], n_rail);
                if (!plane_->rail.contains(rail_s_[i])) rail_known = (std::max)(rail_known, Status::doubtful_plane);
                if (c == 0) {
                    gaps.rail_n[j] = n_rail;
                    gaps.rail_slope[j] = rail_slope(x, rail_s_[i]);
                }
            }
            double n_wheel = 0;
            const Status wheel_known = wheel_at(x, s, wheel_s_[i], n_wheel);
            gaps.known(i, j) = (std::max)(rail_known, wheel_known);
            const bool known = gaps.known(i, j) == Status::ok;
            gaps.all_known = gaps.all_known && known;
            gaps.h(i, j) = known ? n_rail - n_wheel : apart;
        }
    }

    Status rail_at(double x, double s, double& place, double& n) const {
        double off = 0;
        bool defined = true;
        for (int k = 0; k < most; ++k) {
            const RailSurface::Point p = geometry_->rail_at(place, track_x_ + x);
            defined = p.defined;
            off = approach(p, p.z, s, place, n);
            if (std::abs(off) < tiny) break;
        }
        return defined ? outcome(place, geometry_->rail().length(), off) : Status::end_of_profile;
    }

    double rail_slope(double x, double place) const {
        const RailSurface::Point p = geometry_->rail_at(place, track_x_ + x);
        return (p.slope[1] * plane_->cosine - p.slope[0] * plane_->sine) / rate(*plane_, p);
    }

    Status wheel_at(double x, double s, double& place, double& n) const {
        double off = 0;
        for (int k = 0; k < most; ++k) {
            const RailSurface::Point p = wheel_->section(place, x);
            if (!p.defined) return Status::undefined_section;
            off = approach(p, p.z + height_, s, place, n);
            if (std::abs(off) < tiny) break;
        }
        return outcome(place, wheel_->surface().length(), off);
    }

    static Status outcome(double& place, double length, double off) {
        if (place < 0 || place > length) {
            place = std::clamp(place, -length, 2 * length);
            return Status::end_of_profile;
        }
        return std::abs(off) < tiny ? Status::ok : Status::undefined_section;
    }

    const WheelOnRail::Geometry* geometry_ = nullptr;
    const WheelSurface::Placed* wheel_ = nullptr;
    const ContactPlane* plane_ = nullptr;
    double height_ = 0, track_x_ = 0;
    Eigen::ArrayXd wheel_s_, rail_s_;  // s of the columns in the previous row
};

}  // namespace rollbem::detail
