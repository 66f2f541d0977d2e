# Range of the counts from starts moved by 1e-14, in units of the unmoved count: in
# rows without a bar the count does not depend on rounding. Rows: method, p and p̊ (Direct has p alone), h.
width = 16; height = 8
load 'figures/style.gp'
table = data.'/rounding_sensitivity.tsv'
page_left = 6.9; page_top = 0.15
eval panel(1, 1, 1, 1)
at(y) = column('moved_by') > 5e-15 && column('moved_by') < 5e-14 ? y : NaN
row_name(m) = label(m).sprintf(', p = %g', column('p')).(strcol('p_ring') eq 'nan' ? '' : sprintf(', p̊ = %g', column('p_ring'))).', h = '.small(column('h'))
failures(n) = n > 0 ? sprintf('%g of %g fail', n, column('starts')) : ''
set xlabel 'count from a moved start over that from the start'
set xrange [0.72:1.32]
stats table using 'setting' nooutput
set yrange [STATS_max+1:0]
set format y ''; unset ytics
unset key
plot table using (at(column('least')/column('iterations'))):'setting':(at((column('most')-column('least'))/column('iterations'))):(0) \
    with vectors nohead lw 4 lc rgb vermilion, \
  table using (at(1)):'setting' with points pt 7 ps 0.6 lc rgb black, \
  table using (at(0.72)):'setting':(row_name(strcol('method'))) with labels right offset -1, 0 font ',7', \
  table using (at(1.2)):'setting':(failures(column('failed'))) with labels left font ',7'
