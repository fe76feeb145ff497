// Bodies of normal/profile_wear.hpp. Internal.
#pragma once

#include "../profile_wear.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/highest_place.hpp"
#include "../detail/polyline.hpp"
#include "../detail/profile_foot.hpp"

namespace rollbem::detail {

/// The use for a profile made from this one.
inline Profile::Use use_of(const Profile& profile) {
    return profile.is_piece() ? Profile::Use::piece : Profile::Use::rail;
}

/// Points of the reference in the parts, evenly spaced, with its normals, and the motion that is sought.
class Aligner {
public:
    Aligner(const Profile& profile, const Profile& reference, const std::vector<std::array<double, 2>>& parts,
            bool turns)
        : profile_(profile), parts_(parts.size()), unknowns_(turns ? 3 : 2) {
        constexpr double spacing = 2.5e-4;
        const auto count = Eigen::Index(reference.length() / spacing);
        for (Eigen::Index k = 0; k <= count; ++k) {
            const Profile::Point p = reference.at(reference.length() * double(k) / double(count));
            for (std::size_t part = 0; part < parts.size(); ++part) {
                if (p.y < parts[part][0] || p.y > parts[part][1]) continue;
                const double size = std::hypot(p.slope[0], p.slope[1]);
                const double share = (p.y - parts[part][0]) / (parts[part][1] - parts[part][0]);
                const auto place = std::size_t((std::min)(share, 0.999) * places_of_part);
                samples_.push_back({{p.y, p.z}, {-p.slope[1] / size, p.slope[0] / size}, part, place});
                break;
            }
        }
    }

    /// The best motion from this start.
    Profile::Alignment from(double dy, double dz) const {
        Profile::Alignment motion{0, dy, dz, 0, 0};
        double bound = 1e-3;  // below it squares count, above it distances
        for (int k = 0; k < 40; ++k, bound = (std::max)(bound / 2, 1e-8)) {
            step(motion, [&](const Sample&, double r) { return 1 / (std::max)(std::abs(r), bound); });
        }
        motion = by_places(motion);
        for (int k = 0; k < 20; ++k) {
            const double scale = (std::max)(4.685 * deviation(motion), 1e-6);
            step(motion, [&](const Sample&, double r) { return biweight(r / scale); });
        }
        const double scale = (std::max)(4.685 * deviation(motion), 1e-6);
        double squares = 0, weights = 0, counted = 0;
        for (const double r : residuals(motion)) {
            const double weight = std::isnan(r) ? 0 : biweight(r / scale);
            weights += weight;
            squares += weight > 0 ? weight * r * r : 0;
            counted += weight > 0 ? 1 : 0;
        }
        motion.residual = weights > 0 ? std::sqrt(squares / weights) : std::numeric_limits<double>::infinity();
        motion.share = samples_.empty() ? 0 : counted / double(samples_.size());
        return motion;
    }

    /// The sum of distances, those of points without a counterpart and beyond 0.1 mm as 0.1 mm.
    double cost(const Profile::Alignment& motion) const {
        double sum = 0;
        for (const double r : residuals(motion)) sum += std::isnan(r) ? 1e-4 : (std::min)(std::abs(r), 1e-4);
        return sum;
    }

    /// Throws std::invalid_argument unless every part is met in half of its length, and all fix the motion.
    void require_fixed(const Profile::Alignment& motion, const std::vector<std::array<double, 2>>& parts) const {
        std::vector<double> met(parts_, 0), all(parts_, 0);
        const std::vector<double> found = residuals(motion);
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            all[samples_[i].part] += 1;
            if (std::isnan(found[i])) continue;
            met[samples_[i].part] += 1;
            const Eigen::Vector3d row = row_of(samples_[i]);
            normal += row * row.transpose();
        }
        for (std::size_t k = 0; k < parts_; ++k) {
            if (met[k] > 0 && met[k] >= all[k] / 2) continue;
            throw std::invalid_argument("align: part y = " + to_text(parts[k][0]) + " to " + to_text(parts[k][1]) +
                                        " m must lie on the reference and be measured: --align-parts");
        }
        const Eigen::MatrixXd own = normal.topLeftCorner(unknowns_, unknowns_) / double(samples_.size());
        const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(own).eigenvalues()[0];
        require(least > 1e-4, "align", "least share of the parts' normals in a direction", least,
                "be above 1e-4: further --align-parts must fix the motion");
    }

private:
    struct Sample {
        std::array<double, 2> at, normal;
        std::size_t part, place;
    };
    static constexpr std::size_t places_of_part = 5;

    /// The best of motions that two places, or three with an angle, fix alone: those of a majority that is worn
    /// unevenly agree with nothing else.
    Profile::Alignment by_places(const Profile::Alignment& start) const {
        Profile::Alignment best = start;
        double least = cost(best);
        const std::size_t places = parts_ * places_of_part;
        const auto try_places = [&](std::size_t a, std::size_t b, std::size_t c) {
            Profile::Alignment motion = start;
            for (int k = 0; k < 3; ++k) {
                step(motion, [&](const Sample& sample, double) {
                    const std::size_t own = sample.part * places_of_part + sample.place;
                    return own == a || own == b || own == c ? 1.0 : 0.0;
                });
            }
            const double own = cost(motion);
            if (!(own < least)) return;
            least = own;
            best = motion;
        };
        for (std::size_t a = 0; a < places; ++a) {
            for (std::size_t b = a + 1; b < places; ++b) {
                if (unknowns_ == 2) try_places(a, b, b);
                for (std::size_t c = b + 1; unknowns_ == 3 && c < places; ++c) try_places(a, b, c);
            }
        }
        return best;
    }
    static constexpr double arm = 0.05;  // of angles [m]

    static double biweight(double r) { return std::abs(r) < 1 ? (1 - r * r) * (1 - r * r) : 0; }
    static Eigen::Vector3d row_of(const Sample& sample) {
        return {sample.normal[0], sample.normal[1],
                (sample.normal[1] * sample.at[0] - sample.normal[0] * sample.at[1]) / arm};
    }

    /// Distances of the moved profile from the reference along its normals; NaN where the profile ends.
    std::vector<double> residuals(const Profile::Alignment& motion) const {
        const double c = std::cos(motion.angle), s = std::sin(motion.angle);
        std::vector<double> found;
        for (const auto& [at, normal, part, place] : samples_) {
            const double y = at[0] - motion.dy, z = at[1] - motion.dz;
            const double foot = foot_of(profile_, c * y + s * z, c * z - s * y);
            const Profile::Point p = profile_.at(foot);
            const bool ends = foot <= 0 || foot >= profile_.length();
            found.push_back(ends ? std::numeric_limits<double>::quiet_NaN()
                                 : normal[0] * (c * p.y - s * p.z - y) + normal[1] * (s * p.y + c * p.z - z));
        }
        return found;
    }

    /// The standard deviation that the least three tenths of the distances show: what is worn lies beyond.
    double deviation(const Profile::Alignment& motion) const {
        std::vector<double> sizes;
        for (const double r : residuals(motion)) {
            if (!std::isnan(r)) sizes.push_back(std::abs(r));
        }
        if (sizes.empty()) return 0;
        const auto least = sizes.begin() + std::ptrdiff_t(sizes.size() * 3 / 10);
        std::nth_element(sizes.begin(), least, sizes.end());
        return *least / 0.3853;
    }

    /// A step of least squares with weights of the samples and their distances.
    template <class Weight>
    void step(Profile::Alignment& motion, const Weight& weight) const {
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
        Eigen::Vector3d right = Eigen::Vector3d::Zero();
        const std::vector<double> found = residuals(motion);
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            if (std::isnan(found[i])) continue;
            const Eigen::Vector3d row = row_of(samples_[i]);
            normal += weight(samples_[i], found[i]) * row * row.transpose();
            right -= weight(samples_[i], found[i]) * found[i] * row;
        }
        Eigen::Vector3d by = Eigen::Vector3d::Zero();
        by.head(unknowns_) =
            normal.topLeftCorner(unknowns_, unknowns_).completeOrthogonalDecomposition().solve(right.head(unknowns_));
        // about the origin of the reference
        const double turn = std::clamp(by[2] / arm, -0.05, 0.05), c = std::cos(turn), s = std::sin(turn);
        motion.angle += turn;
        const double dy = motion.dy, dz = motion.dz;
        motion.dy = c * dy - s * dz + by[0];
        motion.dz = s * dy + c * dz + by[1];
    }

    const Profile& profile_;
    std::size_t parts_;
    Eigen::Index unknowns_;
    std::vector<Sample> samples_;
};

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL std::vector<std::array<double, 2>> unworn_parts(const Profile& reference, Profile::Use body, double tape) {
    const Eigen::ArrayXd &y = reference.y(), &z = reference.z();
    Eigen::Index from = 0, to = reference.size() - 1;
    if (body == Profile::Use::wheel) {
        Eigen::Index crown = 0;
        z.maxCoeff(&crown);
        while (from < crown && z[from + 1] - z[from] > y[from + 1] - y[from]) ++from;  // steeper than 45 degrees
        detail::require(from > 0 && y[to] > tape + 35e-3, "align", "reference", "without flange back or tread",
                        "have unworn parts: --align-parts");
        return {{y.minCoeff(), y[from]}, {tape + 35e-3, y[to]}};
    }
    const double deep = reference.at(detail::highest_place(reference)).z + 20e-3;
    while (from < to && z[from] > deep) ++from;
    while (to > from && z[to] > deep) --to;
    detail::require(from > 0 && to + 1 < reference.size(), "align", "reference", "without sides 20 mm below its top",
                    "have unworn parts: --align-parts");
    return {{y.head(from).minCoeff(), y.head(from).maxCoeff()},
            {y.tail(reference.size() - 1 - to).minCoeff(), y.tail(reference.size() - 1 - to).maxCoeff()}};
}

ROLLBEM_DECL Profile extended(const Profile& profile, double length) {
    detail::require_positive("extended", "length", length);
    constexpr Eigen::Index more = 20;
    const Eigen::Index n = profile.size();
    Eigen::ArrayXd y(n + 2 * more), z(n + 2 * more);
    y.segment(more, n) = profile.y();
    z.segment(more, n) = profile.z();
    const Profile::Point first = profile.at(0), last = profile.at(profile.length());
    for (Eigen::Index k = 1; k <= more; ++k) {
        const double on = double(k) / double(more) * length;
        y[more - k] = first.y - on * first.slope[0];
        z[more - k] = first.z - on * first.slope[1];
        y[more + n - 1 + k] = last.y + on * last.slope[0];
        z[more + n - 1 + k] = last.z + on * last.slope[1];
    }
    return {std::move(y), std::move(z), detail::use_of(profile)};
}

ROLLBEM_DECL Profile::Alignment align(const Profile& profile, const Profile& reference,
                                      const std::vector<std::array<double, 2>>& parts, bool turns) {
    detail::require(!parts.empty(), "align", "number of parts", parts.size(), "be at least 1");
    for (const auto& [from, to] : parts)
        detail::require(from < to, "align", "end of a part", to, "lie above its begin");
    const detail::Aligner aligner(profile, reference, parts, turns);
    // from where it is, and from where its lowest point, a flange, or its highest one, a head, lies as the reference's
    Eigen::Index lowest = 0, deepest = 0, highest = 0, top = 0;
    profile.z().maxCoeff(&lowest);
    reference.z().maxCoeff(&deepest);
    profile.z().minCoeff(&highest);
    reference.z().minCoeff(&top);
    Profile::Alignment best = aligner.from(0, 0);
    for (const auto& [own, other] : {std::array{lowest, deepest}, std::array{highest, top}}) {
        const Profile::Alignment next =
            aligner.from(reference.y()[other] - profile.y()[own], reference.z()[other] - profile.z()[own]);
        if (aligner.cost(next) < aligner.cost(best)) best = next;
    }
    aligner.require_fixed(best, parts);
    return best;
}

}  // namespace rollbem

namespace rollbem::detail {

/// A point at s moved into the material, `sign` times (-dz, dy)/ds, to where the lines at this depth on both its sides
/// meet, which differ at a corner.
inline std::array<double, 2> moved_inwards(const Profile& profile, double s, double depth, double sign) {
    const Profile::Point at = profile.at(s), before = s > 0 ? profile.at(std::nextafter(s, 0.0)) : at;
    const double size = std::hypot(at.slope[0], at.slope[1]), other = std::hypot(before.slope[0], before.slope[1]);
    const double cosine = (at.slope[0] * before.slope[0] + at.slope[1] * before.slope[1]) / (size * other);
    const double reach = sign * depth / (1 + cosine);
    return {at.y - reach * (at.slope[1] / size + before.slope[1] / other),
            at.z + reach * (at.slope[0] / size + before.slope[0] / other)};
}

/// The points of a profile moved inwards, depths between them by splines.
class InwardCurve {
public:
    InwardCurve(const Profile& profile, const Eigen::ArrayXd& depth, double sign)
        : profile_(profile),
          depth_(depth),
          bends_(spline_bends(profile.s(), depth, profile.corners())),
          sign_(sign),
          y_(profile.size()),
          z_(profile.size()) {
        for (Eigen::Index i = 0; i < y_.size(); ++i) {
            std::tie(y_[i], z_[i]) = std::tuple_cat(moved_inwards(profile, profile.s()[i], depth[i], sign));
        }
        for (Eigen::Index i = 1; i < y_.size(); ++i) {
            const double dy = profile.y()[i] - profile.y()[i - 1], dz = profile.z()[i] - profile.z()[i - 1];
            if ((y_[i] - y_[i - 1]) * dy + (z_[i] - z_[i - 1]) * dz > 0) continue;
            throw std::invalid_argument("worn: depth = " + to_text((std::max)(depth[i - 1], depth[i])) +
                                        " m at y = " + to_text(profile.y()[i]) +
                                        " m must not fold the profile: smaller steps, or smooth the profile");
        }
    }

    /// The curve with its points at the same shares of the length between corners and ends as those of the profile.
    Profile spaced() const {
        std::vector<Eigen::Index> ends{0};
        ends.insert(ends.end(), profile_.corners().begin(), profile_.corners().end());
        ends.push_back(profile_.size() - 1);
        const Eigen::ArrayXd lengths = lengths_along(y_, z_), &s = profile_.s();
        Eigen::ArrayXd y = y_, z = z_;
        for (std::size_t k = 1; k < ends.size(); ++k) {
            const Eigen::Index from = ends[k - 1], to = ends[k];
            const double scale = (lengths[to] - lengths[from]) / (s[to] - s[from]);
            Eigen::Index below = from;
            for (Eigen::Index i = from + 1; i < to; ++i) {
                const double length = lengths[from] + scale * (s[i] - s[from]);
                while (below + 2 <= to && lengths[below + 1] <= length) ++below;
                const double share = (length - lengths[below]) / (lengths[below + 1] - lengths[below]);
                std::tie(y[i], z[i]) = std::tuple_cat(at(below, share));
            }
        }
        return {std::move(y), std::move(z), use_of(profile_)};
    }

private:
    std::array<double, 2> at(Eigen::Index i, double t) const {
        const double h = profile_.s()[i + 1] - profile_.s()[i], u = 1 - t;
        const double depth = u * depth_[i] + t * depth_[i + 1] +
                             h * h / 6 * ((u * u - 1) * u * bends_[i] + (t * t - 1) * t * bends_[i + 1]);
        return moved_inwards(profile_, profile_.s()[i] + t * h, depth, sign_);
    }

    const Profile& profile_;
    const Eigen::ArrayXd& depth_;
    Eigen::ArrayXd bends_;
    double sign_;
    Eigen::ArrayXd y_, z_;
};

/// The integral of z dy along the spline.
inline double area_under(const Profile& profile) {
    const double place = std::sqrt(0.15);  // Gauss's three points are exact for products of two cubics
    double sum = 0;
    for (Eigen::Index i = 1; i < profile.size(); ++i) {
        const double from = profile.s()[i - 1], h = profile.s()[i] - from;
        const auto at = [&](double share) {
            const Profile::Point p = profile.at(from + share * h);
            return (p.z - profile.z()[0]) * p.slope[0];
        };
        sum += h / 18 * (5 * at(0.5 - place) + 8 * at(0.5) + 5 * at(0.5 + place));
    }
    return sum + profile.z()[0] * (profile.y()[profile.size() - 1] - profile.y()[0]);
}

inline double sign_of(Profile::Use body) { return body == Profile::Use::wheel ? -1 : 1; }

inline void require_depths(const Profile& profile, const Eigen::ArrayXd& depth, Profile::Use body) {
    require(body != Profile::Use::piece, "worn", "body", "piece", "be a wheel or a rail, which says where it wears");
    require(depth.size() == profile.size(), "worn", "number of depths", depth.size(), "be the number of points");
    for (const double own : depth) require_not_negative("worn", "depth", own);
}

/// Depths that take off these areas per length of the curved profile, to the second order.
inline Eigen::ArrayXd depths_of(const Profile& profile, const Eigen::ArrayXd& area, double sign) {
    Eigen::ArrayXd depth = area;
    for (Eigen::Index i = 0; i < profile.size(); ++i) {
        if (std::binary_search(profile.corners().begin(), profile.corners().end(), i)) continue;
        const Profile::Point p = profile.at(profile.s()[i]);
        const double speed = std::hypot(p.slope[0], p.slope[1]);
        // positive where the body is hollow outside and the curve grows longer as it wears
        const double growth = -sign * (p.slope[0] * p.bend[1] - p.slope[1] * p.bend[0]) / (speed * speed * speed);
        const double root = 1 + 2 * growth * area[i];
        depth[i] = 2 * area[i] / (1 + std::sqrt((std::max)(root, 0.25)));
    }
    return depth;
}

/// Places s where the spline passes a height z, in the order of the curve.
inline std::vector<double> places_at_height(const Profile& profile, double z) {
    std::vector<double> places;
    for (Eigen::Index i = 1; i < profile.size(); ++i) {
        double from = profile.s()[i - 1], to = profile.s()[i];
        const bool rises = profile.z()[i - 1] <= z;
        if (rises == (profile.z()[i] <= z)) continue;
        for (int k = 0; k < 60; ++k) {
            const double middle = (from + to) / 2;
            ((profile.at(middle).z <= z) == rises ? from : to) = middle;
        }
        places.push_back((from + to) / 2);
    }
    return places;
}

/// z where the curve passes y, the highest (least z) of them; NaN beside it.
inline double height_at(const Profile& profile, double y) {
    double least = std::numeric_limits<double>::quiet_NaN();
    for (Eigen::Index i = 1; i < profile.size(); ++i) {
        double from = profile.s()[i - 1], to = profile.s()[i];
        const bool grows = profile.y()[i - 1] <= y;
        if (grows == (profile.y()[i] <= y)) continue;
        for (int k = 0; k < 60; ++k) {
            const double middle = (from + to) / 2;
            ((profile.at(middle).y <= y) == grows ? from : to) = middle;
        }
        const double z = profile.at((from + to) / 2).z;
        if (!(least <= z)) least = z;
    }
    return least;
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL Profile refined(const Profile& profile, double spacing) {
    detail::require(detail::is_finite(spacing) && spacing >= 1e-6, "refined", "spacing", spacing,
                    "be finite and at least 1e-6 m");
    std::vector<double> y{profile.y()[0]}, z{profile.z()[0]};
    for (Eigen::Index i = 1; i < profile.size(); ++i) {
        const double from = profile.s()[i - 1], h = profile.s()[i] - from;
        const double parts = std::ceil(h / spacing * (1 - 1e-9));
        for (double k = 1; k < parts; ++k) {
            const Profile::Point p = profile.at(from + k / parts * h);
            y.push_back(p.y);
            z.push_back(p.z);
        }
        y.push_back(profile.y()[i]);
        z.push_back(profile.z()[i]);
    }
    const auto n = Eigen::Index(y.size());
    return {Eigen::ArrayXd::Map(y.data(), n), Eigen::ArrayXd::Map(z.data(), n), detail::use_of(profile)};
}

ROLLBEM_DECL Profile worn(const Profile& profile, const Eigen::ArrayXd& depth, Profile::Use body) {
    detail::require_depths(profile, depth, body);
    return detail::InwardCurve(profile, depth, detail::sign_of(body)).spaced();
}

ROLLBEM_DECL Profile worn_by_area(const Profile& profile, const Eigen::ArrayXd& area_per_length, Profile::Use body) {
    detail::require_depths(profile, area_per_length, body);
    const double wanted = (area_per_length * lengths_at_points(profile)).sum();
    if (!(wanted > 0)) return profile;
    Eigen::ArrayXd depth = detail::depths_of(profile, area_per_length, detail::sign_of(body));
    Profile after = worn(profile, depth, body);
    for (int round = 0; round < 5; ++round) {  // sums over points differ a little from integrals of splines
        const double ratio = wanted / area_between(profile, after, body);
        if (std::abs(ratio - 1) < 1e-10 || !(ratio > 0.5 && ratio < 2)) break;
        depth *= ratio;
        after = worn(profile, depth, body);
    }
    return after;
}

ROLLBEM_DECL Eigen::ArrayXd spread(const Profile& profile, const Eigen::ArrayXd& area_per_length, double reach) {
    detail::require_positive("spread", "reach", reach);
    const Eigen::Index n = profile.size();
    const Eigen::ArrayXd lengths = lengths_at_points(profile);
    Eigen::ArrayXd diagonal = lengths, beside = Eigen::ArrayXd::Zero(n), found = area_per_length * lengths;
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
        beside[i] = reach * reach / (profile.s()[i + 1] - profile.s()[i]);
        diagonal[i] += beside[i];
        diagonal[i + 1] += beside[i];
    }
    for (Eigen::Index i = 1; i < n; ++i) {  // symmetric and tridiagonal, with -beside
        const double share = beside[i - 1] / diagonal[i - 1];
        diagonal[i] -= share * beside[i - 1];
        found[i] += share * found[i - 1];
    }
    for (Eigen::Index i = n - 1; i >= 0; --i) {
        if (i + 1 < n) found[i] += beside[i] * found[i + 1];
        found[i] /= diagonal[i];
    }
    return found;
}

ROLLBEM_DECL Eigen::ArrayXd lengths_at_points(const Profile& profile) {
    const Eigen::Index n = profile.size();
    Eigen::ArrayXd lengths = Eigen::ArrayXd::Zero(n);
    const Eigen::ArrayXd halves = (profile.s().tail(n - 1) - profile.s().head(n - 1)) / 2;
    lengths.head(n - 1) += halves;
    lengths.tail(n - 1) += halves;
    return lengths;
}

ROLLBEM_DECL double area_between(const Profile& before, const Profile& after, Profile::Use body) {
    const auto along = [](const Profile& from, const Profile& to, bool end) {
        const Eigen::Index i = end ? from.size() - 1 : 0, k = end ? to.size() - 1 : 0;
        return (from.z()[i] + to.z()[k]) / 2 * (to.y()[k] - from.y()[i]);
    };
    const double area = detail::area_under(after) - detail::area_under(before) + along(before, after, false) -
                        along(before, after, true);
    return detail::sign_of(body) * area;
}

ROLLBEM_DECL Eigen::ArrayXd depth_between(const Profile& before, const Profile& after, Profile::Use body) {
    Eigen::ArrayXd depth(after.size());
    for (Eigen::Index i = 0; i < after.size(); ++i) {
        const Profile::Point p = before.at(detail::foot_of(before, after.y()[i], after.z()[i]));
        depth[i] = detail::sign_of(body) * ((after.z()[i] - p.z) * p.slope[0] - (after.y()[i] - p.y) * p.slope[1]) /
                   std::hypot(p.slope[0], p.slope[1]);
    }
    return depth;
}

ROLLBEM_DECL Profile::FlangeSizes flange_sizes(const Profile& wheel, double tape_offset) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const double tape = detail::height_at(wheel, 0.07 - tape_offset);
    Eigen::Index tip = 0;
    wheel.z().maxCoeff(&tip);
    // the crown between points
    double z_tip = wheel.z()[tip];
    for (double share = -1; share <= 1; share += 0.05) {
        const Eigen::Index other = std::clamp<Eigen::Index>(tip + (share < 0 ? -1 : 1), 0, wheel.size() - 1);
        const double s = wheel.s()[tip] + std::abs(share) * (wheel.s()[other] - wheel.s()[tip]);
        z_tip = (std::max)(z_tip, wheel.at(s).z);
    }
    // the face lies between the tip and the tape circle
    const auto face = [&](double z) {
        for (const double s : detail::places_at_height(wheel, z)) {
            if (s > wheel.s()[tip]) return wheel.at(s).y;
        }
        return nan;
    };
    const double thick = face(tape + 10e-3);
    return {z_tip - tape, thick + tape_offset, thick - face(z_tip - 2e-3)};
}

ROLLBEM_DECL Profile::RailWear rail_wear(const Profile& before, const Profile& after, double depth) {
    const double top = before.at(detail::highest_place(before)).z;
    const auto side = [&](const Profile& profile) {
        const std::vector<double> places = detail::places_at_height(profile, top + depth);
        // the first one from the inner side on which the curve rises
        for (const double s : places) {
            if (profile.at(s).slope[1] < 0) return profile.at(s).y;
        }
        return std::numeric_limits<double>::quiet_NaN();
    };
    return {detail::height_at(after, 0) - detail::height_at(before, 0), side(after) - side(before)};
}

}  // namespace rollbem
