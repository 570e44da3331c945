"""Import path for the scenes and the examples; no windows are opened.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

os.environ.setdefault("MPLBACKEND", "agg")
sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parent.parent / "examples")]
