# rollbem_app_support: what every study program and every test of apps/support needs, with facts about the build in
# <build_info.hpp>. The git revision is determined at each build; when it changes, one small file is recompiled.
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type_upper)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type_upper}}" build_info_flags)
string(REPLACE "\\" "\\\\" build_info_flags "${build_info_flags}")
string(REPLACE "\"" "\\\"" build_info_flags "${build_info_flags}")
set(generated_dir "${PROJECT_BINARY_DIR}/generated")
configure_file(cmake/build_info.hpp.in "${generated_dir}/build_info.hpp" @ONLY)

add_custom_target(rollbem_git_revision
    COMMAND ${CMAKE_COMMAND}
        "-DSOURCE_DIR=${PROJECT_SOURCE_DIR}"
        "-DOUTPUT=${generated_dir}/git_revision.cpp"
        -P "${PROJECT_SOURCE_DIR}/cmake/git_revision.cmake"
    BYPRODUCTS "${generated_dir}/git_revision.cpp"
    VERBATIM)

add_library(rollbem_build_info STATIC "${generated_dir}/git_revision.cpp")
add_dependencies(rollbem_build_info rollbem_git_revision)
target_compile_features(rollbem_build_info PUBLIC cxx_std_20)
target_include_directories(rollbem_build_info PUBLIC "${generated_dir}")
target_link_libraries(rollbem_build_info PRIVATE rollbem_warnings)

# What needs no other part of rollbem::compiled than that for steady rolling, and the rest.
add_library(rollbem_study_support STATIC)
foreach(part IN ITEMS csv friction_laws gnuplot history input joined_rows named_scheme option_files option_values options output plot scenes sidecar table terminal_table)
    target_sources(rollbem_study_support PRIVATE "${PROJECT_SOURCE_DIR}/apps/support/${part}.cpp")
endforeach()
target_include_directories(rollbem_study_support PUBLIC "${PROJECT_SOURCE_DIR}/apps")
target_link_libraries(rollbem_study_support
    PUBLIC rollbem::reference rollbem_build_info Threads::Threads
    PRIVATE CLI11::CLI11 rollbem_quick_to_compile)
# Its programs link the bodies, so that it includes none.
target_compile_definitions(rollbem_study_support PRIVATE ROLLBEM_COMPILED)
# Two units, the one with CLI11 and the rest, so that two processors share the work.
compile_as_one(rollbem_study_support)
set_source_files_properties("${PROJECT_SOURCE_DIR}/apps/support/options.cpp" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

# What most programs and tests include, parsed once for both.
add_precompiled(rollbem_precompiled
    HEADERS ${rollbem_precompiled_headers}
        $<$<BOOL:${ROLLBEM_BUILD_TESTS}>:${PROJECT_SOURCE_DIR}/tests/support/catch.hpp>
    LIBRARIES rollbem::compiled $<$<BOOL:${ROLLBEM_BUILD_TESTS}>:Catch2::Catch2> rollbem_quick_to_compile)

add_library(rollbem_app_support STATIC
    "${PROJECT_SOURCE_DIR}/apps/support/non_steady.cpp" "${PROJECT_SOURCE_DIR}/apps/support/runs.cpp"
    "${PROJECT_SOURCE_DIR}/apps/support/state_space_files.cpp"
    "${PROJECT_SOURCE_DIR}/apps/support/strip_instances.cpp")
target_link_libraries(rollbem_app_support
    PUBLIC rollbem_study_support rollbem::compiled
    PRIVATE rollbem_quick_to_compile)
target_precompile_headers(rollbem_app_support REUSE_FROM rollbem_precompiled)
compile_as_one(rollbem_app_support)
