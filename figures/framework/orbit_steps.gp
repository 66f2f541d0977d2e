# One orbit of eccentricity 0.9 with its steps, equal in Poincare time, for four monitors. One scale on both axes.
width = 16; height = 8.7
load 'figures/style.gp'
table = data.'/orbit_steps.tsv'
summary = data.'/orbit_steps_summary.tsv'
$here << EOD
x
0
EOD
set multiplot
page_left = 0.3; page_right = 0.3; page_top = 0.55; page_bottom = 0.1; gap_x = 0.5; gap_y = 0.65
set samples 400
unset key; unset tics; unset grid; unset border
# The ranges hold the motion of the first panel, which goes furthest; their lengths are as the panels' sides.
left = -2.13; right = 0.17; low = -0.66; set xrange [left:right]; set yrange [low:low + (right - left)*cell_h(2)/cell_w(2)]
names_here = 'none r r^1.5 r^2'
array shown[4] = ['equal steps in time', 'g = |q|', 'g = |q|^{3/2}', 'g = |q|^2']
looks = black.' '.sky.' '.blue.' '.orange
do for [k = 1:4] {
  m = word(names_here, k)
  stats summary using (where('monitor', m, 'energy_error')) nooutput
  set title sprintf('%s:  energy error %s', shown[k], sprintf('%.0f·10^{%d}', STATS_max/10**floor(log10(STATS_max)), floor(log10(STATS_max)))) offset 0, -0.9
  eval panel(1 + (k - 1) % 2, 1 + (k - 1) / 2, 2, 2)
  plot [left:right] sample [0:2*pi] '+' using (cos($1) - 0.9):(sqrt(1 - 0.81)*sin($1)) with lines lc rgb '#bbbbbb' lw 1, \
    table using 'q_1':(where('monitor', m, 'q_2')) with points pt 7 ps 0.5 lc rgb word(looks, k), \
    $here using (0):(0) with points pt 7 ps 1.1 lc rgb vermilion
}
unset multiplot
