"""The tutorial `docs/machine_elements.md`: its files, commands and numbers."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path

import pytest

from linecontact import command

TUTORIAL = Path(__file__).resolve().parents[2] / "docs" / "machine_elements.md"
# A file with its name, a command or code; and the text that it prints.
BLOCK = re.compile(
    r"(?:^`(\S+)`:\n\n)?^```(toml|sh|python)\n(.*?)^```\n(?:^```text\n(.*?)^```\n)?",
    re.DOTALL | re.MULTILINE,
)


def test_the_tutorial_prints_what_it_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = TUTORIAL.read_text(encoding="utf-8")
    blocks = BLOCK.findall(text)
    assert 2 * (len(blocks) + text.count("```text")) == text.count("```")
    known: dict[str, object] = {}
    for name, language, code, printed in blocks:
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            if language == "toml":
                Path(name).write_text(code, encoding="utf-8")
            elif language == "python":
                exec(code, known)
            else:
                for line in code.splitlines():
                    assert command.main(line.split()[1:]) == 0, line
        assert out.getvalue() == printed, code
