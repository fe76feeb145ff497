set terminal svg size 720,430 enhanced font 'sans,14' background '#ffffff'
set key top left
set grid
set xlabel 'speed, m/s'
set ylabel 'largest |y| after 40 to 60 s, mm'
set yrange [0:12]
rows = "< awk 'NF == 4 && $1 > 0' hunting.txt"
set arrow from graph 0, first 9.1 to graph 1, first 9.1 nohead dt 2 lc rgb '#555555'
set label 'play of the flange' at graph 0.03, first 8.6 textcolor rgb '#555555'
plot rows using 1:2 with linespoints lw 2 pt 7 ps 0.6 lc rgb '#0072b2' title 'from 1 mm', \
     rows using 1:3 with lines lw 2 dt 2 lc rgb '#d55e00' title 'from 10 mm'
