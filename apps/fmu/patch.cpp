// rollbem_patch: an elliptic contact patch of wheel and rail with Coulomb friction and spin, under a load that varies.
//
// Forces come from the patch in the time domain, or from a table of steady forces. A step of duration h rolls by V h
// and shifts the wheel by s h, both at a constant rate, so that V = 0 is a rigid shift; the load varies linearly over
// the step.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <rollbem/accuracy/distance_tangent.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/patch_shapes.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/detail/require.hpp>
#include <rollbem/discretisation/patch_mesh.hpp>
#include <rollbem/elasticity/rectangle_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz_ellipse.hpp>
#include <rollbem/normal/hertz_patch_load.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>

#include "model.hpp"
#include "shared_table.hpp"

namespace fmu {

namespace {

using Scalar = double;

enum MeshSize { mesh_follows_load = 1, fixed_mesh };
enum InitialState { at_rest = 1, in_steady_rolling };
enum Mode { by_elements = 1, by_table };

const Enumeration modes{"Mode",
                        {{"patch", "in time, element by element"}, {"table", "quasi-steady, by look-up in a table"}}};

const Enumeration mesh_sizes{
    "MeshSize",
    {{"follows_load", "the present contact; normal_load > 0, changes of a below the distance rolled"},
     {"fixed", "the contact under largest_load; the wheel may lift off"}}};

const Enumeration initial_states{"InitialState",
                                 {{"rest", "no traction"}, {"steady", "steady rolling at the first inputs"}}};

class Patch final : public Model {
public:
    Patch() {
        add_parameter(&shear_modulus_, "shear_modulus", "Pa", "Shear modulus G of both bodies");
        add_parameter(&poisson_ratio_, "poisson_ratio", "", "Poisson's ratio nu of both bodies").lies_in(0, 0.5);
        add_radius(wheel_.rolling, "wheel_rolling_radius", "Radius of the wheel, in the plane of rolling");
        add_radius(wheel_.lateral, "wheel_lateral_radius", "Radius of the wheel's profile at the contact");
        add_radius(rail_.rolling, "rail_rolling_radius", "Radius of the rail in the plane of rolling");
        add_radius(rail_.lateral, "rail_lateral_radius", "Radius of the rail's profile at the contact");
        add_parameter(&friction_coefficient_, "friction_coefficient", "", "Coefficient of friction mu").min = 0;
        add_parameter(&mode_, "mode", "", "Source of the forces", &modes);
        add_parameter(&table_file_, "table_file", "",
                      "Path of a table (.bin) made by creep_table; used where mode is table; empty: the table "
                      "packed with this FMU, for nu = 0.28 and a/b from 0.1 to 10");
        add_parameter(
            &elements_, "elements", "",
            "Number of elements in each strip, 1 to 32; this and the parameters below apply where mode is patch")
            .lies_in(1, 32);
        add_parameter(&strips_, "strips", "", "Number of strips along the rolling direction, 1 to 32").lies_in(1, 32);
        add_parameter(&mesh_size_, "mesh_size", "", "Area that the mesh covers", &mesh_sizes);
        add_parameter(&largest_load_, "largest_load", "N", "The largest normal_load that a fixed mesh can take");
        add_parameter(&initial_state_, "initial_state", "", "State at the start", &initial_states);
        add_input(slip_[0], "longitudinal_slip_velocity", "m/s",
                  "Rigid velocity of the wheel relative to the rail in the middle of the contact, along the rolling "
                  "direction; creepage times rolling_speed");
        add_input(slip_[1], "lateral_slip_velocity", "m/s", "Rigid velocity across the rolling direction, along y");
        add_input(spin_, "spin_rate", "rad/s",
                  "Angular velocity of the wheel relative to the rail about the normal, from x to y; spin times "
                  "rolling_speed");
        add_input(speed_, "rolling_speed", "m/s", "Speed V of the contact along the rail; not negative").min = 0;
        add_input(load_, "normal_load", "N", "Load N at the end of a step; not negative").min = 0;
        add_input(factor_, "friction_factor", "", "Ratio of mu to friction_coefficient at the end of a step").min = 0;
        add_input(axes_[0], "given_half_length", "m",
                  "Semi-axis a at the end of a step, where mode is table; 0 with given_half_width = 0: a follows from "
                  "normal_load and the radii")
            .min = 0;
        add_input(axes_[1], "given_half_width", "m", "Semi-axis b likewise").min = 0;
        add_output(&force_.longitudinal, "longitudinal_force", "N",
                   "Force on the wheel; opposes the slip velocity in steady rolling without spin");
        add_output(&force_.lateral, "lateral_force", "N", "Force on the wheel across the rolling direction");
        add_output(&force_.moment, "spin_moment", "N.m",
                   "Moment on the wheel about the normal through the middle of the contact");
        add_output(&slip_work_, "slip_work", "J", "Heat by slip since the start");
        add_output(&half_length_, "contact_half_length", "m",
                   "Semi-axis a along x: given, or by Hertz under normal_load")
            .min = 0;
        add_output(&half_width_, "contact_half_width", "m", "Semi-axis b along y likewise").min = 0;
        add_output(&sticking_elements_, "sticking_elements", "", "Number of elements that stick; 0 by table").min = 0;
        auto& off_table =
            add_output(&off_table_, "off_table", "",
                       "1 where a/b of the last step lies beyond the table: the table's nearest ellipse of "
                       "the same area gives the forces, with an unknown error; else 0");
        off_table.lies_in(0, 1);
        add_output(&status_, "status", "", "Status of the last step", &step_statuses);
    }

    void initialise() override {
        for (const auto& [name, value] :
             {std::pair("shear_modulus", shear_modulus_), std::pair("largest_load", largest_load_)}) {
            require(rollbem::detail::is_finite(value) && value > 0, name, value, "be positive and finite");
        }
        for (const auto& [name, radius] :
             {std::pair("wheel_rolling_radius", wheel_.rolling), std::pair("wheel_lateral_radius", wheel_.lateral),
              std::pair("rail_rolling_radius", rail_.rolling), std::pair("rail_lateral_radius", rail_.lateral)}) {
            require(!rollbem::detail::is_nan(radius) && radius != 0, name, radius, "be a number other than 0");
        }
        const rollbem::ElasticBody<Scalar> body{.young_modulus = 2 * shear_modulus_ * (1 + poisson_ratio_),
                                                .poisson_ratio = poisson_ratio_};
        // largest_load rather than normal_load: a state can be restored in a contact built under another load
        ellipse_.emplace(rollbem::HertzEllipse<Scalar>::Parameters{
            .load = largest_load_, .radii_1 = wheel_, .radii_2 = rail_, .body_1 = body, .body_2 = body});
        if (mode_ == by_table) {
            begin_by_table();
        } else {
            begin_patch();
        }
    }

    Outcome step(double duration) override {
        Past step = motion(duration);
        Status status = check(duration);
        Step result;
        if (status == Status::ok) {
            result = table_ ? take_by_table(step) : take_by_elements(step);
            status = result.status;
        }
        status_ = value_of(status);
        if (status != Status::ok) return outcome_of(status);
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

private:
    using Status = rollbem::Status;
    using Force = rollbem::TangentialForce<Scalar>;
    using Hertz = rollbem::HertzPatchLoad<Scalar>;
    using FrictionModel = rollbem::FrictionModel<rollbem::ConstantFriction<Scalar>, 2, Scalar>;
    using Step = FrictionModel::Step;
    using State = FrictionModel::State;

    // A step.
    struct Past {
        Scalar duration = 0;                // [s]
        rollbem::Creepage<Scalar> shift{};  // [m], spin as an angle
        Scalar distance = 0;                // rolled [m]
        Scalar load = 0;                    // at the end [N]
        Scalar factor = 1;                  // of mu, at the end
        Scalar semi_axes[2] = {0, 0};       // at the end [m]; 0: by Hertz under the load
    };

    void add_radius(Scalar& radius, const char* name, std::string description) {
        add_parameter(&radius, name, "m", std::move(description) + "; negative if concave, 1e9 if flat");
    }

    void begin_patch() {
        table_.reset();
        off_table_ = 0;
        for (const auto& [name, count] : {std::pair("elements", elements_), std::pair("strips", strips_)}) {
            require(count >= 1 && count <= 32, name, count, "lie in [1, 32]");
        }
        const bool fixed = mesh_size_ == fixed_mesh;
        require(load_.value >= 0 && (fixed || load_.value > 0), "normal_load", load_.value,
                fixed ? "not be negative" : "be positive where mesh_size is follows_load");
        require(!fixed || load_.value <= largest_load_, "normal_load", load_.value, "be at most largest_load");
        for (const auto& [name, axis] :
             {std::pair("given_half_length", axes_[0].value), std::pair("given_half_width", axes_[1].value)}) {
            require(axis == 0, name, axis, "be 0 where mode is patch");
        }
        const rollbem::PatchContact<Scalar> contact = contact_under(largest_load_);
        const rollbem::PatchMesh<Scalar> mesh = patch_mesh(contact, elements_, strips_);
        const rollbem::NodeDifference scheme{rollbem::Nodes::chebyshev};
        const rollbem::HalfSpace<Scalar> kernel(poisson_ratio_);
        begin(
            fixed ? Hertz::fixed(*ellipse_, contact, mesh) : Hertz::breathing(*ellipse_, contact, mesh),
            FrictionModel(
                contact, fixed ? rolling_system(mesh, scheme, kernel) : breathing_system(contact, mesh, scheme, kernel),
                judge_stability(patch_subsystems(mesh, scheme, kernel)),
                rollbem::Friction{friction_coefficient_, hertz_pressures(contact, mesh, largest_load_)}));
    }

    /// Starts at rest or rolling steadily under the present inputs.
    void begin(Hertz hertz, FrictionModel model) {
        hertz_.emplace(std::move(hertz));
        model_.emplace(std::move(model));
        workspace_.emplace(model_->workspace());
        require(rollbem::detail::is_finite(factor_.value) && factor_.value >= 0, "friction_factor", factor_.value,
                "be finite and not negative");
        end_load_ = hertz_->at(load_.value);
        end_load_.normal_pressure *= factor_.value;
        now_ = model_->at_rest();
        now_.normal_pressure = end_load_.normal_pressure.head(model_->size());
        now_.half_length = end_load_.half_length;
        now_.half_width = end_load_.half_width;
        from_ = next_ = now_;
        last_ = {};
        last_.force = {0, 0, 0};
        last_.stick_count = model_->size();
        if (initial_state_ == in_steady_rolling) roll_steadily();
        past_ = {};
        slip_work_ = 0;
        show();
    }

    /// Starts by table, as after a step.
    void begin(const Past& inputs, const Step& first) {
        hertz_.reset();
        model_.reset();
        now_ = from_ = next_ = {};
        last_ = first;
        past_ = inputs;
        slip_work_ = 0;
        show();
    }

    void begin_by_table() {
        table_ = shared_table<rollbem::CreepForceTable>("table_file",
                                                        table_file_.empty() ? resources + "/steel.creep" : table_file_);
        const rollbem::CreepForceGrid& grid = table_->grid();
        const rollbem::PatchContact<Scalar> contact = contact_under(largest_load_);
        require(rollbem::detail::is_finite(friction_coefficient_) && friction_coefficient_ >= 0, "friction_coefficient",
                friction_coefficient_, "be finite and not negative");
        require_finite_inputs();
        require(speed_.value >= 0, "rolling_speed", speed_.value, "not be negative");
        require(load_.value >= 0, "normal_load", load_.value, "not be negative");
        // the look-up has the same tolerance: a decimal number may lie 0.01 away
        require(std::abs(poisson_ratio_ - grid.poisson_ratio()) <= 0.01 + 1e-12, "poisson_ratio", poisson_ratio_,
                ("be within 0.01 of " + std::to_string(grid.poisson_ratio()) + " of the table").c_str());
        require(contact.a_over_b() >= grid.smallest_a_over_b() && contact.a_over_b() <= grid.largest_a_over_b(),
                "a/b of the contact", contact.a_over_b(),
                ("lie in [" + std::to_string(grid.smallest_a_over_b()) + ", " +
                 std::to_string(grid.largest_a_over_b()) + "] of the table")
                    .c_str());
        const Past inputs = at_once(1);
        bool on_table = true;
        const Step steady = look_up(inputs, on_table);
        require(steady.status == Status::ok, "status of the table at the first inputs", name(steady.status), "be ok");
        begin(inputs, steady);
        off_table_ = 0;
        tell(inputs, on_table);
    }

    // Sets off_table, and warns where a/b leaves the table.
    void tell(const Past& step, bool on_table) {
        if (!on_table && off_table_ == 0) {
            const rollbem::CreepForceGrid& grid = table_->grid();
            warning = "a/b = " + rollbem::detail::to_text(contact_of(step)->a_over_b()) +
                      " of the contact lies beyond the table, " + rollbem::detail::to_text(grid.smallest_a_over_b()) +
                      " to " + rollbem::detail::to_text(grid.largest_a_over_b()) +
                      ": its border gives the forces while off_table is 1";
        }
        off_table_ = on_table ? 0 : 1;
    }

    // A step at the present inputs.
    Past at_once(Scalar duration) const {
        return {.duration = duration,
                .shift = {duration * slip_[0].value, duration * slip_[1].value, duration * spin_.value},
                .distance = duration * speed_.value,
                .load = load_.value,
                .factor = factor_.value,
                .semi_axes = {axes_[0].value, axes_[1].value}};
    }

    /// Status of the inputs over the next step.
    Status check(Scalar duration) const {
        Status status = Status::ok;
        for (const Input* input : {&slip_[0], &slip_[1], &spin_, &speed_, &load_, &factor_, &axes_[0], &axes_[1]}) {
            const Scalar end = input->after(duration);
            if (!rollbem::detail::is_finite(input->value) || !rollbem::detail::is_finite(end)) {
                return Status::not_finite;
            }
            if (input == &speed_ && (input->value < 0 || end < 0)) status = Status::invalid_step;
            if (input == &factor_ && end < 0) status = Status::invalid_load;
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

    Step take_by_elements(const Past& step) {
        if (!is_given(step.semi_axes[0]) && !is_given(step.semi_axes[1])) return advance(now_, step, next_);
        Step refused;
        refused.status = Status::invalid_load;
        return refused;
    }

    // A step by table: forces at the velocities of its end, work as the mean over the velocities of both ends.
    Step take_by_table(Past& step) {
        const Past start = at_once(step.duration);
        const auto end_of = [](Scalar mean, Scalar first) { return 2 * mean - first; };
        step.shift = {end_of(step.shift.longitudinal, start.shift.longitudinal),
                      end_of(step.shift.lateral, start.shift.lateral), end_of(step.shift.spin, start.shift.spin)};
        step.distance = std::max(end_of(step.distance, start.distance), Scalar(0));
        bool on_table = true, unused = true;
        Step result = look_up(step, on_table);
        if (result.status != Status::ok) return result;
        tell(step, on_table);
        const bool constant = start.shift == step.shift && start.distance == step.distance && start.load == step.load &&
                              start.factor == step.factor && start.semi_axes[0] == step.semi_axes[0] &&
                              start.semi_axes[1] == step.semi_axes[1];
        if (!constant) result.slip_work = (result.slip_work + look_up(start, unused).slip_work) / 2;
        return result;
    }

    static bool is_given(Scalar semi_axis) { return !(semi_axis == 0); }

    // The ellipse of a step, if it has one.
    std::optional<rollbem::PatchContact<Scalar>> contact_of(const Past& step) const {
        const auto [a, b] = step.semi_axes;
        if (!is_given(a) && !is_given(b)) return contact_under(lifted(step.load) ? 0 : step.load);
        if (!(a > 0 && b > 0)) return std::nullopt;
        return rollbem::PatchContact<Scalar>({a, b, shear_modulus_, poisson_ratio_});
    }
    // Forces by table at constant velocities.
    rollbem::TabulatedForce find(const Past& step) const {
        const Scalar distance = std::max(step.distance, least_speed * step.duration);
        const auto& [along, across, turn] = step.shift;
        const auto contact = contact_of(step);
        rollbem::TabulatedForce refused;
        refused.status = Status::invalid_load;
        if (!contact) return refused;
        return table_->look_up(*contact, friction_coefficient_ * step.factor, lifted(step.load) ? 0 : step.load,
                               {along / distance, across / distance, turn / distance});
    }
    Step look_up(const Past& step, bool& on_table) const {
        const rollbem::TabulatedForce found = find(step);
        on_table = found.a_over_b_on_table;
        const Scalar distance = std::max(step.distance, least_speed * step.duration);
        const auto& [along, across, turn] = step.shift;
        Step result;
        result.status = found.status;
        if (result.status != Status::ok) return result;
        result.force = found.force;
        result.tangent = (1 / distance) * found.tangent;
        result.tangent_by_load = found.tangent_by_load;
        if (!is_given(step.semi_axes[0])) {
            if (step.load > 0 && !lifted(step.load)) {
                // both semi-axes grow like N^(1/3)
                const auto contact = contact_under(step.load);
                result.tangent_by_load =
                    result.tangent_by_load + 1 / (3 * step.load) *
                                                 (contact.half_length() * found.tangent_by_half_length +
                                                  contact.half_width() * found.tangent_by_half_width);
            } else {
                result.tangent_by_load =
                    first_force(step.factor * friction_coefficient_, along, across, turn / distance);
            }
        }
        result.slip_work =
            -(along * found.force.longitudinal + across * found.force.lateral + turn * found.force.moment);
        return result;
    }

    // Derivative of the forces by the load at N = 0: N f(xi/N^(1/3), eta/N^(1/3), phi) slides everywhere, but under
    // spin alone f is the same at any load; the moment has another N^(1/3).
    Force first_force(Scalar mu, Scalar along, Scalar across, Scalar spin) const {
        const Scalar slip = std::hypot(along, across);
        if (slip > 0) return {-mu * (along / slip), -mu * (across / slip), 0};
        const Scalar load = ellipse_->load();
        const Force any = table_->look_up(contact_under(load), mu, load, {0, 0, spin}).force;
        return {any.longitudinal / load, any.lateral / load, 0};
    }

    void roll_steadily() {
        require_finite_inputs();
        const Step steady = model_->steady(now_, {.motion = first_creepage(), .load = end_load_}, next_, *workspace_);
        require(steady.status == Status::ok, "status of steady rolling at the first inputs", name(steady.status),
                "be ok");
        std::swap(now_, next_);
        last_.force = steady.force;
        last_.stick_count = steady.stick_count;
    }

    // A step by elements; with `by_factor` tangent_by_load is the derivative by the factor of mu.
    Step advance(const State& from, const Past& step, State& to, bool by_factor = false) {
        Step failed;
        failed.status = hertz_->set(step.load, end_load_);
        // forces of a contact too small for its mesh are rough, and as small as its load
        if (failed.status != Status::ok && failed.status != Status::unresolved) return failed;
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
        status_ = computed ? value_of(Status::ok) : 0;
    }

    // Derivative of the forces at the end of the last step by an input during it.
    Force partial_by(const Scalar& input) {
        if (&input == &slip_[0].value) return past_.duration * last_.tangent.by_longitudinal;
        if (&input == &slip_[1].value) return past_.duration * last_.tangent.by_lateral;
        if (&input == &spin_.value) return past_.duration * last_.tangent.by_spin;
        // a step that changes only one semi-axis from 0, or any semi-axis of a patch, is refused
        const bool of_axis = &input == &axes_[0].value || &input == &axes_[1].value;
        if (of_axis && !(table_ && is_given(past_.semi_axes[0]))) {
            constexpr Scalar none = std::numeric_limits<Scalar>::quiet_NaN();
            return {none, none, none};
        }
        return table_ ? partial_of_table_by(input) : partial_of_elements_by(input);
    }

    Force partial_of_elements_by(const Scalar& input) {
        if (&input == &load_.value) {
            if (!hertz_->breathes()) return last_.tangent_by_load;
            return last_.tangent_by_load + hertz_->half_length_rate(past_.load) * last_.tangent_by_half_length;
        }
        if (&input == &factor_.value) return advance(from_, past_, next_, true).tangent_by_load;
        return past_.duration * rollbem::tangent_by_distance(past_.distance, now_.half_length, [&](Scalar distance) {
                   Past step = past_;
                   step.distance = distance;
                   return advance(from_, step, next_).force;
               });
    }

    Force partial_of_table_by(const Scalar& input) const {
        if (&input == &load_.value) return last_.tangent_by_load;
        if (&input == &factor_.value) return friction_coefficient_ * find(past_).tangent_by_friction_coefficient;
        if (&input == &axes_[0].value) return find(past_).tangent_by_half_length;
        if (&input == &axes_[1].value) return find(past_).tangent_by_half_width;
        if (past_.distance <= least_speed * past_.duration) return {0, 0, 0};
        const auto& [by_longitudinal, by_lateral, by_spin] = last_.tangent;
        return -past_.duration / past_.distance *
               (past_.shift.longitudinal * by_longitudinal + past_.shift.lateral * by_lateral +
                past_.shift.spin * by_spin);
    }

    void show_size(Scalar load) {
        const Scalar scale = std::cbrt(load / ellipse_->load());
        half_length_ = scale * ellipse_->half_length();
        half_width_ = scale * ellipse_->half_width();
        const Past now = past_.duration > 0 ? past_ : at_once(0);
        if (!is_given(now.semi_axes[0])) return;
        half_length_ = now.semi_axes[0];
        half_width_ = now.semi_axes[1];
    }

    // Whether there is no load, or next to none.
    bool lifted(Scalar load) const { return load >= 0 && load / ellipse_->load() < Scalar(1e-100); }

    // The contact under a load; without a load it is the contact under largest_load.
    rollbem::PatchContact<Scalar> contact_under(Scalar load) const {
        return (load > 0 && !lifted(load) ? ellipse_->under(load) : *ellipse_).contact();
    }

    // The least rolling speed of forces by table [m/s], which oppose the slip at standstill, too, where no creepage is
    // defined.
    static constexpr Scalar least_speed = 1e-6;

    Input slip_[2] = {{0}, {0}}, spin_{0}, speed_{20}, load_{1e5}, factor_{1}, axes_[2] = {{0}, {0}};
    Force force_{0, 0, 0};
    Scalar slip_work_ = 0;
    int sticking_elements_ = 0, initial_state_ = at_rest, status_ = 0;

    Scalar shear_modulus_ = 8e10, poisson_ratio_ = 0.28, friction_coefficient_ = 0.3, largest_load_ = 2e5;
    rollbem::HertzEllipse<Scalar>::Radii wheel_{.rolling = 0.46, .lateral = 1e9}, rail_{.rolling = 1e9, .lateral = 0.3};
    int elements_ = 8, strips_ = 8, mesh_size_ = mesh_follows_load;
    int mode_ = by_elements, off_table_ = 0;
    std::string table_file_;
    Scalar half_length_ = 0, half_width_ = 0;

    std::optional<Hertz> hertz_;
    std::optional<FrictionModel> model_;
    std::optional<rollbem::FrictionWorkspace<2, Scalar>> workspace_;
    rollbem::NormalLoad<Scalar> end_load_;  // of the present step
    State now_, from_, next_;               // from_: where the last step began
    Past past_;
    Step last_;

    std::optional<rollbem::HertzEllipse<Scalar>> ellipse_;   // under largest_load
    std::shared_ptr<const rollbem::CreepForceTable> table_;  // where mode is table
};

}  // namespace

const Identity identity{
    .identifier = "rollbem_patch",
    .description = "Elliptic contact patch with Coulomb friction and spin under a normal load that varies",
    .stop_time = 0.01,
    .step_size = 5e-5};

std::unique_ptr<Model> make_model() { return std::make_unique<Patch>(); }

}  // namespace fmu
