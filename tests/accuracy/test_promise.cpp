// rollbem/accuracy/recommendation.hpp: every recommended scheme keeps its promise; and what richardson.hpp extrapolates
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <utility>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/accuracy/richardson.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/frequency.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/compiled/transient.hpp>
#include <rollbem/friction/steady.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/step_response.hpp>
#include <rollbem/reference/strip.hpp>

#include "support/catch.hpp"

namespace {

using namespace rollbem;
using Complex = std::complex<double>;

const Contact<double> wide = Contact<double>::dimensionless(1000, 0.28);
const PlaneKernel<double> kernel = PlaneKernel<double>::longitudinal(wide);

TEST_CASE("Schemes that extrapolate, and one that does not", "[richardson]") {
    const double exact = steady_c11(0.28);
    const auto steady = [](const auto& make_mesh, double alpha_L, double alpha_T) {
        return [=](std::ptrdiff_t n) {
            return solve_steady(make_mesh(n), Collocation{.alpha_L = alpha_L, .alpha_T = alpha_T}, kernel).c11;
        };
    };
    const auto uniform = [](Eigen::Index n) { return uniform_mesh(n); };
    const auto cosine = [](Eigen::Index n) { return cosine_mesh(n); };
    const auto first = extrapolate(steady(uniform, 0.5, 0.5), 10, 1);
    CHECK(first.status == Status::ok);
    CHECK(std::abs(first.value - exact) < first.error_estimate);
    CHECK(std::abs(first.value / exact - 1) < 1e-5);
    const auto second = extrapolate(steady(cosine, 0.5, 0.5), 10, 2);
    CHECK(second.status == Status::ok);
    CHECK(std::abs(second.value / exact - 1) < 3e-6);
    // the error of 0/0.63 changes its sign near n = 18
    CHECK(extrapolate(steady(uniform, 0, 0.63), 10, 1).status == Status::order_differs);
    // a frequency that the mesh does not resolve, and one it does
    const auto harmonic = [](double z) {
        return [=](std::ptrdiff_t n) { return solve_harmonic(cosine_mesh(n), Collocation{0.5, 0.5}, kernel, z).c11; };
    };
    CHECK(extrapolate(harmonic(5), 10, 2).status == Status::order_differs);
    const auto resolved = extrapolate(harmonic(1), 20, 2);
    CHECK(resolved.status == Status::ok);
    CHECK(std::abs(resolved.value / reference::harmonic_c11(1, 0.28, 1000) - 1.0) < 1e-6);
}

// error(scheme) stays below the tolerance, yet not by more than the factor `slack`: no more elements than needed.
template <class Error>
void check_promise(Purpose purpose, double tolerance, double slack, const Error& error) {
    const RecommendedScheme best = recommended_scheme(tolerance, purpose);
    const double found = error(best);
    CAPTURE(static_cast<int>(purpose), tolerance, best.n, found, best.error_bound);
    CHECK(best.error_bound <= tolerance);
    CHECK(found <= best.error_bound);
    CHECK(found > tolerance / slack);
}

TEST_CASE("Recommended for steady rolling", "[recommendation]") {
    for (const double tolerance : {0.5, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 1e-7, 1e-8, 1e-9}) {
        check_promise(Purpose::steady, tolerance, tolerance > 2e-3 ? 1e3 : 4, [](const RecommendedScheme& best) {
            const double c11 =
                best.evaluate([&](const Mesh<double>& mesh) { return solve_steady(mesh, best.scheme, kernel).c11; });
            return std::abs(c11 / steady_c11(0.28) - 1);
        });
    }
}

TEST_CASE("Recommended for steady rolling of a strip", "[recommendation]") {
    const StripKernel<double> strip(10, 0.72, 0.28);
    const double exact = reference::strip_c11(0, 0.28, 10).c11.real();
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
        check_promise(Purpose::steady, tolerance, 4, [&](const RecommendedScheme& best) {
            const double c11 =
                best.evaluate([&](const Mesh<double>& mesh) { return solve_steady(mesh, best.scheme, strip).c11; });
            return std::abs(c11 / exact - 1);
        });
    }
}

TEST_CASE("Recommended for the frequency response", "[recommendation]") {
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {10.0, 1e5}) {
            const PlaneKernel<double> plane(aspect, 1 - nu, nu);
            for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-5}) {
                const double slack = tolerance > 0.05 ? 1e3 : aspect > 10 ? 20 : 4;
                check_promise(Purpose::frequency, tolerance, slack, [&](const RecommendedScheme& best) {
                    double largest = 0;
                    for (const double z : {0.01, 0.3, 1.0, 2.0, 3.5, 5.0}) {
                        const Complex c11 = best.evaluate(
                            [&](const Mesh<double>& mesh) { return solve_harmonic(mesh, best.scheme, plane, z).c11; });
                        largest = std::max(largest, std::abs(c11 / reference::harmonic_c11(z, nu, aspect) - 1.0));
                    }
                    return largest;
                });
            }
        }
    }
}

TEST_CASE("Recommended for a time loop", "[recommendation]") {
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {10.0, 1e5}) {
            const Contact<double> contact = Contact<double>::dimensionless(aspect, nu);
            const reference::StepResponse exact(nu, aspect, 400);
            for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 3e-5}) {
                const double slack = tolerance > 0.05 ? 1e3 : 3;
                check_promise(Purpose::time_loop, tolerance, slack, [&](const RecommendedScheme& best) {
                    const Mesh<double> mesh = best.mesh(best.n);
                    const ElementSystem<double> system =
                        rolling_system(mesh, best.scheme, PlaneKernel<double>::longitudinal(contact));
                    CHECK(best.order == 0);
                    CHECK(count_unstable<double>(system).unstable_count == 0);
                    CHECK(count_unstable<double>(system).status == Status::ok);
                    const TransientModel<double> model(contact, system, unchecked, Integrator::matrix_exponential);
                    const PreparedStep<double> half = model.prepare(0.5);
                    TransientState<double> state = model.at_rest(), next = state;
                    double largest = 0;
                    for (int k = 1; k <= 80; ++k) {
                        const double force = -model.advance(state, half, 1.0, next).force_per_width;
                        if (k > 1) largest = std::max(largest, std::abs(force / exact.step(0.5 * k) - 1));
                        std::swap(state, next);
                    }
                    return largest;
                });
            }
        }
    }
}

TEST_CASE("Recommended for friction", "[recommendation]") {
    const double peak = 1e-3;
    for (const double tolerance : {0.5, 0.1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4}) {
        check_promise(Purpose::friction, tolerance, tolerance > 0.09 ? 1e3 : 2.5, [&](const RecommendedScheme& best) {
            const Mesh<double> mesh = best.mesh(best.n);
            const SteadyFrictionModel<double> model(wide, mesh, best.scheme, kernel,
                                                    {1, peak * mean_hertz_pressure(mesh)});
            FrictionState<double> now = model.at_rest(), next = now;
            FrictionWorkspace<double> workspace = model.workspace();
            double largest = 0;
            for (double ratio = 0.05; ratio < 1.1; ratio += 0.025) {
                const FrictionStep<double> point = model.solve(now, 2 * 0.72 * peak * ratio, next, workspace);
                CHECK(point.status == StepStatus::ok);
                const double force_ratio = -point.force_per_width / (peak * std::numbers::pi / 2);
                largest = std::max(largest, std::abs(force_ratio / carter_force_ratio(ratio) - 1));
                std::swap(now, next);
            }
            return largest;
        });
    }
}

}  // namespace
