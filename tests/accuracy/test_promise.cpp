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

const Contact wide = Contact::dimensionless(1000, 0.28);
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
constexpr double infinity = std::numeric_limits<double>::infinity();

// Errors against exact results, for states and for elements.
template <class Recommended>
double steady_error(const Recommended& best, const AnyKernel<double>& own, double exact) {
    const double c11 = best.evaluate([&](const auto&... method) { return solve_steady(method..., own).c11(); });
    return std::abs(c11 / exact - 1);
}

template <class Recommended>
double harmonic_error(const Recommended& best, const AnyKernel<double>& own, double z, Complex exact) {
    const Complex c11 = best.evaluate([&](const auto&... method) {
        return solve_response<double>(rolling_system(method..., own), {0, z}).c11();
    });
    return std::abs(c11 / exact - 1.0);
}

constexpr std::array frequencies{0.0, 0.01, 0.3, 1.0, 1.3, 2.0, 3.0, 3.5, 4.0, 5.0};

template <class Recommended>
double harmonic_error(const Recommended& best, const AnyKernel<double>& own, const std::vector<Complex>& exact) {
    double largest = 0;
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
        largest = std::max(largest, harmonic_error(best, own, frequencies[i], exact[i]));
    }
    return largest;
}

// The force at q/a = dq, 2 dq, ... after a step of creepage, without the error of an integrator.
std::vector<double> step_forces(double aspect, double nu, const RollingSystem<double>& system, double dq, int count) {
    const AdhesionModel<> model(Contact::dimensionless(aspect, nu), system, unchecked, Integrator::matrix_exponential);
    AdhesionModel<>::Workspace workspace = model.workspace();
    AdhesionModel<>::State state = model.at_rest(), next = state;
    std::vector<double> forces;
    for (int k = 0; k < count; ++k) {
        forces.push_back(-model.advance(state, {dq, 1.0}, next, workspace).force_per_width);
        std::swap(state, next);
    }
    return forces;
}

// Largest error of these from q/a = 1 on.
double step_error(double aspect, double nu, const RollingSystem<double>& system, double dq,
                  const std::vector<double>& exact) {
    const std::vector<double> forces = step_forces(aspect, nu, system, dq, static_cast<int>(exact.size()));
    double largest = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        if (static_cast<double>(k + 1) * dq > 1 - 1e-9) largest = std::max(largest, std::abs(forces[k] / exact[k] - 1));
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

// Where the bounds of elements hold: strips from b/a = 10 on and the plane kernel up to its limit, both ends of nu.
struct Scene {
    LineModel model;
    double aspect, nu;

    bool is_strip() const { return model == LineModel::strip; }
    AnyKernel<double> kernel() const { return {model, aspect, 1 - nu, nu}; }
};
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
        const AnyKernel<double> own = scene.kernel();
        const double exact = strip ? reference::strip_c11(0, nu, aspect).c11.real() : steady_c11(nu);
        CAPTURE(nu, aspect, strip);
        for (const double tolerance :
             {0.5, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 3.4e-11}) {
            if (tolerance < 1e-9 && aspect > 10) continue;
            const auto best = recommended_elements(tolerance, Purpose::steady);
            // on strips the errors of third and fourth order may cancel
            const double slack = strip && nu == 0 ? infinity : tolerance > 2e-3 ? 1e3 : 8;
            check_promise(best, tolerance, slack, steady_error(best, own, exact));
        }
    }
}

TEST_CASE("Elements recommended for the frequency response stay below their error bound", "[recommendation]") {
    for (const Scene& scene : scenes(1e5)) {
        const auto [model, aspect, nu] = scene;
        const bool strip = scene.is_strip();
        const AnyKernel<double> own = scene.kernel();
        std::vector<Complex> exact;
        for (const double z : frequencies) {
            exact.push_back(strip ? reference::strip_c11({0, z}, nu, aspect).c11
                                  : reference::plane_c11({0, z}, nu, aspect));
        }
        CAPTURE(nu, aspect, strip);
        for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4}) {
            const auto best = recommended_elements(tolerance, Purpose::frequency);
            const double slack = tolerance > 0.05 ? 1e3 : aspect > 10 ? 20 : 4;
            check_promise(best, tolerance, slack, harmonic_error(best, own, exact));
        }
        if (aspect > 10 || strip == (nu == 0)) continue;
        for (const double tolerance : {1e-5, 1e-6, 1.3e-7}) {  // the largest error is that at the highest frequency
            if (tolerance < 1e-6 && strip) continue;
            const auto best = recommended_elements(tolerance, Purpose::frequency);
            check_promise(best, tolerance, 4, harmonic_error(best, own, frequencies.back(), exact.back()));
        }
    }
}

TEST_CASE("Elements recommended for a time loop stay below their error bound", "[recommendation]") {
    for (const Scene& scene : scenes(1e5)) {
        const auto [model, aspect, nu] = scene;
        const AnyKernel<double> own = scene.kernel();
        const auto steps = [&, aspect = aspect, nu = nu](double dq, int count) {
            return scene.is_strip() ? step_forces(aspect, nu, rolling_system(Chebyshev{150}, own), dq, count)
                                    : plane_steps(aspect, nu, dq, count);
        };
        CAPTURE(nu, aspect, scene.is_strip());
        const std::vector<double> exact = steps(0.05, 800);
        for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 5e-5}) {
            const auto best = recommended_elements(tolerance, Purpose::time_loop);
            CHECK(best.order == 0);
            const ElementSystem<double> system = rolling_system(best.mesh(best.n), best.scheme, own);
            const StabilityResult::Count count = count_unstable(system);
            CHECK(count.status == Status::ok);
            CHECK(count.unstable_count == 0);
            check_promise(best, tolerance, tolerance > 0.05 ? 1e3 : 3, step_error(aspect, nu, system, 0.05, exact));
        }
        if (aspect > 10 || scene.is_strip() || nu > 0) continue;  // errors are largest here, where the front leaves
        const std::vector<double> front = steps(0.02, 125);
        for (const double tolerance : {1e-5, 3.4e-6}) {
            const auto best = recommended_elements(tolerance, Purpose::time_loop);
            const ElementSystem<double> system = rolling_system(best.mesh(best.n), best.scheme, own);
            check_promise(best, tolerance, 1.2, step_error(aspect, nu, system, 0.02, front));
        }
    }
}

// --- Chebyshev states

TEST_CASE("States recommended for steady rolling stay below their error bound", "[recommendation]") {
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0}) {
            if (aspect < 0.1 && nu > 0) continue;  // narrow strips take long, and err most for nu = 0
            const AnyKernel<double> strip(LineModel::strip, aspect, 1 - nu, nu);
            const double exact = aspect > 0.02 ? reference::strip_c11(0, nu, aspect).c11.real()
                                               : solve_steady(Chebyshev{320}, strip).c11();
            CAPTURE(nu, aspect);
            for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-11}) {
                if (aspect < 0.03 && tolerance < 1e-2 && tolerance > 1e-11) continue;
                const auto best = recommended_scheme(tolerance, Purpose::steady, aspect);
                const double error = steady_error(best, strip, exact);
                check_promise(best, tolerance, infinity, error);
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
        for (const double aspect : {10.0, 1e5, infinity}) {
            const auto best = recommended_scheme(1e-11, Purpose::steady, aspect);
            CHECK(steady_error(best, AnyKernel<double>(LineModel::plane, aspect, 1 - nu, nu), steady_c11(nu)) < 1e-14);
        }
    }
}

TEST_CASE("States recommended for the frequency response stay below their error bound", "[recommendation]") {
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {10.0, 30.0, 1e5}) {
            const AnyKernel<double> plane(LineModel::plane, aspect, 1 - nu, nu);
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
        for (const double aspect : {0.05, 0.3, 1.0, 10.0, 30.0}) {
            if (aspect < 0.1 && nu > 0) continue;  // narrow strips take long
            const AnyKernel<double> strip(LineModel::strip, aspect, 1 - nu, nu);
            std::vector<Complex> exact;
            for (const double z : frequencies) {
                exact.push_back(
                    solve_response<double>(rolling_system(Chebyshev{aspect < 0.1 ? 220 : 120}, strip), {0, z}).c11());
            }
            CAPTURE(nu, aspect);
            CHECK(std::abs(reference::strip_c11({0, 5}, nu, aspect).c11 / exact.back() - 1.0) < 1e-12);
            for (const double tolerance : {0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-11}) {
                const auto best = recommended_scheme(tolerance, Purpose::frequency, aspect);
                check_promise(best, tolerance, 1e4, harmonic_error(best, strip, exact));
            }
        }
    }
}

TEST_CASE("States recommended for a time loop stay below their error bound", "[recommendation]") {
    for (const double nu : {0.0, 0.5}) {
        for (const double aspect : {10.0, 30.0, 1e5}) {
            const std::vector<double> exact = plane_steps(aspect, nu, 0.05, 200);
            CAPTURE(nu, aspect);
            for (const double tolerance : {0.5, 0.1, 1e-2, 3e-3, 1e-3, 7e-4, 1e-4, 1e-5, 1e-6, 1.4e-7}) {
                if (tolerance < 1e-6 && (aspect > 10 || nu > 0)) continue;  // errors are largest there
                const auto best = recommended_scheme(tolerance, Purpose::time_loop);
                const RollingSystem<double> system =
                    rolling_system(best.scheme, AnyKernel<double>(LineModel::plane, aspect, 1 - nu, nu));
                check_promise(best, tolerance, 30, step_error(aspect, nu, system, 0.05, exact));
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
            const RollingSystem<double> system =
                rolling_system(best.scheme, AnyKernel<double>(LineModel::strip, aspect, 1 - nu, nu));
            check_promise(best, tolerance, 50, step_error(aspect, nu, system, 1, exact));
        }
    }
}

// --- friction

constexpr double peak = 1e-3, full = peak * std::numbers::pi / 2;  // mu p_0 and mu N/(2b), in units of G and a

// |F|/(mu N) in steady rolling at creepage ratios.
std::vector<double> exact_friction(const Scene& scene, const std::vector<double>& ratios) {
    const Contact contact = Contact::dimensionless(scene.aspect, scene.nu);
    std::vector<double> exact;
    for (const double ratio : ratios) {
        const double creepage = 2 * (1 - scene.nu) * peak * ratio;
        exact.push_back(scene.is_strip() ? -studies::solve_stick_border(contact, scene.kernel(), 1.0,
                                                                        HertzLine::Pressure{peak}, creepage)
                                                   .force_per_width /
                                               full
                                         : carter_force_ratio(ratio));
    }
    return exact;
}
std::vector<double> friction_by_elements(const Scene& scene, const std::vector<double>& ratios,
                                         const Mesh<double>& mesh, const AnyScheme& scheme) {
    const Contact contact = Contact::dimensionless(scene.aspect, scene.nu);
    const FrictionModel model(contact, steady_system(mesh, scheme, scene.kernel()),
                              {1, peak * mean_hertz_pressure(mesh)});
    FrictionState now = model.at_rest(), next = now;
    FrictionModel::Workspace workspace = model.workspace();
    std::vector<double> found;
    for (const double ratio : ratios) {
        const FrictionStep point =
            model.steady(now, {.motion = Creepage{2 * (1 - scene.nu) * peak * ratio}}, next, workspace);
        found.push_back(point.status == Status::ok ? -point.force.longitudinal / (contact.width() * full) : infinity);
        std::swap(now, next);
    }
    return found;
}

TEST_CASE("Elements recommended for friction stay below their error bound", "[recommendation]") {
    std::vector<double> ratios;  // dense where the error is largest
    for (double ratio = 0.05; ratio < 1.1; ratio += ratio < 0.1 ? 0.0005 : 0.005) ratios.push_back(ratio);
    for (const Scene& scene : scenes(1000)) {
        const bool strip = scene.is_strip(), worst = strip && scene.aspect == 10 && scene.nu == 0;
        if (!strip && scene.aspect == 10) continue;  // the slope of the plane kernel does not depend on b
        const std::vector<double> exact = exact_friction(scene, ratios);
        CAPTURE(scene.nu, scene.aspect, strip);
        for (const double tolerance : {0.5, 0.1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 3.3e-6}) {
            if (tolerance < 1e-4 && !worst) continue;
            const auto best = recommended_scheme(tolerance, Purpose::friction);
            const std::vector<double> found = friction_by_elements(scene, ratios, best.mesh(best.n), best.scheme);
            double largest = 0;
            for (std::size_t i = 0; i < ratios.size(); ++i) {
                largest = std::max(largest, std::abs(found[i] / exact[i] - 1));
            }
            check_promise(best, tolerance, tolerance > 0.09 ? 1e3 : 2.5, largest);
        }
    }
}

}  // namespace
}  // namespace promise_tests
