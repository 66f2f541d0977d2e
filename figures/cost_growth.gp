# data: cost_growth
# How the cost of a run grows: steps and time of one orbit with 1 - e for g = r^(2 gamma); time with the horizon, the
# Taylor order and the dimension. Grey: the expected powers.
width = 17; height = 14
load 'figures/style.gp'
table = data.'/cost_growth.tsv'
set multiplot
page_left = 0.075; page_bottom = 0.165; page_top = 0.955; gap_x = 0.085; gap_y = 0.13
along(axis, name) = strcol('axis') eq axis && strcol('subject') eq name ? column('value') : NaN
gammas = '0.5 0.625 0.75 0.875 1'
eval logx
eval logy
unset key
eval panel(1, 1, 2, 2)
set title 'steps of one orbit with energy error 10^{-4}' offset 0, -0.7
set xrange [0.15:6e-7]
set yrange [40:4e4]
set xlabel 'distance 1 - e from a parabola' offset 0, 0.5
plot 1300*(x/1e-2)**-0.75 ls guide, 1500*(x/1e-3)**-0.5 ls guide, 1072*(x/1e-5)**-0.25 ls guide, \
  887*(x/0.1)**-1.75 ls guide, \
  table using (along('closeness', 'none')):'steps' with linespoints ls monitor('none'), \
  for [i=1:5] table using (along('closeness', 'gamma = '.word(gammas, i))):'steps' with linespoints ls family(i)
eval panel(2, 1, 2, 2)
set title 'microseconds of that orbit' offset 0, -0.7
set yrange [50:6e4]
plot table using (along('closeness', 'none')):(1e6*column('seconds')) with linespoints ls monitor('none'), \
  for [i=1:5] table using (along('closeness', 'gamma = '.word(gammas, i))):(1e6*column('seconds')) with linespoints ls family(i)

set yrange [*:*]
set key top left Left reverse font ',7' spacing 1.05 samplen 2 noopaque
eval panel(1, 2, 3, 2)
set title 'seconds of a run, e = 0.9' offset 0, -0.7
set xlabel 'periods'
set xrange [0.8:1300]
set yrange [1e-6:30]
plot table using (along('periods', 'htvi4')):'seconds' with linespoints ls method('htvi') title 'HTVI4', \
  table using (along('periods', 'stormer_verlet')):'seconds' with linespoints ls method('stormer_verlet') title label('stormer_verlet'), \
  table using (along('periods', 'log_hamiltonian')):'seconds' with linespoints ls method('log_hamiltonian') title 'log. Hamiltonian'
set format x '%g'
eval panel(2, 2, 3, 2)
set title 'µs per expansion' offset 0, -0.7
set xlabel 'Taylor order r'
set xrange [0.9:18]
set yrange [0.08:60]
set xtics (1, 2, 4, 8, 16)
set mxtics 1
plot 5*(x/15)**2 ls guide title 'r^2', \
  table using (along('order', 'htvi_of_order')):(1e6*column('seconds')) with linespoints ls method('htvi') title 'with partials', \
  table using (along('order', 'taylor_values')):(1e6*column('seconds')) with linespoints ls family(4) title 'values only'
eval panel(3, 2, 3, 2)
set title 'µs per expansion' offset 0, -0.7
set xlabel 'masses n of a chain'
set xrange [6:100]
set yrange [1:1e7]
set xtics (7, 14, 28, 56)
plot 5*(x/7)**2 ls guide title 'n^2, n^3', 60*(x/7)**3 ls guide notitle, \
  table using (along('dimension', 'gradient supplied')):(1e6*column('seconds')) with linespoints ls method('htvi') title 'gradient supplied', \
  table using (along('dimension', 'gradient automatic')):(1e6*column('seconds')) with linespoints ls method('log_hamiltonian') title 'gradient automatic'
eval legend(0.08)
set key maxrows 2 samplen 2 width -2
plot 2 with linespoints ls monitor('none') title 'fixed step', \
  for [i=1:5] 2 with linespoints ls family(i) title 'γ = '.word(gammas, i), 2 with lines ls guide title 'expected'
unset multiplot
