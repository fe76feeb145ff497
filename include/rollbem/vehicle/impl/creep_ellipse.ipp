// Bodies of vehicle/creep_ellipse.hpp. Internal.
#pragma once

#include "../creep_ellipse.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "../../detail/require.hpp"
#include "../detail/creep_matrices.hpp"
#include "../detail/ellipse_creepages.hpp"

namespace rollbem {

ROLLBEM_DECL auto PatchEllipse::forces(const CreepForceTable& creep, const TrackDimensions& dimensions, double mu,
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

ROLLBEM_DECL PatchEllipse creep_ellipse(const RailPatch& patch, const TrackDimensions& dimensions,
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
