// Steady rolling with Coulomb friction: s/V = xi - G' p, with stick and slip found by the solver.
// One model serves for a whole creep curve; each point starts from the previous one.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>
#include <optional>
#include <utility>

#include "../assembly/influence.hpp"
#include "../assembly/rolling_system.hpp"
#include "../detail/finite.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../scene/contact.hpp"
#include "detail/core.hpp"
#include "law.hpp"
#include "state.hpp"
#include "workspace.hpp"

namespace rollbem {

/// Steady rolling of one contact, mesh, scheme and friction law at any creepage. Immutable: threads may share it.
/// Creepage xi > 0 gives a negative force.
///
/// The scheme must be convergent, which is not checked here: a scheme that is not (alpha < 0, or alpha > 1) gives wrong
/// forces wherever elements stick, whatever the status. solve_steady(G_prime, widths) of steady.hpp detects such
/// schemes by the status inconsistent. Steady rolling does not require stability in time.
///
/// Collocation at the centres (alpha = 0) is a special case: inconsistent in full adhesion, but correct with friction.
/// It dissipates no energy, whereas full adhesion loses energy at the singular trailing edge; the force of full
/// adhesion is therefore zero. Dissipation by slip is represented: the force converges, with first order, once several
/// elements slip at the trailing edge.
///
///     const SteadyFrictionModel<double> model(contact, mesh, scheme, kernel, friction);
///     FrictionWorkspace<double> workspace = model.workspace();
///     FrictionState<double> now = model.at_rest(), next = now;
///     for (double creepage : curve) {
///         const FrictionStep<double> point = model.solve(now, creepage, next, workspace);
///         std::swap(now, next);
///     }
template <class Scalar_ = double>
class SteadyFrictionModel {
public:
    using Scalar = Scalar_;
    using State = FrictionState<Scalar>;
    using Step = FrictionStep<Scalar>;
    using Workspace = FrictionWorkspace<Scalar>;

    /// Throws std::invalid_argument if assemble_G_prime refuses the scheme, if the law does not meet the requirements
    /// of CoulombFriction, or if the kernel's half-width is not the contact's.
    template <RollingScheme<Scalar> Scheme, LineKernel Kernel>
    SteadyFrictionModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                        const Kernel& kernel, const CoulombFriction<Scalar>& friction)
        : SteadyFrictionModel(Checked{}, contact, assemble_G_prime(mesh, scheme, kernel), unknown_widths(mesh, scheme),
                              detail::equation_points(mesh, scheme),
                              detail::checked_friction("SteadyFrictionModel", friction, mesh.size(),
                                                       unknown_count(scheme, mesh))) {
        detail::require_same_aspect("SteadyFrictionModel", contact, detail::aspect_of<Scalar>(kernel));
    }

    /// From a given matrix G' (in units of 1/G) and the widths of its elements (in units of a); the law has one
    /// pressure per element. Throws std::invalid_argument if the law does not meet the requirements of CoulombFriction,
    /// sizes differ, an entry is not finite or a width is not positive. G passed in place of G' is not detected here,
    /// but ElementSystem, which has both, detects it.
    SteadyFrictionModel(const Contact<Scalar>& contact, MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths,
                        const CoulombFriction<Scalar>& friction)
        : SteadyFrictionModel(Checked{}, contact, std::move(G_prime), widths, std::nullopt,
                              detail::checked_friction("SteadyFrictionModel", friction, widths.size(), widths.size())) {
    }

    Eigen::Index size() const { return core_.size(); }                 ///< number of unknown elements
    std::uint64_t fingerprint() const { return core_.fingerprint(); }  ///< of G', widths, contact and pressures

    /// No traction, all elements stick: the starting point for a first solution.
    State at_rest() const { return core_.at_rest(); }
    Workspace workspace() const { return Workspace(size()); }

    /// The solution at a creepage [-] under the pressures of `from`, starting from its zones; the half-length of `from`
    /// must be the contact's. `to` must be another state with the same number of elements; it is not written if the
    /// status is wrong_state, invalid_load or needs_fixed_mesh or the creepage is not finite. Does not allocate.
    Step solve(const State& from, Scalar creepage, State& to, Workspace& workspace) const noexcept {
        const StepStatus possible = check(from, to, workspace);
        if (possible != StepStatus::ok) return Core::failed(possible);
        detail::ConstantStages<Scalar> stages;
        return solve(stages, from, creepage, to, workspace);
    }

private:
    using Core = detail::FrictionCore<Scalar>;
    template <class, class>
    friend class SteadyFallingModel;

    StepStatus check(const State& from, const State& to, const Workspace& workspace) const noexcept {
        if (!core_.fits(from, to, workspace)) return StepStatus::wrong_state;
        const StepStatus possible = core_.check_load(from);
        if (possible != StepStatus::ok) return possible;
        return from.half_length == core_.half_length() ? StepStatus::ok : StepStatus::needs_fixed_mesh;
    }

    template <class Stages>
    Step solve(Stages& stages, const State& from, Scalar creepage, State& to, Workspace& workspace) const noexcept {
        return core_.solve_steady(stages, from, creepage, G_prime_, {from.normal_pressure, from.half_length}, to,
                                  workspace);
    }

    struct Checked {};  // distinguishes this constructor from the one whose law may be given in braces

    SteadyFrictionModel(Checked, const Contact<Scalar>& contact, MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths,
                        const std::optional<ArrayX<Scalar>>& points, CoulombFriction<Scalar> friction)
        : core_(contact, widths, points, std::move(friction), fingerprint_of(G_prime, widths)),
          G_prime_(std::move(G_prime)) {
        const Eigen::Index n = size();
        detail::require(G_prime_.rows() == n, "SteadyFrictionModel", "number of rows of G_prime", G_prime_.rows(),
                        "equal the number of widths");
        detail::require(G_prime_.cols() == n, "SteadyFrictionModel", "number of columns of G_prime", G_prime_.cols(),
                        "equal the number of widths");
        detail::require_finite("SteadyFrictionModel", "G_prime", G_prime_);
        for (Eigen::Index i = 0; i < n; ++i) {
            detail::require(detail::is_finite(widths[i]) && widths[i] > 0, "SteadyFrictionModel", "width", widths[i],
                            "be positive and finite");
        }
    }

    static std::uint64_t fingerprint_of(const MatrixX<Scalar>& G_prime, const ArrayX<Scalar>& widths) {
        detail::Fingerprint fingerprint;
        fingerprint.add(G_prime);
        fingerprint.add(widths);
        return fingerprint.value();
    }

    Core core_;
    MatrixX<Scalar> G_prime_;
};

}  // namespace rollbem
