// Bodies of friction/model.hpp. Internal.
#pragma once

#include "../model.hpp"

#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../rolling/detail/stage_equations.hpp"
#include "../../rolling/detail/time_step.hpp"
#include "../../status.hpp"
#include "../../system/detail/contact_fit.hpp"
#include "../../system/detail/time_domain.hpp"
#include "../detail/rolling_friction.hpp"

namespace rollbem {

namespace detail {

/// What a FrictionModel is: constant.
struct FrictionData {
    std::variant<ContactData<1>, ContactData<2>> contact;
    Integrator integrator = Integrator::sdirk2;
    bool converges = true;

    /// Calls use(contact) with the contact of its directions.
    template <class Use>
    auto with(const Use& use) const {
        const auto* const one = std::get_if<0>(&contact);
        return one != nullptr ? use(*one) : use(*std::get_if<1>(&contact));
    }
};

/// The memory of a FrictionModel::Workspace.
struct FrictionScratch {
    std::variant<StepScratch<1>, StepScratch<2>> steps;
    Eigen::Index direction = 0;  ///< of the last step by a model of one

    /// The memory for steps of a contact, or null if it is made for contacts of another kind.
    template <int directions>
    StepScratch<directions>* of(const ContactData<directions>& contact) {
        auto* const own = std::get_if<StepScratch<directions>>(&steps);
        const bool fits = own != nullptr && own->solver.matrix.size() == contact.size() &&
                          own->solver.matrix.coupled() == is_coupled(contact.system) &&
                          own->mu.iteration.size() == (contact.varies() ? contact.size() : 0);
        direction = contact.direction;
        return fits ? own : nullptr;
    }
};

/// A step or steady solution to be checked, then solved; references to values of the caller.
struct FrictionRequest {
    const FrictionState& from;
    const FrictionModel::RollingStep& step;
    FrictionState& to;
    FrictionScratch* scratch;

    const NormalLoad* load() const { return step.load ? &*step.load : nullptr; }
};

inline constexpr const char* friction_model = "FrictionModel";

template <class AnyContact, int directions>
std::shared_ptr<const FrictionData> friction_data(const AnyContact& contact, ElementSystem<double, directions> system,
                                                  const StabilityVerdict& verdict, const Friction& friction,
                                                  Integrator integrator, Eigen::Index direction = 0) {
    require(direction == 0 || direction == 1, friction_model, "direction", direction, "be 0 or 1");
    auto data = std::make_shared<FrictionData>(FrictionData{
        ContactData<directions>(friction_model, contact, std::move(system), friction, direction), integrator});
    const auto& own = std::get_if<ContactData<directions>>(&data->contact)->system;
    if constexpr (std::is_same_v<AnyContact, Contact>) {
        require_same_aspect(friction_model, contact, own);
    } else {
        require(!own.aspect() && own.elements().places_are_known(), friction_model,
                "number of places of a patch's elements", own.elements().x.size(),
                "be theirs: a patch has the system of a PatchMesh");
        require_same_shape(friction_model, contact, own);
    }
    require(stage_table(integrator).has_value(), friction_model, "integrator", rollbem::name(integrator),
            "solve stages, as implicit_euler and sdirk2 do");
    if (!own.has_G()) {
        if constexpr (directions == 1) {
            data->converges = !verdict.checked || converges(own.G_prime(), own.elements().areas);
        } else {
            data->converges = !verdict.checked || converges(own.G_prime_blocks(), own.elements().areas);
        }
        return data;
    }
    require(friction.memory.distance == 0 || own.elements().places_are_known(), friction_model,
            "distance of the memory", friction.memory.distance,
            "be 0 for a system that does not know the points of its equations");
    require_usable_in_time(friction_model, own, verdict);
    return data;
}

template <int directions>
FrictionState at_rest(const ContactData<directions>& contact) {
    const Eigen::Index n = contact.size();
    FrictionState state;
    state.traction.setZero(n, 2);
    state.zones.resize(static_cast<std::size_t>(n), Zone::stick);
    state.normal_pressure = contact.normal_pressure;
    state.half_length = contact.units.length;
    state.half_width = contact.units.half_width;
    state.system = contact.fingerprint;
    if (contact.varies()) {
        state.friction_coefficient.setConstant(n, contact.law.at_rest());
        state.solver.stage_coefficient = state.friction_coefficient;
    }
    if (contact.rotates) state.unrotated_traction = state.traction;
    return state;
}

/// Whether the load of a step can follow a state: ok; invalid_load, also if a patch changes its half-length without a
/// new half-width; needs_fixed_mesh if the half-width of a line contact changes, or of strips whose particles remember.
template <int directions>
Status check_load(const ContactData<directions>& contact, const FrictionState& from, const NormalLoad* load) noexcept {
    const Status possible = load == nullptr ? Status::ok : load->check(contact.system.element_count());
    if (load == nullptr || possible != Status::ok) return possible;
    const bool line = contact.units.line;
    if (load->half_width == 0) {
        return line || load->half_length == from.half_length ? Status::ok : Status::invalid_load;
    }
    const double fixed = line ? contact.units.half_width : from.half_width;
    return (line || contact.remembers_in_strips()) && load->half_width != fixed ? Status::needs_fixed_mesh : Status::ok;
}
/// The load at the end of a step. A half-width of 0 is replaced by the half-width of `from`.
inline LoadAtEnd load_after(const FrictionState& from, const NormalLoad* load) noexcept {
    if (load == nullptr) return {from.normal_pressure, from.half_length, from.half_width};
    const double b = load->half_width == 0 ? from.half_width : load->half_width;
    return {load->normal_pressure, load->half_length, b, &load->pressure_rate};
}

inline bool are_coefficients(const ArrayX<double>& values) {
    return values.size() == 0 || (all_finite(values) && !(values.minCoeff() < 0));
}

/// Whether states and workspace belong to the contact, and whether the load in a state is valid.
template <int directions>
Status check_state(const ContactData<directions>& contact, const FrictionRequest& asked) noexcept {
    const auto& [from, step, to, scratch] = asked;
    const Eigen::Index n = contact.size();
    const auto sized = [&](const FrictionState& state) {
        return state.traction.rows() == n &&
               (state.unrotated_traction.size() == 0 || state.unrotated_traction.rows() == n) &&
               state.zones.size() == static_cast<std::size_t>(n) && state.normal_pressure.size() == n &&
               state.friction_coefficient.size() == (contact.varies() ? n : 0);
    };
    const bool belongs = &from != &to && from.system == contact.fingerprint && sized(from) && sized(to) &&
                         scratch != nullptr && scratch->of(contact) != nullptr;
    const Eigen::Index kept = from.solver.stage_coefficient.size();
    if (!belongs || (kept != 0 && kept != from.friction_coefficient.size()) ||
        !are_coefficients(from.friction_coefficient) || !are_coefficients(from.solver.stage_coefficient)) {
        return Status::wrong_state;
    }
    const bool valid = is_positive(from.half_length) && (contact.units.line || is_positive(from.half_width)) &&
                       (scratch->of(contact)->has(from.normal_pressure) || all_pressures(from.normal_pressure));
    return valid ? Status::ok : Status::invalid_load;
}

/// Whether the rigid slip of a creepage is known.
template <int directions, class Value>
bool can_impose(const ContactData<directions>& contact, [[maybe_unused]] const Value& creepage) noexcept {
    if constexpr (directions == 2) return creepage.spin == 0 || contact.system.elements().places_are_known();
    return true;
}

/// The components of a motion along the directions of a contact.
template <int directions>
auto motion_along(const ContactData<directions>& contact, const FrictionModel::Motion& motion) {
    if constexpr (directions == 2) {
        return motion;
    } else {
        return motion.along(contact.direction);
    }
}

/// The result of a scheme that does not converge: residual and counts, but NaN for forces, tangents and works.
inline FrictionStep without_forces(const FrictionStep& solved) noexcept {
    if (solved.status != Status::ok && solved.status != Status::no_solution) return solved;
    FrictionStep step = failed<FrictionStep>(Status::assists_creepage);
    step.complementarity_residual = solved.complementarity_residual;
    step.stick_count = solved.stick_count;
    step.rounds = solved.rounds;
    step.path_points = solved.path_points;
    return step;
}

template <int directions>
FrictionStep steady(const ContactData<directions>& contact, const FrictionRequest& asked) noexcept {
    const auto& [from, step, to, scratch] = asked;
    Status possible = check_load(contact, from, asked.load());
    if (possible != Status::ok) return failed<FrictionStep>(possible);
    const LoadAtEnd load = load_after(from, asked.load());
    const SemiAxes at = contact.units.axes(load);
    const auto motion = motion_along(contact, step.motion);
    possible = check_state(contact, asked);
    if (possible == Status::ok) possible = check_growth(contact.system, 0.0, at, at);
    if (possible == Status::ok) possible = motion.is_shift() ? Status::invalid_step : motion.check_rows(contact.size());
    if (possible == Status::ok && !can_impose(contact, motion.end())) possible = Status::needs_places;
    const double speed = step.travel.speed();
    if (possible == Status::ok && contact.varies() && !is_positive(speed)) possible = Status::invalid_step;
    if (possible != Status::ok) return failed<FrictionStep>(possible);
    TimeStep<directions> rolled{motion, contact.units.length, at, at};
    rolled.steady = true;
    rolled.speed = speed;
    return solve<directions>({contact, rolled, from, load, *scratch->of(contact)}, to);
}

template <int directions>
FrictionStep advance(const ContactData<directions>& contact, Integrator integrator,
                     const FrictionRequest& asked) noexcept {
    const auto& [from, step, to, scratch] = asked;
    Status possible = check_load(contact, from, asked.load());
    if (possible == Status::ok && !contact.system.has_G()) possible = Status::invalid_step;
    if (possible != Status::ok) return failed<FrictionStep>(possible);
    const LoadAtEnd load = load_after(from, asked.load());
    const double dq = step.travel.dq / contact.units.length, duration = step.travel.duration;
    const SemiAxes start = contact.units.axes(from), end = contact.units.axes(load);
    const auto motion = motion_along(contact, step.motion);
    possible = check_step(check_state(contact, asked), motion, dq, contact.size(),
                          [&] { return check_growth(contact.system, dq, start, end); });
    if (possible == Status::ok && contact.varies() && !is_positive(duration)) possible = Status::invalid_step;
    const bool imposed = can_impose(contact, motion.start()) && can_impose(contact, motion.end());
    if (possible == Status::ok && !imposed) possible = Status::needs_places;
    if (possible != Status::ok) return failed<FrictionStep>(possible);
    TimeStep<directions> rolled{motion, contact.units.length, start, end, dq, *stage_table(integrator)};
    rolled.duration = duration;
    return solve<directions>({contact, rolled, from, load, *scratch->of(contact)}, to);
}

}  // namespace detail

ROLLBEM_DECL FrictionModel::Workspace::Workspace(const detail::FrictionData& data)
    : scratch_(data.with([]<int directions>(const detail::ContactData<directions>& contact) {
          detail::StepScratch<directions> steps(contact.size(), detail::is_coupled(contact.system), contact.varies());
          return detail::Hidden(detail::FrictionScratch{std::move(steps), contact.direction});
      })) {}

ROLLBEM_DECL auto FrictionModel::Workspace::slip() const -> ElementVectors {
    const auto& [steps, direction] = scratch_.get();
    if (const auto* both = std::get_if<1>(&steps)) return both->slip_unit * both->slip;
    const auto* const one = std::get_if<0>(&steps);
    ElementVectors slip = ElementVectors::Zero(one->slip.size(), 2);
    slip.col(direction) = one->slip_unit * one->slip;
    return slip;
}
ROLLBEM_DECL auto FrictionModel::Workspace::slip_work() const -> const VectorX<double>& {
    const auto& steps = scratch_.get().steps;
    const auto* const one = std::get_if<0>(&steps);
    return one != nullptr ? one->work : std::get_if<1>(&steps)->work;
}

ROLLBEM_DECL FrictionModel::FrictionModel(const Contact& contact, ElementSystem<double> system,
                                          const StabilityVerdict& verdict, const Friction& friction,
                                          Integrator integrator, Eigen::Index direction)
    : data_(detail::friction_data(contact, std::move(system), verdict, friction, integrator, direction)) {}
ROLLBEM_DECL FrictionModel::FrictionModel(const Contact& contact, ElementSystem<double, 2> system,
                                          const StabilityVerdict& verdict, const Friction& friction,
                                          Integrator integrator)
    : data_(detail::friction_data(contact, std::move(system), verdict, friction, integrator)) {}
ROLLBEM_DECL FrictionModel::FrictionModel(const PatchContact& contact, ElementSystem<double, 2> system,
                                          const StabilityVerdict& verdict, const Friction& friction,
                                          Integrator integrator)
    : data_(detail::friction_data(contact, std::move(system), verdict, friction, integrator)) {}
ROLLBEM_DECL FrictionModel::FrictionModel(const Contact& contact, ElementSystem<double> system,
                                          const Friction& friction, Eigen::Index direction)
    : FrictionModel(contact, std::move(system), StabilityVerdict{}, friction, Integrator::sdirk2, direction) {}
ROLLBEM_DECL FrictionModel::FrictionModel(const Contact& contact, ElementSystem<double, 2> system,
                                          const Friction& friction)
    : FrictionModel(contact, std::move(system), StabilityVerdict{}, friction) {}
ROLLBEM_DECL FrictionModel::FrictionModel(const PatchContact& contact, ElementSystem<double, 2> system,
                                          const Friction& friction)
    : FrictionModel(contact, std::move(system), StabilityVerdict{}, friction) {}

ROLLBEM_DECL int FrictionModel::directions() const { return data_->contact.index() == 0 ? 1 : 2; }
ROLLBEM_DECL Eigen::Index FrictionModel::size() const {
    return data_->with([](const auto& contact) { return contact.size(); });
}
ROLLBEM_DECL std::uint64_t FrictionModel::fingerprint() const {
    return data_->with([](const auto& contact) { return contact.fingerprint; });
}
ROLLBEM_DECL Integrator FrictionModel::integrator() const { return data_->integrator; }
ROLLBEM_DECL bool FrictionModel::converges() const { return data_->converges; }

ROLLBEM_DECL FrictionState FrictionModel::at_rest() const {
    return data_->with([](const auto& contact) { return detail::at_rest(contact); });
}
ROLLBEM_DECL FrictionState FrictionModel::at_rest(const NormalLoad& load) const {
    return data_->with([&](const auto& contact) {
        FrictionState state = detail::at_rest(contact);
        Status possible = detail::check_load(contact, state, &load);
        const detail::LoadAtEnd given = detail::load_after(state, &load);
        const SemiAxes axes = contact.units.axes(given);
        if (possible == Status::ok) possible = detail::check_growth(contact.system, 0.0, axes, axes);
        detail::require(
            possible == Status::ok, detail::friction_model, "status of the load at rest", rollbem::name(possible),
            "be ok: pressures of all elements, finite and not negative, on semi-axes that the mesh can follow");
        state.normal_pressure = given.pressure.head(contact.size());
        state.half_length = given.half_length;
        state.half_width = given.half_width;
        return state;
    });
}
ROLLBEM_DECL auto FrictionModel::workspace() const -> Workspace { return Workspace(*data_); }

ROLLBEM_DECL TangentialForce FrictionModel::force(const State& state) const {
    return data_->with([&]<int directions>(const detail::ContactData<directions>& contact) {
        const detail::Vectors<directions> traction = contact.along(state.traction);
        const auto forces = contact.forces.of(traction, contact.units.axes(state));
        return detail::raised<directions>(1 / contact.units.shear_modulus * forces, contact.direction);
    });
}

ROLLBEM_DECL double FrictionModel::elastic_energy(const State& state) const {
    return data_->with([&]<int directions>(const detail::ContactData<directions>& contact) {
        const SemiAxes present = contact.units.axes(state);
        const auto& system = contact.system;
        if (!system.has_G() || detail::check_growth(system, 0.0, present, present) != Status::ok) {
            return detail::not_computed;
        }
        const detail::Vectors<directions> traction = contact.along(state.traction) / contact.units.shear_modulus;
        detail::Vectors<directions> displacement = traction;
        detail::find_displacements(system, present, traction, displacement);
        return contact.energy_unit(present) * contact.work.product(traction, displacement) / 2;
    });
}

ROLLBEM_DECL FrictionStep FrictionModel::steady(const State& from, const RollingStep& step, State& to,
                                                Workspace& workspace) const noexcept {
    const detail::FrictionRequest asked{from, step, to, workspace.scratch_.find()};
    const Step solved = data_->with([&](const auto& contact) { return detail::steady(contact, asked); });
    return data_->converges ? solved : detail::without_forces(solved);
}

ROLLBEM_DECL FrictionStep FrictionModel::advance(const State& from, const RollingStep& step, State& to,
                                                 Workspace& workspace) const noexcept {
    const detail::FrictionRequest asked{from, step, to, workspace.scratch_.find()};
    return data_->with([&](const auto& contact) { return detail::advance(contact, data_->integrator, asked); });
}

}  // namespace rollbem
