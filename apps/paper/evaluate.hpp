// The library calls behind the figures and claims of the paper: one case of a discretised contact in, numbers out.
// Their definitions are in evaluate.cpp, because the eigenvalue headers compile slowly.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/strip_kernel.hpp>
#include <rollbem/status.hpp>
#include <rollbem/system/response.hpp>

namespace paper {

/// What the paper does not give: steel, and a strip so wide that c11 differs from the plane limit by 2e-7.
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

inline constexpr Derivative analytic = Derivative::analytic;
inline constexpr Case exact_galerkin{.method = Method::galerkin_exact, .derivative = analytic};

/// The kernel of all cases, and the matrices of one.
rollbem::StripKernel<double> strip();
rollbem::ElementSystem<double> system_of(const Case& c);

std::string name(Method method);
std::string name(Derivative derivative);

/// Displacement [a p/G] and its derivative [p/G] due to one element of width 2a/40 under traction p, at x from its
/// centre in widths of the element; not at its edges, where the derivative is infinite.
struct ElementField {
    double displacement, slope;
};
ElementField element_field(double x_over_width);

/// Steady rolling. Near alpha = 0 tractions zigzag and assist the creepage, which the status says.
rollbem::Response<double> steady(const Case& c);

/// c11*/c11, c11 = pi/(2(1-nu)), even if tractions assist the creepage; not a number if the equations are singular to
/// working precision.
double c11_ratio(const Case& c);

/// Tractions of steady rolling, p/(G xi), of every element, trailing to leading.
struct Tractions {
    Eigen::ArrayXd x;            ///< centres over a
    Eigen::ArrayXd value;        ///< computed; not numbers where the equations are singular to working precision
    Eigen::ArrayXd carter;       ///< Carter at the centre
    Eigen::ArrayXd carter_mean;  ///< his mean over the element
    rollbem::Status status;
};
Tractions tractions(const Case& c);

/// Eigenvalues of Eq. (33) with positive real part as computed, by the standard eigenvalue problem of G'^-1 G or, if G'
/// is too ill-conditioned, by the QZ algorithm.
Eigen::Index unstable_count(const Case& c);

/// c11 under harmonic creepage of omega a/V = z, by the boundary elements; not a number where the equations are
/// singular to working precision.
struct HarmonicResponse {
    std::complex<double> c11;
    rollbem::Status status;
};
std::vector<HarmonicResponse> harmonic_responses(const Case& c, const std::vector<double>& z);

}  // namespace paper
