// Steady and harmonic creep coefficients in long double, which show the rounding errors of double.
#pragma once

#include <complex>

#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/discretisation/scheme.hpp>

namespace extremes {

/// c11 with the plane kernel for an infinite aspect, otherwise with the strip kernel.
long double steady_c11(const rollbem::MeshSpecification& mesh, const rollbem::Collocation& scheme, double aspect,
                       double poisson_ratio);

/// c11 at z = omega a/V with the plane kernel.
std::complex<long double> harmonic_c11(const rollbem::MeshSpecification& mesh, const rollbem::Collocation& scheme,
                                       double aspect, double poisson_ratio, double z);

}  // namespace extremes
