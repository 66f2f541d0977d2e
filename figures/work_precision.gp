# data: work_precision
# What accuracy costs: error at the end against time, the Pareto front of all methods drawn through.
width = 17; height = 19
load 'figures/style.gp'
file = data.'/work_precision.tsv'
front = data.'/work_precision_front.tsv'

# Every method as dots in the mark of its kind, the front as a line.
array mark[5] = [9, 7, 4, 1, 6]
array colour[5] = [green, blue, vermilion, grey, sky]
array name[5] = ['logarithmic Hamiltonian', 'HTVI', 'other libraries', 'fixed-step and reversible', 'HTVI, value first']
kinds = '4 3 2 5 1'
kind(m) = strstrt(m, 'log_hamiltonian') ? 1 : m eq 'htvi' ? 2 : m eq 'htvi_value_first' ? 5 : \
          (strstrt(m, 'gsl') || strstrt(m, 'odeint') || strstrt(m, 'sundials')) ? 3 : 4
at(p, e, h, k) = strcol('problem') eq p && strcol('horizon') eq h && kind(strcol('method')) == k && \
                 (e < 0 || abs(column('eccentricity') - e) < 1e-6) ? column('position_error') : NaN
edge(p, e, h) = strcol('problem') eq p && strcol('horizon') eq h && \
                (e < 0 || abs(column('eccentricity') - e) < 1e-6) ? column('position_error') : NaN

eval logx
eval logy
set grid
unset key
set xrange [1e-4:1e2]
set yrange [1e-14:1e-1]
set xtics 100 font ',7'
set ytics 1e3 font ',7'
set xlabel font ',8'
set ylabel font ',8'
set multiplot layout 3,2 margins 0.13,0.97,0.17,0.96 spacing 0.12,0.07
array problem[6] = ['kepler', 'kepler', 'kepler', 'kepler', 'perturbed_kepler', 'figure_eight']
array ecc[6] = [0.9, 0.99, 0.999, 0.9, 0.9, -1]
# The horizon that the data hold: the reduced grid is shorter than the full one.
has(p, h, m) = int(system("awk -F'\\t' '$1==\"".p."\" && $3==\"".h."\" && $4 ~ /^".m."/' '".file."' | wc -l")) > 0
orbits = has('kepler', '1000 periods', '') ? '1000 periods' : '100 periods'
array horizon[6] = ['10', '10', '10', orbits, '10', '10 periods']
array title[6] = ['Kepler, e = 0.9, T = 10', 'Kepler, e = 0.99, T = 10', 'Kepler, e = 0.999, T = 10', \
  'Kepler, e = 0.9, '.orbits, 'Kepler with quadrupole, e = 0.9, T = 10', 'figure-eight orbit, 10 periods']
do for [i=1:6] {
  set title title[i] font ',8' offset 0,-0.6
  set ylabel i % 2 ? 'position error' : ''
  set xlabel i > 4 ? 'time / time of the Verlet run of Table 1' : ''
  if (i == 6) { set key at screen 0.97,0.006 bottom right vertical maxrows 3 samplen 2 font ',7' noopaque } else { unset key }
  drawn = '4 3'.(has(problem[i], horizon[i], 'htvi$') ? ' 2' : '').(has(problem[i], horizon[i], 'htvi_value') ? ' 5' : '').' 1'
  plot for [k in drawn] file using "cost":(at(problem[i], ecc[i], horizon[i], k+0)) \
      with points pt mark[k+0] ps 0.5 lc rgb colour[k+0] notitle, \
    for [k in kinds] keyentry with points pt mark[k+0] ps 0.5 lc rgb colour[k+0] title name[k+0], \
    front using "cost":(edge(problem[i], ecc[i], horizon[i])) with lines lc rgb black lw 1.2 title 'Pareto front'
}
unset multiplot
