#include "frequency.hpp"

namespace rollbem {

template decltype(solve_exponential<double>) solve_exponential<double>;
template class FrequencySweep<double>;

}  // namespace rollbem
