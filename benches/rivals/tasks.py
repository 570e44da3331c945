"""The four contacts for the Python programs: curves, inversion, and how a result is printed.

A curve takes k and a module with sin, cos and asin (math or numpy), and returns X, Y, X', Y'.
"""
import math, sys, time

CALLS = 0


def trig(k, m):
    """sin k, cos k, cos k - 1, without cancellation."""
    s, c = m.sin(0.5 * k), m.cos(0.5 * k)
    down = -2 * s * s
    return 2 * s * c, 1 + down, down


def lower2(k, m): return 2 * k + 0.2, -36 * k * k, 2 + 0 * k, -72 * k
def upper2(k, m): return 3 * k + 0.2, 63 * k * k, 3 + 0 * k, 126 * k


def lower3(k, m):
    s, c, d = trig(k, m)
    return (2 * d - 8 * k * c - 9 * s + 7 * k * s, 1e5 * (15 * s + 9 * d - 15 * k * c - 6 * k * s),
            -17 * c + 5 * s + 8 * k * s + 7 * k * c, 1e5 * (15 * k * s - 15 * s - 6 * k * c))


def upper3(k, m):
    s, c, d = trig(k, m)
    return (7 * s - 8 * d + 3 * k * c - 9 * k * s, 1e5 * (35 * k * c - 35 * s - 30 * d + 10 * k * s),
            10 * c - s - 3 * k * s - 9 * k * c, 1e5 * (40 * s - 35 * k * s + 10 * k * c))


def circle(k, m):
    s, c, d = trig(k, m)
    return s, -d, c, s


def left4(k, m):
    s, c, d = trig(k, m)
    return (12 * d - 2 * s - 3 * k * c + 2 * k * s, 1e4 * (711 * d + 63 * s - 63 * k * c - 783 * k * s),
            3 * k * s + 2 * k * c - 5 * c - 10 * s, 1e4 * (63 * k * s - 1494 * s - 783 * k * c))


def right4(k, m):
    s, c, d = trig(k, m)
    return (6 * d - 5 * s - 3 * k * c + 9 * k * s, 1e4 * (7 * k * s - 56000 * k * k - 35 * k * k * c),
            3 * s - 8 * c + 3 * k * s + 9 * k * c, 1e4 * (7 * s - 63 * k * c - 112000 * k + 35 * k * k * s))


def upper4(k, m):
    s, c, d = trig(k, m)
    return (3 * s + 2 * k * c - k * s, 1e4 * (27 * k * c - 27 * s - 1800 * d),
            5 * c - 2 * k * s - s - k * c, 1e4 * (1800 * s - 27 * k * s))


# Each body: pieces (from x, to x, range of k, curve); none for a flat.
INF = math.inf
LOWER3 = (-INF, INF, (-1.3539997025528523, 0.7911938540783813), lower3)
UPPER3 = (-INF, INF, (-1.428061671618955, 0.7623463067015128), upper3)
TASKS = {  # kappa, C, about where the contact is: limits off by a quarter, bodies
    "T2": (math.pi / 2, 128 * math.pi**2 / 25, (-0.7, 1.2),
           [[(-INF, INF, (-2.0, 2.0), lower2)], [(-INF, INF, (-2.0, 2.0), upper2)]]),
    "T3a": (1.0, 300.0, (-0.07, 0.07), [[LOWER3], [UPPER3]]),
    "T4": (1.0, 2 * (1.685750354812596 - 1.4674622093394272), (-0.6, 0.6),
           [[], [(-INF, INF, (-1.5, 1.5), circle)]]),
    "T5": (1.0, 20.0, (-0.0037, 0.0008),
           [[(-INF, 0.0, (0.0, 5.540299783323928), left4), (0.0, INF, (-1.5010288405450835, 0.0), right4)],
            [(-INF, INF, (-1.317538157404613, 0.9495704265766943), upper4)]]),
}


def at(curve, k, m=math):
    """A counted evaluation."""
    global CALLS
    CALLS += k.size if hasattr(k, "size") else 1
    return curve(k, m)


def places(left, right):
    return [0.5 * (left + right) + 0.5 * (right - left) * (2 * i / 102 - 1) for i in range(1, 102)]


def report(name, task, setting, solve):
    """Runs solve() -> -b, a, pressures at places(); the least time of up to three runs counts."""
    global CALLS
    least = INF
    for _ in range(3):
        CALLS, start = 0, time.perf_counter()
        left, right, pressures = solve()
        took = time.perf_counter() - start
        least = min(least, took)
        if took > 0.5:
            break
    numbers = " ".join(repr(float(p)) for p in pressures)
    print(name, task, setting, repr(float(left)), repr(float(right)), CALLS, f"{least * 1e6:.1f}", numbers,
          sep="\t", flush=True)
    print(f"{name} {task} {setting}", file=sys.stderr)
