set terminal svg size 600,1080 enhanced font 'sans-serif,18' background '#ffffff'
set multiplot layout 3,1
set grid
set lmargin at screen 0.18; set rmargin at screen 0.77  # equal widths
set key below samplen 2 width -3
set xrange [-45:32]
set xtics 10
set yrange [-30:3]
set ytics 10 nomirror
set y2range [0:*]
set y2tics
set y2label offset -1
set xlabel 'y [mm], gauge side on the left'
set ylabel 'height of the rail [mm]'
set y2label 'frictional work [J/m^2]'
do for [k = 3:6:3] {
    set title k == 3 ? 'inner rail' : 'outer rail'
    name(text) = k == 3 ? text : ''
    plot 'curve_wear.txt' using 1:(column(k)) axes x1y2 with filledcurves y2=0 fc rgb '#e69f00' title name('patches'), \
         '' using 1:(column(k + 1)) axes x1y2 with lines lw 2 lc rgb '#0072b2' title name('table'), \
         '' using 1:(-$2) with lines lw 2 dt 2 lc rgb 'black' title name('rail')
}
set y2label 'wear by Archard''s law [nm]'
plot 'curve_wear.txt' using 1:8 axes x1y2 with filledcurves y2=0 fc rgb '#cc79a7' title 'wear', \
     '' using 1:(-$2) with lines lw 2 dt 2 lc rgb 'black' notitle
unset multiplot
