// rollbem_adhesion: a contact in full adhesion, by Chebyshev states, in one direction of creepage.
//
// With U = a u, u the displacement coefficients of the library, s the rigid slip velocity and V that of rolling,
//     dU/dt = (V/a) A U - e_0 s,   F = 2b G w . U:
// no creepage s/V is ever formed, so that V = 0 is a rigid shift. Model exchange hands out U and its derivative;
// co-simulation takes the exponential of the matrix, exact for slip and speed that do not change within a step.
#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/adhesion/transient.hpp>
#include <rollbem/detail/require.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "contact_variables.hpp"
#include "model.hpp"

namespace fmu {

namespace {

using Scalar = double;
using rollbem::StepStatus;
using Vector = rollbem::VectorX<Scalar>;

constexpr Eigen::Index state_count = ROLLBEM_FMU_STATES;

enum class Direction { longitudinal = 1, lateral };

const Enumeration directions{"Direction", {{"longitudinal"}, {"lateral"}}};

class Adhesion final : public Model {
public:
    explicit Adhesion(Interface used) : Model(used), displacement_(Vector::Zero(state_count)), rates_(displacement_) {
        for (Variable& variable : parameters_.variables()) add(std::move(variable));
        add({.name = "direction",
             .value = &direction_,
             .description = "Direction of slip velocity and force",
             .items = &directions});
        add({.name = "initial_state",
             .value = &initial_state_,
             .description = "Where the simulation begins",
             .items = &initial_states});
        add({.name = "contact_half_length",
             .value = &half_length_,
             .unit = "m",
             .description = "a that the contact has",
             .causality = Causality::calculated_parameter});
        add({.name = "slip_velocity",
             .value = &slip_.value,
             .unit = "m/s",
             .description = "Velocity of the wheel, as a rigid body, against the rail; creepage times rolling_speed",
             .causality = Causality::input,
             .rate = &slip_.rate});
        add({.name = "rolling_speed",
             .value = &speed_.value,
             .unit = "m/s",
             .description = "V, at which the contact moves along the rail; not negative",
             .causality = Causality::input,
             .rate = &speed_.rate});
        add({.name = "force",
             .value = &force_,
             .unit = "N",
             .description = "Force on the wheel, over the width 2b; against the slip velocity in steady rolling",
             .causality = Causality::output,
             .by_states_alone = true});
        add({.name = "status",
             .value = &status_,
             .description = "What became of the last step or evaluation",
             .causality = Causality::output,
             .items = &step_statuses});
        int first_state = 0;
        for (Eigen::Index k = 0; k < state_count; ++k) {
            const int place = add(
                {.name = state_name(k),
                 .value = &displacement_[k],
                 .unit = "m",
                 .description = "Displacement of wheel against rail, coefficient of T_" + std::to_string(k) + "(x/a)",
                 .causality = Causality::state,
                 .nominal = 1e-6});
            if (k == 0) first_state = place;
        }
        for (Eigen::Index k = 0; k < state_count; ++k) {
            add({.name = "der(" + state_name(k) + ")",
                 .value = &rates_[k],
                 .unit = "m/s",
                 .description = "Its derivative by time",
                 .causality = Causality::derivative,
                 .state = first_state + static_cast<int>(k)});
        }
    }

    void initialise() override {
        require_item("direction", direction_, directions);
        require_item("initial_state", initial_state_, initial_states);
        const rollbem::Contact<Scalar> contact = parameters_.contact();
        half_length_ = contact.half_length();
        if (parameters_.kernel == static_cast<int>(KernelName::plane)) {
            build<rollbem::PlaneKernel<Scalar>>(contact);
        } else {
            build<rollbem::StripKernel<Scalar>>(contact);
        }
        prepared_.reset();
        next_ = from_ = now_ = model_->at_rest();
        if (initial_state_ == static_cast<int>(InitialState::steady)) {
            rollbem::detail::require(speed_.value > 0, "rollbem_adhesion", "rolling_speed", speed_.value,
                                     "be positive where initial_state is steady");
            now_ = model_->steady(slip_.value / speed_.value);
        }
        past_ = {};
        show(now_);
        status_ = value_of(StepStatus::ok);
    }

    Outcome step(Scalar duration) override {
        const Past step{.duration = duration,
                        .shift = duration * (slip_.value + slip_.after(duration)) / 2,
                        .distance = duration * (speed_.value + speed_.after(duration)) / 2};
        StepStatus status = check();
        if (status == StepStatus::ok && speed_.after(duration) < 0) status = StepStatus::invalid_step;
        Scalar force = 0;
        if (status == StepStatus::ok) status = advance(now_, step, next_, force);
        status_ = value_of(status);
        if (status != StepStatus::ok) return outcome_of(status);
        std::swap(from_, now_);
        std::swap(now_, next_);
        past_ = step;
        show(now_);
        force_ = force;
        return Outcome::ok;
    }

    Outcome update() override {
        StepStatus status = check();
        if (status == StepStatus::ok && !rollbem::detail::all_finite(displacement_)) status = StepStatus::not_finite;
        status_ = value_of(status);
        if (status != StepStatus::ok) return outcome_of(status);
        rates_.noalias() = (speed_.value / half_length_) * (A_ * displacement_);
        rates_[0] -= slip_.value;
        force_ = force_weights_.dot(displacement_);
        return Outcome::ok;
    }

    Scalar partial(const Variable& unknown, const Variable& known) override {
        if (unknown.causality == Causality::output || unknown.causality == Causality::derivative) {
            if (used() == Interface::co_simulation) {
                if (known.causality == Causality::input) return partial_of_step(unknown, known);
            } else if (unknown.causality == Causality::output) {
                if (known.causality == Causality::input) return 0;
                if (known.causality == Causality::state) return force_weights_[coefficient(known)];
            } else {
                const Eigen::Index row = coefficient(unknown);
                if (known.causality == Causality::state) {
                    return speed_.value / half_length_ * A_(row, coefficient(known));
                }
                if (&known.real() == &slip_.value) return row == 0 ? -1 : 0;
                if (&known.real() == &speed_.value) return A_.row(row).dot(displacement_) / half_length_;
            }
        }
        throw std::invalid_argument("there is no derivative of " + unknown.name + " by " + known.name);
    }

    void archive(Archive& archive) override {
        archive.keep(now_.traction);
        archive.keep(from_.traction);
        archive.keep(past_);
    }

private:
    using Transient = rollbem::TransientModel<Scalar>;

    // What a step of co-simulation was made of.
    struct Past {
        Scalar duration = 0;  // [s]
        Scalar shift = 0;     // [m]
        Scalar distance = 0;  // rolled [m]
    };

    static std::string state_name(Eigen::Index k) { return "displacement[" + std::to_string(k) + "]"; }

    template <class Kernel>
    void build(const rollbem::Contact<Scalar>& contact) {
        const bool longitudinal = direction_ == static_cast<int>(Direction::longitudinal);
        const auto system = rolling_system(rollbem::Chebyshev{.states = state_count},
                                           longitudinal ? Kernel::longitudinal(contact) : Kernel::lateral(contact));
        model_.emplace(contact, system, verdict(system), rollbem::Integrator::matrix_exponential);
        A_ = system.rates();
        force_weights_ = 2 * contact.half_width() * contact.shear_modulus() * system.weights();
        length_per_traction_ = half_length_ / contact.shear_modulus();
    }

    StepStatus check() const {
        using rollbem::detail::is_finite;
        const bool finite =
            is_finite(slip_.value) && is_finite(slip_.rate) && is_finite(speed_.value) && is_finite(speed_.rate);
        return !finite ? StepStatus::not_finite : speed_.value < 0 ? StepStatus::invalid_step : StepStatus::ok;
    }

    // The slip of a step is even along the way: of second order in its duration where it is not.
    StepStatus advance(const Transient::State& from, const Past& step, Transient::State& to, Scalar& force) {
        if (!rollbem::detail::is_finite(step.distance)) return StepStatus::not_finite;
        if (!prepared_ || step.distance != prepared_->dq()) prepared_ = model_->prepare(step.distance);
        const Transient::Step result =
            model_->advance(from, *prepared_, rollbem::RigidMotion<Scalar>::shift(step.shift), to);
        force = result.force;
        return result.status;
    }

    void show(const Transient::State& state) {
        displacement_ = length_per_traction_ * state.traction;
        force_ = force_weights_.dot(displacement_);
    }

    Eigen::Index coefficient(const Variable& variable) const {
        const Scalar* first = variable.causality == Causality::state ? displacement_.data() : rates_.data();
        return &variable.real() - first;
    }

    // By the slip velocity exactly; by the rolling speed, for which the library has no tangent, by central differences
    // of the step itself.
    Scalar partial_of_step(const Variable& unknown, const Variable& known) {
        if (&unknown.real() != &force_) {
            throw std::invalid_argument("co-simulation has derivatives of the force only");
        }
        if (past_.duration == 0) return 0;
        Scalar force = 0;
        if (&known.real() == &slip_.value) {
            advance(model_->at_rest(), {.duration = past_.duration, .shift = 1, .distance = past_.distance}, next_,
                    force);
            return force * past_.duration;
        }
        const auto force_at = [&](Scalar distance) {
            Past step = past_;
            step.distance = distance;
            advance(from_, step, next_, force);
            return force;
        };
        const Scalar distance = past_.distance, change = 1e-5 * std::max(distance, half_length_);
        if (distance >= change) {
            return (force_at(distance + change) - force_at(distance - change)) / (2 * change) * past_.duration;
        }
        return (4 * force_at(distance + change) - 3 * force_at(distance) - force_at(distance + 2 * change)) /
               (2 * change) * past_.duration;
    }

    ContactParameters parameters_;
    int direction_ = static_cast<int>(Direction::longitudinal);
    int initial_state_ = static_cast<int>(InitialState::rest);
    Scalar half_length_ = 0;
    Input slip_{0}, speed_{20};
    Scalar force_ = 0;
    int status_ = value_of(StepStatus::ok);
    Vector displacement_, rates_;

    std::optional<Transient> model_;
    rollbem::MatrixX<Scalar> A_;      // d u / d(q/a)
    Vector force_weights_;            // [N/m]
    Scalar length_per_traction_ = 0;  // [m/Pa]

    Transient::State now_, from_, next_;  // from_: where the last step began
    Past past_;
    std::optional<Transient::Prepared> prepared_;  // the last distance rolled, for the next is likely to be the same
};

}  // namespace

const Identity identity{.identifier = "rollbem_adhesion",
                        .description =
                            "Tangential rolling contact in full adhesion that remembers, exact but for "
                            "fronts shorter than a few per cent of the contact's length",
                        .model_exchange = true,
                        .stop_time = 0.01,
                        .step_size = 2.5e-5};

std::unique_ptr<Model> make_model(Interface used) { return std::make_unique<Adhesion>(used); }

}  // namespace fmu
