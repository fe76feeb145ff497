// A step with friction, or steady rolling: the problems of its stages, their solutions, the result and its tangents.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../detail/fingerprint.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../normal/load.hpp"
#include "../../rolling/detail/stage_equations.hpp"
#include "../../rolling/detail/time_step.hpp"
#include "../../scene/creepage.hpp"
#include "../../scene/detail/contact_units.hpp"
#include "../../scene/detail/directions.hpp"
#include "../../scene/patch_contact.hpp"
#include "../../status.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "../law.hpp"
#include "../state.hpp"
#include "slip_dependent_friction.hpp"
#include "slip_work.hpp"
#include "stick_slip.hpp"

namespace rollbem::detail {

/// A contact with friction: constant, and shared by its steps. Dimensionless: tractions in G, lengths in a_0.
template <int directions>
struct ContactData {
    /// `along` is the direction of a system of one, 0 longitudinal or 1 lateral; else 0. Throws std::invalid_argument,
    /// in the name of `who`, if the law is invalid for the system.
    ContactData(const char* who, const ContactUnits& contact_units, ElementSystem<double, directions> of,
                const Friction& friction, Index along = 0)
        : system(std::move(of)),
          units(contact_units),
          rigid(units, inputs(system), 1.0),
          forces(units, outputs(system), 1.0),
          direction(along),
          rotates(directions == 2 && system.elements().half_element_ahead),
          work(system.elements(), rotates),
          law(friction.law),
          memory(friction.memory),
          with_tangents(friction.with_tangents) {
        require(size() >= 1, who, "number of unknown elements", size(), "be at least 1");
        require(is_finite(law.at_rest()) && law.at_rest() >= 0, who,
                law.is_constant() ? "friction_coefficient" : "friction coefficient at rest", law.at_rest(),
                "be finite and not negative");
        require_not_negative(who, "distance of the memory", memory.distance);
        require_not_negative(who, "least_velocity of the memory", memory.least_velocity);
        const ArrayX<double>& pressure = friction.normal_pressure;
        require(pressure.size() == system.element_count(), who, "length of normal_pressure", pressure.size(),
                "equal the number of elements");
        for (const double each : pressure) require_not_negative(who, "normal_pressure", each);
        require(pressure.maxCoeff() > 0, who, "largest normal_pressure", pressure.maxCoeff(), "be positive");
        require(memory.distance == 0 || system.elements().is_one_strip(), who, "distance of the memory",
                memory.distance, "be 0 for elements in several strips");
        normal_pressure = pressure.head(size());
        Fingerprint own, pressures;
        for (std::size_t d = 0; d < directions; ++d) {
            for (std::size_t e = 0; e < directions; ++e) own.add(slope(system, d, e));
        }
        own.add(system.elements().areas);
        pressures.add(normal_pressure);  // otherwise a state would continue under another model's pressures
        matrices = system.has_G() ? system.fingerprint() : own.value();
        fingerprint = units.fingerprint ^ own.value() ^ pressures.value();
    }

    ElementSystem<double, directions> system;
    ContactUnits units;
    RigidSlip<directions> rigid;
    ContactForces<directions> forces;
    Index direction;
    bool rotates;  ///< slip is rotated to its direction at the centres
    SlipWork work;
    Friction::Law law;
    Friction::Memory memory;
    ArrayX<double> normal_pressure;  ///< of the unknown elements [Pa]
    bool with_tangents;
    /// By the former a solver recognises its matrices; by the latter, of G', the areas, the contact and the pressures,
    /// a model its states.
    std::uint64_t matrices, fingerprint;

    Index size() const { return system.size(); }
    bool varies() const { return !law.is_constant(); }
    double bound_per_pressure() const { return (varies() ? 1 : law.at_rest()) / units.shear_modulus; }
    const CentreValues<double>* centres() const { return rotates ? &work.centres() : nullptr; }
    /// The columns of vectors in two directions that belong to the contact.
    template <class Both>
    auto along(Both& vectors) const {
        return vectors.template middleCols<directions>(direction);
    }
    // Unit [J] of the work of tractions in G and displacements in a_0.
    double energy_unit(const SemiAxes& at) const {
        return units.width * units.length * units.length * units.shear_modulus * at.half_length * at.half_width;
    }
};

/// The load at the end of a step: pressures [Pa] of at least all unknown elements, half-length and half-width [m];
/// pressure_rate, d pressure / d load, is null without a load of its own.
struct LoadAtEnd {
    const ArrayX<double>& pressure;
    double half_length, half_width;
    const ArrayX<double>* pressure_rate = nullptr;
};

/// Memory of the tangents of a step, allocated by the constructor.
template <int directions>
struct TangentScratch {
    using By = Parameters<directions>;

    explicit TangentScratch(Index n)
        : rate(Vectors<directions>::Zero(n, directions)),
          bound_rate(VectorX<double>::Zero(n)),
          stage_bound_rate(bound_rate) {
        right.fill(rate);
        response.fill(rate);
        for (PerPass<directions>& each : carried) each.fill(rate);
    }

    std::array<bool, By::count> asked{};  ///< parameters of the wanted tangents
    Vectors<directions> rate;
    PerPass<directions> right, response;                 ///< dc and dp of a tangent
    std::array<PerPass<directions>, By::count> carried;  ///< dc of the second stage caused by the first
    VectorX<double> bound_rate, stage_bound_rate;        ///< d bound / d load at the end of the step; in the stage
    /// The last response to the creepage with one direction. In rolling the next is often the same; its tangent or its
    /// contribution to the second stage is then known.
    struct Memo {
        std::uint64_t revision = 0;  ///< of the linear equations; 0 if nothing is kept
        std::uint64_t contact = 0;   ///< fingerprint: contacts of one system may differ in their units
        double factor_by_end = 0;
        SemiAxes axes = contact_axes;
        double tangent = 0;  ///< of the force, if the stage was the last
    };
    std::array<Memo, 3> memo;  ///< of the first of two stages, of a single stage, and of the second stage
};

/// All memory of a step, allocated by the constructor. Keeps no reference.
template <int directions>
struct StepScratch {
    StepScratch(Index n, bool coupled, bool slip_dependent)
        : solver(n, coupled),
          problem(n),
          solution(n),
          mu(slip_dependent ? n : 0),
          tangents(n),
          first(Vectors<directions>::Zero(n, directions)),
          change(first),
          slip(first),
          work(VectorX<double>::Zero(n)),
          pressure(ArrayX<double>::Zero(n)) {
        start.fill(first);
        displacement.fill(first);
    }

    /// The contact and the stage to which the solver's matrix belongs.
    std::uint64_t matrices = 0;
    std::optional<RollingStage> geometry;
    StickSlipSolver<directions> solver;
    StageProblem<directions> problem;
    StageSolution<directions> solution;
    CoefficientScratch<directions> mu;
    TangentScratch<directions> tangents;
    PerPass<directions> start, displacement;  ///< tractions and displacements from which a stage starts
    Vectors<directions> first;                ///< tractions after the first of two stages
    Vectors<directions> change;               ///< slip of the stage, weighted
    Vectors<directions> slip;                 ///< summed over the stages, in slip_unit, [m] or 1 in steady rolling
    double slip_unit = 1;
    VectorX<double> work;  ///< summed over the stages
    /// Pressures of the present bounds, which are valid [Pa], and bound per pressure; 0 if bounds are of no load.
    ArrayX<double> pressure;
    double bound_per_pressure = 0;

    /// Whether these pressures are known to be valid.
    bool has(const ArrayX<double>& normal_pressure) const {
        return normal_pressure.size() >= pressure.size() &&
               std::memcmp(normal_pressure.data(), pressure.data(),
                           static_cast<std::size_t>(pressure.size()) * sizeof(double)) == 0;
    }
};

/// What a step is solved from, and its memory: references to values of the caller, made on the stack for one step.
template <int directions>
struct StepView {
    const ContactData<directions>& contact;
    const TimeStep<directions>& step;
    const FrictionState& from;
    const LoadAtEnd& load;
    StepScratch<directions>& scratch;

    StageView<directions> stage() const {
        return {scratch.problem, contact.centres(), scratch.solver, scratch.solution};
    }
    Coefficients<directions> coefficients() const {
        return {contact.law, contact.memory, contact.system.elements(), step, from, scratch.mu};
    }
    std::size_t histories() const { return scratch.problem.two_histories ? 2 : 1; }
    /// Tractions of the solved pass to which StageProblem::constant[history] belongs.
    const Vectors<directions>& traction(std::size_t history) const {
        const StageSolution<directions>& solution = scratch.solution;
        return solution.pass[histories() == 1 ? solution.last : solution.last == 0 ? 0 : history].traction;
    }
};

/// Says which tangents are wanted, sets the sums over the stages to 0, and the tractions and displacements from which
/// the first stage starts.
template <int directions>
void begin(const StepView<directions>& view) {
    using By = Parameters<directions>;
    const auto& [contact, step, from, load, scratch] = view;
    const auto* const rate = step.steady ? nullptr : load.pressure_rate;
    auto& asked = scratch.tangents.asked;
    asked = {true};
    asked[By::load] = rate != nullptr && rate->size() > 0;
    asked[By::half_length] = rate != nullptr && step.rolls() && can_breathe(contact.system);
    if constexpr (directions == 2) {
        asked[1] = true;
        asked[2] = contact.system.elements().places_are_known();
        asked[By::half_width] = asked[By::half_length] && changes_shape(contact.system);
    }
    if (asked[By::load])
        scratch.tangents.bound_rate = contact.bound_per_pressure() * rate->head(contact.size()).matrix();

    scratch.work.setZero();
    scratch.problem.two_histories = contact.rotates && !step.steady;
    for (std::size_t k = 0; k < view.histories(); ++k) {
        const bool is_unrotated = view.histories() == 2 && k == 0 && from.unrotated_traction.rows() > 0;
        const ElementVectors& traction = is_unrotated ? from.unrotated_traction : from.traction;
        scratch.start[k] = 1 / contact.units.shear_modulus * contact.along(traction);
        if (step.steady) {
            scratch.displacement[k].setZero();
        } else {
            find_displacements(contact.system, step.start, scratch.start[k], scratch.displacement[k]);
        }
    }
}

/// Fills A of a stage, unless the solver has it. In steady rolling of a contact of constant shape A is -G' at any
/// semi-axes.
template <int directions>
void set_matrix(const ContactData<directions>& contact, const Stage<directions>& now,
                StepScratch<directions>& scratch) {
    SlipMatrix<directions>& A = scratch.solver.matrix;
    const bool is_kept = now.geometry.steady && !changes_shape(contact.system);
    const auto geometry = is_kept ? RollingStage::steadily(contact_axes) : now.geometry;
    if (scratch.matrices == contact.matrices && scratch.geometry == geometry) return;
    scratch.matrices = contact.matrices;
    scratch.geometry = geometry;
    A.serves_once = geometry.growth != 0 || geometry.widening != 0;
    with_equations(contact.system, geometry, [&](const auto& equations) {
        for (std::size_t d = 0; d < directions; ++d) {
            for (std::size_t e = 0; e < directions; ++e) {
                if (d == e || A.coupled()) equations.fill(d, e, A.renew(d, e));
            }
        }
    });
}

/// Sets the bounds of a stage, or p_n/G if mu depends on slip. Bounds that are negligible become 0; with two
/// directions, whose slip is judged by squares, bounds whose squares lose digits.
template <int directions>
void set_bounds(const StepView<directions>& view, const Stage<directions>& now) {
    const auto& [contact, step, from, load, scratch] = view;
    if (now.place.is_second && load.pressure_rate == nullptr) return;
    const bool is_whole =
        load.pressure_rate == nullptr || now.place.is_last() || same_bits(from.normal_pressure, load.pressure);
    if (is_whole && scratch.bound_per_pressure == contact.bound_per_pressure() && scratch.has(load.pressure)) return;
    ++scratch.problem.bounds;
    scratch.bound_per_pressure = is_whole ? contact.bound_per_pressure() : 0;
    if (is_whole) scratch.pressure = load.pressure.head(contact.size());
    VectorX<double>& bound = contact.varies() ? scratch.mu.pressure : scratch.problem.bound;
    const auto end = load.pressure.head(contact.size());
    if (is_whole) {
        bound = contact.bound_per_pressure() * end.matrix();
    } else {
        const auto& start = from.normal_pressure;
        bound = contact.bound_per_pressure() * (start + now.place.progress * (end - start)).matrix();
    }
    const double least = directions == 1 ? negligible<double> : std::sqrt(negligible<double>);
    bound = (bound.array() < least).select(0.0, bound);
}

/// Sets bounds and constants c of a stage: the rigid slip minus the displacements from which it starts.
template <int directions>
void set_problem(const StepView<directions>& view, const Stage<directions>& now) {
    const auto& [contact, step, from, load, scratch] = view;
    set_bounds(view, now);
    for (std::size_t k = 0; k < view.histories(); ++k) {
        Vectors<directions>& c = scratch.problem.constant[k];
        c = -scratch.displacement[k];
        now.add_motion(contact.rigid, c);
        if (step.motion.has_rows()) {
            const double share = now.place.progress;
            c += now.factor * ((1 - share) * step.motion.start_rows() + share * step.motion.end_rows());
        }
        // without creepage tractions decay for ever, but the rounding errors by which solutions are judged underflow
        // first
        scratch.problem.measure(k);
        double& imposed = scratch.problem.imposed[k];
        if (!(imposed < negligible<double> && all_finite(c))) continue;
        c.setZero();
        imposed = 0;
    }
}

/// Solves a stage and adds its slip and work to the sums.
template <int directions>
void solve_stage(const StepView<directions>& view, const Stage<directions>& now, FrictionStep& result) {
    const auto& [contact, step, from, load, scratch] = view;
    const StageView<directions> stage = view.stage();
    auto& solution = stage.solution;
    set_matrix(contact, now, scratch);
    if (contact.varies()) view.coefficients().enter(now);
    set_problem(view, now);
    stage.solver.start(stage.problem, scratch.start, now.place.is_second ? solution.zones : from.zones, solution);
    if (contact.varies()) {
        view.coefficients().solve(now, stage);
    } else {
        stage.solver.solve(stage.problem, stage.centres, contact.with_tangents, solution);
    }
    result.complementarity_residual = (std::max)(result.complementarity_residual, solution.residual);
    result.rounds += solution.rounds;
    result.path_points += solution.path_points;
    if (!is_finite(solution.residual)) {  // std::max may drop a NaN
        result.status = Status::not_finite;
    } else if (solution.status != Status::ok && result.status != Status::not_finite) {
        result.status = solution.status;
    }
    Vectors<directions>& slip = now.place.is_second ? scratch.change : scratch.slip;
    slip = (now.weight * solution.slip().array() + 0.0).matrix();  // no zero is negative
    if (now.place.is_second) scratch.slip += slip;
    const SemiAxes axes = now.geometry.axes();
    for (Index d = 0; d < directions; ++d) {
        contact.work.add(solution.traction().col(d), slip.col(d), scratch.work, axes.half_length * axes.half_width);
    }
}

/// Sets the displacements from which the second stage starts, U + ratio (U_1 - U).
template <int directions>
void start_second(const StepView<directions>& view, const Stage<directions>& now) {
    StepScratch<directions>& scratch = view.scratch;
    if (view.contact.varies()) scratch.first = scratch.solution.traction();
    for (std::size_t k = 0; k < view.histories(); ++k) {
        if constexpr (directions == 2) scratch.start[k] = view.traction(k);
        Vectors<directions>& U = scratch.displacement[k];
        find_displacements(view.contact.system, now.geometry.axes(), view.traction(k), scratch.change);
        U += now.place.ratio() * (scratch.change - U);
    }
}

/// Finds dp of a solved stage by a parameter while no element changes its zone; false if the Memo still holds.
template <int directions>
bool find_response(const StepView<directions>& view, const Stage<directions>& now, std::size_t parameter) {
    const auto& [contact, step, from, load, scratch] = view;
    const StageView<directions> stage = view.stage();
    const StageSolution<directions>& solution = scratch.solution;
    TangentScratch<directions>& own = scratch.tangents;
    const std::uint64_t revision =
        contact.varies() ? view.coefficients().linearise(now, stage) : scratch.solver.roles_revision();
    if (directions == 1 && parameter == 0) {
        auto& memo = own.memo[now.place.is_second ? 2 : now.place.is_last() ? 1 : 0];
        const bool is_known = revision != 0 && revision == memo.revision && memo.contact == contact.fingerprint &&
                              memo.factor_by_end == now.factor_by_end && memo.axes == step.end;
        if (is_known) return false;
        memo = {revision, contact.fingerprint, now.factor_by_end, step.end, 0};
    }
    ProblemChange<directions> change;
    for (std::size_t k = 0; k < view.histories(); ++k) {
        Vectors<directions>& dc = own.right[k];
        now.place.is_second ? void(dc = own.carried[parameter][k]) : void(dc.setZero());
        with_equations(contact.system, now.geometry, [&](const auto& equations) {
            now.add_rate(parameter, view.contact.rigid, equations, view.traction(k), own.rate, dc);
        });
        change.constant[k] = &dc;
    }
    if (parameter == Parameters<directions>::load) {
        own.stage_bound_rate = now.place.progress * own.bound_rate;
        change.bound = &own.stage_bound_rate;
    }
    if (contact.varies()) {
        view.coefficients().respond(now, parameter, change, stage, own.response);
    } else {
        scratch.solver.respond(scratch.problem, solution, change, contact.centres(), own.response);
    }
    return true;
}

/// Keeps the change that dp of the first of two stages causes in the constants of the second.
template <int directions>
void carry_response(const StepView<directions>& view, const Stage<directions>& now, std::size_t parameter) {
    TangentScratch<directions>& own = view.scratch.tangents;
    const bool both = view.histories() == 2 && view.scratch.solution.last == 1;
    for (std::size_t k = 0; k < view.histories(); ++k) {
        const auto& dp = both ? own.response[k] : own.response.back();
        with_equations(view.contact.system, now.geometry, [&](const auto& equations) {
            now.find_carried(parameter, equations, view.traction(k), dp, own.rate, own.carried[parameter][k]);
        });
    }
    if (view.contact.varies()) view.coefficients().carry(parameter);
    if (parameter == 0) own.memo[2].revision = 0;
}

/// The derivative of the forces by a parameter at the end of the step, from dp of its last stage.
template <int directions>
InputVector<directions> tangent_by(const StepView<directions>& view, std::size_t parameter) {
    using By = Parameters<directions>;
    const ContactData<directions>& contact = view.contact;
    const auto& p = view.scratch.solution.traction();
    const auto& dp = view.scratch.tangents.response.back();
    if (!By::is_axis(parameter)) return contact.forces.of(dp, view.step.end);
    return contact.forces.rate(p, dp, view.step.end, By::axis(parameter), keeps_shape(contact.system));
}

/// Forces in two directions: 0 across the direction of a contact of one, with an unknown moment.
template <int directions>
TangentialForce raised(const InputVector<directions>& forces, [[maybe_unused]] Index direction) {
    if constexpr (directions == 2) {
        return {forces[0], forces[1], forces[2]};
    } else {
        if (!is_finite(forces[0])) return {};
        return direction == 0 ? TangentialForce{forces[0], 0} : TangentialForce{0, forces[0]};
    }
}

/// Sets the tangent of a result by a parameter. No force depends on creepage across the direction of a contact of one.
template <int directions>
void set_tangent(const ContactData<directions>& contact, std::size_t parameter, const InputVector<directions>& forces,
                 FrictionStep& result) {
    using By = Parameters<directions>;
    const auto along = static_cast<std::size_t>(contact.direction);
    TangentialForce& tangent = parameter == By::load          ? result.tangent_by_load
                               : parameter == By::half_length ? result.tangent_by_half_length
                               : parameter == By::half_width  ? result.tangent_by_half_width
                                                              : by_creepage(result.tangent, along + parameter);
    tangent = raised<directions>(forces, contact.direction);
    if (directions == 1 && parameter == 0 && is_finite(tangent)) by_creepage(result.tangent, 1 - along) = {0, 0};
    const bool follows = directions == 2 && parameter == By::half_length && keeps_shape(contact.system);
    if (follows) result.tangent_by_half_width = {0, 0, 0};
}

/// Adds the tangents at the end of the last or only stage to the result; keeps the responses of the first of two stages
/// for the second.
template <int directions>
void add_tangents(const StepView<directions>& view, const Stage<directions>& now, FrictionStep& result) {
    TangentScratch<directions>& own = view.scratch.tangents;
    for (std::size_t j = 0; j < own.asked.size(); ++j) {
        if (!own.asked[j]) continue;
        const bool is_new = find_response(view, now, j);
        if (!now.place.is_last()) {
            if (is_new) carry_response(view, now, j);
            continue;
        }
        auto& memo = own.memo[now.place.is_second ? 2 : 1];
        InputVector<directions> tangent = InputVector<directions>::Constant(memo.tangent);
        if (is_new) tangent = tangent_by(view, j);
        if (directions == 1 && j == 0) memo.tangent = tangent[0];
        set_tangent(view.contact, j, tangent, result);
    }
}

/// The energy released by jumps, which slip work misses as it takes the tractions at the end of a stage (theory.md,
/// section 11). Let (x, y) be the integral of x times the displacement caused by y, and p_0, p_1, p_2 the tractions at
/// the start of a step and after its stages:
///
///     J = (b, b)/2,                       b = p_2 - p_0, for one stage (implicit Euler)
///     J = (b, b)/2 - r (a, b - a),        a = p_1 - p_0, r = StagePlace::ratio(), for two stages (sdirk2)
///
/// A half-length that varies within the step changes J by as much as it changes (b, b). With constant friction rolling
/// has no jumps. A rigid shift is a single stage; the rigid bodies work by the mean of the forces at both ends, so that
/// J is the integral of b s/2.
template <int directions>
double jump_work(const StepView<directions>& view) {
    const auto& [contact, step, from, load, scratch] = view;
    if (step.steady || (step.rolls() && !contact.varies())) return 0;
    Vectors<directions>&change = scratch.change, &displacement = scratch.displacement[0];
    const auto start = 1 / contact.units.shear_modulus * contact.along(from.traction);
    const Vectors<directions>& end = scratch.solution.traction();
    const double unit = contact.energy_unit(step.end);
    change = end - start;
    if (!step.rolls()) {
        displacement = contact.units.length * scratch.slip;
        return unit * contact.work.product(change, displacement) / (2 * contact.units.length);
    }
    const bool two_stages = step.stage_count() == 2;
    if (two_stages) scratch.first -= start;
    // the tractions have settled: J is below the rounding of the energies
    const double least = std::numeric_limits<double>::epsilon() * end.squaredNorm();
    if (change.squaredNorm() <= least && (!two_stages || scratch.first.squaredNorm() <= least)) return 0;
    find_displacements(contact.system, step.end, change, displacement);
    double sum = contact.work.product(change, displacement) / 2;
    if (two_stages) {
        change -= scratch.first;
        find_displacements(contact.system, step.end, change, displacement);
        sum -= step.stage(1).place.ratio() * contact.work.product(scratch.first, displacement);
    }
    return unit * sum;
}

/// Completes the result, `to`, the slip and the slip work. If the result is not finite, `to` is a copy of `from`.
template <int directions>
void finish(const StepView<directions>& view, FrictionStep& result, FrictionState& to) {
    const auto& [contact, step, from, load, scratch] = view;
    const ContactUnits& units = contact.units;
    const StageSolution<directions>& solution = scratch.solution;
    scratch.slip_unit = step.steady ? 1.0 : units.length;
    contact.work.end(scratch.work, units.width * units.length * units.shear_modulus * scratch.slip_unit);
    const InputVector<directions> forces = contact.forces.of(solution.traction(), step.end);
    result.force = raised<directions>(forces, contact.direction);
    result.slip_work = scratch.work.sum();
    if (result.status == Status::not_finite || !is_finite(result.force) || !is_finite(result.slip_work)) {
        scratch.slip.setZero();
        scratch.work.setZero();
        to = from;  // sizes are equal: no allocation
        result = failed<FrictionStep>(Status::not_finite);
        return;
    }
    result.jump_work = jump_work(view);
    result.stick_count = solution.stick_count;
    if (directions == 1) to.traction.col(1 - contact.direction).setZero();
    contact.along(to.traction) = units.shear_modulus * solution.traction();
    if constexpr (directions == 2) {
        if (contact.rotates) to.unrotated_traction = units.shear_modulus * solution.pass[0].traction;
    }
    to.zones = solution.zones;
    std::copy_n(load.pressure.data(), contact.size(), to.normal_pressure.data());
    to.half_length = load.half_length;
    to.half_width = load.half_width;
    to.system = contact.fingerprint;
    if (!contact.varies()) return;
    const CoefficientScratch<directions>& mu = scratch.mu;
    to.friction_coefficient = mu.friction.array();
    to.solver.stage_coefficient = (step.stage_count() == 2 && mu.converged_quickly ? mu.first : mu.friction).array();
}

/// Solves a step, or steady rolling, from a checked state under a checked load.
template <int directions>
FrictionStep solve(const StepView<directions>& view, FrictionState& to) noexcept {
    FrictionStep result;
    result.complementarity_residual = 0;
    result.status = Status::ok;
    begin(view);
    bool has_tangents = view.contact.with_tangents;
    for (int number = 1; number <= view.step.stage_count(); ++number) {
        const Stage<directions> now = view.step.stage(number);
        solve_stage(view, now, result);
        has_tangents = has_tangents && view.scratch.solution.has_tangent;
        if (has_tangents) add_tangents(view, now, result);
        if (!now.place.is_last()) start_second(view, now);
    }
    finish(view, result, to);
    return result;
}

}  // namespace rollbem::detail
