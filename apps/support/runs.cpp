#include "runs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "csv.hpp"
#include "input.hpp"
#include "scenes.hpp"

namespace study {

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

Steps read_steps(const Options& options) {
    const double dq = options.number("dq", positive()), until = options.number("until", positive());
    const double count = std::round(until / dq);
    options.require(until >= dq * (1 - 1e-12), "until", "be at least --dq");
    options.require(count <= 1e7, "until", "be at most 1e7 times --dq");
    options.require(std::abs(until / dq - count) <= 1e-9 * count, "until",  // 0.3/0.1 is rounded
                    "be a multiple of --dq = " + options.text("dq"));
    return {dq, static_cast<std::size_t>(count)};
}

rollbem::Integrator read_integrator(const Options& options, bool friction) {
    const std::vector<std::string> words = integrator_words(friction);
    return integrators.at(index_of(words, options.choice("integrator", words))).integrator;
}

}  // namespace

const NamedIntegrator& named(rollbem::Integrator integrator) {
    return *std::find_if(integrators.begin(), integrators.end(),
                         [=](const NamedIntegrator& each) { return each.integrator == integrator; });
}

Sine read_sine(const Options& options) {
    const auto sine = options.pair("sine");
    options.require(sine && sine->first != 0 && sine->second > 0, "sine",
                    "be AMP,OMEGA with AMP finite and not 0 and OMEGA > 0");
    return {sine->first, sine->second};
}

void add_run_options(Options& options, const HistoryColumns& columns, const std::string& mode, const std::string& load,
                     const std::string& breathing) {
    const std::string &main = columns.main(), creepage = option_of(main);
    const std::vector<std::string> all = columns.all();
    std::vector<std::string> own{"step", "ramp", "sine", "history", "dq", "until", "integrator"};
    options.add("step", "X", main + " X [dimensionless] from q = 0 on, not 0");
    options.add("ramp", "RATE", main + " RATE q/a [dimensionless], RATE not 0");
    options.add("sine", "AMP,OMEGA",
                main +
                    " AMP sin(OMEGA q/a) [dimensionless], AMP not 0, OMEGA in V/a above 0; steps of D take its chords, "
                    "which are too low by a fraction (OMEGA D)^2/12");
    options.add_input("history", "CSV file of the imposed quantities [dimensionless], with the column q_over_a and " +
                                     (all.size() == 1 ? main : "any of " + listed(all, "and")) +
                                     ": linear between its rows, zero before the first, constant after the last; two "
                                     "rows at one q_over_a make a jump");
    options.not_with({"ramp", "sine", "history"}, "step");
    options.not_with({"sine", "history"}, "ramp");
    options.not_with({"history"}, "sine");
    if (columns.friction()) {
        own = joined<std::string>(std::move(own), {"load-sine", "load", "breathing", "from"});
        for (const char* way : {"step", "ramp", "sine"}) options.not_with({creepage}, way);
        options.add("load-sine", "A,LENGTH",
                    "sinusoidal load N = N_0 (1 + A sin(2 pi q/LENGTH)), A [dimensionless] from -1 to 1, LENGTH [a_0] "
                    "above 0; constant load without it");
        options.add_input(
            "load",
            "CSV file of the load over the distance rolled, with the columns q_over_a [a_0], load_ratio = "
            "N/N_0 [dimensionless]" +
                load + "; linear between its rows, which must cover the run");
        options.not_with({"load"}, "load-sine");
        options.add_flag("breathing", breathing);
        options.add("from", "rest|steady", "state at the start of the run: rest, or steady rolling", "rest");
    }
    options.add("dq", "D", "distance rolled in a step [a], above 0", "0.05");
    options.add("until", "Q", "distance rolled in all [a], a multiple of --dq, up to 1e7 times", "10");
    options.add("integrator", "NAME", "integrator: " + listed(integrator_words(columns.friction(), true), "or"),
                integrators.front().word);
    for (const std::string& name : own) {
        if (!mode.empty()) Options::Added{options, name}.only_with({mode});
    }
}

void add_force(Options& options, const HistoryColumns& columns) {
    const std::string creepage = option_of(columns.main());
    options.add("force", "F",
                "given force -F_x/(mu N), in time -F_x/(mu N_0) [dimensionless], any finite, in place of --" +
                    creepage + ", which is found; in time a shift from rest reaches it before the contact rolls");
    options.not_with({creepage, "step", "ramp", "sine"}, "force");
}

Options::Added add_unchecked(Options& options) {
    return options.add_flag(
        "unchecked",
        "no check of the schemes: those that are unstable, may be unstable or do not converge are stepped, too");
}

bool Run::begins_with_shift() const {
    const auto jumps = [&](const std::string& column) {
        return !column.empty() && imposed.at(column, 0, true) != imposed.at(column, 0, false);
    };
    return !from_steady && (jumps(columns.shift[0]) || jumps(columns.shift[1]) || jumps("force"));
}

namespace {

const Rule not_zero{[](double value) { return std::isfinite(value) && value != 0; }, "be finite and not 0"};

/// The columns of --history, any of them and no others, or of --load, the first and all further ones or none.
History read_table(const Options& options, const std::string& name, const HistoryColumns& columns) {
    const bool imposes = name == "history";
    const std::vector<std::string> names = imposes ? columns.all() : columns.load;
    const bool any = imposes && names.size() > 1;
    const std::vector<std::string> further(names.begin() + (any ? 0 : 1), names.end());
    const std::vector<Numbers> read = read_columns(
        options, name, any ? "q_over_a" : "q_over_a," + names[0], join(further, imposes ? ";" : ","),
        [&](const auto& so_far, const auto& where) {
            if (imposes && so_far[0].back() < 0) {
                throw BadInput(where + ": q_over_a must be at least 0: rolling starts from rest there");
            }
            require_order(so_far[0], "q_over_a", where);
        },
        imposes ? names : std::vector<std::string>{});
    options.require(!read[0].empty(), name, "have at least one row below its header");
    History history(read[0]);
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (!read[k + 1].empty()) history.set(names[k], read[k + 1]);
    }
    const bool has_any =
        std::any_of(names.begin(), names.end(), [&](const auto& column) { return history.has(column); });
    options.require(has_any, name, "have a column of " + listed(names, "or"));
    return history;
}

/// What is imposed by --step, --ramp, --sine, --history and options that are called like a column, which give it a
/// constant value that holds to a rule.
History read_history(const Options& options, const HistoryColumns& columns, const Rule& rule) {
    History history;
    if (options.given("history")) history = read_table(options, "history", columns);
    if (options.given("step")) history.set(columns.main(), options.number("step", not_zero));
    if (options.given("ramp")) history.set_ramp(columns.main(), options.number("ramp", not_zero));
    if (options.given("sine")) history.set(columns.main(), read_sine(options));
    for (const std::string& column : columns.all()) {
        const std::string name = option_of(column);
        if (!options.has(name) || !options.given(name)) continue;
        if (history.has(column)) options.ignored(name, "with the column " + column + " of --history");
        history.set(column, options.number(name, rule));
    }
    if (history.has("force") && history.has(columns.main())) {
        throw BadInput("a force and a creepage along x must not be given together");
    }
    if (history.has("force") && history.has(columns.shift[0])) {
        throw BadInput("a force and a shift along x must not be given together: the shift follows from the force");
    }
    return history;
}

/// Throws BadInput if ratios at these places are no load of the run. Ratios of a `history` may stand twice at a place.
void require_load(const std::string& said, const Numbers& places, const Numbers& ratios, const Run& run,
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
                run.breathing ? " must be positive with --breathing" : " must be at least 0");
    }
    const double largest = *std::max_element(ratios.begin(), ratios.end());
    require(largest > 0, ": the largest load_ratio must be positive, not ", largest, "");
}

/// Adds the column load_ratio to the history of a run, and further ones of a table of --load.
void read_load(const Options& options, Run& run) {
    History& imposed = run.imposed;
    const bool by_sine = options.given("load-sine"), by_history = run.load_varies();
    for (const char* option : {"load-sine", "load"}) {
        if (by_history) options.ignored(option, "with the column load_ratio of --history");
    }
    for (const std::string& column : run.columns.load) {
        if (by_history || !imposed.has(column)) continue;
        throw BadInput(options.said("history") + " must have load_ratio with " + column);
    }
    if (!by_sine && !by_history && !options.given("load")) {
        return options.ignored("breathing", "without --load-sine, --load or the column load_ratio of --history");
    }
    options.ignored("pressure", "under a load that varies: how the contact of a table grows is not known");
    if (by_sine) {
        const auto sine = options.pair("load-sine");
        const bool small = sine && (run.breathing ? std::abs(sine->first) < 1 : std::abs(sine->first) <= 1);
        options.require(small && sine->second > 0, "load-sine",
                        std::string("be A,LENGTH with ") + (run.breathing ? "|A| < 1 with --breathing" : "|A| <= 1") +
                            " and LENGTH > 0");
        return imposed.set("load_ratio", {sine->first, 2 * std::numbers::pi / sine->second}, 1);
    }
    if (by_history) {
        return require_load(options.said("history"), imposed.places(), imposed.values("load_ratio"), run, true);
    }
    const History load = read_table(options, "load", run.columns);
    require_load(options.said("load"), load.places(), load.values("load_ratio"), run, false);
    imposed.add(load);
}

}  // namespace

Run read_run(const Options& options, const HistoryColumns& columns, const Rule& rule) {
    Run run{.columns = columns,
            .imposed = read_history(options, columns, rule),
            .steps = read_steps(options),
            .integrator = read_integrator(options, columns.friction()),
            .checked = !options.has("unchecked") || !options.flag("unchecked")};
    if (!columns.friction()) return run;
    run.from_steady = options.choice("from", {"rest", "steady"}) == "steady";
    run.breathing = options.flag("breathing");
    for (const std::string& column : columns.shift) {
        if (!run.from_steady || column.empty() || run.imposed.at(column, 0, true) == 0) continue;
        throw BadInput(column + " = " + Cell(run.imposed.at(column, 0, true)).text(6) +
                       " at q_over_a = 0 must be 0 with --from steady: a shift before rolling starts from rest");
    }
    read_load(options, run);
    return run;
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
