// The parts of solving a linear problem, which the library compiles for its users. Internal.
#pragma once

#include "../../detail/language.hpp"

#include "../../system/response.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// A factorised problem before its residual is known.
template <class Value>
struct Factorised {
    Response<Value> response;
    typename Response<Value>::Scalar norm;  ///< |A| in the maximum norm
    bool finite;                            ///< whether A, the unknowns and the coefficients are finite
};

/// Factorises A in place and solves A p = inputs.
template <class Value, class Scalar>
Factorised<Value> factorise(MatrixX<Value>& A, const MatrixX<Scalar>& inputs, const MatrixX<Scalar>& outputs);

/// The response with residual and status; `product` is the original A times the unknowns.
template <class Value, class Scalar>
Response<Value> judge(Factorised<Value> factorised, MatrixX<Value> product, const MatrixX<Scalar>& inputs);

template <class Value, class Scalar>
Response<Value> solve_copied(MatrixX<Value> A, const MatrixX<Scalar>& inputs, const MatrixX<Scalar>& outputs);

}  // namespace rollbem::detail
