#include "runs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "csv.hpp"
#include "scenes.hpp"

namespace study {

void add_steps(Options& options, const std::string& mode) {
    const auto dq = options.add("dq", "D", "distance rolled in a step [a], above 0", "0.05");
    const auto until =
        options.add("until", "Q", "distance rolled in all [a], a multiple of --dq, up to 1e7 times", "10");
    if (mode.empty()) return;
    dq.only_with({mode});
    until.only_with({mode});
}

Steps read_steps(const Options& options) {
    const double dq = options.number("dq", positive()), until = options.number("until", positive());
    const double count = std::round(until / dq);
    options.require(until >= dq * (1 - 1e-12), "until", "be at least --dq");
    options.require(count <= 1e7, "until", "be at most 1e7 times --dq");
    options.require(std::abs(until / dq - count) <= 1e-9 * count, "until",  // 0.3/0.1 is rounded
                    "be a multiple of --dq = " + options.text("dq"));
    return {dq, static_cast<std::size_t>(count)};
}

namespace {

/// The first is the default.
const std::array<NamedIntegrator, 3> integrators{{
    {rollbem::Integrator::sdirk2, "sdirk2", "second order", 2, true},
    {rollbem::Integrator::implicit_euler, "implicit-euler", "first order", 1, true},
    {rollbem::Integrator::matrix_exponential, "exponential", "exact for creepage linear over a step", 2, false},
}};

/// The words of those for the model; models with friction take the first ones.
std::vector<std::string> integrator_words(bool friction, bool with_meaning = false) {
    std::vector<std::string> words;
    for (const NamedIntegrator& each : integrators) {
        if (each.friction || !friction) words.push_back(each.word + (with_meaning ? " (" + each.meaning + ")" : ""));
    }
    return words;
}

}  // namespace

const NamedIntegrator& named(rollbem::Integrator integrator) {
    return *std::find_if(integrators.begin(), integrators.end(),
                         [=](const NamedIntegrator& each) { return each.integrator == integrator; });
}

Options::Added add_integrator(Options& options, bool friction) {
    return options.add("integrator", "NAME", "integrator: " + listed(integrator_words(friction, true), "or"),
                       integrators.front().word);
}

rollbem::Integrator read_integrator(const Options& options, bool friction) {
    const std::vector<std::string> words = integrator_words(friction);
    return integrators.at(index_of(words, options.choice("integrator", words))).integrator;
}

void add_run_options(Options& options, const std::string& load, const std::string& breathing) {
    options
        .add("load-sine", "A,LENGTH",
             "sinusoidal load N = N_0 (1 + A sin(2 pi q/LENGTH)), A [dimensionless] from -1 to 1, LENGTH [a_0] above "
             "0; constant load without it")
        .only_with({"transient"});
    options
        .add_input("load",
                   "CSV file of the load over the distance rolled, with the columns q_over_a [a_0], load_ratio = N/N_0 "
                   "[dimensionless]" +
                       load + "; linear between its rows, which must cover the run")
        .only_with({"transient"})
        .not_with("load-sine");
    options.add_flag("breathing", breathing).only_with({"transient"});
    options.add("from", "rest|steady", "state at the start of the run: rest, or steady rolling", "rest")
        .only_with({"transient"});
    add_steps(options, "transient");
    add_integrator(options, true).only_with({"transient"});
}

RunSettings::RunSettings(const Options& options)
    : steps(read_steps(options)),
      from_steady(options.choice("from", {"rest", "steady"}) == "steady"),
      integrator(read_integrator(options, true)),
      breathing(options.flag("breathing")) {}

void require_no_first_shift(const RunSettings& run, const History& imposed, const HistoryColumns& columns) {
    for (const std::string& column : columns.shift) {
        if (run.from_steady && !column.empty() && imposed.at(column, 0, true) != 0)
            throw BadInput(column + " = " + Cell(imposed.at(column, 0, true)).text(6) +
                           " at q_over_a = 0 must be 0 with --from steady: a shift before rolling starts from rest");
    }
}

namespace {

/// A table of --load, whose first column holds the places.
std::vector<Numbers> read_load_table(const Options& options, const std::string& further) {
    std::vector<Numbers> columns =
        read_columns(options, "load", "q_over_a,load_ratio", further,
                     [](const auto& read, const auto& where) { require_order(read[0], "q_over_a", where); });
    options.require(!columns[0].empty(), "load", "have at least one row below its header");
    return columns;
}

/// Throws BadInput if ratios at these places are no load of the run. Ratios of a `history` may stand twice at a place.
void require_load(const std::string& said, const Numbers& places, const Numbers& ratios, const RunSettings& run,
                  bool by_history) {
    const auto require = [&](bool holds, const std::string& what, double value, const std::string& rest) {
        if (!holds) throw BadInput(said + what + Cell(value).text(6) + rest);
    };
    require(places.front() <= 0 && places.back() >= run.until(),
            " must cover the run: its rows go from q_over_a = " + Cell(places.front()).text(6) + " to ", places.back(),
            ", the run from 0 to " + Cell(run.until()).text(6));
    for (std::size_t k = 1; k < places.size(); ++k) {
        const bool jumps = ratios[k] != ratios[k - 1] || !by_history;
        require(places[k] > places[k - 1] || !jumps, " must have one row only at q_over_a = ", places[k],
                by_history ? ": the load cannot jump" : "");
    }
    for (const double ratio : ratios) {
        require(ratio <= 1e12, ": load_ratio = ", ratio, " must be at most 1e12");
        require(run.breathing ? ratio > 0 : ratio >= 0, ": load_ratio = ", ratio,
                run.breathing ? " must be positive where the mesh breathes" : " must be at least 0");
    }
    const double largest = *std::max_element(ratios.begin(), ratios.end());
    require(largest > 0, ": the largest load_ratio must be positive, not ", largest, "");
}

}  // namespace

void read_load(const Options& options, const RunSettings& run, History& imposed, const std::string& further) {
    const bool by_sine = options.given("load-sine"), by_history = imposed.has("load_ratio");
    for (const char* option : {"load-sine", "load"}) {
        if (by_history) options.ignored(option, "with the column load_ratio of --history");
    }
    if (!by_sine && !by_history && !options.given("load")) {
        return options.ignored("breathing", "without --load-sine, --load or the column load_ratio of --history");
    }
    options.ignored("pressure", "under a load that varies: how the contact of a table grows is not known");
    if (by_sine) {
        const auto sine = options.pair("load-sine");
        const bool small = sine && (run.breathing ? std::abs(sine->first) < 1 : std::abs(sine->first) <= 1);
        options.require(small && sine->second > 0, "load-sine",
                        std::string("be A,LENGTH with ") +
                            (run.breathing ? "|A| < 1 where the mesh breathes" : "|A| <= 1") + " and LENGTH > 0");
        return imposed.set("load_ratio", {sine->first, 2 * std::numbers::pi / sine->second}, 1);
    }
    if (by_history) {
        return require_load(options.said("history"), imposed.places(), imposed.values("load_ratio"), run, true);
    }
    std::vector<Numbers> table = read_load_table(options, further);
    require_load(options.said("load"), table[0], table[1], run, false);
    std::map<std::string, Numbers> columns{{"load_ratio", std::move(table[1])}};
    const std::vector<std::string> names = columns_of(further);
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (!table[k + 2].empty()) columns[names[k]] = std::move(table[k + 2]);
    }
    imposed.set(table[0], std::move(columns));
}

namespace {

constexpr int most_halvings = 6;

/// Rolls by one step, or without a solution by halves. Returns where a step failed for good.
std::optional<double> in_halves(double from, double to, const std::function<rollbem::Status(double, double)>& step,
                                int halvings) {
    const rollbem::Status status = step(from, to);
    if (status == rollbem::Status::ok) return std::nullopt;
    if (status != rollbem::Status::no_solution || halvings == 0) return to;
    const double middle = from + (to - from) / 2;
    if (const auto failed = in_halves(from, middle, step, halvings - 1)) return failed;
    return in_halves(middle, to, step, halvings - 1);
}

}  // namespace

std::optional<double> roll(double from, double to, const Numbers& knots,
                           const std::function<rollbem::Status(double, double)>& step) {
    while (from < to) {
        const auto knot = std::upper_bound(knots.begin(), knots.end(), from);
        const double stop = knot == knots.end() ? to : std::min(*knot, to);
        if (const auto failed = in_halves(from, stop, step, most_halvings)) return failed;
        from = stop;
    }
    return std::nullopt;
}

std::string why_ended(double q, rollbem::Status status) {
    const std::string where = "no results from the step to q/a = " + Cell(q).text(6) + " on: " + name(status);
    if (status == rollbem::Status::needs_fixed_mesh) {
        return where + ", the contact grows or shrinks as fast as it rolls; use --breathing=false";
    }
    if (status != rollbem::Status::no_solution || !(q > 0)) return where;
    return where + ", not even in steps of dq/" + std::to_string(1 << most_halvings);
}

}  // namespace study
