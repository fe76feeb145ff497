// Equivalent ellipse: with it, a table of creep forces approximates friction on a wheel's patches, or on their share in
// a zone of the rail.
#pragma once

#include "../detail/decl.hpp"

#include "../scene/creepage.hpp"
#include "../scene/force.hpp"
#include "contact_row.hpp"
#include "creep_force_table.hpp"
#include "wheelset_on_track.hpp"

namespace rollbem {

/// Equivalent ellipse used for the creep forces of a patch.
struct PatchEllipse {
    double x = 0, s = 0;                     ///< its middle, from the reference point, in the plane [m]
    double half_length = 0, half_width = 0;  ///< [m]
    ContactRow::Values values = ContactRow::Values::Zero();

    /// The forces on the patch under the load N [N], from a table; creepages and moment refer to the reference point.
    TangentialForce forces(const CreepForceTable& creep, const TrackDimensions& dimensions, double mu, double load,
                           const Creepage& at) const;
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
PatchEllipse creep_ellipse(const RailPatch& patch, const TrackDimensions& dimensions, const CreepForceTable& creep);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/creep_ellipse.ipp"
#endif
