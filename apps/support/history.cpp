#include "history.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "csv.hpp"

namespace study {

namespace {

const Rule not_zero{[](double value) { return std::isfinite(value) && value != 0; }, "be finite and not 0"};

/// The value at q between places that ascend, linear, and constant beyond them. Two equal places make a
/// jump, where the value is the one before it unless `behind`.
double interpolate(const Numbers& places, const Numbers& values, double q, bool behind) {
    const auto next =
        behind ? std::upper_bound(places.begin(), places.end(), q) : std::lower_bound(places.begin(), places.end(), q);
    const auto j = static_cast<std::size_t>(next - places.begin());
    if (j == 0) return values.front();
    if (j == places.size()) return values.back();
    const double part = (q - places[j - 1]) / (places[j] - places[j - 1]);
    return values[j - 1] + part * (values[j] - values[j - 1]);
}

}  // namespace

Sine read_sine(const Options& options) {
    const auto sine = options.pair("sine");
    options.require(sine && sine->first != 0 && sine->second > 0, "sine",
                    "be AMP,OMEGA with AMP finite and not 0 and OMEGA > 0");
    return {sine->first, sine->second};
}

double History::at(const std::string& column, double q, bool behind) const {
    const auto found = signals_.find(column);
    return found == signals_.end() ? 0 : found->second.at(q, behind);
}

void History::set(const std::string& column, double value) {
    signals_[column] = {[=](double q, bool behind) { return q > 0 || behind ? value : 0; }};
}

void History::set(const std::string& column, const Sine& sine, double mean) {
    signals_[column] = {[=](double q, bool) { return mean + sine.amplitude * std::sin(sine.omega * q); },
                        mean + std::abs(sine.amplitude)};
    omega_ = std::max(omega_, sine.omega);
}

void History::set_ramp(const std::string& column, double rate) {
    signals_[column] = {[=](double q, bool) { return rate * q; }};
}

void History::set(const Numbers& places, std::map<std::string, Numbers> columns) {
    for (auto& [column, values] : columns) {
        const auto at = [places, values = values](double q, bool behind) {
            if (behind ? q < places.front() : q <= places.front()) return 0.0;
            return interpolate(places, values, q, behind);
        };
        const double largest = *std::max_element(values.begin(), values.end());
        signals_[column] = {at, largest, std::move(values)};
    }
    Numbers all;
    std::merge(places_.begin(), places_.end(), places.begin(), places.end(), std::back_inserter(all));
    places_ = std::move(all);
}

const Numbers& History::values(const std::string& column) const {
    static const Numbers none;
    const auto found = signals_.find(column);
    return found == signals_.end() ? none : found->second.values;
}

std::vector<std::string> HistoryColumns::all() const {
    std::vector<std::string> names(creepage.begin(), creepage.end());
    names.insert(names.end(), shift.begin(), shift.end());
    if (friction()) names.emplace_back("force");
    std::erase(names, "");
    return joined(joined(std::move(names), load), others);
}

HistoryTable read_history_table(const Options& options, const std::string& name, const std::string& needed,
                                const std::string& further, bool only) {
    std::string list = needed + "," + further;
    std::replace(list.begin(), list.end(), ';', ',');
    std::vector<std::string> names = cells_of(list);
    std::erase(names, "");
    std::vector<Numbers> read = read_columns(
        options, name, "q_over_a" + (needed.empty() ? "" : "," + needed), further,
        [&](const auto& so_far, const auto& where) {
            if (only && so_far[0].back() < 0) {
                throw BadInput(where + ": q_over_a must be at least 0: rolling starts from rest there");
            }
            require_order(so_far[0], "q_over_a", where);
        },
        only ? names : std::vector<std::string>{});
    options.require(!read[0].empty(), name, "have at least one row below its header");
    HistoryTable table{std::move(read[0]), {}};
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (!read[k + 1].empty()) table.columns[names[k]] = std::move(read[k + 1]);
    }
    options.require(!table.columns.empty(), name, "have a column of " + listed(names, "or"));
    return table;
}

void add_history_options(Options& options, const HistoryColumns& columns) {
    const std::string& main = columns.main();
    const std::vector<std::string> all = columns.all();
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
}

History read_history(const Options& options, const HistoryColumns& columns, const Rule& rule) {
    const std::vector<std::string> all = columns.all();
    History history;
    if (options.given("step")) history.set(columns.main(), options.number("step", not_zero));
    if (options.given("ramp")) history.set_ramp(columns.main(), options.number("ramp", not_zero));
    if (options.given("sine")) history.set(columns.main(), read_sine(options));
    if (options.given("history")) {
        const bool one = all.size() == 1;
        HistoryTable table = read_history_table(options, "history", one ? all[0] : "", one ? "" : join(all, ";"), true);
        history.set(table.places, std::move(table.columns));
    }
    for (const std::string& column : all) {
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

}  // namespace study
