#!/bin/sh
# apps/precision_study.cpp, seen from outside: recommendations kept, the cheapest schemes, references by other programs,
# shards, the front of rows that were computed before, and pictures.
# Usage: precision.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
precision=$programs/precision_study

# --- --recommend
"$precision" --recommend 1e-4 >lines || fail '--recommend'
grep -q '^precision_study --quantity c11 --scheme richardson:cosine:nodes --n 10$' lines &&
    grep -q '^friction_study --kernel plane --method nodes --nodes chebyshev --n 115$' lines ||
        fail "--recommend: $(cat lines)"
"$precision" --recommend 0.02 --a-over-b 0.2 >lines || fail '--recommend, patch'
grep -q '^patch_study --a-over-b 0.2 --n 12 --strips 17 --strip-grading uniform ' lines ||
    fail "--recommend 0.02: $(cat lines)"
# every line meets its tolerance: in each row, or, of a patch, against the finest mesh of these
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

# --- the cheapest schemes
"$precision" --n 20 --quantity c11,c11_z1 --cheapest cheapest.csv >out || fail cheapest
[ "$(head -n 1 cheapest.csv)" = quantity,tolerance,among,scheme,n,relative_error,time_us,status ] &&
    [ "$(wc -l <cheapest.csv)" -eq 89 ] || fail "cheapest.csv"
grep -q '^c11,1e-12,elements,,,,,none$' cheapest.csv && grep -q '^c11,1e-2,stable-elements,[a-z]' cheapest.csv &&
    grep -q '^c11_z1,1e-12,stable,chebyshev,20,' cheapest.csv &&
    grep -q '^c11_z1,1e-12,elements,,' cheapest.csv &&
    grep -q '^c11_z1,1e-12,all,[cp]' cheapest.csv || fail "cheapest schemes: $(cat cheapest.csv)"

# --- forces with friction: states have none, the closed form only that along x
good 47 "$precision" --n 10,20,40 --quantity friction,combined_force,load_force \
    --cheapest cheapest.csv --scheme \
    cosine:collocation:0.5/0.5,uniform:collocation:0.5/0.5,cosine:galerkin:0.5/0.5,richardson:cosine:collocation:0.5/0.5,cosine:nodes-chebyshev,chebyshev,polynomial,closed-form
check 'forces with friction' '$scheme != "cosine:collocation:0.5/0.5" || $n != 20 || $quantity != "load_force" ||
    ($relative_error / 2.8e-3 - 1) ^ 2 < 0.03 ^ 2'
check 'forces with friction' '$scheme != "cosine:collocation:0.5/0.5" || $n != 40 || $quantity != "load_force" ||
    ($relative_error / 8.07e-4 - 1) ^ 2 < 0.01 ^ 2'
check 'forces with friction' '$scheme != "uniform:collocation:0.5/0.5" || $n != 40 || $quantity != "load_force" ||
    ($relative_error / 1.2e-2 - 1) ^ 2 < 0.05 ^ 2'
check 'forces with friction' '$scheme != "cosine:nodes-chebyshev" || $n != 40 || $quantity != "combined_force" ||
    ($relative_error / 1.55e-4 - 1) ^ 2 < 0.02 ^ 2'
check 'forces with friction' '$scheme != "closed-form" || $quantity == "friction"'
check 'forces with friction' '$scheme !~ /^(chebyshev|polynomial)/'
check 'forces with friction' '$time_us > 0 && $stable != "" && $model_error == ""'

# the distance of a force of friction_study from CONTACT's, extrapolated, is the error here
$programs/friction_study --kernel plane --n 40 --creepage-ratio 0.35355339059327373 \
    --lateral-ratio 0.35355339059327373 >both
awk -F, -v error="$(awk -F, '$1 == "cosine:collocation:0.5/0.5" && $2 == 40 && $3 == "combined_force" { print $4 }' out)" 'NR == 2 {
        size = sqrt((0.54356 ^ 2) + (0.40941 ^ 2)); found = sqrt(($8 - 0.54356) ^ 2 + ($16 - 0.40941) ^ 2) / size
        exit !((found - error) ^ 2 < 2e-5 ^ 2 && error > 5e-4) }' both || fail 'the error of the force as a vector'

# --- creep coefficients of patches: the error added to the value gives Kalker's, 3.625, 3.011, 0.9278 at a/b = 0.5, nu
# = 0.25
good 17 "$precision" --quantity patch_c11,patch_c22,patch_c23,patch_c33 --a-over-b 0.5 --poisson 0.25 --n 6,12 \
    --scheme cosine:nodes-chebyshev,richardson:cosine:nodes-chebyshev --cheapest cheapest.csv
header scheme,n,quantity,relative_error,time_us,stable,on_front,model_error,status
check 'coefficients of patches' '$status == "ok" && $kernel == "half-space" && $poisson == 0.25 && $a_over_b == 0.5 &&
    $strips == $n && $time_us > 0 && $stable == 1 && $on_front != ""'
$programs/patch_study --a-over-b 0.5 --poisson 0.25 --n 12 --quiet >both
limit() {
    awk -F, -v s="$1" -v q="patch_$2" -v exact="$3" -v least="$4" '
        NR == FNR { if (FNR == 1) for (i = 1; i <= NF; ++i) if ("patch_" $i == q) k = i; found = $k; next }
        $1 == s && $2 == 12 && $3 == q {
            ok = s !~ /^richardson/ ? (found / (1 + $4) / exact - 1) ^ 2 < least ^ 2 : $4 ^ 2 < least ^ 2 }
        END { exit !ok }' both out ||
        fail "$1: $2: $(grep "$1,12,patch_$2" out)"
}
limit cosine:nodes-chebyshev:cosine-strips c11 3.625 1e-3
limit cosine:nodes-chebyshev:cosine-strips c22 3.011 1e-3
limit cosine:nodes-chebyshev:cosine-strips c23 0.9278 1e-3
limit cosine:nodes-chebyshev:cosine-strips c33 1.939 5e-3
limit richardson:cosine:nodes-chebyshev:cosine-strips c11 0 1e-3
limit richardson:cosine:nodes-chebyshev:cosine-strips c22 0 2e-3

# --- shards add up to the whole, byte for byte except times and what depends on them
# aside FILE: the rows with columns of times and on_front left empty
aside() {
    awk -F, 'BEGIN { OFS = "," } NR == 1 { for (i = 1; i <= NF; ++i) out[i] = $i ~ /_us$|^on_front$/; print; next }
        { for (i = 1; i <= NF; ++i) if (out[i]) $i = ""; print }' "$1"
}
adds_up() {
    "$@" >whole || fail "$*"
    for k in 1 2 3; do "$@" --shard $k/3; done >parts
    aside whole >one
    aside parts | cmp -s - one || fail "shards do not add up: $*"
    [ "$(wc -l <whole)" -gt 4 ] || fail "too few rows: $*"
}
adds_up "$precision" --n 4,6 --scheme cosine:collocation:0.5/0.5,uniform:collocation:0/0.63,chebyshev,polynomial --quantity c11,c11_z1

# --- --front: leaves the whole as it is, fills the empty columns of shards, and refuses several contacts
sed '3s/,1000,/,100,/' whole >mixed
bad 'line 3 must have the kernel, aspect and poisson' "$precision" --front ../mixed
sed 3p whole >doubled
bad 'line 4 must not repeat a row: ' "$precision" --front ../doubled
"$precision" --front whole >again || fail '--front'
cmp -s whole again || fail '--front changes a whole'
"$precision" --front parts --quantity c11 --cheapest cheapest.csv >filled || fail '--front of parts'
rows 'NR > 1 && $quantity != "c11" { bad = 1 } NR > 1 && ($on_front == "") != ($scheme == "polynomial") { bad = 1 }
    $on_front == 1 { front = 1 }
    END { exit bad || !front }' filled || fail "a front of parts: $(cat filled)"
grep -q '^c11,1e-2,elements,[a-z]' cheapest.csv || fail 'cheapest of parts'

# --- plot
if command -v gnuplot >/dev/null; then
    good 17 "$precision" --front whole --plot p.svg
    [ "$(grep -c '</svg>' p.svg)" -eq 1 ] && grep -q 'Pareto front' p.svg || fail 'plot'
    # a scheme has the same colour in every panel, although friction lacks two of them; small errors have a floor
    good 11 "$precision" --n 40 --scheme polynomial,closed-form,cosine:collocation:0.5/0.5,chebyshev \
        --quantity c11,response,friction --plot p.svg
    # the first curve of the last panel belongs to the cosine mesh
    awk '/id="gnuplot_plot_/ { split($0, part, /<title>|<.title>/); curve = /gnuplot_plot_1c"/ ? "last" : part[2] }
        match($0, /rgb\([^)]*\)/) && curve { colours[curve] = substr($0, RSTART, RLENGTH); curve = "" }
        END { exit !("polynomial" in colours && colours["last"] == colours["cosine:collocation:0.5/0.5"] &&
            colours["last"] != colours["polynomial"]) }' p.svg ||
        fail 'colours of the panels'
    grep -q '1e-14 or less' p.svg || fail 'no floor'
    grep -q 'quantities drawn' p.svg && fail 'a note although all quantities are drawn'
    good 6 "$precision" --n 10 --scheme cosine:collocation:0.5/0.5 --quantity c11,traction,c11_z1,response,friction --plot p.svg
    grep -q '(3 of 5 quantities drawn)' p.svg || fail 'no note that quantities are left out'
    good 5 "$precision" --n 10 --scheme cosine:collocation:0.5/0.5 --quantity traction,c11_z0.1,c11_z1,transient --plot p.svg
    grep -q 'traction (3 of 4 quantities drawn)' p.svg || fail 'not the first three quantities'
fi
finish
