#!/bin/sh
# Compiles and runs one file of tests with templates of its own. Otherwise templates of double come from
# rollbem::compiled, and a header that was changed has no effect before that is built again.
# Usage, in the root, after a build: sh tests/alone.sh tests/FOLDER/test_NAME.cpp [argument of Catch2]...
set -eu
file=$1
shift
build=${BUILD:-build}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
set -- "$folder/test" "$@"
# shellcheck disable=SC2046 # one word per option
"${CXX:-c++}" -std=c++20 -O1 -Iinclude -Itests -Iapps "-I$build/generated" \
    $(pkg-config --cflags eigen3) "-DROLLBEM_MANCHESTER=\"$PWD/bench/manchester\"" \
    "-DROLLBEM_STEEL_CREEP=\"$PWD/apps/creep/steel.creep\"" \
    "-DROLLBEM_S1002_CONTACT=\"$PWD/apps/creep/s1002_60e1.contact\"" "$file" -o "$folder/test" \
    "$build"/tests/librollbem_test_support.a "$build"/librollbem_app_support.a "$build"/librollbem_study_support.a \
    "$build"/librollbem_compiled.a "$build"/librollbem_build_info.a -lCatch2WithMain -lgsl -lgslcblas
"$@"
