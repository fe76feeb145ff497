#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <utility>

#include <rollbem/studies/kalker_table.hpp>

#include "patch.hpp"

namespace patch {

namespace {

using Columns = std::vector<std::string>;
using Rows = std::vector<study::Row>;

const Columns patch_columns{"a_over_b", "poisson", "n", "strips"};

/// The numbers of a column, each once.
std::set<double> values(const Columns& columns, const Rows& rows, const std::string& column) {
    std::set<double> found;
    for (const study::Row& row : rows) {
        if (const auto number = row[study::index_of(columns, column)].number()) found.insert(*number);
    }
    return found;
}

/// The column `scheme` where there are several.
Columns by_scheme(const Columns& columns, const Rows& rows) {
    std::set<std::string> words;
    for (const study::Row& row : rows) words.insert(row[study::index_of(columns, "scheme")].text());
    return words.size() > 1 ? Columns{"scheme"} : Columns{};
}

/// A quantity that a picture of patches may have along x.
struct Axis {
    std::string column, label;
};
const std::vector<Axis> picture_axes{{"longitudinal", "ξ G a b / (μ N)"}, {"lateral", "η G a b / (μ N)"},
                                     {"spin", "φ G a b c / (μ N)"},       {"a_over_b", "a/b"},
                                     {"n", "elements of a strip n"},      {"strips", "number of strips m"},
                                     {"poisson", "Poisson's ratio ν"}};

/// The axis among `first` ... `last` - 1 whose column has the most values.
Axis most_varied(const Columns& columns, const Rows& rows, std::ptrdiff_t first, std::ptrdiff_t last) {
    const auto count = [&](const Axis& axis) { return values(columns, rows, axis.column).size(); };
    return *std::max_element(picture_axes.begin() + first, picture_axes.begin() + last,
                             [&](const Axis& one, const Axis& other) { return count(one) < count(other); });
}

/// The columns of the other axes; not the strips over n if there are as many.
Columns others(const Columns& columns, const Rows& rows, const Axis& x) {
    const bool as_many = std::all_of(rows.begin(), rows.end(), [](const study::Row& row) {
        return row[2].number() == row[3].number();  // n and strips
    });
    Columns by = by_scheme(columns, rows);
    for (const Axis& axis : picture_axes) {
        const bool is_there = study::index_of(columns, axis.column) < columns.size();
        if (is_there && axis.column != x.column && !(x.column == "n" && axis.column == "strips" && as_many)) {
            by.push_back(axis.column);
        }
    }
    return by;
}

/// A panel like `frame` for each column with its label, side by side; its title is the first one's.
std::vector<study::Plot> panels_of(const study::Plot& frame, const Columns& columns, const Rows& rows,
                                   study::Selection selection, const std::vector<Axis>& labels) {
    std::vector<study::Plot> panels;
    for (const auto& [column, label] : labels) {
        study::Plot panel = frame;
        panel.y_label = label;
        selection.y = column;
        study::add_series(panel, columns, rows, selection);
        const bool rounding = std::all_of(panel.series.begin(), panel.series.end(), [](const study::Series& series) {
            return std::none_of(series.points.begin(), series.points.end(),
                                [](const auto& point) { return std::abs(point.second) > 1e-13; });
        });
        if (rounding && !panel.log_y) panel.y_range = study::PlotRange{-1, 1};
        if (!panels.empty()) panel.title.clear();
        panels.push_back(std::move(panel));
    }
    return panels;
}

/// Forces and moment, and how their axes call them.
std::vector<Axis> forces_over(const std::string& force, const std::string& c) {
    return {{"longitudinal_force", "-F_x / (" + force + ")"},
            {"lateral_force", "-F_y / (" + force + ")"},
            {"spin_moment", "-M_z / (" + force + " " + c + ")"}};
}

/// Kalker's points at the Poisson's ratios of the rows, within their range of a/b.
void add_table(study::Plot& plot, std::array<double, 3> rollbem::studies::KalkerRow::*coefficient,
               const std::set<double>& ratios, const std::set<double>& poisson) {
    const std::array<double, 3> tabulated{0, 0.25, 0.5};
    for (std::size_t k = 0; k < 3; ++k) {
        if (!poisson.contains(tabulated[k])) continue;
        study::Series points{.label = "Kalker, ν = " + study::Cell(tabulated[k]).text(6),
                             .line = false,
                             .open = true,
                             .reference = true};
        for (const rollbem::studies::KalkerRow& row : rollbem::studies::kalker_table) {
            if (row.a_over_b < *ratios.begin() || row.a_over_b > *ratios.rbegin()) continue;
            points.points.emplace_back(row.a_over_b, (row.*coefficient)[k]);
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

/// The zones of stick and slip, tractions on body 1 and the pole of the rigid slip. y points down: z points away from
/// the viewer.
study::Plot seen_from_above(const Patch& patch, const CreepPoint& point, const study::SideTable& tractions,
                            const Rows& rows) {
    const rollbem::PatchContact<double>& contact = patch.contact;
    const auto shown = [](double value) { return study::Cell(value).text(6); };
    study::Plot plot{.title = "Patch from above", .x_label = "x / c, rolling to the right", .y_label = "y / c"};
    if (rows.empty()) return plot;  // of another shard
    plot.series = {{.points = edge_of(contact), .markers = false, .style = 4, .reference = true}};
    study::fit_to_scale(plot);
    if (!contact.outline()) plot.title += ", a/b = " + shown(contact.a_over_b());
    plot.title += ", ν = " + shown(contact.poisson_ratio()) + ", " + std::to_string(patch.mesh.elements_per_strip()) +
                  " × " + std::to_string(patch.mesh.strip_count()) + " elements, ξ = " + shown(point.longitudinal) +
                  ", η = " + shown(point.lateral) + ", φ c = " + shown(point.spin) + " in μ N / (G a b)";
    study::Series stick{.label = "stick", .style = 0, .shape = study::Shape::rectangles};
    study::Series slip{.label = "slip", .style = 4, .shape = study::Shape::rectangles};
    study::Series arrows{.reference = true, .shape = study::Shape::arrows};
    const auto number = [&](const study::Row& row, const char* name) { return tractions.number(row, name); };
    const double pole_x = -point.lateral / point.spin, pole_y = point.longitudinal / point.spin;
    bool shows_pole = false;
    const double a = contact.half_length() / contact.c(), b = contact.half_width() / contact.c();
    double longest = 0, area = 0;
    for (const study::Row& row : rows) {
        const auto traction_x = number(row, "traction_x"), traction_y = number(row, "traction_y");
        if (!traction_x || !traction_y) {
            plot.title += ": no result";
            return plot;
        }
        if (!(*number(row, "pressure_bound") > 0)) continue;
        const double x = *number(row, "x") * a, y = *number(row, "y") * b;
        const double dx = *number(row, "width") * a / 2, dy = *number(row, "strip_width") * b / 2;
        auto& zone = (*number(row, "stick") > 0 ? stick : slip).points;
        zone.emplace_back(x - dx, y - dy);
        zone.emplace_back(x + dx, y + dy);
        // it may lie on an edge between two elements
        shows_pole = shows_pole || (std::abs(pole_x - x) <= 1.001 * dx && std::abs(pole_y - y) <= 1.001 * dy);
        arrows.points.emplace_back(x, y);
        arrows.points.emplace_back(*traction_x, *traction_y);
        longest = std::max(longest, std::hypot(*traction_x, *traction_y));
        area += 4 * dx * dy;
    }
    // arrows have their middles in the middles of the elements; the longest is one and a half mean elements long
    const double scale = longest > 0 ? 1.5 * std::sqrt(2 * area / double(arrows.points.size())) / longest : 0;
    for (std::size_t i = 1; i < arrows.points.size(); i += 2) {
        auto& [x, y] = arrows.points[i - 1];
        const double dx = scale * arrows.points[i].first / 2, dy = scale * arrows.points[i].second / 2;
        arrows.points[i] = {x + dx, y + dy};
        arrows.points[i - 1] = {x - dx, y - dy};
    }
    arrows.label = "traction, at most " + study::Cell(longest).text(3) + " μ p_0";
    for (study::Series* under : {&slip, &stick}) plot.series.insert(plot.series.begin(), std::move(*under));
    plot.series.push_back(std::move(arrows));
    if (shows_pole) {
        plot.series.push_back({.label = "pole of spin", .points = {{pole_x, pole_y}}, .line = false, .style = 6});
    }
    return plot;
}

}  // namespace

study::Plot draw_coefficients(const Columns& columns, const Rows& rows) {
    const std::set<double> ratios = values(columns, rows, "a_over_b"), poisson = values(columns, rows, "poisson");
    const bool over_ratio = ratios.size() > 1;
    const Axis x = picture_axes[over_ratio ? 3 : 4];
    const study::Plot frame{.title = "Contact patch", .x_label = x.label, .log_x = true, .log_y = over_ratio};
    std::vector<study::Plot> panels =
        panels_of(frame, columns, rows, {.by = others(columns, rows, x), .x = x.column},
                  {{"c11", "c_{11}"}, {"c22", "c_{22}"}, {"c23", "c_{23}"}, {"c33", "c_{33}"}});
    if (over_ratio) {
        add_table(panels[0], &rollbem::studies::KalkerRow::c11, ratios, poisson);
        add_table(panels[1], &rollbem::studies::KalkerRow::c22, ratios, poisson);
        add_table(panels[2], &rollbem::studies::KalkerRow::c23, ratios, poisson);
    }
    if (const std::size_t at = study::index_of(columns, "unstable_count"); at < columns.size()) {
        const auto unstable = std::count_if(rows.begin(), rows.end(),
                                            [=](const study::Row& row) { return row[at].number().value_or(0) > 0; });
        panels[0].title += "; modes grow in " + (unstable > 0 ? std::to_string(unstable) : "none") + " of " +
                           std::to_string(rows.size());
    }
    panels.erase(std::remove_if(panels.begin() + 1, panels.end(), [](const auto& one) { return !can_be_drawn(one); }),
                 panels.end());
    return study::in_one_column(std::move(panels));
}

study::Plot draw_responses(const Columns& columns, const Rows& rows) {
    const std::set<double> omegas = values(columns, rows, "omega");
    const study::Plot frame{.title = "Contact patch",
                            .x_label = "ω a / V",
                            .log_x = !omegas.empty() && *omegas.begin() > 0 && *omegas.rbegin() > 20 * *omegas.begin()};
    std::vector<study::Plot> panels;
    for (const std::string ij : {"11", "22", "23", "33"}) {
        study::Plot& panel = panels.emplace_back(frame);
        panel.y_label = "Re c_{" + ij + "}, Im c_{" + ij + "}";
        for (const auto& [part, prefix] : {std::pair{"_re", "Re"}, {"_im", "Im"}}) {
            study::add_series(panel, columns, rows,
                              {.by = patch_columns,
                               .x = "omega",
                               .y = "c" + ij + part,
                               .prefix = prefix,
                               .markers = omegas.size() <= 30});
        }
        if (panels.size() > 1) panel.title.clear();
    }
    return study::in_one_column(std::move(panels));
}

study::Plot draw_friction(const Columns& columns, const Rows& rows, bool by_force) {
    Axis x = most_varied(columns, rows, by_force ? 1 : 0, 3);  // a creepage if any varies
    if (values(columns, rows, x.column).size() <= 1) x = most_varied(columns, rows, 3, 7);
    const study::Plot frame{
        .title = "Contact patch with friction", .x_label = x.label, .log_x = x.column == "a_over_b"};
    study::Selection selection{.by = others(columns, rows, x), .x = x.column};
    std::vector<Axis> shown = forces_over("μ N", "c");
    if (by_force) {  // what is found is the creepage
        std::erase(selection.by, "longitudinal");
        shown[0] = picture_axes[0];
    }
    std::vector<study::Plot> panels = panels_of(frame, columns, rows, selection, shown);
    return study::in_one_column(std::move(panels));
}

study::Plot draw_from_above(const std::vector<Patch>& patches, const CreepPoint& point,
                            const study::SideTable& tractions) {
    std::vector<study::Plot> panels;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        if (study::Plot panel = seen_from_above(patches[i], point, tractions, tractions.rows[i]); can_be_drawn(panel)) {
            panels.push_back(std::move(panel));
        }
    }
    return study::in_one_column(std::move(panels));
}

study::Plot draw_in_time(const Columns& columns, const Rows& rows, bool load_varies, bool by_force) {
    const std::string force = load_varies ? "μ N_0" : "μ N", c = load_varies ? "c_0" : "c";
    study::Selection selection{.by = study::joined(patch_columns, by_scheme(columns, rows)),
                               .x = "q_over_a",
                               .y = "load_ratio",
                               .markers = false};
    for (const char* creepage : {"longitudinal", "lateral", "spin"}) {  // which a history varies within a curve
        if (values(columns, rows, creepage).size() == 1) selection.by.emplace_back(creepage);
    }
    std::vector<Axis> shown = forces_over(force, c);
    if (by_force) shown[0] = picture_axes[0];
    const study::Plot frame{.title = "Patch in time", .x_label = "distance rolled q/a"};
    std::vector<study::Plot> panels = panels_of(frame, columns, rows, selection, shown);
    selection.prefix = "load N/N_0";
    selection.reference = true;
    if (load_varies && !rows.empty()) study::add_series(panels[0], columns, rows, selection);
    return study::in_one_column(std::move(panels));
}

}  // namespace patch
