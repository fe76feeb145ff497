// The pictures of precision_study.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "comparison.hpp"

namespace precision {

namespace {

constexpr double floor = 1e-14;  // smaller errors are round-off, or 0, which a logarithmic axis cannot show

std::string title_of(const Quantity& quantity) {
    if (quantity.name == "c11") return "c_{11} in steady rolling";
    if (quantity.problem == Problem::harmonic) return "c_{11} at ω a/V = " + study::Cell(quantity.frequency).text(6);
    std::string title;
    for (const char c : quantity.name) title += c == '_' ? ' ' : c;  // to gnuplot the start of a subscript
    return title;
}

/// A panel for one quantity: the error of every scheme over its time, and the front with the errors that put it there.
/// Errors below 1e-14 are drawn there.
study::Plot panel(const Quantity& shown, const std::vector<study::Row>& rows, const std::vector<Point>& points) {
    const std::string& quantity = shown.name;
    study::Plot plot{.title = title_of(shown),
                     .x_label = "time [microseconds]",
                     .y_label = quantity == "patch_force" ? "largest error of F_x, F_y over μ N" : "|relative error|",
                     .log_x = true,
                     .log_y = true};
    study::Series front{.label = "Pareto front", .markers = false, .reference = true};
    const std::vector<double> sustained = sustained_errors(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].quantity != quantity || !points[i].on_front.value_or(false)) continue;
        front.points.emplace_back(*points[i].time_us, std::max(sustained[i], floor));
    }
    std::sort(front.points.begin(), front.points.end());
    front.markers = front.points.size() == 1;
    std::vector<std::string> schemes = study::joined(line_schemes(), patch_schemes());
    for (std::size_t style = 0; style < schemes.size(); ++style) {  // the same in all panels
        const std::string& scheme = schemes[style];
        study::Series series{.label = scheme, .style = style};
        for (const study::Row& cells : rows) {
            if (cells[0].text() != scheme || cells[2].text() != quantity) continue;
            const std::optional<double> error = cells[3].number(), time = cells[4].number();
            if (!error || !time) continue;
            if (scheme == "closed-form" && *error == 0) continue;  // the reference itself
            series.points.emplace_back(*time, std::max(std::abs(*error), floor));
        }
        const auto same = [&](const study::Series& other) { return other.label == scheme; };
        if (series.points.empty() || std::any_of(plot.series.begin(), plot.series.end(), same)) continue;
        plot.series.push_back(std::move(series));
    }
    if (!front.points.empty()) plot.series.push_back(std::move(front));
    return plot;
}

}  // namespace

study::Plot pictures(const std::vector<Quantity>& quantities, const std::vector<study::Row>& rows,
                     const std::vector<Point>& points) {
    constexpr std::size_t most = 3;
    const auto has_times = [&](const Quantity& quantity) {
        return std::any_of(rows.begin(), rows.end(), [&](const study::Row& cells) {
            return cells[2].text() == quantity.name && cells[4].number().has_value();
        });
    };
    std::vector<Quantity> all, shown;
    std::copy_if(quantities.begin(), quantities.end(), std::back_inserter(all), has_times);
    if (all.empty()) all.push_back(quantities.front());
    if (all.size() > most) {
        const std::vector<std::string> usual{"c11", "c11_z5", "friction_force"};
        std::copy_if(all.begin(), all.end(), std::back_inserter(shown),
                     [&](const Quantity& quantity) { return study::contains(usual, quantity.name); });
    }
    if (shown.empty()) shown.assign(all.begin(), all.begin() + std::ptrdiff_t(std::min(most, all.size())));
    std::vector<study::Plot> panels;
    for (const Quantity& quantity : shown) panels.push_back(panel(quantity, rows, points));
    if (shown.size() < all.size()) {
        panels[0].title +=
            " (" + std::to_string(shown.size()) + " of " + std::to_string(all.size()) + " quantities drawn)";
    }
    return study::side_by_side(std::move(panels));
}

}  // namespace precision
