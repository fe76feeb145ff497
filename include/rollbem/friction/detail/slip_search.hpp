// The search for stick and slip: Newton's method on the natural map, and the fallbacks where it fails.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "roles.hpp"
#include "slip_path.hpp"
#include "slip_problem.hpp"

namespace rollbem::detail {

/// Newton's method on the natural map p_i = P(p_i - rho_i R_i s_i), P the projection onto the ball of the bound
/// (semismooth: Qi and Sun 1993; for friction Alart and Curnier 1991; with one direction a primal-dual active set). An
/// element with |p - rho R s| within its bound sticks in the next step, without any slip; any other keeps its traction
/// at the bound and turns it. A step is halved while the residual of the map would grow.
///
/// If Newton's method gets stuck, it starts once more from full sliding. If it gets stuck again, SlipPath leads to a
/// point near a solution, from which Newton's method finishes. If that fails, too, the result is the best point found.
/// The result depends on the problem and the starting point alone, to the last bit. All memory is allocated by the
/// constructor.
template <int directions>
class SlipSearch {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<double>;
    using Vectors = ElementVectors<directions>;
    using Row = ElementVector<directions>;
    using Problem = SlipProblem<directions>;
    using Point = SlipPoint<directions>;

    explicit SlipSearch(Index n)
        : trial_(Vectors::Zero(n, directions)),
          trial_slip_(trial_),
          change_(trial_),
          slip_change_(trial_),
          best_(trial_),
          refined_(trial_),
          path_(n) {}

    /// Searches from the roles of `point` and the directions of its tractions, and writes the result to `point`. A
    /// point near a solution is enough if another problem follows (SlipProblem::leads_on). False if no solution is
    /// found.
    bool find(const Problem& problem, Point& point) {
        least_ = (std::numeric_limits<double>::max)();
        const bool found = look(problem, point);
        if (!found) return_to_best(problem, point);
        for (Index i = 0; i < point.roles.size(); ++i) {
            if (directions == 2 && point.roles[i] == Role::slides) point.roles.follow(i, point.traction.row(i));
        }
        return found;
    }

    /// Numbers of Newton steps and of points of SlipPath since they were last set to 0.
    int steps = 0, path_points = 0;

    /// The error M p + c - s of the last point found; an estimate with two directions.
    double error() const { return error_; }

    static double rounding(Index n) { return static_cast<double>(n + 10) * epsilon; }

private:
    static constexpr int longest = 60;    // most Newton steps of a search
    static constexpr int from_path = 20;  // most Newton steps from a point of the path
    static constexpr int most_paths = 3, most_refinements = 3;
    static constexpr double epsilon = std::numeric_limits<double>::epsilon();
    // Share of its bound from which an element slides after full adhesion, which underestimates the zone of slip.
    static constexpr double eager = 0.7;

    // Residual over the sum of bounds below which another step would not change the angles of turned slip.
    inline static const double nearly = std::cbrt(epsilon) * std::cbrt(epsilon);

    bool look(const Problem& problem, Point& point) {
        if (settle(problem, longest, true, point)) return true;
        slide_fully(problem, point);
        if (settle(problem, longest, false, point)) return true;
        for (int number = 0; number < most_paths; ++number) {
            if (follow_path(problem, number, point)) return true;
        }
        return false;
    }
    // Takes at most `most_steps` Newton steps. `eagerly` applies the share `eager` in the first step if all elements
    // stick before it.
    bool settle(const Problem& problem, int most_steps, bool eagerly, Point& point) {
        refinements_ = 0;
        const bool settled = iterate(problem, most_steps, eagerly, point);
        if (refinements_ > 0) problem.base.forget();
        return settled;
    }
    bool iterate(const Problem& problem, int most_steps, bool eagerly, Point& point);

    bool follow_path(const Problem& problem, int number, Point& point) {
        path_.begin(problem, number);
        int before = 0;
        while (path_.advance(problem)) {
            path_points += path_.points() - before;
            before = path_.points();
            point.traction = path_.traction();
            find_slip(problem, point);
            place(problem, 1, point);
            if (settle(problem, from_path, false, point)) return true;
        }
        return false;
    }

    // Sets the roles of a point by the natural map, where an element slides from `share` of its bound on.
    static void place(const Problem& problem, double share, Point& point) {
        const double factor = share * (1 + 4 * rounding(point.roles.size()));
        for (Index i = 0; i < point.roles.size(); ++i) {
            const double bound = problem.bound[i];
            if (bound == 0) {
                point.roles.release(i);
                continue;
            }
            const Row slip = point.slip.row(i);
            const Row x = point.traction.row(i) - problem.reach[i] * problem.turn.turned(i, slip);
            const double size = length(x);
            size > factor* bound ? point.roles.slide(i, x, size) : point.roles.stick(i);
        }
    }

    // Finds the slip M p + c.
    static void find_slip(const Problem& problem, Point& point) {
        problem.equations.matrix.multiply(point.traction, point.slip);
        point.slip += problem.constant;
    }

    static void slide_fully(const Problem& problem, Point& point) {
        for (Index i = 0; i < point.roles.size(); ++i) {
            const Row against = -problem.turn.turned(i, Row(problem.constant.row(i)));
            problem.bound[i] == 0 ? point.roles.release(i) : point.roles.slide(i, against);
        }
    }

    void return_to_best(const Problem& problem, Point& point) {
        if (least_ < (std::numeric_limits<double>::max)()) point.traction = best_;
        find_slip(problem, point);
        place(problem, 1, point);
        for (Index i = 0; i < point.roles.size(); ++i) {
            const double size = length(Row(point.traction.row(i)));
            if (!(size > problem.bound[i]) && point.roles[i] != Role::slides) continue;
            point.traction.row(i) *= size > 0 ? problem.bound[i] / size : 0.0;
        }
        find_slip(problem, point);
        error_ = 0;
    }

    // Takes the full Newton step into trial_; tractions that slide return to their bounds. False if the step does not
    // exist.
    template <class Condensed>
    bool take_step(const Problem& problem, Condensed& at, const Point& point) {
        for (Index k = 0; k < at.others(); ++k) {
            const Index i = at.other(k);
            trial_.row(i) = problem.bound[i] * point.roles.direction.row(i);
        }
        if constexpr (directions == 2) {
            if (at.sliding() > 0 && !turn(problem, at, point)) return false;
        }
        at.complete(problem.equations.matrix, problem.base, trial_, trial_slip_);
        return true;
    }
    // Turns the tractions that slide. False if their equations are singular.
    template <class Condensed>
    bool turn(const Problem& problem, Condensed& at, const Point& point) {
        auto& matrix = problem.equations.matrix;
        Sliding& sliding = problem.equations.sliding[problem.which];
        at.find_slip(matrix, problem.base, trial_, trial_slip_);
        sliding.aim(at, point.roles.direction, trial_slip_, problem.bound, problem.turn);
        if (!sliding.factorise(matrix, at)) return false;
        sliding.turn(at, trial_slip_, trial_);
        for (Index l = 0; l < at.sliding(); ++l) {
            const Index i = at.other(l);
            trial_.row(i) *= problem.bound[i] / length(Row(trial_.row(i)));
        }
        return true;
    }

    // How far the trial is from a solution.
    struct Fit {
        double residual = 0;  // residual of the natural map: sum of |p - P(p - rho R s)|
        double excess = 0;    // largest excess of sticking tractions, relative to their bounds
        double creep = 0;     // largest slip across tractions, or along them
    };
    // Measures the trial, and clears the slip of sticking elements; with one direction that slip is the error.
    Fit measure(const Problem& problem, const Point& point) {
        Fit fit;
        double largest = 0;  // largest component of M p
        double error = 0;
        for (Index i = 0; i < point.roles.size(); ++i) {
            const Row p = trial_.row(i), slip = trial_slip_.row(i);
            const double bound = problem.bound[i];
            const Role role = point.roles[i];
            if (role == Role::sticks) {
                const double size = length(p);
                if (!(size <= bound)) {  // also NaN
                    fit.residual += size - bound;
                    fit.excess = (std::max)(fit.excess, size / bound - 1);
                }
                error = (std::max)(error, length(slip));
                trial_slip_.row(i).setZero();
                continue;
            }
            largest = (std::max)(largest, (slip - problem.constant.row(i)).cwiseAbs().maxCoeff());
            if (role == Role::is_free) continue;
            // the product of tiny tractions and slips would vanish
            const Row turned = problem.turn.turned(i, slip), along = p / bound;
            const double across = std::abs(cross<directions>(along, turned));
            fit.creep = (std::max)({fit.creep, along.dot(turned), across});
            fit.residual += rest(p, turned, problem.reach[i], bound);
        }
        error_ = error;
        slip_scale_ = rounding(point.roles.size()) * ((std::max)(largest, problem.imposed) + problem.imposed);
        return fit;
    }
    // |p - P(p - rho s)| of an element.
    static double rest(const Row& p, const Row& turned_slip, double reach, double bound) {
        const Row x = p - reach * turned_slip;
        const double size = length(x);
        return length(Row(p - (size > bound ? bound / size : 1.0) * x));
    }
    // Whether the trial is a solution for the assumed roles, to `factor` times round-off.
    bool holds(const Fit& fit, double factor) const {
        return fit.excess <= 4 * factor * rounding(trial_.rows()) && fit.creep <= 4 * factor * slip_scale_;
    }

    // Halves the step until the residual is below the previous one, or the step is as short as it may get. Tractions
    // and slip are affine in its length.
    double shorten(const Problem& problem, const Point& point, double before) {
        change_ = trial_ - point.traction;
        slip_change_ = trial_slip_ - point.slip;
        double residual = before;
        for (double part = 0.5; part > 1.0 / 300; part /= 2) {
            trial_ = point.traction + part * change_;
            trial_slip_ = point.slip + part * slip_change_;
            residual = 0;
            for (Index i = 0; i < trial_.rows(); ++i) {
                if (problem.bound[i] == 0) continue;
                const Row turned = problem.turn.turned(i, Row(trial_slip_.row(i)));
                residual += rest(trial_.row(i), turned, problem.reach[i], problem.bound[i]);
            }
            if (residual <= (1 - 1e-4 * part) * before) break;
        }
        return residual;
    }

    // Whether s = M p + c holds to round-off; after the last refinement a larger error is accepted.
    bool verify(const Problem& problem, const Point& point) {
        auto& matrix = problem.equations.matrix;
        if (directions == 1 ? refinements_ > 0 : matrix.serves_once()) {
            find_error(problem, point);
            error_ = change_.cwiseAbs().maxCoeff();
        } else if (directions == 2) {
            error_ = matrix.error(point.traction, problem.constant, point.slip);
        }
        return error_ <= (refinements_ < most_refinements ? 4 : 1000) * slip_scale_;
    }
    void find_error(const Problem& problem, const Point& point) {
        problem.equations.matrix.multiply(point.traction, change_);
        change_ += problem.constant - point.slip;
    }
    // Replaces c by c' = c + (M p + c - s): the next solution repeats the error and thereby cancels it. False after the
    // last allowed refinement.
    bool refine(const Problem& problem, const Point& point) {
        if (refinements_ == most_refinements || !is_finite(error_)) return false;
        if (refinements_++ == 0) refined_ = problem.constant;
        find_error(problem, point);
        refined_ += change_;
        problem.base.forget();
        return true;
    }

    void note(const Vectors& p, double residual) {
        if (!(residual < least_)) return;
        least_ = residual;
        best_ = p;
    }

    Vectors trial_, trial_slip_, change_, slip_change_, best_;
    Vectors refined_;  // c'
    SlipPath<directions> path_;
    double slip_scale_ = 0;  // rounding of the slip
    double error_ = 0;
    double least_ = 0;  // residual of the natural map at best_
    int refinements_ = 0;
};

template <int directions>
bool SlipSearch<directions>::iterate(const Problem& problem, int most_steps, bool eagerly, Point& point) {
    auto& equations = problem.equations;
    double before = (std::numeric_limits<double>::max)();
    for (int step = 0; step < most_steps; ++step) {
        auto* at = equations.condense(problem.which, point.roles);
        if (at == nullptr) return false;
        at->find_base(equations.matrix, refinements_ > 0 ? &refined_ : &problem.constant, problem.base);
        ++steps;
        if (!take_step(problem, *at, point)) return false;
        const Fit fit = measure(problem, point);
        double residual = fit.residual;
        const bool stalls = !(residual < before), done = holds(fit, stalls ? 1000 : 1);
        if (!done && stalls) residual = shorten(problem, point, before);
        if (!is_finite(residual)) return false;
        point.traction = trial_;
        point.slip = trial_slip_;
        note(point.traction, residual);
        if (done) {
            if (verify(problem, point)) return true;
            if (!refine(problem, point)) return false;
            before = (std::numeric_limits<double>::max)();
            continue;
        }
        if (residual < nearly * problem.bound.sum() && problem.leads_on(point)) return true;
        place(problem, eagerly && step == 0 && !point.roles.any_slides() ? eager : 1.0, point);
        before = residual;
    }
    return false;
}

}  // namespace rollbem::detail
