# Steps with monitors found from H alone, over those of the best monitor made by hand, for each problem and order; a
# star before the name: held out. A missing point: more than six times as many.
width = 16; height = 12
load 'figures/style.gp'
file = data.'/automatic_monitors_choices.tsv'
set multiplot
page_left = 1.45; page_right = 0.8; page_bottom = 3; page_top = 0.15; gap_y = 0.25
eval logy
set yrange [0.3:200]
set ylabel 'cost / best by hand' offset 0.5
set xrange [-0.7:*]
set grid xtics
unset xlabel
set xtics rotate by 60 right noenhanced font ',7'
set key top left horizontal maxrows 1 width -2
do for [order in '4 8 16'] {
  at(y) = strcol('order') eq order ? column(y) : NaN
  set format x (order eq '16' ? '%s' : '')
  set label 1 'order '.order at graph 0.985, 0.9 right
  if (order ne '4') { unset key }
  eval panel(1, position('4 8 16', order), 1, 3)
  plot file using (int($0/3)):(strcol('order') eq order ? 1.5 : NaN):xtic(order eq '16' ? (strcol('held_out') eq '1' ? '*' : '').spaced(strcol('problem')) : '') with lines ls guide title '1.5', \
    file using (int($0/3)):(at('none_work_ratio')) with points pt 2 ps 0.8 lc rgb grey title 'no monitor: work', \
    file using (int($0/3)):(at('chosen_ratio')) with points pt 6 ps 1.1 lc rgb sky title 'chosen: steps', \
    file using (int($0/3)):(at('chosen_work_ratio')) with points pt 7 ps 0.9 lc rgb vermilion title 'chosen: work'
  unset label 1
}
unset multiplot
