"""Logistic regression of 2000 samples with 50 badly scaled features: avi.minimise() beside SciPy's L-BFGS-B."""

from time import perf_counter

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import minimize

import avi

random = np.random.default_rng(1)
features = random.normal(size=(2000, 50)) * np.logspace(0, 2, 50)
labels = np.sign(features @ (random.normal(size=50) / np.logspace(0, 2, 50)) + random.normal(size=2000))


def loss(w):
    return np.mean(np.logaddexp(0, -labels * (features @ w))) + 1e-4 * np.sum(w**2)


def slope(w):  # by hand, for SciPy
    return features.T @ (-labels / (1 + np.exp(labels * (features @ w)))) / len(labels) + 2e-4 * w


start = np.zeros(50)
begun = perf_counter()
ours = avi.minimise(loss, start, history=True)
print(f"avi.minimise: {ours.njev} gradients, {perf_counter() - begun:.2f} s with tracing, loss {ours.fun:.12f}")

seen = []
begun = perf_counter()
theirs = minimize(loss, start, jac=slope, method="L-BFGS-B", callback=lambda w: seen.append(loss(w)),
                  options={"maxiter": 10000, "ftol": 0, "gtol": 1e-6 * np.abs(slope(start)).max()})  # fmt: skip
print(f"L-BFGS-B:     {theirs.njev} gradients, {perf_counter() - begun:.2f} s, loss {theirs.fun:.12f}")

ax = avi.plot.convergence(ours, least=min(ours.fun, theirs.fun))
ax.plot(np.linspace(1, theirs.njev, len(seen)), np.array(seen) - min(ours.fun, theirs.fun), "--", label="L-BFGS-B, $f - f_{\\min}$")
for line in ax.lines[:2]:
    line.set_label(f"avi.minimise, {line.get_label()}")
ax.set_ylabel("$f - f_{\\min}$, norm of the gradient")
ax.legend()
plt.savefig("logistic_regression.png", dpi=110)
