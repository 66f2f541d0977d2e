# Energy errors of one method with 60 steps an orbit: variable steps, prescribed or from error control, make the energy
# drift; constant steps of the transformed problem do not.
width = 11; height = 5.4
load 'figures/style.gp'
file = data.'/naive_steps.tsv'
eval logx
eval logy
set xlabel 'orbits'
set ylabel 'largest energy error so far' offset -0.3, 0
set yrange [1e-8:10]
set key bottom right noopaque
only(m) = strcol('method') eq m ? column('energy_error') : NaN
plot file using 'periods':(only('naive')) with linespoints lw 1.8 pt 5 lc rgb vermilion title 'variable steps put in by hand', \
  file using 'periods':(only('error_controlled')) with linespoints lw 1.8 pt 9 lc rgb orange title 'variable steps from an error estimate', \
  file using 'periods':(only('collocation')) with linespoints lw 1.8 pt 7 lc rgb blue title 'constant steps of the transformed problem'
