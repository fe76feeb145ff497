// Stages of a step whose bounds depend on the velocity of slip: what each particle remembers when a stage begins, and
// the solution for tractions and coefficients together. No user includes this by itself.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../falling_state.hpp"
#include "../slip_law.hpp"
#include "active_set.hpp"
#include "falling_set.hpp"
#include "load_tangents.hpp"
#include "rolling_stage.hpp"

namespace rollbem::detail {

/// Values at the rising `points` of a contact as a function of x/a: linear between them and from the last to the leading
/// edge, where it is `ahead`, as in front of it.
template <class Scalar>
class AlongContact {
public:
    AlongContact(const ArrayX<Scalar>& points, const Scalar* values, Scalar ahead)
        : points_(points), values_(values), ahead_(ahead) {}

    /// At places that rise from call to call.
    Scalar operator()(Scalar x) {
        while (next_ < points_.size() && points_[next_] < x) ++next_;
        const bool between = next_ < points_.size();
        const Scalar right = between ? points_[next_] : Scalar(1), value = between ? values_[next_] : ahead_;
        if (next_ == 0 || x >= right) return value;
        const Scalar left = points_[next_ - 1];
        return value + (right - x) / (right - left) * (values_[next_ - 1] - value);
    }

private:
    const ArrayX<Scalar>& points_;
    const Scalar* values_;
    Scalar ahead_;
    Eigen::Index next_ = 0;
};

/// One step or one steady solution. In time, mu of a particle follows its equation along its path through the contact by
/// the same stages as the tractions: implicit Euler, or sdirk2, whose second stage goes on from where the first has led.
template <class Law, class Scalar>
class FallingStages {
public:
    using Vector = VectorX<Scalar>;
    using Workspace = FallingFrictionWorkspace<Scalar>;
    static constexpr bool bounds_are_given = false;

    /// Of a step that rolls by `dq` in `duration` [s] from a half-length, lengths in a_0 = `unit` [m]. `points` are those
    /// of the equations; null where nothing is remembered. Keeps references to all but the numbers.
    FallingStages(const Law& law, const SlipMemory<Scalar>& memory, const ArrayX<Scalar>* points,
                  const ArrayX<Scalar>& friction, Scalar unit, Scalar dq, Scalar duration, Scalar half_length,
                  bool with_tangents, Workspace& workspace) noexcept
        : law_(law),
          memory_(memory),
          with_tangents_(with_tangents),
          points_(points),
          start_(friction),
          unit_(unit),
          dq_(dq),
          duration_(duration),
          half_length_(half_length),
          workspace_(workspace) {
        workspace_.friction_ = friction.matrix();
        if (points == nullptr) workspace_.before_.setZero();
    }

    /// Of steady rolling at a speed [m/s]: each particle has come from the element ahead. Widths in the half-length [m].
    FallingStages(const Law& law, const SlipMemory<Scalar>& memory, const ArrayX<Scalar>& friction, Scalar speed,
                  const Vector& widths, Scalar half_length, bool with_tangents, Workspace& workspace) noexcept
        : law_(law),
          memory_(memory),
          with_tangents_(with_tangents),
          start_(friction),
          steady_(true),
          velocity_per_slip_(speed),
          workspace_(workspace) {
        workspace_.friction_ = friction.matrix();
        workspace_.duration_ = half_length / speed * widths;
    }

    void enter(const StagePlace<Scalar>& place, const RollingStage<Scalar>& stage) noexcept {
        const Scalar duration = place.part * duration_;
        velocity_per_slip_ = unit_ / duration;
        workspace_.duration_.setConstant(duration);
        second_ = place.progress > place.part;
        if (points_ == nullptr) return;
        const auto origin = [&](Index i, Scalar rolled, Scalar half_length) {
            return (stage.half_length * (*points_)[i] + rolled) / half_length;
        };
        AlongContact<Scalar> start(*points_, start_.data(), static_cast<Scalar>(law_(Scalar(0))));
        if (!second_) {
            for (Index i = 0; i < size(); ++i) {
                workspace_.before_[i] = start(origin(i, place.progress * dq_, half_length_));
            }
            first_half_length_ = stage.half_length;
            return;
        }
        workspace_.rise_ = workspace_.friction_ - workspace_.before_;
        AlongContact<Scalar> rise(*points_, workspace_.rise_.data(), Scalar(0));
        AlongContact<Scalar> rise_change(*points_, workspace_.carried_change_.data(), Scalar(0));
        for (Index i = 0; i < size(); ++i) {
            const Scalar between = origin(i, (1 - place.part) * dq_, first_half_length_);
            const Scalar before =
                start(origin(i, place.progress * dq_, half_length_)) + sdirk2_ratio<Scalar> * rise(between);
            workspace_.before_[i] = std::max(before, Scalar(0));  // goes too far where much is forgotten in a step
            workspace_.before_change_[i] = before < 0 ? Scalar(0) : sdirk2_ratio<Scalar> * rise_change(between);
        }
    }

    typename ActiveSet<Scalar>::Outcome solve(ActiveSet<Scalar>& solver, const Vector& pressure,
                                              const std::vector<Zone>& zones) noexcept {
        typename FallingSet<Scalar>::Outcome outcome =
            workspace_.set_.solve(law_, memory_, passage(pressure), zones, solver, workspace_.friction_);
        outcome.solution.residual = std::max(outcome.solution.residual, outcome.change);
        if (!is_finite(outcome.change)) outcome.solution.residual = outcome.change;
        outcome.solution.tangent_exists = outcome.solution.tangent_exists && with_tangents_;
        pressure_ = &pressure;
        return outcome.solution;
    }

    /// dp by a change dc of the stage solved last, to which belongs `carried` times what carry_response() has kept.
    void respond(ActiveSet<Scalar>& solver, const Vector& change, Scalar carried, Vector& traction_change) noexcept {
        const bool remembers = second_ && points_ != nullptr;
        if (remembers) workspace_.rise_ = carried * workspace_.before_change_;
        workspace_.set_.respond(law_, memory_, passage(*pressure_), solver, workspace_.friction_, change,
                                remembers ? &workspace_.rise_ : nullptr, traction_change, workspace_.change_);
    }

    /// After the first of two stages: the response of the second starts from its.
    void carry_response() noexcept { workspace_.carried_change_ = workspace_.change_; }

private:
    using Index = Eigen::Index;

    Index size() const { return start_.size(); }

    FrictionPassage<Scalar> passage(const Vector& pressure) const {
        return {pressure, workspace_.duration_, steady_ ? nullptr : &workspace_.before_, velocity_per_slip_};
    }

    const Law& law_;
    const SlipMemory<Scalar>& memory_;
    bool with_tangents_;
    const ArrayX<Scalar>* points_ = nullptr;
    const ArrayX<Scalar>& start_;  // mu when the step begins
    bool steady_ = false, second_ = false;
    Scalar unit_ = 1, dq_ = 0, duration_ = 0, half_length_ = 1, first_half_length_ = 1;
    Scalar velocity_per_slip_ = 0;  // [m/s] by the solver's slip
    const Vector* pressure_ = nullptr;
    Workspace& workspace_;
};

}  // namespace rollbem::detail
