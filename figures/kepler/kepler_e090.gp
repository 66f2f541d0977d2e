# Table 1 as a picture: errors against steps and against time, ours and the paper's.
stem = 'kepler_e090'
load 'figures/kepler/kepler_table.gp'
