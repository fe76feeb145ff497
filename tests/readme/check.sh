#!/bin/sh
# The first program in README.md is apps/examples/quickstart.cpp, to the letter. Usage: check.sh <source folder>
set -eu
quoted=$(mktemp)
trap 'rm -f "$quoted"' EXIT
awk '/^```cpp$/ { inside = 1; next } /^```$/ && inside { exit } inside' "$1/README.md" > "$quoted"
diff "$quoted" "$1/apps/examples/quickstart.cpp"
