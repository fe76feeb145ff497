// rollbem/adhesion/balanced_reduction.hpp
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include <rollbem/adhesion/balanced_reduction.hpp>
#include <rollbem/line.hpp>

#include "extremes/drawn.hpp"
#include "support/catch.hpp"
#include "support/dense.hpp"
#include "support/refusal.hpp"

namespace balanced_reduction_tests {
namespace {

using namespace rollbem;
using Complex = std::complex<double>;
using Catch::Matchers::ContainsSubstring;

constexpr double eps = std::numeric_limits<double>::epsilon();

const PlaneKernel<double> plane(100, 0.75, 0.25);

double norm(const Eigen::MatrixXcd& A) {
    Eigen::MatrixXd parts(2 * A.rows(), 2 * A.cols());
    parts << A.real(), -A.imag(), A.imag(), A.real();
    return dense::largest_singular_value(parts);
}

// The largest difference in a scan from frequency 0 to far beyond all eigenvalues.
double largest_difference(const StateSpace& one, const StateSpace& other) {
    std::vector<double> z = {0, 1e6};
    for (double next = 1e-2; next < 1e4; next *= 1.05) z.push_back(next);
    double largest = 0;
    for (const double at : z) {
        largest =
            std::max(largest, norm(dense::transfer(one, Complex(0, at)) - dense::transfer(other, Complex(0, at))));
    }
    return largest;
}

double abscissa(const StateSpace& space) { return dense::spectrum(space.A).values.real().maxCoeff(); }

// A dense system that decays, with k inputs and outputs.
StateSpace drawn(Eigen::Index n, Eigen::Index k, unsigned seed) {
    drawn::Draw draw(seed);
    const auto matrix = [&](Eigen::Index rows, Eigen::Index columns) {
        Eigen::MatrixXd entries(rows, columns);
        for (double& entry : entries.reshaped()) entry = draw.uniform(-1, 1);
        return entries;
    };
    StateSpace space{matrix(n, n), matrix(n, k), matrix(k, n), matrix(k, k)};
    space.A.diagonal().array() -= abscissa(space) + 0.1;
    return space;
}

struct Scene {
    const char* name;
    StateSpace space;
};

std::vector<Scene> scenes() {
    return {{"cosine", state_space(rolling_system(cosine_mesh(24), Collocation{0.5, 0.5}, plane))},
            {"uniform",
             state_space(rolling_system(uniform_mesh(20), Collocation{0, 0.63}, StripKernel<double>(0.5, 0.75, 0.25)))},
            {"chebyshev", state_space(Chebyshev{30}, plane)},
            {"drawn", drawn(20, 3, 1)},
            {"drawn, one input", drawn(17, 1, 2)}};
}

TEST_CASE("A reduced system has the steady state of the original, decays, and keeps to its bound", "[reduction]") {
    for (const auto& [scene, space] : scenes()) {
        const Eigen::MatrixXcd steady = dense::transfer(space, 0);
        for (const Eigen::Index states : {1, 2, 3, 5, 8, 12, 17}) {
            const BalancedReduction reduced = balanced_reduction(space, states);
            CAPTURE(scene, states, reduced.error_bound);
            REQUIRE(reduced.status == Status::ok);
            const Eigen::Index K = reduced.space.A.rows(), count = reduced.hankel_singular_values.size();
            CHECK(K == std::min(states, count));
            CHECK(norm(dense::transfer(reduced.space, 0) - steady) < 1e-13 * norm(steady));
            CHECK(abscissa(reduced.space) < 0);
            CHECK(std::abs(reduced.error_bound - 2 * reduced.hankel_singular_values.tail(count - K).sum()) <=
                  eps * reduced.error_bound);
            // no system of K states comes closer than the first singular value left out
            const double error = largest_difference(reduced.space, space);
            const double rounding = 1e-12 * norm(steady);
            CHECK(error <= reduced.error_bound + rounding);
            if (K < count) CHECK(error >= (1 - 1e-3) * reduced.hankel_singular_values[K] - rounding);
            // nor is the bound for frequencies alone
            const Complex s(0.3, 1.7);
            CHECK(norm(dense::transfer(reduced.space, s) - dense::transfer(space, s)) <=
                  reduced.error_bound + rounding);
        }
    }
}

// X of A X + X A^T + B B^T = 0 as n^2 linear equations.
Eigen::MatrixXd gramian(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
    const Eigen::Index n = A.rows();
    Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(n * n, n * n);
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
            for (Eigen::Index k = 0; k < n; ++k) {
                equations(i * n + j, k * n + j) += A(i, k);
                equations(i * n + j, i * n + k) += A(j, k);
            }
        }
    }
    const Eigen::MatrixXd square = dense::product(B, B.transpose());
    const Eigen::MatrixXd X = dense::solve(equations, -square.reshaped(n * n, 1));
    return X.reshaped(n, n);
}

TEST_CASE("Hankel singular values agree with the product of both Gramians", "[reduction]") {
    for (const unsigned seed : {3U, 4U, 5U}) {
        const Eigen::Index k = seed - 2;
        const StateSpace space = drawn(7, k, seed);
        const Eigen::MatrixXd product =
            dense::product(gramian(space.A, space.B), gramian(space.A.transpose(), space.C.transpose()));
        Eigen::ArrayXd squares = dense::spectrum(product).values.real();
        std::sort(squares.begin(), squares.end(), std::greater<>());
        const Eigen::ArrayXd sigma = balanced_reduction(space, 3).hankel_singular_values;
        REQUIRE(sigma.size() == 7);
        CHECK((sigma.square() - squares).abs().maxCoeff() < 1e-12 * squares[0]);
    }
}

TEST_CASE("Reductions are nested: the reduced system has the first singular values", "[reduction]") {
    for (const auto& [scene, space] : scenes()) {
        CAPTURE(scene);
        const BalancedReduction ten = balanced_reduction(space, 10), four = balanced_reduction(space, 4);
        REQUIRE(ten.space.A.rows() == 10);
        const BalancedReduction again = balanced_reduction(ten.space, 4);
        REQUIRE(again.hankel_singular_values.size() == 10);
        const double unit = ten.hankel_singular_values[0];
        CHECK((again.hankel_singular_values - ten.hankel_singular_values.head(10)).abs().maxCoeff() < 1e-12 * unit);
        CHECK(largest_difference(again.space, four.space) < 1e-10 * unit);
        // of balanced states: Gramians diag(sigma)
        const Eigen::MatrixXd P = gramian(four.space.A, four.space.B),
                              Q = gramian(four.space.A.transpose(), four.space.C.transpose());
        const Eigen::MatrixXd sigma = four.hankel_singular_values.head(4).matrix().asDiagonal();
        CHECK((P - sigma).cwiseAbs().maxCoeff() < 1e-11 * unit);
        CHECK((Q - sigma).cwiseAbs().maxCoeff() < 1e-11 * unit);
    }
}

TEST_CASE("What cannot be reduced has a status", "[reduction]") {
    const auto status = [](StateSpace space) {
        const BalancedReduction reduced = balanced_reduction(space, 2);
        if (reduced.status != Status::ok) CHECK(reduced.space.A.size() == 0);
        return reduced.status;
    };
    const StateSpace decays = drawn(6, 2, 8);
    CHECK(status(decays) == Status::ok);
    StateSpace space = decays;
    space.A.diagonal().array() += 0.2;
    CHECK(status(space) == Status::unstable);
    space = decays;
    space.A.diagonal().array() += 0.1 - 0x1p-56;
    CHECK(status(space) == Status::ill_conditioned);
    space = decays;
    space.A.row(2).setZero();  // singular
    CHECK(status(space) != Status::ok);
    space = decays;
    space.B.setZero();
    CHECK(status(space) == Status::ill_conditioned);
    space = decays;
    space.B *= 1e300;
    space.C *= 1e300;
    CHECK(status(space) == Status::not_finite);
    // a discretisation whose modes grow
    CHECK(status(state_space(rolling_system(uniform_mesh(20), Collocation{0.5, 1.2}, plane))) == Status::unstable);
}

TEST_CASE("Reductions reject numbers of states and matrices that do not fit", "[reduction]") {
    const StateSpace good = drawn(6, 2, 9);
    const auto told = [](const StateSpace& space, Eigen::Index states) {
        return refusal([&] { balanced_reduction(space, states); });
    };
    CHECK(told(good, 6).empty());
    for (const Eigen::Index states : {0, -1, 7}) {
        CHECK_THAT(told(good, states),
                   ContainsSubstring("balanced_reduction: states = ") && ContainsSubstring("must lie in [1, 6]"));
    }
    StateSpace bad = good;
    bad.A.resize(6, 5);
    CHECK_THAT(told(bad, 2), ContainsSubstring("number of columns of A = 5"));
    bad = good;
    bad.B.resize(5, 2);
    CHECK_THAT(told(bad, 2), ContainsSubstring("number of rows of B = 5"));
    bad = good;
    bad.C.resize(2, 7);
    CHECK_THAT(told(bad, 2), ContainsSubstring("number of columns of C = 7"));
    bad = good;
    bad.D.resize(1, 1);
    CHECK_THAT(told(bad, 2), ContainsSubstring("number of rows of D = 1"));
    bad.D.resize(2, 1);
    CHECK_THAT(told(bad, 2), ContainsSubstring("number of columns of D = 1"));
    for (MatrixX<double> StateSpace::*matrix : {&StateSpace::A, &StateSpace::B, &StateSpace::C, &StateSpace::D}) {
        bad = good;
        (bad.*matrix)(1, 0) = std::numeric_limits<double>::quiet_NaN();
        CHECK_THAT(told(bad, 2), ContainsSubstring("(1, 0) = nan must be finite"));
    }
    CHECK_THAT(told(StateSpace{}, 1), ContainsSubstring("number of rows of A = 0"));
}

}  // namespace
}  // namespace balanced_reduction_tests
