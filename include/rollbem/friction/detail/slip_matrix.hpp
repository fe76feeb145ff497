// M of a friction problem s = M p + c, and what depends on M alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"
#include "../state.hpp"

namespace rollbem::detail {

/// M by blocks: slip in direction d by tractions in direction e. With two directions that do not couple it falls into
/// two groups of n unknowns; otherwise there is one group of all. All memory is allocated by the constructor.
template <int directions, class Scalar>
class SlipMatrix {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Vectors = ElementVectors<Scalar, directions>;
    using Matrix = MatrixX<Scalar>;

    explicit SlipMatrix(Index n, bool coupled = false) : n_(n), coupled_(directions == 2 && coupled), reach_(n) {
        for (std::size_t d = 0; d < directions; ++d) {
            for (std::size_t e = 0; e < directions; ++e) {
                if (d == e || coupled_) block_[directions * d + e].setZero(n, n);
            }
        }
        if constexpr (directions == 2) {
            const Index size = group_size();
            for (std::size_t g = 0; g < groups(); ++g) inverse_[g].resize(size, size);
            swaps_.resize(static_cast<std::size_t>(size));
            for (Vectors& vectors : sign_) vectors.resize(n, directions);
            for (Vectors& vectors : sums_) vectors.resize(n, directions);
            draw_signs();
        }
    }

    Index size() const { return n_; }
    bool coupled() const { return coupled_; }
    std::size_t groups() const { return coupled_ ? 1 : directions; }
    Index group_size() const { return coupled_ ? directions * n_ : n_; }
    /// Directions in a group.
    Index depth() const { return coupled_ ? directions : 1; }

    /// To be filled before the first solution and whenever M changes.
    Matrix& renew(std::size_t d, std::size_t e) {
        ++revision_;
        reach_is_known_ = inverse_is_known_ = sums_are_known_ = false;
        return block_[directions * d + e];
    }
    const Matrix& block(std::size_t d, std::size_t e) const { return block_[directions * d + e]; }
    /// Changes whenever M does.
    std::uint64_t revision() const { return revision_; }
    /// A number that no one else gets, for what is kept of this matrix.
    std::uint64_t next_serial() { return ++serial_; }
    /// Whether M is for one problem only, so that its inverse is not worth its price.
    void serve_once(bool once) { serves_once_ = once; }
    bool serves_once() const { return serves_once_; }

    /// s = M p
    void multiply(const Vectors& p, Vectors& s) const {
        for (std::size_t d = 0; d < directions; ++d) {
            auto slip = s.col(static_cast<Index>(d));
            slip.noalias() = block(d, d) * p.col(static_cast<Index>(d));
            if (coupled_) slip.noalias() += block(d, 1 - d) * p.col(static_cast<Index>(1 - d));
        }
    }

    /// rho of each element: from the largest influence on it, as its own may vanish.
    const Vector& reach() {
        if (reach_is_known_) return reach_;
        reach_.setZero();
        for (std::size_t d = 0; d < directions; ++d) {
            for (Index j = 0; j < n_; ++j) reach_ = reach_.cwiseMax(block(d, d).col(j).cwiseAbs());
        }
        for (Scalar& reach : reach_) reach = reach > 0 ? 1 / reach : Scalar(1);
        reach_is_known_ = true;
        return reach_;
    }

    /// What to add to the own influence of an element where M is singular.
    Scalar shift(Index i) { return std::sqrt(std::numeric_limits<Scalar>::epsilon()) / reach()[i]; }

    /// Finds B = M^-1 with the help of `scratch`, unless it is known. False if M is too close to singular.
    bool find_inverse(std::array<Matrix, directions>& scratch) {
        if (inverse_is_known_) return inverse_exists_;
        inverse_is_known_ = inverse_exists_ = true;
        for (std::size_t g = 0; g < groups(); ++g) {
            Matrix& factors = scratch[g];
            if (coupled_) {
                factors << block_[0], block_[1], block_[2], block_[3];
            } else {
                factors = block(g, g);
            }
            const Scalar norm = norm_of(factors);
            factorise_in_place<Scalar>(factors, swaps_.data());
            invert_factors<Scalar>(factors, swaps_.data(), inverse_[g]);
            const Scalar condition = norm * norm_of(inverse_[g]);
            inverse_exists_ = inverse_exists_ && is_finite(condition) &&
                              condition * std::numeric_limits<Scalar>::epsilon() < largest_error;
        }
        return inverse_exists_;
    }
    const Matrix& inverse(std::size_t group) const { return inverse_[group]; }

    /// Two sums of M p + c - s over all elements, with irregular signs; the larger one. Costs no product with M.
    Scalar error(const Vectors& p, const Vectors& c, const Vectors& s) {
        if (!sums_are_known_) {
            for (std::size_t k = 0; k < sums_.size(); ++k) multiply_transposed(sign_[k], sums_[k]);
            sums_are_known_ = true;
        }
        Scalar largest = 0;
        for (std::size_t k = 0; k < sums_.size(); ++k) {
            const Scalar sum = sums_[k].cwiseProduct(p).sum() + sign_[k].cwiseProduct(c - s).sum();
            largest = std::abs(sum) <= largest ? largest : std::abs(sum);  // also NaN
        }
        return largest;
    }

private:
    // A Newton step repairs the errors of the one before, so some digits are enough.
    static constexpr Scalar largest_error = Scalar(1e-3);

    static Scalar norm_of(const Matrix& A) { return A.cwiseAbs().colwise().sum().maxCoeff(); }

    void multiply_transposed(const Vectors& u, Vectors& result) const {
        for (std::size_t e = 0; e < directions; ++e) {
            auto column = result.col(static_cast<Index>(e));
            column.noalias() = block(e, e).transpose() * u.col(static_cast<Index>(e));
            if (coupled_) column.noalias() += block(1 - e, e).transpose() * u.col(static_cast<Index>(1 - e));
        }
    }

    // Bits of a linear congruential generator (Knuth's MMIX).
    void draw_signs() {
        std::uint64_t state = 1;
        for (Vectors& signs : sign_) {
            for (Scalar& sign : signs.reshaped()) {
                state = 6364136223846793005u * state + 1442695040888963407u;
                sign = (state >> 63) != 0 ? Scalar(1) : Scalar(-1);
            }
        }
    }

    Index n_;
    bool coupled_;
    std::array<Matrix, directions * directions> block_;
    std::array<Matrix, directions> inverse_;
    std::vector<Index> swaps_;
    std::array<Vectors, 2> sign_, sums_;  // u and M^T u
    Vector reach_;
    std::uint64_t revision_ = 1, serial_ = 0;
    bool serves_once_ = false;
    bool reach_is_known_ = false, inverse_is_known_ = false, inverse_exists_ = false, sums_are_known_ = false;
};

}  // namespace rollbem::detail
