// FrictionContact: one type for a contact with friction of any law, along one direction or both, on a line or a patch,
// for programs that choose their model at run time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <variant>

#include <Eigen/Core>

#include "../detail/require.hpp"
#include "../normal/load.hpp"
#include "../rolling/rolling_step.hpp"
#include "../scene/creepage.hpp"
#include "../scene/force.hpp"
#include "../scene/rigid_motion.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "model.hpp"
#include "state.hpp"
#include "workspace.hpp"

namespace rollbem {

/// A FrictionModel whose law and number of directions are chosen at run time. States, motions and results have two
/// directions: a model of one direction reads the components along its own, ignores spin, and returns 0 across its
/// direction and NaN as the moment and the derivatives by spin. Otherwise everything is as in FrictionModel. Immutable;
/// copies share the model. Beside the solution a step costs a virtual call and, in one direction, copies of the states.
/// Run takes a FrictionContact as any model.
///
///     const FrictionContact contact = falls ? FrictionContact(FrictionModel(line, system, verdict, falling))
///                                           : FrictionContact(FrictionModel(line, both, verdict, {0.3, pressure}));
///     Run run(contact);
///     const FrictionStep<2> step = run.advance({{dq, duration}, Creepage{1e-3}});
class FrictionContact {
    template <class Own>
    class Erased;

public:
    using State = FrictionState<2>;
    using Step = FrictionStep<2>;
    using Force = Step::Force;
    using Value = Creepage<double>;
    using Motion = RigidMotion<Value>;
    using RollingStep = rollbem::RollingStep<Motion, GivenLoad<NormalLoad<double>>>;

    /// A workspace for all models with the same number of elements and directions and the same kind of law, like
    /// FrictionWorkspace.
    class Workspace {
    public:
        /// Slip as in FrictionWorkspace::slip(), always in two columns.
        ElementVectors<2> slip() const {
            if (const auto* both = std::get_if<1>(&own_)) return both->slip();
            const VectorX<double>& along = std::get<0>(own_).slip();
            ElementVectors<2> slip = ElementVectors<2>::Zero(along.size(), 2);
            slip.col(direction_) = along;
            return slip;
        }
        const VectorX<double>& slip_work() const {
            return std::visit([](const auto& own) -> const VectorX<double>& { return own.slip_work(); }, own_);
        }

    private:
        template <class Own>
        friend class FrictionContact::Erased;
        template <int directions>
        Workspace(FrictionWorkspace<directions> own, FrictionState<1> rest, Eigen::Index direction)
            : own_(std::move(own)), from_(rest), to_(std::move(rest)), direction_(direction) {}

        std::variant<FrictionWorkspace<1>, FrictionWorkspace<2>> own_;
        FrictionState<1> from_, to_;  // states of a model of one direction
        Eigen::Index direction_;
    };

    /// A model of one direction acts along `direction`, 0 longitudinal or 1 lateral, which must be the direction of its
    /// kernel. Throws std::invalid_argument for any other number.
    template <class Law, int directions>
    FrictionContact(FrictionModel<Law, directions> model, Eigen::Index direction = 0);  // NOLINT: implicit on purpose

    int directions() const { return model_->directions(); }
    Eigen::Index size() const { return model_->size(); }
    std::uint64_t fingerprint() const { return model_->fingerprint(); }
    bool converges() const { return model_->converges(); }
    State at_rest() const { return model_->at_rest(nullptr); }
    State at_rest(const NormalLoad<double>& load) const { return model_->at_rest(&load); }
    Workspace workspace() const { return model_->workspace(); }
    Force force(const State& state) const { return model_->force(state); }
    double elastic_energy(const State& state) const { return model_->elastic_energy(state); }

    Step steady(const State& from, const RollingStep& step, State& to, Workspace& workspace) const noexcept {
        return model_->steady(from, step, to, workspace);
    }
    Step advance(const State& from, const RollingStep& step, State& to, Workspace& workspace) const noexcept {
        return model_->advance(from, step, to, workspace);
    }

private:
    struct Model {
        virtual ~Model() = default;
        virtual int directions() const = 0;
        virtual Eigen::Index size() const = 0;
        virtual std::uint64_t fingerprint() const = 0;
        virtual bool converges() const = 0;
        virtual State at_rest(const NormalLoad<double>* load) const = 0;
        virtual Workspace workspace() const = 0;
        virtual Force force(const State& state) const = 0;
        virtual double elastic_energy(const State& state) const = 0;
        virtual Step steady(const State& from, const RollingStep& step, State& to,
                            Workspace& workspace) const noexcept = 0;
        virtual Step advance(const State& from, const RollingStep& step, State& to,
                             Workspace& workspace) const noexcept = 0;
    };
    std::shared_ptr<const Model> model_;
};

template <class Own>
class FrictionContact::Erased final : public Model {
public:
    static constexpr bool both = Own::directions == 2;

    Erased(Own model, Eigen::Index direction) : model_(std::move(model)), direction_(direction) {}

    int directions() const override { return Own::directions; }
    Eigen::Index size() const override { return model_.size(); }
    std::uint64_t fingerprint() const override { return model_.fingerprint(); }
    bool converges() const override { return model_.converges(); }
    State at_rest(const NormalLoad<double>* load) const override {
        State rest;
        rest.traction.setZero(size(), 2);
        raise(load == nullptr ? model_.at_rest() : model_.at_rest(*load), rest);
        return rest;
    }
    Workspace workspace() const override {
        if constexpr (both) {
            return {model_.workspace(), FrictionState<1>(), 0};
        } else {
            return {model_.workspace(), model_.at_rest(), direction_};
        }
    }
    Force force(const State& state) const override { return raise(model_.force(lower(state))); }
    double elastic_energy(const State& state) const override { return model_.elastic_energy(lower(state)); }
    Step steady(const State& from, const RollingStep& step, State& to, Workspace& workspace) const noexcept override {
        return solve(from, to, workspace, [&](const auto& start, auto& end, auto& own) {
            return model_.steady(start, {step.travel, lower(step.motion), step.load}, end, own);
        });
    }
    Step advance(const State& from, const RollingStep& step, State& to, Workspace& workspace) const noexcept override {
        return solve(from, to, workspace, [&](const auto& start, auto& end, auto& own) {
            return model_.advance(start, {step.travel, lower(step.motion), step.load}, end, own);
        });
    }

private:
    using OwnState = typename Own::State;

    auto lower(const Value& value) const {
        if constexpr (both) {
            return value;
        } else {
            return direction_ == 0 ? value.longitudinal : value.lateral;
        }
    }
    typename Own::Motion lower(const Motion& motion) const {
        if constexpr (both) {
            return motion;
        } else {
            using Moved = typename Own::Motion;
            const double begin = lower(motion.start()), last = lower(motion.end());
            const Moved moved = motion.is_shift()    ? Moved::shift(last)
                                : motion.is_linear() ? Moved::linear(begin, last)
                                                     : Moved(last);
            if (!motion.has_rows()) return moved;
            const auto own = [&](const Motion::RowsView& rows) {
                return typename Moved::RowsView(rows.data() + direction_ * rows.rows(), rows.rows());
            };
            return moved.with_rows(own(motion.start_rows()), own(motion.end_rows()));
        }
    }
    OwnState lower(const State& state) const {
        OwnState own;
        lower(state, own);
        return own;
    }
    // Copies the state, and allocates only if sizes differ.
    void lower(const State& state, OwnState& own) const {
        if constexpr (both) {
            own = state;
        } else {
            own.traction = state.traction.col(direction_);
            copy_rest(state, own);
        }
    }
    void raise(const OwnState& own, State& state) const {
        if constexpr (both) {
            state = own;
        } else {
            state.traction.col(direction_) = own.traction;
            copy_rest(own, state);
        }
    }
    template <class One, class Other>
    static void copy_rest(const One& from, Other& to) {
        to.zones = from.zones;
        to.normal_pressure = from.normal_pressure;
        to.half_length = from.half_length;
        to.half_width = from.half_width;
        to.system = from.system;
        to.friction_coefficient = from.friction_coefficient;
        to.solver = from.solver;
    }

    Force raise(const typename Own::Force& force) const {
        if constexpr (both) {
            return force;
        } else {
            if (!detail::is_finite(force)) return {};
            return direction_ == 0 ? Force{force, 0} : Force{0, force};
        }
    }
    Step raise(const typename Own::Step& own) const {
        if constexpr (both) {
            return own;
        } else {
            Step step;
            step.force = raise(own.force);
            const Force along = raise(own.tangent), across = detail::is_finite(own.tangent) ? Force{0, 0} : Force{};
            step.tangent = direction_ == 0 ? Step::Tangent{along, across, {}} : Step::Tangent{across, along, {}};
            step.tangent_by_load = raise(own.tangent_by_load);
            step.tangent_by_half_length = raise(own.tangent_by_half_length);
            step.tangent_by_half_width = raise(own.tangent_by_half_width);
            step.slip_work = own.slip_work;
            step.jump_work = own.jump_work;
            step.complementarity_residual = own.complementarity_residual;
            step.stick_count = own.stick_count;
            step.rounds = own.rounds;
            step.path_points = own.path_points;
            step.status = own.status;
            return step;
        }
    }

    template <class Solve>
    Step solve(const State& from, State& to, Workspace& workspace, const Solve& call) const {
        auto* const own = std::get_if<Own::directions - 1>(&workspace.own_);
        if (own == nullptr) return detail::failed<Step>(Status::wrong_state);
        if constexpr (both) {
            return call(from, to, *own);
        } else {
            const Eigen::Index n = size();
            const auto fits = [&](const State& state) {
                return state.traction.rows() == n && state.zones.size() == static_cast<std::size_t>(n) &&
                       state.normal_pressure.size() == n && workspace.from_.traction.size() == n &&
                       state.friction_coefficient.size() == workspace.from_.friction_coefficient.size();
            };
            if (&from == &to || !fits(from) || !fits(to)) return detail::failed<Step>(Status::wrong_state);
            workspace.direction_ = direction_;
            lower(from, workspace.from_);
            lower(to, workspace.to_);
            const Step step = raise(call(workspace.from_, workspace.to_, *own));
            raise(workspace.to_, to);
            return step;
        }
    }

    Own model_;
    Eigen::Index direction_;
};

template <class Law, int count>
FrictionContact::FrictionContact(FrictionModel<Law, count> model, Eigen::Index direction)
    : model_(std::make_shared<Erased<FrictionModel<Law, count>>>(std::move(model), direction)) {
    detail::require(direction == 0 || direction == 1, "FrictionContact", "direction", direction, "be 0 or 1");
}

}  // namespace rollbem
