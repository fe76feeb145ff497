// The monomial approach compiled for double. Replaces spectral/polynomial.hpp; link rollbem::compiled.
#pragma once

#include "../spectral/polynomial.hpp"
#include "decompositions.hpp"

namespace rollbem {

extern template decltype(detail::solve_monomial_once<double>) detail::solve_monomial_once<double>;

}  // namespace rollbem
