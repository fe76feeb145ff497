// Friction on one patch of a wheel that rolls on a rail, and the wrench of the patch on its wheel.
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../elasticity/loaded_rectangle.hpp"
#include "../scene/force.hpp"
#include "../scene/mirror.hpp"
#include "../status.hpp"
#include "flash_temperature.hpp"
#include "rail_friction.hpp"
#include "wheelset_on_track.hpp"

namespace rollbem {

/// Friction parameters for steady rolling.
struct RollingFriction {
    double coefficient = 0.3;   ///< mu [-]
    Eigen::Index elements = 0;  ///< number in each strip along x; 0: by elements_for
    Eigen::Index strips = 0;    ///< number of a patch's strips; 0: by elements_for; fewer where the scheme would gain
                                ///< energy on these
    /// Whether slip is the slip of the curved surfaces (curved_slip_of), or follows from three creepages, as in
    /// CONTACT's planes.
    bool curved_slip = false;
    std::optional<RailFriction> rail{};  ///< mu over the rail, in place of the coefficient, one for each strip
    std::optional<Heating> heating{};    ///< data for the temperature, and for friction that depends on it
    double layer = 0;  ///< compliance L of a layer between both bodies, which adds L p to the displacement [m/Pa]
};

/// Friction on one patch of a right wheel, in the axes (x, s, n) of its plane. Numbers without a result are NaN and
/// arrays empty; a patch that does not roll has neither force nor work.
struct PatchForce {
    Creepage creepage{};      ///< wheel minus rail, see creepage_of
    TangentialForce force{};  ///< force on the wheel [N], moment about n [N m], at creepage_place
    double slip_work = std::numeric_limits<double>::quiet_NaN();  ///< heat per distance rolled [J/m]
    Eigen::ArrayXd edges{}, strip_work{};  ///< edges of the strips along s [m]; each strip's part of slip_work [J/m]
    Eigen::Index elements = 0;
    /// Elements of all patches of its plane, with the loads of the rail, in (x, s): tractions opposite to the wheel's.
    std::vector<LoadedRectangle> surface{};
    /// Elements of this patch, strip by strip from the trailing edge on: the number of the first one in `surface`,
    /// slip over the rolling velocity [-], and each one's part of slip_work [J/m].
    std::size_t first_element = 0;
    Eigen::ArrayXd slip{}, work{};
    /// The largest temperature above ambient [K], where heating is asked for. NaN where the contact passes so slowly
    /// that heat flows along it (Heating::passes_fast), and above 20 % of creepage, where one body passes slower.
    double peak_temperature = std::numeric_limits<double>::quiet_NaN();
    /// Status of friction. With friction that depends on the temperature also not_converged: friction and temperature
    /// did not come to agree, or the temperature is not known.
    Status status = Status::not_finite;
};

PatchForce mirrored(PatchForce friction, const Mirror& mirror);

/// A force [N] and its moment [N m] in track axes (x, y, z).
struct Wrench {
    std::array<double, 3> force{}, moment{};

    /// Wrench of a force that acts at the end of an arm [m].
    static Wrench at(const std::array<double, 3>& arm, const std::array<double, 3>& force);
    Wrench& operator+=(const Wrench& other);
};

Wrench mirrored(Wrench wrench, const Mirror& mirror);

/// Steady rolling of the patches of a wheel, each on its own outline, under its own pressures, with the slip of both
/// surfaces; backwards as the mirror image of rolling forward. Patches in one plane displace each other and are solved
/// together. A patch that does not roll, V = 0, has the status invalid_step, no creepage and no force. The patches must
/// have numbers; position and speeds are as the right wheel sees them. Throws std::invalid_argument unless mu and the
/// compliance of the layer are finite and not negative, and numbers of heating can be meant.
std::vector<PatchForce> patch_forces(const std::vector<RailPatch>& patches, const WheelsetPosition& at,
                                     const WheelsetSpeeds& speeds, const TrackDimensions& dimensions,
                                     const RollingFriction& friction);
inline PatchForce patch_force(const RailPatch& patch, const WheelsetPosition& at, const WheelsetSpeeds& speeds,
                              const TrackDimensions& dimensions, const RollingFriction& friction) {
    return patch_forces({patch}, at, speeds, dimensions, friction)[0];
}

/// Wrench of a patch's pressures on its wheel, as on the right; the moment is about (0, y, z). Pressures act along the
/// normals of the rail's surface in each row of cells: where a wheel rolls steadily, they do no work. Along the plane's
/// normal they would do work on the slip across it.
Wrench pressure_wrench_of(const RailPatch& patch, double y, double z);

/// Wrench of a patch's pressures and friction on its wheel, as on the right; the moment is about (0, y, z). In steady
/// rolling its power equals the power of the creep forces on the creepages.
Wrench wrench_of(const RailPatch& patch, const PatchForce& friction, double y, double z);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/patch_force.ipp"
#endif
