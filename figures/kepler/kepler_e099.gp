# Table 2 as a picture: errors and time of each row, ours and the paper's.
stem = 'kepler_e099'
eccentricity = 0.99
load 'figures/kepler/kepler_table.gp'
