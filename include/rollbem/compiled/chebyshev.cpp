#include "chebyshev.hpp"

namespace rollbem {

template ChebyshevSystem<double> rolling_system<PlaneKernel<double>>(const Chebyshev&, const PlaneKernel<double>&);
template ChebyshevSystem<double> rolling_system<StripKernel<double>>(const Chebyshev&, const StripKernel<double>&);
template ChebyshevSteadySolution<double> detail::solve_chebyshev_steady<PlaneKernel<double>>(
    const Chebyshev&, const PlaneKernel<double>&);
template ChebyshevSteadySolution<double> detail::solve_chebyshev_steady<StripKernel<double>>(
    const Chebyshev&, const StripKernel<double>&);

}  // namespace rollbem
