// rollbem/accuracy/recommendation.hpp: recommended schemes stay below their error bounds
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/line.hpp>
#include <rollbem/reference/bessel.hpp>

#include "studies/stick_border.hpp"
#include "support/catch.hpp"
#include "support/strip_instances.hpp"

namespace promise_tests {
namespace {

using namespace rollbem;
using Complex = std::complex<double>;

// The error `found` with `best` is below the bound, and at least tolerance / slack: the scheme is not needlessly fine.
template <class Recommended>
void check_promise(const Recommended& best, double tolerance, double slack, double found) {
    CAPTURE(tolerance, found, best.error_bound);
    CHECK(best.error_bound <= tolerance);
    CHECK(found <= best.error_bound);
    CHECK(found >= tolerance / slack);
}
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Scene {
    LineModel model;
    double aspect, nu;

    bool is_strip() const { return model == LineModel::strip; }
    AnyKernel<double> kernel() const { return {model, aspect, 1 - nu, nu}; }
    Contact contact() const { return Contact::dimensionless(aspect, nu); }
};

// Errors against exact results, for states and for elements.
template <class Recommended>
double steady_error(const Recommended& best, const Scene& scene, double exact) {
    const double c11 =
        best.evaluate([&](const auto&... method) { return solve_steady(method..., scene.kernel()).c11(); });
    return std::abs(c11 / exact - 1);
}

const std::vector<double> frequencies{0.0, 0.01, 0.3, 1.0, 1.3, 2.0, 3.0, 3.5, 4.0, 5.0};

template <class Recommended>
double harmonic_error(const Recommended& best, const Scene& scene, const std::vector<double>& z,
                      const std::vector<Complex>& exact) {
    double largest = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        const Complex c11 = best.evaluate([&](const auto&... method) {
            return solve_response<double>(rolling_system(method..., scene.kernel()), {0, z[i]}).c11();
        });
        largest = std::max(largest, std::abs(c11 / exact[i] - 1.0));
    }
    return largest;
}

// The force at q/a = dq, 2 dq, ... after a step of creepage, without the error of an integrator.
std::vector<double> step_forces(const Scene& scene, const RollingSystem<double>& system, double dq, std::size_t count) {
    const AdhesionModel<> model(scene.contact(), system, unchecked, Integrator::matrix_exponential);
    Run run(model);
    std::vector<double> forces;
    while (forces.size() < count) forces.push_back(-run.advance({dq, 1.0}).force_per_width);
    return forces;
}

// Largest error of these from q/a = 1 on.
double step_error(const Scene& scene, const RollingSystem<double>& system, double dq,
                  const std::vector<double>& exact) {
    const std::vector<double> forces = step_forces(scene, system, dq, exact.size());
    double largest = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        if (static_cast<double>(k + 1) * dq > 1 - 1e-9) largest = std::max(largest, std::abs(forces[k] / exact[k] - 1));
    }
    return largest;
}

std::vector<double> plane_steps(const Scene& scene, double dq, std::size_t count) {
    const reference::StepResponse response(scene.nu, scene.aspect, 1000);
    std::vector<double> exact;
    while (exact.size() < count) exact.push_back(response.step(static_cast<double>(exact.size() + 1) * dq));
    return exact;
}

// --- elements

// Where the bounds of elements hold: strips from b/a = 10 on and the plane kernel up to its limit, both ends of nu.
std::vector<Scene> scenes(double widest) {
    std::vector<Scene> all;
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {10.0, 30.0}) all.push_back({LineModel::strip, aspect, nu});
        for (const double aspect : {10.0, widest}) all.push_back({LineModel::plane, aspect, nu});
    }
    return all;
}

TEST_CASE("Elements recommended for steady rolling stay below their error bound", "[recommendation]") {
    for (const Scene& scene : scenes(infinity)) {
        const auto [model, aspect, nu] = scene;
        const bool strip = scene.is_strip();
        const double exact = strip ? reference::strip_c11(0, nu, aspect).c11.real() : steady_c11(nu);
        CAPTURE(nu, aspect, strip);
        for (const double tolerance :
             {0.5, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 3.4e-11}) {
            if (tolerance < 1e-9 && aspect > 10) continue;
            const auto best = recommended_elements(tolerance, Purpose::steady);
            // on strips the errors of third and fourth order may cancel
            const double slack = strip && nu == 0 ? infinity : tolerance > 2e-3 ? 1e3 : 8;
            check_promise(best, tolerance, slack, steady_error(best, scene, exact));
        }
    }
}

TEST_CASE("Elements recommended for the frequency response stay below their error bound", "[recommendation]") {
    for (const Scene& scene : scenes(1e5)) {
        const auto [model, aspect, nu] = scene;
        const bool strip = scene.is_strip();
        std::vector<Complex> exact;
        for (const double z : frequencies) {
            exact.push_back(strip ? reference::strip_c11({0, z}, nu, aspect).c11
                                  : reference::plane_c11({0, z}, nu, aspect));
        }
        CAPTURE(nu, aspect, strip);
        for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4}) {
            const auto best = recommended_elements(tolerance, Purpose::frequency);
            const double slack = tolerance > 0.05 ? 1e3 : aspect > 10 ? 20 : 4;
            check_promise(best, tolerance, slack, harmonic_error(best, scene, frequencies, exact));
        }
        if (aspect > 10 || strip == (nu == 0)) continue;
        for (const double tolerance : {1e-5, 1e-6, 1.3e-7}) {  // the largest error is that at the highest frequency
            if (tolerance < 1e-6 && strip) continue;
            const auto best = recommended_elements(tolerance, Purpose::frequency);
            check_promise(best, tolerance, 4, harmonic_error(best, scene, {frequencies.back()}, {exact.back()}));
        }
    }
}

TEST_CASE("Elements recommended for a time loop stay below their error bound", "[recommendation]") {
    for (const Scene& scene : scenes(1e5)) {
        const auto system_of = [&](const Recommendation<AnyScheme>& best) {
            return rolling_system(best.mesh(best.n), best.scheme, scene.kernel());
        };
        CAPTURE(scene.nu, scene.aspect, scene.is_strip());
        const std::vector<double> exact =
            scene.is_strip() ? step_forces(scene, rolling_system(Chebyshev{150}, scene.kernel()), 0.05, 800)
                             : plane_steps(scene, 0.05, 800);
        for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 5e-5}) {
            const auto best = recommended_elements(tolerance, Purpose::time_loop);
            CHECK(best.order == 0);
            const ElementSystem<double> system = system_of(best);
            const StabilityResult::Count count = count_unstable(system);
            CHECK(count.status == Status::ok);
            CHECK(count.unstable_count == 0);
            check_promise(best, tolerance, tolerance > 0.05 ? 1e3 : 3, step_error(scene, system, 0.05, exact));
        }
        // errors are largest here, where the front leaves
        if (scene.aspect > 10 || scene.is_strip() || scene.nu > 0) continue;
        const std::vector<double> front = plane_steps(scene, 0.02, 125);
        for (const double tolerance : {1e-5, 3.4e-6}) {
            const auto best = recommended_elements(tolerance, Purpose::time_loop);
            check_promise(best, tolerance, 1.2, step_error(scene, system_of(best), 0.02, front));
        }
    }
}

// --- Chebyshev states

TEST_CASE("States recommended for steady rolling stay below their error bound", "[recommendation]") {
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0}) {
            if (aspect < 0.1 && nu > 0) continue;  // narrow strips take long, and err most for nu = 0
            const Scene strip{LineModel::strip, aspect, nu};
            const auto c11 = [&](Eigen::Index m) { return solve_steady(Chebyshev{m}, strip.kernel()).c11(); };
            const double exact = aspect > 0.02 ? reference::strip_c11(0, nu, aspect).c11.real() : c11(320);
            CAPTURE(nu, aspect);
            for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-11}) {
                if (aspect < 0.03 && tolerance < 1e-2 && tolerance > 1e-11) continue;
                const auto best = recommended_scheme(tolerance, Purpose::steady, aspect);
                check_promise(best, tolerance, infinity, steady_error(best, strip, exact));
                // at most twice the states needed: one of three counts near half of them misses the tolerance
                if (aspect < 0.03 || aspect > 3 || tolerance > 1e-4) continue;
                double missed = 0;
                for (Eigen::Index m = best.scheme.states / 2; m < best.scheme.states / 2 + 3; ++m) {
                    missed = std::max(missed, std::abs(c11(m) / exact - 1));
                }
                CAPTURE(best.scheme.states);
                CHECK(missed > tolerance);
            }
        }
        for (const double aspect : {10.0, 1e5, infinity}) {
            const auto best = recommended_scheme(1e-11, Purpose::steady, aspect);
            CHECK(steady_error(best, Scene{LineModel::plane, aspect, nu}, steady_c11(nu)) < 1e-14);
        }
    }
}

TEST_CASE("States recommended for the frequency response stay below their error bound", "[recommendation]") {
    std::vector<Scene> all = scenes(1e5);
    for (const double nu : {0.0, 0.5}) {
        all.push_back({LineModel::plane, 30, nu});
        for (const double aspect : {0.3, 1.0}) all.push_back({LineModel::strip, aspect, nu});
    }
    all.push_back({LineModel::strip, 0.05, 0});  // narrow strips take long
    for (const Scene& scene : all) {
        const auto [model, aspect, nu] = scene;
        const bool strip = scene.is_strip();
        std::vector<Complex> exact;
        if (strip) {
            const RollingSystem<double> fine = rolling_system(Chebyshev{aspect < 0.1 ? 220 : 120}, scene.kernel());
            for (const double z : frequencies) exact.push_back(solve_response(fine, {0, z}).c11());
            CHECK(std::abs(reference::strip_c11({0, 5}, nu, aspect).c11 / exact.back() - 1.0) < 1e-12);
        } else {
            for (const double z : frequencies) exact.push_back(reference::plane_c11({0, z}, nu, aspect));
        }
        CAPTURE(nu, aspect, strip);
        for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11}) {
            const auto best = recommended_scheme(tolerance, Purpose::frequency, strip ? aspect : 10);
            check_promise(best, tolerance, strip ? 1e4 : 100, harmonic_error(best, scene, frequencies, exact));
            const Recommendation<Chebyshev> fewer{.scheme = {.states = best.scheme.states - 1}};
            if (fewer.scheme.states > 0 && !strip && aspect == 10 && nu == 0) {
                CHECK(harmonic_error(fewer, scene, frequencies, exact) > 0.85 * tolerance);
            }
        }
    }
}

TEST_CASE("States recommended for a time loop stay below their error bound", "[recommendation]") {
    const auto error = [](const Recommendation<Chebyshev>& best, const Scene& scene, double dq,
                          const std::vector<double>& exact) {
        return step_error(scene, rolling_system(best.scheme, scene.kernel()), dq, exact);
    };
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {10.0, 30.0, 1e5}) {
            const Scene plane{LineModel::plane, aspect, nu};
            const std::vector<double> exact = plane_steps(plane, 0.05, 200);
            CAPTURE(nu, aspect);
            for (const double tolerance : {0.5, 0.1, 1e-2, 3e-3, 1e-3, 7e-4, 1e-4, 1e-5, 1e-6, 1.4e-7}) {
                if (tolerance < 1e-6 && (aspect > 10 || nu > 0)) continue;  // errors are largest there
                const auto best = recommended_scheme(tolerance, Purpose::time_loop);
                check_promise(best, tolerance, 30, error(best, plane, 0.05, exact));
            }
        }
    }
    // strips, against an independent solution and its inverse Laplace transform
    for (const auto& [aspect, nu] : {std::pair{0.3, 0.0}, {10.0, 0.5}, {30.0, 0.0}}) {
        std::vector<double> exact;
        for (const int q : {1, 2}) {
            const auto transform = [&, aspect = aspect, nu = nu](std::complex<long double> s) {
                return std::complex<long double>(reference::strip_c11(Complex(s), nu, aspect).c11) / s;
            };
            exact.push_back(reference::invert_laplace(transform, q, 20));
        }
        CAPTURE(nu, aspect);
        for (const double tolerance : {0.1, 1e-2, 1e-3, 1e-4}) {
            const auto best = recommended_scheme(tolerance, Purpose::time_loop, aspect);
            check_promise(best, tolerance, 50, error(best, Scene{LineModel::strip, aspect, nu}, 1, exact));
        }
    }
}

// --- friction

TEST_CASE("Elements recommended for friction stay below their error bound", "[recommendation]") {
    constexpr double peak = 1e-3, full = peak * std::numbers::pi / 2;  // mu p_0 and mu N/(2b), in units of G and a
    std::vector<double> ratios;                                        // dense where the error is largest
    for (double ratio = 0.05; ratio < 1.1; ratio += ratio < 0.1 ? 0.0005 : 0.005) ratios.push_back(ratio);
    for (const Scene& scene : scenes(1000)) {
        const auto [model, aspect, nu] = scene;
        const bool strip = scene.is_strip(), worst = strip && aspect == 10 && nu == 0;
        if (!strip && aspect == 10) continue;  // the slope of the plane kernel does not depend on b
        const Contact contact = scene.contact();
        const auto creepage = [nu = nu](double ratio) { return 2 * (1 - nu) * peak * ratio; };
        std::vector<double> exact;  // |F|/(mu N)
        for (const double ratio : ratios) {
            exact.push_back(strip ? -studies::solve_stick_border(contact, scene.kernel(), 1.0,
                                                                 HertzLine::Pressure{peak}, creepage(ratio))
                                            .force_per_width /
                                        full
                                  : carter_force_ratio(ratio));
        }
        CAPTURE(nu, aspect, strip);
        for (const double tolerance : {0.5, 0.1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 3.3e-6}) {
            if (tolerance < 1e-4 && !worst) continue;
            const auto best = recommended_scheme(tolerance, Purpose::friction);
            const Mesh<double> mesh = best.mesh(best.n);
            const FrictionModel friction(contact, steady_system(mesh, best.scheme, scene.kernel()),
                                         {1, peak * mean_hertz_pressure(mesh)});
            Run run(friction);
            double largest = 0;
            for (std::size_t i = 0; i < ratios.size(); ++i) {
                const FrictionStep point = run.steady({.motion = Creepage{creepage(ratios[i])}});
                REQUIRE(point.status == Status::ok);
                const double found = -point.force.longitudinal / (contact.width() * full);
                largest = std::max(largest, std::abs(found / exact[i] - 1));
            }
            check_promise(best, tolerance, tolerance > 0.09 ? 1e3 : 2.5, largest);
        }
    }
}

}  // namespace
}  // namespace promise_tests
