#!/bin/sh
# Runs the cases of cases.txt for one program; what their lines mean stands there.
# Usage: cases.sh FOLDER-OF-PROGRAMS PROGRAM
cases=$(cd "$(dirname "$0")" && pwd)/cases.txt
. "$(dirname "$0")/functions.sh"
PATH=$programs:$PATH
contact=$(dirname "$cases")/../../apps/creep/s1002_60e1.contact
count=0

# file NAME CONTENT: writes CONTENT as printf does, and says where.
file() { printf -- "$2" >"$scratch/$1" && echo "$scratch/$1"; }

# shards PROGRAM ARG...: 4 shards concatenate to the whole, whatever the number of jobs.
shards() {
    "$@" --jobs 3 >whole
    for k in 1 2 3 4; do "$@" --jobs 2 --shard $k/4; done >parts
    cmp -s whole parts || fail "shards or jobs change rows: $*"
}

# orders COLUMN PROGRAM ARG...: at the end of the run, halving --dq shows second order with sdirk2 and first with
# implicit-euler.
orders() {
    column=$1
    shift
    for integrator in sdirk2 implicit-euler; do
        for dq in 0.2 0.1 0.0125; do
            "$@" --dq $dq --integrator $integrator >out
            cell "$column"
        done | awk -v order=$integrator '{ f[NR] = $1 } END { ratio = (f[1] - f[3]) / (f[2] - f[3])
            exit !(order == "sdirk2" ? ratio > 3.4 && ratio < 4.8 : ratio > 1.8 && ratio < 2.4) }' ||
            fail "order of $integrator: $*"
    done
}

# run PROGRAM ARG...: the case of a line.
run() {
    command="$*"
    case $kind in
    refused) bad "$end" "$@" ;;
    ends) exits 1 "$end" "$@" && complains "$(expr "$line" : '.* | \(.*\) | ')" ;;
    rows) good $((end + 1)) "$@" ;;
    same) good "$(eval "$end" | tee other | wc -l)" "$@" && cmp out other || fail "other rows: $*" ;;
    shards) shards "$@" ;;
    orders) orders "$end" "$@" ;;
    *) fail "$line: unknown kind $kind" ;;
    esac
}

while IFS= read -r line; do
    case $line in
    '' | '#'*) ;;
    'file '*) eval "$line" >names ;;
    'let '*) line=${line#let } && eval "${line%% *}=\"${line#* }\"" ;;
    '    '*)
        $mine || continue
        line=${line#    }
        case $line in
        'header '*) grep -q "^${line#header }\(,\|$\)" out || fail "$command: columns $(head -n 1 out)" ;;
        'last '*) rows "END { exit !(${line#last }) }" out || fail "$command: not $line: $(tail -n 1 out)" ;;
        *) check "$command: not $line" "$line" ;;
        esac
        ;;
    *)
        kind=${line%% | *}
        line=${line#* | }
        end=${line##* | }
        eval "program=${line%% *}"
        mine=false
        case $program in "$2" | "$2 "*) mine=true ;; *) continue ;; esac
        count=$((count + 1))
        eval "run ${line%% | *}"
        ;;
    esac
done <"$cases"
[ $count -gt 0 ] || fail "no case of $2"
finish
