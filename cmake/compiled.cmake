# rollbem::compiled: the library's largest templates compiled once for double, so that a program that includes
# rollbem/compiled/*.hpp instead of the headers themselves need not compile them. Optional: the headers suffice.
# Each of these headers lists templates as `extern template ...;`; its source, made here, is the same list without
# `extern`. It spares a unit the members that are defined outside their class: those inside are inline, and compilers
# instantiate them in every unit that calls them.
file(GLOB compiled_headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/include/rollbem/compiled/*.hpp")
list(FILTER compiled_headers EXCLUDE REGEX "/all\\.hpp$")
set(compiled_sources "")
foreach(header IN LISTS compiled_headers)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${header}")
    get_filename_component(part "${header}" NAME_WE)
    file(READ "${header}" text)
    string(FIND "${text}" "\nnamespace rollbem {" start)
    string(SUBSTRING "${text}" ${start} -1 text)
    string(REPLACE "extern template" "template" text "${text}")
    set(source "${PROJECT_BINARY_DIR}/compiled/${part}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "#include <rollbem/compiled/${part}.hpp>\n${text}" @ONLY)
    list(APPEND compiled_sources "${source}")
endforeach()

# Objects of their own: what steady rolling needs, and the rest. steady_study links only the former.
set(steady_sources ${compiled_sources})
list(FILTER steady_sources INCLUDE REGEX "/(assembly|steady)\\.cpp$")
list(REMOVE_ITEM compiled_sources ${steady_sources})
add_library(rollbem_compiled_steady OBJECT ${steady_sources})
add_library(rollbem_compiled STATIC ${compiled_sources} $<TARGET_OBJECTS:rollbem_compiled_steady>)
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
