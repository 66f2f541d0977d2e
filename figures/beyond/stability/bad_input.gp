# Invalid arguments to every entry point of the library: how many were refused, how many ended the run with a name, and
# how many (none) were accepted.
width = 16; height = 5.4
load 'figures/style.gp'
counts = data.'/bad_input_counts.tsv'
page_left = 3.2; page_right = 0.6
eval panel(1, 1, 1, 1)
parts = 'optimisers minimise integrate collocation monitors quadrature problems diagnostics'
row(s) = position(parts, s)
set xlabel 'inputs tried'
set xrange [0:140]
set yrange [words(parts)+0.6:0.4]
set format y ''
set ytics scale 0
set for [i=1:words(parts)] ytics add (word(parts, i) i)
set key bottom right
plot counts using (0):(row(strcol('part'))):'refused':(0) with vectors nohead lw 8 lc rgb blue title 'refused', \
  counts using 'refused':(row(strcol('part'))):'named':(0) with vectors nohead lw 8 lc rgb sky title 'ended with a name', \
  counts using (0):(row(strcol('part'))):'taken':(0) with vectors nohead lw 8 lc rgb vermilion title 'taken', \
  counts using 'inputs':(row(strcol('part'))):'inputs' with labels left offset 1, 0 font ',7' notitle
