// Contact patches in steady rolling at extreme parameter values.
#include <array>
#include <string>
#include <utility>

#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/creep_coefficients.hpp>
#include <rollbem/steady/steady.hpp>

#include "cases.hpp"

namespace extremes {

namespace {

using Eigen::Index;
using rollbem::ArrayX;
using rollbem::PatchContact;

/// One of Kalker's coefficients, forces and moments over creepages and spin.
struct Entry {
    const char* name;
    Index i, j;
    double rollbem::CreepCoefficients<double>::*value;
};
constexpr Entry c11{"c11", 0, 0, &rollbem::CreepCoefficients<double>::c11},
    c22{"c22", 1, 1, &rollbem::CreepCoefficients<double>::c22},
    c23{"c23", 1, 2, &rollbem::CreepCoefficients<double>::c23},
    c32{"c32", 2, 1, &rollbem::CreepCoefficients<double>::c32},
    c33{"c33", 2, 2, &rollbem::CreepCoefficients<double>::c33};

/// The outcome of one coefficient, which can be used if other meshes confirm it, even if they do not confirm the rest.
Outcome coefficient(const PatchContact& contact, Index n, Index m, const Entry& c, double reference, double bound) {
    const auto response = rollbem::solve_steady(contact, rollbem::patch_mesh(contact, n, m), chebyshev);
    Outcome outcome = compare(response, creep_coefficients(contact, response).*c.value, reference, bound);
    if (is_confirmed(response, c.i, c.j)) outcome.told.clear();
    return outcome;
}

/// The limits of a/b -> 0 of c11, c22, c23 and c33 (Kalker 1990, appendix E).
std::array<double, 4> wide(double a_over_b, double nu) {
    const double rest = 1 + nu * (std::log(16 / (a_over_b * a_over_b)) / 2 + std::log(4.0) - 5);
    return {pi * pi / 4 / (1 - nu), pi * pi / 4, pi * std::sqrt(a_over_b) / 3 / (1 - nu) * rest,
            pi * pi / 16 / (1 - nu) / a_over_b};
}

/// The coefficients for a/b -> inf: c11 and c22 to terms of order 1/ln(a/b)^2, c23 and c33 to terms of order 1/ln(a/b).
std::array<double, 4> slender(double a_over_b, double nu) {
    const double log = std::log(16 * a_over_b * a_over_b), rest = 3 - std::log(4.0);
    const double x = log - 2 * nu, y = (1 - nu) * log + 2 * nu, turn = (1 - nu) * log - 2 + 4 * nu;
    return {2 * pi * a_over_b / x * (1 + rest / x), 2 * pi * a_over_b / y * (1 + (1 - nu) * rest / y),
            2 * pi / 3 * a_over_b * std::sqrt(a_over_b) / turn, pi / 4 * (1 - nu * (log - 2) / turn)};
}

void add_ellipses(Cases& cases) {
    for (const double nu : {0.0, steel, 0.5}) {
        const auto add = [&](const char* kind, double a_over_b, Index n, Index m, std::array<double, 4> references,
                             std::array<double, 4> bounds, std::array<std::string, 4> says = {}) {
            for (std::size_t k = 0; k < 4; ++k) {
                const Entry entry = std::array{c11, c22, c23, c33}[k];
                const double reference = references[k], bound = bounds[k];
                cases.add(
                    kind + (" a/b = " + shown(a_over_b)) + ", nu = " + shown(nu),
                    entry.name + std::string(a_over_b < 1 ? " against a/b -> 0" : " against a/b -> inf"),
                    [=] {
                        const auto contact = PatchContact::dimensionless(a_over_b, nu);
                        return coefficient(contact, n, m, entry, reference, bound);
                    },
                    says[k]);
            }
        };
        for (const double a_over_b : {0.02, 1e-3, 1e-6}) {
            const double bound = a_over_b > 0.01 ? 5e-3 : 4e-3;
            add("patch", a_over_b, 20, 20, wide(a_over_b, nu), {bound, bound, 8e-3, 6e-3});
        }
        add("patch", 50, 24, 12, slender(50, nu), {2e-2, 2e-2, 3e-2, 7e-2},
            {"", "", "", nu > 0 ? "status not_converged" : ""});
        // c33 tends to 0 and comes out negative on so few elements
        const std::string negative = nu == 0.5 ? "status assists_creepage" : "";
        const std::string unknown = nu == steel ? "status not_converged" : negative;
        add("needle", 1e3, 24, 12, slender(1e3, nu), {3e-2, 3e-2, 3e-2, 8e-2},
            {negative, unknown, nu == 0 ? "status not_converged" : unknown, unknown});
    }
    // n and m apart, against the limit of small elements
    for (const auto& [n, m] : {std::pair{24, 8}, {8, 24}, {30, 15}}) {
        cases.add("patch a/b = 1, nu = 0.25, " + std::to_string(n) + " x " + std::to_string(m), "c11 against its limit",
                  [n = n, m = m] { return coefficient(PatchContact::dimensionless(1, 0.25), n, m, c11, 4.111, 8e-3); });
    }
    // c32 and -c23 are the same in the limit of small elements
    for (const double a_over_b : {0.02, 1.0, 20.0}) {
        cases.add("patch a/b = " + shown(a_over_b) + ", nu = 0.28", "c32 against -c23", [=] {
            const auto contact = PatchContact::dimensionless(a_over_b, steel);
            const double other = coefficient(contact, 24, 12, c23, 1, 0).value;
            return coefficient(contact, 24, 12, c32, -other, 3e-2);
        });
    }
    cases.add(
        "patch a/b = 9.99989e-321", "c11",
        [] { return coefficient(PatchContact::dimensionless(1e-320, steel), 4, 4, c11, 1, 0); },
        "must be positive and finite");
}

/// Rolling the other way leaves the force per creepage as it is (reciprocity): corners ahead, behind and beside.
void add_outlines(Cases& cases) {
    using Edges = std::vector<double>;
    const auto reversed = [&](const std::string& name, const Edges& y, const Edges& trailing, const Edges& leading,
                              double bound) {
        cases.add(name, "c11 against the same rolling backwards", [=] {
            const auto array = [](const Edges& from) {
                return ArrayX<double>(Eigen::Map<const ArrayX<double>>(from.data(), Index(from.size())));
            };
            const auto outlined = [&](const ArrayX<double>& behind, const ArrayX<double>& ahead) {
                return PatchContact(rollbem::PatchContact::Outline(array(y), behind, ahead), 1, steel);
            };
            const Outcome other = coefficient(outlined(-array(leading), -array(trailing)), 16, 16, c11, 1, 0);
            return coefficient(outlined(array(trailing), array(leading)), 16, 16, c11, other.value, bound);
        });
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
