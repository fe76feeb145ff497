// rollbem/friction/detail/stick_slip.hpp, homotopy.hpp, condensed_slip.hpp, nested_stick.hpp, slip_rotation.hpp
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include <rollbem/friction/detail/stick_slip.hpp>
#include <rollbem/steady/steady.hpp>

#include "extremes/drawn.hpp"
#include "friction/same_bits.hpp"
#include "support/catch.hpp"
#include "support/dense.hpp"

namespace stick_slip_tests {
namespace {

using namespace rollbem;

std::vector<Zone> all_stick(Eigen::Index n) { return std::vector<Zone>(static_cast<std::size_t>(n), Zone::stick); }

/// A solver with its problem and its solution.
template <int directions>
struct Solver {
    using Vectors = detail::Vectors<directions>;

    explicit Solver(Eigen::Index n, bool coupled = false) : solver(n, coupled), problem(n), solution(n) {
        response.fill(Vectors::Zero(n, directions));
    }
    const detail::StageSolution<directions>& solve(const VectorX<double>& bound, const Vectors& traction,
                                                   const std::vector<Zone>& zones) {
        if (problem.bound != bound) ++problem.bounds;
        problem.bound = bound;
        problem.measure(0);
        std::array<Vectors, directions> start;
        start.fill(traction);
        solver.start(problem, start, zones, solution);
        solver.solve(problem, centres, true, solution);
        return solution;
    }
    /// dp of the last solution.
    const Vectors& respond(const detail::ProblemChange<directions>& change, VectorX<double>& size_change) {
        solver.respond(problem, solution, change, centres, response, &size_change);
        return response.back();
    }

    detail::StickSlipSolver<directions> solver;
    detail::StageProblem<directions> problem;
    detail::StageSolution<directions> solution;
    std::array<Vectors, directions> response;
    const detail::CentreValues<double>* centres = nullptr;
};

/// A as a whole, of both directions where there are two.
template <int directions>
struct Problem {
    using Solver = stick_slip_tests::Solver<directions>;
    using Vectors = detail::Vectors<directions>;

    Eigen::Index size() const { return bound.size(); }
    MatrixX<double> block(Eigen::Index d, Eigen::Index e) const {
        return matrix.block(d * size(), e * size(), size(), size());
    }
    void put_into(Solver& solver) const {
        for (Eigen::Index d = 0; d < directions; ++d) {
            for (Eigen::Index e = 0; e < directions; ++e) {
                if (d != e && !coupled) continue;
                solver.solver.matrix.renew(static_cast<std::size_t>(d), static_cast<std::size_t>(e)) = block(d, e);
            }
        }
        solver.problem.constant[0] = constant;
    }
    const detail::StageSolution<directions>& solve_from_rest(Solver& solver) const {
        return solver.solve(bound, Vectors::Zero(size(), directions), all_stick(size()));
    }
    Vectors slip(const Vectors& p) const {
        return Vectors(dense::product(matrix, p.reshaped()).reshaped(size(), directions)) + constant;
    }
    /// The largest violation of the conditions, from the definition.
    double violation(const Vectors& p) const {
        const Vectors s = slip(p);
        double worst = 0;
        for (Eigen::Index i = 0; i < size(); ++i) {
            const double norm = p.row(i).norm(), slip = s.row(i).norm();
            worst = std::max(worst, norm - bound[i]);
            if (bound[i] == 0) continue;
            // below the bound there is no slip; at the bound slip opposes the traction
            const double inside = std::min(1 - norm / bound[i], slip), along = p.row(i).dot(s.row(i)) / bound[i];
            worst = std::max({worst, inside, along});
            if (norm > bound[i] / 2) worst = std::max(worst, (s.row(i) - along / norm * p.row(i)).norm());
        }
        return worst;
    }

    bool coupled;
    MatrixX<double> matrix;
    Vectors constant;
    VectorX<double> bound;
};

enum class Kind { singular, definite, any };

VectorX<double> random_vector(drawn::Draw& draw, Eigen::Index n) {
    return VectorX<double>::NullaryExpr(n, [&] { return draw.normal(); });
}
MatrixX<double> random_matrix(drawn::Draw& draw, Eigen::Index n, Kind kind) {
    const MatrixX<double> any = MatrixX<double>::NullaryExpr(n, n, [&] { return draw.normal(); });
    if (kind == Kind::any) return any;
    if (kind == Kind::singular) return dense::product(random_vector(draw, n), random_vector(draw, n).transpose());
    // definite, and far from symmetric
    MatrixX<double> result = dense::product(any, any.transpose()) + 2 * (any.transpose() - any);
    result.diagonal().array() += 1;
    return result;
}
template <int directions>
Problem<directions> random_problem(drawn::Draw& draw, Eigen::Index n, Kind kind, bool coupled = false) {
    Problem<directions> problem{coupled, MatrixX<double>::Zero(directions * n, directions * n), {}, {}};
    if (coupled) {
        problem.matrix = random_matrix(draw, directions * n, kind);
    } else {
        for (Eigen::Index d = 0; d < directions; ++d) {
            problem.matrix.block(d * n, d * n, n, n) = random_matrix(draw, n, kind);
        }
    }
    problem.constant = random_vector(draw, directions * n).reshaped(n, directions);
    problem.bound = random_vector(draw, n).cwiseAbs();
    return problem;
}

TEMPLATE_TEST_CASE_SIG("A solution is found whatever the matrix", "[friction]", ((int directions), directions), 1, 2) {
    using Vectors = detail::Vectors<directions>;
    drawn::Draw draw(11);
    int followed = 0, tangents = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Kind kind = trial % 3 == 0 ? Kind::singular : trial % 3 == 1 ? Kind::definite : Kind::any;
        const Eigen::Index n = 1 + trial % 12;
        auto problem = random_problem<directions>(draw, n, kind, directions == 2 && trial % 2 == 1);
        if (trial % 5 == 0) problem.bound[0] = 0;
        typename Problem<directions>::Solver solver(n, problem.coupled);
        problem.put_into(solver);
        const auto& outcome = problem.solve_from_rest(solver);
        const double violation = problem.violation(solver.solution.traction());
        CAPTURE(trial, n, outcome.rounds, outcome.path_points, outcome.residual, violation);
        REQUIRE(outcome.status == Status::ok);
        REQUIRE(outcome.residual < 1e-11);
        REQUIRE(violation < 1e-9);
        followed += outcome.path_points > 0 ? 1 : 0;
        if (kind == Kind::definite) CHECK(outcome.path_points == 0);
        if (kind != Kind::definite) continue;
        REQUIRE(outcome.has_tangent);
        // the tangent predicts the solution of a nearby problem
        const double e = 1e-7;
        const Vectors change = random_vector(draw, directions * n).reshaped(n, directions);
        const VectorX<double> bound_change = random_vector(draw, n).cwiseProduct(problem.bound);
        const Vectors before = solver.solution.traction(), slip = solver.solution.slip();
        VectorX<double> size_change(n);
        const Vectors response = solver.respond({{&change}, &bound_change}, size_change);
        const auto zones = solver.solution.zones;
        solver.problem.constant[0] += e * change;
        const VectorX<double> bound = problem.bound + e * bound_change;
        REQUIRE(solver.solve(bound, before, zones).status == Status::ok);
        if (solver.solution.zones != zones) continue;
        ++tangents;
        const double size = 1 + response.norm();
        CHECK((solver.solution.traction() - before - e * response).cwiseAbs().maxCoeff() < 1e-9 * size);
        for (Eigen::Index i = 0; i < n; ++i) {
            if (solver.solution.slides[i] == 0) continue;
            const double grown = solver.solution.slip_size(i) - slip.row(i).norm();
            CHECK(std::abs(grown - e * size_change[i]) < 1e-9 * (1 + size_change.norm()));
        }
    }
    CAPTURE(followed, tangents);
    CHECK(followed > 400);
    CHECK(tangents > 900);
}

TEST_CASE("A solution is found if all elements are alike", "[friction]") {
    // Circulant matrices under one creepage and one bound: every condition is met by several elements at once.
    drawn::Draw draw(1);
    int singular = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Eigen::Index n = 2 + trial % 9;
        const VectorX<double> first =
            VectorX<double>::NullaryExpr(n, [&] { return static_cast<double>(draw.integer(9)) - 4; });
        Problem<1> problem{false, MatrixX<double>(n, n), VectorX<double>::Constant(n, trial % 2 == 0 ? 1 : -1),
                           VectorX<double>::Ones(n)};
        for (Eigen::Index i = 0; i < n; ++i) {
            for (Eigen::Index j = 0; j < n; ++j) problem.matrix(i, j) = first[(j - i + n) % n];
        }
        Problem<1>::Solver solver(n);
        problem.put_into(solver);
        const auto& outcome = problem.solve_from_rest(solver);
        CAPTURE(trial, n, outcome.rounds, outcome.path_points, outcome.residual);
        REQUIRE(outcome.status == Status::ok);
        REQUIRE(problem.violation(solver.solution.traction()) < 1e-9);
        REQUIRE(outcome.path_points == 0);     // full sliding is near enough
        singular += first.sum() == 0 ? 1 : 0;  // equal tractions cause no slip
    }
    CHECK(singular > 1000);
}

// One problem after another of the same size, as they follow each other in time and as they do not: the same matrix,
// bounds and zones again, other ones, c that changes by little, by much or its sign, or for which elements slide
// without slip; responses in between.
TEMPLATE_TEST_CASE_SIG("What a solver has solved before changes no bit of its results", "[friction]",
                       ((int directions), directions), 1, 2) {
    using Vectors = detail::Vectors<directions>;
    drawn::Draw draw(7);
    int repeated = 0, stopped = 0;
    for (int trial = 0; trial < (directions == 1 ? 200 : 20); ++trial) {
        const Eigen::Index n = 1 + trial % 20;
        const Kind kind = trial % 3 == 0 ? Kind::singular : trial % 3 == 1 ? Kind::definite : Kind::any;
        auto problem = random_problem<directions>(draw, n, kind);
        if (trial % 4 == 0) problem.matrix = (problem.matrix - problem.matrix.transpose()).eval();
        if (trial % 5 == 0) problem.constant *= 5;
        typename Problem<directions>::Solver used(n);
        problem.put_into(used);
        Vectors traction = Vectors::Zero(n, directions);
        std::vector<Zone> zones = all_stick(n);
        VectorX<double> size_change(n);
        for (int next = 0; next < 12; ++next) {
            typename Problem<directions>::Solver fresh(n);
            problem.put_into(fresh);
            used.problem.constant[0] = problem.constant;
            const bool repeats = used.solution.at_once;
            const auto &a = used.solve(problem.bound, traction, zones),
                       &b = fresh.solve(problem.bound, traction, zones);
            CAPTURE(trial, next, n, a.rounds, b.rounds, a.path_points, b.path_points);
            REQUIRE(same_bits::same(a.traction(), b.traction()));
            REQUIRE(same_bits::same(a.slip(), b.slip()));
            REQUIRE(same_bits::same(a.against_slip, b.against_slip));
            REQUIRE(same_bits::same(a.slides, b.slides));
            REQUIRE(a.zones == b.zones);
            REQUIRE(same_bits::same(a.residual, b.residual));
            REQUIRE((a.rounds == b.rounds && a.path_points == b.path_points && a.stick_count == b.stick_count));
            REQUIRE((a.has_tangent == b.has_tangent && a.status == b.status));
            repeated += repeats && a.at_once ? 1 : 0;
            stopped += repeats && !a.at_once ? 1 : 0;
            const VectorX<double> bound_change = random_vector(draw, n);
            if (a.has_tangent && draw.integer(2) == 0) {
                const Vectors& response = used.respond({{}, &bound_change}, size_change);
                const Vectors first = response;
                REQUIRE(same_bits::same(first, fresh.respond({{}, &bound_change}, size_change)));
            }
            traction = a.traction();
            zones = a.zones;
            const int change = draw.integer(10);
            if (change == 0) problem.constant *= -1;
            if (change == 1) problem.constant += random_vector(draw, directions * n).reshaped(n, directions);
            if (change == 2) problem.bound = random_vector(draw, n).cwiseAbs();
            if (change == 3) problem.bound[n / 2] = 0;
            if (change == 4) zones = all_stick(n);
            if (change == 5) {
                problem.matrix *= 1.5;
                problem.put_into(used);
            }
            if (change == 6) problem.constant *= 1.001;
            if (change == 7) problem.constant -= problem.slip(traction);  // all slip vanishes, to rounding
        }
    }
    CAPTURE(repeated, stopped);
    CHECK((directions == 2 || (repeated > 200 && stopped > 200)));
}

// Each pivot is sound, but the inverse of the triangle grows tenfold from element to element.
TEST_CASE("Elements that stick do so to rounding though their equations are ill-conditioned", "[friction]") {
    drawn::Draw draw(2);
    int repeated = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Eigen::Index n = 7 + trial % 3;
        Problem<1> problem{false, MatrixX<double>::Identity(n, n), VectorX<double>::Zero(n),
                           VectorX<double>::Constant(n, 2)};
        for (Eigen::Index i = 0; i < n; ++i) problem.matrix.row(i).tail(n - 1 - i).setConstant(-9.5);
        Problem<1>::Solver solver(n);
        problem.put_into(solver);
        if (trial % 2 == 1) {  // from a solution without such an error
            solver.problem.constant[0][0] = 1;
            solver.solve(problem.bound, problem.constant, all_stick(n));
            REQUIRE(solver.solution.at_once);
            repeated += 1;
        }
        const VectorX<double> expected = VectorX<double>::NullaryExpr(n, [&] { return draw.uniform(-1, 1); });
        problem.constant = -dense::product(problem.matrix, expected);
        solver.problem.constant[0] = problem.constant;
        const auto& outcome = solver.solve(problem.bound, VectorX<double>::Zero(n), all_stick(n));
        CAPTURE(trial, n, outcome.rounds, outcome.residual);
        REQUIRE(outcome.status == Status::ok);
        REQUIRE(outcome.stick_count == n);
        REQUIRE(outcome.rounds > 1);  // one step is not enough
        // the last refinement accepts 1000 times the rounding of c
        REQUIRE(problem.slip(outcome.traction()).cwiseAbs().maxCoeff() <
                1e-11 * problem.constant.cwiseAbs().maxCoeff());
    }
    CHECK(repeated == 20);
}

TEST_CASE("What cannot be solved is said, and stays within the bounds", "[friction]") {
    Problem<2> problem{false, MatrixX<double>::Identity(4, 4), {}, VectorX<double>::Ones(2)};
    problem.constant.setConstant(2, 2, std::numeric_limits<double>::quiet_NaN());
    Problem<2>::Solver solver(2);
    problem.put_into(solver);
    const auto& outcome = problem.solve_from_rest(solver);
    CHECK(outcome.status == Status::no_solution);
    CHECK(std::isnan(outcome.residual));
    CHECK_FALSE(outcome.has_tangent);
}

TEST_CASE("A leading element without influence on its own slip is solved", "[friction]") {
    // central differences about the element's own centre: its diagonal vanishes, so sticking alone it is singular
    Problem<2> problem{false, MatrixX<double>::Zero(4, 4), ElementVectors(2, 2), VectorX<double>{{1, 3}}};
    problem.matrix.topLeftCorner(2, 2) << 1, 0.5, -0.5, 0;
    problem.matrix.bottomRightCorner(2, 2) << 1.2, 0.6, -0.6, 0;
    problem.constant << 0.9, 0.7, 0.45, 0.36;
    Problem<2>::Solver solver(2);
    problem.put_into(solver);
    const std::vector<Zone> zones{Zone::slip, Zone::stick};
    ElementVectors start(2, 2);
    start << -0.8, -0.6, 0, 0;
    CHECK(solver.solve(problem.bound, start, zones).status == Status::ok);
    CHECK(problem.violation(solver.solution.traction()) < 1e-13);
}

TEMPLATE_TEST_CASE_SIG("Slip follows the bounds as the tangent says, for all bounds at once", "[friction]",
                       ((int directions), directions), 1, 2) {
    drawn::Draw draw(4);
    int compared = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const Eigen::Index n = 2 + trial % 14;
        auto problem = random_problem<directions>(draw, n, Kind::definite, directions == 2 && trial % 2 == 1);
        problem.constant *= 3;
        if (trial % 5 == 0) problem.bound[n / 2] = 0;
        typename Problem<directions>::Solver solver(n, problem.coupled);
        problem.put_into(solver);
        const auto centres = detail::CentreValues<double>::in_strips(Elements<double>::one_strip(n));
        if (directions == 2 && trial % 3 > 0) solver.centres = &centres;
        if (!problem.solve_from_rest(solver).has_tangent) continue;
        MatrixX<double> coupling(n, n), across(n, n), aside(n, n);
        solver.solver.find_slip_by_bounds(solver.solution, solver.centres, true, coupling, across, aside);
        for (Eigen::Index l = 0; l < solver.solver.sliding_count(); ++l) {
            const VectorX<double> bound_change = VectorX<double>::Unit(n, solver.solver.sliding(l));
            VectorX<double> size_change(n);
            solver.respond({{}, &bound_change}, size_change);
            for (Eigen::Index k = 0; k < solver.solver.sliding_count(); ++k) {
                const double expected = -size_change[solver.solver.sliding(k)];
                CAPTURE(trial, k, l, coupling(k, l), expected);
                REQUIRE(std::abs(coupling(k, l) - expected) < 1e-9 * (1 + size_change.norm()));
                ++compared;
            }
        }
    }
    CHECK(compared > 2000);
}

// Strips of 1, 2, 3, 1, ... elements.
std::vector<Eigen::Index> strips(Eigen::Index n) {
    std::vector<Eigen::Index> behind;
    for (Eigen::Index first = 0, length = 1; first < n; first += length, length = length % 3 + 1) {
        for (Eigen::Index i = first; i < std::min(n, first + length); ++i) behind.push_back(i == first ? -1 : i - 1);
    }
    return behind;
}

// Angles from s to its sum with the slip of the row behind, from the definition; `slip` is 0 where elements stick.
VectorX<double> angles(const ElementVectors& slip, const std::vector<Eigen::Index>& behind) {
    VectorX<double> result = VectorX<double>::Zero(slip.rows());
    for (Eigen::Index i = 0; i < slip.rows(); ++i) {
        const Eigen::Index before = behind[static_cast<std::size_t>(i)];
        const auto ahead = std::find(behind.begin(), behind.end(), i) - behind.begin();
        Eigen::RowVector2d m = Eigen::RowVector2d::Zero();
        if (before >= 0) {
            m = slip.row(i) + slip.row(before);
        } else if (ahead < slip.rows()) {
            m = 3 * slip.row(i) - slip.row(ahead);
        }
        if (slip.row(i).norm() == 0 || m.norm() == 0) continue;
        const double turn =
            std::remainder(std::atan2(m[1], m[0]) - std::atan2(slip(i, 1), slip(i, 0)), 2 * std::numbers::pi);
        result[i] = std::clamp(turn, -std::numbers::pi / 3, std::numbers::pi / 3);
    }
    return result;
}

TEST_CASE("Rotated slip opposes the traction, at the angles of the pass with slip as it is", "[friction]") {
    drawn::Draw draw(3);
    int solved = 0, cut = 0, changed = 0;
    for (int trial = 0; trial < 600; ++trial) {
        const Eigen::Index n = 1 + trial % 14;
        auto problem = random_problem<2>(draw, n, Kind::definite, trial % 2 == 1);
        problem.constant *= 5;  // half of the elements slip
        if (trial % 5 == 0) problem.bound[n / 2] = 0;
        const std::vector<Eigen::Index> behind = strips(n);
        Problem<2>::Solver plain(n, problem.coupled), solver(n, problem.coupled);
        problem.put_into(plain);
        problem.put_into(solver);
        const auto centres = detail::CentreValues<double>::in_strips(behind);
        solver.centres = &centres;
        REQUIRE(problem.solve_from_rest(plain).status == Status::ok);
        const auto& outcome = problem.solve_from_rest(solver);
        CAPTURE(trial, n, outcome.rounds, outcome.residual);
        // an arbitrary matrix turned by arbitrary angles need not have a solution
        if (outcome.status != Status::ok) continue;
        ++solved;
        const ElementVectors& p = solver.solution.traction();
        const ElementVectors s = problem.slip(p);
        const VectorX<double> angle = angles(plain.solution.slip(), behind);
        for (Eigen::Index i = 0; i < n; ++i) {
            CAPTURE(i, angle[i]);
            cut += std::abs(angle[i]) > 1.047 ? 1 : 0;
            REQUIRE((solver.solution.slip().row(i) - s.row(i)).norm() < 1e-9);
            if (problem.bound[i] == 0) continue;
            const double norm = p.row(i).norm(), share = norm / problem.bound[i];
            REQUIRE(share < 1 + 1e-12);
            if (solver.solution.zones[static_cast<std::size_t>(i)] == Zone::stick) {
                REQUIRE(solver.solution.slip().row(i).norm() == 0);
                continue;
            }
            REQUIRE(share > 1 - 1e-12);
            const Eigen::RowVector2d turned = s.row(i) * Eigen::Rotation2Dd(angle[i]).toRotationMatrix().transpose();
            REQUIRE((turned + turned.norm() / norm * p.row(i)).norm() < 1e-8);  // angles are found to about 1e-10
            REQUIRE((solver.solution.against_slip.row(i) * s.row(i).norm() + s.row(i)).norm() < 1e-9);
        }
        changed += (p - plain.solution.traction()).norm() > 1e-3 ? 1 : 0;
        solver.centres = nullptr;
        problem.solve_from_rest(solver);
        REQUIRE(solver.solution.traction() == plain.solution.traction());
    }
    CAPTURE(solved, cut, changed);
    CHECK(solved > 590);
    CHECK(cut > 100);
    CHECK(changed > 300);
}

}  // namespace
}  // namespace stick_slip_tests
