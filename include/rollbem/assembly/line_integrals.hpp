// Line integrals: a line kernel, or its derivative, integrated over an element and averaged about a point.
// Every entry of G and G' of Eqs. (12)-(14) is such an integral; this header fills whole matrices of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "../detail/gauss_legendre.hpp"
#include "../elasticity/line_kernel.hpp"

namespace rollbem::detail {

/// The points at which rows are taken and the intervals over which they are averaged, in units of a.
template <class Scalar>
struct RowPoints {
    ArrayX<Scalar> from_trailing;  ///< 1 + x of the centre of the row's own element
    ArrayX<Scalar> from_leading;   ///< 1 - x of it
    ArrayX<Scalar> offset;         ///< point minus centre
    ArrayX<Scalar> half;           ///< delta: half the width over which a row is averaged or differenced
};

/// The elements that carry unit traction.
template <class Scalar>
struct ColumnElements {
    ArrayX<Scalar> from_trailing;  ///< 1 + x of the centre
    ArrayX<Scalar> from_leading;   ///< 1 - x of it
    ArrayX<Scalar> half;           ///< h: half the width
};

/// Which integral: entry = int w(tau) g^{(q)}(d + tau) dtau, d = point - centre of the element, with w the element's
/// indicator (half-width h) convolved with `averages` normalised indicators of half-width delta.
/// A finite difference is an average of the derivative: fd collocation has q = 1, averages = 1.
enum class Quantity {
    displacement,  ///< q = 0, an entry of G
    slope,         ///< q = 1, an entry of G'
};

/// Fills matrices of line integrals. Near entries take differences of the kernel's antiderivatives, sharing evaluations
/// along a row; entries with |d| > 4 (h + averages delta) take a series in the even moments of w, whose sums
/// neither cancel nor need a logarithm for the slope.
template <class Kernel>
class LineIntegrals {
public:
    using Scalar = typename Kernel::Scalar;
    using Array = ArrayX<Scalar>;
    using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    using Table = Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

    /// `equal_widths`: every h and delta are one number, and neighbours are 2h apart.
    LineIntegrals(const Kernel& kernel, Quantity quantity, int averages, const RowPoints<Scalar>& rows,
                  const ColumnElements<Scalar>& columns, bool equal_widths)
        : kernel_(kernel),
          quantity_(quantity),
          averages_(averages),
          rows_(rows),
          columns_(columns),
          equal_widths_(equal_widths) {
        if constexpr (SplitKernel<Kernel>) {
            const Scalar reach =
                1 + (rows.from_leading.max(rows.from_trailing) - 1 + rows.offset.abs() + Scalar(averages) * rows.half)
                        .maxCoeff();
            split_ = kernel.log_split(reach);
        }
        if (has_series()) prepare_series();
    }

    /// Writes the integral for every row l and element m to out(l, m).
    void fill(Eigen::Ref<Matrix> out) const {
        if (split_) {
            split_series(out);
        } else if constexpr (TaylorKernel<Kernel>) {
            taylor_series(out);
        }
        near_differences(out);
        if (split_) add_polynomial(out);
    }

private:
    static constexpr Eigen::Index chunk = 8;  // rows a series is evaluated for at once: a few registers
    using Chunk = Eigen::Array<Scalar, chunk, 1>;
    static constexpr Scalar far_ratio = Scalar(1) / 16;  // ((h + averages delta) / d)^2 below which the series is taken

    bool has_series() const { return split_.has_value() || TaylorKernel<Kernel>; }
    Scalar distance(Eigen::Index l, Eigen::Index m) const {
        const Scalar between = columns_.from_trailing[m] <= 1 ? rows_.from_trailing[l] - columns_.from_trailing[m]
                                                              : columns_.from_leading[m] - rows_.from_leading[l];
        return between + rows_.offset[l];
    }
    Array distances(Eigen::Index m) const {
        if (columns_.from_trailing[m] <= 1) return rows_.from_trailing - columns_.from_trailing[m] + rows_.offset;
        return columns_.from_leading[m] - rows_.from_leading + rows_.offset;
    }
    bool is_near(Eigen::Index l, Eigen::Index m) const {
        const Scalar size = columns_.half[m] + Scalar(averages_) * rows_.half[l];
        const Scalar d = distance(l, m);
        return !has_series() || !(size * size < far_ratio * d * d);
    }
    // q = 1 takes g (0), H (1), H_integral (2) for 0, 1, 2 averages; q = 0 the next one
    int level() const { return averages_ + (quantity_ == Quantity::slope ? 0 : 1); }

    // --- near entries ------------------------------------------------------------------------------------------

    struct Run {
        Eigen::Index row, first, count, position;
    };

    // the antiderivative of the singular part, or of the whole kernel; what is constant for the slope is left out
    Array antiderivative(const Array& x) const {
        if (split_) {
            const Scalar s = split_->strength;
            switch (level()) {
                case 0: return -s * x.abs().log();
                case 1: return quantity_ == Quantity::slope ? Array(-s * x * finite_log(x))
                                                            : Array(x * (split_->constant + s - s * finite_log(x)));
                case 2:
                    return quantity_ == Quantity::slope
                               ? Array(-s / 2 * x.square() * finite_log(x))
                               : Array(x.square() * ((2 * split_->constant + 3 * s) / 4 - s / 2 * finite_log(x)));
                default: break;
            }
        }
        return level() == 0 ? Array(kernel_.g(x)) : level() == 1 ? Array(kernel_.H(x)) : Array(kernel_.H_integral(x));
    }

    void near_differences(Eigen::Ref<Matrix> result) const {
        std::vector<Run> runs;
        std::vector<Scalar> arguments;
        const Eigen::Index n = columns_.half.size();
        for (Eigen::Index l = 0; l < rows_.half.size(); ++l) {
            Eigen::Index m = 0;
            Eigen::Index end = n;
            if (equal_widths_ && has_series() && n > 1) {  // near columns surround the point: no need to look at all
                const Scalar width = 2 * columns_.half[0];
                const Scalar nearest = distance(l, 0) / width;
                const Scalar spread = 2 * Scalar(averages_ + 1) + 2;
                m = clamp_index(nearest - spread, n);
                end = clamp_index(nearest + spread + 1, n);
            }
            while (m < end) {
                while (m < end && !is_near(l, m)) ++m;
                Eigen::Index first = m;
                while (m < end && is_near(l, m)) ++m;
                if (m > first) append_run(l, first, m - first, runs, arguments);
            }
            if (arguments.size() > 2048 || l + 1 == rows_.half.size()) {
                evaluate_runs(runs, arguments, result);
                runs.clear();
                arguments.clear();
            }
        }
    }

    static Eigen::Index clamp_index(Scalar value, Eigen::Index n) {
        return static_cast<Eigen::Index>(std::clamp(value, Scalar(0), static_cast<Scalar>(n)));
    }

    // The differences run over the element's two edges and, once for each average, over +-delta about the point. With
    // equal widths all these steps are one, so that neighbours share all but one evaluation.
    void append_run(Eigen::Index l, Eigen::Index first, Eigen::Index count, std::vector<Run>& runs,
                    std::vector<Scalar>& arguments) const {
        runs.push_back({l, first, count, static_cast<Eigen::Index>(arguments.size())});
        const Scalar delta = rows_.half[l];
        if (equal_widths_) {
            const Scalar h = columns_.half[0];
            const Scalar start = distance(l, first) + Scalar(averages_ + 1) * h;
            for (Eigen::Index i = 0; i < count + averages_ + 1; ++i) {
                arguments.push_back(start - static_cast<Scalar>(2 * i) * h);
            }
            return;
        }
        for (int point = averages_; point >= -averages_; point -= 2) {
            const Scalar shift = Scalar(point) * delta;
            for (Eigen::Index m = first; m < first + count; ++m) {
                arguments.push_back(distance(l, m) + columns_.half[m] + shift);
            }
            const Eigen::Index last = first + count - 1;
            arguments.push_back(distance(l, last) - columns_.half[last] + shift);
        }
    }

    void evaluate_runs(const std::vector<Run>& runs, const std::vector<Scalar>& arguments, Eigen::Ref<Matrix> result) const {
        if (arguments.empty()) return;
        const Array values = antiderivative(
            Eigen::Map<const Array>(arguments.data(), static_cast<Eigen::Index>(arguments.size())));
        for (const Run& run : runs) {
            Scalar divisor = 1;
            for (int i = 0; i < averages_; ++i) divisor *= 2 * rows_.half[run.row];
            for (Eigen::Index i = 0; i < run.count; ++i) {
                Scalar sum = 0;
                if (equal_widths_) {
                    const Scalar* v = values.data() + run.position + i;
                    sum = averages_ == 0   ? v[0] - v[1]
                          : averages_ == 1 ? (v[0] - v[1]) - (v[1] - v[2])
                                           : ((v[0] - v[1]) - (v[1] - v[2])) - ((v[1] - v[2]) - (v[2] - v[3]));
                } else {
                    const Eigen::Index stride = run.count + 1;
                    const auto element = [&](Eigen::Index point) {
                        const Scalar* v = values.data() + run.position + point * stride + i;
                        return v[0] - v[1];
                    };
                    sum = averages_ == 0   ? element(0)
                          : averages_ == 1 ? element(0) - element(1)
                                           : (element(0) - element(1)) - (element(1) - element(2));
                }
                result(run.row, run.first + i) = sum / divisor;
            }
        }
    }

    // --- far entries ---------------------------------------------------------------------------------------------

    // Even moments of w: M_2j = 2h sum c_j S_j with S_j = sum_i A^(j-i) B^i, A = (h + delta)^2, B = (h - delta)^2,
    // c_j = 1/((2j+1)(j+1)) for one average; for none A = h^2, B = 0, c_j = 1/(2j+1). All terms are positive.
    void prepare_series() {
        const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
        Eigen::Index terms = 1;
        for (Scalar power = far_ratio; power > epsilon / 4; power *= far_ratio) ++terms;
        coefficients_.resize(terms + 1);
        bounds_.resize(terms + 1);
        for (Eigen::Index j = 0; j <= terms; ++j) {
            coefficients_[j] = Scalar(1) / Scalar(2 * j + 1) / (averages_ == 0 ? Scalar(1) : Scalar(j + 1));
            // ratio up to which the terms 0 ... j suffice
            bounds_[j] = std::pow(epsilon / 4, Scalar(1) / Scalar(j + 1));
        }
    }

    Eigen::Index terms_for(Scalar ratio) const {
        Eigen::Index j = 1;
        while (j + 1 < bounds_.size() && bounds_[j] < ratio) ++j;
        return j;
    }

    // the normalised even moments M_2j / (2h d^2j), times factor(j), summed up to the term the ratio asks for
    template <class Factor>
    Chunk moment_sum(const Chunk& A, const Chunk& B, Scalar largest, Factor factor) const {
        Eigen::Index j = terms_for(largest);
        Chunk b = Chunk::Constant(coefficients_[j] * factor(j));
        Chunk sum = b;
        if (averages_ == 0 || equal_widths_) {  // B = 0
            while (j-- > 0) sum = sum * A + coefficients_[j] * factor(j);
        } else {
            while (j-- > 0) {
                b = b * B + coefficients_[j] * factor(j);
                sum = sum * A + b;
            }
        }
        return sum;
    }

    // logarithmic part: g' = -strength/d, so that g^{(2j+1)}/(2j)! = -strength/d^(2j+1)
    Chunk log_series(const Chunk& d, Scalar h, const Chunk& delta) const {
        const Chunk inverse = 1 / d;
        const Chunk outer = averages_ == 0 ? Chunk(h * inverse) : Chunk((h + delta) * inverse);
        const Chunk inner = averages_ == 0 ? Chunk::Zero() : Chunk((h - delta) * inverse);
        const Chunk A = outer.square().min(far_ratio);
        const Chunk B = inner.square().min(far_ratio);
        const Scalar largest = A.maxCoeff();
        const Scalar s = split_->strength;
        if (quantity_ == Quantity::slope) {
            return -2 * h * s * inverse * moment_sum(A, B, largest, [](Eigen::Index) { return Scalar(1); });
        }
        return 2 * h *
               (split_->constant - s * d.abs().log() +
                s * moment_sum(A, B, largest,
                               [](Eigen::Index j) { return j == 0 ? Scalar(0) : Scalar(1) / Scalar(2 * j); }));
    }

    void split_series(Eigen::Ref<Matrix> result) const {
        // a second average is taken by quadrature: about a far point the integrand is analytic far beyond the
        // interval, and seven points reach double's rounding (nine long double's)
        const QuadratureRule<Scalar> rule =
            gauss_legendre<Scalar>(averages_ < 2 ? 1 : std::numeric_limits<Scalar>::digits > 53 ? 9 : 7);
        const LineIntegrals* once = this;
        std::optional<LineIntegrals> inner;
        if (averages_ == 2) {
            inner.emplace(kernel_, quantity_, 1, rows_, columns_, equal_widths_);
            once = &*inner;
        }
        for_each_chunk(result, [&](const Chunk& d, Scalar h, const Chunk& delta) {
            if (averages_ < 2) return log_series(d, h, delta);
            Chunk sum = Chunk::Zero();
            for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
                sum += rule.weights[k] / 2 * once->log_series(d + rule.nodes[k] * delta, h, delta);
            }
            return sum;
        });
    }

    template <class Function>
    void for_each_chunk(Eigen::Ref<Matrix> result, Function function) const {
        const Eigen::Index count = rows_.half.size();
        for (Eigen::Index m = 0; m < columns_.half.size(); ++m) {
            const bool trailing = columns_.from_trailing[m] <= 1;
            const Scalar origin = trailing ? columns_.from_trailing[m] : columns_.from_leading[m];
            const auto at = [&](Eigen::Index l) -> Chunk {
                if (trailing) {
                    return rows_.from_trailing.template segment<chunk>(l) - origin +
                           rows_.offset.template segment<chunk>(l);
                }
                return origin - rows_.from_leading.template segment<chunk>(l) +
                       rows_.offset.template segment<chunk>(l);
            };
            Eigen::Index l = 0;
            for (; l + chunk <= count; l += chunk) {
                result.col(m).template segment<chunk>(l).array() =
                    function(at(l), columns_.half[m], Chunk(rows_.half.template segment<chunk>(l)));
            }
            if (l == count) continue;
            Chunk d = Chunk::Ones(), delta = Chunk::Zero();
            for (Eigen::Index i = 0; i < count - l; ++i) {
                d[i] = distance(l + i, m);
                delta[i] = rows_.half[l + i];
            }
            result.col(m).segment(l, count - l).array() = function(d, columns_.half[m], delta).head(count - l);
        }
    }

    // --- the polynomial part of a split kernel: exact for near and far alike ------------------------------------------

    // With sigma_j = coefficients of sinhc(h t) sinhc(delta t)^averages = M_2j / (2h (2j)!), the integral of x^{2k} is
    // 2h sum_j sigma_j (2k)!/(2k-q-2j)! d^(2k-q-2j): a polynomial in d^2 (times d for the slope).
    void add_polynomial(Eigen::Ref<Matrix> result) const {
        const Array& even = split_->even;
        const Eigen::Index degree = even.size();
        if (degree == 0) return;
        const bool slope = quantity_ == Quantity::slope;
        const Eigen::Index length = slope ? degree : degree + 1;  // powers of d^2
        // falling(i, j) = even_k (2k)!/(2i + q)!, k = i + j + q: contribution of sigma_j to the power i
        Table falling = Table::Zero(length, length);
        for (Eigen::Index i = 0; i < length; ++i) {
            for (Eigen::Index j = 0; i + j < length; ++j) {
                const Eigen::Index k = i + j + (slope ? 1 : 0);
                if (k == 0) continue;
                Scalar factor = even[k - 1];
                for (Eigen::Index f = 2 * i + (slope ? 2 : 1); f <= 2 * k; ++f) factor *= static_cast<Scalar>(f);
                falling(i, j) = factor;
            }
        }
        const auto sinhc_series = [length](const Array& half) {
            Table series(half.size(), length);
            series.col(0).setOnes();
            for (Eigen::Index i = 1; i < length; ++i) {
                series.col(i) = series.col(i - 1) * half.square() / Scalar(2 * i * (2 * i + 1));
            }
            return series;
        };
        // row l: coefficients of sinhc(delta_l t)^averages; with equal widths, one row for all
        const Array halves = equal_widths_ ? Array(rows_.half.head(1)) : rows_.half;
        const Table average = sinhc_series(halves);
        Table row_series = Table::Zero(halves.size(), length);
        row_series.col(0).setOnes();
        for (int a = 0; a < averages_; ++a) {
            for (Eigen::Index j = length - 1; j > 0; --j) {
                for (Eigen::Index i = 0; i < j; ++i) row_series.col(j) += row_series.col(i) * average.col(j - i);
            }
        }
        const Table column_series = sinhc_series(columns_.half);
        Table powers(halves.size(), length);
        for (Eigen::Index m = 0; m < columns_.half.size(); ++m) {
            if (m == 0 || !equal_widths_) {
                for (Eigen::Index i = 0; i < length; ++i) {
                    powers.col(i).setZero();
                    for (Eigen::Index k = 0; i + k < length; ++k) {
                        Scalar factor = 0;
                        for (Eigen::Index j = k; i + j < length; ++j) factor += falling(i, j) * column_series(m, j - k);
                        powers.col(i) += 2 * columns_.half[m] * factor * row_series.col(k);
                    }
                }
            }
            const Array d = distances(m);
            const Array square = d.square();
            Array sum = Array::Zero(d.size());
            for (Eigen::Index i = length - 1; i >= 0; --i) {
                if (equal_widths_) {
                    sum = sum * square + powers(0, i);
                } else {
                    sum = sum * square + powers.col(i);
                }
            }
            result.col(m).array() += slope ? Array(sum * d) : sum;
        }
    }

    // --- far entries of a kernel with a Taylor series ------------------------------------------------------------------

    void taylor_series(Eigen::Ref<Matrix> result) const {
        const Eigen::Index terms = coefficients_.size() - 1;
        const Eigen::Index count = rows_.half.size();
        const Eigen::Index q = quantity_ == Quantity::slope ? 1 : 0;
        for (Eigen::Index m = 0; m < columns_.half.size(); ++m) {
            const Scalar h = columns_.half[m];
            std::vector<Eigen::Index> far;
            for (Eigen::Index l = 0; l < count; ++l) {
                if (!is_near(l, m)) far.push_back(l);
            }
            const Eigen::Index size = static_cast<Eigen::Index>(far.size());
            if (size == 0) continue;
            Array d(size), delta(size);
            for (Eigen::Index i = 0; i < size; ++i) {
                d[i] = distance(far[static_cast<std::size_t>(i)], m);
                delta[i] = rows_.half[far[static_cast<std::size_t>(i)]];
            }
            const Table series = kernel_.taylor(d, 2 * terms + q);
            // moments of (h-indicator) * (delta-indicator)^averages over d^2j, built up one average at a time:
            // the even moments of a sum of independent variables, with m_2i = delta^2i / (2i+1) for each indicator
            Table moments(size, terms + 1);
            const Array element = (h / d).square(), average = (delta / d).square();
            moments.col(0).setOnes();
            for (Eigen::Index j = 1; j <= terms; ++j) moments.col(j) = moments.col(j - 1) * element;
            for (Eigen::Index j = 1; j <= terms; ++j) moments.col(j) /= Scalar(2 * j + 1);
            for (int a = 0; a < averages_; ++a) {
                for (Eigen::Index j = terms; j > 0; --j) {
                    Array sum = moments.col(j);
                    Array power = Array::Ones(size);
                    Scalar binomial = 1;
                    for (Eigen::Index i = 1; i <= j; ++i) {
                        power *= average;
                        binomial *= Scalar(2 * j - 2 * i + 2) * Scalar(2 * j - 2 * i + 1) / Scalar(2 * i - 1) /
                                    Scalar(2 * i);
                        sum += binomial / Scalar(2 * i + 1) * power * moments.col(j - i);
                    }
                    moments.col(j) = sum;
                }
            }
            Array sum = Array::Zero(size);
            for (Eigen::Index j = terms; j >= 0; --j) {
                sum += moments.col(j) * series.col(2 * j + q) * (q == 1 ? Scalar(2 * j + 1) : Scalar(1));
            }
            if (q == 1) sum /= d;
            for (Eigen::Index i = 0; i < size; ++i) result(far[static_cast<std::size_t>(i)], m) = 2 * h * sum[i];
        }
    }

    const Kernel& kernel_;
    Quantity quantity_;
    int averages_;
    const RowPoints<Scalar>& rows_;
    const ColumnElements<Scalar>& columns_;
    bool equal_widths_;
    std::optional<LogSplit<Scalar>> split_;
    Array coefficients_, bounds_;
};

}  // namespace rollbem::detail
