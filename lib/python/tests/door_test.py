"""avi.solve() with times, events, the orbit in between, time in H, progress, fixed choices; avi.ensemble()."""

import os
import pickle
import signal
import tempfile
import threading
import time
import unittest

import numpy as np

import avi


def kepler(q, p):
    return (p @ p) / 2 - 1 / np.sqrt(q @ q)


def spring(q, p):
    return (p @ p + q @ q) / 2


START = [0.5, 0.0], [0.0, np.sqrt(3.0)]


class Times(unittest.TestCase):
    def test_states_at_times(self):
        times = np.concatenate([[0, 0, 1e-3], np.linspace(0.1, 20, 50), [20, 20]])
        orbit = avi.solve(spring, [1.0], [0.0], times, 1e-10)
        self.assertEqual(orbit.t.tolist(), times.tolist())
        self.assertEqual(orbit.q.shape, (1, 55))
        self.assertLess(np.abs(orbit.q[0] - np.cos(times)).max(), 1e-9)
        self.assertLess(np.abs(orbit.p[0] + np.sin(times)).max(), 1e-9)
        self.assertLess(np.abs(orbit.energy - 0.5).max(), 1e-12)
        self.assertTrue(np.shares_memory(orbit.q, orbit.y))

    def test_shapes(self):
        starts = np.arange(6.0).reshape(2, 3), np.ones((2, 3))
        orbit = avi.solve(lambda q, p: np.sum(p**2 + q**2) / 2, *starts, np.linspace(0, 1, 5), 1e-8)
        self.assertEqual((orbit.q.shape, orbit.p.shape, orbit.y.shape), ((2, 3, 5), (2, 3, 5), (12, 5)))
        self.assertEqual(orbit.q[..., 0].tolist(), starts[0].tolist())
        self.assertLess(np.abs(orbit.q[..., -1] - starts[0] * np.cos(1) - np.sin(1)).max(), 1e-7)

    def test_back(self):
        there = avi.solve(kepler, *START, 10.0, 1e-12)
        back = avi.solve(kepler, there.q[:, -1], there.p[:, -1], (10.0, 4.0, 0.0), 1e-12)
        self.assertEqual(back.t.tolist(), [10.0, 4.0, 0.0])
        self.assertLess(np.abs(back.y[:, -1] - np.concatenate(START)).max(), 1e-10)

    def test_between(self):
        orbit = avi.solve(spring, [1.0], [0.0], 20.0, 1e-10, dense=True)
        times = np.linspace(0, 20, 77)
        self.assertEqual((orbit.sol(times).shape, orbit.sol(1.0).shape), ((2, 77), (2,)))
        self.assertLess(np.abs(orbit.sol(times)[0] - np.cos(times)).max(), 1e-9)
        self.assertEqual(len(orbit.sol.times), orbit.nsteps + 1)
        table = orbit.sol(times[:6].reshape(2, 3))
        self.assertEqual((table.shape, table.tolist()), ((2, 2, 3), orbit.sol(times[:6]).reshape(2, 2, 3).tolist()))
        self.assertEqual(repr(orbit.sol), "<an orbit from t = 0 to 20 as a function>")
        with self.assertRaisesRegex(ValueError, "20"):
            orbit.sol(21.0)
        with self.assertRaisesRegex(TypeError, "t is None"):
            orbit.sol(None)
        self.assertIsNone(avi.solve(spring, [1.0], [0.0], 1.0, 1e-8).sol)
        self.assertIsNone(pickle.loads(pickle.dumps(orbit)).sol)

    def test_time_in_h(self):
        driven = lambda q, t, p: (p @ p + q @ q) / 2 - q[0] * np.sin(2 * t)
        times = np.linspace(1.0, 12.0, 12)
        exact = lambda t: np.cos(t) - np.sin(2 * t) / 3
        slope = lambda t: -np.sin(t) - 2 * np.cos(2 * t) / 3
        orbit = avi.solve(driven, [exact(1.0)], [slope(1.0)], times, 1e-10)
        self.assertLess(np.abs(orbit.q[0] - exact(times)).max(), 1e-8)
        self.assertEqual(orbit.energy.shape, (12,))
        formula = avi.hamiltonian(lambda q, t, p, c: (p @ p + q @ q) / 2 - c[0] * q[0] * np.sin(2 * t), 1, [1.0])
        self.assertLess(np.abs(avi.solve(formula, [exact(1.0)], [slope(1.0)], times, 1e-10).q - orbit.q).max(), 1e-9)

    def test_bad_times(self):
        for t, words in [([0, 2, 1], "Output time"), ([0, np.nan], "finite"), ([0.0, np.inf], "finite")]:
            with self.assertRaisesRegex(ValueError, words):
                avi.solve(spring, [1.0], [0.0], t, 1e-8)


class Events(unittest.TestCase):
    def test_found_where_they_are(self):
        zero = lambda q, p: q[0]
        orbit = avi.solve(spring, [1.0], [0.0], 20.0, 1e-10, events=[zero, avi.event(zero, direction=1), avi.event(zero, count=2)])
        crossings = np.pi * (np.arange(6) + 0.5)
        self.assertLess(np.abs(orbit.t_events[0] - crossings).max(), 1e-9)
        self.assertLess(np.abs(orbit.t_events[1] - crossings[1::2]).max(), 1e-9)
        self.assertLess(np.abs(orbit.t_events[2] - crossings[:2]).max(), 1e-9)
        self.assertEqual(orbit.y_events[0].shape, (6, 2))
        self.assertLess(np.abs(orbit.y_events[0][:, 0]).max(), 1e-9)
        self.assertEqual(orbit.status, 0)

    def test_event_at_the_end(self):
        """It ends the run where it is the last one that was asked for; of two there is another one to come."""
        for count in (1, 2):
            orbit = avi.solve(lambda q, p: p[0] + 0 * q[0], [0.0], [0.0], 2.0, 1e-8, events=avi.event(lambda q, p: q[0] - 2.0, count=count, stop=True))
            self.assertEqual((orbit.t_events[0].tolist(), orbit.status), ([2.0], 2 - count))

    def test_stop(self):
        falls = lambda q, p: q[0]
        falls.terminal, falls.direction = True, -1  # as solve_ivp has it
        orbit = avi.solve(spring, [1.0], [0.0], [0.0, 1.0, 2.0, 3.0], 1e-10, events=falls)
        self.assertEqual((orbit.status, orbit.success, orbit.message), (1, True, "An event ended the run."))
        self.assertEqual(orbit.outcome, "ok")
        self.assertEqual(orbit.t[:2].tolist(), [0.0, 1.0])
        self.assertAlmostEqual(orbit.t[-1], np.pi / 2, delta=1e-9)
        self.assertAlmostEqual(orbit.p[0, -1], -1.0, delta=1e-9)
        third = avi.solve(spring, [1.0], [0.0], 20.0, 1e-10, events=avi.event(lambda q, t, p: q[0] + 0 * t, count=3, stop=True))
        self.assertAlmostEqual(third.t[-1], 2.5 * np.pi, delta=1e-9)

    def test_terminal_count(self):
        crosses = lambda q, p: q[0]
        crosses.terminal = 3
        self.assertAlmostEqual(avi.solve(spring, [1.0], [0.0], 20.0, 1e-10, events=crosses).t[-1], 2.5 * np.pi, delta=1e-9)

    def test_none(self):
        orbit = avi.solve(spring, [1.0], [0.0], 1.0, 1e-8, events=lambda q, p: q[0] - 2)
        self.assertEqual((orbit.t_events[0].shape, orbit.y_events[0].shape), ((0,), (0, 2)))

    def test_bad(self):
        with self.assertRaisesRegex(TypeError, "An event returned an array"):
            avi.solve(kepler, *START, 1.0, 1e-8, events=lambda q, p: q)
        with self.assertRaisesRegex(TypeError, "branch"):
            avi.solve(kepler, *START, 1.0, 1e-8, events=lambda q, p: q[0] if q[0] > 0 else 1.0)
        with self.assertRaises(ValueError):
            avi.solve(kepler, *START, 1.0, 1e-8, events=avi.event(lambda q, p: q[0], direction=2))


class Running(unittest.TestCase):
    def test_fixed_choices(self):
        orbit = avi.solve(kepler, *START, 10.0, 1e-6, order=8, monitor="fixed", h=0.1)
        self.assertEqual((orbit.choice.order, orbit.choice.monitor, orbit.choice.h), (8, "fixed", 0.1))
        for wrong in ({"order": 3}, {"monitor": "mine"}, {"h": -1.0}, {"steps": 0}):
            with self.assertRaises(ValueError):
                avi.solve(kepler, *START, 10.0, 1e-6, **wrong)

    def test_bound_keeps_what_there_is(self):
        orbit = avi.solve(kepler, *START, np.linspace(0, 1e4, 1001), 1e-10, steps=500)
        self.assertEqual((orbit.success, orbit.status, orbit.outcome), (False, -1, "step_limit"))
        self.assertEqual(orbit.nsteps, 500)
        self.assertGreater(len(orbit.t), 2)
        self.assertEqual(orbit.q.shape, (2, len(orbit.t)))
        self.assertEqual(orbit.t[:-1].tolist(), np.linspace(0, 1e4, 1001)[: len(orbit.t) - 1].tolist())
        self.assertLess(np.abs(orbit.energy - orbit.energy[0]).max(), 1e-8)

    def test_ctrl_c_keeps_what_there_is(self):
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        begun = time.monotonic()
        timer.start()
        orbit = avi.solve(kepler, *START, 1e9, 1e-10, check=False)
        self.assertLess(time.monotonic() - begun, 2.0)
        self.assertFalse(orbit.success)
        self.assertEqual(orbit.message, "Stopped by Ctrl-C.")

    def test_progress(self):
        seen = []
        orbit = avi.solve(kepler, *START, 5e4, 1e-10, progress=seen.append)
        self.assertTrue(orbit.success)
        self.assertGreater(len(seen), 1)
        for fraction, t, steps, seconds in seen:
            self.assertTrue(0.0 <= fraction <= 1.0 and 0.0 <= t <= 5e4 and steps >= 0 and seconds > 0.0)

        def stop(now):
            raise StopIteration

        for end in stop, lambda now: False:
            self.assertFalse(avi.solve(kepler, *START, 1e9, 1e-10, progress=end).success)

        def fail(now):
            raise LookupError("mine")

        with self.assertRaisesRegex(LookupError, "mine"):
            avi.solve(kepler, *START, 1e9, 1e-10, progress=fail)


class Monitors(unittest.TestCase):
    halfway = staticmethod(lambda q, p: (q @ q) ** 0.75)
    start = [0.1, 0.0], [0.0, np.sqrt(19.0)]

    def test_function(self):
        given = avi.solve(kepler, *self.start, 20 * np.pi, 1e-10, monitor=self.halfway)
        named = avi.solve(kepler, *self.start, 20 * np.pi, 1e-10, monitor="energy")
        self.assertTrue(given.kept and named.kept)
        self.assertEqual((given.choice.monitor, named.choice.monitor), ("given", "energy"))
        self.assertLess(np.abs(given.q[:, -1] - self.start[0]).max(), 1e-9)
        self.assertLess(2 * given.nsteps, named.nsteps)
        formula = avi.hamiltonian(self.halfway, 2)
        self.assertEqual(avi.solve(kepler, *self.start, 20 * np.pi, 1e-10, monitor=formula).y.tolist(), given.y.tolist())
        fixed = avi.solve(kepler, *self.start, 20.0, 1e-6, monitor=self.halfway, order=8, h=0.1)
        self.assertEqual((fixed.choice.order, fixed.choice.h), (8, 0.1))

    def test_of_time_and_in_a_solver(self):
        driven = lambda q, t, p: (p @ p + q @ q) / 2 - q[0] * np.sin(2 * t)
        exact = lambda t: np.cos(t) - np.sin(2 * t) / 3
        orbit = avi.solve(driven, [1.0], [-2 / 3], 10.0, 1e-10, monitor=lambda q, t, p: (1 + 0.2 * np.sin(t)) / (1 + p @ p))
        self.assertAlmostEqual(orbit.q[0, -1], exact(10.0), delta=1e-9)
        solver = avi.Solver(kepler, *self.start, 20.0, 1e-9, monitor=self.halfway)
        self.assertTrue(solver.run(*self.start).kept)
        orbits = avi.ensemble(kepler, [self.start[0]] * 3, [self.start[1]] * 3, 20.0, 1e-9, monitor=self.halfway)
        self.assertEqual({orbit.choice.monitor for orbit in orbits}, {"given"})

    def test_bad(self):
        for monitor, error, words in [
            (lambda q, p: -1.0, ValueError, "at the start is -1"),
            (lambda q, p: q[0], ValueError, "The given monitor near t = "),
            (lambda q, p: q, TypeError, "The monitor returned an array"),
            (lambda q, p: q[0] if q[0] > 0 else 1.0, TypeError, "branch"),
            (3, TypeError, "a name or a function"),
            ("given", ValueError, "one of fixed, energy"),
        ]:
            with self.assertRaisesRegex(error, words):
                avi.solve(kepler, *self.start, 20.0, 1e-6, monitor=monitor)


class Checkpoints(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = os.path.join(folder.name, "run")

    def test_goes_on_with_the_same_digits(self):
        times = np.linspace(0, 2e4, 21)
        crossing = avi.event(lambda q, p: q[1], direction=1, count=5)
        for t, events in ((2e4, ()), (times, [crossing])):
            asked = {"check": False, "checkpoint": self.file, "events": events}
            whole = avi.solve(kepler, *START, t, 1e-9, **asked)
            self.assertFalse(os.path.exists(self.file))
            part = avi.solve(kepler, *START, t, 1e-9, steps=whole.nsteps // 2, **asked)
            self.assertEqual((part.success, part.status, os.path.exists(self.file)), (False, -1, True))
            again = avi.resume(kepler, 2, self.file, events=events, steps=whole.nsteps * 2 // 3)
            self.assertFalse(again.success)
            rest = avi.resume(kepler, 2, self.file, events=events)
            self.assertEqual((rest.t.tolist(), rest.y.tolist()), (whole.t.tolist(), whole.y.tolist()))
            self.assertEqual((rest.status, rest.message, rest.tolerance), (0, "The end was reached.", 1e-9))
            self.assertEqual([x.tolist() for x in rest.t_events], [x.tolist() for x in whole.t_events])
            self.assertFalse(os.path.exists(self.file))

    def test_bad(self):
        with self.assertRaisesRegex(ValueError, "There is no checkpoint"):
            avi.resume(kepler, 2, self.file)
        avi.solve(kepler, *START, 2e4, 1e-9, check=False, checkpoint=self.file, steps=5000)
        for H, shape in ((spring, 2), (kepler, 3)):
            with self.assertRaisesRegex(ValueError, "of another H"):
                avi.resume(H, shape, self.file)
        with open(self.file, "r+b") as file:
            file.seek(100)
            file.write(b"x")
        with self.assertRaisesRegex(ValueError, "damaged"):
            avi.resume(kepler, 2, self.file)


class Ensembles(unittest.TestCase):
    def test_each_is_as_alone(self):
        speeds = np.linspace(0.1, 1.9, 20)
        pendulum = lambda q, p: p[0] ** 2 / 2 - np.cos(q[0])
        times = np.linspace(0, 10, 5)
        for threads in (None, 1, 3):
            orbits = avi.ensemble(pendulum, np.zeros((20, 1)), speeds[:, None], times, 1e-8, threads=threads)
            for orbit, speed in zip(orbits, speeds):
                self.assertEqual(orbit.y.tolist(), avi.solve(pendulum, [0.0], [speed], times, 1e-8).y.tolist())

    def test_numbers_as_starts(self):
        orbits = avi.ensemble(lambda q, p: (p**2 + q**2) / 2, [1.0, 2.0], [0.0, 0.0], np.pi, 1e-8)
        self.assertLess(np.abs([orbit.q[-1] for orbit in orbits] + np.array([1, 2])).max(), 1e-7)

    def test_progress_and_what_it_raises(self):
        seen = []
        avi.ensemble(spring, np.ones((7, 1)), np.zeros((7, 1)), 1.0, 1e-6, progress=seen.append)
        self.assertEqual(avi.ensemble(spring, np.ones((0, 1)), np.zeros((0, 1)), 1.0, 1e-6), [])
        self.assertEqual(seen[-1], (1.0, 7))
        self.assertEqual(len(seen), 7)

        def fail(now):
            raise LookupError("mine")

        with self.assertRaisesRegex(LookupError, "mine"):
            avi.ensemble(spring, np.ones((7, 1)), np.zeros((7, 1)), 1.0, 1e-6, progress=fail)

    def test_bad_input(self):
        with self.assertRaises(ValueError):
            avi.ensemble(spring, np.ones((7, 1)), np.zeros((6, 1)), 1.0, 1e-6)
        with self.assertRaisesRegex(ValueError, "Start number 1: At the start .* is nan.*finite"):
            avi.ensemble(spring, [[1.0], [np.nan]], np.zeros((2, 1)), 1.0, 1e-6)
        with self.assertRaisesRegex(TypeError, "tol is '1e-6'; it must be a number."):
            avi.solve(spring, [1.0], [0.0], 1.0, "1e-6")

    def test_ctrl_c(self):
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        begun = time.monotonic()
        orbits = avi.ensemble(kepler, np.tile(START[0], (50, 1)), np.tile(START[1], (50, 1)), 1e6, 1e-10, check=False)
        self.assertLess(time.monotonic() - begun, 5.0)
        self.assertEqual(len(orbits), 50)
        self.assertFalse(orbits[-1].success)
        self.assertLessEqual(orbits[-1].nsteps, 1)
        self.assertEqual(orbits[-1].message, "Stopped by Ctrl-C.")


class Solvers(unittest.TestCase):
    def test_keeps_times_of_its_own(self):
        times = np.array([0.0, 5.0, 10.0])
        solver = avi.Solver(spring, [1.0], [0.0], times, 1e-8)
        times[:] = 1.0
        self.assertEqual(solver.run([1.0], [0.0]).t.tolist(), [0.0, 5.0, 10.0])

    def test_ctrl_c_leaves_no_unfinished_choice(self):
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            avi.Solver(kepler, *START, 1e8, 1e-10)

    def test_one_choice_for_many(self):
        solver = avi.Solver(kepler, *START, 20.0, 1e-9)
        alone = avi.solve(kepler, *START, 20.0, 1e-9)
        self.assertEqual((solver.choice.monitor, solver.choice.order), (alone.choice.monitor, alone.choice.order))
        starts = np.tile(START[0], (8, 1)) + np.linspace(0, 0.05, 8)[:, None], np.tile(START[1], (8, 1))
        times = np.linspace(0, 15, 4)
        orbits = solver.ensemble(*starts, times, threads=2)
        for q, p, orbit in zip(*starts, orbits):
            self.assertEqual(orbit.choice.h, solver.choice.h)
            self.assertEqual(orbit.y.tolist(), solver.run(q, p, times).y.tolist())
            exact = avi.solve(kepler, q, p, times, 1e-12)
            self.assertLess(np.abs(orbit.y - exact.y).max(), 1e-7)
        self.assertEqual(solver.run(*START).t[-1], 20.0)
        self.assertIn(solver.choice.monitor, solver.sample)

    def test_bad_starts(self):
        solver = avi.Solver(kepler, *START, 20.0, 1e-9)
        with self.assertRaisesRegex(ValueError, "the Solver's"):
            solver.run([1.0], [1.0])
        with self.assertRaisesRegex(ValueError, "finite"):
            solver.run([np.nan, 1.0], [1.0, 1.0])


if __name__ == "__main__":
    unittest.main()
