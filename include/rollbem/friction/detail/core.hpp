// Common core of the steady and the non-steady friction model: solutions for one or two stages, in the contact's units.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
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
#include "../../types.hpp"
#include "../law.hpp"
#include "../state.hpp"
#include "../workspace.hpp"
#include "constant_stages.hpp"
#include "rolling_stage.hpp"
#include "slip_work.hpp"
#include "unchanged_steps.hpp"

namespace rollbem::detail {

/// The part of a friction model that is independent of the origin of the equations s = M p + c. Dimensionless:
/// tractions in G, lengths in the contact's half-length a_0.
template <class Scalar>
class FrictionCore {
public:
    using State = FrictionState<Scalar>;
    using Step = FrictionStep<Scalar>;
    using LoadedStep = LoadedFrictionStep<Scalar>;
    using Workspace = FrictionWorkspace<Scalar>;

    /// `widths` in a_0, `points` the collocation points x/a if they are known, `friction` for the same elements,
    /// `system` the fingerprint of the equations.
    FrictionCore(const Contact<Scalar>& contact, const ArrayX<Scalar>& widths,
                 const std::optional<ArrayX<Scalar>>& points, CoulombFriction<Scalar> friction, std::uint64_t system)
        : half_length_(contact.half_length()),
          width_(2 * contact.half_width()),
          shear_modulus_(contact.shear_modulus()),
          widths_(widths.matrix()),
          slip_work_(widths, points),
          unchanged_steps_(widths.size(), half_length_),
          ones_(VectorX<Scalar>::Ones(widths_.size())),
          fingerprint_(fingerprint_of(contact, system) ^ fingerprint_of_law(friction)),
          friction_(std::move(friction)) {}

    Eigen::Index size() const { return widths_.size(); }
    Scalar half_length() const { return half_length_; }
    const VectorX<Scalar>& widths() const { return widths_; }
    Scalar width() const { return width_; }
    std::uint64_t fingerprint() const { return fingerprint_; }
    State at_rest() const {
        return {VectorX<Scalar>::Zero(size()), std::vector<Zone>(static_cast<std::size_t>(size()), Zone::stick),
                friction_.normal_pressure, half_length_, fingerprint_};
    }
    Scalar force(const State& state) const { return width_ * state.half_length * widths_.dot(state.traction); }

    /// Per unit width [J/m]; NaN if the system cannot represent the half-length.
    Scalar elastic_energy(const State& state, const RollingSystem<Scalar>& system) const {
        const Scalar a = state.half_length / half_length_;
        if (check_growth(system, Scalar(0), a, a) != StepStatus::ok) return std::numeric_limits<Scalar>::quiet_NaN();
        VectorX<Scalar> displacement = VectorX<Scalar>::Zero(size());
        find_displacement<Scalar>(system, a, state.traction, displacement);
        return half_length_ * state.half_length * slip_work_.product(state.traction, displacement) /
               (2 * shear_modulus_);
    }

    bool fits(const State& from, const State& to, const Workspace& workspace) const noexcept {
        const auto sized = [this](const State& state) {
            return state.traction.size() == size() && state.zones.size() == static_cast<std::size_t>(size()) &&
                   state.normal_pressure.size() == size();
        };
        return &from != &to && from.system == fingerprint_ && sized(from) && sized(to) && workspace.size() == size();
    }

    /// Whether the load in a state is valid.
    StepStatus check_load(const State& from) const noexcept {
        const bool valid = is_finite(from.half_length) && from.half_length > 0 && all_pressures(from.normal_pressure);
        return valid ? StepStatus::ok : StepStatus::invalid_load;
    }

    static Step failed(StepStatus status) noexcept {
        Step step;
        step.status = status;
        return step;
    }

    /// The load at the end of a step: pressures [Pa] of at least size() elements, half-length [m].
    struct Load {
        const ArrayX<Scalar>& pressure;
        Scalar half_length;
    };
    /// Starting point of the last stage: zones, and the outcome of the first stage.
    struct Before {
        const std::vector<Zone>* zones;
        Scalar residual = 0;
        int rounds = 0, pivots = 0;
        bool tangent_exists = true, solved = true;
    };
    /// dc of the first and of the last stage by the parameter of the tangent.
    struct Gain {
        Scalar first, last;
    };

    /// Steady rolling, s/V = creepage - G' p, starting from the zones of `from`, under a load that has been checked.
    template <class Stages>
    Step solve_steady(Stages& stages, const State& from, Scalar creepage, const MatrixX<Scalar>& G_prime,
                      const Load& load, State& to, Workspace& workspace) const noexcept {
        if (!is_finite(creepage)) return failed(StepStatus::not_finite);
        if (MatrixX<Scalar>* matrix = claim({.distance = steadily}, workspace)) *matrix = -G_prime;
        workspace.solver_.begin(Effort::equations);
        workspace.solver_.constant().setConstant(creepage);
        press(load.pressure, workspace);
        return solve_last(stages, from, {.zones = &from.zones}, {.first = 0, .last = 1}, load, 1, to, workspace);
    }

    /// The matrix to be filled for a stage; null if the workspace has it.
    MatrixX<Scalar>* claim(const RollingStage<Scalar>& stage, Workspace& workspace) const noexcept {
        if (workspace.system_ == fingerprint_ && workspace.stage_ == stage) return nullptr;
        workspace.system_ = fingerprint_;
        workspace.stage_ = stage;
        return &workspace.solver_.new_matrix();
    }

    /// Sets the bounds mu p_n of the next stage,
    void press(const ArrayX<Scalar>& pressure, Workspace& workspace) const noexcept {
        workspace.bound_ = friction_.friction_coefficient / shear_modulus_ * pressure.head(size()).matrix();
    }
    /// or of a stage that ends within the step, after the share `progress` of the way from one load to the next.
    void press(const ArrayX<Scalar>& from, const ArrayX<Scalar>& to, Scalar progress,
               Workspace& workspace) const noexcept {
        workspace.bound_ =
            friction_.friction_coefficient / shear_modulus_ * (from + progress * (to.head(size()) - from)).matrix();
    }

    /// Starts a step whose stages each roll by `distance`, at the half-length `half_length` in a_0; `grows` if the
    /// half-length changes during the step.
    void remember(const State& from, const RollingSystem<Scalar>& system, Scalar half_length, bool grows,
                  Scalar distance, Workspace& workspace) const noexcept {
        workspace.solver_.begin(grows ? Effort::equations : unchanged_steps_.effort(from, distance));
        workspace.memory_.begin(system, 1 / shear_modulus_ * from.traction, half_length, grows);
    }
    /// After the first of two stages.
    void extrapolate_memory(const RollingSystem<Scalar>& system, Scalar ratio, Workspace& workspace) const noexcept {
        workspace.memory_.extrapolate(system, workspace.solver_.traction(), workspace.stage_.half_length, ratio);
    }
    void impose(Scalar imposed, const RollingSystem<Scalar>& system, Workspace& workspace) const noexcept {
        workspace.memory_.impose(system, imposed, workspace.solver_.constant());
    }

    /// Solves the first of two stages, from the zones of `from`; its slip is weighted by `weight`.
    template <class Stages>
    Before solve_first(Stages& stages, const State& from, Scalar weight, const RollingSystem<Scalar>& system,
                       Workspace& workspace) const noexcept {
        ActiveSet<Scalar>& solver = workspace.solver_;
        const typename ActiveSet<Scalar>::Outcome outcome = stages.solve(solver, workspace.bound_, from.zones);
        set_slip(workspace);
        workspace.slip_ *= weight;
        workspace.work_.setZero();
        slip_work_.add(solver.traction(), workspace.slip_, workspace.work_, workspace.stage_.half_length);
        if constexpr (!Stages::bounds_are_given) {
            workspace.jump_work_.keep_first(solver.traction());
            if (outcome.tangent_exists) {
                stages.respond(solver, ones_, 0, workspace.response_);
                stages.carry_response();
                find_displacement(system, workspace.stage_.half_length, workspace.response_, workspace.carried_);
                workspace.carried_ *= -weight;
            }
            workspace.carried_revision_ = Workspace::never;
        } else if (outcome.tangent_exists && workspace.carried_revision_ != solver.revision()) {
            solver.respond(ones_, workspace.response_);
            find_displacement(system, workspace.stage_.half_length, workspace.response_, workspace.carried_);
            workspace.carried_ *= -weight;
            workspace.carried_revision_ = solver.revision();
            workspace.tangent_revision_ = Workspace::never;
        }
        return {.zones = &solver.zones(),
                .residual = outcome.residual,
                .rounds = outcome.rounds,
                .pivots = outcome.pivots,
                .tangent_exists = outcome.tangent_exists,
                .solved = outcome.status == StepStatus::ok};
    }

    /// Solves the last or only stage. Fills `to` and the workspace's slip, in multiples of `slip_unit`, and slip work.
    template <class Stages>
    Step solve_last(Stages& stages, const State& from, const Before& before, const Gain& gain, const Load& load,
                    Scalar slip_unit, State& to, Workspace& workspace) const noexcept {
        ActiveSet<Scalar>& solver = workspace.solver_;
        const bool only = before.zones == &from.zones;
        if (only) {
            workspace.work_.setZero();
        } else {
            workspace.response_ = workspace.slip_;
        }
        const typename ActiveSet<Scalar>::Outcome outcome = stages.solve(solver, workspace.bound_, *before.zones);
        const Scalar force = widths_.dot(solver.traction());
        set_slip(workspace);
        slip_work_.add(solver.traction(), workspace.slip_, workspace.work_, load.half_length / half_length_);
        slip_work_.end(workspace.work_, half_length_ * shear_modulus_ * slip_unit);
        to.system = fingerprint_;
        const Scalar force_per_width = load.half_length * shear_modulus_ * force;
        const Scalar work_per_width = workspace.work_.sum();
        if (!is_finite(force_per_width) || !is_finite(work_per_width) || !is_finite(before.residual) ||
            outcome.status == StepStatus::not_finite || !all_finite(solver.slip())) {
            workspace.slip_.setZero();
            workspace.work_.setZero();
            to.traction = from.traction;
            to.zones = from.zones;
            to.normal_pressure = from.normal_pressure;
            to.half_length = from.half_length;
            to.unchanged_steps = from.unchanged_steps;
            to.unchanged_distance = from.unchanged_distance;
            return failed(StepStatus::not_finite);
        }
        if (!only) workspace.slip_ += workspace.response_;
        workspace.slip_ *= slip_unit;
        to.zones = solver.zones();
        to.traction = shear_modulus_ * solver.traction();
        to.normal_pressure = load.pressure.head(size());
        to.half_length = load.half_length;
        const bool rolls = workspace.stage_.distance != steadily;
        unchanged_steps_.count(from, workspace.stage_, rolls && solver.unchanged(), to);
        Step step;
        step.stick_count = solver.stick_count();
        step.force_per_width = force_per_width;
        step.force = width_ * step.force_per_width;
        step.slip_work_per_width = work_per_width;
        step.jump_work_per_width = 0;
        if (before.tangent_exists && outcome.tangent_exists) {
            step.tangent_per_width = load.half_length * shear_modulus_ * tangent(stages, gain, workspace);
            step.tangent = width_ * step.tangent_per_width;
        }
        step.complementarity_residual = std::max(before.residual, outcome.residual);
        step.rounds = before.rounds + outcome.rounds;
        step.pivots = before.pivots + outcome.pivots;
        step.status = before.solved ? outcome.status : StepStatus::no_solution;
        return step;
    }

    /// After the last stage of a step from `from`, whose slip is known in the workspace.
    template <class Stages>
    void add_jump_work(const State& from, const RollingSystem<Scalar>& system, bool two_stages, bool rolls,
                       const Load& load, Workspace& workspace, Step& step) const noexcept {
        if (step.status == StepStatus::not_finite) return;
        const auto start = 1 / shear_modulus_ * from.traction;
        const VectorX<Scalar>& end = workspace.solver_.traction();
        const Scalar a = load.half_length / half_length_;
        if (!rolls) {
            const auto slip = 1 / half_length_ * workspace.slip_;
            step.jump_work_per_width = workspace.jump_work_.shifted(slip_work_, a, start, end, slip);
        } else if constexpr (!Stages::bounds_are_given) {
            step.jump_work_per_width = workspace.jump_work_.rolled(system, slip_work_, a, two_stages, start, end);
        }
        step.jump_work_per_width *= shear_modulus_ * half_length_ * half_length_;
    }

    /// Chooses the tangents of the step that follows: by the half-length or not, by the load if there are rates.
    void begin_tangents(const ArrayX<Scalar>& pressure_rate, bool by_half_length, Workspace& workspace) const noexcept {
        LoadTangents<Scalar>& tangents = workspace.load_tangents_;
        tangents.begin(pressure_rate.size() > 0, by_half_length);
        if (!tangents.by_load()) return;
        tangents.bound_change() = friction_.friction_coefficient / shear_modulus_ * pressure_rate.head(size()).matrix();
    }
    /// After the first of two stages.
    template <class Stages>
    void carry_tangents(Stages& stages, const RollingSystem<Scalar>& system, const StagePlace<Scalar>& place,
                        Scalar ratio, Workspace& workspace) const noexcept {
        workspace.load_tangents_.carry(stages, system, workspace.stage_, place, ratio, workspace.solver_);
    }
    /// After the last stage.
    template <class Stages>
    LoadedStep with_tangents(Stages& stages, const Step& step, const RollingSystem<Scalar>& system,
                             const StagePlace<Scalar>& place, const Load& load, Workspace& workspace) const noexcept {
        LoadedStep loaded{step};
        if (is_nan(step.tangent_per_width)) return loaded;  // the others do not exist either
        LoadTangents<Scalar>& tangents = workspace.load_tangents_;
        ActiveSet<Scalar>& solver = workspace.solver_;
        if (tangents.by_load()) {
            const Scalar change = widths_.dot(tangents.respond_to_load(stages, place, solver));
            loaded.tangent_by_load_per_width = load.half_length * shear_modulus_ * change;
            loaded.tangent_by_load = width_ * loaded.tangent_by_load_per_width;
        }
        if (tangents.by_half_length()) {
            const Scalar change =
                widths_.dot(tangents.respond_to_half_length(stages, system, workspace.stage_, place, solver));
            const Scalar force = widths_.dot(solver.traction());
            loaded.tangent_by_half_length_per_width =
                shear_modulus_ * (force + load.half_length / half_length_ * change);
            loaded.tangent_by_half_length = width_ * loaded.tangent_by_half_length_per_width;
        }
        return loaded;
    }

private:
    static constexpr Scalar steadily = -1;  // stands for the distance rolled, which is 0 for a rigid shift

    // Removes the round-off of sticking elements and at the border of slip.
    static void set_slip(Workspace& workspace) {
        const ActiveSet<Scalar>& solver = workspace.solver_;
        workspace.slip_ = solver.signs().cwiseProduct(solver.signs().cwiseProduct(solver.slip()).cwiseMax(Scalar(0)));
    }

    template <class Stages>
    Scalar tangent(Stages& stages, const Gain& gain, Workspace& workspace) const {
        ActiveSet<Scalar>& solver = workspace.solver_;
        if constexpr (!Stages::bounds_are_given) {
            workspace.slip_change_ = gain.last * ones_;
            if (gain.first != 0) workspace.slip_change_ += gain.first * workspace.carried_;
            stages.respond(solver, workspace.slip_change_, gain.first, workspace.response_);
            workspace.tangent_revision_ = Workspace::never;
            return widths_.dot(workspace.response_);
        }
        if (workspace.tangent_revision_ != solver.revision()) {
            solver.respond(ones_, workspace.response_);
            workspace.unit_tangent_ = widths_.dot(workspace.response_);
            solver.respond(workspace.carried_, workspace.response_);
            workspace.carried_tangent_ = widths_.dot(workspace.response_);
            workspace.tangent_revision_ = solver.revision();
        }
        // without a first stage, carried_tangent_ is that of an earlier step
        const Scalar last = gain.last * workspace.unit_tangent_;
        return gain.first == 0 ? last : last + gain.first * workspace.carried_tangent_;
    }

    Scalar half_length_, width_, shear_modulus_;  // a_0 [m], 2b [m], G [Pa]
    VectorX<Scalar> widths_;
    SlipWork<Scalar> slip_work_;
    UnchangedSteps<Scalar> unchanged_steps_;
    VectorX<Scalar> ones_;
    std::uint64_t fingerprint_;
    CoulombFriction<Scalar> friction_;
};

}  // namespace rollbem::detail
