#!/bin/sh
# profile_study seen from outside: files of profiles, and the Manchester contact benchmark beside CONTACT.
# Usage: profile.sh FOLDER-OF-PROGRAMS
benchmark=$(cd "$(dirname "$0")/../../bench/manchester" && pwd)
. "$(dirname "$0")/functions.sh"
profile="$programs/profile_study --quiet --no-timing"

bad '--shift = 0.1 has no effect with --positions' $profile --shift 0.1 --positions "$benchmark/positions.csv"
bad '--roll = 0.1 has no effect with a column roll' $profile --roll 0.1 --positions "$benchmark/positions.csv"
bad '--smooth = 1 must lie in [0.0001, 0.1]' $profile --length-unit mm --wheel "$benchmark/wheel.csv" --smooth 1

# --- half of the benchmark: tables as CSV in mm; positions, pressures and forces beside CONTACT, whose own errors on its
# grid of 0.2 mm are 2e-2 in areas, more on flanges, 3e-3 in peak pressures, and 9e-3 at most in forces
awk 'NR < 3 || NR % 2 == 1' "$benchmark/positions.csv" >positions.csv
at="--length-unit mm --cant 0 --positions positions.csv --side both --load 1e4 --friction 0.3 --speed 2 --slip linear"
$profile $at --wheel "$benchmark/wheel.csv" --rail "$benchmark/rail.csv" --output table.csv || fail "the benchmark"
[ "$(wc -l <table.csv)" -eq 24 ] || fail "$(wc -l <table.csv) lines instead of 24: one position has two patches on a wheel"
awk -F, -f "$benchmark/compare.awk" "$benchmark/contact.csv" table.csv >differences
within() { # within QUANTITY MEAN LARGEST
    awk -F, -v q=$1 -v mean=$2 -v largest=$3 '$1 == q && $3 <= mean && $4 <= largest { ok = 1 } END { exit !ok }' \
        differences || fail "difference from CONTACT: $(grep "^$1," differences), not $2, $3"
}
within x 5e-4 6e-3
within y 3e-4 2e-3
within z 3e-4 3e-3
within angle 4e-5 3e-4
within height 2e-4 5e-4
within load 3e-4 8e-4
within approach 2e-3 1e-2
within peak_pressure 4e-3 2e-2
within area 4e-2 0.11
within longitudinal_creepage 2e-6 1e-5
within lateral_creepage 5e-6 3e-5
within spin 3e-7 2e-6
within longitudinal_force 1e-3 5e-3
within lateral_force 1e-3 1.3e-2
within spin_moment 2e-3 1e-2

# --- the same profiles as .prw and .prr, mirrored or not, give the same rows
{
    printf 'header.begin\n version = 1 ! flag\nheader.end\nspline.begin\n mirror.y = 1 ! 5\n inversion = 1\n'
    printf ' units.len.f = 1000\n point.begin\n ! y z\n!7.0E+01 9.5\n'
    awk -F, '/^[-0-9]/ { printf "%.17g\t%s\n", -$1, $2 }' "$benchmark/wheel.csv"
    printf 'point.end\nspline.end\n1 2 3\n'
} >wheel.prw
{
    printf 'point.begin\n'
    awk -F, '/^[-0-9]/ { print $1, $2, 1 }' "$benchmark/rail.csv"
    printf 'point.end\n'
} >rail.prr
at="--cant 0 --shift 0.002"
$profile $at --length-unit mm --wheel "$benchmark/wheel.csv" --rail "$benchmark/rail.csv" >one
$profile $at --wheel wheel.prw --rail rail.prr >other
cmp one other || fail 'a profile as .prw'

# --- rows that fail say why; both wheels carry the load; the row order does not depend on --jobs
$profile --shift 0,0.003,0.006 --side both >one
$profile --shift 0,0.003,0.006 --side both --jobs 2 >other
cmp one other || fail '--jobs'
awk -F, 'NR > 1 { vertical[$1, $4] += $14 * cos($12) }
    END { for (k in vertical) if ((vertical[k] / 1e5 - 1) ^ 2 > 1e-10) exit 1 }' one || fail 'vertical loads'

# --- wear: what all elements of a patch lose lies on both profiles
$profile --shift 0.003 --side both --friction 0.3 --wear wear.csv >out || fail '--wear'
awk -F, 'FNR == 1 { for (i = 1; i <= NF; ++i) column[FILENAME, $i] = i; next }
    FILENAME == "out" { lost[$column["out", "side"]] += $column["out", "slip_power"]; next }
    { k = $1 "," $2; found[k] += $6 * ($3 - before[k]); before[k] = $3 }
    END { for (k in found) { ++count; split(k, of, ","); if ((found[k] / lost[of[1]] - 1) ^ 2 > 1e-6) exit 1 }
          exit count != 4 }' out wear.csv || fail 'work on the profiles'

# --- patches as files that patch_study reads
$profile --shift 0.004 --side left --outline patches >out || fail '--outline'
$programs/patch_study --quiet --no-timing --n 8 --outline patches/1_left_1.outline.csv \
    --pressure patches/1_left_1.pressure.csv --longitudinal 0.1 | grep -q ',ok,chebyshev$' || fail 'patch_study of a patch'

finish
