// Solves linear problems in full adhesion for systems and ready matrices: steady rolling, G' p = inputs, Eq. (15), and
// the response to e^{st}, (G' - s G) p = inputs, Eq. (16).
#pragma once

#include "../detail/decl.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <type_traits>

#include <Eigen/LU>

#include "../system/response.hpp"
#include "../system/rolling_system.hpp"
#include "../types.hpp"
#include "detail/factorised.hpp"

namespace rollbem {

/// Steady rolling: G' p = inputs, for ready matrices (G' n x n in units of 1/G, inputs and outputs n x k). G' is passed
/// by value: the factors overwrite it. Throws std::invalid_argument if sizes do not fit.
template <class Scalar>
Response<Scalar> solve_steady(MatrixX<Scalar> G_prime, const MatrixX<Scalar>& inputs, const MatrixX<Scalar>& outputs);

/// Steady rolling: G' p = 1, for elements of these widths (in units of a), whose tractions must oppose the creepage.
/// Throws std::invalid_argument unless G' is square with as many columns as there are widths.
template <class Scalar>
Response<Scalar> solve_steady(MatrixX<Scalar> G_prime, const ArrayX<Scalar>& widths);

/// Steady rolling of a system: tractions must oppose the creepage, other unknowns may have either sign.
template <class Scalar>
Response<Scalar> solve_steady(const RollingSystem<Scalar>& system);

/// Response to creepages e^{st}, Eq. (16), for any complex s in units of V/a; s = i omega a/V for harmonic creepage, of
/// either sign. Status::assists_creepage if the tractions of steady rolling do not oppose the first creepage. Throws
/// std::invalid_argument if s is not finite.
template <class Scalar>
Response<std::complex<Scalar>> solve_response(const RollingSystem<Scalar>& system,
                                              std::type_identity_t<std::complex<Scalar>> s);

}  // namespace rollbem

#include "impl/response.tpp"

#ifdef ROLLBEM_COMPILED
namespace Eigen {
extern template void PartialPivLU<MatrixXd>::compute();
extern template void PartialPivLU<Ref<MatrixXcd>>::compute();
}  // namespace Eigen
namespace rollbem {
extern template decltype(detail::factorise<double, double>) detail::factorise<double, double>;
extern template decltype(detail::judge<double, double>) detail::judge<double, double>;
extern template decltype(detail::solve_copied<double, double>) detail::solve_copied<double, double>;
extern template decltype(detail::factorise<std::complex<double>, double>)
    detail::factorise<std::complex<double>, double>;
extern template decltype(detail::judge<std::complex<double>, double>) detail::judge<std::complex<double>, double>;
extern template decltype(detail::solve_copied<std::complex<double>, double>)
    detail::solve_copied<std::complex<double>, double>;
extern template Response<std::complex<double>> solve_response<double>(const RollingSystem<double>&,
                                                                      std::complex<double>);
}  // namespace rollbem
#endif
