#include "plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <utility>

#include <rollbem/studies/kalker_table.hpp>

namespace patch {

namespace {

/// The numbers of a column, each once.
std::set<double> values(const std::vector<study::Row>& rows, std::size_t column) {
    std::set<double> found;
    for (const study::Row& row : rows) {
        if (const auto number = row[column].number()) found.insert(*number);
    }
    return found;
}

/// Kalker's points at the Poisson's ratios of the rows, within their range of a/b.
void add_table(study::Plot& plot, std::size_t coefficient, const std::vector<study::Row>& rows) {
    const std::set<double> ratios = values(rows, 0), poisson = values(rows, 1);
    const std::array<double, 3> tabulated{0, 0.25, 0.5};
    for (std::size_t k = 0; k < 3; ++k) {
        if (!poisson.contains(tabulated[k]) || coefficient > 2) continue;
        study::Series points{.label = "Kalker, ν = " + study::Cell(tabulated[k]).text(6),
                             .line = false,
                             .open = true,
                             .reference = true};
        for (const rollbem::KalkerRow& row : rollbem::kalker_table) {
            if (row.a_over_b < *ratios.begin() || row.a_over_b > *ratios.rbegin()) continue;
            const std::array<double, 3> all{row.c11[k], row.c22[k], row.c23[k]};
            points.points.emplace_back(row.a_over_b, all[coefficient]);
        }
        plot.series.push_back(std::move(points));
    }
}

/// The edge of a patch as a closed line, in c.
std::vector<std::pair<double, double>> edge_of(const rollbem::PatchContact<double>& contact) {
    std::vector<std::pair<double, double>> points;
    const double c = contact.c();
    if (const auto* outline = contact.outline()) {
        const auto& y = outline->y();
        for (Eigen::Index i = 0; i < y.size(); ++i) points.emplace_back(outline->trailing(y[i]) / c, y[i] / c);
        for (Eigen::Index i = y.size(); i-- > 0;) points.emplace_back(outline->leading(y[i]) / c, y[i] / c);
        points.push_back(points.front());
        return points;
    }
    for (int i = 0; i <= 360; ++i) {
        const double angle = i * std::numbers::pi / 180;
        points.emplace_back(contact.half_length() / c * std::cos(angle), contact.half_width() / c * std::sin(angle));
    }
    return points;
}

/// Whether the patch covers a place, in c.
bool covers(const rollbem::PatchContact<double>& contact, double x, double y) {
    const double c = contact.c();
    if (const auto* outline = contact.outline()) {
        return y * c >= outline->low() && y * c <= outline->high() && x * c >= outline->trailing(y * c) &&
               x * c <= outline->leading(y * c);
    }
    return std::hypot(x * c / contact.half_length(), y * c / contact.half_width()) <= 1;
}

/// What sticks, what slips, tractions on body 1 and the pole of the rigid slip. y points down: z points away from who
/// looks.
study::Plot seen_from_above(const Patch& patch, const CreepPoint& point, const std::vector<study::Row>& rows) {
    const rollbem::PatchContact<double>& contact = patch.contact;
    const auto shown = [](double value) { return study::Cell(value).text(6); };
    study::Plot plot{
        .title = "Patch from above", .x_label = "x / c, rolling to the right", .y_label = "y / c", .true_scale = true};
    if (!contact.outline()) plot.title += ", a/b = " + shown(contact.a_over_b());
    plot.title += ", ν = " + shown(contact.poisson_ratio()) + ", " + std::to_string(patch.mesh.elements_per_strip()) +
                  " × " + std::to_string(patch.mesh.strip_count()) + " elements, ξ = " + shown(point.longitudinal) +
                  ", η = " + shown(point.lateral) + ", φ c = " + shown(point.spin) + " in μ N / (G a b)";
    study::Series stick{.label = "stick", .style = 5, .shape = study::Shape::rectangles};
    study::Series slip{.label = "slip", .style = 4, .shape = study::Shape::rectangles};
    study::Series arrows{.reference = true, .shape = study::Shape::arrows};
    const auto number = [&](const study::Row& row, const char* name) {
        return row[study::index_of(traction_columns(), name)].number();
    };
    const double a = contact.half_length() / contact.c(), b = contact.half_width() / contact.c();
    double longest = 0, area = 0;
    for (const study::Row& row : rows) {
        const auto traction_x = number(row, "traction_x"), traction_y = number(row, "traction_y");
        if (!traction_x || !traction_y) return plot;  // not solved
        if (!(*number(row, "pressure_bound") > 0)) continue;
        const double x = *number(row, "x") * a, y = *number(row, "y") * b;
        const double dx = *number(row, "width") * a / 2, dy = *number(row, "strip_width") * b / 2;
        auto& zone = (*number(row, "stick") > 0 ? stick : slip).points;
        zone.emplace_back(x - dx, y - dy);
        zone.emplace_back(x + dx, y + dy);
        arrows.points.emplace_back(x, y);
        arrows.points.emplace_back(*traction_x, *traction_y);
        longest = std::max(longest, std::hypot(*traction_x, *traction_y));
        area += 4 * dx * dy;
    }
    if (arrows.points.empty()) return plot;
    // their middles in those of the elements, the longest as long as one and a half elements of mean size
    const double scale = longest > 0 ? 1.5 * std::sqrt(2 * area / double(arrows.points.size())) / longest : 0;
    for (std::size_t i = 1; i < arrows.points.size(); i += 2) {
        auto& [x, y] = arrows.points[i - 1];
        const double dx = scale * arrows.points[i].first / 2, dy = scale * arrows.points[i].second / 2;
        arrows.points[i] = {x + dx, y + dy};
        arrows.points[i - 1] = {x - dx, y - dy};
    }
    arrows.label = "traction, at most " + study::Cell(longest).text(3) + " μ p_0";
    study::Series edge{.points = edge_of(contact), .markers = false, .style = 4, .reference = true};
    study::PlotRange across{0, 0}, along{0, 0};
    for (const auto& [x, y] : edge.points) {
        along = {std::min(along.low, x), std::max(along.high, x)};
        across = {std::max(across.low, y), std::min(across.high, y)};  // points down
    }
    for (study::PlotRange* range : {&along, &across}) {
        const double margin = 0.05 * (range->high - range->low);
        *range = {range->low - margin, range->high + margin};
    }
    plot.x_range = along;
    plot.y_range = across;
    plot.series = {std::move(stick), std::move(slip), std::move(edge), std::move(arrows)};
    const double pole_x = -point.lateral / point.spin, pole_y = point.longitudinal / point.spin;
    if (point.spin != 0 && covers(contact, pole_x, pole_y)) {
        plot.series.push_back({.label = "pole of spin", .points = {{pole_x, pole_y}}, .line = false, .style = 6});
    }
    return plot;
}

}  // namespace

study::Plot draw_coefficients(const std::vector<std::string>& columns, const std::vector<study::Row>& rows) {
    const bool over_ratio = values(rows, 0).size() > 1;
    std::vector<study::Plot> panels;
    const std::array<const char*, 4> names{"c11", "c22", "c23", "c33"};
    for (std::size_t k = 0; k < 4; ++k) {
        const std::string name = names[k];
        study::Plot panel{.title = k == 0 ? "Contact patch" : "",
                          .x_label = over_ratio ? "a/b" : "elements of a strip n",
                          .y_label = "c_{" + name.substr(1) + "}",
                          .log_x = true,
                          .log_y = over_ratio};
        std::vector<std::string> by{"poisson", "strips"};
        if (over_ratio) by = {"poisson", "n", "strips"};
        if (!over_ratio && values(rows, 3).size() == values(rows, 2).size()) by = {"poisson"};
        study::add_series(panel, columns, rows, {.by = by, .x = over_ratio ? "a_over_b" : "n", .y = name});
        if (over_ratio) {
            for (study::Series& series : panel.series) series.markers = false;
            add_table(panel, k, rows);
        }
        if (k > 0) panel.title.clear();
        if (k == 0 || can_be_drawn(panel)) panels.push_back(std::move(panel));
    }
    return study::side_by_side(std::move(panels));
}

study::Plot draw_responses(const std::vector<std::string>& columns, const std::vector<study::Row>& rows) {
    std::vector<study::Plot> panels;
    for (const std::string name : {"c11", "c22", "c23", "c33"}) {
        study::Plot panel{.x_label = "ω a / V",
                          .y_label = "Re c_{" + name.substr(1) + "}, Im c_{" + name.substr(1) + "}"};
        const std::set<double> omegas = values(rows, 4);
        panel.log_x = !omegas.empty() && *omegas.begin() > 0 && *omegas.rbegin() > 20 * *omegas.begin();
        for (const bool real : {true, false}) {
            study::Plot part{.title = "Contact patch"};
            study::add_series(
                part, columns, rows,
                {.by = {"a_over_b", "poisson", "n", "strips"}, .x = "omega", .y = name + (real ? "_re" : "_im")});
            for (std::size_t k = 0; k < part.series.size(); ++k) {
                study::Series& series = part.series[k];
                series.label = (real ? "Re" : "Im") + (series.label.empty() ? "" : ", " + series.label);
                series.style = 2 * k + (real ? 0 : 1);
                series.markers = series.points.size() <= 30;
                panel.series.push_back(std::move(series));
            }
            if (panels.empty()) panel.title = part.title;
        }
        panels.push_back(std::move(panel));
    }
    return study::side_by_side(std::move(panels));
}

study::Plot draw_friction(const std::vector<study::Row>& rows) {
    const std::vector<std::string> given{"longitudinal", "lateral", "spin", "a_over_b", "n", "strips", "poisson"};
    const std::array<const char*, 7> labels{"ξ G a b / (μ N)",       "η G a b / (μ N)",    "φ G a b c / (μ N)", "a/b",
                                            "elements of a strip n", "number of strips m", "Poisson's ratio ν"};
    std::vector<std::size_t> counts;
    for (const std::string& name : given) {
        counts.push_back(values(rows, study::index_of(friction_columns(), name)).size());
    }
    // a creepage if any varies
    const auto creepages = counts.begin() + 3;
    auto varied = std::max_element(counts.begin(), creepages);
    if (*varied <= 1) varied = std::find_if(creepages, counts.end() - 1, [](std::size_t count) { return count > 1; });
    const auto most = std::size_t(varied - counts.begin());
    const bool as_many_strips =
        std::all_of(rows.begin(), rows.end(), [](const study::Row& row) { return row[2].number() == row[3].number(); });
    std::vector<std::string> by;
    for (std::size_t k = 0; k < given.size(); ++k) {
        if (k != most && !(given[most] == "n" && given[k] == "strips" && as_many_strips)) by.emplace_back(given[k]);
    }
    std::vector<study::Plot> panels;
    const std::array<const char*, 3> forces{"longitudinal_force", "lateral_force", "spin_moment"};
    const std::array<const char*, 3> axes{"- F_x / (μ N)", "- F_y / (μ N)", "- M_z / (μ N c)"};
    for (std::size_t k = 0; k < 3; ++k) {
        study::Plot panel{.title = k == 0 ? "Contact patch with friction" : "",
                          .x_label = labels[most],
                          .y_label = axes[k],
                          .log_x = most == 3};
        study::add_series(panel, friction_columns(), rows, {.by = by, .x = given[most], .y = forces[k]});
        const bool rounding = std::all_of(panel.series.begin(), panel.series.end(), [](const study::Series& series) {
            return std::all_of(series.points.begin(), series.points.end(),
                               [](const auto& point) { return std::abs(point.second) < 1e-13; });
        });
        if (rounding) panel.y_range = study::PlotRange{-1, 1};
        if (k > 0) panel.title.clear();
        panels.push_back(std::move(panel));
    }
    return study::side_by_side(std::move(panels));
}

study::Plot draw_from_above(const std::vector<Patch>& patches, const CreepPoint& point, const Tractions& tractions) {
    std::vector<study::Plot> panels;
    for (const auto& [place, rows] : tractions.all()) {
        if (study::Plot panel = seen_from_above(patches[place.first], point, rows); can_be_drawn(panel)) {
            panels.push_back(std::move(panel));
        }
    }
    return study::side_by_side(std::move(panels));
}

study::Plot draw_in_time(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                         bool load_varies) {
    const std::vector<std::string> by{"a_over_b", "poisson", "n", "strips", "nodes", "longitudinal", "lateral", "spin"};
    const std::string load = load_varies ? "μ N_0" : "μ N";
    const std::array<const char*, 3> forces{"longitudinal_force", "lateral_force", "spin_moment"};
    const std::array<std::string, 3> labels{"-F_x / (" + load + ")", "-F_y / (" + load + ")",
                                            "-M_z / (" + load + (load_varies ? " c_0)" : " c)")};
    std::vector<study::Plot> panels;
    for (std::size_t k = 0; k < 3; ++k) {
        study::Plot panel{.title = "Patch in time", .x_label = "distance rolled q/a", .y_label = labels[k]};
        study::add_series(panel, columns, rows, {.by = by, .x = "q_over_a", .y = forces[k]});
        for (study::Series& series : panel.series) series.markers = false;
        panels.push_back(std::move(panel));
    }
    study::Plot& first = panels.front();
    const bool one_patch = first.series.size() <= 1;
    for (std::size_t k = 1; k < 3; ++k) {
        if (one_patch) {
            for (study::Series& series : panels[k].series) first.series.push_back(std::move(series));
        } else {
            panels[k].title.clear();
            first.beside.push_back(std::move(panels[k]));
        }
    }
    if (one_patch) first.y_label = "force over " + load + ", moment over " + load + (load_varies ? " c_0" : " c");
    if (load_varies && !rows.empty()) {
        study::add_reference(first, columns, rows, {.by = by, .x = "q_over_a", .y = "load_ratio"}, "load N/N_0");
    }
    return std::move(first);
}

}  // namespace patch
