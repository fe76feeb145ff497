// Steady rolling of elements with full adhesion: G' p = xi, Eq. (15), and the creep coefficient c11 of Eq. (30).
// Builds G' alone and factorises it in place.
#pragma once

#include "../adhesion/response.hpp"
#include "../assembly/rolling_system.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../types.hpp"

namespace rollbem {

/// Assembles and solves for unit creepage, dimensionless (a = G = 1), by a RollingScheme and with a LineKernel. Above
/// 1000 elements the memory is one matrix and a multiple of n (for Galerkin by quadrature two matrices). Throws
/// std::invalid_argument if the scheme does not fit the mesh.
template <class Scalar, class Scheme, class Kernel>
Response<Scalar> solve_steady(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel);

}  // namespace rollbem

#include "impl/steady.tpp"
