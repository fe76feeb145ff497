// The outline of a normal contact to second order in the size of its cells, and its peak pressure.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/in_place_lu.hpp"
#include "../../scene/patch_contact.hpp"
#include "../normal_contact.hpp"

namespace rollbem::detail {

/// Place of an edge, in cells from the centre of cell 0, and whether the pressures determine it. They do not if they
/// are few, or if their course has no zero nearby, as across joints of a profile's arcs.
struct Edge {
    double place;
    bool known;
};

/// A polynomial by least squares at the centres of cells with pressure along a line, counted from its edge inwards: the
/// factors common to all lines with the same number of cells.
struct EdgeFit {
    using Vector = Eigen::Matrix<double, 5, 1>;
    using Matrix = Eigen::Matrix<double, 5, 5>;
    Eigen::Index skip, used, terms;  // number of cells left out at both ends; used cells; terms
    double middle, scale;
    std::vector<double> weights;          // weights of the cells
    Matrix factors = Matrix::Identity();  // factors of the normal equations
    std::array<Eigen::Index, 5> swaps{};
    Vector of_inverse = Vector::Zero();  // the polynomial of 1 over the distance

    explicit EdgeFit(Eigen::Index count)
        : skip(count < 7 ? 1 : 2),
          used(count - 2 * skip),
          terms(used < 6 ? 3 : 5),
          middle(double(count - 1) / 2),
          scale((std::max)(middle, 1.0)) {
        if (!is_known()) return;
        for (Eigen::Index i = 0; i < count; ++i) weights.push_back(1 / (1 + std::pow(double(i) / 16, 4)));
        factors.topLeftCorner(terms, terms).setZero();
        for (Eigen::Index i = skip; i < skip + used; ++i) {
            const std::array<double, 5> values = powers(i);
            for (Eigen::Index r = 0; r < terms; ++r) {
                const double weighted = weights[std::size_t(i)] * values[std::size_t(r)];
                for (Eigen::Index k = 0; k < terms; ++k) factors(r, k) += weighted * values[std::size_t(k)];
                of_inverse[r] += weighted / (double(i) + 0.5);
            }
        }
        factorise_in_place<double>(factors, swaps.data());
        solve_in_place<double>(factors, swaps.data(), of_inverse);
    }

    bool is_known() const { return used >= terms; }

    std::array<double, 5> powers(Eigen::Index i) const {
        const double t = (double(i) - middle) / scale;
        return {1, t, t * t, t * t * t, t * t * t * t};
    }

    template <class Squares>
    Vector polynomial(const Squares& squares) const {
        Vector c = Vector::Zero();
        for (Eigen::Index i = skip; i < skip + used; ++i) {
            const std::array<double, 5> values = powers(i);
            for (Eigen::Index r = 0; r < terms; ++r) {
                c[r] += weights[std::size_t(i)] * values[std::size_t(r)] * squares(i);
            }
        }
        Matrix own = factors;  // a copy, as the solution by reference overwrites it
        solve_in_place<double>(own, swaps.data(), c);
        return c;
    }
};

/// Fits of lines on usual grids.
inline const std::vector<EdgeFit>& usual_edge_fits() {
    static const std::vector<EdgeFit> fits = [] {
        std::vector<EdgeFit> made;
        for (Eigen::Index count = 0; count <= 64; ++count) made.emplace_back(count);
        return made;
    }();
    return fits;
}

/// Place of the edge on a line of cells: distance of the edge behind the centre of the first cell with pressure,
/// between -1/2 (inside) and 1. The square of the pressure is nearly a polynomial that vanishes at the edge, but a cell
/// is either in contact or not; the edge inside it must be reconstructed. If a straight contact ends by d beyond its
/// edge, p^2 at the distance t from it is A^2 (t + d + d^2/(4 t)); steps of an oblique border add half of the last
/// term, as the areas of Hertz's contacts confirm. `squares` are the squares of the pressure in the `count` cells with
/// pressure, counted from the edge inwards.
template <class Squares>
Edge edge_distance(const Squares& squares, Eigen::Index count) {
    constexpr double inside = -0.5, outside = 1;
    const std::vector<EdgeFit>& usual = usual_edge_fits();
    std::optional<EdgeFit> other;
    const bool is_usual = std::size_t(count) < usual.size();
    const EdgeFit& fit = is_usual ? usual[std::size_t(count)] : other.emplace(count);
    if (!fit.is_known()) return {0.5, false};
    const double middle = fit.middle, scale = fit.scale;
    EdgeFit::Vector c = fit.polynomial(squares);
    const auto value = [&](double from) {  // value of the polynomial at the distance `from` behind the centre of cell 0
        const double t = (-from - middle) / scale;
        return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4])));
    };
    const auto zero = [&] {
        double low = inside, high = outside;
        for (int k = 0; k < 40; ++k) {
            const double half = (low + high) / 2;
            (value(half) > 0 ? low : high) = half;
        }
        return low;
    };
    const double off = zero() - 0.5;  // distance of the edge behind the edge of cell 0
    c -= (value(inside) - value(-inside)) * off * off / 8 * fit.of_inverse;
    if (!(value(inside) > 0)) return {inside, false};
    if (!(value(outside) < 0)) return {outside, false};
    return {zero(), fit.used > fit.terms};
}

/// Neighbouring cells of a line with pressure, from the first to the last, and the edges of the contact there.
struct Interval {
    Eigen::Index first, last;
    Edge low, high;

    bool contains(Eigen::Index cell) const { return low.place <= double(cell) && double(cell) <= high.place; }
};

/// Intervals on a line of `count` cells.
template <class Pressures>
std::vector<Interval> intervals(const Pressures& p, Eigen::Index count) {
    std::vector<Interval> found;
    for (Eigen::Index first = 0; first < count; ++first) {
        if (!(p(first) > 0)) continue;
        Eigen::Index last = first;
        while (last + 1 < count && p(last + 1) > 0) ++last;
        const auto edge = [&](Eigen::Index from, int step) {
            const auto squares = [&](Eigen::Index i) { return p(from + i * step) * p(from + i * step); };
            const Edge behind = edge_distance(squares, last - first + 1);
            return Edge{double(from) - step * behind.place, behind.known};
        };
        found.push_back({first, last, edge(first, 1), edge(last, -1)});
        first = last;
    }
    return found;
}
inline std::vector<Interval> row_intervals(const Eigen::ArrayXXd& p, Eigen::Index j) {
    return intervals([&](Eigen::Index i) { return p(i, j); }, p.rows());
}
inline std::vector<Interval> column_intervals(const Eigen::ArrayXXd& p, Eigen::Index i) {
    return intervals([&](Eigen::Index j) { return p(i, j); }, p.cols());
}

/// The rectangle around all pressures: x from and to, y from and to.
inline std::array<double, 4> extents(const NormalContact::Cells& grid, const Eigen::ArrayXXd& p) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    double left = infinite, right = -left, bottom = infinite, top = -bottom;
    for (Eigen::Index j = 0; j < grid.ny; ++j) {
        for (const Interval& row : row_intervals(p, j)) {
            left = (std::min)(left, row.low.place);
            right = (std::max)(right, row.high.place);
        }
    }
    for (Eigen::Index i = 0; i < grid.nx; ++i) {
        for (const Interval& column : column_intervals(p, i)) {
            bottom = (std::min)(bottom, column.low.place);
            top = (std::max)(top, column.high.place);
        }
    }
    return {grid.x_0 + left * grid.dx, grid.x_0 + right * grid.dx, grid.y_0 + bottom * grid.dy,
            grid.y_0 + top * grid.dy};
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
    // The slope at an end from three points, without overshoot.
    static double end(double first, double second, double h, double k) {
        const double slope = ((2 * h + k) * first - h * second) / (h + k);
        if (!(slope * first > 0)) return 0;
        return first * second < 0 && std::abs(slope) > 3 * std::abs(first) ? 3 * first : slope;
    }

    std::vector<double> x_, y_, slope_;
};

/// Splits pressures into patches that every row y = const cuts in one interval, heaviest first: each patch is the chain
/// of touching intervals in neighbouring rows that carries most of the remaining load.
inline std::vector<Eigen::ArrayXXd> split_into_patches(Eigen::ArrayXXd p) {
    struct Cut {
        Eigen::Index row, first, last;
        double load;
        std::ptrdiff_t before = -1;
    };
    std::vector<Eigen::ArrayXXd> found;
    for (std::vector<Cut> all;; all.clear()) {
        for (Eigen::Index j = 0; j < p.cols(); ++j) {
            const std::size_t row_end = all.size();
            for (Eigen::Index i = 0; i < p.rows(); ++i) {
                if (!(p(i, j) > 0)) continue;
                Cut here{j, i, i, p(i, j)};
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
                                   [](const Cut& one, const Cut& two) { return one.load < two.load; }) -
                  all.begin();
        Eigen::ArrayXXd& patch = found.emplace_back(Eigen::ArrayXXd::Zero(p.rows(), p.cols()));
        for (; at >= 0; at = all[std::size_t(at)].before) {
            const Cut& cut = all[std::size_t(at)];
            patch.col(cut.row).segment(cut.first, cut.last - cut.first + 1) =
                p.col(cut.row).segment(cut.first, cut.last - cut.first + 1);
        }
        p -= patch;
    }
}

/// Outline of the cells with pressure, which every row y = const must cut in one interval; nothing otherwise, or if
/// fewer than 3 rows have any. Where the border runs along the rows, it is determined by columns.
inline std::optional<PatchContact::Outline> contact_outline(const NormalContact::Cells& grid,
                                                            const Eigen::ArrayXXd& p) {
    std::vector<std::vector<Interval>> columns;
    for (Eigen::Index i = 0; i < grid.nx; ++i) columns.push_back(column_intervals(p, i));
    // the interval of column i that touches the cells first ... last, preferably one that contains cell j
    const auto touching = [&](Eigen::Index i, Eigen::Index first, Eigen::Index last, Eigen::Index j) {
        const Interval* found = nullptr;
        if (i < 0 || i >= grid.nx) return found;
        for (const Interval& column : columns[static_cast<std::size_t>(i)]) {
            if (column.last + 1 < first || column.first > last + 1) continue;
            if (found == nullptr || column.contains(j)) found = &column;
        }
        return found;
    };
    // place where row j, from its cell i by steps of 1 or -1, crosses the border: a mean of the places by the row
    // itself and by columns, weighted by the square of the cosine between each and the border's normal
    const auto crossing = [&](Eigen::Index i, Eigen::Index j, int step, const Edge& row) {
        const Interval *here = nullptr, *next = touching(i, j, j, j);
        for (i -= step; next != nullptr && next->contains(j); i += step) {
            here = next;
            next = touching(i + 2 * step, here->first, here->last, j);
        }
        if (here == nullptr || next == nullptr) return row.place;
        const bool above = next->high.place < double(j);
        const Edge &inner = above ? here->high : here->low, &outer = above ? next->high : next->low;
        if (!inner.known || !outer.known) return row.place;
        const double slope = std::abs(inner.place - outer.place),
                     column = double(i) + step * std::abs(inner.place - double(j)) / slope, weight = slope * slope;
        return row.known ? (row.place * weight + column) / (weight + 1) : column;
    };
    std::vector<double> y, square, middle;
    std::vector<Interval> rows;
    Eigen::Index first_row = -1;
    for (Eigen::Index j = 0; j < grid.ny; ++j) {
        const std::vector<Interval> row = row_intervals(p, j);
        if (row.empty()) continue;
        if (first_row < 0) first_row = j;
        if (row.size() > 1 || j != first_row + Eigen::Index(rows.size())) return std::nullopt;
        rows.push_back(row[0]);
        const Eigen::Index centre = (row[0].first + row[0].last) / 2;
        const double x_1 = crossing(centre, j, -1, row[0].low), x_2 = crossing(centre, j, 1, row[0].high);
        y.push_back(grid.y(j));
        square.push_back(std::pow((x_2 - x_1) * grid.dx, 2));
        middle.push_back(grid.x_0 + (x_1 + x_2) / 2 * grid.dx);
    }
    if (rows.size() < 3) return std::nullopt;
    // the end in y beyond row j, from the column that reaches farthest; if no column determines it, from the lengths of
    // the outermost rows, whose squares are nearly linear there
    const auto end = [&](const Interval& row, Eigen::Index j, int side, double last, double before) {
        Edge farthest{-1, false};
        for (Eigen::Index i = row.first; i <= row.last; ++i) {
            const Interval& column = *touching(i, j, j, j);
            const Edge& edge = side > 0 ? column.high : column.low;
            const double beyond = side * (edge.place - double(j));
            if (beyond > farthest.place) farthest = {beyond, edge.known};
        }
        const double by_rows = last < before / 2 ? last / (before - last) : 1;
        if (!farthest.known || std::abs(farthest.place - by_rows) > 0.5) farthest.place = by_rows;
        return farthest.place * grid.dy;
    };
    const std::size_t n = rows.size();
    const double low = y[0] - end(rows[0], first_row, -1, square[0], square[1]),
                 high = y[n - 1] + end(rows[n - 1], first_row + Eigen::Index(n) - 1, 1, square[n - 1], square[n - 2]);
    // an outermost row of cells may lie beyond the end
    const double least = 0.02 * grid.dy;
    const std::size_t begin = y[0] - low < least ? 1 : 0, stop = high - y[n - 1] < least ? n - 1 : n;
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
    return PatchContact::Outline(at, trailing, leading);
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
