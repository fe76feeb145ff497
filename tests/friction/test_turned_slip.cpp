// rollbem/friction/model.hpp: both creepages and spin, with slip turned by half an element.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/friction/detail/slip_rotation.hpp>

#include "friction/scene.hpp"
#include "support/catch.hpp"
#include "support/refusal.hpp"
#include "support/unturned.hpp"

namespace turned_slip_tests {
namespace {

using namespace rollbem;

using friction_tests::full_force, friction_tests::half, friction_tests::peak;

constexpr double nu = 0.28;
constexpr Integrator integrators[] = {Integrator::implicit_euler, Integrator::sdirk2};

using Step = FrictionStep;
using Model = FrictionModel;
using Motion = RigidMotion<Creepage>;

struct Scene {
    explicit Scene(Mesh<double> mesh_, AnyScheme scheme_ = half, double aspect = 1000)
        : contact(Contact::dimensionless(aspect, nu)),
          longitudinal(PlaneKernel<double>::longitudinal(contact)),
          lateral(PlaneKernel<double>::lateral(contact)),
          mesh(std::move(mesh_)),
          scheme(scheme_),
          friction{1, peak * mean_hertz_pressure(mesh)} {}

    /// Creepage by its ratio to full sliding's in Carter's problem, and its angle in degrees; spin by that ratio.
    Creepage creepage(double ratio, double degrees, double spin) const {
        const double unit = 2 * (1 - nu) * peak, angle = degrees * std::numbers::pi / 180;
        return {unit * ratio * std::cos(angle), unit * ratio * std::sin(angle), unit * spin};
    }
    ElementSystem<double> along() const { return rolling_system(mesh, scheme, longitudinal); }
    ElementSystem<double> across() const { return rolling_system(mesh, scheme, lateral); }
    ElementSystem<double, 2> system() const { return {along(), across()}; }
    Model steady() const {
        return {contact, {steady_system(mesh, scheme, longitudinal), steady_system(mesh, scheme, lateral)}, friction};
    }
    Model transient(Integrator integrator = Integrator::sdirk2) const {
        return {contact, system(), unchecked, friction, integrator};
    }

    Contact contact;
    PlaneKernel<double> longitudinal, lateral;
    Mesh<double> mesh;
    AnyScheme scheme;
    Friction friction;
};

/// A scene whose equations are node differences between Chebyshev points.
Scene nodal(Eigen::Index n, double aspect = 1000) {
    return Scene(cosine_mesh<double>(n), NodeDifference{.nodes = Nodes::chebyshev}, aspect);
}

/// The solution from rest, in a new workspace.
Step from_scratch(const Model& model, const Creepage& creepage) { return Run(model).steady({.motion = creepage}); }

/// Negative forces over mu N.
Eigen::Array2d ratios(const Step& step, const Contact& contact) {
    return -Eigen::Array2d(step.force.longitudinal, step.force.lateral) / (full_force * contact.width());
}

TEST_CASE("With turned slip, forces agree with two other programs and work becomes heat, to second order",
          "[friction]") {
    struct Point {
        double ratio, degrees, spin, longitudinal, lateral, errors[3];  // at n = 20, 40, 80
    };
    for (const Point& point : {Point{0.5, 45, 0, 0.54355, 0.40941, {2.6e-4, 9.1e-5, 5.5e-5}},
                               Point{0.25, 60, 0, 0.22240, 0.28242, {3.0e-4, 1.0e-4, 4.4e-5}},
                               Point{0.9, 45, 0, 0.74289, 0.59337, {4.5e-4, 1.5e-4, 3.6e-5}},
                               Point{0, 0, 0.5, 0, 0.36000, {1.0e-3, 2.7e-4, 6.8e-5}},
                               Point{0.3, 0, 1, 0.49107, 0.67344, {1.3e-3, 2.1e-4, 6.0e-5}},
                               Point{0.3, 90, 1, 0, 0.98537, {9.6e-4, 2.1e-4, 6.7e-5}}}) {
        for (Eigen::Index k = 0; k < 3; ++k) {
            const Eigen::Index n = 20 << k;
            const double expected = point.errors[k];
            const Scene scene = nodal(n);
            const Creepage creepage = scene.creepage(point.ratio, point.degrees, point.spin);
            const Step step = from_scratch(scene.steady(), creepage);
            const double error =
                (ratios(step, scene.contact) - Eigen::Array2d(point.longitudinal, point.lateral)).abs().maxCoeff();
            CAPTURE(point.ratio, point.degrees, point.spin, n, error);
            CHECK(step.status == Status::ok);
            CHECK(std::abs(error - expected) < std::max(0.1 * expected, 1e-5));
            if (n == 40) CHECK(error < 3e-4);
            if (point.ratio <= 0.25) continue;  // little slips
            const double work = -step.force.longitudinal * creepage.longitudinal -
                                step.force.lateral * creepage.lateral - step.force.moment * creepage.spin;
            CHECK(std::abs(step.slip_work / work - 1) < 1.6 / static_cast<double>(n * n));
        }
    }
}

TEST_CASE("Spin that makes everything slip has the moment of full sliding about the middle", "[friction]") {
    // the lateral slip phi x changes its sign in the middle: M = -mu int p_n |x| dx = -(4/(3 pi)) mu N a
    const Scene scene = nodal(80);
    const Step step = from_scratch(scene.steady(), {0, 0, 1e4});
    CHECK(step.status == Status::ok);
    CHECK(std::abs(-step.force.moment / (full_force * scene.contact.width()) - 4 / (3 * std::numbers::pi)) < 1e-3);
    // slip reverses at the middle, the point of a row: its element, with 2/n of the load, slides either way
    CHECK(std::abs(ratios(step, scene.contact)[1]) < 4.01 / 80);
    const Step across = from_scratch(scene.steady(), {0, 1});
    CHECK(std::abs(across.force.moment) < 1e-12 * full_force * scene.contact.width());
    const Scene one(uniform_mesh<double>(1));
    const Step single = from_scratch(one.steady(), {1e-2, 0, 1e-2});
    CHECK(single.status == Status::ok);
    CHECK(single.stick_count == 0);
}

TEST_CASE("Spin needs the points of the equations", "[friction]") {
    const Scene scene = nodal(8);
    const ElementSystem<double, 2> system = scene.system();
    const ElementSystem<double> x(system.G(0, 0), system.G_prime(0, 0), scene.mesh.widths());
    const ElementSystem<double> y(system.G(1, 1), system.G_prime(1, 1), scene.mesh.widths());
    const Model model(scene.contact, {x, y}, unchecked, scene.friction);
    const Creepage spin = scene.creepage(0.3, 40, 0.1);
    Run run(model);
    CHECK(run.steady({.motion = spin}).status == Status::needs_places);
    for (const Motion& motion : {Motion(spin), Motion::linear(spin, {}), Motion::linear({}, spin)}) {
        CHECK(run.advance({0.2, motion}).status == Status::needs_places);
    }
    CHECK(run.advance({0, Motion::shift(spin)}).status == Status::needs_places);
    CHECK(run.next().traction.isZero(0));
    // without spin its slip is not turned, and its moment is not known
    const Step step = run.steady({.motion = scene.creepage(0.3, 40, 0)});
    CHECK(step.status == Status::ok);
    CHECK(std::isnan(step.force.moment));
    const ElementSystem<double, 2> unturned{
        support::unturned(rolling_system(scene.mesh, scene.scheme, scene.longitudinal)),
        support::unturned(rolling_system(scene.mesh, scene.scheme, scene.lateral))};
    const Step expected =
        from_scratch(Model(scene.contact, unturned, unchecked, scene.friction), scene.creepage(0.3, 40, 0));
    CHECK(step.force.lateral == Approx(expected.force.lateral).epsilon(1e-12));
}

TEST_CASE("Each solution of a step nearly like the one before takes two Newton steps", "[friction]") {
    const Scene scene = nodal(20);
    for (const Integrator integrator : integrators) {
        const Model model = scene.transient(integrator);
        const int stages = integrator == Integrator::sdirk2 ? 2 : 1;
        Run run(model);
        for (int k = 0; k < 60; ++k) {
            const Step step = run.advance({0.05, scene.creepage(0.2, 30, 0.5 + 1e-4 * k)});
            REQUIRE(step.status == Status::ok);
            if (k < 40) continue;  // not yet settled
            CAPTURE(k, name(integrator));
            CHECK(step.rounds == 2 * 2 * stages);  // with slip as it is and with slip turned
        }
    }
}

TEST_CASE("Directions that do not belong together, or one of which grows, are refused", "[friction]") {
    const Scene scene(cosine_mesh<double>(8), half, 10);
    const ElementSystem<double> along = scene.along(), across = scene.across();
    const auto paired = [&](const Scene& other) {
        return refusal([&] { ElementSystem<double, 2>(along, other.across()); });
    };
    CHECK(paired(scene) == "");
    CHECK(paired(Scene(cosine_mesh<double>(7), half, 10)) ==
          "ElementSystem: number of lateral elements = 7 must equal the number of longitudinal ones");
    CHECK(paired(Scene(uniform_mesh<double>(8), half, 10))
              .find("ElementSystem: width of a lateral element over the width of the longitudinal one = ") == 0);
    CHECK(paired(Scene(scene.mesh, half, 11)).find("ElementSystem: b/a of the lateral kernel = 11 must be") == 0);
    const StabilityVerdict settled{.n = 16, .unstable_count = 0, .uncertain_count = 0, .status = Status::ok};
    StabilityVerdict grows = settled;
    grows.unstable_count = 1;
    const auto judged = [&](const ElementSystem<double, 2>& pair, const StabilityVerdict& verdict) {
        return refusal([&] { Model(scene.contact, pair, verdict, scene.friction); });
    };
    CHECK(judged({along, across}, settled) == "");
    CHECK(judged({along, across}, grows) ==
          "FrictionModel: unstable_count = 1 must be 0: a mode of the scheme grows without bound");
    const ElementSystem<double> central = Scene(scene.mesh, Collocation{.alpha_L = 0, .alpha_T = 0}, 10).across();
    for (const ElementSystem<double, 2>& pair : {ElementSystem(along, central), ElementSystem(central, along)}) {
        const StabilityVerdict verdict = judge_stability(pair);
        CHECK(verdict.n == 16);
        CHECK(verdict.uncertain_count == judge_stability(central).uncertain_count);
        CHECK_FALSE(verdict.stable());
        CHECK(judged(pair, settled).find("FrictionModel: share of steady traction that assists the creepage = ") == 0);
    }
}

TEST_CASE("Halved angles change at half the rate", "[friction]") {
    const auto centres = detail::CentreValues<double>::in_strips({-1, 0, 1});
    detail::Roles<2> roles(3);
    detail::Vectors<2> slip(3, 2), change(3, 2);
    slip << 1, 0.2, 0.8, 0.6, 1.1, -0.3;
    change << 0.3, -0.1, 0.2, 0.4, -0.5, 0.1;
    for (Eigen::Index i = 0; i < 3; ++i) roles.slide(i, Eigen::RowVector2d(-slip.row(i)));
    detail::SlipRotation<2> rotation(3);
    REQUIRE(rotation.find(centres, slip, roles));
    const auto angles = [&] {
        Eigen::Vector3d result;
        for (Eigen::Index i = 0; i < 3; ++i) {
            const Eigen::RowVector2d turned = rotation.turned(i, Eigen::RowVector2d(1, 0));
            result[i] = std::atan2(turned[1], turned[0]);
        }
        return result;
    };
    const auto rates = [&] {
        Eigen::VectorXd result(3);
        rotation.find_angle_change(centres, change, result);
        return result;
    };
    const Eigen::Vector3d whole = angles(), rate = rates();
    CHECK(rate.norm() > 0.05);
    rotation.halve();
    CHECK((angles() - whole / 2).norm() < 1e-15);
    CHECK((rates() - rate / 2).norm() < 1e-15);
}

}  // namespace
}  // namespace turned_slip_tests
