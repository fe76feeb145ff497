// ContactTable: its numbers, their interpolation, and files. Internal; include vehicle/contact_table.hpp.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/checked_stream.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../scene/creepage.hpp"
#include "../../scene/force.hpp"
#include "../../scene/patch_contact.hpp"
#include "../../scene/wheelset.hpp"
#include "../../status.hpp"
#include "../contact_row.hpp"
#include "../contact_zones.hpp"
#include "../creep_force_table.hpp"
#include "../reduced_friction.hpp"
#include "table_weights.hpp"
#include "widened.hpp"

namespace rollbem {

/// Friction of one wheel.
struct WheelFriction {
    double coefficient = 0.3;                                   ///< mu [-]
    std::array<double, ContactZones::most> factor{1, 1, 1, 1};  ///< factor of mu in each zone [-]
    const ReducedFriction* reduced = nullptr;                   ///< reduced friction of wet or dirty rails, if any

    WheelFriction(double mu = 0.3) : coefficient(mu) {}  // NOLINT: a number is friction
};

/// The load of a wheel.
struct WheelLoad {
    double vertical;  ///< Q [N], carried by normal forces and friction
    /// Roll of the wheelset [rad], from ContactTable::on_rails. Empty: each wheel takes the roll of equal loads.
    std::optional<double> roll{};

    WheelLoad(double Q, std::optional<double> rolled = {}) : vertical(Q), roll(rolled) {}  // NOLINT: a number is a load
};

/// Forces of the rail on one wheel.
struct WheelForces {
    /// Contact of a wheel in one zone of the rail, as on the right wheel.
    struct Point {
        double load_share = 0;        ///< share of the vertical load, without friction [-]; 0: no contact, no numbers
        std::array<double, 3> arm{};  ///< place of the point from the middle of the axle, in track axes [m]
        double angle = 0;             ///< angle delta of the pressures' mean normal [rad]
        double rolling_radius = 0;    ///< [m]
        double rail_y = 0, wheel_y = 0;              ///< y of the point in both profiles [m]
        double normal_load = 0;                      ///< N [N]
        double peak_pressure = 0;                    ///< largest pressure in the zone [Pa]
        PatchContact<double> ellipse{{1, 1, 1, 0}};  ///< equivalent ellipse used for the creep forces
        Creepage<double> creepage{};                 ///< wheel minus rail, as creepage_of
        TangentialForce<double> force{};             ///< force on the wheel in the plane [N], moment [N m]
        double rolling_velocity = 0;                 ///< V [m/s], below 0 where the wheel rolls backwards
        double heat = 0;                             ///< heat of friction [W]
    };

    /// Inputs by which the forces are differentiated.
    enum Input : Eigen::Index {
        lateral,
        yaw,
        forward,
        pitch_rate,
        lateral_speed,
        vertical_speed,
        roll_rate,
        yaw_rate,
        load,
        mu,
        roll,  ///< 0 unless the load has a roll
        inputs
    };

    /// In track axes F_x, F_y, F_z [N], and M_x, M_y, M_z [N m] about the middle of the axle. If the status is
    /// invalid_step, normal forces alone; otherwise NaN unless ok.
    Eigen::Matrix<double, 6, 1, Eigen::DontAlign> force =
        Eigen::Matrix<double, 6, 1, Eigen::DontAlign>::Constant(std::numeric_limits<double>::quiet_NaN());
    /// Derivatives of the force, a column for each Input in SI units; exact, to the digits of single precision, except
    /// at jumps of higher derivatives.
    Eigen::Matrix<double, 6, inputs, Eigen::DontAlign> tangent =
        Eigen::Matrix<double, 6, inputs, Eigen::DontAlign>::Zero();
    std::array<Point, ContactZones::most> points;
    double heat = 0;  ///< heat of friction at all points [W]
    /// The load lies between the loads of the table. If not, places and shares are taken at the table's border, with an
    /// unknown error.
    bool load_on_table = false;
    /// Status of the look-up, other than ok:
    ///
    /// - wrong_table: the position, or the shift equivalent to the roll, lies beyond the table, no zone carries there,
    ///   or Poisson's ratios differ;
    /// - invalid_load: load or mu is negative;
    /// - invalid_step: the wheel does not roll, as the mean of its speed and its circumferential speed is 0;
    /// - not_finite;
    /// - no_solution: the rail cannot carry the load, as friction holds the wheel up.
    Status status = Status::not_finite;

    auto derivative(Input input) const { return tangent.col(input); }
};

namespace detail {
template <std::same_as<double> Real>
class WheelLookUp;
}

/// Geometry of contact by look-up. The rail is divided into zones. For each zone the table has the place, mean normal,
/// rolling radius and load share of the pressures in it, and an ellipse for their creep forces. A left wheel that is
/// the mirror image of the right wheel has no numbers of its own.
///
/// Values are interpolated by local cubics along the shift and the cube root of the load, and by polynomials in yaw^2
/// along the yaw: on straight rails the contact at -yaw is the mirror image, across the track, of the contact at yaw.
/// All are C1, and shares of the load do not overshoot. Zones have integrals of the pressures, so that forces stay
/// continuous where patches merge, part or vanish. Beyond its loads the table keeps the geometry of its border, and
/// ellipses grow with N^(1/3). Immutable: threads may share it.
class ContactTable {
public:
    /// Coordinates of the nodes.
    ///
    /// Invariant: all ascend and are finite; 5 to 10001 shifts, mirror images of each other; 2 to 8 yaws from 0; 1 to 8
    /// positive loads.
    struct Grid {
        std::vector<double> shifts;  ///< [m]
        std::vector<double> yaws;    ///< [rad]
        std::vector<double> loads;   ///< vertical, of each wheel [N]

        Eigen::Index nodes() const { return Eigen::Index(shifts.size() * yaws.size() * loads.size()); }
        /// Index of a node. Shifts follow one another fastest, then yaws, then loads.
        Eigen::Index node(std::size_t load, std::size_t yaw, std::size_t shift) const {
            return Eigen::Index((load * yaws.size() + yaw) * shifts.size() + shift);
        }
    };
    static constexpr std::size_t most_yaws = 8, most_loads = 8;

    /// Numbers of the right wheel, or of the left wheel as a right wheel.
    struct Side {
        double radius = 0;  ///< radius of the tape circle [m]
        ContactZones zones{};
        /// Height of the wheel, z_ws + support_y roll [m], and roll of the wheelset [rad], under equal loads: 2 x
        /// nodes.
        Eigen::ArrayXXd on_rails{};
        /// ContactRow, for each zone all nodes; where a zone carries nothing, its share is 0 and its other rows are not
        /// used.
        Eigen::ArrayXXd points{};
    };
    struct Material {
        double shear_modulus, poisson_ratio;
    };

    /// Height and roll of a wheelset, and their derivatives.
    struct OnRails {
        double height = 0, roll = 0;                             ///< [m], [rad]
        double height_by_lateral = 0, roll_by_lateral = 0;       ///< [-], [rad/m]
        double height_by_yaw = 0, roll_by_yaw = 0;               ///< [m/rad], [-]
        std::array<double, 2> height_by_load{}, roll_by_load{};  ///< left and right [m/N], [rad/N]
    };
    /// The load of a wheel at a height, and its derivatives.
    struct Support {
        double load = std::numeric_limits<double>::quiet_NaN();  ///< Q [N]; 0: lifted
        double by_height = 0;                                    ///< stiffness [N/m]
        double by_lateral = 0, by_yaw = 0;                       ///< [N/m], [N/rad]
        Status status = Status::not_finite;  ///< or wrong_table: the position lies beyond it, or it has one load
    };

    /// Half the distance between the points at which heights of wheels are taken [m].
    static constexpr double support_y = 0.75;

    /// `sides` are left and right, or one side for both. Throws std::invalid_argument if the grid breaks its invariant,
    /// numbers of nodes differ, or a value is not finite.
    ContactTable(Grid grid, Material material, std::vector<Side> sides);

    /// Reads the format of write(); throws as CreepForceTable::read does.
    static ContactTable read(std::istream& stream);
    static ContactTable read(const std::filesystem::path& path) { return detail::read_file<ContactTable>(path, name); }

    /// Little-endian, version 2: the text "rollbem contact geometry"; version, numbers of shifts, yaws, loads and sides
    /// (32 bits each); shifts, yaws, loads, G, nu (64 bits each); for each side the number of cuts (32 bits), the
    /// radius, cuts and half-widths, and the mean of each row of points (64 bits each), then for each node height and
    /// roll (64 bits each), a bit for each zone that carries (32 bits), and its rows minus their means (32 bits each);
    /// then the checksum FNV-1a of all bytes before (64 bits).
    void write(std::ostream& stream) const;

    const Grid& grid() const { return grid_; }
    double largest_shift() const { return grid_.shifts.back(); }  ///< [m]
    double largest_yaw() const { return grid_.yaws.back(); }      ///< [rad]
    double shear_modulus() const { return material_.shear_modulus; }
    double poisson_ratio() const { return material_.poisson_ratio; }
    const Side& side(WheelsetSide of) const { return sides_[index_of(of)].given; }
    bool is_mirrored() const {
        return sides_.size() == 1;
    }  ///< Whether the left wheel is the right one's mirror image.

    bool covers(double lateral, double yaw) const {
        return std::abs(lateral) <= largest_shift() * (1 + 1e-12) && std::abs(yaw) <= largest_yaw() * (1 + 1e-12);
    }

    /// Height and roll at which both wheels carry their loads, left and right, by normal forces. Loads must be
    /// positive. The position must be covered.
    OnRails on_rails(double lateral, double yaw, const std::array<double, 2>& loads) const noexcept;
    /// Height and roll under equal loads, the middle load of the table.
    OnRails on_rails(double lateral, double yaw) const noexcept {
        const double load = grid_.loads[grid_.loads.size() / 2];
        return on_rails(lateral, yaw, {load, load});
    }
    /// Load that a wheel carries by normal forces at a height of its own, z_ws + support_y roll (left: minus). Profiles
    /// are assumed to meet as they do under equal loads.
    Support support(WheelsetSide side, double lateral, double yaw, double height) const noexcept;

    /// The forces of one wheel. Lateral shift and yaw of `position` count. Vertical speed and roll rate are the
    /// vehicle's; for a vehicle that follows its rails they follow from on_rails(). Normal forces follow from the load,
    /// the sum of N cos delta - F_s sin delta, by Newton's method. Below 1e-100 N a wheel carries nothing; above 1e150
    /// N the status is invalid_load. Does not allocate.
    template <std::same_as<double> Scalar = double>  // for rollbem::compiled
    WheelForces look_up(const CreepForceTable& creep, WheelsetSide side, const WheelsetPosition& position,
                        const WheelsetSpeeds& speeds, const WheelLoad& load,
                        const WheelFriction& friction) const noexcept;
    /// Forces without tangents (the matrix is zero), in less time.
    template <std::same_as<double> Scalar = double>
    WheelForces forces(const CreepForceTable& creep, WheelsetSide side, const WheelsetPosition& position,
                       const WheelsetSpeeds& speeds, const WheelLoad& load,
                       const WheelFriction& friction) const noexcept;

private:
    template <std::same_as<double> Real>
    friend class detail::WheelLookUp;

    static constexpr const char* name = "ContactTable";
    static constexpr const char* magic = "rollbem contact geometry";
    static constexpr std::uint32_t version = 2;

    /// Number of rows in whole packets of four numbers.
    static constexpr int packed_rows = (static_cast<int>(ContactRow::rows) + 3) / 4 * 4;
    /// Numbers in the form used by look-ups: rows of points over their means in single precision, which halves the
    /// memory that a look-up touches, filled in where zones carry nothing; and slopes by the shift.
    struct Stored {
        Side given;
        ContactRow::Values means;
        Eigen::Array<float, packed_rows, Eigen::Dynamic> points, slopes;
        Eigen::ArrayXXd on_rails_slopes;
        /// Whether a zone carries a load at any node on either side of an interval between shifts: all intervals of a
        /// zone, then the next zone.
        std::vector<char> carrying;

        bool carries(Eigen::Index zone, std::size_t interval) const {
            return carrying[std::size_t(zone) * (carrying.size() / std::size_t(given.zones.count())) + interval] != 0;
        }
    };
    std::size_t index_of(WheelsetSide side) const { return is_mirrored() ? 0 : std::size_t(side); }
    template <std::same_as<double> Real = double>
    Stored stored(Side side) const;

    /// A place on the grid, without the load.
    struct Cell {
        std::size_t shift;
        detail::HermiteWeights along;
        detail::RowWeights<most_yaws> across;
    };
    Cell cell(double lateral, double yaw) const noexcept {
        const std::size_t i = detail::interval_of(grid_.shifts, lateral);
        return {i, {lateral, grid_.shifts[i], grid_.shifts[i + 1]}, detail::even_weights<most_yaws>(grid_.yaws, yaw)};
    }
    template <int Rows>
    struct Sample {
        Eigen::Array<double, Rows, 1, Eigen::DontAlign> value, by_shift, by_yaw;
    };
    /// Rows of a field with slopes, at the nodes of one load, which begin at `first`.
    template <int Rows, class Field>
    Sample<Rows> sample(const Cell& at, const Field& values, const Field& slopes, Eigen::Index row,
                        Eigen::Index first) const noexcept;
    /// Number of rows in whole packets that have derivatives; places on the profiles follow without.
    static constexpr int differentiated_rows = packed_rows - 4;
    static_assert(ContactRow::peak <= differentiated_rows && ContactRow::rail_y >= differentiated_rows);
    /// Rows of a point over their means, at the place, under one load of the table.
    struct LoadedRows {
        Eigen::Array<double, packed_rows, 1> value;
        Eigen::Array<double, differentiated_rows, 1> by_shift, by_yaw;
    };
    /// Without `derivatives`, the derivatives in `found` are left unchanged.
    template <bool derivatives>
    void sample_rows(const Cell& at, const Stored& side, Eigen::Index zone, std::size_t load,
                     LoadedRows& found) const noexcept;
    Eigen::Index first_node(std::size_t load) const { return grid_.node(load, 0, 0); }

    /// Height of a wheel and roll at a load, with derivatives by shift, yaw and load.
    struct WheelOnRails {
        std::array<double, 4> height, roll;
    };
    WheelOnRails wheel_on_rails(const Stored& side, double lateral, double yaw, double load) const noexcept;

    Grid grid_;
    Material material_;
    std::vector<double> roots_;  ///< cube roots of the loads
    std::vector<Stored> sides_;
};

inline ContactTable::ContactTable(Grid grid, Material material, std::vector<Side> sides)
    : grid_(std::move(grid)), material_(material) {
    const auto require_nodes = [](const char* what, const std::vector<double>& nodes, std::size_t least,
                                  std::size_t most) {
        const std::string rule = "be " + std::to_string(least) + " to " + std::to_string(most);
        detail::require(nodes.size() >= least && nodes.size() <= most, name, what, nodes.size(), rule.c_str());
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            detail::require(detail::is_finite(nodes[k]) && (k == 0 || nodes[k] > nodes[k - 1]), name, what, nodes[k],
                            "ascend");
        }
    };
    require_nodes("number of shifts", grid_.shifts, 5, 10001);
    require_nodes("number of yaws", grid_.yaws, 2, most_yaws);
    require_nodes("number of loads", grid_.loads, 1, most_loads);
    for (std::size_t i = 0; i < grid_.shifts.size(); ++i) {
        const double opposite = -grid_.shifts[grid_.shifts.size() - 1 - i];
        detail::require(std::abs(grid_.shifts[i] - opposite) <= 1e-12, name, "shift", grid_.shifts[i],
                        "have its opposite among the shifts");
    }
    detail::require(grid_.yaws[0] == 0, name, "first yaw", grid_.yaws[0], "be 0");
    detail::require_positive(name, "first load", grid_.loads[0]);
    detail::require_positive(name, "shear_modulus", material_.shear_modulus);
    detail::require_poisson_ratio(name, material_.poisson_ratio);
    detail::require(sides.size() == 1 || sides.size() == 2, name, "number of sides", sides.size(), "be 1 or 2");
    for (const double load : grid_.loads) roots_.push_back(std::cbrt(load));
    for (Side& side : sides) {
        detail::require_positive(name, "radius", side.radius);
        detail::require(side.on_rails.rows() == 2 && side.on_rails.cols() == grid_.nodes(), name, "number of heights",
                        side.on_rails.cols(), "be the number of the grid's nodes");
        detail::require(
            side.points.rows() == ContactRow::rows && side.points.cols() == grid_.nodes() * side.zones.count(), name,
            "number of points", side.points.cols(), "be the number of the grid's nodes times the number of zones");
        detail::require(side.on_rails.isFinite().all() && side.points.isFinite().all(), name, "values", "not finite",
                        "be finite");
        sides_.push_back(stored(std::move(side)));
    }
}

namespace detail {

/// Where a zone carries nothing, its rows except the share are copied from the nearest node on its line that carries;
/// lines without such a node are copied from the nearest line. `points` are the nodes of one zone.
template <std::same_as<double> Real = double>
void fill_zone(const ContactTable::Grid& grid, Eigen::Ref<Eigen::ArrayXXd> points) {
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

/// Slopes by the shift of each row of each line; the slopes of row 0, the share, are limited where `limit` is set.
template <std::same_as<double> Real = double>
Eigen::ArrayXXd slopes_of(const ContactTable::Grid& grid, const Eigen::ArrayXXd& values, bool limit) {
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
        if (limit) slopes(0, node) = limited(slopes(0, node), before[0], after[0]);
    }
    return slopes;
}

}  // namespace detail

template <std::same_as<double> Real>
auto ContactTable::stored(Side side) const -> Stored {
    Stored made{.given = {},
                .means = ContactRow::Values::Zero(),
                .points = {},
                .slopes = {},
                .on_rails_slopes = {},
                .carrying = {}};
    for (Eigen::Index zone = 0; zone < side.zones.count(); ++zone) {
        detail::fill_zone(grid_, side.points.middleCols(zone * grid_.nodes(), grid_.nodes()));
    }
    made.means = side.points.rowwise().mean();
    made.means[ContactRow::share] = 0;
    made.points.setZero(packed_rows, side.points.cols());
    made.slopes = made.points;
    made.points.topRows<ContactRow::rows>() = (side.points.colwise() - Eigen::ArrayXd(made.means)).cast<float>();
    side.points = made.points.topRows<ContactRow::rows>().cast<double>().colwise() + Eigen::ArrayXd(made.means);
    made.slopes.topRows<ContactRow::rows>() = detail::slopes_of(grid_, side.points, true).cast<float>();
    made.on_rails_slopes = detail::slopes_of(grid_, side.on_rails, false);
    const auto shifts = Eigen::Index(grid_.shifts.size()), lines = grid_.nodes() / shifts;
    for (Eigen::Index zone = 0; zone < side.zones.count(); ++zone) {
        const Eigen::Map<const Eigen::ArrayXXf, 0, Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>> shares(
            made.points.col(zone * grid_.nodes()).data() + ContactRow::share, shifts, lines,
            {shifts * packed_rows, Eigen::Index(packed_rows)});
        for (Eigen::Index i = 0; i + 1 < shifts; ++i) {
            made.carrying.push_back((shares.middleRows(i, 2) > 0).any() ? 1 : 0);
        }
    }
    made.given = std::move(side);
    return made;
}

template <int Rows, class Field>
auto ContactTable::sample(const Cell& at, const Field& values, const Field& slopes, Eigen::Index row,
                          Eigen::Index first) const noexcept -> Sample<Rows> {
    using Values = Eigen::Array<double, Rows, 1, Eigen::DontAlign>;
    Sample<Rows> found{Values::Zero(), Values::Zero(), Values::Zero()};
    const auto& [w, rate] = at.along;
    for (std::size_t k = 0; k < grid_.yaws.size(); ++k) {
        const Eigen::Index node = first + Eigen::Index(k * grid_.shifts.size() + at.shift);
        const double across = at.across.value[k], turning = at.across.rate[k];
        for (Eigen::Index i = 0; i < Rows; ++i) {
            const double one = double(values(row + i, node)), rise = double(values(row + i, node + 1)) - one,
                         three = double(slopes(row + i, node)), four = double(slopes(row + i, node + 1));
            const double here = one + w[1] * rise + w[2] * three + w[3] * four;  // the first two weights add up to 1
            found.value[i] += across * here;
            found.by_yaw[i] += turning * here;
            found.by_shift[i] += across * (rate[1] * rise + rate[2] * three + rate[3] * four);
        }
    }
    return found;
}

template <bool derivatives>
void ContactTable::sample_rows(const Cell& at, const Stored& side, Eigen::Index zone, std::size_t load,
                               LoadedRows& found) const noexcept {
    using Four = Eigen::Map<const Eigen::Array4f, Eigen::Aligned16>;
    const double w1 = at.along.value[1], w2 = at.along.value[2], w3 = at.along.value[3];
    for (std::size_t k = 0; k < grid_.yaws.size(); ++k) {
        const Eigen::Index node = zone * grid_.nodes() + grid_.node(load, k, at.shift);
        const float *points = side.points.col(node).data(), *slopes = side.slopes.col(node).data();
        const double across = at.across.value[k], turning = at.across.rate[k], r1 = across * at.along.rate[1],
                     r2 = across * at.along.rate[2], r3 = across * at.along.rate[3];
        const bool is_first = k == 0;
        const auto add = [is_first](auto to, const Eigen::Array4d& more) { is_first ? to = more : to += more; };
        for (int i = 0; i < packed_rows; i += 4) {
            const Eigen::Array4d one = detail::widened(Four(points + i)),
                                 rise = detail::widened(Four(points + packed_rows + i) - Four(points + i)),
                                 low = detail::widened(Four(slopes + i)),
                                 high = detail::widened(Four(slopes + packed_rows + i));
            // the first two weights add up to 1
            const Eigen::Array4d here = one + w1 * rise + w2 * low + w3 * high;
            add(found.value.template segment<4>(i), across * here);
            if constexpr (!derivatives) continue;
            if (i >= differentiated_rows) continue;
            add(found.by_shift.template segment<4>(i), r1 * rise + r2 * low + r3 * high);
            add(found.by_yaw.template segment<4>(i), turning * here);
        }
    }
}

inline auto ContactTable::wheel_on_rails(const Stored& side, double lateral, double yaw, double load) const noexcept
    -> WheelOnRails {
    const double root = std::cbrt(load);
    const auto weights = detail::hermite_weights<most_loads>(roots_, root);
    const Cell at = cell(lateral, yaw);
    WheelOnRails found{};
    for (std::size_t l = weights.first; l < weights.last; ++l) {
        const Sample<2> own = sample<2>(at, side.given.on_rails, side.on_rails_slopes, 0, first_node(l));
        for (auto [of, row] : {std::pair(&found.height, 0), {&found.roll, 1}}) {
            (*of)[0] += weights.value[l] * own.value[row];
            (*of)[1] += weights.value[l] * own.by_shift[row];
            (*of)[2] += weights.value[l] * own.by_yaw[row];
            (*of)[3] += weights.rate[l] * own.value[row] / (3 * root * root);
        }
    }
    return found;
}

inline auto ContactTable::on_rails(double lateral, double yaw, const std::array<double, 2>& loads) const noexcept
    -> OnRails {
    // heights of both wheels at the roll of unequal loads: profiles meet the rails as at another shift
    struct Wheel {
        double height, by_lateral, by_yaw, by_load, by_roll;
    };
    const auto wheel = [&](WheelsetSide side, double roll) -> Wheel {
        const double mirror = side == WheelsetSide::left ? -1 : 1, load = loads[std::size_t(side)];
        const Stored& own = sides_[index_of(side)];
        const double u = mirror * lateral, psi = mirror * yaw, radius = own.given.radius;
        const auto table = wheel_on_rails(own, u, psi, load).roll;
        const double limit = largest_shift();
        const double moved = std::clamp(u - radius * (mirror * roll - table[0]), -limit, limit);
        const auto height = wheel_on_rails(own, moved, psi, load).height;
        return {height[0], mirror * height[1] * (1 + radius * table[1]),
                mirror * (height[2] + height[1] * radius * table[2]), height[3] + height[1] * radius * table[3],
                -mirror * radius * height[1]};
    };
    double roll = wheel_on_rails(sides_[index_of(WheelsetSide::right)], lateral, yaw, loads[1]).roll[0];
    OnRails found;
    for (int round = 0; round < 4; ++round) {
        const Wheel left = wheel(WheelsetSide::left, roll), right = wheel(WheelsetSide::right, roll);
        const double slope = 2 * support_y - (right.by_roll - left.by_roll);
        const double excess = 2 * support_y * roll - (right.height - left.height);
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

inline auto ContactTable::support(WheelsetSide side, double lateral, double yaw, double height) const noexcept
    -> Support {
    const double mirror = side == WheelsetSide::left ? -1 : 1;
    const Stored& own = sides_[index_of(side)];
    if (!detail::is_finite(lateral) || !detail::is_finite(yaw) || !detail::is_finite(height)) return {};
    if (!covers(lateral, yaw) || grid_.loads.size() < 2) return {.status = Status::wrong_table};
    const auto at = [&](double load) { return wheel_on_rails(own, mirror * lateral, mirror * yaw, load).height; };
    const auto result = [&](double load, double by_load, double by_lateral, double by_yaw) -> Support {
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

inline void ContactTable::write(std::ostream& stream) const {
    detail::CheckedWriter writer(stream, magic);
    for (const std::size_t count :
         {std::size_t(version), grid_.shifts.size(), grid_.yaws.size(), grid_.loads.size(), sides_.size()}) {
        writer.integer(static_cast<std::uint32_t>(count));
    }
    for (const auto* nodes : {&grid_.shifts, &grid_.yaws, &grid_.loads}) {
        for (const double node : *nodes) writer.number(node);
    }
    writer.number(material_.shear_modulus);
    writer.number(material_.poisson_ratio);
    for (const Stored& side : sides_) {
        const Side& given = side.given;
        writer.integer(static_cast<std::uint32_t>(given.zones.cuts().size()));
        writer.number(given.radius);
        for (const ContactZones::Cut& cut : given.zones.cuts()) {
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
                for (const float value : side.points.col(zone * grid_.nodes() + node).head<ContactRow::rows>()) {
                    writer.number(value);
                }
            }
        }
    }
    writer.finish();
}

inline ContactTable ContactTable::read(std::istream& stream) {
    detail::CheckedReader reader(stream, name, magic);
    const auto found = reader.integer<std::uint32_t>();
    detail::require(found == version, name, "version", found, "be 2: make the table again with contact_table");
    std::array<std::size_t, 4> counts;
    for (auto [count, most] : {std::pair(&counts[0], 10001U),
                               {&counts[1], unsigned(most_yaws)},
                               {&counts[2], unsigned(most_loads)},
                               {&counts[3], 2U}}) {
        *count = reader.integer<std::uint32_t>();
        detail::require(*count >= 1 && *count <= most, name, "number of nodes", *count,
                        "be at least 1 and at most the largest number of a table");
    }
    Grid grid{std::vector<double>(counts[0]), std::vector<double>(counts[1]), std::vector<double>(counts[2])};
    for (auto* nodes : {&grid.shifts, &grid.yaws, &grid.loads}) {
        for (double& node : *nodes) node = reader.number();
    }
    detail::require(grid.nodes() <= 200000, name, "number of nodes", grid.nodes(), "be at most 200000");
    const double G = reader.number(), nu = reader.number();
    std::vector<Side> sides(counts[3]);
    for (Side& side : sides) {
        const auto cut_count = reader.integer<std::uint32_t>();
        detail::require(cut_count < ContactZones::most, name, "number of cuts", cut_count, "be at most 3");
        std::vector<ContactZones::Cut> cuts(cut_count);
        side.radius = reader.number();
        for (ContactZones::Cut& cut : cuts) {
            cut.y = reader.number();
            cut.half_width = reader.number();
        }
        side.zones = ContactZones(std::move(cuts));
        ContactRow::Values means;
        for (double& mean : means) mean = reader.number();
        side.on_rails.resize(2, grid.nodes());
        side.points.setZero(ContactRow::rows, grid.nodes() * side.zones.count());
        for (Eigen::Index node = 0; node < grid.nodes(); ++node) {
            for (Eigen::Index row = 0; row < 2; ++row) side.on_rails(row, node) = reader.number();
            const auto carrying = reader.integer<std::uint32_t>();
            for (Eigen::Index zone = 0; zone < side.zones.count(); ++zone) {
                if ((carrying >> unsigned(zone) & 1U) == 0) continue;
                for (Eigen::Index row = 0; row < ContactRow::rows; ++row) {
                    side.points(row, zone * grid.nodes() + node) = means[row] + double(reader.single());
                }
            }
        }
    }
    reader.finish();
    return {std::move(grid), {G, nu}, std::move(sides)};
}

}  // namespace rollbem
