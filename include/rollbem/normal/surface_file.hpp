// Wheels and rails by the names of their standards or from files.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "../detail/require.hpp"
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
inline bool is_standard_profile(const std::filesystem::path& name, Profile::Use use) {
    if (use == Profile::Use::wheel) return name == "s1002";
    return name == "60e1" || name == "uic60" || name == "54e1";
}

namespace detail {

inline void require_profile_file(const std::filesystem::path& name, const char* standards) {
    std::error_code error;
    if (std::filesystem::exists(name, error)) return;
    throw std::invalid_argument(name.string() + ": must be " + standards + " or a file that can be read");
}

inline void require_no_changes(const std::filesystem::path& name, const ProfileFileOptions& options) {
    if (!options.mirror_y && !options.mirror_z && !(options.smooth > 0)) return;
    throw std::invalid_argument(name.string() + ": a standard profile must be neither mirrored nor smoothed");
}

}  // namespace detail

/// The right wheel s1002, or a wheel from a file by read_profile, of any shape or checked. Throws
/// std::invalid_argument.
inline WheelFile open_wheel(const std::filesystem::path& name, const ProfileFileOptions& options = {},
                            bool any_shape = false) {
    if (is_standard_profile(name, Profile::Use::wheel)) {
        detail::require_no_changes(name, options);
        return {s1002(), {}};
    }
    detail::require_profile_file(name, "s1002");
    ProfileFile file = read_profile(name, any_shape ? Profile::Use::piece : Profile::Use::wheel, options);
    return {std::visit([](auto& curve) { return WheelSurface(std::move(curve)); }, file.curve), std::move(file.notes),
            std::move(file.doubts)};
}

/// The right rail 60e1, uic60 or 54e1, or a rail from a file by read_profile, of any shape or checked, canted; a roller
/// if it has a radius. Throws std::invalid_argument.
inline RailFile open_rail(const std::filesystem::path& name, const ProfileFileOptions& options = {},
                          const RailPlacing& placing = {}, bool any_shape = false) {
    const double cant = placing.cant.value_or(detail::usual_cant), radius = placing.roller_radius;
    detail::require_finite("open_rail", "cant", cant);
    detail::require_not_negative("open_rail", "roller_radius", radius);
    const auto surface = [&](Profile profile) {
        return radius > 0 ? RailSurface::roller(std::move(profile), radius) : RailSurface(std::move(profile));
    };
    if (is_standard_profile(name, Profile::Use::rail)) {
        detail::require_no_changes(name, options);
        const auto rail = name == "60e1" ? rail_60e1 : name == "54e1" ? rail_54e1 : rail_uic60;
        return {surface(placing.by_origin ? rail(0).moved(-cant, 0, 0) : rail(cant)), {}};
    }
    detail::require_profile_file(name, "60e1, uic60, 54e1");
    ProfileFile file = read_profile(name, any_shape ? Profile::Use::piece : Profile::Use::rail, options);
    if (!placing.cant) file.doubts.emplace_back("turned inwards by 1:40: --cant 0 if the profile is canted already");
    if (const auto* profile = std::get_if<Profile>(&file.curve)) {
        return {surface(profile->moved(-cant, 0, 0)), std::move(file.notes), std::move(file.doubts)};
    }
    detail::require(radius == 0, "open_rail", "roller_radius", radius, "be 0 for sections along the track");
    return {std::get<Sections>(file.curve).moved(-cant, 0, 0), std::move(file.notes), std::move(file.doubts)};
}

}  // namespace rollbem
