# Time of Gauss collocation over that of the fastest other library that reaches the same position error, against that error.
# Solid: solved to rounding; dashed: sweeps that may end at a tolerance. Band: from the least to the largest of five runs.
width = 16; height = 13
load 'figures/style.gp'
file = data.'/work_precision.tsv'

# Cheapest setting by target, ten in a decade of error pairs: target, cost, least, most, for the rows that match.
scene(p, e, h) = sprintf('$1 == "%s" && $3 == "%s"', p, h).(e < 0 ? '' : sprintf(' && $2 > %g && $2 < %g', e - 1e-6, e + 1e-6))
ratio(p, e, h, ours) = "awk -F'\t' '$1 == \"problem\" {for (i = 1; i <= NF; i++) at[$i] = i} !/^#/ && ".scene(p, e, h)." && $10 == $10 + 0 {peer = $4 ~ /^(gsl_|odeint_|sundials_)/; own = ".ours."; " \
  ."if (peer || own) {n++; err[n] = $10; c[n] = $12; lo[n] = $at[\"least_cost\"]; hi[n] = $at[\"most_cost\"]; who[n] = peer}} " \
  ."END {for (d = -4; d >= -24; d--) {t = 10^(d/2); bp = bo = 0; for (i = 1; i <= n; i++) if (err[i] <= t) {" \
  ."if (who[i]) {if (!bp || c[i] < c[bp]) bp = i} else {if (!bo || c[i] < c[bo]) bo = i}} " \
  ."if (bp && bo) print t, c[bo]/c[bp], lo[bo]/hi[bp], hi[bo]/lo[bp]}}' '".file."'"
solved = "($4 == \"collocation\" && $6 !~ /tolerance=/)"
early = "($4 == \"collocation\")"
count(p, h) = int(system("awk -F'\t' '!/^#/ && $1 == \"".p."\" && $3 == \"".h."\"' '".file."' | wc -l"))
orbits = count('kepler', '1000 periods') ? '1000 periods' : '100 periods'
sections = count('henon_heiles', '1000') ? '1000' : '100'

panels = 11
array problem[panels] = ['kepler', 'kepler', 'kepler', 'kepler', 'perturbed_kepler', 'figure_eight', 'star_cluster', 'solar_system', \
  'henon_heiles', 'double_pendulum', 'chain64']
array ecc[panels] = [0.9, 0.99, 0.999, 0.9, 0.9, -1, -1, -1, -1, -1, -1]
array horizon[panels] = ['10', '10', '10', orbits, '10', '10 periods', '1', '200000 days', sections, sections, sections]
array shown[panels] = ['Kepler 0.9, t = 10', 'Kepler 0.99, t = 10', 'Kepler 0.999, t = 10', 'Kepler 0.9, '.orbits, 'quadrupole 0.9, t = 10', \
  'figure eight, 10 periods', 'seven bodies, t = 1', 'outer planets, 200 000 d', 'Hénon–Heiles, t = '.sections, 'double pendulum, t = '.sections, 'chain of 64, t = '.sections]
unset datafile columnheaders
set datafile separator whitespace
eval logx; eval logy
unset key
# One range for all panels, which holds every curve and band.
lowest = 0.05; highest = 20
do for [i = 1:panels] {
  do for [ours in 'solved early'] {
    set print $a; print system(ratio(problem[i], ecc[i], horizon[i], value(ours))); unset print
    if (|$a| > 0 && strlen($a[1]) > 0) {
      do for [c = 2:(ours eq 'solved' ? 4 : 2)] {
        stats $a using c nooutput
        if (STATS_min < lowest) {lowest = STATS_min}
        if (STATS_max > highest) {highest = STATS_max}
      }
    }
  }
}
set xrange [1e-2:1e-12]; set yrange [lowest/1.3:1.3*highest]
set xtics font ',7'; set mxtics 1; set ytics (0.1, 1, 10, 100) font ',7'
set multiplot
page_left = 1.5; page_right = 0.5; page_bottom = 1.95; page_top = 0.65; gap_x = 0.4; gap_y = 0.85
do for [i = 1:panels] {
  eval panel((i - 1) % 4 + 1, (i - 1) / 4 + 1, 4, 3)
  set title shown[i] font ',7' offset 0, -0.7
  set ylabel i % 4 == 1 ? 'time / best library' : '' offset 0.6, 0
  set format y i % 4 == 1 ? '%g' : ''
  set xtics (1e-3, 1e-6, 1e-9); set format x i > 7 ? '10^{%L}' : ''
  set xlabel i > 7 ? 'position error' : '' offset 0, 0.3
  set print $a; print system(ratio(problem[i], ecc[i], horizon[i], solved)); unset print
  set print $b; print system(ratio(problem[i], ecc[i], horizon[i], early)); unset print
  if (|$a| > 0 && strlen($a[1]) > 0) {
    plot 1 with lines lc rgb black lw 1, \
      $a using 1:3:4 with filledcurves fc rgb blue fs transparent solid 0.2 noborder, \
      $b using 1:2 with lines lc rgb orange dt (9,3) lw 1.6, \
      $a using 1:2 with lines lc rgb blue lw 2
  }
}
eval legend(0.7)
set key maxrows 1 samplen 2
plot 2 with lines lc rgb blue lw 2 title 'solved to rounding', 2 with lines lc rgb orange dt (9,3) lw 1.6 title 'sweeps may end early', \
  2 with lines lc rgb black lw 1 title 'best other library'
unset multiplot
