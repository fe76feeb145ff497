set terminal svg size 860,380 enhanced font 'sans-serif,14' background '#ffffff'
set multiplot layout 1,2
set grid
set xrange [-45:32]
set yrange [-30:3]
set ytics 10
set y2range [0:*]
set y2tics
set xlabel 'y of the rail [mm], the gauge side on the left'
set ylabel 'height of the rail [mm]'
set y2label 'frictional work [J/m^2]'
do for [k = 3:4] {
    set title k == 3 ? 'inner rail' : 'outer rail'
    plot 'curve_wear.txt' using 1:(column(k)) axes x1y2 with filledcurves y2=0 fc rgb '#d55e00' notitle, \
         '' using 1:(-$2) with lines lw 2 lc rgb '#0072b2' notitle
}
unset multiplot
