// Steady and harmonic creep coefficients in long double.
#include "long_double.hpp"

#include <cmath>

#include <rollbem/compiled/frequency.hpp>
#include <rollbem/compiled/steady.hpp>

namespace extremes {

namespace {

using Real = long double;

// nu is rounded to double first, as in the computation that is checked
rollbem::StripKernel<Real> strip(double aspect, double nu) { return {aspect, 1 - Real(nu), Real(nu)}; }
rollbem::PlaneKernel<Real> plane(double aspect, double nu) { return {aspect, 1 - Real(nu), Real(nu)}; }

}  // namespace

long double steady_c11(const rollbem::MeshSpecification& specification, const rollbem::Collocation& scheme,
                       double aspect, double poisson_ratio) {
    const rollbem::Mesh<Real> mesh = rollbem::make_mesh<Real>(specification);
    if (std::isinf(aspect)) return rollbem::solve_steady(mesh, scheme, plane(aspect, poisson_ratio)).c11;
    return rollbem::solve_steady(mesh, scheme, strip(aspect, poisson_ratio)).c11;
}

std::complex<long double> harmonic_c11(const rollbem::MeshSpecification& specification,
                                       const rollbem::Collocation& scheme, double aspect, double poisson_ratio,
                                       double z) {
    const rollbem::Mesh<Real> mesh = rollbem::make_mesh<Real>(specification);
    return rollbem::solve_harmonic<Real>(rollbem::rolling_system(mesh, scheme, plane(aspect, poisson_ratio)), z).c11;
}

}  // namespace extremes
