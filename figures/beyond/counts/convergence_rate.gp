# f along the exact Bregman dynamics (Direct) on the paper's quartic, at the upper ends of its oscillation, in units of the
# bound E(t_0) / (C t^p) that holds for every convex objective; a quartic falls as t^(-2p), hence t^(-p) here.
width = 11; height = 5.4
load 'figures/style.gp'
array look[4] = [black, blue, green, vermilion]
curves = data.'/convergence_rate_curves.tsv'
shown = '2 4 6 10'
table = data.'/convergence_rate.tsv'
array fitted[4]
do for [i = 1:4] {
  stats table using (column('p') == real(word(shown, i)) ? column('fitted_rate') : NaN) nooutput; fitted[i] = STATS_mean
}
eval logx; eval logy
set xrange [1:2e4]; set yrange [1e-9:3]
set xlabel 'time t'
set ylabel '(f − f*) / bound' offset -0.8, 0
set key at graph 1.0, 1.02 right top font ',7' spacing 1.0 title 'f − f* falls like'
array last[4]; array low[4]
do for [i = 1:4] {
  stats curves using (where('p', word(shown, i), 't')):(column('most')/column('bound')) nooutput
  last[i] = STATS_max_x; low[i] = STATS_min_y
}
plot for [i = 1:4] curves using (where('p', word(shown, i), 't')):(column('most')/column('bound')) with lines lc rgb look[i] lw 2 title sprintf('p = %s: t^{%.2f}', word(shown, i), fitted[i]), \
  for [i = 1:4] [t=1:2e4] (t > last[i]**0.5 && t < last[i] ? 4*low[i]*(t/last[i])**(-real(word(shown, i))) : NaN) with lines ls guide title i == 1 ? 'slope of t^{−p}' : ''
