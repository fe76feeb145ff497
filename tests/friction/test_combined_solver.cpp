// rollbem/friction/detail/both_solver.hpp, both_equations.hpp
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include <rollbem/compiled/friction.hpp>

#include "support/catch.hpp"
#include "support/dense.hpp"
#include "support/draw.hpp"

namespace {

using namespace rollbem;

using Solver = detail::BothSolver<double>;

std::vector<Zone> all_stick(Eigen::Index n) { return std::vector<Zone>(static_cast<std::size_t>(n), Zone::stick); }

struct Problem {
    MatrixX<double> x, y;
    ElementVectors<double> constant;
    VectorX<double> bound;
    MatrixX<double> x_by_y{}, y_by_x{};  // empty unless coupled

    Eigen::Index size() const { return bound.size(); }
    bool coupled() const { return x_by_y.size() > 0; }
    void put_into(Solver& solver) const {
        solver.new_matrix(0) = x;
        solver.new_matrix(1) = y;
        if (coupled()) {
            solver.new_matrix(0, 1) = x_by_y;
            solver.new_matrix(1, 0) = y_by_x;
        }
        solver.constant() = constant;
    }
    Solver::Outcome solve_from_rest(Solver& solver) const {
        return solver.solve(bound, {ElementVectors<double>::Zero(size(), 2), all_stick(size())});
    }
    ElementVectors<double> slip(const ElementVectors<double>& p) const {
        ElementVectors<double> s(size(), 2);
        s.col(0) = x * p.col(0) + constant.col(0);
        s.col(1) = y * p.col(1) + constant.col(1);
        if (coupled()) {
            s.col(0) += x_by_y * p.col(1);
            s.col(1) += y_by_x * p.col(0);
        }
        return s;
    }
    /// The largest violation of the conditions, from the definition.
    double violation(const ElementVectors<double>& p) const {
        const ElementVectors<double> s = slip(p);
        double worst = 0;
        for (Eigen::Index i = 0; i < size(); ++i) {
            const double norm = p.row(i).norm(), slip = s.row(i).norm();
            worst = std::max(worst, norm - bound[i]);
            if (bound[i] == 0) continue;
            // below the bound there is no slip; at the bound slip opposes the traction
            const double inside = std::min(1 - norm / bound[i], slip);
            const double across = std::abs(p(i, 0) * s(i, 1) - p(i, 1) * s(i, 0)) / bound[i];
            worst = std::max({worst, inside, across, p.row(i).dot(s.row(i)) / bound[i]});
        }
        return worst;
    }
};

enum class Kind { singular, definite, any };

Problem random_problem(support::Draw& draw, Eigen::Index n, Kind kind, bool coupled = false) {
    if (coupled) {
        const MatrixX<double> whole = random_problem(draw, 2 * n, kind).x;
        Problem problem = random_problem(draw, n, kind);
        problem.x = whole.topLeftCorner(n, n);
        problem.y = whole.bottomRightCorner(n, n);
        problem.x_by_y = whole.topRightCorner(n, n);
        problem.y_by_x = whole.bottomLeftCorner(n, n);
        return problem;
    }
    const auto vector = [&] { return VectorX<double>(VectorX<double>::NullaryExpr(n, [&] { return draw.normal(); })); };
    const auto matrix = [&] {
        const MatrixX<double> any = MatrixX<double>::NullaryExpr(n, n, [&] { return draw.normal(); });
        if (kind == Kind::singular) return dense::product(vector(), vector().transpose());
        // definite, and far from symmetric
        const MatrixX<double> skew = any.transpose() - any;
        if (kind == Kind::definite) {
            MatrixX<double> result = dense::product(any, any.transpose()) + 2 * skew;
            result.diagonal().array() += 1;
            return result;
        }
        return any;
    };
    Problem problem{matrix(), matrix(), ElementVectors<double>(n, 2), vector().cwiseAbs()};
    problem.constant.col(0) = vector();
    problem.constant.col(1) = vector();
    return problem;
}

TEST_CASE("Definite problems are solved, nearly all others too, or their residual is reported", "[friction]") {
    support::Draw draw(11);
    int unsolved = 0, several = 0, tangents = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Kind kind = trial % 3 == 0 ? Kind::singular : trial % 3 == 1 ? Kind::definite : Kind::any;
        const Eigen::Index n = 1 + trial % 12;
        Problem problem = random_problem(draw, n, kind, trial % 2 == 1);
        if (trial % 5 == 0) problem.bound[0] = 0;
        Solver solver(n, problem.coupled());
        problem.put_into(solver);
        const auto outcome = problem.solve_from_rest(solver);
        const double violation = problem.violation(solver.traction());
        CAPTURE(trial, n, outcome.rounds, outcome.residual, violation);
        REQUIRE(outcome.rounds <= 1600);
        if (kind == Kind::definite) REQUIRE(outcome.status == StepStatus::ok);
        if (outcome.status == StepStatus::ok) {
            REQUIRE(violation < 1e-9);
        } else {
            ++unsolved;
            REQUIRE(outcome.status == StepStatus::no_solution);
            REQUIRE(outcome.residual > 1e-12);
            REQUIRE(violation > 1e-12);
            REQUIRE((solver.traction().rowwise().norm() - problem.bound).maxCoeff() < 1e-12);
        }
        several += outcome.rounds > 60 ? 1 : 0;
        if (!outcome.tangent_exists) continue;
        // the tangent predicts the solution of a nearby problem
        const double e = 1e-7;
        ElementVectors<double> change = ElementVectors<double>::Zero(n, 2), response = change;
        change.col(trial % 2).setOnes();
        const ElementVectors<double> before = solver.traction();
        solver.respond(change, response);
        if (kind != Kind::definite) continue;
        ++tangents;
        const auto zones = solver.zones();
        solver.constant() += e * change;
        REQUIRE(solver.solve(problem.bound, {before, zones}).status == StepStatus::ok);
        if (solver.zones() == zones) CHECK((solver.traction() - before - e * response).cwiseAbs().maxCoeff() < 1e-9);
    }
    CAPTURE(unsolved, several, tangents);
    CHECK(unsolved < 2);
    CHECK(several > 700);
    CHECK(tangents > 900);
}

TEST_CASE("A leading element without influence on its own slip is solved", "[friction]") {
    // central differences about the element's own centre: its diagonal vanishes, so sticking alone it is singular
    Problem problem{MatrixX<double>{{1, 0.5}, {-0.5, 0}}, MatrixX<double>{{1.2, 0.6}, {-0.6, 0}},
                    ElementVectors<double>(2, 2), VectorX<double>{{1, 3}}};
    problem.constant << 0.9, 0.7, 0.45, 0.36;
    Solver solver(2);
    problem.put_into(solver);
    std::vector<Zone> zones{Zone::slip, Zone::stick};
    ElementVectors<double> start(2, 2);
    start << -0.8, -0.6, 0, 0;
    const auto outcome = solver.solve(problem.bound, {start, zones});
    CHECK(outcome.status == StepStatus::ok);
    CHECK(outcome.tangent_exists);
    CHECK(problem.violation(solver.traction()) < 1e-13);
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
VectorX<double> angles(const ElementVectors<double>& slip, const std::vector<Eigen::Index>& behind) {
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

TEST_CASE("Turned slip opposes the traction, at the angles of the solution with slip as it is", "[friction]") {
    support::Draw draw(3);
    int solved = 0, cut = 0, changed = 0;
    for (int trial = 0; trial < 600; ++trial) {
        const Eigen::Index n = 1 + trial % 14;
        Problem problem = random_problem(draw, n, Kind::definite, trial % 2 == 1);
        problem.constant *= 5;  // half of the elements slip
        if (trial % 5 == 0) problem.bound[n / 2] = 0;
        const std::vector<Eigen::Index> behind = strips(n);
        Solver plain(n, problem.coupled()), solver(n, problem.coupled());
        problem.put_into(plain);
        problem.put_into(solver);
        solver.turn_slip(behind);
        REQUIRE(problem.solve_from_rest(plain).status == StepStatus::ok);
        const auto outcome = problem.solve_from_rest(solver);
        CAPTURE(trial, n, outcome.rounds, outcome.residual);
        // an arbitrary matrix turned by arbitrary angles need not have a solution
        if (outcome.status != StepStatus::ok) continue;
        ++solved;
        const ElementVectors<double>& p = solver.traction();
        const ElementVectors<double> s = problem.slip(p);
        const VectorX<double> angle = angles(plain.slip(), behind);
        for (Eigen::Index i = 0; i < n; ++i) {
            CAPTURE(i, angle[i]);
            cut += std::abs(angle[i]) > 1.047 ? 1 : 0;
            REQUIRE((solver.slip().row(i) - s.row(i)).norm() < 1e-9);
            if (problem.bound[i] == 0) continue;
            const double norm = p.row(i).norm(), share = norm / problem.bound[i];
            REQUIRE(share < 1 + 1e-12);
            if (solver.zones()[static_cast<std::size_t>(i)] == Zone::stick) {
                REQUIRE(solver.slip().row(i).norm() == 0);
                continue;
            }
            REQUIRE(share > 1 - 1e-12);
            const Eigen::RowVector2d turned = s.row(i) * Eigen::Rotation2Dd(angle[i]).toRotationMatrix().transpose();
            REQUIRE((turned + turned.norm() / norm * p.row(i)).norm() < 1e-8);  // angles are found to about 1e-10
            REQUIRE((solver.against_slip().row(i) * s.row(i).norm() + s.row(i)).norm() < 1e-9);
        }
        changed += (p - plain.traction()).norm() > 1e-3 ? 1 : 0;
        // an empty list: not turned
        solver.turn_slip({});
        problem.solve_from_rest(solver);
        REQUIRE(solver.traction() == plain.traction());
    }
    CAPTURE(solved, cut, changed);
    CHECK(solved > 590);
    CHECK(cut > 100);
    CHECK(changed > 300);
}

TEST_CASE("A Newton step satisfies its equations, however many elements slip", "[friction]") {
    support::Draw draw(6);
    for (int trial = 0; trial < 800; ++trial) {
        const Eigen::Index n = 1 + trial % 15;
        const bool coupled = trial % 2 == 1;
        const Kind kind = trial % 8 < 6 ? Kind::definite : Kind::any;
        Problem problem = random_problem(draw, n, kind, coupled);
        // an element that sticks alone has no solution of its own, all together have
        if (trial % 10 == 0 && n > 3) problem.x(n - 1, n - 1) = 0;
        detail::BothEquations<double> equations(n, coupled);
        equations.new_matrix(0, 0) = problem.x;
        equations.new_matrix(1, 1) = problem.y;
        if (coupled) {
            equations.new_matrix(0, 1) = problem.x_by_y;
            equations.new_matrix(1, 0) = problem.y_by_x;
        }
        detail::BothPartition<double> part(n);
        detail::SlipTurn<double> turn(n);
        ElementVectors<double> slip = random_problem(draw, n, kind).constant;
        const int stick = draw.integer(5), slide = 5 - stick;  // shares
        for (Eigen::Index i = 0; i < n; ++i) {
            const int zone = draw.integer(6);
            const double angle = draw.integer(1000),
                         stiffness = draw.integer(7) == 0 ? 1e300 : draw.integer(100) / 30.0;
            if (zone < stick)
                part.let_stick(i);
            else if (zone < stick + slide)
                part.let_slide(i, std::cos(angle), std::sin(angle), 1, stiffness);
            else
                part.let_go(i);
        }
        if (trial % 3 == 0) {
            turn.set_behind(strips(n));
            turn.find(slip, part.stick, part.slide);
        }
        CAPTURE(trial, n, coupled);
        if (!equations.factorise(part, turn)) {
            REQUIRE(kind == Kind::any);
            continue;
        }
        // ds = M dp must cancel slip where elements stick, and follow the traction's turn where they slip
        const auto violation = [&](const ElementVectors<double>& s, const ElementVectors<double>& dp) {
            ElementVectors<double> after = problem.slip(dp) - problem.constant + s;
            turn.apply(after);
            double worst = 0;
            for (Eigen::Index i = 0; i < n; ++i) {
                const Eigen::RowVector2d along = part.direction.row(i), across(-along[1], along[0]);
                if (part.stick[i] != 0) {
                    worst = std::max(worst, after.row(i).norm());
                } else if (part.slide[i] != 0) {
                    const double tau = across.dot(dp.row(i)), size = 1 + part.stiffness[i];
                    worst = std::max(worst, std::abs(along.dot(dp.row(i))));
                    worst = std::max(worst, std::abs(across.dot(after.row(i)) + part.stiffness[i] * tau) / size);
                } else {
                    worst = std::max(worst, dp.row(i).norm());
                }
            }
            return worst / (1 + dp.norm());
        };
        ElementVectors<double> dp(n, 2);
        equations.solve(slip, dp);
        REQUIRE(violation(slip, dp) < 1e-9);

        // the same for a traction that grows: by how much slip against the present one grows
        MatrixX<double> coupling = MatrixX<double>::Constant(n, n, 7);
        equations.couple(coupling);
        for (Eigen::Index k = 0; k < equations.slipping_count(); ++k) {
            ElementVectors<double> growth = ElementVectors<double>::Zero(n, 2);
            growth.row(equations.slipping(k)) = part.direction.row(equations.slipping(k));
            const ElementVectors<double> caused = problem.slip(growth) - problem.constant;
            equations.solve(caused, dp);
            ElementVectors<double> grown = problem.slip(growth + dp) - problem.constant;
            turn.apply(grown);
            for (Eigen::Index i = 0; i < n; ++i) {
                const double expected = part.slide[i] != 0 ? grown.row(i).dot(part.direction.row(i)) : 7;
                REQUIRE(std::abs(coupling(i, k) - expected) < 1e-8 * (1 + grown.norm()));
            }
        }
    }
}

}  // namespace
