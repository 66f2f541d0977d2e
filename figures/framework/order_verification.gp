# Left: measured order of HTVI against its Taylor degree, for rules that do not limit it; a dot for each rule, problem and
# type, moved sideways by its problem. Right: error against the step of each construction on Kepler's problem.
width = 16; height = 7.6
load 'figures/style.gp'
grid = data.'/order_verification.tsv'
table = data.'/constructions.tsv'
rules = 'rectangle midpoint trapezoid radau2 simpson gauss2 radau3 boole gauss3 lobatto4 gauss4 lobatto5 radau5 gauss5 gauss6 lobatto7'
orders = '1 2 2 3 4 4 5 6 6 6 8 8 9 10 12 12'
order_of(rule) = word(orders, position(rules, rule)) + 0
problems = system("awk -F'\t' '!/^#/ && $1 != \"problem\" {if (!($1 in seen)) {seen[$1] = 1; printf \"%s \", $1}}' '".grid."'")
aside(problem, type) = 0.55*(position(problems, problem) - 0.5*(words(problems) + 1))/words(problems) + (type eq 'III' ? 0.02 : -0.02)
shown(c) = strcol('construction') eq c && order_of(strcol('quadrature')) >= 2*column('r') + 2 ? column('measured_order') : NaN
set multiplot
page_left = 1.4; page_bottom = 2.3; page_top = 0.4
unset key
set xrange [-0.5:4.5]; set yrange [0:12]
set xtics 1; set ytics 2
set xlabel 'Taylor degree r'; set ylabel 'measured order' offset 0.5, 0
eval box(page_left, page_bottom, 6.1, height - page_bottom - page_top)
set label 1 '2r + 2' at graph 0.52, graph 0.72 right font ',8'
set label 2 'r + 1' at graph 0.68, graph 0.24 left font ',8'
plot x + 1 with lines ls guide, 2*x + 2 with lines ls guide, \
  grid using (column('r') + aside(strcol('problem'), strcol('type'))):(shown('printed')) with points pt 6 ps 0.35 lc rgb vermilion, \
  grid using (column('r') + aside(strcol('problem'), strcol('type'))):(shown('stationary')) with points pt 7 ps 0.35 lc rgb blue
unset label
# Right.
of(construction, r, rule, y) = also('construction', construction, also('r', r, also('rule', rule, also('monitor', 'gamma', y))))
names_here = 'authors printed stationary stationary stationary'
degrees = '3 3 1 3 3'
rules_here = 'simpson simpson gauss2 simpson gauss4'
array look[5] = [black, vermilion, sky, green, blue]
array mark[5] = [2, 6, 9, 13, 7]
eval logx; eval logy
set xrange [0.011:0.23]; set yrange [1e-15:1]; set ytics 1e3
set xtics ('0.0125' 0.0125, '0.025' 0.025, '0.05' 0.05, '0.1' 0.1, '0.2' 0.2); set mxtics 1
set xlabel 'step h'; set ylabel 'position error at the end' offset 0.8, 0
eval box(9.3, page_bottom, 6.3, height - page_bottom - page_top)
plot 30*x**4 with lines ls guide, 3*x**8 with lines ls guide, \
  for [i = 1:5] table using 'h':(of(word(names_here, i), word(degrees, i), word(rules_here, i), column('global_error'))) with linespoints lc rgb look[i] pt mark[i] ps 0.7 lw 1.4
eval box(0.3, 0.1, 7.2, 1.2)
unset border; unset tics; unset xlabel; unset ylabel; unset logscale; set xrange [0:1]; set yrange [0:1]
set key inside center center vertical Left reverse maxrows 2 spacing 1.1 samplen 1.5
plot 2 with points pt 6 lc rgb vermilion title 'as printed', 2 with points pt 7 lc rgb blue title 'stationary', 2 with lines ls guide title 'theory'
eval box(7.6, 0.1, 8.3, 1.2)
set key maxrows 3 samplen 2 width -3 font ',7'
plot for [i = 1:5] 2 with linespoints lc rgb look[i] pt mark[i] ps 0.7 title word("'recovered, r = 3, Simpson' 'printed, r = 3, Simpson' 'stationary, r = 1, Gauss 2' 'stationary, r = 3, Simpson' 'stationary, r = 3, Gauss 4'", i), \
  2 with lines ls guide title 'h^4, h^8'
unset multiplot
