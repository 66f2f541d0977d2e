# Physical steps of HTVI4 at the settings of Table 1: in time, and against the distance from the centre.
width = 16; height = 5
load 'figures/style.gp'
curve = data.'/htvi4_step_sizes.tsv'
shown = 'gamma energy arclength'
set multiplot
page_bottom = 1.65; gap_x = 0.8
eval logy
unset key
set yrange [1e-3:0.4]
set ylabel 'step Δt' offset 1, 0
set xlabel 'time (one period is 2π)'
set xrange [0:10.3]
eval panel(1, 1, 2, 1)
plot for [m in shown] curve using (where('monitor', m, 't')):'step' with linespoints ls monitor(m) ps 0.35 lw 1
unset ylabel; set format y ''
eval logx
set xlabel 'distance |q| at the end of the step'
set xrange [0.08:2.5]; set xtics (0.1, 0.2, 0.5, 1, 2); set format x '%g'
eval panel(2, 1, 2, 1)
plot for [m in shown] curve using (where('monitor', m, 'radius')):'step' with points ls monitor(m) ps 0.45
eval legend(0.5)
set key maxrows 1
plot for [m in shown] curve using (2):(2) with linespoints ls monitor(m) title label(m)
unset multiplot
