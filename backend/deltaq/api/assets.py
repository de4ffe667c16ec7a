"""The files of the pages: which may be served, how long they may be kept, and their compressed forms.

A checkout serves its sources as they stand. A package has what frontend/tools/bundle.mjs made of them: files below
assets/, whose names carry a hash of their content, each beside its compressed forms.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from .page import FRAME, Content, read_site

MEDIA_TYPES = {
    ".js": "text/javascript; charset=utf-8",
    ".mjs": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".map": "application/json",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".ico": "image/x-icon",
    ".woff2": "font/woff2",
    ".txt": "text/plain; charset=utf-8",
    "": "text/plain; charset=utf-8",  # LICENSE, NOTICE
}
CODINGS = {"br": ".br", "gzip": ".gz"}  # the shortest first
HIDDEN_FOLDERS = frozenset({"bundle", "node_modules", "tests", "tools"})
NAMED_BY_CONTENT = "assets"
FOR_EVER = "public, max-age=31536000, immutable"
ASK_AGAIN = "no-cache"


@dataclass(frozen=True)
class Asset:
    """A file as it is sent."""

    content: bytes
    compressed: Mapping[str, bytes]  # by content coding, the shortest first; empty where there are none
    etag: str
    media_type: str
    cache_control: str


@dataclass(frozen=True)
class Document:
    """A page as it is sent, and what its policy must allow."""

    html: str
    import_map_hash: str


@dataclass(frozen=True)
class Assets:
    """The files below `root`, sources or a bundle; pages are told the version of the API, `source`."""

    root: Path
    source: str = ""

    @property
    def bundled(self) -> bool:
        return (self.root / NAMED_BY_CONTENT).is_dir()

    @property
    def pages(self) -> frozenset[str]:
        """The names of all pages."""
        site = read_site(self.root)
        return frozenset(site.pages) if site else frozenset()

    def page(self, name: str, sheets: Iterable[str] = (), content: Content | None = None) -> Document | None:
        """The page of a name, with further sheets of the import map and content; None if there is no such page."""
        site = read_site(self.root)
        if site is None or name not in site.pages:
            return None
        frame = (self.root / FRAME).read_text(encoding="utf-8")
        if content is not None:
            frame = content.inside(frame)
        return Document(site.assembled(frame, name, sheets, self.source), site.import_map_hash)

    def find(self, path: str) -> Asset | None:
        """The file at an address below /, or None if there is none that may be served."""
        parts = path.split("/")
        if any(part in HIDDEN_FOLDERS or part.startswith(".") or "\\" in part or "\0" in part for part in parts):
            return None
        file = self.root.joinpath(*parts)
        if file.suffix not in MEDIA_TYPES or not _is_file(file) or not self._holds(file):
            return None
        content, compressed, etag = _read(file, file.stat().st_mtime_ns)
        lasting = FOR_EVER if parts[0] == NAMED_BY_CONTENT else ASK_AGAIN
        return Asset(content, compressed, etag, MEDIA_TYPES[file.suffix], lasting)

    def _holds(self, file: Path) -> bool:
        return file.resolve().is_relative_to(self.root.resolve())


def _is_file(file: Path) -> bool:
    try:
        return file.is_file()
    except OSError:  # a name too long for the file system
        return False


@lru_cache(maxsize=512)
def _read(file: Path, _modified: int) -> tuple[bytes, Mapping[str, bytes], str]:
    """Content, compressed forms and entity tag; read again when the file has been modified."""
    content = file.read_bytes()
    beside = {coding: file.with_name(file.name + suffix) for coding, suffix in CODINGS.items()}
    compressed = {coding: form.read_bytes() for coding, form in beside.items() if form.is_file()}
    return content, compressed, f'"{hashlib.sha256(content).hexdigest()[:16]}"'
