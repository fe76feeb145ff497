// The monomial approach compiled for double. Replaces studies/monomial.hpp; link rollbem::compiled.
#pragma once

#include "../studies/monomial.hpp"
#include "decompositions.hpp"

namespace rollbem {

extern template decltype(detail::solve_monomial_once<double>) detail::solve_monomial_once<double>;

}  // namespace rollbem
