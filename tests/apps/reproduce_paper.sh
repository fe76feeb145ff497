#!/bin/sh
# reproduce_paper seen from outside: exit codes, one-line messages, and all files but the plots without gnuplot.
# usage: reproduce_paper.sh PROGRAM
set -u
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

# refused WORD ARGUMENT...: exit code 2, nothing on standard output, one line that contains WORD on standard error
refused() {
    word=$1
    shift
    "$program" "$@" >"$folder/out" 2>"$folder/err" </dev/null
    code=$?
    [ $code -eq 2 ] || fail "$*: exit code $code instead of 2"
    [ ! -s "$folder/out" ] || fail "$*: text on standard output"
    [ "$(wc -l <"$folder/err")" -eq 1 ] || fail "$*: not one line: $(cat "$folder/err")"
    grep -q -- "$word" "$folder/err" || fail "$*: no '$word' in: $(cat "$folder/err")"
}

: >"$folder/file"
refused DIR
refused "DIR = $folder/file" "$folder/file"
refused "DIR = /proc/rollbem" /proc/rollbem
refused jobs "$folder/results" --jobs 0
refused extra "$folder/results" extra
[ ! -e "$folder/results" ] || fail "bad input left a folder"

# No gnuplot: exit code 0, a note, every panel as CSV, the claims and the page; plots of an earlier run are gone.
mkdir "$folder/results"
echo old >"$folder/results/fig05a.svg"
PATH="$folder/nowhere" "$program" "$folder/results" --quiet >"$folder/out" 2>"$folder/err" </dev/null
code=$?
[ $code -eq 0 ] || fail "without gnuplot: exit code $code"
grep -q gnuplot "$folder/err" || fail "without gnuplot: no note"
grep -q 'class="note"' "$folder/results/index.html" || fail "without gnuplot: no note on the page"
for number in 03 05 06 07 08 09 10 11 12 13 14 15 16 17 18 19 20 21 22; do
    [ -s "$folder/results/fig${number}a.csv" ] || fail "no fig${number}a.csv"
done
[ "$(ls "$folder/results" | grep -c -v -e '\.csv$' -e '^index\.html$')" -eq 0 ] || fail "left over: $(ls "$folder/results")"
[ "$(head -n 1 "$folder/results/claims.csv")" = "claim,figure,paper,measured,holds,expected,reason" ] ||
    fail "columns of claims.csv"
[ "$(wc -l <"$folder/results/claims.csv")" -gt 25 ] || fail "fewer than 25 claims"

[ $failures -eq 0 ]
