// Balanced reduction compiled for double. Replaces adhesion/balanced_reduction.hpp; link rollbem::compiled.
#pragma once

#include "../adhesion/balanced_reduction.hpp"
#include "decompositions.hpp"

namespace rollbem {

extern template BalancedReduction<double> balanced_reduction<double>(const StateSpace<double>&, Eigen::Index);

}  // namespace rollbem
