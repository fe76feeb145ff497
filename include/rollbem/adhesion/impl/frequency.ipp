// Bodies of adhesion/frequency.hpp. Internal.
#pragma once

#include "../frequency.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "../../detail/finite.hpp"
#include "../../detail/reciprocal_condition.hpp"
#include "../../detail/require.hpp"
#include "../../system/detail/dissipation.hpp"
#include "../../system/detail/response_parts.hpp"

namespace rollbem {

namespace detail {

/// |Re z| + |Im z|.
inline double sum_of_parts(const std::complex<double>& z) { return std::abs(z.real()) + std::abs(z.imag()); }

}  // namespace detail

// A column of complex numbers, with real and imaginary parts in separate arrays, so that operations are real.
struct FrequencySweep::Column {
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

ROLLBEM_DECL FrequencySweep::FrequencySweep(RollingSystem<double> system) { add(std::move(system)); }

ROLLBEM_DECL FrequencySweep::FrequencySweep(std::vector<RollingSystem<double>> parts) {
    detail::require(!parts.empty(), "FrequencySweep", "number of subsystems", parts.size(), "be positive");
    for (RollingSystem<double>& part : parts) add(std::move(part));
}

ROLLBEM_DECL bool FrequencySweep::reduced() const {
    return std::all_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.reduced.has_value(); });
}

ROLLBEM_DECL auto FrequencySweep::operator()(double z) const -> Response<Complex> {
    detail::require_finite("FrequencySweep", "omega a/V", z);
    return at(Complex(0, z));
}

ROLLBEM_DECL void FrequencySweep::add(RollingSystem<double> given) {
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

ROLLBEM_DECL auto FrequencySweep::at(Complex s) const -> Response<Complex> {
    detail::require_growth("FrequencySweep", s);
    Response<Complex> whole = detail::response_without_parts<Complex>(input_count_);
    for (const Part& part : parts_) {
        Response<Complex> own = part.reduced ? solve_reduced(*part.reduced, s) : detail::solve_growing(part.system, s);
        if (own.status == Status::ok && !part.consistent) own.status = Status::assists_creepage;
        detail::add_part(own, part.first, whole);
    }
    return whole;
}

ROLLBEM_DECL auto FrequencySweep::solve_reduced(const Reduced& reduced, const Complex& s) -> Response<Complex> {
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
        swapped[j] = detail::sum_of_parts(next[j]) > detail::sum_of_parts(column[j]);
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
        largest_probe = (std::max)(largest_probe, detail::sum_of_parts(probed));
        factor.set(j, multiplier);
        column.swap(next);
    }
    largest_probe = (std::max)(largest_probe, detail::sum_of_parts(probe[0] / column[0]));
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

ROLLBEM_DECL void FrequencySweep::finish(const Reduced& reduced, const Column& y, Eigen::Index j, const Complex& ratio,
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
