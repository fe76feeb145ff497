// Steady rolling compiled for double. Replaces adhesion/steady.hpp; link rollbem::compiled.
#pragma once

#include "../adhesion/steady.hpp"
#include "assembly.hpp"

namespace rollbem {

extern template detail::FactorisedSteady<double> detail::factorise_steady<double>(MatrixX<double>&,
                                                                                  const ArrayX<double>&);
extern template SteadySolution<double> solve_steady<double>(MatrixX<double>, const ArrayX<double>&);
extern template SteadySolution<double> detail::judge_steady<double>(detail::FactorisedSteady<double>,
                                                                    const ArrayX<double>&, const VectorX<double>&);

}  // namespace rollbem
