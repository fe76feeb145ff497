#!/bin/sh
# Error of c11 against run time (assembly and solve) for a few schemes, as CSV and SVG.
# Usage: bench/error_against_time.sh <build folder> [<output folder, default bench/results>]
set -eu
build=$1
results=${2:-$(dirname "$0")/results}
mkdir -p "$results"
elements=4,6,8,10,14,20,28,40,56,80,112,160,224,320,448,640
common="--kernel plane --aspect inf --quiet"

csv=$results/error_against_time.csv
"$build/steady_study" --n $elements --alpha 0.5 $common > "$csv"
"$build/steady_study" --n $elements --alpha-T 0.63 $common | tail -n +2 >> "$csv"
"$build/steady_study" --n $elements --mesh cosine --alpha 0.5 $common | tail -n +2 >> "$csv"
"$build/steady_study" --n $elements --method galerkin --alpha-T 0.63 $common | tail -n +2 >> "$csv"

gnuplot <<PLOT
set terminal svg size 720,480 font "sans,13" background "white"
set output "$results/error_against_time.svg"
set datafile separator ","
set logscale xy
set format "%h"
set xlabel "assembly and solve [microseconds]"
set ylabel "|c_{11} / c_{11,exact} - 1|"
set grid lc rgb "#dddddd"
set key bottom left
scheme(name, mesh, trailing) = sprintf("< awk -F, '\$1==\"%s\" && \$3==\"%s\" && \$6==%s {e=\$10; print \$12+\$13 \",\" (e<0 ? -e : e)}' $csv", name, mesh, trailing)
plot scheme("collocation", "uniform", "0.5") with linespoints lw 2 pt 7 lc rgb "#000000" title "uniform 0.5/0.5 (Kalker)", \\
     scheme("collocation", "uniform", "0.63") with linespoints lw 2 pt 5 dt 2 lc rgb "#0072b2" title "uniform 0/0.63", \\
     scheme("galerkin", "uniform", "0.63") with linespoints lw 1 pt 4 dt 4 lc rgb "#cc79a7" title "Galerkin, closed form, 0/0.63", \\
     scheme("collocation", "cosine", "0.5") with linespoints lw 2 pt 9 dt 3 lc rgb "#d55e00" title "cosine 0.5/0.5"
PLOT
