# Steps of HTVI4 at one position error, without monitor and with gamma, against the eccentricity.
width = 8; height = 4.4
load 'figures/style.gp'
file = data.'/eccentricity_gain.tsv'
eval logy
set xlabel 'eccentricity e'; set ylabel 'steps' offset 0.2, 0
set xtics 0.2; set xrange [-0.03:0.95]; set yrange [10:1e5]
set key top left
plot file using 'eccentricity':(where('monitor', 'none', 'steps')) with linespoints ls monitor('none') title label('none'), \
  file using 'eccentricity':(where('monitor', 'gamma', 'steps')) with linespoints ls monitor('gamma') title label('gamma')
