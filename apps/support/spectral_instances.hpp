// Polynomial and spectral solutions in double, which several programs and tests use: compiled once, in
// spectral_instances.cpp.
#pragma once

#include <complex>

#include <rollbem/reference/strip.hpp>
#include <rollbem/spectral/polynomial.hpp>

namespace rollbem {

extern template decltype(detail::solve_monomial_once<double>) detail::solve_monomial_once<double>;
extern template decltype(reference::detail::strip_c11_once<double>) reference::detail::strip_c11_once<double>;
extern template decltype(reference::detail::strip_c11_once<std::complex<double>>)
    reference::detail::strip_c11_once<std::complex<double>>;

}  // namespace rollbem
