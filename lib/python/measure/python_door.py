"""What the Python module costs: avi.solve() beside SciPy's DOP853 at equal error, avi.minimise() beside SciPy's L-BFGS-B, the way from C++
to Python, and the first call of a fresh interpreter. Writes one table.

    PYTHONPATH=build/python python3 lib/python/measure/python_door.py [--program build/release/bin/same_digits] [--output build/data]
"""

import argparse
import datetime
import os
import platform
import subprocess
import sys
from pathlib import Path
from time import perf_counter

import numpy as np
import scipy
from scipy.integrate import solve_ivp
from scipy.optimize import minimize

import avi

TARGET = 1e-9  # largest error of a coordinate or momentum at the end


def seconds_of(calls, repeats=5, enough=20.0):
    """The least time of each call, taken in turns; fewer turns where they take long."""
    least = [np.inf] * len(calls)
    begun = perf_counter()
    for _ in range(repeats):
        for i, call in enumerate(calls):
            start = perf_counter()
            call()
            least[i] = min(least[i], perf_counter() - start)
        if perf_counter() - begun > enough:
            break
    return least


# ---- orbits: H as a user writes it, the right side by hand and as fast as Python allows ---------------------------------------------
def kepler(q, p):
    return (p @ p) / 2 - 1 / np.sqrt(q @ q)


def of_kepler(t, y):
    x, z, u, v = y.tolist()
    cube = (x * x + z * z) ** -1.5
    return [u, v, -x * cube, -z * cube]


def henon_heiles(q, p):
    return (p @ p + q @ q) / 2 + q[0] ** 2 * q[1] - q[1] ** 3 / 3


def of_henon_heiles(t, y):
    x, z, u, v = y.tolist()
    return [u, v, -x - 2 * x * z, -z - x * x + z * z]


def pendulum(q, p):
    return p[0] ** 2 / 2 - np.cos(q[0])


def of_pendulum(t, y):
    return [y[1], -np.sin(y[0])]


def three_bodies(q, p):
    return np.sum(p**2) / 2 - sum(1 / np.linalg.norm(q[i] - q[j]) for i in range(3) for j in range(i))


def of_three_bodies(t, y):
    x0, y0, x1, y1, x2, y2, *p = y.tolist()
    a, b, c, d, e, f = x0 - x1, y0 - y1, x1 - x2, y1 - y2, x2 - x0, y2 - y0
    g, h, i = (a * a + b * b) ** -1.5, (c * c + d * d) ** -1.5, (e * e + f * f) ** -1.5
    return p + [e * i - a * g, f * i - b * g, a * g - c * h, b * g - d * h, c * h - e * i, d * h - f * i]


def chain(q, p):
    gaps = np.diff(np.concatenate([[0], q, [0]]))
    return np.sum(p**2) / 2 + np.sum(gaps**2 / 2 + gaps**4 / 4)


def of_chain(t, y):
    n = len(y) // 2
    gaps = np.diff(y[:n], prepend=0, append=0)
    force = gaps + gaps**3
    return np.concatenate([y[n:], force[1:] - force[:-1]])


EIGHT = [[0.97000436, -0.24308753], [-0.97000436, 0.24308753], [0, 0]], [[0.466203685, 0.43236573]] * 2 + [[-0.93240737, -0.86473146]]
ORBITS = {  # H, right side, start, end
    "kepler_e09_100_periods": (kepler, of_kepler, ([0.1, 0], [0, 19**0.5]), 200 * np.pi),
    "kepler_e05_10_periods": (kepler, of_kepler, ([0.5, 0], [0, 3**0.5]), 20 * np.pi),
    "henon_heiles_200": (henon_heiles, of_henon_heiles, ([0, 0.1], [0.4, 0]), 200.0),
    "pendulum_100": (pendulum, of_pendulum, ([0.0], [1.99]), 100.0),
    "figure_eight_50": (three_bodies, of_three_bodies, EIGHT, 50.0),
    "chain_of_16_100": (chain, of_chain, (np.sin(np.arange(1, 17) * np.pi / 17), np.zeros(16)), 100.0),
}


def orbits():
    """Time of either call where its error is at most TARGET, at the loosest tolerance that reaches it."""
    for name, (H, slopes, (q, p), t) in ORBITS.items():
        start = np.concatenate([np.ravel(q), np.ravel(p)]).astype(float)
        ours = lambda tol: avi.solve(H, q, p, t, tol)
        theirs = lambda tol: solve_ivp(slopes, (0, t), start, "DOP853", rtol=tol, atol=tol)
        exact = start if name.startswith("kepler") else avi.solve(H, q, p, t, 1e-13, order=12).y[:, -1]

        def loosest(call, tolerances):
            for tol in tolerances:
                found = call(tol)
                error = np.abs(found.y[:, -1] - exact).max()
                if error <= TARGET:
                    break
            return tol, error, found.nfev

        tol, error, nfev = loosest(ours, np.logspace(-8, -13, 11))
        their_tol, their_error, their_nfev = loosest(theirs, np.logspace(-9, -13.5, 10))
        here, there = seconds_of([lambda: ours(tol), lambda: theirs(their_tol)])
        yield name, "solve", tol, error, nfev, here, here / there
        yield name, "dop853", their_tol, their_error, their_nfev, there, 1.0


# ---- minima: f as a user writes it in NumPy ------------------------------------------------------------------------------------------
random = np.random.default_rng(0)
TABLE = random.normal(size=(500, 20)) * np.logspace(0, 1.5, 20)
SIGNS = np.sign(TABLE @ random.normal(size=20) + random.normal(size=500))
ATOMS = 1.15 * np.mgrid[:3, :3, :2].reshape(3, -1).T[:13] + 0.05 * random.normal(size=(13, 3))


def lennard_jones(x):
    x = x.reshape(13, 3)
    i, j = np.triu_indices(13, 1)
    r6 = np.sum((x[i] - x[j]) ** 2, axis=1) ** -3
    return 4 * np.sum(r6**2 - r6)


MINIMA = {  # f, start
    "rosenbrock_2": (lambda x: 100 * (x[1] - x[0] ** 2) ** 2 + (1 - x[0]) ** 2, [-1.2, 1]),
    "rosenbrock_100": (lambda x: np.sum(100 * (x[1:] - x[:-1] ** 2) ** 2 + (1 - x[:-1]) ** 2), [-1.2, 1] * 50),
    "ill_conditioned_200": (lambda x: np.sum(np.logspace(0, 4, 200) * x**2) / 2, np.ones(200)),
    "powell_40": (
        lambda x: np.sum((x[::4] + 10 * x[1::4]) ** 2 + 5 * (x[2::4] - x[3::4]) ** 2 + (x[1::4] - 2 * x[2::4]) ** 4
                         + 10 * (x[::4] - x[3::4]) ** 4), [3, -1, 0, 1] * 10),
    "beale": (
        lambda x: (1.5 - x[0] * (1 - x[1])) ** 2 + (2.25 - x[0] * (1 - x[1] ** 2)) ** 2 + (2.625 - x[0] * (1 - x[1] ** 3)) ** 2, [1, 1]),
    "helical_valley": (
        lambda x: 100 * ((x[2] - 10 * np.arctan2(x[1], x[0]) / (2 * np.pi)) ** 2 + (np.hypot(x[0], x[1]) - 1) ** 2) + x[2] ** 2, [-1, 0.1, 0]),
    "dixon_price_50": (lambda x: (x[0] - 1) ** 2 + np.sum(np.arange(2, 51) * (2 * x[1:] ** 2 - x[:-1]) ** 2), np.ones(50)),
    "broyden_100": (
        lambda x: np.sum(((3 - 2 * x) * x - np.concatenate([[0], x[:-1]]) - 2 * np.concatenate([x[1:], [0]]) + 1) ** 2), -np.ones(100)),
    "logistic_500_20": (lambda x: np.mean(np.logaddexp(0, -SIGNS * (TABLE @ x))) + 1e-3 * np.sum(x**2), np.zeros(20)),
    "lennard_jones_13": (lennard_jones, ATOMS.ravel()),
}  # fmt: skip


def minima():
    """All to a gradient of 1e-5 (2-norm; of SciPy's the largest entry). SciPy gets the exact gradient, or finds it by differences."""
    for name, (f, x0) in MINIMA.items():
        x0 = np.array(x0, dtype=float)
        gradient = avi.objective(f, x0.shape).gradient
        bound = {"gtol": 1e-5, "ftol": 0, "maxiter": 10**5, "maxfun": 10**6}
        calls = {
            "minimise": lambda: avi.minimise(f, x0, relative=0, absolute=1e-5),
            "minimise_called_back": lambda: avi.minimise(f, x0, jac=gradient, relative=0, absolute=1e-5),
            "lbfgsb": lambda: minimize(f, x0, jac=gradient, method="L-BFGS-B", options=bound),
            "lbfgsb_differences": lambda: minimize(f, x0, method="L-BFGS-B", options=bound),
        }
        times = seconds_of(list(calls.values()))
        for (method, call), seconds in zip(calls.items(), times):
            found = call()
            count = found.nfev if method == "lbfgsb_differences" else found.njev
            yield name, method, 1e-5, np.linalg.norm(gradient(found.x)), count, seconds, seconds / times[2]


# ---- the way to Python -----------------------------------------------------------------------------------------------------------------
def overhead(program):
    """The call of C++ and that of Python, in turns; then fresh interpreters."""
    q, p, t = [0.1, 0.0], [0.0, np.sqrt(19.0)], 200 * np.pi
    H = lambda q, p: (p @ p) * 0.5 - (q @ q) ** -0.5
    python = cpp = np.inf
    for _ in range(40):
        python = min(python, *seconds_of([lambda: avi.solve(H, q, p, t, 1e-9)], 20))
        if program:
            cpp = min(cpp, float(subprocess.run([program, "20"], capture_output=True, text=True, check=True).stdout))
    if program:
        yield "kepler_e09_100_periods", "cpp", 1e-9, np.nan, 0, cpp, 1.0
        yield "kepler_e09_100_periods", "python", 1e-9, np.nan, 0, python, python / cpp
        yield "kepler_e09_100_periods", "python_above_cpp", 1e-9, np.nan, 0, python - cpp, np.nan
    fresh = """
from time import perf_counter
begun = perf_counter()
import avi
imported = perf_counter()
avi.solve(lambda q, p: (p @ p) / 2 - 1 / (q @ q)**.5, [0.1, 0.0], [0.0, 4.35889894], 62.8, 1e-9)
print(imported - begun, perf_counter() - begun)
"""
    times = [[float(x) for x in subprocess.check_output([sys.executable, "-c", fresh]).split()] for _ in range(10)]
    for name, seconds in zip(("import", "import_and_first_call"), np.min(times, axis=0)):
        yield "fresh_interpreter", name, 1e-9, np.nan, 0, seconds, np.nan


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--program", default=None, help="the same call in C++")
    parser.add_argument("--output", type=Path, default=Path("build/data"))
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    target = arguments.output / "python_door.tsv"
    part = target.with_suffix(".part")
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()
    with part.open("w") as table:
        for key, value in {
            "experiment": "python_door", "commit": commit, "python": platform.python_version(), "numpy": np.__version__,
            "scipy": scipy.__version__, "date": datetime.date.today(), "load": os.getloadavg()[0],
            "error": "of the state at the end (orbits); norm of the gradient (minima)",
            "cost": "seconds over those of SciPy with exact gradients, or of C++",
        }.items():  # fmt: skip
            print(f"# {key}: {value}", file=table)
        print("problem", "method", "tolerance", "error", "evaluations", "seconds", "cost", sep="\t", file=table)
        for rows in (orbits(), minima(), overhead(arguments.program)):
            for name, method, tol, error, count, seconds, cost in rows:
                print(f"{name:24} {method:26} {tol:8.1e} {error:8.1e} {count:8d} {seconds:10.6f} s {cost:10.5f}", flush=True)
                print(name, method, f"{tol:.17g}", f"{error:.17g}", count, f"{seconds:.6g}", f"{cost:.6g}", sep="\t", file=table)
    part.rename(target)
    print(target)


if __name__ == "__main__":
    main()
