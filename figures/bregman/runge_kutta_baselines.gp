# Runge–Kutta methods on Bregman dynamics, p = 10, p̊ = 0.5. Above: the largest f from there on against accepted steps,
# pairs at MATLAB's default tolerances; below: gradient evaluations until the stopping test holds for good, over the tolerance.
width = 16; height = 8.8
load 'figures/style.gp'
curves = data.'/runge_kutta_baselines_curves.tsv'
table = data.'/runge_kutta_baselines.tsv'
shown = 'htvi runge_kutta_4 dormand_prince bogacki_shampine'
pairs = 'dormand_prince bogacki_shampine gsl_rkf45 gsl_rk8pd'
look(m) = m eq 'gsl_rkf45' ? family(3) : m eq 'gsl_rk8pd' ? family(4) : method(m)
named(m) = m eq 'gsl_rkf45' ? 'GSL, Fehlberg 4(5)' : m eq 'gsl_rk8pd' ? 'GSL, Prince–Dormand 8' : label(m)

set multiplot
page_left = 2; page_bottom = 2.05; page_top = 0.65; gap_x = 0.65; gap_y = 1.3
eval logx; eval logy
is(m, a, y) = also('method', m, also('approach', a, y))
# Gradients in proportion to the iterations until the test holds for good; NaN where it did not.
reached(m, a, y) = also('converged', '1', is(m, a, y))
for_good = "column('gradient_evaluations')/column('iterations')*column('sustained')"
unset key
do for [a in 'direct adaptive'] {
  i = a eq 'direct' ? 1 : 2
  set title label(a).(i == 2 ? ', p = 10, p̊ = 0.5' : ', p = 10') offset 0, -0.7
  set format y i == 1 ? '10^{%L}' : ''
  set xlabel 'iterations (accepted steps)' offset 0, 0.4
  set ylabel i == 1 ? 'f − f*' : ''
  set xrange [1:9e4]; set yrange [1e-13:1e10]
  eval panel(i, 1, 2, 2)
  plot for [m in shown] curves using (is(m, a, column('iteration'))):'envelope' with lines ls method(m) lw 1.5
  unset title
  set xlabel 'relative tolerance' offset 0, 0.4
  set ylabel i == 1 ? 'gradients, for good' : '' offset 0.3, 0
  set autoscale
  stats table using (reached('htvi', a, @for_good)) nooutput; least_htvi = STATS_min
  stats table using (reached('runge_kutta_4', a, @for_good)) nooutput; least_rk4 = STATS_min
  set xrange [5e-7:2e-2]; set yrange [3e3:2e6]
  eval panel(i, 2, 2, 2)
  plot for [m in pairs] table using (reached(m, a, column('rtol'))):(@for_good) with linespoints ls look(m) lw 1.2, \
    least_htvi with lines ls method('htvi') lw 1.5, least_rk4 with lines ls method('runge_kutta_4') lw 1.5
}
eval legend(0.9)
set key maxrows 2
plot 2 notitle, for [m in shown] keyentry with linespoints ls method(m) title named(m), \
  for [m in 'gsl_rkf45 gsl_rk8pd'] keyentry with linespoints ls look(m) title named(m)
unset multiplot
