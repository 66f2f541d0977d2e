"""Python's results are those of C++ to the last bit, where the formula does the same operations in the same order (that of operands
of one sum is left to a compiler of C++, hence `+=` here and there)."""

import os
import subprocess
import unittest

import numpy as np

import avi


def in_cpp():
    """The numbers that a program of C++ prints, by the name of their problem."""
    found = {}
    lines = subprocess.run([os.environ["AVI_BIN_DIR"] + "/same_digits"], check=True, capture_output=True, text=True).stdout
    for line in lines.splitlines():
        name, *numbers = line.split()
        found.setdefault(name, []).extend(float.fromhex(x) for x in numbers)
    return found


class Digits(unittest.TestCase):
    cpp = in_cpp()

    def same(self, name, *numbers):
        self.assertEqual(self.cpp[name], list(np.concatenate([np.atleast_1d(x) for x in numbers])))

    def orbit(self, name, H, q, p, t, tol):
        found = avi.solve(H, q, p, t, tol)
        self.same(name, found.q[:, -1], found.p[:, -1], found.t[-1], found.state_error, found.energy_error)

    def test_kepler(self):
        self.orbit("kepler", lambda q, p: (p @ p) * 0.5 - (q @ q) ** -0.5, [0.1, 0], [0, np.sqrt(19.0)], 62.0, 1e-10)

    def test_henon_heiles(self):
        def H(q, p):
            x, y = q
            squares = p[0] * p[0]
            for z in (p[1], x, y):
                squares += z * z
            energy = 0.5 * squares
            energy += x * x * y
            return energy - y**3 / 3.0

        self.orbit("henon_heiles", H, [0, 0.1], [0.5, 0], 30.0, 1e-8)

    def test_pendulum(self):
        self.orbit("pendulum", lambda q, p: 0.5 * p[0] * p[0] - np.cos(q[0]), [1.0], [0.0], 20.0, 1e-9)

    def test_rosenbrock(self):
        def f(x):
            return sum(100.0 * (x[i + 1] - x[i] * x[i]) * (x[i + 1] - x[i] * x[i]) + (1.0 - x[i]) * (1.0 - x[i]) for i in range(3))

        found = avi.minimise(f, [-1, 1, -1, 1])
        self.same("rosenbrock", found.x, found.fun, found.njev)


if __name__ == "__main__":
    unittest.main()
