#!/bin/sh
# by_pkg_config.sh COMPILER SOURCE PROGRAM: a program takes all it needs from rollbem_c.pc; rollbem.pc, of the
# headers, links nothing.
set -eu
"$1" "$2" -o "$3" $(pkg-config --cflags --libs rollbem_c) "-Wl,-rpath,$(pkg-config --variable=libdir rollbem_c)"
test -z "$(pkg-config --libs rollbem)"
