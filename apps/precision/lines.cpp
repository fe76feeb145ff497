#include "lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <rollbem/accuracy/richardson.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/compiled/adhesion.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/normal/hertz_load.hpp>
#include <rollbem/reference/step_response.hpp>
#include <rollbem/rolling/run.hpp>
#include <rollbem/spectral/polynomial.hpp>

namespace precision {

namespace {

using rollbem::Chebyshev;
using rollbem::Mesh;
using rollbem::Status;
using rollbem::Topology;
using Array = rollbem::ArrayX<double>;
using Complex = std::complex<double>;
using Kernel = rollbem::AnyKernel<double>;

constexpr double load_amplitude = 0.5;  // N = N_0 (1 + A sin(2 pi q/L))
constexpr double load_length = 8;       // L/a_0
constexpr int load_steps = 160;         // in a period

}  // namespace

std::vector<Discrete> discretise(const Scene& scene, const Scheme& scheme, long n) {
    if (!scheme.has_elements()) return {{scene, {}, std::nullopt, Chebyshev{n}}};
    // A uniform mesh gains nothing from edges that move with those of the contact, and only equations that hold at
    // points, with the plane kernel, can change the half-length.
    const bool breathes = scheme.topology() != Topology::uniform && scene.plane() && scheme.method != "galerkin" &&
                          scheme.lambda.value_or(1) == 1;
    std::vector<Discrete> meshes;
    for (const long own : scheme.richardson ? std::vector{n / 2, n} : std::vector{n}) {
        meshes.push_back({scene,
                          scheme.equations(),
                          rollbem::make_mesh(scheme.topology(), own, scheme.grading.value_or(nan)),
                          {},
                          breathes});
    }
    return meshes;
}

namespace {

// --- what a quantity consists of; not a number if the status is not ok

/// -F/(a G xi) at q = dq, 2 dq, ... after a step of creepage, exact in the time domain.
Values step_forces(const Discrete& discrete) {
    const rollbem::AdhesionModel<> model(discrete.scene.contact, discrete.system(), rollbem::unchecked,
                                         rollbem::Integrator::matrix_exponential);
    rollbem::Run contact(model);
    Values forces(steps);
    for (Complex& force : forces) force = -contact.advance({discrete.scene.dq, 1.0}).force_per_width;
    return forces;
}

/// -F/(mu N) at the creepage ratio.
Values friction_force(const Discrete& discrete) {
    const Scene& scene = discrete.scene;
    const rollbem::FrictionModel<> model(
        scene.contact, steady_system(*discrete.mesh, discrete.equations, scene.kernel()), discrete.friction());
    const auto step = rollbem::Run(model).steady({.motion = scene.creepage()});
    return {step.status == Status::ok ? -step.force / scene.full() : nan};
}

/// The same along and across at 45 degrees.
Values combined_forces(const Discrete& discrete) {
    const Scene& scene = discrete.scene;
    // from kernels, as only then the model knows where the equations hold and turns the slip
    const auto system = [&](const Kernel& kernel) { return steady_system(*discrete.mesh, discrete.equations, kernel); };
    const rollbem::FrictionModel<rollbem::ConstantFriction<double>, 2> model(
        scene.contact, {system(scene.kernel()), system(Kernel::lateral(scene.model, scene.contact))},
        discrete.friction());
    const double part = scene.creepage() / std::numbers::sqrt2;
    const auto step = rollbem::Run(model).steady({.motion = {part, part}});
    if (step.status != Status::ok) return {nan, nan};
    return {-step.force.longitudinal / scene.full(), -step.force.lateral / scene.full()};
}

/// -F/(mu N_0) after each of 160 steps in a period of the load.
Values load_forces(const Discrete& discrete) {
    const auto line = rollbem::HertzLine<double>::dimensionless(peak);  // a_0 = 1 and p_0 = mu p_0 = peak under N_0
    Scene scene = discrete.scene;
    const double half_length = discrete.breathes ? 1 : std::sqrt(1 + load_amplitude);
    const auto hertz = discrete.breathes ? rollbem::HertzLoad<double>::breathing(line, *discrete.mesh)
                                         : rollbem::HertzLoad<double>::fixed(line, *discrete.mesh, half_length);
    scene.contact = rollbem::Contact<double>({.half_length = half_length,
                                              .half_width = scene.contact.half_width(),
                                              .shear_modulus = 1,
                                              .poisson_ratio = scene.nu()});
    const auto load_at = [&](double q) {
        return line.load_per_width() * (1 + load_amplitude * std::sin(2 * std::numbers::pi * q / load_length));
    };
    rollbem::NormalLoad<double> load = hertz.at(load_at(load_length / 4));
    const rollbem::FrictionModel<> model(scene.contact,
                                         rollbem::rolling_system(*discrete.mesh, discrete.equations, scene.kernel()),
                                         rollbem::unchecked, {1, load.normal_pressure});
    rollbem::Run contact(model);
    hertz.set(load_at(0), load);
    Status status = contact.steady({.motion = scene.creepage(), .load = load}).status;
    Values forces;
    const int count = load_steps * scene.load_parts;
    const double dq = load_length / count, full = line.load_per_width() * scene.contact.width();
    for (int k = 1; k <= count; ++k) {
        hertz.set(load_at(k * dq), load);
        const auto step = contact.advance({dq, scene.creepage(), load});
        if (status == Status::ok) status = step.status;
        if (k % scene.load_parts == 0) forces.push_back(status == Status::ok ? -step.force / full : nan);
    }
    return forces;
}

}  // namespace

Values values(const Discrete& discrete, const Quantity& quantity) {
    switch (quantity.problem) {
        case Problem::harmonic: {
            const auto response = rollbem::solve_response<double>(discrete.system(), {0, quantity.frequency});
            return {response.status == rollbem::Status::ok ? response.c11() : Complex(nan, nan)};
        }
        case Problem::transient: return step_forces(discrete);
        case Problem::friction: return friction_force(discrete);
        case Problem::combined_friction: return combined_forces(discrete);
        case Problem::varying_load: return load_forces(discrete);
        default: break;
    }
    const rollbem::Response<double> response = discrete.steady();
    return {response.status == rollbem::Status::ok ? response.c11() : nan};
}

namespace {

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

}  // namespace

Found tractions(const std::vector<Discrete>& meshes, double order) {
    const Discrete& first = meshes.front();
    const double nu = first.scene.nu();
    if (!first.mesh) {
        const auto steady = first.steady();
        if (steady.status != rollbem::Status::ok) return {{nan}, {1}};
        return at_points(nu, rollbem::ChebyshevTraction<double>{steady.unknowns.col(0)});
    }
    const auto steady = [](const Discrete& discrete) {  // Knothe and Gross-Thebing's leading element carries none
        const Array found = discrete.steady().unknowns.col(0);
        Array all = Array::Zero(discrete.mesh->size());
        all.head(found.size()) = found;
        return all;
    };
    Array tractions = steady(first);
    if (meshes.size() > 1) {
        const Array fine = steady(meshes[1]), forces = fine * meshes[1].mesh->widths();
        for (Eigen::Index i = 0; i < tractions.size(); ++i) {
            const double mean = forces.segment(2 * i, 2).sum() / first.mesh->widths()[i];
            tractions[i] = rollbem::richardson(tractions[i], mean, order);
        }
    }
    return on_elements(*first.mesh, tractions, nu);
}

Found evaluate(const Scene& scene, const Scheme& scheme, long n, const Quantity& quantity, const Values& reference) {
    const double nu = scene.nu(), aspect = scene.finite_aspect();
    const bool traction = quantity.name == "traction", step = quantity.problem == Problem::transient;
    const auto after_step = [&](const auto& force) {
        Values forces(steps);
        for (int k = 0; k < steps; ++k) forces[std::size_t(k)] = force((k + 1) * scene.dq);
        return forces;
    };
    const auto polynomial_c11 = [&](Eigen::Index order) {
        return rollbem::polynomial_c11(Complex(0, quantity.frequency), nu, aspect, order).c11;
    };
    if (scheme.is_discrete()) {
        const std::vector<Discrete> meshes = discretise(scene, scheme, n);
        if (traction) return tractions(meshes, scheme.order());
        Values found = values(meshes.back(), quantity);
        if (meshes.size() == 1) return {found};
        const Values coarse = values(meshes.front(), quantity);
        for (std::size_t k = 0; k < found.size(); ++k) {
            found[k] = rollbem::richardson(coarse[k], found[k], scheme.order());
        }
        return {found};
    }
    if (scheme.method == "polynomial") {
        if (traction) {
            const auto solution = rollbem::solve_polynomial(Complex(0), nu, aspect, n);
            return at_points(nu, [&](double x) { return solution.traction(x); });
        }
        if (!step) return {{polynomial_c11(n)}};
        const auto transform = [&](std::complex<long double> s) {
            return rollbem::polynomial_c11<long double>(s, nu, aspect, n).c11 / s;
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
