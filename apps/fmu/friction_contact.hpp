// What the FMUs with friction have in common: the contact in the time domain, on a line or a patch.
//
// A step of duration h rolls by V h and shifts the wheel by s h, both at a constant rate, so that V = 0 is a rigid
// shift; the load varies linearly over the step.
#pragma once

#include <initializer_list>
#include <optional>
#include <utility>

#include <rollbem/accuracy/distance_tangent.hpp>
#include <rollbem/detail/require.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/scene/creepage.hpp>
#include <rollbem/scene/force.hpp>

#include "contact_variables.hpp"
#include "model.hpp"

namespace fmu {

/// How long or large a mesh is.
enum MeshLength { mesh_follows_load = 1, fixed_mesh };

/// Coulomb friction in both directions under Hertz's pressure. `Hertz` is a HertzLoad or a HertzPatchLoad. Derived
/// classes add variables, and in initialise() give the contact to begin().
template <class Hertz>
class FrictionContact : public Model {
public:
    using Scalar = double;

    using Model::Model;

    Outcome step(double duration) override {
        Past step = motion(duration);
        rollbem::StepStatus status = check(duration);
        Step result;
        if (status == StepStatus::ok) {
            result = take(step);
            status = result.status;
        }
        status_ = value_of(status);
        if (status != StepStatus::ok) return outcome_of(status);
        std::swap(from_, now_);
        std::swap(now_, next_);
        past_ = step;
        last_ = result;
        slip_work_ += result.slip_work;
        show();
        return Outcome::ok;
    }

    double partial(const Variable& unknown, const Variable& known) override {
        const Scalar* const force = &unknown.real();
        const bool of_force = force == &force_.longitudinal || force == &force_.lateral || force == &force_.moment;
        if (!of_force || known.causality != Causality::input) {
            throw NoDerivative(unknown, known, ": the forces have some by the inputs");
        }
        const bool stepped = past_.duration > 0;
        if (!stepped && initial_state_ == in_steady_rolling) {
            throw NoDerivative(unknown, known, " before the first step");
        }
        const Force by = stepped ? partial_by(known.real()) : Force{0, 0, 0};  // at rest there is no force
        const Scalar value = force == &force_.longitudinal ? by.longitudinal
                             : force == &force_.lateral    ? by.lateral
                                                           : by.moment;
        if (!rollbem::detail::is_finite(value)) {
            throw NoDerivative(unknown, known, " here");
        }
        return value;
    }

    void archive(Archive& archive) override {
        for (State* state : {&now_, &from_}) {
            archive.keep(state->traction);
            archive.keep(state->plain_traction);
            archive.keep(state->zones);
            archive.keep(state->normal_pressure);
            archive.keep(state->half_length);
            archive.keep(state->half_width);
        }
        archive.keep(past_);
        archive.keep(last_);
    }

protected:
    using StepStatus = rollbem::StepStatus;
    using Force = rollbem::TangentialForce<Scalar>;
    using FrictionModel = rollbem::FrictionModel<rollbem::ConstantFriction<Scalar>, 2, Scalar>;
    using Step = FrictionModel::Step;

    // A step.
    struct Past {
        Scalar duration = 0;                // [s]
        rollbem::Creepage<Scalar> shift{};  // [m], spin as an angle
        Scalar distance = 0;                // rolled [m]
        Scalar load = 0;                    // at the end [N]
        Scalar factor = 1;                  // of mu, at the end
        Scalar semi_axes[2] = {0, 0};       // at the end [m]; 0: those of the load
    };

    /// Starts at rest or rolling steadily under the present inputs. `load_width` is what a load is divided by for
    /// `hertz`: the width of a line [m], 1 for a patch.
    void begin(Hertz hertz, FrictionModel model, Scalar load_width) {
        hertz_.emplace(std::move(hertz));
        model_.emplace(std::move(model));
        workspace_.emplace(model_->workspace());
        load_width_ = load_width;
        require(rollbem::detail::is_finite(factor_.value) && factor_.value >= 0, "friction_factor", factor_.value,
                "be finite and not negative");
        end_load_ = hertz_->at(load_.value / load_width_);
        end_load_.normal_pressure *= factor_.value;
        now_ = model_->at_rest();
        now_.normal_pressure = end_load_.normal_pressure.head(model_->size());
        now_.half_length = end_load_.half_length;
        if (end_load_.half_width > 0) now_.half_width = end_load_.half_width;  // of a patch
        from_ = next_ = now_;
        last_ = {};
        last_.force = {0, 0, 0};
        last_.stick_count = model_->size();
        if (initial_state_ == in_steady_rolling) roll_steadily();
        past_ = {};
        slip_work_ = 0;
        show();
    }

    /// Starts without a model, for a class that overrides take(), as after a step.
    void begin(const Past& inputs, const Step& first) {
        hertz_.reset();
        model_.reset();
        now_ = from_ = next_ = {};
        last_ = first;
        past_ = inputs;
        slip_work_ = 0;
        show();
    }

    /// The step under inputs that have been checked, from now_ to next_; force, tangents by the shift and by the load,
    /// slip work and status of the result are used.
    virtual Step take(Past& step) { return advance(now_, step, next_); }

    /// Of the inputs over the next step.
    StepStatus check(Scalar duration) const {
        StepStatus status = StepStatus::ok;
        for (const Input* input : {&slip_[0], &slip_[1], &spin_, &speed_, &load_, &factor_, &axes_[0], &axes_[1]}) {
            const Scalar end = input->after(duration);
            if (!rollbem::detail::is_finite(input->value) || !rollbem::detail::is_finite(end)) {
                return StepStatus::not_finite;
            }
            if (input == &speed_ && (input->value < 0 || end < 0)) status = StepStatus::invalid_step;
            if (input == &factor_ && end < 0) status = StepStatus::invalid_load;
        }
        return status;
    }

    Past motion(Scalar duration) const {
        const auto integral = [duration](const Input& input) {
            return duration * (input.value + input.after(duration)) / 2;
        };
        return {.duration = duration,
                .shift = {integral(slip_[0]), integral(slip_[1]), integral(spin_)},
                .distance = integral(speed_),
                .load = load_.after(duration),
                .factor = factor_.after(duration),
                .semi_axes = {axes_[0].after(duration), axes_[1].after(duration)}};
    }

    /// The creepage of the present inputs. Throws std::invalid_argument unless the contact rolls.
    rollbem::Creepage<Scalar> first_creepage() const {
        require(speed_.value > 0, "rolling_speed", speed_.value, "be positive where initial_state is steady");
        return {slip_[0].value / speed_.value, slip_[1].value / speed_.value, spin_.value / speed_.value};
    }

    /// Of the forces at the end of the last step by an input during it.
    virtual Force partial_by(const Scalar& input) {
        if (&input == &slip_[0].value) return past_.duration * last_.tangent.by_longitudinal;
        if (&input == &slip_[1].value) return past_.duration * last_.tangent.by_lateral;
        if (&input == &spin_.value) return past_.duration * last_.tangent.by_spin;
        if (&input == &load_.value) {
            Force total = last_.tangent_by_load;
            const Scalar load = past_.load / load_width_;
            if (hertz_->breathes()) total = total + hertz_->half_length_rate(load) * last_.tangent_by_half_length;
            return (1 / load_width_) * total;
        }
        if (&input == &factor_.value) return advance(from_, past_, next_, true).tangent_by_load;
        return past_.duration * rollbem::tangent_by_distance(past_.distance, now_.half_length, [&](Scalar distance) {
                   Past step = past_;
                   step.distance = distance;
                   return advance(from_, step, next_).force;
               });
    }

    virtual void show_size(Scalar load) = 0;  // of the contact

    void add_friction_factor() {
        add_input(factor_, "friction_factor", "", "mu over friction_coefficient at the end of a step").min = 0;
    }

    Input slip_[2] = {{0}, {0}}, spin_{0}, speed_{20}, load_{1e5}, factor_{1}, axes_[2] = {{0}, {0}};
    Force force_{0, 0, 0};
    Scalar slip_work_ = 0;
    int sticking_elements_ = 0;
    int initial_state_ = at_rest;
    int status_ = 0;

    std::optional<Hertz> hertz_;
    std::optional<FrictionModel> model_;
    Past past_;
    Step last_;

private:
    using State = FrictionModel::State;

    void roll_steadily() {
        require_finite_inputs();
        const Step steady = model_->steady(now_, {.motion = first_creepage(), .load = end_load_}, next_, *workspace_);
        require(steady.status == StepStatus::ok, "status of steady rolling at the first inputs", name(steady.status),
                "be ok");
        std::swap(now_, next_);
        last_.force = steady.force;
        last_.stick_count = steady.stick_count;
    }

    // `by_factor`: tangent_by_load becomes that with respect to the factor of mu.
    Step advance(const State& from, const Past& step, State& to, bool by_factor = false) {
        Step failed;
        failed.status = hertz_->set(step.load / load_width_, end_load_);
        // under a contact too small for its mesh forces are rough, and as small as its load
        if (failed.status != StepStatus::ok && failed.status != StepStatus::unresolved) return failed;
        // mu as a factor of the pressures, which bound the tractions together
        if (by_factor) end_load_.pressure_rate = end_load_.normal_pressure;
        end_load_.normal_pressure *= step.factor;
        if (!by_factor) end_load_.pressure_rate *= step.factor;
        return model_->advance(from, {step.distance, FrictionModel::Motion::shift(step.shift), end_load_}, to,
                               *workspace_);
    }

    void show() {
        force_ = last_.force;
        show_size(past_.duration > 0 ? past_.load : load_.value);
        sticking_elements_ = static_cast<int>(last_.stick_count);
        const bool computed = past_.duration > 0 || initial_state_ == in_steady_rolling;
        status_ = computed ? value_of(StepStatus::ok) : 0;
    }

    Scalar load_width_ = 1;
    std::optional<rollbem::FrictionWorkspace<2, Scalar>> workspace_;
    rollbem::NormalLoad<Scalar> end_load_;  // of the present step
    State now_, from_, next_;               // from_: where the last step began
};

}  // namespace fmu
