// Steady rolling with friction that depends on the velocity of slip, s/V = xi - G' p.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>
#include <utility>

#include "../detail/finite.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../scene/contact.hpp"
#include "../status.hpp"
#include "detail/falling_stages.hpp"
#include "falling_state.hpp"
#include "slip_law.hpp"
#include "state.hpp"
#include "steady.hpp"

namespace rollbem {

/// SteadyFrictionModel with a coefficient of friction that depends on the slip velocity. Immutable: threads may share
/// it if they may share the law.
///
/// If mu falls steeply and has no memory, several solutions may exist at one creepage, which differ in where slip
/// begins. The solver usually returns the one nearest to `from`, so that a creep curve whose points start from their
/// predecessors follows its branch until the branch ends. From at_rest(), where mu = mu_s(0) everywhere, it finds the
/// branch of high friction.
///
///     const FallingFriction<ExponentialFall<>> friction{law, memory, pressure};
///     const SteadyFallingModel model(contact, mesh, scheme, kernel, friction);
///     FallingFrictionWorkspace<double> workspace = model.workspace();
///     FallingFrictionState<double> now = model.at_rest(), next = now;
///     const FrictionStep<double> point = model.solve(now, creepage, speed, next, workspace);
template <class Law_, class Scalar_ = double>
class SteadyFallingModel {
public:
    using Law = Law_;
    using Scalar = Scalar_;
    using State = FallingFrictionState<Scalar>;
    using Step = FrictionStep<Scalar>;
    using Workspace = FallingFrictionWorkspace<Scalar>;
    static_assert(SlipLaw<Law, Scalar>);

    /// Throws std::invalid_argument if SteadyFrictionModel does, or if mu_s(0) or the memory is negative or not finite.
    template <RollingScheme<Scalar> Scheme, LineKernel Kernel>
    SteadyFallingModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                       const Kernel& kernel, const FallingFriction<Law, Scalar>& friction)
        : model_(contact, mesh, scheme, kernel, detail::checked_pressure("SteadyFallingModel", friction)),
          friction_(detail::without_pressure(friction)) {}

    /// From a given matrix G' (in units of 1/G) and the widths of its elements (in units of a).
    SteadyFallingModel(const Contact<Scalar>& contact, MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths,
                       const FallingFriction<Law, Scalar>& friction)
        : model_(contact, std::move(G_prime), widths, detail::checked_pressure("SteadyFallingModel", friction)),
          friction_(detail::without_pressure(friction)) {}

    Eigen::Index size() const { return model_.size(); }                 ///< number of unknown elements
    std::uint64_t fingerprint() const { return model_.fingerprint(); }  ///< of G', widths, contact and pressures

    /// No traction, all elements stick, mu = mu_s(0).
    State at_rest() const {
        return detail::with_coefficients<State>(model_.at_rest(), static_cast<Scalar>(friction_.law(Scalar(0))));
    }
    Workspace workspace() const { return Workspace(size()); }

    /// The solution at a creepage [-] and a speed V > 0 [m/s], starting from zones and coefficients of `from`. As
    /// SteadyFrictionModel::solve; in addition, the status is invalid_step if the speed is not positive and finite,
    /// wrong_state if a coefficient of `from` is negative or not finite, and no_solution if coefficients and slip do
    /// not come to agree: complementarity_residual is then at least the error of a coefficient. The tangent holds the
    /// speed constant.
    Step solve(const State& from, Scalar creepage, Scalar speed, State& to, Workspace& workspace) const noexcept {
        StepStatus possible = model_.check(from, to, workspace);
        if (possible == StepStatus::ok && !detail::fits_friction(from, to, size())) possible = StepStatus::wrong_state;
        if (possible == StepStatus::ok && !detail::is_finite(creepage)) possible = StepStatus::not_finite;
        if (possible == StepStatus::ok && !(detail::is_finite(speed) && speed > 0)) possible = StepStatus::invalid_step;
        if (possible != StepStatus::ok) return Core::failed(possible);
        detail::FallingStages<Law, detail::ActiveSetSlip<Scalar>> stages(
            friction_.law, friction_.memory, from.friction_coefficient, speed, model_.core_.widths(), from.half_length,
            friction_.with_tangents, workspace.scratch_);
        const Step step = model_.solve(stages, from, creepage, to, workspace);
        detail::hand_over(step, from, stages, to);
        return step;
    }

private:
    using Core = detail::FrictionCore<Scalar>;

    SteadyFrictionModel<Scalar> model_;
    FallingFriction<Law, Scalar> friction_;  // without pressures
};

template <class Scalar, class Scheme, class Kernel, class Law>
SteadyFallingModel(const Contact<Scalar>&, const Mesh<Scalar>&, const Scheme&, const Kernel&,
                   const FallingFriction<Law, Scalar>&) -> SteadyFallingModel<Law, Scalar>;

}  // namespace rollbem
