#include "polynomial.hpp"

#include <rollbem/compiled/frequency.hpp>
#include <rollbem/compiled/monomial.hpp>
#include <rollbem/elasticity/any_kernel.hpp>
#include <rollbem/reference/bessel.hpp>

#include "support/csv.hpp"
#include "support/errors.hpp"
#include "support/non_steady.hpp"

namespace frequency {

namespace {

struct PolynomialResult {
    Complex c11;
    double error_estimate;
    rollbem::Status status;
};

/// Throws BadInput where monomials have broken down and that is `checked`.
PolynomialResult monomial_c11(const rollbem::Contact<double>& contact, double omega, Eigen::Index order, bool checked) {
    constexpr Eigen::Index highest = 1000;
    const std::string name = "--order = " + std::to_string(order);
    if (order > highest) {
        throw study::BadInput(name + " must be at most " + std::to_string(highest) +
                              " with --basis monomial, which costs its third power; take --basis chebyshev");
    }
    const rollbem::PolynomialSolution<double> solution =
        rollbem::solve_monomial<double>(Complex(0, omega), contact.poisson_ratio(), contact.aspect(), order);
    if (checked && solution.status != rollbem::Status::ok) {
        throw study::BadInput(name + " with --basis monomial must give a result that can be trusted; at omega = " +
                              study::Cell(omega).text(6) + " it does not: " +
                              rollbem::polynomial_advice(solution.status) + " (--basis chebyshev, or --unchecked)");
    }
    return {solution.c11, solution.error_estimate, solution.status};
}

/// Chebyshev polynomials do not break down, but an order can be too low: then a c11 that is `checked` is not a number,
/// and the estimate stays.
PolynomialResult chebyshev_c11(const rollbem::Contact<double>& contact, double omega, Eigen::Index order,
                               bool checked) {
    const rollbem::EstimatedC11<double> result =
        rollbem::polynomial_c11(Complex(0, omega), contact.poisson_ratio(), contact.aspect(), order);
    const bool trusted = result.status == rollbem::Status::ok;
    return {trusted || !checked ? result.c11 : unknown, result.error_estimate, result.status};
}

}  // namespace

Complex exact_c11(const rollbem::Contact<double>& contact, double omega) {
    if (!study::plane_model_decays(contact)) return unknown;
    return rollbem::reference::plane_c11(Complex(0, omega), contact.poisson_ratio(), contact.aspect());
}

Polynomials solve_polynomials(const study::Options& options, const std::vector<double>& omegas) {
    if (options.given("kernel") && options.choice("kernel", {"strip", "plane"}) != "plane") {
        throw study::BadInput(options.said("kernel") + " must be plane with --method polynomial");
    }
    const std::vector<rollbem::Contact<double>> contacts = study::make_contacts(options, study::Problem::non_steady);
    for (const rollbem::Contact<double>& contact : contacts) study::require_plane_model(contact);
    const std::string basis = options.choice("basis", {"monomial", "chebyshev"});
    const auto solve = basis == "monomial" ? monomial_c11 : chebyshev_c11;
    const bool checked = !options.flag("unchecked");
    std::vector<std::optional<Eigen::Index>> orders{std::nullopt};  // the default order of each frequency
    if (options.given("order")) {
        orders.clear();
        for (const Eigen::Index order : options.integers("order", 1, 100000000)) orders.emplace_back(order);
    }
    Polynomials all;
    for (const std::optional<Eigen::Index>& given : orders) {
        for (const rollbem::Contact<double>& contact : contacts) {
            const auto kernel = rollbem::AnyKernel<double>::longitudinal(rollbem::LineModel::plane, contact);
            all.scenes.push_back({.method = "polynomial", .contact = contact, .kernel = kernel});
            std::vector<Response>& responses = all.responses.emplace_back();
            for (const double omega : omegas) {
                if (!given && omega > 1e8) {
                    throw study::BadInput("--omega = " + study::Cell(omega).text(6) +
                                          " must be at most 1e8 without --order");
                }
                const Eigen::Index order = given ? *given : rollbem::default_polynomial_order(Complex(0, omega));
                const PolynomialResult result = solve(contact, omega, order, checked);
                responses.push_back({.omega = omega,
                                     .c11 = result.c11,
                                     .exact = exact_c11(contact, omega),
                                     .status = name(result.status),
                                     .error_estimate = result.error_estimate,
                                     .order = order,
                                     .basis = basis});
            }
        }
    }
    return all;
}

}  // namespace frequency
