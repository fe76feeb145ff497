// What profile_study is asked for, profiles, track, loads and positions, and its pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <rollbem/vehicle/wheelset_forces.hpp>

#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/plot.hpp"

namespace profile {

using Side = rollbem::WheelsetOnTrack::Side;

struct Case {
    double shift, yaw;
    std::optional<double> roll, pitch_rate;
    std::string label() const { return "shift = " + study::Cell(shift).text(4) + " m"; }
};
inline study::Cell scene_cell(const Case& at, const std::string& name) { return name == "shift" ? at.shift : at.yaw; }

struct Settings {
    rollbem::WheelsetOnTrack wheelset;
    std::vector<Side> sides;
    double load;
    rollbem::WheelOnRail::Options grid;
    std::optional<rollbem::RollingFriction> friction;
    double speed;        ///< V [m/s]
    double shear_yield;  ///< [Pa]
};

/// Declares the options of profile_study.
void add_options(study::Options& options);

/// Throws BadInput, as read_cases does.
Settings read_settings(const study::Options& options);

/// All positions, the shift outermost and the pitch rate innermost.
std::vector<Case> read_cases(const study::Options& options);

// --- profiles by name or from files: CSV of y and z, and the .prw and .prr text of multibody programs

/// Declares --wheel, --rail, --length-unit, --cant and --smooth.
void add_profile_options(study::Options& options);

/// --wheel: z = 0 on the tape circle, as the file says.
rollbem::Profile read_wheel(const study::Options& options);

/// --rail, canted and moved down or up so that its highest point has z = 0. Throws BadInput, as read_wheel does.
rollbem::Profile read_rail(const study::Options& options);

// --- pictures

struct Drawn {
    bool left;
    rollbem::RailPatch patch;  ///< as on the right wheel
};

/// Patches from above: pressures in steps of a fifth of the largest one, and outlines; the last title counts rows
/// `without` a patch.
study::Plot draw_patches(const std::vector<Drawn>& patches, std::size_t without);

/// Wheel above rail, and lines that join where they touch, one for each row.
study::Plot draw_contact_points(const rollbem::WheelOnRail& wheel, const std::vector<std::string>& columns,
                                const std::vector<study::Row>& rows);

}  // namespace profile
