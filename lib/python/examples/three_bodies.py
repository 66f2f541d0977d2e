"""Burrau's problem: three bodies of mass 3, 4 and 5 at rest in the corners of a right triangle, with every close encounter as an event."""

import matplotlib.pyplot as plt
import numpy as np

import avi

masses = np.array([3.0, 4.0, 5.0])
q = np.array([[1.0, 3.0], [-2.0, -1.0], [1.0, -1.0]])
p = np.zeros((3, 2))
pairs = [(0, 1), (0, 2), (1, 2)]


def energy(q, p):
    potential = sum(masses[i] * masses[j] / np.linalg.norm(q[i] - q[j]) for i, j in pairs)
    return np.sum(p**2 / masses[:, None]) / 2 - potential


def approach(i, j):
    """Rises through zero where bodies i and j are nearest to each other."""
    return avi.event(lambda q, p: (q[i] - q[j]) @ (p[i] / masses[i] - p[j] / masses[j]), direction=1)


orbit = avi.solve(energy, q, p, 10.0, 1e-8, events=[approach(i, j) for i, j in pairs], dense=True)
print(orbit)
distances = []
for (i, j), times, states in zip(pairs, orbit.t_events, orbit.y_events):
    nearest = np.linalg.norm(states[:, 2 * i : 2 * i + 2] - states[:, 2 * j : 2 * j + 2], axis=1)
    distances.append(nearest)
    if len(nearest):
        k = np.argmin(nearest)
        print(f"bodies {i} and {j}: {len(times)} encounters, the closest at t = {times[k]:.4f} with distance {nearest[k]:.2e}")

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 5), layout="constrained")
avi.plot.orbit(orbit, ax=left)
for body, mass in enumerate(masses):
    left.lines[2 * body].set(label=f"mass {mass:.0f}")
left.legend()
avi.plot.step_size(orbit, ax=right, color="0.6")
right.lines[0].set(label="step")
for (i, j), times, nearest in zip(pairs, orbit.t_events, distances):
    right.plot(times, nearest, "v", label=f"distance of {masses[i]:.0f} and {masses[j]:.0f} when nearest")
right.set(ylabel="step, distance", ylim=(1e-4, 1e3))
right.legend()
plt.savefig("three_bodies.png", dpi=110)
