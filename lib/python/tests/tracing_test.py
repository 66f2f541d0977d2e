"""What a traced function may do, and what it is told where it does something else."""

import functools
import math
import unittest

import numpy as np

import avi


def everything(q, p):
    """NumPy as people write it, of q and p with two entries each, away from kinks."""
    c = np.concatenate([q, p])
    matrix = np.array([[1.0, 2.0], [3.0, 4.0]])
    total = np.sum(q) + q.sum() + np.prod(p) + np.mean(c) + np.dot(q, p) + q @ p + (matrix @ q) @ p + q @ matrix @ p + c.max() + np.min(c)
    total += np.linalg.norm(q) + np.linalg.norm(c.reshape(2, 2), axis=1).sum() + np.linalg.norm(np.array([q[0], p[1]]))
    total += np.cross(q, p) + (np.outer(q, p) @ p).sum() + np.trace(np.outer(q, p)) + np.diff(c)[0] + np.diff(np.outer(q, p), axis=0)[0, 1] + np.roll(q, 1)[0] + np.var(c)
    total += np.stack([q[0], 2, p[1]]).sum() + np.hstack([q, 1, p])[2:4].prod() + np.vstack([q, p]).T[1, 0] + np.arange(2) @ q + np.tensordot(q, p, 1) + np.inner(q, q)
    total += abs(q[0]) ** 3 + 2 ** q[1] + q[0] ** p[0] + np.float64(2) * q[0] / 3 - (-q[1]) + 1 / p[0] + np.sqrt(p).sum() + (+q)[0]
    for f in (np.sin, np.cos, np.tan, np.exp, np.log, np.sinh, np.cosh, np.tanh, np.arcsin, np.arccos, np.arctan, np.arcsinh, np.arctanh):
        total += f(q[0])
    for f in (np.cbrt, np.expm1, np.log1p, np.exp2, np.log2, np.log10, np.square, np.reciprocal, np.abs, np.fabs, np.deg2rad, np.sign):
        total += f(q).sum()
    total += np.arctan2(q, p).prod() + np.hypot(q, 2).sum() + np.logaddexp(q[0], 0.0) + np.arccosh(1 + p[0]) + np.power(p, 1.5)[0]
    total += avi.where(q[0] > p[1], q[0], p[1]) + np.where((q < p) & (q > 0), q, p * p).sum() + avi.where(~(q < 1), q, 2.0).sum()
    total += np.maximum(q, 0.35).sum() + avi.minimum(q[0], p[0]) + np.clip(q, -1, 0.35).sum() + (q > 0.35).sum()
    total += (q[::-1] * p).sum() + c[[0, 3]].sum() + c[1:][-1] + sum(e for e in q) + len(q) + q.reshape(2, 1)[1, 0] + np.add.reduce(q)
    rows, others = np.zeros_like(q), np.empty_like(q)
    rows[1] = q[0] * p[1]
    others[:] = rows + q
    total += (others * p).sum()
    return total + rows.sum() + q.shape[0] + q.ndim + c.size


def H_like(f):
    return lambda: avi.solve(f, [0.1, 0.0], [0.0, 1.0], 1.0, 1e-6)


class Tracing(unittest.TestCase):
    point = np.array([0.3, 0.4, 0.5, 0.7])

    def test_value_and_gradient_are_those_of_numpy(self):
        formula = avi.hamiltonian(everything, 2)
        self.assertAlmostEqual(formula.value(self.point), everything(self.point[:2], self.point[2:]), delta=1e-12)
        slopes = formula.gradient(self.point)
        for i, slope in enumerate(slopes):
            step = 1e-5 * np.eye(4)[i]
            by_values = (everything(*np.split(self.point + step, 2)) - everything(*np.split(self.point - step, 2))) / 2e-5
            self.assertAlmostEqual(slope, by_values, delta=1e-6)

    def test_methods_take_the_arguments_of_an_array(self):
        for f in (lambda x: x.clip(min=0.35).sum(), lambda x: x.clip(0.35, max=0.6).prod(), lambda x: x.take([2, 0]) @ x[1:3]):
            self.assertAlmostEqual(avi.objective(f, 4).value(self.point), f(self.point), delta=1e-15)

    def test_an_axis_that_is_not_there_is_no_other_one(self):
        # The masses of bodies with q of the shape (4,): another axis would give another H.
        for f in (
            lambda x: np.sum(x, axis=1),
            lambda x: np.sum(np.sum(x**2, axis=1) / np.array([1.0, 2.0])),
            lambda x: x.mean(axis=-2),
            lambda x: np.max(x, 1),
            lambda x: np.prod(x, axis=1),
            lambda x: np.linalg.norm(x, axis=1),
            lambda x: np.outer(x, x).sum(axis=(0, 2)).sum(),
            lambda x: np.outer(x, x).sum(axis=(0, 0)).sum(),
        ):
            with self.assertRaises(ValueError):
                f(self.point)
            with self.assertRaises(ValueError):
                avi.objective(f, 4)
        self.assertEqual(avi.objective(lambda x: np.sum(x[0], axis=0) + np.sum(x[1], keepdims=True), 4).value(self.point), 0.7)

    def test_true_is_no_place(self):
        f = lambda x: x[True].sum(axis=1)[0] + 10 * x[True].ndim + x[False].sum()
        self.assertEqual(avi.objective(f, 4).value(self.point), f(self.point))
        with self.assertRaises(IndexError):
            avi.objective(lambda x: x[10**30], 4)

    def test_shapes_of_more_numbers_than_can_be_counted_are_refused(self):
        for shape in (2**31, 2**32 + 1, (2**40, 2**40)):  # of which the last bits alone are 0, 1 or 2 numbers
            with self.assertRaisesRegex(ValueError, "less than 1e9"):
                avi.hamiltonian(lambda q, p: q[5] * q[5], shape)

    def test_the_array_may_be_given_by_its_name(self):
        for f in (
            lambda x: np.sum(a=x) + np.prod(a=x) + np.max(a=x) + np.ptp(a=x),
            lambda x: np.mean(a=x, axis=0) + np.clip(a=x, a_min=0.35, a_max=0.6).sum() + np.diff(a=x, n=2)[1],
        ):
            self.assertAlmostEqual(avi.objective(f, 4).value(self.point), f(self.point), delta=1e-15)

    def test_items(self):
        f = lambda x: x.item(2) + 10 * x.reshape(2, 2).item(1, 0) + 100 * x.reshape(2, 2).item((0, -1)) + 1000 * x[:1].item() + x[1].item()
        self.assertEqual(avi.objective(f, 4).value(self.point), f(self.point))
        with self.assertRaisesRegex(ValueError, "size 1"):
            avi.objective(lambda x: x.item(), 4)

    def test_squares_of_norms_have_slopes_at_rest(self):
        for f in (
            lambda x: np.linalg.norm(x) ** 2,
            lambda x: np.sqrt(x @ x) ** 2.0,
            lambda x: np.square(np.linalg.norm(x)),
            lambda x: np.hypot(x[0], x[1]) ** 2 + x[2] ** 2,
            lambda x: (np.linalg.norm(x.reshape(3, 1), axis=1) ** 2).sum(),
        ):
            formula = avi.objective(f, 3)
            for x in (np.zeros(3), np.array([0.3, -0.4, 0.5])):
                self.assertAlmostEqual(formula.value(x), x @ x, delta=1e-15)
                self.assertEqual(formula.gradient(x).tolist(), (2 * x).tolist())
        shifted = avi.objective(lambda x: np.linalg.norm(np.stack([x[0], 2.0])) ** 2, 1)
        self.assertEqual((shifted.value([0.5]), shifted.gradient([0.5]).tolist()), (4.25, [1.0]))
        self.assertTrue(np.isnan(avi.objective(lambda x: np.sqrt(x[0]) ** 2, 1).value([-1.0])))  # as in NumPy
        doubled = avi.objective(lambda x: np.sqrt(functools.reduce(lambda s, _: s + s, range(60), x @ x)) ** 2, 2)
        self.assertAlmostEqual(doubled.value([0.6, 0.8]) / 2**60, 1.0, delta=1e-15)
        of_views = avi.objective(lambda x: (lambda y: (y[:1] ** 2).sum() + y.sum())(x * 1.0), 2)
        self.assertEqual(of_views.value([3.0, 4.0]), 16.0)
        self.assertTrue(avi.solve(lambda q, p: np.linalg.norm(p) ** 2 / 2 + q @ q / 2, [1.0, 0.0], [0.0, 0.0], 1.0, 1e-8).kept)

    def test_what_numpy_does_with_arrays(self):
        x = np.linspace(0.2, 1.1, 12)
        matrix, block = np.arange(16.0).reshape(4, 4), np.ones((2, 3, 4))
        for f in (
            lambda x: np.einsum("ij,j->i", matrix, x[:4]).prod() + np.einsum("i,i", x, x) + np.einsum("ii", x[:9].reshape(3, 3)),
            lambda x: np.einsum("ij,jk->ki", x[:6].reshape(2, 3), x[:6].reshape(3, 2))[1, 0] + np.einsum("ij->j", x.reshape(3, 4))[2],
            lambda x: np.einsum("i,j,ij", x[:4], x[4:8], matrix) + np.einsum("i,j", x[:2], x[2:5])[1, 2],
            lambda x: (block @ x.reshape(4, 3)).prod() + (x[:4] @ matrix).prod() + (x.reshape(3, 4) @ x[:4]).prod() + (x[:3] @ block).prod(),
            lambda x: (np.dot(x.reshape(3, 4), block.swapaxes(1, 2)) * x[:6].reshape(3, 2, 1)).sum() + x.reshape(4, 3).dot(block * matrix[:3])[3, 1, 2],
            lambda x: (lambda room: (np.add.reduce(x.reshape(3, 4), axis=1, out=room), room @ [1, 2, 3])[1])(np.zeros(3, dtype=x.dtype)),
            lambda x: np.sum(x.reshape(3, 4), axis=1, keepdims=True)[2, 0] + x.reshape(3, 4).mean(axis=0, keepdims=True)[0, 1],
            lambda x: np.linalg.norm(x.reshape(3, 4), axis=1, keepdims=True)[1, 0] + np.sum(x, dtype=float) + x.sum(keepdims=True)[0],
            lambda x: np.prod(np.diff(x, prepend=0, append=3)) + np.diff(x.reshape(3, 4), axis=0, prepend=1)[0, 1] + np.diff(x, 2)[3],
            lambda x: np.subtract.outer(x[:3], x[3:9].reshape(2, 3))[1, 1, 2] + x.cumsum()[4] + x.reshape(3, 4).trace() + np.ptp(x) + x.var(),
            lambda x: np.linalg.det(x[:9].reshape(3, 3) + 3 * np.eye(3)) + np.linalg.inv(matrix + np.diag(x[:4]) * 20)[1, 2],
            lambda x: np.linalg.solve(np.outer(x[:4], x[4:8]) + np.eye(4), x[:4])[3] + np.linalg.solve(np.outer(x[:3], x[3:6]) + np.eye(3), np.eye(3))[2, 1],
            lambda x: np.select([x < 0.5, x < 0.8], [x, x * x], 3.0).sum() + np.real(x).sum() + x.real.sum() + x.conj().sum() + x.imag.sum() + sum(x.tolist()) + x[3].item(),
        ):
            formula = avi.objective(f, 12)
            self.assertAlmostEqual(formula.value(x), float(f(x)), delta=1e-12 * (1 + abs(float(f(x)))))
        self.assertEqual(avi.objective(lambda x: np.shape(x)[0] + np.ndim(x) + np.size(x) + x[0], 12).value(x), 25 + x[0])
        filled = lambda x: (lambda room: (room.__setitem__(1, x[0] * x[1]), room.sum())[1])(np.zeros(3, dtype=x.dtype))
        self.assertEqual(avi.objective(filled, 12).value(x), x[0] * x[1])
        avi.objective(lambda x: self.assertIn("traced", f"{x[0]:.3f}") or x[0], 1)

    def test_shapes(self):
        positions, momenta = np.arange(1.0, 7.0).reshape(3, 2), np.ones((3, 2))

        def H(q, p):
            self.assertEqual((q.shape, p.shape), ((3, 2), (3, 2)))
            return np.sum(p**2, axis=(0, 1)) + sum(np.linalg.norm(q[i] - q[j]) for i in range(3) for j in range(i)) + q.sum(axis=1)[2]

        formula = avi.hamiltonian(H, (3, 2))
        self.assertAlmostEqual(formula.value(np.concatenate([positions.ravel(), momenta.ravel()])), H(positions, momenta), delta=1e-13)
        self.assertEqual(avi.solve(lambda q, p: p**2 - np.cos(q), 1.0, 0.0, 1.0, 1e-6).q.shape, (2,))
        self.assertEqual(avi.solve(lambda q, p: p**2 - np.cos(q), [1.0], [0.0], 1.0, 1e-6).q.shape, (1, 2))

    def test_scipys_functions(self):
        try:
            import scipy.special
        except ImportError:
            self.skipTest("SciPy is not there.")
        f = lambda x: scipy.special.erf(x).sum() + scipy.special.expit(x).sum()
        self.assertAlmostEqual(avi.objective(f, 4).value(self.point), f(self.point), delta=1e-15)

    def test_slopes_of_logaddexp_where_both_are_equal(self):
        formula = avi.objective(lambda x: np.logaddexp(x[0], x[1]), 2)
        for x in ([0.0, 0.0], [-0.0, 0.0], [0.0, -0.0], [1.0, 1.0]):
            self.assertEqual(formula.gradient(x).tolist(), [0.5, 0.5])
        self.assertEqual(formula.value([1000.0, 0.0]), 1000.0)

    def test_comparisons_at_equality(self):
        for compare in (np.less, np.less_equal, np.greater, np.greater_equal):
            for of in (compare, lambda a, b: {"less": a < b, "less_equal": a <= b, "greater": a > b, "greater_equal": a >= b}[compare.__name__]):
                formula = avi.objective(lambda x: avi.where(of(x[0], x[1]), 1.0, 0.0) + avi.where(of(1.0, x[1]), 2.0, 0.0), 2)
                for x in ([1.0, 1.0], [1.0, 2.0], [2.0, 1.0], [2.0, 2.0]):
                    self.assertEqual(formula.value(x), compare(x[0], x[1]) + 2.0 * compare(1.0, x[1]))

    def test_rounding_and_remainders(self):
        import math

        numbers = np.array([-3.0, -2.5, -1.75, -0.5, -0.2, 0.0, 0.2, 0.5, 0.49999999999999994, 1.5, 2.5, 3.0, 7.25, 2.0**52 + 1, 1e300])
        for f in (
            np.floor, np.ceil, np.trunc, np.fix, np.rint, np.round, lambda x: x.round(), lambda x: np.around(x, 1), lambda x: x % 2, lambda x: np.mod(x, -1.5),
            lambda x: x // 0.75, lambda x: np.remainder(7.0, x + 0.13), lambda x: 5.5 // (x - 0.3), lambda x: 5.5 % (x - 0.3),
            lambda x: x - np.floor(x / 2) * 2,
        ):  # fmt: skip
            few = numbers if f in (np.floor, np.ceil, np.trunc, np.fix, np.rint, np.round) else numbers[:-2]
            for x in few:
                self.assertAlmostEqual(avi.objective(lambda x: f(x)[0] + 0 * x[0], 1).value([x]), f(x), delta=1e-14)
        for f in (round, math.floor, math.ceil, math.trunc):
            for x in numbers[:-2]:
                self.assertEqual(avi.objective(lambda x: f(x[0]) + x[0], 1).value([x]), f(x) + x)

        def in_place(x):
            x = x * 1.0
            x %= 2.0
            x //= 0.5
            return x.sum()

        self.assertEqual(avi.objective(in_place, 2).value([5.25, -0.25]), in_place(np.array([5.25, -0.25])))
        formula = avi.objective(lambda x: (x % 2.0).sum() * x[0], 2)
        self.assertEqual(formula.gradient([5.25, -0.25]).tolist(), [3.0 + 5.25, 5.25])

    def test_the_step_of_heaviside(self):
        formula = avi.objective(lambda x: np.heaviside(x[0] - x[1], 0.25 * x[1]), 2)
        for x in ([1.0, 1.0], [1.0, 2.0], [2.0, 1.0], [0.0, 0.0]):
            self.assertEqual(formula.value(x), np.heaviside(x[0] - x[1], 0.25 * x[1]))

    def test_means_along_axes(self):
        f = lambda x: np.mean(x, axis=0)[1] + 10 * np.mean(x, axis=(0, 1)) + 100 * x.mean() + np.mean(x, 1)[0]
        x = np.arange(6.0).reshape(2, 3)
        self.assertAlmostEqual(avi.objective(f, (2, 3)).value(x.ravel()), f(x), delta=1e-12)

    def test_arguments_that_count(self):
        class Of:
            def method(self, q, p):
                return q @ p

            def timed(self, q, t, p):
                return q @ p + t

            def __call__(self, q, p, *, a=1.0):
                return q @ p

        for H, size in [
            (lambda q, p, k=1.0: k * (q @ p), 4),
            (lambda q, t, p: q @ p + t, 5),
            (lambda q, t, p, k=1.0: q @ p + t, 5),
            (Of().method, 4),
            (Of().timed, 5),
            (Of(), 4),
            (lambda *z: z[0] @ z[1], 4),
        ]:
            self.assertEqual(avi.hamiltonian(H, 2).size, size)

    def test_parameters_change_without_tracing(self):
        calls = []
        formula = avi.hamiltonian(lambda q, p, c: calls.append(c) or c[0] * (q @ q) + c[1] * (p @ p), 2, [1.0, 2.0])
        self.assertEqual(formula.value(np.ones(4)), 6.0)
        self.assertEqual(formula.with_parameters([3.0, 4.0]).value(np.ones(4)), 14.0)
        self.assertEqual(len(calls), 1)
        with self.assertRaises(ValueError):
            formula.with_parameters([1.0])
        for wrong in (1.0, [[1.0], [2.0]], {"a": 1.0}.items()):
            with self.assertRaisesRegex(TypeError, "a sequence of numbers"):
                avi.hamiltonian(lambda q, p, c: c[0] * (q @ q), 2, wrong)
            with self.assertRaisesRegex(TypeError, "a sequence of numbers"):
                formula.with_parameters(wrong)

    def test_where_of_plain_numbers(self):
        self.assertEqual(avi.where(np.array([1, 2]) > 1, 5, 6).tolist(), [6, 5])

    def test_where_of_plain_conditions_is_that_of_numpy(self):
        for condition in (4 & 6, 0, 0.5, math.nan, True, [2, 0], np.array([0.0, -1.0]), np.array([False, True]), np.array([3, 0], dtype=object)):
            with self.subTest(condition=condition):
                formula = avi.objective(lambda x: avi.where(condition, x, 10.0 * x).sum(), 2)
                self.assertEqual(formula.value([1.0, 2.0]), np.where(condition, [1.0, 2.0], [10.0, 20.0]).sum())

    def test_no_other_type_is_made_of_a_traced_number(self):
        for f in (lambda x: x.astype(int), lambda x: x.astype(bool), lambda x: x.astype(complex), lambda x: np.sum(x, dtype=int), lambda x: x.mean(dtype=int)):
            with self.assertRaisesRegex(TypeError, "stays real"):
                avi.objective(lambda x: f(x).sum(), 2)
        self.assertEqual(avi.objective(lambda x: x.astype(float).sum(dtype=float), 2).value([1.5, 2.0]), 3.5)
        self.assertEqual(avi.maximum(1, 2) + avi.minimum(1, 2), 3)

    def test_what_cannot_be_traced_is_refused(self):
        for f, words in [
            (lambda q, p: p @ p if q[0] > 0 else 0, "avi.where(a < b, x, y)"),
            (lambda q, p: q[0] > 0 and q[1], "`&`"),
            (lambda q, p: max(q[0], q[1]), "avi.maximum"),
            (lambda q, p: sorted(q), "cannot branch"),
            (lambda q, p: 0.5 in q, "cannot"),
            (lambda q, p: float(q[0]), "float(x)"),
            (lambda q, p: math.sin(q[0]), "np.sin(x)"),
            (lambda q, p: range(q[0]), "int(x)"),
            (lambda q, p: np.zeros(2).__setitem__(0, q[0]), "np.stack([x, y])"),
            (lambda q, p: q.__setitem__(0, 1.0), "np.stack([x, y])"),
            (lambda q, p: np.where(q > 0)[0], "avi.where(condition, x, y)"),
            (lambda q, p: avi.where(q[0], 1, 2), "a comparison"),
            (lambda q, p: avi.where((q[0] > 0) & q[1], 1, 2), "comparisons"),
            (lambda q, p: q[0] == 1, "=="),
            (lambda q, p: np.equal(q, 1.0), "=="),
            (lambda q, p: np.modf(q[0]), "np.modf"),
            (lambda q, p: np.linalg.inv(np.array([[q[0], 0.0], [0.0, p[0]]]))[0, 0], "np.stack([a, b])"),
            (lambda q, p: np.linalg.svd(np.outer(q, p))[1][0], "np.linalg.svd"),
            (lambda q, p: np.einsum("i...,i", q, p), "one letter for each axis"),
            (lambda q, p, t: p @ p + t, "q, t, p, in this order"),
            (lambda t, q, p: p @ p + t, "q, t, p, in this order"),
            (lambda t, y: y[0], "t, y; they are q, p, or q, t, p"),
            (lambda q, p: np.ones(2).__iadd__(q), "a = a + b"),
            (lambda q, p: 1j * q[0], "complex"),
            (lambda q, p: "a" + q[0], "str"),
            (lambda q, p: None, "`return`"),
            (lambda q, p: p, "(2,)"),
            (lambda q, p: "a", "str"),
        ]:
            with self.assertRaises(TypeError) as caught:
                H_like(f)()
            self.assertIn(words, str(caught.exception))

    def test_wrong_shapes_and_indices(self):
        for f, error in [
            (lambda q, p: q[2], IndexError),
            (lambda q, p: (q * np.zeros(3)).sum(), ValueError),
            (lambda q, p: q @ np.zeros(3), ValueError),
            (lambda q, p: np.linalg.inv(np.stack([q, p, q])).sum(), ValueError),
        ]:
            with self.assertRaises(error):
                H_like(f)()

    def test_own_exceptions_pass(self):
        with self.assertRaises(ZeroDivisionError):
            H_like(lambda q, p: 1 / 0)()

    def test_numbers_kept_from_another_call(self):
        kept = []
        avi.hamiltonian(lambda q, p: kept.append(q) or q @ p, 2)
        with self.assertRaisesRegex(ValueError, "^[Hf] mixes.*must not keep numbers.*an attribute.$"):
            avi.hamiltonian(lambda q, p: q @ kept[0], 2)


if __name__ == "__main__":
    unittest.main()
