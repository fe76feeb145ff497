#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/compiled/wheelset.hpp>
#include <rollbem/normal/virtual_penetration.hpp>

#include "profile.hpp"
#include "support/table.hpp"
#include "support/timing.hpp"

namespace profile {

namespace {

using rollbem::Status;
using rollbem::WheelOnRail;
using rollbem::WheelsetPosition;

/// Of all patches of a wheel.
struct Totals {
    double load = 0, area = 0, peak_pressure = 0;
    Status status = Status::ok;

    void add(double own_load, double own_area, double own_peak, Status own) {
        load += own_load;
        area += own_area;
        peak_pressure = std::max(peak_pressure, own_peak);
        status = std::max(status, own);
    }
};

struct Method {
    std::string name;
    std::function<Totals(const WheelOnRail&, const WheelsetPosition&)> solve;
};

Totals totals_of(const WheelOnRail::Contact& contact) {
    Totals totals{.status = contact.status};
    for (const rollbem::RailPatch& patch : contact.patches) {
        totals.add(patch.load, patch.area, patch.peak_pressure, patch.status);
    }
    return totals;
}

Method cells(Eigen::Index across, const std::string& name) {
    return {name, [=](const WheelOnRail& wheel, const WheelsetPosition& at) {
                WheelOnRail::Workspace workspace;
                return totals_of(wheel.solve_at_height(at, workspace, {.cells_x = 2 * across, .cells_s = across}));
            }};
}

/// The first is what the others are beside, the last their reference.
const std::vector<Method>& methods() {
    static const std::vector<Method> all{{"virtual-penetration",
                                          [](const WheelOnRail& wheel, const WheelsetPosition& at) {
                                              Totals totals;
                                              const auto contacts = virtual_penetration(wheel, at);
                                              if (contacts.empty()) totals.status = Status::no_contact;
                                              for (const auto& c : contacts) {
                                                  totals.add(c.load, c.area, c.peak_pressure, c.status);
                                              }
                                              return totals;
                                          }},
                                         cells(10, "cells-20x10"),
                                         cells(20, "cells-40x20"),
                                         cells(40, "cells-80x40")};
    return all;
}

/// The rows of one shift, at the height where the reference carries the load.
std::vector<study::Row> rows_at(const WheelOnRail& wheel, double shift, double load, bool timed) {
    WheelOnRail::Workspace workspace;
    const WheelOnRail::Contact carried =
        wheel.solve_for_load({.lateral = shift}, load, workspace, {.cells_x = 80, .cells_s = 40});
    const WheelsetPosition at{.lateral = shift, .height = carried.height};
    const bool found = rollbem::has_numbers(carried.status);
    const Totals reference = found ? methods().back().solve(wheel, at) : Totals{.status = carried.status};
    std::vector<study::Row> rows;
    for (const Method& method : methods()) {
        Totals own = reference;
        study::Cell time;
        if (found) {
            time = study::time_us_if(timed, [&] {
                own = method.solve(wheel, at);
                return own.load;
            });
        }
        const Status status =
            std::max(own.status, rollbem::has_numbers(reference.status) ? own.status : reference.status);
        const bool known = rollbem::has_numbers(status);
        const auto cell = [&](double value) { return known ? study::Cell(value) : study::Cell(); };
        rows.push_back({shift, method.name, found ? study::Cell(carried.height) : study::Cell(), cell(own.load),
                        cell(own.area), cell(own.peak_pressure), cell(own.load / reference.load - 1),
                        cell(own.area / reference.area - 1), cell(own.peak_pressure / reference.peak_pressure - 1),
                        time, name(status)});
    }
    return rows;
}

study::Plot draw(const std::vector<study::Row>& rows) {
    const auto number = [](const study::Row& row, std::size_t column) {
        return row[column].number().value_or(nan(""));
    };
    study::Plot cost{.title = "Each point is a lateral shift",
                     .x_label = "time [microseconds]",
                     .y_label = "|relative error of the load|",
                     .log_x = true,
                     .log_y = true};
    study::Plot errors{.title = "Virtual penetration", .x_label = "shift [mm]", .y_label = "relative error"};
    for (std::size_t k = 0; k + 1 < methods().size(); ++k) {
        cost.series.push_back({.label = methods()[k].name, .line = false});
    }
    for (const char* label : {"load", "area", "largest pressure"}) errors.series.push_back({.label = label});
    double largest = 0, where = 0;
    for (const study::Row& row : rows) {
        for (study::Series& series : cost.series) {
            if (series.label != row[1].text()) continue;
            series.points.emplace_back(number(row, 9), std::abs(number(row, 6)));
        }
        if (row[1].text() != methods()[0].name) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            errors.series[k].points.emplace_back(1e3 * number(row, 0), number(row, 6 + k));
        }
        if (!(std::abs(number(row, 6)) > std::abs(largest))) continue;
        largest = number(row, 6);
        where = number(row, 0);
    }
    errors.title +=
        ": load off by " + study::Cell(100 * largest).text(3) + " % at " + study::Cell(1e3 * where).text(4) + " mm";
    std::vector<study::Plot> panels{std::move(errors)};
    if (study::can_be_drawn(cost)) panels.push_back(std::move(cost));
    return study::in_one_column(std::move(panels));
}

}  // namespace

void add_method_options(study::Options& options) {
    options.group("Methods for the normal problem");
    options.add_flag("virtual-penetration",
                     "instead of patches: virtual penetration (Kik and Piotrowski) beside cells, at each --shift");
    for (const char* mode : {"virtual-penetration", "conicity"}) {
        options.not_with(
            {"side",   "yaw",      "positions",   "roll",       "x",     "pitch",       "height",  "interaction",
             "cells",  "friction", "speed",       "pitch-rate", "force", "layer",       "load-of", "n",
             "strips", "slip",     "shear-yield", "outline",    "wear",  "temperature", "stress"},
            mode);
    }
    options.not_with({"left-wheel", "left-rail", "left-radius", "conicity"}, "virtual-penetration");
}

void study_methods(const study::Options& options) {
    const rollbem::WheelsetOnTrack wheelset = read_wheelset(options, read_dimensions(options));
    const WheelOnRail& wheel = wheelset.wheel();
    if (!wheel.geometry().is_plain()) {
        throw study::BadInput("--virtual-penetration = true must have round wheels on straight rails of one profile");
    }
    const std::vector<double> shifts = options.numbers("shift", study::between(-0.1, 0.1));
    const double load = options.number("load", study::positive());
    study::Table table;
    table.columns = {"shift",      "method",     "height",     "load",    "area",  "peak_pressure",
                     "load_error", "area_error", "peak_error", "time_us", "status"};
    table.rows_of_task.assign(shifts.size(), methods().size());
    table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
        const auto rows = rows_at(wheel, shifts[task], load, study::has_times(options));
        for (std::size_t k = range.first; k < range.last; ++k) emit(rows[k]);
    };
    table.plot = draw;
    study::write_table(options, table);
}

}  // namespace profile
