#include "rolling.hpp"

#include <utility>

#include <rollbem/compiled/friction.hpp>
#include <rollbem/friction/model.hpp>

#include "support/errors.hpp"
#include "support/non_steady.hpp"
#include "surface.hpp"

namespace friction {

namespace {

template <int directions>
rollbem::detail::ByDirections<directions, double, rollbem::Creepage<double>> value(const Ratios& ratios, double unit) {
    if constexpr (directions == 1) {
        return unit * ratios.longitudinal;
    } else {
        return {unit * ratios.longitudinal, unit * ratios.lateral.value_or(0), unit * ratios.spin};
    }
}

void read_force(const rollbem::FrictionStep<>& step, double full, Moment& moment) {
    moment.force_ratio = 0 - step.force / full;  // 0 without load, not -0
    moment.pivots = step.pivots;
}
void read_force(const rollbem::FrictionStep<2>& step, double full, Moment& moment) {
    moment.force_ratio = 0 - step.force.longitudinal / full;
    moment.lateral_force_ratio = 0 - step.force.lateral / full;
    moment.moment_ratio = 0 - step.force.moment / full;
}

/// At the rolling velocity 1; a rigid shift takes as long as a step of `dq`.
template <class Model>
class RollingOf : public Rolling {
public:
    using Motion = typename Model::Motion;

    RollingOf(const Model& model, double width, const rollbem::HertzLoad<double>* hertz, double first_load_ratio,
              double unit, double dq)
        : model_(model),
          hertz_(hertz),
          unit_(unit),
          full_(mu_N * width),
          dq_(dq),
          workspace_(model.workspace()),
          now_(model.at_rest()),
          next_(now_) {
        if (hertz_ == nullptr) return;
        load_ = hertz_->at(first_load_ratio * mu_N);
        now_.normal_pressure = load_.normal_pressure.head(now_.normal_pressure.size());
        now_.half_length = load_.half_length;
    }

    Moment settle(const Ratios& creepage) override {
        return keep(model_.steady(now_, value(creepage, unit_), 1, next_, workspace_));
    }
    Moment shift(const Ratios& shift) override {
        return keep(model_.shift(now_, value(shift, 1), dq_, next_, workspace_));
    }
    Moment advance(double dq, const Ratios& from, const Ratios& to, double load_ratio) override {
        const Motion motion = Motion::linear(value(from, unit_), value(to, unit_));
        const rollbem::Travel<double> travel{dq, dq};
        if (hertz_ == nullptr) return keep(model_.advance(now_, travel, motion, next_, workspace_));
        const rollbem::StepStatus status = hertz_->set(load_ratio * mu_N, load_);
        if (status != rollbem::StepStatus::ok) return {.status = status};
        return keep(model_.advance(now_, travel, motion, load_, next_, workspace_));
    }

private:
    static typename Model::Value value(const Ratios& ratios, double unit) {
        return friction::value<Model::directions>(ratios, unit);
    }

    Moment keep(const typename Model::Step& step) {
        Moment moment;
        moment.status = step.status;
        moment.complementarity_residual = step.complementarity_residual;
        moment.rounds = step.rounds;
        if (step.status != rollbem::StepStatus::ok) return moment;
        std::swap(now_, next_);
        read_force(step, full_, moment);
        moment.slip_work = step.slip_work / full_;
        moment.jump_work = step.jump_work / full_;
        moment.elastic_energy = model_.elastic_energy(now_) / full_;
        moment.stick_count = step.stick_count;
        return moment;
    }

    const Model& model_;
    const rollbem::HertzLoad<double>* hertz_;  // null where the load does not vary
    double unit_, full_, dq_;                  // creepage of ratio 1, force of full sliding
    typename Model::Workspace workspace_;
    typename Model::State now_, next_;
    rollbem::NormalLoad<double> load_;
};

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
    const double first_load_ratio = load ? load->at(0) : 1, unit = creepage(scene, 1), width = scene.contact.width();
    const auto make = [&](auto model) -> StartRolling {
        return [=, shared = std::make_shared<const decltype(model)>(std::move(model))] {
            return std::make_unique<RollingOf<decltype(model)>>(*shared, width, hertz ? &*hertz : nullptr,
                                                                first_load_ratio, unit, dq);
        };
    };
    const auto make_of = [&](const auto& of) {
        const rollbem::Contact<double> contact = surface.contact();
        if (falling) {
            return make(rollbem::FrictionModel(contact, of, rollbem::unchecked, falling->under(means), integrator));
        }
        return make(rollbem::FrictionModel(contact, of, rollbem::unchecked, rollbem::Friction<>{1, means}, integrator));
    };
    if (!both_directions) return make_of(system);
    const rollbem::ElementSystem<double> across = surface.system(Direction::lateral);
    study::require_steppable(options, scene, across);
    const rollbem::ElementSystem both(system, across);
    if (breathes) require_plane_model(scene, *load, both, "- nu");
    return make_of(both);
}

}  // namespace friction
