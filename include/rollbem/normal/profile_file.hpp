// Profiles from files: two columns, SIMPACK's .prr and .prw, MiniProf's .ban and .whl, sections .slcs and .slcw. For
// wheels and canted rails see surface_file.hpp.
#pragma once

#include "../detail/decl.hpp"

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "profile.hpp"
#include "profile_check.hpp"
#include "sections.hpp"

namespace rollbem {

struct ProfileFileOptions {
    double per_metre = 1;                     ///< units of length in a metre, of files with two columns: 1 or 1000
    bool mirror_y = false, mirror_z = false;  ///< the sign of y or z changes
    double smooth = 0;                        ///< wave length [m] as in Profile::smoothed; 0: the points as they are
    double tape_offset = 0.07;                ///< distance of the tape circle from a wheel's flange back [m]
};

struct ProfileFile {
    std::variant<Profile, Sections> curve;
    std::vector<std::string> notes;  ///< a line for each cleaning, turn and mirroring, with its place
    /// A line for each sign that the profile is not meant as it is read, with the remedy: the back of a wheel's flange
    /// more than 2 mm beside its place by tape_offset.
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
ProfileFile read_profile(const std::filesystem::path& path, Profile::Use use, const ProfileFileOptions& options = {});

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/profile_file.ipp"
#endif
