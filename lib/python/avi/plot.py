"""Pictures of orbits and minimisations, one line each, with matplotlib. Every function takes `ax`, the axes to draw into, and returns them."""

from ._minimise import Minimum
from ._orbits import Orbit, solve

__all__ = ["convergence", "energy_error", "orbit", "step_size", "work_precision"]


def _axes(ax, **labels):
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.subplots(layout="constrained")[1]
    ax.set(**labels)
    return ax


def _dots(ax, x, y, **style):
    """A line, with a dot for every point where there are few."""
    return ax.plot(x, y, **{"marker": "." if len(x) < 200 else "", **style})


def orbit(found: Orbit, *, i=0, j=1, ax=None, **style):
    """Coordinate j against coordinate i; of bodies (q of shape (k, d)) a line for each; of a single degree of freedom p against q. With
    dense=True a smooth line with a dot for every step, else what there is at the times of the orbit."""
    import numpy as np

    half = len(found.y) // 2
    single = half == 1

    def places(y):
        return y if single else y[:half].reshape(found.q.shape[:-1] + y.shape[1:])

    q = dots = places(found.y)
    if found.sol is not None:
        between = np.linspace(found.sol.times[:-1], found.sol.times[1:], 10, endpoint=False).T.ravel()
        q, dots = places(found.sol(between)), places(found.sol(found.sol.times))
    ax = _axes(ax, xlabel="$q$" if single else f"$q_{i}$", ylabel="$p$" if single else f"$q_{j}$")
    if not single:
        ax.set_aspect("equal", adjustable="datalim")
    for body, steps in zip(*(x if x.ndim == 3 else x[None] for x in (q, dots))):
        line = ax.plot(body[i], body[j], **{**({} if "lw" in style else {"linewidth": 1}), **style})[0]
        if found.sol is not None:
            ax.plot(steps[i], steps[j], ".", color=line.get_color(), markersize=6)
    return ax


def energy_error(found: Orbit, *, ax=None, **style):
    """|H - H_0| at the times of an orbit, relative to its energy scale, on a logarithmic axis."""
    import numpy as np

    error = np.abs(found.energy - found.energy[0]) / found.choice.energy_scale
    ax = _axes(ax, xlabel="$t$", ylabel="energy error, relative", yscale="log")
    _dots(ax, found.t[1:], np.maximum(error[1:], 1e-17), **style)
    return ax


def step_size(found: Orbit, *, ax=None, **style):
    """The length of each step in time against the time where it begins, for an orbit made with dense=True."""
    import numpy as np

    if found.sol is None:
        raise ValueError("The orbit was made without dense=True, which keeps the steps that step_size() draws.")
    t = found.sol.times
    ax = _axes(ax, xlabel="$t$", ylabel="step", yscale="log")
    _dots(ax, t[:-1], np.abs(np.diff(t)), **style)
    return ax


def work_precision(H, q, p, t, *, tols=None, slopes=None, ax=None, **style):
    """The error of the state at the end against the evaluations of the field, at tolerances `tols` (1e-3 ... 1e-11).

    The error is the largest of any coordinate or momentum, compared with a run at the tolerance 1e-13. With `slopes(t, y)`, the right
    side for scipy.integrate.solve_ivp, its DOP853 is drawn, too.
    """
    import numpy as np

    tols = np.logspace(-3, -11, 9) if tols is None else tols
    exact = solve(H, q, p, t, 1e-13).y[:, -1]
    ax = _axes(ax, xlabel="evaluations of the field", ylabel="error of the state at the end", xscale="log", yscale="log")
    runs = {"avi.solve": [solve(H, q, p, t, tol) for tol in tols]}
    if slopes is not None:
        from scipy.integrate import solve_ivp

        start = np.concatenate([np.ravel(q), np.ravel(p)])
        span = (0.0, t) if np.ndim(t) == 0 else (t[0], t[-1])
        runs["solve_ivp, DOP853"] = [solve_ivp(slopes, span, start, "DOP853", rtol=tol, atol=tol) for tol in np.maximum(tols, 1e-13)]
    for name, found in runs.items():
        errors = [max(np.abs(each.y[:, -1] - exact).max(), 1e-17) for each in found]
        ax.plot([each.nfev for each in found], errors, **{"marker": ".", "label": name, **style})
    ax.legend()
    return ax


def convergence(found: Minimum, *, least=None, ax=None, **style):
    """f above `least` (the least value found), and the norm of its gradient, against evaluations; made with history=True."""
    import numpy as np

    if found.history is None:
        raise ValueError("The minimisation was made without history=True, which convergence() draws.")
    if not len(found.history):
        raise ValueError(f"The minimisation could not begin, so there is nothing to draw. {found.message}")
    evaluations, f, norm = found.history.T
    ax = _axes(ax, xlabel="evaluations of the gradient", yscale="log")
    above = f - (f.min() if least is None else least)
    ax.plot(evaluations, np.where(above > 0, above, np.nan), label="$f - f_{\\min}$", **style)
    ax.plot(evaluations, norm, label="$|\\nabla f|$", **style)
    ax.legend()
    return ax
