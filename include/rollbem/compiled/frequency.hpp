// Frequency response compiled for double: in place of adhesion/frequency.hpp, with rollbem::compiled.
#pragma once

#include "../detail/language.hpp"

#include "../adhesion/frequency.hpp"
#include "assembly.hpp"

namespace rollbem {

extern template decltype(solve_exponential<double>) solve_exponential<double>;
extern template class FrequencySweep<double>;

}  // namespace rollbem
