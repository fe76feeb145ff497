// Cleaning of measured points before they become a curve: artefacts of measurement are removed with a note for each,
// and folds, self-intersections and gaps are refused.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "polyline.hpp"
#include "profile_text.hpp"

namespace rollbem::detail {

/// A length [m] in millimetres: "12.34 mm".
inline std::string in_mm(double length, const char* unit = " mm") {
    char text[40];
    std::snprintf(text, sizeof text, "%.*g", std::abs(length) < 1e-3 ? 2 : 4, 1000 * length + 0.0);
    return std::string(text) + unit;
}

/// Cleans the points of a file; notes and refusals name the file.
class ProfileCleaning {
public:
    ProfileCleaning(const TextFile& file, std::vector<std::string>& notes) : file_(file), notes_(notes) {}

    /// The points without repeated points, zig-zags and folded ends.
    CurvePoints operator()(const CurvePoints& points) {
        return without_folded_end(without_folded_end(without_zigzags(without_repeated(points)), true), false);
    }

    /// Throws std::invalid_argument where the points have a gap, or fold back over at least `tolerated` [m].
    void require_curve(const CurvePoints& p, double tolerated) const {
        if (p.size() < 4) file_.refuse("at least 4 points are expected, found: " + std::to_string(p.size()));
        for (std::size_t i = 0; i + 1 < p.size(); ++i) {
            if (step(p, i) <= 20e-3) continue;
            file_.refuse(p.line[i + 1], "the next point is expected within 20 mm; this one is " + in_mm(step(p, i)) +
                                            " from the point of line " + std::to_string(p.line[i] + 1));
        }
        for (std::size_t i = 1; i + 1 < p.size(); ++i) {
            if (!folds(p, i)) continue;
            if (length_back(p, i, 1, tolerated) < tolerated || length_back(p, i, -1, tolerated) < tolerated) continue;
            const double back = (std::min)(length_back(p, i, 1), length_back(p, i, -1));
            file_.refuse(p.line[i], "the curve folds back" + place(p, i) + ", over " + in_mm(back) +
                                        ": a curve that goes on is expected (remove the points of this artefact" +
                                        (tolerated > 0 ? ")" : ", or smooth over a wave length well above it)"));
        }
    }

    /// Throws std::invalid_argument where the polygon of the points meets itself.
    void require_simple(const CurvePoints& points) const {
        if (const auto met = Meeting(points).find()) {
            file_.refuse(points.line[met->second], "the curve crosses itself" + place(points, met->second) +
                                                       "; it was there at line " +
                                                       std::to_string(points.line[met->first] + 1));
        }
    }

private:
    static double step(const CurvePoints& p, std::size_t i) {
        return std::hypot(p.y[i + 1] - p.y[i], p.z[i + 1] - p.z[i]);
    }
    static std::array<double, 2> direction(const CurvePoints& p, std::size_t i) {
        return {p.y[i + 1] - p.y[i], p.z[i + 1] - p.z[i]};
    }
    static bool folds(const CurvePoints& p, std::size_t i) {
        return std::abs(turn(direction(p, i - 1), direction(p, i))) > fold;
    }
    static std::string place(const CurvePoints& p, std::size_t i) {
        return " at y = " + in_mm(p.y[i], "") + ", z = " + in_mm(p.z[i]);
    }

    // Length by which the curve goes back beyond point i, in the order of the points (way 1) or against it (-1); at
    // least `enough` if it is more.
    static double length_back(const CurvePoints& p, std::size_t i, int way, double enough = 1e300) {
        const auto at = [&](std::size_t k) { return way > 0 ? k : k - 1; };
        const auto [y, z] = direction(p, way > 0 ? i - 1 : i);
        double length = 0;
        for (std::size_t k = i; way > 0 ? k + 1 < p.size() : k > 0; k += way > 0 ? 1 : std::size_t(-1)) {
            const auto [dy, dz] = direction(p, at(k));
            if (dy * y + dz * z >= 0 || length >= enough) break;
            length += step(p, at(k));
        }
        return length;
    }

    CurvePoints without_repeated(const CurvePoints& points) {
        CurvePoints kept;
        std::size_t first = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool repeated =
                kept.size() > 0 && std::hypot(points.y[i] - kept.y.back(), points.z[i] - kept.z.back()) < 1e-7;
            if (!repeated) {
                kept.add(points.y[i], points.z[i], points.line[i]);
            } else if (first == 0) {
                first = points.line[i] + 1;
            }
        }
        if (first > 0) {
            notes_.push_back("repeated points, nearer than 0.0001 mm to the one before: " +
                             std::to_string(points.size() - kept.size()) + " dropped, the first in line " +
                             std::to_string(first));
        }
        return kept;
    }

    // Replaces two successive turns that fold back over less than 0.5 mm: their points become their mean.
    CurvePoints without_zigzags(const CurvePoints& points) {
        CurvePoints kept;
        std::size_t count = 0;
        const auto add = [&](double y, double z, std::size_t line) {
            if (kept.size() > 0 && std::hypot(y - kept.y.back(), z - kept.z.back()) < 1e-7) return;
            kept.add(y, z, line);
        };
        for (std::size_t i = 0; i < points.size(); ++i) {
            add(points.y[i], points.z[i], points.line[i]);
            while (kept.size() >= 4) {
                const std::size_t b = kept.size() - 3, c = b + 1, d = b + 2;
                if (!(step(kept, b) < 0.5e-3 && folds(kept, b) && folds(kept, c))) break;
                if (++count <= 20) {
                    notes_.push_back("zig-zag of " + in_mm(step(kept, b)) + place(kept, b) + ", lines " +
                                     std::to_string(kept.line[b] + 1) + " and " + std::to_string(kept.line[c] + 1) +
                                     ": both points became their mean");
                }
                const double y = (kept.y[b] + kept.y[c]) / 2, z = (kept.z[b] + kept.z[c]) / 2;
                const CurvePoints last{{kept.y[d]}, {kept.z[d]}, {kept.line[d]}};
                const std::size_t line = kept.line[b];
                kept.y.resize(b);
                kept.z.resize(b);
                kept.line.resize(b);
                add(y, z, line);
                add(last.y[0], last.z[0], last.line[0]);
            }
        }
        if (count > 20) notes_.push_back("zig-zags: " + std::to_string(count - 20) + " more");
        return kept;
    }

    // Cuts off a fold of less than 0.5 mm within 3 mm of an end, and all points beyond it.
    CurvePoints without_folded_end(CurvePoints p, bool first) {
        if (!first) reverse(p);
        std::size_t cut = 0;
        double s = 0;
        for (std::size_t i = 1; i + 1 < p.size() && (s += step(p, i - 1)) < 3e-3; ++i) {
            if (!folds(p, i)) continue;
            const double beyond = length_back(p, i, -1, 0.5e-3), back = length_back(p, i, 1, 0.5e-3);
            if (beyond < 0.5e-3 && s - beyond < 1e-12) {
                cut = i;  // the end itself is folded
            } else if (back < 0.5e-3) {
                cut = i;
                for (double left = back; left > 0 && cut + 2 < p.size(); ++cut) left -= step(p, cut);
            }
        }
        if (cut > 0 && cut + 4 <= p.size()) {
            double length = 0;
            for (std::size_t i = 0; i < cut; ++i) length += step(p, i);
            notes_.push_back("end folded back" + place(p, cut) + ", line " + std::to_string(p.line[cut] + 1) + ": " +
                             std::to_string(cut) + " points beyond it cut off, " + in_mm(length) + " of the curve");
            const auto drop = [cut](auto& values) {
                values.erase(values.begin(), values.begin() + std::ptrdiff_t(cut));
            };
            drop(p.y);
            drop(p.z);
            drop(p.line);
        }
        if (!first) reverse(p);
        return p;
    }

    static void reverse(CurvePoints& p) {
        std::reverse(p.y.begin(), p.y.end());
        std::reverse(p.z.begin(), p.z.end());
        std::reverse(p.line.begin(), p.line.end());
    }

    // Finds two segments that meet by halving both until their boxes part.
    class Meeting {
    public:
        using Segments = std::optional<std::pair<std::size_t, std::size_t>>;

        explicit Meeting(const CurvePoints& points) : p_(points), boxes_(2 * (points.size() - 1)) {
            const std::size_t n = points.size() - 1;
            for (std::size_t i = 0; i < n; ++i) {
                boxes_[n + i] = {(std::min)(p_.y[i], p_.y[i + 1]), (std::max)(p_.y[i], p_.y[i + 1]),
                                 (std::min)(p_.z[i], p_.z[i + 1]), (std::max)(p_.z[i], p_.z[i + 1])};
            }
            for (std::size_t k = n - 1; k > 0; --k) {
                const Box &a = boxes_[2 * k], &b = boxes_[2 * k + 1];
                boxes_[k] = {(std::min)(a[0], b[0]), (std::max)(a[1], b[1]), (std::min)(a[2], b[2]),
                             (std::max)(a[3], b[3])};
            }
        }

        /// The first pair of segments found, the earlier segment first.
        Segments find() const {
            const std::size_t n = p_.size() - 1;
            for (std::size_t k = n - 1; k > 0; --k) {
                if (const Segments met = between(2 * k, 2 * k + 1)) return met;
            }
            return std::nullopt;
        }

    private:
        using Box = std::array<double, 4>;

        Segments between(std::size_t a, std::size_t b) const {
            const std::size_t n = p_.size() - 1;
            const Box &one = boxes_[a], &other = boxes_[b];
            if (one[0] > other[1] || other[0] > one[1] || one[2] > other[3] || other[2] > one[3]) return std::nullopt;
            if (a >= n && b >= n) {
                const auto [i, j] = std::minmax({a - n, b - n});
                if (j - i < 2 || !cross(i, j)) return std::nullopt;
                return std::pair{i, j};
            }
            const bool halve_a = a < n && (b >= n || a < b);
            for (const std::size_t child : {std::size_t{0}, std::size_t{1}}) {
                const Segments met = halve_a ? between(2 * a + child, b) : between(a, 2 * b + child);
                if (met) return met;
            }
            return std::nullopt;
        }

        double side(std::size_t i, std::size_t k) const {
            return (p_.y[i + 1] - p_.y[i]) * (p_.z[k] - p_.z[i]) - (p_.z[i + 1] - p_.z[i]) * (p_.y[k] - p_.y[i]);
        }
        bool cross(std::size_t i, std::size_t j) const {
            return side(i, j) * side(i, j + 1) <= 0 && side(j, i) * side(j, i + 1) <= 0;
        }

        const CurvePoints& p_;
        std::vector<Box> boxes_;  // a binary tree from 1 on, its leaves the segments
    };

    const TextFile& file_;
    std::vector<std::string>& notes_;
};

}  // namespace rollbem::detail
