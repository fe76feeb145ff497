// Eigenvalues compiled for double. Replaces adhesion/stability.hpp and adhesion/stability_count.hpp; link
// rollbem::compiled.
#pragma once

#include "../adhesion/stability.hpp"
#include "../adhesion/stability_count.hpp"
#include "decompositions.hpp"
#include "rolling_system.hpp"

namespace rollbem {

extern template StabilityResult<double> solve_stability<double>(const RollingSystem<double>&, StabilityOptions);
extern template UnstableCount<double> count_unstable<double>(const RollingSystem<double>&);

}  // namespace rollbem
