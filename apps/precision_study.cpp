// Error against run time: what precision each scheme gives for its time, which schemes are worth it (the Pareto front),
// and the cheapest scheme for a tolerance:
//
//     ./precision_study --output precision.csv --cheapest cheapest.csv --plot precision.svg
//     ./precision_study --schemes cosine,richardson-cosine --quantity c11 --n 7,14,28
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "precision/front.hpp"
#include "precision/schemes.hpp"
#include "support/files.hpp"
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

const std::vector<std::string> columns{"scheme", "n",        "quantity",    "relative_error", "time_us",
                                       "stable", "on_front", "model_error", "status",         "kernel",
                                       "aspect", "poisson",  "size_ratio",  "epsilon"};
constexpr std::size_t first_setting = 9, measured = 8;  // of the columns; --front does without those behind these

// --- the command line

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

constexpr std::ptrdiff_t largest = 100000;  // n
const std::string elements_by_default = "4,6,8,10,14,20,28,40,56,80,112,160,224,320,448,640";
const std::vector<std::ptrdiff_t> states_by_default{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20, 24, 32, 48};

/// Without --n, what is costly stops at smaller n.
long largest_n(Problem problem) { return problem == Problem::steady ? 640 : problem == Problem::harmonic ? 320 : 160; }

/// Whether a scheme is asked for with n: by --n, or without it by the defaults, fewer for Chebyshev states.
bool wanted(const study::Options& options, const std::string& scheme, std::ptrdiff_t n) {
    if (options.given("n")) return true;
    const std::vector<std::ptrdiff_t>& states = states_by_default;
    if (scheme == "chebyshev-states") return std::find(states.begin(), states.end(), n) != states.end();
    const std::vector<std::ptrdiff_t> elements = options.integers("n", 1, largest);
    return std::find(elements.begin(), elements.end(), n) != elements.end();
}

// --- rows

/// One scheme at one n with the quantities it is measured for.
struct Task {
    Case scheme;
    std::vector<Quantity> quantities;
};

std::vector<Task> make_tasks(const study::Options& options, const precision::Scene& scene,
                             const std::vector<std::string>& schemes, const std::vector<Quantity>& quantities) {
    std::vector<Task> tasks;
    const auto add = [&](const std::string& scheme, long n) {
        if (!Case::exists(scheme, n)) return;
        Task task{Case(scene, scheme, n), {}};
        for (const Quantity& quantity : quantities) {
            const bool affordable = options.given("n") || n <= largest_n(quantity.problem);
            if (affordable && Case::has(scheme, quantity)) task.quantities.push_back(quantity);
        }
        if (!task.quantities.empty()) tasks.push_back(std::move(task));
    };
    std::vector<std::ptrdiff_t> sizes = options.integers("n", 1, largest);
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

precision::Scene make_scene(const study::Options& options, const std::vector<std::string>& schemes,
                            const std::vector<Quantity>& quantities) {
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
    precision::Scene scene{contact, plane, options.number("size-ratio", study::between(1e-12, 1e12)),
                           options.number("epsilon", study::between(1e-12, 1e12))};
    const auto asked = [&](Problem problem) {
        return std::any_of(quantities.begin(), quantities.end(),
                           [&](const Quantity& quantity) { return quantity.problem == problem; });
    };
    if (asked(Problem::step)) scene.step_forces = precision::exact_step_forces(contact);
    if (asked(Problem::combined_friction)) scene.both_forces = precision::combined_reference(contact);
    if (asked(Problem::varying_load)) scene.load_forces = precision::load_reference(contact);
    return scene;
}

study::Row row(const Point& point) {
    const auto flag = [](const std::optional<bool>& value) { return value ? study::Cell(int(*value)) : study::Cell(); };
    study::Row cells{point.scheme,       study::Cell(point.n), point.quantity,    point.relative_error, point.time_us,
                     flag(point.stable), flag(point.on_front), point.model_error, point.status};
    cells.insert(cells.end(), point.setting.begin(), point.setting.end());
    return cells;
}

/// The rows of one task, but for on_front.
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

// --- times

/// One computation, repeated.
struct Timer {
    const Case* scheme;
    Quantity quantity;
    std::size_t calls = 1;  ///< in a run, so that it lasts some hundred times the clock's overhead
    std::vector<double> runs{};
    double total = 0;

    double run(std::size_t count) const {
        using Clock = std::chrono::steady_clock;
        [[maybe_unused]] volatile double kept = 0;  // keeps the optimiser from dropping the computation
        const Clock::time_point start = Clock::now();
        for (std::size_t i = 0; i < count; ++i) kept = scheme->run(quantity);
        return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
    }
    bool done() const { return runs.size() >= 5 && (total > 8000 || runs.size() >= 51); }
    double median() {
        const auto middle = runs.begin() + std::ptrdiff_t(runs.size() / 2);
        std::nth_element(runs.begin(), middle, runs.end());
        return *middle / static_cast<double>(calls);
    }
};

/// Median times of every task for each of its problems. All take turns, one run each, so that a machine that changes
/// its speed hits all alike. done(part) is told how much of it is done.
template <class Done>
std::vector<std::map<Problem, double>> measure(const std::vector<Task>& tasks, const std::vector<std::size_t>& wanted,
                                               const Done& done) {
    std::vector<std::map<Problem, Timer>> timers(tasks.size());
    for (const std::size_t i : wanted) {
        for (const Quantity& quantity : tasks[i].quantities) {
            timers[i].try_emplace(quantity.problem, Timer{&tasks[i].scheme, quantity});
        }
    }
    for (auto& of_task : timers) {
        for (auto& [problem, timer] : of_task) {
            timer.run(1);  // a first call is slow
            while (timer.calls < 4096 && timer.run(timer.calls) < 40) timer.calls *= 2;
        }
    }
    bool again = true;
    for (int round = 0; again; ++round) {
        again = false;
        done(std::min(round, 5) / 5.0);
        for (auto& of_task : timers) {
            for (auto& [problem, timer] : of_task) {
                if (timer.done()) continue;
                if (timer.calls > 1) timer.run(1);  // warms up what the one before has driven out
                timer.runs.push_back(timer.run(timer.calls));
                timer.total += timer.runs.back();
                again = true;
            }
        }
    }
    std::vector<std::map<Problem, double>> times(tasks.size());
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        for (auto& [problem, timer] : timers[i]) times[i][problem] = timer.median();
    }
    return times;
}

/// Schemes to compute, what is known of them before the first row is written, and their rows.
class Computation {
public:
    Computation(const study::Options& options, const std::vector<Quantity>& quantities)
        : with_times_(study::has_times(options)), partial_(options.given("shard") || !with_times_) {
        const std::vector<std::string> schemes = options.choices("schemes", precision::scheme_names());
        const precision::Scene scene = make_scene(options, schemes, quantities);
        tasks_ = make_tasks(options, scene, schemes, quantities);
        if (scene.plane) return;
        for (const Quantity& quantity : quantities) {
            model_errors_[quantity.name] = precision::model_error(scene, quantity);
        }
    }

    std::vector<std::size_t> rows_of_task() const {
        std::vector<std::size_t> rows;
        for (const Task& task : tasks_) rows.push_back(task.quantities.size());
        return rows;
    }

    /// Measures the times of all rows, and computes their errors where on_front is wanted.
    void prepare(const std::vector<std::size_t>& wanted, const std::function<void(double part)>& done) {
        if (with_times_) times_ = measure(tasks_, wanted, [&](double part) { done(part / 2); });
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
            emit(row(partial_ ? own[k] : points_[first_[task] + k]));
        }
    }

    /// All rows; none where on_front cannot be told.
    const std::vector<Point>& points() const { return points_; }

private:
    bool with_times_, partial_;
    std::vector<Task> tasks_;
    std::map<std::string, double> model_errors_;
    std::vector<std::map<Problem, double>> times_;
    std::vector<Point> points_;
    std::vector<std::size_t> first_;  // of each task in points_
};

// --- --front

std::optional<double> read_cell(const std::string& text, const std::string& where) {
    if (text.empty()) return std::nullopt;
    const std::optional<double> value = study::detail::parse_number<double>(text);
    if (!value || !std::isfinite(*value)) throw study::BadInput(where + " must be a number or empty: " + text);
    return value;
}

/// The rows of this program's earlier output.
std::vector<Point> read_points(const study::Options& options, const std::vector<Quantity>& quantities) {
    study::Lines lines(options, "front");
    const std::string header = study::join(columns, ",");
    const std::string short_header = study::join({columns.begin(), columns.begin() + measured}, ",");
    std::size_t cells_expected = 0;
    std::vector<Point> points;
    while (lines.next()) {
        const std::string where = lines.where();
        const std::string& text = lines.text();
        if (lines.number() == 1) {
            const std::vector<std::string> names = study::cells_of(text, ',');
            const std::string given = study::join(names, ",");
            if (given != header && given != short_header) throw study::BadInput(where + " must be " + header);
            cells_expected = names.size();
            continue;
        }
        std::vector<std::string> cells = study::cells_of(text, ',');
        const auto known = [](const auto& list, const auto& name, const auto& name_of) {
            return std::any_of(list.begin(), list.end(), [&](const auto& item) { return name_of(item) == name; });
        };
        if (cells.size() != cells_expected) {
            throw study::BadInput(where + " must have " + std::to_string(cells_expected) + " cells");
        }
        cells.resize(columns.size());
        if (!known(precision::scheme_names(), cells[0], [](const std::string& name) { return name; })) {
            throw study::BadInput(where + " must name a scheme: " + cells[0]);
        }
        const auto name_of = [](const Quantity& quantity) { return quantity.name; };
        if (!known(precision::quantities(), cells[2], name_of)) {
            throw study::BadInput(where + " must name a quantity: " + cells[2]);
        }
        if (!known(quantities, cells[2], name_of)) continue;
        const auto in_range = [&](std::size_t column, double low, double high) {
            const std::optional<double> value = read_cell(cells[column], where);
            if (value && !(*value >= low && *value <= high)) {
                throw study::BadInput(where + ": " + columns[column] + " = " + cells[column] + " must " +
                                      study::between(low, high).text);
            }
            return value;
        };
        const std::optional<double> n = in_range(1, 1, largest), stable = in_range(5, 0, 1);
        points.push_back({.scheme = cells[0],
                          .n = n ? std::optional(std::lround(*n)) : std::nullopt,
                          .quantity = cells[2],
                          .relative_error = read_cell(cells[3], where),
                          .time_us = in_range(4, 0, 1e15),
                          .stable = stable ? std::optional(*stable != 0) : std::nullopt,
                          .on_front = std::nullopt,
                          .model_error = read_cell(cells[7], where),
                          .status = cells[8],
                          .setting = {cells.begin() + first_setting, cells.end()}});
        // rows are compared, and what they are compared by must be the same
        const auto other = std::find_if(points.begin(), points.end(), [&](const Point& point) {
            const auto first = point.setting.begin();
            return point.scheme == points.back().scheme ? point.setting != points.back().setting
                                                        : !std::equal(first, first + 3, points.back().setting.begin());
        });
        if (other != points.end()) {
            throw study::BadInput(where +
                                  " must have the kernel, aspect, poisson, size_ratio and epsilon of the rows above");
        }
    }
    if (points.empty()) throw study::BadInput(options.said("front") + " must have rows of the quantities asked for");
    return points;
}

// --- --cheapest and --plot

void write_cheapest(study::OutputFile& file, const std::vector<Point>& points,
                    const std::vector<Quantity>& quantities) {
    using precision::Among;
    const std::vector<double> sustained = precision::sustained_errors(points);
    file.write(
        study::csv_line({"quantity", "tolerance", "among", "scheme", "n", "relative_error", "time_us", "status"}));
    for (const Quantity& quantity : quantities) {
        for (int exponent = 2; exponent <= 12; ++exponent) {
            for (const auto& [among, name] : {std::pair{Among::elements, "elements"},
                                              {Among::stable_elements, "stable-elements"},
                                              {Among::stable, "stable"},
                                              {Among::all, "all"}}) {
                const double tolerance = std::pow(10.0, -exponent);
                const auto best = precision::cheapest(points, sustained, quantity.name, tolerance, among);
                const std::string text = "1e-" + std::to_string(exponent);
                study::Row cells{quantity.name, text, name, {}, {}, {}, {}, "none"};
                if (best) {
                    const Point& point = points[*best];
                    cells = {quantity.name,        text,          name, point.scheme, study::Cell(point.n),
                             point.relative_error, point.time_us, "ok"};
                }
                file.write(study::csv_line(cells));
            }
        }
    }
    file.commit();
}

constexpr std::size_t black = 6;  // of the styles, and every seventh from there
constexpr double floor = 1e-14;   // smaller errors are rounding, or none, which logarithmic axes have no place for

/// The style of a scheme, the same in all panels; none is black.
std::size_t style_of(const std::string& scheme) {
    const std::vector<std::string>& names = precision::scheme_names();
    const auto place = static_cast<std::size_t>(std::find(names.begin(), names.end(), scheme) - names.begin());
    return place + place / black;
}

/// A panel for one quantity: the error of every scheme over its time, and the front with the errors that put it there.
/// What lies below the floor stands on it.
study::Plot panel(const std::string& quantity, const std::vector<study::Row>& rows, const std::vector<Point>& points) {
    std::string title;
    for (const char c : quantity) {
        if (c == '_') title += '\\';  // a bare one is gnuplot's mark of a subscript
        title += c;
    }
    study::Plot plot{.title = title,
                     .x_label = "time [microseconds]",
                     .y_label = "|relative error|",
                     .log_x = true,
                     .log_y = true,
                     .series = {}};
    study::Series front{.label = "Pareto front", .points = {}, .markers = false, .style = black, .reference = true};
    const std::vector<double> sustained = precision::sustained_errors(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].quantity != quantity || !points[i].on_front.value_or(false)) continue;
        front.points.emplace_back(*points[i].time_us, std::max(sustained[i], floor));
    }
    std::sort(front.points.begin(), front.points.end());
    bool below = false;
    double largest_error = floor;
    std::vector<double> times;
    for (const std::string& scheme : precision::scheme_names()) {
        study::Series series{.label = scheme, .points = {}, .style = style_of(scheme)};
        for (const study::Row& cells : rows) {
            if (cells[0].text() != scheme || cells[2].text() != quantity) continue;
            const std::optional<double> error = cells[3].number(), time = cells[4].number();
            if (!error || !time) continue;
            below = below || std::abs(*error) < floor;
            largest_error = std::max(largest_error, std::abs(*error));
            times.push_back(*time);
            series.points.emplace_back(*time, std::max(std::abs(*error), floor));
        }
        if (!series.points.empty()) plot.series.push_back(std::move(series));
    }
    if (!front.points.empty()) plot.series.push_back(std::move(front));
    if (below) {
        const auto [first, last] = std::minmax_element(times.begin(), times.end());
        plot.y_range = study::PlotRange{floor / 3, 3 * largest_error};
        plot.series.push_back({.label = "1e-14 or less",
                               .points = {{*first, floor}, {*last, floor}},
                               .markers = false,
                               .style = 2 * (black + 1) + black,
                               .reference = true});
    }
    return plot;
}

/// Panels for up to three quantities: c11 at rest, at a frequency and with friction where there are more.
study::Plot pictures(const std::vector<Quantity>& quantities, const std::vector<study::Row>& rows,
                     const std::vector<Point>& points) {
    std::vector<std::string> shown;
    for (const Quantity& quantity : quantities) {
        const bool drawn = std::any_of(rows.begin(), rows.end(), [&](const study::Row& cells) {
            return cells[2].text() == quantity.name && cells[4].number().has_value();
        });
        if (!drawn) continue;
        const bool chosen = quantity.name == "c11" || quantity.name == "c11_z5" || quantity.name == "friction_force";
        if (quantities.size() <= 3 || chosen) shown.push_back(quantity.name);
    }
    if (shown.empty()) shown.push_back(quantities.front().name);
    study::Plot plot = panel(shown.front(), rows, points);
    for (std::size_t i = 1; i < shown.size(); ++i) plot.beside.push_back(panel(shown[i], rows, points));
    return plot;
}

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options("precision_study",
                           "Error against run time: which scheme gives a required precision at the least cost?");
    const std::string fixed = "the schemes of this study say where and how the equations are taken; see --schemes";
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
    options.add("schemes", "LIST", "all, or some of " + study::join(precision::scheme_names(), ","), "all");
    options.add("quantity", "LIST",
                "all, or some of c11,traction,c11_z0.1,c11_z1,c11_z5 (z = omega a/V),step_force,friction_force,"
                "combined_force,load_force",
                "all");
    options.add_input(
        "front",
        "compute nothing: read rows written before (shards put together), fill on_front, and draw or search "
        "them");
    options.add_output(
        "cheapest",
        "CSV file: for every quantity and tolerance 1e-2 ... 1e-12 the fastest element scheme, the fastest "
        "stable one, the fastest stable one of elements and Chebyshev states, and the fastest of all");
    options.footer(
        "Example: everything, with the cheapest schemes and a picture\n"
        "  precision_study --output precision.csv --cheapest cheapest.csv --plot precision.svg\n"
        "\n"
        "One row per scheme, n and quantity. n counts elements, of the finer mesh where two (n/2 and n) are\n"
        "extrapolated; for chebyshev-states it is the number of states (without --n from 1 to 48), for polynomial,\n"
        "the paper's approach, the order; the closed form has none. relative_error is against the closed forms of the\n"
        "plane model. traction: the norm of the differences to Carter's mean traction of each element\n"
        "over that of the mean tractions, both with the weight sqrt(1 - x^2/a^2) - without it Carter's traction,\n"
        "which is singular at the trailing edge, has no such norm, and with it the norm bounds the error of the "
        "force.\n"
        "step_force: the largest relative error at q/a = 1, 2, ... 10 after a step of creepage, exact in time.\n"
        "friction_force: creepage ratio 0.5. closed-form: the difference of two closed forms where there are two.\n"
        "combined_force: creepage ratio 0.5 at 45 degrees to the rolling direction; the error of the force as a\n"
        "vector, |F - reference| over |reference|. load_force: creepage ratio 0.5 from steady rolling over a period\n"
        "of a load N = N_0 (1 + 0.5 sin(2 pi q/(8 a_0))), in 160 steps of sdirk2; the largest error of F/(mu N_0).\n"
        "Graded meshes by collocation breathe with the half-length where the kernel is plane; all others stay on the\n"
        "largest contact. Neither has a closed form: references are extrapolated from cosine meshes of 320 and 640\n"
        "elements (160 and 320 that breathe, in 640 steps), to about 1e-5 and 4e-6.\n"
        "time_us: from the mesh to the result, the median of at least 5 runs; all schemes take turns. stable: no\n"
        "eigenvalue grows, as computed. on_front: no other scheme is as fast and as precise; an error counts as the\n"
        "largest of its scheme at this and every larger n, so that no change of sign passes for precision. It is\n"
        "empty for polynomial and closed-form, and with --shard or --jobs above 1, where times lack: put the shards\n"
        "together and use --front. With the strip kernel model_error is what the model alone makes of the error.\n"
        "status: ok, or why relative_error is empty, by the library's names; in the file of --cheapest none where no\n"
        "scheme reaches the tolerance. size_ratio and epsilon are empty but for geometric and knothe.\n"
        "Without --n, c11_z* stop at n = 320, step_force and those of friction at 160: two to three minutes in all.\n");

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        const std::vector<Quantity> quantities = chosen_quantities(given);
        if (given.given("shard") || !study::has_times(given)) {
            given.ignored("cheapest", "with --shard or --jobs or --no-timing, where times lack; use --front");
        }
        study::Table table;
        table.columns = columns;
        std::vector<Point> read;
        std::optional<Computation> computed;
        if (given.given("front")) {
            // 2. Rows from a file.
            for (const char* name :
                 {"n", "schemes", "kernel", "aspect", "poisson", "size-ratio", "epsilon", "shard", "jobs"}) {
                given.ignored(name, "with --front");
            }
            read = read_points(given, quantities);
            precision::mark_front(read);
            table.rows_of_task.assign(read.size(), 1);
            table.compute = [&](std::size_t i, study::RowRange, const study::Emit& emit) { emit(row(read[i])); };
        } else {
            // 3. Or schemes to compute.
            computed.emplace(given, quantities);
            table.rows_of_task = computed->rows_of_task();
            table.prepare = [&](const auto& wanted, const auto& done) { computed->prepare(wanted, done); };
            table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
                computed->emit_rows(task, range, emit);
            };
        }
        const auto points = [&]() -> const std::vector<Point>& { return computed ? computed->points() : read; };
        table.plot = [&](const std::vector<study::Row>& rows) { return pictures(quantities, rows, points()); };

        // 4. The rows, and what they say about tolerances.
        std::optional<study::OutputFile> cheapest;
        if (given.given("cheapest")) cheapest.emplace(given.text("cheapest"), "--cheapest");
        study::write_table(given, table);
        if (cheapest) write_cheapest(*cheapest, points(), quantities);
        return study::exit_ok;
    });
}
