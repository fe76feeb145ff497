// Measures of computed curves by which claims are judged: optima, crossings, rates, oscillation.
// All take points (x, y) with ascending x.
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace paper {

using Points = std::vector<std::pair<double, double>>;

/// The points whose x is in `grid`.
inline Points on_grid(const Points& points, const std::vector<double>& grid) {
    Points result;
    for (const auto& point : points) {
        const auto is_x = [&](double x) { return std::abs(x - point.first) < 1e-9; };
        if (std::any_of(grid.begin(), grid.end(), is_x)) result.push_back(point);
    }
    return result;
}

/// The points with low <= x <= high.
inline Points within(const Points& points, double low, double high) {
    Points result;
    for (const auto& point : points) {
        if (point.first > low - 1e-9 && point.first < high + 1e-9) result.push_back(point);
    }
    return result;
}

/// y at x; not a number if there is no such point.
inline double value_at(const Points& points, double x) {
    const Points there = within(points, x, x);
    return there.empty() ? std::numeric_limits<double>::quiet_NaN() : there.front().second;
}

/// Deviation from 1 at x, signed.
inline double error_at(const Points& points, double x) { return value_at(points, x) - 1; }

/// The point whose y is nearest to 1; values that are not numbers are skipped.
inline std::pair<double, double> best(const Points& points) {
    std::pair<double, double> result{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
    for (const auto& point : points) {
        if (std::abs(point.second - 1) < std::abs(result.second - 1)) result = point;
    }
    return result;
}

/// |y - 1| of the best point.
inline double least_error(const Points& points) { return std::abs(best(points).second - 1); }

/// All y.
inline Eigen::ArrayXd values(const Points& points) {
    Eigen::ArrayXd y(std::ssize(points));
    std::transform(points.begin(), points.end(), y.begin(), [](const auto& point) { return point.second; });
    return y;
}

/// Largest and mean |y - 1|.
inline double largest_error(const Points& points) { return (values(points) - 1).abs().maxCoeff(); }
inline double mean_error(const Points& points) { return (values(points) - 1).abs().mean(); }

/// Largest |difference of y| of two curves with the same x.
inline double largest_difference(const Points& first, const Points& second) {
    if (first.size() != second.size()) return std::numeric_limits<double>::infinity();
    return (values(first) - values(second)).abs().maxCoeff();
}

/// Largest |difference| of two matrices over the largest entry.
inline double relative_difference(const Eigen::MatrixXd& first, const Eigen::MatrixXd& second) {
    return (first - second).cwiseAbs().maxCoeff() / second.cwiseAbs().maxCoeff();
}

/// Largest minus smallest y.
inline double spread(const Points& points) { return values(points).maxCoeff() - values(points).minCoeff(); }

/// Largest difference of y from one point to the next.
inline double largest_jump(const Points& points) {
    return largest_difference({points.begin(), points.end() - 1}, {points.begin() + 1, points.end()});
}

/// Every x at which y passes through 1, interpolated linearly.
inline std::vector<double> crossings(const Points& points) {
    std::vector<double> result;
    const double none = std::numeric_limits<double>::quiet_NaN();
    double before = 0, x_before = 0, met = none;  // the last point that is not on 1, and one on 1 after it
    for (const auto& [x, y] : points) {
        const double here = y - 1;
        if (here == 0) {
            met = x;
            continue;
        }
        if (before * here < 0)
            result.push_back(std::isnan(met) ? x_before + (x - x_before) * before / (before - here) : met);
        before = here;
        x_before = x;
        met = none;
    }
    return result;
}

/// The smallest x with y > 0.
inline std::optional<double> first_positive(const Points& points) {
    for (const auto& point : points) {
        if (point.second > 0) return point.first;
    }
    return std::nullopt;
}

/// Exponent q of y ~ x^q by least squares in logarithms, of |y|.
inline double power(const Points& points) {
    Eigen::ArrayXd x(std::ssize(points));
    std::transform(points.begin(), points.end(), x.begin(), [](const auto& point) { return std::log(point.first); });
    x -= x.mean();
    return (x * values(points).abs().log()).sum() / x.square().sum();
}

/// Oscillation of a distribution: total variation over the difference of largest and smallest value, minus 1. Zero for
/// a monotone distribution such as Carter's; each reversal adds twice its height.
inline double oscillation(const Eigen::Ref<const Eigen::ArrayXd>& values) {
    const Eigen::Index steps = values.size() - 1;
    const double variation = (values.tail(steps) - values.head(steps)).abs().sum();
    return variation / (values.maxCoeff() - values.minCoeff()) - 1;
}

/// The x in [low, high] with the smallest |f - 1|: the best of 41 points, then of 41 around it, to within 1e-6.
template <class Function>
double true_optimum(const Function& f, double low, double high) {
    double optimum = low;
    while (high - low > 1e-6) {
        const double step = (high - low) / 40;
        double least = std::numeric_limits<double>::infinity();
        for (int k = 0; k <= 40; ++k) {
            const double error = std::abs(f(low + k * step) - 1);
            if (error < least) {
                least = error;
                optimum = low + k * step;
            }
        }
        const double first = low, last = high;
        low = std::max(first, optimum - step);
        high = std::min(last, optimum + step);
    }
    return optimum;
}

}  // namespace paper
