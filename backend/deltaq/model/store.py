"""Compiled models kept on disk, by their content.

An entry is a digest and a pickle; one that does not fit its digest, or cannot be read, counts as missing and is written
anew. The folder belongs to the user alone, and the entries used longest ago give way to new ones.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import platform
import sys
import tempfile
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import symengine as se

MOST_ENTRIES = 200
DIGEST = 32  # bytes
FOLDER = "DELTAQ_MODEL_CACHE"  # environment variable that names another folder


@dataclass(frozen=True)
class Store:
    """Entries in a folder; what cannot be read or written is missing, never an error."""

    folder: Path
    most: int = MOST_ENTRIES

    def load(self, key: str) -> object | None:
        """The object of a key, or None."""
        with suppress(Exception):  # whatever a damaged or foreign pickle may raise
            content = self._file(key).read_bytes()
            if hashlib.sha256(content[DIGEST:]).digest() == content[:DIGEST]:
                os.utime(self._file(key))
                return pickle.loads(content[DIGEST:])  # type: ignore[no-any-return]  # noqa: S301  # own folder
        return None

    def save(self, key: str, thing: object) -> None:
        """Keeps an object; the entry appears whole or not at all."""
        content = pickle.dumps(thing)
        with suppress(OSError):
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            with tempfile.NamedTemporaryFile(dir=self.folder, suffix=".new", delete=False) as file:
                file.write(hashlib.sha256(content).digest() + content)
            Path(file.name).replace(self._file(key))
            self._trim()

    def _file(self, key: str) -> Path:
        return self.folder / f"{key}.model"

    def _trim(self) -> None:
        files = sorted(self.folder.glob("*.model"), key=lambda file: file.stat().st_mtime, reverse=True)
        for file in files[self.most :]:
            file.unlink(missing_ok=True)


def user_store() -> Store:
    """The store of this user."""
    given = os.environ.get(FOLDER)
    caches = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return Store(Path(given) if given else caches / "deltaq" / "models")


def key_of(content: object) -> str:
    """A name for content, other for another version of the code, of SymEngine, of Python and for another processor."""
    return hashlib.sha256(f"{_surroundings()} {content!r}".encode()).hexdigest()


@cache
def _surroundings() -> str:
    digest = hashlib.sha256()
    for file in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(file.read_bytes())
    return f"{digest.hexdigest()} {se.__version__} {sys.version} {platform.machine()} {_processor()}"


def _processor() -> str:
    """What the machine code is made for."""
    with suppress(OSError):
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return " ".join(sorted({line for line in lines if line.startswith(("model name", "flags", "Features"))}))
    return f"{platform.processor()} {platform.node()}"
