// The language that the library is written in, asked for before anything else: without it the compiler would report
// every header's every line. Each header includes this one first.
#pragma once

// Microsoft's compiler keeps __cplusplus at 199711 unless told otherwise and tells the truth in _MSVC_LANG.
#if (defined(_MSVC_LANG) && _MSVC_LANG <= 201703L) || (!defined(_MSVC_LANG) && __cplusplus <= 201703L)
#error "rollbem needs C++20: compile with -std=c++20 (MSVC: /std:c++20), or in CMake link rollbem::rollbem"
#include <C++20>  // there is no such file: the one thing after which compilers stop
#endif
