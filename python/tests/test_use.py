"""User-defined curves, pickles, threads, signals, memory and pictures."""

from __future__ import annotations

import gc
import math
import os
import pickle
import re
import signal
import threading
import time
import xml.dom.minidom
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
from scenes import Array, example_four, example_three, gear

import linecontact as lc
from linecontact import _native, drawing, errors

FLAT = lc.Flat()
BODY = lc.Parabola(1.0, (-1.0, 1.0))
STEEL = lc.Material(210e3, 0.3)
TO = lc.References(0.0, lc.Reference.depth(30.0), lc.Reference.disc(10.0))


@dataclass(frozen=True)
class Circle:
    """A circle by its angle."""

    radius: float

    def __call__(self, k: Array) -> tuple[Array, ...]:
        s, c, radius = np.sin(k), np.cos(k), self.radius
        return radius * s, radius * (1.0 - c), radius * c, radius * s


def bumps(x: Array) -> tuple[Any, ...]:
    return x, x**4 - 2 * x**2, 1.0, 4 * x**3 - 4 * x


def bodies() -> list[lc.Body]:
    x = np.linspace(-1.0, 1.0, 41)
    points = np.column_stack([x, x**2 / 2])
    return [
        FLAT,
        BODY,
        lc.Line(0.1, (-1.0, 1.0)),
        lc.Ellipse(2.0, 1.0, (-1.0, 1.0)),
        lc.Ellipse.circle(-3.0, (-1.0, 1.0)),
        lc.Involute(50.0, 0.4, (0.0, 0.8)),
        lc.Crowning(0.01, 5.0, (-4.0, 4.0)),
        lc.Wedge((-0.1, 0.2), 1.0),
        lc.RoundedPunch(1.0, 0.5, 3.0),
        lc.Spline(points),
        lc.Spline(points, smooth=True, outliers=None),
        lc.Curve((-1.0, 1.0), Circle(10.0), "convex"),
        lc.Piecewise([lc.Line(-0.1, (-1.0, 0.0)), BODY.shifted(1.0, 0.0 - 0.5)], tolerance=1e-9),
    ]


def placed(body: lc.Body) -> lc.Body:
    return body.scaled(2.0).mirrored().flipped().rotated(0.01).shifted(0.3, -0.1)


# User-defined curves.


def test_a_curve_is_the_shape_that_it_draws() -> None:
    shape = lc.Ellipse.circle(10.0, (-1.0, 1.0))
    curve = lc.Curve((-1.0, 1.0), Circle(10.0), convexity="convex")
    one, other = (lc.solve(FLAT, body, contact_modulus=115e3, load=500.0) for body in (shape, curve))
    assert abs(one.a / other.a - 1.0) < 1e-14
    assert one.cost == other.cost
    # A placed or joined curve is evaluated in batches, too.
    for of in (shape.flipped(), lc.Piecewise([shape]).flipped()):
        assert math.isclose(lc.solve(of, FLAT, contact_modulus=115e3, load=500.0).a, one.a, rel_tol=1e-14)


def test_what_a_function_may_return() -> None:
    want = lc.solve(FLAT, BODY, kappa=1.0, load=0.02).a
    functions: list[Callable[[Array], Any]] = [
        lambda k: (k, k**2 / 2, 1.0, k),
        lambda k: [k, k**2 / 2, 1, k],
        lambda k: np.array([k, k**2 / 2, np.ones_like(k), k]),
        lambda k: np.array([k, k**2 / 2, np.ones_like(k), k], order="F"),
        lambda k: (k, (k**2 / 2).tolist(), np.float32(1.0), k),
    ]
    for function in functions:
        got = lc.solve(FLAT, lc.Curve((-1.0, 1.0), function), kappa=1.0, load=0.02).a
        assert math.isclose(got, want, rel_tol=1e-14)
    with pytest.raises(ValueError, match=r"returned dy of shape \(3,\) for 2 values of k"):
        lc.Curve((-1.0, 1.0), lambda k: (k, k, k, np.ones(3)))
    with pytest.raises(TypeError):
        lc.Curve((-1.0, 1.0), lambda k: math.sin(k))  # type: ignore[arg-type, return-value]


class Faulty:
    """A curve that raises from the third call on."""

    def __init__(self, error: BaseException) -> None:
        self.error, self.calls = error, 0

    def __call__(self, k: Array) -> tuple[Any, ...]:
        self.calls += 1
        if self.calls > 2:
            raise self.error
        return k, k**2 / 2, 1.0, k


@pytest.mark.parametrize("error", [RuntimeError("mine"), KeyboardInterrupt(), lc.SolveError("mine")])
def test_an_exception_comes_out_as_it_is(error: BaseException) -> None:
    body = Faulty(error)
    contact = lc.Contact(FLAT, lc.Curve((-1.0, 1.0), body), kappa=1.0)
    with pytest.raises(type(error)) as raised:
        contact.solve(load=0.02)
    assert raised.value is error
    # Python is not called again after an exception.
    assert body.calls == 3
    with pytest.raises(type(error)):
        lc.Solver().solve(contact, load=0.02)
    assert body.calls == 4
    # The exception does not affect the next solve.
    assert lc.solve(FLAT, BODY, kappa=1.0, load=0.02).is_checked


def test_a_certificate_has_values_and_tells_whether_it_is_proved() -> None:
    feet = lc.Curve((-2.0, 2.0), lambda k: (k, k**4 - 2 * k**2, np.ones_like(k), 4 * k**3 - 4 * k))
    certificate = lc.solve(FLAT, feet, kappa=1.0, load=0.5).certify()
    assert certificate.is_proved
    assert certificate.pressure is not None and certificate.pressure.value > 0.0
    # P is proportional to (L²/2 - 0.1 + x²) sqrt(L² - x²), at x = 0 less than zero by rounding.
    hollow = lc.Curve((-1.0, 1.0), lambda k: (k, k**4 / 4 - 0.05 * k**2, np.ones_like(k), k**3 - 0.1 * k))
    touches = lc.solve(FLAT, hollow, kappa=1.0, half_width=math.sqrt(0.2 - 2e-14), single_interval=True)
    certificate = touches.certify()
    assert not certificate.is_proved
    assert certificate.pressure is not None and certificate.pressure.value <= 0.0


def test_a_curve_may_solve_a_contact_itself() -> None:
    inner = lc.Contact(FLAT, BODY, kappa=1.0)

    def nested(k: Array) -> tuple[Any, ...]:
        with pytest.raises(lc.SolveError):
            inner.solve(load=10.0)
        return k, k**2 / 2, inner.solve(half_width=0.2).load / 0.02, k

    assert math.isclose(lc.solve(FLAT, lc.Curve((-1, 1), nested), kappa=1.0, load=0.02).a, 0.2)


def test_a_solver_that_is_solving_refuses_another() -> None:
    solver = lc.Solver()
    inner = lc.Contact(FLAT, BODY, kappa=1.0)

    def nested(k: Array) -> tuple[Any, ...]:
        if k.size > 2:
            solver.solve(inner, load=0.02)
        return k, k**2 / 2, 1.0, k

    with pytest.raises(RuntimeError, match="make another"):
        solver.solve(lc.Contact(FLAT, lc.Curve((-1, 1), nested), kappa=1.0), load=0.02)
    assert solver.solve(inner, load=0.02).is_checked


# Pickles, equality, names.


def test_without_a_modulus_it_is_said_so() -> None:
    assert "κ is 1" in str(lc.solve(FLAT, BODY, load=0.02))
    for given in ({"kappa": 1.0}, {"contact_modulus": 1.0}, {"materials": (STEEL, STEEL)}):
        assert "κ" not in str(lc.solve(FLAT, BODY, load=0.02, **given))


def test_a_repr_tells_doubts() -> None:
    def rough(k: Array) -> tuple[Array, ...]:
        return k, k * k / 2 - 1e-10 * np.cos(1e7 * k), np.ones_like(k), k + 1e-3 * np.sin(1e7 * k)

    noisy, scaleless = lc.solve(FLAT, lc.Curve((-1.0, 1.0), rough), kappa=1.0, load=0.02), lc.solve(FLAT, BODY, load=0.02)
    assert re.search("not checked, limits to 0.01? of the half-width, with warnings|not checked, limits to 0.00[1-9] ", repr(noisy))
    assert repr(scaleless).endswith("checked, with warnings: print it>")
    assert repr(lc.solve(FLAT, BODY, kappa=1.0, load=0.02)).endswith("load 0.02, checked>")


def test_a_burr_is_seen_at_a_resolution() -> None:
    def burred(k: Array) -> tuple[Array, ...]:
        s = (k - 0.25) / 2e-4
        rest = np.maximum(1.0 - s * s, 0.0)
        return k, k * k / 2 - 0.02 * rest**3, np.ones_like(k), k + 600.0 * s * rest**2

    body = lc.Curve((-1.0, 1.0), burred, "convex")
    contact = lc.Contact(FLAT, body, kappa=1.0, resolution=4e-4)
    assert "resolution=0.0004" in repr(contact)
    assert len(contact.solve(load=0.02).intervals) == 2
    assert len(lc.solve(FLAT, body, kappa=1.0, load=0.02).intervals) == 1


def test_bodies_repeat_with_a_period() -> None:
    height, period, a = 0.02, 1.3, 0.4
    sine = math.sin(math.pi * a / period) ** 2

    def waves(k: Array) -> tuple[Array, ...]:
        q = 2.0 * np.pi / period
        return k, height * (1.0 - np.cos(q * k)), np.ones_like(k), height * q * np.sin(q * k)

    # Westergaard's contact, over both ends of the description.
    contact = lc.Contact(FLAT, lc.Curve((0.0, period), waves), contact_modulus=1.0, period=period)
    assert "period=1.3" in repr(contact)
    solution = contact.solve(load=math.pi * height * sine)
    assert abs(solution.half_width / a - 1.0) < 1e-13
    assert abs(solution.intervals[0][1] - (period + a)) < 1e-13
    peak = 2.0 * math.pi * height / period * math.sqrt(sine)
    assert np.abs(solution.pressure(np.array([0.0, period, -period])) / peak - 1.0).max() < 1e-13
    assert solution.certify().is_proved
    inside = np.array([0.0, 0.1, period, -period, 2.0 * period - 0.1])
    assert not solution.gap(inside).any() and not solution.gap_slope(inside).any()
    with pytest.raises(lc.errors.CompleteContactError) as failed:
        contact.solve(load=0.07)
    assert abs(failed.value.complete - math.pi * height) < 1e-12
    with pytest.raises(lc.errors.NotPeriodicError):
        lc.solve(FLAT, BODY, contact_modulus=1.0, period=2.0, load=0.01)


def test_nothing_changes() -> None:
    roller = lc.Ellipse.circle(10.0, (-1.0, 1.0))
    contact = lc.Contact(FLAT, roller, kappa=1.0)
    solution = contact.solve(load=0.02)
    slip = lc.Contact(FLAT, BODY, contact_modulus=1.0).partial_slip(friction=0.4, force=0.03, load=0.1)
    for one, name in [
        (roller, "along"),
        (roller.shifted(1.0), "steps"),
        (roller, "anything"),
        (contact, "upper"),
        (contact, "kappa"),
    ]:
        with pytest.raises(AttributeError, match="make another"):
            setattr(one, name, 5.0)
        with pytest.raises(AttributeError):
            delattr(one, name)
    for found in (solution, slip):
        with pytest.raises(AttributeError):
            found.contact = contact  # type: ignore[misc]
    with pytest.raises(TypeError, match="no Body"):
        lc.Contact(FLAT, 1)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="plane"):
        lc.Contact(FLAT, BODY, contact_modulus=1.0, plane="stress")


@pytest.mark.parametrize("put", [lambda body: body, placed], ids=["as it is", "placed"])
@pytest.mark.parametrize("body", bodies(), ids=lambda body: type(body).__name__)
def test_bodies_pickle(body: lc.Body, put: Callable[[lc.Body], lc.Body]) -> None:
    if body is FLAT:
        k = np.linspace(-1.0, 1.0, 101)
    else:
        first, last = body.domain
        k = np.linspace(first, last, 101)
    body = put(body)
    again = pickle.loads(pickle.dumps(body))
    assert again == body and hash(again) == hash(body)
    assert repr(again) == repr(body)
    assert again.convexity == body.convexity and again.pieces == body.pieces
    for one, other in zip(again.at(k), body.at(k), strict=True):
        np.testing.assert_array_equal(one, other)
    body.check_derivatives()


def test_a_repr_makes_the_body_again() -> None:
    assert {type(body).__name__ for body in bodies()} == set(lc.bodies.__all__) - {"Body", "Placed"}
    for body in bodies():
        if isinstance(body, lc.Spline):
            assert "Spline(<41 points from x = -1 to 1>" in repr(body)
        if isinstance(body, lc.Spline | lc.Curve):
            continue
        for one in (body, placed(body)):
            assert eval(repr(one), vars(lc)) == one


def contacts() -> list[tuple[lc.Contact, dict[str, Any]]]:
    edges = (lc.Edge.fixed(-0.1), lc.Edge.free())
    roller = lc.Ellipse.circle(10.0, (-1.0, 1.0))
    steel = {"materials": (STEEL, lc.Material.rigid()), "plane": "stress"}
    return [
        (lc.Contact(FLAT, BODY, contact_modulus=1.0), {"load": 0.02}),
        (lc.Contact(FLAT, BODY, kappa=1.0, edges=edges), {"load": 0.02}),
        (lc.Contact(*example_three(), kappa=1.0), {"load": 95.0}),
        (lc.Contact(*example_four(), kappa=1.0), {"load": 20 / math.pi}),
        (lc.Contact(*gear(), tolerance=1e-9), {"half_width": 0.1}),
        (lc.Contact(FLAT, lc.Curve((-2, 2), bumps), contact_modulus=1.0), {"load": 1.0}),
        (lc.Contact(FLAT, roller, **steel), {"approach": 0.01, "references": TO}),  # type: ignore[arg-type]
        (lc.Contact(FLAT, roller, kappa=1.0, limit_search="brent"), {"peak_pressure": 0.01}),
        (lc.Contact(FLAT, BODY, quadrature=lc.Midpoint(64, 3, "even")), {"load": 0.02}),
        (lc.Contact(FLAT, BODY, kappa=1.0), {"load": 0.02, "centre_of_pressure": 0.05}),
    ]


@pytest.mark.parametrize("name", _native.searches())
def test_every_search_of_the_library_serves(name: str) -> None:
    for contact in (lc.Contact(FLAT, BODY, limit_search=name), lc.Contact(FLAT, BODY, inversion=name)):
        assert contact.solve(half_width=0.2).a == pytest.approx(0.2, rel=1e-14)


LAYERED = lc.Contact(FLAT, BODY, materials=(STEEL, lc.Layer(STEEL, 0.02, "bonded")))


@pytest.mark.parametrize(("contact", "control"), [*contacts(), (LAYERED, {"load": 100.0})])
def test_contacts_and_solutions_pickle(contact: lc.Contact, control: dict[str, Any]) -> None:
    solution = contact.solve(**control)
    again = pickle.loads(pickle.dumps(contact))
    assert again == contact and repr(again) == repr(contact)
    for other in (again.solve(**control), pickle.loads(pickle.dumps(solution))):
        assert (other.a, other.b, other.load, other.tilt) == (
            solution.a,
            solution.b,
            solution.load,
            solution.tilt,
        )
        x = np.linspace(*solution.hull, 64)[1:-1]
        np.testing.assert_array_equal(other.pressure(x), solution.pressure(x))
        assert other.cost == solution.cost


def test_a_layer_is_a_value() -> None:
    layer = lc.Layer((5.0, 0.48), 1, STEEL)
    assert layer == lc.Layer(lc.Material(5.0, 0.48), 1.0, STEEL) != layer._replace(base="bonded")
    assert isinstance(layer.material, lc.Material) and isinstance(layer.thickness, float)
    again = pickle.loads(pickle.dumps(layer))
    assert again == layer and type(again) is lc.Layer and eval(repr(layer), vars(lc)) == layer
    one, other = (lc.Contact(FLAT, BODY, materials=(lc.Layer(STEEL, h, STEEL), STEEL)) for h in (1.0, 2.0))
    assert one != other and hash(one) != hash(other) and repr(one) in repr([one])


def test_like_layers_are_one() -> None:
    one = lc.Layer((5.0, 0.48), 0.3, "frictionless")
    two = lc.Layer((5.0, 0.48), 0.1, one._replace(thickness=0.2))
    assert two == eval(repr(two), vars(lc)) == pickle.loads(pickle.dumps(two))
    found, exact = (lc.solve(FLAT, BODY, materials=(of, STEEL), load=0.1) for of in (two, one))
    assert math.isclose(found.a, exact.a, rel_tol=1e-13)
    with pytest.raises(errors.HalfPlanesOnlyError, match="several layers"):
        found.max_shear(body="lower")
    both = lc.Contact(FLAT, BODY, materials=(two, two))
    solution = both.solve(load=0.1)
    assert len(solution.plot().axes) == 2
    with pytest.raises(ValueError, match="several layers"):
        lc.explore(both, [0.1], "out.html")
    with pytest.raises(ValueError, match="give poisson_ratio"):
        solution.max_von_mises(body="lower")


def test_a_layer_like_its_base_is_none_and_a_thin_one_a_row_of_springs() -> None:
    half_plane = lc.solve(FLAT, BODY, materials=(STEEL, STEEL), load=100.0)
    layer = lc.solve(FLAT, BODY, materials=(lc.Layer(STEEL, 0.01, STEEL), STEEL), load=100.0)
    assert math.isclose(layer.a, half_plane.a, rel_tol=1e-14)
    # Johnson, 1985, Section 5.8: P = E (a² - x²)/(2 R h (1 - ν²)) on a rigid base without friction.
    rubber, h, load = lc.Material(5.0, 0.48), 0.002, 0.1
    thin = lc.Layer(rubber, h, "frictionless")
    solution = lc.solve(FLAT, BODY, materials=(thin, lc.Material.rigid()), load=load)
    a = (1.5 * load * h * (1 - 0.48**2) / 5.0) ** (1 / 3)
    assert math.isclose(solution.a, a, rel_tol=0.02)
    assert math.isclose(solution.peak().pressure, 0.75 * load / a, rel_tol=2e-5)


def test_the_stress_in_a_coating_and_in_its_base() -> None:
    h, hard = 0.003, lc.Material(400e3, 0.25)
    solution = lc.solve(FLAT, BODY, materials=(lc.Layer(hard, h, STEEL), STEEL), half_width=0.009)
    x = np.array([0.0, 0.004, 0.012])
    surface = solution.stress(x, 0.0, body="lower")
    np.testing.assert_allclose(surface.sigma_y[:2], -solution.pressure(x[:2]), rtol=1e-14)
    layer, base = (solution.stress(x, depth, body="lower") for depth in (h, np.nextafter(h, 1.0)))
    np.testing.assert_allclose(layer.sigma_y, base.sigma_y, rtol=1e-11)
    np.testing.assert_allclose(layer.tau_xy, base.tau_xy, atol=1e-13 * solution.peak().pressure)
    # Both are stretched alike along the interface.
    strains = [
        (1 + nu) / e * ((1 - nu) * side.sigma_x - nu * side.sigma_y)
        for (e, nu), side in ((hard, layer), (STEEL, base))
    ]
    np.testing.assert_allclose(strains[0], strains[1], rtol=1e-11)
    largest = [solution.max_shear(body="lower", depths=depths) for depths in ((0.0, h), (h, math.inf))]
    assert largest[0].depth <= h < largest[1].depth
    assert solution.max_shear(body="lower") == max(largest, key=lambda one: one.value)
    assert solution.max_von_mises(0.3, body="lower", depths=(h, 1.0)).value > largest[1].value
    assert solution.max_tension(body="lower").value > 0.0 == solution.max_tension(body="upper").value
    with pytest.raises(ValueError, match="'lower' or 'upper'"):
        solution.max_tension(body="left")  # type: ignore[arg-type]


def test_what_else_pickles() -> None:
    contact = lc.Contact(FLAT, BODY, materials=(STEEL, STEEL))
    slip = contact.partial_slip(friction=0.4, force=10.0, load=100.0)
    again = pickle.loads(pickle.dumps(slip))
    assert again.stick_zones == slip.stick_zones
    assert again.traction(0.01) == slip.traction(0.01)
    assert pickle.loads(pickle.dumps(slip.normal)).a == slip.normal.a
    table = lc.SpringTable(contact, TO, (1.0, 10.0), 1e-3)
    assert pickle.loads(pickle.dumps(table)).at(3e-4) == table.at(3e-4)
    summary = slip.normal.summary()
    assert pickle.loads(pickle.dumps(summary)) == summary
    solver = pickle.loads(pickle.dumps(lc.Solver()))
    assert solver.solve(contact, load=100.0).a == slip.normal.a


def test_a_lambda_cannot_be_pickled_and_says_so() -> None:
    body = lc.Curve((-1.0, 1.0), lambda k: (k, k**2 / 2, 1.0, k))
    with pytest.raises(TypeError, match="top of a module"):
        pickle.dumps(lc.Contact(FLAT, body))


# Threads, signals, memory.


def test_eight_threads_find_the_same() -> None:
    contact = lc.Contact(*example_three(), kappa=1.0)
    shape = lc.Contact(FLAT, lc.Ellipse.circle(10.0, (-1.0, 1.0)), kappa=1.0)
    x = np.linspace(-0.05, 0.05, 101)

    def one(_: int) -> list[bytes]:
        solutions = [scene.solve(load=0.01) for scene in (contact, shape) for _ in range(10)]
        return [solution.pressure(x * solution.a).tobytes() for solution in solutions]

    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(one, range(8)))
    assert all(other == found[0] for other in found)


def test_other_threads_go_on_meanwhile() -> None:
    solution = lc.solve(FLAT, BODY, kappa=1.0, load=0.02)
    ticks, done = 0, threading.Event()

    def count() -> None:
        nonlocal ticks
        while not done.is_set():
            ticks += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    began = time.perf_counter()
    while time.perf_counter() - began < 0.2:
        solution.max_shear()
    done.set()
    counter.join()
    assert ticks > 20


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no timers")
def test_a_signal_ends_what_takes_long() -> None:
    class Late(Exception):
        pass

    def late(*_: object) -> None:
        raise Late

    # Hundreds of contacts take ten seconds or more, and so do a million stresses.
    x = np.linspace(-1.0, 1.0, 10_000)
    rough = x**2 / 2 + 1e-4 * np.cumsum(np.random.default_rng(1).normal(size=x.size))
    body = lc.Spline(np.column_stack([x, rough]), outliers=None)
    solution = lc.solve(FLAT, BODY, kappa=1.0, load=0.02)
    many = np.full(1_000_000, 0.1)
    # The largest shear below many contacts takes seconds.
    x = np.linspace(-1.0, 1.0, 1000)
    y = x**2 / 2 + np.random.default_rng(3).normal(0.0, 6e-4, x.size)
    points = lc.Spline(np.column_stack([x, y]), outliers=None)
    measured = lc.solve(FLAT, points, kappa=1.0, load=0.02)
    assert len(measured.contacts()) > 30
    before = signal.signal(signal.SIGALRM, late)
    try:
        for work in (
            lambda: solution.stress(many, 0.1),
            measured.max_shear,
            lambda: lc.solve(FLAT, body, kappa=1.0, load=0.02),
        ):
            signal.setitimer(signal.ITIMER_REAL, 0.15)
            began = time.perf_counter()
            with pytest.raises(Late):
                work()
            assert time.perf_counter() - began < 5.0
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def resident() -> int:
    """Returns the resident memory of this process, in bytes."""
    with open("/proc/self/statm") as numbers:
        return int(numbers.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="no /proc")
def test_memory_stays_flat() -> None:
    function = Circle(10.0)
    x = np.linspace(-0.05, 0.05, 101)

    def solve(count: int) -> None:
        for i in range(count):
            body = lc.Curve((-1.0, 1.0), function) if i % 2 else lc.Ellipse.circle(10.0, (-1.0, 1.0))
            contact = lc.Contact(FLAT, body, kappa=1.0, tolerance=1e-9)
            contact.solve(load=0.01).pressure(x)
            if i % 10 == 0:
                with pytest.raises(lc.SolveError):
                    contact.solve(load=1e9)

    def sweep(count: int) -> None:
        contact = lc.Contact(FLAT, lc.Ellipse.circle(10.0, (-1.0, 1.0)), kappa=1.0)
        for _ in range(count // 1_000):
            lc.sweep(contact, load=np.linspace(0.01, 0.1, 1_000))

    solve(2_000)
    sweep(10_000)
    gc.collect()
    before = resident()
    solve(10_000)
    sweep(100_000)
    gc.collect()
    assert resident() - before < 2_000_000


# Displacements, and stresses by the materials.


def test_displacement() -> None:
    to = lc.References(0.1, lc.Reference.depth(30.0), lc.Reference.disc(10.0))
    solution = lc.solve(FLAT, BODY, materials=(STEEL, STEEL), half_width=0.1)
    found = solution.displacement([[0.1, 0.0], [3.0, -1e3]], to, body="lower")
    assert found.shape == (2, 2) and found[0, 0] == solution.displacement(0.1, to, body="lower")
    np.testing.assert_allclose(found[0, 0], solution.approach(to).lower, rtol=1e-13)
    opened = sum(solution.displacement(0.3, to, body=of) - solution.displacement(0.1, to, body=of) for of in ("lower", "upper"))
    np.testing.assert_allclose(opened, solution.gap(0.3) - (0.3**2 - 0.1**2) / 2, rtol=1e-9)
    with pytest.raises(ValueError, match="'lower' or 'upper'"):
        solution.displacement(0.1, to, body="both")  # type: ignore[call-overload]


def test_von_mises_takes_the_ratio_of_the_material() -> None:
    rubber = lc.Material(210.0, 0.49)
    both = lc.solve(FLAT, BODY, materials=(STEEL, rubber), half_width=0.1)
    assert both.max_von_mises() == both.max_von_mises(body="lower") == both.max_von_mises(0.3)
    assert both.max_von_mises(body="upper") == both.max_von_mises(0.49)
    thin = lc.Contact(FLAT, BODY, materials=(STEEL, rubber), plane="stress").solve(half_width=0.1)
    assert thin.max_von_mises() == thin.max_von_mises(0.0)
    coated = lc.solve(FLAT, BODY, materials=(lc.Layer(rubber, 0.1, STEEL), STEEL), half_width=0.1)
    assert coated.max_von_mises(body="lower", depths=(0.0, 0.1)) == coated.max_von_mises(
        0.49, body="lower", depths=(0.0, 0.1)
    )
    with pytest.raises(ValueError, match=r"0\.49, 0\.3: name body and depths"):
        coated.max_von_mises(body="lower")
    with pytest.raises(ValueError, match="give poisson_ratio"):
        lc.solve(FLAT, BODY, kappa=1.0, half_width=0.1).max_von_mises()
    slip = lc.Contact(FLAT, BODY, materials=(STEEL, STEEL)).partial_slip(friction=0.4, force=10.0, load=100.0)
    assert slip.max_von_mises(body="lower") == slip.max_von_mises(0.3, body="lower")


def test_complex_numbers_are_refused() -> None:
    solution = lc.solve(FLAT, BODY, kappa=1.0, load=0.01)
    for ask in (solution.pressure, solution.gap, solution.pressure_estimate, BODY.at, BODY.heights):
        with pytest.raises(TypeError, match="complex"):
            ask(np.array([0.1 + 0.2j]))
    with pytest.raises(TypeError, match="complex"):
        lc.Spline(np.array([[0.0, 1.0j], [1.0, 0.0], [2.0, 1.0], [3.0, 4.0]]))
    with pytest.raises(TypeError, match="complex"):
        lc.Curve((-1.0, 1.0), lambda k: (k, k**2 / 2 + 0.0j, 1.0, k))


def test_the_place_of_a_symmetric_peak_is_zero() -> None:
    """Places of largest values have half of the digits; what is below them is no place beside 0."""
    body = lc.Ellipse.circle(10.0, (-1.0, 1.0))
    for load in (100.0, 200.0, 300.0, 500.0, 700.0, 1000.0):
        solution = lc.solve(FLAT, body, contact_modulus=115e3, load=load)
        assert repr(solution.peak()).startswith("Peak(x=0.0, ")
        assert solution.contacts()[0].peak == solution.peak()
        assert solution.max_shear().x == 0.0 == solution.max_von_mises(0.3).x
    off = lc.solve(FLAT, body.shifted(0.1, 0.0), contact_modulus=115e3, load=500.0)
    assert math.isclose(off.peak().x, 0.1, abs_tol=1e-8) and off.peak().x != 0.1


# Pictures.


def test_pictures() -> None:
    for contact, control in contacts():
        solution = contact.solve(**control)
        picture = solution._repr_svg_()
        assert len(picture) < 3000
        xml.dom.minidom.parseString(picture)
        figure = solution.plot()
        bodies_, pressure, shear, *_ = figure.axes
        for axes in (bodies_, pressure):
            for line in axes.lines:
                drawn = np.asarray(line.get_ydata(), dtype=float)
                assert np.isfinite(drawn).sum() > 10
        assert shear.yaxis_inverted()


def test_pictures_are_those_of_pyplot(tmp_path: Path) -> None:
    from matplotlib import pyplot
    from matplotlib.figure import Figure

    pyplot.close("all")
    solution = lc.solve(FLAT, BODY, kappa=1.0, load=0.01)
    figure = solution.plot()
    assert pyplot.gcf() is figure and pyplot.get_fignums() == [figure.number]
    pyplot.savefig(tmp_path / "plot.png")
    assert np.ptp(pyplot.imread(tmp_path / "plot.png")) > 0.5
    # The next picture has a figure of its own, but for an empty one.
    assert lc.Contact(FLAT, BODY).solve(load=0.0).plot() is not figure and len(figure.axes) == 4
    empty = pyplot.figure(figsize=(3.0, 4.0))
    slip = solution.partial_slip(friction=0.4, force=0.001)
    assert slip.plot() is empty and len(empty.axes) == 4
    assert len(pyplot.get_fignums()) == 3
    own = Figure()
    assert solution.plot(figure=own) is own and len(own.axes) == 4 and len(pyplot.get_fignums()) == 3
    pyplot.close("all")


def test_the_shear_of_each_body_with_layers() -> None:
    figure = LAYERED.solve(load=100.0).plot(("mm", "MPa"))
    assert [axes.get_ylabel() for axes in figure.axes[2:]] == [
        "depth / mm",
        "depth / mm",
        "largest shear in lower body / MPa",
        "largest shear in upper body / MPa",
    ]
    # One scale for both.
    lower, upper = (axes.get_ylim() for axes in figure.axes[4:])
    assert lower == upper
    # Down to the rigid base.
    assert figure.axes[3].get_ylim()[0] == 0.02
    alone = lc.Contact(FLAT, BODY, materials=(lc.Material.rigid(), lc.Layer(STEEL, 0.02, STEEL)))
    assert len(alone.solve(load=100.0).plot().axes) == 4


def test_heights_of_a_place_that_is_met_at_once() -> None:
    # The other places take a further step, and zero is bounded from one side by zero.
    np.testing.assert_allclose(BODY.heights([0.0, 1e-150, -2e-150]), [0.0, 5e-301, 2e-300], rtol=1e-12)


def test_axes_show_units() -> None:
    figure = lc.solve(FLAT, BODY, kappa=1.0, load=0.01).plot(units=("mm", "MPa"))
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert labels == ["y before loading / mm", "pressure / MPa", "depth / mm", "largest shear / MPa"]
    assert figure.axes[2].get_xlabel() == "x / mm"
    for wrong in ("mm", ("mm",)):
        with pytest.raises(TypeError, match="names of the units"):
            lc.solve(FLAT, BODY, kappa=1.0, load=0.01).plot(units=wrong)


def test_titles_show_load_and_peak_with_units() -> None:
    solution = lc.solve(FLAT, BODY, kappa=1.0, load=0.01)
    first, second = solution.plot(units=("mm", "MPa", "N/mm")).axes[0].get_title().split("\n")
    assert first.startswith("contact [") and first.endswith(" mm")
    assert second.startswith("load 0.01 N/mm, largest pressure ") and " MPa at x = " in second and second.endswith(" mm")
    slip = lc.Contact(FLAT, BODY, kappa=1.0).partial_slip(friction=0.4, force=0.003, load=0.01)
    # Lengths and pressures make the unit of loads.
    for units, load in ((("mm", "MPa"), "N/mm"), (("mm", "GPa"), "GPa mm"), (("", ""), "")):
        words = f"\nload 0.01 {load}".rstrip() + ", largest"
        assert words in solution.plot(units=units).axes[0].get_title()
    assert "load 0.01 N/mm, force 0.003 N/mm\nlargest" in slip.plot(units=("mm", "MPa", "N/mm")).axes[0].get_title()
    waves = lc.Curve((-1.0, 1.0), lambda k: (k, -0.01 * np.cos(9 * np.pi * k), 1.0, 0.09 * np.pi * np.sin(9 * np.pi * k)))
    figure = lc.solve(FLAT, waves, kappa=1.0, load=0.001).plot(units=("mm", "MPa", "N/mm"))
    assert "9 contacts from -0.89" in figure.axes[0].get_title()
    figure.draw_without_rendering()
    assert 0.0 < figure.axes[0].title.get_window_extent().x0
    corners = lc.Edge.fixed(-1.0), lc.Edge.fixed(1.0)
    punch = lc.solve(FLAT, FLAT, kappa=1.0, edges=corners, load=0.3)
    assert punch.plot().axes[0].get_title().endswith("pressure infinite at x = -1, 1")
    assert punch.plot(("mm", "MPa")).axes[0].get_title().endswith("pressure infinite at x = -1, 1 mm")


def test_the_axis_of_pressure_is_cut_where_it_is_infinite() -> None:
    corners = lc.Edge.fixed(-1.0), lc.Edge.fixed(1.0)
    adhesive = lc.Edge.adhesive(1e-4), lc.Edge.adhesive(1e-4)
    scenes = [
        (lc.Contact(FLAT, FLAT, contact_modulus=1e5, edges=corners), 250.0, "infinite at x = -1, 1 mm"),
        (lc.Contact(FLAT, BODY, kappa=1.0, edges=(lc.Edge.fixed(-0.1), lc.Edge.free())), 0.02, "infinite at x = -0.1 mm"),
        (lc.Contact(FLAT, lc.Wedge((-0.1, 0.1), 9.0), contact_modulus=1.0), 0.3, "infinite at x = 0 mm"),
        (lc.Contact(FLAT, BODY, kappa=1.0, edges=adhesive), 0.02, "infinite at x = -0.244497, 0.244497 mm"),
    ]
    for contact, load, says in scenes:
        solution = contact.solve(load=load)
        _, pressure, _, bar = solution.plot(("mm", "MPa")).axes
        low, high = pressure.get_ylim()
        assert bar.get_ylim()[1] < 3.0 * solution.mean_pressure
        assert 1.5 * solution.mean_pressure < high < 4.0 * solution.mean_pressure
        assert -high <= low <= 0.0
        assert [text.get_text() for text in pressure.texts] == [says]
    slip = scenes[0][0].partial_slip(friction=2.0, force=-300.0, load=250.0)
    low, high = slip.plot(("mm", "MPa")).axes[1].get_ylim()
    assert 6.0 * 125.0 < high < 7.0 * 125.0 and -7.0 * 125.0 < low < -6.0 * 125.0
    assert not lc.solve(FLAT, BODY, kappa=1.0, load=0.01).plot().axes[1].texts


def test_measured_points_are_drawn() -> None:
    x = np.linspace(-1.0, 1.0, 201)
    spline = lc.Spline(np.column_stack([x, -(x**2) / 2]), smooth=True)
    upper = spline.flipped().shifted(0.3, 0.2)
    solution = lc.solve(FLAT, upper, kappa=1.0, load=0.01)
    bodies_ = solution.plot().axes[0]
    dots = next(line for line in bodies_.lines if line.get_label() == "measured")
    # The picture of the shear ends where its axes do.
    assert bodies_.get_xlim() == tuple(np.asarray(bodies_.lines[0].get_xdata())[[0, -1]])
    places, heights = (np.asarray(part, dtype=float) for part in dots.get_data())
    assert len(places) > 20 and np.all(np.abs(places - 0.3) < 1.0)
    np.testing.assert_allclose(heights, (places - 0.3) ** 2 / 2, atol=1e-9)
    turned = drawing.measured(spline.rotated(0.1).mirrored().scaled(2.0))
    assert turned is not None and drawing.measured(BODY) is None
    angle = np.pi - 0.1
    z = 2.0 * (x + 0.5j * x**2) * np.exp(1.0j * angle)
    np.testing.assert_allclose(turned, np.column_stack([z.real, z.imag]), atol=1e-12)


def test_a_picture_of_partial_slip() -> None:
    bumps = lc.Curve((-2.5, 2.5), lambda x: (x, x**4 - 2 * x**2, 1.0, 4 * x**3 - 4 * x))
    corners = lc.Edge.fixed(-1.0), lc.Edge.fixed(1.0)
    scenes = [
        (lc.Contact(FLAT, BODY, contact_modulus=1.0), 0.03, 0.1),
        (lc.Contact(FLAT, bumps, contact_modulus=1.0), -0.2, 0.5),
        (lc.Contact(FLAT, lc.Wedge((-0.1, 0.1), 9.0), contact_modulus=1.0), 0.05, 0.3),
        (lc.Contact(FLAT, FLAT, contact_modulus=1.0, edges=corners), 0.05, 0.3),
    ]
    for contact, force, load in scenes:
        slip = contact.partial_slip(friction=0.8, force=force, load=load)
        figure = slip.plot(units=("mm", "MPa"))
        _, pressure, shear, bar = figure.axes
        assert pressure.get_ylabel() == "pressure, traction / MPa"
        assert bar.get_ylabel() == "largest shear in lower body / MPa" and shear.yaxis_inverted()
        assert len(pressure.lines) == 3 * len(slip.normal.intervals)
        bottom, top = pressure.get_ylim()
        count = len(slip.normal.intervals)
        for limit, traction in zip(pressure.lines[count::2], pressure.lines[count + 1 :: 2], strict=True):
            x, drawn = (np.asarray(part, dtype=float) for part in traction.get_data())
            np.testing.assert_array_equal(drawn, slip.traction(x))
            most = np.asarray(limit.get_ydata(), dtype=float)
            assert np.all(np.abs(drawn) <= np.abs(most) * (1 + 1e-9) + 1e-12) and np.all(drawn * force >= -1e-12)
            assert bottom <= np.min(drawn) and np.max(drawn) <= top


def test_stresses_of_partial_slip() -> None:
    slip = lc.Contact(FLAT, BODY, contact_modulus=1.0).partial_slip(friction=0.4, force=0.03, load=0.1)
    back = slip.contact.partial_slip(friction=0.4, force=-0.03, load=0.1)
    peak, a = slip.normal.peak().pressure, slip.normal.a
    pairs: list[tuple[Literal["lower", "upper"], Literal["lower", "upper"], float]]
    pairs = [("lower", "upper", -1.0), ("upper", "lower", 1.0)]
    for body, other, sign in pairs:
        x, tension = slip.max_tension(body=body)
        assert math.isclose(tension, 0.8 * peak * 0.75**0.5, rel_tol=1e-12)  # 2 μ p₀ sqrt(Q/(μF))
        assert math.isclose(x, sign * a, rel_tol=1e-12)
        assert slip.stress(x, 0.0, body=body).sigma_x == tension
        for one, again in (
            (slip.max_shear(body=body), back.max_shear(body=other)),
            (slip.max_von_mises(0.3, body=body), back.max_von_mises(0.3, body=other)),
        ):
            assert one == again
        x, depth, value = slip.max_shear(body=body)
        assert math.isclose(slip.stress(x, depth, body=body).max_shear(), value, rel_tol=1e-7)
        x, depth, value = slip.max_von_mises(0.3, body=body)
        assert math.isclose(slip.stress(x, depth, body=body).von_mises(0.3), value, rel_tol=1e-7)
    for wrong in (lambda: slip.max_shear(body="middle"), lambda: slip.max_tension(body="")):  # type: ignore[arg-type]
        with pytest.raises(ValueError, match="'lower' or 'upper'"):
            wrong()
    with pytest.raises(lc.errors.InvalidPoissonRatioError):
        slip.max_von_mises(0.6, body="lower")
    sliding = slip.normal.max_tension(friction=0.4)
    assert math.isclose(sliding.value, 0.8 * peak, rel_tol=1e-12) and sliding.x == -slip.normal.b
    assert slip.normal.max_tension().value == 0.0


def test_bodies_that_repeat_are_drawn_all_over_the_picture() -> None:
    def wave(x: Array) -> tuple[Any, ...]:
        return x, 0.01 * (1 - np.cos(2 * np.pi * x)), 1.0, 0.02 * np.pi * np.sin(2 * np.pi * x)

    contact = lc.Contact(FLAT, lc.Curve((0, 1), wave), contact_modulus=1e3, period=1.0)
    for load in (5.0, 20.0):
        solution = contact.solve(load=load)
        (on,) = solution.intervals
        assert on.left < 0.95 and on.right > 1.05
        bodies_, pressure, shear, _ = solution.plot().axes
        assert bodies_.get_title().splitlines()[0].endswith("], period 1")
        x, upper = (np.asarray(part, dtype=float) for part in bodies_.lines[0].get_data())
        np.testing.assert_allclose(upper, wave(x)[1], atol=1e-12)
        assert x[0] < on.left - 0.1 and on.right + 0.1 < x[-1] and math.isclose(x[-1] - x[0], 1.0)
        # The next contacts are not in the picture.
        assert on.right - 1.0 < x[0] and x[-1] < on.left + 1.0
        assert shear.get_xlim()[0] <= x[0] and x[-1] <= shear.get_xlim()[1]
    apart = contact.solve(load=0.0).plot().axes[0].lines[0]
    x, upper = (np.asarray(part, dtype=float) for part in apart.get_data())
    assert np.all(np.isfinite(upper)) and math.isclose(np.ptp(x), 1.0)


def test_measured_points_that_repeat_are_drawn_about_the_contact() -> None:
    x = np.linspace(-0.5, 0.5, 201)
    points = np.column_stack([x, np.where(np.abs(x) < 0.4, -0.01 * (1 + np.cos(2.5 * np.pi * x)), 0.0)])
    solution = lc.Contact(FLAT, lc.Spline(points), contact_modulus=1e3, period=1.0).solve(load=1.0)
    bodies_ = solution.plot().axes[0]
    dots = next(line for line in bodies_.lines if line.get_label() == "measured")
    drawn, heights = (np.asarray(part, dtype=float) for part in dots.get_data())
    # It is beyond the end of the points as given.
    assert solution.hull.left > 0.9 and np.min(drawn) < solution.hull.left and solution.hull.right < np.max(drawn)
    at = np.argsort(drawn)
    x, upper = (np.asarray(part, dtype=float) for part in bodies_.lines[0].get_data())
    # Points are drawn as far as the bodies are; beyond the first and the last there is none to compare.
    among = (x >= np.min(drawn)) & (x <= np.max(drawn))
    assert np.sum(among) > 380
    np.testing.assert_allclose(np.interp(x, drawn[at], heights[at])[among], upper[among], atol=3e-5)


def test_drawn_bodies_just_touch() -> None:
    roller = lc.Ellipse.circle(10.0, (-1.0, 1.0)).shifted(0.0, 5.0)
    figure = lc.solve(lc.Line(0.0, (-3, 3)).rotated(0.0), roller, kappa=1.0, load=0.01).plot()
    upper, lower = (np.asarray(line.get_ydata()) for line in figure.axes[0].lines[:2])
    assert math.isclose(np.min(upper - lower), 0.0, abs_tol=1e-12)


def test_measured_points_of_a_period() -> None:
    random, x = np.random.RandomState(3), np.linspace(0.0, 1.3, 200, endpoint=False)
    points = np.column_stack([x, 0.02 * (1 - np.cos(2 * np.pi * x / 1.3)) + 1e-6 * random.normal(size=x.size)])
    for smooth in (False, True):
        body = lc.Spline(points, smooth=smooth, period=1.3)
        solution = lc.solve(FLAT, body, contact_modulus=1.0, period=1.3, load=0.01)
        # Westergaard's contact.
        assert math.isclose(solution.load, math.pi * 0.02 * math.sin(math.pi * solution.half_width / 1.3) ** 2, rel_tol=1e-3)
        assert body == pickle.loads(pickle.dumps(body)) != lc.Spline(points, smooth=smooth) and "period=1.3" in repr(body)
    with pytest.raises(lc.errors.NotPeriodicError, match=r"of points give Spline\(points, period=...\)"):
        lc.solve(FLAT, lc.Spline(points), contact_modulus=1.0, period=float(x[-1]), load=0.01)
    with pytest.raises(lc.errors.SplinePeriodError, match="must end behind the last one"):
        lc.Spline(points, period=float(x[-1]))
    with pytest.raises(lc.errors.SplinePeriodError, match="give all of a period"):
        lc.Spline(points, period=2.6)
    with pytest.raises(lc.errors.SplineOutlierError, match="level the points"):
        lc.Spline(points + 1e-2 * points[:, :1] * [0, 1], period=1.3)
    periodic = lc.solve(FLAT, body, contact_modulus=1.0, period=1.3, load=0.01)
    with pytest.raises(lc.errors.HalfPlanesOnlyError, match="a layer, a period or"):
        periodic.uncertainty()
    for count in (-1, 1, 10**9, 3.0):
        with pytest.raises(ValueError, match=r"count is .*: give a whole number from 2 to 1048576"):
            periodic.sample(count)  # type: ignore[arg-type]


def test_what_is_infinite_is_infinite_everywhere() -> None:
    flat = lc.Flat()
    punch = lc.Contact(flat, flat, kappa=1.0, edges=(lc.Edge.fixed(-1.0), lc.Edge.fixed(1.0)))
    solution = punch.solve(load=0.3)
    at_corner = lc.Peak(1.0, math.inf, 0.0)
    assert solution.peak() == solution.contacts()[0].peak == solution.summary().peak == at_corner
    np.testing.assert_allclose(solution.pressure([-1.0, 0.0, 1.0]), [math.inf, 0.3 / math.pi, math.inf], rtol=1e-14)
    values, errors = solution.pressure_estimate([-1.0, 2.0])
    assert values.tolist() == [math.inf, 0.0] and errors.tolist() == [0.0, 0.0]
    assert solution.max_shear() == solution.max_von_mises(0.3) == (1.0, 0.0, math.inf)
    slip = punch.partial_slip(friction=0.3, force=0.01, load=0.3)
    assert math.isinf(slip.max_tension(body="lower").value) and math.isinf(slip.max_shear(body="lower").value)
    # At the tip of a wedge, inside; pulled apart by adhesion, the ends have infinite tension.
    wedge = lc.solve(flat, lc.Wedge((-0.1, 0.1), 1.0), kappa=1.0, load=0.02)
    assert wedge.peak() == wedge.contacts()[0].peak == lc.Peak(0.0, math.inf, 0.0) and math.isinf(wedge.pressure(0.0))
    glued = lc.Contact(flat, lc.Parabola(1.0, (-1.0, 1.0)), contact_modulus=1.0, edges=(lc.Edge.adhesive(1e-3),) * 2).solve(load=0.02)
    assert glued.pressure([-glued.b, glued.a]).tolist() == [-math.inf, -math.inf] and math.isfinite(glued.peak().pressure)
    # At an end that just begins to press, the strength is rounding, and tells no sign.
    fixed = (lc.Edge.fixed(-0.2), lc.Edge.fixed(0.2))
    light = lc.Contact(flat, lc.Parabola(1.0, (-1.0, 1.0)), kappa=1.0, edges=fixed).solve(load=0.02)
    with pytest.raises(lc.errors.SingularError):
        light.pressure([0.0, 0.2])
