#!/bin/sh
# patch_study seen from outside: what it refuses, its columns, known coefficients, outlines, and the files of matrices.
# Usage: patch.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
patch="$programs/patch_study"

# --- bad input
p="$patch --output x.csv"
bad '--a-over-b = 0 must lie in' $p --a-over-b 0
bad '--poisson = 0.6 must lie in [0, 0.5]' $p --poisson 0.6
bad '--n = 0 must be an integer' $p --n 0
bad 'strips must be at most 10000' $p --n 200 --strips 100
bad '--strip-grading = linear' $p --strip-grading linear
bad '--method = galerkin' $p --method galerkin
bad '--nodes = both' $p --nodes both
bad '--alpha' $p --alpha 0.5
bad '--kernel' $p --kernel plane
bad '--aspect' $p --aspect 10
bad '--omega = -1' $p --omega -1
bad '--stability = true has no effect with --omega' $p --omega 1 --stability
bad '--states = 4 has no effect without --state-space' $p --states 4
bad 'must go with one patch' $p --state-space folder --n 4,6
outline() { printf 'y,x_trailing,x_leading\n%b' "$1" >"$scratch/outline.csv"; }
bad_outline() {
    outline "$2"
    bad "$1" $p --outline "$scratch/outline.csv"
}
bad 'must be a file that can be read' $p --outline missing.csv
bad_outline 'number of lines = 1 must be at least 2' '0,-1,1\n'
bad_outline 'number of lines = 0 must be at least 2' ''
bad_outline 'the edges cross' '-1,-1,1\n0,1,-1\n1,-1,1\n'
bad_outline 'line 3 = 1,nan,1 must be finite numbers' '0,-1,1\n1,nan,1\n'
bad_outline 'line 3 = 1,1 must be finite numbers' '0,-1,1\n1,1\n'
bad_outline 'y of line 2 = -2 must be larger' '-1,-1,1\n-2,-1,1\n'
bad_outline 'x_leading - x_trailing of line 2 = 0 must be positive' '-1,-1,1\n0,0.5,0.5\n1,-1,1\n'
bad_outline 'area = 0 must be positive' '-1,0,0\n1,0,0\n'
printf 'x,y\n1,2\n' >"$scratch/outline.csv"
bad 'line 1 = x,y must be y,x_trailing,x_leading' $p --outline "$scratch/outline.csv"
outline '-1,-1,1\n1,-1,1\n'
bad '--a-over-b = 1 has no effect with --outline' $p --outline "$scratch/outline.csv" --a-over-b 1
printf -- '-1\n0.5\n0.2\n1\n' >"$scratch/edges"
bad 'line 3 = 0.2 must be larger than the line before' $p --strip-edges "$scratch/edges"
printf -- '-0.9\n1\n' >"$scratch/edges"
bad 'line 1 = -0.9 must be -1, the smallest y' $p --strip-edges "$scratch/edges"
printf -- '-1\n0.5\n' >"$scratch/edges"
bad '--strips = 4 has no effect with --strip-edges' $p --strips 4 --strip-edges "$scratch/edges"
bad 'must end with 1, the largest y' $p --strip-edges "$scratch/edges"
bad '--omega = 1 has no effect with friction' $p --spin 1 --omega 1
bad '--stability = true has no effect with friction' $p --lateral 1 --stability
bad '--tractions = t.csv has no effect without' $p --tractions t.csv
bad "Hertz's contact is an ellipse" $p --longitudinal 1 --outline "$scratch/outline.csv"
bad '--spin = nan must lie in' $p --spin nan
bad '--lateral = x must be a number' $p --lateral x

# --- steady coefficients
good 2 "$patch" --n 12 --poisson 0.25
header a_over_b,poisson,n,strips,c11,c22,c23,c32,c33,residual,assembly_us,solve_us,status
check 'c11 ... c33 of a circle' '$c11 > 4.12255 && $c11 < 4.12265 && $c22 > 3.66955 && $c22 < 3.66965 && $c23 > 1.47585 &&
    $c23 < 1.47595 && $c32 > -1.46245 && $c32 < -1.46235 && $c33 > 1.19075 && $c33 < 1.19085 && $residual < 1e-15 && $status == "ok"'
good 19 "$patch" --n 4,6 --strips 3,5,6 --a-over-b 0.5,1,2 --no-timing
check 'order and timing' 'NR > 2 ? $assembly_us == "" : $n == 4 && $strips == 3 && $a_over_b == 0.5'
good 2 "$patch" --n 1 --strips 1 --stability
header a_over_b,poisson,n,strips,c11,c22,c23,c32,c33,residual,assembly_us,solve_us,unstable_count,uncertain_count,spectral_abscissa,status
check 'one element decays, and has no moment' '$c33 == 0 && $unstable_count == 0 && $uncertain_count == 0 && $spectral_abscissa < 0 && $status == "ok"'
good 3 "$patch" --n 16 --strips 4,16 --a-over-b 20 --poisson 0.5 --stability
check 'strips of any width decay' '$unstable_count == 0 && $uncertain_count == 0 && $spectral_abscissa < 0'
shards "$patch" --n 4,5,6 --strips 4,6 --no-timing

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
check 'strips of a file' '$strips == 4 && $NF == "chebyshev"'

# --- frequency response and differential equations
good 4 "$patch" --n 12 --poisson 0.28 --omega 0,1,3
header a_over_b,poisson,n,strips,omega,c11_re,c11_im,c22_re,c22_im,c23_re,c23_im,c32_re,c32_im,c33_re,c33_im,status
check 'c11 at omega = 1' '$omega != 1 || $c11_re > 1.19 && $c11_re < 1.22 && $c11_im > -2.14 && $c11_im < -2.08'
check 'steady at omega = 0' '$omega != 0 || $c11_im == 0 && $c33_im == 0'
good 2 "$patch" --n 4 --a-over-b 2 --state-space space --no-timing
[ "$(ls space | tr '\n' ' ')" = 'A.csv B.csv C.csv D.csv state_space.toml ' ] || fail "files: $(ls space)"
awk -F, 'END { exit !(NR == 32 && NF == 32) }' space/A.csv || fail 'size of A'
awk -F, 'END { exit !(NR == 32 && NF == 3) }' space/B.csv || fail 'size of B'
awk -F, 'END { exit !(NR == 3 && NF == 32) }' space/C.csv || fail 'size of C'
grep -q 'phi c' space/state_space.toml || fail 'conventions of state_space.toml'
good 2 "$patch" --n 6 --state-space reduced --states 8 --no-timing
awk -F, 'END { exit !(NR == 8 && NF == 8) }' reduced/A.csv || fail 'size of the reduced A'
grep -q '^error_bound' reduced/state_space.toml || fail 'bound of the reduction'

# --- friction: the limits of Kalker's program within the error of 12 x 12 elements, spin alone, full sliding, one element
good 5 "$patch" --n 12 --longitudinal 0,0.2366 --spin 0,0.672 --no-timing --tractions t.csv
header a_over_b,poisson,n,strips,longitudinal,lateral,spin,longitudinal_force,lateral_force,spin_moment,stick_count,rounds,complementarity_residual,time_us,status
check 'statuses and residuals' '$complementarity_residual < 1e-12 && $time_us == "" && $status == "ok"'
check 'rest' '$longitudinal + $spin > 0 || $longitudinal_force == 0 && $lateral_force == 0 && $spin_moment == 0 && $stick_count == 144'
check 'creepage' '$longitudinal == 0 || $spin > 0 || $longitudinal_force > 0.7187 && $longitudinal_force < 0.7226 && $lateral_force < 1e-12'
check 'spin' '$longitudinal > 0 || $spin == 0 || $longitudinal_force < 1e-12 && $longitudinal_force > -1e-12 && $lateral_force > 0.593 && $lateral_force < 0.607 && $spin_moment > 0.39 && $spin_moment < 0.41'
mv t.csv out
header a_over_b,poisson,n,strips,longitudinal,lateral,spin,x,y,width,strip_width,pressure_bound,traction_x,traction_y,slip_x,slip_y,stick,status
check 'the law on each element' '$traction_x ^ 2 + $traction_y ^ 2 < $pressure_bound ^ 2 * (1 + 1e-9) && ($stick == 1 || $traction_x * $slip_x + $traction_y * $slip_y <= 0)'
rows 'NR > 1 && $longitudinal > 0 && $spin > 0 { F += $width * $strip_width * $traction_x; N += $width * $strip_width * $pressure_bound; ++k } END {
    exit !(k == 144 && N > 2.09439 && N < 2.0944 && F < 0 && F > -N) }' out || fail 'sums over the elements'
good 3 "$patch" --n 1 --longitudinal 1 --a-over-b 0.5,2
check 'one element slides' '$longitudinal_force > 0.999999 && $longitudinal_force < 1.000001 && $stick_count == 0 && $time_us > 0'
shards "$patch" --n 4,6 --longitudinal 0.1,0.2 --spin 0,0.3 --no-timing

finish
