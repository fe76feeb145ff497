// Polylines of a section: their turns and corners, and curves through noisy points.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace rollbem::detail {

inline constexpr double degrees = std::numbers::pi / 180;

/// Largest turn of a polyline that is not folded back [rad].
inline constexpr double fold = 150 * degrees;

/// The angle by which a polyline turns from the step a to the step b [rad], positive from y towards z.
inline double turn(std::array<double, 2> a, std::array<double, 2> b) {
    return std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
}

/// Lengths from the first point to each point [m].
inline Eigen::ArrayXd lengths_along(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z) {
    Eigen::ArrayXd s = Eigen::ArrayXd::Zero(y.size());
    for (Eigen::Index i = 1; i < y.size(); ++i) s[i] = s[i - 1] + std::hypot(y[i] - y[i - 1], z[i] - z[i - 1]);
    return s;
}

/// The turn at each point [rad]; 0 at both ends.
inline Eigen::ArrayXd turns_at(const Eigen::ArrayXd& y, const Eigen::ArrayXd& z) {
    Eigen::ArrayXd turns = Eigen::ArrayXd::Zero(y.size());
    for (Eigen::Index i = 1; i + 1 < y.size(); ++i) {
        turns[i] = turn({y[i] - y[i - 1], z[i] - z[i - 1]}, {y[i + 1] - y[i], z[i + 1] - z[i]});
    }
    return turns;
}

/// The numbers of points at corners, growing. At a corner the polyline turns by more than 30 degrees, and by at most 6
/// at every other point within 2 mm of it; rounder or rougher places are not corners. (The rule of CONTACT.)
inline std::vector<Eigen::Index> corners_of(const Eigen::ArrayXd& s, const Eigen::ArrayXd& turns) {
    const auto alone = [&](Eigen::Index i, Eigen::Index step) {
        for (Eigen::Index k = i + step; k > 0 && k + 1 < s.size(); k += step) {
            if (std::abs(s[k] - s[i]) > 2e-3) break;
            if (std::abs(turns[k]) > 6 * degrees) return false;
        }
        return true;
    };
    std::vector<Eigen::Index> corners;
    for (Eigen::Index i = 1; i + 1 < s.size(); ++i) {
        if (std::abs(turns[i]) > 30 * degrees && alone(i, -1) && alone(i, 1)) corners.push_back(i);
    }
    return corners;
}

/// Second derivatives at the points of the cubic splines through f(s) between corners: 0 at corners; at a free end the
/// third derivative is the same on both sides of the next point, or the second is 0 where a corner is too near.
inline Eigen::ArrayXd spline_bends(const Eigen::ArrayXd& s, const Eigen::ArrayXd& f,
                                   const std::vector<Eigen::Index>& corners) {
    const Eigen::Index n = s.size();
    Eigen::ArrayXd m = Eigen::ArrayXd::Zero(n), diagonal(n), upper(n);
    const auto h = [&](Eigen::Index i) { return s[i + 1] - s[i]; };
    const auto between = [&](Eigen::Index first, Eigen::Index last) {
        const bool enough = last - first > 2, free_first = enough && first == 0, free_last = enough && last == n - 1;
        for (Eigen::Index i = first + 1; i < last; ++i) {
            double lower = i == first + 1 ? 0 : h(i - 1), here = 2 * (h(i - 1) + h(i)),
                   above = i == last - 1 ? 0 : h(i);
            // m_0 = m_1 - (h_0/h_1) (m_2 - m_1) and its mirror image, put into the equations of the inner points
            if (i == first + 1 && free_first) {
                const double r = h(i - 1) / h(i);
                here += h(i - 1) * (1 + r);
                above -= h(i - 1) * r;
            }
            if (i == last - 1 && free_last) {
                const double r = h(i) / h(i - 1);
                here += h(i) * (1 + r);
                lower -= h(i) * r;
            }
            const double right = 6 * ((f[i + 1] - f[i]) / h(i) - (f[i] - f[i - 1]) / h(i - 1));
            const double share = i == first + 1 ? 0 : lower / diagonal[i - 1];
            diagonal[i] = here - (i == first + 1 ? 0 : share * upper[i - 1]);
            upper[i] = above;
            m[i] = right - (i == first + 1 ? 0 : share * m[i - 1]);
        }
        for (Eigen::Index i = last - 1; i > first; --i) {
            m[i] = (m[i] - (i == last - 1 ? 0 : upper[i] * m[i + 1])) / diagonal[i];
        }
        if (free_first) m[0] = m[1] - h(0) / h(1) * (m[2] - m[1]);
        if (free_last) m[n - 1] = m[n - 2] + h(n - 2) / h(n - 3) * (m[n - 2] - m[n - 3]);
    };
    Eigen::Index first = 0;
    for (const Eigen::Index corner : corners) {
        between(first, corner);
        first = corner;
    }
    between(first, n - 1);
    return m;
}

/// The curve f(s) between corners that minimises the sum of w_i (f(s_i) - f_i)^2 and lambda times the integral of
/// f''^2, for each of both coordinates, at the points (Reinsch 1967). w_i is the length that belongs to a point, and
/// lambda = (wave_length/2 pi)^4, so that waves of this length are halved.
inline std::array<Eigen::ArrayXd, 2> smooth_curve(const Eigen::ArrayXd& s, const std::vector<Eigen::Index>& corners,
                                                  const std::array<Eigen::ArrayXd, 2>& curve, double wave_length) {
    using Sparse = Eigen::SparseMatrix<double>;
    const Eigen::Index n = s.size();
    const double lambda = std::pow(wave_length / (2 * std::numbers::pi), 4);
    // f'' is linear between the points that are not corners, each of which has a column of Q and a row of R: f = values
    // - lambda W^-1 Q f'', (R + lambda Q^T W^-1 Q) f'' = Q^T values
    std::vector<Eigen::Triplet<double>> q, r;
    Eigen::Index column = 0, before = 0;
    for (Eigen::Index i = 1; i + 1 < n; ++i) {
        if (std::binary_search(corners.begin(), corners.end(), i)) continue;
        const double left = s[i] - s[i - 1], right = s[i + 1] - s[i];
        q.emplace_back(i - 1, column, 1 / left);
        q.emplace_back(i, column, -1 / left - 1 / right);
        q.emplace_back(i + 1, column, 1 / right);
        r.emplace_back(column, column, (left + right) / 3);
        if (before == i - 1 && column > 0) {
            r.emplace_back(column, column - 1, left / 6);
            r.emplace_back(column - 1, column, left / 6);
        }
        before = i;
        ++column;
    }
    if (column == 0) return curve;
    Sparse Q(n, column), R(column, column);
    Q.setFromTriplets(q.begin(), q.end());
    R.setFromTriplets(r.begin(), r.end());
    Eigen::VectorXd over_weights(n);  // lambda W^-1
    for (Eigen::Index i = 0; i < n; ++i) {
        over_weights[i] = 2 * lambda / (s[(std::min)(i + 1, n - 1)] - s[(std::max<Eigen::Index>)(i - 1, 0)]);
    }
    const Sparse spread = over_weights.asDiagonal() * Q;
    const Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> solver(R + Sparse(Q.transpose()) *
                                                                                                  spread);
    std::array<Eigen::ArrayXd, 2> smooth;
    for (std::size_t k = 0; k < 2; ++k) {
        const Eigen::VectorXd bends = solver.solve(Q.transpose() * curve[k].matrix());
        smooth[k] = curve[k] - (spread * bends).array();
    }
    return smooth;
}

}  // namespace rollbem::detail
