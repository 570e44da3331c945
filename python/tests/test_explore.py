"""Page of `explore`, read without a browser; `long/test_explore_in_browser.py` uses one."""

from __future__ import annotations

import base64
import json
import math
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
from scenes import Array, gear

import linecontact as lc
from linecontact import exploring

FLAT = lc.Flat()
BODY = lc.Parabola(1.0, (-1.0, 1.0))
STEEL = lc.Material(210e3, 0.3)
UNITS = ("mm", "MPa", "N/mm")


def bumps(x: Array) -> tuple[Any, ...]:
    return x, x**4 - 2 * x**2, 1.0, 4 * x**3 - 4 * x


def wave(x: Array) -> tuple[Any, ...]:
    return x, 0.01 * (1 - np.cos(2 * np.pi * x)), 1.0, 0.02 * np.pi * np.sin(2 * np.pi * x)


def ripple(x: Array) -> tuple[Any, ...]:
    return x, -0.003 * (1 - np.cos(4 * np.pi * x)), 1.0, -0.012 * np.pi * np.sin(4 * np.pi * x)


def read(page: Path) -> Any:
    """Returns the data of a page."""
    text = page.read_text(encoding="utf-8")
    data = re.findall(r'<script type="application/json" id="data">(.*?)</script>', text, re.DOTALL)
    assert len(data) == 1
    return json.loads(data[0])


def array(packed: str, kind: str = "<f8") -> Array:
    return np.frombuffer(base64.b64decode(packed), kind).astype(np.float64)


def shear_of(field: dict[str, Any]) -> tuple[Array, Array, Array]:
    x, depth = array(field["x"]), array(field["depth"])
    values = array(field["shear"], "<u2").reshape(depth.size, x.size)
    return x, depth, field["unit"] * values


CONTACTS: dict[str, tuple[lc.Contact, list[float]]] = {
    "hertz": (lc.Contact(FLAT, BODY, kappa=1.0), [0.02, 0.005]),
    "gear": (lc.Contact(*gear(), contact_modulus=115e3), [200.0]),
    "two contacts": (
        lc.Contact(FLAT, lc.Curve((-2, 2), bumps), contact_modulus=1.0),
        [0.1, 1.0, 3.0],
    ),
    "corner": (
        lc.Contact(FLAT, BODY, kappa=1.0, edges=(lc.Edge.fixed(-0.1), lc.Edge.free())),
        [0.01, 0.02],
    ),
    "punch": (
        lc.Contact(FLAT, FLAT, kappa=1.0, edges=(lc.Edge.fixed(-1.0), lc.Edge.fixed(1.0))),
        [0.02],
    ),
    "tip": (lc.Contact(FLAT, lc.Wedge((-0.1, 0.1), 1.0), kappa=1.0), [0.02]),
    "adhesive": (
        lc.Contact(FLAT, BODY, kappa=1.0, edges=(lc.Edge.adhesive(1e-4), lc.Edge.adhesive(1e-4))),
        [-0.001, 0.0, 0.02],
    ),
    # Their contacts go across the ends of the described periods, 0 and 1, and 0.3 and 1.3.
    "repeated": (
        lc.Contact(lc.Curve((0.3, 1.3), ripple), lc.Curve((0, 1), wave), contact_modulus=1e3, period=1.0),
        [1.0, 10.0, 20.0],
    ),
    "end of a body": (lc.Contact(FLAT, lc.Parabola(1.0, (-0.21, 1.0)), kappa=1.0), [0.02]),
}


@pytest.mark.parametrize("name", CONTACTS)
def test_the_numbers_are_those_of_the_solver(name: str, tmp_path: Path) -> None:
    contact, loads = CONTACTS[name]
    data = read(lc.explore(contact, loads, tmp_path / "page.html"))
    assert [frame["load"] for frame in data["frames"]] == sorted(loads)
    left, right = data["window"]
    for frame in data["frames"]:
        solution = contact.solve(load=frame["load"])
        summary = solution.summary()
        assert left <= solution.hull.left < solution.hull.right <= right
        assert frame["half_width"] == solution.half_width
        assert frame["mean_pressure"] == solution.mean_pressure
        assert frame["centre_of_pressure"] == summary.centre_of_pressure
        assert frame["limits_error"] == summary.limits_error
        assert frame["checked"] == solution.is_checked
        assert [(one["left"], one["right"]) for one in frame["contacts"]] == list(solution.intervals)
        assert [one["load"] for one in frame["contacts"]] == list(summary.loads)
        largest = solution.max_shear()
        assert left <= largest.x <= right
        for shown, found in ((frame["peak"], summary.peak), (frame["shear"], largest)):
            assert shown == {key: None if value == math.inf else value for key, value in found._asdict().items()}

        x, pressures, gap = (array(frame[key]) for key in ("x", "pressure", "gap"))
        assert np.all(np.diff(x) > 0.0) and left <= x[0] and x[-1] <= right
        finite = np.isfinite(pressures)
        np.testing.assert_array_equal(pressures[finite], solution.pressure(x[finite]))
        assert np.all(np.isinf(solution.pressure(x[~finite])))
        np.testing.assert_array_equal(gap, solution.gap(x))
        low, high = frame["pressure_axis"]
        assert low <= 0.0 < high < 1e3 * summary.mean_pressure or name == "adhesive"

        at, depth, shear = shear_of(frame["field"])
        assert (at[0], at[-1]) == (left, right)
        assert math.isclose(depth[-1], 0.5 * (right - left)) and depth[0] == 0.0
        exact = solution.stress(at, depth[1:, None]).max_shear()
        np.testing.assert_allclose(shear[1:], exact, rtol=0.0, atol=0.51 * frame["field"]["unit"])
        assert 0.0 < frame["shear_axis"] <= (frame["shear"]["value"] or math.inf)


def test_bodies_that_repeat_are_drawn_about_the_contacts(tmp_path: Path) -> None:
    contact, loads = CONTACTS["repeated"]
    data = read(lc.explore(contact, loads, tmp_path / "page.html"))
    left, right = data["window"]
    before = {name: array(packed) for name, packed in data["before"].items()}
    touching = np.nanmin(wave(before["x"])[1] - ripple(before["x"])[1])
    np.testing.assert_allclose(before["lower"], ripple(before["x"])[1], atol=1e-13)
    np.testing.assert_allclose(before["upper"], wave(before["x"])[1] - touching, atol=1e-13)
    for frame in data["frames"]:
        x, gap, lower = (array(frame[key]) for key in ("x", "gap", "lower"))
        assert (x[0], x[-1]) == (left, right) and np.all(np.isfinite(lower))
        hull = [frame["contacts"][0]["left"], frame["contacts"][-1]["right"]]
        assert left < hull[0] - 0.05 and hull[1] + 0.05 < right and frame["shifts"] == [0.0]
        assert np.all(gap[(x < hull[0]) | (x > hull[1])] > 0.0)


def test_a_contact_that_is_shown_again_is_pressed_there_too() -> None:
    solution = CONTACTS["repeated"][0].solve(load=1.0)
    (on,) = solution.intervals
    found = exploring._curves(solution, None, (on.centre - 0.7, on.right + 1.1))
    x, pressure, gap = (array(found[key]) for key in ("x", "pressure", "gap"))
    assert found["shifts"] == [0.0, 1.0] and np.all(np.diff(x) > 0.0)
    again = (x >= on.left + 1.0) & (x <= on.right + 1.0)
    assert np.sum(again) > 100 and np.all(gap[again] == 0.0) and np.max(pressure[again]) == solution.peak().pressure
    np.testing.assert_allclose(pressure, solution.pressure(x), rtol=1e-6, atol=1e-6)


def test_what_is_infinite(tmp_path: Path) -> None:
    ends = {"corner": (math.inf, 0.0), "punch": (math.inf, math.inf), "adhesive": (-math.inf, -math.inf)}
    for name, (left, right) in ends.items():
        contact, loads = CONTACTS[name]
        (frame,) = read(lc.explore(contact, loads[-1], tmp_path / "page.html"))["frames"]
        x, pressures = array(frame["x"]), array(frame["pressure"])
        (on,) = frame["contacts"]
        assert pressures[x == on["left"]].tolist() == [left]
        assert pressures[x == on["right"]].tolist() == [right]
        # There is no body beyond a corner.
        assert (x[0] < on["left"]) == (left <= 0.0)
        assert (x[-1] > on["right"]) == (right <= 0.0)


SLIPS: dict[str, tuple[str, list[float], dict[str, Any]]] = {
    "hertz": ("hertz", [0.02, 0.01], {"friction": 0.4, "force": 0.003, "tension": 0.002}),
    "two contacts": ("two contacts", [1.0, 3.0], {"friction": 0.9, "force": -0.7}),
    "strong friction": ("gear", [200.0], {"friction": 3.0, "force": 500.0}),
    "tip": ("tip", [0.02], {"friction": 0.3, "force": 0.002}),
    "corner": ("corner", [0.02], {"friction": 0.3, "force": 0.002}),
    "punch": ("punch", [0.02], {"friction": 0.3, "force": -0.002}),
    "no force": ("hertz", [0.02], {"friction": 0.3}),
}


@pytest.mark.parametrize("name", SLIPS)
def test_the_traction_is_that_of_partial_slip(name: str, tmp_path: Path) -> None:
    scene, loads, given = SLIPS[name]
    contact = CONTACTS[scene][0]
    acting: dict[str, Any] = {"force": 0.0, "tension": 0.0, **given}
    data = read(lc.explore(contact, loads, tmp_path / "page.html", **given))
    assert data["acting"] == acting
    for frame in data["frames"]:
        slip = contact.partial_slip(load=frame["load"], **acting)
        assert [tuple(zone) for zone in frame["stick_zones"]] == list(slip.stick_zones)
        x, pressures, traction = (array(frame[key]) for key in ("x", "pressure", "traction"))
        finite = np.isfinite(pressures)
        np.testing.assert_array_equal(traction[finite], slip.traction(x[finite]))
        assert np.all(np.isnan(traction[~finite]))
        inside = {limit for zone in slip.stick_zones for limit in zone if slip.normal.pressure(limit - 1e-6) > 0.0}
        assert name in ("punch", "no force") or inside <= set(x)
        low, high = frame["pressure_axis"]
        if frame["peak"]["pressure"] is not None:
            assert low <= np.min(traction) and np.max(traction) <= high
        for key, of in (("tension", slip.max_tension), ("shear", slip.max_shear)):
            exact = of(body="lower")
            assert frame[key]["x"] == exact.x
            assert frame[key]["value"] == (exact.value if math.isfinite(exact.value) else None)
        at, depth, shear = shear_of(frame["field"])
        exact = slip.stress(at, depth[1:, None], body="lower").max_shear()
        np.testing.assert_allclose(shear[1:], exact, rtol=0.0, atol=0.51 * frame["field"]["unit"])
        if scene in ("hertz", "two contacts"):
            surface = slip.stress(at, 0.0, body="lower").max_shear()
            np.testing.assert_allclose(shear[0], surface, atol=1e-3 * np.max(surface) + frame["field"]["unit"])


def test_slip_all_over_is_marked(tmp_path: Path) -> None:
    contact, page = CONTACTS["hertz"][0], tmp_path / "page.html"
    wrong, right = read(lc.explore(contact, [0.005, 0.02], page, friction=0.4, force=0.003))["frames"]
    assert wrong["error"].startswith("SlipsEverywhereError: ") and "error" not in right
    assert read(lc.explore(contact, 0.02, page))["acting"] is None
    with pytest.raises(TypeError, match="give friction"):
        lc.explore(contact, 0.02, page, force=0.003)
    with pytest.raises(TypeError, match="give one number"):
        lc.explore(contact, 0.02, page, friction=0.4, force=[0.001, 0.002])  # type: ignore[arg-type]
    with pytest.raises(lc.errors.InvalidSlipFrictionError):
        lc.explore(contact, 0.02, page, friction=math.nan, force=0.003)


def test_the_picture_between_the_points_of_the_grid(tmp_path: Path) -> None:
    contact = CONTACTS["hertz"][0]
    # The smaller contact is a tenth as wide as the picture.
    frame, *_ = read(lc.explore(contact, [0.0005, 0.02], tmp_path / "page.html"))["frames"]
    solution = contact.solve(load=0.0005)
    size, peak = solution.half_width, solution.peak().pressure
    x, depth, shear = shear_of(frame["field"])
    random = np.random.default_rng(1)
    at, down = random.uniform(-3 * size, 3 * size, 400), random.uniform(0.0, 3 * size, 400)
    rows = np.array([np.interp(at, x, row) for row in shear])
    drawn = [np.interp(one, depth, column) for one, column in zip(down, rows.T, strict=True)]
    exact = solution.stress(at, down).max_shear()
    assert np.max(np.abs(np.array(drawn) - exact)) < 0.01 * peak
    # Shear on the axis, by the formula of Hertz's contact.
    z = depth / size
    axis = np.array([np.interp(0.0, x, row) for row in shear])
    np.testing.assert_allclose(axis, peak * (z - z**2 / np.sqrt(1 + z**2)), atol=0.002 * peak)


@pytest.mark.parametrize(
    ("materials", "curvature"),
    [
        (None, 0.5),
        ((STEEL, STEEL), 0.5),
        ((STEEL, lc.Material.rigid()), 1.0),
        ((lc.Material.rigid(), STEEL), 0.0),
        ((STEEL, lc.Material(70e3, 0.3)), 0.25),
    ],
)
def test_the_loaded_surface_of_a_flat(
    materials: tuple[lc.Material, lc.Material] | None, curvature: float, tmp_path: Path
) -> None:
    modulus = 115e3 if materials is None else None
    contact = lc.Contact(
        FLAT, lc.Parabola(10.0, (-1.0, 1.0)), contact_modulus=modulus, materials=materials
    )
    data = read(lc.explore(contact, [100.0, 500.0], tmp_path / "page.html"))
    assert data["shared"] == (materials is None)
    for frame in data["frames"]:
        x, lower, size = array(frame["x"]), array(frame["lower"]), frame["half_width"]
        inside = np.abs(x) <= size
        # Under Hertz's pressure the loaded surface is a parabola; its curvature is its share of
        # 1/R.
        bent = 2 * np.polyfit(x[inside] / size, lower[inside], 2)[0] / size**2
        assert math.isclose(bent, curvature / 10.0, rel_tol=1e-9, abs_tol=1e-12)
        # The ends of the picture stay in place.
        assert abs(lower[0] + lower[-1]) < 1e-15


def test_a_load_that_fails_is_kept_with_its_message(tmp_path: Path) -> None:
    contact = lc.Contact(FLAT, lc.Parabola(10.0, (-0.25, 0.25)), contact_modulus=115e3)
    data = read(lc.explore(contact, np.array([[900.0, 100.0], [-5.0, 100.0]]), tmp_path / "page.html"))
    wrong, right, long = data["frames"]
    assert [frame["load"] for frame in data["frames"]] == [-5.0, 100.0, 900.0]
    assert "error" not in right
    with pytest.raises(lc.LineContactError) as raised:
        contact.solve(load=-5.0)
    assert wrong == {"load": -5.0, "error": f"{type(raised.value).__name__}: {raised.value}"}
    assert long["error"].startswith("DomainTooShortError: ")


def test_what_is_refused(tmp_path: Path) -> None:
    contact, page = CONTACTS["hertz"][0], tmp_path / "page.html"
    with pytest.raises(lc.errors.DomainTooShortError):
        lc.explore(contact, [10.0, 20.0], page)
    for loads in ([], [0.02, math.nan], [math.inf]):
        with pytest.raises(ValueError, match="finite"):
            lc.explore(contact, loads, page)
    with pytest.raises(ValueError):
        lc.explore(contact, 0.02, page, units=("mm", "MPa"))
    assert not page.exists()

    def faulty(k: Array) -> tuple[Any, ...]:
        if k.size > 2:
            raise RuntimeError("mine")
        return k, k**2 / 2, 1.0, k

    with pytest.raises(RuntimeError, match="mine"):
        lc.explore(lc.Contact(FLAT, lc.Curve((-1, 1), faulty), kappa=1.0), 0.02, page)


class Tags(HTMLParser):
    """Parser that checks that elements are closed in the reverse order of their opening."""

    EMPTY = ("input", "link", "meta")

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[tuple[str, dict[str, str | None]]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append((tag, dict(attrs)))
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_the_page_stands_alone(tmp_path: Path) -> None:
    page = lc.explore(CONTACTS["hertz"][0], 0.02, str(tmp_path / "page.html"), units=UNITS)
    text = page.read_text(encoding="utf-8")
    tags = Tags()
    tags.feed(text)
    tags.close()
    assert tags.open == []
    for tag, attributes in tags.seen:
        assert "src" not in attributes
        assert attributes.get("href", "data:,") == "data:,"
        assert not any(name.startswith("on") for name in attributes), tag
    policy = next(of["content"] for tag, of in tags.seen if "http-equiv" in of)
    assert policy is not None and policy.startswith("default-src 'none';")
    words = re.sub(r"http-equiv", "", text)
    for network in ("http", "//www", "@import", "import(", "fetch(", "XMLHttpRequest", "WebSocket"):
        assert network not in words
    assert set(re.findall(r"url\((.)", text)) == {"#"}
    names = [of["id"] for _, of in tags.seen if "id" in of]
    assert len(names) == len(set(names))
    assert set(re.findall(r'\bid\("([a-z-]+)"\)', text)) <= set(names)


class Hostile:
    """Function whose `repr` ends scripts."""

    def __call__(self, k: Array) -> tuple[Any, ...]:
        return k, k**2 / 2, 1.0, k

    def __repr__(self) -> str:
        return "</script><script>alert(1)</script>" + "y" * 1000


def test_the_shear_of_a_body_with_a_layer(tmp_path: Path) -> None:
    materials = (STEEL, lc.Layer(lc.Material(5.0, 0.48), 0.05, "bonded"))
    contact = lc.Contact(FLAT, BODY, materials=materials)
    solution = contact.solve(load=0.1)
    sides: list[tuple[Literal["lower", "upper"] | None, Literal["lower", "upper"]]]
    sides = [(None, "upper"), ("lower", "lower"), ("upper", "upper")]
    for body, shown in sides:
        data = read(lc.explore(contact, 0.1, tmp_path / "page.html", body=body))
        [frame] = data["frames"]
        assert data["below"] == shown
        assert frame["shear"]["value"] == solution.max_shear(body=shown).value
        x, depth, shear = shear_of(frame["field"])
        inside = (depth > 0.0) & (depth <= (0.05 if shown == "upper" else math.inf))
        want = solution.stress(x, depth[inside, None], body=shown).max_shear()
        np.testing.assert_allclose(shear[inside], want, atol=frame["field"]["unit"])
        assert np.all(shear[~inside & (depth > 0.0)] == 0.0)
    rigid = lc.Contact(FLAT, BODY, materials=(lc.Material.rigid(), materials[1]))
    with pytest.raises(ValueError, match="the lower body is rigid"):
        lc.explore(rigid, 0.1, tmp_path / "page.html", body="lower")


def test_titles_and_names_are_words(tmp_path: Path) -> None:
    title = "</title></script><img src=x onerror=alert(1)> & {{data}} \\1"
    units = ("<b>", "</script>", "<!--")
    contact = lc.Contact(FLAT, lc.Curve((-1, 1), Hostile()), kappa=1.0)
    page = lc.explore(contact, 0.02, tmp_path / "page.html", title=title, units=units)
    plain = lc.explore(CONTACTS["hertz"][0], 0.02, tmp_path / "plain.html")
    found = []
    for one in (page, plain):
        tags = Tags()
        tags.feed(one.read_text(encoding="utf-8"))
        found.append([tag for tag, _ in tags.seen])
    assert found[0] == found[1]
    data = read(page)
    assert tuple(data["units"].values()) == units
    assert "</script>" in data["bodies"]["upper"] and len(data["bodies"]["upper"]) < 500
    assert "{{data}} \\1" in page.read_text(encoding="utf-8")


def test_bodies_are_named_without_addresses(tmp_path: Path) -> None:
    curve = lc.Curve((-1, 1), lambda k: (k, k * k / 2, np.ones_like(k), k))
    page = lc.explore(lc.Contact(FLAT, curve, kappa=1.0), 0.02, tmp_path / "page.html")
    assert " at 0x" in repr(curve) and " at 0x" not in read(page)["bodies"]["upper"]


def test_the_page_is_small(tmp_path: Path) -> None:
    contact = CONTACTS["hertz"][0]
    loads = np.linspace(0.001, 0.02, 6)
    one, six = (
        lc.explore(contact, of, tmp_path / "page.html").stat().st_size for of in (loads[:1], loads)
    )
    assert one + 39 * (six - one) / 5 < 1_000_000


def test_colours_darken_in_equal_steps() -> None:
    page = (Path(lc.__file__).parent / "explore.html").read_text(encoding="utf-8")
    listed = re.search(r"COLOURS = \[(.*?)\]", page)
    assert listed is not None
    colours = [[int(one[i : i + 2], 16) for i in (0, 2, 4)] for one in re.findall("#(.{6})", listed[1])]
    assert len(colours) == 11
    share = np.array(colours) / 255
    linear = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    # Lightness L* of CIELAB.
    lightness = 116 * np.cbrt(linear @ [0.2126, 0.7152, 0.0722]) - 16
    steps = -np.diff(lightness)
    np.testing.assert_allclose(steps, np.mean(steps), atol=0.5)
    assert lightness[0] > 95 and lightness[-1] < 20
