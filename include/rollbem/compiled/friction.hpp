// Friction, and the makers of systems and pressures, compiled for double. Replaces friction/model.hpp,
// assembly/patch_system.hpp and the headers of normal/ for pressures and loads; link rollbem::compiled.
#pragma once

#include <array>
#include <vector>

#include "../assembly/patch_system.hpp"
#include "../detail/in_place_lu.hpp"
#include "../friction/law.hpp"
#include "../friction/model.hpp"
#include "../normal/hertz.hpp"
#include "../normal/hertz_ellipse.hpp"
#include "../normal/hertz_load.hpp"
#include "../normal/load.hpp"
#include "../normal/pressure_grid.hpp"
#include "../normal/pressure_table.hpp"
#include "../system/time_domain.hpp"
#include "steady.hpp"

namespace rollbem {

extern template void detail::eliminate_in_place<double>(detail::MatrixRef<double>, Eigen::Index*, Eigen::Index);
extern template void detail::eliminate_vector_in_place<double>(const detail::MatrixRef<double>&, const Eigen::Index*,
                                                               Eigen::Index, detail::VectorRef<double>);
extern template void detail::substitute_in_place<double>(const detail::MatrixRef<double>&, Eigen::Index,
                                                         detail::VectorRef<double>);
extern template void detail::solve_columns_in_place<double>(const detail::MatrixRef<double>&, const Eigen::Index*,
                                                            detail::MatrixRef<double>);
extern template void detail::invert_factors<double>(const detail::MatrixRef<double>&, const Eigen::Index*,
                                                    detail::MatrixRef<double>);
extern template bool is_dissipative<double>(MatrixX<double>, const ArrayX<double>&);
extern template bool detail::converges<double>(MatrixX<double>, const ArrayX<double>&, double);
extern template bool detail::converges<double>(const detail::DirectionBlocks<double>&, const ArrayX<double>&);
extern template void detail::require_blocks<double>(const char*, const char*, const detail::DirectionBlocks<double>&,
                                                    Eigen::Index);
extern template MatrixX<double> detail::joined<double>(const detail::DirectionBlocks<double>&);
extern template void detail::require_usable_in_time<double>(const char*, const ElementSystem<double, 2>&,
                                                            const StabilityVerdict&);
extern template MatrixX<double> detail::rigid_slip<double>(const Elements<double>&);
extern template MatrixX<double> detail::force_weights<double>(const Elements<double>&);
extern template class ElementSystem<double, 2>;

}  // namespace rollbem
