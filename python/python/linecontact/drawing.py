"""Pictures of a solution: with matplotlib, and as a few lines of SVG."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from .below import bodies as bodies_below
from .bodies import Placed, Spline

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

    from matplotlib.axes import Axes
    from matplotlib.contour import ContourSet
    from matplotlib.figure import Figure

    from ._numbers import FloatArray
    from .bodies import Body
    from .contact import Contact
    from .finite_roller import RollerState
    from .slipping import PartialSlip, Side
    from .solution import Solution

# Margin shown on each side of the contacts, as a share of their width; and depth shown, in
# half-widths.
BESIDE = 0.5
_DEPTH = 2.0

# Ends of the scales where pressure or shear is infinite: this number of mean pressures, and the
# largest shear from this depth on, in half-widths.
_MEANS, SHALLOW = 3.0, 0.1

# Largest strength of a singularity that counts as zero, in mean pressures: rounding.
_ROUNDING = 1e-12

# Number of x at which the shear is drawn, over the whole picture, and again below the contacts.
_COLUMNS = 48

_WIDTH, _HEIGHT, _MARGIN = 320, 150, 24

# Units of lengths and pressures, and what their product is called.
_PRODUCTS = {("mm", "MPa"): "N/mm", ("m", "Pa"): "N/m", ("in", "psi"): "lbf/in"}


def svg(solution: Solution) -> str:
    """Draws the pressure over x, with the limits, the load and the largest pressure."""
    on = solution.hull
    x, pressures = solution.sample(49)
    top = float(np.max(pressures, initial=0.0))
    across = (_WIDTH - 2 * _MARGIN) / ((on.right - on.left) or 1.0)
    up = (_HEIGHT - 2 * _MARGIN) / (top or 1.0)
    base = _HEIGHT - _MARGIN
    left, right = _MARGIN, _WIDTH - _MARGIN
    place = [
        f"{left + (at - on.left) * across:.1f},{base - max(value, 0.0) * up:.1f}"
        for at, value in zip(x, pressures, strict=True)
    ]
    points = " ".join([f"{left},{base}", *place, f"{right},{base}"])
    words = 'font-family="sans-serif" font-size="11" fill="#333"'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_WIDTH}" height="{_HEIGHT}" '
        f'viewBox="0 0 {_WIDTH} {_HEIGHT}">'
        f'<rect width="{_WIDTH}" height="{_HEIGHT}" fill="#fff"/>'
        f'<polygon points="{points}" fill="#9ecae1" stroke="#08519c"/>'
        f'<path d="M8 {base}H{_WIDTH - 8}" stroke="#333"/>'
        f'<text x="{left}" y="{base + 15}" {words}>{on.left:.5g}</text>'
        f'<text x="{right}" y="{base + 15}" text-anchor="end" {words}>{on.right:.5g}</text>'
        f'<text x="8" y="15" {words}>load {solution.load:.5g}, pressure up to {top:.5g}</text></svg>'
    )


def period(contact: Contact) -> float | None:
    """Returns the length after which both bodies repeat, if they do."""
    found: float | None = contact._settings["period"]
    return found


def heights(contact: Contact, body: Body, x: FloatArray) -> FloatArray:
    """Returns the heights of a body of a contact, repeated with the period, if there is one."""
    left, right = _ends(body)
    after = period(contact)
    if after is not None and np.isfinite(left):
        x = np.minimum(left + np.mod(x - left, after), right)
    return body.heights(x)


def before_loading(contact: Contact, x: FloatArray, tilt: float = 0.0) -> tuple[FloatArray, FloatArray]:
    """Returns the heights of both bodies, brought together until they just touch."""
    lower, upper = heights(contact, contact.lower, x), heights(contact, contact.upper, x) + tilt * x
    shown = np.isfinite(lower) & np.isfinite(upper)
    touching = np.min((upper - lower)[shown], initial=np.inf)
    return lower, upper - touching if np.isfinite(touching) else upper


def is_infinite(solution: Solution, strength: float) -> bool:
    """Tells whether the strength of a singularity is more than rounding."""
    return abs(strength) > _ROUNDING * abs(solution.mean_pressure)


def highest(solution: Solution) -> float:
    """Returns the largest pressure to be shown: a few mean pressures, if it is infinite."""
    peak = solution.peak().pressure
    return peak if math.isfinite(peak) else _MEANS * abs(solution.mean_pressure)


def _infinite_at(solution: Solution) -> list[float]:
    """Returns limits of infinite pressure or tension, and the place of the largest pressure if it is infinite."""
    found = [
        x
        for one in solution.contacts()
        for x, strength in zip(one.interval, one.edge_singularities, strict=True)
        if is_infinite(solution, strength)
    ]
    peak = solution.peak()
    return sorted({*found, *([peak.x] if peak.pressure == math.inf else [])})


def _draw_traction(axes: Axes, slip: PartialSlip) -> float:
    """Draws the traction, and the largest that friction allows; returns the lowest."""
    x, tractions = slip.sample(257)
    limit = np.copysign(slip.friction, slip.force) * slip.normal.pressure(x)
    if _infinite_at(slip.normal):
        shown = np.abs(limit) <= max(1.0, slip.friction) * highest(slip.normal)
        x, tractions, limit = x[shown], tractions[shown], limit[shown]
    for number, on in enumerate(slip.normal.intervals):
        inside = (x >= on.left) & (x <= on.right)
        names = ("limit of friction", "traction on lower body") if number == 0 else (None, None)
        axes.plot(x[inside], limit[inside], ":", color="#a63603", label=names[0])
        axes.plot(x[inside], tractions[inside], color="#a63603", label=names[1])
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    return float(np.min(limit, initial=0.0))


def _figure(given: Figure | None, height: float) -> Figure:
    """Returns the figure given, or the current one of pyplot; makes one of this height in inches if it is not empty."""
    if given is not None:
        return given
    try:
        from matplotlib import pyplot
    except ImportError as missing:
        raise ImportError("plot() needs matplotlib: pip install matplotlib") from missing
    if pyplot.get_fignums() and not pyplot.gcf().axes:
        return pyplot.gcf()
    return pyplot.figure(figsize=(6.4, height), layout="constrained")


def plot_roller(state: RollerState, units: Sequence[str], given: Figure | None) -> Figure:
    """Draws load per unit length and largest pressure along the axis, one below the other."""
    if isinstance(units, str) or len(units) != 3:
        says = 'give names of the units of lengths, pressures and loads, as ("mm", "MPa", "N/mm")'
        raise TypeError(f"units are {units!r}: {says}")
    names = ("z", "largest pressure", "load per unit length")
    along, pressure, load = (f"{name} / {unit}" if unit else name for name, unit in zip(names, units, strict=True))
    figure = _figure(given, 5.6)
    loads, pressures = figure.subplots(2, 1, sharex=True)
    # The slices have the same width.
    whole = float(np.sum(state.loads))
    apart = float(np.ptp(state.z)) / max(state.z.size - 1, 1)
    width = state.load / whole if whole > 0.0 else apart or 1.0
    ends = np.append(state.z - 0.5 * width, state.z[-1] + 0.5 * width)
    for axes, label, values in ((loads, load, state.loads), (pressures, pressure, state.pressures)):
        axes.stairs(values, ends, fill=True, color="#9ecae1")
        axes.stairs(values, ends, color="#08519c")
        axes.set_ylim(bottom=0.0)
        axes.set_ylabel(label)
    force, _, length = units[2].rpartition("/")
    force = force if length == units[0] else f"{units[2]} {units[0]}"
    loads.set_title(f"load {state.load:.6g} {force}".rstrip() + f", misalignment {state.misalignment:.6g} rad")
    pressures.set_xlabel(along)
    return figure


def _draw_bodies(axes: Axes, x: FloatArray, heights: tuple[FloatArray, FloatArray], lengths: str) -> None:
    """Draws both bodies over x."""
    lower, upper = heights
    axes.plot(x, upper, color="#08519c", label="upper body")
    axes.plot(x, lower, color="#a63603", label="lower body")
    axes.set_ylabel(f"y before loading{lengths}")
    _name_lines(axes)


def _name_lines(axes: Axes) -> None:
    """Names the lines of the bodies below the picture, where the names cover none of them."""
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=4, frameon=False)


def _title(solution: Solution, units: Sequence[str], slip: PartialSlip | None) -> str:
    """Returns contacts, load and largest pressure with their units."""
    # A load per length is a pressure times a length.
    product = _PRODUCTS.get((units[0], units[1]), f"{units[1]} {units[0]}".strip())
    length, pressure, load = (f" {unit}" if unit else "" for unit in (*units, product)[:3])
    contacts, loaded = str(solution).splitlines()[:2]
    if (count := len(solution.intervals)) > 2:
        # All of them would be wider than the picture.
        contacts = f"{count} contacts from {solution.hull.left:.6g} to {solution.hull.right:.6g}"
    after = period(solution.contact)
    repeated = "" if after is None else f", period {after:.6g}{length}"
    then = ", " if slip is None else f", force {slip.force:.6g}{load}\n"
    loaded, _, peak = loaded.partition(", ")
    value, at, x = peak.partition(" at x = ")
    peak = f"{value}{pressure}{at}{x}{length}" if "infinite" not in value else f"pressure {_infinite_words(solution, length)}"
    return f"{contacts}{length}{repeated}\n{loaded}{load}{then}{peak}"


def _draw_points(axes: Axes, contact: Contact, up: float, tilt: float) -> None:
    """Draws the measured points of both bodies within the picture."""
    left, right = axes.get_xlim()
    for body, color, rise, turn in ((contact.upper, "#08519c", up, tilt), (contact.lower, "#a63603", 0.0, 0.0)):
        points = measured(body)
        if points is not None:
            if (after := period(contact)) is not None:
                # The picture is as wide as a period.
                points[:, 0] = left + np.mod(points[:, 0] - left, after)
            x, y = points[(points[:, 0] >= left) & (points[:, 0] <= right)].T
            axes.plot(x, y + rise + turn * x, ".", color=color, markersize=3, label="measured")
            _name_lines(axes)


def measured(body: Body) -> FloatArray | None:
    """Returns the measured points of a body as rows of x and y, placed as it is; None without any."""
    spline, steps = (body.body, body.steps) if isinstance(body, Placed) else (body, ())
    if not isinstance(spline, Spline):
        return None
    z: Any = spline.points @ (1.0, 1.0j)
    for step, numbers in steps:
        if step == "shifted":
            z = z + complex(*numbers)
        elif step == "rotated":
            z = z * np.exp(1.0j * numbers[0])
        elif step == "scaled":
            z = z * numbers[0]
        else:
            z = np.conj(z) if step == "flipped" else -np.conj(z)
    return np.column_stack([z.real, z.imag])


def _plot_apart(solution: Solution, lengths: str, given: Figure | None) -> Figure:
    """Draws bodies that are apart, all that they have in common."""
    figure = _figure(given, 3.2)
    axes, contact = figure.subplots(), solution.contact
    x = np.linspace(*covered(solution), 401)
    lower, upper = before_loading(contact, x)
    _draw_bodies(axes, x, (lower, upper + solution.separation), lengths)
    axes.legend(loc="best")
    axes.set_title(str(solution).splitlines()[0])
    axes.set_xlabel(f"x{lengths}")
    return figure


def _ends(body: Body) -> tuple[float, float]:
    """Returns the smallest and the largest x of a body."""
    left, right = np.sort(body.at(body.domain)[0])
    return float(left), float(right)


def covered(solution: Solution) -> tuple[float, float]:
    """Returns the range of x that both bodies cover; if they repeat, the period about the contacts."""
    contact, centre = solution.contact, solution.hull.centre
    after = period(contact)
    if after is not None:
        return centre - 0.5 * after, centre + 0.5 * after
    (left, right), (other_left, other_right) = _ends(contact.lower), _ends(contact.upper)
    return max(left, other_left), min(right, other_right)


def _scale(axes: Axes, solution: Solution, lowest: float, slip: PartialSlip | None, length: str) -> None:
    """Scales the axis of pressure, cut where the pressure is infinite, which it then says."""
    axes.set_ylim(bottom=lowest)
    if _infinite_at(solution):
        top = 1.05 * highest(solution) * max(1.0, slip.friction if slip else 1.0)
        axes.set_ylim(max(lowest, -top), top)
        # Below the axes, where no line goes through it.
        axes.text(1.0, -0.05, _infinite_words(solution, f" {length}"), transform=axes.transAxes, ha="right", va="top", fontsize="small")


def _infinite_words(solution: Solution, length: str) -> str:
    """Tells where the pressure is infinite."""
    places = _infinite_at(solution)
    where = f"x = {', '.join(f'{x:.6g}' for x in places)}{length}" if len(places) < 5 else f"{len(places)} places"
    return f"infinite at {where}".rstrip()


def _draw_shears(axes: Sequence[Axes], x: FloatArray, shears: Sequence[tuple[FloatArray, FloatArray]], solution: Solution) -> list[ContourSet]:
    """Draws the shear over depths in one scale; larger values, next to a place of infinite pressure, share one colour."""
    from matplotlib.ticker import MaxNLocator

    is_cut = bool(_infinite_at(solution))
    shown = [shear[depth >= min(SHALLOW * solution.half_width, depth[-1])] if is_cut else shear for depth, shear in shears]
    levels = MaxNLocator(13).tick_values(0.0, max(float(np.max(one)) for one in shown))
    extend = "max" if is_cut else "neither"
    return [on.contourf(x, *one, levels=levels, cmap="cividis", extend=extend) for on, one in zip(axes, shears, strict=True)]


def plot(solution: Solution, units: Sequence[str], given: Figure | None, slip: PartialSlip | None = None) -> Figure:
    """Draws bodies, pressure and subsurface shear, one below the other over the same x.

    With partial slip it draws the traction, too, and the shear is that in the lower body. If a body
    has a layer, each body has a picture of its shear.
    """
    if isinstance(units, str) or len(units) not in (2, 3):
        raise TypeError(f'units are {units!r}: give names of the units of lengths and pressures, as ("mm", "MPa")')
    lengths, pressures = (f" / {unit}" if unit else "" for unit in units[:2])
    on, contact = solution.hull, solution.contact
    of_each: Sequence[tuple[Side | None, float]] = [("lower", np.inf)] if slip else bodies_below(contact)
    if solution.is_apart:
        return _plot_apart(solution, lengths, given)
    # Of bodies that repeat one period is shown: not the next contacts, whose pressure is not drawn.
    beside = 2 * BESIDE * on.half_width if period(contact) is None else covered(solution)[1] - on.right
    x = np.linspace(on.left - beside, on.right + beside, 401)
    figure = _figure(given, 5.3 + 2.7 * len(of_each))
    bodies, pressure, *shears = figure.subplots(2 + len(of_each), 1, sharex=True)

    lower, upper = before_loading(contact, x, solution.tilt)
    bodies.set_xlim(x[0], x[-1])
    _draw_bodies(bodies, x, (lower, upper), lengths)
    _draw_points(bodies, contact, float(np.nanmax(upper - heights(contact, contact.upper, x))), solution.tilt)
    bodies.set_title(_title(solution, units, slip), fontsize="medium")

    places, values = solution.sample(257)
    for number, interval in enumerate(solution.intervals):
        inside = (places >= interval.left) & (places <= interval.right)
        pressure.fill_between(places[inside], values[inside], color="#9ecae1")
        name = "pressure" if number == 0 else None
        pressure.plot(places[inside], values[inside], color="#08519c", label=name)
    lowest = 0.0 if slip is None else 1.05 * _draw_traction(pressure, slip)
    _scale(pressure, solution, min(lowest, float(np.min(values, initial=0.0))), slip, units[0])
    pressure.set_ylabel(f"pressure{pressures}" if slip is None else f"pressure, traction{pressures}")

    # The depths start below the surface, where the pressure may be infinite. The places are denser
    # below each contact, and the depths start nearer to the surface where contacts are narrow.
    narrowest = min(interval.half_width for interval in solution.intervals)
    columns = max(_COLUMNS // len(solution.intervals), 3)
    below_each = [np.linspace(*interval, columns) for interval in solution.intervals]
    across = np.unique(np.concatenate([np.linspace(x[0], x[-1], _COLUMNS), *below_each]))
    found = list[tuple["FloatArray", "FloatArray"]]()
    for body, deepest in of_each:
        # In a layer on a rigid base down to the base.
        depth = np.geomspace(min(0.02 * narrowest, 0.1 * deepest), min(_DEPTH * on.half_width, deepest), 48)
        grid = across[None, :], np.minimum(depth, deepest)[:, None]
        stress = solution.stress(*grid, body=body) if slip is None else slip.stress(*grid, body="lower")
        found.append((depth, stress.max_shear()))
    # Below several layers no stress is known.
    drawn_each = _draw_shears(shears, across, found, solution) if found else []
    for below, drawn, (body, _) in zip(shears, drawn_each, of_each, strict=True):
        shear = f"largest shear in {body} body" if body else "largest shear"
        figure.colorbar(drawn, ax=below, label=f"{shear}{pressures}")
        below.invert_yaxis()
        below.set_ylabel(f"depth{lengths}")
    (shears or [pressure])[-1].set_xlabel(f"x{lengths}")
    return figure
