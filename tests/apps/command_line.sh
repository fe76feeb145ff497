#!/bin/sh
# apps/support, seen from outside: exit codes, messages, files, shards and jobs of the steady studies.
# Usage: command_line.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
steady=$programs/steady_study
traction=$programs/traction_study

printf '%s\n' -1 -0.2 0.5 1 >"$scratch/edges"
printf '%s\n' -1 0.2 0.1 1 >"$scratch/falling"
printf '%s\n' -1 0.2 0.9 >"$scratch/short"
printf 'n = 10\nbogus = 1\n' >"$scratch/bogus.toml"

# values out of range; every message names the option, the value and what is allowed
bad '--n = 0 must be an integer in [1, 100000]' "$steady" --n 0 --output x.csv
bad '--n = -5 must be' "$steady" --n -5
bad '--n = 10.0 must be' "$steady" --n 10.0
bad '--n = 1e3 must be' "$steady" --n 1e3
bad '--n = 1 must be at least 2' "$steady" --n 1
bad '--n = 1 must be at least 2 with --method knothe-bc' "$steady" --n 1 --method knothe-bc
bad '--n = 2 must be at least 3 with --mesh knothe' "$steady" --n 10,2 --mesh knothe
bad '--n = 1 must be at least 2 with --mesh geometric' "$steady" --n 1 --alpha 0.5 --mesh geometric
bad "--n = '' must be a list without empty items" "$steady" --n ''
bad '--n = 10, must be a list without empty items' "$steady" --n 10,
bad 'repeated items: 10' "$steady" --n 10,20,10
bad 'repeated items: 20' "$steady" --n 10,20 --n 20
bad 'repeated items: 0.50' "$steady" --alpha-T 0.5,0.50
bad '--alpha = nan must lie in [-2, 2]' "$steady" --alpha nan
bad '--alpha-L = 2.5 must lie in [-2, 2]' "$steady" --alpha-L 2.5
bad '--alpha-T = inf must lie in [-2, 2]' "$steady" --alpha-T inf
bad '--alpha-T = 0.5x must be a number' "$steady" --alpha-T 0.5x
bad '--poisson = 0.7 must lie in [0, 0.5]' "$steady" --poisson 0.7 --output x.csv --plot x.svg
bad '--aspect = -1 must be positive' "$steady" --aspect -1
bad '--aspect = nan must be positive' "$steady" --aspect nan
bad '--epsilon = 0 must lie in' "$steady" --mesh knothe --epsilon 0
bad '--epsilon = 0 must lie in' "$steady" --epsilon 0
bad '--size-ratio = -2 must lie in' "$steady" --mesh geometric --size-ratio -2
bad '--quadrature = 0 must be an integer in [1, 1000]' "$steady" --method galerkin --quadrature 0
bad '--mesh = foo must be one of uniform, geometric, knothe, modified-knothe, cosine' "$steady" --mesh foo
bad '--mesh = uniform,cosine must be a single value' "$steady" --mesh uniform --mesh cosine
bad '--method = foo must be one of' "$steady" --method foo
bad '--kernel = foo must be one of' "$steady" --kernel foo
bad '--derivative = foo must be one of' "$steady" --derivative foo
bad '--jobs = 0 must be an integer in [1, 1024]' "$steady" --jobs 0 --output x.csv
bad '--shard = 4/3 must be K/N' "$steady" --shard 4/3 --output x.csv
bad '--shard = 1/ must be K/N' "$steady" --shard 1/
bad '--plot = x.pdf must end in .svg or .png' "$steady" --plot x.pdf --output x.csv
bad '--quiet = 3 must be true or false' "$steady" --quiet=3
bad '--foo' "$steady" --foo
bad 'foo' "$steady" foo
bad '--n' "$steady" --n
# an option without its value does not take the next one for it
bad "--output = '' must not be empty" "$steady" --output= --quiet
bad "--n = '' must not be empty" "$steady" --n= 20
bad '--output must have a value: --quiet is another option' "$steady" --output --quiet
bad '--alphaT is not an option; did you mean --alpha-T?' "$steady" --alphaT 0.5
bad '--alphal is not an option; did you mean --alpha-L?' "$steady" --alphal 0.5
bad '--sizeratio is not an option; did you mean --size-ratio?' "$steady" --sizeratio 2
bad '--alpha-t is not an option; did you mean --alpha-T?; see --help' "$steady" --alpha-t 0.5
bad '--alpah-T is not an option; did you mean --alpha-T?; see' "$steady" --alpah-T=0.5
bad '-n is not an option; did you mean --n?' "$steady" -n 20
bad '--quad is not an option; did you mean --quadrature?' "$steady" --quad 3
bad '--zzzzzz is not an option; see --help' "$steady" --zzzzzz -0.5
bad '--mehs is not an option; did you mean --mesh?; --oytput is not an option; did you mean --output?' \
    "$steady" --mehs cosine --oytput x.csv
bad 'foo bar was not expected' "$steady" foo bar
bad '--mesh = \x1B[1m must be one of' "$steady" --mesh "$(printf '\033[1m')"

# options that would be ignored
bad '--epsilon = 0.5 has no effect with --mesh uniform; it is for --mesh knothe and modified-knothe' "$steady" --epsilon 0.5
bad '--size-ratio = 2 has no effect with --mesh cosine; it is for --mesh geometric' "$steady" --mesh cosine --size-ratio 2
bad '--quadrature = 3 has no effect with --method collocation' "$steady" --quadrature 3
bad '--alpha-T = 0.5 has no effect with --alpha' "$steady" --alpha 0.5 --alpha-T 0.5
bad '--alpha-T = 0.5 has no effect with --method knothe-bc' "$steady" --method knothe-bc --alpha-T 0.5
for option in alpha-L=0 alpha-T=0.5 alpha=0.5 derivative=fd quadrature=3; do
    bad "--${option%=*} = ${option#*=} has no effect with --method nodes" "$steady" --method nodes --$option
done
bad '--nodes = centres has no effect with --method collocation' "$steady" --nodes centres
bad '--nodes = edges must be one of centres, chebyshev' "$steady" --method nodes --nodes edges
bad '--nodes = chebyshev must be centres unless --mesh is cosine' "$steady" --method nodes --nodes chebyshev
bad '--lambda = 0.4' "$steady" --lambda 0.4
bad '--n = 10 has no effect with --edges' "$steady" --edges "$scratch/edges" --n 10
bad '--mesh = uniform has no effect with --edges' "$steady" --edges "$scratch/edges" --mesh uniform

# files
bad 'line 3 = 0.1 must be larger' "$steady" --edges "$scratch/falling"
bad 'must end with 1' "$steady" --edges "$scratch/short"
bad 'must be a file that can be read' "$steady" --edges "$scratch/none"
bad 'must be a file that can be read' "$steady" --config "$scratch/none.toml"
bad 'bogus' "$steady" --config "$scratch/bogus.toml"
bad '--output = /nonexistent/x.csv must be a file that can be written' "$steady" --output /nonexistent/x.csv
bad '--output = . must be a file that can be written' "$steady" --output .
bad "--output = '' must not be empty" "$steady" --output ''
bad '--plot = /nonexistent/x.svg must be a file that can be written' "$steady" --output x.csv --plot /nonexistent/x.svg
if [ "$(id -u)" -ne 0 ]; then
    mkdir locked && chmod 555 locked
    bad 'must be a file that can be written' "$steady" --output "$scratch/locked/x.csv"
fi

# --help and --version
good 7 "$steady"
good 2 "$steady" --n 1 --alpha 0.5
good 4 "$steady" --n 5 --n 6,7
good 3 "$steady" --n 10 --alpha-T ' 0.5, 0.6'
good 2 "$steady" --n 10 --alpha-T -0.2
good 2 "$steady" --n 10 --aspect inf
good 2 "$steady" --edges "$scratch/edges"
for mesh in uniform geometric knothe modified-knothe cosine; do
    for method in collocation galerkin knothe-bc nodes; do
        good 2 "$steady" --n 12 --mesh $mesh --method $method
    done
done
good 2 "$steady" --n 12 --method galerkin --quadrature 7 --derivative analytic --kernel plane
"$steady" --help | grep -q 'Example' || fail "--help has no example"
"$steady" --version | grep -q '^steady_study [0-9]' || fail "--version"

good 2 "$steady" --n 40 --mesh cosine --kernel plane --method nodes --nodes chebyshev
check 'nodes' '$method == "nodes" && $derivative $alpha_L $alpha_T $quadrature == "" && $nodes == "chebyshev" && ($relative_error / 1.908e-4 - 1) ^ 2 < 1e-6'

# everything that is varied has a column, and every empty cell a reason
good 9 "$steady" --n 12 --mesh knothe --epsilon 0.3,0.4 --aspect 10,inf --poisson 0.1,0.2 --alpha 0.5
[ "$(head -n 1 out | cut -d, -f15-)" = status,kernel,aspect,poisson,size_ratio,epsilon,quadrature,nodes ] || fail "settings"
check 'settings of a steady row' '$status == "ok" && $kernel == ($aspect == "inf" ? "plane" : "strip") && $size_ratio == "" && $quadrature == ""'
[ "$(tail -n +2 out | cut -d, -f17,18,20 | tr '\n' ' ')" = "10,0.1,0.3 10,0.2,0.3 inf,0.1,0.3 inf,0.2,0.3 \
10,0.1,0.4 10,0.2,0.4 inf,0.1,0.4 inf,0.2,0.4 " ] || fail "order of settings"
check 'each Poisson ratio has its own exact value' '($c11_exact * (1 - $poisson) - 1.5707963267948966) ^ 2 < 1e-28'
[ "$(cut -d, -f7 out | sort -u | wc -l)" -eq 9 ] || fail "settings that make no difference"
good 3 "$steady" --n 12 --mesh geometric --size-ratio 2,3
check 'size ratio' '$size_ratio == NR && $epsilon == ""'
good 2 "$steady" --n 12 --method galerkin --quadrature 7
check 'quadrature' '$quadrature == 7'
good 3 "$steady" --n 4,8 --method chebyshev --aspect 1
check 'settings of states' '$status == ($n == 4 ? "not_converged" : "ok") && $kernel == "strip" && $aspect == 1 && $size_ratio $epsilon $quadrature == ""'
good 2 "$steady" --n 3 --alpha-T 0.1
check 'far off with few elements' '$status == "coarse" && $c11 $relative_error == ""'
good 2 "$steady" --n 3 --alpha-T 0.1 --aspect 1
check 'the plane limit says nothing about a narrow strip' '$status != "coarse"'
for case in '40 0 assists_creepage' '41 0 ill_conditioned' '40 1.5 assists_creepage'; do
    set -- $case
    good 2 "$steady" --n $1 --alpha $2
    check "status of alpha = $2" '$status == "'$3'" && $c11 == ""'
    good $(($1 + 1)) "$traction" --n $1 --alpha $2
    check "status of tractions at alpha = $2" '$status == "'$3'" && $traction == "" && $relative_error == ""'
done
good 21 "$traction" --n 20 --method galerkin
check 'settings of tractions' '$status == "ok" && $method == "galerkin" && $derivative == "analytic" && $mesh == "uniform" && $quadrature == "exact"'
bad '--epsilon = 0.4 has no effect' "$steady" --epsilon 0.4
bad 'repeated items: 100' "$steady" --aspect 100,100
bad '--aspect = -1 must be positive' "$steady" --aspect 1,-1
bad '--aspect = 1,0.0001 must be at least 0.001' "$steady" --method chebyshev --aspect 1,0.0001
"$steady" --n 8,9 --aspect 1,10 --poisson 0,0.5 --no-timing >whole
for shard in 1 2 3; do "$steady" --n 8,9 --aspect 1,10 --poisson 0,0.5 --no-timing --shard $shard/3; done | cmp -s - whole ||
    fail "shards of settings"

# order of rows: n, then alpha_L, then alpha_T
"$steady" --n 20,10 --alpha-L 0,0.1 --alpha-T 0.6,0.5 >out
[ "$(cut -d, -f4-6 out | tail -n +2 | tr '\n' ' ')" = "20,0,0.6 20,0,0.5 20,0.1,0.6 20,0.1,0.5 \
10,0,0.6 10,0,0.5 10,0.1,0.6 10,0.1,0.5 " ] || fail "order of rows"

# c11 itself: within 1e-4 of Carter's at n = 20
"$steady" --n 20 --aspect inf --poisson 0.25 | awk -F, '
    NR == 2 && $10 < -3.0e-5 && $10 > -3.2e-5 && $7 / $8 - 1 - $10 < 1e-12 { ok = 1 } END { exit !ok }' ||
    fail "relative error at n = 20"

# jobs and shards do not change the rows
"$steady" --n 5,10,15 --alpha-T 0.5,0.6,0.63 | cut -d, -f1-11 >one
"$steady" --n 5,10,15 --alpha-T 0.5,0.6,0.63 --jobs 3 >three
cut -d, -f1-11 three | cmp -s - one || fail "rows depend on --jobs"
[ "$(cut -d, -f12,13 three | tail -n +2 | sort -u)" = , ] || fail "times with --jobs 3"
"$steady" --n 5,10,15 --alpha-T 0.5,0.6,0.63 --no-timing | cmp -s - three || fail "times with --no-timing"
for shard in 1 2 3 4 5; do "$steady" --n 5,10,15 --alpha-T 0.5,0.6,0.63 --jobs 2 --shard $shard/5; done >parts
cmp -s parts three || fail "shards of steady_study do not concatenate"
"$traction" --n 7,20 >whole
for shard in 1 2 3 4; do "$traction" --n 7,20 --jobs 2 --shard $shard/4; done >parts
cmp -s parts whole || fail "shards of traction_study do not concatenate"
for shard in 1 2 3; do "$traction" --n 2 --shard $shard/3; done | wc -l | grep -qw 3 || fail "more shards than rows"
[ "$("$traction" --n 5 --method knothe-bc | tail -n 1 | cut -d, -f3)" = 0 ] || fail "knothe-bc: leading element"

# files appear whole with their companion, and replace older ones; a link stays a link
echo old >real.csv && ln -s real.csv link.csv
"$steady" --n 10 --output link.csv || fail "--output link.csv"
[ -h link.csv ] && [ "$(wc -l <real.csv)" -eq 2 ] || fail "link as output"
grep -q '^command_line = ".*--n 10 --output link.csv"$' link.csv.toml || fail "companion file"
if command -v python3 >/dev/null && python3 -c 'import tomllib' 2>/dev/null; then
    "$steady" --n 10 --output "$(printf 'q"\\\001.csv')" || fail "odd file name"
    cat ./q*.toml | python3 -c 'import sys, tomllib; tomllib.loads(sys.stdin.buffer.read().decode())' || fail "TOML"
    rm -f ./q*
fi
if shared=$(mktemp /dev/shm/rollbem-XXXXXX 2>/dev/null); then
    "$steady" --n 10 --output "$shared" && [ "$(wc -l <"$shared")" -eq 2 ] && [ -e "$shared.toml" ] ||
        fail "a file below /dev that is there"
    rm -f "$shared" "$shared.toml"
fi
[ -z "$(find . -name '*.part')" ] || fail "temporary files are left"

# errors while writing
for sink in '> /dev/full' '--output /dev/full' '| true' '| true --jobs 2'; do
    case $sink in
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

# a read-only file system, also for root
bad 'must be a file that can be written' "$steady" --output /sys/x.csv
bad 'must be a file that can be written' "$steady" --n 10 --output x.csv --plot /sys/x.svg

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
