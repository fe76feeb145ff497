// Eigenvalues and balanced reduction compiled for double, with the decompositions of Eigen that they use. Replaces
// adhesion/balanced_reduction.hpp, adhesion/stability.hpp and adhesion/stability_count.hpp; link rollbem::compiled.
#pragma once

#include <Eigen/Eigenvalues>

#include "../adhesion/balanced_reduction.hpp"
#include "../adhesion/stability.hpp"
#include "../adhesion/stability_count.hpp"
#include "steady.hpp"

namespace Eigen {

extern template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);

}  // namespace Eigen

namespace rollbem {

extern template BalancedReduction<double> balanced_reduction<double>(const StateSpace<double>&, Eigen::Index);
extern template bool detail::all_decay<double>(const RollingSystem<double>&, double, double, double);
extern template StabilityResult<double> detail::find_eigenvalues<double>(const RollingSystem<double>&, bool);
extern template double condition_number<double>(const MatrixX<double>&);
extern template UnstableCount<double> count_unstable<double>(const RollingSystem<double>&);

}  // namespace rollbem
