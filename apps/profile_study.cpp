// Where a wheel touches a rail and how hard, from their profiles: positions, angles, loads, pressures and areas of all
// patches, over the lateral shift and yaw of a wheelset, and with friction the creepages and forces:
//
//     ./profile_study --shift 0,0.001,0.002,0.003,0.004,0.005 --plot contacts.svg
//     ./profile_study --shift 0.005 --yaw 0.012 --side both --friction 0.3 --plot patches.svg
//     ./profile_study --wheel worn.whl --tape-offset 0 --rail head.prr --cant 0 --load 8e4
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/compiled/wheelset.hpp>
#include <rollbem/vehicle/patch_stress.hpp>
#include <rollbem/vehicle/wear.hpp>

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

using Stresses = std::array<std::vector<std::vector<rollbem::StripStress>>, 2>;  // of each side, patch and strip

struct Contacts {
    rollbem::WheelsetForces of;
    Stresses stresses{};  ///< where they are asked for
    double time_us = 0;
};

Contacts find_contacts(const Settings& settings, const Case& at) {
    const auto start = std::chrono::steady_clock::now();
    rollbem::WheelsetOnTrack::Workspace workspace;
    using Free = rollbem::WheelsetOnTrack::Free;
    const rollbem::WheelsetRolling rolling{
        .position = {at.shift, at.height.value_or(0), at.roll.value_or(0), at.yaw, at.along, at.pitch},
        .loads = {settings.load, settings.load},
        .free = at.height ? Free::nothing
                : at.roll ? Free::height
                          : Free::height_and_roll,
        .speeds = {.forward = settings.speed, .pitch_rate = at.pitch_rate.value_or(0)},
        .free_pitch = !at.pitch_rate,
        .force = settings.force,
        .friction_carries = settings.friction_carries};
    Contacts contacts;
    if (settings.friction) {
        contacts.of = rolling_forces(settings.wheelset, rolling, *settings.friction, workspace, settings.grid);
    } else {
        contacts.of.contacts =
            settings.wheelset.solve(rolling.position, rolling.loads, workspace, rolling.free, settings.grid);
    }
    contacts.time_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    for (const Side side : settings.sides) {
        if (!settings.stress) break;
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
    const rollbem::StripStress* strip(double rollbem::Yield::*measure) const {
        if (solved() == nullptr || contacts.stresses[std::size_t(side)].empty()) return nullptr;
        const auto& strips = contacts.stresses[std::size_t(side)][*number];
        const auto worst = std::max_element(strips.begin(), strips.end(), [&](const auto& one, const auto& other) {
            return one.peak.largest.*measure < other.peak.largest.*measure;
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

/// The largest measures below a patch, where they lie, and its place in the map of shakedown.
void add_stresses(std::vector<study::Column<Found>>& list) {
    using rollbem::SubsurfacePeak;
    using rollbem::Yield;
    const auto add = [&](const char* name, double Yield::*measure, double SubsurfacePeak::*depth) {
        list.push_back({name, "", [=](const Found& f) {
                            const rollbem::StripStress* strip = f.strip(measure);
                            if (strip == nullptr) return study::Cell();
                            return study::Cell(depth == nullptr ? strip->peak.largest.*measure : strip->peak.*depth);
                        }});
    };
    add("max_von_mises", &Yield::von_mises, nullptr);
    add("von_mises_depth", &Yield::von_mises, &SubsurfacePeak::von_mises_depth);
    add("max_tresca", &Yield::tresca, nullptr);
    add("tresca_depth", &Yield::tresca, &SubsurfacePeak::tresca_depth);
    for (const bool load : {true, false}) {
        list.push_back(
            {load ? "shakedown_load" : "shakedown_traction", "", study::where(&Found::solved, [=](const Found& f) {
                 const auto at = shakedown_point(*f.patch(), *f.solved(), f.settings.shear_yield);
                 return load ? at.load_factor : at.traction;
             })});
    }
}

/// In track axes: of a left wheel, y, angles and what lies across the track are those of its mirror image reversed.
study::Sheet<Found, Case> sheet_of(const std::string& positions, const Settings& settings) {
    const bool friction = settings.friction.has_value();
    const auto found = [](const auto& value) { return study::where(&Found::patch, value); };
    const auto of_patch = [=](double RailPatch::*member, bool mirrored = false) {
        return found([=](const Found& f) { return f.sign(mirrored) * f.patch()->*member; });
    };
    std::vector<study::Column<Found>> list{
        {"roll", "",
         [=](const Found& f) {
             if (f.at.roll) return study::Cell(*f.at.roll);
             return f.patch() != nullptr ? study::Cell(f.contacts.of.contacts.position.roll) : study::Cell();
         }},
        {"side", "", [](const Found& f) { return f.side == Side::right ? "right" : "left"; }},
        {"patch", "", study::where(&Found::number, [](const Found& f) { return *f.number + 1; })},
        {"height", "",
         [=](const Found& f) {
             if (f.at.height) return study::Cell(*f.at.height);
             if (f.patch() == nullptr) return study::Cell();
             return study::Cell(f.wheel().height - f.settings.wheelset.height_above(f.side));
         }},
        {"x", "", of_patch(&RailPatch::x)},
        {"y", "", of_patch(&RailPatch::y, true)},
        {"z", "", of_patch(&RailPatch::z)},
        {"rail_y", "", of_patch(&RailPatch::rail_y)},
        {"wheel_y", "", of_patch(&RailPatch::wheel_y)},
        {"angle", "", of_patch(&RailPatch::angle, true)},
        {"rolling_radius", "", of_patch(&RailPatch::rolling_radius)},
        {"load", "", of_patch(&RailPatch::load)},
        {"approach", "", of_patch(&RailPatch::approach)},
        {"peak_pressure", "", of_patch(&RailPatch::peak_pressure)},
        {"area", "", of_patch(&RailPatch::area)},
        {"half_length", "", of_patch(&RailPatch::half_length)},
        {"half_width", "", of_patch(&RailPatch::half_width)},
        {"iterations", "", found([](const Found& f) { return f.patch()->steps; })},
        {"time_us", "", study::where(&Found::has_time, [](const Found& f) { return f.contacts.time_us; })},
        {"status", "", &Found::status}};
    if (!friction) return {positions, list, ""};
    const auto add = [&](const char* name, auto which, bool mirrored, auto value) {
        list.push_back(
            {name, "", study::where(which, [=](const Found& f) { return f.sign(mirrored) * value(*(f.*which)()); })});
    };
    // creepages as CONTACT's, rail minus wheel
    add("longitudinal_creepage", &Found::force, false, [](const PatchForce& p) { return -p.creepage.longitudinal; });
    add("lateral_creepage", &Found::force, true, [](const PatchForce& p) { return -p.creepage.lateral; });
    add("spin", &Found::force, true, [](const PatchForce& p) { return -p.creepage.spin; });
    add("longitudinal_force", &Found::solved, false, [](const PatchForce& p) { return p.force.longitudinal; });
    add("lateral_force", &Found::solved, true, [](const PatchForce& p) { return p.force.lateral; });
    add("spin_moment", &Found::solved, true, [](const PatchForce& p) { return p.force.moment; });
    list.push_back({"slip_power", "", study::where(&Found::solved, [](const Found& f) {
                        const rollbem::WheelsetSpeeds speeds{.forward = f.settings.speed,
                                                             .pitch_rate = f.contacts.of.pitch_rate};
                        return f.solved()->slip_work * std::abs(rolling_velocity_of(*f.patch(), speeds));
                    })});
    add("t_gamma", &Found::solved, false, [](const PatchForce& p) { return t_gamma(p); });
    list.push_back({"fatigue_index", "", study::where(&Found::solved, [](const Found& f) {
                        return surface_fatigue_index(*f.patch(), *f.solved(), f.settings.shear_yield);
                    })});
    list.push_back({"elements", "", study::where(&Found::force, [](const Found& f) { return f.force()->elements; })});
    list.push_back({"pitch_rate", "", [](const Found& f) { return f.contacts.of.pitch_rate; }});
    if (settings.friction->heating)
        add("peak_temperature", &Found::solved, false, [](const PatchForce& p) { return p.peak_temperature; });
    if (settings.stress) add_stresses(list);
    return {positions, list, ""};
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
void write_outlines(study::OutputFiles& files, const std::string& folder, const Settings& settings,
                    const Positions& positions) {
    for_patches(settings, positions, [&](std::size_t at, bool left, std::size_t number, const RailPatch& patch) {
        // a left wheel is a mirror image: s is reversed
        const double sign = left ? -1 : 1;
        const rollbem::Outline<double>& outline = *patch.outline;
        std::string edges = "y,x_trailing,x_leading\n", pressures = "x,y,pressure\n";
        for (Eigen::Index i = 0; i < outline.y().size(); ++i) {
            const double y = outline.y()[left ? outline.y().size() - 1 - i : i];
            edges += study::csv_line({sign * y, outline.trailing(y), outline.leading(y)});
        }
        const rollbem::CellGrid& grid = patch.grid;
        for (Eigen::Index i = 0; i < grid.nx; ++i) {
            for (Eigen::Index j = 0; j < grid.ny; ++j) {
                pressures += study::csv_line({grid.x(i), sign * grid.y(j), patch.pressure(i, j)});
            }
        }
        const std::string name =
            folder + "/" + std::to_string(at + 1) + (left ? "_left_" : "_right_") + std::to_string(number + 1);
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
        for (const rollbem::StripStress& strip : patches[number]) {
            const rollbem::SubsurfacePeak& peak = strip.peak;
            file.write(study::csv_line({at + 1, left ? "left" : "right", number + 1, (left ? -1 : 1) * strip.s, strip.x,
                                        peak.von_mises_depth, peak.largest.von_mises, peak.largest.tresca}));
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

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line, profiles and positions.
    study::Options options("profile_study", "Patches of a wheel on a rail, from their profiles.");
    profile::add_options(options);
    return study::run_program(options, argc, argv, [](const study::Options& given) {
        if (given.flag("conicity")) {
            profile::study_conicity(given);
            return study::exit_ok;
        }
        if (given.flag("virtual-penetration")) {
            profile::study_methods(given);
            return study::exit_ok;
        }
        const std::vector<Case> cases = profile::read_cases(given);
        const Settings settings = profile::read_settings(given, cases.size() > 1);
        const std::string folder = given.text("outline");
        study::OutputFiles files;
        if (!folder.empty()) files.make_folder(folder, "--outline");
        study::OutputFile* wear = given.given("wear") ? &files.open(given.text("wear"), "--wear") : nullptr;
        study::OutputFile* stress = settings.stress ? &files.open(given.text("stress"), "--stress") : nullptr;
        Positions positions(cases.size());  // for files, and the picture of a single one
        const study::Sheet<Found, Case> sheet = sheet_of(profile::case_columns(given), settings);

        // 2. A row for each patch; for each wheel that has none, one that says why.
        const auto compute = [&](const Case& at, study::RowRange range, const study::Results<Found>& emit) {
            const Contacts contacts = find_contacts(settings, at);
            if (cases.size() == 1 || !folder.empty() || wear != nullptr || settings.stress) {
                positions[std::size_t(&at - cases.data())] = Position{contacts, range};
            }
            for (std::size_t k = range.first; k < range.last; ++k) {
                Found found{settings, at, contacts, settings.sides[k], std::nullopt, study::has_times(given)};
                const std::size_t count = rollbem::has_numbers(found.wheel().status) ? found.wheel().patches.size() : 0;
                if (count == 0) emit(found);
                for (std::size_t number = 0; number < count; ++number) {
                    found.number = number;
                    emit(found);
                }
            }
        };
        study::Table table = sheet.table(
            cases, [&](const Case&) { return settings.sides.size(); }, compute);
        table.finish = [&] {
            if (!folder.empty()) write_outlines(files, folder, settings, positions);
            if (wear != nullptr) write_wear(*wear, settings, positions);
            if (stress != nullptr) write_stresses(*stress, settings, positions);
        };
        // 3. The patches of one position, or the contact points of several.
        table.plot = [&](const std::vector<study::Row>& rows) {
            if (cases.size() > 1) return profile::draw_contact_points(settings.wheelset, sheet.names(), rows);
            std::vector<profile::Drawn> drawn;
            for_patches(settings, positions, [&](std::size_t, bool left, std::size_t, const RailPatch& patch) {
                drawn.push_back({left, patch});
            });
            return profile::draw_patches(drawn, rows.size() - drawn.size());
        };
        study::write_table(given, table, files);
        return study::exit_ok;
    });
}
