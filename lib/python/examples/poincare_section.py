"""A Poincaré section of the Hénon–Heiles system at energy 1/8 from a thousand starts, on all cores."""

from time import perf_counter

import matplotlib.pyplot as plt
import numpy as np

import avi


def henon_heiles(q, p):
    x, y = q
    return (p @ p + q @ q) / 2 + x**2 * y - y**3 / 3


# Starts on the section x = 0 with energy 1/8: y and p_y at random, p_x > 0 from the energy.
random = np.random.default_rng(1)
y, p_y = random.uniform(-0.6, 0.9, 20000), random.uniform(-0.6, 0.6, 20000)
square = 2 * (1 / 8 - p_y**2 / 2 - y**2 / 2 + y**3 / 3)
inside = np.flatnonzero((square > 0) & (y < 1))[:1000]
q = np.column_stack([np.zeros(1000), y[inside]])
p = np.column_stack([np.sqrt(square[inside]), p_y[inside]])

crossing = avi.event(lambda q, p: q[0], direction=1)
begun = perf_counter()
orbits = avi.ensemble(henon_heiles, q, p, 300.0, 1e-8, events=crossing, check=False)
points = [orbit.y_events[0] for orbit in orbits]
print(f"{len(orbits)} orbits, {sum(map(len, points))} crossings in {perf_counter() - begun:.1f} s")
print(f"largest energy error {max(orbit.energy_error for orbit in orbits):.0e}")

figure, axes = plt.subplots(figsize=(6, 5), layout="constrained")
for each in points:  # an orbit that comes to many places is chaotic
    places = len(np.unique(np.round(each[:, [1, 3]] / 0.05), axis=0)) / len(each)
    axes.plot(each[:, 1], each[:, 3], ".", markersize=1, color=plt.cm.plasma(1 - places))
axes.set(xlabel="$y$", ylabel="$p_y$", title="Hénon–Heiles, energy 1/8, at $x = 0$, $p_x > 0$\ndark: chaotic; bright: on a curve")
plt.savefig("poincare_section.png", dpi=90)
