# Where Bregman dynamics break. Top: the time at which each form of the HTVI leaves double precision, against what its
# formula says (lines); the largest stable step over linear theory, sqrt(C lambda) P h t^(p/2-s) < 2 for HTVI (Runge-
# Kutta 4 is higher: below its limit it damps). Middle: iterations as Sigma becomes singular, and over the dimension
# (open: the cap came first). Below: iterations over the distance of the start, and how the runs of each kind ended.
width = 16; height = 12.6
load 'figures/style.gp'
ends = data.'/bregman_extremes_overflow.tsv'
limits = data.'/bregman_extremes_limits.tsv'
table = data.'/bregman_extremes.tsv'
verdicts = data.'/bregman_extremes_verdicts.tsv'
set multiplot
page_left = 1.75; page_bottom = 1.1; page_top = 0.6; gap_x = 2.1; gap_y = 1.6
set key font ',7' samplen 2 spacing 1.05 noopaque

# Direct family only: p_ring = p.
direct(y) = column('p') == column('p_ring') ? y : NaN
form(f, y) = strcol('form') eq f ? y : NaN
forms = 'printed momentum heavy_ball'
array form_title[3] = ['as printed, t^{2p-1}', 'momentum, t^p', 'heavy ball, log t']
eval panel(1, 1, 2, 3)
eval logx
set format x '%g'
set xrange [1.7:60]; set xtics (2, 4, 10, 20, 50)
set yrange [2:900]; eval logy; set format y '%g'
set xlabel 'p' offset 0, 0.5
set ylabel 'log_{10} t at overflow' offset 0.5, 0
set title 'Overflow, Direct' offset 0, -0.7
set key top right
plot for [i = 1:3] ends using (form(word(forms, i), direct(column('p')))):'log10_t_expected' with lines ls family(i*2-1) lw 1 notitle, \
  for [i = 1:3] ends using (form(word(forms, i), direct(column('p')))):'log10_t_end' with points ls family(i*2-1) ps 0.8 title form_title[i]

eval panel(2, 1, 2, 3)
set xrange [0.8:60]; set xtics (1, 2, 4, 10, 20, 50)
unset logscale y; unset mytics; set yrange [0.99:1.2]
set format y '%.2f'
set ylabel 'h / linear theory' offset 0.5, 0
set title 'Largest stable step' offset 0, -0.7
set key top left Left reverse
by(m, y) = strcol('method') eq m ? y : NaN
plot 1 with lines ls guide notitle, \
  for [m in 'runge_kutta_4 clone_y6 clone_y4 clone_strang splitting htvi'] limits using (by(m, direct(column('p')))):'ratio' with points ls method(m) title label(m)

eval panel(1, 2, 2, 3)
set xrange [3e-9:0.3]; eval logx; set xtics 1e-8, 100; set mxtics 1
set yrange [1e4:1e5]; eval logy; set ytics auto
set xlabel '1 − ρ' offset 0, 0.5
set ylabel 'iterations' offset 0.5, 0
set title 'Ill-conditioned Σ' offset 0, -0.7
set key bottom left
run_of(s, p_, y) = strcol('scene') eq s && strcol('method') eq 'htvi' && column('p') == p_ ? y : NaN
held(o, s, p_, y) = strcol('verdict') eq o ? run_of(s, p_, y) : NaN
name_of(p_) = p_ == 4 ? 'Adaptive 4, 1' : 'Adaptive 10, 0.5'
plot for [p_ in '4 10'] table using (held('correct', 'conditioning', p_+0, column('one_less_rho'))):'iterations' with linespoints ls (p_+0 == 4 ? method('adam') : method('htvi')) title name_of(p_+0)

eval panel(2, 2, 2, 3)
set xrange [0.7:2e7]; set xtics 1, 100, 1e6
set yrange [5:1e8]; set ytics 100
set ylabel offset 0.5, 0
set xlabel 'dimension' offset 0, 0.5
set title 'Dimension' offset 0, -0.7
set key at graph 0.03, 0.98 left top Left reverse
plot for [p_ in '4 10'] table using (held('correct', 'dimension', p_+0, column('dimension'))):'iterations' with linespoints ls (p_+0 == 4 ? method('adam') : method('htvi')) title name_of(p_+0), \
  for [p_ in '4 10'] table using (held('named', 'dimension', p_+0, column('dimension'))):'iterations' with points lc rgb grey pt 6 ps 0.9 title (p_+0 == 4 ? 'cap first' : '')

eval panel(1, 3, 2, 3)
set xrange [3e-7:3e6]; set xtics 1e-6, 1000, 1e6
set yrange [0.5:1e6]; set ytics 100
set xlabel '|x_0 − x^*|_∞' offset 0, 0.5
set title 'Start, C |x_0 − x^*|^2 kept' offset 0, -0.7
unset key
plot for [p_ in '4 10'] table using (held('correct', 'start_scaled', p_+0, column('away'))):'iterations' with points ls (p_+0 == 4 ? method('adam') : method('htvi')), \
  for [p_ in '4 10'] table using (held('named', 'start_scaled', p_+0, column('away'))):'iterations' with points lc rgb grey pt 6 ps 0.9

eval panel(2, 3, 2, 3)
unset logscale
set format x '%g'; set format y '%g'
kinds = 'order conditioning dimension start start_scaled clock step beyond fault'
row(s) = position(kinds, s)
set yrange [words(kinds)+0.6:0.4]
set xrange [0.1:1000]; set logscale x 10; set xtics (1, 10, 100); unset mytics
set ytics scale 0 ('order' 1, 'conditioning' 2, 'dimension' 3, 'start' 4, 'start, scaled' 5, 'clock' 6, 'step' 7, 'beyond' 8, 'fault' 9) font ',7'
set ylabel ''
set xlabel 'runs' offset 0, 0.5
set title 'How runs ended' offset 0, -0.7
verdict(v, y) = strcol('verdict') eq v ? y : NaN
set lmargin at screen 11.3/width
set key at graph 0.03, 0.75 left top Left reverse
plot for [v in 'correct named told'] verdicts using (verdict(v, column('runs'))):(row(strcol('scene'))) with points pt (v eq 'correct' ? 7 : v eq 'named' ? 5 : v eq 'told' ? 9 : 2) ps 0.9 lc rgb (v eq 'correct' ? blue : v eq 'named' ? orange : v eq 'told' ? green : vermilion) title v
unset multiplot
