"""What changes an array in its place: the views of a traced array change with it, or the function is refused; never is a change lost."""

import copy
import operator
import unittest

import numpy as np

import avi

X = np.linspace(0.3, 1.4, 12)
WEIGHTS = np.arange(1.0, 13.0)


def through_a_view(make):
    """d changes through what `make` makes of it."""

    def f(x):
        d = x * 1.0
        view = make(d)
        view *= 3.0
        return np.sum(WEIGHTS.reshape(d.shape) * d) + np.sum(view)

    return f


def of_the_whole(make):
    """What `make` makes of d changes with it."""

    def f(x):
        d = x * 1.0
        view = make(d)
        d += x[::-1]
        d **= 2
        return np.sum(np.ravel(view) * WEIGHTS[: np.size(view)])

    return f


class InPlace(unittest.TestCase):
    def same(self, f, x=X):
        value, formula = f(x.copy()), avi.objective(f, x.shape)
        self.assertAlmostEqual(formula.value(x), float(value), delta=1e-12 * abs(value))

    def test_views(self):
        for make in (
            lambda d: d,
            lambda d: d[1:],
            lambda d: d[...],
            lambda d: d[::-2][1:],
            lambda d: d.reshape(3, 4)[1],
            lambda d: d.reshape(3, 4).T[2:, 1],
            lambda d: d.reshape(3, 4)[..., None][:, 1],
            lambda d: d.reshape(2, 2, 3)[1][0],
            lambda d: next(iter(d.reshape(3, 4))),
            lambda d: d.reshape(3, 4)[1, 2, ...],
            lambda d: np.ravel(d)[3:],
            lambda d: np.transpose(d.reshape(3, 4)).swapaxes(0, 1),
            lambda d: np.flip(d)[2:4],
            lambda d: np.expand_dims(d, 1).squeeze()[:5],
            lambda d: np.moveaxis(d.reshape(3, 4), 0, 1)[2],
            lambda d: np.atleast_2d(d)[0, 4:6],
            lambda d: np.split(d, 3)[1],
            lambda d: np.array_split(d, 5)[4],
            lambda d: np.rot90(d.reshape(3, 4))[1],
            lambda d: np.einsum("ij->ji", d.reshape(3, 4))[1],
            lambda d: np.einsum("ii->i", d[:9].reshape(3, 3)),
            lambda d: d.real[2:],
            lambda d: d.astype(d.dtype, copy=False),
            # copies
            lambda d: d[[1, 2, 5]],
            lambda d: d[np.arange(12) > 4],
            lambda d: d.copy(),
            lambda d: copy.copy(d),
            lambda d: copy.deepcopy(d),
            lambda d: np.copy(d),
            lambda d: d.astype(d.dtype),
            lambda d: d.flatten()[2:],
            lambda d: np.roll(d, 2),
            lambda d: d.repeat(1),
            lambda d: np.stack([d[0], d[3]]),
            lambda d: np.concatenate([d[:2], d[3:]]),
            lambda d: +d,
            lambda d: d[2],
        ):
            self.same(through_a_view(make))
            self.same(of_the_whole(make))

    def test_alias(self):
        def f(x):
            y = x**2
            z = y
            z *= 2
            z /= 3
            z -= 1
            return np.sum(y)

        self.same(f)

    def test_views_of_a_matrix(self):
        def f(x):
            rows = x.reshape(3, 4) * 1
            for row in rows:
                row *= row[0]
            first, second, _ = rows
            second += first
            number = rows[2, 1]
            number *= 100  # another number, as in NumPy
            return np.sum(rows * WEIGHTS.reshape(3, 4))

        self.same(f)

    def test_ravel_is_a_copy_of_what_does_not_lie_side_by_side(self):
        for make in (
            lambda d: d[::2].ravel(),
            lambda d: d[::-1].ravel(),
            lambda d: np.ravel(d[1::3])[1:],
            lambda d: d.reshape(3, 4)[:, 1].ravel(),
            lambda d: d.reshape(3, 4)[:, :1].ravel(),
            lambda d: d[:9].reshape(3, 3).diagonal().ravel(),
            # views
            lambda d: d[3:].ravel(),
            lambda d: d[4:5].ravel(),
            lambda d: d.reshape(3, 4)[1:].ravel()[2:],
            lambda d: d.reshape(3, 4)[1:, 2].reshape(-1),
            lambda d: d[::2].reshape(2, 3)[1],
        ):
            self.same(through_a_view(make))
            self.same(of_the_whole(make))

    def test_an_array_of_a_number_does_not_change_with_it(self):
        for array in (
            lambda a: a[None],
            lambda a: a[..., None],
            lambda a: a.reshape(1),
            lambda a: np.atleast_1d(a),
            lambda a: np.expand_dims(a, 0),
            lambda a: np.broadcast_to(a, (3,)),
            lambda a: np.broadcast_arrays(a, np.ones(3))[0],
        ):
            for number in (lambda x: x[1], lambda x: x @ x, lambda x: np.sum(x), lambda x: x.reshape(3, 4)[1, 2]):

                def f(x):
                    a = number(x)
                    b = array(a)
                    a += 1.0
                    a *= 3.0
                    return a + 10.0 * np.sum(b)

                def changed(x):
                    b = array(number(x)) * 1.0
                    whole = b[...]
                    whole *= 3.0
                    return np.sum(b)

                self.same(f)
                self.same(changed)

    def test_conditions(self):
        def f(x):
            c = x > 0.5
            d = c
            d &= x < 1.2
            return np.sum(avi.where(c, x, 0.0))

        self.same(f)

    def test_programs_drawn_at_random(self):
        """Of arrays, their views and views of these, assigned to in any order."""
        makers = [
            lambda a: a[1:],
            lambda a: a[::-1],
            lambda a: a[..., 0],
            lambda a: a[0],
            lambda a: a.T,
            lambda a: a[None],
            lambda a: a.reshape(-1),
            lambda a: np.flip(a),
            lambda a: np.split(a, [1])[-1],
            lambda a: a,
            lambda a: a * 0.5,
            lambda a: a.copy(),
            lambda a: np.stack([a, a]),
            lambda a: a[[0]],
            lambda a: np.diff(a, prepend=0.1),
        ]
        changes = [operator.iadd, operator.isub, operator.imul, operator.itruediv]

        def program(seed, x):
            random = np.random.default_rng(seed)
            arrays = [x.reshape(3, 4) * 1.0]
            for _ in range(25):
                chosen = arrays[random.integers(len(arrays))]
                if random.random() < 0.5 and np.size(chosen) > 1 and len(chosen):
                    arrays.append(makers[random.integers(len(makers))](chosen))
                else:
                    number, other = random.uniform(0.5, 1.5), arrays[random.integers(len(arrays))]
                    alike = np.shape(other) == np.shape(chosen)
                    changed = changes[random.integers(4)](chosen, number * (np.tanh(other) + 1.2 if alike else 1.0))
                    if np.shape(chosen):
                        assert changed is chosen
            return sum(np.sum(np.sin((k + 1) * a)) for k, a in enumerate(arrays))

        refused = 0
        for seed in range(500):
            with self.subTest(seed):
                try:
                    formula = avi.objective(lambda x: program(seed, x), 12)
                except TypeError as error:  # NumPy decides by the layout of its memory what is a view
                    self.assertIn("a reshape() that may be a copy", str(error))
                    refused += 1
                else:
                    value = program(seed, X)
                    self.assertAlmostEqual(formula.value(X), value, delta=1e-6 * (1 + abs(value)))
        self.assertLess(refused, 100)

    def test_arrays_of_objects(self):
        def f(x):
            rows = np.zeros_like(x)
            rows += x
            rows[1] *= rows[2]
            part = rows[3:5]
            part *= 2
            return np.sum(np.exp(rows)) + np.sum(np.sqrt(np.zeros_like(x) + 1)) + np.sum(np.cos(np.zeros_like(x)))

        self.same(f)

    def test_refused(self):
        def after(change):
            def f(x):
                y = x * 1
                change(y)
                return y[0]

            return f

        def multiplied(make):
            def change(y):
                view = make(y)
                view *= 2

            return change

        def multiplied_later(make):
            def change(y):
                self.kept = make(y)
                y *= 2

            return change

        def add(y):
            y += np.ones((2, 12))

        for change, words in [
            (lambda y: np.fill_diagonal(y.reshape(3, 4), 0.0), r"np.fill_diagonal cannot be traced.*np.eye"),
            (lambda y: np.put(y, [0], 1.0), "np.put cannot.*avi.where"),
            (lambda y: np.copyto(y, 1.0), "np.copyto cannot.*avi.where"),
            (lambda y: np.putmask(y, np.arange(12) > 3, 0.0), "np.putmask cannot.*avi.where"),
            (lambda y: np.place(y, np.arange(12) > 3, [0.0]), "np.place cannot.*avi.where"),
            (lambda y: np.put_along_axis(y, np.array([0]), 1.0, 0), "np.put_along_axis cannot.*avi.where"),
            (lambda y: np.add.at(y, [0], 1.0), "np.add.at"),
            (lambda y: np.asarray(y).__setitem__(0, 3.0), "read-only.*would be lost.*avi.where"),
            (multiplied(np.asarray), "read-only.*would be lost.*avi.where"),
            (multiplied(lambda y: np.broadcast_to(y, (2, 12))), "write a = a \\+ b"),
            (multiplied_later(np.asarray), "np.asarray"),
            (multiplied_later(lambda y: np.broadcast_arrays(y, np.ones((2, 12)))), "np.asarray"),
            (add, r"\(12,\) cannot hold one of the shape \(2, 12\)"),
            (lambda y: (y > 0).__iadd__(1), "comparisons"),
            (lambda y: y.__setitem__(0, 1.0), "np.stack"),
        ]:
            with self.assertRaisesRegex((TypeError, ValueError), words):
                avi.objective(after(change), 12)


if __name__ == "__main__":
    unittest.main()
