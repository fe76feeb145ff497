#!/bin/sh
# same_forces.sh TEST_C TABLE COMMAND...: the command prints the forces that test_c gets from its table, and, but for
# c_forces, the patch of its wheel, and says where a contact lies beyond the table.
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
    { "$test_c" "$table" 2>/dev/null | grep '^wheel '; "$@" | grep '^ *wheel '; } | awk '
        NR == 1 { for (i = 2; i <= 13; ++i) patch[i] = $i }
        NR == 2 { for (i = 2; i <= 13; ++i) if (!(($i - patch[i])^2 <= 1e-16 * (patch[i]^2 + 1e-8))) other = 1 }
        END { if (NR != 2 || other) { print "the patch differs"; exit 1 } }'
    ;;
esac
"$@" 0.1 2>&1 >/dev/null | grep "a/b.* lies beyond the table"
