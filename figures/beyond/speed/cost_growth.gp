# How the cost of a run grows: steps and time of one orbit with 1 - e for g = r^(2 gamma); time with the horizon and the
# Taylor order. Grey, drawn through the last point: the expected powers of 1 - e, and the power of the order fitted to the
# data (both in cost_growth_fit).
width = 16; height = 9.4
load 'figures/style.gp'
table = data.'/cost_growth.tsv'
fit = data.'/cost_growth_fit.tsv'
# A column of the fits for a curve: `eval fitted(...)`, then STATS_max.
fitted(axis, name, c) = sprintf("stats fit using (strcol('axis') eq '%s' && strcol('subject') eq '%s' ? column('%s') : NaN) nooutput", axis, name, c)
set multiplot
page_left = 1.25; page_bottom = 1.1; page_top = 0.65; gap_x = 1.45; gap_y = 3.0
along(axis, name) = strcol('axis') eq axis && strcol('subject') eq name ? column('value') : NaN
gammas = '0.5 0.625 0.75 0.875 1'
array guided = ['none', 'gamma = 0.5', 'gamma = 0.75', 'gamma = 1']
array last[4]; array steps[4]; array power[4]
do for [i=1:4] {
  eval fitted('closeness', guided[i], 'steps_limit'); power[i] = STATS_max
  stats table using (along('closeness', guided[i])):'steps' nooutput
  last[i] = STATS_min_x; steps[i] = STATS_max_y
}
eval logx
eval logy
unset key
eval panel(1, 1, 2, 2)
set title 'steps of one orbit with energy error 10^{-6}' offset 0, -0.7
set xrange [0.15:6e-7]
set yrange [20:6e4]
set xlabel 'distance 1 − e from a parabola' offset 0, 0.2
plot for [i=1:4] steps[i]*(x/last[i])**power[i] ls guide, \
  table using (along('closeness', 'none')):'steps' with linespoints ls monitor('none'), \
  for [i=1:5] table using (along('closeness', 'gamma = '.word(gammas, i))):'steps' with linespoints ls family(i)
eval panel(2, 1, 2, 2)
set title 'microseconds of that orbit' offset 0, -0.7
set yrange [50:1.5e5]
plot table using (along('closeness', 'none')):(1e6*column('seconds')) with linespoints ls monitor('none'), \
  for [i=1:5] table using (along('closeness', 'gamma = '.word(gammas, i))):(1e6*column('seconds')) with linespoints ls family(i)

set yrange [*:*]
set key top left Left reverse font ',7' spacing 1.05 samplen 2 noopaque
eval panel(1, 2, 2, 2)
set title 'seconds of a run, e = 0.9' offset 0, -0.7
set xlabel 'periods'
set xrange [0.8:1300]
set yrange [1e-6:30]; set ytics 100
plot table using (along('periods', 'stationary8')):'seconds' with linespoints ls method('htvi') title 'stationary 8', \
  table using (along('periods', 'stormer_verlet')):'seconds' with linespoints ls method('stormer_verlet') title label('stormer_verlet'), \
  table using (along('periods', 'log_hamiltonian')):'seconds' with linespoints ls method('log_hamiltonian') title 'log. Hamiltonian'
set format x '%g'; set ytics autofreq
eval panel(2, 2, 2, 2)
set title 'µs per expansion' offset 0, -0.7
set xlabel 'Taylor order r'
set xrange [0.9:18]
set yrange [0.08:60]
set xtics (1, 2, 4, 8, 16)
set mxtics 1
eval fitted('order', 'stationary', 'seconds_exponent'); growth = STATS_max
stats table using (along('order', 'stationary')):(1e6*column('seconds')) nooutput
plot STATS_max_y*(x/STATS_max_x)**growth ls guide title sprintf('r^{%.1f}', growth), \
  table using (along('order', 'stationary')):(1e6*column('seconds')) with linespoints ls method('htvi') title 'with derivatives'
eval legend(0.9)
eval box(0.1, page_bottom + cell_h(2) + 0.7, width - 0.2, 0.9)
set key maxrows 2 samplen 2 width 0 font ',8'
plot 2 with linespoints ls monitor('none') title 'fixed step', \
  for [i=1:5] 2 with linespoints ls family(i) title 'γ = '.word(gammas, i), 2 with lines ls guide title 'theory'
unset multiplot
