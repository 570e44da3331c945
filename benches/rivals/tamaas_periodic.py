"""Rough surfaces that repeat, by tamaas (Frérot et al., 2020): FFT, Polonsky-Keer.

    cargo bench --bench several -- periodic | python3 benches/rivals/tamaas_periodic.py

What this library finds is given, with its times. Heights at the points and the model are given to tamaas: only its
solving is timed, on one thread. Its peak is read from a parabola through three points, or is the largest pressure of a
point. Prints, for each error of the peak, the fastest setting of either program. The error of a setting is the largest
of it and of all finer ones: a coarse one may be right by chance.
"""
import os
import sys
import time

os.environ["OMP_NUM_THREADS"] = "1"
import numpy as np
import tamaas as tm

tm.initialize(1)
tm.set_log_level(tm.LogLevel.error)


def heights(most, n):
    """Heights of examples/shared/rough.rs at n points."""
    k = np.arange(4.0, most + 1)
    height, rate, phase = k**-1.3, 2 * np.pi * k, k**3 % (2 * np.pi)
    height /= np.sqrt(0.5 * ((height * rate) ** 2).sum())
    return sum(h * np.cos(r * (np.arange(n) / n) + p) for h, r, p in zip(height, rate, phase))


def peak_between(p):
    i = p.argmax()
    left, top, right = p[i - 1], p[i], p[(i + 1) % len(p)]
    return top + (right - left) ** 2 / (8 * (2 * top - left - right))


def solve(surface, tolerance, load):
    """Pressures under a load, and the milliseconds of a first solve and of the next load."""
    least, turn = [np.inf, np.inf], 0
    while turn < 5 and (turn < 2 or least[0] < 500):
        turn += 1
        model = tm.ModelFactory.createModel(tm.model_type.basic_1d, [1.0], [len(surface)])
        model.E, model.nu = 1.0, 0.0
        solver = tm.PolonskyKeerRey(model, surface, tolerance)
        solver.max_iter = 20000
        for j, factor in enumerate((1.0, 1.02)):
            start = time.perf_counter()
            solver.solve(factor * load)
            least[j] = min(least[j], 1e3 * (time.perf_counter() - start))
            if j == 0:
                pressures = np.array(model.traction).ravel()
    return pressures, least


def settings(most, load, exact):
    """Points, tolerance, both errors of the peak, times. Tolerances go down as long as that changes the peak."""
    for power in range(10, 17):
        surface, last = heights(most, 2**power), np.inf
        for tolerance in (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9):
            pressures, times = solve(surface, tolerance, load)
            error, at_point = abs(peak_between(pressures) / exact - 1), abs(pressures.max() / exact - 1)
            print(most, load, 2**power, tolerance, error, at_point, *times, sep="\t", file=sys.stderr, flush=True)
            yield 2**power, tolerance, error, at_point, *times
            if abs(error - last) < 0.05 * error:
                break
            last = error


def fastest(rows, column, error):
    """The setting that takes least time of those that are good enough, with all finer ones."""
    is_finer = lambda row, other: row[0] >= other[0] and row[1] <= other[1]
    worst = lambda row: max(other[column] for other in rows if is_finer(other, row))
    return min((row for row in rows if worst(row) <= error), key=lambda row: row[4], default=None)


def number(value):
    return f"{value:.2g}" if value < 10 else f"{value:.0f}"


scenes = {}
for line in list(sys.stdin)[1:]:
    most, load, contacts, peak, tolerance, error, *times = map(float, line.split("\t"))
    row = (0, tolerance, error, error, *times)
    scenes.setdefault((int(most), load, int(contacts), peak), []).append(row)
print("|waves|contacts|error of the peak|this library, ms|tamaas, ms|points, tolerance|ratio"
      "|next load: this library, ms|tamaas, ms|ratio|tamaas, peak at a point, ms|ratio|")
print("|" + "---|" * 12)
for (most, load, contacts, peak), own in scenes.items():
    rows = list(settings(most, load, peak))
    for error in (1e-4, 1e-5, 1e-6, 1e-7):
        here, there, at_point = fastest(own, 3, error), fastest(rows, 2, error), fastest(rows, 3, error)
        cells = [most - 3, contacts, f"{error:.0e}", number(here[4])]
        if there is None:
            cells += ["-"] * 3 + [number(here[5])] + ["-"] * 2
        else:
            cells += [number(there[4]), f"{there[0]}, {there[1]:.0e}", number(there[4] / here[4]),
                      number(here[5]), number(there[5]), number(there[5] / here[5])]
        cells += ["-"] * 2 if at_point is None else [number(at_point[4]), number(at_point[4] / here[4])]
        print("|" + "|".join(map(str, cells)) + "|", flush=True)
