// rollbem/adhesion/stability.hpp
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/QR>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/rolling_system.hpp>

#include "support/catch.hpp"
#include "support/dense.hpp"

namespace stability_tests {
namespace {

using namespace rollbem;
using Complex = std::complex<double>;
using Matrix = MatrixX<double>;
using dense::product;

constexpr double nu = 0.25;

StripKernel<double> strip(double aspect = 1000) { return {aspect, 1 - nu, nu}; }
PlaneKernel<double> plane(double aspect) { return {aspect, 1 - nu, nu}; }

/// A random matrix, the same at every run.
Matrix random_matrix(Eigen::Index n, unsigned seed) {
    Matrix A(n, n);
    for (Eigen::Index k = 0; k < n * n; ++k) {
        seed = seed * 1664525u + 1013904223u;
        A(k) = static_cast<double>(seed >> 8) / (1 << 23) - 1;
    }
    return A;
}

Matrix random_orthogonal(Eigen::Index n, unsigned seed) {
    return Eigen::HouseholderQR<Matrix>(random_matrix(n, seed)).householderQ();
}

// The weights do not affect the eigenvalues.
RollingSystem<double> system_of(const Matrix& G, const Matrix& G_prime) {
    return {G, G_prime, ArrayX<double>::Ones(G.rows())};
}

template <class Kernel = StripKernel<double>>
Eigen::Index unstable_modes(const Mesh<double>& mesh, const AnyScheme& scheme, const Kernel& kernel = strip()) {
    return count_unstable(rolling_system(mesh, scheme, kernel)).unstable_count;
}

TEST_CASE("QZ finds prescribed eigenvalues, finite and infinite", "[stability]") {
    const Eigen::Index n = 6;
    Matrix S = Matrix::Zero(n, n), T = Matrix::Identity(n, n);
    S.diagonal() << -1, -2, -2, 3, 1, -0.5;
    S(1, 2) = 5;  // -2 +- 5i
    S(2, 1) = -5;
    T(4, 4) = 0;   // infinite
    T(3, 3) = -2;  // -1.5
    S(0, 5) = T(0, 4) = 2;
    const Matrix Q = random_matrix(n, 1), Z = random_matrix(n, 2);
    const RollingSystem<double> system = system_of(product(product(Q, T), Z), product(product(Q, S), Z));
    const StabilityResult result = judge_stability(system);
    REQUIRE(result.status == Status::ok);
    VectorX<Complex> found = result.eigenvalues();
    int infinite = 0;
    for (const Complex expected : {Complex(-1), Complex(-2, 5), Complex(-2, -5), Complex(-1.5), Complex(-0.5)}) {
        double nearest = 1;
        for (const Complex& value : found) nearest = std::min(nearest, std::abs(value - expected));
        CAPTURE(expected, nearest);
        CHECK(nearest < 1e-12);
    }
    for (Eigen::Index k = 0; k < n; ++k) infinite += std::abs(found[k]) > 1e12;
    CHECK(infinite == 1);
    CHECK((result.beta.array() >= 0).all());
    CHECK(result.uncertain_count == 1);
    CHECK(result.settled_unstable_count == 0);
    CHECK(condition_number(system.G()) > 1e14);
    CHECK_FALSE(result.stable());

    // exactly singular: no division by a zero beta
    const Matrix singular_G = Eigen::Vector3d(1, 0, 2).asDiagonal();
    const StabilityResult singular = judge_stability(system_of(singular_G, -Matrix::Identity(3, 3)));
    CHECK(singular.unstable_count == 0);
    CHECK(singular.uncertain_count == 1);
    CHECK(singular.spectral_abscissa == Approx(-0.5));
    CHECK(singular.spectral_radius == std::numeric_limits<double>::infinity());
    CHECK(condition_number(singular_G) == std::numeric_limits<double>::infinity());
}

TEST_CASE("Abscissa, radius, stiffness and condition number describe a prescribed spectrum", "[stability]") {
    // eigenvalues -4, 2, -1 +- 3i in a basis that is far from orthogonal
    Matrix D = Matrix::Zero(4, 4);
    D.diagonal() << -4, 2, -1, -1;
    D(2, 3) = 3;
    D(3, 2) = -3;
    const Matrix G = random_matrix(4, 7) + 2 * Matrix::Identity(4, 4), X = random_matrix(4, 9);
    const Matrix X_D_in_X = dense::solve(X.transpose(), product(X, D).transpose()).transpose();  // X D X^-1
    const StabilityResult result = solve_stability(system_of(G, product(G, X_D_in_X)));
    CHECK(result.unstable_count == 1);
    CHECK(result.unstable_fraction() == 0.25);
    CHECK(result.spectral_abscissa == Approx(2));
    CHECK(result.spectral_radius == Approx(4));
    CHECK(result.stiffness_ratio == Approx(4));
    CHECK(result.uncertainty.size() == 0);
    CHECK(result.uncertain_count == 4);  // without a look at rounding

    const Matrix U = random_orthogonal(4, 3), V = random_orthogonal(4, 4);
    const Matrix scaled = product(U * Eigen::Vector4d(3, 1, 1e-3, 3e-9).asDiagonal(), V);
    CHECK(condition_number(scaled) == Approx(1e9).epsilon(1e-5));
}

TEST_CASE("The uncertainty of an eigenvalue follows its definition", "[stability]") {
    // right eigenvectors X from the standard problem, left ones as rows of (G X)^-1: accurate while they are
    // well conditioned
    for (const unsigned seed : {11u, 12u, 13u}) {
        const Eigen::Index n = 12;
        const Matrix G = random_matrix(n, seed) + 3 * Matrix::Identity(n, n);
        const Matrix G_prime = random_matrix(n, seed + 100);
        const dense::Spectrum spectrum = dense::spectrum(dense::solve(G, G_prime));
        const MatrixX<Complex>& X = spectrum.vectors;
        const MatrixX<Complex> G_X = G.cast<Complex>() * X;
        const MatrixX<Complex> Y = dense::solve_complex(G_X, MatrixX<Complex>::Identity(n, n));
        const double norm_G = dense::largest_singular_value(G);
        const double norm_G_prime = dense::largest_singular_value(G_prime);
        const StabilityResult result = judge_stability(system_of(G, G_prime));
        const VectorX<Complex> found = result.eigenvalues();
        CHECK(result.uncertain_count == 0);
        for (Eigen::Index k = 0; k < n; ++k) {
            const Complex value = spectrum.values[k];
            const double product = 1 / (Y.row(k).norm() * X.col(k).norm());
            const double expected = static_cast<double>(n) * std::numeric_limits<double>::epsilon() *
                                    (norm_G_prime + std::abs(value) * norm_G) / product;
            Eigen::Index nearest = 0;
            (found.array() - value).abs().minCoeff(&nearest);
            CAPTURE(seed, value, found[nearest], result.uncertainty[nearest] / expected);
            CHECK(std::abs(result.uncertainty[nearest] / expected - 1) < 1e-6);

            // shifted to within 0.3 bounds of the imaginary axis, the sign is open; 4 bounds away it is settled
            if (value.imag() < 0) continue;
            const double bound = result.uncertainty[nearest];
            const auto uncertain_at = [&](double distance) {
                return judge_stability(system_of(G, G_prime - (value.real() - distance) * G)).uncertain_count;
            };
            const Eigen::Index expected_count = value.imag() == 0 ? 1 : 2;
            CHECK(uncertain_at(0.3 * bound) == expected_count);
            CHECK(uncertain_at(-0.3 * bound) == expected_count);
            CHECK(uncertain_at(4 * bound) == 0);
            CHECK(uncertain_at(-4 * bound) == 0);
        }
    }
}

TEST_CASE("The fast count of unstable modes agrees with QZ", "[stability]") {
    int settled = 0, unstable = 0;
    const auto check = [&](const auto& mesh, const auto& scheme, const auto& kernel) {
        const RollingSystem<double> system = rolling_system(mesh, scheme, kernel);
        const StabilityResult::Count count = count_unstable(system);
        const StabilityResult result = judge_stability(system);
        CAPTURE(mesh.size(), scheme.alpha_L, scheme.alpha_T, count.rcond, result.uncertain_count);
        CHECK(count.n == mesh.size());
        CHECK(result.status == Status::ok);
        CHECK((count.status == Status::ok || scheme.alpha_T == 1));  // G' may be singular there
        if (count.status != Status::ok) return;
        // open signs may come out either way
        CHECK(std::abs(count.unstable_count - result.unstable_count) <= result.uncertain_count);
        if (result.uncertain_count == 0) ++settled;
        if (result.settled_unstable_count > 0) ++unstable;
    };
    for (const int n : {1, 2, 5, 20, 40, 80}) {
        for (const double alpha_T : {0.3, 0.5, 0.63, 0.7, 0.77, 0.8, 0.9, 1.0}) {
            const bool one = n == 1;
            check(uniform_mesh(n), Collocation{one ? alpha_T : 0, alpha_T}, strip());
            check(cosine_mesh(n), Collocation{alpha_T, alpha_T}, plane(100));
            check(cosine_mesh(n), Galerkin{one ? alpha_T : 0, alpha_T}, strip(3));
            if (n > 2) check(knothe_mesh(n, 0.4), Collocation{0, alpha_T, Derivative::analytic, 0.3}, strip());
        }
    }
    CAPTURE(settled, unstable);
    CHECK(settled > 120);  // of 176: the counts were equal there
    CHECK(unstable > 30);
}

TEST_CASE("The fast count reports a G' that is nearly singular", "[stability]") {
    const StabilityResult::Count count =
        count_unstable(rolling_system(uniform_mesh(40), Collocation{0, 1.35}, strip()));
    CHECK(count.status == Status::ill_conditioned);
    CHECK(count.rcond < 1e-4);
    CHECK_FALSE(StabilityVerdict{}.stable());
}

TEST_CASE("A system is judged by both directions, and shapes by each of them", "[stability]") {
    const auto stable = rolling_system(uniform_mesh(20), Collocation{}, strip()),
               unstable = rolling_system(uniform_mesh(20), Collocation{0, 1.2}, strip());
    const Eigen::Index growing = judge_stability(unstable).unstable_count;
    REQUIRE(growing > 0);
    struct Shapes {
        std::vector<RollingSystem<double>> nodes;

        std::size_t node_count() const { return nodes.size(); }
        std::vector<RollingSystem<double>> subsystems(std::size_t node) const { return {nodes[node]}; }
    };
    for (const auto& [first, second] : {std::pair(stable, unstable), {unstable, stable}}) {
        CHECK(judge_stability(ElementSystem<double, 2>(first, second)).unstable_count == growing);
        CHECK(judge_stability(Shapes{{first, second}}).unstable_count == growing);
    }
}

TEST_CASE("The recommended schemes are stable and larger alphas are not", "[stability]") {
    for (const int n : {20, 40, 60, 80}) {
        CAPTURE(n);
        CHECK(unstable_modes(uniform_mesh(n), Collocation{0, 0.63}) == 0);
        CHECK(unstable_modes(uniform_mesh(n), Collocation{0.5, 0.5}) == 0);
        CHECK(unstable_modes(uniform_mesh(n), Collocation{0.55, 0.55}) > 0);
        CHECK(unstable_modes(uniform_mesh(n), Galerkin{0, 0.63}) == 0);
    }
    for (const int n : {1, 2, 3, 7, 14, 20, 40, 80, 160}) {
        CAPTURE(n);
        CHECK(unstable_modes(cosine_mesh(n), Collocation{0.5, 0.5}) == 0);
        CHECK(unstable_modes(cosine_mesh(n), Collocation{0.5, 0.5}, plane(1000)) == 0);
    }
    // the paper's scheme loses stability as n grows, and regains it
    CHECK(unstable_modes(uniform_mesh(160), Collocation{0, 0.63}) == 2);
    CHECK(unstable_modes(uniform_mesh(166), Collocation{0, 0.63}) == 0);
    // an unstable interval of alpha_T
    CHECK(unstable_modes(uniform_mesh(40), Collocation{0, 0.7680}) == 0);
    CHECK(unstable_modes(uniform_mesh(40), Collocation{0, 0.7700}) == 1);
    CHECK(unstable_modes(uniform_mesh(40), Collocation{0, 0.7760}) == 1);
    CHECK(unstable_modes(uniform_mesh(40), Collocation{0, 0.7770}) == 0);
    CHECK(unstable_modes(uniform_mesh(40), Collocation{0, 0.7830}) == 0);
    CHECK(unstable_modes(uniform_mesh(40), Collocation{0, 0.7850}) == 2);
}

TEST_CASE("Node differences are stable at every size and aspect", "[stability]") {
    for (const double poisson_ratio : {0.0, 0.25, 0.5}) {
        for (const double aspect : {0.5, 2.0, 30.0, 1000.0}) {
            for (const int n : {1, 2, 3, 4, 5, 7, 10, 16, 25, 39, 64}) {
                const PlaneKernel<double> kernel(aspect, 1 - poisson_ratio, poisson_ratio);
                CAPTURE(poisson_ratio, aspect, n);
                CHECK(unstable_modes(cosine_mesh(n), NodeDifference{Nodes::centres}, kernel) == 0);
                CHECK(unstable_modes(cosine_mesh(n), NodeDifference{Nodes::chebyshev}, kernel) == 0);
                CHECK(unstable_modes(uniform_mesh(n), NodeDifference{Nodes::centres}, kernel) == 0);
            }
        }
    }
}

TEST_CASE("A lambda below one half removes the instability of finite differences", "[stability]") {
    for (const int n : {20, 60}) {
        for (const double alpha : {0.7, 0.85, 1.0}) {
            CAPTURE(n, alpha);
            const Collocation fd{0, alpha, Derivative::finite_difference, 0.45};
            CHECK(unstable_modes(uniform_mesh(n), fd) == 0);
            CHECK(unstable_modes(uniform_mesh(n), Collocation{alpha, alpha, Derivative::finite_difference, 0.45}) == 0);
            CHECK(unstable_modes(geometric_mesh(n, 2.0), fd) == 0);
            CHECK(unstable_modes(knothe_mesh(n, 0.4), fd) == 0);
            CHECK(unstable_modes(modified_knothe_mesh(n, 0.4), fd) == 0);
            CHECK(unstable_modes(cosine_mesh(n), fd) == 0);
            CHECK(unstable_modes(uniform_mesh(n), Collocation{0, alpha, Derivative::analytic, 0.45}) == 0);
            CHECK(unstable_modes(uniform_mesh(n), Galerkin{0, alpha, Derivative::analytic, 0.45}) == 0);
        }
    }
    CHECK(unstable_modes(uniform_mesh(60), Collocation{0, 0.85}) > 0);
    CHECK(unstable_modes(cosine_mesh(60), Collocation{0, 0.85, Derivative::analytic, 0.45}) > 0);
    CHECK(unstable_modes(knothe_mesh(60, 0.1), Collocation{0, 0.63, Derivative::analytic, 0.45}) > 0);
}

TEST_CASE("A sign is settled if and only if it exceeds its uncertainty", "[stability]") {
    // the uncertainty of both eigenvalues is 2 eps
    const double eps = std::numeric_limits<double>::epsilon();
    const auto settle = [](double second) {
        return judge_stability(system_of(Matrix::Identity(2, 2), Eigen::Vector2d(1, second).asDiagonal()));
    };
    const StabilityResult open = settle(1.5 * eps);
    CHECK(open.unstable_count == 2);
    CHECK(open.settled_unstable_count == 1);
    CHECK(open.uncertain_count == 1);
    const StabilityResult settled = settle(2.5 * eps);
    CHECK(settled.settled_unstable_count == 2);
    CHECK(settled.uncertain_count == 0);
}

TEST_CASE("The fast count does not take a neutral mode for an unstable one", "[stability]") {
    const StabilityResult::Count count =
        count_unstable(system_of(Eigen::Vector2d(1, 0).asDiagonal(), -Matrix::Identity(2, 2)));
    CHECK(count.status == Status::ok);
    CHECK(count.unstable_count == 0);
}

TEST_CASE("A mode that neither grows nor decays is not proved to decay, however it is turned", "[stability]") {
    int undecided = 0;
    for (unsigned scene = 0; scene < 100; ++scene) {
        const Matrix Q = random_orthogonal(4, scene);
        const Eigen::Vector4d modes(-0.5, -0.7, -0.9, 1e-17);
        const StabilityVerdict verdict = judge_stability(RollingSystem<double>(
            MatrixX<double>::Identity(4, 4), Q * modes.asDiagonal() * Q.transpose(), ArrayX<double>::Ones(4)));
        CHECK_FALSE(verdict.stable());
        undecided += verdict.unstable_count == 0 ? 1 : 0;
    }
    CHECK(undecided > 20);
}

}  // namespace
}  // namespace stability_tests
