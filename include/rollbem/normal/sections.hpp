// Sections: a surface between profiles that stand one behind the other along the track, or round the wheel.
#pragma once

#include "../detail/decl.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "profile.hpp"

namespace rollbem {

/// A profile at one place of a surface that varies.
struct Section {
    double u;         ///< along the track [m], or round the wheel [rad]
    Profile profile;  ///< right-hand, z down
    /// Lengths along the profile [m] where parts of the surface begin and end, growing and the same number in all
    /// sections. A length beyond the profile's end means the end, a negative one a feature that this section lacks.
    /// Without features the whole profile is one part.
    std::vector<double> features = {};
};

/// The surface y(s, u), z(s, u), in parts, each between two neighbouring features. Points at equal shares of a part's
/// length correspond; along u they are joined by cubics. A part is interrupted where a section lacks one of its
/// features.
///
/// Invariant: at least 2 sections, u grows, and each part is there in at least two neighbouring sections.
class Sections {
public:
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

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/sections.ipp"
#endif
