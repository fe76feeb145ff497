#!/bin/sh
# apps/support, seen from outside: configuration files, standard streams as files, and conflicts between files of a run.
# Usage: files.sh FOLDER-OF-PROGRAMS
results=$(cd "$(dirname "$0")/../../bench/results" && pwd)
. "$(dirname "$0")/functions.sh"
steady=$programs/steady_study
printf '%s\n' -1 -0.2 0.5 1 >edges
cp edges own

# a configuration file, also from standard input
printf '# one\n"n" = [10,\n  "20"\n]\r\nalpha-T=[0.5 , 0.6]\nmesh = cosine\nno-timing' >c.toml
good 5 "$steady" --config c.toml
check 'all that a configuration file says' '$mesh == "cosine" && ($n == 10 || $n == 20) &&
    ($alpha_T == 0.5 || $alpha_T > 0.59) && $solve_us == ""'
"$steady" --config - <c.toml | cmp -s out - || fail 'a configuration from standard input'

# the file beside the rows repeats a run: the same rows, without its outputs and jobs
"$steady" --quiet --alpha-T 0.5,0.6 --alpha-L 0 --jobs 2 --no-timing --edges own --shard 2/2 --output run.csv ||
    fail run.csv
[ "$(grep -v '^#' run.csv.toml | cut -d' ' -f1 | tr '\n' ' ')" = 'alpha-L alpha-T edges no-timing quiet shard ' ] ||
    fail "options given: $(cat run.csv.toml)"
mkdir parts
(cd parts && "$steady" --config ../run.csv.toml --edges ../own | cmp ../run.csv -) && [ -z "$(ls -A parts)" ] ||
    fail 'a run that is repeated writes its files again, or other rows'
good 3 "$steady" --config run.csv.toml --shard 1/1
cp run.csv before
"$steady" --config run.csv.toml --shard 2/2 --output run.csv && cmp -s before run.csv || fail 'a run over itself'
grep -q '^edges = "own"' run.csv.toml || fail 'the options of a run that is repeated are lost'
bad 'program = steady_study must be traction_study' "$programs/traction_study" --config "$scratch/run.csv.toml"
"$programs/stability_study" --n 6 --critical --output run.csv || fail '--critical'
"$programs/stability_study" --config run.csv.toml | cmp -s run.csv - || fail 'a flag of a run that is repeated'
friction="$programs/friction_study --n 8 --creepage-ratio 0.5 --no-timing"
$friction --tractions t.csv --output run.csv && $friction --config t.csv.toml --tractions t.csv --output again.csv &&
    cmp -s run.csv again.csv || fail 'the file beside --tractions'
rm -rf run.* t.csv* again.*

# the runs of bench/results are taken as they stand there, here without a row
for run in "$results"/*.csv.toml; do
    few='--shard 1/1000000'
    if grep -q '^positions = "-"' "$run"; then few='--wear-step 0.01'; fi # rows of wear cannot be divided
    (cd "$results" && "$programs/$(sed -n '1s/^# program = //p' "$run")" --config "$run" $few) \
        <"$results/wear_positions.csv" \
        >out 2>err || fail "$run cannot be repeated: $(cat err)"
done
# pictures can be repeated, too: a run or a script of gnuplot made each but the FMU's, which fmu.py made
for picture in "$results"/*.svg; do
    made=${picture%.svg}
    [ -e "$made.csv.toml" ] || [ -e "$made.gp" ] || [ "${made##*/}" = fmu_patch ] || fail "nothing draws $picture"
done

# - is a standard stream, not a file
cd parts || exit 1
"$steady" --n 10 --no-timing >../out
"$steady" --n 10 --no-timing --output - | cmp -s ../out - || fail '--output -'
[ "$("$steady" --edges - <../edges | wc -l)" -eq 2 ] && [ -z "$(ls -A)" ] || fail 'standard streams'
cd ..
bad "--config = $scratch must be a file that can be read" "$steady" --config "$scratch"

friction="$programs/friction_study --n 10 --creepage-ratio 0.5"
good 0 $friction --config /dev/null --output /dev/null --tractions /dev/null
good 11 $friction --tractions - --output new
check 'tractions on standard output' '$n == 10 && $creepage_ratio == 0.5 && $traction <= 0'

finish
