#include "plots.hpp"

#include <array>
#include <cstddef>
#include <set>

#include <rollbem/closed_form/kalker_table.hpp>

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
                             .points = {},
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

}  // namespace

study::Plot draw_coefficients(const std::vector<std::string>& columns, const std::vector<study::Row>& rows) {
    const bool over_ratio = values(rows, 0).size() > 1;
    study::Plot first;
    const std::array<const char*, 4> names{"c11", "c22", "c23", "c33"};
    for (std::size_t k = 0; k < 4; ++k) {
        const std::string name = names[k];
        study::Plot panel{.title = k == 0 ? "Contact patch" : "",
                          .x_label = over_ratio ? "a/b" : "elements of a strip n",
                          .y_label = "c_{" + name.substr(1) + "}",
                          .log_x = true,
                          .log_y = over_ratio,
                          .series = {}};
        std::vector<std::string> by{"poisson", "strips"};
        if (over_ratio) by = {"poisson", "n", "strips"};
        if (!over_ratio && values(rows, 3).size() == values(rows, 2).size()) by = {"poisson"};
        study::add_series(panel, columns, rows, {.by = by, .x = over_ratio ? "a_over_b" : "n", .y = name});
        if (over_ratio) {
            for (study::Series& series : panel.series) series.markers = false;
            add_table(panel, k, rows);
        }
        if (k > 0) panel.title.clear();
        if (k == 0) {
            first = std::move(panel);
        } else if (can_be_drawn(panel)) {
            first.beside.push_back(std::move(panel));
        }
    }
    return first;
}

study::Plot draw_responses(const std::vector<std::string>& columns, const std::vector<study::Row>& rows) {
    study::Plot first;
    for (const std::string name : {"c11", "c22", "c23", "c33"}) {
        study::Plot panel{.title = "",
                          .x_label = "ω a / V",
                          .y_label = "Re c_{" + name.substr(1) + "}, Im c_{" + name.substr(1) + "}",
                          .series = {}};
        const std::set<double> omegas = values(rows, 4);
        panel.log_x = !omegas.empty() && *omegas.begin() > 0 && *omegas.rbegin() > 20 * *omegas.begin();
        for (const bool real : {true, false}) {
            study::Plot part{.title = "Contact patch", .x_label = "", .y_label = "", .series = {}};
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
            panel.title = part.title;
        }
        if (name == "c11") {
            first = std::move(panel);
        } else {
            panel.title.clear();
            first.beside.push_back(std::move(panel));
        }
    }
    return first;
}

}  // namespace patch
