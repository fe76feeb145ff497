#!/bin/sh
# faces.sh COMPILER INCLUDE_DIR...: what rollbem::compiled shares compiles alone with ROLLBEM_COMPILED: each face that
# leaves its bodies to the library, each unit of bodies, and what they include beside it. With headers alone faces bring
# their bodies along, which hides missing includes. The first folder has the library's headers.
set -eu
compiler=$1
include=$2
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
options="-std=c++20 -DROLLBEM_COMPILED -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Werror -I$include"
shift
for other in "$@"; do
    options="$options -isystem $other"
done

bodies=$(cd "$include" && find rollbem -path '*/impl/*' | LC_ALL=C sort)
folders=$(echo "$bodies" | sed 's,/impl/.*,,' | sort -u)
faces=$(cd "$include" && grep -rlxE '#ifn?def ROLLBEM_COMPILED' rollbem --include='*.hpp' | grep -v /detail/ | LC_ALL=C sort)
beside=$(cd "$include" && for of in $folders; do [ ! -d "$of/detail" ] || find "$of/detail" -name '*.hpp'; done | LC_ALL=C sort)
count=$(echo "$bodies" "$faces" "$beside" | wc -w)
[ "$count" -gt 80 ] || { echo "only $count files"; exit 1; }
# shellcheck disable=SC2086 # one word per file
printf '%s\n' $bodies $faces $beside | xargs -P "$(nproc 2>/dev/null || echo 1)" -n 1 sh -c '
    unit=$1/$(echo "$3" | tr / _).cpp
    echo "#include <$3>" > "$unit"
    # shellcheck disable=SC2086 # one word per option
    '"$compiler"' $2 "$unit" || exit 255' faces "$folder" "$options"
echo "$count files"
