// Full adhesion at extreme parameter values, by elements and by Chebyshev states: steady rolling, frequency response,
// rolling in the time domain.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/adhesion/transient.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/closed_form/detail/plane_lambda.hpp>
#include <rollbem/detail/in_place_lu.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/spectral/polynomial.hpp>
#include <rollbem/steady/steady.hpp>

#include "cases.hpp"
#include "support/runs.hpp"
#include "support/scenes.hpp"
#include "support/strip_instances.hpp"

namespace extremes {

namespace {

using Complex = std::complex<double>;
using rollbem::Integrator;
using rollbem::LineModel;
using study::Scene;

const std::string on_cosine = "cosine:collocation:0.5/0.5", on_uniform = "uniform:collocation:0.5/0.5";

/// A scheme with n elements or states on a line of unit modulus and half-length.
Scene scene(const std::string& scheme, Eigen::Index n, double aspect = infinity, double nu = steel,
            LineModel model = LineModel::strip) {
    return study::make_scene(study::scheme_named(scheme), n, rollbem::Contact::dimensionless(aspect, nu), model);
}
Scene states(Eigen::Index n, double aspect, double nu = steel, LineModel model = LineModel::strip) {
    return scene("chebyshev", n, aspect, nu, model);
}
std::string counted(Eigen::Index states) { return std::to_string(states) + (states == 1 ? " state" : " states"); }

rollbem::ElementSystem<double> system_of(const Scene& s) { return rolling_system(*s.mesh, s.scheme, s.kernel); }

// --- c11 in steady rolling, z = 0, or at the frequency z = omega a/V

/// The reference of a case: the closed form of the plane, which strips of finite width do not have; the spectral
/// solution of the strip, which has another quadrature and other unknowns than Chebyshev states; 640 elements, for
/// strips too narrow for that; or the same elements in long double, which show the rounding error: the condition says
/// how large that may be.
enum class Against { exact, spectral, elements, long_double };

/// The coefficient of elements in long double. Real numbers and rollbem's own LU solve (G' - i z G) p = 1, as they
/// compile in a third of the time.
Complex in_long_double(const Scene& s, double z) {
    using Real = long double;
    const auto mesh = rollbem::make_mesh<Real>(s.topology(), s.n(), s.grading.value_or(1));
    const auto kernel = rollbem::AnyKernel<Real>::longitudinal(s.kernel.model(), s.contact);
    const auto& scheme = *s.scheme.get_if<rollbem::Collocation>();
    rollbem::MatrixX<Real> A = rollbem::assemble_G_prime(mesh, scheme, kernel);
    const Eigen::Index n = mesh.size(), size = z == 0 ? n : 2 * n;
    if (z != 0) {
        const rollbem::MatrixX<Real> G_prime = A, zG = z * rollbem::assemble_G(mesh, scheme, kernel);
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

rollbem::EstimatedC11<double> reference(const Scene& s, double z, Against against) {
    const double nu = s.contact.poisson_ratio(), aspect = s.contact.aspect();
    if (against == Against::spectral) return rollbem::reference::strip_c11({0, z}, nu, aspect);
    rollbem::EstimatedC11<double> result;
    result.error_estimate = 0;
    if (against == Against::long_double) {
        result.c11 = in_long_double(s, z);
    } else if (against == Against::elements) {
        const Scene fine = scene(on_cosine, 640, aspect, nu, s.kernel.model());
        result.c11 = solve_response(system_of(fine), Complex(0, z)).c11();
    } else if (s.is_plane() || std::isinf(aspect)) {
        result.c11 = z == 0 ? rollbem::steady_c11(nu) : rollbem::reference::plane_c11({0, z}, nu, aspect);
    } else {
        throw std::logic_error("a strip of finite width has no closed form");
    }
    return result;
}

/// The comparison at z by the equations at z alone, or by a sweep, which reduces the equations of elements to
/// Hessenberg form first.
Outcome compared(const Scene& s, double z, Against against, double bound, bool by_sweep) {
    const auto exact = reference(s, z, against);
    const double per_condition = against != Against::long_double ? 0 : z == 0 ? 4 : 16;
    const auto outcome = [&](const auto& response, const auto& known) {
        return against_estimate(compare(response, response.c11(), known, bound, per_condition), exact);
    };
    if (s.chebyshev && z == 0) return outcome(solve_steady(*s.chebyshev, s.kernel), exact.c11.real());
    if (z == 0) return outcome(rollbem::solve_steady(*s.mesh, s.scheme, s.kernel), exact.c11.real());
    if (by_sweep) return outcome(rollbem::FrequencySweep(system_of(s))(z), exact.c11);
    const auto system = s.chebyshev ? rollbem::RollingSystem<double>(rolling_system(*s.chebyshev, s.kernel))
                                    : rollbem::RollingSystem<double>(system_of(s));
    return outcome(rollbem::solve_response<double>(system, {0, z}), exact.c11);
}

/// The cases of c11. Those that must be told say so.
struct Coefficients {
    Cases& cases;

    void add(const std::string& name, const Scene& s, double z, Against against, double bound,
             const std::string& says = "", bool by_sweep = false) {
        const std::string other = against == Against::spectral      ? "the spectral solution"
                                  : against == Against::elements    ? "640 elements"
                                  : against == Against::long_double ? "long double"
                                  : z == 0                          ? "Carter"
                                                                    : "Bessel functions";
        cases.add(
            name, (z == 0 ? "c11" : "|c11|") + (says.empty() ? " against " + other : ""),
            [=] { return compared(s, z, against, bound, by_sweep); }, says);
    }
    void exact(const std::string& name, const Scene& s, double bound) { add(name, s, 0, Against::exact, bound); }
    void rounded(const std::string& name, const Scene& s) { add(name, s, 0, Against::long_double, 0); }
    void spectral(const std::string& name, const Scene& s, double z, double bound, bool by_sweep = false) {
        add(name, s, z, Against::spectral, bound, "", by_sweep);
    }
};

void add_steady(Cases& cases, bool large) {
    Coefficients c11{cases};
    for (const int n : {2, 3}) c11.rounded("n = " + std::to_string(n), scene(on_uniform, n));
    // first order 0.1507/n on the uniform mesh; second order on the cosine mesh, from 0.31/n^2 down to 0.168/n^2
    for (const int n : {2, 3, 1000, 4000}) {
        if (n > 1000 && !large) continue;
        const std::string name = "n = " + std::to_string(n);
        c11.exact(name + ", uniform", scene(on_uniform, n), 0.16 / n);
        c11.exact(name + ", cosine", scene(on_cosine, n), (n < 10 ? 0.32 : 0.18) / n / n);
    }
    if (large) c11.rounded("n = 1000, cosine", scene(on_cosine, 1000));
    for (const double nu : {0.0, 0.5}) {
        c11.exact("nu = " + shown(nu), scene(on_cosine, 40, infinity, nu), 1.1e-4);
        c11.rounded("nu = " + shown(nu) + ", b/a = 1", scene(on_cosine, 40, 1, nu));
    }
    // The strip, narrow to wide. The error is the cosine mesh's until the elements in the middle, 3.1/n wide, no
    // longer resolve the width b.
    for (const double aspect : {0.01, 0.1, 1.0, 10.0, 1e3, 1e6, 1e12}) {
        const std::string name = "b/a = " + shown(aspect);
        c11.rounded(name, scene(on_cosine, 80, aspect));
        if (aspect < 0.1 && !large) continue;  // the spectral solution takes a second
        c11.spectral(name, scene(on_cosine, 80, aspect), 0, 3e-5 + 4e-5 / aspect / std::max(1.0, 1e-2 / aspect));
    }
    c11.exact("b/a = inf", scene(on_cosine, 80), 3e-5);
    // errors of graded meshes are of first order in the largest element, and larger if that is at the leading edge
    const auto graded = [&](const std::string& name, const std::string& mesh, double factor) {
        const Scene s = scene(mesh + ":collocation:0.5/0.5", 40);
        c11.exact(name, s, factor * s.mesh->widths().maxCoeff());
        c11.rounded(name, s);
    };
    for (const double ratio : {1e-6, 1e-3, 1e3, 1e6}) {
        const std::string name = "size ratio " + shown(ratio), mesh = "geometric-" + shown(ratio);
        graded(name, mesh, ratio < 1 ? 0.16 : 0.09);
        c11.rounded(name + ", b/a = 0.1", scene(mesh + ":collocation:0.5/0.5", 40, 0.1));
    }
    for (const std::string mesh : {"knothe", "modified-knothe"}) {
        for (const double epsilon : {1e-8, 1e-4, 10.0}) {
            graded(mesh + ", epsilon = " + shown(epsilon), mesh + "-" + shown(epsilon), epsilon < 1 ? 0.08 : 0.09);
        }
    }
    c11.exact("alpha = 1", scene("uniform:collocation:1/1", 40), 1.2e-2);
    // exactly on the edge of an element the analytic derivative moves its points
    const Scene analytic = scene(on_uniform + ":analytic", 40);
    c11.exact("alpha = 0.5, analytic derivative", analytic, 0.12);  // falls like ln(n)/n
    c11.rounded("alpha = 0.5, analytic derivative", analytic);
    c11.add("alpha = 0, n = 41", scene("uniform:collocation:0/0", 41), 0, Against::exact, 0, "ill_conditioned");
}

void add_frequencies(Cases& cases) {
    Coefficients c11{cases};
    const Scene wide = scene(on_cosine, 80, 1000, steel, LineModel::plane);
    const Scene paper = scene("uniform:collocation:0/0.63", 200, 1000, steel, LineModel::plane);
    for (const double z : {1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
        const std::string name = "z = " + shown(z);
        c11.add(name + ", cosine, n = 80", wide, z, Against::exact, z == 1e3 ? 1e-4 : 3e-5, "", true);
        cases.add(name + ", polynomials", "|c11| against Bessel functions", [=] {
            const auto result = rollbem::polynomial_c11(Complex(0, z), steel, 1000.0);
            return compare(result.c11, rollbem::reference::plane_c11({0, z}, steel, 1000),
                           result.error_estimate + 4 * rounding);
        });
        // G is nearly singular here, and the equations tend to it at frequencies that the mesh does not resolve: the
        // rounding errors of both routes stay within what the condition allows
        for (const bool by_sweep : {true, false}) {
            c11.add(name + ", uniform 0/0.63, n = 200, " + (by_sweep ? "Hessenberg" : "LU"), paper, z,
                    Against::long_double, 0, "", by_sweep);
        }
    }
    for (const double aspect : {0.05, 1.0, 1e3, 1e12}) {
        c11.spectral("z = 1, strip, b/a = " + shown(aspect), scene(on_cosine, 80, aspect), 1, 1.5e-5 + 4e-5 / aspect,
                     true);
    }
    c11.add("z = 1, alpha = 1.5, n = 40", scene("uniform:collocation:1.5/1.5", 40, 1000, steel, LineModel::plane), 1,
            Against::exact, 0, "assists_creepage", true);
}

/// Cases of the number of growing modes by two methods; the scheme has some where alpha_T is large.
void add_eigenvalues(Cases& cases) {
    for (const double aspect : {0.05, 1.0, 1e3, 1e12}) {
        for (const std::string alpha_T : {"0.63", "1"}) {
            cases.add("alpha_T = " + alpha_T + ", n = 60, b/a = " + shown(aspect),
                      "1 + unstable modes, counted, against QZ", [=] {
                          const auto system = system_of(scene("uniform:collocation:0/" + alpha_T, 60, aspect));
                          const auto all = rollbem::solve_stability(system);
                          const auto count = rollbem::count_unstable(system);
                          return compare(1.0 + double(count.unstable_count), 1.0 + double(all.unstable_count), rounding,
                                         told_by(std::max(all.status, count.status)));
                      });
        }
    }
}

// --- the time domain

/// A model of the scheme cosine 0.5/0.5 with the strip kernel, judged by its eigenvalues.
rollbem::AdhesionModel<> stable_model(const rollbem::Contact& contact, Integrator integrator) {
    const rollbem::ElementSystem<double> system = system_of(scene(on_cosine, 40, contact.aspect()));
    return {contact, system, rollbem::judge_stability(system), integrator};
}
rollbem::AdhesionModel<> stable_model(double aspect, Integrator integrator) {
    return stable_model(rollbem::Contact::dimensionless(aspect, steel), integrator);
}

void add_steps(Cases& cases) {
    for (const auto& [integrator, left] : {std::pair{Integrator::implicit_euler, 1.2},
                                           {Integrator::sdirk2, 5.0},
                                           {Integrator::matrix_exponential, 0.0}}) {
        for (const double aspect : {0.05, 1.0, 1e3, 1e12}) {
            const std::string where = ", " + study::word(integrator) + ", b/a = " + shown(aspect);
            // Steps far above 1/|nu_max| give the steady force. The initial state decays by Lambda a/dq in each step
            // of implicit Euler, by 5 Lambda a/dq with sdirk2, and at once with the exponential.
            const double lambda = std::max(rollbem::plane_lambda(steel, aspect), 1.0);
            for (const double dq : {1e3, 1e6}) {
                const double bound = std::pow(left * lambda / dq, 4) + 1e-12;
                cases.add("dq = " + shown(dq) + where, "force against steady rolling", [=, integrator = integrator] {
                    const auto model = stable_model(aspect, integrator);
                    const double steady = model.force(model.steady(1.0)) / (2 * aspect);
                    return rolled(model, dq, 4, steady, bound);
                });
            }
            // Steps far below start from dp/dq = -G^-1 xi at rest. Its relative change is of order dq |nu_max|, 6e-7.
            cases.add("dq = 1e-09" + where, "force against -G^-1 xi dq", [=, integrator = integrator] {
                const auto system = system_of(scene(on_cosine, 40, aspect));
                const Eigen::VectorXd slope = system.G().partialPivLu().solve(system.inputs().col(0));
                const double reference = -1e-9 * system.weights().matrix().dot(slope);
                return rolled(stable_model(aspect, integrator), 1e-9, 1, reference, 2e-6);
            });
        }
    }
    cases.add("dq = 1, exponential, b/a = 1000", "force against the exact step response", [] {
        const rollbem::reference::StepResponse exact(steel, 1000);
        const auto model = stable_model(1000, Integrator::matrix_exponential);
        return rolled(model, 1, 5, -exact.step(5), 5e-5);
    });
    // a wheel of a = 0.1 mm in steps of 10 microseconds
    for (const double speed : {0.01, 1.0, 150.0}) {
        cases.add("a = 1e-4 m, G = 8e10 Pa, V = " + shown(speed) + " m/s", "force against dimensionless", [=] {
            const rollbem::Contact si(
                {.half_length = 1e-4, .half_width = 1e-3, .shear_modulus = 8e10, .poisson_ratio = steel});
            const double dq = speed * 1e-5;
            const Outcome unit = rolled(stable_model(10, Integrator::sdirk2), dq / 1e-4, 20, 1, 1);
            return rolled(stable_model(si, Integrator::sdirk2), dq, 20, unit.value * 1e-4 * 8e10, 1e-11);
        });
    }
}

// --- Chebyshev states: few and many, narrow and wide strips, slow and fast

void add_strips_of_states(Cases& cases, bool large) {
    Coefficients c11{cases};
    // Converged: only rounding is left, more of it in narrower strips. (b/a = 0.001 would take thousands of states.)
    for (const auto& [aspect, m] :
         {std::pair{0.01, 300}, {0.05, 120}, {0.3, 60}, {1.0, 32}, {10.0, 12}, {1e3, 4}, {1e8, 1}, {1e12, 1}}) {
        if (aspect < 0.05 && !large) continue;  // the spectral solution takes a second
        for (const double nu : {0.0, 0.5}) {
            c11.spectral(counted(m) + ", strip, b/a = " + shown(aspect) + ", nu = " + shown(nu), states(m, aspect, nu),
                         0, 2e-15 + 1e-15 / (aspect * aspect));
        }
    }
    for (const auto& [aspect, m] : {std::pair{0.05, 120}, {1.0, 32}, {1e3, 20}, {1e8, 20}, {1e12, 20}}) {
        for (const double z : {1.0, 5.0}) {
            c11.spectral("z = " + shown(z) + ", " + counted(m) + ", strip, b/a = " + shown(aspect), states(m, aspect),
                         z, aspect < 1 ? 2e-12 : 4e-14);
        }
    }
}

void add_frequencies_of_states(Cases& cases, bool large) {
    Coefficients c11{cases};
    // Convergence is geometric once there are more than about 1.4 z states. With fewer, the error in units of the
    // steady c11 falls like 0.024/m^2; at frequencies far above, the relative error is 1/z, as the contact is a rigid
    // shift, for which one state suffices.
    const auto add = [&](Eigen::Index n, double z, double nu = steel) {
        const double m = static_cast<double>(n), steady = rollbem::steady_c11(nu);
        const double bound = m >= 1.4 * z + 10 || z < 1e-9 ? 40 * rounding + (n == 1 ? z : 0)
                             : z < 20 * m
                                 ? 0.03 / (m * m) * steady / std::abs(rollbem::reference::plane_c11({0, z}, nu, 1000))
                                 : 1 / z;
        c11.add("z = " + shown(z) + ", " + counted(n) + ", nu = " + shown(nu), states(n, 1000, nu, LineModel::plane), z,
                Against::exact, bound);
    };
    for (const double z : {1e-12, 1e-3, 1.0, 10.0, 50.0, 1e3}) add(200, z);
    for (const double nu : {0.0, 0.5}) add(40, 5, nu);
    for (const Eigen::Index n : {1, 2, 12}) {
        for (const double z : {1e-12, 1e3, 1e6}) add(n, z);
    }
    for (const Eigen::Index n : {6, 12, 48}) add(n, static_cast<double>(n));
    if (!large) return;
    for (const double z : {1.0, 1e3}) add(1500, z);
    c11.exact("1500 states, nu = 0.28", states(1500, infinity, steel, LineModel::plane), 4 * rounding);
    c11.add("20 states, strip, b/a = 0.001", states(20, 0.001), 0, Against::elements, 0, "not_converged");
}

void add_steps_of_states(Cases& cases) {
    for (const double aspect : {1.0, 1e3, 1e12}) {
        for (const Eigen::Index n : {1, 12, 48}) {
            const std::string where = ", " + counted(n) + ", b/a = " + shown(aspect);
            const auto roll = [=](double dq, int count, double reference, double bound) {
                const Scene s = states(n, aspect, steel, LineModel::plane);
                const rollbem::AdhesionModel<> model(s.contact, rolling_system(*s.chebyshev, s.kernel),
                                                     rollbem::unchecked, Integrator::matrix_exponential);
                return rolled(model, dq, count, reference, bound);
            };
            // Steps far above 1/|nu_max| give the steady force.
            cases.add("dq = 1e+06" + where, "force against steady rolling",
                      [=] { return roll(1e6, 2, -rollbem::steady_c11(steel), 1e-12); });
            // Steps far below are a rigid shift, K_00 a_0 = -dq. Relative to it the slope is of order dq |nu_max|,
            // about m^2 dq/10.
            const double stiffness = pi / (2 * ((1 - steel) * std::log(4 * aspect) + steel));
            const double m = static_cast<double>(n);
            cases.add("dq = 1e-09" + where, "force against a rigid shift",
                      [=] { return roll(1e-9, 1, -1e-9 * stiffness, (1 + m * m / 5) * 1e-9); });
        }
    }
}

}  // namespace

void adhesion_cases(Cases& cases, bool large) {
    add_steady(cases, large);
    add_frequencies(cases);
    add_eigenvalues(cases);
    add_steps(cases);
    add_strips_of_states(cases, large);
    add_frequencies_of_states(cases, large);
    add_steps_of_states(cases);
}

}  // namespace extremes
