# What accuracy costs: error at the end against time. One joined curve for each kind of method: the least time, over its
# members, orders, monitors and steps, at which an error is reached.
width = 16; height = 10
load 'figures/style.gp'
file = data.'/work_precision.tsv'

kinds = 7
array members[kinds] = ['^log_hamiltonian', '^collocation', '^htvi$', '^gsl_', '^odeint_', '^sundials_', \
  '^(stormer_verlet|verlet_|adaptive_verlet|hairer_soderlind|blanes_moan)']
array shown[kinds] = ['log. Hamiltonian', 'Gauss collocation', 'HTVI', 'GSL', 'Boost.odeint', 'SUNDIALS', \
  'other of ours']
array colour[kinds] = [green, black, blue, vermilion, orange, purple, grey]
array mark[kinds] = [9, 7, 7, 5, 4, 2, 1]

# Points of a scene by kind, dearer ones only where they are more accurate: kind, cost, error.
scene(p, e, h) = sprintf('$1 == "%s" && $3 == "%s"', p, h).(e < 0 ? '' : sprintf(' && $2 > %g && $2 < %g', e - 1e-6, e + 1e-6))
kind_of = ''
do for [k=1:kinds] { kind_of = kind_of.sprintf('$4 ~ /%s/ ? %d : ', members[k], k) }
fronts(p, e, h) = "awk -F'\t' -v OFS='\t' '!/^#/ && ".scene(p, e, h)." && $10 == $10 + 0 {k = ".kind_of."0; if (k) print k, $12, $10}' '".file."' " \
  ."| sort -k1,1n -k2,2g | awk -F'\t' '$1 != k {k = $1; best = 1} $3 < best {print; best = $3}'"
count(p, e, h) = int(system("awk -F'\t' '!/^#/ && ".scene(p, e, h)."' '".file."' | wc -l"))

unset datafile columnheaders
eval logx
eval logy
set grid
unset key
set xrange [1e-4:1e2]; set yrange [1e-14:1e-1]
set xtics 1e-3, 100, 10 font ',7'; set ytics 1e3 font ',7'
panels = 11
array problem[panels] = ['kepler', 'kepler', 'kepler', 'kepler', 'perturbed_kepler', 'figure_eight', 'henon_heiles', \
  'double_pendulum', 'star_cluster', 'solar_system', 'chain64']
array ecc[panels] = [0.9, 0.99, 0.999, 0.9, 0.9, -1, -1, -1, -1, -1, -1]
# The horizon that the data hold: the reduced grid is shorter than the full one.
orbits = count('kepler', 0.9, '1000 periods') ? '1000 periods' : '100 periods'
sections = count('henon_heiles', -1, '1000') ? '1000' : '100'
array horizon[panels] = ['10', '10', '10', orbits, '10', '10 periods', sections, '100', '1', '200000 days', '100']
array title[panels] = ['Kepler 0.9, T = 10', 'Kepler 0.99, T = 10', 'Kepler 0.999, T = 10', \
  'Kepler 0.9, '.orbits, 'quadrupole 0.9, T = 10', 'figure eight, 10 periods', 'Hénon–Heiles, T = '.sections, \
  'double pendulum, T = 100', 'seven bodies, T = 1', 'outer planets, 2·10^5 days', 'chain of 64, T = 100']
set multiplot
page_top = 0.65; gap_x = 0.4; gap_y = 0.75
# Four columns; the twelfth panel holds the key. Numbers on the outer axes only, which all panels share.
do for [i=1:panels] {
  eval panel((i - 1) % 4 + 1, (i - 1) / 4 + 1, 4, 3)
  set title title[i] font ',7' offset 0, -0.7
  set ylabel i % 4 == 1 ? 'position error' : ''
  set format y i % 4 == 1 ? '10^{%L}' : ''; set format x i > 7 ? '10^{%L}' : ''
  set xlabel i > 7 ? 'time / SV' : '' offset 0, 0.4
  set print $fronts
  print system(fronts(problem[i], ecc[i], horizon[i]))
  unset print
  drawn = ''
  do for [j=1:|$fronts|] { if (!strstrt(drawn, word($fronts[j], 1))) { drawn = drawn.' '.word($fronts[j], 1) } }
  if (strlen(drawn)) { plot for [k in drawn] $fronts using ($1 == k+0 ? $2 : NaN):3 with linespoints lc rgb colour[k+0] lw 1.3 pt mark[k+0] ps 0.45 }
}
eval legend(1)
unset grid
eval box(12.4, 0.2, 3.5, 2.85)
set key top center maxrows 7 samplen 2 spacing 1.05 width 0 font ',8'
plot 2 notitle, for [k=1:kinds] keyentry with linespoints lc rgb colour[k] lw 1.3 pt mark[k] ps 0.7 title shown[k]
unset multiplot
