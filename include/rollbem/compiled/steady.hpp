// Steady rolling by elements and by Chebyshev states, compiled for double. Replaces adhesion/steady.hpp and, for
// steady rolling, spectral/chebyshev.hpp; link rollbem::compiled.
#pragma once

#include "../adhesion/steady.hpp"
#include "../spectral/chebyshev.hpp"
#include "assembly.hpp"
#include "lu.hpp"

namespace rollbem {

extern template decltype(detail::factorise<double, double>) detail::factorise<double, double>;
extern template decltype(detail::judge<double, double>) detail::judge<double, double>;
extern template decltype(detail::solve_copied<double, double>) detail::solve_copied<double, double>;
extern template decltype(detail::solve_chebyshev_steady<AnyKernel<double>>)
    detail::solve_chebyshev_steady<AnyKernel<double>>;
extern template decltype(detail::solve_chebyshev_steady<PlaneKernel<double>>)
    detail::solve_chebyshev_steady<PlaneKernel<double>>;
extern template decltype(detail::solve_chebyshev_steady<StripKernel<double>>)
    detail::solve_chebyshev_steady<StripKernel<double>>;

}  // namespace rollbem
