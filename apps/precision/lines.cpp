// Schemes of a line contact as precision_study compares them: quantities, references, and what is computed.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/adhesion/transient.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/load.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/rolling/run.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/spectral/polynomial.hpp>
#include <rollbem/steady/steady.hpp>

#include "comparison.hpp"
#include "support/non_steady.hpp"
#include "support/scenes.hpp"

namespace precision {

namespace {

using rollbem::Contact;
using rollbem::LineModel;
using rollbem::Mesh;
using rollbem::Status;
using rollbem::Topology;
using study::NamedScheme, study::Scene;
using Array = rollbem::ArrayX<double>;
using Complex = std::complex<double>;
using Kernel = rollbem::AnyKernel<double>;

constexpr double peak = 1e-3;           // mu p0 / G
constexpr double load_amplitude = 0.5;  // N = N_0 (1 + A sin(2 pi q/L))
constexpr double load_length = 8;       // L/a_0
constexpr int load_steps = 160;         // in a period

/// How the load that varies is computed.
struct Settings {
    int load_parts = 1;       ///< of each step
    bool may_breathe = true;  ///< whether a mesh may follow that load
};

/// Places that are computed on one mesh.
using Some = std::span<const Place>;

double creepage(const Scene& scene, const Place& place) {
    return 2 * (1 - scene.contact.poisson_ratio()) * peak * place["creepage_ratio"];
}

/// mu N of Hertz's pressure.
double full(const Scene& scene) { return peak * std::numbers::pi / 2 * scene.contact.width(); }

rollbem::ElementSystem<double> slopes(const Scene& scene, const Kernel& kernel) {
    return steady_system(*scene.mesh, scene.scheme, kernel);
}

rollbem::Friction friction(const Scene& scene) { return {1, peak * rollbem::mean_hertz_pressure(*scene.mesh)}; }

/// The solution of steady rolling on one mesh or by states.
rollbem::Response<double> steady(const Scene& scene) {
    if (scene.chebyshev) return solve_steady(*scene.chebyshev, scene.kernel);
    return rollbem::solve_steady<double>(rollbem::assemble_G_prime(*scene.mesh, scene.scheme, scene.kernel),
                                         rollbem::unknown_widths(*scene.mesh, scene.scheme));
}

// --- the values of a quantity at some places; not a number if the status is not ok

/// function(q) at each q = q_over_a.
template <class Function>
Values over_distance(Some places, const Function& function) {
    Values values;
    for (const Place& place : places) values.emplace_back(function(place["q_over_a"]));
    return values;
}

/// -F/(a G xi) after a step of creepage, exact in the time domain, at places that are equally far apart.
Values step_forces(const Scene& scene, Some places) {
    const rollbem::AdhesionModel<> model(scene.contact, study::system_of(scene), rollbem::unchecked,
                                         rollbem::Integrator::matrix_exponential);
    rollbem::Run contact(model);
    const double dq = places[1]["q_over_a"] - places[0]["q_over_a"];
    long rolled = 0;
    double force = nan;
    return over_distance(places, [&](double q) {
        for (; rolled < std::lround(q / dq); ++rolled) force = -contact.advance({dq, 1.0}).force_per_width;
        return force;
    });
}

/// c11 under harmonic creepage.
Values responses(const Scene& scene, Some places) {
    const auto system = study::system_of(scene);
    Values values;
    for (const Place& place : places) {
        const auto response = rollbem::solve_response<double>(system, {0, place["omega"]});
        values.push_back(response.status == Status::ok ? response.c11() : Complex(nan, nan));
    }
    return values;
}

/// -F/(mu N) at creepage ratios.
Values friction_forces(const Scene& scene, Some places) {
    const rollbem::FrictionModel model(scene.contact, slopes(scene, scene.kernel), friction(scene));
    rollbem::Run contact(model);
    Values forces;
    for (const Place& place : places) {
        const auto step = contact.steady({.motion = rollbem::Creepage{creepage(scene, place)}});
        forces.emplace_back(step.status == Status::ok ? -step.force.longitudinal / full(scene) : nan);
    }
    return forces;
}

/// The forces along and across with creepages at an angle to the rolling direction.
Values combined_forces(const Scene& scene, Some places) {
    // the model is made from kernels, as only then it knows where the equations hold and turns the slip
    const rollbem::FrictionModel model(
        scene.contact,
        {slopes(scene, scene.kernel), slopes(scene, Kernel::lateral(scene.kernel.model(), scene.contact))},
        friction(scene));
    rollbem::Run contact(model);
    Values forces;
    for (const Place& place : places) {
        const double xi = creepage(scene, place), angle = place["angle"] * std::numbers::pi / 180;
        const auto step = contact.steady({.motion = {xi * std::cos(angle), xi * std::sin(angle)}});
        const double unit = step.status == Status::ok ? full(scene) : nan;
        forces.insert(forces.end(), {-step.force.longitudinal / unit, -step.force.lateral / unit});
    }
    return forces;
}

/// Whether a mesh follows the half-length if the load varies: a uniform mesh gains nothing from edges that move with
/// the contact's edges, and only equations that hold at points, with the plane kernel, can change the half-length.
bool breathes(const Scene& scene, const Settings& settings) {
    return settings.may_breathe && scene.topology() != Topology::uniform && scene.is_plane() &&
           scene.method != "galerkin" && scene.lambda.value_or(1) == 1;
}

/// -F/(mu N_0) after each of 160 steps in a period of the load.
Values load_forces(const Scene& scene, const Settings& settings, const Place& place) {
    const auto line = rollbem::HertzLine::dimensionless(peak);  // a_0 = 1 and p_0 = mu p_0 = peak under N_0
    const bool follows = breathes(scene, settings);
    const double half_length = follows ? 1 : std::sqrt(1 + load_amplitude);
    const auto hertz = follows ? rollbem::HertzLine::Load::breathing(line, *scene.mesh)
                               : rollbem::HertzLine::Load::fixed(line, *scene.mesh, half_length);
    const Contact covered({.half_length = half_length,
                           .half_width = scene.contact.half_width(),
                           .shear_modulus = 1,
                           .poisson_ratio = scene.contact.poisson_ratio()});
    const auto load_at = [&](double q) {
        return line.load_per_width() * (1 + load_amplitude * std::sin(2 * std::numbers::pi * q / load_length));
    };
    rollbem::NormalLoad load = hertz.at(load_at(load_length / 4));
    const auto system = rolling_system(*scene.mesh, scene.scheme, Kernel::longitudinal(scene.kernel.model(), covered));
    const rollbem::FrictionModel model(covered, system, rollbem::unchecked, {1, load.normal_pressure});
    const rollbem::Creepage xi{creepage(scene, place)};
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
        if (k % settings.load_parts == 0) forces.push_back(status == Status::ok ? -step.force.longitudinal / all : nan);
    }
    return forces;
}

/// Tractions times the root of their weight in the norm that the study's help defines, with Carter's.
Found weighted(const Array& tractions, const Array& carter, const Array& weights) {
    const auto scaled = [&](const Array& of) {
        const Array all = of * weights.sqrt();
        return Values(all.begin(), all.end());
    };
    return {scaled(tractions), scaled(carter)};
}

/// The tractions by a function of x/a, weighted for the integral of (p sin(theta))^2, x = cos(theta), by the midpoint
/// rule.
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

/// The tractions on one mesh, or extrapolated from two meshes to the elements of the coarser one, which are pairs of
/// elements of the finer. They are constant on each element and compared with Carter's means by the integral of
/// p^2 sqrt(1 - x^2).
Found tractions(const Scene& scene) {
    const double nu = scene.contact.poisson_ratio();
    if (scene.chebyshev) {
        const auto states = steady(scene);
        if (states.status != Status::ok) return {{nan}, {1}};
        return at_points(nu, rollbem::Chebyshev::Traction<double>{states.unknowns.col(0)});
    }
    const auto of = [](const Scene& one) {  // Knothe and Gross-Thebing's leading element carries none
        const Array found = steady(one).unknowns.col(0);
        Array all = Array::Zero(one.mesh->size());
        all.head(found.size()) = found;
        return all;
    };
    const std::vector<Scene> meshes = scene.meshes();
    Array found = of(meshes.front());
    if (scene.coarse) found = study::extrapolate_tractions(scene, found, of(meshes.back()));
    const Mesh<double>& mesh = scene.coarse ? *scene.coarse : *scene.mesh;
    return weighted(found, rollbem::carter_mean_tractions(mesh, nu),
                    mesh.widths() * rollbem::mean_hertz_pressure(mesh));
}

bool is_traction(const Quantity& quantity) { return quantity.name == "traction"; }

/// The values of a quantity other than the traction on one mesh, or by states.
Values values(const Scene& scene, const Settings& settings, Problem problem, Some places) {
    switch (problem) {
        case Problem::harmonic: return responses(scene, places);
        case Problem::transient: return step_forces(scene, places);
        case Problem::friction: return friction_forces(scene, places);
        case Problem::combined_friction: return combined_forces(scene, places);
        case Problem::varying_load: {
            Found all;
            for (const Place& place : places) all.add({load_forces(scene, settings, place)});
            return all.values;
        }
        default: break;
    }
    const rollbem::Response<double> response = steady(scene);
    return {response.status == Status::ok ? response.c11() : nan};
}

/// The values of a quantity by a polynomial of the order `degree`. Steady results of the plane do not depend on the
/// aspect.
Found by_polynomial(const Contact& contact, Eigen::Index degree, const Quantity& quantity, Some places) {
    const double nu = contact.poisson_ratio(), aspect = std::isfinite(contact.aspect()) ? contact.aspect() : 1000;
    if (is_traction(quantity)) {
        const auto solution = rollbem::solve_polynomial(Complex(0), nu, aspect, degree);
        return at_points(nu, [&](double x) { return solution.traction(x); });
    }
    if (quantity.problem == Problem::transient) {
        const auto transform = [&](std::complex<long double> s) {
            return rollbem::polynomial_c11<long double>(s, nu, aspect, degree).c11 / s;
        };
        return {over_distance(places, [&](double q) { return rollbem::reference::invert_laplace(transform, q); })};
    }
    Found found;
    for (const Place& place : places) {
        const double omega = quantity.problem == Problem::harmonic ? place["omega"] : 0;
        found.add({{rollbem::polynomial_c11(Complex(0, omega), nu, aspect, degree).c11}});
    }
    return found;
}

Found evaluate(const Scene& scene, const Settings& settings, const Quantity& quantity, Some places);

/// The exact values of a quantity in the plane model, by closed forms where there are any, none of which depends on an
/// infinite aspect. Forces in both directions are those of 640 elements, which cannot be extrapolated, as the border of
/// stick jumps from element to element. A load that varies moves the border all the time: its forces are extrapolated
/// from cosine meshes of 160 and 320 elements that breathe, in steps of a quarter of the schemes' steps.
Values reference(const Contact& contact, const Quantity& quantity, Some places) {
    const double nu = contact.poisson_ratio();
    const auto by = [&](const char* scheme, long n) {
        const Scene fine = study::make_scene(study::scheme_named(scheme), n, contact, LineModel::plane);
        return evaluate(fine, {.load_parts = 4}, quantity, places).values;
    };
    Values exact;
    switch (quantity.problem) {
        case Problem::harmonic:
            for (const Place& place : places)
                exact.push_back(rollbem::reference::plane_c11({0, place["omega"]}, nu, contact.aspect()));
            return exact;
        case Problem::transient: {
            const rollbem::reference::StepResponse response(nu, contact.aspect());
            return over_distance(places, [&](double q) { return response.step(q); });
        }
        case Problem::friction:
            for (const Place& place : places) exact.emplace_back(rollbem::carter_force_ratio(place["creepage_ratio"]));
            return exact;
        case Problem::combined_friction: return by("cosine:nodes-chebyshev", 640);
        case Problem::varying_load: return by("richardson:cosine:collocation:0.5/0.5", 320);
        default: return {rollbem::steady_c11(nu)};
    }
}

Found in_closed_form(const Contact& contact, const Quantity& quantity, Some places) {
    const double nu = contact.poisson_ratio(), aspect = contact.aspect();
    if (quantity.problem != Problem::transient) return {reference(contact, quantity, places)};
    return {over_distance(places, [&](double q) { return rollbem::reference::step_response_de_hoog(q, nu, aspect); })};
}

/// Exact values to compare closed forms with where these are the reference themselves.
Values second_closed_form(const Contact& contact, const Quantity& quantity) {
    Values exact;
    if (quantity.problem != Problem::harmonic) return exact;
    for (const Place& place : quantity.places) {
        const auto order = rollbem::default_polynomial_order(Complex(0, place["omega"]));
        exact.push_back(by_polynomial(contact, order, quantity, {&place, 1}).values[0]);
    }
    return exact;
}

Found evaluate(const Scene& scene, const Settings& settings, const Quantity& quantity, Some places) {
    if (scene.degree > 0) return by_polynomial(scene.contact, scene.degree, quantity, places);
    if (!scene.is_discrete()) return in_closed_form(scene.contact, quantity, places);
    if (is_traction(quantity)) return tractions(scene);
    const std::vector<Scene> meshes = scene.meshes();
    const Found found{values(meshes.front(), settings, quantity.problem, places)};
    if (!scene.coarse) return found;
    return extrapolate({values(meshes.back(), settings, quantity.problem, places)}, found, scene.order());
}

/// The relative difference that the strip makes to the plane limit: the model's error, on one mesh.
double model_error(const Contact& contact, const Quantity& quantity) {
    const auto on = [&](LineModel model) {
        const auto scene = study::make_scene(study::scheme_named("cosine:collocation:0.5/0.5"), 60, contact, model);
        return evaluate(scene, {.may_breathe = false}, quantity, quantity.places);
    };
    const Found strip = on(LineModel::strip), plane = on(LineModel::plane);
    return worst(quantity, strip.values, plane.values).first;
}

Status status_of(const Scene& scene) {
    Status status = Status::not_finite;
    if (!scene.is_discrete()) return status;
    for (const Scene& one : scene.meshes()) {
        const Status own = steady(one).status;
        if (own != Status::ok) status = own;
    }
    return status;
}

std::optional<bool> stable(const Scene& scene) {
    if (!std::isfinite(scene.contact.aspect())) return std::nullopt;
    const bool plane_decays = study::plane_model_decays(scene.contact);
    if (!scene.is_discrete()) return plane_decays;  // the model's own mode
    if (scene.is_plane() && !plane_decays) return std::nullopt;
    for (const Scene& one : scene.meshes()) {
        const auto count = rollbem::count_unstable(study::system_of(one));
        if (count.status != Status::ok) return std::nullopt;
        if (count.unstable_count > 0) return false;
    }
    return true;
}

// --- the command line

/// The one contact of a study and its model: times and the front compare schemes on one problem. Throws BadInput if
/// the options name several contacts.
std::pair<Contact, LineModel> read_contact(const study::Options& options, const std::vector<NamedScheme>& schemes,
                                           const std::vector<Quantity>& quantities) {
    for (const char* name : {"kernel", "aspect", "poisson"}) {
        options.require(options.said(name).find(',') == std::string::npos, name,
                        "be a single value: schemes are compared for one contact; run the study once for each value");
    }
    const auto asked = [&](const auto& is) { return std::any_of(quantities.begin(), quantities.end(), is); };
    const auto solve = [&](Problem problem) { return asked([=](const Quantity& q) { return q.problem == problem; }); };
    if (!asked([](const Quantity& q) { return q.name == "response"; }))
        options.ignored("omega", "without the quantity response");
    if (!solve(Problem::transient)) options.ignored("dq", "without the quantity transient");
    if (!solve(Problem::combined_friction)) options.ignored("angle", "without the quantity combined_force");
    if (!asked([](const Quantity& q) { return q.problem >= Problem::friction; }))
        options.ignored("creepage-ratio", "without a quantity with friction");
    const bool steady = !solve(Problem::harmonic) && !solve(Problem::transient) && !solve(Problem::varying_load);
    const Contact contact =
        study::make_contacts(options, steady ? study::Problem::steady : study::Problem::non_steady).front();
    if (!steady) study::require_plane_model(contact);
    // the strip of infinite width is the plane
    const bool plane = options.choice("kernel", {"strip", "plane"}) == "plane" || !std::isfinite(contact.aspect());
    const bool has_states =
        std::any_of(schemes.begin(), schemes.end(), [](const NamedScheme& s) { return s.method == "chebyshev"; });
    options.require(plane || !has_states || contact.aspect() >= 0.001, "aspect",
                    "be at least 0.001 for the scheme chebyshev");
    return {contact, plane ? LineModel::plane : LineModel::strip};
}

/// Whether a scheme has n elements or states, which are at least 1.
bool exists(const NamedScheme& scheme, long n) {
    if (!scheme.has_elements()) return scheme.method != "chebyshev" || n <= 10000;
    const long least = std::max(2l, long(rollbem::topology_info(scheme.topology()).least_n));
    return scheme.richardson ? n % 2 == 0 && n / 2 >= least : n >= least;
}

/// Whether a scheme solves the problem: Coulomb's law takes elements.
bool solves(const NamedScheme& scheme, Problem problem) {
    return scheme.has_elements() || problem < Problem::friction ||
           (scheme.method == "closed-form" && problem == Problem::friction);
}

/// Whether n is used without --n: costly problems stop at smaller n.
bool affordable(Problem problem, long n) {
    return n <= (problem == Problem::steady ? 640 : problem == Problem::harmonic ? 320 : 160);
}

/// Numbers of elements, states, or the order of the polynomial; 0 for the closed form, which has none.
std::vector<std::ptrdiff_t> read_sizes(const study::Options& options, const NamedScheme& scheme) {
    if (scheme.method == "closed-form") return {0};
    if (scheme.method == "chebyshev" && !options.given("n")) {
        return {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20, 24, 32, 48};
    }
    std::vector<std::ptrdiff_t> sizes = options.integers("n", 1, largest_n);
    std::erase_if(sizes, [&](long n) { return !exists(scheme, n); });
    return sizes;
}

/// The distances q/a of transient, equally far apart: ten steps of --dq, or those from 1 to 10, two of which lie next
/// to the kink of the exact force at q/a = 2, on either side.
std::vector<double> distances(const study::Options& options) {
    const bool given = options.given("dq");
    const double dq = given ? options.number("dq", study::positive()) : 0.07;
    std::vector<double> all;
    for (int k = given ? 1 : 15; k <= (given ? 10 : 142); ++k) all.push_back(k * dq);
    return all;
}

}  // namespace

std::vector<Quantity> line_quantities(const study::Options& options) {
    const auto complex = [](const Values& found, const Values& exact) { return std::abs(found[0] / exact[0] - 1.0); };
    // |difference| over |exact|
    const auto vector = [](const Values& found, const Values& exact) {
        double error = 0, size = 0;
        for (std::size_t k = 0; k < exact.size(); ++k) {
            error += std::norm(found[k] - exact[k]);
            size += std::norm(exact[k]);
        }
        return std::sqrt(error / size);
    };
    const auto one_or = [&](const char* option, std::vector<double> usual, const study::Rule& rule) {
        if (options.given(option)) usual = {options.number(option, rule)};
        return usual;
    };
    const auto positive = study::positive();
    const auto twenty = [](const auto& of) {  // of 0 to 1
        std::vector<double> values;
        for (int k = 0; k < 20; ++k) values.push_back(of(k / 19.0));
        return values;
    };
    const auto ratios = one_or("creepage-ratio", twenty([](double part) { return 0.05 + 0.9 * part; }), positive);
    const auto frequencies = one_or("omega", twenty([](double part) { return 0.1 * std::pow(50, part); }), positive);
    const auto angles = one_or("angle", {15, 45, 75}, study::between(0, 90));
    return {{"c11", Problem::steady, relative()},
            {"traction", Problem::steady, vector},
            {"c11_z0.1", Problem::harmonic, complex, combined({{"omega", {0.1}}})},
            {"c11_z1", Problem::harmonic, complex, combined({{"omega", {1}}})},
            {"response", Problem::harmonic, complex, combined({{"omega", frequencies}})},
            {"transient", Problem::transient, relative(), combined({{"q_over_a", distances(options)}})},
            {"friction", Problem::friction, relative(), combined({{"creepage_ratio", ratios}})},
            {"combined_force", Problem::combined_friction, vector,
             combined({{"creepage_ratio", ratios}, {"angle", angles}})},
            {"load_force", Problem::varying_load, largest_difference,
             combined({{"creepage_ratio", one_or("creepage-ratio", {0.2, 0.35, 0.55, 0.8}, positive)}})}};
}

Comparison read_line_comparison(const study::Options& options) {
    const std::vector<NamedScheme> schemes = read_schemes(options, false);
    const std::vector<Quantity> quantities = read_quantities(options, line_quantities(options));
    const auto given = read_contact(options, schemes, quantities);
    const Contact contact = given.first;
    const LineModel model = given.second;
    Comparison result{columns(), quantities};
    for (const NamedScheme& scheme : schemes) {
        for (const long n : read_sizes(options, scheme)) {
            Task task{{.scheme = scheme.word(), .n = n > 0 ? std::optional(n) : std::nullopt}};
            for (const Quantity& quantity : quantities) {
                const bool wanted = options.given("n") || affordable(quantity.problem, n);
                if (wanted && solves(scheme, quantity.problem)) task.quantities.push_back(quantity);
            }
            if (task.quantities.empty()) continue;
            const Scene scene = study::make_scene(scheme, n, contact, model);
            for (const std::string& column : settings()) task.point.setting.push_back(scene_cell(scene, column).text());
            task.compute = [=](const Quantity& quantity) {
                Found found;
                const std::size_t at_once = quantity.places.size() / quantity.runs();
                for (Some rest = quantity.places; !rest.empty(); rest = rest.subspan(at_once)) {
                    const Scene fresh = study::make_scene(scheme, n, contact, model);
                    found.add(evaluate(fresh, {}, quantity, rest.first(at_once)));
                }
                return found;
            };
            if (scheme.method == "closed-form")
                task.exact = [=](const Quantity& quantity) { return second_closed_form(contact, quantity); };
            task.status = [=](const Found&) { return status_of(scene); };
            task.stable = [=] { return stable(scene); };
            result.tasks.push_back(std::move(task));
        }
    }
    options.require(!result.tasks.empty(), "n", "fit at least one of the schemes and quantities");
    // tasks are ordered by n, as given or increasing, then in the order of the schemes; tasks without n come last
    const std::vector<std::ptrdiff_t> numbers = options.integers("n", 1, largest_n);
    const auto place = [&](const Task& task) {
        const std::optional<long> n = task.point.n;
        if (!n) return std::numeric_limits<std::ptrdiff_t>::max();
        return options.given("n") ? std::find(numbers.begin(), numbers.end(), *n) - numbers.begin() : *n;
    };
    std::stable_sort(result.tasks.begin(), result.tasks.end(),
                     [&](const Task& one, const Task& other) { return place(one) < place(other); });
    result.reference = [=](const Quantity& quantity) { return reference(contact, quantity, quantity.places); };
    result.model_error = [=](const Quantity& quantity) {
        return model == LineModel::plane ? std::nullopt : std::optional(model_error(contact, quantity));
    };
    return result;
}

}  // namespace precision
