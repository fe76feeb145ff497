// rollbem/friction/model.hpp: against closed forms, limits and symmetries.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/steady.hpp>

#include "scene.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace friction_tests {
namespace {

TEST_CASE("The steady force converges to Carter's", "[friction]") {
    // known errors of a mesh that is not fitted to the border, at a creepage ratio of 0.5
    struct Case {
        bool cosine;
        Collocation scheme;
        double errors[4];
        double low, high;  // band of the observed order
    };
    const Case cases[] = {{false, half, {1.8e-2, 8.9e-3, 4.5e-3, 2.25e-3}, 0.9, 1.1},
                          {true, half, {3.0e-3, 9.1e-4, 2.7e-4, 7.75e-5}, 1.6, 2.0},
                          {true, {.alpha_L = 0, .alpha_T = 0.5}, {6.5e-4, 2.45e-4, 7.3e-5, 2.15e-5}, 1.4, 2.0}};
    for (const Case& expected : cases) {
        std::vector<double> sizes, errors;
        for (int k = 0; k < 4; ++k) {
            const Eigen::Index n = 20 << k;
            const Scene scene(expected.cosine ? cosine_mesh<double>(n) : uniform_mesh<double>(n), expected.scheme);
            const FrictionStep<> point = from_scratch(scene.steady(), creepage(0.5));
            sizes.push_back(static_cast<double>(n));
            errors.push_back(force_ratio(point, scene.contact) / carter_force_ratio(0.5) - 1);
            CAPTURE(expected.cosine, expected.scheme.alpha_L, n, errors.back(), point.rounds);
            CHECK(point.status == StepStatus::ok);
            CHECK(point.complementarity_residual < 1e-12);
            CHECK(point.pivots == 0);
            CHECK(point.rounds <= 10);
            CHECK(std::abs(errors.back()) < 1.02 * expected.errors[k]);
        }
        const double order = support::observed_order(sizes, errors);
        CAPTURE(expected.cosine, expected.scheme.alpha_L, order);
        CHECK(order > expected.low);
        CHECK(order < expected.high);
    }
}

TEST_CASE("Node differences make steady friction of second order", "[friction]") {
    // relative errors of the force at n = 10, 20, 40, 80
    struct Case {
        Nodes nodes;
        double ratio, errors[4];
    };
    const Case cases[] = {{Nodes::centres, 0.5, {3.9e-3, 9.6e-4, 2.4e-4, 5.9e-5}},
                          {Nodes::chebyshev, 0.5, {1.5e-3, 3.5e-4, 8.2e-5, 2.0e-5}},
                          {Nodes::centres, 0.8, {2.9e-3, 6.3e-4, 1.4e-4, 4.6e-5}},
                          {Nodes::chebyshev, 0.8, {3.1e-4, 1.0e-6, 1.2e-5, 7.5e-6}}};
    for (const Case& expected : cases) {
        std::vector<double> sizes, errors;
        for (int k = 0; k < 4; ++k) {
            const Mesh<double> mesh = cosine_mesh(Eigen::Index{10} << k);
            const Contact<double> contact = Contact<double>::dimensionless(1e4, nu);
            const FrictionModel<> model(
                contact,
                steady_system(mesh, NodeDifference{expected.nodes}, PlaneKernel<double>::longitudinal(contact)),
                {1, peak * mean_hertz_pressure(mesh)});
            const FrictionStep<> point = from_scratch(model, creepage(expected.ratio));
            sizes.push_back(static_cast<double>(mesh.size()));
            errors.push_back(force_ratio(point, contact) / carter_force_ratio(expected.ratio) - 1);
            CAPTURE(expected.nodes == Nodes::centres, expected.ratio, mesh.size(), errors.back());
            CHECK(point.status == StepStatus::ok);
            CHECK(std::abs(std::abs(errors.back()) - expected.errors[k]) < 0.02 * expected.errors[k] + 1e-6);
        }
        // at 0.8 with Chebyshev nodes the error changes its sign
        if (expected.nodes == Nodes::centres || expected.ratio == 0.5) {
            CAPTURE(expected.ratio, support::observed_order(sizes, errors));
            CHECK(std::abs(support::observed_order(sizes, errors) - 2) < 0.1);
        }
    }
}

TEST_CASE("Tractions, border and work of steady rolling agree with Carter's solution", "[friction]") {
    std::vector<double> sizes, errors;
    for (const Eigen::Index n : {40, 80, 160}) {
        const Scene scene(cosine_mesh<double>(n));
        const FrictionModel<> model = scene.steady();
        const FrictionState<> rest = model.at_rest();
        FrictionState<> state = rest;
        FrictionWorkspace<> workspace = model.workspace();
        const FrictionStep<> point = model.steady(rest, creepage(0.4), state, workspace);
        const double widest = scene.mesh.widths().maxCoeff();
        double largest = 0;
        for (Eigen::Index i = 0; i < n; ++i) {
            const double x = scene.mesh.centres()[i];
            largest = std::max(largest, std::abs(state.traction[i] / peak - carter_friction_traction(x, 0.4)));
            const Zone zone = state.zones[static_cast<std::size_t>(i)];
            if (x < carter_stick_border(0.4) - widest) CHECK(zone == Zone::slip_positive);
            if (x > carter_stick_border(0.4) + widest) CHECK(zone == Zone::stick);
            CHECK((zone == Zone::stick) == (workspace.slip()[i] == 0));
        }
        CAPTURE(n, largest);
        CHECK(largest < 3.0 / static_cast<double>(n));
        // in steady rolling all the work is dissipated by slip, an independent check of the force
        sizes.push_back(static_cast<double>(n));
        errors.push_back(point.slip_work / (-point.force * creepage(0.4)) - 1);
        CHECK(point.slip_work > 0);
    }
    CAPTURE(errors);
    CHECK(std::abs(errors.back()) < 2e-4);
    CHECK(std::abs(support::observed_order(sizes, errors) - 2) < 0.1);
}

TEST_CASE("The fallback finds the solution where the zones cycle", "[friction]") {
    int fallbacks = 0;
    for (const double alpha_T : {0.5, 0.63}) {
        for (const Eigen::Index n : {20, 40, 80}) {
            const Scene scene(cosine_mesh<double>(n), {.alpha_L = 0, .alpha_T = alpha_T});
            const FrictionStep<> point = from_scratch(scene.steady(), creepage(0.95));
            CAPTURE(alpha_T, n, point.rounds, point.pivots, point.complementarity_residual,
                    force_ratio(point, scene.contact));
            CHECK(point.status == StepStatus::ok);
            CHECK(point.complementarity_residual < 1e-12);
            CHECK(std::abs(force_ratio(point, scene.contact) / carter_force_ratio(0.95) - 1) < 1e-3);
            if (alpha_T == 0.5 && n != 40) CHECK(point.pivots > 0);
            fallbacks += point.pivots > 0 ? 1 : 0;
        }
    }
    CHECK(fallbacks >= 4);
}

TEST_CASE("Results are totals over the width, or per metre where it is infinite", "[friction]") {
    const Mesh<double> mesh = cosine_mesh<double>(20);
    const auto solved = [&](double aspect) {  // which has no influence on the plane's G'
        const Contact<double> contact = Contact<double>::dimensionless(aspect, nu);
        const FrictionModel<> model(contact, steady_system(mesh, half, PlaneKernel<double>::longitudinal(contact)),
                                    {1, peak * mean_hertz_pressure(mesh)});
        return from_scratch(model, creepage(0.5));
    };
    const double infinite = std::numeric_limits<double>::infinity();
    const FrictionStep<> wide = solved(30), narrow = solved(5), per_metre = solved(infinite);
    CHECK(force_ratio(per_metre, Contact<double>::dimensionless(infinite, nu)) ==
          Approx(carter_force_ratio(0.5)).epsilon(1e-2));
    for (const auto& [step, width] : {std::pair(wide, 60), {narrow, 10}}) {
        CHECK(step.force == Approx(width * per_metre.force).epsilon(1e-13));
        CHECK(step.tangent == Approx(width * per_metre.tangent).epsilon(1e-13));
        CHECK(step.slip_work == Approx(width * per_metre.slip_work).epsilon(1e-13));
    }
}

}  // namespace
}  // namespace friction_tests
