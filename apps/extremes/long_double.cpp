// Steady and harmonic creep coefficients in long double.
#include "long_double.hpp"

#include <cmath>

#include <Eigen/LU>

#include <rollbem/compiled/steady.hpp>

namespace extremes {

namespace {

using Real = long double;

/// A kernel of unit modulus; nu is rounded to double first, as in the computation that is checked.
template <template <class> class Kernel>
Kernel<Real> in_long_double(double aspect, double nu) {
    return {aspect, 1 - Real(nu), Real(nu)};
}

}  // namespace

long double steady_c11(const rollbem::MeshSpecification& specification, const rollbem::Collocation& scheme,
                       double aspect, double poisson_ratio) {
    const rollbem::Mesh<Real> mesh = rollbem::make_mesh<Real>(specification);
    const auto c11 = [&](const auto& kernel) { return rollbem::solve_steady(mesh, scheme, kernel).c11; };
    return std::isinf(aspect) ? c11(in_long_double<rollbem::PlaneKernel>(aspect, poisson_ratio))
                              : c11(in_long_double<rollbem::StripKernel>(aspect, poisson_ratio));
}

std::complex<long double> harmonic_c11(const rollbem::MeshSpecification& specification,
                                       const rollbem::Collocation& scheme, double aspect, double poisson_ratio,
                                       double z) {
    const rollbem::Mesh<Real> mesh = rollbem::make_mesh<Real>(specification);
    const auto kernel = in_long_double<rollbem::PlaneKernel>(aspect, poisson_ratio);
    const rollbem::MatrixX<Real> G_prime = rollbem::assemble_G_prime(mesh, scheme, kernel),
                                 zG = z * rollbem::assemble_G(mesh, scheme, kernel);
    const Eigen::Index n = mesh.size();
    // (G' - i z G) p = 1 in real numbers, which compile in a third of the time
    rollbem::MatrixX<Real> A(2 * n, 2 * n);
    A << G_prime, zG, -zG, G_prime;
    rollbem::VectorX<Real> ones = rollbem::VectorX<Real>::Zero(2 * n);
    ones.head(n).setOnes();
    const rollbem::VectorX<Real> p = Eigen::PartialPivLU<rollbem::MatrixX<Real>>(A).solve(ones);
    const rollbem::VectorX<Real> widths = mesh.widths();
    return {-widths.dot(p.head(n)), -widths.dot(p.tail(n))};
}

}  // namespace extremes
