// Matrices of an elliptic patch on half-spaces, assembled naively: strips along x, each a cosine mesh with Chebyshev
// nodes, rows between neighbouring nodes. For tests of what is made of such matrices.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>

namespace rollbem_tests {

/// Lengths in sqrt(a b), G = 1. Blocks (slip, by) = (x, x), (x, y), (y, x), (y, y). Elements strip by strip, each from
/// its trailing edge.
struct PatchMatrices {
    std::array<Eigen::MatrixXd, 4> G, G_prime;
    Eigen::VectorXd x, y;  // where the rigid slip is taken
    Eigen::VectorXd centre_x, centre_y, areas;
    Eigen::VectorXd pressure;          // Hertz, for N = 1
    std::vector<Eigen::Index> behind;  // -1: none

    Eigen::Index size() const { return areas.size(); }
};

inline PatchMatrices elliptic_patch(double aspect, double nu, Eigen::Index n, Eigen::Index m) {
    using Eigen::Index;
    const double pi = std::numbers::pi, a = std::sqrt(aspect), b = 1 / a;
    const Index size = n * m;
    PatchMatrices patch;
    for (auto* vector : {&patch.x, &patch.y, &patch.centre_x, &patch.centre_y, &patch.areas, &patch.pressure}) {
        vector->resize(size);
    }
    for (auto* blocks : {&patch.G, &patch.G_prime}) {
        for (Eigen::MatrixXd& block : *blocks) block.resize(size, size);
    }
    struct Rectangle {
        double left, right, low, high;
    };
    struct Row {
        double from, to, at;
    };
    std::vector<Rectangle> elements;
    std::vector<Row> rows;
    const auto fraction = [&](double t, Index of) { return -std::cos(pi * t / static_cast<double>(of)); };
    for (Index j = 0; j < m; ++j) {
        const double low = b * fraction(static_cast<double>(j), m), high = b * fraction(static_cast<double>(j + 1), m);
        const double middle = (low + high) / 2, half = a * std::sqrt(1 - middle * middle / (b * b));
        for (Index i = 0; i < n; ++i) {
            const Index k = j * n + i;
            const auto t = static_cast<double>(i);
            const Rectangle own{half * fraction(t, n), half * fraction(t + 1, n), low, high};
            const double from = half * fraction(t + 0.5, n), to = i + 1 < n ? half * fraction(t + 1.5, n) : half;
            elements.push_back(own);
            rows.push_back({from, to, std::min((from + to) / 2, own.right)});
            patch.x[k] = (from + to) / 2;
            patch.y[k] = patch.centre_y[k] = middle;
            patch.centre_x[k] = (own.left + own.right) / 2;
            patch.areas[k] = (own.right - own.left) * (high - low);
            patch.behind.push_back(i > 0 ? k - 1 : -1);
            constexpr int points = 40;  // of the midpoint rule, in each direction
            double sum = 0;
            for (int p = 0; p < points * points; ++p) {
                const double u = (own.left + (own.right - own.left) * (p % points + 0.5) / points) / a;
                const double v = (low + (high - low) * (p / points + 0.5) / points) / b;
                sum += std::sqrt(std::max(0.0, 1 - u * u - v * v));
            }
            patch.pressure[k] = sum;
        }
    }
    patch.pressure /= patch.pressure.dot(patch.areas);
    // displacements by a unit traction on a rectangle: the sum over its corners
    const auto displacement = [&](double px, double py, const Rectangle& r) {
        std::array<double, 3> sum{0, 0, 0};  // xx, xy, yy
        const auto part = [](double u, double v) { return u == 0 ? 0.0 : u * std::asinh(v / std::abs(u)); };
        for (const double ex : {r.left, r.right}) {
            for (const double ey : {r.low, r.high}) {
                const double u = px - ex, v = py - ey, sign = (ex == r.left) == (ey == r.low) ? 1 : -1;
                sum[0] += sign / pi * ((1 - nu) * part(u, v) + part(v, u));
                sum[1] -= sign / pi * nu * std::hypot(u, v);
                sum[2] += sign / pi * (part(u, v) + (1 - nu) * part(v, u));
            }
        }
        return sum;
    };
    for (Index i = 0; i < size; ++i) {
        const Row& row = rows[static_cast<std::size_t>(i)];
        for (Index j = 0; j < size; ++j) {
            const Rectangle& own = elements[static_cast<std::size_t>(j)];
            const auto from = displacement(row.from, patch.y[i], own), to = displacement(row.to, patch.y[i], own);
            const auto at = displacement(row.at, patch.y[i], own);
            for (std::size_t d = 0; d < 4; ++d) {
                const std::size_t component = (d + 1) / 2;
                patch.G[d](i, j) = at[component];
                patch.G_prime[d](i, j) = (to[component] - from[component]) / (row.to - row.from);
            }
        }
    }
    return patch;
}

}  // namespace rollbem_tests
