// Contact patches in steady rolling at extreme parameter values.
#include <string>
#include <utility>

#include <rollbem/compiled/patch.hpp>
#include <rollbem/compiled/steady.hpp>

#include "cases.hpp"

namespace extremes {

namespace {

using Eigen::Index;
using rollbem::ArrayX;
using rollbem::PatchContact;

/// c11 (i = 0) or c22 (i = 1) against a reference. That of a long patch can be used if other meshes confirm it,
/// whatever becomes of the others.
Outcome coefficient(const PatchContact<double>& contact, Index n, Index m, Index i, double reference, double bound) {
    const auto response = rollbem::solve_steady(contact, rollbem::patch_mesh(contact, n, m), chebyshev);
    const auto c = creep_coefficients(contact, response);
    Outcome outcome = compare(response, i == 0 ? c.c11 : c.c22, reference, bound);
    const Eigen::MatrixXd& changes = response.error_estimates;
    const bool confirmed = changes.size() == 0 || changes(i, i) <= rollbem::largest_mesh_change;
    if (response.status == rollbem::Status::not_converged && confirmed) outcome.told.clear();
    return outcome;
}

/// c11 and c22 of an infinitely slender ellipse, a/b -> inf, to terms of order 1/ln(a/b)^2 (Kalker 1990, appendix E).
std::pair<double, double> slender(double a_over_b, double nu) {
    const double log = std::log(16 * a_over_b * a_over_b), rest = 3 - std::log(4.0);
    const double x = log - 2 * nu, y = (1 - nu) * log + 2 * nu;
    return {2 * pi * a_over_b / x * (1 + rest / x), 2 * pi * a_over_b / y * (1 + (1 - nu) * rest / y)};
}

void add_ellipses(Cases& cases) {
    for (const double nu : {0.0, steel, 0.5}) {
        const auto add = [&](const char* kind, double a_over_b, Index n, Index m, const char* limit,
                             std::pair<double, double> references, double bound, const std::string& says_c11 = "",
                             const std::string& says_c22 = "") {
            for (const Index i : {0, 1}) {
                const double reference = i == 0 ? references.first : references.second;
                cases.push_back({kind + (" a/b = " + shown(a_over_b)) + ", nu = " + shown(nu),
                                 (i == 0 ? "c11 against " : "c22 against ") + std::string(limit),
                                 [=] {
                                     const auto contact = PatchContact<double>::dimensionless(a_over_b, nu);
                                     return coefficient(contact, n, m, i, reference, bound);
                                 },
                                 i == 0 ? says_c11 : says_c22});
            }
        };
        for (const auto& [a_over_b, bound] : {std::pair{0.02, 5e-3}, {1e-3, 4e-3}, {1e-6, 4e-3}}) {
            add("patch", a_over_b, 20, 20, "a/b -> 0", {pi * pi / 4 / (1 - nu), pi * pi / 4}, bound);
        }
        add("patch", 50, 24, 12, "a/b -> inf", slender(50, nu), 2e-2);
        // c33 tends to 0 and comes out negative on so few elements
        const std::string negative = nu == 0.5 ? "status assists_creepage" : "";
        add("needle", 1e3, 24, 12, "a/b -> inf", slender(1e3, nu), 3e-2, negative,
            nu == steel ? "status not_converged" : negative);
    }
    // n and m apart, against the limit of small elements
    for (const auto& [n, m] : {std::pair{24, 8}, {8, 24}, {30, 15}}) {
        cases.push_back({"patch a/b = 1, nu = 0.25, " + std::to_string(n) + " x " + std::to_string(m),
                         "c11 against its limit", [n = n, m = m] {
                             return coefficient(PatchContact<double>::dimensionless(1, 0.25), n, m, 0, 4.111, 8e-3);
                         }});
    }
    cases.push_back({"patch a/b = 9.99989e-321", "c11",
                     [] { return coefficient(PatchContact<double>::dimensionless(1e-320, steel), 4, 4, 0, 1, 0); },
                     "must be positive and finite"});
}

/// Rolling the other way leaves the force per creepage as it is (reciprocity): corners ahead, behind and beside.
void add_outlines(Cases& cases) {
    using Edges = std::vector<double>;
    const auto reversed = [&](const std::string& name, const Edges& y, const Edges& trailing, const Edges& leading,
                              double bound) {
        cases.push_back(
            {name, "c11 against the same rolling backwards", [=] {
                 const auto array = [](const Edges& from) {
                     return ArrayX<double>(Eigen::Map<const ArrayX<double>>(from.data(), Index(from.size())));
                 };
                 const auto outlined = [&](const ArrayX<double>& behind, const ArrayX<double>& ahead) {
                     return PatchContact<double>(rollbem::Outline<double>(array(y), behind, ahead), 1, steel);
                 };
                 const Outcome other = coefficient(outlined(-array(leading), -array(trailing)), 16, 16, 0, 1, 0);
                 return coefficient(outlined(array(trailing), array(leading)), 16, 16, 0, other.value, bound);
             }});
    };
    reversed("outline with a corner ahead", {-1, 0, 1}, {-1, -1, -1}, {-1, 1, -1}, 5e-4);
    reversed("outline with an end of finite length", {-1, 1}, {-1, -0.2}, {0.6, 0.3}, 1e-4);
    reversed("outline with a notch", {-1, -0.1, 0, 0.1, 1}, {-1, -1, 0.5, -1, -1}, {1, 1, 1, 1, 1}, 1e-4);
}

}  // namespace

void patch_cases(Cases& cases) {
    add_ellipses(cases);
    add_outlines(cases);
}

}  // namespace extremes
