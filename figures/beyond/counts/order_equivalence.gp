# Left: f for Adaptive (4, 1), with Euler's clock as in the paper and with the exact one, beside Direct of order 16. Right:
# distance of the iterates from those of the Direct method after 100 steps.
width = 16; height = 5.4
load 'figures/style.gp'
curves = data.'/order_equivalence_curves.tsv'
table = data.'/order_equivalence.tsv'
set multiplot
page_left = 1.85; page_bottom = 1.15; page_top = 0.65; gap_x = 2.2
eval logy
set xlabel 'iterations'
set ylabel 'f − f*'
set format x '%g'
set xrange [0:10000]; set xtics 3000
set yrange [1e-30:1e10]
set key bottom left Left reverse samplen 3
eval panel(1, 1, 2, 1)
set title 'p = 4, p̊ = 1, h = 2.4·10^{-4}' offset 0, -0.7
plot curves using (where('curve', 'direct', 'iteration')):'envelope' with lines ls approach('direct') dt 1 lw 3.5 title 'Direct, p = 16', \
  curves using (where('curve', 'adaptive exact', 'iteration')):'envelope' with lines lc rgb black dt (3,3) lw 1.8 title 'Adaptive, exact clock', \
  curves using (where('curve', 'adaptive euler', 'iteration')):'envelope' with lines ls approach('adaptive') title "Adaptive, Euler's clock"
eval logx
set xtics autofreq; set xrange [3:200]; set yrange [1e-15:1]
set xlabel 'order P = p^2/p̊'; set ylabel 'distance, 100 steps'
set key at graph 0.98, 0.48 right center
eval panel(2, 1, 2, 1)
unset title
plot table using (where('clock', 'euler', 'order')):'distance_100' with points ls approach('adaptive') ps 1 title "Euler's clock", \
  table using (where('clock', 'exact', 'order')):'distance_100' with points lc rgb black pt 4 ps 1 title 'exact clock'
unset multiplot
