#include "stability.hpp"

namespace rollbem {

template StabilityResult<double> solve_stability<double>(const RollingSystem<double>&, StabilityOptions);
template UnstableCount<double> count_unstable<double>(const RollingSystem<double>&);

}  // namespace rollbem
