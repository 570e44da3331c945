"""The reference scenes of the Rust tests, built with this package: shapes, or else functions."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

import linecontact as lc

Array = npt.NDArray[np.float64]
DATA = Path(__file__).parents[2] / "tests" / "data"


class Reference(NamedTuple):
    """A reference file in `tests/data`."""

    a: float
    b: float
    load: float
    kappa: float
    points: Array
    amplification: Array


def reference(name: str) -> Reference:
    file: dict[str, Any] = json.loads((DATA / f"{name}.json").read_text())
    numbers = [[float(x), float(pressure)] for x, pressure in file.get("points", [])]
    return Reference(
        float(file["a"]),
        float(file["b"]),
        float(file["C"]) / math.pi,
        float(file.get("scale_value", 1.0)),
        np.array(numbers).reshape(-1, 2),
        np.array([float(one) for one in file.get("points_amplification", [])]),
    )


# Curves of the paper, Eqs. (30) to (38), as in examples/paper/curves.rs.


def two_lower(k: Array) -> tuple[Any, ...]:
    return 2.0 * k + 0.2, -36.0 * k * k, 2.0, -72.0 * k


def two_upper(k: Array) -> tuple[Any, ...]:
    return 3.0 * k + 0.2, 63.0 * k * k, 3.0, 126.0 * k


def three_lower(k: Array) -> tuple[Any, ...]:
    s, c = np.sin(k), np.cos(k)
    return (
        2.0 * c - 8.0 * k * c - 9.0 * s + 7.0 * k * s - 2.0,
        (15.0 * s + 9.0 * c - 15.0 * k * c - 6.0 * k * s - 9.0) * 1e5,
        -17.0 * c + 5.0 * s + 8.0 * k * s + 7.0 * k * c,
        (-15.0 * s + 15.0 * k * s - 6.0 * k * c) * 1e5,
    )


def three_upper(k: Array) -> tuple[Any, ...]:
    s, c = np.sin(k), np.cos(k)
    return (
        7.0 * s - 8.0 * c + 3.0 * k * c - 9.0 * k * s + 8.0,
        (35.0 * k * c - 35.0 * s - 30.0 * c + 10.0 * k * s + 30.0) * 1e5,
        10.0 * c - s - 3.0 * k * s - 9.0 * k * c,
        (40.0 * s - 35.0 * k * s + 10.0 * k * c) * 1e5,
    )


def four_left(k: Array) -> tuple[Any, ...]:
    s, c = np.sin(k), np.cos(k)
    return (
        12.0 * c - 2.0 * s - 3.0 * k * c + 2.0 * k * s - 12.0,
        (7.11 * c + 0.63 * s - 0.63 * k * c - 7.83 * k * s - 7.11) * 1e6,
        -10.0 * s - 5.0 * c + 3.0 * k * s + 2.0 * k * c,
        (-14.94 * s + 0.63 * k * s - 7.83 * k * c) * 1e6,
    )


def four_right(k: Array) -> tuple[Any, ...]:
    s, c = np.sin(k), np.cos(k)
    return (
        6.0 * c - 5.0 * s - 3.0 * k * c + 9.0 * k * s - 6.0,
        (0.7 * k * s - 5600.0 * k * k - 3.5 * k * k * c) * 1e5,
        3.0 * s - 8.0 * c + 3.0 * k * s + 9.0 * k * c,
        (0.7 * s - 6.3 * k * c - 11200.0 * k + 3.5 * k * k * s) * 1e5,
    )


def four_upper(k: Array) -> tuple[Any, ...]:
    s, c = np.sin(k), np.cos(k)
    return (
        3.0 * s + 2.0 * k * c - k * s,
        (0.027 * k * c - 0.027 * s - 1.8 * c + 1.8) * 1e7,
        5.0 * c - s - 2.0 * k * s - k * c,
        (1.8 * s - 0.027 * k * s) * 1e7,
    )


def five_lower_left(k: Array) -> tuple[Any, ...]:
    s, c, t = np.sin(k), np.cos(k), np.tan(k)
    dt = 1.0 + t * t
    return (
        5.0 * k * k * t * t - 2.0 * t - 3.0 * k * c,
        (2.08 * s + 6.50 * c * c - 2.08 * k * c - 6.50) * 1e7,
        10.0 * k * t * t + 10.0 * k * k * t * dt - 2.0 * dt - 3.0 * c + 3.0 * k * s,
        (2.08 * k * s - 13.0 * s * c) * 1e7,
    )


def five_lower_right(k: Array) -> tuple[Any, ...]:
    s, c, t = np.sin(k), np.cos(k), np.tan(k)
    dt = 1.0 + t * t
    return (
        7.0 * c - 2.0 * t - 5.0 * k * c + 6.0 * k * t - 7.0,
        33600.0 * k * t - 33600000.0 * t * t + 53200.0 * k * k * c,
        -7.0 * s - 2.0 * dt - 5.0 * c + 5.0 * k * s + 6.0 * t + 6.0 * k * dt,
        33600.0 * (t + k * dt) - 67200000.0 * t * dt + 106400.0 * k * c - 53200.0 * k * k * s,
    )


def five_upper_left(k: Array) -> tuple[Any, ...]:
    s, c, t = np.sin(k), np.cos(k), np.tan(k)
    dt = 1.0 + t * t
    return (
        2.0 * c * c - 3.0 * t + 10.0 * k * k * t * t - 5.0 * k * c - 2.0,
        9e6 * t * t * t - 200.0 * k * t * t - 300.0 * k * k * c,
        -4.0 * s * c - 3.0 * dt + 20.0 * k * t * t + 20.0 * k * k * t * dt - 5.0 * c + 5.0 * k * s,
        2.7e7 * t * t * dt - 200.0 * t * t - 400.0 * k * t * dt - 600.0 * k * c + 300.0 * k * k * s,
    )


def five_upper_right(k: Array) -> tuple[Any, ...]:
    s, c, t = np.sin(k), np.cos(k), np.tan(k)
    dt = 1.0 + t * t
    return (
        6.0 * t + 5.0 * k * c - 7.0 * k * t,
        (8.5 * k * c - 8.5 * s - 7.5 * c + 7.5) * 1e5,
        6.0 * dt + 5.0 * c - 5.0 * k * s - 7.0 * t - 7.0 * k * dt,
        (7.5 * s - 8.5 * k * s) * 1e5,
    )


THREE_LOWER = (-1.353999702552852, 0.7911938540783813)
THREE_UPPER = (-1.428061671618955, 0.7623463067015128)


def example_two() -> tuple[lc.Body, lc.Body]:
    return lc.Curve((-2.0, 2.0), two_lower), lc.Curve((-2.0, 2.0), two_upper)


def example_three() -> tuple[lc.Body, lc.Body]:
    return lc.Curve(THREE_LOWER, three_lower), lc.Curve(THREE_UPPER, three_upper)


def example_four() -> tuple[lc.Body, lc.Body]:
    left = lc.Curve((0.0, 5.540299783323928), four_left)
    right = lc.Curve((-1.5010288405450835, 0.0), four_right)
    upper = lc.Curve((-1.317538157404613, 0.9495704265766943), four_upper)
    return lc.Piecewise([left, right]), upper


def example_five() -> tuple[lc.Body, lc.Body]:
    lower = [
        lc.Curve((0.0, 0.5445944427356815), five_lower_left),
        lc.Curve((-1.57, 0.0), five_lower_right),
    ]
    upper = [
        lc.Curve((0.0, 0.5418316060488749), five_upper_left),
        lc.Curve((0.0, 0.6113196849814056), five_upper_right),
    ]
    return lc.Piecewise(lower), lc.Piecewise(upper)


# Bodies above a flat.


class Power:
    """The curve |x|^n/n on one side."""

    def __init__(self, n: float) -> None:
        self.n = n

    def __call__(self, x: Array) -> tuple[Any, ...]:
        size = np.abs(x)
        return x, size**self.n / self.n, 1.0, np.sign(x) * size ** (self.n - 1.0)


def power(n: float) -> lc.Body:
    if n == 1.0:
        return lc.Wedge((-1.0, 1.0), 2.0)
    return lc.Piecewise([lc.Curve((-2.0, 0.0), Power(n)), lc.Curve((0.0, 2.0), Power(n))])


def sinh_parameter(k: Array) -> tuple[Any, ...]:
    size = np.sinh(40.0)
    x, dx = np.sinh(40.0 * k) / size, 40.0 * np.cosh(40.0 * k) / size
    return x, np.cosh(3.0 * x) - 1.0, dx, 3.0 * np.sinh(3.0 * x) * dx


def cubic_parameter(k: Array) -> tuple[Any, ...]:
    eps = 1.0 / 1073741824.0
    x, dx = k * k * k + eps * k, 3.0 * k * k + eps
    return x, x * x / 2.0, dx, x * dx


def wavy(x: Array) -> tuple[Any, ...]:
    return x, x * x / 2.0 + np.cos(16.0 * x) / 1024.0, 1.0, x - np.sin(16.0 * x) / 64.0


def off_centre(x: Array) -> tuple[Any, ...]:
    return x, (x - 134217728.0) ** 2 / 2.0, 1.0, x - 134217728.0


Pair = tuple[lc.Body, lc.Body]


def on_flat(body: lc.Body) -> Pair:
    return lc.Flat(), body


def gear() -> Pair:
    origin = 93.0 / 256.0
    angles = (origin - 0.36, origin + 1.0)
    pinion = lc.Involute(37.5, origin, angles).mirrored().flipped()
    return pinion, lc.Involute(112.5, origin, angles)


def steep_parabola() -> lc.Body:
    return lc.Piecewise([lc.Parabola(1.0, (-9.0, 0.0)), lc.Parabola(1e-6, (0.0, 9.0))])


SCENES: list[tuple[str, Callable[[], Pair], float]] = [
    # Relative accuracy of the limits, as in tests/common/mod.rs.
    ("paper_example_2", example_two, 1e-15),
    ("paper_example_3_scale_one", example_three, 6e-14),
    ("paper_example_3_scale_half_pi", example_three, 6e-14),
    ("paper_example_4_scale_one", example_four, 2e-12),
    ("paper_example_4_scale_half_pi", example_four, 2e-12),
    ("paper_example_5_scale_one", example_five, 5e-13),
    ("paper_example_5_scale_half_pi", example_five, 5e-13),
    ("power_n_1", lambda: on_flat(power(1.0)), 2e-15),
    ("power_n_3", lambda: on_flat(power(3.0)), 4e-15),
    ("power_n_6", lambda: on_flat(power(6.0)), 4e-15),
    ("power_n_20", lambda: on_flat(power(20.0)), 4e-15),
    ("tilted_wedge", lambda: on_flat(lc.Wedge((-0.25, 1.75), 9.0)), 5e-15),
    ("asym_parabola_1e6", lambda: on_flat(steep_parabola()), 1e-12),
    ("hertz_tiny", lambda: on_flat(lc.Parabola(1.0, (-1.0, 1.0))), 1e-15),
    ("hertz_huge", lambda: on_flat(lc.Parabola(1.0, (-4e150, 4e150))), 1e-15),
    (
        "hertz_offcentre",
        lambda: on_flat(lc.Curve((134217720.0, 134217740.0), off_centre)),
        1e-15,
    ),
    ("sinh40_param", lambda: on_flat(lc.Curve((-1.0, 1.0), sinh_parameter)), 1e-14),
    ("k3eps_hertz", lambda: on_flat(lc.Curve((-2.0, 2.0), cubic_parameter)), 2e-15),
    ("rounded_punch_1e-6", lambda: on_flat(lc.RoundedPunch(1.0, 1.0, 3.0)), 2e-15),
    ("wavy_convex", lambda: on_flat(lc.Curve((-3.0, 3.0), wavy)), 2e-15),
    ("gear_involute_pitch_point", gear, 1e-13),
]


class Formula:
    """The formulas of a piece in a reference file, written for NumPy."""

    def __init__(self, piece: dict[str, str]) -> None:
        self.parts = [compile(piece[name], name, "eval") for name in ("X", "Y", "dX", "dY")]

    def __call__(self, k: Array) -> list[Any]:
        return [eval(part, {**vars(np), "k": k}) for part in self.parts]


def from_file(body: dict[str, Any]) -> lc.Body:
    """Builds a body of a reference file; one without ends is cut off far from all contacts."""
    pieces = []
    for piece in body["pieces"]:
        if piece["Y"] == "0":
            return lc.Flat()
        ends = [float(piece[end]) for end in ("k_from", "k_to")]
        pieces.append(lc.Curve(np.clip(ends, -100.0, 100.0).tolist(), Formula(piece)))
    return pieces[0] if len(pieces) == 1 else lc.Piecewise(pieces)
