// StripKernel: the line kernel of a contact of finite half-width b.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Core>

#include "../detail/array_functions.hpp"
#include "../detail/finite.hpp"
#include "../scene/contact.hpp"
#include "../types.hpp"
#include "detail/parameters.hpp"
#include "detail/strip_series.hpp"
#include "kernel_concepts.hpp"

namespace rollbem {

/// Eqs. (3) and (7): Cerruti's solution, integrated over -b <= y <= b and seen from y = 0:
/// g = (2/(pi G)) [c1 asinh(b/|x|) + c2 b / sqrt(x^2 + b^2)].
template <class Scalar_ = double>
class StripKernel {
public:
    using Scalar = Scalar_;
    using Array = ArrayX<Scalar>;
    using Coefficients = Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

    /// half_width b in units of a; (c1, c2) = (1 - nu, nu) for longitudinal creepage and (1, -nu) for lateral. Throws
    /// std::invalid_argument unless b > 0 and c1 and c2 are finite.
    StripKernel(Scalar half_width, Scalar c1, Scalar c2) : b_(half_width), c1_(c1), c2_(c2) {
        detail::check_line_kernel("StripKernel", half_width, c1, c2);
    }

    static StripKernel longitudinal(const Contact<Scalar>& contact) {
        return detail::longitudinal_kernel<StripKernel>(contact);
    }
    static StripKernel lateral(const Contact<Scalar>& contact) { return detail::lateral_kernel<StripKernel>(contact); }

    Scalar half_width() const { return b_; }  ///< b in units of a

    Array g(const Array& x) const {
        const Array r = radius(x);
        Array result = asinh_of_inverse(x, r);
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] = scale() * (c1_ * result[i] + c2_ * b_ / r[i]);
        return result;
    }

    Array H(const Array& x) const {
        const Array r = radius(x), ratio = asinh_of_ratio(x, r);
        Array result = asinh_of_inverse(x, r);
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            result[i] = scale() * (c1_ * x[i] * result[i] + (c1_ + c2_) * b_ * ratio[i]);
        }
        return result;
    }

    /// Zero at x = 0: b (r - b) is written as b x^2 / (r + b), so that small x keep their digits next to a large b.
    Array H_integral(const Array& x) const {
        const Array r = radius(x), ratio = asinh_of_ratio(x, r);
        Array result = asinh_of_inverse(x, r);
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            const Scalar square = x[i] * x[i], rise = b_ * square / (r[i] + b_);
            result[i] = scale() * (c1_ / 2 * (square * result[i] + rise) + (c1_ + c2_) * (b_ * x[i] * ratio[i] - rise));
        }
        return result;
    }

    /// Exists for reach <= b/4.
    std::optional<LogSplit<Scalar>> log_split(Scalar reach) const;

    /// With r = sqrt(x^2 + b^2), asinh(b/|x|) = ln(2b) - ln|x| + ln((b + r)/(2b)) and b/r = 1 + (b/r - 1): r has branch
    /// points at +-ib.
    SmoothSplit<Scalar> smooth_split() const { return {scale() * (c1_ * std::log(2 * b_) + c2_), scale() * c1_, b_}; }
    /// With r = sqrt(x^2 + b^2), written in x/r and b/r so that nothing overflows or cancels.
    Scalar smooth_slope(Scalar x) const {
        if (!detail::is_finite(b_)) return 0;
        const Scalar r = std::sqrt(x * x + b_ * b_);
        return scale() * (x / r) * (c1_ / (b_ + r) - c2_ * (b_ / r) / r);
    }
    /// (2/pi) [c1 ln((b + r)/(2b)) + c2 (b/r - 1)] with r - b = x^2/(r + b): nothing cancels in wide strips.
    Array smooth_part(const Array& x) const {
        const Array r = radius(x);
        Array rise(x.size());
        for (Eigen::Index i = 0; i < x.size(); ++i) rise[i] = x[i] * x[i] / (r[i] + b_);
        Array u(x.size());
        for (Eigen::Index i = 0; i < x.size(); ++i) u[i] = rise[i] / (2 * b_);
        Array result = detail::log1p_array(u);
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] = scale() * (c1_ * result[i] - c2_ * (rise[i] / r[i]));
        return result;
    }

    /// Column k is g^{(k)}(x) x^k / k!, k = 0 ... order.
    Coefficients taylor(const Array& x, Eigen::Index order) const;

private:
    static constexpr Scalar scale() { return 2 / std::numbers::pi_v<Scalar>; }
    // r = sqrt(x^2 + b^2)
    Array radius(const Array& x) const {
        Array result(x.size());
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] = x[i] * x[i] + b_ * b_;
        detail::sqrt_in_place(result);
        return result;
    }

    // asinh(b/|x|) = ln(1 + (b + b^2/(r + |x|)) / |x|)
    Array asinh_of_inverse(const Array& x, const Array& r) const {
        const Scalar least = (std::numeric_limits<Scalar>::min)() * 8 * (1 + b_);  // b/size stays finite
        Array u(x.size());
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            const Scalar size = (std::max)(std::abs(x[i]), least);
            u[i] = (b_ + b_ * b_ / (r[i] + size)) / size;
        }
        return detail::log1p_array(u);
    }
    // asinh(x/b) = sign(x) ln(1 + (|x| + x^2/(r + b)) / b)
    Array asinh_of_ratio(const Array& x, const Array& r) const {
        Array u(x.size());
        for (Eigen::Index i = 0; i < x.size(); ++i) u[i] = (std::abs(x[i]) + x[i] * x[i] / (r[i] + b_)) / b_;
        Array result = detail::log1p_array(u);
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] = x[i] < 0 ? -result[i] : result[i];
        return result;
    }

    Scalar b_, c1_, c2_;
};

// The wide strip: with t = x/b, asinh(b/|x|) = ln(2b/|x|) + ln((1 + sqrt(1+t^2))/2), and with
// (1+t^2)^{-1/2} = sum beta_k t^{2k}, beta_k = -beta_{k-1} (2k-1)/(2k), the rest of g is
// (2/pi) sum_{k>=1} e_k t^{2k}, e_k = beta_k (c2 - c1/(2k)). With rho = reach/b, the derivative of the truncation error
// after K terms is at most (2/pi) sum_{k>K} 2k |e_k| rho^{2k} / |x| for |x| <= reach, whereas that of the logarithm is
// (2/pi) |c1| / |x|. As |beta_k| decreases, 2k |e_k| <= (2k |c2| + |c1|) |beta_{K+1}| and the sum is below
// (2(K+1) |c2| + |c1|) |beta_{K+1}| rho^{2K+2} / (1 - rho^2)^2. K is the smallest number of terms for which this is
// below half a rounding error of |c1|.
template <class Scalar_>
std::optional<LogSplit<Scalar_>> StripKernel<Scalar_>::log_split(Scalar reach) const {
    const Scalar rho = reach / b_;
    if (!(rho <= Scalar(0.25))) return std::nullopt;
    const Scalar square = rho * rho;
    const Scalar tolerance = std::numeric_limits<Scalar>::epsilon() / 4 * std::abs(c1_) * (1 - square) * (1 - square);
    const auto beta_ratio = [](Eigen::Index k) { return -Scalar(2 * k - 1) / Scalar(2 * k); };
    Eigen::Index terms = 0;
    Scalar beta = square * beta_ratio(1);  // of the first term left out, times its power of rho
    while ((Scalar(2 * terms + 2) * std::abs(c2_) + std::abs(c1_)) * std::abs(beta) > tolerance) {
        ++terms;
        beta *= square * beta_ratio(terms + 1);
    }
    LogSplit<Scalar> split{scale() * (c1_ * std::log(2 * b_) + c2_), scale() * c1_, Array(terms)};
    beta = scale();
    for (Eigen::Index k = 1; k <= terms; ++k) {
        beta *= beta_ratio(k) / b_ / b_;
        split.even[k - 1] = beta * (c2_ - c1_ / Scalar(2 * k));
    }
    return split;
}

// g' = -(2b/pi) [c1/(x r) + c2 x/r^3]: coefficient k of x g', integrated, is coefficient k + 1 of g.
template <class Scalar_>
typename StripKernel<Scalar_>::Coefficients StripKernel<Scalar_>::taylor(const Array& x, Eigen::Index order) const {
    using Series = detail::StripSeries<Scalar>;
    const Eigen::Index size = x.size();
    const Array r = radius(x), value = g(x);
    Coefficients result(size, order + 1);
    std::copy_n(value.data(), size, result.data());
    for (Eigen::Index first = 0; first < size; first += Series::size) {
        const Eigen::Index count = (std::min)(Series::size, size - first);
        Series series(x.data() + first, r.data() + first, count);
        for (Eigen::Index k = 0; k < order; ++k) {
            Scalar coefficient[Series::size];
            series.next(k, -scale() * b_ / static_cast<Scalar>(k + 1), c1_, c2_, coefficient);
            std::copy_n(coefficient, count, result.data() + (k + 1) * size + first);
        }
    }
    return result;
}

}  // namespace rollbem
