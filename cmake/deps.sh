#!/bin/sh
# deps.sh [--ci] [--docs] [--fmu] [--simbody] [--windows]: installs what building rollbem and its programs, tests and
# benchmarks needs. Installs only what is missing and prints what; silent if nothing is. --ci adds the tools of
# continuous integration, --simbody Simbody for the example simbody_wheel, --windows mingw-w64 and wine, to build for
# Windows and test it (both Debian and Ubuntu), --docs Doxygen for the API reference; --fmu installs FMPy, which brings
# the headers of FMI 2.0, and libcosimpy, which run the FMUs in tests, into build-fmu/venv.
set -eu

ci=no
docs=no
fmu=no
simbody=no
windows=no
for option in "$@"; do
    case $option in
    --ci) ci=yes simbody=yes ;;
    --docs) docs=yes ;;
    --fmu) fmu=yes ;;
    --simbody) simbody=yes ;;
    --windows) windows=yes ;;
    *)
        echo "usage: sh cmake/deps.sh [--ci] [--docs] [--fmu] [--simbody] [--windows]" >&2
        exit 2
        ;;
    esac
done

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

# Adds package $1 to $missing unless the command $2 exists.
need_command() { have "$2" || missing="$missing $1"; }

# Adds the packages after $1 to $missing unless the query $1 finds them.
need_packages() {
    query=$1
    shift
    for package in "$@"; do
        "$query" "$package" >/dev/null 2>&1 || missing="$missing $package"
    done
}

say() { echo "deps.sh: installing with $1:$missing"; }

# Whether Python can make virtual environments with pip in them.
have_venv() { have python3 && python3 -c 'import ensurepip, venv' 2>/dev/null; }

# Installs FMPy and libcosimpy into build-fmu/venv, which is never activated: FMPy brings its own cmake.
fmpy=0.3.32
libcosimpy=0.0.6
install_importers() {
    venv=$(dirname "$0")/../build-fmu/venv
    ! "$venv/bin/python3" -c "from importlib.metadata import version
assert (version('fmpy'), version('libcosimpy')) == ('$fmpy', '$libcosimpy')" 2>/dev/null || return 0
    echo "deps.sh: installing with pip into build-fmu/venv: fmpy $fmpy, libcosimpy $libcosimpy"
    python3 -m venv --clear "$venv"
    "$venv/bin/python3" -m pip install --quiet --disable-pip-version-check "fmpy==$fmpy" "libcosimpy==$libcosimpy" \
        </dev/null
}

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
        need_packages installed clang-format-14 clang-14 clang-16 gfortran
    fi
    [ $simbody = no ] || need_packages installed libsimbody-dev
    [ $windows = no ] || need_packages installed g++-mingw-w64-x86-64-posix wine wine64
    [ $docs = no ] || need_command doxygen doxygen
    [ $fmu = no ] || have_venv || missing="$missing python3-venv"
    if [ -n "$missing" ]; then
        say apt-get
        as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Acquire::Retries=3 update </dev/null
        # shellcheck disable=SC2086 # one word per package
        as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Acquire::Retries=3 -o Dpkg::Use-Pty=0 \
            install -y --no-install-recommends $missing </dev/null
    fi
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
    [ $fmu = no ] || have_venv || missing="$missing python3-pip"
    if [ -n "$missing" ]; then
        say dnf
        # shellcheck disable=SC2086
        as_root dnf -q -y install $missing </dev/null
    fi
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
    [ $fmu = no ] || have_venv || missing="$missing python"
    if [ -n "$missing" ]; then
        say brew
        # shellcheck disable=SC2086
        brew install --quiet $missing </dev/null
    fi
else
    echo "deps.sh: no apt-get, dnf or brew here. Please install a C++20 compiler, make, CMake >= 3.25, git," \
        "pkg-config, Eigen >= 3.4, GSL, Catch2 (2.13 or 3), Google Benchmark, CLI11 and gnuplot." >&2
    exit 1
fi

if [ $simbody = yes ] && [ $ci = no ] && ! have apt-get; then
    echo "deps.sh: no package of Simbody is known here; please install Simbody 3.7 or later from source" >&2
fi
if [ $windows = yes ] && ! have apt-get; then
    echo "deps.sh: please install mingw-w64 with POSIX threads, and wine" >&2
fi
[ $fmu = no ] || install_importers
