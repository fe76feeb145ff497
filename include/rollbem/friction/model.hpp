// Rolling with friction, steady or step by step under a load that may vary, and rigid shifts without rolling, in one
// direction of creepage or two. The slip s is s/V = xi - G' p + G dp/dq, Eq. (1), with q = V t the distance rolled.
#pragma once

#include "../detail/decl.hpp"

#include <cstdint>
#include <memory>

#include <Eigen/Core>

#include "../detail/hidden.hpp"
#include "../normal/load.hpp"
#include "../rolling/run.hpp"
#include "../scene/contact.hpp"
#include "../scene/creepage.hpp"
#include "../scene/patch_contact.hpp"
#include "../scene/rigid_motion.hpp"
#include "../system/rolling_system.hpp"
#include "../types.hpp"
#include "law.hpp"
#include "state.hpp"

namespace rollbem {

namespace detail {
struct FrictionData;     // internal
struct FrictionScratch;  // internal
}  // namespace detail

/// The contact as a force element with friction, stepped like AdhesionModel. Immutable: threads may share it if they
/// may share the law, and copies share its data. A creepage xi > 0 gives a negative force in steady rolling. States,
/// motions and results have two directions. A model of one direction, which costs less, reads the components along its
/// own, ignores spin, and returns 0 across its direction and NaN as the moment and the derivatives by spin.
///
/// \code
/// #include <rollbem/line.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const Contact contact({5e-3, 0.05, 8.2e10, 0.28});  // a, b [m], G [Pa], nu
///     const Mesh<double> mesh = cosine_mesh(20);
///     const auto system =
///         steady_system(mesh, NodeDifference{Nodes::chebyshev}, StripKernel<double>::longitudinal(contact));
///     const FrictionModel model(contact, system, {0.3, HertzLine::Pressure{1e9}(mesh)});
///     Run run(model);
///     for (const double creepage : {5e-4, 1e-3, 2e-3}) {  // a creep curve
///         const FrictionStep point = run.steady({.motion = Creepage{creepage}});  // starts from the one before
///         if (point.status != Status::ok || !(point.force.longitudinal < 0)) return 1;
///     }
/// }
/// \endcode
///
/// Steady rolling alone needs only G', which steady_system() makes: the kernel is not integrated for G, no eigenvalue
/// is judged, and the half-width may be infinite. A model of such a system refuses to advance and to shift
/// (Status::invalid_step), and its elastic energy is NaN. A time-domain model with the same contact, G' and pressures
/// accepts its states as starting points. If the scheme does not converge to full adhesion (alpha <= 0, or alpha > 1),
/// forces would be wrong wherever elements stick: the status of every solution is then Status::assists_creepage, with
/// the residual but with NaN for forces, tangents and works, unless the model is made `unchecked`. Collocation at the
/// centres (alpha = 0) is a special case: its tractions assist the creepage in full adhesion, where its force is zero,
/// but with friction the force converges, with first order, once several elements slip at the trailing edge.
///
/// If mu falls steeply with slip and has no memory, several solutions may exist at one creepage, which differ in where
/// slip begins. The solver usually returns the one nearest to `from`, so that a creep curve whose points start from
/// their predecessors follows its branch until the branch ends. From at_rest(), where mu = mu_s(0) everywhere, it finds
/// the branch of high friction.
///
/// Integrator::sdirk2 solves for stick and slip twice per step and is of second order in dq, for forces and slip work
/// alike; implicit_euler solves once and is of first order. Each of these solutions satisfies the law, and slip never
/// gains energy. Transitions between stick and slip within a step do not reduce the order; a memory of falling friction
/// reduces it to between first and second.
///
/// In time the scheme must meet the requirements of AdhesionModel: a verdict that its eigenvalues decay, and
/// convergence in full adhesion. With any other scheme the tractions are bounded by friction but wrong, except for
/// alpha = 0 as above.
///
/// If mu depends on slip, steps have a duration, {{dq, duration}, creepage}, and v = |slip in a stage| / its duration.
/// With a memory, mu belongs to the particles of the surfaces, which roll through the contact: each element starts from
/// the coefficient of the particle that arrives there. A particle enters with mu_s(0), and its memory is reset where
/// there is no pressure. It stays in its strip: where there are several, loads that change the half-width are
/// needs_fixed_mesh. A step may have several solutions, of which the coefficients of `from` lead to one, and the nearest
/// one may vanish; the force then jumps within the step, however short it is (docs/friction.md). Steps must resolve the
/// memory: the slip in a step should be shorter than the memory's distance.
///
///     const ElementSystem system = rolling_system(mesh, scheme, kernel);
///     const FrictionModel model(contact, system, judge_stability(system), {0.3, pressure});
///     FrictionModel::Workspace workspace = model.workspace();
///     FrictionState now = model.at_rest(), next = now;
///     const FrictionStep step = model.advance(now, {dq, Creepage{1e-3}}, next, workspace);  // does not change now
///     if (accepted) std::swap(now, next);
///
/// A patch, whose system has both directions and one verdict for both symmetric halves:
///
///     const PatchContact contact({...});
///     const PatchMesh<double> mesh = patch_mesh(contact, 12, 12);
///     const FrictionModel model(contact, rolling_system(mesh, scheme, kernel),
///                               judge_stability(patch_subsystems(mesh, scheme, kernel)),
///                               {0.3, hertz_pressures(contact, mesh, load)});
///     const FrictionStep step = model.advance(now, {dq, {1e-3, 5e-4, 0.1}}, next, workspace);
class FrictionModel {
public:
    using State = FrictionState;
    using Step = FrictionStep;
    using Force = TangentialForce;
    using Motion = RigidMotion<Creepage>;
    /// The load is a NormalLoad or, if none is given, the load of the state; travel needs a duration if mu depends on
    /// slip.
    using RollingStep = rollbem::RollingStep<Motion, detail::GivenLoad<NormalLoad>>;

    /// Matrix factors and scratch memory of friction. They make steps fast and never change a result. A workspace is
    /// made by a model and fits any model with the same number of elements and directions, the same coupling of
    /// directions and the same kind of coefficient (constant, or dependent on slip). The factors are kept as long as
    /// the model and the distance rolled stay the same, so contacts that are stepped in turn should each have their own
    /// workspace. Two threads must not use one workspace at the same time.
    class Workspace {
    public:
        /// Slip of body 1 on body 2 in the last solution, at the collocation point of each element's equation: the
        /// distance slid [m] in a step or a rigid shift, the slip velocity over the rolling velocity, s/V [-], in a
        /// steady solution. 0 across the direction of a model of one.
        ElementVectors slip() const;

        /// Contribution of each element to FrictionStep::slip_work, whose comment says when a contribution may be
        /// negative: [J], or [J/m] for a steady solution. Divided by the element's area (on a line its width times
        /// Contact::width()) it is the work per area of contact, on which wear depends.
        const VectorX<double>& slip_work() const;

    private:
        friend class FrictionModel;
        explicit Workspace(const detail::FrictionData& data);

        detail::Hidden<detail::FrictionScratch> scratch_;  // none only where it was moved from
    };

    /// One direction of a line contact: `direction`, 0 longitudinal or 1 lateral, is the direction of the system's
    /// kernel. Two directions of a line contact. A patch, whose half_length() is the system's unit of length. `verdict`
    /// judges `system`, or is `unchecked`. A system without G needs no verdict, no finite half-width and no known
    /// points. Throws std::invalid_argument
    /// - if the verdict does not belong to this system or does not establish that no eigenvalue grows,
    /// - if steady rolling shows that the scheme does not converge (Status::assists_creepage),
    /// - if a line contact's half-width is infinite or differs from the half-width of the system's kernel,
    /// - if the system of a patch is not the system of a PatchMesh, or is made for another a/b,
    /// - if the law does not meet the requirements of Friction (one pressure per element of the mesh),
    /// - if the law has a memory although the points of the system's equations are unknown,
    /// - for Integrator::matrix_exponential, which cannot treat friction, and for any other direction.
    FrictionModel(const Contact& contact, ElementSystem<double> system, const StabilityVerdict& verdict,
                  const Friction& friction, Integrator integrator = Integrator::sdirk2, Eigen::Index direction = 0);
    FrictionModel(const Contact& contact, ElementSystem<double, 2> system, const StabilityVerdict& verdict,
                  const Friction& friction, Integrator integrator = Integrator::sdirk2);
    FrictionModel(const PatchContact& contact, ElementSystem<double, 2> system, const StabilityVerdict& verdict,
                  const Friction& friction, Integrator integrator = Integrator::sdirk2);
    /// Models of systems without G, for steady rolling alone.
    FrictionModel(const Contact& contact, ElementSystem<double> system, const Friction& friction,
                  Eigen::Index direction = 0);
    FrictionModel(const Contact& contact, ElementSystem<double, 2> system, const Friction& friction);
    FrictionModel(const PatchContact& contact, ElementSystem<double, 2> system, const Friction& friction);

    int directions() const;     ///< of creepage: 1 or 2
    Eigen::Index size() const;  ///< number of unknown elements
    /// Fingerprint of G', the areas of the elements, the contact and the pressures; G and the law do not enter. To
    /// continue a state under another load, pass the load to a step; a model with other pressures refuses the state.
    std::uint64_t fingerprint() const;
    Integrator integrator() const;
    /// Whether the scheme converges to full adhesion. Only a model of a system without G can return false, and none
    /// that is made `unchecked`.
    bool converges() const;

    /// The state at rest under the pressures of the model: no traction, all elements stick, mu = mu_s(0).
    State at_rest() const;
    /// The state at rest under a load. Throws std::invalid_argument if the mesh cannot carry the load.
    State at_rest(const NormalLoad& load) const;
    Workspace workspace() const;

    /// The force of a state [N]. The state must have size() elements.
    Force force(const State& state) const;

    /// Elastic energy of the tangential tractions in both bodies, E = 1/2 int p u dA [J], summed over the
    /// directions. Positive, except for tractions that alternate from element to element; of
    /// second order in 1/n on cosine meshes at alpha = 0.5. The state must have size() elements; NaN if the system
    /// cannot represent its half-length.
    ///
    /// The work that the rigid bodies do on the contact, -F times the rigid slip (creepage times the distance rolled),
    /// becomes heat or elastic energy, even while the load or the length of the contact varies: heat = -F slip - dE,
    /// for any scheme. The sum of FrictionStep::slip_work agrees with it to the orders of both in n and dq.
    double elastic_energy(const State& state) const;

    /// Solves for steady rolling with the creepage [-] at the end of the step's motion, which must not be a shift, at
    /// the speed V > 0 [m/s] of its travel, which a constant coefficient does not need. The search starts from the
    /// zones and coefficients of `from`. If the semi-axes of the load differ from the contact's, the system must be
    /// able to breathe. `to` must be another state with the same number of elements; it is not written if the status is
    /// wrong_state, invalid_load, invalid_step or needs_fixed_mesh or the creepage is not finite. The status is
    /// no_solution also if the iteration for coefficients and slip does not converge. Tangents hold at constant speed.
    /// Does not allocate.
    Step steady(const State& from, const RollingStep& step, State& to, Workspace& workspace) const noexcept;

    /// Rolls by travel.dq [m], positive and finite, or 0 for a rigid shift [m] of body 1 on body 2 without rolling, in
    /// travel.duration [s], positive and finite if mu depends on slip. `to` must be another state with the same number
    /// of elements. It is not written if the status is invalid_step, wrong_state, invalid_load, needs_fixed_mesh or
    /// needs_places (spin, but the places of the equations are unknown) or the motion is not finite; if the result is
    /// not finite, it becomes a copy of `from`. The status is wrong_state also if a coefficient of `from` is negative
    /// or not finite, and no_solution also if the iteration for coefficients and slip does not converge. Tangents hold
    /// at constant dq and duration. The result depends on `from` and the step alone, to the last bit. Does not
    /// allocate; a new dq costs a factorisation.
    ///
    /// If the system can breathe (log_strength), the mesh follows the half-length of the load, |da| < dq; a new
    /// half-length costs a factorisation, new pressures do not. Let steps end at kinks of the load, or sdirk2 loses its
    /// second order. With a memory, the tangent by the half-length is one-sided if a particle arrives exactly from a
    /// collocation point.
    Step advance(const State& from, const RollingStep& step, State& to, Workspace& workspace) const noexcept;

private:
    std::shared_ptr<const detail::FrictionData> data_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/model.ipp"
#endif
