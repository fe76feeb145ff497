// The matrix M of a friction problem s = M p + c, and quantities that depend on M alone.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"
#include "roles.hpp"

namespace rollbem::detail {

/// The matrix M, divided into groups of unknowns that do not couple: with one direction, or with two directions that
/// couple, one group holds all unknowns, direction by direction; otherwise each direction is a group. All memory is
/// allocated by the constructor.
template <int directions>
class SlipMatrix {
public:
    using Vector = VectorX<double>;
    using Matrix = MatrixX<double>;

    explicit SlipMatrix(Index n, bool coupled = false)
        : n_(n), coupled_(directions == 2 && coupled), projection_step_(n) {
        const bool inverts = directions == 2;
        for (std::size_t g = 0; g < groups(); ++g) {
            group_[g].setZero(group_size(), group_size());
            if (inverts) inverse_[g].resize(group_size(), group_size());
        }
        if (!inverts) return;
        swaps_.resize(static_cast<std::size_t>(group_size()));
        for (Vectors<directions>& sums : sums_) sums.resize(n, directions);
        for (Vectors<directions>& signs : sign_) signs.resize(n, directions);
        draw_signs();
    }

    Index size() const { return n_; }
    bool coupled() const { return coupled_; }
    std::size_t groups() const { return coupled_ ? 1 : directions; }
    Index group_size() const { return depth() * n_; }
    Index depth() const { return coupled_ ? directions : 1; }  ///< number of directions in a group
    const Matrix& group(std::size_t g) const { return group_[g]; }
    /// A view of the unknowns of a group.
    template <class Either>
    auto part(Either& vectors, std::size_t g) const {
        using Part = std::conditional_t<std::is_const_v<Either>, const Vector, Vector>;
        return Eigen::Map<Part>(vectors.data() + static_cast<Index>(g) * group_size(), group_size());
    }

    /// The block of slip in direction d due to tractions in direction e, to be filled before the first solution and
    /// whenever M changes.
    auto renew(std::size_t d, std::size_t e) {
        ++revision_;
        projection_step_is_known_ = inverse_is_known_ = sums_are_known_ = false;
        return block(*this, d, e);
    }
    auto block(std::size_t d, std::size_t e) const { return block(*this, d, e); }
    /// A number that changes whenever M changes.
    std::uint64_t revision() const { return revision_; }
    /// A new unique number for a result computed from this matrix.
    std::uint64_t next_serial() { return ++serial_; }
    bool serves_once = false;  ///< M serves one problem only, so that its inverse is not worth its cost

    /// Finds s = M p.
    void multiply(const Vectors<directions>& p, Vectors<directions>& s) const {
        for (std::size_t g = 0; g < groups(); ++g) part(s, g).noalias() = group_[g] * part(p, g);
    }

    /// rho of each element: 1 over the largest influence on it, because its own influence may vanish.
    const Vector& projection_step() {
        if (projection_step_is_known_) return projection_step_;
        projection_step_.setZero();
        for (std::size_t d = 0; d < directions; ++d) {
            for (Index j = 0; j < n_; ++j) projection_step_ = projection_step_.cwiseMax(block(d, d).col(j).cwiseAbs());
        }
        for (double& projection_step : projection_step_)
            projection_step = projection_step > 0 ? 1 / projection_step : 1.0;
        projection_step_is_known_ = true;
        return projection_step_;
    }

    /// The number to add to an element's influence on itself where M is singular.
    double shift(Index i) { return std::sqrt(std::numeric_limits<double>::epsilon()) / projection_step()[i]; }

    /// Finds B = M^-1 with the help of `scratch`, unless it is known. False if M is too close to singular.
    bool find_inverse(std::array<Matrix, std::size_t(directions)>& scratch) {
        if (inverse_is_known_) return inverse_exists_;
        inverse_is_known_ = inverse_exists_ = true;
        for (std::size_t g = 0; g < groups(); ++g) {
            scratch[g] = group_[g];
            factorise_in_place<double>(scratch[g], swaps_.data());
            invert_factors<double>(scratch[g], swaps_.data(), inverse_[g]);
            const double condition = norm_of(group_[g]) * norm_of(inverse_[g]);
            inverse_exists_ = inverse_exists_ && is_finite(condition) &&
                              condition * std::numeric_limits<double>::epsilon() < largest_error;
        }
        return inverse_exists_;
    }
    const Matrix& inverse(std::size_t group) const { return inverse_[group]; }

    /// Estimates the error M p + c - s: the larger of its two sums over all elements with irregular signs. Costs no
    /// product with M.
    double error(const Vectors<directions>& p, const Vectors<directions>& c, const Vectors<directions>& s) {
        double largest = 0;
        for (std::size_t k = 0; k < sums_.size(); ++k) {
            for (std::size_t g = 0; g < groups() && !sums_are_known_; ++g) {
                part(sums_[k], g).noalias() = group_[g].transpose() * part(sign_[k], g);
            }
            const double sum = sums_[k].cwiseProduct(p).sum() + sign_[k].cwiseProduct(c - s).sum();
            if (!(std::abs(sum) <= largest)) largest = std::abs(sum);  // also NaN
        }
        sums_are_known_ = true;
        return largest;
    }

private:
    // A Newton step repairs the errors of the one before, so some digits are enough.
    static constexpr double largest_error = 1e-3;

    static double norm_of(const Matrix& A) { return A.cwiseAbs().colwise().sum().maxCoeff(); }

    template <class Either>
    static auto block(Either& own, std::size_t d, std::size_t e) {
        const Index row = own.coupled_ ? static_cast<Index>(d) * own.n_ : 0;
        const Index column = own.coupled_ ? static_cast<Index>(e) * own.n_ : 0;
        return own.group_[own.coupled_ ? 0 : d].block(row, column, own.n_, own.n_);
    }

    // Draws the signs from the bits of a linear congruential generator (Knuth's MMIX).
    void draw_signs() {
        std::uint64_t state = 1;
        for (Vectors<directions>& signs : sign_) {
            for (double& sign : signs.reshaped()) {
                state = 6364136223846793005u * state + 1442695040888963407u;
                sign = (state >> 63) != 0 ? 1.0 : -1.0;
            }
        }
    }

    Index n_;
    bool coupled_;
    std::array<Matrix, std::size_t(directions)> group_, inverse_;
    std::vector<Index> swaps_;
    std::array<Vectors<directions>, 2> sign_, sums_;  // u and M^T u
    Vector projection_step_;
    std::uint64_t revision_ = 1, serial_ = 0;
    bool projection_step_is_known_ = false, inverse_is_known_ = false, inverse_exists_ = false, sums_are_known_ = false;
};

}  // namespace rollbem::detail
