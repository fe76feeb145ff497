// rollbem/adhesion/transient.hpp: growth and decay follow the scheme's eigenvalues.
// Separate from test_transient.cpp because the eigenvalue headers are slow to compile.
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include <rollbem/compiled/adhesion.hpp>
#include <rollbem/compiled/stability.hpp>

#include "support/catch.hpp"

namespace transient_stability_tests {
namespace {

using namespace rollbem;

constexpr double aspect = 100;

Contact<double> contact() { return Contact<double>::dimensionless(aspect, 0.25); }

AdhesionModel<> make_model(Eigen::Index n, const Collocation& scheme, Integrator integrator) {
    return {contact(), rolling_system(uniform_mesh<double>(n), scheme, StripKernel<double>::longitudinal(contact())),
            unchecked, integrator};
}

StabilityVerdict make_verdict(Eigen::Index n, const Collocation& scheme) {
    return judge_stability(
        rolling_system(uniform_mesh<double>(n), scheme, StripKernel<double>::longitudinal(contact())));
}

/// Free motion after an initial shift, q from 0 to steps * dq: the forces, and the norm of the final state relative to
/// that after the shift.
struct Decay {
    std::vector<double> forces;
    double growth;
};

Decay free_motion(const AdhesionModel<>& model, double dq, int steps) {
    AdhesionWorkspace<> workspace = model.workspace();
    AdhesionState<> state = model.at_rest(), next = state;
    REQUIRE(model.advance(state, dq, RigidMotion<double>::shift(1.0), next, workspace).status == StepStatus::ok);
    std::swap(state, next);
    const double start = state.traction.norm();
    Decay decay;
    for (int k = 0; k < steps; ++k) {
        const AdhesionStep<> step = model.advance(state, dq, 0.0, next, workspace);
        REQUIRE(step.status == StepStatus::ok);
        decay.forces.push_back(step.force);
        std::swap(state, next);
    }
    decay.growth = state.traction.norm() / start;
    return decay;
}

/// Growth rate of the pair of modes that dominates the end of a series: f_{k+2} = t f_{k+1} - d f_k.
double leading_rate(const std::vector<double>& f, double dq) {
    const std::size_t k = f.size() - 4;
    const double det = f[k + 1] * f[k + 1] - f[k] * f[k + 2];
    const double t = (f[k + 1] * f[k + 2] - f[k] * f[k + 3]) / det;
    const double d = (f[k + 2] * f[k + 2] - f[k + 1] * f[k + 3]) / det;
    const std::complex<double> root = std::sqrt(std::complex<double>(t * t / 4 - d));
    return std::log(std::max(std::abs(t / 2 + root), std::abs(t / 2 - root))) / dq;
}

TEST_CASE("An unstable scheme grows at the rate of its largest eigenvalue, a stable one stays bounded", "[transient]") {
    const Collocation unstable{.alpha_L = 0, .alpha_T = 0.92}, stable{.alpha_L = 0.5, .alpha_T = 0.5};
    const Eigen::Index n = 20;
    const StabilityVerdict bad = make_verdict(n, unstable), good = make_verdict(n, stable);
    REQUIRE(bad.certainly_unstable());
    REQUIRE(good.stable());
    REQUIRE(good.spectral_abscissa < 0);

    const double way = 40 / bad.spectral_abscissa;  // e^40
    const int steps = 4000;
    const AdhesionModel<> exact = make_model(n, unstable, Integrator::matrix_exponential);
    const Decay grown = free_motion(exact, way / steps, steps);
    const double rate = leading_rate(grown.forces, way / steps);
    CAPTURE(bad.spectral_abscissa, rate, grown.growth);
    CHECK(std::abs(rate / bad.spectral_abscissa - 1) < 1e-6);
    CHECK(grown.growth > 1e10);

    const Decay calm = free_motion(make_model(n, stable, Integrator::matrix_exponential), way / steps, steps);
    CAPTURE(good.spectral_abscissa, calm.growth);
    CHECK(calm.growth < 1);
    double largest = 0;
    for (const double force : calm.forces) largest = std::max(largest, std::abs(force));
    CHECK(largest < 1.05 * std::abs(calm.forces[0]));
}

TEST_CASE("A stable scheme decays at the rate of its largest eigenvalue", "[transient]") {
    const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    const double abscissa = make_verdict(30, scheme).spectral_abscissa;
    const auto rate = [&](Integrator integrator, double dq) {
        const std::vector<double> forces =
            free_motion(make_model(30, scheme, integrator), dq, static_cast<int>(40 / dq)).forces;
        return std::log(forces.back() / forces[forces.size() - 2]) / dq;
    };
    CHECK(rate(Integrator::matrix_exponential, 0.1) == Approx(abscissa).epsilon(1e-10));
    CHECK(rate(Integrator::sdirk2, 0.1) == Approx(abscissa).epsilon(1e-4));
    CHECK(rate(Integrator::implicit_euler, 0.1) == Approx(std::log(1 / (1 - 0.1 * abscissa)) / 0.1).epsilon(1e-10));
}

}  // namespace
}  // namespace transient_stability_tests
