// Bodies of normal/profile_alignment.hpp. Internal.
#pragma once

#include "../profile_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "../../detail/require.hpp"
#include "../detail/highest_place.hpp"
#include "../detail/profile_foot.hpp"

namespace rollbem::detail {

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
                samples_.push_back({{p.y, p.z}, {-p.slope[1] / size, p.slope[0] / size}, part});
                break;
            }
        }
    }

    /// The best motion from this start.
    Alignment from(double dy, double dz) const {
        Alignment motion{0, dy, dz, 0, 0};
        double bound = 1e-3;  // below it squares count, above it distances
        for (int k = 0; k < 40; ++k, bound = (std::max)(bound / 2, 1e-8)) {
            step(motion, [&](double r) { return 1 / (std::max)(std::abs(r), bound); });
        }
        for (int k = 0; k < 20; ++k) {
            const double scale = (std::max)(4.685 * deviation(motion), 1e-6);
            step(motion, [&](double r) { return biweight(r / scale); });
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

    /// The sum of distances, those of points without a counterpart and beyond 1 mm as 1 mm.
    double cost(const Alignment& motion) const {
        double sum = 0;
        for (const double r : residuals(motion)) sum += std::isnan(r) ? 1e-3 : (std::min)(std::abs(r), 1e-3);
        return sum;
    }

    /// Throws std::invalid_argument unless every part is met in half of its length, and all fix the motion.
    void require_fixed(const Alignment& motion, const std::vector<std::array<double, 2>>& parts) const {
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
        std::size_t part;
    };
    static constexpr double arm = 0.05;  // of angles [m]

    static double biweight(double r) { return std::abs(r) < 1 ? (1 - r * r) * (1 - r * r) : 0; }
    static Eigen::Vector3d row_of(const Sample& sample) {
        return {sample.normal[0], sample.normal[1],
                (sample.normal[1] * sample.at[0] - sample.normal[0] * sample.at[1]) / arm};
    }

    /// Distances of the moved profile from the reference along its normals; NaN where the profile ends.
    std::vector<double> residuals(const Alignment& motion) const {
        const double c = std::cos(motion.angle), s = std::sin(motion.angle);
        std::vector<double> found;
        for (const auto& [at, normal, part] : samples_) {
            const double y = at[0] - motion.dy, z = at[1] - motion.dz;
            const double foot = foot_of(profile_, c * y + s * z, c * z - s * y);
            const Profile::Point p = profile_.at(foot);
            const bool ends = foot <= 0 || foot >= profile_.length();
            found.push_back(ends ? std::numeric_limits<double>::quiet_NaN()
                                 : normal[0] * (c * p.y - s * p.z - y) + normal[1] * (s * p.y + c * p.z - z));
        }
        return found;
    }

    /// The standard deviation that the least three tenths of the distances show, with an angle the least half: what is
    /// worn lies beyond.
    double deviation(const Alignment& motion) const {
        std::vector<double> sizes;
        for (const double r : residuals(motion)) {
            if (!std::isnan(r)) sizes.push_back(std::abs(r));
        }
        if (sizes.empty()) return 0;
        const bool turns = unknowns_ > 2;
        const auto least = sizes.begin() + std::ptrdiff_t(sizes.size() * (turns ? 5 : 3) / 10);
        std::nth_element(sizes.begin(), least, sizes.end());
        return *least / (turns ? 0.6745 : 0.3853);
    }

    /// A step of weighted least squares.
    template <class Weight>
    void step(Alignment& motion, const Weight& weight) const {
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
        Eigen::Vector3d right = Eigen::Vector3d::Zero();
        const std::vector<double> found = residuals(motion);
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            if (std::isnan(found[i])) continue;
            const Eigen::Vector3d row = row_of(samples_[i]);
            normal += weight(found[i]) * row * row.transpose();
            right -= weight(found[i]) * found[i] * row;
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
    return {std::move(y), std::move(z), profile.is_piece() ? Profile::Use::piece : Profile::Use::rail};
}

ROLLBEM_DECL Alignment align(const Profile& profile, const Profile& reference,
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
    Alignment best = aligner.from(0, 0);
    for (const auto& [own, other] : {std::array{lowest, deepest}, std::array{highest, top}}) {
        const Alignment next =
            aligner.from(reference.y()[other] - profile.y()[own], reference.z()[other] - profile.z()[own]);
        if (aligner.cost(next) < aligner.cost(best)) best = next;
    }
    aligner.require_fixed(best, parts);
    return best;
}

}  // namespace rollbem
