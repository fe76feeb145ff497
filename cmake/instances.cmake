# The library's largest templates, compiled once for double, so that every program, test and benchmark of this project
# need not compile them again: rollbem_instances_steady what any study needs, rollbem_instances the rest, too. Not
# installed: to others the library is headers alone.
set(instances "${PROJECT_SOURCE_DIR}/apps/support/instances")
add_library(rollbem_instances_steady STATIC "${instances}/assembly.cpp")
target_compile_definitions(rollbem_instances_steady PUBLIC ROLLBEM_INSTANCES)
target_link_libraries(rollbem_instances_steady PUBLIC rollbem::rollbem PRIVATE rollbem_warnings)

add_library(rollbem_instances STATIC
    "${instances}/frequency.cpp" "${instances}/friction.cpp" "${instances}/stability.cpp" "${instances}/transient.cpp")
target_link_libraries(rollbem_instances PUBLIC rollbem_instances_steady PRIVATE rollbem_warnings)
