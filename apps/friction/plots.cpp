#include "plots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <rollbem/closed_form/friction.hpp>

namespace friction {

namespace {

constexpr int line_points = 400;

/// Carter's creep curve over the ratios, from or to 0.
study::Series carter_curve(const std::vector<double>& ratios) {
    study::Series line{.label = "Carter", .points = {}, .markers = false};
    const auto [low, high] = std::minmax_element(ratios.begin(), ratios.end());
    const double from = std::min(*low, 0.0), to = std::max(*high, 0.0);
    for (int i = 0; i <= line_points; ++i) {
        const double ratio = from + (to - from) * i / line_points;
        line.points.emplace_back(ratio, rollbem::carter_force_ratio(ratio));
    }
    return line;
}

/// Of the profiles with a result, that of the last scene nearest to half of full sliding; null where there is none.
const Profile* most_telling(const Profiles& profiles) {
    const auto distance = [](const Profile& profile) { return std::abs(std::abs(profile.ratio) - 0.5); };
    const Profile* shown = nullptr;
    for (const auto& [key, profile] : profiles.all()) {
        if (profile.status != "ok") continue;
        if (shown == nullptr || profile.scene != shown->scene || distance(profile) < distance(*shown)) shown = &profile;
    }
    return shown;
}

study::Plot draw_tractions(const Profile& shown, const Pressure& pressure) {
    study::Plot panel{
        .title = "Traction, δ = " + study::Cell(shown.ratio).text(6) + ", n = " + std::to_string(shown.mesh.size()),
        .x_label = "x / a (leading edge at 1)",
        .y_label = "-p / (μ p_0)",
        .x_range = study::PlotRange{-1, 1},
        .series = {}};
    const double sign = shown.ratio < 0 ? -1 : 1;
    study::Series bound{.label = "bound μ p_n", .points = {}, .markers = false, .style = 6};
    study::Series exact{.label = "Carter", .points = {}, .markers = false, .style = 2};
    study::Series slip{.label = "slip", .points = {}, .line = false, .style = 1};
    study::Series stick{.label = "stick", .points = {}, .line = false, .style = 0};
    for (Eigen::Index i = 0; i < shown.mesh.size(); ++i) {
        const double x = shown.mesh.centres()[i];
        bound.points.emplace_back(x, sign * shown.bound[i]);
        (shown.sticks[std::size_t(i)] ? stick : slip).points.emplace_back(x, -shown.traction[i]);
    }
    for (int i = 0; i <= line_points && pressure.hertz; ++i) {
        const double x = -std::cos(std::numbers::pi * i / line_points);
        exact.points.emplace_back(x, -rollbem::carter_friction_traction(x, shown.ratio));
    }
    panel.series = {std::move(bound), std::move(exact), std::move(slip), std::move(stick)};
    return panel;
}

}  // namespace

study::Plot creep_curve(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                        const Profiles& profiles, const Pressure& pressure, const std::vector<double>& ratios) {
    study::Plot plot{.title = "Creep curve",
                     .x_label = "creepage ratio δ = ξ G / (2 (1 - ν) μ p_0)",
                     .y_label = "-F / (μ N)",
                     .series = {}};
    study::add_series(
        plot, columns, rows,
        {.by = {"method", "derivative", "mesh", "n", "alpha_L", "alpha_T"}, .x = "creepage_ratio", .y = "force_ratio"});
    for (study::Series& series : plot.series) series.line = false;
    if (pressure.hertz) plot.series.push_back(carter_curve(ratios));
    if (const Profile* shown = most_telling(profiles)) plot.beside.push_back(draw_tractions(*shown, pressure));
    return plot;
}

study::Plot force_in_time(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                          bool creepage_changes, const study::Series* steady) {
    study::Selection selection{.by = {"method", "derivative", "mesh", "n", "alpha_L", "alpha_T", "lambda"},
                               .x = "q_over_a",
                               .y = "force_ratio"};
    const auto draw = [&](const char* title, const char* x_label) {
        study::Plot plot{.title = title, .x_label = x_label, .y_label = "-F / (μ N)", .series = {}};
        study::add_series(plot, columns, rows, selection);
        for (study::Series& series : plot.series) series.markers = false;
        return plot;
    };
    study::Plot plot = draw("Rolling with friction", "distance rolled q/a");
    if (creepage_changes) {
        selection.x = "creepage_ratio";
        plot.beside.push_back(draw("Hysteresis", "creepage ratio δ"));
    }
    if (steady != nullptr) plot.series.push_back(*steady);
    return plot;
}

}  // namespace friction
