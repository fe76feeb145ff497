// Nodes of a contact table as rows of CSV, in which they travel between machines.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <rollbem/vehicle/make_contact_table.hpp>

#include "support/options.hpp"
#include "support/table.hpp"

namespace contact {

/// The rows of one line of shifts: for each shift and side one for each zone that there may be.
std::size_t rows_of_line(const rollbem::ContactTable::Grid& grid, std::size_t sides);

/// The table of rows of a maker, which is to solve the lines that it asks for. Both must outlive it.
study::Table node_table(rollbem::ContactTableMaker& maker, const rollbem::ContactTable::Grid& grid);

/// The sides of a table by the rows of --rows. Throws BadInput.
std::vector<rollbem::ContactSide> read_sides(const study::Options& options, const rollbem::ContactTable::Grid& grid,
                                             std::size_t sides);

}  // namespace contact
