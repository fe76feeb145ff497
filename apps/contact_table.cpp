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
#include <mutex>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/make_contact_table.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>
#include <rollbem/vehicle/detail/wheelset_velocity.hpp>

#include "contact/contact.hpp"
#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/output.hpp"
#include "support/progress.hpp"
#include "support/sheet.hpp"
#include "support/table.hpp"

namespace {

using contact::Comparison, contact::Making, contact::Position, contact::Scene;
using rollbem::ContactTable, rollbem::WheelForces, rollbem::WheelsetForces, rollbem::WheelsetRolling,
    rollbem::WheelsetSide;

constexpr const char* program = "contact_table";
constexpr double friction = 0.3;

// --- making ----------------------------------------------------------------------------------------------------------

/// Seconds of processor time that a position takes, from one on the tread and one towards the flange.
double position_seconds(const Scene& scene, const rollbem::ContactTableMaker::Options& making) {
    const auto start = std::clock();
    rollbem::ContactTableMaker::Options few = making;
    few.grid.shifts = {-5e-3, -2.5e-3, 0, 2.5e-3, 5e-3};
    for (double& shift : few.grid.shifts) shift *= std::min(1.0, making.grid.shifts.back() / 5e-3);
    few.grid.yaws = {0, making.grid.yaws[1]};
    few.grid.loads = {making.grid.loads.front()};
    few.zones = {rollbem::ContactTable::Zones(), rollbem::ContactTable::Zones()};
    few.jobs = 1;
    few.done = [] {};
    try {
        make_contact_table(scene.wheelset, scene.creep, few);
    } catch (const std::invalid_argument&) {  // said when the whole is made
    }
    return double(std::clock() - start) / CLOCKS_PER_SEC / (scene.wheelset.is_mirrored() ? 6 : 10);
}

void say_duration(const Scene& scene, const rollbem::ContactTableMaker::Options& making, const char* of) {
    if (!scene.threads.shows) return;
    const std::size_t shifts = making.grid.shifts.size();
    const std::size_t positions = making.lines() * (scene.wheelset.is_mirrored() ? shifts / 2 + 1 : shifts);
    const double seconds = position_seconds(scene, making) * double(positions) * 1.3;  // and zones
    std::fprintf(stderr, "%s: %zu positions, about %.0f s of processor time%s\n", program, positions,
                 std::max(seconds, 1.0), of);
}

void say_what_was_made(const Scene& scene, const ContactTable& table, double asked) {
    if (!scene.threads.shows) return;
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

rollbem::ContactTableMaker maker_of(const Making& job) {
    return study::blame(job.said,
                        [&] { return rollbem::ContactTableMaker(job.scene.wheelset, job.scene.creep, job.making); });
}

ContactTable make(const Making& job) {
    const bool computes = job.sides.empty();
    if (computes) say_duration(job.scene, job.making, "");
    study::Progress progress(program, job.making.lines(), job.scene.threads.shows && computes, "lines");
    std::size_t done = 0;
    rollbem::ContactTableMaker::Options making = job.making;
    making.done = [&] { progress.update(++done); };
    return study::blame(job.said,
                        [&] {
                            return computes ? make_contact_table(job.scene.wheelset, job.scene.creep, making)
                                            : maker_of(job).table(job.sides);
                        })
        .table;
}

// --- beside patches --------------------------------------------------------------------------------------------------

/// Wheels rolling by patches and by table: F_x, F_y, M_z over half_base, of each wheel.
struct Compared {
    std::array<Eigen::Array3d, 2> patches, table;
    std::array<int, 2> points{};
    double power = 0, heat = 0;  ///< what forces of the table take from the motion, and what becomes heat [W]
    std::string status = "ok";
};

Eigen::Array3d judged(double f_x, double f_y, double m_z) { return {f_x, f_y, m_z / ContactTable::half_base}; }

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
int check(const Comparison& comparison) {
    const Scene& scene = comparison.scene;
    const ContactTable& table = comparison.table;
    const std::size_t count = comparison.scenes;
    std::vector<Compared> compared(count);
    std::vector<double> loads(count);
    in_parallel(scene.threads, count, "scenes", [&](std::size_t i) {
        const WheelsetRolling rolling = random_scene(table, scene.wheelset.wheel().dimensions().radius, i + 1);
        loads[i] = rolling.loads[0];
        compared[i] = compare(scene, table, rolling);
    });
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
            return (row.found.*of)[row.side][i] * (i == 2 ? ContactTable::half_base : 1);
        });
    };
    const char* by_table = "forces on the wheel by the table, in track axes [N]";
    const char* by_patches = "forces by the patches, likewise [N]";
    static const study::Sheet<Scanned, Position> columns{
        "",
        {{"load", "vertical load on each wheel [N]: nodes of the table and their midpoints",
          [](const Scanned& row) { return row.at.load; }},
         {"yaw", "yaw angle [rad]: 0, 0.003 and 0.008, both signs", [](const Scanned& row) { return row.at.yaw; }},
         {"shift", "lateral shift [m], from 0", [](const Scanned& row) { return row.at.shift; }},
         {"side", "wheel, left or right", [](const Scanned& row) { return row.side == 0 ? "left" : "right"; }},
         {"table_force_x", by_table, force(&Compared::table, 0)},
         {"table_force_y", by_table, force(&Compared::table, 1)},
         {"table_moment_z", "moment of these about the middle of the axle [N m]", force(&Compared::table, 2)},
         {"patch_force_x", by_patches, force(&Compared::patches, 0)},
         {"patch_force_y", by_patches, force(&Compared::patches, 1)},
         {"patch_moment_z", "moment by the patches, likewise [N m]", force(&Compared::patches, 2)},
         {"points", "number of the table's points of contact that carry load",
          [](const Scanned& row) { return row.found.points[row.side]; }},
         {"status", "ok, or why there are no forces", [](const Scanned& row) { return row.found.status; }}},
        ""};
    return columns;
}

/// Differences over mu Q of all wheels.
struct Summary {
    std::mutex mutex{};
    Eigen::Array3d sum = Eigen::Array3d::Zero(), largest = sum;
    double count = 0;

    void add(const Eigen::Array3d& difference) {
        const std::lock_guard lock(mutex);
        ++count;
        sum += difference;
        largest = largest.max(difference);
    }
};

study::Table scan_table(const Comparison& comparison, Summary& summary) {
    return scan_sheet().table(
        comparison.positions, [](const Position&) { return 2; },
        [&](const Position& at, study::RowRange range, const study::Results<Scanned>& emit) {
            const Compared found =
                compare(comparison.scene, comparison.table,
                        {.position = {.lateral = at.shift, .yaw = at.yaw}, .loads = {at.load, at.load}});
            for (std::size_t k = range.first; k < range.last; ++k) {
                const Scanned row{at, found, k};
                emit(row);
                if (row.ok()) summary.add(row.difference());
            }
        });
}

std::string help() {
    return R"(Example: a table of S1002 on 60E1, by two threads; the same by 4 machines; then against patches
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
--check: random cases with |shift| <= 6.1 mm, |yaw| <= 10 mrad, equal loads within the table, creepages in a random
direction whose linear forces are 0.05 to 5 mu N, mu = 0.3, 20 m/s. Lines on standard output: differences between table
and patches (rolling_forces) of F_x, F_y and M_z (about the middle of the axle, over 0.75 m), over mu Q; and the
relative difference between the power of the table's forces on the rigid motion, in a curve of 300 m, and creep work.
--scan: a row for each load, yaw, shift and side, on straight track with free pitch, mu = 0.3:
)" + scan_sheet().help() +
           R"(One line on standard error ends it: mean and largest differences over mu Q.
)";
}

}  // namespace

int main(int argc, char** argv) {
    study::Options options(program, "Contacts of a wheelset on its rails, as a table for look-up.");
    contact::add_options(options);
    options.footer(help());
    return study::run_program(options, argc, argv, [](const study::Options& given) {
        if (given.given("check")) {
            const Comparison comparison = contact::read_comparison(given);
            given.say_doubts();
            return check(comparison);
        }
        if (given.given("scan")) {
            const Comparison comparison = contact::read_comparison(given);
            Summary summary;
            study::write_table(given, scan_table(comparison, summary));
            if (summary.count == 0) return int(study::exit_ok);  // of a shard
            const Eigen::Array3d mean = summary.sum / summary.count, &largest = summary.largest;
            std::fprintf(stderr,
                         "%s: over mu Q, mean and largest: F_x %.4f %.4f, F_y %.4f %.4f, M_z/0.75 m %.4f %.4f\n",
                         program, mean[0], largest[0], mean[1], largest[1], mean[2], largest[2]);
            return int(study::exit_ok);
        }
        const Making job = contact::read_making(given);
        if (given.given("shard")) {
            rollbem::ContactTableMaker maker = maker_of(job);
            say_duration(job.scene, job.making, " for all parts");
            study::write_table(given, contact::node_table(maker, job.making.grid));
        } else {
            study::OutputFiles files;
            study::OutputFile& file = files.open(given.text("output"), "--output");
            given.say_doubts();
            const ContactTable table = make(job);
            std::ostringstream bytes;
            table.write(bytes);
            file.write(bytes.str());
            files.commit();
            say_what_was_made(job.scene, table, job.making.grid.shifts.back());
        }
        return int(study::exit_ok);
    });
}
