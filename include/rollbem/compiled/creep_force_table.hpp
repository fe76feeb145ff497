// The table of creep forces, compiled for double. Replaces vehicle/creep_force_table.hpp; link rollbem::compiled.
#pragma once

#include "../vehicle/creep_force_table.hpp"
#include "detail/alignment.hpp"

namespace rollbem {

extern template class detail::BasicCreepForceTable<double>;
extern template class detail::CreepForceCube<double>;

}  // namespace rollbem
