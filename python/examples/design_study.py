"""A design study of a million roller contacts: the best crowning for all loads and misalignments.

    pip install './python[cluster,plot]'
    python design_study.py results --local 2
    python design_study.py results --scheduler tcp://node1:8786

The second line starts two workers here, the third uses a Dask cluster, each of whose workers needs
the first line, too. After an interruption the same line continues the study.

The plane of the contact contains the axis of the roller: the generatrix, with logarithmic crowning,
is pressed on a flat, in plane strain. Lengths are in mm, angles in radians, loads in N/mm,
pressures in MPa.

The study is cut into blocks of a few thousand rows, load innermost. A worker solves a block with
`lc.sweep` and writes it to the folder, which the workers of a cluster share: no results pass
through the scheduler or stay in the client. A file has a temporary name until it is complete. So
each file is a finished block, and writing a block twice gives the same file.
"""

from __future__ import annotations

import argparse
import hashlib
import math
import os
import sys
import time
import uuid
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import nullcontext, suppress
from dataclasses import dataclass
from importlib import metadata
from importlib.util import find_spec
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

import linecontact as lc

Array: TypeAlias = npt.NDArray[np.float64]
Columns: TypeAlias = Mapping[str, npt.NDArray[Any]]

STEEL = lc.Material(210e3, 0.3)
QUANTITIES = ("peak_pressure", "half_width", "centre")
# Number of blocks submitted for each thread: one in progress, and the next one.
AHEAD = 2
# Number of further attempts at a block whose worker could not write it.
RETRIES = 2
# Packages of the extra `cluster`.
NEEDED = ("dask", "distributed", "pyarrow")
INSTALL = "pip install './python[cluster]'"


class Range(NamedTuple):
    first: float
    last: float
    points: int

    def values(self) -> Array:
        return np.linspace(*self)


@dataclass(frozen=True)
class Study:
    """A study: all data that its results depend on.

    Workers get the study and the number of a block.
    """

    crownings: Range = Range(0.001, 0.03, 100)
    misalignments: Range = Range(0.0, 1e-3, 100)
    loads: Range = Range(200.0, 3000.0, 100)
    # Half-length at which the logarithm is infinite, and the end of the roller, which is shorter.
    half_length: float = 8.0
    reach: float = 7.9
    # A multiple of the 32 rows in which a sweep solves each from the one before.
    block_rows: int = 4096
    version: str = metadata.version("linecontact")

    @classmethod
    def of(cls, points: Sequence[int], block_rows: int = 4096) -> Study:
        """Creates a study with these numbers of crownings, misalignments and loads."""
        crownings, misalignments, loads = points
        return cls(
            cls.crownings._replace(points=crownings),
            cls.misalignments._replace(points=misalignments),
            cls.loads._replace(points=loads),
            block_rows=block_rows,
        )

    @property
    def shape(self) -> tuple[int, int, int]:
        return self.crownings.points, self.misalignments.points, self.loads.points

    @property
    def size(self) -> int:
        return math.prod(self.shape)

    @property
    def fingerprint(self) -> str:
        return hashlib.sha256(repr((self, STEEL, QUANTITIES)).encode()).hexdigest()[:12]

    def name(self, block: int) -> str:
        return f"{self.fingerprint}-{block:06}.parquet"

    def roller(self, crowning: float, misalignment: float) -> lc.Contact:
        generatrix = lc.Crowning(crowning, self.half_length, (-self.reach, self.reach))
        return lc.Contact(lc.Flat(), generatrix.rotated(misalignment), materials=(STEEL, STEEL))


def blocks(study: Study) -> range:
    return range(-(-study.size // study.block_rows))


def rows(study: Study, block: int) -> range:
    first = block * study.block_rows
    return range(first, min(first + study.block_rows, study.size))


def solve_block(study: Study, block: int, threads: int | None = 1) -> dict[str, npt.NDArray[Any]]:
    """Returns the columns of a block.

    One thread is enough: Dask and joblib solve as many blocks at a time as there are cores.
    """
    if (here := metadata.version("linecontact")) != study.version:
        raise RuntimeError(f"the study was started with linecontact {study.version}, this worker has {here}")
    crownings, misalignments, loads = (of.values() for of in (study.crownings, study.misalignments, study.loads))
    pairs, load = np.divmod(rows(study, block), loads.size)
    crowning, misalignment = crownings[pairs // misalignments.size], misalignments[pairs % misalignments.size]
    rollers: dict[int, lc.Contact] = {}
    contacts = []
    for pair, depth, angle in zip(pairs.tolist(), crowning.tolist(), misalignment.tolist(), strict=True):
        if pair not in rollers:
            rollers[pair] = study.roller(depth, angle)
        contacts.append(rollers[pair])
    found = lc.sweep(contacts, load=loads[load], quantities=QUANTITIES, threads=threads)
    return {"crowning": crowning, "misalignment": misalignment, "load": loads[load], **found}


def write_block(study: Study, folder: Path, block: int) -> int:
    """Solves a block and writes its file, completely or not at all.

    Returns the number of failed rows.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    found = solve_block(study, block)
    path = folder / study.name(block)
    # A worker that was given up may still be working on this block.
    unfinished = path.with_suffix(f".{uuid.uuid4().hex}.tmp")
    try:
        pq.write_table(pa.table(found), unfinished, write_page_checksum=True)
        os.replace(unfinished, path)
    finally:
        unfinished.unlink(missing_ok=True)
    return int(np.count_nonzero(found["error"] != ""))


def read_block(study: Study, folder: Path, block: int) -> dict[str, npt.NDArray[Any]]:
    """Reads the columns of a finished block; raises a ValueError if its file is damaged."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    path = folder / study.name(block)
    try:
        table = pq.read_table(path, page_checksum_verification=True, partitioning=None)
    except FileNotFoundError:
        raise
    except (OSError, pa.ArrowException) as broken:
        raise ValueError(f"{path} is damaged: {broken}") from broken
    if table.num_rows != len(rows(study, block)):
        raise ValueError(f"{path} is damaged: {table.num_rows} rows of {len(rows(study, block))}")
    return {name: table[name].to_numpy() for name in table.column_names}


def read_all(study: Study, folder: Path) -> Iterator[dict[str, npt.NDArray[Any]]]:
    """Reads the columns of all blocks, one block after the other."""
    return (read_block(study, folder, block) for block in blocks(study))


def missing(needed: Sequence[str] = NEEDED) -> list[str]:
    """Lists the packages that are not installed."""
    return [name for name in needed if find_spec(name) is None]


def unfinished_blocks(study: Study, folder: Path) -> list[int]:
    """Lists the blocks still to be solved: blocks without a file, or with a damaged one.

    Raises a ValueError if the folder holds results of another study.
    """
    folder.mkdir(parents=True, exist_ok=True)
    names = {path.name for path in folder.glob("*.parquet")}
    if others := sorted(names - {study.name(block) for block in blocks(study)}):
        raise ValueError(
            f"{folder / others[0]} is of another study, this one is {study.fingerprint}: give another folder"
        )
    left = []
    for block in blocks(study):
        if study.name(block) in names:
            try:
                read_block(study, folder, block)
                continue
            except ValueError as damaged:
                print(f"{damaged}: solved again", file=sys.stderr)
        left.append(block)
    return left


def tidy(folder: Path) -> None:
    """Removes the files that killed workers have left."""
    for path in folder.glob("*.tmp"):
        path.unlink(missing_ok=True)


class Told:
    """A progress line."""

    def __init__(self, study: Study) -> None:
        self.study, self.failed, self.began = study, 0, time.perf_counter()

    def __call__(self, done: int, of: int, failed: int) -> None:
        self.failed += failed
        # Rate over the blocks of this run, all equally long except the last one of the study.
        rate = done * self.study.block_rows / (time.perf_counter() - self.began)
        left = (of - done) * self.study.block_rows / rate
        line = f"{done}/{of} blocks, {self.failed} rows failed, {rate:.0f} rows/s, {left / 60:.1f} min left"
        print(f"\r{line:<80}", end="\n" if done == of else "", file=sys.stderr, flush=True)


def run(client: Any, study: Study, folder: Path, told: Callable[[int, int, int], object] | None = None) -> int:
    """Solves the remaining blocks of a study on a cluster, and returns their number.

    Workers that lack a package are told before any block is solved. The client holds a few blocks
    for each thread of the cluster, whatever the size of the study. Workers may join and leave. A
    block whose worker dies is given to another.
    """
    client.wait_for_workers(1)
    for worker, lacks in client.run(missing).items():
        if lacks:
            raise RuntimeError(f"the worker {worker} lacks {', '.join(lacks)}: {INSTALL} there")
    from distributed import as_completed

    left = unfinished_blocks(study, folder)
    blocks_left = iter(left)
    running = as_completed()

    def fill() -> None:
        free = AHEAD * max(1, sum(client.nthreads().values())) - running.count()
        for block in islice(blocks_left, max(0, free)):
            # Not pure: a block whose file was lost is solved again.
            running.add(client.submit(write_block, study, folder, block, pure=False, retries=RETRIES))

    fill()
    for done, future in enumerate(running, 1):
        failed = future.result()
        if told is not None:
            told(done, len(left), failed)
        fill()
    # Files that killed workers have left.
    for path in folder.glob("*.tmp"):
        path.unlink(missing_ok=True)
    return len(left)


class Optimum(NamedTuple):
    """The largest pressure of each crowning under each load, over all misalignments."""

    crownings: Array
    loads: Array
    # Infinite if a contact fails at one of the misalignments.
    worst: Array
    # Number of failed rows, by the names of their errors.
    failed: dict[str, int]

    @property
    def pressures(self) -> Array:
        """Largest pressure of each crowning under all loads."""
        largest: Array = self.worst.max(axis=1)
        return largest

    @property
    def best(self) -> int:
        """Index of the crowning with the smallest of these pressures."""
        if not np.isfinite(self.pressures).any():
            raise ValueError("each crowning fails under some load and misalignment")
        return int(self.pressures.argmin())


def optimum(study: Study, solved: Iterable[Columns]) -> Optimum:
    """Finds the optimum over all blocks, given in order and read one after the other."""
    crownings, misalignments, loads = study.shape
    worst = np.zeros((crownings, loads))
    failed: dict[str, int] = {}
    for block, found in enumerate(solved):
        pairs, load = np.divmod(rows(study, block), loads)
        bears = found["error"] == ""
        pressures = np.where(bears, found["peak_pressure"], np.inf)
        np.maximum.at(worst, (pairs // misalignments, load), pressures)
        for name, count in zip(*np.unique(found["error"][~bears].astype(str), return_counts=True), strict=True):
            failed[str(name)] = failed.get(str(name), 0) + int(count)
    return Optimum(study.crownings.values(), study.loads.values(), worst, failed)


def table(found: Optimum, lines: int = 12) -> str:
    """Returns a table of the pressures at the optimum, its neighbours and some other crownings."""
    step = max(1, found.crownings.size // lines)
    shown = {*range(0, found.crownings.size, step), *range(max(0, found.best - 1), found.best + 2)}
    text = ["crowning, mm   largest pressure, MPa"]
    for i in sorted(shown & set(range(found.crownings.size))):
        pressure = f"{found.pressures[i]:.1f}" if np.isfinite(found.pressures[i]) else "fails"
        text.append(f"{found.crownings[i]:12.5f}   {pressure:>8}{'   <- optimum' if i == found.best else ''}")
    return "\n".join(text)


def draw(found: Optimum, file: Path) -> None:
    """Draws the largest pressure against the crowning for some loads, and marks each minimum."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.0, 4.5), layout="constrained")
    axes = figure.subplots()
    for i in np.unique(np.linspace(0, found.loads.size - 1, 5).astype(int)):
        pressures = np.where(np.isfinite(found.worst[:, i]), found.worst[:, i], np.nan)
        (line,) = axes.plot(1e3 * found.crownings, pressures, label=f"{found.loads[i]:.0f} N/mm")
        least = int(found.worst[:, i].argmin())
        axes.plot(1e3 * found.crownings[least], pressures[least], ".", color=line.get_color())
    best = 1e3 * found.crownings[found.best], found.pressures[found.best]
    axes.plot(*best, "k*", markersize=12, label="optimum of all loads")
    axes.set(xlabel="crowning C, µm", ylabel="largest pressure of all misalignments, MPa")
    axes.legend()
    figure.savefig(file)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("folder", type=Path, help="of the results; workers have to see it")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--local", type=int, default=os.cpu_count(), metavar="N", help="workers of one thread, here")
    where.add_argument("--scheduler", metavar="ADDRESS", help="of a cluster that runs")
    parser.add_argument("--points", type=int, nargs=3, default=(100, 100, 100), metavar=("C", "M", "L"))
    parser.add_argument("--block", type=int, default=4096, metavar="ROWS")
    given = parser.parse_args()
    if lacks := missing():
        sys.exit(f"missing here: {', '.join(lacks)}: {INSTALL}")
    from distributed import Client, LocalCluster

    folder = given.folder.resolve()
    study = Study.of(given.points, given.block)
    if given.scheduler:
        cluster = nullcontext(given.scheduler)
    else:
        cluster = LocalCluster(n_workers=given.local, threads_per_worker=1, dashboard_address=None)
    with cluster as address, Client(address) as client:
        run(client, study, folder, Told(study))
    found = optimum(study, read_all(study, folder))
    print(table(found))
    print(f"{study.size} scenes, {sum(found.failed.values())} failed: {found.failed}")
    with suppress(ImportError):
        draw(found, folder / "optimum.svg")
        print(f"drawn: {folder / 'optimum.svg'}")


if __name__ == "__main__":
    main()
