"""The files of the page: which may be served, how long they may be kept, and their compressed form."""

from __future__ import annotations

import gzip
import hashlib
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from threading import Lock

import brotli

from .page import assembled

MEDIA_TYPES = {
    ".js": "text/javascript; charset=utf-8",
    ".mjs": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".ico": "image/x-icon",
    ".woff2": "font/woff2",
    ".txt": "text/plain; charset=utf-8",
    "": "text/plain; charset=utf-8",  # LICENSE, NOTICE
}
INCOMPRESSIBLE = frozenset({".png", ".ico", ".woff2"})
HIDDEN_FOLDERS = frozenset({"node_modules", "tests"})
FOR_EVER = "public, max-age=31536000, immutable"
ASK_AGAIN = "no-cache"
# Of 11. The tenth takes ten times as long, for eight percent less: worth it where that is a fraction of a second.
QUALITY, BEST_QUALITY, BEST_UP_TO = 9, 10, 400_000

_TURNS = tuple(Lock() for _ in range(64))  # for files that share one it only means to wait for one another

_IMPORT = re.compile(rb'^@import "([a-z/-]+\.css)";$', re.MULTILINE)
_DOCUMENTATION = re.compile(rb"/\*\*.*?\*/", re.DOTALL)
_PAGE_NAME = re.compile(r"[a-z]+")
_VENDOR_PATH = re.compile(r"""(?<=["'])(\.?/)?vendor/""")


@dataclass(frozen=True)
class Asset:
    """A file as it is sent."""

    content: bytes
    compressed: Mapping[str, bytes]  # by content coding, the shortest first; empty where it does not pay
    media_type: str
    cache_control: str

    @property
    def etag(self) -> str:
        return f'"{hashlib.sha256(self.content).hexdigest()[:16]}"'


@dataclass(frozen=True)
class Assets:
    """The files below `root`. Libraries have the address /vendor/<version>/…, which names their content."""

    root: Path

    @property
    def version(self) -> str:
        """The version of the libraries, as the build hook wrote it."""
        stamp = self.root / "vendor" / "version.txt"
        return stamp.read_text(encoding="utf-8").strip() if stamp.is_file() else "unversioned"

    def page(self, name: str) -> str | None:
        """The page of a name, with the versioned addresses of the libraries; None if there is no such page."""
        if not _PAGE_NAME.fullmatch(name) or not _is_file(self.root / f"{name}.html"):
            return None
        return _VENDOR_PATH.sub(f"/vendor/{self.version}/", assembled(self.root, name))

    def find(self, path: str) -> Asset | None:
        """The file at an address below /, or None if there is none that may be served."""
        parts = path.split("/")
        versioned = len(parts) > 2 and parts[0] == "vendor" and parts[1] == self.version
        if versioned:
            del parts[1]
        if any(part in HIDDEN_FOLDERS or part.startswith(".") or "\\" in part or "\0" in part for part in parts):
            return None
        file = self.root.joinpath(*parts)
        sources = _sources(file)
        if file.suffix not in MEDIA_TYPES or not sources or not all(map(self._holds, sources)):
            return None
        content, compressed = _read(sources, tuple(source.stat().st_mtime_ns for source in sources))
        return Asset(content, compressed, MEDIA_TYPES[file.suffix], FOR_EVER if versioned else ASK_AGAIN)

    def _holds(self, file: Path) -> bool:
        return file.resolve().is_relative_to(self.root.resolve())


def _is_file(file: Path) -> bool:
    try:
        return file.is_file()
    except OSError:  # a name too long for the file system
        return False


def _sources(file: Path) -> tuple[Path, ...]:
    """What a file is made of: itself, and the style sheets it imports. Empty if one of them is not there."""
    if not _is_file(file):
        return ()
    imported = _IMPORT.findall(file.read_bytes()) if file.suffix == ".css" else []
    parts = tuple(file.parent / name.decode() for name in imported)
    return (file, *parts) if all(map(_is_file, parts)) else ()


def _read(files: tuple[Path, ...], modified: tuple[int, ...]) -> tuple[bytes, Mapping[str, bytes]]:
    """Content as it is sent, and compressed; read again when one of the files has been modified.

    Whoever asks while a file is compressed waits for that: thirty requests at once would else do it thirty times.
    """
    with _TURNS[hash(files) % len(_TURNS)]:
        return _compressed(files, modified)


@lru_cache(maxsize=512)
def _compressed(files: tuple[Path, ...], _modified: tuple[int, ...]) -> tuple[bytes, Mapping[str, bytes]]:
    file = files[0]
    content = _sent(file)
    if file.suffix in INCOMPRESSIBLE:
        return content, {}
    quality = BEST_QUALITY if len(content) <= BEST_UP_TO else QUALITY
    return content, {"br": brotli.compress(content, quality=quality), "gzip": gzip.compress(content, 9, mtime=0)}


def _sent(file: Path) -> bytes:
    """A sheet with those it imports in their places; a module of ours without its documentation, a fourth of its bytes.

    Lines keep their numbers. Libraries are sent as they came, with their licences.
    """
    content = file.read_bytes()
    if file.suffix == ".css":
        return _IMPORT.sub(lambda found: (file.parent / found[1].decode()).read_bytes(), content)
    if file.suffix == ".js" and "vendor" not in file.parts:
        return _DOCUMENTATION.sub(lambda found: b"\n" * found[0].count(b"\n"), content)
    return content
