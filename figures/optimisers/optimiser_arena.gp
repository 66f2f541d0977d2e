# Evaluations that each method needs over all instances of the arena: left, share solved with at most a multiple of the
# evaluations of the best method (performance profile); right, share solved within a budget (data profile). Up to 20 000
# evaluations, but 1000 for HTVI and RMSprop.
width = 16; height = 6.8
load 'figures/style.gp'
shown = 'minimise_m7 minimise_m0 lbfgs cg_pr gsl_bfgs2 barzilai_borwein nag_restart bregman_restarted rmsprop_best bregman_htvi'
# Lines without markers: those of style.gp for the methods that it knows, the others from 201 on.
set style line 201 lc rgb sky  dt (9,3) lw 1.6  # cg_pr
set style line 202 lc rgb grey dt 1     lw 1.6  # gsl_bfgs2
set style line 203 lc rgb grey dt (5,3) lw 1.6  # barzilai_borwein
set style line 204 lc rgb '#7a4a1a' dt 1 lw 2  # bregman_restarted
here = 'cg_pr gsl_bfgs2 barzilai_borwein bregman_restarted nag_restart rmsprop_best bregman_htvi'
array called[7] = ['CG (PR+)', 'GSL bfgs2', 'Barzilai–Borwein', 'p/t clock with restart', 'NAG with restart', 'RMSprop, best of 6', 'HTVI, best of 6']
number(m) = position(here, m)
look(m) = !number(m) ? method(m) : number(m) <= 4 ? 200 + number(m) : method(word('nag rmsprop htvi', number(m) - 4))
named(m) = number(m) ? called[number(m)] : label(m)
set multiplot
page_bottom = 2.35; gap_x = 1.7
set logscale x
set yrange [0:1]
set ylabel 'share of instances solved'
eval panel(1, 1, 2, 1)
set xrange [1:32]
set xtics (1, 2, 4, 8, 16, 32)
set xlabel 'evaluations over those of the best method'
unset key
table = data.'/optimiser_arena_profiles.tsv'
plot for [i=1:words(shown)] table using (where('method', word(shown, i), 'ratio')):'share' with steps ls look(word(shown, i)) notitle
eval panel(2, 1, 2, 1)
set xrange [10:20000]
set xtics auto
eval logx
set xlabel 'evaluations'
table = data.'/optimiser_arena_budgets.tsv'
plot for [i=1:words(shown)] table using (where('method', word(shown, i), 'evaluations')):'share' with steps ls look(word(shown, i)) notitle
eval legend(1.25)
set key maxrows 3 samplen 2 width -7
plot for [i=1:words(shown)] NaN with lines ls look(word(shown, i)) title named(word(shown, i))
unset multiplot
