#!/bin/sh
# apps/friction_study.cpp, seen from outside: what several of its runs or files have in common.
# Usage: friction.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
study=$programs/friction_study
steady="$study --kernel plane --aspect inf"
rolling="$study --transient --kernel plane --aspect 100 --n 20"

printf 'x_over_a,pressure\n-1,0\n0.3,1\n1,0\n' >"$scratch/triangle"

# --- steady
# exact under other pressures without jumps, too; by elements with a jump or stick that ends before the leading edge
awk 'BEGIN { print "x_over_a,pressure"; for (i = 0; i <= 400; ++i) { t = 3.14159265358979 * i / 400
    printf "%.15g,%.15g\n", -cos(t), (i % 400 ? sin(t) : 0) } }' >"$scratch/round"
good 3 $steady --n 40 --fit-border --pressure "$scratch/round" --creepage-ratio 0.3,0.6
check 'a table exactly' '$mesh == "fitted" &&
    ($force_ratio / ($creepage_ratio * (2 - $creepage_ratio)) - 1) ^ 2 < 1e-5 ^ 2'
for elements in --fit-border --fit-border=false; do
    $steady --n 40 $elements --pressure "$scratch/triangle" --creepage-ratio 0.5 >out
    tail -n 1 out | cut -d, -f"$(column force_ratio)"
done | uniq | wc -l | grep -qx 1 || fail 'the elements of a triangle'
good 3 $steady --n 10,20 --creepage-ratio 0.5 --jobs 2 --tractions t
check 'no times with --jobs' '$time_us == "" && $assembly_us == ""'
cp t out
columns=n,creepage_ratio,x_over_a,traction,bound,stick,slip,exact,mesh,method,derivative,alpha_L,alpha_T,status
header $columns,lateral_ratio,lateral_traction,lateral_slip,layer,friction_ratio
[ -n "$(column nodes)" ] || fail "settings of the tractions"
grep -q '^# command_line = .* --creepage-ratio 0.5 --jobs 2 --tractions t$' t.toml || fail "companion of the tractions"
rows 'NR > 1 { rows += 1; if ($traction < 0 && -$traction <= $bound * (1 + 1e-12) && ($stick == 1) == ($slip == 0) &&
    $slip >= 0) good += 1;
    if (($traction - $exact) ^ 2 < 0.2 ^ 2 && ($stick == 1 || -$traction == $bound)) near += 1 }
    END { exit !(rows == 30 && good == 30 && near == 30) }' t ||
    fail 'tractions within their bound'
# the tractions do not depend on the plot
PATH=/nonexistent $steady --n 10 --creepage-ratio 0.5 --output x.csv --tractions t2 --plot x.svg 2>err
[ $? -eq 3 ] && [ "$(wc -l <t2)" -eq 11 ] && [ -s t2.toml ] || fail "tractions without gnuplot: $(cat err)"
rm -f t2 t2.toml x.csv x.csv.toml
# tractions of two schemes, one of which does not converge
good 3 $steady --n 20 --mesh uniform --alpha 0.5,1.5 --creepage-ratio 0.5 --tractions t
rows 'NR > 1 && $alpha_L == 0.5 && $alpha_T == 0.5 && $status == "ok" && $traction < 0 && $stick != "" && $slip != "" {
        trusted += 1 }
    NR > 1 && $alpha_L == 1.5 && $alpha_T == 1.5 && $status == "assists_creepage" && $traction $stick $slip == "" &&
        $bound > 0 && $exact < 0 { refused += 1 }
    NR > 1 && $mesh == "uniform" && $method == "collocation" && $derivative == "fd" { named += 1 }
    END { exit !(trusted == 20 && refused == 20 && named == 40 && NR == 41) }' t ||
        fail "tractions of two schemes: $(cat t)"
(ulimit -f 1 && $steady --n 10 --creepage-ratio 0.5 --output /dev/null --tractions t 2>err)
[ $? -eq 4 ] && grep -q ' t.* cannot be written' err && [ "$(wc -l <t)" -eq 41 ] ||
    fail "a full disk under the tractions"
for k in 1 2 3; do $steady --n 6,9 --creepage-ratio 0.2,0.5 --shard $k/3 --tractions t$k >/dev/null; done
$steady --n 6,9 --creepage-ratio 0.2,0.5 --jobs 2 --tractions t >/dev/null
cat t1 t2 t3 | cmp -s t - || fail 'shards of the tractions'
# a sweep goes one way along a falling curve, each lateral ratio anew
branches="$steady --n 40 --falling 0,0.0245 --creepage-ratio 0.2,0.25,0.3,0.1,0.35,0.4,0.5,3"
good 9 $branches --sweep up --tractions t
rows 'NR > 1 && !($status == "ok" && $friction_ratio >= 0 && $friction_ratio <= 1 &&
    -$traction <= $bound * $friction_ratio * (1 + 1e-9)) { bad = 1 }
    $friction_ratio < 0.5 { fallen = 1 }
    END { exit bad || !fallen || NR != 321 }' t || fail 'tractions below what is left of their bound'
mv out up
good 9 $branches --sweep down
rows 'NR == FNR { up[FNR] = $force_ratio; next }
    FNR > 1 { d = up[FNR] - $force_ratio; if (d < -1e-9) bad = 1
        if (d > largest) largest = d; if ($sweep != "down" || $status != "ok") bad = 1 }
    END { exit bad || !(largest > 0.05) }' up out || fail "branches of a falling curve: $(cut -d, -f7,8 up out)"

# --- in the time domain
steady_force=$($steady --n 20 --creepage-ratio 0.5 >still && rows 'NR == 2 { print $force_ratio }' still)
good 402 $rolling --creepage-ratio 0.5 --until 120 --dq 0.3 --shift 3
rows -v steady="$steady_force" 'END { exit !(($force_ratio / steady - 1) ^ 2 < 1e-6 ^ 2) }' out ||
    fail "the long-time limit is not $steady_force"
good 21 $rolling --creepage-ratio 0.5 --until 1
mv out checked
good 21 $rolling --creepage-ratio 0.5 --until 1 --unchecked
sed 's/,unchecked,/,ok,/' out | cmp -s checked - || fail 'the check changes rows'
grep -c ',unchecked,' out | grep -qx 20 || fail 'unchecked rows must say so'
orders force_ratio $rolling --sine 0.9,1 --until 2
# a shift that takes its time
good 2 $rolling --creepage-ratio 0.5 --shift 20 --until 1 --dq 1 --falling 0.5,20 --shard 1/2
mv out slow
good 2 $rolling --creepage-ratio 0.5 --shift 20 --until 1 --dq 0.1 --falling 0.5,20 --shard 1/11
awk -F, 'NR == FNR { slow = $4; next }
    END { exit !($8 == "" && $12 == "ok" && $4 > 0.5 && $4 < 0.52 && slow > 0.7 && slow < 0.8) }' slow out ||
    fail "a shift that takes its time"

# twice as fast, friction falls as with half the velocities of its law
printf 'q_over_a,creepage_ratio,speed\n0,0.8,2\n1,0.8,2\n' >"$scratch/fast"
good 21 $rolling --falling 0.6,2 --memory 0.3,0.02 --history "$scratch/fast" --until 2 --dq 0.1
mv out fast
good 21 $rolling --falling 0.6,1 --memory 0.3,0.01 --creepage-ratio 0.8 --until 2 --dq 0.1
paste -d, fast out | awk -F, 'NR > 1 { n += ($4 / $(4 + NF / 2) - 1) ^ 2 < 1e-20 && $4 > 0 } END { exit n != 20 }' ||
    fail "speed: $(paste -d, fast out)"

# --- a load that varies
printf 'q_over_a,load_ratio\n0,1\n2,0\n3,0\n4,1.2\n' >"$scratch/bounce"
# a step across a kink is divided there
good 3 $rolling --creepage-ratio 0.5 --until 4 --dq 2 --load "$scratch/bounce" --integrator implicit-euler
mv out coarse
good 5 $rolling --creepage-ratio 0.5 --until 4 --dq 1 --load "$scratch/bounce" --integrator implicit-euler
[ "$(tail -n 1 coarse | cut -d, -f4)" != "" ] || fail 'a kink within a step'
awk -F, 'NR == FNR { last = $4; next } { fine = $4 } END { exit !((last - fine) ^ 2 < 1e-24) }' coarse out ||
    fail 'a kink within a step is where the step is divided'

# --- plots
if command -v gnuplot >/dev/null; then
    good 12 $study --n 20 --plot s.svg
    [ "$(grep -c '</svg>' s.svg)" -eq 1 ] && grep -q Carter s.svg && grep -q stick s.svg ||
        fail 'creep curve and tractions'
    good 3 $study --n 20 --creepage-ratio 0.3,-0.4 --fit-border --plot s.png --tractions t
    [ "$(wc -l <t)" -eq 41 ] || fail 'tractions beside a plot'
    good 2 $study --n 20 --mesh uniform --alpha 1.5 --creepage-ratio 0.5 --plot w.svg
    grep -q bound w.svg && fail 'wrong tractions in the plot'
    good 21 $rolling --creepage-ratio 0.5 --until 1 --plot r.svg
    grep -q 'Carter, steady' r.svg || fail 'the steady limit in the plot'
    good 21 $rolling --creepage-ratio 0.5 --lateral-ratio 0.2 --load-sine 0.3,2 --until 1 --plot v.svg
    grep -q lateral v.svg && grep -q load v.svg && ! grep -q Carter v.svg || fail 'load and lateral force in the plot'
    good 5 $study --n 20 --creepage-ratio 0.2,0.5 --lateral-ratio 0,0.3 --plot b.svg
    grep -q 'Longitudinal force' b.svg && grep -q 'Lateral force' b.svg || fail 'both forces in the plot'
    good 41 $rolling --sine 1,1 --until 2 --plot l.svg
    grep -q Hysteresis l.svg || fail 'hysteresis in the plot'
fi

finish
