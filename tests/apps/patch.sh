#!/bin/sh
# patch_study seen from outside: outlines, pressures and loads of files, and the files of matrices.
# Usage: patch.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
patch="$programs/patch_study"
outline() { printf 'y,x_trailing,x_leading\n%b' "$1" >"$scratch/outline.csv"; }
pressure() { printf 'x,y,pressure\n%b' "$1" >"$scratch/pressure.csv"; }
loads() { printf 'q_over_a,load_ratio,a_ratio,b_ratio\n%b' "$1" >"$scratch/load.csv"; }

# --- outlines: a rectangle given twice, in other units and with strips of its own
outline '-2,-1,1\n2,-1,1\n'
good 2 "$patch" --n 8 --outline "$scratch/outline.csv" --no-timing
tail -n 1 out | cut -d, -f5-9 >one
outline '-2e-3,-1e-3,1e-3\n0,-1e-3,1e-3\n2e-3,-1e-3,1e-3\n'
good 2 "$patch" --n 8 --outline "$scratch/outline.csv" --no-timing
check 'no a/b' '$a_over_b == ""'
tail -n 1 out | cut -d, -f5-9 | paste -d, one - | awk -F, '{ for (k = 1; k < 6; ++k) if ($k / $(k + 5) - 1 > 1e-12 ||
    1 - $k / $(k + 5) > 1e-12) bad = 1 } END { exit bad }' || fail 'the unit of length matters'
printf -- '-2e-3\n-1e-3\n0\n1.5e-3\n2e-3\n' >"$scratch/edges"
good 2 "$patch" --n 8 --outline "$scratch/outline.csv" --strip-edges "$scratch/edges"
check 'strips of a file' '$strips == 4 && $nodes == "chebyshev"'

# an ellipse of a/b = 2 turned by 30 degrees and its mirror image: all nine coefficients, also in the frequency response
for turn in 1 -1; do
    awk -v turn=$turn 'BEGIN { print "y,x_trailing,x_leading"; pi = 4 * atan2(1, 1); c = cos(pi / 6)
        s = turn * sin(pi / 6)
        A = c * c / 4 + s * s; B = s * c * (0.25 - 1); C = s * s / 4 + c * c; top = sqrt(A / (A * C - B * B))
        for (j = -200; j <= 200; ++j) {
            y = top * sin(j / 400 * pi); root = sqrt((B * y) ^ 2 - A * (C * y * y - 1) + 1e-30)
            printf "%.15g,%.15g,%.15g\n", y, (-B * y - root) / A, (-B * y + root) / A } }' >turned.csv
    "$patch" --n 16 --outline turned.csv --no-timing | tail -n $((1 + (turn > 0)))
done >out
check 'all nine coefficients' '$c12 ^ 2 > 0.221 ^ 2 && $c12 ^ 2 < 0.223 ^ 2 && $c13 ^ 2 > 0.257 ^ 2 &&
    $c13 ^ 2 < 0.259 ^ 2 && $c12 * $c13 > 0'
check 'the mirror image' 'NR == 2 && (a = $c12) + (b = $c13) + (c = $c21) + (d = $c31) + (e = $c23) != 0 ||
    NR == 3 && a < 0 && ($c12 + a) ^ 2 + ($c13 + b) ^ 2 + ($c21 + c) ^ 2 + ($c31 + d) ^ 2 + ($c23 - e) ^ 2 < 1e-20'
cut -d, -f"$(column c21),$(column c31)" out | tail -n 1 >steady
"$patch" --n 16 --outline turned.csv --omega 0 >out
cut -d, -f"$(column c21_re),$(column c31_re)" out | tail -n 1 | paste -d, - steady |
    awk -F, '{ exit !(($1 / $3 - 1) ^ 2 + ($2 / $4 - 1) ^ 2 < 1e-20) }' || fail 'c21 and c31 at omega = 0'

# --- differential equations
good 2 "$patch" --n 4 --a-over-b 2 --state-space space --no-timing
[ "$(ls space | tr '\n' ' ')" = 'A.csv B.csv C.csv D.csv state_space.toml ' ] || fail "files: $(ls space)"
awk -F, 'END { exit !(NR == 32 && NF == 32) }' space/A.csv || fail 'size of A'
awk -F, 'END { exit !(NR == 32 && NF == 3) }' space/B.csv || fail 'size of B'
awk -F, 'END { exit !(NR == 3 && NF == 32) }' space/C.csv || fail 'size of C'
grep -q 'c21 c22 c23' space/state_space.toml && grep -q '^# status = not_converged' space/state_space.toml ||
    fail 'words of state_space.toml'
good 2 "$patch" --n 6 --state-space reduced --states 8 --no-timing
awk -F, 'END { exit !(NR == 8 && NF == 8) }' reduced/A.csv || fail 'size of the reduced A'
grep -q '^# error_bound' reduced/state_space.toml || fail 'bound of the reduction'

# --- a pressure of a table, in any unit: a rectangle whose pressure is 2/3 of Hertz's peak everywhere, and Hertz's
# pressure as a table on an ellipse and on the same ellipse as an outline
outline '-2e-3,-1e-3,1e-3\n2e-3,-1e-3,1e-3\n'
pressure '-1e-3,-2e-3,7e8\n-1e-3,3e-3,7e8\n2e-3,-2e-3,7e8\n2e-3,3e-3,7e8\n'
good 2 "$patch" --n 6 --outline "$scratch/outline.csv" --pressure "$scratch/pressure.csv" --longitudinal 3 \
    --tractions t.csv
check 'all slides' '$longitudinal_force > 0.9999 && $stick_count == 0 && $a_over_b == ""'
mv t.csv out
check 'uniform bound' '$pressure_bound > 0.666666 && $pressure_bound < 0.666667'
awk 'BEGIN {
    print "y,x_trailing,x_leading" >"ellipse.csv"
    print "x,y,pressure" >"hertz.csv"
    print "x,y,pressure" >"hertz_in_mm.csv"
    for (j = -60; j <= 60; ++j) {
        y = j / 60; angle = y * atan2(1, 0)
        printf "%.9f,%.9f,%.9f\n", 1.5 * sin(angle), -3 * cos(angle), 3 * cos(angle) >"ellipse.csv"
        for (i = -60; i <= 60; ++i) {
            x = i / 60; p = x * x + y * y < 1 ? sqrt(1 - x * x - y * y) : 0
            printf "%.9f,%.9f,%.9f\n", x, y, p >"hertz.csv"
            printf "%.9f,%.9f,%.9f\n", 3 * x, 1.5 * y, p >"hertz_in_mm.csv"
        }
    }
}'
set -- --n 6 --longitudinal 0.1 --lateral 0.1 --spin 0.3 --no-timing
"$patch" "$@" --a-over-b 2 >out
"$patch" "$@" --a-over-b 2 --pressure hertz.csv | tail -n 1 >>out
"$patch" "$@" --outline ellipse.csv --pressure hertz_in_mm.csv | tail -n 1 >>out
check 'one ellipse in three ways' '$status == "ok" && NR <= 4 &&
    (NR > 2 || (F = $longitudinal_force) + (Q = $lateral_force) + (M = $spin_moment) > 0) &&
    ($longitudinal_force / F - 1) ^ 2 + ($lateral_force / Q - 1) ^ 2 + ($spin_moment / M - 1) ^ 2 < 1e-6'

# --- in the time domain: orders; under a load
orders longitudinal_force "$patch" --n 6 --longitudinal 0.0946467 --transient --until 2 --no-timing

# under a load: a table of ones changes nothing; eight times the load on twice the ellipse at half the creepage is the
# same; forces follow the load to zero and back; a period must be resolved
set -- "$patch" --n 6 --a-over-b 0.5 --lateral 0.1 --spin 0.2 --transient --no-timing
good 21 "$@" --dq 0.1 --until 2
mv out constant
loads '0,1,1,1\n0.25,1,1,1\n2,1,1,1\n'
good 21 "$@" --dq 0.1 --until 2 --load "$scratch/load.csv"
paste -d, constant out | awk -F, 'NR == 1 { for (k = NF / 2; k > 0; --k) place[$k] = k } NR > 1 && NR != 4 {
    for (name in place) if (name ~ /force|moment|count/ &&
        ($place[name] - $(place[name] + NF / 2)) ^ 2 > 1e-5) exit 1 }' ||
    fail 'a load of ones'
printf 'load_ratio;q_over_a\n8;0\n8;4\n' >"$scratch/load.csv"
"$patch" --n 6 --a-over-b 0.5 --lateral 0.2 --spin 0.2 --transient --no-timing --dq 0.2 --until 4 \
    --load "$scratch/load.csv" >out
check 'semi-axes' '$a_ratio == 2 && $b_ratio == 2'
paste -d, constant out | awk -F, 'NR == 1 { for (k = NF / 2; k > 0; --k) place[$k] = k } NR > 1 {
    if ((8 * $place["lateral_force"] / $(place["lateral_force"] + NF / 2) - 1) ^ 2 > 1e-20) exit 1
    if ((16 * $place["spin_moment"] / $(place["spin_moment"] + NF / 2) - 1) ^ 2 > 1e-20) exit 1 }' ||
    fail 'scaling of the load'
set -- "$patch" --n 6 --lateral 0.1 --spin 0.2 --transient --no-timing
loads '0,1,1,1\n4,1,1.5,0.75\n20,1,1.5,0.75\n'
good 101 "$@" --dq 0.2 --until 20 --load "$scratch/load.csv" --breathing --from steady
tail -n 1 out | cut -d, -f"$(column lateral_force)" >end
check 'energy of a patch that changes its shape' '$status == "ok" &&
    (NR > 2 || (E = $elastic_energy + $slip_work - $creep_work)) &&
    ($elastic_energy + $slip_work - $creep_work - E) ^ 2 < (0.03 * $creep_work + 1e-3) ^ 2'
# the ellipse of the end: a b is larger by 1.125, which the creepages and c are measured in
good 81 "$patch" --n 6 --a-over-b 2 --lateral 0.1125 --spin 0.2386485 --transient --dq 0.125 --until 10 --from steady \
    --no-timing
tail -n 1 out | cut -d, -f"$(column lateral_force)" | paste - end | awk '{ exit !(($1 / $2 - 1) ^ 2 < 1e-7) }' ||
    fail "the force under the last ellipse is not $(cat end): $(tail -n 1 out)"
# without --breathing the mesh follows a table of semi-axes all the same, or says where it is too coarse
"$patch" --n 6 --lateral 0.1 --transient --until 6 --load "$scratch/load.csv" --no-timing >out
"$patch" --n 6 --lateral 0.1 --transient --until 6 --load "$scratch/load.csv" --no-timing --breathing | cmp -s - out ||
    fail 'a table of semi-axes'
loads '0,1,1,1\n4,1,1,0.1\n20,1,1,0.1\n'
for fixed in --breathing=false --quiet; do
    good 61 "$patch" --n 12 --lateral 0.1 --transient --dq 0.1 --until 6 --load "$scratch/load.csv" --no-timing $fixed
    check 'an ellipse of few strips' '$status == ($b_ratio > 0.38 ? "ok" : "unresolved") &&
        ($status == "ok") == ($lateral_force $slip_work != "")'
    loads '0,1,1,1\n4,1,1,0.1\n20,0,1,0.1\n'
done
for topic in outline pressure stability friction transient; do "$patch" --help $topic >out || fail "--help $topic"; done

# --- CONTACT's catt_to_cart: a force of 0.657 mu N on a circle, first by a shift, 1.7746e-2 mm, then rolling, until the
# creepage is 3.168e-3, with mu N/G = 0.18881 mm^2 and a = 3.5 mm
good 34 "$programs/patch_study" --n 12 --transient --force 0.657 --dq 0.25 --until 8
check "CONTACT's shift" '$q_over_a > 0 || ($shift_x * 0.18881 / 3.5 / 1.7746e-2 - 1) ^ 2 < 0.004 ^ 2 && $longitudinal == 0'
check "CONTACT's creepage" '$q_over_a < 7.9 || ($longitudinal * 0.18881 / 3.5 ^ 2 / 3.168e-3 - 1) ^ 2 < 0.004 ^ 2'
check 'the force' '($longitudinal_force - 0.657) ^ 2 < 1e-24'

finish
