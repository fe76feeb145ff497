#!/bin/sh
# Runs the cases of cases.txt for one program; what their lines mean stands there.
# Usage: cases.sh FOLDER-OF-PROGRAMS PROGRAM
cases=$(cd "$(dirname "$0")" && pwd)/cases.txt
. "$(dirname "$0")/functions.sh"
PATH=$programs:$PATH
program=$2
in=$scratch
contact=$(dirname "$cases")/../../apps/creep/s1002_60e1.contact
count=0

while IFS= read -r line; do
    case $line in
    '' | '#'*) ;;
    'file '*) line=${line#file } && printf -- "${line#* }" >"${line%% *}" ;;
    'let '*) line=${line#let } && eval "${line%% *}=\${line#* }" ;;
    '    '*)
        [ "$1" = "$program" ] || continue
        line=${line#    }
        case $line in
        'header '*) header "${line#header }" ;;
        'last '*) rows "END { exit !(${line#last }) }" out || fail "$*: not $line: $(tail -n 1 out)" ;;
        *) check "$*: not $line" "$line" ;;
        esac
        ;;
    *)
        kind=${line%% | *}
        line=${line#* | }
        eval "set -- ${line%% | *}"
        [ "$1" = "$program" ] || continue
        count=$((count + 1))
        case $kind in
        refused) bad "${line#* | }" "$@" ;;
        ends) ends_early "${line##* | }" "$(expr "$line" : '.* | \(.*\) | ')" "$@" ;;
        rows) good $((${line##* | } + 1)) "$@" ;;
        shards) shards "$@" ;;
        *) fail "$line: unknown kind $kind" ;;
        esac
        ;;
    esac
done <"$cases"
[ $count -gt 0 ] || fail "no case of $program"
finish
