from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, Protocol, SupportsIndex, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import plot as plot

__version__: str
massless: float  # the mass of a test particle
Floats = NDArray[np.float64]
Events = Event | Callable[..., Any] | Formula | Sequence[Event | Callable[..., Any] | Formula] | None
Monitor = str | Callable[..., Any] | Formula  # a name, or g(q, p) or g(q, t, p)

class Traced:
    """Numbers of a function that is being traced, in the shape of an array."""

    @property
    def shape(self) -> tuple[int, ...]: ...
    @property
    def size(self) -> int: ...
    @property
    def ndim(self) -> int: ...
    @property
    def T(self) -> Traced: ...
    def __len__(self) -> int: ...
    def __getitem__(self, key: Any) -> Traced: ...
    def __add__(self, other: Any) -> Traced: ...
    def __radd__(self, other: Any) -> Traced: ...
    def __sub__(self, other: Any) -> Traced: ...
    def __rsub__(self, other: Any) -> Traced: ...
    def __mul__(self, other: Any) -> Traced: ...
    def __rmul__(self, other: Any) -> Traced: ...
    def __truediv__(self, other: Any) -> Traced: ...
    def __rtruediv__(self, other: Any) -> Traced: ...
    def __mod__(self, other: Any) -> Traced: ...
    def __rmod__(self, other: Any) -> Traced: ...
    def __floordiv__(self, other: Any) -> Traced: ...
    def __rfloordiv__(self, other: Any) -> Traced: ...
    def __round__(self, decimals: int = 0) -> Traced: ...
    def __pow__(self, other: Any) -> Traced: ...
    def __rpow__(self, other: Any) -> Traced: ...
    def __matmul__(self, other: Any) -> Traced: ...
    def __rmatmul__(self, other: Any) -> Traced: ...
    def __neg__(self) -> Traced: ...
    def __pos__(self) -> Traced: ...
    def __abs__(self) -> Traced: ...
    def __lt__(self, other: Any) -> Traced: ...
    def __le__(self, other: Any) -> Traced: ...
    def __gt__(self, other: Any) -> Traced: ...
    def __ge__(self, other: Any) -> Traced: ...
    def __and__(self, other: Any) -> Traced: ...
    def __or__(self, other: Any) -> Traced: ...
    def __invert__(self) -> Traced: ...
    def __getattr__(self, name: str) -> Any: ...

class Formula:
    """A function of Python that was called once; it serves solve() or minimise() in its place."""

    @property
    def size(self) -> int: ...
    @property
    def parameters(self) -> list[float]: ...
    def with_parameters(self, parameters: Sequence[float]) -> Formula: ...
    def value(self, x: ArrayLike) -> float: ...
    def gradient(self, x: ArrayLike) -> Floats: ...

class _Trial(Protocol):
    """A run by which the method was chosen."""

    monitor: str
    order: int
    h: float
    time: float
    steps: int
    sweeps: int
    state_error: float
    outcome: Any

class _Choice(Protocol):
    """Monitor, order and step of an orbit, and the trials that led to them."""

    monitor: str
    order: int
    h: float
    energy_scale: float
    time: float
    sweeps: int
    trials: Sequence[_Trial]

class _Between(Protocol):
    """The orbit at any time; the ends of its steps."""

    times: Floats
    def __call__(self, t: ArrayLike) -> Floats: ...

class Orbit:
    """An orbit of H, under the names of scipy.integrate.solve_ivp where they mean the same."""

    t: Floats
    y: Floats
    q: Floats
    p: Floats
    sol: _Between | None
    t_events: list[Floats]
    y_events: list[Floats]
    @property
    def success(self) -> bool: ...
    @property
    def kept(self) -> bool: ...
    @property
    def status(self) -> int: ...
    @property
    def outcome(self) -> str: ...
    @property
    def message(self) -> str: ...
    @property
    def nfev(self) -> int: ...
    @property
    def nsteps(self) -> int: ...
    @property
    def choice(self) -> _Choice: ...
    @property
    def tolerance(self) -> float: ...
    @property
    def state_error(self) -> float: ...
    @property
    def energy_error(self) -> float: ...
    @property
    def note(self) -> str: ...
    @property
    def energy(self) -> Floats: ...

class Minimum:
    """Where a minimisation ended, under the names of scipy.optimize.minimize."""

    x: Floats
    fun: float
    jac: Floats
    success: bool
    status: int
    outcome: str
    message: str
    nit: int
    nfev: int
    njev: int
    history: Floats | None

class Event:
    """What event() returns."""

    g: Callable[..., Any] | Formula
    direction: int
    count: int
    terminal: bool

class Solver:
    """Many orbits of one H with one choice of monitor, order and step."""

    @property
    def choice(self) -> _Choice: ...
    @property
    def sample(self) -> str: ...
    def __init__(
        self,
        H: Callable[..., Any] | Formula,
        q: ArrayLike,
        p: ArrayLike,
        t: ArrayLike,
        tol: float,
        *,
        events: Events = ...,
        parameters: Sequence[float] = ...,
        seconds: float | None = ...,
        sweeps: int | None = ...,
        steps: int | None = ...,
        check: bool = ...,
        order: int | None = ...,
        monitor: Monitor | None = ...,
        h: float | None = ...,
        dense: bool = ...,
        checkpoint: str | PathLike[str] | None = ...,
        checkpoint_seconds: float | None = ...,
    ) -> None: ...
    def run(
        self,
        q: ArrayLike,
        p: ArrayLike,
        t: ArrayLike | None = ...,
        *,
        progress: bool | Callable[[tuple[float, float, int, float]], object] | None = ...,
    ) -> Orbit: ...
    def ensemble(
        self,
        q: ArrayLike,
        p: ArrayLike,
        t: ArrayLike | None = ...,
        *,
        progress: bool | Callable[[tuple[float, int]], object] | None = ...,
        threads: int | None = ...,
    ) -> list[Orbit]: ...

def solve(
    H: Callable[..., Any] | Formula,
    q: ArrayLike,
    p: ArrayLike,
    t: ArrayLike,
    tol: float,
    *,
    events: Events = ...,
    progress: bool | Callable[[tuple[float, float, int, float]], object] | None = ...,
    parameters: Sequence[float] = ...,
    seconds: float | None = ...,
    sweeps: int | None = ...,
    steps: int | None = ...,
    check: bool = ...,
    order: int | None = ...,
    monitor: Monitor | None = ...,
    h: float | None = ...,
    dense: bool = ...,
    checkpoint: str | PathLike[str] | None = ...,
    checkpoint_seconds: float | None = ...,
) -> Orbit: ...
def ensemble(
    H: Callable[..., Any] | Formula,
    q: ArrayLike,
    p: ArrayLike,
    t: ArrayLike,
    tol: float,
    *,
    events: Events = ...,
    progress: bool | Callable[[tuple[float, int]], object] | None = ...,
    parameters: Sequence[float] = ...,
    threads: int | None = ...,
    seconds: float | None = ...,
    sweeps: int | None = ...,
    steps: int | None = ...,
    check: bool = ...,
    order: int | None = ...,
    monitor: Monitor | None = ...,
    h: float | None = ...,
    dense: bool = ...,
) -> list[Orbit]: ...
def resume(
    H: Callable[..., Any] | Formula,
    shape: SupportsIndex | tuple[int, ...],
    file: str | PathLike[str],
    *,
    events: Events = ...,
    progress: bool | Callable[[tuple[float, float, int, float]], object] | None = ...,
    parameters: Sequence[float] = ...,
    monitor: Monitor | None = ...,
    seconds: float | None = ...,
    sweeps: int | None = ...,
    steps: int | None = ...,
    checkpoint_seconds: float | None = ...,
) -> Orbit: ...
def minimise(
    f: Callable[..., Any] | Formula,
    x0: ArrayLike,
    *,
    jac: Callable[[Floats], ArrayLike] | bool | None = ...,
    parameters: Sequence[float] = ...,
    callback: Callable[[Floats], object] | None = ...,
    history: bool = ...,
    relative: float = ...,
    absolute: float = ...,
    change: float = ...,
    memory: int = ...,
    iterations: int = ...,
    evaluations: int = ...,
    check_gradient: bool = ...,
) -> Minimum: ...
def event(g: Callable[..., Any] | Formula, *, direction: int = ..., count: int = ..., stop: bool = ...) -> Event: ...
def hamiltonian(
    H: Callable[..., Any], shape: SupportsIndex | tuple[int, ...], parameters: Sequence[float] = ..., name: str = ...
) -> Formula: ...
def objective(f: Callable[..., Any], shape: SupportsIndex | tuple[int, ...], parameters: Sequence[float] = ...) -> Formula: ...
@overload
def where(condition: Traced, x: Any, y: Any) -> Traced: ...
@overload
def where(condition: Any, x: Any, y: Any) -> Any: ...
def maximum(a: Any, b: Any) -> Any: ...
def minimum(a: Any, b: Any) -> Any: ...
def functions() -> list[str]: ...
