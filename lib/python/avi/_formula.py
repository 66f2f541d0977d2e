"""Functions of Python as formulas of the library."""

from . import _avi


def _shape(x):
    """The shape of an example, or a number of entries as one."""
    return tuple(x.shape) if hasattr(x, "shape") else tuple(x) if isinstance(x, (tuple, list)) else (int(x),)


def trace(f, shapes, parameters, name):
    """The formula of f, which is called once with traced arrays of these shapes, and with parameters where there are any."""
    try:
        return _avi.trace(f, shapes, list(parameters), name)
    except ValueError as error:  # NumPy's own words where an array is filled
        if isinstance(error.__cause__, TypeError):
            raise error.__cause__ from None
        raise


def hamiltonian(H, shape, parameters=()):
    """The formula of H(q, p), or of H(q, p, c) where parameters c are given: H is called once.

    shape: that of q and of p, as an int or a tuple; () for numbers. The formula serves solve() in the place of H, and
    `formula.with_parameters(c)` is the same formula with other values of c, without a call of H.
    """
    return trace(H, [_shape(shape)] * 2, parameters, "H")


def objective(f, shape, parameters=()):
    """The formula of f(x), or of f(x, c) where parameters c are given: f is called once. It serves minimise() in the place of f.

    shape: that of x, as an int or a tuple.
    """
    return trace(f, [_shape(shape)], parameters, "f")
