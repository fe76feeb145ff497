// Steady and harmonic creep coefficients in long double.
#include "long_double.hpp"

#include <Eigen/LU>

#include <rollbem/compiled/steady.hpp>
#include <rollbem/elasticity/any_kernel.hpp>

namespace extremes {

namespace {

using Real = long double;

/// nu is rounded to double first, as in the computation that is checked.
rollbem::AnyKernel<Real> in_long_double(rollbem::LineModel model, double aspect, double nu) {
    return rollbem::AnyKernel<Real>::longitudinal(model, rollbem::Contact<Real>::dimensionless(aspect, nu));
}

}  // namespace

long double steady_c11(const rollbem::MeshSpecification& specification, const rollbem::Collocation& scheme,
                       double aspect, double poisson_ratio) {
    const rollbem::Mesh<Real> mesh = rollbem::make_mesh<Real>(specification);
    return rollbem::solve_steady(mesh, scheme, in_long_double(rollbem::LineModel::strip, aspect, poisson_ratio)).c11();
}

std::complex<long double> harmonic_c11(const rollbem::MeshSpecification& specification,
                                       const rollbem::Collocation& scheme, double aspect, double poisson_ratio,
                                       double z) {
    const rollbem::Mesh<Real> mesh = rollbem::make_mesh<Real>(specification);
    const auto kernel = in_long_double(rollbem::LineModel::plane, aspect, poisson_ratio);
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
