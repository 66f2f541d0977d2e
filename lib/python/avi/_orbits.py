"""solve(): an orbit from H, a start, times and a tolerance; ensemble() and Solver: many of them."""

import copy
import itertools
import numbers
import operator
import os
import sys
import threading
from types import SimpleNamespace

from . import _avi
from ._formula import _shape, formula_of, hamiltonian, reals
from ._options import set_options, unknown_option


class Orbit:
    """An orbit of H, under the names of scipy.integrate.solve_ivp where they mean the same.

    t        times, shape (m,); in H's unit of time
    q, p     positions and momenta then, of the shape of the start and one more axis of m: q[..., k] is that at t[k]
    y        both, shape (2 n, m): q above p, as solve_ivp has it
    sol      with dense=True, the orbit as a function: sol(t) has the shape (2 n,), and the axes of t after that where t is an array;
             sol.times are the ends of its steps, the start first
    t_events, y_events   for each event the times, shape (k,), and the states, shape (k, 2 n), where it was found
    success  the last of the times was reached, or an event that ends the run (`ok` in C++)
    kept     success, and the errors of the state and of the energy are within ten times the tolerance
    status   0: the last of the times was reached; 1: an event ended the run; -1: neither, and `outcome` says which
    outcome  the name of how the run ended, as in C++: "ok", "stopped", "step_limit" ...
    message  one sentence on the end of the run
    nfev     evaluations of the field, those of the choice among them; nsteps: steps of the run
    choice   monitor, order and step h, with the trials that led to them
    tolerance   what was asked for
    state_error, energy_error   of the end, see the report; in units of the ranges of the motion and of the energy scale
    note     warnings, which the report has, too; often empty
    energy   H at the times, shape (m,)
    """

    def __init__(self, report, formula, shape, t, y, sol, t_events, y_events, stopped):
        self._report, self._formula, self._stopped = report, formula, stopped
        self.t, self.y, self.sol, self.t_events, self.y_events = t, y, sol, t_events, y_events
        n = len(y) // 2
        self.q, self.p = (y[part].reshape(shape + t.shape) for part in (slice(n), slice(n, 2 * n)))

    success = property(lambda self: self._report.run.outcome == _avi.Outcome.ok)
    kept = property(lambda self: self._report.kept())
    status = property(lambda self: int(self._stopped) if self.success else -1)
    outcome = property(lambda self: self._report.run.outcome.name)
    message = property(lambda self: self._report.run.message or ("The end was reached.", "An event ended the run.")[self.status])
    nfev = property(
        lambda self: _evaluations(self._report.run.evaluations, self.choice)
        + sum(_evaluations(trial.sweeps, trial) for trial in self.choice.trials)
    )
    nsteps = property(lambda self: self._report.run.steps)
    choice = property(lambda self: self._report.choice)
    tolerance = property(lambda self: self._report.tolerance)
    state_error = property(lambda self: self._report.state_error)
    energy_error = property(lambda self: self._report.energy_error)
    note = property(lambda self: self._report.note)

    @property
    def energy(self):
        if isinstance(self._formula, _avi.Formula):
            import numpy as np

            rows = self.y.T if self._formula.size == len(self.y) else np.column_stack([self.y.T, self.t])
            self._formula = np.array([self._formula.value(row) for row in rows])
        return self._formula

    def __repr__(self):
        return self._report.report().rstrip()

    def __getstate__(self):
        """What is kept in a file: all but sol."""
        return {**self.__dict__, "_report": _Report(self._report), "_formula": self.energy, "sol": None}

    def __copy__(self):
        other = object.__new__(Orbit)
        other.__dict__.update(self.__dict__)
        return other

    def __deepcopy__(self, memo):
        """Arrays of its own; sol and what the library reported cannot be changed, and are shared."""
        t, y, energy, events = self.t.copy(), self.y.copy(), self.energy.copy(), copy.deepcopy((self.t_events, self.y_events), memo)
        return Orbit(self._report, energy, self.q.shape[:-1], t, y, self.sol, *events, self._stopped)


class _Between:
    """The orbit as a function of time, between the ends `times` of its steps, of which the first is the start."""

    def __init__(self, curve, rows):
        import numpy as np

        self._curve, self._rows, self.times = curve, rows, np.array(curve.times())

    def __call__(self, t):
        t = reals(t, "t")
        return self._curve.at(t.ravel(), self._rows).T.reshape((self._rows, *t.shape))

    def __repr__(self):
        return f"<an orbit from t = {self.times[0]:g} to {self.times[-1]:g} as a function>"


_avi.Choice.__doc__ = """Monitor, order and step of an orbit, and how they were chosen.

monitor, order, h   of the method; h is the step in fictive time
energy_scale        what energy errors are relative to
time, sweeps        of the trials, together
trials              in their order: monitor, order, h, time, steps, sweeps, state_error and outcome of each
"""
_avi.Choice.__repr__ = lambda self: f"monitor {self.monitor}, order {self.order}, h = {self.h:.3g}"
_avi.Trial.__repr__ = lambda self: f"monitor {self.monitor}, order {self.order}, h = {self.h:.3g}: {self.steps} steps, {self.outcome.name}"


def _evaluations(sweeps, method):
    """Of the field: a sweep of order s is s / 2 of them, a kick of the splitting is one."""
    return sweeps if method.monitor == "splitting" else sweeps * method.order // 2


class _Report:
    """The report as it is kept in a file: of plain Python."""

    def __init__(self, report):
        self._text, self._kept = report.report(), report.kept()
        for name in ("run", "choice", "tolerance", "state_error", "energy_error", "note"):
            setattr(self, name, _plain(getattr(report, name)))

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


class Event:
    """What event() returns: g with its direction, count and whether it ends the run."""

    def __init__(self, g, direction, count, stop):
        self.g, self.direction, self.count, self.terminal = g, direction, count, stop

    def __repr__(self):
        return f"<an event, direction {self.direction}, count {self.count}{', stop' * self.terminal}>"


def event(g, *, direction=0, count=0, stop=False, **others):
    """An event for solve(): the zeros of g(q, p) or g(q, t, p), which is traced as H is; never of (t, y), as solve_ivp has it.

    direction  1 where g rises as the run goes, -1 where it falls, 0 for both
    count      how many zeros to look for; 0 for all
    stop       whether the run ends on the last of them, or on the first where there is no count

    Raises TypeError or ValueError for a direction or a count of another kind, and for a g with the attributes of solve_ivp, which solve()
    reads where g itself is the event.
    """
    for name in others:
        raise unknown_option(name, ("direction", "count", "stop"), "event")
    for name in ("terminal", "direction"):
        if getattr(g, name, 0):
            raise ValueError(f"g has the attribute {name}, as solve_ivp reads it: give g itself as an event, or say it by direction=, count= and stop= alone.")
    if direction not in (-1, 0, 1):
        raise _wrong(direction, numbers.Real)(f"The direction of an event is {direction!r}; it must be 1, -1, or 0 for both.")
    if not isinstance(stop, bool) and getattr(getattr(stop, "dtype", None), "kind", "") != "b":
        raise TypeError(f"stop of an event is {stop!r}; it must be True or False, beside count=2 where the second is to end the run.")
    return Event(g, int(direction), _whole(count, "The count of an event", 0), bool(stop))


def _wrong(x, kind):
    """The error for a number that is out of range, or for what is none."""
    return ValueError if isinstance(x, kind) else TypeError


def _whole(x, name, least):
    """x as an int that C++ can hold."""
    try:
        number = operator.index(x)
    except TypeError:
        number = None
    if number is None or not least <= number < 2**31:
        raise _wrong(x, numbers.Integral)(f"{name} is {x!r}; it must be a whole number between {least} and {2**31 - 1}.")
    return number


def _event(g, shape):
    """An event, or a function with the attributes that solve_ivp knows, as what the library asks for."""
    if not isinstance(g, Event):
        if not (callable(g) or isinstance(g, _avi.Formula)):
            raise TypeError(f"An event is {g!r}; it must be a function g(q, p) or g(q, t, p), or what avi.event() makes of one.")
        direction, terminal = getattr(g, "direction", 0), getattr(g, "terminal", False)
        if not isinstance(direction, numbers.Real):
            raise TypeError(f"The direction of an event is {direction!r}; it must be a number, whose sign counts.")
        count = 0 if isinstance(terminal, bool) or not terminal else _whole(terminal, "The attribute terminal of an event", 0)
        g = Event(g, (direction > 0) - (direction < 0), count, bool(terminal))
    formula = g.g if isinstance(g.g, _avi.Formula) else hamiltonian(g.g, shape, name="An event")
    return formula, g.direction, g.count, g.terminal


class _Bar:
    """Progress on one line: of tqdm, where it is there, else by hand."""

    def __init__(self):
        try:
            from tqdm.auto import tqdm

            self._bar = tqdm(total=1.0, bar_format="{l_bar}{bar}| {elapsed}<{remaining} {postfix}")
        except ImportError:
            self._bar = None

    def __call__(self, now):
        words = f"{now[1]} done" if len(now) == 2 else f"t = {now[1]:.6g}, {now[2]} steps, {now[3]:.1f} s"
        if self._bar is not None:
            self._bar.n = now[0]
            self._bar.set_postfix_str(words)
        else:
            print(f"\r{100 * now[0]:5.1f} %, {words}", end="", file=sys.stderr, flush=True)

    def close(self):
        self._bar.close() if self._bar is not None else print(file=sys.stderr)


_OPTIONS = ("seconds", "sweeps", "steps", "check", "order", "monitor", "h", "dense", "checkpoint", "checkpoint_seconds")


def solve(H, q, p, t, tol, *, events=(), progress=None, parameters=(), **options):
    """Integrates the orbit of H from (q, p) with a symplectic method whose monitor, order and step are chosen.

    H      called once as H(q, p) or H(q, t, p), and with parameters as a last argument where there are any, with traced arrays of the
           start's shape; returns one number. Or a formula from hamiltonian().
    q, p   start: arrays of one shape, or numbers
    t      end of a run from 0; or a sequence of times, rising or falling, of which the first is that of the start
           An end alone gives two points, the start and the end
    tol    error of the state at the end, relative to the range through which each coordinate and momentum moves
    events    functions g(q, p) or g(q, t, p) whose zeros are looked for, from event() or with solve_ivp's attributes
    progress  True for a line that shows it, or a function called some twenty times a second with one tuple, (fraction, t, steps, seconds)
    dense     keeps the orbit between the times, for `sol`
    seconds, sweeps, steps   bounds on wall-clock time, on evaluations of all stages and on steps; a run that meets one keeps what it has
    order, monitor, h        to fix these rather than have them chosen. order: 2, 4 ... 16. monitor: "fixed", "energy", "energy^1.5",
           "poles", "acceleration", "splitting", or a function g(q, p), positive and smooth, which is traced as H is: dt = g dtau;
           g(q, t, p) where H is H(q, t, p). h: the step in fictive time, together with a monitor
    check  True: the second run, which measures the error, goes all the way; False: along the beginning only, where it does not see chaos that begins later
    checkpoint, checkpoint_seconds   a file in which the run is kept for resume(), and how often

    Ctrl-C ends the run; the orbit up to there is returned. Raises ValueError for a start, time, tolerance or bound out of range,
    TypeError for what is no number and for an H that cannot be traced; whatever `progress` raises, but for StopIteration, which
    ends the run, as does False where `progress` returns it.
    """
    q, p = _start(q, p)
    question = _Question(H, q.shape, t, tol, events, parameters, options)
    return _with_bar(lambda bar: question.answer(q, p, bar), progress)


def resume(H, shape, file, *, events=(), progress=None, parameters=(), monitor=None, seconds=None, sweeps=None, steps=None, checkpoint_seconds=None):
    """Goes on with a run of solve() that was kept in a file, its `checkpoint`: an Orbit with all of the run and the same digits.

    H, shape   as they were, with the shape of q; so are parameters, events and a monitor that is a function. What else was asked for,
               times and tolerance among it, is in the file.
    seconds, progress   of what is left
    sweeps, steps       bounds on the whole run

    Raises ValueError for a file that cannot be read, is damaged, or is of another H.
    """
    bounds = {"monitor": monitor, "seconds": seconds, "sweeps": sweeps, "steps": steps, "checkpoint_seconds": checkpoint_seconds}
    question = _Question(H, _shape(shape), (0.0, 1.0), 1e-6, events, parameters, bounds)
    return _with_bar(lambda bar: question.found(_avi.resume(question.formula, os.fspath(file), question.options, question.events, bar)), progress)


def ensemble(H, q, p, t, tol, *, events=(), progress=None, parameters=(), threads=None, **options):
    """Many orbits of H, each as by solve(), side by side on all cores (or on so many threads): a list of Orbits in the order of the starts.

    q, p   starts, along the first axis
    progress  True for a line that shows how many are done, or a function called with (fraction, done) after each

    H and events are traced once. Every orbit has the digits that it has alone. A start that solve() refuses raises
    its ValueError, with the number of the start, and the other runs are given up. Ctrl-C ends the runs, and so does `progress` where it
    returns False or raises StopIteration; those that had not begun have the status -1. Other arguments are those of solve(), but for checkpoint=, which is for one run.
    """
    q, p = _starts(q, p)
    return _side_by_side(_Question(H, q.shape[1:], t, tol, events, parameters, options), q, p, progress, threads)


class Solver:
    """Many orbits of one H with one choice of monitor, order and step, which takes a good part of a short call.

    The choice is made for the orbit from (q, p) to the end t: other starts are to be like this one, and other runs about as long. The
    arguments are those of solve(); `options` and `events` are those of all runs. Several threads may run one Solver.

    choice  monitor, order and step
    sample  how the orbit went that they were chosen for, as a report
    """

    def __init__(self, H, q, p, t, tol, *, events=(), parameters=(), **options):
        q, p = _start(q, p)
        self._question = _Question(H, q.shape, t, tol, events, parameters, options)
        self._question.made = self._question.asked(q, p, None, choose=True)[0]
        if self._question.made.run.message.startswith("Stopped by Ctrl-C"):
            raise KeyboardInterrupt("The choice of a Solver was not finished.")

    choice = property(lambda self: self._question.made.choice)
    sample = property(lambda self: self._question.made.report())

    def __repr__(self):
        return f"A Solver with {self.choice}"

    def run(self, q, p, t=None, *, progress=None):
        """The orbit from (q, p) to the end or with the times t, those of the choice where there are none: an Orbit."""
        question, (q, p) = self._question.until(t), _start(q, p)
        return _with_bar(lambda bar: question.answer(q, p, bar), progress)

    def ensemble(self, q, p, t=None, *, progress=None, threads=None):
        """The orbits from many starts, along the first axis of q and p, side by side on all cores: a list of Orbits, as of ensemble()."""
        return _side_by_side(self._question.until(t), *_starts(q, p), progress, threads)


def _start(q, p):
    """Both as arrays of one shape, before anything is called with it."""
    q, p = _alike(q, p)
    if q.size == 0:
        raise ValueError("Size of q is 0; it must be at least 1.")
    return q, p


def _starts(q, p):
    """Starts along the first axis, of which there may be none."""
    q, p = _alike(q, p)
    if q.ndim == 0:
        raise ValueError("q and p have the shape (); they must have one start after the other, along their first axis.")
    return (q, p) if len(q) == 0 else _start(q, p)


def _alike(q, p):
    q, p = reals(q, "q"), reals(p, "p")
    if p.shape != q.shape:
        raise ValueError(f"p has the shape {p.shape}; it must be that of q, {q.shape}.")
    return q, p


def _bar(progress):
    if not (progress is None or isinstance(progress, bool) or callable(progress)):
        raise TypeError(f"progress is {progress!r}; it must be True or a function.")
    return _Bar() if progress is True else progress or None


def _with_bar(run, progress):
    bar = _bar(progress)
    try:
        return run(bar)
    finally:
        if progress is True:
            bar.close()


def _side_by_side(question, q, p, progress, threads):
    from concurrent.futures import ThreadPoolExecutor, as_completed

    if question.options.checkpoint:
        raise ValueError("checkpoint= keeps one run, and the runs of an ensemble would all write to its file: give each solve() a file of its own.")
    if threads is not None:
        threads = _whole(threads, "threads", 1)
    cancelled = threading.Event()

    def unless_cancelled(now):
        if cancelled.is_set():
            raise StopIteration

    def answer(number, *start):
        try:
            return question.answer(*start, unless_cancelled)
        except ValueError as error:
            raise ValueError(f"Start number {number}: {error}") from None

    bar = _bar(progress)
    with ThreadPoolExecutor(threads or os.cpu_count()) as pool:
        runs = [pool.submit(answer, *start) for start in zip(itertools.count(), q, p)]
        try:
            for done, run in enumerate(as_completed(runs) if bar else (), 1):
                if bar((done / len(runs), done)) is False:
                    raise StopIteration
            return [run.result() for run in runs]
        except (KeyboardInterrupt, StopIteration) as end:
            cancelled.set()
            orbits = [run.result() for run in runs]
            for orbit in orbits:
                if isinstance(end, KeyboardInterrupt) and orbit._report.run.outcome == _avi.Outcome.stopped:
                    orbit._report.run.message = "Stopped by Ctrl-C."
            return orbits
        except BaseException:
            cancelled.set()
            raise
        finally:
            if progress is True:
                bar.close()


class _Question:
    """What is asked of an orbit, but for its start: formulas, times, options, and a choice that is made already."""

    made = None

    def __init__(self, H, shape, t, tol, events, parameters, options):
        tol = tol.item() if getattr(tol, "shape", None) == () else tol
        if not isinstance(tol, numbers.Real):
            raise TypeError(f"tol is {tol!r}; it must be a number.")
        self.shape, self.tol = shape, float(tol)
        monitor = options.get("monitor")
        if callable(monitor):
            monitor = hamiltonian(monitor, shape, name="The monitor")
            options = {**options, "monitor": monitor}
        self.options = set_options(_avi.SolveOptions(), options, _OPTIONS, "solve", ("t", "tol", "events", "progress", "parameters"))
        self.set_times(t)
        self.formula = formula_of(H, parameters, lambda: hamiltonian(H, shape, parameters))
        if not isinstance(self.formula, _avi.Formula):
            raise TypeError("H is a formula from objective() with products of large matrices; hamiltonian() makes one for orbits.")
        if isinstance(monitor, _avi.Formula) and monitor.size % 2 > self.formula.size % 2:
            raise ValueError("The monitor depends on time and H does not: write H as H(q, t, p), too.")
        alone = callable(events) or isinstance(events, (Event, _avi.Formula)) or not (events is None or hasattr(events, "__iter__"))
        self.events = [_event(g, shape) for g in ((events,) if alone else () if events is None else events)]

    def set_times(self, t):
        import numpy as np

        t = reals(t, "t")
        self.times, self.deliver = (np.array([0.0, float(t)]), bool(self.options.checkpoint)) if t.ndim == 0 else (t.copy(), True)
        if self.times.ndim != 1 or len(self.times) < 2:
            raise ValueError(f"t has the shape {t.shape}; it must be an end, or at least two times of which the first is the start's.")

    def until(self, t):
        """The same question for other times, unless there are none."""
        other = copy.copy(self)
        if t is not None:
            other.set_times(t)
        return other

    def asked(self, q, p, progress, choose=False):
        if q.shape != self.shape:
            raise ValueError(f"q has the shape {q.shape}; it must be the Solver's, {self.shape}.")
        try:
            return _avi.solve(self.formula, q, p, self.times, self.deliver, self.tol, self.options, self.events, progress, self.made, choose)
        except ValueError as error:
            if not str(error).startswith("The derivative of H") or " is nan" not in str(error):
                raise
            raise ValueError(f"{error} Is there a root of 0 in H, as np.linalg.norm(p) is at rest? It has no slope; p @ p, its square, has one. Or an np.exp or np.cosh in a divisor that overflows? scipy.special.expit and np.tanh do not.") from None

    def answer(self, q, p, progress):
        import numpy as np

        found = self.asked(q, p, progress)
        if not self.deliver:  # the ends are what was asked for
            found = (found[0], self.times[:1], np.concatenate([q.ravel(), p.ravel()])[None], *found[3:])
        return self.found(found)

    def found(self, answer):
        """What the library found, as an Orbit; where a run ended before its time, its last state is the last one."""
        import numpy as np

        report, t, z, t_end, q_end, p_end, which, t_events, z_events, curve = answer
        t, t_events, which = t.ravel(), t_events.ravel(), np.array(which, dtype=int)
        if np.isfinite(t_end) and (len(t) == 0 or t[-1] != t_end):
            t, z = np.append(t, t_end), np.vstack([z, np.concatenate([q_end, p_end])])

        sol = _Between(curve, z.shape[1]) if curve else None
        of_events = [which == i for i in range(len(self.events))]
        times, states = ([found[i] for i in of_events] for found in (t_events, z_events))
        stopped = any(stop and len(found) == max(count, 1) for (_, _, count, stop), found in zip(self.events, times))
        return Orbit(report, self.formula, self.shape, t, z.T, sol, times, states, stopped)
