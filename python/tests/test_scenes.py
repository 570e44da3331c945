"""Random scenes: the answer holds for any bodies, or an error gives the reason."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

import linecontact as lc

# Settings with the same scenes in each run: the random tests of the library take new ones.
SAME = settings(
    database=None,
    deadline=None,
    derandomize=True,
    max_examples=150,
    suppress_health_check=[HealthCheck.too_slow],
)
FLAT = lc.Flat()


def sizes(least: float, most: float) -> st.SearchStrategy[float]:
    """Returns positive numbers, as likely between 1 and 10 as between 10 and 100."""
    return st.floats(math.log(least), math.log(most)).map(math.exp)


def shapes() -> st.SearchStrategy[lc.Body]:
    """Returns upper bodies of about the size 1 that bulge towards the contact."""
    arc = st.builds(
        lambda long, high, reach: lc.Ellipse(long, high, (-reach, reach)),
        sizes(0.5, 5.0),
        sizes(0.5, 5.0),
        st.floats(0.5, 1.3),
    )
    parabola = st.builds(lambda radius: lc.Parabola(radius, (-2.0, 2.0)), sizes(0.3, 10.0))
    crowning = st.builds(lambda depth: lc.Crowning(depth, 2.0, (-1.9, 1.9)), sizes(0.01, 0.5))
    punch = st.builds(
        lambda flat, radius: lc.RoundedPunch(flat, radius, 2.0), st.floats(0.05, 0.6), sizes(0.3, 3.0)
    )
    wedge = st.builds(
        lambda left, right: lc.Wedge((-left, right), 2.0), sizes(0.03, 1.0), sizes(0.03, 1.0)
    )
    unlike = st.builds(
        lambda left, right: lc.Piecewise(
            [lc.Parabola(left, (-2.0, 0.0)), lc.Parabola(right, (0.0, 2.0))]
        ),
        sizes(0.3, 5.0),
        sizes(0.3, 5.0),
    )
    return st.one_of(arc, parabola, crowning, punch, wedge, unlike)


@st.composite
def scenes(draw: st.DrawFn) -> tuple[lc.Body, lc.Body, float]:
    """Draws a body on a flat or on one that bulges towards it, and a load."""
    upper = draw(shapes())
    lower: lc.Body = FLAT
    if draw(st.booleans()):
        lower = lc.Parabola(draw(sizes(1.0, 20.0)), (-2.5, 2.5)).flipped()
    return lower, upper, draw(sizes(1e-4, 1e-1))


def solved(lower: lc.Body, upper: lc.Body, load: float, **settings: Any) -> lc.Solution | None:
    """Returns the solution; None if the body is too short for the load."""
    try:
        return lc.solve(lower, upper, kappa=1.0, load=load, **settings)
    except lc.errors.DomainTooShortError as error:
        assert error.carried < load
        return None


def found(scene: tuple[lc.Body, lc.Body, float]) -> lc.Solution:
    """Returns the solution; scenes without one are left out."""
    solution = solved(*scene)
    assume(solution is not None)
    assert solution is not None
    return solution


def close(one: lc.Solution, other: lc.Solution, factor: float = 1.0, shift: float = 0.0) -> None:
    """Checks that the limits agree, after a scaling and a shift, to within their estimated errors.
    """
    assert one.limits_error is not None and other.limits_error is not None
    size = one.hull.half_width * abs(factor)
    allowed = 4.0 * (one.limits_error + other.limits_error + 1e-15) * size + 1e-15 * abs(shift)
    ends = sorted(end * factor + shift for end in one.hull)
    assert np.allclose(ends, list(other.hull), rtol=0.0, atol=allowed), (ends, other)


@SAME
@given(scenes())
def test_pressures_carry_the_load_and_meet_the_equation(scene: tuple[lc.Body, lc.Body, float]) -> None:
    lower, upper, load = scene
    solution = found(scene)
    assert solution.is_checked
    on = solution.hull
    # Gauss-Chebyshev rule: accurate to rounding where bodies are smooth, to less next to a kink,
    # and least at a tip, where the pressure is infinite.
    angles = (np.arange(4000) + 0.5) * np.pi / 4000
    x = on.centre + on.half_width * np.cos(angles)
    carried = np.sum(solution.pressure(x) * np.sin(angles)) * on.half_width * np.pi / 4000
    smooth = 1e-10 if upper.pieces == 1 else 1e-5
    assert math.isclose(carried, load, rel_tol=1e-3 if isinstance(upper, lc.Wedge) else smooth)
    places = on.centre + on.half_width * np.array([-0.83, -0.37, 0.21, 0.64])
    assert np.all(np.abs(solution.residual(places)) < 1e-9 * solution.mean_pressure)
    beside = [on.left - 0.1 * on.half_width, on.right + 0.1 * on.half_width]
    for place in beside:
        try:
            assert solution.gap(place) > 0.0
        except lc.errors.OutsideBodiesError:
            pass


@SAME
@given(scenes(), st.floats(-3.0, 3.0), sizes(1e-3, 1e3))
def test_put_elsewhere(scene: tuple[lc.Body, lc.Body, float], shift: float, factor: float) -> None:
    lower, upper, load = scene
    solution = found(scene)

    def of(put: Any, load: float = load) -> lc.Solution:
        other = solved(put(lower), put(upper), load)
        assert other is not None
        return other

    close(solution, of(lambda body: body.mirrored()), -1.0)
    # A flat is the same at every x, and the height of a body before loading does not matter.
    close(solution, of(lambda body: body if body is FLAT else body.shifted(shift, 0.3)), 1.0, shift)
    close(solution, of(lambda body: body if body is FLAT else body.scaled(factor), factor * load), factor)
    # The bodies are exchanged, each upside down.
    swapped = solved(upper.flipped(), lower if lower is FLAT else lower.flipped(), load)
    assert swapped is not None
    close(solution, swapped)


@SAME
@given(scenes(), sizes(1e-6, 1e12))
def test_stiffer_and_loaded_as_much_more(scene: tuple[lc.Body, lc.Body, float], factor: float) -> None:
    lower, upper, load = scene
    solution = found(scene)
    stiffer = lc.solve(lower, upper, kappa=factor, load=factor * load)
    close(solution, stiffer)
    assert math.isclose(stiffer.mean_pressure, factor * solution.mean_pressure, rel_tol=1e-12)


@SAME
@given(scenes())
def test_what_is_found_can_be_prescribed(scene: tuple[lc.Body, lc.Body, float]) -> None:
    lower, upper, load = scene
    solution = found(scene)
    contact = lc.Contact(lower, upper, kappa=1.0)
    by_width = contact.solve(half_width=solution.half_width)
    assert math.isclose(by_width.load, load, rel_tol=1e-9)
    peak = solution.peak().pressure
    if math.isinf(peak):
        return
    by_peak = contact.solve(peak_pressure=peak)
    assert math.isclose(by_peak.load, load, rel_tol=1e-6)


anything = st.floats(allow_nan=True, allow_infinity=True)


@SAME
@given(st.lists(anything, min_size=4, max_size=4), anything, anything)
def test_any_numbers_give_an_answer_or_one_of_the_errors(
    numbers: list[float], load: float, modulus: float
) -> None:
    one, other, third, fourth = numbers
    makers: list[Any] = [
        lambda: lc.Parabola(one, (other, third)),
        lambda: lc.Ellipse(one, other, (third, fourth)),
        lambda: lc.Crowning(one, other, (third, fourth)),
        lambda: lc.Wedge((one, other), third),
        lambda: lc.RoundedPunch(one, other, third),
        lambda: lc.Parabola(1.0, (-1.0, 1.0)).rotated(one).scaled(other).shifted(third, fourth),
    ]
    for make in makers:
        try:
            solution = lc.solve(FLAT, make(), contact_modulus=modulus, load=load)
        except lc.LineContactError:
            continue
        assert solution.a > -solution.b and math.isclose(solution.load, load, rel_tol=1e-9)
