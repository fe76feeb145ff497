// rollbem/friction/model.hpp under a varying load: against a second discretisation, closed forms and finer steps.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/friction.hpp>

#include "load_scene.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace friction_tests {
namespace {

// -F/(mu N_0) after each of `steps` steps over the distance Q, from steady rolling at half the creepage of full slip.
std::vector<double> roll(const LoadScene& scene, const SineLoad& sine, double Q, int steps, Integrator integrator) {
    const FrictionModel<> model = scene.model(integrator);
    FrictionWorkspace<> workspace = model.workspace();
    FrictionState<> now = model.at_rest(), next = now;
    NormalLoad<double> load = scene.hertz.at(sine(0));
    FrictionStep<> step = model.steady(now, load_creepage(0.5), load, next, workspace);
    std::vector<double> forces{force_ratio(step, scene.contact)};
    bool ok = step.status == StepStatus::ok;
    for (int k = 1; k <= steps; ++k) {
        std::swap(now, next);
        ok = scene.hertz.set(sine(Q * k / steps), load) == StepStatus::ok && ok;
        step = model.advance(now, Q / steps, load_creepage(0.5), load, next, workspace);
        ok = ok && step.status == StepStatus::ok && step.complementarity_residual < 1e-11;
        forces.push_back(force_ratio(step, scene.contact));
    }
    CHECK(ok);
    return forces;
}

// Largest difference of two series, the second `factor` times as fine.
double largest_difference(const std::vector<double>& one, const std::vector<double>& fine, std::size_t factor) {
    double largest = 0;
    for (std::size_t k = 0; k < one.size(); ++k) largest = std::max(largest, std::abs(one[k] - fine[k * factor]));
    return largest;
}

// Values on which two independent discretisations agree: b/a_0 = 1000, A = 0.5, L = 8, q = 0, 0.4, ... 8, dq -> 0.
const std::vector<double> agreed = {0.7500, 0.7618, 0.7737, 0.7851, 0.7963, 0.8066, 0.8151,
                                    0.8207, 0.8228, 0.8199, 0.8101, 0.7897, 0.7061, 0.5955,
                                    0.5245, 0.4980, 0.4937, 0.5000, 0.5129, 0.5299, 0.5494};

TEST_CASE("Forces on a breathing mesh converge at second order in the number of elements", "[friction][load]") {
    std::vector<double> sizes, changes;
    std::vector<std::vector<double>> series;
    for (const Eigen::Index n : {20, 40, 80, 160}) {
        series.push_back(roll(LoadScene::breathing(cosine_mesh<double>(n)), {}, 8, 80, Integrator::sdirk2));
        CAPTURE(n);
        const double error = largest_difference(agreed, series.back(), 4);
        CAPTURE(error);
        if (n == 20) CHECK(error < 3e-3);
        if (n == 40) CHECK(error < 1e-3);
        if (n >= 80) CHECK(error < 4e-4);  // dq = 0.1
        if (series.size() < 2) continue;
        sizes.push_back(static_cast<double>(n));
        changes.push_back(largest_difference(series[series.size() - 2], series.back(), 1));
    }
    const double order = support::observed_order(sizes, changes);
    CAPTURE(changes[0], changes[1], changes[2], order);
    CHECK(order > 1.6);
    CHECK(order < 2.3);
}

TEST_CASE("Forces on a fixed mesh converge to the same limit at first order", "[friction][load]") {
    std::vector<double> sizes, errors;
    for (const Eigen::Index n : {50, 100, 200, 400}) {
        const std::vector<double> forces =
            roll(LoadScene::fixed(uniform_mesh<double>(n)), {}, 8, 160, Integrator::sdirk2);
        sizes.push_back(static_cast<double>(n));
        errors.push_back(largest_difference(agreed, forces, 8));
    }
    const double order = support::observed_order(sizes, errors);
    CAPTURE(errors[0], errors[1], errors[2], errors[3], order);
    CHECK(errors[0] < 9e-3);
    CHECK(errors[1] < 4.4e-3);
    CHECK(errors[2] < 2.3e-3);
    CHECK(errors[3] < 1.2e-3);
    CHECK(order > 0.9);
    CHECK(order < 1.1);
}

TEST_CASE("Under a slowly varying load, the force follows Carter's solution", "[friction][load]") {
    std::vector<double> lengths, differences;
    for (const double L : {8.0, 40.0, 200.0, 1000.0}) {
        const SineLoad sine{.L = L};
        const int steps = 160;
        const std::vector<double> forces =
            roll(LoadScene::breathing(cosine_mesh<double>(40)), sine, L, steps, Integrator::sdirk2);
        double largest = 0;
        for (int k = 0; k <= steps; ++k) {
            const double relative = sine(L * k / steps) / full_force;  // a^2
            largest = std::max(largest, std::abs(forces[static_cast<std::size_t>(k)] -
                                                 relative * carter_force_ratio(0.5 / std::sqrt(relative))));
        }
        lengths.push_back(L);
        differences.push_back(largest);
    }
    CAPTURE(differences[0], differences[1], differences[2], differences[3]);
    CHECK(differences[0] == Approx(0.20).margin(0.01));
    CHECK(differences[1] == Approx(0.12).margin(0.01));
    CHECK(differences[2] == Approx(0.031).margin(0.002));
    CHECK(differences[3] < 0.009);
}

TEST_CASE("Oblique loading without rolling gives stick everywhere", "[friction][load]") {
    // p = k p_n from zero load, and the corresponding shift, minus the displacement at the centre under k times Hertz's
    // pressure: W = -k p_0 a ((1-nu) (ln(4b/a) + 1/2) + nu)/G
    constexpr double k = 0.6, b = 1000;
    const auto shift = [](double a) {
        return a == 0 ? 0 : -k * peak * a * a * ((1 - load_nu) * (std::log(4 * b / a) + 0.5) + load_nu);
    };
    LoadScene scene = LoadScene::fixed(uniform_mesh<double>(40), 1, b);
    scene.scheme = {.alpha_L = 0, .alpha_T = 0};
    const FrictionModel<> model = scene.model();
    FrictionWorkspace<> workspace = model.workspace();
    const NormalLoad<double> last = scene.hertz.at(full_force);
    const VectorX<double> exact = k * last.normal_pressure.matrix();
    std::vector<double> errors;
    for (const int steps : {5, 20, 80}) {
        FrictionState<> now = model.at_rest(), next = now;
        now.normal_pressure.setZero();
        NormalLoad<double> load = scene.hertz.at(0);
        FrictionStep<> step;
        double before = 0;
        for (int i = 1; i <= steps; ++i) {
            const double P = full_force * i / steps, a = scene.hertz.half_length(P);
            REQUIRE(scene.hertz.set(P, load) == StepStatus::ok);
            step = model.advance(now, 0, RigidMotion<double>::shift(shift(a) - shift(before)), load, next, workspace);
            REQUIRE(step.status == StepStatus::ok);
            before = a;
            std::swap(now, next);
        }
        const auto norm = [&](const VectorX<double>& p) {
            return std::sqrt((p.array().square() * scene.mesh.widths()).sum());
        };
        errors.push_back(norm(now.traction - exact) / norm(exact));
        const double force_error = step.force / (k * full_force * scene.contact.width()) - 1;
        CAPTURE(steps, errors.back(), force_error, step.stick_count);
        CHECK(std::abs(force_error) < (steps == 5 ? 1.05e-2 : steps == 20 ? 5e-3 : 3e-3));
        CHECK(step.stick_count >= (steps == 5 ? 36 : 40));
    }
    CAPTURE(errors[0], errors[1], errors[2]);
    CHECK(errors[0] < 0.16);
    CHECK(errors[1] < 0.06);
    CHECK(errors[2] < 0.03);
}

}  // namespace
}  // namespace friction_tests
