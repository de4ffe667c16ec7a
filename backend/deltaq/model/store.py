"""Compiled models kept on disk, by their content.

An entry is a digest and a pickle: machine code comes back in 0.1 ms, and whoever can write it can run what he likes, so
that no other form of it would be safer. What is believed is what nobody but this user can have written: a folder and
files of his own that neither group nor others may write. Anything else counts as missing. The entries used longest ago
give way to new ones.
"""

from __future__ import annotations

import hashlib
import logging
import os
import pickle
import platform
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from uuid import uuid4

import symengine as se

LOGGER = logging.getLogger("deltaq.model")
MOST_ENTRIES = 200
DIGEST = 32  # bytes
FOLDER = "DELTAQ_MODEL_CACHE"  # environment variable that names another folder
SUFFIX = ".model"
PACKAGE = Path(__file__).parents[1]
BY_OTHERS = stat.S_IWGRP | stat.S_IWOTH
MADE_FROM = ("language", "mechanics", "model")  # packages whose code decides what a model is


class NotOursError(OSError):
    """Somebody else may have written it."""


@dataclass(frozen=True)
class Store:
    """Entries in a folder; what cannot be read, written or believed is missing, never an error."""

    folder: Path
    most: int = MOST_ENTRIES

    def load(self, key: str) -> object | None:
        """The object of a key, or None."""
        with suppress(Exception), _opened(self.folder) as folder:  # whatever a damaged pickle may raise
            content = _read(f"{key}{SUFFIX}", folder)
            if hashlib.sha256(content[DIGEST:]).digest() == content[:DIGEST]:
                os.utime(f"{key}{SUFFIX}", dir_fd=folder)
                return pickle.loads(content[DIGEST:])  # type: ignore[no-any-return]  # noqa: S301  # our own
        return None

    def save(self, key: str, thing: object) -> None:
        """Keeps an object; the entry appears whole or not at all."""
        content = pickle.dumps(thing)
        with suppress(OSError):
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            with _opened(self.folder) as folder:
                _write(f"{key}{SUFFIX}", hashlib.sha256(content).digest() + content, folder)
                self._trim(folder)

    def _trim(self, folder: int) -> None:
        used = {name: os.stat(name, dir_fd=folder).st_mtime for name in os.listdir(folder) if name.endswith(SUFFIX)}
        for name in sorted(used, key=used.__getitem__, reverse=True)[self.most :]:
            with suppress(FileNotFoundError):  # another worker has just removed it
                os.unlink(name, dir_fd=folder)


@contextmanager
def _opened(folder: Path) -> Iterator[int]:
    """A folder of ours, held open so that no other can take its place. Raises NotOursError."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        _believe(descriptor, folder)
        yield descriptor
    finally:
        os.close(descriptor)


def _read(name: str, folder: int) -> bytes:
    """The content of a file of ours. Raises NotOursError."""
    with os.fdopen(os.open(name, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK, dir_fd=folder), "rb") as file:
        if not stat.S_ISREG(_believe(file.fileno(), Path(name)).st_mode):
            raise NotOursError(name)
        return file.read()


def _write(name: str, content: bytes, folder: int) -> None:
    new = f"{uuid4().hex}.new"
    try:
        descriptor = os.open(new, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o600, dir_fd=folder)
        with os.fdopen(descriptor, "wb") as file:
            file.write(content)
        os.replace(new, name, src_dir_fd=folder, dst_dir_fd=folder)
    except OSError:  # a full disk leaves no halves behind
        with suppress(OSError):
            os.unlink(new, dir_fd=folder)
        raise


def _believe(descriptor: int, place: Path) -> os.stat_result:
    """The state of what is open, if it is this user's and nobody else may write it. Raises NotOursError."""
    state = os.fstat(descriptor)
    if state.st_uid == os.geteuid() and not state.st_mode & BY_OTHERS:
        return state
    _warn(str(place))
    raise NotOursError(str(place))


@cache
def _warn(place: str) -> None:
    """Said once: it is no failure, but every model is compiled anew."""
    LOGGER.warning("others may have written %s: the models kept there are not used", place)


def user_store() -> Store:
    """The store of this user."""
    given = os.environ.get(FOLDER)
    caches = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return Store(Path(given) if given else caches / "deltaq" / "models")


def key_of(content: object) -> str:
    """A name for content, other for another version of the code, of SymEngine, of Python and for another processor."""
    return hashlib.sha256(f"{surroundings()} {content!r}".encode()).hexdigest()


@cache
def surroundings() -> str:
    """All besides the content that decides what a kept model is."""
    digest = hashlib.sha256()
    for file in sorted(file for package in MADE_FROM for file in (PACKAGE / package).rglob("*.py")):
        digest.update(file.read_bytes())
    return f"{digest.hexdigest()} {se.__version__} {sys.version} {platform.machine()} {_processor()}"


def _processor() -> str:
    """What the machine code is made for."""
    with suppress(OSError):
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return " ".join(sorted({line for line in lines if line.startswith(("model name", "flags", "Features"))}))
    return f"{platform.processor()} {platform.node()}"
