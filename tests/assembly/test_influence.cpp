// rollbem/assembly/rolling_system.hpp
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/steady/steady.hpp>

#include "support/brute_force.hpp"
#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace {

using namespace rollbem;
using brute_force::Real;

constexpr auto fd = Derivative::finite_difference;
constexpr auto analytic = Derivative::analytic;

template <class Scalar>
MatrixX<Scalar> build(const Mesh<Scalar>& mesh, const AnyScheme& scheme, const brute_force::Kernel& kernel,
                      bool slope) {
    return brute_force::with_library_kernel<Scalar>(
        kernel, [&](const auto& k) { return slope ? assemble_G_prime(mesh, scheme, k) : assemble_G(mesh, scheme, k); });
}

// The largest difference of two matrices over the largest entry of the second.
template <class Scalar>
double distance(const MatrixX<Scalar>& a, const MatrixX<Scalar>& b) {
    if (a.rows() != b.rows() || a.cols() != b.cols() || !a.allFinite() || !b.allFinite()) return 1e300;
    const Scalar size = std::max(b.cwiseAbs().maxCoeff(), std::numeric_limits<Scalar>::min());
    return static_cast<double>((a - b).cwiseAbs().maxCoeff() / size);
}

// The given mesh marked as not uniform: no shortcut for equal widths.
template <class Scalar>
Mesh<Scalar> as_general(const Mesh<Scalar>& mesh) {
    return Mesh<Scalar>({mesh.widths(), mesh.edges_from_trailing(), mesh.edges_from_leading(), false});
}

TEMPLATE_TEST_CASE("Every entry of G and G' agrees with brute force", "[influence]", SCALARS) {
    using Scalar = TestType;
    for (const Eigen::Index n : {3, 11}) {
        const auto meshes = brute_force::every_mesh<Scalar>(n);
        const auto exact_meshes = brute_force::every_mesh<Real>(n);
        auto schemes = brute_force::every_scheme();
        schemes.push_back({"nodes chebyshev", NodeDifference{Nodes::chebyshev}});
        for (const auto& [kernel_name, kernel] : brute_force::every_kernel()) {
            for (const auto& [scheme_name, scheme] : schemes) {
                for (std::size_t i = 0; i < meshes.size(); ++i) {
                    if (scheme_name == "nodes chebyshev" && meshes[i].name != "cosine") continue;
                    for (const bool slope : {true, false}) {
                        const MatrixX<Scalar> matrix = build(meshes[i].mesh, scheme, kernel, slope);
                        const Real error =
                            brute_force::largest_error(matrix, kernel, exact_meshes[i].mesh, scheme, slope);
                        const double in_eps = static_cast<double>(error / std::numeric_limits<Scalar>::epsilon());
                        CAPTURE(n, kernel_name, scheme_name, meshes[i].name, slope, in_eps);
                        // third differences cancel more, and so does the logarithm, b/d of which is left far from
                        // elements on a narrow strip
                        const bool third = scheme_name.find("exact fd") != std::string::npos;
                        CHECK(in_eps < (kernel.b < 1 ? (third ? 8e4 : 4e4) : third ? 4e4 : 4e3));
                    }
                }
            }
        }
    }
}

TEMPLATE_TEST_CASE("Equal alphas on a uniform mesh give Toeplitz matrices equal to the general ones", "[influence]",
                   SCALARS) {
    using Scalar = TestType;
    const double eps = static_cast<double>(std::numeric_limits<Scalar>::epsilon());
    for (const Eigen::Index n : {1, 2, 3, 4, 5, 16, 33}) {
        const Mesh<Scalar> mesh = uniform_mesh<Scalar>(n), general = as_general(mesh);
        for (const auto& [kernel_name, kernel] : brute_force::every_kernel()) {
            for (const double alpha : {-1.5, -0.5, 0.0, 0.25, 0.5, 0.63, 1.0, 1.5, 2.0}) {
                for (const AnyScheme& scheme :
                     std::vector<AnyScheme>{Collocation{alpha, alpha, fd, 0.5}, Collocation{alpha, alpha, analytic},
                                            Galerkin{alpha, alpha, fd}, Galerkin{alpha, alpha, analytic, 1, 3}}) {
                    for (const bool slope : {true, false}) {
                        const MatrixX<Scalar> fast = build(mesh, scheme, kernel, slope);
                        CAPTURE(n, kernel_name, alpha, scheme.get_if<Galerkin>() != nullptr, slope);
                        CHECK(fast.allFinite());
                        // no edges to keep clear of beyond the contact, so the last rows may differ
                        const bool at_outer_edge = std::abs(alpha) == 1.5;
                        const bool zero = n == 1 && alpha == 0 && slope;  // but for rounding
                        if (!at_outer_edge && !zero)
                            CHECK(distance(fast, build(general, scheme, kernel, slope)) < 2e4 * eps);
                        bool toeplitz = true;
                        for (Eigen::Index l = 1; l < n; ++l) {
                            toeplitz = toeplitz && fast.row(l).tail(n - 1) == fast.row(l - 1).head(n - 1);
                        }
                        if (!at_outer_edge) CHECK(toeplitz);
                    }
                }
            }
            const MatrixX<Scalar> G = build(mesh, Collocation{0, 0}, kernel, false);
            const MatrixX<Scalar> G_prime = build(mesh, Collocation{0, 0}, kernel, true);
            CAPTURE(n, kernel_name);
            CHECK(distance<Scalar>(G.transpose(), G) < 1e3 * eps);
            if (n > 1) CHECK(distance<Scalar>(-G_prime.transpose(), G_prime) < 1e3 * eps);
        }
    }
}

TEST_CASE("The guard keeps points 0.001 of a width away from edges", "[influence]") {
    const PlaneKernel<double> kernel(1000, 0.75, 0.25);
    const auto matrix = [&](const Mesh<double>& mesh, double alpha) {
        return assemble_G_prime(mesh, Collocation{alpha, alpha, analytic}, kernel);
    };
    const Mesh<double> mesh = uniform_mesh(6);
    CHECK(distance(matrix(mesh, 0.5), matrix(mesh, 0.499)) < 1e-12);
    CHECK(distance(matrix(mesh, 0.4995), matrix(mesh, 0.499)) < 1e-12);
    CHECK(distance(matrix(mesh, 0.5000001), matrix(mesh, 0.501)) < 1e-12);
    CHECK(distance(matrix(mesh, 0.5005), matrix(mesh, 0.501)) < 1e-12);
    CHECK(distance(matrix(mesh, 0.498), matrix(mesh, 0.499)) > 1e-3);
    CHECK(distance(matrix(mesh, 0.502), matrix(mesh, 0.501)) > 1e-3);
    CHECK(distance(matrix(mesh, 0.499), matrix(mesh, 0.501)) > 1e-4);
    CHECK(distance(matrix(mesh, -0.5), matrix(mesh, -0.501)) < 1e-12);  // an edge belongs to its trailing side
    CHECK(distance(matrix(mesh, -0.4995), matrix(mesh, -0.499)) < 1e-12);
    // the clearance is measured by the element that the point lies in: widths 1.5 and 0.5
    const Mesh<double> steps = mesh_from_edges<double>(Eigen::Array3d(-1, 0.5, 1));
    const double ahead = (0.75 + 0.0005) / 1.5;  // of the first element's width
    CHECK(std::abs(matrix(steps, 0.5001)(0, 1) / matrix(steps, ahead)(0, 1) - 1) < 1e-10);
    CHECK(std::abs(matrix(steps, 0.5)(0, 1) / matrix(steps, 0.499)(0, 1) - 1) < 1e-10);
    CHECK(std::abs(matrix(steps, 0.5)(1, 1) / matrix(steps, 0.499)(1, 1) - 1) < 1e-10);
    CHECK(std::abs(matrix(steps, 0.5001)(1, 1) / matrix(steps, 0.501)(1, 1) - 1) < 1e-10);  // beyond the leading edge
    // an end value of 0.5 lies on the edge on every mesh, despite round-off of the interpolation
    for (const Eigen::Index n : {3, 4, 10, 41}) {
        for (const auto& [name, each] : brute_force::every_mesh<double>(n)) {
            const MatrixX<double> ends = assemble_G_prime(each, Collocation{0, 0.5, analytic}, kernel);
            const MatrixX<double> clear = assemble_G_prime(each, Collocation{0, 0.499, analytic}, kernel);
            CAPTURE(n, name, ends(0, 0), clear(0, 0));
            CHECK(std::abs(ends(0, 0) / clear(0, 0) - 1) < 1e-10);
        }
    }
    for (const int points : {1, 2, 3, 7, 64, 1000}) {  // Gauss points may fall on edges too
        for (const double alpha : {0.5, 0.0, 1.0, 2.0}) {
            CHECK(assemble_G_prime(uniform_mesh(4), Galerkin{alpha, alpha, analytic, 1, points}, kernel).allFinite());
        }
    }
}

// The least that a kernel must provide; counts the evaluations of its smooth part.
struct MinimalKernel {
    using Scalar = double;
    double b, c1 = 0.75, c2 = 0.25;
    std::shared_ptr<Eigen::Index> evaluations = std::make_shared<Eigen::Index>(0);

    SmoothSplit<double> smooth_split() const {
        return {2 / std::numbers::pi * (c1 * std::log(2 * b) + c2), 2 / std::numbers::pi * c1, b};
    }
    double smooth_part(double x) const {
        ++*evaluations;
        const double r = std::hypot(x, b);
        return 2 / std::numbers::pi * (c1 * std::log((b + r) / (2 * b)) + c2 * (b / r - 1));
    }
    double smooth_slope(double x) const {
        ++*evaluations;
        const double r = std::hypot(x, b);
        return 2 / std::numbers::pi * x / r * (c1 / (b + r) - c2 * b / (r * r));
    }
};
static_assert(LineKernel<MinimalKernel> && LineKernel<PlaneKernel<double>> && LineKernel<StripKernel<long double>>);

TEST_CASE(
    "A kernel needs only its logarithm and a smooth part, which one assembly on a wide strip evaluates a few times",
    "[influence]") {
    for (const double b : {0.1, 1.0, 20.0}) {
        for (const Eigen::Index n : {3, 20}) {
            for (const auto& [name, mesh] : brute_force::every_mesh<double>(n)) {
                for (const auto& [scheme_name, scheme] : brute_force::every_scheme()) {
                    const MinimalKernel minimal{b};
                    const StripKernel<double> strip(b, 0.75, 0.25);
                    const auto of = [&, &mesh = mesh, &scheme = scheme](const auto& kernel, bool slope) {
                        return slope ? assemble_G_prime(mesh, scheme, kernel) : assemble_G(mesh, scheme, kernel);
                    };
                    CAPTURE(b, n, name, scheme_name);
                    CHECK(distance(of(minimal, true), of(strip, true)) < 2e-14);
                    CHECK(distance(of(minimal, false), of(strip, false)) < 2e-14);
                }
                const MinimalKernel counted{b};
                assemble_G_prime(mesh, Collocation{0, 0.63, fd}, counted);
                const Eigen::Index once = *counted.evaluations;
                CAPTURE(b, n, name, once);
                CHECK(once > 0);
                if (b > 10) CHECK(once <= 144);
                solve_steady(mesh, Collocation{0, 0.63, fd}, counted);
                CHECK(*counted.evaluations == 2 * once);
            }
        }
    }
}

TEST_CASE("The smooth part is the same by interpolation and by quadrature", "[influence]") {
    // two rows alone are integrated one by one, all rows together interpolated
    for (const double b : {0.5, 8.0}) {
        const StripKernel<double> kernel(b, 0, 1);  // no logarithm, whose rounding is larger
        for (const auto& [name, mesh] : brute_force::every_mesh<double>(80)) {
            for (const auto& [scheme_name, scheme] : brute_force::every_scheme()) {
                for (const Quantity quantity : {Quantity::slope, Quantity::displacement}) {
                    const SchemeRows<double> rows = scheme_rows(scheme, quantity, mesh);
                    const MatrixX<double> whole = detail::influence_matrix<double>(mesh, rows, kernel, quantity);
                    MatrixX<double> part(2, 2);
                    detail::influence_rows<double>(mesh, rows, rows.first_equation, kernel, quantity, part);
                    CAPTURE(b, name, scheme_name, quantity);
                    CHECK((part - whole.topLeftCorner(2, 2)).cwiseAbs().maxCoeff() <
                          3e-14 * whole.cwiseAbs().maxCoeff());
                }
            }
        }
    }
}

TEST_CASE("Extreme grading loses no more digits than the ratio of element sizes explains", "[influence]") {
    const auto check = [](const Mesh<double>& mesh, const Mesh<Real>& exact, double limit) {
        for (const AnyScheme& scheme : std::vector<AnyScheme>{Collocation{0, 0.625}, Collocation{0, 0.625, analytic}}) {
            for (const brute_force::Kernel& kernel :
                 {brute_force::Kernel{true, 1024, 0.75L, 0.25L}, brute_force::Kernel{false, 1, 0.75L, 0.25L}}) {
                for (const bool slope : {true, false}) {
                    const double error = static_cast<double>(
                        brute_force::largest_error(build(mesh, scheme, kernel, slope), kernel, exact, scheme, slope));
                    CAPTURE(mesh.widths()[0], mesh.widths()[mesh.size() - 1], kernel.plane, slope, error);
                    CHECK(error < limit);
                }
            }
        }
    };
    check(knothe_mesh(8, 1e-8), knothe_mesh<Real>(8, 1e-8L), 1e-6);
    check(modified_knothe_mesh(8, 1e-8), modified_knothe_mesh<Real>(8, 1e-8L), 1e-6);
    check(geometric_mesh(12, 1e6), geometric_mesh<Real>(12, 1e6L), 1e-9);
    check(geometric_mesh(12, 1e-6), geometric_mesh<Real>(12, 1e-6L), 1e-9);
}

TEST_CASE("Assembly rejects infinite widths where G is needed, and invalid kernels", "[influence]") {
    const double infinity = std::numeric_limits<double>::infinity();
    const PlaneKernel<double> plane(infinity, 0.75, 0.25);
    CHECK(assemble_G_prime(uniform_mesh(4), Collocation{}, plane).allFinite());
    CHECK(assemble_G_prime(cosine_mesh(4), Collocation{0.5, 0.5, analytic}, StripKernel<double>(infinity, 0.75, 0.25))
              .allFinite());
    CHECK(distance(assemble_G_prime(cosine_mesh(4), Collocation{}, plane),
                   assemble_G_prime(cosine_mesh(4), Collocation{}, PlaneKernel<double>(7, 0.75, 0.25))) < 1e-13);
    CHECK_THROWS_WITH(assemble_G(uniform_mesh(4), Collocation{}, plane),
                      Catch::Matchers::ContainsSubstring("an infinite aspect is for steady problems only"));
    CHECK_THROWS_WITH(assemble_G_prime(uniform_mesh(4), Collocation{}, MinimalKernel{-1}),
                      Catch::Matchers::ContainsSubstring("distance of the kernel's smooth part = -1 must be positive"));
}

}  // namespace
