# A blurred and noisy picture and its restoration by minimise(); below, how |gradient| falls with the number of
# gradients.
width = 12; height = 7.6
load 'figures/style.gp'
pixels = data.'/deblurring_pixels.tsv'; curves = data.'/deblurring_curves.tsv'
set multiplot
page_top = 0.6; page_bottom = 4; gap_x = 0.4
unset key; unset border; unset tics; unset colorbox; unset grid
set palette gray
set cbrange [0:1]
set xrange [-0.5:63.5]; set yrange [63.5:-0.5]
set size ratio -1
do for [k=1:3] {
  eval panel(k, 1, 3, 1)
  set title word('picture blurred restored', k) offset 0, -0.8
  plot pixels using 'column':'row':(column(word('truth blurred restored', k))) with image notitle
}
unset title
set size noratio
set border 3; set xtics nomirror out scale 0.6; set ytics nomirror out scale 0.6; set grid
set key at graph 1.03, 0.95 left top Left reverse noopaque
page_top = 4.2; page_bottom = 1.1; page_right = 3.6
eval panel(1, 1, 1, 1)
set xrange [0:*]; set yrange [1e-15:2]
eval logy
set xlabel 'gradients'
set ylabel '|∇f| / |∇f_0|'
plot curves using (where('method', 'minimise_m7', 'gradients')):'gradient_ratio' with lines ls method('minimise_m7') lw 1.8 title label('minimise_m7'), \
  curves using (where('method', 'minimise_m0', 'gradients')):'gradient_ratio' with lines ls method('minimise_m0') lw 1.4 title label('minimise_m0'), \
  curves using (where('method', 'lbfgs', 'gradients')):'gradient_ratio' with lines ls method('lbfgs') lw 1.4 title label('lbfgs')
unset multiplot
