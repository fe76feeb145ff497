#!/bin/sh
# apps/transient_study.cpp and simbody_wheel.cpp, seen from outside: what they refuse, columns, rows, shards and jobs, and
# forces of the exact response of the plane model.
# Usage: transient.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
study=$programs/transient_study
second="$study --mesh cosine --alpha 0.5 --kernel plane --aspect 100 --poisson 0.25"

printf 'q_over_a,creepage\n0,0\n1,1e-3\n1,2e-3\n2.03,2e-3\n2.5,-1e-3\n' >"$scratch/history"
printf 'q_over_a,creepage\n0,0\n1,0\n' >"$scratch/zero"
printf 'q_over_a,creepage\n-1,0\n1,1\n' >"$scratch/before"

# --- bad input
bad 'one of --step, --ramp, --sine and --history must be given' $study
bad '--ramp = 1 cannot go with --step' $study --step 1 --ramp 1 --output x.csv
bad '--history = h cannot go with --sine' $study --sine 1,1 --history h
bad '--step = 0 must be finite and not 0' $study --step 0
bad '--step = nan must be finite and not 0' $study --step nan
bad '--ramp = inf must be finite and not 0' $study --ramp inf
bad '--sine = 1 must be AMP,OMEGA' $study --sine 1
bad '--sine = 0,1 must be AMP,OMEGA' $study --sine 0,1
bad '--sine = 1,-1 must be AMP,OMEGA' $study --sine 1,-1
bad '--dq = 0 must be positive and finite' $study --step 1 --dq 0 --output x.csv
bad '--until = 0.01 must be at least --dq' $study --step 1 --until 0.01
bad '--until = 10 must be a multiple of --dq = 3' $study --step 1 --dq 3
bad '--until = 0.35 must be a multiple of --dq = 0.1' $study --step 1 --dq 0.1 --until 0.35
bad '--until = 1e9 must be at most 1e7 times --dq' $study --step 1 --until 1e9
bad '--integrator = rk4 must be one of sdirk2, implicit-euler, exponential' $study --step 1 --integrator rk4
bad '--aspect = inf must be positive and finite' $study --step 1 --aspect inf
bad '--aspect = 0.1 must be larger than' $study --step 1 --kernel plane --aspect 0.1
bad 'unstable and' $study --step 1 --alpha 0.6 --output x.csv
bad 'n = 20: the scheme does not converge' $study --step 1 --n 20 --alpha 1.5 --output x.csv
bad 'the creepage must not be 0 all the way up to --until' $study --history "$scratch/zero" --output x.csv
bad 'line 2 = -1,0' $study --history "$scratch/before"
bad_pairs q_over_a,creepage $study --history

# --- the exact response: a step
good 801 $second --step 1 --integrator exponential --until 40
header q_over_a,creepage,force,exact,relative_error
check 'the step, to what the mesh allows' '$creepage == 1 && $relative_error ^ 2 < 1.5e-4 ^ 2 && ($force / $exact - 1 - $relative_error) ^ 2 < 1e-28'
check 'rows' '($q_over_a / 0.05 - NR + 1) ^ 2 < 1e-18'
rows 'function near(value) { return ($exact / value - 1) ^ 2 < 1e-20 } BEGIN { found = 0 }
    NR == 3 && near(0.03298237853325) { ++found } NR == 21 && near(0.3171793811867) { ++found }
    NR == 101 && near(1.205411082237) { ++found } NR == 401 && near(2.028055957243) { ++found }
    END { exit found != 4 }' out || fail 'the exact response to a step'
good 1001 $second --step 2 --integrator exponential --until 1 --dq 0.001
check 'a short step' '$creepage == 2 && $relative_error ^ 2 < 1.5e-4 ^ 2'
# other histories; the chords of a sine differ from it to second order
good 201 $second --ramp -0.5 --integrator exponential
check 'ramp' '($creepage + 0.5 * $q_over_a) ^ 2 < 1e-24 && $exact < 0 && $relative_error ^ 2 < 1.5e-4 ^ 2'
good 1001 $second --sine 1e-3,2 --dq 0.01
check 'sine' '($creepage / 1e-3 - sin(2 * $q_over_a)) ^ 2 < 1e-24 && ($force - $exact) ^ 2 < 1e-4 ^ 2'
good 41 $second --history "$scratch/history" --integrator exponential --dq 0.1 --until 4
check 'a history with a jump and knots within steps' '($force - $exact) ^ 2 < 5e-5 ^ 2 && $exact ^ 2 > 0'
rows 'NR == 11 { at = $creepage == 0.001 } NR == 12 { after = $creepage == 0.002 } NR == 41 { last = $creepage == -0.001 }
    END { exit !(at && after && last) }' out || fail 'creepage at a jump and after the last row'
orders force $second --n 20 --sine 1,1 --until 1
good 201 $study --step 1 --aspect 0.1
check 'no closed form where the plane model is unstable' '$force > 0 && $exact == "" && $relative_error == ""'
good 201 $study --step 1 --alpha 0.6 --unchecked
check 'unchecked rows say so' '$status == "unchecked" && $force != "" && $kernel == "strip" && $aspect == 1000'
good 4 $study --step 1 --dq 0.1 --until 0.3
check 'checked rows are ok' '$status == "ok"'
good 3 $study --sine 1,30 --until 0.1
check 'a sine that steps do not follow' '$status == "unresolved" && $force == "" && $exact != "" && $relative_error == ""'
good 3 $study --sine 1,20 --until 0.1
check 'a sine that they just follow' '$status == "ok" && $force != ""'
good 9 $second --aspect 10 --poisson 0 --step 1 --integrator exponential --dq 0.5 --until 1
check 'each contact has its own exact response' '$relative_error ^ 2 < 1.5e-3 ^ 2'
[ "$(tail -n +2 out | cut -d, -f4 | sort -u | wc -l)" -eq 8 ] || fail 'exact responses of contacts'
# CSV as other programs write it
history="$study --n 10 --until 0.2 --dq 0.1 --history"
printf 'q_over_a,creepage\n0,0.5\n1,1.5\n' >"$scratch/plain"
$history "$scratch/plain" >expected
table() {
    printf "$1" >"$scratch/table"
    $history "$scratch/table" >out 2>err && cmp -s out expected || fail "a table like $1: $(cat err)"
}
table '\357\273\277q_over_a,creepage\r\n0,0.5\r\n1,1.5\r\n'
table '"q_over_a","creepage"\n0,0.5\n1,1.5\n'
table '"","q_over_a","creepage"\n"1",0,0.5\n"2",1,1.5\n'
table 'creepage,q_over_a\n0.5,0\n1.5,1\n'
table 'q_over_a;creepage\n0;0,5\n1;1,5\n'
table 'q_over_a;creepage\n0;0.5\n1;1.5\n'
table 'q_over_a\tcreepage\n0\t0.5\n1\t1.5\n'
table 'q_over_a,creepage\n0,0.5\n1,1.5\n\n \n\n'
table '\n# comments\nq_over_a,creepage\n  # and\n0,+0.5\n\n+1,1.5\n'
table 'q_over_a,creepage\r0,0.5\r1,1.5\r'
table 'q_over_a,creepage\n"0","0.5"\n 1 , 1.5'
# told TEXT CONTENT: refused, with this reason
told() {
    printf "$2" >"$scratch/table"
    bad "$1" $study --history "$scratch/table"
}
told 'line 2 = 0\x001,1 must be text' 'q_over_a,creepage\n0\0001,1\n'
told 'line 1 = \x7FELF\x02 must be text' '\177ELF\002\n'
told 'line 6 = 0,one must be two finite numbers' '# one\n\nq_over_a,creepage\r\n0,0.5\r\n\n0,one\n'
told 'line 2 = +-0,1 must be two finite numbers' 'q_over_a,creepage\n+-0,1\n'
told 'line 2 = 0;1 must be two finite numbers with a comma between them' 'q_over_a,creepage\n0;1\n'
told 'line 2 = 0,1 must be two finite numbers with a semicolon between them' 'q_over_a;creepage\n0,1\n'
told 'line 2 = 0,1 must have 3 cells' 'x,q_over_a,creepage\n0,1\n'
told 'line 1 = q,creepage must be q_over_a,creepage' 'q,creepage\n0,1\n'
shards $second --n 5,6 --step 1 --until 1
# the rows of an interrupted run are kept: here its files may not grow beyond some kB
set -- $study --n 10 --sine 1,1 --until 50
good 1001 "$@"
mv out expected
(
    ulimit -f 20
    exec "$@" --output long.csv
) 2>err
[ $? -eq 4 ] || fail "a file that may not grow: $(cat err)"
[ "$(wc -l <long.csv.part)" -gt 20 ] && [ "$(wc -l <long.csv.part)" -lt 1000 ] || fail 'rows are not kept'
good 0 "$@" --output long.csv
cmp -s long.csv expected && [ ! -e long.csv.part ] || fail 'a run that goes on'
good 0 $study --step 1 --output x.csv
grep -q '^step = ' x.csv.toml || fail 'companion file'

if [ -x "$programs/simbody_wheel" ]; then
    "$programs/simbody_wheel" --n 10,40 --tolerance 2e-3 --quiet >out 2>err
    [ $? -eq 1 ] || fail "errors above the tolerance: $(cat out err)"
    check 'errors above the tolerance' '$NF == ($n == 10 ? "above_tolerance" : "ok")'
fi

# --- plots, also of shards without rows
if command -v gnuplot >/dev/null; then
    good 401 $second --n 20,30 --step 1 --plot s.svg
    grep -q exact s.svg || fail 'the exact response in the plot'
    $study --step 1 --until 0.1 --shard 1/100 --plot s.svg >out 2>err
    [ $? -eq 3 ] && grep -q 'no point to draw' err || fail "a plot of no row: $(cat err)"
    if [ -x "$programs/simbody_wheel" ]; then
        "$programs/simbody_wheel" --n 10 --shard 1/3 --plot s.svg >out 2>err
        [ $? -eq 3 ] && grep -q 'no point to draw' err || fail "a plot of no row in simbody_wheel: $(cat err)"
    fi
fi

finish
