# add_precompiled(target HEADERS header... LIBRARIES library...)
# headers parsed once, for target_precompile_headers(... REUSE_FROM target), whose optimisation must be the same: g++
# accepts another and generates code that is as slow. Sources still include what they need: with
# ccache, which does not cache units that use a precompiled header, and in the stricter presets there are none.
if("${CMAKE_CXX_COMPILER_LAUNCHER} ${CMAKE_CXX_COMPILER}" MATCHES ccache)
    set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()
function(add_precompiled target)
    cmake_parse_arguments(PARSE_ARGV 1 precompiled "" "" "HEADERS;LIBRARIES")
    set(nothing "${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp")
    file(CONFIGURE OUTPUT "${nothing}" CONTENT "" @ONLY)
    add_library(${target} OBJECT "${nothing}")
    target_link_libraries(${target} PRIVATE ${precompiled_LIBRARIES})
    target_precompile_headers(${target} PRIVATE ${precompiled_HEADERS})
endfunction()

# compile_as_one(target)
# compiles all sources of the target as one unit, which takes less time, except where precompiled headers are off:
# ccache and the stricter presets see each source alone.
function(compile_as_one target)
    if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    endif()
endfunction()

# none of this library's own, so that a change of one compiles again only what includes it
set(rollbem_precompiled_headers
    <algorithm> <array> <cmath> <complex> <cstddef> <functional> <limits> <map> <memory> <numbers> <optional> <string>
    <utility> <variant> <vector> <Eigen/Core> <Eigen/LU>)
