#include "steady.hpp"

namespace rollbem {

template detail::FactorisedSteady<double> detail::factorise_steady<double>(MatrixX<double>&, const ArrayX<double>&);
template UnitSteadySolution<double> detail::judge_steady<double>(detail::FactorisedSteady<double>,
                                                                 const ArrayX<double>&, const VectorX<double>&);

}  // namespace rollbem
