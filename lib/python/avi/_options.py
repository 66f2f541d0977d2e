"""The options of a call, which it passes on to the library by name."""

import os

from . import _avi

_KINDS = {
    "monitor": "a name or a function",
    "checkpoint": "a path",
    **dict.fromkeys(("seconds", "h", "checkpoint_seconds"), "a number"),
    **dict.fromkeys(("sweeps", "steps", "order"), "a whole number"),
}


_HERE = {  # SciPy's names of options
    "t_eval": "t", "dense_output": "dense", "rtol": "tol", "atol": "tol", "terminal": "stop", "args": "parameters", "maxiter": "iterations",
    "gtol": "absolute", "tol": "relative",
}  # fmt: skip


def unknown_option(name, names, function):
    """The error for an option that there is not, with its name here where SciPy has it under another."""
    here = f", which is {_HERE[name]}= here" if _HERE.get(name) in names else ""
    return TypeError(f"{function}() has no option {name!r}{here}; there are {', '.join(names)}.")


def set_options(chosen, options, names, function, further):
    """Sets the fields of these names. Raises TypeError for another one, with the function's further arguments."""
    for name, value in options.items():
        if name not in names:
            raise unknown_option(name, (*further, *names), function)
        if value is not None:
            kind = _KINDS.get(name) or f"of the type {type(getattr(chosen, name)).__name__}"
            try:
                setattr(chosen, name, _avi.Monitor(value) if name == "monitor" else os.fspath(value) if name == "checkpoint" else value)
            except TypeError:
                if isinstance(value, int) and kind in ("of the type int", "a whole number"):
                    raise ValueError(f"The option {name} of {function}() is {value}; so large a number is not possible.") from None
                raise TypeError(f"The option {name} of {function}() is {value!r}; it must be {kind}.") from None
    return chosen
