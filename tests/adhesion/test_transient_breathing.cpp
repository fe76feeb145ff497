// rollbem/adhesion/transient.hpp: a contact whose length changes from step to step ("breathes")
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include <rollbem/line.hpp>

#include "support/catch.hpp"
#include "support/dense.hpp"
#include "support/observed_order.hpp"

namespace transient_breathing_tests {
namespace {

using namespace rollbem;
using Model = AdhesionModel<>;
using Motion = RigidMotion<double>;
using Eigen::MatrixXd, Eigen::VectorXd;

constexpr double pi = std::numbers::pi, nu = 0.28;
constexpr std::array breathing_integrators{Integrator::implicit_euler, Integrator::sdirk2};

/// a/a_0 under a sinusoidal load, which is proportional to a^2.
struct Sine {
    double amplitude, length;
    double operator()(double q) const { return std::sqrt(1 + amplitude * std::sin(2 * pi * q / length)); }
    double slope(double q) const { return amplitude * std::cos(2 * pi * q / length) * pi / length / (*this)(q); }
};

PlaneKernel<double> plane(double aspect) { return {aspect, 1 - nu, nu}; }
Contact unit_contact(double aspect) { return Contact::dimensionless(aspect, nu); }

ElementSystem<double> elements(Eigen::Index n, double aspect) {
    return rolling_system(cosine_mesh<double>(n), Collocation{}, plane(aspect));
}
Chebyshev::System<double> states(Eigen::Index m, double aspect) {
    return rolling_system(Chebyshev{.states = m}, plane(aspect));
}

/// The stages' equations solved for the tractions, lengths in units of a_0. The half-length a_1 at the first stage need
/// not lie on the straight line from a_old to a_new.
struct Dense {
    explicit Dense(const RollingSystem<double>& system)
        : G(system.G()),
          G_prime(system.G_prime()),
          w(system.weights()),
          zeta(*system.points()),
          S(*system.log_strength()) {}

    MatrixXd M(double a) const { return a * G - a * S * std::log(a) * w.transpose().replicate(w.size(), 1); }
    VectorXd stage(double part, double dq, double d, double a, double shift, const VectorXd& right) const {
        const MatrixXd carried = (dq + d * zeta.array()).matrix().asDiagonal() * G_prime;
        return dense::solve(M(a) - part * carried, right - VectorXd::Constant(w.size(), part * shift));
    }
    VectorXd euler(const VectorXd& p, double a_old, double a_new, double dq, double shift) const {
        return stage(1, dq, a_new - a_old, a_new, shift, M(a_old) * p);
    }
    VectorXd sdirk2(const VectorXd& p, double a_old, double a_1, double a_new, double dq, double shift_1,
                    double shift_2) const {
        const double g = 1 - 1 / std::sqrt(2.0), d_1 = (a_1 - a_old) / g, d_2 = (a_new - a_old - (1 - g) * d_1) / g;
        const VectorXd U = M(a_old) * p;
        const VectorXd U_1 = M(a_1) * stage(g, dq, d_1, a_1, shift_1, U);
        return stage(g, dq, d_2, a_new, shift_2, U + (1 - g) / g * (U_1 - U));
    }

    MatrixXd G, G_prime;
    VectorXd w, zeta;
    double S;
};

TEST_CASE("A step on a breathing contact solves the equations of its stages", "[breathing]") {
    const double a_0 = 4e-3, G = 8e10, g = 1 - 1 / std::sqrt(2.0);
    const Contact contact({.half_length = a_0, .half_width = 0.4, .shear_modulus = G, .poisson_ratio = nu});
    const ElementSystem<double> of_elements = elements(20, 100);
    const ElementSystem<double> of_nodes = rolling_system(cosine_mesh(20), NodeDifference{}, plane(100));
    const Chebyshev::System<double> of_states = states(9, 100);
    for (const RollingSystem<double>* system :
         {static_cast<const RollingSystem<double>*>(&of_elements), static_cast<const RollingSystem<double>*>(&of_nodes),
          static_cast<const RollingSystem<double>*>(&of_states)}) {
        const Dense exact(*system);
        for (const Integrator integrator : breathing_integrators) {
            const Model model(contact, *system, unchecked, integrator);
            REQUIRE(model.can_breathe());
            Model::Workspace workspace = model.workspace();
            for (const double a_old : {1.0, 0.3, 2.5}) {
                for (const double da : {0.0, 0.19, -0.19, 1e-9}) {
                    Model::State from = model.steady(1e-3), to = from;
                    from.half_length = a_0 * a_old;
                    const VectorXd p = from.traction / G;
                    for (const auto& [motion, shift_1, shift_2] :
                         {std::tuple(Motion(2e-3), 4e-4, 4e-4), std::tuple(Motion::shift(4e-4 * a_0), 4e-4, 4e-4),
                          std::tuple(Motion::linear(1e-3, 4e-3), 0.2 * (1e-3 + 3e-3 * g), 8e-4)}) {
                        const double dq = 0.2, a_new = a_old + da;
                        const AdhesionModel<>::Step step =
                            model.advance(from, {dq * a_0, motion, a_new * a_0}, to, workspace);
                        REQUIRE(step.status == Status::ok);
                        const VectorXd expected =
                            integrator == Integrator::sdirk2
                                ? exact.sdirk2(p, a_old, a_old + g * da, a_new, dq, shift_1, shift_2)
                                : exact.euler(p, a_old, a_new, dq, shift_2);
                        CAPTURE(system->size(), name(integrator), a_old, da, shift_1);
                        CHECK((to.traction / G - expected).norm() < 1e-12 * expected.norm());
                        const double force = G * a_0 * a_new * exact.w.dot(expected);
                        CHECK(step.force_per_width == Approx(force).epsilon(1e-12));
                        CHECK(step.force == Approx(0.8 * force).epsilon(1e-12));
                        CHECK(model.force(to) == Approx(step.force).epsilon(1e-14));
                        CHECK(to.half_length == a_new * a_0);
                        if (da != 0) continue;  // the same without a load, after a step of the same distance, too
                        for (const double before : {0.0, dq * a_0}) {
                            from.distance = before;
                            const AdhesionModel<>::Step unloaded =
                                model.advance(from, {dq * a_0, motion}, to, workspace);
                            CHECK(unloaded.force == Approx(step.force).epsilon(1e-12));
                        }
                        from.distance = 0;
                        CHECK(to.system == model.fingerprint());
                    }
                }
            }
        }
    }
}

TEST_CASE("A few Chebyshev states resolve a breathing contact as well as many elements", "[breathing]") {
    const Sine a{0.3, 6};
    const double dq = 0.01;
    const auto last_force = [&](const RollingSystem<double>& system) {
        const Model model(unit_contact(100), system, unchecked);
        Run run(model, model.steady(1));
        double force = 0;
        for (int k = 1; k <= 600; ++k) {
            const AdhesionModel<>::Step step = run.advance({dq, 1.0, a(k * dq)});
            REQUIRE(step.status == Status::ok);
            force = step.force_per_width;
        }
        return force;
    };
    const double fine = last_force(states(40, 100));
    const auto error = [&](const auto& system) { return std::abs(last_force(system) / fine - 1); };
    for (const auto& [m, least, most] :
         {std::tuple(4, 1e-6, 1.6e-5), {6, 0.0, 2.2e-7}, {8, 0.0, 3e-8}, {12, 1e-10, 2.5e-9}}) {
        const double found = error(states(m, 100));
        CAPTURE(m, found);
        CHECK(found > least);
        CHECK(found < most);
    }
    // elements converge to the same force; what the slip is carried by belongs to the middle between two nodes,
    // wherever G is taken
    for (const AnyScheme& scheme : {AnyScheme(Collocation{}), AnyScheme(NodeDifference{Nodes::centres}),
                                    AnyScheme(NodeDifference{Nodes::chebyshev})}) {
        const std::vector<double> counts{20, 40, 80};
        std::vector<double> errors;
        for (const double n : counts) {
            errors.push_back(error(rolling_system(cosine_mesh(static_cast<Eigen::Index>(n)), scheme, plane(100))));
        }
        CAPTURE(errors);
        CHECK(std::abs(support::observed_order(counts, errors) - 2) < 0.1);
        CHECK(std::abs(4 * errors[2] - errors[1]) / 3 < 1e-6);
    }
}

TEST_CASE("The trailing edge releases the work that full adhesion does not store", "[breathing]") {
    // -xi F = dE/dq + (1 - a') pi c1 P^2, p = P/sqrt(a + x) at the trailing edge, over a period
    const Sine a{0.3, 6};
    const double c1 = 1 - nu;
    const auto residual = [&](Eigen::Index m, int steps) {
        const Chebyshev::System<double> system = states(m, 100);
        const Model model(unit_contact(100), system, unchecked);
        const auto energy = [&](const Model::State& state) {
            const VectorXd p = system.traction<double>(state.traction).coefficients;
            const double length = state.half_length;
            const double first = 2 * (c1 * std::log(400 / length) + nu);
            double sum = pi * first * p[0] * p[0];
            for (Eigen::Index k = 1; k <= m; ++k) sum += pi * c1 / static_cast<double>(k) * p[k] * p[k];
            return length * length / 2 * sum;
        };
        const auto release = [&](const Model::State& state, double q) {
            const VectorXd p = system.traction<double>(state.traction).coefficients;
            double at_edge = 0;
            for (Eigen::Index k = 0; k <= m; ++k) at_edge += k % 2 == 0 ? p[k] : -p[k];
            return (1 - a.slope(q)) * pi * c1 * at_edge * at_edge * state.half_length / 2;
        };
        Run run(model, model.steady(1));
        const double dq = 6.0 / steps, start = energy(run.now());
        double work = 0, released = 0, force = model.force(run.now()) / 200, rate = release(run.now(), 0);
        for (int k = 1; k <= steps; ++k) {
            const AdhesionModel<>::Step step = run.advance({dq, 1.0, a(k * dq)});
            REQUIRE(step.status == Status::ok);
            const double next_rate = release(run.now(), k * dq);
            work -= dq * (force + step.force_per_width) / 2;
            released += dq * (rate + next_rate) / 2;
            force = step.force_per_width;
            rate = next_rate;
        }
        return (work - released - (energy(run.now()) - start)) / work;
    };
    // the trapezoidal rule and the steps are of second order: computed twice and extrapolated
    const auto limit = [&](Eigen::Index m) { return std::abs(4 * residual(m, 2400) - residual(m, 1200)) / 3; };
    const double by_6 = limit(6), by_12 = limit(12), by_24 = limit(24);
    CAPTURE(by_6, by_12, by_24);
    CHECK(by_6 > 5e-8);
    CHECK(by_12 < 1.2e-8);
    CHECK(by_24 < 3.5e-9);
}

TEST_CASE("An impossible half-length gives a status", "[breathing][not_finite]") {
    const Contact contact = unit_contact(100);
    const auto status = [](const Model& model, const Model::RollingStep& step, double start = 1) {
        Run run(model, model.steady(1));
        run.now().half_length = start;
        return run.advance(step).status;
    };
    for (const Integrator integrator : breathing_integrators) {
        const Model model(contact, elements(10, 100), unchecked, integrator);
        for (const double change : {0.24, -0.24}) CHECK(status(model, {0.25, 1.0, 1 + change}) == Status::ok);
        for (const double change : {0.25, -0.25, 0.5, -0.5}) {
            CHECK(status(model, {0.25, 1.0, 1 + change}) == Status::needs_fixed_mesh);
        }
        CHECK(status(model, {0, Motion::shift(0.1), 1.0}) == Status::ok);
        CHECK(status(model, {0, Motion::shift(0.1), 1.01}) == Status::needs_fixed_mesh);

        // a result that overflows: the target is then a copy of the initial state
        Run run(model);
        run.now().traction.setConstant(1.7e308);
        CHECK(run.advance({0.1, 1.0, 1.05}).status == Status::not_finite);
        CHECK(run.next().traction == run.now().traction);
        CHECK(run.next().half_length == 1);
    }

    // Lambda = 0: a mode of a longer contact grows in time
    const double b = 0.5, limit = 4 * b * std::exp(nu / (1 - nu));
    for (const RollingSystem<double>& system :
         {RollingSystem<double>(elements(10, b)), RollingSystem<double>(states(6, b))}) {
        const Model model(unit_contact(b), system, unchecked, Integrator::sdirk2);
        CHECK(system.half_length_limit() == Approx(limit).epsilon(1e-14));
        CHECK(status(model, {0.1, 1.0, limit - 0.001}, limit - 0.01) == Status::ok);
        CHECK(status(model, {0.1, 1.0, limit + 0.001}, limit - 0.01) == Status::needs_fixed_mesh);
    }

    // systems that cannot breathe take steps only at their own half-length
    const auto rigid = [&](const Model& model) {
        CHECK_FALSE(model.can_breathe());
        CHECK(status(model, {0.1, 1.0, 1.01}) == Status::needs_fixed_mesh);
        CHECK(status(model, {0.1, 1.0}, 1.01) == Status::needs_fixed_mesh);
        CHECK(status(model, {0.1, 1.0, 1.0}, 1.01) == Status::needs_fixed_mesh);
        Run given(model, model.steady(1)), kept(model, model.steady(1));
        const AdhesionModel<>::Step step = given.advance({0.1, 0.5, 1.0});
        CHECK(step.status == Status::ok);
        CHECK(step.force == kept.advance({0.1, 0.5}).force);
        CHECK(given.now().traction == kept.now().traction);
        CHECK(detail::is_nan(step.tangent_by_half_length));
    };
    const Mesh<double> mesh = cosine_mesh<double>(10);
    const StripKernel<double> strip = StripKernel<double>::longitudinal(contact);
    const ElementSystem<double> system = elements(10, 100);
    rigid(Model(contact, rolling_system(mesh, Collocation{}, strip), unchecked));
    rigid(Model(contact, rolling_system(mesh, Galerkin{0.5, 0.5}, plane(100)), unchecked));
    rigid(Model(contact, rolling_system(Chebyshev{8}, strip), unchecked));
    rigid(Model(contact, ElementSystem<double>(system.G(), system.G_prime(), system.weights()), unchecked));
    rigid(Model(contact, system, unchecked, Integrator::matrix_exponential));
}

}  // namespace
}  // namespace transient_breathing_tests
