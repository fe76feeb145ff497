#include "load.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>

#include <rollbem/normal/hertz.hpp>

#include "pressure.hpp"
#include "support/columns_file.hpp"
#include "support/errors.hpp"
#include "support/non_steady.hpp"

namespace friction {

namespace {

LoadHistory load_of_sine(const study::Options& options, bool breathing) {
    const std::string text = options.text("load-sine");
    const std::size_t comma = text.find(',');
    const auto amplitude = study::detail::parse_number<double>(study::detail::trim(text.substr(0, comma)));
    const auto length = comma == std::string::npos
                            ? std::nullopt
                            : study::detail::parse_number<double>(study::detail::trim(text.substr(comma + 1)));
    const bool possible = amplitude && length && (breathing ? std::abs(*amplitude) < 1 : std::abs(*amplitude) <= 1) &&
                          *length > 0 && std::isfinite(*length);
    if (!possible) {
        throw study::BadInput(options.said("load-sine") + " must be A,LENGTH with " +
                              (breathing ? "|A| < 1 where the mesh breathes" : "|A| <= 1") + " and LENGTH > 0");
    }
    return {.amplitude = *amplitude, .length = *length, .breathing = breathing};
}

LoadHistory load_of_table(const study::Options& options, double until, bool breathing) {
    study::Pairs pairs = study::read_pairs(options, "load", "q_over_a,load_ratio", study::finite());
    LoadHistory history{.knots = std::move(pairs.places), .ratios = std::move(pairs.values), .breathing = breathing};
    const std::string said = options.said("load");
    if (history.knots.front() > 0 || history.knots.back() < until) {
        throw study::BadInput(
            said + " must cover the run: its rows go from q_over_a = " + study::Cell(history.knots.front()).text(6) +
            " to " + study::Cell(history.knots.back()).text(6) + ", the run from 0 to " + study::Cell(until).text(6));
    }
    const auto twin = std::adjacent_find(history.knots.begin(), history.knots.end());
    if (twin != history.knots.end()) {
        throw study::BadInput(said + " must have one row only at q_over_a = " + study::Cell(*twin).text(6));
    }
    for (const double ratio : history.ratios) {
        if (ratio > 1e12) {
            throw study::BadInput(said + ": load_ratio = " + study::Cell(ratio).text(6) + " must be at most 1e12");
        }
        if (!(breathing ? ratio > 0 : ratio >= 0)) {
            throw study::BadInput(said + ": load_ratio = " + study::Cell(ratio).text(6) + " must be " +
                                  (breathing ? "positive where the mesh breathes" : "at least 0"));
        }
    }
    if (*std::max_element(history.ratios.begin(), history.ratios.end()) <= 0) {
        throw study::BadInput(said + ": the largest load_ratio must be positive");
    }
    return history;
}

}  // namespace

double LoadHistory::at(double q) const {
    if (knots.empty()) return 1 + amplitude * std::sin(2 * std::numbers::pi * q / length);
    const auto next = std::upper_bound(knots.begin(), knots.end(), q);
    if (next == knots.end()) return ratios.back();
    if (next == knots.begin()) return ratios.front();
    const std::size_t j = static_cast<std::size_t>(std::distance(knots.begin(), next));
    const double part = (q - knots[j - 1]) / (knots[j] - knots[j - 1]);
    return ratios[j - 1] + part * (ratios[j] - ratios[j - 1]);
}

bool LoadHistory::resolved(double dq) const {
    return !knots.empty() || study::resolves(2 * std::numbers::pi / length, dq);
}

double LoadHistory::largest_half_length() const {
    return std::sqrt(knots.empty() ? 1 + std::abs(amplitude) : *std::max_element(ratios.begin(), ratios.end()));
}

double LoadHistory::next_stop(double from, double to) const {
    const auto next = std::upper_bound(knots.begin(), knots.end(), from);
    return next == knots.end() ? to : std::min(*next, to);
}

std::optional<LoadHistory> read_load(const study::Options& options, double until) {
    const bool breathing = options.flag("breathing");
    if (!options.given("load-sine") && !options.given("load")) {
        options.ignored("breathing", "without --load-sine or --load: the half-length does not change");
        return std::nullopt;
    }
    if (options.given("load-sine")) options.ignored("load", "with --load-sine");
    options.ignored("pressure", "under a load that varies: how the contact of a table grows is not known");
    if (breathing && options.text("kernel") != "plane") {
        throw study::BadInput("--kernel = " + options.text("kernel") +
                              " must be plane with --breathing: only that kernel knows other half-lengths");
    }
    return options.given("load-sine") ? load_of_sine(options, breathing) : load_of_table(options, until, breathing);
}

rollbem::HertzLoad<double> hertz_load(const LoadHistory& history, const rollbem::Mesh<double>& mesh) {
    const auto line = rollbem::HertzLine<double>::dimensionless();
    return history.breathing ? rollbem::HertzLoad<double>::breathing(line, mesh)
                             : rollbem::HertzLoad<double>::fixed(line, mesh, history.largest_half_length());
}

}  // namespace friction
