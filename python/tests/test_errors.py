"""Errors: the class of each one, its numbers, and a call that provokes it."""

from __future__ import annotations

import math
import pickle
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import linecontact as lc
from linecontact import _native, errors

SOURCE = Path(__file__).parents[2] / "src"
FLAT = lc.Flat()
LAND = lc.Contact(FLAT, lc.Outline().line(1.0).corner(0.1).line(1.0).mirrored().body(), kappa=1.0)
# Two equal hills at -1 and 1.
HILLS = lc.Contact(
    FLAT,
    lc.Curve((-3.0, 3.0), lambda k: (k, k * k * (k * k - 2.0), 1.0, 4.0 * k * (k * k - 1.0))),
    kappa=1.0,
)
BODY = lc.Parabola(1.0, (-1.0, 1.0))
STEEL = lc.Material(210e3, 0.3)
X = np.linspace(-1.0, 1.0, 21)
TO = lc.References(0.0, lc.Reference.depth(10.0), lc.Reference.depth(10.0))


def contact(**settings: Any) -> lc.Contact:
    return lc.Contact(FLAT, BODY, **{"kappa": 1.0, **settings})


def solved(**settings: Any) -> lc.Solution:
    return contact(**settings).solve(load=0.02)


def material(**settings: Any) -> lc.Contact:
    return lc.Contact(FLAT, BODY, materials=(STEEL, STEEL), **settings)


def spline(*rows: tuple[float, float], **fit: Any) -> lc.Spline:
    return lc.Spline(list(rows), **fit)


def graph(y: Callable[[Any], Any], dy: Callable[[Any], Any], reach: float = 1.0) -> lc.Curve:
    return lc.Curve((-reach, reach), lambda x: (x, y(x), 1.0, dy(x)))


def bumps() -> lc.Curve:
    return graph(lambda x: x**4 - 2 * x**2, lambda x: 4 * x**3 - 4 * x, 2.0)


def uneven_bumps() -> lc.Curve:
    return graph(lambda x: x**4 - 2 * x**2 + 0.05 * x, lambda x: 4 * x**3 - 4 * x + 0.05, 2.0)


def outlier() -> lc.Spline:
    y = X**2 / 2
    y[7] += 0.1
    return lc.Spline(np.column_stack([X, y]))


def layered(thickness: float, **settings: Any) -> lc.Contact:
    return lc.Contact(FLAT, BODY, materials=(STEEL, lc.Layer(STEEL, thickness, "bonded")), **settings)


def table() -> lc.SpringTable:
    return lc.SpringTable(material(), TO, (1.0, 10.0), 1e-3)


def roller(slices: int = 20, relief: lc.Body | None = None) -> lc.FiniteRoller:
    return lc.FiniteRoller(table(), 2.0, slices, relief)


def two_jumps() -> lc.Piecewise:
    return lc.Piecewise([lc.Line(0.0, (-1.0, 0.0)), lc.Line(1.0, (0.5, 1.0))])


def sinh_parameter(k: Any) -> tuple[Any, ...]:
    size = math.sinh(40.0)
    x, dx = np.sinh(40.0 * k) / size, 40.0 * np.cosh(40.0 * k) / size
    return x, x**2 / 2, dx, x * dx


def dwindling(x: Any) -> tuple[Any, ...]:
    """Curve that would turn down beyond its end."""
    return x, x**2 / 2 - x**4 / 4, 1.0, x - x**3


def waves(x: Any) -> tuple[Any, ...]:
    """Curve with waves outside the contact, too short for any number of panels."""
    return x, x**2 / 2, 1.0, x + np.maximum(x - 0.5, 0.0) ** 4 * np.sin(1e9 * x)


def missed_bump(x: Any) -> tuple[Any, ...]:
    """Curve with a bump too narrow for the panels and too small for the solve to notice."""
    width, rise = 2e-3, 1e-4
    t = np.clip((x - 0.123) / width, -1.0, 1.0)
    area = t - 2 / 3 * t**3 + t**5 / 5
    return x, x**2 / 2 + rise * width * area, 1.0, x + rise * (1 - t**2) ** 2


def saw(k: Any) -> tuple[Any, ...]:
    """Curve with hundreds of undeclared kinks."""
    x, dx = k + 0.1 * k**3, 1.0 + 0.3 * k**2
    u = (800.0 * x) % 1.0
    tooth = np.abs(2 * u - 1.0) - 0.5
    sum_ = np.where(u < 0.5, u - u**2, 0.25 + (u - 0.5) ** 2) - u / 2
    return x, x**2 / 2 + sum_ / 8000.0, dx, (x + tooth / 10.0) * dx


class Sinks:
    """A double well, one half of which sinks after the solve."""

    def __init__(self) -> None:
        self.sunk = 0.0

    def __call__(self, x: Any) -> tuple[Any, ...]:
        return x, x**4 - 2 * x**2 + self.sunk * (x > 0), 1.0, 4 * x**3 - 4 * x

    def certify(self) -> None:
        solution = lc.solve(FLAT, lc.Curve((-2.5, 2.5), self), kappa=1.0, load=0.1)
        self.sunk = 1e-6
        solution.certify()


def in_a_groove() -> lc.Contact:
    groove, punch = lc.Parabola(3.0, (-1.5, 1.5)), lc.RoundedPunch(1.0, 0.1, 1.05)
    return lc.Contact(groove, punch, kappa=1.0, single_interval=True)


def one_sided(inversion: lc.Search) -> None:
    lc.solve(
        FLAT,
        lc.Curve((-1, 1), sinh_parameter),
        kappa=1.0,
        load=0.3,
        inversion=inversion,
        quadrature=lc.Midpoint(),
    )


CASES: list[tuple[Callable[[], Any], str, dict[str, Any]]] = [
    # Bodies.
    (lambda: lc.Parabola(0.0, (-1, 1)), "ProfileParameterError", {"value": 0.0}),
    (lambda: lc.Ellipse.circle(1.0, (-2, 1)), "ProfileParameterError", {"value": -2.0}),
    (lambda: BODY.scaled(0.0), "ProfileParameterError", {"value": 0.0, "must": "not zero"}),
    (lambda: lc.Line(1.0, (1, -1)), "ProfileDomainError", {"from_": 1.0, "to": -1.0}),
    (
        lambda: lc.Piecewise([lc.Wedge((-1, 1), 1.0)]).flipped(),
        "PiecewiseInPieceError",
        {"piece": 1, "source": "ProfileJoinedError", "source.pieces": 2},
    ),
    (
        lambda: graph(lambda x: x**2, lambda x: x).check_derivatives(),
        "ProfileDerivativeError",
        {"quantity": "Y'"},
    ),
    (
        lambda: lc.Piecewise([graph(lambda x: x**2, lambda x: -2 * x)]),
        "PiecewiseInPieceError",
        {"source.quantity": "Y'"},
    ),
    (
        lambda: lc.Piecewise([lc.Curve((-1, 1), lambda k: (k / k, k, 1.0, 1.0))]),
        "PiecewiseInPieceError",
        {"source": "ProfileNotFiniteError", "source.quantity": "X", "source.k": 0.0},
    ),
    (lambda: lc.Piecewise([]), "PiecewiseNoPiecesError", {}),
    (lambda: lc.Piecewise([BODY], tolerance=-1.0), "PiecewiseToleranceError", {"tolerance": -1.0}),
    (two_jumps, "PiecewiseGapError", {"breakpoint": 1, "left": 0.0, "right": 0.5}),
    (lambda: lc.Piecewise([BODY, BODY]), "PiecewiseOverlapError", {"left": 1.0, "right": -1.0}),
    (
        lambda: lc.Piecewise([lc.Line(0.0, (-1, 1)), lc.Line(1.0, (1, 2))]),
        "PiecewiseJumpError",
        {"x": 1.0, "left": 0.0, "right": 1.0},
    ),
    (lambda: spline((0, 0), (1, 0)), "SplineTooFewError", {"points": 2}),
    (lambda: spline((0, 0), (1, math.inf)), "SplineNotFiniteError", {"row": 2, "y": math.inf}),
    (lambda: spline((0, 0), (0, 1)), "SplineDuplicateError", {"row": 2, "x": 0.0}),
    (lambda: spline((0, 0), (-1, 1)), "SplineUnsortedError", {"row": 2, "before": 0.0}),
    (outlier, "SplineOutlierError", {"row": 8}),
    (
        lambda: spline((0, 0), (1, 1), (2, 1), (3, 0), period=3.0),
        "SplinePeriodError",
        {"period": 3.0, "first": 0.0, "last": 3.0},
    ),
    (
        lambda: spline((0, 0), (1, 1), (2, 0), (3, 1), outliers=0.0),
        "SplineLimitError",
        {"deviations": 0.0},
    ),
    (
        lambda: spline((0, 0), (1, 1e308), (2, -1e308), (3, 1e308), outliers=None),
        "SplineOverflowError",
        {"row": 2},
    ),
    # Scenes.
    (
        lambda: lc.Contact(BODY, BODY.shifted(5.0)),
        "NoCommonRangeError",
        {"lower": (-1.0, 1.0), "upper": (4.0, 6.0)},
    ),
    (
        lambda: lc.Contact(FLAT, lc.Curve((-1, 1), lambda k: (k**2, k, 2 * k, 1.0))),
        "ProfileError",
        {"body": "upper", "source": "ProfileTurnsBackError", "source.x": 0.0},
    ),
    (
        lambda: lc.Pair(FLAT, BODY, materials=(STEEL, STEEL), references=TO).at((0, 0, 0), (0, 0, 1.5)),
        "PoseError",
        {"x": 0.0, "y": 0.0, "angle": 1.5},
    ),
    (
        lambda: roller(relief=graph(lambda x: x * math.nan, lambda x: 0.0)),
        "ReliefError",
        {"source": "ProfileNotFiniteError"},
    ),
    (
        lambda: lc.SpringTable(material(), TO, (1.0, 10.0), 1e-17),
        "ToleranceNotReachedError",
        {"tolerance": 1e-17},
    ),
    (
        lambda: lc.SpringTable(material(), TO, (1.0, 10.0), 1e-15),
        "ToleranceNotReachedError",
        {"tolerance": 1e-15},
    ),
    (lambda: contact().solve(load=-1.0), "InvalidLoadError", {"quantity": "load", "value": -1.0}),
    (
        lambda: contact().solve(half_width=0.0),
        "InvalidLoadError",
        {"quantity": "half-width", "value": 0.0},
    ),
    (lambda: contact(kappa=-1.0).solve(load=1.0), "InvalidKappaError", {"kappa": -1.0}),
    (
        lambda: lc.solve(FLAT, BODY, contact_modulus=-2.0, load=1.0),
        "InvalidModulusError",
        {"modulus": -2.0},
    ),
    (lambda: solved(start=(0.1, -0.1)), "InvalidLimitsError", {"interval": (0.1, -0.1)}),
    (
        lambda: solved(edge_pressure=lc.EdgePressure.zero(-1e-3, 1e-9)),
        "InvalidEdgePressureError",
        {"value": -1e-3},
    ),
    (
        lambda: contact(edge_pressure=lc.EdgePressure.zero(1e-3, 1e-9)).solve(half_width=0.1),
        "EdgePressureLoadError",
        {},
    ),
    (lambda: solved(quadrature=lc.Midpoint(0)), "InvalidSegmentsError", {"segments": 0}),
    (lambda: solved(tolerance=2.0), "InvalidToleranceError", {"tolerance": 2.0}),
    (
        lambda: solved(resolution=1e-9),
        "InvalidResolutionError",
        {"resolution": 1e-9, "least": 6.357828776041667e-06},
    ),
    (
        lambda: solved(edges=(lc.Edge.adhesive(-1.0), lc.Edge.adhesive(-1.0))),
        "InvalidAdhesionError",
        {"work": -1.0},
    ),
    (
        lambda: contact(edges=(lc.Edge.fixed(-0.5), lc.Edge.fixed(0.5))).solve(half_width=0.2),
        "BothLimitsGivenError",
        {"interval": (-0.5, 0.5)},
    ),
    (lambda: contact().solve(load=1.0, moment=math.nan), "InvalidMomentError", {"quantity": "moment"}),
    (lambda: solved_with_moment(limit_search="brent"), "TiltNotSupportedError", {}),
    (lambda: contact().solve(load=0.02, centre_of_pressure=0.9), "TiltNotFoundError", {"load": 0.02, "at": 0.9}),
    (
        lambda: contact(edges=(lc.Edge.fixed(-0.5), lc.Edge.free())).solve(peak_pressure=1.0),
        "PeakEdgeError",
        {"edge": ("fixed", -0.5)},
    ),
    (
        lambda: lc.Material(-1.0, 0.3),
        "InvalidYoungsModulusError",
        {"body": "", "modulus": -1.0},
    ),
    (
        lambda: lc.contact_modulus(STEEL, lc.Material(1.0, 0.7)),
        "InvalidPoissonRatioError",
        {"ratio": 0.7},
    ),
    (lambda: lc.Material(math.nan, 0.3), "InvalidYoungsModulusError", {}),
    (lambda: lc.contact_modulus(STEEL, (0.0, 0.3)), "InvalidYoungsModulusError", {"modulus": 0.0}),
    (lambda: lc.Stress(1.0, 1.0, 0.0).von_mises(0.7), "InvalidPoissonRatioError", {"ratio": 0.7}),
    (lambda: contact(resolution=-1.0), "InvalidResolutionError", {"resolution": -1.0, "least": 0.0}),
    (lambda: contact(period=-2.0), "InvalidPeriodError", {"period": -2.0}),
    (lambda: solved(period=2.0), "NotPeriodicError", {"body": "upper", "what": "the slope", "ends": (-1.0, 1.0)}),
    (
        lambda: lc.solve(FLAT, FLAT, kappa=1.0, period=1.0, load=1.0),
        "CompleteContactError",
        {"load": 1.0, "complete": 0.0},
    ),
    (lambda: layered(0.0).solve(load=1.0), "InvalidThicknessError", {"body": "", "thickness": 0.0}),
    (lambda: layered(1e308).solve(load=1.0), "KernelError", {"at": math.inf}),
    (lambda: layered(1e-5).solve(load=100.0), "LayerTooThinError", {"limit": 100.0}),
    (lambda: layered(1.0, quadrature=lc.Midpoint()).solve(load=100.0), "KernelNotSupportedError", {}),
    (
        lambda: lc.contact_modulus(lc.Material.rigid(), lc.Material.rigid()),
        "BothRigidError",
        {},
    ),
    # Solves.
    (lambda: lc.solve(FLAT, FLAT, load=1.0), "NoFirstContactError", {"slope": (0.0, 0.0)}),
    (
        lambda: contact().solve(load=10.0),
        "DomainTooShortError",
        {"load": 10.0, "half_width": 1.0, "kappa_is_default": False},
    ),
    (
        lambda: lc.Contact(FLAT, BODY).solve(half_width=3.0),
        "HalfWidthTooLargeError",
        {"wanted": 3.0, "half_width": 1.0, "kappa_is_default": True},
    ),
    (lambda: contact().solve(peak_pressure=9.0), "PeakTooHighError", {"wanted": 9.0}),
    (lambda: HILLS.solve(half_width=0.5), "InJumpError", {"wanted": 0.5, "below": 0.0}),
    (lambda: LAND.solve(half_width=0.5), "InJumpError", {"wanted": 0.5, "below": 0.0, "above": 1.0}),
    (lambda: LAND.solve(half_width=1.0), "LoadUnknownError", {"half_width": 1.0}),
    (
        lambda: lc.Contact(FLAT, lc.Wedge((-0.1, 0.1), 1.0), kappa=1.0).solve(peak_pressure=1.0),
        "NoPeakError",
        {"wanted": 1.0, "found": math.inf},
    ),
    (
        lambda: lc.solve(FLAT, lc.Line(0.0, (-1.0, 1.0)).rotated(0.1), kappa=1.0, load=0.1),
        "NoFirstContactError",
        {},
    ),
    (
        lambda: contact(edges=(lc.Edge.adhesive(1e-4), lc.Edge.adhesive(1e-4))).solve(load=-1.0),
        "PullOffError",
        {"load": -1.0},
    ),
    (
        lambda: contact(edges=(lc.Edge.fixed(-0.5), lc.Edge.fixed(0.5))).solve(load=0.0),
        "InvalidLoadError",
        {
            "quantity": "load",
            "value": 0.0,
            "must": "positive between two corners; single_interval(true) allows any sign, and gives the "
            "pressure unchecked",
        },
    ),
    (
        lambda: contact(edges=(lc.Edge.fixed(-0.5), lc.Edge.free())).solve(load=1e-3),
        "LiftsOffError",
        {"load": 1e-3},
    ),
    (
        lambda: lc.solve(
            FLAT, graph(lambda x: x**2 / 2 + 0.01 * (x > 0.05), lambda x: x), kappa=1.0, load=0.02
        ),
        "InconsistentHeightsError",
        {},
    ),
    (
        lambda: lc.solve(
            FLAT,
            lc.Curve((-1, 1), lambda k: (k, k**4 - k**2, 1.0, 4 * k**3 - 2 * k), "convex"),
            kappa=1.0,
            load=0.02,
        ),
        "NotConvexError",
        {},
    ),
    (
        lambda: contact(
            edge_pressure=lc.EdgePressure.zero(1e-3, 1e-300), quadrature=lc.Midpoint(32)
        ).solve(load=0.02),
        "EdgePressureNotMetError",
        {},
    ),
    (
        lambda: lc.solve(
            FLAT, uneven_bumps(), kappa=1.0, load=0.1, single_interval=True, start=(-1.1, -0.9)
        ).certify(),
        "OverlapError",
        {},
    ),
    (
        lambda: lc.solve(
            FLAT, bumps(), kappa=1.0, half_width=1.1, single_interval=True, certified=True
        ),
        "TensionError",
        {},
    ),
    (
        lambda: material().solve(approach=1e9, references=TO),
        "ApproachTooLargeError",
        {"wanted": 1e9},
    ),
    (
        lambda: lc.solve(FLAT, graph(lambda x: x**2, lambda x: x), kappa=1.0, load=0.02),
        "ProfileError",
        {"body": "upper", "source.quantity": "the slope Y'/X'"},
    ),
    (
        lambda: solved(limit_search=lc.Search("bisection", max_evaluations=3)),
        "LimitSearchError",
        {"source": "SearchBudgetError", "source.best": None},
    ),
    (
        lambda: solved(limit_search=lc.Search("brent", relative=-1.0)),
        "LimitSearchError",
        {"source": "SearchToleranceError", "source.value": -1.0},
    ),
    (
        lambda: lc.solve(FLAT, lc.Curve((-1, 2), dwindling), kappa=1.0, load=0.01),
        "DomainTooShortError",
        {"end": 2.0, "carried": 0.0, "kappa_is_default": False},
    ),
    (lambda: in_a_groove().solve(load=1.0), "NoEquilibriumError", {}),
    (
        lambda: contact(edges=(lc.Edge.fixed(-0.1), lc.Edge.fixed(0.1))).solve(load=1e308),
        "OverflowError",
        {"interval": (-0.1, 0.1)},
    ),
    (
        lambda: lc.solve(FLAT, lc.Curve((-1, 1), saw), kappa=1.0, load=0.02),
        "BudgetSpentError",
        {"budget": (1 << 20) + 2048},
    ),
    (
        lambda: lc.solve(FLAT, lc.Curve((-3, 3), waves), kappa=1.0, load=0.02).certify(),
        "UndecidedError",
        {},
    ),
    (
        lambda: lc.solve(
            FLAT, lc.Curve((-1, 1), missed_bump), kappa=1.0, load=0.08, certified=True
        ),
        "FeatureMissedError",
        {},
    ),
    (lambda: Sinks().certify(), "UnbalancedError", {}),
    (
        lambda: one_sided(lc.Search("brent", max_evaluations=2)),
        "InversionError",
        {"body": "upper"},
    ),
    (
        lambda: contact(quadrature=lc.Midpoint(2)).solve(peak_pressure=0.1),
        "UnresolvedError",
        {},
    ),
    (
        lambda: material().solve(
            approach=10.0, references=lc.References(0.0, lc.Reference.length(1e-3), lc.Reference.length(1e-3))
        ),
        "FallsError",
        {"quantity": "approach"},
    ),
    # Questions.
    (lambda: solved().approach(TO), "NoMaterialsError", {}),
    (
        lambda: layered(1.0).solve(load=100.0).uncertainty(),
        "HalfPlanesOnlyError",
        {"quantity": "the uncertainty"},
    ),
    (
        lambda: material().solve(load=100.0).approach(TO._replace(upper=lc.Reference.disc(-1.0))),
        "InvalidReferenceError",
        {"length": -1.0},
    ),
    (lambda: solved().pressure(5.0), "OutsideBodiesError", {"x": 5.0, "range": (-1.0, 1.0)}),
    (
        lambda: layered(1.0).solve(load=100.0).max_tension(),
        "HalfPlanesOnlyError",
        {"quantity": "the stress of both bodies at once (name the lower or upper one)"},
    ),
    (
        lambda: layered(1.0).solve(load=100.0).stress(0.0, 1.5, body="upper"),
        "NoStressError",
        {"depths": (1.5, 1.5)},
    ),
    (lambda: solved().stress(0.0, -1.0), "AboveSurfaceError", {"x": 0.0, "depth": -1.0}),
    (lambda: solved().residual(0.5), "InvalidPositionError", {"x": 0.5, "inside": True}),
    (
        lambda: solved().stress(0.0, 1.0, friction=math.inf),
        "InvalidFrictionError",
        {"coefficient": math.inf},
    ),
    (
        lambda: contact(edges=(lc.Edge.fixed(-0.1), lc.Edge.fixed(0.1))).solve(load=1.0).stress(0.1, 0.0),
        "SingularError",
        {"x": 0.1},
    ),
    (lambda: solved(quadrature=lc.Midpoint()).load_rates(), "NoLoadDerivativeError", {}),
    (lambda: HILLS.solve(load=0.1).uncertainty(), "NoUncertaintyError", {}),
    (lambda: contact().solve(load=0.5, moment=10.0), "LoadBeyondBodiesError", {"load": 0.5, "at": 20.0}),
    (lambda: table().at(1e9), "OutsideTableError", {"approach": 1e9}),
    (lambda: lc.Outline().arc(0.0, 1.0).body(), "PiecewiseInSegmentError", {"segment": 1, "source": "ProfileParameterError"}),
    (lambda: roller(relief=lc.Parabola(-1.0, (-1.0, 1.0))), "InvalidReliefError", {"z": -0.95, "height": -0.45125}),
    (lambda: roller(slices=-3), "InvalidRollerError", {"slices": -3, "length": 2.0}),
    (lambda: roller(slices=10**30), "InvalidRollerError", {"slices": 10**30, "length": 2.0}),
    # Impossible numbers, where they are given.
    (lambda: lc.Reference.depth(-1.0), "InvalidReferenceError", {"length": -1.0}),
    (lambda: lc.Reference("depth", -1), "InvalidReferenceError", {"length": -1.0}),
    (lambda: lc.Reference("disc", 0.0), "InvalidReferenceError", {"length": 0.0}),
    (lambda: lc.Reference("length", math.inf), "InvalidReferenceError", {"length": math.inf}),
    (lambda: lc.Reference("depth", math.nan), "InvalidReferenceError", {}),
    (lambda: lc.Reference.disc(0.0), "InvalidReferenceError", {"length": 0.0}),
    (lambda: lc.Reference.length(math.inf), "InvalidReferenceError", {"length": math.inf}),
    (lambda: lc.Layer(STEEL, -1.0, STEEL), "InvalidThicknessError", {"body": "", "thickness": -1.0}),
    (lambda: contact(kappa=None, contact_modulus=-1.0), "InvalidModulusError", {"modulus": -1.0}),
    (lambda: contact(kappa=math.nan), "InvalidKappaError", {}),
    (lambda: lc.Outline().line(1.0).fillet(0.1).body(), "PiecewiseInSegmentError", {"segment": 2}),
    (lambda: lc.Outline().line(1.0).corner(0.1).mirrored().body(), "PiecewiseInSegmentError", {"segment": 2}),
    (lambda: roller().at(1e9), "SliceOutsideTableError", {"approach": 1e9, "z": -0.95}),
    (lambda: roller().under_moment(5.0, 5.0), "LoadBeyondSlicesError", {"at": 1.0, "load": 5.0}),
    (lambda: roller(1).under_moment(5.0, 0.0), "OneSliceError", {"z": 0.0}),
    (
        lambda: roller(relief=lc.Line(1e308, (-1.0, 1.0))).under_moment(5.0, 0.0),
        "RollerNotFoundError",
        {"source": "SearchBracketError"},
    ),
    (
        lambda: solved().partial_slip(friction=0.0, force=0.01),
        "InvalidSlipFrictionError",
        {"friction": 0.0},
    ),
    (
        lambda: solved().partial_slip(friction=0.4, force=math.inf),
        "InvalidShearError",
        {"quantity": "force"},
    ),
    (
        lambda: solved().partial_slip(friction=0.4, force=1.0),
        "SlipsEverywhereError",
        {"force": 1.0},
    ),
    (
        lambda: solved().partial_slip(friction=0.4, force=1e-16),
        "SticksEverywhereError",
        {"force": 1e-16},
    ),
    (
        lambda: solved().partial_slip(friction=0.4, force=1e-5, tension=0.1),
        "ReversedSlipError",
        {},
    ),
    (
        lambda: lc.Contact(FLAT, BODY, materials=(STEEL, lc.Material(1e3, 0.1))).partial_slip(
            friction=0.4, force=0.01, load=1.0
        ),
        "UnlikeBodiesError",
        {},
    ),
    (
        lambda: contact(edges=(lc.Edge.adhesive(1e-6), lc.Edge.adhesive(1e-6))).partial_slip(
            friction=0.4, force=0.001, load=0.02
        ),
        "SlipNotSupportedError",
        {},
    ),
]


def solved_with_moment(**settings: Any) -> lc.Solution:
    return contact(**settings).solve(load=0.02, moment=0.001)


@pytest.mark.parametrize(("provoke", "name", "numbers"), CASES, ids=lambda case: str(case)[:40])
def test_provoked(provoke: Callable[[], Any], name: str, numbers: dict[str, Any]) -> None:
    with np.errstate(all="ignore"), pytest.raises(lc.LineContactError) as raised:
        provoke()
    error = raised.value
    assert type(error).__name__ == name, error
    assert not re.search(r"::|Fixed|FreeUntil|Adhesive|Placement|Fit\b", str(error))
    table = dict(_native.variants())
    for attribute in table[name]:
        assert hasattr(error, attribute)
    for path, want in numbers.items():
        found: Any = error
        for attribute in path.split("."):
            found = getattr(found, attribute)
        if path == "source":
            found = type(found).__name__
        assert want is None or found == want, path
    # Pickled errors, as from other processes, keep their type, message and numbers.
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and str(again) == str(error)
    assert sorted(vars(again)) == sorted(vars(error))


# Errors that this package cannot raise, or for which no scene is known.
NOT_PROVOKED = {
    "BendingError": "no scene is known",
    "CancelledError": "comes out as KeyboardInterrupt, or as the exception of a function",
    "IntegralError": "no scene is known",
    "LengthMismatchError": "arrays of results are made here",
    "ProfilePiecesError": "of a trait for bodies of several pieces",
    "SearchLeftBracketError": "of a search of one's own",
    "SearchNoSignChangeError": "of a search of one's own",
    "SearchNotConvergedError": "of a search of one's own",
    "SearchNotFiniteError": "no scene is known",
}


def test_all_others_are_provoked() -> None:
    provoked = {name for _, name, _ in CASES}
    provoked |= {numbers["source"] for _, _, numbers in CASES if "source" in numbers}
    assert provoked == set(dict(_native.variants())) - set(NOT_PROVOKED)


def rust_variants(path: str, enum: str) -> list[str]:
    """Returns the variants of an error of the library, from its source."""
    text = (SOURCE / path).read_text()
    body = text[text.index(f"pub enum {enum}<") :]
    body = body[: body.index("\n}\n")]
    return re.findall(r"^    ([A-Z]\w+)(?: \{|\(|,)", body, flags=re.MULTILINE)


def test_there_is_a_class_for_each_variant() -> None:
    families = [
        ("error/input.rs", "InputError", ""),
        ("error/solve.rs", "SolveError", ""),
        ("error/evaluation.rs", "EvaluationError", ""),
        ("profile.rs", "ProfileError", "Profile"),
        ("profile/piecewise.rs", "PiecewiseError", "Piecewise"),
        ("profile/spline/points.rs", "SplineError", "Spline"),
        ("search.rs", "SearchError", "Search"),
    ]
    transparent = {"ShapeError", "PiecesError", "PointsError", "ClosedFormError"}
    names = {
        f"{prefix}{variant}Error"
        for path, enum, prefix in families
        for variant in rust_variants(path, enum)
    }
    table = dict(_native.variants())
    assert set(table) == names - transparent
    assert len(table) > 80
    for name, attributes in table.items():
        kind = getattr(errors, name)
        assert issubclass(kind, lc.LineContactError)
        annotated = [one for one in vars(kind).get("__annotations__", {})]
        assert annotated == attributes, name
        assert kind.__doc__


def test_kinds_are_those_of_the_library() -> None:
    classes = {"input": lc.InputError, "solve": lc.SolveError, "evaluation": lc.EvaluationError}
    for file, base in classes.items():
        for variant in rust_variants(f"error/{file}.rs", base.__name__):
            error = getattr(errors, f"{variant}Error", None)
            assert error is None or issubclass(error, base), variant


def test_what_is_prescribed_must_go_together() -> None:
    wrong: list[dict[str, Any]] = [{}, {"approach": 1.0}, {"centre_of_pressure": 0.0}]
    for given in [*wrong, {"load": 1.0, "half_width": 1.0}]:
        with pytest.raises(TypeError, match="prescribed are"):
            contact().solve(**given)
    with pytest.raises(TypeError, match=r"approach, .* give references=References\(x, lower, upper\), too"):
        contact().solve(approach=1.0)
    without_load: list[dict[str, Any]] = [{"moment": 1.0}, {"moment": 1.0, "about": 0.5}, {"centre_of_pressure": 0.0}]
    for wanted in without_load:
        with pytest.raises(TypeError, match="give load=, too"):
            contact().solve(**wanted)
    # Numbers without a name: the signatures do not allow them, but users do not see those first.
    any_: Any = lc
    calls: list[Callable[[], Any]] = [
        lambda: any_.solve(FLAT, BODY, 2.5),
        lambda: any_.Solver().solve(contact(), 2.5),
        lambda: any_.Contact(FLAT, BODY).solve(2.5),
        lambda: any_.sweep(contact(), 2.5),
        lambda: any_.Contact(FLAT, BODY).partial_slip(2.5),
    ]
    for call in calls:
        with pytest.raises(TypeError, match=r"takes 2\.5 by name, as in load=2\.5"):
            call()
    with pytest.raises(TypeError, match=r"Contact takes 1 by name, as in \w+=1"):
        any_.Contact(FLAT, BODY, 1)
    with pytest.raises(TypeError, match="say the same"):
        lc.Contact(FLAT, BODY, kappa=1.0, contact_modulus=1.0)
    with pytest.raises(TypeError, match="exclude"):
        edges = (lc.Edge.free(), lc.Edge.free())
        contact(edges=edges, edge_pressure=lc.EdgePressure.zero(1e-3, 1e-9))
    with pytest.raises(TypeError, match="tolerance"):
        contact(tolerance=1e-6, quadrature=lc.Midpoint())
    misspelt: list[dict[str, Any]] = [{"plane": "strian"}, {"limit_search": "brnt"}]
    for settings in misspelt:
        with pytest.raises(ValueError, match="strian|brnt"):
            material(**settings)


def test_missing_derivatives_show_how_to_write_them() -> None:
    with pytest.raises(TypeError, match="return x, y, dx, dy") as raised:
        lc.Curve((-1.0, 1.0), lambda k: (k, k**2))
    assert isinstance(raised.value, errors.MissingDerivativesError)
    assert raised.value.count == 2
    assert isinstance(pickle.loads(pickle.dumps(raised.value)), errors.MissingDerivativesError)


def scalar_cosh(k: Any) -> Any:
    return k, math.cosh(k), 1.0, math.sinh(k)


def with_an_if(k: Any) -> Any:
    return (k, k**2, 1.0, 2 * k) if k > 0 else (k, 0.0, 1.0, 0.0)


# Module without types: a type checker would find most of these mistakes.
ANY: Any = lc


def anything(made: Any) -> Any:
    return made


# Wrong call; exception; parts of its message: the value found, and the remedy.
MISTAKES: list[tuple[Callable[[], Any], type[Exception], tuple[str, ...]]] = [
    (lambda: material_of(STEEL), TypeError, ("materials are Material(", "such as (steel, steel)")),
    (lambda: lc.Contact(FLAT, ANY.Outline().line(1.0)), TypeError, ("is no Body", "take its body()")),
    (lambda: material_of(("steel", STEEL)), TypeError, ("'steel' is no Material", "E and ν")),
    (lambda: material_of((STEEL, 210e3)), TypeError, ("210000.0 is no Material", "E and ν")),
    (lambda: material_of((STEEL,) * 3), TypeError, ("materials are", "one for the upper body")),
    (lambda: ANY.Ellipse.circle(10, 1.0), TypeError, ("angles is 1.0", "two numbers")),
    (lambda: ANY.Line(0.1, 1.0), TypeError, ("domain is 1.0", "such as (-1.0, 1.0)")),
    (lambda: ANY.Curve(2.0, scalar_cosh), TypeError, ("domain is 2.0", "two numbers")),
    (lambda: contact(start=0.5), TypeError, ("start is 0.5", "two numbers")),
    (lambda: contact(edges=("free", "free")), TypeError, ("edges are ('free', 'free')", "each Edge.free(), .fixed(x)")),
    (lambda: contact(edges=lc.Edge.free()), TypeError, ("edges are Edge(kind='free'", "the left and the right one")),
    (lambda: ANY.Parabola("10", (-1, 1)), TypeError, ("radius is '10'", "give one number")),
    (lambda: ANY.Reference("disc", "10"), TypeError, ("radius is '10'", "give one number")),
    (lambda: ANY.Reference("disk", 10.0), ValueError, ("a reference is 'disk'", "'disc'")),
    (lambda: ANY.Curve((-1, 1), scalar_cosh), TypeError, ("array of k", "np.cosh for math.cosh")),
    (lambda: ANY.Curve((-1, 1), with_an_if), TypeError, ("array of k", "np.where for if")),
    (
        lambda: ANY.Curve((-1, 1), lambda k: (k, k[:1].repeat(3), k, k)),
        ValueError,
        ("returned y of shape (3,) for 2 values of k", "as many numbers, or a plain number for all"),
    ),
    (lambda: ANY.Curve((-1, 1), lambda k: (k, k**2, 1, k[:1])), ValueError, ("returned dy of shape (1,) for 2 values of k",)),
    (lambda: ANY.Curve((-1, 1), lambda k: (k, [0], 1, k)), ValueError, ("returned y of shape (1,) for 2 values of k",)),
    (
        lambda: ANY.Curve((-1, 1), lambda k: (k, k, "steep", k)),
        ValueError,
        ("returned dx", "as many numbers"),
    ),
    (lambda: ANY.Curve((-1, 1), lambda k: k**2), TypeError, ("returned one array:", "must return four")),
    (lambda: ANY.Curve((-1, 1), lambda k: None), TypeError, ("returned nothing:", "must return four")),
    (lambda: anything(contact()).solve(load="500"), TypeError, ("load is '500'", "give one number")),
    (lambda: anything(contact()).solve(load=[1.0, 2.0]), TypeError, ("load is [1.0, 2.0]", "give one number", "sweep")),
    *(
        (call, TypeError, (f"{name} is True: give one number",))
        for name, call in {
            "load": lambda: contact().solve(load=True),
            "radius": lambda: ANY.Parabola(True, (-1, 1)),
            "domain": lambda: ANY.Parabola(10, (-1, True)),
            "youngs_modulus": lambda: lc.Material(True, 0.3),
            "x": lambda: lc.Edge.fixed(True),
            "depth": lambda: lc.Reference.depth(True),
            "at_a": lambda: contact(edge_pressure=lc.EdgePressure(True, 0, 1, 1, 1, 1)),
            "tolerance": lambda: contact(quadrature=lc.Panels(True)),
            "segments": lambda: contact(quadrature=lc.Midpoint(True)),
            "absolute": lambda: contact(limit_search=lc.Search("brent", True)),
            "peak_pressure": lambda: lc.gradient(contact(), "load", "kappa", peak_pressure=True),
        }.items()
    ),
    (lambda: contact().solve(load=anything(np.bool_(False))), TypeError, ("load is ", "False", ": give one number")),
    (lambda: ANY.sweep(contact(), load=[True, False]), TypeError, ("load is [True, False]: give numbers",)),
    (lambda: solved().pressure(True), TypeError, ("x is True: give numbers",)),
    (lambda: ANY.Spline([[False, False]] * 5), TypeError, ("give numbers",)),
    (lambda: ANY.sweep(contact(), load="500"), TypeError, ("load is '500'", "give numbers")),
    (lambda: ANY.sweep(contact(), load=["1", "2"]), TypeError, ("load is ['1', '2']", "give numbers")),
    (
        lambda: solved().stress([0.0, 0.1], [0.1, 0.2, 0.3]),
        ValueError,
        ("x has the shape (2,), depth (3,)", "as many of each"),
    ),
    (lambda: ANY.Material(210e3, 30), lc.InputError, ("ratio is 30", "0 to 1/2", "0.3 of steel")),
    (lambda: ANY.Material("210e3", 0.3), TypeError, ("youngs_modulus is '210e3'", "one number")),
    (lambda: material_of(layered(1.0)._settings["materials"][1]), TypeError, ("materials are Layer(", "one for the")),
    (lambda: ANY.Layer(210e3, 1.0, "bonded"), TypeError, ("210000.0 is no Material", "E and ν")),
    (lambda: ANY.Layer(STEEL, "1", "bonded"), TypeError, ("thickness is '1'", "one number")),
    (lambda: ANY.Layer(STEEL, 1.0, "glued"), ValueError, ("base is 'glued'", "'frictionless', a Material")),
    (lambda: ANY.Layer(STEEL, 1.0, 0.3), TypeError, ("0.3 is no Material", "E and ν")),
    (lambda: ANY.contact_modulus(STEEL, lc.Layer(STEEL, 1.0, STEEL)), TypeError, ("Layer(", "is no Material")),
    (lambda: contact(limit_search="brend"), ValueError, ("limit_search is 'brend'", "'secant', 'brent', 'newton'")),
    (lambda: contact(inversion=3), ValueError, ("inversion is 3", "'bisection'")),
    (lambda: contact(quadrature="panels"), TypeError, ("quadrature is 'panels'", "Panels() or Midpoint()")),
    (
        lambda: contact(quadrature=ANY.Midpoint(exponents="odd")),
        ValueError,
        ("exponents is 'odd'", "'half_integer', 'even'"),
    ),
    (lambda: material(plane="strian"), ValueError, ("plane is 'strian'", "'strain', 'stress'")),
    (lambda: contact(kapa=1.0), TypeError, ("Contact has no argument kapa", "materials, kappa, plane")),
    (lambda: anything(contact()).solve(laod=1.0), TypeError, ("no argument laod", "did you mean load?", "There are load, half_width")),
    (lambda: ANY.solve(FLAT, BODY, laod=1.0), TypeError, ("solve has no argument laod", "load", "kappa")),
    (lambda: ANY.Spline(np.zeros((9, 2)), smoth=True), TypeError, ("no argument smoth", "points, smooth, outliers")),
    (lambda: ANY.Spline(np.zeros((9, 2)), smooth=1e-4), TypeError, ("smooth is 0.0001", "True or False")),
    (
        lambda: ANY.Spline(np.ma.masked_equal(np.column_stack([X, X]), 0.0)),
        ValueError,
        ("points has 2 masked numbers", "leave them out"),
    ),
]


def test_an_array_without_masked_numbers_may_have_a_mask() -> None:
    rows = np.column_stack([X, X**2])
    assert lc.Spline(np.ma.masked_invalid(rows)) == lc.Spline(rows, smooth=bool(np.bool_(False)))


def test_messages_have_the_names_of_this_package() -> None:
    """Looks at all messages in the source of the library, whether or not they are provoked above."""
    texts = []
    for path in SOURCE.rglob("*.rs"):
        # Comments have the names of the library, and so has the code between the messages.
        source = re.sub(r"^\s*//.*$", "", path.read_text(), flags=re.MULTILINE)
        texts += re.findall(r'"((?:[^"\\]|\\.)*)"', source, flags=re.DOTALL)
    rust = [re.sub(r"\\\s+", "", text) for text in texts if re.search(r"\w \w.* \w", text)]
    rust = [text for text in rust if re.search(r"\w::[A-Za-z]", text) and not re.search("impl(ement)? ", text)]
    assert len(rust) > 10
    for text in rust:
        assert "::" not in str(lc.LineContactError(text)), text


def material_of(materials: Any) -> lc.Contact:
    return lc.Contact(FLAT, BODY, materials=materials)


@pytest.mark.parametrize(("provoke", "kind", "words"), MISTAKES, ids=lambda case: str(case)[:40])
def test_mistakes_are_told_before_a_cryptic_error(
    provoke: Callable[[], Any], kind: type[Exception], words: tuple[str, ...]
) -> None:
    with pytest.raises(kind) as raised:
        provoke()
    for word in words:
        assert word in str(raised.value)


def test_what_a_function_raises_comes_out_as_it_is() -> None:
    def broken(k: Any) -> Any:
        raise ValueError("mine")

    with pytest.raises(ValueError, match="^mine$"):
        lc.Curve((-1, 1), broken)
    assert lc.Material(210e3, 0.3) == (210e3, 0.3)
    assert pickle.loads(pickle.dumps(STEEL)) == STEEL and "Material(youngs_modulus" in repr(STEEL)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: material().solve(load=100.0).approach(30.0), "references are 30.0: give an x and those of both"),  # type: ignore[arg-type]
        (lambda: material().solve(approach=1e-3, references=TO.lower), "references are Reference"),  # type: ignore[arg-type]
        (lambda: lc.SpringTable(material(), 30.0, (1.0, 2.0)), "references are 30.0"),  # type: ignore[arg-type]
        (lambda: solved().max_shear(depths=1.0), "depths is 1.0: give two numbers"),  # type: ignore[arg-type]
        (lambda: solved().max_shear(body=1), "body is 1: give 'lower' or 'upper'"),  # type: ignore[arg-type]
        (lambda: solved().max_von_mises(0.3, depths=(0.0, "1")), "depths is '1': give one number"),  # type: ignore[arg-type]
        (lambda: solved().stress(0.0, 1.0, friction="0.1"), "friction is '0.1': give one number"),  # type: ignore[arg-type]
        (lambda: lc.Ellipse.circle("10", (-1.0, 1.0)), "radius is '10': give one number"),  # type: ignore[arg-type]
        (lambda: lc.Ellipse.circle((-1.0, 1.0), 10.0), r"radius is \(-1.0, 1.0\): give one number"),  # type: ignore[arg-type]
        (lambda: contact(kappa=None, contact_modulus=np.array([1.0, 2.0])), r"contact_modulus is array\(\[1., 2.\]\)"),
        (lambda: contact().solve(load=10**400), "load is too large for a float: give one number"),
        (lambda: lc.Pose("a", 0, 0), "x is 'a': give one number"),  # type: ignore[arg-type]
        (lambda: layered(1.0).solve(load=100.0).max_shear(), "give body='lower' or body='upper'"),
        (lambda: solved(period=2.0, edges=(lc.Edge.fixed(-0.5), lc.Edge.free())), "with a period are free, .* is not free"),
        (lambda: roller(slices=-3), "in -3 slices: .* from 1 to"),
    ],
)
def test_arguments_are_named(call: Callable[[], Any], says: str) -> None:
    with pytest.raises((TypeError, ValueError, errors.LineContactError), match=says):
        call()
