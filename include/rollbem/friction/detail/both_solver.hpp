// Stick or slip, element by element, in two directions: tractions within a circle whose slip opposes them.
// The core of the friction problems with both creepages; knows neither rolling nor units.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/length.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "both_equations.hpp"
#include "both_path.hpp"
#include "slip_turn.hpp"

namespace rollbem::detail {

/// Finds p and s with s_d = M_d p_d + c_d in both directions d, |p_i| <= bound_i, s_i = 0 where |p_i| < bound_i, and
/// s_i = -v_i p_i, v_i >= 0, where |p_i| = bound_i; p_i and s_i are vectors.
///
/// Newton's method on the natural map p_i = P(p_i - rho_i s_i), P the projection onto the circle of the bound
/// (semismooth: Qi and Sun 1993; for friction Alart and Curnier 1991). An element with |p - rho s| within its bound
/// sticks in the next step; any other keeps its traction on the circle and turns it, so that it has one unknown, not
/// two. A step is halved while the residual of the map would grow. That can get stuck; then BothPath leads to a
/// point near a solution, from which Newton's method finishes. If that fails, too, the best point is returned together
/// with its violation.
///
/// If the rows behind are known (turn_slip), slip is then turned once as SlipTurn says, and s_i replaced by R_i s_i in
/// the conditions of a second solution, which begins at the first. Sticking still means s_i = 0. Where that is not
/// found, all angles are halved.
///
/// The result depends on M, c, the bounds and the starting point alone, to the last bit, and not on earlier
/// solutions. All memory is allocated by the constructor.
template <class Scalar>
class BothSolver {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Matrix = MatrixX<Scalar>;
    using Vectors = ElementVectors<Scalar>;
    using Zones = std::vector<Zone>;

    struct Outcome {
        int rounds = 0;  ///< Newton steps, those along BothPath not counted
        /// Largest violation of a bound, or traction below it where an element slips (relative to the largest bound),
        /// or wrong slip: of a sticking element, across the traction or along it (relative to the largest |c|).
        Scalar residual = 0;
        bool tangent_exists = false;
        StepStatus status = StepStatus::not_finite;
    };

    /// `coupled`: traction in one direction causes slip in the other, too.
    explicit BothSolver(Index n, bool coupled = false)
        : equations_(n, coupled),
          kept_(n, coupled, false),
          zones_(static_cast<std::size_t>(n), Zone::stick),
          part_(n),
          plain_part_(n),
          reach_(Vector::Zero(n)),
          traction_(Vectors::Zero(n, 2)),
          slip_(Vectors::Zero(n, 2)),
          constant_(Vectors::Zero(n, 2)),
          trial_(n, 2),
          trial_slip_(n, 2),
          change_(n, 2),
          best_(n, 2),
          against_slip_(Vectors::Zero(n, 2)),
          begin_(n, 2),
          plain_traction_(n, 2),
          plain_constant_(n, 2),
          plain_response_(Vectors::Zero(n, 2)),
          begin_zones_(static_cast<std::size_t>(n), Zone::stick),
          turned_change_(n, 2),
          plain_change_(Vectors::Zero(n, 2)),
          plain_slip_change_(n, 2),
          slip_response_(n, 2),
          angle_change_(n),
          turn_(n),
          path_(n) {}

    /// Turns slip from now on; the row behind each in its strip, -1 for a trailing element. With an empty list slip is
    /// not turned, as after construction. Without `tangents` respond() must not be called.
    void turn_slip(const std::vector<Index>& behind, bool tangents = true) {
        turn_.set_behind(behind);
        with_tangents_ = tangents;
    }

    Index size() const { return equations_.size(); }

    bool coupled() const { return equations_.coupled(); }
    /// The blocks of M, to be filled before the first solve and whenever they change: slip in direction `slip`
    /// (0 longitudinal, 1 lateral) by tractions in direction `by`. Unless coupled, both directions are the same.
    Matrix& new_matrix(std::size_t slip, std::size_t by) {
        reach_is_known_ = false;
        kept_.new_matrix(slip, by);
        return equations_.new_matrix(slip, by);
    }
    Matrix& new_matrix(std::size_t direction) { return new_matrix(direction, direction); }
    const Matrix& matrix(std::size_t slip, std::size_t by) const { return equations_.matrix(slip, by); }
    const Matrix& matrix(std::size_t direction) const { return matrix(direction, direction); }
    /// s = M p
    void multiply(const ElementVectors<Scalar>& p, ElementVectors<Scalar>& s) const { equations_.multiply(p, s); }
    /// c, to be filled before each solve.
    ElementVectors<Scalar>& constant() { return constant_; }
    /// c of the solution whose slip is not turned, to be filled if that starts from tractions of its own.
    ElementVectors<Scalar>& plain_constant() { return plain_constant_; }

    const ElementVectors<Scalar>& traction() const { return traction_; }
    /// s, exactly zero where elements stick. Where they slip it is against the traction, or, if slip is turned, R s is;
    /// then s_i stays the slip at the point of row i.
    const ElementVectors<Scalar>& slip() const { return slip_; }
    const Zones& zones() const { return zones_; }
    Index stick_count() const { return stick_count_; }

    /// Solves for bounds >= 0, all finite, starting from tractions and zones that hold for other c and bounds.
    Outcome solve(const Vector& bound, const SolutionStart<2, Scalar>& start) noexcept;

    /// dp due to a change dc, and to `share` times that of the bounds unless null, while no element changes between
    /// stick and slip. Slipping elements follow their bounds along their traction. If angles_follow(), angles of turned
    /// slip change with the solution that they belong to, due to plain_change() and the same change of the bounds. Only
    /// if a tangent exists according to the last outcome.
    void respond(const Vectors& change, Vectors& traction_change, const Vector* bound_change = nullptr,
                 Scalar share = 1) {
        respond(&change, traction_change, bound_change, share, nullptr);
    }
    /// The same with the change of |s|, of which dc = 0 needs no array.
    void respond(const Vectors* change, Vectors& traction_change, const Vector* bound_change, Scalar share,
                 Vector* size_change) {
        if (keeps_plain()) {
            exchange_plain();
            answer(plain_part_, change == nullptr ? nullptr : &plain_change_, bound_change, share, plain_response_,
                   turn_.follows() ? &plain_slip_change_ : nullptr);
            exchange_plain();
        }
        const Vectors* turned = change;
        if (turn_.follows()) {
            turn_.follow(plain_slip_change_, angle_change_);
            turned_change_.col(0) = -angle_change_.cwiseProduct(slip_.col(1));
            turned_change_.col(1) = angle_change_.cwiseProduct(slip_.col(0));
            if (change != nullptr) turned_change_ += *change;
            turned = &turned_change_;
        }
        answer(part_, turned, bound_change, share, traction_change, size_change == nullptr ? nullptr : &slip_response_);
        // angles change slip across
        if (size_change != nullptr) *size_change = -slip_response_.cwiseProduct(against_slip_).rowwise().sum();
    }
    /// Adds to the last response, with dp in `traction_change`, what a change of the bounds causes by itself.
    void add_response(const Vector& bound_change, Vectors& traction_change) {
        best_ = traction_change;
        begin_ = plain_response_;
        respond(nullptr, traction_change, &bound_change, 1, nullptr);
        traction_change += best_;
        if (keeps_plain()) plain_response_ += begin_;
    }
    bool angles_follow() const { return turn_.follows(); }
    bool keeps_plain() const { return is_apart_ || turn_.follows(); }
    /// The tractions for slip that is not turned, of which the angles of turned slip are those.
    const Vectors& plain_traction() const { return is_apart_ ? plain_traction_ : traction_; }
    /// Their change in the last response, if keeps_plain().
    const Vectors& plain_response() const { return plain_response_; }
    /// dc of the equations for slip that is not turned, to be filled before respond().
    Vectors& plain_change() { return plain_change_; }

    /// Derivatives of slip by bounds, as BothEquations::couple(), with angles that follow.
    void couple(Matrix& coupling) {
        const Index count = equations_.slipping_count();
        coupling.leftCols(count).setZero();
        // of the solution itself, as corrections of nearby factors for each column cost more
        if (has_tangent_) equations_.factorise(part_, turn_);
        has_tangent_ = false;
        if (turn_.follows()) {
            exchange_plain();
            if (plain_is_near_) equations_.factorise(plain_part_, SlipTurn<Scalar>(0));
            plain_is_near_ = false;
            const BothEquations<Scalar>& turned = is_apart_ ? kept_ : equations_;
            equations_.couple(plain_part_, trial_slip_, [&](Index i, const Vectors& slip_change) {
                Index k = 0;
                while (k < count && turned.slipping(k) != i) ++k;
                if (k == count) return;
                turn_.follow(slip_change, angle_change_);
                coupling.col(k) = -angle_change_.cwiseProduct(slip_.rowwise().norm());
            });
            exchange_plain();
        }
        equations_.couple(coupling, true);
    }

    /// Unit vector along the traction of each element that slips, zero for others.
    const ElementVectors<Scalar>& direction() const { return part_.direction; }
    /// Unit vector against the slip of each element that slips: along its traction, turned back if slip is turned.
    const ElementVectors<Scalar>& against_slip() const { return against_slip_; }
    /// 1 for each element that slips under pressure, zero for others.
    const Vector& slides() const { return part_.slide; }
    /// The factors behind respond().
    BothEquations<Scalar>& equations() { return equations_; }

private:
    static constexpr int longest = 60;  // Newton steps; rolling takes at most 16
    static constexpr int most_halvings = 3;
    static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

    // Residual over the sum of bounds from which on another step would not change the angles of the turn.
    inline static const Scalar nearly = std::cbrt(epsilon) * std::cbrt(epsilon);

    Scalar rounding() const { return static_cast<Scalar>(size() + 10) * epsilon; }

    // rho: from the largest influence on an element, as its own may vanish (central differences about its centre).
    void find_reach() {
        if (reach_is_known_) return;
        for (Index i = 0; i < size(); ++i) {
            const Scalar largest =
                (std::max)(matrix(0).row(i).cwiseAbs().maxCoeff(), matrix(1).row(i).cwiseAbs().maxCoeff());
            reach_[i] = largest > 0 ? 1 / largest : Scalar(1);
        }
        reach_is_known_ = true;
    }

    // Whether there is another solution to find, with slip turned.
    bool find_turn() { return turn_.find(slip_, part_.stick, part_.slide) || has_own_plain_; }

    // Keeps what the tangents of the present solution need, whose slip is not turned.
    void keep_plain() {
        plain_part_ = part_;
        bool stale = !coupled();  // also where the last step was long, although the solution is found
        for (Index i = 0; i < size(); ++i) {
            if (part_.slide[i] == 0) continue;
            slide_on(i, length(traction_(i, 0), traction_(i, 1)), plain_part_);
            const Scalar k = plain_part_.stiffness[i];
            stale = stale || (plain_part_.direction.row(i) - part_.direction.row(i)).norm() > Scalar(1e-3) ||
                    std::abs(k - part_.stiffness[i]) > Scalar(1e-3) * (k + 1 / reach_[i]);
        }
        const SlipTurn<Scalar> none(0);
        plain_is_regular_ = true;
        plain_is_near_ = !stale;
        if (stale) {
            plain_is_regular_ = equations_.factorise(plain_part_, none);
        } else {
            equations_.aim(plain_part_, none);
        }
        equations_.exchange_factors(kept_);
    }
    // The factors for slip that is not turned, or again those for slip that is.
    void exchange_plain() {
        if (is_apart_) equations_.exchange_factors(kept_);
    }

    // dp by the present factors, those of `part`, at constant angles; the change of slip unless null.
    void answer(const BothPartition<Scalar>& part, const Vectors* change, const Vector* bound_change, Scalar share,
                Vectors& traction_change, Vectors* slip_change) {
        if (equations_.respond(change, bound_change, share, traction_change, slip_change)) return;
        if (change != nullptr) {
            trial_slip_ = *change;
        } else {
            trial_slip_.setZero();
        }
        if (bound_change != nullptr) {
            trial_ = (share * *bound_change).asDiagonal() * part.direction;
            multiply(trial_, change_);
            trial_slip_ += change_;
        }
        equations_.solve(trial_slip_, part, traction_change, slip_change);
        if (slip_change != nullptr) *slip_change += trial_slip_;
        if (bound_change != nullptr) traction_change += trial_;
    }

    Zone zone(Index i) const { return part_.stick[i] != 0 ? Zone::stick : Zone::slip; }

    // For the present turn of the slip; `solves_unturned`: the present point is the solution for slip as it is. False
    // if there is no success; then the best point remains.
    bool search(const Vector& bound, const Vectors& traction, const Zones& zones, bool solves_unturned,
                Outcome& outcome) {
        least_ = (std::numeric_limits<Scalar>::max)();
        slip_is_known_ = false;
        if (solves_unturned) {
            start_turned();
        } else {
            start_from(bound, traction, zones);
        }
        if (settle(bound, true, outcome) || follow_path(bound, outcome)) return true;
        return_to_best(bound);
        return false;
    }

    bool follow_path(const Vector& bound, Outcome& outcome) {
        const typename BothPath<Scalar>::Problem problem{equations_, constant_, bound, reach_, turn_};
        path_.begin(problem, imposed_);
        while (path_.advance(problem)) {
            for (const bool careful : {true, false}) {
                traction_ = path_.traction();
                find_turned_slip(traction_, slip_);
                for (Index i = 0; i < size(); ++i) place(i, bound[i]);
                if (settle(bound, careful, outcome)) return true;
            }
        }
        return false;
    }

    // M p + c, and its round-off
    void find_slip(const Vectors& p, Vectors& s) {
        multiply(p, s);
        slip_scale_ = rounding() * (s.cwiseAbs().maxCoeff() + imposed_);
        s += constant_;
    }
    // R (M p + c), and its round-off
    void find_turned_slip(const Vectors& p, Vectors& s) {
        find_slip(p, s);
        turn_.apply(s);
    }

    // An element without pressure carries no traction.
    void let_go(Index i) {
        part_.let_go(i);
        traction_.row(i).setZero();
    }
    void place(Index i, Scalar bound) {
        if (bound == 0) traction_.row(i).setZero();
        part_.place(i, traction_(i, 0) - reach_[i] * slip_(i, 0), traction_(i, 1) - reach_[i] * slip_(i, 1), bound,
                    reach_[i], 4 * rounding());
    }

    void start_from(const Vector& bound, const Vectors& traction, const Zones& zones) {
        traction_ = traction;
        for (Index i = 0; i < size(); ++i) {
            const Scalar norm = length(traction_(i, 0), traction_(i, 1));
            if (zones[static_cast<std::size_t>(i)] == Zone::slip && norm > 0) traction_.row(i) *= bound[i] / norm;
        }
        find_turned_slip(traction_, slip_);
        for (Index i = 0; i < size(); ++i) {
            const Scalar norm = length(traction_(i, 0), traction_(i, 1));
            if (bound[i] == 0) {
                let_go(i);
            } else if (zones[static_cast<std::size_t>(i)] == Zone::stick) {
                part_.let_stick(i);
            } else if (norm > 0) {
                slide_on(i, norm, part_);
            } else {
                place(i, bound[i]);
            }
        }
    }

    // At the solution with slip as it is.
    void start_turned() {
        trial_slip_ = slip_;
        slip_is_known_ = true;
        turn_.apply(slip_);
        for (Index i = 0; i < size(); ++i) {
            if (part_.slide[i] != 0) slide_on(i, length(traction_(i, 0), traction_(i, 1)), part_);
        }
    }
    // Slip along the present traction, of size `norm`.
    void slide_on(Index i, Scalar norm, BothPartition<Scalar>& part) const {
        const Scalar x = traction_(i, 0), y = traction_(i, 1), against = -(x * slip_(i, 0) + y * slip_(i, 1));
        part.let_slide(i, x, y, norm, (std::max)(against, Scalar(0)) / (norm * norm));
    }

    // The best point so far.
    void note(const Vectors& p, Scalar residual) {
        if (!(residual < least_)) return;
        least_ = residual;
        best_ = p;
    }

    // Newton steps. False if they do not converge; `careful`: halved while the residual grows.
    bool settle(const Vector& bound, bool careful, Outcome& outcome) {
        Scalar before = (std::numeric_limits<Scalar>::max)();
        bool keeps_factors = false;  // of the step before
        has_tangent_ = false;
        for (int step = 0; step < longest; ++step) {
            if (keeps_factors) {
                equations_.aim(part_, turn_);
            } else if (!equations_.factorise(part_, turn_)) {
                return false;
            }
            ++outcome.rounds;
            take_step(bound);
            Scalar residual = natural_residual(bound, reach_, trial_, trial_slip_);
            const bool done = settled(bound, Scalar(1));
            const bool stalls = !(residual < before);
            if (!done && stalls && careful && !settled(bound, Scalar(1000))) residual = shorten(bound, before);
            if (!is_finite(residual)) return false;
            traction_ = trial_;
            slip_ = trial_slip_;
            note(traction_, residual);
            if (done || (stalls && settled(bound, Scalar(1000)))) return true;
            const bool is_close = residual < nearly * bound.sum();
            if (is_close && !is_apart_ && find_turn()) return true;
            for (Index i = 0; i < size(); ++i) place(i, bound[i]);
            const bool contracts = coupled() && residual < Scalar(1e-3) * before;
            keeps_factors = (contracts || (is_close && is_apart_)) && equations_.slips_as(part_);
            has_tangent_ = keeps_factors && is_close;
            before = residual;
        }
        return false;
    }

    // The full step, into trial_: slipping elements return to their circles.
    void take_step(const Vector& bound) {
        trial_ = traction_;
        if (!std::exchange(slip_is_known_, false)) {
            for (Index i = 0; i < size(); ++i) {
                if (part_.slide[i] != 0) trial_.row(i) = bound[i] * part_.direction.row(i);
            }
            find_slip(trial_, trial_slip_);
        }
        equations_.solve(trial_slip_, change_);
        trial_ += change_;
        for (Index i = 0; i < size(); ++i) {
            if (part_.slide[i] != 0) trial_.row(i) *= bound[i] / length(trial_(i, 0), trial_(i, 1));
        }
        find_turned_slip(trial_, trial_slip_);
    }

    // Halves the step until the residual is below the previous one, or the step is as short as it may get.
    Scalar shorten(const Vector& bound, Scalar before) {
        change_ = trial_ - traction_;
        Scalar residual = before;
        for (Scalar part = Scalar(0.5); part > Scalar(1) / 300; part /= 2) {
            trial_ = traction_ + part * change_;
            find_turned_slip(trial_, trial_slip_);
            residual = natural_residual(bound, reach_, trial_, trial_slip_);
            if (residual <= (1 - Scalar(1e-4) * part) * before) break;
        }
        return residual;
    }

    // Whether the trial is a solution in the assumed zones, to `factor` times round-off.
    bool settled(const Vector& bound, Scalar factor) const {
        return part_.holds(bound, trial_, trial_slip_, 4 * factor * rounding(), 4 * factor * slip_scale_);
    }

    void return_to_best(const Vector& bound) {
        if (least_ < (std::numeric_limits<Scalar>::max)()) traction_ = best_;
        find_turned_slip(traction_, slip_);
        for (Index i = 0; i < size(); ++i) {
            place(i, bound[i]);
            const Scalar norm = length(traction_(i, 0), traction_(i, 1));
            if (norm > bound[i] || part_.slide[i] != 0) traction_.row(i) *= norm > 0 ? bound[i] / norm : Scalar(0);
        }
        find_turned_slip(traction_, slip_);
    }

    // Publishes zones, and slip cleared of round-off; returns the largest violation. Leaves directions and stiffnesses
    // of slipping elements as they are at the solution.
    Scalar publish(const Vector& bound) {
        Scalar slip = 0, excess = 0;
        bool finite = true;
        stick_count_ = 0;
        against_slip_.setZero();
        for (Index i = 0; i < size(); ++i) {
            zones_[static_cast<std::size_t>(i)] = zone(i);
            const Scalar x = traction_(i, 0), y = traction_(i, 1), u = slip_(i, 0), v = slip_(i, 1);
            const Scalar norm = length(x, y);
            excess = (std::max)(excess, norm - bound[i]);
            if (part_.stick[i] != 0) {
                ++stick_count_;
                slip = (std::max)(slip, length(u, v));
                slip_.row(i).setZero();
            } else if (part_.slide[i] != 0) {
                excess = (std::max)(excess, bound[i] - norm);
                const Scalar size = norm > 0 ? norm : Scalar(1), along = (x * u + y * v) / size;
                slip = (std::max)({slip, std::abs(x * v - y * u) / size, along});
                part_.let_slide(i, x, y, size, (std::max)(-along, Scalar(0)) / bound[i]);
                slip_.row(i) = (std::min)(along, Scalar(0)) * part_.direction.row(i);
                turn_.take_back(i, slip_, i);
                against_slip_.row(i) = part_.direction.row(i);
                turn_.take_back(i, against_slip_, i);
            }
            finite = finite && is_finite(u) && is_finite(v) && is_finite(norm);
        }
        if (!finite) return std::numeric_limits<Scalar>::quiet_NaN();
        const Scalar largest = bound.maxCoeff();
        return (std::max)(imposed_ > 0 ? slip / imposed_ : slip, largest > 0 ? excess / largest : excess);
    }

    BothEquations<Scalar> equations_;
    BothEquations<Scalar> kept_;  // factors for slip that is not turned, if it is and tangents are wanted
    Zones zones_;
    BothPartition<Scalar> part_, plain_part_;  // plain: with the same slip
    Vector reach_;                             // rho
    Vectors traction_, slip_, constant_, trial_, trial_slip_, change_, best_;
    Vectors against_slip_;
    Vectors begin_;  // where the search with turned slip begins
    Vectors plain_traction_, plain_constant_, plain_response_;
    Zones begin_zones_;
    Vectors turned_change_, plain_change_, plain_slip_change_, slip_response_;
    Vector angle_change_;
    SlipTurn<Scalar> turn_;
    BothPath<Scalar> path_;
    bool has_tangent_ = false;    // the factors are those of the solution
    bool slip_is_known_ = false;  // trial_slip_ is that of traction_, not turned
    Scalar imposed_ = 0;          // max |c|
    Scalar slip_scale_ = 0;       // rounding of the slip
    Scalar least_ = 0;            // residual of the natural map at best_
    Index stick_count_ = 0;
    bool reach_is_known_ = false;
    bool with_tangents_ = true, plain_is_regular_ = true;
    bool plain_is_near_ = false;  // its factors are of an earlier step
    bool is_apart_ = false;       // the solution is not that for slip as it is
    bool has_own_plain_ = false;  // which has another c
};

template <class Scalar>
typename BothSolver<Scalar>::Outcome BothSolver<Scalar>::solve(const Vector& bound,
                                                               const SolutionStart<2, Scalar>& start) noexcept {
    const auto impose = [&] {
        imposed_ = 0;
        for (Index i = 0; i < size(); ++i) imposed_ = (std::max)(imposed_, length(constant_(i, 0), constant_(i, 1)));
    };
    has_own_plain_ = start.plain_traction != nullptr;
    is_apart_ = plain_is_near_ = false;
    if (has_own_plain_) constant_.swap(plain_constant_);
    impose();
    find_reach();
    turn_.stop();
    Outcome outcome;
    bool settled = search(bound, has_own_plain_ ? *start.plain_traction : start.traction, start.zones, false, outcome);
    if (has_own_plain_) constant_.swap(plain_constant_);
    if (settled && (turn_.turns() || find_turn())) {
        plain_traction_ = begin_ = traction_;
        for (Index i = 0; i < size(); ++i) begin_zones_[static_cast<std::size_t>(i)] = zone(i);
        if (with_tangents_) keep_plain();
        is_apart_ = true;
        if (has_own_plain_) {
            begin_ += start.traction - *start.plain_traction;
            impose();
        }
        settled = search(bound, begin_, begin_zones_, !has_own_plain_, outcome);
        for (int k = 0; k < most_halvings && !settled && turn_.turns(); ++k) {
            turn_.halve();
            settled = search(bound, begin_, begin_zones_, false, outcome);
        }
    }
    outcome.residual = publish(bound);
    if (!is_apart_) plain_part_ = part_;
    has_tangent_ = has_tangent_ && coupled();  // without coupling factors cost less than to correct their errors
    if (has_tangent_) equations_.aim(part_, turn_);
    outcome.tangent_exists = settled && (has_tangent_ || equations_.factorise(part_, turn_));
    if (is_apart_ && with_tangents_) outcome.tangent_exists = outcome.tangent_exists && plain_is_regular_;
    const bool solved = is_finite(outcome.residual) && outcome.residual <= 10000 * rounding();
    outcome.status = solved ? StepStatus::ok : StepStatus::no_solution;
    return outcome;
}

}  // namespace rollbem::detail
