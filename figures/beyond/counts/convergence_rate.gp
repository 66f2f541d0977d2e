# f along the exact Bregman dynamics (Direct), at the upper ends of its oscillation, beside the bound E(t_0) / (C t^p)
# from its Lyapunov function and the rate t^(-2p) of a quartic.
width = 16; height = 5.8
load 'figures/style.gp'
curves = data.'/convergence_rate_curves.tsv'
set multiplot
page_bottom = 2.05
eval logx; eval logy
set xrange [1:1.5e4]; set yrange [1e-9:1e11]
set xlabel 'time t'
set ylabel 'f(x(t)) − f*'
unset key
eval panel(1, 1, 1, 1)
shown = '2 4 6 10'
hue(i) = word('#0072b2 #d55e00 #009e73 #cc79a7', i)
# Through the last point of each curve.
array last[4]
do for [i = 1:4] { stats curves using (where('p', word(shown, i), 't')) nooutput; last[i] = STATS_max }
# Bounds last and dotted in their colours: that of p = 4 runs along the solution of p = 2.
plot for [i = 1:4] curves using (where('p', word(shown, i), 't')):'most' with lines lc rgb hue(i) dt 1 lw 1.8, \
  for [i = 1:4] curves using (where('p', word(shown, i), 't')):'bound' with lines lc rgb hue(i) dt (2,6) lw 2.4, \
  for [i = 1:4] [t=1:1.5e4] (t > last[i]/30 && t < last[i] ? 3e-8*(t/last[i])**(-2*real(word(shown, i))) : NaN) with lines lc rgb black dt (10,3) lw 1
eval legend(0.9)
set key maxrows 2 width -3
plot 2 notitle, for [i = 1:4] keyentry with lines lc rgb hue(i) lw 1.8 title 'p = '.word(shown, i), \
  keyentry with lines lc rgb grey dt (2,6) lw 2.4 title 'bound E(t_0)/(C t^p)', keyentry with lines lc rgb black dt (10,3) title 'slope t^{−2p}'
unset multiplot
