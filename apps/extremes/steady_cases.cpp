// Steady rolling at the edges of its domain.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/reference/strip.hpp>

#include "cases.hpp"
#include "long_double.hpp"
#include "support/strip_instances.hpp"

namespace extremes {

namespace {

using rollbem::Collocation;
using rollbem::Topology;

struct Problem {
    rollbem::MeshSpecification mesh;
    Collocation scheme = equal;
    double aspect = infinity;
    double poisson_ratio = steel;
};

rollbem::Response<double> solve(const Problem& p) {
    const rollbem::Mesh<double> mesh = rollbem::make_mesh(p.mesh);
    if (std::isinf(p.aspect)) return rollbem::solve_steady(mesh, p.scheme, plane(p.aspect, p.poisson_ratio));
    return rollbem::solve_steady(mesh, p.scheme, strip(p.aspect, p.poisson_ratio));
}

double largest_width(const Problem& p) { return rollbem::make_mesh(p.mesh).widths().maxCoeff(); }

Outcome against(const Problem& p, double reference, double bound) {
    const rollbem::Response<double> solution = solve(p);
    return compare(solution, solution.c11(), reference, bound);
}

/// The discretisation's error against the exact solution of the model.
Case exact(const std::string& name, const Problem& p, double bound) {
    return {name, "c11 against Carter", [=] { return against(p, rollbem::steady_c11(p.poisson_ratio), bound); }};
}

/// The rounding error, against the same discretisation in long double. The condition says how large it may be.
Case rounded(const std::string& name, const Problem& p) {
    return {name, "c11 against long double", [=] {
                const double reference = static_cast<double>(steady_c11(p.mesh, p.scheme, p.aspect, p.poisson_ratio));
                Outcome outcome = against(p, reference, 0);
                outcome.bound = 4 * rounding * outcome.condition;
                return outcome;
            }};
}

Case told(const std::string& name, const Problem& p, const std::string& says) {
    return {name, "c11", [=] { return against(p, rollbem::steady_c11(p.poisson_ratio), 0); }, says};
}

void add_sizes(Cases& cases, bool large) {
    // One element at alpha = 0.5 and 1: G' is a second difference of x ln|x|.
    const double carter = rollbem::steady_c11(steel);
    cases.right("n = 1, alpha = 0.5", "c11 against 2 pi/(3 (1-nu) ln 3)", [=] {
        return against({{Topology::uniform, 1}}, carter * 4 / (3 * std::log(3.0)), 8 * rounding);
    });
    cases.right("n = 1, alpha = 1", "c11 against pi/(2 (1-nu) ln 2)", [=] {
        return against({{Topology::uniform, 1}, {1, 1}}, carter / std::numbers::ln2, 8 * rounding);
    });
    for (const int n : {2, 3}) cases.push_back(rounded("n = " + std::to_string(n), {{Topology::uniform, n}}));
    // first order 0.1507/n on the uniform mesh; second order on the cosine mesh, from 0.31/n^2 down to 0.168/n^2
    for (const int n : {2, 3, 1000}) {
        cases.push_back(exact("n = " + std::to_string(n) + ", uniform", {{Topology::uniform, n}}, 0.16 / n));
        cases.push_back(
            exact("n = " + std::to_string(n) + ", cosine", {{Topology::cosine, n}}, (n < 10 ? 0.32 : 0.18) / n / n));
    }
    if (!large) return;
    cases.push_back(rounded("n = 1000, cosine", {{Topology::cosine, 1000}}));
    cases.push_back(exact("n = 4000, uniform", {{Topology::uniform, 4000}}, 0.16 / 4000));
    cases.push_back(exact("n = 4000, cosine", {{Topology::cosine, 4000}}, 0.18 / 4000 / 4000));
}

void add_contacts(Cases& cases) {
    for (const double nu : {0.0, 0.5}) {
        cases.push_back(exact("nu = " + shown(nu), {{Topology::cosine, 40}, equal, infinity, nu}, 1.1e-4));
        cases.push_back(rounded("nu = " + shown(nu) + ", b/a = 1", {{Topology::cosine, 40}, equal, 1, nu}));
    }
    // The strip, narrow to wide, against the spectral solution of the same model. The error is that of the cosine mesh
    // until the elements in the middle, 3.1/n wide, no longer resolve the width b.
    for (const double aspect : {0.01, 0.1, 1.0, 10.0, 1e3, 1e6, 1e12}) {
        const Problem p{{Topology::cosine, 80}, equal, aspect};
        cases.right("b/a = " + shown(aspect), "c11 against the spectral solution", [=] {
            const rollbem::EstimatedC11<double> reference = rollbem::reference::strip_c11(0, steel, aspect);
            const double bound = 3e-5 + 4e-5 / aspect / std::max(1.0, 1e-2 / aspect);
            return against_estimate(against(p, reference.c11.real(), bound), reference);
        });
        cases.push_back(rounded("b/a = " + shown(aspect), p));
    }
    cases.push_back(exact("b/a = inf", {{Topology::cosine, 80}}, 3e-5));
}

void add_meshes(Cases& cases) {
    for (const double ratio : {1e-6, 1e-3, 1e3, 1e6}) {
        // of first order in the largest element, and larger if that is at the leading edge
        const Problem p{{Topology::geometric, 40, ratio}};
        cases.push_back(exact("size ratio " + shown(ratio), p, (ratio < 1 ? 0.16 : 0.09) * largest_width(p)));
        cases.push_back(rounded("size ratio " + shown(ratio), p));
        cases.push_back(rounded("size ratio " + shown(ratio) + ", b/a = 0.1", {p.mesh, equal, 0.1}));
    }
    for (const Topology topology : {Topology::knothe, Topology::modified_knothe}) {
        for (const double epsilon : {1e-8, 1e-4, 10.0}) {
            const std::string name = std::string(rollbem::name(topology)) + ", epsilon = " + shown(epsilon);
            const Problem p{{topology, 40, epsilon}};
            cases.push_back(exact(name, p, (epsilon < 1 ? 0.08 : 0.09) * largest_width(p)));
            cases.push_back(rounded(name, p));
        }
    }
}

void add_schemes(Cases& cases) {
    const auto at = [](Eigen::Index n, double alpha) { return Problem{{Topology::uniform, n}, {alpha, alpha}}; };
    // On a uniform mesh G' of alpha = 0 is antisymmetric: singular for odd n, without force for even n.
    cases.push_back(told("alpha = 0, n = 1", at(1, 0), "not_finite"));
    for (const int n : {3, 41}) {
        cases.push_back(told("alpha = 0, n = " + std::to_string(n), at(n, 0), "ill_conditioned"));
    }
    for (const int n : {2, 40}) {
        cases.push_back(told("alpha = 0, n = " + std::to_string(n), at(n, 0), "assists_creepage"));
    }
    cases.push_back(exact("alpha = 0.5", at(40, 0.5), 3.8e-3));
    cases.push_back(exact("alpha = 1", at(40, 1), 1.2e-2));
    for (const double alpha : {-0.5, 1.5, 2.0}) {
        for (const int n : {40, 41}) {
            cases.push_back(
                told("alpha = " + shown(alpha) + ", n = " + std::to_string(n), at(n, alpha), "assists_creepage"));
        }
    }
    // exactly on the edge of an element the analytic derivative moves its points
    Problem analytic = at(40, 0.5);
    analytic.scheme.derivative = rollbem::Derivative::analytic;
    cases.push_back(exact("alpha = 0.5, analytic derivative", analytic, 0.12));  // falls like ln(n)/n
    cases.push_back(rounded("alpha = 0.5, analytic derivative", analytic));
    cases.told("alpha = 2.5", "c11", "must lie in [-2, 2]", [=] { return against(at(40, 2.5), 1, 0); });
}

void add_units(Cases& cases) {
    const rollbem::Contact<double> wheel(
        {.half_length = 1e-4, .half_width = 1e-3, .shear_modulus = 8e10, .poisson_ratio = steel});
    for (const double creepage : {1e-12, -1e-3, 1e6}) {
        cases.right("a = 1e-4 m, G = 8e10 Pa, xi = " + shown(creepage), "force per width against dimensionless", [=] {
            const rollbem::Mesh<double> mesh = rollbem::cosine_mesh(40);
            const auto unit = rollbem::Contact<double>::dimensionless(10, steel);
            const auto steady = [&](const rollbem::Contact<double>& contact) {
                return rollbem::solve_steady(mesh, equal, rollbem::StripKernel<double>::longitudinal(contact));
            };
            const auto si = steady(wheel);
            const double reference = creep_force(unit, steady(unit), 1) / unit.width() * 1e-4 * 8e10 * creepage;
            return compare(si, creep_force(wheel, si, creepage) / wheel.width(), reference, 100 * rounding);
        });
    }
}

}  // namespace

void steady_cases(Cases& cases, bool large) {
    add_sizes(cases, large);
    add_contacts(cases);
    add_meshes(cases);
    add_schemes(cases);
    add_units(cases);
}

}  // namespace extremes
