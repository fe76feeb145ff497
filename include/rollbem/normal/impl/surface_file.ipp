// Bodies of normal/surface_file.hpp. Internal.
#pragma once

#include "../surface_file.hpp"

#include <stdexcept>
#include <system_error>
#include <utility>
#include <variant>

#include "../../detail/require.hpp"

namespace rollbem {

ROLLBEM_DECL bool is_standard_profile(const std::filesystem::path& name, Profile::Use use) {
    if (use == Profile::Use::wheel) return name == "s1002";
    return name == "60e1" || name == "uic60" || name == "54e1";
}

}  // namespace rollbem

namespace rollbem::detail {

inline void require_profile_file(const std::filesystem::path& name, const char* standards) {
    std::error_code error;
    if (std::filesystem::exists(name, error)) return;
    throw std::invalid_argument(name.string() + ": must be " + standards + " or a file that can be read");
}

inline void require_no_changes(const std::filesystem::path& name, const ProfileFileOptions& options) {
    if (!options.mirror_y && !options.mirror_z && !(options.smooth > 0)) return;
    throw std::invalid_argument(name.string() + ": a standard profile must be neither mirrored nor smoothed");
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL WheelFile open_wheel(const std::filesystem::path& name, const ProfileFileOptions& options,
                                  bool any_shape) {
    if (is_standard_profile(name, Profile::Use::wheel)) {
        detail::require_no_changes(name, options);
        return {s1002(), {}};
    }
    detail::require_profile_file(name, "s1002");
    ProfileFile file = read_profile(name, any_shape ? Profile::Use::piece : Profile::Use::wheel, options);
    return {std::visit([](auto& curve) { return WheelSurface(std::move(curve)); }, file.curve), std::move(file.notes)};
}

ROLLBEM_DECL RailFile open_rail(const std::filesystem::path& name, const ProfileFileOptions& options,
                                const RailPlacing& placing, bool any_shape) {
    const double cant = placing.cant, radius = placing.roller_radius;
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
    if (const auto* profile = std::get_if<Profile>(&file.curve)) {
        return {surface(profile->moved(-cant, 0, 0)), std::move(file.notes)};
    }
    detail::require(radius == 0, "open_rail", "roller_radius", radius, "be 0 for sections along the track");
    return {std::get<Sections>(file.curve).moved(-cant, 0, 0), std::move(file.notes)};
}

}  // namespace rollbem
