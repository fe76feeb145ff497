# rollbem::compiled: the library's largest templates compiled once for double, so that a program that includes
# rollbem/compiled/*.hpp instead of the headers themselves need not compile them. Optional: the headers suffice.
# Each of these headers lists templates as `extern template ...;`; its source, made here, is the same list without
# `extern`. It spares a unit the members that are defined outside their class: those inside are inline, and compilers
# instantiate them in every unit that calls them.
# compile_headers(name part...) makes compiled/name.cpp of those headers and sets name_source. Parts that use the same of
# Eigen's decompositions are cheaper to compile together.
function(compile_headers name)
    set(text "")
    foreach(part IN LISTS ARGN)
        set(header "${PROJECT_SOURCE_DIR}/include/rollbem/compiled/${part}.hpp")
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${header}")
        file(READ "${header}" list)
        string(FIND "${list}" "\nnamespace " start)
        string(SUBSTRING "${list}" ${start} -1 list)
        string(REPLACE "extern template" "template" list "${list}")
        string(APPEND text "#include <rollbem/compiled/${part}.hpp>\n${list}")
    endforeach()
    set(source "${PROJECT_BINARY_DIR}/compiled/${name}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "${text}" @ONLY)
    set(${name}_source "${source}" PARENT_SCOPE)
endfunction()
compile_headers(steady assembly lu steady)
compile_headers(eigenvalues balanced_reduction decompositions monomial stability)
compile_headers(line chebyshev frequency rolling_system transient)
compile_headers(friction friction stick_border)
compile_headers(patch patch)
compile_headers(table creep_force_table)

# Objects of their own: what steady rolling needs, and the rest. steady_study links only the former.
add_library(rollbem_compiled_steady OBJECT "${steady_source}")
add_library(rollbem_compiled STATIC
    "${eigenvalues_source}" "${line_source}" "${friction_source}" "${patch_source}" "${table_source}"
    $<TARGET_OBJECTS:rollbem_compiled_steady>)
add_library(rollbem::compiled ALIAS rollbem_compiled)
set_target_properties(rollbem_compiled PROPERTIES EXPORT_NAME compiled)
foreach(target IN ITEMS rollbem_compiled_steady rollbem_compiled)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_link_libraries(${target} PUBLIC rollbem)
    if(TARGET rollbem_warnings)
        # not linked, so that the exported target does not name it
        target_compile_options(${target} PRIVATE $<TARGET_PROPERTY:rollbem_warnings,INTERFACE_COMPILE_OPTIONS>)
    endif()
endforeach()
