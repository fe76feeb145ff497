// The solver of friction problems: stick or slip, element by element, in one direction or two. It knows neither rolling
// nor units.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../detail/finite.hpp"
#include "../../status.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "roles.hpp"
#include "slip_problem.hpp"
#include "slip_search.hpp"

namespace rollbem::detail {

/// Finds p and s = M p + c with |p_i| <= b_i, s_i = 0 where |p_i| < b_i, and s_i = -v_i p_i, v_i >= 0, where
/// |p_i| = b_i; p_i and s_i are numbers or plane vectors. Because the bounds b are finite, a solution exists for every
/// M (a continuous variational inequality on a compact set: Hartman and Stampacchia 1966); SlipSearch looks for it.
///
/// If the slip at the centres is known (turn_slip), a second solution follows, whose conditions hold for R_i s_i in
/// place of s_i. The rotations R_i come from the first solution (SlipTurn), from which the second search starts.
/// Sticking still means s_i = 0. If the second solution is not found, all angles are halved.
///
/// The result depends on M, c, the bounds and the starting point alone, to the last bit, and not on earlier solutions.
/// All memory is allocated by the constructor.
template <int directions_>
class StickSlip {
public:
    static constexpr int directions = directions_;
    using Index = Eigen::Index;
    using Vector = VectorX<double>;
    using Vectors = ElementVectors<directions>;
    using Matrix = MatrixX<double>;
    using Start = SolutionStart<directions>;

    struct Outcome {
        int rounds = 0;       ///< Newton steps
        int path_points = 0;  ///< points of the fallback SlipPath; 0 if it was not needed
        /// Largest violation of the conditions. Tractions, over the largest bound: |p| above its bound, or below it
        /// where an element slides. Slip, over the largest |c|: slip of a sticking element, across the traction or
        /// along it, and the estimated error of s = M p + c.
        double residual = 0;
        bool tangent_exists = false;
        Status status = Status::not_finite;
    };

    /// A change of the problem: dc of each solution and the change of the bounds; null means no change. The second dc
    /// is read only if the second solution has constants of its own.
    struct Change {
        std::array<const Vectors*, directions> constant{};
        const Vector* bound = nullptr;
    };

    /// `coupled`: traction in one direction causes slip in the other, too.
    explicit StickSlip(Index n, bool coupled = false)
        : equations_(n, coupled),
          search_(n),
          points_(directions, Point(n)),
          turn_(n),
          zones_(static_cast<std::size_t>(n), Zone::stick),
          slides_(Vector::Zero(n)),
          constant_(directions, Vectors::Zero(n, directions)),
          response_(constant_),
          difference_(constant_[0]),
          slip_response_(difference_),
          against_slip_(difference_),
          angle_change_(slides_),
          right_(slides_),
          unit_(slides_),
          response_base_(n) {}

    Index size() const { return slides_.size(); }
    bool coupled() const { return equations_.matrix.coupled(); }
    /// Sets the interpolation to the centres; slip is turned to its values from now on. Null, as after construction:
    /// slip is not turned. Keeps the pointer.
    void turn_slip(const CentreValues<double>* centres) { turn_.turn_to(centres); }
    /// Says whether respond() will be called; if not, no tangent exists.
    void want_tangents(bool wanted) { wants_tangents_ = wanted; }

    /// A block of M, to be filled before the first solve and whenever it changes: slip in direction `slip` (0
    /// longitudinal, 1 lateral) due to tractions in direction `by`.
    auto new_matrix(std::size_t slip = 0, std::size_t by = 0) { return equations_.matrix.renew(slip, by); }
    /// Says whether M serves one solution only, rather than several with different c.
    void use_once(bool once) { equations_.matrix.serve_once(once); }
    /// The constants c, to be filled before begin(); for the second solution only if it has a start of its own.
    Vectors& constant(std::size_t which = 0) { return constant_[which]; }
    /// Number of solutions that have constants of their own.
    std::size_t constant_count() const { return has_two_ ? 2 : 1; }

    const Vectors& traction() const { return points_[last()].traction; }
    /// Tractions of the solution whose slip is not turned; its slip determines the angles of turned slip.
    const Vectors& plain_traction() const { return points_[0].traction; }
    /// Tractions of each solution that has constants of its own.
    const Vectors& traction(std::size_t which) const { return has_two_ && which == 0 ? plain_traction() : traction(); }
    /// The slip s, exactly zero where elements stick. Where an element slides, s opposes the traction or, if slip is
    /// turned, R s does; s_i is in both cases the slip at the point of row i.
    const Vectors& slip() const { return points_[last()].slip; }
    const std::vector<Zone>& zones() const { return zones_; }
    Index stick_count() const { return stick_count_; }
    /// 1 for each element that slides (slips under pressure), 0 for others.
    const Vector& slides() const { return slides_; }
    /// Unit vector against the slip of each sliding element: along its traction, turned back if slip is turned; 0 for
    /// others.
    const Vectors& against_slip() const { return against_slip_; }
    /// |s| of an element.
    double slip_size(Index i) const { return length(Row(slip().row(i))); }

    /// Begins to solve for the present c. `start` holds tractions and zones of a solution for other c and bounds.
    void begin(const Start& start) noexcept {
        has_two_ = directions == 2 && start.turned_traction != nullptr;
        has_turned_ = false;
        for (std::size_t k = 0; k < directions; ++k) {
            equations_.base[k].forget();
            imposed_[k] = largest(constant_[own(k)]);
        }
        if (has_two_) difference_ = *start.turned_traction - start.traction;
        Point& point = points_[0];
        for (Index i = 0; i < size(); ++i) {
            const int zone = static_cast<signed char>(start.zones[static_cast<std::size_t>(i)]);
            Row along = directions == 1 ? Row(Row::Constant(static_cast<double>(-zone))) : Row(start.traction.row(i));
            if (!(length(along) > 0)) along = -constant_[0].row(i);
            zone == 0 ? point.roles.stick(i) : point.roles.slide(i, along);
        }
    }
    /// Solves for finite bounds >= 0. The search begins at the start or at the last solution for other bounds since
    /// begin().
    Outcome solve(const Vector& bound) noexcept {
        search_.steps = search_.path_points = 0;
        is_apart_ = false;
        turn_.stop();
        adapt(bound, points_[0]);
        const Problem first = problem(0, bound);
        bool settled = search_.find(first, points_[0]);
        if (settled && first.leads_on(points_[0])) settled = solve_turned(bound);
        Outcome outcome{search_.steps, search_.path_points};
        outcome.residual = publish(bound);
        outcome.tangent_exists = settled && wants_tangents_ && factorise(bound);
        const bool solved = is_finite(outcome.residual) && outcome.residual <= 10000 * Search::rounding(size());
        outcome.status = solved ? Status::ok : Status::no_solution;
        return outcome;
    }
    Outcome solve(const Vector& bound, const Start& start) noexcept {
        begin(start);
        return solve(bound);
    }

    /// Finds dp due to a change while no element changes between stick and slip and, unless null, the change of |s|.
    /// Tractions of sliding elements follow their bounds. If angles follow (angles_follow()), the angles of turned slip
    /// change with the first solution. To be called only if a tangent exists according to the last outcome.
    void respond(const Change& change, Vector* size_change = nullptr) {
        const Vectors *plain = change.constant[0], *turned = change.constant[own(directions - 1)];
        response_base_.forget();
        if (keeps_plain()) {
            answer(0, {plain, change.bound}, response_[0]);
            turn_.follow(slip_response_, angle_change_);
            if (plain != turned && (plain == nullptr || turned == nullptr || !same_bits(*plain, *turned))) {
                response_base_.forget();
            }
        }
        answer(last(), {turned, change.bound, turn_.follows() ? &angle_change_ : nullptr}, response_.back());
        if (size_change != nullptr) *size_change = -slip_response_.cwiseProduct(against_slip_).rowwise().sum();
    }
    /// dp of the last solution; dp of each solution that has constants of its own.
    const Vectors& response() const { return response_.back(); }
    const Vectors& response(std::size_t which) const { return has_two_ ? response_[which] : response(); }
    bool angles_follow() const { return turn_.follows(); }

    /// The elements that slide, in ascending order.
    Index slipping_count() const { return equations_.condensed[at_].sliding(); }
    Index slipping(Index k) const { return equations_.condensed[at_].other(k); }
    /// Finds the derivatives of slip by bounds: entry (k, l) of `coupling` becomes the slip of the k-th sliding
    /// element, against its present slip, due to a unit increase of the bound of the l-th. `exact` includes the change
    /// of the angles of turned slip. `across` and `aside` are scratch matrices of n x n.
    void couple(bool exact, Matrix& coupling, Matrix& across, Matrix& aside);
    /// A number that changes whenever the result of couple() may change.
    std::uint64_t revision() const { return revision_; }
    /// A number that changes whenever M or the roles change. With one direction and given bounds, respond() depends on
    /// nothing else.
    std::uint64_t roles_revision() const { return equations_.condensed[at_].revision(); }

private:
    using Row = ElementVector<directions>;
    using Equations = SlipEquations<directions>;
    using Condensed = typename Equations::Condensed;
    using Problem = SlipProblem<directions>;
    using Point = SlipPoint<directions>;
    using Search = SlipSearch<directions>;

    static constexpr int most_halvings = 3;

    std::size_t last() const { return is_apart_ ? 1 : 0; }
    bool keeps_plain() const { return is_apart_ || turn_.follows(); }
    // Index of a solution's constants: 0 if all solutions have the same.
    std::size_t own(std::size_t which) const { return has_two_ ? which : 0; }
    const SlipTurn<directions>& turn_of(std::size_t which) const { return which == 0 ? unturned_ : turn_; }

    Problem problem(std::size_t which, const Vector& bound) {
        return {equations_,
                which,
                equations_.base[own(which)],
                constant_[own(which)],
                bound,
                turn_of(which),
                equations_.matrix.reach(),
                imposed_[own(which)],
                which == 0 ? &turn_ : nullptr,
                has_two_};
    }
    static double largest(const Vectors& vectors) {
        if constexpr (directions == 1) return vectors.cwiseAbs().maxCoeff();
        double result = 0;
        for (Index i = 0; i < vectors.rows(); ++i) result = (std::max)(result, length(Row(vectors.row(i))));
        return result;
    }

    // Adapts the roles of a point to other bounds.
    static void adapt(const Vector& bound, Point& point) {
        for (Index i = 0; i < bound.size(); ++i) {
            if (bound[i] == 0) {
                point.roles.release(i);
            } else if (point.roles[i] == Role::is_free) {
                point.roles.slide(i, -point.slip.row(i));
            }
        }
    }

    // The second solution starts from the first, shifted by the difference of their starts.
    void start_turned(const Vector& bound) {
        Point& point = points_.back();
        point.roles = points_[0].roles;
        point.slip = points_[0].slip;
        for (Index i = 0; has_two_ && i < size(); ++i) {
            if (point.roles[i] != Role::slides) continue;
            point.roles.follow(i, bound[i] * point.roles.direction.row(i) + difference_.row(i));
        }
    }
    bool solve_turned(const Vector& bound) {
        if (has_turned_) {
            adapt(bound, points_.back());
        } else {
            start_turned(bound);
        }
        has_turned_ = is_apart_ = true;
        bool settled = search_.find(problem(1, bound), points_.back());
        for (int k = 0; k < most_halvings && !settled && turn_.turns(); ++k) {
            turn_.halve();
            start_turned(bound);
            settled = search_.find(problem(1, bound), points_.back());
        }
        return settled;
    }

    double publish(const Vector& bound);
    // Factorises the equations that tangents need, for each solution. False if they are singular to working precision.
    bool factorise(const Vector& bound) {
        bool is_regular = true;
        for (std::size_t which = keeps_plain() ? 0 : last(); which <= last(); ++which) {
            const Point& point = points_[which];
            Condensed* at = equations_.condense(which, point.roles);
            if (at == nullptr || !at->is_regular()) return false;
            at_ = static_cast<std::size_t>(at - equations_.condensed.data());
            if constexpr (directions == 2) {
                Sliding& sliding = equations_.sliding[which];
                sliding.aim(*at, point.roles.direction, point.slip, bound, turn_of(which));
                is_regular = is_regular && sliding.factorise(equations_.matrix, *at);
            }
        }
        if (roles_revision_ != roles_revision()) ++revision_;
        roles_revision_ = roles_revision();
        return is_regular;
    }

    // The cause of a response of one solution: dc, the changes of the bounds and of the angles, each null if there is
    // none. `of_slip_alone`: the tractions of sticking elements are not wanted.
    struct Cause {
        const Vectors* constant;
        const Vector* bound;
        const Vector* angle = nullptr;
        bool of_slip_alone = false;
    };
    void answer(std::size_t which, const Cause& cause, Vectors& dp);
    // Adds the effect of the changing angles to the derivatives of the slip across the traction by each bound.
    void add_angles(Matrix& aside) {
        unit_.setZero();
        slip_response_.setZero();
        response_base_.forget();
        for (Index l = 0; l < slipping_count(); ++l) {
            unit_[slipping(l)] = 1;
            answer(0, {nullptr, &unit_, nullptr, true}, response_[0]);
            unit_[slipping(l)] = 0;
            turn_.follow(slip_response_, angle_change_);
            for (Index k = 0; k < slipping_count(); ++k) {
                aside(k, l) -= slip_size(slipping(k)) * angle_change_[slipping(k)];
            }
        }
    }

    Equations equations_;
    Search search_;
    std::vector<Point> points_;  // solution without turned slip; with turned slip
    SlipTurn<directions> turn_, unturned_{0};
    std::vector<Zone> zones_;
    Vector slides_;
    std::vector<Vectors> constant_, response_;
    Vectors difference_;  // starting tractions of the second solution minus starting tractions of the first
    Vectors slip_response_, against_slip_;
    Vector angle_change_, right_, unit_;
    typename Condensed::Base response_base_;
    std::size_t at_ = 0;                        // index of the condensed equations of the last solution
    std::array<double, directions> imposed_{};  // max |c| of each solution
    std::uint64_t revision_ = 0, roles_revision_ = 0;
    Index stick_count_ = 0;
    bool has_two_ = false;     // both solutions have constants of their own
    bool is_apart_ = false;    // the last solution is the second one
    bool has_turned_ = false;  // there has been a second solution since begin()
    bool wants_tangents_ = true;
};

// Sets the zones, clears slip of round-off and returns the largest violation of the conditions.
template <int directions>
auto StickSlip<directions>::publish(const Vector& bound) -> double {
    Point& point = points_[last()];
    const SlipTurn<directions>& turn = turn_of(last());
    double slip = search_.error(), excess = 0;
    bool is_same = directions == 1;
    const bool finite = is_finite(slip) && all_finite(point.traction) && all_finite(point.slip);
    Index stick_count = 0;
    for (Index i = 0; i < size(); ++i) {
        const Row p = point.traction.row(i), s = turn.turned(i, Row(point.slip.row(i)));
        const double norm = length(p);
        const Role role = point.roles[i];
        excess = (std::max)(excess, norm - bound[i]);
        against_slip_.row(i).setZero();
        slides_[i] = role == Role::slides ? 1.0 : 0.0;
        Zone zone = role == Role::sticks ? Zone::stick : Zone::slip;
        if (role == Role::sticks) {
            ++stick_count;
            slip = (std::max)(slip, length(s));
            point.slip.row(i).setZero();
        } else if (role == Role::slides) {
            const Row along = point.roles.direction.row(i);
            const double forward = along.dot(s);
            excess = (std::max)(excess, bound[i] - norm);
            slip = (std::max)({slip, std::abs(cross<directions>(along, s)), forward});
            against_slip_.row(i) = turn.turned_back(i, along);
            point.slip.row(i) = (std::min)(forward, 0.0) * against_slip_.row(i);
        }
        if (directions == 1 && zone == Zone::slip && (role == Role::slides ? p[0] > 0 : s[0] < 0)) {
            zone = Zone::slip_negative;
        }
        Zone& published = zones_[static_cast<std::size_t>(i)];
        is_same = is_same && published == zone;
        published = zone;
    }
    stick_count_ = stick_count;
    if (!is_same) ++revision_;
    if (!finite) return std::numeric_limits<double>::quiet_NaN();
    const double most = bound.maxCoeff(), imposed = imposed_[own(last())];
    return (std::max)(imposed > 0 ? slip / imposed : slip, most > 0 ? excess / most : excess);
}

// Finds dp, and the response of the slip in slip_response_.
template <int directions>
void StickSlip<directions>::answer(std::size_t which, const Cause& cause, Vectors& dp) {
    const Point& point = points_[which];
    Condensed& at = *equations_.condense(which, point.roles);
    at.find_base(equations_.matrix, cause.constant, response_base_);
    for (Index k = 0; k < at.others(); ++k) {
        const Index i = at.other(k);
        dp.row(i) = (cause.bound == nullptr ? 0.0 : (*cause.bound)[i]) * point.roles.direction.row(i);
    }
    if constexpr (directions == 2) {
        if (at.sliding() > 0) {
            at.find_slip(equations_.matrix, response_base_, dp, slip_response_);
            for (Index l = 0; cause.angle != nullptr && l < at.sliding(); ++l) {
                const Index i = at.other(l);
                slip_response_.row(i) += (*cause.angle)[i] * Row(-point.slip(i, 1), point.slip(i, 0));
            }
            equations_.sliding[which].turn(at, slip_response_, dp);
        }
        if (cause.of_slip_alone) return at.find_slip(equations_.matrix, response_base_, dp, slip_response_);
    }
    at.complete(equations_.matrix, response_base_, dp, slip_response_);
}

template <int directions>
void StickSlip<directions>::couple(bool exact, Matrix& coupling, Matrix& across, Matrix& aside) {
    const Index count = slipping_count();
    Condensed& at = equations_.condensed[at_];
    auto result = coupling.topLeftCorner(count, count);
    if constexpr (directions == 1) {
        for (Index k = 0; k < count; ++k) right_[k] = points_[0].roles.direction(slipping(k), 0);
        at.form(equations_.matrix, right_, right_, result);
    } else {
        Sliding& sliding = equations_.sliding[last()];
        auto by_turn = across.topLeftCorner(count, count), turn = aside.topLeftCorner(count, count);
        at.form(equations_.matrix, sliding.against(), sliding.along(), result);
        at.form(equations_.matrix, sliding.against(), sliding.across(), by_turn);
        at.form(equations_.matrix, sliding.aside(), sliding.along(), turn);
        if (exact && turn_.follows()) add_angles(aside);
        sliding.solve_columns(turn);
        for (Index k = 0; k < count; ++k) result.col(k).noalias() -= by_turn * turn.col(k);
    }
}

}  // namespace rollbem::detail
