"""Writes gear_near_base_circle.json: an involute flank close to its base circle, against a straight rack.

Needs mpmath. Takes about a minute.

Upper body: the involute of a circle of radius rb, unwound by the angle t0 + k:
X = rb (cos k + (t0 + k) sin k - 1), Y = rb (sin k - (t0 + k) cos k + t0), so that Y'/X' = tan k.
X' = rb (t0 + k) cos k vanishes on the base circle, k = -t0, where the slope goes like a square root.

The limits are those with m0 = 0 and kappa L m1 = F; the pressure is kappa w/pi^2 times the integral of
(g(s) - g(x))/(s - x) dtheta, s = c + L cos theta. Both by tanh-sinh quadrature, in 50 digits.
"""

import json
from pathlib import Path

from mpmath import mp, mpf

mp.dps = 50
RB, T0 = mpf(75) / 2, mpf(1) / 64
KAPPA = mp.pi / 2 * 113187
C = mpf("16.4")
LEFT, RIGHT = "-2047/131072", "1"  # of k; -t0 is -2048/131072


def x_of(k):
    return RB * (mp.cos(k) + (T0 + k) * mp.sin(k) - 1)


def g(x):
    """The slope at x."""
    # X = rb ((t0 + k)^2 - t0^2)/2 nearly.
    k = -T0 + mp.sqrt(T0**2 + 2 * x / RB)
    for _ in range(100):
        step = (x - x_of(k)) / (RB * (T0 + k) * mp.cos(k))
        k += step
        if abs(step) < mpf(10) ** -48:
            return mp.tan(k)
    raise ArithmeticError(f"no parameter at {x}")


def moments(c, half):
    on = [0, mp.pi / 2, mp.pi]
    m0 = mp.quad(lambda t: g(c + half * mp.cos(t)), on) / mp.pi
    m1 = mp.quad(lambda t: g(c + half * mp.cos(t)) * mp.cos(t), on) / mp.pi
    return m0, m1


def residual(k_left, k_right):
    """Of the two conditions, by the parameters at the limits."""
    left, right = x_of(k_left), x_of(k_right)
    c, half = (left + right) / 2, (right - left) / 2
    m0, m1 = moments(c, half)
    return m0 / T0, KAPPA * half * m1 * mp.pi / C - 1


def pressure(x, c, half):
    turn = mp.acos((x - c) / half)
    here = g(x)

    def quotient(t):
        s = c + half * mp.cos(t)
        # At x itself, where the quotient is 0/0, the derivative.
        if abs(s - x) < mpf(10) ** -25 * half:
            return mp.diff(g, x)
        return (g(s) - here) / (s - x)

    w = mp.sqrt((half - (x - c)) * (half + (x - c)))
    return KAPPA * w / mp.pi**2 * mp.quad(quotient, [0, turn, mp.pi])


def text(x, digits=30):
    return mp.nstr(x, digits, min_fixed=1, max_fixed=0)


def main():
    start = (-mpf(63) / 64 * T0, mpf("0.565") * T0)
    limits = mp.findroot(residual, start, tol=mpf(10) ** -80)
    left, right = map(x_of, limits)
    c, half = (left + right) / 2, (right - left) / 2
    base = x_of(-T0)
    print("left limit", mp.nstr(left, 8), "base circle", mp.nstr(base, 8))
    places = [-0.999, -0.99, -0.9, -0.7, -0.4, -0.1, 0.2, 0.5, 0.8, 0.95, 0.99, 0.999]
    points, worst = [], []
    for z in places:
        x = mpf(float(c + half * mpf(z)))
        p = pressure(x, c, half)
        points.append([mp.nstr(x, 60), text(p)])
        h = mpf(10) ** -12

        def by(share):
            return abs(share / (p * h))

        changes = [
            by(pressure(x + x * h, c, half) - p),
            by(pressure(x, c + right * h / 2, half + right * h / 2) - p),
            by(pressure(x, c + left * h / 2, half - left * h / 2) - p),
        ]
        worst.append(mp.nstr(max([mpf(1), *changes]), 3))
    unwound = "(1/64 + k)"
    file = {
        "format": "contact-reference-1",
        "name": "gear_near_base_circle",
        "kind": "contact",
        "title": "Involute flank close to its base circle, against a straight rack",
        "definition": "Made by gear_near_base_circle.py: see there.",
        "scale": "pi/2*113187",
        "scale_value": text(KAPPA),
        "C": text(C),
        "C_formula": "16.4",
        "F": text(C / mp.pi),
        "body1": {"pieces": [{"X": "k", "Y": "0", "dX": "1", "dY": "0", "k_from": "-1", "k_to": "1"}]},
        "body2": {
            "pieces": [
                {
                    # cos(k) - 1 = -2*sin(k/2)**2, without the loss of digits.
                    "X": f"75/2*({unwound}*sin(k) - 2*sin(k/2)**2)",
                    "Y": "75/2*(sin(k/2)**2/32 + sin(k) - k*cos(k))",
                    "dX": f"75/2*{unwound}*cos(k)",
                    "dY": f"75/2*{unwound}*sin(k)",
                    "k_from": LEFT,
                    "k_to": RIGHT,
                }
            ]
        },
        "breakpoints_x": [],
        "a": text(right),
        "b": text(-left),
        "centre": text(c),
        "half_width": text(half),
        "points": points,
        "points_amplification": worst,
        "conditions": {"residuals": [mp.nstr(abs(r), 3) for r in residual(*limits)]},
    }
    path = Path(__file__).with_suffix(".json")
    path.write_text(json.dumps(file, indent=1) + "\n")


main()
