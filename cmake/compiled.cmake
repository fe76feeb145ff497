# rollbem::compiled: the library's largest templates compiled once for double, so that a program that includes
# rollbem/compiled/*.hpp instead of the headers themselves need not compile them. Optional: the headers suffice.
# Each of these headers lists templates as `extern template ...;`; its source, made here, is the same list without
# `extern`. It spares a unit the members that are defined outside their class: those inside are inline, and compilers
# instantiate them in every unit that calls them. Whatever a plain inline function calls is instantiated even where
# nobody calls the function: that is why functions of double alone are templates of `std::same_as<double>`.
# compile_header(name) makes compiled/name.cpp of it and sets name_source.
function(compile_header name)
    set(header "${PROJECT_SOURCE_DIR}/include/rollbem/compiled/${name}.hpp")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${header}")
    file(READ "${header}" list)
    string(FIND "${list}" "\nnamespace " start)
    string(SUBSTRING "${list}" ${start} -1 list)
    string(REPLACE "extern template" "template" list "${list}")
    set(text "#include <rollbem/compiled/${name}.hpp>\n${list}")
    set(source "${PROJECT_BINARY_DIR}/compiled/${name}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "${text}" @ONLY)
    set(${name}_source "${source}" PARENT_SCOPE)
endfunction()
foreach(name IN ITEMS steady adhesion stability friction patch creep_force_table wheelset studies)
    compile_header(${name})
endforeach()

# The function by which the linker refuses units with another alignment, see the header.
set(alignment_source "${PROJECT_BINARY_DIR}/compiled/alignment.cpp")
set(same_alignment rollbem_compiled_has_another_eigen_alignment_compile_both_with_the_same_m_flags)
file(CONFIGURE OUTPUT "${alignment_source}" @ONLY CONTENT
"#include <rollbem/compiled/detail/alignment.hpp>

template <int largest, int largest_static>
int rollbem::@same_alignment@() {
    return largest;
}
template int rollbem::@same_alignment@<EIGEN_MAX_ALIGN_BYTES, EIGEN_MAX_STATIC_ALIGN_BYTES>();
")

# Objects of their own: what steady rolling needs, and the rest. steady_study links only the former.
add_library(rollbem_compiled_steady OBJECT "${steady_source}" "${alignment_source}")
add_library(rollbem_compiled STATIC
    "${adhesion_source}" "${stability_source}" "${friction_source}" "${patch_source}" "${creep_force_table_source}"
    "${wheelset_source}" "${studies_source}"
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
