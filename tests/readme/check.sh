#!/bin/sh
# The first program in README.md is exactly tests/readme/example.cpp. Usage: check.sh <source folder>
set -eu
quoted=$(mktemp)
trap 'rm -f "$quoted"' EXIT
awk '/^```cpp$/ { inside = 1; next } /^```$/ && inside { exit } inside' "$1/README.md" > "$quoted"
diff "$quoted" "$1/tests/readme/example.cpp"
