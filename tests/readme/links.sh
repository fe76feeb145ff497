#!/bin/sh
# Links between pages lead somewhere, docs/index.md names every page, and paths and names of the code that pages and
# comments use are there. Usage: links.sh ROOT
set -eu
export LC_ALL=C
cd "$1"
awk '
function complain(text) { print text; bad = 1 }
# The anchor of a heading.
function anchor(heading) {
    gsub(/\]\([^)]*\)/, "", heading)
    gsub(/[^A-Za-z0-9_ \200-\377-]/, "", heading)
    gsub(/ /, "-", heading)
    return tolower(heading)
}
FNR == 1 { code = 0; page[FILENAME] = 1 }
/^```/ { code = !code }
!code && /^#+ / { sub(/^#+ */, ""); anchors[FILENAME "#" anchor($0)] = 1 }
!code {
    text = $0
    while (match(text, /\]\([^) ]+\)/)) {
        link = substr(text, RSTART + 2, RLENGTH - 3)
        text = substr(text, RSTART + RLENGTH)
        if (link !~ /^[a-z]+:/) { from[++count] = FILENAME; to[count] = link }
    }
}
END {
    for (i = 1; i <= count; ++i) {
        path = from[i]
        if (to[i] ~ /^[^#]/) {
            folder = from[i] ~ /\// ? "docs/" : ""
            path = folder to[i]
            sub(/#.*/, "", path)
            sub(/^docs\/\.\.\//, "", path)
        }
        name = to[i]
        if (from[i] == "docs/index.md") named[path] = 1
        if (system("test -e " path) != 0) complain(from[i] ": no file for " name)
        else if (name ~ /#/ && path ~ /\.md$/) {
            sub(/^[^#]*#/, "", name)
            if (!((path "#" name) in anchors)) complain(from[i] ": no anchor for " to[i])
        }
    }
    named["docs/index.md"] = 1
    for (file in page) if (file ~ /^docs\// && !(file in named)) complain("docs/index.md does not name " file)
    if (!count) complain("no links")
    exit bad
}' README.md CONTRIBUTING.md docs/*.md

# Names of several words, in examples within comments and in backquotes of pages; file names are names too.
names=$(mktemp)
trap 'rm -f "$names"' EXIT
sources=$(find include apps tests bench cmake CMakeLists.txt -type f -not -path '*/corpus/*' -not -path '*/results/*')
{ echo "$sources"; echo "$sources" | xargs sed 's,//.*,,'; } | grep -aoE '[A-Za-z_][A-Za-z0-9_]*' | sort -u >"$names"
unknown=$({
    find include -name '*.[hit]pp' -exec grep -hE '^ */// {4,}' {} + | sed 's,///,,; s,//.*,,'
    find docs -name '*.md' -not -name fmu.md -exec grep -hoE '`[^`]*`' README.md CONTRIBUTING.md {} + # FMUs: by parts
} | grep -oE '\b[a-z]{3,}(_[a-z]{2,})+\b' | sort -u | comm -23 - "$names")
[ -z "$unknown" ] || { echo "names that no code has: $unknown"; exit 1; }

# The README is no longer than a newcomer reads, and the glossary has words that the literature has not alone.
[ "$(wc -l <README.md)" -le 110 ] || { echo "README.md has more than 110 lines" && exit 1; }
[ "$(grep -c '^| ' docs/glossary.md)" -le 26 ] || { echo "docs/glossary.md has more than 25 words" && exit 1; }

# Paths of code, from the root or from where includes and pages begin; `name` stands for any.
missing=$({
    grep -hoE '`[^`]*`' README.md CONTRIBUTING.md docs/*.md
    find include apps tests cmake -type f -not -path '*/corpus/*' -exec grep -ahoE '(//|#|\*) .*' {} +
} | grep -aoE '(^|[ `("])([a-z_]+/)+[A-Za-z_0-9]+\.([chit]pp|h|c|f90|py|sh|md|txt|cmake)\b' |
    sed 's/^[^a-z_]//' | grep -vE 'name\.|NAME' | sort -u |
    while read -r path; do
        for folder in . include include/rollbem apps tests include/rollbem/detail; do
            [ ! -e "$folder/$path" ] || continue 2
        done
        echo "$path"
    done)
[ -z "$missing" ] || { echo "files that there are not: $missing"; exit 1; }
