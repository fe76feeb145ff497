// Contacts and forces of wheels on rails, and look-ups of them, compiled for double. Replaces normal/wheel_on_rail.hpp,
// vehicle/contact_table.hpp and vehicle/wheelset_forces.hpp; link rollbem::compiled.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "../vehicle/contact_table.hpp"
#include "../vehicle/wheelset_forces.hpp"
#include "creep_force_table.hpp"
#include "friction.hpp"
#include "patch.hpp"

namespace rollbem {

extern template std::array<Eigen::ArrayXd, 2> detail::smooth_curve<double>(const Eigen::ArrayXd&,
                                                                           const std::vector<Eigen::Index>&,
                                                                           const std::array<Eigen::ArrayXd, 2>&,
                                                                           double);
extern template NormalContact::Solution NormalContact::solve<double>(const CellGrid&, const NormalContact::Grid&,
                                                                     std::optional<double>, double, double, bool);
extern template double detail::vertical_load<double>(const Eigen::ArrayXXd&, const CellGrid&, const Eigen::ArrayXd&,
                                                     double);
extern template RailPatch mirrored<double>(RailPatch, const Mirror&);
extern template WheelOnRail::Contact WheelOnRail::solve_for_load<double>(const WheelsetPosition&, double,
                                                                         WheelOnRail::Workspace&,
                                                                         const WheelOnRail::Options&) const;
extern template WheelOnRail::Contact WheelOnRail::solve_at_height<double>(const WheelsetPosition&,
                                                                          WheelOnRail::Workspace&,
                                                                          const WheelOnRail::Options&) const;
extern template ContactTable::Stored ContactTable::stored<double>(ContactTable::Side) const;
extern template WheelForces ContactTable::look_up<double>(const CreepForceTable&, WheelsetSide, const WheelsetPosition&,
                                                          const WheelsetSpeeds&, const WheelLoad&,
                                                          const WheelFriction&) const noexcept;
extern template WheelForces ContactTable::forces<double>(const CreepForceTable&, WheelsetSide, const WheelsetPosition&,
                                                         const WheelsetSpeeds&, const WheelLoad&,
                                                         const WheelFriction&) const noexcept;
extern template std::vector<PatchForce> patch_forces<double>(const std::vector<RailPatch>&, const WheelsetPosition&,
                                                             const WheelsetSpeeds&, const TrackDimensions&,
                                                             const RollingFriction&);
extern template WheelsetForces rolling_forces<double>(const WheelsetOnTrack&, const WheelsetRolling&,
                                                      const RollingFriction&, WheelsetOnTrack::Workspace&,
                                                      const WheelOnRail::Options&);

}  // namespace rollbem
