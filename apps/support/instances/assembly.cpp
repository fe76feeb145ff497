// G, G' and the steady solution compiled for double.
#include <rollbem/adhesion/steady.hpp>

namespace rollbem {

template MatrixX<double> detail::influence_matrix<double>(const Mesh<double>&, const detail::Sampling<double>&,
                                                          Eigen::Index, Eigen::Index, const detail::KernelView<double>&,
                                                          detail::Quantity);
template VectorX<double> detail::influence_product<double>(const Mesh<double>&, const detail::Sampling<double>&,
                                                           Eigen::Index, const detail::KernelView<double>&,
                                                           detail::Quantity, const VectorX<double>&);
template UnitSteadySolution<double> detail::solve_steady_in_place<double>(
    Eigen::Ref<MatrixX<double>>, const ArrayX<double>&, const std::function<VectorX<double>(const VectorX<double>&)>&);

}  // namespace rollbem
