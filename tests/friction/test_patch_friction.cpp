// Friction on a contact patch: steady forces against limits of small elements, symmetries, work, units.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/line.hpp>
#include <rollbem/patch.hpp>
#include <rollbem/system/detail/dissipation.hpp>

#include "support/catch.hpp"

namespace patch_friction_tests {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr NodeDifference chebyshev{Nodes::chebyshev};
constexpr double mu = 0.3, nu = 0.28, G = 8e10;

/// Limits of -F_x, -F_y over mu N and -M_z over mu N a: 16 x 16 and 32 x 32 elements of another program, extrapolated;
/// Kalker's program CONTACT tends to the same forces within 5e-4.
struct Limit {
    bool xi, eta, phi;
    double level;
    std::array<double, 3> ratios;

    int acting() const { return int(xi) + int(eta) + int(phi); }
};
constexpr Limit limits[] = {
    {1, 0, 0, 0.4, {.35294, 0, 0}},
    {1, 0, 0, 1, {.72065, 0, 0}},
    {1, 0, 0, 2.5, {.99914, 0, 0}},
    {0, 1, 0, 0.4, {0, .35213, -.10642}},
    {0, 1, 0, 1, {0, .71638, -.12457}},
    {0, 1, 0, 2.5, {0, .99916, -.01709}},
    {1, 1, 0, 0.4, {.24873, .24974, -.07466}},
    {1, 1, 0, 1, {.50492, .51144, -.08572}},
    {1, 1, 0, 2.5, {.68261, .72987, -.01108}},
    {0, 0, 1, 0.4, {0, .37446, .22556}},
    {0, 0, 1, 1, {0, .60539, .40032}},
    {0, 0, 1, 2.5, {0, .38034, .51395}},
    {0, 1, 1, 0.4, {0, .50366, .10635}},
    {0, 1, 1, 1, {0, .84704, .24648}},
    {0, 1, 1, 2.5, {0, .75458, .32506}},
    {1, 1, 1, 0.4, {.18327, .41848, .08348}},
    {1, 1, 1, 1, {.30871, .78900, .20493}},
    {1, 1, 1, 2.5, {.34967, .73684, .27746}},
};

/// A patch of semi-axes a and b [m] with G a b = 250/3 mu N.
struct Scene {
    PatchContact contact;
    PatchMesh<double> mesh;
    HalfSpace<double> kernel{nu};
    double load, c;
    Friction friction;

    Scene(double a, double b, Eigen::Index n, Eigen::Index m) : Scene(a, b, cosine_mesh(n), cosine_mesh(m)) {}
    Scene(double a, double b, const Mesh<double>& along, const Mesh<double>& across)
        : contact({.half_length = a, .half_width = b, .shear_modulus = G, .poisson_ratio = nu}),
          mesh(patch_mesh(contact, along, across)),
          load(G * a * b * 3 / 250 / mu),
          c(std::sqrt(a * b)),
          friction{mu, hertz_pressures(contact, mesh, load)} {}

    FrictionModel steady() const { return {contact, steady_system(mesh, chebyshev, kernel), friction}; }
    /// -F_x, -F_y over mu N, -M_z over mu N c.
    std::array<double, 3> ratios(const TangentialForce& force) const {
        const double unit = -mu * load;
        return {force.longitudinal / unit, force.lateral / unit, force.moment / unit / c};
    }
    /// A circle: of the creepages that act together, each is the part 1/sqrt(their number) of what would need `level`
    /// mu N without slip.
    Creepage creepage(const Limit& limit) const {
        const double unit = limit.level * 3 / 250 / std::sqrt(limit.acting());
        return {limit.xi ? unit / 4.2262 : 0, limit.eta ? unit / 3.7049 : 0, limit.phi ? unit / 1.4881 / c : 0};
    }
};

/// A steady solution from rest.
FrictionStep solve(const FrictionModel& model, const Creepage& creepage) {
    return Run(model).steady({.motion = creepage});
}

}  // namespace

TEST_CASE("patch_friction: steady forces of a circle tend to their limits") {
    struct Errors {
        double mean[2] = {0, 0}, largest[2] = {0, 0}, moment = 0;  // without, with spin

        void add(const std::array<double, 3>& ratios, const Limit& limit) {
            const double error = std::max(std::abs(ratios[0] - limit.ratios[0]), std::abs(ratios[1] - limit.ratios[1]));
            mean[limit.phi] += error / 9;
            largest[limit.phi] = std::max(largest[limit.phi], error);
            moment = std::max(moment, std::abs(ratios[2] - limit.ratios[2]));
        }
    };
    const auto extrapolated = [](const std::array<double, 3>& coarse, const std::array<double, 3>& fine) {
        std::array<double, 3> result;
        for (std::size_t i = 0; i < 3; ++i) result[i] = fine[i] + (fine[i] - coarse[i]) / (1.5 * 1.5 - 1);
        return result;
    };
    const Scene coarse(5e-3, 5e-3, 8, 8), fine(5e-3, 5e-3, 12, 12);
    const auto coarse_model = coarse.steady(), fine_model = fine.steady();
    Errors eight, twelve, both;
    int rounds = 0;
    for (const Limit& limit : limits) {
        CAPTURE(limit.xi, limit.eta, limit.phi, limit.level);
        const Creepage creepage = coarse.creepage(limit);
        const FrictionStep first = solve(coarse_model, creepage), second = solve(fine_model, creepage);
        CHECK(first.status == Status::ok);
        CHECK(second.status == Status::ok);
        CHECK(second.complementarity_residual < 1e-12);
        const auto at_8 = coarse.ratios(first.force), at_12 = fine.ratios(second.force);
        eight.add(at_8, limit);
        twelve.add(at_12, limit);
        both.add(extrapolated(at_8, at_12), limit);
        rounds += second.rounds;
    }
    CHECK(eight.mean[0] < 3.1e-3);
    CHECK(eight.mean[1] < 1.44e-2);
    CHECK(eight.largest[0] < 8.4e-3);
    CHECK(eight.largest[1] < 4.7e-2);
    CHECK(twelve.mean[0] < 7.2e-4);
    CHECK(twelve.mean[1] < 6.7e-3);
    CHECK(twelve.largest[0] < 2.04e-3);
    CHECK(twelve.largest[1] < 2.4e-2);
    CHECK(both.mean[0] < 1.32e-3);
    CHECK(both.mean[1] < 1.32e-3);
    CHECK(both.largest[0] < 4.8e-3);
    CHECK(both.largest[1] < 4.8e-3);
    CHECK(twelve.moment < 9e-3);
    CHECK(both.moment < 3e-3);
    CHECK(rounds < 18 * 11);
}

TEST_CASE("patch_friction: recommended patches stay below their error bound") {
    constexpr double any = std::numeric_limits<double>::infinity();
    const auto recommended = [](double a_over_b, Eigen::Index n) {
        return Scene(5e-3 * std::sqrt(a_over_b), 5e-3 / std::sqrt(a_over_b), cosine_mesh(n),
                     uniform_mesh(recommended_strips(n, a_over_b)));
    };
    const auto difference = [](const std::array<double, 3>& one, const std::array<double, 3>& other) {
        return std::max(std::abs(one[0] - other[0]), std::abs(one[1] - other[1]));
    };
    for (const auto& [tolerance, spin] : {std::pair{0.1, any}, {0.02, any}, {0.05, 0.0}, {0.01, 0.0}, {0.03, 0.4}}) {
        CAPTURE(tolerance, spin);
        const auto best = recommended_patch(tolerance, 1, spin);
        const Scene scene = recommended(1, best.n);
        CHECK((best.mesh(scene.contact).upper() == scene.mesh.upper()).all());
        const auto model = scene.steady();
        double largest = 0, moment = 0;
        for (const Limit& limit : limits) {
            if (limit.phi && limit.level / std::sqrt(limit.acting()) > spin) continue;
            const std::array<double, 3> ratios = scene.ratios(solve(model, scene.creepage(limit)).force);
            largest = std::max(largest, difference(ratios, limit.ratios));
            moment = std::max(moment, std::abs(ratios[2] - limit.ratios[2]));
        }
        CHECK(moment <= best.moment_bound);
        CHECK(moment >= best.moment_bound / 10);
        CHECK(best.error_bound <= tolerance);
        CHECK(largest <= best.error_bound);
        CHECK(largest >= best.error_bound / 6);
    }
    // an odd number of strips, without an edge through the pole of spin
    const auto spin_error = [&](Eigen::Index strips) {
        const Scene scene(5e-3, 5e-3, cosine_mesh(12), uniform_mesh(strips));
        return difference(scene.ratios(solve(scene.steady(), scene.creepage(limits[11])).force), limits[11].ratios);
    };
    CHECK(spin_error(recommended_strips(12, 1)) < 0.6 * spin_error(8));
    // other ratios, against twice as fine patches: xi alone, spin alone, spin against eta
    for (const auto& [a_over_b, tolerance, c11, c22, c23] :
         {std::tuple{0.25, 0.05, 3.52, 2.72, 0.68}, {3.0, 0.06, 6.15, 6.1, 3.9}, {20.0, 0.1, 18.8, 21.8, 34.2}}) {
        CAPTURE(a_over_b);
        const auto best = recommended_patch(tolerance, a_over_b);
        const Scene coarse = recommended(a_over_b, best.n), fine = recommended(a_over_b, 2 * best.n);
        const auto coarse_model = coarse.steady(), fine_model = fine.steady();
        const double unit = 3.0 / 250;
        double largest = 0, moment = 0;
        for (const Creepage& creepage : {Creepage{unit / c11, 0, 0}, Creepage{0, 0, 2.5 * unit / c23 / coarse.c},
                                         Creepage{0, -1.8 * unit / c22, 1.8 * unit / c23 / coarse.c}}) {
            const std::array<double, 3> one = coarse.ratios(solve(coarse_model, creepage).force);
            const std::array<double, 3> other = fine.ratios(solve(fine_model, creepage).force);
            largest = std::max(largest, difference(one, other));
            moment = std::max(moment, std::abs(one[2] - other[2]));
        }
        CHECK(moment <= best.moment_bound);
        CHECK(moment >= best.moment_bound / 10);
        CHECK(largest <= best.error_bound);
        CHECK(largest >= best.error_bound / 6);
    }
    CHECK(recommended_patch(0.02, 1).n == 16);
    CHECK(recommended_patch(0.02, 1).strips == 9);
    CHECK(recommended_strips(12, 0.2) == 17);
    CHECK_THROWS_WITH(recommended_patch(0.02, 26), ContainsSubstring("a_over_b = 26"));
    CHECK_THROWS_WITH(recommended_patch(1e-3, 1), ContainsSubstring("tolerance = 0.001"));
    CHECK_THROWS_WITH(recommended_patch(0.02, 1, -1), ContainsSubstring("spin = -1"));
}

TEST_CASE("patch_friction: slip work is the work of the creepages") {
    const auto residual = [](const Limit& limit, Eigen::Index n) {
        const Scene scene(5e-3, 5e-3, n, n);
        const Creepage creepage = scene.creepage(limit);
        const FrictionStep step = solve(scene.steady(), creepage);
        const double work = -creepage.longitudinal * step.force.longitudinal - creepage.lateral * step.force.lateral -
                            creepage.spin * step.force.moment;  // of the rigid bodies, per distance rolled [J/m]
        return step.slip_work / work - 1;
    };
    // of second order; measured with another program
    for (const auto& [which, at_8, at_12] :
         {std::tuple{0, 7.6e-2, 2.8e-2}, {1, 1.5e-2, 6.2e-3}, {11, -5e-3, -2.7e-3}}) {
        CAPTURE(which);
        CHECK(residual(limits[which], 8) == Approx(at_8).epsilon(0.04));
        CHECK(residual(limits[which], 12) == Approx(at_12).epsilon(0.04));
    }
}

TEST_CASE("patch_friction: needles have forces where full adhesion has right ones") {
    // 8 x 0.38 mm, off the middle: not dissipative on 20 x 28 elements, a ninth of the traction assists the creepage
    ArrayX<double> y = ArrayX<double>::LinSpaced(41, -0.19e-3, 0.19e-3), trailing(41), leading(41);
    for (Eigen::Index i = 0; i < 41; ++i) {
        const double length = std::sqrt(std::max(0.0, 1 - std::pow(y[i] / 0.19e-3, 2)));
        trailing[i] = -4.6e-3 * length;
        leading[i] = 3.4e-3 * length;
    }
    const PatchContact contact(PatchContact::Outline(y, trailing, leading), 8.2e10, nu);
    const double c = contact.half_length(), load = 15e3, unit = mu * load / (8.2e10 * c * c);
    std::vector<TangentialForce> forces;
    for (const auto& [n, m] : {std::pair{20, 28}, {16, 9}}) {
        const auto mesh = patch_mesh(contact, cosine_mesh(n), uniform_mesh(m));
        const ArrayX<double> pressure = ArrayX<double>::Constant(mesh.size(), load / contact.outline()->area());
        const FrictionModel model(contact, steady_system(mesh, chebyshev, HalfSpace<double>(nu)), {mu, pressure});
        CHECK(is_dissipative(detail::joined(assemble_G_prime(mesh, chebyshev, HalfSpace<double>(nu))),
                             patch_elements(mesh, chebyshev).areas) == (n == 16));
        const FrictionStep step = solve(model, {0.0551153710 * unit, 0.1177382515 * unit, 0.1651201936 * unit / c});
        REQUIRE(step.status == Status::ok);
        forces.push_back(step.force);
    }
    CHECK(std::abs(forces[0].longitudinal - forces[1].longitudinal) < 0.02 * mu * load);
    CHECK(std::abs(forces[0].lateral - forces[1].lateral) < 0.02 * mu * load);

    // 8 % off in full adhesion, where two fifths of the traction assist
    const auto long_ellipse = PatchContact::dimensionless(50, 0.5);
    const auto mesh = patch_mesh(long_ellipse, 24, 24);
    CHECK_FALSE(FrictionModel(long_ellipse, steady_system(mesh, chebyshev, HalfSpace<double>(0.5)),
                              {mu, hertz_pressures(long_ellipse, mesh, 1.0)})
                    .converges());
}

TEST_CASE("patch_friction: limits of the creepages") {
    const Scene scene(6e-3, 4e-3, 8, 7);
    const auto model = scene.steady();

    Run run(model);
    const FrictionStep nothing = run.steady({.motion = Creepage{}});
    CHECK(nothing.status == Status::ok);
    CHECK(nothing.stick_count == 56);
    CHECK(run.now().traction.isZero(0));
    CHECK(nothing.slip_work == 0);

    // full sliding: F opposes the creepage, and there is no moment
    const FrictionStep sliding = solve(model, {0.3, -0.4, 0});
    const auto sides = scene.ratios(sliding.force);
    CHECK(sliding.stick_count == 0);
    CHECK(sides[0] == Approx(0.6).epsilon(1e-4));
    CHECK(sides[1] == Approx(-0.8).epsilon(1e-4));
    CHECK(std::abs(sides[2]) < 1e-3);
    CHECK(sliding.slip_work == Approx(0.5 * mu * scene.load).epsilon(2e-2));
    // M_z of full sliding about the middle, 3 pi/16 mu N a of a circle
    const Scene circle(5e-3, 5e-3, 8, 8);
    const auto full = circle.ratios(solve(circle.steady(), {0, 0, 1e4}).force);
    CHECK(std::abs(full[0]) < 1e-10);
    CHECK(std::abs(full[1]) < 1e-3);
    CHECK(full[2] == Approx(3 * std::numbers::pi / 16).epsilon(1e-2));

    // one element
    const Scene single(5e-3, 5e-3, 1, 1);
    const FrictionStep alone = solve(single.steady(), {1, 0, 0});
    CHECK(alone.status == Status::ok);
    CHECK(alone.force.longitudinal == Approx(-mu * single.load).epsilon(1e-14));
    CHECK(alone.slip_work > 0);
}

TEST_CASE("patch_friction: a patch of another shape is another one, and none has pressures without a load") {
    const Scene scene(6e-3, 4e-3, 4, 4), other(4e-3, 6e-3, 4, 4);
    CHECK_THROWS_WITH(FrictionModel(scene.contact, steady_system(other.mesh, chebyshev, scene.kernel), scene.friction),
                      ContainsSubstring("a/b of the patch over a/b of its system"));
    CHECK_THROWS_WITH(hertz_pressures(scene.contact, scene.mesh, 0), ContainsSubstring("load"));
    const auto system = rolling_system(scene.mesh, chebyshev, scene.kernel);
    const FrictionModel model(scene.contact, system,
                              judge_stability(patch_subsystems(scene.mesh, chebyshev, scene.kernel)), scene.friction);
    CHECK(model.fingerprint() == scene.steady().fingerprint());
    CHECK(model.fingerprint() != other.steady().fingerprint());
}

}  // namespace patch_friction_tests
