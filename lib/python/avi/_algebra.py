"""Products of traced arrays and linear algebra: what NumPy does in compiled code for numbers alone."""

from contextvars import ContextVar

from ._avi import Traced, pool, traced, where

matmul = Traced.__matmul__

LARGE = 2000  # products of so many numbers are worth a call of a matrix product
matrices = ContextVar("matrices", default=(0, 0, None))  # of the objective that is being traced the numbers of x and of parameters, and its matrices


def by_matrix(a, x):
    """The product of a large matrix of numbers with entries of x, or of such products, where that is kept as it is."""
    size, parameters, kept = matrices.get()
    if kept is None or isinstance(a, Traced) or a.dtype.kind not in "biuf" or hasattr(a, "hardmask") or hasattr(a, "getA1") or a.ndim != 2 or a.size * (x.size // len(x)) < LARGE or a.shape[1] != len(x):
        return None
    import numpy as np

    places = np.array(x._places, dtype=int)
    if not places.size or np.any((places >= size) & (places < size + parameters)):  # parameters may change
        return None
    places[places >= size] -= parameters  # they come last when f is evaluated
    kept.append((np.array(a, dtype=float), places.reshape(x.shape)))
    return x._more(a.shape[:1] + x.shape[1:])


def times(a, b):
    """a @ b, with a traced."""
    if isinstance(b, Traced) or getattr(b, "size", 0) < LARGE or b.ndim != 2 or a.ndim not in (1, 2):
        return matmul(a, b)
    kept = by_matrix(b.T, a.T)
    return matmul(a, b) if kept is None else kept.T


def product(a, b):
    if not (a.ndim and b.ndim) or a.shape[-1] != b.shape[-2 if b.ndim > 1 else 0]:
        raise ValueError(f"The product @ of arrays of shapes {a.shape} and {b.shape} cannot be traced: the inner lengths have to agree.")
    if b.ndim == 1:
        return (a * b).sum(axis=-1)
    return ((a[..., :, None] if a.ndim > 1 else a[:, None]) * (b[..., None, :, :] if a.ndim > 1 else b)).sum(axis=-2)


def tensordot(a, b, axes=2):
    """The sum of products over axes of both, as a product of matrices."""
    import numpy as np

    size, other = np.ndim(a), np.ndim(b)
    first, second = (range(size - axes, size), range(axes)) if np.ndim(axes) == 0 else (np.atleast_1d(each) for each in axes)
    first, second = [int(i) % size for i in first], [int(i) % other for i in second]
    if [np.shape(a)[i] for i in first] != [np.shape(b)[i] for i in second]:
        raise ValueError(f"np.tensordot of arrays of shapes {np.shape(a)} and {np.shape(b)} cannot be traced with axes={axes}: the lengths of what is summed have to agree.")
    left, right = ([i for i in range(n) if i not in summed] for n, summed in ((size, first), (other, second)))
    lengths = [np.shape(a)[i] for i in left], [np.shape(b)[i] for i in right]
    rows = np.transpose(a, left + first).reshape(int(np.prod(lengths[0])), -1)
    columns = np.transpose(b, second + right).reshape(-1, int(np.prod(lengths[1])))
    return (rows @ (columns[:, 0] if not right else columns)).reshape(tuple(lengths[0] + lengths[1]))


def einsum(subscripts, *operands, optimize=False):
    if not isinstance(subscripts, str):
        raise TypeError("np.einsum can be traced with subscripts as a string first, such as 'ij,j->i'.")
    given, operands = operands, [traced(x) for x in operands]
    inputs, _, output = subscripts.replace(" ", "").partition("->")
    terms = inputs.split(",")
    letters = sorted(set(inputs) - {","})
    if "->" not in subscripts:
        output = "".join(letter for letter in letters if inputs.count(letter) == 1)
    if [len(term) for term in terms] != [x.ndim for x in operands] or not all(map(str.isalpha, letters)):
        raise TypeError(f"np.einsum({subscripts!r}) cannot be traced: give one letter for each axis of every array.")
    import numpy as np

    if len(terms) == 2 and all(len(set(term)) == len(term) for term in terms):
        summed = sorted((set(terms[0]) & set(terms[1])) - set(output))
        kept = "".join(letter for term in terms for letter in term if letter not in summed)
        if len(summed) == 1 and len(kept) < 3 and sorted(kept) == sorted(output):  # a product with a matrix
            result = tensordot(*given, axes=[term.index(summed[0]) for term in terms])
            return result if kept == output else result.T
    if len(terms) == 1 and set(output) == set(letters):  # nothing is summed: a view
        moved = lambda x: np.einsum(f"{terms[0]}->{output}", x)
        return given[0]._view(moved(given[0]._numbers)) if isinstance(given[0], Traced) else moved(given[0])
    result = 1.0
    for term, x in zip(terms, operands):
        own = sorted(set(term))
        x = x._take(np.einsum(f"{term}->{''.join(own)}", x._numbers))
        result = result * x.reshape(tuple(x.shape[own.index(letter)] if letter in own else 1 for letter in letters))
    order = sorted(letters, key=lambda letter: (letter in output, output.find(letter)))
    result = result.transpose([letters.index(letter) for letter in order])
    return result.sum(axis=tuple(range(len(order) - len(output)))) if len(order) > len(output) else result


def _square(a):
    """The rows of a square matrix as lists of numbers."""
    a = traced(a)
    if a.ndim != 2 or a.shape[0] != a.shape[1]:
        raise ValueError(f"A matrix has the shape {a.shape}; it must be square, and one alone, to be traced.")
    return [list(row) for row in a]


def _in_order(swap, a, b):
    """(a, b), or (b, a) where they are to change places."""
    return where(swap, b, a), where(swap, a, b)


def _with_pivot(rows, k):
    """The rows, in whose k-th column the entry of largest magnitude has come to the k-th row; the order is found with the numbers."""
    largest = abs(rows[k][k])
    for i in range(k + 1, len(rows)):
        swap = largest < abs(rows[i][k])
        largest = where(swap, abs(rows[i][k]), largest)
        for j in range(k, len(rows[k])):
            rows[k][j], rows[i][j] = _in_order(swap, rows[k][j], rows[i][j])


def _eliminate(rows, k):
    for i in range(k + 1, len(rows)):
        factor = rows[i][k] / rows[k][k]
        for j in range(k + 1, len(rows[k])):
            rows[i][j] = rows[i][j] - factor * rows[k][j]


def solution(a, b):
    """a^-1 b by elimination with row exchanges."""
    rows, b = _square(a), traced(b)
    n = len(rows)
    if b.ndim not in (1, 2) or len(b) != n:
        raise ValueError(f"np.linalg.solve(a, b) of a matrix of {n} rows has b of the shape {b.shape}; it must be ({n},) or ({n}, m).")
    for row, right in zip(rows, b.reshape(n, -1)):
        row += list(right)
    for k in range(n):
        _with_pivot(rows, k)
        _eliminate(rows, k)
    for k in reversed(range(n)):
        for j in range(n, len(rows[k])):
            rows[k][j] = (rows[k][j] - sum(rows[k][i] * rows[i][j] for i in range(k + 1, n))) / rows[k][k]
    return pool([x for row in rows for x in row[n:]]).reshape(b.shape)


def inverse(a):
    import numpy as np

    return solution(a, np.eye(len(a)))


def determinant(a):
    """Written out up to 3 x 3, so that a singular matrix has its slopes; larger ones by elimination with exchanges of rows and columns,
    of which a pivot that is zero says that a block of at least 4 x 4 is: then all slopes are zero, too."""
    rows, result = _square(a), 1.0
    while len(rows) > 3:
        for i in range(1, len(rows)):
            size, other = (pool([abs(x) for x in row]).max() for row in (rows[0], rows[i]))
            swap = size < other
            pairs = [_in_order(swap, x, y) for x, y in zip(rows[0], rows[i])]
            rows[0], rows[i] = [x for x, _ in pairs], [where(swap, -y, y) for _, y in pairs]
        for j in range(1, len(rows)):
            swap = abs(rows[0][0]) < abs(rows[0][j])
            for row in rows:
                row[0], other = _in_order(swap, row[0], row[j])
                row[j] = where(swap, -other, other)
        pivot = rows[0][0]
        result = result * pivot
        rows[0][0] = where(abs(pivot) > 0.0, pivot, 1.0)
        _eliminate(rows, 0)
        rows = [row[1:] for row in rows[1:]]
    if len(rows) == 1:
        return result * rows[0][0]
    if len(rows) == 2:
        (a, b), (c, d) = rows
        return result * (a * d - b * c)
    (a, b, c), (d, e, f), (g, h, i) = rows
    return result * (a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g))


def norm(x, ord=None, axis=None, keepdims=False):
    of_matrix = len(x.shape) > 1 if axis is None else hasattr(axis, "__len__") and len(axis) > 1
    if ord not in (None, 2, "fro") or (ord == 2 and of_matrix):
        raise TypeError(
            "np.linalg.norm can be traced as the 2-norm of vectors, and as the root of the sum of squares of a matrix; write another norm out "
            "with np.abs, np.sum and avi.maximum."
        )
    return (x * x).sum(axis=axis, keepdims=keepdims).sqrt()
