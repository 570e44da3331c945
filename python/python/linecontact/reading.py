"""Measured profiles from the files of profilometers: text of columns, X3P and SDF.

The parsers of X3P (ISO 25178-72) and SDF (ISO 25178-71) are our own, in `surfaces`: surfalize needs
nine other packages, is under the GPL and reads no profiles from X3P; sdfio and x3pio need Python
3.11. The tests compare the parsers with all three.
"""

from __future__ import annotations

import csv
import re
import warnings
from collections.abc import Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from . import surfaces
from ._numbers import FloatArray, Range, as_number, as_range, one_of
from .errors import MeasuredFileError

__all__ = ["MeasuredProfile", "read_profile"]

# Units of length, in metres.
_METRES = {
    "m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "å": 1e-10, "in": 0.0254, "mil": 2.54e-5,
    "uin": 2.54e-8,
}  # fmt: skip
# Their names in headers, singular and in American spelling, as `_symbol` makes them.
_NAMES = {
    "meter": "m", "centimeter": "cm", "millimeter": "mm", "micrometer": "um", "micron": "um", "nanometer": "nm",
    "angstrom": "å", "inch": "in", "inche": "in", "mil": "mil", "thou": "mil", "microinch": "uin", "microinche": "uin",
}  # fmt: skip
# Word in brackets, after a slash or after "in", as in `x [mm]`, `x (mm)`, `x / mm` and `x in mm`.
_STATED = re.compile(r"(?:[\[(/]|\bin\s)\s*([^][()/\s,]+)\s*(?:[\])]|$|(?=[\s,]))")
# What begins a remark, not within a cell: the rest of the line is none of the data.
_REMARK = re.compile(r"(?:^|(?<=[\s;,]))[#%!].*")
# Marks for a number that is none: those of Windows programs, of numbers too long for their column, and words.
_NO_NUMBER = re.compile(
    r"[+-]?1[.,]#(?:[QS]?NAN|IND|INF)0*|\*+|-+|\?+|n\.?/?a\.?|null|none|no ?data|missing|invalid|bad", re.IGNORECASE
)
# What begins like a number, whatever follows, but no date and no time.
_LIKE_A_NUMBER = re.compile(r"(?!\d{1,4}([-./])\d{1,2}\1\d{2,4}|\d{1,2}:\d\d)[-+−]?[.,]?\d")
# What may be one number with a separator of thousands, and a number with a word behind it.
_GROUPED = re.compile(r"(?<![\d.,])\d{1,3}(?:[\s'’]\d{3}(?!\d)(?:\.\d+)?|,\d{3}\.\d+|\.\d{3},\d+)")
_WITH_WORD = re.compile(r"[\d.,]*\d\s*([^\W\d_]+)")
# Exponents of Fortran, as in `1.0D-02`.
_FORTRAN = re.compile(r"(?<=[\d.])[dD](?=[+-]?\d)")
# Names of x and of heights in headers, as `_bare` makes them.
_ALONG = re.compile(
    r"x|(?:x[-_]?)?(?:pos(?:ition)?|dist(?:ance)?|length|weg|strecke|l(?:ä|ae)nge|abstand|way|path)\.?(?:[-_]?x)?|lateral|abs[cz]iss[ae]"
    r"|travers?e?|travel"
)
_ACROSS = re.compile(r"(?:profil|z[-_]?)?(?:h(?:ö|oe|o)hen?|height|z)(?:[-_]?(?:z|wert|value))?")
# Names of heights into the material.
_DEPTH = re.compile(r"(?:z[-_]?)?(?:tiefe|depth)(?:[-_]?z)?")
# Words of a row that is none of the points.
_SUMMARY = re.compile(r"(?:mean|average|avg|mittel(?:wert)?|median|sum(?:me)?|total|count|anzahl|std(?:ev)?|rms)\.?", re.IGNORECASE)
# Most rows of a footer of numbers, such as the count and the mean of the points.
_FOOTER = 8

# Delimiters of columns, in the order in which they are tried; None is white space.
_DELIMITERS = ("\t", ";", ",", None)


class _Head(NamedTuple):
    """A line of a header, with its cells by the delimiter of the table, and by all, best ones first."""

    line: int
    cells: list[str]
    ways: list[list[str]]


class MeasuredProfile(NamedTuple):
    """A profile from a file, for a `Spline`; `cut`, `levelled` and `shifted` return another.

    Attributes
    ----------
    points : ndarray, shape (n, 2)
        Rows of x and z, lengths in the unit, by rising x.
    unit : str
        Unit of x and z; "" if a text states none, which you are warned of.
    missing : int
        Number of points of the file that are left out, since they were not measured.

    Examples
    --------
    >>> import numpy as np
    >>> import linecontact as lc
    >>> x = np.linspace(-3.0, 3.0, 7)
    >>> tilted = lc.MeasuredProfile(np.column_stack([x, 2.0 + 0.1 * x - x**4 / 100]), "mm", 0)
    >>> tilted.levelled().cut(-1.0, 1.0).shifted(across=-0.3).points.round(4).tolist()
    [[-1.0, -0.03], [0.0, -0.02], [1.0, -0.03]]
    """

    points: FloatArray
    unit: str
    missing: int

    def cut(self, first: float, last: float) -> MeasuredProfile:
        """Returns the part from `first` to `last` along x.

        Cut before smoothing: a `Spline` has one smoothing for all its points.
        """
        x, inside = self.points[:, 0], self.points[self._within((first, last))]
        if len(inside) < 2:
            raise ValueError(f"cut from {first:g} to {last:g} leaves {_counted(len(inside), 'point')}: x is from {x[0]:g} to {x[-1]:g}")
        return self._replace(points=inside)

    def levelled(self, *parts: Range) -> MeasuredProfile:
        """Subtracts a straight line from the heights: that of the least squares, through zero height.

        The line is fitted to `parts`, ranges of x such as the plane lands beside a groove, or to
        all points. A slope of a few degrees is taken off in this way; to turn a body by more, use
        `Spline(...).rotated`.
        """
        x, z = self.points.T
        is_fitted = np.full(len(x), not parts)
        for part in parts:
            is_fitted |= self._within(part)
        if np.sum(is_fitted) < 2:
            raise ValueError(f"parts {parts} have {_counted(np.sum(is_fitted), 'point')}: a line is fitted to two or more")
        middle = np.mean(x[is_fitted])
        line = np.polynomial.Polynomial.fit(x[is_fitted] - middle, z[is_fitted], 1)
        return self._replace(points=np.column_stack([x, z - line(x - middle)]))

    def shifted(self, along: float = 0.0, across: float = 0.0) -> MeasuredProfile:
        """Adds `along` to x and `across` to the heights."""
        by = as_number(along, "along"), as_number(across, "across")
        if not np.isfinite(by).all():
            raise ValueError(f"along, across are {by}: give finite lengths")
        return self._replace(points=self.points + by)

    def _within(self, part: Range) -> npt.NDArray[np.bool_]:
        first, last = as_range(part, "a part of x")
        if not first <= last:
            raise ValueError(f"a part of x is from {first:g} to {last:g}: give its ends, the left one first")
        return (first <= self.points[:, 0]) & (self.points[:, 0] <= last)


def read_profile(
    path: str | PathLike[str],
    *,
    unit: str | None = None,
    row: int | None = None,
    columns: tuple[int, int] | tuple[str, str] | None = None,
    file_units: tuple[str, str] | None = None,
    skip_missing: bool = False,
    facing: Literal["up", "down"] | None = None,
) -> MeasuredProfile:
    """Reads a measured profile from a text of columns, an X3P file or an SDF file.

    In a text, columns are separated by tabs, semicolons, commas or white space. Lines before the
    first line of numbers are the header, and may state units as in ``x [mm]; z [um]``; lines of
    words after the last are left out, and so are a few numbers behind an empty line with which no
    column goes on, such as their count, and what follows ``#``, ``%`` or ``!``. Numbers may have
    decimal commas, but no separators of thousands, which are refused where they can be told: a lone
    ``-85,000`` is a decimal comma, and without a header two columns. A profile that was measured from right to left
    is reversed. Heights are as in the file: upwards, out of the material. For an upper body the
    spline is to be `flipped`.

    Parameters
    ----------
    path : str or path-like
        File. X3P and SDF are told from texts by their first bytes.
    unit : {"m", "cm", "mm", "um", "nm", "å", "in", "mil", "uin"}, optional
        Unit of the result. Default: that of x in the file, "m" for X3P and SDF.
    row : int, optional
        Profile to be read from a surface, counted from 1, through all layers.
    columns : (int, int) or (str, str), optional
        Columns of x and z in a text, counted from 1, or their names in the header, with or without
        the unit. Texts of two columns do not need them: z comes first where a header says so, as in
        ``Height; Position`` and ``Höhe; Weg``.
    file_units : (str, str), optional
        Units of x and z in a text, in place of those that its header states; you are warned if they
        differ.
    skip_missing : bool
        True to leave out points that were not measured wherever they are: a spline then bridges
        the gaps. By default they are left out at the ends only; between others they are an error.
        Empty cells, NaN, infinite numbers, and marks such as ``***``, ``---`` and ``N/A`` were not
        measured.
    facing : {"up", "down"}, optional
        Part to be kept of a profile whose x turns back, as that of a flange: what is seen from
        above, which is what can touch, or from below where the file has heights into the
        material. A spline bridges the cliffs of that part, as at an overhang: cut there. By default
        an x that turns back is an error.

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
    for words, pair, kind, such in (("columns", columns, int | np.integer | str, (1, 2)), ("file_units", file_units, str, ("mm", "um"))):
        if pair is not None and (np.size(pair) != 2 or not all(isinstance(one, kind) for one in pair)):
            raise TypeError(f"{words} is {pair!r}: give two, of x and z, such as {such}")
    unit = None if unit is None else _known(unit)
    file_units = None if file_units is None else (_known(file_units[0]), _known(file_units[1]))
    if facing is not None:
        one_of(facing, "facing", ("up", "down"))
    form = surfaces.kind_of(name, data)
    if (row if form == "text" else columns or file_units) is not None:
        raise MeasuredFileError(name, f"is {form}: columns and file_units are for texts, and row is for others")
    if form == "text":
        points, lines, units, hint = _text(name, data, columns, file_units)
    else:
        points, lines, units, hint = surfaces.READERS[form](name, data, row), [], ("m", "m"), ""
    if unit is not None and not units[0]:
        raise MeasuredFileError(name, "states no units: give file_units, such as ('mm', 'um')")
    wanted = units[0] if unit is None else unit
    if not wanted:
        says = "states no units: heights are taken to be in that of x. file_units=('mm', 'um') states those of x and z"
        warnings.warn(f"{name} {says}", stacklevel=2)
    else:
        points = points * [_METRES[given] / _METRES[wanted] for given in units]
    places = _measured(name, points, lines, skip_missing)
    missing = len(points) - len(places)
    if facing is not None:
        return MeasuredProfile(_facing(points[places], 1.0 if facing == "up" else -1.0), wanted, missing)
    x = points[places, 0]
    turn = 1 if np.median(np.diff(x)) > 0.0 else -1
    if (back := np.flatnonzero(turn * np.diff(x) <= 0.0)).size:
        there, here = x[back[0] : back[0] + 2]
        reason = f"x = {here:g} after {there:g}: x must rise throughout, or fall throughout{hint}"
        is_last = len(x) > 4 and back[0] == len(x) - 2
        remedy = "leave the line out if it is a count or a mean" if is_last else "facing='up' keeps what is seen from above"
        raise _fault(name, lines, int(places[back[0] + 1]), f"{reason}; {remedy}")
    for end, where, beside, other in ((-1, "after", -2, 0), (0, "before", 1, -1)):
        if abs(x[end] - x[beside]) > 2.0 * abs(x[beside] - x[other]) and len(x) > 4:
            reason = f"x = {x[end]:g} {where} {x[beside]:g} is farther off than the profile is long"
            raise _fault(name, lines, int(places[end]), f"{reason}: leave the line out if it is a count or a mean")
    return MeasuredProfile(points[places[::turn]], wanted, missing)


def _counted(count: int, what: str) -> str:
    return f"{count} {what}{'' if count == 1 else 's'}"


def _fault(name: str, lines: Sequence[int], at: int, reason: str) -> MeasuredFileError:
    """Returns the error at a point."""
    return MeasuredFileError(name, reason if lines else f"point {at + 1}: {reason}", lines[at] if lines else None)


def _measured(name: str, points: FloatArray, lines: Sequence[int], skip: bool) -> npt.NDArray[np.intp]:
    """Returns the places of the points that were measured."""
    places = np.flatnonzero(np.isfinite(points).all(axis=1))
    if places.size < 2:
        was = "was" if places.size == 1 else "were"
        raise MeasuredFileError(name, f"{_counted(places.size, 'point')} {was} measured: a profile has two or more")
    gaps = np.setdiff1d(np.arange(places[0], places[-1]), places)
    if gaps.size and not skip:
        what = "infinite, as if not measured" if np.isinf(points[gaps[0]]).any() else "not measured"
        others = f", like {gaps.size - 1} others between the ends" if gaps.size > 1 else ""
        it = "them" if others else "it"
        raise _fault(name, lines, int(gaps[0]), f"{what}{others}: skip_missing=True leaves {it} out")
    return places


def _facing(points: FloatArray, upwards: float) -> FloatArray:
    """Returns the points with no other part of the profile above them, by rising x."""
    x, z = points[:, 0], upwards * points[:, 1]
    by_x = np.argsort(x, kind="stable")
    is_seen = np.ones(len(x), dtype=np.bool_)
    # Runs in which x rises, or falls, or rests; each ends where the next begins.
    turns = np.flatnonzero(np.diff(np.sign(np.diff(x)))) + 1
    for first, last in zip([0, *turns], [*turns, len(x) - 1], strict=True):
        run = slice(first, last + 1) if x[first] <= x[last] else slice(last, first - 1 if first else None, -1)
        below = by_x[np.searchsorted(x[by_x], x[run][0]) : np.searchsorted(x[by_x], x[run][-1], "right")]
        top = np.interp(x[below], x[run], z[run]) if x[first] != x[last] else np.max(z[run])
        is_seen[below] &= z[below] >= top
    seen = points[is_seen]
    # Of points with the same x and height one is kept.
    return np.asarray(seen[np.unique(seen[:, 0], return_index=True)[1]])


def _text(
    name: str, data: bytes, columns: tuple[int, int] | tuple[str, str] | None, file_units: tuple[str, str] | None
) -> tuple[FloatArray, list[int], tuple[str, str], str]:
    """Returns the points of a text, the line of each, the units, and what to say if x turns back."""
    lines = re.split(r"\r\n|\r|\n", _decoded(name, data))
    first, delimiter, width = _first_row(name, lines)
    heads = _heads(lines[:first], delimiter, width)
    if (names := _names(heads, delimiter)) and len(names.cells) < width:
        reason = f"{width} columns, of which line {names.line} names {len(names.cells)}: take out separators of thousands, or name all"
        raise MeasuredFileError(name, reason + _doubt([_cells(lines[first], delimiter)], delimiter), first + 1)
    x, z = _in_order(heads) if columns is None else (_numbered(name, heads, column) for column in columns)
    if min(x, z) < 1 or max(x, z) > width or x == z:
        raise MeasuredFileError(name, f"columns are {columns}: give two of 1 to {width}", first + 1)
    if depth := next((head.ways[0][z - 1] for head in heads if z <= len(head.ways[0]) and _DEPTH.fullmatch(_bare(head.ways[0][z - 1]))), None):
        says = f"{depth!r} is taken for heights upwards: if it rises into the material, a lower body is Spline(...).flipped()"
        warnings.warn(f"{name}: {says}, and an upper body the Spline", stacklevel=3)
    above = [at for at, line in enumerate(lines[:first]) if any(_cells(line, delimiter))]
    while above and (stray := _stray(name, cells := _cells(lines[above[-1]], delimiter), above[-1] + 1, x, z)):
        # Words of other columns may differ from row to row.
        if width == 2 or len(cells) < width or None in (_number(cells[x - 1]), _number(cells[z - 1])):
            raise stray
        first = above.pop()
    table, places = _table(name, lines, first, delimiter, width, x, z)
    numbers = [[_number(cell) for cell in cells[:width]] for cells in table]
    points = np.array(numbers, dtype=np.float64)
    steps = np.diff(points, axis=0)
    can_be_x = (1 + np.flatnonzero((steps > 0).all(axis=0) | (steps < 0).all(axis=0))).tolist() if len(steps) else []
    if columns is None and width > 2:
        such = (not names and _doubt(table, delimiter)) or _columns_to_try(heads, width, can_be_x, _filled(table[0]))
        raise MeasuredFileError(name, f"{width} columns: give those of x and z, by number or name{such}", first + 1)
    marks = set[str]()
    for cells, row, line in zip(table, numbers, places, strict=True):
        chosen = [cells[x - 1], cells[z - 1]]
        if row[x - 1] is None or row[z - 1] is None:
            raise MeasuredFileError(name, f"{' and '.join(map(repr, chosen))} are no two numbers", line)
        # Those of other columns tell, too, what is a separator of thousands; `1.` numbers a row, and `n.a.` is no number.
        for mark in {".", ","} - marks:
            if any(mark in cell[:-1] and not (n is None or n != n) for cell, n in zip(cells, row, strict=False)):
                marks.add(mark)
        if len(marks) > 1:
            reason = "numbers with a decimal point, and others with a comma: take out separators of thousands"
            raise MeasuredFileError(name, reason, line)
    meant = next(((other, z if other != z else x) for other in can_be_x if x not in can_be_x), None)
    hint = f", as column {meant[0]} does (columns={meant})" if meant else ""
    return points[:, [x - 1, z - 1]], places, _units(name, heads, file_units, x, z), hint


def _table(
    name: str, lines: Sequence[str], first: int, delimiter: str | None, width: int, x: int, z: int
) -> tuple[list[list[str]], list[int]]:
    """Returns the cells of the rows of numbers, and the line of each; words may stand below and behind."""
    rows = [(_cells(content, delimiter), line) for line, content in enumerate(lines[first:], first + 1)]
    rows = [(cells, line) for cells, line in rows if any(cells)]
    [lead, *_] = _filled(rows[0][0])
    while len(rows[-1][0]) < lead or _number(rows[-1][0][lead - 1]) is None:
        if stray := _stray(name, *rows.pop(), x, z):
            raise stray
    empty = next((line for line, content in enumerate(lines[first:], first + 1) if not content.strip()), len(lines) + 1)
    count = sum(line < empty for _, line in rows)
    body, behind = [cells for cells, _ in rows[:count]], [cells for cells, _ in rows[count:]]
    if _is_footer(body, behind, width):
        rows = rows[:count]
    elif _is_footer(behind[::-1], body[::-1], width) or _jumps([*body, *behind], count, x):
        line = rows[count - (count < len(behind))][1]
        reason = "beside an empty line, over which x does not go on as in the table: put # in front of it if it is no point"
        raise MeasuredFileError(name, f"{reason}, or take out the empty line", line)
    # More words than columns are a remark, but not numbers where others have words.
    usual = {x, z, *_filled(rows[0][0])}
    for cells, line in rows:
        if found := next(filter(_SUMMARY.fullmatch, cells), None):
            raise MeasuredFileError(name, f"{found!r} is no point: put # in front of the line", line)
        if len(cells) < width or (len(cells) > width and not usual.issuperset(_filled(cells))):
            remedy = "; take out separators of thousands" if len(cells) > width else ""
            remedy += _doubt([cells for cells, _ in rows], delimiter)
            if len(cells) < width and sum(line <= other for _, other in rows) <= _FOOTER:
                remedy = "; put # in front of it if it is a footer, such as a count of points"
            reason = f"{_counted(len(cells), 'column')}: there are {width} in line {first + 1}"
            raise MeasuredFileError(name, reason + remedy, line)
    return [cells for cells, _ in rows], [line for _, line in rows]


def _stray(name: str, cells: Sequence[str], line: int, x: int, z: int) -> MeasuredFileError | None:
    """Returns the error of a line above or below the table that may be one of it."""
    at, height = [cells[column - 1] if column <= len(cells) else "" for column in (x, z)]
    if not _LIKE_A_NUMBER.match(at) or not (_LIKE_A_NUMBER.match(height) or _NO_NUMBER.fullmatch(height)):
        return None
    remedy = "take out separators of thousands, units and flags; put # in front of it if it is a remark"
    return MeasuredFileError(name, f"{at!r} and {height!r} look like data, but this is no line of the table: {remedy}", line)


def _doubt(table: Sequence[Sequence[str]], delimiter: str | None) -> str:
    """Returns a remedy if numbers may have been taken apart: at decimal commas, before thousands or a unit."""
    if delimiter == "," and not any("." in cell for cells in table for cell in cells):
        one = ",".join(table[0][:2])
        return f"; {one!r} may be one number; if these are decimal commas, separate the columns by semicolons or tabs"
    row = " ".join(table[0])
    if found := _GROUPED.search(row):
        return f"; {found[0]!r} may be one number: take out separators of thousands"
    if found := next((found for found in _WITH_WORD.finditer(row) if _symbol(found[1])), None):
        return f"; {found[0]!r} may be a number with its unit: take out the units, or give the columns of numbers, and file_units"
    return ""


def _is_footer(body: Sequence[list[str]], behind: Sequence[list[str]], width: int) -> bool:
    """Tells whether few rows behind the first empty line are none of the table: no column goes on in them."""
    if not 0 < len(behind) <= min(_FOOTER, len(body) // 4):
        return False
    if len(behind[0]) < width or any(len(cells) < width for cells in body):
        return True
    table = np.array([[_number(cell) for cell in cells[:width]] for cells in [*body, behind[0]]], dtype=np.float64)
    steps, length = np.diff(table, axis=0), table[-2] - table[0]
    goes_on = (steps * length > 0.0).all(axis=0) & (np.abs(steps[-1]) <= np.abs(length))
    return not goes_on.any()


def _jumps(table: Sequence[list[str]], count: int, x: int) -> bool:
    """Tells whether few rows lie nearer to others, or farther off, than any two of these, parted from them by a count."""
    if not 0 < min(count, len(table) - count) <= _FOOTER or len(table) < 4:
        return False
    numbers = [_number(cells[x - 1]) if len(cells) >= x else None for cells in table]
    steps = np.abs(np.diff(np.array(numbers, dtype=np.float64)))
    usual = np.delete(steps, count - 1)
    least, most = np.fmin.reduce(usual), np.fmax.reduce(usual)
    return bool(steps[count - 1] < 0.99 * least or steps[count - 1] > 1.01 * most)


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
    line = _REMARK.sub("", line)
    # A comma between quotes is part of a cell.
    parts = next(csv.reader([line]), []) if delimiter == "," and '"' in line else line.split(delimiter)
    return [cell.strip('" \t') for cell in parts] or [""]


def _number(cell: str) -> float | None:
    """Returns the number in a cell, NaN for one that was not measured, or None."""
    if _NO_NUMBER.fullmatch(cell):
        return float("nan")
    try:
        plain = _FORTRAN.sub("e", cell.replace(",", ".").replace("−", "-"))
        return None if "_" in cell else float(plain or "nan")
    except ValueError:
        return None


def _filled(cells: Sequence[str]) -> list[int]:
    """Returns the columns of a line that have numbers, counted from 1."""
    return [at for at, cell in enumerate(cells, 1) if cell and _number(cell) is not None]


def _first_row(name: str, lines: Sequence[str]) -> tuple[int, str | None, int]:
    """Returns the first line of numbers, the delimiter of its columns, and their number.

    A line of numbers with words below it is part of the header, unless the table is alike and none
    of them names a column. Words may stand in a table of two numbers and more if there is no other.
    """
    passed, wordy = list[tuple[int, str | None, int]](), list[tuple[int, str | None, int]]()
    for at, line in enumerate(lines):
        if passed and any(_unit_of(cell)[0] or _ALONG.fullmatch(_bare(cell)) for cell in _cells(line, passed[-1][1])):
            passed.clear()
        for delimiter in _DELIMITERS:
            cells = _cells(line, delimiter)
            while len(cells) > 2 and not cells[-1]:
                cells.pop()
            if len(cells) > 1 and cells[0] and None not in map(_number, cells) and not _NO_NUMBER.fullmatch(cells[0]):
                passed.append((at, delimiter, len(cells)))
                below = next((cells for line in lines[at + 1 :] if any(cells := _cells(line, delimiter))), [""])
                if _number(below[0]) is not None:
                    return next(one for one in passed if one[1:] == passed[-1][1:])
                break
            below = _cells("".join(lines[at + 1 : at + 2]), delimiter)
            if not wordy and len(there := _filled(cells)) > 1 and {*there}.issubset(_filled(below)):
                wordy.append((at, delimiter, len(cells)))
    if wordy or passed:
        return (wordy or passed)[0]
    single = next((at for at, line in enumerate(lines, 1) if _LIKE_A_NUMBER.match(line.strip())), None)
    doubt = _doubt([[lines[single - 1]]], None) if single else ""
    raise MeasuredFileError(name, f"no line has two numbers: a profile has columns of x and z{doubt}", single)


def _heads(header: Sequence[str], delimiter: str | None, width: int) -> list[_Head]:
    """Returns the lines of the header, the last line first."""
    heads = []
    for line in range(len(header), 0, -1):
        content = header[line - 1].strip('#%!" \t')
        # White space around a bracket parts no columns.
        joined = re.sub(r"\s*([\[(/])\s*", r"\1", content)
        ways = [(content if by else joined).split(by) for by in (delimiter, *_DELIMITERS)] + [_STATED.findall(content)]
        ways = [[cell.strip('" \t') for cell in cells] for cells in ways]
        heads.append(_Head(line, ways[0], sorted(ways, key=lambda cells: len(cells) != width)))
    return heads


def _bare(head: str) -> str:
    """Returns the name of a column without its unit, as `x` of `x [mm]`, `x in mm`, `x_mm` and of `Columns=X`."""
    name, mark, last = re.sub(r"[\[(/].*|\sin\s.*|.*=", "", head).strip().replace("_", " ").rpartition(" ")
    return re.sub(r"\s", "", name if mark and _symbol(last) else f"{name}{mark}{last}").lower()


def _numbered(name: str, heads: Sequence[_Head], column: int | str) -> int:
    """Returns the number of a column that is given by its number or its name."""
    if not isinstance(column, str):
        return column
    wanted = re.sub(r"\s", "", column).lower()
    for head in heads:
        for cells in head.ways:
            found = [at for at, cell in enumerate(cells, 1) if wanted in (_bare(cell), re.sub(r"\s", "", cell).lower())]
            if len(found) > 1:
                raise MeasuredFileError(name, f"columns {found} are all called {column!r}: give the number", head.line)
            if found:
                return found[0]
    if not heads:
        raise MeasuredFileError(name, f"no column {column!r}: there is no header")
    there = ", ".join(map(repr, heads[0].ways[0]))
    raise MeasuredFileError(name, f"no column {column!r} in the header: there are {there}", heads[0].line)


def _names(heads: Sequence[_Head], delimiter: str | None) -> _Head | None:
    """Returns the line that names most columns; between blanks any words stand, without an x no names."""
    words = [head for head in heads if len(head.cells) > 1 and not _filled(head.cells)]
    named = [head for head in words if any(_ALONG.fullmatch(_bare(cell)) for cell in head.cells)]
    return max(named or (words if delimiter else []), key=lambda head: len(head.cells), default=None)


def _in_order(heads: Sequence[_Head]) -> tuple[int, int]:
    """Returns the columns of x and z of two: the second is x if a header calls it so, or the first a height, not both."""
    names = [[_bare(cell) for cell in head.ways[0]] for head in heads]
    is_swapped = [
        [bool(_ALONG.fullmatch(cell)) for cell in cells] == [False, True]
        or [bool(_ACROSS.fullmatch(cell)) for cell in cells] == [True, False]
        for cells in names
    ]
    return (2, 1) if any(is_swapped) else (1, 2)


def _columns_to_try(heads: Sequence[_Head], width: int, can_be_x: Sequence[int], filled: Sequence[int]) -> str:
    """Tells which columns may be meant: those with units, or the first that can be x."""
    for head in heads:
        with_units = [cell for cell in head.ways[0] if _unit_of(cell)[0]]
        if len(head.ways[0]) == width and len(with_units) > 1:
            return f", such as columns={tuple(with_units[:2])}"
    if not can_be_x:
        reason = "none rises or falls throughout: x turns back (give facing, too), or this is a matrix of heights"
        return f", such as columns=(1, 2); {reason}, in which no column is x"
    return f", such as columns={(can_be_x[0], filled[-1 if can_be_x[0] < filled[-1] else 0])}"


def _symbol(word: str) -> str:
    """Returns a unit as a symbol, or nothing if it is none that is known."""
    # The micro sign and the Greek mu are different characters.
    word = re.sub("[µμ]", "u", word.lower())
    return word if word in _METRES else _NAMES.get(word.removesuffix("s").replace("metre", "meter"), "")


def _known(given: str) -> str:
    """Returns the symbol of a unit that is given by the caller; refuses any other."""
    return one_of(_symbol(str(given)) or given, "unit", tuple(_METRES))


def _unit_of(head: str) -> tuple[str, str]:
    """Returns the unit that a head states, and the word in brackets, each empty if there is none.

    The unit is the word in brackets, the head itself or its last word, as in `Lateral um`.
    """
    stated = _STATED.findall(head)
    words = [head, *stated] if stated else head.split()[-1:]
    return next(filter(None, map(_symbol, words)), ""), stated[0] if stated else ""


def _units(name: str, heads: Sequence[_Head], given: tuple[str, str] | None, *columns: int) -> tuple[str, str]:
    """Returns the units given, or those of x and z that the header states; two empty ones without any."""
    for line, _, ways in heads:
        if max(columns) > len(ways[0]):
            continue
        (x, in_x), (z, in_z) = (_unit_of(ways[0][column - 1]) for column in columns)
        if given is not None:
            # A word of a title may look like a unit.
            if (in_x or in_z or (x and z)) and (x or given[0], z or given[1]) != given:
                says = f"line {line} states {x or 'no unit'} for x and {z or 'no unit'} for z"
                warnings.warn(f"{name}: {says}: file_units={given} is taken in its place", stacklevel=4)
            continue
        if x and z:
            return x, z
        unit = x or z or "mm"
        unknown = [word for word, symbol in ((in_x, x), (in_z, z)) if word and not symbol]
        if unknown and (x or z or (in_x and in_z)):
            factors = ", ".join("1" if symbol else f"{unit} per {word}" for word, symbol in ((in_x, x), (in_z, z)))
            known = f"{' and '.join(map(repr, unknown))} is no unit that is known, which are {', '.join(_METRES)}"
            remedy = f"give file_units={(unit, unit)}, and multiply the points by [{factors}]"
            raise MeasuredFileError(name, f"{known}: {remedy}", line)
        # A word of a title may look like a unit.
        if (x or z) and (line == heads[0].line or in_x or in_z):
            reason = f"only one of x and z has a unit that is known: give file_units, such as {(unit, unit)}"
            raise MeasuredFileError(name, reason, line)
    return given or ("", "")
