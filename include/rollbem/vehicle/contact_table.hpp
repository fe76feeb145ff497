// ContactTable: the contacts of a wheelset on real rails, over lateral shift, yaw and load, as a table; and with a
// table of creep forces, all contact forces of a wheel by look-up, with tangents.
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../scene/creepage.hpp"
#include "../scene/patch_contact.hpp"
#include "../scene/wheelset.hpp"
#include "../status.hpp"
#include "creep_force_table.hpp"
#include "detail/contact_row.hpp"

namespace rollbem {

struct WheelForces;

namespace detail {
class WheelLookUp;
}

/// Geometry of contact by look-up. The rail is divided into zones. For each zone the table has the place, mean normal,
/// rolling radius and load share of the pressures in it, and an ellipse for their creep forces. A left wheel that is
/// the mirror image of the right wheel has no numbers of its own.
///
/// \code
/// #include <rollbem/vehicle.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const auto table = ContactTable::read("share/rollbem/s1002_60e1.contact");
///     const auto creep = CreepForceTable::read("share/rollbem/steel.creep");
///     // each step: 2 mm to the right at 20 m/s, 80 kN, mu = 0.3
///     const WheelForces now = table.look_up(creep, WheelsetSide::right, {.lateral = 2e-3},
///                                           {.forward = 20, .pitch_rate = -20 / 0.46}, 80e3, 0.3);
///     return now.status == Status::ok && now.force[2] < 0 ? 0 : 1;  // the rail carries
/// }
/// \endcode
///
/// Values are interpolated by local cubics along the shift and the cube root of the load, and by polynomials in yaw^2
/// along the yaw: on straight rails the contact at -yaw is the mirror image, across the track, of the contact at yaw.
/// All are C1, shares of the load do not overshoot, and semi-axes stay positive. Zones have integrals of the pressures,
/// so that forces stay continuous where patches merge, part or vanish. Beyond its loads the table keeps the geometry of
/// its border, and ellipses grow with N^(1/3). Immutable: threads may share it.
class ContactTable {
public:
    /// Zones along the lateral place y [m] in track axes, as on the right rail, from the smallest y (the flange's side)
    /// to the largest. A quantity of a zone is an integral over the wheel's pressures times the zone's weight, so that
    /// it changes continuously when patches merge, part, appear or vanish.
    ///
    /// Invariant: at most four zones; half-widths are positive, and cuts ascend and do not overlap.
    class Zones {
    public:
        static constexpr Eigen::Index most = 4;

        /// The transition between two zones, from y - half_width to y + half_width.
        struct Cut {
            double y, half_width;  ///< [m]
        };

        /// One zone.
        Zones() = default;
        /// Throws std::invalid_argument if the cuts break the invariant.
        explicit Zones(std::vector<Cut> cuts);

        Eigen::Index count() const { return static_cast<Eigen::Index>(cuts_.size()) + 1; }
        const std::vector<Cut>& cuts() const { return cuts_; }

        /// The share of a zone in a quantity at y, 0 to 1; twice continuously differentiable.
        double weight(Eigen::Index zone, double y) const;

    private:
        double low(std::size_t k) const { return cuts_[k].y - cuts_[k].half_width; }
        double high(std::size_t k) const { return cuts_[k].y + cuts_[k].half_width; }
        static double beyond(const Cut& cut, double y);

        std::vector<Cut> cuts_;
    };

    /// The load of a wheel.
    struct Load {
        double vertical;  ///< Q [N], carried by normal forces and friction
        /// Roll of the wheelset [rad], from ContactTable::on_rails. Empty: each wheel takes the roll of equal loads.
        std::optional<double> roll{};

        Load(double Q, std::optional<double> rolled = {}) : vertical(Q), roll(rolled) {}  // NOLINT: a number is a load
    };

    /// Friction of one wheel.
    struct Friction {
        double coefficient = 0.3;                            ///< mu [-]
        std::array<double, Zones::most> factor{1, 1, 1, 1};  ///< factor of mu in each zone [-]
        const ReducedFriction* reduced = nullptr;            ///< reduced friction of wet or dirty rails, if any

        Friction(double mu = 0.3) : coefficient(mu) {}  // NOLINT: a number is friction
    };

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
        Zones zones{};
        /// Height of the wheel, z_ws + half_base roll [m], and roll of the wheelset [rad], under equal loads: 2 x
        /// nodes.
        Eigen::ArrayXXd on_rails{};
        /// ContactRow, for each zone all nodes; where a zone carries nothing, its share is 0 and its other rows are not
        /// used.
        Eigen::ArrayXXd points{};
    };
    struct Material {
        double shear_modulus, poisson_ratio;
    };
    /// How far wheels by the table were from wheels by their patches, at random places between its nodes, under loads
    /// of a range: differences of F_x and of F_y over mu Q.
    struct Errors {
        double least_load, most_load;                ///< [N]
        double wheels;                               ///< their number
        std::array<double, 2> mean{}, most_of_95{};  ///< in the mean; 95 % are below
        std::array<double, 2> largest{};
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
    static constexpr double half_base = 0.75;

    /// `sides` are left and right, or one side for both. Throws std::invalid_argument if the grid breaks its invariant,
    /// numbers of nodes differ, a value is not finite, or one of ContactRow::positive is not.
    ContactTable(Grid grid, Material material, std::vector<Side> sides);

    /// The same table, which says its errors.
    ContactTable with_errors(std::vector<Errors> errors) const {
        ContactTable table = *this;
        table.errors_ = std::move(errors);
        return table;
    }

    /// Reads the format of write(); throws as CreepForceTable::read does.
    static ContactTable read(std::istream& stream);
    static ContactTable read(const std::filesystem::path& path);

    /// Little-endian, version 3: the text "rollbem contact geometry"; version, numbers of shifts, yaws, loads and sides
    /// (32 bits each); shifts, yaws, loads, G, nu (64 bits each); the number of Errors (32 bits), and for each its
    /// loads, number of wheels, mean, 95 % and largest of F_x, then of F_y (64 bits each); for each side the number of
    /// cuts (32 bits), the radius, cuts and half-widths, and the mean of each row of points (64 bits each), then for
    /// each node height and roll (64 bits each), a bit for each zone that carries (32 bits), and its rows minus their
    /// means (32 bits each); then the checksum FNV-1a of all bytes before (64 bits). Files of version 2, without plane,
    /// bend and errors, are read, too.
    void write(std::ostream& stream) const;

    const Grid& grid() const { return grid_; }
    /// Of contact_table's random wheels, by rising loads; none of tables of version 2 or made by other programs.
    const std::vector<Errors>& errors() const { return errors_; }
    double largest_shift() const { return grid_.shifts.back(); }  ///< [m]
    double largest_yaw() const { return grid_.yaws.back(); }      ///< [rad]
    double shear_modulus() const { return material_.shear_modulus; }
    double poisson_ratio() const { return material_.poisson_ratio; }
    const Side& side(WheelsetSide of) const { return sides_[index_of(of)].given; }
    /// Whether the left wheel is the right one's mirror image.
    bool is_mirrored() const { return sides_.size() == 1; }

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
    /// Load that a wheel carries by normal forces at a height of its own, z_ws + half_base roll (left: minus). Profiles
    /// are assumed to meet as they do under equal loads.
    Support load_at_height(WheelsetSide side, double lateral, double yaw, double height) const noexcept;

    /// The forces of one wheel. Lateral shift and yaw of `position` count. Vertical speed and roll rate are the
    /// vehicle's; for a vehicle that follows its rails they follow from on_rails(). Normal forces follow from the load,
    /// the sum of N cos delta - F_s sin delta, by Newton's method. Below 1e-100 N a wheel carries nothing; above 1e150
    /// N the status is invalid_load. Does not allocate.
    WheelForces look_up(const CreepForceTable& creep, WheelsetSide side, const WheelsetPosition& position,
                        const WheelsetSpeeds& speeds, const Load& load, const Friction& friction) const noexcept;
    /// Forces without tangents (the matrix is zero), in less time.
    WheelForces forces(const CreepForceTable& creep, WheelsetSide side, const WheelsetPosition& position,
                       const WheelsetSpeeds& speeds, const Load& load, const Friction& friction) const noexcept;

private:
    friend class detail::WheelLookUp;
    struct Interpolation;  // internal

    /// Number of rows in whole packets of four numbers.
    static constexpr int packed_rows = static_cast<int>(ContactRow::rows);
    static_assert(packed_rows % 4 == 0);
    /// Numbers in the form used by look-ups: rows of points over their means in single precision, which halves the
    /// memory that a look-up touches, filled in where zones carry nothing; and slopes by the shift. Of positive rows
    /// they are the logarithms: cubics through the rows themselves fall below 0 where a zone begins to carry.
    struct Stored {
        Side given;
        ContactRow::Values means, interpolated_means;  ///< of the given points; of rows as they are interpolated
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

    Grid grid_;
    Material material_;
    std::vector<double> roots_;  ///< cube roots of the loads
    std::vector<Stored> sides_;
    std::vector<Errors> errors_;
};

/// Forces of the rail on one wheel.
struct WheelForces {
    /// Contact of a wheel in one zone of the rail, as on the right wheel.
    struct Point {
        double load_share = 0;        ///< share of the vertical load, without friction [-]; 0: no contact, no numbers
        std::array<double, 3> arm{};  ///< place of the point from the middle of the axle, in track axes [m]
        double angle = 0;             ///< angle delta of the pressures' mean normal, along which N acts [rad]
        double friction_angle = 0;    ///< angle of the plane in which the force acts: of the patches' planes [rad]
        double rolling_radius = 0;    ///< [m]
        double rail_y = 0, wheel_y = 0;      ///< y of the point in both profiles [m]
        double normal_load = 0;              ///< N [N]
        double peak_pressure = 0;            ///< largest pressure in the zone [Pa]
        PatchContact ellipse{{1, 1, 1, 0}};  ///< equivalent ellipse used for the creep forces
        Creepage creepage{};                 ///< wheel minus rail, as creepage_of
        TangentialForce force{};             ///< force on the wheel in the plane [N], moment [N m]
        double rolling_velocity = 0;         ///< V [m/s], below 0 where the wheel rolls backwards
        double heat = 0;                     ///< heat of friction [W]
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

    /// In track axes, also of a left wheel, F_x, F_y, F_z [N], and M_x, M_y, M_z [N m] about the middle of the axle. If
    /// the status is invalid_step, normal forces alone; otherwise NaN unless ok.
    Eigen::Matrix<double, 6, 1, Eigen::DontAlign> force =
        Eigen::Matrix<double, 6, 1, Eigen::DontAlign>::Constant(std::numeric_limits<double>::quiet_NaN());
    /// Derivatives of the force, a column for each Input in SI units; exact, to the digits of single precision, except
    /// at jumps of higher derivatives.
    Eigen::Matrix<double, 6, inputs, Eigen::DontAlign> tangent =
        Eigen::Matrix<double, 6, inputs, Eigen::DontAlign>::Zero();
    std::array<Point, ContactTable::Zones::most> points;
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

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/contact_table.ipp"
#endif
