// rollbem/normal/detail/grid_convolution.hpp and the transforms it is made of
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <utility>

#include <rollbem/normal/detail/grid_convolution.hpp>

#include "support/catch.hpp"

namespace {

using namespace rollbem;
using Grid = detail::GridConvolution::Grid;

Grid random_grid(Eigen::Index nx, Eigen::Index ny) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> value(-1, 1);
    return Grid::NullaryExpr(nx, ny, [&] { return value(random); });
}

}  // namespace

TEST_CASE("grid_convolution: transforms are the sums that define them", "[contact]") {
    detail::BatchTransform transform;
    // every factor alone, several of each, and counts that are no multiples of the numbers computed at a time
    for (const std::ptrdiff_t length : {1, 2, 3, 4, 5, 8, 15, 16, 60, 75, 90}) {
        transform.prepare(length);
        for (const std::ptrdiff_t count : {1, 4, 7}) {
            const Grid re = random_grid(count, length), im = 1 - 2 * re.square();
            detail::ComplexBatch batch;
            batch.re.assign(re.data(), re.data() + re.size());
            batch.im.assign(im.data(), im.data() + im.size());
            transform.apply(batch, count);
            double worst = 0;
            for (std::ptrdiff_t k = 0; k < length; ++k) {
                for (std::ptrdiff_t of = 0; of < count; ++of) {
                    std::complex<double> sum = 0;
                    for (std::ptrdiff_t j = 0; j < length; ++j) {
                        const double turn = -2 * std::numbers::pi * double(j * k % length) / double(length);
                        sum += std::complex(re(of, j), im(of, j)) * std::polar(1.0, turn);
                    }
                    const auto at = std::size_t(k * count + of);
                    worst = std::max(worst, std::abs(sum - std::complex(batch.re[at], batch.im[at])));
                }
            }
            CAPTURE(length, count);
            CHECK(worst < 1e-12);
        }
    }
    for (const auto& [least, good] : {std::pair(1, 1), std::pair(7, 8), std::pair(41, 45), std::pair(97, 100)}) {
        CHECK(detail::BatchTransform::good_length(least) == good);
    }
}

TEST_CASE("grid_convolution: displacements are sums over the pressures of all cells", "[contact]") {
    detail::GridConvolution convolution;  // one for all grids, as in contacts
    for (const auto& [nx, ny] : {std::pair(8, 5), std::pair(7, 6), std::pair(1, 9), std::pair(9, 1), std::pair(1, 1),
                                 std::pair(12, 12), std::pair(7, 6)}) {
        const double dx = 0.3, dy = 0.7;
        convolution.prepare(nx, ny, dx, dy);
        const Grid p = random_grid(nx, ny);
        Grid u(nx, ny), expected = Grid::Zero(nx, ny);
        convolution.apply(p, u);
        const auto corner = [](double x, double y) {
            return x * std::asinh(y / std::abs(x)) + y * std::asinh(x / std::abs(y));
        };
        for (Eigen::Index of = 0; of < p.size(); ++of) {
            for (Eigen::Index on = 0; on < p.size(); ++on) {
                const double x = double(on % nx - of % nx) * dx, y = double(on / nx - of / nx) * dy, a = dx / 2,
                             b = dy / 2;
                expected.data()[on] += p.data()[of] * (corner(x + a, y + b) - corner(x - a, y + b) -
                                                       corner(x + a, y - b) + corner(x - a, y - b));
            }
        }
        CAPTURE(nx, ny);
        CHECK((u - expected).abs().maxCoeff() < 1e-13 * double(nx * ny));
        Grid alone = Grid::Zero(nx, ny);
        alone(0, 0) = 1;
        convolution.apply(alone, u);
        CHECK(u(0, 0) == Approx(convolution.own()).epsilon(1e-13));
    }
}
