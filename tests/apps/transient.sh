#!/bin/sh
# apps/transient_study.cpp, seen from outside: histories, and orders in dq.
# Usage: transient.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
study=$programs/transient_study
second="$study --mesh cosine --alpha 0.5 --kernel plane --aspect 100 --poisson 0.25"

orders force $second --n 20 --sine 1,1 --until 1
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
table 'q_over_a,creepage\n"0","0.5"\n 1 , 1.5'
good 0 $study --step 1 --output x.csv
grep -q '^step = ' x.csv.toml || fail 'companion file'

# --- plots, also of shards without rows
if command -v gnuplot >/dev/null; then
    good 401 $second --n 20,30 --step 1 --plot s.svg
    grep -q exact s.svg || fail 'the exact response in the plot'
    $study --step 1 --until 0.1 --shard 1/100 --plot s.svg >out 2>err
    [ $? -eq 3 ] && grep -q 'no point to draw' err || fail "a plot of no row: $(cat err)"
fi

finish
