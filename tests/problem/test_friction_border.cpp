// rollbem/problem/friction_border.hpp: when the fitted solution stands, and when the plain one takes its place.
#include <cmath>

#include "rollbem/problem/friction_border.hpp"
#include "rollbem/problem/hertz.hpp"
#include "support/catch.hpp"

namespace {

using namespace rollbem;

constexpr double peak = 1e-3;  // mu p0, with a = G = 1

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
        const double creepage = 0.75 * peak;
        const auto solution = solve_fitted_friction(contact, 40, kernel, 1.0, pressure, creepage);
        CAPTURE(expected.lean, solution.complementarity_residual);
        CHECK(solution.status == FrictionStatus::ok);
        CHECK(solution.fitted == expected.fitted);
        if (expected.fitted) {
            CHECK(solution.complementarity_residual == Approx(expected.residual).epsilon(0.01));
            CHECK(solution.border > -1);
            continue;
        }
        CHECK(std::isnan(solution.border));
        CHECK(std::isnan(solution.force_error));
        const SteadyFrictionModel<double> plain(contact, cosine_mesh<double>(40),
                                                Collocation{.alpha_L = 0.5, .alpha_T = 0.5}, kernel,
                                                {1, pressure(cosine_mesh<double>(40))});
        const FrictionState<double> rest = plain.at_rest();
        FrictionState<double> state = rest;
        CHECK(solution.force_per_width == Approx(plain.solve(rest, creepage, state).force_per_width).epsilon(1e-12));
    }
}

}  // namespace
