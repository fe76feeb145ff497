// The evolution of a coefficient of friction that depends on slip, through the stages of a step.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "../../rolling/detail/time_step.hpp"
#include "../../system/detail/along_contact.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "../law.hpp"
#include "slip_dependent_friction.hpp"
#include "stick_slip.hpp"

namespace rollbem::detail {

/// Memory for a coefficient that depends on slip, allocated by the constructor; of size 0 if mu is constant.
template <int directions>
struct CoefficientScratch {
    explicit CoefficientScratch(Index n) : iteration(n) {
        for (VectorX<double>* vector : {&friction, &pressure, &duration, &before, &increment, &first, &change, &bound,
                                        &path_change, &before_change}) {
            vector->setZero(n);
        }
        carried.fill(change);
    }

    SlipDependentFriction<directions> iteration;
    VectorX<double> friction, pressure;  ///< mu and p_n/G of the stage
    VectorX<double> duration, before;    ///< of the stage; mu of each particle before it
    VectorX<double> increment;           ///< change of mu along the paths of particles in the first of two stages
    VectorX<double> first;               ///< mu after the first of two stages
    VectorX<double> change;              ///< d mu of the last tangent
    VectorX<double> bound;               ///< d bound of the last tangent at constant mu
    VectorX<double> path_change;         ///< d before by the half-length, on which the paths of the particles depend
    VectorX<double> before_change;       ///< d before of the last tangent
    std::array<VectorX<double>, Parameters<directions>::count> carried;  ///< d increment of each tangent
    /// Whether Newton's method has converged after few solutions. A second stage then starts from mu at the start of
    /// the step, which is nearer to the solution than mu of the first stage if little changes; after a jump mu of the
    /// first stage is nearer.
    bool converged_quickly = false;
    bool moves_paths = false;  ///< the last tangent was by the half-length
};

/// mu of particles that roll through the contact, integrated along the path of each by the same stages as the
/// tractions. References to values of the caller, made on the stack for one step; bounds are p_n/G.
template <int directions>
struct Coefficients {
    using Step = TimeStep<directions>;
    using Stage = detail::Stage<directions>;

    const FrictionLaw& law;
    const FrictionMemory& memory;
    const Elements<double>& elements;
    const Step& step;
    const ArrayX<double>& start;        ///< mu when the step begins
    const ArrayX<double>& first_guess;  ///< mu from which the first of two stages starts its search, unless empty
    CoefficientScratch<directions>& own;

    /// To be called before a stage is solved. In steady rolling particles arrive from the collocation point ahead.
    void enter(const Stage& now) {
        if (!now.place.is_second) {
            own.friction = start.matrix();
            own.converged_quickly = own.moves_paths = false;
        }
        if (step.steady) {
            const ArrayX<double>& ways = elements.intervals.size() > 0 ? elements.intervals : elements.areas;
            own.duration = now.geometry.half_length * step.unit / step.speed * ways.matrix();
            return;
        }
        own.duration.setConstant(now.place.part * step.duration);
        if (!now.place.is_last() && first_guess.size() == size()) own.friction = first_guess.matrix();
        if (!remembers()) return own.before.setZero(), void();
        AlongContact<double> at_start = along_start();
        if (!now.place.is_second) {
            for (Index i = 0; i < size(); ++i) own.before[i] = at_start(origin(now, i)).value;
            return;
        }
        own.increment = own.friction - own.before;
        if (own.converged_quickly) own.friction = start.matrix();
        AlongContact<double> increment = along_first(own.increment);
        for (Index i = 0; i < size(); ++i) {
            // extrapolation may overshoot if much is forgotten in a step
            const double before = at_start(origin(now, i)).value + now.place.ratio() * increment(between(now, i)).value;
            own.before[i] = (std::max)(before, 0.0);
        }
    }

    void solve(const Stage& now, const StageView<directions>& stage) {
        const auto outcome = own.iteration.solve(evolution(now), stage, own.friction);
        own.converged_quickly = outcome.solutions <= 4 && (own.converged_quickly || !now.place.is_second);
        if (!now.place.is_second) own.first = own.friction;
    }

    /// To be called before respond(). Returns a number that changes whenever the response to a change of c may change;
    /// 0 if there is no such number.
    std::uint64_t linearise(const Stage& now, const StageView<directions>& stage) {
        const std::uint64_t revision = own.iteration.linearise(evolution(now), stage);
        return remembers() && now.place.is_second ? 0 : revision;
    }
    /// Finds dp of the last solved stage by a parameter. Its causes are
    /// - a change of the problem, with the change of p_n/G in place of the bounds,
    /// - the change of the particles' paths, if the parameter is the half-length,
    /// - in the second stage the response of the first, kept by carry().
    void respond(const Stage& now, std::size_t parameter, const ProblemChange<directions>& change,
                 const StageView<directions>& stage, PerPass<directions>& dp) {
        ProblemChange<directions> direct = change;
        const VectorX<double>* before = nullptr;
        own.moves_paths = remembers() && parameter == Parameters<directions>::half_length;
        if (own.moves_paths || (remembers() && now.place.is_second)) {
            own.moves_paths ? find_path_change(now) : void(own.path_change.setZero());
            own.before_change = own.path_change;
            if (now.place.is_second) add_carried(now, parameter);
            before = &own.before_change;
        }
        if (change.bound != nullptr) {
            own.bound = own.friction.cwiseProduct(*change.bound);
            direct.bound = &own.bound;
        }
        own.iteration.respond(evolution(now), stage, direct, before, own.change, dp);
    }
    /// Keeps the response of the first of two stages, on which the response of the second depends.
    void carry(std::size_t parameter) {
        own.carried[parameter] = own.change;
        if (own.moves_paths) own.carried[parameter] -= own.path_change;
    }

private:
    Index size() const { return own.friction.size(); }
    bool remembers() const { return memory.distance > 0 && !step.steady; }

    FrictionEvolution evolution(const Stage& now) const {
        const double per_slip = step.steady ? step.speed : step.unit / (now.place.part * step.duration);
        return {law.of_slip(), memory,  law.at_rest(), own.duration, step.steady ? nullptr : &own.before,
                own.pressure,  per_slip};
    }

    AlongContact<double> along_start() const { return {elements.x, start.data(), law.at_rest()}; }
    AlongContact<double> along_first(const VectorX<double>& change) const { return {elements.x, change.data(), 0.0}; }
    // Position x/a of the particle that arrives at point i, at the start of the step.
    double origin(const Stage& now, Index i) const {
        return (now.geometry.half_length * elements.x[i] + now.place.progress * step.dq) * per_half_length();
    }
    // Position x/a of the same particle at the end of the first stage.
    double between(const Stage& now, Index i) const {
        return (now.geometry.half_length * elements.x[i] + (1 - now.place.part) * step.dq) * per_first(now);
    }
    // 1/half-length at the start of the step; after the first stage.
    double per_half_length() const { return 1 / step.start.half_length; }
    double per_first(const Stage& now) const {
        return 1 / detail::between(step.start.half_length, step.end.half_length, now.place.part);
    }

    // Adds the response of the first stage to the change of the initial coefficients of the second.
    void add_carried(const Stage& now, std::size_t parameter) {
        AlongContact<double> change = along_first(own.carried[parameter]);
        for (Index i = 0; i < size(); ++i) {
            const double added = now.place.ratio() * change(between(now, i)).value;
            if (own.before[i] > 0) own.before_change[i] += added;
        }
    }
    // Finds d before / d half-length at the end of the step; the half-length of a stage changes by `progress` times as
    // much.
    void find_path_change(const Stage& now) {
        AlongContact<double> at_start = along_start(), increment = along_first(own.increment);
        for (Index i = 0; i < size(); ++i) {
            const double point = elements.x[i];
            double& change = own.path_change[i];
            change = at_start(origin(now, i)).slope * now.place.progress * point * per_half_length();
            if (!now.place.is_second) continue;
            const double x = between(now, i),
                         moved = (now.place.progress * point - now.place.part * x) * per_first(now);
            change += now.place.ratio() * increment(x).slope * moved;
            if (!(own.before[i] > 0)) change = 0;
        }
    }
};

}  // namespace rollbem::detail
