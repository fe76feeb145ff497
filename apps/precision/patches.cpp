// Creep coefficients and forces with friction of contact patches as precision_study compares them: error against time
// over n and strips.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include <rollbem/accuracy/recommended_patch.hpp>
#include <rollbem/accuracy/richardson.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/patch.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/rolling/run.hpp>
#include <rollbem/studies/kalker_table.hpp>

#include "comparison.hpp"
#include "support/named_scheme.hpp"

namespace precision {

namespace {

constexpr rollbem::NodeDifference chebyshev{rollbem::Nodes::chebyshev};  // of references
constexpr long reference_n = 48;                                         // and half of it
constexpr std::ptrdiff_t most_elements = 4096, most_judged = 256;  // eigenvalues cost much more than the coefficients
constexpr std::ptrdiff_t reference_elements = 500;                 // with friction
enum class Strips { cosine, uniform };

using PatchContact = rollbem::PatchContact<double>;

struct PatchValues {
    std::vector<double> values;
    std::string status = "ok";
};

rollbem::PatchMesh<double> mesh_of(const PatchContact& contact, Strips grading, long n, long strips) {
    return rollbem::patch_mesh(
        contact, rollbem::cosine_mesh(n),
        grading == Strips::uniform ? rollbem::uniform_mesh(strips) : rollbem::cosine_mesh(strips));
}

/// By order 2, from meshes of which the fine one has `ratio` times as many elements and strips.
PatchValues extrapolate(const PatchValues& coarse, PatchValues fine, double ratio) {
    for (std::size_t k = 0; k < fine.values.size(); ++k) {
        fine.values[k] = rollbem::richardson(coarse.values[k], fine.values[k], 2 * std::log2(ratio));
    }
    if (fine.status == "ok") fine.status = coarse.status;
    return fine;
}

/// c11, c22, c23, c33.
PatchValues coefficients(const PatchContact& contact, const rollbem::Response<double>& steady) {
    const auto c = creep_coefficients(contact, steady);
    return {{c.c11, c.c22, c.c23, c.c33}, rollbem::name(steady.status)};
}

/// By one mesh alone, whose error is what is asked for.
PatchValues coefficients(const PatchContact& contact, const rollbem::PatchMesh<double>& mesh,
                         const rollbem::NodeDifference& scheme) {
    return coefficients(contact,
                        rollbem::solve_steady(mesh, scheme, rollbem::HalfSpace<double>(contact.poisson_ratio())));
}

/// -F_x and -F_y over mu N under both creepages, spin alone, and all three together. Kalker's coefficients serve to
/// choose their sizes only.
PatchValues forces(const PatchContact& contact, const rollbem::PatchMesh<double>& mesh,
                   const rollbem::NodeDifference& scheme) {
    const rollbem::FrictionModel model(contact,
                                       steady_system(mesh, scheme, rollbem::HalfSpace<double>(contact.poisson_ratio())),
                                       {1.0, rollbem::hertz_pressures(contact, mesh, 1.0)});
    const double a_over_b = contact.a_over_b(), c = 1 / std::sqrt(a_over_b);
    const auto nearest = std::min_element(rollbem::studies::kalker_table.begin(), rollbem::studies::kalker_table.end(),
                                          [&](const auto& one, const auto& other) {
                                              return std::abs(std::log(one.a_over_b / a_over_b)) <
                                                     std::abs(std::log(other.a_over_b / a_over_b));
                                          });
    const double xi = a_over_b / nearest->c11[1], eta = a_over_b / nearest->c22[1],
                 phi = a_over_b / c / nearest->c23[1], two = std::sqrt(0.5), three = std::sqrt(1.0 / 3);
    PatchValues found;
    for (const rollbem::Creepage<double>& creepage : {rollbem::Creepage<double>{two * xi, two * eta, 0},
                                                      {0, 0, 2.5 * phi},
                                                      {three * xi, three * eta, three * phi}}) {
        const auto step = rollbem::Run(model).steady({.motion = creepage});
        found.values.insert(found.values.end(), {-step.force.longitudinal, -step.force.lateral});
        if (step.status != rollbem::Status::ok) found.status = rollbem::name(step.status);
    }
    return found;
}

/// Extrapolated from strips of equal width and three times as many in both directions.
PatchValues reference_forces(const PatchContact& contact) {
    const double a_over_b = std::clamp(contact.a_over_b(), 0.1, 25.0);
    long n = 10;
    while (n > 2 && 9 * n * rollbem::recommended_strips(n, a_over_b) > reference_elements) --n;
    const long strips = rollbem::recommended_strips(n, a_over_b);
    return extrapolate(forces(contact, mesh_of(contact, Strips::uniform, n, strips), chebyshev),
                       forces(contact, mesh_of(contact, Strips::uniform, 3 * n, 3 * strips), chebyshev), 3);
}

/// How a scheme discretises a patch.
struct PatchScheme : study::NamedScheme {
    rollbem::NodeDifference difference() const { return *equations().get_if<rollbem::NodeDifference>(); }
    Strips grading() const { return strips == "uniform" ? Strips::uniform : Strips::cosine; }
};

PatchValues compute(const PatchContact& contact, Problem problem, const PatchScheme& scheme, long n, long strips) {
    const auto of = [&](long own_n, long own_strips) {
        const rollbem::PatchMesh<double> mesh = mesh_of(contact, scheme.grading(), own_n, own_strips);
        return problem == Problem::patch ? coefficients(contact, mesh, scheme.difference())
                                         : forces(contact, mesh, scheme.difference());
    };
    if (!scheme.richardson) return of(n, strips);
    return extrapolate(of(n / 2, strips / 2), of(n, strips), 2);
}

/// What the quantities of a problem should be; not numbers if that was not found out.
std::vector<double> reference(const PatchContact& contact, Problem problem) {
    if (problem == Problem::patch_friction) return reference_forces(contact).values;
    const long part = contact.a_over_b() > 10 ? 2 : 1;  // elements of long patches must not be as much longer than wide
    const long n = part * reference_n, strips = reference_n / part;
    const auto fine = rollbem::solve_steady(contact, mesh_of(contact, Strips::cosine, n, strips), chebyshev);
    const PatchValues coarse = coefficients(contact, mesh_of(contact, Strips::cosine, n / 2, strips / 2), chebyshev);
    PatchValues found = extrapolate(coarse, coefficients(contact, fine), 2);
    for (const auto& [k, i, j] : {std::tuple{0, 0, 0}, {1, 1, 1}, {2, 1, 2}, {3, 2, 2}}) {
        const bool known = coarse.status == "ok" && is_confirmed(fine, i, j);
        if (!known) found.values[std::size_t(k)] = nan;
    }
    return found.values;
}

/// Empty if the eigenvalues were not found or are too many.
std::optional<bool> stable(const PatchContact& contact, const PatchScheme& scheme, long n, long strips) {
    const rollbem::PatchMesh<double> mesh = mesh_of(contact, scheme.grading(), n, strips);
    if (mesh.size() > most_judged) return std::nullopt;
    const rollbem::StabilityVerdict verdict = rollbem::judge_stability(
        rollbem::patch_subsystems(mesh, scheme.difference(), rollbem::HalfSpace<double>(contact.poisson_ratio())));
    if (verdict.status != rollbem::Status::ok) return std::nullopt;
    return verdict.unstable_count == 0;
}

/// What the quantities of each problem should be.
using References = std::map<Problem, std::vector<double>>;

/// Of a coefficient the relative error, of forces the largest difference over mu N.
double patch_error(const Quantity& quantity, const std::vector<double>& found, const std::vector<double>& exact) {
    if (quantity.problem == Problem::patch) {
        const auto k = std::size_t(quantity.name == "patch_c11"   ? 0
                                   : quantity.name == "patch_c22" ? 1
                                   : quantity.name == "patch_c23" ? 2
                                                                  : 3);
        return found[k] / exact[k] - 1;
    }
    double largest = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) largest = std::max(largest, std::abs(found[k] - exact[k]));
    return largest;
}

/// A scheme on one mesh; each problem is computed once for all its quantities.
Task task_of(const PatchContact& contact, const PatchScheme& scheme, long n, long strips,
             const std::vector<Quantity>& quantities, const std::shared_ptr<const References>& references) {
    Task task{scheme.word(),
              n,
              quantities,
              {"half-space", "", study::Cell(contact.poisson_ratio()).text(), "", "",
               study::Cell(contact.a_over_b()).text(), std::to_string(strips)}};
    const auto found = std::make_shared<std::map<Problem, PatchValues>>();
    const auto once = [=](Problem problem) -> const PatchValues& {
        if (found->count(problem) == 0) (*found)[problem] = compute(contact, problem, scheme, n, strips);
        return (*found)[problem];
    };
    task.error = [=](const Quantity& quantity) {
        const PatchValues& own = once(quantity.problem);
        return own.status == "ok" ? patch_error(quantity, own.values, references->at(quantity.problem)) : nan;
    };
    task.status = [=](const Quantity& quantity) {
        const std::string own = once(quantity.problem).status;
        return own == "ok" ? rollbem::name(rollbem::Status::not_converged) : own;  // the reference, then
    };
    task.run = [=](const Quantity& quantity) {
        return compute(contact, quantity.problem, scheme, n, strips).values[0];
    };
    task.stable = [=]() -> std::optional<bool> {
        const std::optional<bool> fine = stable(contact, scheme, n, strips);
        return scheme.richardson && fine.value_or(false) ? stable(contact, scheme, n / 2, strips / 2) : fine;
    };
    return task;
}

}  // namespace

const std::vector<Quantity>& patch_quantities() {
    static const std::vector<Quantity> all{{"patch_c11", Problem::patch},
                                           {"patch_c22", Problem::patch},
                                           {"patch_c23", Problem::patch},
                                           {"patch_c33", Problem::patch},
                                           {"patch_force", Problem::patch_friction}};
    return all;
}

Comparison compare_on_patch(const study::Options& options) {
    const auto contact = PatchContact::dimensionless(options.number("a-over-b", study::between(1e-3, 1e3)),
                                                     options.number("poisson", study::between(0, 0.5)));
    for (const char* name : {"kernel", "aspect", "front", "omega", "dq", "creepage-ratio"}) {
        options.ignored(name, "with quantities of patches");
    }
    Comparison result{columns(), chosen(options, patch_quantities()), {}, {}, {}};
    result.columns.insert(result.columns.end(), {"a_over_b", "strips"});
    const auto references = std::make_shared<References>();
    result.prepare = [contact, references, quantities = result.quantities] {
        for (const Quantity& quantity : quantities) {
            if (references->count(quantity.problem) == 0) {
                (*references)[quantity.problem] = reference(contact, quantity.problem);
            }
        }
    };
    std::vector<std::ptrdiff_t> sizes{4, 6, 8, 12, 16}, all_strips;
    if (result.quantities.back().problem == Problem::patch) sizes.push_back(24);
    if (options.given("n")) sizes = options.integers("n", 1, most_elements);
    if (options.given("strips")) all_strips = options.integers("strips", 1, most_elements);
    std::vector<PatchScheme> schemes;
    for (study::NamedScheme& scheme :
         study::named_schemes(options.given("scheme") ? options.texts("scheme") : patch_schemes, true)) {
        schemes.push_back({std::move(scheme)});
    }
    const double a_over_b = contact.a_over_b();
    for (const std::ptrdiff_t n : sizes) {
        for (const PatchScheme& scheme : schemes) {
            const bool own = scheme.grading() == Strips::uniform && a_over_b >= 0.1 && a_over_b <= 25;
            const std::ptrdiff_t usual = own ? rollbem::recommended_strips(n, a_over_b) : n;
            for (const std::ptrdiff_t m : all_strips.empty() ? std::vector{usual} : all_strips) {
                if (n * m > most_elements) {
                    throw study::BadInput("--n = " + std::to_string(n) + " times " + std::to_string(m) +
                                          " strips must be at most " + std::to_string(most_elements));
                }
                if (scheme.richardson && (n % 2 != 0 || m % 2 != 0)) continue;
                Task task = task_of(contact, scheme, n, m, result.quantities, references);
                // a series in n for each number of strips, unless there are as many as elements
                if (options.given("strips")) task.series = task.setting.back();
                result.tasks.push_back(std::move(task));
            }
        }
    }
    if (result.tasks.empty()) throw study::BadInput(options.said("n") + " and the strips must be even to extrapolate");
    return result;
}

}  // namespace precision
