// rollbem/friction/model.hpp
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/compiled/steady.hpp>

#include "friction/combined_scene.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"
#include "support/refusal.hpp"

namespace {

using namespace combined_tests;

TEST_CASE("Steady forces under both creepages agree with two other programs", "[friction]") {
    const Model model = Scene(cosine_mesh<double>(160)).plain().steady();
    struct Point {
        double ratio, degrees, longitudinal, lateral;
    };
    State state;
    for (const Point& point : {Point{0.25, 30, 0.3809, 0.1617},
                               {0.25, 45, 0.3128, 0.2296},
                               {0.25, 60, 0.2225, 0.2824},
                               {0.25, 90, 0, 0.3276},
                               {0.5, 30, 0.6575, 0.2868},
                               {0.5, 45, 0.5438, 0.4093},
                               {0.5, 60, 0.3898, 0.5061},
                               {0.5, 90, 0, 0.5905},
                               {0.9, 45, 0.7433, 0.5931},
                               {1.1, 45, 0.7645, 0.6371},
                               {1.1, 90, 0, 0.9568}}) {
        const Scene scene(cosine_mesh<double>(160));
        const Step step = from_scratch(model, scene.creepage(point.ratio, point.degrees), state);
        CAPTURE(point.ratio, point.degrees, step.rounds);
        CHECK(step.status == StepStatus::ok);
        CHECK(step.complementarity_residual < 1e-11);
        CHECK(std::abs(ratios(step, scene.contact).longitudinal - point.longitudinal) < 3e-4);
        CHECK(std::abs(ratios(step, scene.contact).lateral - point.lateral) < 3e-4);
        // Coulomb's law, from the definition
        Workspace workspace = model.workspace();
        const Creepage<double> creepage = scene.creepage(point.ratio, point.degrees);
        const MatrixX<double> G_x = assemble_G_prime(scene.mesh, scene.scheme, scene.longitudinal);
        const MatrixX<double> G_y = assemble_G_prime(scene.mesh, scene.scheme, scene.lateral);
        const VectorX<double> u = (-G_x * state.traction.col(0)).array() + creepage.longitudinal;
        const VectorX<double> v = (-G_y * state.traction.col(1)).array() + creepage.lateral;
        for (Eigen::Index i = 0; i < 160; ++i) {
            const double x = state.traction(i, 0), y = state.traction(i, 1), bound = scene.friction.normal_pressure[i];
            REQUIRE(std::hypot(x, y) <= bound * (1 + 1e-13));
            if (state.zones[static_cast<std::size_t>(i)] == Zone::stick) {
                REQUIRE(std::hypot(u[i], v[i]) < 1e-11 * peak);
            } else {
                REQUIRE(std::hypot(x, y) == Approx(bound).epsilon(1e-13));
                REQUIRE(std::abs(x * v[i] - y * u[i]) < 1e-11 * peak * bound);
                REQUIRE(x * u[i] + y * v[i] < 1e-11 * peak * bound);
            }
        }
    }
}

TEST_CASE("c22 is the lateral force of friction far below its bound", "[friction]") {
    const Contact<double> contact = Contact<double>::dimensionless(2, 0.28);
    const Mesh<double> mesh = cosine_mesh(20);
    const Friction<> grip{1e6, ArrayX<double>::Ones(20)};
    const Model model(contact,
                      {steady_system(mesh, Collocation{}, StripKernel<double>::longitudinal(contact)),
                       steady_system(mesh, Collocation{}, StripKernel<double>::lateral(contact))},
                      grip);
    auto workspace = model.workspace();
    auto now = model.at_rest(), next = model.at_rest();
    const auto step = model.steady(now, {.longitudinal = 1e-3, .lateral = 2e-3}, next, workspace);
    REQUIRE(step.status == StepStatus::ok);
    const auto across = solve_steady(mesh, Collocation{}, StripKernel<double>::lateral(contact));
    CHECK(std::abs(step.force.lateral / creep_force(contact, across, 2e-3) - 1) < 1e-12);
    const auto along = solve_steady(mesh, Collocation{}, StripKernel<double>::longitudinal(contact));
    CHECK(std::abs(step.force.longitudinal / creep_force(contact, along, 1e-3) - 1) < 1e-12);
    CHECK(across.c11() < 0.99 * along.c11());
}

TEST_CASE("Exchanging kernels and creepages exchanges the forces", "[friction]") {
    const Scene scene(cosine_mesh<double>(24));
    const Model model = scene.steady();
    const Model swapped = scene.steady(scene.lateral, scene.longitudinal, scene.friction);
    for (const double ratio : {0.2, 0.6, 0.95, 1.05, 4.0}) {
        for (const double degrees : {10.0, 45.0, 77.0, 120.0}) {
            const Creepage<double> creepage = scene.creepage(ratio, degrees);
            const Step one = from_scratch(model, creepage);
            const Step other = from_scratch(swapped, {creepage.lateral, creepage.longitudinal});
            CAPTURE(ratio, degrees);
            CHECK(std::abs(one.force.longitudinal - other.force.lateral) < 1e-12 * full_force * scene.contact.width());
            CHECK(std::abs(one.force.lateral - other.force.longitudinal) < 1e-12 * full_force * scene.contact.width());
            CHECK(std::abs(one.tangent.by_lateral.longitudinal - other.tangent.by_longitudinal.lateral) <
                  1e-9 * scene.contact.width());
        }
    }
}

TEST_CASE("Schemes for which the search is difficult are solved", "[friction]") {
    // With alpha = 0 at the leading edge that element has no influence on its own slip, and near full sliding plain
    // Newton steps cycle.
    int hard = 0;
    for (const double alpha_T : {0.5, 0.63, 1.0}) {
        for (const bool cosine : {true, false}) {
            for (const Eigen::Index n : {3, 20, 40}) {
                const Scene scene(cosine ? cosine_mesh<double>(n) : uniform_mesh<double>(n), 0.28,
                                  {.alpha_L = 0, .alpha_T = alpha_T});
                const Model model = scene.steady();
                for (int degrees = 0; degrees <= 90; degrees += 15) {
                    for (int tenths = 1; tenths <= 11; ++tenths) {
                        const Step step = from_scratch(model, scene.creepage(0.1 * tenths, degrees));
                        CAPTURE(alpha_T, cosine, n, degrees, tenths, step.rounds, step.complementarity_residual);
                        REQUIRE(step.status == StepStatus::ok);
                        REQUIRE(step.complementarity_residual < 1e-11);
                        hard += step.rounds > 16 ? 1 : 0;
                    }
                }
            }
        }
    }
    CHECK(hard > 5);
}

TEST_CASE("Slip work equals the power lost by the rigid bodies to second order", "[friction]") {
    std::vector<double> counts, errors;
    for (const Eigen::Index n : {20, 40, 80}) {
        const Scene scene(cosine_mesh<double>(n));
        const Creepage<double> creepage = scene.creepage(0.5, 40);
        const Step step = from_scratch(scene.steady(), creepage);
        const double lost = -step.force.longitudinal * creepage.longitudinal - step.force.lateral * creepage.lateral;
        counts.push_back(static_cast<double>(n));
        errors.push_back(step.slip_work / lost - 1);
    }
    CAPTURE(errors);
    CHECK(std::abs(errors[0]) < 1.1e-2);
    CHECK(std::abs(support::observed_order(counts, errors) - 2) < 0.15);
}

TEST_CASE("No friction, and elements without pressure, are solved", "[friction]") {
    const Scene scene(cosine_mesh<double>(12));
    const Model smooth = scene.steady(scene.longitudinal, scene.lateral, {0, scene.friction.normal_pressure});
    State state;
    const Step free = from_scratch(smooth, scene.creepage(0.5, 45), state);
    CHECK(free.status == StepStatus::ok);
    CHECK(free.stick_count == 0);
    CHECK(state.traction.isZero(0));
    CHECK(free.slip_work == 0);
    CHECK(free.tangent.by_lateral.lateral == 0);
    // a hole in the contact
    Friction<> holed = scene.friction;
    holed.normal_pressure.segment(4, 3).setZero();
    const Model torn = scene.steady(scene.longitudinal, scene.lateral, holed);
    const Step step = from_scratch(torn, scene.creepage(0.4, 45), state);
    CHECK(step.status == StepStatus::ok);
    CHECK(state.traction.middleRows(4, 3).isZero(0));
    CHECK(step.stick_count > 0);
}

TEST_CASE("Invalid matrices of two directions are rejected", "[friction]") {
    const Scene scene(cosine_mesh<double>(8));
    const Model model = scene.steady();
    const MatrixX<double> G_prime = assemble_G_prime(scene.mesh, scene.scheme, scene.longitudinal);
    const ArrayX<double> widths = scene.mesh.widths();
    const auto build = [&](const MatrixX<double>& x, const MatrixX<double>& y, const ArrayX<double>& w) {
        return refusal([&] {
            FrictionModel<ConstantFriction<>, 2>(scene.contact, {{{}, x, w}, {{}, y, w}}, scene.friction);
        });
    };
    CHECK(build(G_prime, G_prime, widths) == "");
    CHECK(build(G_prime, G_prime.topRows(7), widths) ==
          "RollingSystem: number of rows of G_prime = 7 must equal the number of weights");
    CHECK(build(G_prime.leftCols(7), G_prime, widths) ==
          "RollingSystem: number of columns of G_prime = 7 must equal the number of weights");
    MatrixX<double> broken = G_prime;
    broken(2, 3) = std::numeric_limits<double>::quiet_NaN();
    CHECK(build(G_prime, broken, widths) ==
          "RollingSystem: G_prime(2, 3) = nan must be finite (row and column counted from 0)");
    CHECK(build(G_prime, G_prime, -widths) != "");
    CHECK(refusal([&] {
              scene.steady(scene.longitudinal, scene.lateral, {-1, scene.friction.normal_pressure});
          }) == "FrictionModel: friction_coefficient = -1 must be finite and not negative");
    CHECK(refusal([&] { scene.steady(scene.longitudinal, PlaneKernel<double>(10, 1, -0.28), scene.friction); }) != "");

    State next = model.at_rest();
    Workspace workspace = model.workspace();
    const Step huge = model.steady(model.at_rest(), {1e300, -1e300}, next, workspace);
    CHECK(huge.status == StepStatus::ok);
    CHECK(ratios(huge, scene.contact).longitudinal == Approx(std::sqrt(0.5)));
    CHECK(ratios(huge, scene.contact).lateral == Approx(-std::sqrt(0.5)));
}

TEST_CASE("Directions that do not belong together, or one of which grows, are refused", "[friction]") {
    const Scene scene(cosine_mesh<double>(8), 0.28, half, 10);
    const ElementSystem<double> along = scene.along(), across = scene.across();
    const auto paired = [&](const Scene& other) {
        return refusal([&] { ElementSystem<double, 2>(along, other.across()); });
    };
    CHECK(paired(scene) == "");
    CHECK(paired(Scene(cosine_mesh<double>(7), 0.28, half, 10)) ==
          "ElementSystem: number of lateral elements = 7 must equal the number of longitudinal ones");
    CHECK(paired(Scene(uniform_mesh<double>(8), 0.28, half, 10))
              .find("ElementSystem: width of a lateral element over that of the longitudinal one = ") == 0);
    CHECK(paired(Scene(scene.mesh, 0.28, half, 11)).find("ElementSystem: b/a of the lateral kernel = 11 must be") == 0);
    const StabilityVerdict settled{.n = 16, .unstable_count = 0, .uncertain_count = 0, .status = Status::ok};
    StabilityVerdict grows = settled;
    grows.unstable_count = 1;
    const auto judged = [&](const ElementSystem<double, 2>& pair, const StabilityVerdict& verdict) {
        return refusal([&] { Model(scene.contact, pair, verdict, scene.friction); });
    };
    CHECK(judged({along, across}, settled) == "");
    CHECK(judged({along, across}, grows) ==
          "FrictionModel: unstable_count = 1 must be 0: a mode of the scheme grows without bound");
    const ElementSystem<double> central = Scene(scene.mesh, 0.28, {.alpha_L = 0, .alpha_T = 0}, 10).across();
    for (const ElementSystem<double, 2>& pair : {ElementSystem(along, central), ElementSystem(central, along)}) {
        const StabilityVerdict verdict = judge_stability(pair);
        CHECK(verdict.n == 16);
        CHECK(verdict.uncertain_count == judge_stability(central).uncertain_count);
        CHECK_FALSE(verdict.stable());
        CHECK(judged(pair, settled).find("FrictionModel: share of steady traction that assists the creepage = ") == 0);
    }
}

}  // namespace
