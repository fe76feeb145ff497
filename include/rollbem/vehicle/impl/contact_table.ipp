// Bodies of vehicle/contact_table.hpp. Internal.
#pragma once

#include "../contact_table.hpp"

#include <algorithm>
#include <cstdint>
#include <istream>
#include <ostream>
#include <string>
#include <utility>

#include "../../detail/checked_stream.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/contact_table_interpolation.hpp"
#include "../detail/wheel_look_up.hpp"

namespace rollbem {

ROLLBEM_DECL ContactTable::Zones::Zones(std::vector<Cut> cuts) : cuts_(std::move(cuts)) {
    constexpr const char* name = "ContactTable::Zones";
    detail::require(count() <= most, name, "number of zones", count(), "be at most 4");
    for (std::size_t k = 0; k < cuts_.size(); ++k) {
        detail::require_finite(name, "y of a cut", cuts_[k].y);
        detail::require_positive(name, "half_width of a cut", cuts_[k].half_width);
        if (k == 0) continue;
        detail::require(low(k) >= high(k - 1), name, "lower end of a cut", low(k),
                        "be at least the upper end of the one before");
    }
}

ROLLBEM_DECL double ContactTable::Zones::weight(Eigen::Index zone, double y) const {
    const auto k = static_cast<std::size_t>(zone);
    const double from = k > 0 ? beyond(cuts_[k - 1], y) : 1, to = k < cuts_.size() ? beyond(cuts_[k], y) : 0;
    return (std::max)(from - to, 0.0);
}

ROLLBEM_DECL double ContactTable::Zones::beyond(const Cut& cut, double y) {
    const double t = ((y - cut.y) / cut.half_width + 1) / 2;
    if (t <= 0) return 0;
    return t < 1 ? t * t * t * (10 + t * (6 * t - 15)) : 1;
}

ROLLBEM_DECL ContactTable::ContactTable(Grid grid, Material material, std::vector<Side> sides)
    : grid_(std::move(grid)), material_(material) {
    const auto require_nodes = [](const char* what, const std::vector<double>& nodes, std::size_t least,
                                  std::size_t most) {
        const std::string rule = "be " + std::to_string(least) + " to " + std::to_string(most);
        detail::require(nodes.size() >= least && nodes.size() <= most, Interpolation::name, what, nodes.size(),
                        rule.c_str());
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            detail::require(detail::is_finite(nodes[k]) && (k == 0 || nodes[k] > nodes[k - 1]), Interpolation::name,
                            what, nodes[k], "ascend");
        }
    };
    require_nodes("number of shifts", grid_.shifts, 5, 10001);
    require_nodes("number of yaws", grid_.yaws, 2, most_yaws);
    require_nodes("number of loads", grid_.loads, 1, most_loads);
    for (std::size_t i = 0; i < grid_.shifts.size(); ++i) {
        const double opposite = -grid_.shifts[grid_.shifts.size() - 1 - i];
        detail::require(std::abs(grid_.shifts[i] - opposite) <= 1e-12, Interpolation::name, "shift", grid_.shifts[i],
                        "have its opposite among the shifts");
    }
    detail::require(grid_.yaws[0] == 0, Interpolation::name, "first yaw", grid_.yaws[0], "be 0");
    detail::require_positive(Interpolation::name, "first load", grid_.loads[0]);
    detail::require_positive(Interpolation::name, "shear_modulus", material_.shear_modulus);
    detail::require_poisson_ratio(Interpolation::name, material_.poisson_ratio);
    detail::require(sides.size() == 1 || sides.size() == 2, Interpolation::name, "number of sides", sides.size(),
                    "be 1 or 2");
    for (const double load : grid_.loads) roots_.push_back(std::cbrt(load));
    for (Side& side : sides) {
        detail::require_positive(Interpolation::name, "radius", side.radius);
        detail::require(side.on_rails.rows() == 2 && side.on_rails.cols() == grid_.nodes(), Interpolation::name,
                        "number of heights", side.on_rails.cols(), "be the number of the grid's nodes");
        detail::require(
            side.points.rows() == ContactRow::rows && side.points.cols() == grid_.nodes() * side.zones.count(),
            Interpolation::name, "number of points", side.points.cols(),
            "be the number of the grid's nodes times the number of zones");
        detail::require(side.on_rails.isFinite().all() && side.points.isFinite().all(), Interpolation::name, "values",
                        "not finite", "be finite");
        sides_.push_back(Interpolation{*this}.stored(std::move(side)));
    }
}

namespace detail {

/// Where a zone carries nothing, its rows except the share are copied from the nearest node on its line that carries;
/// lines without such a node are copied from the nearest line. `points` are the nodes of one zone.
inline void fill_zone(const ContactTable::Grid& grid, Eigen::Ref<Eigen::ArrayXXd> points) {
    const auto shifts = Eigen::Index(grid.shifts.size()), yaws = Eigen::Index(grid.yaws.size()),
               loads = Eigen::Index(grid.loads.size());
    const auto carries = [&](Eigen::Index node) { return points(ContactRow::share, node) > 0; };
    const auto copy = [&](Eigen::Index to, Eigen::Index from) {
        const double share = points(ContactRow::share, to);
        points.col(to) = points.col(from);
        points(ContactRow::share, to) = share;
    };
    std::vector<bool> known(std::size_t(yaws * loads));
    for (Eigen::Index line = 0; line < yaws * loads; ++line) {
        std::vector<Eigen::Index> with;
        for (Eigen::Index i = 0; i < shifts; ++i) {
            if (carries(line * shifts + i)) with.push_back(i);
        }
        known[std::size_t(line)] = !with.empty();
        for (Eigen::Index i = 0; i < shifts && !with.empty(); ++i) {
            const auto nearer = [&](Eigen::Index one, Eigen::Index two) {
                return std::abs(grid.shifts[std::size_t(one)] - grid.shifts[std::size_t(i)]) <
                       std::abs(grid.shifts[std::size_t(two)] - grid.shifts[std::size_t(i)]);
            };
            if (!carries(line * shifts + i))
                copy(line * shifts + i, line * shifts + *std::min_element(with.begin(), with.end(), nearer));
        }
    }
    const std::vector<bool> first = known;
    for (Eigen::Index line = 0; line < yaws * loads; ++line) {
        if (first[std::size_t(line)]) continue;
        Eigen::Index nearest = -1;
        const auto apart = [&](Eigen::Index other) {  // a nearer load is preferred
            return std::abs(other / yaws - line / yaws) + yaws * std::abs(other % yaws - line % yaws);
        };
        for (Eigen::Index other = 0; other < yaws * loads; ++other) {
            if (first[std::size_t(other)] && (nearest < 0 || apart(other) < apart(nearest))) nearest = other;
        }
        for (Eigen::Index i = 0; i < shifts && nearest >= 0; ++i) copy(line * shifts + i, nearest * shifts + i);
    }
}

/// Slopes by the shift of each row of each line; the slopes of the share are limited where `limit` is set.
inline Eigen::ArrayXXd slopes_of(const ContactTable::Grid& grid, const Eigen::ArrayXXd& values, bool limit) {
    const auto shifts = Eigen::Index(grid.shifts.size());
    Eigen::ArrayXXd slopes(values.rows(), values.cols());
    for (Eigen::Index node = 0; node < values.cols(); ++node) {
        const Eigen::Index i = node % shifts;
        const auto step = [&](Eigen::Index k) { return grid.shifts[std::size_t(k + 1)] - grid.shifts[std::size_t(k)]; };
        const auto difference = [&](Eigen::Index k) -> Eigen::ArrayXd {  // from node k of the line
            return (values.col(node - i + k + 1) - values.col(node - i + k)) / step(k);
        };
        if (i == 0 || i + 1 == shifts) {
            slopes.col(node) = difference(i == 0 ? 0 : i - 1);
            continue;
        }
        const Eigen::ArrayXd before = difference(i - 1), after = difference(i);
        slopes.col(node) = slope_between(before, step(i - 1), after, step(i));
        if (limit) {
            constexpr auto share = ContactRow::share;
            slopes(share, node) = limited(slopes(share, node), before[share], after[share]);
        }
    }
    return slopes;
}

}  // namespace detail

inline auto ContactTable::Interpolation::stored(Side side) const -> Stored {
    Stored made{.given = {},
                .means = ContactRow::Values::Zero(),
                .interpolated_means = {},
                .points = {},
                .slopes = {},
                .on_rails_slopes = {},
                .carrying = {}};
    for (Eigen::Index zone = 0; zone < side.zones.count(); ++zone) {
        detail::fill_zone(table.grid_, side.points.middleCols(zone * table.grid_.nodes(), table.grid_.nodes()));
    }
    made.means = side.points.rowwise().mean();
    made.means[ContactRow::share] = 0;
    made.points.setZero(packed_rows, side.points.cols());
    made.slopes = made.points;
    made.points.topRows<ContactRow::rows>() = (side.points.colwise() - Eigen::ArrayXd(made.means)).cast<float>();
    side.points = made.points.topRows<ContactRow::rows>().cast<double>().colwise() + Eigen::ArrayXd(made.means);
    made.interpolated_means = made.means;
    Eigen::ArrayXXd rows = side.points;
    for (const auto row : ContactRow::positive) {
        const auto given = side.points.row(row).transpose();
        const double least = 1e-6 * made.means[row];  // less drowns in the rounding of single precision
        detail::require((side.points.row(ContactRow::share).transpose() <= 0 || given > least).all(), name,
                        "semi-axis, coefficient, scale or peak of a point", given.minCoeff(),
                        "be positive, above 1e-6 of its mean");
        const Eigen::ArrayXd logs = (given > least).select(given, 1).log();
        made.interpolated_means[row] = logs.mean();
        made.points.row(row) = (logs - logs.mean()).cast<float>().transpose();
        rows.row(row) = made.points.row(row).cast<double>() + logs.mean();
    }
    made.slopes.topRows<ContactRow::rows>() = detail::slopes_of(table.grid_, rows, true).cast<float>();
    made.on_rails_slopes = detail::slopes_of(table.grid_, side.on_rails, false);
    const auto shifts = Eigen::Index(table.grid_.shifts.size()), lines = table.grid_.nodes() / shifts;
    for (Eigen::Index zone = 0; zone < side.zones.count(); ++zone) {
        const Eigen::Map<const Eigen::ArrayXXf, 0, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>> shares(
            made.points.col(zone * table.grid_.nodes()).data() + ContactRow::share, shifts, lines,
            {shifts * packed_rows, Eigen::Index(packed_rows)});
        for (Eigen::Index i = 0; i + 1 < shifts; ++i) {
            made.carrying.push_back((shares.middleRows(i, 2) > 0).any() ? 1 : 0);
        }
    }
    made.given = std::move(side);
    return made;
}

ROLLBEM_DECL auto ContactTable::on_rails(double lateral, double yaw, const std::array<double, 2>& loads) const noexcept
    -> OnRails {
    // heights of both wheels at the roll of unequal loads: profiles meet the rails as at another shift
    struct Wheel {
        double height, by_lateral, by_yaw, by_load, by_roll;
    };
    const auto wheel = [&](WheelsetSide side, double roll) -> Wheel {
        const double mirror = side == WheelsetSide::left ? -1 : 1, load = loads[std::size_t(side)];
        const Stored& own = sides_[index_of(side)];
        const double u = mirror * lateral, psi = mirror * yaw, radius = own.given.radius;
        const auto table = Interpolation{*this}.wheel_on_rails(own, u, psi, load).roll;
        const double limit = largest_shift();
        const double moved = std::clamp(u - radius * (mirror * roll - table[0]), -limit, limit);
        const auto height = Interpolation{*this}.wheel_on_rails(own, moved, psi, load).height;
        return {height[0], mirror * height[1] * (1 + radius * table[1]),
                mirror * (height[2] + height[1] * radius * table[2]), height[3] + height[1] * radius * table[3],
                -mirror * radius * height[1]};
    };
    double roll =
        Interpolation{*this}.wheel_on_rails(sides_[index_of(WheelsetSide::right)], lateral, yaw, loads[1]).roll[0];
    OnRails found;
    for (int round = 0; round < 4; ++round) {
        const Wheel left = wheel(WheelsetSide::left, roll), right = wheel(WheelsetSide::right, roll);
        const double slope = 2 * half_base - (right.by_roll - left.by_roll);
        const double excess = 2 * half_base * roll - (right.height - left.height);
        found = {.height = (left.height + right.height) / 2,
                 .roll = roll,
                 .roll_by_lateral = (right.by_lateral - left.by_lateral) / slope,
                 .roll_by_yaw = (right.by_yaw - left.by_yaw) / slope,
                 .roll_by_load = {-left.by_load / slope, right.by_load / slope}};
        const double by_roll = (left.by_roll + right.by_roll) / 2;
        found.height_by_lateral = (left.by_lateral + right.by_lateral) / 2 + by_roll * found.roll_by_lateral;
        found.height_by_yaw = (left.by_yaw + right.by_yaw) / 2 + by_roll * found.roll_by_yaw;
        found.height_by_load = {left.by_load / 2 + by_roll * found.roll_by_load[0],
                                right.by_load / 2 + by_roll * found.roll_by_load[1]};
        if (std::abs(excess) < 1e-14) break;
        roll -= excess / slope;
    }
    return found;
}

ROLLBEM_DECL auto ContactTable::load_at_height(WheelsetSide side, double lateral, double yaw,
                                               double height) const noexcept -> Support {
    const double mirror = side == WheelsetSide::left ? -1 : 1;
    const Stored& own = sides_[index_of(side)];
    if (!detail::is_finite(lateral) || !detail::is_finite(yaw) || !detail::is_finite(height)) return {};
    if (!covers(lateral, yaw) || grid_.loads.size() < 2) return {.status = Status::wrong_table};
    const auto at = [&](double load) {
        return Interpolation{*this}.wheel_on_rails(own, mirror * lateral, mirror * yaw, load).height;
    };
    const auto result = [&](double load, double by_load, double by_lateral, double by_yaw) -> Support {
        if (!detail::is_finite(load)) return {};
        return {load, 1 / by_load, -mirror * by_lateral / by_load, -mirror * by_yaw / by_load, Status::ok};
    };
    // below the first load the height depends on the square of the load's cube root, starting where the wheel touches
    const double least = grid_.loads.front();
    const auto first = at(least);
    if (height < first[0]) {
        const double inside = at(least * (1 + 1e-9))[3];
        const double share = inside > 0 ? 3 * inside * least / 2 : 0, touch = first[0] - share;
        if (!(height > touch)) return {.load = 0, .status = Status::ok};
        const double load = least * std::pow((height - touch) / share, 1.5);
        return result(load, 2 * (height - touch) / (3 * load), first[1], first[2]);
    }
    double low = least, high = grid_.loads.back();
    if (height >= at(high)[0]) {  // beyond the last load, the stiffness at the last load
        const auto last = at(high * (1 - 1e-9));
        return result(high + (height - last[0]) / last[3], last[3], last[1], last[2]);
    }
    double load = (low + high) / 2;
    for (int round = 0; round < 60; ++round) {
        const auto here = at(load);
        (here[0] < height ? low : high) = load;
        const double next = load - (here[0] - height) / here[3];
        const double change = next > low && next < high ? next - load : (low + high) / 2 - load;
        load += change;
        if (std::abs(change) <= 1e-14 * load) break;
    }
    const auto here = at(load);
    return result(load, here[3], here[1], here[2]);
}

ROLLBEM_DECL void ContactTable::write(std::ostream& stream) const {
    detail::CheckedWriter writer(stream, Interpolation::magic);
    for (const std::size_t count : {std::size_t(Interpolation::version), grid_.shifts.size(), grid_.yaws.size(),
                                    grid_.loads.size(), sides_.size()}) {
        writer.integer(static_cast<std::uint32_t>(count));
    }
    for (const auto* nodes : {&grid_.shifts, &grid_.yaws, &grid_.loads}) {
        for (const double node : *nodes) writer.number(node);
    }
    writer.number(material_.shear_modulus);
    writer.number(material_.poisson_ratio);
    writer.integer(static_cast<std::uint32_t>(errors_.size()));
    for (const Errors& of : errors_) {
        for (const double value : {of.least_load, of.most_load, of.wheels}) writer.number(value);
        for (std::size_t k = 0; k < 2; ++k) {
            for (const double value : {of.mean[k], of.most_of_95[k], of.largest[k]}) writer.number(value);
        }
    }
    for (const Stored& side : sides_) {
        const Side& given = side.given;
        writer.integer(static_cast<std::uint32_t>(given.zones.cuts().size()));
        writer.number(given.radius);
        for (const ContactTable::Zones::Cut& cut : given.zones.cuts()) {
            writer.number(cut.y);
            writer.number(cut.half_width);
        }
        for (const double mean : side.means) writer.number(mean);
        for (Eigen::Index node = 0; node < grid_.nodes(); ++node) {
            for (const double value : given.on_rails.col(node)) writer.number(value);
            std::uint32_t carrying = 0;
            for (Eigen::Index zone = 0; zone < given.zones.count(); ++zone) {
                if (side.points(ContactRow::share, zone * grid_.nodes() + node) > 0) carrying |= 1U << unsigned(zone);
            }
            writer.integer(carrying);
            for (Eigen::Index zone = 0; zone < given.zones.count(); ++zone) {
                if ((carrying >> unsigned(zone) & 1U) == 0) continue;
                for (Eigen::Index row = 0; row < ContactRow::rows; ++row) {
                    writer.number(float(given.points(row, zone * grid_.nodes() + node) - side.means[row]));
                }
            }
        }
    }
    writer.finish();
}

namespace detail {

/// Rows of a point in the order of a file's version.
inline std::vector<Eigen::Index> rows_of_version(std::uint32_t version) {
    using enum ContactRow::Of;
    std::vector<Eigen::Index> found;
    const auto add = [&](Eigen::Index first, Eigen::Index count) {
        for (Eigen::Index k = 0; k < count; ++k) found.push_back(first + k);
    };
    if (version > 2) {
        add(0, ContactRow::rows);
    } else {
        for (const auto& [first, count] :
             {std::pair(share, 3), {arm_z, 2}, {radius, 8}, {correction, 9}, {correction_by_yaw, 9}, {peak, 3}}) {
            add(first, count);
        }
    }
    return found;
}

inline std::vector<ContactTable::Errors> read_errors(CheckedReader& reader) {
    const auto count = reader.integer<std::uint32_t>();
    require(count <= 100, "ContactTable", "number of errors", count, "be at most 100");
    std::vector<ContactTable::Errors> errors(count);
    for (ContactTable::Errors& of : errors) {
        for (double* value : {&of.least_load, &of.most_load, &of.wheels}) *value = reader.number();
        for (std::size_t k = 0; k < 2; ++k) {
            for (double* value : {&of.mean[k], &of.most_of_95[k], &of.largest[k]}) *value = reader.number();
        }
    }
    return errors;
}

inline ContactTable::Side read_side(CheckedReader& reader, const ContactTable::Grid& grid,
                                    const std::vector<Eigen::Index>& rows) {
    ContactTable::Side side;
    const auto cut_count = reader.integer<std::uint32_t>();
    require(cut_count < ContactTable::Zones::most, "ContactTable", "number of cuts", cut_count, "be at most 3");
    std::vector<ContactTable::Zones::Cut> cuts(cut_count);
    side.radius = reader.number();
    for (ContactTable::Zones::Cut& cut : cuts) {
        cut.y = reader.number();
        cut.half_width = reader.number();
    }
    side.zones = ContactTable::Zones(std::move(cuts));
    ContactRow::Values means = ContactRow::Values::Zero();
    for (const Eigen::Index row : rows) means[row] = reader.number();
    side.on_rails.resize(2, grid.nodes());
    side.points.setZero(ContactRow::rows, grid.nodes() * side.zones.count());
    for (Eigen::Index node = 0; node < grid.nodes(); ++node) {
        for (Eigen::Index row = 0; row < 2; ++row) side.on_rails(row, node) = reader.number();
        const auto carrying = reader.integer<std::uint32_t>();
        for (Eigen::Index zone = 0; zone < side.zones.count(); ++zone) {
            if ((carrying >> unsigned(zone) & 1U) == 0) continue;
            for (const Eigen::Index row : rows) {
                side.points(row, zone * grid.nodes() + node) = means[row] + double(reader.single());
            }
        }
    }
    return side;
}

}  // namespace detail

ROLLBEM_DECL ContactTable ContactTable::read(std::istream& stream) {
    detail::CheckedReader reader(stream, Interpolation::name, Interpolation::magic);
    const auto found = reader.integer<std::uint32_t>();
    detail::require(found == 2 || found == Interpolation::version, Interpolation::name, "version", found,
                    "be 2 or 3: make the table again with contact_table");
    std::array<std::size_t, 4> counts;
    for (auto [count, most] : {std::pair(&counts[0], 10001U),
                               {&counts[1], unsigned(most_yaws)},
                               {&counts[2], unsigned(most_loads)},
                               {&counts[3], 2U}}) {
        *count = reader.integer<std::uint32_t>();
        detail::require(*count >= 1 && *count <= most, Interpolation::name, "number of nodes", *count,
                        "be at least 1 and at most the largest number of a table");
    }
    Grid grid{std::vector<double>(counts[0]), std::vector<double>(counts[1]), std::vector<double>(counts[2])};
    for (auto* nodes : {&grid.shifts, &grid.yaws, &grid.loads}) {
        for (double& node : *nodes) node = reader.number();
    }
    detail::require(grid.nodes() <= 200000, Interpolation::name, "number of nodes", grid.nodes(), "be at most 200000");
    const double G = reader.number(), nu = reader.number();
    std::vector<Errors> errors;
    if (found > 2) errors = detail::read_errors(reader);
    std::vector<Side> sides;
    for (std::size_t k = 0; k < counts[3]; ++k) {
        sides.push_back(detail::read_side(reader, grid, detail::rows_of_version(found)));
    }
    reader.finish();
    return ContactTable(std::move(grid), {G, nu}, std::move(sides)).with_errors(std::move(errors));
}

ROLLBEM_DECL ContactTable ContactTable::read(const std::filesystem::path& path) {
    return detail::read_file<ContactTable>(path, Interpolation::name);
}

ROLLBEM_DECL WheelForces ContactTable::look_up(const CreepForceTable& creep, WheelsetSide side,
                                               const WheelsetPosition& position, const WheelsetSpeeds& speeds,
                                               const ContactTable::Load& load,
                                               const ContactTable::Friction& friction) const noexcept {
    WheelForces result;
    detail::WheelLookUp(*this, creep, friction, result)(side, position, speeds, load, true);
    return result;
}

ROLLBEM_DECL WheelForces ContactTable::forces(const CreepForceTable& creep, WheelsetSide side,
                                              const WheelsetPosition& position, const WheelsetSpeeds& speeds,
                                              const ContactTable::Load& load,
                                              const ContactTable::Friction& friction) const noexcept {
    WheelForces result;
    detail::WheelLookUp(*this, creep, friction, result)(side, position, speeds, load, false);
    return result;
}

}  // namespace rollbem
