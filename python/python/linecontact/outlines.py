"""Bodies from drawings: lines and arcs by their dimensions, and polylines of DXF files."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, replace
from itertools import dropwhile
from os import PathLike, fspath
from typing import Any, Literal, NamedTuple

from . import _native
from ._numbers import Range, as_number, as_range, one_of
from .bodies import Body, Ellipse, Line, Piecewise, Step
from .errors import MeasuredFileError

__all__ = ["Outline", "read_outline"]

# Angle in radians below which two segments of a file are tangent: its numbers are rounded.
_TANGENT = 1e-6


@dataclass(frozen=True)
class Outline:
    """A body as it is dimensioned in a drawing, by straight lines and arcs.

    It begins level, and goes to the right. Each segment continues in the direction of the last, but
    after a `corner`, which a `fillet` rounds or a `chamfer` cuts. Lengths are along x, of sharp
    corners. A radius is positive for an arc that bulges downwards, as that of an upper body, and
    negative for one that bulges upwards. Each method returns a new outline; `body` joins it.

    Parameters
    ----------
    start : (float, float), optional
        Point at which it begins. Default: the origin.
    steps : sequence, optional
        Steps, as the methods add them.
    left_half : Outline, optional
        Right half whose mirror image stands to the left, as by `left`.
    unit : str, optional
        Unit of the drawing, such as "mm" or "in", if it states one; it converts nothing.

    Examples
    --------
    A roller along its axis: flat, then with a crown of 200 mm, and at 5.5 mm an edge at 45°, rounded
    by 0.1 mm.

    >>> import linecontact as lc
    >>> half = lc.Outline().line(4.0).arc(200.0, 1.5).corner(1.0).fillet(0.1).line(0.3)
    >>> roller = half.mirrored().body()
    >>> roller.pieces, [round(float(x), 3) for x in roller.at([0.0, 8.0])[0]]
    (8, [-5.8, 5.8])
    >>> solution = lc.solve(lc.Flat(), roller, contact_modulus=115e3, load=500.0)
    >>> 4.0 < solution.half_width < 5.5
    True
    """

    start: tuple[float, float] = (0.0, 0.0)
    steps: tuple[Step, ...] = ()
    left_half: Outline | None = None
    unit: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "start", as_range(self.start, "start"))
        object.__setattr__(self, "steps", tuple(self.steps))

    def _with(self, name: str, **numbers: Any) -> Outline:
        step = name, tuple(as_number(value, what) for what, value in numbers.items())
        return replace(self, steps=(*self.steps, step))

    def line(self, length: float) -> Outline:
        """Draws a straight line over a length along x."""
        return self._with("line", length=length)

    def arc(self, radius: float, length: float) -> Outline:
        """Draws an arc of a circle over a length along x."""
        return self._with("arc", radius=radius, length=length)

    def wall(self, height: float) -> Outline:
        """Draws an upright wall, up by a positive height or down by a negative one, along x 1.5e-8 of it, from the next segment.

        The next segment is level, but after a `corner`. A body that is to turn needs a slanted wall, by
        `corner`, `line` and another `corner`.
        """
        return self._with("wall", height=height)

    def corner(self, slope: float) -> Outline:
        """Makes a corner: the next segment starts with this slope dY/dX, whatever the slope before."""
        return self._with("corner", slope=slope)

    def fillet(self, radius: float) -> Outline:
        """Rounds the corner in front of the next segment."""
        return self._with("fillet", radius=radius)

    def chamfer(self, before: float, behind: float) -> Outline:
        """Cuts the corner in front of the next segment, from and to two lengths along x from it."""
        return self._with("chamfer", before=before, behind=behind)

    def left(self, half: Outline) -> Outline:
        """Draws another left half: the mirror image of `half`, which is drawn from the middle, too."""
        if half.left_half is not None:
            raise ValueError("the half has a left half itself: give what is drawn from the middle to one side")
        return replace(self, left_half=half)

    def mirrored(self) -> Outline:
        """Makes the body symmetric: the mirror image of what is drawn stands to its left."""
        return replace(self, left_half=replace(self, left_half=None))

    def body(self) -> Piecewise:
        """Joins the segments to a body.

        Raises
        ------
        linecontact.errors.PiecewiseInSegmentError
            For a segment that cannot be drawn, with its number from 1.
        linecontact.errors.PiecewiseNoPiecesError
            If nothing is drawn.
        """

        def steps(of: Outline) -> list[tuple[str, list[float]]]:
            return [(name, list(numbers)) for name, numbers in of.steps]

        half = self.left_half
        left = None if half is None else (half.start, steps(half))
        parts: list[Body] = []
        pieces, tolerance = _native.outline(self.start, steps(self), left)
        for radius, slope, ends, at in pieces:
            shape = Line(slope, ends) if radius is None else Ellipse.circle(radius, ends)
            parts.append(shape.shifted(*at))
        return Piecewise(parts, tolerance)


def read_outline(
    path: str | PathLike[str], *, layer: str | None = None, facing: Literal["up", "down"] | None = None
) -> Outline:
    """Reads a polyline of lines and arcs from a DXF file, in the `unit` of the file.

    Needs ezdxf: ``pip install './python[dxf]'``. The arcs are those of the polyline, by its
    bulges: exact. Segments that meet at less than 1e-6 radians are tangent.

    Parameters
    ----------
    path : str or path-like
        File.
    layer : str, optional
        Layer of the polyline. Default: any; there must be only one polyline.
    facing : {"up", "down"}, optional
        Part of a closed polyline: the upper one, for a lower body, or the lower one, for an upper
        body. Upright lines at its ends are left out.

    Returns
    -------
    Outline

    Raises
    ------
    linecontact.errors.MeasuredFileError
        With the file and the reason, and the number of a segment that turns back.
    OSError
        If the file cannot be opened.
    ImportError
        If ezdxf is not installed.

    Examples
    --------
    >>> import tempfile, pathlib, ezdxf
    >>> import linecontact as lc
    >>> file = pathlib.Path(tempfile.mkdtemp()) / "roller.dxf"
    >>> drawing = ezdxf.new()
    >>> _ = drawing.modelspace().add_lwpolyline([(-3, 0), (0, 0, 0.1), (2, 0.4)], format="xyb")
    >>> drawing.saveas(file)
    >>> lc.read_outline(file).body().pieces
    2
    """
    name = fspath(path)
    if facing is not None:
        one_of(facing, "facing", ("up", "down"))
    edges, is_closed, unit = _polyline(name, layer)
    if is_closed and facing is None:
        raise MeasuredFileError(name, "the polyline is closed: facing='up' takes its upper part, facing='down' the lower")
    # Drawn to the right: the lower part of a closed line has the body on its left.
    turn = sum(map(_area, edges)) if is_closed else edges[-1].end[0] - edges[0].start[0]
    if (turn < 0.0) != (is_closed and facing == "up"):
        edges = [_Edge(edge.end, edge.start, -edge.bulge) for edge in reversed(edges)]
    if is_closed:
        first = min(range(len(edges)), key=lambda at: edges[at].start[0])
        edges = edges[first:] + edges[:first]
        last = max(range(len(edges)), key=lambda at: edges[at].end[0])
        edges = list(dropwhile(lambda edge: edge.start[0] == edge.end[0], edges[: last + 1]))
    outline, angle = Outline(edges[0].start, unit=unit), 0.0
    for number, (start, end, bulge) in enumerate(edges, 1):
        run, chord = end[0] - start[0], math.atan2(end[1] - start[1], end[0] - start[0])
        begins, ends = chord - 2.0 * math.atan(bulge), chord + 2.0 * math.atan(bulge)
        if not bulge and abs(run) <= _TANGENT * math.dist(start, end):
            # What is behind a wall is level, or has its corner.
            outline, angle = outline.wall(end[1] - start[1]), 0.0
            continue
        if run <= 0.0 or max(abs(begins), abs(ends)) > 0.5 * math.pi + _TANGENT:
            where = f"from ({start[0]:g}, {start[1]:g}) to ({end[0]:g}, {end[1]:g})"
            raise MeasuredFileError(name, f"segment {number} of the polyline, {where}, turns back in x: end it there")
        if abs(begins - angle) > _TANGENT:
            outline = outline.corner(math.tan(max(-0.5 * math.pi, min(0.5 * math.pi, begins))))
        outline = outline.arc(_radius(start, end, bulge), run) if bulge else outline.line(run)
        angle = ends
    return outline


class _Edge(NamedTuple):
    """Line, or arc whose bulge is the tangent of a quarter of its angle, positive if it turns to the left."""

    start: Range
    end: Range
    bulge: float


def _radius(start: Range, end: Range, bulge: float) -> float:
    return math.dist(start, end) * (1.0 + bulge**2) / (4.0 * bulge)


def _area(edge: _Edge) -> float:
    """Returns twice the area between an edge and the origin, positive on its left."""
    (x, y), (to_x, to_y), bulge = edge
    angle = 4.0 * math.atan(bulge)
    cap = _radius(*edge) ** 2 * (angle - math.sin(angle)) if bulge else 0.0
    return x * to_y - to_x * y + cap


def _polyline(name: str, layer: str | None) -> tuple[list[_Edge], bool, str]:
    """Returns the edges of the polyline of a file, whether it is closed, and the unit."""
    try:
        import ezdxf
    except ImportError:
        raise ImportError("DXF files are read by ezdxf: pip install './python[dxf]'") from None
    try:
        drawing = ezdxf.readfile(name)
    except (ezdxf.DXFError, OSError) as error:
        # An error without a number is no fault of the system: ezdxf refuses what is no DXF file.
        if getattr(error, "errno", None) is not None:
            raise
        raise MeasuredFileError(name, f"no DXF file: {error}") from None
    space = drawing.modelspace()
    lines = [one for one in space.query("LWPOLYLINE POLYLINE") if layer in (None, one.dxf.layer)]
    if len(lines) != 1:
        on = "" if layer is None else f" on layer {layer!r}"
        there = sorted({one.dxf.layer for one in space.query("LWPOLYLINE POLYLINE")})
        remedy = f"give the layer of one: there are {there}"
        if len({one.dxf.layer for one in lines}) == 1:
            remedy = f"they share the layer {lines[0].dxf.layer!r}: move the one that is meant to a layer of its own"
        elif not there:
            found = dict(Counter(one.dxftype() for one in space))
            remedy = f"join lines and arcs to a polyline first, explode blocks, turn splines into arcs: there are {found}"
        raise MeasuredFileError(name, f"{len(lines)} polylines{on}: {remedy}")
    [line] = lines
    if line.dxftype() == "LWPOLYLINE":
        points = [(x, y, bulge) for x, y, bulge in line.get_points("xyb")]
        is_closed = bool(line.closed)
    elif line.is_2d_polyline:
        points = [(*one.dxf.location.vec2, one.dxf.bulge) for one in line.vertices]
        is_closed = bool(line.is_closed)
    else:
        raise MeasuredFileError(name, "the polyline is not in a plane")
    # Seen from behind: left and right are exchanged.
    side = -1.0 if line.dxf.extrusion.z < 0.0 else 1.0
    places = [(side * x, y) for x, y, _ in points]
    edges = [_Edge(p, q, side * at[2]) for p, q, at in zip(places, places[1:] + places[:1], points, strict=True)]
    edges = [edge for edge in (edges if is_closed else edges[:-1]) if edge.start != edge.end]
    if not edges:
        raise MeasuredFileError(name, "the polyline has no segments")
    return edges, is_closed, ezdxf.units.decode(drawing.units if drawing.units in range(25) else 0) or ""
