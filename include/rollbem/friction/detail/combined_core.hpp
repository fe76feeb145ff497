// Common part of the steady and the non-steady friction model with both creepages: converts states, loads and results
// between SI units and the dimensionless stages.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../assembly/rolling_system.hpp"
#include "../../detail/finite.hpp"
#include "../../normal/load.hpp"
#include "../../scene/contact.hpp"
#include "../../scene/creepage.hpp"
#include "../../types.hpp"
#include "../combined_state.hpp"
#include "../combined_workspace.hpp"
#include "../law.hpp"
#include "combined_memory.hpp"
#include "combined_tangent.hpp"
#include "rolling_stage.hpp"
#include "slip_work.hpp"

namespace rollbem::detail {

/// Where a solution is sought: at tractions in G and the zones that go with them.
template <class Scalar>
struct CombinedStart {
    const ElementVectors<Scalar>& traction;
    const std::vector<CombinedZone>& zones;
};

/// ConstantStages in two directions.
template <class Scalar>
struct ConstantCombinedStages {
    using Solver = CombinedSolver<Scalar>;
    static constexpr bool bounds_are_given = true;

    void enter(const StagePlace<Scalar>&, const RollingStage<Scalar>&) noexcept {}
    typename Solver::Outcome solve(Solver& solver, const VectorX<Scalar>& bound,
                                   const CombinedStart<Scalar>& start) noexcept {
        return solver.solve(bound, start.traction, start.zones);
    }
    void respond(Solver& solver, const ElementVectors<Scalar>& change, Scalar, ElementVectors<Scalar>& traction_change,
                 std::size_t, const VectorX<Scalar>* bound_change, Scalar share) noexcept {
        if (bound_change == nullptr) {
            solver.respond(change, traction_change);
        } else {
            solver.respond(change, *bound_change, traction_change, share);
        }
    }
    void carry_response(std::size_t) noexcept {}
};

/// The part of a model of combined friction that does not know where its equations s = M p + c come from.
/// Dimensionless: tractions in G, lengths in a_0, the contact's half-length.
template <class Scalar>
class CombinedCore {
public:
    using State = CombinedFrictionState<Scalar>;
    using Step = CombinedFrictionStep<Scalar>;
    using Workspace = CombinedFrictionWorkspace<Scalar>;
    using Memory = CombinedMemory<Scalar>;
    using Force = TangentialForce<Scalar>;

    /// `widths` in a_0, `points` x/a of the equations if known, `friction` of as many elements, `system` the
    /// fingerprint of the equations.
    CombinedCore(const Contact<Scalar>& contact, const ArrayX<Scalar>& widths,
                 const std::optional<ArrayX<Scalar>>& points, CoulombFriction<Scalar> friction, std::uint64_t system)
        : half_length_(contact.half_length()),
          width_(2 * contact.half_width()),
          shear_modulus_(contact.shear_modulus()),
          widths_(widths.matrix()),
          slip_work_(widths, points),
          fingerprint_(fingerprint_of(contact, system) ^ fingerprint_of_law(friction)),
          friction_(std::move(friction)) {}

    Eigen::Index size() const { return widths_.size(); }
    Scalar half_length() const { return half_length_; }
    const VectorX<Scalar>& widths() const { return widths_; }
    std::uint64_t fingerprint() const { return fingerprint_; }
    State at_rest() const {
        return {ElementVectors<Scalar>::Zero(size(), 2),
                std::vector<CombinedZone>(static_cast<std::size_t>(size()), CombinedZone::stick),
                friction_.normal_pressure, half_length_, fingerprint_};
    }
    Force force(const State& state) const { return sum(state.traction, width_ * state.half_length); }
    /// Per unit width [J/m]; not a number for a half-length that the systems do not cover.
    Scalar elastic_energy(const State& state, const SystemPair<Scalar>& systems) const {
        const Scalar a = state.half_length / half_length_;
        Scalar energy = 0;
        VectorX<Scalar> traction(size()), displacement(size());
        for (std::size_t d = 0; d < 2; ++d) {
            if (check_growth(systems[d], Scalar(0), a, a) != StepStatus::ok) {
                return std::numeric_limits<Scalar>::quiet_NaN();
            }
            traction = state.traction.col(static_cast<Eigen::Index>(d));
            find_displacement(systems[d], a, traction, displacement);
            energy += slip_work_.product(traction, displacement) / 2;
        }
        return half_length_ * state.half_length / shear_modulus_ * energy;
    }
    static Memory& memory(Workspace& workspace) { return workspace.memory_; }

    /// ok, wrong_state, or invalid_load if the load of a state is impossible.
    StepStatus check(const State& from, const State& to, const Workspace& workspace) const noexcept {
        const auto sized = [this](const State& state) {
            return state.traction.rows() == size() && state.zones.size() == static_cast<std::size_t>(size()) &&
                   state.normal_pressure.size() == size();
        };
        if (&from == &to || from.system != fingerprint_ || !sized(from) || !sized(to) || workspace.size() != size()) {
            return StepStatus::wrong_state;
        }
        const bool valid = is_finite(from.half_length) && from.half_length > 0 && all_pressures(from.normal_pressure);
        return valid ? StepStatus::ok : StepStatus::invalid_load;
    }

    template <class Result = Step>
    static Result failed(StepStatus status) noexcept {
        Result step;
        step.status = status;
        return step;
    }

    /// Whether the matrices of a stage have to be filled.
    bool claim(const RollingStage<Scalar>& stage, Memory& memory) const noexcept {
        if (memory.system == fingerprint_ && memory.stage == stage) return false;
        memory.system = fingerprint_;
        memory.stage = stage;
        return true;
    }

    /// No slip yet; the first solution is sought from the tractions of `from`.
    void begin(const State& from, Memory& memory) const noexcept {
        memory.slip.setZero();
        memory.work.setZero();
        memory.displacement.setZero();
        memory.start = from.traction / shear_modulus_;
    }
    /// Derivative of the bounds by the load, from that of the pressures [Pa].
    void set_bound_rate(const ArrayX<Scalar>& pressure_rate, Memory& memory) const noexcept {
        memory.bound_rate = friction_.friction_coefficient / shear_modulus_ * pressure_rate.head(size()).matrix();
    }

    /// What holds at the end of a step: pressures [Pa] of at least size() elements, half-length [m].
    struct Load {
        const ArrayX<Scalar>& pressure;
        Scalar half_length;
    };

    /// Summary of the stages of a step.
    struct Course {
        Scalar residual = 0;
        int rounds = 0;
        bool tangent_exists = true, solved = true, finite = true;
    };

    /// One stage, c = imposed - displacement, under memory.pressure; its slip is weighted by `weight`. The next stage
    /// is sought from its tractions.
    template <class Stages>
    void solve(Stages& stages, const Creepage<Scalar>& imposed, const std::vector<CombinedZone>& zones, Scalar weight,
               Memory& memory, Course& course) const noexcept {
        memory.bound = friction_.friction_coefficient / shear_modulus_ * memory.pressure.matrix();
        ElementVectors<Scalar>& constant = memory.solver.constant();
        constant = -memory.displacement;
        constant.col(0).array() += imposed.longitudinal;
        constant.col(1).array() += imposed.lateral;
        const typename CombinedSolver<Scalar>::Outcome outcome =
            stages.solve(memory.solver, memory.bound, {memory.start, zones});
        course.residual = std::max(course.residual, outcome.residual);
        course.rounds += outcome.rounds;
        course.tangent_exists = course.tangent_exists && outcome.tangent_exists;
        course.solved = course.solved && outcome.status == StepStatus::ok;
        course.finite = course.finite && is_finite(outcome.residual);  // std::max may drop a NaN
        memory.slip += weight * memory.solver.slip();
        memory.start = memory.solver.traction();
        for (Eigen::Index d = 0; d < 2; ++d) {
            memory.column = weight * memory.solver.slip().col(d);
            slip_work_.add(memory.start.col(d), memory.column, memory.work, memory.stage.half_length);
        }
    }

    /// Fills `to`, the slip in units of `slip_unit`, and the result except for its tangents.
    void finish(const State& from, const Course& course, const Load& load, Scalar slip_unit, State& to, Memory& memory,
                Step& step) const noexcept {
        slip_work_.end(memory.work);
        memory.work *= half_length_ * shear_modulus_ * slip_unit;
        memory.slip *= slip_unit;
        to.system = fingerprint_;
        const Force force = sum(memory.start, load.half_length * shear_modulus_);
        const Scalar work = memory.work.sum();
        if (!is_finite(force.longitudinal) || !is_finite(force.lateral) || !is_finite(work) ||
            !all_finite(memory.slip) || !course.finite) {
            memory.slip.setZero();
            memory.work.setZero();
            to.traction = from.traction;
            to.zones = from.zones;
            to.normal_pressure = from.normal_pressure;
            to.half_length = from.half_length;
            step.status = StepStatus::not_finite;
            return;
        }
        to.traction = shear_modulus_ * memory.start;
        to.zones = memory.solver.zones();
        to.normal_pressure = load.pressure.head(size());
        to.half_length = load.half_length;
        step.force_per_width = force;
        step.force = times(width_, force);
        step.slip_work_per_width = work;
        step.jump_work_per_width = 0;
        step.complementarity_residual = course.residual;
        step.rounds = course.rounds;
        step.stick_count = memory.solver.stick_count();
        step.status = course.solved ? StepStatus::ok : StepStatus::no_solution;
    }

    /// After finish().
    template <class Stages>
    void add_jump_work(const State& from, const SystemPair<Scalar>& systems, bool two_stages, bool rolls,
                       const Load& load, Memory& memory, Step& step) const noexcept {
        if (step.status == StepStatus::not_finite) return;
        const Scalar a = load.half_length / half_length_;
        for (std::size_t d = 0; d < 2; ++d) {
            const auto column = static_cast<Eigen::Index>(d);
            const auto start = 1 / shear_modulus_ * from.traction.col(column);
            const auto end = memory.start.col(column);
            if (!rolls) {
                const auto slip = 1 / half_length_ * memory.slip.col(column);
                step.jump_work_per_width += memory.jump_work[d].shifted(slip_work_, a, start, end, slip);
            } else if constexpr (!Stages::bounds_are_given) {
                step.jump_work_per_width +=
                    memory.jump_work[d].rolled(systems[d], slip_work_, a, two_stages, start, end);
            }
        }
        step.jump_work_per_width *= shear_modulus_ * half_length_ * half_length_;
    }

    /// Steady rolling, s/V = creepage - G' p, sought from `from` under a load that has been checked.
    template <class Stages>
    Step solve_steady(Stages& stages, const State& from, const Creepage<Scalar>& creepage,
                      const MatrixX<Scalar>& longitudinal_G_prime, const MatrixX<Scalar>& lateral_G_prime,
                      const Load& load, State& to, Workspace& workspace) const noexcept {
        if (!is_finite(creepage)) return failed(StepStatus::not_finite);
        Memory& memory = workspace.memory_;
        // slip work depends on the half-length, the equations do not
        if (claim({.distance = steadily, .half_length = load.half_length / half_length_}, memory)) {
            memory.solver.new_matrix(0) = -longitudinal_G_prime;
            memory.solver.new_matrix(1) = -lateral_G_prime;
        }
        begin(from, memory);
        memory.pressure = load.pressure.head(size());
        Course course;
        solve(stages, creepage, from.zones, 1, memory, course);
        Step step;
        finish(from, course, load, 1, to, memory, step);
        if (step.status != StepStatus::not_finite && course.tangent_exists) {
            add_tangent(stages, 1, false, load.half_length, memory, step);
        }
        return step;
    }

    /// Tangents by both creepages at the end of the last or only stage, with d(part dq xi)/d creepage = `imposed`;
    /// `carried`: memory.carried holds the contribution of an earlier stage.
    template <class Stages>
    void add_tangent(Stages& stages, Scalar imposed, bool carried, Scalar half_length, Memory& memory,
                     Step& step) const noexcept {
        for (const Parameter direction : {Parameter::longitudinal, Parameter::lateral}) {
            CombinedTangent(stages, memory, direction, carried).by_creepage(imposed);
            const Force rate = sum(memory.response, half_length * shear_modulus_);
            const bool along = direction == Parameter::longitudinal;
            (along ? step.tangent_per_width.by_longitudinal : step.tangent_per_width.by_lateral) = rate;
            (along ? step.tangent.by_longitudinal : step.tangent.by_lateral) = times(width_, rate);
        }
    }
    /// By the load, on whose pressures memory.bound_rate depends,
    template <class Stages>
    void add_load_tangent(Stages& stages, bool carried, Scalar half_length, Memory& memory,
                          LoadedCombinedStep<Scalar>& step) const noexcept {
        CombinedTangent(stages, memory, Parameter::load, carried).by_load(1);
        step.tangent_by_load_per_width = sum(memory.response, half_length * shear_modulus_);
        step.tangent_by_load = times(width_, step.tangent_by_load_per_width);
    }
    /// and by the half-length.
    template <class Stages>
    void add_half_length_tangent(Stages& stages, const SystemPair<Scalar>& systems, Scalar part, bool carried,
                                 Scalar half_length, Memory& memory, LoadedCombinedStep<Scalar>& step) const noexcept {
        CombinedTangent(stages, memory, Parameter::half_length, carried).by_half_length(systems, {part, 1});
        const Force own = sum(memory.start, shear_modulus_);
        const Force change = sum(memory.response, half_length / half_length_ * shear_modulus_);
        step.tangent_by_half_length_per_width = {own.longitudinal + change.longitudinal, own.lateral + change.lateral};
        step.tangent_by_half_length = times(width_, step.tangent_by_half_length_per_width);
    }

    /// `factor` times the sum of width times vector.
    Force sum(const ElementVectors<Scalar>& vectors, Scalar factor) const {
        return {factor * widths_.dot(vectors.col(0)), factor * widths_.dot(vectors.col(1))};
    }
    static Force times(Scalar factor, const Force& force) {
        return {factor * force.longitudinal, factor * force.lateral};
    }
    Scalar width() const { return width_; }
    Scalar shear_modulus() const { return shear_modulus_; }
    Scalar friction_coefficient() const { return friction_.friction_coefficient; }

private:
    static constexpr Scalar steadily = -1;  // in place of a distance rolled, which is 0 for a rigid shift

    Scalar half_length_, width_, shear_modulus_;  // a_0 [m], 2b [m], G [Pa]
    VectorX<Scalar> widths_;
    SlipWork<Scalar> slip_work_;
    std::uint64_t fingerprint_;
    CoulombFriction<Scalar> friction_;
};

}  // namespace rollbem::detail
