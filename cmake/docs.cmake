# Target `docs`: an API reference in build/docs/html from the doc comments. Only on demand; needs Doxygen.
find_program(ROLLBEM_DOXYGEN doxygen)
mark_as_advanced(ROLLBEM_DOXYGEN)
if(NOT ROLLBEM_DOXYGEN)
    add_custom_target(docs
        COMMAND "${CMAKE_COMMAND}" -E echo "docs: doxygen was not found; sh cmake/deps.sh --docs installs it"
        COMMAND "${CMAKE_COMMAND}" -E false
        VERBATIM)
    return()
endif()
configure_file(cmake/Doxyfile.in "${PROJECT_BINARY_DIR}/Doxyfile" @ONLY)
add_custom_target(docs
    COMMAND "${ROLLBEM_DOXYGEN}" "${PROJECT_BINARY_DIR}/Doxyfile"
    WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
    COMMENT "API reference: ${PROJECT_BINARY_DIR}/docs/html/index.html"
    VERBATIM)
