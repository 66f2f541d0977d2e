"""The programs of the page "From Python" run and print what their comments say; the page shows what there is."""

import contextlib
import io
import re
import unittest
from pathlib import Path

import avi

PAGE = Path(__file__).resolve().parents[2] / "docs/python.md"


class Docs(unittest.TestCase):
    text = PAGE.read_text()

    def test_programs(self):
        names, printed = {}, io.StringIO()
        with contextlib.redirect_stdout(printed):
            for program in re.findall(r"```python\n(.*?)```", self.text, re.S):
                exec(program, names)
        said = re.findall(r"^ *print\(.*\) +# ([^:\n]+)", self.text, re.M)
        self.assertEqual(len(said), self.text.count("print(") - self.text.count("`print("))
        self.assertEqual(printed.getvalue().splitlines(), [line for each in said for line in each.split(", then ")])

    def test_front_pages(self):
        """README and the front page of the site show the first program of the page."""
        first = re.search(r"```python\n.*?```", self.text, re.S)[0]
        for front in (PAGE.parents[2] / "README.md", PAGE.parent / "README.md"):
            self.assertIn(first, front.read_text(), front)

    def test_mass_of_a_test_particle(self):
        header = (PAGE.parents[1] / "avi/solve.hpp").read_text()
        self.assertEqual(avi.massless, float.fromhex(re.search(r"double massless = (\S+);", header)[1]))

    def test_files(self):
        for link in re.findall(r"\]\(([^)#]+)\)", self.text):
            self.assertTrue((PAGE.parent / link).exists(), link)

    def test_names(self):
        for name in re.findall(r"`avi\.([a-z_.]+)", self.text):
            self.assertTrue(eval(f"avi.{name.rstrip('.')}"), name)


if __name__ == "__main__":
    unittest.main()
