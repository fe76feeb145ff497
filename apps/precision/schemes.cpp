#include "schemes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <variant>

#include <rollbem/accuracy/richardson.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/assembly.hpp>
#include <rollbem/compiled/frequency.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/polynomial.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/compiled/transient.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/step_response.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "support/non_steady.hpp"

namespace precision {

namespace {

using rollbem::ArrayX;
using rollbem::Chebyshev;
using rollbem::Collocation;
using rollbem::Contact;
using rollbem::Galerkin;
using rollbem::MatrixX;
using rollbem::Mesh;
using rollbem::RollingSystem;
using rollbem::Topology;
using Complex = std::complex<double>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double peak = 1e-3;           // mu p0 / G
constexpr double creepage_ratio = 0.5;  // delta of friction_force
constexpr std::size_t steps = 10;       // q/a = 1 ... 10
using Forces = std::array<double, steps>;

// --- what a scheme is: a mesh for every n, and how the equations are taken

struct Elements {
    Topology topology;
    std::variant<Collocation, Galerkin> scheme;
    double order = 0;  // of the extrapolation from n/2 and n; 0: none
};

const std::vector<std::pair<std::string, Elements>>& element_schemes() {
    constexpr Collocation halves{.alpha_L = 0.5, .alpha_T = 0.5};
    static const std::vector<std::pair<std::string, Elements>> all{
        {"uniform-0.5/0.5", {Topology::uniform, halves}},
        {"uniform-0/0.63", {Topology::uniform, Collocation{}}},
        {"geometric", {Topology::geometric, halves}},
        {"knothe", {Topology::knothe, halves}},
        {"cosine", {Topology::cosine, halves}},
        {"galerkin-uniform", {Topology::uniform, Galerkin{}}},
        {"galerkin-cosine", {Topology::cosine, Galerkin{.alpha_L = 0.5, .alpha_T = 0.5}}},
        {"richardson-uniform", {Topology::uniform, halves, 1}},
        {"richardson-cosine", {Topology::cosine, halves, 2}}};
    return all;
}

std::optional<Elements> elements(const std::string& name) {
    for (const auto& [known, elements] : element_schemes()) {
        if (name == known) return elements;
    }
    return std::nullopt;
}

Mesh<double> make_mesh(const Scene& scene, Topology topology, long n) {
    const bool by_ratio = rollbem::info(topology).grading == rollbem::Grading::size_ratio;
    return rollbem::make_mesh({topology, n, by_ratio ? scene.size_ratio : scene.epsilon});
}

// --- the problems on one mesh

template <class Function>
auto with_kernel(const Scene& scene, const Function& function) {
    return scene.plane ? function(rollbem::PlaneKernel<double>::longitudinal(scene.contact))
                       : function(rollbem::StripKernel<double>::longitudinal(scene.contact));
}

MatrixX<double> slopes(const Scene& scene, const Elements& elements, const Mesh<double>& mesh) {
    const auto assembled = [&](const auto& scheme) {
        return with_kernel(scene, [&](const auto& kernel) { return rollbem::assemble_G_prime(mesh, scheme, kernel); });
    };
    return std::visit(assembled, elements.scheme);
}

RollingSystem<double> system_of(const Scene& scene, const Elements& elements, const Mesh<double>& mesh) {
    const auto assembled = [&](const auto& scheme) {
        return with_kernel(scene, [&](const auto& kernel) -> RollingSystem<double> {
            return rollbem::rolling_system(mesh, scheme, kernel);
        });
    };
    return std::visit(assembled, elements.scheme);
}

RollingSystem<double> system_of(const Scene& scene, const Chebyshev& method) {
    return with_kernel(
        scene, [&](const auto& kernel) -> RollingSystem<double> { return rollbem::rolling_system(method, kernel); });
}

rollbem::UnitSteadySolution<double> steady(const Scene& scene, const Elements& elements, const Mesh<double>& mesh) {
    return rollbem::solve_steady<double>(slopes(scene, elements, mesh), mesh.widths());
}

double steady_c11(const Scene& scene, const Elements& elements, const Mesh<double>& mesh) {
    const rollbem::UnitSteadySolution<double> solution = steady(scene, elements, mesh);
    return solution.status == rollbem::Status::ok ? solution.c11 : nan;
}

Complex harmonic_c11(const RollingSystem<double>& system, double z) {
    const rollbem::HarmonicSolution<double> solution = rollbem::solve_harmonic<double>(system, z);
    return solution.status == rollbem::Status::ok ? solution.c11 : Complex(nan, nan);
}

// -F/(a G xi) at q/a = 1, 2, ... after a step of creepage, exact in time
Forces step_forces(const Scene& scene, RollingSystem<double> system) {
    const rollbem::TransientModel<double> model(scene.contact, std::move(system), rollbem::unchecked,
                                                rollbem::Integrator::matrix_exponential);
    const rollbem::PreparedStep<double> prepared = model.prepare(1);
    rollbem::TransientState<double> state = model.at_rest(), next = state;
    Forces forces{};
    for (double& force : forces) {
        force = -model.advance(state, prepared, 1.0, next).force_per_width;
        std::swap(state, next);
    }
    return forces;
}

// -F/(mu N) at the creepage ratio
double friction_force(const Scene& scene, const Elements& elements, const Mesh<double>& mesh) {
    const rollbem::CoulombFriction<double> friction{1, peak * rollbem::mean_hertz_pressure(mesh)};
    const rollbem::SteadyFrictionModel<double> model(scene.contact, slopes(scene, elements, mesh), mesh.widths(),
                                                     friction);
    const rollbem::FrictionState<double> rest = model.at_rest();
    rollbem::FrictionState<double> state = rest;
    rollbem::FrictionWorkspace<double> workspace = model.workspace();
    const rollbem::FrictionStep<double> point =
        model.solve(rest, 2 * (1 - scene.contact.poisson_ratio()) * peak * creepage_ratio, state, workspace);
    return point.status == rollbem::StepStatus::ok ? -point.force_per_width / (peak * std::numbers::pi / 2) : nan;
}

// value(mesh), extrapolated from two meshes where the scheme says so
template <class Value>
auto evaluate(const Scene& scene, const Elements& elements, long n, const Value& value) {
    const auto fine = value(make_mesh(scene, elements.topology, n));
    if (elements.order == 0) return fine;
    return rollbem::richardson(value(make_mesh(scene, elements.topology, n / 2)), fine, elements.order);
}

Forces all_step_forces(const Scene& scene, const Elements& elements, long n) {
    const auto forces_at = [&](long count) {
        return step_forces(scene, system_of(scene, elements, make_mesh(scene, elements.topology, count)));
    };
    Forces forces = forces_at(n);
    if (elements.order == 0) return forces;
    const Forces coarse = forces_at(n / 2);
    for (std::size_t k = 0; k < steps; ++k) forces[k] = rollbem::richardson(coarse[k], forces[k], elements.order);
    return forces;
}

// Tractions of the elements of a mesh; extrapolated ones are those of the pairs that make up the coarser mesh.
struct Tractions {
    Mesh<double> mesh;
    ArrayX<double> values;
};

Tractions tractions(const Scene& scene, const Elements& elements, long n) {
    Mesh<double> mesh = make_mesh(scene, elements.topology, n);
    ArrayX<double> values = steady(scene, elements, mesh).traction.array();
    if (elements.order == 0) return {std::move(mesh), std::move(values)};
    Mesh<double> pairs = make_mesh(scene, elements.topology, n / 2);
    ArrayX<double> coarse = steady(scene, elements, pairs).traction.array();
    for (Eigen::Index i = 0; i < coarse.size(); ++i) {
        const double force = (values.segment(2 * i, 2) * mesh.widths().segment(2 * i, 2)).sum();
        coarse[i] = rollbem::richardson(coarse[i], force / pairs.widths()[i], elements.order);
    }
    return {std::move(pairs), std::move(coarse)};
}

// --- states in place of elements

rollbem::ChebyshevSteadySolution<double> steady(const Scene& scene, const Chebyshev& method) {
    return with_kernel(scene, [&](const auto& kernel) { return solve_steady(method, kernel); });
}

// --- norms and the polynomial approach

// The norm of tractions that are constant on each element: the root of the integral of p^2 sqrt(1 - x^2).
double weighted_norm(const Mesh<double>& mesh, const ArrayX<double>& traction) {
    return std::sqrt((traction.square() * mesh.widths() * rollbem::mean_hertz_pressure(mesh)).sum());
}

// The same norm for functions of x/a: with x = cos(theta) the integral of (p sin(theta))^2, by the midpoint rule.
template <class Traction>
double traction_error(double poisson_ratio, const Traction& traction) {
    constexpr int points = 64;
    double error = 0, size = 0;
    for (int k = 0; k < points; ++k) {
        const double x = std::cos((k + 0.5) * std::numbers::pi / points);
        const double exact = rollbem::carter_traction(x, poisson_ratio);
        error += std::norm(traction(x) - exact) * (1 - x * x);
        size += exact * exact * (1 - x * x);
    }
    return std::sqrt(error / size);
}

Forces inverted_forces(const std::function<std::complex<long double>(std::complex<long double>)>& c11) {
    Forces forces{};
    for (std::size_t k = 0; k < steps; ++k) {
        forces[k] = rollbem::reference::invert_laplace([&](std::complex<long double> s) { return c11(s) / s; },
                                                       static_cast<double>(k + 1));
    }
    return forces;
}

Forces polynomial_forces(double poisson_ratio, double aspect, long order) {
    return inverted_forces([=](std::complex<long double> s) {
        return rollbem::polynomial_c11<long double>(s, poisson_ratio, aspect, order).c11;
    });
}

Forces closed_form_forces(double poisson_ratio, double aspect) {
    Forces forces{};
    for (std::size_t k = 0; k < steps; ++k) {
        forces[k] = rollbem::reference::step_response_de_hoog(static_cast<double>(k + 1), poisson_ratio, aspect);
    }
    return forces;
}

template <class Exact>
double largest_difference(const Forces& forces, const Exact& exact) {
    double largest = 0;
    for (std::size_t k = 0; k < steps; ++k) {
        const double difference = std::abs(forces[k] / exact[k] - 1);
        if (std::isnan(difference)) return nan;
        largest = std::max(largest, difference);
    }
    return largest;
}

// b/a for the closed forms; steady results of the plane model do not depend on it
double finite_aspect(const Scene& scene) {
    return std::isfinite(scene.contact.aspect()) ? scene.contact.aspect() : 1000;
}

std::optional<double> if_finite(double value) { return std::isfinite(value) ? std::optional(value) : std::nullopt; }

Complex exact_c11(const Scene& scene, const Quantity& quantity) {
    return rollbem::reference::harmonic_c11(quantity.frequency, scene.contact.poisson_ratio(), finite_aspect(scene));
}

double element_error(const Scene& scene, const Elements& elements, long n, const Quantity& quantity) {
    const double nu = scene.contact.poisson_ratio();
    switch (quantity.problem) {
        case Problem::steady: {
            if (quantity.name == "traction") {
                const Tractions found = tractions(scene, elements, n);
                const ArrayX<double> exact = rollbem::carter_mean_tractions(found.mesh, nu);
                return weighted_norm(found.mesh, found.values - exact) / weighted_norm(found.mesh, exact);
            }
            const auto c11 = [&](const Mesh<double>& mesh) { return steady_c11(scene, elements, mesh); };
            return evaluate(scene, elements, n, c11) / rollbem::steady_c11(nu) - 1;
        }
        case Problem::harmonic: {
            const auto c11 = [&](const Mesh<double>& mesh) {
                return harmonic_c11(system_of(scene, elements, mesh), quantity.frequency);
            };
            return std::abs(evaluate(scene, elements, n, c11) / exact_c11(scene, quantity) - 1.0);
        }
        case Problem::step: return largest_difference(all_step_forces(scene, elements, n), scene.step_forces);
        default: break;
    }
    const auto force = [&](const Mesh<double>& mesh) { return friction_force(scene, elements, mesh); };
    return evaluate(scene, elements, n, force) / rollbem::carter_force_ratio(creepage_ratio) - 1;
}

double states_error(const Scene& scene, const Chebyshev& method, const Quantity& quantity) {
    const double nu = scene.contact.poisson_ratio();
    if (quantity.problem == Problem::step) {
        return largest_difference(step_forces(scene, system_of(scene, method)), scene.step_forces);
    }
    if (quantity.problem == Problem::harmonic) {
        return std::abs(harmonic_c11(system_of(scene, method), quantity.frequency) / exact_c11(scene, quantity) - 1.0);
    }
    const rollbem::ChebyshevSteadySolution<double> solution = steady(scene, method);
    if (solution.status != rollbem::Status::ok) return nan;
    return quantity.name == "traction" ? traction_error(nu, solution.traction)
                                       : solution.c11 / rollbem::steady_c11(nu) - 1;
}

double run_states(const Scene& scene, const Chebyshev& method, const Quantity& quantity) {
    if (quantity.problem == Problem::step) return step_forces(scene, system_of(scene, method))[0];
    if (quantity.problem == Problem::harmonic) {
        return harmonic_c11(system_of(scene, method), quantity.frequency).real();
    }
    const rollbem::ChebyshevSteadySolution<double> solution = steady(scene, method);
    return quantity.name == "traction" ? solution.traction(0.5) : solution.c11;
}

}  // namespace

const std::vector<Quantity>& quantities() {
    static const std::vector<Quantity> all{{"c11", Problem::steady},
                                           {"traction", Problem::steady},
                                           {"c11_z0.1", Problem::harmonic, 0.1},
                                           {"c11_z1", Problem::harmonic, 1},
                                           {"c11_z5", Problem::harmonic, 5},
                                           {"step_force", Problem::step},
                                           {"friction_force", Problem::friction}};
    return all;
}

std::vector<double> exact_step_forces(const Contact<double>& contact) {
    const rollbem::reference::StepResponse response(contact.poisson_ratio(), contact.aspect());
    std::vector<double> forces;
    for (std::size_t k = 0; k < steps; ++k) forces.push_back(response.step(static_cast<double>(k + 1)));
    return forces;
}

const std::vector<std::string>& scheme_names() {
    static const std::vector<std::string> all = [] {
        std::vector<std::string> names;
        for (const auto& [name, elements] : element_schemes()) names.push_back(name);
        names.insert(names.end(), {"chebyshev-states", "polynomial", "closed-form"});
        return names;
    }();
    return all;
}

Case::Case(const Scene& scene, std::string scheme, long n) : scene_(scene), scheme_(std::move(scheme)), n_(n) {}

bool Case::exists(const std::string& scheme, long n) {
    if (scheme == "closed-form") return n == 0;
    if (scheme == "chebyshev-states") return n >= 1 && n <= 10000;
    if (scheme == "polynomial") return n >= 1;
    const Elements found = *elements(scheme);
    const long least = std::max(2l, long(rollbem::info(found.topology).least_n));
    return found.order > 0 ? n % 2 == 0 && n / 2 >= least : n >= least;
}

bool Case::has(const std::string& scheme, const Quantity& quantity) {
    const bool in_adhesion = scheme == "chebyshev-states" || scheme == "polynomial";
    return !in_adhesion || quantity.problem != Problem::friction;
}

std::optional<double> Case::relative_error(const Quantity& quantity) const {
    if (const auto found = elements(scheme_)) return if_finite(element_error(scene_, *found, n_, quantity));
    if (scheme_ == "chebyshev-states") return if_finite(states_error(scene_, Chebyshev{n_}, quantity));
    const double nu = scene_.contact.poisson_ratio(), aspect = finite_aspect(scene_);
    const Complex s(0, quantity.frequency);
    if (scheme_ == "closed-form") {  // against a second route to the same number, where there is one
        if (quantity.problem == Problem::step) {
            return if_finite(largest_difference(closed_form_forces(nu, aspect), scene_.step_forces));
        }
        if (quantity.problem != Problem::harmonic) return 0;
        const Complex other = rollbem::polynomial_c11(s, nu, aspect).c11;
        return if_finite(std::abs(exact_c11(scene_, quantity) / other - 1.0));
    }
    if (quantity.name == "traction") {
        const auto solution = rollbem::solve_chebyshev(Complex(0), nu, aspect, n_);
        return if_finite(traction_error(nu, [&](double x) { return solution.traction(x); }));
    }
    if (quantity.problem == Problem::step) {
        return if_finite(largest_difference(polynomial_forces(nu, aspect, n_), scene_.step_forces));
    }
    const Complex c11 = rollbem::polynomial_c11(s, nu, aspect, n_).c11;
    if (quantity.problem == Problem::steady) return if_finite(c11.real() / rollbem::steady_c11(nu) - 1);
    return if_finite(std::abs(c11 / exact_c11(scene_, quantity) - 1.0));
}

double Case::run(const Quantity& quantity) const {
    const double nu = scene_.contact.poisson_ratio(), aspect = finite_aspect(scene_);
    const Complex s(0, quantity.frequency);
    if (const auto found = elements(scheme_)) {
        if (quantity.name == "traction") return tractions(scene_, *found, n_).values[0];
        switch (quantity.problem) {
            case Problem::steady:
                return evaluate(scene_, *found, n_, [&](const auto& mesh) { return steady_c11(scene_, *found, mesh); });
            case Problem::harmonic:
                return evaluate(scene_, *found, n_,
                                [&](const auto& mesh) {
                                    return harmonic_c11(system_of(scene_, *found, mesh), quantity.frequency);
                                })
                    .real();
            case Problem::step: return all_step_forces(scene_, *found, n_)[0];
            default: break;
        }
        return evaluate(scene_, *found, n_, [&](const auto& mesh) { return friction_force(scene_, *found, mesh); });
    }
    if (scheme_ == "chebyshev-states") return run_states(scene_, Chebyshev{n_}, quantity);
    const bool closed = scheme_ == "closed-form";
    switch (quantity.problem) {
        case Problem::step: return closed ? closed_form_forces(nu, aspect)[0] : polynomial_forces(nu, aspect, n_)[0];
        case Problem::friction: return rollbem::carter_force_ratio(creepage_ratio);
        case Problem::harmonic:
            return closed ? rollbem::reference::harmonic_c11(quantity.frequency, nu, aspect).real()
                          : rollbem::polynomial_c11(s, nu, aspect, n_).c11.real();
        default: break;
    }
    if (quantity.name == "traction") {
        return closed ? rollbem::carter_traction(0.5, nu)
                      : rollbem::solve_chebyshev(s, nu, aspect, n_).traction(0.5).real();
    }
    return closed ? rollbem::steady_c11(nu) : rollbem::polynomial_c11(s, nu, aspect, n_).c11.real();
}

std::optional<bool> Case::stable() const {
    const double aspect = scene_.contact.aspect();
    if (!std::isfinite(aspect)) return std::nullopt;
    const bool plane_decays = study::plane_model_decays(scene_.contact);
    const auto found = elements(scheme_);
    const bool states = scheme_ == "chebyshev-states";
    if (!found && !states) return plane_decays;  // of the model itself
    if (scene_.plane && !plane_decays) return std::nullopt;
    for (const long n : found && found->order > 0 ? std::vector{n_ / 2, n_} : std::vector{n_}) {
        const auto count =
            rollbem::count_unstable<double>(states ? system_of(scene_, Chebyshev{n})
                                                   : system_of(scene_, *found, make_mesh(scene_, found->topology, n)));
        if (count.status != rollbem::Status::ok) return std::nullopt;
        if (count.unstable_count > 0) return false;
    }
    return true;
}

double model_error(const Scene& scene, const Quantity& quantity) {
    if (scene.plane) return 0;
    const Elements cosine = *elements("cosine");
    const Mesh<double> mesh = rollbem::cosine_mesh(60);
    Scene plane = scene;
    plane.plane = true;
    switch (quantity.problem) {
        case Problem::harmonic:
            return std::abs(harmonic_c11(system_of(scene, cosine, mesh), quantity.frequency) /
                                harmonic_c11(system_of(plane, cosine, mesh), quantity.frequency) -
                            1.0);
        case Problem::step:
            return largest_difference(step_forces(scene, system_of(scene, cosine, mesh)),
                                      step_forces(plane, system_of(plane, cosine, mesh)));
        case Problem::friction: return friction_force(scene, cosine, mesh) / friction_force(plane, cosine, mesh) - 1;
        default: break;
    }
    const ArrayX<double> own = steady(scene, cosine, mesh).traction, other = steady(plane, cosine, mesh).traction;
    if (quantity.name == "traction") return weighted_norm(mesh, own - other) / weighted_norm(mesh, other);
    return (own * mesh.widths()).sum() / (other * mesh.widths()).sum() - 1;
}

}  // namespace precision
