"""Bodies that no load presses together."""

import re
from collections.abc import Callable
from pathlib import Path

import linecontact as lc
import numpy as np
import pytest
from linecontact.command import main

STEEL = lc.Material(210e3, 0.3)
ROLLER = lc.Ellipse.circle(10.0, (-1.0, 1.0))
CONTACT = lc.Contact(lc.Flat(), ROLLER, materials=(STEEL, STEEL))
TO = lc.References(0.0, lc.Reference.depth(30.0), lc.Reference.disc(10.0))

SCENE = """
title = "A roller that lifts off"

[lower]
shape = "flat"

[upper]
shape = { ellipse = { along = 10.0, across = 10.0, angles = [-1.5, 1.5] } }

[stiffness]
contact_modulus = 115e3
"""


@pytest.mark.parametrize("solve", [CONTACT.solve, lambda **control: lc.Solver().solve(CONTACT, **control)])
def test_no_load_is_an_answer(solve: Callable[..., lc.Solution]) -> None:
    for control, separation in (({"load": 0.0}, 0.0), ({"approach": -0.25, "references": TO}, 0.25)):
        solution = solve(**control)
        assert solution.is_apart and solution.separation == separation and solution.is_checked
        assert solution.intervals == () and solution.contacts() == () and solution.attempts[-1][1] == "apart"
        assert (solution.load, solution.a, solution.b, solution.half_width) == (0.0, 0.0, 0.0, 0.0)
        assert solution.pressure([-0.5, 0.0]).tolist() == [0.0, 0.0] and solution.peak() == (0.0, 0.0, 0.0)
        assert solution.gap(0.5) == pytest.approx(separation + 10.0 - 99.75**0.5, abs=1e-15)
        assert solution.stiffness(TO) == 0.0 and solution.approach(TO).bodies == -separation
        assert solution.certify().is_proved
        assert f"apart by {separation:g}" in str(solution) and "apart by" in repr(solution)
        assert "svg" in solution._repr_svg_()
        with pytest.raises(lc.errors.InvalidLoadError):
            solution.centre_of_pressure
    # Nobody is infinitely far away.
    with pytest.raises(lc.errors.InvalidLoadError, match="the approach is -inf: it must be finite"):
        solve(approach=-np.inf, references=TO)
    assert solve(load=0.0, moment=0.0).is_apart
    with pytest.raises(lc.errors.InvalidLoadError, match="single_interval"):
        lc.solve(lc.Flat(), ROLLER, edges=(lc.Edge.fixed(-0.1), lc.Edge.fixed(0.1)), kappa=1.0, load=0.0)


def test_a_sweep_lifts_off() -> None:
    wanted = ["load", "separation", "peak_pressure", "stiffness", "centre_of_pressure", "contacts", "is_checked"]
    found = lc.sweep(CONTACT, quantities=wanted, approach=[0.01, 0.0, -0.3, -np.inf], references=TO)
    assert found["error"].tolist() == ["", "", "", "InvalidLoadError"]
    assert found["load"][0] > 0.0
    assert found["separation"][:3].tolist() == [0.0, 0.0, 0.3] and found["load"][1:3].tolist() == [0.0, 0.0]
    assert found["contacts"].tolist() == [1.0, 0.0, 0.0, 0.0] and np.isnan(found["centre_of_pressure"][1:]).all()


def test_a_picture_shows_the_bodies() -> None:
    pytest.importorskip("matplotlib")
    figure = CONTACT.solve(approach=-0.25, references=TO).plot(units=("mm", "MPa"))
    (axes,) = figure.axes
    assert axes.get_title().startswith("apart by 0.25") and axes.get_xlabel() == "x / mm"
    upper, lower = (line.get_ydata() for line in axes.lines)
    assert np.min(np.asarray(upper) - np.asarray(lower)) == pytest.approx(0.25, abs=1e-6)


def test_the_command_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE)
    csv, npz, vtk = (tmp_path / f"of.{ending}" for ending in ("csv", "npz", "vtk"))
    assert main(["solve", str(scene), "--load", "0", "--csv", str(csv), "--yield-stress", "500"]) == 0
    printed = capsys.readouterr().out
    assert re.search("^safety by Tresca +inf +against yield at 500", printed, re.MULTILINE)
    assert "apart by" in printed and "no load presses the bodies together" in printed
    head, row = csv.read_text().splitlines()
    assert row.split(",")[head.split(",").index("apart_by")] == "0.0"
    assert main(["solve", str(scene), "--load", "0", "--vtk", str(vtk)]) == 0
    assert "apart under load = 0" in capsys.readouterr().err and not vtk.exists()
    assert main(["solve", str(scene), "--load", "0:0:2", "--npz", str(npz)]) == 0
    alone = dict(np.load(npz))
    page = tmp_path / "of.html"
    files = ["--csv", str(csv), "--npz", str(npz), "--vtk", str(vtk), "--page", str(page)]
    assert main(["solve", str(scene), "--load", "0:400:3", *files]) == 0
    assert len(csv.read_text().splitlines()) == 4 and page.is_file()
    fields = dict(np.load(npz))
    assert np.isnan(fields["pressure"][0]).all() and np.isfinite(fields["pressure"][1:]).all()
    # The same fields if nothing is pressed at all.
    assert {name: of.shape[1:] for name, of in alone.items()} == {name: of.shape[1:] for name, of in fields.items()}
    assert np.isnan(alone["field_max_shear"]).all() and alone["max_shear"].tolist() == alone["load"].tolist() == [0.0, 0.0]
    # First touch is at zero to rounding, and written so.
    assert alone["left"].tolist() == alone["right"].tolist() == [0.0, 0.0]
    assert sorted(path.name for path in tmp_path.glob("*.vtk")) == ["of_0002.vtk", "of_0003.vtk"]
