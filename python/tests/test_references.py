"""The reference files, at the tolerances of the Rust tests."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scenes import (
    DATA,
    SCENES,
    Array,
    Pair,
    example_five,
    example_four,
    example_three,
    from_file,
    reference,
)

import linecontact as lc
from linecontact.bodies import CurveFunction


@pytest.mark.parametrize(("name", "bodies", "accuracy"), SCENES, ids=[name for name, *_ in SCENES])
def test_limits_and_pressures(name: str, bodies: Callable[[], Pair], accuracy: float) -> None:
    want = reference(name)
    solution = lc.solve(*bodies(), kappa=want.kappa, load=want.load)
    for got, exact in [(solution.a, want.a), (solution.b, want.b)]:
        assert abs(got - exact) <= accuracy * max(abs(got), abs(exact))
    # The estimate of each error covers it, as in tests/suite/estimates.rs.
    x, exact_pressures = want.points.T
    values, errors = solution.pressure_estimate(x)
    judged = np.isfinite(exact_pressures) & (exact_pressures != 0.0)
    assert np.all(np.abs(values - exact_pressures)[judged] <= errors[judged])


def test_there_are_enough_of_them() -> None:
    assert len(SCENES) >= 10


class Counted:
    """A function that counts its calls, and the points of each."""

    def __init__(self, function: CurveFunction) -> None:
        self.function, self.sizes = function, list[int]()

    def __call__(self, k: Array) -> Sequence[Any]:
        self.sizes.append(k.size)
        return self.function(k)


# Number of calls of the curves in one solve, and of calls for single points, by which the first
# point of each piece is found.
CALLS = {"three": (example_three, 11, 0), "four": (example_four, 17, 1), "five": (example_five, 20, 0)}


@pytest.mark.parametrize("example", CALLS)
def test_python_is_called_for_many_points_at_a_time(
    example: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    counted: list[Counted] = []
    curve = lc.Curve

    def counting(domain: tuple[float, float], function: CurveFunction) -> lc.Curve:
        counted.append(Counted(function))
        return curve(domain, counted[-1])

    monkeypatch.setattr(lc, "Curve", counting)
    bodies, calls, single = CALLS[example]
    lower, upper = bodies()
    before = [list(count.sizes) for count in counted]
    # Both ends are taken in one call.
    assert all(sizes[0] == 2 for sizes in before)
    contact = lc.Contact(lower, upper, kappa=1.0)
    assert [count.sizes for count in counted] == before
    number = {"three": 3, "four": 4, "five": 5}[example]
    want = reference(f"paper_example_{number}_scale_one")
    solver = lc.Solver()
    cost = solver.solve(contact, load=want.load).cost
    asked = zip(counted, before, strict=True)
    sizes = [size for count, known in asked for size in count.sizes[len(known) :]]
    assert sum(sizes) == cost.evaluations + cost.heights
    assert len(sizes) <= calls
    assert sizes.count(1) <= single
    asked_so_far = sum(len(count.sizes) for count in counted)
    solver.solve(contact, load=1.02 * want.load)
    assert sum(len(count.sizes) for count in counted) == asked_so_far


def files(pattern: str) -> list[Path]:
    return sorted(DATA.glob(pattern))


@pytest.mark.parametrize("path", files("several/*.json"), ids=lambda path: path.stem)
def test_several_contacts(path: Path) -> None:
    want = json.loads(path.read_text())
    lower, upper = from_file(want["body1"]), from_file(want["body2"])
    ends = [float(want["limits"][0][0]), float(want["limits"][-1][1])]
    edges = [
        lc.Edge.fixed(end) if kind == "fixed" else lc.Edge.free()
        for kind, end in zip(want["edges"], ends, strict=True)
    ]
    contact = lc.Contact(
        lower, upper, kappa=float(want["scale_value"]), edges=(edges[0], edges[1])
    )
    solution = contact.solve(load=float(want["F"]))
    limits = np.array([[float(end) for end in on] for on in want["limits"]])
    found = np.array(solution.intervals)
    assert found.shape == limits.shape
    widths = limits[:, 1] - limits[:, 0]
    allowed = want["tolerance_limits_per_width"] * widths[:, None]
    assert np.all(np.abs(found - limits) <= allowed)
    points = np.array([[float(one) for one in point] for point in want["points"]])
    missed = np.abs(solution.pressure(points[:, 0]) - points[:, 1])
    assert np.max(missed) <= want["tolerance_pressure_per_max"] * np.max(points[:, 1])
    loads = [contact.load for contact in solution.contacts()]
    np.testing.assert_allclose(loads, [float(load) for load in want["loads"]], rtol=1e-9)


@pytest.mark.parametrize("path", files("reject_*.json"), ids=lambda path: path.stem)
def test_refused(path: Path) -> None:
    want = json.loads(path.read_text())
    if path.stem == "reject_zero_load":
        # "an error or an empty contact": it is an empty one.
        lower, upper = from_file(want["body1"]), from_file(want["body2"])
        assert lc.solve(lower, upper, kappa=1.0, load=0.0).is_apart
        return
    with pytest.raises(lc.LineContactError) as raised:
        lower, upper = from_file(want["body1"]), from_file(want["body2"])
        lc.solve(lower, upper, kappa=float(want["scale_value"]), load=float(want["C"]) / np.pi)
    error = getattr(raised.value, "source", raised.value)
    assert type(error).__name__ in {f"{want['expected_error']}Error", f"Profile{want['expected_error']}Error"}


def test_a_pin_in_a_hole() -> None:
    steel, brass = lc.Material(210e3, 0.3), lc.Material(100e3, 0.34)
    bush = lc.PinInHole(10.0, 0.02, 400.0, (steel, steel))
    # Its pressures carry the load, and the solution for half-planes says how far it is off.
    angles = np.linspace(-bush.half_angle, bush.half_angle, 20_001)
    carried = np.trapezoid(bush.pressure(angles) * np.cos(angles), angles) * 10.0
    assert math.isclose(carried, 400.0, rel_tol=1e-5)
    pin, hole = (lc.Ellipse.circle(radius, (-1.5, 1.5)) for radius in (10.0, 10.02))
    solution = lc.solve(hole, pin, materials=(steel, steel), load=400.0)
    assert solution.conformity is not None
    assert abs(solution.conformity.too_low - (1.0 - solution.peak().pressure / bush.pressure(0.0))) < 3e-3
    assert bush.pressure(3.0) == 0.0
    with pytest.raises(lc.errors.UnlikeBodiesError):
        lc.PinInHole(10.0, 0.02, 400.0, (steel, brass))
    with pytest.raises(lc.LineContactError, match="radius"):
        lc.PinInHole(-10.0, 0.02, 400.0, (steel, steel))
