#include "rolling.hpp"

#include <rollbem/compiled/friction.hpp>
#include <rollbem/friction/model.hpp>

#include "support/errors.hpp"
#include "support/non_steady.hpp"
#include "surface.hpp"

namespace friction {

namespace {

rollbem::Creepage<double> value(const Ratios& ratios, double unit) {
    return {unit * ratios.longitudinal, unit * ratios.lateral.value_or(0), unit * ratios.spin};
}

// On a mesh that breathes b/a falls as the load grows, for the system of one direction or that of both.
template <class System>
void require_plane_model(const study::Scene& scene, const study::LoadHistory& load, const System& system,
                         const char* term) {
    const double longest = largest_half_length(load);
    if (longest < system.half_length_limit()) return;
    const double least = scene.contact.aspect() * longest / system.half_length_limit();
    throw study::BadInput("--aspect = " + study::Cell(scene.contact.aspect()).text(6) + " must be larger than " +
                          study::Cell(least).text(4) + " with --breathing, as a grows to " +
                          study::Cell(longest).text(4) + " a_0: Lambda = ln(4b/a) " + term +
                          " must be positive, or the plane model itself is unstable in time");
}

}  // namespace

Rolling::Rolling(const rollbem::FrictionContact& contact, const Units& units,
                 const std::optional<rollbem::HertzLoad<double>>& hertz, double first_load_ratio)
    : contact_(contact), units_(units), hertz_(hertz), run_(contact_) {
    if (!hertz_) return;
    load_ = hertz_->at(first_load_ratio * mu_N);
    run_.now().normal_pressure = load_.normal_pressure.head(contact_.size());
    run_.now().half_length = load_.half_length;
}

Moment Rolling::settle(const Ratios& creepage) { return read(run_.steady(value(creepage, units_.creepage), 1.0)); }

Moment Rolling::shift(const Ratios& shift) { return read(run_.shift(value(shift, 1), units_.dq)); }

Moment Rolling::advance(double dq, const Ratios& from, const Ratios& to, double load_ratio) {
    const auto motion =
        rollbem::FrictionContact::Motion::linear(value(from, units_.creepage), value(to, units_.creepage));
    const rollbem::Travel<double> travel{dq, dq};
    if (!hertz_) return read(run_.advance(travel, motion));
    const rollbem::StepStatus status = hertz_->set(load_ratio * mu_N, load_);
    if (status != rollbem::StepStatus::ok) return {.status = status};
    return read(run_.advance(travel, motion, load_));
}

Moment Rolling::read(const rollbem::FrictionStep<2>& step) const {
    Moment moment;
    moment.status = step.status;
    moment.complementarity_residual = step.complementarity_residual;
    moment.rounds = step.rounds;
    if (step.status != rollbem::StepStatus::ok) return moment;
    moment.force_ratio = 0 - step.force.longitudinal / units_.force;  // 0 without load, not -0
    if (contact_.directions() == 2) {
        moment.lateral_force_ratio = 0 - step.force.lateral / units_.force;
        moment.moment_ratio = 0 - step.force.moment / units_.force;
    } else {
        moment.pivots = step.pivots;
    }
    moment.slip_work = step.slip_work / units_.force;
    moment.jump_work = step.jump_work / units_.force;
    moment.elastic_energy = contact_.elastic_energy(run_.now()) / units_.force;
    moment.stick_count = step.stick_count;
    return moment;
}

StartRolling make_rolling(const study::Options& options, const study::Scene& scene, const Pressure& pressure,
                          const std::optional<study::LoadHistory>& load, bool both_directions,
                          const std::optional<FallingLaw>& falling, rollbem::Integrator integrator, double dq) {
    const bool fixed = load && !load->breathing;
    const Surface surface{scene, read_layer(options), fixed ? largest_half_length(*load) : 1};
    const rollbem::ElementSystem<double> system = surface.system(Direction::longitudinal);
    study::require_steppable(options, scene, system);
    if (load && load->breathing && !system.log_strength()) {
        throw study::BadInput(
            "--breathing needs equations that hold at points and a kernel without a layer: --method collocation, nodes "
            "or knothe-bc, lambda = 1, no --layer");
    }
    const bool breathes = load && load->breathing;
    if (breathes && !both_directions) require_plane_model(scene, *load, system, "+ nu/(1-nu)");
    std::optional<rollbem::HertzLoad<double>> hertz;
    if (load) hertz = hertz_load(*load, *scene.mesh);
    // the law is that of the largest load; what a run starts under is in its state
    const double largest = surface.half_length * surface.half_length;
    const Eigen::ArrayXd means = load ? hertz->at(largest * mu_N).normal_pressure : pressure(*scene.mesh);
    const double first_load_ratio = load ? load->at(0) : 1;
    const Rolling::Units units{.creepage = creepage(scene, 1), .force = mu_N * scene.contact.width(), .dq = dq};
    const auto make_of = [&](const auto& of) -> StartRolling {
        const auto model = [&](const auto& friction) {
            return rollbem::FrictionModel(surface.contact(), of, rollbem::unchecked, friction, integrator);
        };
        const rollbem::FrictionContact contact = falling
                                                     ? rollbem::FrictionContact(model(falling->under(means)))
                                                     : rollbem::FrictionContact(model(rollbem::Friction<>{1, means}));
        return [=] { return std::make_unique<Rolling>(contact, units, hertz, first_load_ratio); };
    };
    if (!both_directions) return make_of(system);
    const rollbem::ElementSystem<double> across = surface.system(Direction::lateral);
    study::require_steppable(options, scene, across);
    const rollbem::ElementSystem both(system, across);
    if (breathes) require_plane_model(scene, *load, both, "- nu");
    return make_of(both);
}

}  // namespace friction
