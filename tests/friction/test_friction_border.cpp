// rollbem/friction/border.hpp
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <rollbem/closed_form/friction.hpp>

#include "scene.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace {

using namespace friction_tests;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Pressure = std::function<ArrayX<double>(const Mesh<double>&)>;

FittedFrictionSolution<double> fitted_solution(const Scene& scene, Eigen::Index n, const Pressure& pressure,
                                               double xi) {
    return solve_fitted_friction(scene.contact, n, scene.kernel, 1.0, pressure, xi);
}

TEST_CASE("a mesh fitted to the border", "[friction]") {
    const Scene scene(cosine_mesh<double>(40));
    const Pressure pressure = [](const Mesh<double>& mesh) { return ArrayX<double>(peak * mean_hertz_pressure(mesh)); };
    for (const double ratio : {-0.5, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9}) {
        const auto fitted = fitted_solution(scene, 40, pressure, creepage(ratio));
        CAPTURE(ratio, fitted.force_per_width, fitted.complementarity_residual, fitted.evaluations);
        CHECK(fitted.fitted);
        CHECK(fitted.status == StepStatus::ok);
        CHECK(std::abs(-fitted.force_per_width / full_force / carter_force_ratio(ratio) - 1) < 8e-5);
        CHECK(std::abs(fitted.border - carter_stick_border(ratio)) < 5e-3);
        CHECK(fitted.slip_work_per_width > 0);
        CHECK(fitted.evaluations <= 14);
        // by the creepage: d F / d delta = -mu N 2 (1 - delta)
        CHECK(fitted.tangent_per_width * creepage(1) / -full_force == Approx(2 * (1 - std::abs(ratio))).margin(0.01));
        const double sign = ratio < 0 ? -1 : 1;
        for (Eigen::Index i = 0; i < 40; ++i) {
            const double x = fitted.mesh.centres()[i];
            CHECK(std::abs(fitted.traction[i] / peak - carter_friction_traction(x, ratio)) < 0.15);
            CHECK((x < fitted.border ? sign * fitted.slip[i] > -1e-4 * peak : fitted.slip[i] == 0));
        }
        CHECK(sign * fitted.slip.sum() > 0);
    }
    std::vector<double> sizes, errors;
    for (const Eigen::Index n : {20, 40, 80, 160}) {
        const auto fitted = fitted_solution(scene, n, pressure, creepage(0.5));
        sizes.push_back(static_cast<double>(n));
        errors.push_back(-fitted.force_per_width / full_force / carter_force_ratio(0.5) - 1);
    }
    CAPTURE(errors);
    CHECK(support::observed_order(sizes, errors) > 3.2);
    CHECK_THROWS_AS(border_mesh<double>(3, 3, 2.0), std::invalid_argument);
    // beyond full sliding, and just below, where it hands over to the plain solver
    const auto sliding = fitted_solution(scene, 40, pressure, creepage(1.1));
    CHECK(-sliding.force_per_width == Approx(full_force).epsilon(1e-13));
    CHECK(sliding.border == 1);
    // without creepage, where there is no border to seek
    const auto still = fitted_solution(scene, 40, pressure, 0);
    CHECK(still.status == StepStatus::ok);
    CHECK_FALSE(still.fitted);
    CHECK(still.force_per_width == 0);
    CHECK(still.evaluations == 2);
    CHECK(still.tangent_per_width * creepage(1) / -full_force == Approx(2).margin(1e-3));
    const auto unknown = fitted_solution(scene, 40, pressure, nan);
    CHECK(unknown.status == StepStatus::not_finite);
    CHECK(std::isnan(unknown.force_per_width));
    const auto nearly = fitted_solution(scene, 40, pressure, creepage(0.9999));
    CHECK(nearly.status == StepStatus::ok);
    CHECK(std::abs(-nearly.force_per_width / full_force - 1) < 1e-4);
}

TEST_CASE("a mesh fitted to the border under another pressure", "[friction]") {
    // leaning to the leading edge; the reference is the plain solver on a mesh that is an order finer
    const Pressure pressure = [](const Mesh<double>& mesh) {
        return ArrayX<double>(peak * (1 + 0.4 * mesh.centres()) * mean_hertz_pressure(mesh));
    };
    for (const double ratio : {0.3, 0.7}) {
        Scene scene(cosine_mesh<double>(640));
        scene.friction.normal_pressure = pressure(scene.mesh);
        const double reference = from_scratch(scene.steady(), creepage(ratio)).force_per_width;
        const auto fitted = fitted_solution(scene, 40, pressure, creepage(ratio));
        CAPTURE(ratio, fitted.fitted, fitted.force_per_width / reference - 1);
        CHECK(fitted.fitted);
        CHECK(std::abs(fitted.force_per_width / reference - 1) < 1.5e-4);
    }
    // two humps slip apart from each other: no single border
    const Pressure humps = [](const Mesh<double>& mesh) {
        return ArrayX<double>(peak * (0.02 + mesh.centres().square()) * mean_hertz_pressure(mesh));
    };
    Scene scene(cosine_mesh<double>(40));
    scene.friction.normal_pressure = humps(scene.mesh);
    const auto fitted = fitted_solution(scene, 40, humps, creepage(0.1));
    CAPTURE(fitted.fitted);
    CHECK(fitted.status == StepStatus::ok);
    CHECK_FALSE(fitted.fitted);
    CHECK(fitted.force_per_width == Approx(from_scratch(scene.steady(), creepage(0.1)).force_per_width).epsilon(1e-12));
}

TEST_CASE("A fitted border stands up to a residual of 0.05", "[friction]") {
    const Contact<double> contact = Contact<double>::dimensionless(1e4, 0.25);
    const PlaneKernel<double> kernel = PlaneKernel<double>::longitudinal(contact);
    // the more the pressure leans to the trailing edge, the less a single slip zone there is true
    struct Case {
        double lean;
        double residual;  // of the fitted solution, where it stands
        bool fitted;
    };
    for (const Case& expected : {Case{0.95, 0.0483, true}, Case{1, 0, false}}) {
        const auto pressure = [&](const Mesh<double>& mesh) -> ArrayX<double> {
            return peak * (1 - expected.lean * mesh.centres()) * mean_hertz_pressure(mesh);
        };
        const double xi = 0.75 * peak;
        const auto solution = solve_fitted_friction(contact, 40, kernel, 1.0, pressure, xi);
        CAPTURE(expected.lean, solution.complementarity_residual);
        CHECK(solution.status == StepStatus::ok);
        CHECK(solution.fitted == expected.fitted);
        if (expected.fitted) {
            CHECK(solution.complementarity_residual == Approx(expected.residual).epsilon(0.01));
            CHECK(solution.border > -1);
            continue;
        }
        CHECK(std::isnan(solution.border));
        CHECK(std::isnan(solution.force_error));
        const SteadyFrictionModel<double> plain(contact, cosine_mesh<double>(40), half, kernel,
                                                {1, pressure(cosine_mesh<double>(40))});
        CHECK(solution.force_per_width == Approx(from_scratch(plain, xi).force_per_width).epsilon(1e-12));
    }
}

}  // namespace
