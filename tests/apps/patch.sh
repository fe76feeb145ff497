#!/bin/sh
# patch_study seen from outside: what several of its runs have in common, and the files of matrices.
# Usage: patch.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
patch="$programs/patch_study --no-timing"

# all nine coefficients of a skew patch, in steady rolling and in the frequency response at 0
printf 'y,x_trailing,x_leading\n-1,-1.5,0.5\n1,-0.5,1.5\n' >skew
{ $patch --n 12 --outline skew && $patch --n 12 --outline skew --omega 0; } | awk -F, '
    NR % 2 { for (i = 1; i <= NF; ++i) name[i] = $i; next }
    NR == 2 { for (i in name) steady[name[i]] = $i }
    NR == 4 { for (i in name) if (sub(/_re$/, "", name[i])) n += (steady[name[i]] / $i - 1) ^ 2 < 1e-20 }
    END { exit !(n == 9 && steady["c12"] * steady["c13"] > 1e-3 && NR == 4) }' || fail 'nine coefficients'

# --- differential equations
good 2 $patch --n 4 --a-over-b 2 --state-space space
[ "$(ls space | tr '\n' ' ')" = 'A.csv B.csv C.csv D.csv state_space.toml ' ] || fail "files: $(ls space)"
[ "$(for m in A B C; do awk -F, 'END { printf "%dx%d ", NR, NF }' space/$m.csv; done)" = '32x32 32x3 3x32 ' ] ||
    fail 'sizes of the matrices'
grep -q 'c21 c22 c23' space/state_space.toml && grep -q '^# status = not_converged' space/state_space.toml ||
    fail 'words of state_space.toml'

# --- Hertz's pressure as a table on an ellipse
awk 'BEGIN { print "x,y,pressure"
    for (j = -60; j <= 60; ++j) for (i = -60; i <= 60; ++i) {
        x = i / 60; y = j / 60; p = x * x + y * y < 1 ? sqrt(1 - x * x - y * y) : 0; print x "," y "," p } }' >hertz
set -- $patch --n 6 --longitudinal 0.1 --lateral 0.1 --spin 0.3 --a-over-b 2
{ "$@" && "$@" --pressure hertz | tail -n 1; } >out
check 'a table of pressures' '$status == "ok" &&
    (NR > 2 || (F = $longitudinal_force) + (Q = $lateral_force) + (M = $spin_moment) > 0) &&
    ($longitudinal_force / F - 1) ^ 2 + ($lateral_force / Q - 1) ^ 2 + ($spin_moment / M - 1) ^ 2 < 1e-6'

# --- under a load: eight times the load on twice the ellipse at half the creepage is the same
set -- $patch --n 6 --a-over-b 0.5 --spin 0.2 --transient
"$@" --lateral 0.1 --dq 0.1 --until 2 >constant
printf 'load_ratio;q_over_a\n8;0\n8;4\n' >load
"$@" --lateral 0.2 --dq 0.2 --until 4 --load load >out
check 'semi-axes' '$a_ratio == 2 && $b_ratio == 2'
rows 'NR == FNR { Q[FNR] = $lateral_force; M[FNR] = $spin_moment; next }
    FNR > 1 { same += ($lateral_force / 8 / Q[FNR] - 1) ^ 2 < 1e-20 && ($spin_moment / 16 / M[FNR] - 1) ^ 2 < 1e-20 }
    END { exit same != 20 }' constant out || fail 'scaling of the load'
# the force under a load that comes to rest is that of its last ellipse: a b is larger by 1.125, which the creepages and
# c are measured in
printf 'q_over_a,load_ratio,a_ratio,b_ratio\n0,1,1,1\n4,1,1.5,0.75\n20,1,1.5,0.75\n' >load
set -- $patch --n 6 --transient --from steady
"$@" --lateral 0.1 --spin 0.2 --dq 0.2 --until 20 --load load --breathing >out
check 'energy of a patch that changes its shape' '$status == "ok" &&
    (NR > 2 || (E = $elastic_energy + $slip_work - $creep_work)) &&
    ($elastic_energy + $slip_work - $creep_work - E) ^ 2 < (0.03 * $creep_work + 1e-3) ^ 2'
force=$(cell lateral_force)
"$@" --a-over-b 2 --lateral 0.1125 --spin 0.2386485 --dq 0.125 --until 10 >out
[ "$(rows -v end="$force" 'END { print ($lateral_force / end - 1) ^ 2 < 1e-7 }' out)" = 1 ] ||
    fail "not the force under the last ellipse, $force: $(tail -n 1 out)"
for topic in outline pressure stability friction transient; do $patch --help $topic >out || fail "--help $topic"; done

finish
