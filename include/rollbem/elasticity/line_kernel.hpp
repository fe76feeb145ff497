// Line kernels: displacement of the surface under a line of unit traction across the contact, and its antiderivatives.
// StripKernel for a finite half-width b, PlaneKernel for its limit b >> a; both know no mesh.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Core>

#include "../closed_form/plane_lambda.hpp"
#include "../detail/array_functions.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../scene/contact.hpp"
#include "../types.hpp"

namespace rollbem {

/// What the assembly needs of a kernel. x in units of a, results in units of 1/G (g), a/G (H) and a^2/G.
/// - g(x): displacement at distance x from the line, even in x; may be infinite at x = 0;
/// - H(x): an odd antiderivative of g, H(0) = 0;
/// - H_integral(x): an even antiderivative of H.
template <class Kernel>
concept LineKernel = requires(const Kernel& kernel, const ArrayX<typename Kernel::Scalar>& x) {
    { kernel.g(x) } -> std::convertible_to<ArrayX<typename Kernel::Scalar>>;
    { kernel.H(x) } -> std::convertible_to<ArrayX<typename Kernel::Scalar>>;
    { kernel.H_integral(x) } -> std::convertible_to<ArrayX<typename Kernel::Scalar>>;
};

/// g(x) = constant - strength ln|x| + sum_{k>=1} even[k-1] x^{2k}: a kernel taken apart into its singularity, which is
/// the same for all, and a polynomial. The assembly uses it where there is one: cheaper and without cancellation.
template <class Scalar>
struct LogSplit {
    Scalar constant;  ///< [1/G]; infinite for b = inf, where only the derivative of g exists
    Scalar strength;  ///< [1/G]
    ArrayX<Scalar> even;
};

/// A kernel that offers its LogSplit, exact to rounding for |x| <= reach, or nothing where there is no short one.
template <class Kernel>
concept SplitKernel = LineKernel<Kernel> && requires(const Kernel& kernel, typename Kernel::Scalar reach) {
    { kernel.log_split(reach) } -> std::same_as<std::optional<LogSplit<typename Kernel::Scalar>>>;
};

/// g(x) = constant - strength ln|x| + smooth_part(x) for every x: the singularity, and what is analytic beside it.
template <class Scalar>
struct SmoothSplit {
    Scalar constant;  ///< [1/G]; infinite for b = inf, where only the derivative of g exists
    Scalar strength;  ///< [1/G], positive
    Scalar distance;  ///< smooth_part is analytic but for +-i distance and beyond on the imaginary axis; infinite where
                      ///< it is zero everywhere
};

/// A kernel that offers its SmoothSplit, and smooth_part(x), even in x and zero at x = 0: what a discretisation by
/// polynomials asks for, which takes the logarithm in closed form and the rest by quadrature.
template <class Kernel>
concept SmoothSplitKernel = LineKernel<Kernel> && requires(const Kernel& kernel) {
    { kernel.smooth_split() } -> std::same_as<SmoothSplit<typename Kernel::Scalar>>;
} && requires(const Kernel& kernel, const ArrayX<typename Kernel::Scalar>& x) {
    { kernel.smooth_part(x) } -> std::convertible_to<ArrayX<typename Kernel::Scalar>>;
};

/// A SmoothSplitKernel that offers the derivative of its smooth part, too: g'(x) = -strength/x + smooth_slope(x).
template <class Kernel>
concept SlopeSplitKernel = SmoothSplitKernel<Kernel> && requires(const Kernel& kernel, typename Kernel::Scalar x) {
    { kernel.smooth_slope(x) } -> std::same_as<typename Kernel::Scalar>;
};

/// A kernel that offers its Taylor coefficients: column k of taylor(x, order) is g^{(k)}(x) x^k / k!, k = 0 ... order.
template <class Kernel>
concept TaylorKernel = LineKernel<Kernel> && requires(const Kernel& kernel, const ArrayX<typename Kernel::Scalar>& x) {
    {
        kernel.taylor(x, 1)
        } -> std::convertible_to<Eigen::Array<typename Kernel::Scalar, Eigen::Dynamic, Eigen::Dynamic>>;
};

namespace detail {

/// What a kernel of a contact 2b wide asks of its parameters.
template <class Scalar>
void check_line_kernel(const char* who, Scalar half_width, Scalar c1, Scalar c2) {
    require(!is_nan(half_width) && half_width > 0, who, "half_width", half_width, "be positive");
    require(is_finite(c1), who, "c1", c1, "be finite");
    require(is_finite(c2), who, "c2", c2, "be finite");
}

/// The kernel of a contact, with (c1, c2) for either direction of creepage.
template <class Kernel>
Kernel longitudinal_kernel(const Contact<typename Kernel::Scalar>& contact) {
    return Kernel(contact.aspect(), 1 - contact.poisson_ratio(), contact.poisson_ratio());
}
template <class Kernel>
Kernel lateral_kernel(const Contact<typename Kernel::Scalar>& contact) {
    return Kernel(contact.aspect(), typename Kernel::Scalar(1), -contact.poisson_ratio());
}

/// ln|x|, with ln 0 replaced by a finite number so that x ln|x| is 0 at x = 0.
template <class Scalar>
ArrayX<Scalar> finite_log(const ArrayX<Scalar>& x) {
    ArrayX<Scalar> result(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        result[i] = std::max(std::abs(x[i]), std::numeric_limits<Scalar>::min());
    }
    log_in_place(result);
    return result;
}

/// ln(1 + u) for u >= 0 to full relative accuracy: ln(w) u / (w - 1) with w = 1 + u rounded cancels the rounding of w;
/// where w = 1, the result is u.
template <class Scalar>
ArrayX<Scalar> log1p_array(const ArrayX<Scalar>& u) {
    ArrayX<Scalar> result(u.size());
    for (Eigen::Index i = 0; i < u.size(); ++i) {
        const Scalar w = u[i] + 1;
        result[i] = w == 1 ? u[i] : std::log(w) * (u[i] / (w - 1));
    }
    return result;
}

}  // namespace detail

/// Limit b >> a of the strip, the kernel of Eq. (20): g = (1/(pi G)) [c1 ln(4 b^2/x^2) + 2 c2]. b stays a parameter;
/// for b = inf only g' exists, hence only steady problems do.
template <class Scalar_ = double>
class PlaneKernel {
public:
    using Scalar = Scalar_;
    using Array = ArrayX<Scalar>;

    /// half_width b in units of a; (c1, c2) = (1 - nu, nu) for longitudinal creepage. Throws unless b > 0 and both are
    /// finite.
    PlaneKernel(Scalar half_width, Scalar c1, Scalar c2)
        : b_(half_width),
          lambda_(detail::plane_lambda_of(half_width, c2 / c1)),
          strength_(2 * c1 / std::numbers::pi_v<Scalar>),
          constant_(2 / std::numbers::pi_v<Scalar> * (c1 * std::log(2 * half_width) + c2)) {
        detail::check_line_kernel("PlaneKernel", half_width, c1, c2);
    }

    static PlaneKernel longitudinal(const Contact<Scalar>& contact) {
        return detail::longitudinal_kernel<PlaneKernel>(contact);
    }
    static PlaneKernel lateral(const Contact<Scalar>& contact) { return detail::lateral_kernel<PlaneKernel>(contact); }

    Scalar half_width() const { return b_; }  ///< b in units of a

    /// Lambda = ln(4b/a) + c2/c1, for longitudinal creepage ln(4b/a) + nu/(1-nu): the compliance of a constant
    /// displacement over that of the first harmonic. All modes of the plane model decay where Lambda > 0, one of them
    /// grows where Lambda < 0: the kernel is then used far outside b >> a.
    Scalar lambda() const { return lambda_; }

    Array g(const Array& x) const {
        Array result(x.size());
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] = std::abs(x[i]);
        detail::log_in_place(result);
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] = constant_ - strength_ * result[i];
        return result;
    }
    Array H(const Array& x) const {
        Array result = detail::finite_log(x);
        const Scalar sum = constant_ + strength_;
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] = x[i] * (sum - strength_ * result[i]);
        return result;
    }
    Array H_integral(const Array& x) const {
        Array result = detail::finite_log(x);
        const Scalar sum = (2 * constant_ + 3 * strength_) / 4;
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] = x[i] * x[i] * (sum - strength_ / 2 * result[i]);
        return result;
    }
    std::optional<LogSplit<Scalar>> log_split(Scalar) const { return LogSplit<Scalar>{constant_, strength_, {}}; }
    SmoothSplit<Scalar> smooth_split() const { return {constant_, strength_, std::numeric_limits<Scalar>::infinity()}; }
    Array smooth_part(const Array& x) const { return detail::constant_array(x.size(), Scalar(0)); }
    Scalar smooth_slope(Scalar) const { return 0; }

private:
    Scalar b_, lambda_, strength_, constant_;
};

/// Eqs. (3) and (7): Cerruti's solution, integrated over -b <= y <= b and seen from y = 0:
/// g = (2/(pi G)) [c1 asinh(b/|x|) + c2 b / sqrt(x^2 + b^2)].
template <class Scalar_ = double>
class StripKernel {
public:
    using Scalar = Scalar_;
    using Array = ArrayX<Scalar>;

    /// half_width b in units of a; (c1, c2) = (1 - nu, nu) for longitudinal creepage. Throws unless b > 0 and both are
    /// finite.
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

    /// Zero at x = 0: b (r - b) is written as b x^2 / (r + b), so that small x lose nothing to the size of b.
    Array H_integral(const Array& x) const {
        const Array r = radius(x), ratio = asinh_of_ratio(x, r);
        Array result = asinh_of_inverse(x, r);
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            const Scalar square = x[i] * x[i], rise = b_ * square / (r[i] + b_);
            result[i] = scale() * (c1_ / 2 * (square * result[i] + rise) + (c1_ + c2_) * (b_ * x[i] * ratio[i] - rise));
        }
        return result;
    }

    /// The wide strip: with t = x/b, asinh(b/|x|) = ln(2b/|x|) + ln((1 + sqrt(1+t^2))/2), and with
    /// (1+t^2)^{-1/2} = sum beta_k t^{2k}, beta_k = -beta_{k-1} (2k-1)/(2k), the rest of g is
    /// (2/pi) sum_{k>=1} e_k t^{2k}, e_k = beta_k (c2 - c1/(2k)). With rho = reach/b, the derivative of what is cut off
    /// after K terms is at most (2/pi) sum_{k>K} 2k |e_k| rho^{2k} / |x| for |x| <= reach, that of the logarithm is
    /// (2/pi) |c1| / |x|. As |beta_k| decreases, 2k |e_k| <= (2k |c2| + |c1|) |beta_{K+1}| and the sum is below
    /// (2(K+1) |c2| + |c1|) |beta_{K+1}| rho^{2K+2} / (1 - rho^2)^2: K is the first for which this is below half a
    /// rounding of |c1|.
    std::optional<LogSplit<Scalar>> log_split(Scalar reach) const {
        const Scalar rho = reach / b_;
        if (!(rho <= Scalar(0.25))) return std::nullopt;
        const Scalar square = rho * rho;
        const Scalar tolerance =
            std::numeric_limits<Scalar>::epsilon() / 4 * std::abs(c1_) * (1 - square) * (1 - square);
        const auto beta_ratio = [](Eigen::Index k) { return -Scalar(2 * k - 1) / Scalar(2 * k); };
        Eigen::Index terms = 0;
        Scalar beta = square * beta_ratio(1);  // of the first term cut off, times its power of rho
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

    /// g' = -(2b/pi) [c1/(x r) + c2 x/r^3]; the series of 1/r and 1/r^3 about x follow from
    /// (r^2) y' + x y = 0 and (r^2) z' + 3 x z = 0, scaled by x^k so that no power overflows.
    Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic> taylor(const Array& x, Eigen::Index order) const {
        const Eigen::Index size = x.size();
        const Array r = radius(x), value = g(x);
        Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic> result(size, order + 1);
        std::copy_n(value.data(), size, result.data());
        constexpr Eigen::Index tile = 8;  // points at once: their series stay in registers
        for (Eigen::Index first = 0; first < size; first += tile) {
            const Eigen::Index count = std::min(tile, size - first);
            Scalar square[tile], kappa[tile], y[tile], z[tile];
            Scalar y_before[tile] = {}, z_before[tile] = {};
            Scalar y_over_x[tile];  // series of x y/(x + tau), times x
            for (Eigen::Index j = 0; j < tile; ++j) {
                const Eigen::Index i = first + std::min(j, count - 1);
                square[j] = x[i] * x[i];
                kappa[j] = square[j] / (r[i] * r[i]);
                y[j] = y_over_x[j] = 1 / r[i];
                z[j] = y[j] * y[j] * y[j];
            }
            for (Eigen::Index k = 0; k < order; ++k) {
                const Scalar i = static_cast<Scalar>(k), factor = -scale() * b_ / (i + 1);
                Scalar coefficient[tile];
                for (Eigen::Index j = 0; j < tile; ++j) {
                    // coefficient k of x g', then integrated to coefficient k + 1 of g
                    const Scalar x_times_z = square[j] * (z[j] + z_before[j]);
                    coefficient[j] = factor * (c1_ * y_over_x[j] + c2_ * x_times_z);
                    const Scalar y_next = -kappa[j] * ((2 * i + 1) * y[j] + i * y_before[j]) / (i + 1);
                    const Scalar z_next = -kappa[j] * ((2 * i + 3) * z[j] + (i + 2) * z_before[j]) / (i + 1);
                    y_before[j] = y[j];
                    y[j] = y_next;
                    z_before[j] = z[j];
                    z[j] = z_next;
                    y_over_x[j] = y_next - y_over_x[j];
                }
                std::copy_n(coefficient, count, result.data() + (k + 1) * size + first);
            }
        }
        return result;
    }

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
        const Scalar least = std::numeric_limits<Scalar>::min() * 8 * (1 + b_);  // b/size stays finite
        Array u(x.size());
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            const Scalar size = std::max(std::abs(x[i]), least);
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

}  // namespace rollbem
