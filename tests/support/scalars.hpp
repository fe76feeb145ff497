// The integrals of G and G' in float and long double, which several tests use: compiled once, in scalars.cpp.
#pragma once

#include "rollbem/assembly/influence.hpp"

namespace rollbem {

extern template MatrixX<float> detail::influence_matrix<float>(const Mesh<float>&, const detail::Sampling<float>&,
                                                               Eigen::Index, Eigen::Index,
                                                               const detail::KernelView<float>&, detail::Quantity);
extern template VectorX<float> detail::influence_product<float>(const Mesh<float>&, const detail::Sampling<float>&,
                                                                Eigen::Index, const detail::KernelView<float>&,
                                                                detail::Quantity, const VectorX<float>&);
extern template MatrixX<long double> detail::influence_matrix<long double>(const Mesh<long double>&,
                                                                           const detail::Sampling<long double>&,
                                                                           Eigen::Index, Eigen::Index,
                                                                           const detail::KernelView<long double>&,
                                                                           detail::Quantity);
extern template VectorX<long double> detail::influence_product<long double>(
    const Mesh<long double>&, const detail::Sampling<long double>&, Eigen::Index,
    const detail::KernelView<long double>&, detail::Quantity, const VectorX<long double>&);

}  // namespace rollbem
