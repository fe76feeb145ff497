// Checks the language standard before anything else: without it an older compiler mode would report errors in every
// line of every header. Headers that include no other header of the library include this one, so that each header
// reaches it before its own code.
#pragma once

// Microsoft's compiler keeps __cplusplus at 199711 by default; _MSVC_LANG holds the standard in use.
#if (defined(_MSVC_LANG) && _MSVC_LANG <= 201703L) || (!defined(_MSVC_LANG) && __cplusplus <= 201703L)
#error "rollbem needs C++20: compile with -std=c++20 (MSVC: /std:c++20), or in CMake link rollbem::rollbem"
#include <C++20>  // no such file exists: the missing include stops every compiler
#endif
