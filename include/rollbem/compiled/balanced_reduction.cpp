#include "balanced_reduction.hpp"

namespace rollbem {

template BalancedReduction<double> balanced_reduction<double>(const StateSpace<double>&, Eigen::Index);

}  // namespace rollbem
