#!/bin/sh
# apps/support, seen from outside: files, times, and errors while writing.
# Usage: command_line.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
steady=$programs/steady_study
traction=$programs/traction_study

if [ "$(id -u)" -ne 0 ]; then
    mkdir locked && chmod 555 locked
    bad 'must be a file that can be written' "$steady" --output "$scratch/locked/x.csv"
    mkdir hidden && chmod 000 hidden
    bad 'must be a file that can be written' "$steady" --output "$scratch/hidden/x.csv"
    bad 'must be a folder that can be written' "$programs/frequency_study" --n 8 --state-space "$scratch/hidden/x"
    chmod 700 hidden
fi

# --help and --version
"$steady" --help | grep -q 'Example' || fail "--help has no example"
"$steady" --version | grep -q '^steady_study [0-9]' || fail "--version"

# order of rows: n, then alpha_L, then alpha_T
"$steady" --n 20,10 --alpha-L 0,0.1 --alpha-T 0.6,0.5 >out
[ "$(cut -d, -f4-6 out | tail -n +2 | tr '\n' ' ')" = "20,0,0.6 20,0,0.5 20,0.1,0.6 20,0.1,0.5 \
10,0,0.6 10,0,0.5 10,0.1,0.6 10,0.1,0.5 " ] || fail "order of rows"

# jobs and shards do not change the rows
"$steady" --n 5,10,15 --alpha-T 0.5,0.6,0.63 | cut -d, -f1-11 >one
"$steady" --n 5,10,15 --alpha-T 0.5,0.6,0.63 --jobs 3 >three
cut -d, -f1-11 three | cmp -s - one || fail "rows depend on --jobs"
[ "$(cut -d, -f12,13 three | tail -n +2 | sort -u)" = , ] || fail "times with --jobs 3"
"$steady" --n 5,10,15 --alpha-T 0.5,0.6,0.63 --no-timing | cmp -s - three || fail "times with --no-timing"
for shard in 1 2 3; do "$traction" --n 2 --shard $shard/3; done | wc -l | grep -qw 3 || fail "more shards than rows"
[ "$("$traction" --n 5 --method knothe-bc | tail -n 1 | cut -d, -f3)" = 0 ] || fail "knothe-bc: leading element"

# files appear whole with their companion, and replace older ones; a link stays a link
echo old >real.csv && ln -s real.csv link.csv
"$steady" --n 10 --output link.csv || fail "--output link.csv"
[ -h link.csv ] && [ "$(wc -l <real.csv)" -eq 2 ] || fail "link as output"
grep -q '^# command_line = .*--n 10 --output link.csv$' link.csv.toml || fail "companion file"
[ -z "$(find . -name '*.part')" ] || fail "temporary files are left"

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
[ "$(wc -l <both.csv)" -eq 2 ] && grep -q 'n = "40"' both.csv.toml || fail "the file of the second run"
"$steady" --config both.csv.toml | cmp -s - both.csv || fail "the second run is not repeated"
kill -INT $first
cat held.svg >out
wait $first
[ $? -eq 3 ] && grep -q gnuplot err || fail "the first run on a file: $(cat err)"
[ "$(cut -d, -f4 both.csv | tr '\n' ' ')" = "n 10 20 30 " ] &&
    [ "$(tr -d '\000' <both.csv | wc -c)" -eq "$(wc -c <both.csv)" ] ||
    fail "the file of the first run: $(cat both.csv)"
grep -q 'n = "10,20,30"' both.csv.toml && [ "$(ls -d both* | tr '\n' ' ')" = 'both.csv both.csv.toml ' ] ||
    fail "two runs leave $(ls -d both*)"

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
rm held.svg

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
    rm full
fi

# errors while writing
for sink in '> /dev/full' '--output /dev/full' '| true' '| true --jobs 2' --recommend; do
    case $sink in
    --recommend) "$programs/precision_study" --recommend 1e-4 >/dev/full 2>err; echo $? >code ;;
    '| true'*) { { "$steady" --n 200,201,202 ${sink#| true} 2>err; echo $? >code; } | true; } ;;
    '> /dev/full') "$steady" --n 10 >/dev/full 2>err; echo $? >code ;;
    *) "$steady" --n 10 --output /dev/full 2>err; echo $? >code ;;
    esac
    [ "$(cat code)" = 4 ] || fail "exit $(cat code) instead of 4: $sink"
    [ "$(wc -l <err)" -eq 1 ] || fail "not one line on stderr: $sink"
done
[ -c /dev/full ] && [ ! -e /dev/full.toml ] || fail "/dev/full is not what it was"
mkfifo pipe
cat pipe >through &
"$steady" --n 10 --output pipe || fail "a pipe as output"
wait
[ -p pipe ] && [ "$(wc -l <through)" -eq 2 ] && [ ! -e pipe.toml ] || fail "rows through a pipe"

# a full disk: the older file stays, whether the rows or the companion do not fit
for arguments in '--n 10' '--n 10,20,30,40,50,60,70,80 --alpha-T 0.5,0.6,0.63'; do
    echo old >full.csv
    (ulimit -f 1 && "$steady" $arguments --output full.csv 2>err)
    [ $? -eq 4 ] || fail "exit code with a full disk: $arguments"
    [ "$(wc -l <err)" -eq 1 ] || fail "not one line on stderr with a full disk: $(cat err)"
    [ "$(cat full.csv)" = old ] && [ "$(ls -d full*)" = full.csv ] || fail "a full disk leaves $(ls -d full*)"
done
ln -s /dev/full full.csv.toml
"$steady" --n 10 --output full.csv 2>err
[ $? -eq 4 ] && [ "$(cat full.csv)" = old ] && [ -h full.csv.toml ] || fail "a companion that cannot be written"

# plots: without gnuplot the rows are still written
PATH=/nonexistent "$steady" --n 10,20 --output rows.csv --plot rows.svg 2>err
code=$?
[ $code -eq 3 ] && grep -q gnuplot err && [ "$(wc -l <err)" -eq 1 ] || fail "exit $code instead of 3 without gnuplot"
[ "$(wc -l <rows.csv)" -eq 3 ] && [ ! -e rows.svg ] || fail "files without gnuplot"
# a gnuplot that is killed, fails, draws nothing or only a part, or reads nothing: the older plot stays
mkdir bin
for end in 'kill -KILL $$' 'cat >/dev/null; echo half; exit 1' 'exec 0<&-; exit 0' 'cat >/dev/null' \
    'cat >/dev/null; echo "<svg>"'; do
    printf '#!/bin/sh\n%s\n' "$end" >bin/gnuplot && chmod +x bin/gnuplot
    rm -f rows.csv && echo old >rows.svg
    PATH=$scratch/bin:$PATH "$steady" --n 10,20 --output rows.csv --plot rows.svg 2>err
    code=$?
    [ $code -eq 3 ] && grep -q gnuplot err && [ "$(wc -l <err)" -eq 1 ] || fail "exit $code, $(cat err) with: $end"
    [ "$(wc -l <rows.csv)" -eq 3 ] && [ "$(cat rows.svg)" = old ] || fail "files with: $end"
done
[ -z "$(find . -name '*.part')" ] || fail "temporary files are left by plots"
if command -v gnuplot >/dev/null; then
    "$steady" --n 10,20 --alpha-T 0.5,0.63 --plot steady.svg >out 2>err || fail "steady plot: $(cat err)"
    grep -q '</svg>' steady.svg || fail "steady.svg is not whole"
    "$traction" --n 10,20 --plot traction.png >out 2>err || fail "traction plot: $(cat err)"
    [ "$(head -c 4 traction.png | tail -c 3)" = PNG ] || fail "traction.png is no PNG"
    # a disk that is full, if only for the plot: the older one stays
    ln -s /dev/full full.svg
    for picture in full.svg cut.svg cut.png; do
        [ -h $picture ] || echo old >$picture
        (ulimit -f 8 && "$steady" --n 10,20 --plot $picture >out 2>err)
        [ $? -eq 4 ] && grep -q "$picture cannot be written" err && [ "$(wc -l <err)" -eq 1 ] ||
            fail "a full disk under $picture: $(cat err)"
        [ "$(wc -l <out)" -eq 3 ] || fail "rows with a full disk under $picture"
        [ -h $picture ] || [ "$(cat $picture)" = old ] || fail "a full disk cuts $picture"
    done
    mkfifo pipe.svg
    cat pipe.svg >through &
    "$steady" --n 10,20 --plot pipe.svg >out || fail "a plot through a pipe"
    wait
    grep -q '</svg>' through && [ -p pipe.svg ] || fail "a plot through a pipe is not whole"
fi
[ -z "$(find . -name '*.part')" ] || fail "temporary files are left by plots that failed"

finish
