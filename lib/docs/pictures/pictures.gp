# The pictures of the examples: gnuplot -e "data='FOLDER'; output='FOLDER'" pictures.gp
blue = "#0072b2"; red = "#d55e00"; green = "#009e73"; grey = "#888888"
high = "pngcairo size 640,420 font 'sans,13' enhanced"; low = "pngcairo size 640,230 font 'sans,13' enhanced"
set terminal @high
set border 3 lc rgb "#555555"
set tics nomirror out textcolor rgb "#333333"
set key noautotitle
file(name) = data."/".name.".dat"
picture(name) = output."/".name.".png"

set terminal @low
set output picture("orbit")
set multiplot layout 1, 2
unset border; unset tics
set size ratio -1; set xrange [-2.4:0.3]; set yrange [-0.75:0.75]
do for [i = 1:2] {
  stats file("orbit") index i using 4 nooutput
  exponent = floor(log10(STATS_max))
  set title (i == 1 ? "40 equal steps in time" : "40 steps that follow the motion").sprintf("\nenergy error %.0f·10^{%d}", STATS_max/10**exponent, exponent)
  plot file("orbit") index 0 with lines lc rgb "#cccccc" lw 2, \
    "" index i with points pt 7 ps 0.7 lc rgb (i == 1 ? red : blue), \
    "<echo 0 0" with points pt 7 ps 1.6 lc rgb "#e6a400"
}
unset multiplot
unset title; set border 3; set xtics nomirror out; set ytics nomirror out; set size noratio; set autoscale
set terminal @high

set output picture("spring")
set size ratio -1; set xlabel "x"; set ylabel "y"
set key center top horizontal at graph 0.5, 1.12
plot file("spring") index 1 with lines lw 1.5 lc rgb red title "rope", \
  "" index 0 with lines lw 1.5 lc rgb blue title "spring", "<echo 0 0" with points pt 7 ps 1 lc rgb "#333333"

set output picture("untuned")
unset key
plot file("untuned") with lines lw 0.8 lc rgb blue, "<echo -1 0; echo 1 0" with points pt 7 ps 1.4 lc rgb red
set size noratio

set output picture("henon_heiles")
set xlabel "y"; set ylabel "p_y"; set size ratio -1
plot for [i = 0:8] file("henon_heiles") index i with dots lw 2 lc rgb (i == 0 ? red : blue)

set terminal @low
set output picture("figure_eight")
set xlabel "x"; set ylabel "y"; set ytics 0.3
plot file("figure_eight") using 1:2 with lines lw 2 lc rgb "#cccccc", \
  "" every ::20::20 using 1:2 with points pt 7 ps 2 lc rgb red, "" every ::20::20 using 3:4 with points pt 7 ps 2 lc rgb blue, \
  "" every ::20::20 using 5:6 with points pt 7 ps 2 lc rgb green
set size noratio; set ytics auto
set terminal @high

set output picture("separatrix")
set xlabel "angle"; set ylabel "momentum"; set xrange [-pi:pi]; set yrange [-3:3]
set xtics ("-π" -pi, "0" 0, "π" pi)
plot file("separatrix") using 1:2 with dots lw 2 lc rgb blue, "" using (-$1):2 with dots lw 2 lc rgb blue, \
  "" using 1:(-$2) with dots lw 2 lc rgb blue
set xtics auto; set autoscale

set output picture("driven_pendulum")
set xlabel "angle"; set ylabel "momentum"
plot file("driven_pendulum") with lines lw 1.2 lc rgb blue, "" every 60::59 with points pt 7 ps 1.1 lc rgb red

set output picture("eccentric_binary")
set xlabel "time"; set ylabel "length of a step"; set logscale y; set format y "10^{%L}"
plot file("eccentric_binary") with linespoints pt 7 ps 0.4 lc rgb blue

set output picture("kepler")
plot file("kepler") with linespoints pt 7 ps 0.4 lc rgb blue

set output picture("own_problem")
set xlabel "step h"; set ylabel "error of the energy"; set logscale x; set key default; set key noautotitle left top reverse Left; set xrange [0.095:0.45]
set xtics (0.1, 0.2, 0.4)
plot file("own_problem") index 0 with linespoints pt 7 ps 0.8 lc rgb red title "three nodes", \
  "" index 1 with linespoints pt 5 ps 0.8 lc rgb blue title "six nodes"
unset logscale; set format; unset key; set xrange [*:*]; set xtics auto

set output picture("minimise")
set xlabel "x_0"; set ylabel "x_1"; unset colorbox; set palette gray; set cbrange [-5:4]
set xrange [-1.6:1.6]; set yrange [-0.6:1.8]
plot file("minimise") index 0 with image, "" index 1 with linespoints pt 7 ps 0.8 lw 1.5 lc rgb red
