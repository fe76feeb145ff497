// Friction forces of a wheelset on real profiles: of a wheel's patches, with friction that varies over the rail or with
// temperature, and of all wheels of a wheelset.
#pragma once

#include "../detail/decl.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "../elasticity/subsurface_stress.hpp"
#include "../scene/creepage.hpp"
#include "../scene/wheelset.hpp"
#include "../status.hpp"
#include "wheelset_on_track.hpp"

namespace rollbem {

/// Friction parameters for steady rolling.
struct RollingFriction {
    /// Thermal properties of both bodies, of one material. Each body takes half the heat of friction. Defaults are
    /// steel's.
    struct Heating {
        /// Friction that falls with the temperature.
        struct Friction {
            double coefficient;  ///< mu at and above `end` [-]
            double begin, end;   ///< temperatures above ambient between which mu falls or rises linearly [K]

            double at(double cold, double temperature) const {
                return cold + (coefficient - cold) * std::clamp((temperature - begin) / (end - begin), 0.0, 1.0);
            }
        };

        double conductivity = 50;       ///< k [W/(m K)]
        double heat_capacity = 3.53e6;  ///< rho c, per volume [J/(m^3 K)]
        std::optional<Friction> friction{};

        double diffusivity() const { return conductivity / heat_capacity; }  ///< kappa [m^2/s]
        /// Whether heat stays below the point where it enters: V a is at least 10 kappa.
        bool passes_fast(double speed, double half_length) const { return speed * half_length >= 10 * diffusivity(); }
    };

    /// The coefficient of friction over the angle of the rail's surface or over its y, linear between the nodes and
    /// constant beyond them.
    ///
    /// \code
    /// #include <rollbem/vehicle.hpp>
    ///
    /// int main() {
    ///     using namespace rollbem;
    ///     using OnRail = RollingFriction::OnRail;
    ///     const OnRail greased(OnRail::Over::angle, {-0.6, -0.2}, {0.15, 0.35});  // gauge face, top
    ///     return std::abs(greased.at(-0.4, 0) - 0.25) < 1e-12 ? 0 : 1;
    /// }
    /// \endcode
    class OnRail {
    public:
        /// Coordinate of the nodes: delta of the surface [rad], or y of the rail's profile [m], both as on the right
        /// rail.
        enum class Over { angle, y };

        /// Throws std::invalid_argument unless there is a node, nodes ascend, angles lie within a quarter turn and y
        /// within +-1 m, and coefficients are finite and not negative.
        OnRail(Over over, std::vector<double> nodes, std::vector<double> coefficients);

        /// mu [-] where the surface has the angle [rad] and lies at y [m].
        double at(double angle, double y) const;

    private:
        Over over_;
        std::vector<double> nodes_, coefficients_;
    };

    double coefficient = 0.3;   ///< mu [-]
    Eigen::Index elements = 0;  ///< number in each strip along x; 0: by elements_for
    Eigen::Index strips = 0;    ///< number of a patch's strips; 0: by elements_for; fewer where the scheme would gain
                                ///< energy on these
    /// Whether slip is the slip of the curved surfaces (curved_slip_of), or follows from three creepages, as in
    /// CONTACT's planes.
    bool curved_slip = false;
    std::optional<OnRail> rail{};      ///< mu over the rail, in place of the coefficient, one for each strip
    std::optional<Heating> heating{};  ///< data for the temperature, and for friction that depends on it
    double layer = 0;  ///< compliance L of a layer between both bodies, which adds L p to the displacement [m/Pa]
};

/// Temperatures above ambient [K] at the places `at` [m] of a strip of the contact, which material enters at the
/// leading edge: sqrt(kappa/(pi V))/k times the integral of q/2 (x') / sqrt(x' - x) over all x' ahead, exact for heat
/// per area q [W/m^2] that is uniform in each element. `edges` ascend from the trailing to the leading edge [m], one
/// more than `heat`; V [m/s] must be positive. Heat flows straight down, as in a half-space that passes fast (Carslaw
/// and Jaeger 1959; RollingFriction::Heating::passes_fast).
Eigen::ArrayXd flash_temperature(const Eigen::ArrayXd& edges, const Eigen::ArrayXd& heat, const Eigen::ArrayXd& at,
                                 double speed, const RollingFriction::Heating& heating);

/// Friction on one patch of a right wheel, in the axes (x, s, n) of its plane. Numbers without a result are NaN and
/// arrays empty; a patch that does not roll has neither force nor work.
struct PatchForce {
    Creepage creepage{};      ///< wheel minus rail, see creepage_of
    TangentialForce force{};  ///< force on the wheel [N], moment about n [N m], at creepage_place
    double slip_work = std::numeric_limits<double>::quiet_NaN();  ///< heat per distance rolled [J/m]
    Eigen::ArrayXd edges{}, strip_work{};  ///< edges of the strips along s [m]; each strip's part of slip_work [J/m]
    Eigen::Index elements = 0;
    /// Elements of all patches of its plane, with the loads of the rail, in (x, s): tractions opposite to the wheel's.
    std::vector<Yield::LoadedRectangle> surface{};
    /// Elements of this patch, strip by strip from the trailing edge on: the number of the first one in `surface`,
    /// slip over the rolling velocity [-], and each one's part of slip_work [J/m].
    std::size_t first_element = 0;
    Eigen::ArrayXd slip{}, work{};
    /// The largest temperature above ambient [K], where heating is asked for. NaN where the contact passes so slowly
    /// that heat flows along it (RollingFriction::Heating::passes_fast), and above 20 % of creepage, where one body
    /// passes slower.
    double peak_temperature = std::numeric_limits<double>::quiet_NaN();
    /// Status of friction. With friction that depends on the temperature also not_converged: friction and temperature
    /// did not come to agree, or the temperature is not known.
    Status status = Status::not_finite;
};

struct WheelsetForces {
    /// A force [N] and its moment [N m] in track axes (x, y, z).
    struct Wrench {
        std::array<double, 3> force{}, moment{};

        /// Wrench of a force that acts at the end of an arm [m].
        static Wrench at(const std::array<double, 3>& arm, const std::array<double, 3>& force);
        Wrench& operator+=(const Wrench& other);
    };

    WheelsetOnTrack::Contacts contacts;
    double pitch_rate =
        std::numeric_limits<double>::quiet_NaN();    ///< [rad/s]; NaN if no wheel touches, or none has the force
    std::array<std::vector<PatchForce>, 2> patches;  ///< friction of the patches, in the order of the contacts
    /// Wrenches of the rails on each wheel and on both, in track axes; moments are about the middle of the axle. Zero
    /// where there is no contact; NaN if friction has no result.
    std::array<Wrench, 2> on_wheel;
    Wrench on_wheelset;
    int rounds = 0;  ///< number of rounds of contacts and friction in turn

    /// The status of the contacts or, if these are ok, of the first patch that is not.
    Status status() const;
    /// Heat per distance rolled on all patches [J/m], T gamma up to the errors of the discretisation; NaN if one has no
    /// result.
    double slip_work() const;
    /// The largest pressure on both wheels [Pa]; 0 without contact.
    double peak_pressure() const;
};

/// Steady rolling of the patches of a wheel, each on its own outline, under its own pressures, with the slip of both
/// surfaces; backwards as the mirror image of rolling forward. Patches in one plane displace each other and are solved
/// together. A patch that does not roll, V = 0, has the status invalid_step, no creepage and no force. The patches must
/// have numbers; position and speeds are as the right wheel sees them. Throws std::invalid_argument unless mu and the
/// compliance of the layer are finite and not negative, and numbers of heating can be meant.
std::vector<PatchForce> patch_forces(const std::vector<RailPatch>& patches, const WheelsetPosition& at,
                                     const WheelsetSpeeds& speeds, const WheelOnRail::Dimensions& dimensions,
                                     const RollingFriction& friction);
/// The same for each of several motions, in their order; elements of a plane are assembled once for motions forward.
std::vector<std::vector<PatchForce>> patch_forces(const std::vector<RailPatch>& patches, const WheelsetPosition& at,
                                                  const std::vector<WheelsetSpeeds>& motions,
                                                  const WheelOnRail::Dimensions& dimensions,
                                                  const RollingFriction& friction);
inline PatchForce patch_force(const RailPatch& patch, const WheelsetPosition& at, const WheelsetSpeeds& speeds,
                              const WheelOnRail::Dimensions& dimensions, const RollingFriction& friction) {
    return patch_forces({patch}, at, speeds, dimensions, friction)[0];
}

/// Wrench of a patch's pressures on its wheel, as on the right; the moment is about (0, y, z). Pressures act along the
/// normals of the rail's surface in each row of cells: where a wheel rolls steadily, they do no work. Along the plane's
/// normal they would do work on the slip across it.
WheelsetForces::Wrench pressure_wrench_of(const RailPatch& patch, double y, double z);

/// Wrench of a patch's pressures and friction on its wheel, as on the right; the moment is about (0, y, z). In steady
/// rolling its power equals the power of the creep forces on the creepages.
WheelsetForces::Wrench wrench_of(const RailPatch& patch, const PatchForce& friction, double y, double z);

/// Motion and loads of a wheelset.
struct WheelsetRolling {
    WheelsetPosition position;
    std::array<double, 2> loads{1e5, 1e5};  ///< vertical, left and right [N]
    WheelsetOnTrack::Free free = WheelsetOnTrack::Free::height_and_roll;
    WheelsetSpeeds speeds{};
    /// Whether the pitch rate is found instead of taken from the speeds: the longitudinal creepages of both wheels'
    /// largest patches add up to zero, or, if only one wheel touches, its creepage is zero. A torque is left over.
    bool free_pitch = true;
    /// The longitudinal force of friction on the wheelset [N], along x, in place of a pitch rate; about 0 for a
    /// wheelset without a drive. It takes several solutions of friction.
    std::optional<double> force{};
    /// Whether friction's vertical share, which is large on a flange, counts in the loads; otherwise normal forces
    /// alone carry them.
    bool loads_include_friction = true;
};

/// The forces of a rolling wheelset. Loads are vertical, carried by normal forces and friction together: contacts and
/// friction are found in turn until they carry the loads to 1e-6. With loads_include_friction = false contacts carry
/// the loads without friction. Allocates. Statuses name the failure, `contacts.status` and those of the patches:
///
/// - `unbalanced`: the wheel does not carry its load after 40 rounds;
/// - `load_not_reached`: friction holds the wheel up;
/// - `unbalanced`, with the forces of the pressures alone: the wheel does not roll (patch_force);
/// - `unbalanced`: the longitudinal force lies in a jump, where the grids of the contacts change;
/// - `no_solution` of patches: no creepage of up to 20 % gives the longitudinal force.
WheelsetForces rolling_forces(const WheelsetOnTrack& wheelset, const WheelsetRolling& rolling,
                              const RollingFriction& friction, WheelsetOnTrack::Workspace& workspace,
                              const WheelOnRail::Options& options = {});

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/wheelset_forces.ipp"
#endif
