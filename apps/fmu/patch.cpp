// rollbem_patch: an elliptic contact patch of wheel and rail with Coulomb friction and spin, under a load that varies.
//
// Forces come from the patch in the time domain, or from a table of steady forces. A step of duration h rolls by V h
// and shifts the wheel by s h, both at a constant rate, so that V = 0 is a rigid shift; the load varies linearly over
// the step.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Core>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/detail/finite.hpp>
#include <rollbem/detail/require.hpp>
#include <rollbem/discretisation/patch_mesh.hpp>
#include <rollbem/elasticity/patch_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/rolling/run.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>

#include "model.hpp"
#include "shared_table.hpp"

namespace fmu {

namespace {

using namespace rollbem;
using detail::to_text;

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

/// Inputs in the order of the table of variables: velocities of slip and spin, the rolling speed, and those that count
/// at the end of a step.
enum Of : Eigen::Index { along, across, spin, speed, load, factor, length, width, inputs };
using Values = Eigen::Array<double, inputs, 1>;

/// Duration [s] and inputs of a step.
struct Past {
    double duration = 0;
    Values at = Values::Zero();

    double distance() const { return duration * at[speed]; }
    Creepage shift() const { return {duration * at[along], duration * at[across], duration * at[spin]}; }
};

class Patch final : public Model {
public:
    Patch() {
        add_parameter(&shear_modulus_, "shear_modulus", "Pa", "Shear modulus G of both bodies").rule =
            detail::require_positive<double>;
        add_parameter(&poisson_ratio_, "poisson_ratio", "", "Poisson's ratio nu of both bodies").lies_in(0, 0.5);
        add_radius(wheel_.rolling, "wheel_rolling_radius", "Radius of the wheel, in the plane of rolling");
        add_radius(wheel_.lateral, "wheel_lateral_radius", "Radius of the wheel's profile at the contact");
        add_radius(rail_.rolling, "rail_rolling_radius", "Radius of the rail in the plane of rolling");
        add_radius(rail_.lateral, "rail_lateral_radius", "Radius of the rail's profile at the contact");
        add_parameter(&friction_coefficient_, "friction_coefficient", "", "Coefficient of friction mu")
            .is_not_negative();
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
        add_parameter(&largest_load_, "largest_load", "N", "The largest normal_load that a fixed mesh can take").rule =
            detail::require_positive<double>;
        add_parameter(&initial_state_, "initial_state", "", "State at the start", &initial_states);
        add_input(inputs_[along], "longitudinal_slip_velocity", "m/s",
                  "Rigid velocity of the wheel relative to the rail in the middle of the contact, along the rolling "
                  "direction; creepage times rolling_speed");
        add_input(inputs_[across], "lateral_slip_velocity", "m/s",
                  "Rigid velocity across the rolling direction, along y");
        add_input(inputs_[spin], "spin_rate", "rad/s",
                  "Angular velocity of the wheel relative to the rail about the normal, from x to y; spin times "
                  "rolling_speed");
        add_input(inputs_[speed], "rolling_speed", "m/s", "Speed V of the contact along the rail; not negative")
            .is_not_negative();
        add_input(inputs_[load], "normal_load", "N", "Load N at the end of a step; not negative").is_not_negative();
        add_input(inputs_[factor], "friction_factor", "", "Ratio of mu to friction_coefficient at the end of a step")
            .is_not_negative();
        add_input(inputs_[length], "given_half_length", "m",
                  "Semi-axis a at the end of a step, where mode is table; 0 with given_half_width = 0: a follows from "
                  "normal_load and the radii")
            .is_not_negative();
        add_input(inputs_[width], "given_half_width", "m", "Semi-axis b likewise").is_not_negative();
        add_output(&force_.longitudinal, "longitudinal_force", "N",
                   "Force on the wheel; opposes the slip velocity in steady rolling without spin");
        add_output(&force_.lateral, "lateral_force", "N", "Force on the wheel across the rolling direction");
        add_output(&force_.moment, "spin_moment", "N.m",
                   "Moment on the wheel about the normal through the middle of the contact");
        add_slip_work();
        add_output(&half_length_, "contact_half_length", "m",
                   "Semi-axis a along x: given, or by Hertz under normal_load")
            .is_not_negative();
        add_output(&half_width_, "contact_half_width", "m", "Semi-axis b along y likewise").is_not_negative();
        add_output(&sticking_elements_, "sticking_elements", "", "Number of elements that stick; 0 by table")
            .is_not_negative();
        auto& off_table =
            add_output(&off_table_, "off_table", "",
                       "1 where a/b of the last step lies beyond the table: the table's nearest ellipse of "
                       "the same area gives the forces, with an unknown error; else 0");
        off_table.lies_in(0, 1);
        add_status();
    }

    double partial(Eigen::Index output, Eigen::Index input) override {
        const bool stepped = past_.duration > 0;
        if (output > 2) throw NoDerivative{};
        // a step that changes only one semi-axis from 0, or any semi-axis of a patch, is refused
        if (input >= length && !is_given(past_.at)) throw NoDerivative{" here"};
        if (!stepped && initial_state_ == in_steady_rolling) throw NoDerivative{" before the first step"};
        const Force by = stepped ? partial_by(input) : Force{0, 0, 0};  // at rest there is no force
        return std::array{by.longitudinal, by.lateral, by.moment}[static_cast<std::size_t>(output)];
    }

    void archive(Archive& archive) override {
        if (run_) {
            for (State* state : {&run_->now(), &from_}) {
                archive.keep(state->traction);
                archive.keep(state->unrotated_traction);
                archive.keep(state->zones);
                archive.keep(state->normal_pressure);
                archive.keep(state->half_length);
                archive.keep(state->half_width);
            }
        }
        archive.keep(past_.duration);
        archive.keep(past_.at);
        archive.keep(last_);
    }

private:
    using Force = TangentialForce;
    using Hertz = HertzEllipse::Load;
    using Friction = FrictionModel;
    using Step = FrictionStep;
    using State = FrictionState;

    void add_radius(double& radius, const char* name, const std::string& description) {
        add_parameter(&radius, name, "m", description + "; negative if concave, 1e9 if flat").rule =
            [](const char* who, const char* quantity, double value) {
                detail::require(!detail::is_nan(value) && value != 0, who, quantity, value, "be a number other than 0");
            };
    }

    std::optional<Status> build() override {
        const ElasticBody body{.young_modulus = 2 * shear_modulus_ * (1 + poisson_ratio_),
                               .poisson_ratio = poisson_ratio_};
        // largest_load rather than normal_load: a state can be restored in a contact built under another load
        ellipse_.emplace(HertzEllipse::Parameters{
            .load = largest_load_, .radii_1 = wheel_, .radii_2 = rail_, .body_1 = body, .body_2 = body});
        table_.reset();
        run_.reset();
        off_table_ = 0;
        const bool by_elements = mode_ != by_table, steady = initial_state_ == in_steady_rolling;
        const Values now = after(0, inputs_);
        last_ = by_elements ? begin_by_elements(now, steady) : begin_by_table(now);
        past_ = {by_elements ? 0.0 : 1.0, now};  // the table's forces are those of a step
        show();
        return by_elements && !steady ? std::nullopt : std::optional(Status::ok);
    }

    Status advance(double duration) override {
        const Values start = after(0, inputs_), end = after(duration, inputs_);
        if (!detail::all_finite(start) || !detail::all_finite(end)) return Status::not_finite;
        if (end[factor] < 0) return Status::invalid_load;
        if (start[speed] < 0 || end[speed] < 0) return Status::invalid_step;
        Past step{duration, end};
        const Step result = table_ ? take_by_table(start, step) : take_by_elements(start, step);
        if (result.status != Status::ok) return result.status;
        past_ = step;
        last_ = result;
        slip_work_ += result.slip_work;
        show();
        return Status::ok;
    }

    void show() {
        force_ = last_.force;
        sticking_elements_ = static_cast<int>(last_.stick_count);
        const SemiAxes axes = axes_of(past_.at);
        half_length_ = axes.half_length;
        half_width_ = axes.half_width;
    }

    static bool is_given(const Values& at) { return at[length] != 0 || at[width] != 0; }

    // Whether there is no load, or next to none.
    bool is_lifted(const Values& at) const { return at[load] / ellipse_->load() < 1e-100; }

    // Semi-axes as given, or by Hertz, where both grow like N^(1/3).
    SemiAxes axes_of(const Values& at) const {
        if (is_given(at)) return {at[length], at[width]};
        const double scale = std::cbrt(at[load] / ellipse_->load());
        return {scale * ellipse_->half_length(), scale * ellipse_->half_width()};
    }

    // Derivative of the forces at the end of the last step by an input during it.
    Force partial_by(Eigen::Index input) {
        switch (input) {
            case along: return last_.tangent.by_longitudinal;
            case across: return last_.tangent.by_lateral;
            case spin: return last_.tangent.by_spin;
            case speed: return table_ ? partial_of_table_by_speed() : partial_of_elements_by_speed();
            case load: return partial_by_load();
            case factor:
                return table_ ? friction_coefficient_ * find(past_.at).tangent_by_friction_coefficient
                              : again(past_, true).tangent_by_load;
            case length: return last_.tangent_by_half_length;
            default: return last_.tangent_by_half_width;
        }
    }

    Force partial_by_load() const {
        const double N = past_.at[load];
        if (is_given(past_.at) || (run_ && !hertz_->breathes())) return last_.tangent_by_load;
        if (table_ && is_lifted(past_.at)) return first_force();
        return last_.tangent_by_load + half_length_ / (3 * N) * last_.tangent_by_half_length +
               half_width_ / (3 * N) * last_.tangent_by_half_width;
    }

    // --- by elements

    Step begin_by_elements(const Values& now, bool steady) {
        const bool fixed = mesh_size_ == fixed_mesh;
        require(now[load] >= 0 && (fixed || now[load] > 0), "normal_load", now[load],
                fixed ? "not be negative" : "be positive where mesh_size is follows_load");
        require(!fixed || now[load] <= largest_load_, "normal_load", now[load], "be at most largest_load");
        require(now[length] == 0, "given_half_length", now[length], "be 0 where mode is patch");
        require(now[width] == 0, "given_half_width", now[width], "be 0 where mode is patch");
        detail::require_not_negative(identity.identifier, "friction_factor", now[factor]);
        const PatchContact contact = ellipse_->contact();
        const PatchMesh<double> mesh = patch_mesh(contact, elements_, strips_);
        const NodeDifference scheme{Nodes::chebyshev};
        const HalfSpace<double> kernel(poisson_ratio_);
        hertz_ = fixed ? Hertz::fixed(*ellipse_, contact, mesh) : Hertz::breathing(*ellipse_, contact, mesh);
        model_.emplace(contact,
                       fixed ? rolling_system(mesh, scheme, kernel) : breathing_system(contact, mesh, scheme, kernel),
                       judge_stability(patch_subsystems(mesh, scheme, kernel)),
                       rollbem::Friction{friction_coefficient_, hertz_pressures(contact, mesh, largest_load_)});
        end_load_ = hertz_->at(now[load]);
        end_load_.normal_pressure *= now[factor];
        run_.emplace(*model_, model_->at_rest(end_load_));
        Step first;
        first.force = {0, 0, 0};
        first.stick_count = model_->size();
        if (steady) first = roll_steadily(now);
        from_ = run_->now();
        return first;
    }

    Step roll_steadily(const Values& now) {
        require_inputs();
        const double V = now[speed];
        require(V > 0, "rolling_speed", V, "be positive where initial_state is steady");
        const Step found =
            run_->steady({.motion = {now[along] / V, now[across] / V, now[spin] / V}, .load = end_load_});
        require(found.status == Status::ok, "status of steady rolling at the first inputs", name(found.status),
                "be ok");
        return found;
    }

    // A step at the mean velocities, which becomes the present state if it is ok.
    Step take_by_elements(const Values& start, Past& step) {
        step.at.head<speed + 1>() = (start.head<speed + 1>() + step.at.head<speed + 1>()) / 2;
        Step result = try_step(step);
        if (result.status != Status::ok) return result;
        result.tangent = step.duration * result.tangent;
        from_ = run_->now();
        run_->accept();
        return result;
    }

    // A step that is not accepted; with `by_factor` tangent_by_load is the derivative by the factor of mu.
    Step try_step(const Past& step, bool by_factor = false) {
        Step failed;
        failed.status = is_given(step.at) ? Status::invalid_load : hertz_->set(step.at[load], end_load_);
        // forces of a contact too small for its mesh are rough, and as small as its load
        if (failed.status != Status::ok && failed.status != Status::unresolved) return failed;
        // mu as a factor of the pressures, which bound the tractions together
        if (by_factor) end_load_.pressure_rate = end_load_.normal_pressure;
        end_load_.normal_pressure *= step.at[factor];
        if (!by_factor) end_load_.pressure_rate *= step.at[factor];
        return run_->try_advance({step.distance(), Friction::Motion::shift(step.shift()), end_load_});
    }

    // The last step again, or another from its start.
    Step again(const Past& step, bool by_factor = false) {
        std::swap(run_->now(), from_);
        const Step result = try_step(step, by_factor);
        std::swap(run_->now(), from_);
        return result;
    }

    Force partial_of_elements_by_speed() {
        const auto force_at = [&](double distance) {
            Past step = past_;
            step.at[speed] = distance / step.duration;
            return again(step).force;
        };
        return past_.duration * tangent_by_distance(past_.distance(), run_->now().half_length, force_at);
    }

    // --- by table

    Step begin_by_table(const Values& now) {
        table_ =
            shared_table<CreepForceTable>("table_file", table_file_.empty() ? resources + "/steel.creep" : table_file_);
        require_inputs();
        require(table_->fits(poisson_ratio_), "poisson_ratio", poisson_ratio_,
                "be within 0.01 of " + to_text(table_->grid().poisson_ratio()) + " of the table");
        const CreepForceTable::Grid& grid = table_->grid();
        const double a_over_b = ellipse_->contact().a_over_b();
        require(a_over_b >= grid.smallest_a_over_b() && a_over_b <= grid.largest_a_over_b(), "a/b of the contact",
                a_over_b, "lie in [" + range_of_table(", ") + "] of the table");
        const Step first = take_by_table(now, {1, now});
        require(first.status == Status::ok, "status of the table at the first inputs", name(first.status), "be ok");
        return first;
    }

    // A step by table: forces at the inputs of its end, work as the mean over the inputs of both ends.
    Step take_by_table(const Values& start, const Past& step) {
        const CreepForceTable::Force found = find(step.at);
        Step result = step_of(found, step);
        if (result.status == Status::ok && (start != step.at).any()) {
            const Step before = step_of(find(start), {step.duration, start});
            result.slip_work = (result.slip_work + before.slip_work) / 2;
            result.status = before.status;
        }
        if (result.status == Status::ok) tell(step.at, found.a_over_b_on_table);
        return result;
    }

    std::string range_of_table(const char* to) const {
        return to_text(table_->grid().smallest_a_over_b()) + to + to_text(table_->grid().largest_a_over_b());
    }

    // Sets off_table, and warns where a/b leaves the table.
    void tell(const Values& at, bool on_table) {
        if (!on_table && off_table_ == 0) {
            warning = "a/b = " + to_text(contact_of(at).a_over_b()) + " of the contact lies beyond the table, " +
                      range_of_table(" to ") + ": its border gives the forces while off_table is 1";
        }
        off_table_ = on_table ? 0 : 1;
    }

    PatchContact contact_of(const Values& at) const {
        if (!is_given(at) && is_lifted(at)) return ellipse_->contact();
        const SemiAxes axes = axes_of(at);
        return PatchContact({axes.half_length, axes.half_width, shear_modulus_, poisson_ratio_});
    }

    CreepForceTable::Force find(const Values& at) const {
        CreepForceTable::Force refused;
        refused.status = Status::invalid_load;
        if (at[load] < 0 || (is_given(at) && !(at[length] > 0 && at[width] > 0))) return refused;
        const double V = std::max(at[speed], least_speed);
        return table_->look_up(contact_of(at), friction_coefficient_ * at[factor], is_lifted(at) ? 0 : at[load],
                               {at[along] / V, at[across] / V, at[spin] / V});
    }

    static Step step_of(const CreepForceTable::Force& found, const Past& step) {
        Step result;
        result.status = found.status;
        if (result.status != Status::ok) return result;
        result.force = found.force;
        result.tangent = 1 / std::max(step.at[speed], least_speed) * found.tangent;
        result.tangent_by_load = found.tangent_by_load;
        result.tangent_by_half_length = found.tangent_by_half_length;
        result.tangent_by_half_width = found.tangent_by_half_width;
        result.slip_work =
            -step.duration * (step.at[along] * found.force.longitudinal + step.at[across] * found.force.lateral +
                              step.at[spin] * found.force.moment);
        return result;
    }

    Force partial_of_table_by_speed() const {
        if (past_.at[speed] <= least_speed) return {0, 0, 0};
        const auto& [by_longitudinal, by_lateral, by_spin] = last_.tangent;
        return -1 / past_.at[speed] *
               (past_.at[along] * by_longitudinal + past_.at[across] * by_lateral + past_.at[spin] * by_spin);
    }

    // Derivative of the forces by the load at N = 0: N f(xi/N^(1/3), eta/N^(1/3), phi) slides everywhere, but under
    // spin alone f is the same at any load; the moment has another N^(1/3).
    Force first_force() const {
        const Values& at = past_.at;
        const double mu = at[factor] * friction_coefficient_, slip = std::hypot(at[along], at[across]);
        if (slip > 0) return {-mu * (at[along] / slip), -mu * (at[across] / slip), 0};
        const double N = ellipse_->load(), phi = at[spin] / std::max(at[speed], least_speed);
        const Force any = table_->look_up(ellipse_->contact(), mu, N, {0, 0, phi}).force;
        return {any.longitudinal / N, any.lateral / N, 0};
    }

    // The least rolling speed of forces by table [m/s], which oppose the slip at standstill, too, where no creepage is
    // defined.
    static constexpr double least_speed = 1e-6;

    std::array<Input, inputs> inputs_{{{0}, {0}, {0}, {20}, {1e5}, {1}, {0}, {0}}};
    double shear_modulus_ = 8e10, poisson_ratio_ = 0.28, friction_coefficient_ = 0.3, largest_load_ = 2e5;
    HertzEllipse::Radii wheel_{.rolling = 0.46, .lateral = 1e9}, rail_{.rolling = 1e9, .lateral = 0.3};
    int elements_ = 8, strips_ = 8, mesh_size_ = mesh_follows_load, mode_ = by_elements, initial_state_ = at_rest;
    std::string table_file_;

    Force force_{0, 0, 0};
    double half_length_ = 0, half_width_ = 0;
    int sticking_elements_ = 0, off_table_ = 0;

    std::optional<HertzEllipse> ellipse_;  // under largest_load
    Past past_;                            // the last step: inputs that count, result
    Step last_;

    std::shared_ptr<const CreepForceTable> table_;  // where mode is table

    std::optional<Hertz> hertz_;  // where mode is patch, as all below
    std::optional<Friction> model_;
    std::optional<Run<Friction>> run_;
    State from_;           // where the last step began
    NormalLoad end_load_;  // of the present step
};

}  // namespace

const Identity identity{
    .identifier = "rollbem_patch",
    .description = "Elliptic contact patch with Coulomb friction and spin under a normal load that varies",
    .stop_time = 0.01,
    .step_size = 5e-5};

std::unique_ptr<Model> make_model() { return std::make_unique<Patch>(); }

}  // namespace fmu
