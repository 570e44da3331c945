"""Result sheets of the console command, for one control and for several."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .below import Below, materials
from .contact import _layers
from .drawing import covered
from .errors import HalfPlanesOnlyError, LineContactError
from .solution import ROUNDING, Solution, StressPeak, placed

if TYPE_CHECKING:
    from .files import Scene

# Numbers of a row: the quantity that gives the unit, and the label in the sheet of one row.
NUMBERS = {
    "load": ("load", "load"),
    "left": ("length", "contact from"),
    "right": ("length", "contact to"),
    "half_width": ("length", "half-width"),
    "contacts": ("", ""),
    "apart_by": ("length", "apart by"),
    "centre_of_pressure": ("length", "centre of pressure"),
    "peak_pressure": ("pressure", "largest pressure"),
    "mean_pressure": ("pressure", "mean pressure"),
    "tilt": ("angle", "tilt of the upper body"),
    "approach": ("length", "approach of the bodies"),
    "stiffness": ("pressure", "stiffness"),
    "max_shear": ("pressure", "largest shear in plane"),
    "von_mises": ("pressure", "largest von Mises stress"),
    "tresca": ("pressure", "largest Tresca stress"),
    "safety_von_mises": ("", "safety by von Mises"),
    "safety_tresca": ("", "safety by Tresca"),
    **{f"{name}_x": ("length", "") for name in ("peak", "max_shear", "von_mises", "tresca")},
    **{f"{name}_depth": ("length", "") for name in ("max_shear", "von_mises", "tresca")},
    "limits_error": ("", ""),
    "peak_error": ("pressure", ""),
    "half_width_deviation": ("length", ""),
    "peak_deviation": ("pressure", ""),
}

# Headings of a table, by number; the last ones are left out where they do not fit.
_TABLE = {
    "load": "load", "left": "from", "right": "to", "contacts": "contacts", "peak_pressure": "peak", "safety_von_mises": "S Mises",
    "safety_tresca": "S Tresca", "approach": "approach", "von_mises": "v. Mises", "max_shear": "shear",
    "max_shear_depth": "at depth", "mean_pressure": "mean", "stiffness": "stiffness",
}  # fmt: skip

# Number of columns of a sheet, and of each number of a table.
_WIDTH, _CELL = 100, 10

# Relative error below which a sheet does not tell: digits that differ from machine to machine.
_EXACT = 1e-12


class Row(NamedTuple):
    """A control with its solution and numbers, or with its error.

    `each` are the largest stresses of each material, if a body has a layer; `missing` is what is not known of layers.
    """

    control: Mapping[str, Any]
    solution: Solution | None
    numbers: dict[str, float]
    each: Mapping[str, Mapping[str, StressPeak]]
    missing: Sequence[str]
    error: LineContactError | None

    @property
    def places(self) -> dict[str, str]:
        """Materials of the largest stresses, if a body has a layer."""
        return {name: _most(of) for name, of in self.each.items()}


def solved(scene: Scene, control: Mapping[str, Any], yield_stress: float | None) -> Row:
    """Solves a contact, and returns its numbers: NaN if they are not known, infinite at corners."""
    numbers, missing, each = dict.fromkeys(NUMBERS, math.nan), dict[str, None](), dict[str, dict[str, StressPeak]]()
    below = materials(scene.contact)
    if any(len(_layers(one)[0]) > 1 for one in scene.contact._settings["materials"] or ()):
        missing["the stress below several layers"] = None
    try:
        solution = scene.contact.solve(**control)
    except LineContactError as error:
        return Row(control, None, numbers, each, (), error)

    def note(of: Callable[[], Iterable[float]], *names: str) -> None:
        try:
            numbers.update(zip(names, of(), strict=True))
        except HalfPlanesOnlyError as error:
            missing[error.quantity] = None
        except LineContactError:
            pass

    to = control.get("references", scene.references)
    numbers.update(load=solution.load, left=-solution.b, right=solution.a, half_width=solution.half_width)
    numbers.update(mean_pressure=solution.mean_pressure, contacts=len(solution.intervals))
    if solution.is_apart:
        numbers.update(apart_by=solution.separation)
    if solution.limits_error is not None:
        numbers.update(limits_error=solution.limits_error)
    if solution.tilt != 0.0:
        numbers.update(tilt=solution.tilt)
    note(lambda: [solution.centre_of_pressure], "centre_of_pressure")
    note(solution.peak, "peak_x", "peak_pressure", "peak_error")
    note(lambda: solution.uncertainty()[2:], "half_width_deviation", "peak_deviation")

    def largest(name: str, of: Callable[[Below], StressPeak]) -> None:
        def found() -> StressPeak:
            peaks = {one.words: of(one) for one in below}
            if not peaks:
                return StressPeak(math.nan, math.nan, math.nan)
            if peaks.keys() != {""}:
                each[name] = peaks
            return peaks[_most(peaks)]

        note(found, f"{name}_x", f"{name}_depth", name)

    largest("max_shear", lambda one: solution.max_shear(body=one.body, depths=one.depths))
    largest("tresca", lambda one: largest_tresca(solution, one))
    if all(one.ratio is not None for one in below):
        largest("von_mises", lambda one: solution.max_von_mises(one.ratio or 0.0, body=one.body, depths=one.depths))
    if to is not None:
        note(lambda: [solution.approach(to).bodies], "approach")
        note(lambda: [solution.stiffness(to)], "stiffness")
    if yield_stress is not None:
        for of in ("von_mises", "tresca"):
            numbers[f"safety_{of}"] = _safety(yield_stress, numbers[of])
    # Of bodies that are apart, places are known to the rounding of their x.
    least = _EXACT * float(np.ptp(covered(solution))) if solution.is_apart else ROUNDING * solution.half_width
    for name in ("left", "right", "centre_of_pressure", "peak_x"):
        numbers[name] = 0.0 if abs(numbers[name]) < least else numbers[name]
    return Row(control, solution, numbers, each, tuple(missing), None)


def _most(peaks: Mapping[str, StressPeak]) -> str:
    """Returns the material of the largest stress."""
    return max(peaks, key=lambda words: peaks[words].value)


def largest_tresca(solution: Solution, of: Below) -> StressPeak:
    """Returns the largest difference of two principal stresses in a material, and its place.

    A Poisson's ratio below 1/4 can make it larger than twice the largest shear in the plane.
    """
    shear = solution.max_shear(body=of.body, depths=of.depths)
    best = [StressPeak(shear.x, shear.depth, 2.0 * shear.value)]
    top, bottom = of.depths or (0.0, math.inf)
    for on in solution.intervals if of.ratio is not None else ():
        x, depth, reach = on.centre, on.half_width, on.half_width
        # Windows of 17 by 17 places, each half as wide as the one before, until the value is exact.
        for _ in range(16):
            places = x + reach * np.linspace(-1.0, 1.0, 17)
            depths = np.clip(depth + reach * np.linspace(-1.0, 1.0, 17), top, bottom)
            stress = solution.stress(places, depths[:, None], body=of.body)
            spread = np.ptp([*stress.principal(), stress.sigma_z(of.ratio or 0.0)], axis=0)
            row, column = np.unravel_index(np.argmax(spread), spread.shape)
            x, depth, reach = float(places[column]), float(depths[row]), 0.5 * reach
        best.append(StressPeak(*placed([on], x, depth, float(spread[row, column]))))
    return max(best, key=lambda one: one.value)


def described(control: Mapping[str, Any]) -> str:
    """Returns a control in words, without its references."""
    return ", ".join(f"{name} = {value:g}" for name, value in control.items() if name != "references")


def _line(label: str, content: str) -> str:
    line = f"{label:<26}{content}".rstrip()
    return line if len(line) <= _WIDTH else line[: _WIDTH - 3] + "..."


def _elastic(of: Any, unit: str) -> str:
    """Returns a material in words, or the rigid base of a layer."""
    if isinstance(of, str):
        return f"rigid, {of}"
    modulus, ratio = of
    elastic = f"E = {modulus:g} {unit}".rstrip() + f", Poisson's ratio {ratio:g}"
    return elastic if math.isfinite(modulus) else "rigid"


def _safety(yield_stress: float | None, stress: float) -> float:
    """Returns the safety against yield, infinite without stress."""
    return (yield_stress or math.nan) / stress if stress != 0.0 else math.inf


def _place(x: float, depth: float, unit: str) -> str:
    """Returns x and depth in words, as far as they are known."""
    named = (("at x = ", x), (", depth ", depth))
    return "".join(f"{name}{value:.4g} {unit}".rstrip() for name, value in named if not math.isnan(value))


def _number(label: str, number: float, kind: str, units: Mapping[str, str], note: str) -> str:
    """Returns the line of a number."""
    text = f"{number:.6g}" if kind else f"{number:.3g}"
    whole, point, digits = text.partition(".")
    return _line(label, f"{whole:>8}{point + digits:<11}{units[kind]:<8}{note}")


def sheet(scene: Scene, row: Row, yield_stress: float | None) -> str:
    """Returns the result sheet of one solution."""
    contact, numbers = scene.contact, row.numbers
    units = {"": "", "length": "", "pressure": "", "load": "", "angle": "rad", **scene.units}
    pressure = units["pressure"]
    lines = [scene.title, "", _line("lower body", str(contact.lower)), _line("upper body", str(contact.upper))]
    for name, given in zip(("lower", "upper"), contact._settings["materials"] or (), strict=False):
        layers, base = _layers(given)
        for layer in layers:
            thick = f"{layer.thickness:g} {units['length']}".rstrip()
            lines.append(_line(f"{name} layer", f"{_elastic(layer.material, pressure)}, {thick} thick"))
        lines.append(_line(f"{name} base" if layers else f"{name} material", _elastic(base, pressure)))
    lines += [_line("prescribed", described(row.control)), ""]
    for name, (kind, label) in NUMBERS.items():
        if label and not math.isnan(numbers[name]):
            of = name.removeprefix("safety_")
            note = f"against yield at {yield_stress:g} {pressure}" if of != name else ""
            words = row.places.get(of, "")
            x, depth = (numbers.get(f"{name.removesuffix('_pressure')}_{at}", math.nan) for at in ("x", "depth"))
            note += _place(x, depth, units["length"]) + (f", {words}" if words else "")
            lines.append(_number(label, numbers[name], kind, units, note))
            # Each material has a limit of its own.
            for other in [other for other in row.each.get(of, ()) if other != words]:
                peak = row.each[of][other]
                value = peak.value if of == name else _safety(yield_stress, peak.value)
                note = _place(peak.x, peak.depth, units["length"]) if of == name else ""
                lines.append(_number(f"  in {other}", value, kind, units, note))
    return "\n".join([*lines[0 if scene.title else 2 :], "", *_notes(row, units)])


def _notes(row: Row, units: dict[str, str]) -> list[str]:
    """Returns the errors of a solution, and the doubts that it leaves."""
    numbers, solution = row.numbers, row.solution
    assert solution is not None

    if solution.is_apart:
        return [_line("note", "no load presses the bodies together")]

    def text(name: str) -> str:
        return f"{numbers[name]:.1g} {units[NUMBERS[name][0]]}".rstrip()

    deviation = f"half-width +- {text('half_width_deviation')}, largest pressure +- {text('peak_deviation')}"
    checked = "no tension in the contact, no overlap beside it" if solution.is_checked else "no, see certify"
    if solution.contact._settings["certified"]:
        checked += ": proved" if solution.certify().is_proved else ": proved up to rounding"
    errors = [numbers["limits_error"], numbers["peak_error"] / numbers["peak_pressure"]]
    error = 10.0 ** math.ceil(math.log10(max([one for one in errors if one > _EXACT], default=_EXACT)))
    several = f"{len(solution.intervals)} contacts: the limits are those of the first and the last"
    held: list[str] = []
    with suppress(LineContactError):
        limits = [pair for one in solution.contacts() for pair in zip(one.interval, one.held, strict=True)]
        held = [f"{x:.6g}" for x, is_held in limits if is_held]
    conform = ["", ""]
    if (found := solution.conformity) is not None:
        shares = f"{100.0 * found.too_low:.1f} % too low, {100.0 * found.parabolas_too_low:.1f} %"
        conform = [
            f"bodies conform, {math.degrees(found.angle):.1f} degrees at the limits, unlike half-planes:",
            f"peak, in the middle, some {shares} with parabolas for circles",
        ]
    notes = [
        (all(one >= 0.0 for one in errors), "numerical error", f"below {error:.0e} of half-width and largest pressure"),
        (numbers["half_width_deviation"] > 0.0, "noise of the points", deviation),
        (True, "checked", checked),
        (len(solution.intervals) > 1, "note", several),
        (bool(held), "note", f"held at x = {', '.join(held)}"),
        (any(one.ratio is None for one in materials(solution.contact)), "note", "without materials Tresca is for Poisson's ratios from 1/4"),
        (len(row.missing) > 0, "not known of layers", ", ".join(row.missing)),
        *((found is not None, "note", words) for words in conform),
        *((True, "note", words) for words in _units_in_doubt([row])),
    ]
    return [_line(label, words) for holds, label, words in notes if holds]


def _units_in_doubt(rows: Sequence[Row]) -> list[str]:
    """Returns what makes the units doubtful, and in how many of several rows."""
    solutions = [row.solution for row in rows if row.solution is not None]
    notes = []
    if solutions and not solutions[0].contact.has_modulus:
        notes.append("no modulus is given: pressures are those of kappa = 1")
    if steep := sum(solution.is_steep for solution in solutions):
        where = f" in {steep} of {len(rows)}" if len(rows) > 1 else ""
        notes.append(f"slopes exceed 0.3{where}, too steep for half-planes: check the units")
    return notes


def table(scene: Scene, rows: Sequence[Row], yield_stress: float | None) -> str:
    """Returns a table of several solutions: a line for each, and as many numbers as fit."""
    loads = all(row.control.keys() == {"load"} for row in rows)
    first = [f"{row.control['load']:g}" if loads else described(row.control) for row in rows]
    columns = [["load", scene.units.get("load", ""), *first] if loads else ["prescribed", "", *first]]
    wide = max(map(len, columns[0]))
    for name, head in list(_TABLE.items())[loads:]:
        cells = _aligned([row.numbers[name] for row in rows])
        usual = {"nan", "0", "1"} if name == "contacts" else {"nan"}
        if not usual.issuperset(cells) and wide + _CELL * len(columns) <= _WIDTH:
            columns.append([head, scene.units.get(NUMBERS[name][0], ""), *cells])
    lines = [scene.title, ""] if scene.title else []
    for words, error in zip(zip(*columns, strict=True), [None, None, *(row.error for row in rows)], strict=True):
        cells = [f"{cell:>{_CELL}}" for cell in words[1:]] if error is None else ["  ", type(error).__name__]
        lines.append(f"{words[0]:>{wide}}{''.join(cells)}".rstrip())
    if yield_stress is not None:
        lines += ["", f"S: safety against yield at {yield_stress:g} {scene.units.get('pressure', '')}".rstrip()]
    if doubts := _units_in_doubt(rows):
        lines += ["", *(f"note: {words}" for words in doubts)]
    return "\n".join(lines)


def _aligned(values: Sequence[float]) -> list[str]:
    """Returns numbers of four or five digits, with equal decimals where their sizes allow it; counts as they are."""
    sizes = [abs(value) for value in values if math.isfinite(value) and value != 0.0]
    if all(isinstance(value, int) for value in values if not math.isnan(value)) or not sizes or not 1e-2 < min(sizes) <= max(sizes) < min(1e6, 100.0 * min(sizes)):
        return [text if len(text := f"{value:.4g}") < _CELL else f"{value:.3g}" for value in values]
    decimals = max(0, 4 - math.floor(math.log10(max(sizes))))
    return [f"{value:.{decimals}f}" for value in values]
