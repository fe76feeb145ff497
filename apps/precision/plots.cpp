// The pictures of precision_study.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "comparison.hpp"

namespace precision {

namespace {

constexpr double floor = 1e-14;  // smaller errors are round-off, or 0, which a logarithmic axis cannot show

/// The schemes of all points. The place of one among them is its colour, dashes and marker, the same in all panels.
std::vector<std::string> all_schemes(const std::vector<Point>& points) {
    std::vector<std::string> names;
    for (const Point& point : points) {
        if (!study::contains(names, point.scheme)) names.push_back(point.scheme);
    }
    return names;
}

/// The schemes that a panel can show apart; schemes on the front of a quantity come first.
std::vector<std::string> drawn_schemes(const std::vector<Point>& points) {
    std::vector<std::string> drawn = all_schemes(points);
    std::stable_partition(drawn.begin(), drawn.end(), [&](const std::string& scheme) {
        return std::any_of(points.begin(), points.end(), [&](const Point& point) {
            return point.scheme == scheme && point.on_front.value_or(false);
        });
    });
    drawn.resize(std::min(drawn.size(), study::most_curves));
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
study::Plot panel(const Quantity& shown, const std::vector<Point>& points) {
    study::Plot plot{.title = title_of(shown),
                     .x_label = "time [microseconds]",
                     .y_label = shown.name == "patch_force" ? "largest error of F_x, F_y over μ N" : "|relative error|",
                     .log_x = true,
                     .log_y = true};
    study::Series front{.label = "Pareto front", .markers = false, .reference = true};
    const std::vector<std::string> schemes = all_schemes(points), drawn = drawn_schemes(points);
    std::vector<study::Series> of_scheme(schemes.size());
    const std::vector<double> sustained = sustained_errors(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point& point = points[i];
        const bool is_reference = point.scheme == "closed-form" && point.relative_error == 0.0;
        if (point.quantity != shown.name || !point.time_us) continue;
        if (point.on_front.value_or(false)) front.points.emplace_back(*point.time_us, sustained[i]);
        if (is_reference || !study::contains(drawn, point.scheme)) continue;
        of_scheme[study::index_of(schemes, point.scheme)].points.emplace_back(
            *point.time_us, std::abs(point.relative_error.value_or(nan)));
    }
    std::sort(front.points.begin(), front.points.end());
    front.markers = front.points.size() == 1;
    int left_out = 0;  // schemes that serve for comparison are not on the front
    for (std::size_t k = 0; k < schemes.size(); ++k) {
        if (of_scheme[k].points.empty()) continue;
        of_scheme[k].label = schemes[k];
        of_scheme[k].style = k;
        plot.series.push_back(std::move(of_scheme[k]));
        if (!is_discretisation(schemes[k])) front.label += (left_out++ == 0 ? " without " : ", ") + schemes[k];
    }
    if (!front.points.empty()) plot.series.push_back(std::move(front));
    study::raise_to_drawn(plot, floor);
    return plot;
}

}  // namespace

study::Plot pictures(const std::vector<Quantity>& quantities, const std::vector<Point>& points) {
    constexpr std::size_t most = 3;
    std::vector<Quantity> shown = quantities;
    std::erase_if(shown, [&](const Quantity& quantity) {
        return std::none_of(points.begin(), points.end(), [&](const Point& point) {
            return point.quantity == quantity.name && point.relative_error && point.time_us;
        });
    });
    const auto unusual = [](const Quantity& q) { return !study::contains({"c11", "response", "friction"}, q.name); };
    if (shown.size() > most && !std::all_of(shown.begin(), shown.end(), unusual)) std::erase_if(shown, unusual);
    if (shown.size() > most) shown.erase(shown.begin() + most, shown.end());
    if (shown.empty()) shown.push_back(quantities.front());

    study::Plot plot = panel(shown.front(), points);
    const auto note = [&](std::size_t part, std::size_t all, const char* of) {
        if (part < all) plot.title += " (" + std::to_string(part) + " of " + std::to_string(all) + of;
    };
    note(shown.size(), quantities.size(), " quantities drawn)");
    note(study::most_curves, all_schemes(points).size(), " schemes drawn)");
    for (std::size_t i = 1; i < shown.size(); ++i) plot.below.push_back(panel(shown[i], points));
    return plot;
}

}  // namespace precision
