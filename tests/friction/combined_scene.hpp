// Shared by the tests of friction in two directions: a scene in the units a = G = 1 under Hertz's pressure, and its
// solutions.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <rollbem/compiled/friction.hpp>

#include "support/unturned.hpp"

namespace combined_tests {

using namespace rollbem;

constexpr double peak = 1e-3;                               // mu p0, with a = G = 1
constexpr double full_force = peak * std::numbers::pi / 2;  // per width
constexpr Collocation half{.alpha_L = 0.5, .alpha_T = 0.5};
constexpr Integrator integrators[] = {Integrator::implicit_euler, Integrator::sdirk2};

using State = FrictionState<2>;
using Step = FrictionStep<2>;
using Workspace = FrictionWorkspace<2>;
using Model = FrictionModel<ConstantFriction<>, 2>;
using Motion = RigidMotion<Creepage<double>>;

struct Scene {
    explicit Scene(Mesh<double> mesh_, double nu_ = 0.28, Collocation scheme_ = half, double aspect = 1000)
        : nu(nu_),
          contact(Contact<double>::dimensionless(aspect, nu)),
          longitudinal(PlaneKernel<double>::longitudinal(contact)),
          lateral(PlaneKernel<double>::lateral(contact)),
          mesh(std::move(mesh_)),
          scheme(scheme_),
          friction{1, peak * mean_hertz_pressure(mesh)} {}

    /// Creepage by its ratio to that of full sliding in Carter's problem, and its angle in degrees.
    Creepage<double> creepage(double ratio, double degrees) const {
        const double size = 2 * (1 - nu) * peak * ratio, angle = degrees * std::numbers::pi / 180;
        return {size * std::cos(angle), size * std::sin(angle)};
    }
    ElementSystem<double> as_turned(const ElementSystem<double>& of) const {
        return turned ? of : support::unturned(of);
    }
    ElementSystem<double> along() const { return as_turned(rolling_system(mesh, scheme, longitudinal)); }
    ElementSystem<double> across() const { return as_turned(rolling_system(mesh, scheme, lateral)); }
    ElementSystem<double, 2> system() const { return {along(), across()}; }
    /// The same with slip that is not turned.
    Scene plain() const {
        Scene scene = *this;
        scene.turned = false;
        return scene;
    }
    Model steady() const { return steady(longitudinal, lateral, friction); }
    Model steady(const PlaneKernel<double>& along_x, const PlaneKernel<double>& along_y, const Friction<>& law) const {
        return {contact,
                {as_turned(steady_system(mesh, scheme, along_x)), as_turned(steady_system(mesh, scheme, along_y))},
                law};
    }
    Model transient(Integrator integrator = Integrator::sdirk2) const {
        return {contact, system(), unchecked, friction, integrator};
    }

    double nu;
    Contact<double> contact;
    PlaneKernel<double> longitudinal, lateral;
    Mesh<double> mesh;
    Collocation scheme;
    Friction<> friction;
    bool turned = true;
};

/// The solution from rest, in a new workspace.
inline Step from_scratch(const Model& model, const Creepage<double>& creepage, State& state) {
    const State rest = model.at_rest();
    state = rest;
    Workspace workspace = model.workspace();
    return model.steady(rest, creepage, state, workspace);
}
inline Step from_scratch(const Model& model, const Creepage<double>& creepage) {
    State state;
    return from_scratch(model, creepage, state);
}

/// Negative forces over mu N.
struct Ratios {
    double longitudinal, lateral;
};
inline Ratios ratios(const Step& step, const Contact<double>& contact) {
    const double full = full_force * contact.width();
    return {-step.force.longitudinal / full, -step.force.lateral / full};
}

}  // namespace combined_tests
