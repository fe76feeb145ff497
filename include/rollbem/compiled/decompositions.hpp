// Eigen's decompositions that the library uses and its users often need, compiled for matrices of double and of complex
// double. Link rollbem::compiled.
#pragma once

#include <Eigen/Eigenvalues>

#include "lu.hpp"

namespace Eigen {

extern template class PartialPivLU<MatrixXcd>;
extern template class EigenSolver<MatrixXd>;
extern template EigenSolver<MatrixXd>& EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&, bool);

}  // namespace Eigen
