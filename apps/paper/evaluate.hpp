// What the figures and claims of the paper need from the library: one case of a discretised contact in, numbers out.
// The definitions are apart, in evaluate.cpp, because the eigenvalue headers compile slowly.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/status.hpp>

namespace paper {

/// Where the paper is silent: steel, and a strip so wide that c11 differs from the plane limit by 2e-7 of its value.
inline constexpr double poisson_ratio = 0.28;
inline constexpr double aspect = 1000;  ///< b/a [-]

enum class Method { collocation, galerkin_7, galerkin_exact };  ///< Galerkin with 7 Gauss points or in closed form
using rollbem::Derivative;
using rollbem::Topology;

/// One discretisation. Defaults: the paper's recommended scheme at n = 40.
struct Case {
    Eigen::Index n = 40;
    Method method = Method::collocation;
    Derivative derivative = Derivative::finite_difference;
    double alpha_L = 0, alpha_T = 0.63, lambda = 1;
    Topology mesh = Topology::uniform;
    double grading = 1;  ///< geometric: dx_trailing/dx_leading; knothe, modified_knothe: epsilon [-]
};

std::string name(Method method);
std::string name(Derivative derivative);

/// Displacement [a p/G] and its derivative [p/G] due to one element of width 2a/40 under traction p, at x from its
/// centre in widths of the element. Not at its edges, where the derivative is infinite.
struct ElementField {
    double displacement, slope;
};
ElementField element_field(double x_over_width);

/// c11*/c11 of steady rolling, c11 = pi/(2(1-nu)), and what the library thinks of it: near alpha = 0 tractions zigzag,
/// which it calls inconsistent with full adhesion.
struct SteadyRatio {
    double value;
    rollbem::Status status;
};
SteadyRatio steady_ratio(const Case& c);

/// c11*/c11, be it inconsistent; not a number where the equations are singular to working precision.
double c11_ratio(const Case& c);

/// Tractions of steady rolling, p/(G xi), of every element from the trailing edge on.
struct Tractions {
    Eigen::ArrayXd x;            ///< centres over a
    Eigen::ArrayXd value;        ///< computed; not numbers where the equations are singular to working precision
    Eigen::ArrayXd carter;       ///< Carter at the centre
    Eigen::ArrayXd carter_mean;  ///< his mean over the element
    rollbem::Status status;
};
Tractions tractions(const Case& c);

/// Largest difference of the tractions of Knothe and Gross-Thebing's boundary conditions on n + 1 elements from those
/// of collocation with alpha = 1 on n, over the largest traction (plane kernel, which knows no length).
double knothe_boundary_difference(Eigen::Index n, Derivative derivative);

/// Largest difference of G' between two cases of equal n, over its largest entry.
double G_prime_difference(const Case& first, const Case& second);
/// The same for G.
double G_difference(const Case& first, const Case& second);

/// Difference of c11*/c11 between Galerkin with `points` Gauss points and analytic derivative, and collocation with
/// finite differences: the recommended scheme at n = 40.
double gauss_galerkin_difference(int points);

/// Eigenvalues of Eq. (33) with positive real part as computed, by the standard eigenvalue problem of G'^-1 G or, where
/// G' is too ill-conditioned for that, by the QZ algorithm.
Eigen::Index unstable_count(const Case& c);

/// Whether an eigenvalue grows and rounding cannot have given it its sign, by the QZ algorithm.
bool certainly_unstable(const Case& c);

/// The smallest alpha_T from 0.45 to 1 at which certainly_unstable, found by steps of 0.001; nothing where there is
/// none.
std::optional<double> critical_alpha_T(const Case& c);

/// c11 under harmonic creepage of omega a/V = z, by the boundary elements; not a number where the equations are
/// singular to working precision.
struct HarmonicResponse {
    std::complex<double> c11;
    rollbem::Status status;
};
std::vector<HarmonicResponse> harmonic_responses(const Case& c, const std::vector<double>& z);

/// The same without the status.
std::vector<std::complex<double>> harmonic_c11(const Case& c, const std::vector<double>& z);

/// Time to assemble and solve a steady problem [us].
double steady_time_us(const Case& c);

}  // namespace paper
