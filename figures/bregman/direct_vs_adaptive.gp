# f along the runs of the paper's first optimisation table: lines are the largest f from there on, bands hold the
# oscillations below; markers show where the stopping test first holds.
width = 16; height = 5.2
load 'figures/style.gp'
curves = data.'/direct_vs_adaptive_curves.tsv'
table = data.'/direct_vs_adaptive.tsv'

set multiplot
page_left = 1.85; page_bottom = 2.05; page_top = 0.65; gap_x = 0.65
eval logx; eval logy
set xrange [1:2e5]; set yrange [1e-16:1e10]
set xlabel 'iterations'
unset key
set label 1 'first passage' at graph 0.03, 0.06 font ',7' textcolor rgb '#606060'
is(m, a, y) = also('method', m, also('approach', a, y))
dash(p) = p eq '4' ? 1 : 2
tint(a) = a eq 'direct' ? vermilion : blue
do for [m in 'htvi clone_y4'] {
  set ylabel m eq 'htvi' ? 'f − f*' : ''
  if (m eq 'clone_y4') { set format y '' }
  eval panel(m eq 'htvi' ? 1 : 2, 1, 2, 1)
  set title label(m) offset 0, -0.7
  plot for [a in 'direct adaptive'] for [p in '4 10'] curves using (is(m, a, also('p', p, column('iteration')))):'least':'envelope' \
      with filledcurves fc rgb tint(a) fs transparent solid 0.15 noborder, \
    for [a in 'direct adaptive'] for [p in '4 10'] curves using (is(m, a, also('p', p, column('iteration')))):'envelope' \
      with lines ls approach(a) dt dash(p) lw 1.5, \
    for [a in 'direct adaptive'] for [p in '4 10'] table using (is(m, a, also('p', p, column('iterations')))):(1e-15) with points ls approach(a) pt (a eq 'adaptive' ? 7 : 5) - (p eq '10' ? 1 : 0) ps 1
}
eval legend(0.9)
set key maxrows 2 samplen 2 width -3
plot 2 notitle, for [a in 'direct adaptive'] for [p in '4 10'] keyentry with linespoints ls approach(a) dt dash(p) lw 1.5 pt (a eq 'adaptive' ? 7 : 5) - (p eq '10' ? 1 : 0) ps 1 \
  title label(a).', p = '.p.(a eq 'adaptive' ? ', p̊ = 0.5' : '')
unset multiplot
