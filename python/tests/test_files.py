"""Scenes in files: as the Rust library writes them, and through Python unchanged."""

from __future__ import annotations

import inspect
import json
import math
import re
from pathlib import Path
from typing import Any

import hypothesis
import hypothesis.strategies as st
import jsonschema
import numpy as np
import pytest

import linecontact as lc
from linecontact import errors
from linecontact.bodies import _Shape
from linecontact.reading import _METRES

ROOT = Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "docs/scene.schema.json").read_text(encoding="utf-8"))
RUST = [ROOT / "tests/data" / name for name in ("scene.toml", "layers.toml")]
ODD = 0.1 + 0.2  # a number whose last digit matters

FINITE = st.floats(-1e9, 1e9)
POSITIVE = st.floats(1e-6, 1e6)


@pytest.mark.parametrize("rust", RUST, ids=lambda rust: str(rust.stem))
def test_a_file_of_rust_goes_through_python_bit_for_bit(rust: Path, tmp_path: Path) -> None:
    scene = lc.Scene.from_file(rust)
    for name in ("scene.json", "scene.toml"):
        scene.to_file(tmp_path / name)
        assert lc.Scene.from_file(tmp_path / name) == scene
    assert (tmp_path / "scene.toml").read_bytes() == rust.read_bytes()
    jsonschema.validate(json.loads((tmp_path / "scene.json").read_text(encoding="utf-8")), SCHEMA)


def bodies() -> list[lc.Body]:
    x = np.linspace(-1.0, 1.0, 21)
    points = np.column_stack([x, x**2 / 3])
    flank = lc.Line(-0.1, (-0.7, 0.0))
    return [
        lc.Flat(),
        lc.Line(ODD, (-1 / 3, 0.7)),
        lc.Parabola(ODD, (-1.0, 2 / 3)),
        lc.Ellipse(3.0, -0.7, (-1.1, 1.2)),
        lc.Involute(50.0, 0.4, (0.1, 0.7)),
        lc.Crowning(1e-300, 5.0, (-4.8, 4.9)),
        lc.Wedge((-0.1, 0.3), 0.7),
        lc.RoundedPunch(0.3, 0.7, 1.1),
        lc.Spline(points),
        lc.Spline(points, period=2.1),
        lc.Spline(points + np.column_stack([0 * x, 1e-6 * np.sin(99 * x)]), smooth=True, outliers=None),
        lc.Piecewise([flank, lc.Line(0.1, (0.0, 1.0)).scaled(0.7)], 1e-9),
        lc.Piecewise([flank, lc.Line(0.1, (0.0, 1.0))]),
    ]


@pytest.mark.parametrize("form", ["toml", "json"])
@pytest.mark.parametrize("body", bodies(), ids=lambda body: str(type(body).__name__))
def test_every_body_is_kept(body: lc.Body, form: str, tmp_path: Path) -> None:
    """Through a file that the schema allows, with its numbers by the names of the constructor."""
    placed = body.shifted(0.1, 1e-7).mirrored().flipped().scaled(-1.7).rotated(1e-3)
    for made in (body, placed):
        contact = lc.Contact(lc.Flat().shifted(0.0, -9.0), made)
        contact.to_file(tmp_path / f"scene.{form}")
        read = lc.Contact.from_file(tmp_path / f"scene.{form}")
        assert read == contact and repr(read) == repr(contact)
        first, last = made.domain
        k = np.linspace(first, last, 20)
        assert all(map(np.array_equal, read.upper.at(k), made.at(k)))
        if form == "json":
            jsonschema.validate(json.loads((tmp_path / "scene.json").read_text(encoding="utf-8")), SCHEMA)


def test_these_are_all_bodies(tmp_path: Path) -> None:
    assert {type(body).__name__ for body in bodies()} == set(lc.bodies.__all__) - {"Body", "Curve", "Placed"}
    (tmp_path / "bad.toml").write_text(GOOD.replace("flat", "flet"))
    with pytest.raises(errors.SceneFileError) as caught:
        lc.Scene.from_file(tmp_path / "bad.toml")
    known = set(re.findall("`(.*?)`", caught.value.reason)) - {"flet"}
    assert known == {*_Shape.KINDS, "spline", "piecewise"}


def test_the_numbers_of_a_shape_have_the_names_of_its_arguments() -> None:
    for shape in [body for body in bodies() if isinstance(body, _Shape)]:
        numbers = lc.parameters(lc.Contact(lc.Flat().shifted(0.0, -9.0), shape)).items()
        expected: dict[str, float] = {}
        for name, value in zip(inspect.signature(type(shape)).parameters, shape._arguments(), strict=True):
            pair = {f"upper.{name}.{i}": one for i, one in enumerate(value)} if isinstance(value, tuple) else {}
            expected |= pair or {f"upper.{name}": value}
        assert {name: value for name, value in numbers if name.startswith("upper")} == expected


def test_the_lists_of_shapes_have_every_shape() -> None:
    modules, readme = (ROOT / name for name in ("src/profile.rs", "python/README.md"))
    for name, shape in _Shape.KINDS.items():
        text = modules.read_text(encoding="utf-8")
        assert f"[`{shape.__name__}`]" in text or f"[`{name}`]" in text, name
        assert f"`{shape.__name__}`" in readme.read_text(encoding="utf-8"), name


TO = lc.References(0.1, lc.Reference.depth(ODD), lc.Reference.disc(10.0))
SOFT = lc.Material(ODD, 0.5)


@pytest.mark.parametrize(
    "control",
    [
        {"load": ODD},
        {"half_width": ODD},
        {"peak_pressure": ODD},
        {"approach": ODD, "references": TO},
        {"load": 1.0, "moment": -ODD, "about": 0.3},
        {"load": 1.0, "centre_of_pressure": -ODD},
    ],
    ids=lambda control: "-".join(control),
)
@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"kappa": ODD},
        {"contact_modulus": 115e3, "edges": (lc.Edge.free(), lc.Edge.free_until(ODD)), "resolution": 1e-3},
        {"kappa": 2.0, "period": 2.5},
        {"materials": (lc.Material.rigid(), lc.Material(210e3, 0.3)), "plane": "stress", "certified": True},
        {"materials": (lc.Layer(SOFT, ODD, "frictionless"), lc.Layer(SOFT, 1e-3, "bonded"))},
        {"materials": (lc.Layer(SOFT, ODD, lc.Layer(SOFT, 1e-3, "bonded")), lc.Layer(SOFT, 0.1, lc.Layer(SOFT, 0.2, SOFT)))},
        {"materials": (lc.Layer(lc.Material.rigid(), ODD, SOFT), lc.Layer(SOFT, 1, lc.Material.rigid()))},
        {"kappa": 1.0, "edges": (lc.Edge.fixed(-1.0), lc.Edge.adhesive(ODD))},
    ],
    ids=lambda settings: "-".join(settings),
)
def test_settings_and_controls_are_kept(settings: Any, control: Any, tmp_path: Path) -> None:
    contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-2.0, 2.0)), **settings)
    scene = lc.Scene(contact, (control,), {"length": "mm"}, 'a "title"\nin two lines', TO)
    for form in ("toml", "json"):
        scene.to_file(tmp_path / f"scene.{form}")
        assert lc.Scene.from_file(tmp_path / f"scene.{form}") == scene
    jsonschema.validate(json.loads((tmp_path / "scene.json").read_text(encoding="utf-8")), SCHEMA)


def test_a_moment_is_about_the_origin_by_default(tmp_path: Path) -> None:
    contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-2.0, 2.0)))
    lc.Scene(contact, ({"load": 1.0, "moment": 0.1},)).to_file(tmp_path / "scene.json")
    assert lc.Scene.from_file(tmp_path / "scene.json").controls[0]["about"] == 0.0


@hypothesis.given(radius=POSITIVE, along=FINITE, angle=st.floats(-0.1, 0.1), load=POSITIVE)
@hypothesis.settings(deadline=None, max_examples=50)
def test_numbers_keep_their_bits(
    radius: float, along: float, angle: float, load: float, tmp_path_factory: pytest.TempPathFactory
) -> None:
    path = tmp_path_factory.getbasetemp() / "scene.toml"
    upper = lc.Parabola(radius, (-radius, radius)).rotated(angle).shifted(along)
    scene = lc.Scene(lc.Contact(lc.Flat(), upper, kappa=load), ({"load": load},))
    scene.to_file(path)
    assert lc.Scene.from_file(path) == scene


GOOD = """\
stiffness = { contact_modulus = 115e3 }
[lower]
shape = "flat"
[upper]
shape = { parabola = { radius = 1.0, domain = [-1.0, 1.0] } }
"""


@pytest.mark.parametrize(
    ("old", "new", "line", "field", "reason"),
    [
        ("radius = 1.0", "radius = 0.0", 5, "upper.shape.parabola", "the radius is 0"),
        ("radius = 1.0", 'radius = "1"', 5, "upper.shape.parabola.radius", "string"),
        ("flat", "flet", 3, "lower.shape", "unknown name `flet`"),
        ("contact_modulus", "modulus", 1, "stiffness", "unknown name `modulus`"),
        ('"flat"', '"flat', 3, "", "string"),
        ("stiffness", "stiffness = 1\nstiffness", 2, "", "duplicate key"),
        (
            "contact_modulus = 115e3",
            'materials = { lower = "rigid", upper = { layer = { material = "rigid", depth = 1 } } }',
            1,
            "stiffness.materials.upper.layer.depth",
            "unknown field `depth`",
        ),
    ],
)
def test_a_bad_file_says_line_and_field(
    old: str, new: str, line: int, field: str, reason: str, tmp_path: Path
) -> None:
    path = tmp_path / "bad.toml"
    path.write_text(GOOD.replace(old, new, 1))
    with pytest.raises(errors.SceneFileError) as caught:
        lc.Scene.from_file(path)
    error = caught.value
    assert (error.line, error.field) == (line, field) and reason in error.reason
    assert str(error).startswith(f"{path}:{line}: ")


def test_what_is_no_text_is_refused(tmp_path: Path) -> None:
    for name, text, said in [
        ("a.toml", b"a = 1\n\xff", "UTF-8"),
        ("a.json", b"", "EOF"),
        ("a.yaml", b"", "must end in"),
        ("a.json", b"[" * 100_000, "sequence"),
        ("a.toml", b"a = " + b"[" * 100_000, "recursion"),
        ("a.toml", f"controls = [\n{{ load = nan }}]\n{GOOD}".encode(), "a.toml:2: load: the number is not finite"),
        ("a.toml", f"controls = [{{ approach = 0.1 }}]\n{GOOD}".encode(), r"a.toml:1: .*, or { approach = .*references = {"),
        ("a.json", GOOD.encode(), "a.json:1"),
        ("a.toml", GOOD.replace("115e3", "nan").encode(), "a.toml:1: stiffness: E. = NaN: .* must be positive"),
    ]:
        (tmp_path / name).write_bytes(text)
        with pytest.raises(errors.SceneFileError, match=said):
            lc.Scene.from_file(tmp_path / name)
    with pytest.raises(FileNotFoundError):
        lc.Scene.from_file(tmp_path / "none.toml")


def circle(k: Any) -> tuple[Any, Any, Any, Any]:
    return np.sin(k), 1 - np.cos(k), np.cos(k), np.sin(k)


def test_what_a_file_cannot_hold_is_refused(tmp_path: Path) -> None:
    flat, body = lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0))
    curve = lc.Curve((-1.0, 1.0), circle)
    joined = lc.Piecewise([curve, lc.Line(math.tan(1.0), (0.0, 1.0)).shifted(math.sin(1.0), 1 - math.cos(1.0))], 1e-6)
    for contact, field in [
        (lc.Contact(flat, curve), "upper"),
        (lc.Contact(curve.flipped(), body), "lower"),
        (lc.Contact(flat, joined), "upper.parts[0]"),
        (lc.Contact(flat, body, limit_search="brent"), "limit_search"),
        (lc.Contact(flat, body, tolerance=1e-6), "quadrature"),
        (lc.Contact(flat, body, start=(-0.1, 0.1)), "start"),
        (lc.Contact(flat, body, single_interval=True), "single_interval"),
    ]:
        with pytest.raises(errors.SceneFileError) as caught:
            contact.to_file(tmp_path / "scene.toml")
        assert caught.value.field == field
    for scene in [
        lc.Scene(lc.Contact(flat, body), ({"load": math.nan},)),
        lc.Scene(lc.Contact(flat, body), references=lc.References(math.inf, TO.lower, TO.upper)),
    ]:
        with pytest.raises(errors.SceneFileError):
            scene.to_file(tmp_path / "scene.toml")
    assert not (tmp_path / "scene.toml").exists()


def test_a_scene_that_cannot_be_solved_is_refused() -> None:
    contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)))
    given: list[dict[str, Any]] = [
        {"contact": "x"},
        {"controls": [{"lode": 1.0}]},
        {"controls": [{"load": object()}]},
        {"units": {"width": "mm"}},
        {"title": Path("x")},
    ]
    for wrong in given:
        with pytest.raises(TypeError):
            lc.Scene(**{"contact": contact, **wrong})
    assert lc.Scene(contact, [{"load": 1.0}]) == lc.Scene(contact, ({"load": 1.0},))


def test_units_that_do_not_go_together_are_refused(tmp_path: Path) -> None:
    contact, file = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), contact_modulus=115.0), tmp_path / "scene.toml"
    units = {"length": "mm", "pressure": "MPa", "load": "N/mm"}
    lc.Scene(contact, (), units).to_file(file)
    file.write_text(file.read_text().replace("MPa", "GPa"))
    says = "GPa times mm is no load per length in N/mm: give pressures in MPa"
    with pytest.raises(errors.SceneFileError, match=says) as raised:
        lc.Scene.from_file(file)
    assert raised.value.field == "units" and raised.value.line is not None
    with pytest.raises(errors.SceneFileError, match=says):
        lc.Scene(contact, (), units | {"pressure": "GPa"}).to_file(file)
    for quantity, unit in (("load", "kN"), ("load", "kg/mm"), ("pressure", "bar"), ("length", "furlong")):
        with pytest.raises(errors.SceneFileError, match=f"{unit} .*is no "):
            lc.Scene(contact, (), units | {quantity: unit}).to_file(file)
    for unit in (*_METRES, "µm"):  # Those of measured profiles.
        lc.Scene(contact, (), {"length": unit}).to_file(file)


def layered(**wrong: Any) -> dict[str, Any]:
    """Returns the stiffness of a layer, with wrong fields; None leaves one out."""
    layer = {"material": "rigid", "thickness": 1.0, "base": "bonded"} | wrong
    fields = {name: value for name, value in layer.items() if value is not None}
    return {"materials": {"lower": "rigid", "upper": {"layer": fields}}}


def test_the_schema_refuses_what_the_library_refuses(tmp_path: Path) -> None:
    contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), contact_modulus=1.0)
    lc.Scene(contact, ({"load": 1.0},)).to_file(tmp_path / "scene.json")
    good = json.loads((tmp_path / "scene.json").read_text())
    for path, value in [
        (("lower",), None),
        (("lower", "shape"), "flet"),
        (("lower", "steps"), ["turned"]),
        (("upper", "shape", "parabola", "radius"), "1"),
        (("upper", "shape", "parabola", "domain"), [1.0]),
        (("stiffness",), {"kappa": 1.0, "contact_modulus": 1.0}),
        (("stiffness",), layered(thickness=None)),
        (("stiffness",), layered(base="glued")),
        (("stiffness",), layered(base={"half_plane": "soft"})),
        (("stiffness",), layered(depth=1.0)),
        (("controls",), [{"lode": 1.0}]),
        (("units",), {"width": "mm"}),
        (("edges",), {"left": "free"}),
        (("more",), 1),
    ]:
        bad = json.loads(json.dumps(good))
        place = bad
        for name in path[:-1]:
            place = place[name]
        place[path[-1]] = value
        (tmp_path / "bad.json").write_text(json.dumps(bad))
        with pytest.raises(errors.SceneFileError):
            lc.Scene.from_file(tmp_path / "bad.json")
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(bad, SCHEMA)


def test_the_controls_of_a_scene_are_a_list() -> None:
    contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0)
    with pytest.raises(TypeError, match="give a list of dicts"):
        lc.Scene(contact, {"load": 5.0})  # type: ignore[arg-type]
