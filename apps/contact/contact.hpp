// Contact tables: what contact_table is asked for, and nodes as rows of CSV, in which they travel between machines.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <rollbem/vehicle/make_contact_table.hpp>

#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/table.hpp"

namespace contact {

/// The wheelset, and the tables that say what acts on it.
struct Scene {
    rollbem::WheelsetOnTrack wheelset;
    rollbem::CreepForceTable creep;
    study::Threads threads;
};

/// A table to make.
struct Making {
    Scene scene;
    rollbem::ContactTableMaker::Options making;
    std::string said;                                       ///< the options of the grid, for messages
    std::vector<rollbem::ContactTableMaker::Side> sides{};  ///< of --rows, in place of a computation
};

struct Position {
    double load, yaw, shift;
    std::string label() const { return "shift = " + study::Cell(shift).text(4) + " m"; }
};

/// A table beside patches, in random scenes or at positions.
struct Comparison {
    Scene scene;
    rollbem::ContactTable table;
    std::size_t scenes = 0;
    std::vector<Position> positions{};
};

// --- the options, read at the door. The readers throw BadInput.

void add_options(study::Options& options);
Making read_making(const study::Options& options);
Comparison read_comparison(const study::Options& options);

/// The sides of a table by the rows of --rows.
std::vector<rollbem::ContactTableMaker::Side> read_sides(const study::Options& options,
                                                         const rollbem::ContactTable::Grid& grid, std::size_t sides);

/// The table of rows of a maker, which is to solve the lines that it asks for: for each shift and side of a line one
/// for each zone that there may be. Both must outlive it.
study::Table node_table(rollbem::ContactTableMaker& maker, const rollbem::ContactTable::Grid& grid);

}  // namespace contact
