// How bodies are compiled. Without ROLLBEM_COMPILED every header includes its bodies, impl/*.ipp, as inline functions;
// with it they come from the library rollbem::compiled, whose CMake target defines the macro for its users.
#pragma once

#include "language.hpp"

#ifdef ROLLBEM_COMPILED

#define ROLLBEM_DECL

#include <Eigen/Core>

namespace rollbem {

/// Defined in rollbem::compiled for its own alignment, EIGEN_MAX_ALIGN_BYTES and EIGEN_MAX_STATIC_ALIGN_BYTES, which
/// follow flags such as -mavx and -march=native. A unit that lays out or frees matrices differently from the library
/// would crash; the linker names this function instead.
template <int largest, int largest_static>
int rollbem_compiled_0_4_is_missing_or_has_another_eigen_alignment_use_the_same_m_flags();

namespace detail {

/// Refers to the function in every unit, whatever the optimiser drops.
inline const int alignment_is_that_of_compiled =
    rollbem_compiled_0_4_is_missing_or_has_another_eigen_alignment_use_the_same_m_flags<EIGEN_MAX_ALIGN_BYTES,
                                                                                        EIGEN_MAX_STATIC_ALIGN_BYTES>();

}  // namespace detail

}  // namespace rollbem

#else
#define ROLLBEM_DECL inline
#endif
