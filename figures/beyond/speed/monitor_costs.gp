# Kepler's problem with HTVI4: steps per orbit and time per orbit of every monitor at equal energy error, for which the
# fictive step is adapted.
width = 16; height = 6.4
load 'figures/style.gp'
table = data.'/monitor_costs.tsv'
list = 'none gamma gamma_three_quarters gamma_half arclength energy truncation_root inverse_lagrangian'
array shown[8] = ['no monitor', 'gamma = 1', 'gamma = 3/4', 'gamma = 1/2', 'arclength', 'energy', 'truncation, root', 'inverse Lagr.']
set multiplot
page_left = 1.45; page_bottom = 2.9; gap_x = 1.55; page_top = 0.65
unset key
eval logy
set offsets 0, 0, graph 0.1, graph 0.1
set xrange [0.4:8.6]
set xtics scale 0 rotate by 60 right
unset xtics; set xtics scale 0 rotate by 60 right; do for [i=1:8] { set xtics add (shown[i] i) }
cell(c, e, t) = column('eccentricity') == e && column('target') == t ? column(c) : NaN
at(k) = position(list, strcol('monitor')) + 0.11 * k
set title 'steps per orbit' offset 0, -0.6
eval panel(1, 1, 2, 1)
plot table using (at(-1)):(cell('steps_per_orbit', 0.9, 1e-5)) with points pt 7 lc rgb sky, \
     table using (at(0)):(cell('steps_per_orbit', 0.9, 1e-7)) with points pt 7 lc rgb blue, \
     table using (at(1)):(cell('steps_per_orbit', 0.99, 1e-5)) with points pt 5 lc rgb orange, \
     table using (at(2)):(cell('steps_per_orbit', 0.99, 1e-7)) with points pt 5 lc rgb vermilion
set title 'seconds per orbit' offset 0, -0.6
eval panel(2, 1, 2, 1)
plot table using (at(-1)):(cell('seconds', 0.9, 1e-5)) with points pt 7 lc rgb sky, \
     table using (at(0)):(cell('seconds', 0.9, 1e-7)) with points pt 7 lc rgb blue, \
     table using (at(1)):(cell('seconds', 0.99, 1e-5)) with points pt 5 lc rgb orange, \
     table using (at(2)):(cell('seconds', 0.99, 1e-7)) with points pt 5 lc rgb vermilion
eval legend(0.5)
set key maxrows 1
plot 2 with points pt 7 lc rgb sky title 'e = 0.9, 10^{-5}', 2 with points pt 7 lc rgb blue title 'e = 0.9, 10^{-7}', \
     2 with points pt 5 lc rgb orange title 'e = 0.99, 10^{-5}', 2 with points pt 5 lc rgb vermilion title 'e = 0.99, 10^{-7}'
unset multiplot
