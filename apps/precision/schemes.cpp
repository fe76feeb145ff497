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
#include <rollbem/normal/hertz_load.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/step_response.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "support/csv.hpp"
#include "support/non_steady.hpp"
#include "support/scenes.hpp"

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
constexpr double peak = 1e-3;            // mu p0 / G
constexpr double creepage_ratio = 0.5;   // delta of friction_force
constexpr std::size_t steps = 10;        // q/a = 1 ... 10
constexpr double load_amplitude = 0.5;   // of load_force, N = N_0 (1 + A sin(2 pi q/L))
constexpr double load_length = 8;        // L/a_0
constexpr std::size_t load_steps = 160;  // in a period
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
        {"uniform-0/0.63", {Topology::uniform, Collocation{.alpha_L = 0, .alpha_T = 0.63}}},
        {"geometric", {Topology::geometric, halves}},
        {"knothe", {Topology::knothe, halves}},
        {"cosine", {Topology::cosine, halves}},
        {"galerkin-uniform", {Topology::uniform, Galerkin{.alpha_L = 0, .alpha_T = 0.63}}},
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

enum class Direction { longitudinal, lateral };

template <class Kernel>
Kernel kernel_of(const Contact<double>& contact, Direction direction) {
    return direction == Direction::longitudinal ? Kernel::longitudinal(contact) : Kernel::lateral(contact);
}

template <class Function>
auto with_kernel(const Scene& scene, const Function& function, Direction direction = Direction::longitudinal) {
    return scene.plane ? function(kernel_of<rollbem::PlaneKernel<double>>(scene.contact, direction))
                       : function(kernel_of<rollbem::StripKernel<double>>(scene.contact, direction));
}

MatrixX<double> slopes(const Scene& scene, const Elements& elements, const Mesh<double>& mesh,
                       Direction direction = Direction::longitudinal) {
    const auto assembled = [&](const auto& scheme) {
        return with_kernel(
            scene, [&](const auto& kernel) { return rollbem::assemble_G_prime(mesh, scheme, kernel); }, direction);
    };
    return std::visit(assembled, elements.scheme);
}

rollbem::ElementSystem<double> system_of(const Scene& scene, const Elements& elements, const Mesh<double>& mesh) {
    const auto assembled = [&](const auto& scheme) {
        return with_kernel(scene, [&](const auto& kernel) -> rollbem::ElementSystem<double> {
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

double unit_creepage(const Scene& scene) { return 2 * (1 - scene.contact.poisson_ratio()) * peak; }

// -F/(mu N) along and across, under the creepage ratio at 45 degrees
std::vector<double> combined_force(const Scene& scene, const Elements& elements, const Mesh<double>& mesh) {
    const rollbem::SteadyCombinedModel<double> model(scene.contact, slopes(scene, elements, mesh),
                                                     slopes(scene, elements, mesh, Direction::lateral), mesh.widths(),
                                                     {1, peak * rollbem::mean_hertz_pressure(mesh)});
    const auto rest = model.at_rest();
    auto state = rest;
    auto workspace = model.workspace();
    const double part = unit_creepage(scene) * creepage_ratio / std::numbers::sqrt2;
    const auto point = model.solve(rest, {part, part}, state, workspace);
    if (point.status != rollbem::StepStatus::ok) return {nan, nan};
    const double full = peak * std::numbers::pi / 2;
    return {-point.force_per_width.longitudinal / full, -point.force_per_width.lateral / full};
}

// A mesh that breathes with the contact, or that covers the largest one: uniform meshes have no use for its edges, and
// only collocation on the plane knows other half-lengths.
enum class Cover { breathing, largest };

Cover cover_of(const Scene& scene, const Elements& elements) {
    const bool graded = elements.topology != Topology::uniform;
    return graded && scene.plane && std::holds_alternative<Collocation>(elements.scheme) ? Cover::breathing
                                                                                         : Cover::largest;
}

// -F/(mu N_0) after each of `load_steps` steps, made of `parts` steps each
std::vector<double> load_forces(Scene scene, const Elements& elements, const Mesh<double>& mesh, Cover cover,
                                std::size_t parts = 1) {
    const double full = peak * std::numbers::pi / 2;
    const double half_length = cover == Cover::largest ? std::sqrt(1 + load_amplitude) : 1;
    scene.contact = Contact<double>({.half_length = half_length,
                                     .half_width = scene.contact.half_width(),
                                     .shear_modulus = 1,
                                     .poisson_ratio = scene.contact.poisson_ratio()});
    // Hertz's contact of a_0 = 1 and p_0 = mu p_0 = peak under N_0
    const rollbem::ElasticBody<double> body{.young_modulus = 4 * peak, .poisson_ratio = 0};
    const rollbem::HertzLine<double> line(
        {.load_per_width = full, .combined_radius = 1, .body_1 = body, .body_2 = body});
    const auto hertz = cover == Cover::largest ? rollbem::HertzLoad<double>::fixed(line, mesh, half_length)
                                               : rollbem::HertzLoad<double>::breathing(line, mesh);
    const auto load_at = [&](double q) {
        return full * (1 + load_amplitude * std::sin(2 * std::numbers::pi * q / load_length));
    };
    rollbem::NormalLoad<double> load = hertz.at(load_at(load_length / 4));
    const rollbem::CoulombFriction<double> law{1, load.normal_pressure};
    const rollbem::FrictionModel<double> model(scene.contact, system_of(scene, elements, mesh), rollbem::unchecked,
                                               law);
    auto now = model.at_rest(), next = now;
    auto workspace = model.workspace();
    const double creepage = unit_creepage(scene) * creepage_ratio;
    hertz.set(load_at(0), load);
    rollbem::StepStatus status = model.steady(now, creepage, load, next, workspace).status;
    std::vector<double> forces;
    const std::size_t count = load_steps * parts;
    const double dq = load_length / static_cast<double>(count);
    for (std::size_t k = 1; k <= count; ++k) {
        std::swap(now, next);
        hertz.set(load_at(static_cast<double>(k) * dq), load);
        const auto step = model.advance(now, dq, creepage, load, next, workspace);
        if (status == rollbem::StepStatus::ok) status = step.status;
        if (k % parts == 0) forces.push_back(status == rollbem::StepStatus::ok ? -step.force_per_width / full : nan);
    }
    return forces;
}

// value(mesh), extrapolated from two meshes where the scheme says so
template <class Value>
auto evaluate(const Scene& scene, const Elements& elements, long n, const Value& value) {
    const auto fine = value(make_mesh(scene, elements.topology, n));
    if (elements.order == 0) return fine;
    return rollbem::richardson(value(make_mesh(scene, elements.topology, n / 2)), fine, elements.order);
}

// The same of several numbers.
template <class Values>
std::vector<double> evaluate_all(const Scene& scene, const Elements& elements, long n, const Values& values) {
    std::vector<double> fine = values(make_mesh(scene, elements.topology, n));
    if (elements.order == 0) return fine;
    const std::vector<double> coarse = values(make_mesh(scene, elements.topology, n / 2));
    for (std::size_t k = 0; k < fine.size(); ++k) fine[k] = rollbem::richardson(coarse[k], fine[k], elements.order);
    return fine;
}

std::vector<double> all_combined_forces(const Scene& scene, const Elements& elements, long n) {
    return evaluate_all(scene, elements, n,
                        [&](const Mesh<double>& mesh) { return combined_force(scene, elements, mesh); });
}

std::vector<double> all_load_forces(const Scene& scene, const Elements& elements, long n) {
    const Cover cover = cover_of(scene, elements);
    return evaluate_all(scene, elements, n,
                        [&](const Mesh<double>& mesh) { return load_forces(scene, elements, mesh, cover); });
}

// |difference| of two vectors over the second
double vector_error(const std::vector<double>& force, const std::vector<double>& exact) {
    return std::hypot(force[0] - exact[0], force[1] - exact[1]) / std::hypot(exact[0], exact[1]);
}

// The largest difference of two series, not of each by its own size: they are forces over mu N_0.
double series_error(const std::vector<double>& forces, const std::vector<double>& exact) {
    double largest = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        const double difference = std::abs(forces[k] - exact[k]);
        if (std::isnan(difference)) return nan;
        largest = std::max(largest, difference);
    }
    return largest;
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
    return rollbem::reference::plane_c11({0, quantity.frequency}, scene.contact.poisson_ratio(), finite_aspect(scene));
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
        case Problem::combined_friction:
            return vector_error(all_combined_forces(scene, elements, n), scene.both_forces);
        case Problem::varying_load: return series_error(all_load_forces(scene, elements, n), scene.load_forces);
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
                                           {"friction_force", Problem::friction},
                                           {"combined_force", Problem::combined_friction},
                                           {"load_force", Problem::varying_load}};
    return all;
}

std::vector<double> exact_step_forces(const Contact<double>& contact) {
    const rollbem::reference::StepResponse response(contact.poisson_ratio(), contact.aspect());
    std::vector<double> forces;
    for (std::size_t k = 0; k < steps; ++k) forces.push_back(response.step(static_cast<double>(k + 1)));
    return forces;
}

std::vector<double> combined_reference(const Contact<double>& contact) {
    const Scene scene{contact, true, 1, 1};
    Elements cosine = *elements("cosine");
    cosine.order = 1;  // of the direction of slip, which a row has half an element ahead of its traction
    return all_combined_forces(scene, cosine, 640);
}

std::vector<double> load_reference(const Contact<double>& contact) {
    const Scene scene{contact, true, 1, 1};
    const Elements cosine = *elements("richardson-cosine");
    return evaluate_all(scene, cosine, 320, [&](const Mesh<double>& mesh) {
        return load_forces(scene, cosine, mesh, Cover::breathing, 4);
    });
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
    if (scheme == "closed-form") return !has_friction(quantity.problem) || quantity.problem == Problem::friction;
    return elements(scheme) || !has_friction(quantity.problem);
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

std::string Case::status(const Quantity& quantity) const {
    using rollbem::Status;
    if (relative_error(quantity)) return name(Status::ok);
    Status status = Status::not_finite;
    if (const auto found = elements(scheme_)) {
        for (const long n : found->order > 0 ? std::vector{n_ / 2, n_} : std::vector{n_}) {
            const Status at_n = steady(scene_, *found, make_mesh(scene_, found->topology, n)).status;
            if (at_n != Status::ok) status = at_n;
        }
    } else if (scheme_ == "chebyshev-states") {
        const Status of_states = steady(scene_, Chebyshev{n_}).status;
        if (of_states != Status::ok) status = of_states;
    }
    return name(status);
}

std::vector<std::string> Case::setting() const {
    const bool strip = !scene_.plane && scheme_ != "polynomial" && scheme_ != "closed-form";
    const study::Cell aspect = study::aspect_cell(scene_.contact), none;
    const auto found = elements(scheme_);
    const auto grading = [&](rollbem::Grading kind, double value) {
        return found && rollbem::info(found->topology).grading == kind ? study::Cell(value) : none;
    };
    return {strip ? "strip" : "plane", aspect.text(), study::Cell(scene_.contact.poisson_ratio()).text(),
            grading(rollbem::Grading::size_ratio, scene_.size_ratio).text(),
            grading(rollbem::Grading::epsilon, scene_.epsilon).text()};
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
            case Problem::combined_friction: return all_combined_forces(scene_, *found, n_)[0];
            case Problem::varying_load: return all_load_forces(scene_, *found, n_)[0];
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
            return closed ? rollbem::reference::plane_c11({0, quantity.frequency}, nu, aspect).real()
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
        case Problem::combined_friction:
            return vector_error(combined_force(scene, cosine, mesh), combined_force(plane, cosine, mesh));
        case Problem::varying_load:
            return series_error(load_forces(scene, cosine, mesh, Cover::largest),
                                load_forces(plane, cosine, mesh, Cover::largest));
        default: break;
    }
    const ArrayX<double> own = steady(scene, cosine, mesh).traction, other = steady(plane, cosine, mesh).traction;
    if (quantity.name == "traction") return weighted_norm(mesh, own - other) / weighted_norm(mesh, other);
    return (own * mesh.widths()).sum() / (other * mesh.widths()).sum() - 1;
}

}  // namespace precision
