// Frequency response: harmonic creepage, (G' - i (omega/V) G) p = xi, Eq. (16), and the complex creep coefficient.
// One LU per frequency, or for sweeps one reduction to Hessenberg form and then O(n^2) per frequency.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "../assembly/rolling_system.hpp"
#include "../detail/finite.hpp"
#include "../detail/reciprocal_condition.hpp"
#include "../rolling/consistency.hpp"
#include "../status.hpp"
#include "../system/rolling_system.hpp"
#include "response.hpp"

namespace rollbem {

/// Response to harmonic creepage xi e^{st}, s = i omega; dimensionless, s in units of V/a.
template <class Scalar>
struct HarmonicSolution {
    VectorX<std::complex<Scalar>> traction;  ///< p / (G xi) of every unknown element, trailing to leading [-]
    std::complex<Scalar> c11 = 0;            ///< creep coefficient -F_bar / (a G xi) [-], Eq. (30)
    Scalar residual = 0;                     ///< |A p - xi| / (|A| |p| + |xi|) in the maximum norm, A = G' - s G [-]
    Scalar rcond = 0;                        ///< estimate of 1 / (|A| |A^-1|) in the 1-norm [-]
    Status status = Status::not_finite;
};

/// One point of a sweep.
template <class Scalar>
struct SweepPoint {
    std::complex<Scalar> c11 = 0;                  ///< as in HarmonicSolution; the first of the coefficients
    MatrixX<std::complex<Scalar>> coefficients{};  ///< as in Response, k x k
    Scalar residual = 0;                           ///< of the reduced equations; otherwise as in HarmonicSolution
    /// Of the reduced equations from one more right-hand side, where c11 is accurate to eps/rcond; otherwise as in
    /// HarmonicSolution [-].
    Scalar rcond = 0;
    Status status = Status::not_finite;
};

namespace detail {

template <class Scalar>
Status harmonic_status(Eigen::Index n, Scalar rcond, Scalar residual) {
    const Scalar rounding = static_cast<Scalar>(n) * std::numeric_limits<Scalar>::epsilon();
    const bool trusted = is_finite(rcond) && rcond > rounding && is_finite(residual) && residual <= 100 * rounding;
    return trusted ? Status::ok : Status::ill_conditioned;
}

}  // namespace detail

/// Response to harmonic creepage e^{i omega t}, Eq. (16), at z = omega a/V of either sign; Status::assists_creepage if
/// the tractions of steady rolling do not oppose the creepage. Throws std::invalid_argument if z is not finite or the
/// system has several inputs. For other growth, e^{st}, and several inputs see solve_response.
template <class Scalar>
HarmonicSolution<Scalar> solve_harmonic(const RollingSystem<Scalar>& system, std::type_identity_t<Scalar> z) {
    detail::require_finite("solve_harmonic", "omega a/V", z);
    detail::require_single_input("solve_harmonic", system);
    const Response<std::complex<Scalar>> response = solve_response(system, std::complex<Scalar>(0, z));
    HarmonicSolution<Scalar> solution{response.unknowns.col(0), response.coefficients(0, 0), response.residual,
                                      response.rcond, response.status};
    if (solution.status != Status::ok || !system.unknowns_are_tractions()) return solution;
    const Eigen::PartialPivLU<MatrixX<Scalar>> lu(system.G_prime());
    const VectorX<Scalar> steady = lu.solve(system.inputs().col(0));
    if (!detail::opposes_creepage<Scalar>(steady, system.weights())) solution.status = Status::assists_creepage;
    return solution;
}

/// The same for a discretisation by elements. Throws std::invalid_argument also if the scheme does not fit the mesh, G
/// is not finite or a plane kernel has Lambda <= 0.
template <class Scalar, RollingScheme<Scalar> Scheme, ElementKernel Kernel>
HarmonicSolution<Scalar> solve_harmonic(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel,
                                        std::type_identity_t<Scalar> z) {
    return solve_harmonic(rolling_system(mesh, scheme, kernel), z);
}

/// c11, or all k x k coefficients, at many frequencies. With M = G'^-1 G = U H U^T and H in Hessenberg form,
/// (G' - s G) p = xi becomes (I - s H) (U^T p) = U^T G'^-1 xi: one O(n^3) reduction on construction, then O(n^2) per
/// frequency. If rcond(G') is too small to rely on M, each frequency has its own LU decomposition; see reduced(). Const
/// objects may be shared by threads.
template <class Scalar_>
class FrequencySweep {
public:
    using Scalar = Scalar_;
    using Complex = std::complex<Scalar>;

    explicit FrequencySweep(RollingSystem<Scalar> system);

    /// Whether the reduction is used.
    bool reduced() const { return reduced_.has_value(); }

    /// Response at z = omega a/V, of either sign. Throws std::invalid_argument if z is not finite.
    SweepPoint<Scalar> operator()(Scalar z) const {
        detail::require_finite("FrequencySweep", "omega a/V", z);
        return at(Complex(0, z));
    }

    /// Response to creepage e^{st}. Throws std::invalid_argument if s is not finite.
    SweepPoint<Scalar> at(Complex s) const;

private:
    struct Reduced {
        MatrixX<Scalar> H;
        MatrixX<Scalar> steady, outputs;  // U^T G'^-1 inputs, U^T outputs
        Scalar norm = 0;
    };

    // A column of complex numbers, with real and imaginary parts in separate arrays, so that operations are real.
    struct Column {
        ArrayX<Scalar> re, im;

        explicit Column(Eigen::Index n) : re(ArrayX<Scalar>::Zero(n)), im(ArrayX<Scalar>::Zero(n)) {}
        Complex operator[](Eigen::Index i) const { return {re[i], im[i]}; }
        void set(Eigen::Index i, const Complex& value) {
            re[i] = value.real();
            im[i] = value.imag();
        }
        // subtracts `factor` times the first `count` entries of `other`
        void subtract(const Complex& factor, const Column& other, Eigen::Index count) {
            const Scalar f = factor.real(), g = factor.imag();
            re.head(count) -= f * other.re.head(count) - g * other.im.head(count);
            im.head(count) -= f * other.im.head(count) + g * other.re.head(count);
        }
        void swap(Column& other) {
            re.swap(other.re);
            im.swap(other.im);
        }
        Scalar largest() const { return std::sqrt((re.square() + im.square()).maxCoeff()); }
    };

    static Scalar norm_1(const Complex& z) { return std::abs(z.real()) + std::abs(z.imag()); }

    // (I - s H) y = b column by column from the right: one column operation, with the larger of two pivots, eliminates
    // the entry below the diagonal; the remaining column gives one unknown of the triangular system and is not needed
    // again. The column operations are applied to the unknowns at the end, O(n).
    SweepPoint<Scalar> solve_reduced(const Complex& s) const;

    // Adds the coefficients by input j and the largest residual so far, from the solution y.
    void finish(const Column& y, Eigen::Index j, const Complex& ratio, Scalar scale, Scalar norm,
                SweepPoint<Scalar>& point) const;

    RollingSystem<Scalar> system_;
    std::optional<Reduced> reduced_;
    bool consistent_ = true;  // the steady tractions oppose the creepage
};

template <class Scalar_>
FrequencySweep<Scalar_>::FrequencySweep(RollingSystem<Scalar> system) : system_(std::move(system)) {
    const Eigen::PartialPivLU<MatrixX<Scalar>> lu(system_.G_prime());
    MatrixX<Scalar> steady(system_.size(), system_.input_count());
    for (Eigen::Index j = 0; j < steady.cols(); ++j) steady.col(j) = lu.solve(system_.inputs().col(j));
    consistent_ =
        !system_.unknowns_are_tractions() || detail::opposes_creepage<Scalar>(steady.col(0), system_.weights());
    const Scalar rcond = detail::reciprocal_condition(lu, detail::one_norm(system_.G_prime()));
    if (!detail::is_finite(rcond) || !(rcond > Scalar(detail::least_rcond_of_G_prime))) return;
    const MatrixX<Scalar> M = lu.solve(system_.G());
    if (!detail::all_finite(M)) return;
    const Eigen::HessenbergDecomposition<MatrixX<Scalar>> hessenberg(M);
    Reduced reduced;
    reduced.H = hessenberg.matrixH();
    const MatrixX<Scalar> U = hessenberg.matrixQ();
    reduced.steady = U.transpose() * steady;
    reduced.outputs = U.transpose() * system_.outputs();
    reduced.norm = reduced.H.cwiseAbs().rowwise().sum().maxCoeff();
    reduced_ = std::move(reduced);
}

template <class Scalar_>
auto FrequencySweep<Scalar_>::at(Complex s) const -> SweepPoint<Scalar> {
    detail::require_growth("FrequencySweep", s);
    SweepPoint<Scalar> point;
    if (reduced_) {
        point = solve_reduced(s);
    } else {
        Response<Complex> full = solve_response(system_, s);
        const Complex first = full.coefficients(0, 0);
        point = {first, std::move(full.coefficients), full.residual, full.rcond, full.status};
    }
    if (point.status == Status::ok && !consistent_) point.status = Status::assists_creepage;
    return point;
}

template <class Scalar_>
auto FrequencySweep<Scalar_>::solve_reduced(const Complex& s) const -> SweepPoint<Scalar> {
    const MatrixX<Scalar>& H = reduced_->H;
    const Eigen::Index n = H.rows();
    const Scalar scale = detail::equation_scale(s);
    const Complex ratio(-s.real() / scale, -s.imag() / scale);
    const auto load = [&](Eigen::Index j, Column& column) {
        const Eigen::Index size = (std::min)(j + 2, n);
        column.re.head(size) = ratio.real() * H.col(j).head(size).array();
        column.im.head(size) = ratio.imag() * H.col(j).head(size).array();
        column.re[j] += 1 / scale;
    };
    const Eigen::Index count = reduced_->steady.cols();
    Column probe(n), factor(n), column(n), next(n);
    std::vector<Column> rest(static_cast<std::size_t>(count), Column(n)), solutions = rest;
    Eigen::Array<bool, Eigen::Dynamic, 1> swapped(n);
    for (Eigen::Index k = 0; k < count; ++k) {
        rest[static_cast<std::size_t>(k)].re = reduced_->steady.col(k).array() / scale;
    }
    for (Eigen::Index j = 0; j < n; ++j) probe.re[j] = j % 2 == 0 ? 1 : -1;
    Scalar largest_probe = 0;  // largest entry of A^-1 probe, before the remaining rotations
    load(n - 1, column);
    for (Eigen::Index j = n - 1; j > 0; --j) {
        load(j - 1, next);
        swapped[j] = norm_1(next[j]) > norm_1(column[j]);
        if (swapped[j]) column.swap(next);
        const Complex pivot = column[j], multiplier = next[j] / pivot;
        next.subtract(multiplier, column, j);
        for (std::size_t k = 0; k < rest.size(); ++k) {
            const Complex unknown = rest[k][j] / pivot;
            rest[k].subtract(unknown, column, j);
            solutions[k].set(j, unknown);
        }
        const Complex probed = probe[j] / pivot;
        probe.subtract(probed, column, j);
        largest_probe = (std::max)(largest_probe, norm_1(probed));
        factor.set(j, multiplier);
        column.swap(next);
    }
    largest_probe = (std::max)(largest_probe, norm_1(probe[0] / column[0]));
    const Scalar norm = std::abs(ratio) * reduced_->norm + 1 / scale;
    SweepPoint<Scalar> point;
    point.coefficients.resize(count, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        Column& y = solutions[static_cast<std::size_t>(k)];
        y.set(0, rest[static_cast<std::size_t>(k)][0] / column[0]);
        for (Eigen::Index j = 1; j < n; ++j) {
            const Complex own = y[j] - factor[j] * y[j - 1], before = y[j - 1];
            y.set(j, swapped[j] ? before : own);
            y.set(j - 1, swapped[j] ? own : before);
        }
        finish(y, k, ratio, scale, norm, point);
    }
    point.c11 = point.coefficients(0, 0);
    if (!detail::all_finite(point.coefficients)) return point;
    point.rcond = (std::min)(1 / (norm * largest_probe), Scalar(1));
    point.status = detail::harmonic_status(n, point.rcond, point.residual);
    return point;
}

template <class Scalar_>
void FrequencySweep<Scalar_>::finish(const Column& y, Eigen::Index j, const Complex& ratio, Scalar scale, Scalar norm,
                                     SweepPoint<Scalar>& point) const {
    const Reduced& reduced = *reduced_;
    const MatrixX<Scalar>& H = reduced.H;
    const Eigen::Index n = H.rows(), below = n - 1;
    point.coefficients.col(j).real().noalias() = -(reduced.outputs.transpose() * y.re.matrix());
    point.coefficients.col(j).imag().noalias() = -(reduced.outputs.transpose() * y.im.matrix());
    Column product(n);  // H y
    product.re.matrix().noalias() = H.template triangularView<Eigen::Upper>() * y.re.matrix();
    product.im.matrix().noalias() = H.template triangularView<Eigen::Upper>() * y.im.matrix();
    product.re.tail(below) += H.diagonal(-1).array() * y.re.head(below);
    product.im.tail(below) += H.diagonal(-1).array() * y.im.head(below);
    const auto steady = reduced.steady.col(j).array();
    Column difference(n);
    difference.re = (y.re - steady) / scale;
    difference.im = y.im / scale;
    difference.subtract(-ratio, product, n);
    const Scalar residual = difference.largest() / (norm * y.largest() + steady.abs().maxCoeff() / scale);
    point.residual = detail::is_finite(residual) ? (std::max)(point.residual, residual) : residual;
}

}  // namespace rollbem
