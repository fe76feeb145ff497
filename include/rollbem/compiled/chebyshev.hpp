// Chebyshev states compiled for double and both kernels. Replaces spectral/chebyshev.hpp; link rollbem::compiled.
#pragma once

#include "../spectral/chebyshev.hpp"
#include "decompositions.hpp"
#include "steady.hpp"

namespace rollbem {

extern template ChebyshevSystem<double> rolling_system<AnyKernel<double>>(const Chebyshev&, const AnyKernel<double>&);
extern template ChebyshevSystem<double> rolling_system<PlaneKernel<double>>(const Chebyshev&,
                                                                            const PlaneKernel<double>&);
extern template ChebyshevSystem<double> rolling_system<StripKernel<double>>(const Chebyshev&,
                                                                            const StripKernel<double>&);

}  // namespace rollbem
