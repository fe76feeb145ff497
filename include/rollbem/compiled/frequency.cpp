#include "frequency.hpp"

namespace rollbem {

template decltype(solve_response<double>) solve_response<double>;
template class FrequencySweep<double>;

}  // namespace rollbem
