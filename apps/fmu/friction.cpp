// rollbem_friction: a contact with Coulomb friction in both directions under a load that varies, on elements.
//
// Co-simulation alone: stick and slip change element by element. A step of duration h rolls by V h and shifts the wheel
// by s h, both at a constant rate, so that V = 0 is a rigid shift; the load varies linearly over the step.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/detail/require.hpp>
#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/friction/transient.hpp>
#include <rollbem/normal/hertz_load.hpp>

#include "contact_variables.hpp"
#include "model.hpp"

namespace fmu {

namespace {

using Scalar = double;
using rollbem::StepStatus;

enum class MeshName { cosine = 1, uniform };
enum class MeshLength { follows_load = 1, fixed };

const Enumeration meshes{"Mesh",
                         {{"cosine", "second order where the mesh follows the load"}, {"uniform", "for a fixed mesh"}}};

const Enumeration mesh_lengths{
    "MeshLength",
    {{"follows_load", "that of the contact; plane kernel, normal_load > 0, changes of a below the distance rolled"},
     {"fixed", "that of the contact under largest_load; the wheel may lift off"}}};

class Friction final : public Model {
public:
    explicit Friction(Interface used) : Model(used) {
        for (Variable& variable : parameters_.variables()) add(std::move(variable));
        add({.name = "friction_coefficient", .value = &friction_coefficient_, .description = "mu"});
        add({.name = "elements", .value = &elements_, .description = "Number of elements, 1 to 1000"});
        add({.name = "mesh", .value = &mesh_, .description = "Spacing of the elements", .items = &meshes});
        add({.name = "mesh_length",
             .value = &mesh_length_,
             .description = "What the mesh covers",
             .items = &mesh_lengths});
        add({.name = "largest_load",
             .value = &largest_load_,
             .unit = "N",
             .description = "The largest normal_load that a fixed mesh can take"});
        add({.name = "initial_state",
             .value = &initial_state_,
             .description = "State at the start",
             .items = &initial_states});
        add_input(
            slip_[0], "longitudinal_slip_velocity", "m/s",
            "Velocity of the wheel relative to the rail along the rolling direction, as rigid bodies; creepage times "
            "rolling_speed");
        add_input(slip_[1], "lateral_slip_velocity", "m/s", "The same across the rolling direction");
        add_input(speed_, "rolling_speed", "m/s", "V, the speed of the contact along the rail; not negative");
        add_input(load_, "normal_load", "N", "N over the width 2b at the end of a step; not negative");
        add_output(&force_[0], "longitudinal_force", "N",
                   "Force on the wheel, over the width 2b; opposes the slip velocity in steady rolling");
        add_output(&force_[1], "lateral_force", "N", "The same across the rolling direction");
        add_output(&slip_work_, "slip_work", "J", "Heat by slip since the start");
        add_output(&half_length_, "contact_half_length", "m", "a under normal_load");
        add_output(&sticking_elements_, "sticking_elements", "", "Number of elements that stick");
        add_output(&status_, "status", "", "Status of the last step", &step_statuses);
    }

    void initialise() override {
        const rollbem::HertzLine<Scalar> line = parameters_.line();
        require(elements_ >= 1 && elements_ <= 1000, "elements", elements_, "lie in [1, 1000]");
        const bool fixed = mesh_length_ == static_cast<int>(MeshLength::fixed);
        const bool plane = parameters_.kernel == static_cast<int>(KernelName::plane);
        require(fixed || plane, "mesh_length", mesh_length_,
                "be 2 (fixed) where kernel is strip, which knows one length only");
        require(load_.value >= 0 && (fixed || load_.value > 0), "normal_load", load_.value,
                fixed ? "not be negative" : "be positive where mesh_length is follows_load");

        Scalar length = line.half_length();
        if (fixed) {
            require(rollbem::detail::is_finite(largest_load_) && largest_load_ > 0, "largest_load", largest_load_,
                    "be positive and finite");
            require(load_.value <= largest_load_, "normal_load", load_.value, "be at most largest_load");
            length *= std::sqrt(per_width(largest_load_) / line.load_per_width());
        }
        const bool cosine = mesh_ == static_cast<int>(MeshName::cosine);
        const rollbem::Mesh<Scalar> mesh =
            cosine ? rollbem::cosine_mesh<Scalar>(elements_) : rollbem::uniform_mesh<Scalar>(elements_);
        const rollbem::NodeDifference scheme{cosine ? rollbem::Nodes::chebyshev : rollbem::Nodes::centres};
        hertz_ = fixed ? rollbem::HertzLoad<Scalar>::fixed(line, mesh, length)
                       : rollbem::HertzLoad<Scalar>::breathing(line, mesh);
        end_load_ = hertz_->at(fixed ? per_width(largest_load_) : line.load_per_width());
        const rollbem::Contact<Scalar> contact = parameters_.contact_of(length);
        plane ? build<rollbem::PlaneKernel<Scalar>>(contact, mesh, scheme)
              : build<rollbem::StripKernel<Scalar>>(contact, mesh, scheme);

        end_load_ = hertz_->at(per_width(load_.value));
        now_ = model_->at_rest();
        now_.normal_pressure = end_load_.normal_pressure.head(model_->size());
        now_.half_length = end_load_.half_length;
        from_ = next_ = now_;
        last_ = {};
        last_.force = {0, 0};
        last_.stick_count = model_->size();
        if (initial_state_ == static_cast<int>(InitialState::steady)) roll_steadily();
        past_ = {};
        slip_work_ = 0;
        show();
    }

    Outcome step(Scalar duration) override {
        const Past step{.duration = duration,
                        .shift = {integral(slip_[0], duration), integral(slip_[1], duration)},
                        .distance = integral(speed_, duration),
                        .load = load_.after(duration)};
        StepStatus status = StepStatus::ok;
        for (const Input* input : {&slip_[0], &slip_[1], &speed_, &load_}) {
            const Scalar end = input->after(duration);
            if (!rollbem::detail::is_finite(input->value) || !rollbem::detail::is_finite(end)) {
                status = StepStatus::not_finite;
            } else if (status == StepStatus::ok && input == &speed_ && (input->value < 0 || end < 0)) {
                status = StepStatus::invalid_step;
            }
        }
        Step result;
        if (status == StepStatus::ok) {
            result = advance(now_, step, next_);
            status = result.status;
        }
        status_ = value_of(status);
        if (status != StepStatus::ok) return outcome_of(status);
        std::swap(from_, now_);
        std::swap(now_, next_);
        past_ = step;
        last_ = result;
        slip_work_ += 2 * parameters_.half_width * result.slip_work_per_width;
        show();
        return Outcome::ok;
    }

    Scalar partial(const Variable& unknown, const Variable& known) override {
        const bool longitudinal = &unknown.real() == &force_[0];
        if ((!longitudinal && &unknown.real() != &force_[1]) || known.causality != Causality::input) {
            throw std::invalid_argument("there is no derivative of " + unknown.name + " by " + known.name +
                                        ": the forces have some by the inputs");
        }
        if (past_.duration == 0) return 0;
        const auto component = [longitudinal](const rollbem::TangentialForce<Scalar>& force) {
            return longitudinal ? force.longitudinal : force.lateral;
        };
        Scalar value = 0;
        if (&known.real() == &slip_[0].value) {
            value = component(last_.tangent.by_longitudinal) * past_.duration;
        } else if (&known.real() == &slip_[1].value) {
            value = component(last_.tangent.by_lateral) * past_.duration;
        } else if (&known.real() == &load_.value) {
            value = component(last_.tangent_by_load);
            if (hertz_->breathes()) {
                value += component(last_.tangent_by_half_length) * hertz_->half_length_rate(per_width(past_.load));
            }
            value /= 2 * parameters_.half_width;
        } else {
            value = partial_by_speed(component);
        }
        if (!rollbem::detail::is_finite(value)) {
            throw std::invalid_argument("the derivative of " + unknown.name + " by " + known.name + " does not exist");
        }
        return value;
    }

    void archive(Archive& archive) override {
        for (State* state : {&now_, &from_}) {
            archive.keep(state->traction);
            archive.keep(state->zones);
            archive.keep(state->normal_pressure);
            archive.keep(state->half_length);
        }
        archive.keep(past_);
        archive.keep(last_);
    }

private:
    using FrictionModel = rollbem::FrictionModel<rollbem::ConstantFriction<Scalar>, 2, Scalar>;
    using State = FrictionModel::State;
    using Step = FrictionModel::Step;

    // A step.
    struct Past {
        Scalar duration = 0;                // [s]
        rollbem::Creepage<Scalar> shift{};  // [m]
        Scalar distance = 0;                // rolled [m]
        Scalar load = 0;                    // at the end [N]
    };

    template <class Value>
    static void require(bool holds, const char* parameter, Value value, const char* rule) {
        rollbem::detail::require(holds, "rollbem_friction", parameter, value, rule);
    }

    template <class Kernel>
    void build(const rollbem::Contact<Scalar>& contact, const rollbem::Mesh<Scalar>& mesh,
               const rollbem::NodeDifference& scheme) {
        const rollbem::ElementSystem system(rolling_system(mesh, scheme, Kernel::longitudinal(contact)),
                                            rolling_system(mesh, scheme, Kernel::lateral(contact)));
        model_.emplace(contact, system, judge_stability(system),
                       rollbem::Friction{friction_coefficient_, end_load_.normal_pressure});
        workspace_.emplace(model_->workspace());
    }

    void roll_steadily() {
        require(speed_.value > 0, "rolling_speed", speed_.value, "be positive where initial_state is steady");
        const rollbem::Creepage<Scalar> creepage{slip_[0].value / speed_.value, slip_[1].value / speed_.value};
        const rollbem::FrictionStep<2, Scalar> steady = model_->steady(now_, creepage, end_load_, next_, *workspace_);
        require(steady.status == StepStatus::ok, "status of steady rolling at the first inputs", name(steady.status),
                "be ok");
        std::swap(now_, next_);
        last_.force = steady.force;
        last_.stick_count = steady.stick_count;
    }

    Step advance(const State& from, const Past& step, State& to) {
        Step failed;
        failed.status = hertz_->set(per_width(step.load), end_load_);
        if (failed.status != StepStatus::ok) return failed;
        return model_->advance(from, step.distance, FrictionModel::Motion::shift(step.shift), end_load_, to,
                               *workspace_);
    }

    // The library has no tangent by the distance rolled: central differences of the step, or one-sided ones of the same
    // order near zero.
    template <class Component>
    Scalar partial_by_speed(const Component& component) {
        const auto force_at = [&](Scalar distance) {
            Past step = past_;
            step.distance = distance;
            return component(advance(from_, step, next_).force);
        };
        const Scalar distance = past_.distance, change = 1e-5 * std::max(distance, half_length_);
        if (distance >= change) {
            return (force_at(distance + change) - force_at(distance - change)) / (2 * change) * past_.duration;
        }
        return (4 * force_at(distance + change) - 3 * force_at(distance) - force_at(distance + 2 * change)) /
               (2 * change) * past_.duration;
    }

    void show() {
        force_[0] = last_.force.longitudinal;
        force_[1] = last_.force.lateral;
        half_length_ = hertz_->half_length(per_width(past_.duration > 0 ? past_.load : load_.value));
        sticking_elements_ = static_cast<int>(last_.stick_count);
        status_ = value_of(StepStatus::ok);
    }

    static Scalar integral(const Input& input, Scalar duration) {
        return duration * (input.value + input.after(duration)) / 2;
    }

    Scalar per_width(Scalar load) const { return load / (2 * parameters_.half_width); }

    ContactParameters parameters_;
    Scalar friction_coefficient_ = 0.3;
    int elements_ = 40;
    int mesh_ = static_cast<int>(MeshName::cosine);
    int mesh_length_ = static_cast<int>(MeshLength::follows_load);
    Scalar largest_load_ = 2e5;
    int initial_state_ = static_cast<int>(InitialState::rest);
    Input slip_[2] = {{0}, {0}}, speed_{20}, load_{1e5};
    Scalar force_[2] = {0, 0};
    Scalar slip_work_ = 0, half_length_ = 0;
    int sticking_elements_ = 0;
    int status_ = value_of(StepStatus::ok);

    std::optional<rollbem::HertzLoad<Scalar>> hertz_;
    rollbem::NormalLoad<Scalar> end_load_;  // of the present step
    std::optional<FrictionModel> model_;
    std::optional<rollbem::FrictionWorkspace<2, Scalar>> workspace_;
    State now_, from_, next_;  // from_: where the last step began
    Past past_;
    Step last_;
};

}  // namespace

const Identity identity{.identifier = "rollbem_friction",
                        .description =
                            "Tangential rolling contact with Coulomb friction in both directions under a "
                            "normal load that varies",
                        .model_exchange = false,
                        .stop_time = 0.01,
                        .step_size = 2.5e-5};

std::unique_ptr<Model> make_model(Interface used) { return std::make_unique<Friction>(used); }

}  // namespace fmu
