"""The console command `linecontact`: solves a scene file, and prints or writes its results."""

from __future__ import annotations

import argparse
import io
import math
import os
import re
import sys
import time
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from .errors import InputError, InvalidLoadError, InvalidMomentError, LineContactError, SceneFileError
from .exploring import explore
from .exporting import write_csv, write_npz, write_vtk
from .files import Scene
from .sheet import Row, described, sheet, solved, table

# Exit codes; 2 is that of argparse.
_OK, _FAILED, _USAGE, _SCENE, _OUTPUT, _INTERRUPTED = 0, 1, 2, 3, 4, 130
_CODES = """exit codes:
  0  all contacts were solved
  1  a contact was not found, or is none
  2  wrong arguments, or a load or moment that is invalid
  3  the scene file is missing or faulty
  4  a file cannot be written"""

# Time between two lines of progress, in seconds: short for the eye, and long for a terminal. A log
# gets a line for every tenth.
_PROGRESS = 0.2
# Most loads of a range: their solutions are kept until all of them are printed.
_MOST_LOADS = 100_000


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command, and returns its exit code."""
    parser = argparse.ArgumentParser("linecontact", description="Plane line contact of two bodies.")
    parser.add_argument("--version", action="version", version=version("linecontact"))
    of = parser.add_subparsers(required=True, metavar="solve")
    words = argparse.RawDescriptionHelpFormatter
    solve = of.add_parser("solve", help="solve a scene file", epilog=_CODES, formatter_class=words)
    solve.add_argument("scene", help="scene file, .toml or .json")
    solve.add_argument("--load", type=_loads, help="load, or first:last:count, in place of the controls of the scene")
    solve.add_argument("--yield-stress", type=_positive, help="yield stress, for the safety against yield")
    solve.add_argument("--csv", type=Path, help="write a table of all results")
    solve.add_argument("--npz", type=Path, help="write results, pressures and stresses for NumPy")
    solve.add_argument("--vtk", type=Path, help="write the stress below the surface for ParaView")
    solve.add_argument("--page", type=Path, help="write a page with a slider for the load")
    solve.add_argument("--progress", action="store_true", help="show the progress, though it goes to no terminal")
    given = parser.parse_args(arguments)
    try:
        return _solve(given, solve)
    except KeyboardInterrupt:
        return _INTERRUPTED
    except OSError as error:
        # Whoever reads the results has ended, or has no room.
        return _say(f"cannot write the results: {error.strerror}", _OUTPUT)


def _positive(text: str) -> float:
    try:
        if 0.0 < (value := float(text)) < math.inf:
            return value
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"{text!r} is no positive number")


def _loads(text: str) -> list[float]:
    try:
        first, last, count = map(float, text.split(":")) if ":" in text else (float(text), float(text), 1.0)
        several = count >= (1 if first == last else 2)
        if math.isfinite(first) and math.isfinite(last) and count.is_integer() and several:
            if count > _MOST_LOADS:
                reason = f"{text!r} are {count:.0f} loads, and at most {_MOST_LOADS} are solved in one run"
                raise argparse.ArgumentTypeError(reason)
            return [float(load) for load in np.linspace(first, last, int(count))]
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"{text!r}: give a load, as 500, or first:last:count, as 100:5000:20")


def _say(message: str, code: int) -> int:
    print("linecontact:", " ".join(message.split()), file=sys.stderr)
    return code


def _solve(given: argparse.Namespace, parser: argparse.ArgumentParser) -> int:
    try:
        scene = Scene.from_file(given.scene)
    except SceneFileError as error:
        return _say(str(error), _SCENE)
    except (LineContactError, OSError) as error:
        return _say(f"{given.scene}: {getattr(error, 'strerror', error)}", _SCENE)
    controls: Sequence[Mapping[str, Any]] = [{"load": load} for load in given.load or ()] or scene.controls
    if not controls:
        parser.error(f"{given.scene} has no controls: give --load")
    if given.page and any({"moment", "centre_of_pressure"} & control.keys() for control in controls):
        parser.error("--page has a slider for the load: it does not show moments")
    files = [Path(path).absolute() for path in (given.scene, given.csv, given.npz, given.vtk, given.page) if path]
    if len(set(files)) < len(files):
        parser.error("two of the files are the same one")
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    rows = _rows(scene, controls, given.yield_stress, given.progress)
    codes = [_written(given, scene, rows)]
    try:
        if len(rows) > 1:
            print(table(scene, rows, given.yield_stress), flush=True)
        elif rows[0].solution is not None:
            print(sheet(scene, rows[0], given.yield_stress), flush=True)
    except BrokenPipeError:
        # Whoever reads has seen enough, as `head` has. Python writes the rest when it ends.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    for row in rows:
        if row.error is not None:
            is_control = isinstance(row.error, (InvalidLoadError, InvalidMomentError))
            code = _USAGE if is_control else _SCENE if isinstance(row.error, InputError) else _FAILED
            says = re.sub(r"Edge\.(\w+)\((.*?)\)", r"\1 = \2 in edges", str(row.error))
            codes.append(_say(f"{given.scene}: {described(row.control)}: {says}", code))
    return max(codes)


def _rows(
    scene: Scene, controls: Sequence[Mapping[str, Any]], yield_stress: float | None, is_asked: bool
) -> list[Row]:
    """Solves the controls one by one: `sweep` has no von Mises stress, and controls of one kind."""
    is_terminal = sys.stderr.isatty()
    every = _PROGRESS if is_terminal else 10.0 * _PROGRESS
    rows, due = list[Row](), time.monotonic() + every
    for control in controls:
        rows.append(solved(scene, control, yield_stress))
        if (is_terminal or is_asked) and time.monotonic() >= due:
            due += every
            start, end = ("\r", "") if is_terminal else ("", "\n")
            print(f"{start}{len(rows)} of {len(controls)} solved", end=end, file=sys.stderr, flush=True)
    print("\r" + 40 * " " + "\r" if is_terminal else "", end="", file=sys.stderr, flush=True)
    return rows


def _written(given: argparse.Namespace, scene: Scene, rows: Sequence[Row]) -> int:
    """Writes the files that are asked for."""
    units = [scene.units.get(quantity, "") for quantity in ("length", "pressure", "load")]
    loads = [row.solution.load for row in rows if row.solution and not row.solution.is_apart]
    title = scene.title or "Line contact"
    for path, write in (
        (given.csv, lambda path: write_csv(path, rows, {"angle": "rad", **scene.units})),
        (given.npz, lambda path: write_npz(path, rows)),
        (given.vtk, lambda path: write_vtk(path, rows)),
        (given.page if loads else None, lambda path: explore(scene.contact, loads, path, title=title, units=units)),
    ):
        try:
            if path is not None:
                write(path)
        except OSError as error:
            return _say(f"cannot write {path}: {error.strerror or error}", _OUTPUT)
        except LineContactError as error:
            return _say(f"cannot write {path}: {error}", _FAILED)
    apart = [described(row.control) for row in rows if row.solution and row.solution.is_apart]
    if apart and (given.npz or given.vtk or given.page):
        _say(f"apart under {apart[0]}: no pressures and stresses to write", _OK)
    return _OK
