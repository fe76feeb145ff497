#include "frequency.hpp"

namespace rollbem {

template HarmonicSolution<double> solve_exponential<double>(const InfluenceMatrices<double>&, const ArrayX<double>&,
                                                            std::complex<double>);
template class FrequencySweep<double>;

}  // namespace rollbem
