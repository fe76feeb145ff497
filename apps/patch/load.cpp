#include "load.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "support/csv.hpp"
#include "support/errors.hpp"

namespace patch {

AxisRatios Load::axes(double q) const {
    if (has_axes()) return {at(q, further[0]), at(q, further[1])};
    const double scale = std::cbrt(at(q));
    return {scale, scale};
}

AxisRatios Load::largest_axes() const {
    if (!has_axes()) return {std::cbrt(largest()), std::cbrt(largest())};
    return {*std::max_element(further[0].begin(), further[0].end()),
            *std::max_element(further[1].begin(), further[1].end())};
}

std::pair<double, double> Load::shapes() const {
    std::pair<double, double> range{1, 1};
    for (std::size_t i = 0; has_axes() && i < knots.size(); ++i) {  // between knots a/b is monotonic
        const double ratio = further[0][i] / further[1][i];
        range = {std::min(range.first, ratio), std::max(range.second, ratio)};
    }
    return range;
}

std::optional<Load> read_load(const study::Options& options, double until) {
    std::optional<study::LoadHistory> history = study::read_load_history(options, until, "a_ratio,b_ratio");
    if (!history) return std::nullopt;
    // of a shape of its own, which need not shrink with the load
    const bool has_axes = !history->further.empty() && !history->further[0].empty();
    if (has_axes && !options.given("breathing")) {
        history->breathing = *std::min_element(history->ratios.begin(), history->ratios.end()) > 0;
    }
    const study::Rule rule = study::between(1e-3, 1e3);
    for (const study::Numbers& column : history->further) {
        for (const double ratio : column) {
            if (rule.holds(ratio)) continue;
            throw study::BadInput(options.said("load") + ": a_ratio and b_ratio must " + rule.text + ", not " +
                                  study::Cell(ratio).text(6));
        }
    }
    return Load(std::move(*history));
}

}  // namespace patch
