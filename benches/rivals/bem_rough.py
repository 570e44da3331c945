"""The measured profile of benches/several.rs, with about a hundred contacts, by boundary elements.

    cargo bench --bench several -- heights 16384 | python3 benches/rivals/bem_rough.py

Heights at the middles of equal cells are given, and what this library finds: only the solving is timed.
Errors are those of the outermost limits, as a share of the half of all between them, and of the peak.
"""
import sys, time
import numpy as np
import bem_fft

lines = sys.stdin.read().split("\n")
kappa, load, from_x, to_x = map(float, lines[0].split())
left, right, peak, count = map(float, lines[1].split())
f = np.array([float(line) for line in lines[2:] if line])
h = (to_x - from_x) / len(f)
x = from_x + h * (np.arange(len(f)) + 0.5)
for bem_fft.CONVERGED in (1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10):
    start = time.perf_counter()
    p = bem_fft.press(f, h, load, kappa)
    took = time.perf_counter() - start
    on = np.concatenate(([False], p > 0, [False]))
    found = np.count_nonzero(on[1:] & ~on[:-1])
    limits = max(abs(a - b) for a, b in zip(bem_fft.ends(x, p), (left, right))) / (0.5 * (right - left))
    print(f"cells={len(f)} converged={bem_fft.CONVERGED:.0e} contacts={found} of {count:.0f}",
          f"limits={limits:.1e} peak={p.max() / peak - 1:.1e} ms={took * 1e3:.1f}", sep="\t", flush=True)
