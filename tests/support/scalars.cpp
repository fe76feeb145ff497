#include "scalars.hpp"

namespace rollbem {

template MatrixX<float> detail::influence_matrix<float>(const Mesh<float>&, const detail::Sampling<float>&,
                                                        Eigen::Index, Eigen::Index, const detail::KernelView<float>&,
                                                        detail::Quantity);
template VectorX<float> detail::influence_product<float>(const Mesh<float>&, const detail::Sampling<float>&,
                                                         Eigen::Index, const detail::KernelView<float>&,
                                                         detail::Quantity, const VectorX<float>&);
template MatrixX<long double> detail::influence_matrix<long double>(const Mesh<long double>&,
                                                                    const detail::Sampling<long double>&, Eigen::Index,
                                                                    Eigen::Index,
                                                                    const detail::KernelView<long double>&,
                                                                    detail::Quantity);
template VectorX<long double> detail::influence_product<long double>(const Mesh<long double>&,
                                                                     const detail::Sampling<long double>&, Eigen::Index,
                                                                     const detail::KernelView<long double>&,
                                                                     detail::Quantity, const VectorX<long double>&);

}  // namespace rollbem
