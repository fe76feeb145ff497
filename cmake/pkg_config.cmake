# install_pkg_config(name folder): configures cmake/name.pc.in, and installs it into the folder, from where it finds the
# others.
function(install_pkg_config name folder)
    file(RELATIVE_PATH pc_to_prefix "/${folder}" "/")
    string(REGEX REPLACE "/$" "" pc_to_prefix "${pc_to_prefix}")
    configure_file("${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in" "${PROJECT_BINARY_DIR}/${name}.pc" @ONLY)
    install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION "${folder}")
endfunction()
