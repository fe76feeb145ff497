// Shared by the tests of random scenes: their number and seed, the random draws, and a solver for two directions that
// is independent of the library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include <Eigen/Core>

#include "extremes/drawn.hpp"

namespace drawn_scenes {

inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

using drawn::Draw;

using Vectors = Eigen::Matrix<double, Eigen::Dynamic, 2>;
using Matrices = std::array<Eigen::MatrixXd, 2>;

/// Tractions in circles of radius `bound` that are a fixed point of p = P(p - r s), s = M p + c, iterated element by
/// element from the leading edge, because slip depends on the elements ahead. Nothing where it does not converge.
inline std::optional<Vectors> projected_fixed_point(const Matrices& M, const Vectors& c, const Eigen::ArrayXd& bound) {
    Vectors p = Vectors::Zero(bound.size(), 2);
    for (int sweep = 0; sweep < 40000; ++sweep) {
        double change = 0;
        for (Eigen::Index i = bound.size() - 1; i >= 0; --i) {
            const double reach = 0.7 / std::max(M[0](i, i), M[1](i, i));
            Eigen::RowVector2d moved(p(i, 0) - reach * (M[0].row(i).dot(p.col(0)) + c(i, 0)),
                                     p(i, 1) - reach * (M[1].row(i).dot(p.col(1)) + c(i, 1)));
            const double size = std::hypot(moved[0], moved[1]);
            if (size > bound[i]) moved *= bound[i] / size;
            change = std::max(change, std::hypot(moved[0] - p(i, 0), moved[1] - p(i, 1)));
            p.row(i) = moved;
        }
        if (change <= 1e-15 * bound.maxCoeff()) return p;
    }
    return std::nullopt;
}

/// The number of comparisons, and of those with both stick and slip.
struct Tally {
    int compared = 0, mixed = 0;
};

}  // namespace drawn_scenes
