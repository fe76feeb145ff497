# rollbem_instances: the library's largest templates, compiled once for double, so that every program, test and
# benchmark of this project need not compile them again. Not installed: to others the library is headers alone.
add_library(rollbem_instances STATIC)
foreach(part IN ITEMS assembly friction stability)
    target_sources(rollbem_instances PRIVATE "${PROJECT_SOURCE_DIR}/apps/support/instances/${part}.cpp")
endforeach()
target_compile_definitions(rollbem_instances PUBLIC ROLLBEM_INSTANCES)
target_link_libraries(rollbem_instances PUBLIC rollbem::rollbem PRIVATE rollbem_warnings)
