#include "load.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "support/csv.hpp"
#include "support/errors.hpp"

namespace patch {

AxisRatios Load::axes(double q) const {
    if (!further.empty() && !further[0].empty()) return {at(q, further[0]), at(q, further[1])};
    const double scale = std::cbrt(at(q));
    return {scale, scale};
}

AxisRatios Load::largest_axes() const {
    if (further.empty() || further[0].empty()) return {std::cbrt(largest()), std::cbrt(largest())};
    return {*std::max_element(further[0].begin(), further[0].end()),
            *std::max_element(further[1].begin(), further[1].end())};
}

std::optional<Load> read_load(const study::Options& options, double until) {
    std::optional<study::LoadHistory> history = study::read_load_history(options, until, "a_ratio,b_ratio");
    if (!history) return std::nullopt;
    const study::Rule rule = study::between(1e-3, 1e3);
    for (const study::Numbers& column : history->further) {
        for (const double ratio : column) {
            if (rule.holds(ratio)) continue;
            throw study::BadInput(options.said("load") + ": a_ratio and b_ratio must " + rule.text + ", not " +
                                  study::Cell(ratio).text(6));
        }
    }
    return Load{std::move(*history)};
}

}  // namespace patch
