# Many starts of a pendulum with shaken gravity, seen once in each period of the shaking: where the separatrix of the
# unshaken pendulum (line) was, a layer of chaos lies between swinging and turning over.
width = 12; height = 8
load 'figures/style.gp'
section = data.'/ensembles_section.tsv'
unset key
set xlabel 'angle q'; set ylabel 'momentum p'
set xrange [-pi:pi]; set yrange [-3:3]
set xtics ('−π' -pi, '−π/2' -pi/2, '0' 0, 'π/2' pi/2, 'π' pi)
plot section using 'angle':'momentum' with points pt 7 ps 0.12 lc rgb blue, \
  [x=-pi:pi] 2*cos(x/2) with lines lc rgb black, [x=-pi:pi] -2*cos(x/2) with lines lc rgb black
