// Friction: FrictionModel and its workspace; systems of two directions.
#include <rollbem/friction/impl/model.ipp>

namespace rollbem {
template void detail::eliminate_in_place<double>(detail::MatrixRef<double>, Eigen::Index*, Eigen::Index);
template void detail::eliminate_vector_in_place<double>(const detail::MatrixRef<double>&, const Eigen::Index*,
                                                        Eigen::Index, detail::VectorRef<double>);
template void detail::substitute_in_place<double>(const detail::MatrixRef<double>&, Eigen::Index,
                                                  detail::VectorRef<double>);
template void detail::solve_columns_in_place<double>(const detail::MatrixRef<double>&, const Eigen::Index*,
                                                     detail::MatrixRef<double>);
template void detail::invert_factors<double>(const detail::MatrixRef<double>&, const Eigen::Index*,
                                             detail::MatrixRef<double>);
template bool is_dissipative<double>(MatrixX<double>, const ArrayX<double>&);
template bool detail::converges<double>(MatrixX<double>, const ArrayX<double>&, double);
template bool detail::converges<double>(const detail::DirectionBlocks<double>&, const ArrayX<double>&);
template void detail::require_usable_in_time<double>(const char*, const ElementSystem<double, 2>&,
                                                     const StabilityVerdict&);
template void detail::require_blocks<double>(const char*, const char*, const detail::DirectionBlocks<double>&,
                                             Eigen::Index);
template MatrixX<double> detail::joined<double>(const detail::DirectionBlocks<double>&);
template MatrixX<double> detail::rigid_slip<double>(const Elements<double>&);
template MatrixX<double> detail::force_weights<double>(const Elements<double>&);
template class ElementSystem<double, 2>;
}  // namespace rollbem
