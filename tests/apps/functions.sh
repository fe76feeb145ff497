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

# exits CODE LINES PROGRAM ARG...: this exit code, and this number of lines in the file out.
exits() {
    expected=$1 lines=$2
    shift 2
    "$@" >out 2>err </dev/null
    code=$?
    [ $code -eq "$expected" ] || fail "exit $code instead of $expected: $*: $(cat err)"
    [ "$(wc -l <out)" -eq "$lines" ] || fail "$(wc -l <out) lines instead of $lines: $*"
}

# good LINES PROGRAM ARG...: exit 0, this number of lines in the file out, nothing on stderr.
good() {
    exits 0 "$@"
    [ ! -s err ] || fail "something on stderr: $*"
}

# complains TEXT: one line with TEXT in the file err. Starts no other process, as there are hundreds of these.
complains() {
    { IFS= read -r said && ! IFS= read -r more && [ -z "$more" ]; } <err || fail "not one line on stderr: $(cat err)"
    case $said in
    *"$1"*) ;;
    *) fail "no '$1' in '$(cat err)'" ;;
    esac
}

# bad TEXT PROGRAM ARG...: bad input: exit 2, one line with TEXT on stderr, nothing on stdout, no file in the folder
# work.
bad() {
    text=$1
    shift
    (cd work && exec "$@" >../out 2>../err </dev/null)
    code=$?
    [ $code -eq 2 ] && [ ! -s out ] || fail "exit $code instead of 2, or something on stdout: $*"
    complains "$text"
    for file in work/* work/.[!.]*; do
        if [ -e "$file" ] || [ -h "$file" ]; then fail "a file is left: $file: $*" && rm -rf "$file"; fi
    done
}

# rows ARG... FILE: awk on tables with the columns of FILE, each of which is a variable with its number: $status is the
# cell of that name.
rows() {
    for table; do :; done
    IFS= read -r names <"$table"
    variables=
    number=0
    IFS=,
    for name in $names; do variables="$variables -v $name=$((number += 1))"; done
    unset IFS
    awk -F, $variables "$@"
}

# check WHAT CONDITION: an expression of rows that must hold in every row of the file out.
check() { rows "NR > 1 && !($2) { bad = 1 } END { exit bad || NR < 2 }" out || fail "$1: $(cat out)"; }

# cell NAME [FILE]: the cell of the last row in that column, of the file out.
cell() { rows "END { print \$$1 }" "${2:-out}"; }

# The last line of each script.
finish() {
    [ $failures -eq 0 ] || exit 1
    echo "all checks passed"
}
