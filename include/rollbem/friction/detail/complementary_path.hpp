// Lemke's complementary pivoting for a friction problem: slower than an active-set iteration, but certain to terminate.
// Independent of rolling and units.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// Follows the solutions of s = M p + c + t d, |p_i| <= bound_i, from full sliding at large t down to t = 0, where all
/// entries of d have the same sign. Between two pivots p and t move along a line on which all complementarity
/// conditions but one hold; that one, the driven condition, is exchanged for the condition that blocks the move. For
/// finite bounds the path ends at a solution for every M, as a secondary ray would have to leave the box (Lemke 1965;
/// Cottle, Pang and Stone, ch. 4). All memory is allocated by the constructor.
template <class Scalar>
class ComplementaryPath {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Matrix = MatrixX<Scalar>;

    explicit ComplementaryPath(Index n)
        : system_(n + 1, n + 1),
          inverse_(n + 1, n + 1),
          sign_(n),
          traction_(n),
          slip_(n),
          change_(n),
          cover_(n),
          kept_(n),
          row_(n + 1),
          column_(n + 1),
          direction_(n + 1),
          swaps_(static_cast<std::size_t>(n + 1)) {}

    const Vector& traction() const { return traction_; }  ///< p at the end
    const Vector& sign() const { return sign_; }          ///< 0 if an element sticks at the end, otherwise that of s

    /// Follows the whole path; returns the number of pivots.
    int follow(const Matrix& M, const Vector& constant, const Vector& bound) {
        const Index n = M.rows();
        const Scalar side = constant.sum() < 0 ? Scalar(-1) : Scalar(1);
        // entries that differ by an irrational step: then no two conditions of a symmetric problem block at once
        for (Index i = 0; i < n; ++i) {
            const Scalar golden = static_cast<Scalar>(i + 1) * Scalar(0.6180339887498949L);
            cover_[i] = side * (1 + (golden - std::floor(golden)) / 64);
        }
        sign_.setConstant(side);
        traction_ = -side * bound;
        slip_ = constant;
        slip_.noalias() += M * traction_;
        Scalar t = 0;
        Index driven = -1;
        for (Index i = 0; i < n; ++i) {
            const Scalar needed = -slip_[i] / cover_[i];
            if (bound[i] > 0 && needed > t) {
                t = needed;
                driven = i;
            }
        }
        if (driven < 0) return 1;  // full sliding is a solution
        slip_ += t * cover_;
        bool drives_traction = true;
        Scalar direction = side;
        sign_[driven] = 0;
        driven_ = -1;
        const int limit = static_cast<int>(50 * n + 50);
        for (int pivot = 1; pivot <= limit; ++pivot) {
            if (!find_direction(M, driven, drives_traction, direction)) return pivot;
            const Scalar t_direction = direction_[n];
            Scalar step = t_direction < 0 ? -t / t_direction : endless;
            const Index blocking = find_blocking(bound, step);
            if (!(step < endless)) return pivot;
            traction_ += step * direction_.head(n);
            slip_ += step * change_;
            t += step * t_direction;
            if (blocking < 0) return pivot;
            driven = blocking;
            drives_traction = sign_[blocking] != 0;
            if (drives_traction) {
                direction = std::exchange(sign_[blocking], Scalar(0));
                slip_[blocking] = 0;
            } else {
                const bool forward = direction_[blocking] > 0;
                traction_[blocking] = forward ? bound[blocking] : -bound[blocking];
                sign_[blocking] = direction = forward ? Scalar(-1) : Scalar(1);
            }
        }
        return limit;
    }

private:
    static constexpr Scalar endless = (std::numeric_limits<Scalar>::max)();
    static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

    // The first condition to be met within `step`, which is shortened accordingly; -1 if there is none.
    Index find_blocking(const Vector& bound, Scalar& step) const {
        Index blocking = -1;
        for (Index i = 0; i < bound.size(); ++i) {
            Scalar room = endless;
            if (sign_[i] == 0) {
                const Scalar change = direction_[i];
                if (change != 0) {
                    room = (change > 0 ? bound[i] - traction_[i] : bound[i] + traction_[i]) / std::abs(change);
                }
            } else if (bound[i] > 0 && sign_[i] * change_[i] < 0) {
                room = -slip_[i] / change_[i];
            }
            if ((std::max)(room, Scalar(0)) < step) {
                step = (std::max)(room, Scalar(0));
                blocking = i;
            }
        }
        return blocking;
    }

    // (dp, dt) of the path, and the resulting change of slip. False if there is none to working precision.
    bool find_direction(const Matrix& M, Index driven, bool drives_traction, Scalar direction) {
        const Index n = M.rows();
        for (bool fresh = !follow_driven(M, driven);; fresh = true) {
            if (fresh && !invert(M, driven)) return false;
            direction_ = direction * inverse_.col(drives_traction ? n : driven);
            change_.noalias() = M * direction_.head(n);
            change_ += direction_[n] * cover_;
            if (fresh) return true;
            // rounding errors accumulated by the updates of the inverse make stick elements slip
            Scalar creep = 0;
            for (Index i = 0; i < n; ++i) {
                if (sign_[i] == 0 && i != driven) creep = (std::max)(creep, std::abs(change_[i]));
            }
            if (creep <= Scalar(0.01) * std::sqrt(epsilon) * change_.cwiseAbs().maxCoeff()) return true;
        }
    }

    // The equations for (dp, dt): no slip on the stick elements, no change of traction on the others, unit rate of the
    // driven one. Computes their inverse from scratch.
    bool invert(const Matrix& M, Index driven) {
        const Index n = M.rows();
        system_.setZero();
        for (Index i = 0; i < n; ++i) {
            const bool kept = sign_[i] == 0 || i == driven;
            kept_[i] = kept ? Scalar(1) : Scalar(0);
            if (kept) {
                system_.row(i).head(n) = M.row(i);
                system_(i, n) = cover_[i];
            } else {
                system_(i, i) = 1;
            }
        }
        system_(n, driven) = 1;
        driven_ = driven;
        factorise_in_place<Scalar>(system_, swaps_.data());
        inverse_.setIdentity();
        for (Index k = 0; k <= n; ++k) solve_in_place<Scalar>(system_, swaps_.data(), inverse_.col(k));
        return all_finite(inverse_);
    }

    // The inverse after a pivot, by updates of rank one. False if one of them would be singular.
    bool follow_driven(const Matrix& M, Index driven) {
        const Index n = M.rows();
        if (driven_ < 0) return false;
        // in an order in which no two rows become equal
        if (kept_[driven] == 0) {
            row_.noalias() = inverse_.topRows(n).transpose() * M.row(driven).transpose();
            row_ += cover_[driven] * inverse_.row(n).transpose();
            kept_[driven] = 1;
            if (!replace_row(driven)) return false;
        }
        const Index before = std::exchange(driven_, driven);
        if (before == driven) return true;
        row_ = inverse_.row(driven).transpose();
        if (!replace_row(n)) return false;
        if (sign_[before] == 0) return true;
        row_ = inverse_.row(before).transpose();
        kept_[before] = 0;
        return replace_row(before);
    }

    // Row i of the equations becomes r; row_ = r^T times the inverse.
    bool replace_row(Index i) {
        const Scalar pivot = row_[i];
        if (!(std::abs(pivot) > std::sqrt(epsilon) * row_.cwiseAbs().maxCoeff())) return false;
        row_[i] -= 1;
        column_ = inverse_.col(i) / -pivot;
        for (Index k = 0; k < row_.size(); ++k) inverse_.col(k) += row_[k] * column_;
        return true;
    }

    Matrix system_, inverse_;
    Vector sign_, traction_, slip_, change_, cover_;
    Vector kept_;  // 1 if the inverse contains the element's own equation
    Vector row_, column_, direction_;
    std::vector<Index> swaps_;
    Index driven_ = -1;
};

}  // namespace rollbem::detail
