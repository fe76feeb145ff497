#include "load_history.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <utility>

#include "csv.hpp"
#include "errors.hpp"
#include "non_steady.hpp"

namespace study {

namespace {

LoadHistory load_of_sine(const Options& options, bool breathing) {
    const auto sine = options.pair("load-sine");
    const bool small = sine && (breathing ? std::abs(sine->first) < 1 : std::abs(sine->first) <= 1);
    if (!small || !(sine->second > 0)) {
        throw BadInput(options.said("load-sine") + " must be A,LENGTH with " +
                       (breathing ? "|A| < 1 where the mesh breathes" : "|A| <= 1") + " and LENGTH > 0");
    }
    return {.amplitude = sine->first, .length = sine->second, .breathing = breathing};
}

LoadHistory load_of_table(const Options& options, double until, bool breathing, const std::string& further) {
    Pairs pairs = read_pairs(options, "load", "q_over_a,load_ratio", finite(), further);
    LoadHistory history{.knots = std::move(pairs.places),
                        .ratios = std::move(pairs.values),
                        .further = std::move(pairs.further),
                        .breathing = breathing};
    const std::string said = options.said("load");
    if (history.knots.front() > 0 || history.knots.back() < until) {
        throw BadInput(said +
                       " must cover the run: its rows go from q_over_a = " + Cell(history.knots.front()).text(6) +
                       " to " + Cell(history.knots.back()).text(6) + ", the run from 0 to " + Cell(until).text(6));
    }
    const auto twin = std::adjacent_find(history.knots.begin(), history.knots.end());
    if (twin != history.knots.end()) {
        throw BadInput(said + " must have one row only at q_over_a = " + Cell(*twin).text(6));
    }
    for (const double ratio : history.ratios) {
        if (ratio > 1e12) {
            throw BadInput(said + ": load_ratio = " + Cell(ratio).text(6) + " must be at most 1e12");
        }
        if (!(breathing ? ratio > 0 : ratio >= 0)) {
            throw BadInput(said + ": load_ratio = " + Cell(ratio).text(6) + " must be " +
                           (breathing ? "positive where the mesh breathes" : "at least 0"));
        }
    }
    if (history.largest() <= 0) throw BadInput(said + ": the largest load_ratio must be positive");
    return history;
}

}  // namespace

double LoadHistory::at(double q) const {
    return knots.empty() ? 1 + amplitude * std::sin(2 * std::numbers::pi * q / length) : at(q, ratios);
}

double LoadHistory::at(double q, const Numbers& column) const {
    const auto next = std::upper_bound(knots.begin(), knots.end(), q);
    if (next == knots.end()) return column.back();
    if (next == knots.begin()) return column.front();
    const std::size_t j = static_cast<std::size_t>(std::distance(knots.begin(), next));
    const double part = (q - knots[j - 1]) / (knots[j] - knots[j - 1]);
    return column[j - 1] + part * (column[j] - column[j - 1]);
}

double LoadHistory::largest() const {
    return knots.empty() ? 1 + std::abs(amplitude) : *std::max_element(ratios.begin(), ratios.end());
}

bool LoadHistory::resolved(double dq) const { return !knots.empty() || resolves(2 * std::numbers::pi / length, dq); }

double LoadHistory::next_stop(double from, double to) const {
    const auto next = std::upper_bound(knots.begin(), knots.end(), from);
    return next == knots.end() ? to : std::min(*next, to);
}

void add_run_options(Options& options, const std::string& load, const std::string& breathing) {
    options
        .add("load-sine", "A,LENGTH",
             "load N = N_0 (1 + A sin(2 pi q/LENGTH)), |A| up to 1, LENGTH in a_0 above 0 (dimensionless)")
        .only_with({"transient"});
    options.add_input("load", "CSV file with the columns q_over_a,load_ratio" + load).only_with({"transient"});
    options.replaces("load-sine", {"load"});
    options.not_with({"load"}, "load-sine");
    options.only_with({"breathing"}, {"transient"});
    options.add_flag("breathing", breathing).only_with({"load-sine", "load"}, ": the contact does not change");
    options.add("from", "rest|steady", "the state that the run starts from", "rest").only_with({"transient"});
    add_steps(options, "transient");
    options.add("integrator", "NAME", "sdirk2 (second order) or implicit-euler (first)", "sdirk2")
        .only_with({"transient"});
}

std::optional<LoadHistory> read_load_history(const Options& options, double until, const std::string& further) {
    const bool breathing = options.flag("breathing");
    if (!options.given("load-sine") && !options.given("load")) return std::nullopt;
    options.ignored("pressure", "under a load that varies: how the contact of a table grows is not known");
    if (!options.given("load-sine")) return load_of_table(options, until, breathing, further);
    return load_of_sine(options, breathing);
}

}  // namespace study
