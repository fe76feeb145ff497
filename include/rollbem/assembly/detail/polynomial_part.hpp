// The polynomial part of a split kernel, integrated: the same for near and far entries. Its coefficients are computed
// once for a matrix.
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include "../../types.hpp"
#include "entries.hpp"

namespace rollbem::detail {

/// Integrals of sum_{k>=1} even[k-1] x^{2k}, the smooth part of a LogSplit. Keeps a reference to the entries.
///
/// With sigma_j the coefficients of sinhc(h t) sinhc(delta t)^averages = sum M_2j t^2j / (2h (2j)!), the integral of
/// even_k x^{2k} is 2h sum_j sigma_j even_k (2k)!/(2k-q-2j)! d^(2k-q-2j): a polynomial in d^2, times d for the slope.
template <class Scalar>
class PolynomialPart {
public:
    using Array = ArrayX<Scalar>;
    using Table = Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    using Chunk = typename Entries<Scalar>::Chunk;

    PolynomialPart(const Entries<Scalar>& entries, const Array& even)
        : entries_(entries), equal_widths_(entries.equal_widths), slope_(entries.slope()) {
        const Eigen::Index q = entries_.slope() ? 1 : 0;
        const Eigen::Index terms = even.size();
        const Eigen::Index length = terms == 0 ? 0 : terms + 1 - q;
        // falling(i, j): contribution of sigma_j to the power i, k = i + j + q
        Table falling = zeros(length, length);
        for (Eigen::Index i = 0; i < length; ++i) {
            for (Eigen::Index j = i + q == 0 ? 1 : 0; i + j < length; ++j) {
                const Eigen::Index k = i + j + q;
                falling(i, j) = even[k - 1];
                for (Eigen::Index f = 2 * i + q + 1; f <= 2 * k; ++f) falling(i, j) *= static_cast<Scalar>(f);
            }
        }
        // row l: coefficients of sinhc(delta_l t)^averages; with equal widths one row serves all rows
        const Table average =
            sinhc_series(entries_.rows.half, entries_.equal_widths ? 1 : entries_.rows.half.size(), length);
        row_series_ = zeros(average.rows(), length);
        for (Eigen::Index l = 0; l < average.rows() && length > 0; ++l) {
            row_series_(l, 0) = 1;
            for (int a = 0; a < entries_.averages; ++a) {
                for (Eigen::Index j = length - 1; j > 0; --j) {
                    for (Eigen::Index i = 0; i < j; ++i) row_series_(l, j) += row_series_(l, i) * average(l, j - i);
                }
            }
        }
        // contribution of factor k of a row to power i, for every element; with equal widths the same for all elements
        const Table element =
            sinhc_series(entries_.columns.half, entries_.equal_widths ? 1 : entries_.columns.half.size(), length);
        element_factors_ = zeros(element.rows(), length * length);
        for (Eigen::Index i = 0; i < length; ++i) {
            for (Eigen::Index k = 0; i + k < length; ++k) {
                for (Eigen::Index j = k; i + j < length; ++j) {
                    const Scalar factor = 2 * falling(i, j);
                    for (Eigen::Index m = 0; m < element.rows(); ++m) {
                        element_factors_(m, i * length + k) += factor * entries_.columns.half[m] * element(m, j - k);
                    }
                }
            }
        }
        if (entries_.equal_widths) coefficients(0, common_powers_);
    }

    Eigen::Index length() const { return row_series_.cols(); }           ///< number of powers; 0: no polynomial part
    const Table& common_coefficients() const { return common_powers_; }  ///< for equal widths

    /// Row l of `powers`: coefficients of d^2i for element m seen from row l. With equal widths one row, with m = 0,
    /// serves all: common_coefficients().
    void coefficients(Eigen::Index m, Table& powers) const {
        const Eigen::Index length = row_series_.cols();
        const Eigen::Index rows = row_series_.rows();
        powers.resize(rows, length);
        for (Eigen::Index i = 0; i < length; ++i) {
            Scalar* power = powers.data() + i * rows;
            std::fill_n(power, rows, Scalar(0));
            for (Eigen::Index k = 0; i + k < length; ++k) {
                const Scalar factor = element_factors_(m, i * length + k);
                const Scalar* row = row_series_.data() + k * rows;
                for (Eigen::Index l = 0; l < rows; ++l) power[l] += factor * row[l];
            }
        }
    }

    /// Adds the integrals at the distances d of the rows from l onwards, with the coefficients of their element.
    void add(const Table& powers, const Chunk& d, Eigen::Index l, Chunk& value) const {
        Chunk sum;
        if (equal_widths_ && powers.cols() == 3) {  // a wide strip: a single loop that stays in registers
            const Scalar constant = powers(0, 0), linear = powers(0, 1), quadratic = powers(0, 2);
            for (Eigen::Index i = 0; i < chunk; ++i) {
                const Scalar square = d[i] * d[i];
                sum[i] = (quadratic * square + linear) * square + constant;
            }
            if (slope_) {
                for (Eigen::Index i = 0; i < chunk; ++i) sum[i] *= d[i];
            }
            for (Eigen::Index i = 0; i < chunk; ++i) value[i] += sum[i];
            return;
        }
        const Eigen::Index last = powers.cols() - 1;
        for (Eigen::Index i = 0; i < chunk; ++i) sum[i] = equal_widths_ ? powers(0, last) : powers(l + i, last);
        for (Eigen::Index j = last - 1; j >= 0; --j) {
            if (equal_widths_) {
                const Scalar power = powers(0, j);
                for (Eigen::Index i = 0; i < chunk; ++i) sum[i] = sum[i] * (d[i] * d[i]) + power;
            } else {
                const Scalar* power = powers.data() + j * powers.rows() + l;
                for (Eigen::Index i = 0; i < chunk; ++i) sum[i] = sum[i] * (d[i] * d[i]) + power[i];
            }
        }
        for (Eigen::Index i = 0; i < chunk; ++i) value[i] += slope_ ? sum[i] * d[i] : sum[i];
    }

    /// The integral for row l and element m.
    Scalar at(Eigen::Index l, Eigen::Index m) const {
        const Eigen::Index length = row_series_.cols();
        const Scalar d = entries_.distance(l, m);
        Scalar sum = 0;
        for (Eigen::Index i = length - 1; i >= 0; --i) {
            Scalar power = 0;
            if (equal_widths_) {
                power = common_powers_(0, i);
            } else {
                for (Eigen::Index k = 0; i + k < length; ++k) {
                    power += element_factors_(m, i * length + k) * row_series_(l, k);
                }
            }
            sum = sum * d * d + power;
        }
        return slope_ ? sum * d : sum;
    }

private:
    static constexpr Eigen::Index chunk = Entries<Scalar>::chunk;

    static Table zeros(Eigen::Index rows, Eigen::Index columns) {
        Table table(rows, columns);
        std::fill_n(table.data(), table.size(), Scalar(0));
        return table;
    }

    // for the first `count` widths
    static Table sinhc_series(const Array& half, Eigen::Index count, Eigen::Index length) {
        Table series(count, length);
        for (Eigen::Index i = 0; i < length; ++i) {
            for (Eigen::Index l = 0; l < count; ++l) {
                series(l, i) =
                    i == 0 ? Scalar(1) : series(l, i - 1) * (half[l] * half[l]) / Scalar(2 * i * (2 * i + 1));
            }
        }
        return series;
    }

    const Entries<Scalar>& entries_;
    bool equal_widths_, slope_;  // copied for the inner loop
    Table row_series_, element_factors_, common_powers_;
};

}  // namespace rollbem::detail
