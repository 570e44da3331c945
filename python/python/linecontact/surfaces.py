"""Parsers of X3P files (ISO 25178-72) and SDF files (ISO 25178-71): one profile of each, in metres.
"""

from __future__ import annotations

import io
import math
import re
import struct
import zipfile
from collections.abc import Callable
from typing import Any
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

from ._numbers import FloatArray
from .errors import MeasuredFileError

# Largest size of a part of an X3P file, in bytes: a surface of 11000 by 11000 points, and far below
# the size to which a small archive can unpack.
_MOST_BYTES = 2**30

_WORKBOOK = "is a workbook or a document: save the sheet with the profile as CSV"

# Types of coordinates in X3P, element DataType.
_X3P_TYPES = {"I": "<i2", "L": "<i4", "F": "<f4", "D": "<f8"}

# Headers and types of heights in SDF, by revision. The least number of a type means not measured.
_SDF_HEADER = {b"1": struct.Struct("<10s12s12sHHddddBBB"), b"2": struct.Struct("<10s12s12sIIddddBBB")}
_SDF_TYPES = {
    b"1": {5: "<i2", 6: "<i4", 7: "<f8"},
    b"2": {3: "<f4", 4: "<i1", 5: "<i2", 6: "<i4", 7: "<f8"},
}


def kind_of(name: str, data: bytes) -> str:
    """Tells X3P, SDF and texts apart, by their first bytes."""
    if data.startswith(b"\xd0\xcf\x11\xe0"):
        raise MeasuredFileError(name, _WORKBOOK, byte=0)
    found = "x3p" if data.startswith(b"PK\3\4") else "sdf" if re.match(rb"[ab]ISO-[12]\.0", data) else "text"
    suffix = name.lower().rpartition(".")[2]
    if suffix in READERS and found != suffix:
        raise MeasuredFileError(name, f"no {suffix.upper()} file: it begins with {data[:8]!r}", byte=0)
    return found


def _chosen(name: str, rows: int, row: int | None) -> int:
    """Returns the profile to be read, counted from 0."""
    row = 1 if row is None and rows == 1 else row
    if row is None or not 1 <= row <= rows:
        given = "" if row is None else f"row is {row}: "
        raise MeasuredFileError(name, f"{given}there are {rows} profiles: give a row from 1 to {rows}")
    return row - 1


def _scaled(name: str, numbers: npt.NDArray[Any], step: float, offset: float = 0.0) -> FloatArray:
    if not (math.isfinite(offset) and math.isfinite(step) and step != 0.0):
        raise MeasuredFileError(name, f"coordinates from {offset:g} in steps of {step:g}: no such steps")
    return offset + step * numbers.astype(np.float64)


def _sdf_type(name: str, revision: bytes, codes: tuple[int, ...]) -> np.dtype[Any]:
    compression, kind, check = codes
    if compression or check or kind not in _SDF_TYPES[revision]:
        known = ", ".join(map(str, _SDF_TYPES[revision]))
        reason = f"Compression {compression}, DataType {kind}, CheckType {check}"
        raise MeasuredFileError(name, f"{reason}: read are 0, one of {known}, and 0")
    return np.dtype(_SDF_TYPES[revision][kind])


def _sdf(name: str, data: bytes, row: int | None) -> FloatArray:
    """Reads the header, ISO 25178-71, Table 2, and the heights, row by row."""
    if data.startswith(b"a"):
        return _sdf_text(name, data, row)
    header = _SDF_HEADER[data[5:6]]
    start = 8 + header.size
    if len(data) < start:
        raise MeasuredFileError(name, f"ends within the header of {start} bytes", byte=len(data))
    *_, count, rows, x_step, _, z_step, _, compression, kind, check = header.unpack_from(data, 8)
    dtype = _sdf_type(name, data[5:6], (compression, kind, check))
    size = count * dtype.itemsize
    if start + rows * size > len(data):
        raise MeasuredFileError(name, f"ends before {rows} profiles of {count} points", byte=len(data))
    stored = np.frombuffer(data, dtype, count, start + _chosen(name, rows, row) * size)
    least = np.finfo(dtype).min if dtype.kind == "f" else np.iinfo(dtype).min
    z = np.where(stored == least, math.nan, _scaled(name, stored, z_step))
    return np.column_stack([_scaled(name, np.arange(count), x_step), z])


def _sdf_text(name: str, data: bytes, row: int | None) -> FloatArray:
    """Reads lines of names and values, then heights; a line of `*` ends either."""
    lines = re.split(r"\r\n|\r|\n", data.decode("latin-1"))
    stars = [at for at, line in enumerate(lines) if line.strip() == "*"] + [len(lines)] * 2
    fields = [line.partition("=") for line in lines[1 : stars[0]]]
    values = {field.strip().lower(): value.strip() for field, _, value in fields}

    def number(field: str, kind: type[int] | type[float] = int) -> float:
        try:
            return kind(values[field.lower()])
        except (KeyError, ValueError):
            found = values.get(field.lower(), "missing")
            raise MeasuredFileError(name, f"{field} in the header is {found}: it must be a number", stars[0]) from None

    _sdf_type(name, data[5:6], tuple(int(number(code)) for code in ("Compression", "DataType", "CheckType")))
    count, rows = int(number("NumPoints")), int(number("NumProfiles"))
    words = [(word, at + 1) for at in range(stars[0] + 1, stars[1]) for word in lines[at].split()]
    if len(words) != count * rows or count < 1:
        raise MeasuredFileError(name, f"{len(words)} heights, for {rows} profiles of {count} points", stars[1])
    start = _chosen(name, rows, row) * count
    z = np.full(count, math.nan)
    for i, (word, line) in enumerate(words[start : start + count]):
        try:
            z[i] = math.nan if word == "BAD" else float(word)
        except ValueError:
            raise MeasuredFileError(name, f"{word!r} is no height", line) from None
    x = _scaled(name, np.arange(count), number("Xscale", float))
    return np.column_stack([x, _scaled(name, z, number("Zscale", float))])


def _part(name: str, data: bytes, part: str, size: int | None = None) -> bytes:
    """Unpacks a part of an archive, once its size is known to be as expected.

    All parts may be in one folder, where a folder was packed in place of its contents.
    """
    try:
        archive = zipfile.ZipFile(io.BytesIO(data))
        parts = archive.NameToInfo
        inside = [at for at in parts if at.endswith(f"/{part}")]
        found = parts.get(part if part in parts or len(inside) != 1 else inside[0])
        if found is not None and found.file_size <= _MOST_BYTES and size in (None, found.file_size):
            return archive.read(found)
    except Exception as error:  # Damaged archives raise errors of many kinds.
        raise MeasuredFileError(name, f"no whole ZIP archive: {error}") from None
    if found is None:
        is_office = not parts.keys().isdisjoint(("[Content_Types].xml", "mimetype"))
        raise MeasuredFileError(name, _WORKBOOK if is_office else f"{part} is missing from the archive")
    wanted = f"{size} are expected, and" if size else ""
    raise MeasuredFileError(name, f"{part} has {found.file_size} bytes: {wanted} at most {_MOST_BYTES} are read")


class _Main:
    """Texts and numbers of main.xml, by their paths."""

    def __init__(self, name: str, data: bytes) -> None:
        self.name, xml = name, _part(name, data, "main.xml")
        if b"<!DOCTYPE" in xml:
            raise MeasuredFileError(name, "main.xml declares a document type: the standard has none")
        try:
            self.root = ElementTree.fromstring(xml)
        except (ElementTree.ParseError, ValueError, LookupError) as error:
            raise MeasuredFileError(name, f"main.xml is no XML: {error}") from None
        for element in self.root.iter():
            element.tag = element.tag.rpartition("}")[2]

    def text(self, path: str) -> str:
        return (self.root.findtext(path) or "").strip()

    def number(self, path: str, default: str, kind: type[int] | type[float] = float) -> float:
        try:
            return kind(self.text(path) or default)
        except ValueError:
            reason = f"main.xml: {path} is {self.text(path)!r}: it must be a number"
            raise MeasuredFileError(self.name, reason) from None


def _x3p(name: str, data: bytes, row: int | None) -> FloatArray:
    """Reads main.xml and the coordinates that it links or lists: ISO 25178-72, Records 1 and 3."""
    main = _Main(name, data)
    feature, listed = main.text("Record1/FeatureType"), main.text("Record3/ListDimension")
    if feature not in ("PRF", "SUR") or (listed and feature == "SUR"):
        reason = f"feature type {feature!r}, a point cloud" if listed or feature == "PCL" else f"feature type {feature!r}"
        raise MeasuredFileError(name, f"{reason}: read are profiles, PRF, and the rows of surfaces, SUR, in a matrix")
    # A profile may be a list of points, which is a matrix of one row.
    sizes = ["ListDimension"] if listed else [f"MatrixDimension/Size{axis}" for axis in "XYZ"]
    count, *others = (int(main.number(f"Record3/{size}", "1", int)) for size in sizes)
    rows, part = math.prod(others), main.text("Record3/DataLink/PointDataLink")
    points = main.root.findall("Record3/DataList/Datum")
    if min([count, *others]) < 1 or not (part or points):
        reason = "read are those in a binary part, or in a list"
        raise MeasuredFileError(name, f"main.xml: {rows} profiles of {count} points: {reason}")
    # Coordinates of absolute axes are stored; those of incremental axes are counted.
    is_stored = {axis: main.text(f"Record1/Axes/C{axis}/AxisType") == "A" for axis in "XYZ"}
    types = {axis: main.text(f"Record1/Axes/C{axis}/DataType") for axis in "XYZ" if is_stored[axis]}
    if "Z" not in types or not _X3P_TYPES.keys() >= set(types.values()):
        raise MeasuredFileError(name, f"main.xml: stored are {types}: Z must be, as {' or '.join(_X3P_TYPES)}")
    chosen = _chosen(name, rows, row)
    at, columns = slice(chosen * count, (chosen + 1) * count), []
    if part:
        stored = _linked(main, data, part, count * rows, types)
    else:
        stored = _listed(name, [point.text or "" for point in points], count * rows)
    for axis in "XZ":
        numbers = stored[axis][at] if axis in types else np.arange(count)
        path = f"Record1/Axes/C{axis}"
        step, offset = main.number(f"{path}/Increment", "1"), main.number(f"{path}/Offset", "0")
        columns.append(_scaled(name, numbers, step, offset))
    return np.column_stack(columns)


def _linked(main: _Main, data: bytes, part: str, size: int, types: dict[str, str]) -> dict[str, FloatArray]:
    """Returns the stored coordinates from a binary part, NaN for points that were not measured."""
    dtype = np.dtype([(axis, _X3P_TYPES[kind]) for axis, kind in types.items()])
    stored = np.frombuffer(_part(main.name, data, part, size * dtype.itemsize), dtype)
    measured = np.ones(size, dtype=np.bool_)
    if valid := main.text("Record3/DataLink/ValidPointsLink"):
        bits = np.frombuffer(_part(main.name, data, valid, -(-size // 8)), np.uint8)
        # The first point is the least significant bit.
        measured = np.unpackbits(bits, count=size, bitorder="little").astype(np.bool_)
    return {axis: np.where(measured, stored[axis], math.nan) for axis in types}


def _listed(name: str, points: list[str], size: int) -> dict[str, FloatArray]:
    """Returns the coordinates of points in words, `x;y;z` or fewer; an empty one was not measured."""
    if len(points) != size:
        raise MeasuredFileError(name, f"main.xml lists {len(points)} points: {size} are expected")
    found = np.full((size, 2), math.nan)
    for at, words in enumerate(points):
        try:
            if words.strip():
                # The height is the last; numbers of an axis that is not stored may stand before it.
                found[at] = float(words.split(";")[0]), float(words.split(";")[-1])
        except ValueError:
            raise MeasuredFileError(name, f"main.xml: Datum {at + 1} is {words!r}: no numbers") from None
    return {"X": found[:, 0], "Z": found[:, 1]}


READERS: dict[str, Callable[[str, bytes, int | None], FloatArray]] = {"x3p": _x3p, "sdf": _sdf}
