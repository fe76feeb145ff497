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
/// Both ways are accurate to rounding of the largest e^{(q)}. Far behind a narrow strip e cancels the logarithm: G'
/// then errs by some eps/b, so that entries are NaN below least_width(), where no digits would remain. Keeps references
/// to its arguments.
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
        const Points rows((entries_.rows.from_trailing + entries_.rows.offset).head(result.rows()), entries_.rows.half,
                          of_rows),
            columns(entries_.columns.from_trailing, entries_.columns.half, 1 + entries_.averages - of_rows);
        const Scalar row_terms = terms(rows.reach), column_terms = terms(columns.reach);
        const Scalar size = static_cast<Scalar>(result.size()), width = static_cast<Scalar>(result.cols()),
                     height = static_cast<Scalar>(result.rows());
        const Scalar products =
            row_terms * column_terms * (20 + row_terms + column_terms + width) + row_terms * (height + size / 4);
        if (products <= 220 * size) {  // costs in products (docs/measured.md): 220 an integral, 20 a sample
            interpolate(rows, static_cast<Eigen::Index>(row_terms), columns, static_cast<Eigen::Index>(column_terms),
                        result);
        } else {
            integrate(result);
        }
    }

    /// b/a at which eps/b is 10^-6 in double, 2 * 10^-3 in float.
    static Scalar least_width() { return std::pow(std::numeric_limits<Scalar>::epsilon(), Scalar(0.625)); }

private:
    // Points, the half-lengths of the intervals about them over which a mean is taken `averages` times, and the
    // interval that all of them cover, by its middle and its reach to both sides.
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

    // T_k, k < count; a row for each place.
    static MatrixX<Scalar> polynomials(const ArrayX<Scalar>& x, Eigen::Index count) {
        MatrixX<Scalar> values(x.size(), count);
        values.col(0).setOnes();
        values.col(1) = x;
        for (Eigen::Index k = 2; k < count; ++k) {
            values.col(k).array() = 2 * x * values.col(k - 1).array() - values.col(k - 2).array();
        }
        return values;
    }

    // Chebyshev nodes, measured from the middle; T_k at the nodes, a row for each node; and the means of T_k over the
    // intervals, a row for each interval.
    struct Interpolation {
        ArrayX<Scalar> nodes;
        MatrixX<Scalar> at_nodes, means;
    };
    Interpolation interpolation(const Points& points, Eigen::Index count) const {
        const Eigen::Index order = points.averages > 0 ? static_cast<Eigen::Index>(terms(points.longest) + 1) / 2 : 1;
        const QuadratureRule<Scalar> rule = gauss_legendre<Scalar>(order);
        Eigen::Index sample_count = 1;
        for (int a = 0; a < points.averages; ++a) sample_count *= order;
        MatrixX<Scalar> means = MatrixX<Scalar>::Zero(points.places.size(), count);
        for (Eigen::Index sample = 0; sample < sample_count; ++sample) {
            Scalar shift = 0, weight = 1;
            Eigen::Index digits = sample;  // digits in the base of the order
            for (int a = 0; a < points.averages; ++a, digits /= order) {
                shift += rule.nodes[digits % order];
                weight *= rule.weights[digits % order] / 2;
            }
            const ArrayX<Scalar> x =
                (points.places - points.middle + shift * points.half.head(points.places.size())) / points.reach;
            means += weight * polynomials(x, count);
        }
        const Scalar step = std::numbers::pi_v<Scalar> / static_cast<Scalar>(2 * count);
        ArrayX<Scalar> nodes(count);
        for (Eigen::Index j = 0; j < count; ++j) nodes[j] = std::cos(static_cast<Scalar>(2 * j + 1) * step);
        return {points.reach * nodes, polynomials(nodes, count), std::move(means)};
    }

    // e^{(q)}(x - y) = sum c_jk T_j(x) T_k(y), with x within the rows and y within the columns
    void interpolate(const Points& rows, Eigen::Index row_terms, const Points& columns, Eigen::Index column_terms,
                     MatrixX<Scalar>& result) const {
        const Interpolation along = interpolation(rows, row_terms), across = interpolation(columns, column_terms);
        ArrayX<Scalar> samples(row_terms * column_terms);
        for (Eigen::Index k = 0; k < column_terms; ++k) {
            samples.segment(k * row_terms, row_terms) = rows.middle - columns.middle + (along.nodes - across.nodes[k]);
        }
        kernel_.evaluate(entries_.slope(), samples);
        samples *= Scalar(4) / static_cast<Scalar>(row_terms * column_terms);
        const MatrixX<Scalar> values = Eigen::Map<const MatrixX<Scalar>>(samples.data(), row_terms, column_terms);
        MatrixX<Scalar> coefficients = product(along.at_nodes.transpose(), product(values, across.at_nodes));
        coefficients.row(0) /= 2;
        coefficients.col(0) /= 2;
        MatrixX<Scalar> integrals = product(coefficients, across.means.transpose());
        for (Eigen::Index m = 0; m < integrals.cols(); ++m) integrals.col(m) *= 2 * columns.half[m];
        result.noalias() += along.means * integrals;
    }

    // Product of plain matrices, so that it is compiled once.
    static MatrixX<Scalar> product(const MatrixX<Scalar>& a, const MatrixX<Scalar>& b) {
        MatrixX<Scalar> result(a.rows(), b.cols());
        result.noalias() = a * b;
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
        const auto integral = [&](Scalar to) {  // integral of the density from 0
            const Scalar shoulder = std::abs(h - delta), size = std::abs(to);
            const Scalar ramp = std::clamp(size - shoulder, Scalar(0), top);
            return std::copysign(top * (std::min)(size, shoulder) + ramp * (top - ramp / 2), to);
        };
        return integral(tau + delta) - integral(tau - delta);
    }

    // Distance from the middle of a panel to the singularities, in half-lengths of the panel, from which on the rule of
    // the same index integrates to rounding.
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
