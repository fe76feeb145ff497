// Shared by the tests of friction: a scene in the units a = G = 1 under Hertz's pressure, and its steady solution.
#pragma once

#include <numbers>
#include <utility>

#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/line.hpp>

namespace friction_tests {

using namespace rollbem;

constexpr double nu = 0.25;
constexpr double peak = 1e-3;                               // mu p0, with a = G = 1
constexpr double full_force = peak * std::numbers::pi / 2;  // per width
constexpr Collocation half{.alpha_L = 0.5, .alpha_T = 0.5};

/// Creepage [-] by its ratio to the creepage of full sliding in Carter's problem.
inline double creepage(double ratio) { return 2 * (1 - nu) * peak * ratio; }
using Motion = FrictionModel::Motion;
inline double slope(const FrictionStep& step) { return step.tangent.by_longitudinal.longitudinal; }
inline double force_ratio(const FrictionStep& step, const Contact& contact) {
    return -step.force.longitudinal / (full_force * contact.width());
}

struct Scene {
    explicit Scene(Mesh<double> mesh_, Collocation scheme_ = half, double mu = 1, double aspect = 1e4)
        : contact(Contact::dimensionless(aspect, nu)),
          kernel(PlaneKernel<double>::longitudinal(contact)),
          mesh(std::move(mesh_)),
          scheme(scheme_),
          friction{mu, peak * mean_hertz_pressure(mesh)} {}

    ElementSystem<double> system() const { return rolling_system(mesh, scheme, kernel); }
    FrictionModel steady() const { return {contact, steady_system(mesh, scheme, kernel), friction}; }
    FrictionModel transient(Integrator integrator = Integrator::sdirk2) const {
        return {contact, system(), unchecked, friction, integrator};
    }

    Contact contact;
    PlaneKernel<double> kernel;
    Mesh<double> mesh;
    Collocation scheme;
    Friction friction;
};

/// The solution from rest, in a new workspace.
inline FrictionStep from_scratch(const FrictionModel& model, double xi) {
    return Run(model).steady({.motion = Creepage{xi}});
}

}  // namespace friction_tests
