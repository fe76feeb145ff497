#include "rolling.hpp"

#include <utility>

#include <rollbem/compiled/friction.hpp>
#include <rollbem/friction/transient.hpp>

#include "support/errors.hpp"
#include "support/non_steady.hpp"
#include "surface.hpp"

namespace friction {

namespace {

/// The values that a model of one direction takes and gives.
struct OneDirection {
    using Model = rollbem::FrictionModel<>;
    using Value = double;

    static Value value(const Ratios& ratios, double unit) { return unit * ratios.longitudinal; }
    static void read_force(const Model::Step& step, Moment& moment) {
        moment.force_ratio = 0 - step.force_per_width / mu_N;  // 0 without load, not -0
        moment.pivots = step.pivots;
    }
};

struct Falling : OneDirection {
    using Model = FallingInTime;
};

/// The same of both.
struct BothDirections {
    using Model = rollbem::FrictionModel<ConstantFriction<>, 2>;
    using Value = rollbem::Creepage<double>;

    static Value value(const Ratios& ratios, double unit) {
        return {unit * ratios.longitudinal, unit * ratios.lateral.value_or(0)};
    }
    static void read_force(const Model::Step& step, Moment& moment) {
        moment.force_ratio = 0 - step.force_per_width.longitudinal / mu_N;
        moment.lateral_force_ratio = 0 - step.force_per_width.lateral / mu_N;
    }
};

struct CombinedFalling : BothDirections {
    using Model = CombinedFallingInTime;
};

template <class Directions>
class RollingOf : public Rolling {
public:
    using Model = typename Directions::Model;
    using Motion = rollbem::RigidMotion<typename Directions::Value>;

    RollingOf(const Model& model, const rollbem::HertzLoad<double>* hertz, double first_load_ratio, double unit)
        : model_(model), hertz_(hertz), unit_(unit), workspace_(model.workspace()), now_(model.at_rest()), next_(now_) {
        if (hertz_ == nullptr) return;
        load_ = hertz_->at(first_load_ratio * mu_N);
        now_.normal_pressure = load_.normal_pressure.head(now_.normal_pressure.size());
        now_.half_length = load_.half_length;
    }

    Moment settle(const Ratios& creepage) override {
        return keep(model_.steady(now_, Directions::value(creepage, unit_), next_, workspace_));
    }
    Moment shift(const Ratios& shift) override {
        return keep(model_.shift(now_, Directions::value(shift, 1), next_, workspace_));
    }
    Moment advance(double dq, const Ratios& from, const Ratios& to, double load_ratio) override {
        const Motion motion = Motion::linear(Directions::value(from, unit_), Directions::value(to, unit_));
        if (hertz_ == nullptr) return keep(model_.advance(now_, dq, motion, next_, workspace_));
        const rollbem::StepStatus status = hertz_->set(load_ratio * mu_N, load_);
        if (status != rollbem::StepStatus::ok) return {.status = status};
        return keep(model_.advance(now_, dq, motion, load_, next_, workspace_));
    }

private:
    template <class Step>
    Moment keep(const Step& step) {
        Moment moment;
        moment.status = step.status;
        moment.complementarity_residual = step.complementarity_residual;
        moment.rounds = step.rounds;
        if (step.status != rollbem::StepStatus::ok) return moment;
        std::swap(now_, next_);
        Directions::read_force(step, moment);
        moment.slip_work = step.slip_work_per_width / mu_N;
        moment.jump_work = step.jump_work_per_width / mu_N;
        moment.elastic_energy = model_.elastic_energy_per_width(now_) / mu_N;
        moment.stick_count = step.stick_count;
        return moment;
    }

    const Model& model_;
    const rollbem::HertzLoad<double>* hertz_;  // null where the load does not vary
    double unit_;                              // creepage of ratio 1
    typename Model::Workspace workspace_;
    typename Model::State now_, next_;
    rollbem::NormalLoad<double> load_;
};

template <class Directions>
class MakerOf : public RollingMaker {
public:
    MakerOf(typename Directions::Model model, std::optional<rollbem::HertzLoad<double>> hertz, double first_load_ratio,
            double unit)
        : model_(std::move(model)), hertz_(std::move(hertz)), first_load_ratio_(first_load_ratio), unit_(unit) {}

    std::unique_ptr<Rolling> start() const override {
        return std::make_unique<RollingOf<Directions>>(model_, hertz_ ? &*hertz_ : nullptr, first_load_ratio_, unit_);
    }

private:
    typename Directions::Model model_;
    std::optional<rollbem::HertzLoad<double>> hertz_;
    double first_load_ratio_, unit_;
};

}  // namespace

std::unique_ptr<RollingMaker> make_rolling(const study::Options& options, const study::Scene& scene,
                                           const Pressure& pressure, const std::optional<LoadHistory>& load,
                                           bool both_directions, const std::optional<FallingLaw>& falling,
                                           rollbem::Integrator integrator, double dq) {
    const bool fixed = load && !load->breathing;
    const Surface surface{scene, read_layer(options), fixed ? load->largest_half_length() : 1};
    rollbem::ElementSystem<double> system = surface.system(Direction::longitudinal);
    study::require_steppable(options, scene, system);
    if (load && load->breathing && !system.log_strength()) {
        throw study::BadInput(
            "--breathing needs equations that hold at points and a kernel without a layer: --method collocation or "
            "knothe-bc, lambda = 1, no --layer");
    }
    std::optional<rollbem::HertzLoad<double>> hertz;
    if (load) hertz = hertz_load(*load, *scene.mesh);
    // the law is that of the largest load; what a run starts under is in its state
    const double largest = surface.half_length * surface.half_length;
    const rollbem::Friction<> law{
        1, load ? hertz->at(largest * mu_N).normal_pressure : pressure(*scene.mesh)};
    const double first_load_ratio = load ? load->at(0) : 1, unit = creepage(scene, 1);
    if (both_directions) {
        rollbem::ElementSystem<double> across = surface.system(Direction::lateral);
        study::require_steppable(options, scene, across);
        if (falling) {
            return std::make_unique<MakerOf<CombinedFalling>>(
                CombinedFallingInTime(CombinedFallingInTime::Model(
                                          surface.contact(), std::move(system), std::move(across), rollbem::unchecked,
                                          {falling->law, falling->memory, law.normal_pressure}, integrator),
                                      dq),
                hertz, first_load_ratio, unit);
        }
        return std::make_unique<MakerOf<BothDirections>>(
            rollbem::FrictionModel<ConstantFriction<>, 2>(surface.contact(), std::move(system), std::move(across),
                                                   rollbem::unchecked, law, integrator),
            hertz, first_load_ratio, unit);
    }
    if (falling) {
        return std::make_unique<MakerOf<Falling>>(
            FallingInTime(FallingInTime::Model(surface.contact(), std::move(system), rollbem::unchecked,
                                               {falling->law, falling->memory, law.normal_pressure}, integrator),
                          dq),
            hertz, first_load_ratio, unit);
    }
    return std::make_unique<MakerOf<OneDirection>>(
        rollbem::FrictionModel<>(surface.contact(), std::move(system), rollbem::unchecked, law, integrator),
        hertz, first_load_ratio, unit);
}

}  // namespace friction
