// What all problems in both matrices G and G' ask of them.
// No user includes this by itself.
#pragma once

#include "../detail/language.hpp"

#include "../assembly/influence.hpp"

namespace rollbem::detail {

/// Below this rcond(G') no result is taken from G'^-1 G: it could have lost more than four digits.
inline constexpr double least_rcond_of_G_prime = 1e-4;

template <class Scalar>
void require_pencil(const char* who, const InfluenceMatrices<Scalar>& matrices) {
    const Eigen::Index n = matrices.G_prime.rows();
    require(n > 0 && matrices.G_prime.cols() == n, who, "number of columns of G_prime", matrices.G_prime.cols(),
            "be positive and equal the number of rows");
    require(matrices.G.rows() == n, who, "number of rows of G", matrices.G.rows(), "equal that of G_prime");
    require(matrices.G.cols() == n, who, "number of columns of G", matrices.G.cols(), "equal that of G_prime");
}

}  // namespace rollbem::detail
