"""Parts of kernels as machine code, which only kernels can call, called from Python."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba import njit


def called(part: Callable[..., Any]) -> Callable[..., Any]:
    """A kernel that does nothing but call the part; kept nowhere, so that it is never older than that."""
    part = part.in_machine_code()  # type: ignore[attr-defined]

    def call(*arguments: Any) -> Any:
        return part(*arguments)

    compiled: Callable[..., Any] = njit(error_model="numpy", _nrt=False)(call)
    return compiled
