// Wear and fatigue of wheels and rails that roll, by patches and by table: frictional work and its distribution over a
// profile, laws of wear, the fatigue index, and the derailment quotient.
#pragma once

#include "../detail/decl.hpp"

#include <vector>

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
                         const SimplifiedTheory::Mesh& mesh = {});

/// Archard's coefficient k [-] by the map of KTH (Jendel, Wear 253 (2002) 86-99, the middle of its ranges) over the
/// pressure [Pa] and the sliding velocity [m/s]: seizure above 0.8 of the hardness [Pa], severe wear from 0.2 to 0.7
/// m/s, else mild wear.
double archard_coefficient(double pressure, double sliding_velocity, double hardness = 3e9);

/// Arc length of the point of a table on a rail's profile [m]: among places with the same y, the one with the nearest
/// angle. NaN beside the profile.
double arc_length(const Profile& rail, const WheelForces::Point& point);

/// Frictional work per metre rolled, over the arc length of a profile, summed over many patches.
///
/// \code
/// #include <rollbem/vehicle.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const WheelsetOnTrack wheelset(WheelOnRail(s1002(), rail_60e1()));
///     WheelsetOnTrack::Workspace workspace;
///     const auto forces = rolling_forces(wheelset, {.position = {.lateral = 4e-3, .yaw = 2e-3}}, {}, workspace);
///     if (!has_numbers(forces.status())) return 1;
///     ProfileWear wear(wheelset.wheel().rail(), 200);
///     for (std::size_t k = 0; k < forces.patches[1].size(); ++k) {
///         wear.add(forces.contacts.wheels[1].patches[k].rail_s, forces.patches[1][k]);
///     }
///     return wear.work().sum() > 0 ? 0 : 1;  // [J/m^2]
/// }
/// \endcode
class ProfileWear {
public:
    /// A law of wear: the depth that each body loses in a place of contact, per metre rolled. A value; not negative,
    /// and 0 where nothing slips.
    ///
    /// \code
    /// #include <rollbem/vehicle.hpp>
    ///
    /// int main() {
    ///     using namespace rollbem;
    ///     const ProfileWear::Law law = ProfileWear::Law::archard_kth();
    ///     const ProfileWear::Law::Place place{.work = 2e6, .pressure = 1e9, .slip = 5e-3, .sliding_velocity = 0.1};
    ///     return law.depth(place) > 0 ? 0 : 1;  // [m] per metre rolled
    /// }
    /// \endcode
    class Law {
    public:
        /// A place of contact.
        struct Place {
            double work;              ///< T gamma/A, traction times slip over the rolling velocity [Pa]
            double pressure;          ///< [Pa]
            double slip;              ///< slip over the rolling velocity [-]
            double sliding_velocity;  ///< [m/s]
        };

        /// Density of steel by which rates of mass become depths [kg/m^3].
        static constexpr double density = 7850;

        /// Braghin et al. (Wear 261 (2006) 1253-1264): K [ug/(m mm^2)] of x = T gamma/A [N/mm^2] is 5.3 x below 10.4,
        /// 55.12 up to 77.2 and 55.12 + 61.9 (x - 77.2) above.
        static Law t_gamma();
        /// Archard's law k p s/H with the coefficient of archard_coefficient(). Throws std::invalid_argument unless the
        /// hardness H [Pa] is positive and finite.
        static Law archard_kth(double hardness = 3e9);
        /// Rates [ug/(m mm^2)] of T gamma/A [N/mm^2], linear between the places and constant beyond. Throws
        /// std::invalid_argument unless there is a place, places ascend from 0 or more, and rates are finite and not
        /// negative.
        Law(const std::vector<double>& t_gamma_per_area, const std::vector<double>& rate);

        /// The depth lost per metre rolled while the place stays in contact [-].
        double depth(const Place& place) const;

    private:
        Law() = default;

        std::vector<double> work_{}, depth_{};  // SI
        double slope_ = 0;                      // of the depth beyond the last place [1/Pa]
        double hardness_ = 0;                   // of Archard's law, else 0
    };

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
    /// The means of work() around the points of the profile, from midway to the point before to midway to the point
    /// behind: these lengths times the means sum up to the work of all cells.
    Eigen::ArrayXd at_points(const Profile& profile) const;

private:
    double length_;
    Eigen::ArrayXd work_;
};

/// The volume that a patch wears off each body per metre rolled [m^3/m], in place of work over its strips, for
/// ProfileWear: the law's sum over the elements of each strip, rising and falling linearly between the middles of
/// strips, with the sum of all elements. `velocity` is that of rolling [m/s]. Without elements, as where friction has
/// no result, there are no strips.
PatchForce wear_of(const PatchForce& friction, const ProfileWear::Law& law, double velocity);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/wear.ipp"
#endif
