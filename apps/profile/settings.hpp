// What profile_study is asked for: profiles, track, loads and positions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <rollbem/vehicle/wheelset_forces.hpp>

#include "support/csv.hpp"
#include "support/options.hpp"

namespace profile {

using Side = rollbem::WheelsetOnTrack::Side;

struct Case {
    double shift, yaw;
    std::optional<double> roll, pitch_rate;
    std::string label() const { return "shift = " + study::Cell(shift).text(4) + " m"; }
};

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

}  // namespace profile
