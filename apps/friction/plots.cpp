#include "plots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <rollbem/closed_form/friction.hpp>

namespace friction {

namespace {

constexpr int line_points = 400;
const std::vector<std::string> scheme_columns{"method", "derivative", "mesh", "n", "alpha_L", "alpha_T"};

/// Carter's creep curve between two ratios, 0 included.
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

// What forces and tractions are drawn in units of.
std::string coefficient(bool falling) { return falling ? "μ_0" : "μ"; }
std::string creepage_label(bool falling, const std::string& ratio) {
    return "creepage ratio " + ratio + " G / (2 (1 - ν) " + coefficient(falling) + " p_0)";
}
std::string force_label(bool falling, const std::string& force = "-F", const std::string& load = "N") {
    return force + " / (" + coefficient(falling) + " " + load + ")";
}

/// The tractions of the last scene with a result at the creepage nearest to half of full sliding; no panel if there are
/// none.
std::vector<study::Plot> draw_tractions(const Tractions& tractions, const Line& line) {
    std::optional<double> shown;
    const std::vector<study::Row>* of_task = nullptr;
    for (const std::vector<study::Row>& rows : tractions.rows) {
        for (const study::Row& row : rows) {
            if (!tractions.number(row, "traction")) continue;
            const double ratio = *tractions.number(row, "creepage_ratio");
            const auto distance = [](double one) { return std::abs(std::abs(one) - 0.5); };
            if (of_task != &rows || distance(ratio) < distance(*shown)) shown = ratio;
            of_task = &rows;
        }
    }
    if (!shown) return {};
    const bool falling = line.falling.has_value();
    const double sign = *shown < 0 ? -1 : 1;
    study::Series exact{.label = "Carter", .markers = false, .reference = true};
    study::Series bound{.label = "bound " + coefficient(falling) + " p_n", .markers = false, .reference = true};
    // other colours than those of the first creep curves
    study::Series slip{.label = "slip", .line = false, .style = 7};
    study::Series stick{.label = "stick", .line = false, .style = 6};
    double highest = 0;
    for (const study::Row& row : *of_task) {
        if (tractions.number(row, "creepage_ratio") != shown) continue;
        const double x = *tractions.number(row, "x_over_a"), most = *tractions.number(row, "bound");
        highest = std::max(highest, 1.05 * most);
        bound.points.emplace_back(x, sign * most);
        auto& zone = *tractions.number(row, "stick") > 0 ? stick : slip;
        zone.points.emplace_back(x, -*tractions.number(row, "traction"));
    }
    for (int i = 0; i <= line_points && line.carter(); ++i) {
        const double x = -std::cos(std::numbers::pi * i / line_points);
        exact.points.emplace_back(x, -rollbem::carter_friction_traction(x, *shown));
    }
    study::Plot panel{
        .title = "Traction, δ = " + study::Cell(*shown).text(6) + ", n = " + std::to_string(bound.points.size()),
        .x_label = "x / a (leading edge at 1)",
        .y_label = force_label(falling, "-p", "p_0"),
        .x_range = study::PlotRange{-1, 1},
        .y_range = study::PlotRange{std::min(0.0, sign * highest), std::max(0.0, sign * highest)}};
    panel.series = {std::move(exact), std::move(bound), std::move(slip), std::move(stick)};
    return {std::move(panel)};
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
                          const Curve& curve, const Tractions& tractions,
                          const std::vector<std::vector<std::pair<double, double>>>& others) {
    const bool falling = curve.line.falling.has_value();
    study::Plot plot{.title = "Creep curve" + scene_in_title(curve.options),
                     .x_label = creepage_label(falling, "δ = ξ"),
                     .y_label = force_label(falling),
                     .beside = draw_tractions(tractions, curve.line)};
    study::add_series(
        plot, columns, rows,
        {.by = scheme_columns, .x = "creepage_ratio", .y = "force_ratio", .apart = study::columns_of(study::settings)});
    for (study::Series& series : plot.series) {
        series.line = false;
        series.open = true;
        if (plot.series.size() == 1) series.label = curve.sweep.empty() ? "computed" : "sweep " + curve.sweep;
    }
    plot.y_range = force_range(plot);
    for (const auto& points : others) {
        if (points.empty()) continue;
        plot.series.push_back(
            {.label = curve.sweep == "up" ? "sweep down" : "sweep up", .points = points, .markers = false});
    }
    const auto [least, most] = std::minmax_element(
        curve.points.begin(), curve.points.end(),
        [](const CreepPoint& one, const CreepPoint& other) { return one.longitudinal < other.longitudinal; });
    if (curve.line.carter()) plot.series.push_back(carter_curve(least->longitudinal, most->longitudinal));
    return plot;
}

study::Plot combined_creep(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                           const Curve& curve) {
    const bool falling = curve.line.falling.has_value();
    const auto panel = [&](const std::string& title, const char* force, const char* y) {
        study::Plot plot{
            .title = title, .x_label = creepage_label(falling, "δ_x = ξ_x"), .y_label = force_label(falling, force)};
        study::add_series(plot, columns, rows,
                          {.by = study::joined(scheme_columns, {"lateral_ratio", "spin_ratio"}),
                           .x = "creepage_ratio",
                           .y = y,
                           .apart = study::columns_of(study::settings)});
        plot.y_range = force_range(plot);
        return plot;
    };
    study::Plot plot = panel("Longitudinal force" + scene_in_title(curve.options), "-F_x", "force_ratio");
    plot.beside.push_back(panel("Lateral force", "-F_y", "lateral_force_ratio"));
    return plot;
}

study::Plot force_in_time(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                          const TimePicture& shown) {
    study::Selection selection{
        .by = study::joined(scheme_columns, {"lambda"}), .x = "", .y = "", .apart = study::columns_of(study::settings)};
    // the column y over x; the prefix of the label says which
    const auto add = [&](study::Plot& plot, const char* x, const char* y, const std::string& prefix) {
        selection.x = x;
        selection.y = y;
        study::Plot more{.title = plot.title};
        study::add_series(more, columns, rows, selection);
        if (plot.series.empty()) plot.title = more.title;
        for (study::Series& series : more.series) {
            if (series.points.empty()) continue;
            series.markers = false;
            if (!prefix.empty()) series.label = series.label.empty() ? prefix : prefix + ", " + series.label;
            plot.series.push_back(std::move(series));
        }
        if (plot.series.size() == 1 && plot.series[0].label.empty()) plot.series[0].label = "computed";
    };
    study::Plot plot{.title = "Rolling with friction" + shown.scene,
                     .x_label = "distance rolled q/a",
                     .y_label = force_label(shown.falling, "-F", shown.load_changes ? "N_0" : "N"),
                     .x_range = study::PlotRange{0, shown.end}};
    if (rows.empty()) return plot;  // of a shard
    const bool lateral = !rows.front()[study::index_of(columns, "lateral_ratio")].text().empty();
    add(plot, "q_over_a", "force_ratio", lateral ? "longitudinal" : shown.load_changes ? "force" : "");
    if (lateral) add(plot, "q_over_a", "lateral_force_ratio", "lateral");
    if (shown.load_changes) {
        selection.y = "load_ratio";
        study::add_reference(plot, columns, rows, selection, "load N/N_0");
    }
    if (shown.creepage_changes) {
        study::Plot loop{.x_label = "creepage ratio δ", .y_label = plot.y_label};
        add(loop, "creepage_ratio", "force_ratio", "");
        loop.title = "Hysteresis";
        const double most = std::abs(shown.ratio);
        if (shown.carter) loop.series.push_back(carter_curve(-most, most));
        if (!shown.load_changes) loop.y_range = force_range(loop);
        plot.beside.push_back(std::move(loop));
    } else if (shown.carter) {
        const double force = rollbem::carter_force_ratio(shown.ratio);
        plot.series.push_back({.label = "Carter, steady",
                               .points = {{0, force}, {shown.end, force}},
                               .markers = false,
                               .reference = true});
    }
    return plot;
}

}  // namespace friction
