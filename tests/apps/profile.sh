#!/bin/sh
# profile_study seen from outside: files of profiles, and the Manchester contact benchmark beside CONTACT.
# Usage: profile.sh FOLDER-OF-PROGRAMS
benchmark=$(cd "$(dirname "$0")/../../bench/manchester" && pwd)
. "$(dirname "$0")/functions.sh"
profile="$programs/profile_study --quiet --no-timing"
same() { "$@" >other && cmp -s one other || fail "other rows: $*"; }

# --- half of the benchmark: tables as CSV in mm; positions, pressures and forces beside CONTACT, whose own errors on
# its grid of 0.2 mm are 2e-2 in areas, more on flanges, 3e-3 in peak pressures, and 9e-3 at most in forces. Its loads
# are N cos delta of planes, which on flanges differs by 3e-3 from what pressures carry along the surface's normals.
awk 'NR < 3 || NR % 2 == 1' "$benchmark/positions.csv" >positions.csv
at="--length-unit mm --cant 0 --positions positions.csv --side both --load 1e4 --load-of all"
$profile $at --friction 0.3 --speed 2 --slip linear --wheel "$benchmark/wheel.csv" --rail "$benchmark/rail.csv" \
    --output table.csv || fail "the benchmark"
[ "$(wc -l <table.csv)" -eq 24 ] ||
    fail "$(wc -l <table.csv) lines instead of 24: one position has two patches on a wheel"
awk -F, -f "$benchmark/compare.awk" "$benchmark/contact.csv" table.csv >differences
while read -r quantity mean largest; do
    awk -F, -v q="$quantity" -v mean="$mean" -v largest="$largest" '
        $1 == q && $3 <= mean && $4 <= largest { ok = 1 } END { exit !ok }' differences ||
        fail "difference from CONTACT: $(grep "^$quantity," differences), not $mean, $largest"
done <<'END'
x 5e-4 6e-3
y 3e-4 2e-3
z 3e-4 3e-3
angle 4e-5 3e-4
height 2e-4 5e-4
load 7e-4 4e-3
approach 2e-3 1e-2
peak_pressure 4e-3 2e-2
area 4e-2 0.11
longitudinal_creepage 2e-6 1e-5
lateral_creepage 5e-6 3e-5
spin 3e-7 2e-6
longitudinal_force 1e-3 5e-3
lateral_force 1e-3 1.3e-2
spin_moment 2e-3 1e-2
END

# --- the same profiles, mirrored or not, on the left or not, give the same rows
profile="$profile --cant 0"
for f in wheel rail; do awk -F, '/^[-0-9]/ { printf "%.17g,%.17g\n", -$1, -$2 }' "$benchmark/$f.csv" >$f.txt; done
at="--shift 0.002 --side both --length-unit mm"
here="$profile $at --wheel $benchmark/wheel.csv --rail $benchmark/rail.csv"
$here >one
same $profile $at --wheel wheel.txt --wheel-mirror yz --rail rail.txt --rail-mirror yz
same $here --left-wheel wheel.txt --left-wheel-mirror yz --left-rail rail.txt --left-rail-mirror yz

# --- --rail-origin gives the same place as the gauge; a height given carries the load that it was found with
at='--rail uic60 --shift 0.002 --cells 60,40'
$profile $at --roll 0 >out
load=$(cell load) height=$(cell height)
$profile $at --rail-origin "$(rows 'END { printf "%.12f", $y - $rail_y }' out),0" --height "$height" >other
rows "END { exit !((\$load / $load - 1) ^ 2 < 1e-6 && \$height == $height && \$roll == 0) }" other ||
    fail "--rail-origin, --height: $(cat out other)"

# --- spheres of 100 mm, planes, rollers: what --interaction, --roller-radius, --x and --pitch do
shape() { awk "BEGIN { for (y = -40; y <= 40; y += 0.5) if ($1) print y, $2 }" >"$3"; }
shape 'y * y <= 400' 'sqrt(1e4 - y * y) - 100' sphere.txt
shape 'y * y <= 400' 'sqrt(1e4 - y * y) - 99' larger.txt
shape 'y * y <= 400' '100 - sqrt(1e4 - y * y)' crown.txt
shape 1 0 plane.txt
shape 1 -5 higher.txt
shape 1 '((y < 0 ? -y : y) - 20) ^ 2 / 600' crowns.txt
shape="$profile --length-unit mm --any-shape --roll 0 --load 1e4 --rail-origin 0.75,0"
$shape --wheel sphere.txt --radius 0.1 --rail plane.txt >out
approach=$(cell approach)
$shape --wheel plane.txt --radius 0.13333333333333333 --flange-back 0 --tape-offset 0.75 \
    --rail crown.txt --roller-radius 0.4 >out
check '--roller-radius: 1/R_w + 1/R_r' "(\$approach / $approach - 1) ^ 2 < 1e-6"
$shape --wheel plane.txt --rail crowns.txt >out
height=$(cell height)
$shape --wheel plane.txt --rail crowns.txt --interaction off >out
check '--interaction: two crowns' "NR <= 3 && $height > 1.01 * \$height"
printf '0 1\n3\n0\n1\n0 "plane.txt"\n500 "higher.txt"\n1000 "plane.txt"\n' >ramp.slcs
$shape --wheel sphere.txt --radius 0.1 --rail ramp.slcs --x 0.1,0.5 --shift 0,0.01 >one
rows 'NR % 2 == 0 { low = $height } NR == 3 || NR == 5 { if (low - $height < 3e-3) bad = 1 }
    NR == 3 && ($track_x != 0.5 || $x ^ 2 > 1e-10 || ($height - $approach + 5e-3) ^ 2 > 1e-12) { bad = 1 }
    END { exit bad || !(NR == 5 && $track_x == 0.5 && $shift == 0.01) }' one || fail '--x: a rail that rises'
printf '0 1\n2\n0\n1\n-0.1 "sphere.txt"\n0.1 "larger.txt"\n' >oval.slcw
$shape --wheel oval.slcw --radius 0.1 --rail plane.txt --pitch 0.3,-0.3 >out
check '--pitch: a wheel of two radii' 'NR == 2 && (first = $height) + $approach > $height ||
    (first - $height - 1e-3) ^ 2 < 1e-12'
# a left wheel whose radius is smaller by a millimetre lies lower by that, 1.5 m away
$profile --length-unit mm --any-shape --load 1e4 --wheel sphere.txt --radius 0.1 --left-radius 0.099 \
    --rail plane.txt --rail-origin 0.75,0 --side both --friction 0.3 >out
check '--left-radius' 'NR <= 3 && ($roll + 1e-3 / 1.5) ^ 2 < 1e-12 && $z ^ 2 < 1e-18 &&
    ($rolling_radius - ($side == "left" ? 0.099 : 0.1)) ^ 2 < 1e-10 && ($load * cos($angle) - 1e4) ^ 2 < 400'

# --- what was done with files stands in the sidecar
awk '{ print } NR == 40' sphere.txt >twice.txt
$shape --wheel twice.txt --radius 0.1 --rail plane.txt --rail-mirror z --output noted.csv
grep -q '^# note = --wheel: repeated points' noted.csv.toml && grep -q '^# note = --rail: z mirrored' noted.csv.toml ||
    fail 'notes in the sidecar'

# --- what is doubted stands in the sidecar, or on standard error without one
awk -F, '/^[-0-9]/ { printf "%.17g,%.17g\n", $1 - 5, $2 }' "$benchmark/wheel.csv" >beside.txt
doubted="$programs/profile_study --length-unit mm --conicity --amplitude 0.003 --wheel beside.txt --rail rail.txt"
doubted="$doubted --rail-mirror yz"
$doubted >out 2>err
[ "$(grep -c '^profile_study: note: ' err)" -eq 2 ] && grep -q "note: --wheel: y of the flange's back = -0.0746 m" err &&
    grep -q 'note: --rail: turned inwards by 1:40: --cant 0' err || fail "doubts on standard error: $(cat err)"
good 2 $doubted --tape-offset 0.075 --cant 0
good 0 $doubted --output doubted.csv
[ "$(grep -c "^# note = .*\(flange's back\|turned inwards\)" doubted.csv.toml)" -eq 2 ] || fail "doubts in the sidecar"

# --- wear: what all elements of a patch lose lies on both profiles, in the mean of both positions; both wheels carry
# the load, N cos delta but for a percent; patches as files that patch_study reads
profile="$programs/profile_study --quiet --no-timing --shift 0.003,0.004 --side both --friction 0.3 --n 6 --strips 7"
$profile --wear wear.csv --outline patches >one || fail '--wear, --outline'
same $profile --jobs 2
rows 'FNR == 1 { next }
    FILENAME == "wear.csv" { k = $1 "," $2; found[k] += $6 * ($3 - before[k]); before[k] = $3; next }
    { lost[$side] += $slip_power; vertical[$shift, $side] += $load * cos($angle) }
    END { for (k in found) { split(k, of, ","); near += (2 * found[k] / lost[of[1]] - 1) ^ 2 < 1e-6 }
          for (k in vertical) near += (vertical[k] / 1e5 - 1) ^ 2 < 1e-4
          exit near != 8 }' wear.csv one || fail "work on the profiles, or vertical loads: $(cat one)"
$programs/patch_study --quiet --no-timing --n 8 --outline patches/1_left_1.outline.csv \
    --pressure patches/1_left_1.pressure.csv --longitudinal 0.1 | grep -q ',ok,chebyshev,' ||
    fail 'patch_study of a patch'

# apart K ONE OTHER: the largest distance between points of one number along the normals of profile ONE [m]; for K > 0
# the largest second difference of these distances over K points to both sides
apart() {
    awk -F, -v k="$1" 'FNR == 1 { next } FNR == NR { y[FNR] = $1; z[FNR] = $2; next }
        { off[FNR, 1] = $1 - y[FNR]; off[FNR, 2] = $2 - z[FNR] }
        END { for (i = 3; i < FNR; ++i) {
                  along = y[i + 1] - y[i - 1]; down = z[i + 1] - z[i - 1]
                  depth[i] = (off[i, 1] * down - off[i, 2] * along) / sqrt(along ^ 2 + down ^ 2) }
              for (i = 3 + k; i < FNR - k; ++i) {
                  own = k ? depth[i - k] - 2 * depth[i] + depth[i + k] : depth[i]
                  if (own < 0) own = -own
                  if (own > most) most = own }
              print most }' "$2" "$3"
}

# below SHARE ONE OTHER: whether ONE is positive and below this share of OTHER.
below() { awk -v share="$1" -v one="$2" -v other="$3" 'BEGIN { exit !(one > 0 && one < share * other) }'; }

# --- wear step by step: half the step changes profiles by less than 2 % of the depth; they are read again
printf 'shift,yaw,friction,distance,passages\n-0.002,0,0.3,4e4,4e4\n0.001,0,0.3,4e4,4e4\n0.004,0,0.3,2e4,1e4\n' >collective.csv
wears="$programs/profile_study --quiet --n 6 --strips 7 --speed 20"
$wears --positions collective.csv --wear-step 1e-5 --worn-wheel worn.csv --worn-rail worn_rail.csv >one 2>err &&
    $wears --positions collective.csv --wear-step 5e-6 --worn-wheel half.csv --worn-rail half_rail.csv >other ||
    fail "wear: $(cat err)"
rows 'FNR > 1 { wheel = $wheel_depth; rail = $rail_depth; count[FILENAME] = FNR - 1 }
    END { print wheel, rail; exit !(count["one"] > 3 && count["other"] > 1.5 * count["one"]) }' one other >depths ||
    fail "half of a step: $(tail -n 1 one other)"
read -r wheel rail <depths
below 0.02 "$(apart 0 half.csv worn.csv)" "$wheel" && below 0.02 "$(apart 0 half_rail.csv worn_rail.csv)" "$rail" ||
    fail "profiles after halves of a step: $(apart 0 half.csv worn.csv) $wheel, $(apart 0 half_rail.csv worn_rail.csv) $rail"
sed 's/e4/e3/g' collective.csv >tenth.csv
cp collective.csv beyond.csv && echo '0.05,0,0.3,1,0' >>beyond.csv
exits 1 0 $wears --positions beyond.csv --output early.csv --worn-wheel early_wheel.csv
complains 'wear: ended after 0 m: row 4 of --positions, shift = 0.05 m: end_of_profile'
rows 'END { exit !(FNR == 2 && $wheel_depth == "0" && $wheel_depth_y == "" && $status == "end_of_profile") }' early.csv ||
    fail "wear that ended: $(cat early.csv)"
good 2 $programs/profile_study --quiet --wheel early_wheel.csv --shift 0

# --- four steps of about 250 km, as long as they may be, are within 2 % of the depth of steps of a fifth, and leave no
# waves as short as a patch, 10 mm: second differences over half of it, 25 points, are within 5 %
printf 'shift,yaw,friction,distance\n-0.002,0,0.08,4e5\n0.001,0,0.08,4e5\n0.003,0,0.08,2e5\n' >long.csv
exits 0 6 $wears --positions long.csv --worn-wheel long_wheel.csv
$wears --positions long.csv --wear-step 4e-6 --worn-wheel fifth_wheel.csv >out || fail "wear: $(cat out)"
for points in 0 25; do
    off=$(apart $points fifth_wheel.csv long_wheel.csv) all=$(apart $points early_wheel.csv fifth_wheel.csv)
    below $((points ? 5 : 2))e-2 "$off" "$all" || fail "long steps: $off of $all over $points points"
done

# --- a gauge face wears less where it is lubricated, and the tread as before
printf 'shift,yaw,distance,passages\n0,0,4e3,40\n0.006,0.01,1e3,1000\n' >curve.csv
printf 'angle,mu\n-1.2,0.1\n-0.38,0.1\n-0.25,0.3\n1.2,0.3\n' >lubricated.csv
$wears --positions curve.csv --friction 0.3 >one && $wears --positions curve.csv --friction lubricated.csv >other
rows 'FNR > 1 { side[FILENAME] = $rail_side_wear; top[FILENAME] = $rail_vertical_wear }
    END { exit !(side["other"] > 0 && side["other"] < side["one"] / 2 && (top["other"] / top["one"] - 1) ^ 2 < 1e-4) }' \
    one other || fail "lubricated: $(tail -n 1 one other)"
good 3 $wears --positions tenth.csv --wheel worn.csv --rail worn_rail.csv --cant 0.02499479361892016

# --- a wheel whose flange's back contradicts --tape-offset comes back by alignment, although it is worn
awk -F, 'NR > 1 { printf "%.9f %.9f\n", $1 + 0.07, $2 - 0.001 }' worn.csv >beside.txt
at="$programs/profile_study --quiet --no-timing --shift 0.002"
$at --wheel worn.csv >one
bad "y seems to begin at the flange's back" $at --wheel ../beside.txt
$at --wheel beside.txt --align-wheel s1002 --output other || fail '--align-wheel'
grep -q 'aligned with s1002: moved by dy = -\(70\|69\)[.0-9]* mm, dz = [01][.0-9]* mm; residual' other.toml || fail "note: $(cat other.toml)"
rows 'FNR > 1 { place[FILENAME] = $y; rolls[FILENAME] = $rolling_radius }
    END { exit !((place["one"] - place["other"]) ^ 2 < 1e-12 && (rolls["one"] - rolls["other"]) ^ 2 < 1e-14) }' \
    one other ||
    fail "aligned: $(cat one other)"

finish
