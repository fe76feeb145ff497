// A user of rollbem::compiled: every header of it compiles, and the linker finds the templates of line contacts and
// bodies of headers, which faces() of faces.cpp needs.
#include <cmath>

#include <rollbem/rollbem.hpp>

int faces();

int main() {
    using namespace rollbem;
    const Contact contact({.half_length = 5e-3, .half_width = 50e-3, .shear_modulus = 8e10, .poisson_ratio = 0.28});
    const Mesh<double> mesh = cosine_mesh(20);
    const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    const auto kernel = StripKernel<double>::longitudinal(contact);
    const double c11 = solve_steady(mesh, scheme, kernel).c11();
    const ElementSystem<double> system = rolling_system(mesh, scheme, kernel);
    const FrequencySweep sweep(system);
    const AdhesionModel<> model(contact, system, judge_stability(system));
    const FrictionModel friction(contact, steady_system(mesh, scheme, kernel), {0.3, 1e9 * mean_hertz_pressure(mesh)});
    const auto rest = friction.at_rest();
    auto rolling = rest;
    auto workspace = friction.workspace();
    const double creepage = 1e-9;
    const double force = friction.steady(rest, {.motion = Creepage{creepage}}, rolling, workspace).force.longitudinal;
    // full adhesion in four ways
    const double expected =
        -contact.half_length() * contact.shear_modulus() * 2 * contact.half_width() * c11 * creepage;
    const bool agree = std::abs(sweep(0).c11().real() - c11) < 1e-9 && std::abs(force / expected - 1) < 1e-3 &&
                       std::abs(model.force(model.steady(creepage)) / expected - 1) < 1e-9;
    return agree ? faces() : 1;
}
