# gnuplot overview.gp > overview.svg: from two profiles to the patch and its creep curve, and error against run time
set datafile separator ','
set terminal svg size 840,540 enhanced font 'sans,24.5' background '#ffffff'
set multiplot
stats 'overview_contact.csv' using (area = $17, load = $14, rail = 1e3 * $10, wheel = 1e3 * $11, \
    rail_z = 1e3 * $9, wheel_z = 1e3 * ($13 - 0.46), 0) every ::1 nooutput
percent = 100 * 0.3 * load / (8.2e10 * area / pi)  # creepage of mu N/(G a b)
c = 1e3 * sqrt(area / pi)                          # [mm]
blue = '#0072b2'
red = '#d55e00'
unset key
unset border
unset tics
set style fill solid noborder
set label 9 '→' at screen 0.31,0.72
set label 10 '→' at screen 0.6,0.72

set lmargin at screen 0.01; set rmargin at screen 0.3; set bmargin at screen 0.54; set tmargin at screen 0.9
set title 'wheel on rail' offset 0,-0.5
set xrange [-62:56]
set yrange [44:-46]
set object 1 circle at 0,0 size 5 fs empty border rgb red lw 3 front
set label 1 'S1002' at 2,-18 left front
set label 2 '60E1' at 12,26 center front
plot '../manchester/rail.csv' using ($1 - rail):($2 - rail_z) with filledcurves y=44 lc rgb '#cccccc', \
    '../manchester/wheel.csv' using ($1 - wheel):($2 - wheel_z) with filledcurves y=-46 lc rgb '#e6eef5', \
    '' using ($1 - wheel):($2 - wheel_z) with lines lw 3 lc rgb 'black'
unset object 1
unset label 1
unset label 2

set lmargin at screen 0.35; set rmargin at screen 0.595; set bmargin at screen 0.51
set title 'contact patch'
set xrange [-8:8]
set yrange [9.2:-5.2]
fill(stick) = stick > 0 ? 0x85b4d6 : 0xfbe3c8
set label 1 'stick' at 3.6,6 left
set label 2 'slip' at -7.3,6 left
plot 'overview_tractions.csv' using (c * $8):(c * $9):(c * $10 / 2):(c * $11 / 2):(fill($17)) every ::1 \
    with boxxyerror lc rgb variable, \
    '' using (c * $8):(c * $9):(c * 0.25 * $13):(c * 0.25 * $14) every ::1 \
    with vectors head size 0.4,25 filled lw 1.3 lc rgb 'black', \
    for [edge=2:3] 'overview_outline.csv' using (1e3 * column(edge)):(1e3 * $1) every ::1 \
    with lines lw 2 lc rgb '#555555'
unset label 1
unset label 2

set border 3
set lmargin at screen 0.72; set rmargin at screen 0.98; set bmargin at screen 0.64
set title 'creep curve: F / μN'
set xrange [0:0.49]
set yrange [0:1]
set xtics 0.2 nomirror scale 0.5 offset 0,0.3
set ytics 0.5 nomirror scale 0.5 offset 0.3,0
set xlabel 'creepage [%]' offset 0,0.8
set label 1 'along' at 0.22,0.62 textcolor rgb blue
set label 2 "across: at 0\nby spin alone" at 0.09,0.29 font ',20' textcolor rgb red
plot 'overview_curve.csv' using (-percent * $5):(-$8) every ::1 with lines lw 3 lc rgb blue, \
    '' using (-percent * $5):(-$9) every ::1 with lines lw 3 dt 2 lc rgb red
unset label

set lmargin at screen 0.11; set rmargin at screen 0.98; set bmargin at screen 0.09; set tmargin at screen 0.41
set title 'how exact in which time: relative error of a creep coefficient' offset 0,-0.6
set logscale xy
set xrange [0.5:2e4]
set yrange [1e-18:1]
set xtics ('1 μs' 1, '0.1 ms' 100, '10 ms' 1e4)
set ytics ('10^{-5}' 1e-5, '10^{-10}' 1e-10, '10^{-15}' 1e-15, '1' 1)
unset xlabel
set label 1 'elements of one length' at 1.8e4,2.5e-1 right textcolor rgb red
set label 2 "at the paper's points" at 1.8e4,3e-7 right textcolor rgb 'black'
set label 3 "short elements at the\nedges, extrapolated" at 1,1e-8 left textcolor rgb '#009e73'
set label 4 'polynomials in place of elements' at 60,1e-15 left textcolor rgb blue
scheme(name) = sprintf('< grep "^%s,[0-9]*,c11," error_against_time.csv', name)
plot scheme('uniform:collocation:0.5/0.5') using 5:(abs($4)) with lines lw 3 lc rgb red, \
    scheme('uniform:collocation:0/0.63') using 5:(abs($4)) with lines lw 3 dt 3 lc rgb 'black', \
    scheme('richardson:cosine:nodes') using 5:(abs($4)) with lines lw 3 dt 2 lc rgb '#009e73', \
    scheme('chebyshev') using 5:(abs($4) < 1e-15 ? 1e-15 : abs($4)) with lines lw 3 lc rgb blue
