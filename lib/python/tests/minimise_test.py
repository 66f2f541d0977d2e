"""avi.minimise() against known minima, SciPy, bad input and Ctrl-C."""

import os
import pickle
import signal
import threading
import time
import unittest

import numpy as np

import avi


def rosenbrock(x):
    return np.sum(100 * (x[1:] - x[:-1] ** 2) ** 2 + (1 - x[:-1]) ** 2)


def slope_of_rosenbrock(x):
    slope = np.zeros_like(x)
    slope[:-1] = -400 * x[:-1] * (x[1:] - x[:-1] ** 2) - 2 * (1 - x[:-1])
    slope[1:] += 200 * (x[1:] - x[:-1] ** 2)
    return slope


class Minimise(unittest.TestCase):
    start = np.array([-1.2, 1.0] * 5)

    def test_traced(self):
        found = avi.minimise(rosenbrock, self.start, relative=1e-12)
        self.assertTrue(found.success)
        self.assertEqual(found.status, 0)
        self.assertLess(np.abs(found.x - 1).max(), 1e-9)
        self.assertEqual(found.jac.shape, (10,))
        self.assertLess(np.abs(found.jac - slope_of_rosenbrock(found.x)).max(), 1e-12)

    def test_called_back_takes_the_same_steps(self):
        traced = avi.minimise(rosenbrock, self.start)
        apart = avi.minimise(rosenbrock, self.start, jac=slope_of_rosenbrock)
        both = avi.minimise(lambda x: (rosenbrock(x), slope_of_rosenbrock(x)), self.start, jac=True)
        self.assertEqual(apart.x.tolist(), both.x.tolist())
        self.assertLess(abs(traced.njev - apart.njev), 0.2 * traced.njev)
        self.assertLess(np.abs(traced.x - apart.x).max(), 1e-6)

    def test_shape_of_x0(self):
        found = avi.minimise(lambda x: np.sum((x - np.arange(6).reshape(2, 3)) ** 2), np.ones((2, 3)))
        self.assertLess(np.abs(found.x - np.arange(6).reshape(2, 3)).max(), 1e-12)
        found = avi.minimise(lambda x: np.sum(x**2), np.ones((2, 3)), jac=lambda x: 2 * x)
        self.assertEqual((found.x.shape, found.jac.shape), ((2, 3), (2, 3)))
        self.assertLess(abs(avi.minimise(lambda x: (x - 3) ** 2, 0.0).x - 3), 1e-12)

    def test_formula_and_parameters(self):
        formula = avi.objective(lambda x, c: np.sum((x - c) ** 2), 3, [1.0, 2.0, 3.0])
        self.assertLess(np.abs(avi.minimise(formula, np.zeros(3)).x - [1, 2, 3]).max(), 1e-12)
        self.assertLess(np.abs(avi.minimise(formula.with_parameters([4, 5, 6]), np.zeros(3)).x - [4, 5, 6]).max(), 1e-12)
        self.assertLess(np.abs(avi.minimise(formula, np.zeros(3), parameters=[7, 8, 9]).x - [7, 8, 9]).max(), 1e-12)

    def test_data(self):
        """Products with large matrices are kept as products: values and gradients are those of all numbers recorded, and of NumPy."""
        random = np.random.default_rng(3)
        table, classes, x = random.normal(size=(300, 12)), random.normal(size=(300, 3)), random.normal(size=13)
        of_all = lambda a, x: np.stack([sum(a[i, j] * x[j] for j in range(a.shape[1])) for i in range(len(a))])

        def regression(x, product=np.matmul):
            return np.mean(np.logaddexp(0, product(table, x[1:]) + x[0]))

        def several(w, product=np.matmul):
            w = w.reshape(12, -1)
            return np.sum((product(table, w) - classes) ** 2) + np.sum(np.dot(table[:, ::-1], w[:, 1]) ** 3) + np.sum((table @ w[:, 0] ** 2)[:9])

        def of_products(x, product=np.matmul):
            y = product(table, x[1:])
            return np.sum(product(table.T, y) * x[:12]) + np.sum(product(table.T, np.stack([y, x[0] * y, y[::-1]], axis=1)[:, [0, 2]]) ** 3) * 1e-6

        for f, x0, products in ((regression, x, 1), (several, random.normal(size=36), 2), (of_products, x, 3)):
            kept, recorded = (avi.objective(lambda x, p=p: f(x, p), x0.shape) for p in (np.matmul, of_all))
            self.assertEqual(len(kept._kept), products)
            self.assertEqual(kept.size, x0.size)
            self.assertAlmostEqual(kept.value(x0), f(x0), delta=1e-11 * abs(f(x0)))
            self.assertLess(np.abs(kept.gradient(x0) - recorded.gradient(x0)).max(), 1e-11 * np.abs(kept.gradient(x0)).max())
        found = avi.minimise(lambda x: np.mean((table @ x - classes[:, 0]) ** 2), np.zeros(12), relative=1e-12)
        self.assertLess(np.abs(found.x - np.linalg.lstsq(table, classes[:, 0], rcond=None)[0]).max(), 1e-11)
        shifted = avi.objective(lambda x, c: np.mean((table @ x - table @ c) ** 2), 12, np.ones(12))
        self.assertLess(np.abs(avi.minimise(shifted, np.zeros(12)).x - 1).max(), 1e-5)
        self.assertLess(np.abs(avi.minimise(shifted, np.zeros(12), parameters=np.arange(12.0)).x - np.arange(12)).max(), 1e-4)
        apart = lambda x, c: np.sum((table.T @ (table @ x) - c) ** 2)
        self.assertAlmostEqual(avi.objective(apart, 12, np.ones(12)).value(x[1:]) / apart(x[1:], 1), 1, delta=1e-13)
        for wrong in ([1.0], np.ones((2, 12))):
            with self.assertRaisesRegex(ValueError, "must be 12"):
                shifted.value(wrong)

    def test_history_and_callback(self):
        seen = []
        found = avi.minimise(rosenbrock, self.start, callback=seen.append, history=True)
        self.assertEqual(len(seen), len(found.history))
        self.assertEqual(found.history[-1, 1], found.fun)
        self.assertEqual(seen[-1].tolist(), found.x.tolist())

        def stop_at_third(x, count=[0]):
            count[0] += 1
            if count[0] == 3:
                raise StopIteration

        for end in stop_at_third, lambda x: len(x) == 0, lambda x: np.all(x > 1e9):
            self.assertEqual(avi.minimise(rosenbrock, self.start, callback=end).outcome, "stopped")

    def test_what_a_callback_raises(self):
        def fail(x):
            raise LookupError("mine")

        with self.assertRaisesRegex(LookupError, "mine"):
            avi.minimise(rosenbrock, self.start, callback=fail)
        with self.assertRaisesRegex(LookupError, "mine"):
            avi.minimise(rosenbrock, self.start, jac=fail)

    def test_ctrl_c_keeps_what_there_is(self):
        for jac in (None, lambda x: 4 * x**3):
            threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
            started = time.monotonic()
            found = avi.minimise(lambda x: np.sum(x**4), np.ones(3), jac=jac, relative=0.0, callback=lambda x: time.sleep(0.02))
            self.assertLess(time.monotonic() - started, 1.5)
            self.assertEqual((found.outcome, found.success), ("stopped", False))
            self.assertIn("Ctrl-C", found.message)
            self.assertLess(found.fun, 3.0)

    def test_bad_input(self):
        for call, error, words in [
            (lambda: avi.minimise(rosenbrock, []), ValueError, "at least 1"),
            (lambda: avi.minimise(rosenbrock, [1.0, np.nan]), ValueError, "finite"),
            (lambda: avi.minimise(rosenbrock, self.start, relative=2.0), ValueError, "[0, 1)"),
            (lambda: avi.minimise(rosenbrock, self.start, memory=-1), ValueError, "between 0 and 1000"),
            (lambda: avi.minimise(rosenbrock, self.start, tol=1), TypeError, "relative"),
            (lambda: avi.minimise(rosenbrock, self.start, jac=lambda x: x[:3]), None, "wrong_gradient"),
            (lambda: avi.minimise(rosenbrock, self.start, jac=lambda x: x, check_gradient=True), None, "wrong_gradient"),
            (lambda: avi.minimise(lambda x: float(x[0]), [1.0]), TypeError, "np.sin"),
            (lambda: avi.minimise(rosenbrock, ["a"]), TypeError, "x0 is ['a']; it must be a real number"),
        ]:
            if error:
                with self.assertRaises(error) as caught:
                    call()
                self.assertIn(words, str(caught.exception))
            else:
                self.assertEqual(call().outcome, words)

    def test_pickling_and_repr(self):
        found = avi.minimise(rosenbrock, self.start)
        again = pickle.loads(pickle.dumps(found))
        self.assertEqual(repr(again), repr(found))
        self.assertIn(f"{found.nit} iterations, {found.njev} gradients", repr(found))

    def test_against_scipy(self):
        try:
            from scipy.optimize import minimize
        except ImportError:
            self.skipTest("SciPy is not there.")
        ours = avi.minimise(rosenbrock, self.start, relative=1e-8)
        theirs = minimize(rosenbrock, self.start, method="L-BFGS-B", jac=slope_of_rosenbrock)
        self.assertLessEqual(ours.fun, theirs.fun + 1e-9)
        for name in ("x", "fun", "jac", "nit", "nfev", "njev", "success", "status", "message"):
            self.assertEqual(np.shape(getattr(ours, name)), np.shape(getattr(theirs, name)), name)


if __name__ == "__main__":
    unittest.main()
