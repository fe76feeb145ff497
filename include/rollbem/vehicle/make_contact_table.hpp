// make_contact_table: makes the contact table of a wheelset from its profiles, with zones that fit them.
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "../detail/hidden.hpp"
#include "contact_table.hpp"
#include "creep_force_table.hpp"
#include "wheelset_on_track.hpp"

namespace rollbem {

/// Grid of equal steps: shifts from minus the largest to the largest, yaws from 0; loads are 0.4, 0.65, 1 and 1.6 times
/// the nominal load.
ContactTable::Grid contact_table_grid(double nominal_load = 1e5, double largest_shift = 9e-3, std::size_t shifts = 361,
                                      double largest_yaw = 15e-3, std::size_t yaws = 4);

/// Makes the table of a wheelset whose wheels carry equal loads, line by line of its grid, so that several machines may
/// share the lines. One side, the right one, stands for both where they are mirror images.
///
/// \code
/// #include <rollbem/vehicle.hpp>
/// #include <rollbem/vehicle/make_contact_table.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const auto creep = CreepForceTable::read("share/rollbem/steel.creep");
///     const WheelsetOnTrack wheelset(WheelOnRail(s1002(), rail_60e1()));
///     const ContactTable::Grid grid{.shifts = {-1e-3, -5e-4, 0, 5e-4, 1e-3}, .yaws = {0, 1e-3}, .loads = {80e3}};
///     // all lines in one process
///     const auto made = make_contact_table(wheelset, creep, {.grid = grid, .fits_friction = false});
///     return made.missing_share == 0 ? 0 : 1;
/// }
/// \endcode
class ContactTableMaker {
public:
    /// What a contact table is made of, and how.
    struct Options {
        ContactTable::Grid grid = contact_table_grid();
        WheelOnRail::Options contacts{};
        /// Zones of the left and of the right wheel; empty: found.
        std::array<std::optional<ContactTable::Zones>, 2> zones{};
        /// Whether ellipses are fitted to friction on the patches between rest and full sliding, which takes most of
        /// the time; otherwise errors are about half as large again.
        bool fits_friction = true;
        std::size_t jobs = 1;
        /// Called after each line of contacts, and after each line of the rows of a side; must not throw.
        std::function<void()> done = [] {};
        /// Number of lines of shifts, one for each load and yaw: all yaws of a load follow one another.
        std::size_t lines() const { return grid.yaws.size() * grid.loads.size(); }
    };

    /// One wheel at a node of the grid, in the numbers of a table.
    struct Node {
        bool known = false;                       ///< whether both wheels carry their loads at the node
        double support = 0, roll = 0;             ///< numbers of ContactTable::Side::on_rails [m], [rad]
        std::vector<ContactRow::Values> zones{};  ///< a row for each
    };

    /// Zones, and all nodes in the order of ContactTable::Grid::node.
    struct Side {
        ContactTable::Zones zones;
        std::vector<Node> nodes;
    };

    /// A table, and the quality of its making.
    struct Result {
        ContactTable table;
        /// Share of the positions of the grid that the wheels cannot take under their loads. Shifts beyond the first
        /// such position on either side are not on the table; single ones are filled in from their neighbours.
        double missing_share = 0;
    };

    /// The table will be used with `creep`; `creep` and `track` must outlive the maker. Throws std::invalid_argument if
    /// the grid breaks its invariant, a wheel is not round or a rail changes along the way.
    ContactTableMaker(const WheelsetOnTrack& track, const CreepForceTable& creep, Options options);

    std::size_t side_count() const { return track_.is_mirrored() ? 1 : 2; }  ///< left and right, or both in one

    /// The lines whose positions determine the zones, every second one along all coordinates; none if all zones are
    /// given.
    std::vector<std::size_t> judged_lines() const;

    /// Finds the contacts along these lines, and the zones where they are not given.
    void solve(std::vector<std::size_t> lines);

    const ContactTable::Zones& zones(std::size_t side) const { return zones_[side]; }  ///< after solve()

    /// A node of a solved line.
    Node node(std::size_t side, std::size_t line, std::size_t shift) const;

    /// The table of all nodes. Throws std::invalid_argument if the wheels do not carry the loads at five shifts about
    /// 0, or if sides, nodes, or rows of a node are missing.
    Result table(const std::vector<Side>& sides) const;

private:
    struct Nodes;  // internal

    static constexpr const char* name = "make_contact_table";

    void require_whole(const std::vector<Side>& sides) const;
    const WheelOnRail::Dimensions& dimensions(std::size_t side) const {
        return track_.wheel(side + 1 == side_count() ? WheelsetSide::right : WheelsetSide::left).dimensions();
    }
    ContactTable::Material material() const;
    const std::optional<ContactTable::Zones>& given_zones(std::size_t side) const {
        return options_.zones[side + 1 == side_count() ? 1 : 0];
    }
    /// Nodes by which the zones of a side are judged.
    std::vector<std::size_t> judged_places(std::size_t side) const;
    ContactTable::Zones zones_of(std::size_t side);
    void solve_friction(std::size_t side, std::size_t place);
    /// Computes the rows of all nodes of a line.
    void fill_line(std::size_t side, std::size_t line);
    /// Nodes of a line at which ellipses are fitted: closer to one another where planes are steep.
    std::vector<std::size_t> fitted_places(std::size_t side, std::size_t line) const;
    /// Interpolates bends between two neighbouring nodes at which ellipses are fitted.
    void interpolate_bends(std::size_t side, std::size_t low, std::size_t high);

    const WheelsetOnTrack& track_;
    const CreepForceTable& creep_;
    Options options_;
    detail::Hidden<Nodes> nodes_;
    std::vector<bool> is_solved_;
    std::array<ContactTable::Zones, 2> zones_;
};

/// Makes a complete table by ContactTableMaker, whose exceptions it throws.
ContactTableMaker::Result make_contact_table(const WheelsetOnTrack& track, const CreepForceTable& creep,
                                             const ContactTableMaker::Options& options = {});

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/make_contact_table.ipp"
#endif
