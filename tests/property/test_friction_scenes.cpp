// rollbem/friction/model.hpp: scenes drawn at random, in one direction and two, with constant friction and with
// friction that falls with slip, steady and in the time domain, against the conditions of the law.
// ROLLBEM_SCENES sets how many tenths (default 10000), ROLLBEM_SEED the seed of the generator.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "drawn_scenes.hpp"
#include "friction/any_model.hpp"
#include "support/catch.hpp"

namespace friction_scenes_tests {
namespace {

using namespace any_model;
using drawn_scenes::from_environment, drawn::Draw;

/// The largest violation of each condition over what rounding allows, 200 (n + 10) units in the last place.
struct Violation : drawn::Violation<double> {
    double friction = 0;  ///< mu of its equation; a velocity that is off by rounding is allowed for
    double mu = 0;        ///< the largest difference of mu, for comparison with a residual

    double worst() const { return std::max({bound, stick, direction, friction}); }
};

/// mu of the particle that comes to x/a = `x`: linear between the points, mu_s(0) at the leading edge and ahead of it.
double carried(const ArrayX<double>& points, const ArrayX<double>& mu, double x, double ahead) {
    const Eigen::Index n = points.size();
    for (Eigen::Index i = n - 1; i >= 0; --i) {
        if (points[i] > x) continue;
        if (points[i] == x) return mu[i];  // the last point may lie at the edge or in front of it
        if (x >= 1) return ahead;
        const double right = i == n - 1 ? 1.0 : points[i + 1], value = i == n - 1 ? ahead : mu[i + 1];
        return mu[i] + (x - points[i]) / (right - points[i]) * (value - mu[i]);
    }
    return mu[0];
}

/// The violation of the law of friction by a steady solution (`before` null, `way` 1) or by an implicit step by `way`
/// (in a, as imposed slip and slip) from `before`, with slip that is not turned. `duration` [s] is the time of the
/// step, or of the passage of one half-length. A state without coefficients has the constant one of `law`.
Violation violation(const AnyLaw& law, const Friction::Memory& memory, const ElementSystem<double, 2>& system,
                    double half_length, double shear_modulus, double way, const std::array<double, 2>& imposed,
                    double duration, const FrictionState* before, const FrictionState& after) {
    using std::abs;
    const Eigen::Index n = after.traction.rows();
    const double rounding = 200 * static_cast<double>(n + 10) * std::numeric_limits<double>::epsilon();
    const double at_rest = law(0.0);
    const auto coefficients = [&](const FrictionState& state) -> ArrayX<double> {
        if (state.friction_coefficient.size() == 0) return ArrayX<double>::Constant(n, at_rest);
        return state.friction_coefficient;
    };
    const ArrayX<double> mus = coefficients(after), mus_before = coefficients(before ? *before : after);
    ElementVectors slip(n, 2);
    double scale = 0;
    for (std::size_t d = 0; d < 2; ++d) {
        const auto col = static_cast<Eigen::Index>(d);
        const VectorX<double> p = after.traction.col(col) / shear_modulus;
        const MatrixX<double>& G_prime = system.G_prime(d, d);
        slip.col(col) = -way * (G_prime * p);
        double size = abs(imposed[d]) + way * (G_prime.cwiseAbs() * p.cwiseAbs()).maxCoeff();
        if (before != nullptr) {
            const MatrixX<double>& G = system.G(d, d);
            const VectorX<double> old = before->traction.col(col) / shear_modulus;
            slip.col(col) += G * (p - old);
            size += (G.cwiseAbs() * (p.cwiseAbs() + old.cwiseAbs())).maxCoeff();
        }
        slip.col(col).array() += imposed[d];
        scale += size;
    }
    const double slip_rounding = rounding * scale, largest = mus.maxCoeff() + at_rest;
    const double traction_rounding = rounding * largest * after.normal_pressure.maxCoeff();
    const double velocity_per_slip = half_length / duration;

    Violation worst{drawn::violation(after.traction, slip, mus * after.normal_pressure, after.zones, false)};
    worst.bound /= traction_rounding;
    worst.stick /= slip_rounding;
    worst.direction /= slip_rounding;
    const auto raise = [](double& value, double to) { value = to <= value ? value : to; };  // to what is no number, too
    for (Eigen::Index i = 0; i < n; ++i) {
        const double mu = mus[i];
        const bool sticks = after.zones[static_cast<std::size_t>(i)] == Zone::stick;
        const auto expected = [&](double v) {
            if (!(after.normal_pressure[i] > 0)) return at_rest;
            if (memory.distance == 0) return law(v);
            const auto& points = system.elements().x;
            const double came = before == nullptr ? (i == n - 1 ? at_rest : mus[i + 1])
                                                  : carried(points, mus_before, points[i] + way, at_rest);
            const double time = before == nullptr ? duration * system.elements().intervals[i] : duration;
            const double forgets = time * std::max(v, memory.least_velocity) / memory.distance;
            return (came + forgets * law(v)) / (1 + forgets);
        };
        const double v = sticks ? 0.0 : std::hypot(slip(i, 0), slip(i, 1)) * velocity_per_slip,
                     off = slip_rounding * velocity_per_slip;
        const double middle = expected(v), difference = abs(mu - middle);
        const double spread =
            sticks ? 0.0 : std::max(abs(expected(v + off) - middle), abs(expected(std::max(v - off, 0.0)) - middle));
        raise(worst.friction, difference / (rounding * largest + spread));
        raise(worst.mu, difference);
    }
    return worst;
}

enum class Kind { constant, forgetful, remembering };

AnyLaw drawn_law(int kind, double mu_0, double mu_k, double half_velocity) {
    switch (kind) {
        case 0: return ExponentialFall{mu_0, mu_k, half_velocity};
        case 1: return [=](double v) { return mu_k + (mu_0 - mu_k) / (1 + v / half_velocity); };
        default: return [=](double v) { return mu_k + (mu_0 - mu_k) * std::max(0.0, 1 - v / (2 * half_velocity)); };
    }
}

Mesh<double> drawn_mesh(Draw& draw, Eigen::Index n) {
    switch (draw.integer(3)) {
        case 0: return uniform_mesh<double>(n);
        case 1: return geometric_mesh<double>(std::max<Eigen::Index>(n, 2), draw.decades(-0.5, 0.5));
        default: return cosine_mesh<double>(n);
    }
}

struct Tally {
    int solutions = 0, unsolved = 0;
    int mixed = 0, forgetting = 0;  // with stick and slip; with a coefficient well below that at rest
};

// A steady solution from rest, then implicit steps and shifts under pressures and creepages of every kind, with steady
// solutions in between.
void ride(Draw& draw, int directions, Kind kind, Tally& tally) {
    const double a = draw.decades(-4, -1), G = draw.decades(8, 11.5), V = draw.decades(-1, 2);
    const Eigen::Index drawn = 1 + draw.integer(directions == 1 ? 30 : 20);
    const double mu_0 = draw.uniform(0.05, 1), peak = G * draw.decades(-4, -2), full = mu_0 * peak / G;
    const double aspect = draw.decades(0, 3.5);
    Setup setup{.directions = directions, .integrator = Integrator::implicit_euler, .mesh = drawn_mesh(draw, drawn)};
    const Eigen::Index n = setup.mesh.size();
    setup.scheme.alpha_L = n == 1 || draw.one_in(2) ? 0.5 : draw.uniform(0.2, 0.5);
    setup.strip = aspect < 100 || draw.one_in(2);
    setup.constant = mu_0;
    setup.own_contact = Contact({.half_length = a,
                                 .half_width = a * aspect,
                                 .shear_modulus = G,
                                 .poisson_ratio = draw.one_in(4) ? 0 : draw.uniform(0, 0.5)});
    AnyLaw law = [mu_0](double) { return mu_0; };
    if (kind != Kind::constant) {
        law = drawn_law(draw.integer(3), mu_0, mu_0 * draw.uniform(0, 1.2), V * full * draw.decades(-1, 2));
        setup.any = law;
    }
    setup.least = V * full * draw.decades(-4, -1);
    if (kind == Kind::remembering) setup.distance = a * full * draw.decades(-2, 1);
    const auto pressures = [&](bool holes) {
        ArrayX<double> result = peak * mean_hertz_pressure(setup.mesh);
        for (double& pressure : result) {
            pressure *= draw.uniform(0.5, 1.2);
            if (holes && draw.one_in(6)) pressure = 0;
        }
        if (!(result.maxCoeff() > 0)) result[0] = peak;
        return result;
    };
    setup.own_pressure = pressures(false);
    const Friction::Memory memory{setup.distance, setup.least};
    const ElementSystem<double, 2> system(setup.system(false), setup.system(true));
    Ride ride(setup);
    Load load{*setup.own_pressure, a, {}};
    for (int k = 0; k < 10; ++k) {
        const double size = full * draw.decades(-1.5, 1), angle = draw.uniform(-3.2, 3.2);
        const bool along = directions == 1 || draw.one_in(6);
        const Creepage creepage{along ? (draw.one_in(3) ? -size : size) : size * std::cos(angle),
                                along ? 0 : size * std::sin(angle)};
        if (draw.one_in(4)) load.normal_pressure = pressures(true);
        const bool steady = k == 0 || draw.one_in(4), shifts = !steady && draw.one_in(5);
        const double dq = shifts || steady ? 0 : draw.decades(-2, 0), duration = draw.decades(-2, 0) * a / V;
        const double time = steady ? a / V : shifts ? duration : dq * a / V, way = steady || shifts ? 1 : dq;
        const Motion motion =
            shifts ? Motion::shift({a * creepage.longitudinal, a * creepage.lateral}) : Motion(creepage);
        const Step step = steady
                              ? ride.model.steady(ride.now, {Travel::at_speed(V), creepage, load}, ride.next, ride.own)
                              : ride.model.advance(ride.now, {{dq * a, time}, motion, load}, ride.next, ride.own);
        ++tally.solutions;
        const Violation found =
            violation(law, memory, system, a, G, steady ? 1 : dq, {way * creepage.longitudinal, way * creepage.lateral},
                      time, steady ? nullptr : &ride.now, ride.next);
        CAPTURE(n, k, aspect, steady, shifts, size / full, angle, dq, name(step.status), step.rounds, found.bound,
                found.stick, found.direction, found.friction, found.mu, step.complementarity_residual);
        if (step.status == Status::no_solution && kind != Kind::constant) {
            ++tally.unsolved;
            REQUIRE(std::isfinite(step.force.longitudinal));
            REQUIRE(found.mu <= 1.001 * step.complementarity_residual);  // which is not hidden
            continue;
        }
        REQUIRE(step.status == Status::ok);
        REQUIRE(step.slip_work >= (directions == 1 ? 0 : -1e-9));
        REQUIRE(found.worst() <= 1);
        tally.mixed += step.stick_count > 0 && step.stick_count < n ? 1 : 0;
        if (kind != Kind::constant) {
            tally.forgetting += ride.next.friction_coefficient.minCoeff() < 0.95 * mu_0 ? 1 : 0;
        }
        ride.accept();
    }
}

TEST_CASE("Friction obeys its law on random scenes", "[property]") {
    const auto scenes = static_cast<int>(from_environment("ROLLBEM_SCENES", 10000) / 20);
    for (const int directions : {1, 2}) {
        for (const Kind kind : {Kind::constant, Kind::forgetful, Kind::remembering}) {
            Draw draw(from_environment("ROLLBEM_SEED", 16) + static_cast<std::uint64_t>(kind));
            Tally tally;
            for (int k = 0; k < scenes; ++k) {
                CAPTURE(directions, static_cast<int>(kind), k);
                ride(draw, directions, kind, tally);
            }
            CAPTURE(directions, static_cast<int>(kind), tally.solutions, tally.unsolved, tally.mixed, tally.forgetting);
            CHECK(tally.unsolved <= tally.solutions / 5000);
            CHECK(tally.mixed > tally.solutions / 5);
            if (kind != Kind::constant) CHECK(tally.forgetting > tally.solutions / 5);
        }
    }
}

}  // namespace
}  // namespace friction_scenes_tests
