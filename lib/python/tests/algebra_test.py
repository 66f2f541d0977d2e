"""Linear algebra of traced matrices whose leading pivots are zero or tiny, large matrices from the left and the right, functions that
have to be right over the whole range of numbers."""

import math
import unittest

import numpy as np

import avi


def cofactors(a):
    """The slopes of the determinant."""
    n = len(a)
    minor = lambda i, j: np.linalg.det(np.delete(np.delete(a, i, 0), j, 1)) if n > 1 else 1.0
    return np.array([[(-1.0) ** (i + j) * minor(i, j) for j in range(n)] for i in range(n)])


def matrices():
    """By the name of what is bad about them."""
    random = np.random.default_rng(5)
    for n in (1, 2, 3, 4, 5, 7):
        a = random.normal(size=(n, n))
        yield "any", a
        yield "positive definite", a @ a.T + np.eye(n)
        if n > 1:
            yield "zero at the head", np.where(np.arange(n * n).reshape(n, n) == 0, 0.0, a)
            yield "tiny at the head", np.where(np.arange(n * n).reshape(n, n) == 0, 1e-20, a)
            yield "upside down", np.eye(n)[::-1] * np.arange(1.0, n + 1)
            yield "no diagonal", a * (1 - np.eye(n)) + np.roll(np.eye(n), 1, 0)


def singular():
    random = np.random.default_rng(6)
    for n in (1, 2, 3, 4, 5):
        for rank in range(n):
            yield random.normal(size=(n, rank)) @ random.normal(size=(rank, n))
        yield np.where(np.arange(n) == 0, 0.0, np.round(4 * random.normal(size=(n, n))))  # of integers
        yield np.where(np.arange(n)[:, None] == n - 1, 0.0, np.round(4 * random.normal(size=(n, n))))


class Matrices(unittest.TestCase):
    def test_determinant(self):
        for bad, a in matrices():
            formula = avi.objective(np.linalg.det, a.shape)
            size = np.abs(np.linalg.inv(a) * np.linalg.det(a)).max() + abs(np.linalg.det(a))
            self.assertAlmostEqual(formula.value(a), np.linalg.det(a), delta=1e-13 * size, msg=bad)
            self.assertLess(np.abs(formula.gradient(a).reshape(a.shape) - cofactors(a)).max(), 1e-12 * size, bad)
        for a in singular():
            formula = avi.objective(np.linalg.det, a.shape)
            size = 1 + np.abs(a).max() ** len(a)
            self.assertLess(abs(formula.value(a)), 1e-14 * size)
            self.assertLess(np.abs(formula.gradient(a).reshape(a.shape) - cofactors(a)).max(), 1e-13 * size)

    def test_solution_and_inverse(self):
        for bad, a in matrices():
            n = len(a)
            b, w = np.arange(1.0, n + 1), np.cos(np.arange(n))
            solved = np.linalg.solve(a, b)
            size = np.linalg.cond(a) * np.abs(solved).max()
            slopes = -np.outer(np.linalg.solve(a.T, w), solved)
            formula = avi.objective(lambda a: w @ np.linalg.solve(a, b), a.shape)
            self.assertAlmostEqual(formula.value(a), w @ solved, delta=1e-14 * size, msg=bad)
            self.assertLess(np.abs(formula.gradient(a).reshape(n, n) - slopes).max(), 1e-13 * size * np.abs(slopes).max(), bad)
            formula = avi.objective(lambda a: w @ np.linalg.inv(a) @ b + np.linalg.solve(a, np.eye(n))[0, n - 1], a.shape)
            size = np.linalg.cond(a) * np.abs(np.linalg.inv(a)).max()
            self.assertAlmostEqual(formula.value(a), w @ solved + np.linalg.inv(a)[0, n - 1], delta=1e-13 * size, msg=bad)

    def test_other_sizes_of_numbers(self):
        for scale in (1e-150, 1e150):
            a = scale * np.array([[1e-3, 2.0, 1.0], [3.0, 1e-3, 0.5], [1.0, 2.0, 2.0]])
            formula = avi.objective(lambda a: np.sum(np.linalg.solve(a, np.ones(3))), (3, 3))
            self.assertAlmostEqual(formula.value(a) * scale, np.sum(np.linalg.solve(a / scale, np.ones(3))), delta=1e-14)

    def test_a_metric_that_loses_its_head(self):
        """A mass matrix [[q, 1], [1, 0]] whose head is zero on the way: the orbit is that of the inverse written out, [[0, 1], [1, -q]]."""
        ones = np.ones((2, 2)) - np.eye(2)
        H = lambda q, p: p @ np.linalg.solve(ones + q[0] * np.diag([1.0, 0.0]), p) / 2 + q[1]
        written_out = lambda q, p: p[0] * p[1] - q[0] * p[1] ** 2 / 2 + q[1]
        start = [-0.3, 0.0], [0.3, 1.0]
        there, exact = (avi.solve(f, *start, 0.6, 1e-10) for f in (H, written_out))
        self.assertLess(there.q[0, 0], 0.0)
        self.assertGreater(there.q[0, -1], 0.0)
        self.assertLess(np.abs(there.y[:, -1] - exact.y[:, -1]).max(), 1e-9)

    def test_refused(self):
        for f, error, words in [
            (lambda x: np.linalg.norm(x, 2, axis=(0, 1)), TypeError, "as the 2-norm of vectors"),
            (lambda x: np.linalg.norm(x, 2), TypeError, "as the 2-norm of vectors"),
            (lambda x: np.linalg.norm(x, 1), TypeError, "as the 2-norm of vectors"),
            (lambda x: np.linalg.solve(x, np.ones(2))[0], ValueError, r"b of the shape \(2,\)"),
            (lambda x: np.linalg.det(x[:2]), ValueError, "square"),
        ]:
            with self.assertRaisesRegex(error, words):
                avi.objective(f, (3, 3))
        self.assertAlmostEqual(avi.objective(lambda x: np.linalg.norm(x, "fro", axis=(0, 1)), (2, 2)).value(np.ones(4)), 2.0)

    def test_products_with_large_matrices_from_either_side(self):
        random = np.random.default_rng(3)
        table, x0 = random.normal(size=(12, 300)), random.normal(size=12)
        of_all = lambda x, a: sum(x[..., i, None] * a[i] for i in range(12))
        for f, shape in ((lambda x, times: np.mean(np.tanh(times(x, table))), 12), (lambda x, times: np.sum(np.tanh(times(x, table)) ** 2, axis=1)[2], (3, 12))):
            x = np.resize(x0, shape) * 0.1
            kept, recorded = avi.objective(lambda x: f(x, np.matmul), shape), avi.objective(lambda x: f(x, of_all), shape)
            by_sign = avi.objective(lambda x: f(x, lambda x, a: x @ a), shape)
            self.assertIn("Data", type(kept).__name__)
            self.assertEqual(by_sign.value(x), kept.value(x))
            self.assertAlmostEqual(kept.value(x), f(x, np.matmul), delta=1e-13)
            self.assertLess(np.abs(kept.gradient(x) - recorded.gradient(x)).max(), 1e-13)

    def test_other_names_of_products(self):
        random = np.random.default_rng(5)
        table, cube, x = random.normal(size=(300, 12)), random.normal(size=(2, 3, 4)), random.normal(size=12)
        ways = (lambda x: np.inner(table, x), lambda x: np.inner(x, table), lambda x: np.tensordot(table, x, 1), lambda x: np.tensordot(x, table, (0, -1)))
        ways += (lambda x: np.einsum("ij,j->i", table, x), lambda x: np.einsum("j,ij", x, table), lambda x: np.einsum("ji,i->j", table, x))
        for way in ways:
            kept = avi.objective(lambda x: np.sum(np.tanh(way(x)) ** 2), 12)
            self.assertIn("Data", type(kept).__name__)
            self.assertAlmostEqual(kept.value(x), np.sum(np.tanh(table @ x) ** 2), delta=1e-11)
        for f in (
            lambda x: np.tensordot(cube, x.reshape(3, 4), ([1, 2], [0, 1]))[1],
            lambda x: np.tensordot(x.reshape(3, 4), cube, ([1, 0], [2, 1]))[0],
            lambda x: np.tensordot(x.reshape(3, 4), cube, 0)[2, 3, 1, 2, 1],
            lambda x: np.tensordot(x.reshape(3, 4), cube[0])[()],
            lambda x: np.inner(cube, x[:4])[1, 2] * np.inner(x[0], x)[3],
            lambda x: np.inner(x.reshape(3, 4), cube)[2, 1, 0],
            lambda x: np.einsum("ij,kj->ki", x.reshape(3, 4), cube[0])[2, 1],
        ):
            self.assertAlmostEqual(avi.objective(f, 12).value(x), f(x), delta=1e-13)
        with self.assertRaisesRegex(ValueError, "have to agree"):
            avi.objective(lambda x: np.tensordot(cube, x, 1)[0, 0], 12)

    def test_large_matrices_are_of_real_numbers(self):
        table = np.arange(5000.0).reshape(100, 50)
        for matrix, word in ((table * 1j, "complex"), (np.ma.array(table, mask=table > 9), "mask"), (np.asmatrix(table), "np.matrix")):
            for product in (lambda x: matrix @ x, lambda x: x @ matrix.T):
                with self.assertRaisesRegex(TypeError, word):
                    avi.objective(lambda x: np.sum(product(x) ** 2), 50)

    def test_einsum_with_a_way(self):
        x = np.arange(6.0)
        f = lambda x: np.einsum("ij,j->i", np.ones((2, 6)), x, optimize=True)[1]
        self.assertEqual(avi.objective(f, 6).value(x), f(x))


class WholeRange(unittest.TestCase):
    points = np.concatenate([s * np.array([0.0, 5e-324, 1e-300, 1e-20, 1e-9, 1e-4, 0.1, 0.99, 1.01, 20.0, 700.0, 709.0, 720.0, 740.0, 800.0]) for s in (1, -1)])

    def slopes_are(self, f, x, value, slope, bound):
        formula = avi.objective(lambda x: f(x[0]), 1)
        self.assertLessEqual(abs(formula.value([x]) - value), bound * abs(value) + 5e-324, x)
        self.assertLessEqual(abs(formula.gradient([x])[0] - slope), bound * abs(slope) + 5e-324, x)

    def test_expit(self):
        try:
            from scipy.special import expit
        except ImportError:
            self.skipTest("SciPy is not there.")
        for x in self.points:
            e = math.exp(-abs(x))  # the function of SciPy 1.10 is zero where this is below 1e-308
            self.slopes_are(expit, x, (1.0 if x >= 0 else e) / (1 + e), e / (1 + e) ** 2, 1e-15)

    def test_sinc(self):
        for x in np.clip(self.points / np.pi, -30, 30):
            y = np.pi * x
            value = np.sinc(x)
            terms = [(-1) ** k * 2 * k * y ** (2 * k - 1) / math.factorial(2 * k + 1) for k in range(1, 12)]
            slope = np.pi * (math.fsum(terms) if abs(y) < 1 else np.cos(y) / y - np.sin(y) / y**2)
            self.slopes_are(np.sinc, x, value, slope, 2e-15)
        swing = avi.solve(lambda q, p: p @ p / 2 - np.sum(np.sinc(q)), [0.2], [0.0], 10.0, 1e-9)
        self.assertTrue(swing.kept)


if __name__ == "__main__":
    unittest.main()
