"""Import path for the scenes and the examples; no windows are opened, and none stay.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

os.environ.setdefault("MPLBACKEND", "agg")
sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parent.parent / "examples")]


@pytest.fixture(autouse=True)
def closed_pictures() -> Iterator[None]:
    yield
    if pyplot := sys.modules.get("matplotlib.pyplot"):
        pyplot.close("all")
