// rollbem/friction/model.hpp: against closed forms, limits and symmetries.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "scene.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace friction_tests {
namespace {

TEST_CASE("The steady force converges to Carter's, of second order by node differences", "[friction]") {
    // known relative errors at n = first, 2 first, 4 first and 8 first, and their order
    struct Case {
        Topology topology;
        AnyScheme scheme;
        Eigen::Index first;
        double ratio, errors[4], low, high;
    };
    const AnyScheme centres = NodeDifference{Nodes::centres}, chebyshev = NodeDifference{Nodes::chebyshev};
    for (const Case& expected :
         {Case{Topology::uniform, half, 20, 0.5, {1.8e-2, 8.9e-3, 4.5e-3, 2.25e-3}, 0.9, 1.1},
          Case{Topology::cosine, half, 20, 0.5, {3.0e-3, 9.1e-4, 2.7e-4, 7.75e-5}, 1.6, 2.0},
          Case{Topology::cosine, Collocation{0, 0.5}, 20, 0.5, {6.5e-4, 2.45e-4, 7.3e-5, 2.15e-5}, 1.4, 2.0},
          Case{Topology::cosine, centres, 10, 0.5, {3.9e-3, 9.6e-4, 2.4e-4, 5.9e-5}, 1.9, 2.1},
          Case{Topology::cosine, chebyshev, 10, 0.5, {1.5e-3, 3.5e-4, 8.2e-5, 2.0e-5}, 1.9, 2.1},
          Case{Topology::cosine, centres, 10, 0.8, {2.9e-3, 6.3e-4, 1.4e-4, 4.6e-5}, 1.9, 2.1},
          // the error changes its sign
          Case{Topology::cosine, chebyshev, 10, 0.8, {3.1e-4, 1.0e-6, 1.2e-5, 7.5e-6}, 0, 9}}) {
        std::vector<double> sizes, errors;
        for (int k = 0; k < 4; ++k) {
            const Mesh<double> mesh = make_mesh<double>(expected.topology, expected.first << k, 1);
            const Contact contact = Contact::dimensionless(1e4, nu);
            const FrictionModel model(contact,
                                      steady_system(mesh, expected.scheme, PlaneKernel<double>::longitudinal(contact)),
                                      {1, peak * mean_hertz_pressure(mesh)});
            const FrictionStep point = from_scratch(model, creepage(expected.ratio));
            sizes.push_back(static_cast<double>(mesh.size()));
            errors.push_back(force_ratio(point, contact) / carter_force_ratio(expected.ratio) - 1);
            CAPTURE(expected.errors[0], expected.ratio, mesh.size(), errors.back(), point.rounds);
            CHECK(point.status == Status::ok);
            CHECK(point.complementarity_residual < 1e-12);
            CHECK(point.path_points == 0);
            CHECK(point.rounds <= 10);
            CHECK(std::abs(std::abs(errors.back()) - expected.errors[k]) < 0.02 * expected.errors[k] + 1e-6);
        }
        CAPTURE(errors, support::observed_order(sizes, errors));
        CHECK(support::observed_order(sizes, errors) > expected.low);
        CHECK(support::observed_order(sizes, errors) < expected.high);
    }
}

TEST_CASE("Tractions, border and work of steady rolling agree with Carter's solution", "[friction]") {
    std::vector<double> sizes, errors;
    for (const Eigen::Index n : {40, 80, 160}) {
        const Scene scene(cosine_mesh<double>(n));
        const FrictionModel model = scene.steady();
        Run run(model);
        const FrictionStep point = run.steady({.motion = Creepage{creepage(0.4)}});
        const FrictionState& state = run.now();
        const VectorX<double> slip = run.workspace().slip().col(0);
        const double widest = scene.mesh.widths().maxCoeff();
        double largest = 0;
        for (Eigen::Index i = 0; i < n; ++i) {
            const double x = scene.mesh.centres()[i];
            largest = std::max(largest, std::abs(state.traction(i, 0) / peak - carter_friction_traction(x, 0.4)));
            const Zone zone = state.zones[static_cast<std::size_t>(i)];
            if (x < carter_stick_border(0.4) - widest) CHECK(zone == Zone::slip_positive);
            if (x > carter_stick_border(0.4) + widest) CHECK(zone == Zone::stick);
            CHECK((zone == Zone::stick) == (slip[i] == 0));
        }
        CAPTURE(n, largest);
        CHECK(largest < 3.0 / static_cast<double>(n));
        // in steady rolling all the work is dissipated by slip, an independent check of the force
        sizes.push_back(static_cast<double>(n));
        errors.push_back(point.slip_work / (-point.force.longitudinal * creepage(0.4)) - 1);
        CHECK(point.slip_work > 0);
    }
    CAPTURE(errors);
    CHECK(std::abs(errors.back()) < 2e-4);
    CHECK(std::abs(support::observed_order(sizes, errors) - 2) < 0.1);
}

TEST_CASE("Results are totals over the width, or per metre where it is infinite", "[friction]") {
    const Mesh<double> mesh = cosine_mesh<double>(20);
    const auto solved = [&](double aspect) {  // which has no influence on the plane's G'
        const Contact contact = Contact::dimensionless(aspect, nu);
        const FrictionModel model(contact, steady_system(mesh, half, PlaneKernel<double>::longitudinal(contact)),
                                  {1, peak * mean_hertz_pressure(mesh)});
        return from_scratch(model, creepage(0.5));
    };
    const double infinite = std::numeric_limits<double>::infinity();
    const FrictionStep wide = solved(30), narrow = solved(5), per_metre = solved(infinite);
    CHECK(force_ratio(per_metre, Contact::dimensionless(infinite, nu)) ==
          Approx(carter_force_ratio(0.5)).epsilon(1e-2));
    for (const auto& [step, width] : {std::pair(wide, 60), {narrow, 10}}) {
        CHECK(step.force.longitudinal == Approx(width * per_metre.force.longitudinal).epsilon(1e-13));
        CHECK(slope(step) == Approx(width * slope(per_metre)).epsilon(1e-13));
        CHECK(step.slip_work == Approx(width * per_metre.slip_work).epsilon(1e-13));
    }
}

}  // namespace
}  // namespace friction_tests
