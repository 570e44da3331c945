"""Derivatives by the numbers of a scene, against closed forms, differences and scaling laws."""

from __future__ import annotations

import functools
import inspect
import math
import re
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, reject, settings
from hypothesis import strategies as st

import linecontact as lc

Array = npt.NDArray[np.float64]

STEEL, ALUMINIUM = lc.Material(210e3, 0.3), lc.Material(70e3, 0.33)
BETWEEN = lc.References(0.1, lc.Reference.depth(30.0), lc.Reference.disc(10.0))


def close(found: Any, exact: Any, within: float) -> None:
    """Compares rows; the tolerance is a share of the largest number of a row."""
    found, exact = np.atleast_1d(found), np.atleast_1d(exact)
    off = np.abs(found - exact) / np.max(np.abs(exact))
    assert np.all(off <= within), (found, exact, off)


# Closed forms.


def test_a_roller_on_a_flat() -> None:
    radius, modulus, load = 10.0, 115e3, 500.0
    contact = lc.Contact(lc.Flat(), lc.Parabola(radius, (-1.0, 1.0)), contact_modulus=modulus)
    by = ["upper.radius", "contact_modulus", "load"]
    of = ["a", "b", "peak_pressure", "max_shear"]
    values, derivatives = lc.gradient(contact, of, by, load=load)
    a = math.sqrt(4 * load * radius / (math.pi * modulus))
    peak = math.sqrt(load * modulus / (math.pi * radius))
    close(values[:3], [a, a, peak], 1e-14)
    powers = [[0.5, -0.5, 0.5], [0.5, -0.5, 0.5], [-0.5, 0.5, 0.5], [-0.5, 0.5, 0.5]]
    close(derivatives * [radius, modulus, load] / values[:, None], powers, 1e-13)


def test_materials_and_the_elastic_constants_of_each() -> None:
    contact = lc.Contact(lc.Flat(), lc.Parabola(10.0, (-1.0, 1.0)), materials=(STEEL, ALUMINIUM))
    by = [f"materials.{i}.{name}" for i in (0, 1) for name in lc.Material._fields]
    value, derivatives = lc.gradient(contact, "half_width", by, load=500.0)
    # The square of a is proportional to the sum of (1 - ν²)/E.
    compliances = [(1 - nu**2) / modulus for modulus, nu in (STEEL, ALUMINIUM)]
    rates = [(-(1 - nu**2) / modulus**2, -2 * nu / modulus) for modulus, nu in (STEEL, ALUMINIUM)]
    exact = [value / 2 * rate / sum(compliances) for pair in rates for rate in pair]
    assert all(abs(found / wanted - 1) < 1e-12 for found, wanted in zip(derivatives, exact, strict=True))


@pytest.mark.parametrize("base", [STEEL, "bonded", "frictionless", lc.Layer(ALUMINIUM, 3.0, STEEL)])
def test_a_layer_by_all_its_numbers(base: Any) -> None:
    """All lengths, or all pressures, are in any unit: Euler's theorem ties the derivatives."""
    cover = lc.Layer(lc.Material(5.0, 0.48), 10.0, base)
    contact = lc.Contact(lc.Flat(), lc.Parabola(100.0, (-50.0, 50.0)), materials=(ALUMINIUM, cover))
    numbers = lc.parameters(contact, load=20.0)
    assert numbers["materials.1.thickness"] == 10.0 and numbers["materials.1.material.youngs_modulus"] == 5.0
    assert ("materials.1.base.youngs_modulus" in numbers) == (base == STEEL)
    lengths = {name: value for name, value in numbers.items() if re.search("radius|domain|thickness|load", name)}
    pressures = {name: value for name, value in numbers.items() if re.search("youngs_modulus|load", name)}
    (a, peak), found = lc.gradient(contact, ["half_width", "peak_pressure"], [lengths, pressures], load=20.0)
    close(found / [[a], [peak]], [[1.0, 0.0], [0.0, 1.0]], 1e-11)
    by = [f"materials.1.{name}" for name in ("thickness", "material.poisson_ratio")]
    _, (thicker, stiffer) = lc.gradient(contact, "a", by, load=20.0)
    assert thicker > 0.0 > stiffer


def test_the_load_that_a_crowned_roller_takes_on_a_given_width() -> None:
    c, l, width, kappa = 0.02, 5.0, 3.0, 1.7
    contact = lc.Contact(lc.Flat(), lc.Crowning(c, l, (-4.9, 4.9)), kappa=kappa)
    by = ["upper.depth", "upper.half_length", "half_width", "kappa"]
    (load, peak), (by_load, by_peak) = lc.gradient(contact, ["load", "peak_pressure"], by, half_width=width)
    s = math.sqrt(l**2 - width**2)
    close(load, 2 * kappa * c * (l / s - 1), 1e-13)
    exact = [2 * kappa * (l / s - 1), -2 * kappa * c * width**2 / s**3]
    exact += [2 * kappa * c * l * width / s**3, 2 * c * (l / s - 1)]
    close(by_load, exact, 1e-12)
    # P(0) = 2 κ C L/(π S l).
    close(peak, 2 * kappa * c * width / (math.pi * s * l), 1e-13)
    exact = [1 / c, -l / s**2 - 1 / l, 1 / width + width / s**2, 1 / kappa]
    close(by_peak / peak, exact, 1e-12)


def test_a_wedge_by_its_slopes() -> None:
    m, load, kappa = 0.1, 0.02, 1.3
    contact = lc.Contact(lc.Flat(), lc.Wedge((-m, m), 1.0), kappa=kappa)
    steeper = {"upper.slopes.0": -1.0, "upper.slopes.1": 1.0}
    width, by_slope = lc.gradient(contact, "half_width", steeper, load=load)
    close([width, by_slope], [math.pi * load / (2 * kappa * m), -math.pi * load / (2 * kappa * m**2)], 1e-13)


def test_a_circle_by_its_radius() -> None:
    """Changes both semi-axes: near the pole the circle is a parabola."""
    contact = lc.Contact(lc.Flat(), lc.Ellipse.circle(10.0, (-1.0, 1.0)), kappa=1.0)
    by_both = {"upper.along": 1.0, "upper.across": 1.0}
    value, derivative = lc.gradient(contact, "half_width", by_both, load=1e-9)
    close(derivative, value / (2 * 10.0), 1e-8)
    _, apart = lc.gradient(contact, "half_width", ["upper.along", "upper.across"], load=1e-9)
    close(apart.sum(), derivative, 1e-14)
    twice = lc.gradient(contact, "half_width", [{"load": 2.0}, "load"], load=1e-9)[1]
    close(twice[0], 2 * twice[1], 1e-14)


def test_an_eccentric_load_turns_a_parabola() -> None:
    radius, load, moment = 10.0, 500.0, 5.0
    contact = lc.Contact(lc.Flat(), lc.Parabola(radius, (-1.0, 1.0)), contact_modulus=115e3)
    by = ["upper.radius", "load", "moment"]
    values, found = lc.gradient(contact, ["centre", "tilt"], by, load=load, moment=moment)
    close(values, [moment / load, -moment / load / radius], 1e-12)
    close(found[0], [0.0, -moment / load**2, 1 / load], 1e-12)
    close(found[1], [moment / load / radius**2, moment / load**2 / radius, -1 / load / radius], 1e-12)
    # Derivative by the place of the load.
    value, by_place = lc.gradient(contact, "tilt", "centre_of_pressure", load=load, centre_of_pressure=moment / load)
    close([value, by_place], [values[1], -1 / radius], 1e-12)


def test_a_body_of_parts_moves_as_one_shape_of_the_same_form() -> None:
    flat, radius, reach = 1.0, 0.5, 3.0
    edge = reach - flat
    left = lc.Parabola(radius, (-edge, 0.0)).shifted(-flat)
    right = lc.Parabola(radius, (0.0, edge)).shifted(flat)
    parts = lc.Piecewise([left, lc.Line(0.0, (-flat, flat)), right])
    wider = {
        "upper.parts.0.shifted.along": -1.0,
        "upper.parts.1.domain.0": -1.0,
        "upper.parts.1.domain.1": 1.0,
        "upper.parts.2.shifted.along": 1.0,
    }
    rounder = {"upper.parts.0.radius": 1.0, "upper.parts.2.radius": 1.0}
    of = ["half_width", "mean_pressure", "peak_pressure"]
    joined = lc.gradient(lc.Contact(lc.Flat(), parts), of, [wider, rounder], load=0.3)
    whole = lc.Contact(lc.Flat(), lc.RoundedPunch(flat, radius, reach))
    shape = lc.gradient(whole, of, ["upper.flat", "upper.radius"], load=0.3)
    close(joined[0], shape[0], 1e-13)
    for found, exact in zip(joined[1], shape[1], strict=True):
        close(found, exact, 1e-12)


def test_load_and_half_width_are_inverse_to_each_other() -> None:
    contact = lc.Contact(lc.Flat(), lc.Ellipse(3.0, 2.0, (-1.2, 1.4)).rotated(0.2), kappa=1.0)
    width, by_load = lc.gradient(contact, "half_width", "load", load=0.3)
    load, by_width = lc.gradient(contact, "load", "half_width", half_width=width)
    close([load, by_width * by_load], [0.3, 1.0], 1e-12)
    pressure, rate = lc.gradient(contact, "peak_pressure", "load", load=0.3)
    again = lc.gradient(contact, "load", "peak_pressure", peak_pressure=pressure)
    close([again[0], again[1] * rate], [0.3, 1.0], 1e-9)


def test_the_rate_of_the_approach_is_the_compliance() -> None:
    contact = lc.Contact(lc.Flat(), lc.Parabola(10.0, (-1.0, 1.0)), materials=(STEEL, STEEL))
    (approach, stiffness), (rate, _) = lc.gradient(
        contact, ["approach", "stiffness"], ["load"], load=500.0, references=BETWEEN
    )
    close(rate * stiffness, 1.0, 1e-12)
    load, by_approach = lc.gradient(contact, "load", "approach", approach=float(approach), references=BETWEEN)
    close([load, by_approach], [500.0, stiffness], 1e-9)


# Every number of every shape.


class Scene(NamedTuple):
    """A contact as a function of its numbers."""

    make: Callable[..., lc.Contact]
    numbers: dict[str, float]
    moves: dict[str, dict[str, float]] = {}
    prescribed: dict[str, Any] = {"load": 0.3}
    of: tuple[str, ...] = ("load", "a", "b", "centre", "mean_pressure", "peak_pressure", "moment")


def above(body: Callable[..., lc.Body], **settings: Any) -> Callable[..., lc.Contact]:
    return lambda *numbers: lc.Contact(lc.Flat(), body(*numbers), **{"kappa": 1.3, **settings})


def measured(smooth: bool) -> lc.Body:
    x = np.linspace(-2.0, 2.0, 41)
    noise = 1e-3 * np.random.RandomState(1).normal(size=x.size) if smooth else 0.0
    return lc.Spline(np.column_stack([x, np.cosh(x) + 0.1 * x + noise]), smooth=smooth)


def fixed(x: float) -> lc.Contact:
    edges = (lc.Edge.free(), lc.Edge.fixed(x))
    return lc.Contact(lc.Flat(), lc.Parabola(1.0, (-2.0, 0.5)), kappa=1.3, edges=edges)


def cut_off(x: float) -> lc.Contact:
    edges = (lc.Edge.free(), lc.Edge.free_until(x))
    return lc.Contact(lc.Flat(), lc.Parabola(1.0, (-2.0, x)), kappa=1.3, edges=edges)


def sticky(left: float, right: float) -> lc.Contact:
    edges = (lc.Edge.adhesive(left), lc.Edge.adhesive(right))
    return lc.Contact(lc.Flat(), lc.Parabola(1.0, (-2.0, 2.0)), kappa=1.3, edges=edges)


def held(at_a: float, at_b: float, distance_a: float, distance_b: float) -> lc.Contact:
    edges = lc.EdgePressure(at_a, at_b, distance_a, distance_b, 1e-14, 1e-14)
    return lc.Contact(lc.Flat(), lc.Parabola(1.0, (-2.0, 2.0)), kappa=1.3, edge_pressure=edges)


SCENES: dict[str, Scene] = {
    "parabola": Scene(
        above(lambda r, left, right: lc.Parabola(r, (left, right))),
        {"upper.radius": 0.7, "upper.domain.0": -1.3, "upper.domain.1": 1.5},
    ),
    "ellipse": Scene(
        above(lambda a, b, left, right: lc.Ellipse(a, b, (left, right)).rotated(0.1)),
        {"upper.along": 2.0, "upper.across": 1.5, "upper.angles.0": -1.2, "upper.angles.1": 1.3},
    ),
    "involute": Scene(
        above(lambda r, t, first, last: lc.Involute(r, t, (first, last))),
        {"upper.base_radius": 2.0, "upper.origin": 0.6, "upper.angles.0": 0.01, "upper.angles.1": 1.5},
        prescribed={"load": 0.05},
    ),
    "crowning": Scene(
        above(lambda c, l, left, right: lc.Crowning(c, l, (left, right)).shifted(0.1)),
        {"upper.depth": 0.2, "upper.half_length": 2.0, "upper.domain.0": -1.9, "upper.domain.1": 1.8},
    ),
    "wedge": Scene(
        above(lambda left, right, reach: lc.Wedge((left, right), reach)),
        {"upper.slopes.0": -0.3, "upper.slopes.1": 0.5, "upper.reach": 3.0},
        # The pressure is infinite at the tip.
        of=("a", "b", "centre", "mean_pressure", "moment"),
    ),
    "rounded punch": Scene(
        above(lambda flat, radius, reach: lc.RoundedPunch(flat, radius, reach).shifted(0.2)),
        {"upper.flat": 1.0, "upper.radius": 0.4, "upper.reach": 3.0},
    ),
    "lines": Scene(
        above(lambda m, n: lc.Piecewise([lc.Line(m, (-3.0, 0.0)), lc.Line(n, (0.0, 2.0))])),
        {"upper.parts.0.slope": -0.3, "upper.parts.1.slope": 0.5},
        of=("a", "b", "centre", "mean_pressure", "moment"),
    ),
    "placed": Scene(
        above(
            lambda angle, along, across, factor, again: lc.Parabola(0.7, (-1.3, 1.5))
            .rotated(angle)
            .mirrored()
            .shifted(along, across)
            .scaled(factor)
            .rotated(again)
        ),
        {
            "upper.rotated.0.angle": 0.1,
            "upper.shifted.along": 0.2,
            "upper.shifted.across": 0.3,
            "upper.scaled.factor": 1.2,
            "upper.rotated.1.angle": -0.2,
        },
    ),
    "both bodies": Scene(
        lambda r, a, b: lc.Contact(
            lc.Parabola(r, (-1.0, 1.0)).flipped(), lc.Ellipse(a, b, (-1.0, 1.0)).shifted(0.1), kappa=1.3
        ),
        {"lower.radius": 0.7, "upper.along": 2.0, "upper.across": 1.5},
    ),
    "spline": Scene(
        above(lambda angle, factor: measured(False).rotated(angle).scaled(factor)),
        {"upper.rotated.angle": -0.1, "upper.scaled.factor": 1.2},
    ),
    "smoothed spline": Scene(
        above(lambda along, factor: measured(True).rotated(0.1).shifted(along).scaled(factor)),
        {"upper.shifted.along": -0.1, "upper.scaled.factor": 1.2},
    ),
    "fixed edge": Scene(fixed, {"edges.1.value": 0.3}, of=("a", "b", "mean_pressure", "moment")),
    "body with a corner": Scene(
        cut_off,
        {"x": 0.3},
        {"x": {"upper.domain.1": 1.0, "edges.1.value": 1.0}},
        of=("a", "b", "mean_pressure", "moment"),
    ),
    "adhesive edges": Scene(
        sticky,
        {"edges.0.value": 0.02, "edges.1.value": 0.03},
        of=("a", "b", "mean_pressure", "moment"),
    ),
    "given pressures": Scene(
        held,
        {
            "edge_pressure.at_a": 0.02,
            "edge_pressure.at_b": 0.01,
            "edge_pressure.distance_a": 0.01,
            "edge_pressure.distance_b": 0.02,
        },
    ),
    # Two rollers side by side, which meet in the middle.
    "two contacts": Scene(
        above(
            lambda r, d: lc.Piecewise(
                [
                    lc.Parabola(r, (-1.0, d)).shifted(-d),
                    lc.Parabola(0.6, (-0.6, 1.0)).shifted(0.6, d * d / 2 / r - 0.3),
                ]
            )
        ),
        {
            "first": 0.7,
            "apart": 0.5,
        },
        {
            "first": {
                "upper.parts.0.radius": 1.0,
                "upper.parts.1.shifted.across": -0.25 / 2 / 0.49,
            },
            "apart": {
                "upper.parts.0.domain.1": 1.0,
                "upper.parts.0.shifted.along": -1.0,
                "upper.parts.1.shifted.across": 0.5 / 0.7,
            },
        },
        of=("a", "b", "mean_pressure", "peak_pressure", "moment"),
    ),
}


def differences(of: Callable[[float], Array], at: float) -> Array:
    """Returns central differences of fourth order, from two steps."""
    step = 2e-3 * abs(at)
    wide, narrow = ((of(at + h) - of(at - h)) / (2 * h) for h in (step, step / 2))
    return (4 * narrow - wide) / 3


@pytest.mark.parametrize("name", SCENES)
def test_every_number_against_differences(name: str) -> None:
    make, numbers, moves, prescribed, of = SCENES[name]
    values = list(numbers.values())
    by = [moves.get(name, name) for name in numbers]

    def solved(numbers: list[float]) -> Array:
        solution = make(*numbers).solve(**prescribed)
        return np.array([number(solution, quantity) for quantity in of])

    def moved(i: int, x: float) -> Array:
        return solved([*values[:i], x, *values[i + 1 :]])

    value, derivatives = lc.gradient(make(*values), of, by, **prescribed)
    close(value, solved(values), 1e-13)
    for i, at in enumerate(values):
        exact = differences(functools.partial(moved, i), at)
        size = np.abs(exact) + np.abs(value / at)
        off = np.abs(derivatives[:, i] - exact) / np.where(size > 1e-9, size, 1.0)
        assert np.all(off < 5e-10), (list(numbers)[i], derivatives[:, i], exact, off)


def test_two_contacts_are_two() -> None:
    make, numbers, _, prescribed, _ = SCENES["two contacts"]
    assert len(make(*numbers.values()).solve(**prescribed).intervals) == 2


def number(solution: lc.Solution, quantity: str) -> float:
    if quantity == "peak_pressure":
        return solution.peak().pressure
    found = getattr(solution, quantity)
    return float(found() if callable(found) else found)


# Degrees of homogeneity: with all lengths doubled the load doubles, and pressures are unchanged.
DEGREES = dict.fromkeys(["angle", "angles", "factor", "kappa", "origin", "slope", "slopes"], 0)
OF_LENGTHS = {"load": 1, "a": 1, "b": 1, "centre": 1, "moment": 2}
# With κ doubled the load doubles, and the limits are unchanged.
OF_STIFFNESS = {"load": 1, "mean_pressure": 1, "peak_pressure": 1, "moment": 1}
SIMILAR = [name for name in SCENES if "spline" not in name and name != "given pressures"]


@pytest.mark.parametrize("name", SIMILAR)
def test_scaled_scenes_have_scaled_solutions(name: str) -> None:
    """Tests Euler's theorem: the sum of numbers times derivatives is the degree times the value."""
    make, numbers, _, prescribed, of = SCENES[name]
    contact = make(*numbers.values())
    known = lc.parameters(contact, **prescribed)
    values, derivatives = lc.gradient(contact, of, list(known), **prescribed)
    degrees = [degree(name) for name in known]
    # A work of adhesion is a pressure times a length.
    stiff = [name in ("kappa", "load") or (make is sticky and "edges" in name) for name in known]
    of_lengths, of_stiffness = (
        (derivatives * list(known.values())) @ np.array(weights, dtype=float) for weights in (degrees, stiff)
    )
    # Sizes of values that are zero except for rounding: the half-width for lengths, load times
    # half-width for a moment.
    size = np.abs(values)
    width = (values[of.index("a")] + values[of.index("b")]) / 2
    for quantity, least in (("centre", width), ("moment", width * prescribed["load"])):
        if quantity in of:
            size[of.index(quantity)] += least
    assert np.all(np.abs(of_lengths - values * [OF_LENGTHS.get(one, 0) for one in of]) <= 1e-12 * size)
    assert np.all(np.abs(of_stiffness - values * [OF_STIFFNESS.get(one, 0) for one in of]) <= 1e-12 * size)


def shapes() -> st.SearchStrategy[lc.Body]:
    size = st.floats(-1.0, 1.0).map(lambda power: 10.0**power)
    ellipses = st.builds(lambda a, b: lc.Ellipse(a, b, (-1.2, 1.3)), size, size)
    parabolas = st.builds(lambda r: lc.Parabola(r, (-2 * r, 3 * r)), size)
    crownings = st.builds(lambda c, l: lc.Crowning(c * l, l, (-0.9 * l, 0.95 * l)), size, size)
    punches = st.builds(lambda flat, r: lc.RoundedPunch(flat, r, flat + 3 * r), size, size)
    return st.one_of(ellipses, parabolas, crownings, punches)


def carried(contact: lc.Contact) -> float:
    """Returns the load under which the contact reaches the ends of the bodies."""
    try:
        return contact.solve(load=1e9).load
    except lc.errors.DomainTooShortError as short:
        return short.carried


# Scenes are not upright: of two equal maxima each parameter may take a different one.
@settings(deadline=None, derandomize=True)
@given(shapes(), shapes(), st.floats(0.001, 0.05), st.floats(-0.01, 0.01), st.floats(0.01, 0.5))
def test_scaled_random_scenes_have_scaled_solutions(
    lower: lc.Body, upper: lc.Body, angle: float, along: float, share: float
) -> None:
    try:
        contact = lc.Contact(lower.flipped(), upper.rotated(angle).shifted(along), kappa=1.0)
        load = share * carried(contact)
        contact.solve(load=load)
    except lc.LineContactError:
        reject()
    by = lc.parameters(contact, load=load)
    of = ["a", "b", "mean_pressure", "peak_pressure"]
    values, derivatives = lc.gradient(contact, of, list(by), load=load)
    found = derivatives @ [degree(name) * value for name, value in by.items()]
    width = (values[0] + values[1]) / 2
    size = np.max(np.abs(derivatives * list(by.values())), axis=1) + [width, width, *values[2:]]
    # The place of a peak next to a breakpoint is not found to all digits.
    within = np.array([1e-11, 1e-11, 1e-11, 1e-7])
    assert np.all(np.abs(found - values * [1, 1, 0, 0]) <= within * size), (found, values)


CONTROLS: list[dict[str, Any]] = [
    {"load": 50.0},
    {"half_width": 0.2},
    {"peak_pressure": 300.0},
    {"approach": 0.001, "references": BETWEEN},
    {"load": 50.0, "moment": 1.0, "about": 0.05},
    {"load": 50.0, "centre_of_pressure": 0.1},
]


@pytest.mark.parametrize("prescribed", CONTROLS, ids=lambda prescribed: ", ".join(prescribed))
def test_whatever_is_prescribed_scales(prescribed: dict[str, Any]) -> None:
    lower = lc.Crowning(-1.0, 5.0, (-4.0, 4.0)).rotated(0.01)
    contact = lc.Contact(lower, lc.Ellipse(7.0, 9.0, (-1.0, 1.1)), materials=(STEEL, ALUMINIUM))
    of = ["load", "half_width", "tilt", "peak_pressure", "moment", "approach", "stiffness"]
    asked = {"references": BETWEEN, **prescribed}
    known = lc.parameters(contact, **asked)
    values, derivatives = lc.gradient(contact, of, list(known), **asked)
    by_length = {"youngs_modulus": 0, "poisson_ratio": 0, "peak_pressure": 0, "moment": 2}
    by_pressure = {"load": 1, "moment": 1, "youngs_modulus": 1, "peak_pressure": 1}
    names = [name.split(".")[-1] for name in known]
    lengths = [by_length.get(last, degree(name)) for name, last in zip(known, names, strict=True)]
    pressures = [by_pressure.get(last, 0) for last in names]
    size = np.abs(values) + [0, 0, 1e-3, 0, values[0] * values[1], 0, 0]
    share = np.sum(derivatives * list(known.values()) * lengths, axis=1) - values * [1, 1, 0, 0, 2, 1, 0]
    assert np.all(np.abs(share) <= 1e-11 * size), share / size
    share = np.sum(derivatives * list(known.values()) * pressures, axis=1) - values * [1, 0, 0, 1, 1, 0, 1]
    assert np.all(np.abs(share) <= 1e-11 * size), share / size


def degree(name: str) -> int:
    return next((DEGREES[part] for part in reversed(name.split(".")) if part in DEGREES), 1)


def test_a_spline_is_scaled_by_its_factor() -> None:
    body = measured(True).scaled(1.5)
    contact = lc.Contact(lc.Flat(), body, kappa=1.3)
    by = {"upper.scaled.factor": 1.5, "load": 0.3}
    of = ["a", "b", "mean_pressure", "peak_pressure"]
    (a, b, mean, peak), found = lc.gradient(contact, of, by, load=0.3)
    assert np.all(np.abs(found - [a, b, 0.0, 0.0]) <= 1e-11 * np.array([a, b, mean, peak]))


def test_a_derivative_is_for_the_same_smoothing() -> None:
    def contact(angle: float) -> lc.Contact:
        return lc.Contact(lc.Flat(), measured(True).rotated(angle), kappa=1.3)

    def limits(angle: float) -> Array:
        solution = contact(angle).solve(load=0.3)
        return np.array([solution.a, solution.b])

    # Over a longer step the smoothing would be estimated anew.
    step = 1e-6
    wanted = (limits(0.1 + step) - limits(0.1 - step)) / (2 * step)
    _, found = lc.gradient(contact(0.1), ["a", "b"], "upper.rotated.angle", load=0.3)
    np.testing.assert_allclose(found, wanted, rtol=1e-7)


@pytest.mark.parametrize(
    "settings",
    [
        {"limit_search": "brent"},
        {"limit_search": "bisection", "inversion": "secant"},
        {"quadrature": lc.Midpoint()},
        {"tolerance": 1e-9},
        {"start": (-0.1, 0.1), "single_interval": True},
        {"certified": True},
    ],
    ids=str,
)
def test_whatever_way_the_contact_is_found(settings: dict[str, Any]) -> None:
    def gradient(**settings: Any) -> tuple[Array, Array]:
        body = lc.Ellipse(2.0, 1.5, (-1.2, 1.3)).rotated(0.1)
        contact = lc.Contact(lc.Flat(), body, kappa=1.3, **settings)
        return lc.gradient(contact, ["a", "b", "mean_pressure"], ["upper.along", "load"], load=0.3)

    for found, exact in zip(gradient(**settings), gradient(), strict=True):
        for row, wanted in zip(found, exact, strict=True):
            close(row, wanted, 1e-7 if "tolerance" in settings else 1e-12)


def test_numbers_are_called_as_the_constructors_call_them() -> None:
    bodies = [
        lc.Line(0.1, (-1.0, 1.0)),
        lc.Parabola(1.0, (-1.0, 1.0)),
        lc.Ellipse(1.0, 1.0, (-1.0, 1.0)),
        lc.Involute(1.0, 0.5, (0.1, 1.0)),
        lc.Crowning(0.1, 1.0, (-0.9, 0.9)),
        lc.Wedge((-0.1, 0.1), 1.0),
        lc.RoundedPunch(0.5, 1.0, 2.0),
    ]
    for body in bodies:
        known = lc.parameters(lc.Contact(lc.Flat(), body))
        names = list(dict.fromkeys(name.split(".")[1] for name in known))
        assert sorted(names) == sorted(inspect.signature(type(body)).parameters)
        for name, value in known.items():
            given = inspect.signature(type(body)).bind(*body._arguments()).arguments[name.split(".")[1]]
            assert value == (given[int(name[-1])] if isinstance(given, tuple) else given)
    placed = lc.Flat().rotated(0.1).scaled(2.0).shifted(0.2, 0.3)
    assert lc.parameters(lc.Contact(lc.Flat(), placed)) == {
        "upper.rotated.angle": 0.1,
        "upper.scaled.factor": 2.0,
        "upper.shifted.along": 0.2,
        "upper.shifted.across": 0.3,
    }


def test_shapes_of_what_comes_back() -> None:
    contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)))
    value, derivative = lc.gradient(contact, "a", "load", load=0.02)
    assert isinstance(value, float) and isinstance(derivative, float)
    values, derivatives = lc.gradient(contact, ["a"], "load", load=0.02)
    assert values.shape == (1,) and derivatives.shape == (1,)
    assert derivatives[0] == derivative and values[0] == contact.solve(load=0.02).a
    assert lc.gradient(contact, "a", ["load", "upper.radius"], load=0.02)[1].shape == (2,)
    assert lc.gradient(contact, ["a", "b", "load"], ["load", "upper.radius"], load=0.02)[1].shape == (3, 2)
    assert lc.gradient(contact, "a", [], load=0.02)[1].shape == (0,)


# Requests without a derivative.


def test_what_there_is_not() -> None:
    contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)))
    known = "no parameter \"upper.r\": there are upper.radius, upper.domain.0, upper.domain.1, load"
    with pytest.raises(ValueError, match=known):
        lc.gradient(contact, "a", ["upper.r"], load=0.02)
    with pytest.raises(ValueError, match="no quantity \"width\": there are load, a, b"):
        lc.gradient(contact, "width", "load", load=0.02)
    for name in ("peak_x", "peak_error", "max_shear_x", "contacts", "limits_error", "is_checked", "evaluations"):
        with pytest.raises(ValueError, match=f"{name} .*: it has no derivative here"):
            lc.gradient(contact, name, "load", load=0.02)
    with pytest.raises(TypeError, match="between references"):
        lc.gradient(contact, "stiffness", "load", load=0.02)
    with pytest.raises(TypeError, match="prescribed are no numbers"):
        lc.gradient(contact, "a", "upper.radius")


def test_a_curve_of_ones_own_has_no_second_derivatives() -> None:
    curve = lc.Curve((-1.0, 1.0), lambda x: (x, x * x / 2, 1.0, x))
    half = lc.Curve((0.0, 1.0), lambda x: (x, x * x / 2, 1.0, x))
    parts = lc.Piecewise([lc.Parabola(1.0, (-1.0, 0.0)), half])
    with pytest.raises(ValueError, match="upper is a Curve"):
        lc.gradient(lc.Contact(lc.Flat(), curve), "a", "load", load=0.02)
    with pytest.raises(ValueError, match=r"lower\.parts\.1 is a Curve"):
        lc.gradient(lc.Contact(parts.flipped(), lc.Flat()), "a", "load", load=0.02)
    with pytest.raises(ValueError, match="or a Spline of points of the curve"):
        lc.parameters(lc.Contact(lc.Flat(), curve))


def test_errors_of_the_solver_are_those_of_a_solve() -> None:
    contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)))
    with pytest.raises(lc.errors.DomainTooShortError) as raised:
        lc.gradient(contact, "a", "upper.radius", load=20.0)
    with pytest.raises(lc.errors.DomainTooShortError) as plain:
        contact.solve(load=20.0)
    assert str(raised.value) == str(plain.value) and raised.value.half_width == plain.value.half_width
    wedge = lc.Contact(lc.Flat(), lc.Wedge((-0.1, 0.1), 1.0))
    with pytest.raises(lc.errors.SingularError):
        lc.gradient(wedge, "peak_pressure", "load", load=0.02)


# A row of parameters.


@pytest.mark.parametrize(
    ("depth", "half_length", "load", "moment"),
    [
        (0.01673178609617339, 2.4821273582282366, 284.14499056043553, -0.5968040037526623),
        (0.015105103075432984, 1.8759645604640456, 337.6226541902615, -1.5094190200425066),
    ],
)
def test_a_derivative_of_a_coated_contact_does_not_hang_on_those_before_it(
    depth: float, half_length: float, load: float, moment: float
) -> None:
    """Asks for three derivatives in a row, and one by one.

    The search for the second one begins with the derivatives of the first one: that by the load was off by 6 and
    0.3 %.
    """
    steel = lc.Material(210e3, 0.3)
    ends = (-0.98 * half_length, 0.98 * half_length)
    coated = lc.Layer(lc.Material(5e3, 0.4), 0.3, steel)
    contact = lc.Contact(lc.Flat(), lc.Crowning(depth, half_length, ends), materials=(steel, coated))
    by = ["upper.depth", "materials.1.thickness", "load", "moment"]
    of = ["half_width", "peak_pressure"]
    _, together = lc.gradient(contact, of, by, load=load, moment=moment, about=0.0)
    each = [lc.gradient(contact, of, one, load=load, moment=moment, about=0.0)[1] for one in by]
    assert np.allclose(together, np.transpose(each), rtol=1e-8)


# Optimisers.

LOADS_AND_TILTS = [(400.0, -1e-3), (700.0, 0.0), (1000.0, 1e-3)]


def test_an_optimiser_goes_further_with_exact_gradients() -> None:
    """Optimises depth and taper of a crowned roller for a norm of its peaks.

    The roller is loaded and tilted in three ways.
    """
    optimize = pytest.importorskip("scipy.optimize")
    calls = 0

    def peaks(numbers: Array) -> tuple[float, Array]:
        nonlocal calls
        calls += 1
        depth, taper = math.exp(numbers[0]) / 1e3, numbers[1] / 1e3
        by = {"upper.depth": depth}, {"upper.rotated.angle": 1e-3}
        power, rate = 0.0, np.zeros(2)
        for load, tilt in LOADS_AND_TILTS:
            roller = lc.Crowning(depth, 8.0, (-7.999, 7.999)).rotated(taper + tilt)
            contact = lc.Contact(lc.Flat(), roller, contact_modulus=115e3)
            peak, by_both = lc.gradient(contact, "peak_pressure", by, load=load)
            power += (peak / 100.0) ** 8
            rate += (peak / 100.0) ** 7 / 100.0 * by_both
        return power**0.125, power**-0.875 * rate

    def minimum(of: Callable[[Array], Any], **settings: Any) -> tuple[Array, int, float]:
        nonlocal calls
        calls = 0
        found = optimize.minimize(of, [2.3, 0.0], method="BFGS", options={"gtol": 1e-10}, **settings)
        used = calls
        return found.x, used, float(np.max(np.abs(peaks(found.x)[1])))

    exact, solves, residual = minimum(peaks, jac=True)
    rough, more, left = minimum(lambda numbers: peaks(numbers)[0])
    print(f"exact gradients: {solves} evaluations, {residual:.1e} left; differences: {more}, {left:.1e}")
    assert np.allclose(exact, rough, rtol=1e-6)
    assert solves <= 20 and 3 * solves < more
    assert residual < 1e-9 and 100 * residual < left
