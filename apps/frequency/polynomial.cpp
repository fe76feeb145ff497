#include "polynomial.hpp"

#include <rollbem/compiled/adhesion.hpp>
#include <rollbem/compiled/studies.hpp>
#include <rollbem/elasticity/any_kernel.hpp>
#include <rollbem/reference/bessel.hpp>

#include "support/non_steady.hpp"

namespace frequency {

namespace {

/// Monomials break down, which is refused; of Chebyshev polynomials an order can be too low: then a c11 that is
/// `checked` is not a number, and the estimate stays.
Response solve(const rollbem::Contact<double>& contact, double omega, Eigen::Index order, const std::string& basis,
               bool checked) {
    const double nu = contact.poisson_ratio();
    Response response{.omega = omega,
                      .c11 = unknown,
                      .exact = exact_c11(contact, omega),
                      .status = "",
                      .order = order,
                      .basis = basis};
    const auto take = [&](const auto& solution) {
        const bool trusted = solution.status == rollbem::Status::ok;
        if (trusted || !checked) response.c11 = solution.c11;
        response.error_estimate = solution.error_estimate;
        response.status = name(solution.status);
        return solution.status;
    };
    if (basis == "chebyshev") {
        take(rollbem::polynomial_c11(Complex(0, omega), nu, contact.aspect(), order));
        return response;
    }
    constexpr Eigen::Index highest = 1000;
    const std::string option = "--order = " + std::to_string(order);
    if (order > highest) {
        throw study::BadInput(option + " must be at most " + std::to_string(highest) +
                              " with --basis monomial, which costs its third power; take --basis chebyshev");
    }
    const rollbem::Status status =
        take(rollbem::studies::solve_monomial<double>(Complex(0, omega), nu, contact.aspect(), order));
    if (checked && status != rollbem::Status::ok) {
        throw study::BadInput(option + " with --basis monomial must give a result that can be trusted; at omega = " +
                              study::Cell(omega).text(6) + " it does not: " +
                              rollbem::studies::polynomial_advice(status) + " (--basis chebyshev, or --unchecked)");
    }
    return response;
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
    const bool checked = !options.flag("unchecked");
    std::vector<std::ptrdiff_t> orders{0};  // the default order of each frequency
    if (options.given("order")) orders = options.integers("order", 1, 100000000);
    Polynomials all;
    for (const std::ptrdiff_t given : orders) {
        for (const rollbem::Contact<double>& contact : contacts) {
            const auto kernel = rollbem::AnyKernel<double>::longitudinal(rollbem::LineModel::plane, contact);
            all.scenes.push_back({.method = "polynomial", .contact = contact, .kernel = kernel});
            std::vector<Response>& responses = all.responses.emplace_back();
            for (const double omega : omegas) {
                if (given == 0 && omega > 1e8) {
                    throw study::BadInput("--omega = " + study::Cell(omega).text(6) +
                                          " must be at most 1e8 without --order");
                }
                const Eigen::Index order = given > 0 ? given : rollbem::default_polynomial_order(Complex(0, omega));
                responses.push_back(solve(contact, omega, order, basis, checked));
            }
        }
    }
    return all;
}

}  // namespace frequency
