// The scalar types in which tests of templates run: double, and with ROLLBEM_SLOW_CHECKS float and long double, too,
// which take long to compile. Then the large templates are compiled once for these, in scalars_float.cpp and
// scalars_long_double.cpp: ROLLBEM_SCALARS(extern, Scalar) declares the instantiations, ROLLBEM_SCALARS(, Scalar)
// defines them. What is little more than a decomposition of Eigen's is compiled for double alone.
#pragma once

#ifndef ROLLBEM_SLOW_CHECKS
#define SCALARS double
#else
#define SCALARS float, double, long double

#include <rollbem/steady/steady.hpp>

#define ROLLBEM_SCALARS(keyword, Scalar)                                                            \
    keyword template decltype(detail::influence_matrix<Scalar>) detail::influence_matrix<Scalar>;   \
    keyword template decltype(detail::influence_product<Scalar>) detail::influence_product<Scalar>; \
    keyword template decltype(detail::factorise<Scalar, Scalar>) detail::factorise<Scalar, Scalar>; \
    keyword template decltype(detail::judge<Scalar, Scalar>) detail::judge<Scalar, Scalar>;

namespace rollbem {

ROLLBEM_SCALARS(extern, float)
ROLLBEM_SCALARS(extern, long double)

}  // namespace rollbem

#endif
