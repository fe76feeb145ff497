// The schemes that are worth their time: the Pareto front of error and run time, and the cheapest scheme for a
// tolerance. The error that counts is the largest at this and every larger n, so that a change of sign does not pass
// for precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace precision {

/// One scheme at one n, measured for one quantity.
struct Point {
    std::string scheme;
    std::optional<long> n;  ///< elements, states, or the order of a polynomial; none for a closed form
    std::string quantity{};
    std::optional<double> relative_error{};  ///< none if the scheme gave no result
    std::optional<double> time_us{};
    std::optional<bool> stable{};
    std::optional<bool> on_front{};
    std::optional<double> model_error{};
    std::string status = "ok";           ///< why there is no error
    std::vector<std::string> setting{};  ///< kernel, aspect, poisson, size_ratio, epsilon
    std::string worst_at{};              ///< the place of the error, if the quantity has any
    /// Whether the error can be relied on. That of an extrapolated force with friction cannot: the border of stick
    /// jumps from element to element, and what few places show may be luck.
    bool competes = true;
    std::string series{};  ///< tells apart several series in n of one scheme
};

/// Elements and Chebyshev states solve problems in steady rolling, frequency and time with any kernel; the others only
/// know the plane kernel and serve for comparison.
inline bool is_discretisation(const std::string& scheme) { return scheme != "polynomial" && scheme != "closed-form"; }

/// Element schemes also work with friction.
inline bool is_element_scheme(const std::string& scheme) { return is_discretisation(scheme) && scheme != "chebyshev"; }

/// The largest |error| of each point's scheme and quantity at the point's n and all larger n; infinite if one of them
/// has no result.
inline std::vector<double> sustained_errors(const std::vector<Point>& points) {
    std::vector<std::size_t> order(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return points[a].n > points[b].n; });
    std::map<std::pair<std::string, std::string>, double> largest;
    std::vector<double> sustained(points.size());
    for (const std::size_t i : order) {
        double& worst = largest[{points[i].scheme + points[i].series, points[i].quantity}];
        const auto& error = points[i].relative_error;
        worst = std::max(worst, error ? std::abs(*error) : std::numeric_limits<double>::infinity());
        sustained[i] = worst;
    }
    return sustained;
}

/// Sets on_front of every discretisation that competes and has a time: no other is both as fast and as precise. Leaves
/// it empty for the rest.
inline void mark_front(std::vector<Point>& points) {
    const std::vector<double> sustained = sustained_errors(points);
    std::map<std::string, std::vector<std::size_t>> of_quantity;
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].on_front.reset();
        const bool counts = is_discretisation(points[i].scheme) && points[i].competes;
        if (counts && points[i].time_us) of_quantity[points[i].quantity].push_back(i);
    }
    for (auto& [quantity, members] : of_quantity) {
        std::sort(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
            return std::pair(*points[a].time_us, sustained[a]) < std::pair(*points[b].time_us, sustained[b]);
        });
        double best = std::numeric_limits<double>::infinity();
        for (const std::size_t i : members) {
            points[i].on_front = sustained[i] < best;
            best = std::min(best, sustained[i]);
        }
    }
}

/// Groups of schemes among which one may be chosen for a tolerance; stable ones are discretisations without a growing
/// mode.
inline const std::map<std::string, bool (*)(const Point&)> groups{
    {"elements", [](const Point& point) { return is_element_scheme(point.scheme); }},
    {"stable-elements",
     [](const Point& point) { return is_element_scheme(point.scheme) && point.stable.value_or(false); }},
    {"stable", [](const Point& point) { return is_discretisation(point.scheme) && point.stable.value_or(false); }},
    {"all", [](const Point&) { return true; }}};

/// The fastest point of a quantity in a group that competes and whose sustained error is at most `tolerance`, if there
/// is one.
inline std::optional<std::size_t> cheapest(const std::vector<Point>& points, const std::vector<double>& sustained,
                                           const std::string& quantity, double tolerance, const std::string& group) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point& point = points[i];
        if (point.quantity != quantity || !point.time_us || !(sustained[i] <= tolerance)) continue;
        if (point.competes && groups.at(group)(point) && (!best || *point.time_us < *points[*best].time_us)) best = i;
    }
    return best;
}

}  // namespace precision
