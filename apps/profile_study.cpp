// Where a wheel touches a rail and how hard, from their profiles: positions, angles, loads, pressures and areas of all
// patches, over the lateral shift and yaw of a wheelset, and with friction the creepages and forces:
//
//     ./profile_study --shift 0,0.001,0.002,0.003,0.004,0.005 --plot contacts.svg
//     ./profile_study --shift 0.005 --yaw 0.012 --side both --friction 0.3 --plot patches.svg
//     ./profile_study --wheel worn.csv --length-unit mm --rail head.prr --cant 0 --load 8e4
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/vehicle/wheelset_on_track.hpp>

#include "profile/files.hpp"
#include "profile/friction.hpp"
#include "profile/plots.hpp"
#include "profile/settings.hpp"
#include "support/options.hpp"
#include "support/program.hpp"
#include "support/table.hpp"

namespace {

using profile::Case;
using profile::Settings;
using profile::Side;
using rollbem::NormalStatus;
using rollbem::RailPatch;
using rollbem::WheelOnRail;
using rollbem::WheelsetPosition;

/// A wheel as on the right, with the forces on its patches.
struct Wheel {
    WheelsetPosition at;
    WheelOnRail::Contact contact;
    std::vector<profile::PatchForces> forces{};
};

struct Contacts {
    std::array<Wheel, 2> wheels;
    double pitch_rate = std::nan("");
    double time_us = 0;
};

bool found(const WheelOnRail::Contact& contact) { return contact.status <= NormalStatus::doubtful_plane; }

// --- contacts --------------------------------------------------------------------------------------------------------

/// Both wheels under `friction`, the force on the rail along s over N of each.
Contacts press(const Settings& settings, const Case& at, const std::array<double, 2>& friction,
               rollbem::WheelsetOnTrack::Workspace& workspace) {
    Contacts contacts;
    WheelsetPosition position{at.shift, 0, at.roll.value_or(0), at.yaw};
    std::array<WheelOnRail::Contact, 2> wheels;
    if (at.roll) {
        for (std::size_t k = 0; k < 2; ++k) {
            wheels[k] = settings.wheelset.wheel().carry(rollbem::WheelsetOnTrack::seen_from(Side(k), position),
                                                        settings.load, friction[k], workspace.wheels[k], settings.grid);
        }
    } else {
        auto both =
            settings.wheelset.carry(position, {settings.load, settings.load}, workspace, friction, settings.grid);
        position = both.position;
        wheels = std::move(both.wheels);
        if (both.status > NormalStatus::doubtful_plane) {
            for (WheelOnRail::Contact& wheel : wheels) wheel.status = both.status;
        }
    }
    for (std::size_t k = 0; k < 2; ++k) {
        position.height = wheels[k].height;
        contacts.wheels[k] = {rollbem::WheelsetOnTrack::seen_from(Side(k), position), std::move(wheels[k])};
    }
    return contacts;
}

Contacts find_contacts(const Settings& settings, const Case& at) {
    const auto start = std::chrono::steady_clock::now();
    const rollbem::TrackDimensions& track = settings.wheelset.wheel().dimensions();
    rollbem::WheelsetOnTrack::Workspace workspace;
    Contacts contacts;
    std::array<double, 2> friction{0, 0};
    // the normal forces depend on those of friction, and these on them: a few rounds
    for (int round = 0; round < 8; ++round) {
        contacts = press(settings, at, friction, workspace);
        if (!settings.friction) break;
        auto& [left, right] = contacts.wheels;
        if (at.pitch_rate) {
            contacts.pitch_rate = *at.pitch_rate;
        } else if (found(left.contact) && found(right.contact)) {
            contacts.pitch_rate =
                profile::free_pitch_rate({left.contact.patches[0], left.at}, {right.contact.patches[0], right.at},
                                         settings.friction->speed, track.radius);
        } else {
            break;
        }
        double change = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            Wheel& wheel = contacts.wheels[k];
            if (!found(wheel.contact)) continue;
            double across = 0, lever = 0;  // one ratio that lets the rail carry as much as those of all patches do
            for (const RailPatch& patch : wheel.contact.patches) {
                wheel.forces.push_back(
                    profile::forces_on(patch, wheel.at, contacts.pitch_rate, track, *settings.friction));
                across -= wheel.forces.back().lateral * std::sin(patch.angle);
                lever += patch.load * std::sin(patch.angle);
            }
            const double ratio = across / lever;
            if (!(std::abs(ratio) <= 1)) continue;  // level: friction carries nothing
            change = std::max(change, std::abs(ratio - friction[k]));
            friction[k] = ratio;
        }
        if (change < 1e-4) break;
    }
    contacts.time_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    return contacts;
}

// --- rows ------------------------------------------------------------------------------------------------------------

std::vector<std::string> columns(bool friction) {
    std::vector<std::string> names{
        "shift", "yaw",         "roll",       "side",       "patch",          "height", "x",        "y",
        "z",     "rail_y",      "wheel_y",    "angle",      "rolling_radius", "load",   "approach", "peak_pressure",
        "area",  "half_length", "half_width", "iterations", "time_us",        "status"};
    if (!friction) return names;
    return study::joined(names, {"longitudinal_creepage", "lateral_creepage", "spin", "longitudinal_force",
                                 "lateral_force", "spin_moment", "slip_power", "elements", "pitch_rate"});
}

/// In track axes: of a left wheel, y, angles and what lies across the track are those of its mirror image reversed.
study::Row row_of(const Settings& settings, const Case& at, const Contacts& contacts, Side side,
                  std::optional<std::size_t> number, const study::Cell& time_us) {
    const Wheel& wheel = contacts.wheels[std::size_t(side)];
    const double sign = side == Side::right ? 1 : -1;
    const bool known = number && wheel.contact.patches[*number].has_numbers();
    const RailPatch patch = known ? wheel.contact.patches[*number] : RailPatch{};
    const study::Cell none;
    const auto value = [&](auto of) { return known ? study::Cell(of) : none; };
    std::string status = name(number ? wheel.contact.patches[*number].status : wheel.contact.status);
    const bool rubs = known && *number < wheel.forces.size();
    study::Row forces;
    if (settings.friction) {
        const profile::PatchForces of = rubs ? wheel.forces[*number] : profile::PatchForces{};
        const bool solved = rubs && of.status == rollbem::StepStatus::ok;
        if (rubs && !solved) status = name(of.status);
        if (known && !rubs) status = "no_pitch_rate";  // the other wheel has no contact
        const auto force = [&](double number_of, bool if_known) { return if_known ? study::Cell(number_of) : none; };
        forces = {force(of.creepage.longitudinal, rubs),
                  force(sign * of.creepage.lateral, rubs),
                  force(sign * of.creepage.spin, rubs),
                  force(of.longitudinal, solved),
                  force(sign * of.lateral, solved),
                  force(sign * of.moment, solved),
                  force(of.power, solved),
                  rubs ? study::Cell(of.elements) : none,
                  contacts.pitch_rate};
    }
    study::Row row{at.shift,
                   at.yaw,
                   at.roll ? study::Cell(*at.roll) : value(sign * wheel.at.roll),
                   side == Side::right ? "right" : "left",
                   number ? study::Cell(*number + 1) : none,
                   value(wheel.at.height),
                   value(patch.x),
                   value(sign * patch.y),
                   value(patch.z),
                   value(patch.rail_y),
                   value(patch.wheel_y),
                   value(sign * patch.angle),
                   value(patch.rolling_radius),
                   value(patch.load),
                   value(patch.approach),
                   value(patch.peak_pressure),
                   value(patch.area),
                   value(patch.half_length),
                   value(patch.half_width),
                   value(patch.steps),
                   time_us,
                   status};
    return study::joined(row, forces);
}

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line, profiles and positions.
    study::Options options("profile_study", "Patches of a wheel on a rail, from their profiles.");
    profile::add_options(options);
    return study::run_program(options, argc, argv, [](const study::Options& given) {
        const Settings settings = profile::read_settings(given);
        const std::vector<Case> cases = profile::read_cases(given);
        std::optional<profile::PatchFiles> files;
        if (given.given("outline")) files.emplace(given);
        std::vector<profile::Drawn> drawn;  // patches of a single position
        const std::vector<std::string> names = columns(settings.friction.has_value());

        // 2. A row for each patch; for each wheel that has none, one that says why.
        study::Table table = study::table_of(names, cases, settings.sides.size());
        table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
            const Contacts contacts = find_contacts(settings, cases[task]);
            study::Cell time_us;
            if (study::has_times(given)) time_us = contacts.time_us;
            for (std::size_t k = range.first; k < range.last; ++k) {
                const Side side = settings.sides[k];
                const WheelOnRail::Contact& contact = contacts.wheels[std::size_t(side)].contact;
                const std::size_t count = found(contact) ? contact.patches.size() : 0;
                if (count == 0) emit(row_of(settings, cases[task], contacts, side, std::nullopt, time_us));
                for (std::size_t number = 0; number < count; ++number) {
                    emit(row_of(settings, cases[task], contacts, side, number, time_us));
                    const RailPatch& patch = contact.patches[number];
                    if (!patch.has_numbers()) continue;
                    const bool left = side == Side::left;
                    if (files) files->add(task, left, number, patch);
                    if (cases.size() == 1) drawn.push_back({left, patch});
                }
            }
        };
        table.written = [&] {
            if (files) files->write();
        };
        // 3. The patches of one position, or the contact points of several.
        table.plot = [&](const std::vector<study::Row>& rows) {
            return cases.size() == 1 ? profile::draw_patches(drawn)
                                     : profile::draw_contact_points(settings.wheelset.wheel(), names, rows);
        };
        study::write_table(given, table);
        return study::exit_ok;
    });
}
