#!/bin/sh
# --method chebyshev of the studies of full adhesion and --state-space of frequency_study, seen from outside: what they
# refuse, empty cells, known errors for each number of states, and the files of matrices.
# Usage: chebyshev.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
steady="$programs/steady_study --method chebyshev"
traction="$programs/traction_study --method chebyshev"
stability="$programs/stability_study --method chebyshev"
frequency="$programs/frequency_study --method chebyshev"
transient="$programs/transient_study --method chebyshev --integrator exponential"
plane='--kernel plane --aspect 100 --poisson 0.25'

# near NAME NUMBER...: the absolute values in that column of the file out are within 20 % of these numbers.
near() {
    column=$1
    shift
    cut -d, -f"$(column "$column")" out | tail -n +2 | awk -v numbers="$*" 'BEGIN { count = split(numbers, expected, " ") }
        { size = $1 < 0 ? -$1 : $1; if ($1 == "" || size < expected[NR] / 1.2 || size > expected[NR] * 1.2) bad = 1 }
        END { exit bad || NR != count }' || fail "column $column is not near $*: $(cat out)"
}

# --- bad input: options that need elements
for option in mesh=cosine edges=e size-ratio=2 epsilon=0.4 quadrature=exact nodes=centres derivative=fd alpha=0.5 alpha-L=0 \
    alpha-T=0.63; do
    bad "--${option%=*} = ${option#*=} has no effect with --method chebyshev" $steady --$option
done
bad '--lambda = 1 has no effect with --method chebyshev' $stability --lambda 1
bad '--n = 0 must be an integer in [1, 10000]' $steady --n 0
bad '--n = 10001 must be an integer in [1, 10000]' $steady --n 8,10001
bad '--aspect = 1e-4 must be at least 0.001 with --method chebyshev' $steady --aspect 1e-4
bad '--aspect = inf must be positive and finite' $stability --aspect inf
bad '--aspect = 0.1 must be larger than' $stability --kernel plane --aspect 0.1
for study in steady traction stability frequency transient; do
    "$programs/${study}_study" --help | grep -q 'Chebyshev states' || fail "--help of $study"
done
bad '--method = chebyshev must be collocation or galerkin with --critical' $stability --critical
bad '--method = nodes must be collocation or galerkin with --critical' ${stability%% *} --method nodes --critical
bad 'has too few states for so narrow a strip' $transient --step 1 --n 4 --aspect 0.3 --output x.csv
for options in '' '--transient --creepage-ratio 0.5'; do
    bad '--method = chebyshev must be one of collocation, galerkin, knothe-bc, nodes: friction' \
        "$programs/friction_study" --method chebyshev --output x.csv $options
done

# --- steady: exact to round-off for the plane and for infinite width; narrow strips need more states, and say so
good 5 $steady --n 1,2,8,40 --kernel plane --poisson 0.25
header method,derivative,mesh,n,alpha_L,alpha_T,c11,c11_exact,c11_ratio,relative_error,residual,assembly_us,solve_us
check 'names and empty cells' '$method == "chebyshev" && $derivative $mesh $alpha_L $alpha_T $residual $assembly_us == "" && $solve_us > 0'
check 'the plane, to rounding' '$c11 != "" && $relative_error ^ 2 < 1e-30 && $error_estimate > 0 && $error_estimate < 1e-13'
good 3 $steady --n 1,8 --aspect inf --jobs 2
check 'infinite width, to rounding' '$c11 != "" && $relative_error ^ 2 < 1e-30 && $solve_us == ""'
good 4 $steady --n 8,16,60 --aspect 1
rows 'NR > 1 { c[NR] = $c11 } END { coarse = c[2] / c[4] - 1; fine = c[3] / c[4] - 1
    exit !(coarse ^ 2 < 1e-10 && coarse ^ 2 > 1e-11 && fine ^ 2 < 1e-16 && fine ^ 2 > 1e-18) }' out ||
    fail "states in a strip of b/a = 1: $(cat out)"
check 'the estimate bounds the error' '$error_estimate > ($n == 8 ? 5e-6 : 0)'
good 3 $steady --n 4,32 --aspect 0.3
check 'no c11 of too few states' '($n == 4 ? $c11 $c11_ratio $relative_error == "" && $error_estimate > 1e-2 : $c11 > 3.7 && $error_estimate < 1e-7) && $c11_exact > 2'
shards $steady --n 1,2,3,4,5

# --- tractions at the Chebyshev points
good 32 $traction --n 11,20 --kernel plane
header n,x_over_a,traction,carter,carter_mean,relative_error,alpha_L,alpha_T
check 'Carter at the point' '$traction < 0 && $carter < 0 && $carter_mean $alpha_L $alpha_T == "" && $relative_error ^ 2 < 1e-26 && ($traction / $carter - 1 - $relative_error) ^ 2 < 1e-30'
check 'Carter' '($carter + sqrt((1 - $x_over_a) / (1 + $x_over_a)) / 1.44) ^ 2 < 1e-24 * $carter ^ 2'
check 'points, trailing to leading' \
    '($2 + cos((2 * (NR - ($1 == 11 ? 1 : 12)) - 1) * 3.14159265358979324 / (2 * $1))) ^ 2 < 1e-30'
rows 'NR == 7 { middle = $x_over_a == 0 } END { exit !middle }' out || fail 'the point in the middle'
good 13 $traction --n 12 --aspect inf
check 'infinite width' '$traction != "" && $relative_error ^ 2 < 1e-26'
good 5 $traction --n 4 --aspect 0.3
check 'no traction of too few states' '$traction $relative_error == "" && $carter < 0'
shards $traction --n 3,8

# --- stability
good 6 $stability --n 1,2,3,12,96 $plane
check 'names and empty cells' '$method == "chebyshev" && $derivative $mesh $alpha_L $alpha_T $lambda == "" && $time_us > 0'
check 'all modes decay' '$unstable_count == 0 && $uncertain_count == 0 && $unstable_fraction == 0 && $spectral_abscissa < 0 && $cond_G < 1.4143 && $spectral_radius > 0'
# errors of the first eigenvalues in one half of the complex plane
for states in 4:1:5.2e-11 12:2:2.5e-11 16:3:6.7e-10; do
    echo "$states" | tr : ' ' >expected
    read -r n mode error <expected
    good $((n + 1)) $stability --spectrum --n "$n" $plane
    rows -v mode="$mode" -v error="$error" 'NR > 1 && $im >= 0 && ++k == mode {
        size = sqrt(($re - $exact_re) ^ 2 + ($im - $exact_im) ^ 2); good = size > error / 1.5 && size < error * 1.5 }
        END { exit !good }' out || fail "eigenvalue $mode with $n states: $(cat out)"
done
check 'no alpha, no lambda' '$alpha_L $alpha_T $lambda == ""'

# --- frequency
good 5 $frequency --n 4,6,8,12 $plane --omega 1
check 'empty cells' '$alpha_L $alpha_T $lambda $order $error_estimate == "" && $rcond > 0'
check 'at omega = 1' '$n > 6 || ($relative_error / ($n == 4 ? 1.0e-5 : 1.1e-9) - 1) ^ 2 < 0.04'
check 'at omega = 1, to rounding from 8 states on' '$relative_error < ($n < 8 ? 2e-5 : 5e-14)'
good 5 $frequency --n 6,8,10,12 $plane --omega 5
near relative_error 5.3e-3 1.9e-4 1.7e-6 5.9e-9
good 3 $frequency --n 16,400 $plane --omega 5
check 'at omega = 5, to rounding' '$relative_error < 5e-14'
good 4 $frequency --n 4,16,32 --aspect 0.3 --omega 1
check 'no c11 of too few states' '($c11_re $c11_im $relative_error == "") == ($n == 4) && $exact_re != ""'
shards $frequency --n 3,5 --omega 0.1,1,3

# --- the response to a step, one and five half-lengths after it
good 16 $transient --step 1 --n 8,12,48 $plane --dq 1 --until 5
header q_over_a,creepage,force,exact,relative_error
check 'empty cells' '$method == "chebyshev" && $derivative $mesh $alpha_L $alpha_T $lambda == ""'
cp out step
rows '$q_over_a == 1 || NR == 1' step >out
near relative_error 1.8e-4 3.7e-5 1.1e-6
rows '$q_over_a == 5 && $n < 48 || NR == 1' step >out
near relative_error 1.8e-7 8.1e-9
shards $transient --step 1 --n 3,4 --until 1
good 21 $transient --step 1 --n 4 --aspect 0.3 --until 1 --unchecked

# --- the state space: bad input leaves no file
f="$programs/frequency_study --omega 0,0.7,5"
bad '--state-space = d must go with one scheme; the values of --n,' $f --method chebyshev --state-space d
bad 'make 2' $f --n 10 --alpha-T 0.5,0.63 --state-space d
bad '--state-space = d has no effect with --method polynomial' $f --method polynomial --state-space d
bad '--shard = 1/2 cannot go with --state-space' $f --n 8 --shard 1/2 --state-space d
bad 'rcond of G = ' $f --n 300 --state-space d --output x.csv
bad 'does not converge to full adhesion' $f --n 20 --alpha 1.5 --state-space d
bad 'has too few states' $f --method chebyshev --n 4 --aspect 0.3 --state-space d
bad '--states = 3 has no effect without --state-space' $f --n 8 --states 3
bad '--states = 9 must be an integer in [1, 8]' $f --method chebyshev --n 8 --state-space d --states 9
bad '--states = 0 must be an integer in [1, 8]' $f --method chebyshev --n 8 --state-space d --states 0
f="$f --method chebyshev --n 8"
bad "--state-space = '' must not be empty" $f --state-space ''
bad '--state-space = - must be a folder that can be written' $f --state-space -
bad '--state-space = /dev/null must be a folder that can be written' $f --state-space /dev/null
bad '--state-space = /dev/null/d must be a folder that can be written' $f --state-space /dev/null/d
bad '--output = /nonexistent/x.csv must be' $f --state-space "$scratch/d/e/f" --output /nonexistent/x.csv
bad 'A.csv of --state-space = d must not be written to as well as --output = d/A.csv' $f --state-space d --output d/A.csv
mkdir -p blocked/C.csv
bad '--state-space = blocked/C.csv must be a file' sh -c "cd .. && $f --state-space blocked"
[ "$(ls blocked)" = C.csv ] || fail "files are left: $(ls blocked)"

# c11 z A B C D: real and imaginary part of C (i z - A)^-1 B + D, by elimination in real numbers.
c11() {
    awk -v z="$1" -F, 'FILENAME ~ "A.csv" { n = NF; for (k = 1; k <= n; ++k) { m[FNR, k] = -$k; m[FNR + NF, k + NF] = -$k }
            m[FNR, FNR + n] = -z; m[FNR + n, FNR] = z }
        FILENAME ~ "B.csv" { m[FNR, 2 * n + 1] = $1; m[FNR + n, 2 * n + 1] = 0; good += NF == 1 }
        FILENAME ~ "C.csv" { for (k = 1; k <= n; ++k) c[k] = $k; good += NF == n }
        FILENAME ~ "D.csv" { d = $1; good += NF == 1 }
        END {
            N = 2 * n
            for (i = 1; i <= N; ++i) {
                p = i
                for (r = i + 1; r <= N; ++r) if (m[r, i] ^ 2 > m[p, i] ^ 2) p = r
                for (k = i; k <= N + 1; ++k) { t = m[i, k]; m[i, k] = m[p, k]; m[p, k] = t }
                for (r = 1; r <= N; ++r) {
                    if (r == i || m[r, i] == 0) continue
                    t = m[r, i] / m[i, i]
                    for (k = i; k <= N + 1; ++k) m[r, k] -= t * m[i, k]
                }
            }
            re = d
            for (k = 1; k <= n; ++k) { re += c[k] * m[k, N + 1] / m[k, k]; im += c[k] * m[k + n, N + 1] / m[k + n, k + n] }
            if (good == n + 2) printf "%.17g %.17g\n", re, im
        }' "$2/A.csv" "$2/B.csv" "$2/C.csv" "$2/D.csv"
}

# --- the state space: its matrices give the c11 of the table
mkdir there && echo old >there/A.csv && echo other >there/note
for scheme in '--method chebyshev --n 8' '--method chebyshev --n 1' '--mesh cosine --alpha 0.5 --n 15' \
    '--method knothe-bc --n 9'; do
    for folder in there made/below; do
        good 4 "$programs/frequency_study" --omega 0,0.7,5 --state-space $folder $plane $scheme
        tail -n +2 out | while IFS=, read -r _ z re im _; do
            c11 "$z" $folder | awk -v re="$re" -v im="$im" '{ read = 1; exit ($1 - re) ^ 2 + ($2 - im) ^ 2 > 1e-24 * (re ^ 2 + im ^ 2) }
                END { if (!read) exit 1 }' || echo "$z"
        done >wrong
        [ ! -s wrong ] || fail "c11 of the files at omega = $(cat wrong): $scheme in $folder"
        [ "$(cat $folder/D.csv)" = 0 ] || fail "D = $(cat $folder/D.csv)"
        grep -q '^command_line = ".*--state-space' $folder/state_space.toml || fail 'companion file'
    done
    [ "$(ls there | tr '\n' ' ')$(cat there/note)" = 'A.csv B.csv C.csv D.csv note state_space.toml other' ] ||
        fail "files in a folder that was there: $(ls there)"
    rm -r made
done
$f $plane --state-space exact >out
rows 'NR == 3 { exit !($relative_error < 1e-13 && $relative_error != "") }' out || fail 'the table beside the files'
grep -q ',-0\|^-0$' exact/*.csv && fail 'negative zeros'
# reduced: the steady state of the table, and elsewhere within the bound
$frequency --n 24 --omega 0,0.7,5 $plane --state-space reduced --states 5 >out
[ "$(wc -l <reduced/A.csv)" -eq 5 ] && grep -q '^states = 5$' reduced/state_space.toml || fail 'number of states'
value() { sed -n "s/^$1 = \([^ ]*\).*/\1/p" reduced/state_space.toml; }
tail -n +2 out | while IFS=, read -r _ z re im _; do
    c11 "$z" reduced | awk -v z="$z" -v re="$re" -v im="$im" -v bound="$(value error_bound)" \
        -v left="$(value largest_hankel_singular_value_left_out)" '{ error = sqrt(($1 - re) ^ 2 + ($2 - im) ^ 2)
            read = left > 0 && bound >= 2 * left && bound < 0.02
            exit z == 0 ? error > 1e-13 : error > bound || error < bound / 1000 } END { if (!read) exit 1 }' || echo "$z"
done >wrong
[ ! -s wrong ] || fail "the reduced system at omega = $(cat wrong)"
if command -v python3 >/dev/null && python3 -c 'import numpy, tomllib' 2>/dev/null; then
    python3 - <<'END' || fail 'numpy does not read the files'
import numpy as np, tomllib
A, B, C, D = (np.loadtxt(f'exact/{name}.csv', delimiter=',', ndmin=2) for name in 'ABCD')
assert A.shape == (8, 8) and C.shape == (1, 8) and B.shape == (8, 1) and D.shape == (1, 1)
tomllib.load(open('exact/state_space.toml', 'rb'))
END
fi
printf 'state-space = "configured"\nmethod = "chebyshev"\nn = 3\nomega = 1\n' >c.toml
good 2 "$programs/frequency_study" --config c.toml
[ -s configured/A.csv ] || fail '--state-space in a configuration file'

# --- all files or none: a full disk, a table that cannot be written
echo old >exact/A.csv
for folder in exact full/below; do
    (ulimit -f 1 && $f --state-space $folder >out 2>err)
    [ $? -eq 4 ] && [ "$(wc -l <err)" -eq 1 ] && [ ! -s out ] || fail "a full disk: $(cat err)"
done
$f --state-space full/below >/dev/full 2>err
[ $? -eq 4 ] && [ "$(cat exact/A.csv)" = old ] && [ ! -e full/below/A.csv ] || fail 'a file in spite of an error'
[ -z "$(find . -name '*.part')" ] || fail "temporary files are left: $(find . -name '*.part')"
PATH=/nonexistent $f --state-space full --plot x.svg >out 2>err
[ $? -eq 3 ] && [ "$(wc -l <full/A.csv)" -eq 8 ] && [ "$(wc -l <out)" -eq 4 ] || fail 'files without gnuplot'

# --- plots
if command -v gnuplot >/dev/null; then
    $steady --n 1,2,4 --kernel plane --plot s.svg >out 2>err && grep -q 'number of states' s.svg || fail "steady: $(cat err)"
    $stability --n 2,4 --plot s.svg >out 2>err && grep -q 'number of states' s.svg || fail "stability: $(cat err)"
    $stability --spectrum --n 8 --plot s.svg >out 2>err && grep -q 'Eigenvalues, chebyshev' s.svg || fail "spectrum: $(cat err)"
    $traction --n 8 --plot s.svg >out 2>err && grep -q Carter s.svg || fail "traction: $(cat err)"
    $frequency --n 4,8 --plot s.svg >out 2>err && grep -q 'Re, n = 8' s.svg || fail "frequency: $(cat err)"
    $transient --step 1 --n 4,8 --plot s.svg >out 2>err && grep -q 'n = 8' s.svg || fail "transient: $(cat err)"
fi

finish
