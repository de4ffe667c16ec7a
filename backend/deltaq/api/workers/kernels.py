"""Which kernels Numba has compiled, as its cache on disk tells; without loading Numba."""

from __future__ import annotations

import os
from pathlib import Path

_BESIDE_THE_CODE = Path(__file__).parents[2] / "simulation" / "kernels" / "__pycache__"


def compiled_kernels() -> int:
    """The number of compiled signatures in the cache."""
    folder = Path(os.environ.get("NUMBA_CACHE_DIR") or _BESIDE_THE_CODE)
    return sum(1 for _ in folder.rglob("*.nbc"))
