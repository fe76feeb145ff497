// Frequency response compiled for double. Replaces adhesion/frequency.hpp; link rollbem::compiled.
#pragma once

#include "../adhesion/frequency.hpp"
#include "decompositions.hpp"
#include "rolling_system.hpp"

namespace rollbem {

extern template decltype(detail::factorise<std::complex<double>, double>)
    detail::factorise<std::complex<double>, double>;
extern template decltype(detail::judge<std::complex<double>, double>) detail::judge<std::complex<double>, double>;
extern template decltype(detail::solve_copied<std::complex<double>, double>)
    detail::solve_copied<std::complex<double>, double>;
extern template decltype(solve_response<double>) solve_response<double>;
extern template class FrequencySweep<double>;

}  // namespace rollbem
