#!/bin/sh
# programs.sh INCLUDE_DIR: prints one unit made of the programs in comments of headers, each \code block with a main(), in
# a namespace of its own, and a main() that runs them all.
set -eu
cd "$1"
find rollbem -name '*.hpp' ! -path '*/detail/*' | LC_ALL=C sort | xargs awk '
/^ *\/\/\/ \\code/ { inside = 1; count = 0; is_program = 0; next }
/^ *\/\/\/ \\endcode/ {
    inside = 0
    if (!is_program) next
    name[++programs] = FILENAME
    text[programs] = ""
    for (i = 1; i <= count; ++i) {
        if (line[i] ~ /^#include /) { if (!(line[i] in seen)) { seen[line[i]] = 1; includes = includes line[i] "\n" } }
        else text[programs] = text[programs] line[i] "\n"
    }
    next
}
inside {
    own = $0
    sub(/^ *\/\/\/ ?/, "", own)
    line[++count] = own
    if (own ~ /^int main\(\)/) is_program = 1
}
END {
    if (programs < 35) { print "#error only " programs " programs in the headers"; exit }
    print "#include <cstdio>\n" includes
    for (k = 1; k <= programs; ++k) {
        sub(/int main\(\)/, "int run()", text[k])
        # without a return, as in main(), the program ends well
        if (text[k] !~ /\n    return [^\n]*\n}\n*$/) sub(/\n}\n*$/, "\n    return 0;\n}\n", text[k])
        print "namespace program_" k " {\n" text[k] "}  // namespace program_" k "\n"
    }
    print "int main() {\n    int failures = 0;"
    for (k = 1; k <= programs; ++k)
        print "    if (program_" k "::run() != 0) { std::puts(\"" name[k] ": the program number " k " fails\"); ++failures; }"
    print "    return failures;\n}"
}'
