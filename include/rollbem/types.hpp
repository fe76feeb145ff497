// The column and matrix types used throughout the library. Arrays work element by element, vectors and matrices as in
// linear algebra.
#pragma once

#include "detail/language.hpp"

#include <Eigen/Core>

namespace rollbem {

template <class Scalar>
using ArrayX = Eigen::Array<Scalar, Eigen::Dynamic, 1>;
template <class Scalar>
using VectorX = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
template <class Scalar>
using MatrixX = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

}  // namespace rollbem
