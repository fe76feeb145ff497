#!/bin/sh
# profile_study seen from outside: files of profiles, and the Manchester contact benchmark beside CONTACT.
# Usage: profile.sh FOLDER-OF-PROGRAMS
benchmark=$(cd "$(dirname "$0")/../../bench/manchester" && pwd)
. "$(dirname "$0")/functions.sh"
profile="$programs/profile_study --quiet --no-timing"

bad '--shift = 0.1 has no effect with --positions' $profile --shift 0.1 --positions "$benchmark/positions.csv"
bad '--roll = 0.1 has no effect with a column roll' $profile --roll 0.1 --positions "$benchmark/positions.csv"
bad '--smooth = 1 must lie in [0.0001, 0.1]' $profile --length-unit mm --wheel "$benchmark/wheel.csv" --smooth 1

# --- half of the benchmark: tables as CSV in mm; positions, pressures and forces beside CONTACT, whose own errors on
# its grid of 0.2 mm are 2e-2 in areas, more on flanges, 3e-3 in peak pressures, and 9e-3 at most in forces. Its loads
# are N cos delta of planes, which on flanges differs by 3e-3 from what pressures carry along the normals of the surface.
awk 'NR < 3 || NR % 2 == 1' "$benchmark/positions.csv" >positions.csv
at="--length-unit mm --cant 0 --positions positions.csv --side both --load 1e4 --load-of all --friction 0.3 --speed 2 --slip linear"
$profile $at --wheel "$benchmark/wheel.csv" --rail "$benchmark/rail.csv" --output table.csv || fail "the benchmark"
[ "$(wc -l <table.csv)" -eq 24 ] ||
    fail "$(wc -l <table.csv) lines instead of 24: one position has two patches on a wheel"
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
within load 7e-4 4e-3
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
} >wheel.PRW
{
    printf 'point.begin\n'
    awk -F, '/^[-0-9]/ { print $1, $2, 1 }' "$benchmark/rail.csv"
    printf 'point.end\n'
} >rail.prr
at="--cant 0 --shift 0.002"
$profile $at --length-unit mm --wheel "$benchmark/wheel.csv" --rail "$benchmark/rail.csv" >one
$profile $at --wheel wheel.PRW --rail rail.prr >other
cmp one other || fail 'a profile as .prw'

for f in wheel rail; do awk -F, '/^[-0-9]/ { printf "%.17g,%.17g\n", -$1, -$2 }' "$benchmark/$f.csv" >$f.txt; done
$profile $at --length-unit mm --wheel wheel.txt --wheel-mirror yz --rail rail.txt --rail-mirror yz >other
cmp one other || fail '--wheel-mirror, --rail-mirror'

# --- the left side: other profiles as a right wheel on a right rail, mirrored or not
here="$profile --length-unit mm --cant 0 --shift 0.002 --side both"
here="$here --wheel $benchmark/wheel.csv --rail $benchmark/rail.csv"
$here >one
$here --left-wheel wheel.txt --left-wheel-mirror yz --left-rail rail.txt --left-rail-mirror yz >other
cmp one other || fail '--left-wheel, --left-rail'

# --- --rail-origin gives the same place as the gauge; a height given carries the load that it was found with
at='--rail uic60 --cant 0 --shift 0.002 --cells 60,40'
$profile $at --roll 0 >one
eval "$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i }
    NR == 2 { printf "origin=%.12f height=%s load=%s", $at["y"] - $at["rail_y"], $at["height"], $at["load"] }' one)"
$profile $at --rail-origin "$origin,0" --height "$height" >other
rows "END { exit !((\$load / $load - 1) ^ 2 < 1e-6 && \$height == $height && \$roll == 0) }" other ||
    fail "--rail-origin, --height: $(cat one other)"

# --- spheres of 100 mm, planes, rollers: what --interaction, --roller-radius, --x and --pitch do
circle='BEGIN { for (y = -20; y <= 20; y += 0.5) print y, sqrt(1e4 - y * y) - 100 + lift }'
awk "$circle" >sphere.txt
awk -v lift=1 "$circle" >larger.txt
awk 'BEGIN { for (y = -20; y <= 20; y += 0.5) print y, 100 - sqrt(1e4 - y * y) }' >crown.txt
awk 'BEGIN { for (y = -60; y <= 60; y += 2) print y, 0 }' >plane.txt
awk 'BEGIN { for (y = -60; y <= 60; y += 2) print y, -5 }' >higher.txt
awk 'BEGIN { for (y = -40; y <= 40; y += 0.5) { d = (y < 0 ? -y : y) - 20; print y, d * d / 600 } }' >crowns.txt
shape="$profile --length-unit mm --any-shape --cant 0 --roll 0 --load 1e4"
approach() { # approach FILE: and height
    awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i } NR > 1 { print $at["approach"], $at["height"] }' $1
}
$shape --wheel sphere.txt --radius 0.1 --rail plane.txt --rail-origin 0.75,0 >one
$shape --wheel plane.txt --radius 0.13333333333333333 --rail crown.txt --rail-origin 0.75,0 --roller-radius 0.4 >other
{ approach one && approach other; } | awk '{ a[NR] = $1 } END { exit !((a[1] / a[2] - 1) ^ 2 < 1e-6) }' ||
    fail '--roller-radius: 1/R_w + 1/R_r'
$shape --wheel plane.txt --rail crowns.txt --rail-origin 0.75,0 >one
$shape --wheel plane.txt --rail crowns.txt --rail-origin 0.75,0 --interaction off >other
{ approach one && approach other; } | awk '{ h[NR] = $2 } END { exit !(NR == 4 && h[1] > 1.01 * h[3]) }' ||
    fail '--interaction: two crowns'
# a left wheel whose radius is smaller by a millimetre lies lower by that, 1.5 m away
$profile --length-unit mm --any-shape --cant 0 --load 1e4 --wheel sphere.txt --radius 0.1 --left-radius 0.099 \
    --rail plane.txt --rail-origin 0.75,0 --side both --friction 0.3 >one
rows 'function near(a, b, by) { return (a - b) ^ 2 < by ^ 2 }
    NR > 1 { ++count; given = $side == "left" ? 0.099 : 0.1
        if (!near($roll, -1e-3 / 1.5, 1e-6) || !near($rolling_radius, given, 1e-5)) bad = 1
        if (!near($load * cos($angle), 1e4, 20) || !near($z, 0, 1e-9)) bad = 1 }
    END { exit bad || count != 2 }' one || fail "--left-radius: $(cat one)"
printf '0 1\n3\n0\n1\n0 "plane.txt"\n500 "higher.txt"\n1000 "plane.txt"\n' >ramp.slcs
$shape --wheel sphere.txt --radius 0.1 --rail ramp.slcs --rail-origin 0.75,0 --x 0.1,0.5 --shift 0,0.01 >one
rows 'NR == 2 || NR == 4 { low = $height } NR == 3 || NR == 5 { if (low - $height < 3e-3) bad = 1 }
    NR == 3 && ($track_x != 0.5 || $x ^ 2 > 1e-10 || ($height - $approach + 5e-3) ^ 2 > 1e-12) { bad = 1 }
    END { exit bad || !(NR == 5 && $track_x == 0.5 && $shift == 0.01) }' one || fail '--x: a rail that rises'
printf '0 1\n2\n0\n1\n-0.1 "sphere.txt"\n0.1 "larger.txt"\n' >oval.slcw
$shape --wheel oval.slcw --radius 0.1 --rail plane.txt --rail-origin 0.75,0 --pitch 0.3,-0.3 >one
approach one | awk '{ h[NR] = $2; a[NR] = $1 }
    END { exit !(NR == 2 && (h[1] - h[2] - 1e-3) ^ 2 < 1e-12 && a[1] > 0) }' ||
    fail '--pitch: a wheel of two radii'

# --- what was done with files stands in the sidecar
awk '{ print } NR == 40' sphere.txt >twice.txt
$shape --wheel twice.txt --radius 0.1 --rail plane.txt --rail-mirror z --rail-origin 0.75,0 --output noted.csv
grep -q '^# note = --wheel: repeated points' noted.csv.toml && grep -q '^# note = --rail: z mirrored' noted.csv.toml ||
    fail 'notes in the sidecar'

# --- rows that fail say why; both wheels carry the load, N cos delta but for a percent; the row order does not depend on --jobs
$profile --shift 0,0.003,0.006 --side both >one
$profile --shift 0,0.003,0.006 --side both --jobs 2 >other
cmp one other || fail '--jobs'
awk -F, 'NR > 1 { vertical[$1, $4] += $14 * cos($12) }
    END { for (k in vertical) if ((vertical[k] / 1e5 - 1) ^ 2 > 1e-4) exit 1 }' one || fail 'vertical loads'

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
    --pressure patches/1_left_1.pressure.csv --longitudinal 0.1 | grep -q ',ok,chebyshev,' ||
    fail 'patch_study of a patch'

finish
