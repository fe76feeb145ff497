// Chebyshev states at extreme parameter values: few and many, narrow and wide strips, slow and fast.
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/closed_form/plane_lambda.hpp>
#include <rollbem/compiled/frequency.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/step_response.hpp>
#include <rollbem/reference/strip.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "in_time.hpp"
#include "support/strip_instances.hpp"

namespace extremes {

namespace {

using Complex = std::complex<double>;
using rollbem::Chebyshev;
using rollbem::Contact;
using rollbem::PlaneKernel;
using rollbem::StripKernel;

std::string counted(Eigen::Index states) { return std::to_string(states) + (states == 1 ? " state" : " states"); }

/// Steady c11 in any scalar.
template <class Kernel>
Outcome steady(Eigen::Index states, const Kernel& kernel, double reference, double bound) {
    const auto solution = solve_steady(Chebyshev{states}, kernel);
    return compare(solution, static_cast<double>(solution.c11()), reference, bound);
}

/// Against the spectral solution of the strip, which has another quadrature and other unknowns. The default bound is
/// the solution's own estimate.
template <class Kernel>
Outcome against_strip(Eigen::Index states, const Kernel& kernel, double aspect, double nu, double bound = 0) {
    const rollbem::EstimatedC11<double> reference = rollbem::reference::strip_c11(0, nu, aspect);
    Outcome outcome = steady(states, kernel, reference.c11.real(), bound);
    if (bound == 0) outcome.bound = static_cast<double>(solve_steady(Chebyshev{states}, kernel).error_estimate());
    return against_estimate(outcome, reference);
}

void add_steady(Cases& cases, bool large) {
    for (const double nu : {0.0, steel, 0.5}) {
        for (const Eigen::Index states : {1, 2, 200, 1500}) {
            if (states == 1500 && nu != steel) continue;
            cases.right(counted(states) + ", nu = " + shown(nu), "c11 against Carter",
                        [=] { return steady(states, plane(infinity, nu), rollbem::steady_c11(nu), 4 * rounding); });
        }
    }
    // Converged: only rounding is left, more of it in narrower strips. (b/a = 0.001 would take thousands of states.)
    for (const auto& [aspect, states] :
         {std::pair{0.01, 300}, {0.05, 120}, {0.3, 60}, {1.0, 32}, {10.0, 12}, {1e3, 4}, {1e8, 1}, {1e12, 1}}) {
        for (const double nu : {0.0, 0.5}) {
            cases.right(counted(states) + ", strip, b/a = " + shown(aspect) + ", nu = " + shown(nu),
                        "c11 against the spectral solution", [aspect = aspect, states = states, nu] {
                            return against_strip(states, strip(aspect, nu), aspect, nu,
                                                 2e-15 + 1e-15 / (aspect * aspect));
                        });
        }
    }
    cases.right("1 state, strip, b/a = 1e+08", "c11 against Carter",
                [] { return steady(1, strip(1e8), rollbem::steady_c11(steel), 4 * rounding); });
    // Not converged: the estimate, which is the bound, covers the error, or the status is not ok.
    for (const auto& [aspect, states] : {std::pair{0.02, 50}, {0.05, 30}, {0.3, 10}, {1.0, 6}, {10.0, 2}, {1e3, 1}}) {
        cases.right(counted(states) + ", strip, b/a = " + shown(aspect) + ", not converged",
                    "c11 against the spectral solution",
                    [aspect = aspect, states = states] { return against_strip(states, strip(aspect), aspect, steel); });
    }
    for (const auto& [aspect, states] : {std::pair{0.02, 6}, {0.3, 2}, {1.0, 1}}) {
        cases.told(counted(states) + ", strip, b/a = " + shown(aspect), "c11", "not_converged",
                   [aspect = aspect, states = states] { return against_strip(states, strip(aspect), aspect, steel); });
    }
    if (large) {
        cases.told("20 states, strip, b/a = 0.001", "c11", "not_converged",
                   [] { return steady(20, strip(0.001), 1, 0); });
    }
    cases.right("12 states, plane, float", "c11 against Carter", [] {
        const PlaneKernel<float> kernel(std::numeric_limits<float>::infinity(), 0.72F, 0.28F);
        return steady(12, kernel, rollbem::steady_c11(steel), 4 * double(std::numeric_limits<float>::epsilon()));
    });
    cases.right("32 states, strip, b/a = 1, float", "c11 against the spectral solution", [] {
        return against_strip(32, StripKernel<float>(1, 0.72F, 0.28F), 1, steel,
                             16 * double(std::numeric_limits<float>::epsilon()));
    });
}

Outcome harmonic(Eigen::Index states, const auto& kernel, double z, Complex reference, double bound) {
    const auto solution = rollbem::solve_response<double>(rolling_system(Chebyshev{states}, kernel), {0, z});
    return compare(solution, solution.c11(), reference, bound);
}

void add_frequencies(Cases& cases, bool large) {
    // Geometric once there are more than about 1.4 z states. With fewer, the error in units of the steady c11 falls
    // like 0.024/m^2; at frequencies far above, the relative error is 1/z, as the contact is a rigid shift, for which
    // one state suffices.
    const auto against_bessel = [](Eigen::Index states, double z, double nu) {
        return [=] {
            const Complex reference = rollbem::reference::plane_c11({0, z}, nu, 1000);
            const double m = static_cast<double>(states), steady = rollbem::steady_c11(nu);
            const double bound = m >= 1.4 * z + 10 || z < 1e-9 ? 40 * rounding + (states == 1 ? z : 0)
                                 : z < 20 * m                  ? 0.03 / (m * m) * steady / std::abs(reference)
                                                               : 1 / z;
            return harmonic(states, plane(1000, nu), z, reference, bound);
        };
    };
    const auto add = [&](Eigen::Index states, double z, double nu) {
        cases.right("z = " + shown(z) + ", " + counted(states) + ", nu = " + shown(nu),
                    "|c11| against Bessel functions", against_bessel(states, z, nu));
    };
    for (const double z : {1e-12, 1e-3, 1.0, 10.0, 50.0, 1e3}) add(200, z, steel);
    for (const double nu : {0.0, 0.5}) add(40, 5, nu);
    for (const Eigen::Index states : {1, 2, 12}) {
        for (const double z : {1e-12, 1e3, 1e6}) add(states, z, steel);
    }
    for (const Eigen::Index states : {6, 12, 48}) add(states, static_cast<double>(states), steel);
    if (large) {
        add(1500, 1, steel);
        add(1500, 1e3, steel);
    }
    for (const auto& [aspect, states] : {std::pair{0.05, 120}, {1.0, 32}, {1e3, 20}, {1e8, 20}, {1e12, 20}}) {
        for (const double z : {1.0, 5.0}) {
            cases.right("z = " + shown(z) + ", " + counted(states) + ", strip, b/a = " + shown(aspect),
                        "|c11| against the spectral solution", [aspect = aspect, states = states, z] {
                            const auto reference = rollbem::reference::strip_c11({0, z}, steel, aspect);
                            return against_estimate(
                                harmonic(states, strip(aspect), z, reference.c11, aspect < 1 ? 2e-12 : 4e-14),
                                reference);
                        });
        }
    }
}

/// Force per width after `count` steps of dq at unit creepage, exact in the time domain, from rest.
Outcome rolled(Eigen::Index states, const Contact<double>& contact, double dq, int count, double reference,
               double bound) {
    const auto system = rolling_system(Chebyshev{states}, PlaneKernel<double>::longitudinal(contact));
    const rollbem::AdhesionModel<> model(contact, system, rollbem::unchecked, rollbem::Integrator::matrix_exponential);
    return compare(roll(model, dq, count), reference, bound);
}

void add_time(Cases& cases) {
    for (const double aspect : {1.0, 1e3, 1e12}) {
        const std::string where = ", b/a = " + shown(aspect);
        const Contact<double> contact = Contact<double>::dimensionless(aspect, steel);
        for (const Eigen::Index states : {1, 12, 48}) {
            // Far above 1/|nu_max|: the steady force.
            cases.right("dq = 1e+06, " + counted(states) + where, "force against steady rolling",
                        [=] { return rolled(states, contact, 1e6, 2, -rollbem::steady_c11(steel), 1e-12); });
            // Far below: a rigid shift, K_00 a_0 = -dq. Relative to it the slope is of order dq |nu_max|, about
            // m^2 dq/10.
            const double stiffness = std::numbers::pi / (2 * ((1 - steel) * std::log(4 * aspect) + steel));
            const double m = static_cast<double>(states);
            cases.right("dq = 1e-09, " + counted(states) + where, "force against a rigid shift",
                        [=] { return rolled(states, contact, 1e-9, 1, -1e-9 * stiffness, (1 + m * m / 5) * 1e-9); });
        }
    }
    const Contact<double> wide = Contact<double>::dimensionless(1e3, steel);
    for (const auto& [states, bound] : {std::pair{1, 0.05}, {12, 1e-6}, {48, 1e-9}}) {
        cases.right("q = 5, " + counted(states), "force against the exact step response",
                    [wide, states = states, bound = bound] {
                        const rollbem::reference::StepResponse exact(steel, 1000);
                        return rolled(states, wide, 0.5, 10, -exact.step(5), bound);
                    });
    }
    // one state has the eigenvalue -1/Lambda; rounding errors scale with the largest eigenvalue, which grows like m^2
    for (const Eigen::Index states : {1, 6, 40, 160}) {
        const double m = static_cast<double>(states), bound = (states == 1 ? 16 : 2 * m * m) * rounding;
        cases.right(counted(states) + ", b/a = 100", "spectral abscissa against the exact eigenvalue", [=] {
            const double reference = states == 1 ? -1 / rollbem::plane_lambda(steel, 100.0)
                                                 : rollbem::reference::eigenvalues(1, steel, 100)[0].real();
            return slowest_mode(rolling_system(Chebyshev{states}, plane(100)), reference, bound);
        });
    }
}

void add_refused_states(Cases& cases) {
    const auto at = [](Eigen::Index states, const auto& kernel) {
        return [=] { return harmonic(states, kernel, 1, 1, 0); };
    };
    cases.told("0 states", "|c11|", "Chebyshev: states = 0 must be at least 1", at(0, plane(1000)));
    cases.told("10001 states", "|c11|", "must be at most 10000", at(10001, plane(1000)));
    cases.told("12 states, b/a = 0.0009", "|c11|", "use elements for so narrow a strip", at(12, strip(0.0009)));
    cases.told("12 states, b/a = inf", "|c11|", "an infinite half-width is for steady problems only",
               at(12, plane(infinity)));
    cases.told("12 states, b/a = 0.1, plane", "|c11|", "the plane model itself is unstable", at(12, plane(0.1)));
}

}  // namespace

void chebyshev_cases(Cases& cases, bool large) {
    add_steady(cases, large);
    add_frequencies(cases, large);
    add_time(cases);
    add_refused_states(cases);
}

}  // namespace extremes
