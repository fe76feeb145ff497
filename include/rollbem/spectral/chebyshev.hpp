// Full adhesion by Chebyshev polynomials in place of elements, for kernels with a logarithm: a handful of unknowns in
// geometric convergence. The same system as elements give, so that all that takes one runs on it unchanged.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "../assembly/rolling_system.hpp"
#include "../closed_form/carter.hpp"
#include "../detail/finite.hpp"
#include "../detail/reciprocal_condition.hpp"
#include "../detail/require.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../elasticity/plane_model.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "detail/quotient.hpp"

namespace rollbem {

struct Chebyshev;
template <class Scalar>
struct ChebyshevSteadySolution;

namespace detail {
template <SmoothSplitKernel Kernel>
ChebyshevSteadySolution<typename Kernel::Scalar> solve_chebyshev_steady(const Chebyshev& method, const Kernel& kernel);
}

/// The discretisation: m states u_0 ... u_{m-1}, the first Chebyshev coefficients of the displacement
/// u(x) = sum u_k T_k(x/a), for the traction p = sum_{k=0..m} a_k T_k(x/a)/sqrt(1 - (x/a)^2). Zero slip,
/// du/dx - du/dq = xi, holds in the coefficients of T_0 ... T_{m-1}; u_m follows from p = 0 at the leading edge,
/// sum a_k = 0 (the tau method).
struct Chebyshev {
    Eigen::Index states = 12;

    /// Steady rolling at unit creepage. There u = x + a constant that only sum a_k = 0 sets, so that K_00 is not needed
    /// and an infinite half-width has a solution. For the plane kernel it is exact from one state on. Throws
    /// std::invalid_argument for no states and b/a < 0.001. A friend, so that only calls with a Chebyshev see it.
    template <SmoothSplitKernel Kernel>
    friend ChebyshevSteadySolution<typename Kernel::Scalar> solve_steady(const Chebyshev& method,
                                                                         const Kernel& kernel) {
        return detail::solve_chebyshev_steady(method, kernel);
    }
};

/// A traction by its coefficients: p/G, or p/(G xi), is sum a_k T_k(x/a)/sqrt(1 - (x/a)^2), where the a_k add up to
/// zero. It vanishes like a square root at the leading edge and is infinite at the trailing one. Value is real, or
/// complex for harmonic creepage.
template <class Value>
struct ChebyshevTraction {
    using Scalar = typename Eigen::NumTraits<Value>::Real;

    VectorX<Value> coefficients;

    /// Throws std::invalid_argument for distances that are negative or do not add up to 2.
    Value operator()(const EdgeDistances<Scalar>& position) const;

    /// At x/a. Throws std::invalid_argument unless -1 <= x/a <= 1.
    Value operator()(std::type_identity_t<Scalar> x_over_a) const {
        detail::require(detail::is_finite(x_over_a) && std::abs(x_over_a) <= 1, "ChebyshevTraction", "x/a", x_over_a,
                        "lie in [-1, 1]");
        return (*this)(EdgeDistances<Scalar>{1 + x_over_a, 1 - x_over_a});
    }
};

/// The system of Chebyshev states: its unknowns are displacement coefficients u_0 ... u_{m-1}, in units of a, its
/// equations are those of zero slip at the m Chebyshev points, trailing to leading.
///
/// Invariant: besides that of RollingSystem, the half-width is finite.
template <class Scalar_>
class ChebyshevSystem : public RollingSystem<Scalar_> {
public:
    using Scalar = Scalar_;

    /// p/G of unknowns as any problem on the system returns them, real or complex; of p/G per creepage alike. Throws
    /// std::invalid_argument unless there are size() unknowns.
    template <class Value>
    ChebyshevTraction<Value> traction(const VectorX<Value>& unknowns) const {
        detail::require(unknowns.size() == this->size(), "ChebyshevSystem", "number of unknowns", unknowns.size(),
                        "equal the number of states");
        return {stiffness_.template cast<Value>() * unknowns};
    }

    /// A = G^-1 G' without an inverse: du/dq = A u - e_0 xi, q = V t/a.
    MatrixX<Scalar> rates() const;

    template <SmoothSplitKernel Kernel>
    friend ChebyshevSystem<typename Kernel::Scalar> rolling_system(const Chebyshev& method, const Kernel& kernel);

private:
    ChebyshevSystem(RollingSystem<Scalar> system, VectorX<Scalar> last, MatrixX<Scalar> stiffness)
        : RollingSystem<Scalar>(std::move(system)), last_(std::move(last)), stiffness_(std::move(stiffness)) {}

    VectorX<Scalar> last_;       // u_m = last . u
    MatrixX<Scalar> stiffness_;  // (m+1) x m: a_0 ... a_m of u
};

/// Steady rolling at unit creepage, dimensionless.
template <class Scalar>
struct ChebyshevSteadySolution {
    ChebyshevTraction<Scalar> traction;  ///< traction(x/a) is p/(G xi) [-]
    Scalar c11 = 0;                      ///< creep coefficient -F_bar/(a G xi) [-], Eq. (30)
    /// Of c11, relative: twice what the last two coefficients owe to the smooth part of the kernel. They decay
    /// geometrically.
    Scalar error_estimate = 0;
    Scalar rcond = 0;                    ///< estimate of 1/(|K| |K^-1|) of the scaled equations in the 1-norm [-]
    Status status = Status::not_finite;  ///< not_converged where error_estimate exceeds 1e-2
};

namespace detail {

/// The circle in 4 count equal steps: cosines and sines of k pi/(2 count).
template <class Scalar>
class CircleTable {
public:
    explicit CircleTable(Eigen::Index count) : cosines_(static_cast<std::size_t>(4 * count)), quarter_(count) {
        const Scalar step = std::numbers::pi_v<Scalar> / static_cast<Scalar>(2 * count);
        for (Eigen::Index k = 0; k <= count;
             ++k) {  // the smaller of two angles, so that small cosines keep their digits
            const Scalar value = 2 * k <= count ? std::cos(static_cast<Scalar>(k) * step)
                                                : std::sin(static_cast<Scalar>(count - k) * step);
            set(k, value);
            set(2 * count - k, -value);
            set(2 * count + k, -value);
            if (k > 0) set(4 * count - k, value);
        }
    }

    Eigen::Index size() const { return 4 * quarter_; }
    Scalar cosine(Eigen::Index k) const { return cosines_[static_cast<std::size_t>(k)]; }  ///< 0 <= k < size()
    Scalar sine(Eigen::Index k) const { return cosine(k >= quarter_ ? k - quarter_ : k + 3 * quarter_); }

private:
    void set(Eigen::Index k, Scalar value) { cosines_[static_cast<std::size_t>(k)] = value; }

    std::vector<Scalar> cosines_;
    Eigen::Index quarter_;
};

/// Checks method and kernel; returns the kernel's split.
template <SmoothSplitKernel Kernel>
SmoothSplit<typename Kernel::Scalar> chebyshev_split(const Chebyshev& method, const Kernel& kernel) {
    using Scalar = typename Kernel::Scalar;
    require(method.states >= 1, "Chebyshev", "states", method.states, "be at least 1");
    require(method.states <= 10000, "Chebyshev", "states", method.states, "be at most 10000");
    const SmoothSplit<Scalar> split = kernel.smooth_split();
    require(is_finite(split.strength) && split.strength > 0, "Chebyshev", "strength of the kernel's logarithm",
            split.strength, "be positive and finite");
    require(!is_nan(split.distance) && split.distance >= Scalar(0.001), "Chebyshev",
            "b/a of the kernel (distance of its smooth part's singularity)", split.distance,
            "be at least 0.001: take elements for so narrow a strip");
    return split;
}

/// How many Gauss-Chebyshev points take the smooth part against T_0 ... T_m to rounding.
///
/// For x in [-1, 1], e(x - y) as a function of y is analytic but for x +-ib and beyond. The ellipse with foci +-1 and
/// the minor half-axis b, the Bernstein ellipse of rho = b + sqrt(1 + b^2), leaves all of them outside or on it, so
/// that the coefficient of T_n(y) falls off like rho^-n (the singularities are integrable). N points do not tell T_n
/// from T_k where n = 2N - k or higher: what they make of the integral against T_k, k <= m, is wrong by some rho^-(2N -
/// m). The same holds for the coefficient of T_j(x), j <= m. It is below rounding from 2N - m = ln(1/eps)/ln(rho) on,
/// and ln(rho) = asinh(b); N > m keeps the T_k apart. Ten more make up for the factor before rho^-n.
template <class Scalar>
Eigen::Index smooth_quadrature_points(Eigen::Index m, Scalar b) {
    if (!is_finite(b)) return m + 1;
    const Scalar extra = -std::log(std::numeric_limits<Scalar>::epsilon()) / std::asinh(b) + 10;
    return std::max(m + 1, (m + static_cast<Eigen::Index>(std::ceil(extra)) + 1) / 2);
}

/// Entry (j, k), j and k from 0 to m: the coefficient of T_j(x) in the integral of e(x - y) T_k(y)/sqrt(1 - y^2), e the
/// smooth part, from `points` Gauss-Chebyshev points in x and y. As e is even, entries with odd j + k vanish, and half
/// of the x do.
template <SmoothSplitKernel Kernel>
MatrixX<typename Kernel::Scalar> smooth_compliance(const Kernel& kernel, Eigen::Index m, Eigen::Index points) {
    using Scalar = typename Kernel::Scalar;
    const CircleTable<Scalar> circle(points);
    const auto angle = [&](Eigen::Index k, Eigen::Index point) { return k * (2 * point + 1) % circle.size(); };
    MatrixX<Scalar> polynomials(points, m + 1);  // T_k at the points
    for (Eigen::Index k = 0; k <= m; ++k) {
        for (Eigen::Index q = 0; q < points; ++q) polynomials(q, k) = circle.cosine(angle(k, q));
    }
    MatrixX<Scalar> compliance = MatrixX<Scalar>::Zero(m + 1, m + 1);
    ArrayX<Scalar> distance(points);
    VectorX<Scalar> displacement(m + 1);
    for (Eigen::Index p = 0; 2 * p < points; ++p) {
        for (Eigen::Index q = 0; q < points; ++q) distance[q] = polynomials(p, 1) - polynomials(q, 1);
        const ArrayX<Scalar> smooth = kernel.smooth_part(distance);
        displacement.noalias() = polynomials.transpose() * smooth.matrix();
        const Scalar share = 2 * p + 1 == points ? Scalar(1) : Scalar(2);  // of -x, too
        for (Eigen::Index k = 0; k <= m; ++k) {
            for (Eigen::Index j = k % 2; j <= m; j += 2) {
                compliance(j, k) += share * polynomials(p, j) * displacement[k];
            }
        }
    }
    const Scalar count = static_cast<Scalar>(points);
    compliance *= 2 * std::numbers::pi_v<Scalar> / count / count;
    compliance.row(0) /= 2;
    return compliance;
}

/// K of u = K a, row j >= 1 times j/(pi S), row 0 over pi S, S the strength: for j >= 1 the identity and a smooth rest.
template <SmoothSplitKernel Kernel>
MatrixX<typename Kernel::Scalar> scaled_compliance(const Kernel& kernel,
                                                   const SmoothSplit<typename Kernel::Scalar>& split, Eigen::Index m) {
    using Scalar = typename Kernel::Scalar;
    MatrixX<Scalar> K;
    if (is_finite(split.distance)) {
        K = smooth_compliance(kernel, m, smooth_quadrature_points(m, split.distance));
        const Scalar scale = std::numbers::pi_v<Scalar> * split.strength;
        for (Eigen::Index j = 0; j <= m; ++j) K.row(j) *= static_cast<Scalar>(std::max<Eigen::Index>(j, 1)) / scale;
    } else {
        K.setZero(m + 1, m + 1);
    }
    K(0, 0) += split.constant / split.strength + std::numbers::ln2_v<Scalar>;
    for (Eigen::Index j = 1; j <= m; ++j) K(j, j) += 1;
    return K;
}

/// K^-1.
template <SmoothSplitKernel Kernel>
MatrixX<typename Kernel::Scalar> chebyshev_stiffness(const Kernel& kernel,
                                                     const SmoothSplit<typename Kernel::Scalar>& split,
                                                     Eigen::Index m) {
    using Scalar = typename Kernel::Scalar;
    const Scalar scale = std::numbers::pi_v<Scalar> * split.strength;
    MatrixX<Scalar> stiffness;
    if (is_finite(split.distance)) {
        stiffness = Eigen::PartialPivLU<MatrixX<Scalar>>(scaled_compliance(kernel, split, m)).inverse();
    } else {
        stiffness.setZero(m + 1, m + 1);
        stiffness(0, 0) = 1 / (split.constant / split.strength + std::numbers::ln2_v<Scalar>);
        for (Eigen::Index j = 1; j <= m; ++j) stiffness(j, j) = 1;
    }
    for (Eigen::Index j = 0; j <= m; ++j) {
        const Scalar factor = static_cast<Scalar>(std::max<Eigen::Index>(j, 1)) / scale;
        for (Eigen::Index i = 0; i <= m; ++i) stiffness(i, j) *= factor;
    }
    return stiffness;
}

}  // namespace detail

template <class Value>
Value ChebyshevTraction<Value>::operator()(const EdgeDistances<Scalar>& position) const {
    detail::require(detail::is_finite(position.trailing) && position.trailing >= 0, "ChebyshevTraction", "trailing",
                    position.trailing, "be at least 0");
    detail::require(detail::is_finite(position.leading) && position.leading >= 0, "ChebyshevTraction", "leading",
                    position.leading, "be at least 0");
    const Scalar sum = position.trailing + position.leading;
    detail::require(std::abs(sum - 2) <= std::sqrt(std::numeric_limits<Scalar>::epsilon()), "ChebyshevTraction",
                    "trailing + leading", sum, "be 2");
    return detail::quotient_by_leading(coefficients, position.leading) *
           std::sqrt(position.leading / position.trailing);
}

template <class Scalar_>
MatrixX<Scalar_> ChebyshevSystem<Scalar_>::rates() const {
    const Eigen::Index m = this->size();
    MatrixX<Scalar> A(m, m);
    // T_k' = 2k (T_{k-1} + T_{k-3} + ...), where T_0 counts half
    const auto derivative = [](Eigen::Index i, Eigen::Index k) {
        if (i >= k || (k - i) % 2 == 0) return Scalar(0);
        return static_cast<Scalar>(i == 0 ? k : 2 * k);
    };
    for (Eigen::Index k = 0; k < m; ++k) {
        for (Eigen::Index i = 0; i < m; ++i) A(i, k) = derivative(i, k) + derivative(i, m) * last_[k];
    }
    return A;
}

/// The system of Chebyshev states: G = (T_k(x_l)) at the m Chebyshev points, whose condition is sqrt(2), and G' = G A =
/// (T_k'(x_l) + T_m'(x_l) last_k). Throws std::invalid_argument for no states, an infinite half-width (its system does
/// not exist; solve_steady has it), b/a < 0.001, and for a plane kernel with Lambda <= 0, whose model grows in time.
/// Narrow strips need more states: for 1e-9, about 8 at b/a = 10, 16 at 1 and 32 at 0.3. Rounding sets no limit to the
/// states (tried to 1500), but the fastest mode decays at some m^2/10, and from m = 200 on rcond(G') is below what
/// FrequencySweep asks for its reduction.
template <SmoothSplitKernel Kernel>
ChebyshevSystem<typename Kernel::Scalar> rolling_system(const Chebyshev& method, const Kernel& kernel) {
    using Scalar = typename Kernel::Scalar;
    require_stable_model(kernel);
    const SmoothSplit<Scalar> split = detail::chebyshev_split(method, kernel);
    detail::require(detail::is_finite(split.constant), "Chebyshev", "constant part of the kernel", split.constant,
                    "be finite: an infinite half-width is for steady problems only");
    const Eigen::Index m = method.states;
    const MatrixX<Scalar> inverse = detail::chebyshev_stiffness(kernel, split, m);

    VectorX<Scalar> last(m), sums(m + 1);
    for (Eigen::Index k = 0; k <= m; ++k) {
        sums[k] = 0;
        for (Eigen::Index i = 0; i <= m; ++i) sums[k] += inverse(i, k);
    }
    for (Eigen::Index k = 0; k < m; ++k) last[k] = -sums[k] / sums[m];
    MatrixX<Scalar> stiffness(m + 1, m);
    ArrayX<Scalar> weights(m);
    for (Eigen::Index k = 0; k < m; ++k) {
        for (Eigen::Index i = 0; i <= m; ++i) stiffness(i, k) = inverse(i, k) + inverse(i, m) * last[k];
        weights[k] = std::numbers::pi_v<Scalar> * stiffness(0, k);
    }

    const detail::CircleTable<Scalar> circle(m);
    MatrixX<Scalar> G(m, m), G_prime(m, m);
    ArrayX<Scalar> points(m);
    for (Eigen::Index l = 0; l < m; ++l) {
        const Eigen::Index theta = 2 * (m - l) - 1;  // x_l = cos(theta pi/2m)
        points[l] = circle.cosine(theta);
        const Scalar sine = circle.sine(theta);
        const Scalar slope_m = (theta % 4 == 1 ? static_cast<Scalar>(m) : -static_cast<Scalar>(m)) / sine;
        Eigen::Index angle = 0;  // k theta
        for (Eigen::Index k = 0; k < m; ++k) {
            G(l, k) = circle.cosine(angle);
            G_prime(l, k) = static_cast<Scalar>(k) * circle.sine(angle) / sine + slope_m * last[k];
            angle += theta;
            if (angle >= circle.size()) angle -= circle.size();
        }
    }
    ChebyshevSystem<Scalar> system(RollingSystem<Scalar>(std::move(G), std::move(G_prime), std::move(weights)),
                                   std::move(last), std::move(stiffness));
    system.aspect_ = detail::aspect_of<Scalar>(kernel);
    system.log_strength_ = detail::strength_of_pure_logarithm<Scalar>(kernel);
    system.points_ = std::move(points);
    return system;
}

namespace detail {

template <SmoothSplitKernel Kernel>
ChebyshevSteadySolution<typename Kernel::Scalar> solve_chebyshev_steady(const Chebyshev& method, const Kernel& kernel) {
    using Scalar = typename Kernel::Scalar;
    const SmoothSplit<Scalar> split = detail::chebyshev_split(method, kernel);
    const Eigen::Index m = method.states;
    const Scalar carter = 1 / (std::numbers::pi_v<Scalar> * split.strength);
    MatrixX<Scalar> equations = detail::scaled_compliance(kernel, split, m);
    equations.row(0).setOnes();
    VectorX<Scalar> right = VectorX<Scalar>::Zero(m + 1);
    right[1] = carter;
    const Eigen::PartialPivLU<MatrixX<Scalar>> lu(equations);
    ChebyshevSteadySolution<Scalar> solution;
    VectorX<Scalar>& a = solution.traction.coefficients;
    a = lu.solve(right);
    solution.c11 = -std::numbers::pi_v<Scalar> * a[0];
    if (!detail::all_finite(a) || !detail::is_finite(solution.c11)) return solution;
    solution.rcond = detail::reciprocal_condition(lu, detail::one_norm(equations));
    const auto by_smooth_part = [&](Eigen::Index k) {
        return std::abs(k == 0 ? a[0] + carter : k == 1 ? a[1] - carter : a[k]);
    };
    const Scalar rounding = static_cast<Scalar>(m + 1) * std::numeric_limits<Scalar>::epsilon();
    solution.error_estimate = 2 * (by_smooth_part(m - 1) + by_smooth_part(m)) / std::abs(a[0]) + rounding;
    const bool trusted = detail::is_finite(solution.error_estimate) && detail::is_finite(solution.rcond) &&
                         solution.rcond > 100 * rounding;
    solution.status = !trusted                                  ? Status::ill_conditioned
                      : solution.error_estimate <= Scalar(1e-2) ? Status::ok
                                                                : Status::not_converged;
    return solution;
}

}  // namespace detail

}  // namespace rollbem
