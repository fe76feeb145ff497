// Common core of friction in steady rolling and in the time domain: it turns each stage of a step, given in the units
// of the contact, into dimensionless equations s = M p + c, and the solutions back into results.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/fingerprint.hpp"
#include "../../detail/finite.hpp"
#include "../../normal/load.hpp"
#include "../../rolling/rigid_slip.hpp"
#include "../../rolling/stage_equations.hpp"
#include "../../rolling/step_frame.hpp"
#include "../../scene/contact_units.hpp"
#include "../../scene/directions.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../../scene/semi_axes.hpp"
#include "../../status.hpp"
#include "../../system/element_blocks.hpp"
#include "../../types.hpp"
#include "../law.hpp"
#include "../state.hpp"
#include "../workspace.hpp"
#include "bounds.hpp"
#include "frame.hpp"
#include "scratch.hpp"
#include "slip_work.hpp"

namespace rollbem::detail {

/// The part of a friction model that is independent of the origin of its equations. Dimensionless: tractions in G,
/// lengths in the contact's half-length a_0.
template <class Law, int directions_>
class FrictionCore {
public:
    static constexpr int directions = directions_;
    using State = FrictionState<directions>;
    using Step = FrictionStep<directions>;
    using Workspace = FrictionWorkspace<directions>;
    using Force = typename Step::Force;
    using Value = CreepageAlong<directions, double>;
    using System = ElementSystem<double, directions>;
    using Motion = RigidMotion<Value>;
    using Axes = SemiAxes<double>;
    using Load = StepLoad;
    using Vectors = ElementVectors<directions>;
    static constexpr bool slip_dependent = !is_constant<Law>;

    using Request = FrictionRequest<directions>;

    /// A state is recognised by a fingerprint of G', the areas, the contact and the pressures; factors are recognised
    /// by the fingerprint of the whole system or, without G, of G' and the areas. Throws std::invalid_argument, in the
    /// name of `who`, if the law is invalid.
    FrictionCore(const char* who, const ContactUnits<double>& units, System system,
                 const Friction<Law>& friction);

    const System& system() const { return system_; }
    Eigen::Index size() const { return system_.size(); }
    double half_length() const { return units_.length; }
    /// The semi-axes of a state or load over the semi-axes of the contact.
    template <class Loaded>
    Axes axes(const Loaded& loaded) const {
        return units_.axes(loaded);
    }
    static Load load_of(const State& state) { return {state.normal_pressure, state.half_length, state.half_width}; }
    /// The load at the end of a step from `from`: the given load, already checked. A half-width of 0 is replaced by the
    /// half-width of `from`.
    Load load_after(const State& from, const NormalLoad<double>& load) const {
        const double b = load.half_width == 0 ? from.half_width : load.half_width;
        return {load.normal_pressure, load.half_length, b, &load.pressure_rate};
    }
    /// Whether the half-width of a load is usable: invalid_load if a patch changes its half-length without a new
    /// half-width, needs_fixed_mesh if a line contact changes its half-width, else ok.
    Status check_width(const State& from, const NormalLoad<double>& load) const noexcept {
        if (load.half_width == 0) {
            return units_.line || load.half_length == from.half_length ? Status::ok : Status::invalid_load;
        }
        return units_.line && load.half_width != units_.half_width ? Status::needs_fixed_mesh : Status::ok;
    }
    std::uint64_t fingerprint() const { return fingerprint_; }
    Workspace workspace() const { return Workspace(size(), slip_dependent, is_coupled(system_)); }

    State at_rest() const;

    Force force(const State& state) const {
        return 1 / units_.shear_modulus * force_along<directions, double>(forces_.of(state.traction, axes(state)));
    }

    /// The elastic energy [J]; NaN if the system cannot represent the half-length.
    double elastic_energy(const State& state) const;

    /// Whether states and workspace belong to the model, and whether the load in a state is valid.
    Status check(const State& from, const State& to, const Workspace& workspace) const noexcept;

    /// The result of a scheme that does not converge: residual and counts, but NaN for forces, tangents and works.
    static Step without_forces(const Step& solved) noexcept {
        if (solved.status != Status::ok && solved.status != Status::no_solution) return solved;
        Step step = failed<Step>(Status::assists_creepage);
        step.complementarity_residual = solved.complementarity_residual;
        step.stick_count = solved.stick_count;
        step.rounds = solved.rounds;
        step.path_points = solved.path_points;
        return step;
    }

    /// Solves for steady rolling, s/V = creepage - G' p, at the semi-axes of the load.
    Step steady(const Request& request, State& to, Workspace& workspace) const noexcept;

    /// Takes a step by the stages of a table (a rigid shift has one stage), under a load that varies linearly up to the
    /// given load.
    Step roll(const StageTable<double>& table, const Request& request, State& to, Workspace& workspace) const noexcept;

private:
    using Scratch = FrictionScratch<directions>;
    using By = TangentBy<directions>;
    using Bounds =
        std::conditional_t<slip_dependent, SlipDependentBounds<directions>, ConstantBounds<directions>>;
    using Frame = FrictionFrame<directions, Bounds>;

    static bool is_positive(double value) { return is_finite(value) && value > 0; }
    bool wants_tangents(const Frame& frame) const { return frame.tangent_exists && friction_.with_tangents; }
    static bool are_coefficients(const ArrayX<double>& values) {
        return values.size() == 0 || (all_finite(values) && !(values.minCoeff() < 0));
    }

    double bound_per_pressure() const {
        if constexpr (slip_dependent) {
            return 1 / units_.shear_modulus;
        } else {
            return friction_.law.coefficient / units_.shear_modulus;
        }
    }
    // Unit [J] of the work of tractions in G and displacements in a_0.
    double energy_unit(const Axes& at) const {
        return units_.width * units_.length * units_.length * units_.shear_modulus * at.half_length * at.half_width;
    }
    // Whether the rigid slip of a creepage is known.
    bool can_impose([[maybe_unused]] const Value& creepage) const noexcept {
        if constexpr (directions == 2) return creepage.spin == 0 || system_.elements().places_are_known();
        return true;
    }
    // Number of solutions with constants of their own: two in a step with turned slip, as the solution without turned
    // slip has a history of its own; else one.
    std::size_t constant_count(const Frame& frame) const { return turns_ && !frame.stage.steady ? 2 : 1; }
    // Sets the bounds of the stage. Bounds that are negligible become 0; with two directions, whose slip is judged by
    // squares, bounds whose squares lose digits.
    void set_bounds(const Frame& frame) const {
        VectorX<double>& bound = frame.scratch.bound;
        const auto end = frame.request.load.pressure.head(size());
        if (frame.request.load.pressure_rate == nullptr || frame.place.is_last()) {
            bound = bound_per_pressure() * end.matrix();
        } else {
            const auto& start = frame.request.from.normal_pressure;
            bound = bound_per_pressure() * (start + frame.place.progress * (end - start)).matrix();
        }
        const double least = directions == 1 ? negligible<double> : std::sqrt(negligible<double>);
        bound = (bound.array() < least).select(0.0, bound);
    }

    // Solves one step or steady rolling, stage by stage.
    Step solve(Frame& frame, State& to) const {
        begin(frame);
        if constexpr (directions == 2) frame.asked[2] = system_.elements().places_are_known();
        Frame::solve_stages(frame, *this);
        finish(frame, to);
        if (wants_tangents(frame)) frame.add_tangents(forces_);
        return frame.result;
    }
    // Sets slip and work to 0, and the starting point of the first search to the tractions of `from`.
    void begin(Frame& frame) const {
        frame.result.complementarity_residual = 0;
        frame.result.status = Status::ok;
        const State& from = frame.request.from;
        Scratch& scratch = frame.scratch;
        scratch.slip.setZero();
        scratch.work.setZero();
        const std::size_t last = constant_count(frame) - 1;
        const bool has_plain = last == 1 && from.plain_traction.rows() > 0;
        scratch.start[0] = (has_plain ? from.plain_traction : from.traction) / units_.shear_modulus;
        if (last == 1) scratch.start[1] = from.traction / units_.shear_modulus;
        for (std::size_t which = 0; which <= last; ++which) {
            Vectors& displacement = scratch.displacement[which];
            if (frame.stage.steady) {
                displacement.setZero();
            } else {
                find_displacements(system_, frame.start, scratch.start[which], displacement);
            }
        }
        scratch.solver.turn_slip(turns_ ? &slip_work_.centres() : nullptr);
        scratch.solver.want_tangents(friction_.with_tangents || slip_dependent);
    }

    friend class StepFrame<Value, double>;

    void solve_stage(Frame& frame) const;
    // Keeps the quantities of this stage from which the next one starts.
    void carry(Frame& frame) const {
        Scratch& scratch = frame.scratch;
        if constexpr (slip_dependent) scratch.first = scratch.solver.traction();
        if (wants_tangents(frame)) frame.carry_responses();
        for (std::size_t which = 0; which < constant_count(frame); ++which) {
            Vectors& displacement = scratch.displacement[which];
            find_displacements(system_, frame.stage.axes(), scratch.start[which], scratch.change);
            displacement += frame.place.ratio() * (scratch.change - displacement);
        }
    }
    // Fills M of the stage, unless the solver has it already. In steady rolling of a contact of constant shape M is -G'
    // at any semi-axes.
    void set_matrix(const Frame& frame) const {
        Scratch& scratch = frame.scratch;
        using Stage = RollingStage<double>;
        const bool is_kept = frame.stage.steady && !changes_shape(system_);
        const Stage stage = is_kept ? Stage::steadily(contact_axes<double>) : frame.stage;
        if (scratch.system == of_matrices_ && scratch.stage == stage) return;
        scratch.system = of_matrices_;
        scratch.stage = stage;
        scratch.solver.use_once(stage.growth != 0 || stage.widening != 0);
        with_equations(system_, stage, [&](const auto& equations) {
            for (std::size_t d = 0; d < directions; ++d) {
                for (std::size_t e = 0; e < directions; ++e) {
                    if (d == e || scratch.solver.coupled()) equations.fill(d, e, scratch.solver.new_matrix(d, e));
                }
            }
        });
    }
    // Completes the result except for its tangents, and fills `to`, the slip and the slip work.
    void finish(Frame& frame, State& to) const;
    // The energy released by jumps. Slip work takes the tractions at the end of a stage. Let (x, y) be the integral of
    // x times the displacement caused by y, so that E(p) = (p, p)/2, and p_0, p_1, p_2 the tractions at the start of a
    // step and after its stages. The equations of the stages, s = rigid - u' + (change of u), times their tractions
    // give
    //
    //     work of the rigid bodies = slip work + E(p_2) - E(p_0) + J
    //     J = (b, b)/2,                       b = p_2 - p_0, for one stage (implicit Euler)
    //     J = (b, b)/2 - r (a, b - a),        a = p_1 - p_0, r = StagePlace::ratio(), for two stages (sdirk2)
    //
    // because the kernel is even: the integral of p u' vanishes. While the tractions vary smoothly J is of second order
    // in dq for one stage, of third for two, where b = a/part. If they jump within a step, b stays finite however short
    // the step is, and J is the energy (b, b)/2 that the jump releases in addition, for either scheme, whichever stage
    // the jump is in. A half-length that varies within the step changes J by as much as it changes (b, b). With
    // constant friction rolling has no jumps.
    //
    // A rigid shift is a single stage; the rigid bodies work by the mean of the forces at both ends, so that J is the
    // integral of b s/2.
    double jump_work(const Frame& frame) const {
        if (frame.stage.steady || (frame.rolls() && !slip_dependent)) return 0;
        Scratch& scratch = frame.scratch;
        Vectors &change = scratch.change, &displacement = scratch.right[0];
        const auto start = 1 / units_.shear_modulus * frame.request.from.traction;
        const Vectors& end = scratch.solver.traction();
        const double unit = energy_unit(frame.end), ratio = frame.table.place(1).ratio();
        change = end - start;
        if (!frame.rolls()) return unit * slip_work_.product(change, scratch.slip) / (2 * units_.length);
        const bool two_stages = ratio != 0;
        if (two_stages) scratch.first -= start;
        // the tractions have settled: J is below the rounding of the energies
        const double least = std::numeric_limits<double>::epsilon() * end.squaredNorm();
        if (change.squaredNorm() <= least && (!two_stages || scratch.first.squaredNorm() <= least)) return 0;
        find_displacements(system_, frame.end, change, displacement);
        double sum = slip_work_.product(change, displacement) / 2;
        if (two_stages) {
            change -= scratch.first;
            find_displacements(system_, frame.end, change, displacement);
            sum -= ratio * slip_work_.product(scratch.first, displacement);
        }
        return unit * sum;
    }

    System system_;
    ContactUnits<double> units_;
    RigidSlip<directions, double> slip_;
    ContactForces<directions, double> forces_;
    bool turns_;
    SlipWork slip_work_;
    Friction<Law> friction_;
    std::uint64_t fingerprint_, of_matrices_;
};

template <class Law, int directions>
double FrictionCore<Law, directions>::elastic_energy(const State& state) const {
    const Axes present = axes(state);
    if (!system_.has_G() || check_growth(system_, 0.0, present, present) != Status::ok) return unknown<double>;
    const Vectors traction = state.traction / units_.shear_modulus;
    Vectors displacement = traction;
    find_displacements(system_, present, traction, displacement);
    return energy_unit(present) * slip_work_.product(traction, displacement) / 2;
}

template <class Law, int directions>
FrictionCore<Law, directions>::FrictionCore(const char* who, const ContactUnits<double>& units, System system,
                                                    const Friction<Law>& friction)
    : system_(std::move(system)),
      units_(units),
      slip_(units, inputs(system_), 1.0),
      forces_(units, outputs(system_), 1.0),
      turns_(directions == 2 && system_.elements().half_element_ahead),
      slip_work_(system_.elements(), turns_),
      friction_(friction) {
    require_valid(who, friction, system_.element_count(), size());
    require(friction.memory.distance == 0 || system_.elements().is_one_strip(), who, "distance of the memory",
            friction.memory.distance, "be 0 for elements in several strips");
    friction_.normal_pressure.conservativeResize(size());
    Fingerprint own, pressures;
    for (std::size_t d = 0; d < directions; ++d) {
        for (std::size_t e = 0; e < directions; ++e) own.add(slope(system_, d, e));
    }
    own.add(system_.elements().areas);
    pressures.add(friction_.normal_pressure);  // otherwise a state would continue under another model's pressures
    of_matrices_ = system_.has_G() ? system_.fingerprint() : own.value();
    fingerprint_ = units.fingerprint ^ own.value() ^ pressures.value();
}

template <class Law, int directions>
auto FrictionCore<Law, directions>::at_rest() const -> State {
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
        state.friction_coefficient.setConstant(size(), static_cast<double>(friction_.law(0.0)));
        state.solver.stage_coefficient = state.friction_coefficient;
    }
    if (turns_) state.plain_traction = state.traction;
    return state;
}

template <class Law, int directions>
auto FrictionCore<Law, directions>::check(const State& from, const State& to,
                                                  const Workspace& workspace) const noexcept -> Status {
    const Eigen::Index n = size();
    const auto sized = [n](const State& state) {
        return state.traction.rows() == n && (state.plain_traction.size() == 0 || state.plain_traction.rows() == n) &&
               state.zones.size() == static_cast<std::size_t>(n) && state.normal_pressure.size() == n &&
               state.friction_coefficient.size() == (slip_dependent ? n : 0);
    };
    const bool belongs = &from != &to && from.system == fingerprint_ && sized(from) && sized(to) &&
                         workspace.fits(n, slip_dependent, is_coupled(system_));
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

template <class Law, int directions>
auto FrictionCore<Law, directions>::steady(const Request& request, State& to,
                                                   Workspace& workspace) const noexcept -> Step {
    const auto& [from, travel, creepage, load] = request;
    const Status possible = creepage.is_shift() ? Status::invalid_step : creepage.check_rows(size());
    if (possible != Status::ok) return failed<Step>(possible);
    if (!can_impose(creepage.end())) return failed<Step>(Status::needs_places);
    if (slip_dependent && !is_positive(travel.speed())) return failed<Step>(Status::invalid_step);
    Scratch& scratch = workspace.scratch();
    Frame frame{{creepage, units_.length, axes(load)},
                request,
                system_,
                slip_,
                scratch,
                Bounds(friction_, system_.elements(), from, travel, scratch.falling)};
    return solve(frame, to);
}

template <class Law, int directions>
auto FrictionCore<Law, directions>::roll(const StageTable<double>& table, const Request& request, State& to,
                                                 Workspace& workspace) const noexcept -> Step {
    const auto& [from, travel, motion, load] = request;
    if (slip_dependent && !is_positive(travel.duration)) return failed<Step>(Status::invalid_step);
    if (!can_impose(motion.start()) || !can_impose(motion.end())) return failed<Step>(Status::needs_places);
    Scratch& scratch = workspace.scratch();
    Frame frame{{motion, travel.dq, units_.length, table, axes(from), axes(load)},   request, system_, slip_, scratch,
                Bounds(friction_, system_.elements(), from, travel, scratch.falling)};
    const auto* const rate = load.pressure_rate;
    frame.asked[By::load] = rate != nullptr && rate->size() > 0;
    frame.asked[By::half_length] = rate != nullptr && frame.rolls() && can_breathe(system_);
    if constexpr (directions == 2) {
        frame.asked[By::half_width] = frame.asked[By::half_length] && changes_shape(system_);
    }
    if (frame.asked[By::load]) scratch.bound_rate = bound_per_pressure() * rate->head(size()).matrix();
    return solve(frame, to);
}

template <class Law, int directions>
void FrictionCore<Law, directions>::solve_stage(Frame& frame) const {
    Step& result = frame.result;
    Scratch& scratch = frame.scratch;
    auto& solver = scratch.solver;
    set_matrix(frame);
    frame.bounds.enter(frame);
    if (!frame.place.is_second || frame.request.load.pressure_rate != nullptr) set_bounds(frame);
    const std::size_t count = constant_count(frame);
    for (std::size_t which = 0; which < count; ++which) {
        frame.impose(scratch.displacement[which], solver.constant(which));
    }
    const std::vector<Zone>& zones = frame.place.is_second ? solver.zones() : frame.request.from.zones;
    const auto outcome =
        frame.bounds.solve(solver, scratch.bound, {scratch.start[0], zones, count == 2 ? &scratch.start[1] : nullptr});
    result.complementarity_residual = (std::max)(result.complementarity_residual, outcome.residual);
    result.rounds += outcome.rounds;
    result.path_points += outcome.path_points;
    frame.tangent_exists = frame.tangent_exists && outcome.tangent_exists;
    if (!is_finite(outcome.residual) || !all_finite(solver.slip())) {  // std::max may drop a NaN
        result.status = Status::not_finite;
    } else if (outcome.status != Status::ok && result.status != Status::not_finite) {
        result.status = outcome.status;
    }
    scratch.change = frame.weight() * solver.slip();
    scratch.slip += scratch.change;
    for (std::size_t which = 0; which < count; ++which) scratch.start[which] = solver.traction(which);
    const Axes axes = frame.stage.axes();
    for (Eigen::Index d = 0; d < directions; ++d) {
        slip_work_.add(solver.traction().col(d), scratch.change.col(d), scratch.work,
                       axes.half_length * axes.half_width);
    }
}

template <class Law, int directions>
void FrictionCore<Law, directions>::finish(Frame& frame, State& to) const {
    Scratch& scratch = frame.scratch;
    Step& result = frame.result;
    const Vectors& traction = scratch.solver.traction();
    const double slip_unit = frame.stage.steady ? 1.0 : units_.length;
    slip_work_.end(scratch.work, units_.width * units_.length * units_.shear_modulus * slip_unit);
    scratch.slip *= slip_unit;
    result.force = force_along<directions, double>(forces_.of(traction, frame.end));
    result.slip_work = scratch.work.sum();
    if (result.status == Status::not_finite || !is_finite(result.force) || !is_finite(result.slip_work)) {
        frame.tangent_exists = false;
        scratch.slip.setZero();
        scratch.work.setZero();
        to = frame.request.from;  // sizes are equal: no allocation
        result = failed<Step>(Status::not_finite);
        return;
    }
    result.jump_work = jump_work(frame);
    result.stick_count = scratch.solver.stick_count();
    to.traction = units_.shear_modulus * traction;
    if (turns_) to.plain_traction = units_.shear_modulus * scratch.solver.plain_traction();
    to.zones = scratch.solver.zones();
    to.normal_pressure = frame.request.load.pressure.head(size());
    to.half_length = frame.request.load.half_length;
    to.half_width = frame.request.load.half_width;
    to.system = fingerprint_;
    frame.bounds.finish(to);
}

}  // namespace rollbem::detail
