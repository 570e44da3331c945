"""Arrays of any shape in, arrays of the same shape out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

FloatArray: TypeAlias = npt.NDArray[np.float64]
"""What comes back of an array."""

Numbers: TypeAlias = Sequence[float] | Sequence[Sequence[float]] | npt.NDArray[Any]
"""What is taken for an array of numbers."""

Range: TypeAlias = tuple[float, float]
"""From one number to another."""


def as_range(given: Sequence[float]) -> Range:
    """Two numbers as a tuple."""
    first, last = given
    return float(first), float(last)


def each(of: Callable[[FloatArray], FloatArray], x: Any) -> Any:
    """The values at `x`: a number of a number, an array of an array."""
    places = np.asarray(x, dtype=np.float64)
    values = of(places.reshape(-1))
    return float(values[0]) if places.ndim == 0 else values.reshape(places.shape)
