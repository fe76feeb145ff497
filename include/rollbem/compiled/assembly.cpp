#include "assembly.hpp"

namespace rollbem {

template MatrixX<double> detail::influence_matrix<double>(const Mesh<double>&, const detail::Sampling<double>&,
                                                          Eigen::Index, Eigen::Index, const detail::KernelView<double>&,
                                                          detail::Quantity);
template VectorX<double> detail::influence_product<double>(const Mesh<double>&, const detail::Sampling<double>&,
                                                           Eigen::Index, const detail::KernelView<double>&,
                                                           detail::Quantity, const VectorX<double>&);

}  // namespace rollbem
