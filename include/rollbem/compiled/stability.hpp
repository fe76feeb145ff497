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

namespace rollbem {}  // namespace rollbem
