# The whole call of solve(), choosing and checking included, beside the best of other libraries at equal error of the
# position at the end: the ratio of times, below 1 where solve() is ahead, over 1, 10 and 100 characteristic times (after
# make work-precision over 1000, too). Filled: problems seen while the choice was designed; hollow: drawn up after it, held
# out (and looked at since).
width = 16; height = 6.4
load 'figures/style.gp'
table = data.'/front_door_cells.tsv'
thousand = int(system("grep -c -P '\t1000(\.0)?\t' ".table.' || true')) > 0
hundred = int(system("grep -c -P '\t100(\.0)?\t' ".table.' || true')) > 0
panels = thousand ? 4 : hundred ? 3 : 2
held_out = int(system("awk -F'\t' '!/^#/ && $3 == 1' ".table." | wc -l")) > 0
array horizon[4] = [1, 10, 100, 1000]
array title[4] = ['1', '10', '100', '1000']
kinds = 8
array kind[kinds] = ['one body', 'potential', 'pendulum', 'bodies', 'planets', 'chain', 'not separable', 'driven']
array colour[kinds] = [black, blue, sky, vermilion, orange, green, purple, grey]
eval logx
eval logy
set grid
unset key
set xrange [1e-2:1e-12]; set yrange [0.03:500]
set xtics (1e-3, 1e-7, 1e-11) font ',7'; set ytics font ',7'
cell(i, held) = column('horizon') == horizon[i] && column('held_out') == held ? column('ratio') : NaN
k_of(c) = sum [k=1:kinds] (c eq kind[k] ? k : 0)
tint(c) = int('0x'.substr(colour[int(k_of(c))], 2, 7))
apart(c) = column('target') * 10**(0.07 * (k_of(c) - 4.5))  # kinds side by side
set multiplot
page_left = 1.45; page_bottom = 2.3; page_top = 0.65; gap_x = 0.4
do for [i=1:panels] {
  eval panel(i, 1, panels, 1)
  set title title[i].(i == 1 ? ' characteristic time' : panels < 4 ? ' characteristic times' : ' times') font ',7' offset 0, -0.7
  set ylabel i == 1 ? 'time / best of others' : ''
  set format y i == 1 ? '10^{%L}' : ''
  set xlabel 'position error' offset 0, 0.4
  plot 1 with lines lc rgb black lw 1 notitle, \
    for [held = 0:held_out] table using (apart(strcol('kind'))):(cell(i, held)):(tint(strcol('kind'))) with points lc rgb variable pt (held ? 6 : 7) ps 0.5 notitle
}
eval legend(1)
set key maxrows 2 samplen 1 width -1 font ',7'
# Some kinds are held out alone.
there(k) = int(system("grep -c -P '\t".kind[k]."\t' ".table.' || true')) > 0
plot for [k=1:kinds] 2 with points lc rgb colour[k] pt 7 title there(k) ? kind[k] : '', \
  2 with points lc rgb black pt 6 title held_out ? 'hollow: held out' : ''
unset multiplot
