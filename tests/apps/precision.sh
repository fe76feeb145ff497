#!/bin/sh
# apps/precision_study.cpp, seen from outside: bad input, columns, rows, numbers known from elsewhere, the front, the
# cheapest schemes; and for every study that shards add up to the whole.
# Usage: precision.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
precision=$programs/precision_study

# --- bad input
p="$precision --output x.csv --n 4"
for option in --mesh --edges --method --nodes --quadrature --alpha --alpha-L --alpha-T --lambda --derivative; do
    bad "$option = 1 cannot be used here" $p $option 1
done
bad '--mesh cannot be used here: ' $p --mesh
bad '--schemes = foo must be all, or some of uniform-0.5/0.5' $p --schemes cosine,foo
bad "--schemes = '' must be a list without empty items" $p --schemes ''
bad 'repeated items: cosine' $p --schemes cosine,knothe,cosine
bad '--schemes = cosine, ,knothe must be a list without empty items' $p --schemes 'cosine, ,knothe'
bad 'must be a list without empty items' $p --quantity c11, # some versions of CLI11 drop the comma
bad '--quantity = c12 must be all, or some of c11,traction,c11_z0.1,c11_z1,c11_z5,step_force,friction_force,combined_force,load_force' $p --quantity c12
bad '--size-ratio = 2 has no effect without the scheme geometric' $p --schemes knothe --size-ratio 2
bad '--epsilon = 0.4 has no effect without the scheme knothe' $p --schemes geometric --epsilon 0.4
bad '--epsilon = 0 must lie in' $p --epsilon 0
bad '--n = 5 must fit' "$precision" --output x.csv --n 5 --schemes richardson-cosine
bad '--n = 0 must be an integer' "$precision" --output x.csv --n 0
bad '--aspect = inf must be positive and finite' $p --aspect inf
for option in aspect poisson size-ratio epsilon; do
    bad "--$option = 0.3,0.4 must be a single value" $p --$option 0.3,0.4
    bad "--$option = 0.3,0.4 must be a single value" $p --$option 0.3 --$option 0.4
done
bad '--kernel = strip,plane must be a single value' $p --kernel strip,plane
bad '--aspect = 0.1 must be larger than' $p --aspect 0.1
bad '--cheapest = c.csv has no effect with --shard' $p --cheapest c.csv --shard 1/2
bad '--cheapest = c.csv has no effect with --shard or --jobs' $p --cheapest c.csv --jobs 2
bad '--cheapest = / must be a file that can be written' $p --cheapest /
bad '--front = none must be a file that can be read' "$precision" --front none
printf 'scheme,n\n' >wrong
bad 'line 1 must be scheme,n,quantity' "$precision" --front ../wrong
printf 'scheme,n,quantity,relative_error,time_us,stable,on_front,model_error\ncosine,4,c11,1e-3,x,1,,\n' >wrong
bad 'line 2 must be a number or empty: x' "$precision" --front ../wrong
printf 'scheme,n,quantity,relative_error,time_us,stable,on_front,model_error\ncosine,1e30,c11,1e-3,1,1,,\n' >wrong
bad 'line 2: n = 1e30 must lie in [1, 100000]' "$precision" --front ../wrong
sed -i 's/1e30/4/; s/,1,1,,/,-1,1,,/' wrong
bad 'line 2: time_us = -1 must lie in [0,' "$precision" --front ../wrong
sed -i 's/cosine/sine/' wrong
bad 'line 2 must name a scheme: sine' "$precision" --front ../wrong
bad '--n = 4 has no effect with --front' "$precision" --front ../wrong --n 4
bad '--schemes = all has no effect with --front' "$precision" --front ../wrong --schemes all

# --- --recommend
bad '--recommend = 1 must be above 0 and below 1' "$precision" --recommend 1
bad '--n = 4 has no effect with --recommend' "$precision" --recommend 1e-4 --n 4
"$precision" --recommend 1e-4 >lines || fail '--recommend'
grep -q '^precision_study --quantity c11 --schemes richardson-nodes --n 10$' lines &&
    grep -q '^friction_study --kernel plane --method nodes --nodes chebyshev --n 115$' lines || fail "--recommend: $(cat lines)"
bad '--a-over-b = 30 must lie in [0.1, 25]' "$precision" --recommend 1e-4 --a-over-b 30
"$precision" --recommend 0.02 --a-over-b 0.2 >lines || fail '--recommend, patch'
grep -q '^patch_study --a-over-b 0.2 --n 12 --strips 17 --strip-grading uniform ' lines || fail "--recommend 0.02: $(cat lines)"
# every line meets its tolerance: in each row, or, of a patch, against the finest mesh of these
for tolerance in 2e-2 1e-6; do
    "$precision" --recommend $tolerance | grep -v '^#' >lines
    while read -r line; do
        "$programs"/$line >out 2>err </dev/null || fail "--recommend $tolerance: $line: $(cat err)"
        case $line in
        patch*)
            mv out both
            "$programs"/$(echo "$line" | sed 's/--n .* --strip-/--n 32 --strips 17 --strip-/') >out </dev/null
            rows -v most=$tolerance 'NR == FNR { x = $longitudinal_force; y = $lateral_force; next }
                FNR == 2 { exit !(x != "" && (x - $longitudinal_force) ^ 2 <= most ^ 2 && (y - $lateral_force) ^ 2 <= most ^ 2) }' both out
            ;;
        *) rows -v most=$tolerance 'NR > 1 && !($relative_error != "" && $relative_error ^ 2 <= most ^ 2) { bad = 1 }
            END { exit bad || NR < 2 }' out ;;
        esac || fail "--recommend $tolerance: $line: $(cat out)"
    done <lines
    [ "$(wc -l <lines)" -ge 6 ] || fail "--recommend $tolerance: $(cat lines)"
done

# --- columns, rows, numbers
good 63 "$precision" --n 20 --quantity c11,traction,c11_z1,friction_force --cheapest cheapest.csv
header scheme,n,quantity,relative_error,time_us,stable,on_front,model_error,status,kernel,aspect,poisson,size_ratio,epsilon
check 'status and settings' '($status == "ok") == ($relative_error != "") && $kernel == "plane" && $aspect == 1000 && $poisson > 0.27'
check 'gradings' '($size_ratio == "") == ($scheme != "geometric") && ($epsilon == "") == ($scheme != "knothe")'
is() { rows -v s="$1" -v q="$2" '$scheme == s && $quantity == q { ok = '"$3"' } END { exit !ok }' out || fail "$1: $2: $(grep "$1.*$2" out)"; }
is uniform-0.5/0.5 c11 '($relative_error / 7.543e-3 - 1) ^ 2 < 1e-6 && $stable == 1'
is uniform-0/0.63 c11 '($relative_error / -3.1e-5 - 1) ^ 2 < 1e-3 && $stable == 1'
is cosine c11 '($relative_error / 4.304e-4 - 1) ^ 2 < 1e-6'
is galerkin-cosine c11 '($relative_error / 4.304e-4 - 1) ^ 2 < 1e-6'
is richardson-uniform c11 '($relative_error / -4.07e-5 - 1) ^ 2 < 1e-4'
is nodes-cosine c11 '($relative_error / 1.213e-4 - 1) ^ 2 < 1e-6 && $stable == 1'
is nodes-chebyshev c11 '($relative_error / 7.627e-4 - 1) ^ 2 < 1e-6 && $stable == 1'
is richardson-nodes c11 '($relative_error / -4.73e-6 - 1) ^ 2 < 1e-4'
is nodes-chebyshev friction_force '($relative_error / 3.5e-4 - 1) ^ 2 < 1e-3'
is cosine friction_force '($relative_error / 3.0e-3 - 1) ^ 2 < 1e-3'
is chebyshev-states c11 '$relative_error < 1e-14 && $relative_error > -1e-14 && $stable == 1 && $on_front != ""'
is chebyshev-states traction '$relative_error < 1e-13 && $on_front != ""'
is chebyshev-states c11_z1 '$relative_error < 1e-14 && $stable == 1 && $on_front == 1'
grep -q 'chebyshev-states,.*friction_force' out && fail 'friction by Chebyshev states'
is polynomial c11_z1 '$relative_error < 1e-14 && $on_front == ""'
is closed-form c11_z1 '$n == "" && $relative_error < 1e-14 && $on_front == ""'
check 'times, and no model error' '$time_us > 0 && $model_error == "" && $relative_error < 0.1'
check 'a front of elements and states' '($on_front == "") == ($scheme == "polynomial" || $scheme == "closed-form")'
grep -q ',1,1,,ok,' out || fail 'an empty front'
[ "$(head -n 1 cheapest.csv)" = quantity,tolerance,among,scheme,n,relative_error,time_us,status ] &&
    [ "$(wc -l <cheapest.csv)" -eq 177 ] || fail "cheapest.csv"
grep -q '^c11,1e-12,elements,,,,,none$' cheapest.csv && grep -q '^c11,1e-2,stable-elements,[a-z]' cheapest.csv &&
    grep -q '^c11_z1,1e-12,stable,chebyshev-states,20,' cheapest.csv && grep -q '^c11_z1,1e-12,elements,,' cheapest.csv &&
    grep -q '^c11_z1,1e-12,all,[cp]' cheapest.csv || fail "cheapest schemes: $(cat cheapest.csv)"
good 5 "$precision" --n 4,6 --schemes ' cosine , knothe' --quantity c11
good 3 "$precision" --n 4,6 --schemes richardson-cosine --quantity c11 --aspect inf
check 'no stability without G' '$stable == "" && $relative_error < 0.02 && $relative_error > -0.02'
good 2 "$precision" --n 160 --schemes uniform-0/0.63 --quantity friction_force --jobs 2
check '0/0.63 is unstable at n = 160' '$stable == 0 && $time_us == "" && $on_front == ""'
good 3 "$precision" --n 40 --schemes cosine --quantity c11,c11_z1 --kernel strip --aspect 10
check 'the error of the strip is that of its model' '$model_error > 3e-4 && ($relative_error / $model_error - 1) ^ 2 < 0.01'

# --- both directions, and a load that varies: only elements, and all columns as for other friction
good 47 "$precision" --n 10,20,40 --schemes cosine,uniform-0.5/0.5,galerkin-cosine,richardson-cosine,nodes-chebyshev,chebyshev-states,polynomial,closed-form \
    --quantity friction_force,combined_force,load_force --cheapest cheapest.csv
grep -E '^(chebyshev|polynomial)' out && fail 'friction without elements'
grep -E '^closed-form' out | grep -qv ',friction_force,' && fail 'a closed form of what has none'
check 'times and stability of friction' '$time_us > 0 && $stable != "" && $model_error == ""'
for quantity in combined_force load_force; do
    grep -q ",$quantity,.*,1,1,,ok," out || fail "no front of $quantity"
    grep -q "^$quantity,1e-2,elements,[a-z]" cheapest.csv && grep -q "^$quantity,1e-2,stable-elements,[a-z]" cheapest.csv &&
        grep -q "^$quantity,1e-12,all,,,,,none\$" cheapest.csv || fail "cheapest schemes for $quantity"
done
# a mesh that breathes, and one that covers the largest contact, against errors of two other discretisations
row() { rows -v s="$1" -v size="$2" -v q="$3" '$scheme == s && $n == size && $quantity == q { ok = '"$4"' } END { exit !ok }' out || fail "$1 $2 $3: $(grep "$1,$2,$3" out)"; }
row cosine 20 load_force '($relative_error / 2.8e-3 - 1) ^ 2 < 0.03 ^ 2'
row cosine 40 load_force '($relative_error / 8.07e-4 - 1) ^ 2 < 0.01 ^ 2'
row uniform-0.5/0.5 40 load_force '($relative_error / 1.2e-2 - 1) ^ 2 < 0.05 ^ 2'
row cosine 40 friction_force '($relative_error / 9.05e-4 - 1) ^ 2 < 0.01 ^ 2'
# CONTACT, extrapolated, at 45 degrees: the distance of friction_study's force at n = 40 from it is the error here
$programs/friction_study --kernel plane --n 40 --creepage-ratio 0.35355339059327373 --lateral-ratio 0.35355339059327373 >both
awk -F, -v error="$(awk -F, '$1 == "cosine" && $2 == 40 && $3 == "combined_force" { print $4 }' out)" 'NR == 2 {
        size = sqrt((0.54356 ^ 2) + (0.40941 ^ 2)); found = sqrt(($8 - 0.54356) ^ 2 + ($16 - 0.40941) ^ 2) / size
        exit !((found - error) ^ 2 < 2e-5 ^ 2 && error > 5e-4) }' both || fail 'the error of the force as a vector'
row nodes-chebyshev 40 combined_force '($relative_error / 1.55e-4 - 1) ^ 2 < 0.02 ^ 2'
# for a Poisson's ratio of 0 the reference must be Carter's force along the creepage, to its precision
good 4 "$precision" --n 40,80,160 --schemes cosine --quantity combined_force --poisson 0 --aspect inf --jobs 2
check 'Carter at 45 degrees' '($relative_error - ($n == 40 ? 9.05e-4 : $n == 80 ? 2.67e-4 : 7.7e-5)) ^ 2 < 1.2e-5 ^ 2'
good 2 "$precision" --n 20 --schemes cosine --quantity combined_force --kernel strip --aspect 10 --jobs 2
check 'the strip has another force' '$model_error > 1e-4 && $relative_error > 0'
bad '--aspect = inf must be positive and finite' $p --quantity load_force --aspect inf
"$precision" --help | grep -q 'load_force: creepage ratio' || fail '--help says nothing of load_force'

# --- creep coefficients of patches, against Kalker's, whose limits at a/b = 0.5, nu = 0.25 are 3.625, 3.011, 0.9278
bad '--quantity = c11 must be all, or some of patch_c11,patch_c22,patch_c23,patch_c33,patch_force' "$precision" --quantity c11,patch_c11
bad '--strips = 4 has no effect without quantities of patches' $p --strips 4
bad '--a-over-b = 1 has no effect without quantities of patches' $p --a-over-b 1
bad '--kernel = plane has no effect with quantities of patches' "$precision" --quantity patch_c11 --kernel plane
bad '--schemes = cosine must be all, or some of nodes-chebyshev,richardson-nodes,uniform-strips' "$precision" --quantity patch_c11 --schemes cosine
bad '--n = 5 and the strips must be even' "$precision" --quantity patch_c11 --schemes richardson-nodes --n 5
bad '--n = 100 times 100 strips must be at most 4096' "$precision" --quantity patch_c11 --n 100
good 17 "$precision" --quantity patch_c11,patch_c22,patch_c23,patch_c33 --a-over-b 0.5 --poisson 0.25 --n 6,12 --schemes nodes-chebyshev,richardson-nodes --cheapest cheapest.csv
header scheme,n,quantity,relative_error,time_us,stable,on_front,model_error,status,kernel,aspect,poisson,size_ratio,epsilon,a_over_b,strips
check 'settings of patches' '$status == "ok" && $kernel == "half-space" && $poisson == 0.25 && $a_over_b == 0.5 && $strips == $n && $time_us > 0 && $stable == 1 && $on_front != ""'
$programs/patch_study --a-over-b 0.5 --poisson 0.25 --n 12 --quiet >both
limit() {
    awk -F, -v s="$1" -v q="patch_$2" -v exact="$3" -v least="$4" 'NR == FNR { if (FNR == 1) for (i = 1; i <= NF; ++i) if ("patch_" $i == q) k = i; found = $k; next }
        $1 == s && $2 == 12 && $3 == q { ok = s == "nodes-chebyshev" ? (found / (1 + $4) / exact - 1) ^ 2 < least ^ 2 : $4 ^ 2 < least ^ 2 } END { exit !ok }' both out ||
        fail "$1: $2: $(grep "$1,12,patch_$2" out)"
}
limit nodes-chebyshev c11 3.625 1e-3
limit nodes-chebyshev c22 3.011 1e-3
limit nodes-chebyshev c23 0.9278 1e-3
limit nodes-chebyshev c33 1.939 5e-3
limit richardson-nodes c11 0 1e-3
limit richardson-nodes c22 0 2e-3
grep -q '^patch_c11,1e-2,stable-elements,richardson-nodes,6,' cheapest.csv || fail "cheapest patches: $(cat cheapest.csv)"
good 7 "$precision" --quantity patch_force --n 4 --strips 2,4 --jobs 2
check 'n and strips' '$n == 4 && ($strips == 2 || $strips == 4) && $time_us == "" && $on_front == ""'
# forces: second order, and strips of equal width better than more that are graded
good 7 "$precision" --quantity patch_force --n 6,8,12 --schemes nodes-chebyshev,uniform-strips --no-timing
check 'strips of patch_force' '$strips == ($scheme == "nodes-chebyshev" ? $n : $n == 6 ? 3 : $n == 8 ? 5 : 7) && $status == "ok" && $time_us == ""'
check 'errors of forces' '$scheme == "uniform-strips" ? $relative_error * $n ^ 2 > 0.5 && $relative_error * $n ^ 2 < 1 : $relative_error * $n ^ 2 > 1.8 && $relative_error * $n ^ 2 < 2.8'
# --- Chebyshev states: known errors for the plane, b/a = 100 and nu = 0.25, which fall geometrically; the difference of
# strip and plane; problems that states cannot solve
good 9 "$precision" --n 6,8,10,12 --schemes chebyshev-states --quantity c11_z5,step_force --aspect 100 --poisson 0.25
at() { rows -v size="$1" -v q="$2" '$n == size && $quantity == q { ok = '"$3"' } END { exit !ok }' out || fail "$1 states: $2: $(cat out)"; }
at 6 c11_z5 '($relative_error / 5.3e-3 - 1) ^ 2 < 1e-3'
at 8 c11_z5 '($relative_error / 1.9e-4 - 1) ^ 2 < 1e-3'
at 10 c11_z5 '($relative_error / 1.7e-6 - 1) ^ 2 < 1e-3'
at 12 c11_z5 '($relative_error / 5.9e-9 - 1) ^ 2 < 1e-3'
at 8 step_force '$relative_error > 5e-5 && $relative_error < 5e-4'
good 5 "$precision" --n 16 --schemes chebyshev-states --quantity c11,c11_z0.1,c11_z1,step_force --kernel strip --aspect 10
check 'the error of states on the strip is that of its model' '($relative_error / $model_error - 1) ^ 2 < 0.01 && $relative_error != 0'
good 18 "$precision" --schemes chebyshev-states --quantity c11 --jobs 2
check 'from 1 to 48 states without --n' '$n >= 1 && $n <= 48'
bad '--aspect = 0.0005 must be at least 0.001 for the scheme chebyshev-states' $p --kernel strip --aspect 0.0005 --quantity c11
bad '--n = 4 must fit' $p --schemes chebyshev-states --quantity friction_force

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
adds_up "$programs/steady_study" --n 5,10 --alpha-T 0.5,0.63
adds_up "$programs/traction_study" --n 5,8
adds_up "$programs/stability_study" --n 5,8 --alpha-T 0.5,0.63
adds_up "$programs/stability_study" --n 5,8 --spectrum
adds_up "$programs/stability_study" --n 4,5,6,7 --critical
adds_up "$programs/frequency_study" --n 5,8 --omega 0.1,1,5
adds_up "$programs/frequency_study" --method polynomial --omega 0.1,1,5,10
adds_up "$programs/transient_study" --n 5,8 --step 1 --until 1
adds_up "$programs/friction_study" --n 5,8 --creepage-ratio 0.5,1.1
adds_up "$programs/friction_study" --n 5 --transient --creepage-ratio 0.5 --until 1
adds_up "$precision" --n 4,6 --schemes cosine,uniform-0/0.63,chebyshev-states,polynomial --quantity c11,c11_z1

# --- --front: leaves the whole as it is, fills the empty columns of shards, and refuses several contacts
sed '3s/,1000,/,100,/' whole >mixed
bad 'line 3 must have the kernel, aspect, poisson' "$precision" --front ../mixed
"$precision" --front whole >again || fail '--front'
cmp -s whole again || fail '--front changes a whole'
"$precision" --front parts --quantity c11 --cheapest cheapest.csv >filled || fail '--front of parts'
rows 'NR > 1 && $quantity != "c11" { bad = 1 } NR > 1 && ($on_front == "") != ($scheme == "polynomial") { bad = 1 } $on_front == 1 { front = 1 }
    END { exit bad || !front }' filled || fail "a front of parts: $(cat filled)"
grep -q '^c11,1e-2,elements,[a-z]' cheapest.csv || fail 'cheapest of parts'

# --- plot
if command -v gnuplot >/dev/null; then
    good 17 "$precision" --front whole --plot p.svg
    [ "$(grep -c '</svg>' p.svg)" -eq 1 ] && grep -q 'Pareto front' p.svg || fail 'plot'
    # a scheme has the same colour in every panel, although friction lacks two of them; small errors have a floor
    good 11 "$precision" --n 40 --schemes cosine,chebyshev-states,polynomial,closed-form \
        --quantity c11,c11_z5,friction_force --plot p.svg
    awk '/<title>/ { split($0, part, /<title>|<.title>/); title = part[2] }
        match($0, /rgb\([^)]*\)/) && title { colours[title] = colours[title] substr($0, RSTART, RLENGTH) ";"; title = "" }
        END { panels = split(colours["cosine"], c, ";") - 1
            exit !(panels == 3 && c[1] == c[2] && c[2] == c[3] && c[1] != "" && index(colours["polynomial"], c[1]) == 0) }' p.svg ||
        fail 'colours of the panels'
    grep -q '1e-14 or less' p.svg || fail 'no floor'
    grep -q 'quantities drawn' p.svg && fail 'a note although all quantities are drawn'
    good 6 "$precision" --n 10 --schemes cosine --quantity c11,traction,c11_z1,c11_z5,friction_force --plot p.svg
    grep -q '(3 of 5 quantities drawn)' p.svg || fail 'no note that quantities are left out'
    good 5 "$precision" --n 10 --schemes cosine --quantity traction,c11_z0.1,c11_z1,step_force --plot p.svg
    grep -q 'traction (3 of 4 quantities drawn)' p.svg || fail 'not the first three quantities'
fi
finish
