#!/bin/sh
# The recipe for GNU parallel that a page has, run as it stands there on fewer rows: the parts make the whole but for
# times and on_front. Usage: many_machines.sh FOLDER-OF-PROGRAMS PAGE
page=$(realpath "$2")
. "$(dirname "$0")/functions.sh"
command -v parallel >/dev/null || { echo 'skipped: GNU parallel is not installed' && exit 0; }
ln -s "$programs/precision_study" .
few='--n 4,6,8 --scheme cosine:nodes,uniform:galerkin:0/0.75:q7,chebyshev --quantity c11,response'
recipe=$(sed -n "s|^    \(parallel \./precision_study\) |\1 $few |p" "$page")
search=$(sed -n 's/^    \(cat part?\.csv .*\)/\1/p' "$page")
[ -n "$recipe" ] && [ -n "$search" ] || fail "no recipe in $page"
eval "$recipe" 2>err || fail "$recipe: $(cat err)"
# shellcheck disable=SC2086 # words
./precision_study $few >whole
cat part?.csv >parts
for table in whole parts; do rows 'NR > 1 { $time_us = $on_front = "" } { print }' $table >$table.aside; done
cmp -s whole.aside parts.aside || fail "parts differ from the whole: $(cat parts)"
if command -v gnuplot >/dev/null; then
    eval "$search" 2>err || fail "$search: $(cat err)"
    rows 'NR > 1 && $on_front == "" { bad = 1 } END { exit bad || NR != 19 }' front.csv || fail "$(cat front.csv)"
    [ -s cheapest.csv ] && [ -s front.svg ] || fail 'the cheapest schemes and the picture'
fi
finish
