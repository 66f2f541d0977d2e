# Iterations until the stopping test over its tolerance: ours as lines, the paper's as open circles. Runs that end at their
# cap are not drawn.
width = 16; height = 4.6
load 'figures/style.gp'
table = data.'/optimiser_comparison.tsv'
shown = 'trust_region rmsprop htvi adam nag adagrad'
eval logx; eval logy
set xrange [2e-2:5e-11]
set yrange [10:1e9]
set xlabel 'tolerance δ of the stopping test'
set ylabel 'iterations' offset 0.3, 0
page_right = 5.2; page_top = 0.4
eval panel(1, 1, 1, 1)
set key at graph 1.04, 1 left top Left reverse samplen 2.5 spacing 1.05
reached(m, y) = also('converged', '1', also('method', m, y))
plot for [m in 'adagrad nag adam htvi rmsprop trust_region'] table using (reached(m, column('delta'))):'iterations' with linespoints ls method(m) \
    title label(m).(m eq 'htvi' ? ' (nearest found)' : ''), \
  table using (reached('nag_shifted', column('delta'))):'iterations' with lines ls guide title 'NAG in x − 1', \
  paper('optimiser_comparison') using 'delta':'published' \
    with points ls published lw 0.8 title 'in the source'
