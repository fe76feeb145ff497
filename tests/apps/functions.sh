# What the scripts of this folder share; to be sourced by them with a folder of programs as $1.
# Creates an empty folder to work in, which is removed at the end, and counts failures.
set -u
programs=$(cd "$1" && pwd) || exit 1
scratch=$(mktemp -d) || exit 1
trap 'chmod -R u+w "$scratch"; rm -rf "$scratch"' EXIT
cd "$scratch" || exit 1
mkdir work
failures=0

fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

# bad TEXT PROGRAM ARG...: bad input: exit 2, one line with TEXT on stderr, nothing on stdout, no file in the folder
# work. Starts no other process, as there are hundreds of these.
bad() {
    text=$1
    shift
    (cd work && exec "$@" >../out 2>../err </dev/null)
    code=$?
    [ $code -eq 2 ] || fail "exit $code instead of 2: $*"
    { IFS= read -r said && ! IFS= read -r more && [ -z "$more" ]; } <err || fail "not one line on stderr: $*"
    case $said in
    *"$text"*) ;;
    *) fail "no '$text' in '$(cat err)': $*" ;;
    esac
    [ ! -s out ] || fail "something on stdout: $*"
    for file in work/* work/.[!.]*; do
        if [ -e "$file" ] || [ -h "$file" ]; then fail "a file is left: $file: $*" && rm -rf "$file"; fi
    done
}

# good LINES PROGRAM ARG...: exit 0, this number of lines in the file out, nothing on stderr.
good() {
    lines=$1
    shift
    "$@" >out 2>err </dev/null
    code=$?
    [ $code -eq 0 ] || fail "exit $code instead of 0: $*: $(cat err)"
    [ "$(wc -l <out)" -eq "$lines" ] || fail "$(wc -l <out) lines instead of $lines: $*"
    [ ! -s err ] || fail "something on stderr: $*"
}

# ends_early LINES TEXT PROGRAM ARG...: exit 1, this number of lines in the file out, one line with TEXT on stderr.
ends_early() {
    lines=$1
    text=$2
    shift 2
    "$@" >out 2>err </dev/null
    code=$?
    [ $code -eq 1 ] || fail "exit $code instead of 1: $*: $(cat err)"
    [ "$(wc -l <out)" -eq "$lines" ] || fail "$(wc -l <out) lines instead of $lines: $*"
    [ "$(wc -l <err)" -eq 1 ] && grep -qF -e "$text" err || fail "no single line with '$text' in '$(cat err)': $*"
}

# rows ARG... FILE: awk on tables with the columns of FILE, each of which is a variable with its number: $status is the
# cell of that name.
rows() {
    for table; do :; done
    IFS= read -r names <"$table"
    variables=
    number=0
    while [ -n "$names" ]; do
        number=$((number + 1))
        variables="$variables -v ${names%%,*}=$number"
        case $names in
        *,*) names=${names#*,} ;;
        *) names= ;;
        esac
    done
    awk -F, $variables "$@"
}

# check WHAT CONDITION: an expression of rows that must hold in every row of the file out.
check() { rows "NR > 1 && !($2) { bad = 1 } END { exit bad || NR < 2 }" out || fail "$1: $(cat out)"; }

# column NAME: its number in the file out.
column() { head -n 1 out | tr ',' '\n' | grep -nx "$1" | cut -d: -f1; }

# header NAMES: the first columns of the file out.
header() {
    case $(head -n 1 out) in
    "$1" | "$1",*) ;;
    *) fail "columns $(head -n 1 out)" ;;
    esac
}

# shards PROGRAM ARG...: 4 shards concatenate to the whole, whatever the number of jobs.
shards() {
    "$@" --jobs 3 >whole
    for k in 1 2 3 4; do "$@" --jobs 2 --shard $k/4; done >parts
    cmp -s whole parts || fail "shards or jobs change rows: $*"
}

# orders NAME PROGRAM ARG...: at the end of the run, halving --dq shows second order with sdirk2 and first with
# implicit-euler.
orders() {
    column=$1
    shift
    for integrator in sdirk2 implicit-euler; do
        for dq in 0.2 0.1 0.0125; do
            "$@" --dq $dq --integrator $integrator >out
            tail -n 1 out | cut -d, -f"$(column "$column")"
        done | awk -v order=$integrator '{ f[NR] = $1 } END { ratio = (f[1] - f[3]) / (f[2] - f[3])
            exit !(order == "sdirk2" ? ratio > 3.4 && ratio < 4.8 : ratio > 1.8 && ratio < 2.4) }' ||
            fail "order of $integrator: $*"
    done
}

# The last line of each script.
finish() {
    [ $failures -eq 0 ] || exit 1
    echo "all checks passed"
}
