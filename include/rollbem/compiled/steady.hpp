// Steady rolling by elements and by Chebyshev states, compiled for double. Replaces adhesion/steady.hpp and, for
// steady rolling, spectral/chebyshev.hpp; link rollbem::compiled.
#pragma once

#include "../adhesion/steady.hpp"
#include "../spectral/chebyshev.hpp"
#include "assembly.hpp"
#include "lu.hpp"

namespace rollbem {

extern template detail::FactorisedSteady<double> detail::factorise_steady<double>(MatrixX<double>&,
                                                                                  const ArrayX<double>&);
extern template SteadySolution<double> solve_steady<double>(MatrixX<double>, const ArrayX<double>&);
extern template SteadySolution<double> detail::judge_steady<double>(detail::FactorisedSteady<double>,
                                                                    const ArrayX<double>&, const VectorX<double>&);
extern template ChebyshevSteadySolution<double> detail::solve_chebyshev_steady<AnyKernel<double>>(
    const Chebyshev&, const AnyKernel<double>&);
extern template ChebyshevSteadySolution<double> detail::solve_chebyshev_steady<PlaneKernel<double>>(
    const Chebyshev&, const PlaneKernel<double>&);
extern template ChebyshevSteadySolution<double> detail::solve_chebyshev_steady<StripKernel<double>>(
    const Chebyshev&, const StripKernel<double>&);

}  // namespace rollbem
