"""Functions of Python as formulas of the library."""

import functools
import inspect
import operator
import reprlib
import threading

from . import _avi


_avi.Formula.__doc__ = """A function of Python that was called once, by hamiltonian() or objective().

The arguments of value(x) and gradient(x) are those of the function one after the other, (q, p) or (q, p, t). Threads can share it.
"""


def _of_one_array(method):
    def evaluate(self, *x):
        if len(x) != 1:
            raise TypeError(f"A formula takes its arguments as one array, one after the other: formula.{method.__name__}(np.concatenate([q, p])).")
        return method(self, reals(x[0], "The argument of a formula"))

    return evaluate


def _of_numbers(method):
    return lambda self, parameters: method(self, numbers_of(parameters))


_avi.Formula.with_parameters = _of_numbers(_avi.Formula.with_parameters)
_avi.Formula.value = _of_one_array(_avi.Formula.value)
_avi.Formula.gradient = _of_one_array(_avi.Formula.gradient)
_avi.Formula.__repr__ = lambda self: f"<a formula of {self.size} numbers>"


def _shape(x):
    """The shape of an example, or a number of entries as one."""
    if hasattr(x, "shape"):
        return tuple(x.shape)
    try:
        shape = tuple(operator.index(n) for n in (x if isinstance(x, (tuple, list)) else (x,)))
    except TypeError:
        raise TypeError(f"shape is {x!r}; it must be that of q: an int, a tuple of ints, or an array that has it.") from None
    if min(shape, default=0) < 0:
        raise ValueError(f"shape is {x!r}; its lengths must be at least 0.")
    return shape


_short = reprlib.Repr()
_short.maxother = 80


def reals(x, name):
    """x as an array of doubles. Raises TypeError where something would be lost on the way."""
    import numpy as np

    wrong = lambda what: TypeError(f"{name} is {what}; it must be a real number or an array of them.")
    if x is None:
        raise wrong("None")
    if hasattr(x, "hardmask"):
        raise wrong("an array with a mask")
    kind = "?"
    try:
        array = np.asarray(x)
        kind = array.dtype.kind
        if kind in "biufO":  # NumPy makes numbers of strings and dates, too
            return np.asarray(array, dtype=float)
    except (TypeError, ValueError, OverflowError):
        pass
    raise wrong("complex" if kind == "c" else _short.repr(x))


def numbers_of(parameters):
    """Parameters as a list. Raises TypeError for anything but a sequence of numbers."""
    try:
        return [float(each) for each in parameters]
    except (TypeError, ValueError):
        raise TypeError(f"parameters is {parameters!r}; it must be a sequence of numbers, such as [1.0, 2.0].") from None


def formula_of(f, parameters, traced):
    """f where it is a formula already, with the parameters where there are any; else what `traced` returns."""
    if not hasattr(f, "with_parameters"):
        return traced()
    return f.with_parameters(numbers_of(parameters)) if len(parameters) else f


_one_at_a_time = threading.RLock()


@functools.lru_cache(maxsize=None)
def _numpy_only_warns():
    """Whether NumPy warns where two arrays of objects cannot be compared, and says False: so did it before 1.25."""
    import numpy as np

    return np.lib.NumpyVersion(np.__version__) < "1.25.0"


def _trace(f, shapes, parameters, name):
    """_avi.trace(), with an exception where NumPy only warns."""
    if not _numpy_only_warns():
        return _avi.trace(f, shapes, parameters, name)
    import warnings

    with _one_at_a_time, warnings.catch_warnings():  # which is for one thread
        warnings.filterwarnings("error", "elementwise comparison failed", DeprecationWarning)
        return _avi.trace(f, shapes, parameters, name)


def _in_scipy(error):
    """The part of SciPy that was called where its own code, or ours from there, raised an error, such as scipy.sparse; else None."""
    at, part = error.__traceback__, None
    while at is not None:
        package, *rest = at.tb_frame.f_globals.get("__name__", "").split(".")
        if package == "scipy" and rest:
            part = part or f"scipy.{rest[0]}"
        elif package not in ("numpy", "avi"):  # a function that was given to SciPy raises what is its own
            part = None
        at = at.tb_next
    return part


def _refused_by_scipy(error, part):
    """Its words are of arrays of objects, or ours of float(), neither of which the function has."""
    return TypeError(
        f"{part} cannot take traced numbers: its code is compiled, or asks for values. Write a.toarray() instead of a sparse matrix, a polynomial "
        "(np.polyval) or a sum of np.exp instead of a spline, np.linalg instead of scipy.linalg, np.linalg.norm of differences instead of pdist, np.logaddexp instead of logsumexp, and the rest with what avi.functions() lists."
    )


def trace(f, shapes, parameters, name):
    """The formula of f, which is called once with traced arrays of these shapes, and with parameters where there are any."""
    if not callable(f):
        raise TypeError(f"{name} is {f!r}; it must be a function, or a formula of one.")
    try:
        return _trace(f, shapes, numbers_of(parameters), name)
    except DeprecationWarning as error:
        if isinstance(error.__cause__, TypeError):
            raise error.__cause__ from None
        raise
    except ValueError as error:  # NumPy's own words where an array is filled
        part = _in_scipy(error)
        if part and ("object" in str(error) or isinstance(error.__cause__, TypeError)):
            raise _refused_by_scipy(error, part) from error
        if isinstance(error.__cause__, TypeError):
            raise error.__cause__ from None
        if "two recordings" in str(error):  # which goes on about C++
            raise ValueError(
                f"{name} mixes numbers of this call with traced ones of an earlier one: it must not keep numbers from one call to the next, as in a cache or "
                "an attribute."
            ) from None
        if "read-only" in str(error):
            raise TypeError(
                f"NumPy says '{error}': what np.asarray() and the like make of traced numbers is a copy, and a change of it would be "
                "lost. Write a = a + b instead of a += b, or make a new array by avi.where(condition, x, y) or np.stack([x, y])."
            ) from error
        raise
    except TypeError as error:  # of functions of NumPy that have no say where an array holds objects
        words = str(error)
        part = _in_scipy(error)
        if part and "traced here" not in words:
            raise _refused_by_scipy(error, part) from error
        if "which has no callable" in words:
            raise TypeError(
                f"NumPy cannot take np.{words.split()[-2]}() of the plain numbers in an array of objects, as np.zeros(2, dtype=q.dtype) leaves "
                "them: fill all of it, begin with np.zeros_like(q), or make the array by np.stack([x, y])."
            ) from error
        if any(of in words for of in ("dtype('O')", "data type for einsum", "not supported for the input types")) and "traced" not in words:
            raise TypeError(
                "NumPy cannot do this to an array of traced numbers that np.array() has made, as it could to one of np.stack(): write "
                "np.stack([np.stack([a, b]), np.stack([c, d])]) instead of np.array([[a, b], [c, d]])."
            ) from error
        raise


def _names(f):
    """The names of the arguments that f takes by their places, how many of them have to be given, and the names of those with a default of
    f's own, not of a partial(); None where any number is taken, or f does not say."""
    code = getattr(f, "__code__", None)
    if code is not None and not code.co_flags & 4:  # *args
        names = code.co_varnames[: code.co_argcount][inspect.ismethod(f) :]
        needed = len(names) - len(f.__defaults__ or ())
        return names, needed, names[needed:] + tuple(f.__kwdefaults__ or ())
    try:
        parameters = list(inspect.signature(f).parameters.values())
    except (TypeError, ValueError):
        return None
    if any(x.kind is x.VAR_POSITIONAL for x in parameters):
        return None
    placed = [x for x in parameters if x.kind in (x.POSITIONAL_ONLY, x.POSITIONAL_OR_KEYWORD)]
    needed = sum(x.default is x.empty for x in placed)
    names = tuple(x.name for x in placed)
    return names, needed, names[needed:]


_TIME = {"t", "time"}


def _in_another_order(first, last):
    """Whether names of the first and the last of two or three arguments say that momenta come first, as (p, x), (x, q), (px, x) do."""
    return first == "p" or last == "q" or first in (f"p{last}", f"p_{last}")


def _is_timed(f, more, name):
    """Whether f is a function of q, t, p, not of q, p, with so many arguments after them. Raises TypeError where it is of neither, or
    where names say that it means other arguments than it would get."""
    taken = _names(f)
    if taken is None:
        return False
    names, needed, optional = taken
    timed = needed == 3 + more
    called, after = ", ".join(names[:needed]), ", and parameters, as one array, after them" if more else ""
    order = f"they are q, p, or q, t, p where time counts, in this order{after}."
    if not timed and not needed <= 2 + more <= len(names):
        asked = "" if more or name != "H" else ", and one more comes where parameters=[...] are given"
        raise TypeError(f"{name} takes the arguments {called or 'none'}; {order[:-1]}{asked}.")
    if not timed and _TIME & {*optional}:
        raise TypeError(
            f"{name} has a default for {', '.join(_TIME & {*optional})}, which no other value would ever replace: take the arguments q, t, p where "
            "time counts, and give a constant another name."
        )
    of = names[: 3 if timed else 2]
    if _TIME & {*of[:1], *of[1 + timed :]}:  # as the functions (t, y) of other solvers
        meant = "q, t, p" if timed else "q, p, or q, t, p where time counts"
        raise TypeError(f"{name} calls its arguments {', '.join(of)}; they are {meant}, in this order.")
    if _in_another_order(of[0].lower(), of[-1].lower()):
        raise TypeError(f"{name} calls its arguments {called}; {order}")
    if timed and of[1] == "p" and of[2] != "p":
        asked = "" if more or name != "H" else f", and {of[2]} comes where parameters=[...] are given"
        raise TypeError(f"{name} calls its arguments {called}; {order[:-1]}{asked}.")
    return timed


def hamiltonian(H, shape, parameters=(), name="H"):
    """The formula of H(q, p) or H(q, t, p), and of parameters c after them where there are any: H is called once.

    shape: that of q and of p, as an int or a tuple; () for numbers. The formula serves solve() in the place of H, and
    `formula.with_parameters(c)` is the same formula with other values of c, without a call of H.
    """
    shape, parameters = _shape(shape), numbers_of(parameters)
    timed = callable(H) and _is_timed(H, len(parameters) > 0, name)
    if timed:
        return trace(lambda q, p, t, *c: H(q, t, p, *c), [shape, shape, ()], parameters, name)
    return trace(H, [shape, shape], parameters, name)
