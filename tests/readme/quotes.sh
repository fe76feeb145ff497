#!/bin/sh
# A C++ program quoted in a page is an example, to the letter. Usage: quotes.sh <page> <program>
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
awk -v folder="$folder" '
    /^```cpp$/ { ++count; inside = 1; next }
    /^```$/ { inside = 0 }
    inside { print > (folder "/" count) }' "$1"
for quoted in "$folder"/*; do
    if cmp -s "$quoted" "$2"; then exit 0; fi
done
echo "$1 does not quote $2"
exit 1
