// Section 6.2, response to harmonic creepage: Fig. 22 and Eqs. (24) to (26), and the last of the conclusions.
#include <algorithm>
#include <complex>
#include <limits>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/LU>

#include <rollbem/compiled/monomial.hpp>
#include <rollbem/reference/bessel.hpp>

#include "lists.hpp"

namespace paper {

namespace {

std::vector<double> frequencies_of_fig_22() { return logarithmic(1e-3, 5, 75); }

/// Largest relative difference of the harmonic c11 from the polynomial approach of order 20.
double harmonic_error(const Case& c, const std::vector<double>& z) {
    const std::vector<std::complex<double>> c11 = harmonic_c11(c, z);
    double result = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        const std::complex<double> reference = polynomial_c11(z[i]);
        const double error = std::abs(c11[i] - reference) / std::abs(reference);
        if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
        result = std::max(result, error);
    }
    return result;
}

/// Largest relative error of a function of frequency against the closed form in Bessel functions.
template <class Function>
double largest_c11_error(const Function& c11, const std::vector<double>& z) {
    double result = 0;
    for (const double frequency : z) {
        const std::complex<double> exact = rollbem::reference::plane_c11({0, frequency}, poisson_ratio, aspect);
        result = std::max(result, std::abs(c11(frequency) - exact) / std::abs(exact));
    }
    return result;
}

/// c11 from Eqs. (25) to (27) as printed, without the factor l of d(x/a)^l/dx.
std::complex<double> c11_as_printed(double z, Eigen::Index order) {
    const Eigen::MatrixXcd B = rollbem::displacement_matrix(order, poisson_ratio, aspect).cast<std::complex<double>>();
    Eigen::MatrixXcd equations(order + 1, order + 1);
    for (Eigen::Index l = 0; l < order; ++l) {
        equations.row(l) = (B.col(l + 1) - std::complex<double>(0, z) * B.col(l)).transpose();
    }
    equations.row(order).setOnes();
    const Eigen::VectorXcd right_hand_side = Eigen::VectorXcd::Unit(order + 1, 0);
    const Eigen::VectorXcd coefficients = Eigen::PartialPivLU<Eigen::MatrixXcd>(equations).solve(right_hand_side);
    const Eigen::VectorXd moments = rollbem::monomial_moments<double>(order);
    return -std::numbers::pi * (moments.cast<std::complex<double>>().array() * coefficients.array()).sum();
}

}  // namespace

std::vector<Claim> claims_of_frequency() {
    return {
        {"22", "good agreement between the different methodologies",
         "Collocation (fd, 0/0.63) agrees with the polynomial approach for n = 20, 40 and 60", true,
         "good: within 1 % of |c11| at every frequency, and so real and imaginary part",
         for_all_n(coarse, "largest difference ",
                   [](const Results&, std::size_t k) -> Finding {
                       const double error = harmonic_error({.n = coarse[k]}, frequencies_of_fig_22());
                       return {error < 0.01, percent(error)};
                   })},
        {"22", "alpha_L = 1 and alpha_T = 0", "The scheme of the caption gives these results", false,
         "the indices are swapped: 0/0.63 is meant, as elsewhere",
         [](const Results&) -> Finding {
             const double error = harmonic_error({.n = 60, .alpha_L = 1, .alpha_T = 0}, frequencies_of_fig_22());
             const double slow = harmonic_error({.n = 60, .alpha_L = 1, .alpha_T = 0}, {1e-3});
             return {error < 0.01, "largest difference " + percent(error) + "; " + percent(slow) +
                                       " at omega a/V = 0.001 (n = 60; 0/0.63: " +
                                       percent(harmonic_error({.n = 60}, frequencies_of_fig_22())) + ")"};
         }},
        {"22", "accurate results, even if just a first order polynomial",
         "The polynomial of first order is as good an approximation", false,
         "only at low frequency; good as above: within 1 %",
         [](const Results&) -> Finding {
             const auto first = [](double z) { return polynomial_c11(z, 1); };
             double limit = 0;
             for (const double z : frequencies_of_fig_22()) {
                 if (largest_c11_error(first, {z}) > 0.01) break;
                 limit = z;
             }
             const double error = largest_c11_error(first, frequencies_of_fig_22());
             return {error < 0.01, "within 1 % up to omega a/V = " + number(limit, 2) + "; " +
                                       percent(largest_c11_error(first, {0.1})) + " at 0.1, " + percent(error) +
                                       " at most"};
         }},
        {"Eqs. 24-26", "will be satisfied for each polynomial term",
         "Eqs. (25) to (27) as printed, order 20, give c11 at omega a/V = 1", false,
         "the factor l of d(x/a)^l/dx is missing; with it the order 20 meets the closed form",
         [](const Results&) -> Finding {
             const double printed =
                 largest_c11_error([](double z) { return c11_as_printed(z, polynomial_order); }, {1.0});
             const double corrected = largest_c11_error([](double z) { return polynomial_c11(z); }, {1.0});
             return {printed < 0.01,
                     "error " + percent(printed) + " as printed, " + number(corrected, 1) + " with the factor"};
         }},
        {"22", "", "With the factor, the polynomial approach of order 20 can serve as reference in this range", true,
         "against the closed form in Bessel functions",
         below(
             1e-5,
             [](const Results&) {
                 return largest_c11_error([](double z) { return polynomial_c11(z); }, frequencies_of_fig_22());
             },
             [](double error) { return "largest error " + number(error, 1); })},
        {"Sec. 7", "similar to those obtained in the static case", "Errors over frequency are like the static ones",
         true, "like: the largest over frequency is below 3 times the static one (n = 60)",
         [](const Results&) -> Finding {
             bool holds = true;
             std::string text;
             for (const double alpha_L : {0.0, 0.5}) {
                 const Case c{.n = 60, .alpha_L = alpha_L, .alpha_T = alpha_L == 0 ? 0.63 : 0.5};
                 const double moving = harmonic_error(c, frequencies_of_fig_22()), still = std::abs(c11_ratio(c) - 1);
                 holds = holds && moving < 3 * still;
                 text += (text.empty() ? "0/0.63: " : "; 0.5/0.5: ") + percent(moving) + " against " + percent(still);
             }
             return {holds, text};
         }},
    };
}

}  // namespace paper
