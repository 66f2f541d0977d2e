"""solve(): an orbit from H, a start, times and a tolerance."""

from types import SimpleNamespace

from . import _avi
from ._formula import trace


class Orbit:
    """An orbit of H, under the names of scipy.integrate.solve_ivp where they mean the same.

    t        times, shape (m,); in H's unit of time
    q, p     positions and momenta then, of the shape of the start and one more axis of m: q[..., k] is that at t[k]
    y        both, shape (2 n, m): q above p, as solve_ivp has it
    success  the last of the times was reached (`ok` in C++)
    kept     it was, with the error of the state and of the energy within ten times the tolerance
    status   0: the last of the times was reached; -1: it was not
    message  one sentence on the end of the run
    nfev     evaluations of the field, those of the choice among them
    choice   monitor, order and step, with the trials that led to them
    state_error, energy_error   of the end, see the report; in units of the ranges of the motion and of the energy scale
    """

    def __init__(self, report, t, y, shape):
        self._report = report
        self.t, self.y = t, y
        n = len(y) // 2
        self.q, self.p = (y[part].reshape(shape + t.shape) for part in (slice(n), slice(n, 2 * n)))

    success = property(lambda self: self._report.run.outcome == _avi.Outcome.ok)
    kept = property(lambda self: self._report.kept())
    status = property(lambda self: 0 if self.success else -1)
    message = property(lambda self: self._report.run.message or "The end was reached.")
    nfev = property(
        lambda self: self._report.run.evaluations * self.choice.order // 2
        + sum(trial.sweeps * trial.order // 2 for trial in self.choice.trials)
    )
    nsteps = property(lambda self: self._report.run.steps)
    choice = property(lambda self: self._report.choice)
    tolerance = property(lambda self: self._report.tolerance)
    state_error = property(lambda self: self._report.state_error)
    energy_error = property(lambda self: self._report.energy_error)
    note = property(lambda self: self._report.note)

    def __repr__(self):
        return self._report.report().rstrip()

    def __getstate__(self):
        return {**self.__dict__, "_report": _Report(self._report)}


class _Report:
    """The report as it is kept in a file: of plain Python."""

    def __init__(self, report):
        text, kept = report.report(), report.kept()
        self._text, self._kept = text, kept
        self.run = _plain(report.run)
        self.choice = _plain(report.choice)
        for name in ("tolerance", "state_error", "energy_error", "note"):
            setattr(self, name, getattr(report, name))

    def report(self):
        return self._text

    def kept(self):
        return self._kept


def _plain(x):
    """A record of C++ as one of Python."""
    if isinstance(x, list):
        return [_plain(each) for each in x]
    if not type(x).__module__.endswith("_avi") or isinstance(x, _avi.Outcome):
        return x
    return SimpleNamespace(**{name: _plain(getattr(x, name)) for name in dir(x) if not name.startswith("_")})


def solve(H, q, p, t, tol, *, seconds=None, check=True, sweeps=None, parameters=()):
    """Integrates the orbit of H from (q, p) with a symplectic method whose monitor, order and step are chosen.

    H      called once as H(q, p), or H(q, p, c) with parameters, with traced arrays of the start's shape; returns one number. Or a
           formula from hamiltonian().
    q, p   start: arrays of one shape, or numbers
    t      end of a run from 0; or a sequence of times, of which the first is that of the start
    tol    error of the state at the end, relative to the range through which each coordinate and momentum moves
    seconds, sweeps   bounds on wall-clock time and on evaluations of all stages; a run that meets one keeps what it has
    check  long runs are made twice, so that all of it is compared

    Returns an Orbit. Raises ValueError for a start, time, tolerance or bound out of range, TypeError for an H that cannot be traced.
    """
    import numpy as np

    q, p, t = (np.asarray(x, dtype=float) for x in (q, p, t))
    times = np.array([0.0, float(t)]) if t.ndim == 0 else t
    if times.ndim != 1 or len(times) < 2:
        raise ValueError(f"t has the shape {times.shape}; it must be an end, or at least two times of which the first is the start's.")
    if p.shape != q.shape:
        raise ValueError(f"p has the shape {p.shape}; it must be that of q, {q.shape}.")
    options = _avi.SolveOptions()
    options.check = check
    if seconds is not None:
        options.seconds = seconds
    if sweeps is not None:
        options.sweeps = sweeps
    formula = H if isinstance(H, _avi.Formula) else trace(H, [q.shape] * 2, parameters, "H")
    report, t_end, q_end, p_end = _avi.solve(formula, q, p, times[0], times[-1], tol, options)
    y = np.empty((2 * q.size, 2))
    y[: q.size, 0], y[q.size :, 0] = q.ravel(), p.ravel()
    y[: q.size, 1], y[q.size :, 1] = q_end, p_end
    return Orbit(report, np.array([times[0], t_end]), y, q.shape)
