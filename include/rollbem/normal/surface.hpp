// Surfaces of rail and wheel: curves swept along the track, about a roller's axle or about the wheel's axle, constant
// or changing along the way. Each is given by its curves at constant x, with derivatives along them.
#pragma once

#include "../detail/decl.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "../scene/wheelset.hpp"
#include "profile.hpp"

namespace rollbem {

/// The surface y(s, u), z(s, u), in parts, each between two neighbouring features. Points at equal shares of a part's
/// length correspond; along u they are joined by cubics. A part is interrupted where a section lacks one of its
/// features.
///
/// \code
/// #include <rollbem/profiles.hpp>
///
/// int main() {
///     using namespace rollbem;
///     // a rail that sinks by 1 mm over 2 m
///     const Profile high = rail_60e1();
///     const Sections rail({{0, high}, {1, high.moved(0, 0, 0.5e-3)}, {2, high.moved(0, 0, 1e-3)}},
///                         Sections::Interpolation::through);
///     const WheelOnRail wheel(s1002(), rail, {.rail_origin = WheelOnRail::Dimensions::Origin{0.75, 0}});
///     WheelOnRail::Workspace workspace;
///     const auto height = [&](double x) { return wheel.solve_for_load({.along = x}, 80e3, workspace).height; };
///     const double sinks = height(1.5) - height(0.5);  // by 0.5 mm
///     return sinks > 0.49e-3 && sinks < 0.51e-3 ? 0 : 1;
/// }
/// \endcode
///
/// Invariant: at least 2 sections, u grows, and each part is there in at least two neighbouring sections.
class Sections {
public:
    /// A profile at one place of a surface that varies.
    struct Section {
        double u;         ///< along the track [m], or round the wheel [rad]
        Profile profile;  ///< right-hand, z down
        /// Lengths along the profile [m] where parts of the surface begin and end, growing and the same number in all
        /// sections. A length beyond the profile's end means the end, a negative one a feature that this section lacks.
        /// Without features the whole profile is one part.
        std::vector<double> features = {};
    };

    /// Interpolation between sections, of one of two kinds:
    ///
    /// - through: through the sections, with slopes in u from parabolas through three neighbouring sections (one-sided
    ///   at ends and interruptions);
    /// - spline: sections are the control points of a cubic B-spline with knots u, which has another section beyond
    ///   each end and interruption, by linear extrapolation.
    enum class Interpolation { through, spline };

    struct Point {
        double y, z;                       ///< [m]
        std::array<double, 2> by_s, by_u;  ///< derivatives of (y, z)
    };

    /// Throws std::invalid_argument if the sections break the invariant, naming the section by its number from 1.
    Sections(std::vector<Section> sections, Interpolation interpolation);

    std::size_t parts() const { return parts_.size(); }
    const std::vector<Section>& sections() const { return sections_; }
    Interpolation interpolation() const { return interpolation_; }
    double first() const { return sections_.front().u; }  ///< u of the first section
    double last() const { return sections_.back().u; }

    /// Mean length of a part over the sections that have it [m]; the parameter s runs from 0 to this length.
    double length(std::size_t part) const { return parts_[part].length; }

    /// Whether a part exists at u: u lies within the sections, and neither of both neighbouring sections lacks the
    /// part.
    bool covers(std::size_t part, double u) const noexcept {
        return u >= first() && u <= last() && intervals_with(part, u);
    }

    /// The point of a part at 0 <= s <= length(part); s runs at about unit speed. Where the part is not covered, the
    /// point at the nearest u where it is covered, and by_u = 0.
    Point at(std::size_t part, double s, double u) const noexcept;

    /// All parts one behind the other: s runs from 0 to length() through them.
    double length() const { return starts_.back(); }
    Point at(double s, double u) const noexcept {
        const std::size_t part = part_at(s);
        return at(part, s - starts_[part], u);
    }
    /// Whether the part that holds s is covered at u.
    bool reaches(double s, double u) const noexcept { return covers(part_at(s), u); }

    /// The surface with every section turned and moved by Profile::moved.
    Sections moved(double angle, double dy, double dz) const;

    double highest() const { return extreme(-1); }  ///< least z of all points of all sections [m]
    double lowest() const { return extreme(1); }    ///< largest z

private:
    struct Part {
        double length = 0;
        std::vector<double> from, lengths;  // s and length of the part in each section; a missing part has no length
        std::vector<std::size_t> nearest;   // nearest covered interval of each interval between sections
        // weights of the four sections around an interval (before it, at both ends, after it): cubics in its share t
        std::vector<std::array<std::array<double, 4>, 4>> weights;
    };

    std::size_t part_at(double s) const noexcept {
        return std::size_t(std::upper_bound(starts_.begin() + 1, starts_.end() - 1, s) - starts_.begin()) - 1;
    }

    void check(std::size_t k) const;

    void add_part(std::size_t number);

    static bool covers(const Part& part, std::size_t k) { return part.lengths[k] > 0 && part.lengths[k + 1] > 0; }

    // The interval [u_k, u_{k+1}) that contains u, or the first or last one.
    std::size_t interval(double u) const noexcept;

    bool intervals_with(std::size_t part, double u) const noexcept;

    // u of the section k - 1 + j of an interval k, or as far beyond the end of the part as the last step.
    double knot(const Part& part, std::size_t k, int j) const;

    std::array<std::array<double, 4>, 4> weights_of(const Part& part, std::size_t k) const;

    // Hermite's cubic with slopes by parabolas through three sections.
    std::array<std::array<double, 4>, 4> cubic(const Part& part, std::size_t k, bool before, bool after) const;

    // The basis functions of the interval, by de Boor's recursion on polynomials in t.
    std::array<std::array<double, 4>, 4> b_spline(const Part& part, std::size_t k) const;

    Point value(const Part& part, std::size_t k, double s, double t, double by_t) const noexcept;

    double extreme(double sign) const;

    std::vector<Section> sections_;
    Interpolation interpolation_;
    std::vector<Part> parts_;
    std::vector<double> starts_{0};  // s at which parts begin, and at which the last one ends
};

/// A rail, in axes of its own: x along the track, y to the right, z down. Straight: (x, y(s), z(s)). Roller: a disc of
/// radius R about an axle along y at z = R, ((R - z) sin f, y, R - (R - z) cos f). Sections: curves that change along
/// the track. Its curves at constant x have a parameter 0 <= s <= length() of about unit speed.
///
/// \code
/// #include <rollbem/profiles.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const RailSurface roller = RailSurface::roller(rail_60e1(0), 0.5);
///     const WheelOnRail wheel(s1002(), roller, {.rail_origin = WheelOnRail::Dimensions::Origin{0.75, 0}});
///     WheelOnRail::Workspace workspace;
///     return has_numbers(wheel.solve_for_load({}, 80e3, workspace).status) ? 0 : 1;
/// }
/// \endcode
class RailSurface {
public:
    /// A point (y, z) [m] of a surface's curve at constant x, and its derivative by the length parameter of the curve.
    struct Point {
        double y, z;
        std::array<double, 2> slope;
        bool defined;  ///< false where the surface has no such point
    };

    RailSurface(Profile profile) : curve_(std::move(profile)) {}     // NOLINT: implicit on purpose
    RailSurface(Sections sections) : curve_(std::move(sections)) {}  // NOLINT: the same

    /// Throws std::invalid_argument unless the radius [m] is positive and finite.
    static RailSurface roller(Profile profile, double radius);

    bool is_straight() const { return radius_ == 0 && !has_sections(); }
    bool has_sections() const { return std::holds_alternative<Sections>(curve_); }
    double roller_radius() const { return radius_; }  ///< [m]; 0 if the rail is no roller
    /// The profile of a straight rail or a roller.
    const Profile& profile() const { return std::get<Profile>(curve_); }

    double length() const { return has_sections() ? std::get<Sections>(curve_).length() : profile().length(); }

    /// The point s of the curve at x [m]; where a section is missing there is none.
    Point at(double s, double x) const noexcept;

    /// Largest sin f at which a roller is searched.
    static constexpr double steepest = 0.5;

private:
    std::variant<Profile, Sections> curve_;
    double radius_ = 0;
};

/// A wheel: a curve turned about the axle, at the distance r0 + z(s) and the place y(s); or curves that change with the
/// angle from the lowest point towards +x, less the pitch, with a period of one turn.
class WheelSurface {
public:
    struct Point {
        double y, z;
        std::array<double, 2> by_s, by_angle;
    };

    WheelSurface(Profile profile) : curve_(std::move(profile)) {}     // NOLINT: implicit on purpose
    WheelSurface(Sections sections) : curve_(std::move(sections)) {}  // NOLINT: the same

    bool is_round() const { return std::holds_alternative<Profile>(curve_); }
    /// The profile of a round wheel.
    const Profile& profile() const { return std::get<Profile>(curve_); }

    double length() const { return is_round() ? profile().length() : std::get<Sections>(curve_).length(); }

    Point at(double s, double angle) const noexcept;

    /// A wheel in its place on the track, with the wheelset at height 0: curves at constant x, and the silhouette of a
    /// round wheel against a straight rail, where its normal has no component along x.
    class Placed {
    public:
        /// `origin` [m]: of the profile from the middle of the axle; `radius`: r0 [m].
        Placed(const WheelSurface& surface, double origin, double radius, const WheelsetPosition& at)
            : surface_(&surface),
              origin_(origin),
              radius_(radius),
              lateral_(at.lateral),
              pitch_(at.pitch),
              sin_roll_(std::sin(at.roll)),
              cos_roll_(std::cos(at.roll)),
              sin_yaw_(std::sin(at.yaw)),
              cos_yaw_(std::cos(at.yaw)) {}

        /// Largest sin theta at which the wheel is searched.
        static constexpr double steepest = 0.5;

        struct Place {
            double x, y, z;
            bool defined;
        };

        const WheelSurface& surface() const { return *surface_; }
        double radius() const { return radius_; }
        double middle_x() const { return -sin_yaw_ * origin_; }  ///< x of the tape circle's lowest point [m]
        /// Distance along x from middle_x() within which contacts are searched [m]: flanks of 4 in 1 touch ahead
        /// because of the yaw.
        double reach_x() const { return 0.1 + radius_ * (std::min)(4 * std::abs(sin_yaw_), steepest); }

        /// A place on the silhouette of a round wheel.
        Place silhouette(double s) const;

        /// The point s of the curve at x [m], on the wheel's surface before it is placed; nothing where there is none.
        std::optional<WheelSurface::Point> unplaced(double s, double x) const;
        /// The point s of the curve at x [m] in track axes, the wheelset at height 0.
        RailSurface::Point section(double s, double x) const;

    private:
        double sine_of(const WheelSurface::Point& p, double x) const {
            return (x + sin_yaw_ * (origin_ + p.y)) / (cos_yaw_ * (radius_ + p.z));
        }
        Place place(double y, double z, double sine) const;
        RailSurface::Point section_of(const WheelSurface::Point& p, double x) const;

        const WheelSurface* surface_;
        double origin_, radius_, lateral_, pitch_, sin_roll_, cos_roll_, sin_yaw_, cos_yaw_;
    };

private:
    std::variant<Profile, Sections> curve_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/surface.ipp"
#endif
