#!/bin/sh
# reproduce_paper seen from outside: exit codes, one-line messages, and all files but the plots without gnuplot.
# Usage: reproduce_paper.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
program=$programs/reproduce_paper

: >"$scratch/file"
bad DIR "$program"
bad "DIR = $scratch/file" "$program" "$scratch/file"
bad "DIR = /proc/rollbem" "$program" /proc/rollbem
bad jobs "$program" "$scratch/results" --jobs 0
bad extra "$program" "$scratch/results" extra
[ ! -e "$scratch/results" ] || fail "bad input left a folder"

# Without gnuplot: exit code 0, a note, every panel as CSV, the claims and the page; plots of an earlier run are removed.
mkdir "$scratch/results"
echo old >"$scratch/results/fig05a.svg"
PATH="$scratch/nowhere" "$program" "$scratch/results" --quiet >"$scratch/out" 2>"$scratch/err" </dev/null
code=$?
[ $code -eq 0 ] || fail "without gnuplot: exit code $code"
grep -q gnuplot "$scratch/err" || fail "without gnuplot: no note"
grep -q 'class="note"' "$scratch/results/index.html" || fail "without gnuplot: no note on the page"
for number in 03 05 06 07 08 09 10 11 12 13 14 15 16 17 18 19 20 21 22; do
    [ -s "$scratch/results/fig${number}a.csv" ] || fail "no fig${number}a.csv"
done
[ "$(ls "$scratch/results" | grep -c -v -e '\.csv$' -e '^index\.html$')" -eq 0 ] || fail "left over: $(ls "$scratch/results")"
# every panel but that of one element has a status
for figure in 05a 09a 10a 17b 18a 19b 21d 22a 22b; do
    awk -F, 'NR == 1 ? $NF != "status" : $NF !~ /^(ok|assists_creepage|ill_conditioned)$/ { bad = 1 } END { exit bad || NR < 10 }' \
        "$scratch/results/fig$figure.csv" || fail "status in fig$figure.csv"
done
claims=$scratch/results/claims.csv
[ "$(head -n 1 "$claims")" = "claim,figure,paper,measured,holds,expected,reason,kind" ] || fail "columns of claims.csv"
statements=$(grep -c ',statement$' "$claims") additions=$(grep -c ',addition$' "$claims")
[ "$statements" -gt 25 ] || fail "fewer than 25 statements of the paper"
[ $((statements + additions + 1)) -eq "$(wc -l <"$claims")" ] || fail "a claim is neither statement nor addition"
grep -q "^$statements statements of the paper: .* $additions additions: all hold" "$scratch/out" || fail "$(cat "$scratch/out")"

# The page quotes the paper in the row of each statement, and every link of its contents has a target.
page=$scratch/results/index.html
grep -q approximation "$page" && ! grep -q 'ξm' "$page" || fail "a Greek letter within a word"
failing=$(sed -n 's/.*hold, \([0-9]*\) do not hold as printed.*/\1/p' "$scratch/out")  # their rows appear twice
[ "$(grep -c '<td>“..*”</td>' "$page")" -eq $((statements + failing)) ] || fail "statements without the paper's words"
links=$(grep -o 'href="#[^"]*"' "$page" | sed 's/href="#\(.*\)"/\1/')
[ "$(echo "$links" | wc -l)" -ge 20 ] || fail "contents of the page: $links"
for link in $links; do grep -q "id=\"$link\"" "$page" || fail "the contents lead nowhere: $link"; done

finish
