# Steps and time that symplectic Euler-B needs for a given energy error over T = 100, by monitor.
width = 16; height = 5.6
load 'figures/style.gp'
cost = data.'/euler_b_cost.tsv'
shown = 'none truncation_root arclength truncation norm_squared'
set multiplot
page_bottom = 2.05; gap_x = 0.65
eval logx; eval logy
unset key
set offsets graph 0.06, graph 0.06, graph 0.06, graph 0.06
set ylabel 'largest energy error' offset 1, 0
set xlabel 'steps'
eval panel(1, 1, 2, 1)
plot for [m in shown] cost using (where('monitor', m, 'steps')):'energy_error' with linespoints ls monitor(m)
unset ylabel; set format y ''
set yrange [GPVAL_Y_MIN:GPVAL_Y_MAX]
set xlabel 'seconds'
eval panel(2, 1, 2, 1)
plot for [m in shown] cost using (where('monitor', m, 'seconds')):'energy_error' with linespoints ls monitor(m)
eval legend(0.9)
set key maxrows 2 width -3
plot for [m in shown] cost using (2):(2) with linespoints ls monitor(m) title label(m)
unset multiplot
