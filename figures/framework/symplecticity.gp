# How far one step is from a symplectic map: rounding for the adaptive integrators, on extended phase space too, and
# the three flows, h^3 for the printed splitting with its r^t.
width = 16; height = 6
load 'figures/style.gp'
file = data.'/symplecticity.tsv'
set multiplot
page_bottom = 1.15; gap_x = 0.65; page_top = 0.7
eval logx; eval logy
set xlabel 'fictive step h' offset 0, 0.3
set yrange [1e-16:1]; set ytics 1e4
is(p, m, v) = also('problem', p, also('method', m, also('variables', v, column('defect'))))
set title "Kepler's problem" offset 0, -0.6
set ylabel 'defect of one step'
set xrange [0.007:0.25]
set key top left Left reverse samplen 2.5
eval panel(1, 1, 2, 1)
plot file using 'h':(is('kepler', 'htvi4', 'q p')) with linespoints ls method('htvi4') title 'HTVI4, gamma, in (q, p)', \
  file using 'h':(is('kepler', 'htvi4', 'q t p p^t')) with linespoints ls monitor('none') title 'the same in (q, t, p, p^t)', \
  file using 'h':(is('kepler', 'symplectic_euler_b', 'q p')) with linespoints ls monitor('norm_squared') title 'Euler-B, q^Tq, in (q, p), step h/4'
set title 'Bregman dynamics, in (q, t, r, r^t)'
unset ylabel; set format y ''
set xrange [0.0009:0.03]
set key at graph 1, 0.63 right top font ',7' spacing 1.0
eval panel(2, 1, 2, 1)
plot file using 'h':(is('bregman', 'splitting', 'q t r r^t')) with linespoints ls method('splitting') title 'printed splitting', \
  3e2*x**3 with lines ls guide title 'h^3', \
  file using 'h':(is('bregman', 'splitting', 'q r')) with linespoints ls method('clone_strang') title 'its (q, r) block', \
  file using 'h':(is('bregman', 'three_flows', 'q t r r^t')) with linespoints ls method('clone_y4') title 'the three exact flows', \
  file using 'h':(is('bregman', 'htvi', 'q t r r^t')) with linespoints ls method('htvi') title 'HTVI'
unset multiplot
