// rollbem/friction/detail/slip_work.hpp, and the slip work of friction problems.
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/friction/detail/slip_work.hpp>

#include "scene.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace friction_tests {
namespace {

template <class Scheme>
ArrayX<double> points_of(const Mesh<double>& mesh, const Scheme& scheme) {
    return detail::line_elements(mesh, detail::BothRows<double>(scheme, mesh)).x;
}

TEST_CASE("A slip linear in x is interpolated exactly at the centres", "[friction]") {
    const auto linear = [](const ArrayX<double>& x) { return VectorX<double>((0.7 - 0.4 * x).matrix()); };
    const auto check = [&](const Mesh<double>& mesh, const auto& scheme) {
        const ArrayX<double> points = points_of(mesh, scheme);
        const Eigen::Index n = points.size();
        const detail::SlipWork<double> slip_work(unknown_widths(mesh, scheme), points);
        const VectorX<double> slip = linear(points), expected = linear(mesh.centres().head(n));
        for (Eigen::Index i = 0; i < n; ++i) {
            CAPTURE(mesh.size(), i);
            CHECK(std::abs(slip_work.at_centre(i, slip) - expected[i]) < 1e-13);
        }
        VectorX<double> work = VectorX<double>::Constant(n, 0.1);
        slip_work.add(VectorX<double>::Constant(n, -3), slip, work);
        // element by element, for any slip
        const VectorX<double> traction = points.sin().matrix(), uneven = (7 * points).cos().matrix();
        VectorX<double> works = VectorX<double>::Zero(n);
        slip_work.add(traction, uneven, works, 2.0);
        for (Eigen::Index i = 0; i < n; ++i) {
            const double one = -2 * mesh.widths()[i] * traction[i] * slip_work.at_centre(i, uneven);
            CHECK(std::abs(works[i] - one) < 1e-15);
        }
        const double length = mesh.widths().head(n).sum();
        CHECK(std::abs(work.sum() - 0.1 * static_cast<double>(n) -
                       3 * (expected.array() * mesh.widths().head(n)).sum()) < 1e-13 * length * 3);
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

TEST_CASE("With points at the leading edges, the slip at a centre is the mean of both edges", "[friction]") {
    const Mesh<double> mesh = cosine_mesh<double>(6);
    const detail::SlipWork<double> slip_work(mesh.widths(), points_of(mesh, half));
    const VectorX<double> slip = VectorX<double>{{5, 3, 2, 0, 7, 1}};
    for (Eigen::Index i = 1; i < 6; ++i) {
        CHECK(std::abs(slip_work.at_centre(i, slip) - (slip[i - 1] + slip[i]) / 2) < 1e-13);
    }
    const double edge = slip[0] - (slip[1] - slip[0]) * mesh.widths()[0] / mesh.widths()[1];
    CHECK(std::abs(slip_work.at_centre(0, slip) - (edge + slip[0]) / 2) < 1e-13);
}

TEST_CASE("The slip is taken as it is without points, with a single one, or where points coincide", "[friction]") {
    const VectorX<double> slip = VectorX<double>{{5, 3, 2}};
    const ArrayX<double> widths = ArrayX<double>::Constant(3, 2.0 / 3);
    const detail::SlipWork<double> bare(widths, ArrayX<double>()), flat(widths, ArrayX<double>::Zero(3));
    for (Eigen::Index i = 0; i < 3; ++i) {
        CHECK(bare.at_centre(i, slip) == slip[i]);
        CHECK(flat.at_centre(i, slip) == slip[i]);
    }
    const detail::SlipWork<double> one(ArrayX<double>::Constant(1, 2), ArrayX<double>::Constant(1, 1));
    CHECK(one.at_centre(0, VectorX<double>::Constant(1, 4)) == 4);
    // Galerkin's equations are means over the elements themselves and do not involve neighbours
    const Mesh<double> mesh = uniform_mesh<double>(8);
    const detail::SlipWork<double> galerkin(mesh.widths(), points_of(mesh, Galerkin{0, 0}));
    for (Eigen::Index i = 0; i < 8; ++i) {
        CHECK(std::abs(galerkin.at_centre(i, VectorX<double>::Unit(8, i)) - 1) < 1e-14);
    }
}

TEST_CASE("The slip work of full sliding is exact on any mesh", "[friction]") {
    // creepage beyond that of full sliding adds (xi - xi_full) mu N, whatever the mesh
    for (const Eigen::Index n : {3, 10, 40}) {
        const Scene scene(cosine_mesh<double>(n));
        const double more = from_scratch(scene.steady(), creepage(3)).slip_work;
        const double less = from_scratch(scene.steady(), creepage(2)).slip_work;
        CHECK(std::abs((more - less) / (creepage(1) * full_force * scene.contact.width()) - 1) < 1e-12);
    }
}

TEST_CASE("No element gains energy where the slip reverses", "[friction]") {
    const Scene scene(cosine_mesh<double>(24), half, 1, 10);
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        const FrictionModel<> model = scene.transient(integrator);
        FrictionState<> now = model.at_rest(), next = now;
        FrictionWorkspace<> workspace = model.workspace();
        int turns = 0;
        for (int k = 0; k < 60; ++k) {
            const double wave = 1.5 * std::cos(2.3 * k);
            const FrictionStep<> step = k % 2 == 0 ? model.shift(now, peak * wave, next, workspace)
                                                   : model.advance(now, 0.3, creepage(4 * wave), next, workspace);
            REQUIRE(step.status == StepStatus::ok);
            CHECK(workspace.slip_work().minCoeff() >= 0);
            CHECK(std::abs(workspace.slip_work().sum() - step.slip_work) <= 1e-14 * step.slip_work);
            for (Eigen::Index i = 1; i < 24; ++i) {
                const double mean = (workspace.slip()[i - 1] + workspace.slip()[i]) / 2;
                if (mean * next.traction[i] > 0) ++turns;
            }
            std::swap(now, next);
        }
        CAPTURE(name(integrator), turns);
        CHECK(turns > 0);
    }
}

}  // namespace
}  // namespace friction_tests
