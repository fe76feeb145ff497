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

/// SteadyFrictionModel with mu of the slip velocity. Const and free of caches: threads may share it, as far as they may
/// share the law.
///
/// Where mu falls steeply and has no memory, there may be several solutions at one creepage, which differ in where slip
/// begins. The one returned is as a rule the nearest to `from`, so that a creep curve that starts each point from the
/// one before follows its branch until that ends. From at_rest(), where mu = mu_s(0) everywhere, it is the branch of
/// high friction.
///
///     const SteadyFallingModel model(contact, mesh, scheme, kernel, FallingFriction<ExponentialFall<>>{law, memory, p});
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

    /// Throws std::invalid_argument as SteadyFrictionModel, and where mu_s(0) or the memory is negative or not finite.
    template <RollingScheme<Scalar> Scheme, LineKernel Kernel>
    SteadyFallingModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                       const Kernel& kernel, const FallingFriction<Law, Scalar>& friction)
        : model_(contact, mesh, scheme, kernel, detail::checked_pressure("SteadyFallingModel", friction)),
          friction_(detail::without_pressure(friction)) {}

    /// From a ready G' (in units of 1/G) and the widths of its elements (in units of a).
    SteadyFallingModel(const Contact<Scalar>& contact, MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths,
                       const FallingFriction<Law, Scalar>& friction)
        : model_(contact, std::move(G_prime), widths, detail::checked_pressure("SteadyFallingModel", friction)),
          friction_(detail::without_pressure(friction)) {}

    Eigen::Index size() const { return model_.size(); }                 ///< number of unknown elements
    std::uint64_t fingerprint() const { return model_.fingerprint(); }  ///< of G', widths, contact and pressures

    /// No traction anywhere, everything sticks at mu_s(0).
    State at_rest() const {
        return {model_.at_rest(), ArrayX<Scalar>::Constant(size(), static_cast<Scalar>(friction_.law(Scalar(0))))};
    }
    Workspace workspace() const { return Workspace(size()); }

    /// The solution at a creepage [-] and a speed V > 0 [m/s], sought from zones and coefficients of `from`. As
    /// SteadyFrictionModel::solve; besides, the status is invalid_step where the speed is not positive and finite, and
    /// no_solution where coefficients and slip did not come to agree: then complementarity_residual is no less than what
    /// a coefficient is off by. Tangents are by the creepage at this speed.
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
        detail::hand_over(step, from, workspace.scratch_.friction, to);
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
