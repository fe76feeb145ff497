#!/bin/sh
# apps/friction_study.cpp, seen from outside: rejected input, columns, rows, shards and jobs, and numbers known from
# Carter, Cattaneo and the physics of friction.
# Usage: friction.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
study=$programs/friction_study
steady="$study --kernel plane --aspect inf"
rolling="$study --transient --kernel plane --aspect 100 --n 20"

printf 'x_over_a,pressure\n-1,0\n0.3,1\n1,0\n' >"$scratch/triangle"
printf 'x_over_a,pressure\n-1,2\n-0.2,2\n-0.2,0\n0.2,0\n0.2,2\n1,2\n' >"$scratch/gap"
printf 'x_over_a,pressure\n-1,0\n0,-1\n1,0\n' >"$scratch/negative"
printf 'x_over_a,pressure\n-1,0\n1,0\n' >"$scratch/unloaded"
printf 'x_over_a,pressure\n-1,0\n1.5,1\n' >"$scratch/outside"

# --- bad input
for option in '--dq 0.1' '--sine 1,1' --unchecked '--lambda 0.5' --breathing; do
    bad 'has no effect without --transient' $study $option --output x.csv
done
bad '--tractions = t has no effect with --transient' $study --transient --creepage-ratio 1 --tractions t
bad 'one of --creepage-ratio and --sine must be given with --transient' $study --transient --output x.csv
bad '--creepage-ratio = 1 has no effect with --sine' $study --transient --sine 1,1 --creepage-ratio 1
bad '--creepage-ratio = 1,2 must be one number, and it must be finite' $study --transient --creepage-ratio 1,2
bad '--sine = 0,1 must be AMP,OMEGA with AMP finite and not 0' $study --transient --sine 0,1
bad '--integrator = exponential must be one of sdirk2, implicit-euler' $study --transient --sine 1,1 --integrator exponential
bad 'n = 20: the scheme has 9 unstable and 0 uncertain' $rolling --alpha 1 --creepage-ratio 0.5 --output x.csv
bad 'n = 40: the scheme has' $study --transient --n 40 --alpha 0.6 --creepage-ratio 0.5
bad 'n = 20: the scheme does not converge' $rolling --mesh uniform --alpha 1.5 --creepage-ratio 0.5 --output x.csv
bad '--mesh = uniform has no effect with --fit-border' $study --fit-border --mesh uniform
bad 'pressure = -1 must be finite and not negative' $study --pressure "$scratch/negative"
bad 'load = 0 must be positive' $study --pressure "$scratch/unloaded"
bad 'line 3 = 1.5,1: x_over_a must lie in [-1, 1]' $study --pressure "$scratch/outside"
printf 'q_over_a,load_ratio\n0,1\n4,1e300\n' >"$scratch/huge"
bad 'load_ratio = 1e+300 must be at most 1e12' $study --transient --creepage-ratio 0.5 --until 4 --load "$scratch/huge"
bad '--layer = 1e+308 must be such that G and G'"'"' are finite' $study --transient --creepage-ratio 0.5 --layer 1e308
bad '--aspect = 1e-308 and --layer = 0 must be such' $study --transient --n 10 --creepage-ratio 0.5 --aspect 1e-308

printf 'q_over_a,load_ratio\n0,1\n2,0\n3,0\n4,1.2\n' >"$scratch/bounce"
printf 'q_over_a,load_ratio\n1,1\n4,1\n' >"$scratch/late"
printf 'q_over_a,load_ratio\n0,1\n1,-1\n4,1\n' >"$scratch/pull"
printf 'q_over_a,load_ratio\n0,1\n1,1\n1,2\n4,2\n' >"$scratch/jump"
short="$rolling --creepage-ratio 0.5 --until 4 --dq 0.5"
bad '--load-sine = 0.5 must be A,LENGTH with |A| <= 1' $short --load-sine 0.5
bad '--load-sine = 1,8 must be A,LENGTH with |A| < 1 where the mesh breathes' $short --load-sine 1,8 --breathing
bad '--load-sine = 0.5,0 must be A,LENGTH' $short --load-sine 0.5,0
bad 'must cover the run: its rows go from q_over_a = 1 to 4, the run from 0 to 4' $short --load "$scratch/late"
bad 'load_ratio = -1 must be at least 0' $short --load "$scratch/pull"
bad 'load_ratio = 0 must be positive where the mesh breathes' $short --load "$scratch/bounce" --breathing
bad 'one row only at q_over_a = 1' $short --load "$scratch/jump" --output x.csv
bad '--load = ' $short --load "$scratch/bounce" --load-sine 0.5,8
bad 'has no effect under a load that varies' $short --load-sine 0.5,8 --pressure "$scratch/triangle"
bad '--kernel = strip must be plane with --breathing' $study --transient --creepage-ratio 1 --load-sine 0.5,8 --breathing
bad 'has no effect without --load-sine or --load' $short --breathing
bad '--breathing needs equations that hold at points' $short --load-sine 0.5,8 --breathing --method galerkin --unchecked
bad 'collocation, nodes or knothe-bc, lambda = 1, no --layer' $short --load-sine 0.5,8 --breathing --layer 1
bad '--aspect = 0.2 must be larger than 0.2336 with --breathing, as a grows to 1.378 a_0' \
    $study --transient --n 20 --creepage-ratio 0.5 --kernel plane --aspect 0.2 --load-sine 0.9,40 --until 40 --breathing
bad '--aspect = 0.4 must be larger than 0.456 with --breathing, as a grows to 1.378 a_0' \
    $study --transient --n 20 --creepage-ratio 0.5 --lateral-ratio 0.2 --kernel plane --aspect 0.4 --load-sine 0.9,40 \
    --until 40 --breathing
bad '--from = rest has no effect with --shift' $short --from rest --shift 1
bad '--lateral-ratio = 1,2 must be one number' $short --lateral-ratio 1,2
bad '--layer = -1 must be finite and not negative' $study --layer -1 --output x.csv
bad '--derivative = analytic must be fd with --layer' $study --layer 1 --derivative analytic
for option in '--lateral-ratio 1' '--layer 1'; do bad 'has no effect with --fit-border' $study --fit-border $option; done

bad '--falling = 0.5 must be K,VH with K >= 0 and VH > 0, both finite' $study --falling 0.5 --output x.csv
for value in 0.5,0 -0.1,1; do bad 'must be K,VH' $study --falling=$value --output x.csv; done
for value in 0,1 1,-1; do bad 'must be D,V0' $study --falling 0.5,1 --memory=$value; done
for option in '--memory 1,1' '--sweep up'; do bad 'has no effect without --falling' $study $option; done
bad '--fit-border = true has no effect with --falling' $study --falling 0.5,1 --fit-border
bad '--sweep = up has no effect with --transient' $short --falling 0.5,1 --sweep up

# --- steady
good 34 $study
header method,derivative,mesh,n,alpha_L,alpha_T,creepage_ratio,force_ratio,exact,relative_error,stick_count,rounds,complementarity_residual,time_us,lateral_ratio,lateral_force_ratio
check 'the default scheme' '$method == "collocation" && $derivative == "fd" && $mesh == "cosine" && $alpha_L == 0.5 && $alpha_T == 0.5'
check 'Carter' '($exact - ($creepage_ratio < 1 ? $creepage_ratio * (2 - $creepage_ratio) : 1)) ^ 2 < 1e-30 && ($force_ratio / $exact - 1 - $relative_error) ^ 2 < 1e-28'
check 'small errors' '$relative_error ^ 2 < 5e-3 ^ 2 && $rounds <= 10 && $complementarity_residual < 1e-12 && $time_us > 0'
check 'full sliding' '($stick_count == 0) == ($creepage_ratio >= 1) && $status == "ok"'
# matrices that are not finite lose their row only; pressures may have any unit
state=$(column status)
for arguments in '--layer 1e308' '--aspect 1e-308' '--lateral-ratio 0.3 --aspect 1e-308' '--falling 0.5,1 --aspect 1e-308' \
    '--fit-border --aspect 1e-308'; do
    good 2 $study --n 10 --creepage-ratio 0.5 $arguments
    check "$arguments" '$'$state' == "not_finite" && $force_ratio == ""'
done
good 3 $study --n 10 --creepage-ratio 0.5 --aspect 1000,1e-308
check 'a list with an aspect that is too small' '($'$state' == "ok") == ($force_ratio != "")'
printf 'x_over_a,pressure\n-1,0\n0.3,1e-320\n1,0\n' >tiny
printf 'x_over_a,pressure\n-1,0\n0.3,1.5e308\n1,0\n' >huge
good 2 $study --n 10 --creepage-ratio 0.5 --no-timing --pressure "$scratch/triangle"
cp out same
for unit in tiny huge; do
    good 2 $study --n 10 --creepage-ratio 0.5 --no-timing --pressure $unit
    cmp -s out same || fail "pressures of $unit numbers"
done
# one topic of the help
$study --help falling >out || fail "--help falling"
grep -q 'd mu/dt' out && ! grep -q -e '--alpha-T LIST' out || fail "--help falling: $(cat out)"
bad '--help = foo must be one of steady, border, lateral, layer, falling, transient, load' $study --help foo
good 5 $steady --n 20,40,80,160 --creepage-ratio 0.5
check 'cosine mesh, second order or nearly' '$relative_error > 0 && $relative_error < 1.02 * ($n == 20 ? 3e-3 : $n == 40 ? 9.1e-4 : $n == 80 ? 2.7e-4 : 7.8e-5)'
good 3 $steady --n 20,40 --mesh uniform --creepage-ratio 0.5
check 'uniform mesh, first order' '$relative_error < 1.02 * ($n == 20 ? 1.8e-2 : 8.9e-3) && $relative_error > 0.97 * ($n == 20 ? 1.8e-2 : 8.9e-3)'
good 4 $steady --n 40 --creepage-ratio 0.2,0.5,0.8 --fit-border
check 'an exact border' '$relative_error ^ 2 < 1e-12 ^ 2 && $mesh == "fitted" && $alpha_L $alpha_T == "" && $complementarity_residual < 1e-12 && $status == "ok" && ($slip_work - 1.44 * $creepage_ratio * $force_ratio) ^ 2 < 1e-24'
good 4 $steady --n 40 --creepage-ratio -0.5,0,1.2 --fit-border
rows 'NR == 2 { minus = ($force_ratio + 0.75) ^ 2 < 1e-24 } NR == 3 { still = $force_ratio == 0 && $mesh == "fitted" } NR == 4 { slid = ($force_ratio - 1) ^ 2 < 1e-24 && $stick_count == 0 }
    END { exit !(minus && still && slid) }' out || fail "exact borders of either sign: $(cat out)"
# exact under other pressures without jumps, too; by elements with a jump or stick that ends before the leading edge
awk 'BEGIN { print "x_over_a,pressure"; for (i = 0; i <= 400; ++i) { t = 3.14159265358979 * i / 400
    printf "%.15g,%.15g\n", -cos(t), (i % 400 ? sin(t) : 0) } }' >"$scratch/round"
good 3 $steady --n 40 --fit-border --pressure "$scratch/round" --creepage-ratio 0.3,0.6
check 'a table exactly' '$mesh == "fitted" && ($force_ratio / ($creepage_ratio * (2 - $creepage_ratio)) - 1) ^ 2 < 1e-5 ^ 2'
for pressure in triangle gap; do
    good 2 $steady --n 40 --fit-border --pressure "$scratch/$pressure" --creepage-ratio 0.5
    check "elements for a $pressure" '$mesh == "cosine" && $alpha_L == 0.5 && $alpha_T == 0.5 && $status == "ok"'
    cut -d, -f"$(column force_ratio)" out >forces
    good 2 $steady --n 40 --pressure "$scratch/$pressure" --creepage-ratio 0.5
    cut -d, -f"$(column force_ratio)" out | cmp -s - forces || fail "the elements of a $pressure"
done
good 5 $steady --n 40 --creepage-ratio -0.5,0.5,-3,0
rows 'NR == 2 { minus = $force_ratio } NR == 3 { mirrored = minus == -$force_ratio } NR == 4 { slid = ($force_ratio + 1) ^ 2 < 1e-26 }
    NR == 5 { nothing = $force_ratio == 0 && $relative_error == "" } END { exit !(mirrored && slid && nothing) }' out || fail 'signs'
# a scheme whose tractions in full adhesion assist the creepage; with friction its force is a third too low
good 3 $steady --n 20 --mesh uniform --alpha 0.5,1.5 --creepage-ratio 0.5
rows 'NR == 2 { trusted = $status == "ok" && $force_ratio > 0.7 && $tangent_ratio > 0 && $slip_work > 0 }
    NR == 3 { refused = $status == "assists_creepage" && $force_ratio $relative_error $tangent_ratio $slip_work == "" && $exact == 0.75 && $complementarity_residual < 1e-12 }
    END { exit !(trusted && refused) }' out || fail "a scheme that does not converge: $(cat out)"
# rounds that cycle still end
good 5 $steady --n 20,80 --alpha-L 0 --alpha-T 0.5,0.63 --creepage-ratio 0.95
check 'fallback' '$relative_error ^ 2 < 1e-3 ^ 2 && $complementarity_residual < 1e-12 && $pivots > 0 && $status == "ok"'
for method in galerkin knothe-bc; do
    good 3 $steady --n 20 --method $method --creepage-ratio 0.5,1.5
    check "$method" '$relative_error ^ 2 < 0.1 ^ 2 && $status == "ok"'
done
good 12 $steady --n 30 --pressure "$scratch/triangle"
check 'no closed form for a triangle' '$exact == "" && $relative_error == "" && $force_ratio > 0.15 && $force_ratio < 1 + 1e-12'
good 3 $steady --n 40 --pressure "$scratch/gap" --creepage-ratio 0.01,30
rows 'NR == 2 { small = ($force_ratio / 0.02 - 1) ^ 2 < 0.2 ^ 2 } NR == 3 { slid = ($force_ratio - 1) ^ 2 < 1e-24 }
    END { exit !(small && slid) }' out || fail 'a gap in the pressure'
good 3 $steady --n 10,20 --creepage-ratio 0.5 --jobs 2 --tractions t
check 'no times with --jobs' '$time_us == "" && $assembly_us == ""'
traction_columns=n,creepage_ratio,x_over_a,traction,bound,stick,slip,exact,mesh,method,derivative,alpha_L,alpha_T,status,lateral_ratio,lateral_traction,lateral_slip,layer,friction_ratio,kernel,aspect,poisson,size_ratio,epsilon,quadrature,nodes
[ "$(head -n 1 t)" = $traction_columns ] || fail "columns of the tractions"
grep -q '^command_line = ".* --creepage-ratio 0.5 --jobs 2 --tractions t"$' t.toml || fail "companion of the tractions"
rows 'NR > 1 { rows += 1; if ($traction < 0 && -$traction <= $bound * (1 + 1e-12) && ($stick == 1) == ($slip == 0) && $slip >= 0) good += 1;
    if (($traction - $exact) ^ 2 < 0.2 ^ 2 && ($stick == 1 || -$traction == $bound)) near += 1 } END { exit !(rows == 30 && good == 30 && near == 30) }' t ||
    fail 'tractions within their bound'
# the tractions do not depend on the plot
PATH=/nonexistent $steady --n 10 --creepage-ratio 0.5 --output x.csv --tractions t2 --plot x.svg 2>err
[ $? -eq 3 ] && [ "$(wc -l <t2)" -eq 11 ] && [ -s t2.toml ] || fail "tractions without gnuplot: $(cat err)"
rm -f t2 t2.toml x.csv x.csv.toml
# tractions of two schemes, one of which does not converge
good 3 $steady --n 20 --mesh uniform --alpha 0.5,1.5 --creepage-ratio 0.5 --tractions t
rows 'NR > 1 && $alpha_L == 0.5 && $alpha_T == 0.5 && $status == "ok" && $traction < 0 && $stick != "" && $slip != "" { trusted += 1 }
    NR > 1 && $alpha_L == 1.5 && $alpha_T == 1.5 && $status == "assists_creepage" && $traction $stick $slip == "" && $bound > 0 && $exact < 0 { refused += 1 }
    NR > 1 && $mesh == "uniform" && $method == "collocation" && $derivative == "fd" { named += 1 }
    END { exit !(trusted == 20 && refused == 20 && named == 40 && NR == 41) }' t || fail "tractions of two schemes: $(cat t)"
good 2 $steady --n 20 --method galerkin --creepage-ratio 0.5 --tractions t
rows 'NR > 1 && !($method == "galerkin" && $derivative == "analytic" && $status == "ok") { bad = 1 } END { exit bad || NR != 21 }' t ||
    fail "tractions by galerkin"
good 2 $steady --n 20 --fit-border --creepage-ratio 0.5 --tractions t
rows 'NR > 1 && !($mesh == "fitted" && $alpha_L $alpha_T == "" && $status == "ok" && ($traction - $exact) ^ 2 < 1e-24 && ($stick == 1) == ($x_over_a > 0)) { bad = 1 }
    END { exit bad || NR != 21 }' t || fail "exact tractions"
good 0 $steady --n 20 --creepage-ratio 0.5 --output x.csv --tractions /dev/null
(ulimit -f 1 && $steady --n 10 --creepage-ratio 0.5 --output /dev/null --tractions t 2>err)
[ $? -eq 4 ] && grep -q 't.toml cannot be written' err && [ "$(wc -l <t)" -eq 21 ] || fail "a full disk under the tractions"
rm -f t.toml
shards $steady --n 6,9 --creepage-ratio 0.2,0.5,0.9
for k in 1 2 3; do $steady --n 6,9 --creepage-ratio 0.2,0.5 --shard $k/3 --tractions t$k >/dev/null; done
$steady --n 6,9 --creepage-ratio 0.2,0.5 --jobs 2 --tractions t >/dev/null
cat t1 t2 t3 | cmp -s t - || fail 'shards of the tractions'
good 0 $steady --n 10 --output x.csv
grep -q '^creepage-ratio = ' x.csv.toml || fail 'companion file'

# both directions: the closed forms, what the steps of a corner share, and loops
both="$study --kernel plane --n 40"
good 10 $both --poisson 0 --creepage-ratio -0.3,0.3,1 --lateral-ratio 0,0.4,-2
check 'along the creepage without a Poisson effect' '$exact != "" && $lateral_exact != "" && ($force_ratio - $exact) ^ 2 + ($lateral_force_ratio - $lateral_exact) ^ 2 < 2e-3 ^ 2 && $status == "ok" && $complementarity_residual < 1e-12'
rows 'NR > 1 && $lateral_ratio != (NR % 3 == 2 ? 0 : NR % 3 == 0 ? 0.4 : -2) { bad = 1 } END { exit bad }' out ||
    fail "the lateral ratio is the inner loop: $(cut -d, -f7,15 out)"
good 3 $both --creepage-ratio 0 --lateral-ratio 0.5,1.5
check 'across, by its own compliance' '$force_ratio == 0 && $exact == 0 && ($lateral_force_ratio / $lateral_exact - 1 - $lateral_relative_error) ^ 2 < 1e-24 && $lateral_relative_error ^ 2 < 2e-3 ^ 2 && $relative_error == ""'
good 2 $both --creepage-ratio 0.5 --lateral-ratio 0
mv out across
good 2 $both --creepage-ratio 0.5
rows 'NR == FNR { force[FNR] = $force_ratio; work[FNR] = $slip_work; next }
    FNR > 1 && (($force_ratio - force[FNR]) ^ 2 > 1e-24 || ($slip_work / work[FNR] - 1) ^ 2 > 2e-3 ^ 2 || $lateral_ratio $lateral_force_ratio $lateral_exact != "") { bad = 1 } END { exit bad }' across out ||
    fail 'one direction alone'
# CONTACT: creepage 0.5 at 45 degrees
good 2 $study --kernel plane --n 160 --creepage-ratio 0.35355339059327373 --lateral-ratio 0.35355339059327373 --tractions t
check 'both directions' '($force_ratio - 0.5438) ^ 2 < 3e-4 ^ 2 && ($lateral_force_ratio - 0.4093) ^ 2 < 3e-4 ^ 2 && $exact $lateral_exact == "" && $status == "ok"'
rows 'NR > 1 { size = sqrt($traction ^ 2 + $lateral_traction ^ 2); slid = sqrt($slip ^ 2 + $lateral_slip ^ 2)
    if (size > $bound * (1 + 1e-10) || ($stick == 1) != (slid == 0) || ($stick == 0 && (size < $bound * (1 - 1e-10) || ($traction * $slip + $lateral_traction * $lateral_slip) > -0.99 * size * slid))) bad = 1 }
    END { exit bad || NR != 161 }' t || fail 'tractions in both directions against their slip'
# a layer: numbers of CONTACT, and the brush
good 2 $study --mesh uniform --n 160 --layer 0.5 --creepage-ratio 0.25
check 'a layer' '($force_ratio - 0.3034) ^ 2 < 2e-4 ^ 2 && $exact == "" && $layer == 0.5'
good 2 $study --mesh uniform --n 160 --layer 1e4 --creepage-ratio 0.001
check 'a brush' '($force_ratio / (2 / 1e4 * 1.44 * 0.001 / 1.5707963267948966) - 1) ^ 2 < 0.01 ^ 2'

# friction that falls with slip: forces of CONTACT's scheme at 45 m/s, and several steady solutions
unit='mu = 0.3; p0 = 495.169e6; G = 82e9; a = 4e-3; V = 45'
fall=$(awk "BEGIN { $unit; printf \"0.6,%.15g\", 0.1 / (V * mu * p0 / G) }")
ratios=$(awk "BEGIN { $unit; split(\"5e-4 1e-3 2e-3 5e-3 1e-2\", xi, \" \"); for (i = 1; i <= 5; ++i) printf \"%s%.15g\", (i > 1 ? \",\" : \"\"), xi[i] * G / (1.44 * mu * p0) }")
for row in '0 0.34140 0.59053 0.80649 0.68687 0.61827' '2e-6 0.34564 0.60431 0.84052 0.70243 0.62303' \
    '10e-6 0.34694 0.61612 0.90047 0.78016 0.65994'; do
    memory=$(awk "BEGIN { $unit; split(\"$row\", f, \" \"); if (f[1] > 0) printf \"--memory %.15g,%.15g\", f[1] * G / (a * mu * p0), 1e-3 * G / (V * mu * p0) }")
    good 6 $study --mesh uniform --n 160 --falling "$fall" $memory --creepage-ratio "$ratios" --jobs 2
    rows -v list="$row" 'BEGIN { split(list, f, " ") } NR > 1 && (($force_ratio - f[NR]) ^ 2 > 6e-6 ^ 2 || $exact $relative_error != "" || $status != "ok" || $falling_ratio != 0.6) { bad = 1 }
        END { exit bad || NR != 6 }' out || fail "friction that falls, $row: $(cat out)"
done
good 3 $steady --n 30 --falling 1,2 --creepage-ratio 0.4,0.8
cut -d, -f"$(column force_ratio)" out >falling
good 3 $steady --n 30 --creepage-ratio 0.4,0.8
awk 'NR == FNR { f[NR] = $1; next } FNR > 1 { split($0, c, ","); if ((f[FNR] / c[8] - 1) ^ 2 > 1e-24) bad = 1 } END { exit bad }' falling out ||
    fail 'a law that is constant'
branches="$steady --n 40 --falling 0,0.0245 --creepage-ratio 0.2,0.25,0.3,0.1,0.35,0.4,0.5,3"
good 9 $branches --sweep up --tractions t
rows 'NR > 1 && !($status == "ok" && $friction_ratio >= 0 && $friction_ratio <= 1 && -$traction <= $bound * $friction_ratio * (1 + 1e-9)) { bad = 1 } $friction_ratio < 0.5 { fallen = 1 }
    END { exit bad || !fallen || NR != 321 }' t || fail 'tractions below what is left of their bound'
mv out up
good 9 $branches --sweep down
rows 'NR == FNR { up[FNR] = $force_ratio; next } FNR > 1 { d = up[FNR] - $force_ratio; if (d < -1e-9) bad = 1; if (d > largest) largest = d; if ($sweep != "down" || $status != "ok") bad = 1 }
    END { exit bad || !(largest > 0.05) }' up out || fail "branches of a falling curve: $(cut -d, -f7,8 up out)"
shards $branches --sweep down
# the tangent is that of the force, however large the least velocity of the memory
for lateral in '' '--lateral-ratio 0.3'; do
    for least in 1 1e6 1e9; do
        good 4 $study --n 20 --falling 0.6,1.23 --memory 0.3,$least --creepage-ratio 0.4999,0.5,0.5001 $lateral
        # in both directions the tangent leaves out how the turn of the slip follows the creepage
        rows -v most="${lateral:+1e-2}" 'NR == 2 { low = $force_ratio } NR == 3 { tangent = $tangent_ratio } NR == 4 { high = $force_ratio }
            END { exit !(((high - low) / 0.0002 / tangent - 1) ^ 2 < (most == "" ? 1e-5 : most) ^ 2) }' out ||
            fail "a tangent at a least velocity of $least $lateral: $(cut -d, -f8,18 out)"
    done
done
# in both directions: the same along, by the size of the creepage where both are alike, each lateral ratio a sweep
falls="$steady --falling 0.6,1.23 --memory 0.276,0.0123"
good 5 $falls --n 30 --poisson 0 --creepage-ratio 0.25,0.5,1,2
mv out line
good 17 $falls --n 30 --poisson 0 --creepage-ratio 0.15,0.3,0.6,1.2 --lateral-ratio 0.2,0.4,0.8,1.6 --tractions t
rows 'NR == FNR { if (FNR > 1) force[$creepage_ratio] = $force_ratio; next }
    FNR > 1 && ($creepage_ratio / $lateral_ratio - 0.75) ^ 2 < 1e-20 { size = sprintf("%.17g", $creepage_ratio / 0.6) + 0; ++count
        if (($force_ratio / 0.6 - force[size]) ^ 2 + ($lateral_force_ratio / 0.8 - force[size]) ^ 2 > 1e-18 || $status != "ok" || $exact $lateral_exact != "" || $falling_ratio != 0.6) bad = 1 }
    END { exit bad || count != 4 }' line out || fail "falling friction in both directions: $(cut -d, -f7,8,15,16 out)"
rows 'NR > 1 { size = sqrt($traction ^ 2 + $lateral_traction ^ 2); most = $bound * $friction_ratio; slid = sqrt($slip ^ 2 + $lateral_slip ^ 2)
    if (size > most * (1 + 1e-9) || ($stick == 0 && (size < most * (1 - 1e-9) || ($traction * $slip + $lateral_traction * $lateral_slip) > -size * slid * (1 - 1e-8)))) bad = 1
    if ($friction_ratio < 0.8) fallen = 1 }
    END { exit bad || !fallen || NR != 481 }' t || fail 'tractions of falling friction against their slip'
good 17 $branches --lateral-ratio=-0.1,0 --sweep up
rows 'NR == FNR { up[FNR] = $force_ratio; next } FNR > 1 && $lateral_ratio == 0 { if ((up[2 + i++] - $force_ratio) ^ 2 > 1e-18 || $lateral_force_ratio != 0) bad = 1 }
    END { exit bad || i != 8 }' up out || fail 'a sweep of each lateral ratio'
rows 'NR > 1 && $lateral_ratio < 0 && !($status == "ok" && ($lateral_force_ratio < 0 || $creepage_ratio == 3)) { bad = 1 } END { exit bad }' out || fail 'a sweep aside'
across="$study --kernel plane --n 40 --falling 0,0.0245 --creepage-ratio 0 --lateral-ratio 0.1,0.2,0.3,0.4,0.5,3"
good 7 $across --sweep up
mv out up
good 7 $across --sweep down
rows 'NR == FNR { up[FNR] = $lateral_force_ratio; next } FNR > 1 { d = up[FNR] - $lateral_force_ratio; if (d < -1e-9) bad = 1; if (d > largest) largest = d }
    END { exit bad || !(largest > 0.05) }' up out || fail "a sweep across: $(cut -d, -f15,16 up out)"
shards $branches --lateral-ratio 0,0.1 --sweep down

# --- rolling in time
good 201 $rolling --creepage-ratio 0.5
header q_over_a,creepage_ratio,shift,force_ratio,stick_count,rounds,slip_work
check 'from rest' '($q_over_a / 0.05 - NR + 1) ^ 2 < 1e-18 && $creepage_ratio == 0.5 && $shift == 0 && $status == "ok"'
rows 'NR > 1 { if ($force_ratio < before || $slip_work < work || $slip_work < 0) bad = 1; before = $force_ratio; work = $slip_work } END { exit bad }' out ||
    fail 'force and slip work grow'
steady_force=$($steady --n 20 --creepage-ratio 0.5 >still && rows 'NR == 2 { print $force_ratio }' still)
for start in '--shift 0' '--shift 3' '--shift -2' '--integrator implicit-euler'; do
    good "$(case $start in --shift*) echo 402 ;; *) echo 401 ;; esac)" $rolling --creepage-ratio 0.5 --until 120 --dq 0.3 $start
    rows -v steady="$steady_force" 'END { exit !(($force_ratio / steady - 1) ^ 2 < 1e-6 ^ 2) }' out ||
        fail "the long-time limit is not $steady_force after $start"
    rows 'NR > 1 { if ($slip_work < work) bad = 1; work = $slip_work } END { exit bad }' out || fail "slip work after $start"
done
good 2 $rolling --alpha 0 --unchecked --creepage-ratio 0 --shift 2 --dq 1 --until 1 --shard 1/2
check 'Cattaneo' '$q_over_a == 0 && $shift == 2 && $relative_error ^ 2 < 5e-4 ^ 2 && $relative_error != "" && ($force_ratio / $exact - 1 - $relative_error) ^ 2 < 1e-28'
# --unchecked: wrong results for the schemes that are otherwise refused, the same results for all others
for scheme in '--alpha 1' '--mesh uniform --alpha 1.5'; do
    good 101 $rolling $scheme --unchecked --creepage-ratio 0.5 --until 50 --dq 0.5
    rows -v steady="$steady_force" 'END { exit !($status == "unchecked" && $force_ratio < 0.8 * steady) }' out ||
        fail "--unchecked $scheme: $(tail -n 1 out)"
done
good 21 $rolling --creepage-ratio 0.5 --until 1
mv out checked
good 21 $rolling --creepage-ratio 0.5 --until 1 --unchecked
sed 's/,unchecked,/,ok,/' out | cmp -s checked - || fail 'the check changes rows'
grep -c ',unchecked,' out | grep -qx 20 || fail 'unchecked rows must say so'
good 3 $rolling --sine 1,30 --until 0.1 --dq 0.05
check 'a sine that steps do not follow' '$status == "unresolved" && $force_ratio == ""'
bad '--until = 1 must be a multiple of --dq = 0.3' $rolling --creepage-ratio 0.5 --until 1 --dq 0.3
good 5 $study --n 8 --mesh geometric --alpha 0.5 --size-ratio 2,3 --poisson 0,0.25 --creepage-ratio 0.5 --tractions t.csv
of_settings() {
    echo "\$$(column kernel) == \"strip\" && \$$(column aspect) == 1000 && \$$(column poisson) * 4 % 1 == 0 &&
        (\$$(column size_ratio) == 2 || \$$(column size_ratio) == 3)"
}
check 'settings' "\$status == \"ok\" && $(of_settings)"
[ "$(cut -d, -f"$(column force_ratio)" out | sort -u | wc -l)" -eq 5 ] || fail 'settings that make no difference'
cp t.csv out
[ "$(wc -l <out)" -eq 33 ] || fail 'tractions of four settings'
check 'settings of tractions' "\$status == \"ok\" && $(of_settings)"
rm -f t.csv*
good 5 $rolling --creepage-ratio -1e6 --until 1 --dq 0.25
check 'full sliding' '($force_ratio + 1) ^ 2 < 1e-24 && $stick_count == 0'
# ten periods of a sine: the last two agree, the second half mirrors the first, and the loop has an area
good 2001 $rolling --sine 1.5,0.5 --until 125.66370614359172 --dq 0.06283185307179586
check 'sine' '($creepage_ratio - 1.5 * sin(0.5 * $q_over_a)) ^ 2 < 1e-24'
rows 'NR > 1 { d[NR] = $creepage_ratio; f[NR] = $force_ratio; if ($slip_work < work) bad = 1; work = $slip_work }
    END { for (i = NR - 199; i <= NR; ++i) {
              if ((f[i] - f[i - 200]) ^ 2 > 1e-8) bad = 1; if ((f[i] + f[i - 100]) ^ 2 > 1e-8) bad = 1
              area += (d[i] - d[i - 1]) * (f[i] + f[i - 1]) / 2 }
          exit bad || !(area ^ 2 > 0.01) }' out || fail 'hysteresis'
orders force_ratio $rolling --sine 0.9,1 --until 2
shards $rolling --n 5,6 --creepage-ratio 0.5 --shift 1 --until 1

# friction that falls with slip: tends to the steady force of the same mesh, or oscillates by itself
fallen="$study --transient --n 40 --mesh uniform --unchecked --falling $fall"
good 201 $fallen --memory 1.37998,0.0122663 --creepage-ratio 0.5 --from steady --dq 0.1 --until 20
check 'columns of falling friction' '$exact == "" && $status == "unchecked" && $falling_ratio == 0.6 && $memory_distance == 1.37998'
mv out limit
good 2 $study --n 40 --mesh uniform --falling $fall --memory 1.37998,0.0122663 --creepage-ratio 0.5
awk -F, 'NR == FNR { force = $4; next } END { exit !((force - $8) ^ 2 < 3e-3 ^ 2 && $8 > 0.3) }' limit out || fail 'falling friction in time'
good 561 $fallen --memory 0.275996,0.0122663 --creepage-ratio 0.766676 --integrator implicit-euler --dq 0.025 --until 14
rows 'NR > 1 { if (last - $force_ratio > 0.1 && last > 0.8 && $force_ratio < 0.7) ++falls; last = $force_ratio; if ($status != "unchecked") bad = 1 } END { exit bad || falls < 1 }' out ||
    fail 'the force falls on its own'
# balance WHAT GAP JUMP: creep work is slip work, jump work and elastic energy, up to GAP of it; without jump work at
# least JUMP of it is missing
balance() {
    rows -v elastic="$(column elastic_energy)" -v jump="$(column jump_work)" -v most="$2" -v least="$3" '
        NR > 1 { gap = $creep_work - $slip_work - $jump - $elastic; if (gap ^ 2 > (most * $creep_work) ^ 2 && $q_over_a > 2) bad = 1 }
        END { exit bad || !($jump > least * $creep_work && $elastic > 0) }' out || fail "energy, $1: $(tail -n 1 out)"
}
balance 'implicit Euler' 2e-3 0.012
jumps="$study --transient --n 40 --mesh uniform --unchecked --kernel plane --falling $fall --creepage-ratio 0.766676"
good 241 $jumps --memory 0.275996,0.0122663 --until 12
balance sdirk2 2e-3 0.01
good 241 $jumps --memory 0.275996,0.0122663 --until 12 --lateral-ratio 0.4
balance 'both directions' 2e-3 0.005
good 241 $jumps --memory 0.275996,0.0122663 --until 12 --load-sine 0.5,8 --breathing
balance 'a breathing contact' 3e-3 0.01
# without jumps it vanishes with dq
orders jump_work $study --transient --n 40 --mesh uniform --falling 0.6,1.23 --memory 1.38,0.0123 --creepage-ratio 0.4 --until 4
for lateral in '' '--lateral-ratio 0.2'; do
    good 2 $study --transient --n 20 --creepage-ratio 0.5 --shift 4 --until 0.05 --shard 1/2 $lateral
    check "the energy of a shift $lateral" "(\$creep_work - \$slip_work - \$$(column jump_work) - \$$(column elastic_energy)) ^ 2 < 1e-24 && \$$(column jump_work) < -0.01"
done
shards $fallen --creepage-ratio 0.5 --until 1
good 9 $rolling --creepage-ratio 0.5 --until 4 --dq 0.5 --load-sine 0.5,8 --breathing --falling 0.6,1 --memory 0.3,0.01
check 'falling friction under a load' '$status == "ok" && $force_ratio > 0 && $force_ratio < $load_ratio'
good 9 $rolling --creepage-ratio 0.5 --lateral-ratio 0.4 --until 4 --dq 0.5 --load-sine 0.5,8 --breathing --falling 0.6,1 --memory 0.3,0.01
check 'in both directions' '$status == "ok" && $force_ratio > 0 && $lateral_force_ratio > 0 && $force_ratio ^ 2 + $lateral_force_ratio ^ 2 < $load_ratio ^ 2 && $falling_ratio == 0.6'
good 201 $fallen --memory 1.37998,0.0122663 --creepage-ratio 0.4 --lateral-ratio 0.3 --from steady --dq 0.1 --until 20
mv out limit
good 2 $study --n 40 --mesh uniform --falling $fall --memory 1.37998,0.0122663 --creepage-ratio 0.4 --lateral-ratio 0.3
awk -F, 'NR == FNR { along = $4; across = $24; next } END { exit !((along - $8) ^ 2 + (across - $16) ^ 2 < 3e-3 ^ 2 && $8 > 0.2 && $16 > 0.2) }' limit out ||
    fail 'falling friction in both directions in time'
# a rigid shift takes the time of a step
for lateral in '' '--lateral-ratio 0.2'; do
    good 22 $rolling --creepage-ratio 0.5 --shift 2 --until 1 $lateral
    mv out constant
    good 22 $rolling --creepage-ratio 0.5 --shift 2 --until 1 --falling 1,1 $lateral
    rows 'NR == FNR { f[FNR] = $force_ratio; g[FNR] = $lateral_force_ratio; next } FNR > 1 && (($force_ratio / f[FNR] - 1) ^ 2 > 1e-18 || ($lateral_force_ratio - g[FNR]) ^ 2 > 1e-18) { bad = 1 } END { exit bad }' constant out ||
        fail "a shift under a law that is constant $lateral"
    good 2 $rolling --creepage-ratio 0.5 --shift 20 --until 1 --dq 1 --falling 0.5,20 --shard 1/2 $lateral
    mv out slow
    good 2 $rolling --creepage-ratio 0.5 --shift 20 --until 1 --dq 0.1 --falling 0.5,20 --shard 1/11 $lateral
    awk -F, 'NR == FNR { slow = $4; next } END { exit !($8 == "" && $12 == "ok" && $4 > 0.5 && $4 < 0.52 && slow > 0.7 && slow < 0.8) }' slow out ||
        fail "a shift that takes its time $lateral"
done

# --- spin
# named NAME...: these columns of every row of the file out, in this order
named() {
    awk -F, -v names="$*" 'BEGIN { count = split(names, name, " ") }
        NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
        { for (i = 1; i <= count; ++i) printf "%s%s", $(at[name[i]]), i < count ? " " : "\n" }' out
}
bad '--spin-ratio = 1 has no effect without --lateral-ratio' $study --spin-ratio 1
bad '--spin-ratio = 1,2 must be one number' $rolling --creepage-ratio 0.5 --lateral-ratio 0 --spin-ratio 1,2
nodes='--n 40 --method nodes --nodes chebyshev'
spun="$steady $nodes --creepage-ratio 0,0.3 --lateral-ratio 0,0.3"
good 13 $spun --spin-ratio 0.5,1,-1
named creepage_ratio lateral_ratio spin_ratio force_ratio lateral_force_ratio status | awk '
    function near(along, across) { ++found; if (($4 - along) ^ 2 + ($5 - across) ^ 2 > 3e-4 ^ 2 * 2) bad = 1 }
    $1 == 0 && $2 == 0 && $3 == 0.5 { near(0, 0.36) }
    $1 == 0.3 && $2 == 0 && $3 == 1 { near(0.49107, 0.67344) }
    $1 == 0 && $2 == 0.3 && $3 == 1 { near(0, 0.98537) }
    $6 != "ok" { bad = 1 }
    END { exit bad || found != 3 }' || fail "forces under spin: $(cat out)"
# reversed spin: the lateral force and the moment change their signs without lateral creepage
named creepage_ratio lateral_ratio spin_ratio force_ratio lateral_force_ratio moment_ratio | awk '
    $2 == 0 && $3 == 1 { x[$1] = $4; y[$1] = $5; m[$1] = $6 }
    $2 == 0 && $3 == -1 { ++found; if (($4 - x[$1]) ^ 2 + ($5 + y[$1]) ^ 2 + ($6 + m[$1]) ^ 2 > 1e-20) bad = 1 }
    END { exit bad || found != 2 || !(m[0.3] > 0.06 && m[0.3] < 0.07) }' || fail "reversed spin: $(cat out)"
# work of the rigid bodies, xi F_x + eta F_y + phi M, is slip work, to the order of the scheme
named creepage_ratio lateral_ratio spin_ratio force_ratio lateral_force_ratio moment_ratio slip_work | awk '
    $1 == 0.3 && $2 == 0.3 && $3 > 0 { work = 2 * 0.72 * ($1 * $4 + $2 * $5 + $3 * $6); ++found
        if (($7 / work - 1) ^ 2 > 0.01 ^ 2) bad = 1 }
    END { exit bad || found != 2 }' || fail "work under spin: $(cat out)"
good 201 $study --transient --kernel plane --aspect 100 $nodes --creepage-ratio 0.3 --lateral-ratio 0.3 --spin-ratio 1 --until 40 --dq 0.2
named force_ratio lateral_force_ratio moment_ratio spin_ratio | tail -n 1 >settled
good 2 $study --kernel plane --aspect 100 $nodes --creepage-ratio 0.3 --lateral-ratio 0.3 --spin-ratio 1
named force_ratio lateral_force_ratio moment_ratio spin_ratio | cat - settled | awk '
    NR == 1 { x = $1; y = $2; m = $3; next }
    END { exit !($4 == 1 && ($1 - x) ^ 2 + ($2 - y) ^ 2 + ($3 - m) ^ 2 < 1e-3 ^ 2) }' || fail 'the long-time limit under spin'
shards $steady --n 5,6 --creepage-ratio 0.5 --lateral-ratio 0.2 --spin-ratio 0,0.5

# --- a load that varies
vary="$study --transient --kernel plane --creepage-ratio 0.5 --load-sine 0.5,8 --from steady --until 8 --dq 0.1"
series='0.7500 0.7618 0.7737 0.7851 0.7963 0.8066 0.8151 0.8207 0.8228 0.8199 0.8101 0.7897 0.7061 0.5955 0.5245 0.4980 0.4937 0.5000 0.5129 0.5299 0.5494'
good 81 $vary --breathing --n 40
header q_over_a,creepage_ratio,shift,force_ratio,stick_count,rounds,slip_work
rows -v list="$series" 'BEGIN { split(list, f, " ") }
    NR > 1 && (NR - 1) % 4 == 0 { i = (NR - 1) / 4 + 1; ++count; if (($force_ratio - f[i]) ^ 2 > 1.2e-3 ^ 2) bad = 1 }
    NR > 1 && ($status != "ok" || ($load_ratio - 1 - 0.5 * sin(0.78539816339744828 * $q_over_a)) ^ 2 > 1e-20 || ($half_length_ratio ^ 2 - $load_ratio) ^ 2 > 1e-20) { bad = 1 }
    END { exit bad || count != 20 || ($creep_work - 6.2501 / 1.5707963267948966) ^ 2 > 8e-3 ^ 2 || ($slip_work - 7.5715 / 1.5707963267948966) ^ 2 > 2e-2 ^ 2 }' out ||
    fail "a breathing contact: $(tail -n 1 out)"
good 81 $vary --mesh uniform --n 160 --unchecked
rows -v list="$series" 'BEGIN { split(list, f, " ") }
    NR > 1 && (NR - 1) % 4 == 0 { i = (NR - 1) / 4 + 1; if (($force_ratio - f[i]) ^ 2 > 8e-3 ^ 2) bad = 1 } END { exit bad }' out ||
    fail 'the same on a fixed mesh'
good 9 $short --load "$scratch/bounce"
check 'lift-off and landing' '$status == "ok" && ($q_over_a < 2 || $q_over_a > 3 ? $force_ratio > 0 : $force_ratio == 0 && $stick_count == 0)'
rows 'NR > 1 { if ($load_ratio != ($q_over_a <= 2 ? 1 - $q_over_a / 2 : $q_over_a <= 3 ? 0 : 1.2 * ($q_over_a - 3))) bad = 1; if ($slip_work < work) bad = 1; work = $slip_work } END { exit bad }' out || fail 'the load of a table'
# a step across a kink is divided there
good 3 $rolling --creepage-ratio 0.5 --until 4 --dq 2 --load "$scratch/bounce" --integrator implicit-euler
mv out coarse
printf 'q_over_a,load_ratio\n0,1\n2,0\n3,0\n4,1.2\n' >"$scratch/again"
good 5 $rolling --creepage-ratio 0.5 --until 4 --dq 1 --load "$scratch/again" --integrator implicit-euler
[ "$(tail -n 1 coarse | cut -d, -f4)" != "" ] || fail 'a kink within a step'
awk -F, 'NR == FNR { last = $4; next } { fine = $4 } END { exit !((last - fine) ^ 2 < 1e-24) }' coarse out ||
    fail 'a kink within a step is where the step is divided'
# a run that loses a step has no more results
printf 'q_over_a,load_ratio\n0,1\n2,1\n2.2,2\n4,1\n' >"$scratch/blow"
lost="$study --transient --kernel plane --aspect 100 --creepage-ratio 0.5 --until 4 --dq 0.5 --load $scratch/blow --breathing"
ended='$12 == "after_failure" && $4 $5 $6 $7 $8 $9 $10 $11 $24 $27 == ""'
ends_early 9 'q/a = 2.2 on: needs_fixed_mesh, the contact grows or shrinks as fast as it rolls; use --breathing=false' $lost --n 20
check 'a contact that grows faster than it rolls' '($q_over_a <= 2 && $status == "ok" && $force_ratio > 0) ||
    ($q_over_a == 2.5 && $status == "needs_fixed_mesh" && $force_ratio $stick_count $slip_work $creep_work == "") || '"(\$q_over_a > 2.5 && $ended)"
ends_early 17 'n = 8: no results from the step to q/a = 2.2 on: needs_fixed_mesh, the contact grows or shrinks as fast as it rolls; use --breathing=false; 1 more of 2 runs ended' \
    $lost --n 8,12 --jobs 2
shards $lost --n 5,6 2>/dev/null
# halves of a step without a solution help, or end the run
hard="$study --transient --unchecked --kernel plane --n 20 --until 10"
good 21 $hard --creepage-ratio 0.5 --lateral-ratio 0.3 --falling 0,0.02 --load-sine 0.8,5 --dq 0.5
check 'a step in halves' '$status == "unchecked" && $force_ratio != "" && $complementarity_residual < 1e-10'
ends_early 201 'no_solution, not even in steps of dq/64' $hard --creepage-ratio 0.5 --falling 3,0.01
awk -F, "NR > 1 { if (lost && !($ended)) bad = 1
    if (\$12 == \"no_solution\") { lost = 1; if (\$4 \$7 \$27 != \"\" || \$10 == \"\") bad = 1 } else if (!lost && \$4 == \"\") bad = 1 }
    END { exit bad || !lost }" out || fail "a step without a solution: $(cut -d, -f1,4,7,12 out)"
good 21 $rolling --creepage-ratio 0.5 --until 1 --load-sine 0.9,0.1
check 'a load that steps do not follow' '$status == "unresolved" && $force_ratio $slip_work $creep_work == ""'
good 81 $rolling --creepage-ratio 0.5 --until 0.2 --load-sine 0.9,0.1 --dq 0.0025
check 'the same load in short steps' '$status == "ok" && $force_ratio != ""'
good 9 $short --lateral-ratio 0.4 --load-sine 0.5,8 --breathing --from steady
check 'both directions under a load' '$status == "ok" && $lateral_ratio == 0.4 && $force_ratio > 0 && $lateral_force_ratio > 0 && $force_ratio ^ 2 + $lateral_force_ratio ^ 2 < $load_ratio ^ 2'
good 401 $rolling --creepage-ratio 0.5 --lateral-ratio 0.4 --until 120 --dq 0.3
mv out limit
good 2 $study --kernel plane --aspect 100 --n 20 --creepage-ratio 0.5 --lateral-ratio 0.4
awk -F, 'NR == FNR { along = $4; across = $24; next } END { exit !((along - $8) ^ 2 + (across - $16) ^ 2 < 2e-4 ^ 2) }' limit out ||
    fail 'the long-time limit in both directions'
shards $rolling --n 5,6 --creepage-ratio 0.5 --lateral-ratio 0.2 --load-sine 0.3,2 --until 1

# --- plots
if command -v gnuplot >/dev/null; then
    good 12 $study --n 20 --plot s.svg
    [ "$(grep -c '</svg>' s.svg)" -eq 1 ] && grep -q Carter s.svg && grep -q stick s.svg || fail 'creep curve and tractions'
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
    good 9 $branches --sweep up --plot f.svg
    grep -q 'sweep down' f.svg && ! grep -q Carter f.svg || fail 'both branches in the plot'
    good 17 $branches --lateral-ratio 0,0.1 --sweep up --plot g.svg
    grep -q 'Lateral force' g.svg && ! grep -q Carter g.svg || fail 'falling friction in both directions in the plot'
    ends_early 9 'use --breathing=false' $lost --n 20 --plot e.svg
    [ "$(grep -c '</svg>' e.svg)" -eq 1 ] || fail 'a picture of what was computed'
    good 41 $rolling --sine 1,1 --until 2 --plot l.svg
    grep -q Hysteresis l.svg || fail 'hysteresis in the plot'
fi

finish
