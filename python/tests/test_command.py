"""The console command: its sheets, files and exit codes."""

from __future__ import annotations

import csv
import io
import math
import os
import re
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal
from unittest.mock import Mock

import numpy as np
import pytest
from scenes import Array

import linecontact as lc
from linecontact import command, sheet
from linecontact.below import Below
from linecontact.files import Scene

DOCS = Path(__file__).parents[2] / "docs" / "python.md"
UNITS = {"length": "mm", "pressure": "MPa", "load": "N/mm"}
STEEL = lc.Material(210e3, 0.3)
# A parabola follows Hertz to the last digit; the depths of largest stresses are from `HERTZ`.
ROLLER = lc.Parabola(10.0, (-1.0, 1.0))
TO = lc.References(0.0, lc.Reference.depth(30.0), lc.Reference.disc(10.0))
HERTZ = lc.solve(lc.Flat(), ROLLER, materials=(STEEL, STEEL), load=500.0)
LENGTH = math.sqrt(4 * 500.0 * 10.0 / (math.pi * lc.contact_modulus(STEEL, STEEL)))
PEAK = 2 * 500.0 / (math.pi * LENGTH)

Run = Callable[..., tuple[int, str, str]]


def roller(*controls: Any, lower: lc.Material | lc.Layer = STEEL, **settings: Any) -> Scene:
    given = {"materials": (lower, STEEL), **settings}
    return Scene(lc.Contact(lc.Flat(), ROLLER, **given), controls, UNITS, "roller")


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs the command on a scene: its exit code, and the text on both streams."""

    def of(scene: Scene | None, *arguments: object) -> tuple[int, str, str]:
        with monkeypatch.context() as patch:
            if scene is not None:
                patch.setattr(Scene, "from_file", classmethod(lambda *_: scene))
                arguments = ("scene.toml", *arguments)
            code: Any = None
            try:
                code = command.main(["solve", *map(str, arguments)])
            except SystemExit as ended:
                code = ended.code
        return code, *capsys.readouterr()

    return of


def numbers(text: str) -> dict[str, float]:
    """Returns the first number of each line of a sheet, by its label."""
    found = re.findall(r"^(\S.*?)  +(-?[\d.]+(?:e[-+]\d+)?)(?= |$)", text, re.MULTILINE)
    return {label: float(number) for label, number in found}


def on_the_axis(t: Array) -> tuple[Array, Array]:
    """Returns σ_x and σ_y below the middle of a Hertz contact, by depth/L and largest pressure.

    Johnson, Contact Mechanics, Eqs. (4.46a) and (4.46b).
    """
    root = np.sqrt(1.0 + t**2)
    return -((1.0 + 2.0 * t**2) / root - 2.0 * t), -1.0 / root


def test_the_sheet_is_that_of_hertz(run: Run) -> None:
    code, text, errors = run(roller({"load": 500.0}), "--yield-stress", 600)
    assert code == 0 and errors == ""
    found = numbers(text)
    t = np.linspace(0.0, 2.0, 2_000_001)
    x, y = on_the_axis(t)
    shear = 0.5 * np.abs(x - y)
    mises = np.sqrt(((0.5 - 0.3) * (x + y)) ** 2 + 3.0 * shear**2)
    want = {
        "load": 500.0,
        "contact from": -LENGTH,
        "contact to": LENGTH,
        "half-width": LENGTH,
        "centre of pressure": 0.0,
        "largest pressure": PEAK,
        "mean pressure": math.pi / 4 * PEAK,
        "largest shear in plane": PEAK * shear.max(),
        "largest von Mises stress": PEAK * mises.max(),
        "largest Tresca stress": 2 * PEAK * shear.max(),
    }
    for name, value in want.items():
        assert math.isclose(found[name], value, rel_tol=5e-6, abs_tol=1e-12), name
    assert math.isclose(found["safety by von Mises"], 600 / (PEAK * mises.max()), rel_tol=5e-3)
    assert math.isclose(found["safety by Tresca"], 600 / (2 * PEAK * shear.max()), rel_tol=5e-3)
    assert f"depth {t[shear.argmax()] * LENGTH:.4g}" in text and f"depth {t[mises.argmax()] * LENGTH:.4g}" in text
    assert len(re.findall(r"at x = 0 mm(?:,|$)", text, re.MULTILINE)) == 4
    assert "E = 210000 MPa, Poisson's ratio 0.3" in text and "against yield at 600 MPa" in text


def test_the_sheet_of_a_certified_contact_says_that_it_is_proved(run: Run) -> None:
    _, text, _ = run(roller({"load": 500.0}, certified=True))
    assert re.search(r"^checked +no tension in the contact, no overlap beside it: proved$", text, re.MULTILINE)


@pytest.mark.parametrize("ratio", [0.0, 0.1, 0.2, 0.24, 0.26, 0.3, 0.5])
def test_tresca_is_the_largest_difference_of_principal_stresses(ratio: float) -> None:
    found = sheet.largest_tresca(HERTZ, Below("", None, None, ratio))
    t = np.linspace(0.0, 2.0, 200_001)
    x, y = on_the_axis(t)
    spread = np.ptp([x, y, ratio * (x + y)], axis=0)
    assert math.isclose(found.value, PEAK * spread.max(), rel_tol=3e-11)
    assert math.isclose(found.depth, t[spread.argmax()] * LENGTH, abs_tol=1e-3 * LENGTH) and abs(found.x) < 1e-6
    # Below 1/4 twice the largest shear in the plane is too little.
    assert (found.value > 1.001 * 2 * HERTZ.max_shear().value) == (ratio < 0.245)


def test_tresca_is_looked_for_below_all_contacts() -> None:
    body = lc.Curve((-2.0, 2.0), lambda x: (x, x**4 - 2 * x**2 - 0.1 * x, 1.0, 4 * x**3 - 4 * x - 0.1))
    solution = lc.solve(lc.Flat(), body, kappa=1.0, load=1.0)
    mirrored = lc.solve(lc.Flat(), body.mirrored(), kappa=1.0, load=1.0)
    assert len(solution.intervals) == 2
    found, want = (sheet.largest_tresca(one, Below("", None, None, 0.0)) for one in (solution, mirrored))
    assert math.isclose(found.value, want.value, rel_tol=1e-9) and math.isclose(found.x, -want.x, abs_tol=1e-4)


def test_a_rigid_body_has_no_ratio(run: Run) -> None:
    solution = lc.solve(lc.Flat(), ROLLER, materials=(lc.Material.rigid(), STEEL), load=500.0)
    text = run(roller({"load": 500.0}, lower=lc.Material.rigid()))[1]
    assert re.search(r"^lower material +rigid$", text, re.MULTILINE)
    assert math.isclose(numbers(text)["largest von Mises stress"], solution.max_von_mises(0.3).value, rel_tol=1e-5)


def test_a_layer_and_what_is_not_known_of_it(run: Run) -> None:
    rubber = lc.Material(5.0, 0.48)
    bases: dict[Any, str] = {STEEL: "E = 210000 MPa, Poisson's ratio 0.3", "frictionless": "rigid, frictionless"}
    for base, said in bases.items():
        scene = roller({"load": 1.0}, lower=lc.Layer(rubber, 0.5, base))
        code, text, _ = run(scene)
        assert code == 0 and numbers(text)["half-width"] == float(f"{scene.contact.solve(load=1.0).half_width:.6g}")
        assert re.search(r"^lower layer +E = 5 MPa, Poisson's ratio 0.48, 0.5 mm thick$", text, re.MULTILINE)
        assert re.search(rf"^lower base +{said}$", text, re.MULTILINE)
        assert re.search("^not known of layers +the uncertainty$", text, re.MULTILINE)
        assert "without materials" not in text


HARD = lc.Layer(lc.Material(400e3, 0.2), 0.01, lc.Material(100e3, 0.35))


def test_largest_stresses_are_those_of_the_material_that_has_them(run: Run, tmp_path: Path) -> None:
    scene, file = roller({"load": 500.0}, lower=HARD), tmp_path / "out.csv"
    solution = scene.contact.solve(load=500.0)
    below = math.nextafter(0.01, 1.0), math.inf
    parts: dict[str, tuple[Literal["lower", "upper"], tuple[float, float], float]] = {
        "lower layer": ("lower", (0.0, 0.01), 0.2),
        "lower base": ("lower", below, 0.35),
        "upper body": ("upper", (0.0, math.inf), 0.3),
    }
    found = {}
    for words, (body, depths, ratio) in parts.items():
        shear = solution.max_shear(body=body, depths=depths)
        mises = solution.max_von_mises(ratio, body=body, depths=depths)
        found[words] = shear.value, mises.value
    code, text, _ = run(scene, "--csv", file, "--yield-stress", "600")
    assert code == 0
    with file.open(newline="") as of:
        [row] = csv.DictReader(of)
    # Each material has a line, and its safety.
    blocks = {lines[0][:26].strip(): lines for lines in (block.split("\n") for block in re.split(r"\n(?! )", text))}
    for words, values in found.items():
        for label, value in (
            ("largest shear in plane", values[0]),
            ("largest von Mises stress", values[1]),
            ("safety by von Mises", 600 / values[1]),
        ):
            [line] = [one for one in blocks[label] if one.endswith(f", {words}") or one.startswith(f"  in {words} ")]
            assert math.isclose(float(line[26:].split()[0]), value, rel_tol=5e-3 if "safety" in label else 1e-5)
        assert len(blocks["safety by Tresca"]) == len(found)
    for i, (name, label) in enumerate([("max_shear", "largest shear in plane"), ("von_mises", "largest von Mises stress")]):
        words = max(found, key=lambda words: found[words][i])
        assert row[f"{name}_in"] == words and math.isclose(float(row[f"{name} [MPa]"]), found[words][i], rel_tol=1e-14)
        assert re.search(rf"^{label} .*depth .* mm, {words}$", text, re.MULTILINE)
    # Twice the largest shear, or more.
    assert float(row["tresca [MPa]"]) >= 2 * found["lower layer"][0] and row["tresca_in"] == "lower layer"


def test_below_several_layers_no_stress_is_known(run: Run, tmp_path: Path) -> None:
    stack = lc.Layer(HARD.material, 0.2, lc.Layer(STEEL, 0.1, "bonded"))
    for lower, upper in ((stack, STEEL), (stack, stack)):
        scene = roller({"load": 1.0}, materials=(lower, upper))
        code, out, _ = run(scene, "--npz", tmp_path / "out.npz", "--vtk", tmp_path / "out.vtk", "--csv", tmp_path / "out.csv")
        assert code == 0 and "the stress below several layers" in out
        assert ("shear" in out) == (upper == STEEL) and out.count("lower layer") == 2
        with np.load(tmp_path / "out.npz") as arrays:
            assert ("upper_sigma_x" in arrays) == (upper == STEEL) and "lower_sigma_x" not in arrays


def test_fields_of_both_bodies(run: Run, tmp_path: Path) -> None:
    rubber = lc.Layer(lc.Material(5.0, 0.48), 0.2, "bonded")
    for lower, deepest in ((HARD, math.inf), (rubber, 0.2)):
        scene = roller({"load": 1.0}, {"load": 2.0}, lower=lower)
        assert run(scene, "--npz", tmp_path / "out.npz", "--vtk", tmp_path / "out.vtk")[0] == 0
        with np.load(tmp_path / "out.npz") as arrays:
            found = dict(arrays)
        solution = scene.contact.solve(load=2.0)
        sides: list[Literal["lower", "upper"]] = ["lower", "upper"]
        for body in sides:
            x, depth = found[f"{body}_field_x"][1], found[f"{body}_depth"][1][:, None]
            assert depth[-1] == min(2.001 * solution.half_width, deepest if body == "lower" else math.inf)
            stress = solution.stress(x, depth, body=body)
            np.testing.assert_allclose(found[f"{body}_sigma_x"][1], stress.sigma_x, rtol=1e-13)
            layer = lower if body == "lower" else lc.Layer(STEEL, 1.0, STEEL)
            base = 0.35 if body == "lower" else 0.3
            ratio = np.where(depth <= layer.thickness, layer.material.poisson_ratio, base)
            share = (0.5 - ratio) * (stress.sigma_x + stress.sigma_y)
            want = np.hypot(share, 3**0.5 * stress.max_shear())
            np.testing.assert_allclose(found[f"{body}_field_von_mises"][1], want, rtol=1e-12)
            points, fields = vtk(tmp_path / f"out_{body}_0002.vtk")
            np.testing.assert_allclose(-points[:, 0, 1], depth[:, 0], rtol=1e-15)
            np.testing.assert_allclose(-fields["tau_xy"], stress.tau_xy, rtol=1e-13)


def test_the_softer_ratio_and_the_plane_count(run: Run) -> None:
    iron = lc.Material(110e3, 0.1)
    solution = lc.solve(lc.Flat(), ROLLER, materials=(iron, STEEL), load=500.0)
    found = numbers(run(roller({"load": 500.0}, lower=iron))[1])
    assert math.isclose(found["largest von Mises stress"], solution.max_von_mises(0.1).value, rel_tol=1e-5)
    plane = roller({"load": 500.0}, plane="stress")
    found = numbers(run(plane)[1])
    solution = plane.contact.solve(load=500.0)
    assert math.isclose(found["largest von Mises stress"], solution.max_von_mises(0.0).value, rel_tol=1e-5)
    assert math.isclose(found["largest Tresca stress"], solution.peak().pressure, rel_tol=1e-5)


def test_approach_and_stiffness_need_references(run: Run) -> None:
    solution = HERTZ.contact.solve(approach=0.01, references=TO)
    text = run(roller({"approach": 0.01, "references": TO}))[1]
    found = numbers(text)
    assert not re.search(r"\d(mm|MPa|N/mm)", text + run(roller({"load": 1.2345678e-3}))[1])
    assert math.isclose(found["load"], solution.load, rel_tol=1e-5) and found["approach of the bodies"] == 0.01
    # The stiffness is the derivative of the load by the approach.
    loads = [HERTZ.contact.solve(approach=0.01 + off, references=TO).load for off in (-1e-6, 1e-6)]
    assert math.isclose(found["stiffness"], (loads[1] - loads[0]) / 2e-6, rel_tol=1e-5)
    assert not {"approach of the bodies", "stiffness"} & numbers(run(roller({"load": 1.0}))[1]).keys()
    again = numbers(run(replace(roller({"load": solution.load}), references=TO))[1])
    assert math.isclose(again["approach of the bodies"], 0.01, rel_tol=1e-5)
    assert again["stiffness"] == found["stiffness"]


def test_a_moment_tilts(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "out.csv"
    text = run(roller({"load": 100.0, "centre_of_pressure": 0.3}), "--csv", file)[1]
    tilt = numbers(text)["tilt of the upper body"]
    # The roller turned by the tilt presses there without a moment, to the square of the tilt.
    turned = lc.solve(lc.Flat(), ROLLER.rotated(tilt), materials=(STEEL, STEEL), load=100.0)
    assert math.isclose(turned.centre_of_pressure, 0.3, rel_tol=tilt**2)
    assert "prescribed                load = 100, centre_of_pressure = 0.3\n" in text
    assert "tilt [rad]" in file.read_text()
    assert "tilt" not in run(roller({"load": 100.0}))[1]


def line(x: Array, y: Array) -> lc.Curve:
    slope = (y[1] - y[0]) / (x[1] - x[0])
    return lc.Curve((x[0], x[1]), lambda k: (k, y[0] + slope * (k - x[0]), 1.0, slope))


def test_bodies_that_conform_are_told_of_beside_steep_ones(run: Run) -> None:
    hole, pin = (lc.Ellipse.circle(radius, (-1.5, 1.5)) for radius in (10.02, 10.0))
    contact = lc.Contact(hole, pin, contact_modulus=115e3)
    solution = contact.solve(load=240.0)
    found = solution.conformity
    assert found is not None and f"with {math.degrees(found.angle):.1f}° at the limits" in str(solution)
    # Persson's peak at the half-angle of 20.18 degrees that this load has, and Hertz's.
    exact, hertz = 44.07589, (240.0 * 115e3 * 0.02 / (math.pi * 10.0**2)) ** 0.5
    assert abs(found.too_low - (1.0 - solution.peak().pressure / exact)) < 1.2e-3
    assert abs(found.parabolas_too_low - (1.0 - hertz / exact)) < 1.6e-3
    text = run(Scene(contact, ({"load": 240.0},), UNITS, "pin"))[1]
    assert "bodies conform, 19.9 degrees" in text and "2.6 % too low, 4.8 % with parabolas" in text
    assert solution.is_steep and "too steep" in text and "..." not in text
    gentle = run(Scene(contact, ({"load": 10.0},), UNITS, "pin"))[1]
    assert contact.solve(load=10.0).conformity is None and "conform" not in gentle


def test_doubts_are_told(run: Run) -> None:
    edges = (lc.Edge.fixed(-1.0), lc.Edge.fixed(1.0))
    punch = Scene(lc.Contact(lc.Flat(), lc.Flat(), edges=edges, contact_modulus=1e5), ({"load": 100.0},), {}, "")
    code, text, _ = run(punch)
    assert code == 0 and re.search(r"largest pressure +inf +at x = 1$", text, re.MULTILINE)
    assert "without materials" in text and not text.startswith("\n")
    assert "nan" not in text and "numerical error" not in text and "held at x = -1, 1" in text
    heights = {-2.0: 0.0, -1.0: 0.0, -0.5: 5e8, 0.5: 5e8, 1.0: 0.0, 2.0: 0.0}
    x, y = np.array(list(heights)), np.array(list(heights.values()))
    land = lc.Piecewise([line(x[i : i + 2], y[i : i + 2]) for i in range(5)])
    text = run(Scene(lc.Contact(lc.Flat(), land, edges=(lc.Edge.fixed(-2.0), lc.Edge.fixed(2.0)), kappa=1.0), ({"load": 0.3},), {}, ""))[1]
    assert "held at x = -2, -1, 1, 2" in text
    bumps = lc.Curve((-2.0, 2.0), lambda k: (k, k**4 - 2 * k**2, 1.0, 4 * k**3 - 4 * k))
    text = run(Scene(lc.Contact(lc.Flat(), bumps), ({"load": 1.0},), {}, ""))[1]
    assert "2 contacts" in text and "kappa = 1" in text and "too steep" in text
    x = np.linspace(-1.0, 1.0, 401)
    points = np.column_stack([x, x**2 / 20 + 1e-6 * np.random.RandomState(1).normal(size=x.size)])
    measured = lc.Contact(lc.Flat(), lc.Spline(points, smooth=True), contact_modulus=115e3)
    text = run(Scene(measured, ({"load": 100.0},), UNITS, "measured"))[1]
    width = measured.solve(load=100.0).uncertainty().half_width
    assert f"half-width +- {width:.1g} mm" in text and "below 1e-12 of half-width" in text
    rough = measured.solve(load=100.0).contact.settings | {"tolerance": 1e-6}
    solution = lc.solve(measured.lower, measured.upper, load=100.0, **rough)
    told = re.findall("below (.*) of half-width", run(Scene(solution.contact, ({"load": 100.0},), UNITS))[1])
    assert solution.limits_error is not None and solution.limits_error < float(told[0]) < 1e-4
    long = lc.Piecewise([lc.Line(0.0, (i, i + 1.0)) for i in range(-9, 9)])
    assert "..." in run(Scene(lc.Contact(long, ROLLER, kappa=1e5), ({"load": 1.0},), {}, "long"))[1]


SWEEPS: list[tuple[list[str], list[dict[str, Any]]]] = [
    (["--load", "100:500:5"], []),
    (["--yield-stress", "900"], [{"load": 10.0}, {"half_width": 0.1}, {"peak_pressure": 700.0}]),
    (["--yield-stress", "9"], [{"approach": 0.01, "references": TO}, {"load": 1.0, "centre_of_pressure": 0.0}]),
    ([], [{"load": 1e-9}, {"load": 1e3}]),
]


@pytest.mark.parametrize(("arguments", "controls"), SWEEPS)
def test_tables_fit_a_terminal(run: Run, arguments: list[str], controls: list[dict[str, Any]]) -> None:
    code, text, errors = run(roller(*controls), *arguments)
    lines = text.splitlines()
    assert code == 0 and errors == "" and max(map(len, lines)) <= 100 and lines[0] == "roller"
    assert len(lines) == 4 + (len(controls) or 5) + 2 * ("--yield-stress" in arguments)
    # All columns end below their heads.
    ends = [match.end() for match in re.finditer(r"\S+(?: \S+)?", lines[2])]
    for line in lines[4 : 4 + (len(controls) or 5)]:
        assert [match.end() for match in re.finditer(r"\S+", line)][1 - len(ends) :] == ends[1:]


def test_small_numbers_of_a_table_keep_their_digits(run: Run) -> None:
    text = run(roller({"load": 1e-9}, {"load": 1e3}), "--yield-stress", "900")[1]
    small, large = (line.split() for line in text.splitlines()[4:6])
    peaks = [PEAK * math.sqrt(load / 500.0) for load in (1e-9, 1e3)]
    np.testing.assert_allclose([float(small[3]), float(large[3])], peaks, rtol=1e-3)
    # A safety below 1 is not rounded to 1.
    assert math.isclose(float(large[4]), 900 / HERTZ.contact.solve(load=1e3).max_von_mises(0.3).value, rel_tol=1e-3)


def test_numbers_of_other_units_are_apart(run: Run) -> None:
    roller_in_metres = lc.Parabola(10e-3, (-1e-3, 1e-3))
    steel = lc.Material(210e9, 0.3)
    units = {"length": "m", "pressure": "Pa", "load": "N/m"}
    contact = lc.Contact(lc.Flat(), roller_in_metres, materials=(steel, steel))
    text = run(Scene(contact, (), units, "metres"), "--load", "100e3:500e3:3")[1]
    for line, load in zip(text.splitlines()[4:7], (1e5, 3e5, 5e5), strict=True):
        scale = math.sqrt(load / 500e3)
        found = [float(word) for word in line.split()[:4]]
        want = [load, -LENGTH * 1e-3 * scale, LENGTH * 1e-3 * scale, PEAK * 1e6 * scale]
        np.testing.assert_allclose(found, want, rtol=1e-3)


def test_a_table_of_other_controls_has_the_loads(run: Run) -> None:
    text = run(roller({"half_width": 0.5 * LENGTH}, {"half_width": LENGTH}))[1]
    assert [line.split()[3] for line in text.splitlines()[4:6]] == ["125.00", "500.00"]


def test_a_table_has_the_numbers_of_hertz(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "out.csv"
    assert run(replace(roller(), units={"length": "µm"}), "--load", "1", "--csv", file)[0] == 0
    assert "half_width [µm]" in file.read_text(encoding="utf-8")
    code, text, _ = run(roller(), "--load", "100:500:5", "--yield-stress", "600", "--csv", file)
    assert code == 0
    rows = [[float(word) for word in line.split()] for line in text.splitlines()[4:9]]
    with file.open(newline="") as of:
        table = list(csv.DictReader(of))
    for row, kept, load in zip(rows, table, [100.0, 200.0, 300.0, 400.0, 500.0], strict=True):
        length = LENGTH * math.sqrt(load / 500.0)
        peak = PEAK * math.sqrt(load / 500.0)
        np.testing.assert_allclose(row[:4], [load, -length, length, peak], rtol=1e-3)
        assert kept["prescribed"] == f"load = {load:g}" and kept["error"] == ""
        np.testing.assert_allclose(float(kept["half_width [mm]"]), length, rtol=1e-13)
        np.testing.assert_allclose(float(kept["peak_pressure [MPa]"]), peak, rtol=1e-13)
        np.testing.assert_allclose(float(kept["safety_tresca"]), 600 / (2 * 0.300283 * peak), rtol=1e-5)
        assert kept["approach [mm]"] == "nan"


def test_npz(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "out.npz"
    assert run(roller({"load": 500.0}, {"load": -1.0}, {"half_width": LENGTH / 2}), "--npz", file)[0] == 2
    with np.load(file) as arrays:
        found = dict(arrays)
    np.testing.assert_allclose(found["load"], [500.0, math.nan, 125.0], rtol=1e-12)
    for row, scale in ((0, 1.0), (2, 0.5)):
        x, pressure = found["x"][row], found["pressure"][row]
        want = scale * PEAK * np.sqrt(1.0 - (x / (scale * LENGTH)) ** 2)
        np.testing.assert_allclose(pressure, want, rtol=1e-10)
        middle = found["field_x"][row].size // 2
        stress_x, stress_y = on_the_axis(found["depth"][row] / (scale * LENGTH))
        np.testing.assert_allclose(found["sigma_x"][row][:, middle], scale * PEAK * stress_x, rtol=1e-9)
        np.testing.assert_allclose(found["sigma_y"][row][:, middle], scale * PEAK * stress_y, rtol=1e-9)
    # A name has one meaning, that of the CSV: the largest stress is a number of each row.
    assert found["max_shear"].shape == found["von_mises"].shape == (3,)
    assert math.isclose(found["max_shear"][0], HERTZ.max_shear().value, rel_tol=1e-12)
    assert found["field_max_shear"].shape == found["sigma_x"].shape
    iron = lc.Material(110e3, 0.1)
    assert run(roller({"load": 500.0}, lower=iron), "--npz", file)[0] == 0
    with np.load(file) as arrays:
        mixed = dict(arrays)
    stress = lc.Stress(mixed["sigma_x"], mixed["sigma_y"], mixed["tau_xy"])
    want = np.maximum(stress.von_mises(0.1), stress.von_mises(0.3))  # the worse of both bodies
    np.testing.assert_allclose(mixed["field_von_mises"], want, rtol=1e-12)
    assert np.isnan(found["pressure"][1]).all() and np.isnan(found["tau_xy"][1]).all()
    assert math.isclose(np.max(found["field_von_mises"][0]), HERTZ.max_von_mises(0.3).value, rel_tol=1e-3)


def vtk(file: Path) -> tuple[Array, dict[str, Array]]:
    """Reads a legacy VTK file: points and fields, with the rows first."""
    lines = file.read_text(encoding="ascii").split("\n")
    assert lines[0] == "# vtk DataFile Version 3.0" and lines[2:4] == ["ASCII", "DATASET STRUCTURED_GRID"]
    columns, rows, layers = map(int, lines[4].removeprefix("DIMENSIONS ").split())
    count = columns * rows
    assert layers == 1 and lines[5] == f"POINTS {count} double" and lines[6 + count] == f"POINT_DATA {count}"
    points = np.array([line.split() for line in lines[6 : 6 + count]], dtype=np.float64)
    fields: dict[str, Array] = {}
    at = 7 + count
    while lines[at]:
        kind, name, *_ = lines[at].split()
        assert kind == "SCALARS" and lines[at + 1] == "LOOKUP_TABLE default"
        fields[name] = np.array(lines[at + 2 : at + 2 + count], dtype=np.float64).reshape(rows, columns)
        at += 2 + count
    return points.reshape(rows, columns, 3), fields


def test_vtk_is_in_equilibrium(run: Run, tmp_path: Path) -> None:
    """Compares derivatives over the grid: the divergence of the stress in the axes of the file is 0."""
    file = tmp_path / "out.vtk"
    assert run(roller({"load": 500.0}), "--vtk", file)[0] == 0
    points, fields = vtk(file)
    x, y = points[0, :, 0], points[:, 0, 1]
    assert np.all(points[..., 2] == 0.0) and np.all(np.diff(x) > 0.0) and np.all(np.diff(y) < 0.0) and y[0] < 0.0

    def along(name: str, axis: int) -> Array:
        return np.asarray(np.gradient(fields[name], x if axis else y, axis=axis, edge_order=2), dtype=np.float64)

    deep = (slice(30, -1), slice(1, -1))
    for one, other in (("sigma_x", "tau_xy"), ("tau_xy", "sigma_y")):
        parts = along(one, 1)[deep], along(other, 0)[deep]
        assert np.max(np.abs(parts[0] + parts[1])) < 0.02 * np.max(np.abs(parts[0]))
    shear = np.hypot(0.5 * (fields["sigma_x"] - fields["sigma_y"]), fields["tau_xy"])
    np.testing.assert_allclose(fields["max_shear"], shear, rtol=1e-12)
    assert math.isclose(np.max(fields["von_mises"]), HERTZ.max_von_mises(0.3).value, rel_tol=1e-3)


def test_vtk_by_meshio(run: Run, tmp_path: Path) -> None:
    meshio: Any = pytest.importorskip("meshio")
    assert run(roller({"load": 1.0}, {"load": -1.0}, {"load": 2.0}), "--vtk", tmp_path / "out.vtk")[0] == 2
    assert sorted(file.name for file in tmp_path.iterdir()) == ["out_0001.vtk", "out_0003.vtk"]
    points, fields = vtk(tmp_path / "out_0003.vtk")
    mesh = meshio.read(tmp_path / "out_0003.vtk")
    np.testing.assert_array_equal(mesh.points, points.reshape(-1, 3))
    for name, values in fields.items():
        np.testing.assert_array_equal(np.ravel(mesh.point_data[name]), values.ravel())


def test_a_page(run: Run, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    assert run(roller({"load": 100.0}, {"half_width": LENGTH}), "--page", page)[0] == 0
    text = page.read_text(encoding="utf-8")
    loads = [float(load) for load in re.findall(r'"load": ([\d.]+), "contacts"', text)]
    np.testing.assert_allclose(loads, [100.0, 500.0], rtol=1e-12)
    assert "<title>roller" in text and '"N/mm"' in text


def test_exit_codes(run: Run, tmp_path: Path) -> None:
    scene = roller({"load": 500.0})
    code, text, errors = run(scene, "--load", "1e9")
    assert (code, text) == (1, "") and re.fullmatch(
        r"linecontact: scene.toml: load = 1e\+09: the contact would leave the bodies.* or give free_until = -?\S+ in edges if .*\n", errors
    )
    code, text, errors = run(scene, "--load", "100:1e9:2", "--csv", tmp_path / "out.csv")
    assert code == 1 and "DomainTooShortError" in text and errors.count("\n") == 1
    assert "DomainTooShortError" in (tmp_path / "out.csv").read_text()
    assert run(scene, "--load", "1e9", "--page", tmp_path / "page.html")[0] == 1
    assert not (tmp_path / "page.html").exists()
    code, _, errors = run(scene, "--load", "-1")
    assert code == 2 and "load = -1: the load is -1" in errors
    negative = lc.Contact(lc.Flat(), ROLLER, contact_modulus=1.0, edges=(lc.Edge.adhesive(-1.0),) * 2)
    assert run(Scene(negative, ({"load": 1.0},)))[0] == 3
    code, text, errors = run(None, tmp_path / "none.toml")
    assert code == 3 and errors == f"linecontact: {tmp_path / 'none.toml'}: No such file or directory\n"
    bad = tmp_path / "bad.toml"
    bad.write_text("title = 'bad'\n\nkappa = = 3\n")
    code, text, errors = run(None, bad)
    assert code == 3 and re.fullmatch(rf"linecontact: {bad}:3: .+\n", errors)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Scene, "from_file", Mock(side_effect=lc.errors.BothRigidError("both are rigid")))
        code, text, errors = run(None, bad)
    assert code == 3 and errors == f"linecontact: {bad}: both are rigid\n"
    for name in ("csv", "npz", "vtk", "page"):
        code, text, errors = run(scene, f"--{name}", tmp_path / "nowhere" / "out")
        assert code == 4 and "half-width" in text
        missing = rf"linecontact: cannot write {tmp_path / 'nowhere' / 'out'}: (No such|no folder).*\n"
        assert re.fullmatch(missing, errors)


def test_no_noise_is_told_where_the_pressure_is_infinite(run: Run) -> None:
    fixed = (lc.Edge.fixed(-0.1), lc.Edge.fixed(0.1))
    assert "noise" not in run(roller({"load": 500.0}, edges=fixed))[1]


def test_a_field_that_is_not_known_is_told(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise lc.errors.SingularError("the pressure is\ninfinite")

    monkeypatch.setattr(command, "write_npz", fails)
    code, _, errors = run(roller({"load": 500.0}), "--npz", "out.npz")
    assert code == 1 and errors == "linecontact: cannot write out.npz: the pressure is infinite\n"


def test_the_number_of_contacts_is_told(run: Run, tmp_path: Path) -> None:
    grooved = lc.Curve((-2.0, 2.0), lambda x: (x, x**4 - 2 * x**2, 1.0, 4 * x**3 - 4 * x))
    scene, file = Scene(lc.Contact(lc.Flat(), grooved, contact_modulus=1.0), (), UNITS, ""), tmp_path / "out.csv"
    loads = [1.0, 4.0, 7.0]
    counts = [len(scene.contact.solve(load=load).intervals) for load in loads]
    assert counts == [2, 1, 1]
    code, text, _ = run(scene, "--load", "1:7:3", "--csv", file)
    head, _, *rows = (re.split("  +", line.strip()) for line in text.splitlines()[:5])
    assert code == 0 and [row[head.index("contacts")] for row in rows] == ["2", "1", "1"]
    with file.open(newline="") as of:
        assert [row["contacts"] for row in csv.DictReader(of)] == ["2", "1", "1"]
    # One contact under each load needs no column.
    assert "contacts" not in run(roller(), "--load", "100:500:5")[1]


def test_units_in_doubt_are_told_below_a_table_and_in_the_csv(run: Run, tmp_path: Path) -> None:
    """Moduli in GPa by mistake."""
    soft, file = lc.Material(210.0, 0.3), tmp_path / "out.csv"
    bodies = lc.Flat(), lc.Ellipse.circle(10.0, (-1.5, 1.5))
    scene = Scene(lc.Contact(*bodies, materials=(soft, soft)), (), UNITS, "roller")
    code, text, _ = run(scene, "--load", "1:300:4", "--csv", file)
    steep = [scene.contact.solve(load=load).is_steep for load in np.linspace(1.0, 300.0, 4)]
    assert code == 0 and 0 < sum(steep) < 4
    assert text.splitlines()[-2:] == ["", f"note: slopes exceed 0.3 in {sum(steep)} of 4, too steep for half-planes: check the units"]
    with file.open(newline="") as of:
        assert [row["is_steep"] for row in csv.DictReader(of)] == [str(one) for one in steep]
    assert "note" not in run(roller(), "--load", "1:300:4")[1]
    bare = Scene(lc.Contact(*bodies), (), UNITS, "")
    assert "no modulus is given" in run(bare, "--load", "1e-3:2e-3:2")[1]


@pytest.mark.skipif(sys.platform == "win32", reason="pipes end otherwise")
def test_files_are_written_though_nobody_reads(tmp_path: Path) -> None:
    """As with `linecontact solve ... | head -1`: the reader has gone before anything is printed."""
    scene = tmp_path / "scene.toml"
    scene.write_text(re.findall(r"```toml\n(.*?)```", DOCS.read_text(), re.DOTALL)[0])
    code = "import sys; from linecontact.command import main; sys.exit(main())"
    files = [f"--{kind}={tmp_path / 'out'}.{kind}" for kind in ("csv", "npz", "vtk", "page")]
    for load, names in (("500", 4), ("100:500:3", 6)):
        for file in tmp_path.glob("out*"):
            file.unlink()
        read, write = os.pipe()
        os.close(read)
        arguments = [sys.executable, "-c", code, "solve", str(scene), "--load", load, *files]
        done = subprocess.run(arguments, stdout=write, stderr=subprocess.PIPE, text=True, check=False)
        os.close(write)
        assert (done.returncode, done.stderr) == (0, "")
        assert len(list(tmp_path.glob("out*"))) == names


USAGE: list[tuple[list[str], list[dict[str, Any]], str]] = [
    (["--load", "many"], [], "'many': give a load, as 500, or first:last:count"),
    (["--load", "1:2"], [], "give a load"),
    (["--load", "1:2:0"], [], "give a load"),
    (["--load", "1:2:1"], [], "give a load"),
    (["--load", "1", "--csv", "out", "--npz", "out"], [], "two of the files are the same one"),
    (["--load", "1", "--csv", "scene.toml"], [], "two of the files are the same one"),
    (["--load", "1:2:2.5"], [], "give a load"),
    (["--load", "nan"], [], "give a load"),
    (["--load", "1:2:100001"], [], "'1:2:100001' are 100001 loads, and at most 100000 are solved in one run"),
    (["--load", "1:2:1e300"], [], "and at most 100000"),
    (["--load", "1:inf:3"], [], "give a load"),
    (["--load", "1", "--yield-stress", "0"], [], "'0' is no positive number"),
    (["--load", "1", "--yield-stress", "much"], [], "'much' is no positive number"),
    ([], [], "scene.toml has no controls: give --load"),
    (["--page", "p.html"], [{"load": 1.0, "moment": 0.0}], "does not show moments"),
    (["--colour"], [{"load": 1.0}], "unrecognized arguments"),
]


@pytest.mark.parametrize(("arguments", "controls", "words"), USAGE)
def test_usage(run: Run, arguments: list[str], controls: list[dict[str, Any]], words: str) -> None:
    code, text, errors = run(roller(*controls), *arguments)
    assert code == 2 and text == "" and words in errors


def test_progress_is_for_terminals(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(command, "_PROGRESS", 0.0)
    monkeypatch.setattr(Scene, "from_file", classmethod(lambda *_: roller()))
    assert run(roller(), "--load", "1:3:3")[2] == ""
    # A log gets whole lines, if it is asked for.
    assert run(roller(), "--load", "1:3:3", "--progress")[2] == "1 of 3 solved\n2 of 3 solved\n3 of 3 solved\n"

    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    told = Terminal()
    monkeypatch.setattr(sys, "stderr", told)
    assert command.main(["solve", "scene.toml", "--load", "1:3:3"]) == 0
    assert re.findall(r"(\d) of 3 solved", told.getvalue()) == ["1", "2", "3"]
    assert told.getvalue().endswith(f"\r{40 * ' '}\r")
    monkeypatch.setattr(command, "_PROGRESS", 1e9)
    told.truncate(0)
    assert command.main(["solve", "scene.toml", "--load", "1:3:3"]) == 0 and "solved" not in told.getvalue()


def test_a_scene_file_with_all_kinds_of_fields(run: Run) -> None:
    """The file of the tests of the library: a spline, joined pieces, a corner, and four controls."""
    file = DOCS.parents[1] / "tests" / "data" / "scene.toml"
    code, text, errors = run(None, file, "--yield-stress", 500)
    scene = Scene.from_file(file)
    assert code == 0 and errors == "" and max(map(len, text.splitlines())) <= 100
    peaks = [scene.contact.solve(**control).peak().pressure for control in scene.controls]
    rows = [re.split(r"  +", line.strip()) for line in text.splitlines()[4:8]]
    np.testing.assert_allclose([float(row[4]) for row in rows], peaks, rtol=1e-3)


def test_streams(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    scene = tmp_path / "scene.toml"
    text = re.findall(r"```toml\n(.*?)```", DOCS.read_text(), re.DOTALL)[0].replace("roller in", "µ-roller in")
    scene.write_text(text, encoding="utf-8")
    code = "import sys; from linecontact.command import main; sys.exit(main())"
    arguments = [sys.executable, "-c", code, "solve", str(scene)]
    ascii_only = {**os.environ, "PYTHONIOENCODING": "ascii"}
    done = subprocess.run(arguments, capture_output=True, text=True, check=True, env=ascii_only)
    assert done.stdout.startswith("?-roller in a groove\n") and done.stderr == ""
    if Path("/dev/full").exists():
        with open("/dev/full", "w") as full:
            done = subprocess.run(arguments, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        assert done.returncode == 4
        assert done.stderr == "linecontact: cannot write the results: No space left on device\n"

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(command, "solved", interrupted)
    assert run(roller(), "--load", "1")[0] == 130


def test_the_command_is_installed() -> None:
    done = subprocess.run([Path(sys.executable).parent / "linecontact", "--version"], capture_output=True, check=True)
    assert re.fullmatch(rb"\d+\.\d+\.\d+\S*\s*", done.stdout)


def test_the_sheets_in_the_docs_are_as_printed(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = DOCS.read_text()
    Path("roller.toml").write_text(re.findall(r"```toml\n(.*?)```", text, re.DOTALL)[0])
    samples = re.findall(r"```sh\nlinecontact solve (.*?)\n```\n```text\n(.*?)```", text, re.DOTALL)
    assert len(samples) == 2
    for arguments, want in samples:
        code, found, _ = run(None, *arguments.split())
        assert code == 0 and found == want
