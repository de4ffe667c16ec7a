"""Which kernels there is machine code of on disk, told by marks; without loading Numba.

A mark is an empty file whose name depends on what the validity of a kernel depends on: its code and all that it is made
of, not the age of its files, which the layers of an image round; the processor; the versions that compile.
"""

from __future__ import annotations

import ast
import hashlib
import os
import platform
import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache
from importlib.metadata import version
from pathlib import Path

KERNELS = Path(__file__).parent
PROCESSOR = Path("/proc/cpuinfo")
VARIABLE = "NUMBA_CACHE_DIR"
DECLARED = re.compile(r"^@(?:kernel|callback\([^)]*\)[^\n]*)\ndef (\w+)", re.MULTILINE)


def folder() -> Path:
    """Where Numba keeps what it has compiled."""
    return Path(os.environ.get(VARIABLE) or KERNELS / "__pycache__")


def own_folder() -> Path:
    """Where it may be kept for this user alone."""
    return Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache").expanduser() / "deltaq" / "kernels"


def name_of(function: Callable[..., object]) -> str:
    """The name of a kernel, `module.function`."""
    return f"{Path(function.__code__.co_filename).stem}.{function.__name__}"


def declared() -> Iterator[str]:
    """The names of all kernels that the sources declare."""
    for file in sorted(KERNELS.glob("*.py")):
        yield from (f"{file.stem}.{name}" for name in DECLARED.findall(file.read_text(encoding="utf-8")))


def mark(*names: str) -> None:
    """Records that there is machine code of these kernels, for this source and this processor.

    Where the folder of the kernels cannot be written, Numba keeps them elsewhere, and so are the marks.
    """
    for name in names:
        for place in (folder(), own_folder()):
            with suppress(OSError):
                place.mkdir(parents=True, exist_ok=True)
                (place / _mark(name)).touch()
                break


def is_marked(name: str) -> bool:
    """Whether there is machine code of a kernel."""
    found = _mark(name)
    return (folder() / found).exists() or (own_folder() / found).exists()


def _mark(name: str) -> str:
    file = KERNELS / f"{name.partition('.')[0]}.py"
    return f"{_digest(file, PROCESSOR)[:16]}.{name}.compiled"


@cache
def _digest(file: Path, processor: Path) -> str:
    made_by = (platform.python_version(), version("numba"), version("llvmlite"), _processor(processor))
    stamp = source_stamp(file) if file.exists() else ""
    return hashlib.sha256("".join((*made_by, stamp)).encode()).hexdigest()


def _processor(file: Path) -> str:
    with suppress(OSError):
        lines = file.read_text(encoding="utf-8").splitlines()
        return "".join(sorted({line for line in lines if line.startswith(("model name", "flags", "Features"))}))
    return platform.processor()


@cache
def source_stamp(file: Path) -> str:
    """A digest of the code of a module and of all modules of the package that it imports."""
    digest, seen, left = hashlib.sha256(), set[Path](), [file]
    while left:
        module = left.pop()
        if module not in seen:
            seen.add(module)
            left += _imported(module)
            digest.update(module.read_bytes())
    return digest.hexdigest()


@cache
def _imported(file: Path) -> tuple[Path, ...]:
    """The modules of the package that a module names in its imports; read once, for most kernels rest on the same."""
    found = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level > 0:
            folder = file.parents[node.level - 1].joinpath(*(node.module or "").split("."))
            found |= {folder.with_suffix(".py"), *(folder / f"{alias.name}.py" for alias in node.names)}
    return tuple(sorted((module for module in found if module.is_file()), reverse=True))
