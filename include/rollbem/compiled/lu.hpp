// Eigen's LU decomposition of matrices of double, compiled. Link rollbem::compiled.
#pragma once

#include "../detail/language.hpp"

#include <Eigen/LU>

namespace Eigen {

extern template class PartialPivLU<MatrixXd>;

}  // namespace Eigen
