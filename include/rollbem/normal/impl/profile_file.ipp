// Bodies of normal/profile_file.hpp. Internal.
#pragma once

#include "../profile_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <variant>

#include <Eigen/Core>

#include "../../detail/require.hpp"
#include "../detail/polyline.hpp"
#include "../detail/profile_cleaning.hpp"
#include "../detail/profile_direction.hpp"
#include "../detail/profile_doubts.hpp"
#include "../detail/profile_text.hpp"
#include "../detail/sections_text.hpp"

namespace rollbem::detail {

/// The fault of a profile as a wheel, with its quantity and value; "" if there is none. `tape` is y of the tape circle,
/// 70 mm from the flange's back.
inline std::string fault_of_wheel(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z, double tape) {
    const auto text = [](const char* quantity, double value, const char* rule) {
        return std::string(quantity) + " = " + to_text(std::round(1e6 * value) / 1e6) + " m must " + rule;
    };
    const double width = y.maxCoeff() - y.minCoeff();
    if (width < 0.09 || width > 0.18) return text("width of the wheel", width, "lie in 0.09 to 0.18 m");
    if (flange_points_up(y, z)) return text("z of the flange", z.minCoeff(), "be positive");
    Eigen::Index crown = 0;
    z.maxCoeff(&crown);
    if (z[crown] < 10e-3) return text("z of the flange's crown (largest z)", z[crown], "be at least 0.01 m");
    if (y[crown] < tape - 65e-3 || y[crown] > tape - 25e-3) {
        return text("y of the flange's crown (largest z)", y[crown],
                    ("lie in " + to_text(tape - 65e-3) + " to " + to_text(tape - 25e-3) + " m").c_str());
    }
    // the height where the curve passes the tape circle, nearest to z = 0
    std::optional<double> height;
    for (Eigen::Index i = 1; i < y.size(); ++i) {
        const double from = y[i - 1] - tape, to = y[i] - tape;
        if (from * to > 0 || from == to) continue;
        const double here = z[i - 1] + (z[i] - z[i - 1]) * from / (from - to);
        if (!height || std::abs(here) < std::abs(*height)) height = here;
    }
    if (!height) return text("y of the tape circle", tape, "lie on the wheel");
    if (!(*height > -6e-3 && *height < 2e-3)) {  // worn treads are hollow
        return text("z on the tape circle", *height, "lie above -0.006 m and below 0.002 m");
    }
    return "";
}

/// The fault of a profile as a rail; "" if there is none.
inline std::string fault_of_rail(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z) {
    const auto text = [](const char* quantity, double value, const char* rule) {
        return std::string(quantity) + " = " + to_text(std::round(1e6 * value) / 1e6) + " m must " + rule;
    };
    const double width = y.maxCoeff() - y.minCoeff();
    if (width < 0.03 || width > 0.2) return text("width of the rail", width, "lie in 0.03 to 0.2 m");
    Eigen::Index top = 0;
    const double least = z.minCoeff(&top);
    if (std::abs(least) > 10e-3) return text("z of the rail's top (least z)", least, "lie within 0.01 m of 0");
    if (top == 0 || top == z.size() - 1 || sides_point_up(y, z)) {
        return text("y of the rail's top (least z)", y[top], "lie between its sides");
    }
    return "";
}

/// The remedy where other units would make a length [m] right, or ""; with `per_metre` of the file that was read only
/// units taken for that one. Units that an option names come first.
inline std::string look_of_unit(double length, double least, double most, std::optional<double> per_metre = {}) {
    struct Mistake {
        double factor, per_metre;
        const char *unit, *remedy;
    };
    constexpr const char* convert = "convert the file";
    std::string units, remedy;
    for (const Mistake& one : {Mistake{1e3, 1e3, "metres", "--length-unit m (per_metre = 1)"},
                               Mistake{1e-3, 1, "millimetres", "--length-unit mm (per_metre = 1000)"},
                               Mistake{25.4, 1e3, "inches", convert}, Mistake{10, 1e3, "centimetres", convert},
                               Mistake{1e-3, 1e3, "micrometres", convert}, Mistake{0.0254, 1, "inches", convert},
                               Mistake{0.01, 1, "centimetres", convert}, Mistake{1e-6, 1, "micrometres", convert}}) {
        const double meant = length * one.factor;
        if (per_metre.value_or(one.per_metre) != one.per_metre || meant < least || meant > most) continue;
        if (!units.empty() && one.remedy != remedy) break;
        units += (units.empty() ? "" : " or ") + std::string(one.unit);
        per_metre = one.per_metre;
        remedy = one.remedy;
    }
    if (units.empty()) return "";
    return "these look like " + units + " read as " + (*per_metre == 1 ? "metres: " : "millimetres: ") + remedy;
}

/// The presumed cause, and the options that correct it.
inline std::string wheel_remedy(bool mirror_y, bool mirror_z, std::optional<double> offset) {
    std::string seems, options;
    const auto add = [&](const char* what, const std::string& option) {
        seems += (seems.empty() ? "" : ", and ") + std::string(what);
        options += ' ' + option;
    };
    if (offset) {
        add(*offset == 0 ? "y seems to begin at the flange's back" : "y seems to begin at the tape circle",
            "--tape-offset " + to_text(*offset));
    }
    if (mirror_z) add("z seems to point up", mirror_y ? "--wheel-mirror yz" : "--wheel-mirror z");
    if (mirror_y) add("this seems to be a left wheel", mirror_z ? "" : "--wheel-mirror y");
    while (options.back() == ' ') options.pop_back();
    return seems + ":" + options;
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL void require_wheel(const Profile& wheel, double tape_offset) {
    if (wheel.is_piece()) return;
    const Eigen::ArrayXd &y = wheel.y(), &z = wheel.z();
    const std::string fault = detail::fault_of_wheel(y, z, 0.07 - tape_offset);
    if (fault.empty()) return;
    std::string remedy = detail::look_of_unit(y.maxCoeff() - y.minCoeff(), 0.09, 0.18);
    for (const double offset : {tape_offset, 0.0, 0.07}) {
        for (const bool mirror_z : {false, true}) {
            for (const bool mirror_y : {false, true}) {
                const double sign_y = mirror_y ? -1 : 1, sign_z = mirror_z ? -1 : 1;
                if (!remedy.empty() || !detail::fault_of_wheel(sign_y * y, sign_z * z, 0.07 - offset).empty()) continue;
                remedy = detail::wheel_remedy(mirror_y, mirror_z,
                                              offset == tape_offset ? std::nullopt : std::optional(offset));
            }
        }
    }
    if (remedy.empty()) remedy = "move or cut its points";
    throw std::invalid_argument("wheel: " + fault + ": " + remedy +
                                ", or --any-shape (Profile::Use::piece) for a piece");
}

ROLLBEM_DECL void require_rail(const Profile& rail) {
    if (rail.is_piece()) return;
    const std::string fault = detail::fault_of_rail(rail.y(), rail.z());
    if (fault.empty()) return;
    std::string remedy = detail::look_of_unit(rail.y().maxCoeff() - rail.y().minCoeff(), 0.03, 0.2);
    if (remedy.empty() && detail::fault_of_rail(rail.y(), -rail.z()).empty()) {
        remedy = "z seems to point up: --rail-mirror z";
    }
    if (remedy.empty()) remedy = "move or cut its points";
    throw std::invalid_argument("rail: " + fault + ": " + remedy +
                                ", or --any-shape (Profile::Use::piece) for a piece");
}

}  // namespace rollbem

namespace rollbem::detail {

/// Reads one profile file, no sections.
class ProfileReader {
public:
    ProfileReader(const std::filesystem::path& path, Profile::Use use, const ProfileFile::Options& options,
                  std::vector<std::string>& notes)
        : file_(path), use_(use), options_(options), notes_(notes) {}

    Profile read() {
        const std::string ending = lower_case(file_.path().extension().string());
        const bool rail = ending == ".ban", miniprof = rail || ending == ".whl";
        const bool simpack = ending == ".prr" || ending == ".prw";
        CurvePoints points = simpack    ? read_simpack(file_)
                             : miniprof ? read_miniprof(file_)
                                        : read_columns(file_, options_.per_metre);
        ProfileCleaning clean(file_, notes_);
        points = clean(points);
        require_length(points, !simpack && !miniprof);
        clean.require_curve(points, options_.smooth / 2);
        Eigen::ArrayXd y = array(points.y), z = array(points.z);
        turned_ = miniprof && !options_.mirror_z && (rail ? sides_point_up(y, z) : flange_points_up(y, z));
        if (turned_)
            notes_.push_back(rail ? "z turned: the file's sides point up" : "z turned: the file's flange points up");
        if (options_.mirror_y) notes_.push_back("y mirrored");
        if (options_.mirror_z) notes_.push_back("z mirrored");
        if (options_.mirror_y) y *= -1;
        if (options_.mirror_z || turned_) z *= -1;
        reversed_ = y[y.size() - 1] < y[0];
        if (options_.smooth > 0) smooth(y, z);
        for (std::size_t i = 0; i < points.size(); ++i) {
            points.y[i] = y[Eigen::Index(i)];
            points.z[i] = z[Eigen::Index(i)];
        }
        clean.require_simple(points);
        try {
            return {y, z, use_};
        } catch (const std::invalid_argument& error) {
            file_.refuse(error.what());
        }
    }

    bool turned() const { return turned_; }      ///< whether z was turned because the shape demands it
    bool reversed() const { return reversed_; }  ///< whether the profile's first point is the file's last

private:
    static Eigen::ArrayXd array(const std::vector<double>& values) {
        return Eigen::Map<const Eigen::ArrayXd>(values.data(), Eigen::Index(values.size()));
    }

    void smooth(Eigen::ArrayXd& y, Eigen::ArrayXd& z) {
        const Eigen::ArrayXd s = lengths_along(y, z);
        const std::array<Eigen::ArrayXd, 2> smooth =
            smooth_curve(s, corners_of(s, turns_at(y, z)), {y, z}, options_.smooth);
        const double farthest = ((smooth[0] - y).square() + (smooth[1] - z).square()).maxCoeff();
        notes_.push_back("smoothed over waves of " + in_mm(options_.smooth) + ": points moved by at most " +
                         in_mm(std::sqrt(farthest)));
        y = smooth[0];
        z = smooth[1];
    }

    void require_length(const CurvePoints& points, bool columns) const {
        double length = 0;
        for (std::size_t i = 1; i < points.size(); ++i) {
            length += std::hypot(points.y[i] - points.y[i - 1], points.z[i] - points.z[i - 1]);
        }
        if ((length >= 5e-3 && length <= 0.5) || points.size() < 2) return;
        std::string text = "length along the profile = " + in_mm(length) + " must lie in 5 to 500 mm";
        const std::string look = columns ? look_of_unit(length, 15e-3, 0.5, options_.per_metre) : "";
        if (!look.empty()) text += ": " + look;
        file_.refuse(text);
    }

    TextFile file_;
    Profile::Use use_;
    const ProfileFile::Options& options_;
    std::vector<std::string>& notes_;
    bool turned_ = false, reversed_ = false;
};

/// Sections and their profiles.
inline Sections read_sections(const std::filesystem::path& path, Profile::Use use, const ProfileFile::Options& options,
                              std::vector<std::string>& notes) {
    const TextFile file(path);
    const bool along = lower_case(path.extension().string()) == ".slcs";
    if (use == (along ? Profile::Use::wheel : Profile::Use::rail)) {
        file.refuse(along ? "sections along the track are of a rail" : "sections round the wheel are of a wheel");
    }
    const SectionsText text = SectionsReader::read(file, along ? 1000 : 1);
    std::vector<Sections::Section> sections;
    std::optional<bool> turned;
    for (const SectionLine& line : text.sections) {
        const std::string ending = lower_case(line.profile.extension().string());
        if (ending == ".slcs" || ending == ".slcw") file.refuse(line.line, "a file with one profile is expected");
        std::vector<std::string> of_section;
        ProfileReader reader(line.profile, Profile::Use::piece, options, of_section);
        Profile profile = reader.read();
        for (const std::string& note : of_section) notes.push_back(line.profile.filename().string() + ": " + note);
        if (turned.value_or(reader.turned()) != reader.turned()) {
            file.refuse(line.line, "sections with z in one direction are expected: " +
                                       std::string("mirror z where their shape says too little"));
        }
        turned = reader.turned();
        std::vector<double> features = line.features;
        if (!along && reader.reversed()) {  // lengths begin at the file's first point
            const double length = profile.length();
            for (double& s : features) s = s < 0 ? s : length - (std::min)(s, length);
            std::reverse(features.begin(), features.end());
        }
        sections.push_back({line.u, std::move(profile), std::move(features)});
    }
    try {
        return {std::move(sections), text.interpolation};
    } catch (const std::invalid_argument& error) {
        file.refuse(error.what());
    }
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL ProfileFile read_profile(const std::filesystem::path& path, Profile::Use use,
                                      const ProfileFile::Options& options) {
    detail::require_positive("read_profile", "per_metre", options.per_metre);
    detail::require_not_negative("read_profile", "smooth", options.smooth);
    detail::require_finite("read_profile", "tape_offset", options.tape_offset);
    const std::string ending = detail::lower_case(path.extension().string());
    std::vector<std::string> notes;
    if (ending == ".slcs" || ending == ".slcw") {
        Sections sections = detail::read_sections(path, use, options, notes);
        std::vector<std::string> doubts;
        for (std::size_t k = 0; k < sections.sections().size() && doubts.empty(); ++k) {
            const Profile& profile = sections.sections()[k].profile;
            const std::string doubt = detail::doubt_of_roughness(profile.y(), profile.z());
            if (!doubt.empty()) doubts.push_back("section " + std::to_string(k + 1) + ": " + doubt);
        }
        return {std::move(sections), std::move(notes), std::move(doubts)};
    }
    Profile profile = detail::ProfileReader(path, use, options, notes).read();
    try {
        if (use == Profile::Use::wheel) require_wheel(profile, options.tape_offset);
        if (use == Profile::Use::rail) require_rail(profile);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(path.string() + ": " + error.what());
    }
    std::vector<std::string> doubts;
    const auto add = [&](std::string doubt) {
        if (!doubt.empty()) doubts.push_back(std::move(doubt));
    };
    if (use == Profile::Use::wheel) {
        add(detail::doubt_of_flange_back(profile.y(), profile.z(), options.tape_offset));
    }
    add(detail::doubt_of_roughness(profile.y(), profile.z()));
    return {std::move(profile), std::move(notes), std::move(doubts)};
}

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

inline void require_no_changes(const std::filesystem::path& name, const ProfileFile::Options& options) {
    if (!options.mirror_y && !options.mirror_z && !(options.smooth > 0)) return;
    throw std::invalid_argument(name.string() + ": a standard profile must be neither mirrored nor smoothed");
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL ProfileFile::Wheel open_wheel(const std::filesystem::path& name, const ProfileFile::Options& options,
                                           bool any_shape) {
    if (is_standard_profile(name, Profile::Use::wheel)) {
        detail::require_no_changes(name, options);
        return {s1002(), {}};
    }
    detail::require_profile_file(name, "s1002");
    ProfileFile file = read_profile(name, any_shape ? Profile::Use::piece : Profile::Use::wheel, options);
    return {std::visit([](auto& curve) { return WheelSurface(std::move(curve)); }, file.curve), std::move(file.notes),
            std::move(file.doubts)};
}

ROLLBEM_DECL ProfileFile::Rail open_rail(const std::filesystem::path& name, const ProfileFile::Options& options,
                                         const ProfileFile::Placing& placing, bool any_shape) {
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
