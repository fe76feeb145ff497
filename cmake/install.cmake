# Installs the headers, the CMake package with its components `reference` and `compiled`, and a pkg-config file. All are
# relocatable where their folders are not absolute, and independent of the architecture except for the library of
# `compiled`, which is a package of its own in the folder for libraries; the main package finds it there. Neither it nor
# any program need have been built: what has not is left out.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
include(cmake/pkg_config.cmake)

set(package_dir "${CMAKE_INSTALL_DATADIR}/cmake/rollbem")

install(DIRECTORY include/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING
    PATTERN "*.h" PATTERN "*.hpp" PATTERN "*.ipp" PATTERN "*.tpp")
# The units of rollbem::compiled, for projects that compile them with flags of their own.
install(DIRECTORY cmake/units DESTINATION "${CMAKE_INSTALL_DATADIR}/rollbem" FILES_MATCHING PATTERN "*.cpp")
# The tables of creep forces of steel, and of the contact geometry of S1002 on 60E1.
install(FILES apps/creep/steel.creep apps/creep/s1002_60e1.contact
    DESTINATION "${CMAKE_INSTALL_DATADIR}/rollbem")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/licenses/rollbem")

install(TARGETS rollbem EXPORT rollbem_targets INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(EXPORT rollbem_targets FILE rollbemTargets.cmake NAMESPACE rollbem:: DESTINATION "${package_dir}")
configure_package_config_file(cmake/rollbemConfig.cmake.in "${PROJECT_BINARY_DIR}/rollbemConfig.cmake"
    INSTALL_DESTINATION "${package_dir}"
    PATH_VARS CMAKE_INSTALL_DATADIR CMAKE_INSTALL_LIBDIR
    NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/rollbemConfigVersion.cmake"
    COMPATIBILITY SameMinorVersion
    ARCH_INDEPENDENT)
if(ROLLBEM_BUILD_COMPILED)
    add_subdirectory(cmake/compiled_package)
endif()
install(FILES
    "${PROJECT_BINARY_DIR}/rollbemConfig.cmake"
    "${PROJECT_BINARY_DIR}/rollbemConfigVersion.cmake"
    DESTINATION "${package_dir}")

install_pkg_config(rollbem "${CMAKE_INSTALL_DATADIR}/pkgconfig")
