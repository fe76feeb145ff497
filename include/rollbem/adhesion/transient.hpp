// Non-steady rolling in full adhesion step by step: G dp/dq = G' p - inputs v(q), q = V t the distance rolled,
// Eqs. (11) and (12). A force element for an external time loop: const model, plain state, no exception and no
// allocation in a step.
#pragma once

#include "../detail/decl.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../rolling/detail/stage_equations.hpp"
#include "../rolling/detail/stage_table.hpp"
#include "../rolling/detail/time_step.hpp"
#include "../rolling/run.hpp"
#include "../scene/contact.hpp"
#include "../scene/detail/contact_units.hpp"
#include "../scene/detail/directions.hpp"
#include "../scene/patch_contact.hpp"
#include "../scene/rigid_motion.hpp"
#include "../status.hpp"
#include "../system/detail/contact_fit.hpp"
#include "../system/detail/time_domain.hpp"
#include "../system/rolling_system.hpp"
#include "../types.hpp"
#include "detail/rational_exponential.hpp"
#include "detail/stages.hpp"
#include "detail/step_map.hpp"

namespace rollbem {

/// The contact as a force element without slip, stepped like FrictionModel: in one direction, or in both with spin,
/// where the forces are F_x, F_y and the moment M_z. Immutable: threads may share it. SI units.
///
/// \code
/// #include <rollbem/line.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const Contact contact({5e-3, 0.05, 8.2e10, 0.28});  // a, b [m], G [Pa], nu
///     const AdhesionModel<> model(contact, rolling_system(Chebyshev{8}, StripKernel<double>::longitudinal(contact)),
///                                 unchecked);  // Chebyshev states are stable for any number
///     Run run(model);
///     for (int k = 0; k < 20; ++k) {
///         if (run.advance({0.5e-3, 1e-4}).status != Status::ok) return 1;  // rolls by 0.5 mm at a creepage of 1e-4
///     }
///     return model.force(run.now()) < 0 ? 0 : 1;  // [N]
/// }
/// \endcode
///
/// A step of the same distance as the step before costs one product of an n x n matrix and a vector; the first step
/// that repeats a distance also computes that matrix, O(n^3). A step of any other distance factorises a matrix of its
/// own, O(n^3), which costs less than computing the matrix of repeated steps. Integrator::matrix_exponential always
/// computes the matrix. Results depend on state and arguments alone, to the last bit, and never on the history of the
/// workspace.
///
/// The half-length of a line contact, or the semi-axes of a patch, may change from step to step if can_breathe(): the
/// unknowns then live on x = a zeta, y = b upsilon, and the state at one half-length is carried over to the next. b of
/// a line is constant.
///
/// Invariant: the half-width is finite, and the scheme is stable according to the verdict.
///
///     const auto system = rolling_system(mesh, scheme, kernel);
///     const AdhesionModel model(contact, system, judge_stability(system));
///     auto workspace = model.workspace();
///     auto now = model.at_rest(), next = now;
///     const auto step = model.advance(now, {dq, creepage}, next, workspace);  // now stays as it is
///     if (accepted) std::swap(now, next);
///
/// Both creepages and spin, on a line or on a patch:
///
///     const ElementSystem system(longitudinal, lateral);
///     const AdhesionModel model(contact, system, judge_stability(system.joined()));
///     const auto step = model.advance(now, {dq, {1e-3, 5e-4, 0.1}}, next, workspace);
template <int directions_ = 1>
class AdhesionModel {
public:
    static constexpr int directions = directions_;

    /// Everything that the next step needs to know about the past. A copy is a checkpoint; a state written to a file
    /// and read back continues identically to the last bit.
    struct State {
        VectorX<double>
            traction;  ///< the system's unknowns times G: for elements p on body 1 [Pa], trailing to leading
        std::uint64_t system = 0;  ///< fingerprint() of the model that the state belongs to
        double half_length = 0;    ///< a of the contact that the tractions act on [m], positive and finite
        /// Distance rolled in the step that led here [m]. It makes a next step of the same distance cheaper, and
        /// changes results by round-off only.
        double distance = 0;
        double half_width = 0;  ///< b of a patch [m], positive and finite; on a line it does not vary and is not read
    };

    /// Result of a step or of steady rolling. NaN unless the status is ok. With one direction forces and their
    /// derivatives are numbers, with two TangentialForce and TangentialForce::ByCreepage.
    struct Step {
        using Force = detail::ForceAlong<directions>;
        using Tangent = detail::TangentAlong<directions>;

        Force force = detail::nothing<Force>();            ///< 2b F_bar on body 1 [N]
        Force force_per_width = detail::nothing<Force>();  ///< F_bar [N/m], moment [N]; NaN for a patch
        /// d force / d creepage at the end of the step [N]; for a rigid shift d force / d shift [N/m].
        Tangent tangent = detail::nothing<Tangent>();
        /// d force / d half-length at the end of the step [N/m] with motion, dq and initial state fixed. NaN for steady
        /// rolling, for steps without a given half-length, and if the model cannot breathe.
        Force tangent_by_half_length = detail::nothing<Force>();
        /// d force / d half-width of a patch, likewise [N/m]. For a patch of constant a/b see
        /// FrictionStep::tangent_by_load.
        Force tangent_by_half_width = detail::nothing<Force>();
        Status status = Status::not_finite;
    };

    /// A workspace is made by a model and fits any model with the same number of unknowns and directions. The matrices
    /// for steps of one distance are kept as long as model and distance stay the same, so contacts that are stepped in
    /// turn should each have their own workspace, of 4 n^2 numbers. Two threads must not use one workspace at the same
    /// time.
    class Workspace {
    public:
        /// A workspace for n unknowns.
        explicit Workspace(Eigen::Index n) : factors_(n), stages_(n), map_(n) {}

        Eigen::Index size() const { return factors_.size(); }

        detail::StageFactors& factors() { return factors_; }              ///< for the models
        detail::AdhesionStages<directions>& stages() { return stages_; }  ///< for the models
        detail::StepMap<directions>& map() { return map_; }               ///< for the models

    private:
        detail::StageFactors factors_;
        detail::AdhesionStages<directions> stages_;
        detail::StepMap<directions> map_;
    };

    using Force = typename Step::Force;               ///< a number, or TangentialForce
    using Value = detail::CreepageAlong<directions>;  ///< a number, or Creepage
    using Motion = RigidMotion<Value>;
    /// The load is the half-length [m] (with two directions the semi-axes [m]) at the end of the step; if none is
    /// given, the state's remains.
    using RollingStep = rollbem::RollingStep<Motion, std::optional<detail::ByDirections<directions, double, SemiAxes>>>;

    /// A line contact. With one direction, creepage and force act along the direction of the system's kernel; with two,
    /// the inputs are the three numbers of a Creepage, as both_directions() makes them. `verdict` judges `system`, or
    /// is `unchecked`. Throws std::invalid_argument
    /// - if the verdict does not belong to this system or does not establish that no eigenvalue grows,
    /// - if steady rolling shows that the scheme does not converge (Status::assists_creepage),
    /// - if the contact's half-width is infinite or differs from the half-width of the system's kernel,
    /// - if the system has another number of inputs than 1, or 3 with two directions.
    AdhesionModel(const Contact& contact, RollingSystem<double> system, const StabilityVerdict& verdict,
                  Integrator integrator = Integrator::sdirk2);

    /// Both directions of a line, or a patch (PatchContact, whose half_length() is the system's unit of length), with
    /// the verdict on system.joined(). Throws std::invalid_argument for the same reasons.
    template <class AnyContact>
    AdhesionModel(const AnyContact& contact, const ElementSystem<double, 2>& system, const StabilityVerdict& verdict,
                  Integrator integrator = Integrator::sdirk2) requires(directions_ == 2);

    Eigen::Index size() const { return forces_.columns().rows(); }  ///< number of unknowns
    std::uint64_t fingerprint() const { return fingerprint_; }      ///< identifies system and contact
    Integrator integrator() const { return integrator_; }

    /// Whether the half-length, or the semi-axes of a patch, may change: for systems with points() and log_strength()
    /// (elements and Chebyshev states of the plane kernel), and for patches of breathing_system and PatchShapes; by
    /// implicit_euler and sdirk2.
    bool can_breathe() const {
        return (shapes_ || (directions == 1 && detail::can_breathe(system_))) && !is_exponential();
    }

    /// The state without traction, at the contact's semi-axes.
    State at_rest() const { return {VectorX<double>::Zero(size()), fingerprint_, units_.length, 0, units_.half_width}; }
    Workspace workspace() const { return Workspace(size()); }

    /// The force 2b F_bar of a state [N] at its semi-axes. The state must have size() unknowns.
    Force force(const State& state) const { return force_along(forces_.of(state.traction, axes(state))); }

    /// Solves for steady rolling, G' p = inputs v, Eq. (15), with the creepage v at the end of the step's motion, which
    /// must not be a shift, at the semi-axes of the step. A step without semi-axes takes them from `from`, of which
    /// nothing else is used. The tangent is the derivative of the steady force. For the status see advance().
    Step steady(const State& from, const RollingStep& step, State& to, Workspace& workspace) const noexcept;
    /// The state of steady rolling at the contact's half-length. Throws std::invalid_argument unless the creepage is
    /// finite.
    State steady(const Value& creepage) const;

    /// Rolls by dq [m], positive and finite, or 0 for a rigid shift without rolling. `to` must be another state with
    /// the same number of unknowns. It is not written if the status is invalid_step, wrong_state, invalid_load or
    /// needs_fixed_mesh or the motion is not finite; if the result is not finite, it becomes a copy of `from`. Does not
    /// allocate.
    ///
    /// The semi-axes vary linearly to the semi-axes of the step; without them, they remain as in `from`. sdirk2 is of
    /// second order in dq if creepage and semi-axes are smooth in each step. dq is the distance rolled by the centre of
    /// the contact. The status is
    /// - invalid_load if a semi-axis is not positive and finite;
    /// - needs_fixed_mesh if the length would change by dq or more (with dq = 0, if it changes at all), so that an edge
    ///   would not roll forward; if the model cannot breathe, unless all semi-axes are the contact's; and if a/b leaves
    ///   the range of the system's shapes, or the half-width of a line changes.
    Step advance(const State& from, const RollingStep& step, State& to, Workspace& workspace) const noexcept;

private:
    using Inputs = detail::InputVector<directions>;
    using Square = detail::InputMatrix<directions>;
    using Axes = SemiAxes;
    using By = detail::Parameters<directions>;
    using Units = detail::ContactUnits;
    using Stages = detail::AdhesionStages<directions>;

    static constexpr const char* name = "AdhesionModel";
    static constexpr Axes contact_axes = detail::contact_axes;

    static Force force_along(const Inputs& forces) { return detail::force_along<directions>(forces); }

    AdhesionModel(const Units& units, RollingSystem<double> system, Integrator integrator);

    // Identifies the data that a workspace prepares for model and integrator. Matrices of shapes have a number of their
    // own because they differ by rounding from the matrices of a fixed mesh.
    std::uint64_t preparation(bool of_shapes = false) const {
        return fingerprint_ ^ (2 * static_cast<std::uint64_t>(integrator_) + (of_shapes ? 3 : 2));
    }

    bool is_exponential() const { return !detail::stage_table(integrator_); }

    // The number of times to halve the step until the norm of w is at most 1/16, where r(w) of eighth order gives e^w
    // to rounding. The upper limit matters only if G is singular to rounding: the modes it affects decay at once.
    int count_doublings(double h) const;

    static void solve(MatrixX<double> matrix, MatrixX<double>& right);

    Status check(const State& from, const SemiAxes& semi_axes, const State& to,
                 const Workspace& workspace) const noexcept;
    Status check_growth(double distance, const Axes& start, const Axes& end) const noexcept;

    bool are_lengths(const SemiAxes& axes) const noexcept {
        return detail::are_positive({axes.half_length, units_.line ? 1.0 : axes.half_width});
    }
    template <class Placed>
    Axes axes(const Placed& placed) const {
        return units_.axes(placed);
    }

    // Forces per unit of each creepage j, which causes unknowns(j).
    template <class Unknowns>
    Square forces_of(const Unknowns& unknowns, const Axes& at) const;

    // Makes `to` a copy of `from`, for a result that is not finite.
    static Step fail(const State& from, State& to) noexcept;
    // Completes `to`, whose tractions are known, and returns the result.
    Step finish(const State& from, const SemiAxes& semi_axes, double dq, const Square& tangent,
                State& to) const noexcept;

    using TimeStep = detail::TimeStep<directions>;
    using Problem = detail::AdhesionProblem<directions>;

    // The semi-axes at the end of a step.
    SemiAxes semi_axes(const State& from, const RollingStep& step) const noexcept;
    // Whether a step needs the equations of other semi-axes than the contact's.
    bool reshapes(const TimeStep& step, const Problem& problem) const {
        return shapes_ && (problem.asked[By::half_length] || step.start != contact_axes || step.end != contact_axes);
    }
    // Takes a step by the linear map for its distance.
    Step repeat(const State& from, double dq, const Motion& motion, State& to, Workspace& workspace) const noexcept;
    // Takes a step by the stages of the integrator.
    Step solve_stages(const State& from, const RollingStep& step, const TimeStep& rolled, const Problem& problem,
                      State& to, Workspace& workspace) const noexcept;
    // Adds the derivatives by the semi-axes that the problem asks for. False if one is not finite.
    bool add_tangents(const Problem& problem, const Stages& stages, const State& to, Step& step) const;

    Units units_;
    RollingSystem<double> system_;
    std::uint64_t fingerprint_;
    Integrator integrator_;
    detail::RationalExponential rational_;
    detail::RigidSlip<directions> slip_;
    detail::ContactForces<directions> forces_;
    MatrixX<double> steady_;                                  // n x k, per creepage [Pa], per spin [Pa m]
    double rates_norm_ = 0;                                   // |G^-1 G'|, for the matrix exponential
    std::shared_ptr<const detail::ShapeSet<double>> shapes_;  // matrices of a patch that may change its semi-axes
    double a_over_b_ = 1;
};

AdhesionModel(const Contact&, RollingSystem<double>, const StabilityVerdict&, Integrator = Integrator::sdirk2)
    ->AdhesionModel<1>;
template <class AnyContact>
AdhesionModel(const AnyContact&, const ElementSystem<double, 2>&, const StabilityVerdict&,
              Integrator = Integrator::sdirk2) -> AdhesionModel<2>;

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/transient.tpp"
#endif
