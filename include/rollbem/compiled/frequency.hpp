// Frequency response compiled for double: in place of adhesion/frequency.hpp, with rollbem::compiled.
#pragma once

#include "../detail/language.hpp"

#include "../adhesion/frequency.hpp"
#include "assembly.hpp"

namespace rollbem {

extern template HarmonicSolution<double> solve_exponential<double>(const RollingSystem<double>&, const ArrayX<double>&,
                                                                   std::complex<double>);
extern template class FrequencySweep<double>;

}  // namespace rollbem
