// Line integrals: a line kernel, or its derivative, integrated over an element and averaged about a point.
// Every entry of G and G' of Eqs. (12)-(14) is such an integral; this header fills whole matrices of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../detail/gauss_legendre.hpp"
#include "../../detail/language.hpp"
#include "../../elasticity/line_kernel.hpp"

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

/// A kernel behind functions of arrays, so that the integrals below are compiled once for a scalar type and not for
/// every kernel; a call costs nothing beside the array it works on. Refers to the kernel. Pointers to functions instead
/// of std::function, for the sake of the user's compiler.
template <class Scalar>
struct KernelView {
    using Array = ArrayX<Scalar>;
    using Table = Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

    template <LineKernel Kernel>
    KernelView(const Kernel& kernel)  // NOLINT(google-explicit-constructor): a view of any kernel
        : kernel_(&kernel), antiderivative_([](const void* self, int level, const Array& x) -> Array {
              const Kernel& k = *static_cast<const Kernel*>(self);
              if (level == 0) return k.g(x);
              if (level == 1) return k.H(x);
              return k.H_integral(x);
          }) {
        if constexpr (SplitKernel<Kernel>) {
            log_split_ = [](const void* self, Scalar reach) {
                return static_cast<const Kernel*>(self)->log_split(reach);
            };
        }
        if constexpr (TaylorKernel<Kernel>) {
            taylor_ = [](const void* self, const Array& x, Eigen::Index order) -> Table {
                return static_cast<const Kernel*>(self)->taylor(x, order);
            };
        }
    }

    /// g (level 0), H (1), H_integral (2).
    Array antiderivative(int level, const Array& x) const { return antiderivative_(kernel_, level, x); }
    /// Empty where there is none.
    std::optional<LogSplit<Scalar>> log_split(Scalar reach) const {
        if (!log_split_) return std::nullopt;
        return log_split_(kernel_, reach);
    }
    bool has_taylor() const { return taylor_ != nullptr; }
    Table taylor(const Array& x, Eigen::Index order) const { return taylor_(kernel_, x, order); }

private:
    const void* kernel_;
    Array (*antiderivative_)(const void*, int, const Array&);
    std::optional<LogSplit<Scalar>> (*log_split_)(const void*, Scalar) = nullptr;
    Table (*taylor_)(const void*, const Array&, Eigen::Index) = nullptr;
};

/// Fills matrices of line integrals. Near entries take differences of the kernel's antiderivatives, sharing evaluations
/// along a row; entries with |d| well above h + averages delta take a series in the even moments of w, whose sums
/// neither cancel nor need a logarithm for the slope.
template <class Scalar_>
class LineIntegrals {
public:
    using Scalar = Scalar_;
    using Array = ArrayX<Scalar>;
    using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    using Table = Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

    /// `equal_widths`: every h and delta are one number, and neighbours are 2h apart.
    LineIntegrals(KernelView<Scalar> kernel, Quantity quantity, int averages, const RowPoints<Scalar>& rows,
                  const ColumnElements<Scalar>& columns, bool equal_widths)
        : kernel_(kernel),
          quantity_(quantity),
          averages_(averages),
          equal_widths_(equal_widths),
          rows_(padded(rows)),
          columns_(columns),
          count_(rows.half.size()) {
        Array reach(count_);
        for (Eigen::Index l = 0; l < count_; ++l) {
            reach[l] = std::max(rows_.from_leading[l], rows_.from_trailing[l]) + std::abs(rows_.offset[l]) +
                       Scalar(averages) * rows_.half[l];
        }
        split_ = kernel_.log_split(largest(reach) + largest(columns_.half));
        // near differences lose about d^2 / (4 h delta) roundings: with equal widths that allows a larger d, and a
        // Taylor series, which costs more a term than the other, of fewer terms
        const bool short_series = !split_ && equal_widths_;
        far_ratio_ = Scalar(1) / (short_series ? 4096 : 16);
        last_taylor_ = short_series ? last_moment / 3 + 1 : last_moment;
        if (split_) prepare_moments();
        if (split_) prepare_polynomial();
    }

    /// Writes the integral for every row l and element m to out(l, m).
    void fill(Matrix& out) const {
        if (split_) {
            split_series(out);
        } else if (kernel_.has_taylor()) {
            taylor_series(out);
        }
        near_differences(out);
    }

private:
    static constexpr Eigen::Index chunk = 8;  // rows a series is evaluated for at once: a few registers
    using Chunk = Eigen::Array<Scalar, chunk, 1>;
    static constexpr int last_moment = (std::numeric_limits<Scalar>::digits + 3) / 4;  // 16^-last is below rounding

    static RowPoints<Scalar> padded(const RowPoints<Scalar>& rows) {
        const Eigen::Index count = rows.half.size();
        const Eigen::Index full = (count + chunk - 1) / chunk * chunk;
        const auto pad = [&](const Array& values) {
            Array result(full);
            for (Eigen::Index l = 0; l < full; ++l) result[l] = values[std::min(l, count - 1)];
            return result;
        };
        return {pad(rows.from_trailing), pad(rows.from_leading), pad(rows.offset), pad(rows.half)};
    }

    bool has_series() const { return split_.has_value() || kernel_.has_taylor(); }
    Scalar distance(Eigen::Index l, Eigen::Index m) const {
        const Scalar between = columns_.from_trailing[m] <= 1 ? rows_.from_trailing[l] - columns_.from_trailing[m]
                                                              : columns_.from_leading[m] - rows_.from_leading[l];
        return between + rows_.offset[l];
    }
    bool is_near(Eigen::Index l, Eigen::Index m) const {
        const Scalar size = columns_.half[m] + Scalar(averages_) * rows_.half[l];
        const Scalar d = distance(l, m);
        return !has_series() || !(size * size < far_ratio_ * d * d);
    }
    // q = 1 takes g (0), H (1), H_integral (2) for 0, 1, 2 averages; q = 0 the next one
    int level() const { return averages_ + (quantity_ == Quantity::slope ? 0 : 1); }

    // --- near entries ------------------------------------------------------------------------------------------

    struct Run {
        Eigen::Index row, first, count, position;
    };

    // the antiderivative of the singular part, or of the whole kernel; what is constant for the slope is left out
    Array antiderivative(const Array& x) const {
        if (!split_ || level() > 2) return kernel_.antiderivative(level(), x);
        const Scalar s = split_->strength;
        const bool slope = quantity_ == Quantity::slope;
        if (level() == 1) {
            const Scalar constant = split_->constant + s;
            Array result = finite_log(x);
            for (Eigen::Index i = 0; i < x.size(); ++i) {
                result[i] = slope ? -s * x[i] * result[i] : x[i] * (constant - s * result[i]);
            }
            return result;
        }
        if (level() == 2) {
            const Scalar constant = (2 * split_->constant + 3 * s) / 4;
            Array result = finite_log(x);
            for (Eigen::Index i = 0; i < x.size(); ++i) {
                const Scalar square = x[i] * x[i];
                result[i] = slope ? -s / 2 * square * result[i] : square * (constant - s / 2 * result[i]);
            }
            return result;
        }
        Array result(x.size());
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] = std::abs(x[i]);
        log_in_place(result);
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] *= -s;
        return result;
    }

    void near_differences(Matrix& result) const {
        const Eigen::Index n = columns_.half.size();
        const Scalar spread = Scalar(averages_ + 1) / (2 * std::sqrt(far_ratio_));
        std::vector<Run> runs;
        std::vector<Scalar> arguments;
        runs.reserve(static_cast<std::size_t>(count_));
        arguments.reserve(static_cast<std::size_t>(std::min<Eigen::Index>(16 * count_, 2048)));
        for (Eigen::Index l = 0; l < count_; ++l) {
            if (equal_widths_ && has_series()) {  // the near columns surround the point
                const Scalar nearest = distance(l, 0) / (2 * columns_.half[0]);
                const Eigen::Index first = clamp_index(std::ceil(nearest - spread), n);
                const Eigen::Index end = clamp_index(std::floor(nearest + spread) + 1, n);
                if (end > first) append_run(l, first, end - first, runs, arguments);
            } else {
                for (Eigen::Index m = 0; m < n; ++m) {
                    const Eigen::Index first = m;
                    while (m < n && is_near(l, m)) ++m;
                    if (m > first) append_run(l, first, m - first, runs, arguments);
                }
            }
            if (arguments.size() > 2048 || l + 1 == count_) {
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

    void evaluate_runs(const std::vector<Run>& runs, const std::vector<Scalar>& arguments, Matrix& result) const {
        if (arguments.empty()) return;
        Array x(static_cast<Eigen::Index>(arguments.size()));
        std::copy(arguments.begin(), arguments.end(), x.data());
        const Array values = antiderivative(x);
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
                sum /= divisor;
                if (split_) sum += polynomial(run.row, run.first + i);
                result(run.row, run.first + i) = sum;
            }
        }
    }

    // --- far entries of a split kernel -----------------------------------------------------------------------------

    // Even moments of w: M_2j = 2h sum c_j S_j with S_j = sum_i A^(j-i) B^i, A = (h + delta)^2, B = (h - delta)^2,
    // c_j = 1/((2j+1)(j+1)) for one average; for none A = h^2, B = 0, c_j = 1/(2j+1). All terms are positive.
    // The slope takes sum M_2j / d^2j; the displacement, besides the logarithm, sum_{j>0} M_2j / (2j d^2j).
    void prepare_moments() {
        coefficients_.resize(last_moment + 1);
        for (Eigen::Index j = 0; j <= last_moment; ++j) {
            coefficients_[j] = 1 / Scalar(2 * j + 1);
            if (averages_ > 0) coefficients_[j] /= Scalar(j + 1);
            if (quantity_ == Quantity::displacement) coefficients_[j] *= j == 0 ? Scalar(0) : 1 / Scalar(2 * j);
        }
        // the ratio up to which the terms 0 ... j suffice; S_j <= (j + 1) A^j
        const auto bound = [](int j) {
            return std::pow(std::numeric_limits<Scalar>::epsilon() / 4 * Scalar(2 * j + 3), 1 / Scalar(j + 1));
        };
        bound_of_4_ = bound(4);
        bound_of_6_ = bound(6);
    }

    // sum_{j <= last} c_j S_j by Horner's rule in A, whose coefficients are Horner sums in B. With the length known to
    // the compiler and one entry a pass, the terms are unrolled and vectors of entries stay in registers.
    template <bool SingleRatio, int last>
    Chunk moment_sum(const Chunk& A, const Chunk& B) const {
        const Scalar* c = coefficients_.data();
        Chunk result;
        for (Eigen::Index i = 0; i < chunk; ++i) {
            Scalar b = c[last];
            Scalar sum = c[last];
            for (int j = last - 1; j >= 0; --j) {
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
        return moment_sum<SingleRatio, last_moment>(A, B);
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
        A = A.min(far_ratio_);
        if constexpr (!SingleRatio) B = B.min(far_ratio_);
        const Scalar scale = 2 * h * split_->strength;
        Chunk result = moment_sum<SingleRatio>(A, B);
        if (quantity_ == Quantity::slope) {
            for (Eigen::Index i = 0; i < chunk; ++i) result[i] *= -scale * inverse[i];
            return result;
        }
        Chunk logarithm;
        for (Eigen::Index i = 0; i < chunk; ++i) logarithm[i] = std::abs(d[i]);
        logarithm = logarithm.log();
        const Scalar constant = 2 * h * split_->constant;
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

    void split_series(Matrix& result) const {
        const bool twice = averages_ == 2, single_ratio = averages_ == 0 || equal_widths_;
        const QuadratureRule<Scalar> rule = second_average();
        const Eigen::Index degree = row_series_.cols();
        Table powers = common_powers_;
        for (Eigen::Index m = 0; m < columns_.half.size(); ++m) {
            const Scalar h = columns_.half[m];
            const bool trailing = columns_.from_trailing[m] <= 1;
            const Scalar origin = trailing ? columns_.from_trailing[m] : columns_.from_leading[m];
            const Scalar* from = trailing ? rows_.from_trailing.data() : rows_.from_leading.data();
            const Scalar sign = trailing ? 1 : -1;
            if (!equal_widths_) polynomial_coefficients(m, powers);
            for (Eigen::Index l = 0; l < count_; l += chunk) {
                Chunk d;
                for (Eigen::Index i = 0; i < chunk; ++i) d[i] = rows_.offset[l + i] + sign * (from[l + i] - origin);
                const Scalar* delta = rows_.half.data() + l;
                Chunk value = twice          ? twice_averaged(rule, d, h, delta)
                              : single_ratio ? log_series<true>(d, h, delta)
                                             : log_series<false>(d, h, delta);
                if (degree > 0) add_polynomial(powers, d, l, value);
                Scalar* out = result.data() + m * result.rows() + l;
                if (l + chunk <= count_) {
                    for (Eigen::Index i = 0; i < chunk; ++i) out[i] = value[i];
                } else {
                    std::copy_n(value.data(), count_ - l, out);
                }
            }
        }
    }

    // --- the polynomial part of a split kernel: the same for near and far -----------------------------------------

    // With sigma_j the coefficients of sinhc(h t) sinhc(delta t)^averages = sum M_2j t^2j / (2h (2j)!), the integral of
    // even_k x^{2k} is 2h sum_j sigma_j even_k (2k)!/(2k-q-2j)! d^(2k-q-2j): a polynomial in d^2, times d for the slope.
    void prepare_polynomial() {
        const Eigen::Index q = quantity_ == Quantity::slope ? 1 : 0;
        const Eigen::Index terms = split_->even.size();
        const Eigen::Index length = terms == 0 ? 0 : terms + 1 - q;
        // falling(i, j): contribution of sigma_j to the power i, k = i + j + q
        Table falling = zeros(length, length);
        for (Eigen::Index i = 0; i < length; ++i) {
            for (Eigen::Index j = i + q == 0 ? 1 : 0; i + j < length; ++j) {
                const Eigen::Index k = i + j + q;
                falling(i, j) = split_->even[k - 1];
                for (Eigen::Index f = 2 * i + q + 1; f <= 2 * k; ++f) falling(i, j) *= static_cast<Scalar>(f);
            }
        }
        // row l: coefficients of sinhc(delta_l t)^averages; with equal widths one row serves all
        const Table average = sinhc_series(rows_.half, equal_widths_ ? 1 : rows_.half.size(), length);
        row_series_ = zeros(average.rows(), length);
        for (Eigen::Index l = 0; l < average.rows() && length > 0; ++l) {
            row_series_(l, 0) = 1;
            for (int a = 0; a < averages_; ++a) {
                for (Eigen::Index j = length - 1; j > 0; --j) {
                    for (Eigen::Index i = 0; i < j; ++i) row_series_(l, j) += row_series_(l, i) * average(l, j - i);
                }
            }
        }
        // what factor k of a row contributes to the power i, for every element; with equal widths one serves all
        const Table element = sinhc_series(columns_.half, equal_widths_ ? 1 : columns_.half.size(), length);
        element_factors_ = zeros(element.rows(), length * length);
        for (Eigen::Index i = 0; i < length; ++i) {
            for (Eigen::Index k = 0; i + k < length; ++k) {
                for (Eigen::Index j = k; i + j < length; ++j) {
                    const Scalar factor = 2 * falling(i, j);
                    for (Eigen::Index m = 0; m < element.rows(); ++m) {
                        element_factors_(m, i * length + k) += factor * columns_.half[m] * element(m, j - k);
                    }
                }
            }
        }
        if (equal_widths_) polynomial_coefficients(0, common_powers_);
    }

    static Table zeros(Eigen::Index rows, Eigen::Index columns) {
        Table table(rows, columns);
        std::fill_n(table.data(), table.size(), Scalar(0));
        return table;
    }

    // of the first `count` widths
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

    // row l of `powers`: coefficients of d^2i for element m seen from row l
    void polynomial_coefficients(Eigen::Index m, Table& powers) const {
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

    void add_polynomial(const Table& powers, const Chunk& d, Eigen::Index l, Chunk& value) const {
        Chunk sum;
        if (equal_widths_ && powers.cols() == 3) {  // a wide strip: one loop stays in registers
            const Scalar constant = powers(0, 0), linear = powers(0, 1), quadratic = powers(0, 2);
            for (Eigen::Index i = 0; i < chunk; ++i) {
                const Scalar square = d[i] * d[i];
                sum[i] = (quadratic * square + linear) * square + constant;
            }
            if (quantity_ == Quantity::slope) {
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
        for (Eigen::Index i = 0; i < chunk; ++i) value[i] += quantity_ == Quantity::slope ? sum[i] * d[i] : sum[i];
    }

    Scalar polynomial(Eigen::Index l, Eigen::Index m) const {
        const Eigen::Index length = row_series_.cols();
        const Scalar d = distance(l, m);
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
        return quantity_ == Quantity::slope ? sum * d : sum;
    }

    // --- far entries of a kernel with a Taylor series ------------------------------------------------------------------

    void taylor_series(Matrix& result) const {
        const QuadratureRule<Scalar> rule = second_average();
        std::vector<Eigen::Index> far;
        for (Eigen::Index m = 0; m < columns_.half.size(); ++m) {
            far.clear();
            for (Eigen::Index l = 0; l < count_; ++l) {
                if (!is_near(l, m)) far.push_back(l);
            }
            if (far.empty()) continue;
            Array d(static_cast<Eigen::Index>(far.size())), delta(d.size());
            for (Eigen::Index i = 0; i < d.size(); ++i) {
                d[i] = distance(far[static_cast<std::size_t>(i)], m);
                delta[i] = rows_.half[far[static_cast<std::size_t>(i)]];
            }
            for (const Eigen::Index l : far) result(l, m) = 0;
            Array shifted(d.size());
            for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
                for (Eigen::Index i = 0; i < d.size(); ++i) shifted[i] = d[i] + rule.nodes[k] * delta[i];
                const Array sum = taylor_sum(shifted, columns_.half[m], delta);
                for (Eigen::Index i = 0; i < d.size(); ++i) {
                    result(far[static_cast<std::size_t>(i)], m) += rule.weights[k] / 2 * sum[i];
                }
            }
        }
    }

    // sum of M_2j g^{(q+2j)}(d) / (2j)! with the moments of prepare_moments
    Array taylor_sum(const Array& d, Scalar h, const Array& delta) const {
        const Eigen::Index q = quantity_ == Quantity::slope ? 1 : 0;
        const Table series = kernel_.taylor(d, 2 * last_taylor_ + q);
        const Eigen::Index size = d.size();
        Array A(size), B(size), sum(size), moment(size), power(size);
        for (Eigen::Index i = 0; i < size; ++i) {
            const Scalar outer = (averages_ > 0 ? h + delta[i] : h) / d[i], inner = (h - delta[i]) / d[i];
            A[i] = outer * outer;
            B[i] = averages_ > 0 ? inner * inner : Scalar(0);
            sum[i] = 0;
            moment[i] = 1;
            power[i] = B[i];
        }
        for (Eigen::Index j = 0; j <= last_taylor_; ++j) {
            const Scalar factor = averages_ > 0 ? 1 / Scalar((2 * j + 1) * (j + 1)) : 1 / Scalar(2 * j + 1);
            const Scalar weight = (q == 1 ? Scalar(2 * j + 1) : Scalar(1)) * factor;
            const Scalar* term = series.data() + (2 * j + q) * size;
            for (Eigen::Index i = 0; i < size; ++i) {
                sum[i] += weight * moment[i] * term[i];
                moment[i] = moment[i] * A[i] + power[i];
                power[i] *= B[i];
            }
        }
        for (Eigen::Index i = 0; i < size; ++i) sum[i] = 2 * h * (q == 1 ? sum[i] / d[i] : sum[i]);
        return sum;
    }

    // The second average is taken by quadrature: about a far point the integrand is analytic far beyond the interval,
    // where seven points reach double's rounding and nine long double's.
    QuadratureRule<Scalar> second_average() const {
        if (averages_ == 2) return gauss_legendre<Scalar>(std::numeric_limits<Scalar>::digits > 53 ? 9 : 7);
        QuadratureRule<Scalar> point{Array(1), Array(1)};
        point.nodes[0] = 0;
        point.weights[0] = 2;
        return point;
    }

    KernelView<Scalar> kernel_;
    Quantity quantity_;
    int averages_;
    bool equal_widths_;
    RowPoints<Scalar> rows_;  // padded to whole chunks by repeating the last
    ColumnElements<Scalar> columns_;
    Eigen::Index count_;  // rows asked for
    std::optional<LogSplit<Scalar>> split_;
    Scalar far_ratio_;  // ((h + averages delta) / d)^2 below which the series is taken
    int last_taylor_;   // far_ratio^last is below rounding
    Array coefficients_;
    Scalar bound_of_4_ = 0, bound_of_6_ = 0;
    Table row_series_, element_factors_, common_powers_;
};

}  // namespace rollbem::detail
