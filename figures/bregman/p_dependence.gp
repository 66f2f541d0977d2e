# The largest f from there on along HTVI runs as p grows and as p̊ falls; the order P = p^2/p̊ sorts both.
width = 16; height = 4.7
load 'figures/style.gp'
curves = data.'/p_dependence_curves.tsv'

set multiplot
page_left = 1.85; page_bottom = 1.15; page_top = 0.65; gap_x = 0.65
eval logx; eval logy
set xrange [1:2e5]; set yrange [1e-18:1e10]
set xlabel 'iterations'
set key bottom left Left reverse samplen 2.5
hue(i) = word('#0072b2 #d55e00 #009e73 #cc79a7', i)
run(p, q, y) = also('p', p, also('p_ring', q, y))
tenth = '0.10000000000000001'  # as the file prints 0.1
readable(q) = q eq tenth ? '0.1' : q
order(p, q) = sprintf('P = %g', real(p)**2/real(q))
eval panel(1, 1, 2, 1)
set title 'p̊ = 1, p grows' offset 0, -0.7
set ylabel 'f − f*'
plot for [p in '2 4 6 8'] curves using (run(p, '1', column('iteration'))):'envelope' with lines lc rgb hue(int(real(p)/2)) lw 1.6 \
  title 'p = '.p.', '.order(p, '1')
eval panel(2, 1, 2, 1)
set title 'p = 4, p̊ falls' offset 0, -0.7
set ylabel ''; set format y ''
rings = '2 1 0.5 '.tenth
plot for [i = 1:4] curves using (run('4', word(rings, i), column('iteration'))):'envelope' with lines lc rgb hue(i) lw 1.6 \
  title 'p̊ = '.readable(word(rings, i)).', '.order('4', word(rings, i))
unset multiplot
