#!/bin/sh
# check_includes.sh INCLUDE_DIR: checks the #include lines of the headers in INCLUDE_DIR/rollbem.
# Folders are stages: a header includes only its own stage and earlier ones, and there is no cycle. The kernels do not
# depend on meshes, systems on neither, nor the reference on the assembly; only reference/ needs GSL, the time stepper
# includes no eigenvalue headers, nothing prints, and all reach the check of the language.
# Bodies, impl/NAME.ipp and .tpp, include their face NAME.hpp first, and nothing but it includes them, last. Those of
# functions it includes unless ROLLBEM_COMPILED is defined, which stands nowhere else but around `extern template` at the
# end of a header; a face with such bodies includes nothing internal of its folder.
set -eu
cd "$1"

find rollbem -name '*.hpp' -o -name '*.ipp' -o -name '*.tpp' | LC_ALL=C sort | xargs awk '
function complain(text) { print text; ++complaints }
function stage(file,  parts) {
    return split(file, parts, "/") > 2 ? parts[2] : parts[2] ~ /^(rollbem|line|patch|profiles|vehicle)\.hpp$/ ? "umbrella" : "root"
}

# The path "directory/target" without its "." and ".." parts.
function resolve(directory, target,  parts, count, kept, i, path) {
    count = split(directory "/" target, parts, "/")
    kept = 0
    for (i = 1; i <= count; ++i) {
        if (parts[i] == "..") --kept
        else if (parts[i] != "." && parts[i] != "") parts[++kept] = parts[i]
    }
    path = parts[1]
    for (i = 2; i <= kept; ++i) path = path "/" parts[i]
    return path
}

# Depth-first search: 1 while a header is open, 2 when it is done. Where a face includes its bodies, it is complete.
function find_cycle(file, trail,  list, count, i) {
    state[file] = 1
    count = split(includes[file], list, " ")
    for (i = 1; i <= count; ++i) {
        if (state[list[i]] == 1 && list[i] !~ /\.[it]pp$/) complain("include cycle: " trail " -> " list[i])
        else if (!state[list[i]] && list[i] in known && list[i] !~ /\.[it]pp$/) find_cycle(list[i], trail " -> " list[i])
    }
    state[file] = 2
}

# Fills reached[] with all that `file` includes, directly or indirectly; the value is the path to it.
function reach(file, trail,  list, count, i) {
    count = split(includes[file], list, " ")
    for (i = 1; i <= count; ++i) if (!(list[i] in reached)) {
        reached[list[i]] = trail " -> " list[i]
        reach(list[i], reached[list[i]])
    }
}

# Complains unless `file` is `needed` or includes it.
function require(file, needed, reason) {
    split("", reached)
    reach(file, file)
    if (file != needed && !(needed in reached)) complain(file " " reason)
}

# Complains if something that `file` includes matches `pattern`.
function forbid(file, pattern, reason,  target) {
    split("", reached)
    reach(file, file)
    for (target in reached) if (target ~ pattern) complain(reason ": " reached[target])
}

BEGIN {
    count = split("detail root scene closed_form system discretisation normal elasticity assembly " \
        "rolling adhesion friction spectral steady accuracy vehicle reference umbrella", order, " ")
    for (i = 1; i <= count; ++i) rank[order[i]] = i
}

FNR == 1 {
    known[FILENAME] = 1
    directory = FILENAME
    sub(/\/[^\/]*$/, "", directory)
    name = substr(FILENAME, length(directory) + 2)
    sub(/\.[a-z]*$/, "", name)
    bodies = directory ~ /\/impl$/
    face = bodies ? substr(directory, 1, length(directory) - 4) name ".hpp" : ""
    tail = ""
}

/^extern template / { externs[FILENAME] = 1 }

FILENAME != "rollbem/detail/decl.hpp" {
    if (/ROLLBEM_COMPILED/) {
        if ($0 !~ /^#ifn?def ROLLBEM_COMPILED$/ || tail) complain(FILENAME ":" FNR ": ROLLBEM_COMPILED beside the tail of a face")
        tail = /^#ifdef/ ? "externs" : "opened"
    } else if (tail == "opened") {
        if ($0 != "#include \"impl/" name ".ipp\"" && $0 != "#include \"impl/" name ".tpp\"")
            complain(FILENAME ":" FNR ": not the bodies of " name ".hpp")
        tail = "included"
    } else if (tail == "externs" || (tail == "included" && !/^#(else|endif)/)) {
        if (!/^(namespace |extern template |    |}|#endif|$)/) complain(FILENAME ":" FNR ": no `extern template` under ROLLBEM_COMPILED")
    } else if (tail == "closed") complain(FILENAME ":" FNR ": code after the bodies")
    if (tail != "opened" && tail && /^#endif/) tail = "closed"
}

/^[ \t]*#[ \t]*include/ {
    line = $0
    sub(/^[ \t]*#[ \t]*include[ \t]*/, "", line)
    quoted = line ~ /^"/
    target = line
    sub(/^["<]/, "", target)
    sub(/[">].*$/, "", target)
    if (quoted) target = resolve(directory, target)
    if (bodies && !(FILENAME in begun)) {
        begun[FILENAME] = 1
        if (target == face) {
            faces[FILENAME] = face
            next
        }
        complain(FILENAME " does not include " face " first")
    }
    if (target ~ /\.[it]pp$/ && target != directory "/impl/" name substr(target, length(target) - 3))
        complain(FILENAME " includes bodies of another face: " target)
    else if (target ~ /\.ipp$/ && tail == "") complain(FILENAME " includes its bodies under ROLLBEM_COMPILED, too")
    includes[FILENAME] = includes[FILENAME] " " target
}

END {
    for (file in known) {
        from = stage(file)
        if (!(from in rank)) complain(file ": folder " from " is none of the stages")
        count = split(includes[file], list, " ")
        if (file in faces && index(includes[faces[file]] " ", " " file " ") == 0)
            complain(faces[file] " does not include its bodies")
        if (file != "rollbem/detail/language.hpp" && includes[file] !~ / rollbem\// && !(file in faces))
            complain(file " does not check the language")
        for (i = 1; i <= count; ++i) {
            target = list[i]
            if (includes[file] ~ /\.ipp( |$)/ && target ~ /^rollbem\/[a-z_]+\/detail\// && target !~ /\/(contact_row|plane_lambda)\.hpp$/)
                complain(file " shows what is internal: " target)
            if (target ~ /^rollbem\//) {
                if (!(target in known)) complain(file " includes " target ", which does not exist")
                else if (stage(target) == "umbrella") complain(file " includes the umbrella header")
                else if (rank[stage(target)] > rank[from]) complain(file " includes a later stage: " target)
            }
            else if (target ~ /^gsl\// && from != "reference") complain(file " includes GSL: " target)
            else if (target ~ /^(iostream|print)$/) complain(file " could print: it includes <" target ">")
            else if (target ~ /\// && target !~ /^(Eigen|unsupported\/Eigen|gsl)\//)
                complain(file " needs more than Eigen: " target)
        }
        if (from == "adhesion" || from == "friction")
            forbid(file, "^rollbem/(discretisation|elasticity|assembly|spectral)/", "a problem knows how its system was made")
        if (from == "system" || from == "rolling")
            forbid(file, "^rollbem/(discretisation|elasticity|assembly)/", "a system knows how it was made")
        if (from == "elasticity") forbid(file, "^rollbem/(discretisation|assembly)/", "a kernel knows a mesh")
        if (from == "reference") forbid(file, "^rollbem/(discretisation|assembly)/", "the reference is not independent")
        if (from == "umbrella")
            forbid(file, "^(gsl|rollbem/reference)/", "the umbrella needs GSL")
        if (file ~ /\.hpp$/ && file !~ /\/detail\// && (file in externs))
            require(file, "rollbem/detail/decl.hpp", "does not refer to the alignment of rollbem::compiled")
        if (file ~ /\/(transient|friction\/model)\.hpp$/)
            forbid(file, "^Eigen/(Eigenvalues|Dense|Eigen)$", "the time stepper includes eigenvalues")
    }
    for (file in known) if (!state[file]) find_cycle(file, file)
    if (!FNR) complain("no headers found")
    if (complaints) exit 1
}
'
