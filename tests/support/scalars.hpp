// The library's large templates in float and long double, which tests of several headers use: compiled once, in
// scalars_float.cpp and scalars_long_double.cpp. ROLLBEM_SCALARS(extern, Scalar) declares the instantiations,
// ROLLBEM_SCALARS(, Scalar) defines them. Decompositions of Eigen that differ in nothing but rounding are not compiled
// in float.
#pragma once

#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/adhesion/steady.hpp>
#include <rollbem/adhesion/transient.hpp>
#include <rollbem/compiled/polynomial.hpp>

#include "support/friction_of_scalars.hpp"

#define ROLLBEM_SCALARS(keyword, Scalar)                                                            \
    keyword template decltype(detail::influence_matrix<Scalar>) detail::influence_matrix<Scalar>;   \
    keyword template decltype(detail::influence_product<Scalar>) detail::influence_product<Scalar>; \
    keyword template decltype(detail::factorise_steady<Scalar>) detail::factorise_steady<Scalar>;   \
    keyword template decltype(detail::judge_steady<Scalar>) detail::judge_steady<Scalar>;           \
    keyword template class AdhesionModel<1, Scalar>;                                                \
    keyword template decltype(rolled_and_steady<Scalar>) rolled_and_steady<Scalar>;

#define ROLLBEM_LONG_DOUBLE(keyword)                                                          \
    ROLLBEM_SCALARS(keyword, long double)                                                     \
    keyword template decltype(solve_exponential<long double>) solve_exponential<long double>; \
    keyword template class FrequencySweep<long double>;                                       \
    keyword template decltype(solve_stability<long double>) solve_stability<long double>;     \
    keyword template decltype(detail::solve_monomial_once<long double>) detail::solve_monomial_once<long double>;

namespace rollbem {

ROLLBEM_SCALARS(extern, float)
ROLLBEM_LONG_DOUBLE(extern)

}  // namespace rollbem
