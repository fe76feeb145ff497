#include "stability.hpp"

namespace rollbem {

template StabilityResult<double> solve_stability<double>(const InfluenceMatrices<double>&, StabilityOptions);
template UnstableCount<double> count_unstable<double>(const InfluenceMatrices<double>&);

}  // namespace rollbem
