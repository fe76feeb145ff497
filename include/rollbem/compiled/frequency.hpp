// Frequency response compiled for double: in place of problem/frequency.hpp, with rollbem::compiled.
#pragma once

#include "../problem/frequency.hpp"
#include "assembly.hpp"

namespace rollbem {

extern template HarmonicSolution<double> solve_exponential<double>(const InfluenceMatrices<double>&,
                                                                   const ArrayX<double>&, std::complex<double>);
extern template class FrequencySweep<double>;

}  // namespace rollbem
