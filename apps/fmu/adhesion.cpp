// rollbem_adhesion: a contact in full adhesion, by Chebyshev states, in one direction of creepage.
//
// With y the unknowns of the library's Chebyshev system, which stand for the traction, and a the half-length, the
// Chebyshev coefficients U of the displacement obey (s the rigid slip velocity, V the rolling velocity)
//     U = a (y - S ln(a/a_0) (w.y) e_0),   dU/dt = (V + da/dt Z) A y - s e_0,   F = 2b G a w.y,
// where a_0 is the half-length that the system was made for, S the strength of the kernel's logarithm, and Z multiplies
// by x/a. The creepage s/V is never formed, so that V = 0 is a rigid shift. Model exchange has U as its states.
// Co-simulation uses the matrix exponential if a is constant, exact for slip and speed that are constant within a step,
// and sdirk2 if a follows the load.
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <rollbem/accuracy/distance_tangent.hpp>
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

enum Direction { in_rolling_direction = 1, across };

enum Length { fixed_length = 1, length_of_load };

const Enumeration directions{"Direction", {{"longitudinal"}, {"lateral"}}};

const Enumeration lengths{"ContactLength",
                          {{"fixed", "of nominal_load"},
                           {"follows_load", "of normal_load; plane kernel, changes of a below the distance rolled"}}};

class Adhesion final : public Model {
public:
    explicit Adhesion(Interface used) : Model(used), displacement_(Vector::Zero(state_count)), rates_(displacement_) {
        parameters_.add_to(*this);
        add_parameter(&direction_, "direction", "", "Direction of slip velocity and force", &directions);
        add_parameter(&length_, "contact_length", "", "Half-length during the simulation", &lengths);
        add_parameter(&initial_state_, "initial_state", "", "State at the start", &initial_states);
        add_input(slip_, "slip_velocity", "m/s",
                  "Velocity of the wheel relative to the rail, as rigid bodies; creepage times rolling_speed");
        add_input(speed_, "rolling_speed", "m/s", "V, the speed of the contact along the rail; not negative");
        add_input(load_, "normal_load", "N",
                  "N over the width 2b, in co-simulation at the end of a step; used where contact_length is "
                  "follows_load");
        add_input(load_rate_, "normal_load_rate", "N/s",
                  "dN/dt, in model exchange; used where contact_length is follows_load");
        add_output(&force_, "force", "N",
                   "Force on the wheel, over the width 2b; opposes the slip velocity in steady rolling")
            .depends_on = {"displacement", "normal_load"};
        add_output(&half_length_, "contact_half_length", "m", "a").depends_on = {"normal_load"};
        add_output(&status_, "status", "", "Status of the last step or evaluation", &step_statuses);
        const int first_state = static_cast<int>(variables().size());
        const std::string meaning = "Displacement of the wheel relative to the rail, coefficient of T_";
        for (Eigen::Index k = 0; k < state_count; ++k) {
            add({state_name(k), &displacement_[k], "m", meaning + std::to_string(k) + "(x/a)", Causality::state})
                .nominal = 1e-6;
        }
        for (int k = 0; k < state_count; ++k) {
            add({"der(" + state_name(k) + ")", &rates_[k], "m/s", "Its time derivative", Causality::derivative}).state =
                first_state + k;
        }
    }

    void initialise() override {
        const rollbem::Contact<Scalar> contact = parameters_.contact();
        first_half_length_ = contact.half_length();
        if (follows_load()) {
            parameters_.line();  // checks nominal_load
            require(parameters_.model() == rollbem::LineModel::plane, "contact_length", length_,
                    "be 1 (fixed) where kernel is strip, which knows one length only");
            require(rollbem::detail::is_finite(load_.value) && load_.value > 0, "normal_load", load_.value,
                    "be positive and finite where contact_length is follows_load");
        }
        build(contact);
        now_ = model_->at_rest();
        if (initial_state_ == in_steady_rolling) {
            require(speed_.value > 0, "rolling_speed", speed_.value, "be positive where initial_state is steady");
            now_ = model_->steady(slip_.value / speed_.value);  // the same unknowns at any half-length
        }
        now_.half_length = half_length_at(load_.value);
        next_ = from_ = now_;
        past_ = {};
        show(now_);
        status_ = initial_state_ == in_steady_rolling ? value_of(StepStatus::ok) : 0;
    }

    Outcome step(Scalar duration) override {
        Past step{.duration = duration,
                  .shift = duration * (slip_.value + slip_.after(duration)) / 2,
                  .distance = duration * (speed_.value + speed_.after(duration)) / 2,
                  .half_length = half_length_at(load_.after(duration))};
        StepStatus status = check(slip_, speed_, load_);
        if (status == StepStatus::ok && speed_.after(duration) < 0) status = StepStatus::invalid_step;
        if (status == StepStatus::ok) status = advance(now_, step, next_);
        status_ = value_of(status);
        if (status != StepStatus::ok) return outcome_of(status);
        std::swap(from_, now_);
        std::swap(now_, next_);
        past_ = step;
        show(now_);
        force_ = step.force;
        return Outcome::ok;
    }

    Outcome update() override {
        StepStatus status = check(slip_, speed_, load_, load_rate_);
        if (status == StepStatus::ok && !rollbem::detail::all_finite(displacement_)) status = StepStatus::not_finite;
        if (status == StepStatus::ok && follows_load() && !(load_.value > 0)) status = StepStatus::invalid_load;
        status_ = value_of(status);
        if (status != StepStatus::ok) return outcome_of(status);
        half_length_ = half_length_at(load_.value);
        const Scalar growth = growth_rate();
        // an edge moves as fast as the material, or the contact is so long that Lambda is not positive
        if (growth != 0 && std::abs(growth) >= speed_.value) status = StepStatus::needs_fixed_mesh;
        if (!(softening() > 0)) status = StepStatus::invalid_load;
        status_ = value_of(status);
        if (status != StepStatus::ok) return outcome_of(status);
        slope_.noalias() = A_ * unknowns();
        rates_ = speed_.value * slope_;
        if (growth != 0) rates_ += growth * by_position(slope_);
        rates_[0] -= slip_.value;
        force_ = half_length_ * force_weights_.dot(unknowns_);
        return Outcome::ok;
    }

    Scalar partial(const Variable& unknown, const Variable& known) override {
        if (used() == Interface::model_exchange) {
            if (const std::optional<Scalar> value = partial_now(unknown, known)) return *value;
        } else if (&unknown.real() == &force_ && known.causality == Causality::input) {
            if (past_.duration == 0 && initial_state_ == in_steady_rolling) {
                throw NoDerivative(unknown, known, " before the first step");
            }
            return partial_of_step(known);
        }
        throw NoDerivative(unknown, known, "");
    }

    void archive(Archive& archive) override {
        for (Transient::State* state : {&now_, &from_}) {
            archive.keep(state->traction);
            archive.keep(state->half_length);
            archive.keep(state->distance);
        }
        archive.keep(past_);
    }

private:
    using Transient = rollbem::AdhesionModel<>;

    // A step of co-simulation.
    struct Past {
        Scalar duration = 0;                // [s]
        Scalar shift = 0;                   // [m]
        Scalar distance = 0;                // rolled [m]
        Scalar half_length = 0;             // at the end [m]
        Scalar force = 0;                   // [N]
        Scalar tangent_by_shift = 0;        // d force / d shift [N/m]
        Scalar tangent_by_half_length = 0;  // [N/m]
    };

    static std::string state_name(Eigen::Index k) { return "displacement[" + std::to_string(k) + "]"; }

    void build(const rollbem::Contact<Scalar>& contact) {
        using Kernel = rollbem::AnyKernel<Scalar>;
        const bool longitudinal = direction_ == in_rolling_direction;
        const auto kernel_of = longitudinal ? Kernel::longitudinal : Kernel::lateral;
        const auto system =
            rolling_system(rollbem::Chebyshev{.states = state_count}, kernel_of(parameters_.model(), contact));
        model_.emplace(contact, system, judge_stability(system),
                       follows_load() ? rollbem::Integrator::sdirk2 : rollbem::Integrator::matrix_exponential);
        A_ = system.rates();
        weights_ = system.weights();
        force_weights_ = 2 * contact.half_width() * contact.shear_modulus() * weights_;
        strength_ = system.log_strength().value_or(0);
        unit_traction_ = contact.shear_modulus();
    }

    bool follows_load() const { return length_ == length_of_load; }

    // Hertz's law.
    Scalar half_length_at(Scalar load) const {
        return follows_load() ? first_half_length_ * std::sqrt(load / parameters_.nominal_load) : first_half_length_;
    }

    template <class... Inputs>
    StepStatus check(const Inputs&... inputs) const {
        using rollbem::detail::is_finite;
        if (!((is_finite(inputs.value) && is_finite(inputs.rate)) && ...)) return StepStatus::not_finite;
        return speed_.value < 0 ? StepStatus::invalid_step : StepStatus::ok;
    }

    // The slip is taken as constant along a step: an error of second order in its duration if it varies.
    StepStatus advance(const Transient::State& from, Past& step, Transient::State& to) {
        if (!rollbem::detail::is_finite(step.distance)) return StepStatus::not_finite;
        const auto motion = rollbem::RigidMotion<Scalar>::shift(step.shift);
        if (follows_load()) {
            const auto result = model_->advance(from, {step.distance, motion, step.half_length}, to, workspace_);
            step.tangent_by_half_length = result.tangent_by_half_length;
            return take(result, step);
        }
        return take(model_->advance(from, {step.distance, motion}, to, workspace_), step);
    }

    static StepStatus take(const Transient::Step& result, Past& step) {
        step.force = result.force;
        step.tangent_by_shift = result.tangent;
        return result.status;
    }

    // 1 - S ln(a/a_0) w_0, so that U_0 = a (this) y_0: where a may change, only the first weight is not zero.
    Scalar softening() const {
        if (half_length_ == first_half_length_) return 1;
        return 1 - strength_ * std::log(half_length_ / first_half_length_) * weights_[0];
    }

    // y from U.
    const Vector& unknowns() {
        unknowns_ = displacement_ / half_length_;
        unknowns_[0] /= softening();
        return unknowns_;
    }

    void show(const Transient::State& state) {
        half_length_ = state.half_length;
        displacement_ = half_length_ / unit_traction_ * state.traction;
        displacement_[0] *= softening();
        force_ = model_->force(state);
    }

    // Z v: the coefficients of x/a times a polynomial, without the highest.
    static Vector by_position(const Vector& v) {
        Vector result = Vector::Zero(v.size());
        for (Eigen::Index k = 0; k < v.size(); ++k) {
            if (k + 1 < v.size()) result[k + 1] += k == 0 ? v[k] : v[k] / 2;
            if (k > 0) result[k - 1] += v[k] / 2;
        }
        return result;
    }

    // da/dN [m/N] and da/dt [m/s].
    Scalar half_length_by_load(Scalar load) const { return half_length_at(load) / (2 * load); }
    Scalar growth_rate() const {
        return follows_load() ? half_length_by_load(load_.value) * load_rate_.value : Scalar(0);
    }

    Eigen::Index coefficient(const Variable& variable) const {
        const Scalar* first = variable.causality == Causality::state ? displacement_.data() : rates_.data();
        return &variable.real() - first;
    }

    // In model exchange, at the present states and inputs; none for variables that are neither.
    std::optional<Scalar> partial_now(const Variable& unknown, const Variable& known) {
        const bool of_force = &unknown.real() == &force_, of_length = &unknown.real() == &half_length_;
        if (!of_force && !of_length && unknown.causality != Causality::derivative) return std::nullopt;
        if (known.causality != Causality::input && known.causality != Causality::state) return std::nullopt;
        if (update() != Outcome::ok) throw NoDerivative(unknown, known, " at these states and inputs");
        const Scalar growth = growth_rate();
        const bool by_load = follows_load() && &known.real() == &load_.value;
        const Scalar by_half_length = by_load ? half_length_by_load(load_.value) : Scalar(0);  // of a
        if (of_length) return by_half_length;

        // dy by the known
        Vector change = Vector::Zero(state_count);
        if (known.causality == Causality::state) {
            const Eigen::Index k = coefficient(known);
            change[k] = 1 / (half_length_ * (k == 0 ? softening() : Scalar(1)));
        } else if (by_load) {
            change = -by_half_length / half_length_ * unknowns_;
            change[0] += by_half_length / half_length_ * strength_ * weights_[0] / softening() * unknowns_[0];
        }
        if (of_force) return half_length_ * force_weights_.dot(change) + by_half_length * force_weights_.dot(unknowns_);
        Vector rates = A_ * change;
        rates = (speed_.value * rates + growth * by_position(rates)).eval();
        if (&known.real() == &slip_.value) rates[0] -= 1;
        if (&known.real() == &speed_.value) rates += slope_;
        if (by_load) rates -= growth / (2 * load_.value) * by_position(slope_);
        if (follows_load() && &known.real() == &load_rate_.value) {
            rates += half_length_by_load(load_.value) * by_position(slope_);
        }
        return rates[coefficient(unknown)];
    }

    // Exact by slip velocity and load, by differences of the step by the rolling speed.
    Scalar partial_of_step(const Variable& known) {
        if (past_.duration == 0 || &known.real() == &load_rate_.value) return 0;
        if (&known.real() == &slip_.value) return past_.tangent_by_shift * past_.duration;
        if (&known.real() == &load_.value) {
            if (!follows_load()) return 0;
            const Scalar ratio = past_.half_length / first_half_length_;
            return past_.tangent_by_half_length * past_.half_length / (2 * ratio * ratio * parameters_.nominal_load);
        }
        return past_.duration * rollbem::tangent_by_distance(past_.distance, half_length_, [&](Scalar distance) {
                   Past step = past_;
                   step.distance = distance;
                   advance(from_, step, next_);
                   return step.force;
               });
    }

    ContactParameters parameters_;
    int direction_ = in_rolling_direction;
    int initial_state_ = at_rest;
    int length_ = fixed_length;
    Input slip_{0}, speed_{20}, load_{1e5}, load_rate_{0};
    Scalar force_ = 0, half_length_ = 0;
    int status_ = 0;
    Vector displacement_, rates_;
    Vector unknowns_, slope_;  // y and A y, the slope's coefficients, at the last update()

    std::optional<Transient> model_;
    Scalar first_half_length_ = 0;    // that the system was made for [m]
    rollbem::MatrixX<Scalar> A_;      // d u / d(q/a)
    Vector weights_, force_weights_;  // w [-] and 2b G w [N/m]
    Scalar strength_ = 0;             // S, if a may change [-]
    Scalar unit_traction_ = 0;        // G [Pa]

    Transient::State now_, from_, next_;  // from_: where the last step began
    Past past_;
    Transient::Workspace workspace_{state_count};
};

}  // namespace

const Identity identity{.identifier = "rollbem_adhesion",
                        .description =
                            "Non-steady tangential rolling contact in full adhesion, exact but for "
                            "fronts shorter than a few per cent of the contact's length",
                        .model_exchange = true,
                        .stop_time = 0.01,
                        .step_size = 2.5e-5};

std::unique_ptr<Model> make_model(Interface used) { return std::make_unique<Adhesion>(used); }

}  // namespace fmu
