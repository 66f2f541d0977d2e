# The rows of Table 1 or 2: energy error, position error, and time in units of the same source's Störmer–Verlet. A row for
# each monitor; a mark for each construction beside the printed value. Needs `stem` and `eccentricity`.
width = 16; height = 5.3
load 'figures/style.gp'
ours = data.'/'.stem.'.tsv'
rows = 5
array row[rows] = ['HTVI4 gamma', 'HTVI4 energy', 'HTVI4 arclength', 'HTVI4 none', 'SV']
array shown[rows] = ['gamma', 'energy', 'arclength', 'no monitor', 'Störmer–Verlet']
place(i) = rows - i
row_of(list_column) = (position('gamma energy arclength none', strcol(list_column)))
array steps[rows]; array seconds[rows]; array energy_error[rows]; array global_error[rows]
cell(i, q) = strcol('row') eq row[i] && strcol('quantity') eq q ? column('published') : NaN
do for [i = 1:rows] {
  stats paper(stem) using (cell(i, 'steps')) nooutput; steps[i] = STATS_max
  stats paper(stem) using (cell(i, 'seconds')) nooutput; seconds[i] = STATS_max
  stats paper(stem) using (cell(i, 'energy_error')) nooutput; energy_error[i] = STATS_max
  stats paper(stem) using (cell(i, 'global_error')) nooutput; global_error[i] = STATS_max
}
stats ours using (where('method', 'stormer_verlet', 'seconds')) nooutput; unit = STATS_max
# y of a row of the data under a construction; Verlet stands with the recovered one.
line(c, rule) = strcol('method') eq 'stormer_verlet' ? (c eq 'authors' ? place(rows) : NaN) \
  : strcol('construction') eq c && strcol('rule') eq rule ? place(row_of('monitor')) : NaN
$here << EOD
x
0
EOD
set multiplot
page_left = 2.6; page_right = 0.4; page_top = 0.6; page_bottom = 1.55; gap_x = 0.5
unset key
eval logx
set mxtics 1
set yrange [-0.6:rows - 0.4]
set xtics 1e3
array axis[3] = ['energy error', 'position error', 'time / Störmer–Verlet']
do for [k = 1:3] {
  set title (k == 1 ? sprintf('e = %g:  ', eccentricity) : '').axis[k] offset 0, -0.8
  unset ytics
  set ytics scale 0 ('' 0)
  do for [i = 1:rows] { set ytics add ((k == 1 ? shown[i] : '') place(i)) }
  if (k < 3) { set xrange [1e-11:2] }
  if (k == 3) { set xrange [1e-4:1e2] }
  eval panel(k, 1, 3, 1)
  published_value(i) = k == 1 ? energy_error[i] : k == 2 ? global_error[i] : seconds[i]/seconds[rows]
  measured(c) = k == 1 ? column('energy_error') : k == 2 ? column('global_error') : column('seconds')/unit
  plot ours using (measured('authors')):(line('authors', 'simpson')) with points pt 7 ps 0.8 lc rgb blue, \
    ours using (measured('printed')):(line('printed', 'simpson')) with points pt 4 ps 0.9 lc rgb vermilion, \
    ours using (measured('stationary')):(line('stationary', 'gauss4')) with points pt 2 ps 0.8 lc rgb green, \
    for [i = 1:rows] $here using (published_value(i)):(place(i)) with points ls published
}
unset title
eval legend(0.9)
set key maxrows 1 samplen 1 width -2
plot $here using (2):(2) with points ls published title 'in the source', \
  $here using (2):(2) with points pt 7 lc rgb blue title 'recovered', \
  $here using (2):(2) with points pt 4 lc rgb vermilion title 'printed construction', \
  $here using (2):(2) with points pt 2 lc rgb green title 'stationary, Gauss 4'
unset multiplot
