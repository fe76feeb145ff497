// The driven wheel in Simbody 3.7, with the contact as a custom force element. C++17, as driven_wheel.hpp explains.
#include "driven_wheel.hpp"

#include <memory>
#include <stdexcept>

#include <Simbody.h>

namespace driven_wheel {

namespace {

/// The contact at the last step that the integrator accepted.
struct Memory {
    double distance = 0, creepage = 0;  // the vehicle's [m], [-]
    Contact::Tractions tractions{};
};

/// The rail force on the lowest point of a wheel.
///
/// The contact has memory, and Simbody evaluates forces in trials: several times within a step, in any order, and in
/// steps that it rejects. The memory is therefore an auto-update discrete variable of Simbody's State. Each evaluation
/// rolls the contact from the memory, which it does not change, to the trial and stores the result in the variable's
/// update value; the integrator makes that the new memory when it has accepted a step, and at no other time. The force
/// is that of the update value, so that it does not jump there. (Events at fixed times would also do, but each restarts
/// the integrator, and the contact's steps would differ from the integrator's.)
class RailForce : public SimTK::Force::Custom::Implementation {
public:
    RailForce(const SimTK::GeneralForceSubsystem& forces, const SimTK::MobilizedBody& wheel, double radius,
              const Contact& contact, int& trials)
        : forces_(forces), wheel_(wheel), radius_(radius), contact_(contact), trials_(trials) {}

    /// Sets the memory of a State whose positions and speeds are set.
    void remember(SimTK::State& state, const Contact::Tractions& tractions) const {
        const Motion motion = motion_of(state);
        SimTK::Value<Memory>::updDowncast(forces_.updDiscreteVariable(state, memory_))
            .set(Memory{motion.distance, motion.creepage, tractions});
    }

    void realizeTopology(SimTK::State& state) const override {
        memory_ = forces_.allocateAutoUpdateDiscreteVariable(state, SimTK::Stage::Dynamics, new SimTK::Value<Memory>(),
                                                             SimTK::Stage::Velocity);
    }

    void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                   SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector&) const override {
        const Motion motion = motion_of(state);
        Memory& update = SimTK::Value<Memory>::updDowncast(forces_.updDiscreteVarUpdateValue(state, memory_));
        if (!forces_.isDiscreteVarUpdateValueRealized(state, memory_)) {
            const Memory& memory = SimTK::Value<Memory>::downcast(forces_.getDiscreteVariable(state, memory_));
            const double dq = motion.distance - memory.distance;
            // The contact throws for what it refuses, such as rolling backwards; Simbody then rejects the trial.
            update.tractions =
                dq == 0 ? memory.tractions : contact_.advance(memory.tractions, dq, memory.creepage, motion.creepage);
            update.distance = motion.distance;
            update.creepage = motion.creepage;
            forces_.markDiscreteVarUpdateValueRealized(state, memory_);
            ++trials_;
        }
        const SimTK::Vec3 force(contact_.force(update.tractions), 0, 0);
        wheel_.applyForceToBodyPoint(state, motion.point, force, body_forces);
    }

    double calcPotentialEnergy(const SimTK::State&) const override { return 0; }

private:
    struct Motion {
        SimTK::Vec3 point;  // of the wheel, on the rail, in the wheel's frame [m]
        double distance, creepage;
    };

    Motion motion_of(const SimTK::State& state) const {
        const SimTK::Vec3 centre = wheel_.getBodyOriginLocation(state);
        const SimTK::Vec3 point = wheel_.findStationAtGroundPoint(state, centre - SimTK::Vec3(0, radius_, 0));
        const double sliding = wheel_.findStationVelocityInGround(state, point)[0];
        return {point, centre[0], sliding / wheel_.getBodyOriginVelocity(state)[0]};
    }

    const SimTK::GeneralForceSubsystem& forces_;
    const SimTK::MobilizedBody& wheel_;
    double radius_;
    const Contact& contact_;
    int& trials_;
    mutable SimTK::DiscreteVariableIndex memory_;  // set in a const function, as Simbody's own elements do
};

template <class Integrator>
std::unique_ptr<SimTK::Integrator> make(const SimTK::System& system) {
    return std::make_unique<Integrator>(system);
}

struct Named {
    const char* name;
    std::unique_ptr<SimTK::Integrator> (*make)(const SimTK::System&);
};

const Named known[] = {{"merson", make<SimTK::RungeKuttaMersonIntegrator>},
                       {"rk3", make<SimTK::RungeKutta3Integrator>},
                       {"verlet", make<SimTK::VerletIntegrator>},
                       {"cpodes", make<SimTK::CPodesIntegrator>}};

}  // namespace

std::vector<std::string> integrators() {
    std::vector<std::string> names;
    for (const Named& one : known) names.emplace_back(one.name);
    return names;
}

Response roll(const Wheel& wheel, const Contact& contact, const Start& start, const Integration& integration) {
    using namespace SimTK;
    // 1. The vehicle slides along x; the wheel turns on it about -z, so that it rolls towards x.
    MultibodySystem system;
    SimbodyMatterSubsystem matter(system);
    GeneralForceSubsystem forces(system);
    const Real wheel_mass = wheel.mass / 10;
    const Body::Rigid vehicle_body(MassProperties(wheel.mass - wheel_mass, Vec3(0), Inertia(1)));
    const Body::Rigid wheel_body(
        MassProperties(wheel_mass, Vec3(0), Inertia(wheel.inertia, wheel.inertia, wheel.inertia)));
    const MobilizedBody::Slider vehicle(matter.updGround(), Transform(), vehicle_body, Transform());
    const Transform axle(Rotation(Pi, XAxis));
    const MobilizedBody::Pin rolling(matter.updMobilizedBody(vehicle.getMobilizedBodyIndex()), axle, wheel_body, axle);

    // 2. The forces.
    Response response;
    Force::MobilityConstantForce(forces, vehicle, MobilizerUIndex(0), -wheel.resistance);
    Force::MobilityConstantForce(forces, rolling, MobilizerUIndex(0), wheel.torque);
    RailForce* const rail = new RailForce(forces, rolling, wheel.radius, contact, response.trials);
    Force::Custom(forces, rail);  // owns it

    // 3. Start.
    State state = system.realizeTopology();
    vehicle.setOneU(state, 0, start.speed);
    rolling.setOneU(state, 0, start.rotation);
    system.realize(state, Stage::Velocity);
    rail->remember(state, start.tractions);

    // 4. Time. Each accepted step is also a step of the contact, which takes the creepage as linear over it: the error
    // is of second order in the largest step, whatever the integrator's order.
    std::unique_ptr<Integrator> integrator;
    for (const Named& one : known) {
        if (one.name == integration.integrator) integrator = one.make(system);
    }
    if (!integrator) throw std::runtime_error("driven_wheel::roll: no integrator " + integration.integrator);
    integrator->setAccuracy(integration.accuracy);
    integrator->setMaximumStepSize(integration.largest_step);
    TimeStepper stepper(system, *integrator);
    integrator->setReturnEveryInternalStep(true);  // CPodes updates discrete variables only when it returns
    stepper.initialize(state);
    for (int k = 1; k <= integration.samples; ++k) {
        while (stepper.getTime() < k * integration.sample_interval) stepper.stepTo(k * integration.sample_interval);
        const State& now = stepper.getState();
        response.sliding.push_back(vehicle.getOneU(now, 0) - wheel.radius * rolling.getOneU(now, 0));
    }
    response.steps = integrator->getNumStepsTaken();
    response.rejected = integrator->getNumStepsAttempted() - response.steps;
    return response;
}

}  // namespace driven_wheel
