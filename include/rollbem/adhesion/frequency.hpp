// Frequency response: harmonic creepage, (G' - i (omega/V) G) p = xi, Eq. (16), and the complex creep coefficient.
// One LU per frequency, or for sweeps one reduction to Hessenberg form and then O(n^2) per frequency.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "../detail/finite.hpp"
#include "../detail/reciprocal_condition.hpp"
#include "../detail/require.hpp"
#include "../status.hpp"
#include "../system/detail/dissipation.hpp"
#include "../system/rolling_system.hpp"
#include "response.hpp"

namespace rollbem {

/// The creep coefficient c11, or all k x k coefficients, at many frequencies. With M = G'^-1 G = U H U^T and H in
/// Hessenberg form, (G' - s G) p = xi becomes (I - s H) (U^T p) = U^T G'^-1 xi: one O(n^3) reduction on construction,
/// then O(n^2) per frequency. If rcond(G') is too small to rely on M, each frequency has its own LU decomposition; see
/// reduced(). Const objects may be shared by threads.
///
/// Responses have no unknowns. Their residual belongs to the reduced equations; their rcond comes from one more
/// right-hand side, and coefficients are accurate to eps/rcond. With several subsystems both are the worst of all.
class FrequencySweep {
public:
    using Complex = std::complex<double>;

    /// A sweep of one system.
    explicit FrequencySweep(RollingSystem<double> system) { add(std::move(system)); }
    /// A sweep of several uncoupled subsystems, as patch_subsystems makes them: the creepages of the first come first, then
    /// the creepages of the next. Throws std::invalid_argument if there is none.
    explicit FrequencySweep(std::vector<RollingSystem<double>> parts) {
        detail::require(!parts.empty(), "FrequencySweep", "number of subsystems", parts.size(), "be positive");
        for (RollingSystem<double>& part : parts) add(std::move(part));
    }

    /// Whether the reduction is used in all subsystems.
    bool reduced() const {
        return std::all_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.reduced.has_value(); });
    }

    /// Response at z = omega a/V, of either sign. Throws std::invalid_argument if z is not finite.
    Response<Complex> operator()(double z) const {
        detail::require_finite("FrequencySweep", "omega a/V", z);
        return at(Complex(0, z));
    }

    /// Response to creepages e^{st}. Throws std::invalid_argument if s is not finite.
    Response<Complex> at(Complex s) const;

private:
    struct Reduced {
        MatrixX<double> H;
        MatrixX<double> steady, outputs;  // U^T G'^-1 inputs, U^T outputs
        double norm = 0;
    };

    // A column of complex numbers, with real and imaginary parts in separate arrays, so that operations are real.
    struct Column {
        ArrayX<double> re, im;

        explicit Column(Eigen::Index n) : re(ArrayX<double>::Zero(n)), im(ArrayX<double>::Zero(n)) {}
        Complex operator[](Eigen::Index i) const { return {re[i], im[i]}; }
        void set(Eigen::Index i, const Complex& value) {
            re[i] = value.real();
            im[i] = value.imag();
        }
        // subtracts `factor` times the first `count` entries of `other`
        void subtract(const Complex& factor, const Column& other, Eigen::Index count) {
            const double f = factor.real(), g = factor.imag();
            re.head(count) -= f * other.re.head(count) - g * other.im.head(count);
            im.head(count) -= f * other.im.head(count) + g * other.re.head(count);
        }
        void swap(Column& other) {
            re.swap(other.re);
            im.swap(other.im);
        }
        double largest() const { return std::sqrt((re.square() + im.square()).maxCoeff()); }
    };

    static double norm_1(const Complex& z) { return std::abs(z.real()) + std::abs(z.imag()); }

    struct Part {
        RollingSystem<double> system;
        Eigen::Index first;  // index of its first creepage among all creepages
        bool consistent;     // the steady tractions oppose the creepage
        std::optional<Reduced> reduced;
    };

    void add(RollingSystem<double> part);

    // (I - s H) y = b column by column from the right: one column operation, with the larger of two pivots, eliminates
    // the entry below the diagonal; the remaining column gives one unknown of the triangular system and is not needed
    // again. The column operations are applied to the unknowns at the end, O(n).
    static Response<Complex> solve_reduced(const Reduced& reduced, const Complex& s);

    // Adds the coefficients of input j and the largest residual so far, from the solution y.
    static void finish(const Reduced& reduced, const Column& y, Eigen::Index j, const Complex& ratio, double scale,
                       double norm, Response<Complex>& point);

    std::vector<Part> parts_;
    Eigen::Index input_count_ = 0;
};

inline void FrequencySweep::add(RollingSystem<double> given) {
    parts_.push_back({std::move(given), input_count_, true, {}});
    Part& part = parts_.back();
    const RollingSystem<double>& system = part.system;
    input_count_ += system.input_count();
    const Eigen::PartialPivLU<MatrixX<double>> lu(system.G_prime());
    MatrixX<double> steady(system.size(), system.input_count());
    for (Eigen::Index j = 0; j < steady.cols(); ++j) steady.col(j) = lu.solve(system.inputs().col(j));
    part.consistent =
        !system.unknowns_are_tractions() || detail::opposes_creepage<double>(steady.col(0), system.weights());
    const double rcond = detail::reciprocal_condition(lu, detail::one_norm(system.G_prime()));
    if (!detail::is_finite(rcond) || !(rcond > double(detail::least_rcond_of_G_prime))) return;
    const MatrixX<double> M = lu.solve(system.G());
    if (!detail::all_finite(M)) return;
    const Eigen::HessenbergDecomposition<MatrixX<double>> hessenberg(M);
    Reduced reduced;
    reduced.H = hessenberg.matrixH();
    const MatrixX<double> U = hessenberg.matrixQ();
    reduced.steady = U.transpose() * steady;
    reduced.outputs = U.transpose() * system.outputs();
    reduced.norm = reduced.H.cwiseAbs().rowwise().sum().maxCoeff();
    part.reduced = std::move(reduced);
}

inline auto FrequencySweep::at(Complex s) const -> Response<Complex> {
    detail::require_growth("FrequencySweep", s);
    Response<Complex> whole = detail::response_without_parts<Complex>(input_count_);
    for (const Part& part : parts_) {
        Response<Complex> own = part.reduced ? solve_reduced(*part.reduced, s) : detail::solve_growing(part.system, s);
        if (own.status == Status::ok && !part.consistent) own.status = Status::assists_creepage;
        detail::add_part(own, part.first, whole);
    }
    return whole;
}

inline auto FrequencySweep::solve_reduced(const Reduced& reduced, const Complex& s) -> Response<Complex> {
    const MatrixX<double>& H = reduced.H;
    const Eigen::Index n = H.rows();
    const double scale = detail::equation_scale(s);
    const Complex ratio(-s.real() / scale, -s.imag() / scale);
    const auto load = [&](Eigen::Index j, Column& column) {
        const Eigen::Index size = (std::min)(j + 2, n);
        column.re.head(size) = ratio.real() * H.col(j).head(size).array();
        column.im.head(size) = ratio.imag() * H.col(j).head(size).array();
        column.re[j] += 1 / scale;
    };
    const Eigen::Index count = reduced.steady.cols();
    Column probe(n), factor(n), column(n), next(n);
    std::vector<Column> rest(static_cast<std::size_t>(count), Column(n)), solutions = rest;
    Eigen::Array<bool, Eigen::Dynamic, 1> swapped(n);
    for (Eigen::Index k = 0; k < count; ++k) {
        rest[static_cast<std::size_t>(k)].re = reduced.steady.col(k).array() / scale;
    }
    for (Eigen::Index j = 0; j < n; ++j) probe.re[j] = j % 2 == 0 ? 1 : -1;
    double largest_probe = 0;  // largest entry of A^-1 probe, before the remaining rotations
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
    const double norm = std::abs(ratio) * reduced.norm + 1 / scale;
    Response<Complex> point;
    point.coefficients.resize(count, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        Column& y = solutions[static_cast<std::size_t>(k)];
        y.set(0, rest[static_cast<std::size_t>(k)][0] / column[0]);
        for (Eigen::Index j = 1; j < n; ++j) {
            const Complex own = y[j] - factor[j] * y[j - 1], before = y[j - 1];
            y.set(j, swapped[j] ? before : own);
            y.set(j - 1, swapped[j] ? own : before);
        }
        finish(reduced, y, k, ratio, scale, norm, point);
    }
    if (!detail::all_finite(point.coefficients)) return point;
    point.rcond = (std::min)(1 / (norm * largest_probe), 1.0);
    point.status = detail::trust(n, point.rcond, point.residual, 1);
    return point;
}

inline void FrequencySweep::finish(const Reduced& reduced, const Column& y, Eigen::Index j, const Complex& ratio,
                                   double scale, double norm, Response<Complex>& point) {
    const MatrixX<double>& H = reduced.H;
    const Eigen::Index n = H.rows();
    point.coefficients.col(j).real().noalias() = -(reduced.outputs.transpose() * y.re.matrix());
    point.coefficients.col(j).imag().noalias() = -(reduced.outputs.transpose() * y.im.matrix());
    Column product(n);  // H y
    for (Eigen::Index k = 0; k < n; ++k) {
        const Eigen::Index size = (std::min)(k + 2, n);
        product.re.head(size) += y.re[k] * H.col(k).head(size).array();
        product.im.head(size) += y.im[k] * H.col(k).head(size).array();
    }
    const auto steady = reduced.steady.col(j).array();
    Column difference(n);
    difference.re = (y.re - steady) / scale;
    difference.im = y.im / scale;
    difference.subtract(-ratio, product, n);
    const double residual = difference.largest() / (norm * y.largest() + steady.abs().maxCoeff() / scale);
    point.residual = detail::is_finite(residual) ? (std::max)(point.residual, residual) : residual;
}

}  // namespace rollbem
