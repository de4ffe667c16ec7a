"""The folder of compiled kernels, for a service and its workers; without loading Numba."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import mkdtemp

from ...ownership import UntrustedFileError, require_trusted
from ...simulation.kernels.marks import VARIABLE, declared, folder, is_marked, own_folder


def take_own_folder() -> None:
    """Uses a folder of kernels that nobody else can write: where others may, one of this user's own.

    From theirs nothing would be loaded, and every worker would compile for itself.
    """
    if _is_trusted(folder()):
        return
    own = own_folder()
    with suppress(OSError):
        own.mkdir(mode=0o700, parents=True, exist_ok=True)
    is_usable = own.is_dir() and _is_trusted(own) and os.access(own, os.W_OK)
    os.environ[VARIABLE] = str(own) if is_usable else mkdtemp(prefix="deltaq-kernels-")


def _is_trusted(place: Path) -> bool:
    """Whether nobody else writes there; what is not there yet will be made by us."""
    try:
        require_trusted(place)
    except FileNotFoundError:
        return True
    except UntrustedFileError:
        return False
    return True


def compiled_kernels() -> int:
    """The number of compiled signatures in the cache."""
    return sum(1 for _ in folder().rglob("*.nbc"))


@contextmanager
def compiling() -> Iterator[None]:
    """Held by one process at a time: who comes later waits, and finds compiled what the first has compiled.

    Where nothing can be kept each process compiles for itself, and nobody waits.
    """
    try:
        folder().mkdir(parents=True, exist_ok=True)
        lock = (folder() / "compiling.lock").open("w")
    except OSError:
        yield
        return
    with lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def are_compiled() -> bool:
    """Whether all kernels are compiled for this source and this processor, so that loading them is quick."""
    return all(map(is_marked, declared()))
