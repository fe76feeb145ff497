// rollbem/friction/model.hpp, friction/detail/slip_work.hpp, system/detail/centre_values.hpp: elastic energy and slip
// work.
#include <cmath>
#include <numbers>

#include <rollbem/friction/detail/slip_work.hpp>
#include <rollbem/system/detail/centre_values.hpp>

#include "scene.hpp"
#include "support/catch.hpp"

namespace friction_tests {
namespace {

// Energy of the tractions -mu p0 sqrt(1 - x^2/a^2), a = half_length, with G = 1: a sum of the Chebyshev polynomials T_0
// and T_2, in which the plane kernel is diagonal.
double sliding_energy(double half_length, double half_width) {
    const double c1 = 1 - nu, c2 = nu;
    const double mean = 2 * (c1 * std::log(4 * half_width / half_length) + c2), second = c1;
    return 2 * half_width * std::numbers::pi / 8 * (mean + second / 2) * peak * peak * half_length * half_length;
}

TEST_CASE("The elastic energy of full sliding is the exact one at any half-length", "[friction]") {
    const Mesh<double> mesh = cosine_mesh<double>(160);
    const Scene scene(mesh, half, 1, 50);
    const FrictionModel model = scene.transient();
    FrictionState state = model.at_rest();
    CHECK(model.elastic_energy(state) == 0);
    state.traction.col(0) = -peak * mean_hertz_pressure(mesh).matrix();
    for (const double half_length : {0.7, 1.0, 1.3}) {
        state.half_length = half_length;
        CAPTURE(half_length);
        CHECK(std::abs(model.elastic_energy(state) / sliding_energy(half_length, 50) - 1) < 1e-4);
    }

    // a strip has a single half-length
    const auto strip = rolling_system(mesh, half, StripKernel<double>::longitudinal(scene.contact));
    const FrictionModel rigid(scene.contact, strip, unchecked, scene.friction);
    CHECK(std::isnan(rigid.elastic_energy(state)));
    state.half_length = 1;
    CHECK(rigid.elastic_energy(state) > 0);
}

template <class Scheme>
ArrayX<double> points_of(const Mesh<double>& mesh, const Scheme& scheme) {
    return detail::line_elements(mesh, detail::BothRows<double>(scheme, mesh)).x;
}

using Values = detail::CentreValues<double>;

TEST_CASE("A slip linear in x is interpolated exactly at the centres", "[friction]") {
    const auto linear = [](const ArrayX<double>& x) { return VectorX<double>((0.7 - 0.4 * x).matrix()); };
    const auto check = [&](const Mesh<double>& mesh, const auto& scheme) {
        const ArrayX<double> points = points_of(mesh, scheme);
        const Eigen::Index n = points.size();
        const ArrayX<double> widths = unknown_widths(mesh, scheme);
        const Values values = Values::in_one_strip(widths, points);
        Elements<double> elements = Elements<double>::unplaced(widths);
        elements.x = points;
        const detail::SlipWork slip_work(elements, false);
        const VectorX<double> slip = linear(points), expected = linear(mesh.centres().head(n));
        for (Eigen::Index i = 0; i < n; ++i) {
            CAPTURE(mesh.size(), i);
            CHECK(std::abs(values.at(i, slip) - expected[i]) < 1e-13);
        }
        // work is added element by element, for any slip
        const VectorX<double> traction = points.sin().matrix(), uneven = (7 * points).cos().matrix();
        VectorX<double> works = VectorX<double>::Constant(n, 0.1);
        slip_work.add(traction, uneven, works, 2.0);
        for (Eigen::Index i = 0; i < n; ++i) {
            const double one = -2 * mesh.widths()[i] * traction[i] * values.at(i, uneven);
            CHECK(std::abs(works[i] - 0.1 - one) < 1e-15);
        }
    };
    for (const Eigen::Index n : {2, 3, 20}) {
        for (const Mesh<double>& mesh : {uniform_mesh<double>(n), cosine_mesh<double>(n), geometric_mesh(n, 3.0)}) {
            check(mesh, half);
            check(mesh, Collocation{.alpha_L = 0, .alpha_T = 0.63});
            check(mesh, Collocation{.alpha_L = 0.5, .alpha_T = 0.1});
            if (n == 2) continue;
            check(mesh, Galerkin{.alpha_L = 0, .alpha_T = 0.7, .quadrature = 7});
            check(mesh, KnotheBoundary{});
        }
    }
}

TEST_CASE("The slip is taken as it is without points, with a single one, or where points coincide", "[friction]") {
    const VectorX<double> slip = VectorX<double>{{5, 3, 2}};
    const ArrayX<double> widths = ArrayX<double>::Constant(3, 2.0 / 3);
    const Values bare = Values::in_one_strip(widths, {}), flat = Values::in_one_strip(widths, ArrayX<double>::Zero(3));
    for (Eigen::Index i = 0; i < 3; ++i) {
        CHECK(bare.at(i, slip) == slip[i]);
        CHECK(flat.at(i, slip) == slip[i]);
    }
    const Values one = Values::in_one_strip(ArrayX<double>::Constant(1, 2), ArrayX<double>::Constant(1, 1));
    CHECK(one.at(0, VectorX<double>::Constant(1, 4)) == 4);
    // Galerkin's equations are means over the elements themselves and do not involve neighbours
    const Mesh<double> mesh = uniform_mesh<double>(8);
    const Values galerkin = Values::in_one_strip(mesh.widths(), points_of(mesh, Galerkin{0, 0}));
    for (Eigen::Index i = 0; i < 8; ++i) {
        CHECK(std::abs(galerkin.at(i, VectorX<double>::Unit(8, i)) - 1) < 1e-14);
    }
}

TEST_CASE("No element gains energy where the slip reverses", "[friction]") {
    const Scene scene(cosine_mesh<double>(24), half, 1, 10);
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        const FrictionModel model = scene.transient(integrator);
        Run run(model);
        int turns = 0;
        for (int k = 0; k < 60; ++k) {
            const double wave = 1.5 * std::cos(2.3 * k);
            const FrictionStep step = k % 2 == 0 ? run.advance({0, Motion::shift({peak * wave})})
                                                 : run.advance({0.3, Creepage{creepage(4 * wave)}});
            REQUIRE(step.status == Status::ok);
            const VectorX<double>& work = run.workspace().slip_work();
            CHECK(work.minCoeff() >= 0);
            CHECK(std::abs(work.sum() - step.slip_work) <= 1e-14 * step.slip_work);
            const VectorX<double> slip = run.workspace().slip().col(0);
            for (Eigen::Index i = 1; i < 24; ++i) {
                if ((slip[i - 1] + slip[i]) * run.now().traction(i, 0) > 0) ++turns;
            }
        }
        CAPTURE(name(integrator), turns);
        CHECK(turns > 0);
    }
}

}  // namespace
}  // namespace friction_tests
