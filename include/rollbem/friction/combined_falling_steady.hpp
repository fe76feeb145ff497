// Steady rolling under longitudinal and lateral creepage with friction that depends on the velocity of slip.
// s/V = xi - G' p in both directions, |p| <= mu p_n with mu of |s|, and slip against traction as vectors.
#pragma once

#include "../detail/language.hpp"

#include <cstdint>
#include <utility>

#include "../detail/finite.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../scene/contact.hpp"
#include "../scene/creepage.hpp"
#include "../status.hpp"
#include "combined_falling_state.hpp"
#include "combined_state.hpp"
#include "combined_steady.hpp"
#include "detail/falling_stages.hpp"
#include "falling_state.hpp"
#include "slip_law.hpp"

namespace rollbem {

/// SteadyCombinedModel with mu of the slip velocity, the length of its vector. Const and free of caches: threads may
/// share it if they may share the law. Where several solutions exist, which one is returned is as in
/// SteadyFallingModel, which is for one direction of creepage and costs less.
///
///     const SteadyCombinedFallingModel model(contact, mesh, scheme, StripKernel<double>::longitudinal(contact),
///                                            StripKernel<double>::lateral(contact),
///                                            FallingFriction<ExponentialFall<>>{law, memory, pressure});
///     CombinedFallingWorkspace<double> workspace = model.workspace();
///     CombinedFallingState<double> now = model.at_rest(), next = now;
///     const CombinedFrictionStep<double> point = model.solve(now, {1e-3, 5e-4}, speed, next, workspace);
template <class Law_, class Scalar_ = double>
class SteadyCombinedFallingModel {
public:
    using Law = Law_;
    using Scalar = Scalar_;
    using State = CombinedFallingState<Scalar>;
    using Step = CombinedFrictionStep<Scalar>;
    using Workspace = CombinedFallingWorkspace<Scalar>;
    static_assert(SlipLaw<Law, Scalar>);

    /// The kernels of both directions. Throws std::invalid_argument as SteadyCombinedModel does, and if mu_s(0) or the
    /// memory is negative or not finite.
    template <RollingScheme<Scalar> Scheme, LineKernel Kernel>
    SteadyCombinedFallingModel(const Contact<Scalar>& contact, const Mesh<Scalar>& mesh, const Scheme& scheme,
                               const Kernel& longitudinal, const Kernel& lateral,
                               const FallingFriction<Law, Scalar>& friction)
        : model_(contact, mesh, scheme, longitudinal, lateral, detail::checked_pressure(name, friction)),
          friction_(detail::without_pressure(friction)) {}

    /// From ready G' of both directions (in units of 1/G) and the widths of the elements (in units of a).
    SteadyCombinedFallingModel(const Contact<Scalar>& contact, MatrixX<Scalar> longitudinal_G_prime,
                               MatrixX<Scalar> lateral_G_prime, const ArrayX<Scalar>& widths,
                               const FallingFriction<Law, Scalar>& friction)
        : model_(contact, std::move(longitudinal_G_prime), std::move(lateral_G_prime), widths,
                 detail::checked_pressure(name, friction)),
          friction_(detail::without_pressure(friction)) {}

    Eigen::Index size() const { return model_.size(); }                 ///< number of unknown elements
    std::uint64_t fingerprint() const { return model_.fingerprint(); }  ///< of the G', widths, contact and pressures

    /// No traction anywhere, everything sticks at mu_s(0).
    State at_rest() const {
        return detail::with_coefficients<State>(model_.at_rest(), static_cast<Scalar>(friction_.law(Scalar(0))));
    }
    Workspace workspace() const { return Workspace(size()); }

    /// The solution at a creepage and a speed V > 0 [m/s], sought from the zones, tractions and coefficients of `from`.
    /// As SteadyCombinedModel::solve; in addition, the status is invalid_step if the speed is not positive and finite,
    /// wrong_state if a coefficient of `from` is negative or not finite, and no_solution if coefficients and slip do
    /// not come to agree: complementarity_residual is then at least the error of a coefficient. Tangents are by both
    /// creepages at this speed.
    Step solve(const State& from, const Creepage<Scalar>& creepage, Scalar speed, State& to,
               Workspace& workspace) const noexcept {
        StepStatus possible = model_.check(from, to, workspace);
        if (possible == StepStatus::ok && !detail::fits_friction(from, to, size())) possible = StepStatus::wrong_state;
        if (possible == StepStatus::ok && !detail::is_finite(creepage)) possible = StepStatus::not_finite;
        if (possible == StepStatus::ok && !(detail::is_finite(speed) && speed > 0)) possible = StepStatus::invalid_step;
        if (possible != StepStatus::ok) return Core::failed(possible);
        detail::FallingStages<Law, detail::CombinedSlip<Scalar>> stages(
            friction_.law, friction_.memory, from.friction_coefficient, speed, model_.core_.widths(), from.half_length,
            friction_.with_tangents, workspace.scratch_);
        const Step step = model_.solve(stages, from, creepage, to, workspace);
        detail::hand_over(step, from, stages, to);
        return step;
    }

private:
    using Core = detail::CombinedCore<Scalar>;

    static constexpr const char* name = "SteadyCombinedFallingModel";

    SteadyCombinedModel<Scalar> model_;
    FallingFriction<Law, Scalar> friction_;  // without pressures
};

template <class Scalar, class Scheme, class Kernel, class Law>
SteadyCombinedFallingModel(const Contact<Scalar>&, const Mesh<Scalar>&, const Scheme&, const Kernel&, const Kernel&,
                           const FallingFriction<Law, Scalar>&) -> SteadyCombinedFallingModel<Law, Scalar>;

}  // namespace rollbem
