// One driver in time for friction on lines and patches: steps divided where the load has a knot or where they have no
// solution, works, and what each row has come to.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/friction/friction_contact.hpp>

#include "support/runs.hpp"
#include "support/sheet.hpp"

namespace friction {

/// A contact and what happens to it over the distance rolled q [a_0], at the rolling velocity 1.
struct Rolling {
    rollbem::FrictionContact contact;
    study::RunSettings run;                                       ///< steps in a_0
    std::function<rollbem::Creepage<double>(double q)> creepage;  ///< linear over a step
    std::optional<rollbem::Creepage<double>> shift{};  ///< rigid, before rolling; it takes as long as a step of dq
    double a_0 = 1;
    study::Numbers knots{};                                        ///< of the load
    std::function<rollbem::NormalLoad<double>(double)> load_at{};  ///< at q; where it is not constant
    std::function<bool(double q)> resolved{};  ///< whether steps and elements are small enough there
    bool checked = true;                       ///< whether the scheme is known to be stable
};

/// What a row has come to, in the units of the contact.
struct Moment {
    double q = 0;
    bool shifted = false;                                 ///< the row of the shift
    rollbem::FrictionStep<2> step{};                      ///< the last one, also if it failed
    double slip_work = 0, jump_work = 0, creep_work = 0;  ///< cumulative
    double elastic_energy = 0;
    int rounds = 0;        ///< of all steps of the row
    bool computed = true;  ///< false behind the end of the run
    bool valid = true;     ///< whether there are results
    std::string status{};
};

/// Rolls from the start, as the state requires, and emits the rows of `range`. Returns why the run ended before these
/// rows did; nothing if it did not.
std::string roll(const Rolling& rolling, study::RowRange range, const std::function<void(const Moment&)>& emit);

/// A column's value in rows that have results, and in rows of a run that has not ended.
template <class Value>
auto if_valid(const Value& value) {
    return study::where([](const auto& r) { return r.moment.valid; }, value);
}
template <class Value>
auto if_computed(const Value& value) {
    return study::where([](const auto& r) { return r.moment.computed; }, value);
}

/// Writes the table of a run of each case, `rows` long: prepare(case) makes its Rolling, row(case, moment) its
/// rows for the sheet, plot(rows) the picture. Throws what these and write_runs throw.
template <class Sheet, class Case, class Prepare, class Row, class Draw>
void write_rolling(const study::Options& options, const Sheet& sheet, const std::vector<Case>& cases, std::size_t rows,
                   const Prepare& prepare, const Row& row, const Draw& plot) {
    const auto runs = study::prepared<Rolling>(options, cases, prepare);
    std::vector<std::string> ended(cases.size());
    study::Table table = study::table_of(sheet.names(), cases, rows);
    table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
        ended[task] = roll(runs[task], range,
                           [&](const Moment& moment) { emit(sheet.row(cases[task], row(cases[task], moment))); });
    };
    table.plot = plot;
    study::write_runs(options, table, ended);
}

}  // namespace friction
