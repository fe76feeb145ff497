// Run: a model with the data of one contact in a time loop: its present state, the next one and a workspace.
#pragma once

#include <utility>

#include "../status.hpp"

namespace rollbem {

/// One contact in a time loop, by any of the models. A step becomes the present state if its status is ok; otherwise
/// the present state stays as it is. try_advance() and try_steady() leave the result in next(), until accept() makes it
/// the present state: a loop that rejects steps calls accept() when it is sure. Steps neither throw nor allocate. A Run
/// keeps a reference to the model, which several runs, and threads, may share.
///
///     Run contact(model);
///     const auto step = contact.advance({dq, creepage});
///     if (step.status != Status::ok) return failed(step.status);
template <class Model_>
class Run {
public:
    using Model = Model_;
    using State = typename Model::State;
    using Step = typename Model::Step;
    using Workspace = typename Model::Workspace;
    using RollingStep = typename Model::RollingStep;

    /// Starts from rest, or from a state of the model.
    explicit Run(const Model& model) : Run(model, model.at_rest()) {}
    Run(const Model& model, State from)
        : model_(&model), now_(std::move(from)), next_(model.at_rest()), workspace_(model.workspace()) {}
    explicit Run(Model&&) = delete;
    Run(Model&&, State) = delete;

    const Model& model() const { return *model_; }
    const State& now() const { return now_; }
    State& now() { return now_; }  ///< to restore a state
    const State& next() const { return next_; }
    const Workspace& workspace() const { return workspace_; }

    Step advance(const RollingStep& step) noexcept { return commit(try_advance(step)); }
    Step try_advance(const RollingStep& step) noexcept { return model_->advance(now_, step, next_, workspace_); }
    Step steady(const RollingStep& step) noexcept { return commit(try_steady(step)); }
    Step try_steady(const RollingStep& step) noexcept { return model_->steady(now_, step, next_, workspace_); }

    void accept() noexcept { std::swap(now_, next_); }

private:
    Step commit(const Step& step) noexcept {
        if (step.status == Status::ok) accept();
        return step;
    }

    const Model* model_;
    State now_, next_;
    Workspace workspace_;
};

}  // namespace rollbem
