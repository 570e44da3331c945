"""A page to look at a contact under many loads, offline: `explore.html` with the data filled in."""

from __future__ import annotations

import html
import json
import math
import re
from base64 import b64encode
from collections.abc import Sequence
from importlib.resources import files
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ._numbers import FloatArray, Numbers, Range, as_numbers, as_side
from .below import bodies, materials
from .bodies import Body
from .contact import Contact, Material, contact_modulus
from .drawing import BESIDE, SHALLOW, before_loading, covered, heights, highest, is_infinite, period
from .errors import LineContactError
from .slipping import PartialSlip, Side, acting, slipped_again
from .solution import Solution

__all__ = ["explore"]

# Number of points of a curve: in each contact, outside each contact, and of a body before loading.
_INSIDE, _OUTSIDE, _BEFORE = 129, 33, 257
# Grid of the shear: distance from a limit at which its columns become less dense, in half-widths;
# number of columns for each contact, largest number of columns, and number of rows.
_FINE = 0.1
_COLUMNS, _MOST_COLUMNS, _ROWS = 64, 192, 40
# Number of steps in which the shear is stored, from zero to its largest value: finer than a screen
# shows.
_STEPS = 65535
# Depth of the row that stands for the surface under a traction, in half-widths: on the surface
# itself stress may be infinite at a tip.
_SURFACE = 1e-9
# Largest length that counts as zero, in periods: rounding.
_ROUNDING = 1e-12
# Largest number of characters of the description of a body.
_WORDS = 400


def explore(
    contact: Contact,
    loads: float | Numbers,
    path: str | PathLike[str],
    *,
    title: str = "Line contact",
    units: Sequence[str] = ("", "", ""),
    body: Side | None = None,
    friction: float | None = None,
    force: float = 0.0,
    tension: float = 0.0,
) -> Path:
    """Writes a page with a slider for the load: both bodies, the pressure, and the shear below it.

    The page is one file, which needs a browser but no network. The slider steps through the given
    loads: everything shown has been solved. A load that fails is marked on the slider, with the
    message of its error.

    Parameters
    ----------
    contact : Contact
        The scene.
    loads : array_like
        Loads per unit length: force/length. Equal ones are solved once.
    path : str or path-like
        File to write, such as "roller.html". An existing file is overwritten.
    title : str
        Heading of the page.
    units : (str, str, str)
        Names of the units of lengths, pressures and loads, to be shown with the numbers, such as
        ``("mm", "MPa", "N/mm")``.
    body : {"lower", "upper"}, optional
        Body whose shear is shown. Without friction half-planes have the same; if a body has a
        layer, the default is the first one that has.
    friction, force, tension : float, optional
        Arguments of `Contact.partial_slip`, the same under all loads. With them the page shows the
        traction, too, the stick zones, the largest tension along the surface of the lower body, and
        the shear in this body. A load too small for the force is marked as one that fails.

    Returns
    -------
    pathlib.Path
        Path of the page.

    Raises
    ------
    linecontact.errors.LineContactError
        The error of the first load, if all loads fail.

    Notes
    -----
    Each load takes a few milliseconds, nearly all of it for the shear; more if a slope jumps
    in the contact.

    The shapes of the loaded bodies are right, their heights only up to a rigid displacement: it is
    chosen so that the mean deformation at the two ends of the common x axis is zero. Without
    materials each surface is drawn with half of the deformation. The shear is the largest shear
    stress in the plane, equal in both bodies unless there is a traction or a layer.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> import linecontact as lc
    >>> roller = lc.Ellipse.circle(10.0, (-1.0, 1.0))
    >>> contact = lc.Contact(lc.Flat(), roller, contact_modulus=115e3)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     to = Path(folder) / "roller.html"
    ...     page = lc.explore(contact, np.linspace(100, 900, 5), to, units=("mm", "MPa", "N/mm"))
    ...     page.stat().st_size < 200_000
    True
    """
    page = Path(path)
    if not page.parent.is_dir():
        raise FileNotFoundError(f"no folder {page.parent}, for {page.name}")
    length, pressure, per_length = units
    along = acting(0.0 if friction is None else friction, force, tension)
    if friction is None and any(along):
        raise TypeError("force and tension are carried by friction: give friction, too")
    wanted = np.unique(as_numbers(loads, "loads"))
    if wanted.size == 0 or not np.all(np.isfinite(wanted)):
        raise ValueError("give at least one load, and finite ones")
    below = _below(contact, body)
    solved = _solved(contact, wanted.tolist(), None if friction is None else along)
    spans = [_window(_normal(one)) for one in solved.values() if not isinstance(one, LineContactError)]
    window = min((left for left, _ in spans), default=0.0), max((right for _, right in spans), default=0.0)
    frames = {load: _frame(one, window, below) for load, one in solved.items()}
    errors = [frame for frame in frames.values() if isinstance(frame, LineContactError)]
    if len(errors) == len(frames):
        raise errors[0]
    x = np.linspace(*window, _BEFORE)
    lower, upper = before_loading(contact, x)
    data = {
        "units": {"length": length, "pressure": pressure, "load": per_length},
        "bodies": {"lower": _words(contact.lower), "upper": _words(contact.upper)},
        "acting": None if friction is None else dict(zip(("friction", "force", "tension"), along, strict=True)),
        "below": below[0],
        "shared": contact._settings["materials"] is None,
        "window": window,
        "before": {"x": _packed(x), "lower": _packed(lower), "upper": _packed(upper)},
        "frames": [
            {"load": load, "error": f"{type(frame).__name__}: {frame}"}
            if isinstance(frame, LineContactError)
            else {"load": load, **frame}
            for load, frame in frames.items()
        ],
    }
    page.write_text(_filled(title, data), encoding="utf-8")
    return page


def _solved(
    contact: Contact, loads: list[float], along: tuple[float, float, float] | None
) -> dict[float, Solution | PartialSlip | LineContactError]:
    """Returns each load with its solution, or with its error."""
    found = dict[float, Solution | PartialSlip | LineContactError]()
    for load in loads:
        try:
            wanted = "load", [load], None
            one = contact.solve(load=load) if along is None else slipped_again(contact, wanted, along)
            is_apart = _normal(one).is_apart
            found[load] = LineContactError("apart: no load presses the bodies together") if is_apart else one
        except LineContactError as error:
            found[load] = error
    return found


def _normal(solved: Solution | PartialSlip) -> Solution:
    """Returns the solution under the load alone."""
    return solved.normal if isinstance(solved, PartialSlip) else solved


def _window(solution: Solution) -> Range:
    """Returns the range of x to be shown: the contacts and a margin on either side."""
    on, reach = solution.hull, covered(solution)
    beside = 2 * BESIDE * on.half_width
    return max(on.left - beside, reach[0]), min(on.right + beside, reach[1])


def _frame(
    solved: Solution | PartialSlip | LineContactError, window: Range, below: tuple[Side | None, float]
) -> dict[str, Any] | LineContactError:
    """Returns the data that the page shows for one load."""
    if isinstance(solved, LineContactError):
        return solved
    solution, slip = _normal(solved), solved if isinstance(solved, PartialSlip) else None
    try:
        numbers = {**_numbers(solution), "window": _window(solution)}
        if slip is not None:
            numbers |= {"stick_zones": slip.stick_zones, "tension": _shown(slip.max_tension(body="lower"))}
        return {**numbers, **_curves(solution, slip, window), **_field(solution, slip, window, below)}
    except LineContactError as error:
        return error


def _numbers(solution: Solution) -> dict[str, Any]:
    summary = solution.summary()
    contacts = [
        {
            "left": one.interval.left,
            "right": one.interval.right,
            "load": one.load,
            "peak": _shown(one.peak),
        }
        for one in solution.contacts()
    ]
    return {
        "contacts": contacts,
        "half_width": solution.half_width,
        "peak": _shown(summary.peak),
        "mean_pressure": summary.mean_pressure,
        "centre_of_pressure": summary.centre_of_pressure,
        "limits_error": summary.limits_error,
        "checked": summary.checked,
        "steep": solution.is_steep,
    }


def _shown(largest: Any) -> dict[str, Any]:
    """Returns a largest value and its place for JSON, which has None for an infinite one."""
    return {name: value if math.isfinite(value) else None for name, value in largest._asdict().items()}


def _curves(solution: Solution, slip: PartialSlip | None, window: Range) -> dict[str, Any]:
    """Returns pressure, gap and lower surface over x, from one end of the window to the other.

    With partial slip it also returns the traction.
    """
    sampled, _ = (solution if slip is None else slip).sample(_INSIDE)
    left_out = np.reshape(_left_out(solution, sampled), (-1, 2))
    inside = np.concatenate([np.column_stack([sampled, solution.pressure(sampled)]), left_out])
    inside = np.concatenate([inside + (shift, 0.0) for shift in _shifts(solution, window)])
    beside = _beside(solution, window)
    table = np.concatenate([inside, np.column_stack([beside, np.zeros(beside.size)])])
    gaps = np.concatenate([np.zeros(len(inside)), solution.gap(beside)])
    order = np.argsort(table[:, 0], kind="stable")
    (x, pressures), gap = table[order].T, gaps[order]
    contact = solution.contact
    lower, upper = heights(contact, contact.lower, x), heights(contact, contact.upper, x)
    # Deformation of both surfaces together, less the approach of the bodies: the loaded gap minus
    # the gap before loading.
    given_way = gap - (upper - lower)
    ends = given_way[np.isfinite(given_way)][[0, -1]]
    drawn = pressures[np.isfinite(pressures)]
    peak, top = solution.peak().pressure, highest(solution)
    least, along = float(np.min(drawn, initial=0.0)), {}
    if slip is not None:
        # Where the pressure is infinite, the traction may be: it is left out there.
        traction, finite = np.full(x.size, np.nan), np.isfinite(pressures)
        traction[finite] = slip.traction(x[finite])
        along = {"traction": _packed(traction)}
        least = min(least, float(np.nanmin(traction)))
        top = max(top, float(np.nanmax(traction))) if math.isfinite(peak) else top
    return {
        **along,
        "shifts": _shifts(solution, window).tolist(),
        "x": _packed(x),
        "pressure": _packed(pressures),
        "gap": _packed(gap),
        "lower": _packed(lower - _share_of_lower(contact) * (given_way - np.mean(ends))),
        "pressure_axis": [max(least, -top), top],
    }


def _shifts(solution: Solution, window: Range) -> FloatArray:
    """Returns the distances at which contacts are repeated in the window: 0, and whole periods."""
    after, on = period(solution.contact), solution.hull
    if after is None:
        return np.zeros(1)
    # Rounding at the ends of the window makes no copy there.
    first, last = (window[0] - on.right) / after + _ROUNDING, (window[1] - on.left) / after - _ROUNDING
    return np.arange(math.ceil(first), math.floor(last) + 1, dtype=np.float64) * after


def _left_out(solution: Solution, sampled: FloatArray) -> list[tuple[float, float]]:
    """Returns the places that `sample` leaves out, with their pressures.

    They are corners at the ends, and the largest pressure.
    """
    found = []
    for x, strength in zip(solution.hull, solution.edge_singularities, strict=True):
        if x not in sampled:
            pressure = math.copysign(math.inf, strength) if is_infinite(solution, strength) else 0.0
            found.append((x, pressure))
    peak = solution.peak()
    if peak.x not in (*sampled, *solution.hull):
        found.append((peak.x, solution.pressure(peak.x)))
    return found


def _beside(solution: Solution, window: Range) -> FloatArray:
    """Returns places outside and between the contacts, denser next to the limits.

    Places beyond a corner that is pressed, where one of the bodies ends, are left out.
    """
    pressed = [strength > 0.0 and is_infinite(solution, strength) for strength in solution.edge_singularities]
    limits = np.ravel(np.add.outer(_shifts(solution, window), np.ravel(solution.intervals)))
    bounds = np.reshape([window[0], *np.clip(limits, *window), window[1]], (-1, 2))
    bounds = bounds[int(pressed[0]) : len(bounds) - int(pressed[1])]
    bounds = bounds[bounds[:, 0] < bounds[:, 1]]
    share = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, _OUTSIDE))
    # Weights of both ends, so that both ends are met without rounding.
    places = bounds[:, :1] * share[::-1] + bounds[:, 1:] * share
    return places[~np.isin(places, limits)]


def _share_of_lower(contact: Contact) -> float:
    """Returns the lower body's share of the deformation: half without materials."""
    surfaces = contact._surfaces()
    if not surfaces:
        return 0.5
    lower, upper = surfaces
    if lower == Material.rigid():
        return 0.0
    plane = contact._settings["plane"]
    alone = contact_modulus(lower, Material.rigid(), plane)
    return contact_modulus(lower, upper, plane) / alone


def _below(contact: Contact, body: Side | None) -> tuple[Side | None, float]:
    """Returns the body whose shear is shown, and its largest depth."""
    as_side(body)
    found = dict(bodies(contact))
    if None in found:
        return None, found[None]
    coated = [one.body for one in materials(contact) if one.words.endswith("layer")]
    chosen = body or next(iter(coated), None) or next(iter(found), "lower")
    if chosen not in found:
        raise ValueError(f"the {chosen} body is rigid, or has several layers: its shear is not known")
    return chosen, found[chosen]


def _field(
    solution: Solution, slip: PartialSlip | None, window: Range, below: tuple[Side | None, float]
) -> dict[str, Any]:
    """Returns the largest shear and its place, and the shear on a grid.

    The grid is finest at the limits of the contacts.
    """
    limits = np.array(solution.intervals)
    fine = _FINE * 0.5 * (limits[:, 1:] - limits[:, :1])
    columns = min(_COLUMNS * len(limits), _MOST_COLUMNS)
    x = _graded(window, limits, fine, columns)
    depth = _graded((0.0, 0.5 * (window[1] - window[0])), np.zeros_like(fine), fine, _ROWS)
    shear = np.zeros((depth.size, x.size))
    body, deepest = below
    rows = np.append(_SURFACE * solution.half_width, depth[1:])
    # Zero at the surface of half-planes: without friction the stress along x equals that across it.
    drawn = (rows <= deepest) & ((body is not None) | (depth > 0.0))
    if slip is None:
        shear[drawn] = solution.stress(x, rows[drawn, None], body=body).max_shear()
    else:
        shear = slip.stress(x, rows[:, None], body="lower").max_shear()
    largest = solution.max_shear(body=body) if slip is None else slip.max_shear(body="lower")
    finite = math.isfinite(largest.value)
    top = largest.value if finite else float(np.max(shear[depth >= SHALLOW * solution.half_width]))
    unit = float(np.max(shear)) / _STEPS
    field = {
        "x": _packed(x),
        "depth": _packed(depth),
        "unit": unit,
        "shear": _base64(np.round(shear / unit).astype("<u2")),
    }
    return {"shear": _shown(largest), "shear_axis": top, "field": field}


def _graded(span: Range, centres: FloatArray, widths: FloatArray, count: int) -> FloatArray:
    """Returns places over a span with the density 1/sqrt((x - c)² + w²), summed over centres.
    """
    every = np.linspace(*span, 4097)
    risen = np.sum(np.arcsinh((every[:, None, None] - centres) / widths), axis=(1, 2))
    return np.interp(np.linspace(risen[0], risen[-1], count), risen, every)


def _packed(numbers: FloatArray) -> str:
    """Encodes all digits of an array, for the page to decode."""
    return _base64(numbers.astype("<f8"))


def _base64(array: npt.NDArray[Any]) -> str:
    return b64encode(array.tobytes()).decode("ascii")


def _words(body: Body) -> str:
    words = re.sub(" at 0x[0-9a-f]+", "", repr(body))
    return words if len(words) <= _WORDS else words[: _WORDS - 1] + "…"


def _filled(title: str, data: dict[str, Any]) -> str:
    """Returns the page with the title and the data filled in."""
    parts = {
        "title": html.escape(title),
        # Escaped, so that no `<` in the data can end the script.
        "data": json.dumps(data, allow_nan=False).replace("<", "\\u003c"),
    }
    page = files(__package__).joinpath("explore.html").read_text(encoding="utf-8")
    return re.sub(r"\{\{(title|data)\}\}", lambda place: parts[place[1]], page)
