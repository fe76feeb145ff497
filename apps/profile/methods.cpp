#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/normal/virtual_penetration.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>

#include "profile.hpp"
#include "support/sheet.hpp"
#include "support/timing.hpp"

namespace profile {

namespace {

using rollbem::Status;
using rollbem::WheelOnRail;
using rollbem::WheelsetPosition;

/// Sums over all patches of a wheel.
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

/// A method at one shift.
struct Compared {
    double shift;
    std::string method;
    std::optional<double> height;  ///< at which the reference carries the load
    Totals own, reference;
    study::Cell time_us;

    bool known() const { return rollbem::has_numbers(own.status); }
};

template <class Value>
study::Column<Compared> column(const char* name, const char* meaning, const Value& value) {
    return {name, meaning, study::where(&Compared::known, value)};
}

/// The relative error of a total.
auto error(double Totals::*total) {
    return [=](const Compared& row) { return row.own.*total / row.reference.*total - 1; };
}

const study::Sheet<Compared, double> sheet{
    "",
    {{"shift", "lateral shift of the wheelset [m]", &Compared::shift},
     {"method",
      "virtual-penetration (share 0.55 of the approach), or cells-NXxNS; where pressures have several maxima there are "
      "more cells, so that "
      "rows of two methods may be alike",
      &Compared::method},
     {"height", "height at which 80 x 40 cells carry --load [m]", &Compared::height},
     column("load", "sum of the normal forces of the right wheel [N]",
            [](const Compared& row) { return row.own.load; }),
     column("area", "sum of the areas of its patches [m^2]", [](const Compared& row) { return row.own.area; }),
     column("peak_pressure", "largest pressure [Pa]", [](const Compared& row) { return row.own.peak_pressure; }),
     column("load_error", "relative errors against 80 x 40 cells", error(&Totals::load)),
     column("area_error", "relative errors against 80 x 40 cells", error(&Totals::area)),
     column("peak_error", "relative errors against 80 x 40 cells", error(&Totals::peak_pressure)),
     {"time_us", std::string("time of all from the profiles [microseconds], ") + study::median_of_runs,
      &Compared::time_us},
     {"status", "status, as of patches", [](const Compared& row) { return name(row.own.status); }}},
    ""};

/// The rows of one shift, at the height where the reference carries the load.
std::vector<Compared> rows_at(const MethodScene& scene, double shift) {
    WheelOnRail::Workspace workspace;
    const WheelOnRail& wheel = scene.wheelset.wheel();
    const WheelOnRail::Contact carried =
        wheel.solve_for_load({.lateral = shift}, scene.load, workspace, {.cells_x = 80, .cells_s = 40});
    const WheelsetPosition at{.lateral = shift, .height = carried.height};
    const bool found = rollbem::has_numbers(carried.status);
    const Totals reference = found ? methods().back().solve(wheel, at) : Totals{.status = carried.status};
    std::vector<Compared> rows;
    for (const Method& method : methods()) {
        Compared row{shift,     method.name, found ? std::optional(carried.height) : std::nullopt,
                     reference, reference,   {}};
        if (found) {
            row.time_us = study::time_us_if(scene.timed, [&] {
                row.own = method.solve(wheel, at);
                return row.own.load;
            });
        }
        if (!rollbem::has_numbers(reference.status)) row.own.status = std::max(row.own.status, reference.status);
        rows.push_back(std::move(row));
    }
    return rows;
}

study::Picture draw(const study::Records& rows) {
    study::Plot errors{"Virtual penetration", {"shift [mm]"}, {"relative error"}};
    study::Plot cost{
        "Each point is a lateral shift", {"time [microseconds]", true}, {"|relative error of the load|", true}};
    study::Records compared{rows.columns};
    for (const study::Row& row : rows.rows) {
        if (rows.cell(row, "method").text() != methods().back().name) compared.rows.push_back(row);
    }
    add_series(cost, compared,
               {.by = {"method"}, .x = "time_us", .y = "load_error", .absolute = true, .look = study::Look::markers});
    const study::Records own = rows.with("method", methods()[0].name);
    for (const auto& [column, label] :
         {std::pair{"load_error", "load"}, {"area_error", "area"}, {"peak_error", "largest pressure"}}) {
        add_series(errors, own, {.x = "shift", .y = column, .prefix = label, .x_unit = 1e-3});
    }
    double largest = 0, where = 0;
    for (const study::Row& row : own.rows) {
        const double error = rows.number(row, "load_error");
        if (!(std::abs(error) > std::abs(largest))) continue;
        largest = error;
        where = rows.number(row, "shift");
    }
    errors.title +=
        ": load off by " + study::Cell(100 * largest).text(3) + " % at " + study::Cell(1e3 * where).text(4) + " mm";
    return {errors, cost};
}

}  // namespace

void add_method_options(study::Options& options) {
    options.group("Methods for the normal problem");
    options.add_flag("virtual-penetration",
                     "table of loads, areas and pressures by virtual penetration (Kik and Piotrowski) and by cells at "
                     "each --shift, in place of patches");
}

std::string method_help() { return "--virtual-penetration, four rows for each shift:\n" + sheet.help(); }

MethodScene read_methods(const study::Options& options) {
    MethodScene scene{read_wheelset(options, read_dimensions(options)),
                      options.numbers("shift", study::between(-0.1, 0.1)), options.number("load", study::positive()),
                      study::has_times(options)};
    if (scene.wheelset.wheel().geometry().is_plain()) return scene;
    throw study::BadInput("--virtual-penetration = true must have round wheels on straight rails of one profile");
}

study::Table method_table(const MethodScene& scene) {
    study::Table table = sheet.table(
        scene.shifts, [](double) { return methods().size(); },
        [&](double shift, study::RowRange range, const study::Results<Compared>& emit) {
            const std::vector<Compared> rows = rows_at(scene, shift);
            for (std::size_t k = range.first; k < range.last; ++k) emit(rows[k]);
        });
    table.plot = draw;
    return table;
}

}  // namespace profile
