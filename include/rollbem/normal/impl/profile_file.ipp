// Bodies of normal/profile_file.hpp. Internal.
#pragma once

#include "../profile_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

#include <Eigen/Core>

#include "../../detail/require.hpp"
#include "../detail/polyline.hpp"
#include "../detail/profile_cleaning.hpp"
#include "../detail/profile_direction.hpp"
#include "../detail/profile_text.hpp"
#include "../detail/sections_text.hpp"

namespace rollbem::detail {

/// Reads one profile file, no sections.
class ProfileReader {
public:
    ProfileReader(const std::filesystem::path& path, Profile::Use use, const ProfileFileOptions& options,
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
        const double other = options_.per_metre == 1 ? length / 1000 : length * 1000;
        if (columns && other >= 5e-3 && other <= 0.5) {
            text += options_.per_metre == 1 ? ": these look like millimetres: --length-unit mm (per_metre = 1000)"
                                            : ": these look like metres: --length-unit m (per_metre = 1)";
        }
        file_.refuse(text);
    }

    TextFile file_;
    Profile::Use use_;
    const ProfileFileOptions& options_;
    std::vector<std::string>& notes_;
    bool turned_ = false, reversed_ = false;
};

/// Sections and their profiles.
inline Sections read_sections(const std::filesystem::path& path, Profile::Use use, const ProfileFileOptions& options,
                              std::vector<std::string>& notes) {
    const TextFile file(path);
    const bool along = lower_case(path.extension().string()) == ".slcs";
    if (use == (along ? Profile::Use::wheel : Profile::Use::rail)) {
        file.refuse(along ? "sections along the track are of a rail" : "sections round the wheel are of a wheel");
    }
    const SectionsText text = SectionsReader::read(file, along ? 1000 : 1);
    std::vector<Section> sections;
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
                                      const ProfileFileOptions& options) {
    detail::require_positive("read_profile", "per_metre", options.per_metre);
    detail::require_not_negative("read_profile", "smooth", options.smooth);
    detail::require_finite("read_profile", "tape_offset", options.tape_offset);
    const std::string ending = detail::lower_case(path.extension().string());
    std::vector<std::string> notes;
    if (ending == ".slcs" || ending == ".slcw") {
        Sections sections = detail::read_sections(path, use, options, notes);
        return {std::move(sections), std::move(notes)};
    }
    Profile profile = detail::ProfileReader(path, use, options, notes).read();
    try {
        if (use == Profile::Use::wheel) require_wheel(profile, options.tape_offset);
        if (use == Profile::Use::rail) require_rail(profile);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(path.string() + ": " + error.what());
    }
    return {std::move(profile), std::move(notes)};
}

}  // namespace rollbem
