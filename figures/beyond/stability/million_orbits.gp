# Rounding over very many orbits: the energy errors of sixteen orbits (thin), their root mean square (thick) with the
# square root of time through its first points, and what an orbit costs.
width = 16; height = 6.6
load 'figures/style.gp'
table = data.'/million_orbits.tsv'
growth = data.'/million_orbits_growth.tsv'
summary = data.'/million_orbits_summary.tsv'
set multiplot
page_left = 1.7; page_right = 0.5; page_bottom = 2.0; page_top = 0.65; gap_x = 1.7
unset key
eval logx; eval logy
names_here = 'collocation16 log_hamiltonian10 gsl_rk8pd'
array shown[3] = ['Gauss collocation, order 16', 'log. Hamiltonian, order 10', 'GSL rk8pd, tolerance 10^{-13}']
array look[3] = [black, green, vermilion]
array mark[3] = [7, 9, 5]
array tint[3] = ['#aaaaaa', '#9fdcc9', '#eebf99']
stats growth using (where('method', 'collocation16', 'periods')):(where('method', 'collocation16', 'energy_error')) nooutput
last = STATS_max_x
# Brouwer's line through the root mean squares up to a hundred orbits, of the logarithm.
stats growth using (strcol('method') eq 'collocation16' && column('periods') <= 100 ? log10(column('energy_error')) - 0.5*log10(column('periods')) : NaN) nooutput
begin = 10**STATS_mean
set title 'relative energy error' offset 0, -0.7
set xlabel 'orbits'
set xrange [1:last]; set yrange [1e-17:*]; set ytics 100
eval box(1.7, page_bottom, 8.6, height - page_bottom - page_top)
plot for [k = 1:3] for [s = 0:15] table using (where('method', word(names_here, k), 'periods')):(column('start') == s ? column('energy_error') : NaN) with lines lc rgb tint[k] lw 0.5, \
  for [k = 1:3] growth using (where('method', word(names_here, k), 'periods')):'energy_error' with linespoints lc rgb look[k] lw 2 pt mark[k] ps 0.6 pointinterval 4, \
  begin*sqrt(x) with lines lc rgb purple dt (6,4) lw 3
set title 'at the end, against time' offset 0, -0.7
set xlabel 'microseconds per orbit'
set xrange [1:1000]; set yrange [1e-16:*]
eval box(12.0, page_bottom, 3.5, height - page_bottom - page_top)
plot for [k = 1:3] summary using (where('method', word(names_here, k), 'seconds_per_orbit')*1e6):'energy_error' with points lc rgb look[k] pt mark[k] ps 1.2
unset title
eval legend(0.85)
set key maxrows 2 samplen 2.5 width 0
plot for [k = 1:3] 2 with linespoints lc rgb look[k] lw 2 pt mark[k] title shown[k], 2 with lines lc rgb purple dt (6,4) lw 2.2 title "square root of time (Brouwer's law)"
unset multiplot
