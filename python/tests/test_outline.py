"""Bodies from drawings: the builder, and polylines of DXF files."""

from __future__ import annotations

import math
import pickle
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import linecontact as lc
from linecontact.files import Scene

HALF = lc.Outline().line(4.0).arc(200.0, 1.5).corner(1.0).fillet(0.1).line(0.3)


def ends(body: lc.Body) -> list[tuple[float, float]]:
    """Returns the points at which pieces begin, and the last end."""
    x, y, *_ = body.at(np.arange(body.pieces + 1.0))
    return list(zip(x.tolist(), y.tolist(), strict=True))


def test_lines_arcs_and_fillets() -> None:
    body = HALF.body()
    tilt = math.asin(1.5 / 200.0)
    rise = 400.0 * math.sin(0.5 * tilt) ** 2
    found = ends(body)
    assert body.pieces == 4
    np.testing.assert_allclose(found[1], (4.0, 0.0), atol=1e-15)
    np.testing.assert_allclose(found[4], (5.8, rise + 0.3), rtol=1e-14)
    # The centre of the fillet is at its radius from the line, and inside the crown.
    fillet: Any = body.parts[2]
    centre = np.array(fillet.steps[0][1]) + (0.0, 0.1)
    from_line = (centre[1] - rise - (centre[0] - 5.5)) / math.sqrt(2.0)
    assert math.isclose(from_line, 0.1, rel_tol=1e-12)
    assert math.isclose(math.dist(centre, (4.0, 200.0)), 200.0 - 0.1, rel_tol=1e-14)


def test_halves() -> None:
    both = HALF.mirrored().body()
    np.testing.assert_allclose(ends(both), [(-x, y) for x, y in ends(both)[::-1]], rtol=1e-13, atol=1e-15)
    assert both.pieces == 8
    other = HALF.left(lc.Outline().arc(-3.0, 1.0)).body()
    assert other.pieces == 5 and math.isclose(ends(other)[0][0], -1.0)
    moved = lc.Outline((2.0, 1.0)).line(1.0).mirrored().body()
    np.testing.assert_allclose(ends(moved), [(1.0, 1.0), (2.0, 1.0), (3.0, 1.0)])
    with pytest.raises(ValueError, match="has a left half itself"):
        HALF.left(HALF.mirrored())


def test_an_outline_is_a_value(tmp_path: Path) -> None:
    assert HALF.mirrored() == pickle.loads(pickle.dumps(HALF.mirrored())) != HALF
    assert HALF.line(1.0) != HALF and len(HALF.steps) == 5
    chamfered = lc.Outline().line(1).corner(1.0).chamfer(0.25, 0.5).line(1)
    np.testing.assert_allclose(ends(chamfered.body()), [(0, 0), (0.75, 0), (1.5, 0.5), (2, 1)], atol=1e-15)
    scene = Scene(lc.Contact(lc.Flat(), HALF.mirrored().body(), contact_modulus=115e3))
    scene.to_file(tmp_path / "scene.toml")
    assert Scene.from_file(tmp_path / "scene.toml").contact.upper == scene.contact.upper


def test_errors_name_the_segment() -> None:
    with pytest.raises(lc.errors.PiecewiseInSegmentError, match="segment 2 of the outline: the radius is 0") as raised:
        lc.Outline().line(1.0).arc(0.0, 1.0).body()
    assert raised.value.segment == 2
    assert isinstance(raised.value.source, lc.errors.ProfileParameterError)
    with pytest.raises(lc.errors.PiecewiseInSegmentError, match="the radius of the fillet in front of it is 9"):
        lc.Outline().line(1.0).corner(1.0).fillet(9.0).line(1.0).mirrored().body()
    with pytest.raises(lc.errors.PiecewiseNoPiecesError):
        lc.Outline().body()
    with pytest.raises(TypeError, match="length is '1'"):
        lc.Outline().line("1")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="start is 3"):
        lc.Outline(3)  # type: ignore[arg-type]


def test_segments_meet_where_circles_are_far_away() -> None:
    """The crown of a tapered roller, drawn where it is."""
    tilt = math.tan(math.radians(15.0))
    body = lc.Outline((-7.0, 1.5)).corner(tilt).line(0.3).arc(-1e6, 20.0).corner(tilt - 1.0).fillet(0.5).line(1.0).body()
    assert body.pieces == 4 and body.tolerance is not None and 1e-13 < body.tolerance < 1e-7


# Polylines of DXF files.

ezdxf: Any = pytest.importorskip("ezdxf")


def drawn(folder: Path, *polylines: list[tuple[float, float, float]], old: bool = False, **attributes: Any) -> Path:
    """Writes polylines of x, y and bulge, each on a layer of its own, in inches."""
    drawing = ezdxf.new("R2010", units=1)
    for at, points in enumerate(polylines):
        given = {"dxfattribs": {"layer": attributes.get("layer", f"part{at}"), **attributes.get("dxf", {})}}
        space = drawing.modelspace()
        if old:
            line = space.add_polyline2d(points, format="xyb", **given)
        else:
            line = space.add_lwpolyline(points, format="xyb", **given)
        if attributes.get("close"):
            line.close(True)
    file = folder / "part.dxf"
    drawing.saveas(file)
    return file


def bulge(radius: float, chord: float) -> float:
    return math.tan(0.5 * math.asin(chord / (2.0 * radius)))


@pytest.mark.parametrize("old", [True, False])
@pytest.mark.parametrize("way", ["right", "left", "behind"])
def test_a_polyline_with_bulges(old: bool, way: str, tmp_path: Path) -> None:
    """A flat of 4 mm, a tangent arc of 10 mm, and its tangent, drawn in either direction and from behind."""
    angle = math.asin(0.3)
    end = (4.0 + 3.0, 10.0 * (1.0 - math.cos(angle)))
    points = [(0.0, 0.0, 0.0), (4.0, 0.0, math.tan(angle / 4)), (*end, 0.0), (end[0] + 2.0, end[1] + 2.0 * math.tan(angle), 0.0)]
    given: dict[str, Any] = {}
    if way == "left":
        points = [(x, y, -before[2]) for (x, y, _), before in zip(points[::-1], [*points[-2::-1], (0.0, 0.0, 0.0)], strict=True)]
    if way == "behind":
        points = [(-x, y, -b) for x, y, b in points]
        given = {"dxf": {"extrusion": (0, 0, -1)}}
    outline = lc.read_outline(drawn(tmp_path, points, old=old, **given))
    assert [name for name, _ in outline.steps] == ["line", "arc", "line"] and outline.mirrored().unit == "in"
    np.testing.assert_allclose([*outline.steps[1][1]], [10.0, 3.0], rtol=1e-14)
    want = lc.Outline().line(4.0).arc(10.0, 3.0).line(2.0).body()
    np.testing.assert_allclose(ends(outline.body()), ends(want), rtol=1e-14, atol=1e-15)


def test_corners_and_upright_arcs(tmp_path: Path) -> None:
    file = drawn(tmp_path, [(-1.0, 0.0, 1.0), (1.0, 0.0, 0.0), (2.0, 0.5, bulge(-5.0, 2.0)), (4.0, 0.5, 0.0), (5.0, 0.5, 0.0)])
    body = lc.read_outline(file).body()
    found = ends(body)
    np.testing.assert_allclose(found, [(-1, 0), (1, 0), (2, 0.5), (4, 0.5), (5, 0.5)], atol=2e-15)
    x = np.linspace(-0.99, 0.99, 9)
    np.testing.assert_allclose(body.heights(x), -np.sqrt(1 - x**2), atol=2e-13)
    x = np.linspace(2.01, 3.99, 9)
    np.testing.assert_allclose(body.heights(x), 0.5 + np.sqrt(25 - (x - 3) ** 2) - math.sqrt(24), rtol=1e-13)


@pytest.mark.parametrize("is_reversed", [True, False])
def test_a_closed_polyline(is_reversed: bool, tmp_path: Path) -> None:
    """A block with a crowned upper and a chamfered lower side; the drawing begins in the middle of a side."""
    top = bulge(-50.0, 10.0)
    corners = [(5.0, 1.0, 0.0), (5.0, 4.0, -top), (-5.0, 4.0, 0.0), (-5.0, 1.0, 0.0), (-4.0, 0.0, 0.0), (4.0, 0.0, 0.0)]
    if is_reversed:
        corners = [(x, y, -before[2]) for (x, y, _), before in zip(corners[::-1], [*corners[-2::-1], corners[-1]], strict=True)]
    file = drawn(tmp_path, corners, close=True)
    upper = lc.read_outline(file, facing="up").body()
    np.testing.assert_allclose(ends(upper), [(-5, 4), (5, 4)], atol=1e-14)
    assert math.isclose(float(upper.heights(0.0)), 4.0 + 50.0 - math.sqrt(2500.0 - 25.0), rel_tol=1e-13)
    lower = lc.read_outline(file, facing="down").body()
    np.testing.assert_allclose(ends(lower), [(-5, 1), (-4, 0), (4, 0), (5, 1)], atol=1e-14)
    with pytest.raises(lc.errors.MeasuredFileError, match="is closed: facing='up' takes its upper part"):
        lc.read_outline(file)
    # An upright side between the ends is none to be left out, but a wall.
    groove = [(1.0, 4.0, 0.0), (1.0, 3.0, 0.0), (-1.0, 3.0, 0.0), (-1.0, 4.0, 0.0), (-5.0, 4.0, 0.0), (5.0, 1.0, 0.0), (5.0, 4.0, 0.0)]
    pad = lc.read_outline(drawn(tmp_path, groove, close=True), facing="up")
    assert [step for step in pad.steps if step[0] != "corner"] == [("line", (4.0,)), ("wall", (-1.0,)), ("line", (2.0,)), ("wall", (1.0,)), ("line", (4.0,))]
    found = ends(pad.body())
    np.testing.assert_allclose(found, [(-5, 4), (-1, 4), (-1, 3), (1, 3), (1, 4), (5, 4)], atol=5e-8)
    steep = drawn(tmp_path, [(-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, bulge(-1.0, 1.0)), (2.0, -1.0, 0.0)])
    np.testing.assert_allclose(ends(lc.read_outline(steep).body()), [(-1, 0), (0, 1), (0, -1), (2, -1)], atol=5e-8)
    circle = drawn(tmp_path, [(-2.0, 0.0, 1.0), (2.0, 0.0, 1.0)], close=True)
    for facing, height in (("up", 2.0), ("down", -2.0)):
        half = lc.read_outline(circle, facing=facing).body()  # type: ignore[arg-type]
        assert math.isclose(float(half.heights(0.0)), height, rel_tol=1e-14)


def test_the_layer_is_chosen(tmp_path: Path) -> None:
    file = drawn(tmp_path, [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)], [(0.0, 0.0, 0.0), (3.0, 0.0, 0.0)])
    assert lc.read_outline(file, layer="part1").steps == (("line", (3.0,)),)
    for layer, reason in [(None, r"2 polylines: give the layer of one: there are \['part0', 'part1'\]"), ("x", "0 polylines on layer 'x'")]:
        with pytest.raises(lc.errors.MeasuredFileError, match=reason):
            lc.read_outline(file, layer=layer)


def test_drawings_that_cannot_be_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(file: Path, reason: str) -> None:
        with pytest.raises(lc.errors.MeasuredFileError, match=reason) as raised:
            lc.read_outline(file)
        assert raised.value.path == str(file)

    refused(drawn(tmp_path, [(0.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.5, 2.0, 0.0), (3.0, 3.0, 0.0)]), "segment 2 of the polyline, from .1, 1. to .0.5, 2., turns back")
    refused(drawn(tmp_path, *2 * [[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)]], layer="0"), "2 polylines: they share the layer '0': move")
    refused(drawn(tmp_path, [(0.0, 0.0, 1.5), (1.0, 0.0, 0.0)]), "segment 1 of the polyline, .* turns back")
    refused(drawn(tmp_path, [(0.0, 0.0, 0.0)]), "has no segments")
    refused(drawn(tmp_path), "0 polylines: join lines and arcs to a polyline first, .* there are {}")
    text = tmp_path / "text.dxf"
    text.write_text("x;z\n0;1\n")
    refused(text, "no DXF file")
    space = ezdxf.new()
    space.modelspace().add_blockref("nut", (0, 0))
    space.modelspace().add_spline([(0, 0), (1, 0), (2, 1)])
    space.saveas(tmp_path / "space.dxf")
    refused(tmp_path / "space.dxf", "0 polylines: .*, explode blocks, turn splines into arcs: there are {'INSERT': 1, 'SPLINE': 1}")
    space.modelspace().add_polyline3d([(0, 0, 0), (1, 0, 1)])
    space.saveas(tmp_path / "space.dxf")
    refused(tmp_path / "space.dxf", "not in a plane")
    with pytest.raises(FileNotFoundError):
        lc.read_outline(tmp_path / "none.dxf")
    with pytest.raises(ValueError, match="facing is 'left'"):
        lc.read_outline(text, facing="left")  # type: ignore[arg-type]
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    with pytest.raises(ImportError, match=r"read by ezdxf: pip install './python\[dxf\]'"):
        lc.read_outline(text)


def test_flats_that_repeat_meet_to_the_rounding_of_the_rest() -> None:
    """Both flats of a wave of lines and arcs are at Y = 0, but for 2e-22 that the arcs between have left."""
    flat, radius, arc, slope = 0.040715110393712735, 108.25980320456668, 0.017732412922015998, 0.048707292073161206
    rise = lc.Outline().line(flat).arc(radius, arc).line(slope / 2).arc(-radius, arc)
    wave = rise.line(slope).arc(-radius, arc).line(slope / 2).arc(radius, arc).line(flat).body()
    contact = lc.Contact(lc.Flat(), wave, contact_modulus=115384.6, period=0.24977445662181186)
    for load in (1.45, 1.5, 1.55, 1.6):
        assert contact.solve(load=load).is_checked


def test_a_wall_leaves_a_drawing_as_long_as_it_is() -> None:
    body = lc.Outline((0.0, 0.1)).line(0.3).wall(-0.1).line(0.6).wall(0.1).line(0.3).body()
    np.testing.assert_allclose(ends(body), [(0, 0.1), (0.3, 0.1), (0.3, 0), (0.9, 0), (0.9, 0.1), (1.2, 0.1)], atol=3e-9)
    # A row of lands, which meet once a period.
    row = lc.solve(lc.Flat(), body, contact_modulus=1.0, load=1e-3, period=1.2)
    sin = math.sin(0.25 * math.pi)
    assert math.isclose(row.pressure(0.6), 1e-3 / 1.2 / sin, rel_tol=1e-7)


def test_a_drawing_may_end_with_a_wall_and_its_steps_may_vanish() -> None:
    punch = lc.Outline().line(3.0).wall(1.0)
    assert punch.mirrored().body().pieces == 4 and lc.Outline().line(1.0).wall(0.0).line(1.0).body().pieces == 2
    # A fillet of a nearly flat corner.
    flat = lc.Outline((-2.0, 0.0)).corner(-0.207).line(1.5).corner(-0.2063).fillet(439.6).line(1.5).body()
    assert flat.pieces == 3
    with pytest.raises(lc.errors.PiecewiseInPieceError, match="slant it"):
        lc.Outline().line(3.0).wall(1.0).line(1.0).body().rotated(1e-4)


def test_half_a_drawing_touches_first_at_its_end() -> None:
    for half in (lc.Outline().arc(10.0, 3.0).body(), lc.Parabola(10.0, (0.0, 3.0)), lc.Ellipse.circle(10.0, (0.0, 1.0))):
        with pytest.raises(lc.errors.DomainTooShortError, match="mirror image"):
            lc.solve(lc.Flat(), half, contact_modulus=115e3, load=5.0)
