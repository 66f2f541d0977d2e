# data: long_runs
# Energy error over a million steps of the Henon-Heiles model and a thousand periods of the figure-eight orbit: HTVI,
# and the Runge-Kutta method of order 4 at the same step.
width = 17; height = 12
load 'figures/style.gp'
curves = data.'/long_runs_curves.tsv'
problems = 'henon_heiles_regular henon_heiles_chaotic figure_eight'
array titles[3] = ['Hénon–Heiles, regular orbit', 'Hénon–Heiles, chaotic orbit', 'figure eight']
set multiplot
page_left = 0.115; page_right = 0.975; page_bottom = 0.16; gap_x = 0.1; gap_y = 0.13; page_top = 0.93
unset key
set format y '%.0e'
energy(p, m, c) = strcol('problem') eq p && strcol('method') eq m ? column(c) : NaN
do for [i=1:3] {
  p = word(problems, i)
  set title titles[i].', HTVI' offset 0, -0.6
  if (i == 3) { set xlabel 'time' } else { unset xlabel }
  set xtics autofreq
  set ylabel 'energy error'
  eval panel(1, i, 2, 3)
  plot curves using (energy(p, 'htvi', 't')):(energy(p, 'htvi', 'energy_error')) with points pt 7 ps 0.3 lc rgb blue
  set title titles[i].', Runge–Kutta 4' offset 0, -0.6
  unset ylabel
  eval panel(2, i, 2, 3)
  plot curves using (energy(p, 'runge_kutta_4', 't')):(energy(p, 'runge_kutta_4', 'energy_error')) with points pt 7 ps 0.3 lc rgb vermilion
}
unset multiplot
