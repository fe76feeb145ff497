set terminal svg size 600,760 enhanced font 'sans-serif,18' background '#ffffff'
set multiplot layout 2,1
set grid
set lmargin at screen 0.17  # equal widths
set xlabel 'amplitude [mm]'
set ylabel 'equivalent conicity'
set yrange [0:0.5]
plot "< awk 'NF == 2 && $1 > 0' hunting.txt" using 1:2 with lines lw 2 lc rgb '#0072b2' notitle
set key bottom right
set xlabel 'speed [m/s]'
set ylabel 'largest |y| of the last third [mm]'
set yrange [0:7]
set xtics 4
rows = "< awk 'NF == 6 && $1 > 0' hunting.txt"
plot rows using 1:2 with linespoints lw 2 pt 7 lc rgb '#0072b2' title 'from 1 mm', \
     rows using 1:3 with linespoints lw 2 dt 2 pt 6 lc rgb '#d55e00' title 'from 6 mm'
unset multiplot
