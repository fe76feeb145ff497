// Frequency response at the edges of its domain.
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include <rollbem/compiled/frequency.hpp>
#include <rollbem/compiled/polynomial.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/strip.hpp>

#include "cases.hpp"
#include "long_double.hpp"
#include "support/strip_instances.hpp"

namespace extremes {

namespace {

using Complex = std::complex<double>;
using rollbem::Collocation;
using rollbem::Topology;

constexpr Collocation paper_scheme{.alpha_L = 0, .alpha_T = 0.63};

rollbem::PlaneKernel<double> plane(double aspect) { return {aspect, 1 - steel, steel}; }
rollbem::StripKernel<double> strip(double aspect) { return {aspect, 1 - steel, steel}; }

Outcome compare(Complex value, Complex reference, double bound) {
    return {.value = std::abs(value),
            .reference = std::abs(reference),
            .error = std::abs(value / reference - 1.0),
            .bound = bound};
}

Outcome from_sweep(const rollbem::FrequencySweep<double>& sweep, double z, Complex reference, double bound) {
    const rollbem::SweepPoint<double> point = sweep(z);
    Outcome outcome = compare(point.c11, reference, bound);
    outcome.residual = point.residual;
    outcome.condition = 1 / point.rcond;
    outcome.told = told_by(point.status);
    return outcome;
}

void add_frequencies(std::vector<Case>& cases) {
    for (const double z : {1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
        const std::string name = "z = " + shown(z);
        const Complex s(0, z);
        cases.push_back({name + ", cosine, n = 80", "|c11| against Bessel functions", [=] {
                             const rollbem::FrequencySweep<double> sweep(
                                 rollbem::rolling_system(rollbem::cosine_mesh(80), equal, plane(1000)));
                             return from_sweep(sweep, z, rollbem::reference::plane_c11(s, steel, 1000),
                                               z == 1e3 ? 1e-4 : 3e-5);
                         }});
        cases.push_back({name + ", polynomials", "|c11| against Bessel functions", [=] {
                             const rollbem::EstimatedC11<double> result = rollbem::polynomial_c11(s, steel, 1000.0);
                             const Complex reference = rollbem::reference::plane_c11(s, steel, 1000);
                             return compare(result.c11, reference, result.error_estimate + 4 * rounding);
                         }});
        // G is nearly singular here, and the equations tend to it at frequencies that the mesh does not resolve: the
        // rounding errors of both routes stay within what the condition allows
        cases.push_back(
            {name + ", uniform 0/0.63, n = 200, Hessenberg", "|c11| against long double", [=] {
                 const rollbem::FrequencySweep<double> sweep(
                     rollbem::rolling_system(rollbem::uniform_mesh(200), paper_scheme, plane(1000)));
                 const Complex reference(harmonic_c11({Topology::uniform, 200}, paper_scheme, 1000, steel, z));
                 Outcome outcome = from_sweep(sweep, z, reference, 0);
                 outcome.bound = 16 * rounding * outcome.condition;
                 return outcome;
             }});
        cases.push_back(
            {name + ", uniform 0/0.63, n = 200, LU", "|c11| against long double", [=] {
                 const auto full = rollbem::solve_harmonic<double>(
                     rollbem::rolling_system(rollbem::uniform_mesh(200), paper_scheme, plane(1000)), z);
                 const Complex reference(harmonic_c11({Topology::uniform, 200}, paper_scheme, 1000, steel, z));
                 Outcome outcome = compare(full.c11, reference, 16 * rounding / full.rcond);
                 outcome.residual = full.residual;
                 outcome.condition = 1 / full.rcond;
                 outcome.told = told_by(full.status);
                 return outcome;
             }});
    }
    for (const double aspect : {0.05, 1.0, 1e3, 1e12}) {
        cases.push_back({"z = 1, strip, b/a = " + shown(aspect), "|c11| against the spectral solution", [=] {
                             const rollbem::FrequencySweep<double> sweep(
                                 rollbem::rolling_system(rollbem::cosine_mesh(80), equal, strip(aspect)));
                             const auto reference = rollbem::reference::strip_c11({0, 1}, steel, aspect);
                             Outcome outcome = from_sweep(sweep, 1, reference.c11, 0);
                             outcome.bound = 1.5e-5 + 4e-5 / aspect;
                             if (!(reference.error_estimate < 1e-11)) outcome.told = "the reference has not converged";
                             return outcome;
                         }});
    }
}

void add_refusals(std::vector<Case>& cases) {
    const auto sweep_at = [](Eigen::Index n, double alpha, double z) {
        return [=] {
            const rollbem::FrequencySweep<double> sweep(
                rollbem::rolling_system(rollbem::uniform_mesh(n), Collocation{alpha, alpha}, plane(1000)));
            return from_sweep(sweep, z, rollbem::reference::plane_c11({0, z}, steel, 1000), 0);
        };
    };
    for (const int n : {40, 41}) {
        for (const double alpha : {0.0, 1.5}) {
            cases.push_back({"z = 1, alpha = " + shown(alpha) + ", n = " + std::to_string(n), "|c11|",
                             sweep_at(n, alpha, 1), "inconsistent"});
        }
    }
    cases.push_back({"z = nan", "|c11|",
                     [] {
                         const rollbem::FrequencySweep<double> sweep(
                             rollbem::rolling_system(rollbem::cosine_mesh(40), equal, plane(1000)));
                         return from_sweep(sweep, nothing, 1, 0);
                     },
                     "FrequencySweep: omega a/V = nan must be finite"});
    cases.push_back({"z = 1, b/a = 0.1, plane", "|c11|",
                     [] {
                         const rollbem::FrequencySweep<double> sweep(
                             rollbem::rolling_system(rollbem::cosine_mesh(40), equal, plane(0.1)));
                         return from_sweep(sweep, 1, 1, 0);
                     },
                     "the plane model itself is unstable"});
    cases.push_back({"z = 1, b/a = inf", "|c11|",
                     [] {
                         const rollbem::FrequencySweep<double> sweep(
                             rollbem::rolling_system(rollbem::cosine_mesh(40), equal, plane(infinity)));
                         return from_sweep(sweep, 1, 1, 0);
                     },
                     "infinite aspect is for steady problems only"});
    cases.push_back({"z = 10, Chebyshev, order 5", "|c11|",
                     [] {
                         const auto result = rollbem::polynomial_c11<double>({0, 10}, steel, 1000, 5);
                         Outcome outcome = compare(result.c11, rollbem::reference::plane_c11({0, 10}, steel, 1000), 0);
                         if (result.status != rollbem::Status::ok) outcome.told = advice(result.status);
                         return outcome;
                     },
                     "changes with the order"});
    cases.push_back({"z = 50, monomials, order 60", "|c11|",
                     [] {
                         const auto result = rollbem::solve_monomial<double>({0, 50}, steel, 1000, 60);
                         Outcome outcome = compare(result.c11, rollbem::reference::plane_c11({0, 50}, steel, 1000), 0);
                         outcome.condition = result.condition;
                         if (result.status != rollbem::Status::ok) outcome.told = advice(result.status);
                         return outcome;
                     },
                     "use the Chebyshev basis"});
}

}  // namespace

std::vector<Case> harmonic_cases() {
    std::vector<Case> cases;
    add_frequencies(cases);
    add_refusals(cases);
    return cases;
}

}  // namespace extremes
