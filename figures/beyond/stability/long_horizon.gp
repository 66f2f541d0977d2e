# Kepler, e = 0.9: largest relative errors so far of energy and angular momentum, and error of the mean longitude, against
# the number of periods.
width = 16; height = 5
load 'figures/style.gp'
table = data.'/long_horizon.tsv'
set multiplot
page_left = 1.45; page_right = 0.5; page_bottom = 2.05; page_top = 0.65; gap_x = 1.35
eval logx; eval logy
set xlabel 'periods'
unset key
names_here = 'stationary4 stationary12 collocation16 stormer_verlet log_hamiltonian_yoshida4 runge_kutta_4'
style(i) = i == 1 ? method('htvi') : i == 2 ? monitor('norm_squared') : i == 3 ? method('collocation') : i == 4 ? method('stormer_verlet') \
  : i == 5 ? method('log_hamiltonian') : family(4)
title(i) = word("'stationary 4' 'stationary 12' 'collocation 16' Störmer–Verlet 'log. Hamiltonian, Yoshida 4' 'Runge–Kutta 4'", i)
set xtics 100; set ytics 1e4
curve(c) = sprintf("plot for [i=1:6] table using (where('method', word(names_here, i), 'periods')):(abs(column('%s'))) with linespoints ls style(i) pointinterval 4", c)
set title 'energy error' offset 0, -0.7
set yrange [1e-16:1]
eval panel(1, 1, 3, 1)
eval curve('energy_error')
set title 'angular momentum error' offset 0, -0.7
eval panel(2, 1, 3, 1)
eval curve('momentum_error')
set title 'phase error (rad)' offset 0, -0.7
set yrange [1e-14:1e5]
eval panel(3, 1, 3, 1)
eval curve('phase_error')
unset title
eval legend(0.9)
set key maxrows 2 samplen 2.5 width -3
plot for [i=1:6] 2 with linespoints ls style(i) title title(i)
unset multiplot
