"""Ten periods of a Kepler orbit of eccentricity 0.9: avi.solve() beside scipy.integrate.solve_ivp()."""

from time import perf_counter

import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import solve_ivp

import avi

q, p = [0.1, 0.0], [0.0, np.sqrt(19.0)]  # pericentre; a period is 2 pi
times = np.linspace(0, 20 * np.pi, 2001)


def kepler(q, p):
    return p @ p / 2 - 1 / np.sqrt(q @ q)


def slopes(t, y):  # the same by hand, for SciPy
    return np.concatenate([y[2:], -y[:2] * (y[:2] @ y[:2]) ** -1.5])


begun = perf_counter()
ours = avi.solve(kepler, q, p, times, 1e-9, dense=True)
print(f"avi.solve: {1e3 * (perf_counter() - begun):.1f} ms, position at the end off by {np.linalg.norm(ours.q[:, -1] - q):.0e}")
begun = perf_counter()
theirs = solve_ivp(slopes, (0, times[-1]), q + p, "DOP853", times, rtol=1e-9, atol=1e-9)
print(f"solve_ivp: {1e3 * (perf_counter() - begun):.1f} ms, position at the end off by {np.linalg.norm(theirs.y[:2, -1] - q):.0e}")

figure, ((left, right), (below, steps)) = plt.subplots(2, 2, figsize=(10, 7), layout="constrained")
avi.plot.orbit(ours, ax=left, color="C0")
left.set_title("the orbit and its steps")
avi.plot.energy_error(ours, ax=right, color="C0", label="avi.solve, tol = 1e-9")
energy = np.array([kepler(*np.split(y, 2)) for y in theirs.y.T])
right.plot(theirs.t[1:], np.abs(energy[1:] - energy[0]) / ours.choice.energy_scale, color="C1", label="solve_ivp, DOP853, rtol = atol = 1e-9")
right.legend()
avi.plot.work_precision(kepler, q, p, times[-1], slopes=slopes, ax=below)
avi.plot.step_size(ours, ax=steps, color="C0")
plt.savefig("eccentric_orbit.png", dpi=110)
