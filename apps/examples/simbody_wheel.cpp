// rollbem in a multibody code: the contact gives the rail force on a driven wheel in Simbody 3.7. The wheel rolls
// steadily; when its rotation is kicked, it oscillates as the closed loop of the exact creep coefficient c11(s) does.
//
//     ./examples/simbody_wheel
//
//      n  frequency Hz  decay 1/s  frequency error  decay error
//     40      380.2840   746.4565         2.24e-05    -2.60e-04
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <Eigen/QR>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/adhesion/transient.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/spectral/chebyshev.hpp>

// Simbody's headers are C++17. For C++20 its indices need an operator== that is better than theirs with the operands
// swapped, and a header without use here, which has vectors of incomplete types, must be left out.
namespace SimTK {
template <class Index>
requires requires(const Index& index) { index.isValidExtended(); }
bool operator==(const Index& a, const Index& b) { return int(a) == int(b); }
}  // namespace SimTK
#define SimTK_SIMMATH_MULTIBODY_GRAPH_MAKER_H_
#include <Simbody.h>

namespace {

using Complex = std::complex<double>;
using Model = rollbem::AdhesionModel<>;

constexpr double mass = 6000, inertia = 80, radius = 0.46;  // the wheel's share of the vehicle, the wheel; SI units
constexpr double speed = 20, resistance = 2000, torque = radius * resistance;  // the torque keeps the speed
constexpr double kick = 1e-4;  // fraction of the rotation that is removed; small, so that the loop is linear
constexpr int samples = 20;    // in a period of the oscillation, of which 2.5 are computed

/// The contact at the last step that the integrator accepted.
struct Memory {
    double distance, creepage;  // the vehicle's [m], [-]
    Model::State state;
};

/// The rail force on the lowest point of a wheel.
///
/// The contact has memory, and Simbody evaluates forces in trials: several times within a step, in any order, and in
/// steps that it rejects. The memory is therefore an auto-update discrete variable of Simbody's State. Each evaluation
/// rolls the contact from the memory, which it does not change, to the trial and stores the result in the variable's
/// update value; the integrator makes it the new memory when it has accepted a step, and at no other time. The update
/// value also gives the force, which therefore does not jump there. (Events at fixed times would also do, but each
/// restarts the integrator, and the contact's steps would differ from the integrator's.)
struct RailForce final : SimTK::Force::Custom::Implementation {
    RailForce(const SimTK::GeneralForceSubsystem& all, const SimTK::MobilizedBody& on, const Model& contact, Memory at)
        : forces(all), wheel(on), model(contact), start(std::move(at)), workspace(model.workspace()) {}

    void realizeTopology(SimTK::State& state) const override {
        memory = forces.allocateAutoUpdateDiscreteVariable(state, SimTK::Stage::Dynamics,
                                                           new SimTK::Value<Memory>(start), SimTK::Stage::Velocity);
    }

    void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                   SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector&) const override {
        const SimTK::Vec3 centre = wheel.getBodyOriginLocation(state);
        const SimTK::Vec3 point = wheel.findStationAtGroundPoint(state, centre - SimTK::Vec3(0, radius, 0));
        Memory& update = SimTK::Value<Memory>::updDowncast(forces.updDiscreteVarUpdateValue(state, memory));
        if (!forces.isDiscreteVarUpdateValueRealized(state, memory)) {
            const Memory& old = SimTK::Value<Memory>::downcast(forces.getDiscreteVariable(state, memory));
            update.distance = centre[0];
            update.creepage =
                wheel.findStationVelocityInGround(state, point)[0] / wheel.getBodyOriginVelocity(state)[0];
            update.state = old.state;
            if (update.distance != old.distance) {
                const Model::Step step =
                    model.advance(old.state,
                                  {update.distance - old.distance,
                                   rollbem::RigidMotion<double>::linear(old.creepage, update.creepage)},
                                  update.state, workspace);
                // Simbody rejects the trial, for instance where the wheel would roll backwards.
                if (step.status != rollbem::Status::ok) throw std::runtime_error(name(step.status));
            }
            forces.markDiscreteVarUpdateValueRealized(state, memory);
        }
        wheel.applyForceToBodyPoint(state, point, SimTK::Vec3(model.force(update.state), 0, 0), body_forces);
    }

    double calcPotentialEnergy(const SimTK::State&) const override { return 0; }

    const SimTK::GeneralForceSubsystem& forces;
    const SimTK::MobilizedBody& wheel;
    const Model& model;
    Memory start;
    mutable Model::Workspace workspace;
    mutable SimTK::DiscreteVariableIndex memory;  // set in a const function, as Simbody's own elements do
};

/// s of the closed loop m dV/dt = F - D, J d(omega)/dt = T - R F in V/a: the root of s + kappa c11(s), by the secant
/// method, started at the root for c11 = C/(1 + (Lambda - 1/2) s).
Complex exact_root(const rollbem::Contact& contact) {
    const double a = contact.half_length(), poisson_ratio = contact.poisson_ratio(), aspect = contact.aspect();
    const double kappa = 2 * a * a * contact.half_width() * contact.shear_modulus() *
                         (1 / mass + radius * radius / inertia) / (speed * speed);
    const auto residual = [&](Complex s) {
        return s + kappa * rollbem::reference::plane_c11(s, poisson_ratio, aspect);
    };
    const double lag = rollbem::plane_lambda(poisson_ratio, aspect) - 0.5;
    const double steady = kappa * rollbem::steady_c11(poisson_ratio);
    Complex old = (-1.0 + std::sqrt(Complex(1 - 4 * lag * steady))) / (2 * lag), s = old * 1.01;
    for (int k = 0; k < 50 && std::abs(s - old) > 1e-13; ++k) {
        old = std::exchange(s, s - residual(s) * (s - old) / (residual(s) - residual(old)));
    }
    return s;
}

/// s of e^{s t} in samples, in 1/dt: x_{k+2h} = t x_{k+h} - d x_k by least squares, e^{2 Re(s) h} = d.
Complex fit(const Eigen::VectorXd& x) {
    const Eigen::Index h = samples / 10, first = 3 * samples / 4, count = x.size() - first - 2 * h;
    Eigen::MatrixX2d matrix(count, 2);
    matrix << x.segment(first + h, count), -x.segment(first, count);
    const Eigen::Vector2d td = matrix.colPivHouseholderQr().solve(x.segment(first + 2 * h, count));
    return std::log(td[0] / 2 + std::sqrt(Complex(td[0] * td[0] / 4 - td[1]))) / double(h);
}

}  // namespace

int main() {
    using namespace SimTK;
    const rollbem::Contact contact(
        {.half_length = 6e-3, .half_width = 12e-3, .shear_modulus = 8e10, .poisson_ratio = 0.28});
    const Complex exact = exact_root(contact) * speed / contact.half_length();  // [1/s]
    const double interval = 2 * std::numbers::pi / std::abs(exact.imag()) / samples;
    std::printf("  n  frequency Hz  decay 1/s  frequency error  decay error\n");
    Complex error;
    for (const int n : {10, 20, 40}) {
        // 1. The contact in steady rolling, where the force on the wheel is the resistance.
        const auto elements =
            rollbem::rolling_system(rollbem::cosine_mesh(n), rollbem::Collocation{.alpha_L = 0.5, .alpha_T = 0.5},
                                    rollbem::PlaneKernel<double>::longitudinal(contact));
        const Model model(contact, elements, rollbem::judge_stability(elements));
        const double creepage = resistance / model.force(model.steady(1.0));
        const double rotation = speed * (1 - creepage) / radius * (1 - kick);

        // 2. The vehicle slides along x; the wheel turns on it about -z, so that it rolls towards x.
        MultibodySystem system;
        SimbodyMatterSubsystem matter(system);
        GeneralForceSubsystem forces(system);
        const MobilizedBody::Slider vehicle(matter.updGround(), Transform(),
                                            Body::Rigid(MassProperties(0.9 * mass, Vec3(0), Inertia(1))), Transform());
        const Transform axle(Rotation(Pi, XAxis));
        const MobilizedBody::Pin wheel(
            matter.updMobilizedBody(vehicle.getMobilizedBodyIndex()), axle,
            Body::Rigid(MassProperties(0.1 * mass, Vec3(0), Inertia(inertia, inertia, inertia))), axle);
        Force::MobilityConstantForce(forces, vehicle, MobilizerUIndex(0), -resistance);
        Force::MobilityConstantForce(forces, wheel, MobilizerUIndex(0), torque);
        Force::Custom(forces, new RailForce(forces, wheel, model,
                                            {0, 1 - rotation * radius / speed, model.steady(creepage)}));  // owns it

        // 3. Time. Each accepted step is also a step of the contact, over which the creepage counts as linear: the
        // error is of second order in the largest step, whatever the integrator's order.
        State state = system.realizeTopology();
        vehicle.setOneU(state, 0, speed);
        wheel.setOneU(state, 0, rotation);
        RungeKuttaMersonIntegrator integrator(system);
        integrator.setAccuracy(1e-10);
        integrator.setMaximumStepSize(interval / 10);
        integrator.setReturnEveryInternalStep(true);  // CPodes would update discrete variables only when it returns
        TimeStepper stepper(system, integrator);
        stepper.initialize(state);
        rollbem::VectorX<double> sliding(5 * samples / 2);
        for (int k = 0; k < sliding.size(); ++k) {
            while (stepper.getTime() < (k + 1) * interval) stepper.stepTo((k + 1) * interval);
            const State& now = stepper.getState();
            sliding[k] = vehicle.getOneU(now, 0) - radius * wheel.getOneU(now, 0) - creepage * speed;
        }

        // 4. The oscillation of the sliding speed.
        const Complex measured = fit(sliding) / interval;
        error = {measured.real() / exact.real() - 1, std::abs(measured.imag() / exact.imag()) - 1};
        std::printf("%3d  %12.4f  %9.4f  %15.2e  %11.2e\n", n, std::abs(measured.imag()) / (2 * std::numbers::pi),
                    -measured.real(), error.imag(), error.real());
    }
    return std::abs(error.imag()) < 5e-5 && std::abs(error.real()) < 5e-4 ? EXIT_SUCCESS : EXIT_FAILURE;
}
