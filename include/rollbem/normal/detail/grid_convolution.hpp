// Displacement of a half-space by pressures on the cells of a uniform grid: a convolution, by fast Fourier transforms.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "batch_transform.hpp"

namespace rollbem::detail {

/// U p of nx x ny cells of size dx x dy, pressure constant in each: u at the centres times pi E*, with
/// 1/E* = (1-nu_1)/(2 G_1) + (1-nu_2)/(2 G_2), is the alternating sum of x asinh(y/|x|) + y asinh(x/|y|) over the
/// corners. The transforms are of twice the size, at least, so that nothing wraps around.
class GridConvolution {
public:
    using Grid = Eigen::ArrayXXd;

    /// Prepares for another grid; the memory only grows.
    void prepare(Eigen::Index nx, Eigen::Index ny, double dx, double dy) {
        if (nx == nx_ && ny == ny_ && dx == dx_ && dy == dy_) return;
        nx_ = nx;
        ny_ = ny;
        dx_ = dx;
        dy_ = dy;
        width_ = BatchTransform::good_length(2 * nx);
        height_ = BatchTransform::good_length(2 * ny);
        along_x_.prepare(width_);
        along_y_.prepare(height_);
        Grid corners(nx + 1, ny + 1);  // corners at ((i - 1/2) dx, (j - 1/2) dy)
        for (Eigen::Index j = 0; j <= ny; ++j) {
            for (Eigen::Index i = 0; i <= nx; ++i) {
                corners(i, j) = corner((double(i) - 0.5) * dx, (double(j) - 0.5) * dy);
            }
        }
        own_ = corners(1, 1) - corners(0, 1) - corners(1, 0) + corners(0, 0);
        // mirrored into all four quadrants
        Grid kernel = Grid::Zero(width_, height_);
        for (Eigen::Index j = 0; j < height_; ++j) {
            const Eigen::Index q = (std::min)(j, height_ - j);
            for (Eigen::Index i = 0; q < ny && i < width_; ++i) {
                const Eigen::Index p = (std::min)(i, width_ - i);
                if (p >= nx) continue;
                kernel(i, j) = corners(p + 1, q + 1) - corners(p, q + 1) - corners(p + 1, q) + corners(p, q);
            }
        }
        transform(kernel);
        // real, as the kernel is even in both, and divided by the factor of the inverse transforms
        kernel_ = Eigen::Map<const Eigen::ArrayXd>(spectrum_.re.data(), width_ * half()) / double(width_ * height_);
    }

    /// Displacements times pi E*; p and u are nx x ny.
    void apply(const Grid& p, Grid& u) {
        transform(p);
        const auto all = [&](std::vector<double>& of) {
            return Eigen::Map<Eigen::ArrayXd>(of.data(), width_ * half());
        };
        all(spectrum_.re) *= kernel_;
        all(spectrum_.im) *= kernel_;
        std::swap(spectrum_.re, spectrum_.im);
        along_x_.apply(spectrum_, half());
        std::swap(spectrum_.re, spectrum_.im);
        // two real columns make one complex sequence
        const Eigen::Index pairs = (nx_ + 1) / 2;
        pairs_.resize(std::size_t(pairs * height_));
        for (Eigen::Index i = 0; i < pairs; ++i) {
            const double *re = &spectrum_.re[std::size_t(i * half())], *im = &spectrum_.im[std::size_t(i * half())];
            const bool two = i + pairs < nx_;
            const double *other_re = two ? re + pairs * half() : nullptr,
                         *other_im = two ? im + pairs * half() : nullptr;
            for (Eigen::Index k = 0; k < half(); ++k) {
                const double a = two ? other_re[k] : 0, b = two ? other_im[k] : 0;
                const auto at = std::size_t(k * pairs + i);
                pairs_.re[at] = re[k] - b;
                pairs_.im[at] = im[k] + a;
                if (k == 0) continue;
                const auto mirrored = std::size_t((height_ - k) * pairs + i);
                pairs_.re[mirrored] = re[k] + b;
                pairs_.im[mirrored] = a - im[k];
            }
        }
        std::swap(pairs_.re, pairs_.im);
        along_y_.apply(pairs_, pairs);
        for (Eigen::Index j = 0; j < ny_; ++j) {
            u.col(j).head(pairs) = Eigen::Map<const Eigen::ArrayXd>(&pairs_.im[std::size_t(j * pairs)], pairs);
            u.col(j).segment(pairs, nx_ - pairs) =
                Eigen::Map<const Eigen::ArrayXd>(&pairs_.re[std::size_t(j * pairs)], nx_ - pairs);
        }
    }

    double own() const { return own_; }  ///< the displacement of a cell by a unit pressure on itself

private:
    // value at a corner of cells in one quadrant; x, y may be negative
    static double corner(double x, double y) {
        const double r = std::hypot(x, y);
        return x * std::log((y + r) / std::abs(x)) + y * std::log((x + r) / std::abs(y));
    }

    Eigen::Index half() const { return height_ / 2 + 1; }  // number of frequencies along y; the others are conjugates

    // Transforms values on a part of the grid into spectrum_, whose element for frequency i along x and k along y is at
    // i * half() + k.
    void transform(const Grid& values) {
        // along y, two columns of constant x in one complex sequence
        const Eigen::Index n = values.rows(), pairs = (n + 1) / 2;
        pairs_.resize(std::size_t(pairs * height_));
        for (Eigen::Index j = 0; j < height_; ++j) {
            Eigen::Map<Eigen::ArrayXd> re(&pairs_.re[std::size_t(j * pairs)], pairs),
                im(&pairs_.im[std::size_t(j * pairs)], pairs);
            im.setZero();
            if (j < values.cols()) {
                re = values.col(j).head(pairs);
                im.head(n - pairs) = values.col(j).tail(n - pairs);
            } else {
                re.setZero();
            }
        }
        along_y_.apply(pairs_, pairs);
        spectrum_.resize(std::size_t(width_ * half()));
        const auto of = [&](std::vector<double>& part, Eigen::Index i) { return &part[std::size_t(i * half())]; };
        for (Eigen::Index i = 0; i < pairs; ++i) {
            double *re = of(spectrum_.re, i), *im = of(spectrum_.im, i);
            const bool two = i + pairs < n;
            double *other_re = two ? of(spectrum_.re, i + pairs) : nullptr,
                   *other_im = two ? of(spectrum_.im, i + pairs) : nullptr;
            for (Eigen::Index k = 0; k < half(); ++k) {
                const auto at = std::size_t(k * pairs + i),
                           mirrored = std::size_t((k == 0 ? 0 : height_ - k) * pairs + i);
                const double a = pairs_.re[at], b = pairs_.im[at], c = pairs_.re[mirrored], d = pairs_.im[mirrored];
                re[k] = (a + c) / 2;
                im[k] = (b - d) / 2;
                if (!two) continue;
                other_re[k] = (b + d) / 2;
                other_im[k] = (c - a) / 2;
            }
        }
        std::fill(spectrum_.re.begin() + n * half(), spectrum_.re.begin() + width_ * half(), 0.0);
        std::fill(spectrum_.im.begin() + n * half(), spectrum_.im.begin() + width_ * half(), 0.0);
        along_x_.apply(spectrum_, half());
    }

    Eigen::Index nx_ = 0, ny_ = 0, width_ = 0, height_ = 0;
    double dx_ = 0, dy_ = 0, own_ = 0;
    BatchTransform along_x_, along_y_;
    Eigen::ArrayXd kernel_;
    ComplexBatch pairs_, spectrum_;
};

}  // namespace rollbem::detail
