// The state of friction between steps and the result of a step: plain data, for one direction of creepage or two.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "../scene/creepage.hpp"
#include "../scene/detail/directions.hpp"
#include "../status.hpp"
#include "../types.hpp"

namespace rollbem {

/// Whether an element sticks or slips. In one direction the value is the sign of the slip, in two directions it is
/// `slip` wherever an element slips.
enum class Zone : signed char { slip_negative = -1, stick = 0, slip_positive = 1, slip = 1 };

/// Vectors of the elements, a row each: the longitudinal component in column 0, the lateral one in column 1.
using ElementVectors = Eigen::MatrixX2d;

namespace detail {

/// Data that make the next step cheaper. They change results by round-off only, unless there are several solutions.
struct SolverRecord {
    /// mu [-] from which the first stage of the next step starts its search: mu of this step's first stage or, after a
    /// jump, mu at its end. Empty if mu is constant.
    ArrayX<double> stage_coefficient;
};

}  // namespace detail

/// Everything that the next step or solution needs to know about the past. A copy is a checkpoint; a state written to a
/// file and read back continues identically to the last bit.
struct FrictionState {
    /// Traction p on body 1 of each unknown element [Pa], from the trailing to the leading edge; 0 across the direction
    /// of a model of one.
    ElementVectors traction;
    std::vector<Zone> zones;  ///< stick or slip of each element, at the end of the step
    /// The present load: p_n [Pa] of each unknown element, the half-length a and the half-width b of the contact [m];
    /// on a line b does not vary and is not read. A step without a load keeps them.
    ArrayX<double> normal_pressure;
    double half_length = 0, half_width = 0;
    std::uint64_t system = 0;  ///< fingerprint() of the model that the state belongs to
    /// mu [-] of each unknown element, finite and not negative; empty if mu is constant. Without memory it is mu_s(v),
    /// and the search for the next solution starts from it. After Status::no_solution the coefficients must not start
    /// another step.
    ArrayX<double> friction_coefficient;
    detail::SolverRecord solver;
    /// Tractions [Pa] of the pass without rotated slip (see Friction), whose slip determines the angles of the next
    /// step. As large as `traction` where slip is rotated; empty means equal to `traction`.
    ElementVectors unrotated_traction;
};

/// Result of a steady solution, a step or a rigid shift. Forces, tangents and works are totals, for a line contact over
/// its width 2b; where b is infinite they are per metre of width (Contact::width()). A model of one direction returns 0
/// across its direction, and NaN as the moment and the derivatives by spin. All are NaN unless the status is ok or
/// no_solution; tangents are NaN also if the equations of the elements are singular.
struct FrictionStep {
    using Force = TangentialForce;
    using Tangent = TangentialForce::ByCreepage;

    Force force = detail::nothing<Force>();  ///< force on body 1 [N]
    /// d force / d creepage at the end of the step [N]; for a rigid shift, by the shift [N/m].
    Tangent tangent = detail::nothing<Tangent>();
    /// Derivatives of the force with respect to the load, at constant semi-axes, and with respect to the half-length
    /// and the half-width, all at the end of the step. If the semi-axes depend on the load, the total derivative is
    /// tangent_by_load + tangent_by_half_length da/d load + tangent_by_half_width db/d load. On a patch of constant
    /// a/b, tangent_by_half_length is taken at that a/b and tangent_by_half_width is 0. NaN
    /// - for a steady solution, and for a step without a load of its own,
    /// - tangent_by_load: if NormalLoad has no pressure_rate,
    /// - the other two: if the system cannot breathe, and for a rigid shift,
    /// - tangent_by_half_width: on a line.
    Force tangent_by_load = detail::nothing<Force>();         ///< [N per unit of the load]
    Force tangent_by_half_length = detail::nothing<Force>();  ///< [N/m]
    Force tangent_by_half_width = detail::nothing<Force>();   ///< [N/m], for a patch
    /// Frictional heat [J]; for a steady solution heat per distance rolled [J/m]. It is the sum over elements and
    /// directions of traction times slip at the centre, of second order in 1/n at alpha = 0.5. For user-supplied
    /// matrices the slip of each element's own equation is taken: first order. The heat is never negative, except with
    /// two directions and equations half an element ahead: an element that sticks ahead of a slipping one then
    /// contributes a small value of either sign.
    double slip_work = detail::not_computed;
    /// Elastic energy released by jumps of the tractions within a step [J], which slip-dependent friction permits:
    ///
    ///     work of the rigid bodies = slip work + jump work + change of elastic energy
    ///
    /// It turns into heat during a slip that is too short for the step to resolve (see detail::jump_work() for the
    /// expression). Without jumps it tends to 0 with dq, from either side; with constant friction rolling has no jumps,
    /// and it is 0. For a rigid shift it is the slip work by the mean tractions of both ends minus the slip work by the
    /// tractions at the end; the balance then holds with the work of the rigid bodies by the mean force. For a steady
    /// solution it is 0.
    double jump_work = detail::not_computed;
    /// Largest violation of the friction law, the error of the equations included (with two directions an estimate).
    /// The largest of
    /// - the error of a traction, over the largest mu p_n: |p| above mu p_n, or below it where an element slips;
    /// - the error of a slip, over the largest slip without traction: any slip of a sticking element, slip along the
    ///   traction or across it;
    /// - the error of a coefficient mu that depends on slip.
    double complementarity_residual = detail::not_computed;
    Eigen::Index stick_count = 0;  ///< elements that stick
    int rounds = 0;                ///< Newton steps; in one direction rounds of an active set
    int path_points = 0;           ///< points of the path followed where the Newton steps do not converge, else 0
    Status status = Status::not_finite;
};

}  // namespace rollbem
