// Shared by the tests of friction under a varying load: Hertz's contact with a_0 = G = 1 and mu p_0 = `peak` under
// the load `full_force`, on a mesh that breathes or on a fixed one.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "scene.hpp"

namespace friction_tests {

constexpr double load_nu = 0.28;

/// Creepage [-] by its ratio to that of full sliding under the load `full_force`.
inline double load_creepage(double ratio) { return 2 * (1 - load_nu) * peak * ratio; }

/// Cylinders of E = 1 with a = 1 and p_0 = `peak` under the load `full_force`; mu = 1.
inline HertzLine<double> unit_line() {
    const double compliance = 2 * (1 - load_nu * load_nu);
    return HertzLine<double>({.load_per_width = full_force,
                              .combined_radius = std::numbers::pi / (4 * full_force * compliance),
                              .body_1 = {1, load_nu},
                              .body_2 = {1, load_nu}});
}

struct LoadScene {
    Contact<double> contact;  // with the half-length that the mesh is made for
    Mesh<double> mesh;
    PlaneKernel<double> kernel;
    HertzLoad<double> hertz;
    Collocation scheme = half;
    double mu = 1;

    static LoadScene breathing(Mesh<double> mesh, double half_width = 1000, double half_length = 1) {
        const Contact<double> contact = contact_of(half_length, half_width);
        const HertzLoad<double> hertz = HertzLoad<double>::breathing(unit_line(), mesh);
        return {contact, std::move(mesh), PlaneKernel<double>::longitudinal(contact), hertz};
    }
    static LoadScene fixed(Mesh<double> mesh, double half_length = 1.25, double half_width = 1000) {
        const Contact<double> contact = contact_of(half_length, half_width);
        const HertzLoad<double> hertz = HertzLoad<double>::fixed(unit_line(), mesh, half_length);
        return {contact, std::move(mesh), PlaneKernel<double>::longitudinal(contact), hertz};
    }
    static Contact<double> contact_of(double half_length, double half_width) {
        return Contact<double>(
            {.half_length = half_length, .half_width = half_width, .shear_modulus = 1, .poisson_ratio = load_nu});
    }

    ElementSystem<double> system() const { return rolling_system(mesh, scheme, kernel); }
    ElementSystem<double> strip_system() const {
        return rolling_system(mesh, scheme, StripKernel<double>::longitudinal(contact));
    }
    FrictionModel<> model(Integrator integrator = Integrator::sdirk2) const {
        return {contact, system(), unchecked, law(), integrator};
    }
    FrictionModel<> strip_model(Integrator integrator = Integrator::sdirk2) const {
        return {contact, strip_system(), unchecked, law(), integrator};
    }
    Friction<> law() const { return {mu, hertz.at(full_force).normal_pressure}; }
};

/// full_force (1 + A sin(2 pi q/L + phase)).
struct SineLoad {
    double A = 0.5, L = 8, phase = 0;

    double operator()(double q) const { return full_force * (1 + A * std::sin(2 * std::numbers::pi * q / L + phase)); }
};

}  // namespace friction_tests
