"""Number of scenes of the design study solved per second: in one process, by Dask and by joblib.

python design_study_throughput.py [ROUNDS]

The ways take turns, and the best round of each counts. Next to the elapsed time stands the
processor time of all processes together, which depends less on other work on the machine. Blocks of
one row show the cost of a block besides its scenes.
"""

import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import design_study
import design_study_joblib
import psutil
from design_study import Study, blocks, solve_block, write_block
from distributed import Client, LocalCluster

# The whole study on a coarser grid: about the same share of it fails.
SOLVED = Study.of((16, 16, 64), block_rows=1024)
SINGLE = Study.of((6, 6, 6), block_rows=1)


def processors() -> float:
    """Returns the processor time of this process and its children, in seconds."""
    here = psutil.Process()
    times = (process.cpu_times() for process in (here, *here.children(recursive=True)))
    return float(sum(of.user + of.system for of in times))


def main() -> None:
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:

        def solved(study: Study, threads: int | None) -> None:
            for block in blocks(study):
                solve_block(study, block, threads)

        def written(study: Study, folder: Path) -> None:
            for block in blocks(study):
                write_block(study, folder, block)

        ways: dict[str, Callable[[Study, Path], object]] = {
            "one process, one thread": lambda study, _: solved(study, 1),
            "one process, all cores": lambda study, _: solved(study, None),
            "one process, one thread, Parquet": written,
            "Dask, two workers, Parquet": lambda study, folder: design_study.run(client, study, folder),
            "joblib, two processes, Parquet": lambda study, folder: design_study_joblib.run(study, folder, 2),
        }

        def seconds(way: Callable[[Study, Path], object], study: Study) -> tuple[float, float]:
            with tempfile.TemporaryDirectory() as folder:
                began, spent = time.perf_counter(), processors()
                way(study, Path(folder))
                return time.perf_counter() - began, processors() - spent

        for way in ways.values():
            seconds(way, SINGLE)
        taken: dict[str, list[tuple[float, ...]]] = {name: [] for name in ways}
        for _ in range(rounds):
            for name, way in ways.items():
                taken[name].append((*seconds(way, SOLVED), *seconds(way, SINGLE)))
    print(f"{os.cpu_count()} cores, {SOLVED.size} scenes in blocks of {SOLVED.block_rows}, best of {rounds} rounds\n")
    print("| | scenes/s | 10⁶ scenes | processor time of 10⁶ | a block of one row | processor time of it |")
    print("|-|-:|-:|-:|-:|-:|")
    for name, of_rounds in taken.items():
        clock, spent, one_clock, one_spent = (min(times) for times in zip(*of_rounds, strict=True))
        million, block = 1e6 / SOLVED.size, 1e3 / SINGLE.size
        print(
            f"| {name} | {SOLVED.size / clock:.0f} | {million * clock:.0f} s | {million * spent:.0f} s"
            f" | {block * one_clock:.1f} ms | {block * one_spent:.1f} ms |"
        )


if __name__ == "__main__":
    main()
