// Stick or slip, element by element: tractions within Coulomb's bound whose slip opposes them.
// The core of the steady and of the non-steady friction problem; knows neither rolling nor units.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "../assembly/influence.hpp"

namespace rollbem {

/// What became of a friction problem.
enum class FrictionStatus {
    ok,
    /// None was found to rounding: the complementarity residual tells how far off this one is. With finite bounds a
    /// solution always exists, so only matrices that are singular to rounding lead here.
    no_solution,
    not_finite,    ///< an input or a result is not a number or infinite
    invalid_step,  ///< the distance rolled is not positive and finite
    wrong_state,   ///< a state of a different size, or one object both `from` and `to`
};

/// What an element does. The value is the sign of the slip s; the traction of a slipping element is -sign(s) mu p_n.
enum class Zone : signed char { slip_negative = -1, stick = 0, slip_positive = 1 };

namespace detail {

/// Finds p and s = M p + c with |p_i| <= bound_i, s_i = 0 where |p_i| < bound_i, and s_i p_i <= 0: a linear
/// complementarity problem with bounds. Because the bounds are finite, a solution exists for every M (a continuous
/// variational inequality on a compact box: Hartman and Stampacchia 1966); it is unique where M is a P-matrix.
///
/// Rounds of a primal-dual active set: all elements that break a condition change at once. They nearly always settle
/// within a few rounds but may cycle where M is no P-matrix. When the number of offenders has not fallen for a while,
/// the solver turns to Lemke's complementary pivoting on c + t d, d of one sign, from full sliding at large t down to
/// t = 0: for finite bounds its path ends at a solution for every M, as a secondary ray would have to leave the box.
/// (Lemke 1965; Judice and Pires 1994 for rounds with a finite fallback; Cottle, Pang and Stone, ch. 4.)
///
/// T is the principal pivot transform of M: it maps (s_stick, p_slip) to (p_stick, s_slip), c left aside. With T at
/// hand, a solution is one product; an element that changes costs one update of rank one instead of a factorisation.
/// Everything is allocated by the constructor.
template <class Scalar>
class ActiveSet {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Matrix = MatrixX<Scalar>;

    struct Outcome {
        int rounds = 0;       ///< rounds of the active set
        int pivots = 0;       ///< pivots of the fallback; 0 where the rounds settled
        Scalar residual = 0;  ///< largest violation of a bound (over the largest bound) and of s (over max |c|)
        bool tangent_exists = false;
        FrictionStatus status = FrictionStatus::not_finite;
    };

    explicit ActiveSet(Index n)
        : matrix_(n, n),
          transform_(n, n),
          transform_stick_(Vector::Zero(n)),
          sign_(Vector::Zero(n)),
          stick_(Vector::Ones(n)),
          zones_(static_cast<std::size_t>(n), Zone::stick),
          traction_(Vector::Zero(n)),
          slip_(Vector::Zero(n)),
          constant_(Vector::Zero(n)),
          input_(n),
          output_(n),
          row_(n),
          column_(n),
          lu_(n),
          system_(n, n),
          path_lu_(n + 1),
          path_system_(n + 1, n + 1),
          path_inverse_(n + 1, n + 1),
          path_kept_(Vector::Zero(n)),
          path_row_(n + 1),
          path_column_(n + 1),
          path_direction_(n + 1),
          path_slip_(n),
          cover_(n) {}

    Index size() const { return matrix_.rows(); }

    /// M, to be filled before the first solve and after each invalidate().
    Matrix& matrix() { return matrix_; }
    /// c, to be filled before each solve.
    Vector& constant() { return constant_; }
    void invalidate() { valid_ = false; }
    bool valid() const { return valid_; }

    const Vector& traction() const { return traction_; }
    const Vector& slip() const { return slip_; }
    const std::vector<Zone>& zones() const { return zones_; }
    /// Zones as numbers, +-1 for slip and 0 for stick.
    const Vector& signs() const { return sign_; }
    Index stick_count() const { return stick_count_; }

    /// Solves for bounds >= 0, all finite, starting from `zones`.
    Outcome solve(const Vector& bound, const std::vector<Zone>& zones) noexcept {
        start_from(bound, zones);
        Outcome outcome;
        if (!settle(bound, outcome)) finish_by_path(bound, outcome);
        publish_zones();
        return judge(bound, outcome);
    }

    /// dp that follows a change dc while no element changes, both as vectors. Only where T is valid.
    template <class Derived>
    void respond(const Eigen::MatrixBase<Derived>& change, Vector& traction_change) {
        input_ = stick_.cwiseProduct(change);
        output_.noalias() = transform_ * input_;
        traction_change = -stick_.cwiseProduct(output_);
    }

    /// Counts the changes of T: what was derived from T holds as long as this number does.
    unsigned long revision() const { return revision_; }

private:
    // Rounds without progress before the fallback. Where the rounds settle at all, longer plateaus were never seen to
    // pay; the fallback costs some products of matrix and vector a pivot, with about n pivots.
    static constexpr int patience = 10;
    static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

    bool sticks(Index i) const { return sign_[i] == 0; }
    void set_zone(Index i, Scalar sign) {
        sign_[i] = sign;
        stick_[i] = sign == 0 ? Scalar(1) : Scalar(0);
        unfollowed_ = unpublished_ = true;
    }
    Scalar rounding() const { return static_cast<Scalar>(size() + 10) * epsilon; }

    // Nothing to do where the last solution ended in the same zones. What has no bound cannot stick.
    void start_from(const Vector& bound, const std::vector<Zone>& zones) {
        if (zones == zones_) return;
        for (Index i = 0; i < size(); ++i) {
            const Scalar sign = static_cast<Scalar>(static_cast<signed char>(zones[static_cast<std::size_t>(i)]));
            set_zone(i, sign == 0 && bound[i] == 0 ? Scalar(1) : sign);
        }
    }

    void publish_zones() {
        if (!unpublished_) return;
        unpublished_ = false;
        stick_count_ = 0;
        for (Index i = 0; i < size(); ++i) {
            zones_[static_cast<std::size_t>(i)] = static_cast<Zone>(static_cast<signed char>(sign_[i]));
            if (sticks(i)) ++stick_count_;
        }
    }

    // The rounds of the active set. False when they do not settle.
    bool settle(const Vector& bound, Outcome& outcome) {
        if (!(valid_ ? follow_zones() : refresh())) return false;
        Index fewest = size() + 1;
        for (int idle = 0;;) {
            ++outcome.rounds;
            evaluate(bound);
            if (!verify()) {  // the transform has drifted through its updates
                if (!refresh()) return false;
                evaluate(bound);
                if (!verify()) return false;
            }
            const Index offenders = move_offenders(bound);
            if (offenders == 0) return true;
            idle = offenders < fewest ? 0 : idle + 1;
            fewest = std::min(fewest, offenders);
            if (idle > patience || !follow_zones()) return false;
        }
    }

    // p from the zones by one product with T
    void evaluate(const Vector& bound) {
        input_ = -stick_.cwiseProduct(constant_) - sign_.cwiseProduct(bound);
        output_.noalias() = transform_ * input_;
        traction_ = input_ + stick_.cwiseProduct(output_ - input_);
    }

    // s from M itself, and how much of it is rounding
    void find_slip() {
        slip_.noalias() = matrix_ * traction_;
        imposed_ = constant_.cwiseAbs().maxCoeff();
        slip_scale_ = rounding() * (slip_.cwiseAbs().maxCoeff() + imposed_);
        slip_ += constant_;
        creep_ = stick_.cwiseProduct(slip_).cwiseAbs().maxCoeff();
    }

    // Slip and, where the stick elements creep, iterative refinement of the tractions. False when they still creep more
    // than rounding explains.
    bool verify() {
        for (int attempt = 0;; ++attempt) {
            find_slip();
            if (creep_ <= 4 * slip_scale_) return true;
            if (attempt == 2 || !std::isfinite(creep_)) return creep_ <= 1000 * slip_scale_;
            input_ = -stick_.cwiseProduct(slip_);
            output_.noalias() = transform_ * input_;
            traction_ += stick_.cwiseProduct(output_);
        }
    }

    void measure(const Vector& bound) {
        excess_ = (traction_.cwiseAbs() - bound).maxCoeff();
        wrong_slip_ = -sign_.cwiseProduct(slip_).minCoeff();
    }

    // Moves every element that breaks a condition to where it belongs; how many there were. An element without bound
    // (no pressure) carries nothing and may slip either way.
    Index move_offenders(const Vector& bound) {
        measure(bound);
        if (excess_ <= 0 && wrong_slip_ <= 4 * slip_scale_) return 0;
        Index count = 0;
        for (Index i = 0; i < size(); ++i) {
            if (sticks(i)) {
                if (std::abs(traction_[i]) <= (1 + 4 * rounding()) * bound[i]) continue;
                set_zone(i, traction_[i] > 0 ? Scalar(-1) : Scalar(1));
                ++count;
            } else if (sign_[i] * slip_[i] < -4 * slip_scale_) {
                set_zone(i, bound[i] > 0 ? Scalar(0) : -sign_[i]);
                if (bound[i] > 0) ++count;
            }
        }
        if (count == 0) measure(bound);  // those without bound have turned round
        return count;
    }

    // Brings T from its zones to the present ones: by updates of rank one while they are cheaper than starting afresh.
    bool follow_zones() {
        if (!unfollowed_) return true;
        unfollowed_ = false;
        const Scalar changes = (transform_stick_ - stick_).cwiseAbs().sum();
        if (2 * changes > static_cast<Scalar>(size())) return refresh();
        for (Index i = 0; i < size(); ++i) {
            if (transform_stick_[i] == stick_[i]) continue;
            const Scalar pivot = transform_(i, i);
            if (!(std::abs(pivot) > std::sqrt(epsilon) * transform_.col(i).cwiseAbs().maxCoeff())) return refresh();
            exchange(i, pivot);
        }
        return true;
    }

    // swaps p_i and s_i between input and output of T
    void exchange(Index i, Scalar pivot) {
        row_ = transform_.row(i).transpose() / -pivot;
        column_ = transform_.col(i);
        row_[i] = 0;
        column_[i] = 0;
        for (Index k = 0; k < size(); ++k) transform_.col(k) += row_[k] * column_;
        transform_.col(i) = column_ / pivot;
        transform_.row(i) = row_.transpose();
        transform_(i, i) = 1 / pivot;
        transform_stick_[i] = 1 - transform_stick_[i];
        ++revision_;
    }

    // T from M. With B = M on the stick rows and the identity on the others, B^-1 holds the stick rows of T and
    // M B^-1 the others. False when B is singular to working precision.
    bool refresh() {
        ++revision_;
        valid_ = false;
        for (Index i = 0; i < size(); ++i) {
            if (sticks(i)) {
                system_.row(i) = matrix_.row(i);
            } else {
                system_.row(i).setZero();
                system_(i, i) = 1;
            }
        }
        transform_stick_ = stick_;
        const Scalar stuck = stick_.sum();
        if (stuck == 0) {
            transform_ = matrix_;
            return valid_ = transform_.allFinite();
        }
        lu_.compute(system_);
        invert(lu_, transform_);
        if (stuck < static_cast<Scalar>(size())) {
            system_.noalias() = matrix_ * transform_;
            for (Index i = 0; i < size(); ++i) {
                if (!sticks(i)) transform_.row(i) = system_.row(i);
            }
        }
        return valid_ = transform_.allFinite();
    }

    Outcome judge(const Vector& bound, Outcome outcome) const {
        const Scalar wrong_slip = std::max({creep_, wrong_slip_, Scalar(0)});
        outcome.residual = imposed_ > 0 ? wrong_slip / imposed_ : wrong_slip;
        if (excess_ > 0) outcome.residual = std::max(outcome.residual, excess_ / bound.maxCoeff());
        outcome.tangent_exists = valid_;
        outcome.status = outcome.residual <= 10000 * rounding() ? FrictionStatus::ok : FrictionStatus::no_solution;
        return outcome;
    }

    // what has no bound slips either way
    void orient_free(const Vector& bound) {
        for (Index i = 0; i < size(); ++i) {
            if (bound[i] == 0) set_zone(i, slip_[i] < 0 ? Scalar(-1) : Scalar(1));
        }
    }

    void finish_by_path(const Vector& bound, Outcome& outcome) {
        outcome.pivots = follow_path(bound);
        // The end of the path once more from its zones, freed of the rounding picked up along the way. Where M is
        // singular on the stick elements, the path's own end stands.
        path_direction_.head(size()) = traction_;
        if (refresh()) {
            evaluate(bound);
            if (verify()) {
                orient_free(bound);
                measure(bound);
                if (judge(bound, outcome).status == FrictionStatus::ok) return;
            }
        }
        valid_ = false;
        traction_ = path_direction_.head(size());
        find_slip();
        orient_free(bound);
        measure(bound);
    }

    // Lemke's path for c + t d. Between two pivots p and t move along a line on which all but one of the conditions
    // hold with equality where they should; that one, the driven, gives way to the condition that blocks.
    int follow_path(const Vector& bound) {
        const Index n = size();
        const Scalar side = constant_.sum() < 0 ? Scalar(-1) : Scalar(1);
        // entries apart by an irrational step: no two conditions then block at once on a symmetric problem
        for (Index i = 0; i < n; ++i) {
            const Scalar golden = static_cast<Scalar>(i + 1) * Scalar(0.6180339887498949L);
            cover_[i] = side * (1 + (golden - std::floor(golden)) / 64);
            set_zone(i, side);
        }
        traction_ = -side * bound;
        path_slip_.noalias() = matrix_ * traction_;
        path_slip_ += constant_;
        Scalar t = 0;
        Index driven = -1;
        for (Index i = 0; i < n; ++i) {
            const Scalar needed = -path_slip_[i] / cover_[i];
            if (bound[i] > 0 && needed > t) {
                t = needed;
                driven = i;
            }
        }
        if (driven < 0) return 1;  // full sliding is a solution
        path_slip_ += t * cover_;
        bool drives_traction = true;
        Scalar direction = side;
        set_zone(driven, 0);
        path_driven_ = -1;
        const int limit = static_cast<int>(50 * n + 50);
        for (int pivot = 1; pivot <= limit; ++pivot) {
            if (!find_direction(driven, drives_traction, direction)) return pivot;
            const Scalar t_direction = path_direction_[n];

            Scalar step = t_direction < 0 ? -t / t_direction : std::numeric_limits<Scalar>::infinity();
            Index blocking = -1;
            for (Index i = 0; i < n; ++i) {
                Scalar room = std::numeric_limits<Scalar>::infinity();
                if (sticks(i)) {
                    const Scalar change = path_direction_[i];
                    if (change != 0)
                        room = (change > 0 ? bound[i] - traction_[i] : bound[i] + traction_[i]) / std::abs(change);
                } else if (bound[i] > 0 && sign_[i] * row_[i] < 0) {
                    room = -path_slip_[i] / row_[i];
                }
                if (std::max(room, Scalar(0)) < step) {
                    step = std::max(room, Scalar(0));
                    blocking = i;
                }
            }
            if (!std::isfinite(step)) return pivot;
            traction_ += step * path_direction_.head(n);
            path_slip_ += step * row_;
            t += step * t_direction;
            if (blocking < 0) return pivot;
            driven = blocking;
            drives_traction = !sticks(blocking);
            if (drives_traction) {
                direction = sign_[blocking];
                path_slip_[blocking] = 0;
                set_zone(blocking, 0);
            } else {
                const bool forward = path_direction_[blocking] > 0;
                traction_[blocking] = forward ? bound[blocking] : -bound[blocking];
                direction = forward ? Scalar(-1) : Scalar(1);
                set_zone(blocking, direction);
            }
        }
        return limit;
    }

    // (dp, dt) of the path, and the change of slip that follows. False when there is none to working precision.
    bool find_direction(Index driven, bool drives_traction, Scalar direction) {
        const Index n = size();
        for (bool fresh = !follow_driven(driven);; fresh = true) {
            if (fresh && !invert_path(driven)) return false;
            path_direction_ = direction * path_inverse_.col(drives_traction ? n : driven);
            row_.noalias() = matrix_ * path_direction_.head(n);
            row_ += path_direction_[n] * cover_;
            if (fresh) return true;
            // rounding that the updates of the inverse have picked up makes stick elements creep
            Scalar creep = 0;
            for (Index i = 0; i < n; ++i) {
                if (sticks(i) && i != driven) creep = std::max(creep, std::abs(row_[i]));
            }
            if (creep <= Scalar(0.01) * std::sqrt(epsilon) * row_.cwiseAbs().maxCoeff()) return true;
        }
    }

    // The equations for (dp, dt): no slip on the stick elements, no change of traction on the others, unit speed of the
    // driven. Their inverse, afresh.
    bool invert_path(Index driven) {
        const Index n = size();
        path_system_.setZero();
        for (Index i = 0; i < n; ++i) {
            const bool kept = sticks(i) || i == driven;
            path_kept_[i] = kept ? Scalar(1) : Scalar(0);
            if (kept) {
                path_system_.row(i).head(n) = matrix_.row(i);
                path_system_(i, n) = cover_[i];
            } else {
                path_system_(i, i) = 1;
            }
        }
        path_system_(n, driven) = 1;
        path_driven_ = driven;
        path_lu_.compute(path_system_);
        invert(path_lu_, path_inverse_);
        return path_inverse_.allFinite();
    }

    // The inverse after a pivot, by updates of rank one. False when one of them would be singular.
    bool follow_driven(Index driven) {
        const Index n = size();
        if (path_driven_ < 0) return false;
        // in an order in which no two rows become equal
        if (path_kept_[driven] == 0) {
            path_row_.noalias() = path_inverse_.topRows(n).transpose() * matrix_.row(driven).transpose();
            path_row_ += cover_[driven] * path_inverse_.row(n).transpose();
            path_kept_[driven] = 1;
            if (!replace_path_row(driven)) return false;
        }
        const Index before = std::exchange(path_driven_, driven);
        if (before == driven) return true;
        path_row_ = path_inverse_.row(driven).transpose();
        if (!replace_path_row(n)) return false;
        if (sticks(before)) return true;
        path_row_ = path_inverse_.row(before).transpose();
        path_kept_[before] = 0;
        return replace_path_row(before);
    }

    // Row i of the equations becomes r, path_row_ = r^T times the inverse.
    bool replace_path_row(Index i) {
        const Scalar pivot = path_row_[i];
        if (!(std::abs(pivot) > std::sqrt(epsilon) * path_row_.cwiseAbs().maxCoeff())) return false;
        path_row_[i] -= 1;
        path_column_ = path_inverse_.col(i) / -pivot;
        for (Index k = 0; k <= size(); ++k) path_inverse_.col(k) += path_row_[k] * path_column_;
        return true;
    }

    // The inverse in place: Eigen's own copies the factors.
    static void invert(const Eigen::PartialPivLU<Matrix>& lu, Matrix& inverse) {
        inverse.setZero();
        for (Index i = 0; i < inverse.rows(); ++i) inverse(lu.permutationP().indices()[i], i) = 1;
        lu.matrixLU().template triangularView<Eigen::UnitLower>().solveInPlace(inverse);
        lu.matrixLU().template triangularView<Eigen::Upper>().solveInPlace(inverse);
    }

    Matrix matrix_, transform_;
    Vector transform_stick_, sign_, stick_;
    std::vector<Zone> zones_;
    Vector traction_, slip_, constant_, input_, output_, row_, column_;
    Eigen::PartialPivLU<Matrix> lu_;
    Matrix system_;
    Eigen::PartialPivLU<Matrix> path_lu_;
    Matrix path_system_, path_inverse_;
    Vector path_kept_, path_row_, path_column_, path_direction_, path_slip_, cover_;
    Index path_driven_ = -1;
    Scalar imposed_ = 0;     // max |c|
    Scalar slip_scale_ = 0;  // rounding of the slip
    Scalar creep_ = 0;       // largest slip of an element that should stick
    Scalar wrong_slip_ = 0;  // largest slip in the direction of the traction
    Scalar excess_ = 0;      // largest traction above its bound
    Index stick_count_ = 0;
    bool valid_ = false;       // T belongs to M and transform_stick_
    bool unfollowed_ = true;   // zones may differ from T's
    bool unpublished_ = true;  // signs may differ from zones_
    unsigned long revision_ = 0;
};

}  // namespace detail

}  // namespace rollbem
