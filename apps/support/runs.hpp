// Runs in the time domain: their steps and integrator, a load that varies, steps that fail, and the exit code of a run
// that ended early. Units: a for distances (a_0, which belongs to N_0, where the load varies), N_0 for loads.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/rolling/integrator.hpp>
#include <rollbem/status.hpp>

#include "history.hpp"
#include "input.hpp"
#include "options.hpp"
#include "table.hpp"

namespace study {

/// Declares --dq and --until, and reads them as 1 to 1e7 steps of dq, in units of a. With `mode`, only that option
/// makes steps. Throws BadInput.
struct Steps {
    double dq;
    std::size_t count;
};
void add_steps(Options& options, const std::string& mode = "");
Steps read_steps(const Options& options);

/// An integrator as options and columns name it; all of them are in runs.cpp.
struct NamedIntegrator {
    rollbem::Integrator integrator;
    std::string word, meaning;
    int order;      ///< of works summed over steps
    bool friction;  ///< models with friction take it
};
const NamedIntegrator& named(rollbem::Integrator integrator);
inline std::string word(rollbem::Integrator integrator) { return named(integrator).word; }

/// Declares --integrator, and reads it; with `friction`, one of those that models with friction take. Throws BadInput.
Options::Added add_integrator(Options& options, bool friction);
rollbem::Integrator read_integrator(const Options& options, bool friction);

/// Further words of columns called status.
inline constexpr const char* unresolved = "unresolved";        ///< a sine with fewer than six steps in a period
inline constexpr const char* after_failure = "after_failure";  ///< a step before has failed
inline constexpr const char* unchecked = "unchecked";  ///< ok, except for the checks that --unchecked leaves out

/// Declares the options of runs with friction: --load-sine, --load, --breathing, --from, --dq, --until and
/// --integrator, all for --transient. `load` and `breathing` are what --help says of these besides.
void add_run_options(Options& options, const std::string& load, const std::string& breathing);

/// The values of --breathing, --from, --dq, --until and --integrator. Throws BadInput.
struct RunSettings {
    Steps steps;
    bool from_steady;
    rollbem::Integrator integrator;
    bool breathing;  ///< the mesh follows a contact whose load varies; otherwise it covers the largest one

    explicit RunSettings(const Options& options);
    double until() const { return double(steps.count) * steps.dq; }
};

/// Adds N/N_0, the column load_ratio, of --load-sine or --load to the history `imposed` on a run:
/// 1 + A sin(2 pi q/LENGTH), lengths in a_0, or a table, which may have the columns `further` besides. Throws BadInput,
/// also if the values are no load, or jump.
void read_load(const Options& options, const RunSettings& run, History& imposed, const std::string& further = "");

/// Refuses a shift before rolling in a run from steady rolling. Throws BadInput.
void require_no_first_shift(const RunSettings& run, const History& imposed, const HistoryColumns& columns);

/// Fills `runs` with make(case) for each of the cases before any task is computed, as checks may take long.
template <class Run, class Case, class Make>
void prepare_runs(Table& table, std::vector<Run>& runs, const std::vector<Case>& cases, const Make& make) {
    table.prepare = [&, make](const auto&, const auto& done) {
        for (const Case& one : cases) {
            runs.push_back(make(one));
            done(double(runs.size()) / double(cases.size()));
        }
    };
}

/// Rolls between two places by step(from, to), which moves on if its status is ok: divided at the knots in between, and
/// up to six times in halves where a step has no solution. Returns where a step failed for good; nothing if none did.
std::optional<double> roll(double from, double to, const Numbers& knots,
                           const std::function<rollbem::Status(double, double)>& step);

/// The reason why a run has no results from the step to q [a] on.
std::string why_ended(double q, rollbem::Status status);

}  // namespace study
