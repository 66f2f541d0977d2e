# The largest step before the energy runs off (Kepler: e = 0.9; Hénon–Heiles: H = 1/12). Oscillator and Hénon–Heiles: in units
# of the first step at which the method is unstable or unsolved on the oscillator; stable windows may follow, so points above 1
# occur. Kepler, and all of collocation: in units of Störmer–Verlet's limit; collocation's runs on the oscillator end at the
# largest step that was tried.
width = 16; height = 5.6
load 'figures/style.gp'
table = data.'/step_breakdown.tsv'
methods = 'stormer_verlet yoshida4 kahan_li8 runge_kutta_4 stationary4 stationary6 stationary8 stationary12 collocation4 collocation8 collocation12 collocation16'
shown = "'Störmer–Verlet' 'Yoshida 4' 'Kahan–Li 8' 'Runge–Kutta 4' 'stationary 4' 'stationary 6' 'stationary 8' 'stationary 12' 'collocation 4' 'collocation 8' 'collocation 12' 'collocation 16'"
set logscale y 10
set yrange [0.05:20]
set xrange [0.5:12.5]
set ylabel 'largest step / limit'
set xtics rotate by 25 right
do for [i=1:12] { set xtics add (word(shown, i) i) }
page_bottom = 1.5; page_top = 1.0
eval panel(1, 1, 1, 1)
set key tmargin center horizontal Left reverse maxrows 2 width -3
row(problem, monitor, x) = strcol('problem') eq problem && strcol('monitor') eq monitor && position(methods, strcol('method')) \
  ? position(methods, strcol('method')) + x : NaN
limit(x) = strcol('linear_reason') eq 'none' ? 2 : column('h_linear')
plot 1 ls guide title 'limit', \
  table using (row('oscillator', 'none', -0.2)):(column('h')/limit(0)) with points ls monitor('none') ps 1.3 title 'oscillator', \
  table using (row('henon_heiles', 'none', -0.07)):(column('h')/limit(0)) with points ls monitor('truncation') ps 1.3 title 'Hénon–Heiles, H = 1/12', \
  table using (row('kepler', 'none', 0.07)):(column('h')/limit(0)) with points ls monitor('arclength') ps 1.3 title 'Kepler, fixed step', \
  table using (row('kepler', 'r^1.5', 0.2)):(column('h')/limit(0)) with points ls monitor('gamma') ps 1.3 title 'Kepler, g = |q|^{1.5}'
