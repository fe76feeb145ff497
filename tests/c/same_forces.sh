#!/bin/sh
# same_forces.sh TEST_C TABLE COMMAND...: the command prints the forces that test_c gets from its table, and, but for
# c_forces, the patch of its wheel and the forces of one that rolls, and says where a contact lies beyond the table.
set -eu
test_c=$1 table=$2
shift 2
{ "$test_c" "$table" 2>/dev/null | sed -n 's/^table //p'; "$@" | sed -n 1p; } | awk '
    NR == 1 { for (i = 1; i <= 3; ++i) force[i] = $i }
    NR == 2 { for (i = 1; i <= 3; ++i) if (($i / force[i] - 1)^2 < 1e-30) ++same }
    END { if (same != 3) { print "the forces differ"; exit 1 } }'
case $1 in
*c_forces) ;;
*)
    for line in wheel rolls; do
        { "$test_c" "$table" 2>/dev/null | grep "^$line "; "$@" | grep "^ *$line "; } | awk -v line="$line" '
            NR == 1 { for (i = 2; i <= NF; ++i) number[i] = $i; count = NF }
            NR == 2 { for (i = 2; i <= NF; ++i) if (!(($i - number[i])^2 <= 1e-16 * (number[i]^2 + 1e-8))) other = 1 }
            NR == 2 && NF != count { other = 1 }
            END { if (NR != 2 || count < 8 || other) { print "numbers of " line " differ"; exit 1 } }'
    done
    ;;
esac
"$@" 0.1 2>&1 >/dev/null | grep "a/b.* lies beyond the table"
