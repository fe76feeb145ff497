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

/// Seconds of processor time of a few nodes of the grid, on treads and flanges, by the first load and yaw: all of a
/// kind, with friction where `fits`.
double sample_seconds(const Scene& scene, rollbem::ContactTableMaker::Options few, bool fits) {
    few.fits_friction = fits;
    const auto start = std::clock();
    try {
        make_contact_table(scene.wheelset, scene.creep, few);
    } catch (const std::invalid_argument&) {  // said when the whole is made
    }
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Number of scenes in which a table is judged; hardly any for tables of a few nodes.
std::size_t judged_scenes(const ContactTable::Grid& grid) {
    return std::clamp<std::size_t>(std::size_t(grid.nodes()) / 10, 2, 100);
}

/// Seconds of processor time that making takes: contacts of all positions, friction where ellipses are fitted and zones
/// are judged, and the scenes in which the table is judged.
double making_seconds(const Scene& scene, const rollbem::ContactTableMaker::Options& making) {
    constexpr std::size_t samples = 4, motions = 35, rounds = 4;
    const std::vector<double>& shifts = making.grid.shifts;
    const double largest = shifts.back(), sides = scene.wheelset.is_mirrored() ? 1 : 2, lines = double(making.lines());
    rollbem::ContactTableMaker::Options few = making;
    few.grid.shifts.clear();
    for (std::size_t k = 0; k <= 2 * samples; ++k) {
        few.grid.shifts.push_back((double(k) / samples - 1) * std::min(largest, 6.4e-3));
    }
    few.grid.yaws.resize(2);
    few.grid.loads.resize(1);
    few.zones = {rollbem::ContactTable::Zones(), rollbem::ContactTable::Zones()};
    few.done = [] {};
    const double contacts = sample_seconds(scene, few, false), all = sample_seconds(scene, few, true);
    const double positions = double(scene.wheelset.is_mirrored() ? shifts.size() / 2 + 1 : shifts.size()) * lines,
                 per_position = contacts / double(2 * (sides > 1 ? 2 * samples + 1 : samples + 1)),
                 per_node = std::max(all - contacts, 0.0) / (double(2 * (2 * samples + 1)) * sides);
    const double step = 2 * largest / double(shifts.size() - 1);
    const auto per_metre = [&](double least) { return 1 / std::max(step, least); };
    // a quarter of the shifts is on flanges
    const double nodes = making.fits_friction ? 0.75 * per_metre(0.4e-3) + 0.25 * per_metre(0.1e-3) : 0,
                 fitted = lines * sides * 2 * largest * nodes,
                 judged = making.zones[1] ? 0 : lines / 4 * sides * 2 * largest * per_metre(0.2e-3);
    return positions * per_position + std::max(fitted, (fitted + judged) * 0.9) * per_node +
           double(judged_scenes(making.grid) * rounds) * (per_position + 2 * per_node / motions);
}

void say_duration(const Scene& scene, const rollbem::ContactTableMaker::Options& making, const char* of) {
    if (!scene.threads.shows) return;
    std::fprintf(stderr, "%s: %zu lines of %zu shifts, about %.0f s of processor time%s\n", program, making.lines(),
                 making.grid.shifts.size(), std::max(making_seconds(scene, making), 1.0), of);
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

std::string text_of(const ContactTable::Errors& errors) {
    const auto text = [](double value) { return study::Cell(value).text(3); };
    std::string line = text(errors.least_load / 1e3) + " to " + text(errors.most_load / 1e3) + " kN, " +
                       text(errors.wheels) + " wheels";
    for (std::size_t k = 0; k < 2; ++k) {
        line += (k == 0 ? ": F_x" : "; F_y") + std::string(" mean ") + text(errors.mean[k]) + ", 95 % below " +
                text(errors.most_of_95[k]) + ", largest " + text(errors.largest[k]);
    }
    return line;
}

/// The mean error of F_x or F_y, the larger.
double mean_error(const std::vector<ContactTable::Errors>& all) {
    double wheels = 0;
    std::array<double, 2> sums{};
    for (const ContactTable::Errors& of : all) {
        wheels += of.wheels;
        for (std::size_t k = 0; k < 2; ++k) sums[k] += of.wheels * of.mean[k];
    }
    return wheels > 0 ? std::max(sums[0], sums[1]) / wheels : 0;
}

void say_errors(const std::vector<ContactTable::Errors>& all, bool shows) {
    constexpr double most = 0.005;
    for (const ContactTable::Errors& of : all) {
        if (shows) std::fprintf(stderr, "%s: differences from patches over mu Q, %s\n", program, text_of(of).c_str());
    }
    if (mean_error(all) > most) {
        std::fprintf(stderr,
                     "%s: forces differ from patches by %.4f mu Q in the mean, above %g: more shifts, loads or zones "
                     "help unless profiles are rough\n",
                     program, mean_error(all), most);
    }
}

rollbem::ContactTableMaker maker_of(const Making& job) {
    return study::blame(job.said,
                        [&] { return rollbem::ContactTableMaker(job.scene.wheelset, job.scene.creep, job.making); });
}

ContactTable make(const Making& job) {
    const bool computes = job.sides.empty();
    if (computes) say_duration(job.scene, job.making, "");
    const std::size_t sides = job.scene.wheelset.is_mirrored() ? 1 : 2;
    study::Progress progress(program, job.making.lines() * (1 + sides), job.scene.threads.shows && computes, "lines");
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

/// Mean, the value below which 95 % lie, and the largest.
struct Spread {
    double mean = 0, most_of_95 = 0, largest = 0;

    explicit Spread(std::vector<double> all) {
        std::sort(all.begin(), all.end());
        for (const double one : all) mean += one / double(all.size());
        most_of_95 = all[(all.size() * 95 + 99) / 100 - 1];
        largest = all.back();
    }
};

std::string summary(const std::vector<double>& all) {
    if (all.empty()) return "none";
    const Spread spread(all);
    const auto text = [](double value) { return study::Cell(value).text(3); };
    return "mean " + text(spread.mean) + ", 95 % below " + text(spread.most_of_95) + ", largest " +
           text(spread.largest);
}

/// A random scene: shift to the table's largest or 6 mm, yaw to 8 mrad, equal loads within the table's range, curves to
/// 300 m, creepages that would need 0.05 to 5 mu N in the linear law, in a random direction; a fifth rolls backwards.
WheelsetRolling random_scene(const ContactTable& table, double radius, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform;
    constexpr double widest = 6e-3, turned = 8e-3, curve = 300;
    const double speed = 20 * (uniform(random) < 0.2 ? -1 : 1);
    WheelsetRolling rolling;
    rolling.position.lateral = std::min(widest, table.largest_shift()) * (2 * uniform(random) - 1);
    rolling.position.yaw = std::min(turned, table.largest_yaw()) * (2 * uniform(random) - 1);
    const auto& loads = table.grid().loads;
    const double load = loads.front() + (loads.back() - loads.front()) * uniform(random);
    rolling.loads = {load, load};
    const double size = 0.05 * std::pow(100, uniform(random)), direction = 2 * std::numbers::pi * uniform(random);
    const double unit = size * friction * load / (table.shear_modulus() * 3.5e-5 * 4);  // c11, c22 are about 4
    rolling.free_pitch = false;
    rolling.speeds = {.forward = speed,
                      .pitch_rate = -speed / radius * (1 - unit * std::cos(direction)),
                      .lateral = speed * (rolling.position.yaw + unit * std::sin(direction)),
                      .yaw_rate = speed * (2 * uniform(random) - 1) / curve};
    const auto rails = table.on_rails(rolling.position.lateral, rolling.position.yaw, rolling.loads);
    rolling.speeds.vertical = rails.height_by_lateral * rolling.speeds.lateral;
    rolling.speeds.roll_rate = rails.roll_by_lateral * rolling.speeds.lateral;
    return rolling;
}

/// Random scenes by table and by patches.
struct Checked {
    std::vector<Compared> compared;
    std::vector<double> loads;

    std::size_t count() const { return compared.size(); }
    bool ok(std::size_t i) const { return compared[i].status == "ok"; }
    Eigen::Array3d difference(std::size_t i, std::size_t side) const {
        return (compared[i].table[side] - compared[i].patches[side]).abs() / (friction * loads[i]);
    }
};

Checked check_scenes(const Scene& scene, const ContactTable& table, std::size_t count) {
    Checked found{std::vector<Compared>(count), std::vector<double>(count)};
    in_parallel(scene.threads, count, "scenes", [&](std::size_t i) {
        const WheelsetRolling rolling = random_scene(table, scene.wheelset.wheel().dimensions().radius, i + 1);
        found.loads[i] = rolling.loads[0];
        found.compared[i] = compare(scene, table, rolling);
    });
    return found;
}

/// Errors between neighbouring loads of the table.
std::vector<ContactTable::Errors> errors_by_load(const ContactTable& table, const Checked& checked) {
    const std::vector<double>& loads = table.grid().loads;
    std::vector<ContactTable::Errors> found;
    for (std::size_t l = 0; l < std::max<std::size_t>(loads.size() - 1, 1); ++l) {
        const double low = loads[l], high = loads[std::min(l + 1, loads.size() - 1)];
        std::array<std::vector<double>, 2> all;
        for (std::size_t i = 0; i < checked.count(); ++i) {
            const bool last = l + 2 >= loads.size();
            if (!checked.ok(i) || checked.loads[i] < low || (checked.loads[i] >= high && !last)) continue;
            for (std::size_t side = 0; side < 2; ++side) {
                for (std::size_t k = 0; k < 2; ++k) all[k].push_back(checked.difference(i, side)[Eigen::Index(k)]);
            }
        }
        if (all[0].empty()) continue;
        ContactTable::Errors& of = found.emplace_back();
        of = {.least_load = low, .most_load = high, .wheels = double(all[0].size())};
        for (std::size_t k = 0; k < 2; ++k) {
            const Spread spread(all[k]);
            of.mean[k] = spread.mean;
            of.most_of_95[k] = spread.most_of_95;
            of.largest[k] = spread.largest;
        }
    }
    return found;
}

/// The table with the errors that it has in random scenes.
ContactTable judged_table(const Scene& scene, const ContactTable& table) {
    std::vector<ContactTable::Errors> errors =
        errors_by_load(table, check_scenes(scene, table, judged_scenes(table.grid())));
    say_errors(errors, scene.threads.shows);
    return table.with_errors(std::move(errors));
}

/// Writes how far the table is from patches in `count` random scenes. Returns the exit code.
int check(const Comparison& comparison) {
    const ContactTable& table = comparison.table;
    const Checked checked = check_scenes(comparison.scene, table, comparison.scenes);
    std::array<std::vector<double>, 3> differences;
    std::vector<double> powers;
    std::size_t without = 0;
    for (std::size_t i = 0; i < checked.count(); ++i) {
        without += !checked.ok(i);
        if (!checked.ok(i)) continue;
        for (std::size_t side = 0; side < 2; ++side) {
            for (std::size_t row = 0; row < 3; ++row)
                differences[row].push_back(checked.difference(i, side)[Eigen::Index(row)]);
        }
        powers.push_back(std::abs(checked.compared[i].power / checked.compared[i].heat - 1));
    }
    study::OutputFile output = study::OutputFile::standard_output();
    output.write("scenes " + std::to_string(checked.count()) + ", without a result " + std::to_string(without) + "\n");
    output.write("F_x over mu Q: " + summary(differences[0]) + "\n");
    output.write("F_y over mu Q: " + summary(differences[1]) + "\n");
    output.write("M_z over 0.75 m mu Q: " + summary(differences[2]) + "\n");
    output.write("power of the forces over the creep work, less 1: " + summary(powers) + "\n");
    const auto by_load = errors_by_load(table, checked);
    for (const ContactTable::Errors& of : by_load) output.write(text_of(of) + "\n");
    for (const ContactTable::Errors& of : table.errors()) output.write("the file says " + text_of(of) + "\n");
    output.commit();
    say_errors(by_load, false);
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
--check: random cases with |shift| <= 6 mm, |yaw| <= 8 mrad, equal loads within the table, curves to 300 m, creepages in
a random direction whose linear forces are 0.05 to 5 mu N, mu = 0.3, a fifth rolling backwards. Lines on standard
output: differences between table and patches (rolling_forces) of F_x, F_y and M_z (about the middle of the axle, over
0.75 m), over mu Q; the relative difference between the power of the table's forces on the rigid motion, in a curve of
300 m, and creep work; differences of F_x and F_y by load; and those that the file says. Making a table ends with 100
such cases, whose differences are said and written into the file, with a warning above 0.005 in the mean.
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
            const ContactTable table = judged_table(job.scene, make(job));
            std::ostringstream bytes;
            table.write(bytes);
            file.write(bytes.str());
            files.commit();
            say_what_was_made(job.scene, table, job.making.grid.shifts.back());
        }
        return int(study::exit_ok);
    });
}
