// rollbem/elasticity/line_kernel.hpp and rollbem/assembly/detail/delta_part.hpp
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/line.hpp>

#include "support/brute_force.hpp"
#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace {

using namespace rollbem;
using brute_force::Real;

using Strip = StripKernel<double>;
static_assert(LineKernel<Strip> && LineKernel<LayeredKernel<LayeredKernel<Strip>>>);

/// The share of [from, to] that lies in element m; for a point, 1 inside and 1/2 on an edge.
Real share(const brute_force::Mesh& mesh, Eigen::Index m, brute_force::Place from, brute_force::Place to) {
    const brute_force::Place trailing = brute_force::edge(mesh, m), leading = brute_force::edge(mesh, m + 1);
    const Real rounding = mesh.widths()[m] * 1e-12L;
    const Real length = to - from;
    if (length == 0) {
        const Real behind = from - trailing, ahead = leading - from;
        if (behind < -rounding || ahead < -rounding) return 0;
        return behind > rounding && ahead > rounding ? Real(1) : Real(0.5);
    }
    const Real start = std::max(from - from, trailing - from), end = std::min(to - from, leading - from);
    return std::max(Real(0), end - start) / length;
}

brute_force::Place shifted(const brute_force::Place& place, Real distance) {
    return {place.from_trailing + distance, place.from_leading - distance};
}

/// What a layer of compliance 1 adds to row l of G, or of G' by finite differences.
std::vector<Real> delta_row(const brute_force::Mesh& mesh, const brute_force::Rows& rows, bool slope, Eigen::Index l) {
    const Eigen::Index n = mesh.size(), own = l + rows.first;
    const Real along = (brute_force::centre(mesh, own) - brute_force::centre(mesh, 0)) /
                       (brute_force::centre(mesh, n - 1) - brute_force::centre(mesh, 0));
    const Real alpha = rows.alpha_T + along * (rows.alpha_L - rows.alpha_T), width = mesh.widths()[own],
               interval = width * rows.length;
    const int averages = rows.averages - (slope ? 1 : 0);
    std::vector<Real> result(static_cast<std::size_t>(n - rows.less), 0);
    for (const auto& [node, weight] : rows.samples) {
        const brute_force::Place point = shifted(brute_force::centre(mesh, own), (alpha + node / 2) * width);
        const auto traction = [&](Eigen::Index m, Real distance) {
            const brute_force::Place at = shifted(point, distance);
            return averages == 0 ? share(mesh, m, at, at)
                                 : share(mesh, m, shifted(at, -interval / 2), shifted(at, interval / 2));
        };
        for (std::size_t i = 0; i < result.size(); ++i) {
            const Eigen::Index m = static_cast<Eigen::Index>(i);
            if (rows.nodes) {
                const brute_force::Place from = brute_force::node_place(mesh, *rows.nodes, own);
                const brute_force::Place to = brute_force::node_place(mesh, *rows.nodes, own + 1);
                const Real half = (to - from) / 2, clear = std::min(half, brute_force::edge(mesh, own + 1) - from);
                const brute_force::Place middle = shifted(from, clear);
                const Real end = own + 1 == n ? 0 : share(mesh, m, to, to);  // no layer ahead of the contact
                result[i] = slope ? (end - share(mesh, m, from, from)) / (2 * half) : share(mesh, m, middle, middle);
                continue;
            }
            result[i] +=
                weight * (slope ? (traction(m, interval / 2) - traction(m, -interval / 2)) / interval : traction(m, 0));
        }
    }
    return result;
}

TEST_CASE("A layer adds its geometric share to every entry, however the rest is computed", "[layer]") {
    const double L = 0.375;
    const Eigen::Index n = 9;
    const std::vector<brute_force::NamedMesh<double>> meshes = brute_force::every_mesh<double>(n);
    const std::vector<brute_force::NamedMesh<Real>> exact = brute_force::every_mesh<Real>(n);
    int refused = 0;
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        for (const auto& [scheme_name, scheme] : brute_force::every_scheme()) {
            const auto check = [&, &scheme_name = scheme_name, &s = scheme](const auto& kernel,
                                                                            const char* kernel_name) {
                const LayeredKernel layered(kernel, L);
                const Mesh<double>& mesh = meshes[k].mesh;
                CAPTURE(meshes[k].name, scheme_name, kernel_name);
                for (const bool slope : {false, true}) {
                    const brute_force::Rows rows = brute_force::rows_of(s, slope);
                    if (slope && rows.averages == 0) {
                        CHECK_THROWS_AS(assemble_G_prime(mesh, s, layered), std::invalid_argument);
                        ++refused;
                        continue;
                    }
                    const MatrixX<double> with =
                        slope ? assemble_G_prime(mesh, s, layered) : assemble_G(mesh, s, layered);
                    const MatrixX<double> without =
                        slope ? assemble_G_prime(mesh, s, kernel) : assemble_G(mesh, s, kernel);
                    double largest = 0;
                    for (Eigen::Index l = 0; l < with.rows(); ++l) {
                        const std::vector<Real> row = delta_row(exact[k].mesh, rows, slope, l);
                        const double scale = without.row(l).cwiseAbs().maxCoeff() + L / mesh.widths().minCoeff();
                        for (Eigen::Index m = 0; m < with.cols(); ++m) {
                            const double added = L * static_cast<double>(row[static_cast<std::size_t>(m)]);
                            largest = std::max(largest, std::abs(with(l, m) - without(l, m) - added) / scale);
                        }
                    }
                    CAPTURE(slope, largest);
                    CHECK(largest < 1e-14);
                    // L = 0 is the kernel without a layer
                    const LayeredKernel none(kernel, 0);
                    CHECK((slope ? assemble_G_prime(mesh, s, none) : assemble_G(mesh, s, none)) == without);
                }
            };
            check(PlaneKernel<double>(16.0, 0.75, 0.25), "plane");  // a logarithm
            check(Strip(1024.0, 0.75, 0.25), "strip 1024");         // and a smooth part by interpolation
            check(Strip(0.25, 0.75, 0.25), "strip 0.25");           // by quadrature
        }
    }
    CHECK(refused > 0);
}

TEST_CASE("Nested layers add up, also in a product without a matrix", "[layer]") {
    const Mesh<double> mesh = cosine_mesh<double>(50);
    const PlaneKernel<double> plane(100.0, 0.72, 0.28);
    const LayeredKernel once(plane, 0.75);
    const LayeredKernel twice(LayeredKernel(plane, 0.25), 0.5);
    CHECK(twice.half_width() == 100);
    CHECK(twice.lambda() == plane.lambda());
    const MatrixX<double> G_prime = assemble_G_prime(mesh, Collocation{}, once);
    CHECK(assemble_G(mesh, Collocation{}, once) == assemble_G(mesh, Collocation{}, twice));
    CHECK(G_prime == assemble_G_prime(mesh, Collocation{}, twice));
    const VectorX<double> p = VectorX<double>::LinSpaced(50, 1, 3);
    const VectorX<double> product = detail::influence_product<double>(
        mesh, scheme_rows(Collocation{}, Quantity::slope, mesh), detail::KernelView<double>(once), Quantity::slope, p);
    CHECK((product - G_prime * p).norm() < 1e-13 * product.norm());
}

TEST_CASE("Steady friction on a layer agrees with CONTACT", "[layer]") {
    const double nu = 0.28, mu_p0 = 1e-3;
    const Contact contact = Contact::dimensionless(1000, nu);
    const auto force = [&](double L, double delta, Eigen::Index n) {
        const Mesh<double> mesh = uniform_mesh<double>(n);
        const FrictionModel model(
            contact, steady_system(mesh, Collocation{}, LayeredKernel(PlaneKernel<double>::longitudinal(contact), L)),
            {1, mu_p0 * mean_hertz_pressure(mesh)});
        const FrictionStep step = Run(model).steady({.motion = Creepage{2 * (1 - nu) * mu_p0 * delta}});
        REQUIRE(step.status == Status::ok);
        return -step.force.longitudinal / (contact.width() * mu_p0 * std::numbers::pi / 2);
    };
    struct Row {
        double L, delta, at[3], contact_160;
    };
    for (const Row& row :
         {Row{0.5, 0.25, {0.3071, 0.3046, 0.3033}, 0.3034}, Row{0.5, 1, {0.8580, 0.8514, 0.8480}, 0.8481},
          Row{2, 0.5, {0.3059, 0.3028, 0.3013}, 0.3014}}) {
        const double found[] = {force(row.L, row.delta, 40), force(row.L, row.delta, 80), force(row.L, row.delta, 160)};
        CAPTURE(row.L, row.delta, found[0], found[1], found[2]);
        for (int k = 0; k < 3; ++k) CHECK(std::abs(found[k] - row.at[k]) < 6e-5);
        CHECK(std::abs(found[2] - row.contact_160) < 1.6e-4);
    }
    // without the layer: Carter
    CHECK(std::abs(force(0, 0.25, 160) - (0.5 - 0.0625)) < 2e-3);
}

TEST_CASE("Layers reject analytic derivatives and states", "[layer]") {
    const PlaneKernel<double> plane(100.0, 0.75, 0.25);
    const Mesh<double> mesh = cosine_mesh<double>(10);
    const LayeredKernel layered(plane, 0.5);
    const std::string why =
        "LayeredKernel: compliance = 0.5 must be 0 where the derivative is analytic: the layer's displacement jumps at "
        "the edges of elements; take Derivative::finite_difference, or Galerkin in closed form";
    const Collocation analytic{0.5, 0.5, Derivative::analytic};
    CHECK(refusal([&] { solve_steady(mesh, analytic, layered); }) == why);
    CHECK(refusal([&] { rolling_system(mesh, analytic, layered); }) == why);
    CHECK(refusal([&] { rolling_system(mesh, KnotheBoundary{Derivative::analytic}, layered); }) == why);
    CHECK(refusal([&] { rolling_system(mesh, Galerkin{0.5, 0.5, Derivative::analytic, 1, 7}, layered); }) == why);
    CHECK_NOTHROW(rolling_system(mesh, Galerkin{0.5, 0.5, Derivative::analytic}, layered));
    const LayeredKernel narrow(PlaneKernel<double>(0.1, 0.75, 0.25), 0.5);  // outside the plane model
    CHECK(refusal([&] { rolling_system(mesh, Collocation{}, narrow); }).find("Lambda") != std::string::npos);
    CHECK_NOTHROW(solve_steady(mesh, analytic, LayeredKernel(plane, 0)));
    CHECK(rolling_system(mesh, Collocation{}, plane).log_strength().has_value());
    CHECK_FALSE(rolling_system(mesh, Collocation{}, layered).log_strength().has_value());  // it cannot breathe
    const std::string states = "Chebyshev: compliance of the kernel's delta = 0.5 must be 0: use elements for a layer";
    CHECK(refusal([&] { rolling_system(Chebyshev{}, layered); }) == states);
    CHECK(refusal([&] { solve_steady(Chebyshev{}, layered); }) == states);
}

}  // namespace
