#include <cmath>
#include <stdexcept>

#include "contact.hpp"
#include "support/csv.hpp"
#include "support/input.hpp"
#include "support/joined_rows.hpp"

namespace contact {

namespace {

using rollbem::ContactRow, rollbem::ContactTable, rollbem::ContactTableMaker;

constexpr std::size_t zones = ContactTable::Zones::most;

std::vector<std::string> columns() {
    std::vector<std::string> names =
        study::cells_of("load,yaw,shift,side,zone,cut_y,cut_half_width,height,roll,status,share,arm_x_over_yaw,arm_y");
    const auto add = [&](const char* more) {
        for (const std::string& name : study::cells_of(more)) names.push_back(name);
    };
    const auto add_matrix = [&](const char* kind) {
        for (int entry = 0; entry < 9; ++entry) {
            names.push_back(kind + std::to_string(entry / 3 + 1) + std::to_string(entry % 3 + 1));
        }
    };
    add_matrix("correction_");
    add("arm_z,angle,plane,rolling_radius,half_length_over_root,half_width_over_root,c11,c22,c23,kept,scale");
    add_matrix("bend_");
    add("peak_pressure_over_root,rail_y,wheel_y");
    add_matrix("correction_over_yaw_");
    return names;
}
constexpr std::size_t key_columns = 5, first_value = 5;  // after the key: cut, height, roll and status

/// The node and zone of a row.
struct Place {
    std::size_t line, shift, side, zone;

    Place(const ContactTable::Grid& grid, std::size_t sides, std::size_t row) {
        zone = row % zones;
        side = row / zones % sides;
        shift = row / zones / sides % grid.shifts.size();
        line = row / zones / sides / grid.shifts.size();
    }
    study::Row key(const ContactTable::Grid& grid, std::size_t sides) const {
        const std::size_t yaws = grid.yaws.size();
        return {grid.loads[line / yaws], grid.yaws[line % yaws], grid.shifts[shift],
                sides == 1  ? "both"
                : side == 0 ? "left"
                            : "right",
                zone + 1};
    }
};

study::Row node_row(const rollbem::ContactTableMaker& maker, const ContactTable::Grid& grid, const Place& place) {
    study::Row row = place.key(grid, maker.side_count());
    const ContactTable::Zones& own = maker.zones(place.side);
    const bool is_cut = place.zone < own.cuts().size(), exists = place.zone < std::size_t(own.count());
    row.push_back(is_cut ? study::Cell(own.cuts()[place.zone].y) : study::Cell());
    row.push_back(is_cut ? study::Cell(own.cuts()[place.zone].half_width) : study::Cell());
    const ContactTableMaker::Node node = maker.node(place.side, place.line, place.shift);
    row.push_back(node.known ? study::Cell(node.support) : study::Cell());
    row.push_back(node.known ? study::Cell(node.roll) : study::Cell());
    row.emplace_back(node.known ? "ok" : "no_contact");
    for (Eigen::Index k = 0; k < ContactRow::rows; ++k) {
        row.push_back(node.known && exists ? study::Cell(node.zones[place.zone][k]) : study::Cell());
    }
    return row;
}

/// The zones of one side, as its first rows have them.
ContactTable::Zones read_zones(const study::JoinedRows& rows, const ContactTable::Grid& grid, std::size_t sides,
                               std::size_t side) {
    std::vector<ContactTable::Zones::Cut> cuts;
    for (std::size_t zone = 0; zone < zones; ++zone) {
        const std::size_t row = side * zones + zone;
        const auto cells = rows.cells(row, Place(grid, sides, row).key(grid, sides));
        const auto y = study::number_of(cells[0]), half_width = study::number_of(cells[1]);
        if (!y || !half_width) break;
        cuts.push_back({*y, *half_width});
    }
    try {
        return ContactTable::Zones(cuts);
    } catch (const std::invalid_argument& error) {
        rows.require(false, side * zones, error.what());
        throw;
    }
}

/// Takes one row into its node.
void read_row(const study::JoinedRows& rows, std::size_t row, const std::vector<std::string>& cells, std::size_t zone,
              const ContactTableMaker::Side& side, ContactTableMaker::Node& node) {
    const auto& cuts = side.zones.cuts();
    const auto number = [&](std::size_t k) -> double {
        const auto found = study::number_of(cells[k]);
        if (found && std::isfinite(*found)) return *found;
        rows.require(false, row,
                     columns()[key_columns + k] + " = " + cells[k] + " must be a number; status = " + cells[4]);
        return 0;
    };
    const bool same = zone < cuts.size() ? number(0) == cuts[zone].y && number(1) == cuts[zone].half_width
                                         : cells[0].empty() && cells[1].empty();
    rows.require(same, row, "cut_y and cut_half_width must be the cuts of the first rows: parts are of one table");
    rows.require(cells[4] == "ok" || cells[4] == "no_contact", row,
                 "status = " + cells[4] + " must be ok or no_contact");
    const bool known = cells[4] == "ok";
    rows.require(zone == 0 || known == node.known, row,
                 "status = " + cells[4] + " must be the status of all rows of a node");
    node.known = known;
    if (!known) return;
    rows.require(zone == 0 || (number(2) == node.support && number(3) == node.roll), row,
                 "height and roll must be the same in all rows of a node");
    node.support = number(2);
    node.roll = number(3);
    if (zone >= std::size_t(side.zones.count())) return;
    ContactRow::Values& values = node.zones.emplace_back();
    for (Eigen::Index k = 0; k < ContactRow::rows; ++k) values[k] = number(first_value + std::size_t(k));
    rows.require(values[ContactRow::share] >= 0 && values[ContactRow::share] <= 1 + 1e-9, row,
                 "share = " + cells[first_value] + " must be 0 to 1");
    for (const auto which : {ContactRow::radius, ContactRow::length, ContactRow::width, ContactRow::c11,
                             ContactRow::c22, ContactRow::creepage_scale}) {
        const std::size_t k = first_value + std::size_t(which);
        if (!(values[ContactRow::share] > 0) || values[which] > 0) continue;
        rows.require(false, row, columns()[key_columns + k] + " = " + cells[k] + " must be positive where share is");
    }
}

/// The rows of one line of shifts.
std::size_t rows_of_line(const ContactTable::Grid& grid, std::size_t sides) {
    return grid.shifts.size() * sides * zones;
}

}  // namespace

study::Table node_table(rollbem::ContactTableMaker& maker, const ContactTable::Grid& grid) {
    const std::size_t sides = maker.side_count(), lines = grid.loads.size() * grid.yaws.size();
    study::Table table;
    table.columns = columns();
    table.rows_of_task.assign(lines, rows_of_line(grid, sides));
    table.prepare = [&maker](const std::vector<std::size_t>& tasks, const auto&) { maker.solve(tasks); };
    table.compute = [&maker, &grid, sides](std::size_t task, study::RowRange range, const study::Emit& emit) {
        for (std::size_t row = range.first; row < range.last; ++row) {
            emit(node_row(maker, grid, Place(grid, sides, task * rows_of_line(grid, sides) + row)));
        }
    };
    return table;
}

std::vector<ContactTableMaker::Side> read_sides(const study::Options& options, const ContactTable::Grid& grid,
                                                std::size_t sides) {
    const std::size_t lines = grid.loads.size() * grid.yaws.size(), count = lines * rows_of_line(grid, sides);
    const study::JoinedRows rows(options, columns(), count);
    std::vector<ContactTableMaker::Side> found(sides);
    for (std::size_t side = 0; side < sides; ++side) {
        found[side].zones = read_zones(rows, grid, sides, side);
        found[side].nodes.resize(lines * grid.shifts.size());
    }
    for (std::size_t row = 0; row < count; ++row) {
        const Place place(grid, sides, row);
        ContactTableMaker::Side& side = found[place.side];
        read_row(rows, row, rows.cells(row, place.key(grid, sides)), place.zone, side,
                 side.nodes[place.line * grid.shifts.size() + place.shift]);
    }
    return found;
}

}  // namespace contact
