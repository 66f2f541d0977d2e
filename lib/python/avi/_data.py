"""Objectives of data: formulas of products with large matrices, which are kept as matrices instead of number by number."""

from ._algebra import matrices
from ._formula import numbers_of, trace


class FormulaOfData:
    """f(x) = F(z), z = (x, A z, B z ...): F is a formula, and each of the matrices of numbers A, B ... is multiplied by some of the entries of
    z that come before. It serves minimise() as a Formula does."""

    def __init__(self, formula, kept, size):
        self._formula, self._kept, self.size = formula, kept, size
        self._size_of_z = size + sum(len(a) * (places.size // len(places)) for a, places in kept)

    parameters = property(lambda self: self._formula.parameters)

    def with_parameters(self, parameters):
        return FormulaOfData(self._formula.with_parameters(numbers_of(parameters)), self._kept, self.size)

    def _point(self, x):
        import numpy as np

        x = np.ravel(np.asarray(x, dtype=float))
        if len(x) != self.size:
            raise ValueError(f"Number of arguments of a formula is {len(x)}; it must be {self.size}.")
        z, last = np.empty(self._size_of_z), self.size
        z[:last] = x
        for a, places in self._kept:
            product = np.ravel(a @ z[places])
            first, last = last, last + product.size
            z[first:last] = product
        return z

    def _slopes(self, z):
        import numpy as np

        slopes, last = self._formula.gradient(z), self._size_of_z
        for a, places in reversed(self._kept):  # what is multiplied comes before its product
            first = last - len(a) * (places.size // len(places))
            np.add.at(slopes, places, a.T @ slopes[first:last].reshape((len(a),) + places.shape[1:]))
            last = first
        return slopes[: self.size].copy()

    def value(self, x):
        return self._formula.value(self._point(x))

    def gradient(self, x):
        return self._slopes(self._point(x))

    def __call__(self, x):
        z = self._point(x)
        return self._formula.value(z), self._slopes(z)


def objective(f, shape, parameters):
    """The formula of f(x) or f(x, c), of data where f takes products of large matrices with x."""
    import numpy as np

    size, kept = int(np.prod(shape)), []
    before = matrices.set((size, len(numbers_of(parameters)), kept))
    try:
        formula = trace(f, [shape], parameters, "f")
    finally:
        matrices.reset(before)
    return FormulaOfData(formula, kept, size) if kept else formula
