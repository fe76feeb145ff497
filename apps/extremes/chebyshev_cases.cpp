// Chebyshev states at extreme parameter values: few and many, narrow and wide strips, slow and fast.
#include <string>
#include <utility>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/compiled/adhesion.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "cases.hpp"
#include "support/strip_instances.hpp"

namespace extremes {

namespace {

using Complex = std::complex<double>;
using rollbem::Chebyshev;

std::string counted(Eigen::Index states) { return std::to_string(states) + (states == 1 ? " state" : " states"); }

rollbem::PlaneKernel<double> plane(double aspect, double nu = steel) { return {aspect, 1 - nu, nu}; }
rollbem::StripKernel<double> strip(double aspect, double nu = steel) { return {aspect, 1 - nu, nu}; }

Outcome steady(Eigen::Index states, const auto& kernel, double reference, double bound) {
    const auto solution = solve_steady(Chebyshev{states}, kernel);
    return compare(solution, solution.c11(), reference, bound);
}

Outcome harmonic(Eigen::Index states, const auto& kernel, double z, Complex reference, double bound) {
    const auto solution = rollbem::solve_response<double>(rolling_system(Chebyshev{states}, kernel), {0, z});
    return compare(solution, solution.c11(), reference, bound);
}

/// `made`(reference) against the spectral solution of the strip, which has another quadrature and other unknowns.
Case against_strip(const std::string& name, double z, double nu, double aspect, const auto& made) {
    return {name, z == 0 ? "c11 against the spectral solution" : "|c11| against the spectral solution", [=] {
                const auto reference = rollbem::reference::strip_c11({0, z}, nu, aspect);
                return against_estimate(made(reference.c11), reference);
            }};
}

void add_strips(Cases& cases, bool large) {
    // Converged: only rounding is left, more of it in narrower strips. (b/a = 0.001 would take thousands of states.)
    for (const auto& [aspect, states] :
         {std::pair{0.01, 300}, {0.05, 120}, {0.3, 60}, {1.0, 32}, {10.0, 12}, {1e3, 4}, {1e8, 1}, {1e12, 1}}) {
        if (aspect < 0.05 && !large) continue;  // the spectral solution takes a second
        for (const double nu : {0.0, 0.5}) {
            cases.push_back(against_strip(counted(states) + ", strip, b/a = " + shown(aspect) + ", nu = " + shown(nu),
                                          0, nu, aspect, [=, aspect = aspect, states = states](Complex reference) {
                                              return steady(states, strip(aspect, nu), reference.real(),
                                                            2e-15 + 1e-15 / (aspect * aspect));
                                          }));
        }
    }
    for (const auto& [aspect, states] : {std::pair{0.05, 120}, {1.0, 32}, {1e3, 20}, {1e8, 20}, {1e12, 20}}) {
        for (const double z : {1.0, 5.0}) {
            cases.push_back(
                against_strip("z = " + shown(z) + ", " + counted(states) + ", strip, b/a = " + shown(aspect), z, steel,
                              aspect, [=, aspect = aspect, states = states](Complex reference) {
                                  return harmonic(states, strip(aspect), z, reference, aspect < 1 ? 2e-12 : 4e-14);
                              }));
        }
    }
}

void add_frequencies(Cases& cases, bool large) {
    // Geometric once there are more than about 1.4 z states. With fewer, the error in units of the steady c11 falls
    // like 0.024/m^2; at frequencies far above, the relative error is 1/z, as the contact is a rigid shift, for which
    // one state suffices.
    const auto add = [&](Eigen::Index states, double z, double nu = steel) {
        const std::string name = "z = " + shown(z) + ", " + counted(states) + ", nu = " + shown(nu);
        cases.push_back({name, "|c11| against Bessel functions", [=] {
                             const Complex reference = rollbem::reference::plane_c11({0, z}, nu, 1000);
                             const double m = static_cast<double>(states), steady = rollbem::steady_c11(nu);
                             const double bound = m >= 1.4 * z + 10 || z < 1e-9 ? 40 * rounding + (states == 1 ? z : 0)
                                                  : z < 20 * m ? 0.03 / (m * m) * steady / std::abs(reference)
                                                               : 1 / z;
                             return harmonic(states, plane(1000, nu), z, reference, bound);
                         }});
    };
    for (const double z : {1e-12, 1e-3, 1.0, 10.0, 50.0, 1e3}) add(200, z);
    for (const double nu : {0.0, 0.5}) add(40, 5, nu);
    for (const Eigen::Index states : {1, 2, 12}) {
        for (const double z : {1e-12, 1e3, 1e6}) add(states, z);
    }
    for (const Eigen::Index states : {6, 12, 48}) add(states, static_cast<double>(states));
    if (!large) return;
    for (const double z : {1.0, 1e3}) add(1500, z);
    cases.push_back({"1500 states, nu = 0.28", "c11 against Carter",
                     [] { return steady(1500, plane(infinity), rollbem::steady_c11(steel), 4 * rounding); }});
    cases.push_back(
        {"20 states, strip, b/a = 0.001", "c11", [] { return steady(20, strip(0.001), 1, 0); }, "not_converged"});
}

void add_time(Cases& cases) {
    for (const double aspect : {1.0, 1e3, 1e12}) {
        for (const Eigen::Index states : {1, 12, 48}) {
            const std::string where = ", " + counted(states) + ", b/a = " + shown(aspect);
            const auto roll = [=](double dq, int count, double reference, double bound) {
                const rollbem::AdhesionModel<> model(rollbem::Contact<double>::dimensionless(aspect, steel),
                                                     rolling_system(Chebyshev{states}, plane(aspect)),
                                                     rollbem::unchecked, rollbem::Integrator::matrix_exponential);
                return rolled(model, dq, count, reference, bound);
            };
            // Far above 1/|nu_max|: the steady force.
            cases.push_back({"dq = 1e+06" + where, "force against steady rolling",
                             [=] { return roll(1e6, 2, -rollbem::steady_c11(steel), 1e-12); }});
            // Far below: a rigid shift, K_00 a_0 = -dq. Relative to it the slope is of order dq |nu_max|, about
            // m^2 dq/10.
            const double stiffness = pi / (2 * ((1 - steel) * std::log(4 * aspect) + steel));
            const double m = static_cast<double>(states);
            cases.push_back({"dq = 1e-09" + where, "force against a rigid shift",
                             [=] { return roll(1e-9, 1, -1e-9 * stiffness, (1 + m * m / 5) * 1e-9); }});
        }
    }
}

}  // namespace

void chebyshev_cases(Cases& cases, bool large) {
    add_strips(cases, large);
    add_frequencies(cases, large);
    add_time(cases);
}

}  // namespace extremes
