// Frequency response at the edges of its domain.
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include <rollbem/compiled/frequency.hpp>
#include <rollbem/compiled/monomial.hpp>
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

/// c11 by a sweep.
Outcome swept(const rollbem::Mesh<double>& mesh, const Collocation& scheme, const auto& kernel, double z,
              Complex reference, double bound) {
    const rollbem::FrequencySweep<double> sweep(rollbem::rolling_system(mesh, scheme, kernel));
    const rollbem::Response<Complex> point = sweep(z);
    return compare(point, point.c11(), reference, bound);
}

void add_frequencies(Cases& cases) {
    for (const double z : {1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
        const std::string name = "z = " + shown(z);
        const Complex s(0, z);
        cases.right(name + ", cosine, n = 80", "|c11| against Bessel functions", [=] {
            return swept(rollbem::cosine_mesh(80), equal, plane(1000), z, rollbem::reference::plane_c11(s, steel, 1000),
                         z == 1e3 ? 1e-4 : 3e-5);
        });
        cases.right(name + ", polynomials", "|c11| against Bessel functions", [=] {
            const rollbem::EstimatedC11<double> result = rollbem::polynomial_c11(s, steel, 1000.0);
            const Complex reference = rollbem::reference::plane_c11(s, steel, 1000);
            return compare(result.c11, reference, result.error_estimate + 4 * rounding);
        });
        // G is nearly singular here, and the equations tend to it at frequencies that the mesh does not resolve: the
        // rounding errors of both routes stay within what the condition allows
        cases.right(name + ", uniform 0/0.63, n = 200, Hessenberg", "|c11| against long double", [=] {
            const Complex reference(harmonic_c11({Topology::uniform, 200}, paper_scheme, 1000, steel, z));
            Outcome outcome = swept(rollbem::uniform_mesh(200), paper_scheme, plane(1000), z, reference, 0);
            outcome.bound = 16 * rounding * outcome.condition;
            return outcome;
        });
        cases.right(name + ", uniform 0/0.63, n = 200, LU", "|c11| against long double", [=] {
            const auto full = rollbem::solve_response<double>(
                rollbem::rolling_system(rollbem::uniform_mesh(200), paper_scheme, plane(1000)), {0, z});
            const Complex reference(harmonic_c11({Topology::uniform, 200}, paper_scheme, 1000, steel, z));
            return compare(full, full.c11(), reference, 16 * rounding / full.rcond);
        });
    }
    for (const double aspect : {0.05, 1.0, 1e3, 1e12}) {
        cases.right("z = 1, strip, b/a = " + shown(aspect), "|c11| against the spectral solution", [=] {
            const auto reference = rollbem::reference::strip_c11({0, 1}, steel, aspect);
            return against_estimate(
                swept(rollbem::cosine_mesh(80), equal, strip(aspect), 1, reference.c11, 1.5e-5 + 4e-5 / aspect),
                reference);
        });
    }
}

void add_refused_frequencies(Cases& cases) {
    for (const int n : {40, 41}) {
        for (const double alpha : {0.0, 1.5}) {
            cases.told("z = 1, alpha = " + shown(alpha) + ", n = " + std::to_string(n), "|c11|", "assists_creepage",
                       [=] {
                           return swept(rollbem::uniform_mesh(n), {alpha, alpha}, plane(1000), 1,
                                        rollbem::reference::plane_c11({0, 1}, steel, 1000), 0);
                       });
        }
    }
    const auto refused = [&](const std::string& name, const std::string& says, double aspect, double z) {
        cases.told(name, "|c11|", says, [=] { return swept(rollbem::cosine_mesh(40), equal, plane(aspect), z, 1, 0); });
    };
    refused("z = nan", "FrequencySweep: omega a/V = nan must be finite", 1000, nothing);
    refused("z = 1, b/a = 0.1, plane", "the plane model itself is unstable", 0.1, 1);
    refused("z = 1, b/a = inf", "infinite aspect is for steady problems only", infinity, 1);
    cases.told("z = 10, Chebyshev, order 5", "|c11|", "changes with the order", [] {
        const auto result = rollbem::polynomial_c11<double>({0, 10}, steel, 1000, 5);
        Outcome outcome = compare(result.c11, rollbem::reference::plane_c11({0, 10}, steel, 1000), 0);
        if (result.status != rollbem::Status::ok) outcome.told = advice(result.status);
        return outcome;
    });
    cases.told("z = 50, monomials, order 60", "|c11|", "use the Chebyshev basis", [] {
        const auto result = rollbem::solve_monomial<double>({0, 50}, steel, 1000, 60);
        Outcome outcome = compare(result.c11, rollbem::reference::plane_c11({0, 50}, steel, 1000), 0);
        outcome.condition = result.condition;
        if (result.status != rollbem::Status::ok) outcome.told = advice(result.status);
        return outcome;
    });
}

}  // namespace

void harmonic_cases(Cases& cases) {
    add_frequencies(cases);
    add_refused_frequencies(cases);
}

}  // namespace extremes
