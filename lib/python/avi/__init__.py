"""Orbits of Hamiltonian systems with adaptive steps and a symplectic method, and minima of functions.

import avi

kepler = lambda q, p: (p @ p) / 2 - 1 / (q @ q) ** 0.5
orbit = avi.solve(kepler, q=[0.1, 0], p=[0, 19**0.5], t=62.8, tol=1e-10)

A function is called once, with numbers that record what is done to them; from there on all of it runs in the library.
"""

try:
    from ._avi import Formula, Traced, __version__, massless
except ModuleNotFoundError as error:
    if error.name != "avi._avi":
        raise
    import pathlib
    import sys

    _found = ", ".join(sorted(x.name for x in pathlib.Path(__file__).parent.glob("_avi.*.so"))) or "nothing"
    raise ImportError(
        f"The compiled part of avi is not there for this interpreter, {sys.executable}, which looks for "
        f"_avi.{sys.implementation.cache_tag}-*.so; there is {_found}. Run the interpreter that it was made for, "
        "or have pip make it for this one: pip install ./lib/python in a checkout."
    ) from None

from . import plot
from ._formula import hamiltonian
from ._minimise import Minimum, minimise, objective
from ._orbits import Event, Orbit, Solver, ensemble, event, resume, solve
from ._tracing import functions, maximum, minimum, where

__all__ = [
    "Event", "Formula", "Minimum", "Orbit", "Solver", "Traced", "ensemble", "event", "functions", "hamiltonian", "massless", "maximum", "minimise", "minimum", "objective",
    "plot", "resume", "solve", "where",
]  # fmt: skip
