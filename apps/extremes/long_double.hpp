// Steady and harmonic creep coefficients in long double: what shows the rounding of double.
#pragma once

#include <complex>

#include <Eigen/Core>

#include <rollbem/discretisation/scheme.hpp>

namespace extremes {

/// A mesh by its maker's name and one parameter (size ratio, epsilon; ignored elsewhere).
struct MeshName {
    const char* maker;  ///< uniform, cosine, geometric, knothe or modified-knothe
    Eigen::Index n;
    double parameter = 1;
};

/// c11 with the plane kernel for an infinite aspect, else with the strip kernel.
long double steady_c11(const MeshName& mesh, const rollbem::Collocation& scheme, double aspect, double poisson_ratio);

/// c11 at z = omega a/V with the plane kernel.
std::complex<long double> harmonic_c11(const MeshName& mesh, const rollbem::Collocation& scheme, double aspect,
                                       double poisson_ratio, double z);

}  // namespace extremes
