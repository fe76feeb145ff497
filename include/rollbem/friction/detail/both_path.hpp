// Friction in two directions followed from zero friction: the way to a solution where Newton's method has failed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/in_place_lu.hpp"
#include "../../detail/length.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "both_equations.hpp"
#include "slip_turn.hpp"

namespace rollbem::detail {

/// Follows the solutions (z, t) of
///     z - p + rho R (M p + c + (1 - t) d) = 0,   p = P_t(z),
/// from t = 0, where p = 0, to t = 1, where p is a solution of the problem that BothSolver describes. P_t projects
/// onto circles of t times the bounds and is rounded off in proportion to 1 - t, so that it is smooth below t = 1.
///
/// As p is bounded, for almost every d the path is one smooth curve that ends at t = 1, whatever M (Chow, Mallet-Paret
/// and Yorke 1978). It may turn back in t, and is therefore followed by its length. Where M with its rows weighted by
/// the elements' areas is positive definite, each t has one solution, and the path does not turn back. d points in
/// directions that differ by an irrational angle from element to element. All memory is allocated by the constructor.
template <class Scalar>
class BothPath {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Vectors = ElementVectors<Scalar>;

    struct Problem {
        const BothEquations<Scalar>& equations;  ///< M
        const Vectors& constant;                 ///< c
        const Vector& bound;
        const Vector& reach;  ///< rho
        const SlipTurn<Scalar>& turn;
    };

    explicit BothPath(Index n)
        : matrix_(2 * n + 1, 2 * n + 1),
          swaps_(static_cast<std::size_t>(2 * n + 1)),
          at_(2 * n + 1),
          forward_(2 * n + 1),
          trial_(2 * n + 1),
          change_(2 * n + 1),
          scale_(n),
          offset_(n, 2),
          traction_(n, 2),
          growth_(n, 2),
          column_(n, 2),
          slope_(n, 3) {}

    /// To t = 0. `size`: the largest |c|.
    void begin(const Problem& problem, Scalar size) {
        const Index n = scale_.size();
        for (Index i = 0; i < n; ++i) {
            const Scalar angle = golden_angle * static_cast<Scalar>(i);
            offset_(i, 0) = size / 50 * std::cos(angle);
            offset_(i, 1) = size / 50 * std::sin(angle);
        }
        column_ = problem.constant + offset_;
        problem.turn.apply(column_);
        for (Index i = 0; i < n; ++i) {
            const Scalar x = -problem.reach[i] * column_(i, 0), y = -problem.reach[i] * column_(i, 1);
            scale_[i] = std::sqrt(static_cast<Scalar>(n)) * (problem.bound[i] + length(x, y));
            if (!(scale_[i] > 0)) scale_[i] = 1;
            trial_[i] = x / scale_[i];
            trial_[n + i] = y / scale_[i];
        }
        trial_[2 * n] = 0;
        forward_.setZero();
        forward_[2 * n] = 1;
        linearise(problem);
        at_ = trial_;
        forward_ = change_ / change_.norm();
        length_ = longest / 2;
        rest_ = Scalar(0.5);
        points_ = 0;
    }

    /// Some points on, fewer if the rest of t has halved; false if there are none.
    bool advance(const Problem& problem) {
        const Index last = at_.size() - 1;
        const int stop = points_ + most_together;
        while (points_ < most_points && length_ > std::sqrt(std::numeric_limits<Scalar>::epsilon())) {
            trial_ = at_ + length_ * forward_;
            const int corrections = correct(problem);
            if (corrections == 0) {
                length_ /= 2;
                continue;
            }
            ++points_;
            at_ = trial_;
            forward_ = change_;
            if (corrections <= 2) length_ = (std::min)(2 * length_, longest);
            if (1 - at_[last] > rest_ && points_ < stop) continue;
            rest_ = (std::min)(rest_, (1 - at_[last]) / 2);
            trial_[last] = 1;
            find_tractions(problem);
            return true;
        }
        return false;
    }

    /// P_1(z) after advance(): near a solution if the rest of t is small.
    const Vectors& traction() const { return traction_; }

private:
    static constexpr Scalar golden_angle = Scalar(2.39996322972865332L);
    // Found by trial, with random matrices and patches. Steps are relative to the size of all elements together.
    static constexpr Scalar longest = Scalar(0.25);
    static constexpr Scalar most_turn = Scalar(1.2);  // 1/cos of the angle from one point to the next
    static constexpr int most_together = 8;
    static constexpr int most_points = 500;  // patches take 15 on average

    static Scalar over(Scalar a, Scalar b) { return b > 0 ? a / b : Scalar(0); }

    // Newton's method from trial_ to the path, at right angles to forward_; the path's direction there into change_.
    // Number of its steps; 0 if it does not converge fast, or the path turns much.
    int correct(const Problem& problem) {
        const Index last = trial_.size() - 1;
        Scalar before = length_ / 2;
        for (int k = 1; k <= 5; ++k) {
            if (!(trial_[last] >= 0 && trial_[last] < 1)) return 0;
            const Scalar size = linearise(problem);
            if (!(size <= before / 2)) return 0;
            before = size;
            if (!(size <= Scalar(1e-3) * length_)) continue;
            const Scalar turn = change_.norm();  // as forward_ . change_ = 1
            change_ /= turn;
            return turn < most_turn && trial_[last] >= 0 && trial_[last] < 1 ? k : 0;
        }
        return 0;
    }

    // A Newton step of trial_, whose size is returned; the path's direction into change_.
    Scalar linearise(const Problem& problem) {
        set_up(problem);
        factorise_in_place<Scalar>(matrix_, swaps_.data());
        solve_in_place<Scalar>(matrix_, swaps_.data(), change_);
        const Scalar size = change_.norm();
        trial_ -= change_;
        change_.setZero();
        change_[change_.size() - 1] = 1;
        solve_in_place<Scalar>(matrix_, swaps_.data(), change_);
        return size;
    }

    // The equations' residual at trial_ into change_, their derivatives into matrix_.
    void set_up(const Problem& problem) {
        const BothEquations<Scalar>& equations = problem.equations;
        const Index n = scale_.size();
        find_tractions(problem);
        const auto put_into = [&](auto target, Scalar factor) {  // rho R column_
            problem.turn.apply(column_);
            for (Index d = 0; d < 2; ++d) {
                target.segment(d * n, n) = factor * column_.col(d).cwiseProduct(problem.reach).cwiseQuotient(scale_);
            }
            target[2 * n] = 0;
        };
        equations.multiply(traction_, column_);
        column_ += problem.constant + (1 - trial_[2 * n]) * offset_;
        put_into(change_.head(2 * n + 1), 1);
        equations.multiply(growth_, column_);
        column_ -= offset_;
        put_into(matrix_.col(2 * n), 1);
        for (Index d = 0; d < 2; ++d) {
            change_.segment(d * n, n) += trial_.segment(d * n, n) - traction_.col(d).cwiseQuotient(scale_);
            matrix_.col(2 * n).segment(d * n, n) -= growth_.col(d).cwiseQuotient(scale_);
        }
        for (Index d = 0; d < 2; ++d) {
            for (Index i = 0; i < n; ++i) {
                const Scalar x = slope_(i, d), y = slope_(i, d + 1);
                column_.col(0) = x * equations.matrix(0, 0).col(i);
                column_.col(1) = y * equations.matrix(1, 1).col(i);
                if (equations.coupled()) {
                    column_.col(0) += y * equations.matrix(0, 1).col(i);
                    column_.col(1) += x * equations.matrix(1, 0).col(i);
                }
                put_into(matrix_.col(d * n + i), scale_[i]);
                matrix_(i, d * n + i) -= x;
                matrix_(n + i, d * n + i) -= y;
                matrix_(d * n + i, d * n + i) += 1;
            }
        }
        matrix_.row(2 * n) = forward_.transpose();
    }

    // P_t(z) = 2 g z/(|r - g, w| + |r + g, w|), r = |z|, g the bound and w the rounding, and its derivatives.
    void find_tractions(const Problem& problem) {
        const Index n = scale_.size();
        const Scalar t = trial_[2 * n];
        for (Index i = 0; i < n; ++i) {
            const Scalar x = scale_[i] * trial_[i], y = scale_[i] * trial_[n + i], r = length(x, y);
            const Scalar g = t * problem.bound[i], w = 2 * (1 - t) * g;
            const Scalar low = length(r - g, w), high = length(r + g, w), sum = low + high;
            if (!(sum > 0) || problem.bound[i] == 0) {
                traction_.row(i).setZero();
                growth_.row(i).setZero();
                slope_.row(i).setZero();
                continue;
            }
            const Scalar share = 2 * g / sum;
            const Scalar g_t = problem.bound[i], w_t = 2 * (1 - 2 * t) * problem.bound[i];
            const Scalar sum_r = over(r - g, low) + over(r + g, high);
            const Scalar sum_t = over((g - r) * g_t + w * w_t, low) + over((g + r) * g_t + w * w_t, high);
            const Scalar share_t = (2 * g_t - share * sum_t) / sum, bend = -share * over(sum_r / sum, r);
            traction_(i, 0) = share * x;
            traction_(i, 1) = share * y;
            growth_(i, 0) = share_t * x;
            growth_(i, 1) = share_t * y;
            slope_(i, 0) = share + bend * x * x;
            slope_(i, 1) = bend * x * y;
            slope_(i, 2) = share + bend * y * y;
        }
    }

    MatrixX<Scalar> matrix_;
    std::vector<Index> swaps_;
    Vector at_, forward_, trial_, change_;  // longitudinal, then lateral z over scale_; t
    Vector scale_;
    Vectors offset_;             // d
    Vectors traction_, growth_;  // p, dp/dt
    Vectors column_;
    Eigen::Matrix<Scalar, Eigen::Dynamic, 3> slope_;  // dp/dz: xx, xy, yy
    Scalar length_ = 0;                               // of the next step
    Scalar rest_ = 0;                                 // of t, where to stop
    int points_ = 0;
};

}  // namespace rollbem::detail
