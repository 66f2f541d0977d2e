"""Functions of Python as formulas of the library."""

import inspect

from . import _avi


_avi.Formula.__doc__ = """A function of Python that was called once, by hamiltonian() or objective().

The arguments of value(x) and gradient(x) are those of the function one after the other, (q, p) or (q, p, t). Threads can share it.
"""

_avi.Formula.__repr__ = lambda self: f"<a formula of {self.size} numbers>"


def _shape(x):
    """The shape of an example, or a number of entries as one."""
    return tuple(x.shape) if hasattr(x, "shape") else tuple(x) if isinstance(x, (tuple, list)) else (int(x),)


def numbers_of(parameters):
    """Parameters as a list. Raises TypeError for anything but a sequence of numbers."""
    try:
        return [float(each) for each in parameters]
    except TypeError:
        raise TypeError(f"parameters is {parameters!r}; it must be a sequence of numbers, such as [1.0, 2.0].") from None


def formula_of(f, parameters, traced):
    """f where it is a formula already, with the parameters where there are any; else what `traced` returns."""
    if not hasattr(f, "with_parameters"):
        return traced()
    return f.with_parameters(numbers_of(parameters)) if len(parameters) else f


def trace(f, shapes, parameters, name):
    """The formula of f, which is called once with traced arrays of these shapes, and with parameters where there are any."""
    try:
        return _avi.trace(f, shapes, numbers_of(parameters), name)
    except ValueError as error:  # NumPy's own words where an array is filled
        if isinstance(error.__cause__, TypeError):
            raise error.__cause__ from None
        raise
    except TypeError as error:  # of functions of NumPy that have no say where an array holds objects
        if "dtype('O')" in str(error) and "traced" not in str(error):
            raise TypeError(
                "NumPy cannot do this to an array of traced numbers that np.array() has made, as it could to one of np.stack(): write "
                "np.stack([np.stack([a, b]), np.stack([c, d])]) instead of np.array([[a, b], [c, d]])."
            ) from error
        raise


def _arguments(f):
    """How many arguments f takes by their places; 0 where it takes any number, or does not say."""
    code = getattr(f, "__code__", None)
    if code is not None and not code.co_flags & 4:  # *args
        return code.co_argcount - len(f.__defaults__ or ()) - inspect.ismethod(f)
    try:
        parameters = list(inspect.signature(f).parameters.values())
    except (TypeError, ValueError):
        return 0
    if any(x.kind is x.VAR_POSITIONAL for x in parameters):
        return 0
    return sum(x.kind in (x.POSITIONAL_ONLY, x.POSITIONAL_OR_KEYWORD) and x.default is x.empty for x in parameters)


def hamiltonian(H, shape, parameters=(), name="H"):
    """The formula of H(q, p) or H(q, t, p), and of parameters c after them where there are any: H is called once.

    shape: that of q and of p, as an int or a tuple; () for numbers. The formula serves solve() in the place of H, and
    `formula.with_parameters(c)` is the same formula with other values of c, without a call of H.
    """
    shape, parameters = _shape(shape), numbers_of(parameters)
    timed = _arguments(H) == 3 + (len(parameters) > 0)
    named = getattr(getattr(H, "__code__", None), "co_varnames", ())[inspect.ismethod(H) :][: 3 if timed else 2]
    if "t" in named and not (timed and named[1] == "t"):  # as the functions (t, y) of other solvers
        meant = "q, t, p" if timed else "q, p, or q, t, p where time counts"
        raise TypeError(f"{name} calls its arguments {', '.join(named)}; they are {meant}, in this order.")
    if timed:
        return trace(lambda q, p, t, *c: H(q, t, p, *c), [shape, shape, ()], parameters, name)
    return trace(H, [shape, shape], parameters, name)
