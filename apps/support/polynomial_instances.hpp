// Polynomial solutions in double, which several programs and tests use: compiled once, in spectral_instances.cpp.
#pragma once

#include <rollbem/spectral/polynomial.hpp>

namespace rollbem {

extern template decltype(detail::solve_monomial_once<double>) detail::solve_monomial_once<double>;

}  // namespace rollbem
