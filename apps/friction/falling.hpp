// Friction that falls with slip in the units of the programs: --falling, --memory, and models at the rolling velocity 1.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include <rollbem/friction/falling.hpp>

#include "support/options.hpp"

namespace friction {

/// mu/mu_0 of the slip velocity in V mu_0 p0/G, and its memory: distance in a mu_0 p0/G, velocity as that of slip.
struct FallingLaw {
    rollbem::ExponentialFall<double> law;
    rollbem::SlipMemory<double> memory;
};

/// --falling and --memory; nothing without. Throws BadInput, also for what does not go with them.
std::optional<FallingLaw> read_falling(const study::Options& options);

/// SteadyFallingModel with the signatures of SteadyFrictionModel, V = 1.
class SteadyFalling {
public:
    using Model = rollbem::SteadyFallingModel<rollbem::ExponentialFall<double>>;
    using State = Model::State;
    using Step = Model::Step;

    explicit SteadyFalling(Model model) : model_(std::move(model)) {}

    State at_rest() const { return model_.at_rest(); }
    Model::Workspace workspace() const { return model_.workspace(); }
    Step solve(const State& from, double creepage, State& to, Model::Workspace& workspace) const {
        return model_.solve(from, creepage, 1, to, workspace);
    }

private:
    Model model_;
};

/// FallingFrictionModel with the signatures of FrictionModel, V = 1; a rigid shift, which would need a duration, is not
/// offered.
class FallingInTime {
public:
    using Model = rollbem::FallingFrictionModel<rollbem::ExponentialFall<double>>;
    using State = Model::State;
    using Step = Model::Step;
    using Workspace = Model::Workspace;
    using Motion = rollbem::RigidMotion<double>;
    using Load = rollbem::NormalLoad<double>;

    explicit FallingInTime(Model model) : model_(std::move(model)) {}

    State at_rest() const { return model_.at_rest(); }
    Workspace workspace() const { return model_.workspace(); }
    Step steady(const State& from, double creepage, State& to, Workspace& workspace) const {
        return model_.steady(from, creepage, 1, to, workspace);
    }
    Step shift(const State&, double, State&, Workspace&) const { return {}; }
    Step advance(const State& from, double dq, const Motion& motion, State& to, Workspace& workspace) const {
        return model_.advance(from, dq, dq, motion, to, workspace);
    }
    Step advance(const State& from, double dq, const Motion& motion, const Load& load, State& to,
                 Workspace& workspace) const {
        return model_.advance(from, dq, dq, motion, load, to, workspace);
    }

private:
    Model model_;
};

}  // namespace friction
