# Energy error, in means over a thousandth of the run, for a million steps of the Henon-Heiles model and a thousand
# periods of the figure-eight orbit: HTVI, and the Runge-Kutta method of order 4 at the same step.
width = 16; height = 4.8
load 'figures/style.gp'
curves = data.'/long_runs_curves.tsv'
problems = 'henon_heiles_regular henon_heiles_chaotic figure_eight'
array titles[3] = ['Hénon–Heiles, regular', 'Hénon–Heiles, chaotic', 'figure eight']
array ends[3] = [2e5, 2e5, 6516]
set multiplot
page_left = 2.1; page_right = 0.5; page_bottom = 1.65; page_top = 0.65
unset key
eval logy; set ytics 100
set xlabel 'time / end of the run'
set xrange [0:1]; set xtics 0.5
energy(p, m) = strcol('problem') eq p && strcol('method') eq m ? abs(column('energy_error')) : NaN
do for [i=1:3] {
  p = word(problems, i)
  set title titles[i] offset 0, -0.6
  if (i == 1) { set ylabel 'relative energy error' offset 0.4, 0 } else { unset ylabel }
  eval panel(i, 1, 3, 1)
  plot for [m in 'htvi runge_kutta_4'] curves using (column('t') / ends[i]):(energy(p, m)) with points pt 7 ps 0.35 lc rgb (m eq 'htvi' ? blue : black)
}
eval legend(0.5)
set key maxrows 1
plot 2 with points pt 7 lc rgb blue title 'stationary HTVI, order 4, 4, 6', 2 with points pt 7 lc rgb black title 'Runge–Kutta 4, same step'
unset multiplot
