#!/bin/sh
# concepts.sh COMPILER INCLUDE_DIR...: right schemes, kernels and rows of the table of stages compile; wrong ones are
# diagnosed, two calls of each scheme or kernel, in at most 420 lines for all.
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
#include <rollbem/rolling/detail/stage_table.hpp>
#include <rollbem/steady/steady.hpp>
#include <rollbem/assembly/rolling_system.hpp>
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
    SmoothSplit<double> smooth_split() const;
    double smooth_part(double) const, smooth_slope(double) const;
};
struct WrongKernel {
    using Scalar = double;
    double smooth_part(double) const;
};
void function(const Mesh<double>& mesh) {
END

# calls ARGUMENTS [NAMESPACE] [OPERATOR]: appends a call of each function, to lines $first and $second.
calls() {
    first=$(($(wc -l < "$folder/unit.cpp") + 1))
    second=$((first + 1))
    printf '    (void)%s(%s(%s));\n' "${3-}" "${2-}solve_steady" "$1" "${3-}" "${2-}rolling_system" "$1" \
        >> "$folder/unit.cpp"
}

# right ARGUMENTS: both functions of ARGUMENTS are found, also by their qualified names. To compile what they do as well
# takes most of the time, and other tests call them with schemes and kernels of their own.
right() {
    for namespace in '' rollbem::; do
        calls "$1" "$namespace" sizeof
        echo "$first $second" >> "$folder/right"
    done
}

# wrong TYPE CONCEPT ARGUMENTS: neither solve_steady nor rolling_system of ARGUMENTS compiles, because TYPE lacks
# CONCEPT.
wrong() {
    calls "$3"
    echo "$1 $2 $first $second" >> "$folder/wrong"
}

# row COUNT,PART...: declares rows of the table of stages, the first of them in line $first.
row() {
    first=$(($(wc -l < "$folder/unit.cpp") + 1))
    for values in "$@"; do
        printf '    { constexpr detail::StageTable row(%s); (void)row; }\n' "$values" >> "$folder/unit.cpp"
    done
}
row 1,1 2,0.5 2,0.29289321881345254
echo "$first $((first + 1))" >> "$folder/right"
echo "$((first + 2)) $((first + 2))" >> "$folder/right"
# the trapezoidal rule, one that is not A-stable, one that extrapolates, three stages
row 1,0.5 2,0.29 2,1.7071067811865475 3,0.435866521508459
wrong_row=$first

right "mesh, RightScheme{}, RightKernel{}"
right "Chebyshev{}, RightKernel{}"
wrong NoRows RollingScheme "mesh, NoRows{}, RightKernel{}"
wrong RowsOfFloat RollingScheme "mesh, RowsOfFloat{}, RightKernel{}"
wrong OtherRows RollingScheme "mesh, OtherRows{}, RightKernel{}"
wrong WrongKernel LineKernel "mesh, RightScheme{}, WrongKernel{}"
wrong WrongKernel LineKernel "Chebyshev{}, WrongKernel{}"
echo '}' >> "$folder/unit.cpp"

# shellcheck disable=SC2086 # one word per option
if "$compiler" -fsyntax-only $options "$folder/unit.cpp" > "$folder/said" 2>&1; then
    echo "the wrong ones compile"
    exit 1
fi
failures=0
said_of() { grep -q "unit\.cpp:$1:" "$folder/said"; }
while read -r first second; do
    said_of "$first" || said_of "$second" || continue
    echo "a right one does not compile, in line $first or $second:"
    failures=1
done < "$folder/right"
while read -r type concept first second; do
    grep "$concept" "$folder/said" | grep -q "$type" && said_of "$first" && said_of "$second" && continue
    echo "$type is not refused for want of $concept, in line $first or $second:"
    failures=1
done < "$folder/wrong"
for line in 0 1 2 3; do
    said_of $((wrong_row + line)) && continue
    echo "wrong row $line of the table of stages compiles:"
    failures=1
done
grep -q 'a_scheme_has_one_stage_of_the_whole_step_or_two_with_a_part_from' "$folder/said" || failures=1
lines=$(wc -l < "$folder/said")
echo "5 wrong ones and 4 rows: $lines lines"
[ "$(grep -c 'error: .*solve_steady' "$folder/said")" -eq 5 ] || failures=1
[ "$(grep -c 'error: .*rolling_system' "$folder/said")" -eq 5 ] || failures=1
if [ $failures -ne 0 ] || [ "$lines" -gt 420 ]; then
    head -n 420 "$folder/said"
    exit 1
fi
