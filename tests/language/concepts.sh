#!/bin/sh
# concepts.sh COMPILER INCLUDE_DIR...: valid schemes and kernels compile, and each invalid one is diagnosed in at most 70
# lines for two calls.
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

cat > "$folder/unit.cpp" <<END
#include <rollbem/adhesion/steady.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/elasticity/layered_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
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
    (void)solve_steady(mesh, RightScheme{}, RightKernel{});
    (void)rolling_system(mesh, RightScheme{}, RightKernel{});
    (void)rollbem::solve_steady(mesh, RightScheme{}, RightKernel{});
    (void)rollbem::rolling_system(mesh, RightScheme{}, RightKernel{});
    (void)solve_steady(Chebyshev{}, PlaneKernel<double>(mesh.size(), 0.7, 0.3));
    (void)rolling_system(Chebyshev{}, PlaneKernel<double>(mesh.size(), 0.7, 0.3));
END

# wrong NAME CONCEPT ARGUMENTS: neither solve_steady nor rolling_system of ARGUMENTS compiles, because of CONCEPT.
wrong() {
    printf '%s\t%s\t%s\n' "$(($(wc -l < "$folder/unit.cpp") + 1))" "$1" "$2" >> "$folder/wrong"
    printf '    (void)solve_steady(%s);\n    (void)rolling_system(%s);\n' "$3" "$3" >> "$folder/unit.cpp"
}
wrong "a scheme without rows" RollingScheme "mesh, NoRows{}, RightKernel{}"
wrong "a scheme with rows for another scalar type" RollingScheme "mesh, RowsOfFloat{}, RightKernel{}"
wrong "a scheme whose rows are none" RollingScheme "mesh, OtherRows{}, RightKernel{}"
wrong "a kernel without antiderivatives" LineKernel "mesh, RightScheme{}, WrongKernel{}"
wrong "Chebyshev states of a kernel without its split" SmoothSplitKernel "Chebyshev{}, RightKernel{}"
wrong "Chebyshev states of a layered kernel" SmoothSplitKernel \
    "Chebyshev{}, LayeredKernel(PlaneKernel<double>(mesh.size(), 0.7, 0.3), 0.5)"
echo '}' >> "$folder/unit.cpp"

# What is said belongs to the line of the last error before it; errors anywhere else are none of those expected.
# shellcheck disable=SC2086 # one word per option
if "$compiler" -fsyntax-only $options "$folder/unit.cpp" > "$folder/said" 2>&1; then : > "$folder/said"; fi
awk -F '\t' '
    FNR == NR { name[$1] = $2; concept[$1] = $3; next }
    / error: / {
        at = 0
        if (match($0, /unit\.cpp:[0-9]+:/)) at = substr($0, RSTART + 9, RLENGTH - 10) + 0
        if (at in name && /solve_steady/) found[at] = 1
        else if ((at - 1) in name && /rolling_system/) found[at] = 1
        else { print "unexpected: " $0; bad = 1 }
    }
    { said[at] = said[at] $0 "\n"; ++lines[at] }
    END {
        for (at in name) {
            count = lines[at] + lines[at + 1]
            print name[at] ": " count " lines"
            for (k = at; k <= at + 1; ++k) {
                if (found[k] && count <= 70 && index(said[k], concept[at])) continue
                printf "line %d of unit.cpp must be refused because of %s:\n%s", k, concept[at], said[k]
                bad = 1
            }
        }
        exit bad
    }' "$folder/wrong" "$folder/said"
