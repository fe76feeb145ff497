// Error against run time: what precision each scheme gives for its time, which schemes are worth it (the Pareto front),
// and the cheapest scheme for a tolerance:
//
//     ./precision_study --output precision.csv --cheapest cheapest.csv --plot precision.svg
//     ./precision_study --schemes cosine,richardson-cosine --quantity c11 --n 7,14,28
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "precision/front.hpp"
#include "precision/help.hpp"
#include "precision/patches.hpp"
#include "precision/plots.hpp"
#include "precision/recommend.hpp"
#include "precision/references.hpp"
#include "precision/schemes.hpp"
#include "precision/tables.hpp"
#include "precision/timing.hpp"
#include "support/errors.hpp"
#include "support/non_steady.hpp"
#include "support/options.hpp"
#include "support/program.hpp"
#include "support/scenes.hpp"
#include "support/table.hpp"

namespace {

using precision::Case;
using precision::Point;
using precision::Problem;
using precision::Quantity;
using precision::Task;

// --- the command line

const std::string elements_by_default = "4,6,8,10,14,20,28,40,56,80,112,160,224,320,448,640";
const std::vector<std::ptrdiff_t> states_by_default{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20, 24, 32, 48};

void add_options(study::Options& options) {
    const std::string fixed = "each scheme of this study has its own mesh and equations; see --schemes";
    options.refuse_group("Discretisation", fixed, {"n", "size-ratio", "epsilon"});
    options.set_default("n", elements_by_default);
    options.set_default("kernel", "plane");
    options.set_default("size-ratio", "1.89");
    options.set_default("epsilon", "0.37");
    options.set_help("size-ratio",
                     "scheme geometric: dx_trailing / dx_leading, one value, 1e-12 to 1e12 (dimensionless)");
    options.set_help("epsilon",
                     "scheme knothe: size of the end element over that of an inner one, one value, 1e-12 to 1e12 "
                     "(dimensionless)");
    options.set_help("aspect", "b/a, one value above 0; inf for quantities of steady rolling (dimensionless)");
    options.set_help("poisson", "Poisson's ratio, one value, 0 to 0.5 (dimensionless)");
    options.add("schemes", "LIST",
                "all, or some of " + study::join(precision::scheme_names(), ", ") +
                    "; or, for quantities of patches, of " + study::join(precision::patch_scheme_names(), ", "),
                "all");
    options.add("quantity", "LIST",
                "all, or some of c11,traction,c11_z0.1,c11_z1,c11_z5 (z = omega a/V),step_force,friction_force,"
                "combined_force,load_force; or some of " +
                    study::join(precision::patch_quantity_names(), ",") +
                    ", creep coefficients of a contact patch and its forces with friction",
                "all");
    options.add("a-over-b", "RATIO",
                "quantities of patches: ratio of semi-axes, one value, 0.001 to 1000; with --recommend 0.1 to 25", "1");
    options.add(
        "strips", "LIST",
        "quantities of patches: strips along the rolling direction; default: --n, see below for uniform-strips");
    options.add_input(
        "front",
        "compute nothing: read rows written before (shards, concatenated), fill on_front, and draw or search them; not "
        "of patches");
    options.add_output(
        "cheapest",
        "CSV file: for every quantity and tolerance 1e-2 ... 1e-12 the fastest element scheme, the fastest "
        "stable one, the fastest stable one of elements and Chebyshev states, and the fastest of all");
    options.add("recommend", "TOLERANCE",
                "compute nothing: print command lines whose relative error stays below TOLERANCE, above 0 and below 1 "
                "(dimensionless)");
}

std::vector<Quantity> chosen_quantities(const study::Options& options) {
    std::vector<std::string> known;
    for (const Quantity& quantity : precision::quantities()) known.push_back(quantity.name);
    const std::vector<std::string> chosen = options.choices("quantity", known);
    std::vector<Quantity> result;
    for (const Quantity& quantity : precision::quantities()) {
        if (std::find(chosen.begin(), chosen.end(), quantity.name) != chosen.end()) result.push_back(quantity);
    }
    return result;
}

/// Without --n, costly problems stop at smaller n.
long affordable_n(Problem problem) {
    return problem == Problem::steady ? 640 : problem == Problem::harmonic ? 320 : 160;
}

/// Whether a scheme is computed with n: always if --n gives it; of the defaults, Chebyshev states have their own.
bool wanted(const study::Options& options, const std::string& scheme, std::ptrdiff_t n) {
    if (options.given("n")) return true;
    const std::vector<std::ptrdiff_t>& states = states_by_default;
    if (scheme == "chebyshev-states") return std::find(states.begin(), states.end(), n) != states.end();
    const std::vector<std::ptrdiff_t> elements = options.integers("n", 1, precision::largest_n);
    return std::find(elements.begin(), elements.end(), n) != elements.end();
}

// --- rows

std::vector<Task> make_tasks(const study::Options& options, const precision::Scene& scene,
                             const std::vector<std::string>& schemes, const std::vector<Quantity>& quantities) {
    std::vector<Task> tasks;
    const auto add = [&](const std::string& scheme, long n) {
        if (!Case::exists(scheme, n)) return;
        Task task{Case(scene, scheme, n), {}};
        for (const Quantity& quantity : quantities) {
            const bool affordable = options.given("n") || n <= affordable_n(quantity.problem);
            if (affordable && Case::has(scheme, quantity)) task.quantities.push_back(quantity);
        }
        if (!task.quantities.empty()) tasks.push_back(std::move(task));
    };
    std::vector<std::ptrdiff_t> sizes = options.integers("n", 1, precision::largest_n);
    if (!options.given("n")) {
        sizes.insert(sizes.end(), states_by_default.begin(), states_by_default.end());
        std::sort(sizes.begin(), sizes.end());
        sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
    }
    for (const std::ptrdiff_t n : sizes) {
        for (const std::string& scheme : schemes) {
            if (wanted(options, scheme, n)) add(scheme, n);
        }
    }
    for (const std::string& scheme : schemes) add(scheme, 0);
    if (tasks.empty())
        throw study::BadInput(options.said("n") + " must fit at least one of the schemes and quantities");
    return tasks;
}

/// Times and the front are those of one contact and one mesh of each kind.
void refuse_lists(const study::Options& options) {
    for (const char* name : {"kernel", "aspect", "poisson", "size-ratio", "epsilon"}) {
        if (options.said(name).find(',') == std::string::npos) continue;
        throw study::BadInput(options.said(name) +
                              " must be a single value: schemes are compared for one contact, each with one mesh of a "
                              "kind; run the study once for each value");
    }
}

precision::Scene make_scene(const study::Options& options, const std::vector<std::string>& schemes,
                            const std::vector<Quantity>& quantities) {
    refuse_lists(options);
    const auto used = [&](const char* name) {
        return std::find(schemes.begin(), schemes.end(), name) != schemes.end();
    };
    if (!used("geometric")) options.ignored("size-ratio", "without the scheme geometric");
    if (!used("knothe")) options.ignored("epsilon", "without the scheme knothe");
    const bool steady = std::none_of(quantities.begin(), quantities.end(), [](const Quantity& quantity) {
        return quantity.problem == Problem::harmonic || quantity.problem == Problem::step ||
               quantity.problem == Problem::varying_load;
    });
    const rollbem::Contact<double> contact =
        study::make_contact(options, steady ? study::Problem::steady : study::Problem::non_steady);
    if (!steady) study::require_plane_model(contact);
    // the strip of infinite width is the plane
    const bool plane = options.choice("kernel", {"strip", "plane"}) == "plane" || !std::isfinite(contact.aspect());
    if (!plane && used("chebyshev-states") && contact.aspect() < 0.001) {
        throw study::BadInput(options.said("aspect") + " must be at least 0.001 for the scheme chebyshev-states");
    }
    return {contact, plane, options.number("size-ratio", study::between(1e-12, 1e12)),
            options.number("epsilon", study::between(1e-12, 1e12))};
}

/// The rows of one task, without on_front.
std::vector<Point> points_of(const Task& task, const std::map<std::string, double>& model_errors,
                             const std::map<Problem, double>& times) {
    std::vector<Point> points;
    const std::optional<bool> stable = task.scheme.stable();
    for (const Quantity& quantity : task.quantities) {
        Point point{.scheme = task.scheme.scheme(),
                    .n = task.scheme.n() > 0 ? std::optional(task.scheme.n()) : std::nullopt,
                    .quantity = quantity.name,
                    .relative_error = task.scheme.relative_error(quantity),
                    .time_us = std::nullopt,
                    .stable = stable};
        const auto time = times.find(quantity.problem);
        if (time != times.end()) point.time_us = time->second;
        const auto model = model_errors.find(quantity.name);
        if (model != model_errors.end()) point.model_error = model->second;
        if (!point.relative_error) point.status = task.scheme.status(quantity);
        point.setting = task.scheme.setting();
        points.push_back(std::move(point));
    }
    return points;
}

/// The schemes to compute, and their rows. References, times, and errors for on_front are found before the first row is
/// written.
class Computation {
public:
    Computation(const study::Options& options, const std::vector<Quantity>& quantities)
        : Computation(options, quantities, options.choices("schemes", precision::scheme_names())) {}

    std::vector<std::size_t> rows_of_task() const {
        std::vector<std::size_t> rows;
        for (const Task& task : tasks_) rows.push_back(task.quantities.size());
        return rows;
    }

    /// Computes the references, measures the times of all rows, and computes their errors if on_front is wanted.
    void prepare(const std::vector<std::size_t>& wanted, const std::function<void(double part)>& done) {
        for (const Quantity& quantity : quantities_) {
            (*scene_.references)[quantity.name] = precision::reference(scene_.contact, quantity);
            if (!scene_.plane) model_errors_[quantity.name] = precision::model_error(scene_, quantity);
        }
        if (with_times_) times_ = precision::measure(tasks_, wanted, [&](double part) { done(part / 2); });
        if (partial_) return;
        for (std::size_t i = 0; i < tasks_.size(); ++i) {
            first_.push_back(points_.size());
            for (Point& point : points_of(tasks_[i], model_errors_, times_[i])) points_.push_back(std::move(point));
            done((1 + static_cast<double>(i + 1) / static_cast<double>(tasks_.size())) / 2);
        }
        precision::mark_front(points_);
    }

    void emit_rows(std::size_t task, study::RowRange range, const study::Emit& emit) const {
        const std::vector<Point> own =
            partial_ ? points_of(tasks_[task], model_errors_, with_times_ ? times_[task] : std::map<Problem, double>{})
                     : std::vector<Point>{};
        for (std::size_t k = range.first; k < range.last; ++k) {
            emit(precision::row(partial_ ? own[k] : points_[first_[task] + k]));
        }
    }

    /// All rows; none where on_front is not known.
    const std::vector<Point>& points() const { return points_; }

private:
    Computation(const study::Options& options, const std::vector<Quantity>& quantities,
                const std::vector<std::string>& schemes)
        : quantities_(quantities),
          scene_(make_scene(options, schemes, quantities)),
          tasks_(make_tasks(options, scene_, schemes, quantities)),
          with_times_(study::has_times(options)),
          partial_(options.given("shard") || !with_times_) {}

    std::vector<Quantity> quantities_;
    precision::Scene scene_;
    std::vector<Task> tasks_;
    bool with_times_, partial_;
    std::map<std::string, double> model_errors_;
    std::vector<std::map<Problem, double>> times_;
    std::vector<Point> points_;
    std::vector<std::size_t> first_;  // of each task in points_
};

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options("precision_study",
                           "Error against run time: which scheme gives a required precision at the least cost?");
    add_options(options);
    options.not_with({"n", "schemes", "kernel", "aspect", "poisson", "size-ratio", "epsilon", "shard", "jobs"},
                     "front");
    options.footer(precision::help);

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        if (given.given("recommend")) {
            precision::print_recommendations(given);
            return study::exit_ok;
        }
        const std::vector<Quantity> of_patches = precision::chosen_patch_quantities(given);
        const std::vector<Quantity> quantities = of_patches.empty() ? chosen_quantities(given) : of_patches;
        if (of_patches.empty()) {
            for (const char* name : {"a-over-b", "strips"}) given.ignored(name, "without quantities of patches");
        }
        if (given.given("shard") || !study::has_times(given)) {
            given.ignored("cheapest", "with --shard or --jobs or --no-timing, where times lack; use --front");
        }
        study::Table table;
        table.columns = precision::columns();
        std::vector<Point> read;
        std::optional<Computation> computed;
        std::optional<precision::PatchComputation> patches;
        const auto compute = [&](auto& computation) {
            table.rows_of_task = computation->rows_of_task();
            table.prepare = [&](const auto& wanted, const auto& done) { computation->prepare(wanted, done); };
            table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
                computation->emit_rows(task, range, emit);
            };
        };
        if (!of_patches.empty()) {
            patches.emplace(given, of_patches);
            table.columns = precision::patch_columns();
            compute(patches);
        } else if (given.given("front")) {
            // 2. Rows from a file.
            read = precision::read_points(given, quantities);
            precision::mark_front(read);
            table.rows_of_task.assign(read.size(), 1);
            table.compute = [&](std::size_t i, study::RowRange, const study::Emit& emit) {
                emit(precision::row(read[i]));
            };
        } else {
            // 3. Or schemes to compute.
            computed.emplace(given, quantities);
            compute(computed);
        }
        const auto points = [&]() -> const std::vector<Point>& {
            return patches ? patches->points() : computed ? computed->points() : read;
        };
        table.plot = [&](const std::vector<study::Row>& rows) {
            return precision::pictures(quantities, rows, points());
        };

        // 4. The rows, and the cheapest scheme for each tolerance.
        std::optional<study::OutputFile> cheapest;
        if (given.given("cheapest")) cheapest.emplace(given.text("cheapest"), "--cheapest");
        study::write_table(given, table);
        if (cheapest) precision::write_cheapest(*cheapest, points(), quantities);
        return study::exit_ok;
    });
}
