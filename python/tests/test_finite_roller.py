"""Rollers of finite length, compared with their plane contact and with formulas of standards."""

from __future__ import annotations

import math
import pickle
from typing import Any

import numpy as np
import pytest

import linecontact as lc

STEEL = lc.Material(206e3, 0.3)
LENGTH, DIAMETER = 10.0, 10.0
RELIEF = lc.Crowning(0.00035 * DIAMETER, LENGTH / 2, (-LENGTH / 2, LENGTH / 2))
TO = lc.References(0.0, lc.Reference.length(LENGTH), lc.Reference.disc(DIAMETER / 2))
CONTACT = lc.Contact(lc.Flat(), lc.Ellipse.circle(DIAMETER / 2, (-1.0, 1.0)), materials=(STEEL, STEEL))
TABLE = lc.SpringTable(CONTACT, TO, (0.01, 2000.0), 1e-8)
CYLINDER = lc.FiniteRoller(TABLE, LENGTH)
CROWNED = lc.FiniteRoller(TABLE, LENGTH, 41, RELIEF)


def test_a_cylinder_is_its_plane_contact() -> None:
    plane = CONTACT.solve(load=500.0)
    state = CYLINDER.under_load(5000.0)
    assert state.approach == pytest.approx(plane.approach(TO).bodies, rel=1e-7)
    assert state.stiffness[0, 0] == pytest.approx(LENGTH * plane.stiffness(TO), rel=1e-6)
    assert state.largest_pressure == pytest.approx(plane.peak().pressure, rel=1e-7)
    assert state.half_contacts == pytest.approx(np.full(41, plane.half_width), rel=1e-7)
    assert state.loads == pytest.approx(np.full(41, 500.0), rel=1e-13)


def test_the_law_of_iso_16281() -> None:
    for load in (500.0, 2000.0, 10000.0):
        approach = CYLINDER.under_load(load).approach
        by_standard = 35948 * (2 * approach) ** (10 / 9) * LENGTH ** (8 / 9)
        assert by_standard == pytest.approx(load, rel=0.02)


def test_load_and_moment_are_the_sums_of_the_slices() -> None:
    state = CROWNED.at(0.012, 1.5e-3)
    width = LENGTH / 41
    assert state.load == pytest.approx(width * state.loads.sum(), rel=1e-13)
    assert state.moment == pytest.approx(width * (state.loads * state.z).sum(), rel=1e-12)
    relief = -0.0035 * np.log(1 - (2 * state.z / LENGTH) ** 2)
    assert state.approaches == pytest.approx(0.012 + 1.5e-3 * state.z - relief, abs=1e-15)
    touching = state.approaches > 0
    assert np.all((state.loads > 0) == touching) and not touching[0]
    back = CROWNED.under_moment(state.load, state.moment)
    assert back.approach == pytest.approx(0.012, rel=1e-12)
    assert back.misalignment == pytest.approx(1.5e-3, rel=1e-12)
    mirrored = CROWNED.at(0.012, -1.5e-3)
    assert mirrored.moment == pytest.approx(-state.moment, rel=1e-12)
    assert mirrored.loads == pytest.approx(state.loads[::-1], abs=1e-10)


def test_reliefs_of_any_kind() -> None:
    z = np.linspace(-6.0, 6.0, 121)
    crown = lc.Parabola(1000.0, (-6.0, 6.0))
    same: list[lc.Body] = [
        lc.Spline(np.column_stack([z, z**2 / 2000.0])),
        lc.Curve((-6.0, 6.0), lambda z: (z, z**2 / 2000.0, 1.0, z / 1000.0)),
    ]
    exact = lc.FiniteRoller(TABLE, LENGTH, 41, crown).under_load(3000.0, 1e-3)
    for relief in same:
        state = lc.FiniteRoller(TABLE, LENGTH, 41, relief).under_load(3000.0, 1e-3)
        assert state.moment == pytest.approx(exact.moment, rel=1e-9)


def test_a_roller_is_pickled_and_shown() -> None:
    again = pickle.loads(pickle.dumps(CROWNED))
    assert again.under_load(3000.0, 1e-3).moment == CROWNED.under_load(3000.0, 1e-3).moment
    state = CROWNED.under_load(3000.0)
    assert pickle.loads(pickle.dumps(state)).load == state.load
    assert "41 slices" in repr(CROWNED)
    shown = repr(CYLINDER.under_load(1000.0))
    assert shown.startswith("<RollerState load=1000, moment=0, ") and shown.endswith(", 41 slices>")


def test_pictures() -> None:
    pytest.importorskip("matplotlib")
    figure = CROWNED.under_load(5000.0, 1e-3).plot(units=("mm", "MPa", "N/mm"))
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert labels == ["load per unit length / N/mm", "largest pressure / MPa"]
    assert figure.axes[0].get_title() == "load 5000 N, misalignment 0.001 rad"
    assert figure.axes[1].get_xlabel() == "z / mm"
    punch = lc.Contact(
        lc.Flat(),
        lc.Flat(),
        materials=(STEEL, STEEL),
        edges=(lc.Edge.fixed(-1.0), lc.Edge.fixed(1.0)),
    )
    corners = lc.FiniteRoller(lc.SpringTable(punch, TO, (1.0, 100.0)), LENGTH).under_load(500.0)
    assert corners.largest_pressure == math.inf
    assert len(corners.plot().axes) == 2
    wrong: list[Any] = ["mm", ("mm", "MPa")]
    for units in wrong:
        with pytest.raises(TypeError, match="give names of the units"):
            corners.plot(units=units)


def test_apart() -> None:
    state = CYLINDER.at(-0.001)
    assert state.load == 0.0 and state.moment == 0.0 and not np.any(state.loads) and not np.any(state.pressures)
    assert CYLINDER.under_load(0.0).approach == 0.0
    assert len(state.plot().axes) == 2
    spring = TABLE.at([-1.0, 0.0])
    assert not np.any(spring.load) and not np.any(spring.stiffness) and 0.0 < TABLE.touch_error < 0.1


# Made without types: a type checker would find these.
ANY: Any = lc


def test_mistakes() -> None:
    with pytest.raises(TypeError, match="is no SpringTable"):
        ANY.FiniteRoller(CONTACT, LENGTH)
    with pytest.raises(TypeError, match="give a body"):
        ANY.FiniteRoller(TABLE, LENGTH, 41, [0.0, 0.1])
    for slices in (2.5, "41", None):
        with pytest.raises(TypeError, match="give a whole number"):
            ANY.FiniteRoller(TABLE, LENGTH, slices)
    with pytest.raises(TypeError, match="length is '10'"):
        ANY.FiniteRoller(TABLE, "10")
    with pytest.raises(TypeError, match=r"load is \[1.0\]"):
        ANY.FiniteRoller(TABLE, LENGTH).under_load([1.0])
    for slices in (0, -1, 10**30):
        with pytest.raises(lc.errors.InvalidRollerError):
            lc.FiniteRoller(TABLE, LENGTH, slices)
    for length in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(lc.errors.InvalidRollerError):
            lc.FiniteRoller(TABLE, length)
    assert CYLINDER.under_moment(0.0, 0.0).load == 0.0
    for load in (-1.0, math.nan, math.inf):
        with pytest.raises(lc.errors.InvalidLoadError):
            CYLINDER.under_load(load)
    with pytest.raises(lc.errors.InvalidMomentError):
        CYLINDER.under_load(1000.0, math.nan)
    with pytest.raises(lc.errors.SliceOutsideTableError, match="pressed most"):
        CYLINDER.under_load(1000.0, 1.0)
    with pytest.raises(lc.errors.ReliefError, match="the z of a slice is -9.7561: it must be where the relief is known"):
        lc.FiniteRoller(TABLE, 20.0, 41, RELIEF)
    with pytest.raises(ZeroDivisionError):
        lc.FiniteRoller(TABLE, LENGTH, 41, lc.Curve((-5.0, 5.0), lambda z: (z, 1 / 0, 1.0, z)))
