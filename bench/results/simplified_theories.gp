set datafile separator ','
set terminal svg size 600,820 enhanced font 'sans-serif,18' background '#ffffff'
set multiplot layout 2,1
set key bottom right
set grid
set xlabel 'longitudinal creepage, G a b c_{11} ξ / (μ N)'
set ylabel '-F_x / (μ N)'
set title 'a/b = 1.5, no spin'
f(s, c) = sprintf('< awk -F, -v OFS=, -v s=%g "NR > 1 && \$1 == s { print \$2, \$%d }" %s', s, c, \
    'simplified_theories.csv')
plot f(0,3) with lines lw 2.5 lc rgb '#0072b2' title 'rollbem', \
    f(0,4) with lines lw 2 dt 2 lc rgb '#d55e00' title 'FASTSIM', \
    f(0,6) with lines lw 2 dt 3 lc rgb '#009e73' title 'FaStrip', \
    f(0,7) with lines lw 2 dt 4 lc rgb '#555555' title 'linear, saturated'
set xlabel 'lateral creepage, G a b c_{22} η / (μ N)'
set ylabel '-F_y / (μ N)'
set title 'with spin, G a b c c_{23} φ / (μ N) = 0.8'
plot f(0.8,3) with lines lw 2.5 lc rgb '#0072b2' title 'rollbem', \
    f(0.8,4) with lines lw 2 dt 2 lc rgb '#d55e00' title 'FASTSIM', \
    f(0.8,6) with lines lw 2 dt 3 lc rgb '#009e73' title 'FaStrip', \
    f(0.8,7) with lines lw 2 dt 4 lc rgb '#555555' title 'linear, saturated'
unset multiplot
