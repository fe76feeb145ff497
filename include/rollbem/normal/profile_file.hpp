// Profiles and surfaces from files: of measuring devices, of points, and of lists of profiles; and their doubts.
#pragma once

#include "../detail/decl.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "profile.hpp"
#include "surface.hpp"

namespace rollbem {

/// Throws std::invalid_argument, with the fault and its remedy, unless the profile can be a whole right wheel. Pieces
/// pass.
///
/// - Width: 90 to 180 mm.
/// - Flange: its crown (largest z) lies 25 to 65 mm inside the tape circle, at z >= 10 mm.
/// - Tape circle: -6 mm < z < 2 mm there (the radius is that of z = 0); it lies 70 mm from the flange's back, and the
///   profile's origin `tape_offset` [m].
void require_wheel(const Profile& wheel, double tape_offset);

/// Throws std::invalid_argument, with the fault and its remedy, unless the profile can be a whole rail: 30 to 200 mm
/// wide, its top (least z) within 10 mm of z = 0 and higher than both ends. Pieces pass.
void require_rail(const Profile& rail);

struct ProfileFile {
    /// Remedies in messages and doubts name the options of profile_study; --length-unit is per_metre here,
    /// --wheel-mirror and --rail-mirror are mirror_y and mirror_z, --any-shape is Profile::Use::piece, others have the
    /// names of members.
    struct Options {
        double per_metre = 1;                     ///< units of length in a metre, of files with two columns: 1 or 1000
        bool mirror_y = false, mirror_z = false;  ///< the sign of y or z changes
        double smooth = 0;          ///< wave length [m] as in Profile::smoothed; 0: the points as they are
        double tape_offset = 0.07;  ///< distance of the tape circle from a wheel's flange back [m]
    };

    /// The position of a rail in its track.
    struct Placing {
        std::optional<double> cant{};  ///< inward turn [rad]; 0 for a profile that is canted already; 1:40 without it
        double roller_radius = 0;      ///< [m] from the axle to the profile's z = 0; 0: a rail
        /// Whether the profile is turned about its origin, in the sense of WheelOnRail::Dimensions::rail_origin.
        /// Otherwise a standard rail has its origin at its highest point, turned or not.
        bool by_origin = false;
    };

    /// The surface of a wheel, in place of the curve.
    struct Wheel {
        WheelSurface surface;
        std::vector<std::string> notes, doubts{};  ///< as below
    };

    /// The surface of a rail.
    struct Rail {
        RailSurface surface;
        std::vector<std::string> notes, doubts{};  ///< as below, and that a file is canted unasked
    };

    std::variant<Profile, Sections> curve;
    std::vector<std::string> notes;  ///< a line for each cleaning, turn and mirroring, with its place
    /// A line for each sign that the profile is not meant as it is read, with the remedy:
    ///
    /// - the back of a wheel's flange more than 2 mm beside its place by tape_offset;
    /// - noise from point to point whose standard deviation exceeds 5e-4 of their distance in the median.
    std::vector<std::string> doubts{};
};

/// Reads a profile in any of the formats. The file's ending decides:
///
/// - .prr and .prw: SIMPACK;
/// - .ban and .whl: MiniProf;
/// - .slcs and .slcw: sections along the track and round the wheel;
/// - else two columns.
///
/// In this order the profile is cleaned of artefacts of measurement, mirrored, smoothed and checked by require_wheel or
/// require_rail; sections and pieces are not checked. Throws std::invalid_argument with the file, the line and the
/// expected content.
ProfileFile read_profile(const std::filesystem::path& path, Profile::Use use, const ProfileFile::Options& options = {});

/// Whether this is the name of a standard wheel, s1002, or of a standard rail, 60e1, uic60 or 54e1.
bool is_standard_profile(const std::filesystem::path& name, Profile::Use use);

/// The right wheel s1002, or a wheel from a file by read_profile, of any shape or checked. Throws
/// std::invalid_argument.
ProfileFile::Wheel open_wheel(const std::filesystem::path& name, const ProfileFile::Options& options = {},
                              bool any_shape = false);

/// The right rail 60e1, uic60 or 54e1, or a rail from a file by read_profile, of any shape or checked, canted; a roller
/// if it has a radius. A profile that is canted already needs the cant 0: `doubts` of the result say where none was
/// given. Throws std::invalid_argument.
ProfileFile::Rail open_rail(const std::filesystem::path& name, const ProfileFile::Options& options = {},
                            const ProfileFile::Placing& placing = {}, bool any_shape = false);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/profile_file.ipp"
#endif
