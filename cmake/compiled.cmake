# rollbem::compiled: bodies of headers, and the library's largest templates for double, compiled once. Optional: the
# headers suffice. A program that links it defines ROLLBEM_COMPILED and includes the same headers: those that end with
# impl/NAME.ipp then leave their bodies to the library, cmake/units/*.cpp.
# What stays a template, impl/NAME.tpp, is instantiated there for double, and declared so at the ends of its headers.

# The linker names the version that a unit was compiled for, see decl.hpp.
set(decl "${PROJECT_SOURCE_DIR}/include/rollbem/detail/decl.hpp")
file(STRINGS "${decl}" named REGEX "^int rollbem_compiled_${PROJECT_VERSION_MAJOR}_${PROJECT_VERSION_MINOR}_is_missing")
if(NOT named)
    message(FATAL_ERROR "${decl} and cmake/units/alignment.cpp name another version than ${PROJECT_VERSION}.")
endif()

# Objects of their own: what steady rolling needs, and the rest. steady_study links only the former.
set(units "${PROJECT_SOURCE_DIR}/cmake/units")
add_library(rollbem_compiled_steady OBJECT "${units}/alignment.cpp" "${units}/steady.cpp")
add_library(rollbem_compiled STATIC
    "${units}/adhesion.cpp" "${units}/contacts.cpp" "${units}/friction.cpp" "${units}/loads.cpp" "${units}/making.cpp"
    "${units}/patch.cpp" "${units}/tables.cpp" "${units}/wheelset.cpp"
    $<TARGET_OBJECTS:rollbem_compiled_steady>)
add_library(rollbem::compiled ALIAS rollbem_compiled)
set_target_properties(rollbem_compiled PROPERTIES EXPORT_NAME compiled)
foreach(target IN ITEMS rollbem_compiled_steady rollbem_compiled)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_link_libraries(${target} PUBLIC rollbem)
    target_compile_definitions(${target} PUBLIC ROLLBEM_COMPILED)
    if(TARGET rollbem_warnings)
        # not linked, so that the exported target does not name it
        target_compile_options(${target} PRIVATE $<TARGET_PROPERTY:rollbem_warnings,INTERFACE_COMPILE_OPTIONS>
            $<$<NOT:$<CXX_COMPILER_ID:MSVC>>:-Wsign-conversion>)  # with clang a part of -Wconversion
    endif()
endforeach()
