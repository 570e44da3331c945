"""The design study on a cluster of two workers, and by joblib: each row once, whatever happens to the workers."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import design_study as ds
import numpy as np
import pytest
from design_study import Range, Study

import linecontact as lc

pytest.importorskip("pyarrow")
distributed = pytest.importorskip("distributed")

EXAMPLES = Path(ds.__file__).parent
# Twelve blocks of a tenth of a second.
SMALL = Study.of((12, 8, 32), block_rows=256)


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    local = distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
    with local as started:
        yield started


@pytest.fixture
def client(cluster: Any) -> Iterator[Any]:
    with distributed.Client(cluster) as connected:
        connected.wait_for_workers(2)
        yield connected


def pids(client: Any) -> dict[str, int]:
    found: dict[str, int] = client.run(os.getpid)
    return found


def in_hand(dask_worker: Any) -> int:
    return len(dask_worker.active_threads)


def wait_until(holds: Any) -> None:
    end = time.monotonic() + 60.0
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


def is_whole(study: Study, folder: Path) -> None:
    """Every row is there, with the bits of its block, and nothing else."""
    for block, found in enumerate(ds.read_all(study, folder)):
        want = ds.solve_block(study, block)
        assert list(found) == list(want)
        for name in want:
            np.testing.assert_array_equal(found[name], want[name])
    assert {path.name for path in folder.iterdir()} == {study.name(block) for block in ds.blocks(study)}


def test_the_same_bits_as_one_sweep(client: Any, tmp_path: Path) -> None:
    # From 2048 rows on, a sweep goes on from row to row in runs of 32, wherever it is cut: blocks of as many such runs
    # have the bits of one sweep. Shorter blocks agree with it to the last digits only.
    study = Study(Range(0.005, 0.03, 8), Range(0.0, 1e-3, 16), Range(200.0, 3000.0, 32), block_rows=2048)
    short = Study(study.crownings, study.misalignments, study.loads, block_rows=100)
    rollers = [
        study.roller(crowning, misalignment)
        for crowning in study.crownings.values()
        for misalignment in study.misalignments.values()
    ]
    # One roller for all its loads, as in a block: the solver keeps what it has sampled of it.
    contacts = [roller for roller in rollers for _ in range(32)]
    want = lc.sweep(contacts, load=np.tile(study.loads.values(), 128), quantities=ds.QUANTITIES)
    for of, rtol in ((study, 0.0), (short, 1e-12)):
        folder = tmp_path / of.fingerprint
        assert ds.run(client, of, folder) == len(ds.blocks(of))
        found = list(ds.read_all(of, folder))
        for name in want:
            column = np.concatenate([block[name] for block in found])
            if name == "error":
                np.testing.assert_array_equal(column, want[name])
            else:
                # The centre is a small part of the contact.
                np.testing.assert_allclose(column, want[name], rtol=rtol, atol=rtol * study.reach)


def test_it_goes_on_where_it_was_stopped(client: Any, tmp_path: Path) -> None:
    class Stopped(Exception):
        pass

    def stop(done: int, of: int, failed: int) -> None:
        assert of == 12
        if done == 4:
            raise Stopped

    with pytest.raises(Stopped):
        ds.run(client, SMALL, tmp_path, stop)
    # What a worker has in hand it finishes.
    wait_until(lambda: not any(client.run(in_hand).values()))
    finished = {path: path.stat().st_ino for path in tmp_path.glob("*.parquet")}
    assert 4 <= len(finished) < 12
    told: list[tuple[int, int]] = []
    assert ds.run(client, SMALL, tmp_path, lambda done, of, _: told.append((done, of))) == 12 - len(finished)
    assert told == [(done + 1, 12 - len(finished)) for done in range(12 - len(finished))]
    assert {path: path.stat().st_ino for path in finished} == finished
    is_whole(SMALL, tmp_path)
    assert ds.run(client, SMALL, tmp_path) == 0


def test_a_worker_killed_as_it_solves(client: Any, tmp_path: Path) -> None:
    before, killed = pids(client), []

    def kill(done: int, of: int, failed: int) -> None:
        if done == 2:
            busy = [worker for worker, tasks in client.processing().items() if tasks]
            killed.append(before[busy[0]])
            os.kill(killed[0], signal.SIGKILL)

    ds.run(client, SMALL, tmp_path, kill)
    assert killed
    is_whole(SMALL, tmp_path)
    client.wait_for_workers(2)
    wait_until(lambda: len(pids(client)) == 2)
    assert killed[0] not in pids(client).values()


def dies_at_the_next_file() -> None:
    replace = os.replace

    def die(source: Any, target: Any) -> None:
        if str(target).endswith(".parquet"):
            os.kill(os.getpid(), signal.SIGKILL)
        replace(source, target)

    vars(os)["replace"] = die


def test_a_worker_killed_as_it_writes(client: Any, tmp_path: Path) -> None:
    before = pids(client)
    client.run(dies_at_the_next_file, workers=[next(iter(before))])
    left: set[Path] = set()
    ds.run(client, SMALL, tmp_path, lambda *_: left.update(tmp_path.glob("*.tmp")))
    assert left
    is_whole(SMALL, tmp_path)


def test_a_damaged_file_is_solved_again(client: Any, tmp_path: Path) -> None:
    ds.run(client, SMALL, tmp_path)
    path = tmp_path / SMALL.name(7)
    path.write_bytes(path.read_bytes()[:1000])
    assert ds.run(client, SMALL, tmp_path) == 1
    is_whole(SMALL, tmp_path)


def test_another_study_is_refused(client: Any, tmp_path: Path) -> None:
    ds.write_block(Study.of((2, 2, 2)), tmp_path, 0)
    with pytest.raises(ValueError, match="of another study"):
        ds.run(client, SMALL, tmp_path)
    assert len(list(tmp_path.iterdir())) == 1


def test_the_client_knows_of_a_few_blocks(client: Any, tmp_path: Path) -> None:
    study, known = Study.of((4, 4, 32), block_rows=2), []
    ds.run(client, study, tmp_path, lambda *_: known.append(len(client.futures)))
    # Those of the window, and the one that was told.
    assert len(known) == 256 and max(known) <= 2 * ds.AHEAD + 1


def sweeps(contact: lc.Contact, loads: list[float]) -> lc.Columns:
    return lc.sweep(contact, load=loads, threads=1)


def solves(contact: lc.Contact, load: float) -> lc.Solution:
    return contact.solve(load=load)


def test_bodies_contacts_and_results_travel(client: Any) -> None:
    bodies = [
        lc.Flat(),
        lc.Crowning(0.01, 8.0, (-7.9, 7.9)).rotated(1e-3).shifted(0.0, 1.0),
        lc.Spline([(-2.0, 2.0), (-1.0, 0.5), (0.0, 0.0), (1.0, 0.5), (2.0, 2.0)]),
    ]
    assert client.gather(client.scatter(bodies, hash=False)) == bodies
    contact = SMALL.roller(0.01, 1e-3)
    there, here = client.submit(sweeps, contact, [500.0, -1.0]).result(), sweeps(contact, [500.0, -1.0])
    assert type(there) is lc.Columns and vars(there.errors[1]) == vars(here.errors[1])
    for name in here:
        np.testing.assert_array_equal(there[name], here[name])
    solution = client.submit(solves, contact, 500.0).result()
    assert solution.contact == contact and solution.a == solves(contact, 500.0).a


def runs(*command: object) -> str:
    done = subprocess.run(
        [sys.executable, *map(str, command)], capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("where", ["local", "scheduler"])
def test_the_script(where: str, cluster: Any, tmp_path: Path) -> None:
    there = ["--local", 2] if where == "local" else ["--scheduler", cluster.scheduler_address]
    said = runs(EXAMPLES / "design_study.py", tmp_path, *there, "--points", 4, 4, 4, "--block", 10)
    assert "<- optimum" in said and "64 scenes" in said
    (tmp_path / "optimum.svg").unlink()
    is_whole(Study.of((4, 4, 4), block_rows=10), tmp_path)


def test_joblib(tmp_path: Path) -> None:
    pytest.importorskip("joblib")
    import design_study_joblib

    ds.write_block(SMALL, tmp_path, 5)
    finished = (tmp_path / SMALL.name(5)).stat().st_ino
    design_study_joblib.run(SMALL, tmp_path, 2)
    is_whole(SMALL, tmp_path)
    assert (tmp_path / SMALL.name(5)).stat().st_ino == finished
