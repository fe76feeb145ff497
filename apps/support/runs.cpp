#include "runs.hpp"

#include <cstddef>
#include <stdexcept>

#include "csv.hpp"
#include "errors.hpp"

namespace study {

namespace {

/// One line for the runs that ended early, which names the first; empty if there are none.
std::string early_ends(const Table& table, const std::vector<std::string>& ended) {
    std::string text;
    std::size_t count = 0;
    for (std::size_t i = 0; i < ended.size(); ++i) {
        if (!ended[i].empty() && count++ == 0) text = table.label(i) + ": " + ended[i];
    }
    if (count > 1) {
        text += "; " + std::to_string(count - 1) + " more of " + std::to_string(ended.size()) + " runs ended";
    }
    return text;
}

/// Rolls by one step, or without a solution by halves. Returns where a step failed for good.
std::optional<double> in_halves(double from, double to, const std::function<rollbem::StepStatus(double, double)>& step,
                                int halvings) {
    const rollbem::StepStatus status = step(from, to);
    if (status == rollbem::StepStatus::ok) return std::nullopt;
    if (status != rollbem::StepStatus::no_solution || halvings == 0) return to;
    const double middle = from + (to - from) / 2;
    if (const auto failed = in_halves(from, middle, step, halvings - 1)) return failed;
    return in_halves(middle, to, step, halvings - 1);
}

}  // namespace

std::optional<double> roll(double from, double to, const LoadHistory* load,
                           const std::function<rollbem::StepStatus(double, double)>& step) {
    while (from < to) {
        const double stop = load != nullptr ? load->next_stop(from, to) : to;
        if (const auto failed = in_halves(from, stop, step, most_halvings)) return failed;
        from = stop;
    }
    return std::nullopt;
}

std::string why_ended(double q, rollbem::StepStatus status) {
    const std::string where = "no results from the step to q/a = " + Cell(q).text(6) + " on: " + name(status);
    switch (status) {
        case rollbem::StepStatus::needs_fixed_mesh:
            return where + ", the contact grows or shrinks as fast as it rolls; use --breathing=false";
        case rollbem::StepStatus::no_solution:
            return q > 0 ? where + ", not even in steps of dq/" + std::to_string(1 << most_halvings) : where;
        default: return where;
    }
}

void write_runs(const Options& options, const Table& table, const std::vector<std::string>& ended) {
    std::string undrawn;
    try {
        write_table(options, table);
    } catch (const PlotError& error) {
        undrawn = error.what();
    }
    const std::string early = early_ends(table, ended);
    if (!early.empty()) throw std::runtime_error(undrawn.empty() ? early : early + "; " + undrawn);
    if (!undrawn.empty()) throw PlotError(undrawn);
}

}  // namespace study
