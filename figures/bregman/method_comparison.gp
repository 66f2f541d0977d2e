# f against gradient evaluations for the symplectic integrators at p = 4: the largest f from there on; markers show where
# the stopping test first holds. Gradients that only the stopping test needs are counted.
width = 16; height = 5.2
load 'figures/style.gp'
curves = data.'/method_comparison_curves.tsv'
table = data.'/method_comparison.tsv'
shown = 'htvi splitting clone_strang clone_y4 clone_y6'

set multiplot
page_left = 1.85; page_bottom = 2.05; page_top = 0.65; gap_x = 0.65
eval logx; eval logy
set xlabel 'gradient evaluations'
unset key
set label 1 'first passage' at graph 0.03, 0.06 font ',7' textcolor rgb '#606060'
is(m, a, y) = also('method', m, also('approach', a, y))
set xrange [10:2e6]; set yrange [1e-14:1e10]
do for [a in 'direct adaptive'] {
  set ylabel a eq 'direct' ? 'f − f*' : ''
  if (a eq 'adaptive') { set format y '' }
  eval panel(a eq 'direct' ? 1 : 2, 1, 2, 1)
  set title label(a).(a eq 'adaptive' ? ', p = 4, p̊ = 1' : ', p = 4') offset 0, -0.7
  plot for [m in shown] curves using (is(m, a, column('gradient_evaluations'))):'envelope' with lines ls method(m) lw 1.5, \
    for [m in shown] table using (also('converged', '1', is(m, a, column('gradient_evaluations')))):(1e-13) \
      with points ls method(m) ps 1.1
}
eval legend(0.9)
set key maxrows 2 samplen 2 width -4
plot 2 notitle, for [m in shown] keyentry with linespoints ls method(m) lw 1.5 title label(m)
unset multiplot
