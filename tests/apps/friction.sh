#!/bin/sh
# apps/friction_study.cpp, seen from outside: what several of its runs or files have in common.
# Usage: friction.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
study="$programs/friction_study --no-timing"
steady="$study --kernel plane --aspect inf"
rolling="$study --transient --kernel plane --aspect 100 --n 20 --creepage-ratio"

# exact under other pressures without jumps, too
awk 'BEGIN { print "x_over_a,pressure"; for (i = 0; i <= 400; ++i) { t = 3.14159265358979 * i / 400
    printf "%.15g,%.15g\n", -cos(t), (i % 400 ? sin(t) : 0) } }' >round
good 3 $steady --n 40 --fit-border --pressure round --creepage-ratio 0.3,0.6
check 'a table exactly' '$mesh == "fitted" &&
    ($force_ratio / ($creepage_ratio * (2 - $creepage_ratio)) - 1) ^ 2 < 1e-5 ^ 2'

# --- tractions: of two schemes, one of which does not converge; the same by shards and without a plot
good 3 $steady --n 20 --mesh uniform --alpha 0.5,1.5 --creepage-ratio 0.5 --tractions t
columns=n,creepage_ratio,x_over_a,traction,bound,stick,slip,exact,mesh,method,derivative,alpha_L,alpha_T,status
columns=$columns,lateral_ratio,lateral_traction,lateral_slip,layer,friction_ratio
grep -q "^$columns,.*nodes" t || fail "columns: $(head -n 1 t)"
grep -q '^# command_line = .* --creepage-ratio 0.5 --tractions t$' t.toml || fail 'companion of the tractions'
rows 'NR > 1 && $alpha_L == 0.5 && $alpha_T == 0.5 && $status == "ok" && $traction < 0 && $slip >= 0 &&
        -$traction <= $bound * (1 + 1e-12) && ($stick == 1) == ($slip == 0) && ($stick == 1 || -$traction == $bound) &&
        ($traction - $exact) ^ 2 < 0.2 ^ 2 { trusted += 1 }
    NR > 1 && $alpha_L == 1.5 && $alpha_T == 1.5 && $status == "assists_creepage" && $traction $stick $slip == "" &&
        $bound > 0 && $exact < 0 { refused += 1 }
    END { exit !(trusted == 20 && refused == 20 && NR == 41) }' t || fail "tractions of two schemes: $(cat t)"
for k in 1 2 3; do $steady --n 6,9 --creepage-ratio 0.2,0.5 --shard $k/3 --tractions t$k >out; done
PATH=/nonexistent $steady --n 6,9 --creepage-ratio 0.2,0.5 --jobs 2 --tractions t --plot x.svg >out 2>err
[ $? -eq 3 ] && cat t1 t2 t3 | cmp -s t - || fail 'shards of the tractions, or without gnuplot'

# --- a sweep goes one way along a falling curve
for way in up down; do
    good 9 $steady --n 40 --falling 0,0.0245 --creepage-ratio 0.2,0.25,0.3,0.1,0.35,0.4,0.5,3 --sweep $way --tractions t
    mv out $way
done
rows 'NR > 1 && !($status == "ok" && $friction_ratio >= 0 && $friction_ratio <= 1 &&
    -$traction <= $bound * $friction_ratio * (1 + 1e-9)) { bad = 1 }
    $friction_ratio < 0.5 { fallen = 1 }
    END { exit bad || !fallen || NR != 321 }' t || fail 'tractions below what is left of their bound'
rows 'NR == FNR { up[FNR] = $force_ratio; next }
    FNR > 1 { d = up[FNR] - $force_ratio; if (d < -1e-9 || $sweep != "down" || $status != "ok") bad = 1
        if (d > largest) largest = d }
    END { exit bad || !(largest > 0.05) }' up down || fail "branches of a falling curve: $(cut -d, -f7,8 up down)"

# --- in the time domain: pairs of runs end with the same force
# ends_as ERROR ARG...: with the force in the file force.
ends_as() {
    error=$1
    shift
    $rolling "$@" >out
    awk -v a="$(cat force)" -v b="$(cell force_ratio)" -v e="$error" 'BEGIN { exit !((a / b - 1) ^ 2 < e ^ 2) }' ||
        fail "not the force $(cat force): $*"
}
# the long-time limit; twice as fast, friction falls as with half the velocities of its law; a step across a kink of the
# load is divided there
$study --kernel plane --aspect 100 --n 20 --creepage-ratio 0.5 >out && cell force_ratio >force
ends_as 1e-6 0.5 --until 120 --dq 0.3 --shift 3
printf 'q_over_a,creepage_ratio,speed\n0,0.8,2\n1,0.8,2\n' >fast
${rolling% *} --falling 0.6,2 --memory 0.3,0.02 --history fast --until 2 --dq 0.1 >out && cell force_ratio >force
ends_as 1e-10 0.8 --falling 0.6,1 --memory 0.3,0.01 --until 2 --dq 0.1
printf 'q_over_a,load_ratio\n0,1\n2,0\n3,0\n4,1.2\n' >bounce
set -- 0.5 --until 4 --load bounce --integrator implicit-euler
$rolling "$@" --dq 2 >out && cell force_ratio >force
ends_as 1e-12 "$@" --dq 1

finish
