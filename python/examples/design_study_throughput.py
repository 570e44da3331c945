"""How many scenes of the design study are solved each second: in one process, by Dask and by joblib.

python design_study_throughput.py [ROUNDS]

Ways take turns, and of each the best round counts. What a block costs besides its scenes is measured on blocks of one
row.
"""

import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import design_study
import design_study_joblib
from design_study import Study, blocks, solve_block, write_block
from distributed import Client, LocalCluster

# The whole study, coarser: about as large a share of it fails.
SOLVED = Study.of((32, 16, 64), block_rows=2048)
SINGLE = Study.of((8, 8, 8), block_rows=1)


def main() -> None:
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 3
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

        def seconds(way: Callable[[Study, Path], object], study: Study) -> float:
            with tempfile.TemporaryDirectory() as folder:
                began = time.perf_counter()
                way(study, Path(folder))
                return time.perf_counter() - began

        for way in ways.values():
            seconds(way, SINGLE)
        taken: dict[str, list[tuple[float, float]]] = {name: [] for name in ways}
        for _ in range(rounds):
            for name, way in ways.items():
                taken[name].append((seconds(way, SOLVED), seconds(way, SINGLE)))
    took = {name: [min(times) for times in zip(*of, strict=True)] for name, of in taken.items()}
    one, _ = took["one process, one thread"]
    print(f"{os.cpu_count()} cores, {SOLVED.size} scenes in blocks of {SOLVED.block_rows}, best of {rounds} rounds")
    print(f"{'':34}  scenes/s  against one thread  a block of one row  10⁶ scenes")
    for name, (many, single) in took.items():
        print(
            f"{name:34}  {SOLVED.size / many:8.0f}  {one / many:18.2f}  {1e3 * single / SINGLE.size:15.2f} ms"
            f"  {many * 1e6 / SOLVED.size:8.0f} s"
        )


if __name__ == "__main__":
    main()
