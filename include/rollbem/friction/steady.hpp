// Steady rolling with Coulomb friction: s/V = xi - G' p, stick and slip found by the solver.
// One model for a whole creep curve; each point starts from the one before.
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

/// Steady rolling of one contact, mesh, scheme and law of friction at any creepage. Const and free of caches: threads
/// may share it. Creepage xi > 0 gives a negative force.
///
/// The scheme must converge, which nothing here checks: the forces of one that does not (alpha < 0, or alpha > 1) are
/// wrong wherever elements stick, whatever the status. Ask solve_steady(G_prime, widths) of steady.hpp before, whose
/// status must not be inconsistent. Steady rolling asks for no stability in time.
///
/// Equations about the centres (alpha = 0) are a case of their own: inconsistent in full adhesion, right with friction.
/// They lose no energy, and full adhesion, which loses it at the singular trailing edge, comes out without force. Slip
/// is a loss they know: the force converges, of first order, from where several elements slip at the trailing edge.
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

    /// Throws std::invalid_argument as assemble_G_prime does, where the law breaks what CoulombFriction asks for, and
    /// where the kernel's half-width is not the contact's.
    template <RollingScheme<Scalar> Scheme, LineKernel Kernel>
    SteadyFrictionModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                        const Kernel& kernel, const CoulombFriction<Scalar>& friction)
        : SteadyFrictionModel(Checked{}, contact, assemble_G_prime(mesh, scheme, kernel), unknown_widths(mesh, scheme),
                              detail::equation_points(mesh, scheme),
                              detail::checked_friction("SteadyFrictionModel", friction, mesh.size(),
                                                       unknown_count(scheme, mesh.size()))) {
        detail::require_same_aspect("SteadyFrictionModel", contact, detail::aspect_of<Scalar>(kernel));
    }

    /// From a ready G' (in units of 1/G) and the widths of its elements (in units of a); the law has as many pressures.
    /// Throws std::invalid_argument as above, and where sizes differ, an entry is not finite or a width is not
    /// positive. That G has not taken the place of G' cannot be seen here: ElementSystem, which has both, sees it.
    SteadyFrictionModel(const Contact<Scalar>& contact, MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths,
                        const CoulombFriction<Scalar>& friction)
        : SteadyFrictionModel(Checked{}, contact, std::move(G_prime), widths, std::nullopt,
                              detail::checked_friction("SteadyFrictionModel", friction, widths.size(), widths.size())) {
    }

    Eigen::Index size() const { return core_.size(); }                 ///< number of unknown elements
    std::uint64_t fingerprint() const { return core_.fingerprint(); }  ///< of G', widths, contact and pressures

    /// No traction anywhere, everything sticks: the start of a first solution.
    State at_rest() const { return core_.at_rest(); }
    Workspace workspace() const { return Workspace(size()); }

    /// The solution at a creepage [-], sought from the zones of `from`. `to` must be another state of as many elements;
    /// it is left alone where the status is wrong_state, invalid_load or needs_fixed_mesh or the creepage is not finite.
    /// `from` keeps the pressures that it lives under; its half-length must be the contact's. No allocation.
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

    struct Checked {};  // tells the constructor from the one whose law may come in braces

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
