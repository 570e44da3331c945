"""Files of the console command: tables as CSV, fields as NPZ, and the stress below as VTK."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ._numbers import FloatArray
from .below import bodies, materials
from .sheet import NUMBERS, Row, described
from .slipping import Side
from .solution import Solution

# Number of places of the pressure, and of columns and rows of the stress field.
_PLACES, _COLUMNS, _DEPTHS = 256, 129, 64

# Reach of the field to either side and down, and its first depth, in half-widths: at the surface
# the stress may be infinite.
_REACH, _FIRST = 2.0, 1e-3


def write_csv(path: Path, rows: Sequence[Row], units: Mapping[str, str]) -> None:
    """Writes a line for each control: numbers, with their units in the heads, and the error.

    `is_steep` tells that the slopes are too large for half-planes, as with units that are mixed.
    If a body has a layer, `max_shear_in` and its like name the materials of the largest stresses.
    """
    heads = [f"{name} [{unit}]" if (unit := units.get(kind, "")) else name for name, (kind, _) in NUMBERS.items()]
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        places = _places(rows)
        table.writerow(["prescribed", *heads, *places, "is_steep", "error"])
        for number, row in enumerate(rows):
            error = type(row.error).__name__ if row.error else ""
            words = [places[name][number] for name in places]
            steep = "" if row.solution is None else row.solution.is_steep
            table.writerow([described(row.control), *row.numbers.values(), *words, steep, error])


def write_npz(path: Path, rows: Sequence[Row]) -> None:
    """Writes the numbers of all rows, and their fields: arrays whose first index is the row.

    `pressure` is at `x`; stresses are at `depth`, the second index, and `field_x`, the third, and
    those whose largest is one of the numbers are called so: `field_max_shear`. If a body has a
    layer, each body has stresses of its own: `lower_sigma_x`, at `lower_depth`. Where the bodies are
    apart all of them are NaN.
    """
    arrays: dict[str, Any] = {name: [row.numbers[name] for row in rows] for name in NUMBERS} | _places(rows)
    fields = [_fields(row.solution) if row.solution else {} for row in rows]
    widths = arrays["half_width"]
    for name, like in next(filter(None, fields), {}).items():
        none = np.full_like(like, np.nan)
        arrays[name] = [of[name] if width > 0.0 else none for of, width in zip(fields, widths, strict=True)]
    with path.open("wb") as file:
        np.savez_compressed(file, **arrays)


def write_vtk(path: Path, rows: Sequence[Row]) -> None:
    """Writes the stress in the lower body as a structured grid, in the text of legacy VTK.

    Several rows go to numbered files, which ParaView opens as a series. If a body has a layer, each
    body goes to files of its own, with its name. Here y is upwards, so that `tau_xy` has the
    opposite sign of that of `Solution.stress`; the upper body is drawn below its surface, too.
    """
    for number, row, body, deepest in [
        (number, row, *of)
        for number, row in enumerate(rows, 1)
        for of in (bodies(row.solution.contact) if row.solution and not row.solution.is_apart else ())
    ]:
        assert row.solution is not None
        field = _field(row.solution, body, deepest)
        x, y = np.broadcast_arrays(field.pop("field_x"), -field.pop("depth")[:, None])
        field["tau_xy"] *= -1.0
        name = path.stem + (f"_{body}" if body else "") + (f"_{number:04d}" if len(rows) > 1 else "")
        of = path.with_name(name + path.suffix)
        with of.open("w", encoding="ascii") as file:
            file.write(f"# vtk DataFile Version 3.0\nline contact, load {row.solution.load:.17g}\nASCII\n")
            file.write(f"DATASET STRUCTURED_GRID\nDIMENSIONS {_COLUMNS} {_DEPTHS} 1\nPOINTS {x.size} double\n")
            np.savetxt(file, np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)]), fmt="%.17g")
            file.write(f"POINT_DATA {x.size}\n")
            for name, values in field.items():
                file.write(f"SCALARS {name} double 1\nLOOKUP_TABLE default\n")
                np.savetxt(file, values.ravel(), fmt="%.17g")


def _places(rows: Sequence[Row]) -> dict[str, list[str]]:
    """Returns the materials of the largest stresses by row, if a body has a layer."""
    names = dict.fromkeys(name for row in rows for name in row.places)
    return {f"{name}_in": [row.places.get(name, "") for row in rows] for name in names}


def _fields(solution: Solution) -> dict[str, FloatArray]:
    """Returns pressures, denser at both limits, and stresses, those of one body with its name."""
    x = solution.centre - solution.half_width * np.cos(np.pi * (np.arange(_PLACES) + 0.5) / _PLACES)
    found = {"x": x, "pressure": solution.pressure(x)}
    for body, deepest in bodies(solution.contact):
        before = f"{body}_" if body else ""
        for name, values in _field(solution, body, deepest).items():
            found[before + (f"field_{name}" if name in NUMBERS else name)] = values
    return found


def _field(solution: Solution, body: Side | None, deepest: float) -> dict[str, FloatArray]:
    """Returns stresses on a grid below the contacts, which is denser next to the surface."""
    x = solution.centre + _REACH * solution.half_width * np.linspace(-1.0, 1.0, _COLUMNS)
    # If the bodies are apart, all is in one point.
    first, last = _FIRST * solution.half_width, min((_FIRST + _REACH) * solution.half_width, deepest)
    depth = first + (last - first) * np.linspace(0.0, 1.0, _DEPTHS) ** 2
    depth[-1] = last
    stress = solution.stress(x, depth[:, None], body=body)
    field = {"field_x": x, "depth": depth, **stress._asdict(), "max_shear": stress.max_shear()}
    for one in materials(solution.contact):
        if one.body == body and one.ratio is not None:
            # A layer comes before its base.
            is_here = depth[:, None] >= (one.depths or (0.0,))[0]
            before = field.get("von_mises", np.zeros(1))
            field["von_mises"] = np.where(is_here, stress.von_mises(one.ratio), before)
    return field
