"""The package as a whole: its stubs name what there is, import is quick and needs no NumPy, every picture can be drawn."""

import ast
import inspect
import shutil
import subprocess
import sys
import tempfile
import unittest
from operator import attrgetter
from pathlib import Path
from time import perf_counter

import numpy as np

import avi


def stub(module):
    """Public names of a stub: of functions their arguments, of classes their members; those of Solver as functions, too."""
    names = {}
    body = ast.parse(Path(module.__file__).with_suffix(".pyi").read_text()).body
    solver = next((node.body for node in body if getattr(node, "name", None) == "Solver"), [])
    for node in body + [x for x in solver if not getattr(x, "decorator_list", True)]:
        if isinstance(node, ast.FunctionDef):
            name = ("Solver." if node in solver else "") + node.name
            names[name] = [x.arg for x in node.args.args], {x.arg for x in node.args.kwonlyargs}
        elif isinstance(node, ast.ClassDef):
            members = {getattr(x, "name", None) or getattr(getattr(x, "target", None), "id", None) for x in node.body}
            names[node.name] = members - {None, "__getattr__"}
    return names


class Package(unittest.TestCase):
    def test_stubs_name_what_there_is(self):
        known = stub(avi)
        self.assertEqual(set(avi.__all__) - {"massless", "plot"}, {name for name in known if "." not in name and name[0] != "_"})
        orbit = avi.solve(lambda q, p: p**2 / 2 - np.cos(q), 1.0, 0.0, 1.0, 1e-6, dense=True)
        for one, name in ((orbit.sol, "_Between"), (orbit.choice, "_Choice"), (orbit.choice.trials[0], "_Trial")):
            self.assertEqual([member for member in known[name] if not hasattr(one, member)], [])
        least = avi.minimise(lambda x: x**2, 1.0)
        solver = avi.Solver(lambda q, p: p**2 / 2 - np.cos(q), 1.0, 0.0, 1.0, 1e-6)
        for one in (orbit, least, solver, avi.hamiltonian(lambda q, p: q * p, ()), avi.event(abs), avi.Traced):
            name = one.__name__ if inspect.isclass(one) else type(one).__name__
            for member in known[name]:
                self.assertTrue(hasattr(one, member), f"{name}.{member}")
        options = {name: avi._orbits._OPTIONS for name in ("solve", "Solver.__init__")} | {"ensemble": avi._orbits._OPTIONS[:-2]} | {"minimise": avi._minimise._OPTIONS}
        for module, names in ((avi, known), (avi.plot, stub(avi.plot))):
            for name, arguments in names.items():
                function = attrgetter(name)(module) if isinstance(arguments, tuple) else None
                if inspect.isfunction(function):
                    has = inspect.signature(function).parameters.values()
                    by_place = [x.name for x in has if x.kind is x.POSITIONAL_OR_KEYWORD]
                    by_name = {x.name for x in has if x.kind is x.KEYWORD_ONLY} | set(options.get(name, ()))
                    self.assertEqual(arguments, (by_place, by_name), name)

    def test_every_name_has_a_docstring(self):
        for module in (avi, avi.plot):
            for name in module.__all__:
                self.assertTrue(inspect.getdoc(getattr(module, name)), name)

    def test_docstrings_name_what_there_is(self):
        """Every public attribute of what a call returns stands in its docstring, whatever completion shows."""
        orbit = avi.solve(lambda q, p: p**2 / 2 - np.cos(q), 1.0, 0.0, 1.0, 1e-6)
        for one in (orbit, orbit.choice, avi.minimise(lambda x: x**2, 1.0)):
            for name in dir(one):
                if name[0] != "_":
                    self.assertRegex(inspect.getdoc(one), rf"\b{name}\b")

    def test_import_needs_no_numpy(self):
        subprocess.run([sys.executable, "-c", "import sys, avi; assert 'numpy' not in sys.modules"], check=True)

    def test_another_interpreter_is_told_so(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / "avi"
            copy.mkdir()
            for file in Path(avi.__file__).parent.glob("*.py"):
                shutil.copy(file, copy)
            (copy / "_avi.cpython-30-x86_64-linux-gnu.so").touch()
            program = f"import sys; sys.path.insert(0, {folder!r}); import avi"
            run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
        said = run.stderr.splitlines()[-1]
        self.assertIn(f"not there for this interpreter, {sys.executable}", said)
        self.assertIn("there is _avi.cpython-30-x86_64-linux-gnu.so", said)
        self.assertIn("pip install ./lib/python", said)

    def test_first_call_is_quick(self):
        program = """
from time import perf_counter
begun = perf_counter()
import avi
imported = perf_counter()
avi.solve(lambda q, p: (p @ p) / 2 - 1 / (q @ q)**.5, [0.1, 0.0], [0.0, 4.35889894], 62.8, 1e-9)
print(imported - begun, perf_counter() - begun)
"""
        times = [[float(x) for x in subprocess.check_output([sys.executable, "-c", program]).split()] for _ in range(5)]
        imported, answered = np.min(times, axis=0)
        self.assertLess(imported, 0.1)
        self.assertLess(answered, 0.3)

    def test_costs_a_twentieth_of_dop853(self):
        """A hundred periods of an eccentric orbit, of which DOP853 never has the digits."""
        try:
            from scipy.integrate import solve_ivp
        except ImportError:
            self.skipTest("SciPy is not there.")
        q, p, t = [0.1, 0.0], [0.0, np.sqrt(19.0)], 200 * np.pi

        def slopes(t, y):
            x, z, u, v = y.tolist()
            cube = (x * x + z * z) ** -1.5
            return [u, v, -x * cube, -z * cube]

        def ours():
            return avi.solve(lambda q, p: p @ p / 2 - 1 / np.sqrt(q @ q), q, p, t, 1e-9).y[:, -1]

        def theirs():
            return solve_ivp(slopes, (0, t), q + p, "DOP853", rtol=1e-13, atol=1e-13).y[:, -1]

        def measured(call, times):
            least = np.inf
            for _ in range(times):
                begun = perf_counter()
                end = call()
                least = min(least, perf_counter() - begun)
            return least, np.abs(end - np.array(q + p)).max()

        here, error = measured(ours, 10)
        there, their_error = measured(theirs, 1)
        self.assertLess(error, 2e-9)
        self.assertGreater(their_error, error)
        self.assertLess(here, there / 20)

    def test_pictures(self):
        try:
            import matplotlib

            matplotlib.use("Agg")
            from matplotlib.axes import Axes
        except ImportError:
            self.skipTest("matplotlib is not there.")
        kepler = lambda q, p: (p @ p) / 2 - 1 / np.sqrt(q @ q)
        start = [0.5, 0.0], [0.0, np.sqrt(3.0)]
        orbit = avi.solve(kepler, *start, np.linspace(0, 20, 101), 1e-9, dense=True)
        least = avi.minimise(lambda x: x @ x, [1.0, 2.0], history=True)
        for axes, points in [
            (avi.plot.orbit(orbit), 10 * orbit.nsteps),
            (avi.plot.orbit(avi.solve(kepler, *start, np.linspace(0, 20, 101), 1e-9)), 101),
            (avi.plot.energy_error(orbit), 100),
            (avi.plot.step_size(orbit), orbit.nsteps),
            (avi.plot.work_precision(kepler, *start, 10.0), 9),
            (avi.plot.convergence(least), least.nit + 1),
        ]:
            self.assertIsInstance(axes, Axes)
            self.assertTrue(axes.get_xlabel())
            self.assertEqual(len(axes.lines[0].get_xdata()), points)
        self.assertIs(avi.plot.orbit(orbit, ax=axes, color="red"), axes)
        self.assertEqual(avi.plot.orbit(orbit, lw=3).lines[0].get_linewidth(), 3)
        for draw in (avi.plot.energy_error, avi.plot.step_size):
            self.assertEqual(draw(orbit, marker="x").lines[0].get_marker(), "x")
        self.assertEqual(avi.plot.work_precision(kepler, *start, 10.0, tols=[1e-4, 1e-6], marker="x").lines[0].get_marker(), "x")
        for q, p in ((1.0, 0.0), ([1.0], [0.0])):  # a single degree of freedom is drawn with its momentum
            swing = avi.solve(lambda q, p: np.sum(p**2) / 2 - np.sum(np.cos(q)), q, p, np.linspace(0, 10, 11), 1e-8)
            axes = avi.plot.orbit(swing)
            self.assertEqual(axes.lines[0].get_ydata().tolist(), swing.y[1].tolist())
            self.assertEqual(axes.get_ylabel(), "$p$")
        with self.assertRaisesRegex(ValueError, "history=True"):
            avi.plot.convergence(avi.minimise(lambda x: x @ x, [1.0]))
        with self.assertRaisesRegex(ValueError, "nothing to draw. The run ended as non_finite"):
            avi.plot.convergence(avi.minimise(lambda x: x @ np.log(x - 2.0), [1.0], history=True))


if __name__ == "__main__":
    unittest.main()
