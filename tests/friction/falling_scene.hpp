// Shared by the tests of friction that falls with slip: a wheel on a rail in SI units.
#pragma once

#include <numbers>
#include <utility>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/friction/law.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>

namespace falling_tests {

using namespace rollbem;
using Law = ExponentialFall;
using Memory = Friction::Memory;
using Motion = FrictionModel::Motion;
using State = FrictionState;
using Step = FrictionStep;

constexpr double a = 4e-3, shear_modulus = 82e9, poisson_ratio = 0.28, peak_pressure = 495.169e6;  // [m], [Pa]
constexpr double speed = 45;                                                                       // V [m/s]
constexpr Law law{.mu_0 = 0.3, .mu_k = 0.18, .half_velocity = 0.1};
constexpr double least_velocity = 1e-3;
constexpr double half_width = 1000 * a;
constexpr double full_force = std::numbers::pi / 2 * law.mu_0 * peak_pressure * a * 2 * half_width;  // mu_0 N

inline double force_ratio(const Step& step) { return -step.force.longitudinal / full_force; }

struct Scene {
    explicit Scene(Mesh<double> mesh_, double distance_ = 0) : mesh(std::move(mesh_)), distance(distance_) {}

    Mesh<double> mesh;
    double distance;  // of the memory [m]
    Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    Contact contact{
        {.half_length = a, .half_width = half_width, .shear_modulus = shear_modulus, .poisson_ratio = poisson_ratio}};
    StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);

    ArrayX<double> pressure() const { return peak_pressure * mean_hertz_pressure(mesh); }
    Friction friction() const { return {law, pressure(), {distance, least_velocity}}; }
    FrictionModel steady() const { return {contact, steady_system(mesh, scheme, kernel), friction()}; }
    ElementSystem<double> system() const { return rolling_system(mesh, scheme, kernel); }
    FrictionModel transient(Integrator integrator = Integrator::sdirk2) const {
        return {contact, system(), unchecked, friction(), integrator};
    }
};

}  // namespace falling_tests
