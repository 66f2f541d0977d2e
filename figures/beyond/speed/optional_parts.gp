# What each optional part of an HTVI step costs: time per step over that of the same run without it, for two orders.
width = 16; height = 5.4
load 'figures/style.gp'
table = data.'/optional_parts.tsv'
page_left = 7.4; page_top = 0.15
eval panel(1, 1, 1, 1)
set key at 5.7, -8.6
set logscale x 10
set xtics (0.2, 0.5, 1, 2, 5)
set xrange [0.2:6]
set xlabel "time per step over that of the run without it"
set grid x noy
set border 1
set ytics scale 0
# One line for each part, in the order of the table; runs compared with themselves are no parts.
shown(order) = strcol('order') eq order && strcol('part') ne strcol('without')
ratio(order) = shown(order) ? (k = k + 1, column('ratio_of_seconds')) : NaN
ticks = ''; k = 0
stats table using (shown('4') ? (k = k + 1, ticks = ticks.sprintf('"%s" %d,', strcol('part'), -k), k) : NaN) nooutput
eval 'set ytics ('.ticks[1:strlen(ticks)-1].')'
set yrange [-k-0.6:-0.4]
set arrow from 1, graph 0 to 1, graph 1 nohead ls guide front
plot k = 0, table using (ratio('4')):(-k):(1):(column('ratio_of_seconds')):(-k+0.02):(-k+0.34) with boxxyerror fc rgb sky title 'order 4', \
     k = 0, table using (ratio('8')):(-k):(1):(column('ratio_of_seconds')):(-k-0.34):(-k-0.02) with boxxyerror fc rgb blue title 'order 8'
