// G, G' and the steady solution compiled for double.
#include <rollbem/adhesion/steady.hpp>

namespace rollbem {

template MatrixX<double> detail::influence_matrix<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                          const detail::KernelView<double>&, Quantity);
template VectorX<double> detail::influence_product<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                           const detail::KernelView<double>&, Quantity,
                                                           const VectorX<double>&);
template detail::FactorisedSteady<double> detail::factorise_steady<double>(MatrixX<double>&, const ArrayX<double>&);
template UnitSteadySolution<double> detail::judge_steady<double>(detail::FactorisedSteady<double>,
                                                                 const ArrayX<double>&, const VectorX<double>&);

}  // namespace rollbem
