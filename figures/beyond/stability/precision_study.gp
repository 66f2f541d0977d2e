# What number format and summation are worth, for the leapfrog of the logarithmic Hamiltonian composed to order 10.
# Left: largest relative energy error up to each number of periods, with compensated and plain sums and by collocation,
# beside Brouwer's law (square root of the number of steps). Right: position error after 30 periods in four formats.
width = 16; height = 6.1
load 'figures/style.gp'
growth = data.'/precision_study_growth.tsv'
formats = data.'/precision_study.tsv'
set multiplot
page_left = 1.85; page_bottom = 2.45; gap_x = 1.9; page_top = 0.65
unset key
eval logx
eval logy
at(m, e, s) = strcol('method')[1:3] eq m && abs(column('eccentricity') - e) < 1e-6 && strcol('summation') eq s ? column('energy_error') : NaN
kind(f, s) = strcol('format') eq f && strcol('summation') eq s ? column('position_error') : NaN
eval panel(1, 1, 2, 1)
set title 'energy' offset 0, -0.6
set xlabel 'periods'
set ylabel 'relative energy error' offset 0.9, 0
set yrange [1e-16:1e-9]; set ytics 1e2
set key at graph 0, -0.38 top left Left reverse maxrows 4 samplen 1 spacing 1 width -2 font ',7' noopaque
plot growth using 'periods':(at('log', 0.9, 'compensated')) with points pt 7 lc rgb blue title 'e = 0.9, compensated', \
  '' using 'periods':(at('log', 0.9, 'plain')) with points pt 6 lc rgb blue title 'e = 0.9, plain', \
  '' using 'periods':(at('log', 0.99, 'compensated')) with points pt 9 lc rgb vermilion title 'e = 0.99, compensated', \
  '' using 'periods':(at('log', 0.99, 'plain')) with points pt 8 lc rgb vermilion title 'e = 0.99, plain', \
  '' using 'periods':(at('col', 0.9, 'compensated')) with points pt 5 ps 0.5 lc rgb black title 'collocation, 0.9', \
  '' using 'periods':(at('col', 0.99, 'compensated')) with points pt 4 ps 0.5 lc rgb black title 'collocation, 0.99', \
  1e-15 * sqrt(x) with lines lc rgb black title 'square root'
eval panel(2, 1, 2, 1)
set title 'order 10, 30 periods, e = 0.9' offset 0, -0.6
set xlabel 'seconds'
set ylabel 'position error' offset 1, 0
set yrange [1e-15:1]; set ytics 1e3
set key at graph -0.12, -0.38
plot formats using 'seconds':(kind('float', 'plain')) with points pt 4 lc rgb grey title 'float, plain', \
  '' using 'seconds':(kind('float', 'compensated')) with points pt 5 lc rgb grey title 'float, compensated', \
  '' using 'seconds':(kind('double', 'plain')) with points pt 6 lc rgb green title 'double, plain', \
  '' using 'seconds':(kind('double', 'compensated')) with points pt 7 lc rgb green title 'double, compensated', \
  '' using 'seconds':(kind('long double', 'plain')) with points pt 2 lc rgb black title 'long double, plain'
unset multiplot
