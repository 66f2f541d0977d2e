"""minimise(): the least value of a function of many numbers."""

from . import _avi, _data
from ._formula import _shape, formula_of, numbers_of, reals
from ._options import set_options


class Minimum:
    """Where a minimisation ended, under the names of scipy.optimize.minimize.

    x        the last good point, of the shape of x0
    fun, jac value and gradient there
    success  converged
    status   0: converged; else the number of the outcome, whose name is `outcome`
    message  one sentence on the end of the run
    nit, nfev, njev   iterations, evaluations of f and of its gradient
    history  with history=True, an array of shape (nit + 1, 3): evaluations so far, f, and the norm of its gradient; (0, 3) where f or its
             gradient was found wrong at x0
    """

    def __init__(self, outcome, message, nit, nfev, x, fun, jac, history=None):
        self.x, self.fun, self.jac = x, fun, jac
        self.outcome, self.status, self.success = outcome.name, int(outcome), outcome == _avi.Outcome.ok
        self.message = message
        self.nit, self.nfev, self.njev = nit, nfev, nfev
        self.history = history

    def __repr__(self):
        return (
            f"{self.message}\n{self.nit} iterations, {self.njev} gradients: "
            f"f = {self.fun:.17g}, |gradient| = {_length(self.jac):.3g}\nx = {self.x}"
        )


_OPTIONS = ("relative", "absolute", "change", "memory", "iterations", "evaluations", "check_gradient")


def objective(f, shape, parameters=()):
    """The formula of f(x), or of f(x, c) where parameters c are given: f is called once. It serves minimise() in the place of f.

    shape: that of x, as an int or a tuple. Products A @ x of matrices of over 2000 numbers are not recorded number by number but done by
    NumPy, with those of the gradient.
    """
    return _data.objective(f, _shape(shape), parameters)


def minimise(f, x0, *, jac=None, parameters=(), callback=None, history=False, **options):
    """Minimises f from x0.

    f      called once as f(x), or f(x, c) with parameters, with a traced array of x0's shape; returns one number. Its gradient is
           found. Or a formula from objective(), which says what becomes of products with large matrices.
    x0     start, an array of any shape
    jac    the gradient of an f that cannot be traced: a function of x, or True where f returns (value, gradient); both are called with
           arrays of x0's shape, and without parameters
    callback  called as callback(x) at x0 and after every iteration; what it raises ends the call; StopIteration, or False
              where it returns that, ends the run
    relative, absolute  converged where |gradient| <= max(relative |gradient at x0|, absolute); 1e-6 and 0. The first is a matter of
              the start: where the gradient at x0 is huge, as that of x - log x at 1e-8, 1e-6 of it is still large, and the run ends far
              from the minimum. `message` says which of both was met; a smaller `relative`, or 0 beside an `absolute`, goes on
    change    ... and the last iteration changed f by less; infinite, so that it does not count
    memory    pairs that make the mass matrix, 7; 0 for none
    iterations, evaluations   bounds, ten million each
    check_gradient  compares the gradient at x0 with differences of values first; False

    Returns a Minimum. Raises ValueError for an x0 or option out of range, TypeError for an f that cannot be traced.
    """
    x0 = reals(x0, "x0")
    if x0.size == 0:
        raise ValueError("Size of x0 is 0; it must be at least 1.")
    chosen = set_options(_avi.MinimiseOptions(), options, _OPTIONS, "minimise", ("jac", "parameters", "callback", "history"))
    for each, name, also in ((jac, "jac", "True where f returns both"), (callback, "callback", "None")):
        if not (each is None or callable(each) or (name == "jac" and isinstance(each, bool))):
            raise TypeError(f"{name} is {each!r}; it must be a function, or {also}.")
    if jac is None or jac is False:
        function = formula_of(f, parameters, lambda: _data.objective(f, x0.shape, parameters))
    else:
        if hasattr(f, "with_parameters"):
            raise TypeError("f is a formula, whose gradient is known: leave jac= out.")
        if len(numbers_of(parameters)):
            raise TypeError(
                "parameters= are for an f that is traced, and with jac= none is: let f and jac have them themselves, as functools.partial() does."
            )
        both = f if jac is True else lambda x: (f(x), jac(x))
        function = lambda x: _flat(both(x.reshape(x0.shape)))
    told = None if callback is None else lambda x: callback(x.reshape(x0.shape))
    outcome, message, nit, nfev, x, fun, jac, rows = _avi.minimise(function, x0.ravel(), chosen, told, bool(history))
    if outcome == _avi.Outcome.ok and not message:
        message = _reached(jac, chosen)
    return Minimum(outcome, message, nit, nfev, x.reshape(x0.shape), fun, jac.reshape(x0.shape), rows if history else None)


def _reached(gradient, options):
    """The criterion that was met."""
    length = _length(gradient)
    if length <= options.absolute:
        return f"Converged: |gradient| is at most {options.absolute:g}, which was asked for." if options.absolute else "Converged: the gradient is 0."
    if not options.relative:
        return f"Converged: |gradient| fell to {length:.2g}, the square of which is no number any more."
    return f"Converged: |gradient| fell to at most {options.relative:g} of that at the start."


def _length(gradient):
    """|gradient|, also where the squares of its entries underflow."""
    import numpy as np

    largest = np.abs(gradient).max()
    return largest * np.linalg.norm(gradient / largest) if 0.0 < largest < 1e-150 else np.linalg.norm(gradient)


def _flat(both):
    import numpy as np

    if not isinstance(both, (tuple, list)) or len(both) != 2:
        raise TypeError(f"f returned a {type(both).__name__}; with jac=True it must return a pair, (value, gradient).")
    value, gradient = both
    if isinstance(value, (bool, np.bool_)):
        raise TypeError("f returned a comparison; it must return a number.")
    value = reals(value, "The value of f")
    if value.size != 1:
        raise TypeError(f"f returned an array of shape {value.shape}; it must return one number.")
    return value.item(), np.ravel(reals(gradient, "The gradient"))
