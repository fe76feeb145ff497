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

/// The schemes of all rows. The place of one among them is its colour, dashes and marker, the same in all panels.
std::vector<std::string> all_schemes(const std::vector<study::Row>& rows) {
    std::vector<std::string> names;
    for (const study::Row& cells : rows) {
        if (!study::contains(names, cells[0].text())) names.push_back(cells[0].text());
    }
    return names;
}

/// As many schemes as can be told apart, those on the front of a quantity first.
std::vector<std::string> drawn_schemes(const std::vector<std::string>& schemes, const std::vector<Point>& points) {
    std::vector<std::string> drawn;
    for (const bool on_front : {true, false}) {
        for (const std::string& scheme : schemes) {
            const bool leads = std::any_of(points.begin(), points.end(), [&](const Point& point) {
                return point.scheme == scheme && point.on_front.value_or(false);
            });
            if (leads == on_front && drawn.size() < study::most_curves) drawn.push_back(scheme);
        }
    }
    return drawn;
}

std::string title_of(const Quantity& quantity) {
    if (quantity.name == "c11") return "c_{11} in steady rolling";
    if (quantity.problem == Problem::harmonic) return "c_{11} at ω a/V = " + study::Cell(quantity.frequency).text(6);
    std::string title;
    for (const char c : quantity.name) title += c == '_' ? ' ' : c;  // to gnuplot the start of a subscript
    return title;
}

/// A panel for one quantity: the error of every scheme over its time, and the front with the errors that put it there.
/// Errors below the floor are drawn on it.
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
        front.points.emplace_back(*points[i].time_us, sustained[i]);
    }
    std::sort(front.points.begin(), front.points.end());
    front.markers = front.points.size() == 1;
    int left_out = 0;  // of the front: they serve for comparison
    const std::vector<std::string> schemes = all_schemes(rows), drawn = drawn_schemes(schemes, points);
    for (std::size_t k = 0; k < schemes.size(); ++k) {
        const std::string& scheme = schemes[k];
        if (!study::contains(drawn, scheme)) continue;
        study::Series series{.label = scheme, .style = k};
        for (const study::Row& cells : rows) {
            if (cells[0].text() != scheme || cells[2].text() != quantity) continue;
            const std::optional<double> error = cells[3].number(), time = cells[4].number();
            if (!time || (scheme == "closed-form" && error == 0.0)) continue;  // not timed, or the reference itself
            series.points.emplace_back(*time, std::abs(error.value_or(nan)));
        }
        if (series.points.empty()) continue;
        plot.series.push_back(std::move(series));
        if (!is_discretisation(scheme)) front.label += (left_out++ == 0 ? " without " : ", ") + scheme;
    }
    if (!front.points.empty()) plot.series.push_back(std::move(front));
    study::raise_to_drawn(plot, floor);
    return plot;
}

}  // namespace

study::Plot pictures(const std::vector<Quantity>& quantities, const std::vector<study::Row>& rows,
                     const std::vector<Point>& points) {
    constexpr std::size_t most = 3;
    const auto has_points = [&](const Quantity& quantity) {
        return std::any_of(rows.begin(), rows.end(), [&](const study::Row& cells) {
            return cells[2].text() == quantity.name && cells[3].number() && cells[4].number();
        });
    };
    const auto is_usual = [](const Quantity& quantity) {
        return quantity.name == "c11" || quantity.name == "response" || quantity.name == "friction";
    };
    std::vector<Quantity> all, shown;
    std::copy_if(quantities.begin(), quantities.end(), std::back_inserter(all), has_points);
    if (all.empty()) all.push_back(quantities.front());
    if (all.size() > most) std::copy_if(all.begin(), all.end(), std::back_inserter(shown), is_usual);
    if (shown.empty()) shown.assign(all.begin(), all.begin() + std::ptrdiff_t(std::min(most, all.size())));

    study::Plot plot = panel(shown.front(), rows, points);
    if (shown.size() < quantities.size()) {
        plot.title +=
            " (" + std::to_string(shown.size()) + " of " + std::to_string(quantities.size()) + " quantities drawn)";
    }
    const std::size_t schemes = all_schemes(rows).size();
    if (schemes > study::most_curves) {
        plot.title += " (" + std::to_string(study::most_curves) + " of " + std::to_string(schemes) + " schemes drawn)";
    }
    for (std::size_t i = 1; i < shown.size(); ++i) plot.below.push_back(panel(shown[i], rows, points));
    return plot;
}

}  // namespace precision
