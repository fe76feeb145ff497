#!/bin/sh
# same_forces.sh TEST_C TABLE COMMAND...: the command prints the forces that test_c gets from its table, and says where
# a contact lies beyond it.
set -eu
test_c=$1 table=$2
shift 2
{ "$test_c" "$table" 2>/dev/null | sed -n 's/^table //p'; "$@" | head -n 1; } | awk '
    NR == 1 { for (i = 1; i <= 3; ++i) force[i] = $i }
    NR == 2 { for (i = 1; i <= 3; ++i) if (($i / force[i] - 1)^2 < 1e-30) ++same }
    END { if (same != 3) { print "the forces differ"; exit 1 } }'
"$@" 0.1 2>&1 >/dev/null | grep "a/b.* lies beyond the table"
