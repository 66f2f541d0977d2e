# Physical steps of adaptive symplectic Euler-B for its monitors, all at the same energy error.
width = 16; height = 5.2
load 'figures/style.gp'
curve = data.'/euler_b_step_sizes_curve.tsv'
set multiplot
page_bottom = 2.05
eval panel(1, 1, 1, 1)
eval logy
set xrange [0:13]
set xlabel 'time (one period is 2π)'
set ylabel 'step Δt' offset 1, 0
unset key
# q^T q lies on the truncation error: a broad line below, a thin one on it.
broad = 'lw 5'
plot curve using (where('monitor', 'truncation', 't')):'step' with lines ls monitor('truncation') dt 1 @broad, \
  curve using (where('monitor', 'norm_squared', 't')):'step' with lines ls monitor('norm_squared') lc rgb black dt 1 lw 1, \
  for [m in 'arclength truncation_root'] curve using (where('monitor', m, 't')):'step' with lines ls monitor(m)
eval legend(0.9)
set key maxrows 2
plot curve using (20):(2) with lines ls monitor('truncation') dt 1 @broad title label('truncation'), \
  curve using (20):(2) with lines ls monitor('norm_squared') lc rgb black dt 1 lw 1 title label('norm_squared').' (on the same curve)', \
  for [m in 'arclength truncation_root'] curve using (20):(2) with lines ls monitor(m) title label(m)
unset multiplot
