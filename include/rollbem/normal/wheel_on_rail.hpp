// Where a wheel touches a rail and how hard: contact locus, planes of contact, gaps by exact sections of the wheel, and
// the height at which the patches carry a load. SI units.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../scene/outline.hpp"
#include "../scene/patch_contact.hpp"
#include "../scene/wheelset.hpp"
#include "detail/patch_shape.hpp"
#include "normal_contact.hpp"
#include "pressure_grid.hpp"
#include "profile.hpp"

namespace rollbem {

/// Where profiles are. Track axes: x forward, y to the right, z down, the origin between the rails at the height of
/// their tops.
struct TrackDimensions {
    double gauge = 1.435, gauge_depth = 0.014;  ///< between the rails, measured this far below their tops [m]
    double flange_back = 1.36;                  ///< between the backs of both flanges [m]
    double tape_offset = 0.07;                  ///< of the tape circle from the flange's back [m]
    double radius = 0.46;                       ///< of the tape circle r0 [m]
    double shear_modulus = 8.2e10;              ///< G [Pa] of both bodies
    double poisson_ratio = 0.28;                ///< nu [-] of both bodies
};

namespace detail {

inline bool is_finite(const WheelsetPosition& at) {
    return is_finite(at.lateral) && is_finite(at.height) && is_finite(at.roll) && is_finite(at.yaw);
}
inline bool is_finite(const WheelsetSpeeds& speeds) {
    return is_finite(speeds.forward) && is_finite(speeds.pitch_rate) && is_finite(speeds.lateral) &&
           is_finite(speeds.vertical) && is_finite(speeds.roll_rate) && is_finite(speeds.yaw_rate);
}

}  // namespace detail

/// One patch of a wheel on a rail. The plane of contact has its origin at the reference point, s along y turned by the
/// angle, and n into the rail; patch and pressures are in the axes (x, s) from there.
struct RailPatch {
    double x = 0, y = 0, z = 0;      ///< reference point, on the rail, in track axes [m]
    double rail_y = 0, wheel_y = 0;  ///< of it in both profiles [m]
    double rail_s = 0, wheel_s = 0;  ///< lengths along them up to it [m]
    double angle = 0;                ///< delta of the plane [rad]: s = (0, cos delta, sin delta)
    double rolling_radius = 0;       ///< r0 + z of the wheel there [m]
    double load = 0;                 ///< normal force [N]
    double approach = 0;             ///< from where the surfaces would touch, undeformed [m]
    double penetration = 0;          ///< the largest of the undeformed surfaces, along n, where the wheel is now [m]
    double peak_pressure = 0;        ///< [Pa]
    double area = 0;                 ///< [m^2]
    double half_length = 0, half_width = 0;  ///< half the extents [m]
    int steps = 0;                           ///< of the normal problem, the last time
    double residual = 0;                     ///< of gaps where there is pressure, over the approach
    Status status = Status::not_finite;
    CellGrid grid{};           ///< of the pressures
    Eigen::ArrayXXd pressure;  ///< [Pa], nx x ny
    /// Of each row of cells, ny: n of the rail's surface, and of the wheel's where it lies deepest, undeformed [m].
    Eigen::ArrayXd rail_n, wheel_n;
    std::optional<Outline<double>> outline;
    bool has_numbers() const { return rollbem::has_numbers(status); }
};

/// The right wheel of a wheelset on the right rail; a left one is its mirror image, with y, roll, yaw and lateral
/// quantities reversed. Immutable.
class WheelOnRail {
public:
    /// Throws std::invalid_argument unless dimensions are positive and finite, 0 <= nu <= 0.5, and the rail's inner
    /// side reaches the depth at which the gauge is measured.
    WheelOnRail(Profile wheel, Profile rail, const TrackDimensions& dimensions = {});

    struct Options {
        Eigen::Index cells_x = 40, cells_s = 20;  ///< across what touches, at least 5; more in patches with two lobes
        double tolerance = 1e-6;                  ///< of the load, and of gaps over the approach; positive, below 1
        /// Instead, unless 0: the side [m] of square cells, one centred on the reference point, as CONTACT has; from 1e-5
        /// to 1.
        double cell_size = 0;
    };

    /// Memory of a solution, and where the search for the next one starts.
    class Workspace {
        friend class WheelOnRail;
        // The plane of a region, and the region in it.
        struct Plane {
            double x = 0, y = 0, z = 0, angle = 0, sine = 0, cosine = 1;  // its origin, on the rail, in track axes
            double wheel_s = 0, rail_s = 0;                               // of both profiles there
            double deepest = 0;                                           // penetration along n
            double low = 0, high = 0;                                     // ends of the region along s

            double s(double y_track, double z_track) const { return (y_track - y) * cosine + (z_track - z) * sine; }
            double n(double y_track, double z_track) const { return (z_track - z) * cosine - (y_track - y) * sine; }
        };
        struct Part {
            Plane plane{};
            CellGrid grid{};
            NormalContact::Grid h{};  // the gap before deformation, at the height of the plane
            Eigen::ArrayXd rail_n{};  // of the rows
            NormalContact::Solution solution{};
        };
        struct Sample {
            double x, y, gap;  // of the locus at height 0: below it the rail's top
            bool defined;
        };

        double approach = 0;  // vertical, of the last solution [m]; 0: none
        std::vector<Part> parts;
        std::vector<NormalContact> normal;  // of the parts
        std::vector<Sample> locus;
        Eigen::ArrayXd at;
    };

    struct Contact {
        double height = 0;                   ///< z_ws [m] at which the load is carried
        std::vector<RailPatch> patches;      ///< by decreasing load
        Status status = Status::not_finite;  ///< that of the worst patch
    };

    /// The contact whose normal forces carry the vertical load [N], sum N cos delta, at this lateral position, roll and
    /// yaw; the height of `position` is not used. no_contact if the load is not positive. Throws std::invalid_argument if
    /// an option is out of its range, as press() does.
    template <std::same_as<double> Scalar = double>  // for rollbem::compiled
    Contact carry(const WheelsetPosition& position, double load, Workspace& workspace, const Options& options) const;
    Contact carry(const WheelsetPosition& position, double load, Workspace& workspace) const {
        return carry(position, load, workspace, Options{});
    }
    /// The contact at this position and height, whatever it carries; no_contact where the wheel is lifted.
    template <std::same_as<double> Scalar = double>
    Contact press(const WheelsetPosition& position, Workspace& workspace, const Options& options) const;

    const Profile& wheel() const { return wheel_; }
    const Profile& rail() const { return rail_; }
    const TrackDimensions& dimensions() const { return dimensions_; }
    double compliance() const { return (1 - dimensions_.poisson_ratio) / dimensions_.shear_modulus; }  ///< 1/E* [1/Pa]
    double rail_origin() const { return rail_origin_; }    ///< y of the right rail's [m]
    double wheel_origin() const { return wheel_origin_; }  ///< of the right wheel's from the middle of the axle [m]

private:
    using Point = Profile::Point;

    struct Place {
        double x, y, z;
        bool defined;
    };
    // The sines and cosines of a position.
    struct Attitude {
        WheelsetPosition at;
        double sin_roll, cos_roll, sin_yaw, cos_yaw;

        Attitude(const WheelsetPosition& position)  // NOLINT: implicit on purpose
            : at(position),
              sin_roll(std::sin(position.roll)),
              cos_roll(std::cos(position.roll)),
              sin_yaw(std::sin(position.yaw)),
              cos_yaw(std::cos(position.yaw)) {}
    };
    // Samples of the wheel that lie below the rail.
    struct Region {
        std::size_t first, last;
    };
    using Plane = Workspace::Plane;
    using Part = Workspace::Part;
    class Search;

    static void check(const Options& options) {
        constexpr const char *who = "WheelOnRail", *few = "be at least 5";
        detail::require(options.cells_x >= 5, who, "cells_x", options.cells_x, few);
        detail::require(options.cells_s >= 5, who, "cells_s", options.cells_s, few);
        detail::require(options.tolerance > 0 && options.tolerance < 1, who, "tolerance", options.tolerance,
                        "be positive and below 1");
        const double size = options.cell_size;
        detail::require(size == 0 || (size >= 1e-5 && size <= 1), who, "cell_size", size, "be 0 or lie in [1e-5, 1]");
    }

    // sin theta = `sine`; not defined where the wheel turns away too fast for a section
    Place place(const Attitude& attitude, const Point& p, double sine) const {
        const double eta = wheel_origin_ + p.y, r = dimensions_.radius + p.z;
        const double cosine = std::sqrt((std::max)(1 - sine * sine, 0.0));
        const double across = attitude.sin_yaw * r * sine + attitude.cos_yaw * eta;
        return {attitude.cos_yaw * r * sine - attitude.sin_yaw * eta,
                attitude.at.lateral + attitude.cos_roll * across - attitude.sin_roll * r * cosine,
                attitude.at.height - dimensions_.radius + attitude.sin_roll * across + attitude.cos_roll * r * cosine,
                std::abs(sine) <= 0.3};
    }
    // The point of the locus, where the surface's normal has no component along x.
    Place locus(const Attitude& attitude, const Point& p) const {
        const double tangent = attitude.sin_yaw / attitude.cos_yaw;
        return place(attitude, p, p.slope[0] > 0 ? -tangent * p.slope[1] / p.slope[0] : 1);
    }
    // Length along the rail at y in track axes; NaN beyond its upper side.
    double rail_place(double y) const;
    void find_locus(const Attitude& attitude, Workspace& workspace) const;
    std::vector<Region> regions(double height, const Workspace& workspace) const;
    Plane plane(const Attitude& attitude, const Region& region) const;
    // The gap of a part before deformation; false where a section is not defined.
    bool find_gaps(const Attitude& attitude, const Plane& plane, const CellGrid& grid, NormalContact::Grid& h,
                   Eigen::ArrayXd& rail_n, Eigen::ArrayXd& at) const;
    CellGrid first_grid(const Plane& plane) const;
    // Cells over what touches, with two cells of margin.
    static CellGrid finer(const CellGrid& grid, const NormalContact::Grid& p, const Options& options, bool lobes);
    // Whether `cells` along s are too few for the narrowest lobe of the gap, or there are several.
    bool has_lobes(const Attitude& attitude, const Plane& plane, Eigen::Index cells, Eigen::ArrayXd& at) const;
    // Pressures as patches that every row cuts in one interval, with the wheel lower by `lower` than the part says.
    void add_patches(const Part& part, double lower, const NormalContact::Grid& pressure,
                     std::vector<RailPatch>& patches) const;

    Profile wheel_, rail_;
    TrackDimensions dimensions_;
    double rail_origin_ = 0, wheel_origin_ = 0;
    std::vector<Point> samples_;  // of the wheel
    std::vector<double> sample_s_;
    Eigen::Index rail_first_ = 0, rail_last_ = 0;  // the stretch of the rail about its top where y grows
};

inline WheelOnRail::WheelOnRail(Profile wheel, Profile rail, const TrackDimensions& dimensions)
    : wheel_(std::move(wheel)), rail_(std::move(rail)), dimensions_(dimensions) {
    constexpr const char* who = "WheelOnRail";
    const TrackDimensions& d = dimensions_;
    detail::require_positive(who, "gauge", d.gauge);
    detail::require_positive(who, "gauge_depth", d.gauge_depth);
    detail::require_positive(who, "flange_back", d.flange_back);
    detail::require_finite(who, "tape_offset", d.tape_offset);
    detail::require_positive(who, "radius", d.radius);
    detail::require_positive(who, "shear_modulus", d.shear_modulus);
    detail::require_poisson_ratio(who, d.poisson_ratio);
    detail::require_positive(who, "compliance (1 - poisson_ratio) / shear_modulus", compliance());
    Eigen::Index top = 0;
    const double highest = rail_.z().minCoeff(&top);
    for (rail_first_ = top; rail_first_ > 0 && rail_.y()[rail_first_ - 1] < rail_.y()[rail_first_];) --rail_first_;
    for (rail_last_ = top; rail_last_ + 1 < rail_.size() && rail_.y()[rail_last_ + 1] > rail_.y()[rail_last_];)
        ++rail_last_;
    Eigen::Index below = top;
    while (below > 0 && rail_.z()[below] - highest < d.gauge_depth) --below;
    detail::require(rail_.z()[below] - highest >= d.gauge_depth, who, "depth of the rail's inner side",
                    rail_.z()[below] - highest, "be at least the gauge_depth");
    double low = rail_.s()[below], high = rail_.s()[below + 1];
    for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (rail_.at(middle).z - highest >= d.gauge_depth ? low : high) = middle;
    }
    rail_origin_ = d.gauge / 2 - rail_.at(low).y;
    wheel_origin_ = d.flange_back / 2 + d.tape_offset;
    constexpr double distance = 1e-4;  // of samples [m]: flange contacts are four times as wide at least
    const auto count = static_cast<Eigen::Index>(std::ceil(wheel_.length() / distance));
    for (Eigen::Index i = 0; i <= count; ++i) {
        sample_s_.push_back(wheel_.length() * double(i) / double(count));
        samples_.push_back(wheel_.at(sample_s_.back()));
    }
}

inline double WheelOnRail::rail_place(double y) const {
    const double at = y - rail_origin_;
    const double *const first = rail_.y().data() + rail_first_, *const last = rail_.y().data() + rail_last_;
    if (!(at >= *first && at <= *last)) return std::numeric_limits<double>::quiet_NaN();
    const Eigen::Index i = (std::min)(std::upper_bound(first, last, at), last) - rail_.y().data();
    double s = rail_.s()[i - 1] +
               (rail_.s()[i] - rail_.s()[i - 1]) * (at - rail_.y()[i - 1]) / (rail_.y()[i] - rail_.y()[i - 1]);
    for (int k = 0; k < 2; ++k) {
        const Point p = rail_.at(s);
        s -= (p.y - at) / p.slope[0];
    }
    return s;
}

inline void WheelOnRail::find_locus(const Attitude& attitude, Workspace& workspace) const {
    workspace.locus.clear();
    for (const Point& sample : samples_) {
        const Place at = locus(attitude, sample);
        workspace.locus.push_back({at.x, at.y, rail_.at(rail_place(at.y)).z - at.z, at.defined});
    }
}

inline auto WheelOnRail::regions(double height, const Workspace& workspace) const -> std::vector<Region> {
    constexpr double joined = 4e-3;  // regions that are closer share a plane [m]
    std::vector<Region> found;
    const auto& locus = workspace.locus;
    for (std::size_t i = 0; i < locus.size(); ++i) {
        if (!(locus[i].gap < height)) continue;
        if (!found.empty() && (found.back().last + 1 == i || locus[i].y - locus[found.back().last].y < joined)) {
            found.back().last = i;
        } else {
            found.push_back({i, i});
        }
    }
    return found;
}

inline auto WheelOnRail::plane(const Attitude& attitude, const Region& region) const -> Plane {
    const double from = sample_s_[region.first > 0 ? region.first - 1 : 0],
                 to = sample_s_[(std::min)(region.last + 1, sample_s_.size() - 1)];
    constexpr int count = 160;
    struct Cut {
        double s, x, y, z, depth, angle;
    };
    std::array<Cut, count + 1> cuts;
    double sum = 0, x = 0, y = 0, angle = 0, deepest = 0;  // means over y
    for (int k = 0; k <= count; ++k) {
        Cut& cut = cuts[static_cast<std::size_t>(k)];
        cut.s = from + (to - from) * k / count;
        const Point on_wheel = wheel_.at(cut.s);
        const Place at = locus(attitude, on_wheel);
        const Point below = rail_.at(rail_place(at.y));
        cut = {cut.s, at.x, at.y, below.z, (std::max)(at.z - below.z, 0.0), std::atan2(below.slope[1], below.slope[0])};
        if (!detail::is_finite(cut.depth)) cut.depth = 0;
        const double weight = on_wheel.slope[0] * std::pow(cut.depth, 2.5);
        if (weight == 0) continue;
        sum += weight;
        x += weight * cut.x;
        y += weight * cut.y;
        angle += weight * cut.angle;
        deepest = (std::max)(deepest, cut.depth);
    }
    x /= sum;
    y /= sum;
    angle /= sum;
    Plane found;
    found.x = x;
    found.y = y;
    found.angle = angle;
    found.sine = std::sin(angle);
    found.cosine = std::cos(angle);
    found.rail_s = rail_place(y);
    found.z = rail_.at(found.rail_s).z;
    found.deepest = deepest * found.cosine;
    std::size_t k = 1;
    while (k < count && cuts[k].y < y) ++k;
    const double part = (y - cuts[k - 1].y) / (cuts[k].y - cuts[k - 1].y);
    found.wheel_s = cuts[k - 1].s + part * (cuts[k].s - cuts[k - 1].s);
    std::size_t first = 0, last = count;
    while (first < count && cuts[first].depth == 0) ++first;
    while (last > 0 && cuts[last].depth == 0) --last;
    found.low = found.s(cuts[first].y, cuts[first].z);
    found.high = found.s(cuts[last].y, cuts[last].z);
    return found;
}

inline bool WheelOnRail::find_gaps(const Attitude& attitude, const Plane& plane, const CellGrid& grid,
                                   NormalContact::Grid& h, Eigen::ArrayXd& rail_n, Eigen::ArrayXd& columns) const {
    rail_n.resize(grid.ny);
    h.resize(grid.nx, grid.ny);
    const double sin_yaw = attitude.sin_yaw, cos_yaw = attitude.cos_yaw;
    const double sin_roll = attitude.sin_roll, cos_roll = attitude.cos_roll;
    double rail_s = plane.rail_s + grid.y(0);
    bool defined = true;
    for (Eigen::Index j = 0; j < grid.ny; ++j) {
        const double s = grid.y(j);
        Point rail{};
        for (int k = 0; k < 12; ++k) {
            rail = rail_.at(rail_s);
            const double off = plane.s(rail_origin_ + rail.y, rail.z) - s;
            rail_s -= off / (std::max)(rail.slope[0] * plane.cosine + rail.slope[1] * plane.sine, 0.1);
            if (std::abs(off) < 1e-13) break;
        }
        rail_n[j] = plane.n(rail_origin_ + rail.y, rail.z);
        const Eigen::Index centre = grid.nx / 2;
        double at = j == 0 ? plane.wheel_s + s : columns[centre] + grid.dy;
        columns.resize((std::max)(columns.size(), grid.nx));
        // from the middle outwards, each column from its neighbour
        for (Eigen::Index c = 0; c < grid.nx; ++c) {
            const Eigen::Index i = c < grid.nx - centre ? centre + c : grid.nx - 1 - c;
            if (c == grid.nx - centre) at = columns[centre];
            const double X = plane.x + grid.x(i);
            double n_wheel = 0;
            for (int k = 0; k < 12; ++k) {
                const Point p = wheel_.at(at);
                const double eta = wheel_origin_ + p.y, r = dimensions_.radius + p.z;
                const double sine = (X + sin_yaw * eta) / (cos_yaw * r);
                if (!(std::abs(sine) <= 0.3)) {
                    defined = false;
                    break;
                }
                const Place found = place(attitude, p, sine);
                const double off = plane.s(found.y, found.z) - s;
                n_wheel = plane.n(found.y, found.z);
                if (std::abs(off) < 1e-13) break;
                const double cosine = std::sqrt(1 - sine * sine);
                const double turn = (sin_yaw * p.slope[0] - cos_yaw * sine * p.slope[1]) / (cos_yaw * r);
                const double across = sin_yaw * (p.slope[1] * sine + r * turn) + cos_yaw * p.slope[0];
                const double down = p.slope[1] * cosine - r * sine / cosine * turn;
                const double rate = (cos_roll * across - sin_roll * down) * plane.cosine +
                                    (sin_roll * across + cos_roll * down) * plane.sine;
                at -= off / (std::max)(rate, 0.1);
            }
            columns[i] = at;
            h(i, j) = rail_n[j] - n_wheel;
        }
    }
    return defined;
}

inline CellGrid WheelOnRail::first_grid(const Plane& plane) const {
    constexpr Eigen::Index cells = 24;
    const double curvature = plane.cosine / (dimensions_.radius + wheel_.at(plane.wheel_s).z);
    const double half = 1.1 * std::sqrt(2 * plane.deepest / curvature), height = 1.04 * (plane.high - plane.low);
    const double dx = 2 * half / cells, dy = height / cells;
    return {cells, cells, -half + dx / 2, (plane.low + plane.high - height + dy) / 2, dx, dy};
}

inline CellGrid WheelOnRail::finer(const CellGrid& grid, const NormalContact::Grid& p, const Options& options,
                                   bool lobes) {
    const auto [left, right, bottom, top] = detail::extents(grid, p);
    constexpr Eigen::Index margin = 2, most = 60;
    if (const double size = options.cell_size; size > 0) {
        const auto count = [=](double length) { return Eigen::Index(std::ceil(length / size)) + 2 * margin + 2; };
        return {count(right - left),
                count(top - bottom),
                (std::floor(left / size) - margin) * size,
                (std::floor(bottom / size) - margin) * size,
                size,
                size};
    }
    const Eigen::Index nx = lobes ? (std::max)(options.cells_x, most) : options.cells_x,
                       ny = lobes ? (std::max)(options.cells_s, most) : options.cells_s;
    const double dx = (right - left) / double(nx - 2 * margin), dy = (top - bottom) / double(ny - 2 * margin);
    return {nx, ny, left + (0.5 - margin) * dx, bottom + (0.5 - margin) * dy, dx, dy};
}

inline bool WheelOnRail::has_lobes(const Attitude& attitude, const Plane& plane, Eigen::Index cells,
                                   Eigen::ArrayXd& columns) const {
    constexpr Eigen::Index count = 80, least_cells = 10;
    const double ds = (plane.high - plane.low) / count;
    NormalContact::Grid row;
    Eigen::ArrayXd rail_n;
    if (!find_gaps(attitude, plane, {1, count, 0, plane.low + ds / 2, ds, ds}, row, rail_n, columns)) return false;
    const Eigen::ArrayXd h = row.row(0);
    // across the deepest lobe: where the gap has risen by a quarter, a parabola has half its width
    Eigen::Index deepest = 0;
    const double least = h.minCoeff(&deepest);
    Eigen::Index low = deepest, high = deepest;
    while (low > 0 && h[low - 1] < 0.75 * least) --low;
    while (high + 1 < count && h[high + 1] < 0.75 * least) ++high;
    if (double(high - low + 1) / count * 2 * double(cells) < least_cells) return true;
    // another valley, deeper than what parts it from this one
    for (const Eigen::Index step : {-1, 1}) {
        double ridge = least;
        for (Eigen::Index j = deepest + step; j >= 0 && j < count; j += step) {
            ridge = (std::max)(ridge, h[j]);
            if (h[j] < ridge + least / 200) return true;
        }
    }
    return false;
}

inline void WheelOnRail::add_patches(const Part& part, double lower, const NormalContact::Grid& pressure,
                                     std::vector<RailPatch>& patches) const {
    const Plane& plane = part.plane;
    const Point wheel = wheel_.at(plane.wheel_s), rail = rail_.at(plane.rail_s);
    RailPatch patch;
    patch.x = plane.x;
    patch.y = plane.y;
    patch.z = plane.z;
    patch.rail_s = plane.rail_s;
    patch.wheel_s = plane.wheel_s;
    patch.rail_y = rail.y;
    patch.wheel_y = wheel.y;
    patch.angle = plane.angle;
    patch.rolling_radius = dimensions_.radius + wheel.z;
    patch.approach = patch.penetration = plane.deepest + lower * plane.cosine;
    patch.steps = part.solution.steps;
    patch.residual = part.solution.residual;
    patch.grid = part.grid;
    patch.rail_n = part.rail_n;
    patch.wheel_n = part.rail_n - part.h.colwise().minCoeff().transpose() + lower * plane.cosine;
    std::vector<Eigen::ArrayXXd> pieces = detail::pieces(pressure);
    // crumbs, cells that are about to lift, leave their load to the others
    constexpr double crumb = 0.02;
    double kept = 0;
    std::erase_if(pieces, [&](const Eigen::ArrayXXd& p) {
        const double sum = p.sum();
        const bool falls = sum < crumb * pressure.sum() && !detail::contact_outline(part.grid, p);
        if (!falls) kept += sum;
        return falls;
    });
    for (const Eigen::ArrayXXd& piece : pieces) {
        patch.status = part.solution.status;
        patch.pressure = pressure.sum() / kept * piece;
        patch.load = patch.pressure.sum() * part.grid.dx * part.grid.dy;
        patch.peak_pressure = detail::peak_pressure(patch.pressure);
        patch.outline = detail::contact_outline(part.grid, patch.pressure);
        if (patch.outline) {
            const Outline<double>& outline = *patch.outline;
            patch.area = outline.area();
            patch.half_width = (outline.high() - outline.low()) / 2;
            double ahead = outline.leading(outline.low()), behind = ahead;
            for (const double at : outline.y()) {
                ahead = (std::max)(ahead, outline.leading(at));
                behind = (std::min)(behind, outline.trailing(at));
            }
            patch.half_length = (ahead - behind) / 2;
            const auto angle = [&](double s) {
                const Point at = rail_.at(plane.rail_s + s);
                return std::atan2(at.slope[1], at.slope[0]);
            };
            if (patch.status == Status::ok && std::abs(angle(outline.high()) - angle(outline.low())) > 0.2) {
                patch.status = Status::doubtful_plane;
            }
            if (plane.rail_s + outline.low() < rail_.s()[rail_first_] ||
                plane.rail_s + outline.high() > rail_.s()[rail_last_] || plane.wheel_s + outline.low() < 0 ||
                plane.wheel_s + outline.high() > wheel_.length()) {
                patch.status = Status::end_of_profile;
            }
        } else if (patch.has_numbers()) {
            patch.status = Status::few_cells;
        }
        patches.push_back(patch);
    }
}

// One contact: regions become parts, each with a plane, a grid and gaps that hold for a height; loads are found with
// the wheel lower than that by a little, and the planes again where it is then.
class WheelOnRail::Search {
public:
    Search(const WheelOnRail& wheel, const WheelsetPosition& position, Workspace& workspace, const Options& options)
        : wheel_(wheel), attitude_(position), workspace_(workspace), options_(options), parts_(workspace.parts) {
        attitude_.at.height = 0;
    }

    Contact carry(double load) {
        Contact contact;
        contact.status = locate();
        if (contact.status != Status::ok) return contact;
        // 1. The height on coarse grids, to some percent: loads grow like the power 3/2 of the approach
        double approach = workspace_.approach > 0 ? workspace_.approach : 2e-5 * std::cbrt(load / 1e4 * (load / 1e4));
        double low = 0, high = std::numeric_limits<double>::infinity();
        for (int k = 0;; ++k) {
            contact.status = Status::undefined_section;
            if (!divide(touch_ + approach)) return contact;
            const double found = carried();
            if (std::abs(found / load - 1) < 0.02) break;
            (found < load ? low : high) = approach;
            if (high - low < 1e-3 * high) break;  // loads jump where regions join
            contact.status = Status::load_not_reached;
            if (k == 60) return contact;
            const double to = found > 0 ? approach * std::pow(load / found, 2.0 / 3) : 2 * approach;
            const bool safe = to > low && to < high && (k < 8 || !detail::is_finite(high));
            approach = safe ? to : detail::is_finite(high) ? (low + high) / 2 : 2 * approach;
        }
        // 2. On fine grids, and finer ones if a piece has too few cells
        for (times_ = 1; times_ <= 4; times_ *= 2) {
            double lower = 0;
            contact.status = settle_height(load, approach, lower);
            if (contact.status != Status::ok) return contact;
            workspace_.approach = approach;
            contact = result(touch_ + approach, lower);
            if (contact.status != Status::few_cells) break;
        }
        return contact;
    }

    Contact press(double height) {
        Contact contact;
        contact.status = locate();
        if (contact.status != Status::ok) return contact;
        contact.status = Status::no_contact;
        if (!(height > touch_)) return contact;
        contact.status = Status::undefined_section;
        if (!divide(height) || !refine(height, 0, true)) return contact;
        settle(0, options_.tolerance, false);
        for (int k = 0; k < 4 && outgrown(); ++k) {
            if (!refine(height, 1, false)) return contact;
            settle(0, options_.tolerance, false);
        }
        return result(height, 0);
    }

private:
    // Where the wheel touches first.
    Status locate() {
        wheel_.find_locus(attitude_, workspace_);
        const Workspace::Sample* nearest = nullptr;
        for (const Workspace::Sample& sample : workspace_.locus) {
            if (detail::is_finite(sample.gap) && (nearest == nullptr || sample.gap < nearest->gap)) nearest = &sample;
        }
        if (nearest == nullptr) return Status::no_contact;
        touch_ = nearest->gap;
        return nearest->defined ? Status::ok : Status::undefined_section;
    }

    // Parts at a height, and their loads on coarse grids; false if a section is undefined.
    bool divide(double height) {
        attitude_.at.height = height;
        parts_.clear();
        for (const Region& region : wheel_.regions(height, workspace_)) {
            Part& part = parts_.emplace_back();
            part.plane = wheel_.plane(attitude_, region);
            part.grid = wheel_.first_grid(part.plane);
            if (!find_gaps(part)) return false;
        }
        while (workspace_.normal.size() < parts_.size()) workspace_.normal.emplace_back(wheel_.compliance());
        settle(0, 1e-3, false);
        return true;
    }

    // As planes turn with the height, by the secant of what it lacks.
    Status settle_height(double load, double& approach, double& lower) {
        double last = 0, step = 0, rate = -1;
        for (int round = times_ == 1 ? 0 : 1, k = 0; k < 12; ++round, ++k) {
            if (!refine(touch_ + approach, round, k == 0)) return Status::undefined_section;
            if (!lower_until(load, lower)) return Status::load_not_reached;
            const bool settled = std::abs(lower) < 1e-4 * deepest() && !outgrown();
            if (k > 0) rate = std::clamp((lower - last) / step, -10.0, -0.1);
            last = lower;
            step = settled ? lower : -lower / rate;
            approach += step;
            if (settled && k > 0) return Status::ok;
        }
        lower = step;
        return std::abs(last) < 1e-2 * deepest() ? Status::ok : Status::load_not_reached;
    }

    // Fine grids over what touches, and planes at a height; regions stay as they are after a few rounds.
    bool refine(double height, int round, bool anew) {
        attitude_.at.height = height;
        const std::vector<Region> found = wheel_.regions(height, workspace_);
        const bool same = found.size() == parts_.size();
        if (!same && round < 3) {
            if (!divide(height)) return false;
            round = 0;
        }
        if (round == 0) {
            std::vector<Part> touching;  // and the memory of their pressures
            for (std::size_t k = 0; k < parts_.size(); ++k) {
                if (!(parts_[k].solution.load > 0)) continue;
                std::swap(workspace_.normal[touching.size()], workspace_.normal[k]);
                touching.push_back(std::move(parts_[k]));
            }
            parts_ = std::move(touching);
        }
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            Part& part = parts_[k];
            if (round < 2 || anew || outgrown(k)) {
                const bool lobes = wheel_.has_lobes(attitude_, part.plane, options_.cells_s, workspace_.at);
                const Options options{options_.cells_x * times_, options_.cells_s * times_, options_.tolerance,
                                      options_.cell_size / times_};
                part.grid = finer(part.grid, workspace_.normal[k].pressure(), options, lobes);
            }
            if (round > 0 && same) {
                const Plane before = std::exchange(part.plane, wheel_.plane(attitude_, found[k]));
                part.grid.x_0 += before.x - part.plane.x;  // the grid stays where it is
                part.grid.y_0 -= before.s(part.plane.y, part.plane.z);
            } else if (round > 0) {
                part.plane.deepest += (height - height_) * part.plane.cosine;
            }
            if (options_.cell_size > 0) {
                part.grid.x_0 = part.grid.dx * std::round(part.grid.x_0 / part.grid.dx);
                part.grid.y_0 = part.grid.dy * std::round(part.grid.y_0 / part.grid.dy);
            }
            if (!find_gaps(part)) return false;
        }
        height_ = height;
        return true;
    }

    bool find_gaps(Part& part) {
        return wheel_.find_gaps(attitude_, part.plane, part.grid, part.h, part.rail_n, workspace_.at);
    }

    // Loads with the wheel lower than the gaps say, in rounds, as each displaces the surface below the others.
    void settle(double lower, double tolerance, bool warm) {
        for (int round = 0; round < (parts_.size() > 1 ? 4 : 1); ++round) {
            for (std::size_t k = 0; k < parts_.size(); ++k) {
                Part& part = parts_[k];
                double depth = lower * part.plane.cosine;
                for (std::size_t other = 0; other < parts_.size(); ++other) {
                    if (other == k) continue;
                    const Plane &here = part.plane, &there = parts_[other].plane;
                    const double distance = std::hypot(here.x - there.x, here.y - there.y, here.z - there.z);
                    depth -= parts_[other].solution.load * wheel_.compliance() / (std::numbers::pi * distance);
                }
                part.solution = workspace_.normal[k].approach(part.grid, part.h, depth, tolerance, warm || round > 0);
            }
        }
    }

    // By how much the wheel is to be lower than the gaps say.
    bool lower_until(double load, double& lower) {
        lower = 0;
        if (parts_.size() == 1) {
            Part& part = parts_[0];
            part.solution =
                workspace_.normal[0].carry(part.grid, part.h, load / part.plane.cosine, options_.tolerance, true);
            lower = part.solution.approach / part.plane.cosine;
            return true;
        }
        // the power 2/3 of a load grows nearly linearly
        const auto root = [](double of) { return std::cbrt(of * of); };
        double low = -std::numeric_limits<double>::infinity(), high = -low, last = 0, value = 0;
        for (int k = 0; k < 60; ++k) {
            settle(lower, options_.tolerance / 10, true);
            const double found = carried();
            if (std::abs(found / load - 1) < options_.tolerance) return true;
            (found < load ? low : high) = lower;
            const double rate = k == 0 ? root(found) / deepest() : (root(found) - value) / (lower - last);
            last = lower;
            value = root(found);
            lower += (root(load) - value) / rate;
            if (!(lower > low && lower < high)) {
                lower = detail::is_finite(high - low) ? (low + high) / 2 : last + (found < load ? 1 : -1) * deepest();
            }
        }
        return false;
    }

    double carried() const {
        double sum = 0;
        for (const Part& part : parts_) sum += part.solution.load * part.plane.cosine;
        return sum;
    }
    double deepest() const {
        double most = 0;
        for (const Part& part : parts_) most = (std::max)(most, part.plane.deepest);
        return most;
    }

    // Whether pressure reaches the border of the grid.
    bool outgrown(std::size_t k) const {
        const NormalContact::Grid& p = workspace_.normal[k].pressure();
        if (p.size() == 0) return false;
        const Eigen::Index right = p.rows() - 1, top = p.cols() - 1;
        return (p.row(0) > 0).any() || (p.row(right) > 0).any() || (p.col(0) > 0).any() || (p.col(top) > 0).any();
    }
    bool outgrown() const {
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            if (outgrown(k)) return true;
        }
        return false;
    }

    Contact result(double height, double lower) const {
        Contact contact;
        contact.height = height;
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            if (parts_[k].solution.load > 0) {
                wheel_.add_patches(parts_[k], lower, workspace_.normal[k].pressure(), contact.patches);
            }
        }
        std::stable_sort(contact.patches.begin(), contact.patches.end(),
                         [](const RailPatch& one, const RailPatch& other) { return one.load > other.load; });
        contact.status = contact.patches.empty() ? Status::no_contact : Status::ok;
        for (const RailPatch& patch : contact.patches) contact.status = (std::max)(contact.status, patch.status);
        return contact;
    }

    const WheelOnRail& wheel_;
    Attitude attitude_;
    Workspace& workspace_;
    const Options& options_;
    std::vector<Part>& parts_;
    double touch_ = 0;   // the height at which the wheel begins to touch
    double height_ = 0;  // of the planes
    int times_ = 1;      // as many cells as usual in both directions
};

template <std::same_as<double> Scalar>
auto WheelOnRail::carry(const WheelsetPosition& position, double load, Workspace& workspace,
                        const Options& options) const -> Contact {
    check(options);
    if (!detail::is_finite(position) || !detail::is_finite(load)) return {};
    if (!(load > 0)) return {.height = 0, .patches = {}, .status = Status::no_contact};
    return Search(*this, position, workspace, options).carry(load);
}

template <std::same_as<double> Scalar>
auto WheelOnRail::press(const WheelsetPosition& position, Workspace& workspace, const Options& options) const
    -> Contact {
    check(options);
    if (!detail::is_finite(position)) return {};
    return Search(*this, position, workspace, options).press(position.height);
}

}  // namespace rollbem
