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
    const auto say = [&](const char* name, const std::string& before, const std::string& between = "",
                         const std::string& after = "") {
        if (!options.given(name)) return;
        const std::string value = options.text(name);
        const std::size_t comma = value.find(',');
        title += ", " + before + value.substr(0, comma);
        if (comma != std::string::npos) title += between + value.substr(comma + 1) + after;
    };
    if (options.given("pressure")) title += ", pressure of a table";
    if (options.flag("transient")) {
        const std::string delta = options.given("lateral-ratio") ? "δ_x = " : "δ = ";
        say("creepage-ratio", delta);
        say("sine", delta, " sin(", " q/a)");
        say("lateral-ratio", "δ_y = ");
        say("spin-ratio", "δ_φ = ");
        say("shift", "shift ");
        say("load-sine", "N/N_0 = 1 + ", " sin(2π q/", ")");
        if (options.given("load")) title += ", load of a table";
    }
    say("falling", "μ falls to μ_0 times ", ", by half at a slip of ");
    say("memory", "memory ", " and ");
    say("layer", "layer ");
    return title;
}

}  // namespace friction
