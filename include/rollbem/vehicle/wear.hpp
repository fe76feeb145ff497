// Wear and fatigue of wheels and rails that roll, by patches and by table: frictional work and its distribution over a
// profile, the fatigue index, and the derailment quotient.
#pragma once

#include "../detail/decl.hpp"

#include <Eigen/Core>

#include "../normal/profile.hpp"
#include "../scene/creepage.hpp"
#include "../scene/wheelset.hpp"
#include "contact_table.hpp"
#include "simplified_theory.hpp"
#include "wheelset_forces.hpp"

namespace rollbem {

/// T gamma [N], the work of creep forces on creepages per metre rolled [J/m]: -(F_x xi + F_s eta + M_n phi). Wear per
/// metre is a function of it over the area (British Rail Research; Braghin et al. 2006). It is the heat of friction
/// (slip_work) up to the errors of the discretisation, where slip follows from the three creepages.
double t_gamma(const TangentialForce& force, const Creepage& creepage);
inline double t_gamma(const PatchForce& patch) { return t_gamma(patch.force, patch.creepage); }
inline double t_gamma(const WheelForces::Point& point) { return t_gamma(point.force, point.creepage); }

/// FI_surf [-] of Ekberg, Kabo and Andersson (2002): the force of friction over the normal force, less k/p_max, k the
/// yield stress in shear [Pa]; of Hertz's contact p_max = 3N/(2 pi a b). Where it is positive, the surface flows
/// plastically in every passage, and cracks may start.
double surface_fatigue_index(const RailPatch& patch, const PatchForce& friction, double shear_yield);

/// FI_surf of a point of a table with a load, under the largest pressure of its zone.
double surface_fatigue_index(const WheelForces::Point& point, double shear_yield);

/// Y/Q [-] of a wheel: its lateral force on the rail, positive outwards as a flange presses, over its vertical one.
double y_over_q(const WheelForces& wheel, WheelsetSide side);

/// Kalker's c11, c22 and c23 of an ellipse, by a table's linear law. Throws std::invalid_argument for an outline, or
/// unless the table fits Poisson's ratio.
CreepCoefficients<double> creep_coefficients(const CreepForceTable& creep, const PatchContact& ellipse);

/// Friction on a point of a table, with its work over the strips of its ellipse: the sum is t_gamma, distributed over
/// the strips as by FASTSIM, or as the load where nothing slips. `mu` is the point's coefficient. The status is
/// no_contact without a load, and not_finite, without work, where the work is not. Throws std::invalid_argument unless
/// `mu` is finite and not negative, the mesh is one of SimplifiedTheory, and the table fits Poisson's ratio.
PatchForce strip_work_of(const WheelForces::Point& point, const CreepForceTable& creep, double mu,
                         const SimplifiedMesh& mesh = {});

/// Arc length of the point of a table on a rail's profile [m]: among places with the same y, the one with the nearest
/// angle. NaN beside the profile.
double arc_length(const Profile& rail, const WheelForces::Point& point);

/// Frictional work per metre rolled, over the arc length of a profile, summed over many patches.
class ProfileWear {
public:
    /// Throws std::invalid_argument unless there is a cell.
    ProfileWear(const Profile& profile, Eigen::Index cells);

    /// Adds `weight` times the work of a patch, whose reference point lies at `s` along the profile [m] (rail_s or
    /// wheel_s of its RailPatch), uniform in each of its strips. Work beyond the profile's ends counts in the outermost
    /// cells. Ignores friction whose status is not ok. Throws std::invalid_argument if the place of other friction is
    /// not finite, as arc_length beside the profile: its work would be lost.
    void add(double s, const PatchForce& friction, double weight = 1);

    double width() const { return length_ / double(work_.size()); }  ///< width of a cell [m]
    /// Work in each cell, per metre rolled and metre of profile [J/m^2].
    const Eigen::ArrayXd& work() const { return work_; }

private:
    double length_;
    Eigen::ArrayXd work_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/wear.ipp"
#endif
