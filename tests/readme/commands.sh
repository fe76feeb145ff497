#!/bin/sh
# Commands of programs on pages, `./PROGRAM ...` in tables and lists or on indented lines, run as they stand there, each
# once. Those that take long have tests of their own. Usage: commands.sh FOLDER-OF-PROGRAMS PAGE...
pages=$(shift && realpath "$@")
root=$(cd "$(dirname "$0")/../.." && pwd)
. "$(dirname "$0")/../apps/functions.sh"
mkdir build && ln -s "$root/bench" "$root/apps" . && cd build || exit 1
ln -s "$programs"/*_study "$programs"/*_table "$programs/reproduce_paper" "$programs/examples" .

# files in place of a reader's own
points() { awk -F, "/^[-0-9]/ { print $1 }" "$root/bench/manchester/$2"; }
points '$1 + 70, $2' wheel.csv >worn.whl
points '-$1, $2' rail.csv >worn.ban
points '$1 / 1000, $2 / 1000' wheel.csv >wheel.txt
points '$1 / 1000, $2 / 1000' rail.csv >rail.txt
printf '0 1\n2\n0\n1\n-100 "rail.txt"\n100 "rail.txt"\n' >nose.slcs
printf '0 1\n2\n0\n1\n-0.2 "wheel.txt"\n0.2 "wheel.txt"\n' >flat.slcw

# shellcheck disable=SC2086 # no page's path has a space
{
    grep -hE '^(\||- )' $pages | grep -oE '`\./[^`]+`' | tr -d '`'
    awk '/^    (\$ )?(.* )?\.\// || more { sub(/ *# .*/, ""); sub(/^ *(\$ )?/, more ? " " : "")
        more = sub(/ *\\$/, ""); printf "%s%s", $0, more ? "" : "\n" }' $pages | sed 's/^cd build && //' | grep '^\./'
} | sort -u >commands
[ "$(wc -l <commands)" -gt 40 ] && grep -q -- '--shift 0,0.004 --plot mine.svg$' commands ||
    fail "too few commands: $(cat commands)"
while IFS= read -r command; do
    case $command in
    ./reproduce_paper* | ./examples/simbody_wheel | './extremes_study --large' | './precision_study --output'* | \
        './contact_table --output wheelset'* | *--rows* | *--shard*) continue ;;
    './contact_table --check'* | './creep_table --n'*)
        # on fewer cases and nodes
        command=$(echo "$command" | sed 's/--check 20/--check 1/
            s/--n [89] --levels [89] --shapes [0-9]*/--n 4 --levels 4 --shapes 4/') ;;
    esac
    eval "$command" >out 2>err </dev/null
    code=$?
    # without gnuplot there is no picture
    [ $code -eq 0 ] || { [ $code -eq 3 ] && ! command -v gnuplot >/dev/null; } ||
        fail "exit $code: $command: $(cat err)"
    case $command in
    *--output* | ./examples/creep_force*) ;;
    *) [ "$(wc -l <out)" -ge 2 ] || fail "no rows: $command" ;;
    esac
done <commands
finish
