#!/bin/sh
# A C++ program quoted in a page is an example, to the letter but for the comment at its top; a line that it prints, if
# it is run, stands in the page in backticks. Usage: quotes.sh PAGE SOURCE [PROGRAM ARG...]
set -eu
page=$1 source=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder" "$folder.source"' EXIT
awk -v folder="$folder" '
    /^```cpp$/ { ++count; inside = 1; next }
    /^```$/ { inside = 0 }
    inside { print > (folder "/" count) }' "$page"
awk 'code || !/^\/\// { code = 1; print }' "$source" >"$folder.source"
found=no
for quoted in "$folder"/*; do
    if cmp -s "$quoted" "$folder.source"; then found=yes; fi
done
[ $found = yes ] || { echo "$page does not quote $source" && exit 1; }
[ $# -gt 0 ] || exit 0
"$@" >"$folder/out"
while IFS= read -r line; do
    if grep -qF "\`$line\`" "$page"; then exit 0; fi
done <"$folder/out"
echo "$page has no line of: $(cat "$folder/out")"
exit 1
