# Evaluations that each method needs over all instances of the arena: left, share solved with at most a multiple of the
# evaluations of the best method (performance profile); right, share solved within a budget (data profile).
width = 16; height = 9
load 'figures/style.gp'
shown = 'minimise_m7 minimise_m0 lbfgs cg_hz gsl_bfgs2 barzilai_borwein nag_restart bregman_restarted rmsprop_best bregman_htvi'
set style line 201 lc rgb blue      dt 1         lw 2.6
set style line 202 lc rgb sky       dt 1         lw 2.2
set style line 203 lc rgb black     dt 1         lw 1.6
set style line 204 lc rgb vermilion dt (9,3)     lw 1.6
set style line 205 lc rgb green     dt (3,3)     lw 1.6
set style line 206 lc rgb orange    dt (9,3,2,3) lw 1.6
set style line 207 lc rgb purple    dt (14,4)    lw 1.6
set style line 208 lc rgb blue      dt (5,3)     lw 1.6
set style line 209 lc rgb grey      dt 1         lw 1.6
set style line 210 lc rgb grey      dt (5,3)     lw 1.6
named(m) = m eq 'minimise_m7' ? 'minimise, m = 7' : m eq 'minimise_m0' ? 'minimise, m = 0' : m eq 'lbfgs' ? 'L-BFGS(10)' \
  : m eq 'cg_hz' ? 'CG (HZ)' : m eq 'gsl_bfgs2' ? 'GSL bfgs2' : m eq 'barzilai_borwein' ? 'Barzilai–Borwein' \
  : m eq 'nag_restart' ? 'NAG with restart' : m eq 'bregman_restarted' ? 'p/t clock with restart' \
  : m eq 'rmsprop_best' ? 'RMSprop, best of 6' : 'HTVI, best of 6'
set multiplot
page_bottom = 0.37
set logscale x
set yrange [0:1]
set ylabel 'share of instances solved'
eval panel(1, 1, 2, 1)
set xrange [1:32]
set xtics (1, 2, 4, 8, 16, 32)
set xlabel 'evaluations over those of the best method'
unset key
table = data.'/optimiser_arena_profiles.tsv'
plot for [i=1:words(shown)] table using (where('method', word(shown, i), 'ratio')):'share' with steps ls 200+i notitle
eval panel(2, 1, 2, 1)
set xrange [10:20000]
set xtics auto
eval logx
unset ylabel
set xlabel 'evaluations'
table = data.'/optimiser_arena_budgets.tsv'
plot for [i=1:words(shown)] table using (where('method', word(shown, i), 'evaluations')):'share' with steps ls 200+i notitle
eval legend(0.2)
set key maxrows 4 width -9 samplen 2 font ',7'
plot for [i=1:words(shown)] NaN with lines ls 200+i title named(word(shown, i))
unset multiplot
