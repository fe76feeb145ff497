// Equivalent ellipse: with it, a table of creep forces approximates friction on a wheel's patches, or on their share in
// a zone of the rail. Internal.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "../../detail/require.hpp"
#include "../../scene/creepage.hpp"
#include "../creep_force_table.hpp"
#include "contact_row.hpp"
#include "creep_matrices.hpp"
#include "ellipse_creepages.hpp"

namespace rollbem {

/// Equivalent ellipse used for the creep forces of a patch.
struct PatchEllipse {
    double x = 0, s = 0;                     ///< its middle, from the reference point, in the plane [m]
    double half_length = 0, half_width = 0;  ///< [m]
    ContactRow::Values values = ContactRow::Values::Zero();

    /// The forces on the patch under the load N [N], from a table; creepages and moment refer to the reference point.
    TangentialForce forces(const CreepForceTable& creep, const WheelOnRail::Dimensions& dimensions, double mu,
                           double load, const Creepage& at) const;
};

/// Equivalent ellipse of a patch: with it, a table of creep forces approximates friction on the patch's own outline
/// under its own pressures.
///
/// - Middle and semi-axes: Hertz's pressures have the first and second moments of the patch's pressures (a^2/5 and
///   b^2/5).
/// - Linear law: the patch's own. Creepages are multiplied by E^-1 L while the contact sticks
///   (detail::ellipse_creepages); L are the forces of the outline per creepage, E the forces of the ellipse.
/// - a/b beyond the table: the longer semi-axis is kept, and the correction also holds in full sliding.
///
/// Throws std::invalid_argument unless the patch has numbers.
inline PatchEllipse creep_ellipse(const RailPatch& patch, const WheelOnRail::Dimensions& dimensions,
                                  const CreepForceTable& creep);

inline auto PatchEllipse::forces(const CreepForceTable& creep, const WheelOnRail::Dimensions& dimensions, double mu,
                                 double load, const Creepage& at) const -> TangentialForce {
    const std::array<double, 3> there{at.longitudinal - at.spin * s, at.lateral + at.spin * x, at.spin};
    const auto [xi, eta, phi] =
        detail::ellipse_creepages<double>(there, half_length, half_width, dimensions.shear_modulus, mu * load,
                                          [&](Eigen::Index row) { return values[row]; });
    const PatchContact contact({half_length, half_width, dimensions.shear_modulus, dimensions.poisson_ratio});
    TangentialForce force = creep.look_up(contact, mu, load, {xi, eta, phi}).force;
    force.moment += x * force.lateral - s * force.longitudinal;
    return force;
}

inline PatchEllipse creep_ellipse(const RailPatch& patch, const WheelOnRail::Dimensions& dimensions,
                                  const CreepForceTable& creep) {
    using enum ContactRow::Of;
    detail::require(patch.load > 0, "creep_ellipse", "load of the patch", patch.load, "be positive");
    const std::vector<detail::PatchCreepMatrices> one = detail::patch_creep_matrices({patch}, dimensions, true);
    const detail::ZonePressures pressed = detail::pressures_of(one, {}, 0);
    PatchEllipse ellipse{.values = detail::rows_of(one, {}, 0, pressed, dimensions, creep, 0)};
    const Eigen::Vector2d from = pressed.from(patch);
    const double root = std::cbrt(pressed.load);
    ellipse.x = from[0];
    ellipse.s = from[1];
    ellipse.half_length = root * ellipse.values[length];
    ellipse.half_width = root * ellipse.values[width];
    return ellipse;
}

}  // namespace rollbem
