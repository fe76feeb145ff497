#!/bin/sh
# deps.sh [--ci | --docs]: installs what building rollbem and its programs, tests and benchmarks needs.
# Installs only what is missing and says what; silent when nothing is. --ci adds the tools of continuous integration,
# --docs that of the API reference.
set -eu

ci=no
docs=no
case "${1-}" in
"") ;;
--ci) ci=yes ;;
--docs) docs=yes ;;
*)
    echo "usage: sh cmake/deps.sh [--ci | --docs]" >&2
    exit 2
    ;;
esac

have() { command -v "$1" >/dev/null 2>&1; }

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif have sudo; then
        sudo "$@"
    else
        echo "deps.sh: neither root nor sudo; please install: $missing" >&2
        exit 1
    fi
}

# Adds package $1 to the missing ones unless the command $2 exists.
need_command() { have "$2" || missing="$missing $1"; }

# Adds the packages after $1 to the missing ones unless the query $1 knows them.
need_packages() {
    query=$1
    shift
    for package in "$@"; do
        "$query" "$package" >/dev/null 2>&1 || missing="$missing $package"
    done
}

say() { echo "deps.sh: installing with $1:$missing"; }

missing=
if have apt-get; then
    installed() { dpkg-query -W -f='${Status}' "$1" | grep -q '^install ok installed$'; }
    need_command g++ g++
    need_command make make
    need_command cmake cmake
    need_command git git
    need_command pkg-config pkg-config
    need_command gnuplot-nox gnuplot
    need_packages installed libeigen3-dev libgsl-dev catch2 libbenchmark-dev libcli11-dev
    if [ $ci = yes ]; then
        need_packages installed clang-format-14 clang-14 libsimbody-dev
    fi
    [ $docs = no ] || need_command doxygen doxygen
    [ -n "$missing" ] || exit 0
    say apt-get
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Acquire::Retries=3 update </dev/null
    # shellcheck disable=SC2086 # one word a package
    as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Acquire::Retries=3 -o Dpkg::Use-Pty=0 \
        install -y --no-install-recommends $missing </dev/null
elif have dnf; then
    need_command gcc-c++ g++
    need_command make make
    need_command cmake cmake
    need_command git git
    need_command pkgconf-pkg-config pkg-config
    need_command gnuplot gnuplot
    installed() { rpm -q "$1"; }
    need_packages installed eigen3-devel gsl-devel catch-devel google-benchmark-devel cli11-devel
    if [ $ci = yes ]; then
        need_packages installed clang clang-tools-extra
    fi
    [ $docs = no ] || need_command doxygen doxygen
    [ -n "$missing" ] || exit 0
    say dnf
    # shellcheck disable=SC2086
    as_root dnf -q -y install $missing </dev/null
elif have brew; then
    need_command cmake cmake
    need_command pkgconf pkg-config
    need_command gnuplot gnuplot
    installed() { brew list --formula "$1"; }
    need_packages installed eigen gsl catch2 google-benchmark cli11
    if [ $ci = yes ]; then
        need_packages installed clang-format
    fi
    [ $docs = no ] || need_command doxygen doxygen
    [ -n "$missing" ] || exit 0
    say brew
    # shellcheck disable=SC2086
    brew install --quiet $missing </dev/null
else
    echo "deps.sh: no apt-get, dnf or brew here. Please install a C++20 compiler, make, CMake >= 3.25, git," \
        "pkg-config, Eigen >= 3.4, GSL, Catch2 (2.13 or 3), Google Benchmark, CLI11 and gnuplot." >&2
    exit 1
fi
