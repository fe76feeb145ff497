#include <algorithm>

#include <rollbem/closed_form/friction.hpp>

#include "steady.hpp"

namespace friction {

study::Series carter_curve(double from, double to) {
    study::Series line{.label = "Carter", .markers = false, .reference = true};
    from = std::min(from, 0.0);
    to = std::max(to, 0.0);
    for (int i = 0; i <= line_points; ++i) {
        const double ratio = from + (to - from) * i / line_points;
        line.points.emplace_back(ratio, rollbem::carter_force_ratio(ratio));
    }
    return line;
}

study::PlotRange force_range(const study::Plot& plot) {
    bool below = false, above = false;
    for (const study::Series& series : plot.series) {
        for (const auto& [ratio, force] : series.points) {
            below = below || force < 0;
            above = above || force > 0;
        }
    }
    return {below ? -1.05 : 0, above || !below ? 1.05 : 0};
}

std::string coefficient(bool falling) { return falling ? "μ_0" : "μ"; }
std::string creepage_label(bool falling, const std::string& ratio) {
    return "creepage ratio " + ratio + " G / (2 (1 - ν) " + coefficient(falling) + " p_0)";
}
std::string force_label(bool falling, const std::string& force, const std::string& load) {
    return force + " / (" + coefficient(falling) + " " + load + ")";
}

std::string scene_in_title(const study::Options& options) {
    std::string title;
    for (const char* name : {"pressure", "falling", "memory", "layer", "load-sine", "load", "sine", "shift"}) {
        if (options.given(name)) title += std::string(", ") + name + " " + options.text(name);
    }
    if (!options.flag("transient")) return title;
    for (const char* name : {"creepage-ratio", "lateral-ratio", "spin-ratio"}) {
        if (options.given(name)) title += std::string(", ") + name + " " + options.text(name);
    }
    return title;
}

}  // namespace friction
