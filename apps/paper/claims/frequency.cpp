// Section 6.2, response to harmonic creepage: Fig. 22 and Eqs. (24) to (26), and the last of the conclusions.
#include <algorithm>
#include <complex>
#include <limits>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/LU>

#include <rollbem/reference/bessel.hpp>

#include "paper/claims.hpp"
#include "studies/monomial.hpp"

namespace paper {

namespace {

using Complex = std::complex<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();
const std::vector<double> of_fig_22 = logarithmic(1e-3, 5, 75);

/// Largest relative difference of the harmonic c11 from the polynomial approach of order 20; infinite if one has none.
double harmonic_error(const Case& c, const std::vector<double>& z = of_fig_22) {
    double result = 0;
    for (std::size_t i = 0; const HarmonicResponse& response : harmonic_responses(c, z)) {
        const double error = std::abs(response.c11 / polynomial_c11(z[i++]) - 1.0);
        result = error <= result ? result : std::isnan(error) ? infinity : error;
    }
    return result;
}

/// Largest relative error of a function of frequency against the closed form in Bessel functions.
template <class Function>
double largest_c11_error(const Function& c11, const std::vector<double>& z) {
    double result = 0;
    for (const double frequency : z) {
        const Complex exact = rollbem::reference::plane_c11({0, frequency}, poisson_ratio, aspect);
        result = std::max(result, std::abs(c11(frequency) - exact) / std::abs(exact));
    }
    return result;
}

/// c11 from Eqs. (25) to (27) as printed, without the factor l of d(x/a)^l/dx.
Complex c11_as_printed(double z) {
    const Eigen::Index order = polynomial_order;
    const Eigen::MatrixXcd B = rollbem::studies::displacement_matrix(order, poisson_ratio, aspect).cast<Complex>();
    Eigen::MatrixXcd equations(order + 1, order + 1);
    for (Eigen::Index l = 0; l < order; ++l) {
        equations.row(l) = (B.col(l + 1) - Complex(0, z) * B.col(l)).transpose();
    }
    equations.row(order).setOnes();
    const Eigen::VectorXcd right_hand_side = Eigen::VectorXcd::Unit(order + 1, 0);
    const Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXcd>> lu(equations);
    const Eigen::VectorXcd coefficients = lu.solve(right_hand_side);
    const Eigen::VectorXd moments = rollbem::studies::monomial_moments<double>(order);
    return -std::numbers::pi * (moments.cast<Complex>().array() * coefficients.array()).sum();
}

}  // namespace

Claims claims_on_frequency(const Results&) {
    const Case swapped{"uniform:collocation:1/0", 60}, half{"uniform:collocation:0.5/0.5", 60}, best{recommended, 60};
    const auto first = [](double z) { return polynomial_c11(z, 1); };
    const auto corrected = [](double z) { return polynomial_c11(z); };
    double limit = 0;
    for (const double z : of_fig_22) {
        if (largest_c11_error(first, {z}) > 0.01) break;
        limit = z;
    }
    const double first_error = largest_c11_error(first, of_fig_22),
                 printed_error = largest_c11_error(c11_as_printed, {1.0});
    const double swapped_error = harmonic_error(swapped), own = harmonic_error(best), equal = harmonic_error(half);
    const double still = std::abs(c11_ratio(best) - 1), equal_still = std::abs(c11_ratio(half) - 1);
    return {
        {"22", "good agreement between the different methodologies",
         "Collocation (fd, 0/0.63) agrees with the polynomial approach for n = 20, 40 and 60",
         "good: within 1 % of |c11| at every frequency, and so real and imaginary part",
         for_all_n(coarse, "largest difference ",
                   [](std::size_t k) {
                       return below(0.01, harmonic_error({recommended, coarse[k]}), "{%}");
                   })},
        {"22", "alpha_L = 1 and alpha_T = 0", "The scheme of the caption gives these results",
         "the indices are swapped: 0/0.63 is meant, as elsewhere",
         judged(swapped_error < 0.01, "largest difference {%}; {%} at omega a/V = 0.001 (n = 60; 0/0.63: {%})",
                swapped_error, harmonic_error(swapped, {1e-3}), own),
         false},
        {"22", "accurate results, even if just a first order polynomial",
         "The polynomial of first order is as good an approximation",
         "only at low frequency; good as above: within 1 %",
         judged(first_error < 0.01, "within 1 % up to omega a/V = {2}; {%} at 0.1, {%} at most", limit,
                largest_c11_error(first, {0.1}), first_error),
         false},
        {"Eqs. 24-26", "will be satisfied for each polynomial term",
         "Eqs. (25) to (27) as printed, order 20, give c11 at omega a/V = 1",
         "the factor l of d(x/a)^l/dx is missing; with it the order 20 meets the closed form",
         judged(printed_error < 0.01, "error {%} as printed, {1} with the factor", printed_error,
                largest_c11_error(corrected, {1.0})),
         false},
        {"22", "", "With the factor, the polynomial approach of order 20 can serve as reference in this range",
         "against the closed form in Bessel functions",
         below(1e-5, largest_c11_error(corrected, of_fig_22), "largest error {1}")},
        {"Sec. 7", "similar to those obtained in the static case", "Errors over frequency are like the static ones",
         "like: the largest over frequency is below 3 times the static one (n = 60)",
         judged(own < 3 * still && equal < 3 * equal_still, "0/0.63: {%} against {%}; 0.5/0.5: {%} against {%}", own,
                still, equal, equal_still)},
    };
}

}  // namespace paper
