"""avi.solve(): results, bad input, exceptions, threads, memory."""

import gc
import pickle
import resource
import threading
import time
import unittest

import numpy as np

import avi


def kepler(q, p):
    return (p @ p) / 2 - 1 / np.sqrt(q @ q)


START = [0.1, 0.0], [0.0, np.sqrt(19.0)]
PERIOD = 2 * np.pi


class Orbits(unittest.TestCase):
    def test_a_period(self):
        orbit = avi.solve(kepler, *START, PERIOD, 1e-10)
        self.assertTrue(orbit.success and orbit.kept)
        self.assertEqual((orbit.status, orbit.t.tolist()), (0, [0.0, PERIOD]))
        self.assertEqual((orbit.q.shape, orbit.p.shape, orbit.y.shape), ((2, 2), (2, 2), (4, 2)))
        self.assertLess(np.abs(orbit.q[:, -1] - START[0]).max(), 1e-9)
        self.assertTrue(np.shares_memory(orbit.q, orbit.y))
        trials = sum(trial.sweeps * trial.order for trial in orbit.choice.trials)
        self.assertEqual(orbit.nfev, (trials + orbit._report.run.evaluations * orbit.choice.order) // 2)
        self.assertGreater(trials, 0)
        spring = avi.solve(lambda q, p: (p @ p + q @ q) / 2, [1.0], [0.0], 10.0, 1e-6, monitor="splitting")
        kicks = spring._report.run.evaluations + sum(trial.sweeps for trial in spring.choice.trials)
        self.assertEqual((spring.nfev, spring.choice.order), (kicks, 6))
        self.assertIn(orbit.choice.monitor, repr(orbit))
        self.assertIn(f"{orbit.nsteps} steps", repr(orbit))

    def test_a_drive_that_switches(self):
        pushes = (
            lambda t: avi.where(np.sin(3 * t) < 0, -1.0, 1.0),
            lambda t: np.where(np.sin(3 * t) < 0, -1.0, 1.0),
            lambda t: np.sign(np.sin(3 * t)),
            lambda t: 2 * np.heaviside(np.sin(3 * t), 1.0) - 1,
            lambda t: np.where(t % (np.pi / 1.5) < np.pi / 3, 1.0, -1.0),
            lambda t: 1 - 2 * (t // (np.pi / 3) % 2),
        )
        ends = []
        for push in pushes:
            orbit = avi.solve(lambda q, t, p: (p @ p + q @ q) / 2 + 0.3 * q[0] * push(t), [1.0], [0.0], 50.0, 1e-10)
            self.assertTrue(orbit.kept)
            self.assertLess(orbit.nsteps, 500)
            ends.append(orbit.q[0, -1])
        self.assertLess(np.ptp(ends), 1e-12)

    def test_time_of_the_start(self):
        orbit = avi.solve(kepler, *START, (5.0, 5.0 + PERIOD), 1e-10)
        self.assertEqual(orbit.t.tolist(), [5.0, 5.0 + PERIOD])
        self.assertLess(np.abs(orbit.q[:, -1] - START[0]).max(), 1e-9)

    def test_formula_with_parameters(self):
        formula = avi.hamiltonian(lambda q, p, c: (p @ p) / 2 - c[0] / np.sqrt(q @ q), 2, [1.0])
        self.assertEqual(avi.solve(formula, *START, 3.0, 1e-10).y.tolist(), avi.solve(kepler, *START, 3.0, 1e-10).y.tolist())
        heavier = avi.solve(formula.with_parameters([2.0]), *START, 3.0, 1e-10)
        self.assertEqual(avi.solve(formula, *START, 3.0, 1e-10, parameters=[2.0]).y.tolist(), heavier.y.tolist())
        self.assertEqual(heavier.y.tolist(), avi.solve(lambda q, p: (p @ p) / 2 - 2 / np.sqrt(q @ q), *START, 3.0, 1e-10).y.tolist())

    def test_bounds(self):
        orbit = avi.solve(kepler, *START, 1e5, 1e-10, sweeps=20000)
        self.assertEqual((orbit.success, orbit.kept, orbit.status), (False, False, -1))
        self.assertIn("step_limit", orbit.message)

    def test_bad_input(self):
        q, p = START
        for call, words in [
            (lambda: avi.solve(kepler, q, [0.0, 1.0, 2.0], 1.0, 1e-6), "that of q"),
            (lambda: avi.solve(kepler, [], [], 1.0, 1e-6), "at least 1"),
            (lambda: avi.solve(kepler, [np.nan, 0.0], p, 1.0, 1e-6), "finite"),
            (lambda: avi.solve(kepler, [0.0, 0.0], p, 1.0, 1e-6), "an energy that is finite"),
            (lambda: avi.solve(kepler, q, p, np.inf, 1e-6), "finite"),
            (lambda: avi.solve(kepler, q, p, np.nan, 1e-6), "finite"),
            (lambda: avi.solve(kepler, q, p, [[1.0]], 1e-6), "at least two times"),
            (lambda: avi.solve(kepler, q, p, [1.0], 1e-6), "at least two times"),
            (lambda: avi.solve(kepler, q, p, 1.0, 0.0), "olerance"),
            (lambda: avi.solve(kepler, q, p, 1.0, np.nan), "olerance"),
            (lambda: avi.solve(kepler, q, p, 1.0, 1.0), "olerance"),
            (lambda: avi.solve(kepler, q, p, 1.0, 1e-6, seconds=-1.0), "econds"),
            (lambda: avi.solve(kepler, q, p, 1.0, 1e-6, sweeps=0), "weeps"),
            (lambda: avi.solve(avi.hamiltonian(kepler, 2), [1.0], [1.0], 1.0, 1e-6), "Number of arguments"),
        ]:
            with self.assertRaises(ValueError) as caught:
                call()
            self.assertIn(words, str(caught.exception))
        for call in [
            lambda: avi.solve(kepler, q, p, 1.0),
            lambda: avi.solve(3.0, q, p, 1.0, 1e-6),
            lambda: avi.solve(lambda x: x, q, p, 1.0, 1e-6),
            lambda: avi.solve(kepler, q, p, 1.0, "a"),
            lambda: avi.solve(kepler, q, p, 1.0, 1e-6, rtol=1e-3),
            lambda: avi.solve(kepler, q, p, 1.0, 1e-6, order="8"),
            lambda: avi.solve(kepler, [1j, 0], p, 1.0, 1e-6),
        ]:
            with self.assertRaises(TypeError):
                call()

    def test_pickling(self):
        orbit = avi.solve(kepler, *START, PERIOD, 1e-8)
        again = pickle.loads(pickle.dumps(orbit))
        again = pickle.loads(pickle.dumps(again))
        self.assertEqual(repr(again), repr(orbit))
        self.assertEqual(again.y.tolist(), orbit.y.tolist())
        for name in ("success", "kept", "status", "message", "nfev", "nsteps", "tolerance", "state_error", "energy_error", "note"):
            self.assertEqual(getattr(again, name), getattr(orbit, name))
        self.assertEqual(again.energy.tolist(), orbit.energy.tolist())
        self.assertEqual(again.choice.trials[0].h, orbit.choice.trials[0].h)

    def test_threads_run_beside_each_other(self):
        counted = [0]
        done = threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(1e-4)

        counter = threading.Thread(target=count, daemon=True)
        counter.start()
        expected = avi.solve(kepler, *START, 20 * PERIOD, 1e-10).y.tolist()
        before = counted[0]
        avi.solve(kepler, *START, 5000 * PERIOD, 1e-10)
        self.assertGreater(counted[0] - before, 20)  # the lock was not held
        found = []
        threads = [threading.Thread(target=lambda: found.append(avi.solve(kepler, *START, 20 * PERIOD, 1e-10).y.tolist())) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        done.set()
        counter.join()
        self.assertEqual(found, [expected] * 4)

    def test_no_leak(self):
        """Memory after 1e5 calls is what it was after a thousand."""

        def both(calls):
            for _ in range(calls):
                avi.solve(lambda q, p: (p @ p + q @ q) / 2, [1.0], [0.0], 0.1, 1e-4)
                avi.minimise(lambda x: x @ x, [1.0, 2.0], callback=lambda x: None, history=True)
                for wrong in (lambda q, p: q[0] > 0 and 1.0, lambda q, p: q, lambda q, p: 1 / 0):
                    try:
                        avi.solve(wrong, [1.0], [0.0], 0.1, 1e-4)
                    except (TypeError, ValueError, ZeroDivisionError):
                        pass
            gc.collect()

        both(200)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        both(20_000)  # of five calls each
        self.assertLess(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before, 1000)  # kB


if __name__ == "__main__":
    unittest.main()
