// G and G' compiled for double: include this beside assembly/influence.hpp and link rollbem::compiled.
// Each header in this folder is its namesake with the largest templates declared to be in that library, so that no unit
// compiles them again. The library must be built with the same options that lay out Eigen's memory (-march and the
// like) as what links it.
#pragma once

#include "../detail/language.hpp"

#include "../assembly/influence.hpp"

namespace rollbem {

extern template MatrixX<double> detail::influence_matrix<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                                 const detail::KernelView<double>&, Quantity);
extern template VectorX<double> detail::influence_product<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                                  const detail::KernelView<double>&, Quantity,
                                                                  const VectorX<double>&);

}  // namespace rollbem
