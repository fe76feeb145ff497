// Friction that falls with slip in the units of the programs: --falling, --memory, and models at the rolling velocity
// 1.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include <rollbem/friction/combined_falling.hpp>
#include <rollbem/friction/falling.hpp>

#include "support/options.hpp"

namespace friction {

/// mu/mu_0 of the slip velocity in V mu_0 p0/G, and its memory: distance in a mu_0 p0/G, velocity as that of slip.
struct FallingLaw {
    rollbem::ExponentialFall<double> law;
    rollbem::SlipMemory<double> memory;
};

/// --falling and --memory; std::nullopt without --falling. Throws BadInput, also for what does not go with them.
std::optional<FallingLaw> read_falling(const study::Options& options);

/// A steady model of falling friction with the signatures of the one for constant friction, V = 1.
template <class Model_, class Creepage>
class SteadyFallingOf {
public:
    using Model = Model_;
    using State = typename Model::State;
    using Step = typename Model::Step;

    explicit SteadyFallingOf(Model model) : model_(std::move(model)) {}

    State at_rest() const { return model_.at_rest(); }
    typename Model::Workspace workspace() const { return model_.workspace(); }
    Step solve(const State& from, const Creepage& creepage, State& to, typename Model::Workspace& workspace) const {
        return model_.solve(from, creepage, 1, to, workspace);
    }

private:
    Model model_;
};
using SteadyFalling = SteadyFallingOf<rollbem::SteadyFallingModel<rollbem::ExponentialFall<double>>, double>;
using SteadyCombinedFalling =
    SteadyFallingOf<rollbem::SteadyCombinedFallingModel<rollbem::ExponentialFall<double>>, rollbem::Creepage<double>>;

/// The same in time. A rigid shift takes as long as a step of `dq`.
template <class Model_, class Creepage>
class FallingInTimeOf {
public:
    using Model = Model_;
    using State = typename Model::State;
    using Step = typename Model::Step;
    using Workspace = typename Model::Workspace;
    using Motion = rollbem::RigidMotion<Creepage>;
    using Load = rollbem::NormalLoad<double>;

    FallingInTimeOf(Model model, double dq) : model_(std::move(model)), dq_(dq) {}

    State at_rest() const { return model_.at_rest(); }
    Workspace workspace() const { return model_.workspace(); }
    double elastic_energy_per_width(const State& state) const { return model_.elastic_energy_per_width(state); }
    Step steady(const State& from, const Creepage& creepage, State& to, Workspace& workspace) const {
        return model_.steady(from, creepage, 1, to, workspace);
    }
    Step shift(const State& from, const Creepage& shift, State& to, Workspace& workspace) const {
        return model_.shift(from, shift, dq_, to, workspace);
    }
    Step advance(const State& from, double dq, const Motion& motion, State& to, Workspace& workspace) const {
        return model_.advance(from, dq, dq, motion, to, workspace);
    }
    Step advance(const State& from, double dq, const Motion& motion, const Load& load, State& to,
                 Workspace& workspace) const {
        return model_.advance(from, dq, dq, motion, load, to, workspace);
    }

private:
    Model model_;
    double dq_;
};
using FallingInTime = FallingInTimeOf<rollbem::FallingFrictionModel<rollbem::ExponentialFall<double>>, double>;
using CombinedFallingInTime =
    FallingInTimeOf<rollbem::CombinedFallingModel<rollbem::ExponentialFall<double>>, rollbem::Creepage<double>>;

}  // namespace friction
