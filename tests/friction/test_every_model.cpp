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

/// Forces, tractions, slip, heat, energy and, unless turned, tangents along the creepages of 60 steps are those of
/// another setup, turned by `turned` degrees as the creepages are, which lie at `degrees` and turn by `turning` from
/// step to step.
void agree(const Setup& setup, const Setup& other, double tolerance, double degrees, double turning,
           double turned = 0) {
    INFO(words(setup));
    Ride ride(setup), expected(other);
    const Matrix2d turn = Eigen::Rotation2Dd(turned * std::numbers::pi / 180).toRotationMatrix();
    const auto apart = [&](const ElementVectors& one, const ElementVectors& two) {
        return (one - two * turn.transpose()).cwiseAbs().maxCoeff();
    };
    int mixed = 0;
    for (int k = 0; k < 60; ++k) {
        CAPTURE(k);
        const Step step = varied(ride, setup, k, degrees + turned, turning),
                   of = varied(expected, other, k, degrees, turning);
        REQUIRE(step.status == Status::ok);
        REQUIRE(of.status == Status::ok);
        mixed += step.stick_count > 0 && step.stick_count < ride.model.size() ? 1 : 0;
        CHECK(step.stick_count == of.stick_count);
        if (turned == 0) {
            const Eigen::Index own = setup.across ? 1 : 0;
            CHECK(matrix(step.tangent)(own, own) == Approx(matrix(of.tangent)(own, own)).epsilon(1e-6));
            for (const auto by : {&Step::tangent_by_load, &Step::tangent_by_half_length}) {
                const double expected_rate = vector(of.*by)[own], rate = vector(step.*by)[own];
                CHECK((detail::is_nan(expected_rate) ? detail::is_nan(rate)
                                                     : rate == Approx(expected_rate).epsilon(1e-6).margin(1e-9)));
            }
        }
        CHECK((ratios(step) - turn * ratios(of)).norm() < tolerance);
        CHECK(apart(ride.now.traction, expected.now.traction) < tolerance * peak_pressure);
        CHECK(apart(ride.own.slip(), expected.own.slip()) < tolerance * sliding);
        CHECK(step.slip_work == Approx(of.slip_work).epsilon(10 * tolerance).margin(1e-12));
        CHECK(ride.model.elastic_energy(ride.now) ==
              Approx(expected.model.elastic_energy(expected.now)).epsilon(tolerance).margin(1e-9));
        if (setup.directions == other.directions) continue;
        const Eigen::Index own = other.across ? 1 : 0;  // of tangents in one direction
        const auto same_tangent = [&](double one, double two) { CHECK(one == Approx(two).epsilon(1e-6).margin(1e-9)); };
        same_tangent(matrix(step.tangent)(own, own), matrix(of.tangent)(own, own));
        if (k % 6 != 2 && k % 6 != 5) continue;
        same_tangent(vector(step.tangent_by_load)[own], vector(of.tangent_by_load)[own]);
        same_tangent(vector(step.tangent_by_half_length)[own], vector(of.tangent_by_half_length)[own]);
    }
    CHECK(mixed > 20);
}

TEST_CASE("A law that happens to be constant is Coulomb's", "[friction]") {
    for (Setup setup : every_setup_in_time(3e-6)) {
        if (!setup.falls) continue;
        Setup coulomb = setup;
        coulomb.falls = false;
        coulomb.constant = 0.25;
        setup.any = [](double) { return 0.25; };
        agree(setup, coulomb, 1e-10, 30, 3);
    }
}

TEST_CASE("With creepage along one of them, two directions are one", "[friction]") {
    for (Setup setup : every_setup_in_time()) {
        if (setup.directions == 2) continue;
        setup.mesh = cosine_mesh<double>(30);
        for (const bool across : {false, true}) {
            setup.across = across;
            Setup both = setup;
            both.directions = 2;
            agree(both, setup, 1e-9, across ? 90 : 0, 0);
        }
    }
}

TEST_CASE("With Poisson's ratio zero, the solution turns with the creepage", "[friction]") {
    for (Setup setup : every_setup_in_time(5e-6)) {
        if (setup.directions == 1) continue;
        setup.nu = 0;
        setup.turned = true;
        agree(setup, setup, 1e-8, 0, 8, 37);
    }
}

TEST_CASE("A steady solution stays in time, and its slip and heat are those of the distance rolled", "[friction]") {
    for (Setup setup : every_setup_in_time()) {
        if (setup.distance > 0) continue;  // steady particles arrive from the element ahead
        for (const bool turned : {false, true}) {
            setup.turned = turned;
            INFO(words(setup));
            Ride ride(setup);
            for (const double ratio : {0.4, 3.0}) {
                CAPTURE(turned, ratio);
                Creepage creeps = creepage(ratio, 20);
                creeps.spin = 0.3 * sliding / a;
                ride.now = ride.model.at_rest();
                const RollingStep rolling{Travel::at_speed(speed), creeps};
                const Step alone = ride.alone().steady(ride.now, rolling, ride.next, ride.own),
                           steady = ride.steady(creeps);
                REQUIRE(steady.status == Status::ok);
                CHECK((ratios(alone) - ratios(steady)).norm() < 1e-11);
                CHECK(alone.slip_work == Approx(steady.slip_work).epsilon(1e-9));
                const ElementVectors slip = ride.own.slip(), traction = ride.now.traction;
                const VectorX<double> heat = ride.own.slip_work();
                const double way = 0.07 * a;
                const Step step = ride.step(0.07, creeps);
                REQUIRE(step.status == Status::ok);
                CHECK((ride.now.traction - traction).cwiseAbs().maxCoeff() < 1e-9 * peak_pressure);
                CHECK((ride.own.slip() - way * slip).cwiseAbs().maxCoeff() < 1e-9 * way * sliding);
                CHECK((ride.own.slip_work() - way * heat).cwiseAbs().maxCoeff() < 1e-9 * way * heat.maxCoeff());
                CHECK(step.slip_work == Approx(way * steady.slip_work).epsilon(1e-9));
                if (setup.directions == 2 && turned) {
                    CHECK(std::abs(step.force.moment - steady.force.moment) < 1e-9 * full_force * a);
                }
            }
        }
    }
}

TEST_CASE("In full sliding the force opposes the creepage, at the coefficient of its velocity", "[friction]") {
    for (const Setup& setup : every_setup_in_time()) {
        INFO(words(setup));
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
        const Way limit(setup, 2560);
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
        const Step step = Ride(setup).step(0, shift(2));
        REQUIRE(step.status == Status::ok);
        CHECK(step.slip_work > 0);
        CHECK(step.jump_work == Approx(-step.slip_work / 2).epsilon(1e-3));
    }
}

TEST_CASE("The work of the rigid bodies is spent on slip, jumps and elastic energy, to second order", "[friction]") {
    for (Setup setup : every_setup(20e-6)) {
        INFO(words(setup));
        setup.half_width = 50 * a;
        std::vector<double> counts, gaps;
        double jumps = 0, spent = 0;
        for (const int n : {14, 28, 56}) {
            setup.mesh = cosine_mesh<double>(n);
            Ride ride(setup);
            const int steps = 5 * n;
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
    }
}

}  // namespace
}  // namespace any_model
