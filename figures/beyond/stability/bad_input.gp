# Invalid arguments to every entry point of the library: how many were refused, how many ended the run with a name, and
# how many (none) were accepted.
width = 16; height = 6
load 'figures/style.gp'
counts = data.'/bad_input_counts.tsv'
set lmargin at screen 0.2; set rmargin at screen 0.96; set tmargin at screen 0.95; set bmargin at screen 0.27
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
