#include "frequency.hpp"

namespace rollbem {

template HarmonicSolution<double> solve_exponential<double>(const RollingSystem<double>&, std::complex<double>);
template class FrequencySweep<double>;

}  // namespace rollbem
