// Creep coefficients and forces with friction of contact patches as precision_study compares them: error against time
// over n and strips.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/elasticity/patch_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/rolling/run.hpp>
#include <rollbem/steady/creep_coefficients.hpp>
#include <rollbem/steady/steady.hpp>

#include "comparison.hpp"
#include "extremes/drawn.hpp"
#include "studies/kalker_table.hpp"

namespace precision {

namespace {

constexpr long reference_n = 48;                                   // and half of it
constexpr std::ptrdiff_t most_elements = 4096, most_judged = 256;  // eigenvalues cost much more than the coefficients
constexpr std::ptrdiff_t reference_elements = 500;                 // with friction

using PatchContact = rollbem::PatchContact;
using PatchMesh = rollbem::PatchMesh<double>;
using rollbem::NodeDifference;
using rollbem::Status;
using study::NamedScheme;

/// A scheme with n elements in each strip. Without a number of strips there are as many as elements, of equal width as
/// many as recommended_strips has for an a/b that it knows.
struct Discretisation {
    NamedScheme scheme;
    long n;
    std::optional<long> strips{};

    long strips_of(double a_over_b) const {
        const bool recommended = scheme.strips == "uniform" && a_over_b >= 0.1 && a_over_b <= 25;
        return strips ? *strips : recommended ? rollbem::recommended_strips(n, a_over_b) : n;
    }
    NodeDifference equations() const { return *scheme.equations().get_if<NodeDifference>(); }
    PatchMesh mesh(const PatchContact& contact) const {
        const long count = strips_of(contact.a_over_b());
        return rollbem::patch_mesh(
            contact, rollbem::cosine_mesh(n),
            scheme.strips == "uniform" ? rollbem::uniform_mesh(count) : rollbem::cosine_mesh(count));
    }
    /// A part of the elements and strips, each of which it divides.
    Discretisation part(const PatchContact& contact, long divisor) const {
        return {scheme, n / divisor, strips_of(contact.a_over_b()) / divisor};
    }
};

Discretisation with_strips(const std::string& grading, long n, long strips) {
    return {study::scheme_named("cosine:nodes-chebyshev:" + grading + "-strips", true), n, strips};
}

/// Places of one contact.
using Some = std::span<const Place>;

PatchContact contact_of(const Place& place, double nu) { return PatchContact::dimensionless(place["a_over_b"], nu); }

/// c11, c22, c23, c33.
Found coefficients(const PatchContact& contact, const rollbem::Response<double>& steady) {
    const auto c = creep_coefficients(contact, steady);
    return {{c.c11, c.c22, c.c23, c.c33}, {}, steady.status};
}

/// -F_x and -F_y over mu N, from rest under the creepages of each place.
Found forces(const PatchContact& contact, const Discretisation& by, Some places) {
    const PatchMesh mesh = by.mesh(contact);
    const rollbem::HalfSpace<double> kernel(contact.poisson_ratio());
    const rollbem::FrictionModel model(contact, steady_system(mesh, by.equations(), kernel),
                                       {1.0, rollbem::hertz_pressures(contact, mesh, 1.0)});
    const double unit = contact.a_over_b(), c = 1 / std::sqrt(unit);  // mu N/(G a b) and sqrt(a b), with a = 1
    Found found;
    for (const Place& place : places) {
        const rollbem::Creepage creepage{unit * place["longitudinal"], unit * place["lateral"],
                                         unit / c * place["spin"]};
        const auto step = rollbem::Run(model).steady({.motion = creepage});
        found.add({{-step.force.longitudinal, -step.force.lateral}, {}, step.status});
    }
    return found;
}

/// The values of a problem at places of one contact, on one mesh.
Found on_mesh(const PatchContact& contact, Problem problem, const Discretisation& by, Some places) {
    if (problem == Problem::patch_friction) return forces(contact, by, places);
    const rollbem::HalfSpace<double> kernel(contact.poisson_ratio());
    return coefficients(contact, rollbem::solve_steady(by.mesh(contact), by.equations(), kernel));
}

/// The values of a quantity by a scheme, anew for each place; not numbers unless the status is ok.
Found compute(double nu, const Quantity& quantity, const Discretisation& by) {
    Found all;
    for (const Place& place : quantity.places) {
        const PatchContact contact = contact_of(place, nu);
        Found found = on_mesh(contact, quantity.problem, by, {&place, 1});
        if (by.scheme.richardson)
            found = extrapolate(on_mesh(contact, quantity.problem, by.part(contact, 2), {&place, 1}), found, 2);
        if (found.status != Status::ok) std::fill(found.values.begin(), found.values.end(), nan);
        all.add(found);
    }
    return all;
}

/// Reference forces extrapolated from strips of equal width and three times as many in both directions.
Found reference_forces(const PatchContact& contact, Some places) {
    const double a_over_b = std::clamp(contact.a_over_b(), 0.1, 25.0);
    long n = 10;
    while (n > 2 && 9 * n * rollbem::recommended_strips(n, a_over_b) > reference_elements) --n;
    const long strips = rollbem::recommended_strips(n, a_over_b);
    const auto times = [&](long k) { return forces(contact, with_strips("uniform", k * n, k * strips), places); };
    return extrapolate(times(1), times(3), 2 * std::log2(3));
}

/// Reference coefficients; not numbers where they were not found.
Found reference_coefficients(const PatchContact& contact) {
    const long part = contact.a_over_b() > 10 ? 2 : 1;  // elements of long patches must not be as much longer than wide
    const Discretisation by = with_strips("cosine", part * reference_n, reference_n / part);
    const auto fine = rollbem::solve_steady(contact, by.mesh(contact), by.equations());
    const Found coarse = on_mesh(contact, Problem::patch, by.part(contact, 2), {});
    Found found = extrapolate(coarse, coefficients(contact, fine), 2);
    for (const auto& [k, i, j] : {std::tuple{0, 0, 0}, {1, 1, 1}, {2, 1, 2}, {3, 2, 2}}) {
        if (coarse.status != Status::ok || !is_confirmed(fine, i, j)) found.values[std::size_t(k)] = nan;
    }
    return found;
}

/// The reference of a quantity at all its places, those of one contact together.
Values reference(double nu, const Quantity& quantity) {
    Found all;
    for (Some rest = quantity.places; !rest.empty();) {
        const double a_over_b = rest.front()["a_over_b"];
        std::size_t count = 1;
        while (count < rest.size() && rest[count]["a_over_b"] == a_over_b) ++count;
        const PatchContact contact = contact_of(rest.front(), nu);
        all.add(quantity.problem == Problem::patch ? reference_coefficients(contact)
                                                   : reference_forces(contact, rest.first(count)));
        rest = rest.subspan(count);
    }
    return all.values;
}

/// Whether no mode grows; empty if the eigenvalues were not found or are too many.
std::optional<bool> stable(const PatchContact& contact, const Discretisation& by) {
    const PatchMesh mesh = by.mesh(contact);
    if (mesh.size() > most_judged) return std::nullopt;
    const rollbem::StabilityVerdict verdict = rollbem::judge_stability(
        rollbem::patch_subsystems(mesh, by.equations(), rollbem::HalfSpace<double>(contact.poisson_ratio())));
    if (verdict.status != Status::ok) return std::nullopt;
    return verdict.unstable_count == 0;
}

/// Whether no mode grows in any contact and on any mesh of a scheme; empty where that is unknown of one.
std::optional<bool> stable(const std::vector<double>& shapes, double nu, const Discretisation& by) {
    std::optional<bool> all = true;
    for (const double a_over_b : shapes) {
        const auto contact = PatchContact::dimensionless(a_over_b, nu);
        for (const long divisor : {1, 2}) {
            if (divisor == 2 && !by.scheme.richardson) continue;
            const std::optional<bool> one = stable(contact, by.part(contact, divisor));
            if (one == false) return false;
            if (!one) all.reset();
        }
    }
    return all;
}

/// a/b: those of the contacts over which quantities are judged, or the given one.
std::vector<double> read_shapes(const study::Options& options) {
    if (options.given("a-over-b")) return {options.number("a-over-b", study::between(1e-3, 1e3))};
    return {0.2, 1, 5};
}

constexpr const char* components[] = {"longitudinal", "lateral", "spin"};

/// The creepage of the options with each shape, or 75 of each, in units of mu N/(G a b) and, the spin, mu N/(G a b c):
/// xi, eta and phi alone, together and against each other at three sizes, and 48 random ones. Each of these is relative
/// to the creepage that would need mu N without slip, by Kalker's coefficients of the next a/b, which serve for this
/// only.
Places read_creepages(const study::Options& options, const std::vector<double>& shapes) {
    if (std::any_of(std::begin(components), std::end(components), [&](const char* c) { return options.given(c); })) {
        const auto part = [&](const char* name) { return std::vector{options.number(name, study::finite())}; };
        return combined({{"a_over_b", shapes},
                         {"longitudinal", part("longitudinal")},
                         {"lateral", part("lateral")},
                         {"spin", part("spin")}});
    }
    std::vector<std::array<double, 3>> parts;
    for (const double size : {0.4, 1.0, 2.5}) {
        for (const auto& [xi, eta, phi] : {std::array{1, 0, 0},
                                           {0, 1, 0},
                                           {0, 0, 1},
                                           {1, 1, 0},
                                           {1, 0, 1},
                                           {0, 1, 1},
                                           {0, 1, -1},
                                           {1, 1, 1},
                                           {1, 1, -1}}) {
            const double one = size / std::sqrt(xi * xi + eta * eta + phi * phi);
            parts.push_back({one * xi, one * eta, one * phi});
        }
    }
    drawn::Draw draw(1);
    while (parts.size() < 75) {
        const double size = draw.logarithmic(0.1, 6), xi = draw.uniform(-1, 1), eta = draw.uniform(-1, 1);
        parts.push_back({size * xi, size * eta, size * draw.uniform(-1, 1)});
    }
    Places all;
    for (const double a_over_b : shapes) {
        const auto distance = [&](const auto& entry) { return std::abs(std::log(entry.a_over_b / a_over_b)); };
        const auto& table = rollbem::studies::kalker_table;
        const auto nearest = std::min_element(table.begin(), table.end(), [&](const auto& one, const auto& other) {
            return distance(one) < distance(other);
        });
        for (const auto& [xi, eta, phi] : parts) {
            all.push_back({{{"a_over_b", a_over_b},
                            {"longitudinal", xi / nearest->c11[1]},
                            {"lateral", eta / nearest->c22[1]},
                            {"spin", phi / nearest->c23[1]}}});
        }
    }
    return all;
}

/// A scheme on one mesh of each contact.
Task task_of(const std::vector<double>& shapes, double nu, const Discretisation& by,
             const std::vector<Quantity>& quantities) {
    Task task{{.scheme = by.scheme.word(), .n = by.n}, quantities};
    const long strips = by.strips_of(shapes[0]);
    const bool equal = std::all_of(shapes.begin(), shapes.end(), [&](double s) { return by.strips_of(s) == strips; });
    task.point.setting = {"half-space",
                          "",
                          study::Cell(nu).text(),
                          "",
                          "",
                          shapes.size() > 1 ? "" : study::Cell(shapes[0]).text(),
                          equal ? std::to_string(strips) : ""};
    task.compute = [=](const Quantity& quantity) { return compute(nu, quantity, by); };
    task.status = [](const Found& found) {
        return found.status == Status::ok ? Status::not_converged : found.status;  // the reference, then
    };
    task.stable = [=] { return stable(shapes, nu, by); };
    // a series in n for each number of strips, unless there are as many as elements
    if (by.strips) task.point.series = std::to_string(*by.strips);
    return task;
}

/// Whether the scheme can be tried. Throws BadInput if there are too many elements.
bool exists(const std::vector<double>& shapes, const Discretisation& by) {
    return std::all_of(shapes.begin(), shapes.end(), [&](double a_over_b) {
        const long strips = by.strips_of(a_over_b);
        if (by.n * strips > most_elements) {
            throw study::BadInput("--n = " + std::to_string(by.n) + " times " + std::to_string(strips) +
                                  " strips must be at most " + std::to_string(most_elements));
        }
        return !by.scheme.richardson || (by.n % 2 == 0 && strips % 2 == 0);
    });
}

}  // namespace

std::vector<Quantity> patch_quantities(const study::Options& options) {
    const std::vector<double> shapes = read_shapes(options);
    const Places contacts = combined({{"a_over_b", shapes}});
    return {{"patch_c11", Problem::patch, relative(0), contacts},
            {"patch_c22", Problem::patch, relative(1), contacts},
            {"patch_c23", Problem::patch, relative(2), contacts},
            {"patch_c33", Problem::patch, relative(3), contacts},
            {"patch_force", Problem::patch_friction, largest_difference, read_creepages(options, shapes)}};
}

Comparison read_patch_comparison(const study::Options& options) {
    const std::vector<double> shapes = read_shapes(options);
    const double nu = options.number("poisson", study::between(0, 0.5));
    for (const char* name : {"kernel", "aspect", "front", "omega", "dq", "creepage-ratio", "angle"}) {
        options.ignored(name, "with quantities of patches");
    }
    Comparison result{columns(true), read_quantities(options, patch_quantities(options))};
    if (result.quantities.back().problem != Problem::patch_friction) {
        for (const char* name : components) options.ignored(name, "without the quantity patch_force");
    }
    result.reference = [=](const Quantity& quantity) { return reference(nu, quantity); };
    std::vector<std::ptrdiff_t> sizes{4, 6, 8, 12, 16};
    if (result.quantities.back().problem == Problem::patch) sizes.push_back(24);
    if (options.given("n")) sizes = options.integers("n", 1, most_elements);
    std::vector<std::optional<long>> all_strips;
    if (options.given("strips")) {
        const auto given = options.integers("strips", 1, most_elements);
        all_strips.assign(given.begin(), given.end());
    }
    if (all_strips.empty()) all_strips.emplace_back();
    for (const std::ptrdiff_t n : sizes) {
        for (const NamedScheme& scheme : read_schemes(options, true)) {
            for (const std::optional<long>& strips : all_strips) {
                const Discretisation by{scheme, n, strips};
                if (exists(shapes, by)) result.tasks.push_back(task_of(shapes, nu, by, result.quantities));
            }
        }
    }
    if (result.tasks.empty()) throw study::BadInput(options.said("n") + " and the strips must be even to extrapolate");
    return result;
}

}  // namespace precision
