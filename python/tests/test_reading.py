"""Measured profiles read from files: of our own writers, and of independent packages."""

from __future__ import annotations

import io
import pickle
import re
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from instruments import packed, sdf, sdf_text, x3p
from scenes import Array

import linecontact as lc

# Three profiles of a roller of 10 mm radius, 401 points 5 µm apart: metres.
STEP, COUNT = 5e-6, 401
X: Array = np.asarray(STEP * np.arange(COUNT), dtype=np.float64)
ROLLER: Array = np.asarray(0.01 - np.sqrt(0.01**2 - (X - X[200]) ** 2), dtype=np.float64)
SURFACE: Array = np.array([ROLLER, 1.1 * ROLLER, 1.2 * ROLLER])
Z_STEP = 1e-9


def written(folder: Path, name: str, content: bytes | str) -> Path:
    file = folder / name
    file.write_bytes(content if isinstance(content, bytes) else content.encode())
    return file


def same(found: lc.MeasuredProfile, x: Array, z: Array, z_off: float = 0.0, scale: float = 1.0) -> None:
    np.testing.assert_allclose(found.points[:, 0], scale * x, rtol=1e-14, atol=1e-18 * scale)
    np.testing.assert_allclose(found.points[:, 1], scale * z, rtol=1e-14, atol=scale * z_off + 1e-18)


# Texts.

TEXTS = {
    "semicolons": "x [mm]; z [um]\n0.0; 1.5\n0.1; -2.5e0\n0.2; 0.5\n",
    "tabs, windows": "x / mm\tz / um\r\n0.0\t1.5\r\n0.1\t-2.5\r\n0.2\t0.5\r\n",
    "commas": "x (mm),z (um)\n0.0,1.5\n0.1,-2.5\n0.2,0.5",
    "decimal commas": "x [mm];z [um]\n0,0;1,5\n0,1;-2,5\n0,2;0,5\n",
    "decimal commas, tabs": "x [mm]\tz [um]\n0,0\t1,5\n0,1\t-2,5\n0,2\t0,5\n",
    "decimal commas, blanks": "x [mm]  z [um]\n 0,0  1,5\n 0,1 -2,5\n 0,2  0,5\n",
    "units in a line": "Profile of a roller; 26.11.2026\nx;z\nmm;um\n0.0;1.5\n0.1;-2.5\n0.2;0.5\n",
    "trailing delimiters": "x [mm];z [um];\n0.0;1.5;\n0.1;-2.5;\n\n0.2;0.5;\n",
    "comments": "# x [mm] z [um]\n0.0 1.5\n# pause\n0.1 -2.5\n0.2 0.5\n",
    "old Macs": "x [mm];z [um]\r0.0;1.5\r0.1;-2.5\r0.2;0.5\r",
    "empty cells first": ";;\n;\nx [mm];z [um]\n0.0;1.5\n0.1;-2.5\n0.2;0.5\n",
    "right to left": "x [mm];z [um]\n0.2;0.5\n0.1;-2.5\n0.0;1.5\n",
    "ends not measured": "x [mm];z [um]\n-0.1;NaN\n0.0;1.5\n0.1;-2.5\n0.2;0.5\n0.3;-inf\n",
    "a footer": "x [mm];z [um]\n0.0;1.5\n0.1;-2.5\n0.2;0.5\npoint.end\n\nspline.end; of 1\n",
    "remarks": "! roller\n% 1 2 3\n%x [mm] z [um]\n0.0 1.5 % left\n! pause\n0.1 -2.5\n0.2 0.5 add a point\n",
    "numbers in the header": "32.58 37.11 14.71\n(Sd/Sh/qR)\nx [mm] z [um]\n0.0 1.5\n0.1 -2.5\n0.2 0.5\n",
    "quotes": '"x [mm]"\t"z [um]"\n" 0.0\t1.5\n" 0.1\t-2.5"\n0.2\t"0.5"\n',
    "units in words": "x in mm, z in µm\n0.0,1.5\n0.1,-2.5\n0.2,0.5\n",
    "units as last words": "Lateral mm,Raw Micrometer,\n0.0,1.5,\n0.1,-2.5,\n0.2,0.5,\n",
    "units with underscores": "X_(millimetres),Z_(microns)\n0.0,1.5\n0.1,-2.5\n0.2,0.5\n",
    "units between blanks": "x\tz\nmm µm\n0.0\t1.5\n0.1\t-2.5\n0.2\t0.5\n",
    "two numbers above": "1601\t.005\nX [mm]\tZ [um]\n0.0\t1.5\n0.1\t-2.5\n0.2\t0.5\n",
    "remarks above": "x [mm] z [um]\n1601 points\nR = 300 mm\n26.11.2026 14:30\n0.0 1.5\n0.1 -2.5\n0.2 0.5\n",
    "a title with a unit": "Roller, radius 10 mm\nx in mm, z in um\n0.0,1.5\n0.1,-2.5\n0.2,0.5\n",
}


@pytest.mark.parametrize("coding", ["utf-8", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize("case", TEXTS)
def test_texts(case: str, coding: str, tmp_path: Path) -> None:
    found = lc.read_profile(written(tmp_path, "roller.txt", TEXTS[case].encode(coding)))
    np.testing.assert_allclose(found.points, [[0.0, 1.5e-3], [0.1, -2.5e-3], [0.2, 0.5e-3]], rtol=1e-15)
    assert found.unit == "mm" and found.missing == (2 if case == "ends not measured" else 0)


@pytest.mark.parametrize("unit", ["µm".encode(), "μm".encode(), "µm".encode("latin-1"), b"um"])
def test_the_micro_sign(unit: bytes, tmp_path: Path) -> None:
    file = written(tmp_path, "roller.csv", b"x [mm]; z [" + unit + b"]\n0; 3\n1; 4\n")
    np.testing.assert_allclose(lc.read_profile(file).points, [[0.0, 3e-3], [1.0, 4e-3]])
    np.testing.assert_allclose(lc.read_profile(file, unit="nm").points, [[0.0, 3e3], [1e6, 4e3]])


@pytest.mark.parametrize(
    ("unit", "metres"),
    [("µin", 2.54e-8), ("microinches", 2.54e-8), ("mil", 2.54e-5), ("mils", 2.54e-5), ("thou", 2.54e-5), ("Å", 1e-10), ("\u212b", 1e-10)],
)
def test_units_of_other_trades(unit: str, metres: float, tmp_path: Path) -> None:
    text = f"x [{unit}]; z [{unit}]\n0; 3\n1; 4\n"
    np.testing.assert_allclose(lc.read_profile(written(tmp_path, "roller.csv", text), unit="m").points[1], [metres, 4 * metres])
    bare = written(tmp_path, "bare.csv", "0; 3\n1; 4\n")
    np.testing.assert_allclose(lc.read_profile(bare, file_units=("m", unit), unit=unit).points[1], [1 / metres, 4])


def test_units_and_columns(tmp_path: Path) -> None:
    bare = written(tmp_path, "bare.csv", "0;3\n1;4\n")
    marked = written(tmp_path, "marked.csv", b"\xef\xbb\xbf0;3\n1;4\n")
    archived = written(tmp_path, "archived.csv", "PK [mm];z [mm]\n0;3\n1;4\n")
    assert lc.read_profile(archived).points.tolist() == [[0, 3], [1, 4]]
    assert lc.read_profile(marked).points.tolist() == [[0, 3], [1, 4]]
    assert lc.read_profile(bare).unit == "" and lc.read_profile(bare).points.tolist() == [[0, 3], [1, 4]]
    found = lc.read_profile(bare, file_units=("mm", "um"))
    assert found.unit == "mm" and found.points.tolist() == [[0, 3e-3], [1, 4e-3]]
    inches = lc.read_profile(bare, file_units=("in", "in"), unit="mm").points
    np.testing.assert_allclose(inches, [[0, 76.2], [25.4, 101.6]])
    wide = written(tmp_path, "wide.csv", "i;x [mm];y;z [um]\n1;0;9;3\n2;1;9;4\n")
    np.testing.assert_allclose(lc.read_profile(wide, columns=(2, 4)).points, [[0, 3e-3], [1, 4e-3]])
    large = written(tmp_path, "large.csv", "X [MM];Z [UM]\n−1;0\n1;3\n")
    np.testing.assert_allclose(lc.read_profile(large).points, [[-1.0, 0.0], [1.0, 3e-3]])
    blanks = written(tmp_path, "blanks.txt", "i x[mm] z [um]\n1 0 3\n2 1 4\n")
    np.testing.assert_allclose(lc.read_profile(blanks, columns=(2, 3)).points, [[0, 3e-3], [1, 4e-3]])
    with pytest.raises(ValueError, match="unit is 'ft': give one of 'm'"):
        lc.read_profile(bare, unit="ft")
    pairs: list[dict[str, Any]] = [{"columns": (1,)}, {"file_units": "mm"}, {"columns": (1.5, 2)}, {"columns": 1}, {"file_units": (1, 2)}]
    for given in pairs:
        with pytest.raises(TypeError, match="give two, of x and z, such as"):
            lc.read_profile(bare, **given)
    with pytest.raises(FileNotFoundError):
        lc.read_profile(tmp_path / "none.csv")


@pytest.mark.parametrize("mark", ["***", "*******", "N/A", "n.a.", "NA", "---", "?", "null", "None", "No Data", "Invalid", "#N/A"])
def test_marks_of_points_that_were_not_measured(mark: str, tmp_path: Path) -> None:
    rows = [f"{0.1 * i:.1f};{mark if i in (0, 4, 9) else i}" for i in range(10)]
    file = written(tmp_path, "marks.csv", "x [mm];z [um]\n----;----\n" + "\n".join(rows) + "\n")
    found = lc.read_profile(file, skip_missing=True)
    assert found.missing == 3 and found.points[:, 0].round(9).tolist() == [0.1, 0.2, 0.3, 0.5, 0.6, 0.7, 0.8]
    with pytest.raises(lc.errors.MeasuredFileError, match="not measured: skip_missing=True"):
        lc.read_profile(file)


@pytest.mark.parametrize("columns", [(2, 3), ("x_mm", "z_um")])
@pytest.mark.parametrize("flags", [["OK"] * 4, ["OK", "OK", "bad", "OK"], ["OK", "bad", "", "1"]])
def test_words_in_other_columns(flags: list[str], columns: Any, tmp_path: Path) -> None:
    text = "i,x_mm,z_um,flag\n" + "".join(f"{i},{0.1 * i:.1f},{i * i},{flag}\n" for i, flag in enumerate(flags))
    file = written(tmp_path, "flags.csv", text)
    with pytest.warns(UserWarning, match=r"flags.csv states no units: .* file_units=\('mm', 'um'\)"):
        found = lc.read_profile(file, columns=columns)
    assert found.points.round(9).tolist() == [[0, 0], [0.1, 1], [0.2, 4], [0.3, 9]] and found.unit == ""
    with pytest.raises(lc.errors.MeasuredFileError, match="4 columns: .* such as columns="):
        lc.read_profile(file)


def test_numbers_below_the_table(tmp_path: Path) -> None:
    rows = [f"{0.1 * i:.1f};{i * i}" for i in range(12)]
    table = "x [mm];z [um]\n" + "\n".join(rows)
    for footer in ["12;46.2", "12", "0.55;46.2\n0;0\n1.1;121", "12;46.2\nmm", "-5;3"]:
        found = lc.read_profile(written(tmp_path, "footer.csv", f"{table}\n\n{footer}\n"))
        assert found.points.shape == (12, 2) and found.points[-1].tolist() == [1.1, 0.121], footer
    # What goes on is none, and what no empty line sets off is told.
    assert len(lc.read_profile(written(tmp_path, "gap.csv", f"{table}\n\n1.2;144\n1.3;169\n")).points) == 14
    with pytest.raises(lc.errors.MeasuredFileError, match="x = 12 after 1.1 is farther off") as raised:
        lc.read_profile(written(tmp_path, "count.csv", f"{table}\n12;46.2\n"))
    assert raised.value.line == 14


def test_rows_that_are_no_points_are_told(tmp_path: Path) -> None:
    """A mean, a count or a sum beside the table is no point, wherever it stands."""
    head, rows = "x [mm];z [um]\n", [f"{0.1 * i:.1f};{i * i}" for i in range(12)]
    table = "\n".join(rows)
    for text, line in [
        (f"{head}{table}\n\n1.15;46.2\n", 15),
        (f"{head}{table}\n\n2;46.2\n", 15),
        (head + "\n".join(rows[:3]) + "\n\n0.25;46.2\n", 6),
        (f"{head}12;46.2\n\n{table}\n", 2),
        (f"-5;46.2\n\n{table}\n", 1),
        (f"{head}-5;46.2\n{table}\n", 2),
        (f"{head}12;46.2\n{table}\n", 3),
        ("x [mm];z [um];flag\n" + "\n".join(f"{row};ok" for row in rows) + "\n1.2;46.2;Mean\n", 14),
        (f"{head}{table}\n0.55;46.2\n", 14),
    ]:
        with pytest.raises(lc.errors.MeasuredFileError) as raised:
            lc.read_profile(written(tmp_path, "summary.csv", text), columns=(1, 2))
        assert raised.value.line == line, text
    # The last one was that of a mean, which facing would keep.
    assert "leave the line out if it is a count or a mean" in str(raised.value) and "facing" not in str(raised.value)
    # Pages of a table are its points.
    pages = "\n\n".join("\n".join(rows[i : i + 4]) for i in (0, 4, 8))
    assert len(lc.read_profile(written(tmp_path, "pages.csv", f"{head}{pages}\n")).points) == 12


@pytest.mark.parametrize(
    "names",
    ["H\u00f6he [um];Weg [mm]", "Hoehe um;Strecke mm", "Height in um;Distance in mm", "Z (um);Spalte B (mm)", "z/um;path/mm"],
)
def test_the_header_tells_which_column_is_x(names: str, tmp_path: Path) -> None:
    file = written(tmp_path, "swapped.csv", f"{names}\n" + "".join(f"{i * i};{0.1 * i:.1f}\n" for i in range(4)))
    found = lc.read_profile(file)
    assert found.unit == "mm" and found.points[-1].round(9).tolist() == [0.3, 0.009]
    there = names.split(";")
    in_order = written(tmp_path, "order.csv", f"{there[1]};{there[0]}\n0;0\n0.1;1\n")
    assert lc.read_profile(in_order).points.round(9).tolist() == [[0.0, 0.0], [0.1, 0.001]]
    with pytest.warns(UserWarning, match="states no units"):
        assert lc.read_profile(written(tmp_path, "bare.csv", "z_um;x_mm\n5;0\n6;1\n")).points.tolist() == [[0, 5], [1, 6]]


def test_units_that_the_header_contradicts(tmp_path: Path) -> None:
    file = written(tmp_path, "stated.csv", "x [mm];z [um]\n0;3\n1;4\n")
    with pytest.warns(UserWarning, match=r"line 1 states mm for x and um for z: file_units=\('mm', 'nm'\) is taken") as told:
        found = lc.read_profile(file, file_units=("mm", "nm"))
    assert found.points[0].round(12).tolist() == [0.0, 3e-6] and told[0].filename == __file__
    assert lc.read_profile(file, file_units=("millimetre", "\u00b5m")).points[0].round(12).tolist() == [0.0, 3e-3]


def test_exponents_of_fortran(tmp_path: Path) -> None:
    text = "x [mm] z [mm]\n 0.0D+00  1.0D-02\n 1.D0  -2.5d-3\n 2.0D+00  0.0E+00\n 3 0\n"
    found = lc.read_profile(written(tmp_path, "fortran.txt", text))
    assert found.points.tolist() == [[0.0, 0.01], [1.0, -0.0025], [2.0, 0.0], [3.0, 0.0]]
    assert lc.Spline(found) == lc.Spline(found.points)


def test_columns_by_name(tmp_path: Path) -> None:
    file = written(tmp_path, "wide.csv", "n,x [mm],z [um],Note\n1,0,3,7\n2,1,4,8\n")
    for names in [("x", "z"), ("X [mm]", "Z[um]"), (2, "z"), (2, 3)]:
        found = lc.read_profile(file, columns=names)  # type: ignore[arg-type]
        np.testing.assert_allclose(found.points, [[0, 3e-3], [1, 4e-3]])
    # The header of a MiniProf, which names three of four columns.
    rail = written(tmp_path, "rail.ban", '"ColumnDef=X,Y,A"\nW1=\n0 1 -0.4 7\n1 2 -0.3 8\n')
    assert lc.read_profile(rail, columns=("X", "Y")).points.tolist() == [[0, 1], [1, 2]]
    with pytest.raises(lc.errors.MeasuredFileError, match="no column 'z' in the header: there are 'n', 'x") as raised:
        lc.read_profile(written(tmp_path, "no.csv", "n;x;y\n1;0;3\n2;1;4\n"), columns=("x", "z"))
    assert raised.value.line == 1


def test_columns_that_no_header_names(tmp_path: Path) -> None:
    """A title is no header if another line has all names; a remark of several words is no column."""
    for text in [
        "Roller, left\n,x,z\n0,0,3\n1,1,4\n",
        "n,x,z\nmm,um\n0,0,3\n1,1,4\n",
        "n;x;z\n1.;0,0;3\n2.;1,0;4\n",
        "n;x;z\nn.a.;0,0;3\n1.#IND;1,0;4\n",
        "of no name\n0 0 3\n1 1 4\n",
        "n,x,z,note\n0,0,3,\n1,1,4,dust, left\n",
        "n,x,z,note\n0,0,3,dust\n1,1,4,dust, left\n",
    ]:
        found = lc.read_profile(written(tmp_path, "names.txt", text), columns=(2, 3))
        assert found.points.tolist() == [[0, 3], [1, 4]], text


@pytest.mark.filterwarnings("ignore:.*is taken for heights upwards")
def test_columns_are_taken_as_they_are_named(tmp_path: Path) -> None:
    turned = lc.read_profile(written(tmp_path, "turned.csv", "z [um];x [mm]\n0;1\n1;2\n4;3\n"))
    np.testing.assert_allclose(turned.points, [[1.0, 0.0], [2.0, 1e-3], [3.0, 4e-3]])
    for heads in ["Höhe;Weg", "Profilhöhe;Messweg", "z-Wert;x-Wert", "Height;Position", "Depth [um];X Position [mm]", "z (um);Lateral (mm)", "Amplitude;Distance", "z;X-Pos."]:
        turned = lc.read_profile(written(tmp_path, "turned.csv", f"{heads}\n0;1\n1;2\n4;3\n"))
        assert turned.points[:, 0].tolist() == [1.0, 2.0, 3.0], heads
    for heads in ["Position;Height", "x;Position", "Length;Depth", "Distance;x"]:
        kept = lc.read_profile(written(tmp_path, "kept.csv", f"{heads}\n1;0\n2;1\n3;4\n"))
        assert kept.points[:, 0].tolist() == [1.0, 2.0, 3.0], heads
    with pytest.raises(lc.errors.MeasuredFileError, match="are all called 'x'"):
        lc.read_profile(written(tmp_path, "two.csv", "x;x;z\n0;1;3\n1;2;4\n2;3;9\n"), columns=("x", "z"))


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("n,x [mm],z [um]\n1,0,3\n2,1,4\n", r"columns=\('x \[mm\]', 'z \[um\]'\)"),
        ("5 0 9\n4 1 7\n4 2 7\n", r"such as columns=\(2, 3\)"),
        ("3 1 4\n1 5 9\n2 6 5\n3 5 8\n", "or this is a matrix of heights, in which no column is x"),
    ],
)
def test_columns_that_may_be_meant(text: str, reason: str, tmp_path: Path) -> None:
    with pytest.raises(lc.errors.MeasuredFileError, match=reason):
        lc.read_profile(written(tmp_path, "wide.txt", text))


def test_a_profile_that_turns_back(tmp_path: Path) -> None:
    """A circle of 1 mm, from its lowest point round to it again: the upper half is seen from above."""
    angles = np.linspace(-0.5, 1.5, 401) * np.pi
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    # The upright back of a flange, whose points scatter, and one point that is there twice.
    flange = np.array([[-1.5, -2.0], [-1.51, -1.0], [-1.49, 0.0], [-1.49, 0.0], [-1.5, 0.5], [-1.2, -3.0]])
    text = "\n".join(f"{x!r} {z!r}" for x, z in [*flange.tolist(), *circle[::-1].tolist()])
    file = written(tmp_path, "flange.txt", text)
    with pytest.raises(lc.errors.MeasuredFileError, match="facing='up' keeps what is seen from above"):
        lc.read_profile(file)
    seen = lc.read_profile(file, facing="up").points
    assert np.all(np.diff(seen[:, 0]) > 0)
    on_circle = seen[3:]
    np.testing.assert_allclose(on_circle[:, 1], np.sqrt(1 - np.minimum(on_circle[:, 0] ** 2, 1)), atol=1e-7)
    assert len(on_circle) == np.sum(circle[:, 1] > -1e-9)
    assert seen[:4].tolist() == [[-1.51, -1.0], [-1.5, 0.5], [-1.2, -3.0], [-1.0, seen[3, 1]]]
    below = written(tmp_path, "below.txt", "\n".join(f"{x!r} {-z!r}" for x, z in circle.tolist()))
    found = lc.read_profile(below, facing="down").points
    np.testing.assert_allclose(found[:, 1], -np.sqrt(1 - np.minimum(found[:, 0] ** 2, 1)), atol=1e-7)
    assert len(found) == 201
    plain = written(tmp_path, "plain.txt", "2 1\n1 0\n0 3\n")
    assert np.array_equal(lc.read_profile(plain, facing="up").points, lc.read_profile(plain).points)
    with pytest.raises(ValueError, match="facing is 'left'"):
        lc.read_profile(plain, facing="left")  # type: ignore[arg-type]


def test_what_is_seen_is_what_no_segment_covers(tmp_path: Path) -> None:
    random = np.random.RandomState(1)
    for _ in range(20):
        points = random.randint(0, 12, size=(30, 2)).astype(np.float64)
        points = points[np.append(True, np.any(np.diff(points, axis=0) != 0, axis=1))]
        text = "\n".join(f"{x!r} {z!r}" for x, z in points.tolist())
        try:
            found = lc.read_profile(written(tmp_path, "any.txt", text), facing="up").points
        except lc.errors.MeasuredFileError:
            continue
        for x, z in points:
            tops = [z]
            for (x0, z0), (x1, z1) in zip(points[:-1], points[1:], strict=True):
                if min(x0, x1) <= x <= max(x0, x1):
                    tops.append(max(z0, z1) if x0 == x1 else z0 + (z1 - z0) * (x - x0) / (x1 - x0))
            is_found = bool(np.any((found == [x, z]).all(axis=1)))
            if max(tops) > z + 1e-9:
                assert not is_found
            elif max(tops) == z:
                assert is_found


def test_cut_level_and_shift() -> None:
    x = np.linspace(-2.0, 3.0, 51)
    groove = np.where(np.abs(x) < 0.99, -0.1 * (1 - x**2), 0.0)
    profile = lc.MeasuredProfile(np.column_stack([x, 5.0 + 0.02 * x + groove]), "mm", 3)
    level = profile.levelled((-2.0, -1.0), (1.0, 3.0))
    np.testing.assert_allclose(level.points, np.column_stack([x, groove]), atol=1e-14)
    whole = profile.levelled().points
    assert abs(np.polyfit(x, whole[:, 1], 1)).max() < 1e-14
    cut = level.cut(-0.55, 0.55)
    np.testing.assert_array_equal(cut.points[:, 0], x[15:26])
    assert cut.unit == "mm" and cut.missing == 3
    np.testing.assert_array_equal(cut.shifted(1.0, 0.5).points, cut.points + [1.0, 0.5])
    with pytest.raises(ValueError, match="cut from 4 to 5 leaves 0 points: x is from -2 to 3"):
        profile.cut(4.0, 5.0)
    with pytest.raises(ValueError, match="have 0 points: a line is fitted to two or more"):
        profile.levelled((4.0, 5.0))
    # The ends of a part may be open, and are in order.
    np.testing.assert_array_equal(level.cut(-np.inf, 0.0).points, level.points[:21])
    for wrong in ((np.nan, 1.0), (0.0, np.nan), (1.0, -1.0)):
        with pytest.raises(ValueError, match="a part of x is from .* to .*: give its ends, the left one first"):
            profile.cut(*wrong)
        with pytest.raises(ValueError, match="a part of x is from"):
            profile.levelled((-2.0, -1.0), wrong)
    for along, across in ((np.nan, 0.0), (0.0, np.inf)):
        with pytest.raises(ValueError, match="along, across are .*: give finite lengths"):
            profile.shifted(along, across)
    with pytest.raises(TypeError, match="along is '1'"):
        profile.shifted("1")  # type: ignore[arg-type]


# Standard files.


@pytest.mark.parametrize(
    ("kind", "revision"), [("int16", 1), ("int32", 1), ("double", 1), ("float", 2), ("int8", 2), ("int32", 2)]
)
def test_binary_sdf(kind: str, revision: int, tmp_path: Path) -> None:
    step = {"int8": 1e-6, "int16": 2e-9}.get(kind, Z_STEP)
    off = 0.5 * step if kind.startswith("int") else 1e-7 * SURFACE.max() if kind == "float" else 0.0
    file = written(tmp_path, "roller.sdf", sdf(SURFACE, STEP, step, kind, revision))
    for row in (1, 2, 3):
        found = lc.read_profile(file, row=row)
        same(found, X, SURFACE[row - 1], off)
        assert found.unit == "m" and found.missing == 0
    same(lc.read_profile(file, row=2, unit="mm"), X, SURFACE[1], off, 1e3)


@pytest.mark.parametrize("end", ["\r\n", "\n"])
def test_sdf_in_ascii(end: str, tmp_path: Path) -> None:
    file = written(tmp_path, "roller.sdf", sdf_text(SURFACE, STEP, 1e-6, end))
    same(lc.read_profile(file, row=3), X, SURFACE[2])


@pytest.mark.parametrize("kind", ["I", "L", "F", "D"])
def test_x3p(kind: str, tmp_path: Path) -> None:
    step = {"I": 2 * Z_STEP, "L": Z_STEP}.get(kind, 1.0)
    off = 0.5 * step if kind in "IL" else 1e-7 * SURFACE.max() if kind == "F" else 0.0
    file = written(tmp_path, "roller.x3p", x3p(SURFACE, STEP, step, kind, x_offset=0.25))
    same(lc.read_profile(file, row=2), 0.25 + X, SURFACE[1], off)
    file = written(tmp_path, "roller.x3p", x3p(SURFACE[:1], STEP, step, kind))
    same(lc.read_profile(file), X, SURFACE[0], off)


def test_x3p_of_a_stored_x(tmp_path: Path) -> None:
    uneven = X + 1e-7 * np.sin(X / STEP)
    file = written(tmp_path, "roller.x3p", x3p(SURFACE, 1.0, 2 * Z_STEP, "I", uneven))
    same(lc.read_profile(file, row=3), uneven, SURFACE[2], Z_STEP)


def edited(**words: str) -> bytes:
    """Returns an X3P file with words of its main.xml replaced."""
    with zipfile.ZipFile(io.BytesIO(x3p(SURFACE, STEP))) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    for old, new in words.items():
        assert old.encode() in parts["main.xml"]
        parts["main.xml"] = parts["main.xml"].replace(old.encode(), new.encode())
    return packed(parts)


def test_x3p_with_all_elements_in_the_namespace(tmp_path: Path) -> None:
    """Some programs write so, though the schema has it for the root only."""
    content = edited(**{"xmlns:p=": "xmlns=", "p:ISO": "ISO"})
    same(lc.read_profile(written(tmp_path, "roller.x3p", content), row=2), X, SURFACE[1])


@pytest.mark.parametrize("name", ["roller.sdf", "text.sdf", "roller.x3p", "whole.x3p", "roller.csv"])
def test_points_that_were_not_measured(name: str, tmp_path: Path) -> None:
    heights = SURFACE[:1].copy()
    heights[0, :3] = heights[0, 390:] = np.nan

    def content() -> bytes:
        rows = "".join(f"{x!r};{z!r}\n" for x, z in zip(X.tolist(), heights[0].tolist(), strict=True))
        return {
            "roller.sdf": sdf(heights, STEP, Z_STEP, "int32"),
            "text.sdf": sdf_text(heights, STEP, Z_STEP).encode(),
            "roller.x3p": x3p(heights, STEP),
            "whole.x3p": x3p(heights, STEP, Z_STEP, "L"),
            "roller.csv": f"x [m];z [m]\n{rows}".encode(),
        }[name]

    found = lc.read_profile(written(tmp_path, name, content()))
    same(found, X[3:390], SURFACE[0, 3:390], 0.5 * Z_STEP)
    assert found.missing == 14
    heights[0, 200] = heights[0, 202] = np.nan
    file = written(tmp_path, name, content())
    with pytest.raises(lc.errors.MeasuredFileError, match="like 1 others between the ends") as raised:
        lc.read_profile(file)
    assert raised.value.line == 202 if name.endswith("csv") else "point 201" in raised.value.reason
    found = lc.read_profile(file, skip_missing=True)
    left = np.delete(np.arange(3, 390), [197, 199])
    same(found, X[left], SURFACE[0, left], 0.5 * Z_STEP)
    assert found.missing == 16


@pytest.mark.parametrize("kind", ["F", "D"])
def test_infinite_heights_of_x3p_were_not_measured(kind: str, tmp_path: Path) -> None:
    heights = SURFACE[:1].copy()
    heights[0, :3], heights[0, 200] = np.inf, -np.inf
    file = written(tmp_path, "roller.x3p", x3p(heights, STEP, kind=kind))
    with pytest.raises(lc.errors.MeasuredFileError, match="point 201: infinite, as if not measured: .* leaves it out"):
        lc.read_profile(file)
    found = lc.read_profile(file, skip_missing=True)
    left = np.delete(np.arange(3, COUNT), 197)
    same(found, X[left], SURFACE[0, left], 1e-7 * SURFACE.max())
    assert found.missing == 4


@pytest.mark.parametrize("axes", ["z", "x;z", "x;y;z"])
@pytest.mark.parametrize("is_list", [True, False])
def test_x3p_with_points_in_words(axes: str, is_list: bool, tmp_path: Path) -> None:
    """Points in main.xml, of a matrix of profiles or a list of one; the second was not measured."""
    rows = 1 if is_list else 3
    points = [(x, 0.0, z) for heights in SURFACE[:rows] for x, z in zip(X, heights, strict=True)]
    words = [";".join(repr(float(p["xyz".index(axis)])) for axis in axes.split(";")) for p in points]
    words[1] = ""
    data = "<DataList>" + "".join(f"<Datum>{word}</Datum>" for word in words) + "</DataList>"
    main = main_of(x3p(SURFACE[:rows], 1.0 if "x" in axes else STEP, x=X if "x" in axes else None))
    main = re.sub("<DataLink>.*</DataLink>", data, main, flags=re.DOTALL)
    if is_list:
        main = re.sub("<Matrix.*</Matrix.*?>", f"<ListDimension>{COUNT}</ListDimension>", main)
    file = written(tmp_path, "roller.x3p", packed({"main.xml": main.encode()}))
    found = lc.read_profile(file, row=rows, skip_missing=True)
    left = np.delete(np.arange(COUNT), 1) if is_list else np.arange(COUNT)
    same(found, X[left], SURFACE[rows - 1, left])
    for broken, reason in [("</Datum><Datum>", f"lists {rows * COUNT - 1} points"), (";", "Datum 3 is '.*': no numb")]:
        text = main.replace(broken, "", 1) if broken != ";" else main.replace(words[2], "one;two", 1)
        with pytest.raises(lc.errors.MeasuredFileError, match=reason):
            lc.read_profile(written(tmp_path, "roller.x3p", packed({"main.xml": text.encode()})), row=1)


def main_of(content: bytes) -> str:
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return archive.read("main.xml").decode()


def test_x3p_that_was_packed_with_its_folder(tmp_path: Path) -> None:
    with zipfile.ZipFile(io.BytesIO(x3p(SURFACE, STEP, Z_STEP, "L"))) as archive:
        parts = {f"roller/{name}": archive.read(name) for name in archive.namelist()}
    file = written(tmp_path, "roller.x3p", packed({**parts, "notes.txt": b""}))
    same(lc.read_profile(file, row=2), X, SURFACE[1], 0.5 * Z_STEP)
    two = {**parts, "other/main.xml": parts["roller/main.xml"]}
    with pytest.raises(lc.errors.MeasuredFileError, match="main.xml is missing"):
        lc.read_profile(written(tmp_path, "roller.x3p", packed(two)), row=1)


def test_a_roller_from_a_file_is_solved(tmp_path: Path) -> None:
    noisy = ROLLER + 2e-8 * np.random.RandomState(1).normal(size=COUNT)
    found = lc.read_profile(written(tmp_path, "roller.x3p", x3p(noisy[None], STEP)), unit="mm")
    body = lc.Spline(found.points, smooth=True).shifted(-1e3 * X[200])
    solution = lc.solve(lc.Flat(), body, contact_modulus=115e3, load=500.0)
    exact = lc.solve(lc.Flat(), lc.Ellipse.circle(10.0, (-0.1, 0.1)), contact_modulus=115e3, load=500.0)
    assert abs(solution.half_width - exact.half_width) < 3 * solution.uncertainty().half_width < 0.02 * exact.half_width


# Independent packages.


def bridged() -> Array:
    heights = SURFACE.copy()
    heights[1, :3] = np.nan
    return heights


@pytest.mark.parametrize("form", ["ascii", "binary"])
@pytest.mark.parametrize("revision", ["ISO-1.0", "ISO-2.0"])
def test_sdf_by_sdfio(form: str, revision: str, tmp_path: Path) -> None:
    sdfio: Any = pytest.importorskip("sdfio")
    file = tmp_path / "theirs.sdf"
    settings = {"z_scale": Z_STEP, "format": sdfio.FileFormat[form.upper()]}
    made = sdfio.SdfFile.from_array(bridged(), x_scale=STEP, y_scale=1e-6, **settings)
    made.with_revision(sdfio.Revision(revision), data_type=sdfio.DataType.INT32).save(file)
    found = lc.read_profile(file, row=2)
    same(found, X[3:], SURFACE[1, 3:], 0.5 * Z_STEP)
    binary = sdf(bridged(), STEP, Z_STEP, revision=int(revision[4]))
    ours = sdf_text(bridged(), STEP, Z_STEP) if form == "ascii" else binary
    theirs = sdfio.read(written(tmp_path, "ours.sdf", ours))
    np.testing.assert_allclose(theirs.data, bridged(), rtol=1e-14, atol=1e-20)
    assert theirs.header.x_scale == STEP


@pytest.mark.parametrize("rows", [1, 3])
@pytest.mark.parametrize("kind", ["I", "L", "F", "D"])
def test_x3p_by_x3pio(kind: str, rows: int, tmp_path: Path) -> None:
    x3pio: Any = pytest.importorskip("x3pio")
    step, off = (2 * Z_STEP, Z_STEP) if kind in "IL" else (1.0, 1e-7 * SURFACE.max() if kind == "F" else 1e-20)
    theirs = x3pio.read(written(tmp_path, "ours.x3p", x3p(bridged()[-rows:], STEP, step, kind)))
    layer = theirs.layers[0]
    np.testing.assert_allclose(np.reshape(layer.z, (rows, COUNT)), bridged()[-rows:], rtol=1e-14, atol=off)
    theirs.save(tmp_path / "theirs.x3p")
    found = lc.read_profile(tmp_path / "theirs.x3p", row=rows)
    same(found, X, SURFACE[2], off)


@pytest.mark.parametrize("name", ["roller.sdf", "roller.x3p"])
def test_surfaces_by_surfalize(name: str, tmp_path: Path) -> None:
    surfalize: Any = pytest.importorskip("surfalize")
    theirs = surfalize.Surface(1e6 * bridged(), 1e6 * STEP, 1.0)
    theirs.save(tmp_path / name)
    found = lc.read_profile(tmp_path / name, row=2, unit="um")
    same(found, X[3:], SURFACE[1, 3:], 1e-18, 1e6)
    ours = sdf(bridged(), STEP, Z_STEP) if name.endswith("sdf") else x3p(bridged(), STEP)
    again = surfalize.Surface.load(written(tmp_path, name, ours))
    np.testing.assert_allclose(again.data, 1e6 * bridged(), rtol=1e-12, atol=1e-12)


# Faulty files.


def listed() -> bytes:
    """Returns a surface in X3P whose points are in no matrix."""
    main = re.sub("<Matrix.*</Matrix.*?>", "<ListDimension>9</ListDimension>", main_of(x3p(SURFACE, STEP)))
    return packed({"main.xml": main.encode()})


GOOD = "x [mm]; z [mm]\n0; 1\n1; 2\n"
LINES = sdf_text(SURFACE, STEP, Z_STEP)
NO_X = LINES.replace("Xscale", "Yscale").encode()
NO_COUNT = LINES.replace("= 401", "= 4e2").encode()
MINUS = LINES.replace("= 401", "= -401").replace("= 3\r", "= -3\r").encode()
ZERO = LINES.replace("0.0000000000000000e+00", "zero").encode()
# Header, rows, arguments, line and number of columns, 0 where points and commas are mixed.
THOUSANDS: list[tuple[str, str, dict[str, Any], int, int]] = [
    ("x,z,flag", "0.0000,-85,000,000,1\n0.0001,-85,100,000,1\n", {"columns": (1, 2)}, 2, 5),
    ("x,z,flag", "0.0000,-85,000,000,1\n0.0001,-85,100,000,1\n", {"columns": ("x", "z")}, 2, 5),
    ("x [mm],z [nm]", "0.0,-85,000\n0.1,-85,100\n", {}, 2, 3),
    ("Roller\na,b", "0.0,-85,000\n0.1,-85,100\n", {"columns": (1, 2)}, 3, 3),
    ("x z flag", "0.0 -85 000 1\n0.1 -85 100 1\n", {"columns": (1, 2)}, 2, 4),
    ("x,z,flag", "0.0,-850,OK\n0.1,-1,234,OK\n0.2,-850,OK\n", {"columns": (1, 2)}, 3, 4),
    ("x,z,t,flag", "0.0,-850,20,OK\n0.1,-1,234,20,OK\n", {"columns": (1, 2)}, 3, 5),
    ("x,z,flag", "0.0,-850,1\n0.1,-1,234,1\n", {"columns": (1, 2)}, 3, 4),
    ("x;z", "0,0;1.234\n0,1;1.235\n", {}, 2, 0),
    ("x;z;t", "0;1.234;0,5\n1;1.235;0,6\n", {"columns": (1, 2)}, 2, 0),
    ("x\tz\tt", "0\t85,000\t0.5\n1\t85,100\t0.6\n", {"columns": (1, 2)}, 2, 0),
    ("x,z", "0,1,0,2\n0,2,0,3\n", {"columns": (1, 2)}, 2, 4),
]
FAULTS: list[tuple[str, bytes, dict[str, Any], dict[str, Any], str]] = [
    ("empty.csv", b"", {}, {}, "no line has two numbers"),
    ("blank.csv", b"\n\n \r\n", {}, {}, "no line has two numbers"),
    ("words.csv", b"not a profile\n", {}, {}, "no line has two numbers"),
    ("one.csv", b"z [um]\n1.5\n2.5\n", {}, {"line": 2}, "columns of x and z"),
    ("short.csv", b"0;1\n", {}, {}, "1 point was measured"),
    ("three.csv", b"0;1;2\n1;2;3\n", {}, {"line": 1}, r"columns=\(1, 3\)"),
    ("wide.csv", b"0;1\n1;2;3\n", {}, {"line": 2}, "3 columns: there are 2"),
    ("thin.csv", b"0;1\n1\n", {}, {"line": 2}, "1 column: there are 2 in line 1; put # in front of it"),
    ("count.csv", b"0;1\n" * 9 + b"9\n", {}, {"line": 10}, "put # in front of it if it is a footer"),
    ("commas.csv", b"0,1,0,2\n0,2,0,3\n", {}, {"line": 1}, "if these are decimal commas, separate the columns by semic"),
    ("more_commas.csv", b"0,0\n0,1,0,2\n", {}, {"line": 2}, "4 columns: .*; if these are decimal commas"),
    ("column.csv", GOOD.encode(), {"columns": (1, 3)}, {"line": 2}, "give two of 1 to 2"),
    ("zero.csv", GOOD.encode(), {"columns": (0, 1)}, {"line": 2}, "give two of 1 to 2"),
    ("word.csv", b"0;1\n1;two\n", {}, {"line": 2}, "'two' are no two numbers"),
    ("thousands.csv", b"0;1\n1;1.234,5\n", {}, {"line": 2}, "are no two numbers"),
    ("mixed.csv", b"0.5;1\n1,5;2\n", {}, {"line": 2}, "decimal point, and others with a comma"),
    *(
        (f"stray{i}.csv", f"n;m\n{x};-3.5\n-3;1\n-2;1\n".encode(), {}, {"line": 2}, "and '-3.5' look like data")
        for i, x in enumerate(["-4,000.000", "-4 000.000", "-4'000.000", "-4.000,000", "−4.0*", "-4.0 um"])
    ),
    ("flag.csv", b"-4\t-3.5*\n-3\t1\n-2\t1\n", {}, {"line": 1}, "and '-3.5[*]' look like data"),
    ("quoted.csv", b'x (mm),z (um),flag\n0.0,"-1,400.0",OK\n1.0,"-1,300.0",OK\n', {}, {"line": 2}, "no line has two numbers"),
    *(
        (f"grouped{i}.txt", f"{one}{by}0.5\n{one}{by}0.6\n".encode(), {}, {"line": 1}, f"{reason}; [\"'].*{one}[\"'] may be one number: take")
        for i, (one, by, reason) in enumerate(
            [("1 234.5", ";", "x and z"), ("3,000.0", ";", "x and z"), ("3.000,5", ";", "x and z"), ("1 234.5", "\t", "3 columns: .* or name"), ("1 234", " ", "or name"), ("12'345.6", ";", ""), ("1’234", ",", "")]
        )
    ),
    *(
        (f"with_units{i}.txt", f"1.5{gap}mm{by}0.2{gap}µm\n2.5{gap}mm{by}0.3{gap}µm\n".encode(), {}, {"line": 1}, f"; '1.5{gap}mm' may be a number with its")
        for i, (gap, by) in enumerate([(" ", " "), (" ", ";"), (" ", "\t"), ("", ","), ("", " ")])
    ),
    ("points_with_units.txt", "x z\n1.5 mm 0.2 µm\n2.5 mm 0.3 µm\n".encode(), {}, {"line": 2}, "'1.5 mm' may be a number with its unit"),
    ("two_commas.txt", b"1,0,0,5\n2,0,0,3\n", {}, {"line": 1}, "4 columns: give those of x and z, by number or name; '1,0' may be one"),
    *(
        (f"thousands{i}.csv", f"{heads}\n{rows}".encode(), given, {"line": line}, (f"{count} columns.*" if count else "a comma: ") + "take out separators of th")
        for i, (heads, rows, given, line, count) in enumerate(THOUSANDS)
    ),
    ("late.csv", b"0;1;OK\n1;2;OK\n1,000.0;3;OK\nend\n", {"columns": (1, 2)}, {"line": 3}, "'3' look like data"),
    ("score.csv", b"0;1\n1;1_000\n", {}, {"line": 2}, "are no two numbers"),
    ("infinite.csv", b"0;1\n1;inf\n2;3\n", {}, {"line": 2}, "infinite"),
    # As C prints them on Windows; a remark does not begin within a number.
    ("windows.csv", b"0;1\n1;1.#QNAN\n2;-1.#IND00\n3;1.#INF\n4;3\n", {}, {"line": 2}, "not measured, like 2 others"),
    ("marked.csv", b"0;1\n1;12!\n2;3\n", {}, {"line": 2}, "'1' and '12!' are no two numbers"),
    ("huge.csv", b"0;1\n1;1e999\n2;3\n", {}, {"line": 2}, "infinite"),
    ("hole.csv", b"0;1\n1;NaN\n2;3\n", {}, {"line": 2}, "skip_missing=True"),
    ("nothing.csv", b"0;NaN\n1;NaN\n2;\n", {}, {}, "0 points were measured"),
    ("turns.csv", b"0;1\n1;2\n0.5;3\n2;4\n", {}, {"line": 3}, "x = 0.5 after 1"),
    ("twice.csv", b"0;1\n1;2\n1;3\n2;4\n", {}, {"line": 3}, "x = 1 after 1"),
    ("still.csv", b"1;1\n1;2\n", {}, {"line": 2}, "x = 1 after 1"),
    ("half.csv", b"x [mm]; z\n0;1\n1;2\n", {}, {"line": 1}, "only one of x and z has a unit"),
    ("feet.csv", b"x [ft]; z [V]\n0;1\n1;2\n", {}, {"line": 1}, r"'ft' and 'V' is no unit .* are m, cm, .*=\('mm', 'mm'\).*\[mm per ft, mm per V\]"),
    ("volts.csv", b"x [in]; z [V]\n0;1\n1;2\n", {}, {"line": 1}, r"'V' is no unit .*=\('in', 'in'\), and multiply the points by \[1, in per V\]"),
    ("bare.csv", b"0;1\n1;2\n", {"unit": "mm"}, {}, "states no units: give file_units"),
    ("twice.csv", GOOD.encode(), {"columns": (1, 1)}, {"line": 2}, "give two of 1 to 2"),
    ("wide16.csv", "0;1\n1;2".encode("utf-16")[:-1], {}, {"byte": 14}, "no text in UTF-16"),
    ("no_mark.csv", "0;1\n1;2\n".encode("utf-16-le"), {}, {"byte": 1}, "zero bytes"),
    ("rows.csv", GOOD.encode(), {"row": 1}, {}, "is text: columns and file_units are for texts"),
    ("columns.sdf", sdf(SURFACE, STEP, Z_STEP), {"row": 1, "columns": (1, 2)}, {}, "is sdf: .* row is for others"),
    ("text.x3p", GOOD.encode(), {}, {"byte": 0}, "no X3P file"),
    ("text.sdf", GOOD.encode(), {}, {"byte": 0}, "no SDF file"),
    ("new.sdf", b"bISO-3.0" + sdf(SURFACE, STEP, Z_STEP)[8:], {"row": 1}, {"byte": 0}, "no SDF file"),
    ("rows.sdf", sdf(SURFACE, STEP, Z_STEP), {}, {}, "3 profiles: give a row from 1 to 3"),
    ("row.sdf", sdf(SURFACE, STEP, Z_STEP), {"row": 4}, {}, "row is 4"),
    ("row.x3p", x3p(SURFACE, STEP), {"row": 0}, {}, "row is 0"),
    ("head.sdf", sdf(SURFACE, STEP, Z_STEP)[:80], {"row": 1}, {"byte": 80}, "header of 81 bytes"),
    ("cut.sdf", sdf(SURFACE, STEP, Z_STEP)[:-1], {"row": 1}, {"byte": 9704}, "ends before 3 profiles"),
    ("none.sdf", sdf(np.zeros((1, 0)), STEP, Z_STEP), {}, {}, "0 points were measured"),
    ("still.sdf", sdf(SURFACE, 0.0, Z_STEP), {"row": 1}, {}, "in steps of 0"),
    ("nan.sdf", sdf(SURFACE, STEP, np.nan), {"row": 1}, {}, "in steps of nan"),
    ("packed.sdf", sdf(SURFACE, STEP, Z_STEP, compression=1), {"row": 1}, {}, "Compression 1"),
    ("type.sdf", sdf(SURFACE, STEP, Z_STEP, code=3), {"row": 1}, {}, "DataType 3.*one of 5, 6, 7"),
    ("check.sdf", sdf(SURFACE, STEP, Z_STEP, check=1), {"row": 1}, {}, "CheckType 1"),
    ("cut2.sdf", LINES[:9999].encode(), {"row": 1}, {"line": 98}, "heights, for 3 profiles of 401"),
    ("field.sdf", NO_X, {"row": 1}, {"line": 13}, "Xscale in the header is missing"),
    ("count.sdf", NO_COUNT, {"row": 1}, {"line": 13}, "NumPoints in the header is 4e2"),
    ("minus.sdf", MINUS, {}, {"line": 255}, "-3 profiles of -401 points"),
    ("word.sdf", ZERO, {"row": 1}, {"line": 55}, "'zero' is no height"),
    ("only.sdf", b"aISO-1.0", {}, {"line": 1}, "is missing"),
    ("cut.x3p", x3p(SURFACE, STEP)[:-30], {"row": 1}, {}, "no whole ZIP archive"),
    ("head.x3p", x3p(SURFACE, STEP)[:300], {"row": 1}, {}, "no whole ZIP archive"),
    ("empty.x3p", packed({"other.xml": b""}), {}, {}, "main.xml is missing"),
    ("bad.x3p", packed({"main.xml": b"<a><b></a>"}), {}, {}, "main.xml is no XML: mismatched tag: line 1"),
    ("laughs.x3p", packed({"main.xml": b"<!DOCTYPE a [<!ENTITY b 'b'>]><a>&b;</a>"}), {}, {}, "document type"),
    ("cloud.x3p", x3p(SURFACE, STEP, feature="PCL"), {"row": 1}, {}, "feature type 'PCL'"),
    ("more.x3p", x3p(SURFACE, STEP, count=402), {"row": 1}, {}, "data.bin has 9624 bytes: 9648 are expected"),
    ("bomb.x3p", x3p(SURFACE, STEP, count=10**12), {"row": 1}, {}, "data.bin has 9624 bytes"),
    ("none.x3p", x3p(SURFACE, STEP, count=0), {"row": 1}, {}, "3 profiles of 0 points"),
    ("word.x3p", x3p(SURFACE, STEP, count="many"), {"row": 1}, {}, "SizeX is 'many'"),
    ("step.x3p", x3p(SURFACE, 0.0), {"row": 1}, {}, "in steps of 0"),
    ("offset.x3p", x3p(SURFACE, STEP, x_offset=np.nan), {"row": 1}, {}, "coordinates from nan"),
    ("coding.x3p", packed({"main.xml": b"<?xml version='1.0' encoding='foo'?><a/>"}), {}, {}, "main.xml is no XML"),
    ("wide.x3p", packed({"main.xml": b"<?xml version='1.0' encoding='utf-32'?><a/>"}), {}, {}, "main.xml is no XML"),
    ("list.x3p", edited(DataLink="DataList"), {"row": 1}, {}, "read are those in a binary part"),
    ("height.x3p", edited(**{"<AxisType>A": "<AxisType>I"}), {"row": 1}, {}, "stored are {}: Z must be"),
    ("type.x3p", edited(**{"A</AxisType><DataType>D": "A</AxisType><DataType>Q"}), {"row": 1}, {}, "'Z': 'Q'"),
    ("axis.x3p", x3p(SURFACE, STEP, kind="D", x_type="A"), {"row": 1}, {}, "19248 are expected"),
    ("flat.x3p", x3p(SURFACE[:1], STEP), {"row": 2}, {}, "row is 2"),
    ("swapped.csv", b"n;k\n3;0\n1;1\n2;2\n", {}, {"line": 4}, r"as column 2 does \(columns=\(2, 1\)\)"),
    ("one_hole.csv", b"0;1\n1;NaN\n2;3\n", {}, {"line": 2}, ": not measured: skip_missing=True leaves it out"),
    ("words_between.csv", b"0;1\nend\n1;2\n", {"columns": (1, 2)}, {"line": 2}, "1 column: there are 2"),
    ("micron.csv", b"X_(microns),y1\n0,1\n1,2\n", {}, {"line": 1}, r"only one .* such as \('um', 'um'\)"),
    ("last.csv", b"x in mm,height\n0,1\n1,2\n", {}, {"line": 1}, "only one of x and z has a unit"),
    ("book.xlsx", packed({"[Content_Types].xml": b"", "xl/workbook.xml": b""}), {}, {}, "is a workbook"),
    ("book.ods", packed({"mimetype": b"", "content.xml": b""}), {}, {}, "save the sheet with the profile as CSV"),
    ("book.xls", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(504), {}, {"byte": 0}, "is a workbook"),
    ("points.x3p", listed(), {}, {}, "feature type 'SUR', a point cloud: read are profiles"),
]


@pytest.mark.parametrize(("name", "content", "given", "place", "reason"), FAULTS, ids=lambda case: str(case)[:20])
def test_faults(
    name: str, content: bytes, given: dict[str, Any], place: dict[str, int], reason: str, tmp_path: Path
) -> None:
    file = written(tmp_path, name, content)
    with pytest.raises(lc.errors.MeasuredFileError, match=reason) as raised:
        lc.read_profile(file, **given)
    error = raised.value
    assert error.path == str(file) and str(error).startswith(str(file)) and "\n" not in str(error)
    assert {"line": error.line, "byte": error.byte} == {"line": None, "byte": None, **place}
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and vars(again) == vars(error)


def test_a_part_that_is_too_large_is_not_unpacked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("linecontact.surfaces._MOST_BYTES", 10**6)
    monkeypatch.setattr(zipfile.ZipFile, "read", lambda *_: pytest.fail("unpacked"))
    file = written(tmp_path, "bomb.x3p", packed({"main.xml": bytes(2 * 10**6)}))
    assert file.stat().st_size < 10**4
    with pytest.raises(lc.errors.MeasuredFileError, match="main.xml has 2000000 bytes: .* at most 1000000"):
        lc.read_profile(file)


def test_random_damage_is_told(tmp_path: Path) -> None:
    random = np.random.RandomState(1)
    whole = [sdf(SURFACE, STEP, Z_STEP), sdf_text(SURFACE, STEP, Z_STEP).encode(), x3p(SURFACE, STEP, Z_STEP, "L")]
    for content in whole:
        for _ in range(300):
            damaged = bytearray(content)
            places = random.randint(0, min(len(damaged), 1200), size=3)
            damaged[places[0]] ^= 1 << random.randint(8)
            damaged[places[1]] = random.randint(256)
            file = written(tmp_path, "damaged", bytes(damaged[: len(damaged) - random.choice([0, 0, places[2]])]))
            try:
                points = lc.read_profile(file, row=random.randint(1, 4)).points
            except lc.errors.MeasuredFileError:
                continue
            assert np.all(np.isfinite(points)) and np.all(np.diff(points[:, 0]) > 0)


def test_depths_are_told(tmp_path: Path) -> None:
    for name in ("Tiefe [um]", "z depth (um)"):
        with pytest.warns(UserWarning, match=r"is taken for heights upwards.*Spline\(...\).flipped\(\)"):
            lc.read_profile(written(tmp_path, "depth.csv", f"x [mm];{name}\n0;1\n1;2\n"))


@pytest.mark.filterwarnings("error")
def test_a_footer_below_equal_heights_leaks_no_warning(tmp_path: Path) -> None:
    rows = "".join(f"0,{i}00;{-66.7 - i * (4 - i)}\n".replace(".", ",") for i in range(5))
    assert len(lc.read_profile(written(tmp_path, "a.csv", f"x [mm];z [um]\n{rows}\n0,000;-66,7\n")).points) == 5
