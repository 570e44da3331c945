"""Sweeps: equal to single solves, on any number of threads, with errors row by row."""

from __future__ import annotations

import math
import multiprocessing
import os
import pickle
import signal
import sys
import threading
import time
from typing import Any, Literal

import numpy as np
import pytest
from scenes import Array, example_three

import linecontact as lc
from linecontact import _native

FLAT = lc.Flat()
STEEL = lc.Material(210e3, 0.3)
TO = lc.References(0.0, lc.Reference.depth(30.0), lc.Reference.disc(10.0))
ROLLER = lc.Contact(FLAT, lc.Ellipse.circle(10.0, (-1.0, 1.0)), materials=(STEEL, STEEL))
LOADS = np.geomspace(1.0, 1000.0, 100)


def parabola(x: Array) -> tuple[Any, ...]:
    return x, x**2 / 2, 1.0, x


def of_one(solution: lc.Solution) -> dict[str, float]:
    """Returns all quantities, each by its own method."""
    hull, peak, shear = solution.hull, solution.peak(), solution.max_shear()
    return {
        "load": solution.load,
        "a": solution.a,
        "b": solution.b,
        "half_width": hull.half_width,
        "centre": hull.centre,
        "tilt": solution.tilt,
        "mean_pressure": solution.mean_pressure,
        "peak_pressure": peak.pressure,
        "peak_x": peak.x,
        "peak_error": peak.error,
        "moment": solution.moment,
        "centre_of_pressure": solution.centre_of_pressure,
        "max_shear": shear.value,
        "max_shear_x": shear.x,
        "max_shear_depth": shear.depth,
        "approach": solution.approach(TO).bodies,
        "stiffness": solution.stiffness(TO),
        "contacts": len(solution.intervals),
        "is_checked": solution.is_checked,
    }


def test_the_same_as_one_by_one() -> None:
    tilted = lc.Contact(FLAT, lc.Ellipse(5.0, 3.0, (-1.0, 1.0)).rotated(0.05), materials=(STEEL, STEEL))
    rounded = lc.Contact(FLAT, lc.RoundedPunch(0.5, 3.0, 4.0), materials=(STEEL, STEEL))
    contacts, loads = [ROLLER, rounded, tilted], [100.0, 300.0, 50.0]
    names = _native.quantities()
    found = lc.sweep(contacts, load=loads, quantities=names, references=TO)
    assert set(found) == {*names, "error"} and not found.errors
    for row, (contact, load) in enumerate(zip(contacts, loads, strict=True)):
        solution = contact.solve(load=load)
        size = solution.half_width
        for name, want in of_one(solution).items():
            off = {"rel_tol": 1e-12, "abs_tol": 0.0}
            if name in ("peak_x", "max_shear_x", "max_shear_depth"):
                # A maximum is flat: its place has half the digits.
                off["abs_tol"] = 1e-6 * size
            elif name in ("centre", "centre_of_pressure", "moment"):
                off["abs_tol"] = 1e-13 * size * (load if name == "moment" else 1.0)
            assert math.isclose(found[name][row], want, **off), (name, row)
        assert found["limits_error"][row] < 1e-13
    assert found["evaluations"][0] > 0
    kinds = {name: found[name].dtype.kind for name in found}
    assert {name for name, kind in kinds.items() if kind != "f"} == {
        "contacts",
        "evaluations",
        "is_checked",
        "error",
    }


@pytest.mark.parametrize(
    ("prescribed", "back"),
    [
        ({"half_width": np.linspace(0.05, 0.3, 40)}, "half_width"),
        ({"peak_pressure": np.linspace(100.0, 900.0, 40)}, "peak_pressure"),
        ({"approach": np.linspace(1e-4, 1e-2, 40), "references": TO}, "approach"),
        ({"load": 100.0, "moment": np.linspace(-50.0, 50.0, 40)}, "moment"),
        ({"load": 100.0, "moment": np.linspace(-50.0, 50.0, 40), "about": 0.0}, "moment"),
        ({"load": np.linspace(10.0, 100.0, 40), "centre_of_pressure": 0.1}, "centre_of_pressure"),
    ],
)
def test_what_is_prescribed_comes_back(prescribed: dict[str, Any], back: str) -> None:
    names = ["load", "centre_of_pressure", "moment", "half_width", "peak_pressure"]
    if "references" in prescribed:
        names.append("approach")
    found = lc.sweep(ROLLER, quantities=names, **prescribed)
    assert not found.errors
    want = prescribed[back]
    np.testing.assert_allclose(found[back], np.broadcast_to(want, 40), rtol=1e-11, atol=1e-11)
    np.testing.assert_allclose(found["moment"], found["load"] * found["centre_of_pressure"], atol=1e-9)


def test_threads_do_not_change_a_bit() -> None:
    curve = lc.Contact(FLAT, lc.Curve((-1.0, 1.0), parabola), kappa=1e4)
    for contact in (ROLLER, curve):
        found = [lc.sweep(contact, load=LOADS, threads=count) for count in (1, 2, 7)]
        for other in found[1:]:
            for name in ("load", "a", "b", "peak_pressure"):
                np.testing.assert_array_equal(other[name], found[0][name])


def test_a_row_fails_alone() -> None:
    loads = LOADS.copy()
    loads[[3, 50]] = [-1.0, math.nan]
    loads[99] = 1e9
    found = lc.sweep(ROLLER, load=loads, quantities=["a", "contacts", "is_checked"])
    assert list(found.errors) == [3, 50, 99]
    assert isinstance(found.errors[3], lc.errors.InvalidLoadError) and found.errors[3].value == -1.0
    assert isinstance(found.errors[99], lc.errors.DomainTooShortError)
    assert list(found["error"][[3, 50, 98, 99]]) == [
        "InvalidLoadError",
        "InvalidLoadError",
        "",
        "DomainTooShortError",
    ]
    assert np.flatnonzero(np.isnan(found["a"])).tolist() == [3, 50, 99]
    assert not found["is_checked"][3] and found["contacts"][3] == 0
    again = pickle.loads(pickle.dumps(found))
    assert again.errors[3].value == -1.0 and repr(again) == repr(found)
    np.testing.assert_array_equal(again["a"], found["a"])


def test_a_number_that_is_not_to_be_had_leaves_the_others() -> None:
    punch = lc.Contact(FLAT, FLAT, kappa=1.0, edges=(lc.Edge.fixed(-1.0), lc.Edge.fixed(1.0)))
    names = ["peak_x", "peak_pressure", "max_shear", "max_shear_depth", "mean_pressure"]
    found = lc.sweep(punch, load=[0.3], quantities=[*names, "peak_pressure_deviation"])
    assert [found[name][0] for name in names[:4]] == [1.0, math.inf, math.inf, 0.0]
    # What is infinite at a corner is not a failure; a deviation that no one knows is.
    assert math.isclose(found["mean_pressure"][0], 0.15) and math.isnan(found["peak_pressure_deviation"][0])
    assert found["error"][0] == "SingularError"
    assert not lc.sweep(punch, load=[0.3], quantities=names).errors


class Fails:
    """A parabola that raises for places beyond `x`."""

    def __init__(self, beyond: float) -> None:
        self.beyond = beyond

    def __call__(self, x: Array) -> tuple[Any, ...]:
        if np.any((np.abs(x) > self.beyond) & (np.abs(x) < 1.0)):
            raise RuntimeError("mine")
        return x, x**2 / 2, 1.0, x


def test_the_shear_of_a_body_with_a_layer() -> None:
    steel = lc.Material(210e3, 0.3)
    contact = lc.Contact(lc.Flat(), lc.Parabola(1.0, (-1.0, 1.0)), materials=(lc.Layer(steel, 0.02, "bonded"), steel))
    sides: list[Literal["lower", "upper"]] = ["lower", "upper"]
    for body in sides:
        found = lc.sweep(contact, quantities="max_shear", body=body, load=[50.0, 100.0])
        for load, value in zip((50.0, 100.0), found["max_shear"], strict=True):
            want = contact.solve(load=load).max_shear(body=body).value
            assert math.isclose(value, want, rel_tol=1e-10)
            (one, slope) = lc.gradient(contact, "max_shear", "load", body=body, load=load)
            assert math.isclose(one, want, rel_tol=1e-12) and slope > 0.0
    assert lc.sweep(contact, quantities="max_shear", load=50.0)["error"] == ["HalfPlanesOnlyError"]
    with pytest.raises(ValueError, match="'lower' or 'upper'"):
        lc.sweep(contact, body="both", load=50.0)  # type: ignore[arg-type]


def test_an_exception_of_a_function_is_that_of_its_row() -> None:
    contacts = [
        lc.Contact(FLAT, lc.Curve((-1.0, 1.0), function), kappa=1.0)
        for function in (parabola, Fails(0.0), parabola)
    ]
    found = lc.sweep(contacts, load=0.02)
    assert list(found.errors) == [1] and str(found.errors[1]) == "mine"
    assert found["error"][1] == "RuntimeError"
    np.testing.assert_allclose(found["a"][[0, 2]], 0.2, rtol=1e-14)


class Ends:
    """Curve that raises an exception which ends the whole sweep."""

    def __init__(self, error: BaseException) -> None:
        self.error = error

    def __call__(self, x: Array) -> tuple[Any, ...]:
        if x.size > 2:
            raise self.error
        return x, x**2 / 2, 1.0, x


@pytest.mark.parametrize("error", [KeyboardInterrupt(), SystemExit(3)])
def test_what_means_to_end_all_ends_it(error: BaseException) -> None:
    contacts = [lc.Contact(FLAT, lc.Curve((-1.0, 1.0), parabola), kappa=1.0) for _ in range(100)]
    contacts[7] = lc.Contact(FLAT, lc.Curve((-1.0, 1.0), Ends(error)), kappa=1.0)
    with pytest.raises(type(error)) as raised:
        lc.sweep(contacts, load=0.02)
    assert raised.value is error


def test_rows() -> None:
    assert lc.sweep(ROLLER, load=5.0)["a"].shape == (1,)
    assert lc.sweep([ROLLER] * 3, load=5.0)["a"].shape == (3,)
    assert lc.sweep([], load=5.0)["a"].shape == (0,)
    assert lc.sweep(ROLLER, load=[])["error"].shape == (0,)
    assert lc.sweep(ROLLER, load=[5, 6], quantities=[]).keys() == {"error"}
    with pytest.raises(ValueError, match=r"\[2, 3\] rows"):
        lc.sweep([ROLLER] * 3, load=[1.0, 2.0])
    with pytest.raises(ValueError, match="shape"):
        lc.sweep(ROLLER, load=[[1.0, 2.0]])
    with pytest.raises(ValueError, match='no quantity "A"'):
        lc.sweep(ROLLER, load=1.0, quantities=["A"])
    with pytest.raises(TypeError, match="prescribed are"):
        lc.sweep(ROLLER)
    with pytest.raises(TypeError, match="prescribed are"):
        lc.sweep(ROLLER, approach=1.0)
    with pytest.raises(TypeError, match="between references"):
        lc.sweep(ROLLER, load=1.0, quantities=["stiffness"])
    assert list(lc.sweep(ROLLER, load=1.0, quantities="half_width", threads=10**9)) == ["half_width", "error"]
    with pytest.raises(TypeError, match="no Contact"):
        lc.sweep([ROLLER, FLAT], load=1.0)  # type: ignore[list-item]
    with pytest.raises(ValueError, match="threads"):
        lc.sweep(ROLLER, load=1.0, threads=0)


def test_the_docstring_names_all_quantities() -> None:
    for name in _native.quantities():
        assert f'"{name}"' in (lc.sweep.__doc__ or ""), name


def test_progress() -> None:
    told: list[tuple[int, int]] = []
    lc.sweep(ROLLER, load=LOADS, progress=lambda done, of: told.append((done, of)))
    assert told[-1] == (100, 100) and told == sorted(told)

    def fails(done: int, of: int) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        lc.sweep(ROLLER, load=LOADS, progress=fails)


def test_a_bar(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tqdm")
    lc.sweep(ROLLER, load=LOADS, progress=True)
    assert "100/100" in capsys.readouterr().err


def test_pandas() -> None:
    pytest.importorskip("pandas")
    frame = lc.sweep(ROLLER, load=[100.0, -1.0]).to_pandas()
    assert list(frame.columns) == ["load", "a", "b", "peak_pressure", "error"]
    assert frame["error"].tolist() == ["", "InvalidLoadError"] and frame["a"].isna().tolist() == [False, True]
    assert frame["load"].tolist() == [100.0, -1.0]


def test_frames_have_columns_of_parameters() -> None:
    pytest.importorskip("pandas")
    found = lc.sweep(ROLLER, load=[100.0, 200.0], quantities=("a",))
    frame = found.to_pandas(radius=10.0, name=["light", "heavy"])
    assert list(frame.columns) == ["radius", "name", "a", "error"]
    assert frame["radius"].tolist() == [10.0, 10.0] and frame["name"].tolist() == ["light", "heavy"]
    with pytest.raises(ValueError, match="shape"):
        found.to_pandas(radius=[1.0, 2.0, 3.0])


def test_a_failed_row_keeps_what_was_prescribed() -> None:
    found = lc.sweep(ROLLER, half_width=[0.1, 99.0], quantities=("half_width", "load"))
    assert found["error"].tolist() == ["", "HalfWidthTooLargeError"]
    assert found["half_width"][1] == 99.0 and math.isnan(found["load"][1])


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no timers")
@pytest.mark.parametrize("body", [lc.Ellipse.circle(10.0, (-1.0, 1.0)), lc.Curve((-1.0, 1.0), parabola)])
def test_a_signal_ends_it(body: lc.Body) -> None:
    class Late(Exception):
        pass

    def late(*_: object) -> None:
        raise Late

    contact = lc.Contact(FLAT, body, kappa=1e5)
    before = signal.signal(signal.SIGALRM, late)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.15)
        began = time.perf_counter()
        with pytest.raises(Late):
            # The largest shears would take minutes.
            lc.sweep(contact, load=np.full(10_000, 100.0), quantities=["max_shear"])
        assert time.perf_counter() - began < 5.0
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_sweeps_from_many_threads() -> None:
    want = lc.sweep(ROLLER, load=LOADS)["a"]
    curve = lc.Contact(*example_three(), kappa=1.0)
    found: list[Array] = []

    def one() -> None:
        lc.sweep(curve, load=[0.01, 0.02])
        found.append(lc.sweep(ROLLER, load=LOADS)["a"])

    threads = [threading.Thread(target=one) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60.0)
    assert len(found) == 8
    for other in found:
        np.testing.assert_array_equal(other, want)


def nested(x: Array) -> tuple[Any, ...]:
    a = lc.sweep(lc.Contact(FLAT, lc.Parabola(1.0, (-1, 1)), kappa=1.0), load=[0.02, 0.08])["a"]
    return x, x**2 / 2 * (a[1] / (2 * a[0])), 1.0, x


def test_a_curve_may_sweep_itself() -> None:
    contact = lc.Contact(FLAT, lc.Curve((-1.0, 1.0), nested), kappa=1.0)
    np.testing.assert_allclose(lc.sweep(contact, load=[0.02, 0.08])["a"], [0.2, 0.4])


def in_a_fork(pipe: Any) -> None:
    pipe.send(lc.sweep(ROLLER, load=LOADS, threads=2)["a"])


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_fork_does_not_wait_for_threads_that_it_has_not() -> None:
    want = lc.sweep(ROLLER, load=LOADS, threads=2)["a"]
    here, there = multiprocessing.Pipe()
    child = multiprocessing.get_context("fork").Process(target=in_a_fork, args=(there,))
    child.start()
    assert here.poll(60.0)
    np.testing.assert_array_equal(here.recv(), want)
    child.join()


def test_the_interpreter_may_be_without_a_lock() -> None:
    without = not getattr(sys, "_is_gil_enabled", lambda: True)()
    # A build without a lock keeps it off: the extension declares that it needs none.
    assert without == bool(__import__("sysconfig").get_config_var("Py_GIL_DISABLED"))
