# Where Bregman dynamics break. Left: the time at which each form of the HTVI leaves double precision, against what its
# formula says (lines). Right: the largest stable step over linear theory, sqrt(C lambda) P h t^(p/2-s) < 2 for HTVI (classical
# Runge–Kutta is higher: below its limit it damps; HTVI, splitting and cloning lie on one another at 1).
width = 16; height = 4.8
load 'figures/style.gp'
ends = data.'/bregman_extremes_overflow.tsv'
limits = data.'/bregman_extremes_limits.tsv'
set multiplot
page_left = 1.75; page_bottom = 1.1; page_top = 0.6; gap_x = 2.1; gap_y = 1.6
set key font ',7' samplen 2 spacing 1.05 noopaque

# Direct family only: p_ring = p.
direct(y) = column('p') == column('p_ring') ? y : NaN
form(f, y) = strcol('form') eq f ? y : NaN
forms = 'printed momentum heavy_ball'
array form_title[3] = ['as printed, h t^{2p−1}', 'momentum, t^p', 'heavy ball, h^2 t^{p−2}']
array look[3] = [vermilion, blue, black]
array mark[3] = [5, 7, 6]
array size[3] = [0.8, 0.6, 1.3]
eval panel(1, 1, 2, 1)
eval logx
set format x '%g'
set xrange [1.7:60]; set xtics (2, 4, 10, 20, 50)
set yrange [2:900]; eval logy; set format y '%g'
set xlabel 'p' offset 0, 0.5
set ylabel 'decimal exponent of t' offset 0.5, 0
set title 'Overflow, Direct' offset 0, -0.7
set key top right
plot for [i = 1:3] ends using (form(word(forms, i), direct(column('p')))):'log10_t_expected' with lines lc rgb look[i] lw 1 notitle, \
  for [i = 1:3] ends using (form(word(forms, i), direct(column('p')))):'log10_t_end' with points lc rgb look[i] pt mark[i] ps size[i] title form_title[i]

eval panel(2, 1, 2, 1)
set xrange [0.8:60]; set xtics (1, 2, 4, 10, 20, 50)
unset logscale y; unset mytics; set yrange [0.99:1.2]
set format y '%.2f'
set ylabel 'h / linear theory' offset 0.5, 0
set title 'Largest stable step' offset 0, -0.7
set key top left Left reverse
by(m, y) = strcol('method') eq m ? y : NaN
plot 1 with lines ls guide notitle, \
  for [m in 'clone_y6 clone_y4 clone_strang splitting htvi'] limits using (by(m, direct(column('p')))):'ratio' with points ls method('htvi') title m eq 'htvi' ? 'all others' : '', \
  limits using (by('runge_kutta_4', direct(column('p')))):'ratio' with points ls method('runge_kutta_4') title label('runge_kutta_4')
unset multiplot
