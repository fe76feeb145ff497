# Installs the library to a fresh place and builds a user's project against it, in each way a user can get it.
include(GNUInstallDirs)
set(prefix "${CMAKE_CURRENT_BINARY_DIR}/consumer/prefix")

add_test(NAME package.clean COMMAND ${CMAKE_COMMAND} -E rm -rf "${CMAKE_CURRENT_BINARY_DIR}/consumer")
add_test(NAME package.install COMMAND ${CMAKE_COMMAND} --install "${PROJECT_BINARY_DIR}" --prefix "${prefix}")
set_tests_properties(package.clean PROPERTIES LABELS package FIXTURES_SETUP rollbem_clean)
set_tests_properties(package.install PROPERTIES
    LABELS package FIXTURES_REQUIRED rollbem_clean FIXTURES_SETUP rollbem_prefix)

# add_consumer_test(name program option...): configures with the options, builds, and runs one of the user's programs.
function(add_consumer_test name program)
    add_test(NAME package.${name}
        COMMAND ${CMAKE_CTEST_COMMAND}
            --build-and-test "${CMAKE_CURRENT_SOURCE_DIR}/consumer" "${CMAKE_CURRENT_BINARY_DIR}/consumer/${name}"
            --build-generator "${CMAKE_GENERATOR}"
            --build-makeprogram "${CMAKE_MAKE_PROGRAM}"
            --build-project rollbem_consumer
            --build-target ${program}
            --build-options
                "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
                "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}"
                "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}"
                "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG"  # quicker to compile than -O3
                "-DEigen3_DIR=${Eigen3_DIR}"
                ${ARGN}
            --test-command ${program})
    set_tests_properties(package.${name} PROPERTIES LABELS package FIXTURES_REQUIRED rollbem_prefix TIMEOUT 300)
endfunction()

set(no_gsl -DCMAKE_DISABLE_FIND_PACKAGE_GSL=ON)
add_consumer_test(find_package smallest "-DCMAKE_PREFIX_PATH=${prefix}" ${no_gsl})
add_consumer_test(reference exact "-DCMAKE_PREFIX_PATH=${prefix}" -DCOMPONENT=reference)
add_consumer_test(faces faces "-DCMAKE_PREFIX_PATH=${prefix}" ${no_gsl})
add_consumer_test(own_units own_units "-DCMAKE_PREFIX_PATH=${prefix}" -DUNITS=ON ${no_gsl})
add_consumer_test(compiled compiled "-DCMAKE_PREFIX_PATH=${prefix}" -DCOMPONENT=compiled ${no_gsl})
# A unit with another alignment is not linked, and the linker says why.
add_test(NAME package.other_alignment
    COMMAND ${CMAKE_COMMAND} --build "${CMAKE_CURRENT_BINARY_DIR}/consumer/compiled" --target other_alignment)
set_tests_properties(package.compiled PROPERTIES FIXTURES_SETUP rollbem_compiled_consumer)
set_tests_properties(package.own_units package.compiled PROPERTIES COST 5)  # the longest start first
set_tests_properties(package.other_alignment PROPERTIES LABELS package FIXTURES_REQUIRED rollbem_compiled_consumer
    PASS_REGULAR_EXPRESSION "rollbem_compiled_0_4_is_missing_or_has_another_eigen_alignment_use_the_same_m_flags<128")
add_consumer_test(subdirectory smallest -DROLLBEM_FROM=subdirectory ${no_gsl})
add_consumer_test(fetch_content smallest -DROLLBEM_FROM=fetch ${no_gsl})
add_consumer_test(pkg_config smallest "-DCMAKE_PREFIX_PATH=${prefix}" -DROLLBEM_FROM=pkg-config)

# From a build folder in which nothing has been built come the headers, here to absolute folders; the library is
# missed as one not installed.
set(fresh "${CMAKE_CURRENT_BINARY_DIR}/consumer/fresh")
add_test(NAME package.fresh_configure
    COMMAND ${CMAKE_COMMAND} -G "${CMAKE_GENERATOR}" -S "${PROJECT_SOURCE_DIR}" -B "${fresh}"
        "-DCMAKE_MAKE_PROGRAM=${CMAKE_MAKE_PROGRAM}" "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
        "-DEigen3_DIR=${Eigen3_DIR}"
        "-DCMAKE_INSTALL_PREFIX=${fresh}/prefix"
        "-DCMAKE_INSTALL_INCLUDEDIR=${fresh}/prefix/headers"
        "-DCMAKE_INSTALL_DATADIR=${fresh}/beside/share")
add_test(NAME package.fresh_install COMMAND ${CMAKE_COMMAND} --install "${fresh}")
set_tests_properties(package.fresh_configure PROPERTIES LABELS package FIXTURES_REQUIRED rollbem_clean
    FIXTURES_SETUP rollbem_fresh)
set_tests_properties(package.fresh_install PROPERTIES LABELS package DEPENDS package.fresh_configure
    FIXTURES_REQUIRED rollbem_clean FIXTURES_SETUP rollbem_fresh)
add_consumer_test(fresh_find_package smallest "-DCMAKE_PREFIX_PATH=${fresh}/beside" ${no_gsl})
add_consumer_test(fresh_compiled compiled "-DCMAKE_PREFIX_PATH=${fresh}/beside" -DCOMPONENT=compiled ${no_gsl})
set_tests_properties(package.fresh_find_package package.fresh_compiled PROPERTIES FIXTURES_REQUIRED rollbem_fresh)
find_program(ROLLBEM_PKG_CONFIG pkg-config)
if(ROLLBEM_PKG_CONFIG AND UNIX)
    add_test(NAME package.fresh_pkg_config
        COMMAND sh -c "pkg-config --variable=prefix rollbem && pkg-config --cflags $1" sh "${fresh}/rollbem_c.pc")
    set_tests_properties(package.fresh_pkg_config PROPERTIES LABELS package FIXTURES_REQUIRED rollbem_fresh
        ENVIRONMENT "PKG_CONFIG_PATH=${fresh}/beside/share/pkgconfig"
        PASS_REGULAR_EXPRESSION "^${fresh}/prefix\n-I${fresh}/prefix/headers")
endif()
set_tests_properties(package.fresh_compiled PROPERTIES
    PASS_REGULAR_EXPRESSION "component compiled is not installed")

# The main package finds the package of `compiled` where it is itself, although only its own folder is named.
add_test(NAME package.compiled_beside
    COMMAND ${CMAKE_COMMAND}
        -G "${CMAKE_GENERATOR}"
        -S "${CMAKE_CURRENT_SOURCE_DIR}/consumer"
        -B "${CMAKE_CURRENT_BINARY_DIR}/consumer/compiled_beside"
        "-DCMAKE_MAKE_PROGRAM=${CMAKE_MAKE_PROGRAM}"
        "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
        "-DEigen3_DIR=${Eigen3_DIR}"
        "-Drollbem_DIR=${prefix}/${CMAKE_INSTALL_DATADIR}/cmake/rollbem"
        -DCOMPONENT=compiled
        ${no_gsl})
set_tests_properties(package.compiled_beside PROPERTIES LABELS package FIXTURES_REQUIRED rollbem_prefix)

# Without GSL the component is refused, and the message says why.
add_consumer_test(reference_without_gsl exact "-DCMAKE_PREFIX_PATH=${prefix}" -DCOMPONENT=reference ${no_gsl})
set_tests_properties(package.reference_without_gsl PROPERTIES
    PASS_REGULAR_EXPRESSION "component reference needs GSL, which was not found")

# So is a component that there is none of.
add_consumer_test(unknown_component exact "-DCMAKE_PREFIX_PATH=${prefix}" -DCOMPONENT=refrence ${no_gsl})
set_tests_properties(package.unknown_component PROPERTIES
    PASS_REGULAR_EXPRESSION "rollbem has the components reference and compiled, but no refrence")
