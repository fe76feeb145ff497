#!/bin/sh
# apps/support, seen from outside: configuration files, standard streams as files, and conflicts between files of a run.
# Usage: files.sh FOLDER-OF-PROGRAMS
results=$(cd "$(dirname "$0")/../../bench/results" && pwd)
. "$(dirname "$0")/functions.sh"
steady=$programs/steady_study
printf '%s\n' -1 -0.2 0.5 1 >"$scratch/edges"

# a configuration file; the command line takes precedence
printf '# one\n"n" = [10,\n  "20"\n]\r\nalpha-T=[0.5 , 0.6]\nmesh = cosine\nquiet' >c.toml
good 5 "$steady" --config c.toml
check 'all that a configuration file says' '$mesh == "cosine" && ($n == 10 || $n == 20) &&
    ($alpha_T == 0.5 || $alpha_T > 0.59)'
"$steady" --config - <c.toml | cut -d, -f1-10 >from_stdin
cut -d, -f1-10 out | cmp -s - from_stdin || fail "a configuration from standard input"

# the file beside the rows repeats a run: the same rows, without its outputs and jobs
printf '%s\n' -1 -0.2 0.5 1 >own
"$steady" --quiet --alpha-T 0.5,0.6 --alpha-L 0 --jobs 2 --no-timing --edges own --shard 2/2 --output run.csv ||
    fail run.csv
grep -v '^#' run.csv.toml >given
[ "$(cut -d' ' -f1 given | tr '\n' ' ')" = 'alpha-L alpha-T edges no-timing quiet shard ' ] ||
    fail "options given: $(cat given)"
good 1 "$steady" --config run.csv.toml
cmp -s out run.csv || fail "the part of a run that is repeated"
good 3 "$steady" --config run.csv.toml --shard 1/1
"$steady" --alpha-T 0.5,0.6 --no-timing --edges own | cmp -s - out || fail "rows of a run that is repeated"
good 2 "$steady" --config run.csv.toml --alpha-T 0.5 --shard 1/1
cp run.csv before
"$steady" --config run.csv.toml --shard 2/2 --output run.csv && cmp -s before run.csv || fail "a run over itself"
grep -q '^edges = "own"' run.csv.toml || fail "the options of a run that is repeated are lost"
good 1 "$steady" --config run.csv.toml
mkdir parts
(cd parts && "$steady" --config ../run.csv.toml --edges ../own >../out) && [ -z "$(ls -A parts)" ] ||
    fail "a run that is repeated writes its files again"
bad 'program = steady_study must be traction_study' "$programs/traction_study" --config "$scratch/run.csv.toml"
"$programs/stability_study" --n 6 --critical --output run.csv || fail "--critical"
good 2 "$programs/stability_study" --config run.csv.toml
cmp -s out run.csv || fail "a flag of a run that is repeated"
friction="$programs/friction_study --n 8 --creepage-ratio 0.5 --no-timing"
$friction --tractions t.csv --output run.csv && $friction --config t.csv.toml --tractions t.csv --output again.csv &&
    cmp -s run.csv again.csv || fail "the file beside --tractions"
rm -rf run.* t.csv* again.* parts own

# the runs of bench/results are taken as they stand there, here without a row
for run in "$results"/*.csv.toml; do
    (cd "$results" && "$programs/$(sed -n '1s/^# program = //p' "$run")" --config "$run" --shard 1000000/1000000) \
        >out 2>err || fail "$run cannot be repeated: $(cat err)"
done
# pictures can be repeated, too: a run or a script of gnuplot made each but the FMU's, which fmu.py made
for picture in "$results"/*.svg; do
    made=${picture%.svg}
    [ -e "$made.csv.toml" ] || [ -e "$made.gp" ] || [ "${made##*/}" = fmu_patch ] || fail "nothing draws $picture"
done

# - is a standard stream, not a file
mkdir streams
(cd streams && "$steady" --n 10 --output - | cut -d, -f1-10 >../out && "$steady" --edges - <"$scratch/edges" >../err) ||
    fail "standard streams"
"$steady" --n 10 | cut -d, -f1-10 | cmp -s - out || fail "--output -"
[ "$(wc -l <err)" -eq 2 ] || fail "--edges -"
[ -z "$(ls -A streams)" ] || fail "files in place of standard streams: $(ls -A streams)"
bad "--config = $scratch must be a file that can be read" "$steady" --config "$scratch"
bad "--edges = $scratch must be a file that can be read" "$steady" --edges "$scratch"
"$steady" --n 10 --output - >/dev/full 2>err
[ $? -eq 4 ] || fail "--output - to a full disk"

# no two files of a run are the same
mkdir names && cp "$scratch/edges" names/edges
same() { text=$1 && shift && bad "$text" sh -c 'cd ../names && exec "$@"' - "$@"; }
for name in edges ./edges "$scratch/names/edges" ../names/edges; do
    same "--output = $name must not be the same file as --edges = edges" "$steady" --edges edges --output "$name"
done
same '--plot = ./p.svg must not be the same file as --output = p.svg' "$steady" --n 10 --output p.svg --plot ./p.svg
printf 'output = "edges"\nedges = "edges"\n' >names/both.toml
same '--output = edges must not be' "$steady" --config both.toml
friction="$programs/friction_study --n 10 --creepage-ratio 0.5"
same '--tractions = t must not be the same file as --output = ./t' $friction --tractions t --output ./t
same '--tractions = - must not be the same file as standard output' $friction --tractions -
same '--tractions = o.toml must not be the same file as --output = o, written beside it,' $friction --tractions o.toml \
    --output o
printf 'n = 10\n' >names/c.csv.toml
same '--output = c.csv, written beside it, must not be the same file as --config = c.csv.toml' "$steady" \
    --config c.csv.toml --output c.csv
rm names/c.csv.toml
space="$programs/frequency_study --n 8 --omega 1 --state-space"
same '--output = space/./A.csv must not be the same file as space/A.csv, of the same run' $space space \
    --output space/./A.csv
same '--edges = - must not be the same file as --config = -' "$steady" --config - --edges -
cmp -s "$scratch/edges" names/edges && [ "$(ls names | tr '\n' ' ')" = 'both.toml edges ' ] ||
    fail "changed: $(ls names)"
good 0 $friction --config /dev/null --output /dev/null --tractions /dev/null
good 11 $friction --tractions - --output names/new
header n,creepage_ratio,x_over_a,traction
rm -rf names

finish
