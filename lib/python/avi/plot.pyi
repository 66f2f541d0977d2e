from collections.abc import Callable, Sequence
from typing import Any

from numpy.typing import ArrayLike

from . import Formula, Minimum, Orbit

Axes = Any  # matplotlib.axes.Axes

def orbit(found: Orbit, *, i: int = ..., j: int = ..., ax: Axes = ..., **style: Any) -> Axes: ...
def energy_error(found: Orbit, *, ax: Axes = ..., **style: Any) -> Axes: ...
def step_size(found: Orbit, *, ax: Axes = ..., **style: Any) -> Axes: ...
def work_precision(
    H: Callable[..., Any] | Formula,
    q: ArrayLike,
    p: ArrayLike,
    t: ArrayLike,
    *,
    tols: Sequence[float] | None = ...,
    slopes: Callable[..., Any] | None = ...,
    ax: Axes = ...,
    **style: Any,
) -> Axes: ...
def convergence(found: Minimum, *, least: float | None = ..., ax: Axes = ..., **style: Any) -> Axes: ...
