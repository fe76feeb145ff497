// The pictures of precision_study.
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "comparison.hpp"

namespace precision {

namespace {

/// The schemes of all points, those on the front of a quantity first: a panel draws as many as can be told apart.
std::vector<std::string> ranked_schemes(const std::vector<Point>& points) {
    std::vector<std::string> names;
    for (const bool on_front : {true, false}) {
        for (const Point& point : points) {
            const bool ranks = point.on_front.value_or(false) || !on_front;
            if (ranks && !study::contains(names, point.scheme)) names.push_back(point.scheme);
        }
    }
    return names;
}

std::string title_of(const Quantity& quantity) {
    if (quantity.name == "c11") return "c_{11} in steady rolling";
    if (quantity.problem == Problem::harmonic) {
        const auto omega = [](const Place& place) { return study::Cell(place["omega"]).text(6); };
        const Places& places = quantity.places;
        return "c_{11} at ω a/V = " + omega(places.front()) + (places.size() > 1 ? " to " + omega(places.back()) : "");
    }
    std::string title;
    for (const char c : quantity.name) title += c == '_' ? ' ' : c;  // to gnuplot the start of a subscript
    return title;
}

/// A panel for one quantity: the error of every scheme over its time, and the front with the errors that put it there.
study::Plot panel(const Quantity& shown, const std::string& note, const std::vector<Point>& points) {
    study::Plot plot{"", {"time [microseconds]", true}, {"|relative error|", true}};
    if (shown.name == "patch_force") plot.y.label = "largest error of F_x, F_y over μ N";
    plot.y.least = 1e-14;  // smaller errors are round-off
    const std::vector<std::string> ranked = ranked_schemes(points);
    const std::vector<double> sustained = sustained_errors(points);
    study::Records rows{columns()};
    study::Series front{"Pareto front", study::Look::exact_markers};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point& point = points[i];
        const bool is_reference = point.scheme == "closed-form" && point.relative_error == 0.0;
        if (point.quantity != shown.name || !point.time_us) continue;
        if (point.on_front.value_or(false)) front.points.emplace_back(*point.time_us, sustained[i]);
        if (!is_reference && study::index_of(ranked, point.scheme) < study::most_curves)
            rows.rows.push_back(row(point));
    }
    add_series(plot, rows, {.by = {"scheme"}, .x = "time_us", .y = "relative_error", .absolute = true});
    plot.title = title_of(shown) + note;
    if (plot.series.size() == 1) plot.series[0].label = *rows.texts("scheme").begin();
    std::string left_out;  // of the front: schemes that serve for comparison alone
    const auto leave_out = [&](const std::string& what) {
        if (left_out.find(what) == std::string::npos) left_out += (left_out.empty() ? "; front without " : ", ") + what;
    };
    for (const std::string& scheme : rows.texts("scheme")) {
        const bool extrapolated = scheme.starts_with("richardson:");
        if (!is_discretisation(scheme) || !shown.competes(scheme)) {
            leave_out(extrapolated ? "extrapolated schemes" : scheme);
        }
    }
    plot.title += left_out;
    std::sort(front.points.begin(), front.points.end());
    plot.series.push_back(std::move(front));
    return plot;
}

}  // namespace

study::Picture pictures(const std::vector<Quantity>& quantities, const std::vector<Point>& points) {
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

    std::string notes;
    const auto note = [&](std::size_t part, std::size_t all, const char* of) {
        if (part < all) notes += " (" + std::to_string(part) + " of " + std::to_string(all) + of;
    };
    note(shown.size(), quantities.size(), " quantities drawn)");
    note(study::most_curves, ranked_schemes(points).size(), " schemes drawn)");
    study::Picture panels;
    for (const Quantity& quantity : shown) {
        panels.push_back(panel(quantity, panels.empty() ? notes : "", points));
        panels.back().shares_legend = panels.size() > 1;
    }
    return panels;
}

}  // namespace precision
