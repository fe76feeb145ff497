// Bodies of vehicle/creep_force_grid.hpp. Internal.
#pragma once

#include "../creep_force_grid.hpp"

#include <utility>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"

namespace rollbem {

ROLLBEM_DECL CreepForceGrid::CreepForceGrid(double poisson_ratio, double smallest_a_over_b, double largest_a_over_b,
                                            int levels, std::vector<CreepCoefficients<double>> coefficients)
    : nu_(poisson_ratio),
      smallest_(smallest_a_over_b),
      largest_(largest_a_over_b),
      levels_(levels),
      coefficients_(std::move(coefficients)) {
    detail::require(detail::is_finite(nu_) && nu_ >= 0 && nu_ <= 0.5, name, "poisson_ratio", nu_, "lie in [0, 0.5]");
    detail::require(detail::is_finite(smallest_) && smallest_ > 0, name, "smallest_a_over_b", smallest_,
                    "be positive and finite");
    detail::require(detail::is_finite(largest_) && largest_ > smallest_, name, "largest_a_over_b", largest_,
                    "be finite and above the smallest");
    detail::require(levels_ >= 4 && levels_ <= 64, name, "levels", levels_, "lie in [4, 64]");
    detail::require(shapes() >= 4 && shapes() <= 1000, name, "number of ellipses", shapes(), "lie in [4, 1000]");
    const Eigen::Index count = coefficient_count(levels_, shapes());
    detail::require(count <= most_coefficients, name,
                    "number of coefficients (levels + 3)^2 (2 levels + 3) (shapes + 2)", count, "be at most 10000000");
    scales_.resize(4, shapes());
    for (Eigen::Index i = 0; i < shapes(); ++i) {
        const CreepCoefficients<double>& c = coefficients_[static_cast<std::size_t>(i)];
        for (const double one : {c.c11, c.c22, c.c23, -c.c32, c.c33}) {
            detail::require(detail::is_finite(one) && one > 0, name, "creep coefficient (c32: its negative)", one,
                            "be positive and finite");
        }
        scales_.col(i) << c.c11, c.c22, c.c23, std::sqrt(c.c11 * c.c22);
    }
    for (int i = 0; i < levels_; ++i) {
        for (int j = -levels_ + 1; j < levels_; ++j) {
            for (int k = j < 0 ? 1 : 0; k < levels_; ++k) {
                const int square = i * i + j * j + k * k;
                if (square > 0 && square < levels_ * levels_) nodes_.push_back({i, j, k});
            }
        }
    }
}

ROLLBEM_DECL auto CreepForceGrid::slabs() const -> std::vector<Slab> {
    std::vector<Slab> slabs;
    for (Eigen::Index shape = 0; shape < shapes(); ++shape) {
        for (Eigen::Index node = 0; node < nodes(); ++node) {
            if (node == 0 || place(node).x != place(node - 1).x) slabs.push_back({shape, node, node});
            ++slabs.back().last;
        }
    }
    return slabs;
}

}  // namespace rollbem
