// The smooth part of a kernel, integrated for all entries of G or G': by interpolation over the whole contact where its
// singularities are far, by quadrature for each entry where the strip is too narrow for that.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/gauss_legendre.hpp"
#include "../../types.hpp"
#include "entries.hpp"
#include "kernel_view.hpp"

namespace rollbem::detail {

/// Adds int w(tau) e^{(q)}(d + tau) dtau, see Entries, of a smooth part e whose singularities lie at +-i b and beyond.
/// Both ways are accurate to rounding of the largest e^{(q)}. Far behind a narrow strip it cancels the logarithm: G' then
/// errs by some eps/b, and nothing is left to trust below least_width(), where entries are NaN. Keeps references to its
/// arguments.
template <class Scalar>
class SmoothPart {
public:
    SmoothPart(const Entries<Scalar>& entries, const KernelView<Scalar>& kernel)
        : entries_(entries), kernel_(kernel), b_(kernel.split.distance) {}

    void add(MatrixX<Scalar>& result) const {
        if (!is_finite(b_)) return;
        if (b_ < least_width()) {
            std::fill_n(result.data(), result.size(), std::numeric_limits<Scalar>::quiet_NaN());
            return;
        }
        // a single element as long as the intervals of the rows: all means may be taken over it
        const int of_rows = entries_.equal_widths && result.cols() == 1 ? 0 : entries_.averages;
        const Points rows(entries_.rows.from_trailing + entries_.rows.offset, entries_.rows.half, of_rows),
            columns(entries_.columns.from_trailing, entries_.columns.half, 1 + entries_.averages - of_rows);
        const Scalar row_terms = terms(rows.reach), column_terms = terms(columns.reach);
        const Scalar size = static_cast<Scalar>(result.size()), width = static_cast<Scalar>(result.cols());
        const Scalar products = row_terms * column_terms * (row_terms + column_terms + width) + row_terms * size;
        if (products <= 200 * size) {  // an integral takes as long as some 200 products
            interpolate(rows, static_cast<Eigen::Index>(row_terms), columns, static_cast<Eigen::Index>(column_terms),
                        result);
        } else {
            integrate(result);
        }
    }

    /// b/a at which eps/b is 10^-6 in double, 2 * 10^-3 in float.
    static Scalar least_width() { return std::pow(std::numeric_limits<Scalar>::epsilon(), Scalar(0.625)); }

private:
    using Chunk = typename Entries<Scalar>::Chunk;
    static constexpr Eigen::Index chunk = Entries<Scalar>::chunk;

    // Points, the halves of the intervals about them over which a mean is taken `averages` times, and the interval that
    // these cover: reach to both sides of the middle.
    struct Points {
        ArrayX<Scalar> places;
        const ArrayX<Scalar>& half;
        int averages;
        Scalar middle, reach, longest;

        Points(ArrayX<Scalar> x, const ArrayX<Scalar>& h, int count)
            : places(std::move(x)), half(h), averages(count), longest(half.maxCoeff()) {
            const Scalar spread = Scalar(averages) * longest;
            const Scalar first = places.minCoeff() - spread, last = places.maxCoeff() + spread;
            middle = (first + last) / 2;
            reach = (std::max)((last - first) / 2, longest);
        }
    };

    // The number of Chebyshev polynomials that represent e^{(q)} over +-reach to rounding: the ellipse with these foci
    // and the minor half-axis b has all singularities outside or on it, and coefficient n decreases like rho^-n, where
    // ln(rho) = asinh(b/reach).
    Scalar terms(Scalar reach) const {
        const Scalar digits = 2 - std::log(std::numeric_limits<Scalar>::epsilon());  // the 2 for the tail of the series
        return (std::max)(Scalar(2), std::ceil(digits / std::asinh(b_ / reach)));
    }

    // T_k at the nodes of order `count`: row k, node by column.
    static MatrixX<Scalar> polynomials(Eigen::Index count) {
        MatrixX<Scalar> values(count, count);
        const Scalar step = std::numbers::pi_v<Scalar> / static_cast<Scalar>(2 * count);
        for (Eigen::Index i = 0; i < count; ++i) {
            const Scalar t = std::cos(static_cast<Scalar>(2 * i + 1) * step);
            values(0, i) = 1;
            values(1, i) = t;
            for (Eigen::Index k = 2; k < count; ++k) values(k, i) = 2 * t * values(k - 1, i) - values(k - 2, i);
        }
        return values;
    }

    // The means of T_k over the intervals of the points: row by point, column k.
    MatrixX<Scalar> means(const Points& points, Eigen::Index count) const {
        const Eigen::Index order = points.averages > 0 ? static_cast<Eigen::Index>(terms(points.longest) + 1) / 2 : 1;
        const QuadratureRule<Scalar> rule = gauss_legendre<Scalar>(order);
        const Eigen::Index size = points.places.size();
        Eigen::Index sample_count = 1;
        for (int a = 0; a < points.averages; ++a) sample_count *= order;
        MatrixX<Scalar> result(size, count), work(size, 3);
        std::fill_n(result.data(), result.size(), Scalar(0));
        Scalar *const t = work.data(), *const value = t + size, *const before = value + size;
        for (Eigen::Index sample = 0; sample < sample_count; ++sample) {
            Scalar shift = 0, weight = 1;
            Eigen::Index digits = sample;  // to the base of the order
            for (int a = 0; a < points.averages; ++a, digits /= order) {
                shift += rule.nodes[digits % order];
                weight *= rule.weights[digits % order] / 2;
            }
            for (Eigen::Index i = 0; i < size; ++i) {
                t[i] = (points.places[i] - points.middle + shift * points.half[i]) / points.reach;
                before[i] = t[i];  // T_-1
                value[i] = 1;
            }
            for (Eigen::Index k = 0; k < count; ++k) {
                Scalar* const mean = result.data() + k * size;
                for (Eigen::Index i = 0; i < size; ++i) {
                    mean[i] += weight * value[i];
                    const Scalar next = 2 * t[i] * value[i] - before[i];
                    before[i] = value[i];
                    value[i] = next;
                }
            }
        }
        return result;
    }

    // e^{(q)}(x - y) = sum c_jk T_j(x) T_k(y), with x within the rows and y within the columns
    void interpolate(const Points& rows, Eigen::Index row_terms, const Points& columns, Eigen::Index column_terms,
                     MatrixX<Scalar>& result) const {
        const MatrixX<Scalar> along = polynomials(row_terms), across = polynomials(column_terms);
        ArrayX<Scalar> samples(row_terms * column_terms);
        for (Eigen::Index j = 0; j < column_terms; ++j) {
            for (Eigen::Index i = 0; i < row_terms; ++i) {
                samples[j * row_terms + i] =
                    rows.middle - columns.middle + (rows.reach * along(1, i) - columns.reach * across(1, j));
            }
        }
        kernel_.evaluate(entries_.slope(), samples);
        const Scalar scale = Scalar(4) / static_cast<Scalar>(row_terms * column_terms);
        MatrixX<Scalar> values(row_terms, column_terms);
        for (Eigen::Index i = 0; i < samples.size(); ++i) values.data()[i] = scale * samples[i];
        MatrixX<Scalar> half = product(values, transposed(across)), coefficients = product(along, half);
        for (Eigen::Index k = 0; k < column_terms; ++k) coefficients(0, k) /= 2;
        for (Eigen::Index j = 0; j < row_terms; ++j) coefficients(j, 0) /= 2;
        MatrixX<Scalar> integrals = transposed(means(columns, column_terms));
        for (Eigen::Index m = 0; m < integrals.cols(); ++m) {
            for (Eigen::Index k = 0; k < column_terms; ++k) integrals(k, m) *= 2 * columns.half[m];
        }
        add_product(means(rows, row_terms), product(coefficients, integrals), result);
    }

    // Adds a b to the result, which may have fewer rows. Far less to compile than Eigen's product, and as fast for few
    // terms.
    static void add_product(const MatrixX<Scalar>& a, const MatrixX<Scalar>& b, MatrixX<Scalar>& result) {
        const Eigen::Index height = a.rows(), terms = a.cols(), rows = result.rows();
        for (Eigen::Index m = 0; m < result.cols(); ++m) {
            const Scalar* const factor = b.data() + m * terms;
            Scalar* const out = result.data() + m * rows;
            Eigen::Index l = 0;
            for (; l + chunk <= rows; l += chunk) {
                Eigen::Map<Chunk> target(out + l);
                Chunk sum = target;
                for (Eigen::Index k = 0; k < terms; ++k) {
                    sum += factor[k] * Eigen::Map<const Chunk>(a.data() + k * height + l);
                }
                target = sum;
            }
            for (Eigen::Index k = 0; k < terms; ++k) {
                for (Eigen::Index i = l; i < rows; ++i) out[i] += factor[k] * a.data()[k * height + i];
            }
        }
    }
    static MatrixX<Scalar> product(const MatrixX<Scalar>& a, const MatrixX<Scalar>& b) {
        MatrixX<Scalar> result(a.rows(), b.cols());
        std::fill_n(result.data(), result.size(), Scalar(0));
        add_product(a, b, result);
        return result;
    }
    static MatrixX<Scalar> transposed(const MatrixX<Scalar>& a) {
        MatrixX<Scalar> result(a.cols(), a.rows());
        for (Eigen::Index j = 0; j < a.cols(); ++j) {
            for (Eigen::Index i = 0; i < a.rows(); ++i) result(j, i) = a(i, j);
        }
        return result;
    }

    void integrate(MatrixX<Scalar>& result) const {
        std::vector<Scalar> places, weights;
        std::vector<std::size_t> ends;
        ArrayX<Scalar> values;
        for (Eigen::Index m = 0; m < result.cols(); ++m) {
            places.clear();
            weights.clear();
            ends.clear();
            for (Eigen::Index l = 0; l < result.rows(); ++l) {
                append(entries_.distance(l, m), entries_.columns.half[m], entries_.rows.half[l], places, weights);
                ends.push_back(places.size());
            }
            values = Eigen::Map<const ArrayX<Scalar>>(places.data(), static_cast<Eigen::Index>(places.size()));
            kernel_.evaluate(entries_.slope(), values);
            std::size_t i = 0;
            for (Eigen::Index l = 0; l < result.rows(); ++l) {
                Scalar sum = 0;
                for (; i < ends[static_cast<std::size_t>(l)]; ++i) {
                    sum += weights[i] * values[static_cast<Eigen::Index>(i)];
                }
                for (int k = 0; k < entries_.averages; ++k) sum /= 2 * entries_.rows.half[l];
                result(l, m) += sum;
            }
        }
    }

    // Points and weights for one entry: w is a polynomial between the sums of +-h and, for each average, +-delta.
    void append(Scalar d, Scalar h, Scalar delta, std::vector<Scalar>& places, std::vector<Scalar>& weights) const {
        const auto panel = [&](const auto& self, Scalar from, Scalar to) -> void {
            const Scalar half = (to - from) / 2, middle = (to + from) / 2, place = d + middle;
            if (!(half > 0)) return;
            const Scalar ratio = (place * place + b_ * b_) / (half * half);
            if (ratio < square(least_distances[0])) {
                self(self, from, middle);
                self(self, middle, to);
                return;
            }
            std::size_t k = 0;
            while (k + 1 < rules().size() && ratio >= square(least_distances[k + 1])) ++k;
            const QuadratureRule<Scalar>& rule = rules()[k];
            for (Eigen::Index i = 0; i < rule.nodes.size(); ++i) {
                const Scalar tau = half * rule.nodes[i];
                places.push_back(place + tau);
                weights.push_back(half * rule.weights[i] * density(std::abs(middle + tau), h, delta));
            }
        };
        const Scalar spread = Scalar(entries_.averages) * delta, outer = h + spread, inner = std::abs(h - spread);
        const Scalar kink = entries_.averages == 2 ? h : inner, first = (std::min)(inner, kink),
                     second = (std::max)(inner, kink);
        panel(panel, -outer, -second);
        panel(panel, -second, -first);
        panel(panel, -first, first);
        panel(panel, first, second);
        panel(panel, second, outer);
    }

    // w at a distance tau >= 0 from the middle of the element, times 2 delta for each average
    Scalar density(Scalar tau, Scalar h, Scalar delta) const {
        const Scalar top = 2 * (std::min)(h, delta);
        if (entries_.averages == 0) return 1;
        if (entries_.averages == 1) return std::clamp(h + delta - tau, Scalar(0), top);
        const auto integral = [&](Scalar to) {  // of that, from 0
            const Scalar shoulder = std::abs(h - delta), size = std::abs(to);
            const Scalar ramp = std::clamp(size - shoulder, Scalar(0), top);
            return std::copysign(top * (std::min)(size, shoulder) + ramp * (top - ramp / 2), to);
        };
        return integral(tau + delta) - integral(tau - delta);
    }

    // From the middle of a panel to the singularities, in halves of it: from each on, the rule of the same number
    // integrates to rounding.
    static constexpr std::array<Scalar, 4> least_distances{2, 4, 16, 64};

    static const std::array<QuadratureRule<Scalar>, 4>& rules() {
        static const auto all = [] {
            std::array<QuadratureRule<Scalar>, 4> result;
            const Scalar digits = -std::log(std::numeric_limits<Scalar>::epsilon());
            for (std::size_t k = 0; k < result.size(); ++k) {
                result[k] = gauss_legendre<Scalar>(
                    static_cast<Eigen::Index>(std::ceil(digits / (2 * std::acosh(least_distances[k])))));
            }
            return result;
        }();
        return all;
    }

    static constexpr Scalar square(Scalar x) { return x * x; }

    const Entries<Scalar>& entries_;
    const KernelView<Scalar>& kernel_;
    Scalar b_;
};

}  // namespace rollbem::detail
