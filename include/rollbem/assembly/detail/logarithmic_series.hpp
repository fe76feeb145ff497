// Far entries of the logarithm: a series that neither cancels nor, for the slope, needs a logarithm.
// Several rows are computed at once, in registers.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "../../detail/gauss_legendre.hpp"
#include "../../elasticity/line_kernel.hpp"
#include "../../types.hpp"
#include "entries.hpp"

namespace rollbem::detail {

/// Series in the even moments of w, see Entries. Keeps references to its arguments.
///
/// Even moments of w: M_2j = 2h sum c_j S_j with S_j = sum_i A^(j-i) B^i, A = (h + delta)^2, B = (h - delta)^2,
/// c_j = 1/((2j+1)(j+1)) for one average; for none A = h^2, B = 0, c_j = 1/(2j+1). All terms are positive.
/// The slope takes sum M_2j / d^2j; the displacement takes the logarithm and sum_{j>0} M_2j / (2j d^2j).
template <class Scalar>
class LogarithmicSeries {
public:
    LogarithmicSeries(const Entries<Scalar>& entries, const SmoothSplit<Scalar>& split)
        : entries_(entries),
          averages_(entries.averages),
          slope_(entries.slope()),
          strength_(split.strength),
          constant_(split.constant),
          coefficients_(last + 1) {
        for (Eigen::Index j = 0; j <= last; ++j) {
            coefficients_[j] = 1 / Scalar(2 * j + 1);
            if (entries_.averages > 0) coefficients_[j] /= Scalar(j + 1);
            if (entries_.quantity == Quantity::displacement) coefficients_[j] *= j == 0 ? Scalar(0) : 1 / Scalar(2 * j);
        }
        // the ratio up to which terms 0 to j suffice; S_j <= (j + 1) A^j
        const auto bound = [](int j) {
            return std::pow(std::numeric_limits<Scalar>::epsilon() / 4 * Scalar(2 * j + 3), 1 / Scalar(j + 1));
        };
        bound_of_4_ = bound(4);
        bound_of_6_ = bound(6);
    }

    /// Writes every entry to result(l, m); near entries become finite but wrong.
    void fill(MatrixX<Scalar>& result) const {
        const bool twice = entries_.averages == 2, single_ratio = entries_.averages == 0 || entries_.equal_widths;
        const QuadratureRule<Scalar> rule = second_average<Scalar>(entries_.averages);
        for (Eigen::Index m = 0; m < entries_.columns.half.size(); ++m) {
            const Scalar h = entries_.columns.half[m];
            const bool trailing = entries_.columns.from_trailing[m] <= 1;
            const Scalar origin = trailing ? entries_.columns.from_trailing[m] : entries_.columns.from_leading[m];
            const Scalar* from = trailing ? entries_.rows.from_trailing.data() : entries_.rows.from_leading.data();
            const Scalar sign = trailing ? 1 : -1;
            for (Eigen::Index l = 0; l < entries_.count; l += chunk) {
                Chunk d;
                for (Eigen::Index i = 0; i < chunk; ++i)
                    d[i] = entries_.rows.offset[l + i] + sign * (from[l + i] - origin);
                const Scalar* delta = entries_.rows.half.data() + l;
                const Chunk value = twice          ? twice_averaged(rule, d, h, delta)
                                    : single_ratio ? log_series<true>(d, h, delta)
                                                   : log_series<false>(d, h, delta);
                Scalar* out = result.data() + m * result.rows() + l;
                if (l + chunk <= entries_.count) {
                    for (Eigen::Index i = 0; i < chunk; ++i) out[i] = value[i];
                } else {
                    std::copy_n(value.data(), entries_.count - l, out);
                }
            }
        }
    }

private:
    using Chunk = typename Entries<Scalar>::Chunk;
    static constexpr Eigen::Index chunk = Entries<Scalar>::chunk;
    static constexpr int last = last_moment<Scalar>;

    // sum_{j <= terms} c_j S_j by Horner's rule in A, whose coefficients are Horner sums in B. With the length known at
    // compile time and one entry per pass, the terms are unrolled and vectors of entries stay in registers.
    template <bool SingleRatio, int terms>
    Chunk moment_sum(const Chunk& A, const Chunk& B) const {
        const Scalar* c = coefficients_.data();
        Chunk result;
        for (Eigen::Index i = 0; i < chunk; ++i) {
            Scalar b = c[terms];
            Scalar sum = c[terms];
            for (int j = terms - 1; j >= 0; --j) {
                b = SingleRatio ? c[j] : b * B[i] + c[j];
                sum = sum * A[i] + b;
            }
            result[i] = sum;
        }
        return result;
    }

    template <bool SingleRatio>
    Chunk moment_sum(const Chunk& A, const Chunk& B) const {
        const Scalar largest = A.maxCoeff();
        if (largest <= bound_of_4_) return moment_sum<SingleRatio, 4>(A, B);
        if (largest <= bound_of_6_) return moment_sum<SingleRatio, 6>(A, B);
        return moment_sum<SingleRatio, last>(A, B);
    }

    // the logarithmic part: g' = -strength/d, so that g^{(2j+1)}/(2j)! = -strength/d^(2j+1)
    template <bool SingleRatio>
    Chunk log_series(const Chunk& d, Scalar h, const Scalar* delta) const {
        const Scalar size = Scalar(averages_ > 0 ? 2 : 1) * h;
        Chunk inverse, A, B;
        for (Eigen::Index i = 0; i < chunk; ++i) {
            inverse[i] = 1 / d[i];
            const Scalar sum = (SingleRatio ? size : h + delta[i]) * inverse[i];
            A[i] = sum * sum;
            if constexpr (!SingleRatio) {
                const Scalar difference = (h - delta[i]) * inverse[i];
                B[i] = difference * difference;
            }
        }
        A = (A.min)(Entries<Scalar>::far_ratio);
        if constexpr (!SingleRatio) B = (B.min)(Entries<Scalar>::far_ratio);
        const Scalar scale = 2 * h * strength_;
        Chunk result = moment_sum<SingleRatio>(A, SingleRatio ? A : B);
        if (slope_) {
            for (Eigen::Index i = 0; i < chunk; ++i) result[i] *= -scale * inverse[i];
            return result;
        }
        Chunk logarithm;
        for (Eigen::Index i = 0; i < chunk; ++i) logarithm[i] = std::abs(d[i]);
        logarithm = logarithm.log();
        const Scalar constant = 2 * h * constant_;
        for (Eigen::Index i = 0; i < chunk; ++i) result[i] = constant + scale * (result[i] - logarithm[i]);
        return result;
    }

    Chunk twice_averaged(const QuadratureRule<Scalar>& rule, const Chunk& d, Scalar h, const Scalar* delta) const {
        Chunk sum;
        for (Eigen::Index i = 0; i < chunk; ++i) sum[i] = 0;
        for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
            Chunk shifted;
            for (Eigen::Index i = 0; i < chunk; ++i) shifted[i] = d[i] + rule.nodes[k] * delta[i];
            const Chunk value = log_series<false>(shifted, h, delta);
            for (Eigen::Index i = 0; i < chunk; ++i) sum[i] += rule.weights[k] / 2 * value[i];
        }
        return sum;
    }

    const Entries<Scalar>& entries_;
    int averages_;  // copied for the inner loop
    bool slope_;
    Scalar strength_, constant_;
    ArrayX<Scalar> coefficients_;
    Scalar bound_of_4_ = 0, bound_of_6_ = 0;
};

}  // namespace rollbem::detail
