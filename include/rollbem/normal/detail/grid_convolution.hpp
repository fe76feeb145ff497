// Displacement of a half-space by pressures on the cells of a uniform grid: a convolution, by fast Fourier transforms.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include <Eigen/Core>
#include <unsupported/Eigen/FFT>

namespace rollbem::detail {

/// U p of nx x ny cells of size dx x dy, pressure constant in each: u at the centres times pi E*, with
/// 1/E* = (1-nu_1)/(2 G_1) + (1-nu_2)/(2 G_2), is the alternating sum of x asinh(y/|x|) + y asinh(x/|y|) over the
/// corners. The transforms are of twice the size, at least, so that nothing wraps around.
class GridConvolution {
public:
    using Grid = Eigen::ArrayXXd;
    using Complex = std::complex<double>;

    /// Prepares for another grid; the memory only grows.
    void prepare(Eigen::Index nx, Eigen::Index ny, double dx, double dy) {
        if (nx == nx_ && ny == ny_ && dx == dx_ && dy == dy_) return;
        nx_ = nx;
        ny_ = ny;
        dx_ = dx;
        dy_ = dy;
        width_ = 2 * good_size(nx);  // even, as the transform of real numbers requires
        height_ = good_size(2 * ny);
        half_ = width_ / 2 + 1;
        if (row_.size() < width_) row_.resize(width_);
        if (column_.size() < (std::max)(height_, half_)) column_.resize((std::max)(height_, half_));
        if (spectrum_.size() < half_ * height_) spectrum_.resize(half_ * height_);
        fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
        Grid corners(nx + 1, ny + 1);  // corners at ((i - 1/2) dx, (j - 1/2) dy)
        for (Eigen::Index j = 0; j <= ny; ++j) {
            for (Eigen::Index i = 0; i <= nx; ++i) {
                corners(i, j) = corner((double(i) - 0.5) * dx, (double(j) - 0.5) * dy);
            }
        }
        own_ = corners(1, 1) - corners(0, 1) - corners(1, 0) + corners(0, 0);
        // mirrored into all four quadrants
        spectrum_.setZero();
        for (Eigen::Index j = 0; j < height_; ++j) {
            const Eigen::Index q = (std::min)(j, height_ - j);
            row_.head(width_).setZero();
            for (Eigen::Index i = 0; q < ny && i < width_; ++i) {
                const Eigen::Index p = (std::min)(i, width_ - i);
                if (p >= nx) continue;
                row_[i] = corners(p + 1, q + 1) - corners(p, q + 1) - corners(p + 1, q) + corners(p, q);
            }
            transform_row(j);
        }
        for (Eigen::Index k = 0; k < half_; ++k) transform_column(k, height_, false);
        kernel_.resize(half_ * height_);  // real, as the kernel is even in both
        for (Eigen::Index i = 0; i < kernel_.size(); ++i) kernel_[i] = spectrum_[i].real();
    }

    /// Displacements times pi E*; p and u are nx x ny.
    void apply(const Grid& p, Grid& u) {
        for (Eigen::Index j = 0; j < ny_; ++j) {
            row_.head(nx_) = p.col(j).head(nx_);
            row_.segment(nx_, width_ - nx_).setZero();
            transform_row(j);
        }
        for (Eigen::Index k = 0; k < half_; ++k) {
            transform_column(k, ny_, true);
        }
        for (Eigen::Index j = 0; j < ny_; ++j) {
            column_.head(half_) = spectrum_.segment(j * half_, half_);
            fft_.inv(row_.data(), column_.data(), width_);
            u.col(j).head(nx_) = row_.head(nx_);
        }
    }

    double own() const { return own_; }  ///< the displacement of a cell by a unit pressure on itself

private:
    // value at a corner of cells in one quadrant; x, y may be negative
    static double corner(double x, double y) {
        const double r = std::hypot(x, y);
        return x * std::log((y + r) / std::abs(x)) + y * std::log((x + r) / std::abs(y));
    }

    // smallest size from `least` on without a prime factor above 5
    static Eigen::Index good_size(Eigen::Index least) {
        for (Eigen::Index n = least;; ++n) {
            Eigen::Index rest = n;
            for (const Eigen::Index p : {2, 3, 5}) {
                while (rest % p == 0) rest /= p;
            }
            if (rest == 1) return n;
        }
    }

    // transforms row j of the grid, from row_
    void transform_row(Eigen::Index j) {
        fft_.fwd(column_.data(), row_.data(), width_);
        spectrum_.segment(j * half_, half_) = column_.head(half_);
    }
    // transforms frequency k of the rows, of which the first `count` may differ from zero; with the kernel, there and
    // back
    void transform_column(Eigen::Index k, Eigen::Index count, bool convolve) {
        if (in_.size() < height_) in_.resize(height_);
        if (out_.size() < height_) out_.resize(height_);
        for (Eigen::Index j = 0; j < height_; ++j) in_[j] = j < count ? spectrum_[j * half_ + k] : Complex(0);
        fft_.fwd(out_.data(), in_.data(), height_);
        if (convolve) {
            for (Eigen::Index j = 0; j < height_; ++j) out_[j] *= kernel_[j * half_ + k];
            fft_.inv(in_.data(), out_.data(), height_);
            for (Eigen::Index j = 0; j < ny_; ++j) spectrum_[j * half_ + k] = in_[j];
        } else {
            for (Eigen::Index j = 0; j < height_; ++j) spectrum_[j * half_ + k] = out_[j];
        }
    }

    Eigen::Index nx_ = 0, ny_ = 0, width_ = 0, height_ = 0, half_ = 0;
    double dx_ = 0, dy_ = 0, own_ = 0;
    Eigen::FFT<double> fft_;
    Eigen::ArrayXd row_, kernel_;
    Eigen::ArrayXcd column_, spectrum_, in_, out_;  // rows of the grid one after the other
};

}  // namespace rollbem::detail
