// rollbem/assembly/patch_system.hpp, elasticity/patch_kernel.hpp: entries of G and G' against quadrature, long
// double and the strip, and the waist's inputs and outputs.
#include <cmath>
#include <numbers>

#include <rollbem/adhesion/response.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/detail/gauss_legendre.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/elasticity/patch_kernel.hpp>

#include "support/catch.hpp"
#include "support/moved_mesh.hpp"
#include "support/refusal.hpp"

namespace patch_system_tests {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using Matrix = MatrixX<double>;

constexpr NodeDifference chebyshev{Nodes::chebyshev};

double largest(const Matrix& matrix) { return matrix.cwiseAbs().maxCoeff(); }

/// The least a kernel needs.
struct OwnKernel {
    using Scalar = double;
    HalfSpace<double> half_space{0.3};

    RectangleInfluence<double> corner(double x, double y) const { return half_space.corner(x, y); }
    bool couples() const { return true; }
};
static_assert(RectangleKernel<OwnKernel> && RectangleKernel<HalfSpace<double>>);

/// Boussinesq and Cerruti: displacement at (x, y) by a unit force at the origin, both bodies.
RectangleInfluence<double> point_force(double nu, double x, double y) {
    const double r = std::hypot(x, y), cube = std::numbers::pi * r * r * r;
    return {((1 - nu) * r * r + nu * x * x) / cube, nu * x * y / cube, ((1 - nu) * r * r + nu * y * y) / cube};
}

}  // namespace

TEST_CASE("patch_system: each strip has the layer and the intervals of a line of its length") {
    const NodeDifference scheme{GENERATE(Nodes::centres, Nodes::chebyshev)};
    const double L = 0.7;
    const auto contact = PatchContact::dimensionless(2, 0.3);
    const PatchMesh<double> mesh = patch_mesh(contact, 6, 4);
    const auto layered = rolling_system(mesh, scheme, HalfSpace<double>(0.3, L)).joined(),
               bare = rolling_system(mesh, scheme, HalfSpace<double>(0.3)).joined();
    const auto line = PlaneKernel<double>::longitudinal(Contact::dimensionless(100, 0.3));
    const auto with = rolling_system(mesh.along(), scheme, LayeredKernel(line, L)),
               without = rolling_system(mesh.along(), scheme, line);
    Matrix G = bare.G(), G_prime = bare.G_prime();
    for (Eigen::Index j = 0; j < 2 * 4; ++j) {
        G.block(6 * j, 6 * j, 6, 6) += with.G() - without.G();
        G_prime.block(6 * j, 6 * j, 6, 6) += (with.G_prime() - without.G_prime()) / mesh.half_lengths()[j % 4];
    }
    CHECK(largest(layered.G() - G) < 1e-13);
    CHECK(largest(layered.G_prime() - G_prime) < 1e-12);
    CHECK(largest(layered.G() - bare.G()) > 0.9 * L);
    const ArrayX<double> all = patch_elements(mesh, scheme).intervals, one = without.elements().intervals;
    for (Eigen::Index j = 0; j < 4; ++j) {
        CHECK((all.segment(6 * j, 6) / mesh.half_lengths()[j] - one).abs().maxCoeff() < 1e-14);
    }
    CHECK_THROWS_WITH(breathing_system(contact, mesh, scheme, HalfSpace<double>(0.3, L)),
                      ContainsSubstring("layer_compliance"));
}

TEST_CASE("rectangle_kernel: corners give the integral of point forces") {
    const double nu = 0.3, x0 = -0.2, x1 = 0.3, y0 = 0.1, y1 = 0.4;
    const HalfSpace<double> kernel(nu);
    const auto rule = detail::gauss_legendre<double>(40);
    for (const auto& [x, y] :
         {std::pair{1.0, 0.7}, std::pair{-0.5, 0.2}, std::pair{0.05, -0.4}, std::pair{-0.1, 1.0}}) {
        RectangleInfluence<double> integral;
        for (Eigen::Index i = 0; i < 40; ++i) {
            for (Eigen::Index k = 0; k < 40; ++k) {
                const double u = (x0 + x1 + rule.nodes[i] * (x1 - x0)) / 2,
                             v = (y0 + y1 + rule.nodes[k] * (y1 - y0)) / 2;
                integral = integral + (rule.weights[i] * rule.weights[k] * (x1 - x0) * (y1 - y0) / 4) *
                                          point_force(nu, x - u, y - v);
            }
        }
        const RectangleInfluence<double> sum = (kernel.corner(x - x0, y - y0) - kernel.corner(x - x1, y - y0)) -
                                               (kernel.corner(x - x0, y - y1) - kernel.corner(x - x1, y - y1));
        CHECK_THAT(sum.xx, WithinRel(integral.xx, 1e-11));
        CHECK_THAT(sum.yy, WithinRel(integral.yy, 1e-11));
        CHECK_THAT(sum.xy, WithinAbs(integral.xy, 1e-14));
        // du/dx of a line: the difference of point forces' displacement, to second order
        const double step = 1e-4;
        RectangleInfluence<double> slope;
        for (Eigen::Index k = 0; k < 40; ++k) {
            const double v = (y0 + y1 + rule.nodes[k] * (y1 - y0)) / 2;
            slope = slope + (rule.weights[k] * (y1 - y0) / 2 / (2 * step)) *
                                (point_force(nu, x + step, y - v) - point_force(nu, x - step, y - v));
        }
        const RectangleInfluence<double> line = kernel.line_slope(x, y - y0, y - y1);
        CHECK_THAT(line.xx, WithinRel(slope.xx, 1e-5));
        CHECK_THAT(line.yy, WithinRel(slope.yy, 1e-5));
        CHECK_THAT(line.xy, WithinAbs(slope.xy, 1e-6));
    }
    // the middle of a square with half-side 1: the integral of 1/(pi r)
    const RectangleInfluence<double> corner = HalfSpace<double>(0).corner(1, 1);
    CHECK_THAT(4 * corner.xx, WithinRel(8 * std::asinh(1.0) / std::numbers::pi, 1e-15));
    for (const auto& [x, y] : {std::pair{0.0, 1.0}, std::pair{1.0, 0.0}, std::pair{0.0, 0.0}}) {
        CHECK(std::abs(kernel.corner(x, y).xx) < 1e-200);
        CHECK(std::abs(kernel.corner(x, y).yy) < 1e-200);
    }
    CHECK_THAT(refusal([] { HalfSpace<double>(0.6); }), ContainsSubstring("poisson_ratio = 0.6"));
}

TEST_CASE("patch_system: a rectangle of one strip has the matrices of the strip contact") {
    const double b = 3;
    const Mesh<double> along = cosine_mesh(12);
    const ArrayX<double> ends = (ArrayX<double>(2) << -b, b).finished(), ones = ArrayX<double>::Ones(2);
    const PatchMesh<double> rectangle =
        outline_mesh<double>(PatchContact::Outline(ends, -ones, ones), 1, along, uniform_mesh(1));
    const Contact contact = Contact::dimensionless(b, 0.3);
    const ElementSystem<double, 2> patch = rolling_system(rectangle, chebyshev, HalfSpace<double>(0.3));
    for (const std::size_t d : {0, 1}) {
        const auto kernel = d == 0 ? StripKernel<double>::longitudinal(contact) : StripKernel<double>::lateral(contact);
        const ElementSystem<double> line = rolling_system(along, chebyshev, kernel);
        CHECK(largest(patch.G(d, d) - line.G()) < 1e-13 * largest(line.G()));
        CHECK(largest(patch.G_prime(d, d) - line.G_prime()) < 1e-13 * largest(line.G_prime()));
    }
    CHECK(largest(patch.G_prime(0, 1)) < 1e-15);
}

TEST_CASE("patch_system: distant entries do not cancel") {
    // relative to the entry: differences alone lose 1e-6 and more in double
    const double worst_allowed = 1e-10;
    for (const double a_over_b : {1e-4, 0.1, 1.0, 10.0}) {
        const auto entries = [&](auto scalar) {
            using Scalar = decltype(scalar);
            return detail::patch_blocks(
                ellipse_mesh<Scalar>(static_cast<Scalar>(a_over_b), cosine_mesh<Scalar>(16), cosine_mesh<Scalar>(16)),
                chebyshev, HalfSpace<Scalar>(Scalar(0.25)), Quantity::slope);
        };
        const auto in_double = entries(1.0);
        const auto exact = entries(1.0L);
        for (const std::size_t d : {0, 1}) {
            for (const std::size_t e : {0, 1}) {
                const auto scale = exact[d][d].cwiseAbs() + exact[0][1].cwiseAbs();
                const auto error = (in_double[d][e].cast<long double>() - exact[d][e]).cwiseAbs();
                const long double worst = error.cwiseQuotient(scale).maxCoeff();
                INFO("a/b " << a_over_b << ", block " << d << e << ": " << worst);
                CHECK(worst < worst_allowed);
            }
        }
    }
}

TEST_CASE(
    "patch_system: the coupling of wide strips is its mean over their width, otherwise the value at their middles") {
    const auto rule = detail::gauss_legendre<double>(40);
    const HalfSpace<double> kernel(0.4);
    for (const double a_over_b : {0.05, 0.2}) {  // above and below 13 lengths, below and above 1.6 for each strip
        const PatchMesh<double> mesh = ellipse_mesh<double>(a_over_b, cosine_mesh(5), uniform_mesh(4));
        const bool wide = detail::has_wide_strips(mesh);
        CHECK(wide == (a_over_b < 0.1));
        // the mean over y of a quantity in strip j by elements of strip k, as their middle or their width sees it
        const auto expected = [&](const auto& of, Eigen::Index j, Eigen::Index k) {
            const auto at = [&](double y) { return of(y - mesh.lower()[k]) - of(y - mesh.upper()[k]); };
            if (!wide) return at(mesh.middles_y()[j]);
            double mean = 0;
            for (Eigen::Index i = 0; i < 40; ++i) {  // close to the edges, where slopes change rapidly
                const double angle = std::numbers::pi / 2 * rule.nodes[i],
                             weight = std::numbers::pi / 4 * rule.weights[i];
                mean += weight * std::cos(angle) * at(mesh.middles_y()[j] + std::sin(angle) / 2 * mesh.widths()[j]);
            }
            return mean;
        };
        const auto rows = [&](Quantity quantity) { return detail::strip_rows(mesh.along(), chebyshev, quantity); };
        const auto slope = rows(Quantity::slope), places = rows(Quantity::displacement);
        const auto G_prime = detail::patch_rows(mesh, slope, kernel, Quantity::slope, wide).xy;
        const auto G = detail::patch_rows(mesh, places, kernel, Quantity::displacement, wide).xy;
        const auto G_y =
            detail::patch_rows(mesh, detail::at_points(slope), detail::LateralSlope<HalfSpace<double>>{kernel},
                               Quantity::displacement, wide)
                .xy;
        const ArrayX<double> edges = mesh.along().edges();
        const Eigen::Index j = 1;
        for (const Eigen::Index k : {0, 1, 3}) {
            for (const Eigen::Index r : {0, 2}) {
                const double scale = mesh.half_lengths()[j], from = mesh.half_lengths()[k];
                const auto by = [&](auto corner, double x) {
                    const auto at = [&, x](double y) {
                        return (kernel.*corner)(scale * x - from * edges[2], y).xy -
                               (kernel.*corner)(scale * x - from * edges[3], y).xy;
                    };
                    return expected(at, j, k);
                };
                const auto u = [&](double at) { return by(&HalfSpace<double>::corner, at); };
                const double half = slope.lengths[r] / 2, x = slope.points[r];
                const Eigen::Index row = j * 5 + r, column = k * 5 + 2;
                CHECK_THAT(G(row, column), WithinAbs(u(places.points[r]), 1e-7));
                CHECK_THAT(G_prime(row, column), WithinAbs((u(x + half) - u(x - half)) / (2 * half * scale), 1e-7));
                CHECK_THAT(G_y(row, column), WithinAbs(by(&HalfSpace<double>::corner_lateral_slope, x), 1e-7));
            }
        }
    }
}

TEST_CASE("patch_system: a kernel of corners alone serves") {
    const PatchMesh<double> mesh = ellipse_mesh<double>(1, cosine_mesh(8), cosine_mesh(8));
    const auto own = rolling_system(mesh, chebyshev, OwnKernel{}),
               built_in = rolling_system(mesh, chebyshev, HalfSpace<double>(0.3));
    CHECK(own.G(0, 0) == built_in.G(0, 0));
    CHECK(largest(own.G_prime(0, 0) - built_in.G_prime(0, 0)) < 1e-12);
    CHECK(largest(own.G_prime(0, 1) - built_in.G_prime(0, 1)) < 1e-12);
}

TEST_CASE("patch_system: mirrored strips are computed once, and moving the patch changes nothing") {
    for (const Eigen::Index m : {4, 5}) {
        const PatchMesh<double> mesh = ellipse_mesh<double>(0.7, cosine_mesh(6), cosine_mesh(m));
        const ElementSystem<double, 2> mirrored = rolling_system(mesh, chebyshev, HalfSpace<double>(0.4));
        const ElementSystem<double, 2> whole =
            rolling_system(support::moved(mesh, 0, 0.25), chebyshev, HalfSpace<double>(0.4));
        CHECK_FALSE(support::moved(mesh, 0, 0.25).is_mirrored());
        for (const std::size_t d : {0, 1}) {
            for (const std::size_t e : {0, 1}) {
                CHECK(largest(mirrored.G(d, e) - whole.G(d, e)) < 1e-13);
                CHECK(largest(mirrored.G_prime(d, e) - whole.G_prime(d, e)) < 1e-12);
            }
        }
    }
}

TEST_CASE("patch_system: size scales G and leaves G' alone; no coupling at nu = 0") {
    const auto patch = [](double unit) {
        const ArrayX<double> y = ArrayX<double>::LinSpaced(3, -1, 1);
        const ArrayX<double> edge = (ArrayX<double>(3) << 0.2, 1, 0.5).finished();
        return rolling_system(
            outline_mesh<double>(PatchContact::Outline(y, -edge, edge), unit, cosine_mesh(5), cosine_mesh(4)),
            NodeDifference{}, HalfSpace<double>(0.25));
    };
    const auto large = patch(0.5), small = patch(1);
    CHECK(largest(large.G(0, 0) - 2 * small.G(0, 0)) < 1e-14);
    CHECK(largest(large.G(0, 1) - 2 * small.G(0, 1)) < 1e-14);
    CHECK(largest(large.G_prime(1, 1) - small.G_prime(1, 1)) < 1e-12);

    const auto uncoupled =
        rolling_system(ellipse_mesh<double>(1, cosine_mesh(4), cosine_mesh(4)), chebyshev, HalfSpace<double>(0));
    CHECK_FALSE(uncoupled.coupled());
    CHECK(largest(uncoupled.G_prime(0, 0) - uncoupled.G_prime(1, 1)) < 1e-14);
}

TEST_CASE("patch_system: places, areas, slip and forces of the elements") {
    const PatchMesh<double> mesh = ellipse_mesh<double>(2, cosine_mesh(6), cosine_mesh(4));
    const Elements<double> elements = patch_elements(mesh, chebyshev);
    CHECK(elements.half_element_ahead);
    CHECK(elements.behind[6] == -1);
    CHECK(elements.behind[11] == 10);
    CHECK((elements.x.head(6) > elements.centre_x.head(6)).all());
    CHECK_THAT(elements.areas.sum(), WithinRel(2 * (mesh.half_lengths() * mesh.widths()).sum(), 1e-15));
    // uniform tractions p_x = y, p_y = 0 and p_x = 0, p_y = x: -int y^2, int x^2 by rectangles' middles
    const RollingSystem<double> system = rolling_system(mesh, chebyshev, HalfSpace<double>(0.2)).joined();
    REQUIRE(system.size() == 48);
    REQUIRE(system.input_count() == 3);
    VectorX<double> traction = VectorX<double>::Zero(48);
    traction.head(24) = elements.y;
    CHECK_THAT((system.outputs().transpose() * traction)[2],
               WithinRel(-(elements.areas * elements.y.square()).sum(), 1e-14));
    CHECK(system.inputs().col(2).head(24) == -elements.y.matrix());
    CHECK(system.inputs().col(2).tail(24) == elements.x.matrix());
    CHECK(system.inputs().col(0).sum() == 24);
}

TEST_CASE("patch_system: the parts of a mirrored patch respond as the whole") {
    for (const Eigen::Index m : {1, 4, 5}) {
        const PatchMesh<double> mesh = ellipse_mesh<double>(0.7, cosine_mesh(5), cosine_mesh(m));
        const HalfSpace<double> kernel(0.3);
        const std::complex<double> s(0, 0.8);
        const auto whole = solve_response(rolling_system(mesh, chebyshev, kernel).joined(), s);
        const auto parts = patch_subsystems(mesh, chebyshev, kernel);
        REQUIRE(parts.size() == 2);
        MatrixX<std::complex<double>> joined = MatrixX<std::complex<double>>::Zero(3, 3);
        Eigen::Index first = 0;
        for (const RollingSystem<double>& part : parts) {
            CHECK(part.size() == 5 * m);
            const auto response = solve_response(part, s);
            joined.block(first, first, part.input_count(), part.input_count()) = response.coefficients;
            first += part.input_count();
        }
        CHECK((joined - whole.coefficients).cwiseAbs().maxCoeff() < 1e-12);
    }
    CHECK(patch_subsystems(support::moved(ellipse_mesh<double>(1, cosine_mesh(3), cosine_mesh(3)), 0, 0.1), chebyshev,
                           HalfSpace<double>(0.3))
              .size() == 1);
}

TEST_CASE("patch_system: schemes that take no differences are refused") {
    const PatchMesh<double> mesh = ellipse_mesh<double>(1, cosine_mesh(4), cosine_mesh(4));
    const HalfSpace<double> kernel(0.3);
    const auto refused = [&](const auto& scheme) { return refusal([&] { rolling_system(mesh, scheme, kernel); }); };
    CHECK(refused(Collocation{}).empty());
    CHECK_THAT(refused(Collocation{0.5, 0.5, Derivative::analytic, 1}),
               ContainsSubstring("averages of the scheme for G"));
    CHECK_THAT(refused(Galerkin{}), ContainsSubstring("averages of the scheme for G"));
    CHECK_THAT(refused(KnotheBoundary{}), ContainsSubstring("unknown_count"));
}

}  // namespace patch_system_tests
