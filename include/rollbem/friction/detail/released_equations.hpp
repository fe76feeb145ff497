// The linear equations of a Newton step for friction in two directions, starting from full adhesion: only the elements
// that do not stick are factorised.
#pragma once

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"
#include "../state.hpp"

namespace rollbem::detail {

/// BothEquations from dp = B ds with B = M^-1, which is found once for a matrix M of all elements in both
/// directions. Where elements stick, ds = -s. Each other element has two unknowns and two equations: with t across its
/// traction and n along it, w and v the same turned back,
///     ds = beta v - (w.s + kappa gamma) w,   n.dp = 0,   t.dp = sigma gamma,
///     kappa = k r/(1 + k r),   sigma = r/(1 + k r),   r the largest entry of B,
/// so that w.(s + ds) + k t.dp = 0 for any stiffness k. An element without pressure is one of infinite stiffness: both
/// components of its dp vanish. All memory is allocated by the constructor.
template <class Scalar>
class ReleasedEquations {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Vectors = ElementVectors<Scalar>;
    using Matrix = MatrixX<Scalar>;

    explicit ReleasedEquations(Index n)
        : inverse_(2 * n, 2 * n),
          factors_(2 * n, 2 * n),
          right_(2 * n),
          total_(2 * n),
          change_(n, 2),
          tangent_(n, 2),
          test_(n, 2),
          kappa_(n),
          sigma_(n),
          elements_(static_cast<std::size_t>(n)),
          swaps_(static_cast<std::size_t>(2 * n)) {}

    /// M has changed.
    void forget() { is_known_ = false; }
    /// Finds B, unless it is known, of the matrix that `fill` writes into its argument: unknowns and equations
    /// longitudinal, then lateral. False if M is too close to singular.
    template <class Fill>
    bool find_inverse(const Fill& fill) {
        if (is_known_) return exists_;
        is_known_ = true;
        fill(factors_);
        const Scalar norm = norm_of(factors_);
        factorise_in_place<Scalar>(factors_, swaps_.data());
        invert_factors<Scalar>(factors_, swaps_.data(), inverse_);
        const Scalar condition = norm * norm_of(inverse_);
        compliance_ = inverse_.cwiseAbs().maxCoeff();
        exists_ = is_finite(condition) && condition * std::numeric_limits<Scalar>::epsilon() < largest_error;
        return exists_;
    }

    /// Exchanges everything but M and B, and what is known of them.
    void exchange_factors(ReleasedEquations& other) {
        std::swap(*this, other);
        inverse_.swap(other.inverse_);
        std::swap(compliance_, other.compliance_);
        std::swap(is_known_, other.is_known_);
        std::swap(exists_, other.exists_);
    }

    void clear() { count_ = 0; }
    /// An element that does not stick, with t, w and k; infinite k: an element without pressure.
    template <class Row>
    void add(Index element, const Row& tangent, const Row& test, Scalar stiffness) {
        elements_[at(count_)] = element;
        resist(count_, stiffness);
        aim(count_++, tangent, test);
    }
    /// Other t and w for the k-th of them, the factors kept.
    template <class Row>
    void aim(Index k, const Row& tangent, const Row& test) {
        tangent_.row(k) = tangent;
        test_.row(k) = test;
    }

    /// False if the equations are singular to working precision.
    bool factorise() {
        const Index n = inverse_.rows() / 2;
        for (Index l = 0; l < count_; ++l) {
            const Scalar x = test_(l, 0), y = test_(l, 1), kappa = kappa_[l];
            const auto by_x = inverse_.col(elements_[at(l)]), by_y = inverse_.col(n + elements_[at(l)]);
            for (Index k = 0; k < count_; ++k) {
                const Index i = elements_[at(k)];
                const Scalar a = tangent_(k, 0), b = tangent_(k, 1);
                const Scalar along = by_x[i] * x + by_y[i] * y, across = by_x[n + i] * x + by_y[n + i] * y;
                factors_(2 * k, 2 * l) = -kappa * (b * along - a * across);
                factors_(2 * k + 1, 2 * l) = -kappa * (a * along + b * across);
                const Scalar slid = by_x[i] * y - by_y[i] * x, turned = by_x[n + i] * y - by_y[n + i] * x;
                factors_(2 * k, 2 * l + 1) = b * slid - a * turned;
                factors_(2 * k + 1, 2 * l + 1) = a * slid + b * turned;
            }
            factors_(2 * l + 1, 2 * l) -= sigma_[l];
        }
        factorise_in_place<Scalar>(factors_.topLeftCorner(2 * count_, 2 * count_), swaps_.data());
        for (Index k = 0; k < 2 * count_; ++k) {
            if (!is_finite(factors_(k, k)) || factors_(k, k) == 0) return false;
        }
        return true;
    }

    /// dp for the slip s.
    void solve(const Vectors& s, Vectors& change) {
        start(s, change);
        take_remainder(change);
        correct();
        multiply(change);
        for (Index k = 0; k < count_; ++k) change.row(elements_[at(k)]) = sigma_[k] * total_[2 * k] * tangent_.row(k);
    }
    /// The same to working precision where the factors are those of almost the same t, w and k; k is `stiffness`.
    /// `slip_change`, unless null, becomes M dp.
    void solve(const Vectors& s, const Vector& stiffness, Vectors& change, Vectors* slip_change) {
        for (Index k = 0; k < count_; ++k) {
            if (sigma_[k] != 0) resist(k, stiffness[elements_[at(k)]]);
        }
        start(s, change);
        // each correction leaves the same share of what it corrects
        Scalar share = 1;
        for (int round = 0; round < most_corrections && share > enough_digits; ++round) {
            take_remainder(change);
            correct();
            multiply(change);
            share = right_.head(2 * count_).norm() / total_.head(2 * count_).norm();
        }
        if (slip_change != nullptr) *slip_change = change_;
        for (Index k = 0; k < count_; ++k) change.row(elements_[at(k)]) = sigma_[k] * total_[2 * k] * tangent_.row(k);
    }

private:
    void resist(Index k, Scalar stiffness) {
        const Scalar ratio = 1 / (1 + stiffness * compliance_);
        kappa_[k] = 1 - ratio;
        sigma_[k] = compliance_ * ratio;
    }

    // ds with gamma = beta = 0, and dp = B ds
    void start(const Vectors& s, Vectors& change) {
        total_.setZero();
        change_ = -s;
        for (Index k = 0; k < count_; ++k) {
            const Index i = elements_[at(k)];
            const Scalar size = test_(k, 0) * s(i, 0) + test_(k, 1) * s(i, 1);
            change_.row(i) = -size * test_.row(k);
        }
        multiply(change);
    }
    // What dp still violates.
    void take_remainder(const Vectors& change) {
        for (Index k = 0; k < count_; ++k) {
            const Index i = elements_[at(k)];
            const Scalar a = tangent_(k, 0), b = tangent_(k, 1);
            right_[2 * k] = a * change(i, 1) - b * change(i, 0);
            right_[2 * k + 1] = sigma_[k] * total_[2 * k] - (a * change(i, 0) + b * change(i, 1));
        }
    }
    // gamma, beta and ds
    void correct() {
        solve_in_place<Scalar>(factors_.topLeftCorner(2 * count_, 2 * count_), swaps_.data(), right_.head(2 * count_));
        total_.head(2 * count_) += right_.head(2 * count_);
        for (Index k = 0; k < count_; ++k) {
            const Index i = elements_[at(k)];
            const Scalar x = test_(k, 0), y = test_(k, 1), gamma = kappa_[k] * right_[2 * k], beta = right_[2 * k + 1];
            change_(i, 0) += beta * y - gamma * x;
            change_(i, 1) -= beta * x + gamma * y;
        }
    }

    static std::size_t at(Index k) { return static_cast<std::size_t>(k); }
    static Scalar norm_of(const Matrix& A) { return A.cwiseAbs().colwise().sum().maxCoeff(); }

    // B times change_
    void multiply(Vectors& result) {
        Eigen::Map<const Vector> from(change_.data(), inverse_.rows());
        Eigen::Map<Vector>(result.data(), inverse_.rows()).noalias() = inverse_ * from;
    }

    // A Newton step repairs the errors of the one before, so some digits are enough.
    static constexpr Scalar largest_error = Scalar(1e-3);
    static constexpr int most_corrections = 5;
    static constexpr Scalar enough_digits = Scalar(1e-5);  // the next correction would be the square of it

    Matrix inverse_, factors_;
    Vector right_, total_;    // gamma and beta of each element
    Vectors change_;          // ds
    Vectors tangent_, test_;  // t and w
    Vector kappa_, sigma_;
    std::vector<Index> elements_, swaps_;
    Index count_ = 0;
    Scalar compliance_ = 1;  // r
    bool is_known_ = false, exists_ = false;
};

}  // namespace rollbem::detail
