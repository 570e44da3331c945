"""Cost of a call from Python: the table in the README.

    python python/examples/figures.py
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

import linecontact as lc


def least(work: Callable[[], object], count: int = 1, rounds: int = 7) -> float:
    """Returns the microseconds for one of `count` calls, in the quickest of some rounds."""
    took = []
    for _ in range(rounds):
        began = time.perf_counter()
        work()
        took.append(time.perf_counter() - began)
    return min(took) / count * 1e6


def main() -> None:
    count = 20_000
    roller = lc.Ellipse.circle(10.0, (-1.0, 1.0))
    contact = lc.Contact(lc.Flat(), roller, contact_modulus=115e3)
    loads = 500.0 + np.arange(count) * 1e-6
    solver = lc.Solver()

    def one_by_one() -> None:
        for load in loads:
            solver.solve(contact, load=load)

    def anew() -> None:
        for load in loads[:1000]:
            contact.solve(load=load)

    def together() -> None:
        lc.sweep(contact, load=loads, quantities=["a"], threads=1)

    print("| a solve of a roller on a flat | µs |")
    print("|-|-:|")
    by_one, by_sweep = least(one_by_one, count), least(together, count)
    print(f"| from nothing, `contact.solve` | {least(anew, 1000):.1f} |")
    print(f"| the next load, `solver.solve` | {by_one:.2f} |")
    print(f"| the next load in `lc.sweep`, one thread | {by_sweep:.2f} |")
    print(f"| so a call costs | {by_one - by_sweep:.2f} |")

    solution = contact.solve(load=500.0)
    x = np.linspace(-solution.b, solution.a, 1_000_000)
    print(f"| 10⁶ pressures, per pressure | {least(lambda: solution.pressure(x), x.size):.4f} |")


if __name__ == "__main__":
    main()
