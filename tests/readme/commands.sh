#!/bin/sh
# Commands of studies that pages have in tables and lists, as `./PROGRAM ...`, run as they stand there, each once. Those
# that take long have tests of their own. Usage: commands.sh FOLDER-OF-PROGRAMS PAGE...
pages=$(shift && realpath "$@")
. "$(dirname "$0")/../apps/functions.sh"
ln -s "$programs"/*_study "$programs"/*_table .
# shellcheck disable=SC2086 # no page's path has a space
grep -hE '^(\||- )' $pages | grep -oE '`\./[^`]+`' | tr -d '`' | sort -u >commands
[ "$(wc -l <commands)" -gt 20 ] || fail "too few commands: $(cat commands)"
while IFS= read -r command; do
    case $command in
    ./reproduce_paper* | ./examples/* | './extremes_study --large' | './precision_study --output'*) continue ;;
    esac
    eval "$command" >out 2>err </dev/null
    code=$?
    # without gnuplot there is no picture
    [ $code -eq 0 ] || { [ $code -eq 3 ] && ! command -v gnuplot >/dev/null; } ||
        fail "exit $code: $command: $(cat err)"
    case $command in
    *--output*) ;;
    *) [ "$(wc -l <out)" -ge 2 ] || fail "no rows: $command" ;;
    esac
done <commands
finish
