// Stick and slip in one direction or two: tractions p and slip s = A p + c of the elements, with |p_i| <= b_i, s_i = 0
// where |p_i| < b_i, and slip that opposes p_i where |p_i| = b_i. Independent of rolling and units.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../detail/finite.hpp"
#include "../../scene/detail/directions.hpp"
#include "../../status.hpp"
#include "../../system/detail/centre_values.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "condensed_slip.hpp"
#include "homotopy.hpp"
#include "nested_stick.hpp"
#include "roles.hpp"
#include "slip_matrix.hpp"
#include "slip_rotation.hpp"

namespace rollbem::detail {

/// Vectors of the unrotated and of the rotated pass; with one direction there is only the first.
template <int directions>
using PerPass = std::array<Vectors<directions>, std::size_t(directions)>;

/// The problem of one stage, except for A, which the solver holds.
template <int directions>
struct StageProblem {
    explicit StageProblem(Index n) : bound(VectorX<double>::Zero(n)) {
        constant.fill(Vectors<directions>::Zero(n, directions));
    }

    /// To be called when the constants have changed.
    void measure(std::size_t history) { imposed[history] = largest_length<directions>(constant[history]); }

    PerPass<directions> constant;                           ///< c of the unrotated and of the rotated pass
    std::array<double, std::size_t(directions)> imposed{};  ///< max |c_i|, by measure()
    VectorX<double> bound;                                  ///< b, finite and not negative
    std::uint64_t bounds = 1;                               ///< to be raised by whoever changes b
    bool two_histories = false;                             ///< else both passes have the c of the first
};

/// Tractions and slip, and the roles of the elements in them.
template <int directions>
struct Pass {
    explicit Pass(Index n) : roles(n), traction(Vectors<directions>::Zero(n, directions)), slip(traction) {}

    Roles<directions> roles;
    Vectors<directions> traction, slip;
};

/// The solution of a StageProblem. The second pass, if there is one, has rotated slip (SlipRotation). `residual` is the
/// largest violation of the conditions: of tractions, over the largest bound, and of slip, over the largest |c|, with
/// the error of s = A p + c, which is an estimate in two directions.
template <int directions>
struct StageSolution {
    explicit StageSolution(Index n)
        : pass(directions, Pass<directions>(n)),
          rotation(n),
          against_slip(Vectors<directions>::Zero(n, directions)),
          slides(VectorX<double>::Zero(n)),
          zones(static_cast<std::size_t>(n), Zone::stick) {}

    const Vectors<directions>& traction() const { return pass[last].traction; }
    /// s, exactly zero where elements stick. Where they slide, R s opposes the traction.
    const Vectors<directions>& slip() const { return pass[last].slip; }
    double slip_size(Index i) const { return length(ElementVector<directions>(slip().row(i))); }

    std::vector<Pass<directions>> pass;
    std::size_t last = 0;      ///< index of the last pass
    bool has_rotated = false;  ///< there has been a second pass since StickSlipSolver::start()
    SlipRotation<directions> rotation;
    Vectors<directions> against_slip;  ///< unit vector against the slip of each sliding element; 0 for others
    VectorX<double> slides;            ///< 1 for each sliding element, 0 for others
    std::vector<Zone> zones;
    Index stick_count = 0;
    std::uint64_t revision = 0;  ///< changes whenever the result of find_slip_by_bounds() may change
    int rounds = 0;              ///< Newton steps
    int path_points = 0;         ///< points of the Homotopy; 0 if Newton's method sufficed
    double residual = 0;
    bool has_tangent = false;  ///< whether the solver can respond()
    std::uint64_t bounds = 0;  ///< of the problem solved
    bool at_once = false;      ///< the first Newton step has led to it, with one direction and given bounds
    bool repeats = false;      ///< the next search has its zones and bounds
    Status status = Status::not_finite;
};

/// A change of a problem; null means none.
template <int directions>
struct ProblemChange {
    std::array<const Vectors<directions>*, std::size_t(directions)> constant{};
    const VectorX<double>* bound = nullptr;
};

template <int directions>
class StickSlipSolver;

/// A problem with its solver and its solution: references to values of the caller, made on the stack for one call.
/// `centres` null: slip is not rotated.
template <int directions>
struct StageView {
    StageProblem<directions>& problem;
    const CentreValues<double>* centres;
    StickSlipSolver<directions>& solver;
    StageSolution<directions>& solution;
};

/// Solves a StageProblem. A solution exists for every A (a continuous variational inequality on a compact set: Hartman
/// and Stampacchia 1966). Newton's method on the natural map p_i = P(p_i - rho_i R_i s_i), P the projection onto the
/// ball of the bound, looks for it (semismooth: Qi and Sun 1993; for friction Alart and Curnier 1991; with one
/// direction a primal-dual active set). An element with |p - rho R s| within its bound sticks in the next step, without
/// any slip; any other keeps its traction at the bound and turns it. A step is halved while the residual of the map
/// would grow. If Newton's method gets stuck, it starts once more from full sliding, then from points of a Homotopy. If
/// that fails, too, the result is the best point found.
///
/// Where centres are given, a second pass with rotated slip follows, which starts from the first. Sticking still means
/// s_i = 0. If the second pass finds no solution, all angles are halved.
///
/// The solver keeps A, factors and scratch memory, allocated by the constructor, and no data of others. Results depend
/// on the arguments alone, to the last bit.
template <int directions>
class StickSlipSolver {
public:
    using Row = ElementVector<directions>;
    using Problem = StageProblem<directions>;
    using Solution = StageSolution<directions>;
    using Centres = CentreValues<double>;

    explicit StickSlipSolver(Index n, bool coupled = false)
        : matrix(n, coupled),
          eliminated_(directions, Eliminated(matrix)),
          base_(directions, typename Eliminated::Base(n)),
          sliding_(directions, SlipDirectionSystem(directions == 1 ? 0 : n)),
          response_base_(n),
          homotopy_(n) {
        for (Vectors<directions>* vectors : {&trial_, &trial_slip_, &change_, &slip_change_, &best_, &refined_,
                                             &difference_, &slip_response_, &unit_response_}) {
            vectors->setZero(n, directions);
        }
        angle_change_.setZero(n);
        unit_.setZero(n);
    }

    SlipMatrix<directions> matrix;  ///< A, to be filled before the first solution and whenever it changes

    /// Takes the roles from which the first pass starts from the tractions and zones of a solution of another problem;
    /// with one direction only the zones are read.
    void start(const Problem& problem, const PerPass<directions>& traction, const std::vector<Zone>& zones,
               Solution& solution) {
        for (auto& base : base_) base.forget();
        solution.has_rotated = false;
        solution.repeats = solution.at_once && problem.bounds == solution.bounds && same_bits(zones, solution.zones);
        if (solution.repeats) return;
        if (problem.two_histories) difference_ = traction.back() - traction[0];
        Roles<directions>& roles = solution.pass[0].roles;
        for (Index i = 0; i < size(); ++i) {
            const int zone = static_cast<signed char>(zones[static_cast<std::size_t>(i)]);
            Row along = directions == 1 ? Row(Row::Constant(static_cast<double>(-zone))) : Row(traction[0].row(i));
            if (!(length(along) > 0)) along = -problem.constant[0].row(i);
            zone == 0 ? roles.stick(i) : roles.slide(i, along);
        }
    }

    /// Solves from the roles in `solution`, those of start() or of the last solution for other bounds since then. Slip
    /// is rotated to its direction at the centres, unless these are null.
    void solve(const Problem& problem, const Centres* centres, bool with_tangent, Solution& solution) noexcept {
        solution.rounds = solution.path_points = 0;
        solution.last = 0;
        solution.rotation.stop();
        const bool repeats = std::exchange(solution.repeats, false);
        solution.at_once = false;
        if (!repeats) adapt(problem.bound, solution.pass[0]);
        solution.bounds = problem.bounds;
        const ProblemView<directions> unrotated = view(problem, 0, unrotated_);
        const Search first{unrotated, 0, centres != nullptr, solution, repeats};
        bool found = find(first, first_share);
        if (centres != nullptr && found) {
            bool rotates = set_rotation(*centres, problem, solution);
            if (!rotates && is_rough_) {
                update_roles(first, 1);
                found = find({unrotated, 0, false, solution}, 1);
                rotates = found && set_rotation(*centres, problem, solution);
            }
            if (rotates) found = solve_rotated(problem, solution);
        }
        if (repeats && solution.at_once) {
            check_again(unrotated, solution);
        } else {
            check(problem, solution);
        }
        solution.has_tangent = found && with_tangent && factorise(problem, solution);
        const bool solved = is_finite(solution.residual) && solution.residual <= 10000 * rounding(size());
        solution.status = solved ? Status::ok : Status::no_solution;
    }

    /// Finds dp of each pass due to a change while no element changes between stick and slip and, unless null, the
    /// change of |s|. The angles of rotated slip change with the first pass. To be called only if solution.has_tangent.
    void respond(const Problem& problem, const Solution& solution, const ProblemChange<directions>& change,
                 const Centres* centres, PerPass<directions>& dp, VectorX<double>* size_change = nullptr) {
        const auto *first = change.constant[0], *last = change.constant[problem.two_histories ? directions - 1 : 0];
        const VectorX<double>* angles = nullptr;
        response_base_.forget();
        if (solution.last == 1 || solution.rotation.follows()) {
            respond(solution, 0, {first, change.bound}, dp[0]);
            if (solution.rotation.follows()) {
                solution.rotation.find_angle_change(*centres, slip_response_, angle_change_);
                angles = &angle_change_;
            }
            if (first != last && (first == nullptr || last == nullptr || !same_bits(*first, *last))) {
                response_base_.forget();
            }
        }
        respond(solution, solution.last, {last, change.bound, angles}, dp.back());
        if (size_change != nullptr) {
            *size_change = -slip_response_.cwiseProduct(solution.against_slip).rowwise().sum();
        }
    }

    /// The elements that slide, in ascending order, if there is a tangent.
    Index sliding_count() const { return eliminated_[at_].sliding(); }
    Index sliding(Index k) const { return eliminated_[at_].other(k); }
    /// Entry (k, l) of `result` becomes the slip of the k-th sliding element, against its slip, due to a unit increase
    /// of the bound of the l-th; `across` and `aside` are scratch of n x n. `exact` includes the change of the angles.
    void find_slip_by_bounds(const Solution& solution, const Centres* centres, bool exact, MatrixX<double>& result,
                             MatrixX<double>& across, MatrixX<double>& aside) {
        const Index count = sliding_count();
        Eliminated& at = eliminated_[at_];
        auto derivatives = result.topLeftCorner(count, count);
        if constexpr (directions == 1) {
            for (Index k = 0; k < count; ++k) unit_[k] = solution.pass[0].roles.direction(sliding(k), 0);
            at.form(matrix, unit_, unit_, derivatives);
        } else {
            SlipDirectionSystem& own = sliding_[solution.last];
            auto by_turn = across.topLeftCorner(count, count), turn = aside.topLeftCorner(count, count);
            at.form(matrix, own.against(), own.along(), derivatives);
            at.form(matrix, own.against(), own.across(), by_turn);
            at.form(matrix, own.aside(), own.along(), turn);
            if (exact && solution.rotation.follows()) add_angle_changes(solution, *centres, aside);
            own.solve_columns(turn);
            for (Index k = 0; k < count; ++k) derivatives.col(k).noalias() -= by_turn * turn.col(k);
        }
    }

    /// A number that changes whenever A or the roles of the last solution change. With one direction and given bounds,
    /// respond() depends on nothing else.
    std::uint64_t roles_revision() const { return eliminated_[at_].revision(); }

private:
    using Eliminated = ByDirections<directions, NestedStick, CondensedSlip>;

    // One search, for the solution of one pass. `roughly`: a point near a solution is enough. `repeats`: roles and
    // bounds are those of the last solution, found at once.
    struct Search {
        const ProblemView<directions>& problem;
        std::size_t number;
        bool roughly;
        Solution& solution;
        bool repeats = false;

        Pass<directions>& pass() const { return solution.pass[number]; }
    };
    // dc and the changes of bounds and angles; null: none. `of_slip_alone`: tractions of stick are not wanted.
    struct Cause {
        const Vectors<directions>* constant;
        const VectorX<double>* bound;
        const VectorX<double>* angle = nullptr;
        bool of_slip_alone = false;
    };

    static constexpr double epsilon = std::numeric_limits<double>::epsilon();
    static constexpr double huge = (std::numeric_limits<double>::max)();
    static constexpr int most_steps = 60, most_from_path = 20;  // Newton steps of a search
    static constexpr int most_paths = 3, most_refinements = 3, most_halvings = 3;
    // Share of its bound from which an element slides after full adhesion, which underestimates the zone of slip.
    static constexpr double first_share = 0.7;
    // Residual over the sum of bounds below which another step would not change the angles of rotated slip.
    inline static const double rough = std::cbrt(epsilon) * std::cbrt(epsilon);

    Index size() const { return matrix.size(); }
    static double rounding(Index n) { return static_cast<double>(n + 10) * epsilon; }
    ProblemView<directions> view(const Problem& problem, std::size_t pass, const SlipRotation<directions>& rotation) {
        const std::size_t history = problem.two_histories ? pass : 0;
        return {matrix,   problem.constant[history], problem.bound,
                rotation, matrix.projection_step(),  problem.imposed[history],
                history};
    }
    // An elimination is kept for each pass; both usually have the same roles and share one. Null: singular.
    Eliminated* eliminate(std::size_t pass, const Roles<directions>& roles) {
        Eliminated *at = &eliminated_[pass], *const other = &eliminated_[directions - 1 - pass];
        if (!at->are_of(matrix, roles.of) && other->are_of(matrix, roles.of)) {
            if (pass == 0) std::swap(*at, *other);  // the other one would be overwritten
            if (pass == 1) at = other;
        }
        return at->condense(matrix, roles.of) ? at : nullptr;
    }

    // Adapts the roles of a pass to other bounds.
    static void adapt(const VectorX<double>& bound, Pass<directions>& pass) {
        for (Index i = 0; i < bound.size(); ++i) {
            if (bound[i] == 0) {
                pass.roles.release(i);
            } else if (pass.roles[i] == Role::is_free) {
                pass.roles.slide(i, -pass.slip.row(i));
            }
        }
    }
    // Finds the angles from the first pass; whether there is a second.
    static bool set_rotation(const Centres& centres, const Problem& problem, Solution& solution) {
        const Pass<directions>& first = solution.pass[0];
        return solution.rotation.find(centres, first.slip, first.roles) || problem.two_histories;
    }
    bool solve_rotated(const Problem& problem, Solution& solution) {
        Pass<directions>& pass = solution.pass.back();
        solution.last = 1;
        for (int halvings = 0;; ++halvings) {
            if (halvings == 0 && solution.has_rotated) {
                adapt(problem.bound, pass);
            } else {
                start_rotated(problem, solution);
            }
            solution.has_rotated = true;
            if (find({view(problem, 1, solution.rotation), 1, false, solution}, first_share)) return true;
            if (halvings == most_halvings || !solution.rotation.turns()) return false;
            solution.rotation.halve();
        }
    }
    // The second pass starts from the first, shifted by the difference of their starts.
    void start_rotated(const Problem& problem, Solution& solution) {
        Pass<directions>& pass = solution.pass.back();
        pass.roles = solution.pass[0].roles;
        pass.slip = solution.pass[0].slip;
        for (Index i = 0; problem.two_histories && i < size(); ++i) {
            if (pass.roles[i] != Role::slides) continue;
            pass.roles.align(i, problem.bound[i] * pass.roles.direction.row(i) + difference_.row(i));
        }
    }

    // Searches from the roles of a pass. False if there is no solution: the pass then is the best point found. See
    // newton() for `share`.
    bool find(Search search, double share) {
        const auto& problem = search.problem;
        Roles<directions>& roles = search.pass().roles;
        least_ = huge;
        bool found = newton(search, most_steps, share);
        search.solution.at_once = found && fits_at_once_;
        search.repeats = false;  // other starts may have the same roles in other directions
        if (!found) {
            for (Index i = 0; i < size(); ++i) {
                const Row against = -problem.rotation.turned(i, Row(problem.constant.row(i)));
                problem.bound[i] == 0 ? roles.release(i) : roles.slide(i, against);
            }
            found = newton(search, most_steps, 1);
        }
        for (int number = 0; number < most_paths && !found; ++number) found = follow_path(search, number);
        if (!found) return_to_best(search);
        for (Index i = 0; directions == 2 && i < size(); ++i) {
            if (roles[i] == Role::slides) roles.align(i, search.pass().traction.row(i));
        }
        return found;
    }
    bool follow_path(const Search& search, int number) {
        homotopy_.begin(search.problem, number);
        int before = 0;
        while (homotopy_.advance(search.problem)) {
            search.solution.path_points += homotopy_.points() - before;
            before = homotopy_.points();
            search.pass().traction = homotopy_.traction();
            find_slip(search);
            update_roles(search, 1);
            if (newton(search, most_from_path, 1)) return true;
        }
        return false;
    }
    // `share` of its bound is that from which an element slides after a first step, if all have stuck before it.
    bool newton(const Search& search, int steps, double share) {
        refinements_ = 0;
        const bool found = iterate(search, steps, share);
        if (refinements_ > 0) base_[search.problem.history].forget();
        return found;
    }
    bool iterate(const Search& search, int steps, double share) {
        const auto& problem = search.problem;
        Pass<directions>& pass = search.pass();
        auto& base = base_[problem.history];
        double before = huge;
        is_rough_ = fits_at_once_ = false;
        for (int step = 0; step < steps; ++step) {
            Eliminated* at = eliminate(search.number, pass.roles);
            if (at == nullptr) return false;
            at->find_base(matrix, refinements_ > 0 ? &refined_ : &problem.constant, base);
            ++search.solution.rounds;
            if constexpr (directions == 1) {
                if (step == 0 && search.repeats && at->keeps()) {
                    at->complete_again(matrix, base, trial_, trial_slip_);
                } else {
                    take_step(search, *at);
                    at->keep();
                }
                if (step == 0 && refinements_ == 0 && fits_at_once(search, *at)) {
                    pass.traction.swap(trial_);
                    pass.slip.swap(trial_slip_);
                    return fits_at_once_ = true;
                }
            } else if (!take_step(search, *at)) {
                return false;
            }
            double residual = natural_residual(search);
            const bool stalls = !(residual < before), done = holds(stalls ? 1000 : 1);
            if (!done && stalls) residual = shorten(search, before);
            if (!is_finite(residual)) return false;
            pass.traction = trial_;
            pass.slip = trial_slip_;
            if (residual < least_) {
                least_ = residual;
                best_ = pass.traction;
            }
            if (done) {
                if (verify(search)) return true;
                if (!refine(search)) return false;
                before = huge;
                continue;
            }
            if (search.roughly && residual < rough * problem.bound.sum()) return is_rough_ = true;
            update_roles(search, step == 0 && !pass.roles.any_slides() ? share : 1.0);
            before = residual;
        }
        return false;
    }
    // Takes the full Newton step into trial_; tractions that slide turn on their bounds. False if there is no step.
    bool take_step(const Search& search, Eliminated& at) {
        const auto& problem = search.problem;
        const Roles<directions>& roles = search.pass().roles;
        auto& base = base_[problem.history];
        for (Index k = 0; k < at.others(); ++k) {
            const Index i = at.other(k);
            trial_.row(i) = problem.bound[i] * roles.direction.row(i);
        }
        if constexpr (directions == 2) {
            if (at.sliding() > 0) {
                SlipDirectionSystem& sliding = sliding_[search.number];
                at.find_slip(matrix, base, trial_, trial_slip_);
                sliding.aim(at, roles.direction, trial_slip_, problem.bound, problem.rotation);
                if (!sliding.factorise(matrix, at)) return false;
                sliding.turn(at, trial_slip_, trial_);
                for (Index l = 0; l < at.sliding(); ++l) {
                    const Index i = at.other(l);
                    trial_.row(i) *= problem.bound[i] / length(Row(trial_.row(i)));
                }
            }
        }
        at.complete(matrix, base, trial_, trial_slip_);
        return true;
    }
    // Whether the trial of a first step, in which all that stick do so together, is a solution to round-off; if so,
    // clears the slip of sticking elements.
    bool fits_at_once(const Search& search, const Eliminated& at) {
        const auto& problem = search.problem;
        double error = 0, most = 0, creep = 0, sum = 0;
        if (!at.stick_together()) return false;
        if (at.sticking() > 0) {
            // a traction that is NaN makes all slip NaN
            if (!((at.stuck(problem.bound) - at.stuck(trial_).cwiseAbs()).minCoeff() >= 0)) return false;
            error = at.stuck(trial_slip_).cwiseAbs().maxCoeff();
        }
        for (Index k = 0; k < at.others(); ++k) {
            const Index i = at.other(k);
            const double slip = trial_slip_(i, 0);
            most = (std::max)(most, std::abs(slip - problem.constant(i, 0)));
            creep = (std::max)(creep, search.pass().roles.direction(i, 0) * slip);  // 0 for free ones
            sum += slip;
        }
        const double scale = rounding(size()) * ((std::max)(most, problem.imposed) + problem.imposed);
        if (!is_finite(sum) || !(creep <= 4 * scale) || !(error <= 4 * scale)) return false;
        at.stuck(trial_slip_).setZero();
        error_ = error;
        creep_ = creep;
        slip_scale_ = scale;
        return true;
    }
    // The residual of the natural map at the trial, summed over the elements. Clears the slip of sticking elements,
    // which with one direction is the error.
    double natural_residual(const Search& search) {
        const auto& problem = search.problem;
        double residual = 0, most = 0;  // largest component of A p
        excess_ = creep_ = error_ = 0;
        for (Index i = 0; i < size(); ++i) {
            const Row p = trial_.row(i), slip = trial_slip_.row(i);
            const double bound = problem.bound[i];
            const Role role = search.pass().roles[i];
            if (role == Role::sticks) {
                const double norm = length(p);
                if (!(norm <= bound)) {  // also NaN
                    residual += norm - bound;
                    excess_ = (std::max)(excess_, norm / bound - 1);
                }
                error_ = (std::max)(error_, length(slip));
                trial_slip_.row(i).setZero();
                continue;
            }
            most = (std::max)(most, (slip - problem.constant.row(i)).cwiseAbs().maxCoeff());
            if (role == Role::is_free) continue;
            // the product of tiny tractions and slips would vanish
            const Row rotated = problem.rotation.turned(i, slip), along = p / bound;
            creep_ = (std::max)({creep_, along.dot(rotated), std::abs(cross<directions>(along, rotated))});
            residual += natural_residual(p, rotated, problem.projection_step[i], bound);
        }
        slip_scale_ = rounding(size()) * ((std::max)(most, problem.imposed) + problem.imposed);
        return residual;
    }
    // |p - P(p - rho R s)| of an element.
    static double natural_residual(const Row& p, const Row& rotated_slip, double projection_step, double bound) {
        const Row x = p - projection_step * rotated_slip;
        const double size = length(x);
        return length(Row(p - (size > bound ? bound / size : 1.0) * x));
    }
    // Whether the trial is a solution for the assumed roles, to `factor` times round-off.
    bool holds(double factor) const {
        return excess_ <= 4 * factor * rounding(size()) && creep_ <= 4 * factor * slip_scale_;
    }
    // Halves the step until the residual is below the previous one, or the step is as short as it may get. Tractions
    // and slip are affine in its length.
    double shorten(const Search& search, double before) {
        const auto& problem = search.problem;
        change_ = trial_ - search.pass().traction;
        slip_change_ = trial_slip_ - search.pass().slip;
        double residual = before;
        for (double part = 0.5; part > 1.0 / 300; part /= 2) {
            trial_ = search.pass().traction + part * change_;
            trial_slip_ = search.pass().slip + part * slip_change_;
            residual = 0;
            for (Index i = 0; i < size(); ++i) {
                if (problem.bound[i] == 0) continue;
                const Row rotated = problem.rotation.turned(i, Row(trial_slip_.row(i)));
                residual += natural_residual(trial_.row(i), rotated, problem.projection_step[i], problem.bound[i]);
            }
            if (residual <= (1 - 1e-4 * part) * before) break;
        }
        return residual;
    }
    void find_error(const Search& search) {
        matrix.multiply(search.pass().traction, change_);
        change_ += search.problem.constant - search.pass().slip;
    }
    // Whether s = A p + c holds to round-off; after the last refinement a larger error is accepted.
    bool verify(const Search& search) {
        if (directions == 1 ? refinements_ > 0 : matrix.serves_once) {
            find_error(search);
            error_ = change_.cwiseAbs().maxCoeff();
        } else if (directions == 2) {
            error_ = matrix.error(search.pass().traction, search.problem.constant, search.pass().slip);
        }
        return error_ <= (refinements_ < most_refinements ? 4 : 1000) * slip_scale_;
    }
    // Replaces c by c' = c + (A p + c - s): the next solution repeats the error and thereby cancels it. False after the
    // last allowed refinement.
    bool refine(const Search& search) {
        if (refinements_ == most_refinements || !is_finite(error_)) return false;
        if (refinements_++ == 0) refined_ = search.problem.constant;
        find_error(search);
        refined_ += change_;
        base_[search.problem.history].forget();
        return true;
    }
    // Sets the roles of a pass by the natural map, where an element slides from `share` of its bound on.
    static void update_roles(const Search& search, double share) {
        const auto& problem = search.problem;
        Pass<directions>& pass = search.pass();
        const double factor = share * (1 + 4 * rounding(pass.roles.size()));
        for (Index i = 0; i < pass.roles.size(); ++i) {
            if (problem.bound[i] == 0) {
                pass.roles.release(i);
                continue;
            }
            const Row rotated = problem.rotation.turned(i, Row(pass.slip.row(i)));
            const Row x = pass.traction.row(i) - problem.projection_step[i] * rotated;
            const double norm = length(x), limit = factor * problem.bound[i];
            norm > limit ? pass.roles.slide(i, x, norm) : pass.roles.stick(i);
        }
    }
    static void find_slip(const Search& search) {
        search.problem.matrix.multiply(search.pass().traction, search.pass().slip);
        search.pass().slip += search.problem.constant;
    }
    void return_to_best(const Search& search) {
        const VectorX<double>& bound = search.problem.bound;
        Pass<directions>& pass = search.pass();
        if (least_ < huge) pass.traction = best_;
        find_slip(search);
        update_roles(search, 1);
        for (Index i = 0; i < size(); ++i) {
            const double norm = length(Row(pass.traction.row(i)));
            if (!(norm > bound[i]) && pass.roles[i] != Role::slides) continue;
            pass.traction.row(i) *= norm > 0 ? bound[i] / norm : 0.0;
        }
        find_slip(search);
        error_ = 0;
    }
    // Sets the zones, clears slip of round-off and finds the largest violation of the conditions.
    void check(const Problem& problem, Solution& solution) {
        Pass<directions>& pass = solution.pass[solution.last];
        const auto& rotation = solution.last == 0 ? unrotated_ : solution.rotation;
        const VectorX<double>& bound = problem.bound;
        double slip = error_, excess = 0;
        const bool finite = is_finite(slip) && all_finite(pass.traction) && all_finite(pass.slip);
        bool is_same = directions == 1;
        solution.stick_count = 0;
        for (Index i = 0; i < size(); ++i) {
            const Row p = pass.traction.row(i), s = rotation.turned(i, Row(pass.slip.row(i)));
            const double norm = length(p);
            const Role role = pass.roles[i];
            excess = (std::max)(excess, norm - bound[i]);
            solution.against_slip.row(i).setZero();
            solution.slides[i] = role == Role::slides ? 1.0 : 0.0;
            Zone zone = role == Role::sticks ? Zone::stick : Zone::slip;
            if (role == Role::sticks) {
                ++solution.stick_count;
                slip = (std::max)(slip, length(s));
                pass.slip.row(i).setZero();
            } else if (role == Role::slides) {
                const Row along = pass.roles.direction.row(i);
                const double forward = along.dot(s);
                excess = (std::max)(excess, bound[i] - norm);
                slip = (std::max)({slip, std::abs(cross<directions>(along, s)), forward});
                solution.against_slip.row(i) = rotation.turned_back(i, along);
                pass.slip.row(i) = (std::min)(forward, 0.0) * solution.against_slip.row(i);
            }
            if (directions == 1 && zone == Zone::slip && (role == Role::slides ? p[0] > 0 : s[0] < 0)) {
                zone = Zone::slip_negative;
            }
            Zone& published = solution.zones[static_cast<std::size_t>(i)];
            is_same = is_same && published == zone;
            published = zone;
        }
        if (!is_same) ++solution.revision;
        const double most = bound.maxCoeff();
        const double imposed = problem.imposed[problem.two_histories ? solution.last : 0];
        solution.residual = finite ? (std::max)(imposed > 0 ? slip / imposed : slip, most > 0 ? excess / most : excess)
                                   : std::numeric_limits<double>::quiet_NaN();
    }
    // check() of a solution that is found at once from the zones and bounds of another one so found: only what does not
    // stick can differ, and the derivatives by bounds do not.
    void check_again(const ProblemView<directions>& problem, Solution& solution) {
        Pass<directions>& pass = solution.pass[0];
        const Eliminated& at = eliminated_[0];
        for (Index k = 0; creep_ > 0 && k < at.sliding(); ++k) {
            double& slip = pass.slip(at.other(k), 0);
            const double along = pass.roles.direction(at.other(k), 0);
            slip = (std::min)(along * slip, 0.0) * along;
        }
        for (Index k = at.sliding(); k < at.others(); ++k) {
            const Index i = at.other(k);
            solution.zones[static_cast<std::size_t>(i)] = pass.slip(i, 0) < 0 ? Zone::slip_negative : Zone::slip;
        }
        const double slip = (std::max)(error_, creep_);
        solution.residual = problem.imposed > 0 ? slip / problem.imposed : slip;
    }
    // Factorises the equations of each pass that tangents need. False if they are singular to working precision.
    bool factorise(const Problem& problem, Solution& solution) {
        bool regular = true;
        for (std::size_t k = 0; k <= solution.last; ++k) {
            const Pass<directions>& pass = solution.pass[k];
            Eliminated* at = solution.at_once ? &eliminated_[0] : eliminate(k, pass.roles);
            if (at == nullptr || !at->is_regular()) return false;
            at_ = static_cast<std::size_t>(at - eliminated_.data());
            if constexpr (directions == 2) {
                const auto& rotation = k == 0 ? unrotated_ : solution.rotation;
                sliding_[k].aim(*at, pass.roles.direction, pass.slip, problem.bound, rotation);
                regular = regular && sliding_[k].factorise(matrix, *at);
            }
        }
        if (roles_revision_ != roles_revision()) ++solution.revision;
        roles_revision_ = roles_revision();
        return regular;
    }
    // Finds dp of a pass, and the response of its slip in slip_response_.
    void respond(const Solution& solution, std::size_t number, const Cause& cause, Vectors<directions>& dp) {
        const Pass<directions>& pass = solution.pass[number];
        Eliminated& at = *eliminate(number, pass.roles);
        at.find_base(matrix, cause.constant, response_base_);
        for (Index k = 0; k < at.others(); ++k) {
            const Index i = at.other(k);
            dp.row(i) = (cause.bound == nullptr ? 0.0 : (*cause.bound)[i]) * pass.roles.direction.row(i);
        }
        if constexpr (directions == 2) {
            if (at.sliding() > 0) {
                at.find_slip(matrix, response_base_, dp, slip_response_);
                for (Index l = 0; cause.angle != nullptr && l < at.sliding(); ++l) {
                    const Index i = at.other(l);
                    slip_response_.row(i) += (*cause.angle)[i] * Row(-pass.slip(i, 1), pass.slip(i, 0));
                }
                sliding_[number].turn(at, slip_response_, dp);
            }
            if (cause.of_slip_alone) return at.find_slip(matrix, response_base_, dp, slip_response_);
        }
        at.complete(matrix, response_base_, dp, slip_response_);
    }
    // Adds the effect of the changing angles to the derivatives of the slip across the traction by each bound.
    void add_angle_changes(const Solution& solution, const Centres& centres, MatrixX<double>& aside) {
        unit_.setZero();
        slip_response_.setZero();
        response_base_.forget();
        for (Index l = 0; l < sliding_count(); ++l) {
            unit_[sliding(l)] = 1;
            respond(solution, 0, {nullptr, &unit_, nullptr, true}, unit_response_);
            unit_[sliding(l)] = 0;
            solution.rotation.find_angle_change(centres, slip_response_, angle_change_);
            for (Index k = 0; k < sliding_count(); ++k) {
                aside(k, l) -= solution.slip_size(sliding(k)) * angle_change_[sliding(k)];
            }
        }
    }

    std::vector<Eliminated> eliminated_;
    std::vector<typename Eliminated::Base> base_;  // contributions of c
    std::vector<SlipDirectionSystem> sliding_;     // used with two directions
    typename Eliminated::Base response_base_;
    Vectors<directions> trial_, trial_slip_, change_, slip_change_, best_;
    Vectors<directions> refined_;     // c'
    Vectors<directions> difference_;  // starting tractions of the second pass minus those of the first
    Vectors<directions> slip_response_, unit_response_;
    VectorX<double> angle_change_, unit_;
    SlipRotation<directions> unrotated_{0};
    Homotopy<directions> homotopy_;
    double excess_ = 0;      // largest excess of sticking tractions over their bounds, relative
    double creep_ = 0;       // largest slip along tractions, or across them
    double error_ = 0;       // A p + c - s of the last point; an estimate with two directions
    double slip_scale_ = 0;  // rounding of the slip
    double least_ = 0;       // natural residual at best_
    std::size_t at_ = 0;     // index of the elimination of the last solution
    std::uint64_t roles_revision_ = 0;
    int refinements_ = 0;
    bool is_rough_ = false;  // the last search ended near a solution
    bool fits_at_once_ = false;
};

}  // namespace rollbem::detail
