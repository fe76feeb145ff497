#include "plots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <rollbem/closed_form/friction.hpp>

namespace friction {

namespace {

constexpr int line_points = 400;

/// Carter's creep curve over the ratios and 0.
study::Series carter_curve(const std::vector<double>& ratios) {
    study::Series line{.label = "Carter", .markers = false, .reference = true};
    const auto [low, high] = std::minmax_element(ratios.begin(), ratios.end());
    const double from = std::min(*low, 0.0), to = std::max(*high, 0.0);
    for (int i = 0; i <= line_points; ++i) {
        const double ratio = from + (to - from) * i / line_points;
        line.points.emplace_back(ratio, rollbem::carter_force_ratio(ratio));
    }
    return line;
}

/// Range of forces up to full sliding, for the signs that occur.
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

/// Of the last scene with a result, the profile nearest to half of full sliding; null if there is none.
const Profile* most_telling(const Profiles& profiles) {
    const auto distance = [](const Profile& profile) { return std::abs(std::abs(profile.point.longitudinal) - 0.5); };
    const Profile* shown = nullptr;
    for (const auto& [key, profile] : profiles.all()) {
        if (profile.status != "ok") continue;
        if (shown == nullptr || profile.scene != shown->scene || distance(profile) < distance(*shown)) shown = &profile;
    }
    return shown;
}

// What forces and tractions are drawn in units of.
std::string coefficient(bool falling) { return falling ? "μ_0" : "μ"; }
std::string creepage_label(bool falling, bool both = false) {
    return std::string(both ? "creepage ratio δ_x = ξ_x" : "creepage ratio δ = ξ") + " G / (2 (1 - ν) " +
           coefficient(falling) + " p_0)";
}
std::string force_label(bool falling, const std::string& force = "-F", const std::string& load = "N") {
    return force + " / (" + coefficient(falling) + " " + load + ")";
}

study::Plot draw_tractions(const Profile& shown, bool carter, bool falling) {
    const double ratio = shown.point.longitudinal;
    study::Plot panel{
        .title = "Traction, δ = " + study::Cell(ratio).text(6) + ", n = " + std::to_string(shown.mesh.size()),
        .x_label = "x / a (leading edge at 1)",
        .y_label = force_label(falling, "-p", "p_0"),
        .x_range = study::PlotRange{-1, 1}};
    const double sign = ratio < 0 ? -1 : 1;
    study::Series exact{.label = "Carter", .markers = false, .reference = true};
    study::Series bound{.label = "bound " + coefficient(falling) + " p_n", .markers = false, .reference = true};
    // other colours than those of the first creep curves
    study::Series slip{.label = "slip", .line = false, .style = 7};
    study::Series stick{.label = "stick", .line = false, .style = 6};
    for (Eigen::Index i = 0; i < shown.mesh.size(); ++i) {
        const double x = shown.mesh.centres()[i];
        bound.points.emplace_back(x, sign * shown.bound[i]);
        (shown.sticks[std::size_t(i)] ? stick : slip).points.emplace_back(x, -shown.traction[i]);
    }
    for (int i = 0; i <= line_points && carter; ++i) {
        const double x = -std::cos(std::numbers::pi * i / line_points);
        exact.points.emplace_back(x, -rollbem::carter_friction_traction(x, ratio));
    }
    const double highest = 1.05 * shown.bound.maxCoeff();
    panel.y_range = ratio < 0 ? study::PlotRange{-highest, 0} : study::PlotRange{0, highest};
    panel.series = {std::move(exact), std::move(bound), std::move(slip), std::move(stick)};
    return panel;
}

}  // namespace

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

study::Plot creep_picture(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                          const CreepCurve& curve) {
    const bool falling = curve.falling.has_value();
    study::Plot plot{.title = "Creep curve" + scene_in_title(curve.options),
                     .x_label = creepage_label(falling),
                     .y_label = force_label(falling)};
    study::add_series(plot, columns, rows,
                      {.by = {"method", "derivative", "mesh", "n", "alpha_L", "alpha_T"},
                       .x = "creepage_ratio",
                       .y = "force_ratio",
                       .apart = study::setting_columns()});
    for (study::Series& series : plot.series) {
        series.line = false;
        series.open = true;
        if (plot.series.size() == 1) series.label = curve.sweep.empty() ? "computed" : "sweep " + curve.sweep;
    }
    const bool carter = curve.carter();
    plot.y_range = force_range(plot);
    if (curve.other != nullptr) {
        for (const auto& [task, points] : curve.other->all()) {
            plot.series.push_back(
                {.label = curve.sweep == "up" ? "sweep down" : "sweep up", .points = points, .markers = false});
        }
    }
    std::vector<double> ratios;
    for (const CreepPoint& point : curve.points) ratios.push_back(point.longitudinal);
    if (carter) plot.series.push_back(carter_curve(ratios));
    if (const Profile* shown = most_telling(*curve.profiles))
        plot.beside.push_back(draw_tractions(*shown, carter, falling));
    return plot;
}

study::Plot combined_creep(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                           const CreepCurve& curve) {
    const bool falling = curve.falling.has_value();
    const auto panel = [&](const std::string& title, const char* force, const char* y) {
        study::Plot plot{
            .title = title, .x_label = creepage_label(falling, true), .y_label = force_label(falling, force)};
        study::add_series(
            plot, columns, rows,
            {.by = {"method", "derivative", "mesh", "n", "alpha_L", "alpha_T", "lateral_ratio", "spin_ratio"},
             .x = "creepage_ratio",
             .y = y,
             .apart = study::setting_columns()});
        plot.y_range = force_range(plot);
        return plot;
    };
    study::Plot plot = panel("Longitudinal force" + scene_in_title(curve.options), "-F_x", "force_ratio");
    plot.beside.push_back(panel("Lateral force", "-F_y", "lateral_force_ratio"));
    return plot;
}

study::Plot force_in_time(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                          const TimePicture& shown) {
    study::Selection selection{.by = {"method", "derivative", "mesh", "n", "alpha_L", "alpha_T", "lambda"},
                               .x = "q_over_a",
                               .y = "force_ratio",
                               .apart = study::setting_columns()};
    // further columns over the same axis; the prefix of the label says which
    const auto add = [&](study::Plot& plot, const char* y, const std::string& prefix) {
        const std::size_t first = plot.series.size();
        selection.y = y;
        study::Plot more{.title = plot.title};
        study::add_series(more, columns, rows, selection);
        for (study::Series& series : more.series) {
            if (series.points.empty()) continue;
            series.markers = false;
            if (first > 0 || !prefix.empty()) {
                series.label = series.label.empty() ? prefix : prefix + (prefix.empty() ? "" : ", ") + series.label;
            }
            plot.series.push_back(std::move(series));
        }
        if (first == 0) plot.title = more.title;
        if (plot.series.size() == 1 && plot.series[0].label.empty()) plot.series[0].label = "computed";
    };
    const bool lateral = std::any_of(rows.begin(), rows.end(), [&](const study::Row& row) {
        return !row[study::index_of(columns, "lateral_ratio")].text().empty();
    });
    study::Plot plot{.title = "Rolling with friction" + shown.scene,
                     .x_label = "distance rolled q/a",
                     .y_label = force_label(shown.falling, "-F", shown.load_changes ? "N_0" : "N"),
                     .x_range = study::PlotRange{0, shown.end}};
    if (rows.empty()) return plot;  // of a shard
    add(plot, "force_ratio", lateral ? "longitudinal" : shown.load_changes ? "force" : "");
    if (lateral) add(plot, "lateral_force_ratio", "lateral");
    if (shown.load_changes) {
        selection.y = "load_ratio";
        study::add_reference(plot, columns, rows, selection, "load N/N_0");
    }
    if (shown.creepage_changes) {
        selection.x = "creepage_ratio";
        study::Plot loop{.title = "Hysteresis", .x_label = "creepage ratio δ", .y_label = plot.y_label};
        add(loop, "force_ratio", "");
        loop.title = "Hysteresis";
        if (shown.carter) loop.series.push_back(carter_curve({-shown.ratio, shown.ratio}));
        if (!shown.load_changes) loop.y_range = force_range(loop);
        plot.beside.push_back(std::move(loop));
    } else if (shown.carter) {
        const double force = rollbem::carter_force_ratio(shown.ratio);
        plot.series.push_back({.label = "Carter, steady",
                               .points = {{0, force}, {shown.end, force}},
                               .markers = false,
                               .reference = true});
        study::PlotRange range{std::min(1.05 * force, 0.0), std::max(1.05 * force, 0.0)};  // keeps curves off the frame
        for (const study::Series& series : plot.series) {
            for (const auto& [q, value] : series.points) {
                range = {std::min(range.low, 1.05 * value), std::max(range.high, 1.05 * value)};
            }
        }
        if (range.low < range.high) plot.y_range = range;
    }
    return plot;
}

}  // namespace friction
