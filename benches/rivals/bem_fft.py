"""A boundary-element code as used for rough contact: equal cells, convolution by FFT, conjugate
gradients on the cells in contact.

Solves for pressures p >= 0 of cells of width h, constant on each, with
f - (1/kappa) sum p K = constant in contact and h sum p = F; K is the integral of ln|x - s| over a
cell (Polonsky and Keer, 1999). It is told the contact to a quarter, and solves any number of
contact spots with any roughness, at the price of fixed cells. The limits are where p would be zero
with the square of p continued from the outermost cells. Settings: the number of cells.
"""
import numpy as np
import tasks

# Of the pressures between two steps, where the search ends.
CONVERGED = 1e-14


def height(body, x):
    out = np.zeros_like(x)
    for start, end, domain, curve in body:
        on = (x > start) & (x <= end)
        k = np.full(on.sum(), 0.5 * sum(domain) if start == -np.inf and end == np.inf else 0.0)
        for _ in range(60):  # Newton, kept on the curve
            points = tasks.at(curve, k, np)
            step = (points[0] - x[on]) / points[2]
            k = np.clip(k - step, *domain)
            if not k.size or np.max(np.abs(step)) < 1e-15:
                break
        out[on] = tasks.at(curve, k, np)[1]
    return out


def press(f, h, load, kappa):
    """Pressures of cells of width h under a load, f being the heights of the gap at their middles."""
    cells = len(f)
    d = h * np.arange(-cells, cells)
    lobe = lambda u: u * np.log(np.abs(u))
    kernel = np.fft.rfft(np.fft.ifftshift(lobe(d + h / 2) - lobe(d - h / 2) - h))
    deflect = lambda p: -np.fft.irfft(kernel * np.fft.rfft(p, 2 * cells))[:cells] / kappa

    p, direction, old, first = np.full(cells, load / (h * cells)), np.zeros(cells), 1.0, True
    for _ in range(20 * cells):
        gap = f + deflect(p)
        on = p > 0
        residual = np.where(on, gap - gap[on].mean(), 0.0)
        new = np.dot(residual, residual)
        direction = np.where(on, residual + (0.0 if first else new / old) * direction, 0.0)
        old = new
        bend = deflect(direction)
        bend -= bend[on].mean()
        step = np.dot(residual[on], direction[on]) / np.dot(bend[on], direction[on])
        before = p
        p = np.maximum(p - step * direction, 0.0)
        overlap = (p == 0) & (gap - gap[on].mean() < 0)
        first = bool(overlap.any())
        p[overlap] -= step * (gap - gap[on].mean())[overlap]
        p *= load / (h * p.sum())
        if np.abs(p - before).sum() < CONVERGED * p.sum():
            break
    return p


def ends(x, p):
    """The outermost limits."""
    inside = np.flatnonzero(p)
    edge = lambda i, j: x[i] + (x[i] - x[j]) * p[i]**2 / (p[j]**2 - p[i]**2)
    return edge(inside[1], inside[2]), edge(inside[-2], inside[-3])


def solve(task, cells):
    kappa, c_load, (left, right), (lower, upper) = tasks.TASKS[task]
    load, h = c_load / np.pi, (right - left) / cells
    x = left + h * (np.arange(cells) + 0.5)
    p = press(height(upper, x) - height(lower, x), h, load, kappa)
    left, right = ends(x, p)
    return left, right, np.interp(tasks.places(left, right), x, p)


if __name__ == "__main__":
    for task in tasks.TASKS:
        for cells in (256, 1024, 4096, 16384):
            tasks.report("BEM FFT", task, f"cells={cells}", lambda: solve(task, cells))
