"""The reference files, at the tolerances of the Rust tests."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
from scenes import SCENES, Array, Pair, example_three, reference

import linecontact as lc
from linecontact.bodies import CurveFunction


@pytest.mark.parametrize(("name", "bodies", "accuracy"), SCENES, ids=[name for name, *_ in SCENES])
def test_limits_and_pressures(name: str, bodies: Callable[[], Pair], accuracy: float) -> None:
    want = reference(name)
    solution = lc.solve(*bodies(), kappa=want.kappa, load=want.load)
    for got, exact in [(solution.a, want.a), (solution.b, want.b)]:
        assert abs(got - exact) <= accuracy * max(abs(got), abs(exact))
    # As tests/suite/estimates.rs: what is said of each error covers it.
    x, exact_pressures = want.points.T
    values, errors = solution.pressure_estimate(x)
    judged = np.isfinite(exact_pressures) & (exact_pressures != 0.0)
    assert np.all(np.abs(values - exact_pressures)[judged] <= errors[judged])


def test_there_are_enough_of_them() -> None:
    assert len(SCENES) >= 10


class Counted:
    """A function that counts its calls, and the points asked for."""

    def __init__(self, function: CurveFunction) -> None:
        self.function, self.sizes = function, list[int]()

    def __call__(self, k: Array) -> Sequence[Any]:
        self.sizes.append(k.size)
        return self.function(k)


def test_python_is_called_for_many_points_at_a_time() -> None:
    bodies = example_three()
    counted = [Counted(body.function) for body in bodies if isinstance(body, lc.Curve)]
    lower, upper = (
        lc.Curve(body.domain, count) for body, count in zip(bodies, counted, strict=True)
    )
    # Both ends at once.
    assert [count.sizes for count in counted] == [[2], [2]]
    contact = lc.Contact(lower, upper, kappa=1.0)
    assert [count.sizes for count in counted] == [[2], [2]]
    want = reference("paper_example_3_scale_one")
    cost = contact.solve(load=want.load).cost
    sizes = [size for count in counted for size in count.sizes[1:]]
    assert sum(sizes) == cost.evaluations + cost.heights
    # Of these six are single points, by which the first point of each contact is found on its curve.
    assert len(sizes) <= 14
    assert sizes.count(1) <= 6
