// rollbem/friction/model.hpp: what holds for every law, in one direction and in two, for both
// integrators. Fulfilment of the law itself is checked on random scenes, in property/test_friction_scenes.cpp.
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "friction/any_model.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace any_model {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// Calls `function` with each setup, which a failure then names.
template <class Function>
void for_each(const std::vector<Setup>& setups, const Function& function) {
    for (const Setup& setup : setups) {
        INFO(words(setup));
        function(setup);
    }
}

/// Hertz's pressure of another load, and its half-length, on a mesh that breathes; the rates are derivatives with
/// respect to the factor of the pressures.
Load breathing(const Setup& setup, double half_length) {
    const ArrayX<double> pressure = setup.pressure();
    return {half_length / a * pressure, half_length, pressure};
}
double breath(int k) { return a * std::sqrt(1 + 0.2 * std::sin(0.3 * k)); }

// Steps, shifts and steady solutions in turn, some under a load of their own, of a creepage of varying size and angle.
Step varied(Ride& ride, const Setup& setup, int k, double degrees, double turning) {
    const double size = 0.6 + 0.7 * std::sin(0.3 * k);
    const auto at = [&](int when) { return creepage(0.6 + 0.7 * std::sin(0.3 * when), degrees + turning * when); };
    const Load load = breathing(setup, breath(k));
    switch (k % 6) {
        case 0: return ride.step(0, shift(size, degrees + turning * k));
        case 1: return ride.steady(at(k));
        case 2: return ride.step(0.15, Motion::linear(at(k - 1), at(k)), &load);
        case 3: return ride.step(0.1, at(k));
        case 4: return ride.steady(at(k), &load);
        default: return ride.step(0.2, at(k), &load);
    }
}

TEST_CASE("A law that happens to be constant is Coulomb's", "[friction]") {
    for (Setup setup : every_setup_in_time(3e-6)) {
        if (!setup.falls) continue;
        INFO(words(setup));
        setup.constant = 0.25;
        setup.falls = false;
        Ride expected(setup);
        setup.any = [](double) { return 0.25; };
        Ride ride(setup);
        int mixed = 0;
        for (int k = 0; k < 60; ++k) {
            CAPTURE(k);
            const Step step = varied(ride, setup, k, 30, 3), coulomb = varied(expected, setup, k, 30, 3);
            REQUIRE(step.status == Status::ok);
            mixed += step.stick_count > 0 && step.stick_count < 20 ? 1 : 0;
            CHECK(ride.now.zones == expected.now.zones);
            CHECK((ride.now.friction_coefficient - 0.25).abs().maxCoeff() < 1e-15);
            CHECK((ratios(step) - ratios(coulomb)).norm() < 1e-10);
            const double scale = matrix(coulomb.tangent).norm();
            CHECK((matrix(step.tangent) - matrix(coulomb.tangent)).norm() <= 1e-8 * scale);
            CHECK(step.slip_work == Approx(coulomb.slip_work).epsilon(1e-8));
            CHECK((ride.own.slip() - expected.own.slip()).cwiseAbs().maxCoeff() < 1e-10 * sliding);
            if (k % 6 != 2 && k % 6 != 5) continue;
            CHECK((vector(step.tangent_by_load) - vector(coulomb.tangent_by_load)).norm() <
                  1e-7 * vector(coulomb.tangent_by_load).norm());
            CHECK((vector(step.tangent_by_half_length) - vector(coulomb.tangent_by_half_length)).norm() <
                  1e-7 * vector(coulomb.tangent_by_half_length).norm());
        }
        CHECK(mixed > 20);
    }
}

TEST_CASE("With creepage along one of them, two directions are one", "[friction]") {
    for (Setup setup : every_setup_in_time()) {
        if (setup.directions == 2) continue;
        setup.mesh = cosine_mesh<double>(30);
        for (const bool across : {false, true}) {
            setup.across = across;
            INFO(words(setup));
            setup.directions = 2;
            Ride both(setup);
            setup.directions = 1;
            Ride one(setup);
            int mixed = 0;
            for (int k = 0; k < 60; ++k) {
                CAPTURE(k);
                const Step step = varied(both, setup, k, across ? 90 : 0, 0);
                const Step expected = varied(one, setup, k, across ? 90 : 0, 0);
                REQUIRE(step.status == Status::ok);
                REQUIRE(expected.status == Status::ok);
                mixed += step.stick_count > 0 && step.stick_count < 30 ? 1 : 0;
                const Eigen::Index own = across ? 1 : 0;
                CHECK((ratios(step) - ratios(expected)).norm() < 1e-9);
                CHECK(matrix(step.tangent)(own, own) == Approx(matrix(expected.tangent)(own, own)).epsilon(1e-6));
                CHECK(step.slip_work == Approx(expected.slip_work).epsilon(1e-8).margin(1e-12));
                CHECK(step.stick_count == expected.stick_count);
                CHECK((both.now.traction - one.now.traction).cwiseAbs().maxCoeff() < 1e-9 * peak_pressure);
                CHECK((both.own.slip() - one.own.slip()).cwiseAbs().maxCoeff() < 1e-9 * sliding);
                CHECK(both.model.elastic_energy(both.now) ==
                      Approx(one.model.elastic_energy(one.now)).epsilon(1e-9).margin(1e-9));
                if (k % 6 != 2 && k % 6 != 5) continue;
                CHECK(vector(step.tangent_by_load)[own] ==
                      Approx(vector(expected.tangent_by_load)[own]).epsilon(1e-6).margin(1e-9));
                CHECK(vector(step.tangent_by_half_length)[own] ==
                      Approx(vector(expected.tangent_by_half_length)[own]).epsilon(1e-6).margin(1e-9));
            }
            CHECK(mixed > 20);
        }
    }
}

TEST_CASE("A steady solution stays in time, and its slip and heat are those of the distance rolled", "[friction]") {
    for (Setup setup : every_setup_in_time(0)) {
        for (const bool turned : {false, true}) {
            setup.turned = turned;
            INFO(words(setup));
            Ride ride(setup);
            for (const double ratio : {0.4, 3.0}) {
                CAPTURE(turned, ratio);
                ride.now = ride.model.at_rest();
                const Step steady = ride.steady(creepage(ratio, 20));
                REQUIRE(steady.status == Status::ok);
                const ElementVectors slip = ride.own.slip(), traction = ride.now.traction;
                const VectorX<double> heat = ride.own.slip_work();
                const double way = 0.07 * a;
                const Step step = ride.step(0.07, creepage(ratio, 20));
                REQUIRE(step.status == Status::ok);
                CHECK((ride.now.traction - traction).cwiseAbs().maxCoeff() < 1e-9 * peak_pressure);
                CHECK((ride.own.slip() - way * slip).cwiseAbs().maxCoeff() < 1e-9 * way * sliding);
                CHECK((ride.own.slip_work() - way * heat).cwiseAbs().maxCoeff() < 1e-9 * way * heat.maxCoeff());
                CHECK(step.slip_work == Approx(way * steady.slip_work).epsilon(1e-9));
            }
        }
    }
}

TEST_CASE("With Poisson's ratio zero, the solution turns with the creepage", "[friction]") {
    for (Setup setup : every_setup_in_time(5e-6)) {
        if (setup.directions == 1) continue;
        INFO(words(setup));
        setup.nu = 0;
        setup.turned = true;
        Ride ride(setup), turned(setup);
        setup.directions = 1;
        Ride one(setup);
        const Matrix2d turn = Eigen::Rotation2Dd(37 * std::numbers::pi / 180).toRotationMatrix();
        for (int k = 0; k < 60; ++k) {
            CAPTURE(k);
            const Step step = varied(ride, setup, k, 0, 8), other = varied(turned, setup, k, 37, 8);
            REQUIRE(step.status == Status::ok);
            REQUIRE(other.status == Status::ok);
            CHECK((ratios(other) - turn * ratios(step)).norm() < 1e-8);
            CHECK((turned.now.traction - ride.now.traction * turn.transpose()).cwiseAbs().maxCoeff() <
                  1e-8 * peak_pressure);
            CHECK(other.slip_work == Approx(step.slip_work).epsilon(1e-7));
        }
        // along the creepage as in one direction; across it the force turns
        for (const double ratio : {0.1, 0.4, 0.8, 3.0}) {
            ride.now = ride.model.at_rest();
            one.now = one.model.at_rest();
            const Step expected = one.steady(creepage(ratio)), step = ride.steady(creepage(ratio, 37));
            REQUIRE(step.status == Status::ok);
            const double force = expected.force.longitudinal;
            CHECK((ratios(step) - turn * ratios(expected)).norm() < 1e-9);
            Matrix2d tangent = Matrix2d::Zero();
            tangent.diagonal() << expected.tangent.by_longitudinal.longitudinal, force / (sliding * ratio);
            CHECK((matrix(step.tangent) - turn * tangent * turn.transpose()).norm() < 1e-7 * tangent.norm());
        }
    }
}

TEST_CASE("In full sliding the force opposes the creepage, at the coefficient of its velocity", "[friction]") {
    for_each(every_setup_in_time(), [](const Setup& setup) {
        for (const double degrees : {0.0, 25.0, 160.0}) {
            if (setup.directions == 1 && degrees != 0) continue;
            double before = 1;
            for (const double ratio : {5.0, 50.0, 5e3, 5e5}) {
                Ride ride(setup);
                const Step step = ride.steady(creepage(ratio, degrees));
                CAPTURE(degrees, ratio);
                CHECK(step.status == Status::ok);
                CHECK(step.stick_count == 0);
                const double mu = setup.falls ? law(sliding * ratio * speed) : law.mu_0;
                const double angle = degrees * std::numbers::pi / 180;
                const double off = (ratios(step) - mu / law.mu_0 * Vector2d(std::cos(angle), std::sin(angle))).norm();
                CHECK(off < (setup.distance > 0 ? 1 : 0.1) / ratio + 1e-12);
                CHECK(off <= before + 1e-14);
                before = off;
                // the next steps in the time domain are the same, at rates of slip that leave no time to remember
                if (ratio < 5e3) continue;
                for (int k = 0; k < 30; ++k) ride.step(0.2, creepage(ratio, degrees));
                CHECK((ratios(ride.step(0.2, creepage(ratio, degrees))) - ratios(step)).norm() < 1e-3);
            }
        }
    });
}

TEST_CASE("A run that stands still solves the equations of steady rolling", "[friction]") {
    // G (p - p_before) = 0, and mu = mu_s(v) at the same v: steps of any length have the steady solutions
    for (Setup setup : every_setup_in_time()) {
        if (setup.distance > 0) continue;
        for (const bool cosine : {false, true}) {
            if (cosine) setup.mesh = cosine_mesh<double>(24);
            if (!cosine) setup.mesh = uniform_mesh<double>(20);
            for (const double ratio : {0.4, setup.falls ? 4 : 1.2}) {  // in between the law has several solutions
                INFO(words(setup));
                CAPTURE(cosine, ratio);
                Ride ride(setup);
                Step step;
                double change = 1;
                for (int k = 0; k < 100; ++k) {
                    step = ride.step(4, creepage(ratio, 20));
                    REQUIRE(step.status == Status::ok);
                    change = (ride.now.traction - ride.next.traction).cwiseAbs().maxCoeff() / peak_pressure;
                }
                CHECK(change < 1e-11);
                const State settled = ride.now;
                const auto agrees = [&](const Step& steady, const State& state) {
                    CHECK(steady.status == Status::ok);
                    CHECK((ratios(steady) - ratios(step)).norm() < 1e-9);
                    CHECK((state.traction - settled.traction).cwiseAbs().maxCoeff() < 1e-9 * peak_pressure);
                    CHECK(state.zones == settled.zones);
                    // work per distance rolled, and of a step of 4 a
                    CHECK(4 * a * steady.slip_work == Approx(step.slip_work).epsilon(1e-7));
                };
                agrees(ride.try_steady(creepage(ratio, 20)), ride.next);
                agrees(
                    ride.alone().steady(settled, {Travel::at_speed(speed), creepage(ratio, 20)}, ride.next, ride.own),
                    ride.next);
            }
        }
    }
}

// Forces at eight places of a way of 4 a, in which the creepage rises, falls and turns, and the work up to there.
struct Way {
    explicit Way(const Setup& setup, int steps) : forces(16), works(8) {
        Ride ride(setup);
        const double dq = 4.0 / steps;
        const auto at = [](double q) { return creepage(1.5 * std::pow(std::sin(0.7 * q), 2), 30 * std::sin(0.9 * q)); };
        double work = 0;
        for (int k = 0; k < steps; ++k) {
            const Step step = ride.step(dq, Motion::linear(at(k * dq), at((k + 1) * dq)));
            REQUIRE(step.status == Status::ok);
            work += step.slip_work / (full_force * sliding * a);
            const int place = (k + 1) / (steps / 8) - 1;
            if ((k + 1) % (steps / 8) != 0) continue;
            forces.segment<2>(2 * place) = ratios(step);
            works[place] = work;
        }
    }

    VectorX<double> forces, works;
};

TEST_CASE("Forces and work converge in dq at the order of the integrator", "[friction]") {
    for (Setup setup : every_setup(20e-6)) {
        if (setup.falls && setup.distance == 0) continue;  // the force jumps
        setup.mesh = uniform_mesh<double>(16);
        const Way limit(setup, 5120);
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            setup.integrator = integrator;
            INFO(words(setup));
            std::vector<double> counts, forces, works;
            for (const int steps : {40, 80, 160, 320}) {
                const Way way(setup, steps);
                counts.push_back(steps);
                forces.push_back((way.forces - limit.forces).norm());
                works.push_back((way.works - limit.works).norm());
            }
            const double order = support::observed_order(counts, forces);
            const double order_of_work = support::observed_order(counts, works);
            CAPTURE(forces, works, order, order_of_work);
            const bool second = integrator == Integrator::sdirk2;
            CHECK(forces.back() < (second ? 2e-5 : 4e-3));
            if (second && setup.falls) {  // somewhat less where elements begin to slip within steps
                CHECK(std::abs(order - 1.8) < 0.2);
                CHECK(std::abs(order_of_work - 1.35) < 0.2);
            } else {
                CHECK(std::abs(order - (second ? 2 : 1)) < 0.1);
                CHECK(std::abs(order_of_work - (second ? 2 : 1)) < 0.1);
            }
        }
    }
}

TEST_CASE("A rigid shift from rest spends half of its slip work on jumps", "[friction]") {
    // tractions grow along slip, J is the integral of p s/2
    for (const Setup& setup : every_setup()) {
        INFO(words(setup));
        const FrictionModel model = make(setup);
        State next = model.at_rest();
        Workspace workspace = model.workspace();
        const Step step = model.advance(model.at_rest(), {Ride::travel(0), shift(2)}, next, workspace);
        REQUIRE(step.status == Status::ok);
        CHECK(step.slip_work > 0);
        CHECK(step.jump_work == Approx(-step.slip_work / 2).epsilon(1e-3));
    }
}

TEST_CASE("The work of the rigid bodies is spent on slip, jumps and elastic energy, to second order", "[friction]") {
    for_each(every_setup(20e-6), [](Setup setup) {
        setup.half_width = 50 * a;
        std::vector<double> counts, gaps;
        double jumps = 0, spent = 0;
        for (const int n : {14, 28, 56}) {
            setup.mesh = cosine_mesh<double>(n);
            Ride ride(setup);
            const int steps = 10 * n;
            const double dq = 4.0 / steps;
            const auto rolled = [&](int k) {
                return setup.directions == 1 ? creepage(1.2 * std::sin(dq * k) * std::cos(0.7 * dq * k))
                                             : creepage(1.2 * std::sin(dq * k), 40 * dq * k);
            };
            double slips = 0;
            jumps = spent = 0;
            Vector2d before = Vector2d::Zero();
            for (int k = 0; k < steps; ++k) {
                const Load load = breathing(setup, a * std::sqrt(1 + 0.3 * std::sin(0.8 * dq * (k + 1))));
                const Step step = ride.step(dq, Motion::linear(rolled(k), rolled(k + 1)), &load);
                REQUIRE(step.status == Status::ok);
                const Vector2d force = vector(step.force);
                spent -= dq * a / 2 * (vector(rolled(k)).dot(before) + vector(rolled(k + 1)).dot(force));
                slips += step.slip_work;
                jumps += step.jump_work;
                before = force;
            }
            counts.push_back(n);
            gaps.push_back((spent - slips - jumps - ride.model.elastic_energy(ride.now)) / spent);
        }
        CAPTURE(gaps, jumps / spent, support::observed_order(counts, gaps));
        CHECK(std::abs(support::observed_order(counts, gaps) - 1.95) < 0.15);
        CHECK(std::abs(gaps.back()) < 3e-3);
        // without memory the forces jump, with constant friction nothing does
        if (!setup.falls) CHECK(jumps == 0);
        CHECK((jumps > 0.01 * spent) == (setup.falls && setup.distance == 0));
    });
}

}  // namespace
}  // namespace any_model
