"""Measured profiles from the files of profilometers: text of columns, X3P and SDF.

The parsers of X3P (ISO 25178-72) and SDF (ISO 25178-71) are our own, in `surfaces`: surfalize needs
nine other packages, is under the GPL and reads no profiles from X3P; sdfio and x3pio need Python
3.11. The tests compare the parsers with all three.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import NamedTuple

import numpy as np

from . import surfaces
from ._numbers import FloatArray, one_of
from .errors import MeasuredFileError

__all__ = ["MeasuredProfile", "read_profile"]

# Units of length, in metres; the micro sign and the Greek mu are different characters.
_METRES = {
    "m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6, "nm": 1e-9, "in": 0.0254,
}  # fmt: skip
# Word in brackets or after a slash, as in `x [mm]`, `x (mm)` and `x / mm`.
_STATED = re.compile(r"[\[(/]\s*([^][()/\s]+)\s*(?:[\])]|$|(?=\s))")

# Delimiters of columns, in the order in which they are tried; None is white space.
_DELIMITERS = ("\t", ";", ",", None)


class MeasuredProfile(NamedTuple):
    """A profile from a file, for a `Spline`.

    Attributes
    ----------
    points : ndarray, shape (n, 2)
        Rows of x and z, lengths in the unit, by rising x.
    unit : str
        Unit of x and z; "" if a text states none.
    missing : int
        Number of points of the file that are left out, since they were not measured.

    Examples
    --------
    >>> import numpy as np
    >>> import linecontact as lc
    >>> lc.MeasuredProfile(np.zeros((2, 2)), "mm", 0).unit
    'mm'
    """

    points: FloatArray
    unit: str
    missing: int


def read_profile(
    path: str | PathLike[str],
    *,
    unit: str | None = None,
    row: int | None = None,
    columns: tuple[int, int] | None = None,
    file_units: tuple[str, str] | None = None,
    skip_missing: bool = False,
) -> MeasuredProfile:
    """Reads a measured profile from a text of columns, an X3P file or an SDF file.

    In a text, columns are separated by tabs, semicolons, commas or white space. Lines before the
    first line of numbers are the header, and may state units as in ``x [mm]; z [um]``. Numbers may
    have decimal commas. A profile that was measured from right to left is reversed. Heights are as
    in the file: upwards, out of the material. For an upper body the spline is to be `flipped`.

    Parameters
    ----------
    path : str or path-like
        File. X3P and SDF are told from texts by their first bytes.
    unit : {"m", "cm", "mm", "um", "nm", "in"}, optional
        Unit of the result. Default: that of x in the file, "m" for X3P and SDF.
    row : int, optional
        Profile to be read from a surface, counted from 1, through all layers.
    columns : (int, int), optional
        Columns of x and z in a text, counted from 1. Texts of two columns do not need them.
    file_units : (str, str), optional
        Units of x and z in a text, in place of those that its header states.
    skip_missing : bool
        True to leave out points that were not measured wherever they are: a spline then bridges
        the gaps. By default they are left out at the ends only; between others they are an error.

    Returns
    -------
    MeasuredProfile

    Raises
    ------
    linecontact.errors.MeasuredFileError
        With the file, the line or byte, and the reason.
    OSError
        If the file cannot be opened.

    Examples
    --------
    >>> import tempfile, pathlib
    >>> import linecontact as lc
    >>> file = pathlib.Path(tempfile.mkdtemp()) / "roller.csv"
    >>> _ = file.write_text("x [mm]; z [um]\\n" + "".join(f"{i / 10}; {5 * i * i}\\n" for i in range(-9, 10)))
    >>> profile = lc.read_profile(file)
    >>> profile.points[0].round(6).tolist(), profile.unit
    ([-0.9, 0.405], 'mm')
    >>> lc.Spline(profile.points).pieces
    18
    """
    name, data = fspath(path), Path(path).read_bytes()
    for words, pair in (("columns", columns), ("file_units", file_units)):
        if pair is not None and (isinstance(pair, str) or len(pair) != 2):
            raise TypeError(f"{words} is {pair!r}: give two, of x and z")
    for given in (*(file_units or ()), *([] if unit is None else [unit])):
        one_of(given, "unit", tuple(_METRES))
    kind = surfaces.kind_of(name, data)
    if (row if kind == "text" else columns or file_units) is not None:
        raise MeasuredFileError(name, f"is {kind}: columns and file_units are for texts, and row is for others")
    if kind == "text":
        points, lines, units = _text(name, data, columns, file_units)
    else:
        points, lines, units = surfaces.READERS[kind](name, data, row), [], ("m", "m")
    if unit is not None and not units[0]:
        raise MeasuredFileError(name, "states no units: give file_units, such as ('mm', 'um')")
    wanted = units[0] if unit is None else unit
    if wanted:
        points = points * [_METRES[given] / _METRES[wanted] for given in units]
    kept = _measured(name, points, lines, skip_missing)
    return MeasuredProfile(kept, wanted, len(points) - len(kept))


def _measured(name: str, points: FloatArray, lines: Sequence[int], skip: bool) -> FloatArray:
    """Returns the points that were measured, by rising x."""

    def fault(at: int | np.intp, reason: str) -> MeasuredFileError:
        line = lines[int(at)] if lines else None
        return MeasuredFileError(name, reason if lines else f"point {at + 1}: {reason}", line)

    if (infinite := np.flatnonzero(np.isinf(points).any(axis=1))).size:
        raise fault(infinite[0], "a number is infinite")
    measured = np.isfinite(points).all(axis=1)
    places = np.flatnonzero(measured)
    if places.size < 2:
        raise MeasuredFileError(name, f"{places.size} points were measured: a profile has two or more")
    gaps = np.setdiff1d(np.arange(places[0], places[-1]), places)
    if gaps.size and not skip:
        others = f"like {gaps.size - 1} others between the ends: skip_missing=True leaves them out"
        raise fault(gaps[0], f"not measured, {others}")
    x = points[places, 0]
    turn = 1 if x[-1] > x[0] else -1
    if (back := np.flatnonzero(turn * np.diff(x) <= 0.0)).size:
        there, here = x[back[0] : back[0] + 2]
        raise fault(places[back[0] + 1], f"x = {here:g} after {there:g}: x must rise throughout, or fall throughout")
    return points[places[::turn]]


def _text(
    name: str, data: bytes, columns: tuple[int, int] | None, file_units: tuple[str, str] | None
) -> tuple[FloatArray, list[int], tuple[str, str]]:
    """Returns the points of a text, the line of each, and the units."""
    lines = re.split(r"\r\n|\r|\n", _decoded(name, data))
    first, delimiter, width = _first_row(name, lines)
    if columns is None and width > 2:
        raise MeasuredFileError(name, f"{width} columns: give those of x and z, as columns=(1, {width})", first + 1)
    columns = columns or (1, 2)
    if min(columns) < 1 or max(columns) > width or columns[0] == columns[1]:
        raise MeasuredFileError(name, f"columns are {columns}: give two of 1 to {width}", first + 1)
    points, places, marks = [], [], set[str]()
    for line, content in enumerate(lines[first:], first + 1):
        cells = _cells(content, delimiter)
        if not any(cells) or cells[0].startswith("#"):
            continue
        if len(cells) < width or any(cells[width:]):
            raise MeasuredFileError(name, f"{len(cells)} columns: there are {width} in line {first + 1}", line)
        chosen = [cells[column - 1] for column in columns]
        numbers = [_number(cell) for cell in chosen]
        if None in numbers:
            raise MeasuredFileError(name, f"{' and '.join(map(repr, chosen))} are no two numbers", line)
        marks |= {mark for mark in ".," for cell in chosen if mark in cell}
        if len(marks) > 1:
            raise MeasuredFileError(name, "numbers with a decimal point, and others with a comma", line)
        points.append(numbers)
        places.append(line)
    units = file_units or _units(name, lines[:first], delimiter, columns, width)
    return np.array(points, dtype=np.float64), places, units


def _decoded(name: str, data: bytes) -> str:
    is_wide = data.startswith((b"\xff\xfe", b"\xfe\xff"))
    try:
        text = data.decode("utf-16" if is_wide else "utf-8-sig")
    except UnicodeDecodeError as error:
        if is_wide:
            raise MeasuredFileError(name, f"no text in UTF-16: {error.reason}", byte=error.start) from None
        # Some programs write the micro sign in the code of Windows, of which this is a part.
        text = data.decode("latin-1")
    if "\0" in text:
        raise MeasuredFileError(name, "a text has no zero bytes: it may be of another format", byte=data.index(b"\0"))
    return text


def _cells(line: str, delimiter: str | None) -> list[str]:
    return [cell.strip() for cell in line.split(delimiter)]


def _number(cell: str) -> float | None:
    """Returns the number in a cell, NaN for one that was not measured, or None."""
    try:
        return None if "_" in cell else float(cell.replace(",", ".").replace("−", "-") or "nan")
    except ValueError:
        return None


def _first_row(name: str, lines: Sequence[str]) -> tuple[int, str | None, int]:
    """Returns the first line of numbers, the delimiter of its columns, and their number."""
    for at, line in enumerate(lines):
        for delimiter in _DELIMITERS:
            cells = _cells(line, delimiter)
            while len(cells) > 2 and not cells[-1]:
                cells.pop()
            if len(cells) > 1 and cells[0] and None not in map(_number, cells):
                return at, delimiter, len(cells)
    single = (at for at, line in enumerate(lines, 1) if line.strip() and _number(line.strip()) is not None)
    raise MeasuredFileError(name, "no line has two numbers: a profile has columns of x and z", next(single, None))


def _units(
    name: str, header: Sequence[str], delimiter: str | None, columns: tuple[int, int], width: int
) -> tuple[str, str]:
    """Returns the units of x and z that the header states; two empty ones if it states none."""
    for line in range(len(header), 0, -1):
        content = header[line - 1]
        # White space around a bracket parts no columns.
        cells = _cells(content if delimiter else re.sub(r"\s*([\[(/])\s*", r"\1", content), delimiter)
        if delimiter is None and len(cells) != width:
            cells = _STATED.findall(content)
        if max(columns) <= len(cells):
            stated = [_STATED.findall(cells[column - 1]) for column in columns]
            words = ([cells[column - 1], *found] for column, found in zip(columns, stated, strict=True))
            x, z = (next((word.lower() for word in each if word.lower() in _METRES), "") for each in words)
            if all(stated) and not x and not z:
                raise MeasuredFileError(name, f"units {stated[0][0]!r} and {stated[1][0]!r}: give file_units", line)
            if x and z:
                return x, z
            if x or z:
                raise MeasuredFileError(name, "only one of x and z has a unit here: give file_units", line)
    return "", ""
