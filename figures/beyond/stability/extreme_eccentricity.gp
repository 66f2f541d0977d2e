# Steps per orbit of the largest usable step against the distance from e = 1. Left: monitors of the stationary construction,
# r = 3 with four Gauss nodes (order 8); right: fixed and variable steps of all methods (collocation is of order 16). Grey, drawn through the last point: the predicted powers of
# 1 - e, for g = r^1.5 times the elliptic integral that counts equal steps in the integral of r^-1.5 dt.
width = 16; height = 7
load 'figures/style.gp'
table = data.'/extreme_eccentricity.tsv'
double(x) = strcol('precision') eq 'double' ? x : NaN
# A curve: its points as 1 - e (`bounded` 0 or 1).
along(m, g, b) = strcol('method') eq m && strcol('monitor') eq g && strcol('bounded') eq b ? double(column('closeness')) : NaN
curve(m, g, b, style) = sprintf("table using (along('%s', '%s', '%d')):'steps_per_orbit' with linespoints ls %d", m, g, b, style)
# Its prediction: the column predicted_exponent, drawn through the last point; equal steps in the integral of r^-1.5 dt are
# besides K(1 - e) to an orbit.
K(x) = log(4/sqrt(x/2))
prediction(m, g) = sprintf("stats table using (along('%s', '%s', '0')):'steps_per_orbit' nooutput; from = STATS_min_x; steps = STATS_max_y;", m, g) \
  .sprintf("stats table using (along('%s', '%s', '0') > 0 ? column('predicted_exponent') : NaN) nooutput; power = STATS_max;", m, g) \
  .sprintf("guides = guides.sprintf('%%g*(x/%%g)**%%g%s ls guide, ', steps%s, from, power)", g eq 'r^1.5' ? '*K(x)' : '', g eq 'r^1.5' ? '/K(from)' : '')
guides = ''
do for [g in 'none r r^1.5 r^2'] { eval prediction('stationary8', g) }
of_monitors = guides; guides = ''
eval prediction('stormer_verlet', 'none')
eval prediction('hairer_soderlind', 'r^1.5')
eval prediction('log_hamiltonian', '1/V')
eval prediction('collocation16', 'r^1.5')
set multiplot
page_bottom = 3.05; page_top = 0.65; gap_x = 1.3
eval logx
eval logy
set xrange [2:5e-9]
set yrange [1:5e5]
set xlabel "distance 1 − e from a parabola"
set ylabel "steps per orbit" offset 0, 0
unset key
set xtics (1, 1e-2, 1e-4, 1e-6, 1e-8)
eval panel(1, 1, 2, 1)
set title 'by monitor' offset 0, -0.7
# g = r lies under energy and 1/|L|: a broad band beneath them.
set style line 99 lc rgb '#e4b4cd' dt 1 lw 7 pt 0
eval 'plot '.of_monitors.curve('stationary8', 'r', 0, 99).', '.curve('stationary8', 'none', 0, monitor('none')).', ' \
  .curve('stationary8', 'r^1.5', 0, method('htvi')).', '.curve('stationary8', 'r^2', 0, monitor('truncation')).', ' \
  .curve('stationary8', 'arclength', 0, family(2)).', '.curve('stationary8', 'energy', 1, monitor('energy')).', ' \
  .curve('stationary8', 'inverse_lagrangian', 0, monitor('truncation_root'))
unset ylabel
set title 'methods' offset 0, -0.7
eval panel(2, 1, 2, 1)
eval 'plot '.guides.curve('stormer_verlet', 'none', 0, method('stormer_verlet')).', '.curve('adaptive_verlet', 'r^1.5', 0, family(4)).', ' \
  .curve('hairer_soderlind', 'r^1.5', 0, method('splitting')).', '.curve('stationary8', 'r^1.5', 0, method('htvi')).', ' \
  .curve('log_hamiltonian', '1/V', 0, method('log_hamiltonian')).', '.curve('collocation16', 'r^1.5', 0, method('collocation')).', ' \
  .curve('collocation16', 'none', 0, family(1))
eval legend(1.95)
key_box(i) = box(0.1 + (i - 1)*0.5*width, 0.1, 0.5*width - 0.2, 1.95)
eval key_box(1)
set key maxrows 4 samplen 1.8
plot 2 with linespoints ls monitor('none') title 'fixed step', \
  2 with linespoints ls 99 title 'g = |q|', \
  2 with linespoints ls method('htvi') title 'g = |q|^{1.5}', \
  2 with linespoints ls monitor('truncation') title 'g = |q|^2', \
  2 with linespoints ls family(2) title 'arclength', \
  2 with linespoints ls monitor('energy') title 'energy', \
  2 with linespoints ls monitor('truncation_root') title '1/|L|', \
  2 with lines ls guide title 'predicted'
eval key_box(1.97)
plot 2 with linespoints ls method('stormer_verlet') title 'Störmer–Verlet', \
  2 with linespoints ls family(4) title 'adaptive Verlet', \
  2 with linespoints ls method('splitting') title 'Hairer–Söderlind', \
  2 with linespoints ls method('htvi') title 'stationary 8, g = |q|^{1.5}', \
  2 with linespoints ls method('log_hamiltonian') title 'log. Hamiltonian', \
  2 with linespoints ls family(1) title 'collocation, fixed step', \
  2 with linespoints ls method('collocation') title 'collocation, g = |q|^{1.5}', \
  2 with lines ls guide title 'predicted'
unset multiplot
