// The monomial approach compiled for double: in place of spectral/polynomial.hpp, with rollbem::compiled.
#pragma once

#include "../detail/language.hpp"

#include "../spectral/polynomial.hpp"

namespace rollbem {

extern template decltype(detail::solve_monomial_once<double>) detail::solve_monomial_once<double>;

}  // namespace rollbem
