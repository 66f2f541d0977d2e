"""NumPy's functions and an array's methods for numbers that are being traced (the class itself is in C++)."""

import functools
import inspect
import operator

from . import _algebra
from ._avi import Traced, functions as _names, pool, traced, where as _where

_REFUSED = {
    "A function is traced with numbers that have no value yet, so float(x), int(x), math.sin(x) and the like cannot take them: write "
    "np.sin(x), np.sqrt(x) and so on, and make arrays by np.stack([x, y]) instead of filling np.zeros(2), or fill np.zeros(2, dtype=q.dtype).": (
        "float int complex index"
    ),
    "A function is traced once for all arguments, so it cannot branch on them: instead of `if a < b`, `and`, `or`, `not`, min(a, b) and "
    "max(a, b) write avi.where(a < b, x, y), `&`, `|`, `~`, avi.minimum(a, b) and avi.maximum(a, b).": "bool contains",
    "A function that asks whether two of its numbers are equal cannot be traced; instead of `==` and `!=` write avi.where(a < b, x, y).": (
        "eq ne"
    ),
    "divmod() gives two numbers, which a traced one cannot be: write x // a and x % a.": "divmod rdivmod",
    "Traced numbers cannot be assigned to: make a new array by np.stack([x, y]) or np.concatenate([u, v]).": "setitem",
}


Traced.__doc__ = """Numbers of a function that is being traced, in the shape of an array.

They have no value yet, and what is done with them is recorded.
"""


def _refusal(sentence):
    def refuse(self, *args):
        raise TypeError(sentence)

    return refuse


for _sentence, _of in _REFUSED.items():
    for _name in _of.split():
        setattr(Traced, f"__{_name}__", _refusal(_sentence))
Traced.__hash__ = None

def _assigned(of):
    def assign(self, other):
        """a += b: of an array, its views change with it; a single number is another one then, as in NumPy."""
        if not self.shape and not self._is_view:
            return NotImplemented
        self._assign(getattr(self, of)(other))
        return self

    return assign


for _name, _of in {
    "neg": "negative", "pos": "positive", "abs": "absolute", "invert": "invert", "add": "add", "sub": "subtract", "mul": "multiply",
    "truediv": "divide", "pow": "power", "lt": "less", "le": "less_equal", "gt": "greater", "ge": "greater_equal", "and": "logical_and",
    "or": "logical_or", "mod": "remainder", "floordiv": "floor_divide", "floor": "floor", "ceil": "ceil", "trunc": "trunc",
}.items():  # fmt: skip
    setattr(Traced, f"__{_name}__", getattr(Traced, _of))
    if hasattr(float, f"__r{_name}__") or hasattr(int, f"__r{_name}__"):
        setattr(Traced, f"__r{_name}__", getattr(Traced, f"reversed_{_of}"))
    if hasattr(operator, f"__i{_name}__"):
        setattr(Traced, f"__i{_name}__", _assigned(f"__{_name}__"))
Traced.__imatmul__ = _assigned("__matmul__")


def _round(a, decimals=0):
    return a.rint() if not decimals else (a * 10.0**decimals).rint() / 10.0**decimals


Traced.__round__ = _round


def functions():
    """The names of the functions that can be traced, those of NumPy and scipy.special."""
    return sorted(_names)


def _array_ufunc(self, ufunc, method, *inputs, out=None, axis=0, **options):
    """NumPy's functions of numbers."""
    name = ufunc.__name__
    if out is not None:
        if getattr(out[0], "dtype", None) != object:
            raise TypeError("An array of numbers cannot hold traced ones: write a = a + b instead of a += b.")
        if method in ("reduce", "accumulate"):
            options["axis"] = axis
        out[0][...] = _objects(getattr(ufunc, method)(*inputs, **options))
        return out[0]
    options = {key: x for key, x in options.items() if x is not None}
    if method == "reduce" and name in _names and options.keys() <= {"keepdims"}:
        return _fold(inputs[0], name, axis, **options)
    if method == "outer" and not options:
        a, b = (traced(x) for x in inputs)
        return ufunc(a.reshape(a.shape + (1,) * b.ndim), b)
    if method == "__call__" and not options:
        if name == "matmul":
            if isinstance(inputs[0], Traced):
                return _algebra.times(*inputs)
            kept = _algebra.by_matrix(*inputs)
            return _algebra.matmul(traced(inputs[0]), inputs[1]) if kept is None else kept
        if name in ("equal", "not_equal"):
            return self == self
        if name in _names:
            first, *others = inputs
            return getattr(Traced, name)(first, *others) if isinstance(first, Traced) else getattr(self, f"reversed_{name}")(first)
    if method != "__call__" or options:
        words = [f"with {', '.join(options)}="] * bool(options) + [f"as np.{name}.{method}"] * (method != "__call__")
        raise TypeError(f"np.{name} cannot be traced {' '.join(words)}.")
    import numpy as np

    full = f"np.{name}" if getattr(np, name, None) is ufunc else name
    raise TypeError(f"{full} cannot be traced here; avi.functions() lists what can.")


def _objects(x):
    """x as NumPy's array of objects, each a single traced number; lists and tuples entry by entry."""
    if isinstance(x, Traced):
        import numpy as np

        array = np.empty(x.size, dtype=object)
        flat = x._take(np.arange(x.size))
        array[:] = [flat[i] for i in range(x.size)]
        return array.reshape(x.shape)
    return type(x)(_objects(each) for each in x) if isinstance(x, (list, tuple)) else x


def _any_traced(*values):
    return any(isinstance(x, Traced) or getattr(x, "dtype", None) == object for x in values)


def where(condition, x, y):
    """x where the condition holds, else y, entry by entry: what a formula writes instead of `if`.

    Both x and y are evaluated, and differentiated, everywhere. `condition` is a comparison such as `q[0] < 1`, or several joined by
    `&`, `|` and `~`. Works on plain numbers and arrays, too.
    """
    if _any_traced(condition, x, y):
        return _where(condition, x, y)
    import numpy as np

    return np.where(condition, x, y)


def maximum(a, b):
    """The larger of a and b, entry by entry."""
    import numpy as np

    return np.maximum(traced(a) if _any_traced(a, b) else a, b)


def minimum(a, b):
    """The smaller of a and b, entry by entry."""
    import numpy as np

    return np.minimum(traced(a) if _any_traced(a, b) else a, b)


def _fold(x, name, axis=None, keepdims=False):
    """f(f(x0, x1), x2) ... along an axis or several, or of all entries."""
    x = traced(x)
    if axis is None and not keepdims:
        return x.ravel()._folded(name)
    import numpy as np

    np.zeros((0,) * x.ndim).sum(axis=axis)  # raises what NumPy says of an axis that is not there, or is there twice
    axes = sorted(i % x.ndim for i in np.atleast_1d(range(x.ndim) if axis is None else axis)) if x.ndim else []
    shape = tuple(1 if i in axes else length for i, length in enumerate(x.shape))
    for each in reversed(axes):
        x = x._take(np.moveaxis(x._numbers, each, 0))._folded(name)
    return x.reshape(shape) if keepdims else x


def _require_reals(dtype):
    import numpy as np

    if dtype is not None and np.dtype(dtype).kind not in "fO":
        raise TypeError(f"A traced number cannot be made one of the type {np.dtype(dtype)}: it stays real, with no value yet.")


def _folding(name, called):
    def fold(a, axis=None, *, keepdims=False, dtype=None):
        _require_reals(dtype)
        return _fold(a, name, axis, keepdims)

    fold.__name__ = fold.__qualname__ = called
    return fold


_sum, _largest, _least = _folding("add", "sum"), _folding("maximum", "max"), _folding("minimum", "min")


def _dot(a, b):
    import numpy as np

    if np.ndim(a) > 1 and np.ndim(b) > 2:  # not the product of stacks that @ is
        columns = np.moveaxis(b, -2, 0)
        return (a @ columns.reshape(columns.shape[0], -1)).reshape(*np.shape(a)[:-1], *columns.shape[1:])
    return a @ b if np.ndim(a) and np.ndim(b) else traced(a) * b


def _inner(a, b):
    import numpy as np

    return _algebra.tensordot(a, b, (-1, -1)) if np.ndim(a) and np.ndim(b) else traced(a) * b


def _clip(a, a_min=None, a_max=None):
    x = traced(a) if a_min is None else maximum(a, a_min)
    return x if a_max is None else minimum(x, a_max)


def _where_of_numpy(condition, x=None, y=None):
    if x is None or y is None:
        raise TypeError("np.where(condition) asks for values, which a traced number does not have; write avi.where(condition, x, y).")
    return where(condition, x, y)


def _select(conditions, choices, default=0):
    if len(conditions) != len(choices):
        raise ValueError(f"np.select has {len(conditions)} conditions and {len(choices)} choices; it needs as many of each.")
    for condition, choice in reversed([*zip(conditions, choices)]):
        default = where(condition, choice, default)
    return default


def _astype(x, dtype=None, **options):
    _require_reals(dtype)
    return x if options.get("copy") is False else x.copy()


def _mean(a, axis=None, *, keepdims=False, dtype=None):
    _require_reals(dtype)
    total = _fold(a, "add", axis, keepdims)
    return total / (a.size / max(total.size, 1))


def _diff(a, n=1, axis=-1, prepend=None, append=None):
    import numpy as np

    x = a
    ends = [end if end is None or np.ndim(end) else np.full(x.shape[:axis] + (1,) + x.shape[axis:][1:], end) for end in (prepend, append)]
    x = np.concatenate([part for part in (ends[0], x, ends[1]) if part is not None], axis)
    for _ in range(n):
        x = x.swapaxes(axis, -1)
        x = (x[..., 1:] - x[..., :-1]).swapaxes(axis, -1)
    return x


_FUNCTIONS = {
    "diff": _diff,
    "where": _where_of_numpy,
    "sum": _sum,
    "mean": _mean,
    "prod": _folding("multiply", "prod"),
    "amax": _largest,
    "amin": _least,
    "ptp": lambda a, axis=None, *, keepdims=False: _largest(a, axis, keepdims=keepdims) - _least(a, axis, keepdims=keepdims),
    "einsum": _algebra.einsum,
    "solve": _algebra.solution,
    "inv": _algebra.inverse,
    "det": _algebra.determinant,
    "select": _select,
    "real": lambda x: x,
    "sinc": lambda x: x.sinc(),
    "shape": lambda x: x.shape,
    "ndim": lambda x: x.ndim,
    "size": lambda x: x.size,
    "dot": _dot,
    "inner": _inner,
    "tensordot": _algebra.tensordot,
    "norm": _algebra.norm,
    "clip": _clip,
    **dict.fromkeys(("round", "around", "round_"), _round),
    "fix": lambda x: x.trunc(),
}
_FUNCTIONS["max"], _FUNCTIONS["min"] = _FUNCTIONS["amax"], _FUNCTIONS["amin"]
_JOINS = {"concatenate", "stack", "hstack", "vstack", "column_stack", "dstack"}
_MOVES = {"roll", "repeat", "tile", "copy"}
_VIEWS = set(
    "transpose flip fliplr flipud squeeze expand_dims moveaxis rollaxis swapaxes broadcast_to diagonal atleast_1d atleast_2d "
    "atleast_3d rot90 split array_split hsplit vsplit dsplit matrix_transpose permute_dims unstack".split()
)
_FILLED = {"zeros_like", "ones_like", "empty_like", "full_like"}  # stay arrays of objects, which can be filled
_ASSIGN = "It would change an array in its place: make a new one by avi.where(condition, x, y), np.stack([x, y]) or np.concatenate([u, v])."
_EQUAL = "It would ask whether numbers that have no value yet are equal: write avi.where(np.abs(a - b) < tolerance, x, y)."
_NOT_HERE = {
    **dict.fromkeys(("fill_diagonal", "put", "copyto", "putmask", "place", "put_along_axis"), _ASSIGN),
    **dict.fromkeys(("array_equal", "array_equiv", "allclose", "isclose"), _EQUAL),
    "cholesky": "For a system of equations take np.linalg.solve, for the determinant np.linalg.det.",
    "slogdet": "Write np.log(np.abs(np.linalg.det(a))).",
    "gradient": "Write (u[2:] - u[:-2]) / (2.0 * h), or np.diff(u) / h.",
    "angle": "Write np.arctan2(y, x).",
    **dict.fromkeys(("fft", "rfft", "ifft", "irfft"), "Write C @ x and S @ x with constant matrices of cosines and sines."),
    **dict.fromkeys(("eigh", "eigvalsh", "eig", "eigvals"), "Of two rows they are m + d and m - d, with m = (a + c) / 2 and d = np.sqrt((a - c)**2 / 4 + b**2)."),
    "bincount": "Write W @ x with a constant matrix of 0 and 1.",
    "interp": "A table cannot be looked up by a number that has no value yet: take a polynomial (np.polyval) or a sum of np.exp that fits it.",
    "linspace": "Write a + (b - a) * np.linspace(0, 1, n).",
    **dict.fromkeys(("cov", "corrcoef"), "Write d = a - np.mean(a), e = b - np.mean(b) and d @ e, with the denominator that you want."),
    **dict.fromkeys(
        ("nansum", "nanmean", "nanprod", "nanmax", "nanmin", "nanstd", "nanvar", "nancumsum"),
        "Whether a number that has no value yet is nan cannot be asked: write the same without nan, np.sum for np.nansum.",
    ),
    "piecewise": "Write avi.where(condition, x, y), or np.select([a < b, c < d], [x, y], z).",
}
_NOT_HERE["fill_diagonal"] += " A diagonal is taken away by a * (1 - np.eye(n)) and put in by + np.eye(n) * b."


def _joined(function, parts, *args, **kwargs):
    """What a function of NumPy makes of several arrays by putting their entries side by side: done to the numbers of the entries."""
    import numpy as np

    shapes = [part.shape if isinstance(part, Traced) else np.shape(part) for part in parts]
    ends = np.cumsum([0] + [int(np.prod(shape)) for shape in shapes])
    numbers = [np.arange(ends[i], ends[i + 1]).reshape(shape) for i, shape in enumerate(shapes)]
    return pool(list(parts))._take(function(numbers, *args, **kwargs))


def _of_view(x, numbers):
    """Views of x from those of the numbers of its entries."""
    return type(numbers)(_of_view(x, each) for each in numbers) if isinstance(numbers, (list, tuple)) else x._view(numbers)


@functools.lru_cache(maxsize=None)
def _taken(known):
    return inspect.signature(known).parameters.keys()


def _array_function(self, function, types, args, kwargs):
    """NumPy's other functions: those above by the graph, the rest (cross, outer, trace ...) by what NumPy does with objects."""
    import numpy as np

    name = function.__name__
    full = f"{function.__module__.replace('numpy', 'np')}.{name}"
    known = _FUNCTIONS.get(name)
    if name in _NOT_HERE:
        raise TypeError(f"{full} cannot be traced. {_NOT_HERE[name]}")
    if known:
        for option in kwargs:
            if option not in _taken(known):
                raise TypeError(f"{full} cannot be traced with {option}=; it takes {', '.join(_taken(known))}.")
        return known(*args, **kwargs)
    if name in _JOINS:
        return _joined(function, *args, **kwargs)
    if name in ("reshape", "ravel") and args[:1] and args[0] is self:
        return _reshaped(name)(self, *args[1:], **kwargs)
    if name in _MOVES | _VIEWS and args[:1] and args[0] is self and not (name.startswith("atleast") and len(args) > 1):
        moved = function(args[0]._numbers, *args[1:], **kwargs)
        return args[0]._take(moved) if name in _MOVES else _of_view(args[0], moved)
    objects = [_objects(x) for x in args]
    for x, each in zip(args, objects):
        if isinstance(x, Traced):
            each.flags.writeable = False  # it is a copy, which must not be changed in the place of what it was made of
    try:
        result = function(*objects, **{key: _objects(x) for key, x in kwargs.items()})
    except (TypeError, ValueError) as error:
        of_ours = isinstance(error.__cause__, TypeError)  # where NumPy has words of its own for it
        kind = TypeError if of_ours or isinstance(error, TypeError) else ValueError
        raise kind(f"{full} cannot be traced: {error.__cause__ if of_ours else error}") from None
    if name in _FILLED:
        room = np.empty(result.shape, dtype=object)
        for i in np.ndindex(result.shape):
            room[i] = traced(0.0 if result[i] is None else result[i])  # None is what is empty
        return room
    several = isinstance(result, (list, tuple))
    for x, each in zip(args, objects):
        if isinstance(x, Traced) and any(np.may_share_memory(each, part) for part in (result if several else [result])):
            if x is args[0] and not several:
                return x._view(function(x._numbers, *args[1:], **kwargs))
            x._fix()
    return traced(result) if _any_traced(result) else result


def _no_length():
    raise TypeError("A single traced number has no length.")


def _dtype():
    import numpy as np

    return np.dtype(object)


def _by_numpy(name):
    def method(self, *args, **kwargs):
        import numpy as np

        return getattr(np, name)(self, *args, **kwargs)

    return method


def _moved(name, take):
    return lambda self, *args, **kwargs: getattr(self, take)(getattr(self._numbers, name)(*args, **kwargs))


def _reshaped(name):
    def reshape(self, *args, **kwargs):
        """A view where NumPy makes one, a copy where it has to; where that is not known, neither array is assigned to any more."""
        import numpy as np

        for order in ("A", "K"):
            if self.ndim > 1 and any(isinstance(x, str) and x == order for x in (*args, *kwargs.values())):
                raise TypeError(f"The order {order!r} asks how an array lies in memory, which a traced one does not tell; say 'C' or 'F'.")
        numbers = self._numbers
        moved = getattr(numbers, name)(*args, **kwargs)
        if self._regular and np.may_share_memory(moved, numbers) and (name == "reshape" or self._in_a_row):
            return self._view(moved)
        result = self._take(moved)
        if not self._regular:
            self._fix()
            result._fix()
        return result

    return reshape


def _item(self, *place):
    number = self._numbers.item(*place)  # the place as NumPy takes it, which refuses none where there are several entries
    return self._take(number)


def _array(self):
    """What np.asarray() makes of several numbers: an array of objects that cannot be changed, as it is a copy."""
    if not self.shape:
        raise AttributeError("__array__")  # one number is one object

    def array(dtype=None, copy=None):
        import numpy as np

        if dtype is not None and np.dtype(dtype) != object:
            self.__float__()
        objects = _objects(self)
        if not copy:
            objects.flags.writeable = False
            self._fix()
        return objects

    return array


Traced.__matmul__ = _algebra.times
Traced.__array_function__ = _array_function
Traced.__array_ufunc__ = _array_ufunc
Traced.__len__ = lambda self: self.shape[0] if self.shape else _no_length()
Traced.__repr__ = lambda self: f"<traced numbers of shape {self.shape}>"
Traced.ndim = property(lambda self: len(self.shape))
Traced._fold = _fold
Traced.sum = _sum
Traced.mean = _mean
Traced.prod = _FUNCTIONS["prod"]
Traced.max = _FUNCTIONS["amax"]
Traced.min = _FUNCTIONS["amin"]
Traced.dot = _dot
Traced.clip = lambda self, min=None, max=None: _clip(self, min, max)
Traced.astype = _astype
Traced.copy = lambda self, order=None: traced(self)
Traced.__copy__ = lambda self: traced(self)
Traced.__deepcopy__ = lambda self, memo: traced(self)
Traced.__array__ = property(_array)
Traced.real = property(lambda self: self)
Traced.imag = property(lambda self: 0.0 * self)
Traced.conj = lambda self: self
Traced.round = _round
Traced.dtype = property(lambda self: _dtype())
Traced.__format__ = lambda self, spec: repr(self)
Traced.tolist = lambda self: [each.tolist() for each in self] if self.shape else self
Traced.item = _item
Traced.T = property(lambda self: self._view(self._numbers.T))
Traced.reshape, Traced.ravel = _reshaped("reshape"), _reshaped("ravel")
for _name in ("transpose", "squeeze", "swapaxes", "diagonal"):
    setattr(Traced, _name, _moved(_name, "_view"))
for _name in ("flatten", "repeat", "take"):
    setattr(Traced, _name, _moved(_name, "_take"))
for _name in ("cumsum", "ptp", "std", "trace", "var"):
    setattr(Traced, _name, _by_numpy(_name))
