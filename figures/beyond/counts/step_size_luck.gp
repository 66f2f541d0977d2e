# Iterations over the step, as multiples of the published count and step, for the HTVI runs: the published step (a ring at
# 1, 1) is often the best of its neighbourhood.
width = 16; height = 6.6
load 'figures/style.gp'
grid = data.'/step_size_luck_grid.tsv'
table = data.'/step_size_luck.tsv'
array runs[8] = ['htvi direct 4', 'htvi direct 10', 'htvi adaptive 2 1', 'htvi adaptive 4 2', 'htvi adaptive 4 1', \
  'htvi adaptive 6 1', 'htvi adaptive 8 1', 'htvi adaptive 4 0.1']
# The paper's count of a run, from its table: points, one more than the updates counted here.
array rows[8] = ['Direct HTVI p=4', 'Direct HTVI p=10', 'p sweep, p=2', 'p_ring sweep, p_ring=2', 'p sweep, p=4', \
  'p sweep, p=6', 'p sweep, p=8', 'p_ring sweep, p_ring=0.1']
printed(i) = real(system("awk -F'\t' '$2 == \"".rows[i]."\" && $5 == \"iterations\" {print $6}' ".paper(i < 3 ? 'direct_vs_adaptive' : 'p_dependence'))) - 1
unset key
set multiplot
page_left = 1.45; page_top = 0.65; gap_x = 0.35; gap_y = 0.75
set xrange [0.58:1.32]; set xtics 0.2
$here << EOD
x
1
EOD
# Two Direct runs with p = 4 are in the file: the one with h = 8e-4 is shown.
shown(y) = strcol('row') eq 'htvi direct 4' && column('h')/column('relative_h') > 8.5e-4 ? NaN : y
set logscale y 2
set yrange [0.6:6.2]
do for [i = 1:8] {
  set ylabel i == 1 || i == 5 ? 'count / published' : '' offset 0.3, 0
  set format y i == 1 || i == 5 ? '%g' : ''
  set xlabel i > 4 ? 'h / published' : ''
  set format x i > 4 ? '%g' : ''
  eval panel((i-1)%4+1, (i-1)/4+1, 4, 2)
  set title (words(runs[i]) > 3 ? '' : 'Direct, ').'p = '.word(runs[i], 3).(words(runs[i]) > 3 ? ', p̊ = '.word(runs[i], 4) : '') offset 0, -0.8
  counted = printed(i)
  plot 1 with lines ls guide, \
    grid using (shown(also('row', runs[i], column('relative_h')))):(column('iterations')/counted > 6 ? 6 : column('iterations')/counted) with linespoints ls approach(word(runs[i], 2)) dt 1 lw 0.8 ps 0.5, \
    $here using 'x':'x' with points ls published
}
unset multiplot
