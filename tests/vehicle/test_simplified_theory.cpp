// rollbem/vehicle/simplified_theory.hpp
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <rollbem/line.hpp>
#include <rollbem/patch.hpp>

#include "support/catch.hpp"
#include "support/observed_order.hpp"
#include "support/refusal.hpp"

namespace simplified_theory_tests {
namespace {

using namespace rollbem;

constexpr double pi = std::numbers::pi, nu = 0.28, mu = 0.3, load = 8e4;
const PatchContact ellipse({6e-3, 4e-3, 8.2e10, nu});
constexpr CreepCoefficients<double> kalker{4.8, 4.4, 2.0, -2.0, 0.9};

SimplifiedTheory theory(const SimplifiedTheory::Mesh& mesh) { return {ellipse, kalker, mu, load, mesh}; }

enum class By { fastsim, fastrip };
TangentialForce force(By which, const Creepage& at, const SimplifiedTheory::Mesh& mesh) {
    const SimplifiedTheory::Force found = which == By::fastsim ? theory(mesh).fastsim(at) : theory(mesh).fastrip(at);
    REQUIRE(found.status == Status::ok);
    return found.force;
}
/// Creepages that would cause `x`, `y` and `spin` times mu N without slip.
Creepage creepage(double x, double y, double spin) {
    const double unit = mu * load / (ellipse.shear_modulus() * ellipse.half_length() * ellipse.half_width());
    return {unit * x / kalker.c11, unit * y / kalker.c22, unit * spin / kalker.c23 / ellipse.c()};
}

TEST_CASE("Small creepages have the forces of Kalker's coefficients", "[simplified]") {
    const By which = GENERATE(By::fastsim, By::fastrip);
    const auto bound = GENERATE(SimplifiedTheory::Bound::parabolic, SimplifiedTheory::Bound::elliptic);
    constexpr double small = 1e-7;
    const SimplifiedTheory::Mesh mesh{.strips = 60, .elements = 60, .bound = bound};
    CHECK(force(which, creepage(small, 0, 0), mesh).longitudinal == Approx(-small * mu * load).epsilon(1e-5));
    CHECK(force(which, creepage(0, small, 0), mesh).lateral == Approx(-small * mu * load).epsilon(1e-5));
    CHECK(force(which, creepage(0, 0, small), mesh).lateral == Approx(-small * mu * load).epsilon(2e-4));
}

TEST_CASE("Forces reach mu N in full sliding, by FaStrip against the slip of the rigid bodies", "[simplified]") {
    const SimplifiedTheory::Mesh mesh{.strips = 40, .elements = 40};
    const double bound = mu * load;
    CHECK(force(By::fastsim, {1, 0, 0}, {3, 1}).longitudinal == Approx(-bound).epsilon(1e-12));
    CHECK(force(By::fastsim, {0, -1, 0}, mesh).lateral == Approx(bound).epsilon(1e-12));
    CHECK(force(By::fastsim, {0, -1, 0}, {40, 40, SimplifiedTheory::Bound::elliptic}).lateral ==
          Approx(bound).epsilon(1e-5));
    for (const Creepage& at : {Creepage{3, -4, 0}, {100, 200, 3e4}, {0, 0, 1e5}, {-100, -100, -5e4}}) {
        const auto found = force(By::fastrip, at, {100, 1600});
        const auto exact = full_sliding(ellipse.a_over_b(), at.longitudinal, at.lateral, at.spin * ellipse.c());
        CAPTURE(at.longitudinal, at.spin);
        CHECK(std::abs(found.longitudinal + bound * exact.longitudinal) < 2e-3 * bound);
        CHECK(std::abs(found.lateral + bound * exact.lateral) < 5e-3 * bound);
        CHECK(std::abs(found.moment + bound * ellipse.c() * exact.moment) < 5e-3 * bound * ellipse.c());
    }
}

/// A strip, the middle one, of an ellipse so wide that strip theory is exact, with the coefficients of its limit.
struct WideStrip {
    PatchContact contact{{1, 1e3, 1, nu}};
    CreepCoefficients<double> limit{pi * pi / (4 * (1 - nu)), pi* pi / 4, pi / 3 / std::sqrt(1e3), 0, 0};
    double peak = 1e-3;              // mu p0, of half-length and G of 1
    TangentialForce force{0, 0, 0};  // over the force of full sliding
    std::vector<SimplifiedTheory::Element> found;

    WideStrip(const Creepage& at, int count, int strip = 4) {
        const SimplifiedTheory theory(contact, limit, 1, peak * 2 * pi * 1e3 / 3, {9, count});
        const auto status = theory.fastrip(at, [&](const SimplifiedTheory::Element& element) {
            if (element.strip != strip) return;
            found.push_back(element);
            for (std::size_t k = 0; k < 2; ++k) {
                (k == 0 ? force.longitudinal : force.lateral) += element.traction[k] * 2 / count / (peak * pi / 2);
            }
        });
        REQUIRE(status.status == Status::ok);
        REQUIRE(found.size() == std::size_t(count));
    }
};

TEST_CASE("FaStrip's middle strip of a very wide ellipse is Carter's solution", "[simplified]") {
    const double delta = GENERATE(0.1, 0.5, 0.9, 1.2);
    const double unit = 2 * 1e-3;  // creepage that slides, with nu = 0
    const WideStrip along({unit * (1 - nu) * delta, 0, 0}, 400), across({0, -unit * delta, 0}, 400);
    CHECK(-along.force.longitudinal == Approx(carter_force_ratio(delta)).epsilon(1e-3));
    CHECK(across.force.lateral == Approx(carter_force_ratio(delta)).epsilon(1e-3));
    for (const SimplifiedTheory::Element& element : along.found) {
        const double exact = carter_friction_traction(element.x, delta);
        CHECK(std::abs(element.traction[0] / along.peak - exact) < 2e-2);
        CHECK(element.slips == (element.x <= carter_stick_border(delta)));
    }
}

TEST_CASE("A strip of FaStrip that the spin moves as creepage moves it back sticks", "[simplified]") {
    const double spin = 1e-3, y = WideStrip({0, 0, spin}, 10, 6).found[0].y;
    REQUIRE(y > 100);
    for (const auto& [back, strip] : {std::pair(spin * y, 6), {0.0, 4}}) {  // the middle strip is not moved
        for (const SimplifiedTheory::Element& element : WideStrip({back, 0, spin}, 50, strip).found) {
            CHECK(std::abs(element.traction[0]) < 1e-9);
            CHECK(element.traction[1] < 0);
            CHECK(!element.slips);
        }
    }
}

TEST_CASE("FaStrip's middle strip has the forces of a line contact with spin", "[simplified]") {
    const auto contact = Contact::dimensionless(1000.0, nu);
    const Mesh<double> mesh = cosine_mesh<double>(80);
    const NodeDifference scheme{Nodes::chebyshev};
    const ElementSystem<double, 2> system{steady_system(mesh, scheme, PlaneKernel<double>::longitudinal(contact)),
                                          steady_system(mesh, scheme, PlaneKernel<double>::lateral(contact))};
    const double peak = 1e-3, full = 2 * 1000 * peak * pi / 2;
    const FrictionModel model(contact, system, {1.0, peak * mean_hertz_pressure(mesh)});
    auto workspace = model.workspace();
    auto state = model.at_rest();
    for (const auto& [x, y, spin] : {std::array{0.0, 0.4, 0.3}, {0.3, 0.3, 0.5}, {0.4, -0.2, 0.4}, {0.0, 0.1, -0.5}}) {
        const Creepage at{2 * (1 - nu) * peak * x, 2 * peak * y, 2 * peak * spin};
        const auto step = model.steady(model.at_rest(), {.motion = at}, state, workspace);
        REQUIRE(step.status == Status::ok);
        const WideStrip strip(at, 400);
        CAPTURE(x, y, spin);
        // the direction of slip turns within the strip where creepages act along both axes, which strip theory neglects
        const double error = x == 0 ? 1e-3 : 3e-2;
        CHECK(std::abs(strip.force.longitudinal - step.force.longitudinal / full) < error);
        CHECK(std::abs(strip.force.lateral - step.force.lateral / full) < error);
    }
}

TEST_CASE("FASTSIM is the one of CONTACT on finer and finer grids", "[simplified]") {
    // examples/fastsim of CONTACT 25.2, a/b = 2: flexibilities, F_y/(mu N) and M_z [N mm] of 40 and 200 elements a
    // strip
    const PatchContact contact({8e-3, 4e-3, 8.2e10, nu});
    const double G = 82000, a = 8;
    const CreepCoefficients<double> c{8 * a / (3 * G * 0.4937e-4), 8 * a / (3 * G * 0.5152e-4),
                                      pi * a * std::sqrt(2.0) / (4 * G * 0.4090e-4), 0, 0};
    struct Published {
        SimplifiedTheory::Bound bound;
        double lateral[2], moment[2];
    };
    for (const Published& published :
         {Published{SimplifiedTheory::Bound::parabolic, {-.6118, -.6359}, {-3.900e4, -3.798e4}},
          Published{SimplifiedTheory::Bound::elliptic, {-.6016, -.5956}, {-4.829e4, -4.530e4}}}) {
        const auto limit = [](const double(&at)[2]) { return at[1] + (at[1] - at[0]) / 4; };
        const SimplifiedTheory theory(contact, c, 0.3, 8.2e4, {400, 400, published.bound});
        const auto found = theory.fastsim({0, -6.25e-4, 0.625}).force;
        CHECK(std::abs(found.longitudinal) < 1e-9 * 8.2e4);
        CHECK(std::abs(found.lateral / (0.3 * 8.2e4) - limit(published.lateral)) < 5e-4);
        CHECK(std::abs(1e3 * found.moment / limit(published.moment) - 1) < 2e-3);
    }
}

TEST_CASE("Elements of simplified theory converge, and heat is the work of creepage", "[simplified]") {
    const Creepage at = creepage(0.6, 0.4, 0.5);
    for (const By which : {By::fastsim, By::fastrip}) {
        std::vector<double> counts, errors;
        const auto limit = force(which, at, {200, 6400});
        for (const int n : {25, 50, 100, 200}) {
            counts.push_back(n);
            const auto found = force(which, at, {200, n});
            errors.push_back(std::hypot(found.longitudinal - limit.longitudinal, found.lateral - limit.lateral));
        }
        const double order = support::observed_order(counts, errors);
        CAPTURE(order, errors.front() / (mu * load));
        CHECK(order > 0.8);
        CHECK(order < 1.4);
    }
    for (const Creepage& moved : {creepage(0.8, 0, 0), creepage(0, 0.8, 0), creepage(0.5, -0.6, 0)}) {
        std::vector<double> counts, errors;
        for (const int n : {10, 20, 40}) {
            double heat = 0, area = 0;
            const auto found = theory({100, n}).fastsim(moved, [&](const SimplifiedTheory::Element& element) {
                heat -= element.area * (element.traction[0] * element.slip[0] + element.traction[1] * element.slip[1]);
                area += element.area;
            });
            CHECK(area == Approx(pi * ellipse.half_length() * ellipse.half_width()).epsilon(1e-12));
            counts.push_back(n);
            errors.push_back(
                -heat / (found.force.longitudinal * moved.longitudinal + found.force.lateral * moved.lateral) - 1);
        }
        CAPTURE(moved.longitudinal, moved.lateral, errors[0], errors[1], errors[2]);
        CHECK(std::abs(2 * errors[2] - errors[1]) < 2e-2);
        CHECK(support::observed_order(counts, errors) > 0.8);
    }
}

TEST_CASE("Simplified theory refuses creepages whose tractions overflow, and no others", "[simplified]") {
    const By which = GENERATE(By::fastsim, By::fastrip);
    const auto found = [&](const SimplifiedTheory& of, const Creepage& at) {
        return which == By::fastsim ? of.fastsim(at) : of.fastrip(at);
    };
    constexpr double huge = (std::numeric_limits<double>::max)();
    for (const double size : {1e300, huge}) {
        for (const auto& at : {Creepage{size, 0, 0}, {0, -size, 0}, {0, 0, size}, {size, size, -size}}) {
            const SimplifiedTheory::Force refused = found(theory({}), at);
            CAPTURE(size, at.longitudinal, at.lateral, at.spin);
            CHECK(refused.status == Status::not_finite);
            CHECK(std::isnan(refused.force.longitudinal + refused.force.lateral));
        }
    }
    // forces equal the forces of sliding up to the largest creepages that are taken
    const double unit = kalker.c22 * ellipse.shear_modulus();
    for (double exponent = 280; exponent < 308; exponent += 0.125) {
        const SimplifiedTheory::Force at_edge = found(theory({40, 40}), {0, -std::pow(10, exponent) / unit, 0});
        if (at_edge.status == Status::ok) CHECK(at_edge.force.lateral == Approx(mu * load).epsilon(1e-3));
    }
    // the stick zone of a mu next to nothing is larger than any number
    const SimplifiedTheory smooth(ellipse, kalker, 1e-290, load, {40, 40});
    const SimplifiedTheory::Force slides = found(smooth, {0, -1e20, 1e-292});
    REQUIRE(slides.status == Status::ok);
    CHECK(slides.force.lateral / (1e-290 * load) == Approx(1).epsilon(1e-3));
    // a bound beyond all numbers: FASTSIM never reaches it, FaStrip needs it
    const SimplifiedTheory::Force rough = found(SimplifiedTheory(ellipse, kalker, 1e300, load), {1e-4, 0, 0});
    CHECK(rough.status == (which == By::fastsim ? Status::ok : Status::not_finite));
    CHECK(std::isnan(rough.force.longitudinal) == (rough.status != Status::ok));
}

TEST_CASE("Simplified theory refuses what it cannot take", "[simplified]") {
    const auto made = [](double c23, double friction, double N, SimplifiedTheory::Mesh mesh) {
        return refusal([=] { SimplifiedTheory(ellipse, {4, 4, c23, -1, 1}, friction, N, mesh); });
    };
    CHECK(made(1, 0.3, 1e5, {}).empty());
    CHECK(made(0, 0.3, 1e5, {}) == "SimplifiedTheory: c23 = 0 must be positive and finite");
    CHECK(made(1, -1, 1e5, {}) == "SimplifiedTheory: friction_coefficient = -1 must be positive and finite");
    CHECK(made(1, 0.3, 0, {}) == "SimplifiedTheory: load = 0 must be positive and finite");
    CHECK(made(1, 0.3, 1e5, {2, 10}) == "SimplifiedTheory: number of strips = 2 must be at least 3");
    CHECK(made(1, 0.3, 1e5, {10, 0}) == "SimplifiedTheory: number of elements = 0 must be at least 1");
    CHECK(theory({}).fastrip({0, 0, 0}).force.lateral == 0);
}

}  // namespace
}  // namespace simplified_theory_tests
