// Systems of line contacts compiled for double, assembled by collocation and by node differences. Replaces
// assembly/rolling_system.hpp; link rollbem::compiled.
#pragma once

#include "../assembly/rolling_system.hpp"
#include "assembly.hpp"

namespace rollbem {

extern template void detail::require_finite<MatrixX<double>>(const char*, const char*, const MatrixX<double>&);
extern template void detail::require_square<MatrixX<double>>(const char*, const char*, const MatrixX<double>&,
                                                             std::ptrdiff_t, const char*);
extern template struct Elements<double>;
extern template class RollingSystem<double>;
extern template class ElementSystem<double, 1>;
extern template ElementSystem<double> rolling_system<double, AnyScheme, AnyKernel<double>>(const Mesh<double>&,
                                                                                           const AnyScheme&,
                                                                                           const AnyKernel<double>&);
extern template ElementSystem<double> rolling_system<double, Collocation, PlaneKernel<double>>(
    const Mesh<double>&, const Collocation&, const PlaneKernel<double>&);
extern template ElementSystem<double> rolling_system<double, Collocation, StripKernel<double>>(
    const Mesh<double>&, const Collocation&, const StripKernel<double>&);
extern template ElementSystem<double> rolling_system<double, NodeDifference, PlaneKernel<double>>(
    const Mesh<double>&, const NodeDifference&, const PlaneKernel<double>&);

}  // namespace rollbem
