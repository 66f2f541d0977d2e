"""Objectives of data: formulas of products with large matrices, which are kept as matrices instead of number by number."""

from ._algebra import matrices
from ._formula import numbers_of, trace


class FormulaOfData:
    """f(x) = F(x, A x, B x ...): F is a formula, and A, B ... are matrices of numbers. It serves minimise() as a Formula does."""

    def __init__(self, formula, kept, size):
        self._formula, self._kept, self.size = formula, kept, size

    parameters = property(lambda self: self._formula.parameters)

    def with_parameters(self, parameters):
        return FormulaOfData(self._formula.with_parameters(numbers_of(parameters)), self._kept, self.size)

    def _point(self, x):
        import numpy as np

        x = np.ravel(np.asarray(x, dtype=float))
        if len(x) != self.size:
            raise ValueError(f"Number of arguments of a formula is {len(x)}; it must be {self.size}.")
        return np.concatenate([x, *(np.ravel(a @ x[places]) for a, places in self._kept)])

    def _slopes(self, z):
        import numpy as np

        all_slopes = self._formula.gradient(z)
        slopes, first = all_slopes[: self.size].copy(), self.size
        for a, places in self._kept:
            size = len(a) * (places.size // len(places))
            np.add.at(slopes, places, a.T @ all_slopes[first : first + size].reshape((len(a),) + places.shape[1:]))
            first += size
        return slopes

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
    before = matrices.set((size, kept))
    try:
        formula = trace(f, [shape], parameters, "f")
    finally:
        matrices.reset(before)
    return FormulaOfData(formula, kept, size) if kept else formula
