// Creep coefficients and forces with friction of contact patches as precision_study compares them: error against time
// over n and strips.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <rollbem/accuracy/recommended_patch.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/patch.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/rolling/run.hpp>
#include <rollbem/studies/kalker_table.hpp>

#include "comparison.hpp"

namespace precision {

namespace {

constexpr long reference_n = 48;                                   // and half of it
constexpr std::ptrdiff_t most_elements = 4096, most_judged = 256;  // eigenvalues cost much more than the coefficients
constexpr std::ptrdiff_t reference_elements = 500;                 // with friction

using PatchContact = rollbem::PatchContact<double>;
using PatchMesh = rollbem::PatchMesh<double>;
using rollbem::NodeDifference;
using rollbem::Status;
using study::NamedScheme;

NamedScheme with_strips(const std::string& strips) {
    return study::scheme_named("cosine:nodes-chebyshev:" + strips + "-strips", true);
}

NodeDifference difference(const NamedScheme& scheme) { return *scheme.equations().get_if<NodeDifference>(); }

PatchMesh mesh_of(const PatchContact& contact, const NamedScheme& scheme, long n, long strips) {
    return rollbem::patch_mesh(
        contact, rollbem::cosine_mesh(n),
        scheme.strips == "uniform" ? rollbem::uniform_mesh(strips) : rollbem::cosine_mesh(strips));
}

/// c11, c22, c23, c33.
Found coefficients(const PatchContact& contact, const rollbem::Response<double>& steady) {
    const auto c = creep_coefficients(contact, steady);
    return {{c.c11, c.c22, c.c23, c.c33}, {}, steady.status};
}

/// -F_x and -F_y over mu N under both creepages, spin alone, and all three together. Kalker's coefficients serve to
/// choose their sizes only.
Found forces(const PatchContact& contact, const PatchMesh& mesh, const NodeDifference& scheme) {
    const rollbem::HalfSpace<double> kernel(contact.poisson_ratio());
    const rollbem::FrictionModel model(contact, steady_system(mesh, scheme, kernel),
                                       {1.0, rollbem::hertz_pressures(contact, mesh, 1.0)});
    const double a_over_b = contact.a_over_b(), c = 1 / std::sqrt(a_over_b);
    const auto distance = [&](const auto& entry) { return std::abs(std::log(entry.a_over_b / a_over_b)); };
    const auto& table = rollbem::studies::kalker_table;
    const auto nearest = std::min_element(table.begin(), table.end(), [&](const auto& one, const auto& other) {
        return distance(one) < distance(other);
    });
    const double xi = a_over_b / nearest->c11[1], eta = a_over_b / nearest->c22[1],
                 phi = a_over_b / c / nearest->c23[1], two = std::sqrt(0.5), three = std::sqrt(1.0 / 3);
    Found found;
    for (const rollbem::Creepage<double>& creepage : {rollbem::Creepage<double>{two * xi, two * eta, 0},
                                                      {0, 0, 2.5 * phi},
                                                      {three * xi, three * eta, three * phi}}) {
        const auto step = rollbem::Run(model).steady({.motion = creepage});
        found.values.insert(found.values.end(), {-step.force.longitudinal, -step.force.lateral});
        if (step.status != Status::ok) found.status = step.status;
    }
    return found;
}

/// The values of a problem on one mesh.
Found on_mesh(const PatchContact& contact, Problem problem, const NamedScheme& scheme, long n, long strips) {
    const PatchMesh mesh = mesh_of(contact, scheme, n, strips);
    if (problem == Problem::patch_friction) return forces(contact, mesh, difference(scheme));
    const rollbem::HalfSpace<double> kernel(contact.poisson_ratio());
    return coefficients(contact, rollbem::solve_steady(mesh, difference(scheme), kernel));
}

/// The values by a scheme; not numbers unless the status is ok.
Found compute(const PatchContact& contact, Problem problem, const NamedScheme& scheme, long n, long strips) {
    Found found = on_mesh(contact, problem, scheme, n, strips);
    if (scheme.richardson) found = extrapolate(on_mesh(contact, problem, scheme, n / 2, strips / 2), found, 2);
    if (found.status != Status::ok) std::fill(found.values.begin(), found.values.end(), nan);
    return found;
}

/// Reference forces extrapolated from strips of equal width and three times as many in both directions.
Values reference_forces(const PatchContact& contact) {
    const double a_over_b = std::clamp(contact.a_over_b(), 0.1, 25.0);
    long n = 10;
    while (n > 2 && 9 * n * rollbem::recommended_strips(n, a_over_b) > reference_elements) --n;
    const long strips = rollbem::recommended_strips(n, a_over_b);
    const auto times = [&](long k) {
        return on_mesh(contact, Problem::patch_friction, with_strips("uniform"), k * n, k * strips);
    };
    return extrapolate(times(1), times(3), 2 * std::log2(3)).values;
}

/// The reference of the quantities of a problem; not numbers if it was not found.
Values reference(const PatchContact& contact, Problem problem) {
    if (problem == Problem::patch_friction) return reference_forces(contact);
    const long part = contact.a_over_b() > 10 ? 2 : 1;  // elements of long patches must not be as much longer than wide
    const long n = part * reference_n, strips = reference_n / part;
    const NamedScheme scheme = with_strips("cosine");
    const auto fine = rollbem::solve_steady(contact, mesh_of(contact, scheme, n, strips), difference(scheme));
    const Found coarse = on_mesh(contact, problem, scheme, n / 2, strips / 2);
    Values found = extrapolate(coarse, coefficients(contact, fine), 2).values;
    for (const auto& [k, i, j] : {std::tuple{0, 0, 0}, {1, 1, 1}, {2, 1, 2}, {3, 2, 2}}) {
        if (coarse.status != Status::ok || !is_confirmed(fine, i, j)) found[std::size_t(k)] = nan;
    }
    return found;
}

/// Whether no mode grows; empty if the eigenvalues were not found or are too many.
std::optional<bool> stable(const PatchContact& contact, const NamedScheme& scheme, long n, long strips) {
    const PatchMesh mesh = mesh_of(contact, scheme, n, strips);
    if (mesh.size() > most_judged) return std::nullopt;
    const rollbem::StabilityVerdict verdict = rollbem::judge_stability(
        rollbem::patch_subsystems(mesh, difference(scheme), rollbem::HalfSpace<double>(contact.poisson_ratio())));
    if (verdict.status != Status::ok) return std::nullopt;
    return verdict.unstable_count == 0;
}

/// A scheme on one mesh.
Task task_of(const PatchContact& contact, const NamedScheme& scheme, long n, long strips,
             const std::vector<Quantity>& quantities) {
    const std::string ratio = study::Cell(contact.a_over_b()).text();
    Task task{{.scheme = scheme.word(), .n = n}, quantities};
    task.point.setting = {"half-space",          "", study::Cell(contact.poisson_ratio()).text(), "", "", ratio,
                          std::to_string(strips)};
    task.compute = [=](const Quantity& quantity) { return compute(contact, quantity.problem, scheme, n, strips); };
    task.status = [](const Found& found) {
        return found.status == Status::ok ? Status::not_converged : found.status;  // the reference, then
    };
    task.stable = [=]() -> std::optional<bool> {
        const std::optional<bool> fine = stable(contact, scheme, n, strips);
        return scheme.richardson && fine.value_or(false) ? stable(contact, scheme, n / 2, strips / 2) : fine;
    };
    return task;
}

}  // namespace

std::vector<Quantity> patch_quantities() {
    return {{"patch_c11", Problem::patch, relative(0)},
            {"patch_c22", Problem::patch, relative(1)},
            {"patch_c23", Problem::patch, relative(2)},
            {"patch_c33", Problem::patch, relative(3)},
            {"patch_force", Problem::patch_friction, largest_difference}};
}

Comparison read_patch_comparison(const study::Options& options) {
    const auto contact = PatchContact::dimensionless(options.number("a-over-b", study::between(1e-3, 1e3)),
                                                     options.number("poisson", study::between(0, 0.5)));
    for (const char* name : {"kernel", "aspect", "front", "omega", "dq", "creepage-ratio"}) {
        options.ignored(name, "with quantities of patches");
    }
    Comparison result{columns(), read_quantities(options, patch_quantities())};
    result.columns.insert(result.columns.end(), {"a_over_b", "strips"});
    result.reference = [=](const Quantity& quantity) { return reference(contact, quantity.problem); };
    std::vector<std::ptrdiff_t> sizes{4, 6, 8, 12, 16}, all_strips;
    if (result.quantities.back().problem == Problem::patch) sizes.push_back(24);
    if (options.given("n")) sizes = options.integers("n", 1, most_elements);
    if (options.given("strips")) all_strips = options.integers("strips", 1, most_elements);
    const std::vector<NamedScheme> schemes = read_schemes(options, true);
    const double a_over_b = contact.a_over_b();
    for (const std::ptrdiff_t n : sizes) {
        for (const NamedScheme& scheme : schemes) {
            const bool own = scheme.strips == "uniform" && a_over_b >= 0.1 && a_over_b <= 25;
            const std::ptrdiff_t usual = own ? rollbem::recommended_strips(n, a_over_b) : n;
            for (const std::ptrdiff_t m : all_strips.empty() ? std::vector{usual} : all_strips) {
                if (n * m > most_elements) {
                    throw study::BadInput("--n = " + std::to_string(n) + " times " + std::to_string(m) +
                                          " strips must be at most " + std::to_string(most_elements));
                }
                if (scheme.richardson && (n % 2 != 0 || m % 2 != 0)) continue;
                Task task = task_of(contact, scheme, n, m, result.quantities);
                // a series in n for each number of strips, unless there are as many as elements
                if (options.given("strips")) task.point.series = task.point.setting.back();
                result.tasks.push_back(std::move(task));
            }
        }
    }
    if (result.tasks.empty()) throw study::BadInput(options.said("n") + " and the strips must be even to extrapolate");
    return result;
}

}  // namespace precision
