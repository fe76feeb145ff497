// The monomial approach and the exact border of stick, compiled for double. Replaces studies/monomial.hpp and
// studies/stick_border.hpp; link rollbem::compiled.
#pragma once

#include "../elasticity/any_kernel.hpp"
#include "../studies/monomial.hpp"
#include "../studies/stick_border.hpp"
#include "adhesion.hpp"
#include "friction.hpp"

namespace rollbem {

extern template decltype(detail::solve_monomial_once<double>) detail::solve_monomial_once<double>;
extern template decltype(detail::find_exact_border<double, AnyKernel<double>>)
    detail::find_exact_border<double, AnyKernel<double>>;
extern template decltype(detail::find_exact_border<double, PlaneKernel<double>>)
    detail::find_exact_border<double, PlaneKernel<double>>;
extern template decltype(detail::find_exact_border<double, StripKernel<double>>)
    detail::find_exact_border<double, StripKernel<double>>;

}  // namespace rollbem
