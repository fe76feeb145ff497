// G and G' compiled for double: include this in addition to or in place of assembly/influence.hpp and link
// rollbem::compiled. Each header in this folder declares the largest templates of its namesake as instantiated in that
// library, so that no translation unit compiles them again. Library and program must be built with the same options
// that affect the layout of Eigen's objects (-march and the like).
#pragma once

#include "../assembly/influence.hpp"
#include "../discretisation/any_scheme.hpp"
#include "../elasticity/any_kernel.hpp"

namespace rollbem {

extern template class Mesh<double>;
extern template Mesh<double> uniform_mesh<double>(Eigen::Index);
extern template Mesh<double> cosine_mesh<double>(Eigen::Index);
extern template Mesh<double> make_mesh<double>(const MeshSpecification&);
extern template void detail::check_rows<double>(const SchemeRows<double>&, Quantity, Eigen::Index);
extern template SchemeRows<double> AnyScheme::rows<double>(Quantity, const Mesh<double>&) const;
extern template detail::KernelView<double>::KernelView(const AnyKernel<double>&);
extern template detail::KernelView<double>::KernelView(const PlaneKernel<double>&);
extern template detail::KernelView<double>::KernelView(const StripKernel<double>&);
extern template MatrixX<double> detail::influence_matrix<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                                 const detail::KernelView<double>&, Quantity);
extern template VectorX<double> detail::influence_product<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                                  const detail::KernelView<double>&, Quantity,
                                                                  const VectorX<double>&);

}  // namespace rollbem
