"""Products of traced arrays and linear algebra: what NumPy does in compiled code for numbers alone."""

from contextvars import ContextVar

from ._avi import Traced, pool, traced

LARGE = 2000  # products of so many numbers are worth a call of a matrix product
matrices = ContextVar("matrices", default=(0, None))  # of the objective that is being traced the number of its arguments, and its matrices


def by_matrix(a, x):
    """The product of a large matrix of numbers with arguments of a function that is being traced, where that is kept as it is."""
    size, kept = matrices.get()
    if kept is None or isinstance(a, Traced) or a.ndim != 2 or a.size * (x.size // len(x)) < LARGE or a.shape[1] != len(x):
        return None
    places = x._places
    if not places or max(places) >= size:  # parameters are not kept as they are
        return None
    import numpy as np

    kept.append((np.array(a, dtype=float), np.reshape(places, x.shape)))
    return x._more(a.shape[:1] + x.shape[1:])


def product(a, b):
    if not (a.ndim and b.ndim) or a.shape[-1] != b.shape[-2 if b.ndim > 1 else 0]:
        raise ValueError(f"The product @ of arrays of shapes {a.shape} and {b.shape} cannot be traced: the inner lengths have to agree.")
    if b.ndim == 1:
        return (a * b).sum(axis=-1)
    return ((a[..., :, None] if a.ndim > 1 else a[:, None]) * (b[..., None, :, :] if a.ndim > 1 else b)).sum(axis=-2)


def einsum(subscripts, *operands):
    operands = [traced(x) for x in operands]
    inputs, _, output = subscripts.replace(" ", "").partition("->")
    terms = inputs.split(",")
    letters = sorted(set(inputs) - {","})
    if "->" not in subscripts:
        output = "".join(letter for letter in letters if inputs.count(letter) == 1)
    if [len(term) for term in terms] != [x.ndim for x in operands] or not all(map(str.isalpha, letters)):
        raise TypeError(f"np.einsum({subscripts!r}) cannot be traced: give one letter for each axis of every array.")
    import numpy as np

    result = 1.0
    for term, x in zip(terms, operands):
        own = sorted(set(term))
        x = x._take(np.einsum(f"{term}->{''.join(own)}", x._numbers))
        result = result * x.reshape(tuple(x.shape[own.index(letter)] if letter in own else 1 for letter in letters))
    order = sorted(letters, key=lambda letter: (letter in output, output.find(letter)))
    result = result.transpose([letters.index(letter) for letter in order])
    return result.sum(axis=tuple(range(len(order) - len(output)))) if len(order) > len(output) else result


def _eliminated(a, b):
    """The pivots of a square matrix a and the rows of a^-1 b, by elimination without exchanges: right where a is positive definite."""
    a = traced(a)
    if a.ndim != 2 or a.shape[0] != a.shape[1]:
        raise ValueError(f"A matrix has the shape {a.shape}; it must be square, and one alone, to be traced.")
    n = len(a)
    rows, right = list(a), list(b)
    for k in range(n):
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            rows[i], right[i] = rows[i] - factor * rows[k], right[i] - factor * right[k]
    for k in reversed(range(n)):
        right[k] = (right[k] - sum(rows[k][j] * right[j] for j in range(k + 1, n))) / rows[k][k]
    return [rows[k][k] for k in range(n)], right


def solution(a, b):
    import numpy as np

    return np.stack(_eliminated(a, traced(b))[1])


def inverse(a):
    import numpy as np

    return solution(a, np.eye(len(a)))


def determinant(a):
    return pool(_eliminated(a, [0.0] * len(a))[0]).prod()


def norm(x, ord=None, axis=None, keepdims=False):
    if ord not in (None, 2, "fro") or (ord == 2 and axis is None and len(x.shape) > 1):
        raise TypeError("np.linalg.norm can be traced as the 2-norm; write another norm out with np.abs, np.sum and avi.maximum.")
    return (x * x).sum(axis=axis, keepdims=keepdims).sqrt()
