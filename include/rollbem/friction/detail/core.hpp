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

#include "../../adhesion/integrator.hpp"
#include "../../detail/fingerprint.hpp"
#include "../../detail/finite.hpp"
#include "../../normal/load.hpp"
#include "../../rolling/stage_equations.hpp"
#include "../../scene/contact_units.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../law.hpp"
#include "../state.hpp"
#include "../workspace.hpp"
#include "bounds.hpp"
#include "directions.hpp"
#include "scratch.hpp"
#include "slip_work.hpp"
#include "stage_tangent.hpp"

namespace rollbem::detail {

/// The fingerprint of G' and the elements' areas, by which states are recognised.
template <class Scalar>
std::uint64_t fingerprint_of_steady(const MatrixX<Scalar>& G_prime, const ArrayX<Scalar>& areas) {
    Fingerprint fingerprint;
    fingerprint.add(G_prime);
    fingerprint.add(areas);
    return fingerprint.value();
}
template <class Scalar>
std::uint64_t fingerprint_of_steady(const DirectionBlocks<Scalar>& G_prime, const ArrayX<Scalar>& areas) {
    Fingerprint fingerprint;
    add_blocks(G_prime, fingerprint);
    fingerprint.add(areas);
    return fingerprint.value();
}

/// The part of a friction model that is independent of the origin of its equations. Dimensionless: tractions in G,
/// lengths in the contact's half-length a_0.
template <class Law, int directions, class Scalar>
class FrictionCore {
public:
    using State = FrictionState<directions, Scalar>;
    using Step = FrictionStep<directions, Scalar>;
    using Workspace = FrictionWorkspace<directions, Scalar>;
    using Force = typename Step::Force;
    using Value = typename Directions<directions, Scalar>::Value;
    using System = typename Directions<directions, Scalar>::System;
    using Gradient = typename Directions<directions, Scalar>::Gradient;
    using Motion = RigidMotion<Value>;
    static constexpr bool slip_dependent = !is_constant<Law>;

    /// The load at the end of a step: pressures [Pa] of at least size() elements, half-length and half-width [m].
    struct Load {
        const ArrayX<Scalar>& pressure;
        Scalar half_length, half_width;
        const ArrayX<Scalar>* pressure_rate = nullptr;  // of a step under a load of its own, else null
    };
    using Axes = SemiAxes<Scalar>;

    /// For the unknown elements of a mesh of `element_count`. States are recognised by the fingerprint of G', factors
    /// by that of the whole `system`, which is that of G' in steady rolling. Throws std::invalid_argument, in the name
    /// of `who`, if the law is invalid.
    FrictionCore(const char* who, const ContactUnits<Scalar>& units, const Elements<Scalar>& elements,
                 Eigen::Index element_count, const Friction<Law, Scalar>& friction, const Gradient& G_prime,
                 std::optional<std::uint64_t> system = std::nullopt);

    Eigen::Index size() const { return areas_.size(); }
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
    StepStatus check_width(const State& from, const NormalLoad<Scalar>& load) const noexcept {
        if (load.half_width == 0) {
            return units_.line || load.half_length == from.half_length ? StepStatus::ok : StepStatus::invalid_load;
        }
        return units_.line && load.half_width != units_.half_width ? StepStatus::needs_fixed_mesh : StepStatus::ok;
    }
    std::uint64_t fingerprint() const { return fingerprint_; }
    Workspace workspace() const { return Workspace(size(), slip_dependent, coupled_); }

    State at_rest() const {
        State state{ElementVectors<Scalar, directions>::Zero(size(), directions),
                    std::vector<Zone>(static_cast<std::size_t>(size()), Zone::stick),
                    friction_.normal_pressure,
                    units_.length,
                    units_.half_width,
                    fingerprint_,
                    {},
                    {},
                    {}};
        if constexpr (slip_dependent) {
            state.friction_coefficient.setConstant(size(), static_cast<Scalar>(friction_.law(Scalar(0))));
            state.solver.stage_coefficient = state.friction_coefficient;
        }
        if (behind_.size() > 0) state.plain_traction = state.traction;
        return state;
    }

    Force force(const State& state) const {
        const Axes present = axes(state);
        return total(state.traction, units_.width * state.half_length * present.half_width,
                     arms(state.half_length, present));
    }

    /// NaN if the system cannot represent the half-length.
    Scalar elastic_energy(const State& state, const System& system) const;

    /// Whether states and workspace belong to the model, and whether the load in a state is valid.
    StepStatus check(const State& from, const State& to, const Workspace& workspace) const noexcept;

    /// Whether the rigid slip of a creepage is known.
    bool can_impose([[maybe_unused]] const Value& creepage) const noexcept {
        if constexpr (directions == 1) {
            return true;
        } else {
            return creepage.spin == 0 || spin_.rows() > 0;
        }
    }

    static Step failed(StepStatus status) noexcept {
        Step step;
        step.status = status;
        return step;
    }

    /// A result without the numbers that a scheme gets wrong.
    static Step without_forces(const Step& solved) noexcept {
        if (solved.status != StepStatus::ok && solved.status != StepStatus::no_solution) return solved;
        Step step = failed(StepStatus::assists_creepage);
        step.complementarity_residual = solved.complementarity_residual;
        step.stick_count = solved.stick_count;
        step.rounds = solved.rounds;
        step.path_points = solved.path_points;
        return step;
    }

    /// Steady rolling, s/V = creepage - G' p, sought from `from`, whose load and the given one have been checked. With
    /// `shapes`, a system of many a/b, G' is that of the load's semi-axes.
    Step solve_steady(const Gradient& G_prime, const System* shapes, const State& from, const Motion& creepage,
                      Scalar speed, const Load& load, State& to, Workspace& workspace) const noexcept;

    /// A step by the stages of a table, of a rigid shift by one, under a load that varies linearly from that of `from`
    /// to `load`. Its arguments have been checked, except for the duration.
    Step roll(const System& system, const StageTable<Scalar>& table, const State& from,
              const rollbem::Travel<Scalar>& travel, const Motion& motion, const Load& load, State& to,
              Workspace& workspace) const noexcept;

private:
    using Scratch = FrictionScratch<directions, Scalar>;
    using Vectors = ElementVectors<Scalar, directions>;
    using Stage = RollingStage<Scalar>;
    using Place = StagePlace<Scalar>;
    using Shape = ShapeEquations<Scalar>;
    using Bounds =
        std::conditional_t<slip_dependent, SlipDependentBounds<directions, Scalar>, ConstantBounds<directions, Scalar>>;
    using By = TangentBy<directions>;
    using Tangent = StageTangent<directions, Scalar, Bounds>;

    static constexpr Scalar steadily = -1;  // stands for the distance rolled, which is 0 for a rigid shift
    // with one direction and given bounds, tangents depend on M and the sticking elements alone and are kept
    static constexpr bool keeps_tangents = directions == 1 && !slip_dependent;

    /// Summary of the stages of a step.
    struct Summary {
        Scalar residual = 0;
        int rounds = 0, path_points = 0;
        bool tangent_exists = true, solved = true, finite = true;
    };
    /// Derivatives in addition to those by the creepages.
    struct Asked {
        bool by_load = false, by_half_length = false, by_half_width = false;
    };

    static bool turns(const Elements<Scalar>& elements) { return directions == 2 && elements.half_element_ahead; }
    bool wants_tangents(const Summary& summary) const { return summary.tangent_exists && friction_.with_tangents; }
    static bool is_positive(Scalar value) { return is_finite(value) && value > 0; }

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
    void set_bounds(const ArrayX<Scalar>& pressure, Scratch& scratch) const {
        scratch.bound = bound_per_pressure() * pressure.head(size()).matrix();
        drop_negligible(scratch.bound);
    }
    // With two directions, whose slip is judged by squares, bounds whose squares lose digits are none.
    static void drop_negligible(VectorX<Scalar>& bound) {
        const auto values = bound.array();
        if constexpr (directions == 1) {
            bound = (values < negligible<Scalar>).select(Scalar(0), bound);
        } else {
            bound = (values.square() < negligible<Scalar>).select(Scalar(0), bound);
        }
    }
    // after `progress` of the way from one load to the other
    void set_bounds(const ArrayX<Scalar>& from, const ArrayX<Scalar>& to, Scalar progress, Scratch& scratch) const {
        if (progress == 1) return set_bounds(to, scratch);
        scratch.bound = bound_per_pressure() * (from + progress * (to.head(size()) - from)).matrix();
        drop_negligible(scratch.bound);
    }

    // No slip yet; the first solution is sought from the tractions of `from`.
    void begin(const State& from, Scratch& scratch) const {
        scratch.slip.setZero();
        scratch.work.setZero();
        scratch.start = from.traction / units_.shear_modulus;
        scratch.plain_start = scratch.start;
        if (from.plain_traction.rows() > 0) scratch.plain_start = from.plain_traction / units_.shear_modulus;
        if constexpr (directions == 2) scratch.solver.turn_slip(behind_);
        scratch.solver.want_tangents(friction_.with_tangents || slip_dependent);
    }

    // Whether the matrices of a stage have to be filled.
    bool needs_matrix(const Stage& stage, Scratch& scratch) const {
        if (scratch.system == system_ && scratch.stage == stage) return false;
        scratch.system = system_;
        scratch.stage = stage;
        scratch.solver.use_once(stage.growth != 0 || stage.widening != 0);
        return true;
    }
    // Calls fill(slip, by, M) for the blocks of M.
    template <class Fill>
    static void for_blocks(Scratch& scratch, const Fill& fill) {
        for (std::size_t d = 0; d < directions; ++d) {
            for (std::size_t e = 0; e < directions; ++e) {
                if (d == e || scratch.solver.coupled()) fill(d, e, scratch.solver.new_matrix(d, e));
            }
        }
    }
    static void fill_steady(const Gradient& G_prime, [[maybe_unused]] const System* shapes, Scratch& scratch) {
        if constexpr (directions == 1) {
            scratch.solver.new_matrix() = -G_prime;
        } else {
            for_blocks(scratch, [&](std::size_t d, std::size_t e, MatrixX<Scalar>& M) {
                if (shapes == nullptr) {
                    M = -G_prime[d][e];
                } else {
                    Shape(*shapes->shapes(), shapes->a_over_b(), scratch.stage).fill_slope(-1, d, e, M);
                }
            });
        }
    }
    void enter(const System& system, const Place& place, const Stage& stage, Bounds& bounds, Scratch& scratch) const {
        if (needs_matrix(stage, scratch)) {
            with_equations(system, stage, [&](const auto& equations) {
                for_blocks(scratch, [&](std::size_t d, std::size_t e, MatrixX<Scalar>& M) { equations.fill(d, e, M); });
            });
        }
        bounds.enter(place, stage);
    }

    // The creepage (or the shift) after `progress` of the step.
    static Value between(const Motion& motion, Scalar progress) {
        const Value start = motion.start(), end = motion.end();
        const auto at = [progress](Scalar one, Scalar other) { return one + progress * (other - one); };
        if constexpr (directions == 1) {
            return at(start, end);
        } else {
            return {at(start.longitudinal, end.longitudinal), at(start.lateral, end.lateral), at(start.spin, end.spin)};
        }
    }
    // Spin times a_0.
    Scalar spin_of([[maybe_unused]] const Value& motion) const {
        if constexpr (directions == 1) {
            return 0;
        } else {
            return motion.spin * units_.length;
        }
    }

    // c = factor motion - displacement, with the motion after `progress` of the step
    void impose(const Motion& motion, Scalar progress, Scalar factor, [[maybe_unused]] const Axes& axes,
                const Vectors& displacement, Vectors& constant) const {
        const Value value = between(motion, progress);
        if constexpr (directions == 1) {
            constant.array() = factor * value - displacement.array();
        } else {
            constant = -displacement;
            constant.col(0).array() += factor * value.longitudinal;
            constant.col(1).array() += factor * value.lateral;
            if (value.spin != 0) {
                const Scalar angle = factor * spin_of(value);
                constant.col(0) += angle * axes.half_width * spin_.col(0);
                constant.col(1) += angle * axes.half_length * spin_.col(1);
            }
        }
        if (motion.has_rows()) {
            constant += factor * (1 - progress) * motion.start_rows() + factor * progress * motion.end_rows();
        }
        // without creepage tractions decay for ever, but the rounding that solutions are judged by vanishes earlier
        const bool has_decayed = constant.cwiseAbs().maxCoeff() < negligible<Scalar> && all_finite(constant);
        if (has_decayed) constant.setZero();
    }

    // One stage, c = factor motion - displacement, at these semi-axes, with the motion after `progress` of the step.
    // Its slip is weighted by `weight`. The next stage is sought from its tractions.
    void solve_stage(Bounds& bounds, const Motion& motion, Scalar progress, Scalar factor,
                     const std::vector<Zone>& zones, Scalar weight, const Axes& axes, Scratch& scratch,
                     Summary& summary) const {
        auto& solver = scratch.solver;
        impose(motion, progress, factor, axes, scratch.displacement, solver.constant());
        const bool has_plain = behind_.size() > 0 && scratch.stage.distance != steadily;
        if (has_plain) impose(motion, progress, factor, axes, scratch.plain_displacement, solver.plain_constant());
        const auto outcome =
            bounds.solve(solver, scratch.bound, {scratch.start, zones, has_plain ? &scratch.plain_start : nullptr});
        summary.residual = (std::max)(summary.residual, outcome.residual);
        summary.rounds += outcome.rounds;
        summary.path_points += outcome.path_points;
        summary.tangent_exists = summary.tangent_exists && outcome.tangent_exists;
        summary.solved = summary.solved && outcome.status == StepStatus::ok;
        summary.finite = summary.finite && outcome.status != StepStatus::not_finite && is_finite(outcome.residual) &&
                         all_finite(solver.slip());  // std::max may drop a NaN
        scratch.stage_slip = weight * solver.slip();
        scratch.slip += scratch.stage_slip;
        scratch.start = solver.traction();
        scratch.plain_start = solver.plain_traction();
        for (Eigen::Index d = 0; d < directions; ++d) {
            slip_work_.add(scratch.start.col(d), scratch.stage_slip.col(d), scratch.work,
                           axes.half_length * axes.half_width);
        }
    }

    // Fills `to`, the slip, in multiples of `slip_unit`, the slip work, and the result except for its tangents. Clears
    // summary.tangent_exists if the result is not finite.
    Step finish(const Bounds& bounds, const State& from, Summary& summary, const Load& load, Scalar slip_unit,
                State& to, Scratch& scratch) const {
        slip_work_.end(scratch.work, units_.width * units_.length * units_.shear_modulus * slip_unit);
        scratch.slip *= slip_unit;
        to.system = fingerprint_;
        const Axes present = axes(load);
        const Force force =
            total(scratch.start, units_.width * load.half_length * present.half_width * units_.shear_modulus,
                  arms(load.half_length, present));
        const Scalar work = scratch.work.sum();
        summary.finite = summary.finite && is_finite(force) && is_finite(work);
        if (!summary.finite) {
            summary.tangent_exists = false;
            scratch.slip.setZero();
            scratch.work.setZero();
            to = from;  // of equal sizes
            return failed(StepStatus::not_finite);
        }
        to.traction = units_.shear_modulus * scratch.start;
        if (behind_.size() > 0) to.plain_traction = units_.shear_modulus * scratch.plain_start;
        to.zones = scratch.solver.zones();
        to.normal_pressure = load.pressure.head(size());
        to.half_length = load.half_length;
        to.half_width = load.half_width;
        bounds.finish(to);
        Step step;
        step.force = force;
        step.slip_work = work;
        step.jump_work = 0;
        step.complementarity_residual = summary.residual;
        step.stick_count = scratch.solver.stick_count();
        step.rounds = summary.rounds;
        step.path_points = summary.path_points;
        step.status = summary.solved ? StepStatus::ok : StepStatus::no_solution;
        return step;
    }

    // After the last stage; with constant friction only a shift has jumps.
    void add_jump_work(const System& system, const State& from, Scalar ratio, bool rolls, const Load& load,
                       Scratch& scratch, Step& step) const {
        const Axes present = axes(load);
        const auto start = 1 / units_.shear_modulus * from.traction;
        Scalar work = 0;
        if (!rolls) {
            scratch.change = 1 / units_.length * scratch.slip;
            work = scratch.jump_work.shifted(slip_work_, present, start, scratch.start, scratch.change);
        } else if constexpr (slip_dependent) {
            work = scratch.jump_work.rolled(system, slip_work_, present, ratio, start, scratch.start);
        }
        step.jump_work = units_.width * units_.shear_modulus * units_.length * units_.length * work;
    }

    std::size_t creepage_count() const { return directions == 2 && spin_.rows() == 0 ? 2 : By::creepages; }

    // Calls found(tangent, parameter) with dp by each parameter in scratch.response: by the creepages, unless they are
    // kept, and by what is asked for. `imposed` is the derivative of the motion imposed on the stage by the creepage at
    // the end of the step, `spin` the angle imposed; `carried`: there was an earlier stage.
    template <class Found>
    void for_tangents(Bounds& bounds, const System* system, const Place& place, Scalar imposed, Scalar spin,
                      bool carried, const Asked& asked, const Axes& axes, Scratch& scratch, const Found& found) const {
        const auto tangent = [&](std::size_t parameter) { return Tangent(bounds, scratch, parameter, carried); };
        for (std::size_t creepage = 0; !keeps_tangents && creepage < creepage_count(); ++creepage) {
            Tangent by = tangent(creepage);
            if (creepage < directions) {
                by.by_creepage(imposed);
            } else {
                by.by_spin(imposed * units_.length, axes, spin_);
            }
            found(by, creepage);
        }
        if (asked.by_load) {
            Tangent by = tangent(By::load);
            by.by_load(place.progress);
            found(by, By::load);
        }
        if (asked.by_half_length) {
            Tangent by = tangent(By::half_length);
            by.by_axis(*system, Axis::half_length, place, place.progress * spin, spin_);
            found(by, By::half_length);
        }
        if constexpr (directions == 2) {
            if (!asked.by_half_width) return;
            Tangent by = tangent(By::half_width);
            by.by_axis(*system, Axis::half_width, place, place.progress * spin, spin_);
            found(by, By::half_width);
        }
    }

    // For the second stage, what dp of the first adds to its constants.
    void carry_tangents(Bounds& bounds, const System& system, const Place& place, Scalar imposed, Scalar spin,
                        const Asked& asked, Scratch& scratch) const {
        if constexpr (keeps_tangents) {
            if (scratch.carried_revision != scratch.solver.roles_revision()) {
                Tangent tangent(bounds, scratch, 0, false);
                tangent.by_creepage(1);
                tangent.carry(system, place);
                scratch.carried_revision = scratch.solver.roles_revision();
                scratch.tangent_revision = Scratch::never;
            }
        }
        for_tangents(bounds, &system, place, imposed, spin, false, asked, scratch.stage.axes(), scratch,
                     [&](Tangent& tangent, std::size_t) { tangent.carry(system, place); });
    }

    // By the parameters at the end of the last or only stage; `imposed` and `carried` are the derivatives of the motion
    // imposed on this stage and on an earlier one by the creepage, 0 without an earlier one.
    void add_tangents(Bounds& bounds, const System* system, const Place& place, Scalar imposed, Scalar carried,
                      Scalar spin, const Asked& asked, const Load& load, Scratch& scratch, Step& step) const {
        const Axes present = axes(load);
        const Scalar a = load.half_length, b = present.half_width;
        const Scalar unit = units_.width * a * b * units_.shear_modulus;
        const Arms arm = arms(a, present);
        if constexpr (keeps_tangents) {
            if (scratch.tangent_revision != scratch.solver.roles_revision()) {
                scratch.solver.respond(ones_, scratch.response);
                scratch.unit_tangent = areas_.dot(scratch.response);
                scratch.solver.respond(scratch.carried[0], scratch.response);
                scratch.carried_tangent = areas_.dot(scratch.response);
                scratch.tangent_revision = scratch.solver.roles_revision();
            }
            // without a first stage, carried_tangent is that of an earlier step
            const Scalar last = imposed * scratch.unit_tangent;
            step.tangent = unit * (carried == 0 ? last : last + carried * scratch.carried_tangent);
        }
        const auto found = [&](Tangent&, std::size_t parameter) {
            const Force caused = total(scratch.response, unit, arm);
            if (parameter < By::creepages) {
                if constexpr (directions == 1) {
                    step.tangent = caused;
                } else {
                    auto& by = step.tangent;
                    (parameter == 0 ? by.by_longitudinal : parameter == 1 ? by.by_lateral : by.by_spin) = caused;
                }
            } else if (parameter == By::load) {
                step.tangent_by_load = caused;
            } else if (parameter == By::half_length) {
                const bool follows = keeps_shape(*system);  // the half-width follows
                const Scalar power = follows ? 2 : 1, share = follows ? Scalar(1.5) : Scalar(1);
                step.tangent_by_half_length = total(scratch.start, power * units_.width * b * units_.shear_modulus,
                                                    {(follows ? share : 2) * arm.x, share * arm.y}) +
                                              1 / units_.length * caused;
                if constexpr (directions == 2) {
                    if (follows) step.tangent_by_half_width = {0, 0, 0};
                }
            } else if constexpr (directions == 2) {
                const Force direct = total(scratch.start, units_.width * a * units_.shear_modulus, {arm.x, 2 * arm.y});
                step.tangent_by_half_width = 1 / units_.half_width * (direct + caused);
            }
        };
        for_tangents(bounds, system, place, imposed, spin, carried != 0, asked, present, scratch, found);
    }

    // Of moments [m]: a, and on a patch by the tractions p_x the half-width over that of the contact, times a_0.
    struct Arms {
        Scalar x, y;
    };
    Arms arms(Scalar half_length, const Axes& present) const {
        return {half_length, units_.line ? half_length : present.half_width * units_.length};
    }
    // `factor` times the sum of area times vector; the moment also times `arm`.
    Force total(const Vectors& vectors, Scalar factor, const Arms& arm) const {
        if constexpr (directions == 1) {
            return factor * areas_.dot(vectors);
        } else {
            Force force{factor * areas_.dot(vectors.col(0)), factor * areas_.dot(vectors.col(1))};
            if (moments_.rows() == 0) return force;
            if (units_.line) {
                force.moment = factor * arm.x * moments_.cwiseProduct(vectors).sum();
            } else {
                force.moment = factor * (arm.y * moments_.col(0).dot(vectors.col(0)) +
                                         arm.x * moments_.col(1).dot(vectors.col(1)));
            }
            return force;
        }
    }

    ContactUnits<Scalar> units_;
    VectorX<Scalar> areas_, intervals_;
    ArrayX<Scalar> points_;
    // With two directions, and empty where places are not known: rigid slip of unit spin, and moments of unit
    // tractions.
    Vectors spin_, moments_;
    std::vector<Eigen::Index> behind_;  // the row behind each; empty if slip is not turned
    SlipWork<Scalar> slip_work_;
    VectorX<Scalar> ones_;
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
      areas_(elements.areas.matrix()),
      intervals_(elements.intervals.size() > 0 ? elements.intervals.matrix() : elements.areas.matrix()),
      points_(elements.x),
      slip_work_(elements, turns(elements)),
      ones_(VectorX<Scalar>::Ones(elements.size())),
      friction_(friction),
      coupled_(is_coupled(G_prime)),
      fingerprint_(fingerprint_of_steady(G_prime, elements.areas)),
      system_(system.value_or(fingerprint_)) {
    require_valid(who, friction, element_count, size());
    require(friction.memory.distance == 0 || elements.is_one_strip(), who, "distance of the memory",
            friction.memory.distance, "be 0 for elements in several strips");
    if constexpr (directions == 2) {
        if (elements.places_are_known()) {
            spin_.resize(size(), 2);
            spin_ << -elements.y.matrix(), elements.x.matrix();
            moments_.resize(size(), 2);
            moments_ << -(elements.areas * elements.centre_y).matrix(), (elements.areas * elements.centre_x).matrix();
        }
        if (turns(elements)) behind_ = elements.behind;
    }
    friction_.normal_pressure.conservativeResize(size());
    Fingerprint pressures;  // a state would otherwise continue under the pressures of another model
    pressures.add(friction_.normal_pressure);
    fingerprint_ = units.fingerprint ^ fingerprint_ ^ pressures.value();
}

template <class Law, int directions, class Scalar>
auto FrictionCore<Law, directions, Scalar>::elastic_energy(const State& state, const System& system) const -> Scalar {
    const Axes present = axes(state);
    if (!system.has_G()) return unknown<Scalar>;
    if (check_growth(system, Scalar(0), present, present) != StepStatus::ok) return unknown<Scalar>;
    const ElementVectors<Scalar, directions> traction = state.traction / units_.shear_modulus;
    ElementVectors<Scalar, directions> displacement = traction;
    find_displacements(system, present, traction, displacement);
    return units_.width * units_.length * state.half_length * present.half_width * units_.shear_modulus *
           slip_work_.product(traction, displacement) / 2;
}

template <class Law, int directions, class Scalar>
auto FrictionCore<Law, directions, Scalar>::check(const State& from, const State& to,
                                                  const Workspace& workspace) const noexcept -> StepStatus {
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
        return StepStatus::wrong_state;
    }
    const bool valid = is_finite(from.half_length) && from.half_length > 0 &&
                       (units_.line || (is_finite(from.half_width) && from.half_width > 0)) &&
                       all_pressures(from.normal_pressure);
    return valid ? StepStatus::ok : StepStatus::invalid_load;
}

template <class Law, int directions, class Scalar>
auto FrictionCore<Law, directions, Scalar>::solve_steady(const Gradient& G_prime, const System* shapes,
                                                         const State& from, const Motion& creepage, Scalar speed,
                                                         const Load& load, State& to,
                                                         Workspace& workspace) const noexcept -> Step {
    const StepStatus possible = creepage.is_shift() ? StepStatus::invalid_step : creepage.check_rows(size());
    if (possible != StepStatus::ok) return failed(possible);
    if (!can_impose(creepage.end())) return failed(StepStatus::needs_places);
    if (slip_dependent && !is_positive(speed)) return failed(StepStatus::invalid_step);
    Scratch& scratch = workspace.scratch();
    const Axes present = axes(load);
    Stage stage{.distance = steadily};
    if (shapes != nullptr) {
        stage.half_length = present.half_length;
        stage.half_width = present.half_width;
    }
    if (needs_matrix(stage, scratch)) fill_steady(G_prime, shapes, scratch);
    Bounds bounds = [&] {
        if constexpr (slip_dependent) {
            return Bounds(friction_, intervals_, from, load.half_length, speed, scratch.falling);
        } else {
            return Bounds();
        }
    }();
    begin(from, scratch);
    scratch.displacement.setZero();
    set_bounds(load.pressure, scratch);
    Summary summary;
    solve_stage(bounds, creepage, 1, 1, from.zones, 1, present, scratch, summary);
    Step step = finish(bounds, from, summary, load, 1, to, scratch);
    if (wants_tangents(summary)) add_tangents(bounds, shapes, {1, 1}, 1, 0, 0, {}, load, scratch, step);
    return step;
}

template <class Law, int directions, class Scalar>
auto FrictionCore<Law, directions, Scalar>::roll(const System& system, const StageTable<Scalar>& rolling,
                                                 const State& from, const rollbem::Travel<Scalar>& travel,
                                                 const Motion& motion, const Load& load, State& to,
                                                 Workspace& workspace) const noexcept -> Step {
    if (slip_dependent && !is_positive(travel.duration)) return failed(StepStatus::invalid_step);
    if (!can_impose(motion.start()) || !can_impose(motion.end())) return failed(StepStatus::needs_places);
    Scratch& scratch = workspace.scratch();
    const Scalar dq = travel.dq / units_.length;
    const Axes start = axes(from), end = axes(load);
    // A stage takes `part` of the step: (s/V) part dq = xi part dq + M p - U.
    const StageTable<Scalar> table = dq > 0 ? rolling : StageTable<Scalar>(1, 1);
    const Scalar part = table.part(), ratio = table.place(1).ratio();
    const Scalar imposed = motion.is_shift() ? part / units_.length : part * dq;  // by creepage or shift
    const Asked asked{.by_load = load.pressure_rate != nullptr && load.pressure_rate->size() > 0,
                      .by_half_length = load.pressure_rate != nullptr && dq > 0 && can_breathe(system),
                      .by_half_width = load.pressure_rate != nullptr && dq > 0 && changes_shape(system)};
    if (asked.by_load) {
        scratch.bound_rate = bound_per_pressure() * load.pressure_rate->head(size()).matrix();
    }
    Bounds bounds = [&] {
        if constexpr (slip_dependent) {
            return Bounds(friction_, points_, from, units_.length, travel, scratch.falling);
        } else {
            return Bounds();
        }
    }();
    begin(from, scratch);
    find_displacements(system, start, scratch.start, scratch.displacement);
    if (behind_.size() > 0) find_displacements(system, start, scratch.plain_start, scratch.plain_displacement);
    Summary summary;
    Scalar carried = 0;                  // d(imposed motion of an earlier stage)/d creepage
    set_bounds(load.pressure, scratch);  // for all stages, unless the load varies
    for (int index = 1; index <= table.count(); ++index) {
        const Place place = table.place(index);
        enter(system, place, Stage::of(place, dq, start, end), bounds, scratch);
        if (load.pressure_rate != nullptr) set_bounds(from.normal_pressure, load.pressure, place.progress, scratch);
        solve_stage(bounds, motion, place.progress, imposed, place.is_second ? scratch.solver.zones() : from.zones,
                    place.is_last() ? 1 : ratio, scratch.stage.axes(), scratch, summary);
        if (place.is_last()) break;
        carried = motion.is_linear() ? part * imposed : imposed;
        if constexpr (slip_dependent) scratch.jump_work.keep_first(scratch.start);
        if (wants_tangents(summary)) {
            const Scalar spin = imposed * spin_of(between(motion, place.progress));
            carry_tangents(bounds, system, place, carried, spin, asked, scratch);
        }
        const auto carry = [&](const Vectors& traction, Vectors& displacement) {
            find_displacements(system, scratch.stage.axes(), traction, scratch.change);
            displacement += ratio * (scratch.change - displacement);
        };
        carry(scratch.start, scratch.displacement);
        if (behind_.size() > 0) carry(scratch.plain_start, scratch.plain_displacement);
    }
    Step step = finish(bounds, from, summary, load, units_.length, to, scratch);
    if (summary.finite) add_jump_work(system, from, ratio, dq > 0, load, scratch, step);
    if (wants_tangents(summary)) {
        add_tangents(bounds, &system, table.place(table.count()), imposed, carried, imposed * spin_of(motion.end()),
                     asked, load, scratch, step);
    }
    return step;
}

}  // namespace rollbem::detail
