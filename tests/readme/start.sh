#!/bin/sh
# The README's commands up to the first run, and its compiler's line, as they stand there, in a clone of the last
# commit; a stub in place of make tells what would be built, others install nothing. Usage: start.sh ROOT
root=$(cd "$1" && pwd)
. "$(dirname "$0")/../apps/functions.sh"
git -C "$root" rev-parse HEAD >/dev/null 2>&1 || { echo 'skipped: no git checkout' && exit 0; }

mkdir stubs
for program in apt-get dnf brew sudo; do printf '#!/bin/sh\n' >stubs/$program; done
printf '#!/bin/sh\necho "make $*"\n' >stubs/make
chmod +x stubs/*
export PATH="$scratch/stubs:$PATH" CMAKE_GENERATOR='Unix Makefiles'

# has TEXT: the README has it, maybe over the end of a line. line BEGINNING: the command that begins like this.
has() { tr -s '\n ' ' ' <"$root/README.md" | grep -qF -e "$1" || fail "README.md has no '$1'"; }
line() { sed -n "s~^    \\$ \\($1.*\\)~\\1~p" "$root/README.md" | sed "s/ *# .*//"; }
# builds TARGET COMMAND: this is what the command has make build.
builds() {
    has "$2"
    eval "$2" >log 2>&1 && grep -q "^make .*-f Makefile$1\$" log || fail "$2: $(cat log)"
}

clone=$(line 'git clone')
has "$clone"
eval "$(echo "$clone" | sed "s,URL,--quiet '$root',")" && [ "$(basename "$PWD")" = rollbem ] || fail "$clone: $PWD"
cmake --preset default >log 2>&1 && cmake -D CMAKE_MAKE_PROGRAM="$scratch/stubs/make" build >log 2>&1 || fail "$(cat log)"
builds ' -j2 study' "$(line 'sh cmake/deps.sh')"
grep -q './steady_study --alpha-T 0.63' build/apps/CMakeFiles/study.dir/build.make || fail 'the first run after the build'
builds '' 'cmake -S . -B build && cmake --build build'
has 'sh cmake/deps.sh && cmake --workflow --preset test'
cmake --workflow --list-presets | grep -q '"test"' || fail 'no preset test'

cd build && eval "$(line g++)" && has "$(printf '`%s`' "$(./creep_force)")" || fail 'the line of g++'
finish
