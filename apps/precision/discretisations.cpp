#include "discretisations.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <rollbem/compiled/assembly.hpp>
#include <rollbem/compiled/chebyshev.hpp>
#include <rollbem/compiled/frequency.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/compiled/transient.hpp>
#include <rollbem/elasticity/any_kernel.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/hertz_load.hpp>

namespace precision {

using rollbem::ArrayX;
using rollbem::Chebyshev;
using rollbem::Collocation;
using rollbem::Contact;
using rollbem::Galerkin;
using rollbem::MatrixX;
using rollbem::Mesh;
using rollbem::NodeDifference;
using rollbem::RollingSystem;
using rollbem::Topology;
using Complex = std::complex<double>;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double peak = 1e-3;            // mu p0 / G
constexpr double load_amplitude = 0.5;   // N = N_0 (1 + A sin(2 pi q/L))
constexpr double load_length = 8;        // L/a_0
constexpr std::size_t load_steps = 160;  // in a period

using Kernel = rollbem::AnyKernel<double>;

rollbem::LineModel model_of(const Scene& scene) {
    return scene.plane ? rollbem::LineModel::plane : rollbem::LineModel::strip;
}

Kernel kernel_of(const Scene& scene) { return Kernel::longitudinal(model_of(scene), scene.contact); }

MatrixX<double> slopes(const Scene& scene, const Elements& elements, const Mesh<double>& mesh) {
    return rollbem::assemble_G_prime(mesh, elements.scheme, kernel_of(scene));
}

double unit_creepage(const Scene& scene) { return 2 * (1 - scene.contact.poisson_ratio()) * peak; }

// A uniform mesh gains nothing from edges that move with those of the contact, and only equations that hold at points,
// with the plane kernel, can change the half-length.
Cover cover_of(const Scene& scene, const Elements& elements) {
    const bool graded = elements.topology != Topology::uniform;
    return graded && scene.plane && elements.scheme.get_if<Galerkin>() == nullptr ? Cover::breathing : Cover::largest;
}

Complex harmonic_c11(const RollingSystem<double>& system, double z) {
    const rollbem::Response<Complex> solution = rollbem::solve_response<double>(system, {0, z});
    return solution.status == rollbem::Status::ok ? solution.c11() : Complex(nan, nan);
}

Values step_forces(const Scene& scene, RollingSystem<double> system) {
    const rollbem::AdhesionModel<> model(scene.contact, std::move(system), rollbem::unchecked,
                                         rollbem::Integrator::matrix_exponential);
    rollbem::AdhesionWorkspace<> workspace = model.workspace();
    rollbem::AdhesionState<> state = model.at_rest(), next = state;
    Values forces(steps);
    for (Complex& force : forces) {
        force = -model.advance(state, 1, 1.0, next, workspace).force_per_width;
        std::swap(state, next);
    }
    return forces;
}

double friction_force(const Scene& scene, const Elements& elements, const Mesh<double>& mesh) {
    const rollbem::Friction<> friction{1, peak * rollbem::mean_hertz_pressure(mesh)};
    const rollbem::FrictionModel<> model(scene.contact, {{}, slopes(scene, elements, mesh), mesh.widths()},
                                         rollbem::unchecked, friction);
    const rollbem::FrictionState<> rest = model.at_rest();
    rollbem::FrictionState<> state = rest;
    rollbem::FrictionWorkspace<> workspace = model.workspace();
    const rollbem::FrictionStep<> point = model.steady(rest, unit_creepage(scene) * creepage_ratio, state, workspace);
    return point.status == rollbem::StepStatus::ok
               ? -point.force / (peak * std::numbers::pi / 2 * scene.contact.width())
               : nan;
}

Values combined_force(const Scene& scene, const Elements& elements, const Mesh<double>& mesh) {
    using Model = rollbem::FrictionModel<rollbem::ConstantFriction<double>, 2>;
    const rollbem::Friction<> friction{1, peak * rollbem::mean_hertz_pressure(mesh)};
    // from kernels, as only then the model knows where the equations hold and turns the slip
    const auto system = [&](const Kernel& kernel) { return steady_system(mesh, elements.scheme, kernel); };
    const Model model(scene.contact,
                      {system(kernel_of(scene)), system(Kernel::lateral(model_of(scene), scene.contact))},
                      rollbem::unchecked, friction);
    const auto rest = model.at_rest();
    auto state = rest;
    auto workspace = model.workspace();
    const double part = unit_creepage(scene) * creepage_ratio / std::numbers::sqrt2;
    const auto point = model.steady(rest, {part, part}, state, workspace);
    if (point.status != rollbem::StepStatus::ok) return {nan, nan};
    const double full = peak * std::numbers::pi / 2 * scene.contact.width();
    return {-point.force.longitudinal / full, -point.force.lateral / full};
}

}  // namespace

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
        {"richardson-cosine", {Topology::cosine, halves, 2}},
        {"nodes-uniform", {Topology::uniform, NodeDifference{}}},
        {"nodes-cosine", {Topology::cosine, NodeDifference{}}},
        {"nodes-chebyshev", {Topology::cosine, NodeDifference{rollbem::Nodes::chebyshev}}},
        {"richardson-nodes", {Topology::cosine, NodeDifference{}, 2}}};
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

rollbem::ElementSystem<double> system_of(const Scene& scene, const Elements& elements, const Mesh<double>& mesh) {
    return rollbem::rolling_system(mesh, elements.scheme, kernel_of(scene));
}

RollingSystem<double> system_of(const Scene& scene, const Chebyshev& method) {
    return rollbem::rolling_system(method, kernel_of(scene));
}

rollbem::Response<double> steady(const Scene& scene, const Elements& elements, const Mesh<double>& mesh) {
    return rollbem::solve_steady<double>(slopes(scene, elements, mesh), mesh.widths());
}

Values load_forces(Scene scene, const Elements& elements, const Mesh<double>& mesh, Cover cover, std::size_t parts) {
    const auto line = rollbem::HertzLine<double>::dimensionless(peak);  // a_0 = 1 and p_0 = mu p_0 = peak under N_0
    const double full = line.load_per_width();
    const double half_length = cover == Cover::largest ? std::sqrt(1 + load_amplitude) : 1;
    scene.contact = Contact<double>({.half_length = half_length,
                                     .half_width = scene.contact.half_width(),
                                     .shear_modulus = 1,
                                     .poisson_ratio = scene.contact.poisson_ratio()});
    const auto hertz = cover == Cover::largest ? rollbem::HertzLoad<double>::fixed(line, mesh, half_length)
                                               : rollbem::HertzLoad<double>::breathing(line, mesh);
    const auto load_at = [&](double q) {
        return full * (1 + load_amplitude * std::sin(2 * std::numbers::pi * q / load_length));
    };
    rollbem::NormalLoad<double> load = hertz.at(load_at(load_length / 4));
    const rollbem::Friction<> law{1, load.normal_pressure};
    const rollbem::FrictionModel<> model(scene.contact, system_of(scene, elements, mesh), rollbem::unchecked, law);
    auto now = model.at_rest(), next = now;
    auto workspace = model.workspace();
    const double creepage = unit_creepage(scene) * creepage_ratio, width = scene.contact.width();
    hertz.set(load_at(0), load);
    rollbem::StepStatus status = model.steady(now, creepage, load, next, workspace).status;
    Values forces;
    const std::size_t count = load_steps * parts;
    const double dq = load_length / static_cast<double>(count);
    for (std::size_t k = 1; k <= count; ++k) {
        std::swap(now, next);
        hertz.set(load_at(static_cast<double>(k) * dq), load);
        const auto step = model.advance(now, dq, creepage, load, next, workspace);
        if (status == rollbem::StepStatus::ok) status = step.status;
        if (k % parts == 0) forces.push_back(status == rollbem::StepStatus::ok ? -step.force / (full * width) : nan);
    }
    return forces;
}

rollbem::Response<double> steady(const Scene& scene, const Chebyshev& method) {
    return solve_steady(method, kernel_of(scene));
}

Values values(const Scene& scene, const Elements& elements, const Mesh<double>& mesh, Cover cover,
              const Quantity& quantity) {
    switch (quantity.problem) {
        case Problem::harmonic: return {harmonic_c11(system_of(scene, elements, mesh), quantity.frequency)};
        case Problem::step: return step_forces(scene, system_of(scene, elements, mesh));
        case Problem::friction: return {friction_force(scene, elements, mesh)};
        case Problem::combined_friction: return combined_force(scene, elements, mesh);
        case Problem::varying_load: return load_forces(scene, elements, mesh, cover);
        case Problem::steady: break;
    }
    const rollbem::Response<double> solution = steady(scene, elements, mesh);
    return {solution.status == rollbem::Status::ok ? solution.c11() : nan};
}

Values values(const Scene& scene, const Elements& elements, long n, const Quantity& quantity) {
    return extrapolated(scene, elements, n, [&](const Mesh<double>& mesh) {
        return values(scene, elements, mesh, cover_of(scene, elements), quantity);
    });
}

Values values(const Scene& scene, const Chebyshev& method, const Quantity& quantity) {
    if (quantity.problem == Problem::step) return step_forces(scene, system_of(scene, method));
    if (quantity.problem == Problem::harmonic) return {harmonic_c11(system_of(scene, method), quantity.frequency)};
    const rollbem::Response<double> solution = steady(scene, method);
    return {solution.status == rollbem::Status::ok ? solution.c11() : nan};
}

Tractions tractions(const Scene& scene, const Elements& elements, long n) {
    Mesh<double> mesh = make_mesh(scene, elements.topology, n);
    ArrayX<double> values = steady(scene, elements, mesh).unknowns.col(0);
    if (elements.order == 0) return {std::move(mesh), std::move(values)};
    Mesh<double> pairs = make_mesh(scene, elements.topology, n / 2);
    ArrayX<double> coarse = steady(scene, elements, pairs).unknowns.col(0);
    for (Eigen::Index i = 0; i < coarse.size(); ++i) {
        const double force = (values.segment(2 * i, 2) * mesh.widths().segment(2 * i, 2)).sum();
        coarse[i] = rollbem::richardson(coarse[i], force / pairs.widths()[i], elements.order);
    }
    return {std::move(pairs), std::move(coarse)};
}

}  // namespace precision
