# How the cost with the monitor that solve() chooses spreads over the problems: the share of them on which it is at
# most so many times that of the best monitor made by hand, for three orders. A run that misses the error counts as none.
width = 16; height = 6.2
load 'figures/style.gp'
file = data.'/automatic_monitors_choices.tsv'
set multiplot
page_left = 1.45; page_bottom = 2.05; page_top = 0.65; gap_x = 0.4
set logscale x 10
set xrange [0.7:30]; set yrange [0:1.02]
set xtics (1, 2, 4, 10, 30)
set xlabel 'cost / best by hand' offset 0, 0.3
unset key
reached(y) = y < 1e9 ? y : 1e9  # nan, inf
do for [order in '4 8 16'] {
  of(held, y) = strcol('order') eq order && strcol('held_out') eq held ? y : NaN
  all(y) = strcol('order') eq order ? y : NaN
  stats file using (of('0', 1)) nooutput; seen = STATS_records
  stats file using (of('1', 1)) nooutput; held_out = STATS_records
  i = position('4 8 16', order)
  set ylabel i == 1 ? 'share of problems' : '' offset 0.5
  set format y i == 1 ? '%g' : ''
  set title 'order '.order offset 0, -0.7
  eval panel(i, 1, 3, 1)
  set arrow 1 from 1.5, graph 0 to 1.5, graph 1 nohead ls guide; set arrow 2 from 2, graph 0 to 2, graph 1 nohead ls guide
  plot file using (all(reached(column('none_work_ratio')))):(1.0/(seen + held_out)) smooth cumulative with steps lc rgb grey dt (3,3) lw 1.4, \
    file using (all(reached(column('chosen_ratio')))):(1.0/(seen + held_out)) smooth cumulative with steps lc rgb sky lw 1.4, \
    file using (of('0', reached(column('chosen_work_ratio')))):(1.0/seen) smooth cumulative with steps lc rgb vermilion lw 1.8, \
    file using (of('1', reached(column('chosen_work_ratio')))):(1.0/held_out) smooth cumulative with steps lc rgb black dt (9,3) lw 1.4
}
unset arrow 1; unset arrow 2
eval legend(0.9)
set key maxrows 2 samplen 2
plot 2 notitle, keyentry with lines lc rgb vermilion lw 1.8 title 'work, problems looked at', \
  keyentry with lines lc rgb black dt (9,3) lw 1.4 title 'work, held out', \
  keyentry with lines lc rgb sky lw 1.4 title 'steps, all problems', \
  keyentry with lines lc rgb grey dt (3,3) lw 1.4 title 'no monitor: work, all problems'
unset multiplot
