"""Tests find each other's scenes, and the examples; nothing opens a window."""

from __future__ import annotations

import os
import sys
from pathlib import Path

os.environ.setdefault("MPLBACKEND", "agg")
sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parent.parent / "examples")]
