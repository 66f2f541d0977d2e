"""The programs in lib/python/examples run and draw their pictures; that of a thousand starts with fifty."""

import contextlib
import importlib.util
import io
import os
import tempfile
import unittest
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).resolve().parents[1] / "examples"


@unittest.skipUnless(importlib.util.find_spec("scipy") and importlib.util.find_spec("matplotlib"), "SciPy or matplotlib is not there.")
class Examples(unittest.TestCase):
    def run_example(self, name):
        printed = io.StringIO()
        program = compile((FOLDER / f"{name}.py").read_text().replace("1000", "50"), name, "exec")
        home = os.getcwd()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(printed):
            os.chdir(folder)
            try:
                names = {}
                exec(program, names)
                self.assertGreater(Path(f"{name}.png").stat().st_size, 10000)
            finally:
                os.chdir(home)
        return names, printed.getvalue()

    def test_eccentric_orbit(self):
        names, _ = self.run_example("eccentric_orbit")
        ours, theirs = names["ours"], names["theirs"]
        self.assertTrue(ours.kept)
        self.assertLess(abs(ours.q[:, -1] - [0.1, 0]).max(), 1e-9)
        self.assertGreater(abs(theirs.y[:2, -1] - [0.1, 0]).max(), 1e-7)

    def test_poincare_section(self):
        names, printed = self.run_example("poincare_section")
        self.assertIn("50 orbits", printed)
        for points in names["points"]:
            self.assertLess(abs(points[:, 0]).max(), 1e-9)
            self.assertGreater(points[:, 2].min(), 0)

    def test_three_bodies(self):
        from scipy.integrate import solve_ivp

        names, _ = self.run_example("three_bodies")
        masses = names["masses"]

        def slopes(t, y):
            q, v = y.reshape(2, 3, 2)
            apart = q[None] - q[:, None]
            return np.ravel([v, np.einsum("j,ijk", masses, apart * (np.sum(apart**2, axis=2) + np.eye(3))[..., None] ** -1.5)])

        def approach(t, y):
            q, v = y.reshape(2, 3, 2)
            return (q[1] - q[2]) @ (v[1] - v[2])

        approach.direction = 1
        start = np.ravel([names["q"], names["p"]])
        expected = solve_ivp(slopes, (0, 10), start, "DOP853", rtol=1e-12, atol=1e-12, events=approach)
        self.assertLess(np.abs(names["orbit"].t_events[2] - expected.t_events[0]).max(), 1e-6)
        self.assertEqual([len(times) for times in names["orbit"].t_events], [5, 4, 3])

    def test_logistic_regression(self):
        names, _ = self.run_example("logistic_regression")
        self.assertLess(names["ours"].fun, names["theirs"].fun + 1e-9)


if __name__ == "__main__":
    unittest.main()
