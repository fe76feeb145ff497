# Warnings for the programs and tests of this project; never exported.
add_library(rollbem_warnings INTERFACE)
if(MSVC)
    target_compile_options(rollbem_warnings INTERFACE /W4 $<$<BOOL:${ROLLBEM_WARNINGS_AS_ERRORS}>:/WX>)
else()
    target_compile_options(rollbem_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
        $<$<BOOL:${ROLLBEM_WARNINGS_AS_ERRORS}>:-Werror>
        # g++ 12 sees uninitialised and overlapping strings inside std::variant and std::string where there are none
        $<$<CXX_COMPILER_ID:GNU>:-Wno-error=maybe-uninitialized -Wno-error=restrict>)
endif()
