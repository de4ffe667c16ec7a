"""Which kernels Numba has compiled, as its cache on disk tells; without loading Numba."""

from __future__ import annotations

import fcntl
import hashlib
import os
import platform
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import mkdtemp

from ...ownership import UntrustedFileError, require_trusted

KERNELS = Path(__file__).parents[2] / "simulation" / "kernels"
PROCESSOR = Path("/proc/cpuinfo")
VARIABLE = "NUMBA_CACHE_DIR"


def folder() -> Path:
    """Where Numba keeps what it has compiled."""
    return Path(os.environ.get(VARIABLE) or KERNELS / "__pycache__")


def take_own_folder() -> None:
    """Uses a folder of kernels that nobody else can write: where others may, one of this user's own.

    From theirs nothing would be loaded, and every worker would compile for itself.
    """
    if _is_trusted(folder()):
        return
    caches = Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache").expanduser()
    own = caches / "deltaq" / "kernels"
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


def mark_as_compiled() -> None:
    """Records that all kernels are compiled, for this source and this processor."""
    with suppress(OSError):
        folder().mkdir(parents=True, exist_ok=True)
        _mark().touch()


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
    return _mark().exists()


def _mark() -> Path:
    """A file whose name depends on what the kernels' validity depends on: their code, not the age of its files, which
    the layers of an image round.
    """
    digest = hashlib.sha256((platform.python_version() + _processor()).encode())
    for file in sorted(KERNELS.glob("*.py")):
        digest.update(file.name.encode() + file.read_bytes())
    return folder() / f"{digest.hexdigest()[:16]}.compiled"


def _processor() -> str:
    with suppress(OSError):
        lines = PROCESSOR.read_text(encoding="utf-8").splitlines()
        return "".join(sorted({line for line in lines if line.startswith(("model name", "flags", "Features"))}))
    return platform.processor()
