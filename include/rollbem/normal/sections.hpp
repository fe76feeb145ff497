// Sections: a surface between profiles that stand one behind the other along the track, or round the wheel.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
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
    Sections(std::vector<Section> sections, Interpolation interpolation)
        : sections_(std::move(sections)), interpolation_(interpolation) {
        detail::require(sections_.size() >= 2, "Sections", "number of sections", sections_.size(), "be at least 2");
        for (std::size_t k = 0; k < sections_.size(); ++k) check(k);
        const std::size_t features = sections_[0].features.size();
        for (std::size_t part = 0; part < (std::max<std::size_t>)(features, 2) - 1; ++part) add_part(part);
    }

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
    Point at(std::size_t part, double s, double u) const noexcept {
        const Part& of = parts_[part];
        const std::size_t k = of.nearest[interval(u)];
        const double step = sections_[k + 1].u - sections_[k].u, t = (u - sections_[k].u) / step;
        return value(of, k, s, (std::min)((std::max)(t, 0.0), 1.0), t >= 0 && t <= 1 ? 1 / step : 0);
    }

    /// All parts one behind the other: s runs from 0 to length() through them.
    double length() const { return starts_.back(); }
    Point at(double s, double u) const noexcept {
        const std::size_t part = part_at(s);
        return at(part, s - starts_[part], u);
    }
    /// Whether the part that holds s is covered at u.
    bool reaches(double s, double u) const noexcept { return covers(part_at(s), u); }

    /// The surface with every section turned and moved by Profile::moved.
    Sections moved(double angle, double dy, double dz) const {
        Sections result = *this;
        for (Section& section : result.sections_) section.profile = section.profile.moved(angle, dy, dz);
        return result;
    }

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

    void check(std::size_t k) const {
        const Section& section = sections_[k];
        const std::string of = " of section " + std::to_string(k + 1);
        const auto named = [&](const char* quantity) { return quantity + of; };
        detail::require_finite("Sections", named("u").c_str(), section.u);
        detail::require(k == 0 || section.u > sections_[k - 1].u, "Sections", named("u").c_str(), section.u,
                        "be greater than u of the section before");
        const std::vector<double>& features = section.features;
        detail::require(features.size() == sections_[0].features.size(), "Sections",
                        named("number of features").c_str(), features.size(),
                        "equal the number of features of section 1");
        detail::require(features.size() != 1, "Sections", named("number of features").c_str(), 1,
                        "be 0 or at least 2, for a part lies between two");
        double before = -1;
        for (const double feature : features) {
            detail::require_finite("Sections", named("length of a feature").c_str(), feature);
            if (feature < 0) continue;
            detail::require(feature > before && before < section.profile.length(), "Sections",
                            named("length of a feature").c_str(), feature,
                            "be greater than the length of the feature before, which must lie on the profile");
            before = feature;
        }
    }

    void add_part(std::size_t number) {
        const std::size_t n = sections_.size();
        Part part;
        double sum = 0;
        std::size_t count = 0;
        for (const Section& section : sections_) {
            const bool whole = section.features.empty();
            const double end = section.profile.length(), from = whole ? 0 : section.features[number],
                         to = whole ? end : (std::min)(section.features[number + 1], end);
            const bool there = from >= 0 && to > from;
            part.from.push_back(from);
            part.lengths.push_back(there ? to - from : 0);
            sum += part.lengths.back();
            if (there) ++count;
        }
        std::vector<std::size_t> covered;
        for (std::size_t k = 0; k + 1 < n; ++k) {
            part.weights.push_back(covers(part, k) ? weights_of(part, k) : decltype(part.weights)::value_type{});
            if (covers(part, k)) covered.push_back(k);
        }
        detail::require(!covered.empty(), "Sections", "number of the part", number + 1,
                        "be the number of a part that is there in two neighbouring sections");
        for (std::size_t k = 0; k + 1 < n; ++k) {
            const auto after = std::lower_bound(covered.begin(), covered.end(), k);
            const bool forward = after != covered.end() && (after == covered.begin() || *after - k < k - *(after - 1));
            part.nearest.push_back(forward ? *after : *(after - 1));
        }
        part.length = sum / static_cast<double>(count);
        starts_.push_back(starts_.back() + part.length);
        parts_.push_back(std::move(part));
    }

    static bool covers(const Part& part, std::size_t k) { return part.lengths[k] > 0 && part.lengths[k + 1] > 0; }

    // The interval [u_k, u_{k+1}) that contains u, or the first or last one.
    std::size_t interval(double u) const noexcept {
        const auto after = std::upper_bound(sections_.begin() + 1, sections_.end() - 1, u,
                                            [](double at, const Section& section) { return at < section.u; });
        return static_cast<std::size_t>(after - sections_.begin()) - 1;
    }

    bool intervals_with(std::size_t part, double u) const noexcept {
        const std::size_t k = interval(u);
        const auto there = [&](std::size_t i) { return parts_[part].nearest[i] == i; };
        return there(k) || (k > 0 && u == sections_[k].u && there(k - 1));
    }

    // u of the section k - 1 + j of an interval k, or as far beyond the end of the part as the last step.
    double knot(const Part& part, std::size_t k, int j) const {
        const auto u = [&](std::size_t i) { return sections_[i].u; };
        std::size_t first = k, last = k + 1;
        while (first > 0 && covers(part, first - 1)) --first;
        while (last + 1 < sections_.size() && covers(part, last)) ++last;
        const long i = static_cast<long>(k) - 1 + j, low = static_cast<long>(first), high = static_cast<long>(last);
        if (i < low) return u(first) - static_cast<double>(low - i) * (u(first + 1) - u(first));
        if (i > high) return u(last) + static_cast<double>(i - high) * (u(last) - u(last - 1));
        return u(static_cast<std::size_t>(i));
    }

    std::array<std::array<double, 4>, 4> weights_of(const Part& part, std::size_t k) const {
        const bool before = k > 0 && covers(part, k - 1), after = k + 2 < sections_.size() && covers(part, k + 1);
        std::array<std::array<double, 4>, 4> w =
            interpolation_ == Interpolation::through ? cubic(part, k, before, after) : b_spline(part, k);
        for (std::size_t m = 0; m < 4 && interpolation_ == Interpolation::spline; ++m) {
            // a section beyond the end is 2 P_0 - P_1
            for (const auto& [beyond, at, next] : {std::array<std::size_t, 3>{0, 1, 2}, {3, 2, 1}}) {
                if (beyond == 0 ? before : after) continue;
                w[at][m] += 2 * w[beyond][m];
                w[next][m] -= w[beyond][m];
                w[beyond][m] = 0;
            }
        }
        return w;
    }

    // Hermite's cubic with slopes by parabolas through three sections.
    std::array<std::array<double, 4>, 4> cubic(const Part& part, std::size_t k, bool before, bool after) const {
        const double h = knot(part, k, 2) - knot(part, k, 1);
        std::array<std::array<double, 4>, 4> w{};
        w[1] = {1, 0, -3, 2};
        w[2] = {0, 0, 3, -2};
        // h times the slope at section i of the three sections j, j + 1, j + 2
        const auto add_slope = [&](std::size_t i, std::size_t j, std::array<double, 4> by) {
            std::array<double, 3> u;
            for (std::size_t l = 0; l < 3; ++l) u[l] = knot(part, k, static_cast<int>(j + l));
            const double at = knot(part, k, static_cast<int>(i));
            for (std::size_t l = 0; l < 3; ++l) {
                const double a = u[(l + 1) % 3], b = u[(l + 2) % 3];
                const double slope = h * (2 * at - a - b) / ((u[l] - a) * (u[l] - b));
                for (std::size_t m = 0; m < 4; ++m) w[j + l][m] += slope * by[m];
            }
        };
        const std::array<double, 4> at_first{0, 1, -2, 1}, at_last{0, 0, -1, 1};
        if (!before && !after) {
            w[1] = {1, -1, 0, 0};
            w[2] = {0, 1, 0, 0};
            return w;
        }
        add_slope(1, before ? 0 : 1, at_first);
        add_slope(2, after ? 1 : 0, at_last);
        return w;
    }

    // The basis functions of the interval, by de Boor's recursion on polynomials in t.
    std::array<std::array<double, 4>, 4> b_spline(const Part& part, std::size_t k) const {
        std::array<double, 6> u;  // the knots -2 .. 3 counted from the interval's first
        for (int j = 0; j < 6; ++j) u[static_cast<std::size_t>(j)] = knot(part, k, j - 1);
        const double h = u[3] - u[2];
        std::array<std::array<double, 4>, 4> w{};
        w[3][0] = 1;
        for (std::size_t degree = 1; degree <= 3; ++degree) {
            std::array<std::array<double, 4>, 4> next{};
            for (std::size_t j = 3 - degree; j < 4; ++j) {
                // N_j of the knots u[j - 1 ...]: the rising share of its own first knot, and the falling share of the
                // next
                const auto add = [&](std::size_t from, double constant, double slope) {
                    for (std::size_t m = 0; m < 4; ++m) {
                        next[j][m] += constant * w[from][m];
                        if (m > 0) next[j][m] += slope * w[from][m - 1];
                    }
                };
                const auto left = [&](std::size_t i) { return u[i - 1]; };
                if (j >= 4 - degree) {
                    const double a = left(j), span = left(j + degree) - a;
                    add(j, (u[2] - a) / span, h / span);
                }
                if (j < 3) {
                    const double b = left(j + degree + 1), span = b - left(j + 1);
                    add(j + 1, (b - u[2]) / span, -h / span);
                }
            }
            w = next;
        }
        return w;
    }

    Point value(const Part& part, std::size_t k, double s, double t, double by_t) const noexcept {
        Point point{};
        const double share = s / part.length;
        for (std::size_t j = 0; j < 4; ++j) {
            if (k + j < 1 || k + j > sections_.size()) continue;
            const std::size_t i = k + j - 1;
            const auto& w = part.weights[k][j];
            if (w == std::array<double, 4>{}) continue;
            const double weight = w[0] + t * (w[1] + t * (w[2] + t * w[3])),
                         slope = by_t * (w[1] + t * (2 * w[2] + t * 3 * w[3])), speed = part.lengths[i] / part.length;
            const Profile::Point at = sections_[i].profile.at(part.from[i] + share * part.lengths[i]);
            point.y += weight * at.y;
            point.z += weight * at.z;
            point.by_s[0] += weight * speed * at.slope[0];
            point.by_s[1] += weight * speed * at.slope[1];
            point.by_u[0] += slope * at.y;
            point.by_u[1] += slope * at.z;
        }
        return point;
    }

    double extreme(double sign) const {
        double most = -std::numeric_limits<double>::infinity();
        for (const Section& section : sections_) most = (std::max)(most, (sign * section.profile.z()).maxCoeff());
        return sign * most;
    }

    std::vector<Section> sections_;
    Interpolation interpolation_;
    std::vector<Part> parts_;
    std::vector<double> starts_{0};  // s at which parts begin, and at which the last one ends
};

}  // namespace rollbem
