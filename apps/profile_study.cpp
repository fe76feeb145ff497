// Contacts of a wheel and a rail, from their profiles: positions, angles, loads, pressures and areas of all
// patches, over the lateral shift and yaw of a wheelset, and with friction the creepages and forces:
//
//     ./profile_study --shift 0,0.001,0.002,0.003,0.004,0.005 --plot contacts.svg
//     ./profile_study --shift 0.005 --yaw 0.012 --side both --friction 0.3 --plot patches.svg
//     ./profile_study --wheel worn.whl --tape-offset 0 --rail head.prr --cant 0 --load 8e4
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/vehicle/patch_stress.hpp>
#include <rollbem/vehicle/wear.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>

#include "profile/profile.hpp"
#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/sheet.hpp"

namespace {

using profile::Case;
using profile::Settings;
using profile::Side;
using rollbem::PatchForce;
using rollbem::RailPatch;
using rollbem::Status;

// --- contacts --------------------------------------------------------------------------------------------------------

using Stresses = std::array<std::vector<std::vector<rollbem::Yield::Peak>>, 2>;  // of each side, patch and strip

struct Contacts {
    rollbem::WheelsetForces of;
    Stresses stresses{};  ///< where they are asked for
    double time_us = 0;
};

Contacts find_contacts(const Settings& settings, const Case& at) {
    const auto start = std::chrono::steady_clock::now();
    Contacts contacts{.of = forces_at(settings, settings.wheelset, at)};
    contacts.time_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    for (const Side side : settings.sides) {
        if (settings.stress.empty()) break;
        for (const PatchForce& friction : contacts.of.patches[std::size_t(side)]) {
            contacts.stresses[std::size_t(side)].push_back(
                stresses_below(friction, settings.wheelset.wheel(side).dimensions().poisson_ratio));
        }
    }
    return contacts;
}

// --- rows ------------------------------------------------------------------------------------------------------------

/// A patch of a wheel, as on the right.
struct Found {
    const Settings& settings;
    const Case& at;
    const Contacts& contacts;
    Side side;
    std::optional<std::size_t> number;  ///< of the patch; none if there is none
    bool has_time;

    double sign(bool mirrored) const { return mirrored && side == Side::left ? -1 : 1; }
    const rollbem::WheelOnRail::Contact& wheel() const { return contacts.of.contacts.wheels[std::size_t(side)]; }
    const RailPatch* patch() const {
        return number && wheel().patches[*number].has_numbers() ? &wheel().patches[*number] : nullptr;
    }
    const PatchForce* force() const {
        return patch() != nullptr && settings.friction ? &contacts.of.patches[std::size_t(side)][*number] : nullptr;
    }
    /// The strip with the largest measure, none where stresses are not known.
    const rollbem::Yield::Peak* strip(double rollbem::Yield::Peak::*measure) const {
        if (solved() == nullptr || contacts.stresses[std::size_t(side)].empty()) return nullptr;
        const auto& strips = contacts.stresses[std::size_t(side)][*number];
        const auto worst = std::max_element(strips.begin(), strips.end(), [&](const auto& one, const auto& other) {
            return one.*measure < other.*measure;
        });
        return worst == strips.end() ? nullptr : &*worst;
    }
    const PatchForce* solved() const { return force() != nullptr && force()->status == Status::ok ? force() : nullptr; }
    std::string status() const {
        if (force() != nullptr && solved() == nullptr) return name(force()->status);
        if (!number) return name(wheel().status);
        const Status own = wheel().patches[*number].status;
        return name(patch() != nullptr && rollbem::has_numbers(wheel().status)
                        ? std::max(own, wheel().status == Status::unbalanced ? wheel().status : own)
                        : own);
    }
};

using Columns = std::vector<study::Column<Found>>;

/// The largest measures below a patch, where they lie, and its place in the map of shakedown.
Columns stress_columns() {
    using rollbem::Yield;
    const auto peak = [](double Yield::Peak::*measure, double Yield::Peak::*depth) {
        return [=](const Found& f) {
            const rollbem::Yield::Peak* strip = f.strip(measure);
            if (strip == nullptr) return study::Cell();
            return study::Cell(depth == nullptr ? strip->*measure : strip->*depth);
        };
    };
    const auto shakedown = [](double rollbem::Yield::Shakedown::*value) {
        return study::where(&Found::solved, [=](const Found& f) {
            return shakedown_point(*f.patch(), *f.solved(), f.settings.shear_yield).*value;
        });
    };
    return {
        {"max_von_mises", "with --stress: largest von Mises stress in the rail below the patch [Pa]",
         peak(&Yield::Peak::von_mises, nullptr)},
        {"von_mises_depth", "depth of that stress [m]", peak(&Yield::Peak::von_mises, &Yield::Peak::von_mises_depth)},
        {"max_tresca", "largest shear stress, by Tresca [Pa]", peak(&Yield::Peak::tresca, nullptr)},
        {"tresca_depth", "depth of that stress [m]", peak(&Yield::Peak::tresca, &Yield::Peak::tresca_depth)},
        {"shakedown_load", "load factor of the map of shakedown: peak pressure over --shear-yield",
         shakedown(&rollbem::Yield::Shakedown::load_factor)},
        {"shakedown_traction", "traction coefficient of the map of shakedown: force of friction over the normal force",
         shakedown(&rollbem::Yield::Shakedown::traction)}};
}

Columns patch_columns() {
    const auto found = [](const auto& value) { return study::where(&Found::patch, value); };
    const auto of_patch = [=](double RailPatch::*member, bool mirrored = false) {
        return found([=](const Found& f) { return f.sign(mirrored) * f.patch()->*member; });
    };
    return {{"roll", "roll angle of the wheelset, given or found [rad]",
             [=](const Found& f) {
                 if (f.at.roll) return study::Cell(*f.at.roll);
                 return f.patch() != nullptr ? study::Cell(f.contacts.of.contacts.position.roll) : study::Cell();
             }},
            {"side", "wheel, left or right", [](const Found& f) { return f.side == Side::right ? "right" : "left"; }},
            {"patch", "number of the patch on its wheel, from 1 by decreasing load; empty where there is none",
             study::where(&Found::number, [](const Found& f) { return *f.number + 1; })},
            {"height", "height z_ws of the wheelset, positive downwards, given or found [m]",
             [=](const Found& f) {
                 if (f.at.height) return study::Cell(*f.at.height);
                 if (f.patch() == nullptr) return study::Cell();
                 return study::Cell(f.wheel().height - f.settings.wheelset.height_above(f.side));
             }},
            {"x", "reference point of the patch, on the rail, in track axes, x from the wheelset [m]",
             of_patch(&RailPatch::x)},
            {"y", "", of_patch(&RailPatch::y, true)},
            {"z", "", of_patch(&RailPatch::z)},
            {"rail_y",
             "y of the reference point in the profiles of the right wheel and the canted right rail, of a left wheel "
             "in their mirror images [m]",
             of_patch(&RailPatch::rail_y)},
            {"wheel_y", "", of_patch(&RailPatch::wheel_y)},
            {"angle", "angle of the patch's plane [rad]: s lies along y turned by it, n points into the rail",
             of_patch(&RailPatch::angle, true)},
            {"rolling_radius", "radius of the wheel at the reference point [m]", of_patch(&RailPatch::rolling_radius)},
            {"load",
             "integral of the pressures over the plane [N]; they act along the normals of the rail's surface, so that "
             "the vertical share is load cos(angle) only nearly",
             of_patch(&RailPatch::load)},
            {"approach", "largest depth of the undeformed surfaces in one another along n [m]",
             of_patch(&RailPatch::approach)},
            {"peak_pressure", "largest pressure [Pa]", of_patch(&RailPatch::peak_pressure)},
            {"area", "area of the patch [m^2]", of_patch(&RailPatch::area)},
            {"half_length", "half the extent of the patch along x [m]", of_patch(&RailPatch::half_length)},
            {"half_width", "half the extent of the patch along s [m]", of_patch(&RailPatch::half_width)},
            {"iterations", "number of iterations of the last solution for pressures",
             found([](const Found& f) { return f.patch()->steps; })},
            {"time_us", "time of the whole position [microseconds], of a single run",
             study::where(&Found::has_time, [](const Found& f) { return f.contacts.time_us; })},
            {"status", "ok, or one of the words below", &Found::status}};
}

Columns friction_columns() {
    const auto of = [](auto which, bool mirrored, auto value) {
        return study::where(which, [=](const Found& f) { return f.sign(mirrored) * value(*(f.*which)()); });
    };
    // creepages as CONTACT's, rail minus wheel
    return {{"longitudinal_creepage",
             "with --friction: creepages of the rail on the wheel, CONTACT's CKSI and CETA, over the mean of V and "
             "-pitch_rate rolling_radius: along x positive for a wheel driven forward",
             of(&Found::force, false, [](const PatchForce& p) { return -p.creepage.longitudinal; })},
            {"lateral_creepage", "", of(&Found::force, true, [](const PatchForce& p) { return -p.creepage.lateral; })},
            {"spin", "spin of the rail on the wheel, CONTACT's CPHI, likewise [1/m]",
             of(&Found::force, true, [](const PatchForce& p) { return -p.creepage.spin; })},
            {"longitudinal_force",
             "forces of friction on the wheel along x and s [N]; CONTACT's FX and FS, on the rail, are minus these",
             of(&Found::solved, false, [](const PatchForce& p) { return p.force.longitudinal; })},
            {"lateral_force", "", of(&Found::solved, true, [](const PatchForce& p) { return p.force.lateral; })},
            {"spin_moment",
             "moment of friction on the wheel about n at the reference point [N m]; CONTACT's MN is minus this",
             of(&Found::solved, true, [](const PatchForce& p) { return p.force.moment; })},
            {"slip_power", "power that friction turns into heat [W]",
             study::where(&Found::solved,
                          [](const Found& f) {
                              const rollbem::WheelsetSpeeds speeds{.forward = f.settings.speed_of(f.at),
                                                                   .pitch_rate = f.contacts.of.pitch_rate};
                              return f.solved()->slip_work * std::abs(rolling_velocity_of(*f.patch(), speeds));
                          })},
            {"t_gamma",
             "T gamma for wear: minus the power of forces and moment on the creepages per metre rolled [N]; slip_power "
             "per metre on ever finer meshes, a few per cent off on coarse ones, more where next to nothing slips",
             of(&Found::solved, false, [](const PatchForce& p) { return t_gamma(p); })},
            {"fatigue_index",
             "index of surface fatigue, expected where positive: force of friction over the normal force, less "
             "--shear-yield over the peak pressure",
             study::where(&Found::solved,
                          [](const Found& f) {
                              return surface_fatigue_index(*f.patch(), *f.solved(), f.settings.shear_yield);
                          })},
            {"elements", "number of elements of the patch",
             study::where(&Found::force, [](const Found& f) { return f.force()->elements; })},
            {"pitch_rate", "angular velocity of the wheelset about its axle, given or found [rad/s]",
             [](const Found& f) { return f.contacts.of.pitch_rate; }}};
}

Columns heat_columns() {
    return {{"peak_temperature",
             "with --temperature: largest flash temperature of the patch [K above ambient], with half of the heat in "
             "each body; empty where the contact passes slowly, V half_length < 10 conductivity/heat capacity, or "
             "creeps by more than 20 %, and with --hot-friction status is then not_converged",
             study::where(&Found::solved, [](const Found& f) { return f.solved()->peak_temperature; })}};
}

/// Columns of positions, separated by commas, with their units.
std::string with_units(const std::string& columns) {
    std::vector<std::string> all = study::columns_of(columns);
    for (std::string& name : all) {
        if (name == "shift" || name == "track_x") name += " [m]";
        if (name == "yaw" || name == "pitch") name += " [rad]";
    }
    return study::join(all, ",");
}

/// The columns, in track axes: y, angles and lateral quantities of a left wheel are its mirror image's, reversed.
study::Sheet<Found, Case> sheet_of(const std::string& positions, bool friction, bool heats, bool stress) {
    Columns columns = patch_columns();
    if (friction) columns = study::joined(columns, friction_columns());
    if (heats) columns = study::joined(columns, heat_columns());
    if (stress) columns = study::joined(columns, stress_columns());
    return {with_units(positions), columns, ""};
}

/// The patches of one position on a terminal.
const study::Blocks patch_by_patch{{"shift", "yaw", "track_x", "pitch", "roll", "side", "patch", "status"},
                                   {"load",
                                    "x",
                                    "y",
                                    "z",
                                    "rail_y",
                                    "wheel_y",
                                    "angle",
                                    "peak_pressure",
                                    "area",
                                    "half_length",
                                    "half_width",
                                    "longitudinal_creepage",
                                    "lateral_creepage",
                                    "spin",
                                    "longitudinal_force",
                                    "lateral_force",
                                    "spin_moment",
                                    "slip_power",
                                    "peak_temperature",
                                    "max_von_mises",
                                    "max_tresca"}};

std::string help() {
    return R"(Example: contact points over the lateral shift, as every vehicle engineer draws them
  profile_study --shift -0.004,-0.002,0,0.002,0.004,0.006 --side both --output contacts.csv --plot contacts.svg

Track axes: x forward, y to the right, z down, the origin between the rails at the height of their tops. A position is
shift, yaw and a roll, and where surfaces change along the way track_x (--x) and pitch, columns of these names. The
height of the wheelset, and without --roll the roll, follow from the loads, or --height is given. One row for each
position, wheel and patch; all in SI units:
)" + sheet_of("", true, true, true).help() +
           R"(
Words of status, and remedies:
  ok
  doubtful_plane      surfaces turn by more than 0.2 rad over the patch: a plane errs by 1 to 2 % in pressures
  unbalanced          normal forces and friction did not come to carry the loads to 1e-6, or the wheel does not roll:
                      another --pitch-rate, --speed or --shift
and without numbers:
  no_contact          wheel and rail do not touch: look at --shift, --roll, --height, --gauge or --rail-origin
  end_of_profile      contact reaches the end of a profile, which is not known beyond: a longer profile
  undefined_section   the wheel has no section there: a smaller --yaw
  too_deep            the wheel lies more than 1 mm within the rail: a smaller --height or --load, or another place or
                      unit of a profile is meant
  load_not_reached    no height carries the load: another --load; with friction, which may hold the wheel up, --roll
  not_converged       pressures did not settle: other --cells, or --smooth for measured profiles
  few_cells           pressures need more cells than can be solved for, or fewer than 7 touch: --smooth for
                      measured profiles, or finer --cells
  not_finite          a number overflowed: look at the units
With --friction further ones, with the forces empty:
  invalid_step        the wheel does not roll, as V and -pitch_rate rolling_radius add up to 0: another --pitch-rate
  assists_creepage    rolling gains energy on these elements: other --strips or --n
  no_solution         tractions were not found to rounding: other --strips or --n; or friction cannot have --force

Profiles: files are cleaned of repeated points, zig-zags and folds at their ends; MiniProf's z is turned where the shape
says that it points up; the sidecar says what was done. A wheel must have its flange at y < 0, |z| < 2 mm on the tape
circle and a width of 90 to 180 mm, a rail its top within 10 mm of z = 0 and a width of 30 to 200 mm: else a line names
the remedy. The rail is placed by --gauge, its narrowest place down to --gauge-depth below the top, or by --rail-origin,
about which it is canted. --smooth is for measured profiles; corners stay, and too short a wave length leaves noise that
breaks patches up (few_cells).
  profile_study --wheel worn.whl --tape-offset 0 --rail worn.ban --rail-mirror y --cant 0 --smooth 0.007 --load 8e4
  profile_study --rail nose.slcs --length-unit mm --any-shape --rail-origin 0.75,0 --cant 0 --x 0,0.05,0.1 --roll 0

--friction FILE: mu is linear over the angle of the rail's surface [rad] or y of its profile [m], as on the right rail,
whose gauge corner has negative angles, and constant beyond the rows. --force: the pitch rate is found at which friction
has this force on the wheelset, positive along x; no_solution where none up to 20 % of creepage has. --load-of normal:
normal forces alone carry --load, as in CONTACT; all: together with the vertical share of friction, as rolling_forces of
the library has it. At --shift 0.005 --load 8e4 --friction 0.3 the patch on the tread has 52.3 kN, or 51.3 by all.
--layer: a third body, or roughness.
--stress FILE: where von Mises' stress is largest below each strip of a patch: position (from 1 in the order of the
rows), side, patch, s, x, depth [m], von_mises, tresca [Pa].
--wear FILE: side, profile (rail or wheel, of the left side in mirror images), s (length along the profile), y, z [m]
and work, the frictional work per metre rolled and metre of profile [J/m^2], the mean over all positions.
)" + profile::wear_help() +
           R"(--outline DIR: files P_SIDE_K.outline.csv and P_SIDE_K.pressure.csv of position P and patch K, e.g. for
  patch_study --n 12 --outline DIR/1_right_1.outline.csv --pressure DIR/1_right_1.pressure.csv --longitudinal 0.1

)" + profile::conicity_help() +
           R"(  profile_study --conicity --wheel worn.whl --tape-offset 0 --rail worn.ban --cant 0 --plot conicity.svg
)" + profile::method_help();
}

// --- files -----------------------------------------------------------------------------------------------------------

/// Contacts at a position, found by the task that has the rows of these sides.
struct Position {
    Contacts contacts;
    study::RowRange sides;
};
using Positions = std::vector<std::optional<Position>>;

/// Calls visit(position, left, number, patch) for all patches that have numbers.
template <class Visit>
void for_patches(const Settings& settings, const Positions& positions, const Visit& visit) {
    for (std::size_t at = 0; at < positions.size(); ++at) {
        if (!positions[at]) continue;
        const auto& [contacts, sides] = *positions[at];
        for (std::size_t k = sides.first; k < sides.last; ++k) {
            const Side side = settings.sides[k];
            const rollbem::WheelOnRail::Contact& wheel = contacts.of.contacts.wheels[std::size_t(side)];
            for (std::size_t i = 0; rollbem::has_numbers(wheel.status) && i < wheel.patches.size(); ++i) {
                if (wheel.patches[i].has_numbers()) visit(at, side == Side::left, i, wheel.patches[i]);
            }
        }
    }
}

/// Files P_SIDE_K.outline.csv and P_SIDE_K.pressure.csv of position P, wheel SIDE and patch K, counted from 1, in
/// metres.
void write_outlines(study::OutputFiles& files, const Settings& settings, const Positions& positions) {
    for_patches(settings, positions, [&](std::size_t at, bool left, std::size_t number, const RailPatch& patch) {
        // a left wheel is a mirror image: s is reversed
        const double sign = left ? -1 : 1;
        const rollbem::PatchContact::Outline& outline = *patch.outline;
        std::string edges = "y,x_trailing,x_leading\n", pressures = "x,y,pressure\n";
        for (Eigen::Index i = 0; i < outline.y().size(); ++i) {
            const double y = outline.y()[left ? outline.y().size() - 1 - i : i];
            edges += study::csv_line({sign * y, outline.trailing(y), outline.leading(y)});
        }
        const rollbem::NormalContact::Cells& grid = patch.grid;
        for (Eigen::Index i = 0; i < grid.nx; ++i) {
            for (Eigen::Index j = 0; j < grid.ny; ++j) {
                pressures += study::csv_line({grid.x(i), sign * grid.y(j), patch.pressure(i, j)});
            }
        }
        const std::string name = settings.outline + "/" + std::to_string(at + 1) + (left ? "_left_" : "_right_") +
                                 std::to_string(number + 1);
        files.add(name + ".outline.csv", "--outline", edges);
        files.add(name + ".pressure.csv", "--outline", pressures);
    });
}

/// The largest stress below each strip of each patch.
void write_stresses(study::OutputFile& file, const Settings& settings, const Positions& positions) {
    file.write("position,side,patch,s,x,depth,von_mises,tresca\n");
    for_patches(settings, positions, [&](std::size_t at, bool left, std::size_t number, const RailPatch&) {
        const auto& patches = positions[at]->contacts.stresses[left ? 0 : 1];
        if (number >= patches.size()) return;
        for (const rollbem::Yield::Peak& peak : patches[number]) {
            file.write(study::csv_line({at + 1, left ? "left" : "right", number + 1, (left ? -1 : 1) * peak.y, peak.x,
                                        peak.von_mises_depth, peak.von_mises, peak.tresca}));
        }
    });
}

/// Frictional work on the profiles of both sides, the mean over the positions.
void write_wear(study::OutputFile& file, const Settings& settings, const Positions& positions) {
    const auto known = [](const std::optional<Position>& position) { return position.has_value(); };
    const auto count = double(std::count_if(positions.begin(), positions.end(), known));
    file.write("side,profile,s,y,z,work\n");
    for (const Side side : settings.sides) {
        for (const bool rail : {true, false}) {
            const rollbem::WheelOnRail& wheel = settings.wheelset.wheel(side);
            const rollbem::Profile& profile = rail ? wheel.rail() : wheel.wheel();
            constexpr double cell = 2e-4;  // [m]
            rollbem::ProfileWear wear(profile, Eigen::Index(profile.length() / cell) + 1);
            for (const std::optional<Position>& position : positions) {
                const auto k = static_cast<std::size_t>(side);
                for (std::size_t i = 0; position && i < position->contacts.of.patches[k].size(); ++i) {
                    const RailPatch& patch = position->contacts.of.contacts.wheels[k].patches[i];
                    wear.add(rail ? patch.rail_s : patch.wheel_s, position->contacts.of.patches[k][i], 1 / count);
                }
            }
            for (Eigen::Index i = 0; i < wear.work().size(); ++i) {
                const double s = (double(i) + 0.5) * wear.width();
                const rollbem::Profile::Point at = profile.at(s);
                file.write(study::csv_line(
                    {side == Side::left ? "left" : "right", rail ? "rail" : "wheel", s, at.y, at.z, wear.work()[i]}));
            }
        }
    }
}

// --- the program -----------------------------------------------------------------------------------------------------

/// The columns, files that are opened before anything is computed, and what is kept for them and the picture.
struct Run {
    Run(const Settings& given, study::OutputFiles& files)
        : settings(given),
          sheet(sheet_of(given.columns, given.friction.has_value(), given.friction && given.friction->heating,
                         !given.stress.empty())),
          positions(given.cases.size()) {
        if (!given.wear.empty()) wear = &files.open(given.wear, "--wear");
        if (!given.stress.empty()) stress = &files.open(given.stress, "--stress");
        if (!given.outline.empty()) files.make_folder(given.outline, "--outline");
    }
    bool keeps() const {
        return settings.cases.size() == 1 || !settings.outline.empty() || wear != nullptr || stress != nullptr;
    }

    const Settings& settings;
    study::Sheet<Found, Case> sheet;
    study::OutputFile *wear = nullptr, *stress = nullptr;
    Positions positions;
};

/// A row for each patch; for each wheel that has none, one that says why.
void emit_rows(Run& run, const Case& at, study::RowRange range, const study::Results<Found>& emit) {
    const Contacts contacts = find_contacts(run.settings, at);
    if (run.keeps()) run.positions[std::size_t(&at - run.settings.cases.data())] = Position{contacts, range};
    for (std::size_t k = range.first; k < range.last; ++k) {
        Found found{run.settings, at, contacts, run.settings.sides[k], std::nullopt, run.settings.timed};
        const std::size_t count = rollbem::has_numbers(found.wheel().status) ? found.wheel().patches.size() : 0;
        if (count == 0) emit(found);
        for (std::size_t number = 0; number < count; ++number) {
            found.number = number;
            emit(found);
        }
    }
}

/// The patches of one position, or the contact points of several.
study::Picture draw(const Run& run, const study::Records& rows) {
    if (run.settings.cases.size() > 1) return profile::draw_contact_points(run.settings.wheelset, rows);
    std::vector<profile::Drawn> drawn;
    for_patches(run.settings, run.positions, [&](std::size_t, bool left, std::size_t, const RailPatch& patch) {
        drawn.push_back({left, patch});
    });
    return profile::draw_patches(drawn, rows.rows.size() - drawn.size());
}

study::Table patch_table(Run& run, study::OutputFiles& files) {
    const Settings& settings = run.settings;
    study::Table table = run.sheet.table(
        settings.cases, [&](const Case&) { return settings.sides.size(); },
        [&](const Case& at, study::RowRange range, const study::Results<Found>& emit) {
            emit_rows(run, at, range, emit);
        });
    table.finish = [&] {
        if (!settings.outline.empty()) write_outlines(files, settings, run.positions);
        if (run.wear != nullptr) write_wear(*run.wear, settings, run.positions);
        if (run.stress != nullptr) write_stresses(*run.stress, settings, run.positions);
    };
    table.plot = [&](const study::Records& rows) { return draw(run, rows); };
    if (settings.cases.size() == 1) table.blocks = patch_by_patch;
    return table;
}

}  // namespace

int main(int argc, char** argv) {
    study::Options options("profile_study", "Patches of a wheel on a rail, from their profiles.");
    profile::add_options(options);
    options.footer(help());
    return study::run_program(options, argc, argv, [](const study::Options& given) {
        if (given.flag("conicity")) {
            const profile::Conicity conicity = profile::read_conicity(given);
            study::write_table(given, profile::conicity_table(conicity));
        } else if (given.flag("virtual-penetration")) {
            const profile::MethodScene scene = profile::read_methods(given);
            study::write_table(given, profile::method_table(scene));
        } else {
            const Settings settings = profile::read_settings(given);
            study::OutputFiles files;
            if (settings.wear_plan) {
                profile::WearRun wear(settings);
                study::write_table(given, wear.table(files), files);
            } else {
                Run run(settings, files);
                study::write_table(given, patch_table(run, files), files);
            }
        }
        return study::exit_ok;
    });
}
