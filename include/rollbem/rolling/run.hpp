// Run: a model with all that a time loop keeps of one contact, its present state, the next one and a workspace.
#pragma once

#include <utility>

#include "../status.hpp"

namespace rollbem {

/// One contact in a time loop, by any of the models. A step becomes the present state if its status is ok; otherwise
/// the present state stays as it is. try_... leave the result in next(), until accept() makes it the present state: a
/// loop that rejects steps calls it when it is sure. Neither throws nor allocates after construction. Refers to the
/// model, which several runs, and threads, may share.
///
///     Run contact(model);
///     const auto step = contact.advance(dq, creepage);
///     if (step.status != StepStatus::ok) return failed(step.status);
template <class Model_>
class Run {
public:
    using Model = Model_;
    using State = typename Model::State;
    using Step = typename Model::Step;
    using Workspace = typename Model::Workspace;
    using Value = typename Model::Value;

    /// From rest, or from a state of the model.
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

    /// The model's advance: of travel, of motion or of a constant creepage, and of the load if it varies.
    template <class M = Model, class... Load>
    Step advance(const typename M::Travel& travel, const typename M::Motion& motion, const Load&... load) noexcept {
        return commit(try_advance<M>(travel, motion, load...));
    }
    template <class M = Model, class... Load>
    Step advance(const typename M::Travel& travel, const Value& creepage, const Load&... load) noexcept {
        return advance<M>(travel, typename M::Motion(creepage), load...);
    }
    template <class M = Model, class... Load>
    Step try_advance(const typename M::Travel& travel, const typename M::Motion& motion, const Load&... load) noexcept {
        return model_->advance(now_, travel, motion, load..., next_, workspace_);
    }
    template <class M = Model, class... Load>
    Step try_advance(const typename M::Travel& travel, const Value& creepage, const Load&... load) noexcept {
        return try_advance<M>(travel, typename M::Motion(creepage), load...);
    }

    /// The model's steady rolling at a creepage: then a speed if friction depends on slip, and a load if it varies.
    template <class... Rest>
    Step steady(const Value& creepage, const Rest&... rest) noexcept {
        return commit(try_steady(creepage, rest...));
    }
    template <class... Rest>
    Step try_steady(const Value& creepage, const Rest&... rest) noexcept {
        return model_->steady(now_, creepage, rest..., next_, workspace_);
    }
    /// The same with the model's motion, a speed, and a load if it varies.
    template <class M = Model, class... Rest>
    Step steady(const typename M::Motion& motion, const Rest&... rest) noexcept {
        return commit(model_->steady(now_, motion, rest..., next_, workspace_));
    }

    /// The model's rigid shift, in a duration if friction depends on slip.
    template <class... Duration>
    Step shift(const Value& shift, const Duration&... duration) noexcept {
        return commit(model_->shift(now_, shift, duration..., next_, workspace_));
    }

    void accept() noexcept { std::swap(now_, next_); }

private:
    Step commit(const Step& step) noexcept {
        if (step.status == StepStatus::ok) accept();
        return step;
    }

    const Model* model_;
    State now_, next_;
    Workspace workspace_;
};

}  // namespace rollbem
