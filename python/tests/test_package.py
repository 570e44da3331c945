"""Names, types and examples of the package."""

from __future__ import annotations

import ast
import contextlib
import importlib
import inspect
import io
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest

import linecontact as lc
from linecontact import _native

PACKAGE = Path(lc.__file__).parent
HERE = Path(__file__).parent


def names(body: list[ast.stmt]) -> set[str]:
    kinds = (ast.FunctionDef, ast.ClassDef)
    return {one.name for one in body if isinstance(one, kinds) and not one.name.startswith("__")}


def test_every_export_is_in_the_stub() -> None:
    stub = ast.parse((PACKAGE / "_native.pyi").read_text())
    exported = {name for name in vars(_native) if not name.startswith("__")}
    assert names(stub.body) == exported
    for one in stub.body:
        if isinstance(one, ast.ClassDef):
            kind = getattr(_native, one.name)
            members = {name for name in vars(kind) if not name.startswith("__")}
            assert names(one.body) == members, one.name


def test_everything_public_is_listed_and_has_words() -> None:
    public = {
        name
        for name, value in vars(lc).items()
        if not name.startswith("_") and not inspect.ismodule(value)
    }
    assert public | {"errors"} == set(lc.__all__)
    for name in lc.__all__:
        value = getattr(lc, name)
        assert inspect.getdoc(value), name
        if not inspect.isclass(value):
            continue
        for member, of in vars(value).items():
            if not member.startswith("_") and (callable(of) or isinstance(of, property)):
                assert inspect.getdoc(of), f"{name}.{member}"


def test_every_class_has_an_example() -> None:
    # Rows of numbers appear in the examples of the functions that return them.
    rows = {"Approach", "Attempt", "Certificate", "Conformity", "ContactRegion", "Cost", "Extremum", "Peak"}
    rows |= {"SpringPoints", "StressPeak", "Summary", "Uncertainty"}
    kinds = {"EvaluationError", "InputError", "LineContactError", "SolveError"}
    for name in set(lc.__all__) - rows - kinds:
        assert ">>>" in (inspect.getdoc(getattr(lc, name)) or ""), name


@pytest.mark.parametrize("name", [one.name for one in pkgutil.iter_modules([str(PACKAGE)])])
def test_examples(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # Some examples write files.
    monkeypatch.chdir(tmp_path)
    doctest = importlib.import_module("doctest")
    found = doctest.testmod(importlib.import_module(f"linecontact.{name}"))
    assert found.failed == 0


def test_example_of_the_package() -> None:
    doctest = importlib.import_module("doctest")
    assert doctest.testmod(lc).attempted > 0 and doctest.testmod(lc).failed == 0


def test_the_code_of_the_readme(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", (HERE.parent / "README.md").read_text(), re.DOTALL)
    assert len(blocks) > 1
    exec("\n".join(blocks), {})
    assert (tmp_path / "roller.png").exists()


def test_the_tutorial_prints_what_it_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Runs the blocks of `docs/python.md` one after the other, and compares the text below each."""
    pytest.importorskip("scipy")
    monkeypatch.chdir(tmp_path)
    tutorial = (HERE.parents[1] / "docs" / "python.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```\n(?:```text\n(.*?)```)?", tutorial, re.DOTALL)
    assert len(blocks) == tutorial.count("```python") > 10
    known: dict[str, object] = {}
    for code, text in blocks:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(code, known)
        assert printed.getvalue() == text, code


def test_documentation_finds_all_types(tmp_path: Path) -> None:
    pytest.importorskip("pdoc")
    command = [sys.executable, "-m", "pdoc", "--docformat", "numpy", "--output-directory", str(tmp_path), "linecontact"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "Warn" not in done.stderr, done.stderr


def test_types() -> None:
    pytest.importorskip("mypy")
    strict = ["mypy", "--strict", "--config-file", str(HERE.parent / "pyproject.toml")]
    checks = [
        [*strict, "-p", "linecontact"],
        [*strict, *map(str, HERE.rglob("*.py"))],
        # The stub must agree with the extension.
        ["mypy.stubtest", "linecontact._native"],
        [*strict, *map(str, (HERE.parent / "examples").glob("*.py"))],
    ]
    for check in checks:
        command = [sys.executable, "-m", *check]
        done = subprocess.run(command, cwd=HERE, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr


def test_matplotlib_is_not_imported_until_it_is_needed() -> None:
    code = "import sys, linecontact; sys.exit('matplotlib' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)
