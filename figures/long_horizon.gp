# data: long_horizon
# Kepler, e = 0.9: largest energy error so far, and error of the mean longitude, against the number of periods.
width = 16; height = 8.5
load 'figures/style.gp'
table = data.'/long_horizon.tsv'
set multiplot
page_left = 0.135; page_right = 0.97; page_bottom = 0.33; gap_x = 0.17
eval logx; eval logy
set xlabel 'periods'
unset key
set ylabel 'largest energy error, relative'
set yrange [1e-16:1]
set ytics 1e4
names_here = 'htvi4 htvi12 stormer_verlet log_hamiltonian_yoshida4 runge_kutta_4'
style(i) = i == 1 ? method('htvi') : i == 2 ? monitor('none') : i == 3 ? method('stormer_verlet') : i == 4 ? method('log_hamiltonian') : family(4)
title(i) = word("HTVI4 HTVI12 Störmer–Verlet 'log. Hamiltonian, Yoshida 4' 'Runge–Kutta 4'", i)
eval panel(1, 1, 2, 1)
plot for [i=1:5] table using (where('method', word(names_here, i), 'periods')):'energy_error' with linespoints ls style(i) pointinterval 4
set ylabel 'error of the phase (rad)'
set yrange [1e-14:1e4]
eval panel(2, 1, 2, 1)
plot for [i=1:5] table using (where('method', word(names_here, i), 'periods')):(abs(column('phase_error'))) with linespoints ls style(i) pointinterval 4
eval legend(0.13)
set key maxrows 2 spacing 1.1 samplen 2.5 width -9 font ',7'
plot for [i=1:5] 2 with linespoints ls style(i) title title(i)
unset multiplot
