// Stick or slip, element by element: tractions within Coulomb's bound whose slip opposes them.
// The core of the steady and of the non-steady friction problem; knows neither rolling nor units.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "complementary_path.hpp"
#include "stick_equations.hpp"
#include "stick_transform.hpp"

namespace rollbem::detail {

/// How ActiveSet finds a solution.
enum class Effort {
    equations,        ///< solves the equations of the elements that stick, and checks the slip
    transform,        ///< by StickTransform, for as long as no element changes its zone
    transform_check,  ///< the same, checked by the equations
};

/// Finds p and s = M p + c with |p_i| <= bound_i, s_i = 0 where |p_i| < bound_i, and s_i p_i <= 0: a linear
/// complementarity problem with bounds. Because the bounds are finite, a solution exists for every M (a continuous
/// variational inequality on a compact box: Hartman and Stampacchia 1966); it is unique where M is a P-matrix.
///
/// Rounds of a primal-dual active set: all elements that break a condition change at once. They nearly always settle
/// within a few rounds but may cycle where M is no P-matrix. When the number of offenders has not fallen for a while,
/// ComplementaryPath takes over (rounds with a finite fallback: Judice and Pires 1994).
///
/// The result depends on M, c, the bounds and the zones to start from, to the last bit, and on nothing that was solved
/// before. Everything is allocated by the constructor.
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
        StepStatus status = StepStatus::not_finite;
    };

    explicit ActiveSet(Index n)
        : equations_(n),
          transform_(n),
          path_(n),
          sign_(Vector::Zero(n)),
          stick_(Vector::Ones(n)),
          zones_(static_cast<std::size_t>(n), Zone::stick),
          traction_(Vector::Zero(n)),
          slip_(Vector::Zero(n)),
          constant_(Vector::Zero(n)),
          right_(n),
          correction_(n),
          sliding_traction_(Vector::Zero(n)),
          sliding_product_(Vector::Zero(n)),
          sliding_bound_(Vector::Zero(n)) {}

    Index size() const { return equations_.size(); }

    /// M, to be filled before the first solve and whenever it changes.
    Matrix& new_matrix() {
        transform_ready_ = false;
        sliding_traction_.setZero();
        sliding_product_.setZero();
        return equations_.new_matrix();
    }
    const Matrix& matrix() const { return equations_.matrix(); }
    /// c, to be filled before each solve.
    Vector& constant() { return constant_; }

    const Vector& traction() const { return traction_; }
    const Vector& slip() const { return slip_; }
    const std::vector<Zone>& zones() const { return zones_; }
    /// Zones as numbers, +-1 for slip and 0 for stick.
    const Vector& signs() const { return sign_; }
    Index stick_count() const { return stick_count_; }

    /// How the solutions to come shall be found. Where the transform does not do, the equations are solved.
    void begin(Effort effort) {
        effort_ = effort;
        unchanged_ = true;
    }
    /// Whether each solution since then has been found at once, with the zones that it started from.
    bool unchanged() const { return unchanged_; }

    /// Solves for bounds >= 0, all finite, starting from `zones`.
    Outcome solve(const Vector& bound, const std::vector<Zone>& zones) noexcept {
        Outcome outcome;
        if (effort_ != Effort::equations) {
            if (transform(bound, zones, outcome)) return outcome;
            effort_ = Effort::equations;
            unchanged_ = false;
        }
        transform_ready_ = false;
        imposed_ = constant_.cwiseAbs().maxCoeff();
        start_from(bound, zones);
        outcome.tangent_exists = settle(bound, outcome) || finish_by_path(bound, outcome);
        const bool same_zones = publish_zones(zones);
        unchanged_ = unchanged_ && same_zones && outcome.rounds == 1 && !refined_ && !equations_.uses_pivoted();
        return judge(bound, outcome);
    }

    /// dp that follows a change dc while no element changes. Only where the last outcome says that a tangent exists.
    template <class Derived>
    void respond(const Eigen::MatrixBase<Derived>& change, Vector& traction_change) {
        right_ = -change;
        equations_.solve(right_, traction_change);
    }

    /// The same where the bounds change by `share` of bound_change, too: elements that slip follow theirs.
    void respond(const Vector& change, const Vector& bound_change, Vector& traction_change, Scalar share = 1) {
        traction_change = -share * sign_.cwiseProduct(bound_change);
        right_ = -change;
        right_.noalias() -= equations_.matrix() * traction_change;
        equations_.solve(right_, correction_);
        traction_change += correction_;
    }

    /// Changes with the elements that stick, and with M: what respond() gave holds as long as this number does.
    unsigned long revision() const { return equations_.revision(); }

private:
    // Rounds without progress before the fallback. Where the rounds settle at all, longer plateaus were never seen to
    // pay; the fallback costs some products of matrix and vector a pivot, with about n pivots.
    static constexpr int patience = 10;
    static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

    // Quicker than ==. Zeros of two signs or paddings that differ cost time, not more.
    template <class Values>
    static bool same_bits(const Values& x, const Values& y) {
        return std::memcmp(x.data(), y.data(), static_cast<std::size_t>(x.size()) * sizeof(*x.data())) == 0;
    }

    bool sticks(Index i) const { return sign_[i] == 0; }
    void set_zone(Index i, Scalar sign) {
        sign_[i] = sign;
        stick_[i] = sign == 0 ? Scalar(1) : Scalar(0);
    }
    Scalar rounding() const { return static_cast<Scalar>(size() + 10) * epsilon; }

    // What has no bound cannot stick. A state read from a file may hold other numbers than those of Zone.
    void start_from(const Vector& bound, const std::vector<Zone>& zones) {
        for (Index i = 0; i < size(); ++i) {
            const int zone = static_cast<signed char>(zones[static_cast<std::size_t>(i)]);
            const Scalar sign = zone > 0 ? Scalar(1) : zone < 0 ? Scalar(-1) : Scalar(0);
            set_zone(i, sign == 0 && bound[i] == 0 ? Scalar(1) : sign);
        }
    }

    // Whether they are those of `before`, which may be zones_ itself.
    bool publish_zones(const std::vector<Zone>& before) {
        stick_count_ = 0;
        bool same = true;
        for (Index i = 0; i < size(); ++i) {
            const auto k = static_cast<std::size_t>(i);
            const Zone zone = static_cast<Zone>(static_cast<signed char>(sign_[i]));
            same = same && before[k] == zone;
            zones_[k] = zone;
            if (sticks(i)) ++stick_count_;
        }
        return same;
    }

    // The transform, and what the elements that slip contribute. False where zones or factors do not allow it.
    bool prepare_transform(const Vector& bound, const std::vector<Zone>& zones) {
        if (transform_ready_ && same_bits(zones, zones_) && same_bits(bound, sliding_bound_)) return true;
        transform_ready_ = false;
        start_from(bound, zones);
        if (!publish_zones(zones) || !equations_.factorise(stick_) || equations_.uses_pivoted()) return false;
        transform_.make(equations_);
        find_sliding(bound);
        sliding_bound_ = bound;
        return transform_ready_ = true;
    }

    // False, with nothing of use, where an element would have to change its zone or the check fails.
    bool transform(const Vector& bound, const std::vector<Zone>& zones, Outcome& outcome) {
        if (!prepare_transform(bound, zones)) return false;
        right_ = constant_ + sliding_product_;
        transform_.apply(equations_, right_, correction_);
        traction_ = sliding_traction_ + stick_.cwiseProduct(correction_);
        slip_ = sign_.cwiseAbs2().cwiseProduct(correction_ + right_);
        const Scalar margin =
            (stick_.cwiseProduct(bound - traction_.cwiseAbs()) + sign_.cwiseProduct(slip_)).minCoeff();
        if (!(margin >= 0)) return false;
        if (effort_ == Effort::transform_check) {
            imposed_ = constant_.cwiseAbs().maxCoeff();
            correction_.noalias() = equations_.matrix() * traction_;
            slip_scale_ = rounding() * (correction_.cwiseAbs().maxCoeff() + imposed_);
            const Scalar difference = (correction_ + constant_ - slip_).cwiseAbs().maxCoeff();
            if (!(difference <= 4 * slip_scale_)) return false;
            outcome.residual = imposed_ > 0 ? difference / imposed_ : difference;
        }
        outcome.rounds = 1;
        outcome.tangent_exists = true;
        outcome.status = StepStatus::ok;
        return true;
    }

    // The rounds of the active set. False when they do not settle.
    bool settle(const Vector& bound, Outcome& outcome) {
        Index fewest = size() + 1;
        for (int idle = 0;;) {
            if (!equations_.factorise(stick_)) return false;
            ++outcome.rounds;
            if (!evaluate(bound)) return false;
            const Index offenders = move_offenders(bound);
            if (offenders == 0) return true;
            idle = offenders < fewest ? 0 : idle + 1;
            fewest = std::min(fewest, offenders);
            if (idle > patience) return false;
        }
    }

    // p and s from the zones. False when stick elements creep more than rounding explains, whatever the factors.
    bool evaluate(const Vector& bound) {
        for (;;) {
            find_sliding(bound);
            right_ = -sliding_product_ - constant_;
            equations_.solve(right_, correction_);
            traction_ = sliding_traction_ + correction_;
            if (verify()) return true;
            if (equations_.uses_pivoted() || !equations_.pivot()) return false;
        }
    }

    void find_sliding(const Vector& bound) {
        right_.setZero();
        right_ -= sign_.cwiseProduct(bound);      // no zero with a sign, which == would not tell apart
        if (right_ == sliding_traction_) return;  // mostly the same elements slide as before
        sliding_traction_ = right_;
        sliding_product_.noalias() = equations_.matrix() * sliding_traction_;
    }

    // s from M itself, and how much of it is rounding
    void find_slip() {
        slip_.noalias() = equations_.matrix() * traction_;
        slip_scale_ = rounding() * (slip_.cwiseAbs().maxCoeff() + imposed_);
        slip_ += constant_;
        creep_ = stick_.cwiseProduct(slip_).cwiseAbs().maxCoeff();
    }

    // Slip and, where the stick elements creep, iterative refinement of the tractions. False when they still creep more
    // than rounding explains.
    bool verify() {
        for (int attempt = 0;; ++attempt) {
            find_slip();
            refined_ = attempt > 0;
            if (creep_ <= 4 * slip_scale_) return true;
            if (attempt == 2 || !is_finite(creep_)) return is_finite(creep_) && creep_ <= 1000 * slip_scale_;
            right_ = -slip_;
            equations_.solve(right_, correction_);
            traction_ += correction_;
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

    Outcome judge(const Vector& bound, Outcome outcome) const {
        const Scalar wrong_slip = std::max({creep_, wrong_slip_, Scalar(0)});
        outcome.residual = imposed_ > 0 ? wrong_slip / imposed_ : wrong_slip;
        if (excess_ > 0) outcome.residual = std::max(outcome.residual, excess_ / bound.maxCoeff());
        outcome.status = is_finite(outcome.residual) && outcome.residual <= 10000 * rounding()
                             ? StepStatus::ok
                             : StepStatus::no_solution;
        return outcome;
    }

    // what has no bound slips either way
    void orient_free(const Vector& bound) {
        for (Index i = 0; i < size(); ++i) {
            if (bound[i] == 0) set_zone(i, slip_[i] < 0 ? Scalar(-1) : Scalar(1));
        }
    }

    // Lemke's path, and its end once more from the zones, freed of the rounding picked up along the way. Where M is
    // singular on the stick elements, the path's own end stands: false.
    bool finish_by_path(const Vector& bound, Outcome& outcome) {
        outcome.pivots = path_.follow(equations_.matrix(), constant_, bound);
        for (Index i = 0; i < size(); ++i) set_zone(i, path_.sign()[i]);
        if (equations_.factorise(stick_) && evaluate(bound)) {
            orient_free(bound);
            measure(bound);
            if (judge(bound, outcome).status == StepStatus::ok) return true;
        }
        traction_ = path_.traction();
        find_slip();
        orient_free(bound);
        measure(bound);
        return false;
    }

    StickEquations<Scalar> equations_;
    StickTransform<Scalar> transform_;
    ComplementaryPath<Scalar> path_;
    Vector sign_, stick_;
    std::vector<Zone> zones_;
    Vector traction_, slip_, constant_, right_, correction_;
    Vector sliding_traction_,
        sliding_product_;    // of the elements that slip, and what it contributes to the slip of all
    Vector sliding_bound_;   // the bounds that they belong to where transform_ready_
    Scalar imposed_ = 0;     // max |c|
    Scalar slip_scale_ = 0;  // rounding of the slip
    Scalar creep_ = 0;       // largest slip of an element that should stick
    Scalar wrong_slip_ = 0;  // largest slip in the direction of the traction
    Scalar excess_ = 0;      // largest traction above its bound
    Index stick_count_ = 0;
    Effort effort_ = Effort::equations;
    bool unchanged_ = false;
    bool refined_ = false;          // the tractions of the last round
    bool transform_ready_ = false;  // for zones_, with what slides
};

}  // namespace rollbem::detail
