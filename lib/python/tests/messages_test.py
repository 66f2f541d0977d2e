"""What is refused, each with the words that say what to write instead; and what is taken although it is unusual."""

import copy
import fractions
import functools
import pathlib
import tempfile
import unittest

import numpy as np

import avi


def kepler(q, p):
    return (p @ p) / 2 - 1 / np.sqrt(q @ q)


def spring(q, p):
    return (p @ p + q @ q) / 2


START = [0.5, 0.0], [0.0, np.sqrt(3.0)]


def solved(H=kepler, q=START[0], p=START[1], t=1.0, tol=1e-6, **options):
    return lambda: avi.solve(H, q, p, t, tol, **options)


def traced(f, size=2, parameters=()):
    return lambda: avi.hamiltonian(f, size, parameters)


class Refused(unittest.TestCase):
    def check(self, cases):
        for call, error, words in cases:
            with self.assertRaisesRegex(error, words):
                call()

    def test_comparisons(self):
        falls = lambda q, p: q[0] > 0
        self.check(
            [
                (solved(falls), TypeError, r"H returned a comparison.*avi.where\(a < b, x, y\)"),
                (solved(events=falls), TypeError, "An event returned a comparison.*difference"),
                (solved(events=avi.event(falls)), TypeError, "An event returned a comparison"),
                (solved(monitor=falls), TypeError, "The monitor returned a comparison"),
                (lambda: avi.minimise(lambda x: x[0] < 1, [1.0]), TypeError, "f returned a comparison"),
                (traced(lambda q, p: (q > 0)[0] & (p > 0)[0]), TypeError, "a comparison"),
                (traced(lambda q, p: True), TypeError, "a comparison"),
                (traced(lambda q, p: np.stack([1.0, q[0] > 0])[0] & (q[1] > 0)), TypeError, "take comparisons"),
                (traced(lambda q, p: np.array_equal(q, [1.0, 2.0]) + p @ p), TypeError, "np.array_equal cannot.*np.abs"),
                (traced(lambda q, p: np.allclose(q, p) + p @ p), TypeError, "np.allclose cannot"),
                (traced(lambda q, p: np.any(np.array([q[0], 1]) == np.zeros(2, dtype=object)) + p @ p), TypeError, "instead of `=="),
            ]
        )
        self.assertEqual(traced(lambda q, p: avi.where(q[0] > 0, 1.0, 0.0) + (q > 0).sum())().value(np.ones(4)), 3.0)

    def test_order_of_arguments(self):
        self.check(
            [
                (traced(lambda q, p, k: k * (p @ p)), TypeError, r"H calls its arguments q, p, k; they are q, p, or q, t, p .*parameters=\[...\]"),
                (traced(lambda p, q: p @ p / 2 + q[0]), TypeError, "H calls its arguments p, q; they are q, p"),
                (traced(lambda p, s, q: p @ p / 2 + q[0]), TypeError, "H calls its arguments p, s, q; they are q, p"),
                (solved(events=lambda p, q: q[0]), TypeError, "An event calls its arguments p, q"),
                (solved(monitor=lambda p, q: q @ q), TypeError, "The monitor calls its arguments p, q"),
                (traced(lambda q, t, p, c: c * p @ p), TypeError, r"H takes the arguments q, t, p, c; .*parameters=\[...\] are given"),
                (traced(lambda q: q @ q), TypeError, "H takes the arguments q; they are q, p"),
                (traced(lambda q, p, a, b: a * b, parameters=[1.0, 2.0]), TypeError, "q, p, a, b; .* parameters, as one array"),
                (traced(lambda q, p: q @ p, parameters=[1.0, 2.0]), TypeError, "q, p; .* parameters, as one array"),
                (traced(lambda q, t, p: q @ p, parameters=[1.0]), TypeError, "q, t"),
                (traced(lambda P, Q: P @ P / 2 + Q[0]), TypeError, "H calls its arguments P, Q; they are q, p"),
                (traced(lambda px, x: px @ px / 2 + x[0]), TypeError, "H calls its arguments px, x; they are q, p"),
                (traced(lambda p_phi, phi: p_phi @ phi), TypeError, "H calls its arguments p_phi, phi; they are q, p"),
                (traced(lambda p, x: p @ p / 2 + x[0]), TypeError, "H calls its arguments p, x; they are q, p"),
                (traced(lambda v, q: v @ v / 2 + q[0]), TypeError, "H calls its arguments v, q; they are q, p"),
                (traced(lambda time, y: time[0] + y[0]), TypeError, "H calls its arguments time, y; they are q, p, or q, t, p"),
                (traced(lambda q, p, t=0: q @ p * t), TypeError, "H has a default for t, .* q, t, p where time counts"),
                (traced(lambda q, p, *, time=0: q @ p * time), TypeError, "H has a default for time, "),
                (traced(lambda q, p, c, t=0: q @ p * c[0] * t, parameters=[1.0]), TypeError, "H has a default for t, "),
                (solved(events=lambda q, p, t=0: q[0] - t), TypeError, "An event has a default for t, "),
            ]
        )
        for f in (lambda x, v: x @ v, lambda phi, p_phi: phi @ p_phi, lambda position, momentum: position @ momentum, lambda q, p, T=2.0: q @ p * T):
            self.assertEqual(traced(f)().size, 4)
        frozen = functools.partial(lambda q, p, t: q @ p * t, t=2.0)  # on purpose
        self.assertEqual(traced(frozen)().value(np.ones(4)), 4.0)
        self.assertEqual(traced(lambda x, time, v: x @ v + time)().size, 5)
        self.assertEqual(traced(lambda q, p, c=None: q @ p * c[0], parameters=[2.0])().value([1, 1, 1, 1]), 4.0)

    def test_two_numbers_at_once(self):
        self.check([(traced(lambda q, p: divmod(q[0], 2)), TypeError, "x // a and x % a")])
        for f in (np.divmod, np.modf, np.fmod):
            self.check([(traced(lambda q, p: f(*[q[0], 2.0][: f.nin])), TypeError, f"np.{f.__name__} cannot be traced here")])

    def test_scipys_compiled_code(self):
        try:
            from scipy import interpolate, linalg, optimize, sparse, special
            from scipy.spatial import distance
        except ImportError:
            self.skipTest("SciPy is not there.")
        spline, chain = interpolate.CubicSpline([0.0, 1.0, 2.0], [0.0, 1.0, 4.0]), sparse.eye(2).tocsr()

        def own(x):
            raise TypeError("my own words")

        for f, words in (
            (lambda q: spline(q[0]), "^scipy.interpolate cannot take traced numbers.*np.polyval"),
            (lambda q: q @ (chain @ q), r"^scipy.sparse cannot.*a.toarray\(\)"),
            (lambda q: q @ chain.dot(q), r"^scipy.sparse cannot.*a.toarray\(\)"),
            (lambda q: special.logsumexp(q), "^scipy.special cannot take"),
            (lambda q: linalg.solve(np.eye(2), q) @ q, "^scipy.linalg cannot.*np.linalg"),
            (lambda q: distance.pdist(q[:, None])[0], "^scipy.spatial cannot take"),
            (lambda q: optimize.brentq(own, -9.0, 9.0), "^my own words$"),
            (lambda q: special.jv(0, q[0]), r"^jv cannot be traced here; avi.functions\(\)"),
        ):
            self.check([(traced(lambda q, p: f(q)), TypeError, words)])

    def test_arrays(self):
        def rows_as_objects(p):
            rows = np.empty(2, dtype=object)
            rows[0], rows[1] = p, p
            return rows

        left = lambda f: lambda q, p: np.sum(f(np.zeros(2, dtype=q.dtype)))
        self.check(
            [
                (traced(left(np.exp)), TypeError, r"np.exp\(\) of the plain numbers.*np.zeros_like"),
                (traced(left(np.sqrt)), TypeError, r"np.sqrt\(\) of the plain numbers.*np.zeros_like"),
                (traced(lambda q, p: np.maximum(np.array([q[0], 0]), 0.5)[0]), TypeError, "avi.maximum"),
                (traced(lambda q, p: np.einsum("i,i", np.array([q[0], 0]), np.array([p[0], 1]))), TypeError, "np.stack"),
                (traced(lambda q, p: np.logaddexp(np.array([q[0], 0]), np.array([p[0], 1]))[0]), TypeError, "np.stack"),
                (traced(lambda q, p: np.gradient(q)[0]), TypeError, "np.diff"),
                (traced(lambda q, p: np.linalg.slogdet(np.outer(q, q))[1]), TypeError, "np.linalg.det"),
                (traced(lambda q, p: q[q > 0.5].sum()), TypeError, r"avi.where\(a < b, x, 0.0\)"),
                (traced(lambda q, p: np.sum(q, where=[True, False])), TypeError, "np.sum cannot be traced with where="),
                (traced(lambda q, p: np.sin(q, where=[True, False])[0]), TypeError, "np.sin cannot be traced with where="),
                (traced(lambda q, p: np.add.reduce(q, where=[True, False])), TypeError, "np.add cannot be traced with where= as np.add.reduce"),
                (traced(lambda q, p: np.select([q > 0, q > 1], [q]).sum()), ValueError, "np.select has 2 conditions and 1 choices"),
                (traced(lambda q, p: q.T.ravel("K")[1], (2, 2)), TypeError, "The order 'K' asks how an array lies in memory"),
                (traced(lambda q, p: q.sum(initial=1.0)), TypeError, r"^sum\(\) got an unexpected keyword argument 'initial'"),
                (traced(lambda q, p: np.maximum.reduce(q, initial=9.0)), TypeError, "np.maximum cannot be traced with initial= as np.maximum.reduce"),
                (traced(lambda q, p: np.sum(q * np.ma.masked_array([1.0, 2.0], [0, 1]))), TypeError, "mask"),
                (traced(lambda q, p: (p * np.asmatrix([[2.0, 1.0], [0.0, 3.0]])).sum()), TypeError, r"an np.matrix.*np.asarray\(a\), and a @ b"),
                (traced(lambda q, p: (np.asmatrix([[2.0, 1.0], [0.0, 3.0]]) * q.reshape(2, 1)).sum()), TypeError, "an np.matrix"),
                (traced(lambda q, p: np.sum((q > 0) + (p > 0))), TypeError, r"NumPy takes a \+ b.*write `\|`.*1.0 \* \(a < b\)"),
                (traced(lambda q, p: (q[0] > 0) + (p[0] > 0)), TypeError, "for one comparison"),
                (traced(lambda q, p: (q > 0) @ (p > 0)), TypeError, "for one comparison"),
                (traced(lambda q, p: np.sum(q * np.array([1j, 2]))), TypeError, "complex numbers"),
                (traced(lambda q, p: q * {1: 2}), TypeError, "meets a dict; it can be combined with real numbers"),
                (traced(lambda q, p: q * None), TypeError, "meets a NoneType"),
                (traced(lambda q, p: np.sum(q * rows_as_objects(p))), TypeError, "An entry of an array of objects is an array"),
                (traced(lambda q, p: np.sum(q * np.array([[1], [2, 3]], dtype=object))), TypeError, "An entry of an array of objects is an array"),
                (traced(lambda q, p: np.interp(q[0], [0.0, 1.0], [1.0, 2.0])), TypeError, "np.interp cannot be traced. A table .*np.polyval"),
                (traced(lambda q, p: np.interp(q, [0.0, 1.0], [1.0, 2.0])[0]), TypeError, "np.interp cannot be traced. A table .*np.polyval"),
                (traced(lambda q, p: np.linspace(q[0], p[0], 3)[1]), TypeError, r"np.linspace cannot be traced. Write a \+"),
                (traced(lambda q, p: np.cov(q)), TypeError, "np.cov cannot be traced. Write d = a"),
                (traced(lambda q, p: np.nansum(q)), TypeError, "np.nansum cannot be traced. Whether .*np.sum"),
                (traced(lambda q, p: np.nextafter(q[0], 0.5)), TypeError, "^np.nextafter cannot be traced here"),
                (traced(lambda q, p: np.frompyfunc(lambda x: x, 1, 1)(q)[0]), TypeError, r"^<lambda> \(vectorized\) cannot be traced here"),
                (traced(lambda q, p: float(q[0])), TypeError, r"fill np.zeros\(2, dtype=q.dtype\)"),
                (traced(lambda q, p: np.fft.fft(q)[0]), TypeError, "np.fft.fft cannot be traced. Write C @ x"),
                (traced(lambda q, p: np.linalg.eigvalsh(np.outer(q, q))[0]), TypeError, "np.linalg.eigvalsh cannot be traced. Of two rows"),
                (traced(lambda q, p: np.bincount([0, 1], weights=q).sum()), TypeError, "np.bincount cannot be traced. Write W @ x"),
                (traced(lambda q, p: np.sum(np.abs(q + 1j * p))), TypeError, r"complex numbers.*q\*\*2 \+ p\*\*2"),
                (traced(lambda q, p: np.piecewise(q, [q < 0], [0, 1])[0]), TypeError, "np.select"),
                (solved(q=np.array([0.5 + 1j, 0.0])), TypeError, "q is complex; it must be a real number"),
                (solved(p=np.ma.masked_array([1.0, 2.0], [0, 1])), TypeError, "p is an array with a mask"),
                (solved(q=None), TypeError, "q is None"),
                (solved(t=None), TypeError, "t is None"),
                (solved(q="a"), TypeError, "q is 'a'; it must be a real number or an array"),
                (solved(q="1.5", p=1.0), TypeError, "q is '1.5'"),
                (solved(q={1: 2}), TypeError, "q is {1: 2}; it must be a real number"),
                (solved(START[0], kepler), TypeError, "q is <function kepler .*; it must be a real number"),
                (solved(p=[[1.0], [1.0, 2.0]]), TypeError, r"p is \[\[1.0\], \[1.0, 2.0\]\]; it must be a real number"),
                (solved(p=[10**400, 1.0]), TypeError, "p is .*; it must be a real number"),
                (solved(t=np.datetime64("2020-01-01")), TypeError, "t is .*2020-01-01.*; it must be a real number"),
                (solved(parameters={"m": 2}), TypeError, "parameters is {'m': 2}; it must be a sequence of numbers"),
                (lambda: avi.minimise(lambda x: x @ x, None), TypeError, "x0 is None"),
                (lambda: avi.minimise(lambda x: x @ x, []), ValueError, "Size of x0 is 0; it must be at least 1"),
                (lambda: avi.minimise(lambda x: x @ x, [1.0], evaluations=10**30), ValueError, "evaluations .* is 10+; so large a number is not possible"),
                (solved(q=[], p=[]), ValueError, "Size of q is 0; it must be at least 1"),
                (lambda: avi.ensemble(kepler, None, None, 1.0, 1e-6), TypeError, "q is None"),
                (solved(tol=np.array([1e-8])), TypeError, "tol is"),
                (solved(tol=None), TypeError, "tol is None; it must be a number"),
                (solved(lambda q, p: np.linalg.norm(p) ** 3 + q @ q, p=[0.0, 0.0]), ValueError, r"by p\[0\] at the start is nan.*root of 0.*p @ p"),
            ]
        )
        self.assertEqual(avi.objective(lambda x: fractions.Fraction(1, 4) * x[0] + np.array([fractions.Fraction(1, 2)])[0] * x[0], 1).value([1.0]), 0.75)
        room = np.zeros(2, dtype=object)
        for f in (lambda z, x: np.sum(avi.where(x > z, x, z)), lambda z, x: np.sum(avi.maximum(z, x)), lambda z, x: np.sum(avi.minimum(z, x) ** 2)):
            self.assertEqual(avi.objective(lambda x: f(room, x), 2).value([0.5, -0.5]), float(f(np.zeros(2), np.array([0.5, -0.5]))))

    def test_shapes(self):
        """Before H is called with arrays of shapes that would not go together."""
        first = lambda q, p: p @ p / 2 - np.cos(q[0])
        solver = avi.Solver(first, [0.0], [1.0], 1.0, 1e-6)
        self.check(
            [
                (solved(first, 0, [1.0]), ValueError, r"p has the shape \(1,\); it must be that of q, \(\)"),
                (lambda: avi.Solver(first, 0, [1.0], 1.0, 1e-6), ValueError, r"p has the shape \(1,\); it must be that of q, \(\)"),
                (lambda: avi.ensemble(first, [0.0], np.ones((200, 1)), 1.0, 1e-6), ValueError, r"p has the shape \(200, 1\); it must be that of q, \(1,\)"),
                (lambda: avi.ensemble(first, 0.0, 1.0, 1.0, 1e-6), ValueError, "one start after the other"),
                (lambda: solver.ensemble(np.zeros((3, 1)), np.ones((2, 1))), ValueError, r"p has the shape \(2, 1\); it must be that of q, \(3, 1\)"),
                (lambda: solver.run([0.0], [1.0, 2.0]), ValueError, r"p has the shape \(2,\); it must be that of q, \(1,\)"),
                (lambda: solver.run([0.0, 1.0], [1.0, 2.0]), ValueError, r"q has the shape \(2,\); it must be the Solver's, \(1,\)"),
            ]
        )

    def test_formulas(self):
        formula = avi.hamiltonian(kepler, 2)
        of_data = avi.objective(lambda x: np.sum((np.ones((1000, 4)) @ x) ** 2), 4)
        self.check(
            [
                (traced(kepler, [0.5, 0]), TypeError, r"shape is \[0.5, 0\]; it must be that of q"),
                (traced(kepler, -1), ValueError, "shape is -1"),
                (lambda: formula.value(*START), TypeError, r"formula.value\(np.concatenate\(\[q, p\]\)\)"),
                (lambda: formula.gradient(*START), TypeError, r"formula.gradient\(np.concatenate"),
                (lambda: formula.value([1j] * 4), TypeError, "complex"),
                (solved(of_data), TypeError, "hamiltonian\\(\\) makes one"),
                (solved(3.0), TypeError, "H is 3.0; it must be a function"),
                (lambda: avi.minimise(3.0, [1.0]), TypeError, "f is 3.0; it must be a function"),
            ]
        )

    def test_events(self):
        zero = lambda q, p: q[0]

        def marked(**attributes):
            g = lambda q, p: q[0]
            g.__dict__.update(attributes)
            return g

        self.check(
            [
                (lambda: avi.event(zero, count=2.5), TypeError, "The count of an event is 2.5; it must be a whole number"),
                (lambda: avi.event(zero, count="2"), TypeError, "The count of an event is '2'"),
                (lambda: avi.event(zero, count=10**30), ValueError, "between 0 and"),
                (lambda: avi.event(zero, count=-1), ValueError, "between 0 and"),
                (lambda: avi.event(zero, direction=0.5), ValueError, "direction of an event is 0.5; it must be 1, -1, or 0"),
                (lambda: avi.event(zero, direction="up"), TypeError, "direction of an event is 'up'"),
                (lambda: avi.event(zero, stop=2), TypeError, "stop of an event is 2; .* beside count=2"),
                (lambda: avi.event(marked(terminal=True)), ValueError, "g has the attribute terminal.*give g itself as an event"),
                (lambda: avi.event(avi.event(zero, stop=True)), ValueError, "g has the attribute terminal"),
                (lambda: avi.event(marked(direction=-1), stop=True), ValueError, "g has the attribute direction"),
                (solved(events=marked(direction="up")), TypeError, "direction of an event is 'up'"),
                (solved(events=marked(terminal=2.5)), TypeError, "terminal of an event is 2.5"),
                (solved(events=5), TypeError, "An event is 5; it must be a function"),
                (solved(events=avi.objective(lambda x: np.sum((np.ones((1000, 4)) @ x) ** 2), 4)), TypeError, "An event takes the arguments x"),
                (solved(events=["q"]), TypeError, "An event is 'q'; it must be a function"),
            ]
        )
        self.assertEqual(solved(events=None)().t_events, [])
        times = [solved(spring, [1.0], [0.0], 20.0, 1e-9, events=g)().t_events[0].tolist() for g in (zero, avi.hamiltonian(zero, 1), [avi.event(avi.hamiltonian(zero, 1))])]
        self.assertEqual(times, [times[0]] * 3)
        rising = avi.event(zero, direction=1)
        self.assertIsInstance(rising, avi.Event)
        self.assertIn("direction 1", repr(rising))
        as_scipy, ours = (solved(spring, [1.0], [0.0], 20.0, 1e-9, events=g)().t_events[0].tolist() for g in (marked(direction=0.5), rising))
        self.assertEqual(as_scipy, ours)

    def test_names_of_options(self):
        zero = lambda q, p: q[0]
        self.check(
            [
                (solved(event=zero), TypeError, r"solve\(\) has no option 'event'; there are t, tol, events, progress, parameters, seconds, "),
                (solved(t_eval=[0.0, 1.0]), TypeError, r"no option 't_eval', which is t= here; there are"),
                (solved(dense_output=True), TypeError, "'dense_output', which is dense= here"),
                (solved(args=(1.0,)), TypeError, "'args', which is parameters= here"),
                (solved(rtol=1e-6), TypeError, "'rtol', which is tol= here"),
                (solved(maxiter=3), TypeError, "no option 'maxiter'; there are"),
                (lambda: avi.minimise(lambda x: x @ x, [1.0], maxiter=3), TypeError, "'maxiter', which is iterations= here; there are jac, parameters"),
                (lambda: avi.minimise(lambda x: x @ x, [1.0], tol=1e-6), TypeError, "'tol', which is relative= here"),
                (lambda: avi.event(zero, terminal=True), TypeError, r"event\(\) has no option 'terminal', which is stop= here; there are direction"),
            ]
        )

    def test_monitors(self):
        timed = lambda q, t, p: 1 + q @ q + 0.1 * np.sin(t)
        self.check([(solved(monitor=timed), ValueError, "write H as H\\(q, t, p\\), too"), (solved(h=0.1), ValueError, "Monitor is not set")])
        H = lambda q, t, p: kepler(q, p)
        exact = solved(tol=1e-12)().y[:, -1]
        for monitor in (timed, lambda q, p: q @ q):
            self.assertLess(np.abs(solved(H, monitor=monitor)().y[:, -1] - exact).max(), 1e-6)

    def test_runs(self):
        starts = np.ones((4, 1)), np.zeros((4, 1))
        solver = avi.Solver(spring, [1.0], [0.0], 1.0, 1e-6, checkpoint="run")
        self.check(
            [
                (lambda: avi.ensemble(spring, *starts, 1.0, 1e-6, checkpoint="run"), ValueError, "checkpoint= keeps one run"),
                (lambda: solver.ensemble(*starts), ValueError, "checkpoint= keeps one run"),
                (lambda: avi.ensemble(spring, *starts, 1.0, 1e-6, threads="2"), TypeError, "threads is '2'; it must be a whole number"),
                (lambda: avi.ensemble(spring, *starts, 1.0, 1e-6, threads=0), ValueError, "threads is 0"),
                (solved(progress=3), TypeError, "progress is 3; it must be True or a function"),
                (solved(steps=2.5), TypeError, "steps of solve.. is 2.5; it must be a whole number"),
                (solved(checkpoint=3), TypeError, "checkpoint of solve.. is 3; it must be a path"),
            ]
        )

        def stop(now):
            raise StopIteration

        orbits = avi.ensemble(kepler, np.tile(START[0], (8, 1)), np.tile(START[1], (8, 1)), 1e4, 1e-9, progress=stop, threads=1)
        self.assertEqual((len(orbits), orbits[-1].status), (8, -1))
        self.assertEqual(solved(tol=np.array(1e-8))().tolerance, 1e-8)

    def test_checkpoint_as_a_path(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "run"
            part = avi.solve(kepler, *START, 1e4, 1e-9, check=False, checkpoint=file, steps=500)
            self.assertFalse(part.success)
            self.assertTrue(file.exists())
            self.assertTrue(avi.resume(kepler, 2, file).success)

    def test_minimise(self):
        f = lambda x: x @ x
        self.check(
            [
                (lambda: avi.minimise(f, [1.0], jac=2), TypeError, "jac is 2; it must be a function, or True where f returns both"),
                (lambda: avi.minimise(f, [1.0], jac=lambda x: 2j * x), TypeError, "The gradient is complex"),
                (lambda: avi.minimise(f, [1.0], jac=lambda x: None), TypeError, "The gradient is None"),
                (lambda: avi.minimise(lambda x: None, [1.0], jac=lambda x: 2 * x), TypeError, "The value of f is None"),
                (lambda: avi.minimise(lambda x: "1.0", [1.0], jac=lambda x: 2 * x), TypeError, "The value of f is '1.0'"),
                (lambda: avi.minimise(lambda x: x, [1.0, 2.0], jac=lambda x: 2 * x), TypeError, r"f returned an array of shape \(2,\)"),
                (lambda: avi.minimise(lambda x, c=1.0: c * f(x), [1.0], jac=lambda x: 2 * x, parameters=[2.0]), TypeError, r"parameters= .*functools.partial\(\)"),
                (lambda: avi.minimise(avi.objective(f, 1), [1.0], jac=lambda x: 2 * x), TypeError, "f is a formula.*leave jac= out"),
                (lambda: avi.minimise(f, [1.0], jac=True), TypeError, r"f returned a float64; with jac=True it must return a pair"),
                (lambda: avi.minimise(lambda x: (x @ x > 1, 2 * x), [1.0], jac=True), TypeError, "f returned a comparison"),
                (lambda: avi.minimise(f, [1.0], callback=3), TypeError, "callback is 3; it must be a function"),
            ]
        )
        self.assertEqual(avi.minimise(f, [1.0, 2.0], jac=False).x.tolist(), avi.minimise(f, [1.0, 2.0]).x.tolist())


class Criterion(unittest.TestCase):
    def test_message_says_what_was_met(self):
        barrier = lambda x: x[0] - np.log(x[0])
        far = avi.minimise(barrier, [1e-8])
        self.assertTrue(far.success)
        self.assertGreater(abs(far.x[0] - 1), 1e-3)  # the gradient at the start is 1e8
        self.assertEqual(far.message, "Converged: |gradient| fell to at most 1e-06 of that at the start.")
        near = avi.minimise(barrier, [1e-8], relative=0.0, absolute=1e-6)
        self.assertEqual(near.message, "Converged: |gradient| is at most 1e-06, which was asked for.")
        self.assertLess(abs(near.x[0] - 1), 1e-5)
        self.assertEqual(avi.minimise(lambda x: x @ x, [0.0]).message, "Converged: the gradient is 0.")
        tiny = avi.minimise(lambda x: float(x @ x), [1.0, 2.0], jac=lambda x: 20 * x, relative=0.0)
        self.assertEqual(np.square(tiny.jac).tolist(), [0.0, 0.0])
        self.assertEqual(tiny.message, "Converged: |gradient| fell to 4e-163, the square of which is no number any more.")
        self.assertIn("|gradient| = 4e-163", repr(tiny))


class Copies(unittest.TestCase):
    def test_orbits_keep_what_is_between(self):
        orbit = avi.solve(spring, [1.0], [0.0], 5.0, 1e-9, dense=True, events=lambda q, p: q[0])
        for again in (copy.copy(orbit), copy.deepcopy(orbit)):
            self.assertEqual(again.sol(2.0).tolist(), orbit.sol(2.0).tolist())
            self.assertEqual(repr(again), repr(orbit))
            self.assertEqual(again.energy.tolist(), orbit.energy.tolist())
            self.assertEqual(again.t_events[0].tolist(), orbit.t_events[0].tolist())
        again.y[0, 0] = 7.0
        self.assertEqual((again.q[0, 0], orbit.q[0, 0]), (7.0, 1.0))


if __name__ == "__main__":
    unittest.main()
