// Steady rolling with friction: s/V = xi - G' p, with stick and slip found by the solver, under longitudinal creepage
// or under longitudinal and lateral creepage. One model serves for a whole creep curve; each point starts from the
// previous one.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <Eigen/Core>

#include "../adhesion/integrator.hpp"
#include "../assembly/influence.hpp"
#include "../assembly/patch_system.hpp"
#include "../assembly/rolling_system.hpp"
#include "../detail/fingerprint.hpp"
#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../elasticity/rectangle_kernel.hpp"
#include "../scene/contact.hpp"
#include "../scene/contact_units.hpp"
#include "../scene/patch_contact.hpp"
#include "../system/contact_fit.hpp"
#include "../system/element_blocks.hpp"
#include "detail/convergence.hpp"
#include "detail/core.hpp"
#include "law.hpp"
#include "state.hpp"
#include "workspace.hpp"

namespace rollbem {

/// Steady rolling of one contact, mesh, scheme and friction law at any creepage. It needs G' alone: no kernel must be
/// integrated for G, no eigenvalue judged, and the half-width may be infinite. Immutable: threads may share it if they
/// may share the law. A creepage xi > 0 gives a negative force. Its states are those of a FrictionModel with the same
/// contact, G' and pressures, and so start a run in time.
///
/// With two directions, slip and traction are vectors. In full sliding the force opposes the creepage exactly,
/// otherwise only approximately, because the bodies are more compliant across the rolling direction. One direction
/// costs less.
///
/// If the scheme does not converge to full adhesion (alpha <= 0, or alpha > 1), the forces would be wrong wherever
/// elements stick: the status of every solution is then StepStatus::assists_creepage, with the residual but without
/// numbers, unless the model is made `unchecked`. Collocation at the centres (alpha = 0) is a special case: its
/// tractions assist the creepage in full adhesion, but are correct with friction. It dissipates no energy, whereas full
/// adhesion loses energy at the singular trailing edge; the force of full adhesion is therefore zero. Dissipation by
/// slip is represented: the force converges, with first order, once several elements slip at the trailing edge.
///
/// If mu falls steeply with slip and has no memory, several solutions may exist at one creepage, which differ in where
/// slip begins. The solver usually returns the one nearest to `from`, so that a creep curve whose points start from
/// their predecessors follows its branch until the branch ends. From at_rest(), where mu = mu_s(0) everywhere, it finds
/// the branch of high friction.
///
///     const SteadyFrictionModel model(contact, mesh, scheme, kernel, {0.3, pressure});
///     FrictionWorkspace<> workspace = model.workspace();
///     FrictionState<> now = model.at_rest(), next = now;
///     for (double creepage : curve) {
///         const FrictionStep<> point = model.steady(now, creepage, next, workspace);
///         std::swap(now, next);
///     }
///
/// and in both directions
///
///     const SteadyFrictionModel model(contact, mesh, scheme, StripKernel<double>::longitudinal(contact),
///                                     StripKernel<double>::lateral(contact), {0.3, pressure});
///     FrictionState<2> now = model.at_rest(), next = now;
///     const FrictionStep<2> point = model.steady(now, {1e-3, 5e-4}, next, workspace);
///
/// and on a patch, with spin [1/m] and the moment about its middle
///
///     const SteadyFrictionModel model(contact, patch_mesh(contact, 12, 12), NodeDifference{Nodes::chebyshev},
///                                     HalfSpace<double>(contact.poisson_ratio()), {0.3, pressure});
///     const FrictionStep<2> point = model.steady(now, {1e-3, 5e-4, 0.1}, next, workspace);
template <class Law_ = ConstantFriction<double>, int directions_ = 1, class Scalar_ = double>
class SteadyFrictionModel {
public:
    using Law = Law_;
    using Scalar = Scalar_;
    static constexpr int directions = directions_;
    static_assert(SlipLaw<Law, Scalar>);

private:
    using Core = detail::FrictionCore<Law, directions, Scalar>;

public:
    using State = FrictionState<directions, Scalar>;
    using Step = FrictionStep<directions, Scalar>;
    using Workspace = FrictionWorkspace<directions, Scalar>;
    using Value = typename Core::Value;        ///< a creepage: a number, or Creepage with two directions
    using Gradient = typename Core::Gradient;  ///< G': a matrix, or DirectionBlocks with two directions

    /// Throws std::invalid_argument if assemble_G_prime refuses the scheme, if the law does not meet the requirements
    /// of Friction, or if the kernel's half-width is not the contact's.
    template <RollingScheme<Scalar> Scheme, ElementKernel Kernel>
    requires(directions_ == 1)
        SteadyFrictionModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                            const Kernel& kernel, const Friction<Law, Scalar>& friction, Checks checks = {})
        : SteadyFrictionModel(Made{}, contact, assemble_G_prime(mesh, scheme, kernel), line_elements(mesh, scheme),
                              mesh.size(), friction, checks) {
        detail::require_same_aspect(name, contact, detail::aspect_of<Scalar>(kernel));
    }
    /// The kernels of both directions.
    template <RollingScheme<Scalar> Scheme, ElementKernel Kernel>
    requires(directions_ == 2)
        SteadyFrictionModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                            const Kernel& longitudinal, const Kernel& lateral, const Friction<Law, Scalar>& friction,
                            Checks checks = {})
        : SteadyFrictionModel(Made{}, contact,
                              detail::uncoupled<Scalar>(assemble_G_prime(mesh, scheme, longitudinal),
                                                        assemble_G_prime(mesh, scheme, lateral)),
                              line_elements(mesh, scheme), mesh.size(), friction, checks) {
        detail::require_same_aspect(name, contact, detail::aspect_of<Scalar>(longitudinal));
        detail::require_same_aspect(name, contact, detail::aspect_of<Scalar>(lateral));
    }

    /// A patch. The mesh must be in units of the contact's half_length(), as patch_mesh makes it; of an ellipse that is
    /// checked. Throws std::invalid_argument also unless the scheme takes differences of u and fits the strips' mesh, or
    /// if the law does not meet the requirements of Friction.
    template <RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
    requires(directions_ == 2)
        SteadyFrictionModel(const PatchContact<Scalar>& contact, const PatchMesh<Scalar>& mesh, const Scheme& scheme,
                            const Kernel& kernel, const Friction<Law, Scalar>& friction, Checks checks = {})
        : SteadyFrictionModel(Made{}, contact, assemble_G_prime(mesh, scheme, kernel), patch_elements(mesh, scheme),
                              mesh.size(), friction, checks) {
        if (contact.outline()) return;
        const Scalar ratio = contact.a_over_b() * (mesh.edges()[mesh.strip_count()] - mesh.edges()[0]) / 2;
        const bool same = std::abs(ratio - 1) <= Scalar(1e-12) + 4 * std::numeric_limits<Scalar>::epsilon();
        detail::require(same, name, "height of the mesh over that of the contact", ratio, "be 1");
    }

    /// From a given matrix G' (in units of 1/G) and the widths of its elements (in units of a); the law has one
    /// pressure per element. Throws std::invalid_argument if the law does not meet the requirements of Friction, sizes
    /// differ, an entry is not finite or a width is not positive. G passed in place of G' is not detected here, but
    /// ElementSystem, which has both, detects it.
    SteadyFrictionModel(const Contact<Scalar>& contact, MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths,
                        const Friction<Law, Scalar>& friction, Checks checks = {}) requires(directions_ == 1)
        : SteadyFrictionModel(Made{}, contact, std::move(G_prime), Elements<Scalar>::unplaced(widths), widths.size(),
                              friction, checks) {}
    /// From the matrices of both directions.
    SteadyFrictionModel(const Contact<Scalar>& contact, const MatrixX<Scalar>& longitudinal_G_prime,
                        const MatrixX<Scalar>& lateral_G_prime, const ArrayX<Scalar>& widths,
                        const Friction<Law, Scalar>& friction, Checks checks = {}) requires(directions_ == 2)
        : SteadyFrictionModel(Made{}, contact, detail::uncoupled<Scalar>(longitudinal_G_prime, lateral_G_prime),
                              Elements<Scalar>::unplaced(widths), widths.size(), friction, checks) {}

    Eigen::Index size() const { return core_.size(); }  ///< number of unknown elements
    /// Of G', the elements, the contact and the pressures, but not of the law.
    std::uint64_t fingerprint() const { return core_.fingerprint(); }
    /// Whether the scheme converges to full adhesion; always true if `unchecked`.
    bool converges() const { return converges_; }

    /// No traction, all elements stick, mu = mu_s(0): the starting point for a first solution.
    State at_rest() const { return core_.at_rest(); }
    Workspace workspace() const { return core_.workspace(); }

    /// The solution at a creepage [-] and a speed V > 0 [m/s], which a constant coefficient does not need, under the
    /// pressures of `from`, starting from its zones and coefficients; the half-length of `from` must be the contact's.
    /// `to` must be another state with the same number of elements; it is not written if the status is wrong_state,
    /// invalid_load, invalid_step or needs_fixed_mesh or the creepage is not finite. The status is no_solution also if
    /// coefficients and slip do not come to agree. Tangents are at constant speed. Does not allocate.
    Step steady(const State& from, const Value& creepage, Scalar speed, State& to,
                Workspace& workspace) const noexcept {
        StepStatus possible = core_.check(from, to, workspace);
        if (possible == StepStatus::ok && core_.axes(from) != detail::contact_axes<Scalar>) {
            possible = StepStatus::needs_fixed_mesh;
        }
        if (possible != StepStatus::ok) return Core::failed(possible);
        const Step step =
            core_.solve_steady(G_prime_, nullptr, from, creepage, speed, Core::load_of(from), to, workspace);
        return converges_ ? step : Core::without_forces(step);
    }
    Step steady(const State& from, const Value& creepage, State& to, Workspace& workspace) const noexcept
        requires(!Core::slip_dependent) {
        return steady(from, creepage, 1, to, workspace);
    }

private:
    static constexpr const char* name = "SteadyFrictionModel";

    struct Made {};  // distinguishes this constructor from those whose law may be given in braces

    SteadyFrictionModel(Made, const detail::ContactUnits<Scalar>& contact, Gradient G_prime,
                        const Elements<Scalar>& elements, Eigen::Index element_count,
                        const Friction<Law, Scalar>& friction, Checks checks)
        : core_(name, contact, elements, element_count, friction, G_prime), G_prime_(std::move(G_prime)) {
        elements.require_valid(name, "width");
        detail::require_gradient(name, G_prime_, size());
        converges_ = !checks.wanted || detail::converges(G_prime_, elements.areas);
    }

    Core core_;
    Gradient G_prime_;
    bool converges_ = true;
};

template <class Scalar, class Scheme, class Kernel, class Law>
SteadyFrictionModel(const Contact<Scalar>&, const Mesh<Scalar>&, const Scheme&, const Kernel&,
                    const Friction<Law, Scalar>&, Checks = {}) -> SteadyFrictionModel<Law, 1, Scalar>;
template <class Scalar, class Scheme, class Kernel>
SteadyFrictionModel(const Contact<Scalar>&, const Mesh<Scalar>&, const Scheme&, const Kernel&,
                    const Friction<ConstantFriction<Scalar>, Scalar>&, Checks = {})
    -> SteadyFrictionModel<ConstantFriction<Scalar>, 1, Scalar>;
template <class Scalar, class Scheme, class Kernel, class Law>
SteadyFrictionModel(const Contact<Scalar>&, const Mesh<Scalar>&, const Scheme&, const Kernel&, const Kernel&,
                    const Friction<Law, Scalar>&, Checks = {}) -> SteadyFrictionModel<Law, 2, Scalar>;
template <class Scalar, class Scheme, class Kernel>
SteadyFrictionModel(const Contact<Scalar>&, const Mesh<Scalar>&, const Scheme&, const Kernel&, const Kernel&,
                    const Friction<ConstantFriction<Scalar>, Scalar>&, Checks = {})
    -> SteadyFrictionModel<ConstantFriction<Scalar>, 2, Scalar>;
template <class Scalar, class Scheme, class Kernel, class Law>
SteadyFrictionModel(const PatchContact<Scalar>&, const PatchMesh<Scalar>&, const Scheme&, const Kernel&,
                    const Friction<Law, Scalar>&, Checks = {}) -> SteadyFrictionModel<Law, 2, Scalar>;
template <class Scalar, class Scheme, class Kernel>
SteadyFrictionModel(const PatchContact<Scalar>&, const PatchMesh<Scalar>&, const Scheme&, const Kernel&,
                    const Friction<ConstantFriction<Scalar>, Scalar>&, Checks = {})
    -> SteadyFrictionModel<ConstantFriction<Scalar>, 2, Scalar>;
template <class Scalar, class Law>
SteadyFrictionModel(const Contact<Scalar>&, MatrixX<Scalar>, const ArrayX<Scalar>&, const Friction<Law, Scalar>&,
                    Checks = {}) -> SteadyFrictionModel<Law, 1, Scalar>;
template <class Scalar>
SteadyFrictionModel(const Contact<Scalar>&, MatrixX<Scalar>, const ArrayX<Scalar>&,
                    const Friction<ConstantFriction<Scalar>, Scalar>&, Checks = {})
    -> SteadyFrictionModel<ConstantFriction<Scalar>, 1, Scalar>;
template <class Scalar, class Law>
SteadyFrictionModel(const Contact<Scalar>&, MatrixX<Scalar>, MatrixX<Scalar>, const ArrayX<Scalar>&,
                    const Friction<Law, Scalar>&, Checks = {}) -> SteadyFrictionModel<Law, 2, Scalar>;
template <class Scalar>
SteadyFrictionModel(const Contact<Scalar>&, MatrixX<Scalar>, MatrixX<Scalar>, const ArrayX<Scalar>&,
                    const Friction<ConstantFriction<Scalar>, Scalar>&, Checks = {})
    -> SteadyFrictionModel<ConstantFriction<Scalar>, 2, Scalar>;

}  // namespace rollbem
