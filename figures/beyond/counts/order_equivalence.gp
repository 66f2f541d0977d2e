# Left: how far the iterates of Adaptive (p, p̊) are from those of Direct of order P = p^2/p̊, with the exact clock
# and with Euler's, over 100 iterations and over 1000. Right: the iterations of the paper's table on p and p̊ against P.
width = 16; height = 5.8
load 'figures/style.gp'
table = data.'/order_equivalence.tsv'
set multiplot
page_left = 1.6; page_bottom = 1.15; page_top = 0.35; gap_x = 2.0
eval logx; eval logy
set xtics (4, 8, 16, 32, 64, 128); set format x '%g'; set mxtics 1
set xrange [3:220]
set xlabel 'order P = p^2/p̊'
set ylabel 'relative distance'
set yrange [1e-15:1e7]; set ytics 1e3
set key at graph 0.98, 0.99 right top maxrows 2 samplen 1.5
eval panel(1, 1, 2, 1)
plot table using (where('clock', 'euler', 'order')):'distance_100' with points lc rgb blue pt 7 ps 1 title "Euler, 100", \
  table using (where('clock', 'euler', 'order')):'distance_1000' with points lc rgb blue pt 6 ps 1 title "Euler, 1000", \
  table using (where('clock', 'exact', 'order')):'distance_100' with points lc rgb black pt 5 ps 0.9 title 'exact, 100', \
  table using (where('clock', 'exact', 'order')):'distance_1000' with points lc rgb black pt 4 ps 1 title 'exact, 1000'
set key maxrows 4
set ylabel 'iterations' offset -0.6, 0
set xrange [2.2:300]
set yrange [2e3:2e5]; set ytics 1e3, 10
set key at graph 0.98, 0.98 right top
eval panel(2, 1, 2, 1)
plot table using (where('clock', 'exact', 'order')):'direct_iterations' with points lc rgb black pt 4 ps 1.6 title 'Direct of order P', \
  table using (where('clock', 'euler', 'order')):'adaptive_iterations' with points ls approach('adaptive') ps 0.8 title 'Adaptive (p, p̊)', \
  table using (column('p') == 6 || column('order') == 32 || column('order') == 16 ? NaN : where('clock', 'euler', 'order')):'adaptive_iterations':(sprintf('(%g, %g)', column('p'), column('p_ring'))) with labels center offset 0, -0.95 font ',7' notitle, \
  table using (column('order') == 16 ? where('clock', 'euler', 'order') : NaN):'adaptive_iterations':(sprintf('(%g, %g)', column('p'), column('p_ring'))) with labels right offset -0.8, -0.4 font ',7' notitle, \
  table using (column('order') == 32 ? where('clock', 'euler', 'order') : NaN):'adaptive_iterations':(sprintf('(%g, %g)', column('p'), column('p_ring'))) with labels right offset -0.6, -0.7 font ',7' notitle, \
  table using (column('p') == 6 ? where('clock', 'euler', 'order') : NaN):'adaptive_iterations':(sprintf('(%g, %g)', column('p'), column('p_ring'))) with labels left offset 0.7, 0.5 font ',7' notitle
unset multiplot
