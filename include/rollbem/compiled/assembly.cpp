#include "assembly.hpp"

namespace rollbem {

template MatrixX<double> detail::influence_matrix<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                          const detail::KernelView<double>&, Quantity);
template VectorX<double> detail::influence_product<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                           const detail::KernelView<double>&, Quantity,
                                                           const VectorX<double>&);

}  // namespace rollbem
