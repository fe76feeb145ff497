#!/bin/sh
# apps/precision_study.cpp, seen from outside: recommendations kept, the cheapest schemes, references by other programs,
# shards, and the front of rows that were computed before.
# Usage: precision.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
precision=$programs/precision_study

# --- --recommend: every line meets its tolerance: in each row, or, of a patch, against the finest mesh of these
for tolerance in 2e-2 1e-5; do
    "$precision" --recommend $tolerance | grep -v '^#' >lines
    while read -r line; do
        "$programs"/$line >out 2>err </dev/null || fail "--recommend $tolerance: $line: $(cat err)"
        case $line in
        patch*)
            mv out both
            "$programs"/$(echo "$line" | sed 's/--n .* --strip-/--n 24 --strips 13 --strip-/') >out </dev/null
            rows -v most=$tolerance 'NR == FNR { x = $longitudinal_force; y = $lateral_force; next }
                FNR == 2 { exit !(x != "" && (x - $longitudinal_force) ^ 2 <= most ^ 2 &&
                    (y - $lateral_force) ^ 2 <= most ^ 2) }' both out
            ;;
        *) rows -v most=$tolerance 'NR > 1 && !($relative_error != "" && $relative_error ^ 2 <= most ^ 2) { bad = 1 }
            END { exit bad || NR < 2 }' out ;;
        esac || fail "--recommend $tolerance: $line: $(cat out)"
    done <lines
    [ "$(wc -l <lines)" -ge 6 ] || fail "--recommend $tolerance: $(cat lines)"
done
"$precision" --recommend 0.02 --a-over-b 0.2 |
    grep -q '^patch_study --a-over-b 0.2 --n 12 --strips 17 --strip-grading uniform ' || fail '--recommend, patch'

# --- an error is the largest of those that the other studies find at the places a quantity stands for, and worst_at
# names its place; an option judges at one place. largest COLUMN PROGRAM ARG...: the largest |relative_error| of the rows
# and its place, beside a row of precision_study in the file out.
largest() {
    column=$1
    shift
    "$@" >rows_of_places || fail "$*"
    set -- "$(rows 'NR > 1 { e = $relative_error ^ 2; if (e > most) { most = e; place = $'"$column"' } }
        END { printf "%.17g %s", sqrt(most), place }' rows_of_places)"
    check "the largest error over $column: $1" "(sqrt(\$relative_error ^ 2) / ${1% *} - 1) ^ 2 < 1e-5 ^ 2 && \
        split(\$worst_at, place, /=/) == 2 && place[1] == \"$column\" && (place[2] - ${1#* }) ^ 2 < 1e-20"
}
word='--kernel plane --scheme cosine:nodes --n 20 --no-timing'
spread() { awk -v from="$1" -v by="$2" -v count="$3" 'BEGIN {
    for (k = 0; k < count; ++k) printf "%s%.17g", k ? "," : "", by < 0 ? from * (-by) ^ (k / 19) : from + by * k }'; }
# shellcheck disable=SC2086 # words
{
    "$precision" --quantity friction $word >out
    largest creepage_ratio "$programs/friction_study" $word --creepage-ratio "$(spread 0.05 0.047368421052631574 20)"
    "$precision" --quantity response $word >out
    largest omega "$programs/frequency_study" $word --omega "$(spread 0.1 -50 20)"
    "$programs/transient_study" $word --step 1 --dq 0.07 --until 9.94 --integrator exponential >all
    "$precision" --quantity transient $word >out
    rows 'NR == 1 || $q_over_a > 1' all >late
    largest q_over_a cat late
    "$precision" --quantity friction $word --creepage-ratio 0.3 >out
    largest creepage_ratio "$programs/friction_study" $word --creepage-ratio 0.3
}
# a border of stick in the middle of both meshes passes for precision at one creepage alone
"$precision" --quantity friction --scheme richardson:cosine:nodes --n 20 --no-timing >out
set_error=$(rows 'END { print sqrt($relative_error ^ 2) }' out)
"$precision" --quantity friction --scheme richardson:cosine:nodes --n 20 --no-timing --creepage-ratio 0.5 >out
check 'a lucky creepage' "$set_error > 100 * sqrt(\$relative_error ^ 2) && \$worst_at == \"creepage_ratio=0.5\""

# --- shards add up to the whole, but for times and the front; --front leaves the whole as it is, and fills the columns
# of shards; the cheapest schemes
set -- "$precision" --n 4,20 --quantity c11,c11_z1 \
    --scheme cosine:collocation:0.5/0.5,uniform:collocation:0/0.63,chebyshev,polynomial
"$@" --cheapest cheapest.csv >whole || fail "$*"
for k in 1 2 3; do "$@" --shard $k/3; done >parts
aside='BEGIN { OFS = FS } NR > 1 { $time_us = $on_front = "" } { print }'
rows "$aside" parts >one
rows "$aside" whole | cmp -s one - || fail "shards do not add up: $(cat one)"
"$precision" --front whole | cmp -s - whole || fail '--front changes a whole'
"$precision" --front parts --quantity c11 --cheapest filled.csv >out || fail '--front of parts'
rows 'NR > 1 && ($quantity != "c11" || ($on_front == "") != ($scheme == "polynomial")) { bad = 1 }
    $on_front == 1 { front = 1 }
    END { exit bad || !front }' out || fail "a front of parts: $(cat out)"
[ "$(head -n 1 cheapest.csv)" = quantity,tolerance,among,scheme,n,relative_error,time_us,status ] &&
    [ "$(wc -l <cheapest.csv)" -eq 89 ] || fail "cheapest.csv"
for line in 'c11,1e-12,elements,,,,,none$' 'c11,1e-2,stable-elements,[cu]' 'c11_z1,1e-12,stable,chebyshev,20,' \
    'c11_z1,1e-12,elements,,' 'c11_z1,1e-12,all,[cp]'; do
    grep -q "^$line" cheapest.csv || fail "cheapest schemes: no $line in $(cat cheapest.csv)"
done
grep -q '^c11,1e-2,elements,[a-z]' filled.csv || fail 'cheapest of parts'

finish
