#!/bin/sh
# Compiles and runs one file of tests, in seconds, against rollbem::compiled as it was built last. With --headers bodies
# and templates are the file's own, which takes longer, and a change of them has an effect at once.
# Usage, in the root, after a build: sh tests/alone.sh [--headers] tests/FOLDER/test_NAME.cpp [argument of Catch2]...
set -eu
build=${BUILD:-build}
mode="-std=gnu++20 -DNDEBUG -DROLLBEM_COMPILED -include $build/CMakeFiles/rollbem_precompiled.dir/cmake_pch.hxx"
if [ "$1" = --headers ]; then
    mode=-std=c++20
    shift
fi
file=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
set -- "$folder/test" "$@"
# shellcheck disable=SC2046,SC2086 # one word per option
"${CXX:-c++}" $mode -O1 -Iinclude -Itests -Iapps "-I$build/generated" \
    $(pkg-config --cflags-only-I eigen3 | sed 's/-I/-isystem /g') "-DROLLBEM_MANCHESTER=\"$PWD/bench/manchester\"" \
    "-DROLLBEM_STEEL_CREEP=\"$PWD/apps/creep/steel.creep\"" \
    "-DROLLBEM_S1002_CONTACT=\"$PWD/apps/creep/s1002_60e1.contact\"" "$file" -o "$folder/test" \
    "$build"/tests/librollbem_test_support.a "$build"/librollbem_app_support.a "$build"/librollbem_study_support.a \
    "$build"/librollbem_compiled.a "$build"/librollbem_build_info.a -lCatch2WithMain -lgsl -lgslcblas
"$@"
