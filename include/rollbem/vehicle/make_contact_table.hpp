// make_contact_table: the table of a wheelset's contact geometry from its profiles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "../adhesion/creep_coefficients.hpp"
#include "../detail/parallel_for.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/rectangle_kernel.hpp"
#include "contact_table.hpp"
#include "creep_force_table.hpp"
#include "wheelset_on_track.hpp"

namespace rollbem {

/// An ellipse for the creep forces of a patch.
struct PatchEllipse {
    double x = 0, s = 0;                     ///< its middle, from the reference point, in the plane [m]
    double half_length = 0, half_width = 0;  ///< [m]
    /// Its rows from c11 on, the others are 0.
    Eigen::Array<double, ContactRow::point_rows, 1, Eigen::DontAlign> values =
        Eigen::Array<double, ContactRow::point_rows, 1, Eigen::DontAlign>::Zero();

    /// The forces on the patch under the load N [N], by a table; creepages and moment at the reference point.
    TangentialForce<double> forces(const CreepForceTable& creep, const TrackDimensions& dimensions, double mu,
                                   double load, const Creepage<double>& at) const {
        const std::array<double, 3> there{at.longitudinal - at.spin * s, at.lateral + at.spin * x, at.spin};
        const auto [xi, eta, phi] =
            detail::ellipse_creepages<double>(there, half_length, half_width, dimensions.shear_modulus, mu * load,
                                              [&](Eigen::Index row) { return values[row]; });
        const PatchContact<double> contact(
            {half_length, half_width, dimensions.shear_modulus, dimensions.poisson_ratio});
        TangentialForce<double> force = creep.look_up(contact, mu, load, {xi, eta, phi}).force;
        force.moment += x * force.lateral - s * force.longitudinal;
        return force;
    }
};

/// The ellipse of a patch for which a table of creep forces comes nearest to friction on its own outline under its own
/// pressures. Its middle and its semi-axes are those of Hertz's pressures with the same first and second moments, a^2/5
/// and b^2/5. The linear law is the patch's own: creepages are multiplied by E^-1 L, where L are the forces of the
/// outline per creepage and E those of the ellipse, as far as the contact sticks; see ContactTable::look_up. Where a/b
/// lies beyond the table, the longer semi-axis stays and the correction is kept in full sliding, too. Throws
/// std::invalid_argument unless the patch has numbers.
inline PatchEllipse creep_ellipse(const RailPatch& patch, const TrackDimensions& dimensions,
                                  const CreepForceTable& creep, Eigen::Index n = 12, Eigen::Index strips = 13) {
    using enum ContactRow::Of;
    detail::require(patch.load > 0, "creep_ellipse", "load of the patch", patch.load, "be positive");
    const CellGrid& grid = patch.grid;
    double sum = 0;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero(), square = mean;
    for (Eigen::Index j = 0; j < grid.ny; ++j) {
        for (Eigen::Index i = 0; i < grid.nx; ++i) {
            const Eigen::Vector2d at(grid.x(i), grid.y(j));
            sum += patch.pressure(i, j);
            mean += patch.pressure(i, j) * at;
            square += patch.pressure(i, j) * at.cwiseAbs2();
        }
    }
    mean /= sum;
    // a cell's own second moment counts where the patch is a cell wide
    square = square / sum - mean.cwiseAbs2() + Eigen::Vector2d(grid.dx * grid.dx, grid.dy * grid.dy) / 12;
    PatchEllipse ellipse{
        .x = mean[0], .s = mean[1], .half_length = std::sqrt(5 * square[0]), .half_width = std::sqrt(5 * square[1])};
    double &a = ellipse.half_length, &b = ellipse.half_width;
    const double most = creep.grid().largest_a_over_b(), least = creep.grid().smallest_a_over_b();
    if (a > most * b || a < least * b) {
        ellipse.values[kept] = 1;
        (a > most * b ? b : a) = a > most * b ? a / most : least * b;
    }
    // by its tangents at rest; its linear law in units of G c^2, (xi, eta, phi c) and (F_x, F_y, M_z/c)
    const PatchContact<double> contact({a, b, dimensions.shear_modulus, dimensions.poisson_ratio});
    const TabulatedForce rest = creep.look_up(contact, 1, patch.load, {0, 0, 0});
    detail::require(rest.status == StepStatus::ok, "creep_ellipse", "status of the table of creep forces",
                    name(rest.status), "be ok");
    const double c = contact.c(), unit = -1 / (contact.shear_modulus() * c * c);
    const CreepageTangent<double>& t = rest.tangent;
    Eigen::Matrix3d of_ellipse;
    for (const auto& [column, by] : {std::pair(0, t.by_longitudinal), {1, t.by_lateral}, {2, (1 / c) * t.by_spin}}) {
        of_ellipse.col(column) = unit * Eigen::Vector3d(by.longitudinal, by.lateral, by.moment / c);
    }
    ellipse.values[c11] = of_ellipse(0, 0);
    ellipse.values[c22] = of_ellipse(1, 1);
    ellipse.values[c23] = of_ellipse(1, 2);
    if (!patch.outline) return ellipse;  // too few cells
    const PatchContact<double> outline = contact_of(patch, dimensions);
    for (; strips >= 5; strips -= 2) {  // fewer where rolling would gain energy
        const Response<double> own =
            solve_steady(outline, patch_mesh(outline, cosine_mesh(n), uniform_mesh(strips)),
                         NodeDifference{Nodes::chebyshev}, HalfSpace<double>(outline.poisson_ratio()));
        const auto& errors = own.error_estimates;  // a rough correction is better than none
        const bool rough = own.status == Status::not_converged && errors.diagonal().maxCoeff() < 0.25;
        if (own.status != Status::ok && !rough) continue;
        const double scale = outline.half_length() / c;
        const Eigen::Vector3d units(1, 1, scale);
        Eigen::Matrix3d law = scale * scale * units.asDiagonal() * own.coefficients * units.asDiagonal(), to_middle;
        to_middle << 1, 0, mean[1] / c, 0, 1, -mean[0] / c, 0, 0,
            1;  // creepages at the reference point from those there
        law = (to_middle.transpose() * law * to_middle).eval();
        Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(ellipse.values.data() + correction) =
            of_ellipse.inverse() * law - Eigen::Matrix3d::Identity();
        break;
    }
    return ellipse;
}

namespace detail {

/// Points of contact of one wheel at one position, before they are told apart.
struct ContactNode {
    struct Point {
        double wheel_y = 0;
        Eigen::Array<double, ContactRow::point_rows, 1> values;
    };
    std::vector<Point> points;  // at most two, by decreasing load; none: not found
    double height = 0, roll = 0;

    ContactNode() = default;
    ContactNode(const WheelOnRail::Contact& contact, const WheelsetPosition& seen, double nominal_load,
                const TrackDimensions& dimensions, const CreepForceTable& creep)
        : height(seen.height), roll(seen.roll) {
        using enum ContactRow::Of;
        double carried = 0;
        for (const RailPatch& patch : contact.patches) {
            if (points.size() == 2) break;
            const PatchEllipse ellipse = creep_ellipse(patch, dimensions, creep);
            const double sine = std::sin(patch.angle), cosine = std::cos(patch.angle), root = std::cbrt(patch.load);
            Point point;
            point.wheel_y = patch.wheel_y + ellipse.s * cosine;
            auto& v = point.values;
            v = ellipse.values;
            v[arm_x] = patch.x + ellipse.x;
            v[arm_y] = patch.y + ellipse.s * cosine - patch.approach * sine - seen.lateral;
            v[arm_z] = patch.z + ellipse.s * sine + patch.approach * cosine - seen.height + dimensions.radius;
            v[angle] = patch.angle;
            v[length] = ellipse.half_length / root;
            v[width] = ellipse.half_width / root;
            v[share] = patch.load * cosine / nominal_load;
            v[radius] = patch.rolling_radius;
            carried += v[share];
            points.push_back(point);
        }
        for (Point& point : points) point.values[share] /= carried;
    }
};

/// Places along the wheel's profile that part the two points of every wheel that has two: as few as possible.
inline std::vector<double> cuts_between(const std::vector<ContactNode>& nodes) {
    std::vector<std::pair<double, double>> gaps;  // by their upper ends
    for (const ContactNode& node : nodes) {
        if (node.points.size() < 2) continue;
        const auto [low, high] = std::minmax(node.points[0].wheel_y, node.points[1].wheel_y);
        gaps.emplace_back(high, low);
    }
    std::sort(gaps.begin(), gaps.end());
    std::vector<double> cuts;
    for (const auto& [high, low] : gaps) {
        if (cuts.empty() || cuts.back() <= low) cuts.push_back(high);
    }
    return cuts;
}

}  // namespace detail

/// The table of a wheelset whose wheels carry `load` each, on `jobs` threads; `creep` is the table that it will be used
/// with. `missing`, if given, is set to the share of positions in which wheels do not carry the load (no_contact,
/// load_not_reached, end_of_profile), which are filled by those beside them. Throws std::invalid_argument if the grid
/// breaks its invariant, or at some yaw fewer than half of the positions carry the load. A position takes some 0.1 s.
inline ContactTable make_contact_table(
    const WheelsetOnTrack& track, double load, const CreepForceTable& creep, const ContactTable::Grid& grid = {},
    std::size_t jobs = 1, const WheelOnRail::Options& options = {}, double* missing = nullptr,
    const std::function<void()>& done = [] {}) {
    using enum ContactRow::Of;
    const TrackDimensions& dimensions = track.wheel().dimensions();
    const auto table = [&](Eigen::ArrayXXd values) {
        return ContactTable(grid, load, dimensions.shear_modulus, dimensions.poisson_ratio, std::move(values));
    };
    table(Eigen::ArrayXXd::Zero(Eigen::Index(ContactTable::rows), grid.nodes()));  // checks the grid and the load
    // 1. Both wheels at yaw >= 0: the left one is a right one at the opposite shift and yaw
    std::vector<detail::ContactNode> nodes(static_cast<std::size_t>(grid.nodes()));
    const Eigen::Index middle = grid.yaws / 2;
    detail::parallel_for(
        static_cast<std::size_t>(middle + 1), jobs,
        [&](std::size_t row) {
            const Eigen::Index k = middle + static_cast<Eigen::Index>(row);
            WheelsetOnTrack::Workspace workspace;
            WheelsetPosition start;
            for (Eigen::Index i = 0; i < grid.shifts; ++i) {
                start.lateral = grid.shift(i);
                start.yaw = grid.yaw(k);
                const auto contacts = track.solve(start, {load, load}, workspace, {}, options);
                const bool carries = std::all_of(contacts.wheels.begin(), contacts.wheels.end(), [](const auto& wheel) {
                    return !wheel.patches.empty() && (has_numbers(wheel.status) || wheel.status == Status::few_cells);
                });
                if (!carries) {
                    workspace = {};
                    continue;
                }
                start.roll = contacts.position.roll;
                for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
                    const bool right = side == WheelsetSide::right;
                    const Eigen::Index node =
                        right ? k * grid.shifts + i : (grid.yaws - 1 - k) * grid.shifts + grid.shifts - 1 - i;
                    if (!right && row == 0) continue;
                    nodes[static_cast<std::size_t>(node)] = {contacts.wheels[static_cast<std::size_t>(side)],
                                                             WheelsetOnTrack::seen_from(side, contacts.position), load,
                                                             dimensions, creep};
                }
            }
        },
        done);
    // 2. Two points a wheel, told apart by where they are on its profile
    const std::vector<double> cuts = detail::cuts_between(nodes);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    Eigen::ArrayXXd values = Eigen::ArrayXXd::Constant(Eigen::Index(ContactTable::rows), grid.nodes(), none);
    constexpr Eigen::Index rows = point_rows;
    Eigen::Index empty = 0;
    for (Eigen::Index node = 0; node < grid.nodes(); ++node) {
        const detail::ContactNode& from = nodes[static_cast<std::size_t>(node)];
        empty += from.points.empty();
        if (from.points.empty()) continue;
        const auto part = [&](double wheel_y) {
            return static_cast<Eigen::Index>(std::upper_bound(cuts.begin(), cuts.end(), wheel_y) - cuts.begin()) % 2;
        };
        const Eigen::Index first = part(from.points[0].wheel_y);
        values.col(node)[share] = values.col(node)[rows + share] = 0;
        values.col(node).segment<rows>(first * rows) = from.points[0].values;
        if (from.points.size() > 1) values.col(node).segment<rows>((1 - first) * rows) = from.points[1].values;
        values(ContactTable::height, node) = from.height;
        values(ContactTable::roll, node) = from.roll;
    }
    if (missing) *missing = double(empty) / double(grid.nodes());
    // 3. What is not known: between the neighbours where there are both, else as the nearest, else as the other point
    for (Eigen::Index k = 0; k < grid.yaws; ++k) {
        auto row = values.middleCols(k * grid.shifts, grid.shifts);
        const auto known = [&](Eigen::Index i) { return !std::isnan(row(ContactTable::height, i)); };
        Eigen::Index count = 0;
        for (Eigen::Index i = 0; i < grid.shifts; ++i) count += known(i);
        detail::require(2 * count > grid.shifts, "make_contact_table",
                        "number of positions that carry the load at a yaw", count, "be at least half of them");
        const auto fill = [&](Eigen::Index first, Eigen::Index size, const auto& given, bool between) {
            Eigen::Index last = -1;
            for (Eigen::Index i = 0; i <= grid.shifts; ++i) {
                if (i < grid.shifts && !given(i)) continue;
                for (Eigen::Index j = last + 1; j < i; ++j) {
                    const double t = last < 0 ? 1 : i == grid.shifts ? 0 : double(j - last) / double(i - last);
                    const double weight = between ? t : t < 0.5 ? 0 : 1;
                    Eigen::ArrayXd filled = Eigen::ArrayXd::Zero(size);
                    if (weight < 1) filled += (1 - weight) * row.col(last).segment(first, size);
                    if (weight > 0) filled += weight * row.col(i).segment(first, size);
                    const double own = row(first + share, j);
                    row.col(j).segment(first, size) = filled;
                    if (!between) row(first + share, j) = own;
                }
                last = i;
            }
        };
        for (Eigen::Index point = 0; point < 2; ++point) {
            const Eigen::Index first = point * rows;
            bool any = false;
            for (Eigen::Index i = 0; i < grid.shifts; ++i) any = any || row(first + share, i) > 0;
            if (!any) {
                for (Eigen::Index i = 0; i < grid.shifts; ++i) {
                    const double own = row(first + share, i);
                    row.col(i).segment(first, rows) = row.col(i).segment((1 - point) * rows, rows);
                    row(first + share, i) = own;
                }
                continue;
            }
            fill(
                first, rows, [&](Eigen::Index i) { return row(first + share, i) > 0; }, false);
        }
        fill(0, Eigen::Index(ContactTable::rows), known, true);
    }
    return table(std::move(values));
}

}  // namespace rollbem
