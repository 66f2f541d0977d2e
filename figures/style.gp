# Shared by every figure: terminal, fonts, axes, and one place where a method, monitor or approach gets its colour,
# dash, marker and printed name. A figure script begins
#
#   # data: <stems it draws>
#   width = 16; height = 8            (centimetres; optional)
#   load 'figures/style.gp'
#
# and then plots, e.g. `plot data.'/x.tsv' using "t":"error" with linespoints ls method('htvi4') title label('htvi4')`.
# The Makefile passes `data` (folder), `output` (file) and `terminal` (pdf or png).

if (!exists('data')) data = 'build/data'
if (!exists('output')) output = 'build/figures/untitled.png'
if (!exists('terminal')) terminal = 'png'
if (!exists('width')) width = 15
if (!exists('height')) height = 9

# Same layout in every terminal: centimetres and 8-point type, as the paper prints figures without scaling them; rasters
# scale both by their resolution. The terminals take type for pixels, 96 to an inch: hence three quarters.
set encoding utf8
face = 'DejaVu Sans,8'
if (terminal eq 'pdf') {
  set terminal pdfcairo size width cm, height cm font face fontscale 0.75 linewidth 1 pointscale 0.8 butt enhanced
} else {
  dpi = 200
  set terminal pngcairo size int(width*dpi/2.54), int(height*dpi/2.54) font face fontscale dpi/96.0 \
    linewidth dpi/115.0 pointscale dpi/88.0 butt enhanced background '#ffffff'
}
set output output

# The data contract: tabs, `#` comments, one row of column names, nan for a missing value.
set datafile separator tab
set datafile commentschars '#'
set datafile columnheaders
set datafile missing NaN

# Value of column x in the rows where column c holds the word v, and the value y there; other rows are skipped, and
# a line runs on across them. where('monitor', 'gamma', 'steps'), also('monitor', 'gamma', also('method', 'htvi4', y)).
where(c, v, x) = strcol(c) eq v ? column(x) : NaN
also(c, v, y) = strcol(c) eq v ? y : NaN

# The paper's numbers, paper/published/<stem>.tsv: one line for each cell, a row's cells in the order of its columns.
if (!exists('published_in')) published_in = 'paper/published'
paper(stem) = published_in.'/'.stem.'.tsv'

set border 3 lc rgb '#404040'
set tics nomirror out scale 0.6 textcolor rgb '#202020'
set grid back lc rgb '#cccccc' lw 0.6 dt 1
set key top right opaque samplen 3 spacing 1.15 height 0.3
set style fill solid 0.85 noborder
set pointsize 0.7
set ylabel offset 1, 0

# Logarithmic axes with powers of ten, whose width gnuplot overestimates: `eval logx`, `eval logy`.
logx = "set logscale x 10; set format x '10^{%L}'; set mxtics 10"
logy = "set logscale y 10; set format y '10^{%L}'; set mytics 10; set ylabel offset 1.4, 0"

# Palette of M. Okabe and K. Ito, Color Universal Design (2008), also in B. Wong, Nature Methods 8, 441 (2011):
# told apart with every common colour vision; yellow is left out, too pale for lines. Dash and marker differ too,
# so that the figures read in grey.
black = '#000000'; orange = '#e69f00'; sky = '#56b4e9'; green = '#009e73'
blue = '#0072b2'; vermilion = '#d55e00'; purple = '#cc79a7'; grey = '#8a8a8a'

# Guides (theory, zero, limits) and the values printed in the paper: ls guide, ls published.
guide = 1; published = 2
set style line guide     lc rgb grey  dt (6,4) lw 1.2 pt 1
set style line published lc rgb black dt 1     lw 1.2 pt 6 ps 1.5

position(list, name) = sum [i=1:words(list)] (word(list, i) eq name ? i : 0)

monitors = 'none gamma arclength energy truncation norm_squared truncation_root'
monitor(name) = 10 + position(monitors, name)
set style line 11 lc rgb black     dt 1          lw 1.8 pt 2   # none
set style line 12 lc rgb blue      dt 1          lw 1.8 pt 7   # gamma
set style line 13 lc rgb vermilion dt (9,3)      lw 1.8 pt 5   # arclength
set style line 14 lc rgb green     dt (3,3)      lw 1.8 pt 9   # energy
set style line 15 lc rgb orange    dt (9,3,2,3)  lw 1.8 pt 13  # truncation
set style line 16 lc rgb purple    dt (14,4)     lw 1.8 pt 11  # norm_squared
set style line 17 lc rgb sky       dt (5,3)      lw 1.8 pt 8   # truncation_root

methods = 'htvi htvi4 stormer_verlet symplectic_euler_b log_hamiltonian splitting clone_strang clone_y4 clone_y6 ' \
  .'nag adam adagrad rmsprop trust_region gradient_descent runge_kutta_4 dormand_prince bogacki_shampine collocation ' \
  .'minimise_m7 minimise_m0 lbfgs'
method(name) = 30 + position(methods, name)
set style line 31 lc rgb blue      dt 1          lw 1.8 pt 7   # htvi
set style line 32 lc rgb blue      dt 1          lw 1.8 pt 7   # htvi4
set style line 33 lc rgb vermilion dt (9,3)      lw 1.8 pt 5   # stormer_verlet
set style line 34 lc rgb black     dt 1          lw 1.8 pt 2   # symplectic_euler_b
set style line 35 lc rgb green     dt (14,4)     lw 1.8 pt 10  # log_hamiltonian
set style line 36 lc rgb orange    dt (9,3)      lw 1.8 pt 5   # splitting
set style line 37 lc rgb sky       dt (3,3)      lw 1.8 pt 8   # clone_strang
set style line 38 lc rgb green     dt (9,3,2,3)  lw 1.8 pt 9   # clone_y4
set style line 39 lc rgb purple    dt (14,4)     lw 1.8 pt 13  # clone_y6
set style line 40 lc rgb black     dt 1          lw 1.8 pt 2   # nag
set style line 41 lc rgb vermilion dt (9,3)      lw 1.8 pt 5   # adam
set style line 42 lc rgb purple    dt (14,4)     lw 1.8 pt 13  # adagrad
set style line 43 lc rgb green     dt (3,3)      lw 1.8 pt 9   # rmsprop
set style line 44 lc rgb orange    dt (9,3,2,3)  lw 1.8 pt 11  # trust_region
set style line 45 lc rgb grey      dt (5,3)      lw 1.8 pt 1   # gradient_descent
set style line 46 lc rgb black     dt (9,3)      lw 1.8 pt 4   # runge_kutta_4
set style line 47 lc rgb vermilion dt 1          lw 1.8 pt 5   # dormand_prince
set style line 48 lc rgb orange    dt (3,3)      lw 1.8 pt 9   # bogacki_shampine
set style line 49 lc rgb black     dt 1          lw 1.8 pt 7   # collocation
set style line 50 lc rgb vermilion dt 1          lw 2.6 pt 7   # minimise_m7
set style line 51 lc rgb orange    dt 1          lw 2.2 pt 6   # minimise_m0
set style line 52 lc rgb purple    dt 1          lw 1.6 pt 5   # lbfgs

# direct, adaptive
approach(name) = name eq 'adaptive' ? 60 : 61
set style line 60 lc rgb blue      dt 1          lw 1.8 pt 7
set style line 61 lc rgb vermilion dt (9,3)      lw 1.8 pt 5

# A family (orders, exponents, tolerances): from dark to light, `ls family(i)`, i = 1 ... 6.
family(i) = 70 + i
set style line 71 lc rgb '#00204d' dt 1          lw 1.8 pt 7
set style line 72 lc rgb '#31446b' dt (9,3)      lw 1.8 pt 5
set style line 73 lc rgb '#666970' dt (3,3)      lw 1.8 pt 9
set style line 74 lc rgb '#958f78' dt (9,3,2,3)  lw 1.8 pt 13
set style line 75 lc rgb '#cab969' dt (14,4)     lw 1.8 pt 11
set style line 76 lc rgb '#e8cf3e' dt (4,2,1,2)  lw 1.8 pt 4

# Printed names; a name without one is printed as it is, underscores as spaces.
names = 'none gamma arclength energy truncation norm_squared truncation_root htvi htvi4 stormer_verlet symplectic_euler_b ' \
  .'log_hamiltonian splitting clone_strang clone_y4 clone_y6 nag adam adagrad rmsprop trust_region ' \
  .'gradient_descent runge_kutta_4 dormand_prince bogacki_shampine direct adaptive collocation minimise_m7 minimise_m0 lbfgs'
array printed[31] = ['no monitor', 'gamma', 'arclength', 'energy', 'truncation error', 'q^Tq', \
  'truncation error, 4th root', 'HTVI', 'HTVI4', \
  'Störmer–Verlet', 'symplectic Euler-B', 'logarithmic Hamiltonian', 'splitting', 'cloning, Strang', \
  'cloning, Yoshida 4', 'cloning, Yoshida 6', 'NAG', 'ADAM', 'AdaGrad', 'RMSprop', 'trust region', \
  'gradient descent', 'Runge–Kutta 4', 'Dormand–Prince 5(4)', 'Bogacki–Shampine 3(2)', 'Direct', 'Adaptive', 'Gauss collocation', \
  'minimise, m = 7', 'minimise, m = 0', 'L-BFGS(10)']
spaced(s) = strstrt(s, '_') ? s[1:strstrt(s, '_')-1].' '.spaced(s[strstrt(s, '_')+1:*]) : s
# A small number for people: 1.95·10^{-5}.
small(x) = sprintf('%g·10^{%d}', x/10**floor(log10(x) + 1e-9), floor(log10(x) + 1e-9))
label(name) = position(names, name) ? printed[position(names, name)] : spaced(name)

# Several panels (within `set multiplot`): `eval panel(i, j, columns, rows)` places column i, row j, counted from the top
# left. Margins and gaps are in centimetres; below, in page_bottom, there may be room for `eval legend(height)`, after
# which a plot shows its key alone.
page_left = 1.7; page_right = 0.3; page_top = 0.3; page_bottom = 1.1; gap_x = 1.4; gap_y = 0.5
cell_w(columns) = (width - page_left - page_right - (columns-1)*gap_x) / columns
cell_h(rows) = (height - page_top - page_bottom - (rows-1)*gap_y) / rows
side(name, length, all) = sprintf('set %smargin at screen %.5f;', name, length/all)
box(left, bottom, w, h) = side('l', left, width).side('r', left + w, width).side('b', bottom, height).side('t', bottom + h, height)
panel(i, j, columns, rows) = box(page_left + (i-1)*(cell_w(columns) + gap_x), \
  height - page_top - j*cell_h(rows) - (j-1)*gap_y, cell_w(columns), cell_h(rows))
legend(h) = box(0.1, 0.1, width - 0.2, h) \
  ."unset border; unset tics; unset xlabel; unset ylabel; unset logscale; unset label; unset arrow; unset title;" \
  ."set xrange [0:1]; set yrange [0:1]; set key inside center center vertical Left reverse maxrows 4 width 1 spacing 1.05 height 0"
