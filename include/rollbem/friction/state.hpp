// What friction carries from step to step, and what a step returns: plain data, for one direction of creepage or two.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../scene/directions.hpp"
#include "../scene/force.hpp"
#include "../status.hpp"
#include "../types.hpp"

namespace rollbem {

/// Whether an element sticks or slips. In one direction the value is the sign of the slip, in two directions it is
/// `slip` wherever an element slips.
enum class Zone : signed char { slip_negative = -1, stick = 0, slip_positive = 1, slip = 1 };

/// One row per element: longitudinal in column 0 and, with two directions, lateral in column 1.
template <class Scalar, int directions = 2>
using ElementVectors = Eigen::Matrix<Scalar, Eigen::Dynamic, directions>;

namespace detail {

/// What makes the next step cheaper; it changes results by round-off only, unless there are several solutions.
template <class Scalar>
struct SolverRecord {
    /// mu [-] in the first of two stages, from which the search for that of the next step starts; empty if mu is
    /// constant.
    ArrayX<Scalar> stage_coefficient;
};

}  // namespace detail

/// Everything that the next step or solution needs to know about the past. A copy is a checkpoint; a state written to a
/// file and read back continues identically to the last bit.
template <int directions = 1, class Scalar_ = double>
struct FrictionState {
    using Scalar = Scalar_;

    /// p on body 1 of each unknown element [Pa], trailing to leading: a vector, or with two directions a row each.
    ElementVectors<Scalar, directions> traction;
    std::vector<Zone> zones;  ///< stick or slip of each element, at the end of the step
    /// The present load: p_n [Pa] of each unknown element, the half-length a and the half-width b of the contact [m];
    /// on a line b does not vary and is not read. A step without a load keeps them.
    ArrayX<Scalar> normal_pressure;
    Scalar half_length = 0, half_width = 0;
    std::uint64_t system = 0;  ///< fingerprint() of the model that the state belongs to
    /// mu [-] of each unknown element, finite and not negative; empty if mu is constant. Without memory it is mu_s(v),
    /// and the next solution is sought from it. After Status::no_solution these are not coefficients to go on with.
    ArrayX<Scalar> friction_coefficient;
    detail::SolverRecord<Scalar> solver;
    /// The tractions if slip had never been turned (see Friction) [Pa], on whose slip the angles of the next step
    /// depend: like traction where slip is turned, or empty, as if they were the same.
    ElementVectors<Scalar, directions> plain_traction;
};

namespace detail {

/// Where a solution is sought: at tractions in G and the zones that go with them, in one direction at these alone.
/// `turned_traction`: of a second solution for turned slip, unless its equations are those of the first.
template <int directions, class Scalar>
struct SolutionStart {
    const ElementVectors<Scalar, directions>& traction;
    const std::vector<Zone>& zones;
    const ElementVectors<Scalar, directions>* turned_traction = nullptr;
};

/// The moment aside, which may be unknown.
template <class Scalar>
bool is_finite(const TangentialForce<Scalar>& force) {
    return is_finite(force.longitudinal) && is_finite(force.lateral);
}

}  // namespace detail

/// Result of a steady solution, a step or a rigid shift. Forces, tangents and works are totals, of a line contact over
/// its width 2b; where b is infinite they are per metre of width (Contact::width()). Forces and their derivatives are
/// numbers with one direction, vectors with two. All are NaN unless the status is ok or no_solution;
/// tangents also if the equations of the elements are singular.
template <int directions = 1, class Scalar_ = double>
struct FrictionStep {
    using Scalar = Scalar_;
    using Force = detail::ForceAlong<directions, Scalar>;
    using Tangent = detail::TangentAlong<directions, Scalar>;

    Force force = detail::nothing<Force>();  ///< on body 1 [N]
    /// d force / d creepage at the end of the step [N]; for a rigid shift, by the shift [N/m].
    Tangent tangent = detail::nothing<Tangent>();
    /// Derivatives with respect to the load at the end of a step, at constant half-length and half-width, and by these;
    /// if they depend on the load, the total derivative is tangent_by_load + tangent_by_half_length da/d load +
    /// tangent_by_half_width db/d load. NaN for steps without a load of their own; by the load also if NormalLoad has
    /// no pressure_rate, by the others also if the system cannot breathe and for a rigid shift. A patch of constant a/b
    /// has a tangent by the half-length at that a/b, and none by the half-width: 0. On a line that by the half-width is
    /// NaN.
    Force tangent_by_load = detail::nothing<Force>();         ///< [N per unit of the load]
    Force tangent_by_half_length = detail::nothing<Force>();  ///< [N/m]
    Force tangent_by_half_width = detail::nothing<Force>();   ///< of a patch [N/m]
    /// Frictional heat [J]; of a steady solution per distance rolled [J/m]. It is the sum over elements and directions
    /// of traction times slip at the centre, of second order in 1/n at alpha = 0.5 (steady rolling, cosine mesh, n =
    /// 40, against -F xi: 1.5e-3 at a creepage ratio of 0.5). For user-supplied matrices the slip is that of each
    /// element's own equation: first order. Never negative, but with two directions and equations half an element
    /// ahead: an element that sticks ahead of one that slips then contributes a value of either sign, 2 % of the whole
    /// at most on 8 elements.
    Scalar slip_work = detail::unknown<Scalar>;
    /// Elastic energy released by jumps of the tractions within a step [J], which slip-dependent friction permits:
    ///
    ///     work of the rigid bodies = slip work + jump work + change of elastic energy
    ///
    /// It turns into heat during a slip that is too short for the step to resolve (see detail::FrictionCore for the
    /// expression). Without jumps it tends to 0 with dq, from either side; with constant friction, where rolling has
    /// none, it is 0. For a rigid shift it is what the slip work would gain if the tractions were the means of those at
    /// both ends, with the work of the rigid bodies from the mean force. 0 for a steady solution.
    Scalar jump_work = detail::unknown<Scalar>;
    /// Largest violation of the law. Of the traction, relative to the largest mu p_n: |p| above mu p_n, or, in two
    /// directions, below it where an element slips. Of the slip, relative to the largest slip without traction: slip of
    /// an element that sticks, along the traction or across it. If mu depends on slip, it is at least the error of a
    /// coefficient. The error of the equations is included, with two directions by an estimate.
    Scalar complementarity_residual = detail::unknown<Scalar>;
    Eigen::Index stick_count = 0;  ///< elements that stick
    int rounds = 0;                ///< Newton steps; in one direction rounds of an active set
    int path_points = 0;           ///< points of the path that is followed where these do not converge; 0 if they do
    Status status = Status::not_finite;
};

}  // namespace rollbem
