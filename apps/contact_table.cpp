// Contacts of a wheelset with its rails over shift, yaw and load, from the profiles, as a ContactTable for the time
// loop of a vehicle; and how far forces by it are from the forces of the patches:
//
//     ./contact_table --output s1002_60e1.contact --jobs 2
//     ./contact_table --check 200 s1002_60e1.contact
//     ./contact_table --scan 0.006,0.0002 s1002_60e1.contact --output scan.csv
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <mutex>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <rollbem/compiled/wheelset.hpp>
#include <rollbem/detail/parallel_for.hpp>
#include <rollbem/vehicle/make_contact_table.hpp>

#include "contact/node_rows.hpp"
#include "profile/profile.hpp"
#include "support/csv.hpp"
#include "support/input.hpp"
#include "support/options.hpp"
#include "support/output.hpp"
#include "support/progress.hpp"
#include "support/sheet.hpp"
#include "support/table.hpp"

namespace {

using rollbem::ContactTable, rollbem::CreepForceTable, rollbem::WheelForces, rollbem::WheelsetForces;
using rollbem::WheelsetRolling, rollbem::WheelsetSide;

constexpr const char* program = "contact_table";
constexpr double friction = 0.3;

/// The wheelset, and the tables that say what acts on it.
struct Scene {
    rollbem::WheelsetOnTrack wheelset;
    CreepForceTable creep;
    std::size_t jobs;
    bool quiet;
};

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
    const rollbem::TrackDimensions dimensions = profile::read_dimensions(options);
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
    const std::size_t jobs = study::job_count(options);
    CreepForceTable creep = study::blame("--creep", [&] { return CreepForceTable::read(path); });
    const double own = creep.grid().poisson_ratio();
    options.require(std::abs(own - dimensions.poisson_ratio) <= 0.01, "poisson",
                    "be Poisson's ratio of the table of creep forces, " + study::Cell(own).text(3) +
                        ": make another one by creep_table, and give it as --creep");
    return {std::move(wheelset), std::move(creep), jobs, !study::shows_progress(options)};
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
        const double own = found.position.height + (has_roll ? ContactTable::support_y * found.position.roll : 0);
        const auto text = [](double value) { return study::Cell(value).text(6); };
        options.require(has_numbers(found.status) && std::abs(own - height) <= alike, name,
                        "be of the profiles, the track and the material that the other options say: at load " +
                            text(load) + " N, yaw " + text(at.yaw) + ", shift " + text(at.lateral) +
                            " m its height is " + text(height) + " m, and theirs " + text(own) + " m");
    }
}

/// The middle and both ends of each line of nodes.
std::vector<Known> known_places(const ContactTable::Grid& grid, const std::vector<rollbem::ContactSide>& sides) {
    const std::size_t shifts = grid.shifts.size(), yaws = grid.yaws.size();
    std::vector<Known> places;
    for (std::size_t line = 0; line < grid.loads.size() * yaws; ++line) {
        for (const std::size_t i : {std::size_t(0), shifts / 2, shifts - 1}) {
            const rollbem::ContactNode& node = sides.back().nodes[line * shifts + i];
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
std::optional<rollbem::ContactZones> read_zones(const study::Options& options, const std::string& name) {
    if (!options.given(name)) return std::nullopt;
    std::vector<double> numbers;
    for (const std::string& cell : study::cells_of(options.text(name))) {
        const auto number = study::number_of(cell, ',');
        options.require(number.has_value() && std::isfinite(*number), name, "be pairs of y and half-width");
        numbers.push_back(*number);
    }
    options.require(numbers.size() % 2 == 0, name, "be pairs of y and half-width");
    std::vector<rollbem::ContactZones::Cut> cuts;
    for (std::size_t k = 0; k < numbers.size(); k += 2) cuts.push_back({numbers[k], numbers[k + 1]});
    return study::blame(options.said(name), [&] { return rollbem::ContactZones(cuts); });
}

/// Seconds of processor time that a position takes, from one on the tread and one towards the flange.
double position_seconds(const Scene& scene, const rollbem::ContactTableMaking& making) {
    const auto start = std::clock();
    rollbem::ContactTableMaking few = making;
    few.grid.shifts = {-5e-3, -2.5e-3, 0, 2.5e-3, 5e-3};
    for (double& shift : few.grid.shifts) shift *= std::min(1.0, making.grid.shifts.back() / 5e-3);
    few.grid.yaws = {0, making.grid.yaws[1]};
    few.grid.loads = {making.grid.loads.front()};
    few.zones = {rollbem::ContactZones(), rollbem::ContactZones()};
    few.jobs = 1;
    few.done = [] {};
    try {
        make_contact_table(scene.wheelset, scene.creep, few);
    } catch (const std::invalid_argument&) {  // said when the whole is made
    }
    return double(std::clock() - start) / CLOCKS_PER_SEC / (scene.wheelset.is_mirrored() ? 6 : 10);
}

/// The settings that a table is made with.
rollbem::ContactTableMaking read_making(const study::Options& options) {
    rollbem::ContactTableMaking making{.grid = read_grid(options), .jobs = study::job_count(options)};
    making.zones = {read_zones(options, "left-zones"), read_zones(options, "zones")};
    return making;
}

void say_duration(const Scene& scene, const rollbem::ContactTableMaking& making, const char* of) {
    if (scene.quiet) return;
    const std::size_t shifts = making.grid.shifts.size();
    const std::size_t positions = making.lines() * (scene.wheelset.is_mirrored() ? shifts / 2 + 1 : shifts);
    const double seconds = position_seconds(scene, making) * double(positions) * 1.3;  // and zones
    std::fprintf(stderr, "%s: %zu positions, about %.0f s of processor time%s\n", program, positions,
                 std::max(seconds, 1.0), of);
}

void say_what_was_made(const Scene& scene, const ContactTable& table, double asked) {
    if (scene.quiet) return;
    if (table.largest_shift() < asked) {
        std::fprintf(stderr, "%s: shifts end at %.4g mm, as beyond it wheels do not carry their loads\n", program,
                     1e3 * table.largest_shift());
    }
    for (const auto& [side, name] : {std::pair(WheelsetSide::left, "left"), {WheelsetSide::right, "right"}}) {
        if (scene.wheelset.is_mirrored() && side == WheelsetSide::left) continue;
        std::string text;
        for (const auto& cut : table.side(side).zones.cuts()) {
            text += (text.empty() ? "" : ",") + study::Cell(cut.y).text(6) + "," + study::Cell(cut.half_width).text(6);
        }
        std::fprintf(stderr, "%s: zones of the %s wheel: %s\n", program, name, text.empty() ? "one" : text.c_str());
    }
}

std::string grid_said(const study::Options& options) {
    return options.said("shift") + ", " + options.said("yaw") + ", " + options.said("load");
}

/// Cuts between zones must lie over the rail.
void require_on_rail(const study::Options& options, const Scene& scene, const rollbem::ContactTableMaking& making) {
    for (const WheelsetSide side : rollbem::WheelsetOnTrack::sides) {
        const std::string name = side == WheelsetSide::left ? "left-zones" : "zones";
        const auto& zones = making.zones[std::size_t(side)];
        const rollbem::WheelOnRail& wheel = scene.wheelset.wheel(side);
        const double inner = wheel.rail_origin() + wheel.rail().y().minCoeff(),
                     outer = wheel.rail_origin() + wheel.rail().y().maxCoeff();
        for (const auto& cut : zones ? zones->cuts() : std::vector<rollbem::ContactZones::Cut>{}) {
            options.require(
                inner < cut.y && cut.y < outer, name,
                "lie over the rail, from y = " + study::Cell(inner).text(4) + " to " + study::Cell(outer).text(4));
        }
    }
}

/// One part of the rows of a table.
void make_part(const study::Options& options) {
    rollbem::ContactTableMaking making = read_making(options);
    const ContactTable::Grid grid = making.grid;
    const Scene scene = read_scene(options);
    require_on_rail(options, scene, making);
    rollbem::ContactTableMaker maker = study::blame(
        grid_said(options), [&] { return rollbem::ContactTableMaker(scene.wheelset, scene.creep, making); });
    say_duration(scene, making, " for all parts");
    study::write_table(options, contact::node_table(maker, grid));
}

void make(const study::Options& options) {
    rollbem::ContactTableMaking making = read_making(options);
    const std::string output = options.text("output");
    options.require(options.given("output") && output != "-", "output", "be a file: a contact table is not text");
    const Scene scene = read_scene(options);
    require_on_rail(options, scene, making);
    study::OutputFiles files;
    study::OutputFile& file = files.open(output, "--output");
    const bool reads = options.given("rows");
    if (!reads) say_duration(scene, making, "");
    study::Progress progress(program, making.lines(), !scene.quiet && !reads, "lines");
    std::size_t done = 0;
    making.done = [&] { progress.update(++done); };
    const rollbem::MadeContactTable made = study::blame(grid_said(options), [&] {
        if (!reads) return make_contact_table(scene.wheelset, scene.creep, making);
        const rollbem::ContactTableMaker maker(scene.wheelset, scene.creep, making);
        const auto sides = contact::read_sides(options, making.grid, maker.side_count());
        require_same_profiles(options, "rows", scene, 1e-7, known_places(making.grid, sides));
        return maker.table(sides);
    });
    progress.clear();
    std::ostringstream bytes;
    made.table.write(bytes);
    file.write(bytes.str());
    files.commit();
    say_what_was_made(scene, made.table, making.grid.shifts.back());
}

// --- beside patches --------------------------------------------------------------------------------------------------

/// Wheels rolling by patches and by table: F_x, F_y, M_z over support_y, of each wheel.
struct Compared {
    std::array<Eigen::Array3d, 2> patches, table;
    std::array<int, 2> points{};
    double power = 0, heat = 0;  ///< what forces of the table take from the motion, and what becomes heat [W]
    std::string status = "ok";
};

Eigen::Array3d judged(double f_x, double f_y, double m_z) { return {f_x, f_y, m_z / ContactTable::support_y}; }

/// Adds the power in steady rolling through a curve, where normal forces do no work.
void add_power(const Scene& scene, const ContactTable& table, const WheelsetRolling& rolling, Compared& result) {
    constexpr double curve = 300;  // [m]
    const rollbem::WheelsetSpeeds speeds{.forward = rolling.speeds.forward,
                                         .pitch_rate = rolling.speeds.pitch_rate,
                                         .yaw_rate = rolling.speeds.forward / curve};
    rollbem::WheelsetPosition at = rolling.position;
    at.roll = table.on_rails(at.lateral, at.yaw, rolling.loads).roll;
    const auto velocity = rollbem::detail::velocity_of(at, speeds);
    for (const WheelsetSide side : rollbem::WheelsetOnTrack::sides) {
        const WheelForces now =
            table.forces(scene.creep, side, at, speeds, {rolling.loads[std::size_t(side)], at.roll}, friction);
        for (std::size_t i = 0; i < 3; ++i) {
            result.power -=
                now.force[Eigen::Index(i)] * velocity.middle()[i] + now.force[Eigen::Index(i + 3)] * velocity.turn()[i];
        }
        result.heat += now.heat;
    }
}

Compared compare(const Scene& scene, const ContactTable& table, WheelsetRolling rolling) {
    rollbem::WheelsetOnTrack::Workspace workspace;
    const WheelsetForces patches = rolling_forces(scene.wheelset, rolling, {.coefficient = friction}, workspace);
    Compared result;
    if (!has_numbers(patches.contacts.status)) {
        result.status = name(patches.contacts.status);
        return result;
    }
    rolling.speeds.pitch_rate = patches.pitch_rate;
    const rollbem::WheelsetPosition& at = rolling.position;
    const double roll = table.on_rails(at.lateral, at.yaw, rolling.loads).roll;
    for (const WheelsetSide side : rollbem::WheelsetOnTrack::sides) {
        const auto k = std::size_t(side);
        for (const auto& patch : patches.patches[k]) {
            if (patch.status != rollbem::Status::ok) result.status = name(patch.status);
        }
        const bool equal = rolling.loads[0] == rolling.loads[1];
        const WheelForces now = table.forces(scene.creep, side, at, rolling.speeds,
                                             {rolling.loads[k], equal ? std::nullopt : std::optional(roll)}, friction);
        if (now.status != rollbem::Status::ok) result.status = name(now.status);
        const auto& wrench = patches.on_wheel[k];
        result.patches[k] = judged(wrench.force[0], wrench.force[1], wrench.moment[2]);
        result.table[k] = judged(now.force[0], now.force[1], now.force[5]);
        for (const auto& point : now.points) result.points[k] += point.load_share > 0;
    }
    add_power(scene, table, rolling, result);
    return result;
}

/// Mean, largest, and the share below which 95 % are.
std::string summary(std::vector<double> all) {
    if (all.empty()) return "none";
    std::sort(all.begin(), all.end());
    double sum = 0;
    for (const double one : all) sum += one;
    const auto text = [](double value) { return study::Cell(value).text(3); };
    return "mean " + text(sum / double(all.size())) + ", 95 % below " + text(all[(all.size() * 95 + 99) / 100 - 1]) +
           ", largest " + text(all.back());
}

/// A random scene: shift to the table's largest or 6.1 mm, yaw to 10 mrad, equal loads within the table's range,
/// creepages that would need 0.05 to 5 mu N in the linear law, in a random direction.
WheelsetRolling random_scene(const ContactTable& table, double radius, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform;
    constexpr double speed = 20, widest = 6.1e-3, turned = 10e-3;
    WheelsetRolling rolling;
    rolling.position.lateral = std::min(widest, table.largest_shift()) * (2 * uniform(random) - 1);
    rolling.position.yaw = std::min(turned, table.largest_yaw()) * (2 * uniform(random) - 1);
    const auto& loads = table.grid().loads;
    const double load = loads.front() * std::pow(loads.back() / loads.front(), uniform(random));
    rolling.loads = {load, load};
    const double size = 0.05 * std::pow(100, uniform(random)), direction = 2 * std::numbers::pi * uniform(random);
    const double unit = size * friction * load / (table.shear_modulus() * 3.5e-5 * 4);  // c11, c22 are about 4
    rolling.free_pitch = false;
    rolling.speeds = {.forward = speed,
                      .pitch_rate = -speed / radius * (1 - unit * std::cos(direction)),
                      .lateral = speed * (rolling.position.yaw + unit * std::sin(direction))};
    const auto rails = table.on_rails(rolling.position.lateral, rolling.position.yaw, rolling.loads);
    rolling.speeds.vertical = rails.height_by_lateral * rolling.speeds.lateral;
    rolling.speeds.roll_rate = rails.roll_by_lateral * rolling.speeds.lateral;
    return rolling;
}

/// Writes how far the table is from patches in `count` random scenes. Returns the exit code.
int check(const Scene& scene, const ContactTable& table, std::size_t count) {
    std::vector<Compared> compared(count);
    std::vector<double> loads(count);
    std::size_t done = 0;
    study::Progress progress(program, count, !scene.quiet, "scenes");
    rollbem::detail::parallel_for(
        count, scene.jobs,
        [&](std::size_t i) {
            const WheelsetRolling rolling = random_scene(table, scene.wheelset.wheel().dimensions().radius, i + 1);
            loads[i] = rolling.loads[0];
            compared[i] = compare(scene, table, rolling);
        },
        [&] { progress.update(++done); });
    progress.clear();
    std::array<std::vector<double>, 3> differences;
    std::vector<double> powers;
    std::size_t without = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Compared& one = compared[i];
        without += one.status != "ok";
        if (one.status != "ok") continue;
        for (std::size_t k = 0; k < 2; ++k) {
            const Eigen::Array3d difference = (one.table[k] - one.patches[k]).abs() / (friction * loads[i]);
            for (std::size_t row = 0; row < 3; ++row) differences[row].push_back(difference[Eigen::Index(row)]);
        }
        powers.push_back(std::abs(one.power / one.heat - 1));
    }
    study::OutputFile output = study::OutputFile::standard_output();
    output.write("scenes " + std::to_string(count) + ", without a result " + std::to_string(without) + "\n");
    output.write("F_x over mu Q: " + summary(differences[0]) + "\n");
    output.write("F_y over mu Q: " + summary(differences[1]) + "\n");
    output.write("M_z over 0.75 m mu Q: " + summary(differences[2]) + "\n");
    output.write("power of the forces over the creep work, less 1: " + summary(powers) + "\n");
    output.commit();
    return powers.empty() ? study::exit_failed : study::exit_ok;
}

struct Position {
    double load, yaw, shift;
    std::string label() const { return "shift = " + study::Cell(shift).text(4) + " m"; }
};

std::vector<Position> scan_positions(const study::Options& options, const ContactTable& table) {
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

/// A wheel at a position.
struct Scanned {
    const Position& at;
    const Compared& found;
    std::size_t side;

    bool ok() const { return found.status == "ok"; }
    Eigen::Array3d difference() const { return (found.table[side] - found.patches[side]).abs() / (friction * at.load); }
};

const study::Sheet<Scanned, Position>& scan_sheet() {
    const auto force = [](std::array<Eigen::Array3d, 2> Compared::*of, Eigen::Index i) {
        return study::where(&Scanned::ok, [=](const Scanned& row) {
            return (row.found.*of)[row.side][i] * (i == 2 ? ContactTable::support_y : 1);
        });
    };
    const char* by_table =
        "forces [N] and moment [N m] on the wheel by the table, in track axes about the middle of the axle";
    const char* by_patches = "forces and moment by the patches, likewise";
    static const study::Sheet<Scanned, Position> columns{
        "",
        {{"load", "vertical load on each wheel [N]: nodes of the table and their midpoints",
          [](const Scanned& row) { return row.at.load; }},
         {"yaw", "yaw angle [rad]: 0, 0.003 and 0.008, both signs", [](const Scanned& row) { return row.at.yaw; }},
         {"shift", "lateral shift [m], from 0", [](const Scanned& row) { return row.at.shift; }},
         {"side", "wheel, left or right", [](const Scanned& row) { return row.side == 0 ? "left" : "right"; }},
         {"table_force_x", by_table, force(&Compared::table, 0)},
         {"table_force_y", by_table, force(&Compared::table, 1)},
         {"table_moment_z", by_table, force(&Compared::table, 2)},
         {"patch_force_x", by_patches, force(&Compared::patches, 0)},
         {"patch_force_y", by_patches, force(&Compared::patches, 1)},
         {"patch_moment_z", by_patches, force(&Compared::patches, 2)},
         {"points", "number of the table's points of contact that carry load",
          [](const Scanned& row) { return row.found.points[row.side]; }},
         {"status", "ok, or why there are no forces", [](const Scanned& row) { return row.found.status; }}},
        ""};
    return columns;
}

void scan(const study::Options& options) {
    const Scene scene = read_scene(options);
    const ContactTable table = read_table(options, scene);
    const std::vector<Position> positions = scan_positions(options, table);
    Eigen::Array3d sum = Eigen::Array3d::Zero(), largest = sum;
    double count = 0;
    std::mutex mutex;
    const study::Table rows = scan_sheet().table(
        positions, [](const Position&) { return 2; },
        [&](const Position& at, study::RowRange range, const study::Results<Scanned>& emit) {
            const Compared found =
                compare(scene, table, {.position = {.lateral = at.shift, .yaw = at.yaw}, .loads = {at.load, at.load}});
            for (std::size_t k = range.first; k < range.last; ++k) {
                const Scanned row{at, found, k};
                emit(row);
                if (!row.ok()) continue;
                const std::lock_guard lock(mutex);
                ++count;
                sum += row.difference();
                largest = largest.max(row.difference());
            }
        });
    study::write_table(options, rows);
    sum /= count;
    std::fprintf(stderr, "%s: over mu Q, mean and largest: F_x %.4f %.4f, F_y %.4f %.4f, M_z/0.75 m %.4f %.4f\n",
                 program, sum[0], largest[0], sum[1], largest[1], sum[2], largest[2]);
}

std::string help() {
    return R"(Example: a table of S1002 on 60E1, by two threads; the same by 4 machines; then beside patches
  contact_table --output s1002_60e1.contact --jobs 2
  contact_table --shard 1/4 --output part1.csv    # and 2/4, 3/4, 4/4
  cat part?.csv > rows.csv && contact_table --rows rows.csv --output s1002_60e1.contact
  contact_table --check 200 s1002_60e1.contact --jobs 2
  contact_table --scan 0.006,0.0002 s1002_60e1.contact --output scan.csv

The file is for ContactTable::read, rollbem_contact_table_open and the wheelset FMU. At each node both wheels carry the
load with normal forces. Along shift and load values are local cubics, over the yaw polynomials in yaw^2, as contacts at
-yaw are the mirror images of those at yaw. Shifts end where wheels no longer carry their loads.
Smooth weights part the rail into at most four zones, whose cuts the program finds unless --zones gives them.
--shard writes rows of numbers in place of the file, one for each node, side and possible zone: load, yaw, shift, side,
zone, then the zone's cut and the values at the node. Each part finds the zones anew, from a quarter of all positions,
unless --zones gives them; parts of whole lines of shifts take least time.
--check: random scenes with |shift| <= 6.1 mm, |yaw| <= 10 mrad, equal loads within the table, creepages in a random
direction whose linear forces are 0.05 to 5 mu N, mu = 0.3, 20 m/s. Lines on standard output: differences between table
and patches (rolling_forces) of F_x, F_y and M_z (about the middle of the axle, over 0.75 m), over mu Q; and the
relative difference between the power of the table's forces on the rigid motion, in a curve of 300 m, and creep work.
--scan: a row for each load, yaw, shift and side, on straight track with free pitch, mu = 0.3:
)" + scan_sheet().help() +
           R"(One line on standard error ends it: mean and largest differences over mu Q.
)";
}

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
    options.add_input(
        "creep",
        "file of the creep-force table with which the contact table will be used; default: steel.creep, for steel");
    options.add("check", "N",
                "number of random scenes [dimensionless], 1 to 1000000, in which the given table is compared with "
                "patches, in place of making one");
    options.add("scan", "SHIFT_MAX,STEP",
                "largest shift and its step [m], over which, over yaw and load the given table is compared with "
                "patches, in place of making one");
    options.add_argument("table", "file of the contact table to compare").only_with({"check", "scan"});
    options.not_with({"scan"}, "check");
    options.not_with({"load", "shift", "yaw", "zones", "left-zones"}, "check");
    options.not_with({"load", "shift", "yaw", "zones", "left-zones"}, "scan");
    options.only_with({"left-zones"}, {"left-wheel", "left-rail", "left-radius"});
    options.refuse("plot", "draw contacts with profile_study");
    options.refuse("no-timing", "rows have no times");
    options.set_help("output",
                     "file of the contact table, which is no CSV; with --shard and --scan CSV file of the rows, with "
                     "FILE.toml beside it, standard output without it");
    options.set_help("jobs", "number of threads [dimensionless], 1 to 1024");
    options.add_input("rows",
                      "CSV file of the rows, the parts of --shard one after the other, made with the same version and "
                      "the same options but the zones, in place of a computation");
    options.not_with({"shard"}, "rows");
    options.not_with({"shard", "rows"}, "check");
    options.not_with({"rows"}, "scan");
    options.not_with({"zones", "left-zones"}, "rows", ": rows have zones of their own");
    options.not_with({"output"}, "check");
    options.footer(help());
}

}  // namespace

int main(int argc, char** argv) {
    study::Options options(program, "Contacts of a wheelset on its rails, as a table for look-up.");
    add_options(options);
    return study::run_program(options, argc, argv, [](const study::Options& given) {
        if (given.given("check")) {
            const Scene scene = read_scene(given);
            const ContactTable table = read_table(given, scene);
            return check(scene, table, std::size_t(given.integer("check", 1, 1'000'000)));
        }
        if (given.given("scan")) {
            scan(given);
        } else if (given.given("shard")) {
            make_part(given);
        } else {
            make(given);
        }
        return int(study::exit_ok);
    });
}
