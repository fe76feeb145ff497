// Common core of friction in steady rolling and in the time domain: one or two stages of a step, between the units of
// the contact and dimensionless equations s = M p + c.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/fingerprint.hpp"
#include "../../detail/finite.hpp"
#include "../../normal/load.hpp"
#include "../../rolling/stage_equations.hpp"
#include "../../rolling/step_frame.hpp"
#include "../../scene/contact_units.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../law.hpp"
#include "../state.hpp"
#include "../workspace.hpp"
#include "bounds.hpp"
#include "contact_forces.hpp"
#include "directions.hpp"
#include "frame.hpp"
#include "imposed_slip.hpp"
#include "scratch.hpp"
#include "slip_work.hpp"
#include "stage_tangent.hpp"

namespace rollbem::detail {

/// The part of a friction model that is independent of the origin of its equations. Dimensionless: tractions in G,
/// lengths in the contact's half-length a_0.
template <class Law, int directions_, class Scalar>
class FrictionCore {
public:
    static constexpr int directions = directions_;
    using State = FrictionState<directions, Scalar>;
    using Step = FrictionStep<directions, Scalar>;
    using Workspace = FrictionWorkspace<directions, Scalar>;
    using Force = typename Step::Force;
    using Value = typename Directions<directions, Scalar>::Value;
    using System = typename Directions<directions, Scalar>::System;
    using Gradient = typename Directions<directions, Scalar>::Gradient;
    using Motion = RigidMotion<Value>;
    using Axes = SemiAxes<Scalar>;
    using Load = StepLoad<Scalar>;
    static constexpr bool slip_dependent = !is_constant<Law>;

    using Request = FrictionRequest<directions, Scalar>;

    /// For the unknown elements of a mesh of `element_count`. States are recognised by the fingerprint of G', factors
    /// by that of the whole `system`, which is that of G' in steady rolling. Throws std::invalid_argument, in the name
    /// of `who`, if the law is invalid.
    FrictionCore(const char* who, const ContactUnits<Scalar>& units, const Elements<Scalar>& elements,
                 Eigen::Index element_count, const Friction<Law, Scalar>& friction, const Gradient& G_prime,
                 std::optional<std::uint64_t> system = std::nullopt);

    Eigen::Index size() const { return forces_.areas().size(); }
    Scalar half_length() const { return units_.length; }
    /// The semi-axes of a state or load in those of the contact.
    template <class Loaded>
    Axes axes(const Loaded& loaded) const {
        return units_.axes(loaded);
    }
    static Load load_of(const State& state) { return {state.normal_pressure, state.half_length, state.half_width}; }
    /// A given load, which has been checked, at the end of a step from `from`: its half-width is that of the state
    /// where it is not given.
    Load load_after(const State& from, const NormalLoad<Scalar>& load) const {
        const Scalar b = load.half_width == 0 ? from.half_width : load.half_width;
        return {load.normal_pressure, load.half_length, b, &load.pressure_rate};
    }
    /// Whether the half-width of a load is known after `from`, and on a line the contact's: ok, invalid_load or
    /// needs_fixed_mesh.
    Status check_width(const State& from, const NormalLoad<Scalar>& load) const noexcept {
        if (load.half_width == 0) {
            return units_.line || load.half_length == from.half_length ? Status::ok : Status::invalid_load;
        }
        return units_.line && load.half_width != units_.half_width ? Status::needs_fixed_mesh : Status::ok;
    }
    std::uint64_t fingerprint() const { return fingerprint_; }
    Workspace workspace() const { return Workspace(size(), slip_dependent, coupled_); }

    State at_rest() const;

    Force force(const State& state) const { return 1 / units_.shear_modulus * forces_.of(state.traction, axes(state)); }

    /// NaN if the system cannot represent the half-length.
    Scalar elastic_energy(const State& state, const System& system) const;

    /// Whether states and workspace belong to the model, and whether the load in a state is valid.
    Status check(const State& from, const State& to, const Workspace& workspace) const noexcept;

    /// A result without the numbers that a scheme gets wrong.
    static Step without_forces(const Step& solved) noexcept {
        if (solved.status != Status::ok && solved.status != Status::no_solution) return solved;
        Step step = failed<Step>(Status::assists_creepage);
        step.complementarity_residual = solved.complementarity_residual;
        step.stick_count = solved.stick_count;
        step.rounds = solved.rounds;
        step.path_points = solved.path_points;
        return step;
    }

    /// Steady rolling, s/V = creepage - G' p. With `shapes`, a system of many a/b, G' is that of the load's semi-axes.
    Step solve_steady(const Gradient& G_prime, const System* shapes, const Request& request, State& to,
                      Workspace& workspace) const noexcept;

    /// A step by the stages of a table, of a rigid shift by one, under a load that varies linearly to that given.
    Step roll(const System& system, const StageTable<Scalar>& table, const Request& request, State& to,
              Workspace& workspace) const noexcept;

private:
    using Scratch = FrictionScratch<directions, Scalar>;
    using Vectors = ElementVectors<Scalar, directions>;
    using Stage = RollingStage<Scalar>;
    using Bounds =
        std::conditional_t<slip_dependent, SlipDependentBounds<directions, Scalar>, ConstantBounds<directions, Scalar>>;
    using Slip = ImposedSlip<directions, Scalar>;

    using Frame = FrictionFrame<directions, Scalar, Bounds>;

    static bool turns(const Elements<Scalar>& elements) { return directions == 2 && elements.half_element_ahead; }
    static bool is_positive(Scalar value) { return is_finite(value) && value > 0; }
    bool wants_tangents(const Frame& frame) const { return frame.summary.tangent_exists && friction_.with_tangents; }
    static bool are_coefficients(const ArrayX<Scalar>& values) {
        return values.size() == 0 || (all_finite(values) && !(values.minCoeff() < 0));
    }

    Scalar bound_per_pressure() const {
        if constexpr (slip_dependent) {
            return 1 / units_.shear_modulus;
        } else {
            return friction_.law.coefficient / units_.shear_modulus;
        }
    }
    // With two directions, whose slip is judged by squares, bounds whose squares lose digits are none.
    void set_bounds(const Frame& frame) const {
        VectorX<Scalar>& bound = frame.scratch.bound;
        const auto end = frame.request.load.pressure.head(size());
        if (frame.request.load.pressure_rate == nullptr || frame.place.is_last()) {
            bound = bound_per_pressure() * end.matrix();
        } else {
            const auto& start = frame.request.from.normal_pressure;
            bound = bound_per_pressure() * (start + frame.place.progress * (end - start)).matrix();
        }
        const auto values = bound.array();
        if constexpr (directions == 1) {
            bound = (values < negligible<Scalar>).select(Scalar(0), bound);
        } else {
            bound = (values.square() < negligible<Scalar>).select(Scalar(0), bound);
        }
    }

    // No slip yet; the first solution is sought from the tractions at the start.
    void begin(const State& from, Scratch& scratch) const {
        scratch.slip.setZero();
        scratch.work.setZero();
        scratch.start = from.traction / units_.shear_modulus;
        scratch.plain_start = scratch.start;
        if (from.plain_traction.rows() > 0) scratch.plain_start = from.plain_traction / units_.shear_modulus;
        if constexpr (directions == 2) scratch.solver.turn_slip(behind_);
        scratch.solver.want_tangents(friction_.with_tangents || slip_dependent);
    }

    // Calls fill(slip, by, M) for the blocks of M, unless they are those of this stage already.
    template <class Fill>
    void set_matrix(const Stage& stage, Scratch& scratch, const Fill& fill) const {
        if (scratch.system == system_ && scratch.stage == stage) return;
        scratch.system = system_;
        scratch.stage = stage;
        scratch.solver.use_once(stage.growth != 0 || stage.widening != 0);
        for (std::size_t d = 0; d < directions; ++d) {
            for (std::size_t e = 0; e < directions; ++e) {
                if (d == e || scratch.solver.coupled()) fill(d, e, scratch.solver.new_matrix(d, e));
            }
        }
    }

    friend class StepFrame<Value, Scalar>;

    // One stage, whose equations are set; the next one is sought from its tractions.
    void solve(Frame& frame) const;
    // One stage of a step.
    void solve_stage(Frame& frame) const {
        with_equations(*frame.system, frame.stage, [&](const auto& equations) {
            set_matrix(frame.stage, frame.scratch,
                       [&](std::size_t d, std::size_t e, MatrixX<Scalar>& M) { equations.fill(d, e, M); });
        });
        frame.bounds.enter(frame.place, frame.stage);
        if (!frame.place.is_second || frame.request.load.pressure_rate != nullptr) set_bounds(frame);
        solve(frame);
    }
    // What the next stage takes from this one.
    void carry(Frame& frame) const;
    // Fills `to`, the slip, the slip work, and the result except for its tangents. Clears summary.tangent_exists if the
    // result is not finite.
    Step finish(Frame& frame, State& to) const;
    void add_jump_work(const Frame& frame, Step& step) const;

    ContactUnits<Scalar> units_;
    ContactForces<directions, Scalar> forces_;
    Slip slip_;
    VectorX<Scalar> intervals_;
    ArrayX<Scalar> points_;
    std::vector<Eigen::Index> behind_;  // the row behind each; empty if slip is not turned
    SlipWork<Scalar> slip_work_;
    Friction<Law, Scalar> friction_;
    bool coupled_;
    std::uint64_t fingerprint_, system_;
};

template <class Law, int directions, class Scalar>
FrictionCore<Law, directions, Scalar>::FrictionCore(const char* who, const ContactUnits<Scalar>& units,
                                                    const Elements<Scalar>& elements, Eigen::Index element_count,
                                                    const Friction<Law, Scalar>& friction, const Gradient& G_prime,
                                                    std::optional<std::uint64_t> system)
    : units_(units),
      forces_(units, elements),
      slip_(elements),
      intervals_(elements.intervals.size() > 0 ? elements.intervals.matrix() : elements.areas.matrix()),
      points_(elements.x),
      slip_work_(elements, turns(elements)),
      friction_(friction),
      coupled_(is_coupled(G_prime)),
      fingerprint_(fingerprint_of_steady(G_prime, elements.areas)),
      system_(system.value_or(fingerprint_)) {
    require_valid(who, friction, element_count, size());
    require(friction.memory.distance == 0 || elements.is_one_strip(), who, "distance of the memory",
            friction.memory.distance, "be 0 for elements in several strips");
    if (turns(elements)) behind_ = elements.behind;
    friction_.normal_pressure.conservativeResize(size());
    Fingerprint pressures;  // a state would otherwise continue under the pressures of another model
    pressures.add(friction_.normal_pressure);
    fingerprint_ = units.fingerprint ^ fingerprint_ ^ pressures.value();
}

template <class Law, int directions, class Scalar>
auto FrictionCore<Law, directions, Scalar>::at_rest() const -> State {
    State state{.traction = Vectors::Zero(size(), directions),
                .zones = std::vector<Zone>(static_cast<std::size_t>(size()), Zone::stick),
                .normal_pressure = friction_.normal_pressure,
                .half_length = units_.length,
                .half_width = units_.half_width,
                .system = fingerprint_,
                .friction_coefficient = {},
                .solver = {},
                .plain_traction = {}};
    if constexpr (slip_dependent) {
        state.friction_coefficient.setConstant(size(), static_cast<Scalar>(friction_.law(Scalar(0))));
        state.solver.stage_coefficient = state.friction_coefficient;
    }
    if (behind_.size() > 0) state.plain_traction = state.traction;
    return state;
}

template <class Law, int directions, class Scalar>
auto FrictionCore<Law, directions, Scalar>::elastic_energy(const State& state, const System& system) const -> Scalar {
    const Axes present = axes(state);
    if (!system.has_G()) return unknown<Scalar>;
    if (check_growth(system, Scalar(0), present, present) != Status::ok) return unknown<Scalar>;
    const Vectors traction = state.traction / units_.shear_modulus;
    Vectors displacement = traction;
    find_displacements(system, present, traction, displacement);
    return units_.length * forces_.unit(present) * slip_work_.product(traction, displacement) / 2;
}

template <class Law, int directions, class Scalar>
auto FrictionCore<Law, directions, Scalar>::check(const State& from, const State& to,
                                                  const Workspace& workspace) const noexcept -> Status {
    const Eigen::Index n = size();
    const auto sized = [n](const State& state) {
        return state.traction.rows() == n && (state.plain_traction.size() == 0 || state.plain_traction.rows() == n) &&
               state.zones.size() == static_cast<std::size_t>(n) && state.normal_pressure.size() == n &&
               state.friction_coefficient.size() == (slip_dependent ? n : 0);
    };
    const bool belongs = &from != &to && from.system == fingerprint_ && sized(from) && sized(to) &&
                         workspace.fits(n, slip_dependent, coupled_);
    const Eigen::Index kept = from.solver.stage_coefficient.size();
    if (!belongs || (kept != 0 && kept != from.friction_coefficient.size()) ||
        !are_coefficients(from.friction_coefficient) || !are_coefficients(from.solver.stage_coefficient)) {
        return Status::wrong_state;
    }
    const bool valid = is_finite(from.half_length) && from.half_length > 0 &&
                       (units_.line || (is_finite(from.half_width) && from.half_width > 0)) &&
                       all_pressures(from.normal_pressure);
    return valid ? Status::ok : Status::invalid_load;
}

template <class Law, int directions, class Scalar>
auto FrictionCore<Law, directions, Scalar>::solve_steady(const Gradient& G_prime, const System* shapes,
                                                         const Request& request, State& to,
                                                         Workspace& workspace) const noexcept -> Step {
    const auto& [from, travel, creepage, load] = request;
    const Status possible = creepage.is_shift() ? Status::invalid_step : creepage.check_rows(size());
    if (possible != Status::ok) return failed<Step>(possible);
    if (!slip_.can_impose(creepage.end())) return failed<Step>(Status::needs_places);
    const Scalar speed = travel.speed();
    if (slip_dependent && !is_positive(speed)) return failed<Step>(Status::invalid_step);
    Scratch& scratch = workspace.scratch();
    Frame frame{{creepage, units_.length, axes(load)},
                shapes,
                request,
                slip_,
                Bounds(friction_, intervals_, from, load.half_length, speed, scratch.falling),
                scratch};
    // with one shape G' is that of any semi-axes
    const Stage stage = shapes == nullptr ? Stage::steadily({1, 1}) : frame.stage;
    set_matrix(stage, scratch, [&](std::size_t d, std::size_t e, MatrixX<Scalar>& M) {
        if constexpr (directions == 1) {
            M = -G_prime;
        } else if (shapes == nullptr) {
            M = -G_prime[d][e];
        } else {
            ShapeEquations<Scalar>(*shapes->shapes(), shapes->a_over_b(), stage).fill_slope(-1, d, e, M);
        }
    });
    begin(from, scratch);
    scratch.displacement.setZero();
    set_bounds(frame);
    solve(frame);
    Step step = finish(frame, to);
    if (wants_tangents(frame)) add_tangents(frame, forces_, step);
    return step;
}

template <class Law, int directions, class Scalar>
auto FrictionCore<Law, directions, Scalar>::roll(const System& system, const StageTable<Scalar>& table,
                                                 const Request& request, State& to, Workspace& workspace) const noexcept
    -> Step {
    const auto& [from, travel, motion, load] = request;
    if (slip_dependent && !is_positive(travel.duration)) return failed<Step>(Status::invalid_step);
    if (!slip_.can_impose(motion.start()) || !slip_.can_impose(motion.end())) {
        return failed<Step>(Status::needs_places);
    }
    Scratch& scratch = workspace.scratch();
    Frame frame{{motion, travel.dq, units_.length, table, axes(from), axes(load)},        &system, request, slip_,
                Bounds(friction_, points_, from, units_.length, travel, scratch.falling), scratch};
    const auto* const rate = load.pressure_rate;
    frame.asked = {.by_load = rate != nullptr && rate->size() > 0,
                   .by_half_length = rate != nullptr && frame.rolls() && can_breathe(system),
                   .by_half_width = rate != nullptr && frame.rolls() && changes_shape(system)};
    if (frame.asked.by_load) scratch.bound_rate = bound_per_pressure() * rate->head(size()).matrix();
    begin(from, scratch);
    find_displacements(system, frame.start, scratch.start, scratch.displacement);
    if (behind_.size() > 0) find_displacements(system, frame.start, scratch.plain_start, scratch.plain_displacement);
    Frame::solve_stages(frame, *this);
    Step step = finish(frame, to);
    if (frame.summary.finite) add_jump_work(frame, step);
    if (wants_tangents(frame)) add_tangents(frame, forces_, step);
    return step;
}

template <class Law, int directions, class Scalar>
void FrictionCore<Law, directions, Scalar>::solve(Frame& frame) const {
    auto& [residual, rounds, path_points, tangent_exists, solved, finite] = frame.summary;
    Scratch& scratch = frame.scratch;
    auto& solver = scratch.solver;
    slip_.impose(frame, scratch.displacement, solver.constant());
    const bool has_plain = behind_.size() > 0 && !frame.stage.steady;
    if (has_plain) slip_.impose(frame, scratch.plain_displacement, solver.plain_constant());
    const std::vector<Zone>& zones = frame.place.is_second ? solver.zones() : frame.request.from.zones;
    const auto outcome =
        frame.bounds.solve(solver, scratch.bound, {scratch.start, zones, has_plain ? &scratch.plain_start : nullptr});
    residual = (std::max)(residual, outcome.residual);
    rounds += outcome.rounds;
    path_points += outcome.path_points;
    tangent_exists = tangent_exists && outcome.tangent_exists;
    solved = solved && outcome.status == Status::ok;
    finite = finite && outcome.status != Status::not_finite && is_finite(outcome.residual) &&
             all_finite(solver.slip());  // std::max may drop a NaN
    scratch.stage_slip = frame.weight() * solver.slip();
    scratch.slip += scratch.stage_slip;
    scratch.start = solver.traction();
    scratch.plain_start = solver.plain_traction();
    const Axes axes = frame.stage.axes();
    for (Eigen::Index d = 0; d < directions; ++d) {
        slip_work_.add(scratch.start.col(d), scratch.stage_slip.col(d), scratch.work,
                       axes.half_length * axes.half_width);
    }
}

template <class Law, int directions, class Scalar>
void FrictionCore<Law, directions, Scalar>::carry(Frame& frame) const {
    Scratch& scratch = frame.scratch;
    if constexpr (slip_dependent) scratch.jump_work.keep_first(scratch.start);
    if (wants_tangents(frame)) carry_responses(frame);
    const auto carry_displacement = [&](const Vectors& traction, Vectors& displacement) {
        find_displacements(*frame.system, frame.stage.axes(), traction, scratch.change);
        displacement += frame.place.ratio() * (scratch.change - displacement);
    };
    carry_displacement(scratch.start, scratch.displacement);
    if (behind_.size() > 0) carry_displacement(scratch.plain_start, scratch.plain_displacement);
}

template <class Law, int directions, class Scalar>
auto FrictionCore<Law, directions, Scalar>::finish(Frame& frame, State& to) const -> Step {
    Scratch& scratch = frame.scratch;
    auto& summary = frame.summary;
    const Scalar slip_unit = frame.stage.steady ? Scalar(1) : units_.length;
    slip_work_.end(scratch.work, units_.width * units_.length * units_.shear_modulus * slip_unit);
    scratch.slip *= slip_unit;
    to.system = fingerprint_;
    const Force force = forces_.of(scratch.start, frame.end);
    const Scalar work = scratch.work.sum();
    summary.finite = summary.finite && is_finite(force) && is_finite(work);
    if (!summary.finite) {
        summary.tangent_exists = false;
        scratch.slip.setZero();
        scratch.work.setZero();
        to = frame.request.from;  // of equal sizes
        return failed<Step>(Status::not_finite);
    }
    to.traction = units_.shear_modulus * scratch.start;
    if (behind_.size() > 0) to.plain_traction = units_.shear_modulus * scratch.plain_start;
    to.zones = scratch.solver.zones();
    to.normal_pressure = frame.request.load.pressure.head(size());
    to.half_length = frame.request.load.half_length;
    to.half_width = frame.request.load.half_width;
    frame.bounds.finish(to);
    Step step;
    step.force = force;
    step.slip_work = work;
    step.jump_work = 0;
    step.complementarity_residual = summary.residual;
    step.stick_count = scratch.solver.stick_count();
    step.rounds = summary.rounds;
    step.path_points = summary.path_points;
    step.status = summary.solved ? Status::ok : Status::no_solution;
    return step;
}

// With constant friction only a shift has jumps.
template <class Law, int directions, class Scalar>
void FrictionCore<Law, directions, Scalar>::add_jump_work(const Frame& frame, Step& step) const {
    Scratch& scratch = frame.scratch;
    const auto start = 1 / units_.shear_modulus * frame.request.from.traction;
    Scalar work = 0;
    if (!frame.rolls()) {
        scratch.change = 1 / units_.length * scratch.slip;
        work = scratch.jump_work.shifted(slip_work_, frame.end, start, scratch.start, scratch.change);
    } else if constexpr (slip_dependent) {
        const Scalar ratio = frame.table.place(1).ratio();
        work = scratch.jump_work.rolled(*frame.system, slip_work_, frame.end, ratio, start, scratch.start);
    }
    step.jump_work = units_.width * units_.shear_modulus * units_.length * units_.length * work;
}

}  // namespace rollbem::detail
