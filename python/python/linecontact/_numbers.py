"""Conversion of arguments to numbers and arrays; results keep the shape of the argument."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection, Sequence
from difflib import get_close_matches
from functools import wraps
from typing import Any, ParamSpec, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

FloatArray: TypeAlias = npt.NDArray[np.float64]
"""Array of results."""

Numbers: TypeAlias = Sequence[float] | Sequence[Sequence[float]] | npt.NDArray[Any]
"""Argument that is converted to an array of numbers."""

Range: TypeAlias = tuple[float, float]
"""First and last number of a range."""

_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")


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
    """Converts to one number; refuses text, as read from a file or a form, arrays, True and False."""
    if not isinstance(given, str | bytes | bool | np.bool_):
        try:
            return float(given)
        except (TypeError, ValueError):
            pass
        except OverflowError:
            raise ValueError(f"{name} is too large for a float: give one number below 1.8e308") from None
    raise TypeError(f"{name} is {given!r}: give one number")


def as_range(given: Any, name: str) -> Range:
    """Converts to a tuple of two numbers."""
    try:
        first, last = given
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {given!r}: give two numbers, such as (-1.0, 1.0)") from None
    return as_number(first, name), as_number(last, name)


def as_numbers(given: Any, name: str) -> FloatArray:
    """Converts to an array of numbers; refuses text, True and False, and masked numbers."""
    if np.ma.is_masked(given):
        count = np.sum(np.ma.getmaskarray(given))
        raise ValueError(f"{name} has {count} masked numbers: leave them out, or fill them")
    found = np.asarray(given)
    if given is None or found.dtype.kind in "USb":
        raise TypeError(f"{name} is {given!r}: give numbers")
    if found.dtype.kind == "c":
        raise TypeError(f"{name} has complex numbers: give real ones")
    return np.asarray(found, dtype=np.float64)


def as_count(given: Any, name: str, least: int, most: int) -> int:
    """Converts to a whole number of a range; refuses any other."""
    if isinstance(given, int | np.integer) and not isinstance(given, bool) and least <= given <= most:
        return int(given)
    raise ValueError(f"{name} is {given!r}: give a whole number from {least} to {most}")


def one_of(given: Any, name: str, allowed: Sequence[str]) -> str:
    """Returns a word of a choice; refuses any other."""
    if isinstance(given, str) and given in allowed:
        return given
    raise ValueError(f"{name} is {given!r}: give one of {', '.join(map(repr, allowed))}")


def as_side(given: Any, is_needed: bool = False) -> Any:
    """Returns the name of a body; None if none is named, and none is needed."""
    if given in ("lower", "upper") or (given is None and not is_needed):
        return given
    raise ValueError(f"body is {given!r}: give 'lower' or 'upper'")


def as_references(given: Any) -> Any:
    """Converts to an x, and the kinds and lengths of two references."""
    try:
        x, (below, depth), (above, height) = given
    except (TypeError, ValueError):
        such = "References(0.0, Reference.depth(30.0), Reference.disc(10.0))"
        raise TypeError(f"references are {given!r}: give an x and those of both bodies, such as {such}") from None
    kinds = [one_of(kind, "the kind of a reference", ("depth", "disc", "length")) for kind in (below, above)]
    lengths = as_number(depth, "a reference"), as_number(height, "a reference")
    return as_number(x, "x"), *zip(kinds, lengths, strict=True)


def refusal(name: str, says: str, **numbers: Any) -> Exception:
    """Returns an error of the library with its numbers."""
    from . import errors

    error: Exception = getattr(errors, name)(says)
    vars(error).update(numbers)
    return error


def refuse_unknown(given: Collection[str], allowed: Sequence[str], of: str) -> None:
    """Refuses keyword arguments that are not allowed, and names the allowed ones."""
    for name in given:
        if name not in allowed:
            near = get_close_matches(name, allowed, 1)
            meant = f"did you mean {near[0]}? T" if near else "t"
            raise TypeError(f"{of} has no argument {name}: {meant}here are {', '.join(allowed)}")


def named(function: Callable[_Arguments, _Result]) -> Callable[_Arguments, _Result]:
    """Decorates a function so that it tells what arguments it has, and which are given by name."""
    parameters = inspect.signature(function).parameters.values()
    allowed = [one.name for one in parameters if one.name != "self"]
    by_name = [one.name for one in parameters if one.kind is one.KEYWORD_ONLY]
    takes_more = any(one.kind is one.VAR_KEYWORD for one in parameters)
    places = sum(one.kind is one.POSITIONAL_OR_KEYWORD for one in parameters)
    such = "load" if takes_more or "load" in by_name else next(iter(by_name), "")
    of = function.__qualname__.removesuffix(".__init__")

    @wraps(function)
    def checked(*args: _Arguments.args, **given: _Arguments.kwargs) -> _Result:
        if such and len(args) > places:
            raise TypeError(f"{of} takes {args[places]!r} by name, as in {such}={args[places]!r}")
        if not takes_more:
            refuse_unknown(given, allowed, of)
        return function(*args, **given)

    return checked


def each(of: Callable[[FloatArray], FloatArray], x: Any) -> float | FloatArray:
    """Evaluates a function at `x`: a number for a number, an array for an array."""
    places = as_numbers(x, "x")
    values = of(places.reshape(-1))
    return float(values[0]) if places.ndim == 0 else values.reshape(places.shape)
