// rollbem/scene/patch_contact.hpp, discretisation/patch_mesh.hpp: what is checked, and the strips.
#include <cmath>
#include <limits>
#include <numbers>

#include <rollbem/discretisation/patch_mesh.hpp>
#include <rollbem/scene/patch_contact.hpp>

#include "support/catch.hpp"
#include "support/observed_order.hpp"
#include "support/refusal.hpp"

namespace patch_contact_tests {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

namespace {

using Array = ArrayX<double>;
using Values = std::initializer_list<double>;

Array array(Values values) { return Eigen::Map<const Array>(values.begin(), static_cast<Eigen::Index>(values.size())); }

PatchContact::Outline outline(Values y, Values trailing, Values leading) {
    return {array(y), array(trailing), array(leading)};
}

std::string refused(Values y, Values trailing, Values leading) {
    return refusal([&] { outline(y, trailing, leading); });
}

}  // namespace

TEST_CASE("patch_contact: parameters are checked, and named") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const auto refused = [](double a, double b, double G, double nu) {
        return refusal([&] { PatchContact({a, b, G, nu}); });
    };
    CHECK(refused(5e-3, 5e-3, 8e10, 0.5).empty());
    CHECK(refused(5e-3, 5e-3, 8e10, 0).empty());
    CHECK(refused(0, 1, 1, 0) == "PatchContact: half_length = 0 must be positive and finite");
    CHECK_THAT(refused(1, inf, 1, 0), ContainsSubstring("half_width = inf"));
    CHECK_THAT(refused(1, nan, 1, 0), ContainsSubstring("half_width = nan"));
    CHECK_THAT(refused(1, 1, -1, 0), ContainsSubstring("shear_modulus = -1"));
    CHECK_THAT(refused(1, 1, 1, 0.51), ContainsSubstring("poisson_ratio = 0.51 must lie in [0, 0.5]"));
    CHECK_THAT(refused(1e60, 1e-250, 1, 0), ContainsSubstring("half_length / half_width = inf"));
    CHECK_THAT(refused(1e-60, 1e250, 1, 0), ContainsSubstring("half_length / half_width = "));
    CHECK_THAT(refusal([] { PatchContact::dimensionless(-1, 0); }), ContainsSubstring("a_over_b = -1"));
}

TEST_CASE("outline: bad ones are refused with the line and its value") {
    CHECK(refused({0, 1}, {0, 0}, {1, 1}).empty());
    CHECK(refused({0, 1, 2}, {0, -1, 0}, {0, 1, 0}).empty());  // tips
    CHECK_THAT(refused({0}, {0}, {1}), ContainsSubstring("number of lines = 1 must be at least 2"));
    CHECK_THAT(refused({0, 1, 1}, {0, 0, 0}, {1, 1, 1}), ContainsSubstring("y of line 3 = 1 must be larger"));
    CHECK_THAT(refused({0, 2, 1}, {0, 0, 0}, {1, 1, 1}), ContainsSubstring("y of line 3 = 1 must be larger"));
    CHECK_THAT(refused({0, NAN}, {0, 0}, {1, 1}), ContainsSubstring("y of line 2 = nan must be finite"));
    CHECK_THAT(refused({0, 1}, {0, 0}, {1, NAN}), ContainsSubstring("x_leading of line 2 = nan"));
    CHECK_THAT(refused({0, 1}, {0, 2}, {1, 1}), ContainsSubstring("the edges cross"));
    CHECK_THAT(refused({0, 1, 2}, {0, 1, 0}, {1, 1, 1}),
               ContainsSubstring("x_leading - x_trailing of line 2 = 0 must be positive"));
    CHECK_THAT(refused({0, 1}, {0, 0}, {0, 0}), ContainsSubstring("area = 0"));
    CHECK_THAT(refused({0, 1}, {0, 0, 0}, {1, 1}), ContainsSubstring("number of trailing edges"));
}

TEST_CASE("outline: edges are straight between lines; c is the radius of the circle of equal area") {
    const PatchContact::Outline kite = outline({-1, 0, 3}, {0, -2, 0}, {0, 1, 0});
    CHECK(kite.leading(-0.5) == 0.5);
    CHECK(kite.trailing(1.5) == -1);
    CHECK(kite.leading(-1) == 0);
    CHECK(kite.trailing(3) == 0);
    CHECK(kite.area() == 6);
    const PatchContact contact(kite, 1, 0.3);
    CHECK_THAT(contact.half_length(), WithinRel(std::sqrt(6 / std::numbers::pi), 1e-15));
    CHECK(contact.a_over_b() == 1);
}

TEST_CASE("patch_mesh: the strips of an ellipse end on it at the middle of their width") {
    const PatchMesh<double> mesh = ellipse_mesh<double>(2, cosine_mesh(5), cosine_mesh(8));
    CHECK(mesh.size() == 40);
    CHECK(mesh.is_mirrored());
    CHECK(mesh.lower()[0] == -0.5);
    CHECK(mesh.upper()[7] == 0.5);
    for (Eigen::Index j = 0; j < 8; ++j) {
        const double y = mesh.middles_y()[j] * 2, x = mesh.half_lengths()[j];
        CHECK_THAT(x * x + y * y, WithinRel(1.0, 1e-14));
    }
    // the area is pi a b to second order: the midpoint rule of a square root, on a mesh graded for it
    std::vector<double> counts, errors;
    for (const Eigen::Index m : {8, 16, 32, 64}) {
        const PatchMesh<double> patch = ellipse_mesh<double>(2, cosine_mesh(5), cosine_mesh(m));
        counts.push_back(static_cast<double>(m));
        errors.push_back((2 * patch.half_lengths() * patch.widths()).sum() - std::numbers::pi / 2);
    }
    const double order = support::observed_order(counts, errors);
    INFO("order " << order);
    CHECK(order > 1.9);
    CHECK(order < 2.1);
}

TEST_CASE("patch_mesh: an outline is cut as given, in units of c, and mirrored only if it is") {
    const PatchContact::Outline trapezium = outline({1, 3}, {-1, -2}, {1, 2});
    const Array edges = array({-1, 0.5, 1});
    const PatchMesh<double> mesh = outline_mesh<double>(trapezium, 2, uniform_mesh(3), mesh_from_edges(edges));
    CHECK(mesh.upper().isApprox(array({1.25, 1.5})));
    CHECK(mesh.middles_y().isApprox(array({0.875, 1.375})));
    CHECK(mesh.half_lengths().isApprox(array({0.6875, 0.9375})));
    CHECK_FALSE(mesh.is_mirrored());
    const PatchMesh<double> bulge =
        outline_mesh<double>(outline({-1, 0, 1}, {-1, -2, -1}, {1, 3, 1}), 2, cosine_mesh(3), cosine_mesh(5));
    CHECK(bulge.is_mirrored());
    CHECK(bulge.middles_x()[2] == 0.25);
    // sheared: the strips' middles lie ahead on one side and behind on the other
    CHECK_FALSE(
        PatchMesh<double>({cosine_mesh(2), array({-1, 0, 1}), array({-0.5, 0.5}), array({-0.1, 0.1}), array({1, 1})})
            .is_mirrored());
    CHECK(bulge.half_lengths()[2] == 1.25);
    CHECK_THAT(refusal([] {
                   PatchMesh<double>({cosine_mesh(2), array({0, 1}), array({0.5}), array({0}), array({0})});
               }),
               ContainsSubstring("half-length of a strip = 0"));
    CHECK_THAT(refusal([] {
                   PatchMesh<double>({cosine_mesh(2), array({1, 0}), array({0.5}), array({0}), array({1})});
               }),
               ContainsSubstring("width of a strip = -1"));
}

}  // namespace patch_contact_tests
