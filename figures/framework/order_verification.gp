# Measured order of HTVI for every Taylor order and rule, Kepler's problem with the monitor |q|^2: the printed construction,
# where the theorem's min(r + 1, s) is attained, and the stationary action, min(2r + 2, max(r + 1, s)).
width = 16; height = 11.2
load 'figures/style.gp'
grid = data.'/order_verification.tsv'
rules = 'rectangle midpoint trapezoid radau2 simpson gauss2 radau3 boole gauss3 lobatto4 gauss4 lobatto5 radau5 gauss5 gauss6 lobatto7'
orders = '1 2 2 3 4 4 5 6 6 6 8 8 9 10 12 12'
xtics_of(i) = sprintf("%s (%s)", word(rules, i), word(orders, i))
set multiplot
page_left = 1.1; page_bottom = 2.1; gap_x = 0.3; gap_y = 0.75; page_top = 0.65
unset key; unset grid; unset colorbox
set palette defined (-2 '#d55e00', -0.5 '#d55e00', -0.45 '#f2f2f2', 0.5 '#f2f2f2', 1 '#c6dbef', 4 '#6baed6', 8 '#2171b5')
set cbrange [-2:8]
set xrange [0.5:16.5]; set yrange [-0.5:4.5]
set ytics 1 scale 0; set xtics scale 0
surplus(c, t) = strcol('problem') eq 'kepler_gamma' && strcol('construction') eq c && strcol('type') eq t \
  ? column('measured_order') - column('expected_order') : NaN
x(q) = position(rules, q)
# One decimal, left out where it is 0 and where the number has two digits before it.
tenths(v) = sprintf('%g', v < 9.95 ? floor(10*v + 0.5)/10.0 : floor(v + 0.5))
do for [k = 1:4] {
  c = k <= 2 ? 'printed' : 'stationary'; t = k % 2 ? 'II' : 'III'
  set title sprintf('Type %s, %s', t, c eq 'printed' ? 'as printed' : 'stationary action') offset 0, -0.6
  if (t eq 'II') { set ylabel 'Taylor order r' offset 0, 0; set format y '%g' } else { unset ylabel; set format y '' }
  set xtics rotate by 60 right
  unset xtics
  if (k > 2) { set xtics rotate by 60 right scale 0; do for [i = 1:16] { set xtics add (xtics_of(i) i) } }
  eval panel(1 + (k - 1) % 2, 1 + (k - 1) / 2, 2, 2)
  plot grid using (x(strcol('quadrature'))):'r':(0.48):(0.48):(surplus(c, t)) with boxxyerror fill solid 1 noborder lc palette, \
       grid using (x(strcol('quadrature'))):'r':(surplus(c, t) > -9 ? tenths(column('measured_order')) : '') with labels font ',6.5'
}
unset multiplot
