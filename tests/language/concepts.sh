#!/bin/sh
# concepts.sh COMPILER INCLUDE_DIR...: invalid schemes and kernels are diagnosed in at most 70 lines for two calls.
set -eu
compiler=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

options="-std=c++20"
for include in "$@"; do
    options="$options -isystem $include"
done
# g++ 16 nests what it says and repeats it
plain=-fdiagnostics-plain-output
if "$compiler" $plain -E - < /dev/null > /dev/null 2>&1; then options="$options $plain"; fi

# g++ finds the precompiled header; clang++ reads the headers each time.
cat > "$folder/headers.hpp" <<END
#include <rollbem/adhesion/steady.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/elasticity/layered_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
END
# shellcheck disable=SC2086 # one word per option
"$compiler" $options -x c++-header "$folder/headers.hpp" -o "$folder/headers.hpp.gch"

# try NAME CONCEPT ARGUMENTS: neither solve_steady nor rolling_system of ARGUMENTS compiles, because of CONCEPT. With - as
# CONCEPT they compile, also by their qualified names.
try() {
    qualified=
    [ "$2" = - ] && qualified="(void)rollbem::solve_steady($3); (void)rollbem::rolling_system($3);"
    cat > "$folder/unit.cpp" <<END
#include "headers.hpp"
using namespace rollbem;
struct RightScheme {
    template <class Scalar> SchemeRows<Scalar> rows(Quantity, const Mesh<Scalar>&) const;
};
struct NoRows {};
struct RowsOfFloat {
    SchemeRows<float> rows(Quantity, const Mesh<float>&) const;
};
struct OtherRows {
    template <class Scalar> int rows(Quantity, const Mesh<Scalar>&) const;
};
struct RightKernel {
    using Scalar = double;
    ArrayX<double> g(const ArrayX<double>&) const, H(const ArrayX<double>&) const, H_integral(const ArrayX<double>&) const;
};
struct WrongKernel {
    using Scalar = double;
    double g(double) const;
};
void function(const Mesh<double>& mesh) {
    (void)solve_steady($3);
    (void)rolling_system($3);
    $qualified
}
END
    # shellcheck disable=SC2086 # one word per option
    if "$compiler" -fsyntax-only $options "$folder/unit.cpp" > "$folder/said" 2>&1; then
        [ "$2" = - ] && return
        echo "$1: both compile"
        exit 1
    fi
    lines=$(wc -l < "$folder/said")
    echo "$1: $lines lines"
    if [ "$2" = - ] || [ "$lines" -gt 70 ] || ! grep -q "$2" "$folder/said" ||
        ! grep -q "error: .*solve_steady" "$folder/said" || ! grep -q "error: .*rolling_system" "$folder/said"; then
        head -n 60 "$folder/said"
        exit 1
    fi
}

try "the right ones" - "mesh, RightScheme{}, RightKernel{}"
try "a scheme without rows" RollingScheme "mesh, NoRows{}, RightKernel{}"
try "a scheme with rows for another scalar type" RollingScheme "mesh, RowsOfFloat{}, RightKernel{}"
try "a scheme whose rows are none" RollingScheme "mesh, OtherRows{}, RightKernel{}"
try "a kernel without antiderivatives" LineKernel "mesh, RightScheme{}, WrongKernel{}"
try "Chebyshev states of a kernel with its split" - "Chebyshev{}, PlaneKernel<double>(mesh.size(), 0.7, 0.3)"
try "Chebyshev states of a kernel without" SmoothSplitKernel "Chebyshev{}, RightKernel{}"
try "Chebyshev states of a layered kernel" SmoothSplitKernel \
    "Chebyshev{}, LayeredKernel(PlaneKernel<double>(mesh.size(), 0.7, 0.3), 0.5)"
