# rollbem::compiled: the library's largest templates compiled once for double, so that a program that includes
# rollbem/compiled/*.hpp instead of the headers themselves need not compile them. Optional: the headers suffice.
set(compiled_dir "${PROJECT_SOURCE_DIR}/include/rollbem/compiled")
add_library(rollbem_compiled STATIC)
foreach(part IN ITEMS assembly chebyshev steady frequency friction polynomial stability transient)
    target_sources(rollbem_compiled PRIVATE "${compiled_dir}/${part}.cpp")
endforeach()
add_library(rollbem::compiled ALIAS rollbem_compiled)
set_target_properties(rollbem_compiled PROPERTIES EXPORT_NAME compiled POSITION_INDEPENDENT_CODE ON)
target_link_libraries(rollbem_compiled PUBLIC rollbem)
if(TARGET rollbem_warnings)
    # not linked, so that the exported target does not name it
    target_compile_options(rollbem_compiled PRIVATE $<TARGET_PROPERTY:rollbem_warnings,INTERFACE_COMPILE_OPTIONS>)
endif()
