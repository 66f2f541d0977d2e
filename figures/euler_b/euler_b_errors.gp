# Symplectic Euler-B with fixed and with adaptive steps, equally many of them: errors in time.
width = 16; height = 6.2
load 'figures/style.gp'
curve = data.'/euler_b_errors_curve.tsv'
shown = 'none truncation'
named(m) = m eq 'none' ? 'fixed steps' : 'adaptive, monitor: truncation error'

set multiplot
page_left = 1.9; page_bottom = 1.15; gap_y = 0.35
eval logy
set xrange [0:100]
eval panel(1, 1, 1, 2)
set ylabel 'energy error' offset 1, 0
set format x ''
set key top right vertical
set yrange [1e-6:1e3]; set ytics 100
plot for [m in shown] curve using (where('monitor', m, 't')):'energy_error' with lines ls monitor(m) dt 1 lw 1.2 title named(m)
eval panel(1, 2, 1, 2)
set ylabel 'ang. mom. error' offset 1, 0
set xlabel 'time (one period is 2π)'
set format x '%g'
unset key
set yrange [1e-17:1e-11]; set ytics 100
plot for [m in shown] curve using (where('monitor', m, 't')):'angular_momentum_error' with lines ls monitor(m) dt 1 lw 1.2
unset multiplot
