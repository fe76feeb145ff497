# Finds what the chosen options need, with a message that says how to install it.

macro(rollbem_find package needed_by)
    find_package(${package} ${ARGN} QUIET)
    if(NOT ${package}_FOUND)
        message(FATAL_ERROR "rollbem: ${package} not found, which ${needed_by} needs. "
            "`sh cmake/deps.sh` installs it; ROLLBEM_BUILD_APPS, ROLLBEM_BUILD_TESTS and ROLLBEM_BUILD_BENCHMARKS "
            "switch off what needs more than Eigen.")
    endif()
endmacro()

# Requested without a version: Eigen 5 declares itself incompatible with a request for 3.4.
if(NOT TARGET Eigen3::Eigen)
    rollbem_find(Eigen3 "the library" CONFIG)
    if(Eigen3_VERSION VERSION_LESS 3.4)
        message(FATAL_ERROR "rollbem: Eigen ${Eigen3_VERSION} in ${Eigen3_DIR} is too old; 3.4 or later is needed.")
    endif()
endif()

if(ROLLBEM_BUILD_APPS OR ROLLBEM_BUILD_TESTS OR ROLLBEM_BUILD_BENCHMARKS)
    rollbem_find(GSL "every program and test")
    rollbem_find(Threads "every program and test")
else()
    find_package(GSL QUIET)
endif()
if(ROLLBEM_BUILD_APPS OR ROLLBEM_BUILD_TESTS)
    rollbem_find(CLI11 "every study program" CONFIG)
endif()
if(ROLLBEM_BUILD_BENCHMARKS)
    rollbem_find(benchmark "every benchmark" CONFIG)
endif()
if(ROLLBEM_BUILD_TESTS)
    rollbem_find(Catch2 "every test" CONFIG)
endif()
