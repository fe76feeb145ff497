// Stability and rolling in the time domain at extreme parameter values.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include <rollbem/closed_form/plane_lambda.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/step_response.hpp>

#include "in_time.hpp"
#include "support/non_steady.hpp"

namespace extremes {

namespace {

using rollbem::Collocation;
using rollbem::Integrator;

/// cosine 0.5/0.5, strip kernel: stable by its eigenvalues.
rollbem::AdhesionModel<> stable_model(const rollbem::Contact<double>& contact, Integrator integrator) {
    const rollbem::Mesh<double> mesh = rollbem::cosine_mesh(40);
    const auto kernel = rollbem::StripKernel<double>::longitudinal(contact);
    const rollbem::ElementSystem<double> system = rollbem::rolling_system(mesh, equal, kernel);
    return {contact, system, rollbem::judge_stability<double>(system), integrator};
}

void add_steps(Cases& cases) {
    for (const Integrator integrator :
         {Integrator::implicit_euler, Integrator::sdirk2, Integrator::matrix_exponential}) {
        for (const double aspect : {0.05, 1.0, 1e3, 1e12}) {
            const std::string where = ", " + study::word(integrator) + ", b/a = " + shown(aspect);
            // Far above 1/|nu_max|: the steady force. The initial state decays by Lambda a/dq in each step of
            // implicit Euler, by five times that with sdirk2, and at once with the exponential.
            const double lambda = std::max(rollbem::plane_lambda(steel, aspect), 1.0);
            const double left = integrator == Integrator::implicit_euler       ? 1.2
                                : integrator == Integrator::matrix_exponential ? 0
                                                                               : 5;
            for (const double dq : {1e3, 1e6}) {
                const double bound = std::pow(left * lambda / dq, 4) + 1e-12;
                cases.right("dq = " + shown(dq) + where, "force against steady rolling", [=] {
                    const auto model = stable_model(contact(aspect), integrator);
                    const double steady = model.force(model.steady(1.0)) / (2 * aspect);
                    return compare(roll(model, dq, 4), steady, bound);
                });
            }
            // Far below: dp/dq = -G^-1 xi at rest. Relative to it the change of slope is of order dq |nu_max|, 6e-7.
            cases.right("dq = 1e-09" + where, "force against -G^-1 xi dq", [=] {
                const auto model = stable_model(contact(aspect), integrator);
                const rollbem::Mesh<double> mesh = rollbem::cosine_mesh(40);
                const rollbem::MatrixX<double> G =
                    rollbem::assemble_G(mesh, equal, rollbem::StripKernel<double>::longitudinal(contact(aspect)));
                const Eigen::VectorXd slope =
                    Eigen::PartialPivLU<rollbem::MatrixX<double>>(G).solve(Eigen::VectorXd::Ones(40));
                const double reference = -1e-9 * mesh.widths().matrix().dot(slope);
                return compare(roll(model, 1e-9, 1), reference, 2e-6);
            });
        }
    }
    cases.right("dq = 1, exponential, b/a = 1000", "force against the exact step response", [] {
        const rollbem::reference::StepResponse exact(steel, 1000);
        return compare(roll(stable_model(contact(1000), Integrator::matrix_exponential), 1, 5), -exact.step(5), 5e-5);
    });
}

void add_unit_steps(Cases& cases) {
    // a wheel of a = 0.1 mm in steps of 10 microseconds
    for (const double speed : {0.01, 1.0, 150.0}) {
        cases.right("a = 1e-4 m, G = 8e10 Pa, V = " + shown(speed) + " m/s", "force against dimensionless", [=] {
            const rollbem::Contact<double> si(
                {.half_length = 1e-4, .half_width = 1e-3, .shear_modulus = 8e10, .poisson_ratio = steel});
            const double dq = speed * 1e-5;
            const Outcome unit = roll(stable_model(contact(10), Integrator::sdirk2), dq / 1e-4, 20);
            return compare(roll(stable_model(si, Integrator::sdirk2), dq, 20), unit.value * 1e-4 * 8e10, 1e-11);
        });
    }
}

void add_spectra(Cases& cases) {
    // one element has the eigenvalue G'/G, both in closed form; with more it tends to the exact one, with second order
    const double lambda = rollbem::plane_lambda(steel, 100.0);
    const double one = -3 * std::log(3.0) / (4 * (lambda + 1 - 2 * std::numbers::ln2));
    const double first = rollbem::reference::eigenvalues(1, steel, 100)[0].real();
    for (const int n : {1, 3, 40, 160}) {
        const double reference = n == 1 ? one : first, bound = n == 1 ? 16 * rounding : 0.2 / n / n;
        const std::string quantity = n == 1 ? "eigenvalue against -3 ln 3/(4 (Lambda + 1 - 2 ln 2))"
                                            : "spectral abscissa against the exact eigenvalue";
        cases.right("n = " + std::to_string(n) + ", cosine, b/a = 100", quantity, [=] {
            return slowest_mode(rollbem::rolling_system(rollbem::cosine_mesh(n), equal, plane(100)), reference, bound);
        });
    }
}

void add_refused_steps(Cases& cases) {
    const auto build = [](Eigen::Index n, Collocation scheme, double aspect) {
        return [=] {
            const rollbem::Mesh<double> mesh = rollbem::uniform_mesh(n);
            const auto kernel = rollbem::StripKernel<double>::longitudinal(contact(aspect));
            const rollbem::ElementSystem<double> system = rollbem::rolling_system(mesh, scheme, kernel);
            const rollbem::AdhesionModel<> model(contact(aspect), system, rollbem::judge_stability<double>(system));
            return roll(model, 1, 1);
        };
    };
    cases.told("time, alpha = 0, n = 40", "force", "must be 0: a mode of the scheme grows", build(40, {0, 0}, 1000));
    cases.told("time, alpha = 0, n = 41", "force", "must be 0: a mode of the scheme grows", build(41, {0, 0}, 1000));
    cases.told("time, alpha = 1", "force", "must be 0: a mode of the scheme grows", build(40, {1, 1}, 1000));
    cases.told("time, alpha = 1.5", "force", "does not converge to full adhesion", build(40, {1.5, 1.5}, 1000));
    cases.told("time, 0/0.63, n = 160", "force", "must be 0: a mode of the scheme grows", build(160, {0, 0.63}, 1000));
    cases.told("time, b/a = inf", "force", "infinite aspect is for steady problems only", build(40, equal, infinity));
    for (const double dq : {-1.0, infinity, nothing}) {
        cases.told("dq = " + shown(dq), "force", "invalid_step",
                   [=] { return roll(stable_model(contact(1000), Integrator::sdirk2), dq, 1); });
    }
}

}  // namespace

void time_cases(Cases& cases) {
    add_steps(cases);
    add_unit_steps(cases);
    add_spectra(cases);
    add_refused_steps(cases);
}

}  // namespace extremes
