#!/bin/sh
# older.sh COMPILER INCLUDE_DIR: headers, compiled for C++17, say what is missing in at most ten lines: the umbrella,
# and those that include no other header of the library, which all others reach first (check_includes.sh).
set -eu
compiler=$1
include=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

count=0
alone=$(cd "$include" && find rollbem -name '*.hpp' | LC_ALL=C sort | while read -r header; do
    grep '^#include "' "$header" | grep -qvE '(language|decl)\.hpp"|"impl/' || echo "$header"
done)
for header in rollbem/rollbem.hpp $alone; do
    echo "#include <$header>" > "$folder/unit.cpp"
    if "$compiler" -std=c++17 -fsyntax-only -I"$include" "$folder/unit.cpp" > "$folder/said" 2>&1; then
        echo "$header compiles for C++17"
        exit 1
    fi
    lines=$(wc -l < "$folder/said")
    if [ "$lines" -gt 10 ] || ! grep -q 'rollbem needs C++20' "$folder/said"; then
        echo "$header: $lines lines"
        head -n 20 "$folder/said"
        exit 1
    fi
    count=$((count + 1))
done
[ "$count" -gt 15 ]
