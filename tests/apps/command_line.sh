#!/bin/sh
# apps/support, seen from outside: help, files, and errors while writing.
# Usage: command_line.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
steady=$programs/steady_study
traction=$programs/traction_study

if [ "$(id -u)" -ne 0 ]; then
    mkdir locked hidden && chmod 555 locked && chmod 000 hidden
    bad 'must be a file that can be written' "$steady" --output "$scratch/locked/x.csv"
    bad 'must be a file that can be written' "$steady" --output "$scratch/hidden/x.csv"
    bad 'must be a folder that can be written' "$programs/frequency_study" --n 8 --state-space "$scratch/hidden/x"
    chmod 700 hidden
fi

"$steady" --help | grep -q 'Example' || fail "--help has no example"
"$steady" --version | grep -q '^steady_study [0-9]' || fail "--version"

# files appear whole with their companion, and replace older ones; a link stays a link
echo old >real.csv && ln -s real.csv link.csv
"$steady" --n 10 --output link.csv || fail "--output link.csv"
[ -h link.csv ] && [ "$(wc -l <real.csv)" -eq 2 ] || fail "link as output"
grep -q '^# command_line = .*--n 10 --output link.csv$' link.csv.toml || fail "companion file"

# two runs on one file: the last to finish wins whole. The first has opened its files and waits for a reader of its
# plot; as the shell starts it in the background, interrupts are ignored
mkfifo held.svg
opened() {
    tries=0
    until [ -n "$(find . -name "$1.*.part")" ]; do
        [ $((tries += 1)) -lt 1000 ] || { fail "$1 is not opened" && return; }
        sleep 0.01
    done
}
PATH=/nonexistent "$steady" --n 10,20,30 --output both.csv --plot held.svg 2>err &
first=$!
opened both.csv
"$steady" --n 40 --output both.csv --no-timing || fail "the second run on a file"
[ "$(wc -l <both.csv)" -eq 2 ] && "$steady" --config both.csv.toml | cmp -s - both.csv ||
    fail "the second run is not repeated"
kill -INT $first
cat held.svg >out
wait $first
[ $? -eq 3 ] && grep -q gnuplot err || fail "the first run on a file: $(cat err)"
[ "$(cut -d, -f4 both.csv | tr '\n' ' ')" = "n 10 20 30 " ] && grep -q 'n = "10,20,30"' both.csv.toml &&
    [ "$(tr -d '\000' <both.csv | wc -c)" -eq "$(wc -c <both.csv)" ] || fail "the first run: $(cat both.csv)"
[ "$(ls -d both* | tr '\n' ' ')" = 'both.csv both.csv.toml ' ] || fail "two runs leave $(ls -d both*)"

# an interrupt leaves nothing, not even a folder
for signal in INT:130 TERM:143 HUP:129; do
    folder=${signal%:*}
    mkdir $folder
    (opened $folder.csv && kill -$folder "$(cat pid)") &
    sh -c 'echo $$ >pid && exec "$@"' - "$programs/frequency_study" --n 8 --omega 1 --output $folder/$folder.csv \
        --state-space $folder/new/space --plot held.svg >out 2>err
    code=$?
    wait
    [ $code -eq ${signal#*:} ] || fail "exit $code after $signal"
    [ -z "$(ls -A $folder)" ] && ! grep frequency_study err || fail "$signal leaves $(ls -AR $folder): $(cat err)"
done

# on a terminal a line shows how long a row takes; here one that is not taken out of a full pipe
if command -v script >/dev/null; then
    mkfifo full
    for arguments in '' --quiet; do
        sleep 0.8 <full &
        script -qec "$traction --n 2000 --output full $arguments" /dev/null </dev/null >out
        wait
        grep -q 'traction_study: [0-9]* of 2000 rows, n = 2000, 1 s' out
        [ $? -eq $([ -z "$arguments" ]; echo $?) ] || fail "the line of progress with '$arguments': $(cat out)"
    done
fi

# on a terminal people have a table, no wider than it and counting what it leaves out, unless they ask for CSV
on_terminal() { script -qec "stty cols 80; $programs/$* --quiet" /dev/null </dev/null | tr -d '\r'; }
while command -v script >/dev/null && read -r command; do
    "$programs"/$command >out
    for csv in --csv '--output -'; do
        on_terminal $command $csv | cmp -s - out || fail "$command $csv on a terminal"
    done
    on_terminal $command >table
    awk -v rows="$(($(wc -l <out) - 1))" '
        /[^ ],[^ ]/ || length > 80 { bad = 1 }
        END { exit bad || NR < 3 || !/more (column|row)s?(, [0-9]+ more columns?)? in CSV: --output FILE$/ ||
            (rows > 40) != /^[0-9]+ more rows?[ ,]/ || rows > 40 && $1 != rows - 40 }' table ||
        fail "$command on a terminal: $(cat table)"
done <<'COMMANDS'
steady_study --n 10,20 --no-timing
traction_study --n 41 --no-timing
stability_study --n 10 --no-timing
frequency_study --n 10 --omega 1 --no-timing
transient_study --n 8 --step 1 --no-timing
friction_study --n 10 --creepage-ratio 0.5,0.6 --no-timing
patch_study --n 4 --longitudinal 0.1 --no-timing
precision_study --n 4,6 --quantity c11 --no-timing
profile_study --shift 0,0.001 --no-timing
extremes_study --patches 3
COMMANDS
if command -v script >/dev/null; then
    on_terminal profile_study --shift 0.0055 --friction 0.3 >table
    [ "$(grep -c '^shift 5.5 mm, yaw 0 rad, .*, side right, patch [12], status ' table)" -eq 2 ] &&
        [ "$(grep -cE '^  (load|lateral_force) +-?[0-9.]+ N$' table)" -eq 4 ] &&
        [ "$(grep -cE '^  peak_pressure +[0-9]{3,4}(\.[0-9]+)? MPa$' table)" -eq 2 ] || fail "patch by patch: $(cat table)"
fi

# errors while writing. full LINES PROGRAM ARG...: exit 4, one line on stderr, this number of lines on stdout
full() {
    exits 4 "$@"
    [ "$(wc -l <err)" -eq 1 ] || fail "not one line on stderr: $*: $(cat err)"
}
for command in "$steady --n 10" "$steady --n 10 --output /dev/full" "$programs/precision_study --recommend 1e-4"; do
    full 0 sh -c "$command >/dev/full"
done
# a reader that has enough is no error, and ends a run that writes nothing else
unread() { good 0 sh -c "{ $*; echo \$? >code; } | true; exit \$(cat code)"; }
for jobs in 1 2; do unread "$steady" --n 200,201,202 --jobs $jobs; done
unread "$programs/friction_study" --n 10,12 --creepage-ratio 0.5 --tractions unread.csv
[ "$(wc -l <unread.csv)" -eq 23 ] || fail "a pipe that is not read cuts --tractions"
unread "$steady" --help
[ -c /dev/full ] && [ ! -e /dev/full.toml ] || fail "/dev/full is not what it was"
mkfifo pipe
cat pipe >through &
"$steady" --n 10 --output pipe || fail "a pipe as output"
wait
[ -p pipe ] && [ "$(wc -l <through)" -eq 2 ] && [ ! -e pipe.toml ] || fail "rows through a pipe"
# a full disk: the older file stays, whether the rows or the companion do not fit
for arguments in '--n 10' '--n 10,20,30,40,50,60,70,80 --alpha-T 0.5,0.6,0.63'; do
    echo old >full.csv
    full 0 sh -c "ulimit -f 1; $steady $arguments --output full.csv"
    [ "$(cat full.csv)" = old ] && [ "$(ls -d full.*)" = full.csv ] || fail "a full disk leaves $(ls -d full.*)"
done
full 0 sh -c "ulimit -f 1; $programs/friction_study --n 20 --creepage-ratio 0.5 --output /dev/null --tractions full.csv"
[ "$(cat full.csv)" = old ] || fail 'a full disk cuts the tractions'
ln -s /dev/full full.csv.toml
full 0 "$steady" --n 10 --output full.csv
[ "$(cat full.csv)" = old ] && [ -h full.csv.toml ] || fail "a companion that cannot be written"

# plots: without gnuplot the rows are still written; where gnuplot is killed, fails, draws nothing or only a part, or
# reads nothing, the older plot stays, too
mkdir bin
for end in missing 'kill -KILL $$' 'cat >/dev/null; echo half; exit 1' 'exec 0<&-; exit 0' 'cat >/dev/null' \
    'cat >/dev/null; echo "<svg>"'; do
    [ "$end" = missing ] || { printf '#!/bin/sh\n%s\n' "$end" >bin/gnuplot && chmod +x bin/gnuplot; }
    rm -f rows.csv && echo old >rows.svg
    path=$PATH
    PATH=$scratch/bin:$([ "$end" = missing ] || echo "$path")
    "$steady" --n 10,20 --output rows.csv --plot rows.svg 2>err
    code=$?
    PATH=$path
    [ $code -eq 3 ] && grep -q gnuplot err && [ "$(wc -l <err)" -eq 1 ] || fail "exit $code, $(cat err) with: $end"
    [ "$(wc -l <rows.csv)" -eq 3 ] && [ "$(cat rows.svg)" = old ] || fail "files with: $end"
done
if command -v gnuplot >/dev/null; then
    "$traction" --n 10,20 --plot traction.png >out 2>err || fail "traction plot: $(cat err)"
    [ "$(head -c 4 traction.png | tail -c 3)" = PNG ] || fail "traction.png is no PNG"
    # a disk that is full, if only for the plot: the older one stays
    ln -s /dev/full full.svg
    for picture in full.svg cut.svg cut.png; do
        [ -h $picture ] || echo old >$picture
        full 3 sh -c "ulimit -f 8; $steady --n 10,20 --plot $picture"
        grep -q "$picture cannot be written" err || fail "a full disk under $picture: $(cat err)"
        [ -h $picture ] || [ "$(cat $picture)" = old ] || fail "a full disk cuts $picture"
    done
    mkfifo pipe.svg
    cat pipe.svg >through &
    "$steady" --n 10,20 --plot pipe.svg >out || fail "a plot through a pipe"
    wait
    grep -q '</svg>' through && [ -p pipe.svg ] || fail "a plot through a pipe is not whole"
fi
[ -z "$(find . -name '*.part')" ] || fail "temporary files are left: $(find . -name '*.part')"

finish
