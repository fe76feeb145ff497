// One driver in time for friction on lines and patches: steps divided where the load has a knot or where they have no
// solution, works, and the state at each row.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/friction/model.hpp>

#include "support/runs.hpp"
#include "support/sheet.hpp"

namespace friction {

/// A contact and what happens to it over the distance rolled q [a_0], at the rolling velocity 1, or as the column speed
/// has it. Motions are taken just before (or at) q, or `behind` it.
struct Rolling {
    rollbem::FrictionModel contact;
    const study::Run& run;  ///< steps in a_0; a force -F_x/full takes the place of the creepage along x
    double creepage_unit = 1, spin_unit = 1;  ///< of the columns
    double full = 1;                          ///< force of full sliding
    double a_0 = 1;
    std::function<rollbem::NormalLoad(double)> load_at{};  ///< at q; where it is not constant
    std::function<bool(double q)> fits{};                  ///< whether elements are small enough there

    /// Linear over a step.
    rollbem::Creepage creepage(double q, bool behind) const;
    /// Rigid displacement besides: where it jumps, without rolling, in dq's time.
    rollbem::Creepage shift(double q, bool behind) const;
    double speed(double q, bool behind) const;
    /// The duration of a step over which the speed is linear.
    double duration(double from, double to) const;
    /// The displacement of a jump at q; nothing where there is none. Where a force jumps, the displacement is still to
    /// be found.
    std::optional<rollbem::Creepage> jump(double q) const;
};

/// The state of a run at a row, in the units of the contact.
struct Moment {
    double q = 0;
    bool shifted = false;                                 ///< the row of the shift before rolling
    rollbem::FrictionStep step{};                         ///< the last one, also if it failed
    rollbem::Creepage creepage{0, 0, 0};                  ///< at the end, also if it was found
    rollbem::Creepage shift{0, 0, 0};                     ///< in this row, also if it was found
    double slip_work = 0, jump_work = 0, creep_work = 0;  ///< cumulative
    double elastic_energy = 0;
    int rounds = 0;        ///< of all steps of the row
    bool computed = true;  ///< false behind the end of the run
    bool valid = true;     ///< whether there are results
    std::string status{};
};

/// The last trial of a longitudinal creepage, or shift, with the force -F_x/full = `force`, searched from `guess`
/// on; no_solution where there is none.
rollbem::FrictionStep find_for_force(double force, double full, double guess,
                                     const std::function<rollbem::FrictionStep(double)>& trial);

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

/// The table of the run with each case, with a row for each step and for a shift before where there is one: make(case)
/// makes its Rolling, row(case, moment) its rows for the sheet. Runs that end early have no more results.
template <class Sheet, class Case, class Make, class Row>
study::Table rolling_table(const Sheet& sheet, const std::vector<Case>& cases, const study::Run& run, const Make& make,
                           const Row& row) {
    const std::size_t rows = run.steps.count + (run.begins_with_shift() ? 1 : 0);
    return study::run_table(sheet, cases, rows, make,
                            [row](const Rolling& rolling, const Case& one, study::RowRange range, const auto& emit) {
                                return roll(rolling, range, [&](const Moment& moment) { emit(row(one, moment)); });
                            });
}

}  // namespace friction
