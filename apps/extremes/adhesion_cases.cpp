// Elements in full adhesion at extreme parameter values: steady rolling, frequency response, rolling in the time
// domain.
#include <algorithm>
#include <string>
#include <vector>

#include <Eigen/LU>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/closed_form/plane_lambda.hpp>
#include <rollbem/compiled/adhesion.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/detail/in_place_lu.hpp>
#include <rollbem/elasticity/any_kernel.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/step_response.hpp>
#include <rollbem/spectral/polynomial.hpp>

#include "cases.hpp"
#include "support/runs.hpp"
#include "support/strip_instances.hpp"

namespace extremes {

namespace {

using Complex = std::complex<double>;
using rollbem::Collocation;
using rollbem::Integrator;
using rollbem::LineModel;
using rollbem::Topology;

/// A mesh in any scalar.
struct MeshOf {
    Topology topology = Topology::uniform;
    Eigen::Index n = 1;
    double grading = 1;

    template <class Real = double>
    rollbem::Mesh<Real> in() const {
        return rollbem::make_mesh<Real>(topology, n, grading);
    }
};

/// Elements on a line of unit modulus and half-length, in any scalar.
struct Problem {
    MeshOf mesh;
    Collocation scheme = equal;
    double aspect = infinity, nu = steel;
    LineModel model = LineModel::strip;

    template <class Real = double>
    rollbem::AnyKernel<Real> kernel() const {
        return rollbem::AnyKernel<Real>::longitudinal(model, rollbem::Contact<Real>::dimensionless(aspect, nu));
    }
    rollbem::Response<double> steady() const { return rollbem::solve_steady(mesh.in(), scheme, kernel()); }
    rollbem::ElementSystem<double> system() const { return rollbem::rolling_system(mesh.in(), scheme, kernel()); }
    double largest_width() const { return mesh.in().widths().maxCoeff(); }
};

// --- steady rolling

/// The discretisation's error against the exact solution of the model.
Case exact(const std::string& name, const Problem& p, double bound) {
    return {name, "c11 against Carter", [=] {
                const auto solution = p.steady();
                return compare(solution, solution.c11(), rollbem::steady_c11(p.nu), bound);
            }};
}

/// c11 of the same discretisation in long double, (G' - i z G) p = 1 by real numbers and with rollbem's own LU, which
/// compile in a third of the time.
Complex in_long_double(const Problem& p, double z) {
    using Real = long double;
    const auto mesh = p.mesh.in<Real>();
    const auto kernel = p.kernel<Real>();
    rollbem::MatrixX<Real> A = rollbem::assemble_G_prime(mesh, p.scheme, kernel);
    const Eigen::Index n = mesh.size(), size = z == 0 ? n : 2 * n;
    if (z != 0) {
        const rollbem::MatrixX<Real> G_prime = A, zG = z * rollbem::assemble_G(mesh, p.scheme, kernel);
        A.resize(size, size);
        A << G_prime, zG, -zG, G_prime;
    }
    rollbem::VectorX<Real> solved = rollbem::VectorX<Real>::Zero(2 * n);
    solved.head(n).setOnes();
    std::vector<Eigen::Index> swaps(static_cast<std::size_t>(size));
    rollbem::detail::factorise_in_place<Real>(A, swaps.data());
    rollbem::detail::solve_in_place<Real>(A, swaps.data(), solved.head(size));
    const rollbem::VectorX<Real> widths = mesh.widths();
    return {static_cast<double>(-widths.dot(solved.head(n))), static_cast<double>(-widths.dot(solved.tail(n)))};
}

/// The rounding error, against the same discretisation in long double. The condition says how large it may be.
Case rounded(const std::string& name, const Problem& p) {
    return {name, "c11 against long double", [=] {
                const auto solution = p.steady();
                return compare(solution, solution.c11(), in_long_double(p, 0).real(), 0, 4);
            }};
}

void add_steady(Cases& cases, bool large) {
    for (const int n : {2, 3}) cases.push_back(rounded("n = " + std::to_string(n), {{Topology::uniform, n}}));
    // first order 0.1507/n on the uniform mesh; second order on the cosine mesh, from 0.31/n^2 down to 0.168/n^2
    for (const int n : {2, 3, 1000, 4000}) {
        if (n > 1000 && !large) continue;
        const std::string name = "n = " + std::to_string(n);
        cases.push_back(exact(name + ", uniform", {{Topology::uniform, n}}, 0.16 / n));
        cases.push_back(exact(name + ", cosine", {{Topology::cosine, n}}, (n < 10 ? 0.32 : 0.18) / n / n));
    }
    if (large) cases.push_back(rounded("n = 1000, cosine", {{Topology::cosine, 1000}}));
    for (const double nu : {0.0, 0.5}) {
        cases.push_back(exact("nu = " + shown(nu), {{Topology::cosine, 40}, equal, infinity, nu}, 1.1e-4));
        cases.push_back(rounded("nu = " + shown(nu) + ", b/a = 1", {{Topology::cosine, 40}, equal, 1, nu}));
    }
    // The strip, narrow to wide, against the spectral solution of the same model. The error is that of the cosine mesh
    // until the elements in the middle, 3.1/n wide, no longer resolve the width b.
    for (const double aspect : {0.01, 0.1, 1.0, 10.0, 1e3, 1e6, 1e12}) {
        const Problem p{{Topology::cosine, 80}, equal, aspect};
        cases.push_back(rounded("b/a = " + shown(aspect), p));
        if (aspect < 0.1 && !large) continue;  // the spectral solution takes a second
        cases.push_back({"b/a = " + shown(aspect), "c11 against the spectral solution", [=] {
                             const auto reference = rollbem::reference::strip_c11(0, steel, aspect);
                             const double bound = 3e-5 + 4e-5 / aspect / std::max(1.0, 1e-2 / aspect);
                             const auto solution = p.steady();
                             return against_estimate(compare(solution, solution.c11(), reference.c11.real(), bound),
                                                     reference);
                         }});
    }
    cases.push_back(exact("b/a = inf", {{Topology::cosine, 80}}, 3e-5));
    // graded meshes: of first order in the largest element, and larger if that is at the leading edge
    const auto graded = [&](const std::string& name, Topology topology, double grading, double factor) {
        const Problem p{{topology, 40, grading}};
        cases.push_back(exact(name, p, factor * p.largest_width()));
        cases.push_back(rounded(name, p));
    };
    for (const double ratio : {1e-6, 1e-3, 1e3, 1e6}) {
        graded("size ratio " + shown(ratio), Topology::geometric, ratio, ratio < 1 ? 0.16 : 0.09);
        cases.push_back(
            rounded("size ratio " + shown(ratio) + ", b/a = 0.1", {{Topology::geometric, 40, ratio}, equal, 0.1}));
    }
    for (const Topology topology : {Topology::knothe, Topology::modified_knothe}) {
        for (const double epsilon : {1e-8, 1e-4, 10.0}) {
            graded(std::string(rollbem::name(topology)) + ", epsilon = " + shown(epsilon), topology, epsilon,
                   epsilon < 1 ? 0.08 : 0.09);
        }
    }
    cases.push_back(exact("alpha = 1", {{Topology::uniform, 40}, {1, 1}}, 1.2e-2));
    // exactly on the edge of an element the analytic derivative moves its points
    const Problem analytic{{Topology::uniform, 40}, {0.5, 0.5, rollbem::Derivative::analytic}};
    cases.push_back(exact("alpha = 0.5, analytic derivative", analytic, 0.12));  // falls like ln(n)/n
    cases.push_back(rounded("alpha = 0.5, analytic derivative", analytic));
    cases.push_back({"alpha = 0, n = 41", "c11",
                     [] {
                         const auto solution = Problem{{Topology::uniform, 41}, {0, 0}}.steady();
                         return compare(solution, solution.c11(), rollbem::steady_c11(steel), 0);
                     },
                     "ill_conditioned"});
}

// --- frequency response

/// c11 by a sweep.
Outcome swept(const Problem& p, double z, Complex reference, double bound, double per_condition = 0) {
    const auto point = rollbem::FrequencySweep<double>(p.system())(z);
    return compare(point, point.c11(), reference, bound, per_condition);
}

void add_frequencies(Cases& cases) {
    const Problem wide{{Topology::cosine, 80}, equal, 1000, steel, LineModel::plane};
    const Problem paper{{Topology::uniform, 200}, {0, 0.63}, 1000, steel, LineModel::plane};
    for (const double z : {1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
        const std::string name = "z = " + shown(z);
        const auto bessel = [=] { return rollbem::reference::plane_c11({0, z}, steel, 1000); };
        cases.push_back({name + ", cosine, n = 80", "|c11| against Bessel functions",
                         [=] { return swept(wide, z, bessel(), z == 1e3 ? 1e-4 : 3e-5); }});
        cases.push_back({name + ", polynomials", "|c11| against Bessel functions", [=] {
                             const auto result = rollbem::polynomial_c11(Complex(0, z), steel, 1000.0);
                             return compare(result.c11, bessel(), result.error_estimate + 4 * rounding);
                         }});
        // G is nearly singular here, and the equations tend to it at frequencies that the mesh does not resolve: the
        // rounding errors of both routes stay within what the condition allows
        cases.push_back({name + ", uniform 0/0.63, n = 200, Hessenberg", "|c11| against long double",
                         [=] { return swept(paper, z, in_long_double(paper, z), 0, 16); }});
        cases.push_back({name + ", uniform 0/0.63, n = 200, LU", "|c11| against long double", [=] {
                             const auto full = rollbem::solve_response<double>(paper.system(), {0, z});
                             return compare(full, full.c11(), in_long_double(paper, z), 0, 16);
                         }});
    }
    for (const double aspect : {0.05, 1.0, 1e3, 1e12}) {
        cases.push_back({"z = 1, strip, b/a = " + shown(aspect), "|c11| against the spectral solution", [=] {
                             const auto reference = rollbem::reference::strip_c11({0, 1}, steel, aspect);
                             const Problem strip{{Topology::cosine, 80}, equal, aspect};
                             return against_estimate(swept(strip, 1, reference.c11, 1.5e-5 + 4e-5 / aspect), reference);
                         }});
    }
    cases.push_back({"z = 1, alpha = 1.5, n = 40", "|c11|",
                     [] {
                         return swept({{Topology::uniform, 40}, {1.5, 1.5}, 1000, steel, LineModel::plane}, 1,
                                      rollbem::reference::plane_c11({0, 1}, steel, 1000), 0);
                     },
                     "assists_creepage"});
}

// --- eigenvalues

/// How many modes grow, by two methods; the scheme has some where alpha_T is large.
void add_eigenvalues(Cases& cases) {
    for (const double aspect : {0.05, 1.0, 1e3, 1e12}) {
        for (const double alpha_T : {0.63, 1.0}) {
            cases.push_back({"alpha_T = " + shown(alpha_T) + ", n = 60, b/a = " + shown(aspect),
                             "1 + unstable modes, counted, against QZ", [=] {
                                 const auto system = Problem{{Topology::uniform, 60}, {0, alpha_T}, aspect}.system();
                                 const auto all = rollbem::solve_stability<double>(system);
                                 const auto count = rollbem::count_unstable<double>(system);
                                 return compare(1.0 + double(count.unstable_count), 1.0 + double(all.unstable_count),
                                                rounding, told_by(std::max(all.status, count.status)));
                             }});
        }
    }
}

// --- the time domain

/// cosine 0.5/0.5, strip kernel: stable by its eigenvalues.
rollbem::AdhesionModel<> stable_model(const rollbem::Contact<double>& contact, Integrator integrator) {
    const rollbem::ElementSystem<double> system = Problem{{Topology::cosine, 40}, equal, contact.aspect()}.system();
    return {contact, system, rollbem::judge_stability<double>(system), integrator};
}
rollbem::AdhesionModel<> stable_model(double aspect, Integrator integrator) {
    return stable_model(rollbem::Contact<double>::dimensionless(aspect, steel), integrator);
}

void add_steps(Cases& cases) {
    for (const auto& [integrator, left] : {std::pair{Integrator::implicit_euler, 1.2},
                                           {Integrator::sdirk2, 5.0},
                                           {Integrator::matrix_exponential, 0.0}}) {
        for (const double aspect : {0.05, 1.0, 1e3, 1e12}) {
            const std::string where = ", " + study::word(integrator) + ", b/a = " + shown(aspect);
            // Far above 1/|nu_max|: the steady force. The initial state decays by Lambda a/dq in each step of
            // implicit Euler, by five times that with sdirk2, and at once with the exponential.
            const double lambda = std::max(rollbem::plane_lambda(steel, aspect), 1.0);
            for (const double dq : {1e3, 1e6}) {
                const double bound = std::pow(left * lambda / dq, 4) + 1e-12;
                cases.push_back(
                    {"dq = " + shown(dq) + where, "force against steady rolling", [=, integrator = integrator] {
                         const auto model = stable_model(aspect, integrator);
                         const double steady = model.force(model.steady(1.0)) / (2 * aspect);
                         return rolled(model, dq, 4, steady, bound);
                     }});
            }
            // Far below: dp/dq = -G^-1 xi at rest. Relative to it the change of slope is of order dq |nu_max|, 6e-7.
            cases.push_back({"dq = 1e-09" + where, "force against -G^-1 xi dq", [=, integrator = integrator] {
                                 const auto system = Problem{{Topology::cosine, 40}, equal, aspect}.system();
                                 const Eigen::VectorXd slope = system.G().partialPivLu().solve(system.inputs().col(0));
                                 const double reference = -1e-9 * system.weights().matrix().dot(slope);
                                 return rolled(stable_model(aspect, integrator), 1e-9, 1, reference, 2e-6);
                             }});
        }
    }
    cases.push_back({"dq = 1, exponential, b/a = 1000", "force against the exact step response", [] {
                         const rollbem::reference::StepResponse exact(steel, 1000);
                         const auto model = stable_model(1000, Integrator::matrix_exponential);
                         return rolled(model, 1, 5, -exact.step(5), 5e-5);
                     }});
    // a wheel of a = 0.1 mm in steps of 10 microseconds
    for (const double speed : {0.01, 1.0, 150.0}) {
        cases.push_back(
            {"a = 1e-4 m, G = 8e10 Pa, V = " + shown(speed) + " m/s", "force against dimensionless", [=] {
                 const rollbem::Contact<double> si(
                     {.half_length = 1e-4, .half_width = 1e-3, .shear_modulus = 8e10, .poisson_ratio = steel});
                 const double dq = speed * 1e-5;
                 const Outcome unit = rolled(stable_model(10, Integrator::sdirk2), dq / 1e-4, 20, 1, 1);
                 return rolled(stable_model(si, Integrator::sdirk2), dq, 20, unit.value * 1e-4 * 8e10, 1e-11);
             }});
    }
}

}  // namespace

void adhesion_cases(Cases& cases, bool large) {
    add_steady(cases, large);
    add_frequencies(cases);
    add_eigenvalues(cases);
    add_steps(cases);
}

}  // namespace extremes
