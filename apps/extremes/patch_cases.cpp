// Contact patches in steady rolling at extreme parameter values.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/compiled/patch.hpp>
#include <rollbem/compiled/steady.hpp>

#include "cases.hpp"
#include "friction_scale.hpp"

namespace extremes {

namespace {

using Eigen::Index;
using rollbem::ArrayX;
using rollbem::Outline;
using rollbem::PatchContact;

/// Kalker's coefficients beside the response from which they follow.
struct Solution : rollbem::CreepCoefficients<double> {
    rollbem::Response<double> response;
};

Solution solve(const PatchContact<double>& contact, Index n, Index m) {
    const auto response = rollbem::solve_steady(contact, rollbem::patch_mesh(contact, n, m), chebyshev);
    return {creep_coefficients(contact, response), response};
}

Solution ellipse(double a_over_b, double nu, Index n, Index m) {
    return solve(PatchContact<double>::dimensionless(a_over_b, nu), n, m);
}

/// Lines at y, from trailing to leading.
PatchContact<double> outlined(const std::vector<double>& y, const std::vector<double>& trailing,
                              const std::vector<double>& leading, double nu = steel) {
    const auto array = [](const std::vector<double>& from) {
        return ArrayX<double>(Eigen::Map<const ArrayX<double>>(from.data(), Index(from.size())));
    };
    return {Outline<double>(array(y), array(trailing), array(leading)), 1, nu};
}

/// c11 and c22 of an infinitely slender ellipse, a/b -> inf, to terms of order 1/ln(a/b)^2 (Kalker 1990, appendix E).
std::pair<double, double> slender(double a_over_b, double nu) {
    const double log = std::log(16 * a_over_b * a_over_b), rest = 3 - std::log(4.0);
    const double x = log - 2 * nu, y = (1 - nu) * log + 2 * nu;
    return {2 * pi * a_over_b / x * (1 + rest / x), 2 * pi * a_over_b / y * (1 + (1 - nu) * rest / y)};
}

/// The whole system, without use of the mirrored strips; the bound is the rounding error times the condition.
Case halves(const std::string& name, double a_over_b, Index n, Index m) {
    return {
        name + ", " + std::to_string(n) + " x " + std::to_string(m), "coefficients by halves against the whole", [=] {
            const auto contact = PatchContact<double>::dimensionless(a_over_b, steel);
            const auto mesh = rollbem::patch_mesh(contact, n, m);
            const auto elements = rollbem::patch_elements(mesh, chebyshev);
            const auto whole = rollbem::solve_steady<double>(
                rollbem::detail::joined(rollbem::assemble_G_prime(mesh, chebyshev, rollbem::HalfSpace<double>(steel))),
                rollbem::rigid_slip(elements), rollbem::force_weights(elements));
            const Solution solution = solve(contact, n, m);
            Outcome outcome = compare(solution.response, solution.c11, contact.a_over_b() * whole.coefficients(0, 0),
                                      8 * rounding / whole.rcond);
            outcome.error = (solution.response.coefficients - whole.coefficients).cwiseAbs().maxCoeff() /
                            whole.coefficients.cwiseAbs().maxCoeff();
            outcome.told.clear();  // c33 may be negative on a few elements
            return outcome;
        }};
}

/// c11 (i = 0) or c22 (i = 1) of a long patch can be used if other meshes confirm it, whatever becomes of the others.
Outcome compare_confirmed(const Solution& solution, Index i, double reference, double bound) {
    Outcome outcome = compare(solution.response, i == 0 ? solution.c11 : solution.c22, reference, bound);
    const Eigen::MatrixXd& changes = solution.response.error_estimates;
    const bool confirmed = changes.size() == 0 || changes(i, i) <= rollbem::largest_mesh_change;
    if (solution.response.status == rollbem::Status::not_converged && confirmed) outcome.told.clear();
    return outcome;
}

void add_ellipses(Cases& cases) {
    for (const double nu : {0.0, steel, 0.5}) {
        for (const auto& [a_over_b, bound] : {std::pair{0.02, 5e-3}, {1e-3, 4e-3}, {1e-6, 4e-3}}) {
            const std::string name = "patch a/b = " + shown(a_over_b) + ", nu = " + shown(nu);
            cases.right(name, "c11 against a/b -> 0", [=, bound = bound, a_over_b = a_over_b] {
                const Solution solution = ellipse(a_over_b, nu, 20, 20);
                return compare(solution.response, solution.c11, pi * pi / 4 / (1 - nu), bound);
            });
            cases.right(name, "c22 against a/b -> 0", [=, bound = bound, a_over_b = a_over_b] {
                const Solution solution = ellipse(a_over_b, nu, 20, 20);
                return compare(solution.response, solution.c22, pi * pi / 4, bound);
            });
        }
        for (const auto& [a_over_b, bound] : {std::pair{50.0, 2e-2}, {1e3, 3e-2}}) {
            const std::string name =
                (a_over_b > 50 ? "needle a/b = " : "patch a/b = ") + shown(a_over_b) + ", nu = " + shown(nu);
            // c33 tends to 0 and comes out negative on so few elements
            const std::string says = a_over_b > 50 && nu == 0.5 ? "status assists_creepage" : "",
                              of_c22 = a_over_b > 50 && nu == steel ? "status not_converged" : says;
            cases.told(name, "c11 against a/b -> inf", says, [=, bound = bound, a_over_b = a_over_b] {
                const Solution solution = ellipse(a_over_b, nu, 24, 12);
                return compare_confirmed(solution, 0, slender(a_over_b, nu).first, bound);
            });
            cases.told(name, "c22 against a/b -> inf", of_c22, [=, bound = bound, a_over_b = a_over_b] {
                const Solution solution = ellipse(a_over_b, nu, 24, 12);
                return compare_confirmed(solution, 1, slender(a_over_b, nu).second, bound);
            });
        }
        cases.right("patch a/b = 1, nu = " + shown(nu), "c32 against -c23", [=] {
            const Solution solution = ellipse(1, nu, 16, 16);
            return compare(solution.response, solution.c32, -solution.c23, 8e-3);
        });
    }
    for (const double a_over_b : {0.02, 1.0, 50.0}) {
        const std::string name = "patch a/b = " + shown(a_over_b);
        for (const auto& [n, m] : {std::pair{1, 1}, {1, 8}, {12, 1}, {2, 2}, {9, 5}, {6, 12}, {12, 6}}) {
            cases.push_back(halves(name, a_over_b, n, m));
        }
    }
    // n and m apart, against the limit of small elements
    for (const auto& [n, m] : {std::pair{24, 8}, {8, 24}, {30, 15}}) {
        cases.right("patch a/b = 1, nu = 0.25, " + std::to_string(n) + " x " + std::to_string(m),
                    "c11 against its limit", [n = n, m = m] {
                        const Solution solution = ellipse(1, 0.25, n, m);
                        return compare(solution.response, solution.c11, 4.111, 8e-3);
                    });
    }
}

void add_outlines(Cases& cases) {
    // One strip is the strip of a line contact; G a b c11 of the patch is the force along 2 b.
    for (const double b : {0.1, 1.0, 20.0}) {
        cases.right("rectangle 2 b/(2 a) = " + shown(b) + ", 20 x 1, nu = 0", "c11 against the strip kernel", [=] {
            const auto contact = outlined({-b, b}, {-1, -1}, {1, 1}, 0);
            const Solution solution = solve(contact, 20, 1);
            const auto strip =
                rollbem::solve_steady(rollbem::cosine_mesh(20), chebyshev, rollbem::StripKernel<double>(b, 1, 0));
            const double c = contact.c();
            Outcome outcome = compare(solution.response, solution.c11 * c * c / (2 * b), strip.c11(), 1e-11);
            outcome.told.clear();  // c33 may be negative on one strip
            return outcome;
        });
    }
    // Rolling the other way leaves the force per creepage as it is (reciprocity): corners ahead, behind and beside.
    const auto reversed = [&](const std::string& name, const std::vector<double>& y,
                              const std::vector<double>& trailing, const std::vector<double>& leading, double bound) {
        cases.right(name, "c11 against the same rolling backwards", [=] {
            std::vector<double> ahead = trailing, behind = leading;
            for (double& x : ahead) x = -x;
            for (double& x : behind) x = -x;
            const Solution solution = solve(outlined(y, trailing, leading), 16, 16);
            const Solution other = solve(outlined(y, behind, ahead), 16, 16);
            return compare(solution.response, solution.c11, other.c11, bound);
        });
    };
    reversed("outline with a corner ahead", {-1, 0, 1}, {-1, -1, -1}, {-1, 1, -1}, 5e-4);
    reversed("outline with an end of finite length", {-1, 1}, {-1, -0.2}, {0.6, 0.3}, 1e-4);
    reversed("outline with a notch", {-1, -0.1, 0, 0.1, 1}, {-1, -1, 0.5, -1, -1}, {1, 1, 1, 1, 1}, 1e-4);
    const auto refused = [&](const std::string& name, const std::vector<double>& y, const std::vector<double>& trailing,
                             const std::vector<double>& leading, const std::string& says) {
        cases.told("outline " + name, "c11", says, [=] {
            const Solution solution = solve(outlined(y, trailing, leading), 8, 8);
            return compare(solution.response, solution.c11, 1, 0);
        });
    };
    refused("with a strip of zero length", {-1, 0, 1}, {-1, 0, -1}, {1, 0, 1}, "x_leading - x_trailing of line 2");
    refused("whose edges cross", {-1, 0, 1}, {-1, 1, -1}, {1, 0.5, 1}, "x_leading - x_trailing of line 2");
    refused("with y unsorted", {-1, 1, 0}, {-1, -1, -1}, {1, 1, 1}, "y of line 3");
    refused("of one line", {0}, {-1}, {1}, "number of lines");
    refused("of no area", {0, 1}, {0, 0}, {0, 0}, "area");
    refused("with nan", {-1, 0, 1}, {-1, nothing, -1}, {1, 1, 1}, "x_trailing of line 2");
    for (const double a_over_b : {0.0, nothing, infinity, 1e-320}) {
        cases.told("patch a/b = " + shown(a_over_b), "c11", "must be positive and finite", [=] {
            const Solution solution = ellipse(a_over_b, steel, 4, 4);
            return compare(solution.response, solution.c11, 1, 0);
        });
    }
}

}  // namespace

void patch_cases(Cases& cases) {
    add_ellipses(cases);
    add_outlines(cases);
}

}  // namespace extremes
