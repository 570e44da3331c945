"""Design study without a cluster: its blocks, its files and its optimum."""

from __future__ import annotations

import math
import os
from pathlib import Path

import design_study as ds
import numpy as np
import pytest
from design_study import Range, Study

import linecontact as lc

# Seven blocks; the last one is short.
SMALL = Study.of((4, 4, 4), block_rows=10)


def largest(study: Study, crowning: float, misalignment: float, load: float) -> tuple[float, str]:
    """Returns the pressure and the error of one scene."""
    try:
        return study.roller(crowning, misalignment).solve(load=load).peak().pressure, ""
    except lc.errors.LineContactError as error:
        return math.nan, type(error).__name__


def solved(study: Study) -> list[ds.Columns]:
    return [ds.solve_block(study, block) for block in ds.blocks(study)]


def test_blocks_hold_every_row_once() -> None:
    assert [row for block in ds.blocks(SMALL) for row in ds.rows(SMALL, block)] == list(range(64))
    found = solved(SMALL)
    assert [of["load"].size for of in found] == [10] * 6 + [4]
    grid = np.meshgrid(*(of.values() for of in (SMALL.crownings, SMALL.misalignments, SMALL.loads)), indexing="ij")
    for name, want in zip(("crowning", "misalignment", "load"), grid, strict=True):
        np.testing.assert_array_equal(np.concatenate([of[name] for of in found]), want.ravel())


def test_rows_are_single_solves() -> None:
    errors = set()
    for found in solved(SMALL):
        names = ("crowning", "misalignment", "load", "peak_pressure", "error")
        for *scene, pressure, error in zip(*(found[name] for name in names), strict=True):
            want = largest(SMALL, *scene)
            np.testing.assert_allclose(pressure, want[0], rtol=1e-12)
            assert error == want[1]
            errors.add(error)
    assert errors == {"", "DomainTooShortError"}


def test_the_optimum_is_that_of_all_scenes_one_by_one() -> None:
    found = ds.optimum(SMALL, solved(SMALL))
    pressures, failed = [], 0
    for crowning in SMALL.crownings.values():
        of = [
            largest(SMALL, crowning, misalignment, load)
            for misalignment in SMALL.misalignments.values()
            for load in SMALL.loads.values()
        ]
        pressures.append(math.inf if any(error for _, error in of) else max(pressure for pressure, _ in of))
        failed += sum(error != "" for _, error in of)
    np.testing.assert_allclose(found.pressures, pressures, rtol=1e-12)
    assert math.isinf(pressures[0]) and found.best == int(np.argmin(pressures)) in (1, 2)
    assert found.failed == {"DomainTooShortError": failed}
    marked = [line for line in ds.table(found).splitlines() if "optimum" in line]
    assert len(marked) == 1 and f"{found.crownings[found.best]:.5f}" in marked[0]


def test_no_optimum() -> None:
    weak = Study(crownings=Range(1e-5, 2e-5, 2), misalignments=Range(0.0, 1e-3, 2), loads=Range(3e3, 4e3, 2))
    found = ds.optimum(weak, solved(weak))
    with pytest.raises(ValueError, match="each crowning fails"):
        ds.table(found)


def test_the_picture(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    ds.draw(ds.optimum(SMALL, solved(SMALL)), tmp_path / "optimum.svg")
    assert (tmp_path / "optimum.svg").stat().st_size > 10_000


def test_what_is_finished_is_not_solved_again(tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    folder = tmp_path / "results"
    assert ds.unfinished_blocks(SMALL, folder) == list(ds.blocks(SMALL))
    for block in (0, 2, 6):
        failed = ds.write_block(SMALL, folder, block)
        assert failed == np.count_nonzero(ds.solve_block(SMALL, block)["error"] != "")
    assert ds.unfinished_blocks(SMALL, folder) == [1, 3, 4, 5]
    assert len(list(folder.iterdir())) == 3
    for block in (0, 2, 6):
        want = ds.solve_block(SMALL, block)
        read = ds.read_block(SMALL, folder, block)
        assert list(read) == list(want)
        for name in want:
            np.testing.assert_array_equal(read[name], want[name])
    with pytest.raises(FileNotFoundError):
        list(ds.read_all(SMALL, folder))


def test_a_damaged_file_is_found(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("pyarrow")
    for block in ds.blocks(SMALL):
        ds.write_block(SMALL, tmp_path, block)
    paths = [tmp_path / SMALL.name(block) for block in ds.blocks(SMALL)]
    whole = [path.read_bytes() for path in paths]
    paths[0].write_bytes(whole[0][:-100])
    paths[1].write_bytes(b"")
    # One bit of a number is flipped.
    at = whole[2].index(np.float64(ds.solve_block(SMALL, 2)["peak_pressure"][5]).tobytes())
    paths[2].write_bytes(whole[2][:at] + bytes([whole[2][at] ^ 1]) + whole[2][at + 1 :])
    # This file has too few rows.
    paths[3].write_bytes(whole[6])
    assert ds.unfinished_blocks(SMALL, tmp_path) == [0, 1, 2, 3]
    assert capsys.readouterr().err.count("is damaged") == 4
    for block in range(4):
        with pytest.raises(ValueError, match="is damaged"):
            ds.read_block(SMALL, tmp_path, block)


def test_nothing_half_written_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pyarrow")

    def full(*_: object) -> None:
        raise OSError("no space")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(OSError, match="no space"):
        ds.write_block(SMALL, tmp_path, 0)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "other",
    [
        Study.of((4, 4, 4), block_rows=11),
        Study.of((4, 4, 5), block_rows=10),
        Study(SMALL.crownings, SMALL.misalignments, SMALL.loads, reach=7.8, block_rows=10),
    ],
)
def test_results_of_another_study_are_refused(other: Study, tmp_path: Path) -> None:
    (tmp_path / SMALL.name(3)).touch()
    assert SMALL.fingerprint == Study.of((4, 4, 4), block_rows=10).fingerprint != other.fingerprint
    with pytest.raises(ValueError, match="of another study"):
        ds.unfinished_blocks(other, tmp_path)


def test_another_version_does_not_go_on() -> None:
    old = Study(SMALL.crownings, SMALL.misalignments, SMALL.loads, block_rows=10, version="0.0.1")
    with pytest.raises(RuntimeError, match=r"0\.0\.1"):
        ds.solve_block(old, 0)


def test_what_is_missing_is_said_before_the_study_starts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ds, "find_spec", lambda name: None if name in ("dask", "pyarrow") else name)
    monkeypatch.setattr("sys.argv", ["design_study.py", str(tmp_path / "results")])
    with pytest.raises(SystemExit, match=r"missing here: dask, pyarrow: pip install './python\[cluster\]'"):
        ds.main()
    assert not (tmp_path / "results").exists()


def test_a_worker_that_lacks_a_package_is_named(tmp_path: Path) -> None:
    class Client:
        def wait_for_workers(self, count: int) -> None:
            assert count == 1

        def run(self, asked: object) -> dict[str, list[str]]:
            assert asked is ds.missing
            return {"tcp://node1:1": [], "tcp://node2:1": ["pyarrow"]}

    with pytest.raises(RuntimeError, match="tcp://node2:1 lacks pyarrow"):
        ds.run(Client(), SMALL, tmp_path)
