# Kepler's problem with HTVI4: steps per orbit and time per orbit of every monitor at equal energy error, for which the
# fictive step is adapted.
width = 16; height = 6.4
load 'figures/style.gp'
table = data.'/monitor_costs.tsv'
list = 'none gamma gamma_three_quarters gamma_half arclength energy truncation_root inverse_lagrangian'
array shown[8] = ['no monitor', 'γ = 1', 'γ = 3/4', 'γ = 1/2', 'arclength', 'energy', 'truncation, root', '1/|L|']
set multiplot
page_left = 2.6; page_bottom = 2.15; gap_x = 0.8; page_top = 0.65
unset key
eval logx
set offsets graph 0.03, graph 0.03, 0, 0
set yrange [8.6:0.4]
unset ytics; set ytics scale 0; do for [i=1:8] { set ytics add (shown[i] i) }
cell(c, e, t) = column('eccentricity') == e && column('target') == t ? column(c) : NaN
at(k) = position(list, strcol('monitor')) + 0.11 * k
set title 'steps per orbit' offset 0, -0.6
eval panel(1, 1, 2, 1)
plot table using (cell('steps_per_orbit', 0.9, 1e-5)):(at(-1)) with points pt 7 lc rgb sky, \
     table using (cell('steps_per_orbit', 0.9, 1e-7)):(at(0)) with points pt 7 lc rgb blue, \
     table using (cell('steps_per_orbit', 0.99, 1e-5)):(at(1)) with points pt 5 lc rgb orange, \
     table using (cell('steps_per_orbit', 0.99, 1e-7)):(at(2)) with points pt 5 lc rgb vermilion
set title 'seconds per orbit' offset 0, -0.6
unset ytics; set ytics scale 0; do for [i=1:8] { set ytics add ('' i) }
eval panel(2, 1, 2, 1)
plot table using (cell('seconds', 0.9, 1e-5)):(at(-1)) with points pt 7 lc rgb sky, \
     table using (cell('seconds', 0.9, 1e-7)):(at(0)) with points pt 7 lc rgb blue, \
     table using (cell('seconds', 0.99, 1e-5)):(at(1)) with points pt 5 lc rgb orange, \
     table using (cell('seconds', 0.99, 1e-7)):(at(2)) with points pt 5 lc rgb vermilion
eval legend(0.9)
set key maxrows 2
plot 2 with points pt 7 lc rgb sky title 'e = 0.9, energy error 10^{-5}', 2 with points pt 7 lc rgb blue title 'e = 0.9, energy error 10^{-7}', \
     2 with points pt 5 lc rgb orange title 'e = 0.99, energy error 10^{-5}', 2 with points pt 5 lc rgb vermilion title 'e = 0.99, energy error 10^{-7}'
unset multiplot
