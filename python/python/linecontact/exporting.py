"""Files of the console command: tables as CSV, fields as NPZ, and the stress below as VTK."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ._numbers import FloatArray
from .sheet import NUMBERS, Row, described, poisson_ratio
from .solution import Solution

# Number of places of the pressure, and of columns and rows of the stress field.
_PLACES, _COLUMNS, _DEPTHS = 256, 129, 64

# Reach of the field to either side and down, and its first depth, in half-widths: at the surface
# the stress may be infinite.
_REACH, _FIRST = 2.0, 1e-3


def write_csv(path: Path, rows: Sequence[Row], units: Mapping[str, str]) -> None:
    """Writes a line for each control: numbers, with their units in the heads, and the error."""
    heads = [f"{name} [{unit}]" if (unit := units.get(kind, "")) else name for name, (kind, _) in NUMBERS.items()]
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["prescribed", *heads, "error"])
        for row in rows:
            error = type(row.error).__name__ if row.error else ""
            table.writerow([described(row.control), *row.numbers.values(), error])


def write_npz(path: Path, rows: Sequence[Row]) -> None:
    """Writes the numbers of all rows, and their fields: arrays whose first index is the row.

    `pressure` is at `x`; stresses are at `depth`, the second index, and `field_x`, the third.
    """
    arrays: dict[str, Any] = {name: [row.numbers[name] for row in rows] for name in NUMBERS}
    fields = [_pressures(row.solution) | _field(row.solution) if row.solution else {} for row in rows]
    for name, like in next(filter(None, fields), {}).items():
        arrays[name] = [field.get(name, np.full_like(like, np.nan)) for field in fields]
    with path.open("wb") as file:
        np.savez_compressed(file, **arrays)


def write_vtk(path: Path, rows: Sequence[Row]) -> None:
    """Writes the stress in the lower body as a structured grid, in the text of legacy VTK.

    Several rows go to numbered files, which ParaView opens as a series. Here y is upwards, so that
    `tau_xy` has the opposite sign of that of `Solution.stress`.
    """
    for number, row in enumerate(rows, 1):
        if row.solution is None:
            continue
        field = _field(row.solution)
        x, y = np.broadcast_arrays(field.pop("field_x"), -field.pop("depth")[:, None])
        field["tau_xy"] *= -1.0
        of = path if len(rows) == 1 else path.with_name(f"{path.stem}_{number:04d}{path.suffix}")
        with of.open("w", encoding="ascii") as file:
            file.write(f"# vtk DataFile Version 3.0\nline contact, load {row.solution.load:.17g}\nASCII\n")
            file.write(f"DATASET STRUCTURED_GRID\nDIMENSIONS {_COLUMNS} {_DEPTHS} 1\nPOINTS {x.size} double\n")
            np.savetxt(file, np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)]), fmt="%.17g")
            file.write(f"POINT_DATA {x.size}\n")
            for name, values in field.items():
                file.write(f"SCALARS {name} double 1\nLOOKUP_TABLE default\n")
                np.savetxt(file, values.ravel(), fmt="%.17g")


def _pressures(solution: Solution) -> dict[str, FloatArray]:
    """Returns pressures from the first limit to the last, at places that are denser at both."""
    x = solution.centre - solution.half_width * np.cos(np.pi * (np.arange(_PLACES) + 0.5) / _PLACES)
    return {"x": x, "pressure": solution.pressure(x)}


def _field(solution: Solution) -> dict[str, FloatArray]:
    """Returns stresses on a grid below the contacts, which is denser next to the surface."""
    x = solution.centre + _REACH * solution.half_width * np.linspace(-1.0, 1.0, _COLUMNS)
    depth = solution.half_width * (_FIRST + _REACH * np.linspace(0.0, 1.0, _DEPTHS) ** 2)
    stress = solution.stress(x, depth[:, None])
    field = {"field_x": x, "depth": depth, **stress._asdict(), "max_shear": stress.max_shear()}
    if (ratio := poisson_ratio(solution.contact)) is not None:
        field["von_mises"] = stress.von_mises(ratio)
    return field
