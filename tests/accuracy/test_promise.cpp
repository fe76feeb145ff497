// rollbem/accuracy/recommendation.hpp: recommended schemes stay below their error bounds; richardson.hpp on schemes
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/accuracy/richardson.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/adhesion.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/step_response.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "support/catch.hpp"
#include "support/strip_instances.hpp"

namespace promise_tests {
namespace {

using namespace rollbem;
using Complex = std::complex<double>;

const Contact<double> wide = Contact<double>::dimensionless(1000, 0.28);
const PlaneKernel<double> kernel = PlaneKernel<double>::longitudinal(wide);

TEST_CASE("Extrapolation succeeds where the error has the assumed order, and only there", "[richardson]") {
    const double exact = steady_c11(0.28);
    const auto steady = [](const auto& make_mesh, double alpha_L, double alpha_T) {
        return [=](std::ptrdiff_t n) {
            return solve_steady(make_mesh(n), Collocation{.alpha_L = alpha_L, .alpha_T = alpha_T}, kernel).c11();
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
    // between centres the next term is of fourth order
    const auto centres = [](std::ptrdiff_t n) { return solve_steady(cosine_mesh(n), NodeDifference{}, kernel).c11(); };
    for (const std::ptrdiff_t n : {5, 10, 20, 40}) {
        const double error = richardson(centres(n), centres(2 * n), 2.0) / exact - 1;
        CAPTURE(n, error);
        CHECK(std::abs(error / (-0.756 * std::pow(2.0 * static_cast<double>(n), -4)) - 1) < 0.01);
    }
    // the error of 0/0.63 changes its sign near n = 18
    CHECK(extrapolate(steady(uniform, 0, 0.63), 10, 1).status == Status::order_differs);
    // a frequency that the mesh does not resolve, and one that it does
    const auto harmonic = [](double z) {
        return [=](std::ptrdiff_t n) {
            return solve_response(rolling_system(cosine_mesh(n), Collocation{0.5, 0.5}, kernel), {0, z}).c11();
        };
    };
    CHECK(extrapolate(harmonic(5), 10, 2).status == Status::order_differs);
    const auto resolved = extrapolate(harmonic(1), 20, 2);
    CHECK(resolved.status == Status::ok);
    CHECK(std::abs(resolved.value / reference::plane_c11({0, 1}, 0.28, 1000) - 1.0) < 1e-6);
}

// The error `found` with `best` is below the bound, and at least tolerance / slack: the scheme is not needlessly fine.
template <class Recommended>
void check_promise(const Recommended& best, double tolerance, double slack, double found) {
    CAPTURE(tolerance, found, best.error_bound);
    CHECK(best.error_bound <= tolerance);
    CHECK(found <= best.error_bound);
    CHECK(found >= tolerance / slack);
}

// Errors against exact results, for states and for elements.
template <class Recommended, class Kernel>
double steady_error(const Recommended& best, const Kernel& own, double exact) {
    const double c11 = best.evaluate([&](const auto&... method) { return solve_steady(method..., own).c11(); });
    return std::abs(c11 / exact - 1);
}

constexpr std::array frequencies{0.0, 0.01, 0.3, 1.0, 1.3, 2.0, 3.0, 3.5, 4.0, 5.0};

template <class Recommended, class Kernel>
double harmonic_error(const Recommended& best, const Kernel& own, const std::vector<Complex>& exact) {
    double largest = 0;
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
        const Complex c11 = best.evaluate([&](const auto&... method) {
            return solve_response<double>(rolling_system(method..., own), {0, frequencies[i]}).c11();
        });
        largest = std::max(largest, std::abs(c11 / exact[i] - 1.0));
    }
    return largest;
}

// Largest error of the force at q/a = 1, 1 + dq, ... after a step of creepage; `exact` begins at dq.
double step_error(double aspect, double nu, const RollingSystem<double>& system, double dq,
                  const std::vector<double>& exact) {
    CHECK(count_unstable<double>(system).unstable_count == 0);
    const AdhesionModel<> model(Contact<double>::dimensionless(aspect, nu), system, unchecked,
                                Integrator::matrix_exponential);
    AdhesionWorkspace<> workspace = model.workspace();
    AdhesionState<> state = model.at_rest(), next = state;
    double largest = 0;
    for (std::size_t k = 1; k <= exact.size(); ++k) {
        const double force = -model.advance(state, dq, 1.0, next, workspace).force_per_width;
        if (static_cast<double>(k) * dq > 1 - 1e-9) largest = std::max(largest, std::abs(force / exact[k - 1] - 1));
        std::swap(state, next);
    }
    return largest;
}

std::vector<double> plane_steps(double aspect, double nu, double dq, int count) {
    const reference::StepResponse response(nu, aspect, 1000);
    std::vector<double> exact;
    for (int k = 1; k <= count; ++k) exact.push_back(response.step(k * dq));
    return exact;
}

// --- elements

TEST_CASE("Elements recommended for steady rolling stay below their error bound", "[recommendation]") {
    for (const double tolerance :
         {0.5, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 1e-7, 1e-8, 1e-9, 1e-11}) {
        const auto best = recommended_elements(tolerance, Purpose::steady);
        check_promise(best, tolerance, tolerance > 2e-3 ? 1e3 : 4, steady_error(best, kernel, steady_c11(0.28)));
    }
}

TEST_CASE("Elements recommended for steady rolling stay below their error bound on a strip", "[recommendation]") {
    const StripKernel<double> strip(10, 0.72, 0.28);
    const double exact = reference::strip_c11(0, 0.28, 10).c11.real();
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
        const auto best = recommended_elements(tolerance, Purpose::steady);
        check_promise(best, tolerance, 4, steady_error(best, strip, exact));
    }
}

TEST_CASE("Elements recommended for the frequency response stay below their error bound", "[recommendation]") {
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {10.0, 1e5}) {
            std::vector<Complex> exact;
            for (const double z : frequencies) exact.push_back(reference::plane_c11({0, z}, nu, aspect));
            for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-5}) {
                const auto best = recommended_elements(tolerance, Purpose::frequency);
                const double slack = tolerance > 0.05 ? 1e3 : aspect > 10 ? 20 : 4;
                check_promise(best, tolerance, slack,
                              harmonic_error(best, PlaneKernel<double>(aspect, 1 - nu, nu), exact));
            }
        }
    }
}

TEST_CASE("Elements recommended for a time loop stay below their error bound", "[recommendation]") {
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {10.0, 1e5}) {
            const std::vector<double> exact = plane_steps(aspect, nu, 0.5, 80);
            for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 3e-5}) {
                const auto best = recommended_elements(tolerance, Purpose::time_loop);
                CHECK(best.order == 0);
                const ElementSystem<double> system =
                    rolling_system(best.mesh(best.n), best.scheme, PlaneKernel<double>(aspect, 1 - nu, nu));
                CHECK(count_unstable<double>(system).status == Status::ok);
                check_promise(best, tolerance, tolerance > 0.05 ? 1e3 : 3, step_error(aspect, nu, system, 0.5, exact));
            }
        }
    }
}

// --- Chebyshev states

TEST_CASE("States recommended for steady rolling stay below their error bound", "[recommendation]") {
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0}) {
            if (aspect < 0.1 && nu > 0) continue;  // narrow strips take long, and err most for nu = 0
            const StripKernel<double> strip(aspect, 1 - nu, nu);
            const double exact = reference::strip_c11(0, nu, aspect).c11.real();
            CAPTURE(nu, aspect);
            for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-11}) {
                const auto best = recommended_scheme(tolerance, Purpose::steady, aspect);
                const double error = steady_error(best, strip, exact);
                check_promise(best, tolerance, std::numeric_limits<double>::infinity(), error);
                // at most twice the states needed: one of three counts near half of them misses the tolerance
                if (aspect < 0.03 || aspect > 3 || tolerance > 1e-4) continue;
                double missed = 0;
                for (Eigen::Index m = best.scheme.states / 2; m < best.scheme.states / 2 + 3; ++m) {
                    missed = std::max(missed, std::abs(solve_steady(Chebyshev{m}, strip).c11() / exact - 1));
                }
                CAPTURE(best.scheme.states);
                CHECK(missed > tolerance);
            }
        }
        for (const double aspect : {10.0, 1e5, std::numeric_limits<double>::infinity()}) {
            const auto best = recommended_scheme(1e-11, Purpose::steady, aspect);
            CHECK(steady_error(best, PlaneKernel<double>(aspect, 1 - nu, nu), steady_c11(nu)) < 1e-14);
        }
    }
}

TEST_CASE("States recommended for the frequency response stay below their error bound", "[recommendation]") {
    for (const double nu : {0.0, 0.28, 0.5}) {
        for (const double aspect : {10.0, 1e3, 1e5}) {
            const PlaneKernel<double> plane(aspect, 1 - nu, nu);
            std::vector<Complex> exact;
            for (const double z : frequencies) exact.push_back(reference::plane_c11({0, z}, nu, aspect));
            CAPTURE(nu, aspect);
            for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11}) {
                const auto best = recommended_scheme(tolerance, Purpose::frequency);
                check_promise(best, tolerance, 100, harmonic_error(best, plane, exact));
                const Recommendation<Chebyshev> fewer{.scheme = {.states = best.scheme.states - 1}};
                if (fewer.scheme.states > 0 && aspect == 10 && nu == 0) {
                    CHECK(harmonic_error(fewer, plane, exact) > 0.85 * tolerance);
                }
            }
        }
    }
}

TEST_CASE("States recommended for the frequency response stay below their error bound on strips", "[recommendation]") {
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {0.05, 0.3, 1.0, 10.0}) {
            if (aspect < 0.1 && nu > 0) continue;  // narrow strips take long
            const StripKernel<double> strip(aspect, 1 - nu, nu);
            std::vector<Complex> exact;
            for (const double z : frequencies) exact.push_back(reference::strip_c11({0, z}, nu, aspect).c11);
            CAPTURE(nu, aspect);
            for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10}) {
                const auto best = recommended_scheme(tolerance, Purpose::frequency, aspect);
                check_promise(best, tolerance, 1e4, harmonic_error(best, strip, exact));
            }
        }
    }
}

TEST_CASE("States recommended for a time loop stay below their error bound", "[recommendation]") {
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {10.0, 1e5}) {
            const std::vector<double> exact = plane_steps(aspect, nu, 0.25, 40);
            CAPTURE(nu, aspect);
            for (const double tolerance : {0.5, 0.1, 1e-2, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6}) {
                const auto best = recommended_scheme(tolerance, Purpose::time_loop);
                const RollingSystem<double> system =
                    rolling_system(best.scheme, PlaneKernel<double>(aspect, 1 - nu, nu));
                check_promise(best, tolerance, 30, step_error(aspect, nu, system, 0.25, exact));
            }
        }
    }
    // strips, against an independent solution and its inverse Laplace transform
    for (const double aspect : {0.3, 10.0}) {
        std::vector<double> exact;
        for (const int q : {1, 2}) {
            const auto transform = [&](std::complex<long double> s) {
                return std::complex<long double>(reference::strip_c11(Complex(s), 0.28, aspect).c11) / s;
            };
            exact.push_back(reference::invert_laplace(transform, q, 20));
        }
        CAPTURE(aspect);
        for (const double tolerance : {0.1, 1e-2, 1e-3, 1e-4}) {
            const auto best = recommended_scheme(tolerance, Purpose::time_loop, aspect);
            const RollingSystem<double> system = rolling_system(best.scheme, StripKernel<double>(aspect, 0.72, 0.28));
            check_promise(best, tolerance, 50, step_error(aspect, 0.28, system, 1, exact));
        }
    }
}

// --- friction

TEST_CASE("Elements recommended for friction stay below their error bound", "[recommendation]") {
    const double peak = 1e-3;
    for (const double tolerance : {0.5, 0.1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4}) {
        const auto best = recommended_scheme(tolerance, Purpose::friction);
        const double error = best.evaluate([&](const Mesh<double>& mesh, const auto& scheme) {
            const FrictionModel model(wide, steady_system(mesh, scheme, kernel), {1, peak * mean_hertz_pressure(mesh)});
            FrictionState<> now = model.at_rest(), next = now;
            FrictionWorkspace<> workspace = model.workspace();
            double largest = 0;
            for (double ratio = 0.05; ratio < 1.1; ratio += 0.005) {
                const FrictionStep<> point = model.steady(now, 2 * 0.72 * peak * ratio, next, workspace);
                CHECK(point.status == StepStatus::ok);
                const double force_ratio = -point.force / (wide.width() * peak * std::numbers::pi / 2);
                largest = std::max(largest, std::abs(force_ratio / carter_force_ratio(ratio) - 1));
                std::swap(now, next);
            }
            return largest;
        });
        check_promise(best, tolerance, tolerance > 0.09 ? 1e3 : 2.5, error);
    }
}

}  // namespace
}  // namespace promise_tests
