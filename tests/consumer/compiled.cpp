// A user of rollbem::compiled: every header of it, whose templates the linker finds in the library.
#include <cmath>
#include <complex>

#include <rollbem/compiled/all.hpp>
#include <rollbem/rollbem.hpp>

int main() {
    using namespace rollbem;
    const Contact<double> contact(
        {.half_length = 5e-3, .half_width = 50e-3, .shear_modulus = 8e10, .poisson_ratio = 0.28});
    const Mesh<double> mesh = cosine_mesh(20);
    const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    const auto kernel = StripKernel<double>::longitudinal(contact);
    const double c11 = solve_steady(mesh, scheme, kernel).c11;
    const ElementSystem<double> system = rolling_system(mesh, scheme, kernel);
    const FrequencySweep<double> sweep(system);
    const AdhesionModel<> model(contact, system, judge_stability(system));
    const SteadyFrictionModel friction(contact, mesh, scheme, kernel, {0.3, 1e9 * mean_hertz_pressure(mesh)});
    const auto rest = friction.at_rest();
    auto rolling = rest;
    auto workspace = friction.workspace();
    const double creepage = 1e-9, force = friction.steady(rest, creepage, rolling, workspace).force;
    const SteadyFrictionModel falling(
        contact, mesh, scheme, kernel,
        Friction<ExponentialFall<double>>{{0.3, 0.2, 1}, 1e9 * mean_hertz_pressure(mesh)});
    auto falling_to = falling.at_rest();
    auto falling_workspace = falling.workspace();
    const double falling_force = falling.steady(falling.at_rest(), creepage, 20, falling_to, falling_workspace).force;
    // full adhesion in six ways
    const double expected =
        -contact.half_length() * contact.shear_modulus() * 2 * contact.half_width() * c11 * creepage;
    const bool agree = std::abs(sweep(0).c11.real() - c11) < 1e-9 && std::abs(force / expected - 1) < 1e-3 &&
                       std::abs(falling_force / expected - 1) < 1e-3 &&
                       std::abs(model.force(model.steady(creepage)) / expected - 1) < 1e-9;
    const bool states =
        std::abs(solve_steady(contact, Chebyshev{12}, creepage).force_per_width * 2 * contact.half_width() / expected -
                 1) < 1e-2 &&
        rolling_system(Chebyshev{12}, kernel).size() == 12;
    const std::complex<double> s(0, 1);
    const bool exact = std::abs(solve_monomial(s, 0.28, 10.0, 30).c11 - polynomial_c11(s, 0.28, 10.0).c11) < 1e-6;
    return agree && states && exact ? 0 : 1;
}
