// The library calls behind the figures and claims of the paper: one case of a discretised contact in, numbers out.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <rollbem/status.hpp>
#include <rollbem/system/response.hpp>

#include "support/named_scheme.hpp"
#include "support/scenes.hpp"

namespace paper {

/// Parameters that the paper does not give: steel, and a strip so wide that c11 differs from the plane limit by 2e-7.
inline constexpr double poisson_ratio = 0.28;
inline constexpr double aspect = 1000;  ///< b/a [-]

inline constexpr const char* recommended = "uniform:collocation:0/0.63";  ///< the paper's scheme
inline const std::string half_alphas = "uniform:collocation:0.5/0.5", unit_alphas = "uniform:collocation:1/1";
inline constexpr const char* seven_points = "uniform:galerkin:0/0.63:q7";
inline constexpr const char* exact_galerkin = "uniform:galerkin:0/0.63";

/// One discretisation: a scheme with n elements.
struct Case : study::NamedScheme {
    Eigen::Index n;

    Case(const std::string& word = recommended, Eigen::Index elements = 40)
        : NamedScheme(study::scheme_named(word)), n(elements) {}
};

/// The case on a strip, as all are but where another kernel is named, and its matrices.
study::Scene scene_of(const Case& c, rollbem::LineModel model = rollbem::LineModel::strip);
rollbem::ElementSystem<double> system_of(const Case& c);

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
