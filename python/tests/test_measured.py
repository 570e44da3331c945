"""Smoothed splines of measured points: their noise, and the uncertainty that it leaves."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from scenes import Array

import linecontact as lc

FLAT = lc.Flat()
NOISE = 1e-5
EXACT = lc.solve(FLAT, lc.Ellipse.circle(1.0, (-0.6, 0.6)), kappa=1.0, half_width=0.1)


def measured(seed: int = 0, noise: float = NOISE) -> lc.Spline:
    """Returns a circle of radius 1, measured at 2001 points."""
    x = np.linspace(-0.5, 0.5, 2001)
    heights = 1.0 - np.sqrt(1.0 - x**2) + noise * np.random.RandomState(seed).normal(size=x.size)
    return lc.Spline(np.column_stack([x, heights]), smooth=True)


def solved(upper: lc.Body, lower: lc.Body = FLAT, load: float = EXACT.load) -> lc.Solution:
    return lc.solve(lower, upper, kappa=1.0, load=load)


def close(found: lc.Uncertainty, wanted: lc.Uncertainty | Array, within: float) -> None:
    np.testing.assert_allclose(found, wanted, rtol=within)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("noise", [1e-6, 1e-5, 1e-4])
def test_noise_and_errors_are_as_estimated(noise: float, seed: int) -> None:
    body = measured(seed, noise)
    assert abs(body.noise / noise - 1.0) < 0.2
    solution = solved(body)
    _, _, half_width, peak_pressure = solution.uncertainty()
    assert abs(solution.half_width - 0.1) < 3.0 * half_width < 0.01
    assert abs(solution.peak().pressure - EXACT.peak().pressure) < 3.0 * peak_pressure
    assert peak_pressure < 0.1 * EXACT.peak().pressure


def test_the_uncertainty_survives_a_placement() -> None:
    body = measured()
    wanted = solved(body).uncertainty()
    mirrored = lc.Uncertainty(wanted.b, wanted.a, *wanted[2:])
    close(solved(body.mirrored()).uncertainty(), mirrored, 1e-6)
    close(solved(FLAT, body.flipped()).uncertainty(), wanted, 1e-6)
    close(solved(FLAT, body.mirrored().flipped()).uncertainty(), mirrored, 1e-6)
    close(solved(body.shifted(3.0, -1.0)).uncertainty(), wanted, 1e-6)
    close(solved(body.rotated(1e-3)).uncertainty(), wanted, 0.02)
    scaled = np.array(wanted) * [2.0, 2.0, 2.0, 1.0]
    close(solved(body.scaled(2.0), load=2.0 * EXACT.load).uncertainty(), scaled, 1e-6)
    # A negative factor turns the body upside down.
    close(solved(FLAT, body.scaled(-1.0)).uncertainty(), mirrored, 1e-6)


def test_two_measured_bodies_add_their_uncertainties() -> None:
    one, other = measured(1), measured(2)
    both = solved(other, one.flipped(), load=0.5 * EXACT.load)
    exact = lc.Ellipse.circle(1.0, (-0.6, 0.6))
    alone = [
        solved(exact, one.flipped(), load=0.5 * EXACT.load).uncertainty(),
        solved(other, exact.flipped(), load=0.5 * EXACT.load).uncertainty(),
    ]
    close(both.uncertainty(), np.hypot(*np.array(alone)), 0.02)


def test_exact_bodies_have_no_uncertainty() -> None:
    assert EXACT.uncertainty() == (0.0, 0.0, 0.0, 0.0)
    through = lc.Spline(measured(noise=0.0).points)
    for body in (through, through.mirrored()):
        assert solved(body).uncertainty().half_width == 0.0
    assert through.noise == 0.0


def test_what_a_placement_refuses() -> None:
    body = measured()
    with pytest.raises(lc.errors.SplineUnsortedError):
        body.rotated(1.5)
    with pytest.raises(lc.errors.ProfileParameterError):
        body.scaled(0.0)


def test_pickles_and_columns_keep_it() -> None:
    solution = solved(measured().mirrored())
    wanted = solution.uncertainty()
    assert pickle.loads(pickle.dumps(solution)).uncertainty() == wanted
    names = ["half_width_deviation", "peak_pressure_deviation"]
    found = lc.sweep(solution.contact, load=[EXACT.load], quantities=names)
    assert [found[name][0] for name in names] == [wanted.half_width, wanted.peak_pressure]
