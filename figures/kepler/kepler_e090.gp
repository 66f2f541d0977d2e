# Table 1 as a picture: errors and time of each row, ours and the paper's.
stem = 'kepler_e090'
eccentricity = 0.9
load 'figures/kepler/kepler_table.gp'
