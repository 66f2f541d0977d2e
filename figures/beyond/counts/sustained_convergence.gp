# Above: f around the first passage of the stopping test. Below: iterations until the test first holds (open) and until it
# holds for good (filled), for every run of the paper's tables: method, p and p̊ (Direct has p alone), h.
width = 16; height = 14
load 'figures/style.gp'
curves = data.'/sustained_convergence_curves.tsv'
table = data.'/sustained_convergence.tsv'

set multiplot
eval logy
page_left = 1.85; page_top = 0.65; page_bottom = 10.7; gap_x = 1.75
unset key
set yrange [1e-18:1e0]; set ytics 1e4
set xlabel 'iterations / first passage'
set ylabel 'f − f*'
# The last bin is a part of one: what it holds is no envelope.
whole_bin(x) = x < 3.99 ? x : NaN
do for [i = 1:2] {
  c = word('direct adaptive', i)
  eval panel(i, 1, 2, 1)
  set xrange [0.5:4]
  set title label(c).(i == 1 ? ', p = 4' : ', p = 4, p̊ = 1') offset 0, -0.7
  set arrow 1 from 1, graph 0 to 1, graph 1 nohead ls guide
  plot curves using (also('approach', c, whole_bin(column('iteration')/column('first_passage')))):'least':'most' with filledcurves fc rgb (i == 1 ? vermilion : blue) \
    fs transparent solid 0.3 noborder, \
    curves using (also('approach', c, whole_bin(column('iteration')/column('first_passage')))):'most' with lines ls approach(c) dt 1 lw 1
  set ylabel ''
}
unset arrow 1; unset title
page_left = 7.4; page_top = 4.6; page_bottom = 1.1
eval panel(1, 1, 1, 1)
unset logscale y; eval logx
set format y '%s'; set ytics autofreq font ',7'
set xrange [4e3:2e6]
set yrange [*:*] reverse
set xlabel 'iterations until the stopping test holds'
set offsets 0, 0, 0.7, 0.7
set key bottom right Left reverse
row_name(m) = label(m).sprintf(', p = %g', column('p')).(strcol('p_ring') eq 'nan' ? '' : sprintf(', p̊ = %g', column('p_ring'))).', h = '.small(column('h'))
plot table using 'first_passage':0:(column('sustained')-column('first_passage')):(0):ytic(row_name(strcol('method'))) with vectors nohead ls guide dt 1 notitle, \
  table using 'first_passage':0 with points ls published lc rgb blue ps 0.8 title 'first', \
  table using 'sustained':0 with points ls approach('adaptive') ps 0.8 title 'for good'
unset multiplot
