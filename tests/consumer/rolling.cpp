// A user of the headers alone: the steady force, in full adhesion, is that of the model in time and of friction far
// from its bound.
#include <cmath>

#include <rollbem/rollbem.hpp>

int main() {
    using namespace rollbem;
    const Contact<double> contact(
        {.half_length = 5e-3, .half_width = 50e-3, .shear_modulus = 8e10, .poisson_ratio = 0.28});
    const Mesh<double> mesh = cosine_mesh(20);
    const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    const auto kernel = StripKernel<double>::longitudinal(contact);
    constexpr double creepage = 1e-9;
    const double expected = solve_steady(contact, mesh, scheme, creepage).force_per_width;
    const auto system = rolling_system(mesh, scheme, kernel);
    const auto verdict = judge_stability(system);
    const AdhesionModel<> model(contact, system, verdict);
    const double force = model.force(model.steady(creepage)) / (2 * contact.half_width());
    const FrictionModel friction(contact, system, verdict, {0.3, 1e9 * mean_hertz_pressure(mesh)});
    auto workspace = friction.workspace();
    auto rolling = friction.at_rest();
    const auto step = friction.steady(friction.at_rest(), creepage, rolling, workspace);
    const bool agree = std::abs(force / expected - 1) < 1e-9 && std::abs(step.force_per_width / expected - 1) < 1e-3;
    return agree && expected < 0 && step.status == StepStatus::ok ? 0 : 1;
}
