// Runs in the time domain: their steps and integrator, a load that varies, steps that fail, and the exit code of a run
// that ended early. Units: a for distances (a_0, which belongs to N_0, where the load varies), N_0 for loads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <rollbem/rolling/run.hpp>
#include <rollbem/status.hpp>

#include "history.hpp"
#include "input.hpp"
#include "options.hpp"
#include "table.hpp"

namespace study {

/// An integrator as options and columns name it; all of them are in runs.cpp.
struct NamedIntegrator {
    rollbem::Integrator integrator;
    std::string word, meaning;
    int order;      ///< of works summed over steps
    bool friction;  ///< models with friction take it
};
const NamedIntegrator& named(rollbem::Integrator integrator);
inline std::string word(rollbem::Integrator integrator) { return named(integrator).word; }

/// Further words of columns called status.
inline constexpr const char* unresolved = "unresolved";        ///< a sine with fewer than six steps in a period
inline constexpr const char* after_failure = "after_failure";  ///< a step before has failed
inline constexpr const char* unchecked = "unchecked";  ///< ok, except for the checks that --unchecked leaves out

/// Steps of dq [a].
struct Steps {
    double dq;
    std::size_t count;
};

/// A run: its steps, what is imposed on it, and where it begins.
struct Run {
    HistoryColumns columns;
    History imposed;
    Steps steps;
    rollbem::Integrator integrator;
    bool checked;              ///< whether schemes must be stable and converge
    bool from_steady = false;  ///< begins in steady rolling, not at rest
    bool breathing = false;    ///< the mesh follows a contact whose load varies; otherwise it covers the largest one

    double until() const { return double(steps.count) * steps.dq; }
    bool by_force() const { return imposed.has("force"); }
    bool load_varies() const { return imposed.has("load_ratio"); }
    double load_ratio(double q) const { return load_varies() ? imposed.at("load_ratio", q) : 1; }
    /// Whether the first row shows a jump of a shift or force before rolling.
    bool begins_with_shift() const;
};

/// Declares --step, --ramp, --sine, --history, --dq, --until and --integrator, with friction also --load-sine, --load,
/// --breathing and --from, all for the option `mode` if that is not empty; the last two words are of --help.
void add_run_options(Options& options, const HistoryColumns& columns, const std::string& mode = "",
                     const std::string& load = "", const std::string& breathing = "");

/// --sine AMP,OMEGA. Throws BadInput unless both are finite, AMP is not 0 and OMEGA is positive.
Sine read_sine(const Options& options);

/// Declares --force, which friction may take in place of the creepage along x.
void add_force(Options& options, const HistoryColumns& columns);

/// Declares --unchecked.
Options::Added add_unchecked(Options& options);

/// The run that the options ask for: 1 to 1e7 steps, N/N_0 as the column load_ratio of its history, 1 + A sin(2 pi
/// q/LENGTH) by --load-sine, or of the table --load. Options that are called like a column give it a constant value,
/// which holds to a rule. Throws BadInput, also if the load is negative or jumps, or a shift comes before a run from
/// steady rolling.
Run read_run(const Options& options, const HistoryColumns& columns, const Rule& rule = finite());

/// The table of a run of `rows` rows with each case. make(case), as checks may take long, is called for all before any
/// row; then roll(run, case, range, emit) emits the results of these rows and returns why the run ended early.
template <class Sheet, class Case, class Make, class Roll>
Table run_table(const Sheet& sheet, const std::vector<Case>& cases, std::size_t rows, const Make& make,
                const Roll& roll) {
    struct Runs {
        std::vector<std::decay_t<std::invoke_result_t<Make, const Case&>>> of;
        std::vector<std::string> ended;
    };
    const auto runs = std::make_shared<Runs>();
    runs->ended.resize(cases.size());
    Table table = table_of(sheet.names(), cases, rows);
    table.prepare = [&cases, runs, make](const auto&, const auto& done) {
        for (const Case& one : cases) {
            runs->of.push_back(make(one));
            done(double(runs->of.size()) / double(cases.size()));
        }
    };
    table.compute = [&sheet, &cases, runs, roll](std::size_t task, RowRange range, const Emit& emit) {
        const Case& one = cases[task];
        runs->ended[task] = roll(runs->of[task], one, range, [&](const auto& result) { emit(sheet.row(one, result)); });
    };
    table.ended = [runs](std::size_t task) { return runs->ended[task]; };
    return table;
}

/// Rolls between two places by step(from, to), which moves on if its status is ok: divided at the knots in between, and
/// up to six times in halves where a step has no solution. Returns where a step failed for good; nothing if none did.
std::optional<double> roll(double from, double to, const Numbers& knots,
                           const std::function<rollbem::Status(double, double)>& step);

/// The reason why a run has no results from the step to q [a] on.
std::string why_ended(double q, rollbem::Status status);

}  // namespace study
