// The spectral solution of the strip, which several programs use: compiled once, in strip_instances.cpp.
#pragma once

#include <complex>

#include <rollbem/reference/strip.hpp>

namespace rollbem::reference {

extern template decltype(detail::strip_c11_once<double>) detail::strip_c11_once<double>;
extern template decltype(detail::strip_c11_once<std::complex<double>>) detail::strip_c11_once<std::complex<double>>;

}  // namespace rollbem::reference
