// rollbem/discretisation/mesh.hpp
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string_view>
#include <type_traits>

#include <rollbem/discretisation/mesh.hpp>

#include "support/brute_force.hpp"
#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace {

using namespace rollbem;
using brute_force::Real;

// Largest relative difference in units of Scalar's epsilon; zeros must match exactly.
template <class A, class B>
double in_eps(const A& values, const B& exact) {
    if (values.size() != exact.size()) return 1e300;
    double largest = 0;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        const Real value = static_cast<Real>(values[i]), reference = static_cast<Real>(exact[i]);
        const Real error = reference == 0 ? (value == 0 ? 0 : 1e300L) : std::abs(value / reference - 1);
        largest = std::max(largest, static_cast<double>(error / std::numeric_limits<typename A::Scalar>::epsilon()));
    }
    return largest;
}

TEMPLATE_TEST_CASE("Meshes are consistent and accurate to round-off", "[mesh]", SCALARS) {
    using Scalar = TestType;
    const double eps = static_cast<double>(std::numeric_limits<Scalar>::epsilon());
    for (const Eigen::Index n : {3, 4, 17, 40, 1000, 10000}) {
        const auto meshes =
            n <= 1000 ? brute_force::every_mesh<Scalar>(n) : brute_force::mesh_of_every_topology<Scalar>(n);
        const auto exact = n <= 1000 ? brute_force::every_mesh<Real>(n) : brute_force::mesh_of_every_topology<Real>(n);
        REQUIRE(meshes.size() == exact.size());
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            const Mesh<Scalar>& mesh = meshes[i].mesh;
            const Mesh<Real>& fine = exact[i].mesh;
            CAPTURE(n, meshes[i].name);
            REQUIRE(mesh.size() == n);
            // all arrays against long double, with relative accuracy even next to an edge of the contact
            CHECK(in_eps(mesh.widths(), fine.widths()) < 40);
            CHECK(in_eps(mesh.edges_from_trailing(), fine.edges_from_trailing()) < 40);
            CHECK(in_eps(mesh.edges_from_leading(), fine.edges_from_leading()) < 40);
            CHECK(in_eps(mesh.from_trailing(), fine.from_trailing()) < 40);
            CHECK(in_eps(mesh.from_leading(), fine.from_leading()) < 40);
            CHECK(static_cast<double>((mesh.centres().template cast<Real>() - fine.centres()).abs().maxCoeff()) <
                  4 * eps);
            // and against each other, besides what a mesh refuses
            const Eigen::Array<Real, Eigen::Dynamic, 1> trailing = fine.edges_from_trailing();
            const Eigen::Array<Real, Eigen::Dynamic, 1> leading = fine.edges_from_leading();
            Real mismatch = 0;
            for (Eigen::Index e = 0; e < n; ++e) {
                const Real width = trailing[e] < 1 ? trailing[e + 1] - trailing[e] : leading[e] - leading[e + 1];
                mismatch = std::max(mismatch, std::abs(width / fine.widths()[e] - 1));
            }
            CHECK(static_cast<double>(mismatch) < 1e-14);
        }
    }
}

TEST_CASE("Edges of the cosine and the uniform mesh follow their formulas", "[mesh]") {
    for (const Eigen::Index n : {3, 10, 10000}) {
        const Mesh<double> cosine = cosine_mesh(n), uniform = uniform_mesh(n);
        CAPTURE(n);
        for (Eigen::Index j = 0; j <= n; ++j) {
            const Real angle = std::numbers::pi_v<Real> * static_cast<Real>(j) / static_cast<Real>(n);
            CHECK(std::abs(static_cast<Real>(cosine.edges()[j]) + std::cos(angle)) < 4.5e-16L);
            const Real line = -1 + 2 * static_cast<Real>(j) / static_cast<Real>(n);
            CHECK(std::abs(static_cast<Real>(uniform.edges()[j]) - line) < 3e-16L);
        }
        const Real first = 2 * std::pow(std::sin(std::numbers::pi_v<Real> / static_cast<Real>(2 * n)), Real(2));
        CHECK(std::abs(cosine.widths()[0] / static_cast<double>(first) - 1) < 1e-15);
        CHECK(uniform.is_uniform());
        CHECK_FALSE(cosine.is_uniform());
    }
}

TEMPLATE_TEST_CASE("Symmetric meshes are exactly symmetric", "[mesh]", SCALARS) {
    using Scalar = TestType;
    for (const Eigen::Index n : {3, 4, 7, 40, 161, 10000}) {
        for (const Mesh<Scalar>& mesh : {uniform_mesh<Scalar>(n), knothe_mesh<Scalar>(n, Scalar(0.3)),
                                         knothe_mesh<Scalar>(n, Scalar(3)), cosine_mesh<Scalar>(n)}) {
            CAPTURE(n, mesh.widths()[0]);
            CHECK((mesh.widths() == mesh.widths().reverse()).all());
            CHECK((mesh.edges_from_trailing() == mesh.edges_from_leading().reverse()).all());
            CHECK((mesh.from_trailing() == mesh.from_leading().reverse()).all());
            CHECK((mesh.centres() == -mesh.centres().reverse()).all());
        }
        const Mesh<Scalar> graded = geometric_mesh<Scalar>(n, Scalar(4)),
                           mirror = geometric_mesh<Scalar>(n, Scalar(0.25));
        CHECK(in_eps(graded.widths(), mirror.widths().reverse().eval()) < 40);
    }
}

TEST_CASE("Graded meshes have the element ratios asked for", "[mesh]") {
    CHECK(cosine_mesh(1).widths()[0] == 2);
    CHECK(uniform_mesh(1).widths()[0] == 2);
    for (const Eigen::Index n : {2, 3, 5, 40, 1000}) {
        for (const double ratio : {1e-6, 0.2, 0.999999, 1.0, 1 + 0x1p-52, 1 + 1e-12, 2.0, 10.0, 1e6}) {
            const Mesh<double> mesh = geometric_mesh(n, ratio);
            CAPTURE(n, ratio);
            CHECK(std::abs(mesh.widths()[0] / mesh.widths()[n - 1] / ratio - 1) < 1e-13);
            const double step = std::pow(ratio, -1 / static_cast<double>(n - 1));
            CHECK((mesh.widths().tail(n - 1) / mesh.widths().head(n - 1) / step - 1).abs().maxCoeff() < 1e-13);
        }
        for (const double epsilon : {1e-8, 0.25, 1.0, 3.0}) {
            CAPTURE(n, epsilon);
            const Mesh<double> modified = modified_knothe_mesh(n, epsilon);
            CHECK(std::abs(modified.widths()[0] / modified.widths()[n - 1] / epsilon - 1) < 1e-14);
            CHECK(modified.widths()[n - 1] == modified.widths()[1]);
            if (n < 3) continue;
            const Mesh<double> both = knothe_mesh(n, epsilon);
            CHECK(std::abs(both.widths()[0] / both.widths()[1] / epsilon - 1) < 1e-14);
            CHECK(both.widths()[0] == both.widths()[n - 1]);
            CHECK((both.widths().segment(1, n - 2) == both.widths()[1]).all());
        }
    }
}

TEST_CASE("The facts listed for a topology hold for its meshes", "[mesh]") {
    const std::map<Topology, Mesh<double>> direct{{Topology::uniform, uniform_mesh(7)},
                                                  {Topology::geometric, geometric_mesh(7, 0.3)},
                                                  {Topology::knothe, knothe_mesh(7, 0.3)},
                                                  {Topology::modified_knothe, modified_knothe_mesh(7, 0.3)},
                                                  {Topology::cosine, cosine_mesh(7)}};
    for (const TopologyInfo& known : topologies) {
        CAPTURE(known.name);
        CHECK((make_mesh(known.topology, 7, 0.3).widths() == direct.at(known.topology).widths()).all());
        CHECK(make_mesh(known.topology, 7, 0.3).is_uniform() == (known.topology == Topology::uniform));
        CHECK(&topology_info(known.topology) == &known);
        CHECK(name(known.topology) == std::string_view(known.name));
        CHECK(topology_named(known.name) == known.topology);
        CHECK(make_mesh(known.topology, known.least_n, 0.3).size() == known.least_n);
        CHECK_THROWS_AS(make_mesh(known.topology, known.least_n - 1, 0.3), std::invalid_argument);
        // the grading matters for those topologies that take one, and only for them
        const auto widths = [&](double grading) { return make_mesh(known.topology, 5, grading).widths(); };
        CHECK((widths(0.3) == widths(0.6)).all() == (known.grading.empty()));
        if (known.grading == "size_ratio") CHECK(std::abs(widths(0.3)[0] / widths(0.3)[4] - 0.3) < 1e-15);
        if (known.grading == "epsilon") CHECK(std::abs(widths(0.3)[0] / widths(0.3)[1] - 0.3) < 1e-15);
    }
    CHECK_FALSE(topology_named("knothe mesh").has_value());
    CHECK_FALSE(topology_named("").has_value());
}

TEST_CASE("A mesh from edges keeps them", "[mesh]") {
    const Eigen::Array4d edges(-1, -0.3, 0.75, 1);
    const Mesh<double> mesh = mesh_from_edges<double>(edges);
    CHECK(mesh.size() == 3);
    CHECK((mesh.edges() - edges).abs().maxCoeff() < 2e-16);
    CHECK(mesh.widths()[1] == 0.75 + 0.3);
    CHECK_FALSE(mesh.is_uniform());
    // vectors and expressions are accepted
    const Eigen::Vector3d ends(-2, 0, 2);
    CHECK(mesh_from_edges<double>(ends / 2).size() == 2);
    // the scalar type defaults to the edges' scalar type
    CHECK(std::is_same_v<decltype(mesh_from_edges(edges)), Mesh<double>>);
    CHECK(std::is_same_v<decltype(mesh_from_edges(Eigen::ArrayXf())), Mesh<float>>);
    CHECK((mesh_from_edges(edges).widths() == mesh.widths()).all());
    // a round trip through the edges of every maker
    for (const auto& [name, made] : brute_force::every_mesh<double>(12)) {
        const Mesh<double> again = mesh_from_edges<double>(made.edges());
        CAPTURE(name);
        CHECK((again.widths() / made.widths() - 1).abs().maxCoeff() < 1e-14);
        CHECK((again.centres() - made.centres()).abs().maxCoeff() < 4e-16);
    }
}

TEST_CASE("A mesh rejects data that break its invariant", "[mesh]") {
    using Data = Mesh<double>::Data;
    const Data good{Eigen::Array2d(0.5, 1.5), Eigen::Array3d(0, 0.5, 2), Eigen::Array3d(2, 1.5, 0)};
    CHECK_NOTHROW(Mesh<double>(good));
    CHECK_THROWS_WITH(Mesh<double>(Data{}), "Mesh: number of elements = 0 must be at least 1");
    Data data = good;
    data.edges_from_trailing.conservativeResize(2);
    CHECK_THROWS_WITH(Mesh<double>(data), "Mesh: number of edges = 2 must be one more than the number of elements");
    data = good;
    data.widths[1] = 0;
    CHECK_THROWS_WITH(Mesh<double>(data), "Mesh: element width = 0 must be positive and finite");
    for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), -1.0, 0.0, 2.0}) {
        CAPTURE(wrong);
        data = good;
        data.edges_from_trailing[1] = wrong;
        CHECK_THROWS_AS(Mesh<double>(data), std::invalid_argument);
        data = good;
        data.edges_from_leading[1] = wrong;
        CHECK_THROWS_AS(Mesh<double>(data), std::invalid_argument);
    }
    // the two distances of an edge must agree to round-off
    data = good;
    data.edges_from_leading[1] = 1.5 * (1 + 1e-15);
    CHECK_NOTHROW(Mesh<double>(data));
    data.edges_from_leading[1] = 1.5 * (1 + 1e-13);
    CHECK_THROWS_WITH(Mesh<double>(data),
                      Catch::Matchers::ContainsSubstring("Mesh: (1 + x) + (1 - x) - 2 of an edge = 1.5") &&
                          Catch::Matchers::ContainsSubstring("e-13 must be 0 to rounding"));
    data = good;
    data.widths[1] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(Mesh<double>(data), "Mesh: element width = nan must be positive and finite");
    data = good;
    data.edges_from_leading[1] = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH(Mesh<double>(data), "Mesh: 1 - x of an edge = inf must be finite");
}

}  // namespace
