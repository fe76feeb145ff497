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
