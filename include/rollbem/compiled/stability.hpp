// Eigenvalues compiled for double: in place of problem/stability.hpp and problem/stability_count.hpp, with
// rollbem::compiled.
#pragma once

#include "../problem/stability.hpp"
#include "../problem/stability_count.hpp"
#include "assembly.hpp"

namespace rollbem {

extern template StabilityResult<double> solve_stability<double>(const InfluenceMatrices<double>&, StabilityOptions);
extern template UnstableCount<double> count_unstable<double>(const InfluenceMatrices<double>&);

}  // namespace rollbem
