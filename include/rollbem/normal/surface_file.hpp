// Wheels and rails by the names of their standards or from files.
#pragma once

#include "../detail/decl.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "profile_file.hpp"
#include "standard_profiles.hpp"
#include "surface.hpp"

namespace rollbem {

struct WheelFile {
    WheelSurface surface;
    std::vector<std::string> notes, doubts{};  ///< of ProfileFile
};

struct RailFile {
    RailSurface surface;
    std::vector<std::string> notes, doubts{};  ///< of ProfileFile, and that a file is canted unasked
};

/// The position of a rail in its track.
struct RailPlacing {
    std::optional<double> cant{};  ///< inward turn [rad]; 0 for a profile that is canted already; 1:40 without it
    double roller_radius = 0;      ///< [m] from the axle to the profile's z = 0; 0: a rail
    /// Whether the profile is turned about its origin, in the sense of TrackDimensions::rail_origin. Otherwise a
    /// standard rail has its origin at its highest point, turned or not.
    bool by_origin = false;
};

/// Whether this is the name of a standard wheel, s1002, or of a standard rail, 60e1, uic60 or 54e1.
bool is_standard_profile(const std::filesystem::path& name, Profile::Use use);

/// The right wheel s1002, or a wheel from a file by read_profile, of any shape or checked. Throws
/// std::invalid_argument.
WheelFile open_wheel(const std::filesystem::path& name, const ProfileFileOptions& options = {}, bool any_shape = false);

/// The right rail 60e1, uic60 or 54e1, or a rail from a file by read_profile, of any shape or checked, canted; a roller
/// if it has a radius. A profile that is canted already needs the cant 0: `doubts` of the result say where none was
/// given. Throws std::invalid_argument.
RailFile open_rail(const std::filesystem::path& name, const ProfileFileOptions& options = {},
                   const RailPlacing& placing = {}, bool any_shape = false);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/surface_file.ipp"
#endif
