# Errors against the step h for each construction, at the settings of Table 1: the gamma monitor on the left, the energy
# monitor on the right.
width = 16; height = 7.6
load 'figures/style.gp'
table = data.'/constructions.tsv'
set multiplot
page_bottom = 2.3; page_top = 0.75; gap_y = 0.35; gap_x = 0.65
unset key
eval logx; eval logy
power = '10^{%L}'
of(construction, r, rule, monitor, y) = also('construction', construction, also('r', r, also('rule', rule, also('monitor', monitor, y))))
names = 'authors printed stationary stationary stationary'
orders = '3 3 1 3 3'
rules = 'simpson simpson gauss2 simpson gauss4'
shown = "'authors, r = 3, Simpson' 'printed, r = 3, Simpson' 'stationary, r = 1, Gauss 2' 'stationary, r = 3, Simpson' 'stationary, r = 3, Gauss 4'"
style_of(i) = family(i)
set xrange [0.01:0.25]
set xtics (0.0125, 0.025, 0.05, 0.1, 0.2); set mxtics 1
do for [error in 'energy_error global_error'] {
  bottom = error eq 'global_error'
  do for [k = 1:2] {
    g = word('gamma energy', k)
    set format x bottom ? '%g' : ''
    set xlabel bottom ? 'h' : ''
    if (k == 1) { set title bottom ? '' : 'gamma' offset 0, -0.7; set ylabel bottom ? 'position error' : 'energy error' offset 1, 0; set format y power }
    else { set title bottom ? '' : 'energy' offset 0, -0.7; unset ylabel; set format y '' }
    set yrange [1e-15:0.3]; set ytics 1e3
    eval panel(k, bottom ? 2 : 1, 2, 2)
    plot 30*x**4 with lines ls guide, 30*x**8 with lines ls guide, \
      for [i = 1:5] table using 'h':(of(word(names, i), word(orders, i), word(rules, i), g, column(error))) with linespoints ls style_of(i) ps 0.7
  }
}
eval legend(1.25)
set key samplen 2 maxrows 2 width -4
plot for [i = 1:5] 2 with linespoints ls style_of(i) ps 0.7 title word(shown, i), 2 with lines ls guide title 'h^4, h^8'
unset multiplot
