"""The programs of the page "From Python" run and print what their comments say; the page shows what there is."""

import contextlib
import io
import re
import unittest
from pathlib import Path

import numpy as np

import avi

PAGE = Path(__file__).resolve().parents[2] / "docs/python.md"


class Docs(unittest.TestCase):
    text = PAGE.read_text()

    def test_programs(self):
        names, printed = {}, io.StringIO()
        with contextlib.redirect_stdout(printed):
            for program in re.findall(r"```python\n(.*?)```", self.text, re.S):
                exec(program, names)
        lines = printed.getvalue().splitlines()
        self.assertEqual(lines[0].split()[:2], ["True", "True"])
        self.assertEqual(lines[1], "(2, 401) (4, 401)")
        self.assertEqual(lines[2], "[1. 3. 5.]")
        self.assertLess(np.abs(names["at_pi"][:2] - [-1.9, 0]).max(), 1e-9)
        self.assertEqual(lines[3:5], ["-1.0", "1.0"])
        self.assertEqual(lines[5:], ["200 True", "1", "True True"])

    def test_front_pages(self):
        """README and the front page of the site show the first program of the page."""
        first = re.search(r"```python\n.*?```", self.text, re.S)[0]
        for front in (PAGE.parents[2] / "README.md", PAGE.parent / "README.md"):
            self.assertIn(first, front.read_text(), front)

    def test_mass_of_a_test_particle(self):
        header = (PAGE.parents[1] / "avi/solve.hpp").read_text()
        massless = float.fromhex(re.search(r"double massless = (\S+);", header)[1])
        self.assertEqual(eval(re.search(r"A test particle has the mass `([^`]+)`", self.text)[1]), massless)

    def test_files(self):
        for link in re.findall(r"\]\(([^)#]+)\)", self.text):
            self.assertTrue((PAGE.parent / link).exists(), link)

    def test_names(self):
        for name in re.findall(r"`avi\.([a-z_.]+)", self.text):
            self.assertTrue(eval(f"avi.{name.rstrip('.')}"), name)


if __name__ == "__main__":
    unittest.main()
