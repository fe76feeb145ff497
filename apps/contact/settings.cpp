// The options of contact_table, and the tables that they ask for.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>
#include <rollbem/vehicle/wheelset_on_track.hpp>

#include "contact.hpp"
#include "profile/profile.hpp"
#include "support/input.hpp"

namespace contact {

namespace {

using rollbem::ContactTable, rollbem::CreepForceTable, rollbem::WheelsetSide;

/// The wheelset in the middle of its track must stand there as profiles are placed to, not on flanges or beside.
void require_fit(const study::Options& options, const rollbem::WheelsetOnTrack& wheelset) {
    constexpr double load = 1e5, most = 5e-3, largest_wheel = 2;  // [N], [m], [m]
    if (wheelset.wheel().dimensions().radius > largest_wheel) {
        throw study::BadInput(options.said("radius") + " must be the radius of a wheel, in m: at most 2");
    }
    rollbem::WheelsetOnTrack::Workspace workspace;
    const auto middle = wheelset.solve({}, {load, load}, workspace);
    const std::string place = has_numbers(middle.status)
                                  ? "height " + study::Cell(1e3 * middle.position.height).text(4) + " mm"
                                  : std::string("status ") + name(middle.status);
    if (has_numbers(middle.status) && std::abs(middle.position.height) < most) return;
    throw study::BadInput("the wheelset has " + place +
                          " in the middle of the track under 100 kN, and must be within 5 mm of 0: do " +
                          options.said("gauge") + ", " + options.said("flange-back") + ", " +
                          options.said("tape-offset") + " and " + options.said("radius") + " fit the profiles?");
}

Scene read_scene(const study::Options& options) {
    const rollbem::WheelOnRail::Dimensions dimensions = profile::read_dimensions(options);
    rollbem::WheelsetOnTrack wheelset = profile::read_wheelset(options, dimensions);
    for (const WheelsetSide side : rollbem::WheelsetOnTrack::sides) {
        const auto& geometry = wheelset.wheel(side).geometry();
        if (geometry.is_plain()) continue;
        throw study::BadInput(options.said("rail") + " and " + options.said("wheel") +
                              " must not change along the way: a contact table has no place along it");
    }
    require_fit(options, wheelset);
    std::string path = options.text("creep");
    for (const char* folder : {ROLLBEM_TABLES, ROLLBEM_INSTALLED_TABLES}) {
        std::error_code unknown;
        const std::string steel = std::string(folder) + "/steel.creep";
        if (path.empty() && std::filesystem::exists(steel, unknown)) path = steel;
    }
    options.require(!path.empty(), "creep", "be given, as steel.creep is not where it was installed");
    CreepForceTable creep = study::blame("--creep", [&] { return CreepForceTable::read(path); });
    const double own = creep.grid().poisson_ratio();
    options.require(std::abs(own - dimensions.poisson_ratio) <= 0.01, "poisson",
                    "be Poisson's ratio of the table of creep forces, " + study::Cell(own).text(3) +
                        ": make another one by creep_table, and give it as --creep");
    return {std::move(wheelset), std::move(creep), study::read_threads(options)};
}

/// A place where contacts are found again: its load, the wheelset with a given or a free roll, and the height [m] of
/// its middle, with a given roll of its support.
struct Known {
    double load;
    rollbem::WheelsetPosition at;
    double height;
    bool has_roll;
};

/// The option `name` must be of the profiles, the track and the material that the other options say: throws BadInput
/// unless contacts at these places have the same heights within `alike` [m].
void require_same_profiles(const study::Options& options, const char* name, const Scene& scene, double alike,
                           const std::vector<Known>& places) {
    for (const auto& [load, at, height, has_roll] : places) {
        rollbem::WheelsetOnTrack::Workspace workspace;
        const auto found = scene.wheelset.solve(at, {load, load}, workspace);
        const double own = found.position.height + (has_roll ? ContactTable::half_base * found.position.roll : 0);
        const auto text = [](double value) { return study::Cell(value).text(6); };
        options.require(has_numbers(found.status) && std::abs(own - height) <= alike, name,
                        "be of the profiles, the track and the material that the other options say: at load " +
                            text(load) + " N, yaw " + text(at.yaw) + ", shift " + text(at.lateral) +
                            " m its height is " + text(height) + " m, and theirs " + text(own) + " m");
    }
}

/// The middle and both ends of each line of nodes.
std::vector<Known> known_places(const ContactTable::Grid& grid,
                                const std::vector<rollbem::ContactTableMaker::Side>& sides) {
    const std::size_t shifts = grid.shifts.size(), yaws = grid.yaws.size();
    std::vector<Known> places;
    for (std::size_t line = 0; line < grid.loads.size() * yaws; ++line) {
        for (const std::size_t i : {std::size_t(0), shifts / 2, shifts - 1}) {
            const rollbem::ContactTableMaker::Node& node = sides.back().nodes[line * shifts + i];
            if (!node.known) continue;
            places.push_back({grid.loads[line / yaws],
                              {.lateral = grid.shifts[i], .roll = node.roll, .yaw = grid.yaws[line % yaws]},
                              node.support,
                              true});
        }
    }
    return places;
}

ContactTable read_table(const study::Options& options, const Scene& scene) {
    options.require(options.given("table"), "table", "be the file of a contact table");
    ContactTable table = study::blame(options.said("table"), [&] { return ContactTable::read(options.text("table")); });
    const auto& dimensions = scene.wheelset.wheel().dimensions();
    const bool same = table.is_mirrored() == scene.wheelset.is_mirrored() &&
                      table.side(WheelsetSide::right).radius == dimensions.radius &&
                      table.shear_modulus() == dimensions.shear_modulus &&
                      table.poisson_ratio() == dimensions.poisson_ratio;
    options.require(same, "table", "be of the wheels, radius and material that the other options say");
    const ContactTable::Grid& grid = table.grid();
    const double load = grid.loads.back();
    std::vector<Known> places;
    for (const std::size_t i : {grid.shifts.size() / 2, grid.shifts.size() * 2 / 3}) {
        const double shift = grid.shifts[i];
        places.push_back({load, {.lateral = shift}, table.on_rails(shift, 0, {load, load}).height, false});
    }
    require_same_profiles(options, "table", scene, 2e-6, places);
    return table;
}

// --- making ----------------------------------------------------------------------------------------------------------

/// The nodes of MIN,MAX,N.
std::vector<double> read_range(const study::Options& options, const std::string& name) {
    const std::vector<double> parts = options.row(name, 3);
    options.require(parts.size() == 3 && parts[0] < parts[1], name, "be MIN,MAX,N with MIN below MAX");
    options.require(parts[2] == std::floor(parts[2]) && parts[2] >= 2 && parts[2] <= 10001, name,
                    "have an integer N from 2 to 10001");
    std::vector<double> nodes;
    for (double k = 0; k < parts[2]; ++k) {
        const double from_low = k / (parts[2] - 1);
        nodes.push_back(parts[0] * (1 - from_low) + parts[1] * from_low);
    }
    return nodes;
}

ContactTable::Grid read_grid(const study::Options& options) {
    ContactTable::Grid grid;
    grid.shifts = read_range(options, "shift");
    options.require(grid.shifts.front() == -grid.shifts.back() && grid.shifts.size() >= 5, "shift",
                    "have MIN = -MAX and N of at least 5: the left wheel has the opposite shift");
    options.require(grid.shifts.back() <= 0.1, "shift", "be at most 0.1 m");
    const std::vector<double> yaws = read_range(options, "yaw");
    const bool both = yaws.front() == -yaws.back() && yaws.size() % 2 == 1;
    options.require(both || yaws.front() == 0, "yaw",
                    "have MIN = 0, or MIN = -MAX and N odd: contacts at -yaw are mirror images");
    grid.yaws = {yaws.begin() + (both ? std::ptrdiff_t(yaws.size() / 2) : 0), yaws.end()};
    if (both) grid.yaws[0] = 0;
    options.require(grid.yaws.size() <= ContactTable::most_yaws && grid.yaws.back() <= 0.3, "yaw",
                    "have at most 8 nodes from 0 on, up to 0.3 rad: values are polynomials in yaw^2 through all");
    grid.loads = options.numbers("load", study::between(1, 1e7));
    std::sort(grid.loads.begin(), grid.loads.end());
    options.require(grid.loads.size() <= ContactTable::most_loads, "load", "be at most 8");
    return grid;
}

/// A list of Y,H: the cuts of the zones.
std::optional<rollbem::ContactTable::Zones> read_zones(const study::Options& options, const std::string& name) {
    if (!options.given(name)) return std::nullopt;
    std::vector<double> numbers;
    for (const std::string& cell : study::cells_of(options.text(name))) {
        const auto number = study::number_of(cell);
        options.require(number.has_value() && std::isfinite(*number), name, "be pairs of y and half-width");
        numbers.push_back(*number);
    }
    options.require(numbers.size() % 2 == 0, name, "be pairs of y and half-width");
    std::vector<rollbem::ContactTable::Zones::Cut> cuts;
    for (std::size_t k = 0; k < numbers.size(); k += 2) cuts.push_back({numbers[k], numbers[k + 1]});
    return study::blame(options.said(name), [&] { return rollbem::ContactTable::Zones(cuts); });
}

/// Cuts between zones must lie over the rail.
void require_on_rail(const study::Options& options, const rollbem::WheelsetOnTrack& wheelset,
                     const std::array<std::optional<rollbem::ContactTable::Zones>, 2>& all) {
    for (const WheelsetSide side : rollbem::WheelsetOnTrack::sides) {
        const std::string name = side == WheelsetSide::left ? "left-zones" : "zones";
        const auto& own = all[std::size_t(side)];
        const rollbem::WheelOnRail& wheel = wheelset.wheel(side);
        const double inner = wheel.rail_origin() + wheel.rail().y().minCoeff(),
                     outer = wheel.rail_origin() + wheel.rail().y().maxCoeff();
        for (const auto& cut : own ? own->cuts() : std::vector<rollbem::ContactTable::Zones::Cut>{}) {
            options.require(
                inner < cut.y && cut.y < outer, name,
                "lie over the rail, from y = " + study::Cell(inner).text(4) + " to " + study::Cell(outer).text(4));
        }
    }
}

// --- beside patches --------------------------------------------------------------------------------------------------

std::vector<Position> read_positions(const study::Options& options, const ContactTable& table) {
    const auto range = options.pair("scan");
    options.require(range && range->first > 0 && range->second > 0 && range->first / range->second <= 1e6, "scan",
                    "be SHIFT_MAX,STEP with at most 1e6 steps");
    options.require(range->second <= range->first, "scan", "have a STEP of at most SHIFT_MAX");
    options.require(range->first <= table.largest_shift(), "scan",
                    "end within the table, at " + study::Cell(table.largest_shift()).text(6));
    std::vector<double> loads;
    const auto& nodes = table.grid().loads;
    for (std::size_t l = 0; l < nodes.size(); ++l) {
        if (l > 0) loads.push_back((nodes[l - 1] + nodes[l]) / 2);
        loads.push_back(nodes[l]);
    }
    std::vector<Position> positions;
    const auto steps = int(std::floor(range->first / range->second * (1 + 1e-9)));
    for (const double load : loads) {
        for (const double yaw : {-8e-3, -3e-3, 0.0, 3e-3, 8e-3}) {
            if (std::abs(yaw) > table.largest_yaw()) continue;
            for (int i = 0; i <= steps; ++i) positions.push_back({load, yaw, i * range->second});
        }
    }
    return positions;
}

}  // namespace

void add_options(study::Options& options) {
    for (const char* group : {"Discretisation", "Contact"}) {
        options.refuse_group(group, "a table is made from profiles", {"poisson"});
    }
    profile::add_profile_options(options);
    profile::add_track_options(options);
    options.refuse("rail-origin", "wheelsets stand on rails with a gauge");
    options.refuse("roller-radius", "wheelsets stand on straight rails");
    options.group("Table");
    options.add("load", "LIST",
                "vertical loads of each wheel [N], 1 to 8 values from 1 to 1e7; the stiffness of the contact takes two "
                "at least",
                "40000,65000,100000,160000");
    options.add(
        "shift", "MIN,MAX,N",
        "range of the wheelset's lateral shift [m] and number of nodes: MIN = -MAX, MAX up to 0.1, N 5 to 10001",
        "-0.009,0.009,361");
    options.add("yaw", "MIN,MAX,N",
                "range of the yaw angle [rad] and number of nodes: MIN = 0 or -MAX, MAX up to 0.3, N up to 8 from 0 on",
                "0,0.015,4");
    options.add(
        "zones", "LIST",
        "cuts between zones of the rail: y, half-width of each, in track axes [m]; found by the program without it");
    options.add("left-zones", "LIST",
                "cuts between zones of the left rail, as of a right one [m]; found by the program without it");
    options.add_flag("no-fit",
                     "without the fit of ellipses to friction on patches between rest and full sliding: in a fraction "
                     "of the time, with errors half as large again");
    options.add_input(
        "creep",
        "file of the creep-force table with which the contact table will be used; default: steel.creep, for steel");
    options.add("check", "N",
                "number of random cases [dimensionless], 1 to 1000000, in which the given table is compared with "
                "patches, in place of making one");
    options.add("scan", "SHIFT_MAX,STEP",
                "largest shift and its step [m], over which, over yaw and load the given table is compared with "
                "patches, in place of making one");
    options.add_argument("table", "file of the contact table to compare").only_with({"check", "scan"});
    options.not_with({"scan"}, "check");
    options.not_with({"load", "shift", "yaw", "zones", "left-zones", "no-fit"}, "check");
    options.not_with({"load", "shift", "yaw", "zones", "left-zones", "no-fit"}, "scan");
    options.only_with({"left-zones"}, {"left-wheel", "left-rail", "left-radius"});
    options.refuse("plot", "draw contacts with profile_study");
    options.refuse("no-timing", "rows have no times");
    options.set_help("output",
                     "file of the contact table, which is no CSV; with --shard and --scan CSV file of the rows, with "
                     "FILE.toml next to it, standard output without it");
    options.set_help("jobs", "number of threads [dimensionless], 1 to 1024");
    options.add_input("rows",
                      "CSV file of the rows, the parts of --shard one after the other, made with the same version and "
                      "the same options but the zones, in place of a computation");
    options.not_with({"shard"}, "rows");
    options.not_with({"shard", "rows"}, "check");
    options.not_with({"rows"}, "scan");
    options.not_with({"zones", "left-zones"}, "rows", ": rows have zones of their own");
    options.not_with({"output"}, "check");
}

Making read_making(const study::Options& options) {
    rollbem::ContactTableMaker::Options making{.grid = read_grid(options), .jobs = study::job_count(options)};
    making.zones = {read_zones(options, "left-zones"), read_zones(options, "zones")};
    making.fits_friction = !options.flag("no-fit");
    const bool to_file = options.given("output") && options.text("output") != "-";
    options.require(to_file || options.given("shard"), "output", "be a file: a contact table is not text");
    Making job{read_scene(options), std::move(making),
               options.said("shift") + ", " + options.said("yaw") + ", " + options.said("load")};
    require_on_rail(options, job.scene.wheelset, job.making.zones);
    if (!options.given("rows")) return job;
    job.sides = read_sides(options, job.making.grid, job.scene.wheelset.is_mirrored() ? 1 : 2);
    require_same_profiles(options, "rows", job.scene, 1e-7, known_places(job.making.grid, job.sides));
    return job;
}

Comparison read_comparison(const study::Options& options) {
    const Scene scene = read_scene(options);
    Comparison comparison{scene, read_table(options, scene)};
    if (options.given("check")) comparison.scenes = std::size_t(options.integer("check", 1, 1'000'000));
    if (options.given("scan")) comparison.positions = read_positions(options, comparison.table);
    return comparison;
}

}  // namespace contact
