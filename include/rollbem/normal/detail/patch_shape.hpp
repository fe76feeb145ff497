// The outline of a normal contact to second order in the size of its cells, and its peak pressure.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/in_place_lu.hpp"
#include "../../scene/outline.hpp"
#include "../normal_contact.hpp"

namespace rollbem::detail {

/// Along a line of cells the square of the pressure is nearly a polynomial that vanishes at the edge. `squares` are
/// those of the `count` cells with pressure, in units of the cell. The result is the place of the edge behind cell 0,
/// as the distance from its centre, between -1/2 (inside) and 1; `squares` count from that edge inwards.
template <class Squares>
double edge_distance(const Squares& squares, Eigen::Index count) {
    constexpr double inside = -0.5, outside = 1;
    const Eigen::Index skip = count < 7 ? 1 : 2, used = count - 2 * skip, degree = count < 7 ? 2 : 4;
    if (used <= degree) {  // a parabola that has its zeros half a cell outside, or none
        return 0.5;
    }
    const double middle = double(count - 1) / 2, scale = (std::max)(middle, 1.0);
    Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
    Eigen::Matrix<double, 5, 1> right = Eigen::Matrix<double, 5, 1>::Zero();
    for (Eigen::Index i = skip; i < count - skip; ++i) {
        const double t = (double(i) - middle) / scale, weight = 1 / (1 + std::pow(double(i) / 12, 4));
        double powers[5] = {1, t, t * t, t * t * t, t * t * t * t};
        for (Eigen::Index r = 0; r <= degree; ++r) {
            for (Eigen::Index c = 0; c <= degree; ++c) normal(r, c) += weight * powers[r] * powers[c];
            right[r] += weight * powers[r] * squares(i);
        }
    }
    for (Eigen::Index r = degree + 1; r < 5; ++r) normal(r, r) = 1;
    Eigen::Index swaps[5];
    factorise_in_place<double>(normal, swaps);
    solve_in_place<double>(normal, swaps, right);
    const Eigen::Matrix<double, 5, 1>& c = right;
    const auto value = [&](double from) {  // at the distance `from` behind the centre of cell 0
        const double t = (-from - middle) / scale;
        return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4])));
    };
    if (!(value(inside) > 0)) return inside;
    if (!(value(outside) < 0)) return outside;
    double low = inside, high = outside;
    for (int k = 0; k < 40; ++k) {
        const double half = (low + high) / 2;
        (value(half) > 0 ? low : high) = half;
    }
    return low;
}

/// Fritsch and Carlson's monotone cubic.
class MonotoneCubic {
public:
    MonotoneCubic(std::vector<double> x, std::vector<double> y)
        : x_(std::move(x)), y_(std::move(y)), slope_(x_.size(), 0) {
        const std::size_t n = x_.size();
        const auto chord = [&](std::size_t i) { return (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]); };
        for (std::size_t i = 1; i + 1 < n; ++i) {
            const double before = chord(i - 1), after = chord(i);
            if (!(before * after > 0)) continue;
            const double h = x_[i] - x_[i - 1], k = x_[i + 1] - x_[i];
            slope_[i] = 3 * (h + k) / ((2 * k + h) / before + (k + 2 * h) / after);
        }
        slope_[0] = end(chord(0), chord(1), x_[1] - x_[0], x_[2] - x_[1]);
        slope_[n - 1] = end(chord(n - 2), chord(n - 3), x_[n - 1] - x_[n - 2], x_[n - 2] - x_[n - 3]);
    }

    double operator()(double x) const {
        const auto next = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
        const auto i = static_cast<std::size_t>(next - x_.begin()) - 1;
        const double h = x_[i + 1] - x_[i], t = (x - x_[i]) / h, u = 1 - t;
        return u * u * (1 + 2 * t) * y_[i] + t * t * (1 + 2 * u) * y_[i + 1] +
               h * t * u * (u * slope_[i] - t * slope_[i + 1]);
    }

private:
    // three points, but no overshoot
    static double end(double first, double second, double h, double k) {
        const double slope = ((2 * h + k) * first - h * second) / (h + k);
        if (!(slope * first > 0)) return 0;
        return first * second < 0 && std::abs(slope) > 3 * std::abs(first) ? 3 * first : slope;
    }

    std::vector<double> x_, y_, slope_;
};

/// Pressures as pieces that every row y = const cuts in one interval, heaviest first: each is the chain of intervals in
/// neighbouring rows that touch which carries most of what is left.
inline std::vector<Eigen::ArrayXXd> pieces(Eigen::ArrayXXd p) {
    struct Interval {
        Eigen::Index row, first, last;
        double load;
        std::ptrdiff_t before = -1;
    };
    std::vector<Eigen::ArrayXXd> found;
    for (std::vector<Interval> all;; all.clear()) {
        for (Eigen::Index j = 0; j < p.cols(); ++j) {
            const std::size_t row_end = all.size();
            for (Eigen::Index i = 0; i < p.rows(); ++i) {
                if (!(p(i, j) > 0)) continue;
                Interval here{j, i, i, p(i, j)};
                while (here.last + 1 < p.rows() && p(here.last + 1, j) > 0) here.load += p(++here.last, j);
                i = here.last;
                double most = 0;
                for (std::size_t k = row_end; k-- > 0 && all[k].row >= j - 1;) {
                    if (all[k].row == j || all[k].first > here.last + 1 || all[k].last + 1 < here.first) continue;
                    if (all[k].load > most) here.before = std::ptrdiff_t(k);
                    most = (std::max)(most, all[k].load);
                }
                here.load += most;
                all.push_back(here);
            }
        }
        if (all.empty()) return found;
        auto at = std::max_element(all.begin(), all.end(),
                                   [](const Interval& one, const Interval& two) { return one.load < two.load; }) -
                  all.begin();
        Eigen::ArrayXXd& piece = found.emplace_back(Eigen::ArrayXXd::Zero(p.rows(), p.cols()));
        for (; at >= 0; at = all[std::size_t(at)].before) {
            const Interval& cut = all[std::size_t(at)];
            piece.col(cut.row).segment(cut.first, cut.last - cut.first + 1) =
                p.col(cut.row).segment(cut.first, cut.last - cut.first + 1);
        }
        p -= piece;
    }
}

/// Of the cells with pressure, which every row y = const cuts in one interval; nothing otherwise, or if fewer than 3
/// rows have any.
inline std::optional<Outline<double>> contact_outline(const CellGrid& grid, const Eigen::ArrayXXd& p) {
    std::vector<double> y, square, middle;
    Eigen::Index first_row = -1, last_row = -1;
    struct Row {
        Eigen::Index first, last;
    };
    std::vector<Row> rows;
    for (Eigen::Index j = 0; j < grid.ny; ++j) {
        Eigen::Index first = -1, last = -1, count = 0;
        for (Eigen::Index i = 0; i < grid.nx; ++i) {
            if (!(p(i, j) > 0)) continue;
            if (first < 0) first = i;
            last = i;
            ++count;
        }
        if (first < 0) {
            if (first_row >= 0 && last_row < 0) last_row = j - 1;
            continue;
        }
        if (last_row >= 0 || count != last - first + 1) return std::nullopt;
        if (first_row < 0) first_row = j;
        rows.push_back({first, last});
        const double behind = edge_distance([&](Eigen::Index i) { return p(first + i, j) * p(first + i, j); }, count),
                     ahead = edge_distance([&](Eigen::Index i) { return p(last - i, j) * p(last - i, j); }, count);
        const double x_1 = grid.x(first) - behind * grid.dx, x_2 = grid.x(last) + ahead * grid.dx;
        y.push_back(grid.y(j));
        square.push_back((x_2 - x_1) * (x_2 - x_1));
        middle.push_back((x_1 + x_2) / 2);
    }
    if (rows.size() < 3) return std::nullopt;
    if (last_row < 0) last_row = grid.ny - 1;
    // the ends in y, along the columns that reach farthest
    const auto end = [&](const Row& outermost, bool high) {
        double farthest = -1;
        const Eigen::Index centre = (outermost.first + outermost.last) / 2;
        for (Eigen::Index i = std::max<Eigen::Index>(centre - 1, 0); i <= (std::min)(centre + 1, grid.nx - 1); ++i) {
            Eigen::Index low = first_row, top = last_row;
            while (low <= last_row && !(p(i, low) > 0)) ++low;
            while (top >= first_row && !(p(i, top) > 0)) --top;
            if (top < low) continue;
            const Eigen::Index edge = high ? top : low;
            const double beyond = edge_distance(
                [&](Eigen::Index j) { return std::pow(p(i, high ? top - j : low + j), 2); }, top - low + 1);
            farthest = (std::max)(farthest, (high ? double(edge - last_row) : double(first_row - edge)) + beyond);
        }
        return farthest * grid.dy;
    };
    double low = y.front() - end(rows.front(), false), high = y.back() + end(rows.back(), true);
    // an outermost row of cells may lie beyond the end: then the squares of its pressures do not fit those of the next
    // row
    const auto beyond = [&](Eigen::Index row, Eigen::Index next, double inside) {
        return inside < 0.02 * grid.dy && 5 * p.col(row).square().maxCoeff() < p.col(next).square().maxCoeff();
    };
    const std::size_t begin = beyond(first_row, first_row + 1, y.front() - low) ? 1 : 0,
                      stop = y.size() - (beyond(last_row, last_row - 1, high - y.back()) ? 1 : 0);
    if (begin == 0) low = (std::min)(low, y.front() - 0.02 * grid.dy);
    if (stop == y.size()) high = (std::max)(high, y.back() + 0.02 * grid.dy);
    if (stop < begin + 2) return std::nullopt;
    const auto between = [&](std::vector<double>& of, double first, double last) {
        of.resize(stop);
        of.erase(of.begin(), of.begin() + std::ptrdiff_t(begin));
        of.insert(of.begin(), first);
        of.push_back(last);
    };
    between(y, low, high);
    between(square, 0, 0);
    between(middle, middle[begin], middle[stop - 1]);
    const MonotoneCubic squares(y, square), middles(y, middle);
    constexpr Eigen::Index lines = 241;
    Eigen::ArrayXd at(lines), trailing(lines), leading(lines);
    for (Eigen::Index k = 0; k < lines; ++k) {
        const bool tip = k == 0 || k == lines - 1;
        at[k] = k == 0 ? low
                : k == lines - 1
                    ? high
                    : (low + high) / 2 - (high - low) / 2 * std::cos(std::numbers::pi * double(k) / (lines - 1));
        const double half = tip ? 0 : (std::max)(std::sqrt((std::max)(squares(at[k]), 0.0)) / 2, 1e-6 * grid.dx),
                     x = middles(at[k]);
        trailing[k] = x - half;
        leading[k] = x + half;
    }
    return Outline<double>(at, trailing, leading);
}

/// The largest pressure: the square of the pressure is nearly quadratic about its largest cell.
inline double peak_pressure(const Eigen::ArrayXXd& p) {
    Eigen::Index i, j;
    const double largest = p.maxCoeff(&i, &j), square = largest * largest;
    double peak = square;
    const auto rise = [&](double before, double after) {
        const double bend = 2 * square - before * before - after * after, slope = (after * after - before * before) / 2;
        return before > 0 && after > 0 && bend > 0 ? slope * slope / (2 * bend) : 0;
    };
    if (i > 0 && i + 1 < p.rows()) peak += rise(p(i - 1, j), p(i + 1, j));
    if (j > 0 && j + 1 < p.cols()) peak += rise(p(i, j - 1), p(i, j + 1));
    return std::sqrt(peak);
}

}  // namespace rollbem::detail
