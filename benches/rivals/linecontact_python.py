"""This library's Python package: curves as functions of arrays. Settings: the tolerance."""
import math
import numpy as np
import linecontact as lc
import tasks


def body(pieces):
    if not pieces:
        return lc.Flat()
    curves = [lc.Curve(domain, lambda k, curve=curve: tasks.at(curve, k, np)) for *_, domain, curve in pieces]
    return curves[0] if len(curves) == 1 else lc.Piecewise(curves)


def solve(task, tol):
    kappa, c_load, _, (lower, upper) = tasks.TASKS[task]
    contact = lc.Contact(body(lower), body(upper), kappa=kappa, tolerance=tol)
    solution = contact.solve(load=c_load / math.pi)
    left, right = solution.hull
    return left, right, solution.pressure(tasks.places(left, right))


for task in tasks.TASKS:
    for tol in (1e-3, 1e-6, 1e-9, 1e-12):
        tasks.report("linecontact in Python", task, f"tol={tol:.0e}", lambda: solve(task, tol))
