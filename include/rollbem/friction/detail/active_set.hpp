// Stick or slip, element by element: tractions within Coulomb's bound, opposed to the slip.
// Core of the steady and the non-steady friction problem, independent of rolling and units.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../detail/finite.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "complementary_path.hpp"
#include "stick_equations.hpp"

namespace rollbem::detail {

/// How ActiveSet finds a solution.
enum class Effort {
    equations,        ///< solves the equations of the sticking elements and checks the slip
    transform,        ///< applies StickTransform, as long as no element changes its zone
    transform_check,  ///< the same, and checks the slip
};

/// Finds p and s = M p + c with |p_i| <= bound_i, s_i = 0 where |p_i| < bound_i, and s_i p_i <= 0: a linear
/// complementarity problem with bounds. Because the bounds are finite, a solution exists for every M (a continuous
/// variational inequality on a compact box: Hartman and Stampacchia 1966); it is unique where M is a P-matrix.
///
/// Primal-dual active set: in each round all elements that violate a condition change their zones at once. The rounds
/// nearly always converge quickly but may cycle if M is not a P-matrix. If the number of violations has not fallen for
/// several rounds, ComplementaryPath takes over (rounds with a finite fallback: Judice and Pires 1994).
///
/// The result depends on M, c, the bounds, the initial zones and the Effort alone, to the last bit, and not on earlier
/// solutions. All memory is allocated by the constructor.
template <class Scalar>
class ActiveSet {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Matrix = MatrixX<Scalar>;

    struct Outcome {
        int rounds = 0;       ///< rounds of the active set
        int pivots = 0;       ///< pivots of the fallback; 0 if the rounds converged
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

    /// Sets how the following solutions are found. Where the transform fails, the equations are solved.
    void begin(Effort effort) {
        effort_ = effort;
        unchanged_ = true;
    }
    /// Whether each solution since begin() has kept its initial zones and needed neither refinement nor pivoting.
    bool unchanged() const { return unchanged_; }

    /// Solves for bounds >= 0, all finite, starting from `zones`.
    Outcome solve(const Vector& bound, const std::vector<Zone>& zones) noexcept;

    /// dp caused by a change dc and, unless null, by `share` times that of the bounds, which slipping elements follow,
    /// while no element changes its zone. Requires tangent_exists of the last outcome.
    void respond(const Vector& change, Vector& traction_change, const Vector* bound_change = nullptr,
                 Scalar share = 1) {
        right_ = -change;
        if (bound_change == nullptr) {
            equations_.solve(right_, traction_change);
            return;
        }
        traction_change = -share * sign_.cwiseProduct(*bound_change);
        right_.noalias() -= equations_.matrix() * traction_change;
        equations_.solve(right_, correction_);
        traction_change += correction_;
    }

    /// Changes whenever M or the set of sticking elements does: results of respond() remain valid as long as it is
    /// equal.
    unsigned long revision() const { return equations_.revision(); }

private:
    // Rounds without progress before the fallback. In experiments, convergence after a longer plateau was never faster
    // than the fallback, which costs a few matrix-vector products per pivot and takes about n pivots.
    static constexpr int patience = 10;
    static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

    bool sticks(Index i) const { return sign_[i] == 0; }
    void set_zone(Index i, Scalar sign) {
        sign_[i] = sign;
        stick_[i] = sign == 0 ? Scalar(1) : Scalar(0);
    }
    Scalar rounding() const { return static_cast<Scalar>(size() + 10) * epsilon; }

    // An element with zero bound cannot stick. A state read from a file may contain values that are not in Zone.
    void start_from(const Vector& bound, const std::vector<Zone>& zones) {
        for (Index i = 0; i < size(); ++i) {
            const int zone = static_cast<signed char>(zones[static_cast<std::size_t>(i)]);
            const Scalar sign = zone > 0 ? Scalar(1) : zone < 0 ? Scalar(-1) : Scalar(0);
            set_zone(i, sign == 0 && bound[i] == 0 ? Scalar(1) : sign);
        }
    }

    // Returns whether they equal `before`, which may be zones_ itself.
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

    // The transform and the contribution of the slipping elements. False if the zones or the factors do not allow it.
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

    // False, without a usable result, if an element would have to change its zone or if the check fails.
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

    // The rounds of the active set. False if they do not converge.
    bool settle(const Vector& bound, Outcome& outcome) {
        Index fewest = size() + 1;
        for (int idle = 0;;) {
            if (!equations_.factorise(stick_)) return false;
            ++outcome.rounds;
            if (!evaluate(bound)) return false;
            const Index offenders = move_offenders(bound);
            if (offenders == 0) return true;
            idle = offenders < fewest ? 0 : idle + 1;
            fewest = (std::min)(fewest, offenders);
            if (idle > patience) return false;
        }
    }

    // p and s for the present zones. False if sticking elements slip by more than round-off with both kinds of factors.
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
        right_ -= sign_.cwiseProduct(bound);      // leaves no negative zero, which == does not tell from a positive one
        if (right_ == sliding_traction_) return;  // usually the zones and the bounds have not changed
        sliding_traction_ = right_;
        sliding_product_.noalias() = equations_.matrix() * sliding_traction_;
    }

    // s from M itself, and an estimate of its round-off
    void find_slip() {
        slip_.noalias() = equations_.matrix() * traction_;
        slip_scale_ = rounding() * (slip_.cwiseAbs().maxCoeff() + imposed_);
        slip_ += constant_;
        creep_ = stick_.cwiseProduct(slip_).cwiseAbs().maxCoeff();
    }

    // Computes the slip and, if sticking elements slip, refines the tractions iteratively. False if the slip remains
    // larger than round-off explains.
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

    // Changes the zone of every element that violates a condition and returns their number. An element with zero bound
    // (no pressure) has no traction and may slip in either direction.
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
        if (count == 0) measure(bound);  // only elements with zero bound have changed, to the other direction
        return count;
    }

    Outcome judge(const Vector& bound, Outcome outcome) const {
        const Scalar wrong_slip = (std::max)({creep_, wrong_slip_, Scalar(0)});
        outcome.residual = imposed_ > 0 ? wrong_slip / imposed_ : wrong_slip;
        if (excess_ > 0) outcome.residual = (std::max)(outcome.residual, excess_ / bound.maxCoeff());
        outcome.status = is_finite(outcome.residual) && outcome.residual <= 10000 * rounding()
                             ? StepStatus::ok
                             : StepStatus::no_solution;
        return outcome;
    }

    // An element with zero bound may slip in either direction.
    void orient_free(const Vector& bound) {
        for (Index i = 0; i < size(); ++i) {
            if (bound[i] == 0) set_zone(i, slip_[i] < 0 ? Scalar(-1) : Scalar(1));
        }
    }

    // Follows Lemke's path and solves once more for the zones at its end, without the round-off accumulated on the way.
    // False if M is singular on the sticking elements: the end of the path is then the result.
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
    Vector sliding_traction_, sliding_product_;  // of the slipping elements, and M times it
    Vector sliding_bound_;                       // the bounds they belong to, if transform_ready_
    Scalar imposed_ = 0;                         // max |c|
    Scalar slip_scale_ = 0;                      // round-off of the slip
    Scalar creep_ = 0;                           // largest slip of a sticking element
    Scalar wrong_slip_ = 0;                      // largest slip in the direction of the traction
    Scalar excess_ = 0;                          // largest traction above its bound
    Index stick_count_ = 0;
    Effort effort_ = Effort::equations;
    bool unchanged_ = false;
    bool refined_ = false;          // the tractions of the last round
    bool transform_ready_ = false;  // transform_ and sliding_product_ belong to zones_
};

template <class Scalar>
typename ActiveSet<Scalar>::Outcome ActiveSet<Scalar>::solve(const Vector& bound,
                                                             const std::vector<Zone>& zones) noexcept {
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

/// The number of consecutive steps in which no element changed its zone, and what the next step may omit because of it.
/// The count is kept in the states (SolverRecord), so that a step depends on nothing else. It refers to one matrix,
/// which is determined by the distance rolled in a stage and the half-length.
template <class Scalar>
class UnchangedSteps {
public:
    /// For n elements; `unit` is a_0 [m].
    UnchangedSteps(Eigen::Index n, Scalar unit) : enough_(1 + static_cast<int>(n / 2)), unit_(unit) {}

    /// For a step whose stages roll by `distance` in a_0 at constant half-length.
    Effort effort(const SolverRecord<Scalar>& from, Scalar distance) const {
        const int steps = counted(from, distance);
        if (steps < enough_) return Effort::equations;
        return steps == enough_ ? Effort::transform_check : Effort::transform;
    }

    /// Updates the count at the end of a step whose stages rolled by `distance`; `unchanged` if no element changed its
    /// zone, at constant half-length.
    void count(const SolverRecord<Scalar>& from, Scalar distance, bool unchanged, SolverRecord<Scalar>& to) const {
        to.unchanged_steps = 0;
        to.unchanged_distance = 0;
        if (!unchanged) return;
        const int steps = counted(from, distance) + 1;
        to.unchanged_steps = steps < enough_ + period ? steps : enough_;
        to.unchanged_distance = unit_ * distance;
    }

private:
    // Checks need not be frequent, as only round-off can differ.
    static constexpr int period = 64;

    // The count of `from`; 0 if it is out of range (an edited state) or belongs to another matrix.
    int counted(const SolverRecord<Scalar>& from, Scalar distance) const {
        const bool possible = from.unchanged_steps > 0 && from.unchanged_steps < enough_ + period;
        return possible && from.unchanged_distance == unit_ * distance ? from.unchanged_steps : 0;
    }

    int enough_;  // computing the transform costs about n/2 matrix-vector products and saves one or two per step
    Scalar unit_;
};

}  // namespace rollbem::detail
