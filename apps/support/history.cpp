#include "history.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "csv.hpp"

namespace study {

namespace {

const Rule not_zero{[](double value) { return std::isfinite(value) && value != 0; }, "be finite and not 0"};

}  // namespace

Sine read_sine(const Options& options) {
    const auto sine = options.pair("sine");
    options.require(sine && sine->first != 0 && sine->second > 0, "sine",
                    "be AMP,OMEGA with AMP finite and not 0 and OMEGA > 0");
    return {sine->first, sine->second};
}

double interpolate(const Numbers& places, const Numbers& values, double q, bool behind) {
    const auto next =
        behind ? std::upper_bound(places.begin(), places.end(), q) : std::lower_bound(places.begin(), places.end(), q);
    const auto j = static_cast<std::size_t>(next - places.begin());
    if (j == 0) return values.front();
    if (j == places.size()) return values.back();
    const double part = (q - places[j - 1]) / (places[j] - places[j - 1]);
    return values[j - 1] + part * (values[j] - values[j - 1]);
}

double History::at(const std::string& column, double q, bool behind) const {
    const auto found = signals_.find(column);
    return found == signals_.end() ? 0 : found->second(q, behind);
}

void History::set(const std::string& column, double value) {
    signals_[column] = [=](double q, bool behind) { return q > 0 || behind ? value : 0; };
}

void History::set(const std::string& column, const Sine& sine) {
    signals_[column] = [=](double q, bool) { return sine.amplitude * std::sin(sine.omega * q); };
    omega_ = sine.omega;
}

void History::set_ramp(const std::string& column, double rate) {
    signals_[column] = [=](double q, bool) { return rate * q; };
}

void History::set(Numbers places, std::map<std::string, Numbers> columns) {
    for (const auto& [column, values] : columns) {
        signals_[column] = [=, values = values](double q, bool behind) {
            const bool begun = behind ? q >= places.front() : q > places.front();
            return begun ? interpolate(places, values, q, behind) : 0;
        };
    }
    places_ = std::move(places);
    tables_ = std::move(columns);
}

const Numbers& History::values(const std::string& column) const {
    static const Numbers none;
    const auto found = tables_.find(column);
    return found == tables_.end() ? none : found->second;
}

std::vector<std::string> HistoryColumns::all() const { return joined<std::string>({main}, others); }

void add_history_options(Options& options, const HistoryColumns& columns, const std::string& mode) {
    const std::string& main = columns.main;
    options.add("step", "X", main + " X from q = 0 on, not 0 (dimensionless)");
    options.add("ramp", "RATE", main + " RATE q/a, not 0 (dimensionless)");
    options.add("sine", "AMP,OMEGA",
                main +
                    " AMP sin(OMEGA q/a), AMP not 0, OMEGA in V/a above 0; steps take its chords, which are too "
                    "low by a fraction (OMEGA D)^2/12 (dimensionless)");
    options.add_input("history", "CSV file with the column q_over_a and " +
                                     (columns.others.empty() ? main : "any of " + listed(columns.all(), "and")) +
                                     "; linear between its rows, zero before the first, constant after the last; two "
                                     "rows at one q_over_a make a jump (dimensionless)");
    options.not_with({"ramp", "sine", "history"}, "step");
    options.not_with({"sine", "history"}, "ramp");
    options.not_with({"history"}, "sine");
    if (!mode.empty()) options.only_with({"step", "ramp", "sine", "history"}, {mode});
}

namespace {

History read_table(const Options& options, const HistoryColumns& columns) {
    const std::vector<std::string> names = columns.all();
    const std::string others = join(columns.others, ";");
    const bool one = columns.others.empty();
    std::vector<Numbers> read = read_columns(
        options, "history", one ? "q_over_a," + columns.main : "q_over_a", one ? "" : columns.main + ";" + others,
        [&](const auto& so_far, const auto& where) {
            const Numbers& places = so_far[0];
            const std::size_t last = places.size() - 1;
            if (places[last] < 0) {
                throw BadInput(where + ": q_over_a must be at least 0: rolling starts from rest there");
            }
            if (last > 0 && places[last] < places[last - 1]) {
                throw BadInput(where + " must not lie before the line above it");
            }
            if (last > 1 && places[last] == places[last - 2]) {
                throw BadInput(where + " must not be the third row at one q_over_a: two make a jump");
            }
        },
        names);
    options.require(!read[0].empty(), "history", "have at least one row below its header");
    std::map<std::string, Numbers> found;
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (!read[k + 1].empty()) found[names[k]] = std::move(read[k + 1]);
    }
    options.require(!found.empty(), "history", "have a column of " + listed(names, "or"));
    History history;
    history.set(std::move(read[0]), std::move(found));
    return history;
}

}  // namespace

std::optional<History> read_history(const Options& options, const HistoryColumns& columns) {
    History history;
    if (options.given("step")) {
        history.set(columns.main, options.number("step", not_zero));
    } else if (options.given("ramp")) {
        history.set_ramp(columns.main, options.number("ramp", not_zero));
    } else if (options.given("sine")) {
        history.set(columns.main, read_sine(options));
    } else if (options.given("history")) {
        return read_table(options, columns);
    } else {
        return std::nullopt;
    }
    return history;
}

}  // namespace study
