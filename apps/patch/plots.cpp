#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <utility>

#include "patch.hpp"
#include "studies/kalker_table.hpp"

namespace patch {

namespace {

using Columns = std::vector<std::string>;
using study::Records;

const Columns patch_columns{"a_over_b", "poisson", "n", "strips"};

/// The column `scheme` where there are several.
Columns by_scheme(const Records& rows) { return rows.texts("scheme").size() > 1 ? Columns{"scheme"} : Columns{}; }

/// A quantity that a picture of patches may have along x.
struct Axis {
    std::string column, label;
};
const std::vector<Axis> picture_axes{{"longitudinal", "ξ G a b / (μ N)"}, {"lateral", "η G a b / (μ N)"},
                                     {"spin", "φ G a b c / (μ N)"},       {"a_over_b", "a/b"},
                                     {"n", "elements of a strip n"},      {"strips", "number of strips m"},
                                     {"poisson", "Poisson's ratio ν"}};

/// The axis among `first` ... `last` - 1 whose column has the most values.
Axis most_varied(const Records& rows, std::ptrdiff_t first, std::ptrdiff_t last) {
    const auto count = [&](const Axis& axis) { return rows.numbers(axis.column).size(); };
    return *std::max_element(picture_axes.begin() + first, picture_axes.begin() + last,
                             [&](const Axis& one, const Axis& other) { return count(one) < count(other); });
}

/// The columns of the other axes; not the strips over n if there are as many.
Columns others(const Records& rows, const Axis& x) {
    const bool as_many = std::all_of(rows.rows.begin(), rows.rows.end(), [&](const study::Row& row) {
        return rows.number(row, "n") == rows.number(row, "strips");
    });
    Columns by = by_scheme(rows);
    for (const Axis& axis : picture_axes) {
        if (study::contains(rows.columns, axis.column) && axis.column != x.column &&
            !(x.column == "n" && axis.column == "strips" && as_many)) {
            by.push_back(axis.column);
        }
    }
    return by;
}

/// A panel like `frame` for each column with its label; a title that has creepages has their unit.
study::Picture panels_of(const study::Plot& frame, const Records& rows, study::Selection selection,
                         const std::vector<Axis>& labels) {
    study::Picture panels;
    for (const auto& [column, label] : labels) {
        study::Plot& panel = panels.emplace_back(frame);
        panel.y.label = label;
        selection.y = column;
        study::add_series(panel, rows, selection);
        const auto has = [&](const char* creepage) { return panel.title.find(creepage) != std::string::npos; };
        if (has("ξ = ") || has("η = ") || has("φ c = ")) panel.title += " in μ N / (G a b)";
    }
    return panels;
}

/// Forces and moment, and how their axes call them; what is found `by_force` is the creepage.
std::vector<Axis> forces_over(const std::string& force, const std::string& c, bool by_force) {
    return {by_force ? picture_axes[0] : Axis{"longitudinal_force", "-F_x / (" + force + ")"},
            {"lateral_force", "-F_y / (" + force + ")"},
            {"spin_moment", "-M_z / (" + force + " " + c + ")"}};
}

/// Kalker's points at the Poisson's ratios of the rows, within their range of a/b.
void add_table(study::Plot& plot, std::array<double, 3> rollbem::studies::KalkerRow::*coefficient,
               const Records& rows) {
    const std::set<double> ratios = rows.numbers("a_over_b"), poisson = rows.numbers("poisson");
    const std::array<double, 3> tabulated{0, 0.25, 0.5};
    for (std::size_t k = 0; k < 3; ++k) {
        if (!poisson.contains(tabulated[k])) continue;
        study::Series points{"Kalker, ν = " + study::Cell(tabulated[k]).text(6), study::Look::exact_markers};
        for (const rollbem::studies::KalkerRow& row : rollbem::studies::kalker_table) {
            if (row.a_over_b < *ratios.begin() || row.a_over_b > *ratios.rbegin()) continue;
            points.points.emplace_back(row.a_over_b, (row.*coefficient)[k]);
        }
        plot.series.push_back(std::move(points));
    }
}

/// The edge of a patch as a closed line, in c.
std::vector<std::pair<double, double>> edge_of(const rollbem::PatchContact& contact) {
    std::vector<std::pair<double, double>> points;
    if (contact.outline()) points = study::edge_of(*contact.outline());
    for (int i = 0; i <= 360 && !contact.outline(); ++i) {
        const double angle = i * std::numbers::pi / 180;
        points.emplace_back(contact.half_length() * std::cos(angle), contact.half_width() * std::sin(angle));
    }
    for (auto& [x, y] : points) x /= contact.c(), y /= contact.c();
    return points;
}

/// The zones of stick and slip, tractions on body 1 and the pole of the rigid slip. y points down: z points away from
/// the viewer.
study::Plot seen_from_above(const Patch& patch, const CreepPoint& point, const Records& tractions) {
    const rollbem::PatchContact& contact = patch.contact;
    const auto shown = [](double value) { return study::Cell(value).text(6); };
    study::Plot plot{"Patch from above", {"x / c, rolling to the right"}, {"y / c"}};
    plot.to_scale = plot.y_down = true;
    if (tractions.rows.empty()) return plot;  // of another shard
    if (!contact.outline()) plot.title += ", a/b = " + shown(contact.a_over_b());
    plot.title += ", ν = " + shown(contact.poisson_ratio()) + ", " + std::to_string(patch.mesh.elements_per_strip()) +
                  " × " + std::to_string(patch.mesh.strip_count()) + " elements, ξ = " + shown(point.longitudinal) +
                  ", η = " + shown(point.lateral) + ", φ c = " + shown(point.spin) + " in μ N / (G a b)";
    study::Series stick{"stick", study::Look::stick_cells}, slip{"slip", study::Look::slip_cells},
        arrows{"", study::Look::arrows}, pole{"pole of spin", study::Look::crosses};
    const double pole_x = -point.lateral / point.spin, pole_y = point.longitudinal / point.spin;
    const double a = contact.half_length() / contact.c(), b = contact.half_width() / contact.c();
    double longest = 0, area = 0;
    for (const study::Row& row : tractions.rows) {
        const auto number = [&](const char* name) { return tractions.number(row, name); };
        const double traction = std::hypot(number("traction_x"), number("traction_y"));
        if (std::isnan(traction)) plot.title += ": no result";
        if (std::isnan(traction)) break;
        if (!(number("pressure_bound") > 0)) continue;
        const double x = number("x") * a, y = number("y") * b;
        const double dx = number("width") * a / 2, dy = number("strip_width") * b / 2;
        auto& zone = (number("stick") > 0 ? stick : slip).points;
        zone.emplace_back(x - dx, y - dy);
        zone.emplace_back(x + dx, y + dy);
        // it may lie on an edge between two elements
        if (std::abs(pole_x - x) <= 1.001 * dx && std::abs(pole_y - y) <= 1.001 * dy) pole.points = {{pole_x, pole_y}};
        arrows.points.emplace_back(x, y);
        arrows.points.emplace_back(number("traction_x"), number("traction_y"));
        longest = std::max(longest, traction);
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
    plot.series = {stick, slip, {"", study::Look::outline, edge_of(contact)}, arrows, pole};
    return plot;
}

}  // namespace

study::Picture draw_coefficients(const Records& rows) {
    const bool over_ratio = rows.numbers("a_over_b").size() > 1;
    const Axis x = picture_axes[over_ratio ? 3 : 4];
    const study::Plot frame{"Creep coefficients of contact patches", {x.label, true}, {.logarithmic = over_ratio}};
    study::Picture panels = panels_of(frame, rows, {.by = others(rows, x), .x = x.column},
                                      {{"c11", "c_{11}"}, {"c22", "c_{22}"}, {"c23", "c_{23}"}, {"c33", "c_{33}"}});
    if (over_ratio) {
        add_table(panels[0], &rollbem::studies::KalkerRow::c11, rows);
        add_table(panels[1], &rollbem::studies::KalkerRow::c22, rows);
        add_table(panels[2], &rollbem::studies::KalkerRow::c23, rows);
    }
    if (study::contains(rows.columns, "unstable_count")) {
        const auto unstable = std::count_if(rows.rows.begin(), rows.rows.end(), [&](const study::Row& row) {
            return rows.number(row, "unstable_count") > 0;
        });
        panels[0].title += "; modes grow in " + (unstable > 0 ? std::to_string(unstable) : "none") + " of " +
                           std::to_string(rows.rows.size());
    }
    return panels;
}

study::Picture draw_responses(const Records& rows) {
    const std::set<double> omegas = rows.numbers("omega");
    const bool logarithmic = !omegas.empty() && *omegas.begin() > 0 && *omegas.rbegin() > 20 * *omegas.begin();
    study::Picture panels;
    for (const std::string ij : {"11", "22", "23", "33"}) {
        study::Plot& panel = panels.emplace_back(study::Plot{"Frequency response of contact patches",
                                                             {"ω a / V", logarithmic},
                                                             {"Re c_{" + ij + "}, Im c_{" + ij + "}"}});
        for (const auto& [part, prefix] : {std::pair{"_re", "Re"}, {"_im", "Im"}}) {
            study::add_series(panel, rows, {.by = patch_columns, .x = "omega", .y = "c" + ij + part, .prefix = prefix});
        }
    }
    return panels;
}

study::Picture draw_friction(const Records& rows, bool by_force) {
    Axis x = most_varied(rows, by_force ? 1 : 0, 3);  // a creepage if any varies
    if (rows.numbers(x.column).size() <= 1) x = most_varied(rows, 3, 7);
    study::Selection selection{.by = others(rows, x), .x = x.column};
    if (by_force) std::erase(selection.by, "longitudinal");
    return panels_of({"Contact patch with friction", {x.label, x.column == "a_over_b"}}, rows, selection,
                     forces_over("μ N", "c", by_force));
}

study::Picture draw_from_above(const std::vector<Patch>& patches, const CreepPoint& point,
                               const study::SideTable& tractions) {
    study::Picture panels;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        panels.push_back(seen_from_above(patches[i], point, tractions.of(i)));
    }
    return panels;
}

study::Picture draw_in_time(const Records& rows, bool load_varies, bool by_force) {
    study::Selection selection{.by = study::joined(patch_columns, by_scheme(rows)), .x = "q_over_a"};
    for (const char* creepage : {"longitudinal", "lateral", "spin"}) {  // which a history varies within a curve
        if (rows.numbers(creepage).size() == 1) selection.by.emplace_back(creepage);
    }
    study::Picture panels = panels_of({"Patch in time", {"distance rolled q/a"}}, rows, selection,
                                      forces_over(load_varies ? "μ N_0" : "μ N", load_varies ? "c_0" : "c", by_force));
    if (load_varies) {
        study::add_series(panels[0], rows,
                          {.x = "q_over_a", .y = "load_ratio", .prefix = "load N/N_0", .look = study::Look::exact});
    }
    return panels;
}

}  // namespace patch
