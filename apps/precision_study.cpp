// Error against run time: what precision each scheme gives for its time, which schemes are worth it (the Pareto front),
// and the cheapest scheme for a tolerance:
//
//     ./precision_study --output precision.csv --cheapest cheapest.csv --plot precision.svg
//     ./precision_study --scheme cosine:collocation:0.5/0.5,richardson:cosine:nodes --quantity c11 --n 7,14,28
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "precision/comparison.hpp"
#include "support/input.hpp"
#include "support/options.hpp"
#include "support/table.hpp"
#include "support/timing.hpp"

namespace precision {

namespace {

std::vector<std::string> names_of(const std::vector<Quantity>& quantities) {
    std::vector<std::string> names;
    for (const Quantity& quantity : quantities) names.push_back(quantity.name);
    return names;
}

constexpr const char* help =
    R"(Example: everything, with the cheapest schemes and a picture
  precision_study --output precision.csv --cheapest cheapest.csv --plot precision.svg

One row for each scheme, n and quantity:
  scheme            scheme, as --scheme takes it
  n                 number of elements, with richardson: of the finer mesh; with chebyshev number of states (1 to 48
                    without --n), with polynomial order; empty for the closed form
  quantity          quantity, see below
  relative_error    relative error, for lines against the closed forms of the plane model: the largest over all
                    creepages, frequencies, ... that the quantity stands for, or that at the one given by an option
  time_us           time from the mesh to the result [microseconds] of one of these, the mean of all; median of
                    at least 5 times, or 5 of these if they take 0.2 seconds, once if all take one; all schemes take
                    turns
  stable            1 where no eigenvalue grows, as computed, else 0; empty above 256 elements of a patch
  on_front          1 where no other scheme is both as fast and as precise, else 0; a scheme's error counts as the
                    largest at this and every larger n, so that a change of sign does not pass for precision. Empty
                    for polynomial and closed-form; for extrapolated forces with friction, whose errors jump with
                    the border of stick; and with --shard or --jobs above 1, where times are missing: concatenate the
                    shards and use --front
  model_error       relative error that the strip kernel alone makes
  size_ratio, epsilon
                    parameters of the scheme's mesh
  status            ok, or why relative_error is empty; in the file of --cheapest none where no scheme reaches the
                    tolerance
  a_over_b, strips  ratio of semi-axes and number of strips, for quantities of patches; empty where it differs among
                    the patches that the error is the largest of
  worst_at          place of the error, as creepage_ratio=0.5 angle=15, by the names of friction_study, transient_study
                    and patch_study (angle: of both creepages to the rolling direction [degrees]; omega: of response);
                    empty for c11 and traction, where nothing is varied

Quantities of a line
  traction: norm of the differences from Carter's mean traction of each element over the norm of these means, both
with the weight sqrt(1 - x^2/a^2): Carter's traction, singular at the trailing edge, has no norm without it, and with it
the norm bounds the error of the force.
  c11_z0.1, c11_z1, response: c11 at omega a/V = 0.1, at 1, and at 20 frequencies from 0.1 to 5, logarithmic. transient:
the force at q/a = 1.05, 1.12, ... 9.94 after a step of creepage, exact in time. friction: the force in steady rolling
at creepage ratios 0.05 + 0.9 k/19, k = 0 to 19. closed-form: the difference of two closed forms where there are two.
  combined_force: the force at these creepage ratios, at 15, 45 and 75 degrees to the rolling direction; the error is
|F - reference| over |reference|. load_force: the largest error of F/(mu N_0) from steady rolling over a period of a
load N = N_0 (1 + 0.5 sin(2 pi q/(8 a_0))), in 160 steps of sdirk2, at creepage ratios 0.2, 0.35, 0.55 and 0.8.
Collocation and node differences on graded meshes breathe with the half-length where the kernel is plane; all other
meshes cover the largest contact. Neither force has a closed form: combined_force is compared with
cosine:nodes-chebyshev of 640 elements, good to 3e-6, load_force with an extrapolation from cosine meshes of 160 and 320
elements that breathe, in 640 steps, good to about 4e-6.

Quantities of a patch
  patch_c11 ... patch_c33: Kalker's creep coefficients of an ellipse between half-spaces, by n elements in each of as
many strips (others by --strips) along the rolling direction, with richardson: extrapolated from n/2 and strips/2, of
a/b = 0.2, 1 and 5. The reference is extrapolated from 24 x 24 and 48 x 48 elements; a reference from 32 x 32 and
64 x 64 differs by 2e-4 (a/b = 0.5, 1) and 6e-4 (a/b = 5, 20).
  patch_force: -F_x and -F_y under Hertz's pressure for 75 creepages of each a/b: xi, eta and phi alone, together and
against each other, of 0.4, 1 and 2.5 times the size that would make mu N without slip (by Kalker's c11, c22, c23), and
48 random ones of up to 6 times. relative_error is the largest difference over mu N from strips of equal width, at most
500 elements, extrapolated from a third of them in each direction, a reference good to about 3e-3 where spin acts
against eta, to 1e-3 elsewhere (5e-3 below a/b = 0.1, 1e-2 above 25).
  uniform-strips: strips of equal width, without --strips as many as recommended_patch gives (a/b from 0.1 to 25).
Without --n, n is 4 to 24 for patches, with patch_force to 16; c11_z* and response stop at n = 320, transient and the
forces with friction at 160: two to three minutes in all.
--plot draws up to three quantities; of more it draws c11, response and friction.
)";

const std::string elements_by_default = "4,6,8,10,14,20,28,40,56,80,112,160,224,320,448,640";
void add_options(study::Options& options) {
    options.refuse_group("Discretisation", "--scheme has mesh and equations in one word", {"n", "scheme"});
    options.set_default("n", elements_by_default);
    options.set_default("kernel", "plane");
    options.set_help(
        "scheme", study::scheme_help(
                      ". Without elements: chebyshev (n states), polynomial (of the order n), closed-form. "
                      "richardson:MESH:METHOD[:PARAMETERS]: extrapolation from n/2 and n elements, n even. On patches: "
                      "cosine:nodes or cosine:nodes-chebyshev, then :cosine-strips or :uniform-strips. Default: " +
                      study::join(study::cells_of(line_schemes), ", ") + "; for quantities of patches " +
                      study::join(study::cells_of(patch_schemes), ", ")));
    options.set_help("aspect",
                     "ratio b/a of half-width and half-length [dimensionless], one value above 0, inf for quantities "
                     "of steady rolling");
    options.set_help("poisson", "Poisson's ratio [dimensionless], 0 to 0.5", "NU");
    options.add(
        "quantity", "LIST",
        "quantities: all, or some of "
        "c11,traction,c11_z0.1,c11_z1,response,transient,friction,combined_force,load_force; or, of a patch, some of "
        "patch_c11,patch_c22,patch_c23,patch_c33,patch_force",
        "all");
    options.add("omega", "Z",
                "the one frequency omega a/V of response [dimensionless], above 0; default: 20 frequencies");
    options.add("dq", "STEP",
                "length [a], above 0, of ten steps, after each of which transient is judged; default: from q = a to 10 "
                "a");
    options.add("creepage-ratio", "X",
                "the one creepage ratio delta = xi G/(2 (1-nu) mu p0) of friction, combined_force and load_force "
                "[dimensionless], above 0; default: 20 ratios, for load_force 4");
    options.add("angle", "DEGREES",
                "the one angle of combined_force between creepages and the rolling direction [degrees], 0 to 90; "
                "default: 15, 45 and 75");
    options.add("a-over-b", "RATIO",
                "the one ratio of a patch's semi-axes [dimensionless], 0.001 to 1000; default: 0.2, 1 and 5; "
                "with --recommend 0.1 to 25, default 1");
    for (const char* name : {"longitudinal", "lateral", "spin"}) {
        options.add(name, "X",
                    std::string("the one creepage of patch_force, in units of patch_study [dimensionless], its ") +
                        name + " part; default: 75 creepages, with one of the parts 0",
                    "0");
    }
    options.add("strips", "LIST",
                "number of a patch's strips along the rolling direction [dimensionless]; default: --n, see below for "
                "uniform-strips");
    options.add_input("front",
                      "CSV file of rows written before (shards, concatenated), in place of a computation: on_front is "
                      "filled, and the rows are drawn or searched; not for patches");
    options.add_output("cheapest",
                       "CSV file of the fastest schemes for every quantity and tolerance 1e-2 ... 1e-12: of elements, "
                       "of stable elements, of stable elements and Chebyshev states, and of all; none without it");
    options.add("recommend", "TOLERANCE",
                "relative error [dimensionless], above 0 and below 1, for which command lines that stay below it are "
                "printed, in place of a computation");
    options.not_with({"n", "scheme", "kernel", "aspect", "poisson", "shard", "jobs"}, "front");
    options.footer(help);
}

// --- times

/// Finds the median times [us] of the `wanted` tasks for each of their problems, the mean over its places, and keeps
/// what they find. All take turns, one run each, so that changes in the machine's speed affect all of them. Reports the
/// progress, 0 ... 1, by done(part).
void measure(std::vector<Task>& tasks, const std::vector<std::size_t>& wanted,
             const std::function<void(double part)>& done) {
    std::vector<std::pair<double*, study::Timer>> timers;
    for (const std::size_t i : wanted) {
        for (const Quantity& quantity : tasks[i].quantities) {
            const auto [time, is_new] = tasks[i].time_us.try_emplace(quantity.problem);
            if (!is_new) continue;
            Found& kept = tasks[i].found[quantity.name];
            const auto compute = [&task = tasks[i], &kept, &quantity] {
                Found found = task.compute(quantity);
                const double value = found.values[0].real();
                if (kept.values.empty()) kept = std::move(found);
                return value;
            };
            timers.emplace_back(&time->second, study::Timer(compute, quantity.runs()));
        }
    }
    const auto is_open = [](const auto& timer) { return !timer.second.done(); };
    for (int round = 0; std::any_of(timers.begin(), timers.end(), is_open); ++round) {
        done(std::min(round, 5) / 5.0);
        for (auto& timer : timers) {
            if (is_open(timer)) timer.second.run_again();
        }
    }
    for (auto& [time, timer] : timers) *time = timer.median();
}

// --- rows

/// The rows of a comparison. References, times, and errors for on_front are found before the first row is written.
class Computation {
public:
    explicit Computation(Comparison& comparison) : comparison_(comparison) {}

    study::Table table() {
        study::Table table;
        table.columns = comparison_.columns;
        for (const Task& task : comparison_.tasks) {
            first_.push_back(first_.empty() ? 0 : first_.back() + table.rows_of_task.back());
            table.rows_of_task.push_back(task.quantities.size());
        }
        table.prepare = [&](const auto& wanted, const auto& done) { prepare(wanted, done); };
        table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
            const std::vector<Point> own = comparison_.partial ? points_of(task) : std::vector<Point>{};
            for (std::size_t k = range.first; k < range.last; ++k) {
                emit(row(comparison_.partial ? own[k] : comparison_.points[first_[task] + k]));
                if (comparison_.partial && comparison_.timed) comparison_.points.push_back(own[k]);  // by a single job
            }
        };
        return table;
    }

private:
    /// The computed value of each of the quantities; the coefficients of a patch come together.
    template <class Value, class Compute>
    static std::vector<Value> each(const std::vector<Quantity>& quantities, const Compute& compute) {
        std::vector<Value> all;
        for (const Quantity& quantity : quantities) {
            const bool same = !all.empty() && quantity.problem == Problem::patch;
            all.push_back(same ? all.back() : compute(quantity));
        }
        return all;
    }

    /// Measures the times of all rows, and computes their errors if on_front is wanted.
    void prepare(const std::vector<std::size_t>& wanted, const std::function<void(double part)>& done) {
        if (wanted.empty()) return;  // a shard without rows
        const std::vector<Quantity>& quantities = comparison_.quantities;
        const std::vector<Values> references = each<Values>(quantities, comparison_.reference);
        for (std::size_t k = 0; k < quantities.size(); ++k) {
            references_[quantities[k].name] = references[k];
            if (comparison_.model_error) model_errors_[quantities[k].name] = comparison_.model_error(quantities[k]);
        }
        const std::size_t count = comparison_.tasks.size();
        if (comparison_.timed) measure(comparison_.tasks, wanted, [&](double part) { done(part / 2); });
        if (comparison_.partial) return;
        for (std::size_t i = 0; i < count; ++i) {
            for (Point& point : points_of(i)) comparison_.points.push_back(std::move(point));
            done((1 + static_cast<double>(i + 1) / static_cast<double>(count)) / 2);
        }
        mark_front(comparison_.points);
    }

    std::vector<Point> points_of(std::size_t index) const {
        const Task& task = comparison_.tasks[index];
        const std::vector<Found> found = each<Found>(task.quantities, [&](const Quantity& quantity) {
            const auto known = task.found.find(quantity.name);
            return known != task.found.end() ? known->second : task.compute(quantity);
        });
        std::vector<Point> points(found.size(), task.point);
        const std::optional<bool> stable = task.stable();
        for (std::size_t k = 0; k < found.size(); ++k) {
            Point& point = points[k];
            const Quantity& quantity = task.quantities[k];
            Values exact = found[k].exact.empty() ? task.exact(quantity) : found[k].exact;
            if (exact.empty()) exact = references_.at(quantity.name);
            point.quantity = quantity.name;
            point.competes = quantity.competes(point.scheme);
            point.stable = stable;
            const auto [error, place] = worst(quantity, found[k].values, exact);
            point.relative_error = error;
            point.worst_at = place->text();
            if (!std::isfinite(error)) {
                point.relative_error.reset();
                point.status = name(task.status(found[k]));
            }
            const auto time = task.time_us.find(quantity.problem);
            if (time != task.time_us.end()) point.time_us = time->second;
            const auto model = model_errors_.find(quantity.name);
            if (model != model_errors_.end()) point.model_error = model->second;
        }
        return points;
    }

    Comparison& comparison_;
    std::vector<std::size_t> first_;  // of each task in the points
    std::map<std::string, Values> references_;
    std::map<std::string, std::optional<double>> model_errors_;
};

/// Rows of a file.
study::Table table_of(const Comparison& read) {
    study::Table table;
    table.columns = read.columns;
    table.rows_of_task.assign(read.points.size(), 1);
    table.compute = [&](std::size_t i, study::RowRange, const study::Emit& emit) { emit(row(read.points[i])); };
    return table;
}

Comparison read_comparison(const study::Options& options) {
    const bool patches = options.text("quantity").find("patch_") != std::string::npos;
    for (const char* name : {"a-over-b", "strips", "longitudinal", "lateral", "spin"}) {
        if (!patches) options.ignored(name, "without quantities of patches");
    }
    const bool timed = study::has_times(options), partial = options.given("shard") || !timed;
    if (partial) options.ignored("cheapest", "with --shard or --jobs or --no-timing, where times lack; use --front");
    Comparison comparison{columns(), {}};
    if (patches) {
        comparison = read_patch_comparison(options);
    } else if (!options.given("front")) {
        comparison = read_line_comparison(options);
    } else {
        comparison.quantities = read_quantities(options, line_quantities(options));
        comparison.points = read_points(options, comparison.quantities);
        mark_front(comparison.points);
    }
    comparison.timed = timed;
    comparison.partial = partial;
    return comparison;
}

}  // namespace

std::vector<study::NamedScheme> read_schemes(const study::Options& options, bool of_patch) {
    const char* usual = of_patch ? patch_schemes : line_schemes;
    return study::named_schemes(options.given("scheme") ? options.texts("scheme") : study::cells_of(usual), of_patch);
}

std::vector<Quantity> read_quantities(const study::Options& options, const std::vector<Quantity>& all) {
    const std::vector<std::string> asked = options.choices("quantity", names_of(all));
    std::vector<Quantity> result;
    for (const Quantity& quantity : all) {
        if (study::contains(asked, quantity.name)) result.push_back(quantity);
    }
    return result;
}

}  // namespace precision

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options("precision_study",
                           "Error against run time: which scheme gives a required precision at the least cost?");
    precision::add_options(options);
    return study::run_program(options, argc, argv, [](const study::Options& given) {
        if (given.given("recommend")) {
            precision::print_recommendations(precision::read_recommendation(given));
            return study::exit_ok;
        }
        // 2. The rows, computed or of a file.
        precision::Comparison comparison = precision::read_comparison(given);
        const std::vector<precision::Quantity>& quantities = comparison.quantities;
        const std::vector<precision::Point>& points = comparison.points;
        precision::Computation computation(comparison);
        study::Table table = comparison.tasks.empty() ? precision::table_of(comparison) : computation.table();
        table.plot = [&](const study::Records&) { return precision::pictures(quantities, points); };

        // 3. The cheapest scheme for each tolerance.
        study::OutputFiles files;
        if (given.given("cheapest")) {
            study::OutputFile* const cheapest = &files.open(given.text("cheapest"), "--cheapest");
            table.finish = [&, cheapest] { precision::write_cheapest(*cheapest, points, quantities); };
        }
        study::write_table(given, table, files);
        return study::exit_ok;
    });
}
