#!/bin/sh
# concepts.sh COMPILER INCLUDE_DIR...: invalid schemes and kernels are diagnosed in at most 50 lines each.
set -eu
compiler=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

includes=
for include in "$@"; do
    includes="$includes -isystem $include"
done

# g++ finds the precompiled header; clang++ reads the headers each time.
cat > "$folder/headers.hpp" <<END
#include <rollbem/adhesion/steady.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/elasticity/layered_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
END
# shellcheck disable=SC2086 # one word per option
"$compiler" -std=c++20 $includes -x c++-header "$folder/headers.hpp" -o "$folder/headers.hpp.gch"

# try NAME CONCEPT ARGUMENTS: solve_steady and rolling_system of ARGUMENTS do not compile, because of CONCEPT. With - as
# CONCEPT they compile, also by their qualified names.
try() {
    for call in solve_steady rolling_system; do
        qualified=
        [ "$2" = - ] && qualified="(void)rollbem::$call($3);"
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
void function(const Mesh<double>& mesh) { (void)$call($3); $qualified }
END
        # shellcheck disable=SC2086 # one word per option
        if "$compiler" -std=c++20 -fsyntax-only $includes "$folder/unit.cpp" > "$folder/said" 2>&1; then
            [ "$2" = - ] && continue
            echo "$call of $1 compiles"
            exit 1
        fi
        lines=$(wc -l < "$folder/said")
        echo "$call of $1: $lines lines"
        if [ "$lines" -gt 50 ] || ! grep -q "$2" "$folder/said"; then
            head -n 60 "$folder/said"
            exit 1
        fi
    done
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
