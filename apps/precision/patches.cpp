#include "patches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <rollbem/accuracy/recommended_patch.hpp>
#include <rollbem/accuracy/richardson.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/patch.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/studies/kalker_table.hpp>

#include "support/csv.hpp"
#include "support/errors.hpp"
#include "support/timing.hpp"
#include "tables.hpp"

namespace precision {

namespace {

constexpr rollbem::NodeDifference chebyshev{rollbem::Nodes::chebyshev};
constexpr long reference_n = 48;                                   // and half of it
constexpr std::ptrdiff_t most_elements = 4096, most_judged = 256;  // eigenvalues cost much more than the coefficients
constexpr std::ptrdiff_t reference_elements = 500;                 // with friction
const std::string direct = "nodes-chebyshev", richardson = "richardson-nodes", uniform = "uniform-strips";

using PatchContact = rollbem::PatchContact<double>;

struct Found {
    std::vector<double> values;
    std::string status = "ok";
};

rollbem::PatchMesh<double> mesh_of(const PatchContact& contact, const std::string& by, long n, long strips) {
    return rollbem::patch_mesh(contact, rollbem::cosine_mesh(n),
                               by == uniform ? rollbem::uniform_mesh(strips) : rollbem::cosine_mesh(strips));
}

/// By order 2, from meshes of which the fine one has `ratio` times as many elements and strips.
Found extrapolate(const Found& coarse, Found fine, double ratio) {
    for (std::size_t k = 0; k < fine.values.size(); ++k) {
        fine.values[k] = rollbem::richardson(coarse.values[k], fine.values[k], 2 * std::log2(ratio));
    }
    if (fine.status == "ok") fine.status = coarse.status;
    return fine;
}

/// c11, c22, c23, c33.
Found coefficients(const PatchContact& contact, const rollbem::PatchMesh<double>& mesh) {
    const auto steady = rollbem::solve_steady(contact, mesh, chebyshev);
    const auto c = creep_coefficients(contact, steady);
    return {{c.c11, c.c22, c.c23, c.c33}, rollbem::name(steady.status)};
}

/// -F_x and -F_y over mu N under both creepages, spin alone, and all three together. Kalker's coefficients serve to
/// choose their sizes only.
Found forces(const PatchContact& contact, const rollbem::PatchMesh<double>& mesh) {
    const rollbem::FrictionModel model(
        contact, steady_system(mesh, chebyshev, rollbem::HalfSpace<double>(contact.poisson_ratio())),
        {1.0, rollbem::hertz_pressures(contact, mesh, 1.0)});
    const double a_over_b = contact.a_over_b(), c = 1 / std::sqrt(a_over_b);
    const auto nearest = std::min_element(
        rollbem::kalker_table.begin(), rollbem::kalker_table.end(), [&](const auto& one, const auto& other) {
            return std::abs(std::log(one.a_over_b / a_over_b)) < std::abs(std::log(other.a_over_b / a_over_b));
        });
    const double xi = a_over_b / nearest->c11[1], eta = a_over_b / nearest->c22[1],
                 phi = a_over_b / c / nearest->c23[1], two = std::sqrt(0.5), three = std::sqrt(1.0 / 3);
    auto workspace = model.workspace();
    const auto rest = model.at_rest();
    auto state = rest;
    Found found;
    for (const rollbem::Creepage<double>& creepage : {rollbem::Creepage<double>{two * xi, two * eta, 0},
                                                      {0, 0, 2.5 * phi},
                                                      {three * xi, three * eta, three * phi}}) {
        const auto step = model.steady(rest, creepage, state, workspace);
        found.values.insert(found.values.end(), {-step.force.longitudinal, -step.force.lateral});
        if (step.status != rollbem::StepStatus::ok) found.status = rollbem::name(step.status);
    }
    return found;
}

/// Extrapolated from strips of equal width and three times as many in both directions.
Found reference_forces(const PatchContact& contact) {
    const double a_over_b = std::clamp(contact.a_over_b(), 0.1, 25.0);
    long n = 10;
    while (n > 2 && 9 * n * rollbem::recommended_strips(n, a_over_b) > reference_elements) --n;
    const long strips = rollbem::recommended_strips(n, a_over_b);
    return extrapolate(forces(contact, mesh_of(contact, uniform, n, strips)),
                       forces(contact, mesh_of(contact, uniform, 3 * n, 3 * strips)), 3);
}

Found compute(const PatchContact& contact, Problem problem, const PatchTask& task) {
    const auto of = [&](const std::string& by, long n, long strips) {
        return (problem == Problem::steady ? coefficients : forces)(contact, mesh_of(contact, by, n, strips));
    };
    if (task.scheme != richardson) return of(task.scheme, task.n, task.strips);
    return extrapolate(of(direct, task.n / 2, task.strips / 2), of(direct, task.n, task.strips), 2);
}

/// Empty if the eigenvalues were not found or are too many.
std::optional<bool> stable(const PatchContact& contact, const rollbem::PatchMesh<double>& mesh) {
    if (mesh.size() > most_judged) return std::nullopt;
    const rollbem::StabilityVerdict verdict = rollbem::judge_stability(
        rollbem::patch_parts(mesh, chebyshev, rollbem::HalfSpace<double>(contact.poisson_ratio())));
    if (verdict.status != rollbem::Status::ok) return std::nullopt;
    return verdict.unstable_count == 0;
}

}  // namespace

const std::vector<std::string>& patch_quantity_names() {
    static const std::vector<std::string> names{"patch_c11", "patch_c22", "patch_c23", "patch_c33", "patch_force"};
    return names;
}

const std::vector<std::string>& patch_scheme_names() {
    static const std::vector<std::string> names{direct, richardson, uniform};
    return names;
}

std::vector<Quantity> chosen_patch_quantities(const study::Options& options) {
    std::vector<Quantity> chosen;
    if (options.text("quantity").find("patch_") == std::string::npos) return chosen;
    const std::vector<std::string> asked = options.choices("quantity", patch_quantity_names());
    for (const std::string& name : patch_quantity_names()) {
        if (std::count(asked.begin(), asked.end(), name) > 0) {
            chosen.push_back({name, name == "patch_force" ? Problem::combined_friction : Problem::steady});
        }
    }
    return chosen;
}

std::vector<std::string> patch_columns() {
    std::vector<std::string> names = columns();
    names.insert(names.end(), {"a_over_b", "strips"});
    return names;
}

PatchComputation::PatchComputation(const study::Options& options, const std::vector<Quantity>& quantities)
    : contact_(PatchContact::dimensionless(options.number("a-over-b", study::between(1e-3, 1e3)),
                                           options.number("poisson", study::between(0, 0.5)))),
      quantities_(quantities),
      with_times_(study::has_times(options)),
      partial_(options.given("shard") || !with_times_),
      by_strips_(options.given("strips")) {
    for (const char* name : {"kernel", "aspect", "size-ratio", "epsilon", "front"}) {
        options.ignored(name, "with quantities of patches");
    }
    for (const Quantity& quantity : quantities) problems_.insert(quantity.problem);
    const double a_over_b = contact_.a_over_b();
    std::vector<std::ptrdiff_t> sizes{4, 6, 8, 12, 16};
    if (problems_.count(Problem::combined_friction) == 0) sizes.push_back(24);
    if (options.given("n")) sizes = options.integers("n", 1, most_elements);
    std::vector<std::ptrdiff_t> strips;
    if (by_strips_) strips = options.integers("strips", 1, most_elements);
    const std::vector<std::string> schemes = options.choices("schemes", patch_scheme_names());
    for (const std::ptrdiff_t n : sizes) {
        for (const std::string& name : schemes) {
            const bool own = name == uniform && a_over_b >= 0.1 && a_over_b <= 25;
            const std::ptrdiff_t usual = own ? rollbem::recommended_strips(n, a_over_b) : n;
            for (const std::ptrdiff_t m : by_strips_ ? strips : std::vector{usual}) {
                if (n * m > most_elements) {
                    throw study::BadInput("--n = " + std::to_string(n) + " times " + std::to_string(m) +
                                          " strips must be at most " + std::to_string(most_elements));
                }
                if (name != richardson || (n % 2 == 0 && m % 2 == 0)) tasks_.push_back({name, n, m});
            }
        }
    }
    if (tasks_.empty()) throw study::BadInput(options.said("n") + " and the strips must be even to extrapolate");
}

std::vector<std::size_t> PatchComputation::rows_of_task() const {
    return std::vector<std::size_t>(tasks_.size(), quantities_.size());
}

std::vector<Point> PatchComputation::points_of(const PatchTask& task) const {
    std::map<Problem, Found> found;
    std::map<Problem, double> times;
    for (const Problem problem : problems_) {
        const auto run = [&] { return compute(contact_, problem, task); };
        found[problem] = run();
        if (with_times_) times[problem] = study::median_time_us([&] { return run().values[0]; });
    }
    std::optional<bool> decays = stable(contact_, mesh_of(contact_, task.scheme, task.n, task.strips));
    if (task.scheme == richardson && decays && *decays) {
        decays = stable(contact_, mesh_of(contact_, direct, task.n / 2, task.strips / 2));
    }
    std::vector<Point> points;
    for (const Quantity& quantity : quantities_) {
        const Found& own = found[quantity.problem];
        const std::vector<double>& reference = references_.at(quantity.problem);
        Point point{.scheme = task.scheme,
                    .n = task.n,
                    .quantity = quantity.name,
                    .relative_error = std::nullopt,
                    .time_us = with_times_ ? std::optional(times[quantity.problem]) : std::nullopt,
                    .stable = decays,
                    .status = own.status};
        if (own.status == "ok" && quantity.problem == Problem::steady) {
            const auto& names = patch_quantity_names();
            const auto k = std::size_t(std::find(names.begin(), names.end(), quantity.name) - names.begin());
            if (std::isnan(reference[k])) {
                point.status = rollbem::name(rollbem::Status::not_converged);
            } else {
                point.relative_error = own.values[k] / reference[k] - 1;
            }
        } else if (own.status == "ok") {
            point.relative_error = 0;
            for (std::size_t k = 0; k < reference.size(); ++k) {
                point.relative_error = std::max(*point.relative_error, std::abs(own.values[k] - reference[k]));
            }
        }
        point.setting = {"half-space",
                         "",
                         study::Cell(contact_.poisson_ratio()).text(),
                         "",
                         "",
                         study::Cell(contact_.a_over_b()).text(),
                         std::to_string(task.strips)};
        points.push_back(std::move(point));
    }
    return points;
}

void PatchComputation::prepare(const std::vector<std::size_t>&, const std::function<void(double part)>& done) {
    for (const Problem problem : problems_) {
        // elements of long patches must not be as much longer than wide
        const long part = contact_.a_over_b() > 10 ? 2 : 1;
        const Found found = problem == Problem::steady
                                ? compute(contact_, problem, {richardson, part * reference_n, reference_n / part})
                                : reference_forces(contact_);
        references_[problem] = found.values;
        if (problem == Problem::steady && found.status != "ok") {
            std::fill(references_[problem].begin(), references_[problem].end(),
                      std::numeric_limits<double>::quiet_NaN());
        }
    }
    if (partial_) return;
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
        for (Point& point : points_of(tasks_[i])) points_.push_back(std::move(point));
        done(static_cast<double>(i + 1) / static_cast<double>(tasks_.size()));
    }
    // a series in n for each number of strips, unless there are as many as elements
    std::vector<Point> series = points_;
    if (by_strips_) {
        for (Point& point : series) point.scheme += " " + point.setting.back();
    }
    mark_front(series);
    for (std::size_t i = 0; i < points_.size(); ++i) points_[i].on_front = series[i].on_front;
}

void PatchComputation::emit_rows(std::size_t task, study::RowRange range, const study::Emit& emit) const {
    const std::vector<Point> own = partial_ ? points_of(tasks_[task]) : std::vector<Point>{};
    for (std::size_t k = range.first; k < range.last; ++k) {
        emit(row(partial_ ? own[k] : points_[task * quantities_.size() + k]));
    }
}

}  // namespace precision
