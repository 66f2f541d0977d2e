# A blurred and noisy picture and its restoration by minimise(); below, how |gradient| falls with the number of
# gradients.
width = 16; height = 11
load 'figures/style.gp'
pixels = data.'/deblurring_pixels.tsv'; curves = data.'/deblurring_curves.tsv'
set multiplot
unset key; unset border; unset tics; unset colorbox; unset grid
set palette gray
set cbrange [0:1]
set xrange [-0.5:63.5]; set yrange [63.5:-0.5]
set size ratio -1
do for [k=1:3] {
  eval panel(k, 1, 3, 1).at_screen('b', 0.56)
  set title word('picture blurred restored', k) offset 0, -0.8
  plot pixels using 'column':'row':(column(word('truth blurred restored', k))) with image notitle
}
unset title
set size noratio
set border 3; set tics nomirror; set grid; set key top right
set lmargin at screen page_left; set rmargin at screen page_right - 0.015; set tmargin at screen 0.5; set bmargin at screen page_bottom
set xrange [0:*]; set yrange [1e-11:2]
eval logy
set xlabel 'gradients'
set ylabel '|∇f| / |∇f_0|'
plot curves using (where('method', 'minimise_m7', 'gradients')):'gradient_ratio' with lines lc rgb blue lw 1.8 title 'minimise, m = 7', \
  curves using (where('method', 'minimise_m0', 'gradients')):'gradient_ratio' with lines lc rgb sky lw 1.4 title 'minimise, m = 0', \
  curves using (where('method', 'lbfgs', 'gradients')):'gradient_ratio' with lines lc rgb black dt (9,3) lw 1.4 title 'L-BFGS(10), liblbfgs'
unset multiplot
