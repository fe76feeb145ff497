# Options for the programs and tests of this project; never exported.
add_library(rollbem_warnings INTERFACE)
if(MSVC)
    target_compile_options(rollbem_warnings INTERFACE /W4 $<$<BOOL:${ROLLBEM_WARNINGS_AS_ERRORS}>:/WX>)
else()
    target_compile_options(rollbem_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
        $<$<BOOL:${ROLLBEM_WARNINGS_AS_ERRORS}>:-Werror>
        # g++ 12 warns falsely of uninitialised and overlapping strings inside std::variant and std::string
        $<$<CXX_COMPILER_ID:GNU>:-Wno-error=maybe-uninitialized -Wno-error=restrict>
        # 15 % less compile time: g++ collects garbage rarely, at up to 1 GB a unit
        $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=500000>)
endif()

# For programs that are not timed: -O1 in a Release build, because compiling takes far longer than running.
add_library(rollbem_quick_to_compile INTERFACE)
target_link_libraries(rollbem_quick_to_compile INTERFACE rollbem_warnings)
if(NOT MSVC)
    target_compile_options(rollbem_quick_to_compile INTERFACE $<$<CONFIG:Release>:-O1>)
endif()
