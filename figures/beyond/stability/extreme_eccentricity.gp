# Steps per orbit of the largest usable step against the distance from e = 1. Left: monitors of HTVI4; right: fixed and
# variable steps of all methods. Grey: the predictions: powers of
# 1 - e, for g = r^1.5 times the elliptic integral that counts equal steps in the integral of r^-1.5 dt.
width = 16; height = 8
load 'figures/style.gp'
table = data.'/extreme_eccentricity.tsv'
set multiplot
page_bottom = 0.47; page_top = 0.898; gap_x = 0.1
eval logx
eval logy
set xrange [2:5e-9]
set yrange [4:5e5]
set xlabel "distance 1 - e from a parabola"
set ylabel "steps per orbit" offset 1, 0
unset key
set xtics (1, 1e-2, 1e-4, 1e-6, 1e-8)
double(x) = strcol('precision') eq 'double' ? x : NaN
K(x) = log(4/sqrt(x/2))
eval panel(1, 1, 2, 1)
set title 'HTVI4, by monitor' offset 0, -0.7
plot 400*(x/0.1)**-1.75 ls guide, 9.5*(x/0.1)**-0.25*K(x)/K(0.1) ls guide, 43*(x/0.1)**-0.5 ls guide, 30*(x/0.1)**-0.75 ls guide, \
  table using (strcol('method') eq 'htvi4' && strcol('monitor') eq 'none' ? double(column('closeness')) : NaN):'steps_per_orbit' with linespoints ls monitor('none'), \
  table using (strcol('monitor') eq 'r' ? double(column('closeness')) : NaN):'steps_per_orbit' with linespoints ls monitor('norm_squared'), \
  table using (strcol('method') eq 'htvi4' && strcol('monitor') eq 'r^1.5' ? double(column('closeness')) : NaN):'steps_per_orbit' with linespoints ls method('htvi'), \
  table using (strcol('monitor') eq 'r^2' && strcol('bounded') eq '0' ? double(column('closeness')) : NaN):'steps_per_orbit' with linespoints ls monitor('truncation'), \
  table using (strcol('monitor') eq 'arclength' ? double(column('closeness')) : NaN):'steps_per_orbit' with linespoints ls family(2), \
  table using (strcol('monitor') eq 'energy' && strcol('bounded') eq '1' ? double(column('closeness')) : NaN):'steps_per_orbit' with linespoints ls monitor('energy'), \
  table using (strcol('monitor') eq 'inverse_lagrangian' ? double(column('closeness')) : NaN):'steps_per_orbit' with linespoints ls monitor('truncation_root')
unset ylabel
set title 'methods' offset 0, -0.7
eval panel(2, 1, 2, 1)
plot 1.15e3*(x/0.1)**-2 ls guide, 350*(x/0.1)**-0.5*K(x)/K(0.1) ls guide, 24 ls guide, \
  table using (strcol('method') eq 'stormer_verlet' ? double(column('closeness')) : NaN):'steps_per_orbit' with linespoints ls method('stormer_verlet'), \
  table using (strcol('method') eq 'adaptive_verlet' ? double(column('closeness')) : NaN):'steps_per_orbit' with linespoints ls family(4), \
  table using (strcol('method') eq 'hairer_soderlind' ? double(column('closeness')) : NaN):'steps_per_orbit' with linespoints ls method('splitting'), \
  table using (strcol('method') eq 'htvi4' && strcol('monitor') eq 'r^1.5' ? double(column('closeness')) : NaN):'steps_per_orbit' with linespoints ls method('htvi'), \
  table using (strcol('method') eq 'log_hamiltonian' ? double(column('closeness')) : NaN):'steps_per_orbit' with linespoints ls method('log_hamiltonian')
eval legend(0.25)
set key maxrows 4 samplen 2 width -1.5 font ',7'
plot 2 with linespoints ls monitor('none') title 'HTVI4, fixed step', \
  2 with linespoints ls monitor('norm_squared') title 'HTVI4, g = r', \
  2 with linespoints ls method('htvi') title 'HTVI4, g = r^{1.5}', \
  2 with linespoints ls monitor('truncation') title 'HTVI4, g = r^2', \
  2 with linespoints ls family(2) title 'HTVI4, arclength', \
  2 with linespoints ls monitor('energy') title 'HTVI4, energy, bounded', \
  2 with linespoints ls monitor('truncation_root') title 'HTVI4, 1/|L|', \
  2 with linespoints ls method('stormer_verlet') title 'Störmer–Verlet', \
  2 with linespoints ls family(4) title 'adaptive Verlet', \
  2 with linespoints ls method('splitting') title 'Hairer–Söderlind', \
  2 with linespoints ls method('log_hamiltonian') title 'log. Hamiltonian', \
  2 with lines ls guide title 'predicted'
unset multiplot
