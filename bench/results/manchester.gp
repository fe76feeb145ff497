set datafile separator ','
set terminal svg size 600,900 enhanced font 'sans-serif,18' background '#ffffff'
set multiplot layout 2,1
set key below Left reverse samplen 2 width -3
set grid
set xlabel 'lateral shift [mm], yaw 2.4 mrad a mm'
set ylabel 'force / (μ N), moment / (μ N c)'
set xrange [-0.2:10.2]
set yrange [-1.05:1.05]
f(s, c) = sprintf('< awk -v rows=1 -F, -f ../manchester/compare.awk ../manchester/contact.csv manchester.csv' . \
    ' | awk -F, -v OFS=, "\$1 == \"%s\" { print \$2, \$%d }"', s, c)
do for [s in 'left right'] {
    set title 'on the ' . s . ' wheel'
    plot f(s,3) with lines lw 2 lc rgb '#0072b2' title 'longitudinal', \
        f(s,6) with points pt 6 lc rgb '#0072b2' title 'CONTACT', \
        f(s,4) with lines lw 2 dt 2 lc rgb '#d55e00' title 'lateral', \
        f(s,7) with points pt 4 lc rgb '#d55e00' title 'CONTACT', \
        f(s,5) with lines lw 2 dt 3 lc rgb '#009e73' title 'moment', \
        f(s,8) with points pt 8 lc rgb '#009e73' title 'CONTACT'
}
unset multiplot
