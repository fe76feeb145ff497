// Bodies of adhesion/transient.hpp. Internal.
#pragma once

#include "../transient.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../detail/require.hpp"
#include "../../rolling/detail/stage_equations.hpp"
#include "../../rolling/detail/stage_table.hpp"
#include "../../rolling/detail/time_step.hpp"
#include "../../rolling/run.hpp"
#include "../../scene/contact.hpp"
#include "../../scene/detail/contact_units.hpp"
#include "../../scene/detail/directions.hpp"
#include "../../scene/patch_contact.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../../status.hpp"
#include "../../system/detail/contact_fit.hpp"
#include "../../system/detail/time_domain.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "../detail/rational_exponential.hpp"
#include "../detail/stages.hpp"
#include "../detail/step_map.hpp"

namespace rollbem {

template <int directions_>
AdhesionModel<directions_>::AdhesionModel(const Units& units, RollingSystem<double> system, Integrator integrator)
    : units_(units),
      system_(std::move(system)),
      fingerprint_(units.fingerprint ^ system_.fingerprint()),
      integrator_(integrator),
      rational_(integrator),
      slip_(units_, system_.inputs(), units_.shear_modulus),
      forces_(units_, system_.outputs(), units_.shear_modulus),
      steady_(slip_.columns()) {
    detail::require(system_.input_count() == detail::input_count<directions>, name, "number of inputs",
                    system_.input_count(), directions == 1 ? "be 1" : "be 3");
    solve(system_.G_prime(), steady_);
    if (!is_exponential()) return;
    MatrixX<double> rates = system_.G_prime();
    solve(system_.G(), rates);
    rates_norm_ = rates.cwiseAbs().colwise().sum().maxCoeff();
}

template <int directions_>
void AdhesionModel<directions_>::solve(MatrixX<double> matrix, MatrixX<double>& right) {
    std::vector<Eigen::Index> swaps(static_cast<std::size_t>(matrix.rows()));
    const detail::MatrixRef<double> factors(matrix);
    detail::factorise_in_place<double>(factors, swaps.data());
    for (Eigen::Index j = 0; j < right.cols(); ++j) {
        detail::solve_in_place<double>(factors, swaps.data(), right.col(j));
    }
}

template <int directions_>
auto AdhesionModel<directions_>::steady(const Value& creepage) const -> State {
    const Inputs value = detail::in_order(creepage);
    for (const double component : value) {
        detail::require_finite(name, "creepage", component);
    }
    State state = at_rest();
    state.traction.noalias() = steady_ * value;
    return state;
}

template <int directions_>
auto AdhesionModel<directions_>::steady(const State& from, const RollingStep& step, State& to,
                                        Workspace& workspace) const noexcept -> Step {
    const SemiAxes end = semi_axes(from, step);
    const Axes at = axes(end);
    Status status = check(from, end, to, workspace);
    if (status == Status::ok && step.motion.is_shift()) status = Status::invalid_step;
    if (status == Status::ok) status = check_growth(0.0, at, at);
    if (status == Status::ok) status = step.motion.check_rows(0);
    if (status != Status::ok) return detail::failed<Step>(status);
    const Inputs value = detail::in_order(step.motion.end());
    to.traction.setZero();
    if constexpr (directions == 2) {
        if (shapes_ && at != contact_axes) {
            const auto stage = detail::RollingStage::steadily(at);
            Stages& stages = workspace.stages();
            stages.solve_steady(preparation(true), {*shapes_, a_over_b_, stage}, slip_, workspace.factors());
            const auto per_creepage = [&](std::size_t j) -> const VectorX<double>& { return stages.response(j); };
            for (std::size_t j = 0; j < By::creepages; ++j) {
                to.traction += value[static_cast<Eigen::Index>(j)] * per_creepage(j);
            }
            return finish(from, end, 0, forces_of(per_creepage, at), to);
        }
    }
    const auto per_creepage = [&](std::size_t j) { return steady_.col(static_cast<Eigen::Index>(j)); };
    for (Eigen::Index j = 0; j < value.size(); ++j) to.traction += value[j] * steady_.col(j);
    return finish(from, end, 0, forces_of(per_creepage, at), to);
}

template <int directions_>
auto AdhesionModel<directions_>::advance(const State& from, const RollingStep& step, State& to,
                                         Workspace& workspace) const noexcept -> Step {
    const SemiAxes end = semi_axes(from, step);
    const double dq = step.travel.dq;
    const Status possible = detail::check_step(check(from, end, to, workspace), step.motion, dq, 0,
                                               [&] { return check_growth(dq / units_.length, axes(from), axes(end)); });
    if (possible != Status::ok) return detail::failed<Step>(possible);
    const bool by_axes = step.load && can_breathe();
    const bool repeats = dq > 0 && dq == from.distance && !by_axes && axes(end) == contact_axes;
    if (is_exponential()) return repeat(from, dq, step.motion, to, workspace);
    const TimeStep rolled{step.motion, units_.length,      axes(from),
                          axes(end),   dq / units_.length, *detail::stage_table(integrator_)};
    Problem problem{preparation(), from.traction, slip_, workspace.factors()};
    problem.asked[By::half_length] = by_axes;
    if constexpr (directions == 2) problem.asked[By::half_width] = by_axes && shapes_ && !shapes_->is_single();
    const bool reshaped = reshapes(rolled, problem);
    if (repeats && !reshaped) return repeat(from, dq, step.motion, to, workspace);
    if (reshaped) problem.model = preparation(true);
    return solve_stages(from, step, rolled, problem, to, workspace);
}

template <int directions_>
auto AdhesionModel<directions_>::repeat(const State& from, double dq, const Motion& motion, State& to,
                                        Workspace& workspace) const noexcept -> Step {
    const detail::ImposedMotion<directions> imposed(motion, dq);
    detail::StepMap<directions>& map = workspace.map();
    if (!map.is_of(preparation(), dq)) {
        map.prepare({preparation(), dq, units_.length, count_doublings(dq / units_.length)}, detail::influence(system_),
                    rational_, slip_.columns(), forces_.columns(), workspace.factors());
    }
    map.apply(from.traction, imposed, to.traction);
    return finish(from, {from.half_length, from.half_width}, dq, map.tangent(imposed), to);
}

template <int directions_>
auto AdhesionModel<directions_>::solve_stages(const State& from, const RollingStep& step, const TimeStep& rolled,
                                              const Problem& problem, State& to, Workspace& workspace) const noexcept
    -> Step {
    Stages& stages = workspace.stages();
    if (reshapes(rolled, problem)) {
        if constexpr (directions == 2) {
            stages.solve(rolled, problem, [this](const auto& geometry, const auto& use) {
                use(detail::ShapeEquations(*shapes_, a_over_b_, geometry));
            });
        }
    } else {
        stages.solve(rolled, problem, [this](const auto& geometry, const auto& use) {
            use(detail::LineEquations<RollingSystem<double>>(system_, geometry));
        });
    }
    to.traction = from.traction + stages.change();
    const auto per_creepage = [&](std::size_t j) -> const VectorX<double>& { return stages.response(j); };
    Step result = finish(from, semi_axes(from, step), step.travel.dq, forces_of(per_creepage, rolled.end), to);
    if (result.status != Status::ok) return result;
    return add_tangents(problem, stages, to, result) ? result : fail(from, to);
}

template <int directions_>
bool AdhesionModel<directions_>::add_tangents(const Problem& problem, const Stages& stages, const State& to,
                                              Step& step) const {
    const bool keeps_shape = shapes_ && shapes_->is_single();
    bool finite = true;
    for (std::size_t j = By::half_length; j < By::count; ++j) {
        if (!problem.asked[j]) continue;
        const Inputs by_axis = forces_.rate(to.traction, stages.response(j), axes(to), By::axis(j), keeps_shape);
        finite = finite && detail::all_finite(by_axis);
        (j == By::half_length ? step.tangent_by_half_length : step.tangent_by_half_width) = force_along(by_axis);
    }
    if constexpr (directions == 2) {
        if (keeps_shape && problem.asked[By::half_length]) step.tangent_by_half_width = {0, 0, 0};
    }
    return finite;
}

template <int directions_>
AdhesionModel<directions_>::AdhesionModel(const Contact& contact, RollingSystem<double> system,
                                          const StabilityVerdict& verdict, Integrator integrator)
    : AdhesionModel(Units(contact), std::move(system), integrator) {
    detail::require_same_aspect(name, contact, system_);
    detail::require_usable_in_time(name, system_, verdict);
}

template <int directions_>
template <class AnyContact>
AdhesionModel<directions_>::AdhesionModel(const AnyContact& contact, const ElementSystem<double, 2>& system,
                                          const StabilityVerdict& verdict,
                                          Integrator integrator) requires(directions_ == 2)
    : AdhesionModel(Units(contact), system.joined(), integrator) {
    if constexpr (std::is_same_v<AnyContact, Contact>) {
        detail::require_same_aspect(name, contact, system);
    } else {
        detail::require_same_shape(name, contact, system);
    }
    shapes_ = system.shapes();
    a_over_b_ = system.a_over_b();
    detail::require(system.elements().places_are_known(), name, "number of places of elements",
                    system.elements().x.size(), "equal the number of elements: spin needs them");
    detail::require_usable_in_time(name, system, verdict);
}

template <int directions_>
inline int AdhesionModel<directions_>::count_doublings(double h) const {
    if (!is_exponential() || !(h > 0)) return 0;
    const double norm = 16 * h * rates_norm_;
    return detail::is_finite(norm) ? std::clamp(std::ilogb(norm) + 1, 0, 60) : 60;
}

template <int directions_>
inline Status AdhesionModel<directions_>::check(const State& from, const SemiAxes& semi_axes, const State& to,
                                                const Workspace& workspace) const noexcept {
    const bool fits = &from != &to && from.system == fingerprint_ && from.traction.size() == size() &&
                      to.traction.size() == size() && workspace.size() == size() &&
                      are_lengths({from.half_length, from.half_width});
    if (!fits) return Status::wrong_state;
    return are_lengths(semi_axes) ? Status::ok : Status::invalid_load;
}

template <int directions_>
inline Status AdhesionModel<directions_>::check_growth(double distance, const Axes& start,
                                                       const Axes& end) const noexcept {
    return detail::check_growth(can_breathe(), system_.half_length_limit(), shapes_.get(), a_over_b_, distance, start,
                                end);
}

template <int directions_>
inline auto AdhesionModel<directions_>::fail(const State& from, State& to) noexcept -> Step {
    to.traction = from.traction;
    to.half_length = from.half_length;
    to.half_width = from.half_width;
    to.distance = from.distance;
    return detail::failed<Step>(Status::not_finite);
}

template <int directions_>
inline auto AdhesionModel<directions_>::finish(const State& from, const SemiAxes& semi_axes, double dq,
                                               const Square& tangent, State& to) const noexcept -> Step {
    to.half_length = semi_axes.half_length;
    to.half_width = semi_axes.half_width;
    to.system = fingerprint_;
    to.distance = dq;
    const Inputs force = forces_.of(to.traction, axes(to));
    if (!detail::all_finite(force) || !detail::all_finite(tangent)) return fail(from, to);
    Step step;
    step.force = force_along(force);
    if (units_.line) step.force_per_width = force_along(force / units_.width);
    for (std::size_t j = 0; j < By::creepages; ++j) {
        detail::by_creepage(step.tangent, j) = force_along(tangent.col(static_cast<Eigen::Index>(j)));
    }
    step.status = Status::ok;
    return step;
}

template <int directions_>
inline auto AdhesionModel<directions_>::semi_axes(const State& from, const RollingStep& step) const noexcept
    -> SemiAxes {
    if constexpr (directions == 1) {
        return {step.load.value_or(from.half_length), from.half_width};
    } else {
        return step.load.value_or(SemiAxes{from.half_length, from.half_width});
    }
}

template <int directions_>
template <class Unknowns>
inline auto AdhesionModel<directions_>::forces_of(const Unknowns& unknowns, const Axes& at) const -> Square {
    Square result;
    for (std::size_t j = 0; j < By::creepages; ++j) {
        result.col(static_cast<Eigen::Index>(j)) = forces_.of(unknowns(j), at);
    }
    return result;
}

}  // namespace rollbem
