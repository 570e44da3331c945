"""Conversion of arguments to numbers and arrays; results keep the shape of the argument."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

FloatArray: TypeAlias = npt.NDArray[np.float64]
"""Array of results."""

Numbers: TypeAlias = Sequence[float] | Sequence[Sequence[float]] | npt.NDArray[Any]
"""Argument that is converted to an array of numbers."""

Range: TypeAlias = tuple[float, float]
"""First and last number of a range."""


class Unchanging:
    """Base class of immutable objects: once `_SEAL` is set, assigning an attribute raises."""

    __slots__ = ()
    _SEAL = ""

    def _refuse(self, name: str) -> None:
        if hasattr(self, self._SEAL):
            kind = type(self).__name__
            raise AttributeError(f"{name} cannot be set: a {kind} does not change, make another")

    def __setattr__(self, name: str, value: object) -> None:
        self._refuse(name)
        super().__setattr__(name, value)

    def __delattr__(self, name: str) -> None:
        self._refuse(name)
        super().__delattr__(name)


def as_number(given: Any, name: str) -> float:
    """Converts to one number; refuses text, as read from a file or a form, and arrays."""
    if not isinstance(given, str | bytes):
        try:
            return float(given)
        except (TypeError, ValueError):
            pass
    raise TypeError(f"{name} is {given!r}: give one number")


def as_range(given: Any, name: str) -> Range:
    """Converts to a tuple of two numbers."""
    try:
        first, last = given
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {given!r}: give two numbers, such as (-1.0, 1.0)") from None
    return as_number(first, name), as_number(last, name)


def as_numbers(given: Any, name: str) -> FloatArray:
    """Converts to an array of numbers; refuses text."""
    found = np.asarray(given)
    if found.dtype.kind in "US":
        raise TypeError(f"{name} is {given!r}: give numbers")
    return np.asarray(found, dtype=np.float64)


def each(of: Callable[[FloatArray], FloatArray], x: Any) -> Any:
    """Evaluates a function at `x`: a number for a number, an array for an array."""
    places = as_numbers(x, "x")
    values = of(places.reshape(-1))
    return float(values[0]) if places.ndim == 0 else values.reshape(places.shape)
