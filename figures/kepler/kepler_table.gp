# A table of HTVI4 and Stormer-Verlet runs (columns of the data contract) beside the paper's cells: energy error above,
# global error below; steps on the left, time in units of the same source's Stormer-Verlet on the right.
# Needs `stem`.
width = 16; height = 7.6
load 'figures/style.gp'
ours = data.'/'.stem.'.tsv'

# The paper's cells, row by row: [steps, seconds, energy_error, global_error].
rows = 5
array row[rows] = ['HTVI4 gamma', 'HTVI4 energy', 'HTVI4 arclength', 'HTVI4 none', 'SV']
array steps[rows]; array seconds[rows]; array energy_error[rows]; array global_error[rows]
cell(i, q) = strcol('row') eq row[i] && strcol('quantity') eq q ? column('published') : NaN
do for [i = 1:rows] {
  stats paper(stem) using (cell(i, 'steps')) nooutput; steps[i] = STATS_max
  stats paper(stem) using (cell(i, 'seconds')) nooutput; seconds[i] = STATS_max
  stats paper(stem) using (cell(i, 'energy_error')) nooutput; energy_error[i] = STATS_max
  stats paper(stem) using (cell(i, 'global_error')) nooutput; global_error[i] = STATS_max
}
stats ours using (where('method', 'stormer_verlet', 'seconds')) nooutput; unit = STATS_max

# Looks: a monitor's colour and marker; open for the construction as printed, filled for the authors' own.
tried = 'gamma energy arclength none'
look(i) = i == rows ? method('stormer_verlet') : monitor(word(tried, i))
filled(i) = i == rows ? 2 : i == 1 ? 7 : i == 2 ? 9 : i == 3 ? 5 : 13
of(i, c, y) = i == rows ? also('method', 'stormer_verlet', y) \
  : also('construction', c, also('rule', c eq 'stationary' ? 'gauss4' : 'simpson', also('monitor', word(tried, i), y)))
htvi(i, y) = column('r') == 3 && (strcol('construction') eq 'stationary') == (strcol('rule') eq 'gauss4') ? also('monitor', word(tried, i), y) : NaN

# One point at given coordinates: `plot $here using (x):(y)`.
$here << EOD
x
0
EOD

set multiplot
page_bottom = 2.3; gap_y = 0.35; gap_x = 0.65
unset key
eval logx; eval logy
set offsets graph 0.07, graph 0.07, graph 0.09, graph 0.09
power = '10^{%L}'
do for [error in 'energy_error global_error'] {
  bottom = error eq 'global_error'
  published_error(i) = bottom ? global_error[i] : energy_error[i]
  set ylabel bottom ? 'position error' : 'energy error' offset 1, 0
  set format x bottom ? power : ''
  set xlabel bottom ? 'steps' : ''
  set format y power; set ytics 100; set yrange [*:*]
  eval panel(1, bottom ? 2 : 1, 2, 2)
  plot for [i = 1:rows-1] ours using (htvi(i, column('steps'))):error with lines ls look(i) dt 1 lw 0.8, \
    for [i = 1:rows-1] ours using (of(i, 'printed', column('steps'))):error with points ls look(i) pt filled(i)-1 ps 0.8, \
    for [i = 1:rows-1] ours using (of(i, 'stationary', column('steps'))):error with points ls look(i) pt 1 ps 0.8, \
    for [i = 1:rows] ours using (of(i, 'authors', column('steps'))):error with points ls look(i) pt filled(i) ps 0.9, \
    for [i = 1:rows] $here using (steps[i]):(published_error(i)) with points ls published
  set xlabel bottom ? "time in units of Störmer–Verlet's" : ''
  unset ylabel; set format y ''
  set yrange [GPVAL_Y_MIN:GPVAL_Y_MAX]
  eval panel(2, bottom ? 2 : 1, 2, 2)
  plot for [i = 1:rows] ours using (of(i, 'authors', column('seconds')/unit)):error:(seconds[i]/seconds[rows]-column('seconds')/unit):(0) \
      with vectors nohead ls guide dt (2,4) notitle, \
    for [i = 1:rows] ours using (of(i, 'authors', column('seconds')/unit)):error with points ls look(i) pt filled(i) ps 0.9, \
    for [i = 1:rows] $here using (seconds[i]/seconds[rows]):(published_error(i)) with points ls published
}
eval legend(1.25)
set key samplen 1.5 maxrows 3 width -5
plot for [i = 1:rows] $here using (2):(2) with points ls look(i) pt filled(i) title \
    i == rows ? 'Störmer–Verlet' : 'HTVI4, '.label(word(tried, i)), \
  $here using (2):(2) with points ls published title 'in the paper', \
  $here using (2):(2) with points ls published lc rgb grey pt 4 ps 0.8 title 'as printed', \
  $here using (2):(2) with points ls published lc rgb grey pt 1 ps 0.8 title 'stationary, r = 3, Gauss 4'
unset multiplot
