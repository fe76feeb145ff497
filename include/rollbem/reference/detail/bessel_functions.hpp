// Modified Bessel functions of complex arguments and the eigenvalues of the plane model. Internal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <memory>
#include <new>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_bessel.h>

#include "../../closed_form/carter.hpp"
#include "../../detail/require.hpp"

namespace rollbem::reference::detail {

using rollbem::detail::require;
using rollbem::detail::require_finite;
using rollbem::detail::require_positive;
using Complex = std::complex<long double>;

/// I0(s), I1(s) and I0(s) + I1(s), each times e^{-|Re s|}. Computed in long double so that double results are exact to
/// rounding; the sum is formed without cancellation.
struct ScaledBessel {
    Complex i0, i1, sum;
};

/// For |s| >= 40 Hankel's expansions reach the precision of long double with 26 terms (the last is below 1e-23),
/// farther from the origin with fewer.
inline constexpr long double asymptotic_radius = 40;
inline constexpr int asymptotic_terms = 26;

/// Coefficients of I_order(s) ~ e^s/sqrt(2 pi s) sum_k c_k / s^k.
constexpr std::array<long double, asymptotic_terms> hankel_coefficients(int order) {
    std::array<long double, asymptotic_terms> c{};
    c[0] = 1;
    for (int k = 1; k < asymptotic_terms; ++k) {
        const long double odd = 2 * k - 1;
        c[static_cast<std::size_t>(k)] =
            -c[static_cast<std::size_t>(k - 1)] * (4.0L * order * order - odd * odd) / (8.0L * k);
    }
    return c;
}

/// I0 and I0 + I1 as e^{s} forward + i e^{-s} backward, for Im s >= 0 and up to the common factor 1/sqrt(2 pi s).
struct HankelSplit {
    Complex i0_forward, sum_forward, i0_backward, sum_backward;
};

inline HankelSplit hankel_split(Complex s) {
    constexpr std::array<long double, asymptotic_terms> c0 = hankel_coefficients(0), c1 = hankel_coefficients(1);
    const Complex inverse = 1.0L / s;
    const long double step = std::abs(inverse);
    std::size_t terms = 1;
    for (long double power = step; terms < c0.size() && c0[terms] * power > 1e-23L; power *= step) ++terms;
    HankelSplit split{};
    for (std::size_t k = terms; k-- > 0;) {  // Horner's rule; e^{-s} has alternating signs, and I1 with a minus
        const long double sign = k % 2 == 0 ? 1 : -1;
        split.i0_forward = split.i0_forward * inverse + c0[k];
        split.sum_forward = split.sum_forward * inverse + (c0[k] + c1[k]);
        split.i0_backward = split.i0_backward * inverse + sign * c0[k];
        split.sum_backward = split.sum_backward * inverse + sign * (c0[k] - c1[k]);
    }
    return split;
}

/// Hankel's expansions far from the origin; Im s >= 0.
inline ScaledBessel hankel_bessel(Complex s) {
    const long double scale = std::abs(s.real());
    const HankelSplit split = hankel_split(s);
    const Complex root = std::sqrt(2 * std::numbers::pi_v<long double> * s);
    const Complex forward = std::exp(s - scale) / root;
    const Complex backward = Complex(0, 1) * std::exp(-s - scale) / root;
    const Complex i0 = forward * split.i0_forward + backward * split.i0_backward;
    const Complex sum = forward * split.sum_forward + backward * split.sum_backward;
    return {i0, sum - i0, sum};
}

/// I_n(s) = 1/pi int_0^pi e^{s cos t} cos(n t) dt by the trapezoidal rule; its error is about I_{2 count}(s).
inline ScaledBessel trapezoidal_bessel(Complex s) {
    const long double scale = std::abs(s.real());
    const int count = static_cast<int>(std::abs(s)) + 40;
    ScaledBessel result{};
    for (int k = 0; k <= count; ++k) {
        const long double cosine = std::cos(std::numbers::pi_v<long double> * k / count);
        const Complex value = std::exp(s * cosine - scale) * ((k == 0 || k == count ? 0.5L : 1.0L) / count);
        result.i0 += value;
        result.i1 += value * cosine;
        result.sum += value * (1 + cosine);
    }
    return result;
}

inline ScaledBessel scaled_bessel(Complex s) {
    if (std::abs(s) < asymptotic_radius) {
        return trapezoidal_bessel(s);
    }
    if (!std::signbit(s.imag())) {
        return hankel_bessel(s);
    }
    const ScaledBessel mirrored = hankel_bessel(std::conj(s));
    return {std::conj(mirrored.i0), std::conj(mirrored.i1), std::conj(mirrored.sum)};
}

inline Complex laplace_c11(Complex s, long double poisson_ratio, long double lambda) {
    const ScaledBessel bessel = scaled_bessel(s);
    return steady_c11(poisson_ratio) * bessel.sum / (bessel.i0 + s * lambda * bessel.sum);
}

/// The creep coefficient for s = i omega in double, with J0 and J1 by GSL, which takes less time.
inline std::complex<double> harmonic_c11(double omega, double poisson_ratio, double lambda) {
    gsl_sf_result j0{};
    gsl_sf_result j1{};
    for (const int status : {gsl_sf_bessel_J0_e(omega, &j0), gsl_sf_bessel_J1_e(omega, &j1)}) {
        if (status != GSL_SUCCESS && status != GSL_EUNDRFLW) {
            throw std::runtime_error(std::string("reference::plane_c11: GSL: ") + gsl_strerror(status));
        }
    }
    const std::complex<double> sum(j0.val, j1.val);
    return steady_c11(poisson_ratio) * sum / (j0.val + std::complex<double>(0, omega * lambda) * sum);
}

/// One Newton step for D(s) = 0. D' = I1 + Lambda (I0 + s (I0 + I1)).
inline Complex newton_step(Complex s, long double lambda) {
    const ScaledBessel bessel = scaled_bessel(s);
    return -(bessel.i0 + s * lambda * bessel.sum) / (bessel.i1 + lambda * (bessel.i0 + s * bessel.sum));
}

inline Complex polish_eigenvalue(Complex s, long double lambda) {
    for (int k = 0; k < 60; ++k) {
        const Complex step = newton_step(s, lambda);
        s += step;
        if (std::abs(step) < 1e-17L * std::abs(s)) {
            break;
        }
    }
    return s;
}

/// w of e^{2s} = w, which is D = 0 for large |s|, as ln|w| + i arg w with -pi/2 < arg w <= 3 pi/2. For large |s|, w is
/// positive for Lambda > 2, negative for Lambda < 2 and positive imaginary in between, so that no branch cut is
/// crossed.
inline Complex asymptotic_logarithm(Complex s, long double lambda) {
    const HankelSplit split = hankel_split(s);
    const Complex w = Complex(0, -1) * (split.i0_backward + s * lambda * split.sum_backward) /
                      (split.i0_forward + s * lambda * split.sum_forward);
    const long double pi = std::numbers::pi_v<long double>;
    const long double argument = std::arg(w);
    return {std::log(std::abs(w)), argument <= -pi / 2 ? argument + 2 * pi : argument};
}

/// Eigenvalues inside the asymptotic radius with Im s >= 0. Starting values: the zero-slip condition in Chebyshev
/// polynomials, p_{k+1} = s (p_k/(2k) - p_{k+2}/(2(k+2))) with p_0 = -sum p_n, as a matrix with eigenvalues 1/s.
inline std::vector<Complex> inner_eigenvalues(long double lambda) {
    constexpr std::size_t order = 140;  // resolves |s| < 40 far better than Newton's method needs
    using Matrix = std::unique_ptr<gsl_matrix, decltype(&gsl_matrix_free)>;
    using Values = std::unique_ptr<gsl_vector_complex, decltype(&gsl_vector_complex_free)>;
    using Workspace = std::unique_ptr<gsl_eigen_nonsymm_workspace, decltype(&gsl_eigen_nonsymm_free)>;
    const Matrix matrix(gsl_matrix_calloc(order, order), &gsl_matrix_free);
    const Values values(gsl_vector_complex_alloc(order), &gsl_vector_complex_free);
    const Workspace workspace(gsl_eigen_nonsymm_alloc(order), &gsl_eigen_nonsymm_free);
    if (!matrix || !values || !workspace) {
        throw std::bad_alloc();
    }
    for (std::size_t k = 0; k < order; ++k) {  // row k, column j stands for p_{j+1}
        if (k == 0) {
            for (std::size_t j = 0; j < order; ++j) {
                gsl_matrix_set(matrix.get(), 0, j, static_cast<double>(-lambda));
            }
        } else {
            gsl_matrix_set(matrix.get(), k, k - 1, 0.5 / static_cast<double>(k));
        }
        if (k + 1 < order) {
            gsl_matrix_set(matrix.get(), k, k + 1,
                           gsl_matrix_get(matrix.get(), k, k + 1) - 0.5 / static_cast<double>(k + 2));
        }
    }
    const int status = gsl_eigen_nonsymm(matrix.get(), values.get(), workspace.get());
    if (status != GSL_SUCCESS) {
        throw std::runtime_error(std::string("reference::eigenvalues: GSL: ") + gsl_strerror(status));
    }
    std::vector<Complex> result;
    for (std::size_t k = 0; k < order; ++k) {
        const gsl_complex value = gsl_vector_complex_get(values.get(), k);
        const Complex start = 1.0L / Complex(GSL_REAL(value), -GSL_IMAG(value));
        if (GSL_IMAG(value) >= 0 &&
            std::abs(start) < asymptotic_radius + 3) {  // a margin of about the distance between pairs
            const Complex s = polish_eigenvalue(std::conj(start), lambda);
            if (std::abs(s) < asymptotic_radius) {
                result.push_back(s.imag() < 0 ? std::conj(s) : s);
            }
        }
    }
    return result;
}

/// The real eigenvalue beyond the asymptotic radius, which exists for Lambda slightly below 2 (it tends to minus
/// infinity as Lambda -> 2): -D(-R)/I0 = R Lambda (1 - I1/I0) - 1 decreases there from a positive value to
/// Lambda/2 - 1.
inline std::vector<Complex> outer_real_eigenvalue(long double lambda) {
    const auto scaled_d = [lambda](long double r) {
        const ScaledBessel bessel = scaled_bessel(Complex(-r, 0));
        return bessel.i0.real() - r * lambda * bessel.sum.real();
    };
    long double lower = asymptotic_radius;
    long double upper = 2 * lower;
    if (lambda >= 2 || scaled_d(lower) >= 0) {
        return {};
    }
    while (scaled_d(upper) < 0) {
        upper *= 2;
        if (upper > 1e15L) {
            return {};  // irrelevant: decays within a distance rolled of 1e-15
        }
    }
    while (upper - lower > 1e-17L * upper) {
        const long double middle = (lower + upper) / 2;
        if (middle <= lower || middle >= upper) {
            break;
        }
        (scaled_d(middle) < 0 ? lower : upper) = middle;
    }
    return {Complex(-lower, 0)};
}

/// The `count` eigenvalues of least modulus with Im s >= 0, by ascending modulus.
inline std::vector<Complex> eigenvalues(std::size_t count, long double lambda) {
    const long double pi = std::numbers::pi_v<long double>;
    std::vector<Complex> result = inner_eigenvalues(lambda);
    // Beyond the asymptotic radius they are numbered by k in 2s = ln w(s) + 2 pi i k, one zero for each k.
    const auto highest = std::max_element(result.begin(), result.end(),
                                          [](Complex left, Complex right) { return left.imag() < right.imag(); });
    long double k = std::round((2 * highest->imag() - asymptotic_logarithm(*highest, lambda).imag()) / (2 * pi));
    for (const Complex s : outer_real_eigenvalue(lambda)) {
        result.push_back(s);
    }
    Complex offset = -1;                 // offset of s from i pi k, which changes little from one eigenvalue to the
                                         // next
    while (result.size() < count + 1) {  // one more than requested: the outer real eigenvalue is inserted
        k += 1;
        const Complex turns(0, pi * k);
        long double change = 1;
        const long double precise = 1e-17L * std::abs(turns);
        for (int iteration = 0; iteration < 12 && change > precise; ++iteration) {
            const Complex next = asymptotic_logarithm(offset + turns, lambda) / 2.0L;
            change = std::abs(next - offset);
            offset = next;
        }
        result.push_back(change > precise ? polish_eigenvalue(offset + turns, lambda) : offset + turns);
    }
    std::sort(result.begin(), result.end(),
              [](Complex left, Complex right) { return std::abs(left) < std::abs(right); });
    result.resize(count);
    return result;
}

}  // namespace rollbem::reference::detail
