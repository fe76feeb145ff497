#!/bin/sh
# reproduce_paper seen from outside: bad input, and the files that the test study.reproduce_paper has left in paper/.
# Usage: reproduce_paper.sh FOLDER-OF-PROGRAMS
. "$(dirname "$0")/functions.sh"
program=$programs/reproduce_paper

: >file
bad DIR "$program"
bad "DIR = $scratch/file" "$program" "$scratch/file"
bad jobs "$program" "$scratch/results" --jobs 0
bad extra "$program" "$scratch/results" extra
[ ! -e results ] || fail "bad input left a folder"

cd "$programs/paper" || exit 1
for number in 03 05 06 07 08 09 10 11 12 13 14 15 16 17 18 19 20 21 22; do
    [ -s fig${number}a.csv ] || fail "no fig${number}a.csv"
done
# every panel but the one of a single element has a status
for figure in 05a 09a 10a 17b 18a 19b 21d 22a 22b; do
    awk -F, 'NR == 1 ? $NF != "status" : $NF !~ /^(ok|assists_creepage|ill_conditioned)$/ { bad = 1 }
        END { exit bad || NR < 10 }' fig$figure.csv || fail "status in fig$figure.csv"
done
[ "$(head -n 1 claims.csv)" = "claim,figure,paper,measured,holds,expected,reason,kind" ] || fail "columns of claims.csv"
statements=$(grep -c ',statement$' claims.csv) additions=$(grep -c ',addition$' claims.csv)
[ "$statements" -gt 25 ] && [ $((statements + additions + 1)) -eq "$(wc -l <claims.csv)" ] ||
    fail "$statements statements and $additions additions"
for equation in 'Eq\. 8' 'Eq\. 12' 'Eq\. 15' 'Eq\. 16' 'Eqs\. 24-26' 'Eq\. 29' 'Eq\. 31'; do
    grep -q ",$equation,.*,no,no,.*,statement$" claims.csv || fail "the claim on $equation"
done
page=index.html
grep -q "$statements statements of the paper: .* $additions additions: all hold" $page || fail "numbers of claims"

# The page quotes the paper in the row of each statement, and every link of its contents has a target.
grep -q approximation $page && ! grep -q 'ξm' $page || fail "a Greek letter within a word"
failing=$(sed -n 's/.*hold, \([0-9]*\) do not hold as printed.*/\1/p' $page)  # their rows appear twice
[ "$(grep -c '<td>“..*”</td>' $page)" -eq $((statements + failing)) ] || fail "statements without the paper's words"
grep -q 'alt="[^"]*<' $page && fail "markup in the description of a picture"
for link in $(grep -o 'href="#[^"]*"' $page | sed 's/href="#\(.*\)"/\1/'); do
    grep -q "id=\"$link\"" $page && links="${links-}." || fail "the contents lead nowhere: $link"
done
[ ${#links} -ge 20 ] || fail "contents of the page: $links"

finish
