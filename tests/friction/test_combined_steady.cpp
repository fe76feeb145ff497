// rollbem/friction/steady.hpp
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/steady.hpp>

#include "friction/combined_scene.hpp"
#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace {

using namespace combined_tests;

TEST_CASE("Steady forces under both creepages agree with two other programs", "[friction]") {
    const SteadyFrictionModel<ConstantFriction<>, 2> model = Scene(cosine_mesh<double>(160)).plain().steady();
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
        CHECK(std::abs(ratios(step).longitudinal - point.longitudinal) < 3e-4);
        CHECK(std::abs(ratios(step).lateral - point.lateral) < 3e-4);
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

TEST_CASE("With Poisson's ratio zero, the solution is that of one direction, along the creepage", "[friction]") {
    const Scene scene = Scene(cosine_mesh<double>(60), 0).plain();
    const SteadyFrictionModel<ConstantFriction<>, 2> model = scene.steady();
    const SteadyFrictionModel<> one(scene.contact, scene.mesh, scene.scheme, scene.longitudinal, scene.friction);
    State state;
    for (const double ratio : {0.1, 0.35, 0.5, 0.8, 0.97, 1.0, 1.1}) {
        const FrictionState<> rest = one.at_rest();
        FrictionState<> along = rest;
        FrictionWorkspace<> workspace = one.workspace();
        const FrictionStep<> expected = one.steady(rest, 2 * peak * ratio, along, workspace);
        for (const double degrees : {0.0, 17.0, 45.0, 90.0, 133.0, 180.0, 251.0, 330.0}) {
            const Step step = from_scratch(model, scene.creepage(ratio, degrees), state);
            CAPTURE(ratio, degrees);
            CHECK(step.status == StepStatus::ok);
            const double cosine = std::cos(degrees * std::numbers::pi / 180);
            const double sine = std::sin(degrees * std::numbers::pi / 180);
            const double force = expected.force_per_width;
            CHECK(std::abs(step.force_per_width.longitudinal - force * cosine) < 1e-10 * full_force);
            CHECK(std::abs(step.force_per_width.lateral - force * sine) < 1e-10 * full_force);
            CHECK((state.traction.col(0) - along.traction * cosine).cwiseAbs().maxCoeff() < 1e-10 * peak);
            CHECK((state.traction.col(1) - along.traction * sine).cwiseAbs().maxCoeff() < 1e-10 * peak);
            CHECK(step.slip_work_per_width ==
                  Approx(expected.slip_work_per_width).epsilon(1e-9).margin(1e-12 * peak * peak));
            CHECK(step.stick_count == expected.stick_count);
            CHECK(-force / full_force == Approx(ratio < 1 ? carter_force_ratio(ratio) : 1).epsilon(3e-3));
            // changes along the creepage follow Carter's curve, changes across it rotate the force
            const CreepageTangent<double>& tangent = step.tangent_per_width;
            const double across = force / (2 * peak * ratio), own = expected.tangent_per_width;
            CHECK(tangent.by_longitudinal.longitudinal ==
                  Approx(own * cosine * cosine + across * sine * sine).margin(1e-8));
            CHECK(tangent.by_lateral.longitudinal == Approx((own - across) * cosine * sine).margin(1e-8));
        }
    }
}

TEST_CASE("c22 is the lateral force of friction far below its bound", "[friction]") {
    const Contact<double> contact = Contact<double>::dimensionless(2, 0.28);
    const Mesh<double> mesh = cosine_mesh(20);
    const Friction<> grip{1e6, ArrayX<double>::Ones(20)};
    const SteadyFrictionModel<ConstantFriction<>, 2> model(contact, mesh, Collocation{},
                                                           StripKernel<double>::longitudinal(contact),
                                                           StripKernel<double>::lateral(contact), grip);
    auto workspace = model.workspace();
    auto now = model.at_rest(), next = model.at_rest();
    const auto step = model.steady(now, {.longitudinal = 1e-3, .lateral = 2e-3}, next, workspace);
    REQUIRE(step.status == StepStatus::ok);
    const auto across = solve_steady(contact, mesh, Collocation{}, StripKernel<double>::lateral(contact), 2e-3);
    CHECK(std::abs(step.force_per_width.lateral / across.force_per_width - 1) < 1e-12);
    const auto along = solve_steady(contact, mesh, Collocation{}, 1e-3);
    CHECK(std::abs(step.force_per_width.longitudinal / along.force_per_width - 1) < 1e-12);
    CHECK(across.c11 < 0.99 * along.c11);
}

TEST_CASE("Steady rolling with creepage in one direction agrees with the model of that direction", "[friction]") {
    const Scene scene = Scene(cosine_mesh<double>(40)).plain();
    const SteadyFrictionModel<ConstantFriction<>, 2> model = scene.steady();
    const SteadyFrictionModel<> along(scene.contact, scene.mesh, scene.scheme, scene.longitudinal, scene.friction);
    const SteadyFrictionModel<> across(scene.contact, scene.mesh, scene.scheme, scene.lateral, scene.friction);
    for (const double ratio : {-0.7, -0.2, 0.05, 0.5, 0.9, 1.0, 1.3}) {
        for (const bool lateral : {false, true}) {
            const SteadyFrictionModel<>& one = lateral ? across : along;
            const double size = 2 * (1 - scene.nu) * peak * ratio;
            const FrictionState<> rest = one.at_rest();
            FrictionState<> expected_state = rest;
            FrictionWorkspace<> workspace = one.workspace();
            const FrictionStep<> expected = one.steady(rest, size, expected_state, workspace);
            const Step step = from_scratch(model, lateral ? Creepage<double>{0, size} : Creepage<double>{size, 0});
            CAPTURE(ratio, lateral);
            const TangentialForce<double>& force = step.force_per_width;
            CHECK((lateral ? force.lateral : force.longitudinal) == Approx(expected.force_per_width).epsilon(1e-12));
            CHECK((lateral ? force.longitudinal : force.lateral) == 0);
            const CreepageTangent<double>& tangent = step.tangent_per_width;
            CHECK((lateral ? tangent.by_lateral.lateral : tangent.by_longitudinal.longitudinal) ==
                  Approx(expected.tangent_per_width).margin(1e-11));
            CHECK(step.slip_work_per_width == Approx(expected.slip_work_per_width).epsilon(1e-11));
            CHECK(step.stick_count == expected.stick_count);
        }
    }
}

TEST_CASE("Exchanging kernels and creepages exchanges the forces", "[friction]") {
    const Scene scene(cosine_mesh<double>(24));
    const SteadyFrictionModel<ConstantFriction<>, 2> model = scene.steady();
    const SteadyFrictionModel<ConstantFriction<>, 2> swapped(scene.contact, scene.mesh, scene.scheme, scene.lateral,
                                                             scene.longitudinal, scene.friction);
    for (const double ratio : {0.2, 0.6, 0.95, 1.05, 4.0}) {
        for (const double degrees : {10.0, 45.0, 77.0, 120.0}) {
            const Creepage<double> creepage = scene.creepage(ratio, degrees);
            const Step one = from_scratch(model, creepage);
            const Step other = from_scratch(swapped, {creepage.lateral, creepage.longitudinal});
            // one direction reversed
            const Step mirrored = from_scratch(model, {creepage.longitudinal, -creepage.lateral});
            CAPTURE(ratio, degrees);
            CHECK(std::abs(one.force_per_width.longitudinal - other.force_per_width.lateral) < 1e-12 * full_force);
            CHECK(std::abs(one.force_per_width.lateral - other.force_per_width.longitudinal) < 1e-12 * full_force);
            CHECK(std::abs(one.tangent_per_width.by_lateral.longitudinal -
                           other.tangent_per_width.by_longitudinal.lateral) < 1e-9);
            CHECK(std::abs(one.force_per_width.longitudinal - mirrored.force_per_width.longitudinal) <
                  1e-12 * full_force);
            CHECK(std::abs(one.force_per_width.lateral + mirrored.force_per_width.lateral) < 1e-12 * full_force);
        }
    }
}

TEST_CASE("The whole contact slips at large creepage, and the force tends to oppose it", "[friction]") {
    const Scene scene(cosine_mesh<double>(40));
    const SteadyFrictionModel<ConstantFriction<>, 2> model = scene.steady();
    for (const double degrees : {20.0, 45.0, 70.0}) {
        double before = 1;
        for (const double ratio : {1.5, 5.0, 50.0, 5e3, 5e5}) {
            const Step step = from_scratch(model, scene.creepage(ratio, degrees));
            CAPTURE(degrees, ratio);
            CHECK(step.status == StepStatus::ok);
            CHECK(step.stick_count == 0);
            const double angle = degrees * std::numbers::pi / 180;
            const double off =
                std::hypot(ratios(step).longitudinal - std::cos(angle), ratios(step).lateral - std::sin(angle));
            CHECK(off < before);
            CHECK(off < 0.1 / ratio + 1e-12);
            before = off;
        }
    }
}

TEST_CASE("The steady tangent is the derivative of the force by both creepages", "[friction]") {
    const Scene scene = Scene(cosine_mesh<double>(30)).plain();
    const SteadyFrictionModel<ConstantFriction<>, 2> model = scene.steady();
    Workspace workspace = model.workspace();
    for (const double ratio : {0.15, 0.5, 0.85, 1.1, 2.0}) {
        for (const double degrees : {5.0, 30.0, 60.0, 88.0}) {
            const Creepage<double> at = scene.creepage(ratio, degrees);
            State state, unused = model.at_rest();
            const Step step = from_scratch(model, at, state);
            const double e = 1e-6 * peak;
            const auto force = [&](double dx, double dy) {
                return model.steady(state, {at.longitudinal + dx, at.lateral + dy}, unused, workspace).force_per_width;
            };
            const CreepageTangent<double>& tangent = step.tangent_per_width;
            CAPTURE(ratio, degrees);
            for (const bool lateral : {false, true}) {
                const double dx = lateral ? 0 : e, dy = lateral ? e : 0;
                const TangentialForce<double> ahead = force(dx, dy), behind = force(-dx, -dy);
                const TangentialForce<double>& own = lateral ? tangent.by_lateral : tangent.by_longitudinal;
                CHECK((ahead.longitudinal - behind.longitudinal) / (2 * e) == Approx(own.longitudinal).margin(1e-6));
                CHECK((ahead.lateral - behind.lateral) / (2 * e) == Approx(own.lateral).margin(1e-6));
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
                const SteadyFrictionModel<ConstantFriction<>, 2> model = scene.steady();
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
    double before = 1;
    for (const Eigen::Index n : {20, 40, 80}) {
        const Scene scene(cosine_mesh<double>(n));
        const Creepage<double> creepage = scene.creepage(0.5, 40);
        const Step step = from_scratch(scene.steady(), creepage);
        const double lost = -step.force_per_width.longitudinal * creepage.longitudinal -
                            step.force_per_width.lateral * creepage.lateral;
        const double error = std::abs(step.slip_work_per_width / lost - 1);
        CAPTURE(n, error);
        CHECK(error < 1.1e-2 * (20.0 / static_cast<double>(n)) * (20.0 / static_cast<double>(n)));
        CHECK(error < before / 3);
        before = error;
    }
}

TEST_CASE("Few elements, no friction and elements without pressure are solved", "[friction]") {
    for (const Eigen::Index n : {1, 2, 3}) {
        const Scene scene(uniform_mesh<double>(n));
        const SteadyFrictionModel<ConstantFriction<>, 2> model = scene.steady();
        for (const double ratio : {0.0, 0.1, 0.4, 3.0}) {
            const Step step = from_scratch(model, scene.creepage(ratio, 33));
            CAPTURE(n, ratio);
            CHECK(step.status == StepStatus::ok);
            CHECK(std::hypot(ratios(step).longitudinal, ratios(step).lateral) <= 1 + 1e-12);
        }
    }
    const Scene scene(cosine_mesh<double>(12));
    const SteadyFrictionModel<ConstantFriction<>, 2> smooth(scene.contact, scene.mesh, scene.scheme, scene.longitudinal,
                                                            scene.lateral, {0, scene.friction.normal_pressure});
    State state;
    const Step free = from_scratch(smooth, scene.creepage(0.5, 45), state);
    CHECK(free.status == StepStatus::ok);
    CHECK(free.stick_count == 0);
    CHECK(state.traction.isZero(0));
    CHECK(free.slip_work_per_width == 0);
    CHECK(free.tangent_per_width.by_lateral.lateral == 0);
    // a hole in the contact
    Friction<> holed = scene.friction;
    holed.normal_pressure.segment(4, 3).setZero();
    const SteadyFrictionModel<ConstantFriction<>, 2> torn(scene.contact, scene.mesh, scene.scheme, scene.longitudinal,
                                                          scene.lateral, holed);
    const Step step = from_scratch(torn, scene.creepage(0.4, 45), state);
    CHECK(step.status == StepStatus::ok);
    CHECK(state.traction.middleRows(4, 3).isZero(0));
    CHECK(step.stick_count > 0);
}

TEST_CASE("Invalid input to steady rolling in two directions is rejected or reported by the status", "[friction]") {
    const Scene scene(cosine_mesh<double>(8));
    const SteadyFrictionModel<ConstantFriction<>, 2> model = scene.steady();
    const MatrixX<double> G_prime = assemble_G_prime(scene.mesh, scene.scheme, scene.longitudinal);
    const ArrayX<double> widths = scene.mesh.widths();
    const auto build = [&](const MatrixX<double>& x, const MatrixX<double>& y, const ArrayX<double>& w) {
        return refusal([&] { SteadyFrictionModel<ConstantFriction<>, 2>(scene.contact, x, y, w, scene.friction); });
    };
    CHECK(build(G_prime, G_prime, widths) == "");
    CHECK(build(G_prime, G_prime.topRows(7), widths) ==
          "SteadyFrictionModel: number of rows of G_prime_yy = 7 must equal the number of elements");
    CHECK(build(G_prime.leftCols(7), G_prime, widths) ==
          "SteadyFrictionModel: number of columns of G_prime_xx = 7 must equal the number of elements");
    MatrixX<double> broken = G_prime;
    broken(2, 3) = std::numeric_limits<double>::quiet_NaN();
    CHECK(build(G_prime, broken, widths) ==
          "SteadyFrictionModel: G_prime_yy(2, 3) = nan must be finite (row and column counted from 0)");
    CHECK(build(G_prime, G_prime, -widths) != "");
    CHECK(refusal([&] {
              SteadyFrictionModel<ConstantFriction<>, 2>(scene.contact, scene.mesh, scene.scheme, scene.longitudinal,
                                                         scene.lateral, {-1, scene.friction.normal_pressure});
          }) == "SteadyFrictionModel: friction_coefficient = -1 must be finite and not negative");
    CHECK(refusal([&] {
              SteadyFrictionModel<ConstantFriction<>, 2>(scene.contact, scene.mesh, scene.scheme, scene.longitudinal,
                                                         PlaneKernel<double>(10, 1, -0.28), scene.friction);
          }) != "");

    const State rest = model.at_rest();
    State next = rest;
    Workspace workspace = model.workspace(), small(7);
    const Creepage<double> creepage = scene.creepage(0.3, 20);
    CHECK(model.steady(rest, creepage, next, workspace).status == StepStatus::ok);
    const State before = next;
    const auto refused = [&](const State& from, const Creepage<double>& at, Workspace& scratch) {
        const Step step = model.steady(from, at, next, scratch);
        CHECK(std::isnan(step.force_per_width.longitudinal));
        CHECK(std::isnan(step.tangent.by_lateral.lateral));
        CHECK(next.traction == before.traction);
        return step.status;
    };
    State other = rest;
    other.system += 1;
    CHECK(refused(other, creepage, workspace) == StepStatus::wrong_state);
    CHECK(refused(next, creepage, workspace) == StepStatus::wrong_state);
    CHECK(refused(rest, creepage, small) == StepStatus::wrong_state);
    other = rest;
    other.zones.pop_back();
    CHECK(refused(other, creepage, workspace) == StepStatus::wrong_state);
    other = rest;
    other.half_length = 1.1;
    CHECK(refused(other, creepage, workspace) == StepStatus::needs_fixed_mesh);
    other = rest;
    other.normal_pressure[3] = -1;
    CHECK(refused(other, creepage, workspace) == StepStatus::invalid_load);
    CHECK(refused(rest, {std::numeric_limits<double>::quiet_NaN(), 0}, workspace) == StepStatus::not_finite);
    CHECK(refused(rest, {0, std::numeric_limits<double>::infinity()}, workspace) == StepStatus::not_finite);
    const Step huge = model.steady(rest, {1e300, -1e300}, next, workspace);
    CHECK(huge.status == StepStatus::ok);
    CHECK(ratios(huge).longitudinal == Approx(std::sqrt(0.5)));
    CHECK(ratios(huge).lateral == Approx(-std::sqrt(0.5)));
}

}  // namespace
