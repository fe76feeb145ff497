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

extern template BalancedReduction balanced_reduction(const StateSpace&, Eigen::Index);
extern template bool detail::all_decay(const RollingSystem<double>&, double, double, double);
extern template StabilityResult detail::find_eigenvalues(const RollingSystem<double>&, bool);
extern template double condition_number(const MatrixX<double>&);
extern template UnstableCount count_unstable(const RollingSystem<double>&);

}  // namespace rollbem
