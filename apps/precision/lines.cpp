#include "lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <rollbem/accuracy/richardson.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/compiled/adhesion.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/hertz_load.hpp>
#include <rollbem/reference/step_response.hpp>
#include <rollbem/rolling/run.hpp>
#include <rollbem/spectral/polynomial.hpp>

#include "support/non_steady.hpp"

namespace precision {

namespace {

using rollbem::Mesh;
using rollbem::Status;
using rollbem::Topology;
using Array = rollbem::ArrayX<double>;
using Complex = std::complex<double>;
using Kernel = rollbem::AnyKernel<double>;

constexpr double load_amplitude = 0.5;  // N = N_0 (1 + A sin(2 pi q/L))
constexpr double load_length = 8;       // L/a_0
constexpr int load_steps = 160;         // in a period

double creepage(const study::Scene& scene, const Settings& settings) {
    return 2 * (1 - scene.contact.poisson_ratio()) * peak * settings.creepage_ratio;
}

/// mu N of Hertz's pressure.
double full(const study::Scene& scene) { return peak * std::numbers::pi / 2 * scene.contact.width(); }

rollbem::ElementSystem<double> slopes(const study::Scene& scene, const Kernel& kernel) {
    return steady_system(*scene.mesh, scene.scheme, kernel);
}

rollbem::Friction<> friction(const study::Scene& scene) {
    return {1, peak * rollbem::mean_hertz_pressure(*scene.mesh)};
}

/// With the half-length if the load varies: a uniform mesh gains nothing from edges that move with those of the
/// contact, and only equations that hold at points, with the plane kernel, can change the half-length.
bool breathes(const study::Scene& scene, const Settings& settings) {
    return settings.may_breathe && scene.topology() != Topology::uniform && scene.is_plane() &&
           scene.method != "galerkin" && scene.lambda.value_or(1) == 1;
}

// --- what a quantity consists of; not a number if the status is not ok

/// -F/(a G xi) at q = dq, 2 dq, ... after a step of creepage, exact in the time domain.
Values step_forces(const study::Scene& scene, const Settings& settings) {
    const rollbem::AdhesionModel<> model(scene.contact, study::system_of(scene), rollbem::unchecked,
                                         rollbem::Integrator::matrix_exponential);
    rollbem::Run contact(model);
    Values forces(steps);
    for (Complex& force : forces) force = -contact.advance({settings.dq, 1.0}).force_per_width;
    return forces;
}

/// -F/(mu N) at the creepage ratio.
Values friction_force(const study::Scene& scene, const Settings& settings) {
    const rollbem::FrictionModel<> model(scene.contact, slopes(scene, scene.kernel), friction(scene));
    const auto step = rollbem::Run(model).steady({.motion = creepage(scene, settings)});
    return {step.status == Status::ok ? -step.force / full(scene) : nan};
}

/// The same along and across at 45 degrees.
Values combined_forces(const study::Scene& scene, const Settings& settings) {
    // from kernels, as only then the model knows where the equations hold and turns the slip
    const rollbem::FrictionModel<rollbem::ConstantFriction<double>, 2> model(
        scene.contact,
        {slopes(scene, scene.kernel), slopes(scene, Kernel::lateral(scene.kernel.model(), scene.contact))},
        friction(scene));
    const double part = creepage(scene, settings) / std::numbers::sqrt2;
    const auto step = rollbem::Run(model).steady({.motion = {part, part}});
    if (step.status != Status::ok) return {nan, nan};
    return {-step.force.longitudinal / full(scene), -step.force.lateral / full(scene)};
}

/// -F/(mu N_0) after each of 160 steps in a period of the load.
Values load_forces(const study::Scene& scene, const Settings& settings) {
    const auto line = rollbem::HertzLine<double>::dimensionless(peak);  // a_0 = 1 and p_0 = mu p_0 = peak under N_0
    const bool follows = breathes(scene, settings);
    const double half_length = follows ? 1 : std::sqrt(1 + load_amplitude);
    const auto hertz = follows ? rollbem::HertzLoad<double>::breathing(line, *scene.mesh)
                               : rollbem::HertzLoad<double>::fixed(line, *scene.mesh, half_length);
    const rollbem::Contact<double> covered({.half_length = half_length,
                                            .half_width = scene.contact.half_width(),
                                            .shear_modulus = 1,
                                            .poisson_ratio = scene.contact.poisson_ratio()});
    const auto load_at = [&](double q) {
        return line.load_per_width() * (1 + load_amplitude * std::sin(2 * std::numbers::pi * q / load_length));
    };
    rollbem::NormalLoad<double> load = hertz.at(load_at(load_length / 4));
    const auto system = rolling_system(*scene.mesh, scene.scheme, Kernel::longitudinal(scene.kernel.model(), covered));
    const rollbem::FrictionModel<> model(covered, system, rollbem::unchecked, {1, load.normal_pressure});
    const double xi = creepage(scene, settings);
    rollbem::Run contact(model);
    hertz.set(load_at(0), load);
    Status status = contact.steady({.motion = xi, .load = load}).status;
    Values forces;
    const int count = load_steps * settings.load_parts;
    const double dq = load_length / count, all = line.load_per_width() * covered.width();
    for (int k = 1; k <= count; ++k) {
        hertz.set(load_at(k * dq), load);
        const auto step = contact.advance({dq, xi, load});
        if (status == Status::ok) status = step.status;
        if (k % settings.load_parts == 0) forces.push_back(status == Status::ok ? -step.force / all : nan);
    }
    return forces;
}

/// What a quantity other than the traction consists of on one mesh, or by states.
Values values(const study::Scene& scene, const Settings& settings, const Quantity& quantity) {
    switch (quantity.problem) {
        case Problem::harmonic: {
            const auto response = rollbem::solve_response<double>(study::system_of(scene), {0, quantity.frequency});
            return {response.status == Status::ok ? response.c11() : Complex(nan, nan)};
        }
        case Problem::transient: return step_forces(scene, settings);
        case Problem::friction: return friction_force(scene, settings);
        case Problem::combined_friction: return combined_forces(scene, settings);
        case Problem::varying_load: return load_forces(scene, settings);
        default: break;
    }
    const rollbem::Response<double> response = steady(scene);
    return {response.status == Status::ok ? response.c11() : nan};
}

/// Tractions times the root of their weight in the norm that the study's help defines, with Carter's.
Found weighted(const Array& tractions, const Array& carter, const Array& weights) {
    const auto scaled = [&](const Array& of) {
        const Array all = of * weights.sqrt();
        return Values(all.begin(), all.end());
    };
    return {scaled(tractions), scaled(carter)};
}

/// Of tractions that are constant on each element, against their means: the integral of p^2 sqrt(1 - x^2).
Found on_elements(const Mesh<double>& mesh, const Array& tractions, double nu) {
    return weighted(tractions, rollbem::carter_mean_tractions(mesh, nu),
                    mesh.widths() * rollbem::mean_hertz_pressure(mesh));
}

/// The same of a function of x/a: with x = cos(theta) the integral of (p sin(theta))^2, by the midpoint rule.
template <class Traction>
Found at_points(double nu, const Traction& traction) {
    constexpr int points = 64;
    Array own(points), carter(points), weights(points);
    for (int k = 0; k < points; ++k) {
        const double x = std::cos((k + 0.5) * std::numbers::pi / points);
        own[k] = std::real(traction(x));
        carter[k] = rollbem::carter_traction(x, nu);
        weights[k] = 1 - x * x;
    }
    return weighted(own, carter, weights);
}

/// Tractions, on one mesh, or extrapolated from two to pairs of elements, which form the coarser mesh.
Found tractions(const study::Scene& scene) {
    const double nu = scene.contact.poisson_ratio();
    if (scene.chebyshev) {
        const auto states = steady(scene);
        if (states.status != Status::ok) return {{nan}, {1}};
        return at_points(nu, rollbem::ChebyshevTraction<double>{states.unknowns.col(0)});
    }
    const auto of = [](const study::Scene& one) {  // Knothe and Gross-Thebing's leading element carries none
        const Array found = steady(one).unknowns.col(0);
        Array all = Array::Zero(one.mesh->size());
        all.head(found.size()) = found;
        return all;
    };
    const std::vector<study::Scene> meshes = scene.meshes();
    const Array fine = of(meshes.front());
    if (!scene.coarse) return on_elements(*scene.mesh, fine, nu);
    return on_elements(*scene.coarse, study::extrapolate_tractions(scene, fine, of(meshes.back())), nu);
}

}  // namespace

bool exists(const study::NamedScheme& scheme, long n) {
    if (scheme.method == "closed-form") return n == 0;
    if (scheme.method == "polynomial") return n >= 1;
    if (!scheme.has_elements()) return n >= 1 && n <= 10000;
    const long least = std::max(2l, long(rollbem::topology_info(scheme.topology()).least_n));
    return scheme.richardson ? n % 2 == 0 && n / 2 >= least : n >= least;
}

bool solves(const study::NamedScheme& scheme, Problem problem) {
    return scheme.has_elements() || problem < Problem::friction ||
           (scheme.method == "closed-form" && problem == Problem::friction);
}

rollbem::Response<double> steady(const study::Scene& scene) {
    if (scene.chebyshev) return solve_steady(*scene.chebyshev, scene.kernel);
    return rollbem::solve_steady<double>(rollbem::assemble_G_prime(*scene.mesh, scene.scheme, scene.kernel),
                                         rollbem::unknown_widths(*scene.mesh, scene.scheme));
}

Found evaluate(const study::Scene& scene, const Settings& settings, const Quantity& quantity, const Values& reference) {
    const double nu = scene.contact.poisson_ratio();
    // steady results of the plane do not depend on it
    const double aspect = std::isfinite(scene.contact.aspect()) ? scene.contact.aspect() : 1000;
    const bool traction = quantity.name == "traction", step = quantity.problem == Problem::transient;
    const auto after_step = [&](const auto& force) {
        Values forces(steps);
        for (int k = 0; k < steps; ++k) forces[std::size_t(k)] = force((k + 1) * settings.dq);
        return forces;
    };
    const auto polynomial_c11 = [&](Eigen::Index order) {
        return rollbem::polynomial_c11(Complex(0, quantity.frequency), nu, aspect, order).c11;
    };
    if (scene.is_discrete()) {
        if (traction) return tractions(scene);
        const std::vector<study::Scene> meshes = scene.meshes();
        Values found = values(meshes.front(), settings, quantity);
        if (!scene.coarse) return {found};
        const Values coarse = values(meshes.back(), settings, quantity);
        for (std::size_t k = 0; k < found.size(); ++k) {
            found[k] = rollbem::richardson(coarse[k], found[k], scene.order());
        }
        return {found};
    }
    if (scene.degree > 0) {
        if (traction) {
            const auto solution = rollbem::solve_polynomial(Complex(0), nu, aspect, scene.degree);
            return at_points(nu, [&](double x) { return solution.traction(x); });
        }
        if (!step) return {{polynomial_c11(scene.degree)}};
        const auto transform = [&](std::complex<long double> s) {
            return rollbem::polynomial_c11<long double>(s, nu, aspect, scene.degree).c11 / s;
        };
        return {after_step([&](double q) { return rollbem::reference::invert_laplace(transform, q); })};
    }
    // the closed form, against a second one where there are two
    if (traction) return {{rollbem::carter_traction(0.5, nu)}, {rollbem::carter_traction(0.5, nu)}};
    if (step) return {after_step([&](double q) { return rollbem::reference::step_response_de_hoog(q, nu, aspect); })};
    if (quantity.problem == Problem::harmonic)
        return {reference, {polynomial_c11(rollbem::default_polynomial_order(Complex(0, quantity.frequency)))}};
    return {reference, reference};
}

}  // namespace precision
