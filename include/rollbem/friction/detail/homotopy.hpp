// A path of solutions from zero friction to the given friction problem, followed where Newton's method has failed.
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
#include "roles.hpp"
#include "slip_matrix.hpp"
#include "slip_rotation.hpp"

namespace rollbem::detail {

/// What a search for stick and slip reads: s = A p + c, |p_i| <= b_i, and R_i s_i opposes p_i where |p_i| = b_i.
/// References to values that the caller owns, made on the stack for one search.
template <int directions>
struct ProblemView {
    SlipMatrix<directions>& matrix;            ///< A
    const Vectors<directions>& constant;       ///< c
    const VectorX<double>& bound;              ///< b
    const SlipRotation<directions>& rotation;  ///< R
    const VectorX<double>& projection_step;    ///< rho, step of the projection
    double imposed;                            ///< max |c_i|
    std::size_t history;                       ///< index of c in StageProblem::constant
};

/// Follows the solutions (z, t) of
///     z - p + rho R (M p + c + (1 - t) d) = 0,   p = P_t(z),
/// from t = 0, where p = 0, to t = 1, where p is a solution of the problem. P_t projects onto discs (in one direction
/// intervals) with radii of t times the bounds and is rounded off in proportion to 1 - t, so that it is smooth below
/// t = 1.
///
/// Since p is bounded, for almost every d the path is one smooth curve that ends at t = 1, whatever M (Chow,
/// Mallet-Paret and Yorke 1978). It may turn back in t, and is therefore followed by its length. Where M with its rows
/// weighted by the elements' areas is positive definite, each t has one solution, and the path does not turn back. d
/// points in directions that differ by an irrational angle from element to element.
template <int directions>
class Homotopy {
public:
    using Row = ElementVector<directions>;
    using Problem = ProblemView<directions>;

    explicit Homotopy(Index n)
        : matrix_(directions * n + 1, directions * n + 1),
          swaps_(static_cast<std::size_t>(directions * n + 1)),
          scale_(n),
          slope_(n, directions * directions) {
        for (VectorX<double>* vector : {&at_, &forward_, &trial_, &change_}) vector->resize(matrix_.rows());
        for (auto* vectors : {&offset_, &traction_, &growth_, &column_}) vectors->resize(n, directions);
    }

    /// Starts at t = 0; each `number` gives another path.
    void begin(const Problem& problem, int number) {
        const Index n = scale_.size(), last = at_.size() - 1;
        for (Index i = 0; i < n; ++i) {
            const double angle = golden_angle * static_cast<double>(i + number * (n + 1));
            offset_(i, 0) = problem.imposed / 50 * std::cos(angle);
            if constexpr (directions == 2) offset_(i, 1) = problem.imposed / 50 * std::sin(angle);
        }
        column_ = problem.constant + offset_;
        for (Index i = 0; i < n; ++i) {
            const Row z = -problem.projection_step[i] * problem.rotation.turned(i, Row(column_.row(i)));
            scale_[i] = std::sqrt(static_cast<double>(n)) * (problem.bound[i] + length(z));
            if (!(scale_[i] > 0)) scale_[i] = 1;
            rows(trial_.data()).row(i) = z / scale_[i];
        }
        trial_[last] = 0;
        forward_.setZero();
        forward_[last] = 1;
        linearise(problem);
        at_ = trial_;
        forward_ = change_ / change_.norm();
        length_ = longest / 2;
        rest_ = 0.5;
        points_ = 0;
    }

    /// Follows the path by some points, or until 1 - t has halved; false if there are no further points.
    bool advance(const Problem& problem) {
        const Index last = at_.size() - 1;
        const int stop = points_ + most_together;
        while (points_ < most_points && length_ > std::sqrt(std::numeric_limits<double>::epsilon())) {
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

    /// P_1(z) after advance(): near a solution if 1 - t is small.
    const Vectors<directions>& traction() const { return traction_; }
    int points() const { return points_; }  ///< number of points so far

private:
    static constexpr double golden_angle = 2.39996322972865332;
    // The following values were found by trial, with random matrices and patches. Lengths are norms of the scaled
    // unknowns of all elements.
    static constexpr double longest = 0.25;
    static constexpr double most_turn = 1.2;  // 1/cos of the angle from one point to the next
    static constexpr int most_together = 8;
    static constexpr int most_points = 500;

    static double over(double a, double b) { return b > 0 ? a / b : 0.0; }

    // Newton's method from trial_ to the path, at right angles to forward_; change_ becomes the path's direction there.
    // Returns the number of steps; 0 if it does not converge fast, or if the path turns much.
    int correct(const Problem& problem) {
        const Index last = trial_.size() - 1;
        double before = length_ / 2;
        for (int k = 1; k <= 5; ++k) {
            if (!(trial_[last] >= 0 && trial_[last] < 1)) return 0;
            const double size = linearise(problem);
            if (!(size <= before / 2)) return 0;
            before = size;
            if (!(size <= 1e-3 * length_)) continue;
            const double turn = change_.norm();  // as forward_ . change_ = 1
            change_ /= turn;
            return turn < most_turn && trial_[last] >= 0 && trial_[last] < 1 ? k : 0;
        }
        return 0;
    }

    // Takes a Newton step of trial_ and returns its size; change_ becomes the path's direction.
    double linearise(const Problem& problem) {
        set_up(problem);
        factorise_in_place<double>(matrix_, swaps_.data());
        solve_in_place<double>(matrix_, swaps_.data(), change_);
        const double size = change_.norm();
        trial_ -= change_;
        change_.setZero();
        change_[change_.size() - 1] = 1;
        solve_in_place<double>(matrix_, swaps_.data(), change_);
        return size;
    }

    // The elements' part of all unknowns, the last of which is t.
    auto rows(double* unknowns) const { return Eigen::Map<Vectors<directions>>(unknowns, scale_.size(), directions); }

    // Writes rho R times the vectors in column_, over the elements' scales, and 0 for t.
    void put(const Problem& problem, double* target) const {
        for (Index i = 0; i < scale_.size(); ++i) {
            rows(target).row(i) =
                problem.projection_step[i] / scale_[i] * problem.rotation.turned(i, Row(column_.row(i)));
        }
        target[column_.size()] = 0;
    }

    // Writes the equations' residual at trial_ into change_ and their derivatives into matrix_.
    void set_up(const Problem& problem) {
        const Index n = scale_.size(), last = directions * n;
        const auto scale = scale_.array().template replicate<1, directions>();
        find_tractions(problem);
        problem.matrix.multiply(traction_, column_);
        column_ += problem.constant + (1 - trial_[last]) * offset_;
        put(problem, change_.data());
        rows(change_.data()) += rows(trial_.data()) - (traction_.array() / scale).matrix();
        problem.matrix.multiply(growth_, column_);
        column_ -= offset_;
        put(problem, matrix_.col(last).data());
        rows(matrix_.col(last).data()).array() -= growth_.array() / scale;
        for (Index e = 0; e < directions; ++e) {
            for (Index i = 0; i < n; ++i) set_up_column(problem, e, i);
        }
        matrix_.row(last) = forward_.transpose();
    }
    // Writes the derivatives by z of element i in direction e.
    void set_up_column(const Problem& problem, Index e, Index i) {
        const SlipMatrix<directions>& M = problem.matrix;
        const Row slope = slope_.row(i).template segment<directions>(directions * e);
        for (Index d = 0; d < directions; ++d) {
            const auto own = static_cast<std::size_t>(d);
            column_.col(d) = scale_[i] * slope[d] * M.block(own, own).col(i);
            if constexpr (directions == 2) {
                if (M.coupled()) column_.col(d) += scale_[i] * slope[1 - d] * M.block(own, 1 - own).col(i);
            }
        }
        auto target = matrix_.col(e * scale_.size() + i);
        put(problem, target.data());
        rows(target.data()).row(i) -= slope;
        target[e * scale_.size() + i] += 1;
    }

    // Finds P_t(z) = 2 g z/(|r - g, w| + |r + g, w|), r = |z|, g the bound and w the rounding, and its derivatives.
    void find_tractions(const Problem& problem) {
        const Index n = scale_.size();
        const double t = trial_[directions * n];
        for (Index i = 0; i < n; ++i) {
            const Row z = scale_[i] * rows(trial_.data()).row(i);
            const double g_t = problem.bound[i], w_t = 2 * (1 - 2 * t) * problem.bound[i];
            const double r = length(z), g = t * problem.bound[i], w = 2 * (1 - t) * g;
            const double low = length(r - g, w), high = length(r + g, w), sum = low + high;
            if (!(sum > 0) || problem.bound[i] == 0) {
                traction_.row(i).setZero();
                growth_.row(i).setZero();
                slope_.row(i).setZero();
                continue;
            }
            const double share = 2 * g / sum;
            const double sum_r = over(r - g, low) + over(r + g, high);
            const double sum_t = over((g - r) * g_t + w * w_t, low) + over((g + r) * g_t + w * w_t, high);
            const double share_t = (2 * g_t - share * sum_t) / sum, bend = -share * over(sum_r / sum, r);
            traction_.row(i) = share * z;
            growth_.row(i) = share_t * z;
            for (Index e = 0; e < directions; ++e) {
                auto slope = slope_.row(i).template segment<directions>(directions * e);
                slope = bend * z[e] * z;
                slope[e] += share;
            }
        }
    }

    MatrixX<double> matrix_;
    std::vector<Index> swaps_;
    VectorX<double> at_, forward_, trial_, change_;  // z over scale_, direction by direction; t
    VectorX<double> scale_;
    Vectors<directions> offset_;             // d
    Vectors<directions> traction_, growth_;  // p, dp/dt
    Vectors<directions> column_;
    Eigen::Matrix<double, Eigen::Dynamic, directions * directions> slope_;  // dp/dz
    double length_ = 0;                                                     // length of the next step
    double rest_ = 0;                                                       // value of 1 - t where advance() stops
    int points_ = 0;
};

}  // namespace rollbem::detail
